module lagrangia_discrete_action
    !! The action of a path given by points, its gradient and its Hessian.
    !!
    !! $$ S_d = \sum_k \frac h2\left[L(t_k, q_k, u_k) + L(t_{k+1}, q_{k+1}, u_k)\right],\qquad
    !!    u_k = \frac{q_{k+1} - q_k}h $$
    !! For \(L = T - V\) with constant masses, \(\partial S_d/\partial q_k = 0\) is Störmer-Verlet.
    !!
    !! Source: Marsden & West, Acta Numerica 10, 357 (2001), secs. 1.1, 2.3.
    use lagrangia_errors, only: error_t, fail, status_numbers
    use lagrangia_hyperdual, only: assignment(=), hyperdual, hyperdual_t, operator(*), &
        operator(+), operator(-), operator(/)
    use lagrangia_kinds, only: dp
    use lagrangia_lapack, only: count_negative, lowest_mode, solve_band
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: action_gradient, action_of, expand_action, find_path, lowest_variation, &
              negative_curvatures

    integer, parameter :: most_steps = 30            !! of Newton's method
    real(dp), parameter :: nearly_there = 1e-7_dp    !! the next step squares it

contains

    pure function segment(system, t, h, a, b) result(s)
        !! The action between two neighbours.
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t, h
        type(hyperdual_t), intent(in) :: a(system%ndof), b(system%ndof)
        type(hyperdual_t) :: s, u(system%ndof)

        u = (b - a)/h
        s = 0.5_dp*h*(system%lagrangian(hyperdual(t), a, u) &
                      + system%lagrangian(hyperdual(t + h), b, u))
    end function segment

    pure function action_of(system, t0, h, path) result(s)
        !! \(S_d\), summed with the rounding errors kept (Neumaier 1974).
        class(system_t), intent(in) :: system  !! with its parameters
        real(dp), intent(in) :: t0, h       !! s
        real(dp), intent(in) :: path(:, :)  !! (ndof, points)
        real(dp) :: s
        type(hyperdual_t) :: part, a(system%ndof), b(system%ndof)
        real(dp) :: total, lost
        integer :: k

        s = 0.0_dp
        lost = 0.0_dp
        do k = 1, size(path, 2) - 1
            a = hyperdual(path(:, k))
            b = hyperdual(path(:, k + 1))
            part = segment(system, t0 + (k - 1)*h, h, a, b)
            total = s + part%re
            lost = lost + merge((s - total) + part%re, (part%re - total) + s, abs(s) > abs(part%re))
            s = total
        end do
        s = s + lost
    end function action_of

    pure subroutine expand_action(system, t0, h, path, gradient, band)
        !! First and second derivatives by the inner points, \(n (N - 1)\) of them.
        class(system_t), intent(in) :: system  !! with its parameters
        real(dp), intent(in) :: t0, h       !! s
        real(dp), intent(in) :: path(:, :)  !! (ndof, points)
        real(dp), allocatable, intent(out) :: gradient(:)  !! point by point
        real(dp), allocatable, intent(out) :: band(:, :)   !! the Hessian, as `solve_band` wants it
        type(hyperdual_t) :: ends(2*system%ndof), s
        integer :: n, width, last, k, i, j, row, column

        n = system%ndof
        width = 2*n - 1
        last = n*(size(path, 2) - 2)
        allocate (gradient(last), band(2*width + 1, last))
        gradient = 0.0_dp
        band = 0.0_dp
        do k = 1, size(path, 2) - 1
            ends(:n) = hyperdual(path(:, k))
            ends(n + 1:) = hyperdual(path(:, k + 1))
            do i = 1, 2*n
                row = (k - 2)*n + i
                if (row < 1 .or. row > last) cycle
                ends(i)%d1 = 1.0_dp
                do j = 1, 2*n
                    column = (k - 2)*n + j
                    if (column < 1 .or. column > last) cycle
                    ends(j)%d2 = 1.0_dp
                    s = segment(system, t0 + (k - 1)*h, h, ends(:n), ends(n + 1:))
                    ends(j)%d2 = 0.0_dp
                    band(width + 1 + row - column, column) = &
                        band(width + 1 + row - column, column) + s%d12
                end do
                ends(i)%d1 = 0.0_dp
                gradient(row) = gradient(row) + s%d1
            end do
        end do
    end subroutine expand_action

    pure function action_gradient(system, t0, h, path) result(largest)
        !! \(\max_k|\partial S_d/\partial q_k|/h\): by how much Lagrange's equations fail.
        class(system_t), intent(in) :: system  !! with its parameters
        real(dp), intent(in) :: t0, h, path(:, :)  !! s; s; (ndof, points)
        real(dp) :: largest
        real(dp), allocatable :: gradient(:), band(:, :)

        call expand_action(system, t0, h, path, gradient, band)
        largest = maxval(abs(gradient))/h
    end function action_gradient

    pure subroutine find_path(system, t0, h, path, error)
        !! Solve \(\delta S_d = 0\) by Newton's method; the first and the last point stay, and
        !! all of them where it fails.
        class(system_t), intent(in) :: system  !! with its parameters
        real(dp), intent(in) :: t0, h  !! s
        real(dp), intent(inout) :: path(:, :)  !! a guess, then the stationary path
        type(error_t), allocatable, intent(out) :: error  !! no convergence, or a conjugate point
        real(dp), allocatable :: found(:, :), gradient(:), band(:, :), change(:)
        integer :: n, points, step
        logical :: close_enough

        n = system%ndof
        points = size(path, 2)
        close_enough = .false.
        allocate (found, source=path)
        do step = 1, most_steps
            call expand_action(system, t0, h, found, gradient, band)
            if (.not. allocated(change)) allocate (change(size(gradient)))
            call solve_band(band, gradient, change, error)
            if (allocated(error)) then
                call error%add_context("path between two points")
                return
            end if
            found(:, 2:points - 1) = found(:, 2:points - 1) - reshape(change, [n, points - 2])
            if (close_enough) then
                path = found
                return
            end if
            close_enough = maxval(abs(change)) <= nearly_there*maxval(abs(found))
        end do
        call fail(error, "path between two points: Newton's method does not converge", &
                  status_numbers)
    end subroutine find_path

    pure subroutine negative_curvatures(system, t0, h, path, count, error)
        !! In how many independent directions a variation lowers the action: Morse's index.
        !! One coordinate only, so that the Hessian is tridiagonal.
        class(system_t), intent(in) :: system  !! with its parameters
        real(dp), intent(in) :: t0, h, path(:, :)  !! s; s; (ndof, points)
        integer, intent(out) :: count  !! of the negative eigenvalues
        type(error_t), allocatable, intent(out) :: error  !! allocated where it fails
        real(dp), allocatable :: gradient(:), band(:, :)

        call expand_action(system, t0, h, path, gradient, band)
        call count_negative(band(2, :), band(3, :size(gradient) - 1), count, error)
    end subroutine negative_curvatures

    pure subroutine lowest_variation(system, t0, h, path, variation, error)
        !! The variation along which the action is bent least, or falls most: the eigenvector of
        !! the lowest eigenvalue of its Hessian. Zero at both ends; its largest value is 1. One
        !! coordinate only.
        class(system_t), intent(in) :: system  !! with its parameters
        real(dp), intent(in) :: t0, h           !! s
        real(dp), intent(in) :: path(:, :)      !! (1, points)
        real(dp), intent(out) :: variation(:)   !! (points)
        type(error_t), allocatable, intent(out) :: error  !! LAPACK's
        real(dp), allocatable :: gradient(:), band(:, :)
        real(dp) :: lowest, inner(size(path, 2) - 2)

        variation = 0.0_dp
        call expand_action(system, t0, h, path, gradient, band)
        call lowest_mode(band(2, :), band(3, :size(gradient) - 1), lowest, inner, error)
        if (allocated(error)) return
        variation(2:size(path, 2) - 1) = inner/inner(maxloc(abs(inner), 1))
    end subroutine lowest_variation
end module lagrangia_discrete_action
