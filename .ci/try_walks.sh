#!/usr/bin/env bash
# The walk-throughs in docs/walk_*.md, the notebook, docs/derive.md, docs/grading.md, docs/animation.md, docs/sweeps.md, docs/stress.md and the README: every
# command and every piece of Python prints what the page says. Needs a python3 with NumPy, pandas and matplotlib (setup.sh --dev); without, the
# pages that need it are not tried, and that is said.
#
#   .ci/try_walks.sh [PROGRAM]             compare
#   .ci/try_walks.sh [PROGRAM] --accept    after a change that is meant: keep what is printed, read git diff
set -u
cd "$(dirname "$0")/.." || exit 2
root=$PWD
accept=
program=
for word; do if [ "$word" = --accept ]; then accept=--accept; else program=$word; fi; done
if [ -z "$program" ]; then # the newest release build
    for found in $(ls -t build/gfortran_*/app/lagrangia 2>/dev/null); do
        if "$found" --version | grep -q ', optimised'; then program=$found; break; fi
    done
fi
[ -x "$program" ] || { echo "no program: fpm build --profile release"; exit 2; }
work=$(mktemp -d) || exit 2
trap 'rm -rf "$work"' EXIT
mkdir "$work/bin"
ln -s "$(realpath "$program")" "$work/bin/lagrangia"
export PATH="$work/bin:$PATH" MPLBACKEND=Agg MPLCONFIGDIR="$work/matplotlib" OPENBLAS_NUM_THREADS=1
python=
for found in python3 /usr/bin/python3; do
    if "$found" -c 'import matplotlib, numpy, pandas' 2>/dev/null; then python=$found; break; fi
done
status=0
for page in docs/walk_cart_pendulum.md docs/walk_verlet.md docs/walk_data.md docs/walk_sweeps.md \
    docs/reading_data.ipynb docs/derive.md docs/grading.md docs/sweeps.md docs/stress.md docs/animation.md README.md; do
    runner=python3
    case $page in *data* | *sweeps*)
        runner=$python
        [ -n "$python" ] || { echo "not tried: no python3 with NumPy, pandas and matplotlib for $page"; continue; } ;;
    esac
    name=$(basename "$page")
    mkdir "$work/${name%.*}" && cd "$work/${name%.*}" || exit 2
    "$runner" "$root/.ci/try_walks.py" "$root/$page" $accept || status=1
    cd "$root" || exit 2
done
exit $status
