submodule (lagrangia_rolling_disk) lagrangia_rolling_disk_description
    !! What the rolling disk says of itself.
    use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
    use lagrangia_description, only: between, conserved, coordinate, nonnegative, point, &
                                     positive, quantity
    implicit none (type, external)

    real(dp), parameter :: right_angle = acos(0.0_dp)

contains

    pure module subroutine describe(self, d)
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
            positive("i_yaw", "kg m^2", "moment of inertia about the vertical", i_yaw, &
                     computed="m r^2/4"), &
            nonnegative("g", "m/s^2", "gravity", self%g), &
            between("incline", "rad", "angle of the plane, down towards +x", self%incline, &
                    -right_angle, right_angle)]
        d%energy_scale = self%m*self%g*self%r
        associate (speed => sqrt(self%g*self%r))
            d%quantities = [ &
                conserved("p_theta", "kg m^2/s", "i_yaw theta_dot: steering goes on", &
                          self%m*self%r*speed), &
                quantity("p_phi", "kg m^2/s", "(i_roll + m r^2) phi_dot: about the contact; "// &
                         "conserved on the level"), &
                conserved("roll_yaw", "J", "(i_roll + m r^2) phi_dot theta_dot + "// &
                          "m g r sin(incline) cos(theta): on any incline", d%energy_scale), &
                conserved("orbit_x", "m/s^2", "theta_dot (theta_dot x + r phi_dot cos(theta)) "// &
                          "- r kappa sin(theta)^2/2: level, theta_dot^2 times the centre's x", &
                          self%g), &
                conserved("orbit_y", "m/s^2", "theta_dot (theta_dot y + r phi_dot sin(theta)) "// &
                          "- r kappa (theta_dot t - sin(2 theta)/2)/2", self%g), &
                conserved("slip_x", "m/s", "x_dot - r sin(theta) phi_dot: zero, it rolls", speed), &
                conserved("slip_y", "m/s", "y_dot + r cos(theta) phi_dot: zero, it rolls", speed), &
                quantity("friction_x", "N", "lambda_x: force of the plane that keeps it rolling"), &
                quantity("friction_y", "N", "lambda_y: force of the plane that keeps it rolling"), &
                quantity("p_x", "kg m/s", "m x_dot: changes, although on the level L has no x"), &
                quantity("p_y", "kg m/s", "m y_dot: changes, although L has no y")]
            if (abs(self%pull()) <= 0.0_dp) d%quantities(2) = &
                conserved("p_phi", "kg m^2/s", "(i_roll + m r^2) phi_dot: about the contact; "// &
                          "the plane is level", &
                          self%m*self%r*speed)
        end associate
        d%points = [point("centre", self%m)]
        d%rotors = [point("roll", self%i_roll), point("heading", self%i_yaw)]
        d%reactions = [ &
            quantity("plane_force", "N", "of the plane on the disk, off it: z = r"), &
            quantity("friction_x", "N", "x_dot - r sin(theta) phi_dot = 0"), &
            quantity("friction_y", "N", "y_dot + r cos(theta) phi_dot = 0")]
        d%dimensions = 3
        d%lagrangian = [character(len(d%title)) :: &
            "m/2 (x_dot^2 + y_dot^2) + i_roll/2 phi_dot^2 + i_yaw/2 theta_dot^2 "// &
            "+ m g x sin(incline)"]
        d%energy = "m/2 (x_dot^2 + y_dot^2) + i_roll/2 phi_dot^2 + i_yaw/2 theta_dot^2 "// &
                   "- m g x sin(incline)"
        d%equations = [character(len(d%title)) :: &
            "m x_ddot = m g sin(incline) + lambda_x,   m y_ddot = lambda_y", &
            "i_roll phi_ddot = - r sin(theta) lambda_x + r cos(theta) lambda_y", &
            "i_yaw theta_ddot = 0", &
            "without lambda: phi_ddot = kappa sin(theta),   "// &
            "kappa = m g r sin(incline)/(i_roll + m r^2)"]
        d%constraint = "nonholonomic, scleronomic: x_dot - r sin(theta) phi_dot = 0, "// &
                       "y_dot + r cos(theta) phi_dot = 0"
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
            "What holds the disk upright resists no motion; v may be given as phi_dot, theta_dot."]
        d%source = "Phys 601, 1 September 2011: nonholonomic constraint A.q_dot + B = 0"
    end subroutine describe
end submodule lagrangia_rolling_disk_description
