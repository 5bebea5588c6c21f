module lagrangia_dalembert
    !! From D'Alembert to Lagrange, term by term:
    !! $$ \sum m\ddot x\frac{\partial x}{\partial q}
    !!    = \frac{d}{dt}\left(\sum m\dot x\frac{\partial x}{\partial q}\right)
    !!    - \sum m\dot x\frac{d}{dt}\frac{\partial x}{\partial q}
    !!    = \frac{d}{dt}\frac{\partial T}{\partial\dot q} - \frac{\partial T}{\partial q} $$
    !! The left sides come from the positions of the masses, the right ones from L. It is a matter
    !! of derivatives alone and holds on any path, so the accelerations here are arbitrary.
    use lagrangia_cart_pendulum, only: cart_pendulum_t
    use lagrangia_computed_path, only: compute_path
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp
    use lagrangia_lagrange, only: euler_lagrange_t, expand_lagrangian
    use lagrangia_point_motion, only: expand_points, point_motion_t
    use lagrangia_report, only: report_t
    use lagrangia_rotating_wire, only: rotating_wire_t
    use lagrangia_system, only: system_t
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: dalembert_principle

    real(dp), parameter :: rounding = 1e-13_dp  !! of a few dozen operations on numbers up to 20
    real(dp), parameter :: m1 = 1.3_dp, m2 = 0.7_dp, l = 0.9_dp, g = 9.81_dp

    type :: terms_t
        !! Of one coordinate.
        real(dp) :: newton = 0.0_dp     !! \(\sum m\ddot x\,\partial x/\partial q\)
        real(dp) :: momentum = 0.0_dp   !! \(\sum m\dot x\,\partial x/\partial q\)
        real(dp) :: turning = 0.0_dp    !! \(\sum m\dot x\,d/dt\,\partial x/\partial q\)
        real(dp) :: dt_dv = 0.0_dp      !! \(\partial T/\partial\dot q\)
        real(dp) :: rate = 0.0_dp       !! \(d/dt\,\partial T/\partial\dot q\)
        real(dp) :: dt_dq = 0.0_dp      !! \(\partial T/\partial q\)
    end type terms_t

