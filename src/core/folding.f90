module lagrangia_folding
    !! Lines that are wider than the terminal, folded so that their columns can still be read.
    use lagrangia_text, only: word_t
    implicit none (type, external)
    private
    public :: columns_of, folded

contains

    pure subroutine folded(text, width, lines)
        !! The line on as many as it takes, of at most `width` columns each. It is broken at
        !! blanks, in its right half best between two cells of a table, and goes on below its last
        !! cell that begins in the left half; where there is none, indented by two. Cells have two
        !! blanks or more between them. A word that is longer has a line of its own, longer too.
        character(*), intent(in) :: text                    !! printable, in UTF-8
        integer, intent(in) :: width                        !! columns, above 0
        type(word_t), allocatable, intent(out) :: lines(:)  !! one of a text that fits
        character(:), allocatable :: rest
        integer :: cut, hang, indent, n, turn

        hang = hanging_indent(text, width)
        do turn = 1, 2  ! count, then copy
            n = 0
            indent = 0
            rest = text
            do
                cut = len(rest)
                if (indent + columns_of(rest) > width) cut = break_of(rest, width - indent)
                n = n + 1
                if (turn == 2) lines(n)%text = repeat(" ", indent)//rest(:cut)
                rest = trim(adjustl(rest(cut + 1:)))
                if (rest == "") exit
                indent = hang
            end do
            if (turn == 1) allocate (lines(n))
        end do
    end subroutine folded

    pure function columns_of(text) result(number)
        !! One a character; the second byte of a character in UTF-8, and each further one, is none.
        character(*), intent(in) :: text  !! in UTF-8
        integer :: number
        integer :: i

        number = 0
        do i = 1, len(text)
            if (begins(text(i:i))) number = number + 1
        end do
    end function columns_of

    pure function hanging_indent(text, width) result(indent)
        !! Where the lines behind the first one begin.
        character(*), intent(in) :: text
        integer, intent(in) :: width
        integer :: indent
        integer :: column, i
        logical :: first

        first = .true.
        indent = 0
        column = 0
        do i = 1, len(text)
            if (.not. begins(text(i:i))) cycle
            if (text(i:i) /= " ") then
                if (first) then
                    indent = min(column, width/2) + 2
                    first = .false.
                else if (text(max(1, i - 2):i - 1) == " " .and. column <= width/2) then
                    indent = column
                end if
            end if
            column = column + 1
        end do
        indent = min(indent, width/2)
    end function hanging_indent

    pure function break_of(text, room) result(last)
        !! The last byte before the break: a blank, or a gap between cells, follows it.
        character(*), intent(in) :: text
        integer, intent(in) :: room  !! columns
        integer :: last
        integer :: column, gap, i
        logical :: first

        last = 0
        gap = 0
        column = 0
        first = .true.
        do i = 1, len(text) - 1
            if (begins(text(i:i))) column = column + 1
            if (text(i:i) /= " ") first = .false.
            if (first .or. text(i:i) == " " .or. text(i + 1:i + 1) /= " ") cycle
            if (column > room) exit
            last = i
            if (i + 2 <= len(text) .and. column > room/2) then
                if (text(i + 1:i + 2) == " ") gap = i
            end if
        end do
        if (gap > 0) last = gap
        if (last > 0) return
        last = verify(text, " ")  ! the first word is too long
        last = last - 1 + index(text(last:)//" ", " ") - 1
    end function break_of

    pure function begins(byte) result(yes)
        !! Whether a character begins here: in UTF-8 the bytes that go on are 10xxxxxx.
        character, intent(in) :: byte
        logical :: yes

        yes = iand(ichar(byte), 192) /= 128
    end function begins
end module lagrangia_folding
