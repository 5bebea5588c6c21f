module test_echo
    !! The scene in a data file's header, all defaults filled in, makes the same scene again.
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertFalse, assertTrue
    use lagrangia_catalogue, only: nth_system
    use lagrangia_columns, only: column_names
    use lagrangia_command_line, only: word_t
    use lagrangia_description, only: description_t, name_length
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp
    use lagrangia_scene, only: scene_line_length, scene_lines, scene_t
    use lagrangia_scene_reader, only: parse_scene, read_scene
    use lagrangia_shipped, only: shipped_scenes
    use lagrangia_system, only: system_t
    use lagrangia_text, only: join, to_text
    use scene_runs, only: read_and_plan
    implicit none (type, external)
    private
    public :: echo_suite

    character(*), parameter :: nl = new_line("a")

contains

    function echo_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("echo")
        call suite%addTest(TestMethod("every_echo_is_the_scene", every_echo_is_the_scene))
        call suite%addTest(TestMethod("long_lists_are_not_cut", long_lists_are_not_cut))
        call suite%addTest(TestMethod("quotes_and_digits_survive", quotes_and_digits_survive))
        call suite%addTest(TestMethod("no_parameters_are_an_empty_group", &
                                      no_parameters_are_an_empty_group))
        call suite%addTest(TestMethod("a_formula_is_broken_where_it_may_be", &
                                      a_formula_is_broken_where_it_may_be))
    end function echo_suite

    function echo(scene, system) result(text)
        !! The lines of a header, as one text.
        type(scene_t), intent(in) :: scene
        class(system_t), intent(in) :: system
        character(:), allocatable :: text
        type(description_t) :: d
        character(scene_line_length), allocatable :: lines(:)
        integer :: i

        call system%describe(d)
        allocate (lines, source=scene_lines(scene, d))
        text = ""
        do i = 1, size(lines)
            text = text//trim(lines(i))//nl
        end do
    end function echo

    subroutine check_echo(scene, system, again)
        !! Read the echo of `scene`, and compare all that there is.
        type(scene_t), intent(in) :: scene
        class(system_t), intent(in) :: system
        type(scene_t), intent(out) :: again
        class(system_t), allocatable :: same_system
        type(error_t), allocatable :: error
        character(:), allocatable :: text
        integer :: i

        text = echo(scene, system)
        call read_and_plan(text, scene%source, [word_t ::], again, same_system, error)
        call assertFalse(allocated(error), scene%source//": the echo can be read"//nl//text)
        if (allocated(error)) return
        call assertEqual([scene%t0, scene%dt, scene%tolerance, scene%duration, scene%q, scene%v, &
                          scene%parameters], &
                         [again%t0, again%dt, again%tolerance, again%duration, again%q, again%v, &
                          again%parameters], message=scene%source)
        call assertEqual([scene%every, scene%samples], [again%every, again%samples])
        call assertTrue(all([scene%compensated, scene%error_estimate, scene%modes] .eqv. &
                            [again%compensated, again%error_estimate, again%modes]), "flags")
        call assertEqual([character(200) :: scene%title, scene%system, scene%method, scene%output, &
                          scene%period_of], [character(200) :: again%title, again%system, &
                                             again%method, again%output, again%period_of])
        call assertEqual(scene%columns, again%columns)
        call assertEqual(scene%plots, again%plots)
        call assertTrue(allocated(scene%events) .eqv. allocated(again%events), "events")
        if (allocated(scene%events)) then
            call assertEqual(scene%events, again%events)
            call assertEqual(scene%event_columns, again%event_columns)
            call assertEqual(scene%event_plots, again%event_plots)
        end if
        call assertEqual(size(scene%expectations), size(again%expectations))
        if (anyExceptions()) return
        do i = 1, size(scene%expectations)
            call assertEqual(scene%expectations(i)%name, again%expectations(i)%name)
            call assertEqual(scene%expectations(i)%limit, again%expectations(i)%limit)
        end do
        call assertEqual(text, echo(again, same_system))
    end subroutine check_echo

    subroutine every_echo_is_the_scene()
        !! Bit for bit. A default does not show whether it is echoed: so `t0` is another, after a
        !! whole turn of `turning_wire`, which must start on its wire.
        type(word_t), allocatable :: paths(:)
        type(word_t) :: later(1)
        type(error_t), allocatable :: error
        class(system_t), allocatable :: system
        type(scene_t) :: scene, again
        integer :: i

        later(1)%text = "scene%t0=5.235987755982989"
        call shipped_scenes(paths)
        do i = 1, size(paths)
            call read_scene(paths(i)%text, later, scene, system, error)
            call assertFalse(allocated(error), paths(i)%text)
            if (allocated(error)) return
            call check_echo(scene, system, again)
            if (anyExceptions()) return
        end do
    end subroutine every_echo_is_the_scene

    subroutine long_lists_are_not_cut()
        !! Every column that a system has, and eight panels of seven curves each.
        class(system_t), allocatable :: system, same_system
        type(error_t), allocatable :: error
        type(description_t) :: d
        type(scene_t) :: scene, again
        character(name_length), allocatable :: names(:)
        character(:), allocatable :: panel, text
        integer :: i, k

        i = 0
        do
            i = i + 1
            call nth_system(i, system)
            if (.not. allocated(system)) exit
            call system%describe(d)
            allocate (names, source=column_names(system, .false.))
            panel = "'"//join(names(size(names) - 4:), "+")//"'"
            text = "&scene system='"//trim(d%name)//"' dt=1e-2 duration=1 q="// &
                   to_text(system%ndof)//"*0.1 columns='"//join(names, "','")//"' plot="//panel
            do k = 2, 8
                text = text//","//panel
            end do
            call read_and_plan(text//" /", "s.nml", [word_t ::], scene, same_system, error)
            call assertFalse(allocated(error), text)
            if (allocated(error)) return
            call assertEqual(size(names), size(scene%columns))
            call check_echo(scene, system, again)
            if (anyExceptions()) return
            deallocate (names)
        end do
    end subroutine long_lists_are_not_cut

    subroutine quotes_and_digits_survive()
        !! Quotes in a title; numbers that need 17 digits, that are tiny, huge, or negative zero.
        class(system_t), allocatable :: system
        type(error_t), allocatable :: error
        type(scene_t) :: scene, again

        call read_and_plan("&scene title = 'it''s ""it"" ! / &b = 1', system='pendulum'"//nl// &
                         "dt=0.1000000000000000055, duration=0.30000000000000004, t0=-1e-300,"// &
                         "every=3, samples=1"//nl//"q=1e300, v=-0.0, compensated=t /"//nl// &
                         "&pendulum m=4.9406564584124654e-324, l=1.7976931348623157e308 /", &
                         "s.nml", [word_t ::], scene, system, error)
        call assertTrue(allocated(error), "both every and samples")
        call read_and_plan("&scene title = 'it''s ""it"" ! / &b = 1', system='pendulum'"//nl// &
                         "dt=0.1000000000000000055, duration=0.30000000000000004, t0=-1e-300,"// &
                         "every=3"//nl//"q=1e300, v=-0.0, compensated=t, modes=t, "// &
                         "error_estimate=t /"//nl// &
                         "&pendulum m=4.9406564584124654e-300, l=1.7976931348623157e308 /", &
                         "s.nml", [word_t ::], scene, system, error)
        call assertFalse(allocated(error), "a good scene")
        if (allocated(error)) call assertEqual("", error%message)
        if (allocated(error)) return
        call assertEqual("it's ""it"" ! / &b = 1", scene%title)
        call check_echo(scene, system, again)
        call assertEqual(-1.0_dp, sign(1.0_dp, again%v(1)), message="the sign of zero")
    end subroutine quotes_and_digits_survive

    subroutine no_parameters_are_an_empty_group()
        !! Which stands there all the same, and is read back.
        class(system_t), allocatable :: system
        type(error_t), allocatable :: error
        type(scene_t) :: scene, again

        call read_and_plan("&scene system = 'own', dt = 0.1, duration = 1.0, q = 0.3 /"//nl// &
                           "&lagrangian coordinates = 'x [m]', L = 'x_dot^2/2' /", "own.nml", &
                           [word_t ::], scene, system, error)
        call assertFalse(allocated(error), "read")
        if (allocated(error)) return
        call check_echo(scene, system, again)
        call parse_scene("&scene system = 'own', dt = 0.1, duration = 1.0, q = 0.3 /"//nl// &
                         "&lagrangian coordinates = 'x [m]', L = 'x_dot^2/2' /"//nl//"&onw /", &
                         "own.nml", [word_t ::], scene, system, error)
        call assertTrue(allocated(error), "an empty group of another name")
        if (.not. allocated(error)) return
        call assertEqual("own.nml:3:1: unknown group 'onw'; did you mean 'own'?", error%message)
    end subroutine no_parameters_are_an_empty_group

    subroutine a_formula_is_broken_where_it_may_be()
        !! Behind 80 characters without a place to break at the first there is: before `**`, not
        !! inside; the signs behind it stay together.
        type(scene_t) :: scene
        class(system_t), allocatable :: system
        type(error_t), allocatable :: error
        type(word_t) :: none(0)
        character(:), allocatable :: nested
        integer :: i

        nested = "x"
        do i = 1, 20
            nested = "abs("//nested//")"
        end do
        call parse_scene("&scene system = 'own', dt = 0.1, duration = 1.0, q = 0.3 /"//nl// &
            "&lagrangian coordinates = 'x [m]', parameters = 'k [J]', T = 'x_dot^2/2', V = 'k*"// &
            nested//"**2+k*x+1e-3*k*x**2', /"//nl//"&own k = 1.0 /", "own.nml", none, &
            scene, system, error)
        call assertFalse(allocated(error), "read")
        if (.not. allocated(scene%formulas)) return
        call assertTrue(any(scene%formulas == "  V = 'k*"//nested//"',"), "up to the power")
        call assertTrue(any(index(scene%formulas, "    '**2+k*x+1e-3*k*x**2'") == 1), "the rest")
    end subroutine a_formula_is_broken_where_it_may_be
end module test_echo
