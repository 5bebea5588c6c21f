module lagrangia_mass_matrix
    !! The mass matrix \(M = \partial^2L/\partial\dot q\,\partial\dot q\): whether it is positive
    !! definite.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use lagrangia_eigen, only: normal_modes
    use lagrangia_errors, only: error_t, fail, status_library
    use lagrangia_kinds, only: dp
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: check_mass_matrix, list_of

contains

    pure subroutine check_mass_matrix(mass, error)
        !! Fails (status 4) where an eigenvalue of \(M\) is negative, or \(|\lambda_1| \le
        !! 4n\epsilon\,\lambda_n\): then rounding alone decides on its sign.
        real(dp), intent(in) :: mass(:, :)                !! \(M\), symmetric, (n, n), not empty
        type(error_t), allocatable, intent(out) :: error  !! which it is, and the eigenvalue
        real(dp), allocatable :: lambda(:), vectors(:, :)
        real(dp) :: one(size(mass, 1), size(mass, 1))
        integer :: i, n

        if (.not. all(ieee_is_finite(mass))) then
            call fail(error, "the mass matrix is not finite", status_library)
            return
        end if
        n = size(mass, 1)
        one = 0.0_dp
        do i = 1, n
            one(i, i) = 1.0_dp
        end do
        call normal_modes(mass, one, lambda, vectors, error)
        if (allocated(error)) return
        if (lambda(1) > 4*n*epsilon(1.0_dp)*lambda(n)) return
        if (lambda(1) < -4*n*epsilon(1.0_dp)*abs(lambda(n))) then
            call fail(error, "the mass matrix d2L/dv dv is not positive definite: it has the "// &
                      "eigenvalue "//to_text(lambda(1)), status_library)
        else
            call fail(error, "the mass matrix d2L/dv dv is singular: it has the eigenvalue "// &
                      to_text(lambda(1))//" beside "//to_text(lambda(n)), status_library)
        end if
    end subroutine check_mass_matrix

    pure function list_of(x) result(text)
        !! The first four numbers of a state, as a message has them.
        real(dp), intent(in) :: x(:)  !! of any length
        character(:), allocatable :: text
        integer :: i

        text = ""
        do i = 1, min(size(x), 4)
            if (i > 1) text = text//", "
            text = text//to_text(x(i))
        end do
        if (size(x) > 4) text = text//", ..."
    end function list_of
end module lagrangia_mass_matrix
