module lagrangia_errata_ledger
    !! The slips in the lecture notes, as data: where they stand, word for word, how that reads,
    !! what follows from the notes' own Lagrangians and constraints, and what the slip would do.
    !!
    !! `data/reference/lecture_notes.txt` holds the lines that are quoted.
    !!
    !! Lines are those of the scans' text: I of "Classical Mechanics (Phys 601), 1 September 2011",
    !! II of "Hamilton's Principle".
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: slips_of_the_notes
    public :: quote_t, slip_t
    public :: kind_lecture, kind_none, kind_scan, kind_terminology
    public :: line_length

    integer, parameter :: line_length = 120
    integer, parameter :: most_quotes = 8

    character(11), parameter :: kind_lecture = "lecture"  !! the mathematics or a claim is wrong
    character(11), parameter :: kind_scan = "scan"        !! letters, dots: the scanner's
    character(11), parameter :: kind_terminology = "terminology"  !! right, by another name
    character(11), parameter :: kind_none = "no slip"     !! it was taken for one

    type :: quote_t
        !! A part of a line of the scans' text, word for word.
        character(2) :: scan = ""               !! I or II; "" if there is no quote
        integer :: line = 0
        character(line_length) :: text = ""
    end type quote_t

    type :: slip_t
        character(3) :: id = ""
        character(11) :: kind = ""
        character(40) :: subject = ""
        type(quote_t) :: quotes(most_quotes)        !! the most telling one first
        type(quote_t) :: elsewhere                  !! where the notes have it right
        character(line_length) :: reads = ""        !! the first quote, or all, in our letters
        character(line_length) :: derived = ""
        character(line_length) :: effect = ""       !! what it would do; "" if nothing
        character(16) :: principle = ""             !! whose report has the numbers; "" if none
        character(16) :: system = ""                !! in whose letters the formulas are
        character(line_length) :: wrong = ""        !! `reads` as an equation in these letters
        character(line_length) :: right = ""        !! `derived` as one
        character(line_length) :: without = ""      !! parameters that the notes do not have: zero
    contains
        procedure :: place
    end type slip_t

