module lagrangia_number_text
    !! Numbers as text: exactly what gfortran's `es24.16e3` gives, some fifteen times faster.
    !!
    !! The 17 digits of \(x = m 2^e\) are \(D = x\,10^{16-p}\) rounded to an integer. The power of
    !! ten is known to 122 bits, so D is known to within two parts in \(2^{114}\), always from
    !! below; where that does not decide how D is rounded, libgfortran is asked.
    use lagrangia_kinds, only: dp, i8
    use lagrangia_powers_of_ten, only: coarse, coarse_exponent, fine, fine_exponent, limb, step
    implicit none (type, external)
    private
    public :: field_width, number_text, write_csv_row, write_number, write_row

    integer, parameter :: field_width = 24                 !! of a number
    integer, parameter :: wide = selected_int_kind(38)     !! 128 bits, for products
    integer(i8), parameter :: smallest = 10_i8**16         !! D has 17 digits
    integer(wide), parameter :: low_limb = 2_wide**limb - 1
    character(10), parameter :: figures = "0123456789"
    integer :: i, j
    character(2), parameter :: pairs(0:99) = &
        [((figures(i:i)//figures(j:j), j=1, 10), i=1, 10)]

contains

    ! allow(assumed-size-character-intent): nothing is cut
    pure subroutine write_row(values, row, length)
        !! A line of a text table: every value as `es24.16e3`, a blank between two, a newline.
        real(dp), intent(in) :: values(:)
        character(*), intent(inout) :: row  !! at least `(field_width + 1)*size(values)` long
        integer, intent(out) :: length      !! `row(:length)` is the line
        integer :: column

        length = 0
        do column = 1, size(values)
            call write_number(values(column), row(length + 1:length + field_width))
            length = length + field_width + 1
            row(length:length) = " "
        end do
        row(length:length) = new_line("a")
    end subroutine write_row

    ! allow(assumed-size-character-intent): nothing is cut
    pure subroutine write_csv_row(values, row, length)
        !! A line of a comma-separated table: the same digits without padding.
        real(dp), intent(in) :: values(:)
        character(*), intent(inout) :: row  !! at least `(field_width + 1)*size(values)` long
        integer, intent(out) :: length      !! `row(:length)` is the line
        character(field_width) :: field
        integer :: column, first

        length = 0
        do column = 1, size(values)
            call write_number(values(column), field)
            first = verify(field, " ")
            row(length + 1:length + field_width + 2 - first) = field(first:)//","
            length = length + field_width + 2 - first
        end do
        row(length:length) = new_line("a")
    end subroutine write_csv_row

    pure function number_text(x) result(text)
        !! `x` with 17 digits and no blanks, as in `1.0000000000000000E-003`: also a JSON number.
        real(dp), intent(in) :: x
        character(:), allocatable :: text
        character(field_width) :: field

        call write_number(x, field)
        text = trim(adjustl(field))
    end function number_text

    pure subroutine write_number(x, field)
        !! `x` as `es24.16e3`.
        real(dp), intent(in) :: x
        character(field_width), intent(out) :: field
        integer(i8) :: bits, m, digits
        integer :: e, p
        logical :: certain

        bits = transfer(x, bits)
        m = ibits(bits, 0, 52)
        e = int(ibits(bits, 52, 11))
        if (e == 0 .and. m == 0) then
            call write_digits(0_i8, 0, bits < 0, field)
            return
        end if
        if (e == 2047) then  ! infinite or not a number
            write (field, "(es24.16e3)") x
            return
        end if
        if (e == 0) then  ! denormal: m is shifted up until it has 53 bits
            p = leadz(m) - 11
            m = shiftl(m, p)
            e = 1 - p
        else
            m = ibset(m, 52)
        end if
        call find_digits(m, e - 1075, digits, p, certain)
        if (certain) then
            call write_digits(digits, p, bits < 0, field)
        else
            write (field, "(es24.16e3)") x
        end if
    end subroutine write_number

    pure subroutine find_digits(m, e, digits, p, certain)
        !! Round \(m 2^e\) to \(D\,10^{p-16}\) with 17 digits in D.
        integer(i8), intent(in) :: m       !! 53 bits
        integer, intent(in) :: e
        integer(i8), intent(out) :: digits
        integer, intent(out) :: p
        logical, intent(out) :: certain    !! false if D may be one too large or too small
        integer(wide) :: ten, product, rest, half
        integer :: k, j, r

        ! floor(log10) of a number between 2**(e + 52) and 2**(e + 53), or one less
        p = int(shifta(78913_i8*(e + 52), 18))
        do
            k = 16 - p
            j = shifta(k, 4)
            k = k - step*j
            ! ten = 10**(16 - p) with 2*limb or one fewer bits, at most 2 too small
            ten = int(coarse(1, j), wide)*fine(k) + shiftr(int(coarse(2, j), wide)*fine(k), limb)
            ! product = m*10**(16 - p), at most 2 too small
            product = int(m, wide)*int(shiftr(ten, limb), i8) &
                      + shiftr(int(m, wide)*int(iand(ten, low_limb), i8), limb)
            r = -(coarse_exponent(j) + fine_exponent(k) + 2*limb + e)
            digits = int(shiftr(product, r), i8)
            if (digits < 10*smallest) exit
            p = p + 1
        end do
        half = shiftl(1_wide, r - 1)
        rest = product - shiftl(int(digits, wide), r)
        certain = rest + 2 <= half .or. rest > half
        if (rest > half) digits = digits + 1
        if (digits == 10*smallest) then
            digits = smallest
            p = p + 1
        end if
    end subroutine find_digits

    pure subroutine write_digits(digits, p, negative, field)
        !! Set `field` to the number with these 17 digits, times \(10^{p-16}\).
        integer(i8), intent(in) :: digits
        integer, intent(in) :: p
        logical, intent(in) :: negative
        character(field_width), intent(out) :: field
        integer :: upper, lower, first, k

        first = int(digits/smallest)
        upper = int(mod(digits/10_i8**8, 10_i8**8))
        lower = int(mod(digits, 10_i8**8))
        field(1:1) = merge("-", " ", negative)
        field(2:2) = achar(iachar("0") + first)
        field(3:3) = "."
        do k = 10, 4, -2
            field(k:k + 1) = pairs(mod(upper, 100))
            upper = upper/100
            field(k + 8:k + 9) = pairs(mod(lower, 100))
            lower = lower/100
        end do
        field(20:20) = "E"
        field(21:21) = merge("-", "+", p < 0)
        field(22:22) = achar(iachar("0") + abs(p)/100)
        field(23:24) = pairs(mod(abs(p), 100))
    end subroutine write_digits
end module lagrangia_number_text
