#!/usr/bin/env bash
# Every shipped scene gives the same bytes by the build for the processor at hand and by that for any
# x86-64, but for the line that names the build.
#
#   same_bytes.sh FOLDER        where other_processor.sh has made that project
set -u
here=$PWD
work=$(mktemp -d) || exit 2
trap 'rm -rf "$work"' EXIT
for name in here there; do
    root=$([ $name = here ] && echo "$here" || realpath "$1")
    cd "$root" || exit 1
    program=$(fpm run --profile release --runner echo | tail -n 1)
    "$program" --version || exit 1
    "$program" --output "$work/$name" >"$work/$name.out" || exit 1
done
sed -i '/^# build: /d' "$work"/*/*.*
count=$(find "$work/here" -name '*.dat' | wc -l)
[ "$count" -ge 28 ] || { echo "$count data files only"; exit 1; }
diff -rq "$work/here" "$work/there" && echo "$count data files, the same bytes"