contains

    pure function slips_of_the_notes() result(slips)
        !! All of them; E1 to E23 in the order of the pages.
        type(slip_t), allocatable :: slips(:)

        allocate (slips(0))
        call add("E1", kind_lecture, "cart-pendulum, equation of theta", &
                 [quote_t("I", 146, "l \ddot{0} + \ddot{x} \cos 0 - g \sin 0 = 0"), &
                  quote_t("I", 140, "- m_2 g \ell \sin \theta = 0"), &
                  quote_t("I", 142, "m_2 l \ddot{0} + m_2 l \ddot{x} \cos 0 - m_2 g l \sin 0 "// &
                                    "= 0"), &
                  quote_t("I", 150, "m_2 l^2 \ddot{0} + m_2 l \ddot{x} - m_2 g l 0 = 0"), &
                  quote_t("I", 152, "l d + \ddot{x} - g l = 0"), &
                  quote_t("I", 154, "l d + \ddot{x} - g l = 0")], &
                 "l theta_ddot + x_ddot cos(theta) - g sin(theta) = 0", &
                 "l theta_ddot + x_ddot cos(theta) + g sin(theta) = 0", &
                 "omega^2 = -(m1 + m2) g/(m1 l) < 0: a hanging pendulum that falls up", &
                 system="cart_pendulum")
        call add("E2", kind_lecture, "cart-pendulum, L, first line", &
                 [quote_t("I", 134, "\left(\dot{x}^2 + l^2 \dot{\theta}^2 \cos^2 \theta + l^2 "// &
                                    "\dot{\theta}^2 \sin^2 \theta \right)")], &
                 "m2/2 (x_dot^2 + l^2 theta_dot^2 cos^2(theta) + l^2 theta_dot^2 sin^2(theta))", &
                 "m2/2 (... + 2 l x_dot theta_dot cos(theta)), as the second line has it", &
                 "cart and bob are not coupled: omega^2 = g/l, whatever the masses", &
                 elsewhere=quote_t("I", 136, "m_2 l \dot{x} \dot{\theta} \cos \theta"), &
                 system="cart_pendulum", &
                 wrong="m2/2 (x_bob_dot^2 + y_bob_dot^2) = m2/2 (x_dot^2 "// &
                       "+ l^2 theta_dot^2 cos^2(theta) + l^2 theta_dot^2 sin^2(theta))", &
                 right="m2/2 (x_bob_dot^2 + y_bob_dot^2) = m2/2 (x_dot^2 "// &
                       "+ l^2 theta_dot^2 + 2 l x_dot theta_dot cos(theta))")
        call add("E3", kind_scan, "cart-pendulum, the set of equations", &
                 [quote_t("I", 142, "m_2 l \ddot{0} + m_2 l \ddot{x} \cos 0 - m_2 g l \sin 0 "// &
                                    "= 0")], &
                 "m2 l theta_ddot + m2 l x_ddot cos(theta) - m2 g l sin(theta) = 0", &
                 "m2 l^2 theta_ddot + m2 l x_ddot cos(theta) + m2 g l sin(theta) = 0", &
                 "wrong as soon as l is not 1 m; the sign is E1's", &
                 elsewhere=quote_t("I", 150, "m_2 l^2 \ddot{0} + m_2 l \ddot{x}"), &
                 system="cart_pendulum")
        call add("E4", kind_scan, "cart-pendulum, small theta, x", &
                 [quote_t("I", 152, "(m_1 + m_2) \ddot{x} + l \ddot{0} - l \ddot{0}^2 0 = 0"), &
                  quote_t("I", 154, "(m_1 + m_2) \ddot{x} + l \ddot{0} - l \ddot{0}^2 0 = 0")], &
                 "(m1 + m2) x_ddot + l theta_ddot - l theta_ddot^2 theta = 0", &
                 "(m1 + m2)/m2 x_ddot + l theta_ddot - l theta_dot^2 theta = 0", &
                 "wrong as soon as m2 is not 1 kg; the second theta_ddot is E25's", &
                 elsewhere=quote_t("I", 144, "\frac{(m_1 + m_2)}{m_2} \ddot{x} + l \ddot{0} "// &
                                             "\cos 0"))
        call add("E5", kind_scan, "cart-pendulum, letters and dots", &
                 [quote_t("I", 138, "(m_1 + m_2) \dot{x} + m_2 l \dot{\theta} \cos \theta"), &
                  quote_t("I", 138, "\frac{\partial L}{\partial \pi}"), &
                  quote_t("I", 140, "m_3 \ell \ddot{x} \cos \theta"), &
                  quote_t("I", 140, "\frac{\partial}{\partial t} \left(\frac{\partial "// &
                                    "L}{\partial \dot{\theta}} \right)"), &
                  quote_t("I", 140, "\cdot \frac{\partial L}{\partial 0}"), &
                  quote_t("I", 140, "\frac{m_2 \ell \dot{x} \theta \sin \theta}{m_2 \ell "// &
                                    "\dot{x} \theta \sin \theta}"), &
                  quote_t("I", 152, "l d + \ddot{x} - g l = 0"), &
                  quote_t("I", 154, "l d + \ddot{x} - g l = 0")], &
                 "(m1 + m2) x_dot + m2 l theta_dot cos(theta); dL/dpi; m3; round d/dt; a "// &
                 "term over itself; l d, g l", &
                 "x_ddot, theta_ddot; dL/dx; m2; straight d/dt, - dL/dtheta; struck out; "// &
                 "l theta_ddot, g theta: E1's line", &
                 "", &
                 elsewhere=quote_t("I", 142, "(m_1 + m_2) \ddot{x} + m_2 l \ddot{0} \cos 0"))
        call add("E6", kind_terminology, "cart-pendulum, the frequency", &
                 [quote_t("I", 164, "\omega^2 \sim \left(\frac{m_1 + m_2}{m_1}\right) "// &
                                    "\left(\frac{g}{l}\right)")], &
                 "omega^2 ~ (m1 + m2)/m1 g/l", &
                 "omega^2 = (m1 + m2)/m1 g/l, exactly, of the linear equations", &
                 "none: ~ is for theta of small amplitude")
        call add("E7", kind_lecture, "double pendulum, constraints", &
                 [quote_t("I", 111, "x_{i}^{2} + y_{i}^{2} = \ell_{i}^{2} = c_{i}")], &
                 "x_i^2 + y_i^2 = l_i^2 = c_i", &
                 "so for i = 1; f_2 = (x2 - x1)^2 + (y2 - y1)^2 = l2^2", &
                 "both bobs would hang from the pivot", &
                 principle="constraints", system="double_pendulum", &
                 wrong="x_bob2^2 + y_bob2^2 = l2^2", &
                 right="(x_bob2 - x_bob1)^2 + (y_bob2 - y_bob1)^2 = l2^2")
        call add("E8", kind_scan, "double pendulum, mixed partials", &
                 [quote_t("I", 113, "A_{x_1} = \frac{\partial f}{\partial x_1} = 2x"), &
                  quote_t("I", 115, "\frac{\partial A_{y_{1}}}{\partial z_{1}}")], &
                 "A_x1 = df/dx1 = 2 x; dA_y1/dz1", &
                 "A_x1 = df_1/dx1 = 2 x1; dA_y1/dx1", &
                 "")
        call add("E9", kind_lecture, "rolling disk, why nonholonomic", &
                 [quote_t("I", 132, "\frac{\partial A_{\varphi}}{\partial \theta} = "// &
                                    "-R\cos\theta"), &
                  quote_t("I", 132, "\frac{\partial A_{\theta}}{\partial \varphi} = 0")], &
                 "dA_phi/dtheta = -R cos(theta), dA_theta/dphi = 0: the mixed partials differ", &
                 "that says not exact; nonholonomic takes Frobenius: no integrating factor", &
                 "y dx - x dy = 0 would be nonholonomic, and it is x/y = const", &
                 principle="constraints")
        call add("E10", kind_lecture, "a charge without magnetic field", &
                 [quote_t("I", 84, "If $\overline{B}=\overline{\delta} \to "// &
                                   "\overline{F}=-\overline{V}\varphi$")], &
                 "if B = 0 then F = -grad(phi)", &
                 "F = -e grad(phi); B = 0 in a region without holes: A is a gradient, dA/dt "// &
                 "joins phi", &
                 "every charge would be 1 C", &
                 principle="virtual-work", system="charged_particle", &
                 wrong="m x_ddot = E_x", right="m x_ddot = e E_x", &
                 without="magnetic_x magnetic_y magnetic_z trap")
        call add("E11", kind_none, "conservative forces", &
                 [quote_t("I", 62, "in cartesian coordinates: V does not depend on time"), &
                  quote_t("I", 62, "but $q_j(\{x_i\}, t)$ introduces time-dependence")], &
                 "V(x) does not depend on time; q_j(x, t) introduces it", &
                 "so it is: the driven pendulum's V = m g y has no t, its V(theta, t) has, by "// &
                 "y(theta, t)", &
                 "")
        call add("E12", kind_scan, "L + dF/dt, the chain rule", &
                 [quote_t("I", 105, "\left(\frac{\partial F}{\partial q_{k}} + \frac{\partial "// &
                                    "F}{\partial t} \right)")], &
                 "dF/dq_k + dF/dt, for the dF/dt on the left", &
                 "dF/dt = sum over k of dF/dq_k q_k_dot, + dF/dt once", &
                 "the added term would change the motion", &
                 elsewhere=quote_t("I", 122, "\frac{\partial x_2}{\partial q_1} dq_1 + "// &
                                             "\frac{\partial x_2}{\partial t} dt"))
        call add("E13", kind_scan, "full differential", &
                 [quote_t("I", 3, "$dx_j = \sum_{i=1}^{\infty} \frac{dx_i}{dq_i} dq_i + "// &
                                  "\frac{\partial z_i}{\partial t} dt"), &
                  quote_t("I", 3, "j = 1, ..., 3m - k$"), &
                  quote_t("I", 30, "3m ("), &
                  quote_t("I", 36, "3m $\frac{\partial x_{i}}{\partial q_{i}}"), &
                  quote_t("I", 37, "\int_{0}^{3m}"), &
                  quote_t("I", 38, "\int_{0}^{3m}"), &
                  quote_t("I", 41, "\sum_{i}^{3m}")], &
                 "dx_j = sum of dx_i/dq_i dq_i + dz_i/dt dt; j = 1, ..., 3m - k", &
                 "dx_j = sum over i of dx_j/dq_i dq_i, + dx_j/dt dt; i = 1, ..., 3n - k; j = "// &
                 "1, ..., 3n", &
                 "", &
                 elsewhere=quote_t("I", 122, "\frac{\partial x_2}{\partial q_1} dq_1 + "// &
                                             "\frac{\partial x_2}{\partial t} dt"))
        call add("E14", kind_terminology, "nonholonomic, for example y > 0", &
                 [quote_t("I", 16, "nonholonomic constraint -> more difficult case e.g. y >0")], &
                 "nonholonomic constraint: more difficult case, e.g. y > 0", &
                 "here: unilateral, an inequality; nonholonomic: an equation of velocities, "// &
                 "not integrable", &
                 "none: Goldstein, too, calls both nonholonomic; they want different methods", &
                 principle="constraints")
        call add("E15", kind_lecture, "Hamilton's principle", &
                 [quote_t("II", 18, "path followed is that which minimizes the time integral "// &
                                    "of the difference between the kinetic and potential "// &
                                    "energies")], &
                 "the actual path minimizes the time integral of T - U", &
                 "makes it stationary; least only up to the first conjugate point", &
                 "longer motions would be impossible", &
                 principle="action")
        call add("E16", kind_lecture, "Hero, Fermat", &
                 [quote_t("II", 5, "reflection of light always takes the shortest path"), &
                  quote_t("II", 6, "by a path that requires the least time")], &
                 "light always takes the shortest path, or the least time", &
                 "a stationary one; for points on a concave mirror's diameter the longest; in "// &
                 "an ellipse all alike", &
                 "no image in a concave mirror", &
                 principle="least-time")
        call add("E17", kind_scan, "Maupertuis", &
                 [quote_t("II", 8, "dynamical motion takes place with minimum motion")], &
                 "dynamical motion takes place with minimum motion", &
                 "with minimum action; strictly: stationary action, the integral of p dq at "// &
                 "given energy", &
                 "")
        call add("E18", kind_scan, "oscillator, momentum", &
                 [quote_t("II", 32, "\frac{\partial L}{\partial \dot{x}} = m "// &
                                    "\frac{d\dot{x}}{dt}")], &
                 "dL/dx_dot = m d(x_dot)/dt", &
                 "dL/dx_dot = m x_dot", &
                 "one derivative too many: the equation of motion would be of third order", &
                 system="oscillator", wrong="p_x = m x_ddot", right="p_x = m x_dot", &
                 elsewhere=quote_t("II", 32, "\frac{d}{dt} \frac{\partial L}{\partial "// &
                                             "\dot{x}} = m \frac{d^2x}{dt^2}"))
        call add("E19", kind_scan, "Atwood's machine", &
                 [quote_t("II", 87, "(m_1 - m_2) g = (m_1 + m_2) \frac{d\dot{x}^2}{dt^2}"), &
                  quote_t("II", 87, "\text{ elastically measure for } g")], &
                 "(m1 - m2) g = (m1 + m2) d(x_dot^2)/dt^2; elastically measure for g", &
                 "(m1 - m2) g = (m1 + m2) d^2x/dt^2; a way to measure g", &
                 "")
        call add("E20", kind_scan, "wedge, kinetic energy", &
                 [quote_t("II", 93, "T_M = \frac{1}{2} M \frac{d\dot{q}_2}{dt}")], &
                 "T_M = M/2 d(q2_dot)/dt", &
                 "T_M = M/2 (dq2/dt)^2; all through this page d(q_dot)/dt is dq/dt", &
                 "not an energy: the wedge would have no inertia of its own", &
                 system="wedge", wrong="M/2 x_wedge_dot^2 = M/2 q2_ddot", &
                 right="M/2 x_wedge_dot^2 = M/2 q2_dot^2", &
                 elsewhere=quote_t("II", 97, "\frac{1}{2} (M+m) \left(\frac{d\dot{q}_2}{dt} "// &
                                             "\right)^2"))
        call add("E21", kind_lecture, "wedge, equation of q1", &
                 [quote_t("II", 115, "= M \left(\frac{d^2 q_1}{dt^2} + \frac{d^2 q_2}{dt^2} "// &
                                     "\cos \alpha \right)"), &
                  quote_t("II", 113, "m g \sin \alpha = \frac{d}{dt} \left[M "// &
                                     "\left(\frac{d\dot{q}_1}{dt} + \frac{d\dot{q}_2}{dt}")], &
                 "m g sin(alpha) = M (q1_ddot + q2_ddot cos(alpha))", &
                 "m g sin(alpha) = m (q1_ddot + q2_ddot cos(alpha))", &
                 "off by m/M, against the notes' own q1_ddot", system="wedge")
        call add("E22", kind_scan, "L in generalized coordinates", &
                 [quote_t("II", 54, "= U(q_j, \dot{q}_j, t)"), &
                  quote_t("II", 52, "T(x'_{ai})"), &
                  quote_t("II", 44, "$\rightarrow N$ particles")], &
                 "L = ... = U(q_j, q_j_dot, t); T(x'_ai); N particles", &
                 "L(q_j, q_j_dot, t); T(x_ai_dot); n particles", &
                 "", &
                 elsewhere=quote_t("II", 56, "\mathcal{L}(q_j, \dot{q}_j, t) dt"))
        call add("E23", kind_lecture, "dates", &
                 [quote_t("II", 5, "2nd century B.C. Hero of Alexandria"), &
                  quote_t("II", 8, "1747 Maupertuis"), &
                  quote_t("II", 12, "1828 Gauss least constraint")], &
                 "Hero 2nd century B.C.; Maupertuis 1747; Gauss 1828", &
                 "Hero 1st century A.D.; Maupertuis 1744 (light), 1746 (motion); Gauss 1829", &
                 "")
        call add("E24", kind_scan, "cart-pendulum, q for g", &
                 [quote_t("I", 134, "m_2 q l \cos \theta"), &
                  quote_t("I", 136, "m_2 q l \cos \theta")], &
                 "m2 q l cos(theta)", &
                 "m2 g l cos(theta)", &
                 "", &
                 elsewhere=quote_t("I", 140, "m_2 g \ell \sin \theta"))
        call add("E25", kind_scan, "cart-pendulum, theta_ddot for theta_dot", &
                 [quote_t("I", 142, "m_2 l \ddot{0}^2 \sin 0"), &
                  quote_t("I", 144, "l \ddot{0}^2 \sin 0"), &
                  quote_t("I", 150, "m_2 l \ddot{0}^2 0"), &
                  quote_t("I", 152, "l \ddot{0}^2 0"), &
                  quote_t("I", 154, "l \ddot{0}^2 0")], &
                 "m2 l theta_ddot^2 sin(theta)", &
                 "m2 l theta_dot^2 sin(theta)", &
                 "not a force: its dimension is that of a force over a time squared", &
                 system="cart_pendulum", &
                 wrong="(m1 + m2) x_ddot + m2 l theta_ddot cos(theta) "// &
                       "= m2 l theta_ddot^2 sin(theta)", &
                 right="(m1 + m2) x_ddot + m2 l theta_ddot cos(theta) "// &
                       "= m2 l theta_dot^2 sin(theta)", &
                 elsewhere=quote_t("I", 138, "m_2 l \dot{\theta}^2 \sin \theta"))
        call add("E26", kind_scan, "cart-pendulum, sin 0 = 0", &
                 [quote_t("I", 148, "Small \ 0 : \cos 0 = 1 , \sin 0 = 0")], &
                 "small 0: cos(0) = 1, sin(0) = 0", &
                 "small theta: cos(theta) = 1, sin(theta) = theta; the scan reads theta as 0", &
                 "with sin(theta) = 0 nothing would pull the pendulum back", &
                 elsewhere=quote_t("I", 150, "m_2 l^2 \ddot{0} + m_2 l \ddot{x} - m_2 g l 0 = 0"))
        call add("E27", kind_scan, "Lagrange's equations, lost dots", &
                 [quote_t("I", 67, "\frac{d}{dt} (\frac{\partial T}{\partial q_j}) - "// &
                                   "\frac{\partial (T-V)}{\partial q_j} = 0"), &
                  quote_t("I", 68, "\frac{d}{dt} (\frac{\partial T}{\partial q_j}) - "// &
                                   "\frac{\partial (T-V)}{\partial q_j} = 0"), &
                  quote_t("I", 69, "\frac{d}{dt} (\frac{\partial T}{\partial q_j}) - "// &
                                   "\frac{\partial (T-V)}{\partial q_j} = 0"), &
                  quote_t("I", 66, "\frac{d}{dt} (\frac{\partial T}{\partial q_j}) - "// &
                                   "\frac{\partial T}{\partial q_j}")], &
                 "d/dt (dT/dq_j) - d(T - V)/dq_j = 0", &
                 "d/dt (dT/dq_j_dot) - d(T - V)/dq_j = 0", &
                 "", &
                 elsewhere=quote_t("II", 58, "\frac{\partial \mathcal{L}}{\partial q_j} - "// &
                                             "\frac{d}{dt} \frac{\partial "// &
                                             "\mathcal{L}}{\partial \dot{q}_j} = 0"))
        call add("E28", kind_scan, "coordinates and constraints, letters", &
                 [quote_t("I", 9, "holonomic constraint: $x_i = x_i (\{q, f, t\}) = c_i$"), &
                  quote_t("I", 3, "x_{j} = x_{j}(\{q_{i}, f_{j}, f_{j}\}")], &
                 "x_i = x_i({q, f, t}) = c_i; x_j = x_j({q_i, f_j, f_j})", &
                 "f_i = f_i({x_j}, t) = c_i; x_j = x_j({q_i}, t)", &
                 "", &
                 elsewhere=quote_t("I", 111, "f_{i}(\{x_{i}\},t)"))
        call add("E29", kind_scan, "cart-pendulum, small oscillation", &
                 [quote_t("I", 158, "O(f) = A \omega \cos \omega I"), &
                  quote_t("I", 160, "0 \sim A \omega^2"), &
                  quote_t("I", 160, "O^2 O \sim A^3 \omega^2"), &
                  quote_t("I", 162, "(m_1 + m_2) g O + m_1 l O = O")], &
                 "O(f) = A omega cos(omega I); 0 ~ A omega^2; O^2 O ~ A^3 omega^2; (m1 + m2) "// &
                 "g O + m1 l O = O", &
                 "theta_dot = A omega cos(omega t); theta_ddot; theta_dot^2 theta; (m1 + m2) g "// &
                 "theta + m1 l theta_ddot = 0", &
                 "")
        call add("E30", kind_scan, "generalized force, the index", &
                 [quote_t("I", 53, "Q_{i} = \sum_{i} F_{i} \frac{\partial x_{i}}{\partial "// &
                                   "q_{j}}"), &
                  quote_t("I", 64, "Q_i = \sum_i F_i \frac{\partial x_i}{\partial q_j}")], &
                 "Q_i = sum over i of F_i dx_i/dq_j", &
                 "Q_j = sum over i of F_i dx_i/dq_j", &
                 "", &
                 elsewhere=quote_t("I", 65, "Q_j = -\frac{\partial V}{\partial q_j}"))
        call add("E31", kind_scan, "L + dF/dt, primes and dots", &
                 [quote_t("I", 101, "\frac{d}{dt}\left(\frac{\partial L}{\partial "// &
                                    "\dot{q}_{i}}\right) - \frac{\partial L}{\partial "// &
                                    "q_{i}} ="), &
                  quote_t("I", 105, "\frac{d}{dt} \frac{\partial}{\partial q_{i}} "// &
                                    "\frac{dF}{dt}")], &
                 "d/dt dL/dq_i_dot - dL/dq_i = ...; d/dt d/dq_i dF/dt", &
                 "d/dt dL'/dq_i_dot - dL'/dq_i = ...; d/dt d/dq_i_dot dF/dt", &
                 "L would be compared with itself", &
                 elsewhere=quote_t("I", 101, "\left(\frac{\partial}{\partial "// &
                                             "\dot{q}_{i}}\frac{dF}{dt}\right)"))
        call add("E32", kind_scan, "from d'Alembert to Lagrange, letters", &
                 [quote_t("I", 41, "\partial z_{i}}_{\partial q_{i}}"), &
                  quote_t("I", 43, "\sum_{i}^{d} \frac{\partial}{\partial t} \partial "// &
                                   "\dot{q}_{i}^{2}}"), &
                  quote_t("I", 60, "V(\{x_i\}) = V(\{g_j\}, t)"), &
                  quote_t("I", 73, "U(q;q;)"), &
                  quote_t("I", 97, "\hat{O}^2"), &
                  quote_t("I", 119, "\frac{5}{100}"), &
                  quote_t("I", 122, "\frac{5}{7}")], &
                 "dz_i/dq_i; round d/dt, q_i_dot^2; V({g_j}, t); U(q; q;); O^ for theta_dot; 5/7", &
                 "dx_i/dq_j; d/dt, d/dq_j_dot; V({q_j}, t); U(q_j, q_j_dot); theta_dot; sum "// &
                 "over j", &
                 "", &
                 elsewhere=quote_t("I", 32, "\sum_{j} \frac{\partial x_{i}}{\partial "// &
                                            "q_{j}} \delta q_{j}"))
    contains
        pure subroutine add(id, kind, subject, quotes, reads, derived, effect, elsewhere, &
                            principle, system, wrong, right, without)
            character(*), intent(in) :: id, kind, subject
            type(quote_t), intent(in) :: quotes(:)
            character(*), intent(in) :: reads, derived, effect
            type(quote_t), intent(in), optional :: elsewhere
            character(*), intent(in), optional :: principle, system, wrong, right, without
            type(slip_t) :: slip

            slip%id = id
            slip%kind = kind
            slip%subject = subject
            slip%quotes(:size(quotes)) = quotes
            slip%reads = reads
            slip%derived = derived
            slip%effect = effect
            if (present(elsewhere)) slip%elsewhere = elsewhere
            if (present(principle)) slip%principle = principle
            if (present(system)) then
                slip%system = system
                slip%wrong = reads
                slip%right = derived
            end if
            if (present(wrong)) slip%wrong = wrong
            if (present(right)) slip%right = right
            if (present(without)) slip%without = without
            slips = [slips, slip]
        end subroutine add
    end function slips_of_the_notes

    pure function place(self) result(text)
        !! The scan and the lines of the quotes, ascending.
        class(slip_t), intent(in) :: self
        character(:), allocatable :: text
        logical :: used(most_quotes)
        integer :: lines, next

        used = self%quotes%scan /= ""
        text = ""
        lines = 0
        do while (any(used))
            next = minval(self%quotes%line, used)
            text = text//", "//to_text(next)
            lines = lines + 1
            used = used .and. self%quotes%line /= next
        end do
        text = trim(self%quotes(1)%scan)//", "//trim(merge("lines", "line ", lines > 1))//text(2:)
    end function place
end module lagrangia_errata_ledger
