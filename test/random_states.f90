module random_states
    !! Parameters and states at random, the same ones in every run: the library's, asserted good.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
    use funit, only: assertFalse, assertTrue
    use lagrangia_description, only: description_t
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp
    use lagrangia_random_draws, only: random_t
    use lagrangia_system, only: default_values, system_t
    implicit none (type, external)
    private
    public :: draw_parameters, draw_state, restart_random, uniform

    type(random_t) :: random

contains

    subroutine draw_parameters(system, edges)
        !! Parameters inside their domains; with `edges` also on their edges.
        class(system_t), intent(inout) :: system
        logical, intent(in) :: edges
        type(description_t) :: d
        type(error_t), allocatable :: error
        real(dp), allocatable :: values(:), read_back(:)

        call random%parameters(system, edges, values, error)
        call system%describe(d)
        call assertFalse(allocated(error), trim(d%name)//": parameters inside their domains")
        allocate (read_back, source=default_values(d))
        call assertTrue(all(abs(read_back - values) <= 0.0_dp .or. ieee_is_nan(values)), &
                        trim(d%name)//": each parameter goes where it belongs")
    end subroutine draw_parameters

    subroutine draw_state(system, t, q, v)
        !! A time, coordinates, and velocities that the constraints allow.
        class(system_t), intent(in) :: system
        real(dp), intent(out) :: t
        real(dp), allocatable, intent(out) :: q(:), v(:)
        type(error_t), allocatable :: error

        call random%state(system, t, q, v, error)
        call assertFalse(allocated(error), "velocities that the constraints allow")
    end subroutine draw_state

    subroutine restart_random()
        !! Begin the sequence of `uniform` again.
        random = random_t()
    end subroutine restart_random

    function uniform(lower, upper) result(x)
        !! The next number between `lower` and `upper`.
        real(dp), intent(in) :: lower, upper
        real(dp) :: x

        call random%uniform(lower, upper, x)
    end function uniform
end module random_states
