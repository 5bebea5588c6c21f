module test_rare_refusals
    !! What is rarely wrong is refused in its own words, too; and what is just within a limit is
    !! taken.
    use funit, only: TestMethod, TestSuite, assertEqual, assertGreaterThan, assertTrue
    use lagrangia_errors, only: error_t
    use lagrangia_homework, only: homework_t, parse_homework
    use lagrangia_scene, only: scene_t
    use lagrangia_scene_reader, only: parse_scene
    use lagrangia_scene_reference, only: entries
    use lagrangia_sweep, only: sweep_t
    use lagrangia_system, only: system_t
    use lagrangia_text, only: word_t
    use sweep_numbers, only: make_sweep
    implicit none (type, external)
    private
    public :: rare_refusals_suite

    character(*), parameter :: nl = new_line("a")
    character(*), parameter :: cart = "&scene system='cart_pendulum' dt=0.01 duration=1 q=0,1 "

contains

    function rare_refusals_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("rare_refusals")
        call suite%addTest(TestMethod("figures_that_cannot_be", figures_that_cannot_be))
        call suite%addTest(TestMethod("sums_and_indices_have_limits", sums_and_indices_have_limits))
        call suite%addTest(TestMethod("names_and_units_have_limits", names_and_units_have_limits))
        call suite%addTest(TestMethod("sweeps_that_cannot_be", sweeps_that_cannot_be))
        call suite%addTest(TestMethod("every_key_is_looked_at", every_key_is_looked_at))
        call suite%addTest(TestMethod("lines_of_a_sheet", lines_of_a_sheet))
        call suite%addTest(TestMethod("a_longer_chain_needs_a_start", a_longer_chain_needs_a_start))
    end function rare_refusals_suite

    subroutine says(expected, error, what)
        !! Just this; nothing if all is well.
        character(*), intent(in) :: expected, what
        type(error_t), allocatable, intent(in) :: error

        if (allocated(error)) then
            call assertEqual(expected, error%message, what)
        else
            call assertEqual(expected, "", what)
        end if
    end subroutine says

    subroutine figures_that_cannot_be()
        !! Their parts, places, brackets and letters; least and most places of a part.
        call drawn("rod origin bob", "")
        call drawn("rod origin (x, 1 + sin((x)))", "")
        call drawn("rod (1, 2, 3) bob", "")
        call drawn("rope origin bob (0, 1)", "")
        call drawn("rod origin", "rod takes 2 places")
        call drawn("rod origin bob (0, 1)", "rod takes 2 places")
        call drawn("ball", "ball takes 1 place")
        call drawn("rod origin bib", "there is no point 'bib'; a place is origin, a point's "// &
                   "name, or (x, y)")
        call drawn("rod origin (1, 1", "a bracket is not closed in '(1, 1'")
        call drawn("rod origin (1, 2, 3, 4)", "a place has two or three numbers")
        call drawn("let D", "'let D': a letter is written 'let D = R + 1'")
    end subroutine figures_that_cannot_be

    subroutine drawn(part, expected)
        !! A figure of one part, of a point `bob` at `x`.
        character(*), intent(in) :: part, expected
        class(system_t), allocatable :: system
        type(scene_t) :: scene
        type(word_t) :: none(0)
        type(error_t), allocatable :: error

        call parse_scene("&scene system='p' dt=0.1 duration=1 q=1 figure='"//part//"' /"//nl// &
                         "&lagrangian coordinates='x [m]' L='x_dot^2/2' positions='bob: x, 0' /", &
                         "a.nml", none, scene, system, error)
        if (expected == "") call says("", error, part)
        if (expected /= "") call says("a.nml:1:48: &scene: figure = '"//part//"': "//expected, &
                                      error, part)
    end subroutine drawn

    subroutine sums_and_indices_have_limits()
        !! Four sums within each other, a thousand terms, indices up to a million.
        call own("x [m]", "x_dot^2/2 - sum(i,1,2,sum(j,1,2,sum(k,1,2,sum(l,1,2,x^2))))", "")
        call own("x [m]", "x_dot^2/2 - sum(i,1,2,sum(j,1,2,sum(k,1,2,sum(l,1,2,sum(n,1,2,x)))))", &
                 "L: column 57: more than 4 sums within each other")
        call own("x [m]", "x_dot^2/2 - sum(i, 1, 1000, x)", "")
        call own("x [m]", "x_dot^2/2 - sum(i, 1, 1001, x)", &
                 "L: column 29: the sum has more than 1000 terms")
        call own("x [m]", "x_dot^2/2 - sum(i, 999999 + 1, 1000000, x)", "")
        call own("x [m]", "x_dot^2/2 - sum(i, 1000000, 999999 + 2, x)", &
                 "L: column 39: the index is too large")
        call own("x [m]", "x_dot^2/2 - sum(i, 1000001, 1000001, x)", "L: column 20: an index "// &
                 "is a whole number or the index of a sum, as in x_(i + 1), sum(i, 1, 4, ...)")
    end subroutine sums_and_indices_have_limits

    subroutine names_and_units_have_limits()
        !! Those of a coordinate: a unit of 16 characters, 120 of what it is.
        character(*), parameter :: syntax = "a name, its unit and a few words are written "// &
                                            "'r [m] length of the spring'"

        call own("x ["//repeat("m", 16)//"] place", "x_dot^2/2", "")
        call own("x ["//repeat("m", 17)//"] place", "x_dot^2/2", "coordinates = 'x ["// &
                 repeat("m", 17)//"] place': a unit of up to 16 characters stands between "// &
                 "brackets; "//syntax)
        call own("x [] place", "x_dot^2/2", "coordinates = 'x [] place': a unit of up to 16 "// &
                 "characters stands between brackets; "//syntax)
        call own("x [m]   "//repeat("a", 120), "x_dot^2/2", "")
        call own("x   "//repeat("a", 120), "x_dot^2/2", "")
        call own("x [m] "//repeat("a", 121), "x_dot^2/2", "coordinates = 'x [m] "// &
                 repeat("a", 33)//"...: more than 120 characters behind the name")
    end subroutine names_and_units_have_limits

    subroutine own(coordinate, lagrangian, expected)
        !! A system of one coordinate.
        character(*), intent(in) :: coordinate, lagrangian, expected
        class(system_t), allocatable :: system
        type(scene_t) :: scene
        type(word_t) :: none(0)
        type(error_t), allocatable :: error
        integer :: start

        call parse_scene("&scene system='p' dt=0.1 duration=1 q=1 /"//nl//"&lagrangian "// &
                         "coordinates='"//coordinate//"' L='"//lagrangian//"' /", "a.nml", none, &
                         scene, system, error)
        call assertTrue(allocated(error) .neqv. expected == "", coordinate//", "//lagrangian)
        if (.not. allocated(error)) return
        start = index(error%message, "&lagrangian: ") + len("&lagrangian: ")
        call assertEqual(expected, error%message(start:), coordinate//", "//lagrangian)
    end subroutine own

    subroutine sweeps_that_cannot_be()
        !! Two axes of one number by two names, what is no angle, and an energy that cannot be.
        call swept(["theta = 0:1:3", "x     = 0:1:3"], "flip theta", "")
        call swept(["theta = 0:1:3", "q(2)  = 0:1:3"], "flip theta", "both axes change theta")
        call swept(["theta = 0:1:3", "x     = 0:1:3"], "flip x", "only an angle can go over "// &
                   "the top, and x is none")
        call swept(["theta = 0:1:3", "x     = 0:1:3"], "wrapped x", "only an angle can be "// &
                   "wrapped, and x is none")
        call swept(["theta = 0:1:3", "x     = 0:1:3"], "flip y", "a coordinate is needed, not "// &
                   "'y'; there are x, theta")
    end subroutine sweeps_that_cannot_be

    subroutine every_key_is_looked_at()
        !! Whatever a key of a scene or of a sweep takes, three hundred texts are too many, and
        !! no key read behind it hides that. A scene does not yet know which columns there are.
        type(scene_t) :: scene
        class(system_t), allocatable :: system
        type(word_t) :: nothing(0)
        type(error_t), allocatable :: error
        character(:), allocatable :: text
        character(*), parameter :: needed(*) = [character(20) :: "system = 'pendulum'", &
            "dt = 0.1", "duration = 1", "q = 0.1"]
        integer :: i, k, tried

        tried = 0
        do i = 1, size(entries)
            if (all(entries(i)%group /= ["scene", "sweep"])) cycle
            if (entries(i)%key == "columns" .or. entries(i)%key == "expect_NAME") cycle
            text = "&scene"
            do k = 1, size(needed)
                if (index(needed(k), trim(entries(i)%key)//" = ") /= 1) text = text//" "//needed(k)
            end do
            if (entries(i)%group == "sweep") text = text//"/ &sweep"
            text = text//" "//trim(entries(i)%key)//" = "//repeat("'!', ", 299)//"'!' /"
            call parse_scene(text, "a.nml", nothing, scene, system, error)
            call assertTrue(allocated(error), "refused: "//entries(i)%key)
            if (.not. allocated(error)) cycle
            call assertTrue(index(error%message, trim(entries(i)%key)) > 0, error%message)
            tried = tried + 1
        end do
        call assertGreaterThan(tried, 25, message="keys")
    end subroutine every_key_is_looked_at

    subroutine swept(over, keep, expected)
        !! A sweep of the pendulum on a cart.
        character(*), intent(in) :: over(:), keep, expected
        type(sweep_t) :: sweep
        type(error_t), allocatable :: error

        call make_sweep(cart//"/", over, [keep], sweep, error)
        call says(expected, error, keep)
    end subroutine swept

    subroutine a_longer_chain_needs_a_start()
        !! As many numbers; how to write them where they are all the same.
        call started("0.6, 0.5, 0.6", "5 values")
        call started("0.6, 0.6, 0.6", "5*0.6")
    end subroutine a_longer_chain_needs_a_start

    subroutine started(q, remedy)
        !! A chain of three bobs becomes one of five.
        character(*), intent(in) :: q, remedy
        class(system_t), allocatable :: system
        type(scene_t) :: scene
        type(word_t) :: five(1)
        type(error_t), allocatable :: error

        five(1)%text = "hanging_chain%n=5"
        call parse_scene("&scene system = 'hanging_chain', dt = 0.01, duration = 1.0, q = "//q// &
                         " / &hanging_chain n = 3 /", "a.nml", five, scene, system, error)
        call assertTrue(allocated(error), q)
        if (.not. allocated(error)) return
        call assertEqual("; add --set scene%q="//remedy, &
                         error%message(index(error%message, "; add"):), q)
    end subroutine started

    subroutine lines_of_a_sheet()
        !! A word before a colon that is none of a sheet's, and constants without a name.
        call read_sheet("constant: C, h", "")
        call read_sheet("constant:", "sheet:2: 'constant:' needs names, say 'constant: C, h'")
        call read_sheet("constant: , ", "sheet:2: 'constant:' needs names, say 'constant: C, h'")
        call read_sheet("sett: l = 1", "sheet:2: column 5: what is 'sett':? Before a colon "// &
                        "stands 'system', 'set', 'constant' or 'small'")
        call read_sheet("sum: l = 1", "sheet:2: column 4: what is 'sum':? Before a colon "// &
                        "stands 'system', 'set', 'constant' or 'small'")
    end subroutine lines_of_a_sheet

    subroutine read_sheet(line, expected)
        !! A sheet about the pendulum with this second line.
        character(*), intent(in) :: line, expected
        type(homework_t) :: homework
        type(error_t), allocatable :: error

        call parse_homework("system: pendulum"//nl//line//nl//"theta_ddot = -g/l sin(theta)", &
                            "sheet", homework, error)
        call says(expected, error, line)
    end subroutine read_sheet
end module test_rare_refusals
