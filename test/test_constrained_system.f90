module test_constrained_system
    !! Constraints in a scene's `&lagrangian`: holonomic and in velocities, with multipliers.
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertTrue
    use lagrangia_audit, only: audit_system
    use lagrangia_catalogue, only: new_system
    use lagrangia_constrained_system, only: constrained_system_t
    use lagrangia_description, only: description_t
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp
    use lagrangia_lagrange, only: energy_rate
    use lagrangia_ledger, only: ledger_t
    use lagrangia_observer, only: observer_t
    use lagrangia_outcome, only: outcome_t
    use lagrangia_random_draws, only: random_t
    use lagrangia_reference, only: reference_t
    use lagrangia_run_plan, only: parse_run_plan, run_plan_t
    use lagrangia_scene, only: scene_t
    use lagrangia_scene_reader, only: parse_scene
    use lagrangia_scene_run, only: run_scene
    use lagrangia_system, only: system_t
    use lagrangia_text, only: word_t
    use stated_text, only: is_said
    use test_constraints_in_time, only: constraints_in_time_suite
    use test_ends_of_constraints, only: ends_of_constraints_suite
    implicit none (type, external)
    private
    public :: constrained_system_suite

    character, parameter :: line_feed = new_line("a")
    character(*), parameter :: rod = "&lagrangian coordinates = 'x', 'y', parameters = 'm', "// &
        "'l', 'g', T = 'm/2 (x_dot^2 + y_dot^2)', V = 'm g y', constraint = 'x^2 + y^2 = l^2' /"// &
        line_feed//"&rod m = 0.8, l = 1.3, g = 9.81 /"
    character(*), parameter :: disk = "&lagrangian coordinates = 'x', 'y', 'phi', 'theta', "// &
        "parameters = 'm', 'r', 'i1', 'i2', 'g', 'a', T = 'm/2 (x_dot^2 + y_dot^2)', "// &
        "'+ i1/2 phi_dot^2 + i2/2 theta_dot^2', V = '-m g x sin(a)', "// &
        "constraint = 'x_dot = r sin(theta) phi_dot', 'y_dot + r cos(theta) phi_dot' /"// &
        line_feed//"&disk m = 0.7, r = 0.4, i1 = 0.05, i2 = 0.03, g = 9.81, a = 0.3 /"

