module lagrangia_letter_shapes
    !! Letters as the equation editors and fonts of other programs have them: Greek, italic, bold,
    !! full width, as indices, with dots above. Source: Unicode 15, the blocks named below.
    implicit none (type, external)
    private
    public :: dot, two_dots
    public :: is_letter_shape, letter_shape

    character, parameter :: dot = achar(1), two_dots = achar(2)  !! above the letter before them

    character(*), parameter :: lower = "abcdefghijklmnopqrstuvwxyz"
    character(*), parameter :: upper = "ABCDEFGHIJKLMNOPQRSTUVWXYZ"

    character(7), parameter :: greek(0:24) = [character(7) :: &  ! from U+03B1 on
        "alpha", "beta", "gamma", "delta", "epsilon", "zeta", "eta", "theta", "iota", "kappa", &
        "lambda", "mu", "nu", "xi", "omicron", "pi", "rho", "sigma", "sigma", "tau", "upsilon", &
        "phi", "chi", "psi", "omega"]
    character(7), parameter :: greek_capital(0:24) = [character(7) :: &  ! from U+0391 on
        "A", "B", "Gamma", "Delta", "E", "Z", "H", "Theta", "I", "K", "Lambda", "M", "N", "Xi", &
        "O", "Pi", "P", "Theta", "Sigma", "T", "Upsilon", "Phi", "X", "Psi", "Omega"]
    character(7), parameter :: greek_symbol(0:5) = [character(7) :: &
        "epsilon", "theta", "kappa", "phi", "rho", "pi"]

    integer, parameter :: with_dot(*) = [ &  ! U+0227, U+1E03, ...
        551, 7683, 267, 7691, 279, 7711, 289, 7715, 7745, 7749, 559, 7767, 7769, 7777, 7787, &
        7815, 7819, 7823, 380]
    character(*), parameter :: dotted = "abcdefghmnoprstwxyz"
    integer, parameter :: with_two_dots(*) = [ &  ! U+00E4, U+00EB, ...
        228, 235, 239, 246, 252, 255, 7719, 7813, 7821, 7831]
    character(*), parameter :: twice_dotted = "aeiouyhwxt"

    integer, parameter :: lowered(*) = [ &  ! subscripts, U+2090, U+2091, ...
        8336, 8337, 8338, 8339, 8341, 8342, 8343, 8344, 8345, 8346, 8347, 8348, 7522, 11388, &
        7523, 7524, 7525]
    character(*), parameter :: lowered_letters = "aeoxhklmnpstijruv"

    integer, parameter :: singles(*) = [ &  ! letterlike symbols, U+210A, U+210B, ...
        8458, 8459, 8460, 8461, 8462, 8464, 8465, 8466, 8467, 8469, 8473, 8474, 8475, 8476, &
        8477, 8484, 8488, 8490, 8492, 8493, 8495, 8496, 8497, 8499, 8500, 8518, 8519, 8520, 8521]
    character(*), parameter :: single_letters = "gHHHhIILlNPQRRRZZKBCeEFModeij"

contains

    pure function is_letter_shape(code) result(yes)
        !! Is it a letter or a digit in another shape?
        integer, intent(in) :: code  !! Unicode's number
        logical :: yes

        yes = len(letter_shape(code)) > 0
    end function is_letter_shape

    pure function letter_shape(code) result(plain)
        !! The letter, the digit or the name that it stands for, with `dot` or `two_dots` behind it;
        !! empty where it is none.
        integer, intent(in) :: code  !! Unicode's number
        character(:), allocatable :: plain
        integer :: k

        plain = ""
        select case (code)
        case (int(z"03B1"):int(z"03C9")); plain = trim(greek(code - int(z"03B1")))
        case (int(z"0391"):int(z"03A9")); plain = trim(greek_capital(code - int(z"0391")))
        case (int(z"2126")); plain = "Omega"
        case (int(z"2206")); plain = "Delta"
        case (int(z"00B5")); plain = "mu"
        case (int(z"03D1")); plain = "theta"
        case (int(z"03D5")); plain = "phi"
        case (int(z"03D6")); plain = "pi"
        case (int(z"03F0")); plain = "kappa"
        case (int(z"03F1")); plain = "rho"
        case (int(z"03F5")); plain = "epsilon"
        case (int(z"2202")); plain = "d"
        case (int(z"FB00")); plain = "ff"
        case (int(z"FB01")); plain = "fi"
        case (int(z"FB02")); plain = "fl"
        case (int(z"0307"), int(z"02D9")); plain = dot
        case (int(z"0308"), int(z"00A8")); plain = two_dots
        case (int(z"2080"):int(z"2089")); plain = achar(iachar("0") + code - int(z"2080"))
        case (int(z"FF10"):int(z"FF19")); plain = achar(iachar("0") + code - int(z"FF10"))
        case (int(z"FF21"):int(z"FF3A")); plain = achar(iachar("A") + code - int(z"FF21"))
        case (int(z"FF41"):int(z"FF5A")); plain = achar(iachar("a") + code - int(z"FF41"))
        case (int(z"1D400"):int(z"1D7FF")); plain = mathematical(code)
        case default
            k = findloc(with_dot, code, 1)
            if (k > 0) plain = dotted(k:k)//dot
            k = findloc(with_two_dots, code, 1)
            if (k > 0) plain = twice_dotted(k:k)//two_dots
            k = findloc(lowered, code, 1)
            if (k > 0) plain = "_"//lowered_letters(k:k)
            k = findloc(singles, code, 1)
            if (k > 0) plain = single_letters(k:k)
        end select
    end function letter_shape

    pure function mathematical(code) result(plain)
        !! Of the block of mathematical alphabets: each 52 letters, Greek ones 58, digits ten.
        integer, intent(in) :: code
        character(:), allocatable :: plain
        integer :: k

        plain = ""
        if (code < int(z"1D6A4")) then
            k = modulo(code - int(z"1D400"), 52) + 1
            if (k <= 26) then
                plain = upper(k:k)
            else
                plain = lower(k - 26:k - 26)
            end if
        else if (code >= int(z"1D7CE")) then
            plain = achar(iachar("0") + modulo(code - int(z"1D7CE"), 10))
        else if (code >= int(z"1D6A8") .and. code < int(z"1D7CA")) then
            k = modulo(code - int(z"1D6A8"), 58)
            select case (k)
            case (0:24); plain = trim(greek_capital(k))
            case (26:50); plain = trim(greek(k - 26))
            case (51); plain = "d"
            case (52:57); plain = trim(greek_symbol(k - 52))
            case default; plain = ""  ! nabla
            end select
        end if
    end function mathematical
end module lagrangia_letter_shapes
