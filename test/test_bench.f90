module test_bench
    !! The benchmark measures what it says: problems, contestants, tables and choices. No test
    !! looks at a time.
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertFalse, assertTrue
    use lagrangia_bench, only: check_build
    use lagrangia_bench_options, only: bench_options_t, read_options
    use lagrangia_bench_problems, only: bench_problem_t, problem_names, read_problems
    use lagrangia_command_line, only: command_line_t, parse_words, word_t
    use lagrangia_contestant, only: contestant_box_t, set_by_tolerance
    use lagrangia_contestants, only: new_contestants
    use lagrangia_description, only: name_length
    use lagrangia_errors, only: error_t, status_usage
    use lagrangia_kinds, only: dp, i8
    use lagrangia_precision_curve, only: not_known
    use lagrangia_printed_table, only: printed_table_t, count_cell, number_cell, short, word_cell
    use lagrangia_registry, only: options
    implicit none (type, external)
    private
    public :: bench_suite

contains

    function bench_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("bench")
        call suite%addTest(TestMethod("closed_forms_agree_with_the_file", &
                                      closed_forms_agree_with_the_file))
        call suite%addTest(TestMethod("energy_is_kept_to_the_end", energy_is_kept_to_the_end))
        call suite%addTest(TestMethod("everybody_solves_something", everybody_solves_something))
        call suite%addTest(TestMethod("samples_cost_no_accuracy", samples_cost_no_accuracy))
        call suite%addTest(TestMethod("numbers_are_short", numbers_are_short))
        call suite%addTest(TestMethod("tables_are_lines_and_objects", tables_are_lines_and_objects))
        call suite%addTest(TestMethod("debug_builds_are_refused", debug_builds_are_refused))
        call suite%addTest(TestMethod("choices_are_checked", choices_are_checked))
        call suite%addTest(TestMethod("tables_of_words_or_without_rows", &
                                      tables_of_words_or_without_rows))
    end function bench_suite

    subroutine get_problems(problems)
        !! All of them.
        type(bench_problem_t), allocatable, intent(out) :: problems(:)
        type(error_t), allocatable :: error

        call read_problems(problem_names, problems, error)
        call assertFalse(allocated(error), "data/reference/bench.nml is read")
    end subroutine get_problems

    subroutine closed_forms_agree_with_the_file()
        !! Two computations that share nothing: Taylor series in Python, formulas in Fortran. The
        !! tolerance is the rounding of phases of a thousand radians, as large as the motion.
        type(bench_problem_t), allocatable :: problems(:)
        real(dp) :: q(3), v(3)
        character(:), allocatable :: found
        integer :: i, n

        call get_problems(problems)
        if (anyExceptions()) return
        found = ""
        do i = 1, size(problems)
            if (.not. allocated(problems(i)%closed_form)) cycle
            n = problems(i)%system%ndof
            call problems(i)%closed_form%state_at(problems(i)%duration, q(:n), v(:n))
            call assertTrue(problems(i)%error_of(q(:n), v(:n)) < &
                            1e-12_dp*(1.0_dp + maxval(abs(q(:n)))), problems(i)%name)
            found = found//trim(problems(i)%name)//" "
        end do
        call assertEqual("oscillator P2 P3 P4 ", found, "closed forms")
    end subroutine closed_forms_agree_with_the_file

    subroutine energy_is_kept_to_the_end()
        !! By all stored final states, to the rounding of the energy's terms.
        type(bench_problem_t), allocatable :: problems(:)
        real(dp) :: first, last
        integer :: i

        call get_problems(problems)
        if (anyExceptions()) return
        do i = 1, size(problems)
            associate (p => problems(i))
                first = p%system%energy(0.0_dp, p%q, p%v)
                last = p%system%energy(p%duration, p%q_end, p%v_end)
                call assertEqual(first, last, tolerance=1e-13_dp*(1.0_dp + abs(first)), &
                                 message=p%name)
                call assertTrue(p%error_of(p%q_end, p%v_end) <= 0.0_dp, &
                                "p%error_of(p%q_end, p%v_end) <= 0.0")
                call assertTrue(p%error_of(p%q, p%v) > 1e-3_dp, "p%error_of(p%q, p%v) > 1e-3")
            end associate
        end do
    end subroutine energy_is_kept_to_the_end

    subroutine everybody_solves_something()
        !! Each contestant comes near the truth on at least one problem, or it is not measured.
        type(bench_problem_t), allocatable, target :: problems(:)
        type(contestant_box_t), allocatable :: everybody(:)
        type(error_t), allocatable :: error
        real(dp) :: setting, q(3), v(3)
        integer :: i, k, n, solved

        call get_problems(problems)
        if (anyExceptions()) return
        call new_contestants([character(name_length) ::], everybody)
        call assertEqual(21, size(everybody), "contestants")
        do k = 1, size(everybody)
            solved = 0
            do i = 1, size(problems)
                if (problems(i)%name == "P1a" .or. problems(i)%name == "P3") cycle  ! stiff in error
                n = problems(i)%system%ndof
                setting = merge(1e-9_dp, 0.01_dp, everybody(k)%item%set_by == set_by_tolerance)
                call everybody(k)%item%prepare(problems(i), setting, error)
                if (allocated(error)) cycle
                call everybody(k)%item%solve(problems(i), q(:n), v(:n), error)
                call assertFalse(allocated(error), everybody(k)%item%name)
                if (allocated(error)) cycle
                call assertTrue(problems(i)%error_of(q(:n), v(:n)) < 0.5_dp, &
                                trim(everybody(k)%item%name)//" on "//problems(i)%name)
                solved = solved + 1
            end do
            call assertTrue(solved > 0, everybody(k)%item%name)
        end do
    end subroutine everybody_solves_something

    subroutine samples_cost_no_accuracy()
        !! The end of P2, as with no samples, to a thousand tolerances of one step; who leaves the
        !! cart out says so. GSL, which steps to every sample, evaluates more often.
        type(bench_problem_t), allocatable, target :: problems(:)
        type(contestant_box_t), allocatable :: boxes(:)
        type(error_t), allocatable :: error
        character(name_length), parameter :: names(*) = [character(name_length) :: "gauss16", &
            "dop853", "gsl_rk8pd"]
        integer, parameter :: coordinates(*) = [1, 1, 2]
        real(dp) :: q(2), v(2)
        integer(i8) :: without
        integer :: i, k

        call read_problems(["P2"], problems, error)
        do i = 1, size(names)
            call new_contestants(names(i:i), boxes)
            k = findloc([(boxes(k)%item%set_by, k=1, size(boxes))], set_by_tolerance, 1)
            associate (one => boxes(k)%item)
                call one%prepare(problems(1), 1e-10_dp, error)
                call one%solve(problems(1), q, v, error)
                without = one%evaluations
                one%samples = 1000
                call one%prepare(problems(1), 1e-10_dp, error)
                call one%solve(problems(1), q, v, error)
                call assertFalse(allocated(error), names(i))
                call assertTrue(problems(1)%error_of(q, v) < 1e-7_dp, names(i))
                call assertEqual(coordinates(i), one%coordinates, names(i))
                if (i == 3) call assertTrue(one%evaluations > without, "steps to every sample")
            end associate
        end do
    end subroutine samples_cost_no_accuracy

    subroutine numbers_are_short()
        !! So many digits, and no more.
        call assertEqual("123", short(123.4_dp, 3))
        call assertEqual("12.3", short(12.34_dp, 3))
        call assertEqual("0.0312", short(0.03123_dp, 3))
        call assertEqual("1.2e-13", short(1.23e-13_dp, 2))
        call assertEqual("1e-6", short(1e-6_dp, 1))
        call assertEqual("0.00", short(0.0_dp, 3))
        call assertEqual("-0.50", short(-0.5_dp, 2))
        call assertEqual("1000", short(1000.0_dp, 3))
        call assertEqual("1.0", short(1.0_dp, 2))
        call assertEqual("-", short(not_known(), 3))
    end subroutine numbers_are_short

    subroutine tables_are_lines_and_objects()
        !! Words to the left, numbers to the right; in JSON all digits, and null for what is not
        !! known. More rows than there was room for. Where a line is too short, parts with the names
        !! of the rows before each.
        type(printed_table_t) :: table
        type(word_t), allocatable :: lines(:)
        integer :: i

        call table%begin("demo", "a title", [character(8) :: "method", "us", "count"])
        call table%add([word_cell("rk4"), number_cell(1.5_dp, 3), count_cell(12_i8)])
        call table%add([word_cell("gauss16"), number_cell(not_known(), 3), count_cell(1_i8)])
        call table%lines(huge(1), lines)
        call assertEqual(3, size(lines))
        call assertEqual("method     us  count", lines(1)%text)
        call assertEqual("rk4      1.50     12", lines(2)%text)
        call assertEqual("gauss16     -      1", lines(3)%text)
        call table%lines(20, lines)
        call assertEqual(3, size(lines), "20 columns")
        call table%lines(19, lines)
        call assertEqual(7, size(lines), "19 columns")
        call assertEqual("gauss16     -", lines(3)%text)
        call assertEqual("", lines(4)%text)
        call assertEqual("method   count", lines(5)%text)
        call assertEqual("rk4         12", lines(6)%text)
        call assertEqual('{"table": "demo", "method": "gauss16", "us": null, "count": 1}', &
                         table%object(2))
        do i = 1, 40
            call table%add([word_cell("more"), number_cell(real(i, dp), 3), count_cell(int(i, i8))])
        end do
        call assertEqual(42, table%rows)
        call table%lines(huge(1), lines)
        call assertEqual("rk4      1.50     12", lines(2)%text)
        call assertEqual("more     40.0     40", lines(43)%text)
    end subroutine tables_are_lines_and_objects

    subroutine tables_of_words_or_without_rows()
        !! All columns hold the names of rows; without rows there are the titles, to the left.
        type(printed_table_t) :: table
        type(word_t), allocatable :: lines(:)

        call table%begin("demo", "a title", [character(8) :: "method", "of"])
        call table%lines(huge(1), lines)
        call assertEqual(1, size(lines), "no rows")
        call assertEqual("method  of", lines(1)%text)
        call table%begin("demo", "a title", [character(8) :: "a", "b", "column_c", "column_d"])
        call table%lines(16, lines)
        call assertEqual(3, size(lines), "two parts")
        call assertEqual("a  b  column_c", lines(1)%text)
        call assertEqual("a  b  column_d", lines(3)%text, "the names of the rows in each")
        call table%begin("demo", "a title", [character(8) :: "method", "of"])
        call table%add([word_cell("rk4"), word_cell("Runge and Kutta")])
        call table%lines(huge(1), lines)
        call assertEqual(2, size(lines), "one row")
        call assertEqual("method  of", lines(1)%text)
        call assertEqual("rk4     Runge and Kutta", lines(2)%text)
    end subroutine tables_of_words_or_without_rows

    subroutine debug_builds_are_refused()
        !! With the remedy, as a mistake of usage.
        type(error_t), allocatable :: error

        call check_build(.true., error)
        call assertFalse(allocated(error), "no error: debug builds are refused")
        call check_build(.false., error)
        call assertTrue(allocated(error), "an error: debug builds are refused")
        if (.not. allocated(error)) return
        call assertEqual("bench: this build is not optimised, and its times would mislead; "// &
                         "'fpm run --profile release -- bench' builds one that is", error%message)
        call assertEqual(status_usage, error%status)
    end subroutine debug_builds_are_refused

    subroutine choices_are_checked()
        !! Names that do not exist come back with the nearest; good ones are taken.
        type(bench_options_t) :: choice
        type(error_t), allocatable :: error

        call choose([character(24) :: "bench", "precision", "--problems", "P1,P3", "--methods", &
                     "rk4,gsl_rk8pd", "--tolerances", "1e-6,1e-9", "--quick"])
        call assertFalse(allocated(error), "no error: choices are checked")
        call assertEqual(2, size(choice%problems))
        call assertTrue(choice%plan%quick .and. all(choice%methods == ["rk4      ", "gsl_rk8pd"]), &
                        "choice%plan%quick .and. all(choice%methods == ['rk4      ', 'gsl_rk...")
        call assertEqual([1e-6_dp, 1e-9_dp], choice%tolerances)
        call refused("--problems=P5", "unknown problem 'P5'; did you mean 'P1'?")
        call refused("--methods=gsl_rk8", "unknown method 'gsl_rk8'; did you mean 'gsl_rk4'?")
        call choose([character(48) :: "bench", "--systems=wedge, pendulum"])
        call assertFalse(allocated(error), message="two systems")
        call assertEqual("wedge pendulum", choice%systems(1)%text//" "//choice%systems(2)%text)
        call refused("--systems=pendlum", "unknown system 'pendlum'; did you mean 'pendulum'?")
        call refused("--methods="//repeat("m", 31), "unknown method '"//repeat("m", 31)// &
                     "'; there are", begins=.true.)
        call refused("--methods="//repeat("m", 32), "unknown method '"//repeat("m", 32)// &
                     "'; there are", begins=.true.)
        call refused("--methods="//repeat("m", 33), "unknown method '"//repeat("m", 33)// &
                     "'; there are", begins=.true.)
        call refused("--systems=pendulum,wedge,pendulum", "--systems: 'pendulum' is given "// &
                     "twice; names with commas between them: pendulum,wedge")
        call refused("step", "unknown part 'step'; did you mean 'steps'?")
        call refused("velocity", "unknown part 'velocity'; there are precision, samples, "// &
                     "steps, energy, "// &
                     "growth, modes, output, sweep")
        call refused("--output=", "option '--output' needs the name of a folder")
        call refused("--tolerances=0", "tolerance 0.0 is not allowed: a number from 1e-16 to "// &
                     "below 1 is needed")
        call refused("--tolerances=1e-3,nan", &
                     "--tolerances '1e-3,nan': 'nan': is not finite; a finite "// &
                     "number is needed")
        call refused("--tolerances=1-3", "--tolerances '1-3': '1-3': lacks the letter of its "// &
                     "exponent (1.5e-3, not 1.5-3); sums are not computed")
        call refused("--tolerances=1e-3e", "--tolerances '1e-3e': '1e-3e': a number is "// &
                     "needed; several have commas between them, as in 0.1,-2e-3")
        call refused("--tolerances=10^-3", "--tolerances '10^-3': '10^-3': a number is needed, "// &
                     "nothing is computed; write 0.001")
        call refused("--tolerances=", "--tolerances '': '': a number is needed; several have "// &
                     "commas between them, as in 0.1,-2e-3")
        call refused("steps"//repeat(" ", 28)//"x", "unknown part 'steps"//repeat(" ", 28)// &
                     "x'; did you mean 'steps'?")
        call refused("--tolerances=1e-9,1e-6", "tolerances must fall from each to the next: "// &
                     "1e-3,1e-6,1e-9")
    contains
        subroutine choose(texts)
            character(*), intent(in) :: texts(:)
            type(word_t) :: words(size(texts))
            type(command_line_t) :: line
            integer :: i

            do i = 1, size(texts)
                words(i)%text = trim(texts(i))
            end do
            call parse_words(words, options, line, error)
            if (.not. allocated(error)) call read_options(line, choice, error)
        end subroutine choose

        subroutine refused(word, message, begins)
            character(*), intent(in) :: word, message
            logical, intent(in), optional :: begins  !! the message goes on

            call choose([character(48) :: "bench", word])
            call assertTrue(allocated(error), message)
            if (.not. allocated(error)) return
            if (present(begins)) error%message = error%message(:len(message))
            call assertEqual(message, error%message)
        end subroutine refused
    end subroutine choices_are_checked
end module test_bench
