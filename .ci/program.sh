#!/usr/bin/env bash
# Build a program of the gate against the installed library, of which nothing is compiled again, and
# print its path:
#
#   program.sh NAME
#
# NAME is bare (what the loops cost), digits (scenes drawn for quadruple precision to judge), extremes
# (check at any parameters), fuzz and decimal (nonsense, and all kinds of doubles), sines (beside
# quadruple precision) or tolerance (what a tolerance is worth): .ci/NAME/main.f90 and its modules.
set -eu
cd "$(dirname "$0")/.."
prefix=$(bash .ci/installed.sh)
mkdir -p "build/gate/$1"
gfortran -std=f2018 -O3 -fopenmp -ffp-contract=off -J "build/gate/$1" -I "$prefix/include" \
    $(find ".ci/$1" -name '*.f90' ! -name main.f90 | sort) ".ci/$1/main.f90" \
    -L "$prefix/lib" -llagrangia -llapack -lblas -lgsl -lgslcblas -o "build/gate/$1/$1"
echo "$PWD/build/gate/$1/$1"
