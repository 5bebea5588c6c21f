module lagrangia_text
    !! Small helpers for text: what messages, headers and scene files need.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_is_nan
    use lagrangia_characters, only: decode, printable
    use lagrangia_kinds, only: dp, i8
    implicit none (type, external)
    private
    public :: word_t
    public :: append_word, escaped, in_words, join, listed, lower, quoted, replaced, short_source
    public :: shortened, source_length, to_text

    integer, parameter :: source_length = 100  !! of what `short_source` gives

    type :: word_t
        !! A text of its own length, for lists.
        character(:), allocatable :: text
    end type word_t

    interface to_text
        !! A number as the shortest plain text that reads back to the same number.
        module procedure integer_to_text
        module procedure int64_to_text
        module procedure real_to_text
    end interface to_text

contains

    pure subroutine append_word(list, text)
        !! One more text at the end of a list.
        type(word_t), allocatable, intent(inout) :: list(:)  !! none yet if not allocated
        character(*), intent(in) :: text                     !! any bytes
        type(word_t), allocatable :: longer(:)
        integer :: i, n

        n = 0
        if (allocated(list)) n = size(list)
        allocate (longer(n + 1))
        do i = 1, n
            call move_alloc(list(i)%text, longer(i)%text)
        end do
        longer(n + 1)%text = text
        call move_alloc(longer, list)
    end subroutine append_word

    pure function lower(text) result(small)
        !! `text` with the letters A to Z in lower case; other bytes stay.
        character(*), intent(in) :: text  !! any bytes
        character(len(text)) :: small
        integer :: i

        small = text
        do i = 1, len(text)
            if (text(i:i) >= "A" .and. text(i:i) <= "Z") small(i:i) = achar(iachar(text(i:i)) + 32)
        end do
    end function lower

    pure function join(names, separator) result(text)
        !! The trimmed names in a row with `separator` between them.
        character(*), intent(in) :: names(:), separator  !! blanks at their ends do not count
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
        !! `text` fit for a message: control characters and bytes that are no UTF-8 as `\xNN`, and
        !! cut to `limit` bytes (40 unless given) with `...` behind; no character is split.
        character(*), intent(in) :: text        !! any bytes
        integer, intent(in), optional :: limit  !! in bytes, 40 unless given
        character(:), allocatable :: shown
        character(:), allocatable :: buffer, one
        integer :: code, i, length, most, width

        most = 40
        if (present(limit)) most = limit
        allocate (character(most + 16) :: buffer)
        length = 0
        i = 1
        do while (i <= len(text))
            call decode(text, i, code, width)
            one = printable(text(i:i + width - 1))
            if (length + len(one) > most) then
                shown = buffer(:length)//"..."
                return
            end if
            buffer(length + 1:length + len(one)) = one
            length = length + len(one)
            i = i + width
        end do
        shown = buffer(:length)
    end function escaped

    pure function quoted(text, limit) result(shown)
        !! `escaped` text between single quotes.
        character(*), intent(in) :: text        !! any bytes
        integer, intent(in), optional :: limit  !! of `escaped`
        character(:), allocatable :: shown

        shown = "'"//escaped(text, limit)//"'"
    end function quoted

    pure function short_source(source) result(shown)
        !! `source` fit for a message, a blank at either end as `\x20`; of a long one the end is
        !! kept.
        character(*), intent(in) :: source        !! a file's name, with any bytes
        character(source_length) :: shown
        character(:), allocatable :: full
        integer :: first, length

        full = escaped(source, 4*len(source))
        if (len_trim(full) < len(full)) full = full(:len(full) - 1)//"\x20"
        if (index(full, " ") == 1) full = "\x20"//full(2:)
        length = len(full)
        if (length > source_length) then
            first = length - source_length + 4
            do while (continues(full(first:first)))
                first = first + 1
            end do
            full = "..."//full(first:)
        end if
        shown = full
    end function short_source

    pure function shortened(text, most) result(short)
        !! `text` in at most `most` bytes: what is longest between blanks (a path, a value) loses
        !! its middle to `...`, and then the text as a whole.
        character(*), intent(in) :: text  !! UTF-8, perhaps
        integer, intent(in) :: most       !! in bytes, at least 7
        character(:), allocatable :: short
        integer, parameter :: spared = 40  !! bytes of a word
        integer :: first, last, length, start

        short = text
        do while (len(short) > most)
            first = 1
            last = 0
            start = 1
            do while (start <= len(short))
                length = index(short(start:)//" ", " ") - 1
                if (length > last - first + 1) then
                    first = start
                    last = start + length - 1
                end if
                start = start + length + 1
            end do
            length = last - first + 1
            if (length <= spared) exit
            length = max(spared, length - (len(short) - most))
            short = short(:first - 1)//without_middle(short(first:last), length)//short(last + 1:)
        end do
        if (len(short) > most) short = without_middle(short, most)
    end function shortened

    pure function without_middle(text, most) result(short)
        !! A third of `most` bytes from the start of `text`, `...`, and the end; no UTF-8 is split.
        character(*), intent(in) :: text
        integer, intent(in) :: most
        character(:), allocatable :: short
        integer :: head, tail

        head = (most - 3)/3
        tail = len(text) - (most - 3 - head) + 1
        do while (head > 0 .and. continues(text(head + 1:head + 1)))
            head = head - 1
        end do
        do while (tail < len(text) .and. continues(text(tail:tail)))
            tail = tail + 1
        end do
        short = text(:head)//"..."//text(tail:)
    end function without_middle

    pure function continues(byte) result(yes)
        !! Is it inside a character of UTF-8?
        character(1), intent(in) :: byte
        logical :: yes

        yes = ichar(byte) >= 128 .and. ichar(byte) < 192
    end function continues

    pure function integer_to_text(number) result(text)
        !! A default integer in decimal.
        integer, intent(in) :: number  !! any
        character(:), allocatable :: text

        text = int64_to_text(int(number, i8))
    end function integer_to_text

    pure function int64_to_text(number) result(text)
        !! A 64-bit integer in decimal.
        integer(i8), intent(in) :: number  !! any
        character(:), allocatable :: text
        character(24) :: buffer

        write (buffer, "(ss, i0)") number
        text = trim(buffer)
    end function int64_to_text

    pure function real_to_text(number) result(text)
        !! The shortest text that reads back to the same double, for namelists and Python alike:
        !! `0.01`, `9.81`, `20.0`, `1.5e-7`; `nan`, `inf` and `-inf` where there is no number.
        real(dp), intent(in) :: number  !! any double
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
            write (layout, "(ss, a, i0, a)") "(ss, es32.", digits - 1, "e3)"
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

    pure function listed(names, most, whole) result(text)
        !! The names with commas between; where they are longer than `most`, those that there is
        !! room for, and where all of them stand: `t, x, ...; 'lagrangia describe wedge' has all`.
        character(*), intent(in) :: names(:)  !! trailing blanks do not count
        integer, intent(in) :: most           !! bytes of the names
        character(*), intent(in) :: whole     !! the command that shows all
        character(:), allocatable :: text
        integer :: last

        text = join(names, ", ")
        if (len(text) <= most) return
        last = index(text(:most), ", ", back=.true.)
        text = text(:merge(last + 1, 0, last > 0))//"...; '"//whole//"' has all"
    end function listed

    pure function in_words(name) result(words)
        !! `double pendulum` of `double_pendulum`, `bare` of `_bare`: a name in a title.
        character(*), intent(in) :: name  !! trailing blanks do not count
        character(:), allocatable :: words

        words = trim(adjustl(replaced(trim(name), "_", " ")))
    end function in_words

    pure function replaced(text, old, new) result(changed)
        !! `text` with another character in each place of one.
        character(*), intent(in) :: text  !! any
        character, intent(in) :: old      !! what goes
        character, intent(in) :: new      !! what comes
        character(len(text)) :: changed
        integer :: i

        changed = text
        do i = 1, len(text)
            if (text(i:i) == old) changed(i:i) = new
        end do
    end function replaced
end module lagrangia_text
