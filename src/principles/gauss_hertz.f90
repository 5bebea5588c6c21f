module lagrangia_gauss_hertz
    !! Gauss' and Hertz' principles in numbers. Gauss: of all accelerations that the constraints
    !! allow, the actual ones make \(Z = \sum m(\ddot x - F/m)^2\) least; beside them
    !! \(Z\) grows by \(\delta^\top M\delta\). Hertz: without forces the path is the straightest,
    !! on a sphere a great circle.
    use lagrangia_cart_pendulum, only: cart_pendulum_t
    use lagrangia_computed_path, only: compute_path
    use lagrangia_errors, only: error_t
    use lagrangia_hyperdual, only: cos, hyperdual_t, operator(*), operator(**), operator(+), sin
    use lagrangia_kinds, only: dp
    use lagrangia_lagrange, only: euler_lagrange_t, expand_lagrangian
    use lagrangia_other_lagrangians, only: bare_lagrangian_t
    use lagrangia_point_motion, only: expand_points, point_motion_t
    use lagrangia_report, only: report_t
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: gauss_hertz_principle

    real(dp), parameter :: rounding = 1e-12_dp   !! of a few dozen operations on numbers up to 200
    real(dp), parameter :: m1 = 1.3_dp, m2 = 0.7_dp, l = 0.9_dp, g = 9.81_dp
    real(dp), parameter :: q(2) = [0.4_dp, 1.1_dp], v(2) = [0.8_dp, -1.3_dp]
    integer, parameter :: samples = 301
    real(dp), parameter :: step = 0.01_dp        !! s

    type, extends(bare_lagrangian_t) :: sphere_t
        !! A mass on a sphere; theta from the downward vertical, phi about it.
        real(dp) :: m = 0.5_dp, r = 0.8_dp, g = 0.0_dp  !! kg, m, m/s^2
    contains
        procedure :: lagrangian
    end type sphere_t

