module lagrangia_course_table
    !! The lecture's notes, line by line: what stands there, what it says in plain words, and which
    !! command shows it; or why nothing does.
    !!
    !! Lines are those of the scans' text: I of "Classical Mechanics (Phys 601), 1 September 2011",
    !! II of "Hamilton's Principle". Every line with a letter on it belongs to a statement.
    !! `data/reference/lecture_notes.txt` holds the quoted parts.
    implicit none (type, external)
    private
    public :: course_of_the_notes, statement_t

    type :: statement_t
        character(2) :: scan = ""     !! I or II
        integer :: line = 0           !! of the scan's text, where it begins
        integer :: last = 0           !! and where it ends
        character(120) :: quote = ""  !! a part of these lines, word for word
        character(90) :: says = ""    !! in our words
        character(80) :: shows = ""   !! commands without `lagrangia`, with `; ` between them
        character(60) :: nothing = "" !! why nothing shows it
    end type statement_t

contains

    pure function course_of_the_notes() result(course)
        !! All statements of both notes, in their order.
        type(statement_t), allocatable :: course(:)

        allocate (course(0))
        call first_lecture(course)
        call second_lecture(course)
    end function course_of_the_notes

    pure subroutine add(course, scan, line, last, quote, says, shows, nothing)
        !! One more statement.
        type(statement_t), allocatable, intent(inout) :: course(:)
        character(*), intent(in) :: scan, quote, says
        integer, intent(in) :: line, last
        character(*), intent(in), optional :: shows, nothing
        type(statement_t), allocatable :: longer(:)
        type(statement_t) :: statement

        statement = statement_t(scan, line, last, quote, says)
        if (present(shows)) statement%shows = shows
        if (present(nothing)) statement%nothing = nothing
        allocate (longer(size(course) + 1))
        longer(:size(course)) = course
        longer(size(longer)) = statement
        call move_alloc(longer, course)
    end subroutine add

    pure subroutine first_lecture(course)
        !! Phys 601, 1 September 2011.
        type(statement_t), allocatable, intent(inout) :: course(:)

        call add(course, "I", 3, 3, &
                 "3 n contesion coordinates for n particles {x;} 3 n-k generalized "// &
                 "coordinates (q; }", &
                 "3n Cartesian coordinates of n particles; k constraints leave 3n - k "// &
                 "generalized ones", &
                 "principle constraints")
        call add(course, "I", 3, 3, &
                 "independent set that completely specifies the system", &
                 "the q are independent and say where every mass is: x = x(q, t)", &
                 "derive double_pendulum --numbers")
        call add(course, "I", 3, 3, &
                 "Full differential: $dx_j = ", &
                 "a displacement dx = sum of dx/dq dq + dx/dt dt", &
                 "principle virtual-work; errata E13")
        call add(course, "I", 3, 3, &
                 "e.g. given dt -> changes in dz; even if dt zero, but constraints Virtual "// &
                 "displacement", &
                 "a virtual displacement: the constraints stand still, dt = 0", &
                 "principle virtual-work")
        call add(course, "I", 5, 6, &
                 "what motivates the search for helenomic / non holonomic constraints?", &
                 "why one asks whether a constraint is holonomic", &
                 "principle constraints")
        call add(course, "I", 7, 8, &
                 "* 3N cartesian coordinates - s generalized coordinates", &
                 "how many coordinates are left", &
                 "principle constraints")
        call add(course, "I", 9, 13, &
                 "holonomic constraint: $x_i = x_i (\{q, f, t\}) = c_i$", &
                 "holonomic: f(x, t) = c, and one variable less for each of them", &
                 "principle constraints; principle reactions; errata E28")
        call add(course, "I", 14, 14, &
                 "nonholonomic constraint -> more difficult case", &
                 "nonholonomic: a constraint on velocities, which takes away no coordinate", &
                 "principle vakonomic; run rolling_disk; principle constraints")
        call add(course, "I", 15, 16, &
                 "nonholonomic constraint -> more difficult case e.g. y >0", &
                 "the example y > 0: a floor, which is another class (unilateral)", &
                 "run bouncing_ball; errata E14")
        call add(course, "I", 17, 22, &
                 "the set of son independent", &
                 "Lagrange's equations one by one need independent delta q; else multipliers", &
                 "check rolling_disk; principle vakonomic")
        call add(course, "I", 28, 32, &
                 "* Lagrange's Equations:", &
                 "D'Alembert: sum of (p_dot - F) delta x = 0", &
                 "principle virtual-work")
        call add(course, "I", 34, 34, &
                 "generalized forces Q_{i}", &
                 "the generalized force: Q = sum of F dx/dq", &
                 "principle virtual-work; principle dalembert")
        call add(course, "I", 36, 43, &
                 "(\dot{p}_{i} - F_{i}) \delta x_{i} = \sum_{i}^{3m} (\dot{p}_{i} - F_{i}) "// &
                 "\underbrace{\sum_{i}^{3m-k}", &
                 "sum of m x_ddot dx/dq becomes d/dt dT/dq_dot - dT/dq, term by term", &
                 "principle dalembert; errata E32")
        call add(course, "I", 45, 50, &
                 "- identify the octernal forces", &
                 "the recipe: forces, coordinates, T in these coordinates", &
                 "derive cart_pendulum --numbers")
        call add(course, "I", 51, 53, &
                 "- compute generalized forces as", &
                 "the recipe: Q from the forces", &
                 "principle virtual-work; errata E30")
        call add(course, "I", 54, 54, &
                 "- solve the equations!", &
                 "the recipe: the motion", &
                 "run cart_pendulum; run double_pendulum")
        call add(course, "I", 58, 60, &
                 "Conservative forces:", &
                 "F = -grad V", &
                 "principle virtual-work")
        call add(course, "I", 62, 62, &
                 "(in cartesian coordinates: V does not depend on time", &
                 "V(x) has no time; V(q, t) gets it through x(q, t), as of a pivot that moves", &
                 "run driven_pendulum; errata E11")
        call add(course, "I", 64, 65, &
                 "\Rightarrow Q_j = -\frac{\partial V}{\partial q_j} (\{q_j\}, t)", &
                 "Q = -dV/dq for every system whose V has no velocities", &
                 "principle virtual-work")
        call add(course, "I", 66, 69, &
                 "$\frac{d}{dt} (\frac{\partial T}{\partial q_j}) - \frac{\partial "// &
                 "(T-V)}{\partial q_j} = 0$", &
                 "Lagrange's equations with T - V, against the hand-derived ones", &
                 "check; errata E27")
        call add(course, "I", 71, 71, &
                 "L=T-V= Lagrangian", &
                 "T, V and L of a system", &
                 "describe cart_pendulum")
        call add(course, "I", 73, 78, &
                 "velocity-dependent ""generalized potentials"" U(q;q;)", &
                 "Q = -dU/dq + d/dt dU/dq_dot: L = T - U still holds", &
                 "principle virtual-work")
        call add(course, "I", 80, 82, &
                 "e.g. electromagnetic fields on morring charges", &
                 "F = e (E + v x B) on a charge that moves", &
                 "run charged_particle")
        call add(course, "I", 84, 84, &
                 "If $\overline{B}=\overline{\delta} \to \overline{F}=-\overline{V}\varphi$", &
                 "without B: F = -e grad phi", &
                 "errata E10")
        call add(course, "I", 86, 88, &
                 "E and B can be derived from the scalar potential", &
                 "E = -grad phi - dA/dt, B = rot A, and the force they make", &
                 "principle virtual-work")
        call add(course, "I", 90, 91, &
                 "L = \frac{1}{2} m v^2 - e \varphi + e \overline{A \cdot v}", &
                 "this L gives that force", &
                 "check charged_particle; describe charged_particle")
        call add(course, "I", 93, 95, &
                 "multiple Lagrangians can lead to the same equations of motion", &
                 "more than one L for one motion", &
                 "principle same-motion; principle gauge")
        call add(course, "I", 97, 97, &
                 "e.g. $L = \frac{1}{2} m l^2 \hat{O}^2 + mg l \cos \theta - constant", &
                 "a constant in L changes no derivative of it", &
                 "principle same-motion")
        call add(course, "I", 99, 107, &
                 "=> F does not show up in the equations of motion", &
                 "L + dF/dt with F(q, t): the same equations", &
                 "principle gauge; principle noether; errata E12")
        call add(course, "I", 109, 111, &
                 "* Double planar pendulum;", &
                 "its two constraints, both of them lengths of rods", &
                 "principle constraints; errata E7")
        call add(course, "I", 113, 116, &
                 ", etc... => holonomic", &
                 "equal mixed partials: a constraint that can be integrated", &
                 "principle constraints; errata E8")
        call add(course, "I", 118, 124, &
                 "= \ell_1 \cos \theta_1 d\theta_1 + \ell_2 \cos \theta_2 d\theta_2", &
                 "delta x2 of the double pendulum", &
                 "principle virtual-work")
        call add(course, "I", 126, 130, &
                 "$A_{\varphi} = -R\sin\theta$, $A_0 = 0$ for \dot{x}", &
                 "the rolling disk: dx - R sin(theta) dphi = 0", &
                 "run rolling_disk; principle geometric-phase; principle vakonomic")
        call add(course, "I", 132, 132, &
                 "\frac{\partial A_{\varphi}}{\partial \theta} = -R\cos\theta", &
                 "unequal mixed partials; what really makes it nonholonomic", &
                 "principle constraints; principle geometric-phase; errata E9")
        call add(course, "I", 134, 136, &
                 "m_2 l \dot{x} \dot{\theta} \cos \theta + m_2 q l \cos \theta", &
                 "L of the cart with a pendulum", &
                 "derive cart_pendulum; errata E2")
        call add(course, "I", 138, 140, &
                 "- m_2 l \dot{\theta}^2 \sin \theta = 0", &
                 "its two equations of motion", &
                 "derive cart_pendulum --numbers; errata E1")
        call add(course, "I", 142, 146, &
                 "l \ddot{0} + \ddot{x} \cos 0 - g \sin 0 = 0", &
                 "the same, divided by m2 and m2 l, with the wrong sign of g", &
                 "derive cart_pendulum --slip E1; errata E3")
        call add(course, "I", 148, 154, &
                 "Small \ 0 : \cos 0 = 1 , \sin 0 = 0", &
                 "small theta: cos(theta) = 1, sin(theta) = theta", &
                 "modes cart_pendulum; errata E4")
        call add(course, "I", 156, 160, &
                 "0 \sim A \omega^2, \quad O^2 \sim A^2 \omega^2, \quad O^2 O \sim A^3 "// &
                 "\omega^2", &
                 "theta_dot^2 theta is of third order, and is dropped", &
                 "principle small-angle; sweep period_of_amplitude")
        call add(course, "I", 162, 164, &
                 "\omega^2 \sim \left(\frac{m_1 + m_2}{m_1}\right)", &
                 "omega^2 = (m1 + m2) g/(m1 l)", &
                 "modes cart_pendulum; errata E6")
    end subroutine first_lecture

    pure subroutine second_lecture(course)
        !! Hamilton's Principle.
        type(statement_t), allocatable, intent(inout) :: course(:)

        call add(course, "II", 3, 3, &
                 "Hamilton's Principle", &
                 "the title of the second lecture", &
                 "principle action")
        call add(course, "II", 5, 5, &
                 "reflection of light always takes the shortest path", &
                 "Hero: a mirror; not always the shortest path", &
                 "principle least-time; errata E16")
        call add(course, "II", 6, 6, &
                 "a path that requires the least time.", &
                 "Fermat: from air into glass", &
                 "principle least-time")
        call add(course, "II", 8, 8, &
                 "1747 Maupertuis dynamical motion takes place with minimum motion", &
                 "Maupertuis: least action at a fixed energy", &
                 "principle maupertuis; errata E17")
        call add(course, "II", 10, 10, &
                 "1760 Lagrange", &
                 "a year", &
                 nothing="a date, which no computation can show")
        call add(course, "II", 12, 12, &
                 "1828 Gauss least constraint", &
                 "Gauss: the accelerations make a sum of squares least", &
                 "principle gauss-hertz; check double_pendulum")
        call add(course, "II", 14, 14, &
                 "Hertz least curvature", &
                 "Hertz: without forces a system takes the straightest path", &
                 "principle gauss-hertz")
        call add(course, "II", 16, 16, &
                 "1834, 1835 Hamilton", &
                 "two years", &
                 nothing="dates, which no computation can show")
        call add(course, "II", 18, 18, &
                 "the actual path followed is that which minimizes the time integral", &
                 "the actual path makes the action stationary; least only at first", &
                 "principle action; principle all-paths; errata E15")
        call add(course, "II", 20, 24, &
                 "\delta \int_{t_1}^{t_2} (T - U) dt = 0", &
                 "delta S = 0, solved for the path itself", &
                 "principle action; principle all-paths")
        call add(course, "II", 26, 26, &
                 "\frac{\partial L}{\partial x_i} - \frac{d}{dt} \frac{\partial L}{\partial "// &
                 "\dot{x}_i} = 0", &
                 "Lagrange's equations of every system, by exact derivatives", &
                 "check")
        call add(course, "II", 28, 30, &
                 "L = T - U = \frac{1}{2} m \left(\frac{dx}{dt} \right)^2 - \frac{1}{2} k x^2", &
                 "L of the oscillator", &
                 "describe oscillator")
        call add(course, "II", 32, 32, &
                 "\frac{\partial L}{\partial x} = -kx", &
                 "its derivatives", &
                 "derive oscillator --numbers; errata E18")
        call add(course, "II", 34, 34, &
                 "m \frac{d^2x}{dt^2} + kx = 0", &
                 "its motion", &
                 "run oscillator; modes oscillator")
        call add(course, "II", 36, 38, &
                 "degrees of freedom $3n$", &
                 "how many coordinates n particles have", &
                 "principle constraints")
        call add(course, "II", 40, 48, &
                 "generalized coordinates q_j", &
                 "x(q, t): coordinates, velocities, and how the masses follow them", &
                 "principle virtual-work; errata E22")
        call add(course, "II", 50, 54, &
                 "Lagrange's Equations of Motion in Generalized Coordinates", &
                 "T - U in Cartesian coordinates is L(q, q_dot, t)", &
                 "derive double_pendulum --numbers; errata E22")
        call add(course, "II", 56, 56, &
                 "Hamilton's principle $\delta \int_{t_1}^{t_2}", &
                 "Hamilton's principle for the q", &
                 "principle action")
        call add(course, "II", 58, 58, &
                 "\frac{\partial \mathcal{L}}{\partial q_j} - \frac{d}{dt} \frac{\partial "// &
                 "\mathcal{L}}{\partial \dot{q}_j} = 0", &
                 "Lagrange's equations for the q; and Hamilton's, from H", &
                 "check; principle phase-space")
        call add(course, "II", 60, 60, &
                 "the forces acting on the system must be derivable from potentials", &
                 "forces with a potential; those without stand beside L", &
                 "principle helmholtz; run damped_oscillator")
        call add(course, "II", 62, 62, &
                 "the equations of constraint must be relations that connect the coordinates", &
                 "holonomic constraints; the forces that they need", &
                 "principle constraints; principle reactions")
        call add(course, "II", 65, 65, &
                 "fixed or scleronomous", &
                 "no time in the constraint: scleronomic", &
                 "principle constraints; run double_pendulum")
        call add(course, "II", 66, 66, &
                 "moving constraints are rheonomic", &
                 "time in the constraint: rheonomic", &
                 "principle constraints; run rotating_wire")
        call add(course, "II", 68, 68, &
                 "the equation of constraint can be expressed as an equation that involves "// &
                 "only the coordinates", &
                 "what holonomic means, tried on eleven constraints", &
                 "principle constraints")
        call add(course, "II", 70, 70, &
                 "the equation of constraint independent of time: scleronomous or fixed", &
                 "the rods of the double pendulum", &
                 "principle constraints")
        call add(course, "II", 72, 72, &
                 "contains time explicitly: rheonomic", &
                 "the turning wire, the turning hoop, the pivot that moves", &
                 "run rotating_hoop; run driven_pendulum")
        call add(course, "II", 74, 78, &
                 "x + y + \pi R = l", &
                 "Atwood's machine: one string, one coordinate", &
                 "describe atwood; derive atwood")
        call add(course, "II", 81, 81, &
                 "= \frac{1}{2} (m_1 + m_2) \left(\frac{dx}{dt} \right)^2$$", &
                 "its T", &
                 "derive atwood --numbers")
        call add(course, "II", 83, 83, &
                 "= -(m_1 - m_2) g x + \text{constant}", &
                 "its U", &
                 "derive atwood --numbers")
        call add(course, "II", 85, 85, &
                 "+ (m_1 - m_2) g x", &
                 "its L", &
                 "derive atwood")
        call add(course, "II", 87, 87, &
                 "\frac{m_1 - m_2}{m_1 + m_2} g \text{ elastically measure for } g", &
                 "x_ddot = (m1 - m2)/(m1 + m2) g: a slow fall, by which g can be measured", &
                 "principle measure-g; run atwood; errata E19")
        call add(course, "II", 89, 89, &
                 "case II a block sliding on a wedge", &
                 "a block on a wedge that is free to slide", &
                 "run wedge")
        call add(course, "II", 93, 93, &
                 "\vec{v} = (v_x, v_y)", &
                 "the block's velocity from q1 and q2", &
                 "derive wedge --numbers; errata E20")
        call add(course, "II", 95, 97, &
                 "T = T_m + T_M", &
                 "T of block and wedge", &
                 "derive wedge --numbers")
        call add(course, "II", 99, 101, &
                 "+ m g q_1 \sin \alpha", &
                 "U, and L", &
                 "derive wedge")
        call add(course, "II", 103, 105, &
                 "= \text{constant}", &
                 "q2 is not in L: its momentum is conserved", &
                 "check wedge; run wedge; principle noether")
        call add(course, "II", 107, 109, &
                 "\frac{g \sin \alpha}{1 - \frac{m \cos^2 \alpha}{M+m}}", &
                 "both accelerations", &
                 "derive wedge; principle reactions")
        call add(course, "II", 111, 115, &
                 "= M \left(\frac{d^2 q_1}{dt^2} + \frac{d^2 q_2}{dt^2} \cos \alpha \right)", &
                 "the equation of q1, with M in the place of m", &
                 "errata E21; grade wedge")
    end subroutine second_lecture
end module lagrangia_course_table
