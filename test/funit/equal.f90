module funit_equal
    !! Assertions of equality. NaN equals nothing; an infinity equals itself.
    use, intrinsic :: iso_fortran_env, only: int32, int64, real64
    use funit_exceptions, only: throw
    use funit_locations, only: SourceLocation
    use funit_messages, only: comparison, conformable, fail_reals, headline, keyword_only, list, &
                              place
    implicit none (type, external)
    private
    public :: assertEqual

    interface assertEqual
        !! Fail unless `actual` is `expected`: reals within an absolute tolerance (zero if absent),
        !! strings without the blanks and tabs at both ends.
        module procedure equal_string, equal_strings
        module procedure equal_logical, equal_logicals
        module procedure equal_i32, equal_i32s, equal_i64, equal_i64s, equal_i32_i64
        module procedure equal_real, equal_real_reals, equal_reals
        module procedure equal_real_matrix, equal_matrices
    end interface assertEqual

    character(*), parameter :: nl = new_line("a")

contains

    subroutine equal_string(expected, found, message, location)
        character(*), intent(in) :: expected, found
        character(*), intent(in), optional :: message
        type(SourceLocation), intent(in), optional :: location
        character(:), allocatable :: text
        integer :: same, e1, e2, f1, f2

        call inner(expected, e1, e2)
        call inner(found, f1, f2)
        associate (e => expected(e1:e2), f => found(f1:f2))
            do same = 0, min(len(e), len(f)) - 1
                if (e(same + 1:same + 1) /= f(same + 1:same + 1)) exit
            end do
            if (same == len(e) .and. same == len(f)) return
        end associate
        text = "String assertion failed:" &
               //nl//'    expected: <"'//expected(:e2)//'">' &
               //nl//'   but found: <"'//found(:f2)//'">' &
               //nl//"  first diff:   "//repeat("-", same)//"^"
        if (present(message)) then
            if (len_trim(message) > 0) text = trim(message)//" "//text
        end if
        call throw(text, location)
    end subroutine equal_string

    subroutine inner(string, first, last)
        !! Where `string` begins and ends without the blanks and tabs at its ends.
        character(*), intent(in) :: string
        integer, intent(out) :: first, last
        character(*), parameter :: white = " "//achar(9)

        first = verify(string, white)
        last = verify(string, white, back=.true.)
        if (first == 0) then
            first = len(string) + 1
            last = len(string)
        end if
    end subroutine inner

    subroutine equal_strings(expected, found, message, location)
        character(*), intent(in) :: expected(:), found(:)
        character(*), intent(in), optional :: message
        type(SourceLocation), intent(in), optional :: location
        integer :: i

        if (.not. conformable(shape(expected), shape(found), message, location)) return
        do i = 1, size(expected)
            call equal_string(expected(i), found(i), message, location)
        end do
    end subroutine equal_strings

    subroutine equal_logical(expected, actual, unused, message, location)
        logical, intent(in) :: expected, actual
        class(keyword_only), intent(in), optional :: unused
        character(*), intent(in), optional :: message
        type(SourceLocation), intent(in), optional :: location

        call check_logicals([expected], [actual], .false., message, location)
    end subroutine equal_logical

    subroutine equal_logicals(expected, actual, unused, message, location)
        logical, intent(in) :: expected(:), actual(:)
        class(keyword_only), intent(in), optional :: unused
        character(*), intent(in), optional :: message
        type(SourceLocation), intent(in), optional :: location

        if (.not. conformable(shape(expected), shape(actual), message, location)) return
        call check_logicals(expected, actual, .true., message, location)
    end subroutine equal_logicals

    subroutine equal_i32(expected, actual, message, location)
        integer(int32), intent(in) :: expected, actual
        character(*), intent(in), optional :: message
        type(SourceLocation), intent(in), optional :: location

        call check_integers([int(expected, int64)], [int(actual, int64)], .false., message, &
                            location)
    end subroutine equal_i32

    subroutine equal_i32s(expected, actual, message, location)
        integer(int32), intent(in) :: expected(:), actual(:)
        character(*), intent(in), optional :: message
        type(SourceLocation), intent(in), optional :: location

        if (.not. conformable(shape(expected), shape(actual), message, location)) return
        call check_integers(int(expected, int64), int(actual, int64), .true., message, location)
    end subroutine equal_i32s

    subroutine equal_i64(expected, actual, message, location)
        integer(int64), intent(in) :: expected, actual
        character(*), intent(in), optional :: message
        type(SourceLocation), intent(in), optional :: location

        call check_integers([expected], [actual], .false., message, location)
    end subroutine equal_i64

    subroutine equal_i64s(expected, actual, message, location)
        integer(int64), intent(in) :: expected(:), actual(:)
        character(*), intent(in), optional :: message
        type(SourceLocation), intent(in), optional :: location

        if (.not. conformable(shape(expected), shape(actual), message, location)) return
        call check_integers(expected, actual, .true., message, location)
    end subroutine equal_i64s

    subroutine equal_i32_i64(expected, actual, message, location)
        integer(int32), intent(in) :: expected
        integer(int64), intent(in) :: actual
        character(*), intent(in), optional :: message
        type(SourceLocation), intent(in), optional :: location

        call check_integers([int(expected, int64)], [actual], .false., message, location)
    end subroutine equal_i32_i64

    subroutine equal_real(expected, actual, tolerance, message, location)
        real(real64), intent(in) :: expected, actual
        real(real64), intent(in), optional :: tolerance
        character(*), intent(in), optional :: message
        type(SourceLocation), intent(in), optional :: location

        call check_reals([expected], [actual], [integer ::], tolerance, message, location)
    end subroutine equal_real

    subroutine equal_real_reals(expected, actual, tolerance, message, location)
        real(real64), intent(in) :: expected, actual(:)
        real(real64), intent(in), optional :: tolerance
        character(*), intent(in), optional :: message
        type(SourceLocation), intent(in), optional :: location

        call check_reals(spread(expected, 1, size(actual)), actual, shape(actual), &
                         tolerance, message, location)
    end subroutine equal_real_reals

    subroutine equal_reals(expected, actual, tolerance, message, location)
        real(real64), intent(in) :: expected(:), actual(:)
        real(real64), intent(in), optional :: tolerance
        character(*), intent(in), optional :: message
        type(SourceLocation), intent(in), optional :: location

        if (.not. conformable(shape(expected), shape(actual), message, location)) return
        call check_reals(expected, actual, shape(actual), tolerance, message, location)
    end subroutine equal_reals

    subroutine equal_real_matrix(expected, actual, tolerance, message, location)
        real(real64), intent(in) :: expected, actual(:, :)
        real(real64), intent(in), optional :: tolerance
        character(*), intent(in), optional :: message
        type(SourceLocation), intent(in), optional :: location

        call check_reals(spread(expected, 1, size(actual)), reshape(actual, [size(actual)]), &
                         shape(actual), tolerance, message, location)
    end subroutine equal_real_matrix

    subroutine equal_matrices(expected, actual, tolerance, message, location)
        real(real64), intent(in) :: expected(:, :), actual(:, :)
        real(real64), intent(in), optional :: tolerance
        character(*), intent(in), optional :: message
        type(SourceLocation), intent(in), optional :: location

        if (.not. conformable(shape(expected), shape(actual), message, location)) return
        call check_reals(reshape(expected, [size(actual)]), reshape(actual, [size(actual)]), &
                         shape(actual), tolerance, message, location)
    end subroutine equal_matrices

    subroutine check_logicals(expected, actual, is_array, message, location)
        logical, intent(in) :: expected(:), actual(:), is_array
        character(*), intent(in), optional :: message
        type(SourceLocation), intent(in), optional :: location
        character(:), allocatable :: text
        integer :: i

        i = findloc(expected .eqv. actual, .false., dim=1)
        if (i == 0) return
        text = headline("AssertEquivalent", pack([i], is_array), message) &
               //nl//"    Expected: <"//merge("T", "F", expected(i))//">" &
               //nl//"    Actual:   <"//merge("T", "F", actual(i))//">"
        if (is_array) text = text//nl//"    at index: "//list([i])//">"
        call throw(text, location)
    end subroutine check_logicals

    subroutine check_integers(expected, actual, is_array, message, location)
        integer(int64), intent(in) :: expected(:), actual(:)
        logical, intent(in) :: is_array
        character(*), intent(in), optional :: message
        type(SourceLocation), intent(in), optional :: location
        character(22) :: wanted, got, difference
        integer :: i

        i = findloc(expected == actual, .false., dim=1)
        if (i == 0) return
        write (wanted, "(ss, i0)") expected(i)
        write (got, "(ss, i0)") actual(i)
        write (difference, "(ss, '<', i0, '>')") actual(i) - expected(i)
        call throw(headline("AssertEqual", pack([i], is_array), message) &
                   //comparison(wanted, got, "    Difference", difference, pack([i], is_array)), &
                   location)
    end subroutine check_integers

    subroutine check_reals(expected, actual, extents, tolerance, message, location)
        !! Arrays come flattened; `extents` is their shape, empty for scalars.
        real(real64), intent(in) :: expected(:), actual(:)
        integer, intent(in) :: extents(:)
        real(real64), intent(in), optional :: tolerance
        character(*), intent(in), optional :: message
        type(SourceLocation), intent(in), optional :: location
        real(real64) :: t
        integer :: i

        t = 0.0_real64
        if (present(tolerance)) t = tolerance
        i = findloc(agree(expected, actual, t), .false., dim=1)
        if (i == 0) return
        call fail_reals("AssertEqual", "    Difference", expected(i), actual(i), &
                        actual(i) - expected(i), t, place(i, extents), message, location)
    end subroutine check_reals

    elemental logical function agree(expected, actual, tolerance)
        !! Equal, or within the tolerance; infinities are not subtracted.
        real(real64), intent(in) :: expected, actual, tolerance

        agree = actual <= expected .and. actual >= expected
        if (.not. agree) agree = abs(actual - expected) <= tolerance
    end function agree
end module funit_equal
