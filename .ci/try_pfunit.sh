#!/usr/bin/env bash
# The README's tests by pFUnit itself, and the tests that must fail, where pFUnit is installed: below
# $PFUNIT_ROOT, /usr/local, /opt or ~/.local, in the folders PFUNIT-4.*, FARGPARSE-* and GFTL_SHARED-*
# that its own installation makes. Elsewhere it says so and is content.
set -u
cd "$(dirname "$0")/.." || exit 2
pfunit=
for root in "${PFUNIT_ROOT:-}" /usr/local /opt /opt/pfunit "$HOME/.local"; do
    [ -n "$root" ] && compgen -G "$root/PFUNIT-4.*/include" >/dev/null && pfunit=$root && break
done
if [ -z "$pfunit" ]; then
    echo "not run: there is no pFUnit 4 (PFUNIT_ROOT may say where)"
    exit 0
fi
includes=() libraries=()
for folder in "$pfunit"/PFUNIT-4.* "$pfunit"/FARGPARSE-* "$pfunit"/GFTL_SHARED-*; do
    includes+=("-I$folder/include")
    libraries+=("-L$folder/lib")
done
export FPM_FFLAGS="-g ${includes[*]}" FPM_LDFLAGS="${libraries[*]}"
fpm test -C test/pfunit || exit 1

work=$(mktemp -d) || exit 2
trap 'rm -rf "$work"' EXIT
# shellcheck disable=SC2086  # the flags are several words
gfortran $FPM_FFLAGS -J "$work" .ci/failing/test/main.f90 -o "$work/failing" $FPM_LDFLAGS -lfunit -lfargparse \
    -lgftl-shared-v2-as-default -lgftl-shared-v2 || exit 1
"$work/failing" >"$work/out" 2>&1
status=$?
if [ $status -ne 2 ] || ! grep -q '^Tests run: 83, Failures: 5, Errors: 0' "$work/out"; then
    echo "of pFUnit the tests that must fail have status $status:"
    cat "$work/out"
    exit 1
fi
