module lagrangia_errata
    !! The slips in the lecture notes in numbers: each equation as it is written, beside what
    !! follows from the notes' own Lagrangian, at many states of the real motion.
    use lagrangia_cart_pendulum, only: cart_pendulum_t
    use lagrangia_driven_pendulum, only: driven_pendulum_t
    use lagrangia_eigen, only: normal_modes
    use lagrangia_errors, only: error_t
    use lagrangia_hyperdual, only: exp, hyperdual_t, operator(*), operator(**), operator(+)
    use lagrangia_kinds, only: dp
    use lagrangia_lagrange, only: accelerations_from_lagrangian, euler_lagrange_t, &
                                  expand_lagrangian
    use lagrangia_oscillator, only: oscillator_t
    use lagrangia_point_motion, only: expand_points, point_motion_t
    use lagrangia_report, only: report_t
    use lagrangia_term_fit, only: all_terms
    use lagrangia_vectors, only: farthest
    use lagrangia_wedge, only: wedge_t
    implicit none (type, external)
    private
    public :: slip_numbers

    real(dp), parameter :: rounding = 1e-12_dp
    integer, parameter :: states = 20
    real(dp), parameter :: m1 = 1.3_dp, m2 = 0.7_dp, l = 0.9_dp, g = 9.81_dp  !! none is 1

