#!/usr/bin/env bash
# Films and reports in a browser: .ci/browser/films.py on the pages of every shipped scene.
# Give the program's path, or the newest build is taken. Without Chromium it says so and holds.
set -u
cd "$(dirname "$0")/.." || exit 2
program=${1:-$(ls -t build/gfortran_*/app/lagrangia 2>/dev/null | head -n 1)}
[ -x "$program" ] || { echo "no program: fpm build --profile release"; exit 2; }
for browser in chromium chromium-browser google-chrome; do
    command -v "$browser" >/dev/null && exec python3 .ci/browser/films.py "$program" "${@:2}"
done
echo "not run: no chromium"
