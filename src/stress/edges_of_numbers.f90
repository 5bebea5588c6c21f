module lagrangia_edges_of_numbers
    !! The smallest and the largest numbers: denormals, overflow, what is no number.
    use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
    use lagrangia_errors, only: error_t
    use lagrangia_integrator, only: integrator_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_ledger, only: ledger_t
    use lagrangia_observer, only: observer_box_t, observer_t
    use lagrangia_oscillator, only: oscillator_t
    use lagrangia_rotating_wire, only: rotating_wire_t
    use lagrangia_run, only: run
    use lagrangia_system, only: system_t
    use lagrangia_time_grid, only: new_time_grid, time_grid_t
    implicit none (type, external)
    private
    public :: stress_edges

    real(dp), parameter :: dt = 0.02_dp  !! s

    type, extends(observer_t) :: last_t
        !! The last state that was seen.
        real(dp) :: x = 0.0_dp
    contains
        procedure :: observe
    end type last_t

contains

    subroutine stress_edges(method, verdicts)
        !! A linear motion does not know its amplitude; one that grows without bound is stopped
        !! where it leaves the numbers, with status 3 and the last good state.
        class(integrator_t), intent(inout) :: method  !! that is measured; prepared here
        type(ledger_t), intent(inout) :: verdicts  !! gets the lines
        real(dp), parameter :: last_digit = 2.0_dp**(-1074)
        type(oscillator_t) :: oscillator
        type(rotating_wire_t) :: wire
        type(error_t), allocatable :: error
        real(dp) :: x, plain
        integer :: status

        call oscillator%configure([1.0_dp, 1.0_dp], error)
        call wire%configure([1.0_dp, 1.0_dp], error)
        call end_of_run(method, oscillator, 1.0_dp, 20.0_dp, plain, status)
        call end_of_run(method, oscillator, 2.0_dp**1000, 20.0_dp, x, status)
        call verdicts%judge("amplitude 2^1000", "difference from amplitude 1", &
                            abs(x/2.0_dp**1000 - plain), 0.0_dp, 0.0_dp, "its energy overflows")
        call end_of_run(method, oscillator, 2.0_dp**(-1030), 20.0_dp, x, status)
        call verdicts%judge("amplitude 2^-1030", "difference, in last digits", &
                            abs(x - plain*2.0_dp**(-1030))/last_digit, most=1000.0_dp, &
                            remark="a denormal has 44 bits left")
        call end_of_run(method, wire, 1.0_dp, 1000.0_dp, x, status)
        call verdicts%judge("overflow", "ln(2x) of the last good state", &
                            log(0.5_dp*x) + log(4.0_dp), 707.0_dp, 710.5_dp, &
                            "x = cosh t; RK4 adds up six times as much")
        call verdicts%judge("overflow", "status", real(status, dp), 3.0_dp, 3.0_dp)
        call end_of_run(method, oscillator, ieee_value(x, ieee_quiet_nan), 1.0_dp, x, status)
        call verdicts%judge("start at NaN", "status", real(status, dp), 3.0_dp, 3.0_dp)
    end subroutine stress_edges

    subroutine end_of_run(method, system, x0, duration, x, status)
        !! From rest at `x0`, looked at every 50 steps.
        class(integrator_t), intent(inout) :: method
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: x0, duration
        real(dp), intent(out) :: x
        integer, intent(out) :: status
        type(observer_box_t) :: observers(1)
        type(last_t), target :: last
        type(error_t), allocatable :: error
        type(time_grid_t) :: plan
        real(dp) :: q(1), v(1)

        observers(1)%item => last
        q = x0
        v = 0.0_dp
        call new_time_grid(plan, 0.0_dp, dt, duration, 50_i8, error)
        call run(system, method, plan, observers, q, v, error)
        x = last%x
        status = 0
        if (allocated(error)) status = error%status
    end subroutine end_of_run

    subroutine observe(self, system, t, q, v, error)
        !! Remember it.
        class(last_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t, q(system%ndof), v(system%ndof)
        type(error_t), allocatable, intent(out) :: error

        self%x = q(1)
    end subroutine observe
end module lagrangia_edges_of_numbers
