module lagrangia_errata_cart
    !! The slips about the cart-pendulum in numbers; see `lagrangia_errata`.
    use lagrangia_cart_pendulum, only: cart_pendulum_t
    use lagrangia_eigen, only: normal_modes
    use lagrangia_errors, only: error_t
    use lagrangia_hyperdual, only: hyperdual_t, operator(*), operator(**), operator(+)
    use lagrangia_kinds, only: dp
    use lagrangia_lagrange, only: accelerations_from_lagrangian, euler_lagrange_t, &
                                  expand_lagrangian
    use lagrangia_report, only: report_t
    use lagrangia_term_fit, only: all_terms
    implicit none (type, external)
    private
    public :: cart_numbers, residual_is

    integer, parameter :: states = 20
    real(dp), parameter :: rounding = 1e-12_dp
    real(dp), parameter :: m1 = 1.3_dp, m2 = 0.7_dp, l = 0.9_dp, g = 9.81_dp  !! none is 1

contains

    subroutine cart_numbers(id, report, error)
        !! Add the rows of slip `id`, if it is about the cart-pendulum.
        character(*), intent(in) :: id
        type(report_t), intent(inout) :: report
        type(error_t), allocatable, intent(out) :: error

        call report%section("m1 = 1.3 kg, m2 = 0.7 kg, l = 0.9 m, g = 9.81 m/s^2; 20 states "// &
                            "that obey L's equations")
        select case (id)
        case ("E1"); call sign_of_gravity(report, error)
        case ("E2"); call missing_coupling(report, error)
        case ("E3"); call length_not_squared(report, error)
        case ("E4"); call lost_mass(report)
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

    subroutine residual_is(report, page, terms, names, factors)
        !! The page's equation, brought to one side, does not vanish: it is this sum of terms.
        type(report_t), intent(inout) :: report
        real(dp), intent(in) :: page(:)              !! (samples)
        real(dp), intent(in) :: terms(:, :)          !! (samples, terms)
        character(*), intent(in) :: names(:)
        real(dp), intent(in) :: factors(:)           !! that must come out
        type(error_t), allocatable :: error
        real(dp) :: found(size(names)), misfit
        integer :: k

        call report%equal("as written, largest left-hand side: is it 0?", maxval(abs(page)), &
                          0.0_dp, rounding, control=.true.)
        call all_terms(page, terms, found, misfit, error)
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
        real(dp) :: theta(states), v(2, states), a(2, states), page(states), omega2(2)

        call cart_motion(theta, v, a, error)
        if (allocated(error)) return
        page = m2*l**2*a(2, :) + m2*l*a(1, :)*cos(theta) - m2*g*l*sin(theta)
        call residual_is(report, page, reshape(m2*g*l*sin(theta), [states, 1]), &
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
        real(dp) :: theta(states), v(2, states), a(2, states), page(states)

        call cart_motion(theta, v, a, error)
        if (allocated(error)) return
        page = m2*l*a(2, :) + m2*l*a(1, :)*cos(theta) - m2*g*l*sin(theta)
        call residual_is(report, page, reshape([m2*l*a(2, :), m2*g*l*sin(theta)], [states, 2]), &
                         [character(17) :: "m2 l theta_ddot", "m2 g l sin(theta)"], &
                         [1.0_dp - l, -2.0_dp])
    end subroutine length_not_squared

    subroutine lost_mass(report)
        !! The x-equation of small angles, divided by m2 but for its first term.
        type(report_t), intent(inout) :: report
        real(dp), dimension(states) :: theta, theta_dot, theta_ddot, x_ddot, swing
        integer :: k

        theta = [(0.1_dp*sin(1.7_dp*k), k=1, states)]
        theta_dot = [(0.3_dp*cos(0.9_dp*k), k=1, states)]
        theta_ddot = -(m1 + m2)*g/(m1*l)*theta
        swing = l*theta_ddot - l*theta_dot**2*theta
        x_ddot = -m2*swing/(m1 + m2)
        call residual_is(report, (m1 + m2)*x_ddot + swing, reshape(swing, [states, 1]), &
                         ["l (th_ddot - th_dot^2 th)"], [1.0_dp - m2])
        call report%equal("with (m1 + m2)/m2: largest left-hand side", &
                          maxval(abs((m1 + m2)/m2*x_ddot + swing)), 0.0_dp, rounding)
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
end module lagrangia_errata_cart
