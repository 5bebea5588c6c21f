module funit_order
    !! Assertions that one number is less or greater than another. NaN fails.
    use, intrinsic :: iso_fortran_env, only: int32, int64, real64
    use funit_exceptions, only: throw
    use funit_locations, only: SourceLocation
    use funit_messages, only: conformable, headline, keyword_only, line, list
    implicit none (type, external)
    private
    public :: assertGreaterThan, assertGreaterThanOrEqual, assertLessThan, assertLessThanOrEqual

    interface assertLessThan
        !! Fail unless `lhs < rhs`, for reals unless `lhs < rhs + tolerance`.
        module procedure lt_i32, lt_i64, lt_real, lt_reals, lt_real_reals
    end interface assertLessThan

    interface assertLessThanOrEqual
        !! Fail unless `lhs <= rhs`, for reals unless `lhs <= rhs + tolerance`.
        module procedure le_i32, le_i64, le_real, le_reals, le_real_reals
    end interface assertLessThanOrEqual

    interface assertGreaterThan
        !! Fail unless `lhs > rhs`, for reals unless `lhs > rhs - tolerance`.
        module procedure gt_i32, gt_i64, gt_real, gt_reals, gt_real_reals
    end interface assertGreaterThan

    interface assertGreaterThanOrEqual
        !! Fail unless `lhs >= rhs`, for reals unless `lhs >= rhs - tolerance`.
        module procedure ge_i32, ge_i64, ge_real, ge_reals, ge_real_reals
    end interface assertGreaterThanOrEqual