contains

    subroutine slip_numbers(id, report, error)
        !! Add the rows of slip `id` to the report; none if there is nothing to compute.
        character(*), intent(in) :: id  !! `E1`
        type(report_t), intent(inout) :: report  !! gets the rows
        type(error_t), allocatable, intent(out) :: error  !! allocated where it fails

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
                          -dot_product(motion%force, motion%x_t), &
                          -m1*g*amplitude*w*sin(w*t), rounding)
        call report%equal("is V(theta, t) free of t?", -dot_product(motion%force, motion%x_t), &
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

    subroutine cart_numbers(id, report, error)
        !! Add the rows of slip `id`, if it is about the cart-pendulum.
        character(*), intent(in) :: id
        type(report_t), intent(inout) :: report
        type(error_t), allocatable, intent(out) :: error

        character(*), parameter :: values = "m1 = 1.3 kg, m2 = 0.7 kg, l = 0.9 m, g = 9.81 m/s^2"

        select case (id)
        case ("E1", "E3", "E4")
            call report%section(values//"; 20 states that obey L's equations")
        case ("E2"); call report%section(values//"; theta = 0.6 rad")
        case default; call report%section(values)
        end select
        select case (id)
        case ("E1"); call sign_of_gravity(report, error)
        case ("E2"); call missing_coupling(report, error)
        case ("E3"); call length_not_squared(report, error)
        case ("E4"); call lost_mass(report, error)
        case ("E6"); call exact_frequency(report, error)
        case default; return
        end select
    end subroutine cart_numbers

    subroutine cart_motion(theta, v, a, error)
        !! States of the cart-pendulum, `(2, states)`, and the accelerations that follow from L.
        real(dp), intent(out) :: theta(states), v(2, states), a(2, states)
        type(error_t), allocatable, intent(out) :: error
        type(cart_pendulum_t) :: system
        real(dp) :: none(0)
        integer :: k

        call system%configure([m1, m2, l, g], error)
        do k = 1, states
            if (allocated(error)) return
            theta(k) = 1.4_dp*sin(1.7_dp*k)
            v(:, k) = [1.2_dp*cos(0.9_dp*k), 2.1_dp*sin(2.3_dp*k + 0.4_dp)]
            call accelerations_from_lagrangian(system, 0.0_dp, [0.3_dp, theta(k)], v(:, k), &
                                               a(:, k), none, error)
        end do
    end subroutine cart_motion

    subroutine residual_is(report, written, terms, names, factors)
        !! The equation as it is written, brought to one side, is not zero: it is this sum of terms.
        type(report_t), intent(inout) :: report
        real(dp), intent(in) :: written(:)              !! (samples)
        real(dp), intent(in) :: terms(:, :)          !! (samples, terms)
        character(*), intent(in) :: names(:)
        real(dp), intent(in) :: factors(:)           !! that must come out
        type(error_t), allocatable :: error
        real(dp) :: found(size(names)), misfit
        integer :: k

        call report%equal("as written, largest left-hand side: is it 0?", maxval(abs(written)), &
                          0.0_dp, rounding, control=.true.)
        call all_terms(written, terms, found, misfit, error)
        if (allocated(error)) misfit = 1.0_dp
        do k = 1, size(names)
            call report%equal("that is, times "//names(k), found(k), factors(k), rounding)
        end do
        call report%equal("what that leaves unexplained, relative", misfit, 0.0_dp, rounding)
    end subroutine residual_is

    subroutine sign_of_gravity(report, error)
        !! The sign of \(m_2 g\ell\sin\theta\).
        type(report_t), intent(inout) :: report
        type(error_t), allocatable, intent(out) :: error
        real(dp) :: theta(states), v(2, states), a(2, states), written(states), omega2(2)

        call cart_motion(theta, v, a, error)
        if (allocated(error)) return
        written = m2*l**2*a(2, :) + m2*l*a(1, :)*cos(theta) - m2*g*l*sin(theta)
        call residual_is(report, written, reshape(m2*g*l*sin(theta), [states, 1]), &
                         ["m2 g l sin(theta)"], [-2.0_dp])
        call frequencies(-m2*g*l, m2*l, omega2, error)
        if (allocated(error)) return
        call report%equal("omega^2 as written = -(m1 + m2) g/(m1 l)", omega2(1), &
                          -(m1 + m2)*g/(m1*l), rounding)
        call report%at_least("does it swing?  omega^2 >= 0", omega2(1), 0.0_dp, rounding, &
                             control=.true.)
        call frequencies(m2*g*l, m2*l, omega2, error)
        if (allocated(error)) return
        call report%equal("omega^2 as derived = (m1 + m2) g/(m1 l)", omega2(2), &
                          (m1 + m2)*g/(m1*l), rounding)
    end subroutine sign_of_gravity

    subroutine missing_coupling(report, error)
        !! The Lagrangian's first line against its second.
        type(report_t), intent(inout) :: report
        type(error_t), allocatable, intent(out) :: error
        real(dp), parameter :: theta = 0.6_dp
        type(cart_pendulum_t) :: system
        type(euler_lagrange_t) :: terms
        type(hyperdual_t) :: v(2), t
        real(dp) :: inertia(2, 2), omega2(2)
        integer :: i, j

        call system%configure([m1, m2, l, g], error)
        if (allocated(error)) return
        call expand_lagrangian(system, 0.0_dp, [0.0_dp, theta], [0.4_dp, 1.1_dp], terms)
        do i = 1, 2
            do j = 1, 2
                v%re = [0.4_dp, 1.1_dp]
                v(i)%d1 = 1.0_dp
                v(j)%d2 = 1.0_dp
                t = 0.5_dp*m1*v(1)**2 + 0.5_dp*m2*(v(1)**2 + (l*cos(theta))**2*v(2)**2 &
                                                   + (l*sin(theta))**2*v(2)**2)
                inertia(i, j) = t%d12
                v%d1 = 0.0_dp
                v%d2 = 0.0_dp
            end do
        end do
        call report%equal("d2L/dx_dot dtheta_dot = m2 l cos(theta) [kg m]", terms%mass(1, 2), &
                          m2*l*cos(theta), rounding)
        call report%equal("as written it is 0", inertia(1, 2), 0.0_dp, rounding)
        call report%equal("as written, is it that?", inertia(1, 2), m2*l*cos(theta), rounding, &
                          control=.true.)
        call report%equal("d2L/dtheta_dot^2 as written: it is right", inertia(2, 2), &
                          terms%mass(2, 2), rounding)
        call frequencies(m2*g*l, 0.0_dp, omega2, error)
        if (allocated(error)) return
        call report%equal("omega^2 as written = g/l", omega2(2), g/l, rounding)
        call report%equal("is that (m1 + m2) g/(m1 l)?", omega2(2), (m1 + m2)*g/(m1*l), rounding, &
                          control=.true.)
    end subroutine missing_coupling

    subroutine frequencies(spring, coupling, omega2, error)
        !! Of the cart-pendulum with this \(K_{22}\), N m, and \(M_{12}\), kg m.
        real(dp), intent(in) :: spring, coupling
        real(dp), intent(out) :: omega2(2)
        type(error_t), allocatable, intent(out) :: error
        real(dp), allocatable :: found(:), shapes(:, :)

        call normal_modes(reshape([0.0_dp, 0.0_dp, 0.0_dp, spring], [2, 2]), &
                          reshape([m1 + m2, coupling, coupling, m2*l**2], [2, 2]), found, shapes, &
                          error)
        if (.not. allocated(error)) omega2 = found
    end subroutine frequencies

    subroutine length_not_squared(report, error)
        !! \(m_2\ell\ddot\theta\) for \(m_2\ell^2\ddot\theta\), besides the sign.
        type(report_t), intent(inout) :: report
        type(error_t), allocatable, intent(out) :: error
        real(dp) :: theta(states), v(2, states), a(2, states), written(states)

        call cart_motion(theta, v, a, error)
        if (allocated(error)) return
        written = m2*l*a(2, :) + m2*l*a(1, :)*cos(theta) - m2*g*l*sin(theta)
        call residual_is(report, written, reshape([m2*l*a(2, :), m2*g*l*sin(theta)], [states, 2]), &
                         [character(17) :: "m2 l theta_ddot", "m2 g l sin(theta)"], &
                         [1.0_dp - l, -2.0_dp])
    end subroutine length_not_squared

    subroutine lost_mass(report, error)
        !! The x-equation, divided by m2 but for its first term; with cos and sin of theta, for
        !! which the notes have 1 and theta by then, and with the \(\dot\theta^2\) of E25.
        type(report_t), intent(inout) :: report
        type(error_t), allocatable, intent(out) :: error
        real(dp) :: theta(states), v(2, states), a(2, states), rest(states)

        call cart_motion(theta, v, a, error)
        if (allocated(error)) return
        rest = l*a(2, :)*cos(theta) - l*v(2, :)**2*sin(theta)
        call residual_is(report, (m1 + m2)*a(1, :) + rest, reshape(a(1, :), [states, 1]), &
                         ["x_ddot"], [(m1 + m2)*(1.0_dp - 1.0_dp/m2)])
        call report%equal("with (m1 + m2)/m2: largest left-hand side", &
                          farthest((m1 + m2)/m2*a(1, :), -rest), 0.0_dp, rounding)
    end subroutine lost_mass

    subroutine exact_frequency(report, error)
        !! Not only about: equal.
        type(report_t), intent(inout) :: report
        type(error_t), allocatable, intent(out) :: error
        real(dp) :: omega2(2)

        call frequencies(m2*g*l, m2*l, omega2, error)
        if (allocated(error)) return
        call report%equal("omega^2 by LAPACK = (m1 + m2) g/(m1 l)", omega2(2), &
                          (m1 + m2)*g/(m1*l), rounding)
    end subroutine exact_frequency
end module lagrangia_errata
