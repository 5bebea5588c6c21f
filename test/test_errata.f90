module test_errata
    !! The slips in the lecture notes: every one is listed, quoted word for word, and its numbers
    !! are what it claims.
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertFalse, assertTrue
    use lagrangia_course_table, only: course_of_the_notes, statement_t
    use lagrangia_errata_command, only: slip_report
    use lagrangia_errata_ledger, only: kind_lecture, kind_none, kind_scan, kind_terminology, &
                                       line_length, quote_t, slip_t, slips_of_the_notes
    use lagrangia_errors, only: error_t
    use lagrangia_principles, only: principle_names
    use lagrangia_report, only: report_t
    use lagrangia_text, only: to_text
    use page_rows, only: page_once
    implicit none (type, external)
    private
    public :: errata_suite

    character(*), parameter :: lines_of_the_notes = "data/reference/lecture_notes.txt"

    type :: line_t
        character(2) :: scan = ""
        integer :: line = 0
        character(500) :: text = ""
        logical :: quoted = .false.
    end type line_t

contains

    function errata_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("errata")
        call suite%addTest(TestMethod("all_are_listed", all_are_listed))
        call suite%addTest(TestMethod("quotes_stand_in_the_notes", quotes_stand_in_the_notes))
        call suite%addTest(TestMethod("places_are_those_of_the_quotes", &
                                      places_are_those_of_the_quotes))
        call suite%addTest(TestMethod("readings_have_the_signs_of_the_quotes", &
                                      readings_have_the_signs_of_the_quotes))
        call suite%addTest(TestMethod("numbers_come_out", numbers_come_out))
    end function errata_suite

    subroutine all_are_listed()
        !! E1 to E32, complete, in the part where each belongs, no line cut off.
        type(slip_t), allocatable :: slips(:)
        integer :: k

        allocate (slips, source=slips_of_the_notes())
        call assertEqual(32, size(slips))
        do k = 1, size(slips)
            associate (slip => slips(k))
                call assertEqual("E"//to_text(k), trim(slip%id))
                call assertTrue(slip%subject /= "" .and. slip%reads /= "", slip%id)
                call assertTrue(slip%derived /= "" .and. slip%quotes(1)%scan /= "", slip%id)
                call assertTrue(all(len_trim(slip%quotes%text) < line_length), slip%id//"quotes")
                call assertTrue(len_trim(slip%reads) < 105, slip%id//"reads")
                call assertTrue(len_trim(slip%derived) < 105, slip%id//"derived")
                call assertTrue(len_trim(slip%effect) < 105, slip%id//"effect")
                call assertTrue(len_trim(slip%subject) < len(slip%subject), slip%id//"subject")
            end associate
        end do
        call assertEqual(" E1 E2 E7 E9 E10 E15 E16 E21 E23", part(kind_lecture))
        call assertEqual(" E3 E4 E5 E8 E12 E13 E17 E18 E19 E20 E22 E24 E25 E26 E27 E28 E29"// &
                         " E30 E31 E32", part(kind_scan))
        call assertEqual(" E6 E14", part(kind_terminology))
        call assertEqual(" E11", part(kind_none))
    contains
        pure function part(kind) result(ids)
            character(*), intent(in) :: kind
            character(:), allocatable :: ids
            integer :: i

            ids = ""
            do i = 1, size(slips)
                if (slips(i)%kind == kind) ids = ids//" "//trim(slips(i)%id)
            end do
        end function part
    end subroutine all_are_listed

    subroutine quotes_stand_in_the_notes()
        !! Word for word, on the line that is named; `.ci/check_quotes.sh` compares those lines with
        !! the notes themselves, which are not in this project. No line is there for nothing.
        type(slip_t), allocatable :: slips(:)
        type(line_t), allocatable :: lines(:)
        type(statement_t), allocatable :: course(:)
        character(16), allocatable :: names(:)
        type(report_t) :: page
        type(error_t), allocatable :: error
        integer :: i, k

        call read_lines(lines)
        if (anyExceptions()) return
        allocate (slips, source=slips_of_the_notes())
        do k = 1, size(slips)
            do i = 1, count(slips(k)%quotes%scan /= "")
                call look_for(slips(k)%quotes(i), slips(k)%id)
                call look_elsewhere(slips(k)%quotes(i), slips(k))
            end do
            if (slips(k)%elsewhere%scan /= "") call look_for(slips(k)%elsewhere, slips(k)%id)
        end do
        allocate (course, source=course_of_the_notes())
        do i = 1, size(course)
            lines%quoted = lines%quoted .or. (lines%scan == course(i)%scan .and. &
                                              lines%line >= course(i)%line .and. &
                                              lines%line <= course(i)%last .and. &
                                              index(lines%text, trim(course(i)%quote)) > 0)
        end do
        allocate (names, source=principle_names())
        do i = 1, size(names)
            call page_once(trim(names(i)), page, error)
            do k = 1, size(page%citations)
                associate (cited => page%citations(k))
                    lines%quoted = lines%quoted .or. (lines%scan == cited%scan .and. &
                                                      lines%line == cited%line .and. &
                                                      index(lines%text, trim(cited%text)) > 0)
                end associate
            end do
        end do
        do i = 1, size(lines)
            call assertTrue(lines(i)%quoted, "nobody quotes "//trim(lines(i)%text))
        end do
    contains
        subroutine look_for(quote, id)
            type(quote_t), intent(in) :: quote
            character(*), intent(in) :: id
            integer :: j
            logical :: found

            found = .false.
            do j = 1, size(lines)
                if (lines(j)%scan /= quote%scan .or. lines(j)%line /= quote%line) cycle
                if (index(lines(j)%text, trim(quote%text)) == 0) cycle
                found = .true.
                lines(j)%quoted = .true.
            end do
            call assertTrue(found, id//": "//trim(quote%text)//" is not on line "// &
                            to_text(quote%line)//" of "//quote%scan)
        end subroutine look_for

        subroutine look_elsewhere(quote, slip)
            !! Where a quote stands again, the slip names that line too.
            type(quote_t), intent(in) :: quote
            type(slip_t), intent(in) :: slip
            integer :: j

            do j = 1, size(lines)
                if (lines(j)%scan /= quote%scan) cycle
                if (index(lines(j)%text, trim(quote%text)) == 0) cycle
                call assertTrue(any(slip%quotes%scan == quote%scan .and. &
                                    slip%quotes%line == lines(j)%line), slip%id//": "// &
                                trim(quote%text)//" is on line "//to_text(lines(j)%line))
            end do
        end subroutine look_elsewhere
    end subroutine quotes_stand_in_the_notes

    subroutine read_lines(lines)
        !! The committed lines of the notes: scan, line, text.
        type(line_t), allocatable, intent(out) :: lines(:)
        type(line_t) :: line
        character(520) :: row
        integer :: unit, status, first, second

        allocate (lines(0))
        open (newunit=unit, file=lines_of_the_notes, status="old", action="read", iostat=status)
        call assertEqual(0, status, lines_of_the_notes)
        if (status /= 0) return
        do
            read (unit, "(a)", iostat=status) row
            if (status /= 0) exit
            if (row(1:1) == "#") cycle
            first = index(row, " ")
            second = first + index(row(first + 1:), " ")
            line%scan = row(:first)
            read (row(first:second), *) line%line
            line%text = row(second + 1:)
            lines = [lines, line]
        end do
        close (unit)
        call assertEqual(119, size(lines), lines_of_the_notes)
    end subroutine read_lines

    subroutine places_are_those_of_the_quotes()
        !! Made from the quotes, each line once, ascending.
        type(slip_t), allocatable :: slips(:)

        allocate (slips, source=slips_of_the_notes())
        call assertEqual("I, lines 140, 142, 146, 150, 152, 154", slips(1)%place())
        call assertEqual("I, lines 138, 140, 152, 154", slips(5)%place())
        call assertEqual("I, lines 3, 30, 36, 37, 38, 41", slips(13)%place())
        call assertEqual("II, lines 113, 115", slips(21)%place())
    end subroutine places_are_those_of_the_quotes

    subroutine readings_have_the_signs_of_the_quotes()
        !! In our letters the first quote, or all of them, have the same pluses and minuses in the
        !! same order; hyphens and arrows are none, "the difference between" is one.
        type(slip_t), allocatable :: slips(:)
        character(:), allocatable :: reading, quotes
        integer :: i, k

        call assertEqual("+--", signs("a + b -> -c, time-independent - d"))
        allocate (slips, source=slips_of_the_notes())
        do k = 1, size(slips)
            reading = signs(trim(slips(k)%reads))
            quotes = ""
            do i = 1, size(slips(k)%quotes)
                quotes = quotes//signs(trim(slips(k)%quotes(i)%text))
            end do
            call assertTrue(reading == signs(trim(slips(k)%quotes(1)%text)) .or. &
                            reading == quotes, slips(k)%id//" "//reading//" is not "//quotes)
        end do
    contains
        pure function signs(text) result(found)
            character(*), intent(in) :: text
            character(:), allocatable :: found
            character(*), parameter :: letters = "abcdefghijklmnopqrstuvwxyz"
            character(len(text) + 2) :: padded
            integer :: j

            padded = " "//text
            found = ""
            do j = 2, len(text) + 1
                if (index(padded(j:), "difference between") == 1) found = found//"-"
                if (scan(padded(j:j), "+-") == 0 .or. padded(j:j + 1) == "->") cycle
                if (scan(padded(j - 1:j - 1), letters)*scan(padded(j + 1:j + 1), letters) > 0) cycle
                found = found//padded(j:j)
            end do
        end function signs
    end subroutine readings_have_the_signs_of_the_quotes

    subroutine numbers_come_out()
        !! What is derived holds, what is written fails; some letters and dates have no numbers.
        type(slip_t), allocatable :: slips(:)
        type(report_t) :: report
        type(error_t), allocatable :: error
        character(*), parameter :: without = " E5 E8 E13 E17 E19 E22 E23 E24 E26 E27 "// &
                                   "E28 E29 E30 E31 E32 "
        integer :: k

        allocate (slips, source=slips_of_the_notes())
        do k = 1, size(slips)
            call slip_report(slips(k), report, error)
            call assertFalse(allocated(error), slips(k)%id)
            call assertEqual(0, report%broken(), slips(k)%id)
            call assertTrue((size(report%rows) == 0) .eqv. &
                            index(without, " "//trim(slips(k)%id)//" ") > 0, slips(k)%id)
            if (slips(k)%kind == kind_terminology .or. size(report%rows) == 0) cycle
            call assertTrue(any(report%rows%control), slips(k)%id//"as written it fails")
        end do
        call rows("E9 ", 6, 2)
        call rows("E10", 6, 2)
        call rows("E11", 5, 1)
        call rows("E12", 2, 1)
    contains
        subroutine rows(id, all_of_them, controls)
            character(3), intent(in) :: id
            integer, intent(in) :: all_of_them, controls

            call slip_report(slips(findloc(slips%id == id, .true., 1)), report, error)
            call assertEqual(all_of_them, size(report%rows), id//" rows")
            call assertEqual(controls, count(report%rows%control), id//" controls")
        end subroutine rows
    end subroutine numbers_come_out
end module test_errata
