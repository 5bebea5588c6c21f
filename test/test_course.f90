module test_course
    !! The lecture's notes line by line: no line is left out, every quote stands where the table
    !! says, every command that is named can be typed; pages of `principle` are in this order.
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertFalse, assertTrue
    use lagrangia_catalogue, only: built_in, nth_system
    use lagrangia_command_line, only: command_line_t, parse_words
    use lagrangia_course_command, only: next_command
    use lagrangia_course_table, only: course_of_the_notes, statement_t
    use lagrangia_description, only: description_t
    use lagrangia_errata_ledger, only: slip_t, slips_of_the_notes
    use lagrangia_errors, only: error_t
    use lagrangia_files, only: read_whole_file
    use lagrangia_principles, only: find_first_line, principle_names
    use lagrangia_registry, only: check_line, commands, options
    use lagrangia_report, only: citation_t, report_t
    use lagrangia_system, only: system_t
    use lagrangia_system_lines, only: line_of_system
    use lagrangia_text, only: join, to_text, word_t
    use lagrangia_vocabulary, only: words_of
    use page_rows, only: page_once
    implicit none (type, external)
    private
    public :: course_suite

    character(*), parameter :: notes = "data/reference/lecture_notes.txt"

    !! Lines of the scans' text with a letter or a digit on them: `.ci/check_quotes.sh` counts them
    !! in the scans.
    integer, parameter :: first(*) = [3, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, &
        20, 21, 22, 28, 30, 31, 32, 34, 36, 37, 38, 41, 43, 45, 47, 48, 49, 50, 51, 53, 54, 58, &
        59, 60, 62, 64, 65, 66, 67, 68, 69, 71, 73, 75, 76, 78, 80, 82, 84, 86, 88, 90, 91, 93, &
        95, 97, 99, 101, 103, 105, 107, 109, 111, 113, 115, 116, 118, 119, 121, 122, 124, 126, &
        128, 129, 130, 132, 134, 136, 138, 140, 142, 144, 146, 148, 150, 152, 154, 156, 158, &
        160, 162, 164]
    integer, parameter :: second(*) = [3, 5, 6, 8, 10, 12, 14, 16, 18, 20, 22, 24, 26, 28, 30, &
        32, 34, 36, 38, 40, 42, 44, 46, 48, 50, 52, 54, 56, 58, 60, 62, 65, 66, 68, 70, 72, 74, &
        78, 81, 83, 85, 87, 89, 93, 95, 97, 99, 101, 103, 105, 107, 109, 111, 113, 115]

