module lagrangia_errata
    !! The slips in the lecture notes in numbers: each equation as it is written, beside what
    !! follows from the notes' own Lagrangian, at many states of the real motion.
    use lagrangia_driven_pendulum, only: driven_pendulum_t
    use lagrangia_errata_cart, only: cart_numbers, residual_is
    use lagrangia_errors, only: error_t
    use lagrangia_hyperdual, only: exp, hyperdual_t, operator(*), operator(**), operator(+)
    use lagrangia_kinds, only: dp
    use lagrangia_lagrange, only: accelerations_from_lagrangian, euler_lagrange_t, &
                                  expand_lagrangian
    use lagrangia_oscillator, only: oscillator_t
    use lagrangia_point_motion, only: expand_points, point_motion_t
    use lagrangia_report, only: report_t
    use lagrangia_wedge, only: wedge_t
    implicit none (type, external)
    private
    public :: slip_numbers

    real(dp), parameter :: rounding = 1e-12_dp
    real(dp), parameter :: m1 = 1.3_dp, m2 = 0.7_dp, l = 0.9_dp, g = 9.81_dp

contains

    subroutine slip_numbers(id, report, error)
        !! Add the rows of slip `id` to the report; none if there is nothing to compute.
        character(*), intent(in) :: id
        type(report_t), intent(inout) :: report
        type(error_t), allocatable, intent(out) :: error

        select case (id)
        case ("E1", "E2", "E3", "E4", "E6"); call cart_numbers(id, report, error)
        case ("E11"); call potential_with_time(report, error)
        case ("E12"); call chain_rule(report)
        case ("E18"); call momentum(report, error)
        case ("E20"); call energy_of_the_wedge(report, error)
        case ("E21"); call mass_of_the_wedge(report, error)
        case default; return
        end select
    end subroutine slip_numbers

    subroutine potential_with_time(report, error)
        !! The driven pendulum: \(V = m g y\) has no time, \(V(\theta, t)\) has, as the notes say.
        type(report_t), intent(inout) :: report
        type(error_t), allocatable, intent(out) :: error
        real(dp), parameter :: t = 0.7_dp, q(1) = 0.9_dp, v(1) = -1.3_dp, amplitude = 0.1_dp
        real(dp), parameter :: w = 5.0_dp
        type(driven_pendulum_t) :: system
        type(point_motion_t) :: motion, sooner
        real(dp) :: a(1), none(0)

        call report%section("driven pendulum, m = 1.3 kg, l = 0.9 m, pivot at 0.1 m cos(5 t)")
        call system%configure([m1, l, g, amplitude, w], error)
        if (allocated(error)) return
        call accelerations_from_lagrangian(system, t, q, v, a, none, error)
        if (allocated(error)) return
        call expand_points(system, t, q, v, a, motion)
        call expand_points(system, 0.0_dp, q, v, a, sooner)
        call report%equal("force at t = 0.7 s, F_y = -dV/dy = -m g  [N]", motion%force(2), &
                          -m1*g, rounding)
        call report%equal("and at t = 0: V(x) has no t  [N]", sooner%force(2), -m1*g, rounding)
        call report%equal("dV/dt at fixed theta = m g y_p_dot  [W]", &
                          -dot_product(motion%force, motion%drift), &
                          -m1*g*amplitude*w*sin(w*t), rounding)
        call report%equal("is V(theta, t) free of t?", -dot_product(motion%force, motion%drift), &
                          0.0_dp, rounding, control=.true.)
        call report%equal("theta_ddot = -(g + y_p_ddot) sin(theta)/l", a(1), &
                          -(g - amplitude*w**2*cos(w*t))*sin(q(1))/l, rounding)
    end subroutine potential_with_time

    subroutine chain_rule(report)
        !! \(F = q_1 q_2^2 + t\,e^{q_1}\) along a path.
        type(report_t), intent(inout) :: report
        real(dp), parameter :: q(2) = [0.4_dp, -0.9_dp], v(2) = [0.7_dp, 1.9_dp], time = 0.6_dp
        real(dp) :: slope(2), rate, along
        integer :: k

        call report%section("F = q1 q2^2 + t exp(q1) at q = (0.4, -0.9), q_dot = (0.7, "// &
                            "1.9), t = 0.6")
        do k = 1, 2
            slope(k) = rate_of_f(merge(1.0_dp, 0.0_dp, [1, 2] == k), 0.0_dp)
        end do
        rate = rate_of_f([0.0_dp, 0.0_dp], 1.0_dp)
        along = rate_of_f(v, 1.0_dp)
        call report%equal("dF/dt = sum of dF/dq_k q_k_dot, + dF/dt", along, &
                          dot_product(slope, v) + rate, rounding)
        call report%equal("as it reads, without q_k_dot, is it that?", along, &
                          sum(slope) + rate, rounding, control=.true.)
    contains
        pure function rate_of_f(dq, dt) result(f_dot)
            real(dp), intent(in) :: dq(2), dt
            real(dp) :: f_dot
            type(hyperdual_t) :: x(2), t, f

            x%re = q
            x%d1 = dq
            t%re = time
            t%d1 = dt
            f = x(1)*x(2)**2 + t*exp(x(1))
            f_dot = f%d1
        end function rate_of_f
    end subroutine chain_rule

    subroutine momentum(report, error)
        !! \(\partial L/\partial\dot x\) of the oscillator.
        type(report_t), intent(inout) :: report
        type(error_t), allocatable, intent(out) :: error
        type(oscillator_t) :: system
        type(euler_lagrange_t) :: terms
        real(dp) :: x_ddot(1)

        call report%section("m = 1.3 kg, k = 5.2 N/m; x = 0.5 m, x_dot = 0.8 m/s")
        call system%configure([m1, 5.2_dp], error)
        if (allocated(error)) return
        call expand_lagrangian(system, 0.0_dp, [0.5_dp], [0.8_dp], terms)
        call system%accelerations(0.0_dp, [0.5_dp], [0.8_dp], x_ddot)
        call report%equal("dL/dx_dot = m x_dot  [kg m/s]", terms%dl_dv(1), m1*0.8_dp, rounding)
        call report%equal("as written, is it m d(x_dot)/dt?", terms%dl_dv(1), m1*x_ddot(1), &
                          rounding, control=.true.)
    end subroutine momentum

    subroutine energy_of_the_wedge(report, error)
        !! \(T_M\) must be quadratic in \(\dot q_2\).
        type(report_t), intent(inout) :: report
        type(error_t), allocatable, intent(out) :: error
        type(wedge_t) :: system
        type(euler_lagrange_t) :: terms

        call report%section("m = 0.7 kg, M = 1.3 kg")
        call system%configure([m2, m1, 0.5_dp, g], error)
        if (allocated(error)) return
        call expand_lagrangian(system, 0.0_dp, [0.0_dp, 0.0_dp], [0.8_dp, 0.3_dp], terms)
        call report%equal("d2L/dq2_dot^2 = M + m  [kg]", terms%mass(2, 2), m1 + m2, rounding)
        call report%equal("as written, is it m alone?", terms%mass(2, 2), m2, rounding, &
                          control=.true.)
    end subroutine energy_of_the_wedge

    subroutine mass_of_the_wedge(report, error)
        !! M for m: the acceleration of the block along the incline.
        type(report_t), intent(inout) :: report
        type(error_t), allocatable, intent(out) :: error
        real(dp), parameter :: slopes(4) = [0.2_dp, 0.5_dp, 0.9_dp, 1.3_dp], m = m2, big = m1
        real(dp), parameter :: zero(2) = 0.0_dp
        type(wedge_t) :: system
        real(dp) :: a(2), along(4)
        integer :: k

        call report%section("m = 0.7 kg, M = 1.3 kg; inclines of 0.2, 0.5, 0.9, 1.3 rad")
        do k = 1, size(slopes)
            call system%configure([m, big, slopes(k), g], error)
            if (allocated(error)) return
            call system%accelerations(0.0_dp, zero, zero, a)
            along(k) = a(1) + a(2)*cos(slopes(k))
        end do
        call residual_is(report, big*along - m*g*sin(slopes), reshape(m*along, [4, 1]), &
                         ["m (q1_ddot + q2_ddot cos a)"], [big/m - 1.0_dp])
        call report%equal("m (q1_ddot + q2_ddot cos a) = m g sin a  [N]", m*along(2), &
                          m*g*sin(slopes(2)), rounding)
        call report%equal("as written, over as derived: m/M", m*g*sin(slopes(2))/big/along(2), &
                          m/big, rounding)
    end subroutine mass_of_the_wedge
end module lagrangia_errata
