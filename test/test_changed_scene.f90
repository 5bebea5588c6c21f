module test_changed_scene
    !! What `--set` makes of a scene.
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertTrue
    use lagrangia_changed_scene, only: ending_start, make_own_scene, make_own_sweep
    use lagrangia_description, only: check_parameter, description_t, parameter_t
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp
    use lagrangia_run_plan, only: new_run_plan, run_plan_t
    use lagrangia_scene, only: scene_t
    use lagrangia_scene_reader, only: read_scene, read_unchanged
    use lagrangia_shipped, only: shipped_scenes
    use lagrangia_system, only: system_t
    use lagrangia_text, only: join, to_text, word_t
    use test_own_names, only: own_names_suite
    implicit none (type, external)
    private
    public :: changed_scene_suite

contains

    function changed_scene_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("changed_scene")
        call suite%addTest(TestMethod("another_motion_is_another_scene", &
                                      another_motion_is_another_scene))
        call suite%addTest(TestMethod("blanks_between_words_stay", blanks_between_words_stay))
        call suite%addTest(TestMethod("the_same_motion_is_the_same_scene", &
                                      the_same_motion_is_the_same_scene))
        call suite%addTest(TestMethod("parameters_keep_their_letters", &
                                      parameters_keep_their_letters))
        call suite%addTest(TestMethod("what_is_given_is_kept", what_is_given_is_kept))
        call suite%addTest(TestMethod("names_are_those_of_files", names_are_those_of_files))
        call suite%addTest(TestMethod("every_parameter_can_be_changed", &
                                      every_parameter_can_be_changed))
        call suite%addTest(TestMethod("energies_change_places", energies_change_places))
        call suite%addTest(TestMethod("what_is_gone_is_left_out", what_is_gone_is_left_out))
        call suite%addTest(TestMethod("steps_and_tolerances_change_places", &
                                      steps_and_tolerances_change_places))
        call suite%addTest(TestMethod("a_changed_sweep_has_its_own_title", &
                                      a_changed_sweep_has_its_own_title))
        call suite%addTest(TestMethod("a_changed_sweep_has_its_own_files", &
                                      a_changed_sweep_has_its_own_files))
        call suite%addTest(own_names_suite())
    end function changed_scene_suite

    subroutine change(settings, scene)
        !! The shipped pendulum with these settings, `;` between two.
        character(*), intent(in) :: settings
        type(scene_t), intent(out) :: scene
        class(system_t), allocatable :: system
        type(error_t), allocatable :: error
        type(description_t) :: d
        type(word_t), allocatable :: overrides(:)
        character(:), allocatable :: rest
        integer :: i, n

        n = count([(settings(i:i) == ";", i=1, len(settings))]) + 1
        allocate (overrides(n))
        rest = settings//";"
        do i = 1, n
            overrides(i)%text = rest(:index(rest, ";") - 1)
            rest = rest(index(rest, ";") + 1:)
        end do
        call read_scene("data/scenes/pendulum.nml", overrides, scene, system, error)
        call assertFalse(allocated(error), settings)
        if (allocated(error)) return
        call system%describe(d)
        call make_own_scene(scene, overrides, (d%parameters%name))
    end subroutine change

    subroutine another_motion_is_another_scene()
        !! Title, file, and nothing that judges it.
        type(scene_t) :: scene

        call change("  pendulum%l=2 ; Scene % q(1) = 0.5 ", scene)
        call assertTrue(allocated(scene%changes), "it is changed")
        if (.not. allocated(scene%changes)) return
        call assertEqual("l=2, q_1=0.5", scene%changes)
        call assertTrue(index(scene%title, " (l=2, q_1=0.5)") > 0, scene%title)
        call assertEqual("pendulum_l_2_q_1_0.5", trim(scene%output))
        call assertTrue(size(scene%expectations) > 1, "the scene expects something")
        call assertFalse(any(scene%expectations%judged), "of another motion")
    end subroutine another_motion_is_another_scene

    subroutine parameters_keep_their_letters()
        !! However they are typed: the title shows the symbols of the description.
        type(scene_t) :: scene
        type(word_t) :: words(3)

        scene%title = "A top"
        scene%output = "top"
        allocate (scene%expectations(0))
        words(1)%text = "top%i1=2"
        words(2)%text = "TOP % B(2) = 3"
        words(3)%text = "scene%DT=0.1"
        call make_own_scene(scene, words, [character(8) :: "I1", "b"])
        call assertEqual("A top (I1=2, b(2)=3, dt=0.1)", trim(scene%title))
        call assertEqual("top_I1_2_b_2__3_dt_0.1", trim(scene%output))
    end subroutine parameters_keep_their_letters

    subroutine blanks_between_words_stay()
        !! One of them, also before a last letter; those beside other signs and at the ends go.
        character(24), parameter :: typed(8) = [character(24) :: "2 k", " k  x ", "2 k + 3 k x", &
            "- k", "(2) k", "k -", "'a  b ' // c", "b  a .5"]
        character(24), parameter :: shown(8) = [character(24) :: "2 k", "k x", "2 k+3 k x", &
            "-k", "(2)k", "k-", "'a  b '//c", "b a .5"]
        type(scene_t) :: scene
        type(word_t) :: words(1)
        integer :: i

        allocate (scene%expectations(0))
        do i = 1, size(typed)
            scene%title = "A top"
            words(1)%text = "top%b="//typed(i)
            call make_own_scene(scene, words, ["b"])
            call assertEqual("A top (b="//trim(shown(i))//")", trim(scene%title))
        end do
    end subroutine blanks_between_words_stay

    subroutine the_same_motion_is_the_same_scene()
        !! Other columns, another name, fewer rows.
        type(scene_t) :: scene

        call change("scene%columns=t,theta;scene%plot=theta;scene%every=20;scene%title=Mine", scene)
        call assertFalse(allocated(scene%changes), "the motion is the same")
        call assertTrue(all(scene%expectations%judged), "and is judged")
        call assertEqual("Mine", trim(scene%title))
        call assertEqual("pendulum", trim(scene%output))
        call change("scene%columns(2)=theta_dot;scene%plot(1)=theta_dot;Scene%Plot( 2 )=t", scene)
        call assertFalse(allocated(scene%changes), "an element of a list")
        call change("scene%expect_error=1", scene)
        call assertFalse(allocated(scene%changes), "a tolerance changes no motion")
    end subroutine the_same_motion_is_the_same_scene

    subroutine what_is_given_is_kept()
        !! A title, an output and a tolerance that are set on the command line.
        type(scene_t) :: scene

        call change("scene%dt=2e-3;scene%title=Mine;scene%output=mine.dat;scene%expect_error=1", &
                    scene)
        call assertEqual("Mine", trim(scene%title))
        call assertEqual("mine.dat", trim(scene%output))
        call assertEqual(1, count(scene%expectations%judged))
        call assertTrue(all(scene%expectations%name == "error" .eqv. scene%expectations%judged), &
                        "the error is judged, nothing else")
    end subroutine what_is_given_is_kept

    subroutine names_are_those_of_files()
        !! Letters that `output` takes, and not too many.
        type(scene_t) :: scene, other

        call change("scene%dt=1.5E+1;scene%duration=30", scene)
        call assertEqual("pendulum_dt_1.5E1_duration_30", trim(scene%output))
        call change("scene%dt="//repeat("0", 120)//"1", scene)
        call assertEqual("pendulum_changed_", scene%output(:17))
        call assertEqual(0, verify(scene%output(18:25), "0123456789ABCDEF"))
        call assertEqual("", scene%output(26:))
        call change("scene%dt="//repeat("0", 120)//"2", other)
        call assertTrue(other%output /= scene%output, "other changes, another file")
        call assertEqual(10, ending_start("a.b/c_2.5"), message="a number is no ending")
        call assertEqual(6, ending_start("a.b/c.dat"), message="an ending")
        call assertEqual(4, ending_start("c_2"), message="none")
        call assertEqual(2, ending_start("c.data"), message="four letters")
        call assertEqual(8, ending_start("c.datum"), message="five are none")
        call assertEqual(6, ending_start("a.b/c"), message="none, below a folder that has one")
        call assertEqual(8, ending_start("a/b.c/d"), message="none, below a folder below one")
        call change("scene%dt="//repeat("0", 116)//"1", scene)
        call assertEqual("pendulum_dt_"//repeat("0", 116)//"1", trim(scene%output), "120 letters")
        call change("scene%dt="//repeat("0", 117)//"1", scene)
        call assertEqual("pendulum_changed_", scene%output(:17), "more")
    end subroutine names_are_those_of_files

    subroutine every_parameter_can_be_changed()
        !! Of every shipped scene: to each of these values that the parameter may have. The run is
        !! planned, and so refused if the file's other keys do not suit it.
        real(dp), parameter :: by(4) = [2.0_dp, 0.5_dp, 0.0_dp, 0.0_dp]
        real(dp), parameter :: plus(4) = [0.0_dp, 0.0_dp, 0.0_dp, 0.1_dp]
        class(system_t), allocatable :: system
        type(description_t) :: d
        type(error_t), allocatable :: error
        type(parameter_t) :: p
        type(scene_t) :: scene
        type(word_t), allocatable :: paths(:)
        type(word_t) :: none(0), overrides(1)
        integer :: first, i, j, k, tried

        tried = 0
        call shipped_scenes(paths)
        do i = 1, size(paths)
            call read_scene(paths(i)%text, none, scene, system, error)
            call assertFalse(allocated(error), paths(i)%text)
            if (allocated(error)) cycle
            call system%describe(d)
            do j = 1, size(d%parameters)
                first = 1 + sum(d%parameters(:j - 1)%count)
                if (d%parameters(j)%name == "n") cycle  ! another start: `what_is_gone_is_left_out`
                do k = 1, size(by)
                    p = d%parameters(j)
                    p%value(:p%count) = by(k)*scene%parameters(first:first + p%count - 1) + plus(k)
                    call check_parameter(p, error)
                    if (allocated(error)) cycle
                    ! Without a mass or a length a system in formulas has no inertia.
                    if (by(k) + plus(k) <= 0.0_dp .and. allocated(scene%formulas) .and. &
                        any(["m ", "m1", "m2", "l1", "l2"] == p%name)) cycle
                    overrides(1)%text = setting(trim(scene%system), p)
                    call plan_changed(paths(i)%text, overrides)
                    tried = tried + 1
                end do
            end do
        end do
        call assertEqual(742, tried, message="all were tried")
    end subroutine every_parameter_can_be_changed

    function setting(system, p) result(text)
        !! `pendulum%l=2.0`.
        character(*), intent(in) :: system
        type(parameter_t), intent(in) :: p
        character(:), allocatable :: text
        integer :: i

        text = system//"%"//trim(p%name)//"="
        do i = 1, p%count
            if (i > 1) text = text//","
            text = text//to_text(p%value(i))
        end do
    end function setting

    recursive subroutine plan_changed(path, overrides)
        !! The changed scene is read and planned, and nothing judges it. Verlet is refused where a
        !! force now depends on velocities; with a method that is named there the run is planned.
        character(*), intent(in) :: path
        type(word_t), intent(in) :: overrides(:)
        class(system_t), allocatable :: system
        type(description_t) :: d
        type(error_t), allocatable :: error
        type(run_plan_t) :: plan
        type(scene_t) :: scene
        type(word_t), allocatable :: more(:)

        call read_scene(path, overrides, scene, system, error)
        if (.not. allocated(error)) then
            call system%describe(d)
            call make_own_scene(scene, overrides, (d%parameters%name))
            call assertFalse(any(scene%expectations%judged), overrides(1)%text)
            call new_run_plan(plan, scene, system, error)
        end if
        if (.not. allocated(error)) return
        ! A start that the changed system has not: beyond a shorter rod, off a changed constraint.
        if (index(error%message, "; start elsewhere") > 0) return
        if (index(error%message, "verlet is for forces that depend on positions only, "// &
                  "and here they depend on velocities; these methods work: rk4") > 0) then
            allocate (more(size(overrides) + 1))
            more(:size(overrides)) = overrides
            more(size(more))%text = "scene%method=rk4"
            call plan_changed(path, more)
            return
        end if
        call assertEqual("", path//" "//overrides(1)%text//": "//error%message)
    end subroutine plan_changed

    subroutine energies_change_places()
        !! Friction: the drift of the energy's balance for that of the energy, and back, in columns,
        !! panels and expectations, and the scene's warning says so.
        type(scene_t) :: scene
        class(system_t), allocatable :: system
        type(error_t), allocatable :: error
        type(word_t) :: overrides(1)

        call change("pendulum%b=0.1", scene)
        call assertEqual("t, theta, energy_balance_drift, error", join(scene%columns, ", "))
        call assertTrue(any(scene%expectations%name == "energy_balance_drift"), "measured still")
        call assertFalse(any(scene%expectations%name == "energy_drift"), "there is none")
        call assertTrue(allocated(scene%warning), "it is said")
        if (allocated(scene%warning)) call assertEqual("its energy is no longer conserved, for "// &
            "generalised forces do work; left out of the file's scene: expect_energy_drift", &
            scene%warning)
        overrides(1)%text = "pendulum%b=0.1"
        call read_scene("data/scenes/pendulum_separatrix.nml", overrides, scene, system, error)
        call assertEqual("t:theta, theta:theta_dot, energy_balance_drift", join(scene%plots, ", "))
        overrides(1)%text = "oscillator%b=0"
        call read_scene("data/scenes/damped_oscillator.nml", overrides, scene, system, error)
        call assertEqual("t, x, x_dot, energy, energy_drift, error", join(scene%columns, ", "))
        call assertEqual("its energy is conserved now; left out of the file's scene: "// &
                         "expect_energy_balance_drift", scene%warning)
        overrides(1)%text = "dry_friction%v0=1e-9"
        call read_scene("data/scenes/dry_friction.nml", overrides, scene, system, error)
        call assertFalse(allocated(error), "a friction that is always the same")
        if (.not. allocated(error)) call assertTrue(system%velocity_forces, "it turns round with v")
        overrides(1)%text = "dry_friction%mu=0"
        call read_scene("data/scenes/dry_friction.nml", overrides, scene, system, error)
        call assertEqual("t, x, x_dot, energy_drift", join(scene%columns, ", "))
        call assertEqual("x, x:x_dot", join(scene%plots, ", "))
    end subroutine energies_change_places

    subroutine what_is_gone_is_left_out()
        !! A shorter chain has no tenth bob; fewer columns leave panels without theirs.
        type(scene_t) :: scene
        class(system_t), allocatable :: system
        type(error_t), allocatable :: error
        type(word_t) :: overrides(2)

        overrides(1)%text = "hanging_chain%n=5"
        overrides(2)%text = "scene%q=5*0.6"
        call read_scene("data/scenes/hanging_chain.nml", overrides(:1), scene, system, error)
        call assertTrue(allocated(error), "another start is needed")
        if (allocated(error)) call assertTrue(index(error%message, &
            "; add --set scene%q=5*0.6") > 0, error%message)
        call read_scene("data/scenes/hanging_chain.nml", overrides, scene, system, error)
        call assertFalse(allocated(error), "with it")
        if (allocated(error)) return
        call assertEqual("t, theta1, tension1, energy_drift", join(scene%columns, ", "))
        call assertEqual("theta1, tension1, energy_drift", join(scene%plots, ", "))
        call assertEqual("left out of the file's scene: theta10, x_bob10, y_bob10", scene%warning)
        overrides(1)%text = "scene%columns=t,theta"
        call read_scene("data/scenes/pendulum_separatrix.nml", overrides(:1), scene, system, error)
        call assertFalse(allocated(error), "fewer columns")
        if (.not. allocated(error)) call assertEqual("t:theta", join(scene%plots, ", "))
    end subroutine what_is_gone_is_left_out

    subroutine steps_and_tolerances_change_places()
        !! What is set takes the place of the file's other one, and of the counts that go with it.
        type(scene_t) :: scene
        class(system_t), allocatable :: system
        type(error_t), allocatable :: error
        type(word_t) :: overrides(2)

        call change("scene%method=dop853;scene%tolerance=1e-9", scene)
        call assertEqual(1e-9_dp, scene%tolerance)
        call assertEqual("left out of the file's scene: every, dt", scene%warning)
        call change("scene%method=dop853", scene)
        call assertEqual(1e-10_dp, scene%tolerance)
        call change("scene%samples=500", scene)
        call assertEqual(40, int(scene%every))
        call change("scene%dt=1e-4", scene)
        call assertEqual(100, int(scene%every), message="0.01 s, as in the file")
        call assertEqual("every = 100 leaves the rows as far apart as the file's", scene%warning)
        call change("scene%dt=0.2", scene)
        call assertTrue(index(scene%warning, "a row each 0.2 s, where the file") > 0, "rows")
        call change("scene%dt=1e-4;scene%every=7", scene)
        call assertEqual(7, int(scene%every), message="as it is set")
        overrides(1)%text = "scene%method=rk4"
        overrides(2)%text = "scene%dt=1e-2"
        call read_scene("data/scenes/sphere.nml", overrides(:1), scene, system, error)
        call assertTrue(allocated(error), "it needs a step")
        if (allocated(error)) call assertTrue(index(error%message, &
            "add --set scene%dt=1e-3 or the like") > 0, error%message)
        call read_scene("data/scenes/sphere.nml", overrides, scene, system, error)
        call assertFalse(allocated(error), "and has one")
        if (allocated(error)) return
        call assertEqual(0.0_dp, scene%tolerance)
        call assertEqual(1e-2_dp, scene%dt)
        overrides(1)%text = "scene%v(2)=0.2"
        call read_scene("data/scenes/charged_trap.nml", overrides(:1), scene, system, error)
        call assertFalse(allocated(error), "one velocity, where the file has none")
        if (.not. allocated(error)) call assertEqual([0.0_dp, 0.2_dp, 0.0_dp], scene%v)
    end subroutine steps_and_tolerances_change_places

    subroutine a_changed_sweep_has_its_own_title()
        !! Of other axes, of other values, of both; one that is given stays.
        character(*), parameter :: own = "When does the lower bob of a double pendulum first "// &
            "go over the top?"
        character(32), parameter :: keys(4) = [character(32) :: "double_pendulum%m1=5", &
            "scene%samples=8", "scene%title=Mine", "scene%columns=t"]

        call assertEqual(own, title_of(keys(:0), "theta1 = -pi:pi:400"))
        call assertEqual(own, title_of(keys(:0), " theta1=0:1:3"), "another part of the axis")
        call assertEqual(own, title_of(keys(4:), "theta1 = -pi:pi:400"), "the same numbers")
        call assertEqual(own//" (m1=5, samples=8)", title_of(keys(:2), "theta1 = -pi:pi:400"))
        call assertEqual("flip_map: flip theta2 over l1 and theta2", title_of(keys(:0), "l1=1:2:3"))
        call assertEqual("flip_map: flip theta2 over l1 and theta2 (m1=5)", &
                         title_of(keys(:1), "l1=1:2:3"))
        call assertEqual("Mine", title_of(keys(:3), "l1=1:2:3"))
    end subroutine a_changed_sweep_has_its_own_title

    subroutine a_changed_sweep_has_its_own_files()
        !! Those of the unchanged sweep stay. A scene that has no sweep has none to lose.
        character(64), parameter :: keys(5) = [character(64) :: "double_pendulum%m1=5", &
            "scene%output=mine", "sweep%after=2", "sweep%keep=energy", "scene%columns=t"]
        character(64), parameter :: whole(2) = [character(64) :: "sweep%over=theta=0:1:3", &
            "sweep%keep=period"]
        type(scene_t) :: scene

        call change_sweep("flip_map", keys(:0), "theta1 = -pi:pi:400", scene)
        call assertEqual("flip_map", trim(scene%output))
        call change_sweep("flip_map", keys(5:), "theta1=-pi:pi:400", scene)
        call assertEqual("flip_map", trim(scene%output), "the same numbers")
        call change_sweep("flip_map", keys(:0), " theta1=0:1:3", scene)
        call assertEqual("flip_map_theta1_0_1_3_theta2_-pi_pi_400", trim(scene%output))
        call change_sweep("flip_map", keys(:1), "theta1 = -pi:pi:400", scene)
        call assertEqual("flip_map_m1_5", trim(scene%output))
        call change_sweep("flip_map", keys(:2), "theta1 = 0:1:3", scene)
        call assertEqual("mine", trim(scene%output))
        call change_sweep("flip_map", keys(3:4), "theta1 = -pi:pi:400", scene)
        call assertEqual("flip_map_keep_energy_after_2.0", trim(scene%output))
        call assertEqual("flip_map: energy over theta1 and theta2 (after=2.0)", trim(scene%title))
        call change_sweep("pendulum", whole, "", scene)
        call assertEqual("pendulum", trim(scene%output))
        call assertEqual("pendulum: period over theta", trim(scene%title))
    end subroutine a_changed_sweep_has_its_own_files

    function title_of(settings, axis) result(title)
        !! Of the shipped sweep with these settings and this first axis.
        character(*), intent(in) :: settings(:), axis
        character(:), allocatable :: title
        type(scene_t) :: scene

        call change_sweep("flip_map", settings, axis, scene)
        title = trim(scene%title)
    end function title_of

    subroutine change_sweep(name, settings, axis, scene)
        !! A shipped scene with these settings, and this first axis if it is not empty.
        character(*), intent(in) :: name, settings(:), axis
        type(scene_t), intent(out) :: scene
        type(scene_t) :: file
        class(system_t), allocatable :: system
        type(error_t), allocatable :: error
        type(description_t) :: d
        type(word_t) :: overrides(size(settings))
        integer :: i

        do i = 1, size(settings)
            overrides(i)%text = trim(settings(i))
        end do
        call read_scene(merge("data/sweeps/", "data/scenes/", name == "flip_map")//name//".nml", &
                        overrides, scene, system, error)
        call assertFalse(allocated(error), "a good scene")
        if (allocated(error)) scene%title = error%message
        if (allocated(error)) return
        call system%describe(d)
        call read_unchanged(scene, file)
        if (axis /= "") scene%sweep%over(1) = axis
        call make_own_sweep(scene, file, overrides, (d%parameters%name))
    end subroutine change_sweep
end module test_changed_scene
