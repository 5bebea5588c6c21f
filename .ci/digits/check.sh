#!/usr/bin/env bash
# No wrong digit: scenes at random, and in the corners where estimates go wrong, state their ends with
# an error; the same motions in quadruple precision say whether a printed digit is wrong.
#
#   check.sh [COUNT [SEED]]     default 600 1; the table's last column is the sum of the right digits
set -eu
cd "$(dirname "$0")/../.."
drawn=$(mktemp)
trap 'rm -f "$drawn"' EXIT

digits=$(bash .ci/program.sh digits)
quad=$(bash .ci/quad/build.sh)
OPENBLAS_NUM_THREADS=1 "$digits" "${1:-600}" "${2:-1}" >"$drawn"
"$quad" judge "$drawn"
