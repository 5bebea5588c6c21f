#!/usr/bin/env bash
# Does check_layers.sh see what it is there to see? Plant one violation at a time in a small house.
set -u
cd "$(dirname "$0")" || exit 2
check=$PWD/check_layers.sh
house=$(mktemp -d) || exit 1
trap 'rm -rf "$house"' EXIT
failures=0

module() { # module ROOM NAME LINE...: a module with these lines
    mkdir -p "$house/src/$1"
    {
        echo "module lagrangia_$2"
        printf '    %s\n' "${@:3}"
        echo "end module lagrangia_$2"
    } >"$house/src/$1/$2.f90"
}

build_house() {
    rm -rf "$house"
    mkdir -p "$house/app" "$house/test"
    module core kinds "use, intrinsic :: iso_fortran_env, only: real64"
    module posix console "use, intrinsic :: iso_fortran_env, only: output_unit"
    module namelist number_reader "use lagrangia_kinds, only: dp"
    module numerics roots "use lagrangia_kinds, only: dp"
    module systems system "use lagrangia_roots, only: root" "use lagrangia_number_reader"
    module systems pendulum "use lagrangia_system, only: system_t" \
        "type, extends(system_t) :: pendulum_t"
    module references swing "use lagrangia_pendulum, only: pendulum_t"
    module integrators integrator "use lagrangia_system, only: system_t"
    module integrators rk4 "use lagrangia_integrator, only: integrator_t" \
        "type, extends(integrator_t) :: rk4_t" "print = stop + 1 ! print *, stop" "stopped = printed"
    module oscillations modes "use lagrangia_system, only: system_t"
    module observers table "use lagrangia_integrator, only: integrator_t" \
        'call fail("don'"'"'t stop; print *, write(*, *)")'
    module tables npy "use lagrangia_system, only: system_t"
    module catalogue catalogue "use lagrangia_rk4, only: rk4_t"
    module audit audited "use lagrangia_catalogue"
    module principles lagrange "use lagrangia_audited"
    module scenes scene "use lagrangia_lagrange" "use lagrangia_table, only: table_t"
    module runs run "use lagrangia_scene"
    module ensembles sweep "use :: lagrangia_run"
    module commands list "use lagrangia_sweep" "use lagrangia_console" "print *, 1" "write (*, *) 1" "stop 1"
    printf '%s\n' "module lagrangia" "use lagrangia_sweep" "end module" >"$house/src/lagrangia.f90"
    printf '%s\n' "program main" "use lagrangia" "use lagrangia_list" "print *, 1" >"$house/app/main.f90"
    printf '%s\n' "module test_all" "use lagrangia_list" "use funit" >"$house/test/test_all.f90"
}

refuses() { # refuses MESSAGE: the planted house is refused, and for this reason
    local answer
    if answer=$(bash "$check" "$house") || ! grep -qF -- "$1" <<<"$answer"; then
        printf 'not seen: %s; the check says: %s\n' "$1" "$answer"
        failures=$((failures + 1))
    fi
    build_house
}

build_house
if ! answer=$(bash "$check" "$house"); then
    printf 'refuses a good house: %s\n' "$answer"
    failures=1
fi

module core kinds "use lagrangia_roots";                            refuses "core may not use numerics"
module core kinds "use lagrangia_number_reader";                    refuses "core may not use namelist"
module namelist number_reader "use lagrangia_roots";                refuses "namelist may not use numerics"
module numerics roots "USE,non_intrinsic::Lagrangia_Pendulum";      refuses "numerics may not use systems"
module systems system "integer :: i; use &" "    & lagrangia_rk4";  refuses "systems may not use integrators"
module integrators rk4 "use lagrangia_swing";                       refuses "integrators may not use references"
module references swing "use lagrangia_rk4";                        refuses "references may not use integrators"
module core kinds "use lagrangia_console";                          refuses "core may not use posix"
module posix console "use lagrangia_number_reader";                 refuses "posix may not use namelist"
module systems system "use lagrangia_npy";                          refuses "systems may not use tables"
module tables npy "use lagrangia_swing";                            refuses "tables may not use references"
module integrators rk4 "use lagrangia_modes";                       refuses "integrators may not use oscillations"
module oscillations modes "use lagrangia_table";                    refuses "oscillations may not use observers"
module observers table "use lagrangia_catalogue";                   refuses "observers may not use catalogue"
module catalogue catalogue "use lagrangia_audited";                 refuses "catalogue may not use audit"
module audit audited "use lagrangia_lagrange";                      refuses "audit may not use principles"
module principles lagrange "use lagrangia_scene";                   refuses "principles may not use scenes"
module scenes scene "use lagrangia_run";                            refuses "scenes may not use runs"
module runs run "use lagrangia_sweep";                              refuses "runs may not use ensembles"
module ensembles sweep "use lagrangia_list";                        refuses "ensembles may not use commands"
module commands list "use lagrangia, only: dp";                     refuses "commands may not use face"
module integrators rk4 "use lagrangia_pendulum";                    refuses "may not name a concrete system"
module observers table "use lagrangia_pendulum";                    refuses "may not name a concrete system"
module observers table "use lagrangia_rk4";                         refuses "may not name a concrete integrator"
module core kinds "use lagrangia_nowhere";                          refuses "no file here defines"
module core kinds "use funit";                                      refuses "no file here defines"
module core kinds "print *, 'x'";                                   refuses "only app/ and src/commands/ print"
module core kinds "if (x) print '(a)', y";                          refuses "only app/ and src/commands/ print"
module core kinds "write(*, *) x";                                  refuses "only app/ and src/commands/ print"
module core kinds "if (f(x) > 1) write (unit = *, fmt=*) x";        refuses "only app/ and src/commands/ print"
module core kinds "use, intrinsic :: iso_fortran_env, only: output_unit"
refuses "only app/ and src/commands/ print"
module scenes scene "use lagrangia_console, only: put";         refuses "only app/ and src/commands/ print"
module core kinds "use lagrangia_c_library, only: c_fflush, c_write"
refuses "only app/ and src/commands/ print"
module core kinds "STOP";                                           refuses "only app/ and src/commands/ stop"
module core kinds "if (x) error stop 'now'";                        refuses "only app/ and src/commands/ stop"
module core kinds "stop 3, quiet=.true.";                           refuses "only app/ and src/commands/ stop"
module cellar kinds "integer :: i";                                 refuses "no such room: cellar"
mv "$house/src/core/kinds.f90" "$house/src/core/kind.f90";          refuses "should be called lagrangia_kind"
module core kinds "end module lagrangia_kinds" "module lagrangia_more"
refuses "a second module"
module core kinds '!! \(a\' 'real :: x';                             refuses "ends in a backslash"
module core kinds '!! data/*.nml';                                  refuses "takes this for a comment"
: >"$house/src/core/empty.f90";                                     refuses "no module here"
yes "! long" | head -n 451 >>"$house/src/core/kinds.f90";           refuses "more than 450 lines"
yes "! long" | head -n 100 >>"$house/app/main.f90";                 refuses "more than 100 lines"
module ensembles sweep "!\$omp parallel do"
refuses "threads share"

[ "$failures" -eq 0 ] && echo "every planted violation was seen"
exit $((failures > 0))
