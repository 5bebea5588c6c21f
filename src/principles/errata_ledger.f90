module lagrangia_errata_ledger
    !! The slips in the lecture notes, as data: where they stand, what is written, what follows from
    !! the notes' own Lagrangians and constraints, and what the slip would do.
    !!
    !! Lines are those of the scans' text: I of "Classical Mechanics (Phys 601), 1 September 2011",
    !! II of "Hamilton's Principle".
    implicit none (type, external)
    private
    public :: slip_t, slips_of_the_notes
    public :: kind_equation, kind_principle, kind_scan
    public :: line_length

    integer, parameter :: line_length = 100

    character(9), parameter :: kind_equation = "equation"    !! the written mathematics is wrong
    character(9), parameter :: kind_principle = "principle"  !! a statement claims too much
    character(9), parameter :: kind_scan = "scan"            !! a letter or a dot: the scanner's

    type :: slip_t
        character(3) :: id = ""
        character(9) :: kind = ""
        character(40) :: subject = ""
        character(32) :: place = ""                 !! scan and lines
        character(line_length) :: written = ""
        character(line_length) :: derived = ""
        character(line_length) :: effect = ""       !! what it would do; "" if nothing
        character(16) :: principle = ""             !! whose report has the numbers; "" if none
    end type slip_t

