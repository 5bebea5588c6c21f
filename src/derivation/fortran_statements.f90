module lagrangia_fortran_statements
    !! Statements of Fortran as lines of at most 100 columns, texts as literals.
    use lagrangia_text, only: append_word, word_t
    implicit none (type, external)
    private
    public :: fortran_lines_t
    public :: literal

    integer, parameter :: widest = 98           !! characters of a line before ` &`
    integer, parameter :: longest_sum = 8000    !! characters of one statement
    integer, parameter :: longest_literal = 50  !! characters in one pair of quotes

    type :: fortran_lines_t
        !! None at first.
        type(word_t), allocatable :: list(:)
        integer :: longest = 0  !! lines of the longest statement
    contains
        procedure :: add
        procedure :: assign
        procedure, private :: append
    end type fortran_lines_t

contains

    pure subroutine add(self, indentation, statement)
        !! One statement or comment. A statement is broken where blanks, products and commas are,
        !! outside of its texts.
        class(fortran_lines_t), intent(inout) :: self
        integer, intent(in) :: indentation  !! columns
        character(*), intent(in) :: statement  !! or what begins with `!!`
        character(:), allocatable :: head, rest
        integer :: at, lines

        head = repeat(" ", indentation)
        rest = statement
        lines = 1
        do while (len(head) + len(rest) > widest + 2)
            at = break_before(rest, widest - len(head))
            if (at <= 1) exit
            if (index(statement, "!!") == 1) then
                call self%append(head//trim(rest(:at - 1)))
                rest = "!! "//adjustl(rest(at:))
            else
                call self%append(head//trim(rest(:at - 1))//" &")
                rest = trim(adjustl(rest(at:)))
                if (lines == 1) head = head//"    "
                lines = lines + 1
            end if
        end do
        call self%append(head//rest)
        self%longest = max(self%longest, lines)
    end subroutine add

    pure subroutine assign(self, indentation, name, total)
        !! A variable becomes a sum; a long one in several statements, its terms in their order.
        class(fortran_lines_t), intent(inout) :: self
        integer, intent(in) :: indentation        !! columns
        character(*), intent(in) :: name, total   !! left and right side
        character(:), allocatable :: before
        integer :: depth, first, i

        depth = 0
        first = 1
        before = name//" = "
        do i = 2, len(total) - 1
            if (total(i - 1:i - 1) == "(") depth = depth + 1
            if (total(i - 1:i - 1) == ")") depth = depth - 1
            if (depth > 0 .or. i - first < longest_sum) cycle
            if (all(total(i - 1:i + 1) /= [" + ", " - "])) cycle
            call self%add(indentation, before//total(first:i - 2))
            before = name//" = "//name//" "
            first = i
        end do
        call self%add(indentation, before//total(first:))
    end subroutine assign

    pure subroutine append(self, line)
        !! A line at the end.
        class(fortran_lines_t), intent(inout) :: self
        character(*), intent(in) :: line

        call append_word(self%list, trim(line))
    end subroutine append

    pure function break_before(text, room) result(at)
        !! Where a new line may begin within `room`: at a term or behind a comma, in as few brackets
        !! as there are, if that fills a third of it, else behind a blank or at a product; 0 where
        !! nowhere. Never within a text.
        character(*), intent(in) :: text
        integer, intent(in) :: room
        integer :: at
        logical :: is_comment, is_quoted
        integer :: best, depth, i, least

        at = 0
        best = 0
        depth = 0
        least = 1
        is_quoted = .false.
        is_comment = index(text, "!!") == 1
        do i = 2, min(room + 1, len(text) - 1)
            if (text(i - 1:i - 1) == '"') is_quoted = .not. is_quoted
            if (is_quoted .and. .not. is_comment) cycle
            if (text(i - 1:i - 1) == "(") depth = depth + 1
            if (text(i - 1:i - 1) == ")") depth = depth - 1
            if (text(i - 1:i - 1) == " ") then
                at = i
                if (depth > least .or. is_comment) cycle
                if (text(max(1, i - 2):i - 1) /= ", " .and. scan(text(i:i), "+-") == 0) cycle
                best = i
                least = depth
            else if (scan(text(i:i), "*/") == 1 .and. .not. is_comment) then
                if (scan(text(i - 1:i - 1)//text(i + 1:i + 1), "*/") == 0) at = i
            end if
        end do
        if (3*best > room) at = best
    end function break_before

    pure function literal(text) result(quoted)
        !! A text in quotes, a long one in pieces.
        character(*), intent(in) :: text  !! blanks at its end do not count
        character(:), allocatable :: quoted
        integer :: i, filled

        quoted = '"'
        filled = 0
        do i = 1, len_trim(text)
            if (filled >= longest_literal .and. text(i:i) == " " .and. i < len_trim(text) - 9) then
                quoted = quoted//'"// "'
                filled = 0
            end if
            quoted = quoted//text(i:i)
            if (text(i:i) == '"') quoted = quoted//'"'
            filled = filled + 1
        end do
        quoted = quoted//'"'
    end function literal
end module lagrangia_fortran_statements