contains

    subroutine gauss_hertz_principle(report, error)
        !! All statements, and the picture.
        type(report_t), intent(out) :: report  !! the result
        type(error_t), allocatable, intent(out) :: error  !! allocated where it fails
        real(dp) :: bends(2, samples)

        call report%begin("gauss-hertz: the actual accelerations depart least from the free ones")
        call report%cite("II", 12, "1828 Gauss least constraint")
        call report%cite("II", 14, "Hertz least curvature")
        call least_constraint(report, error)
        if (.not. allocated(error)) call on_a_sphere(bends, report, error)
        if (.not. allocated(error)) call draw(bends, report, error)
        call report%note("Cart-pendulum: m1 = "//to_text(m1)//" kg, m2 = "//to_text(m2)// &
                         " kg, l = "//to_text(l)//" m, g = "//to_text(g)//" m/s^2.")
        call report%note("x = 0.4 m, theta = 1.1 rad, x_dot = 0.8 m/s, theta_dot = -1.3 "// &
                         "rad/s; delta in m/s^2 and")
        call report%note("rad/s^2. Sphere: x = R (sin a cos b, sin a sin b, -cos a), from a "// &
                         "= 1, b = 0.2 with 0.9,")
        call report%note("2.3 rad/s; delta = (0.4, -0.7) rad/s^2. Z = sum of m (x_ddot - "// &
                         "F/m)^2 over the masses;")
        call report%note("delta: other accelerations of the q; M: the mass matrix. "// &
                         "Curvature: |acceleration across")
        call report%note("the path|/v^2.")
    end subroutine gauss_hertz_principle

    pure function constraint_of(cart, a) result(z)
        !! \(Z\) of any accelerations of the coordinates.
        type(cart_pendulum_t), intent(in) :: cart
        real(dp), intent(in) :: a(2)
        real(dp) :: z
        type(point_motion_t) :: motion

        call expand_points(cart, 0.0_dp, q, v, a, motion)
        z = sum((motion%mass*motion%acceleration - motion%force)**2/motion%mass)
    end function constraint_of

    subroutine least_constraint(report, error)
        !! The cart-pendulum's neighbours.
        type(report_t), intent(inout) :: report
        type(error_t), allocatable, intent(out) :: error
        real(dp), parameter :: deltas(2, 3) = reshape([0.1_dp, 0.0_dp, 0.0_dp, 0.1_dp, &
                                                       1.0_dp, -2.0_dp], [2, 3])
        character(12), parameter :: names(3) = ["(0.1, 0)    ", "(0, 0.1)    ", "(1, -2)     "]
        type(cart_pendulum_t) :: cart, wrong
        type(euler_lagrange_t) :: terms
        real(dp) :: a(2), other(2), least
        integer :: i

        call cart%configure([m1, m2, l, g], error)
        if (allocated(error)) return
        call cart%accelerations(0.0_dp, q, v, a)
        call expand_lagrangian(cart, 0.0_dp, q, v, terms)
        least = constraint_of(cart, a)
        call report%section("Gauss, cart-pendulum: Z beside the actual accelerations  [N^2/kg]")
        do i = 1, size(names)
            call report%equal("delta = "//trim(names(i))//": Z more by delta M delta", &
                              constraint_of(cart, a + deltas(:, i)) - least, &
                              dot_product(deltas(:, i), matmul(terms%mass, deltas(:, i))), &
                              rounding)
        end do
        wrong = cart
        wrong%g = -g
        call wrong%accelerations(0.0_dp, q, v, other)
        call report%at_least("is Z not more with the notes' sign of g?", least, &
                             constraint_of(cart, other), rounding, control=.true.)
        call report%show("E1")
    end subroutine least_constraint

    pure function lagrangian(self, t, q, v) result(lag)
        !! \(L = mR^2(\dot\theta^2 + \sin^2\theta\,\dot\varphi^2)/2 + mgR\cos\theta\).
        class(sphere_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof), v(self%ndof)
        type(hyperdual_t) :: lag

        lag = 0.5_dp*self%m*self%r**2*(v(1)**2 + (sin(q(1))*v(2))**2) &
              + self%m*self%g*self%r*cos(q(1)) + 0.0_dp*t
    end function lagrangian

    pure subroutine in_space(sphere, angles, rates, a, place, velocity, acceleration)
        !! Of the mass, m.
        type(sphere_t), intent(in) :: sphere
        real(dp), intent(in) :: angles(2), rates(2), a(2)
        real(dp), intent(out) :: place(3), velocity(3), acceleration(3)
        type(hyperdual_t) :: x(3), path(2)

        path%re = angles
        path%d1 = rates
        path%d2 = rates
        path%d12 = a
        x(1) = sphere%r*sin(path(1))*cos(path(2))
        x(2) = sphere%r*sin(path(1))*sin(path(2))
        x(3) = (-sphere%r)*cos(path(1))
        place = x%re
        velocity = x%d1
        acceleration = x%d12
    end subroutine in_space

    pure function curvature(velocity, acceleration) result(bend)
        !! Of a path in space, 1/m.
        real(dp), intent(in) :: velocity(3), acceleration(3)
        real(dp) :: bend
        real(dp) :: square

        square = dot_product(velocity, velocity)
        bend = norm2(acceleration - dot_product(acceleration, velocity)/square*velocity)/square
    end function curvature

    subroutine on_a_sphere(bends, report, error)
        !! Free, and with gravity.
        real(dp), intent(out) :: bends(2, samples)
        type(report_t), intent(inout) :: report
        type(error_t), allocatable, intent(out) :: error
        real(dp), parameter :: start(2) = [1.0_dp, 0.2_dp], rates(2) = [0.9_dp, 2.3_dp], &
                               pull(2) = [0.0_dp, g], delta(2) = [0.4_dp, -0.7_dp]
        type(sphere_t) :: sphere
        real(dp) :: angles(2, samples), speeds(2, samples), a(2), x(3), u(3), f(3), pole(3), off
        integer :: i, k

        bends = 0.0_dp
        sphere%ndof = 2
        do i = 1, 2
            sphere%g = pull(i)
            call compute_path("gauss16", sphere, 0.0_dp, step, start, rates, angles, speeds, error)
            if (allocated(error)) return
            off = 0.0_dp
            do k = 1, samples
                call sphere%accelerations(0.0_dp, angles(:, k), speeds(:, k), a)
                call in_space(sphere, angles(:, k), speeds(:, k), a, x, u, f)
                bends(i, k) = curvature(u, f)
                if (k == 1) pole = normal(x, u)
                off = max(off, abs(dot_product(x, pole)))
            end do
            call sphere%accelerations(0.0_dp, start, rates, a)
            if (i == 1) then
                call report%section("Hertz: a mass of no weight on a sphere, R = 0.8 m, 3 s")
                call report%equal("curvature = 1/R, largest  [1/m]", maxval(bends(1, :)), &
                                  1.0_dp/sphere%r, rounding)
                call report%equal("it is a great circle: off its plane  [m]", off, 0.0_dp, &
                                  rounding)
                call in_space(sphere, start, rates, a + delta, x, u, f)
                call report%at_least("another path that way is more curved  [1/m]", &
                                     curvature(u, f), 1.0_dp/sphere%r, 0.0_dp)
            else
                call report%section("with weight: Hertz has no force in his principle, Gauss has")
                call report%equal("is the curvature 1/R?  largest  [1/m]", maxval(bends(2, :)), &
                                  1.0_dp/sphere%r, rounding, control=.true.)
                call report%equal("is it a great circle?  off its plane  [m]", off, 0.0_dp, &
                                  rounding, control=.true.)
                call report%equal("Gauss: Z more by delta M delta  [N^2/kg]", more_of_z(), &
                                  sphere%m*sphere%r**2*(delta(1)**2 + (sin(start(1)) &
                                                                       *delta(2))**2), rounding)
            end if
        end do
    contains
        pure function more_of_z() result(more)
            !! Of the start, with accelerations changed by delta.
            real(dp) :: more
            real(dp) :: place(3), velocity(3), with(3), without(3)
            real(dp), parameter :: down(3) = [0.0_dp, 0.0_dp, -g]

            call in_space(sphere, start, rates, a, place, velocity, without)
            call in_space(sphere, start, rates, a + delta, place, velocity, with)
            more = sphere%m*(sum((with - down)**2) - sum((without - down)**2))
        end function more_of_z
    end subroutine on_a_sphere

    pure function normal(x, u) result(n)
        !! Of the plane of two vectors, of length 1.
        real(dp), intent(in) :: x(3), u(3)
        real(dp) :: n(3)

        n = [x(2)*u(3) - x(3)*u(2), x(3)*u(1) - x(1)*u(3), x(1)*u(2) - x(2)*u(1)]
        n = n/norm2(n)
    end function normal

    subroutine draw(bends, report, error)
        !! The picture: Z beside the actual accelerations; curvature with and without weight.
        real(dp), intent(in) :: bends(2, samples)
        type(report_t), intent(inout) :: report
        type(error_t), allocatable, intent(out) :: error
        type(cart_pendulum_t) :: cart
        real(dp) :: a(2), delta
        integer :: k

        call cart%configure([m1, m2, l, g], error)
        if (allocated(error)) return
        call cart%accelerations(0.0_dp, q, v, a)
        report%picture%file = "principle_gauss_hertz"
        report%picture%title = "Z is least at the actual accelerations; without weight a "// &
                               "path on "// &
                               "a sphere bends least"
        report%picture%names = [character(32) :: "t", "curvature without weight", &
                                "curvature with weight", "delta", "Z, other x_ddot", &
                                "Z, other theta_ddot"]
        report%picture%units = [character(16) :: "s", "1/m", "1/m", "m/s^2, rad/s^2", "N^2/kg", &
                                "N^2/kg"]
        report%picture%panels = [character(98) :: "delta:Z, other x_ddot+Z, other theta_ddot", &
                                 "t:curvature without weight+curvature with weight"]
        allocate (report%picture%values(6, samples))
        do k = 1, samples
            delta = 8.0_dp*(k - 1)/(samples - 1) - 4.0_dp
            report%picture%values(:, k) = [(k - 1)*step, bends(1, k), bends(2, k), delta, &
                                           constraint_of(cart, a + [delta, 0.0_dp]), &
                                           constraint_of(cart, a + [0.0_dp, delta])]
        end do
    end subroutine draw
end module lagrangia_gauss_hertz
