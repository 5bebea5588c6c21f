module lagrangia_plot_words
    !! Texts of pictures with formulas in them: `at theta1 = 2 pi/omega0, v0^2 = 3 g l` gets its
    !! letters, dots, indices and powers as the axes have them.
    !!
    !! A word is taken for a symbol if it is a Greek letter, or one letter with an index or a dot:
    !! `v0`, `p_theta`, `x_ddot`, behind a d too (`dtheta`); a power is a number or such a word
    !! behind `^`. All other words stay as they are, and so does a whole text without symbols.
    use lagrangia_characters, only: printable
    use lagrangia_gnuplot_script, only: gnuplot_string
    use lagrangia_plot_symbol, only: is_letter, symbol, utf8
    implicit none (type, external)
    private
    public :: plain_label, text_label, unicode_text, with_symbols

    character(*), parameter :: digits = "0123456789"
    character(*), parameter :: letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
    !! Capitals that look like Latin ones: these are words.
    character(7), parameter :: latin(*) = [character(7) :: "Alpha", "Beta", "Epsilon", "Zeta", &
        "Eta", "Iota", "Kappa", "Mu", "Nu", "Omicron", "Rho", "Tau", "Chi"]

contains

    pure function plain_label(text) result(string)
        !! Any text, as it is.
        character(*), intent(in) :: text  !! any bytes
        character(:), allocatable :: string

        string = gnuplot_string(text)//" noenhanced"
    end function plain_label

    pure function text_label(text) result(string)
        !! A title or a name as a string of gnuplot, with what must stand behind it.
        character(*), intent(in) :: text  !! any bytes
        character(:), allocatable :: string
        character(:), allocatable :: marked

        marked = with_symbols(text)
        if (marked == "") then
            string = plain_label(text)
        else
            string = gnuplot_string(marked)
        end if
    end function text_label

    pure function with_symbols(text) result(marked)
        !! In gnuplot's enhanced text; nothing if there is no symbol in it, or what might be taken
        !! for more than a text.
        character(*), intent(in) :: text  !! any bytes
        character(:), allocatable :: marked
        character(:), allocatable :: part
        logical :: found
        integer :: i, last

        marked = ""
        if (scan(text, "{}@&~\`") > 0 .or. printable(text) /= text) return
        found = .false.
        i = 1
        do while (i <= len(text))
            last = i
            if (index(letters, text(i:i)) > 0) then
                last = i + verify(text(i:)//" ", letters//digits//"_") - 2
                part = symbol_of(text(i:last))
                if (part == "") then
                    marked = marked//escaped(text(i:last))
                else
                    marked = marked//part
                    found = .true.
                end if
            else if (index(digits, text(i:i)) > 0) then
                last = i + number_length(text(i:)) - 1
                marked = marked//text(i:last)
            else if (text(i:i) == "^") then
                call take_power(text, last, part)
                if (last > i) then
                    marked = marked//"^{"//part//"}"
                    found = .true.
                else
                    marked = marked//escaped("^")
                end if
            else
                marked = marked//escaped(text(i:i))
            end if
            i = last + 1
        end do
        if (.not. found) marked = ""
    end function with_symbols

    pure function number_length(text) result(length)
        !! Of the number that a text begins with: `5.97e24` is no e with an index.
        character(*), intent(in) :: text  !! a digit first
        integer :: length
        integer :: first, more

        length = verify(text//" ", digits//".") - 1
        if (length == len(text)) return
        if (scan(text(length + 1:length + 1), "eEdD") == 0) return
        first = length + 2
        more = verify(text(first:)//" ", digits) - 1
        if (more == 0) return
        if (first + more <= len(text)) then
            if (scan(text(first + more:first + more), letters//"_") > 0) return
        end if
        length = first + more - 1
    end function number_length

    pure subroutine take_power(text, last, part)
        !! What is raised behind the `^` at `last`, with a sign; `last` stays where nothing is.
        character(*), intent(in) :: text
        integer, intent(inout) :: last  !! the place of `^`, then of the last character raised
        character(:), allocatable, intent(out) :: part
        integer :: at, length

        at = last + 1
        part = ""
        if (at <= len(text)) then
            if (text(at:at) == "-") at = at + 1
        end if
        length = verify(text(at:)//" ", digits) - 1
        if (length == 0) then
            length = verify(text(at:)//" ", letters//digits//"_") - 1
            if (length > 1) then
                part = symbol_of(text(at:at + length - 1))
                if (part == "") length = 0
            end if
        end if
        if (length == 0) return
        if (part == "") part = text(at:at + length - 1)
        part = text(last + 1:at - 1)//part
        last = at + length - 1
    end subroutine take_power

    pure function symbol_of(word) result(marked)
        !! Nothing if it is just a word.
        character(*), intent(in) :: word  !! letters, digits, underscores, a letter first
        character(:), allocatable :: marked
        integer :: length

        marked = ""
        if (len(word) == 1 .or. word(len(word):) == "_" .or. index(word, "__") > 0) return
        length = scan(word//"_", "_") - 1
        if (any(latin == word(:length))) return
        if (is_letter(word(:length))) then
            marked = symbol(word)
        else if (word(1:1) == "d" .and. length > 2) then
            if (is_letter(word(2:length))) marked = "d"//symbol(word(2:))
        end if
    end function symbol_of

    pure function escaped(text) result(marked)
        !! With a mark before what gnuplot would take for an index or a power.
        character(*), intent(in) :: text
        character(:), allocatable :: marked
        integer :: i

        marked = ""
        do i = 1, len(text)
            if (index("_^", text(i:i)) > 0) marked = marked//"\"
            marked = marked//text(i:i)
        end do
    end function escaped

    pure function unicode_text(text) result(plain)
        !! The same for pages: letters and dots, digits raised and lowered, and `_x`, `^n` where
        !! Unicode has no such letter.
        character(*), intent(in) :: text  !! any bytes
        character(:), allocatable :: plain
        character(:), allocatable :: marked
        integer :: i, last

        plain = text
        marked = with_symbols(text)
        if (marked == "") return
        plain = ""
        i = 1
        do while (i <= len(marked))
            last = i
            if (marked(i:i) == "\") then
                last = i + 1
                plain = plain//marked(last:last)
            else if (index("_^", marked(i:i)) > 0) then
                last = i + index(marked(i:), "}") - 1
                plain = plain//moved(marked(i:i), marked(i + 2:last - 1))
            else
                plain = plain//marked(i:i)
            end if
            i = last + 1
        end do
    end function unicode_text

    pure function moved(mark, part) result(plain)
        !! An index or a power: of digits and minus, by their own characters.
        character(*), intent(in) :: mark, part  !! `_` or `^`; what is lowered or raised
        character(:), allocatable :: plain
        integer :: code, i, k

        plain = mark//part
        if (verify(part, "-"//digits) > 0) return
        plain = ""
        do i = 1, len(part)
            k = index(digits, part(i:i)) - 1
            code = merge(int(z"2080"), int(z"2070"), mark == "_") + merge(11, k, k < 0)
            if (mark == "^" .and. k == 1) code = int(z"B9")
            if (mark == "^" .and. (k == 2 .or. k == 3)) code = int(z"B0") + k
            plain = plain//utf8(code)
        end do
    end function moved
end module lagrangia_plot_words
