#!/usr/bin/env bash
# The API pages that FORD makes of the docstrings, in build/ford; any warning of FORD is a failure: a
# docstring that begins with "word:" is taken for metadata and lost, a formula may be cut.
set -eu
cd "$(dirname "$0")/.."
answer=$(ford ford.md 2>&1) || { tail -n 20 <<<"$answer"; exit 1; }
if grep -A 2 '^Warning' <<<"$answer"; then
    echo "FORD warns: see above"
    exit 1
fi
pages=$(find build/ford/module -name '*.html' | wc -l)
modules=$(grep -lE '^(sub)?module ' -r src | wc -l)
echo "$pages pages, $modules modules and submodules"
[ "$pages" -eq "$modules" ]
