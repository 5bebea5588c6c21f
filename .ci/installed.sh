#!/usr/bin/env bash
# Install the release build below build/gate, as a user does it below ~/.local, and print the folder.
# What is newer than all sources stays; whoever asks while another installs waits.
set -eu
cd "$(dirname "$0")/.."
prefix=$PWD/build/gate
mkdir -p "$prefix"
exec 9<"$prefix"
flock 9
if [ ! -e "$prefix/done" ] || [ -n "$(find src app fpm.toml -newer "$prefix/done" -print -quit)" ]; then
    fpm install --profile release --prefix "$prefix" >"$prefix/log" 2>&1 || { tail -n 20 "$prefix/log" >&2; exit 1; }
    touch "$prefix/done"
fi
echo "$prefix"
