module test_scene_reference
    !! What 'lagrangia describe scene' says of each key is so.
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertTrue
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_scene, only: scene_t
    use lagrangia_scene_keys, only: keys
    use lagrangia_scene_reader, only: parse_scene
    use lagrangia_scene_reference, only: entries, entry_t, reference_lines
    use lagrangia_sweep_group, only: sweep_keys => keys
    use lagrangia_system, only: system_t
    use lagrangia_text, only: word_t
    implicit none (type, external)
    private
    public :: scene_reference_suite

contains

    function scene_reference_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("scene_reference")
        call suite%addTest(TestMethod("every_key_is_there", every_key_is_there))
        call suite%addTest(TestMethod("every_example_is_taken", every_example_is_taken))
        call suite%addTest(TestMethod("defaults_are_as_stated", defaults_are_as_stated))
        call suite%addTest(TestMethod("lines_fit_the_page", lines_fit_the_page))
    end function scene_reference_suite

    subroutine every_key_is_there()
        !! Each key once, and nothing that is none.
        integer :: i

        do i = 1, size(keys)
            call assertEqual(1, count(entries%group == "scene" .and. entries%key == keys(i)), &
                             keys(i))
        end do
        call assertEqual(size(keys) + 1, count(entries%group == "scene"))
        do i = 1, size(sweep_keys)
            call assertEqual(1, count(entries%group == "sweep" .and. &
                                      entries%key == sweep_keys(i)), sweep_keys(i))
        end do
        call assertEqual(size(sweep_keys), count(entries%group == "sweep"))
    end subroutine every_key_is_there

    subroutine every_example_is_taken()
        !! In a scene that has what else is needed.
        character, parameter :: lf = new_line("a")
        character(*), parameter :: free = "system = 'pendulum'"//lf//"duration = 1.0"//lf// &
                                          "method = 'gauss16'"//lf//"q = 0.5"//lf
        character(*), parameter :: fixed = "system = 'pendulum'"//lf//"duration = 1.0"//lf// &
                                           "method = 'rk4'"//lf//"dt = 0.01"//lf//"q = 0.5"//lf
        character(*), parameter :: own = &
            "coordinates = 'r', 'theta'"//lf//"parameters = 'm', 'k', 'l0', 'g'"//lf// &
            "T = 'm/2 (r_dot^2 + r^2 theta_dot^2)'"//lf// &
                "V = 'k/2 (r - l0)^2 - m g r cos(theta)'"//lf
        type(entry_t) :: item
        type(scene_t) :: scene
        class(system_t), allocatable :: system
        type(error_t), allocatable :: error
        character(:), allocatable :: text
        integer :: i

        text = ""
        do i = 1, size(entries)
            item = entries(i)
            if (any([character(9) :: "tolerance", "event", "samples"] == item%key)) then
                text = "&scene "//without(free, item%key)//trim(item%example)//" /"
            else if (index(item%key, "event_") == 1) then
                text = "&scene "//free//" event = 'theta = 0' "//trim(item%example)//" /"
            else if (item%group == "scene") then
                text = "&scene "//without(fixed, item%key)//trim(item%example)//" /"
            else if (item%group == "sweep") then
                text = "&scene "//fixed//" / &sweep "//trim(item%example)//" /"
            else if (item%group == "NAME") then
                text = "&scene "//fixed//" / &pendulum "//trim(item%example)//" /"
            else
                text = without(own, item%key)
                if (item%key == "L") text = without(without(text, "T"), "V")
                text = "&scene system = 'spring' dt = 0.01 duration = 1.0 q = 1.0, 0.1 / "// &
                       "&lagrangian "//text//trim(item%example)//" / "// &
                       "&spring m = 1, k = 1, l0 = 1, g = 1 /"
            end if
            call parse_scene(text, "example.nml", [word_t ::], scene, system, error)
            if (allocated(error)) call assertEqual("", error%message, trim(item%key))
            if (index(item%key, "NAME") > 0 .or. item%group == "NAME") cycle
            call assertEqual(1, index(item%example, trim(item%key)//" = "), item%key)
        end do
    end subroutine every_example_is_taken

    pure function without(text, key) result(rest)
        !! `text` without the line of this key.
        character(*), intent(in) :: text, key
        character(:), allocatable :: rest
        integer :: first, last

        rest = text
        first = index(new_line("a")//text, new_line("a")//trim(key)//" = ")
        if (first == 0) return
        last = first + index(text(first:), new_line("a")) - 1
        rest = text(:first - 1)//text(last + 1:)
    end function without

    subroutine defaults_are_as_stated()
        type(scene_t) :: scene
        class(system_t), allocatable :: system
        type(error_t), allocatable :: error

        call parse_scene("&scene system = 'pendulum' dt = 0.001 duration = 10 q = 1 /", "a/x.nml", &
                         [word_t ::], scene, system, error)
        call assertFalse(allocated(error), "no error")
        call stated("title", "empty", scene%title == "")
        call stated("method", "'rk4'", scene%method == "rk4")
        call stated("t0", "0.0", abs(scene%t0) <= 0.0_dp)
        call stated("every", "so that there are about 1000 rows", scene%every == 10_i8)
        call stated("compensated", ".false.", .not. scene%compensated)
        call stated("v", "zeros", all(abs(scene%v) <= 0.0_dp))
        call stated("modes", ".false.", .not. scene%modes)
        call stated("error_estimate", ".false.", .not. scene%error_estimate)
        call stated("output", "the file's name", scene%output == "x")
        call stated("period_of", "none", scene%period_of == "")
        call stated("columns", "t, the coordinates, energy_drift or energy_balance_drift", &
                    all(scene%columns == [character(12) :: "t", "theta", "energy_drift"]))
        call parse_scene("&scene system = 'pendulum' method = 'gauss16' duration = 10 q = 1 /", &
                         "x.nml", [word_t ::], scene, system, error)
        call assertFalse(allocated(error), "no error")
        call stated("tolerance", "1e-10", abs(scene%tolerance - 1e-10_dp) <= 0.0_dp)
        call stated("samples", "1000 with a tolerance", scene%samples == 1000_i8)
    contains
        subroutine stated(key, default, so)
            character(*), intent(in) :: key, default
            logical, intent(in) :: so
            integer :: i

            i = findloc(entries%group == "scene" .and. entries%key == key, .true., 1)
            call assertTrue(entries(i)%default == default, key)
            call assertTrue(so, key)
        end subroutine stated
    end subroutine defaults_are_as_stated

    subroutine lines_fit_the_page()
        type(word_t), allocatable :: lines(:)
        integer :: i

        call reference_lines(lines)
        do i = 1, size(lines)
            call assertTrue(len(lines(i)%text) <= 110, lines(i)%text)
        end do
    end subroutine lines_fit_the_page
end module test_scene_reference
