#!/usr/bin/env bash
# Build the programs of the gate, one call at a time, and print the path of one: program.sh NAME
set -eu
cd "$(dirname "$0")"
mkdir -p build
flock build fpm build --profile release >build/log 2>&1 || { cat build/log >&2; exit 1; }
ls -t "$PWD"/build/gfortran_*/app/"$1" | head -n 1
