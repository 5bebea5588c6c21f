module lagrangia_term_sizes
    !! What rounding may do to a formula, from the sizes of its terms.
    !!
    !! A formula \(f\) of parameters, time, coordinates and velocities \(x_k\) is known to
    !! \(\varepsilon\) times
    !! $$ |f| + \sum_k\left|x_k\,\frac{\partial f}{\partial x_k}\right|, $$
    !! the size of its terms, and of those that cancel in their sum: of \(m_1 g - m_2 g\) it is
    !! \(m_1 g + m_2 g\) at least. It is measured at states and parameters that are smaller by up
    !! to 16 last digits, each by a number of its own; so near by, that what rounding leaves of
    !! terms that cancel everywhere, as \(\cos^2 + \sin^2 - 1\), is seen as well.
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp
    use lagrangia_lagrange, only: euler_lagrange_t, equations_of_motion, expand_lagrangian
    use lagrangia_lapack, only: solve_linear
    use lagrangia_random_draws, only: random_t
    use lagrangia_saddle_point, only: scale_saddle_point, solve_saddle_point
    use lagrangia_system, only: system_box_t, system_t
    implicit none (type, external)
    private
    public :: nearby_t, new_nearby, make_smaller, neighbours
    public :: motion_t, solve_motion, size_of_solution, term_size

    integer, parameter :: neighbours = 8
    real(dp), parameter :: step = 16.0_dp*epsilon(1.0_dp)

    type :: nearby_t
        !! A system at a state, entry 0, and its neighbours.
        type(system_box_t), allocatable :: systems(:)     !! (0:neighbours)
        real(dp), allocatable :: t(:)                     !! (0:neighbours)
        real(dp), allocatable :: q(:, :), v(:, :)         !! (ndof, 0:neighbours)
        type(euler_lagrange_t), allocatable :: terms(:)   !! of L, (0:neighbours)
    end type nearby_t

    type :: motion_t
        !! What the Lagrangian says of the motion at a state, and how well it knows it. `n`
        !! coordinates, `k` non-holonomic constraints.
        real(dp), allocatable :: accelerations(:)      !! (n)
        real(dp), allocatable :: multipliers(:)        !! (k)
        real(dp), allocatable :: size(:)               !! (n), of the terms behind \(\ddot q\)
        real(dp), allocatable :: multiplier_size(:)    !! (k), of those behind \(\lambda\)
        real(dp), allocatable :: equation_size(:)      !! (n), of the terms of the equations
    end type motion_t

