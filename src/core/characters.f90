module lagrangia_characters
    !! Characters beyond ASCII: those that look like plain ones, which word processors and web pages
    !! put in the place of what was typed, and those that no terminal should receive.
    implicit none (type, external)
    private
    public :: characters, decode, described, is_control, plainly, printable, unlike

    type :: lookalike_t
        integer :: code = 0         !! Unicode's number
        character(3) :: plain = ""  !! what to type
        integer :: length = 1       !! of that
    end type lookalike_t

    type(lookalike_t), parameter :: lookalikes(*) = [ &
        lookalike_t(int(z"00A0"), " "), lookalike_t(int(z"2009"), " "), &
        lookalike_t(int(z"202F"), " "), lookalike_t(int(z"3000"), " "), &
        lookalike_t(int(z"200B"), "", 0), lookalike_t(int(z"FEFF"), "", 0), &
        lookalike_t(int(z"2010"), "-"), lookalike_t(int(z"2011"), "-"), &
        lookalike_t(int(z"2012"), "-"), lookalike_t(int(z"2013"), "-"), &
        lookalike_t(int(z"2014"), "-"), lookalike_t(int(z"2212"), "-"), &
        lookalike_t(int(z"2018"), "'"), lookalike_t(int(z"2019"), "'"), &
        lookalike_t(int(z"201A"), "'"), lookalike_t(int(z"201C"), """"), &
        lookalike_t(int(z"201D"), """"), lookalike_t(int(z"201E"), """"), &
        lookalike_t(int(z"00B7"), "*"), lookalike_t(int(z"00D7"), "*"), &
        lookalike_t(int(z"22C5"), "*"), lookalike_t(int(z"00F7"), "/"), &
        lookalike_t(int(z"2044"), "/"), lookalike_t(int(z"FF0C"), ","), &
        lookalike_t(int(z"FF1D"), "="), lookalike_t(int(z"00B0"), "deg", 3), &
        lookalike_t(int(z"00BA"), "deg", 3), lookalike_t(int(z"03C0"), "pi", 2)]

contains

    pure function described(text, position) result(words)
        !! The character at `position` of a text in UTF-8: `U+2212`, `byte \xFF` where it is none.
        character(*), intent(in) :: text  !! UTF-8, perhaps
        integer, intent(in) :: position   !! of its first byte
        character(:), allocatable :: words
        character(9) :: buffer
        integer :: code, length

        call decode(text, position, code, length)
        if (code >= 65536) then
            write (buffer, "('U+', z6.6)") code
        else if (code >= 0) then
            write (buffer, "('U+', z4.4)") code
        else
            write (buffer, "('byte \x', z2.2)") ichar(text(position:position))
        end if
        words = trim(buffer)
    end function described

    pure function characters(text) result(number)
        !! How many characters `text` has: its bytes but those that continue one.
        character(*), intent(in) :: text  !! UTF-8, perhaps
        integer :: number
        integer :: i

        number = count([(iand(ichar(text(i:i)), 192) /= 128, i=1, len(text))])
    end function characters

    pure function plainly(text) result(plain)
        !! `text` with plain characters in the place of those that look like them.
        character(*), intent(in) :: text  !! UTF-8, perhaps
        character(:), allocatable :: plain
        character(3*len(text)) :: buffer  ! no character grows to more than three times its bytes
        integer :: code, filled, i, k, length

        filled = 0
        i = 1
        do while (i <= len(text))
            call decode(text, i, code, length)
            k = findloc(lookalikes%code, code, 1)
            if (k > 0) then
                buffer(filled + 1:filled + lookalikes(k)%length) = lookalikes(k)%plain
                filled = filled + lookalikes(k)%length
            else
                buffer(filled + 1:filled + length) = text(i:i + length - 1)
                filled = filled + length
            end if
            i = i + length
        end do
        plain = buffer(:filled)
    end function plainly

    pure function unlike(text) result(problem)
        !! The first character of `text` that only looks plain, and what to do about it: `U+2212 is
        !! no plain '-'`; empty where there is none.
        character(*), intent(in) :: text  !! UTF-8, perhaps
        character(:), allocatable :: problem
        integer :: code, i, k, length

        problem = ""
        i = 1
        do while (i <= len(text))
            call decode(text, i, code, length)
            k = findloc(lookalikes%code, code, 1)
            i = i + length
            if (k == 0) cycle
            problem = described(text, i - length)
            if (lookalikes(k)%length == 0) then
                problem = problem//" does not show; delete it"
            else if (lookalikes(k)%plain == "'" .or. lookalikes(k)%plain == """") then
                problem = problem//" is no plain quote; write ' or """
            else if (lookalikes(k)%plain == " ") then
                problem = problem//" is no plain blank"
            else
                problem = problem//" is no plain '"//lookalikes(k)%plain(:lookalikes(k)%length)//"'"
            end if
            return
        end do
    end function unlike

    pure function printable(text) result(shown)
        !! `text` as one line in valid UTF-8: a byte of a control character, or one that is no
        !! UTF-8, becomes `\xNN`. All else stays as it is.
        character(*), intent(in) :: text  !! any bytes
        character(:), allocatable :: shown
        character(16), parameter :: hex = "0123456789ABCDEF"
        character(:), allocatable :: buffer
        integer :: byte, code, filled, i, k, length

        shown = text
        do i = 1, len(text)
            if (ichar(text(i:i)) < 32 .or. ichar(text(i:i)) > 126) exit
        end do
        if (i > len(text)) return
        allocate (character(4*len(text)) :: buffer)
        filled = 0
        i = 1
        do while (i <= len(text))
            call decode(text, i, code, length)
            if (code >= 0 .and. .not. is_control(code)) then
                buffer(filled + 1:filled + length) = text(i:i + length - 1)
                filled = filled + length
            else
                do k = i, i + length - 1
                    byte = ichar(text(k:k))
                    buffer(filled + 1:filled + 4) = "\x"//hex(byte/16 + 1:byte/16 + 1)// &
                                                    hex(mod(byte, 16) + 1:mod(byte, 16) + 1)
                    filled = filled + 4
                end do
            end if
            i = i + length
        end do
        shown = buffer(:filled)
    end function printable

    pure function is_control(code) result(yes)
        !! Does the character with Unicode's number `code` control a terminal (C0, DEL, C1), end a
        !! line, or turn the direction of what follows? Source: Unicode 15, sec. 23.1, 23.2.
        integer, intent(in) :: code  !! Unicode's number
        logical :: yes

        select case (code)
        case (0:31, 127:159, int(z"061C"), int(z"200E"):int(z"200F"), &
              int(z"2028"):int(z"202E"), int(z"2066"):int(z"2069"))
            yes = .true.
        case default
            yes = .false.
        end select
    end function is_control

    pure subroutine decode(text, position, code, length)
        !! Unicode's number of the character at `position`, -1 where its bytes are no UTF-8; and
        !! how many bytes it has, 1 where they are none. Source: RFC 3629.
        character(*), intent(in) :: text      !! holds `position`
        integer, intent(in) :: position       !! of the first byte
        integer, intent(out) :: code, length  !! Unicode's number or -1, and bytes
        integer, parameter :: least(4) = [0, int(z"80"), int(z"800"), int(z"10000")]
        integer :: byte, i

        byte = ichar(text(position:position))
        code = byte
        length = 1
        if (byte < 128) return
        length = count(byte >= [192, 224, 240]) + 1
        code = -1
        if (length == 1 .or. byte >= 248 .or. position + length - 1 > len(text)) then
            length = 1
            return
        end if
        code = iand(byte, 2**(7 - length) - 1)
        do i = position + 1, position + length - 1
            byte = ichar(text(i:i))
            if (byte < 128 .or. byte >= 192) then
                code = -1
                length = 1
                return
            end if
            code = 64*code + byte - 128
        end do
        if (code >= least(length) .and. code <= int(z"10FFFF") .and. &
            .not. (code >= int(z"D800") .and. code <= int(z"DFFF"))) return
        code = -1  ! an overlong form, half of a pair of UTF-16, or beyond Unicode
        length = 1
    end subroutine decode
end module lagrangia_characters
