module lagrangia_pendulum_extremes
    !! The pendulum where digits are lost: near the separatrix, and at angles of many turns.
    use lagrangia_bench_table, only: short
    use lagrangia_dense_motion, only: move, time_of_zero
    use lagrangia_description, only: description_t
    use lagrangia_errors, only: error_t
    use lagrangia_integrator, only: dense_integrator_t
    use lagrangia_kinds, only: dp, qp
    use lagrangia_reference, only: reference_t
    use lagrangia_system, only: default_values, system_t
    use lagrangia_text, only: to_text
    use lagrangia_verdicts, only: verdicts_t
    implicit none (type, external)
    private
    public :: exact_period, judge_large_angles, judge_separatrix

    real(qp), parameter :: pi = acos(-1.0_qp)

contains

    subroutine judge_separatrix(system, method, verdicts)
        !! Released from rest at \(\theta_0 = \pi - 10^{-k}\). The closed form has every digit of
        !! the period; a run has those that the rounding of \(\theta\) near \(\pi\) leaves, and
        !! needs a tolerance that sees them.
        class(system_t), intent(in) :: system
        class(dense_integrator_t), intent(inout) :: method
        type(verdicts_t), intent(inout) :: verdicts
        integer, parameter :: powers(*) = [1, 3, 6, 9, 12, 15]
        class(reference_t), allocatable :: reference
        character(:), allocatable :: of
        real(dp) :: theta0, period, closed, run
        integer :: i

        do i = 1, size(powers)
            of = "pi - 1e-"//to_text(powers(i))
            theta0 = real(pi, dp) - 10.0_dp**(-powers(i))
            period = exact_period(system, theta0)
            call system%closed_form(0.0_dp, [theta0], [0.0_dp], reference)
            closed = 0.0_dp
            if (allocated(reference)) closed = reference%period
            call verdicts%judge(of, "period, closed form: relative error", &
                                abs(closed/period - 1.0_dp), most=4.0_dp*epsilon(period), &
                                remark="T = "//short(period, 8)//" s")
            if (powers(i) > 12) cycle
            run = 4.0_dp*time_of_zero(method, system, [theta0], [0.0_dp], period)
            call verdicts%judge(of, "period, run: relative error", abs(run/period - 1.0_dp), &
                                most=4.0_dp*epsilon(period)*10.0_dp**powers(i) + 1e-12_dp, &
                                remark="allowed: eps*1e"//to_text(powers(i))//", a digit a power")
        end do
    end subroutine judge_separatrix

    function exact_period(system, theta0) result(period)
        !! \(2\pi/[\omega\,\mathrm{agm}(1, \cos(\theta_0/2))]\) in quadruple precision.
        class(system_t), intent(in) :: system  !! parameters m, l, g
        real(dp), intent(in) :: theta0
        real(dp) :: period
        type(description_t) :: d
        real(dp) :: p(3)
        real(qp) :: a, b, next

        call system%describe(d)
        p = default_values(d)
        a = 1.0_qp
        b = cos(0.5_qp*theta0)
        do while (abs(a - b) > 1e-20_qp*a)
            next = 0.5_qp*(a + b)
            b = sqrt(a*b)
            a = next
        end do
        period = real(2.0_qp*pi/(sqrt(real(p(3), qp)/p(2))*(0.5_qp*(a + b))), dp)
    end function exact_period

    subroutine judge_large_angles(system, method, verdicts)
        !! Wound up by \(n\) turns: against the same motion with the turns taken off exactly. The
        !! angle's last digit is worth `spacing(theta)`, for the start and at every step.
        class(system_t), intent(in) :: system
        class(dense_integrator_t), intent(inout) :: method
        type(verdicts_t), intent(inout) :: verdicts
        real(dp), parameter :: angles(*) = [1e3_dp, 1e6_dp, 1e9_dp], t_end = 10.0_dp
        real(dp) :: q(1), v(1), small(1), v_small(1), difference
        real(qp) :: wound
        integer :: i

        do i = 1, size(angles)
            q = angles(i)
            v = 0.0_dp
            wound = 2.0_qp*pi*anint(real(q(1), qp)/(2.0_qp*pi))
            small = real(q(1) - wound, dp)
            v_small = v
            call move(method, system, t_end, q, v)
            call move(method, system, t_end, small, v_small)
            difference = real(abs(q(1) - wound - small(1)), dp)
            call verdicts%judge("theta = "//to_text(angles(i)), &
                                "difference after 10 s, last digits", &
                                difference/spacing(angles(i)), most=100.0_dp, remark= &
                                "a last digit is "//short(spacing(angles(i)), 2)//" rad")
        end do
    end subroutine judge_large_angles
end module lagrangia_pendulum_extremes