contains

    function constrained_system_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("constrained_system")
        call suite%addTest(TestMethod("a_rod_in_x_and_y", a_rod_in_x_and_y))
        call suite%addTest(TestMethod("a_disk_that_rolls", a_disk_that_rolls))
        call suite%addTest(TestMethod("the_audit_passes", the_audit_passes))
        call suite%addTest(TestMethod("a_run_keeps_them", a_run_keeps_them))
        call suite%addTest(TestMethod("t_of_the_points", t_of_the_points))
        call suite%addTest(TestMethod("a_wire_that_turns", a_wire_that_turns))
        call suite%addTest(TestMethod("long_runs_stay_on_them", long_runs_stay_on_them))
        call suite%addTest(TestMethod("a_rod_without_mass", a_rod_without_mass))
        call suite%addTest(TestMethod("small_velocities_are_kept", small_velocities_are_kept))
        call suite%addTest(TestMethod("within_rounding_nothing_moves", &
                                      within_rounding_nothing_moves))
        call suite%addTest(TestMethod("refusals", refusals))
        call suite%addTest(TestMethod("nonsense_is_refused_in_one_line", &
                                      nonsense_is_refused_in_one_line))
        call suite%addTest(constraints_in_time_suite())
        call suite%addTest(ends_of_constraints_suite())
    end function constrained_system_suite

    subroutine read_system(keys, group, system, scene, error)
        !! From `q = ...` and the group of the formulas.
        character(*), intent(in) :: keys, group
        class(system_t), allocatable, intent(out) :: system
        type(scene_t), intent(out) :: scene
        type(error_t), allocatable, intent(out) :: error
        type(word_t) :: none(0)

        call parse_scene("&scene dt = 0.01, duration = 1.0, "//keys//" /"//line_feed//group// &
                         line_feed, "scene", none, scene, system, error)
    end subroutine read_system

    subroutine a_rod_in_x_and_y()
        !! Accelerations and the multiplier of a pendulum in Cartesian coordinates: the tension is
        !! \(-2\lambda l\), and \(\ddot x = \ell(\ddot\theta\cos\theta - \dot\theta^2\sin\theta)\).
        class(system_t), allocatable :: system
        type(scene_t) :: scene
        type(error_t), allocatable :: error
        real(dp), parameter :: m = 0.8_dp, l = 1.3_dp, g = 9.81_dp, theta = 0.7_dp, rate = -1.9_dp
        real(dp) :: q(2), v(2), a(2), expected(2), tension

        call read_system("system = 'rod', q = 0.0, -1.3, v = 1.0, 0.0", rod, system, scene, error)
        call assertFalse(allocated(error), "no error")
        if (allocated(error)) return
        q = l*[sin(theta), -cos(theta)]
        v = l*rate*[cos(theta), sin(theta)]
        call system%accelerations(0.0_dp, q, v, a)
        expected = -g/l*sin(theta)*l*[cos(theta), sin(theta)] + l*rate**2*[-sin(theta), cos(theta)]
        call assertEqual(expected, a, 1e-13_dp)
        tension = m*(l*rate**2 + g*cos(theta))
        call assertEqual(tension, -2.0_dp*l*system%quantity(3, 0.0_dp, q, v), 1e-12_dp)
        call assertEqual(0.0_dp, system%quantity(4, 0.0_dp, q, v), 1e-15_dp)
        call system%complete_velocities(0.0_dp, q, v(:1), a, error)
        call assertEqual(v, a, 1e-14_dp)
    end subroutine a_rod_in_x_and_y

    subroutine a_disk_that_rolls()
        !! As the lecture system has it, with its friction as multipliers.
        class(system_t), allocatable :: system, page
        type(scene_t) :: scene
        type(error_t), allocatable :: error
        real(dp), parameter :: q(4) = [0.1_dp, -0.2_dp, 0.3_dp, 0.5_dp]
        real(dp) :: v(4), a(4), b(4)

        call read_system("system = 'disk', q = 0.1, -0.2, 0.3, 0.5", disk, system, scene, error)
        call assertFalse(allocated(error), "no error")
        if (allocated(error)) return
        call new_system("rolling_disk", page, error)
        call page%configure([0.7_dp, 0.4_dp, 0.05_dp, 0.03_dp, 9.81_dp, 0.3_dp], error)
        call page%complete_velocities(0.0_dp, q, [2.0_dp, 1.7_dp], v, error)
        call page%accelerations(0.0_dp, q, v, a)
        call system%accelerations(0.0_dp, q, v, b)
        call assertEqual(a, b, 1e-13_dp)
        call assertEqual(page%quantity(8, 0.0_dp, q, v), system%quantity(5, 0.0_dp, q, v), 1e-13_dp)
        call assertEqual(page%quantity(9, 0.0_dp, q, v), system%quantity(6, 0.0_dp, q, v), 1e-13_dp)
    end subroutine a_disk_that_rolls

    subroutine the_audit_passes()
        !! With the time in a constraint as well.
        integer :: at

        call audited("system = 'rod', q = 0.0, -1.3, v = 1.0, 0.0", rod, 18)
        call audited("system = 'disk', q = 0.1, -0.2, 0.3, 0.5", disk, 19)
        at = index(rod, "x^2 + y^2 = l^2")
        call audited("system = 'rod', q = 0.0, -1.3, v = 0.6", rod(:at - 1)// &
                     "(x - sin(3 t)/5)^2 + y^2 = l^2"//rod(at + 15:), 17)
        call audited("system = 'rod', q = 0.0, -1.3, v = 0.6", rod(:at - 1)// &
                     "y_dot + t x_dot = x + t^2 l"//rod(at + 15:), 17)
        ! its rate takes more than a line of 120, its note too
        call audited("system = 'rod', q = 0.0, -1.3, v = 1.9", rod(:at - 1)// &
                     "(x - sin(3 t)/5 - m sin(l t)^2)^2 + (y + 2 m sin(l t)^2)^2 = l^2"// &
                     rod(at + 15:), 17)
    contains
        subroutine audited(keys, group, claims)
            character(*), intent(in) :: keys, group
            integer, intent(in) :: claims  !! that are judged
            class(system_t), allocatable :: system
            type(scene_t) :: scene
            type(error_t), allocatable :: error
            type(ledger_t) :: audit
            real(dp), allocatable :: given(:)
            logical, allocatable :: fixed(:)
            integer :: i

            call read_system(keys, group, system, scene, error)
            call assertFalse(allocated(error), "audited: "//keys)
            if (allocated(error)) return
            allocate (given, source=scene%parameters)
            allocate (fixed(size(given)), source=.true.)
            call audit_system(system, audit, fixed, given)
            call assertEqual(claims, size(audit%rows), message="claims: "//group)
            do i = 1, size(audit%rows)
                call assertTrue(audit%rows(i)%holds, trim(audit%rows(i)%name)//": "// &
                                trim(audit%rows(i)%remark))
            end do
        end subroutine audited
    end subroutine the_audit_passes

    subroutine a_rod_without_mass()
        !! Half of the draws put parameters on the edge of their domain, where nothing moves it.
        class(system_t), allocatable :: system
        type(scene_t) :: scene
        type(error_t), allocatable :: error
        type(ledger_t) :: audit

        call read_system("system = 'rod', q = 0.0, -1.3, v = 1.0, 0.0", rod, system, scene, error)
        call assertFalse(allocated(error), "read")
        call audit_system(system, audit)
        associate (row => audit%rows(size(audit%rows)))
            call assertFalse(row%holds, "the domain allows m = 0")
            call assertEqual("no place was found that keeps the constraints; with m = 0.0, l = ", &
                             row%remark(:64))
        end associate
    end subroutine a_rod_without_mass

    subroutine small_velocities_are_kept()
        !! To their own rounding, not to that of the far larger ones across the rod that were given.
        class(system_t), allocatable :: system
        type(scene_t) :: scene
        type(error_t), allocatable :: error
        real(dp) :: q(2), v(2)

        call read_system("system = 'rod', q = 0.0, -1.3, v = 1.0, 0.0", rod, system, scene, error)
        call assertFalse(allocated(error), "read")
        q = 1.3_dp*[0.6_dp, -0.8_dp]
        v = [0.6_dp, -0.8_dp] + 1e-9_dp*[0.8_dp, 0.6_dp]
        call system%keep_constraints(0.0_dp, q, v)
        call assertEqual(1e-9_dp, norm2(v), 1e-15_dp, "what is along the motion stays")
        call assertTrue(abs(dot_product(q, v)) <= 4*epsilon(1.0_dp)*dot_product(abs(q), abs(v)), &
                        "and nothing across it")
    end subroutine small_velocities_are_kept

    subroutine a_run_keeps_them()
        !! The rod for ten seconds, against the pendulum's closed form.
        type(run_plan_t), allocatable :: plan
        type(outcome_t) :: outcome
        type(error_t), allocatable :: error
        class(observer_t), pointer :: nobody
        class(system_t), allocatable :: pendulum
        class(reference_t), allocatable :: reference
        type(word_t) :: none(0)
        real(dp) :: q(1), v(1)

        nobody => null()
        allocate (plan)
        call parse_run_plan(plan, "&scene system = 'rod', method = 'rk4', dt = 1e-3, "// &
            "duration = 10.0, q = 0.0, -1.3, v = 2.0, 0.0, columns = 't', 'x', "// &
            "'constraint1_drift', 'energy_drift', expect_constraint1_drift = 1e-9, "// &
            "expect_energy_drift = 1e-9 /"//line_feed//rod//line_feed, "scene", none, error)
        if (.not. allocated(error)) call run_scene(plan, "", "text", nobody, outcome, error)
        call assertFalse(allocated(error), "a run")
        if (allocated(error)) return
        call assertTrue(all(outcome%drifts%holds .or. outcome%drifts%value <= &
                            outcome%drifts%most), "drifts")
        call assertEqual(2, size(outcome%drifts))
        call new_system("pendulum", pendulum, error)
        call pendulum%configure([0.8_dp, 1.3_dp, 9.81_dp], error)
        call pendulum%closed_form(0.0_dp, [0.0_dp], [2.0_dp/1.3_dp], reference)
        call reference%state_at(10.0_dp, q, v)
        call assertEqual(1.3_dp*sin(q(1)), outcome%q(1), 1e-8_dp, "x at the end")
    end subroutine a_run_keeps_them

    subroutine t_of_the_points()
        !! Without T that of the places and masses: two bobs, of which one pivot moves.
        character(*), parameter :: head = "&lagrangian coordinates = 'x', 'theta', "// &
            "parameters = 'm1', 'm2', 'l', 'g', V = '-m2 g l cos(theta)', ", &
            tail = line_feed//"&cart m1 = 2.0, m2 = 0.7, l = 0.8, g = 9.81 /", &
            start = "system = 'cart', q = 0.3, 0.9"
        class(system_t), allocatable :: system, typed
        type(scene_t) :: scene
        type(error_t), allocatable :: error
        real(dp), parameter :: q(2) = [0.3_dp, 0.9_dp], v(2) = [-1.1_dp, 0.6_dp]
        real(dp) :: a(2), b(2)

        call read_system(start, head//"positions = 'cart, m1: x, 0', "// &
            "'bob, m2: x + l sin(theta), -l cos(theta)' /"//tail, system, scene, error)
        call assertFalse(allocated(error), "T of the points")
        if (allocated(error)) return
        call read_system(start, head//"T = 'm1/2 x_dot^2 + m2/2 (x_dot^2 + l^2 theta_dot^2 + "// &
            "2 l x_dot theta_dot cos(theta))' /"//tail, typed, scene, error)
        call system%accelerations(0.0_dp, q, v, a)
        call typed%accelerations(0.0_dp, q, v, b)
        call assertEqual(b, a, 1e-14_dp)
        call read_system(start, head//"positions = 'cart: x, 0' /"//tail, system, scene, error)
        call assertTrue(allocated(error), "no masses")
        if (allocated(error)) call assertTrue(index(error%message, "or positions with their "// &
            "masses") > 0, error%message)
    end subroutine t_of_the_points

    subroutine a_wire_that_turns()
        !! A bead on a straight wire that turns with w: \(r = r_0\cosh wt\) from rest on the wire,
        !! which pushes across with \(2mw\dot r\), a power of that times \(wr\). As a constraint on
        !! places, as one on velocities, and in the coordinate r. A wire that stands does nothing.
        character(*), parameter :: head = "&lagrangian coordinates = 'x', 'y' "// &
            "parameters = 'm', 'w' T = 'm/2 (x_dot^2 + y_dot^2)' constraint = '", &
            tail = "' /"//line_feed//"&wire m = 2.0, w = 0.7 /"
        character(80), parameter :: links(2) = [character(80) :: "y cos(w t) = x sin(w t)", &
            "y_dot cos(w t) - x_dot sin(w t) = w (y sin(w t) + x cos(w t))"]
        character(*), parameter :: in_r = "&lagrangian coordinates = 'r' parameters = 'm', 'w' "// &
            "T = 'm/2 (r_dot^2 + r^2 w^2)"//tail
        real(dp), parameter :: m = 2.0_dp, w = 0.7_dp, r0 = 0.5_dp, t = 2.3_dp
        class(system_t), allocatable :: system, along
        type(scene_t) :: scene
        type(error_t), allocatable :: error
        type(description_t) :: d
        real(dp) :: q(2), v(2), r(1), r_dot(1), a(2), r_ddot(1), push
        integer :: k

        call read_system("system = 'wire', q = 0.5", in_r, along, scene, error)
        call assertFalse(allocated(error), "in r")
        do k = 1, 2
            call read_system("system = 'wire', q = 0.5, 0.0, v = 0.0", head//trim(links(k))//tail, &
                             system, scene, error)
            call assertFalse(allocated(error), trim(links(k)))
            if (allocated(error)) return
            call system%describe(d)
            call assertTrue(index(d%constraint, ", rheonomic") > 0, d%constraint)
            call assertEqual([0.0_dp, w*r0], scene%v, 4*epsilon(w), "the velocity of the wire")
            call assertFalse(system%conserves_energy(), "the wire does work")
            r = r0*cosh(w*t)
            r_dot = w*r0*sinh(w*t)
            q = r(1)*[cos(w*t), sin(w*t)]
            v = r_dot(1)*[cos(w*t), sin(w*t)] + w*r(1)*[-sin(w*t), cos(w*t)]
            call system%accelerations(t, q, v, a)
            call along%accelerations(t, r, r_dot, r_ddot)
            call assertEqual((r_ddot(1) - w**2*r(1))*[cos(w*t), sin(w*t)] + 2*w*r_dot(1) &
                             *[-sin(w*t), cos(w*t)], a, 1e-14_dp, "as in the coordinate r")
            call assertEqual(w**2*r, r_ddot, 1e-15_dp, "r0 cosh(w t)")
            push = 2*m*w*r_dot(1)
            call assertEqual(push, system%quantity(3, t, q, v), 1e-14_dp, "the push")
            call assertEqual(push*w*r(1), energy_rate(system, t, q, v), 1e-13_dp, "its power")
        end do
        call system%configure([m, 0.0_dp], error)
        call assertEqual(0.0_dp, energy_rate(system, t, [r0, 0.0_dp], [1.0_dp, 0.0_dp]), &
                         0.0_dp, "a wire that stands")
    end subroutine a_wire_that_turns

    subroutine long_runs_stay_on_them()
        !! Thirty thousand steps of rk4, 23 a swing, and the bead on a turning wire by tolerances of
        !! 1e-6. What rounding may leave of f: four epsilon of its terms, and as much of the time.
        character(*), parameter :: wire = "&lagrangian coordinates = 'x', 'y' "// &
            "parameters = 'm', 'w' T = 'm/2 (x_dot^2 + y_dot^2)' V = 'm x^2 + 3 m y^2' "// &
            "constraint = 'y cos(w t) = x sin(w t)' /"//line_feed//"&wire m = 2.0, w = 0.7 /"

        call stays("system = 'rod', dt = 0.1, duration = 3e3, q = 0.0, -1.3, v = 2.0, "// &
                   "columns = 't', 'constraint1_drift'", rod)
        call stays("system = 'rod', dt = 0.1, duration = 1e2, q = 0.0, -1.3, v = 2.0, "// &
                   "columns = 't', 'constraint1_drift', compensated = .true.", rod)
        call stays("system = 'rod', method = 'gauss16', dt = 0.2, duration = 1e2, "// &
                   "q = 0.0, -1.3, v = 2.0, columns = 't', 'constraint1_drift'", rod)
        call stays("system = 'wire', method = 'dop853', tolerance = 1e-6, samples = 10, "// &
                   "duration = 3e2, q = 0.5, 0.0, columns = 't', 'constraint1_drift'", wire)
        call stays("system = 'wire', method = 'gauss16', tolerance = 1e-6, samples = 10, "// &
                   "duration = 3e2, q = 0.5, 0.0, columns = 't', 'constraint1_drift'", wire)
    contains
        subroutine stays(keys, group)
            character(*), intent(in) :: keys, group
            type(run_plan_t), allocatable :: plan
            type(outcome_t) :: outcome
            type(error_t), allocatable :: error
            class(observer_t), pointer :: nobody
            type(word_t) :: none(0)
            real(dp) :: left(1), a(2), sizes(1)

            nobody => null()
            allocate (plan)
            call parse_run_plan(plan, "&scene "//keys//" /"//line_feed//group//line_feed, &
                                "scene", none, error)
            if (.not. allocated(error)) call run_scene(plan, "", "text", nobody, outcome, error)
            call assertFalse(allocated(error), keys)
            if (allocated(error)) return
            select type (system => plan%system)
            type is (constrained_system_t)
                call system%residuals(outcome%t, outcome%q, left, sizes)
                call assertEqual(0.0_dp, left(1)/sizes(1), 8*epsilon(left), keys)
                a = outcome%v
                call system%complete_velocities(outcome%t, outcome%q, outcome%v, a, error)
                call assertFalse(allocated(error), "velocities, too: "//keys)
            end select
        end subroutine stays
    end subroutine long_runs_stay_on_them

    subroutine nonsense_is_refused_in_one_line()
        !! 2000 texts of what constraints are made of: refused with a place, or a system whose
        !! accelerations are finite, or no number, at a state.
        character(*), parameter :: usual = "xylx_dot+y-2^()*/= sincost.,|"
        class(system_t), allocatable :: system
        type(scene_t) :: scene
        type(error_t), allocatable :: error
        type(random_t) :: random
        character(20) :: text
        real(dp) :: place, a(2)
        integer :: i, k, at, accepted, length

        accepted = 0
        at = index(rod, "x^2")
        do i = 1, 2000
            call random%uniform(1.0_dp, 20.0_dp, place)
            length = int(place)
            if (mod(i, 2) == 0) length = min(length, 5)
            text = ""
            do k = 1, length
                call random%uniform(0.0_dp, real(len(usual), dp), place)
                place = min(place, len(usual) - 1.0_dp)
                text(k:k) = usual(1 + int(place):)
            end do
            call read_system("system = 'rod', q = 0.0, -1.3", rod(:at - 1)//trim(text)// &
                             rod(index(rod, "l^2'") + 3:), system, scene, error)
            if (allocated(error)) then
                call assertTrue(index(error%message, "scene:") == 1 .and. &
                                index(error%message, line_feed) == 0, text//error%message)
            else
                accepted = accepted + 1
                call system%accelerations(0.0_dp, [0.0_dp, -1.3_dp], [0.0_dp, 0.0_dp], a)
            end if
        end do
        call assertTrue(accepted > 5, "some are good")
    end subroutine nonsense_is_refused_in_one_line

    subroutine within_rounding_nothing_moves()
        !! A velocity along the rod of four units in the last place is no reason to change it,
        !! forwards or backwards; one of 64 is taken away.
        class(system_t), allocatable :: system
        type(scene_t) :: scene
        type(error_t), allocatable :: error
        real(dp) :: q(2), v(2), before(2), off
        integer :: i, k

        call read_system("system = 'rod' q = 1.3, 0.0", rod, system, scene, error)
        call assertFalse(allocated(error), "a scene")
        if (allocated(error)) return
        do i = -1, 1, 2
            do k = 4, 64, 60
                q = 1.3_dp*[0.6_dp, -0.8_dp]
                v = i*[0.8_dp, 0.6_dp]
                v(1) = v(1) + k*spacing(v(1))
                before = v
                call system%keep_constraints(0.0_dp, q, v)
                off = abs(dot_product(q, v))
                if (k == 4) call assertEqual(before, v, 0.0_dp, "as they were")
                if (k == 64) call assertTrue(off < 1e-15_dp, "across the rod")
            end do
        end do
    end subroutine within_rounding_nothing_moves

    subroutine refusals()
        call refused("", "t = 1", "contains no coordinate and no velocity, and so binds nothing")
        call refused("", "x^2 + y^2 = l^2 + (1 + t)^2", "not 0; start elsewhere, such as "// &
                     "q = 0.0, -1.6401219466856...")
        call refused("", "l = 1", "contains no coordinate and no velocity, and so binds nothing")
        call refused("", "x_dot^2 + y_dot^2 = 1", "is not linear in x_dot; a constraint on "// &
                                                  "velocities is a sum of terms with one "// &
                                                  "velocity each")
        call refused("q = 0.0, -1.3, v = 0.0, 0.0", "x_dot + y = 0", "v does not keep the "// &
                     "constraints; give those of y_dot only")
        call refused("", "x + y', 'x - y", "leave nothing that moves")
        call refused("", "x^2 + y^2 = k", "column 13: unknown name 'k'; there are t, x, y, "// &
                                          "x_dot, y_dot, m, l, g, pi")
        call refused("", "x^2 + y^2 =", "column 12: a side of the equation is empty; write 0 "// &
                                        "if it is zero")
        call refused("q = 1.0, 1.0", "x^2 + y^2 = l^2", "constraint 1 is not kept: it gives "// &
                                                        "..., not 0; start elsewhere, such "// &
                                                        "as q = ..., ...")
        call refused("q = 0.0, -1.3, v = 1.0, 1.0", "x^2 + y^2 = l^2", &
                     "v does not keep the constraints; give those of x_dot only")
    contains
        subroutine refused(keys, constraint, expected)
            character(*), intent(in) :: keys, constraint, expected
            class(system_t), allocatable :: system
            type(scene_t) :: scene
            type(error_t), allocatable :: error
            character(:), allocatable :: start, group
            integer :: at

            start = keys
            if (keys == "") start = "q = 0.0, -1.3"
            at = index(rod, "x^2")
            group = rod(:at - 1)//constraint//rod(index(rod, "l^2'") + 3:)
            call read_system("system = 'rod', "//start, group, system, scene, error)
            call assertTrue(allocated(error), "refused: "//constraint)
            if (.not. allocated(error)) return
            call assertTrue(is_said(error%message, expected), error%message)
            call assertEqual(2, error%status)
        end subroutine refused
    end subroutine refusals
end module test_constrained_system
