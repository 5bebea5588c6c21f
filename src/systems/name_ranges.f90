module lagrangia_name_ranges
    !! Names of a chain in a list: `'x_1 .. x_4 [m]'` is four texts, and in what stands behind it
    !! the letter i is the number, `'bob_1 .. bob_4, m: x_i, y_i'`.
    use lagrangia_text, only: quoted, to_text
    use lagrangia_written_formulas, only: longest_formula
    implicit none (type, external)
    private
    public :: expand_ranges, family_of, with_number

    character(*), parameter :: digits = "0123456789"
    character(*), parameter :: inside = digits//"_abcdefghijklmnopqrstuvwxyz"// &
                                        "ABCDEFGHIJKLMNOPQRSTUVWXYZ"
    integer, parameter :: most = 60

contains

    subroutine expand_ranges(texts, expanded, from, problem)
        !! Write the ranges out.
        character(*), intent(in) :: texts(:)                                    !! as typed
        character(longest_formula), allocatable, intent(out) :: expanded(:)     !! one name each
        integer, allocatable, intent(out) :: from(:)
        !! of which text each comes; the last one is to blame for a problem
        character(:), allocatable, intent(out) :: problem                    !! "" if there is none
        character(:), allocatable :: stem, rest
        integer :: first, i, k, last

        problem = ""
        allocate (expanded(0), from(0))
        do i = 1, size(texts)
            if (.not. begins_with_range(texts(i))) then
                expanded = [character(longest_formula) :: expanded, texts(i)]
                from = [from, i]
                cycle
            end if
            call read_range(trim(texts(i)), stem, first, last, rest, problem)
            if (problem /= "") then
                from = [from, i]
                return
            end if
            do k = first, last
                expanded = [character(longest_formula) :: expanded, stem//to_text(k)// &
                            with_number(rest, to_text(k))]
                from = [from, i]
            end do
        end do
    end subroutine expand_ranges

    pure function begins_with_range(text) result(yes)
        !! One word, then two points.
        character(*), intent(in) :: text
        logical :: yes

        yes = index(text, "..") > 0
        if (yes) yes = scan(trim(adjustl(text(:index(text, "..") - 1))), " [,:(=") == 0
    end function begins_with_range

    pure subroutine read_range(text, stem, first, last, rest, problem)
        !! `x_1 .. x_4` and what follows.
        character(*), intent(in) :: text
        character(:), allocatable, intent(out) :: stem, rest, problem
        integer, intent(out) :: first, last
        character(:), allocatable :: left, right, end_stem
        integer :: at, behind
        logical :: good

        at = index(text, "..")
        left = trim(adjustl(text(:at - 1)))
        behind = at + 1 + verify(text(at + 2:)//"!", " ")
        last = behind + verify(text(behind:)//"!", inside) - 2
        right = text(behind:last)
        rest = text(last + 1:)
        problem = ""
        call split(left, stem, first, good)
        if (good) call split(right, end_stem, last, good)
        if (good) good = stem == end_stem
        if (.not. good) then
            problem = "names of a chain are written 'x_1 .. x_4', with one name before the numbers"
        else if (last < first .or. last - first >= most) then
            problem = quoted(left//" .. "//right)//" is "//to_text(max(0, last - first + 1))// &
                      " names; there are 1 to "//to_text(most)
        end if
    end subroutine read_range

    pure subroutine split(name, stem, number, good)
        !! `x_` and 12.
        character(*), intent(in) :: name
        character(:), allocatable, intent(out) :: stem
        integer, intent(out) :: number
        logical, intent(out) :: good
        integer :: at, i

        number = 0
        at = index(name, "_", back=.true.)
        stem = name(:at)
        good = at > 1 .and. at < len(name) .and. len(name) - at < 5
        if (good) good = verify(name(at + 1:), digits) == 0 .and. verify(stem, inside) == 0
        if (.not. good) return
        do i = at + 1, len(name)
            number = 10*number + index(digits, name(i:i)) - 1
        end do
    end subroutine split

    pure subroutine family_of(name, family, number)
        !! `x_i` and `3` of `x_3`; empty where the name has no number.
        character(*), intent(in) :: name                          !! of a coordinate
        character(:), allocatable, intent(out) :: family, number  !! as above
        integer :: at

        at = index(name, "_", back=.true.)
        family = ""
        number = name(at + 1:)
        if (at < 2 .or. number == "" .or. verify(number, digits) > 0) return
        family = name(:at)//"i"
    end subroutine family_of

    pure function with_number(text, number) result(numbered)
        !! The number in the place of the letter i where that is a name, or behind the `_` of one.
        character(*), intent(in) :: text, number  !! a formula; digits
        character(:), allocatable :: numbered
        logical :: alone
        integer :: k

        numbered = ""
        do k = 1, len(text)
            alone = text(k:k) == "i"
            if (alone .and. k > 1) alone = verify(text(k - 1:k - 1), inside) > 0 &
                                           .or. text(k - 1:k - 1) == "_"
            if (alone .and. k < len(text)) alone = verify(text(k + 1:k + 1), inside) > 0 &
                                                   .or. text(k + 1:k + 1) == "_"
            if (alone) then
                numbered = numbered//number
            else
                numbered = numbered//text(k:k)
            end if
        end do
    end function with_number
end module lagrangia_name_ranges