contains

    subroutine new_nearby(self, system, values, t, q, v)
        !! The same numbers make the same neighbours.
        type(nearby_t), intent(out) :: self  !! the state and its neighbours
        class(system_t), intent(in) :: system  !! with its parameters
        real(dp), intent(in) :: values(:)   !! its parameters
        real(dp), intent(in) :: t, q(:), v(:)  !! s; coordinates and velocities, (ndof)
        type(random_t) :: random
        type(error_t), allocatable :: error
        real(dp) :: near(size(values))
        integer :: k

        allocate (self%systems(0:neighbours), self%t(0:neighbours), self%terms(0:neighbours))
        allocate (self%q(size(q), 0:neighbours), self%v(size(v), 0:neighbours))
        do k = 0, neighbours
            near = values
            self%t(k) = t
            self%q(:, k) = q
            self%v(:, k) = v
            allocate (self%systems(k)%item, source=system)
            if (k > 0) then
                call make_smaller(random, near)
                call self%systems(k)%item%configure(near, error)
                ! a whole number stays, and what it refuses
                if (allocated(error)) call self%systems(k)%item%configure(values, error)
                call make_smaller(random, self%t(k:k))
                call make_smaller(random, self%q(:, k))
                call make_smaller(random, self%v(:, k))
            end if
            call expand_lagrangian(self%systems(k)%item, self%t(k), self%q(:, k), self%v(:, k), &
                                   self%terms(k))
        end do
    end subroutine new_nearby

    subroutine make_smaller(random, x)
        !! Each by a random part of the step.
        type(random_t), intent(inout) :: random  !! where the parts come from
        real(dp), intent(inout) :: x(:)  !! made smaller
        real(dp) :: part
        integer :: i

        do i = 1, size(x)
            call random%uniform(0.0_dp, 1.0_dp, part)
            x(i) = x(i)*(1.0_dp - part*step)
        end do
    end subroutine make_smaller

    pure function term_size(values) result(size)
        !! The size of the terms of a formula that has these values at the neighbours.
        real(dp), intent(in) :: values(0:)  !! (0:neighbours)
        real(dp) :: size

        ! a part of the step is half of it on average
        size = abs(values(0)) + 2.0_dp/neighbours*sum(abs(values(1:) - values(0)))/step
    end function term_size

    pure subroutine size_of_solution(matrix, size_of_rows, size_of_unknowns, error)
        !! \(|K^{-1}|\,w\): what errors of the size \(w\) in the rows of \(Kx = r\) do to the
        !! unknowns.
        !!
        !! Source: N. J. Higham, Accuracy and Stability of Numerical Algorithms, 2nd ed., sec. 7.2.
        real(dp), intent(in) :: matrix(:, :)           !! \(K\), (n, n), \(|K|\) symmetric
        real(dp), intent(in) :: size_of_rows(:)        !! \(w\), (n)
        real(dp), intent(out) :: size_of_unknowns(:)   !! (n)
        type(error_t), allocatable, intent(out) :: error       !! the matrix is singular
        real(dp) :: scaled(size(matrix, 1), size(matrix, 2))
        real(dp), dimension(size(size_of_rows)) :: right, solution, unit
        integer :: j

        call scale_saddle_point(matrix, scaled, unit)
        size_of_unknowns = 0.0_dp
        do j = 1, size(right)
            right = 0.0_dp
            right(j) = unit(j)*size_of_rows(j)
            call solve_linear(scaled, right, solution, error)
            if (allocated(error)) return
            size_of_unknowns = size_of_unknowns + abs(solution)
        end do
        ! refined once, an unknown that should be zero is an epsilon squared of the others, times
        ! what the elimination made of it
        size_of_unknowns = size_of_unknowns + 1e4_dp*epsilon(1.0_dp)*maxval(size_of_unknowns)
        size_of_unknowns = size_of_unknowns*unit
    end subroutine size_of_solution

    subroutine solve_motion(nearby, motion, error)
        !! Lagrange's equations \(Kx = r\) for the accelerations and multipliers \(x\); the terms
        !! of a row are \(|K||x| + |r|\) and those that cancel in \(K\) and \(r\) themselves.
        type(nearby_t), intent(in) :: nearby  !! the state and its neighbours
        type(motion_t), intent(out) :: motion  !! accelerations, multipliers and their sizes
        type(error_t), allocatable, intent(out) :: error  !! allocated where it fails
        real(dp), allocatable :: matrix(:, :), near(:, :), right(:), x(:), rows(:, :), row_size(:)
        real(dp), allocatable :: unknowns(:)
        integer :: i, k, n, all

        associate (system => nearby%systems(0)%item)
            n = system%ndof
            all = n + system%constraints
        end associate
        allocate (matrix(all, all), near(all, all), right(all), x(all), rows(all, 0:neighbours))
        allocate (row_size(all), unknowns(all))
        do k = 0, neighbours
            call equations_of_motion(nearby%systems(k)%item, nearby%t(k), nearby%q(:, k), &
                                     nearby%v(:, k), nearby%terms(k), near, right)
            if (k == 0) then
                matrix = near
                call solve_saddle_point(matrix, right, x, error)
                if (allocated(error)) return
                row_size = matmul(abs(matrix), abs(x)) + abs(right)
            end if
            rows(:, k) = matmul(near, x) - right
        end do
        associate (terms => nearby%terms(0))  ! all parts of the right-hand side
            row_size(:n) = row_size(:n) + abs(terms%dl_dq) + abs(terms%beside) &
                           + abs(terms%force - terms%beside - terms%dl_dq)
        end associate
        do i = 1, all
            row_size(i) = row_size(i) + term_size(rows(i, :))
        end do
        call size_of_solution(matrix, row_size, unknowns, error)
        if (allocated(error)) return
        allocate (motion%accelerations(n), motion%size(n), motion%equation_size(n))
        allocate (motion%multipliers(all - n), motion%multiplier_size(all - n))
        motion%accelerations = x(:n)
        motion%multipliers = x(n + 1:)
        motion%size = unknowns(:n)
        motion%multiplier_size = unknowns(n + 1:)
        motion%equation_size = row_size(:n)
    end subroutine solve_motion
end module lagrangia_term_sizes