contains

    subroutine lt_i32(lhs, rhs, unused, message, location)
        integer(int32), intent(in) :: lhs, rhs
        class(keyword_only), intent(in), optional :: unused
        character(*), intent(in), optional :: message
        type(SourceLocation), intent(in), optional :: location

        call order_integers("lt", int(lhs, int64), int(rhs, int64), message, location)
    end subroutine lt_i32

    subroutine lt_i64(lhs, rhs, unused, message, location)
        integer(int64), intent(in) :: lhs, rhs
        class(keyword_only), intent(in), optional :: unused
        character(*), intent(in), optional :: message
        type(SourceLocation), intent(in), optional :: location

        call order_integers("lt", lhs, rhs, message, location)
    end subroutine lt_i64

    subroutine lt_real(lhs, rhs, tolerance, message, location)
        real(real64), intent(in) :: lhs, rhs
        real(real64), intent(in), optional :: tolerance
        character(*), intent(in), optional :: message
        type(SourceLocation), intent(in), optional :: location

        call order_reals("lt", [lhs], [rhs], .false., tolerance, message, location)
    end subroutine lt_real

    subroutine lt_reals(lhs, rhs, tolerance, message, location)
        real(real64), intent(in) :: lhs(:), rhs(:)
        real(real64), intent(in), optional :: tolerance
        character(*), intent(in), optional :: message
        type(SourceLocation), intent(in), optional :: location

        if (.not. conformable(shape(lhs), shape(rhs), message, location)) return
        call order_reals("lt", lhs, rhs, .true., tolerance, message, location)
    end subroutine lt_reals

    subroutine lt_real_reals(lhs, rhs, tolerance, message, location)
        real(real64), intent(in) :: lhs, rhs(:)
        real(real64), intent(in), optional :: tolerance
        character(*), intent(in), optional :: message
        type(SourceLocation), intent(in), optional :: location

        call order_reals("lt", spread(lhs, 1, size(rhs)), rhs, .true., tolerance, message, location)
    end subroutine lt_real_reals

    subroutine le_i32(lhs, rhs, unused, message, location)
        integer(int32), intent(in) :: lhs, rhs
        class(keyword_only), intent(in), optional :: unused
        character(*), intent(in), optional :: message
        type(SourceLocation), intent(in), optional :: location

        call order_integers("le", int(lhs, int64), int(rhs, int64), message, location)
    end subroutine le_i32

    subroutine le_i64(lhs, rhs, unused, message, location)
        integer(int64), intent(in) :: lhs, rhs
        class(keyword_only), intent(in), optional :: unused
        character(*), intent(in), optional :: message
        type(SourceLocation), intent(in), optional :: location

        call order_integers("le", lhs, rhs, message, location)
    end subroutine le_i64

    subroutine le_real(lhs, rhs, tolerance, message, location)
        real(real64), intent(in) :: lhs, rhs
        real(real64), intent(in), optional :: tolerance
        character(*), intent(in), optional :: message
        type(SourceLocation), intent(in), optional :: location

        call order_reals("le", [lhs], [rhs], .false., tolerance, message, location)
    end subroutine le_real

    subroutine le_reals(lhs, rhs, tolerance, message, location)
        real(real64), intent(in) :: lhs(:), rhs(:)
        real(real64), intent(in), optional :: tolerance
        character(*), intent(in), optional :: message
        type(SourceLocation), intent(in), optional :: location

        if (.not. conformable(shape(lhs), shape(rhs), message, location)) return
        call order_reals("le", lhs, rhs, .true., tolerance, message, location)
    end subroutine le_reals

    subroutine le_real_reals(lhs, rhs, tolerance, message, location)
        real(real64), intent(in) :: lhs, rhs(:)
        real(real64), intent(in), optional :: tolerance
        character(*), intent(in), optional :: message
        type(SourceLocation), intent(in), optional :: location

        call order_reals("le", spread(lhs, 1, size(rhs)), rhs, .true., tolerance, message, location)
    end subroutine le_real_reals

    subroutine gt_i32(lhs, rhs, unused, message, location)
        integer(int32), intent(in) :: lhs, rhs
        class(keyword_only), intent(in), optional :: unused
        character(*), intent(in), optional :: message
        type(SourceLocation), intent(in), optional :: location

        call order_integers("gt", int(lhs, int64), int(rhs, int64), message, location)
    end subroutine gt_i32

    subroutine gt_i64(lhs, rhs, unused, message, location)
        integer(int64), intent(in) :: lhs, rhs
        class(keyword_only), intent(in), optional :: unused
        character(*), intent(in), optional :: message
        type(SourceLocation), intent(in), optional :: location

        call order_integers("gt", lhs, rhs, message, location)
    end subroutine gt_i64

    subroutine gt_real(lhs, rhs, tolerance, message, location)
        real(real64), intent(in) :: lhs, rhs
        real(real64), intent(in), optional :: tolerance
        character(*), intent(in), optional :: message
        type(SourceLocation), intent(in), optional :: location

        call order_reals("gt", [lhs], [rhs], .false., tolerance, message, location)
    end subroutine gt_real

    subroutine gt_reals(lhs, rhs, tolerance, message, location)
        real(real64), intent(in) :: lhs(:), rhs(:)
        real(real64), intent(in), optional :: tolerance
        character(*), intent(in), optional :: message
        type(SourceLocation), intent(in), optional :: location

        if (.not. conformable(shape(lhs), shape(rhs), message, location)) return
        call order_reals("gt", lhs, rhs, .true., tolerance, message, location)
    end subroutine gt_reals

    subroutine gt_real_reals(lhs, rhs, tolerance, message, location)
        real(real64), intent(in) :: lhs, rhs(:)
        real(real64), intent(in), optional :: tolerance
        character(*), intent(in), optional :: message
        type(SourceLocation), intent(in), optional :: location

        call order_reals("gt", spread(lhs, 1, size(rhs)), rhs, .true., tolerance, message, location)
    end subroutine gt_real_reals

    subroutine ge_i32(lhs, rhs, unused, message, location)
        integer(int32), intent(in) :: lhs, rhs
        class(keyword_only), intent(in), optional :: unused
        character(*), intent(in), optional :: message
        type(SourceLocation), intent(in), optional :: location

        call order_integers("ge", int(lhs, int64), int(rhs, int64), message, location)
    end subroutine ge_i32

    subroutine ge_i64(lhs, rhs, unused, message, location)
        integer(int64), intent(in) :: lhs, rhs
        class(keyword_only), intent(in), optional :: unused
        character(*), intent(in), optional :: message
        type(SourceLocation), intent(in), optional :: location

        call order_integers("ge", lhs, rhs, message, location)
    end subroutine ge_i64

    subroutine ge_real(lhs, rhs, tolerance, message, location)
        real(real64), intent(in) :: lhs, rhs
        real(real64), intent(in), optional :: tolerance
        character(*), intent(in), optional :: message
        type(SourceLocation), intent(in), optional :: location

        call order_reals("ge", [lhs], [rhs], .false., tolerance, message, location)
    end subroutine ge_real

    subroutine ge_reals(lhs, rhs, tolerance, message, location)
        real(real64), intent(in) :: lhs(:), rhs(:)
        real(real64), intent(in), optional :: tolerance
        character(*), intent(in), optional :: message
        type(SourceLocation), intent(in), optional :: location

        if (.not. conformable(shape(lhs), shape(rhs), message, location)) return
        call order_reals("ge", lhs, rhs, .true., tolerance, message, location)
    end subroutine ge_reals

    subroutine ge_real_reals(lhs, rhs, tolerance, message, location)
        real(real64), intent(in) :: lhs, rhs(:)
        real(real64), intent(in), optional :: tolerance
        character(*), intent(in), optional :: message
        type(SourceLocation), intent(in), optional :: location

        call order_reals("ge", spread(lhs, 1, size(rhs)), rhs, .true., tolerance, message, location)
    end subroutine ge_real_reals

    subroutine order_integers(relation, lhs, rhs, message, location)
        !! Check `lhs relation rhs`.
        character(2), intent(in) :: relation
        integer(int64), intent(in) :: lhs, rhs
        character(*), intent(in), optional :: message
        type(SourceLocation), intent(in), optional :: location
        logical :: held
        character(20) :: left, right

        select case (relation)
        case ("lt")
            held = lhs < rhs
        case ("le")
            held = lhs <= rhs
        case ("gt")
            held = lhs > rhs
        case default
            held = lhs >= rhs
        end select
        if (held) return
        write (left, "(ss, i0)") lhs
        write (right, "(ss, i0)") rhs
        call fail_order(relation, left, right, [integer ::], message, location)
    end subroutine order_integers

    subroutine order_reals(relation, lhs, rhs, is_array, tolerance, message, location)
        !! Check `lhs relation rhs` element by element.
        character(2), intent(in) :: relation
        real(real64), intent(in) :: lhs(:), rhs(:)
        logical, intent(in) :: is_array
        real(real64), intent(in), optional :: tolerance
        character(*), intent(in), optional :: message
        type(SourceLocation), intent(in), optional :: location
        logical :: held(size(rhs))
        character(45) :: left, right
        real(real64) :: t
        integer :: i

        t = 0.0_real64
        if (present(tolerance)) t = tolerance
        select case (relation)
        case ("lt")
            held = lhs < rhs + t
        case ("le")
            held = lhs <= rhs + t
        case ("gt")
            held = lhs > rhs - t
        case default
            held = lhs >= rhs - t
        end select
        i = findloc(held, .false., dim=1)
        if (i == 0) return
        write (left, "(ss, g0)") lhs(i)
        write (right, "(ss, g0)") rhs(i)
        call fail_order(relation, left, right, pack([i], is_array), message, location)
    end subroutine order_reals

    subroutine fail_order(relation, left, right, at, message, location)
        !! Say which relation did not hold.
        character(2), intent(in) :: relation
        character(*), intent(in) :: left, right
        integer, intent(in) :: at(:)
        character(*), intent(in), optional :: message
        type(SourceLocation), intent(in), optional :: location
        character(:), allocatable :: claim, label, text

        select case (relation)
        case ("lt")
            claim = "AssertLessThan"
            label = "    not less than"
        case ("le")
            claim = "AssertLessThanOrEqual"
            label = "    not less than or equal to"
        case ("gt")
            claim = "AssertGreaterThan"
            label = "    not greater than"
        case default
            claim = "AssertGreaterThanOrEqual"
            label = "    not greater than or equal to"
        end select
        text = headline(claim, at, message)//line("LHS", len(label), "<"//trim(left)//">") &
               //line(label, len(label), "<"//trim(right)//">")
        if (size(at) > 0) text = text//line("at index", len(label), list(at))
        call throw(text, location)
    end subroutine fail_order
end module funit_order
