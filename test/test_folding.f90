module test_folding
    !! Lines that are wider than a terminal: nothing is lost, and columns stay below each other.
    use funit, only: TestMethod, TestSuite, assertEqual, assertTrue
    use lagrangia_folding, only: columns_of, folded
    use lagrangia_kinds, only: dp
    use lagrangia_text, only: word_t
    use random_states, only: restart_random, uniform
    implicit none (type, external)
    private
    public :: folding_suite

    character(*), parameter :: bar = char(195)//char(169)  !! one letter, two bytes

contains

    function folding_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("folding")
        call suite%addTest(TestMethod("what_fits_stays", what_fits_stays))
        call suite%addTest(TestMethod("a_text_goes_on_below_itself", a_text_goes_on_below_itself))
        call suite%addTest(TestMethod("cells_stay_together", cells_stay_together))
        call suite%addTest(TestMethod("a_long_word_stays_whole", a_long_word_stays_whole))
        call suite%addTest(TestMethod("letters_count_once", letters_count_once))
        call suite%addTest(TestMethod("no_word_is_lost", no_word_is_lost, setUp=restart_random))
    end function folding_suite

    subroutine what_fits_stays()
        !! A line of just the width, an empty one, one of blanks in between.
        call assertEqual("  a   b|", shown("  a   b", 7))
        call assertEqual("|", shown("", 7))
    end subroutine what_fits_stays

    subroutine a_text_goes_on_below_itself()
        !! Below the last cell; indented by two where there is none, or none in the left half.
        call assertEqual("name  some words|      of a text|", &
                         shown("name  some words of a text", 16))
        call assertEqual("  some words|    of a text|", shown("  some words of a text", 13))
        call assertEqual("long name of|  a row:|  text|", shown("long name of a row:  text", 12))
    end subroutine a_text_goes_on_below_itself

    subroutine cells_stay_together()
        !! In the right half a line is broken between cells, not in one of two words.
        call assertEqual("1.0   2.0   3.0|      as it is|", shown("1.0   2.0   3.0  as it is", 18))
    end subroutine cells_stay_together

    subroutine a_long_word_stays_whole()
        !! A path can be copied from the terminal, which folds it as it likes.
        call assertEqual("file:|  /a/very/long/path|  end|", &
                         shown("file: /a/very/long/path end", 8))
        call assertEqual("/a/very/long/path|", shown("/a/very/long/path", 8))
    end subroutine a_long_word_stays_whole

    subroutine letters_count_once()
        !! However many bytes they have.
        call assertEqual(4, columns_of(bar//bar//" x"))
        call assertEqual(bar//bar//" "//bar//bar//"|  x|", shown(bar//bar//" "//bar//bar//" x", 6))
        call assertEqual(bar//bar//" "//bar//bar//" x|", shown(bar//bar//" "//bar//bar//" x", 7))
    end subroutine letters_count_once

    subroutine no_word_is_lost()
        !! Of random lines at all widths: the words are the same in the same order, no line is wider
        !! unless it is one word, and none but the first begins further left than the second does.
        type(word_t), allocatable :: lines(:)
        character(:), allocatable :: all, text
        integer :: i, k, width

        do i = 1, 500
            text = repeat(" ", int(uniform(0.0_dp, 5.0_dp)))
            do k = 1, int(uniform(1.0_dp, 12.0_dp))
                text = text//repeat("w", int(uniform(1.0_dp, 12.0_dp)))// &
                       repeat(" ", int(uniform(1.0_dp, 4.0_dp)))
            end do
            text = trim(text)
            width = int(uniform(4.0_dp, 60.0_dp))
            call folded(text, width, lines)
            all = ""
            do k = 1, size(lines)
                all = all//" "//lines(k)%text
                if (index(trim(adjustl(lines(k)%text)), " ") > 0) then
                    call assertTrue(columns_of(lines(k)%text) <= width, text)
                end if
                call assertTrue(lines(k)%text == "" .or. verify(lines(min(k, 2))%text, " ") == &
                                verify(lines(k)%text, " "), text)
            end do
            call assertEqual(single(text), single(all))
        end do
    end subroutine no_word_is_lost

    function shown(text, width) result(all)
        !! The lines, each with a bar behind it.
        character(*), intent(in) :: text
        integer, intent(in) :: width
        character(:), allocatable :: all
        type(word_t), allocatable :: lines(:)
        integer :: i

        call folded(text, width, lines)
        all = ""
        do i = 1, size(lines)
            all = all//lines(i)%text//"|"
        end do
    end function shown

    pure function single(text) result(words)
        !! The words with one blank before each.
        character(*), intent(in) :: text
        character(:), allocatable :: words
        integer :: i

        words = ""
        do i = 1, len(text)
            if (text(i:i) == " ") cycle
            if (i == 1) then
                words = words//" "
            else if (text(i - 1:i - 1) == " ") then
                words = words//" "
            end if
            words = words//text(i:i)
        end do
    end function single
end module test_folding
