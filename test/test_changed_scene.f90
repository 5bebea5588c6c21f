module test_changed_scene
    !! What `--set` makes of a scene.
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertTrue
    use lagrangia_changed_scene, only: make_own_scene
    use lagrangia_errors, only: error_t
    use lagrangia_scene, only: scene_t
    use lagrangia_scene_reader, only: read_scene
    use lagrangia_system, only: system_t
    use lagrangia_text, only: word_t
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
        call suite%addTest(TestMethod("the_same_motion_is_the_same_scene", &
                                      the_same_motion_is_the_same_scene))
        call suite%addTest(TestMethod("what_is_given_is_kept", what_is_given_is_kept))
        call suite%addTest(TestMethod("names_are_those_of_files", names_are_those_of_files))
    end function changed_scene_suite

    subroutine change(settings, scene)
        !! The shipped pendulum with these settings, `;` between two.
        character(*), intent(in) :: settings
        type(scene_t), intent(out) :: scene
        class(system_t), allocatable :: system
        type(error_t), allocatable :: error
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
        if (.not. allocated(error)) call make_own_scene(scene, overrides)
    end subroutine change

    subroutine another_motion_is_another_scene()
        !! Title, file, and nothing that judges it.
        type(scene_t) :: scene

        call change("pendulum%l=2; Scene % q(1) = 0.5", scene)
        call assertTrue(allocated(scene%changes), "it is changed")
        if (.not. allocated(scene%changes)) return
        call assertEqual("l=2, q_1=0.5", scene%changes)
        call assertTrue(index(scene%title, " (l=2, q_1=0.5)") > 0, scene%title)
        call assertEqual("pendulum_l_2_q_1_0.5", trim(scene%output))
        call assertTrue(size(scene%expectations) > 1, "the scene expects something")
        call assertFalse(any(scene%expectations%judged), "of another motion")
    end subroutine another_motion_is_another_scene

    subroutine the_same_motion_is_the_same_scene()
        !! Other columns, another name, fewer rows.
        type(scene_t) :: scene

        call change("scene%columns=t,theta;scene%plot=theta;scene%every=20;scene%title=Mine", scene)
        call assertFalse(allocated(scene%changes), "the motion is the same")
        call assertTrue(all(scene%expectations%judged), "and is judged")
        call assertEqual("Mine", trim(scene%title))
        call assertEqual("pendulum", trim(scene%output))
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
        type(scene_t) :: scene

        call change("scene%dt=1.5E+1;scene%duration=30", scene)
        call assertEqual("pendulum_dt_1.5E1_duration_30", trim(scene%output))
        call change("scene%dt="//repeat("0", 120)//"1", scene)
        call assertEqual("pendulum_changed", trim(scene%output))
    end subroutine names_are_those_of_files
end module test_changed_scene
