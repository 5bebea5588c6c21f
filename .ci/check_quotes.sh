#!/usr/bin/env bash
# What 'lagrangia errata' quotes stands in the lecture notes, on the line that it names.
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
[ "$count" -eq 45 ] && [ "$bad" -eq 0 ]
