module lagrangia_same_motion_page
    !! Different Lagrangians, the same motion, beyond \(L + dF/dt\): other momenta and other
    !! conserved quantities for the same paths.
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp
    use lagrangia_lagrange, only: euler_lagrange_t, expand_lagrangian
    use lagrangia_oscillator, only: oscillator_t
    use lagrangia_other_lagrangians, only: crossed_t, growing_t
    use lagrangia_report, only: report_t
    use lagrangia_system, only: system_t
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: same_motion_principle

    real(dp), parameter :: rounding = 1e-13_dp   !! of a few dozen operations on numbers up to 20
    real(dp), parameter :: m = 0.5_dp, k = 2.0_dp, omega = 2.0_dp, gamma = 0.6_dp
    real(dp), parameter :: w = sqrt(omega**2 - 0.25_dp*gamma**2)  !! of the damped oscillation
    integer, parameter :: samples = 301
    real(dp), parameter :: step = 0.02_dp        !! s

contains

    subroutine same_motion_principle(report, error)
        !! All statements, and the picture.
        type(report_t), intent(out) :: report  !! the result
        type(error_t), allocatable, intent(out) :: error  !! allocated where it fails

        call report%begin("same-motion: L's that differ by more than a dF/dt, and the same motion")
        call report%cite("I", 95, "multiple Lagrangians can lead to the same equations of motion")
        call in_the_plane(report)
        call with_friction(report, error)
        if (allocated(error)) return
        call draw_invariants(report)
        call report%note("In the plane: m = 1 kg, w = "//to_text(omega)//"/s, x = 0.7 m, "// &
                         "y = -0.4 m, x_dot = -0.9 m/s, y_dot = 1.6 m/s.")
        call report%note("Damped, and L = m x_dot^2/2 - k x^2/2: m = "//to_text(m)//" kg, k = "// &
                         to_text(k)//" N/m, gamma = "//to_text(gamma)//"/s;")
        call report%note("x = 0.7 m, x_dot = v = -0.9 m/s, t = 1.3 s; h' and the energy: "// &
                         "from 1 m at rest.")
        call report%note("p, p': dL/dx_dot, dL'/dx_dot; h' = x_dot p' - L'. Off the motion: "// &
                         "x_ddot = a = 0.3,")
        call report%note("y_ddot = 1.1 m/s^2.")
        call report%note("Off the motion: at any x, x_dot and x_ddot. If L' - L were a dF/dt, "// &
                         "its equations")
        call report%note("would be 0 = 0 there too (lagrangia principle gauge).")
    end subroutine same_motion_principle

    subroutine in_the_plane(report)
        !! \(L' = \dot x\dot y - \omega^2xy\): the equation of x comes from y.
        type(report_t), intent(inout) :: report
        real(dp), parameter :: q(2) = [0.7_dp, -0.4_dp], v(2) = [-0.9_dp, 1.6_dp], &
                               off(2) = [0.3_dp, 1.1_dp], t = 1.3_dp
        type(crossed_t) :: other
        type(euler_lagrange_t) :: terms
        real(dp) :: a(2), later(2), speed(2), p(2), energy(2)

        other%ndof = 2
        other%omega = omega
        call report%section("oscillator in the plane: L' = x_dot y_dot - w^2 x y, "// &
                            "L = v^2/2 - w^2 r^2/2")
        call other%accelerations(0.0_dp, q, v, a)
        call report%equal("x_ddot = -w^2 x  [m/s^2]", a(1), -omega**2*q(1), rounding)
        call report%equal("y_ddot = -w^2 y  [m/s^2]", a(2), -omega**2*q(2), rounding)
        call expand_lagrangian(other, 0.0_dp, q, v, terms)
        p = terms%dl_dv
        call report%equal("p_x' = y_dot", p(1), v(2), rounding)
        call report%equal("is p_x' = x_dot, as of L?", p(1), v(1), rounding, control=.true.)
        call ellipse(q, v, t, later, speed)
        energy = [other%energy(0.0_dp, q, v), other%energy(t, later, speed)]
        call report%equal("h' = x_dot y_dot + w^2 x y: after 1.3 s, at 0", energy(2), &
                          energy(1), rounding)
        call report%equal("is h' the energy (v^2 + w^2 r^2)/2?", energy(1), &
                          0.5_dp*sum(v**2 + omega**2*q**2), rounding, control=.true.)
        call report%equal("x p_x' - y p_y' = L_z, conserved as well", q(1)*p(1) - q(2)*p(2), &
                          later(1)*speed(2) - later(2)*speed(1), rounding)
        call report%equal("off the motion, L': y_ddot + w^2 y", &
                          equation(other, 0.0_dp, q, v, off, 1), off(2) + omega**2*q(2), rounding)
        call report%equal("is L' - L a dF/dt?  then 0 off the motion", &
                          equation(other, 0.0_dp, q, v, off, 1) - (off(1) + omega**2*q(1)), &
                          0.0_dp, rounding, control=.true.)
    end subroutine in_the_plane

    subroutine with_friction(report, error)
        !! \(L' = e^{\gamma t}L\) has friction in it; another factor changes nothing.
        type(report_t), intent(inout) :: report
        type(error_t), allocatable, intent(out) :: error
        real(dp), parameter :: x(1) = 0.7_dp, v(1) = -0.9_dp, t = 1.3_dp, off(1) = 0.3_dp
        type(growing_t) :: other
        type(oscillator_t) :: plain, twice
        type(euler_lagrange_t) :: terms
        real(dp) :: a(1), at(2), later(2), newton, one, two

        newton = m*off(1) + m*gamma*v(1) + k*x(1)
        other%ndof = 1
        other%time_dependent = .true.
        other%m = m
        other%k = k
        other%gamma = gamma
        call plain%configure([m, k], error)
        if (.not. allocated(error)) call twice%configure([2.0_dp*m, 2.0_dp*k], error)
        if (allocated(error)) return
        call report%section("damped oscillator: L' = exp(gamma t)(m x_dot^2 - k x^2)/2, "// &
                            "gamma = 0.6/s")
        call other%accelerations(t, x, v, a)
        call report%equal("x_ddot = -gamma x_dot - k x/m  [m/s^2]", a(1), &
                          -gamma*v(1) - k/m*x(1), rounding)
        call expand_lagrangian(other, t, x, v, terms)
        call report%equal("p' = exp(gamma t) m x_dot  [kg m/s]", terms%dl_dv(1), &
                          exp(gamma*t)*m*v(1), rounding)
        call report%equal("is p' = m x_dot?", terms%dl_dv(1), m*v(1), rounding, control=.true.)
        at = decay(0.0_dp)
        later = decay(t)
        one = other%energy(0.0_dp, at(:1), at(2:)) + 0.5_dp*gamma*m*at(1)*at(2)
        two = other%energy(t, later(:1), later(2:)) + 0.5_dp*gamma*x_p(later, t)
        call report%equal("h' + gamma x p'/2: after 1.3 s, at 0  [J]", two, one, rounding)
        call report%equal("is (m x_dot^2 + k x^2)/2 conserved?  [J]", &
                          0.5_dp*(m*later(2)**2 + k*later(1)**2), &
                          0.5_dp*(m*at(2)**2 + k*at(1)**2), rounding, control=.true.)
        call report%equal("off: exp(gamma t) (m a + m gamma v + k x) [N]", &
                          equation(other, t, x, v, off, 1), exp(gamma*t)*newton, rounding)
        call report%equal("is it that without the factor, m a + ...? [N]", &
                          equation(other, t, x, v, off, 1), newton, rounding, control=.true.)
        call report%section("L and 2 L: a factor")
        call twice%accelerations(0.0_dp, x, v, a)
        call report%equal("2 L: x_ddot  [m/s^2]", a(1), -k/m*x(1), rounding)
        call report%equal("2 L: p' = 2 p  [kg m/s]", momentum(twice), 2.0_dp*momentum(plain), &
                          rounding)
        call report%equal("is 2 L - L a dF/dt?  then 0 off the motion", &
                          equation(twice, t, x, v, off, 1) - equation(plain, t, x, v, off, 1), &
                          0.0_dp, rounding, control=.true.)
    contains
        pure function momentum(system) result(p)
            class(system_t), intent(in) :: system
            real(dp) :: p
            type(euler_lagrange_t) :: its

            call expand_lagrangian(system, t, x, v, its)
            p = its%dl_dv(1)
        end function momentum
    end subroutine with_friction

    pure function x_p(state, t) result(product)
        !! \(x p' = e^{\gamma t}mx\dot x\).
        real(dp), intent(in) :: state(2), t
        real(dp) :: product

        product = exp(gamma*t)*m*state(1)*state(2)
    end function x_p

    pure function equation(system, t, q, v, a, j) result(left)
        !! \(d/dt\,\partial L/\partial\dot q_j - \partial L/\partial q_j\), whatever a.
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t, q(:), v(:), a(:)
        integer, intent(in) :: j
        real(dp) :: left
        type(euler_lagrange_t) :: terms

        call expand_lagrangian(system, t, q, v, terms)
        left = dot_product(terms%mass(j, :), a) - terms%force(j)
    end function equation

    pure subroutine ellipse(q0, v0, t, q, v)
        !! The plane oscillator's motion.
        real(dp), intent(in) :: q0(2), v0(2), t
        real(dp), intent(out) :: q(2), v(2)

        q = q0*cos(omega*t) + v0/omega*sin(omega*t)
        v = v0*cos(omega*t) - q0*omega*sin(omega*t)
    end subroutine ellipse

    pure function decay(t) result(state)
        !! x and x_dot of the damped oscillator from 1 m at rest.
        real(dp), intent(in) :: t
        real(dp) :: state(2)

        state(1) = exp(-0.5_dp*gamma*t)*(cos(w*t) + 0.5_dp*gamma/w*sin(w*t))
        state(2) = -exp(-0.5_dp*gamma*t)*omega**2/w*sin(w*t)
    end function decay

    subroutine draw_invariants(report)
        !! The picture: the damped oscillation, its energy that goes, and what L' conserves.
        type(report_t), intent(inout) :: report
        real(dp) :: state(2), t, energy
        integer :: i

        report%picture%file = "principle_same_motion"
        report%picture%title = "A damped oscillator's energy goes, but its own L conserves a "// &
                               "number all the same"
        report%picture%names = [character(32) :: "t", "x", "energy", "conserved by L'"]
        report%picture%units = [character(16) :: "s", "m", "J", "J"]
        report%picture%panels = [character(98) :: "t:x", "t:energy+conserved by L'"]
        allocate (report%picture%values(4, samples))
        do i = 1, samples
            t = (i - 1)*step
            state = decay(t)
            energy = 0.5_dp*(m*state(2)**2 + k*state(1)**2)
            report%picture%values(:, i) = [t, state(1), energy, &
                                           exp(gamma*t)*energy + 0.5_dp*gamma*x_p(state, t)]
        end do
    end subroutine draw_invariants
end module lagrangia_same_motion_page
