#!/usr/bin/env bash
# What the surroundings say must not show: libgfortran's variables, the locale, the terminal, folders
# that are not there. Every command prints the same bytes and ends with the same status under each.
# Give the program's path, or build it first: fpm build --profile release.
set -u
cd "$(dirname "$0")/.." || exit 2
program=${1:-}
if [ -z "$program" ]; then # the newest one; a release build by preference
    for found in $(ls -t build/gfortran_*/app/lagrangia 2>/dev/null); do
        program=${program:-$found}
        if "$found" --version | grep -q ', optimised'; then
            program=$found
            break
        fi
    done
fi
[ -x "$program" ] || { echo "no program: fpm build --profile release"; exit 2; }
program=$(realpath "$program")
root=$PWD
work=$(mktemp -d) || exit 2
trap 'rm -rf "$work"' EXIT
failures=0

words=(
    "run pendulum cart_pendulum bouncing_ball --output o"
    "run pendulum --format csv --output o"
    "run pendulum --format npy --output o"
    "run double_pendulum --error-estimate --json --output o"
    "run nothing_such"
    "run pendulum --set scene%dt=x"
    "list"
    "describe wedge"
    "modes double_pendulum --output o"
    "modes hanging_chain --json"
    "check pendulum"
    "check atwood --json"
    "errata"
    "principle least-time"
    "principle action --json"
    "derive cart_pendulum"
    "derive pendulum --latex"
    "course II"
    "compare pendulum --methods rk4,verlet --set scene%dt=0.1 --json --output o"
    "sweep pendulum --over q=0.1:1:3 --keep period --threads 2 --output o"
    "sweep pendulum --over q=x:1:3 --keep period"
    "grade atwood"
    "grade nothing.txt"
    "show pendulum"
    "completion bash"
    "completion zsh"
    "manual"
    "help sweep"
    "--help"
    "--version"
)

drawing=( # needs gnuplot, which is found by PATH
    "run wedge --plot --output o/drawn"
    "report wedge --output o/report"
)

record() { # record FOLDER SETTING...: all that the commands print and write, and their statuses
    local folder=$1 command
    rm -rf "${work:?}/here" "$folder"
    mkdir -p "$work/here/data" "$folder"
    ln -s "$root/data/scenes" "$work/here/data/scenes"
    for command in "${words[@]}" "${drawing[@]}"; do
        # shellcheck disable=SC2086  # a command is several words
        (cd "$work/here" && timeout 60 env "${@:2}" "$program" $command </dev/null 2>&1; echo "status $?")
    done | sed -E -e 's/"seconds": *[^,}]*/"seconds": s/' -e 's/ [0-9]+\.[0-9]{4} s$/ TIME/' -e 's/ in [0-9.e-]+ s by/ in TIME by/' >"$folder/printed"
    mv "$work/here/o" "$folder/o" 2>/dev/null
    [ ${#drawing[@]} -eq 0 ] ||
        sed -i -E "s/accelerations, [0-9.]+ s/accelerations, TIME/" "$folder/o/report/report.html"
    return 0
}

try() { # try SETTING...: the same bytes as without them
    record "$work/that" "$@"
    if diff -r "$work/this" "$work/that" >"$work/diff" 2>&1; then
        printf 'ok      %s\n' "$*"
    else
        printf 'FAILED  %s\n' "$*"
        head -c 2000 "$work/diff" | head -n 20 | sed 's/^/        | /'
        failures=$((failures + 1))
    fi
    rm -rf "$work/that"
}

record "$work/this" -u GFORTRAN_OPTIONAL_PLUS
grep -q '^status 0$' "$work/this/printed" && [ -s "$work/this/o/pendulum.dat" ] || { cat "$work/this/printed"; exit 1; }
try LAGRANGIA_NOTHING=1
for setting in GFORTRAN_OPTIONAL_PLUS=1 GFORTRAN_UNBUFFERED_ALL=1 GFORTRAN_UNBUFFERED_PRECONNECTED=1 \
    GFORTRAN_DEFAULT_RECL=20 GFORTRAN_LIST_SEPARATOR=";" GFORTRAN_SHOW_LOCUS=0 GFORTRAN_ERROR_BACKTRACE=0 \
    GFORTRAN_CONVERT_UNIT=big_endian GFORTRAN_TMPDIR=/nowhere GFORTRAN_STDIN_UNIT=7 GFORTRAN_STDOUT_UNIT=9 \
    GFORTRAN_STDERR_UNIT=8 GFORTRAN_STDERR_UNIT=6 GFORTRAN_STDERR_UNIT=5 GFORTRAN_STDOUT_UNIT=0 GFORTRAN_STDIN_UNIT=6 \
    GFORTRAN_STDIN_UNIT=0 GFORTRAN_FORMATTED_BUFFER_SIZE=1 GFORTRAN_UNFORMATTED_BUFFER_SIZE=1 \
    LC_ALL=C LC_ALL=C.UTF-8 LC_ALL=de_DE.UTF-8 LC_ALL=tr_TR.UTF-8 LC_ALL=nowhere LC_NUMERIC=de_DE.UTF-8 \
    LANGUAGE=de TERM=dumb TERM= TERM=nothing COLUMNS=1 COLUMNS=x LINES=0 NO_COLOR=1 HOME=/nowhere HOME= TMPDIR=/nowhere \
    TMPDIR= PWD=/nowhere TZ=Nowhere/Nothing OMP_NUM_THREADS=7 OPENBLAS_NUM_THREADS=3 \
    GNUTERM=nonsense GNUTERM=dumb MALLOC_PERTURB_=85 MALLOC_ARENA_MAX=1 POSIXLY_CORRECT=1 BASH_ENV=/nowhere ENV=/nowhere; do
    try "$setting"
done
for name in HOME TERM LANG PATH; do
    try -u "$name"
done
try -i
drawing=()
record "$work/this" -u GFORTRAN_OPTIONAL_PLUS
try PATH=/nowhere

# The first of them anywhere else in the sources: formats of numbers begin with ss
if grep -nE 'write \([^"]*"\((\*\(|[0-9]*\(|a, )*(i|f|e|es|en|g)[0-9]' -r src app; then
    echo "FAILED  formats of numbers begin with ss"
    failures=$((failures + 1))
else
    echo "ok      formats of numbers begin with ss"
fi
echo "$failures failed"
exit $((failures > 0))