contains

    function course_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("course")
        call suite%addTest(TestMethod("every_line_is_there", every_line_is_there))
        call suite%addTest(TestMethod("quotes_are_word_for_word", quotes_are_word_for_word))
        call suite%addTest(TestMethod("commands_can_be_typed", commands_can_be_typed))
        call suite%addTest(TestMethod("errata_are_of_these_lines", errata_are_of_these_lines))
        call suite%addTest(TestMethod("what_is_not_shown", what_is_not_shown))
        call suite%addTest(TestMethod("pages_quote_their_lines", pages_quote_their_lines))
        call suite%addTest(TestMethod("in_the_lectures_order", in_the_lectures_order))
        call suite%addTest(TestMethod("systems_have_their_line", systems_have_their_line))
    end function course_suite

    subroutine errata_are_of_these_lines()
        !! A slip that a statement refers to is quoted from its lines.
        type(statement_t), allocatable :: course(:)
        type(slip_t), allocatable :: slips(:)
        integer :: at, i, k, named

        allocate (course, source=course_of_the_notes())
        allocate (slips, source=slips_of_the_notes())
        named = 0
        do i = 1, size(course)
            at = index(course(i)%shows, "errata E")
            if (at == 0) cycle
            named = named + 1
            do k = size(slips), 1, -1
                if (slips(k)%id == course(i)%shows(at + 7:at + 9)) exit
            end do
            call assertTrue(k > 0, course(i)%shows)
            if (anyExceptions()) return
            call assertTrue(any(slips(k)%quotes%scan == course(i)%scan .and. &
                                slips(k)%quotes%line >= course(i)%line .and. &
                                slips(k)%quotes%line <= course(i)%last), &
                            course(i)%scan//", line "//to_text(course(i)%line)//": "//slips(k)%id)
        end do
        call assertEqual(26, named, message="slips are named")
    end subroutine errata_are_of_these_lines

    subroutine every_line_is_there()
        !! In order, and each in one statement or in several that begin on it.
        type(statement_t), allocatable :: course(:)
        integer :: i

        allocate (course, source=course_of_the_notes())
        do i = 1, size(first)
            call assertTrue(any(course%scan == "I" .and. course%line <= first(i) .and. &
                                course%last >= first(i)), "I, line "//to_text(first(i)))
        end do
        do i = 1, size(second)
            call assertTrue(any(course%scan == "II" .and. course%line <= second(i) .and. &
                                course%last >= second(i)), "II, line "//to_text(second(i)))
        end do
        do i = 1, size(course)
            associate (it => course(i))
                call assertTrue(it%last >= it%line, to_text(it%line))
                if (it%scan == "I") call assertTrue(any(first == it%line), to_text(it%line))
                if (it%scan == "II") call assertTrue(any(second == it%line), to_text(it%line))
                if (i == 1) cycle
                if (course(i - 1)%scan /= it%scan) cycle
                call assertTrue(it%line > course(i - 1)%last .or. &
                                it%line == course(i - 1)%line, "in order: "//to_text(it%line))
            end associate
        end do
        call assertEqual(count(course%scan == "I") + count(course%scan == "II"), size(course))
    end subroutine every_line_is_there

    subroutine quotes_are_word_for_word()
        !! On one of the lines of the statement.
        type(statement_t), allocatable :: course(:)
        type(error_t), allocatable :: error
        character(:), allocatable :: text, row
        logical, allocatable :: found(:)
        integer :: first_blank, i, line, next, second_blank

        call read_whole_file(notes, text, error)
        call assertFalse(allocated(error), notes)
        if (anyExceptions()) return
        allocate (course, source=course_of_the_notes())
        allocate (found(size(course)))
        found = .false.
        do while (text /= "")
            next = index(text, new_line("a"))
            row = text(:next - 1)
            text = text(next + 1:)
            if (index(row, "I") /= 1) cycle
            first_blank = index(row, " ")
            second_blank = first_blank + index(row(first_blank + 1:), " ")
            read (row(first_blank:second_blank), *) line
            do i = 1, size(course)
                if (course(i)%scan /= row(:first_blank)) cycle
                if (course(i)%line > line .or. course(i)%last < line) cycle
                found(i) = found(i) .or. index(row(second_blank:), trim(course(i)%quote)) > 0
            end do
        end do
        do i = 1, size(course)
            call assertTrue(found(i) .and. course(i)%quote /= "", "quote: "//course(i)%quote)
            call assertTrue(len_trim(course(i)%quote) < len(course(i)%quote), "cut off")
            call assertTrue(len_trim(course(i)%says) < len(course(i)%says) .and. &
                            course(i)%says /= "", "cut off: "//course(i)%says)
            call assertTrue(len_trim(course(i)%shows) < len(course(i)%shows), "cut off")
            call assertTrue(len_trim(course(i)%nothing) < len(course(i)%nothing), "cut off")
        end do
    end subroutine quotes_are_word_for_word

    subroutine commands_can_be_typed()
        !! The command line takes them, and what they name is there.
        type(statement_t), allocatable :: course(:)
        character(:), allocatable :: rest, command
        integer :: i, typed

        allocate (course, source=course_of_the_notes())
        typed = 0
        do i = 1, size(course)
            rest = trim(course(i)%shows)
            do while (rest /= "")
                call next_command(rest, command)
                call type_it(command)
                typed = typed + 1
            end do
        end do
        call assertTrue(typed > size(course), "commands in all: "//to_text(typed))
    end subroutine commands_can_be_typed

    subroutine type_it(text)
        !! One command with its arguments and options.
        character(*), intent(in) :: text
        type(command_line_t) :: line
        type(error_t), allocatable :: error
        type(word_t), allocatable :: typed(:), known(:)
        character(:), allocatable :: kind, kinds
        integer :: at, i, k, which
        logical :: found

        allocate (typed(count([(text(i:i) == " ", i=1, len(text))]) + 1))
        call split(text, typed)
        call parse_words(typed, options, line, error)
        call assertFalse(allocated(error), text)
        if (allocated(error)) return
        call check_line(line, which, error)
        call assertFalse(allocated(error), text)
        if (allocated(error)) return
        do i = 1, size(line%arguments)
            found = .false.
            kinds = trim(commands(which)%takes)//" "
            do while (kinds /= "")
                at = index(kinds, " ")
                kind = kinds(:at - 1)
                kinds = kinds(at + 1:)
                call words_of(kind, known)
                do k = 1, size(known)
                    found = found .or. known(k)%text == line%arguments(i)%text
                end do
            end do
            call assertTrue(found, "lagrangia "//text)
        end do
    end subroutine type_it

    subroutine split(text, words)
        !! At its blanks.
        character(*), intent(in) :: text
        type(word_t), intent(inout) :: words(:)
        character(:), allocatable :: rest
        integer :: i

        rest = text//" "
        do i = 1, size(words)
            words(i)%text = rest(:index(rest, " ") - 1)
            rest = rest(index(rest, " ") + 1:)
        end do
    end subroutine split

    subroutine what_is_not_shown()
        !! A reason, or a command; never both, never neither.
        type(statement_t), allocatable :: course(:)
        integer :: i

        allocate (course, source=course_of_the_notes())
        do i = 1, size(course)
            call assertTrue(course(i)%nothing == "" .neqv. course(i)%shows == "", course(i)%says)
        end do
    end subroutine what_is_not_shown

    subroutine pages_quote_their_lines()
        !! Each line that a page quotes is in a statement that names it.
        character(16), allocatable :: names(:)
        type(report_t) :: report
        type(error_t), allocatable :: error
        integer :: i

        allocate (names, source=principle_names())
        do i = 1, size(names)
            call page_once(trim(names(i)), report, error)
            call assertFalse(allocated(error), trim(names(i)))
            if (anyExceptions()) return
            call course_has(names(i), report%citations)
        end do
    end subroutine pages_quote_their_lines

    subroutine course_has(name, citations)
        !! Each of these lines lies in a statement of the course that names this page.
        character(*), intent(in) :: name
        type(citation_t), intent(in) :: citations(:)
        type(statement_t), allocatable :: course(:)
        character(:), allocatable :: rest, command
        logical, allocatable :: named(:), there(:)
        character(2) :: scan
        integer :: i, line

        allocate (course, source=course_of_the_notes())
        allocate (named(size(course)))
        do i = 1, size(course)
            named(i) = .false.
            rest = trim(course(i)%shows)
            do while (rest /= "")
                call next_command(rest, command)
                named(i) = named(i) .or. command == "principle "//trim(name)
            end do
        end do
        call find_first_line(name, scan, line)
        do i = 1, size(citations)
            there = named .and. course%scan == citations(i)%scan .and. &
                    course%line <= citations(i)%line .and. course%last >= citations(i)%line
            call assertTrue(any(there), trim(name)//": the course names it at "// &
                            trim(citations(i)%scan)//" "//to_text(citations(i)%line))
            if (i > 1) cycle
            call assertTrue(any(there .and. course%scan == scan .and. course%line == line), &
                            trim(name)//": its first quote is on the line of the list")
        end do
    end subroutine course_has

    subroutine in_the_lectures_order()
        !! The list's lines are those at which `course` comes to a page first, one behind the other.
        type(statement_t), allocatable :: course(:)
        character(16), allocatable :: names(:)
        character(:), allocatable :: rest, command, met
        character(2) :: scan
        integer :: i, line

        allocate (names, source=principle_names())
        allocate (course, source=course_of_the_notes())
        met = ""
        do i = 1, size(course)
            rest = trim(course(i)%shows)
            do while (rest /= "")
                call next_command(rest, command)
                if (index(command, "principle ") /= 1) cycle
                command = command(len("principle ") + 1:)
                if (index(" "//met//" ", " "//command//" ") > 0) cycle
                met = trim(adjustl(met//" "//command))
                call find_first_line(command, scan, line)
                call assertEqual(course(i)%scan, scan, command//": lecture")
                call assertEqual(course(i)%line, line, command//": line")
            end do
        end do
        call assertEqual(met, join(names, " "), "the pages in the order of the course")
        call find_first_line("actions", scan, line)
        call assertEqual(0, line, "no such page")
    end subroutine in_the_lectures_order

    subroutine systems_have_their_line()
        !! Each system of the lectures quotes a statement, whole, of the lecture that its source
        !! names; the statements are compared with the notes above.
        character(*), parameter :: first = "Phys 601, 1 September 2011: "
        type(statement_t), allocatable :: course(:)
        class(system_t), allocatable :: system
        type(description_t) :: d
        character(:), allocatable :: quote, text
        integer :: i

        allocate (course, source=course_of_the_notes())
        do i = 1, built_in
            call nth_system(i, system)
            call system%describe(d)
            text = line_of_system(trim(d%name))
            if (index(d%source, first) == 1) then
                call assertEqual(1, index(text, "the notes, I "), d%name)
            else
                call assertEqual(1, index(d%source, "Hamilton's Principle: "), d%name)
                call assertEqual(1, index(text, "the notes, II "), d%name)
            end if
            quote = text(index(text, ": ") + 2:)
            call assertTrue(quote /= "" .and. any(course%quote == quote), text)
        end do
        call assertEqual("", line_of_system("spring_pendulum"), "a system of one's own")
        call assertEqual("the notes, I 134-136: m_2 l \dot{x} \dot{\theta} \cos \theta "// &
                         "+ m_2 q l \cos \theta", line_of_system("cart_pendulum"))
        call assertEqual("the notes, II 72: contains time explicitly: rheonomic", &
                         line_of_system("rotating_hoop"))
    end subroutine systems_have_their_line
end module test_course
