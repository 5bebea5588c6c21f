module lagrangia_bound_system
    !! Constraints beside L, holonomic, \(f(t, q) = 0\), or in the velocities,
    !! \(A(t, q)\,\dot q + b(t, q) = 0\): who has some gives `constraint_rows`, and, of holonomic
    !! ones, `constraint_values`; how a state is put onto them follows.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use lagrangia_counted, only: counted
    use lagrangia_description, only: description_t, velocity_names
    use lagrangia_errors, only: error_t, fail
    use lagrangia_hyperdual, only: hyperdual_t
    use lagrangia_kinds, only: dp
    use lagrangia_lagrange, only: accelerations_from_lagrangian, euler_lagrange_t, &
                                  expand_lagrangian
    use lagrangia_lapack, only: matrix_rank, solve_linear
    use lagrangia_mass_matrix, only: list_of
    use lagrangia_saddle_point, only: solve_saddle_point
    use lagrangia_system, only: all_velocities, system_t
    use lagrangia_text, only: join, to_text
    implicit none (type, external)
    private
    public :: bound_system_t

    real(dp), parameter :: slip = sqrt(epsilon(1.0_dp))
    !! what may be missing of a constraint at the start, relative: its square is rounding

    type, abstract, extends(system_t) :: bound_system_t
        !! Who sets `constraints` sets this, too, and `is_projected` if there are holonomic ones.
        logical, allocatable :: holonomic(:)  !! of each constraint; not allocated: none is
    contains
        procedure :: constraint_values
        procedure :: mass_matrix
        procedure :: multipliers
        procedure :: residuals
        procedure :: complete_velocities
        procedure :: free_velocities
        procedure :: check_places
        procedure :: keep_constraints
    end type bound_system_t

