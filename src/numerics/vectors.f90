module lagrangia_vectors
    !! Vectors in three dimensions, and how far two lists of numbers are apart.
    use lagrangia_hyperdual, only: hyperdual_t, operator(*), operator(-)
    use lagrangia_kinds, only: dp
    implicit none (type, external)
    private
    public :: cross, farthest, length

    interface cross
        module procedure cross_real, cross_real_hyperdual
    end interface cross

contains

    pure function cross_real(a, b) result(c)
        !! \(a\times b\).
        real(dp), intent(in) :: a(3), b(3)  !! of any unit
        real(dp) :: c(3)

        c = [a(2)*b(3) - a(3)*b(2), a(3)*b(1) - a(1)*b(3), a(1)*b(2) - a(2)*b(1)]
    end function cross_real

    pure function cross_real_hyperdual(a, b) result(c)
        !! \(a\times b\).
        real(dp), intent(in) :: a(3)           !! of any unit
        type(hyperdual_t), intent(in) :: b(3)  !! of any unit
        type(hyperdual_t) :: c(3)

        c = [a(2)*b(3) - a(3)*b(2), a(3)*b(1) - a(1)*b(3), a(1)*b(2) - a(2)*b(1)]
    end function cross_real_hyperdual

    pure function length(a)
        !! \(|a|\): gfortran's `norm2` underflows below 1e-154.
        real(dp), intent(in) :: a(3)  !! of any unit
        real(dp) :: length

        length = hypot(hypot(a(1), a(2)), a(3))
    end function length

    pure function farthest(a, b) result(distance)
        !! \(\max_i|a_i - b_i|\), to either side.
        real(dp), intent(in) :: a(:), b(:)  !! as many numbers, of one unit
        real(dp) :: distance

        distance = maxval(abs(a - b))
    end function farthest
end module lagrangia_vectors
