#!/usr/bin/env bash
# Quadruple precision: the library's systems and gauss16, built with -DREAL128, come to the ends that
# data/reference/bench.nml has (made by other means), and remake data/reference/double_pendulum.nml;
# what needs LAPACK or GSL says that it cannot be built so.
#
#   check.sh [--write]     with --write double_pendulum.nml is made anew
set -eu
cd "$(dirname "$0")/../.."
swings=data/reference/double_pendulum.nml

quad=$(bash .ci/quad/build.sh)
"$quad" bench data/reference/bench.nml
if [ "${1:-}" = --write ]; then
    "$quad" swings >"$swings"
else
    "$quad" swings | diff - "$swings"
    echo "$swings: the same bytes"
fi
bash .ci/other_processor.sh native build/quad # a project of its own, as others may build beside this
if answer=$(fpm build -C build/quad --flag "-DREAL128" 2>&1); then
    echo "LAPACK and GSL were built for quadruple precision"
    exit 1
fi
grep -m 1 "Symbol .*this_part_needs_real64.* not found" <<<"$answer"
