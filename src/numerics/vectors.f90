module lagrangia_vectors
    !! Vectors in three dimensions.
    use lagrangia_hyperdual, only: hyperdual_t, operator(*), operator(-)
    use lagrangia_kinds, only: dp
    implicit none (type, external)
    private
    public :: cross, length

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
end module lagrangia_vectors
