module lagrangia_formula_characters
    !! A typed formula in plain letters: Greek letters by their names, and what word processors, web
    !! pages and equation editors make of signs, blanks, indices, squares and fractions.
    use lagrangia_characters, only: decode, described, is_control
    use lagrangia_errors, only: error_t, fail
    use lagrangia_latex_source, only: plain_latex
    use lagrangia_letter_shapes, only: dot, is_letter_shape, letter_shape, two_dots
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: plain_formula, plain_letters

    character(*), parameter :: digits = "0123456789", lower = "abcdefghijklmnopqrstuvwxyz"
    character(*), parameter :: upper = "ABCDEFGHIJKLMNOPQRSTUVWXYZ"

contains

    pure subroutine plain_formula(text, plain, columns, error)
        !! `text` in plain letters, and the column of `text` that each of them comes from.
        character(*), intent(in) :: text                  !! UTF-8, perhaps
        character(:), allocatable, intent(out) :: plain   !! ASCII without control characters
        integer, allocatable, intent(out) :: columns(:)   !! in characters from 1, (len(plain))
        type(error_t), allocatable, intent(out) :: error  !! a character that no formula has
        character(8*len(text) + 1) :: buffer  ! a half has six characters for two bytes
        character(:), allocatable :: meant
        integer :: begun, code, column, filled, i, length
        logical :: alone, known, raised, signed

        allocate (columns(len(buffer)))
        filled = 0
        column = 0
        raised = .false.  ! within an exponent
        signed = .false.  ! which begins with a sign
        alone = .false.   ! behind a letter that is a name
        i = 1
        do while (i <= len(text))
            column = column + 1
            call decode(text, i, code, length)
            begun = 0
            if (code == int(z"00B0") .or. code == int(z"00BA")) begun = place_of_angle( &
                buffer(:filled))
            if (begun > 0) then  ! 45° is (45 pi/180)
                buffer(begun:filled + 1) = "("//buffer(begun:filled)
                columns(begun + 1:filled + 1) = columns(begun:filled)
                filled = filled + 1
            end if
            if (superscript(code) /= "") then
                meant = superscript(code)
                if (.not. raised) then
                    signed = digit(code) == ""
                    if (signed) meant = "("//meant
                    meant = "^"//meant
                end if
                raised = .true.
            else
                call spell(code, meant, known)
                if (index(meant, "/") > 1 .and. follows(digits)) known = .false.  ! 2 1/2
                if (begun > 0) then
                    meant = " pi/180)"
                    known = .true.
                end if
                if (.not. known) then
                    call fail(error, "column "//to_text(column)//": "//described(text, i)// &
                              advice(code))
                    return
                end if
                if (scan(meant, lower//upper) == 1) then  ! 2 pi r, m theta, x_dot m
                    if (follows(dot//two_dots) .or. stands_alone(code) .and. &
                        follows(digits//lower//upper) .and. .not. follows("d") .or. &
                        alone .and. follows(lower//upper)) meant = " "//meant
                end if
                alone = stands_alone(code)
                if (raised) meant = merge(") ", "  ", signed)//meant
                raised = .false.
            end if
            buffer(filled + 1:filled + len(meant)) = meant
            columns(filled + 1:filled + len(meant)) = column
            filled = filled + len(meant)
            i = i + length
        end do
        plain = buffer(:filled)
        columns = columns(:filled)
        if (raised .and. signed) then
            plain = plain//")"
            columns = [columns, column]
        end if
        if (scan(plain, dot//two_dots) > 0) call place_dots(plain, columns)
        call plain_latex(plain, columns, error)
    contains
        pure function follows(letters) result(yes)
            character(*), intent(in) :: letters
            logical :: yes

            yes = scan(buffer(max(filled, 1):filled), letters) > 0
        end function follows
    end subroutine plain_formula

    pure function place_of_angle(text) result(place)
        !! In front of the digits at the end of a text, where they are a multiple of 15 degrees,
        !! which nobody rounds; 0: they are not.
        character(*), intent(in) :: text  !! in plain letters
        integer :: place
        integer :: angle, before, status

        place = 0
        before = verify(text, digits, back=.true.)
        if (before == len(text) .or. len(text) - before > 3) return
        if (scan(text(max(1, before):before), lower//upper//"_.^") > 0) return
        read (text(before + 1:), *, iostat=status) angle
        if (status == 0 .and. mod(angle, 15) == 0) place = before + 1
    end function place_of_angle

    pure function plain_letters(text) result(plain)
        !! In plain letters, `theta` for the Greek one; as it is where a character has no meaning.
        character(*), intent(in) :: text  !! UTF-8, perhaps
        character(:), allocatable :: plain
        integer, allocatable :: columns(:)
        type(error_t), allocatable :: error

        call plain_formula(text, plain, columns, error)
        if (allocated(error)) plain = text
    end function plain_letters

    pure function stands_alone(code) result(yes)
        !! Is it a letter that is a name, or begins one? Not so the wide ones, ligatures, and the
        !! signs of a derivative.
        integer, intent(in) :: code
        logical :: yes

        yes = is_letter_shape(code) .and. code < int(z"FB00") .or. code >= int(z"1D400")
        if (code == int(z"2202")) yes = .false.
    end function stands_alone

    pure subroutine place_dots(plain, columns)
        !! A dot becomes `_dot` behind the index that follows: `theta_1_dot`.
        character(:), allocatable, intent(inout) :: plain
        integer, allocatable, intent(inout) :: columns(:)
        character(*), parameter :: index_letters = digits//"_"//lower//upper
        character(:), allocatable :: rate
        integer :: at, last

        do
            at = scan(plain, dot//two_dots)
            if (at == 0) return
            rate = merge("_dot ", "_ddot", plain(at:at) == dot)
            if (scan(plain(at + 1:), "_") == 1) then
                last = at + verify(plain(at + 1:)//" ", index_letters) - 1
            else
                last = at + verify(plain(at + 1:)//" ", digits) - 1
            end if
            columns = [columns(:at - 1), columns(at + 1:last), spread(columns(at), 1, &
                                                                      len_trim(rate)), &
                       columns(last + 1:)]
            plain = plain(:at - 1)//plain(at + 1:last)//trim(rate)//plain(last + 1:)
        end do
    end subroutine place_dots

    pure subroutine spell(code, plain, known)
        !! What a character stands for.
        integer, intent(in) :: code
        character(:), allocatable, intent(out) :: plain  !! perhaps nothing
        logical, intent(out) :: known                    !! it has a meaning

        known = .true.
        select case (code)
        case (32:126)
            plain = achar(code)
        case (9, 13, int(z"00A0"), int(z"1680"), int(z"2000"):int(z"200A"), int(z"202F"), &
              int(z"205F"), int(z"2062"), int(z"3000"))
            plain = " "
        case (int(z"200B"):int(z"200D"), int(z"2060"), int(z"2061"), int(z"FE00"):int(z"FE0F"), &
              int(z"FEFF"))
            plain = ""
        case (int(z"00B7"), int(z"00D7"), int(z"2022"), int(z"2217"), int(z"2219"), int(z"22C5"), &
              int(z"22C6"), int(z"2715"))
            plain = "*"
        case (int(z"2010"):int(z"2015"), int(z"2212"), int(z"FE63"), int(z"FF0D"))
            plain = "-"
        case (int(z"2064"), int(z"FF0B")); plain = "+"
        case (int(z"00F7"), int(z"2044"), int(z"2215"), int(z"FF0F")); plain = "/"
        case (int(z"2223"), int(z"2758"), int(z"FF5C")); plain = "|"
        case (int(z"2018"), int(z"2019"), int(z"201B"), int(z"2032"), int(z"02B9"), int(z"02BC"), &
              int(z"00B4"), int(z"FF07"))
            plain = "'"
        case (int(z"2033"), int(z"02BA")); plain = "''"
        case (int(z"FF08"), int(z"207D"), int(z"208D")); plain = "("
        case (int(z"FF09"), int(z"207E"), int(z"208E")); plain = ")"
        case (int(z"FF0A")); plain = "*"
        case (int(z"FF0C")); plain = ","
        case (int(z"FF0E")); plain = "."
        case (int(z"FF1D")); plain = "="
        case (int(z"FF3E")); plain = "^"
        case (int(z"FF3F")); plain = "_"
        case (int(z"221A")); plain = " sqrt "
        case (int(z"00BC")); plain = "(1/4)"
        case (int(z"00BD")); plain = "(1/2)"
        case (int(z"00BE")); plain = "(3/4)"
        case (int(z"2153")); plain = "(1/3)"
        case (int(z"2154")); plain = "(2/3)"
        case (int(z"215B")); plain = "(1/8)"
        case default
            plain = letter_shape(code)
            known = plain /= ""
        end select
    end subroutine spell

    pure function superscript(code) result(plain)
        !! A digit or a sign of an exponent; a blank for all others.
        integer, intent(in) :: code
        character :: plain

        plain = digit(code)
        if (code == int(z"207A")) plain = "+"
        if (code == int(z"207B")) plain = "-"
    end function superscript

    pure function digit(code) result(plain)
        !! A raised one; a blank for all others.
        integer, intent(in) :: code
        character :: plain

        plain = " "
        select case (code)
        case (int(z"00B9")); plain = "1"
        case (int(z"00B2")); plain = "2"
        case (int(z"00B3")); plain = "3"
        case (int(z"2070"), int(z"2074"):int(z"2079"))
            plain = achar(iachar("0") + code - int(z"2070"))
        case default; return
        end select
    end function digit

    pure function advice(code) result(text)
        !! What to write instead.
        integer, intent(in) :: code
        character(:), allocatable :: text

        select case (code)
        case (int(z"00B0"), int(z"00BA"))
            text = " is a degree; angles are in radians, write pi/4 for 45 degrees"
        case (int(z"00BC"):int(z"00BE"), int(z"2150"):int(z"215F"))
            text = " is a fraction; write it with '/', 5/2 for two and a half"
        case (int(z"00B1"), int(z"2213"))
            text = " has two meanings; write a statement with + and one with -"
        case (int(z"223C"), int(z"2243"):int(z"224C"))
            text = " is no equality; write '='"
        case (int(z"2260"), int(z"2264"):int(z"226B"))
            text = " is no equality; write one with '='"
        case (int(z"2190"):int(z"21FF"), int(z"27F0"):int(z"27FF"), int(z"2900"):int(z"297F"))
            text = " is an arrow; write each equality on a line of its own"
        case (int(z"2211")); text = " is a sum; write sum(i, 1, 4, m/2 x_i_dot^2)"
        case (int(z"222B"):int(z"2230")); text = " is an integral, not read; write its value"
        case (int(z"2207")); text = " is no derivative here; write dV/dx, one for each coordinate"
        case (int(z"221B")); text = " is a root; write (x)^(1/3)"
        case (int(z"221C")); text = " is a root; write (x)^(1/4)"
        case (int(z"2026"), int(z"22EF")); text = " leaves terms out; write all of them"
        case (int(z"00AD")); text = " is a hyphen that does not show; write '-' or delete it"
        case (int(z"00AB"), int(z"00BB"), int(z"201A"), int(z"201C"):int(z"201F"), int(z"2039"), &
              int(z"203A"))
            text = " is a quotation mark; delete it"
        case (int(z"2308"):int(z"230B"), int(z"2329"), int(z"232A"), int(z"2768"):int(z"2775"), &
              int(z"27E6"):int(z"27EF"), int(z"3008"):int(z"301B"), int(z"FF3B"), int(z"FF3D"), &
              int(z"FF5B"), int(z"FF5D"))
            text = " is no bracket of a formula; write ( and )"
        case default
            text = " has no meaning in a formula; write plain letters"
            if (is_control(code)) text = " is a control character; delete it"
        end select
    end function advice
end module lagrangia_formula_characters
