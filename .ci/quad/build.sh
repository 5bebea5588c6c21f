#!/usr/bin/env bash
# Build the library's systems and gauss16 with -DREAL128, and print the name of the program.
#
# src here is made of links to the modules that the program uses, and to no other: LAPACK and GSL have
# no part in quadruple precision. Nor have the closed forms, submodules that call GSL: nothing here asks
# for one, so the linker lets their names stand unresolved.
set -eu
cd "$(dirname "$0")/../.."

link_modules() { # link_modules FILE...: what these files use, and what that uses
    local module file
    for module in $(sed -n 's/^ *use lagrangia_\([a-z0-9_]*\).*/\1/p' "$@" | sort -u); do
        for file in src/*/"$module".[fF]90 src/systems/"${module}_description.f90" src/systems/"${module}_momenta.f90"; do
            [ -e "$file" ] && [ ! -e ".ci/quad/src/${file##*/}" ] || continue
            ln -s "../../../$file" .ci/quad/src
            link_modules "$file"
        done
    done
}

rm -rf .ci/quad/src
mkdir .ci/quad/src
link_modules .ci/quad/app/*.f90
fpm build -C .ci/quad --profile release --flag "-DREAL128 -O1 -fno-unroll-loops" \
    --link-flag "-Wl,--unresolved-symbols=ignore-in-object-files" >/dev/null
ls -t .ci/quad/build/gfortran_*/app/quad | head -n 1
