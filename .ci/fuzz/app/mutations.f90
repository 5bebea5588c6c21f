module mutations
    !! Repeatable random changes of a text. `pick` stands alone in its statements: gfortran may call
    !! a function twice where the length of a text depends on it.
    use, intrinsic :: iso_fortran_env, only: int64
    implicit none (type, external)
    private
    public :: mutate, pick, seed_with

    integer(int64) :: state = 1

    character(*), parameter :: pieces(*) = [character(16) :: "/", "&", "=", ",", "'", '"', "!", &
        "(", ")", "%", "*", "3*0", "9999999*1", "1e400", "1e-400", "nan", "inf", "-", "1/100", &
        ".true.", "q(2) = 1", "&scene", "&end", "//", "1.5-3", "0x10", "dt = 1", "'rk4'", &
        "verlet", &
        "columns", "''", "-1", "1e-3", "0", "2.5d0", "expect_error", "every = 0", "output='../a'"]

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
            select case (pick(7))
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
            case default
                if (len(other) == 0) cycle
                first = pick(len(other))
                last = min(len(other), first + pick(60))
                text = text(:at - 1)//other(first:last)//text(at:)
            end select
        end do
    end subroutine mutate
end module mutations
