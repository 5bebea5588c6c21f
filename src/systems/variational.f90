module lagrangia_variational
    !! How the accelerations of a system change with its state, exactly: the linear equations
    !! \(\ddot{\delta q} = \partial\ddot q/\partial q\,\delta q + \partial\ddot q/\partial v\,
    !! \delta v\) of a small displacement of a motion.
    !!
    !! The Lagrangian, as the description prints it or a scene has it, is derived and solved for
    !! the accelerations in symbols; these are differentiated and compiled. The parameters stay
    !! symbols, so that one program serves a whole family of systems, even several of them at once.
    use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
    use lagrangia_derivative, only: time_derivative
    use lagrangia_description, only: default_values, description_t, value_names
    use lagrangia_errors, only: error_t
    use lagrangia_expression, only: expression_t, whole
    use lagrangia_formula_parser, only: parse_equation, parse_formula
    use lagrangia_formula_program, only: formula_program_t, new_formula_program
    use lagrangia_kinds, only: dp, lanes
    use lagrangia_symbols, only: symbols_t
    use lagrangia_system, only: system_t
    use lagrangia_written_motion, only: derive_motion, solve_motion, written_motion_t
    use lagrangia_written_system, only: is_positive, written_system_t
    implicit none (type, external)
    private
    public :: variational_t, new_variational

    real(dp), parameter :: agreement = 2.0_dp**13*epsilon(1.0_dp)
    !! of two ways to the same accelerations, some hundred operations each, beside the largest

    type :: variational_t
        !! None at first.
        logical :: known = .false.
        type(formula_program_t), private :: motion   !! accelerations, pivots, diagonal of M
        type(formula_program_t), private :: program  !! their changes
        type(formula_program_t), private :: both     !! `motion`, then the changes
        logical :: is_code = .false.                 !! the system computes by the same formulas
        integer, private :: n = 0                    !! coordinates
        real(dp), allocatable :: parameters(:)       !! of the system that it has seen last
    contains
        procedure :: fits
        procedure :: accelerations_lanes
        procedure :: change
        procedure :: change_lanes
        procedure :: displaced_lanes
    end type variational_t

