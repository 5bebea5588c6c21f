module lagrangia_audit_closed_forms
    !! Closed forms that a description prints: the motion from a start, and frequencies of small
    !! oscillations.
    !!
    !! A motion is differentiated twice: it must begin at the start, and have the accelerations that
    !! the code computes on the way. A frequency must be one of those of the equilibrium, found from
    !! the second derivatives of L.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use lagrangia_audit_equations, only: compare
    use lagrangia_description, only: description_t, frequency_t
    use lagrangia_errors, only: error_t, fail, status_library
    use lagrangia_hyperdual, only: hyperdual_t
    use lagrangia_kinds, only: dp
    use lagrangia_lagrange, only: euler_lagrange_t, expand_lagrangian
    use lagrangia_lapack, only: smallest_pivot
    use lagrangia_ledger, only: ledger_t
    use lagrangia_linearised, only: linearised_t
    use lagrangia_mass_matrix, only: check_mass_matrix
    use lagrangia_named_values, only: motion_state_t
    use lagrangia_small_oscillations, only: find_modes, modes_t
    use lagrangia_statements, only: statements_t
    use lagrangia_system, only: system_t
    use lagrangia_term_sizes, only: nearby_t, neighbours, term_size
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: audit_closed_forms

    character(*), parameter :: claim_motion = "closed form as printed"
    character(*), parameter :: claim_frequency = "frequencies as printed"

