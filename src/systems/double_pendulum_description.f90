submodule (lagrangia_double_pendulum) lagrangia_double_pendulum_description
    !! What the double pendulum says of itself.
    use lagrangia_description, only: conserved, coordinate, nonnegative, point, positive, &
                                     quantity
    implicit none (type, external)

contains

    pure module subroutine describe(self, d)
        !! See `system_t`.
        class(double_pendulum_t), intent(in) :: self
        type(description_t), intent(out) :: d

        d%name = "double_pendulum"
        d%title = "two rods and two bobs in a plane, chaotic at large amplitude"
        d%coordinates = [ &
            coordinate("theta1", "rad", "angle of the upper rod from the downward vertical"), &
            coordinate("theta2", "rad", "angle of the lower rod from the downward vertical")]
        d%parameters = [positive("m1", "kg", "mass of the upper bob", self%m1), &
                        positive("m2", "kg", "mass of the lower bob", self%m2), &
                        positive("l1", "m", "length of the upper rod", self%l1), &
                        positive("l2", "m", "length of the lower rod", self%l2), &
                        nonnegative("g", "m/s^2", "gravity", self%g)]
        d%energy_scale = self%g*((self%m1 + self%m2)*self%l1 + self%m2*self%l2)
        d%quantities = [ &
            quantity("L_z", "kg m^2/s", "p_theta1 + p_theta2: angular momentum about the pivot"), &
            quantity("tension1", "N", "m1 (l1 theta1_dot^2 + g cos(theta1)) "// &
                     "+ tension2 cos(theta1 - theta2): force along rod 1"), &
            quantity("tension2", "N", "m1 m2 (l1 theta1_dot^2 cos(D) + l2 theta2_dot^2 "// &
                     "+ g cos(theta1) cos(D))/(m1 + m2 sin(D)^2): rod 2")]
        if (self%g <= 0.0_dp) d%quantities(1) = &
            conserved("L_z", "kg m^2/s", "p_theta1 + p_theta2: angular momentum about the "// &
                      "pivot, conserved without gravity", 0.0_dp)
        d%points = [point("bob1", self%m1), point("bob2", self%m2)]
        d%reactions = [ &
            quantity("tension1", "N", "of the upper rod: (l1^2 - x1^2 - y1^2)/(2 l1) = 0"), &
            quantity("tension2", "N", "of the lower rod: (l2^2 - (x2 - x1)^2 - (y2 - y1)^2)"// &
                     "/(2 l2) = 0")]
        d%lagrangian = [character(len(d%title)) :: &
            "(m1 + m2)/2 l1^2 theta1_dot^2 + m2/2 l2^2 theta2_dot^2", &
            "+ m2 l1 l2 theta1_dot theta2_dot cos(D) + (m1 + m2) g l1 cos(theta1)", &
            "+ m2 g l2 cos(theta2),  D = theta1 - theta2"]
        d%energy = "(m1 + m2)/2 l1^2 theta1_dot^2 + m2/2 l2^2 theta2_dot^2 + m2 l1 l2 "// &
                   "theta1_dot theta2_dot cos(D) + V"
        d%equations = [character(len(d%title)) :: &
            "(m1 + m2) l1 theta1_ddot + m2 l2 theta2_ddot cos(D) + m2 l2 theta2_dot^2 sin(D)", &
            "    + (m1 + m2) g sin(theta1) = 0", &
            "l2 theta2_ddot + l1 theta1_ddot cos(D) - l1 theta1_dot^2 sin(D)", &
            "    + g sin(theta2) = 0,  D = theta1 - theta2"]
        d%constraint = "holonomic, scleronomic: x1^2 + y1^2 = l1^2, "// &
                       "(x2 - x1)^2 + (y2 - y1)^2 = l2^2"
        d%notes = [character(len(d%title)) :: &
            "V = -(m1 + m2) g l1 cos(theta1) - m2 g l2 cos(theta2).", &
            "The notes have x2^2 + y2^2 = l2^2: a slip, the second rod starts at the first bob.", &
            "dx2 = l1 cos(theta1) dtheta1 + l2 cos(theta2) dtheta2, and the same for delta x2.", &
            "omega^2 = g/(2 m1 l1 l2) ((m1 + m2)(l1 + l2) +- sqrt(...)); all equal: (2 +- "// &
            "sqrt(2)) g/l."]
        d%source = "Phys 601, 1 September 2011: double planar pendulum"
    end subroutine describe
end submodule lagrangia_double_pendulum_description
