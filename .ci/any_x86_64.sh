#!/usr/bin/env bash
# The library for any x86-64, with -O2 and without warnings, as the dependency that it is of the example
# normal_modes, and what that prints; with this library FOLDER/lagrangia, the program, and FOLDER/unit,
# the tests, as `fpm test` has compiled them here before; and these without warnings.
#
#   any_x86_64.sh FOLDER WARNINGS
set -eu
cd "$(dirname "$0")/.."
other=$1
warnings=$2
example=$other/normal_modes
bash .ci/other_processor.sh x86-64 "$other"
rm -rf "$example/app"
mkdir -p "$example"
cp -r data/examples/normal_modes/app "$example"
sed 's|path = "../../.."|path = ".."|' data/examples/normal_modes/fpm.toml >"$example/fpm.toml"
fpm build --no-prune -C "$example" --flag "-O2 $warnings"

newest_file() { # newest_file FILES...: the last one
    ls -t "$@" | head -n 1
}
three=$("$(newest_file "$example"/build/gfortran_*/app/three_masses)")
echo "$three"
awk -v want="0.58578643762690495 2 3.41421356237309505" '
    { split(want, w, " "); if (!((w[NR] - $3)^2 <= 1e-28)) bad = 1 }
    END { exit bad || NR != 3 }' <<<"$three" || { echo "omega^2 = 2 - sqrt 2, 2, 2 + sqrt 2 is not what normal_modes prints"; exit 1; }

library=$(newest_file "$example"/build/gfortran_*/three_masses/libthree_masses.a)
modules=$(dirname "$(newest_file "$example"/build/gfortran_*/lagrangia.mod)")
tests=$(dirname "$(newest_file build/gfortran_*/lagrangia/test_main.f90.o)")
libraries="-llapack -lblas -lgsl -lgslcblas"
gfortran -O2 -fopenmp -fcoarray=single $warnings -I "$modules" -J "$other" app/main.f90 "$library" $libraries -o "$other/lagrangia"
gfortran -fopenmp "$tests"/test_*.o "$library" $libraries -o "$other/unit"
"$other/lagrangia" --version | grep -e "-march=x86-64 .*-O2 .*SSE2" | grep -v -e -O3 || { echo "that is not -O2 for any x86-64"; exit 1; }
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
ls test/*.f90 | xargs -n 8 -P 2 gfortran -fsyntax-only -cpp -fopenmp -fcoarray=single $warnings -I "$(dirname "$tests")" -J "$scratch"
