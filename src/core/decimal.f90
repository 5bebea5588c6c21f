module lagrangia_decimal
    !! Doubles as text, `-1.2345678901234567E+003`: the 24 characters that libgfortran gives for
    !! `es24.16e3`, twenty times faster.
    !!
    !! With \(x = m\,2^e\), \(2^{52} \le m < 2^{53}\), and \(k = \lfloor\log_{10} x\rfloor\) the 17
    !! digits are \(y = x\,10^{16-k}\), rounded to the nearest integer. The power of ten is known
    !! to 118 bits, as \(10^{26c}\) from a table times \(10^r\), so \(y\) is known to \(2^{-54}\).
    !! Where it lies closer than that to the middle between two integers, as a tie does,
    !! libgfortran decides.
    use, intrinsic :: iso_fortran_env, only: real64
    use lagrangia_kinds, only: i8
    implicit none (type, external)
    private
    public :: decimal_width, write_decimal

    integer, parameter :: decimal_width = 24            !! characters of a number
    integer, parameter :: i16 = selected_int_kind(38)   !! 128 bits
    integer, parameter :: limb = 60                     !! bits of one part of a power of ten
    integer(i16), parameter :: mask = 2_i16**limb - 1
    integer, parameter :: step = 26                     !! of the exponents in the table
    integer(i8), parameter :: most = 10_i8**17          !! 17 digits are less than this
    integer, parameter :: exponent_bias = 1075          !! a double is m 2**(exponent - 1075)

    ! The first 120 bits of 10**(26 c), c = -12, ..., 13, cut off, in two parts of 60 bits.
    integer(i8), parameter :: high(-12:13) = [ &
        int(z"BC807527ED3E12B", i8), int(z"F3A20279ED56D48", i8), int(z"9D71AC8FADA6C9B", i8), &
        int(z"CB7DDCDDA26DA26", i8), int(z"8380DEA93DA4BC6", i8), int(z"A9F6D30A038D1DB", i8), &
        int(z"DBAC6C247D62A58", i8), int(z"8DF5EFABC5979C8", i8), int(z"B77ADA0617E3BBC", i8), &
        int(z"ED246723473E381", i8), int(z"993FE2C6D07B7FA", i8), int(z"C612062576589DD", i8), &
        int(z"800000000000000", i8), int(z"A56FA5B99019A5C", i8), int(z"D5D238A4ABE9806", i8), &
        int(z"8A2DBF142DFCC7A", i8), int(z"B2977EE300C50FE", i8), int(z"E6D3102AD96CEC1", i8), &
        int(z"952AB45CFA97A0B", i8), int(z"C0CB28A98FCF3C7", i8), int(z"F92E0C353782614", i8), &
        int(z"A1075A24E442173", i8), int(z"D01FEF10A657842", i8), int(z"867F59A9D4BED6C", i8), &
        int(z"ADD57A27D29339F", i8), int(z"E0ACCFA875AF45A", i8)]
    integer(i8), parameter :: low(-12:13) = [ &
        int(z"CC605083704F5EC", i8), int(z"A6B43527578C111", i8), int(z"56F773FC3603DB4", i8), &
        int(z"8A9942F5DCF7DFD", i8), int(z"04247CB9E59F71E", i8), int(z"C5E9FCF4CCD211F", i8), &
        int(z"3DF45F746B74ABF", i8), int(z"FCA8D3FFA1EF463", i8), int(z"B09CE6EBB401737", i8), &
        int(z"3290123E9AAB23B", i8), int(z"BE546A8038EFE40", i8), int(z"A95364AFE032A81", i8), &
        int(z"000000000000000", i8), int(z"800000000000000", i8), int(z"872A4904598D6D8", i8), &
        int(z"B6E3569326C7843", i8), int(z"758EDEC91EC2CB6", i8), int(z"DA60DC059157491", i8), &
        int(z"2DD945A747BF261", i8), int(z"F84576A1BB416A7", i8), int(z"5A7709A56CCDF8A", i8), &
        int(z"0B24CF65B8612F8", i8), int(z"C2D2B7569B0432D", i8), int(z"049ED8EABCCCC48", i8), &
        int(z"679C5DB9AF1F9B5", i8), int(z"793EB1B80A33B86", i8)]
    integer :: i_power, i_ten
    integer(i8), parameter :: five_to(0:step - 1) = [(5_i8**i_power, i_power=0, step - 1)]
    character(2), parameter :: pairs(0:99) = [ &
        ((achar(48 + i_ten)//achar(48 + i_power), i_power=0, 9), i_ten=0, 9)]

contains

    pure subroutine write_decimal(value, text)
        !! The number as `es24.16e3` has it; NaN and infinity too.
        real(real64), intent(in) :: value                 !! any double
        character(decimal_width), intent(out) :: text     !! its digits, to the right
        integer(i8) :: bits, m, digits
        integer :: e, k
        logical :: certain

        bits = transfer(value, bits)
        m = iand(bits, 2_i8**52 - 1)
        e = int(iand(shiftr(bits, 52), 2047_i8))
        if (e == 2047) then
            call ask_library(value, text)
            return
        end if
        k = 0
        digits = 0
        if (e > 0) then
            m = ior(m, 2_i8**52)
        else if (m > 0) then                            ! subnormal: as many bits as the others
            e = 1 - (leadz(m) - 11)
            m = shiftl(m, leadz(m) - 11)
        end if
        if (m > 0) then
            call find_digits(m, e - exponent_bias, digits, k, certain)
            if (.not. certain) then
                call ask_library(value, text)
                return
            end if
        end if
        call place_digits(bits < 0, digits, k, text)
    end subroutine write_decimal

    pure subroutine find_digits(m, e, digits, k, certain)
        !! The 17 digits of \(m\,2^e\) and its power of ten.
        integer(i8), intent(in) :: m         !! at least 2**52, less than 2**53
        integer, intent(in) :: e             !! power of two
        integer(i8), intent(out) :: digits   !! at least 10**16, less than 10**17
        integer, intent(out) :: k            !! the number is about digits 10**(k - 16)
        logical, intent(out) :: certain      !! false: too close to the middle between two
        integer(i16) :: product, upper
        integer(i8) :: p_high, p_low, fraction, half, last
        integer :: c, power, shift

        k = shifta((e + 52)*78913, 18)       ! floor((e + 52) log10(2)): k or k - 1
        power = 16 - k
        c = (power + 12*step)/step - 12
        ! 10**power = (p_high + p_low/2**60) 2**(power log2(10) rounded down - 59), to 118 bits
        product = int(low(c), i16)*five_to(power - step*c)
        upper = int(high(c), i16)*five_to(power - step*c) + shiftr(product, limb)
        shift = 128 - leadz(upper) - limb
        p_high = int(shiftr(upper, shift), i8)
        p_low = int(iand(shiftl(upper, limb - shift), mask), i8) &
                + int(shiftr(iand(product, mask), shift), i8)
        upper = int(m, i16)*p_high + shiftr(int(m, i16)*p_low, limb)
        shift = 59 - e - shifta(power*217706, 16)
        digits = int(shiftr(upper, shift), i8)
        fraction = int(upper - shiftl(int(digits, i16), shift), i8)
        half = shiftl(1_i8, shift - 1)
        if (digits < most) then
            certain = abs(fraction - half) > 2
            if (fraction > half) digits = digits + 1
        else                                 ! k + 1, and one digit less
            k = k + 1
            last = mod(digits, 10_i8)
            digits = digits/10
            certain = .not. (last == 5 .and. fraction <= 2 .or. &
                             last == 4 .and. fraction >= 2*half - 2)
            if (last >= 5) digits = digits + 1
        end if
        if (digits < most) return
        digits = most/10
        k = k + 1
    end subroutine find_digits

    pure subroutine place_digits(negative, digits, k, text)
        !! `-d.ddddddddddddddddE+ddd`
        logical, intent(in) :: negative
        integer(i8), intent(in) :: digits
        integer, intent(in) :: k
        character(decimal_width), intent(out) :: text
        integer(i8) :: rest
        integer :: eight, i, four, half

        text(1:1) = merge("-", " ", negative)
        rest = mod(digits, most/10)
        text(2:2) = achar(48 + int(digits/(most/10)))
        text(3:3) = "."
        do half = 0, 1
            eight = int(merge(rest/100000000, mod(rest, 100000000_i8), half == 0))
            do i = 0, 1
                four = merge(eight/10000, mod(eight, 10000), i == 0)
                associate (at => 4 + 8*half + 4*i)
                    text(at:at + 1) = pairs(four/100)
                    text(at + 2:at + 3) = pairs(mod(four, 100))
                end associate
            end do
        end do
        text(20:20) = "E"
        text(21:21) = merge("-", "+", k < 0)
        text(22:22) = achar(48 + abs(k)/100)
        text(23:24) = pairs(mod(abs(k), 100))
    end subroutine place_digits

    pure subroutine ask_library(value, text)
        !! libgfortran's own.
        real(real64), intent(in) :: value
        character(decimal_width), intent(out) :: text

        write (text, "(ss, es24.16e3)") value
    end subroutine ask_library
end module lagrangia_decimal
