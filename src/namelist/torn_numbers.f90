module lagrangia_torn_numbers
    !! Numbers that came apart where another language has a comma for the point, or a blank or a
    !! point between thousands.
    use lagrangia_namelist_tree, only: kind_number, namelist_t, raw_text
    use lagrangia_number_reader, only: digits
    use lagrangia_text, only: escaped
    implicit none (type, external)
    private
    public :: mended

contains

    pure function mended(tree, picked, low, high) result(remedy)
        !! What to write if the values at the positions `picked` came apart (`1,5`, `1 000`,
        !! `1.000,5`), and together would be from `low` to `high`; otherwise nothing.
        type(namelist_t), intent(in) :: tree   !! of a file
        integer, intent(in) :: picked(:)       !! positions in its values
        integer, intent(in) :: low, high       !! of the number of values
        character(:), allocatable :: remedy
        character(:), allocatable :: number
        logical :: commas, thousands
        integer :: i, n

        remedy = ""
        if (any(picked == 0)) return
        if (any(tree%values(picked)%kind /= kind_number)) return
        commas = .false.
        thousands = .false.
        n = 0
        i = 1
        do while (i <= size(picked))
            call put_together(tree, picked, i, number, commas, thousands)
            n = n + 1
            remedy = remedy//", "//number
        end do
        if (n == size(picked) .or. n < low .or. n > high) then
            remedy = ""
            return
        end if
        remedy = ": "//escaped(remedy(3:))
        if (thousands) remedy = "nothing between thousands"//remedy
        if (commas .and. thousands) remedy = ", "//remedy
        if (commas) remedy = "a decimal point, no comma"//remedy
        remedy = "; "//remedy
    end function mended

    pure subroutine put_together(tree, picked, i, number, commas, thousands)
        !! The number that begins with value `i` of those picked; `i` steps behind its last part.
        type(namelist_t), intent(in) :: tree
        integer, intent(in) :: picked(:)
        integer, intent(inout) :: i
        character(:), allocatable, intent(out) :: number
        logical, intent(inout) :: commas, thousands
        character(:), allocatable :: between, next, whole

        number = raw_text(tree, tree%values(picked(i)))
        i = i + 1
        do while (i <= size(picked))
            between = tree%text(tree%values(picked(i - 1))%last + 1: &
                                tree%values(picked(i))%first - 1)
            next = raw_text(tree, tree%values(picked(i)))
            whole = number
            if (between//"|" == ",|") whole = without_point(number)
            if (scan(next(1:1), digits) == 0 .or. index(next, ".") > 0) return
            if (verify(whole, "+-"//digits) > 0) return
            if (between//"|" == " |" .and. is_group(next) .and. scan(whole, digits(2:)) > 0) then
                number = number//next
                thousands = .true.
                i = i + 1
            else if (between//"|" == ",|") then
                thousands = thousands .or. whole /= number
                if (is_group(next) .and. .not. thousands .and. scan(whole, digits(2:)) > 0) then
                    next = next//" (or "//whole//next//")"
                end if
                number = whole//"."//next
                commas = .true.
                i = i + 1
                return
            else
                return
            end if
        end do
    end subroutine put_together

    pure function is_group(figures) result(yes)
        !! Three digits, as between thousands?
        character(*), intent(in) :: figures
        logical :: yes

        yes = len(figures) == 3 .and. verify(figures, digits) == 0
    end function is_group

    pure function without_point(figures) result(plain)
        !! `1.000` is 1000 where a comma follows; anything else stays.
        character(*), intent(in) :: figures
        character(:), allocatable :: plain
        integer :: point

        plain = figures
        point = index(figures, ".")
        if (point < 2 .or. point > 5) return
        if (is_group(figures(point + 1:))) plain = figures(:point - 1)//figures(point + 1:)
    end function without_point
end module lagrangia_torn_numbers
