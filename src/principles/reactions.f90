module lagrangia_reactions
    !! The forces of constraint along a motion: Newton's equations of all 3n Cartesian coordinates
    !! with a multiplier for each constraint,
    !! $$ m\ddot x = F + A^\top\lambda,\qquad A\ddot x = b, $$
    !! beside the equations of the generalised coordinates, in which no such force is left.
    use lagrangia_cart_pendulum, only: cart_pendulum_t
    use lagrangia_computed_path, only: compute_path
    use lagrangia_errors, only: error_t
    use lagrangia_gauss_principle, only: cartesian_t, gauss_equations, least_constraint
    use lagrangia_hyperdual, only: hyperdual, hyperdual_t, operator(**), operator(-), operator(/)
    use lagrangia_kinds, only: dp
    use lagrangia_lapack, only: matrix_rank
    use lagrangia_pendulum, only: pendulum_t
    use lagrangia_report, only: report_t
    use lagrangia_rolling_disk, only: rolling_disk_t
    use lagrangia_saddle_point, only: solve_saddle_point
    use lagrangia_system, only: system_t
    use lagrangia_text, only: to_text
    use lagrangia_vectors, only: farthest
    use lagrangia_wedge, only: wedge_t
    implicit none (type, external)
    private
    public :: reactions_principle

    integer, parameter :: samples = 301
    real(dp), parameter :: step = 0.01_dp          !! s
    real(dp), parameter :: g = 9.81_dp, m = 0.5_dp, l = 0.8_dp, start = 2.0_dp
    real(dp), parameter :: m_cart = 1.0_dp         !! kg
    real(dp), parameter :: drift = 1e-12_dp        !! of the method over 300 steps, relative
    real(dp), parameter :: rounding = 1e-13_dp     !! of a few dozen operations on numbers up to 20

    type :: forces_t
        !! Of all samples of one motion.
        real(dp), allocatable :: q(:, :), v(:, :)  !! (ndof, samples)
        real(dp), allocatable :: lambda(:, :)      !! (constraints, samples)
        real(dp) :: apart = 0.0_dp     !! largest difference of x_ddot, 3n equations and q's
    end type forces_t