contains

    subroutine dalembert_principle(report, error)
        !! All statements, and the picture.
        type(report_t), intent(out) :: report  !! the result
        type(error_t), allocatable, intent(out) :: error  !! allocated where it fails
        type(cart_pendulum_t) :: cart

        call report%begin("dalembert: m x_ddot dx/dq becomes d/dt dT/dq_dot - dT/dq, term by term")
        call report%cite("I", 34, "generalized forces Q_{i}")
        call report%cite("I", 41, "(\dot{p}_{i} - F_{i}) \underbrace{\sum_{i}^{3m-k}")
        call report%cite("I", 43, "$$= \underbrace{\sum_{i}^{d} \frac{\partial}{\partial t} "// &
                         "\partial \dot{q}_{i}^{2}}")
        call cart%configure([m1, m2, l, g], error)
        if (allocated(error)) return
        call on_the_cart(cart, report)
        call on_the_wire(report, error)
        if (allocated(error)) return
        call draw_terms(cart, report, error)
        call report%note("Cart-pendulum: m1 = "//to_text(m1)//" kg, m2 = "//to_text(m2)// &
                         " kg, l = "//to_text(l)//" m, g = "//to_text(g)//" m/s^2.")
        call report%note("Sums: on the left over the masses and their x and y, from x(q); "// &
                         "on the right from T = L")
        call report%note("+ V. At theta = 1.1 rad, x_dot = 0.8 m/s, theta_dot = -1.3 rad/s, "// &
                         "x_ddot = 2.1 m/s^2,")
        call report%note("theta_ddot = -0.6 rad/s^2. Bead: m = 0.6 kg, r = 0.5 m, r_dot = "// &
                         "0.8 m/s, r_ddot = -1.7")
        call report%note("m/s^2. The accelerations are arbitrary: it holds on any path, not "// &
                         "only on the actual")
        call report%note("one.")
    end subroutine dalembert_principle

    subroutine on_the_cart(cart, report)
        !! A cart with a pendulum; the bob's \(x_2 = x + l\sin\theta\).
        type(cart_pendulum_t), intent(in) :: cart
        type(report_t), intent(inout) :: report
        real(dp), parameter :: q(2) = [0.4_dp, 1.1_dp], v(2) = [0.8_dp, -1.3_dp], &
                               a(2) = [2.1_dp, -0.6_dp], faster(2) = v + [0.0_dp, 1.0_dp]
        real(dp), parameter :: near = 1e-3_dp  !! rad: the difference quotient errs by near^4/30
        real(dp), parameter :: beside(4) = near*[1.0_dp, -1.0_dp, 2.0_dp, -2.0_dp]
        type(point_motion_t) :: now, then, there
        type(terms_t) :: x, theta
        real(dp) :: x2_dot(4)
        integer :: k

        call expand_points(cart, 0.0_dp, q, v, a, now)
        call expand_points(cart, 0.0_dp, q, faster, a, then)
        call expand_terms(cart, 0.0_dp, q, v, a, 1, x)
        call expand_terms(cart, 0.0_dp, q, v, a, 2, theta)
        call report%section("cart-pendulum: the two steps about the bob's x2 = x + l sin(th)")
        call report%equal("dx2/dth = dx2_dot/dth_dot  [m]", now%jacobian(4, 2), &
                          then%velocity(4) - now%velocity(4), rounding)
        call report%equal("dx2/dth = l cos(th)  [m]", now%jacobian(4, 2), l*cos(q(2)), rounding)
        do k = 1, 4
            call expand_points(cart, 0.0_dp, q + [0.0_dp, beside(k)], v, a, there)
            x2_dot(k) = there%velocity(4)
        end do
        call report%equal("d/dt dx2/dth = dx2_dot/dth  [m/s]", now%slope(4, 2), &
                          (8.0_dp*(x2_dot(1) - x2_dot(2)) - (x2_dot(3) - x2_dot(4)))/ &
                          (12.0_dp*near), 1e-11_dp)
        call report%section("cart-pendulum, theta: each sum, and the term that it becomes")
        call report%equal("m x_dot dx/dth = dT/dth_dot  [N m s]", theta%momentum, &
                          theta%dt_dv, rounding)
        call report%equal("m x_dot d/dt dx/dth = dT/dth  [N m]", theta%turning, &
                          theta%dt_dq, rounding)
        call report%equal("dT/dth = -m2 l x_dot th_dot sin(th)  [N m]", theta%dt_dq, &
                          -m2*l*v(1)*v(2)*sin(q(2)), rounding)
        call report%equal("m x_ddot dx/dth = d/dt dT/dth_dot - dT/dth", theta%newton, &
                          theta%rate - theta%dt_dq, rounding)
        call report%equal("is it d/dt dT/dth_dot, without dT/dth?", theta%newton, theta%rate, &
                          rounding, control=.true.)
        call report%equal("it lacks m2 l x_dot th_dot sin(th)  [N m]", theta%newton - theta%rate, &
                          m2*l*v(1)*v(2)*sin(q(2)), rounding)
        call report%section("cart-pendulum, x: T has no x, only x_dot")
        call report%equal("dT/dx = 0  [N]", x%dt_dq, 0.0_dp, rounding)
        call report%equal("m x_ddot dx/dx = d/dt dT/dx_dot  [N]", x%newton, x%rate, rounding)
    end subroutine on_the_cart

    subroutine on_the_wire(report, error)
        !! A constraint that moves: \(dT/dr\) is the centrifugal force.
        type(report_t), intent(inout) :: report
        type(error_t), allocatable, intent(out) :: error
        real(dp), parameter :: m = 0.6_dp, w = 1.5_dp, r(1) = 0.5_dp, v(1) = 0.8_dp, a(1) = -1.7_dp
        type(rotating_wire_t) :: wire
        type(terms_t) :: terms

        call wire%configure([m, w], error)
        if (allocated(error)) return
        call expand_terms(wire, 0.7_dp, r, v, a, 1, terms)
        call report%section("bead on a wire that turns, W = 1.5 rad/s: x(r, t) has the time in it")
        call report%equal("m x_ddot dx/dr = d/dt dT/dr_dot - dT/dr [N]", terms%newton, &
                          terms%rate - terms%dt_dq, rounding)
        call report%equal("dT/dr = m W^2 r, the centrifugal force  [N]", terms%dt_dq, &
                          m*w**2*r(1), rounding)
        call report%equal("is it m r_ddot, without dT/dr?  [N]", terms%newton, m*a(1), rounding, &
                          control=.true.)
    end subroutine on_the_wire

    pure subroutine expand_terms(system, t, q, v, a, j, terms)
        !! Both sides for coordinate `j` at any state with any accelerations. V has no velocities:
        !! \(\partial T/\partial\dot q = \partial L/\partial\dot q\), and \(-\partial V/\partial
        !! q\) is the generalized force of what acts on the masses.
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t, q(system%ndof), v(system%ndof), a(system%ndof)
        integer, intent(in) :: j
        type(terms_t), intent(out) :: terms
        type(point_motion_t) :: motion
        type(euler_lagrange_t) :: from

        call expand_points(system, t, q, v, a, motion)
        call expand_lagrangian(system, t, q, v, from)
        terms%newton = sum(motion%mass*motion%acceleration*motion%jacobian(:, j))
        terms%momentum = sum(motion%mass*motion%velocity*motion%jacobian(:, j))
        terms%turning = sum(motion%mass*motion%velocity*motion%slope(:, j))
        terms%dt_dv = from%dl_dv(j)
        terms%rate = dot_product(from%mass(j, :), a) - (from%force(j) - from%dl_dq(j))
        terms%dt_dq = from%dl_dq(j) - dot_product(motion%force, motion%jacobian(:, j))
    end subroutine expand_terms

    subroutine draw_terms(cart, report, error)
        !! The picture: the torque on theta along a motion, with and without \(dT/d\theta\).
        type(cart_pendulum_t), intent(in) :: cart
        type(report_t), intent(inout) :: report
        type(error_t), allocatable, intent(out) :: error
        integer, parameter :: samples = 301
        real(dp), parameter :: step = 0.01_dp, q0(2) = [0.0_dp, 2.0_dp], v0(2) = [1.5_dp, 0.0_dp]
        real(dp) :: q(2, samples), v(2, samples), a(2)
        type(terms_t) :: terms
        integer :: k

        call compute_path("gauss16", cart, 0.0_dp, step, q0, v0, q, v, error)
        if (allocated(error)) return
        report%picture%file = "principle_dalembert"
        report%picture%title = "Cart-pendulum: without dT/dtheta the two sides of "// &
                               "Lagrange's equation part"
        report%picture%nested = .true.
        report%picture%names = [character(32) :: "t", "m x_ddot dx/dtheta", &
                                "with dT/dtheta", "without dT/dtheta", "gap", &
                                "m2 l x_dot theta_dot sin(theta)"]
        report%picture%units = [character(16) :: "s", "N m", "N m", "N m", "N m", "N m"]
        report%picture%panels = [character(98) :: "t:m x_ddot dx/dtheta+with dT/dtheta+"// &
                                 "without dT/dtheta", &
                                 "t:gap+m2 l x_dot theta_dot sin(theta)"]
        allocate (report%picture%values(6, samples))
        do k = 1, samples
            call cart%accelerations(0.0_dp, q(:, k), v(:, k), a)
            call expand_terms(cart, 0.0_dp, q(:, k), v(:, k), a, 2, terms)
            report%picture%values(:, k) = [(k - 1)*step, terms%newton, terms%rate - terms%dt_dq, &
                                           terms%rate, terms%newton - terms%rate, &
                                           m2*l*v(1, k)*v(2, k)*sin(q(2, k))]
        end do
    end subroutine draw_terms
end module lagrangia_dalembert
