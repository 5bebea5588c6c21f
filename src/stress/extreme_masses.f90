module lagrangia_extreme_masses
    !! The double pendulum whose bobs differ by many powers of ten: frequencies and motion.
    use lagrangia_bench_table, only: short
    use lagrangia_dense_motion, only: move
    use lagrangia_errors, only: error_t
    use lagrangia_integrator, only: dense_integrator_t
    use lagrangia_kinds, only: dp, qp
    use lagrangia_pendulum, only: pendulum_t
    use lagrangia_reference, only: reference_t
    use lagrangia_small_oscillations, only: find_modes, modes_t
    use lagrangia_system, only: system_t
    use lagrangia_text, only: to_text
    use lagrangia_verdicts, only: verdicts_t
    implicit none (type, external)
    private
    public :: exact_omega2, judge_mass_ratios, judge_massless

    real(dp), parameter :: l1 = 1.0_dp, l2 = 0.7_dp, g = 9.81_dp

contains

    subroutine judge_mass_ratios(system, method, fast_time, verdicts)
        !! Frequencies against the formula in quadruple precision, to full relative accuracy; and
        !! the motion against the pendulum that is left where one bob weighs nothing: the heavy
        !! upper one on its rod, or, with a heavy lower one, both rods in line.
        class(system_t), intent(inout) :: system
        class(dense_integrator_t), intent(inout) :: method
        real(dp), intent(in) :: fast_time  !! s, of the motion with fast oscillations
        type(verdicts_t), intent(inout) :: verdicts
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
                                                   fast_time), &
                            most=100.0_dp*method%tolerance*phase, remark= &
                            short(phase/6.283_dp, 2)//" fast oscillations, unseen")
    end subroutine judge_mass_ratios

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
        worst = maxval(abs(sqrt(modes%omega2)/sqrt(omega2) - 1.0_dp))
    end function frequency_error

    pure function exact_omega2(m1, m2) result(omega2)
        !! \(\omega^2_\pm\), of sum \(g(m_1+m_2)(\ell_1+\ell_2)/(m_1\ell_1\ell_2)\) and product
        !! \(g^2(m_1+m_2)/(m_1\ell_1\ell_2)\), without cancellation.
        real(dp), intent(in) :: m1, m2
        real(dp) :: omega2(2)
        real(qp) :: share, half, product, larger

        share = 1.0_qp + real(m2, qp)/m1
        half = 0.5_qp*g*share*(real(l1, qp) + l2)/(real(l1, qp)*l2)
        product = real(g, qp)**2*share/(real(l1, qp)*l2)
        larger = half + sqrt(half**2 - product)
        omega2 = real([product/larger, larger], dp)
    end function exact_omega2

    function distance_from_pendulum(system, method, start, length, t_end) result(distance)
        !! Of the first angle, released from rest, from a simple pendulum's.
        class(system_t), intent(in) :: system
        class(dense_integrator_t), intent(inout) :: method
        real(dp), intent(in) :: start(2), length, t_end
        real(dp) :: distance, q(2), v(2), q_true(1), v_true(1)
        type(pendulum_t) :: pendulum
        class(reference_t), allocatable :: reference
        type(error_t), allocatable :: error

        q = start
        v = 0.0_dp
        call move(method, system, t_end, q, v)
        call pendulum%configure([1.0_dp, length, g], error)
        call pendulum%closed_form(0.0_dp, start(:1), [0.0_dp], reference)
        call reference%state_at(t_end, q_true, v_true)
        distance = abs(q(1) - q_true(1))
    end function distance_from_pendulum

    subroutine judge_massless(system, verdicts)
        !! \(m_1 \to 0\): one mode gets infinitely fast as \(\sqrt{m_2/m_1}\), the other becomes
        !! that of a rod \(\ell_1 + \ell_2\) long; \(m_1 = 0\) itself is refused.
        class(system_t), intent(inout) :: system
        type(verdicts_t), intent(inout) :: verdicts
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
    end subroutine judge_massless
end module lagrangia_extreme_masses
