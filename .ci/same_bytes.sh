#!/usr/bin/env bash
# Every shipped scene gives the same bytes by two release builds, the one for the processor at hand,
# say, and one for any x86-64, but for the line that names the build.
#
#   same_bytes.sh PROGRAM OTHER
set -u
programs=("$(realpath "$1")" "$(realpath "$2")")
cd "$(dirname "$0")/.." || exit 2
work=$(mktemp -d) || exit 2
trap 'rm -rf "$work"' EXIT
for k in 0 1; do
    "${programs[k]}" --version || exit 1
    "${programs[k]}" --output "$work/$k" >"$work/$k.out" || exit 1
    sed '/^# build: /!d' "$work/$k/pendulum.dat"
    sed -i '/^# build: /d' "$work/$k"/*.*
done >"$work/builds"
cat "$work/builds"
[ "$(grep '^# build: ' "$work/builds" | sort -u | wc -l)" -eq 2 ] || { echo "that is one build"; exit 1; }
count=$(find "$work/0" -name '*.dat' | wc -l)
[ "$count" -ge 28 ] || { echo "$count data files only"; exit 1; }
diff -rq "$work/0" "$work/1" && echo "$count data files, the same bytes"
