#!/usr/bin/env bash
# What 'errata', 'principle' and 'course' quote stands in the lecture notes, on the line that it names.
#
# The notes are not in this project. data/reference/lecture_notes.txt holds the quoted lines; a unit test
# compares the quotes with it, this script compares it with the scans. Their folder is the first argument,
# or ../shared/lecture-notes. Without one nothing is compared, which is said, with status 0; given as an
# argument it must be there.
set -u
cd "$(dirname "$0")/.." || exit 2
notes=${1:-../shared/lecture-notes}
if [ ! -d "$notes" ]; then
    echo "NOT COMPARED: no folder $notes; the quotes were compared with data/reference/lecture_notes.txt only"
    [ $# -eq 0 ]
    exit
fi
bad=0
count=0
while read -r scan line text; do
    case $scan in
    I) file=$(ls "$notes"/000_*.txt) ;;
    II) file=$(ls "$notes"/001_*.txt) ;;
    *) continue ;;
    esac
    count=$((count + 1))
    if ! sed -n "${line}p" "$file" | grep -qF -- "$text"; then
        echo "$scan, line $line: not in $file: $text"
        bad=$((bad + 1))
    fi
done <data/reference/lecture_notes.txt
echo "$count quoted lines, $bad of them not as in the notes"
# 'lagrangia course' has every line with text on it: test/test_course.f90 has their numbers.
for scan in first:000 second:001; do
    in_test=$(sed -n "/parameter :: ${scan%:*}(/,/]/p" test/test_course.f90 | sed 's/.*\[//' | grep -oE '[0-9]+' | tr '\n' ' ')
    in_scan=$(grep -n '[^[:space:]]' "$notes"/"${scan#*:}"_*.txt | cut -d: -f1 | tr '\n' ' ')
    if [ "$in_test" != "$in_scan" ]; then
        echo "the ${scan%:*} lecture: other lines with text than in test/test_course.f90"
        bad=$((bad + 1))
    fi
done
[ "$count" -eq 119 ] && [ "$bad" -eq 0 ]
