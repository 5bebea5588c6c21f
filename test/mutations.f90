module mutations
    !! Repeatable random changes of a text. `pick` stands alone in its statements: gfortran may call
    !! a function twice where the length of a text depends on it.
    use, intrinsic :: iso_fortran_env, only: int64
    implicit none (type, external)
    private
    public :: mutate, pick, seed_with, spoil

    integer(int64) :: state = 1

    character(*), parameter :: pieces(*) = [character(16) :: "/", "&", "=", ",", "'", '"', "!", &
        "(", ")", "%", "*", "3*0", "9999999*1", "1e400", "1e-400", "nan", "inf", "-", "1/100", &
        ".true.", "q(2) = 1", "&scene", "&end", "//", "1.5-3", "0x10", "dt = 1", "'rk4'", &
        "verlet", &
        "columns", "''", "-1", "1e-3", "0", "2.5d0", "expect_error", "every = 0", "output='../a'", &
        "0,5", "pi/4", "45deg", "10^-3", "==", ":=", "[1, 2]", "modes", "# note", "m_block = 2", &
        "&wedge /", achar(13)//achar(10), char(226)//char(136)//char(146), &
        char(194)//char(160), char(194)//char(176), char(226)//char(128)//char(156)]
    character(*), parameter :: nonsense(*) = [character(16) :: "0,5", "1,5,2", "pi", "pi/4", &
        "2*pi", "45 deg", "1 m", "10ms", "1/2", "10^-3", "1.0_dp", "1e400", "1e-400", "--1", "1e", &
        "0x1", "'1'", "one", "nan", "1;", "(1)", "[1]", "1 # one", "1%", "1_000", "=1", "$x", &
        char(226)//char(136)//char(146)//"1", char(194)//char(160)//"1", "1"//char(194)//char(176)]
    !! None of these is a single number, however the rest of the scene looks.

contains

    subroutine seed_with(seed)
        !! Start the sequence that belongs to `seed`.
        integer, intent(in) :: seed

        state = ieor(int(seed, int64)*2654435761_int64, 88172645463325252_int64)
    end subroutine seed_with

    function pick(most) result(number)
        !! From 1 to `most`. Marsaglia's xorshift.
        integer, intent(in) :: most
        integer :: number

        state = ieor(state, shiftl(state, 13))
        state = ieor(state, shiftr(state, 7))
        state = ieor(state, shiftl(state, 17))
        number = 1 + int(mod(shiftr(state, 11), int(most, int64)))
    end function pick

    subroutine mutate(text, times, other)
        !! Change `text` in `times` places; `other` is a text to borrow from.
        character(:), allocatable, intent(inout) :: text
        integer, intent(in) :: times
        character(*), intent(in) :: other
        integer :: at, first, k, last

        do k = 1, times
            at = pick(len(text) + 1)
            select case (pick(9))
            case (1)
                first = pick(256) - 1
                text = text(:at - 1)//achar(first)//text(at:)
            case (2)
                first = min(len(text) + 1, at + pick(3))
                text = text(:at - 1)//text(first:)
            case (3, 4)
                first = pick(size(pieces))
                text = text(:at - 1)//trim(pieces(first))//text(at:)
            case (5)
                text = text(:at - 1)
            case (6)
                last = min(len(text), at + pick(40))
                text = text(:last)//text(at:)
            case (7)
                call swap_lines(text, at)
            case (8)
                first = pick(size(pieces))
                call replace_word(text, at, trim(pieces(first)))
            case default
                if (len(other) == 0) cycle
                first = pick(len(other))
                last = min(len(other), first + pick(60))
                text = text(:at - 1)//other(first:last)//text(at:)
            end select
        end do
    end subroutine mutate

    subroutine spoil(text, key)
        !! Replace the number of the single-valued `key` by nonsense; `key` is empty where the text
        !! has none such.
        character(:), allocatable, intent(inout) :: text
        character(:), allocatable, intent(out) :: key
        character(*), parameter :: keys(*) = [character(10) :: " dt", " duration", " every", &
                                              " tolerance", " samples", " m", " l"]
        integer :: first, k, last, which

        which = pick(size(keys))
        key = trim(keys(which))
        first = index(text, key//" = ")
        which = pick(size(nonsense))
        if (first == 0) then
            key = ""
            return
        end if
        first = first + len(key) + 3
        k = scan(text(first:), ", "//new_line("a"))
        last = first + k - 2
        key = trim(nonsense(which))
        text = text(:first - 1)//key//text(last + 1:)
    end subroutine spoil

    subroutine swap_lines(text, at)
        !! Let the line at byte `at` follow the next one.
        character(:), allocatable, intent(inout) :: text
        integer, intent(in) :: at
        character(1), parameter :: lf = new_line("a")
        integer :: first, middle, last

        first = index(text(:at - 1), lf, back=.true.) + 1
        middle = index(text(first:), lf) + first - 1
        if (middle < first) return
        last = index(text(middle + 1:), lf) + middle
        if (last == middle) return
        text = text(:first - 1)//text(middle + 1:last)//text(first:middle)//text(last + 1:)
    end subroutine swap_lines

    subroutine replace_word(text, at, word)
        !! Put `word` in the place of that which begins behind byte `at`.
        character(:), allocatable, intent(inout) :: text
        integer, intent(in) :: at
        character(*), intent(in) :: word
        character(*), parameter :: between = " ,=/&"//new_line("a")
        integer :: first, last

        first = max(1, at - 1 + scan(text(at:), between))
        first = first + max(0, verify(text(first + 1:), between))
        last = first - 2 + scan(text(first:)//" ", between)
        text = text(:first - 1)//word//text(max(first, last + 1):)
    end subroutine replace_word
end module mutations
