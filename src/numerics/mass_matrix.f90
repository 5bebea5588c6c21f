module lagrangia_mass_matrix
    !! The mass matrix \(M = \partial^2L/\partial\dot q\,\partial\dot q\): whether it is positive
    !! definite.
    use lagrangia_eigen, only: normal_modes
    use lagrangia_errors, only: error_t, fail, status_library
    use lagrangia_kinds, only: dp
    use lagrangia_number_class, only: all_finite
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: check_mass_matrix, list_of

contains

    pure subroutine check_mass_matrix(mass, error)
        !! Fails (status 4) where an eigenvalue of \(S_{ij} = M_{ij}/\sqrt{|M_{ii} M_{jj}|}\) is
        !! negative, or \(|\lambda_1| \le 4n\epsilon\,\lambda_n\): then rounding alone decides on
        !! its sign. \(S\) does not depend on the units of the coordinates, metres or radians.
        real(dp), intent(in) :: mass(:, :)                !! \(M\), symmetric, (n, n), not empty
        type(error_t), allocatable, intent(out) :: error  !! which it is, and \(M\)'s eigenvalue
        real(dp) :: scaled(size(mass, 1), size(mass, 1)), root(size(mass, 1))
        real(dp) :: lambda(size(mass, 1)), bound
        logical :: negative
        integer :: i

        if (.not. all_finite(mass)) then
            call fail(error, "the mass matrix is not finite", status_library)
            return
        end if
        root = [(sqrt(abs(mass(i, i))), i=1, size(root))]
        where (root <= 0.0_dp) root = 1.0_dp
        do i = 1, size(root)
            scaled(:, i) = mass(:, i)/root/root(i)
        end do
        call find_eigenvalues(scaled, lambda, error)
        if (allocated(error)) return
        bound = 4*size(root)*epsilon(1.0_dp)*abs(lambda(size(root)))
        if (lambda(1) > bound) return
        negative = lambda(1) < -bound
        call find_eigenvalues(mass, lambda, error)
        if (allocated(error)) return
        if (negative) then
            call fail(error, "the mass matrix d2L/dv dv is not positive definite: it has the "// &
                      "eigenvalue "//to_text(lambda(1)), status_library)
        else
            call fail(error, "the mass matrix d2L/dv dv is singular: it has the eigenvalue "// &
                      to_text(lambda(1))//" beside "//to_text(lambda(size(root))), status_library)
        end if
    end subroutine check_mass_matrix

    pure subroutine find_eigenvalues(matrix, lambda, error)
        !! In ascending order.
        real(dp), intent(in) :: matrix(:, :)
        real(dp), intent(out) :: lambda(:)
        type(error_t), allocatable, intent(out) :: error
        real(dp), allocatable :: values(:), vectors(:, :)
        real(dp) :: one(size(lambda), size(lambda))
        integer :: i

        lambda = 0.0_dp
        one = 0.0_dp
        do i = 1, size(lambda)
            one(i, i) = 1.0_dp
        end do
        call normal_modes(matrix, one, values, vectors, error)
        if (.not. allocated(error)) lambda = values
    end subroutine find_eigenvalues

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
