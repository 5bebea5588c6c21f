module funit_runner
    !! Run the tests and print what happened, as pFUnit prints it.
    use, intrinsic :: iso_fortran_env, only: error_unit, output_unit
    use funit_exceptions, only: anyExceptions, clear_exceptions, exception_count, exception_text
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
        !! Run the tests of a suite, or with `--filter text` those whose names contain the text.
        procedure(load_tests_i) :: load_tests
        logical :: successful
        type(TestSuite) :: suite
        character(:), allocatable :: pattern, report
        integer :: i, ran, failed, column, start, finish, rate

        call read_options(pattern)
        report = ""
        ran = 0
        failed = 0
        column = 0
        call system_clock(start)
        suite = load_tests()
        do i = 1, size(suite%tests)
            if (index(suite%tests(i)%name, pattern) == 0) cycle
            call mark(".", column)
            ran = ran + 1
            call suite%tests(i)%method()
            if (anyExceptions()) then
                call mark("F", column)
                failed = failed + 1
                call describe(suite%tests(i)%name, report)
            end if
            call clear_exceptions()
        end do
        call system_clock(finish, rate)
        write (output_unit, "(/, 'Time: ', 1x, f12.3, 1x, 'seconds', /, '  ')") &
            real(finish - start)/real(rate)
        write (output_unit, "(a)", advance="no") report
        call summarize(ran, failed)
        successful = failed == 0
    end function run

    subroutine read_options(pattern)
        !! Read the command line: nothing, `-f text` or `--filter text`.
        character(:), allocatable, intent(out) :: pattern

        pattern = argument(2)
        if (command_argument_count() == 0) return
        if (command_argument_count() == 2) then
            if (any(argument(1) == [character(8) :: "-f", "--filter"])) return
        end if
        write (error_unit, "(a)") "funit: the only option is --filter text"
        stop 2, quiet=.true.
    end subroutine read_options

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

    subroutine mark(sign, column)
        !! Print one sign, and break the line when it is full.
        character, intent(in) :: sign
        integer, intent(inout) :: column  !! signs in this line so far

        write (output_unit, "(a)", advance="no") sign
        column = column + 1
        if (column < columns) return
        write (output_unit, "()")
        column = 0
    end subroutine mark

    subroutine describe(name, report)
        !! Add the failures of the test `name` to the report.
        character(*), intent(in) :: name
        character(:), allocatable, intent(inout) :: report
        character(*), parameter :: nl = new_line("a")
        integer :: i

        do i = 1, exception_count
            report = report//"Failure"//nl//" in: "//nl//name//nl &
                     //"  Location: "//nl//"[<unknown location>]"//nl &
                     //exception_text(i)//nl//"  "//nl
        end do
    end subroutine describe

    subroutine summarize(ran, failed)
        !! Print the last lines.
        integer, intent(in) :: ran, failed

        if (failed > 0) then
            write (output_unit, "(a)") " FAILURES!!!"
            write (output_unit, "(2(a, i0), a, /, a)") "Tests run: ", ran, ", Failures: ", failed, &
                ", Errors: 0", ", Disabled: 0"
        else
            write (output_unit, "(a)") " OK"
            write (output_unit, "(a, i0, 3a)") " (", ran, " test", repeat("s", min(1, ran/2)), ")"
        end if
    end subroutine summarize
end module funit_runner
