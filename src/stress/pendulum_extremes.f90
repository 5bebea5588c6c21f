module lagrangia_pendulum_extremes
    !! Pendulums where digits are lost: near the separatrix, at angles of many turns, and where the
    !! bobs of a double pendulum differ by many powers of ten.
    use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
    use lagrangia_description, only: description_t
    use lagrangia_errors, only: error_t
    use lagrangia_integrator, only: dense_integrator_t
    use lagrangia_kinds, only: dp, i8, qp
    use lagrangia_ledger, only: ledger_t
    use lagrangia_observer, only: observer_t
    use lagrangia_pendulum, only: pendulum_t
    use lagrangia_printed_table, only: short
    use lagrangia_reference, only: reference_t
    use lagrangia_small_oscillations, only: find_modes, modes_t
    use lagrangia_system, only: default_values, system_t
    use lagrangia_text, only: to_text
    use lagrangia_vectors, only: farthest
    implicit none (type, external)
    private
    public :: exact_period, stress_large_angles, stress_separatrix
    public :: exact_omega2, stress_mass_ratios, stress_massless

    real(qp), parameter :: pi = acos(-1.0_qp)

    real(dp), parameter :: l1 = 1.0_dp, l2 = 0.7_dp, g = 9.81_dp

contains

    subroutine stress_separatrix(system, method, verdicts)
        !! Released from rest at \(\theta_0 = \pi - 10^{-k}\). The closed form has every digit of
        !! the period; a run has those that the rounding of \(\theta\) near \(\pi\) leaves, and
        !! needs a tolerance that sees them.
        class(system_t), intent(in) :: system  !! with its parameters
        class(dense_integrator_t), intent(inout) :: method  !! with its tolerance; prepared here
        type(ledger_t), intent(inout) :: verdicts  !! gets the lines
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
    end subroutine stress_separatrix

    function exact_period(system, theta0) result(period)
        !! \(2\pi/[\omega\,\mathrm{agm}(1, \cos(\theta_0/2))]\) in quadruple precision.
        class(system_t), intent(in) :: system  !! parameters m, l, g
        real(dp), intent(in) :: theta0  !! amplitude, rad
        real(dp) :: period
        type(description_t) :: d
        real(dp) :: p(3)
        real(qp) :: a, b, next

        call system%describe(d)
        p = default_values(d)
        a = 1.0_qp
        b = cos(0.5_qp*theta0)
        do while (a - b > 1e-20_qp*a)
            next = 0.5_qp*(a + b)
            b = sqrt(a*b)
            a = next
        end do
        period = real(2.0_qp*pi/(sqrt(real(p(3), qp)/p(2))*(0.5_qp*(a + b))), dp)
    end function exact_period

    subroutine stress_large_angles(system, method, verdicts)
        !! Wound up by \(n\) turns: against the same motion with the turns taken off exactly. The
        !! angle's last digit is worth `spacing(theta)`, for the start and at every step.
        class(system_t), intent(in) :: system  !! with its parameters
        class(dense_integrator_t), intent(inout) :: method  !! with its tolerance; prepared here
        type(ledger_t), intent(inout) :: verdicts  !! gets the lines
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
    end subroutine stress_large_angles

    subroutine stress_mass_ratios(system, method, fast_time, verdicts, watcher)
        !! Frequencies against the formula in quadruple precision, to full relative accuracy; and
        !! the motion against the pendulum that is left where one bob weighs nothing: the heavy
        !! upper one on its rod, or, with a heavy lower one, both rods in line.
        class(system_t), intent(inout) :: system  !! its parameters are set as needed
        class(dense_integrator_t), intent(inout) :: method  !! with its tolerance; prepared here
        real(dp), intent(in) :: fast_time  !! s, of the motion with fast oscillations
        type(ledger_t), intent(inout) :: verdicts  !! gets the lines
        class(observer_t), intent(inout), optional :: watcher  !! told how far it is
        integer, parameter :: powers(*) = [-12, -8, -4, 0, 4, 8, 12]
        type(error_t), allocatable :: error
        real(dp) :: phase
        integer :: i

        do i = 1, size(powers)
            call system%configure([10.0_dp**powers(i), 1.0_dp, l1, l2, g], error)
            call verdicts%judge("m1/m2 = 1e"//to_text(powers(i)), "frequencies: relative error", &
                                frequency_error(system, 10.0_dp**powers(i), 1.0_dp), &
                                most=8.0_dp*epsilon(g))
        end do
        call system%configure([1e12_dp, 1.0_dp, l1, l2, g], error)
        call verdicts%judge("m1/m2 = 1e12", "theta1 after 5 s: from a pendulum", &
                            distance_from_pendulum(system, method, [0.8_dp, 0.3_dp], l1, 5.0_dp), &
                            most=1e-10_dp)
        call system%configure([1e-12_dp, 1.0_dp, l1, l2, g], error)
        phase = fast_time*sqrt(maxval(exact_omega2(1e-12_dp, 1.0_dp)))
        call verdicts%judge("m1/m2 = 1e-12", "theta1 of both rods in line: from one", &
                            distance_from_pendulum(system, method, [0.8_dp, 0.8_dp], l1 + l2, &
                                                   fast_time, watcher), &
                            most=100.0_dp*method%tolerance*phase, remark= &
                            short(phase/6.283_dp, 2)//" fast oscillations, unseen")
    end subroutine stress_mass_ratios

    function frequency_error(system, m1, m2) result(worst)
        !! The largest relative error of the two.
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: m1, m2
        real(dp) :: worst, omega2(2)
        type(modes_t) :: modes
        type(error_t), allocatable :: error

        worst = huge(worst)
        call find_modes(system, [0.0_dp, 0.0_dp], .true., modes, error)
        if (allocated(error)) return
        omega2 = exact_omega2(m1, m2)
        worst = farthest(sqrt(modes%omega2)/sqrt(omega2), [1.0_dp, 1.0_dp])
    end function frequency_error

    pure function exact_omega2(m1, m2) result(omega2)
        !! \(\omega^2_\pm\), of sum \(g(m_1+m_2)(\ell_1+\ell_2)/(m_1\ell_1\ell_2)\) and product
        !! \(g^2(m_1+m_2)/(m_1\ell_1\ell_2)\), without cancellation.
        real(dp), intent(in) :: m1, m2  !! kg
        real(dp) :: omega2(2)
        real(qp) :: share, half, product, larger

        share = 1.0_qp + real(m2, qp)/m1
        half = 0.5_qp*g*share*(real(l1, qp) + l2)/(real(l1, qp)*l2)
        product = real(g, qp)**2*share/(real(l1, qp)*l2)
        larger = half + sqrt(half**2 - product)
        omega2 = real([product/larger, larger], dp)
    end function exact_omega2

    function distance_from_pendulum(system, method, start, length, t_end, watcher) &
        result(distance)
        !! Of the first angle, released from rest, from a simple pendulum's.
        class(system_t), intent(in) :: system
        class(dense_integrator_t), intent(inout) :: method
        real(dp), intent(in) :: start(2), length, t_end
        class(observer_t), intent(inout), optional :: watcher
        real(dp) :: distance, q(2), v(2), q_true(1), v_true(1)
        type(pendulum_t) :: pendulum
        class(reference_t), allocatable :: reference
        type(error_t), allocatable :: error

        q = start
        v = 0.0_dp
        call move(method, system, t_end, q, v, watcher)
        call pendulum%configure([1.0_dp, length, g], error)
        call pendulum%closed_form(0.0_dp, start(:1), [0.0_dp], reference)
        call reference%state_at(t_end, q_true, v_true)
        distance = abs(q(1) - q_true(1))
    end function distance_from_pendulum

    subroutine stress_massless(system, verdicts)
        !! \(m_1 \to 0\): one mode gets infinitely fast as \(\sqrt{m_2/m_1}\), the other becomes
        !! that of a rod \(\ell_1 + \ell_2\) long; \(m_1 = 0\) itself is refused.
        class(system_t), intent(inout) :: system  !! its parameters are set as needed
        type(ledger_t), intent(inout) :: verdicts  !! gets the lines
        integer, parameter :: powers(*) = [-3, -6, -12, -100, -300]
        type(error_t), allocatable :: error
        type(modes_t) :: modes
        real(dp) :: m1
        integer :: i

        do i = 1, size(powers)
            m1 = 10.0_dp**powers(i)
            call system%configure([m1, 1.0_dp, l1, l2, g], error)
            call find_modes(system, [0.0_dp, 0.0_dp], .true., modes, error)
            if (allocated(error)) allocate (modes%omega2(2), source=0.0_dp)
            call verdicts%judge("m1 = 1e"//to_text(powers(i)), "slow mode: from its limit", &
                                abs(modes%omega2(1)*(l1 + l2)/g - 1.0_dp), &
                                most=m1 + 8.0_dp*epsilon(m1))
            call verdicts%judge("m1 = 1e"//to_text(powers(i)), "fast mode: from its law", &
                                abs(modes%omega2(2)*m1*l1*l2/(g*(l1 + l2)) - 1.0_dp), &
                                most=m1 + 8.0_dp*epsilon(m1))
        end do
        call system%configure([0.0_dp, 1.0_dp, l1, l2, g], error)
        call verdicts%judge("m1 = 0", "is refused", merge(1.0_dp, 0.0_dp, allocated(error)), &
                            1.0_dp, 1.0_dp)
    end subroutine stress_massless

    subroutine move(method, system, t_end, q, v, watcher)
        !! From time 0 to `t_end`; NaN where the method gives up.
        class(dense_integrator_t), intent(inout) :: method
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t_end
        real(dp), intent(inout) :: q(system%ndof), v(system%ndof)
        class(observer_t), intent(inout), optional :: watcher
        integer(i8), parameter :: parts = 1000
        type(error_t), allocatable :: error

        call method%prepare(system, error)
        if (.not. allocated(error)) call method%start(system, 0.0_dp, q, v, t_end)
        do while (.not. allocated(error))
            if (method%t_new >= t_end) exit
            call method%step(system, error)
            if (present(watcher)) call watcher%tick(int(parts*(method%t_new/t_end), i8), parts)
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
end module lagrangia_pendulum_extremes
