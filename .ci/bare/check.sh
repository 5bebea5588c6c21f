#!/usr/bin/env bash
# What the loops cost, by valgrind on a release build: methods allocate nothing in their steps, and a
# run that nobody looks at takes no more than 2 % more instructions than its bare loop.
#
#   check.sh [STEPS]        STEPS of the instruction count, 100000 unless given
set -u
cd "$(dirname "$0")/.." || exit 2
steps=${1:-100000}
bare=$(bash program.sh bare) || exit 1
bad=0

allocations() { # allocations METHOD STEPS [SYSTEM]
    valgrind --leak-check=no "$bare" "$@" 2>&1 | sed -nE 's/.*total heap usage: ([0-9,]+) allocs.*/\1/p' | tr -d ,
}

same() { # same METHOD [SYSTEM]: as many allocations with 100 steps as with 1000
    local few many
    few=$(allocations "$1" 100 "${@:2}")
    many=$(allocations "$1" 1000 "${@:2}")
    echo "$*: $few allocations with 100 steps, $many with 1000"
    [ -n "$few" ] && [ "$few" = "$many" ] && return
    echo "$* allocates in its steps"
    bad=1
}

instructions() { # instructions loop|run
    valgrind --tool=callgrind --callgrind-out-file=/dev/null "$bare" "$1" "$steps" 2>&1 |
        sed -nE 's/.*Collected : ([0-9]+).*/\1/p'
}

for method in $("$bare" names | sort -u); do
    case $method in
    midpoint | stormer_verlet) # where no momenta were derived by hand, hyper-dual numbers allocate
        for system in pendulum double_pendulum cart_pendulum; do same "$method" "$system"; done ;;
    *) same "$method" ;;
    esac
done
loop=$(instructions loop)
run=$(instructions run)
awk -v loop="$loop" -v run="$run" -v steps="$steps" 'BEGIN {
    printf "instructions of %d steps: %d in the bare loop, %d by run: %.4f\n", steps, loop, run, run / loop
    exit !(loop > 0 && run <= 1.02 * loop)
}' || bad=1
exit $bad
