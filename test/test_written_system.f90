module test_written_system
    !! Systems in formulas: they move as those that were derived by hand, their structure is found,
    !! their scene can be run again.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertFalse, &
                     assertLessThan, assertTrue
    use lagrangia_audit, only: audit_system
    use lagrangia_catalogue, only: new_system
    use lagrangia_columns, only: column_names
    use lagrangia_command_line, only: word_t
    use lagrangia_description, only: described_by, description_t, name_length
    use lagrangia_errors, only: error_t
    use lagrangia_hyperdual, only: hyperdual_t
    use lagrangia_kinds, only: dp
    use lagrangia_ledger, only: ledger_t
    use lagrangia_scene, only: scene_t
    use lagrangia_scene_reader, only: parse_scene
    use lagrangia_small_oscillations, only: find_modes, likely_equilibrium, modes_t
    use lagrangia_solve, only: solve
    use lagrangia_system, only: default_values, system_t
    use lagrangia_text, only: to_text
    use random_states, only: draw_parameters, draw_state, restart_random
    use typed_systems, only: typed
    implicit none (type, external)
    private
    public :: written_system_suite

    character(*), parameter :: nl = new_line("a")
    character(*), parameter :: spring = &
        "&lagrangian coordinates = 'r [m] length', 'theta [rad]'"//nl// &
        "parameters = 'm [kg]', 'k [N/m]', 'l0 [m]', 'g'"//nl// &
        "T = 'm/2 (r_dot^2 + r^2 theta_dot^2)'"//nl// &
        "V = 'k/2 (r - l0)^2 - m g r cos(theta)'"//nl// &
        "positions = 'bob, m: r sin(theta), -r cos(theta)'"//nl// &
        "equilibrium = 'l0 + m g/k', '0' /"//nl// &
        "&spring m = 2.0, k = 40.0, l0 = 1.5, g = 9.81 /"

