module formula
    !! Reads a printed formula as a student does, and computes it: `m/2 l^2 theta_dot^2`.
    !!
    !! Products may be written side by side; a division takes the one factor that follows it;
    !! names are those of a table, the longest that fits. Names may hold blanks and brackets.
    use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
    use lagrangia_kinds, only: dp
    implicit none (type, external)
    private
    public :: formula_value, names_t

    integer, parameter :: name_length = 40, most_names = 200

    type :: names_t
        !! Names and what they stand for.
        integer, private :: count = 0
        character(name_length), private :: name(most_names) = ""
        real(dp), private :: value(most_names) = 0.0_dp
    contains
        procedure :: set
        procedure :: value_of
        procedure, private :: longest
    end type names_t

contains

    subroutine set(self, name, value)
        !! A name and its value; the latest counts.
        class(names_t), intent(inout) :: self
        character(*), intent(in) :: name
        real(dp), intent(in) :: value
        integer :: i

        do i = 1, self%count
            if (self%name(i) == name) exit
        end do
        self%count = max(self%count, i)
        self%name(i) = name
        self%value(i) = value
    end subroutine set

    pure function value_of(self, name) result(value)
        !! What a name stands for; no number if it is unknown.
        class(names_t), intent(in) :: self
        character(*), intent(in) :: name
        real(dp) :: value
        integer :: i

        value = ieee_value(value, ieee_quiet_nan)
        do i = 1, self%count
            if (self%name(i) == name) value = self%value(i)
        end do
    end function value_of

    subroutine formula_value(text, names, value, size_of, ok)
        !! The value of the whole text; `size_of` is the same with the moduli of all terms, by which
        !! rounding is judged; not `ok` if something cannot be read.
        character(*), intent(in) :: text
        type(names_t), intent(in) :: names
        real(dp), intent(out) :: value, size_of
        logical, intent(out) :: ok
        integer :: at

        at = 1
        ok = .true.
        call read_sum(trim(text), names, at, value, size_of, ok)
        ok = ok .and. at > len_trim(text)
    end subroutine formula_value

    recursive subroutine read_sum(text, names, at, value, size_of, ok)
        !! Terms with signs between them.
        character(*), intent(in) :: text
        type(names_t), intent(in) :: names
        integer, intent(inout) :: at
        real(dp), intent(out) :: value, size_of
        logical, intent(inout) :: ok
        real(dp) :: term, size_of_term, sign_of

        value = 0.0_dp
        size_of = 0.0_dp
        sign_of = 1.0_dp
        call skip_blanks(text, at)
        if (next(text, at) == "-") then
            sign_of = -1.0_dp
            at = at + 1
        else if (next(text, at) == "+") then
            at = at + 1
        end if
        do
            call read_product(text, names, at, term, size_of_term, ok)
            if (.not. ok) return
            value = value + sign_of*term
            size_of = size_of + size_of_term
            select case (next(text, at))
            case ("+"); sign_of = 1.0_dp
            case ("-"); sign_of = -1.0_dp
            case default; return
            end select
            at = at + 1
        end do
    end subroutine read_sum

    recursive subroutine read_product(text, names, at, value, size_of, ok)
        !! Factors side by side, or with `*` or `/` between them.
        character(*), intent(in) :: text
        type(names_t), intent(in) :: names
        integer, intent(inout) :: at
        real(dp), intent(out) :: value, size_of
        logical, intent(inout) :: ok
        real(dp) :: factor, size_of_factor
        logical :: divide

        value = 1.0_dp
        size_of = 1.0_dp
        divide = .false.
        do
            call read_power(text, names, at, factor, size_of_factor, ok)
            if (.not. ok) return
            if (divide) then
                value = value/factor
                size_of = size_of/abs(factor)
            else
                value = value*factor
                size_of = size_of*size_of_factor
            end if
            call skip_blanks(text, at)
            if (at > len(text)) return
            if (scan(text(at:at), "+-)=,|>") == 1) return
            divide = text(at:at) == "/"
            if (scan(text(at:at), "*/") == 1) at = at + 1
        end do
    end subroutine read_product

    recursive subroutine read_power(text, names, at, value, size_of, ok)
        !! A number, a name, a function or a bracket, perhaps to a whole power.
        character(*), intent(in) :: text
        type(names_t), intent(in) :: names
        integer, intent(inout) :: at
        real(dp), intent(out) :: value, size_of
        logical, intent(inout) :: ok
        character(4), parameter :: functions(7) = ["sinh", "cosh", "sin ", "cos ", "exp ", &
                                                 "sqrt", "    "]
        integer :: i, length, digits

        value = 0.0_dp
        size_of = 0.0_dp
        call skip_blanks(text, at)
        i = names%longest(text(min(at, len(text) + 1):))
        digits = verify(text(min(at, len(text) + 1):)//"x", "0123456789.") - 1
        if (i > 0) then
            value = names%value(i)
            size_of = abs(value)
            at = at + len_trim(names%name(i))
        else if (digits > 0) then
            read (text(at:at + digits - 1), *) value
            size_of = value
            at = at + digits
        else
            do i = 1, size(functions)
                length = len_trim(functions(i))
                if (index(text(min(at, len(text) + 1):), trim(functions(i))//"(") == 1) exit
            end do
            if (i > size(functions)) then
                ok = .false.
                return
            end if
            at = at + length + 1
            call read_sum(text, names, at, value, size_of, ok)
            if (.not. ok) return
            ok = next(text, at) == ")"
            at = at + 1
            select case (functions(i))
            case ("sin"); value = sin(value)
            case ("cos"); value = cos(value)
            case ("exp"); value = exp(value)
            case ("cosh"); value = cosh(value)
            case ("sinh"); value = sinh(value)
            case ("sqrt"); value = sqrt(value)
            case default; continue  ! a bracket
            end select
            if (length > 0) size_of = max(1.0_dp, abs(value))
        end if
        if (next(text, at) /= "^") return
        digits = verify(text(at + 1:)//"x", "0123456789") - 1
        ok = ok .and. digits == 1
        if (.not. ok) return
        read (text(at + 1:at + 1), *) i
        value = value**i
        size_of = size_of**i
        at = at + 2
    end subroutine read_power

    pure subroutine skip_blanks(text, at)
        !! To the next character that is not a blank.
        character(*), intent(in) :: text
        integer, intent(inout) :: at

        do while (next(text, at) == " " .and. at <= len(text))
            at = at + 1
        end do
    end subroutine skip_blanks

    pure function next(text, at) result(symbol)
        !! The character at a place, a blank behind the end.
        character(*), intent(in) :: text
        integer, intent(in) :: at
        character :: symbol

        symbol = " "
        if (at <= len(text)) symbol = text(at:at)
    end function next

    pure function longest(self, text) result(which)
        !! The longest name that the text begins with, as a whole word; 0 if there is none.
        class(names_t), intent(in) :: self
        character(*), intent(in) :: text
        integer :: which, i, length
        character(*), parameter :: inside = "abcdefghijklmnopqrstuvwxyz_0123456789"// &
                                            "ABCDEFGHIJKLMNOPQRSTUVWXYZ"

        which = 0
        do i = 1, self%count
            length = len_trim(self%name(i))
            if (length > len(text)) cycle
            if (text(:length) /= self%name(i)) cycle
            if (length < len(text)) then
                if (scan(text(length:length), inside) == 1 .and. &
                    scan(text(length + 1:length + 1), inside) == 1) cycle
            end if
            if (which > 0) then
                if (length <= len_trim(self%name(which))) cycle
            end if
            which = i
        end do
    end function longest
end module formula
