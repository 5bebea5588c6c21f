module funit_runner
    !! Run the tests and print what happens, when it happens, in pFUnit's words.
    use, intrinsic :: iso_fortran_env, only: error_unit, output_unit
    use funit_crashes, only: watch_for_crashes
    use funit_exceptions, only: anyExceptions, clear_exceptions, exception_count, exception_place, &
                                exception_text
    use funit_suites, only: TestMethod, TestSuite, test_i
    implicit none (type, external)
    private
    public :: finalize, initialize, run, stub

    abstract interface
        function load_tests_i() result(suite)
            !! Collect the suites.
            import :: TestSuite
            implicit none (type, external)
            type(TestSuite) :: suite
        end function load_tests_i
    end interface

    integer, parameter :: columns = 80  !! marks in a line
    integer :: column = 0               !! marks in this line so far
    logical :: verbose = .false.        !! names instead of marks
    character(:), allocatable :: running  !! the test's name

contains

    subroutine initialize(extra)
        !! Prepare: do what `extra` does.
        procedure(test_i), optional :: extra

        if (present(extra)) call extra()
    end subroutine initialize

    subroutine stub()
        !! Do nothing, where `initialize` or `finalize` has nothing to do.
    end subroutine stub

    subroutine finalize(extra, successful)
        !! Do what `extra` does; stop with status 2 unless the run was successful.
        procedure(test_i) :: extra
        logical, intent(in) :: successful

        call extra()
        if (successful) return
        write (output_unit, "(a)") "*** Encountered 1 or more failures/errors during testing ***"
        stop 2
    end subroutine finalize

    function run(load_tests) result(successful)
        !! Run the tests of a suite, or those whose names contain a text: see `read_options`.
        procedure(load_tests_i) :: load_tests
        logical :: successful
        type(TestSuite) :: suite
        character(:), allocatable :: pattern, failures
        integer :: i, ran, failed, start, finish, rate

        call read_options(pattern, verbose)
        failures = ""
        ran = 0
        failed = 0
        column = 0
        call system_clock(start)
        suite = load_tests()
        call watch_for_crashes(tell)
        do i = 1, size(suite%tests)
            if (index(suite%tests(i)%name, pattern) == 0) cycle
            ran = ran + 1
            running = suite%tests(i)%name
            if (verbose) call put("Start: <"//running//">")
            if (.not. verbose) call mark(".")
            call perform(suite%tests(i))
            if (anyExceptions()) then
                failed = failed + 1
                failures = failures//"    "//running//new_line("a")
                if (.not. verbose) call mark("F")
                call print_failures()
            end if
            call clear_exceptions()
            if (verbose) call put("  end: <"//running//">")
            deallocate (running)
        end do
        if (ran == 0) call refuse("no test has '"//pattern//"' in its name")
        call system_clock(finish, rate)
        write (output_unit, "(ss, /, 'Time: ', 1x, f12.3, 1x, 'seconds', /, '  ')") &
            real(finish - start)/real(rate)
        if (failed > 0) write (output_unit, "(a)", advance="no") "Failed:"//new_line("a")//failures
        call summarize(ran, failed)
        successful = failed == 0
    end function run

    subroutine perform(test)
        !! Neither the test nor `tear_down` runs where `set_up` has failed.
        type(TestMethod), intent(in) :: test

        if (associated(test%set_up)) call test%set_up()
        if (anyExceptions()) return
        call test%method()
        if (associated(test%tear_down)) call test%tear_down()
    end subroutine perform

    subroutine tell(what)
        !! The program ends: say which test was running and what it had recorded, if one was.
        character(*), intent(in) :: what

        if (.not. allocated(running)) return
        call put("")
        call put("Error in "//running//": "//what)
        call print_failures()
        deallocate (running)
    end subroutine tell

    subroutine read_options(pattern, aloud)
        !! Read the command line: `-f TEXT` or `--filter TEXT` for the tests whose names contain the
        !! text, `-v`, `--verbose`, `-d` or `--debug` for their names as they start and end.
        character(:), allocatable, intent(out) :: pattern
        logical, intent(out) :: aloud
        integer :: i

        pattern = ""
        aloud = .false.
        i = 1
        do while (i <= command_argument_count())
            select case (argument(i))
            case ("-v", "--verbose", "-d", "--debug")
                aloud = .true.
            case ("-f", "--filter")
                i = i + 1
                pattern = argument(i)
                if (pattern == "") call refuse("--filter needs a text")
            case default
                call refuse("unknown option '"//argument(i)// &
                            "'; there are --filter TEXT and --verbose")
            end select
            i = i + 1
        end do
    end subroutine read_options

    subroutine refuse(why)
        !! Stop with status 2.
        character(*), intent(in) :: why

        write (error_unit, "(a)") "funit: "//why
        stop 2, quiet=.true.
    end subroutine refuse

    function argument(i) result(value)
        !! Argument `i` of the command line; empty beyond the last.
        integer, intent(in) :: i
        character(:), allocatable :: value
        integer :: length

        length = 0
        if (i <= command_argument_count()) call get_command_argument(i, length=length)
        allocate (character(length) :: value)
        if (length > 0) call get_command_argument(i, value)
    end function argument

    subroutine mark(sign)
        !! Print one sign, and break the line when it is full.
        character, intent(in) :: sign

        write (output_unit, "(a)", advance="no") sign
        column = column + 1
        if (column < columns) return
        write (output_unit, "()")
        column = 0
    end subroutine mark

    subroutine put(text)
        !! Print a line that a crash cannot take back.
        character(*), intent(in) :: text

        write (output_unit, "(a)") text
        flush (output_unit)
    end subroutine put

    subroutine print_failures()
        !! What the assertions of the running test have recorded, and where.
        integer :: i

        if (exception_count > 0 .and. column > 0) call put("")
        column = 0
        do i = 1, exception_count
            call put("Failure in: "//running)
            call put("  Location: "//exception_place(i))
            call put(exception_text(i))
            call put("  ")
        end do
    end subroutine print_failures

    subroutine summarize(ran, failed)
        !! Print the last lines.
        integer, intent(in) :: ran, failed

        if (failed > 0) then
            write (output_unit, "(a)") " FAILURES!!!"
            write (output_unit, "(ss, 2(a, i0), a, /, a)") "Tests run: ", ran, ", Failures: ", &
                failed, ", Errors: 0", ", Disabled: 0"
        else
            write (output_unit, "(a)") " OK"
            write (output_unit, "(ss, a, i0, 3a)") " (", ran, " test", &
                repeat("s", min(1, ran/2)), ")"
        end if
    end subroutine summarize
end module funit_runner
