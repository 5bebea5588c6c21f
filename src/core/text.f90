module lagrangia_text
    !! Small helpers for text: what messages, headers and scene files need.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_is_nan
    use lagrangia_kinds, only: dp, i8
    implicit none (type, external)
    private
    public :: escaped, join, lower, nearest_name, quoted, to_text

    interface to_text
        !! A number as the shortest plain text that reads back to the same number.
        module procedure integer_to_text
        module procedure int64_to_text
        module procedure real_to_text
    end interface to_text

contains

    pure function lower(text) result(small)
        !! `text` with the letters A to Z in lower case; other bytes stay.
        character(*), intent(in) :: text
        character(len(text)) :: small
        integer :: i

        small = text
        do i = 1, len(text)
            if (text(i:i) >= "A" .and. text(i:i) <= "Z") small(i:i) = achar(iachar(text(i:i)) + 32)
        end do
    end function lower

    pure function join(names, separator) result(text)
        !! The trimmed names in a row with `separator` between them.
        character(*), intent(in) :: names(:), separator
        character(:), allocatable :: text
        integer :: i, length, position

        length = sum(len_trim(names)) + max(0, size(names) - 1)*len(separator)
        allocate (character(length) :: text)
        position = 0
        do i = 1, size(names)
            if (i > 1) then
                text(position + 1:position + len(separator)) = separator
                position = position + len(separator)
            end if
            text(position + 1:position + len_trim(names(i))) = trim(names(i))
            position = position + len_trim(names(i))
        end do
    end function join

    pure function escaped(text, limit) result(shown)
        !! `text` fit for a message: control and non-ASCII bytes as `\xNN`, and cut to `limit`
        !! characters (40 unless given) with `...` behind.
        character(*), intent(in) :: text
        integer, intent(in), optional :: limit
        character(:), allocatable :: shown
        character(16), parameter :: hex = "0123456789ABCDEF"
        character(:), allocatable :: buffer
        integer :: byte, i, length, most

        most = 40
        if (present(limit)) most = limit
        allocate (character(most + 7) :: buffer)
        length = 0
        do i = 1, len(text)
            byte = ichar(text(i:i))
            if (byte >= 32 .and. byte < 127) then
                buffer(length + 1:length + 1) = text(i:i)
                length = length + 1
            else
                buffer(length + 1:length + 4) = "\x"//hex(byte/16 + 1:byte/16 + 1)// &
                                                hex(mod(byte, 16) + 1:mod(byte, 16) + 1)
                length = length + 4
            end if
            if (length > most) exit
        end do
        if (length > most) then
            shown = buffer(:most)//"..."
        else
            shown = buffer(:length)
        end if
    end function escaped

    pure function quoted(text, limit) result(shown)
        !! `escaped` text between single quotes.
        character(*), intent(in) :: text
        integer, intent(in), optional :: limit
        character(:), allocatable :: shown

        shown = "'"//escaped(text, limit)//"'"
    end function quoted

    pure function nearest_name(name, candidates) result(best)
        !! The candidate most like `name`, whatever the case; empty when none is near.
        !!
        !! Near means: at most one slip for names up to three letters, two up to six, else three,
        !! and something of the name must be left.
        character(*), intent(in) :: name, candidates(:)
        character(:), allocatable :: best
        integer, parameter :: longest = 63
        integer :: distance, i, length, least

        best = ""
        length = len_trim(name)
        if (length == 0 .or. length > longest) return
        least = min(3, 1 + (length - 1)/3) + 1
        do i = 1, size(candidates)
            if (abs(len_trim(candidates(i)) - length) >= least) cycle
            distance = edits(lower(trim(name)), lower(trim(candidates(i))))
            if (distance < least .and. distance < max(length, len_trim(candidates(i)))) then
                least = distance
                best = trim(candidates(i))
            end if
        end do
    end function nearest_name

    pure function edits(a, b) result(distance)
        !! Insertions, deletions, substitutions and swaps of neighbours between `a` and `b`:
        !! the Damerau-Levenshtein distance without edits inside a swapped pair.
        character(*), intent(in) :: a, b
        integer :: distance
        integer :: d(0:len(a), 0:len(b)), i, j

        d(:, 0) = [(i, i=0, len(a))]
        d(0, :) = [(j, j=0, len(b))]
        do j = 1, len(b)
            do i = 1, len(a)
                d(i, j) = min(d(i - 1, j) + 1, d(i, j - 1) + 1, &
                              d(i - 1, j - 1) + merge(0, 1, a(i:i) == b(j:j)))
                if (min(i, j) < 2) cycle
                if (a(i:i) == b(j - 1:j - 1) .and. a(i - 1:i - 1) == b(j:j)) then
                    d(i, j) = min(d(i, j), d(max(i - 2, 0), max(j - 2, 0)) + 1)
                end if
            end do
        end do
        distance = d(len(a), len(b))
    end function edits

    pure function integer_to_text(number) result(text)
        !! A default integer in decimal.
        integer, intent(in) :: number
        character(:), allocatable :: text

        text = int64_to_text(int(number, i8))
    end function integer_to_text

    pure function int64_to_text(number) result(text)
        !! A 64-bit integer in decimal.
        integer(i8), intent(in) :: number
        character(:), allocatable :: text
        character(24) :: buffer

        write (buffer, "(i0)") number
        text = trim(buffer)
    end function int64_to_text

    pure function real_to_text(number) result(text)
        !! The shortest text that reads back to the same double, for namelists and Python alike:
        !! `0.01`, `9.81`, `20.0`, `1.5e-7`; `nan`, `inf` and `-inf` where there is no number.
        real(dp), intent(in) :: number
        character(:), allocatable :: text
        character(32) :: buffer, layout
        real(dp) :: back
        integer :: digits, exponent, ios

        if (.not. ieee_is_finite(number)) then
            text = merge("nan", "inf", ieee_is_nan(number))
            if (number < 0.0_dp) text = "-inf"
            return
        end if
        ! fifteen digits survive a normal double, so a shorter text is those without its zeros
        do digits = merge(1, 15, abs(number) < tiny(number)), 17
            write (layout, "(a, i0, a)") "(es32.", digits - 1, "e3)"
            write (buffer, layout) abs(number)
            read (buffer, *, iostat=ios) back
            if (ios == 0 .and. .not. abs(back - abs(number)) > 0.0_dp) exit
        end do
        buffer = adjustl(buffer)
        read (buffer(index(buffer, "E") + 1:), *) exponent
        text = positional(buffer(1:1)//buffer(3:index(buffer, "E") - 1), exponent)
        if (sign(1.0_dp, number) < 0.0_dp) text = "-"//text
    end function real_to_text

    pure function positional(digits, exponent) result(text)
        !! `d.ddd` times ten to `exponent`, written without a power where that is short.
        character(*), intent(in) :: digits
        integer, intent(in) :: exponent
        character(:), allocatable :: text
        integer :: last

        last = max(1, verify(digits, "0", back=.true.))
        if (exponent < -4 .or. exponent > 15) then
            text = digits(1:1)
            if (last > 1) text = text//"."//digits(2:last)
            text = text//"e"//integer_to_text(exponent)
        else if (exponent < 0) then
            text = "0."//repeat("0", -exponent - 1)//digits(:last)
        else if (last <= exponent + 1) then
            text = digits(:last)//repeat("0", exponent + 1 - last)//".0"
        else
            text = digits(:exponent + 1)//"."//digits(exponent + 2:last)
        end if
    end function positional
end module lagrangia_text
