module lagrangia_column_words
    !! Names of columns and units as one word each, for the header of a data file.
    use lagrangia_characters, only: printable
    use lagrangia_plot_symbol, only: is_letter
    use lagrangia_text, only: replaced
    implicit none (type, external)
    private
    public :: column_word, unit_word

    character(*), parameter :: letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
    character(*), parameter :: operators = "+-=,"

contains

    pure function column_word(name) result(word)
        !! `_` for a blank beside a word of language, `flat_throw`; `*` for one between factors,
        !! `m*x_ddot*dx/dtheta`; none beside an operator, `p_x*t-M*x_com`.
        character(*), intent(in) :: name  !! as it is shown
        character(:), allocatable :: word
        character(:), allocatable :: text
        integer :: i

        text = trim(printable(name))
        word = ""
        do i = 1, len(text)
            if (text(i:i) /= " " .or. i == 1) then
                word = word//text(i:i)
            else if (scan(text(i - 1:i - 1)//text(i + 1:i + 1), operators//" ") > 0) then
                cycle
            else if (ends_in_word(text(:i - 1)) .or. begins_with_word(text(i + 1:))) then
                word = word//"_"
            else
                word = word//"*"
            end if
        end do
    end function column_word

    pure function unit_word(unit) result(word)
        !! A blank in a unit is a product, `kg*m/s`.
        character(*), intent(in) :: unit  !! as it is shown
        character(:), allocatable :: word
        integer :: comma

        word = replaced(printable(trim(unit)), " ", "*")
        do
            comma = index(word, ",*")
            if (comma == 0) return
            word = word(:comma)//word(comma + 2:)
        end do
    end function unit_word

    pure function ends_in_word(text) result(yes)
        !! Of language: letters that are no symbol, alone or behind a number.
        character(*), intent(in) :: text
        logical :: yes
        integer :: first

        first = verify(text, letters, back=.true.) + 1
        yes = .false.
        if (first > len(text)) return
        if (first > 1) then
            if (scan(text(first - 1:first - 1), " -") == 0) return
        end if
        yes = .not. is_letter(text(first:))
    end function ends_in_word

    pure function begins_with_word(text) result(yes)
        !! The same of the beginning.
        character(*), intent(in) :: text
        logical :: yes
        integer :: last

        last = verify(text//"/", letters) - 1
        yes = .false.
        if (last == 0) return
        if (last < len(text)) then
            if (scan(text(last + 1:last + 1), " -,") == 0) return
        end if
        yes = .not. is_letter(text(:last))
    end function begins_with_word
end module lagrangia_column_words
