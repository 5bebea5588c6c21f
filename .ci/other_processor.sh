#!/usr/bin/env bash
# The same sources for another processor: FOLDER becomes a project like this one, which compiles for
# MARCH (x86-64, x86-64-v3, ...) instead of for the processor at hand. What fpm builds there stays.
#
#   other_processor.sh MARCH FOLDER
set -eu
march=$1
root=$(cd "$(dirname "$0")/.." && pwd)
mkdir -p "$2"
cd "$2"
for part in app src test data docs README.md; do ln -sfn "$root/$part" "$part"; done
sed "s/-march=native/-march=$march/" "$root/fpm.toml" >fpm.toml.new
grep -q -- "-march=$march " fpm.toml.new || { echo "fpm.toml has no -march=native"; exit 1; }
if cmp -s fpm.toml.new fpm.toml; then rm fpm.toml.new; else mv fpm.toml.new fpm.toml; fi