contains

    function written_system_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("written_system")
        call suite%addTest(TestMethod("accelerations_are_those_by_hand", &
                                      accelerations_are_those_by_hand, setUp=restart_random))
        call suite%addTest(TestMethod("motion_is_that_by_hand", motion_is_that_by_hand))
        call suite%addTest(TestMethod("structure_is_found", structure_is_found))
        call suite%addTest(TestMethod("cyclic_momenta_are_conserved_columns", &
                                      cyclic_momenta_are_conserved_columns))
        call suite%addTest(TestMethod("places_and_masses", places_and_masses))
        call suite%addTest(TestMethod("modes_about_the_equilibrium", modes_about_the_equilibrium))
        call suite%addTest(TestMethod("forces_beside_l", forces_beside_l))
        call suite%addTest(TestMethod("audits_hold", audits_hold))
        call suite%addTest(TestMethod("some_masses", some_masses))
        call suite%addTest(TestMethod("any_degree_in_velocities", any_degree_in_velocities))
        call suite%addTest(TestMethod("what_cancels_is_not_there", what_cancels_is_not_there))
        call suite%addTest(TestMethod("equations_are_written", equations_are_written))
        call suite%addTest(TestMethod("letters_of_energies", letters_of_energies))
        call suite%addTest(TestMethod("overrides_reach_formulas", overrides_reach_formulas))
    end function written_system_suite

    subroutine read_typed(name, lines, ndof, values, system)
        !! A system in formulas with these values of its parameters.
        character(*), intent(in) :: name, lines
        integer, intent(in) :: ndof
        real(dp), intent(in) :: values(:)
        class(system_t), allocatable, intent(out) :: system
        type(scene_t) :: scene
        type(error_t), allocatable :: error
        type(description_t) :: d
        character(:), allocatable :: text, start
        integer :: i, first, last

        start = "0.3"
        do i = 2, ndof
            start = start//", 0.3"
        end do
        text = "&scene system = '"//name//"' dt = 1e-3 duration = 1.0 q = "//start//" /"//nl// &
               "&lagrangian "//trim(lines)//" /"//nl//"&"//name
        first = index(lines, "parameters = '") + len("parameters = '")
        do i = 1, size(values)
            last = first + index(lines(first:), "'") - 2
            text = text//" "//lines(first:last)//" = "//to_text(values(i))
            first = last + len("', '") + 1
        end do
        call parse_scene(text//" /", "typed.nml", [word_t ::], scene, system, error)
        if (allocated(error)) call assertFalse(.true., error%message//nl//text)
        if (allocated(error)) return
        call system%describe(d)
        call assertEqual(values, default_values(d))
        call assertEqual("lagrangia describe SCENE", described_by(d))
    end subroutine read_typed

    subroutine accelerations_are_those_by_hand()
        !! Both solve the same equations; the tolerance is that of some hundred operations behind a
        !! mass matrix of condition up to some hundred. The energy, up to that of rest.
        class(system_t), allocatable :: hand, own
        type(description_t) :: d
        type(error_t), allocatable :: error
        real(dp), allocatable :: q(:), v(:), a(:), b(:), values(:)
        real(dp) :: scale, t
        integer :: i, k

        do k = 1, size(typed)
            call new_system(trim(typed(k)%name), hand, error)
            do i = 1, 40
                call draw_parameters(hand, edges=mod(i, 4) == 0)
                call hand%describe(d)
                call assertEqual("lagrangia describe "//trim(typed(k)%name), described_by(d))
                if (allocated(values)) deallocate (values)
                allocate (values, source=default_values(d))
                if (i == 1) call read_typed("own", typed(k)%lines, hand%ndof, values, own)
                if (anyExceptions()) return
                call own%configure(values, error)
                call assertFalse(allocated(error), "parameters")
                call assertTrue(own%velocity_forces .eqv. hand%velocity_forces, &
                                trim(typed(k)%name)//": velocity_forces")
                call assertTrue(hand%time_dependent .eqv. own%time_dependent, &
                                trim(typed(k)%name)//": time_dependent")
                call draw_state(hand, t, q, v)
                allocate (a(hand%ndof), b(hand%ndof))
                call hand%accelerations(t, q, v, a)
                call own%accelerations(t, q, v, b)
                scale = maxval(abs(a)) + maxval(abs(v))**2 + 1.0_dp
                call assertLessThan(maxval(abs(a - b)), 1e3_dp*epsilon(scale)*scale, &
                                    message=trim(typed(k)%name))
                call own%momenta(t, q, v, b)
                scale = abs(hand%energy(t, q, v)) + abs(dot_product(b, v)) + 1.0_dp
                call assertEqual(hand%energy(t, q, v) - hand%energy(t, q, 0.0_dp*v), &
                                 own%energy(t, q, v) - own%energy(t, q, 0.0_dp*v), &
                                 1e2_dp*epsilon(scale)*scale, trim(typed(k)%name)//": energy")
                deallocate (a, b)
                if (anyExceptions()) return
            end do
        end do
    end subroutine accelerations_are_those_by_hand

    subroutine motion_is_that_by_hand()
        !! Of the double pendulum, by a method of fixed steps and by one that chooses them: rounding
        !! of some epsilon a step, in at most 200 steps, which two seconds of regular motion do not
        !! amplify by more than ten.
        real(dp), parameter :: values(5) = [1.5_dp, 0.7_dp, 0.8_dp, 1.1_dp, 9.81_dp]
        real(dp), parameter :: start(2) = [0.3_dp, 0.2_dp], times(2) = [0.0_dp, 2.0_dp]
        class(system_t), allocatable :: hand, own
        type(error_t), allocatable :: error
        real(dp), allocatable :: q(:, :), v(:, :), own_q(:, :), own_v(:, :)
        integer :: k

        call new_system("double_pendulum", hand, error)
        call hand%configure(values, error)
        call read_typed("own", typed(3)%lines, 2, values, own)
        if (anyExceptions()) return
        do k = 1, 2
            if (k == 1) then
                call solve(hand, "rk4", times, start, 0.0_dp*start, q, v, error, dt=1e-2_dp)
                call solve(own, "rk4", times, start, 0.0_dp*start, own_q, own_v, error, dt=1e-2_dp)
            else
                call solve(hand, "gauss16", times, start, 0.0_dp*start, q, v, error)
                call solve(own, "gauss16", times, start, 0.0_dp*start, own_q, own_v, error)
            end if
            call assertFalse(allocated(error), "it runs")
            if (anyExceptions()) return
            call assertEqual(q(:, 2), own_q(:, 2), 2e3_dp*epsilon(1.0_dp), "coordinates")
            call assertEqual(v(:, 2), own_v(:, 2), 2e4_dp*epsilon(1.0_dp), "velocities")
            call assertTrue(maxval(abs(own_q(:, 2) - start)) > 1e-2_dp, "it has moved")
        end do
    end subroutine motion_is_that_by_hand

    subroutine read_spring(groups, scene, system)
        !! A scene with these groups behind its own.
        character(*), intent(in) :: groups
        type(scene_t), intent(out) :: scene
        class(system_t), allocatable, intent(out) :: system
        type(error_t), allocatable :: error

        call parse_scene("&scene system = 'spring' dt = 1e-3 duration = 1.0 q = 1.4, 0.6 /"//nl// &
                         groups, "spring.nml", [word_t ::], scene, system, error)
        if (allocated(error)) call assertEqual("", error%message)
    end subroutine read_spring

    subroutine structure_is_found()
        !! Typed so that only the parameters' values decide, and with functions that are not zero
        !! anywhere: what is cyclic, in time, by velocities.
        character(*), parameter :: lines = "coordinates = 'x', 'y' parameters = 'k', 'w', 'b', "// &
            "'c' T = '(x_dot^2 + (1 + c x^2) y_dot^2)/2' V = 'k/2 x^2 + w x cos(t)' "// &
            "Q_x = '-b x_dot'"
        class(system_t), allocatable :: system
        type(error_t), allocatable :: error

        call read_typed("own", lines, 2, [1.0_dp, 0.0_dp, 0.0_dp, 0.0_dp], system)
        if (anyExceptions()) return
        call check_flags("separable", .false., .false., .false., 2)
        call system%configure([1.0_dp, 1.0_dp, 0.0_dp, 0.0_dp], error)
        call check_flags("with the time", .false., .true., .false., 2)
        call system%configure([1.0_dp, 0.0_dp, 1.0_dp, 0.0_dp], error)
        call check_flags("with friction", .true., .false., .true., 2)
        call system%configure([1.0_dp, 0.0_dp, 0.0_dp, 1.0_dp], error)
        call check_flags("with a mass matrix of x", .true., .false., .false., 2)
        call system%configure([0.0_dp, 0.0_dp, 0.0_dp, 0.0_dp], error)
        call check_flags("free", .false., .false., .false., 1)
    contains
        subroutine check_flags(what, velocity_forces, time_dependent, nonconservative, cyclic)
            character(*), intent(in) :: what
            logical, intent(in) :: velocity_forces, time_dependent, nonconservative
            integer, intent(in) :: cyclic

            call assertTrue(system%velocity_forces .eqv. velocity_forces, what//": velocities")
            call assertTrue(system%time_dependent .eqv. time_dependent, what//": time")
            call assertTrue(system%nonconservative .eqv. nonconservative, what//": forces")
            call assertEqual(cyclic, system%cyclic, what)
        end subroutine check_flags
    end subroutine structure_is_found

    subroutine cyclic_momenta_are_conserved_columns()
        !! Without gravity the spring's angle is cyclic: `p_theta` gets a drift; `p_r` has none.
        class(system_t), allocatable :: system
        type(scene_t) :: scene
        type(description_t) :: d
        type(error_t), allocatable :: error
        character(name_length), allocatable :: names(:)
        real(dp), parameter :: q(2) = [1.4_dp, 0.6_dp], v(2) = [0.3_dp, -0.7_dp]

        call read_spring(spring, scene, system)
        if (anyExceptions()) return
        allocate (names, source=column_names(system, .true.))
        call assertTrue(any(names == "p_r") .and. any(names == "p_theta"), "momenta are columns")
        call assertFalse(any(names == "p_theta_drift"), "with gravity it changes")
        call system%configure([2.0_dp, 40.0_dp, 1.5_dp, 0.0_dp], error)
        names = column_names(system, .true.)
        call assertTrue(any(names == "p_theta_drift"), "without gravity it is conserved")
        call assertFalse(any(names == "p_r_drift"), "the radial momentum is not")
        call system%describe(d)
        call assertEqual("p_r", trim(d%quantities(1)%name))
        call assertEqual("kg m/s", trim(d%quantities(1)%unit))
        call assertEqual("kg m^2/s", trim(d%quantities(2)%unit))
        call assertEqual(0.6_dp, system%quantity(1, 0.0_dp, q, v), epsilon(1.0_dp))
        call assertEqual(-2.0_dp*1.96_dp*0.7_dp, system%quantity(2, 0.0_dp, q, v), &
                         8*epsilon(1.0_dp))
    end subroutine cyclic_momenta_are_conserved_columns

    subroutine places_and_masses()
        !! The bob at \((r\sin\theta, -r\cos\theta)\) with the mass m, in a plane.
        class(system_t), allocatable :: system
        type(scene_t) :: scene
        type(description_t) :: d
        type(hyperdual_t) :: q(2), r(3, 1)
        real(dp) :: place(3), slope(3)
        type(error_t), allocatable :: error

        call read_spring(spring, scene, system)
        if (anyExceptions()) return
        q%re = [1.4_dp, 0.6_dp]
        q(1)%d1 = 1.0_dp
        call system%positions(hyperdual_t(), q, r)
        place = r(:, 1)%re
        slope = r(:, 1)%d1
        call assertEqual([1.4_dp*sin(0.6_dp), -1.4_dp*cos(0.6_dp), 0.0_dp], place, &
                         4*epsilon(1.0_dp))
        call assertEqual([sin(0.6_dp), -cos(0.6_dp), 0.0_dp], slope, 4*epsilon(1.0_dp))
        call system%configure([3.0_dp, 40.0_dp, 1.5_dp, 9.81_dp], error)
        call system%describe(d)
        call assertEqual("bob", trim(d%points(1)%name))
        call assertEqual(3.0_dp, d%points(1)%mass)
        call assertEqual(2, d%dimensions)
    end subroutine places_and_masses

    subroutine modes_about_the_equilibrium()
        !! About \(r = \ell_0 + mg/k\), \(\theta = 0\): \(\omega^2 = k/m\) and \(g/r\), each known
        !! to some epsilon of the numbers that it comes from.
        class(system_t), allocatable :: system
        type(scene_t) :: scene
        type(modes_t) :: modes
        type(error_t), allocatable :: error
        real(dp), parameter :: r = 1.5_dp + 2.0_dp*9.81_dp/40.0_dp

        call read_spring(spring, scene, system)
        if (anyExceptions()) return
        call find_modes(system, likely_equilibrium(system), .false., modes, error)
        call assertFalse(allocated(error), "there are modes")
        if (anyExceptions()) return
        call assertEqual([r, 0.0_dp], modes%at, 8*epsilon(r))
        call assertEqual([9.81_dp/r, 20.0_dp], modes%omega2, 1e3_dp*epsilon(r))
    end subroutine modes_about_the_equilibrium

    subroutine forces_beside_l()
        !! \(Q = -b\dot x + f\cos 2t\) on an oscillator, in \(\ddot x\).
        character(*), parameter :: lines = "coordinates = 'x' parameters = 'm', 'b', 'f' "// &
            "T = 'm/2 x_dot^2' Q_x = '-b x_dot' '+ f cos(2 t)'"
        class(system_t), allocatable :: system
        real(dp) :: a(1)

        call read_typed("own", lines, 1, [2.0_dp, 0.5_dp, 3.0_dp], system)
        if (anyExceptions()) return
        call system%accelerations(0.4_dp, [0.1_dp], [0.7_dp], a)
        call assertEqual((-0.35_dp + 3.0_dp*cos(0.8_dp))/2.0_dp, a(1), 4*epsilon(a))
        call assertTrue(system%time_dependent .and. system%nonconservative, "structure")
    end subroutine forces_beside_l

    subroutine audits_hold()
        !! Of the spring pendulum, with the parameters of its scene.
        class(system_t), allocatable :: system
        type(scene_t) :: scene
        type(ledger_t) :: ledger
        integer :: i

        call read_spring(spring, scene, system)
        if (anyExceptions()) return
        call audit_system(system, ledger, [(.true., i=1, 4)], scene%parameters)
        call assertEqual(15, size(ledger%rows), message="claims")
        call assertEqual(0, ledger%broken())
    end subroutine audits_hold

    subroutine letters_of_energies()
        !! Parameters that are called T and V: L is printed without them.
        class(system_t), allocatable :: system
        type(ledger_t) :: ledger
        real(dp), parameter :: values(2) = [1.5_dp, 0.7_dp]
        integer :: i

        call read_typed("own", "coordinates = 'x' parameters = 'T', 'V' "// &
                        "T = 'T/2 x_dot^2' V = 'V x^2/2'", 1, values, system)
        if (anyExceptions()) return
        call audit_system(system, ledger, [(.true., i=1, 2)], values)
        call assertTrue(ledger%row_of("L as printed") > 0, "L is compared")
        call assertEqual(0, ledger%broken())
    end subroutine letters_of_energies

    subroutine some_masses()
        !! Where some points have no mass, T is at least that of the others; with a mass too large
        !! it is not.
        character(*), parameter :: claim = "T is at least that of the masses"
        character(*), parameter :: lines = "coordinates = 'x', 'y' parameters = 'm', 'mb' T = "// &
            "'m/2 x_dot^2 + m y_dot^2' positions = 'a, mb: x, 0', 'b: y, 0'"
        class(system_t), allocatable :: system
        type(ledger_t) :: ledger
        real(dp) :: values(2)
        integer :: i, k

        do k = 1, 2
            values = [1.0_dp, merge(1.0_dp, 2.5_dp, k == 1)]
            call read_typed("own", lines, 2, values, system)
            if (anyExceptions()) return
            call audit_system(system, ledger, [(.true., i=1, 2)], values)
            i = ledger%row_of(claim)
            call assertTrue(i > 0, "there is a row")
            if (i == 0) return
            call assertTrue(ledger%rows(i)%holds .eqv. k == 1, "it holds for the first")
            call assertEqual(k - 1, ledger%broken())
        end do
    end subroutine some_masses

    subroutine any_degree_in_velocities()
        !! Relativistic: \(p = mv/\sqrt{1 - v^2/c^2}\) is inverted, also close to c, where Newton's
        !! first step from rest leads beyond it.
        character(*), parameter :: lines = "coordinates = 'x' parameters = 'm', 'c', 'k' "// &
            "L = '-m c^2 sqrt(1 - x_dot^2/c^2) - k/2 x^2'"
        real(dp), parameter :: speeds(4) = [0.0_dp, 0.1_dp, -1.9_dp, 1.999_dp]
        class(system_t), allocatable :: system
        real(dp) :: a(1), p(1), v(1), gamma
        integer :: i

        call read_typed("own", lines, 1, [3.0_dp, 2.0_dp, 5.0_dp], system)
        if (anyExceptions()) return
        do i = 1, size(speeds)
            gamma = 1.0_dp/sqrt(1.0_dp - speeds(i)**2/4.0_dp)
            call system%momenta(0.0_dp, [0.3_dp], speeds(i:i), p)
            call assertEqual(3.0_dp*gamma*speeds(i), p(1), 16*epsilon(p)*gamma**3)
            call system%velocities(0.0_dp, [0.3_dp], p, v)
            call assertEqual(speeds(i), v(1), 16*epsilon(v))
            call system%accelerations(0.0_dp, [0.3_dp], speeds(i:i), a)
            call assertEqual(-0.5_dp/gamma**3, a(1), 64*epsilon(a))
        end do
        call read_typed("own", "coordinates = 'r' parameters = 'm' "// &
                        "L = '-m sqrt(1 - 0.2/r - r_dot^2/(1 - 0.2/r))'", 1, [3.0_dp], system)
        if (anyExceptions()) return
        call system%momenta(0.0_dp, [0.3_dp], [0.2_dp], p)
        call system%velocities(0.0_dp, [0.3_dp], p, v)
        call assertEqual(0.2_dp, v(1), 16*epsilon(v), "outside of a horizon")
        call system%momenta(0.0_dp, [0.1_dp], [1.5_dp], p)
        call assertEqual(-4.5_dp/sqrt(1.25_dp), p(1), 16*epsilon(p), "inside of it")
        call system%velocities(0.0_dp, [0.1_dp], p, v)
        call assertTrue(ieee_is_nan(v(1)), "nothing rests there, where the way back would begin")
    end subroutine any_degree_in_velocities

    subroutine what_cancels_is_not_there()
        !! Cartesian velocities of a central force and of a bead on a turning wire, as definitions:
        !! the angle and the time cancel in \(\sin^2 + \cos^2\), and rounding does not bring them
        !! back.
        class(system_t), allocatable :: system

        call read_typed("own", "coordinates = 'r', 'theta' parameters = 'm', 'k' definitions = "// &
                        "'vx = r_dot cos(theta) - r theta_dot sin(theta)', "// &
                        "'vy = r_dot sin(theta) + r theta_dot cos(theta)' "// &
                        "T = 'm/2 (vx^2 + vy^2)' V = '-k/r'", 2, [1.3_dp, 2.0_dp], system)
        if (anyExceptions()) return
        call assertEqual(2, system%cyclic)
        call read_typed("own", "coordinates = 'r' parameters = 'm', 'w' definitions = "// &
                        "'vx = r_dot cos(w t) - r w sin(w t)', "// &
                        "'vy = r_dot sin(w t) + r w cos(w t)' T = 'm/2 (vx^2 + vy^2)'", 1, &
                        [1.3_dp, 2.0_dp], system)
        if (anyExceptions()) return
        call assertFalse(system%time_dependent, "no time")
        call assertFalse(system%velocity_forces, "no velocities")
    end subroutine what_cancels_is_not_there

    subroutine equations_are_written()
        !! As on paper; a force beside L stands on the right.
        class(system_t), allocatable :: system
        type(scene_t) :: scene
        type(description_t) :: d

        call read_spring(spring, scene, system)
        if (anyExceptions()) return
        call system%describe(d)
        call assertEqual("m r_ddot - m r theta_dot^2 + k r - k l0 - m g cos(theta) = 0", &
                         trim(d%equations(1)))
        call assertEqual("m r^2 theta_ddot + 2 m r r_dot theta_dot + m g r sin(theta) = 0", &
                         trim(d%equations(2)))
        call read_typed("own", "coordinates = 'x' parameters = 'm', 'b' T = 'm/2 x_dot^2' "// &
                        "Q_x = '-b x_dot'", 1, [1.0_dp, 2.0_dp], system)
        if (anyExceptions()) return
        call system%describe(d)
        call assertEqual("m x_ddot = -b x_dot", trim(d%equations(1)))
        call assertEqual("m/2 x_dot^2", d%energy)
    end subroutine equations_are_written

    subroutine overrides_reach_formulas()
        !! `--set` changes a formula, a parameter, and adds a force.
        class(system_t), allocatable :: system
        type(scene_t) :: scene
        type(error_t), allocatable :: error
        type(word_t) :: words(3)
        real(dp) :: a(2)

        words(1)%text = "spring%k=10"
        words(2)%text = "lagrangian%V=k/2 (r - l0)^2"
        words(3)%text = "lagrangian%Q_theta='4 m r^2'"
        call parse_scene("&scene system = 'spring' dt = 1e-3 duration = 1.0 q = 1.4, 0.6 /"//nl// &
                         spring, "spring.nml", words, scene, system, error)
        if (allocated(error)) call assertEqual("", error%message)
        if (anyExceptions()) return
        call system%accelerations(0.0_dp, [1.7_dp, 0.6_dp], [0.0_dp, 0.0_dp], a)
        call assertEqual([-1.0_dp, 4.0_dp], a, 16*epsilon(a))
    end subroutine overrides_reach_formulas
end module test_written_system
