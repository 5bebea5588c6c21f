module lagrangia_plot_symbol
    !! Names as symbols in gnuplot's enhanced text: `theta1_dot` is the Greek letter with a dot and
    !! the index 1.
    implicit none (type, external)
    private
    public :: is_letter, symbol, utf8

    character(*), parameter :: digits = "0123456789"
    character(7), parameter :: greek(*) = [character(7) :: "alpha", "beta", "gamma", "delta", &
        "epsilon", "zeta", "eta", "theta", "iota", "kappa", "lambda", "mu", "nu", "xi", &
        "omicron", "pi", "rho", "", "sigma", "tau", "upsilon", "phi", "chi", "psi", "omega"]
    integer, parameter :: small_alpha = 945, capital_alpha = 913  !! in Unicode
    character(2), parameter :: dot_above = char(204)//char(135), &
                               two_dots_above = char(204)//char(136)

contains

    pure function symbol(name) result(text)
        !! A name in enhanced text: `theta1_dot` is the Greek letter with a dot and the index 1,
        !! `p_x_drift` is `p_{x} drift`, `contact_force` is `contact force`.
        character(*), intent(in) :: name  !! letters, digits, points, underscores
        character(:), allocatable :: text
        character(:), allocatable :: below, mark, rest, tail
        logical :: letter
        integer :: first, last

        rest = name
        tail = ""
        mark = ""
        if (ends_with(rest, "_drift")) then
            rest = rest(:len(rest) - 6)
            tail = " drift"
        end if
        if (ends_with(rest, "_ddot")) then
            rest = rest(:len(rest) - 5)
            mark = two_dots_above
        else if (ends_with(rest, "_dot")) then
            rest = rest(:len(rest) - 4)
            mark = dot_above
        end if
        last = scan(rest, digits//"_") - 1
        if (last < 0) last = len(rest)
        text = glyph(rest(:last))
        if (is_letter(rest(:last))) then
            text = text//mark
        else if (mark == dot_above) then
            tail = " dot"//tail
        else if (mark /= "") then
            tail = " ddot"//tail
        end if
        letter = is_letter(rest(:last))
        below = ""
        first = last + 1
        do while (first <= len(rest))
            if (rest(first:first) == "_") then
                first = first + 1
                cycle
            end if
            last = index(rest(first:)//"_", "_") + first - 2
            associate (part => rest(first:last))
                ! An index of a letter; of a word, a letter, or a number that stands at the word.
                if (letter .or. is_letter(part) .or. rest(first - 1:first - 1) /= "_") then
                    if (below /= "") below = below//","
                    below = below//glyph(part)
                else
                    text = text//closed(below)//" "//glyph(part)
                    below = ""
                end if
            end associate
            first = last + 1
        end do
        text = text//closed(below)//tail
    contains
        pure function closed(index_text) result(marked)
            !! An index with its marks, if there is one.
            character(*), intent(in) :: index_text
            character(:), allocatable :: marked

            marked = ""
            if (index_text /= "") marked = "_{"//index_text//"}"
        end function closed
    end function symbol

    pure function glyph(part) result(text)
        !! A Greek letter, digits behind it as they are; all else as it is.
        character(*), intent(in) :: part
        character(:), allocatable :: text
        integer :: code, length

        text = part
        length = scan(part//"1", digits) - 1
        if (length < 2) return
        code = findloc(greek == part(:length), .true., 1)
        if (code > 0) then
            code = small_alpha + code - 1
        else
            code = findloc(greek == char(ichar(part(1:1)) + 32)//part(2:length), .true., 1)
            if (code == 0) return
            code = capital_alpha + code - 1
        end if
        text = utf8(code)//part(length + 1:)
    end function glyph

    pure function utf8(code) result(bytes)
        !! A character of two or three bytes.
        integer, intent(in) :: code  !! from 128 to 65535
        character(:), allocatable :: bytes

        if (code < 2048) then
            bytes = char(192 + code/64)//char(128 + mod(code, 64))
        else
            bytes = char(224 + code/4096)//char(128 + mod(code/64, 64))// &
                    char(128 + mod(code, 64))
        end if
    end function utf8

    pure function is_letter(part) result(yes)
        !! One letter, Latin or Greek, with its digits.
        character(*), intent(in) :: part  !! of a name
        logical :: yes
        integer :: length

        length = scan(part//"1", digits) - 1
        yes = length == 1
        if (length > 1) yes = glyph(part(:length)) /= part(:length)
    end function is_letter

    pure function ends_with(text, ending) result(yes)
        !! Is there something before it, too?
        character(*), intent(in) :: text, ending
        logical :: yes

        yes = .false.
        if (len(text) > len(ending)) yes = text(len(text) - len(ending) + 1:) == ending
    end function ends_with
end module lagrangia_plot_symbol
