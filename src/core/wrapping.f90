module lagrangia_wrapping
    !! Lines of a paragraph.
    use lagrangia_text, only: word_t
    implicit none (type, external)
    private
    public :: wrapped

contains

    subroutine wrapped(text, width, lines)
        !! The words of a paragraph on lines of at most `width` columns each, one blank between
        !! two; a word that is longer has a line of its own, longer too.
        character(*), intent(in) :: text                    !! words, blanks between them
        integer, intent(in) :: width                        !! columns, above 0
        type(word_t), allocatable, intent(out) :: lines(:)  !! none of an empty text
        character(:), allocatable :: line, rest
        integer :: n, next, turn

        do turn = 1, 2  ! count, then copy
            n = 0
            line = ""
            rest = trim(adjustl(text))
            do while (rest /= "")
                next = index(rest//" ", " ")
                if (line /= "" .and. len(line) + next > width) then
                    call end_line()
                    line = ""
                end if
                if (line /= "") line = line//" "
                line = line//rest(:next - 1)
                rest = trim(adjustl(rest(next:)))
            end do
            if (line /= "") call end_line()
            if (turn == 1) allocate (lines(n))
        end do
    contains
        subroutine end_line()
            n = n + 1
            if (turn == 2) lines(n)%text = line
        end subroutine end_line
    end subroutine wrapped
end module lagrangia_wrapping
