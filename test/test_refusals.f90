module test_refusals
    !! What is said of nonsense: the same words as are kept in the files `test/refusals`. Scenes,
    !! command lines and formulas are those of users, changed at random.
    use funit, only: TestMethod, TestSuite, assertFalse
    use kept_texts, only: compare_with_kept
    use lagrangia_characters, only: printable
    use lagrangia_command_line, only: command_line_t, parse_words, word_t
    use lagrangia_errors, only: error_t
    use lagrangia_expression, only: expression_t
    use lagrangia_files, only: read_whole_file
    use lagrangia_formula_parser, only: parse_equation
    use lagrangia_registry, only: check_line, options
    use lagrangia_run_plan, only: parse_run_plan, run_plan_t
    use lagrangia_shipped, only: shipped_scenes
    use lagrangia_symbols, only: symbols_t
    use mutations, only: mutate, pick, seed_with, spoil
    implicit none (type, external)
    private
    public :: refusals_suite

    character, parameter :: line_feed = new_line("a")

contains

    function refusals_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("refusals")
        call suite%addTest(TestMethod("of_scenes", of_scenes))
        call suite%addTest(TestMethod("of_command_lines", of_command_lines))
        call suite%addTest(TestMethod("of_formulas", of_formulas))
    end function refusals_suite

    subroutine add_line(text, line)
        !! One that is not there yet.
        character(:), allocatable, intent(inout) :: text
        character(*), intent(in) :: line

        if (index(line_feed//text, line_feed//line//line_feed) == 0) text = text//line//line_feed
    end subroutine add_line

    subroutine of_scenes()
        !! Shipped scenes with up to three changes, or a number that is none, and every other one
        !! with an override.
        character(*), parameter :: sets(*) = [character(36) :: "scene%dt=1e-3", "scene%q=0,1", &
            "scene%columns=t,energy", "wedge%alpha=0.5", "scene%method=rk4", "scene%q(2)=1", &
            "lagrangian%V=k/2 (r - l0)^2", "lagrangian%Q_r=-r_dot", "pendulum%l=-1", &
            "scene%event=theta = 0 stop", "scene%plot=x:y", "scene%samples=7", "scene%tolerance=1"]
        type(word_t), allocatable :: paths(:), set(:), scenes(:)
        type(error_t), allocatable :: error
        type(run_plan_t) :: plan
        character(:), allocatable :: kept, text, word
        integer :: i, number

        call shipped_scenes(paths)
        allocate (scenes(size(paths)))
        do i = 1, size(paths)
            call read_whole_file(paths(i)%text, scenes(i)%text, error)
            call assertFalse(allocated(error), paths(i)%text)
        end do
        call seed_with(7)
        kept = ""
        do i = 1, 1500
            number = pick(size(scenes))
            text = scenes(number)%text
            if (mod(i, 3) == 0) then
                call spoil(text, word)
            else
                number = pick(size(scenes))
                call mutate(text, pick(4) - 1, scenes(number)%text)
            end if
            allocate (set(mod(i, 2)))
            if (size(set) > 0) then
                number = pick(size(sets))
                word = trim(sets(number))
                call mutate(word, pick(3) - 1, "")
                set(1)%text = word
            end if
            call parse_run_plan(plan, text, "a.nml", set, error)
            if (allocated(error)) call add_line(kept, error%message)
            deallocate (set)
        end do
        call compare_with_kept("test/refusals/scenes.txt", kept)
    end subroutine of_scenes

    subroutine of_command_lines()
        !! Up to six words, every third of them with a change.
        character(*), parameter :: words(*) = [character(24) :: &
            "run", "list", "describe", "modes", "check", "derive", "sweep", "grade", "report", &
            "compare", "bench", "principle", "cart_pendulum", "systems", "-", "", "--", "--set", &
            "scene%dt=1e-3", "--set=scene%dt=1", "--json", "--output", "--format=csv", "--help", &
            "-h", "--plot=svg", "--quiet", "--no", "--over", "--tolerances", "--at", "--latex"]
        type(word_t), allocatable :: line(:)
        type(command_line_t) :: parsed
        type(error_t), allocatable :: error
        character(:), allocatable :: kept, text, all
        integer :: i, k, which

        call seed_with(8)
        kept = ""
        do i = 1, 1000
            allocate (line(pick(6)))
            all = ""
            do k = 1, size(line)
                which = pick(size(words))
                text = trim(words(which))
                if (pick(3) == 1) call mutate(text, 1, "")
                line(k)%text = text
                all = all//" '"//printable(text)//"'"
            end do
            call parse_words(line, options, parsed, error)
            if (.not. allocated(error)) call check_line(parsed, which, error)
            if (allocated(error)) call add_line(kept, all(2:)//": "//error%message)
            deallocate (line)
        end do
        call compare_with_kept("test/refusals/command_lines.txt", kept)
    end subroutine of_command_lines

    subroutine of_formulas()
        !! Lines of students, each with one or two changes; an unknown name with nothing near is a
        !! third of all, and left out.
        character(*), parameter :: names(*) = [character(12) :: "t", "x", "y", "z", "r", "theta", &
            "phi", "theta1", "theta2", "x_dot", "y_dot", "z_dot", "r_dot", "theta_dot", "phi_dot", &
            "theta1_dot", "theta2_dot", "x_ddot", "y_ddot", "theta_ddot", "phi_ddot", "m", "m1", &
            "m2", "l", "l1", "l2", "g", "k", "b", "M", "L", "T", "V", "E", "omega", "alpha"]
        type(symbols_t) :: symbols
        type(expression_t) :: left, right
        type(error_t), allocatable :: error
        character(:), allocatable :: kept, line, other, sheets
        integer :: chosen, first, i, last

        do i = 1, size(names)
            call symbols%add(trim(names(i)))
        end do
        call read_whole_file("test/student_sheets.txt", sheets, error)
        call assertFalse(allocated(error), "student_sheets.txt")
        call seed_with(9)
        kept = ""
        other = ""
        first = 1
        do while (first <= len(sheets))
            last = first + index(sheets(first:)//line_feed, line_feed) - 2
            line = sheets(first + 2:last)
            first = last + 2
            chosen = pick(3)
            if (len(line) < 2 .or. chosen < 3) cycle
            do i = 1, 2
                call mutate(line, i, other)
                call parse_equation(line, symbols, left, right, error)
                if (.not. allocated(error)) cycle
                if (index(error%message, "; there are t, x, y") > 0) cycle
                call add_line(kept, printable(line)//" | "//error%message)
            end do
            other = line
        end do
        call compare_with_kept("test/refusals/formulas.txt", kept)
    end subroutine of_formulas
end module test_refusals
