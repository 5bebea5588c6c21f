module lagrangia_gauss_principle
    !! Gauss's principle of least constraint: of all accelerations that the constraints allow, the
    !! actual ones make
    !! $$ Z = \sum_i m_i\left(\ddot x_i - \frac{F_i}{m_i}\right)^2 $$
    !! least. From Cartesian masses, forces and constraints alone, without a Lagrangian: an
    !! independent test of the equations of motion, also of non-holonomic systems.
    !!
    !! Constraints \(c(t, x) = 0\), differentiated twice, and \(g(t, x, \dot x) = 0\), linear in
    !! \(\dot x\), differentiated once, are \(A\ddot x = b\). The force that they exert is
    !! \(m\ddot x - F = A^\top\lambda\): \(\lambda\) is the tension or the normal force.
    !!
    !! Source: C. F. Gauss, J. reine angew. Math. 4, 232 (1829).
    use lagrangia_description, only: description_t
    use lagrangia_errors, only: error_t, fail
    use lagrangia_hyperdual, only: hyperdual_t
    use lagrangia_kinds, only: dp
    use lagrangia_saddle_point, only: solve_saddle_point
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: cartesian_t, gauss_equations, least_constraint, linearise, masses_of, new_cartesian, &
              place_points

    type :: cartesian_t
        !! A state as Newton has it, and what Gauss makes of it. `n` Cartesian coordinates, `k`
        !! constraints.
        real(dp), allocatable :: mass(:)           !! (n), kg; kg m^2 of an angle
        real(dp), allocatable :: x(:), x_dot(:)    !! (n), m or rad, and per s
        real(dp), allocatable :: x_ddot(:)         !! (n), as the system's accelerations have it
        real(dp), allocatable :: force(:)          !! (n), applied, N
        real(dp), allocatable :: slope(:, :)       !! \(A\), (k, n)
        real(dp), allocatable :: right(:)          !! \(b\), (k)
        real(dp), allocatable :: constraint_residual(:)   !! (k), zero if the state is one
        real(dp), allocatable :: acceleration(:)   !! (n), Gauss's
        real(dp), allocatable :: reaction(:)       !! \(\lambda\), (k)
    end type cartesian_t