contains

    pure function slips_of_the_notes() result(slips)
        !! All of them, in the order of the pages.
        type(slip_t), allocatable :: slips(:)

        allocate (slips(0))
        call add("E1", kind_equation, "cart-pendulum, equation of theta", "I, lines 140 to 154", &
                 "m2 l^2 theta_ddot + m2 l x_ddot cos(theta) - m2 g l sin(theta) = 0", &
                 "m2 l^2 theta_ddot + m2 l x_ddot cos(theta) + m2 g l sin(theta) = 0", &
                 "omega^2 = -(m1 + m2) g/(m1 l) < 0: a hanging pendulum that falls up")
        call add("E2", kind_equation, "cart-pendulum, L, first line", "I, line 134", &
                 "m2/2 (x_dot^2 + l^2 theta_dot^2 cos^2(theta) + l^2 theta_dot^2 sin^2(theta))", &
                 "m2/2 (... + 2 l x_dot theta_dot cos(theta)), as the second line has it", &
                 "cart and bob are not coupled: omega^2 = g/l, whatever the masses")
        call add("E3", kind_equation, "cart-pendulum, the set of equations", "I, line 142", &
                 "m2 l theta_ddot + m2 l x_ddot cos(theta) - m2 g l sin(theta) = 0", &
                 "m2 l^2 theta_ddot + m2 l x_ddot cos(theta) + m2 g l sin(theta) = 0", &
                 "wrong as soon as l is not 1 m; the sign is E1's")
        call add("E4", kind_equation, "cart-pendulum, small theta, x", "I, lines 152 and 154", &
                 "(m1 + m2) x_ddot + l theta_ddot - l theta_dot^2 theta = 0", &
                 "(m1 + m2)/m2 x_ddot + l theta_ddot - l theta_dot^2 theta = 0", &
                 "wrong as soon as m2 is not 1 kg")
        call add("E5", kind_scan, "cart-pendulum, letters and dots", "I, lines 138 to 142", &
                 "m3 l x_ddot cos(theta); d/dt with round d; (m1 + m2) x_dot; a term struck out", &
                 "m2; straight d; x_ddot, theta_ddot; the struck-out term cancels", "")
        call add("E6", kind_equation, "cart-pendulum, the frequency", "I, line 164", &
                 "omega^2 ~ (m1 + m2)/m1 g/l", &
                 "omega^2 = (m1 + m2)/m1 g/l, exactly, of the linear equations", "")
        call add("E7", kind_equation, "double pendulum, constraints", "I, line 111", &
                 "f_i = x_i^2 + y_i^2 = l_i^2 for i = 1, 2", &
                 "so for i = 1; f_2 = (x2 - x1)^2 + (y2 - y1)^2 = l2^2", &
                 "both bobs would hang from the pivot", "constraints")
        call add("E8", kind_scan, "double pendulum, mixed partials", "I, lines 113 to 115", &
                 "A_x1 = 2 x, dA_y1/dz1", "A_x1 = 2 x1, dA_y1/dx1", "")
        call add("E9", kind_principle, "rolling disk, why nonholonomic", "I, line 132", &
                 "dA_phi/dtheta /= dA_theta/dphi, therefore nonholonomic", &
                 "that says not exact; nonholonomic takes Frobenius: no integrating factor", &
                 "y dx - x dy = 0 would be nonholonomic, and it is x/y = const", "constraints")
        call add("E10", kind_equation, "a charge without magnetic field", "I, line 84", &
                 "B = 0, then F = -grad(phi)", "F = -e grad(phi), and only if dA/dt = 0, too", &
                 "every charge would be 1 C, and induction would push nothing", "virtual-work")
        call add("E11", kind_principle, "conservative forces", "I, line 62", &
                 "V does not depend on the time (in Cartesian coordinates)", &
                 "enough, not needed: V(x, t) gives the same equations, only energy is lost", &
                 "a pendulum whose pivot is driven would have no Lagrangian")
        call add("E12", kind_equation, "L + dF/dt, the chain rule", "I, line 105", &
                 "dF/dt = sum over k of (dF/dq_k + dF/dt)", &
                 "dF/dt = sum over k of dF/dq_k q_k_dot, + dF/dt once", &
                 "the added term would change the motion")
        call add("E13", kind_scan, "full differential", "I, lines 36 to 43, 119", &
                 "sum of dx_i/dq_i dq_i + dz_i/dt dt; 3m - k", &
                 "dx_j = sum over i of dx_j/dq_i dq_i + dx_j/dt dt; 3n - k", "")
        call add("E14", kind_principle, "nonholonomic, for example y > 0", "I, line 16", &
                 "y > 0 is a nonholonomic constraint", &
                 "unilateral: an inequality. Nonholonomic ones are equations of velocities", &
                 "it takes away no degree of freedom until it touches", "constraints")
        call add("E15", kind_principle, "Hamilton's principle", "II, line 18", &
                 "the actual path minimizes the integral of T - U", &
                 "makes it stationary; least only for times below half a period", &
                 "longer swings would be impossible", "action")
        call add("E16", kind_principle, "Hero, Fermat", "II, lines 5 and 6", &
                 "light takes the shortest path, or the least time", &
                 "a stationary one: in a concave mirror the longest, in an ellipse all are alike", &
                 "no image in a concave mirror", "least-time")
        call add("E17", kind_scan, "Maupertuis", "II, line 8", "takes place with minimum motion", &
                 "with stationary action, the integral of p dq at given energy", "")
        call add("E18", kind_equation, "oscillator, momentum", "II, line 32", &
                 "dL/dx_dot = m d(x_dot)/dt", "dL/dx_dot = m x_dot", &
                 "one derivative too many: the equation of motion would be of third order")
        call add("E19", kind_scan, "Atwood's machine", "II, line 87", &
                 "(m1 - m2) g = (m1 + m2) d(x_dot^2)/dt^2", "(m1 + m2) d^2x/dt^2", "")
        call add("E20", kind_equation, "wedge, kinetic energy", "II, line 93", &
                 "T_M = M/2 d(q2_dot)/dt", "T_M = M/2 q2_dot^2", &
                 "not an energy: the wedge would have no inertia of its own")
        call add("E21", kind_equation, "wedge, equation of q1", "II, lines 113 and 115", &
                 "m g sin(alpha) = M (q1_ddot + q2_ddot cos(alpha))", &
                 "m g sin(alpha) = m (q1_ddot + q2_ddot cos(alpha))", &
                 "off by m/M, against the notes' own q1_ddot")
        call add("E22", kind_scan, "L in generalized coordinates", "II, lines 44 to 54", &
                 "= U(q_j, q_j_dot, t)", "= L(q_j, q_j_dot, t); s = 3n - number of constraints", "")
        call add("E23", kind_scan, "dates", "II, lines 5 to 12", &
                 "Hero 2nd century B.C.; Maupertuis 1747; Gauss 1828", &
                 "Hero about the 1st century A.D.; 1744; 1829", "")
    contains
        pure subroutine add(id, kind, subject, place, written, derived, effect, principle)
            character(*), intent(in) :: id, kind, subject, place, written, derived, effect
            character(*), intent(in), optional :: principle
            type(slip_t) :: slip

            slip = slip_t(id, kind, subject, place, written, derived, effect)
            if (present(principle)) slip%principle = principle
            slips = [slips, slip]
        end subroutine add
    end function slips_of_the_notes
end module lagrangia_errata_ledger
