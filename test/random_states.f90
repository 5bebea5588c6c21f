module random_states
    !! Parameters and states at random, the same ones in every run.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_nan, ieee_quiet_nan, ieee_value
    use funit, only: assertFalse, assertTrue
    use lagrangia_description, only: description_t
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_system, only: default_values, system_t
    implicit none (type, external)
    private
    public :: draw_parameters, draw_state, restart_random, uniform

    integer(i8), parameter :: first_seed = 20110901_i8
    integer(i8) :: seed = first_seed

contains

    subroutine draw_parameters(system, edges)
        !! Parameters unlike 1 and unlike each other; with `edges` some lie on the edge of their
        !! domain, or are zero, and some that have a formula are left to it.
        class(system_t), intent(inout) :: system
        logical, intent(in) :: edges
        type(description_t) :: d
        type(error_t), allocatable :: error
        real(dp), allocatable :: values(:), read_back(:)
        real(dp) :: lowest, chance
        integer :: i, j, k

        call system%describe(d)
        values = default_values(d)
        k = 0
        do i = 1, size(d%parameters)
            associate (p => d%parameters(i))
                lowest = max(p%lower, -2.0_dp)
                if (p%open_lower) lowest = p%lower + 0.2_dp
                do j = 1, p%count
                    k = k + 1
                    values(k) = uniform(lowest, min(p%upper, lowest + 4.0_dp))
                    if (p%whole) values(k) = anint(values(k))
                    chance = uniform(0.0_dp, 1.0_dp)
                    if (.not. edges .or. chance > 0.4_dp) cycle
                    if (len_trim(p%computed) > 0) then
                        values(k) = ieee_value(1.0_dp, ieee_quiet_nan)
                    else if (.not. p%open_lower) then
                        values(k) = merge(p%lower, 0.0_dp, p%lower > -huge(1.0_dp))
                    end if
                end do
            end associate
        end do
        call system%configure(values, error)
        call assertFalse(allocated(error), trim(d%name)//": parameters inside their domains")
        call system%describe(d)
        allocate (read_back, source=default_values(d))
        call assertTrue(all(abs(read_back - values) <= 0.0_dp .or. ieee_is_nan(values)), &
                        trim(d%name)//": each parameter goes where it belongs")
    end subroutine draw_parameters

    subroutine draw_state(system, t, q, v)
        !! A time, coordinates, and velocities that the constraints allow.
        class(system_t), intent(in) :: system
        real(dp), intent(out) :: t
        real(dp), allocatable, intent(out) :: q(:), v(:)
        real(dp) :: given(system%ndof - system%constraints)
        type(error_t), allocatable :: error
        integer :: i

        allocate (q(system%ndof), v(system%ndof))
        t = uniform(-2.0_dp, 3.0_dp)
        do i = 1, system%ndof
            q(i) = uniform(-3.0_dp, 3.0_dp)
        end do
        do i = 1, size(given)
            given(i) = uniform(-3.0_dp, 3.0_dp)
        end do
        call system%complete_velocities(t, q, given, v, error)
        call assertFalse(allocated(error), "velocities that the constraints allow")
    end subroutine draw_state

    subroutine restart_random()
        !! Begin the sequence of `uniform` again.
        seed = first_seed
    end subroutine restart_random

    function uniform(lower, upper) result(x)
        !! The next number between `lower` and `upper` (Park & Miller's minimal standard).
        real(dp), intent(in) :: lower, upper
        real(dp) :: x
        integer(i8), parameter :: modulus = 2147483647_i8

        seed = mod(48271_i8*seed, modulus)
        x = lower + (upper - lower)*real(seed, dp)/modulus
    end function uniform
end module random_states
