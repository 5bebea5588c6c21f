module lagrangia_plot_label
    !! Names of columns as a picture shows them, in gnuplot's enhanced text: `theta1_dot` with its
    !! letter, its dot and its index, `x_bob`, `energy_drift` as words; units with their powers.
    !!
    !! What is made of letters, digits, points and underscores is taken apart; in all else, as in
    !! `m g cos(theta)`, the words that are symbols.
    use lagrangia_gnuplot_script, only: gnuplot_string
    use lagrangia_plot_symbol, only: symbol
    use lagrangia_plot_words, only: plain_label, text_label, with_symbols
    implicit none (type, external)
    private
    public :: is_small, label, labels, width_of

    character(*), parameter :: letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
    character(*), parameter :: digits = "0123456789"

contains

    elemental function is_small(name) result(small)
        !! A drift or an error: to be drawn on a logarithmic scale of its own.
        character(*), intent(in) :: name  !! of a column
        logical :: small

        small = name == "error"
        if (len_trim(name) > 6) small = small .or. name(len_trim(name) - 5:) == "_drift"
    end function is_small

    pure function label(name, unit) result(string)
        !! `theta_dot` in `rad/s` as a string of gnuplot with what must stand behind it: the letter
        !! with its dot, and `(rad/s)`. A pure number has no unit, and `?` is one that is not known.
        character(*), intent(in) :: name, unit  !! of a column
        character(:), allocatable :: string

        if (is_name(trim(name)) .and. is_unit(trim(unit))) then
            string = gnuplot_string(trim(symbol(trim(name))//" "//unit_text(unit)))
        else if (with_symbols(trim(name)) /= "" .and. is_unit(trim(unit))) then
            string = gnuplot_string(trim(with_symbols(trim(name))//" "//unit_text(unit)))
        else if (unit_text(unit) == "") then
            string = plain_label(trim(name))
        else
            string = text_label(trim(name)//" ("//trim(unit)//")")
        end if
    end function label

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
            if (same) string = text_label("("//trim(units(1))//")")
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
        !! `(m/s^{2})`, `(m^{1/2})`; nothing for a pure number or where it is not known.
        character(*), intent(in) :: unit
        character(:), allocatable :: text
        integer :: i, last

        text = ""
        if (any(unit == ["1", " ", "?"])) return
        i = 1
        do while (i <= len_trim(unit))
            if (unit(i:i) == "^") then
                last = i + verify(unit(i + 1:)//" ", "-."//digits) - 1
                if (index(unit(i + 1:), "(") == 1 .and. index(unit, ")", back=.true.) > i) then
                    last = i + index(unit(i + 1:), ")")
                    text = text//"^{"//unit(i + 2:last - 1)//"}"
                else
                    text = text//"^{"//unit(i + 1:last)//"}"
                end if
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

        yes = verify(trim(text), letters//digits//" */.()^-") == 0 .or. text == "?"
    end function is_unit
end module lagrangia_plot_label
