module lagrangia_tangent_space
    !! Small oscillations with constraints \(A(q)\,\dot q = 0\) beside L.
    !!
    !! At rest \(F + A^\top\lambda = 0\), with \(F\) the force of L. What the constraints allow are
    !! the displacements \(\delta = Z\xi\), where the columns of \(Z\) span the null space of
    !! \(A\); and since \(A^\top\lambda\) turns with them, the stiffness there is that of L less
    !! \(\sum_k\lambda_k\,\partial A_{ki}/\partial q_j\). This needs constraints that can be
    !! integrated to \(f(q) = 0\), by Frobenius if
    !! \(Z^\top(\partial A_k - \partial A_k^\top)Z = 0\): with others there are steady motions,
    !! but no potential well on a surface.
    !!
    !! Source: H. Goldstein, *Classical Mechanics*, 2nd ed. (1980), sec. 2-4 and 6-2; Frobenius'
    !! theorem: V. I. Arnold, *Mathematical Methods of Classical Mechanics*, app. 4.
    use lagrangia_description, only: description_t, sizes_of_places
    use lagrangia_errors, only: error_t, fail
    use lagrangia_hyperdual, only: hyperdual_t
    use lagrangia_kinds, only: dp
    use lagrangia_lapack, only: solve_linear
    use lagrangia_mass_matrix, only: list_of
    use lagrangia_null_space, only: null_space
    use lagrangia_number_class, only: is_nonzero
    use lagrangia_random_draws, only: random_t
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: check_integrable, find_tangent, tangent_t, within

    type :: tangent_t
        !! Of `m` constraints on `n` coordinates at one place.
        real(dp), allocatable :: rows(:, :)     !! \(A\), (m, n)
        real(dp), allocatable :: turn(:, :, :)  !! \(\partial A_{ki}/\partial q_j\), (m, n, n)
        real(dp), allocatable :: basis(:, :)    !! \(Z\), (n, n - m), orthonormal
    contains
        procedure :: find_multipliers
        procedure :: stiffness
    end type tangent_t

contains

    pure subroutine find_tangent(system, q, tangent, error)
        !! The constraints at `q`, to first order.
        class(system_t), intent(in) :: system             !! with constraints
        real(dp), intent(in) :: q(:)                      !! (n)
        type(tangent_t), intent(out) :: tangent           !! incomplete after an error
        type(error_t), allocatable, intent(out) :: error
        !! the time in a constraint; constraints that are not independent here
        type(hyperdual_t) :: t, qq(size(q)), rows(system%constraints, size(q))
        type(hyperdual_t) :: drift(system%constraints)
        real(dp) :: square(max(size(q), system%constraints), size(q))
        logical :: tied
        integer :: i, m, n

        n = size(q)
        m = system%constraints
        tied = .false.
        allocate (tangent%rows(m, n), tangent%turn(m, n, n))
        qq%re = q
        t%d2 = 1.0_dp
        do i = 1, n
            qq(i)%d1 = 1.0_dp
            call system%constraint_rows(t, qq, rows, drift)
            tangent%turn(:, :, i) = rows%d1
            tied = tied .or. any(is_nonzero(drift%d1))
            qq(i)%d1 = 0.0_dp
        end do
        tangent%rows = rows%re
        if (any(is_nonzero(rows%d2)) .or. any(is_nonzero(drift%re)) .or. &
            any(is_nonzero(drift%d2))) then
            call fail(error, "a constraint contains the time: there is no equilibrium to "// &
                      "oscillate about")
            return
        else if (tied) then
            call fail(error, "a constraint ties velocities to places: no modes are known then")
            return
        end if
        square = 0.0_dp
        square(:m, :) = tangent%rows
        call null_space(square, tangent%basis, error)
        if (allocated(error)) return
        do i = 1, size(tangent%basis, 2)
            associate (z => tangent%basis(:, i))  ! as readers would draw it
                z = sign(1.0_dp, z(maxloc(abs(z), 1)))*z
            end associate
        end do
        if (size(tangent%basis, 2) /= n - m) call fail(error, "the constraints are not "// &
            "independent at q = "//list_of(q)//"; an equilibrium elsewhere is needed", &
            key="at")
    end subroutine find_tangent

    subroutine check_integrable(system, q, error)
        !! Refuse constraints that cannot be integrated, by Frobenius' test at `q` and at places
        !! around it: to \(10^{-9}\) of its terms.
        class(system_t), intent(in) :: system             !! with constraints
        real(dp), intent(in) :: q(:)                      !! (n)
        type(error_t), allocatable, intent(out) :: error  !! also those of `find_tangent` at `q`
        integer, parameter :: places = 4
        real(dp), parameter :: bound = 1e-9_dp
        type(description_t) :: d
        type(error_t), allocatable :: elsewhere
        type(random_t) :: random
        type(tangent_t) :: tangent
        real(dp) :: at(size(q)), turn(size(q), size(q))
        integer :: i, k

        call find_tangent(system, q, tangent, error)
        if (allocated(error)) return
        call system%describe(d)
        at = q
        call random%start(1)
        do i = 0, places
            if (i > 0) then
                do k = 1, size(q)
                    call random%uniform(-0.5_dp, 0.5_dp, at(k))
                end do
                at = q + at*max(sizes_of_places(d), abs(q))
                call find_tangent(system, at, tangent, elsewhere)
                if (allocated(elsewhere)) cycle
            end if
            do k = 1, system%constraints
                turn = tangent%turn(k, :, :)
                if (all(abs(within(tangent%basis, turn - transpose(turn))) <= &
                        bound*maxval(abs(turn)))) cycle
                call fail(error, "its constraints are nonholonomic: steady motions, but no "// &
                          "modes about an equilibrium")
                return
            end do
        end do
    end subroutine check_integrable

    pure subroutine find_multipliers(self, force, lambda, error)
        !! \(\lambda\) of \(F + A^\top\lambda = 0\), the least squares where there is no rest.
        class(tangent_t), intent(in) :: self
        real(dp), intent(in) :: force(:)                  !! \(F\), (n)
        real(dp), intent(out) :: lambda(:)                !! (m)
        type(error_t), allocatable, intent(out) :: error  !! LAPACK's

        call solve_linear(matmul(self%rows, transpose(self%rows)), -matmul(self%rows, force), &
                          lambda, error)
    end subroutine find_multipliers

    pure function stiffness(self, lambda) result(k)
        !! What the multipliers add to that of L.
        class(tangent_t), intent(in) :: self
        real(dp), intent(in) :: lambda(:)               !! (m)
        real(dp) :: k(size(self%rows, 2), size(self%rows, 2))
        integer :: i

        k = 0.0_dp
        do i = 1, size(lambda)
            k = k - lambda(i)*self%turn(i, :, :)
        end do
    end function stiffness

    pure function within(basis, matrix) result(projected)
        !! \(Z^\top M Z\).
        real(dp), intent(in) :: basis(:, :)             !! \(Z\), (n, r)
        real(dp), intent(in) :: matrix(:, :)            !! \(M\), (n, n)
        real(dp) :: projected(size(basis, 2), size(basis, 2))

        projected = matmul(transpose(basis), matmul(matrix, basis))
    end function within
end module lagrangia_tangent_space