contains

    pure subroutine constraint_values(self, t, q, values)
        !! \(f(t, q)\) of the holonomic constraints, whose derivatives are `constraint_rows`; what
        !! it gives for the others does not count. Here there are none.
        class(bound_system_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof)  !! time, s; coordinates
        real(dp), intent(out) :: values(:)       !! (constraints)

        values = 0.0_dp
    end subroutine constraint_values

    pure subroutine mass_matrix(self, t, q, v, mass)
        !! \(\partial^2 L/\partial\dot q\,\partial\dot q\).
        class(bound_system_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)  !! time, s; state
        real(dp), intent(out) :: mass(:, :)                    !! (ndof, ndof)
        type(euler_lagrange_t) :: terms

        call expand_lagrangian(self, t, q, v, terms)
        mass = terms%mass
    end subroutine mass_matrix

    pure subroutine multipliers(self, t, q, v, values)
        !! \(\lambda\) of each constraint; zero where nothing determines them.
        class(bound_system_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)  !! time, s; state
        real(dp), intent(out) :: values(:)                     !! (constraints)
        real(dp) :: a(self%ndof)
        type(error_t), allocatable :: error

        call accelerations_from_lagrangian(self, t, q, v, a, values, error)
    end subroutine multipliers

    pure subroutine complete_velocities(self, t, q, given, v, error)
        !! All velocities, which must keep the constraints, or as many as are free: those of the
        !! coordinates but for the last ones that the others determine.
        class(bound_system_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), given(:)
        real(dp), intent(out) :: v(self%ndof)
        type(error_t), allocatable, intent(out) :: error
        real(dp) :: a(self%constraints, self%ndof), drift(self%constraints), bound(self%constraints)
        logical :: free(self%ndof)
        integer, allocatable :: last(:)
        integer :: m, n

        n = self%ndof
        m = self%constraints
        if (m == 0) then
            call all_velocities(self, t, q, given, v, error)
            return
        end if
        v = 0.0_dp
        call choose_last(self, t, q, a, drift, last, error)
        if (allocated(error)) return
        free = .true.
        free(last) = .false.
        if (size(last) < m) then
            call fail(error, "the constraints are not independent where it starts")
        else if (size(given) == n) then
            v = given
            if (any(.not. abs(matmul(a, v) + drift) &
                    <= slip*(matmul(abs(a), abs(v)) + abs(drift)))) call fail(error, &
                "v does not keep the constraints; give those of "//names_of(self, free)//" only")
        else if (size(given) == n - m) then
            v = unpack(given, free, v)
            call solve_linear(a(:, last), -matmul(a, v) - drift, bound, error)
            if (.not. allocated(error)) v(last) = bound
        else
            call fail(error, "v takes "//counted(n - m, "value")//" ("//names_of(self, free)// &
                      ") or all "//to_text(n)//", not "//to_text(size(given)))
        end if
    end subroutine complete_velocities

    pure function free_velocities(self, t, q) result(free)
        !! See `system_t`: all but the last ones that the others determine.
        class(bound_system_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof)
        logical :: free(self%ndof)
        real(dp) :: a(self%constraints, self%ndof), drift(self%constraints)
        integer, allocatable :: last(:)
        type(error_t), allocatable :: error

        free = .true.
        call choose_last(self, t, q, a, drift, last, error)
        if (.not. allocated(error)) free(last) = .false.
    end function free_velocities

    pure subroutine choose_last(self, t, q, a, drift, last, error)
        !! The constraints \(A\dot q + b = 0\), and the last coordinates whose velocities they
        !! determine: fewer than constraints where these depend on each other.
        class(bound_system_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof)
        real(dp), intent(out) :: a(self%constraints, self%ndof), drift(self%constraints)
        integer, allocatable, intent(out) :: last(:)
        type(error_t), allocatable, intent(out) :: error
        type(hyperdual_t) :: rows(self%constraints, self%ndof), b(self%constraints), qq(self%ndof)
        integer :: i, rank

        allocate (last(0))
        qq%re = q
        call self%constraint_rows(hyperdual_t(re=t), qq, rows, b)
        a = rows%re
        drift = b%re
        if (.not. (all(ieee_is_finite(a)) .and. all(ieee_is_finite(drift)))) then
            call fail(error, "a constraint has no finite derivatives where it starts")
            return
        end if
        do i = self%ndof, 1, -1
            if (size(last) == self%constraints) exit
            call matrix_rank(a(:, [last, i]), rank, error)
            if (allocated(error)) return
            if (rank > size(last)) last = [last, i]
        end do
    end subroutine choose_last

    pure function names_of(self, free) result(text)
        !! `x_dot, y_dot`.
        class(bound_system_t), intent(in) :: self
        logical, intent(in) :: free(:)
        character(:), allocatable :: text
        type(description_t) :: d

        call self%describe(d)
        text = join(pack(velocity_names(d), free), ", ")
    end function names_of

    pure subroutine check_places(self, t, q, error)
        !! Refuse a start that is not on the holonomic constraints, and say which one is near.
        class(bound_system_t), intent(in) :: self
        real(dp), intent(in) :: t, q(:)
        type(error_t), allocatable, intent(out) :: error
        real(dp) :: values(self%constraints), sizes(self%constraints), near(size(q)), v(size(q))
        integer :: k

        call self%residuals(t, q, values, sizes)
        do k = 1, self%constraints
            if (abs(values(k)) <= slip*sizes(k)) cycle
            if (.not. ieee_is_finite(values(k))) then
                call fail(error, "constraint "//to_text(k)//" is no finite number there; start "// &
                          "elsewhere")
                return
            end if
            if (.not. ieee_is_finite(sizes(k))) then
                call fail(error, "constraint "//to_text(k)//" has no finite derivatives there; "// &
                          "start elsewhere")
                return
            end if
            near = q
            v = 0.0_dp
            call self%keep_constraints(t, near, v)
            call fail(error, "constraint "//to_text(k)//" is not kept: it gives "// &
                      to_text(values(k))//", not 0; start elsewhere")
            call self%residuals(t, near, values, sizes)
            if (size(q) <= 4 .and. all(abs(values) <= slip*sizes)) error%message = &
                error%message//", such as q = "//list_of(near)
            return
        end do
    end subroutine check_places

    pure subroutine residuals(self, t, q, values, sizes)
        !! What the holonomic constraints give, and how large the changes of coordinates and time
        !! of this size make them; zeros for the others.
        class(bound_system_t), intent(in) :: self
        real(dp), intent(in) :: t, q(:)                    !! time, s; coordinates, (ndof)
        real(dp), intent(out) :: values(:), sizes(:)       !! (constraints)
        type(hyperdual_t) :: rows(self%constraints, self%ndof), drift(self%constraints)
        type(hyperdual_t) :: qq(self%ndof)
        real(dp) :: a(self%constraints, self%ndof)
        real(dp), parameter :: least = epsilon(1.0_dp)  !! of a coordinate; at 0 it has no size

        qq%re = q
        values = 0.0_dp
        sizes = 1.0_dp
        if (.not. allocated(self%holonomic)) return
        call self%constraint_rows(hyperdual_t(re=t), qq, rows, drift)
        call self%constraint_values(t, q, values)
        a = abs(rows%re)
        where (self%holonomic)
            sizes = matmul(a, abs(q) + least) + abs(drift%re*t)
        else where
            values = 0.0_dp
        end where
    end subroutine residuals

    pure subroutine keep_constraints(self, t, q, v)
        !! Newton's method for the coordinates. Then the velocities, of which the constraints are
        !! linear; twice, since rounding is that of the velocities before, which may be far larger.
        class(bound_system_t), intent(in) :: self
        real(dp), intent(in) :: t
        real(dp), intent(inout) :: q(self%ndof), v(self%ndof)
        integer, parameter :: most = 8
        real(dp), parameter :: rounding = 4*epsilon(1.0_dp)
        type(hyperdual_t) :: qq(self%ndof), drift(self%constraints)
        type(hyperdual_t) :: rows(self%constraints, self%ndof)
        real(dp), dimension(self%constraints) :: left, sizes
        real(dp) :: change(self%ndof), a(self%constraints, self%ndof)
        integer :: i
        logical :: found

        do i = 1, most
            call self%residuals(t, q, left, sizes)
            if (all(abs(left) <= rounding*sizes)) exit
            call find_change(self, t, q, v, left, change, found)
            if (.not. found) return
            q = q + change
        end do
        qq%re = q
        call self%constraint_rows(hyperdual_t(re=t), qq, rows, drift)
        a = rows%re
        do i = 1, 2
            left = matmul(a, v) + drift%re
            if (all(abs(left) <= rounding*(matmul(abs(a), abs(v)) + abs(drift%re)))) return
            call find_change(self, t, q, v, left, change, found)
            if (.not. found) return
            v = v + change
        end do
    end subroutine keep_constraints

    pure subroutine find_change(self, t, q, v, left, change, found)
        !! \(\delta\) of least \(\delta^\top M\delta\) with \(A\delta = -\) `left`:
        !! \(M\delta - A^\top\mu = 0\). Constraints that do not hold of places have no part in that
        !! of the coordinates: they are satisfied by `left` of 0.
        class(bound_system_t), intent(in) :: self
        real(dp), intent(in) :: t, q(:), v(:), left(:)
        real(dp), intent(out) :: change(:)
        logical, intent(out) :: found                   !! it is finite
        type(hyperdual_t) :: qq(size(q)), rows(size(left), size(q)), drift(size(left))
        type(error_t), allocatable :: error
        real(dp), dimension(size(q) + size(left)) :: right, solution
        real(dp) :: mass(size(q), size(q)), matrix(size(solution), size(solution))
        integer :: n

        n = size(q)
        qq%re = q
        call self%constraint_rows(hyperdual_t(re=t), qq, rows, drift)
        call self%mass_matrix(t, q, v, mass)
        matrix = 0.0_dp
        matrix(:n, :n) = mass
        matrix(n + 1:, :n) = rows%re
        matrix(:n, n + 1:) = -transpose(rows%re)
        right(:n) = 0.0_dp
        right(n + 1:) = -left
        call solve_saddle_point(matrix, right, solution, error)
        found = .not. allocated(error)
        if (found) found = all(ieee_is_finite(solution))
        change = 0.0_dp
        if (found) change = solution(:n)
    end subroutine find_change
end module lagrangia_bound_system
