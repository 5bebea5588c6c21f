module test_roots
    !! Roots are found to two neighbours in the grid of numbers.
    use funit, only: anyExceptions, assertEqual, assertFalse, assertLessThan, assertTrue, &
                     TestMethod, TestSuite
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp
    use lagrangia_roots, only: find_root, scalar_function_t
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: roots_suite

    integer, parameter :: parabola = 1, cosine = 2, flat = 3, jump = 4, tiny_slope = 5, pole = 6, &
                          kinked = 7, line = 8, square_root = 9

    type, extends(scalar_function_t) :: sample_t
        integer :: kind = parabola
        integer :: calls = 0
        logical :: twice = .false.     !! a point was asked for again
        real(dp) :: of = 0.0_dp        !! the number whose square root is taken off
        real(dp) :: asked(2000) = huge(1.0_dp)
    contains
        procedure :: value
    end type sample_t

contains

    function roots_suite() result(suite)
        type(TestSuite) :: suite

        suite = TestSuite("roots")
        call suite%addTest(TestMethod("a root has its neighbour on the other side", neighbours))
        call suite%addTest(TestMethod("smooth functions take few calls", few_calls))
        call suite%addTest(TestMethod("no point is asked for twice", no_point_twice))
        call suite%addTest(TestMethod("zeros at the ends are roots", ends))
        call suite%addTest(TestMethod("no change of sign is refused", refusal))
    end function roots_suite

    function value(self, x) result(y)
        class(sample_t), intent(inout) :: self
        real(dp), intent(in) :: x
        real(dp) :: y

        self%calls = self%calls + 1
        if (any(abs(self%asked(:self%calls - 1) - x) <= 0.0_dp)) self%twice = .true.
        self%asked(self%calls) = x
        select case (self%kind)
        case (parabola); y = x**2 - 2.0_dp
        case (cosine); y = cos(x)
        case (flat); y = (x - 0.7_dp)**9
        case (jump); y = sign(1.0_dp, x - 0.3_dp)
        case (tiny_slope); y = 1e-200_dp*(x - 3.0_dp)
        case (pole); y = 1.0_dp/(x - 0.123_dp)
        case (kinked); y = merge(x - 1.1_dp, 1e6_dp*(x - 1.1_dp), x < 1.1_dp)
        case (square_root); y = sqrt(x) - sqrt(self%of)
        case default; y = x
        end select
    end function value

    subroutine neighbours()
        !! In both directions. A root is on the side where the search starts; beyond it, at the next
        !! number, the sign is the other.
        type(sample_t) :: f
        type(error_t), allocatable :: error
        real(dp) :: from, to, root, y, y_next, side
        integer :: kind, way
        real(dp), parameter :: low(8) = [0.0_dp, 0.0_dp, -3.0_dp, -1e3_dp, -1e6_dp, 0.0_dp, &
                                         0.0_dp, -1e300_dp]
        real(dp), parameter :: high(8) = [2.0_dp, 3.0_dp, 2.0_dp, 1.0_dp, 1e5_dp, 1.0_dp, 9.0_dp, &
                                          1.1e300_dp]

        do kind = 1, 8
            do way = 1, 2
                from = merge(low(kind), high(kind), way == 1)
                to = merge(high(kind), low(kind), way == 1)
                f%kind = kind
                side = sign(1.0_dp, f%value(from))
                f%calls = 0
                f%twice = .false.
                call find_root(f, from, to, root, error)
                call assertFalse(f%twice, "a point asked for twice, kind "//to_text(kind))
                call assertFalse(allocated(error), "no error")
                if (anyExceptions()) return
                call assertTrue((root - low(kind))*(high(kind) - root) >= 0.0_dp, "within")
                y = f%value(root)
                y_next = f%value(nearest(root, to - from))
                call assertTrue(y*side >= 0.0_dp .and. y_next*side <= 0.0_dp, &
                                "neighbours of kind "//to_text(kind))
                call assertLessThan(f%calls, 1200, message="calls")
            end do
        end do
    end subroutine neighbours

    subroutine few_calls()
        !! Bisection would take 53 to 1075.
        type(sample_t) :: f
        type(error_t), allocatable :: error
        real(dp) :: root

        call find_root(f, 0.0_dp, 2.0_dp, root, error)
        call assertEqual(sqrt(2.0_dp), root, epsilon(1.0_dp), "root of 2")
        call assertLessThan(f%calls, 15, message="calls for the parabola")
        f%calls = 0
        f%kind = cosine
        call find_root(f, 3.0_dp, 0.0_dp, root, error)
        call assertEqual(acos(0.0_dp), root, epsilon(1.0_dp), "half of pi")
        call assertLessThan(f%calls, 15, message="calls for the cosine")
    end subroutine few_calls

    subroutine no_point_twice()
        !! The next point differs from both ends, also where these are of other sizes and the
        !! interpolation meets the root to less than half a spacing of numbers.
        real(dp), parameter :: of(3) = [23.55846318160282_dp, 2404.4083600552212_dp, &
                                        0.003301270367182451_dp]
        real(dp), parameter :: from(3) = [6159.6415543173125_dp, 1.951600691574451e-07_dp, &
                                          0.0001219647723705439_dp]
        real(dp), parameter :: to(3) = [4.670562755371814_dp, 2284723934.2045717_dp, &
                                        1079.8660656016382_dp]
        type(sample_t) :: f
        type(error_t), allocatable :: error
        real(dp) :: root
        integer :: i

        do i = 1, size(of)
            f = sample_t(kind=square_root, of=of(i))
            call find_root(f, from(i), to(i), root, error)
            call assertEqual(of(i), root, spacing(of(i)), "the root")
            call assertFalse(f%twice, "a point asked for twice")
        end do
    end subroutine no_point_twice

    subroutine ends()
        type(sample_t) :: f
        type(error_t), allocatable :: error
        real(dp) :: root

        f%kind = line
        call find_root(f, 0.0_dp, 2.0_dp, root, error)
        call assertEqual(0.0_dp, root, message="first")
        call find_root(f, 2.0_dp, 0.0_dp, root, error)
        call assertEqual(0.0_dp, root, message="last")
        call assertFalse(allocated(error), "no error")
    end subroutine ends

    subroutine refusal()
        type(sample_t) :: f
        type(error_t), allocatable :: error
        real(dp) :: root

        call find_root(f, 2.0_dp, 3.5_dp, root, error)
        call assertTrue(allocated(error), "refused")
        if (anyExceptions()) return
        call assertEqual("no change of sign between 2.0 and 3.5", error%message, message="message")
    end subroutine refusal
end module test_roots
