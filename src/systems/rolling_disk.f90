module lagrangia_rolling_disk
    !! An upright disk that rolls and steers without slipping: the non-holonomic example.
    !!
    !! Source: the lecture of 1 September 2011. The notes write the constraint as
    !! \(\sum_i A_i\dot q_i + B = 0\) with \(A_x = 1\), \(A_\varphi = -R\sin\theta\), and call it
    !! non-holonomic because \(\partial A_\varphi/\partial\theta \ne \partial A_\theta/\partial
    !! \varphi\). That shows only that \(A\cdot dq\) is not exact. What decides is that no
    !! integrating factor exists, \(a\wedge da = R\cos\theta\,dx\wedge d\varphi\wedge d\theta\ne 0\)
    !! (Frobenius): the conclusion stands.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_nan, ieee_quiet_nan, ieee_value
    use lagrangia_description, only: between, conserved, coordinate, description_t, figure_length, &
                                     formula_length, letter_t, mass_point, nonnegative, positive, &
                                     quantity
    use lagrangia_errors, only: error_t, fail
    use lagrangia_hyperdual, only: assignment(=), cos, hyperdual_t, operator(*), operator(**), &
                                   operator(+), operator(-), sin
    use lagrangia_kinds, only: dp
    use lagrangia_reference, only: reference_t
    use lagrangia_sine_cosine, only: sine_cosine
    use lagrangia_system, only: check_parameters, lanes, system_t
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: rolling_disk_t

    real(dp), parameter :: right_angle = acos(0.0_dp)

    type, extends(system_t) :: rolling_disk_t
        !! The coordinates are \(x\), \(y\), m, of the contact, in the plane, \(x\) downhill;
        !! \(\varphi\), rad, the angle rolled; \(\theta\), rad, the heading: the disk's axle lies
        !! along \((\cos\theta, \sin\theta)\), and it rolls towards \((\sin\theta, -\cos\theta)\).
        real(dp) :: m = 1.0_dp        !! kg
        real(dp) :: r = 0.3_dp        !! m
        real(dp) :: i_roll = 0.0_dp   !! about the axle, kg m^2; `configure` sets \(mR^2/2\)
        real(dp) :: i_yaw = 0.0_dp    !! about the normal, kg m^2; `configure` sets \(mR^2/4\)
        real(dp) :: g = 9.81_dp       !! m s^-2
        real(dp) :: incline = 0.0_dp  !! of the plane, rad
    contains
        procedure :: describe
        procedure :: configure
        procedure :: accelerations
        procedure :: accelerations_lanes
        procedure :: lagrangian
        procedure :: energy
        procedure :: quantity => momentum_or_friction
        procedure :: positions
        procedure :: newton
        procedure :: angles
        procedure :: constraint_rows
        procedure :: complete_velocities
        procedure :: free_velocities
        procedure :: pull
        procedure :: roll_acceleration
        procedure :: closed_form
    end type rolling_disk_t

    interface
        module subroutine closed_form(self, t0, q0, v0, reference)
            !! See `system_t`; in `rolling_disk_reference`.
            implicit none (type, external)
            class(rolling_disk_t), intent(in) :: self
            real(dp), intent(in) :: t0, q0(:), v0(:)
            class(reference_t), allocatable, intent(out) :: reference
        end subroutine closed_form
    end interface

