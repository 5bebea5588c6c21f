#!/usr/bin/env bash
# Does check_arguments.py see what it is there to see? Plant one violation at a time in a small house.
set -u
cd "$(dirname "$0")" || exit 2
check=$PWD/check_arguments.py
house=$(mktemp -d) || exit 1
trap 'rm -rf "$house"' EXIT
failures=0

build_house() {
    rm -rf "$house"
    mkdir -p "$house/src/core" "$house/src/systems" "$house/.ci"
    cat >"$house/src/core/roots.f90" <<'END'
module lagrangia_roots
    use lagrangia_kinds, only: dp
    private
    public :: find, twice, operator(.near.), value_i, lapack
    interface twice
        module procedure twice_real
        module function twice_integer(n) result(m)
            integer, intent(in) :: n  !! any number
            integer :: m
        end function twice_integer
    end interface twice
    interface operator(.near.)
        module procedure near
    end interface operator(.near.)
    interface
        subroutine lapack(n)
            integer, intent(in) :: n
        end subroutine lapack
    end interface
    abstract interface
        function value_i(x) result(y)
            real(dp), intent(in) :: x  !! m
            real(dp) :: y
        end function value_i
    end interface
contains
    subroutine find(f, low, high, &
                    root)
        !! A root.
        procedure(value_i) :: f  !! a function
        real(dp), intent(in) :: low, high  !! the bracket, m
        real(dp), intent(out) :: &
            root
            !! where f(root) = 0
        call inner(low)
    contains
        subroutine inner(x)
            real(dp), intent(in) :: x
        end subroutine inner
    end subroutine find
    pure real(dp) function twice_real(x)
        real(dp), intent(in) :: x  !! "any" number
    end function twice_real
    pure logical function near(a, b)
        real(dp), intent(in) :: a, b
    end function near
    subroutine ours(x)
        real(dp), intent(in) :: x
    end subroutine ours
end module lagrangia_roots
END
    cat >"$house/src/systems/system.f90" <<'END'
module lagrangia_system
    private
    public :: system_t, pendulum_t
    type, abstract :: system_t
    contains
        procedure(energy_i), deferred :: energy
        procedure :: show
        procedure, private :: secret
        procedure, nopass :: unit => unit_of
    end type system_t
    type, extends(system_t) :: pendulum_t
    contains
        procedure :: energy => energy_of_pendulum
        procedure :: length
    end type pendulum_t
    abstract interface
        function energy_i(self, q) result(e)
            class(system_t), intent(in) :: self
            real(dp), intent(in) :: q(:)  !! rad
        end function energy_i
    end interface
contains
    function energy_of_pendulum(self, q) result(e)
        class(pendulum_t), intent(in) :: self
        real(dp), intent(in) :: q(:)
    end function energy_of_pendulum
    subroutine show(self, text)
        class(system_t), intent(in) :: self
        character(*), intent(in) :: text  !! its name
    end subroutine show
    subroutine secret(self, text)
        class(system_t), intent(in) :: self
        character(*), intent(in) :: text
    end subroutine secret
    function unit_of(i)
        integer, intent(in) :: i  !! of the column
    end function unit_of
    subroutine length(self, l)
        class(pendulum_t), intent(in) :: self
        real(dp), intent(out) :: l  !! m
    end subroutine length
end module lagrangia_system
END
}

plant() { # plant FILE SED-COMMAND MESSAGE: the house so changed is refused, and for this reason
    local answer before
    before=$(cat "$house/src/$1")
    sed -i "$2" "$house/src/$1"
    [ "$before" != "$(cat "$house/src/$1")" ] || { echo "nothing planted by $2"; failures=$((failures + 1)); }
    if answer=$(python3 "$check" "$house") || ! grep -qE -- "$3" <<<"$answer"; then
        printf 'not seen: %s; the check says: %s\n' "$3" "$answer"
        failures=$((failures + 1))
    fi
    build_house
}

accepts() { # accepts WHY
    local answer
    if ! answer=$(python3 "$check" "$house"); then
        printf 'refuses %s: %s\n' "$1" "$answer"
        failures=$((failures + 1))
    fi
}

build_house
accepts "a good house"
plant core/roots.f90 's/  !! a function//'      'src/core/roots.f90:30: find: f$'
plant core/roots.f90 's/  !! the bracket, m//'  'find: high$'
plant core/roots.f90 's/  !! the bracket, m//'  'find: low$'
plant core/roots.f90 's/  !! the bracket, m/  ! the bracket, m/' 'find: low$'
plant core/roots.f90 's/  !! the bracket, m/  !!/' 'find: low$'
plant core/roots.f90 '/where f/d'               'src/core/roots.f90:32: find: root$'
plant core/roots.f90 's/  !! "any" number//'    'twice_real: x$'
plant core/roots.f90 's/  !! any number//'      'twice_integer: n$'
plant core/roots.f90 's/  !! m$//'              'value_i: x$'
plant core/roots.f90 's/lapack$/lapack, ours/'  'ours: x$'
plant core/roots.f90 '/private/d'               'ours: x$'
plant systems/system.f90 's/  !! rad//'         'energy_i: q$'
plant systems/system.f90 's/  !! its name//'    'show: text$'
plant systems/system.f90 's/  !! of the column//' 'unit_of: i$'
plant systems/system.f90 's/  !! m$//'          'length: l$'
plant systems/system.f90 's/, private :: secret/ :: secret/' 'secret: text$'
plant systems/system.f90 's/, extends(system_t)//' 'energy_of_pendulum: q$'

sed -i 's/  !! rad//' "$house/src/systems/system.f90"
echo "systems 1" >"$house/.ci/arguments_left"
accepts "what was left"
echo "core 1" >"$house/.ci/arguments_left"
plant core/roots.f90 's/  !! a function//' 'systems: 1 arguments .* 0 were left'
sed -i 's/  !! rad//' "$house/src/systems/system.f90"
echo "systems 2" >"$house/.ci/arguments_left"
python3 "$check" "$house/" --tighten >/dev/null
[ "$(cat "$house/.ci/arguments_left")" = "systems 1" ] || { echo "--tighten does not"; failures=$((failures + 1)); }

[ "$failures" -eq 0 ] && echo "every planted violation was seen"
exit $((failures > 0))
