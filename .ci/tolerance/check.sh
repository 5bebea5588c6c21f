#!/usr/bin/env bash
# What a tolerance is worth: gauss16 and dop853 over smooth runs, at a million radians, and where the
# force has a kink or a jump. Prints the tables and fails where a bound does not hold, or where the
# README says another number of the smooth runs.
set -eu
cd "$(dirname "$0")/.."
program=$(bash program.sh tolerance)
bad=0
smooth=$("$program" smooth)
echo "$smooth"
# another processor's last bits may carry a run or two over the ten
for method in gauss16 dop853; do
    read -r runs within < <(awk -v m=$method '$1 == m { print $2, $3 }' <<<"$smooth")
    said=$(tr '\n' ' ' <../README.md | sed -nE "s/.*\`$method\` in ([0-9]+) of $runs.*/\1/p")
    if [ -z "$said" ] || [ $((said - within)) -gt 2 ] || [ $((within - said)) -gt 2 ]; then
        echo "the README says of $method '$said', not $within of $runs"
        bad=1
    fi
done
"$program" large
kinks=$("$program" kinks)
echo "$kinks"
# at most three passages a swing or two, of ten tolerances each, and dop853's own chance of 1e4
awk '/gauss16/ && !($(NF - 5) < 200) { print "more than 200 tolerances:", $0; bad = 1 }
     /gauss16|dop853/ && $NF > 0 { print "refused:", $0; bad = 1 }
     END { exit bad }' <<<"$kinks" || bad=1
exit $bad
