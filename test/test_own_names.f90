module test_own_names
    !! What another sweep, or a system with other parameters, is called: every key that makes it
    !! another one is in its title and in its files' names.
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse
    use lagrangia_changed_scene, only: ending_start, make_own_name, make_own_scene, make_own_sweep
    use lagrangia_kinds, only: dp
    use lagrangia_scene, only: scene_t
    use lagrangia_text, only: to_text, word_t
    implicit none (type, external)
    private
    public :: own_names_suite

contains

    function own_names_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("own_names")
        call suite%addTest(TestMethod("other_texts_have_other_files", &
                                      other_texts_have_other_files))
        call suite%addTest(TestMethod("every_key_of_a_sweep_is_told", every_key_of_a_sweep_is_told))
        call suite%addTest(TestMethod("a_changed_system_has_its_own_name", &
                                      a_changed_system_has_its_own_name))
    end function own_names_suite

    subroutine other_texts_have_other_files()
        !! Formulas that differ in signs only, or in a blank; a title keeps the blanks of a text.
        character(24), parameter :: settings(*) = [character(24) :: "lagrangian%V=k*x", &
            "lagrangian%V=k/x", "lagrangian%V=k x", "lagrangian%V=kx", "lagrangian%V='k x'", &
            "lagrangian%V='k*x'", "lagrangian%V='k/x'", "lagrangian%V='kx'", &
            "lagrangian%V='k+x'", "lagrangian%V=k+2*x", "lagrangian%V=k-2*x"]
        character(255) :: outputs(size(settings))
        type(scene_t) :: scene
        type(word_t) :: words(1)
        integer :: i

        do i = 1, size(settings)
            scene%output = "z"
            scene%title = "z"
            if (.not. allocated(scene%expectations)) allocate (scene%expectations(0))
            words(1)%text = trim(settings(i))
            call make_own_scene(scene, words, [character(8) ::])
            outputs(i) = scene%output
            call assertFalse(any(outputs(:i - 1) == outputs(i)), settings(i))
        end do
        scene%title = "z"
        words(1)%text = "scene%event='theta = 0 rising'"
        call make_own_scene(scene, words, [character(8) ::])
        call assertEqual("z (event='theta = 0 rising')", trim(scene%title))
        call assertEqual(8, ending_start("pend.v2"), message="a version is no ending")
        call assertEqual(7, ending_start("a/.hid"), message="a name that begins with a dot")
    end subroutine other_texts_have_other_files

    subroutine every_key_of_a_sweep_is_told()
        !! Each in the title and in the file's name, one alone and all in a row.
        type(scene_t) :: file, scene
        type(word_t) :: none(0)

        allocate (file%sweep%over(2), file%sweep%keep(1))
        file%title = "A sweep"
        file%name = "s"
        file%output = "s.dat"
        file%sweep%over = ["a = 0:1:2", "b = 0:1:2"]
        file%sweep%keep = "energy"
        scene = file
        call told("A sweep", "s.dat")
        scene%sweep%after = 2.5_dp
        call told("A sweep (after=2.5)", "s_after_2.5.dat")
        scene%sweep%strobe = "period"
        call told("A sweep (strobe=period)", "s_strobe_period.dat")
        scene%sweep%section = "theta=0"
        call told("A sweep (section=theta=0)", "s_section_theta_0.dat")
        scene%sweep%points = file%sweep%points + 1
        call told("A sweep (points="//to_text(scene%sweep%points)//")", &
                  "s_points_"//to_text(scene%sweep%points)//".dat")
        scene%sweep%energy_by = "theta"
        call told("A sweep (energy_by=theta)", "s_energy_by_theta.dat")
        scene%sweep%most_steps = 77
        call told("A sweep (most_steps=77)", "s_most_steps_77.dat")
        scene%sweep%seed = file%sweep%seed + 3
        call told("A sweep (seed="//to_text(scene%sweep%seed)//")", &
                  "s_seed_"//to_text(scene%sweep%seed)//".dat")
        scene%sweep%keep = "period"
        call told("s: period over a and b", "s_keep_period.dat")
        scene%sweep%over(2) = "d=0:1:2"
        scene%sweep%after = 1.0_dp
        call told("s: energy over a and d (after=1.0)", "s_a_0_1_2_d_0_1_2_after_1.0.dat")
    contains
        subroutine told(title, output)
            !! Those of the changed sweep; then it is the file's again.
            character(*), intent(in) :: title, output

            call make_own_sweep(scene, file, none, ["l"])
            call assertEqual(title, trim(scene%title))
            call assertEqual(output, trim(scene%output))
            scene = file
        end subroutine told
    end subroutine every_key_of_a_sweep_is_told

    subroutine a_changed_system_has_its_own_name()
        !! What its parameters are, and where it is looked at; keys of a scene and of a sweep do not
        !! concern it.
        type(word_t) :: words(4)

        words(1)%text = "scene%dt=0.1"
        words(2)%text = "Top % i1 = 2"
        words(3)%text = "sweep%seed=3"
        words(4)%text = "top%b(2)=3"
        call named(words(:0), "", "top", "top")
        call named(words(1:3:2), "", "top", "top")
        call named(words(:3), "", "top_I1_2", "top (I1=2)")
        call named(words, "", "top_I1_2_b_2__3", "top (I1=2, b(2)=3)")
        call named(words(:1), "0, pi", "top_at_0_pi", "top (at=0, pi)")
        call named(words(4:), "pi", "top_b_2__3_at_pi", "top (b(2)=3, at=pi)")
    contains
        subroutine named(overrides, at, name, title)
            !! The top with these changes.
            type(word_t), intent(in) :: overrides(:)
            character(*), intent(in) :: at, name, title
            character(:), allocatable :: own, own_title

            own = "top"
            call make_own_name(own, overrides, [character(8) :: "I1", "b"], at, own_title)
            call assertEqual(name, own)
            call assertEqual(title, own_title)
        end subroutine named
    end subroutine a_changed_system_has_its_own_name
end module test_own_names
