module lagrangia_equation_terms
    !! The terms of Lagrange's equations one by one, as they stand on the page:
    !! $$ \sum_j M_{ij}\ddot q_j = f_i(t, q) + \sum_j g_{ij}\dot q_j
    !!    + \sum_{j\le k} c_{ijk}\dot q_j\dot q_k + Q_i\;(+\; A^\top\lambda)_i $$
    !! for a Lagrangian of degree two in the velocities, as it is in all the lectures.
    use lagrangia_description, only: description_t, name_length
    use lagrangia_errors, only: error_t
    use lagrangia_hyperdual, only: hyperdual_t
    use lagrangia_kinds, only: dp
    use lagrangia_lagrange, only: euler_lagrange_t, expand_lagrangian
    use lagrangia_saddle_point, only: solve_saddle_point
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: equation_terms, acceleration_terms, term_count, term_names, term_length

    integer, parameter :: term_length = 2*name_length + 24

contains

    pure function term_count(n) result(number)
        !! On the right-hand side of an equation of `n` coordinates.
        integer, intent(in) :: n  !! coordinates
        integer :: number

        number = 1 + n + n*(n + 1)/2 + 1
    end function term_count

    pure subroutine equation_terms(system, t, q, v, terms)
        !! The terms on the right, `terms(i, k)` of equation `i`: found by setting velocities to
        !! zero and by turning their signs. They add up to all of it.
        class(system_t), intent(in) :: system  !! with its parameters
        real(dp), intent(in) :: t, q(system%ndof), v(system%ndof)  !! s; coordinates and velocities
        real(dp), allocatable, intent(out) :: terms(:, :)  !! (ndof, terms)
        real(dp), dimension(system%ndof) :: none, one, rest, plus, minus
        real(dp) :: alone(system%ndof, system%ndof)
        type(euler_lagrange_t) :: here
        integer :: j, k, column

        allocate (terms(system%ndof, term_count(system%ndof)))
        none = 0.0_dp
        rest = forces(none)
        terms(:, 1) = rest
        do j = 1, system%ndof
            one = none
            one(j) = v(j)
            plus = forces(one)
            minus = forces(-one)
            terms(:, 1 + j) = 0.5_dp*(plus - minus)
            alone(:, j) = 0.5_dp*(plus + minus) - rest
        end do
        column = 1 + system%ndof
        do j = 1, system%ndof
            do k = j, system%ndof
                column = column + 1
                if (k == j) then
                    terms(:, column) = alone(:, j)
                else
                    one = none
                    one(j) = v(j)
                    one(k) = v(k)
                    plus = 0.5_dp*(forces(one) + forces(-one))
                    terms(:, column) = plus - rest - alone(:, j) - alone(:, k)
                end if
            end do
        end do
        call expand_lagrangian(system, t, q, v, here)
        terms(:, column + 1) = here%beside
    contains
        pure function forces(velocities) result(right)
            real(dp), intent(in) :: velocities(:)
            real(dp) :: right(size(velocities))
            type(euler_lagrange_t) :: expanded

            call expand_lagrangian(system, t, q, velocities, expanded)
            right = expanded%force - expanded%beside
        end function forces
    end subroutine equation_terms

    pure function term_names(d) result(names)
        !! What the terms on the right are, in the order of `equation_terms`.
        type(description_t), intent(in) :: d  !! the system's
        character(term_length), allocatable :: names(:)
        integer :: j, k, column, n

        n = size(d%coordinates)
        allocate (names(term_count(n)))
        names(1) = "term without velocities"
        column = 1 + n
        do j = 1, n
            associate (name => trim(d%coordinates(j)%name)//"_dot")
                names(1 + j) = "term in "//name
                do k = j, n
                    column = column + 1
                    names(column) = "term in "//name//" "//trim(d%coordinates(k)%name)//"_dot"
                    if (k == j) names(column) = "term in "//name//"^2"
                end do
            end associate
        end do
        names(column + 1) = "generalised force"
    end function term_names

    subroutine acceleration_terms(system, t, q, v, terms, error)
        !! What each term of each equation does to each acceleration, `terms(i, k, j)`: of term `k`
        !! of equation `j` to \(\ddot q_i\). One equation more stands for the non-holonomic
        !! constraints, with their velocity terms as its first.
        class(system_t), intent(in) :: system  !! with its parameters
        real(dp), intent(in) :: t, q(system%ndof), v(system%ndof)  !! s; coordinates and velocities
        real(dp), allocatable, intent(out) :: terms(:, :, :)  !! (ndof, terms, equations)
        type(error_t), allocatable, intent(out) :: error  !! allocated where it fails
        type(euler_lagrange_t) :: expanded
        type(hyperdual_t) :: path(system%ndof)
        type(hyperdual_t) :: rows(system%constraints, system%ndof), b(system%constraints)
        real(dp), allocatable :: forces(:, :), matrix(:, :), right(:), solution(:)
        integer :: j, k, n, all

        n = system%ndof
        all = n + system%constraints
        allocate (matrix(all, all), right(all), solution(all))
        call expand_lagrangian(system, t, q, v, expanded)
        call equation_terms(system, t, q, v, forces)
        allocate (terms(n, size(forces, 2), n + 1))
        terms = 0.0_dp
        path%re = q
        path%d1 = v
        call system%constraint_rows(hyperdual_t(re=t, d1=1.0_dp), path, rows, b)
        matrix = 0.0_dp
        matrix(:n, :n) = expanded%mass
        matrix(n + 1:, :n) = rows%re
        matrix(:n, n + 1:) = -transpose(rows%re)
        do j = 1, all
            right = 0.0_dp
            right(j) = 1.0_dp
            call solve_saddle_point(matrix, right, solution, error)
            if (allocated(error)) return
            if (j > n) then
                terms(:, 1, n + 1) = terms(:, 1, n + 1) - solution(:n) &
                                     *(dot_product(rows(j - n, :)%d1, v) + b(j - n)%d1)
                cycle
            end if
            do k = 1, size(forces, 2)
                terms(:, k, j) = solution(:n)*forces(j, k)
            end do
        end do
    end subroutine acceleration_terms
end module lagrangia_equation_terms
