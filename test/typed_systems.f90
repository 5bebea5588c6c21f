module typed_systems
    !! Systems of the lectures, typed as formulas: what a student could write into a scene.
    implicit none (type, external)
    private
    public :: typed_t, typed

    type :: typed_t
        !! The group `&lagrangian` for a system of the lectures, its parameters in the same order.
        character(20) :: name = ""
        character(600) :: lines = ""
    end type typed_t

    type(typed_t), parameter :: typed(*) = [ &
        typed_t("oscillator", "coordinates = 'x' parameters = 'm', 'k', 'b', 'F0', 'W' "// &
                "T = 'm/2 x_dot^2' V = '1/2 k x^2' Q_x = 'F0 cos(W t) - b x_dot'"), &
        typed_t("pendulum", "coordinates = 'theta' parameters = 'm', 'l', 'g', 'b' "// &
                "L = 'm/2 l^2 theta_dot^2 + m g l cos(theta)' Q_theta = '-b theta_dot'"), &
        typed_t("double_pendulum", "coordinates = 'theta1', 'theta2' "// &
                "parameters = 'm1', 'm2', 'l1', 'l2', 'g' definitions = 'D = theta1 - theta2' "// &
                "T = '(m1 + m2)/2 l1^2 theta1_dot^2 + m2/2 l2^2 theta2_dot^2' "// &
                "'+ m2 l1 l2 theta1_dot theta2_dot cos(D)' "// &
                "V = '-(m1 + m2) g l1 cos(theta1) - m2 g l2 cos(theta2)'"), &
        typed_t("cart_pendulum", "coordinates = 'x', 'theta' parameters = 'm1', 'm2', 'l', 'g' "// &
                "T = '(m1 + m2)/2 x_dot^2 + m2/2 l^2 theta_dot^2 + m2 l x_dot theta_dot "// &
                "cos(theta)' V = '-m2 g l cos(theta)'"), &
        typed_t("atwood", "coordinates = 'x' parameters = 'm1', 'm2', 'g', 'I', 'R', 'a_s' "// &
                "L = '(m1 + m2 + I/R^2)/2 x_dot^2 + (m1 - m2)(g x - a_s t x_dot) + "// &
                "(m1 + m2)/2 (a_s - g) a_s t^2'"), &
        typed_t("wedge", "coordinates = 'q1', 'q2' parameters = 'm', 'M_w', 'alpha', 'g' "// &
                "T = '(M_w + m)/2 q2_dot^2 + m/2 (q1_dot^2 + 2 q1_dot q2_dot cos(alpha))' "// &
                "V = '-m g q1 sin(alpha)'"), &
        typed_t("rotating_hoop", "coordinates = 'theta' parameters = 'm', 'r', 'omega', 'g' "// &
                "T = 'm/2 r^2 (theta_dot^2 + omega^2 sin^2(theta))' V = '-m g r cos(theta)'"), &
        typed_t("rotating_wire", "coordinates = 'r' parameters = 'm', 'omega' "// &
                "T = 'm/2 (r_dot^2 + omega^2 r^2)'"), &
        typed_t("driven_pendulum", "coordinates = 'theta' parameters = 'm', 'l', 'g', 'a', "// &
                "'W', 'b' Q_theta = '-b theta_dot' "// &
                "definitions = 'y = a cos(W t) - l cos(theta)', "// &
                "'w_y = -a W sin(W t) + l theta_dot sin(theta)' "// &
                "T = 'm/2 ((l theta_dot cos(theta))^2 + w_y^2)' V = 'm g y'"), &
        typed_t("charged_particle", "coordinates = 'x', 'y', 'z' parameters = 'm', 'e', 'Ex', "// &
                "'Ey', 'Ez', 'Bx', 'By', 'Bz', 'k' T = 'm/2 (x_dot^2 + y_dot^2 + z_dot^2)' "// &
                "V = 'k/2 (x^2 + y^2 + z^2) - e (Ex x + Ey y + Ez z)' "// &
                "'- e/2 ((By z - Bz y) x_dot + (Bz x - Bx z) y_dot + (Bx y - By x) z_dot)'")]
end module typed_systems