contains

    pure subroutine describe(self, d)
        !! See `system_t`.
        class(rolling_disk_t), intent(in) :: self
        type(description_t), intent(out) :: d
        real(dp) :: i_roll, i_yaw

        i_roll = self%i_roll
        i_yaw = self%i_yaw
        if (self%ndof == 0) then
            i_roll = ieee_value(i_roll, ieee_quiet_nan)
            i_yaw = i_roll
        end if
        d%name = "rolling_disk"
        d%title = "an upright disk rolling without slipping, level or on an incline"
        d%coordinates = [coordinate("x", "m", "point of contact, downhill"), &
                         coordinate("y", "m", "point of contact, along the contour line"), &
                         coordinate("phi", "rad", "angle rolled"), &
                         coordinate("theta", "rad", "heading: rolls to (sin(theta), -cos(theta))")]
        d%parameters = [ &
            positive("m", "kg", "mass", self%m), &
            positive("r", "m", "radius", self%r), &
            nonnegative("i_roll", "kg m^2", "moment of inertia about the axle", i_roll, &
                        computed="m r^2/2"), &
            positive("i_yaw", "kg m^2", "moment of inertia about the plane's normal", i_yaw, &
                     computed="m r^2/4"), &
            nonnegative("g", "m/s^2", "gravity", self%g), &
            between("incline", "rad", "angle of the plane, down towards +x", self%incline, &
                    -right_angle, right_angle)]
        d%energy_scale = self%m*self%g*self%r
        associate (speed => sqrt(self%g*self%r))
            d%quantities = [ &
                conserved("p_theta", "kg m^2/s", "steering goes on", self%m*self%r*speed, &
                          "i_yaw theta_dot"), &
                quantity("p_phi", "kg m^2/s", "about the contact; conserved on the level", &
                         "(i_roll + m r^2) phi_dot"), &
                conserved("roll_yaw", "J", "on any incline", d%energy_scale, &
                          "(i_roll + m r^2) phi_dot theta_dot + m g r sin(incline) cos(theta)"), &
                conserved("orbit_x", "m/s^2", "level, theta_dot^2 times the centre's x", self%g, &
                          "theta_dot (theta_dot x + r phi_dot cos(theta)) "// &
                          "- r kappa sin(theta)^2/2"), &
                conserved("orbit_y", "m/s^2", "level, theta_dot^2 times the centre's y", self%g, &
                          "theta_dot (theta_dot y + r phi_dot sin(theta)) "// &
                          "- r kappa (theta_dot t - sin(2 theta)/2)/2"), &
                conserved("slip_x", "m/s", "zero, it rolls", speed, &
                          "x_dot - r sin(theta) phi_dot"), &
                conserved("slip_y", "m/s", "zero, it rolls", speed, &
                          "y_dot + r cos(theta) phi_dot"), &
                quantity("friction_x", "N", "force of the plane that keeps it rolling", &
                         "m x_ddot - m g sin(incline)"), &
                quantity("friction_y", "N", "force of the plane that keeps it rolling", &
                         "m y_ddot"), &
                quantity("p_x", "kg m/s", "changes, although on the level L has no x", "m x_dot"), &
                quantity("p_y", "kg m/s", "changes, although L has no y", "m y_dot")]
            if (abs(self%pull()) <= 0.0_dp) d%quantities(2) = &
                conserved("p_phi", "kg m^2/s", "about the contact; the plane is level", &
                          self%m*self%r*speed, "(i_roll + m r^2) phi_dot")
        end associate
        d%points = [mass_point("centre", self%m, "m", "x", "y", "r")]
        d%rotors = [mass_point("roll", self%i_roll, "i_roll", "phi"), &
                    mass_point("heading", self%i_yaw, "i_yaw", "theta")]
        d%reactions = [ &
            quantity("plane_force", "N", "of the plane on the disk, off it", "z_centre - r"), &
            quantity("friction_x", "N", "that keeps it rolling", "x_dot - r sin(theta) phi_dot"), &
            quantity("friction_y", "N", "that keeps it rolling", "y_dot + r cos(theta) phi_dot")]
        d%dimensions = 3
        d%letters = [ &
            letter_t("kappa", "m g r sin(incline)/(i_roll + m r^2)"), &
            letter_t("lambda_x", "friction_x"), letter_t("lambda_y", "friction_y")]
        d%kinetic_energy = "m/2 (x_dot^2 + y_dot^2) + i_roll/2 phi_dot^2 + i_yaw/2 theta_dot^2"
        d%potential_energy = "- m g x sin(incline)"
        d%lagrangian = d%kinetic_energy//" + m g x sin(incline)"
        d%energy = d%kinetic_energy//" - m g x sin(incline)"
        d%equations = [character(formula_length) :: &
            "m x_ddot = m g sin(incline) + lambda_x", &
            "m y_ddot = lambda_y", &
            "i_roll phi_ddot = - r sin(theta) lambda_x + r cos(theta) lambda_y", &
            "i_yaw theta_ddot = 0"]
        d%accelerations = [character(formula_length) :: &
            "phi_ddot = kappa sin(theta)", &
            "x_ddot = r (phi_ddot sin(theta) + phi_dot theta_dot cos(theta))", &
            "y_ddot = r (- phi_ddot cos(theta) + phi_dot theta_dot sin(theta))"]
        d%constraint = "nonholonomic, scleronomic"
        d%constraint_equations = [character(len(d%title)) :: &
            "x_dot - r sin(theta) phi_dot = 0", "y_dot + r cos(theta) phi_dot = 0"]
        d%notes = [character(len(d%title)) :: &
            "The notes' test (unequal partials of A) shows only that A.dq is not exact;", &
            "Frobenius decides: of the notes' dx a^da = r cos(theta) dx^dphi^dtheta: no "// &
            "integrating factor.", &
            "Four coordinates, two velocities: every (x, y, phi, theta) can be reached.", &
            "Level: lambda = m r phi_dot theta_dot (cos(theta), sin(theta)), and a circle of "// &
            "radius r phi_dot/theta_dot.", &
            "Inclined, steering: it does not run downhill but drifts sideways, at "// &
            "r kappa/(2 theta_dot).", &
            "Lagrange-d'Alembert: the constraint is not put into L.", &
            "p_phi is dT/dphi_dot with the rolling put into T; dL/dphi_dot is i_roll phi_dot.", &
            "What holds the disk upright resists no motion; v may be given as phi_dot, theta_dot."]
        d%figure = [character(figure_length) :: "plane origin", "trail (x, y, 0)", &
            "field g (sin(incline), 0, - cos(incline))", &
            "wheel centre (x + r sin(phi) sin(theta), y - r sin(phi) cos(theta), "// &
            "r + r cos(phi)) (x + r cos(phi) sin(theta), y - r cos(phi) cos(theta), "// &
            "r - r sin(phi))"]
        d%source = "Phys 601, 1 September 2011: nonholonomic constraint A.q_dot + B = 0"
    end subroutine describe

    pure subroutine configure(self, values, error)
        !! In this order: m, r, i_roll, i_yaw, g, incline. Moments of inertia that are not given,
        !! NaN, are those of a uniform disk.
        class(rolling_disk_t), intent(inout) :: self
        real(dp), intent(in) :: values(:)
        type(error_t), allocatable, intent(out) :: error

        call check_parameters(self, values, error)
        if (allocated(error)) return
        self%ndof = 4
        self%constraints = 2
        self%m = values(1)
        self%r = values(2)
        self%i_roll = values(3)
        if (ieee_is_nan(values(3))) self%i_roll = 0.5_dp*self%m*self%r**2
        self%i_yaw = values(4)
        if (ieee_is_nan(values(4))) self%i_yaw = 0.25_dp*self%m*self%r**2
        self%g = values(5)
        self%incline = values(6)
    end subroutine configure

    pure function pull(self) result(value)
        !! Gravity along the plane, \(g' = g\sin(\mathrm{incline})\), m/s^2.
        class(rolling_disk_t), intent(in) :: self
        real(dp) :: value

        value = self%g*sin(self%incline)
    end function pull

    pure function roll_acceleration(self) result(kappa)
        !! \(\kappa = mg'R/(I + mR^2)\), rad/s^2: of a disk that rolls straight downhill.
        class(rolling_disk_t), intent(in) :: self
        real(dp) :: kappa

        kappa = self%m*self%pull()*self%r/(self%i_roll + self%m*self%r**2)
    end function roll_acceleration

    pure subroutine accelerations(self, t, q, v, a)
        !! $$ \ddot\varphi = \kappa\sin\theta,\quad \ddot\theta = 0,\quad
        !!    \ddot x = R(\ddot\varphi\sin\theta + \dot\varphi\dot\theta\cos\theta),\quad
        !!    \ddot y = R(-\ddot\varphi\cos\theta + \dot\varphi\dot\theta\sin\theta) $$
        !! The forces of constraint are in them: the last two keep the disk rolling.
        class(rolling_disk_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp), intent(out) :: a(self%ndof)
        real(dp) :: s, c

        associate (r => self%r, phi_dot => v(3), theta_dot => v(4))
            s = sin(q(4))
            c = cos(q(4))
            a(3) = self%roll_acceleration()*s
            a(4) = 0.0_dp
            a(1) = r*(a(3)*s + phi_dot*theta_dot*c)
            a(2) = r*(-a(3)*c + phi_dot*theta_dot*s)
        end associate
    end subroutine accelerations

    pure function lagrangian(self, t, q, v) result(l)
        !! $$ L = \tfrac12 m(\dot x^2 + \dot y^2) + \tfrac12 I\dot\varphi^2
        !!      + \tfrac12 I_1\dot\theta^2 + m g' x $$
        class(rolling_disk_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof), v(self%ndof)
        type(hyperdual_t) :: l

        l = 0.5_dp*self%m*(v(1)**2 + v(2)**2) + 0.5_dp*self%i_roll*v(3)**2 &
            + 0.5_dp*self%i_yaw*v(4)**2 + self%m*self%pull()*q(1)
    end function lagrangian

    pure function energy(self, t, q, v) result(e)
        !! $$ E = \tfrac12 m(\dot x^2 + \dot y^2) + \tfrac12 I\dot\varphi^2
        !!      + \tfrac12 I_1\dot\theta^2 - m g' x $$
        class(rolling_disk_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp) :: e

        e = 0.5_dp*self%m*(v(1)**2 + v(2)**2) + 0.5_dp*self%i_roll*v(3)**2 &
            + 0.5_dp*self%i_yaw*v(4)**2 - self%m*self%pull()*q(1)
    end function energy

    pure function momentum_or_friction(self, i, t, q, v) result(value)
        !! In the order of the description. All but 1 and 2 hold only for a disk that rolls.
        class(rolling_disk_t), intent(in) :: self
        integer, intent(in) :: i
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp) :: value, a(self%ndof), s, c

        s = sin(q(4))
        c = cos(q(4))
        associate (m => self%m, r => self%r, kappa => self%roll_acceleration(), &
                   phi_dot => v(3), theta_dot => v(4))
            select case (i)
            case (1)
                value = self%i_yaw*theta_dot
            case (2)
                value = (self%i_roll + m*r**2)*phi_dot
            case (3)
                value = (self%i_roll + m*r**2)*phi_dot*theta_dot + m*self%pull()*r*c
            case (4)
                value = theta_dot*(theta_dot*q(1) + r*phi_dot*c) - 0.5_dp*r*kappa*s**2
            case (5)
                value = theta_dot*(theta_dot*q(2) + r*phi_dot*s) &
                        - 0.5_dp*r*kappa*(theta_dot*t - s*c)
            case (6)
                value = v(1) - r*s*phi_dot
            case (7)
                value = v(2) + r*c*phi_dot
            case (8, 9)
                call self%accelerations(t, q, v, a)
                value = merge(m*(a(1) - self%pull()), m*a(2), i == 8)
            case default
                value = m*v(i - 9)
            end select
        end associate
    end function momentum_or_friction

    pure subroutine positions(self, t, q, r)
        !! The centre, \((x, y, R)\): along the plane, and away from it.
        class(rolling_disk_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof)
        type(hyperdual_t), intent(out) :: r(:, :)

        r = hyperdual_t()
        r(1, 1) = q(1)
        r(2, 1) = q(2)
        r(3, 1) = self%r
    end subroutine positions

    pure subroutine constraint_rows(self, t, q, rows, drift)
        !! $$ \dot x - R\sin\theta\,\dot\varphi = 0,\qquad \dot y + R\cos\theta\,\dot\varphi = 0 $$
        !! The multipliers of these rows are the friction, N.
        class(rolling_disk_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof)
        type(hyperdual_t), intent(out) :: rows(:, :), drift(:)

        rows = hyperdual_t()
        drift = hyperdual_t()
        rows(1, 1) = 1.0_dp
        rows(1, 3) = -self%r*sin(q(4))
        rows(2, 2) = 1.0_dp
        rows(2, 3) = self%r*cos(q(4))
    end subroutine constraint_rows

    pure function free_velocities(self, t, q) result(free)
        !! \(\dot\varphi, \dot\theta\).
        class(rolling_disk_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof)
        logical :: free(self%ndof)

        free = [.false., .false., .true., .true.]
    end function free_velocities

    pure subroutine complete_velocities(self, t, q, given, v, error)
        !! From \((\dot\varphi, \dot\theta)\); or all four, which are kept as they are, so that the
        !! end of a run is the start of the next. They are refused if they do not roll: if what
        !! slips is a part \(\delta > \sqrt\epsilon\) of them. The energy that a smaller slip
        !! takes, a share of \(\delta^2\), is less than rounding.
        class(rolling_disk_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), given(:)
        real(dp), intent(out) :: v(self%ndof)
        type(error_t), allocatable, intent(out) :: error
        real(dp), parameter :: slip = sqrt(epsilon(1.0_dp))
        real(dp) :: rolling(2)

        v = 0.0_dp
        if (size(given) /= 2 .and. size(given) /= 4) then
            call fail(error, "v takes 2 values (phi_dot, theta_dot) or all 4, not "// &
                      to_text(size(given)))
            return
        end if
        v(3:4) = given(size(given) - 1:)
        rolling = self%r*v(3)*[sin(q(4)), -cos(q(4))]
        if (size(given) == 2) then
            v(1:2) = rolling
            return
        end if
        v(1:2) = given(1:2)
        if (.not. abs(v(1) - rolling(1)) <= slip*(norm2(v(1:2)) + self%r*abs(v(3)))) then
            call fail(error, "v does not roll: x_dot - r sin(theta) phi_dot = "// &
                      to_text(v(1) - rolling(1))//", not 0; v = phi_dot, theta_dot is enough")
        else if (.not. abs(v(2) - rolling(2)) <= slip*(norm2(v(1:2)) + self%r*abs(v(3)))) then
            call fail(error, "v does not roll: y_dot + r cos(theta) phi_dot = "// &
                      to_text(v(2) - rolling(2))//", not 0; v = phi_dot, theta_dot is enough")
        end if
    end subroutine complete_velocities

    pure subroutine accelerations_lanes(self, t, q, v, a)
        !! `accelerations`, in all lanes at once.
        class(rolling_disk_t), intent(in) :: self
        real(dp), intent(in) :: t(lanes), q(lanes, self%ndof), v(lanes, self%ndof)
        real(dp), intent(out) :: a(lanes, self%ndof)
        real(dp) :: s(lanes), c(lanes)

        associate (r => self%r, phi_dot => v(:, 3), theta_dot => v(:, 4))
            call sine_cosine(q(:, 4), s, c)
            a(:, 3) = self%roll_acceleration()*s
            a(:, 4) = 0.0_dp
            a(:, 1) = r*(a(:, 3)*s + phi_dot*theta_dot*c)
            a(:, 2) = r*(-a(:, 3)*c + phi_dot*theta_dot*s)
        end associate
    end subroutine accelerations_lanes

    pure subroutine angles(self, t, q, phi)
        !! Roll and heading.
        class(rolling_disk_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(:)
        type(hyperdual_t), intent(out) :: phi(:)

        phi = q(3:4)
    end subroutine angles

    pure subroutine newton(self, t, x, u, force, constraint_residual)
        !! Gravity, in axes along the plane and off it; the plane under the disk; rolling.
        class(rolling_disk_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, x(:), u(:)
        real(dp), intent(out) :: force(:)
        type(hyperdual_t), intent(out) :: constraint_residual(:)

        force = 0.0_dp
        force(1) = self%m*self%pull()
        force(3) = -self%m*self%g*cos(self%incline)
        constraint_residual(1) = x(3) - self%r
        constraint_residual(2) = u(1) - self%r*sin(x(5))*u(4)
        constraint_residual(3) = u(2) + self%r*cos(x(5))*u(4)
    end subroutine newton
end module lagrangia_rolling_disk