contains

    subroutine reactions_principle(report, error)
        !! All statements, and the picture.
        type(report_t), intent(out) :: report  !! the result
        type(error_t), allocatable, intent(out) :: error  !! allocated where it fails
        type(forces_t) :: swing, cart

        call report%begin("reactions: 3n equations with multipliers give the forces that q "// &
                          "does without")
        call report%cite("I", 13, "one variable becomes irrelevant for each holonomic constraint")
        call report%cite("II", 62, "relations that connect the coordinates of the particles")
        call on_the_pendulum(swing, report, error)
        if (.not. allocated(error)) call on_the_cart(cart, report, error)
        if (.not. allocated(error)) call on_the_wedge(report, error)
        if (.not. allocated(error)) call on_the_disk(report, error)
        if (.not. allocated(error)) call twice_the_same(report, error)
        if (allocated(error)) return
        call draw_forces(swing, cart, report)
        call report%note("Pendulum and cart-pendulum: m = m2 = "//to_text(m)//" kg, l = "// &
                         to_text(l)//" m, g = "//to_text(g)//" m/s^2; cart: m1 = "// &
                         to_text(m_cart)//" kg.")
        call report%note("D = m1 + m2 sin^2(th). Wedge: block m = 0.7 kg, wedge M = 2 kg, "// &
                         "alpha = 0.6 rad. Disk: m")
        call report%note("= 1.3 kg, R = 0.3 m, phi_dot = 4 rad/s, theta_dot = 1.1 rad/s. "// &
                         "Stated twice: f1 = (l -")
        call report%note("(x^2 + y^2)/l)/2 of the pendulum at th = 1.1 rad, th_dot = -1.3 "// &
                         "rad/s; lambda: the")
        call report%note("multiplier of f. Left: multipliers of the 3n equations; right: by "// &
                         "hand. Motions of 3 s,")
        call report%note("301 samples.")
    end subroutine reactions_principle

    subroutine along(system, q0, v0, forces, error)
        !! A motion of the q, and at each sample the 3n equations.
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: q0(:), v0(:)
        type(forces_t), intent(out) :: forces
        type(error_t), allocatable, intent(out) :: error
        type(cartesian_t) :: c
        integer :: k

        allocate (forces%q(system%ndof, samples), forces%v(system%ndof, samples))
        call compute_path("gauss16", system, 0.0_dp, step, q0, v0, forces%q, forces%v, error)
        do k = 1, samples
            if (allocated(error)) return
            call least_constraint(system, (k - 1)*step, forces%q(:, k), forces%v(:, k), c, error)
            if (allocated(error)) return
            if (k == 1) allocate (forces%lambda(size(c%reaction), samples))
            forces%lambda(:, k) = c%reaction
            forces%apart = max(forces%apart, farthest(c%acceleration, c%x_ddot))
        end do
    end subroutine along

    subroutine on_the_pendulum(swing, report, error)
        !! The rod: \(\lambda = mg(3\cos\theta - 2\cos\theta_0)\) from rest at \(\theta_0\).
        type(forces_t), intent(out) :: swing
        type(report_t), intent(inout) :: report
        type(error_t), allocatable, intent(out) :: error
        type(pendulum_t) :: pendulum

        call pendulum%configure([m, l, g], error)
        if (.not. allocated(error)) call along(pendulum, [start], [0.0_dp], swing, error)
        if (allocated(error)) return
        associate (theta => swing%q(1, :), rod => swing%lambda(1, :))
            call report%section("pendulum from rest at th0 = 2 rad: the rod's pull T  [N]")
            call report%equal("x_ddot, 3n equations less those of q  [m/s^2]", swing%apart, &
                              0.0_dp, rounding)
            call report%equal("T at the start = m g cos(th0): it pushes", rod(1), &
                              m*g*cos(start), rounding)
            call report%equal("largest T = m g (3 - 2 cos(th0))", maxval(rod), &
                              m*g*(3.0_dp - 2.0_dp*cos(start)), most_missed(step))
            call report%equal("T less m g (3 cos(th) - 2 cos(th0)), largest", &
                              farthest(rod, m*g*(3.0_dp*cos(theta) - 2.0_dp*cos(start))), &
                              0.0_dp, drift*maxval(abs(rod)))
            call report%equal("is it m g cos(th), as if it hung still?", maxval(rod), m*g, &
                              most_missed(step), control=.true.)
        end associate
    contains
        pure function most_missed(h) result(missed)
            !! By samples a step apart: half the bend of T at the bottom times half a step squared.
            real(dp), intent(in) :: h
            real(dp) :: missed

            missed = 0.5_dp*3.0_dp*m*g*(2.0_dp*g/l*(1.0_dp - cos(start)))*(0.5_dp*h)**2
        end function most_missed
    end subroutine on_the_pendulum

    subroutine on_the_cart(forces, report, error)
        !! The rod and the track under the cart.
        type(forces_t), intent(out) :: forces
        type(report_t), intent(inout) :: report
        type(error_t), allocatable, intent(out) :: error
        real(dp), parameter :: m1 = m_cart
        type(cart_pendulum_t) :: cart

        call cart%configure([m1, m, l, g], error)
        if (.not. allocated(error)) call along(cart, [0.0_dp, start], [0.0_dp, 0.0_dp], forces, &
                                               error)
        if (allocated(error)) return
        associate (theta => forces%q(2, :), w => forces%v(2, :), track => forces%lambda(1, :), &
                   rod => forces%lambda(2, :))
            call report%section("cart-pendulum from rest at 2 rad: rod T and track N, largest "// &
                                "differences  [N]")
            call report%equal("x_ddot, 3n equations less those of q  [m/s^2]", forces%apart, &
                              0.0_dp, 10.0_dp*rounding)
            call report%equal("T - m1 m2 (l th_dot^2 + g cos(th))/D", farthest(rod, &
                              m1*m*(l*w**2 + g*cos(theta))/(m1 + m*sin(theta)**2)), 0.0_dp, &
                              drift*maxval(abs(rod)))
            call report%equal("N - (m1 g + T cos(th))", farthest(track, m1*g &
                              + rod*cos(theta)), 0.0_dp, drift*maxval(abs(track)))
            call report%equal("is N the weight, (m1 + m2) g?  at the start", track(1), &
                              (m1 + m)*g, drift, control=.true.)
        end associate
    end subroutine on_the_cart

    subroutine on_the_wedge(report, error)
        !! Constant forces.
        type(report_t), intent(inout) :: report
        type(error_t), allocatable, intent(out) :: error
        real(dp), parameter :: mb = 0.7_dp, mw = 2.0_dp, alpha = 0.6_dp
        type(wedge_t) :: wedge
        type(forces_t) :: forces
        real(dp) :: by_hand

        call wedge%configure([mb, mw, alpha, g], error)
        if (.not. allocated(error)) call along(wedge, [0.0_dp, 0.0_dp], [0.0_dp, 0.0_dp], &
                                               forces, error)
        if (allocated(error)) return
        by_hand = mb*mw*g*cos(alpha)/(mw + mb*sin(alpha)**2)
        call report%section("block on a wedge: the incline's N, the plane's force, after 3 s  [N]")
        call report%equal("N = m M g cos(alpha)/(M + m sin^2(alpha))", &
                          forces%lambda(2, samples), by_hand, rounding)
        call report%equal("plane: M g + N cos(alpha)", forces%lambda(1, samples), &
                          mw*g + by_hand*cos(alpha), rounding)
        call report%equal("is N = m g cos(alpha), as on a fixed wedge?", &
                          forces%lambda(2, samples), mb*g*cos(alpha), rounding, control=.true.)
    end subroutine on_the_wedge

    subroutine on_the_disk(report, error)
        !! The ground's sideways force keeps the disk on its circle.
        type(report_t), intent(inout) :: report
        type(error_t), allocatable, intent(out) :: error
        real(dp), parameter :: md = 1.3_dp, r = 0.3_dp, roll = 4.0_dp, steer = 1.1_dp
        real(dp), parameter :: q0(4) = [0.0_dp, 0.0_dp, 0.0_dp, 0.7_dp]
        type(rolling_disk_t) :: disk
        type(forces_t) :: forces
        real(dp) :: v0(4)

        call disk%configure([md, r, 0.5_dp*md*r**2, 0.25_dp*md*r**2, g, 0.0_dp], error)
        if (allocated(error)) return
        call disk%complete_velocities(0.0_dp, q0, [roll, steer], v0, error)
        if (.not. allocated(error)) call along(disk, q0, v0, forces, error)
        if (allocated(error)) return
        call report%section("rolling disk on a circle: the ground's force on it, after 3 s  [N]")
        call report%equal("along the plane: m R phi_dot theta_dot", &
                          hypot(forces%lambda(2, samples), forces%lambda(3, samples)), &
                          md*r*roll*steer, drift*md*r*roll*steer)
        call report%equal("across the plane: m g", forces%lambda(1, samples), md*g, rounding)
    end subroutine on_the_disk

    subroutine twice_the_same(report, error)
        !! The rod's constraint stated twice, \(f_2 = 2f_1\): either of them holds the bob.
        type(report_t), intent(inout) :: report
        type(error_t), allocatable, intent(out) :: error
        real(dp), parameter :: q(1) = 1.1_dp, v(1) = -1.3_dp
        type(pendulum_t) :: pendulum
        type(cartesian_t) :: c, other
        real(dp) :: one(4), two(4)
        integer :: rank

        call pendulum%configure([m, l, g], error)
        if (allocated(error)) return
        call least_constraint(pendulum, 0.0_dp, q, v, c, error)
        if (allocated(error)) return
        other = c
        call state_again(c%x, c%x_dot, other%slope(1, :), other%right(1))
        call matrix_rank(reshape([c%slope(1, :), other%slope(1, :)], [3, 2]), rank, error)
        if (.not. allocated(error)) call solve_with(c, one)
        if (.not. allocated(error)) call solve_with(other, two)
        if (allocated(error)) return
        call report%section("the rod's constraint stated twice, f2 = 2 f1: who of the two "// &
                            "holds "// &
                            "the bob?")
        call report%equal("constraints that are independent, of 2", real(rank, dp), 1.0_dp, 0.0_dp)
        call report%equal("x_ddot: held by f1, held by f2  [m/s^2]", one(1), two(1), rounding)
        call report%equal("y_ddot: held by f1, held by f2  [m/s^2]", one(2), two(2), rounding)
        call report%equal("force on the bob, lambda df/dx  [N]", one(4)*c%slope(1, 1), &
                          two(4)*other%slope(1, 1), rounding)
        call report%equal("is the multiplier the same?", one(4), two(4), rounding, control=.true.)
    contains
        pure subroutine state_again(x, u, slope, right)
            !! \(f_2 = \ell - x^2/\ell - y^2/\ell\), twice the system's own: its slope, and with
            !! \(\ddot f_2 = 0\) the right side.
            real(dp), intent(in) :: x(3), u(3)
            real(dp), intent(out) :: slope(3), right
            type(hyperdual_t) :: at(3), f2
            integer :: i

            do i = 1, 3
                at = hyperdual(x)
                at(i)%d1 = 1.0_dp
                f2 = l - at(1)**2/l - at(2)**2/l
                slope(i) = f2%d1
            end do
            at = hyperdual(x)
            at%d1 = u
            at%d2 = u
            f2 = l - at(1)**2/l - at(2)**2/l
            right = -f2%d12
        end subroutine state_again

        subroutine solve_with(held, solution)
            !! The equations with this constraint.
            type(cartesian_t), intent(in) :: held
            real(dp), intent(out) :: solution(4)
            real(dp) :: matrix(4, 4), right(4)

            call gauss_equations(held, matrix, right)
            call solve_saddle_point(matrix, right, solution, error)
        end subroutine solve_with
    end subroutine twice_the_same

    subroutine draw_forces(swing, cart, report)
        !! The picture: the rod's pull, by the 3n equations and by hand, and the weight's part.
        type(forces_t), intent(in) :: swing, cart
        type(report_t), intent(inout) :: report
        integer :: k

        report%picture%file = "principle_reactions"
        report%picture%title = "Pendulum from 2 rad: the rod pulls hardest below, and pushes "// &
                               "(T < 0) above"
        report%picture%names = [character(32) :: "t", "T, 3n equations", "T by hand", &
                                "m g cos(theta)", "rod of a cart-pendulum", "track under the cart"]
        report%picture%units = [character(16) :: "s", "N", "N", "N", "N", "N"]
        report%picture%panels = [character(98) :: "t:T, 3n equations+T by hand+m g cos(theta)", &
                                 "t:rod of a cart-pendulum+track under the cart"]
        report%picture%nested = .true.
        allocate (report%picture%values(6, samples))
        do k = 1, samples
            associate (c => cos(swing%q(1, k)))
                report%picture%values(:, k) = [(k - 1)*step, swing%lambda(1, k), &
                    m*g*(3.0_dp*c - 2.0_dp*cos(start)), m*g*c, cart%lambda(2, k), &
                    cart%lambda(1, k)]
            end associate
        end do
    end subroutine draw_forces
end module lagrangia_reactions