contains

    pure subroutine least_constraint(system, t, q, v, c, error)
        !! Accelerations and reactions at one state; fails where the system has no `newton`.
        class(system_t), intent(in) :: system  !! with its parameters
        real(dp), intent(in) :: t, q(system%ndof), v(system%ndof)  !! s; coordinates and velocities
        type(cartesian_t), intent(out) :: c  !! the state as Newton has it
        type(error_t), allocatable, intent(out) :: error  !! allocated where it fails
        real(dp) :: a(system%ndof)

        call system%accelerations(t, q, v, a)
        call new_cartesian(system, t, q, v, a, c, error)
        if (allocated(error)) return
        call minimise(c, error)
    end subroutine least_constraint

    pure subroutine new_cartesian(system, t, q, v, a, c, error)
        !! From generalised coordinates, velocities and accelerations to Cartesian ones; masses,
        !! forces, and the constraints as \(A\ddot x = b\).
        class(system_t), intent(in) :: system  !! with its parameters
        real(dp), intent(in) :: t, q(system%ndof), v(system%ndof), a(system%ndof)
        !! s; coordinates, velocities, accelerations
        type(cartesian_t), intent(out) :: c  !! the state as Newton has it
        type(error_t), allocatable, intent(out) :: error  !! allocated where it fails
        type(description_t) :: d
        type(hyperdual_t) :: path(system%ndof)
        type(hyperdual_t), allocatable :: x(:)

        call system%describe(d)
        if (.not. allocated(d%reactions)) then
            call fail(error, trim(d%name)//" does not say what acts on its points")
            return
        end if
        allocate (c%mass, source=masses_of(d))
        allocate (x(size(c%mass)))
        path%re = q
        path%d1 = v
        path%d2 = v
        path%d12 = a
        call place_points(system, d, hyperdual_t(t, 1.0_dp, 1.0_dp, 0.0_dp), path, x)
        allocate (c%x(size(x)), c%x_dot(size(x)), c%x_ddot(size(x)))
        c%x = x%re
        c%x_dot = x%d1
        c%x_ddot = x%d12
        allocate (c%force(size(x)), c%slope(size(d%reactions), size(x)))
        allocate (c%right(size(d%reactions)), c%constraint_residual(size(d%reactions)))
        call linearise(system, t, c)
    end subroutine new_cartesian

    pure function masses_of(d) result(mass)
        !! Of the Cartesian coordinates, kg: three of each point, then one angle of each rotor,
        !! kg m^2.
        type(description_t), intent(in) :: d  !! the system's
        real(dp), allocatable :: mass(:)
        integer :: i, points, rotors

        points = 0
        rotors = 0
        if (allocated(d%points)) points = size(d%points)
        if (allocated(d%rotors)) rotors = size(d%rotors)
        allocate (mass(3*points + rotors))
        do i = 1, points
            mass(3*i - 2:3*i) = d%points(i)%mass
        end do
        if (rotors > 0) mass(3*points + 1:) = d%rotors%mass
    end function masses_of

    pure subroutine place_points(system, d, t, q, x)
        !! The Cartesian coordinates, in the order of `masses_of`.
        class(system_t), intent(in) :: system  !! with its parameters
        type(description_t), intent(in) :: d    !! the system's own
        type(hyperdual_t), intent(in) :: t      !! s
        type(hyperdual_t), intent(in) :: q(:)   !! (ndof)
        type(hyperdual_t), intent(out) :: x(:)  !! (n), m and rad
        type(hyperdual_t), allocatable :: r(:, :)
        integer :: points

        points = 0
        if (allocated(d%points)) points = size(d%points)
        allocate (r(3, points))
        call system%positions(t, q, r)
        x(:3*points) = reshape(r, [3*points])
        call system%angles(t, q, x(3*points + 1:))
    end subroutine place_points

    pure subroutine linearise(system, t, c)
        !! From `x` and `x_dot`: forces; slopes of the constraints, one coordinate after the
        !! other; their rates at constant velocity.
        class(system_t), intent(in) :: system  !! with its parameters
        real(dp), intent(in) :: t                !! s
        type(cartesian_t), intent(inout) :: c    !! all of it allocated
        type(hyperdual_t), dimension(size(c%x)) :: x, u
        type(hyperdual_t) :: residual(size(c%constraint_residual))
        integer :: i, holonomic

        holonomic = size(residual) - system%constraints
        x%re = c%x
        u%re = c%x_dot
        do i = 1, size(c%x)
            x(i)%d1 = 1.0_dp
            call system%newton(hyperdual_t(re=t), x, u, c%force, residual)
            c%slope(:holonomic, i) = residual(:holonomic)%d1
            x(i)%d1 = 0.0_dp
            u(i)%d1 = 1.0_dp
            call system%newton(hyperdual_t(re=t), x, u, c%force, residual)
            c%slope(holonomic + 1:, i) = residual(holonomic + 1:)%d1
            u(i)%d1 = 0.0_dp
        end do
        x%d1 = c%x_dot
        x%d2 = c%x_dot
        call system%newton(hyperdual_t(t, 1.0_dp, 1.0_dp, 0.0_dp), x, u, c%force, residual)
        c%constraint_residual = residual%re
        c%right(:holonomic) = -residual(:holonomic)%d12
        c%right(holonomic + 1:) = -residual(holonomic + 1:)%d1
    end subroutine linearise

    pure subroutine gauss_equations(c, matrix, right)
        !! What the minimum of \(Z\) fulfils, with a multiplier for each constraint:
        !! \(m\ddot x - A^\top\lambda = F\) and \(A\ddot x = b\), as one linear system for
        !! \((\ddot x, \lambda)\).
        type(cartesian_t), intent(in) :: c  !! the state as Newton has it
        real(dp), intent(out) :: matrix(:, :)  !! (n + k, n + k)
        real(dp), intent(out) :: right(:)      !! (n + k)
        integer :: i, n

        n = size(c%x)
        matrix = 0.0_dp
        do i = 1, n
            matrix(i, i) = c%mass(i)
        end do
        matrix(:n, n + 1:) = -transpose(c%slope)
        matrix(n + 1:, :n) = c%slope
        right(:n) = c%force
        right(n + 1:) = c%right
    end subroutine gauss_equations

    pure subroutine minimise(self, error)
        !! Minimise \(Z\), and the multipliers with it. \(Z\) is a sum of squares: it is least
        !! where it does not change along any direction that the constraints allow.
        type(cartesian_t), intent(inout) :: self
        type(error_t), allocatable, intent(out) :: error
        real(dp), dimension(size(self%x) + size(self%right)) :: solution, right
        real(dp) :: matrix(size(solution), size(solution))

        call gauss_equations(self, matrix, right)
        call solve_saddle_point(matrix, right, solution, error)
        if (allocated(error)) return
        allocate (self%acceleration(size(self%x)), self%reaction(size(self%right)))
        self%acceleration = solution(:size(self%x))
        self%reaction = solution(size(self%x) + 1:)
    end subroutine minimise
end module lagrangia_gauss_principle