contains

    subroutine audit_closed_forms(audit, nearby, may_fail, resolved)
        !! Add the rows of one state.
        type(ledger_t), intent(inout) :: audit  !! gets the rows
        type(nearby_t), intent(in) :: nearby    !! the state and its neighbours
        logical, intent(in) :: may_fail         !! LAPACK, by parameters given
        logical, intent(inout) :: resolved      !! becomes false where LAPACK did
        type(description_t) :: d
        type(error_t), allocatable :: error
        logical :: taken(nearby%systems(0)%item%ndof)  !! modes that a frequency was found for
        integer :: i

        call nearby%systems(0)%item%describe(d)
        if (allocated(d%motion)) then
            call audit_motion(audit, nearby, d, error)
            if (allocated(error)) call refuse(audit, claim_motion, error%message)
        end if
        if (.not. allocated(d%frequencies)) return
        do i = 1, size(d%frequencies)
            if (all(d%frequencies(:i - 1)%equilibrium /= d%frequencies(i)%equilibrium)) then
                taken = .false.
            end if
            call audit_frequency(audit, nearby, d, d%frequencies(i), taken, error)
            if (.not. allocated(error)) cycle
            if (may_fail .and. error%status == status_library) then
                resolved = .false.
            else
                call refuse(audit, claim_frequency, &
                            trim(d%frequencies(i)%equation)//": "//error%message)
            end if
        end do
    end subroutine audit_closed_forms

    subroutine refuse(audit, claim, why)
        !! It does not hold.
        type(ledger_t), intent(inout) :: audit
        character(*), intent(in) :: claim, why

        call audit%try(claim, 1.0_dp, 0.0_dp, 1.0_dp)
        call audit%say(claim, why)
    end subroutine refuse

    subroutine audit_motion(audit, nearby, d, error)
        !! The start, and Newton's accelerations later.
        type(ledger_t), intent(inout) :: audit
        type(nearby_t), intent(in) :: nearby
        type(description_t), intent(in) :: d
        type(error_t), allocatable, intent(out) :: error
        type(statements_t) :: statements
        type(motion_state_t) :: state
        type(hyperdual_t), allocatable :: path(:, :), start(:, :)
        real(dp), allocatable :: a(:, :)
        integer, allocatable :: which(:)
        real(dp) :: omega, place_size, sizes, values(0:neighbours)
        integer :: i, k, n

        n = nearby%systems(0)%item%ndof
        allocate (which(n), path(n, 0:neighbours), start(n, 0:neighbours), a(n, 0:neighbours))
        call rest_at(nearby%q(:, 0), state)
        call statements%begin(nearby%systems(0)%item, d, state, error)
        if (allocated(error)) return
        do i = 1, n
            which(i) = findloc([(index(d%motion(k), trim(d%coordinates(i)%name)//" = ") == 1, &
                                 k=1, size(d%motion))], .true., 1)
            if (which(i) == 0) then
                call refuse(audit, claim_motion, "no motion of "//trim(d%coordinates(i)%name))
                return
            end if
            call statements%add_equation(trim(d%motion(which(i))), error)
            if (allocated(error)) return
        end do
        call statements%finish()
        do k = 0, neighbours
            call follow(nearby, k, statements, path(:, k), start(:, k), a(:, k))
        end do
        do i = 1, n
            if (abs(a(i, 0)) < tiny(a)/epsilon(a)) cycle  ! subnormal numbers have few digits
            values = path(i, :)%d12
            sizes = term_size(values) + term_size(a(i, :))
            ! a phase or an exponent of size omega t is only that exact
            omega = sqrt(abs(a(i, 0))/max(abs(path(i, 0)%re), tiny(a)))
            sizes = sizes + omega*abs(nearby%t(0))*abs(a(i, 0))
            call compare(audit, claim_motion, values(:0), a(i, :0), [sizes])
            values = start(i, :)%re
            place_size = term_size(values) + sum(abs(nearby%q(:, 0)))
            values = start(i, :)%d1
            sizes = place_size + term_size(values) + omega*abs(nearby%q(i, 0))
            call compare(audit, claim_motion, [start(i, 0)%re, start(i, 0)%d1], &
                         [nearby%q(i, 0), nearby%v(i, 0)], [place_size, sizes])
            if (audit%rows(audit%row_of(claim_motion))%holds) cycle
            call audit%say(claim_motion, trim(d%motion(which(i)))//": its second derivative is "// &
                           to_text(path(i, 0)%d12)//", the acceleration "//to_text(a(i, 0)))
        end do
    end subroutine audit_motion

    subroutine follow(nearby, k, statements, path, start, a)
        !! The motion at the time of neighbour `k`, or sooner where that overflows, from its state
        !! at t = 0; and the code's accelerations there.
        type(nearby_t), intent(in) :: nearby
        integer, intent(in) :: k
        type(statements_t), intent(in) :: statements
        type(hyperdual_t), intent(out) :: path(:), start(:)
        real(dp), intent(out) :: a(:)
        type(description_t) :: d
        type(motion_state_t) :: state
        type(hyperdual_t) :: coordinates(size(path))
        integer :: tries

        call nearby%systems(k)%item%describe(d)
        call rest_at(nearby%q(:, k), state)
        state%v0 = nearby%v(:, k)
        call statements%evaluate_rates(nearby%systems(k)%item, d, state, coordinates, start)
        state%t = nearby%t(k)
        do tries = 1, 30
            call statements%evaluate_rates(nearby%systems(k)%item, d, state, coordinates, path)
            if (all(ieee_is_finite(path%d12))) exit
            state%t = 1e-3_dp*state%t
        end do
        state%q = path%re
        state%v = path%d1
        call nearby%systems(k)%item%accelerations(state%t, state%q, state%v, a)
    end subroutine follow

    pure subroutine rest_at(q, state)
        !! At t = 0.
        real(dp), intent(in) :: q(:)
        type(motion_state_t), intent(out) :: state

        allocate (state%q, source=q)
        allocate (state%q0, source=q)
        allocate (state%v, source=0.0_dp*q)
        allocate (state%v0, source=0.0_dp*q)
        allocate (state%a, source=0.0_dp*q)
    end subroutine rest_at

    subroutine audit_frequency(audit, nearby, d, frequency, taken, error)
        !! One of those of its equilibrium, and another one than the one before.
        type(ledger_t), intent(inout) :: audit
        type(nearby_t), intent(in) :: nearby
        type(description_t), intent(in) :: d
        type(frequency_t), intent(in) :: frequency
        logical, intent(inout) :: taken(:)
        type(error_t), allocatable, intent(out) :: error
        type(statements_t) :: statements
        type(motion_state_t) :: state
        type(modes_t) :: modes
        type(description_t) :: near
        type(euler_lagrange_t) :: terms
        type(error_t), allocatable :: singular
        real(dp), allocatable :: at(:), left(:), right(:)
        real(dp) :: omega2(0:neighbours), sizes
        character(:), allocatable :: text
        integer :: k, equals, nearest

        text = trim(frequency%equation)
        associate (system => nearby%systems(0)%item)
            call find_equilibrium(system, d, trim(frequency%equilibrium), at, error)
            if (allocated(error)) return
            call rest_at(at, state)
            call statements%begin(system, d, state, error)
            if (allocated(error)) return
            equals = index(text, " = ")
            call statements%add_formula(text(equals + 3:), error)
            if (allocated(error)) return
            call statements%finish()
            call expand_lagrangian(system, state%t, at, state%v, terms)
            call check_mass_matrix(terms%mass, singular)
            if (allocated(singular)) return  ! given parameters leave no digit
            call find_modes(system, at, .true., modes, error)
            if (allocated(error)) return
            allocate (left(1), right(1))
            do k = 0, neighbours
                call nearby%systems(k)%item%describe(near)
                call statements%evaluate(nearby%systems(k)%item, near, state, left, right)
                omega2(k) = left(1)
            end do
            sizes = term_size(omega2)
            if (index(text(:equals), "^2") == 0) then
                sizes = 2.0_dp*abs(omega2(0))*sizes + epsilon(sizes)*sizes**2
                omega2 = omega2*abs(omega2)
            end if
            nearest = minloc(abs(modes%omega2 - omega2(0)), 1, .not. taken)
            if (nearest == 0) call fail(error, "there are more of them than modes")
            if (allocated(error)) return
            taken(nearest) = .true.
            call compare(audit, claim_frequency, omega2(:0), modes%omega2(nearest:nearest), &
                         [sizes + size(at)*maxval(abs(modes%omega2)) &
                          /smallest_pivot(modes%mass)])
            if (audit%rows(audit%row_of(claim_frequency))%holds) return
            call audit%say(claim_frequency, text//" is "//to_text(omega2(0))//" s^-2 about "// &
                           trim(frequency%equilibrium)//", the nearest there is "// &
                           to_text(modes%omega2(nearest)))
        end associate
    end subroutine audit_frequency

    subroutine find_equilibrium(system, d, text, at, error)
        !! The coordinates where the equations in `text` hold, with commas between them: from those
        !! that they give, otherwise from zero; or another one that is known in closed form.
        class(system_t), intent(in) :: system
        type(description_t), intent(in) :: d
        character(*), intent(in) :: text
        real(dp), allocatable, intent(out) :: at(:)
        type(error_t), allocatable, intent(out) :: error
        real(dp), parameter :: close_by = 1e-6_dp
        type(statements_t) :: statements
        type(motion_state_t) :: state
        type(modes_t) :: modes
        type(linearised_t) :: analytic
        character(:), allocatable :: rest
        real(dp), allocatable :: left(:), right(:)
        integer :: comma, i, k

        allocate (at(system%ndof), source=0.0_dp)
        call rest_at(at, state)
        call statements%begin(system, d, state, error)
        rest = text
        do while (rest /= "" .and. .not. allocated(error))
            comma = index(rest//",", ",")
            call statements%add_equation(trim(adjustl(rest(:comma - 1))), error)
            rest = rest(min(len(rest) + 1, comma + 1):)
        end do
        if (allocated(error)) return
        call statements%finish()
        allocate (left(statements%count), right(statements%count))
        call statements%evaluate(system, d, state, left, right)
        rest = ", "//text
        do i = 1, size(at)
            comma = index(rest, ", "//trim(d%coordinates(i)%name)//" = ")
            if (comma == 0) cycle
            at(i) = right(1 + count([(rest(k:k) == ",", k=2, comma)]))
        end do
        call find_modes(system, at, .false., modes, error)
        if (.not. allocated(error)) at = modes%at
        if (.not. holds_at(at)) then
            call system%linearise(at, analytic)
            if (allocated(analytic%elsewhere)) at = analytic%elsewhere
        end if
        if (holds_at(at)) then
            if (allocated(error)) deallocate (error)
        else if (.not. allocated(error)) then
            call fail(error, "no equilibrium was found where "//text)
        end if
    contains
        logical function holds_at(q)
            real(dp), intent(in) :: q(:)

            call rest_at(q, state)
            call statements%evaluate(system, d, state, left, right)
            holds_at = all(abs(left - right) <= close_by*(1.0_dp + maxval(abs(q))))
        end function holds_at
    end subroutine find_equilibrium
end module lagrangia_audit_closed_forms