contains

    subroutine new_variational(self, system)
        !! Of a system without constraints whose Lagrangian is known as a formula; else, and where
        !! the formulas are not the motion of the code, not `known`.
        type(variational_t), intent(out) :: self  !! for this system, and those that it `fits`
        class(system_t), intent(in) :: system     !! with its parameters
        type(expression_t), allocatable :: solved(:)
        integer :: symbols
        logical :: yes

        if (system%constraints > 0 .or. system%contacts > 0) return
        call solve_for_accelerations(system, solved, symbols, self%is_code)
        if (.not. allocated(solved)) return
        self%n = system%ndof
        call compile(self, solved, symbols)
        self%known = .true.
        call self%fits(system, yes)
        self%known = yes
    end subroutine new_variational

    subroutine solve_for_accelerations(system, solved, count, is_code)
        !! As formulas of t, q, v and the parameters; not allocated where they cannot be had.
        class(system_t), intent(in) :: system
        type(expression_t), allocatable, intent(out) :: solved(:)
        integer, intent(out) :: count    !! symbols
        logical, intent(out) :: is_code  !! they are what the system computes by
        type(written_motion_t) :: motion
        type(expression_t) :: lagrangian
        type(expression_t), allocatable :: forces(:)
        type(symbols_t) :: symbols
        type(description_t) :: d
        type(error_t), allocatable :: error

        count = 0
        is_code = .false.
        select type (system)
        class is (written_system_t)
            is_code = .true.
            allocate (solved, source=system%solved)
            count = size(system%expressions%symbols%names)
            return
        end select
        call system%describe(d)
        if (.not. allocated(d%lagrangian)) return
        call read_names(d, symbols)
        call parse_formula(d%lagrangian, symbols, lagrangian, error)
        if (.not. allocated(error)) call read_forces(d, symbols, forces, error)
        if (allocated(error)) return
        call derive_motion(lagrangian, forces, symbols, motion)
        call solve_motion(motion, solved)
        count = size(symbols%names)
    end subroutine solve_for_accelerations

    subroutine read_names(d, symbols)
        !! t, coordinates, velocities, parameters, and letters with their rates; those that cannot
        !! be read are in no Lagrangian.
        type(description_t), intent(in) :: d
        type(symbols_t), intent(out) :: symbols
        type(expression_t) :: meaning
        type(error_t), allocatable :: error
        integer :: i, k, n, rates(1 + size(d%coordinates))

        n = size(d%coordinates)
        rates = [0, (1 + n + i, i=1, n)]
        call symbols%add("t")
        do i = 1, size(d%coordinates)
            call symbols%add(trim(d%coordinates(i)%name))
        end do
        do i = 1, size(d%coordinates)
            call symbols%add(trim(d%coordinates(i)%name)//"_dot")
        end do
        associate (names => value_names(d))
            do i = 1, size(names)
                call symbols%add(trim(names(i)))
            end do
        end associate
        if (.not. allocated(d%letters)) return
        do i = 1, size(d%letters)
            call parse_formula(trim(d%letters(i)%formula), symbols, meaning, error)
            if (allocated(error)) cycle
            call symbols%define(trim(d%letters(i)%name), meaning, error)
            if (allocated(error)) cycle
            if (any([(meaning%depends_on(1 + n + k), k=1, n)])) cycle
            call symbols%define(trim(d%letters(i)%name)//"_dot", &
                                time_derivative(meaning, rates, 1), error)
        end do
    end subroutine read_names

    subroutine read_forces(d, symbols, forces, error)
        !! Those beside L, `Q_x = ...`; zero where there is none.
        type(description_t), intent(in) :: d
        type(symbols_t), intent(in) :: symbols
        type(expression_t), allocatable, intent(out) :: forces(:)
        type(error_t), allocatable, intent(out) :: error
        type(expression_t) :: left, right
        type(symbols_t) :: names
        integer :: i, k

        allocate (forces(size(d%coordinates)))
        do i = 1, size(forces)
            forces(i) = whole(0)
        end do
        if (.not. allocated(d%generalised_forces)) return
        names = symbols
        do i = 1, size(forces)
            call names%add("Q_"//trim(d%coordinates(i)%name))
        end do
        do k = 1, size(d%generalised_forces)
            call parse_equation(trim(d%generalised_forces(k)), names, left, right, error)
            if (allocated(error)) return
            do i = 1, size(forces)
                if (left%depends_on(size(symbols%names) + i)) forces(i) = right
            end do
        end do
    end subroutine read_forces

    subroutine compile(self, solved, symbols)
        !! Accelerations of all symbols; their changes, of the displacements behind them too.
        type(variational_t), intent(inout) :: self
        type(expression_t), intent(in) :: solved(:)
        integer, intent(in) :: symbols
        type(expression_t) :: both(size(solved) + self%n), changes(self%n)
        integer :: i, rates(symbols)

        rates = 0
        rates(2:1 + 2*self%n) = [(symbols + i, i=1, 2*self%n)]
        do i = 1, self%n
            changes(i) = time_derivative(solved(i), rates, 0)
            both(size(solved) + i) = changes(i)
        end do
        do i = 1, size(solved)
            both(i) = solved(i)
        end do
        call new_formula_program(self%motion, solved, symbols)
        call new_formula_program(self%program, changes, symbols + 2*self%n)
        call new_formula_program(self%both, both, symbols + 2*self%n)
    end subroutine compile

    subroutine fits(self, system, yes)
        !! Take the parameters of a system; are these its motions? At three states the code's
        !! accelerations are those of the formulas.
        class(variational_t), intent(inout) :: self
        class(system_t), intent(in) :: system  !! with its parameters
        logical, intent(out) :: yes            !! `change` is that of this system
        type(description_t) :: d
        real(dp), dimension(system%ndof) :: a, q, v
        real(dp) :: solved(3*system%ndof), t
        integer :: i, k

        yes = self%known .and. system%ndof == self%n
        if (.not. yes) return
        call system%describe(d)
        if (allocated(self%parameters)) deallocate (self%parameters)
        allocate (self%parameters, source=default_values(d))
        yes = 1 + 2*self%n + size(self%parameters) == self%motion%inputs
        if (self%is_code .or. .not. yes) return
        do k = 1, 3
            t = 0.7_dp*k
            q = [(0.3_dp + 0.2_dp*sin(2.0_dp*i + k), i=1, size(q))]
            v = [(cos(3.0_dp*i + k), i=1, size(v))]
            call system%accelerations(t, q, v, a)
            call self%motion%evaluate([t, q, v, self%parameters], solved)
            yes = yes .and. maxval(abs(a - solved(:self%n))) <= &
                  agreement*max(1.0_dp, maxval(abs(a)))
        end do
    end subroutine fits

    pure subroutine accelerations_lanes(self, t, q, v, parameters, a)
        !! Those of eight systems of the family, each with its own parameters; NaN where a pivot of
        !! the mass matrix is not positive.
        class(variational_t), intent(in) :: self            !! one that is `known`
        real(dp), intent(in) :: t(lanes), q(lanes, self%n), v(lanes, self%n)  !! times, s; states
        real(dp), intent(in) :: parameters(:, :)            !! in the order of the description
        real(dp), intent(out) :: a(lanes, self%n)           !! accelerations
        real(dp) :: results(lanes, 3*self%n), values(lanes, self%motion%inputs)
        integer :: i, n

        n = self%n
        values(:, 1) = t
        values(:, 2:1 + n) = q
        values(:, 2 + n:1 + 2*n) = v
        values(:, 2 + 2*n:) = parameters
        call self%motion%evaluate(values, results)
        a = results(:, :n)
        do i = 1, lanes
            if (all(is_positive(results(i, n + 1:2*n), results(i, 2*n + 1:), n))) cycle
            call set_to_nan(a(i, :))
        end do
    end subroutine accelerations_lanes

    pure subroutine set_to_nan(a)
        !! Apart from what is called often: see `lagrangia_written_system`.
        real(dp), intent(out) :: a(:)

        a = ieee_value(a, ieee_quiet_nan)
    end subroutine set_to_nan

    pure subroutine change(self, t, q, v, dq, dv, da)
        !! How a displacement changes the accelerations.
        class(variational_t), intent(in) :: self            !! one that is `known` and `fits`
        real(dp), intent(in) :: t, q(self%n), v(self%n)     !! time, s; state
        real(dp), intent(in) :: dq(self%n), dv(self%n)      !! displacement, of any length
        real(dp), intent(out) :: da(self%n)                 !! linear in the displacement

        call self%program%evaluate([t, q, v, self%parameters, dq, dv], da)
    end subroutine change

    pure subroutine change_lanes(self, t, q, v, dq, dv, da)
        !! `change`, in all lanes at once.
        class(variational_t), intent(in) :: self
        !! one that is `known` and `fits`
        real(dp), intent(in) :: t(lanes), q(lanes, self%n), v(lanes, self%n)
        !! times, s; states
        real(dp), intent(in) :: dq(lanes, self%n), dv(lanes, self%n)
        !! displacements
        real(dp), intent(out) :: da(lanes, self%n)  !! linear in the displacements
        real(dp) :: values(lanes, self%program%inputs)
        integer :: first, n

        n = self%n
        first = 1 + 2*n + size(self%parameters)
        values(:, 1) = t
        values(:, 2:1 + n) = q
        values(:, 2 + n:1 + 2*n) = v
        values(:, 2 + 2*n:first) = spread(self%parameters, 1, lanes)
        values(:, first + 1:first + n) = dq
        values(:, first + n + 1:) = dv
        call self%program%evaluate(values, da)
    end subroutine change_lanes

    pure subroutine displaced_lanes(self, t, q, v, parameters, a)
        !! Accelerations of eight systems of the family, each with its own parameters, and how they
        !! change along displacements; NaN where a pivot of the mass matrix is not positive.
        class(variational_t), intent(in) :: self            !! one that is `known`
        real(dp), intent(in) :: t(lanes)                    !! times, s
        real(dp), intent(in) :: q(lanes, 2*self%n)          !! coordinates, then displacements
        real(dp), intent(in) :: v(lanes, 2*self%n)          !! their velocities
        real(dp), intent(in) :: parameters(:, :)            !! in the order of the description
        real(dp), intent(out) :: a(lanes, 2*self%n)         !! accelerations, then their changes
        real(dp) :: results(lanes, 4*self%n), values(lanes, self%both%inputs)
        integer :: first, i, n

        n = self%n
        first = 1 + 2*n + size(parameters, 2)
        values(:, 1) = t
        values(:, 2:1 + n) = q(:, :n)
        values(:, 2 + n:1 + 2*n) = v(:, :n)
        values(:, 2 + 2*n:first) = parameters
        values(:, first + 1:first + n) = q(:, n + 1:)
        values(:, first + n + 1:) = v(:, n + 1:)
        call self%both%evaluate(values, results)
        a(:, :n) = results(:, :n)
        a(:, n + 1:) = results(:, 3*n + 1:)
        do i = 1, lanes
            if (all(is_positive(results(i, n + 1:2*n), results(i, 2*n + 1:3*n), n))) cycle
            call set_to_nan(a(i, :))
        end do
    end subroutine displaced_lanes
end module lagrangia_variational
