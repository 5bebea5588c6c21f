module test_graded_responses
    !! The table of tried responses in the docs is what the program says, and how often it errs.
    use funit, only: TestMethod, TestSuite, assertEqual, assertTrue
    use kept_texts, only: compare_with_kept
    use lagrangia_errors, only: error_t
    use lagrangia_files, only: read_whole_file
    use lagrangia_judgement, only: is_consequence, is_definition, is_right, &
                                   is_unreadable, is_wrong
    use lagrangia_text, only: to_text
    use lagrangia_version, only: is_optimised
    use student_sheets, only: grade_student_sheets
    use tried_responses, only: draw_derivations, draw_responses, group_t, responses_by_hand, &
                               responses_of_the_notes
    implicit none (type, external)
    private
    public :: graded_responses_suite

    character, parameter :: line_feed = new_line("a")
    character(*), parameter :: page = "docs/graded_responses.md"
    character(*), parameter :: written = "build/graded_responses.md"

contains

    function graded_responses_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("graded_responses")
        call suite%addTest(TestMethod("the_page_is_what_comes_out", the_page_is_what_comes_out))
    end function graded_responses_suite

    subroutine the_page_is_what_comes_out()
        !! None is misjudged, nine of ten slips are named, and the page has every row. Without
        !! optimisation a quarter of the random ones is drawn, and their rows are on the page.
        type(group_t) :: groups(7)
        type(error_t), allocatable :: error
        character(:), allocatable :: there
        integer :: i, n

        n = merge(200, 50, is_optimised())
        call responses_by_hand(groups(1))
        call responses_of_the_notes(groups(2))
        call draw_responses(.false., n, groups(3))
        call draw_responses(.true., n, groups(4))
        call draw_derivations(.true., n/2, groups(5))
        call draw_derivations(.false., n/2, groups(6))
        call grade_student_sheets(groups(7))
        do i = 1, size(groups)
            call assertEqual("", misjudged(groups(i)))
        end do
        call assertEqual(n, count(groups(3)%of%verdict == is_right), "rewritings are right")
        call assertEqual(n, count(groups(4)%of%verdict == is_wrong), "slips are wrong")
        call assertTrue(20*named(groups(4)) >= 19*n, to_text(named(groups(4)))//" are named")
        call assertEqual(count(groups(2)%of%verdict == is_wrong), named(groups(2)), "of the notes")
        if (is_optimised()) then
            call compare_with_kept(page, page_text(groups))
        else
            call read_whole_file(page, there, error)
            if (allocated(error)) there = ""
            do i = 1, size(groups)
                call assertTrue(index(there, rows_text(groups(i))) > 0, page//" has other rows "// &
                                "than the program; 'fpm test --profile release' makes it anew")
            end do
        end if
    end subroutine the_page_is_what_comes_out

    function misjudged(group) result(text)
        !! The statements whose verdict is not the one that they deserve.
        type(group_t), intent(in) :: group
        character(:), allocatable :: text
        integer :: i

        text = ""
        do i = 1, size(group%of)
            if (group%of(i)%verdict == group%of(i)%expected) cycle
            text = text//group%of(i)%system//": "//group%of(i)%statement//": "// &
                   group%of(i)%remark//"; "
        end do
    end function misjudged

    integer function named(group)
        !! Wrong ones with a change that mends them.
        type(group_t), intent(in) :: group
        integer :: i

        named = 0
        do i = 1, size(group%of)
            if (group%of(i)%verdict /= is_wrong) cycle
            if (index(group%of(i)%remark, "no single") == 0) named = named + 1
        end do
    end function named

    function page_text(groups) result(text)
        !! All of the page.
        type(group_t), intent(in) :: groups(7)
        character(:), allocatable :: text

        text = "# Every response that was tried"//line_feed//line_feed// &
            "Statements whose verdict is known, and what `lagrangia grade` says about each, "// &
            "failures included."//line_feed// &
            "A test makes this page anew and compares it (`fpm test -- --filter "// &
            "graded_responses`); where it differs, it"//line_feed// &
            "leaves the new one in `"//written//"`."//line_feed
        call add_group("Written by hand", "Each kind of equivalence and of slip once; the last "// &
                       "wrong ones have more than one slip.", groups(1))
        call add_group("Slips of the notes", "As they stand there (`lagrangia errata`), and as "// &
                       "derived from the notes' own L.", groups(2))
        call add_group("Right, in other words", "Statements that `describe` prints, rewritten "// &
                       "by a program.", groups(3))
        call add_group("One slip", "Statements that `describe` prints, with one change by a "// &
                       "program that makes them false.", groups(4))
        call add_group("A slip, and what follows from it", "The second line says in other "// &
                       "words what the first one says wrongly.", groups(5))
        call add_group("A slip, and another one", "The second line has a slip of its own.", &
                       groups(6))
        call add_group("Sheets as students write them", "Each line of "//"`test/"// &
                       "student_sheets.txt`, with the verdict that was worked out before.", &
                       groups(7))
    contains
        subroutine add_group(title, meaning, group)
            character(*), intent(in) :: title, meaning
            type(group_t), intent(in) :: group

            text = text//line_feed//"## "//title//line_feed//line_feed//meaning//line_feed// &
                to_text(size(group%of))//" responses, "// &
                to_text(count(group%of%verdict /= group%of%expected))//" misjudged"
            if (count(group%of%verdict == is_wrong) > 0) text = text//"; of "// &
                to_text(count(group%of%verdict == is_wrong))//" wrong ones "// &
                to_text(named(group))//" have their slip named"
            text = text//"."//line_feed//line_feed// &
                "| system | response | verdict | because |"//line_feed//"|---|---|---|---|"// &
                line_feed//rows_text(group)
        end subroutine add_group
    end function page_text

    pure function rows_text(group) result(text)
        !! A row for each response.
        type(group_t), intent(in) :: group
        character(:), allocatable :: text
        integer :: i

        text = ""
        do i = 1, size(group%of)
            text = text//"| "//group%of(i)%system//" | `"//in_a_cell(group%of(i)%statement)// &
                   "` | "//verdict_text(group%of(i)%verdict)//" | "// &
                   in_a_cell(group%of(i)%remark)//" |"//line_feed
        end do
    end function rows_text

    pure function in_a_cell(text) result(cell)
        !! Lines side by side, and no bar that would end the cell.
        character(*), intent(in) :: text
        character(:), allocatable :: cell
        integer :: i

        cell = ""
        do i = 1, len(text)
            select case (text(i:i))
            case (line_feed); cell = cell//"; "
            case ("|"); cell = cell//"\|"
            case default; cell = cell//text(i:i)
            end select
        end do
    end function in_a_cell

    pure function verdict_text(verdict) result(text)
        integer, intent(in) :: verdict
        character(:), allocatable :: text

        select case (verdict)
        case (is_right); text = "right"
        case (is_wrong); text = "wrong"
        case (is_unreadable); text = "unreadable"
        case (is_consequence); text = "follows"
        case (is_definition); text = "definition"
        case default; text = "?"
        end select
    end function verdict_text
end module test_graded_responses
