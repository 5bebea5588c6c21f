module lagrangia_plot_label
    !! Names of columns as a picture shows them, in gnuplot's enhanced text: `theta1_dot` with its
    !! letter, its dot and its index, `x_bob`, `energy_drift` as words; units with their powers.
    !!
    !! Only what is made of letters, digits, points and underscores is taken apart. All else is
    !! shown as it is, by a string that gnuplot is told not to read (`noenhanced`).
    use lagrangia_gnuplot_script, only: gnuplot_string
    implicit none (type, external)
    private
    public :: is_small, label, labels, plain_label, symbol

    character(*), parameter :: letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
    character(*), parameter :: digits = "0123456789"
    character(7), parameter :: greek(*) = [character(7) :: "alpha", "beta", "gamma", "delta", &
        "epsilon", "zeta", "eta", "theta", "iota", "kappa", "lambda", "mu", "nu", "xi", &
        "omicron", "pi", "rho", "", "sigma", "tau", "upsilon", "phi", "chi", "psi", "omega"]
    integer, parameter :: small_alpha = 945, capital_alpha = 913  !! in Unicode
    character(2), parameter :: dot_above = char(204)//char(135), &
                               two_dots_above = char(204)//char(136)

contains

    elemental function is_small(name) result(small)
        !! A drift or an error: to be drawn on a logarithmic scale of its own.
        character(*), intent(in) :: name  !! of a column
        logical :: small

        small = index(name, "_drift") > 0 .or. name == "error"
    end function is_small

    pure function label(name, unit) result(string)
        !! `theta_dot` in `rad/s` as a string of gnuplot with what must stand behind it: the letter
        !! with its dot, and `(rad/s)`. A pure number has no unit.
        character(*), intent(in) :: name, unit  !! of a column
        character(:), allocatable :: string

        if (is_name(trim(name)) .and. is_unit(trim(unit))) then
            string = gnuplot_string(trim(symbol(trim(name))//" "//unit_text(unit)))
        else if (unit == "1" .or. unit == "") then
            string = plain_label(trim(name))
        else
            string = plain_label(trim(name)//" ("//trim(unit)//")")
        end if
    end function label

    pure function plain_label(text) result(string)
        !! Any text, as it is.
        character(*), intent(in) :: text  !! any bytes
        character(:), allocatable :: string

        string = gnuplot_string(text)//" noenhanced"
    end function plain_label

    pure function labels(names, units) result(string)
        !! Of an axis that several columns share: all names where there are few, a unit once.
        character(*), intent(in) :: names(:), units(:)  !! of the columns
        character(:), allocatable :: string
        integer, parameter :: few = 3, longest = 24  !! names, characters
        character(:), allocatable :: text
        logical :: same
        integer :: i

        if (size(names) == 1) then
            string = label(names(1), units(1))
            return
        end if
        same = all(units == units(1))
        if (.not. all(is_unit(units))) then
            string = plain_label("")
            if (same) string = plain_label("("//trim(units(1))//")")
            return
        end if
        text = ""
        if (size(names) <= few .and. all(is_name(names))) then
            do i = 1, size(names)
                if (i > 1) text = text//", "
                text = text//symbol(trim(names(i)))
                if (.not. same) text = trim(text//" "//unit_text(units(i)))
            end do
        end if
        if (width_of(text) > longest) text = ""
        if (same) text = trim(adjustl(text//" "//unit_text(units(1))))
        string = gnuplot_string(text)
    end function labels

    pure function width_of(text) result(width)
        !! Characters that are seen: neither marks of an index nor the further bytes of one.
        character(*), intent(in) :: text  !! any bytes
        integer :: width, i

        width = 0
        do i = 1, len(text)
            if (index("_{}", text(i:i)) == 0 .and. iand(ichar(text(i:i)), 192) /= 128) then
                width = width + 1
            end if
        end do
    end function width_of

    pure function unit_text(unit) result(text)
        !! `(m/s^{2})`; nothing for a pure number.
        character(*), intent(in) :: unit
        character(:), allocatable :: text
        integer :: i, last

        text = ""
        if (unit == "1" .or. unit == "") return
        i = 1
        do while (i <= len_trim(unit))
            if (unit(i:i) == "^") then
                last = i + verify(unit(i + 1:)//" ", "-"//digits) - 1
                text = text//"^{"//unit(i + 1:last)//"}"
                i = last + 1
            else
                text = text//unit(i:i)
                i = i + 1
            end if
        end do
        text = "("//text//")"
    end function unit_text

    elemental function is_name(text) result(yes)
        !! Made of letters, digits, points and underscores, a letter first.
        character(*), intent(in) :: text  !! any bytes
        logical :: yes

        yes = verify(trim(text), letters//digits//"._") == 0 .and. scan(text, letters) == 1
    end function is_name

    elemental function is_unit(text) result(yes)
        !! Nothing in it but letters, digits and what joins them.
        character(*), intent(in) :: text  !! any bytes
        logical :: yes

        yes = verify(trim(text), letters//digits//" */.()^-") == 0
    end function is_unit

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
        text = char(192 + code/64)//char(128 + mod(code, 64))//part(length + 1:)
    end function glyph

    pure function is_letter(part) result(yes)
        !! One letter, Latin or Greek, with its digits.
        character(*), intent(in) :: part
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
end module lagrangia_plot_label
