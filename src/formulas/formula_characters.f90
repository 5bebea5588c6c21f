module lagrangia_formula_characters
    !! A typed formula in plain letters: Greek letters by their names, and what word processors and
    !! web pages make of signs, indices and squares.
    use lagrangia_characters, only: decode, described, is_control
    use lagrangia_errors, only: error_t, fail
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: plain_formula

    type :: spelling_t
        integer :: code = 0         !! Unicode's number
        character(7) :: plain = ""  !! what it stands for
    end type spelling_t

    type(spelling_t), parameter :: capitals(*) = [ &
        spelling_t(int(z"0393"), "Gamma"), spelling_t(int(z"0394"), "Delta"), &
        spelling_t(int(z"0398"), "Theta"), spelling_t(int(z"039B"), "Lambda"), &
        spelling_t(int(z"039E"), "Xi"), spelling_t(int(z"03A0"), "Pi"), &
        spelling_t(int(z"03A3"), "Sigma"), spelling_t(int(z"03A5"), "Upsilon"), &
        spelling_t(int(z"03A6"), "Phi"), spelling_t(int(z"03A8"), "Psi"), &
        spelling_t(int(z"03A9"), "Omega"), spelling_t(int(z"03D1"), "theta"), &
        spelling_t(int(z"03D5"), "phi"), spelling_t(int(z"00B5"), "mu"), &
        spelling_t(int(z"2113"), "l"), spelling_t(int(z"03F5"), "epsilon"), &
        spelling_t(int(z"2202"), "d"), spelling_t(int(z"221A"), " sqrt")]

    character, parameter :: dot = achar(1), two_dots = achar(2)  ! above the letter before them
    type(spelling_t), parameter :: dotted(*) = [ &
        spelling_t(int(z"0307"), dot), spelling_t(int(z"0308"), two_dots), &
        spelling_t(int(z"02D9"), dot), spelling_t(int(z"00A8"), two_dots), &
        spelling_t(int(z"1E8B"), "x"//dot), spelling_t(int(z"1E8D"), "x"//two_dots), &
        spelling_t(int(z"1E8F"), "y"//dot), spelling_t(int(z"00FF"), "y"//two_dots), &
        spelling_t(int(z"017C"), "z"//dot), spelling_t(int(z"1E59"), "r"//dot)]

    character(7), parameter :: greek(25) = [character(7) :: &  ! from U+03B1 on
        "alpha", "beta", "gamma", "delta", "epsilon", "zeta", "eta", "theta", "iota", "kappa", &
        "lambda", "mu", "nu", "xi", "omicron", "pi", "rho", "sigma", "sigma", "tau", "upsilon", &
        "phi", "chi", "psi", "omega"]

    type(spelling_t), parameter :: signs(*) = [ &
        spelling_t(int(z"00B7"), "*"), spelling_t(int(z"00D7"), "*"), &
        spelling_t(int(z"22C5"), "*"), spelling_t(int(z"2219"), "*"), &
        spelling_t(int(z"2212"), "-"), spelling_t(int(z"2010"), "-"), &
        spelling_t(int(z"2011"), "-"), spelling_t(int(z"2012"), "-"), &
        spelling_t(int(z"2013"), "-"), spelling_t(int(z"2014"), "-"), &
        spelling_t(int(z"00F7"), "/"), spelling_t(int(z"2044"), "/"), &
        spelling_t(int(z"2215"), "/"), spelling_t(int(z"00B2"), "^2"), &
        spelling_t(int(z"00B3"), "^3"), spelling_t(int(z"00A0"), " "), &
        spelling_t(int(z"2009"), " "), spelling_t(int(z"202F"), " "), &
        spelling_t(int(z"0009"), " ")]

    character(*), parameter :: digits = "0123456789", lower = "abcdefghijklmnopqrstuvwxyz"
    character(*), parameter :: upper = "ABCDEFGHIJKLMNOPQRSTUVWXYZ"
    integer, parameter :: subscript_zero = int(z"2080"), alpha = int(z"03B1")

contains

    pure subroutine plain_formula(text, plain, columns, error)
        !! `text` in plain letters, and the column of `text` that each of them comes from.
        character(*), intent(in) :: text                  !! UTF-8, perhaps
        character(:), allocatable, intent(out) :: plain   !! ASCII without control characters
        integer, allocatable, intent(out) :: columns(:)   !! in characters from 1, (len(plain))
        type(error_t), allocatable, intent(out) :: error  !! a character that no formula has
        character(5*len(text) + 1) :: buffer  ! epsilon has seven letters for two bytes
        character(:), allocatable :: meant
        integer :: code, column, filled, i, length

        allocate (columns(len(buffer)))
        filled = 0
        column = 0
        i = 1
        do while (i <= len(text))
            column = column + 1
            call decode(text, i, code, length)
            meant = spelled(code)
            if (len(meant) == 0) then
                if (code < 32 .or. code > 126) then
                    call fail(error, "column "//to_text(column)//": "//described(text, i)// &
                              advice(code))
                    return
                end if
                meant = text(i:i)
            else if (scan(meant(1:1), lower//upper) > 0 .and. &
                     scan(buffer(max(filled, 1):filled), digits) > 0) then
                meant = " "//meant  ! 2 pi r
            end if
            buffer(filled + 1:filled + len(meant)) = meant
            columns(filled + 1:filled + len(meant)) = column
            filled = filled + len(meant)
            i = i + length
        end do
        plain = buffer(:filled)
        columns = columns(:filled)
        if (scan(plain, dot//two_dots) > 0) call place_dots(plain, columns)
    end subroutine plain_formula

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

    pure function spelled(code) result(plain)
        !! What a character beyond ASCII stands for; empty where it is none that is known.
        integer, intent(in) :: code
        character(:), allocatable :: plain
        integer :: k

        plain = ""
        if (code >= alpha .and. code < alpha + size(greek)) then
            plain = trim(greek(code - alpha + 1))
        else if (code >= subscript_zero .and. code < subscript_zero + 10) then
            plain = achar(iachar("0") + code - subscript_zero)
        else if (code > 126 .or. code < 32) then
            do k = 1, size(capitals)
                if (capitals(k)%code == code) plain = trim(capitals(k)%plain)
            end do
            if (plain == " sqrt") plain = " sqrt "
            do k = 1, size(signs)
                if (signs(k)%code == code) plain = trim(signs(k)%plain)
                if (signs(k)%code == code .and. plain == "") plain = " "
                if (signs(k)%code == code .and. plain(1:1) == "^") plain = plain//" "
            end do
            do k = 1, size(dotted)
                if (dotted(k)%code == code) plain = trim(dotted(k)%plain)
            end do
        end if
    end function spelled

    pure function advice(code) result(text)
        !! What to write instead.
        integer, intent(in) :: code
        character(:), allocatable :: text

        select case (code)
        case (int(z"00B0"), int(z"00BA"))
            text = " is a degree; angles are in radians, write pi/4 for 45 degrees"
        case default
            text = " has no meaning in a formula; write plain letters"
            if (is_control(code)) text = " is a control character; delete it"
        end select
    end function advice
end module lagrangia_formula_characters
