module lagrangia_dense_motion
    !! Single motions by a method with dense output: to a time, or to where a coordinate is zero.
    use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
    use lagrangia_errors, only: error_t
    use lagrangia_integrator, only: dense_integrator_t
    use lagrangia_kinds, only: dp
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: move, time_of_zero

contains

    subroutine move(method, system, t_end, q, v)
        !! From time 0 to `t_end`; NaN where the method gives up.
        class(dense_integrator_t), intent(inout) :: method
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t_end
        real(dp), intent(inout) :: q(system%ndof), v(system%ndof)
        type(error_t), allocatable :: error

        call method%prepare(system, error)
        if (.not. allocated(error)) call method%start(system, 0.0_dp, q, v, t_end)
        do while (.not. allocated(error))
            if (method%t_new >= t_end) exit
            call method%step(system, error)
        end do
        if (allocated(error)) then
            q = ieee_value(t_end, ieee_quiet_nan)
            v = q
        else
            call method%state_at(t_end, q, v)
        end if
    end subroutine move

    function time_of_zero(method, system, q0, v0, latest) result(t)
        !! When the first coordinate, positive at the start, becomes zero; NaN where it does not
        !! before `latest`.
        class(dense_integrator_t), intent(inout) :: method
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: q0(system%ndof), v0(system%ndof), latest
        real(dp) :: t
        type(error_t), allocatable :: error
        real(dp), dimension(system%ndof) :: q, v
        real(dp) :: between(2)
        integer :: i

        t = ieee_value(t, ieee_quiet_nan)
        call method%prepare(system, error)
        if (allocated(error)) return
        call method%start(system, 0.0_dp, q0, v0, latest)
        do
            if (method%t_new >= latest) return
            call method%step(system, error)
            if (allocated(error)) return
            call method%state_at(method%t_new, q, v)
            if (q(1) <= 0.0_dp) exit
        end do
        between = [method%t_old, method%t_new]
        do i = 1, 100
            t = 0.5_dp*sum(between)
            call method%state_at(t, q, v)
            between(merge(1, 2, q(1) > 0.0_dp)) = t
        end do
    end function time_of_zero
end module lagrangia_dense_motion
