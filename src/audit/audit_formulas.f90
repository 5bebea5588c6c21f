module lagrangia_audit_formulas
    !! What a description prints against what the code computes, at one state: T, V, L, the energy,
    !! generalised forces beside L and Rayleigh's R of their drag, equations of motion,
    !! accelerations, quantities, constraints and what reactions hold.
    !!
    !! Formulas are read as a student reads them. An equation holds for the accelerations of the
    !! code, and for no others.
    use lagrangia_audit_equations, only: compare
    use lagrangia_description, only: default_values, description_t, formula_length
    use lagrangia_errors, only: error_t
    use lagrangia_gauss_principle, only: masses_of, place_points
    use lagrangia_hyperdual, only: hyperdual, hyperdual_t
    use lagrangia_kinds, only: dp
    use lagrangia_ledger, only: claim_length, ledger_t
    use lagrangia_named_values, only: motion_state_t, path
    use lagrangia_random_draws, only: random_t
    use lagrangia_statements, only: statements_t
    use lagrangia_system, only: system_t
    use lagrangia_term_sizes, only: motion_t, nearby_t, neighbours, new_nearby, term_size
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: audit_formulas, state_of

    integer, parameter :: is_kinetic = 1, is_potential = 2, is_lagrangian = 3, is_energy = 4
    integer, parameter :: is_quantity = 5, is_equation = 6, is_acceleration = 7
    integer, parameter :: is_constraint = 8, is_inequality = 9, is_reaction = 10
    integer, parameter :: is_force = 11, is_dissipation = 12
    integer, parameter :: part = 1
    !! of T only is known, for some points have no mass, or only what turns is described

    real(dp), parameter :: much = 1e12_dp  !! m/s^2 or rad/s^2, beside which other terms are small

    type :: entry_t
        !! A formula of the description, and the row that it belongs to.
        character(claim_length) :: claim = ""
        character(formula_length) :: text = ""  !! as far as it goes into a remark
        integer :: kind = 0
        integer :: which = 0                    !! of the quantities or reactions
    end type entry_t

contains

    subroutine audit_formulas(audit, nearby, motion, inside)
        !! Add the rows of one state; where there are contacts, of rest at the origin as well, if
        !! that is in contact.
        type(ledger_t), intent(inout) :: audit  !! gets the rows
        type(nearby_t), intent(in) :: nearby    !! the state and its neighbours
        type(motion_t), intent(in) :: motion    !! what the Lagrangian says there
        logical, intent(in) :: inside           !! no parameter is on the edge of its domain
        type(nearby_t) :: rest
        type(description_t) :: d
        real(dp) :: zero(size(nearby%q, 1))

        call audit_state(audit, nearby, motion, inside)
        if (nearby%systems(0)%item%contacts == 0) return
        zero = 0.0_dp
        call nearby%systems(0)%item%describe(d)
        call new_nearby(rest, nearby%systems(0)%item, default_values(d), nearby%t(0), zero, zero)
        call audit_state(audit, rest, motion, .false.)
    end subroutine audit_formulas

    subroutine audit_state(audit, nearby, motion, inside)
        !! The rows of one state.
        type(ledger_t), intent(inout) :: audit
        type(nearby_t), intent(in) :: nearby
        type(motion_t), intent(in) :: motion
        logical, intent(in) :: inside
        type(statements_t) :: statements
        type(entry_t), allocatable :: entries(:)
        type(description_t) :: d
        type(motion_state_t) :: state
        type(random_t) :: random
        type(error_t), allocatable :: error
        real(dp), allocatable :: left(:, :), right(:, :), change(:, :), sizes(:)
        logical :: beyond  !! a unilateral constraint, where no motion leads
        integer :: i, k

        call nearby%systems(0)%item%describe(d)
        if (prints_nothing(d)) return
        call state_of(nearby, 0, state)
        call statements%begin(nearby%systems(0)%item, d, state, error)
        if (allocated(error)) then
            call audit%try("letters as printed", 1.0_dp, 0.0_dp, 1.0_dp)
            call audit%say("letters as printed", error%message)
            return
        end if
        call read_entries(d, statements, entries, audit)
        if (size(entries) == 0) return
        call statements%finish()
        associate (system => nearby%systems(0)%item)
            beyond = any([(system%gap(i, state%t, state%q, state%v) < 0.0_dp, &
                           i=1, system%contacts)])
        end associate
        allocate (left(size(entries), 0:neighbours), right(size(entries), 0:neighbours))
        allocate (change(size(entries), nearby%systems(0)%item%ndof), sizes(size(entries)))
        do k = 0, neighbours
            call state_of(nearby, k, state)
            call nearby%systems(k)%item%describe(d)
            if (k == 0) then
                call both_sides(nearby%systems(k)%item, d, statements, entries, state, &
                                left(:, k), right(:, k))
            else
                call both_sides(nearby%systems(k)%item, d, statements, entries, state, &
                                left(:, k), right(:, k), random)
            end if
        end do
        call change_with_accelerations(nearby, statements, entries, left(:, 0) - right(:, 0), &
                                       change)
        do i = 1, size(entries)
            sizes(i) = term_size(left(i, :)) + term_size(right(i, :)) &
                       + sum(abs(change(i, :))*motion%size) + known_size(nearby, entries(i))
            if (entries(i)%kind == is_inequality .or. &
                (entries(i)%kind == is_kinetic .and. entries(i)%which == part)) then
                left(i, 0) = min(left(i, 0), right(i, 0))
            end if
        end do
        do i = 1, size(entries)
            if (any(entries(i)%kind == [is_constraint, is_inequality]) .and. beyond) cycle
            call judge(audit, entries(i), left(i, 0), right(i, 0), sizes(i))
        end do
        if (inside) call audit_choice(audit, entries, change, sizes)
    end subroutine audit_state

    function known_size(nearby, entry) result(terms)
        !! Of the terms of what the code computes, where it says so: of two that cancel to the last
        !! digit, as of an energy beside which a gyroscopic one is immense, nothing else tells.
        type(nearby_t), intent(in) :: nearby
        type(entry_t), intent(in) :: entry
        real(dp) :: terms

        terms = 0.0_dp
        if (entry%kind == is_energy .or. entry%kind == is_quantity) terms = &
            nearby%systems(0)%item%natural_size(entry%which, nearby%t(0), nearby%q(:, 0), &
                                                nearby%v(:, 0))
    end function known_size

    pure function prints_nothing(d) result(yes)
        !! There is no formula in it.
        type(description_t), intent(in) :: d
        logical :: yes

        yes = .not. (allocated(d%letters) .or. allocated(d%kinetic_energy) &
                     .or. allocated(d%potential_energy) .or. allocated(d%lagrangian) &
                     .or. allocated(d%energy) .or. allocated(d%accelerations) &
                     .or. allocated(d%constraint_equations))
        if (yes .and. allocated(d%equations)) yes = size(d%equations) == 0
        if (yes .and. allocated(d%quantities)) yes = all(d%quantities%formula == "")
        if (yes .and. allocated(d%reactions)) yes = all(d%reactions%formula == "")
    end function prints_nothing

    subroutine state_of(nearby, k, state)
        !! Neighbour `k` as a state, with the accelerations of the code.
        type(nearby_t), intent(in) :: nearby         !! all of them
        integer, intent(in) :: k                     !! 0 to `neighbours`
        type(motion_state_t), intent(out) :: state   !! starts where it is

        state%t = nearby%t(k)
        allocate (state%q, source=nearby%q(:, k))
        allocate (state%v, source=nearby%v(:, k))
        allocate (state%a, source=nearby%v(:, k))
        allocate (state%q0, source=nearby%q(:, k))
        allocate (state%v0, source=nearby%v(:, k))
        call nearby%systems(k)%item%accelerations(state%t, state%q, state%v, state%a)
    end subroutine state_of

    subroutine read_entries(d, statements, entries, audit)
        !! All formulas of the description; one that cannot be read does not hold.
        type(description_t), intent(in) :: d
        type(statements_t), intent(inout) :: statements
        type(entry_t), allocatable, intent(out) :: entries(:)
        type(ledger_t), intent(inout) :: audit
        integer :: i

        allocate (entries(0))
        if (allocated(d%kinetic_energy) .and. any(masses_of(d) > 0.0_dp)) then
            if (size(d%points) > 0 .and. all(d%points%mass > 0.0_dp)) then
                call add("T as printed", d%kinetic_energy, is_kinetic, 0)
            else
                call add("T is at least that of the masses", d%kinetic_energy, is_kinetic, part)
            end if
        end if
        if (allocated(d%potential_energy)) then
            call add("V as printed", "T - V", is_potential, 0)
        end if
        if (allocated(d%lagrangian)) call add("L as printed", d%lagrangian, is_lagrangian, 0)
        if (allocated(d%energy)) call add("energy as printed", d%energy, is_energy, 0)
        if (allocated(d%generalised_forces)) then
            do i = 1, size(d%generalised_forces)
                call add("generalised forces as printed", d%generalised_forces(i), is_force, i)
            end do
        end if
        if (allocated(d%dissipation)) call add("R as printed", d%dissipation, is_dissipation, 0)
        if (allocated(d%equations)) then
            do i = 1, size(d%equations)
                call add("equations as printed", d%equations(i), is_equation, i)
            end do
        end if
        if (allocated(d%accelerations)) then
            do i = 1, size(d%accelerations)
                call add("accelerations as printed", d%accelerations(i), is_acceleration, i)
            end do
        end if
        if (allocated(d%constraint_equations)) then
            do i = 1, size(d%constraint_equations)
                call add("constraints as printed", d%constraint_equations(i), &
                         merge(is_inequality, is_constraint, &
                               index(d%constraint_equations(i), ">=") > 0), i)
            end do
        end if
        if (allocated(d%quantities)) then
            do i = 1, size(d%quantities)
                if (d%quantities(i)%formula /= "") call add( &
                    trim(d%quantities(i)%name)//" as printed", d%quantities(i)%formula, &
                    is_quantity, i)
            end do
        end if
        if (.not. allocated(d%reactions)) return
        do i = 1, size(d%reactions)
            if (d%reactions(i)%formula /= "") call add( &
                "what holds "//trim(d%reactions(i)%name)//", as printed", &
                d%reactions(i)%formula, is_reaction, i)
        end do
    contains
        subroutine add(claim, text, kind, which)
            character(*), intent(in) :: claim, text
            integer, intent(in) :: kind, which
            type(error_t), allocatable :: error

            select case (kind)
            case (is_equation, is_acceleration, is_constraint, is_inequality, is_force)
                call statements%add_equation(trim(text), error)
            case default
                call statements%add_formula(trim(text), error)
            end select
            if (allocated(error)) then
                call audit%try(claim, 1.0_dp, 0.0_dp, 1.0_dp)
                call audit%say(claim, error%message)
            else
                entries = [entries, entry_t(claim, text, kind, which)]
            end if
        end subroutine add
    end subroutine read_entries

    subroutine both_sides(system, d, statements, entries, state, left, right, random)
        !! Of equations as they are; of formulas what they give, and what the code computes.
        class(system_t), intent(in) :: system
        type(description_t), intent(in) :: d
        type(statements_t), intent(in) :: statements
        type(entry_t), intent(in) :: entries(:)
        type(motion_state_t), intent(in) :: state
        real(dp), intent(out) :: left(:), right(:)
        type(random_t), intent(inout), optional :: random
        type(motion_state_t) :: displaced
        type(hyperdual_t) :: l
        real(dp) :: other_left(size(left)), other_right(size(right))
        integer :: i

        call statements%evaluate(system, d, state, left, right, random)
        associate (t => state%t, q => state%q, v => state%v)
            l = system%lagrangian(hyperdual(t), hyperdual(q), hyperdual(v))
            do i = 1, size(entries)
                select case (entries(i)%kind)
                case (is_kinetic); right(i) = kinetic_energy(system, d, state)
                case (is_potential, is_lagrangian); right(i) = l%re
                case (is_energy); right(i) = system%energy(t, q, v)
                case (is_quantity); right(i) = system%quantity(entries(i)%which, t, q, v)
                case (is_dissipation); right(i) = dissipation(system, t, q, v)
                case default; continue
                end select
            end do
        end associate
        if (all(entries%kind /= is_reaction)) return
        displaced = state
        call displace(system, displaced)
        call statements%evaluate(system, d, displaced, other_left, other_right, random)
        call residuals(system, d, displaced, other_right(:size(d%reactions)))
        do i = 1, size(entries)
            if (entries(i)%kind /= is_reaction) cycle
            left(i) = other_left(i)
            right(i) = other_right(entries(i)%which)
        end do
    end subroutine both_sides

    pure function dissipation(system, t, q, v) result(r)
        !! Of drag that is linear in the velocities
        !! \(R = -\tfrac12\sum_{jk}\dot q_j\dot q_k\,\partial Q_j/\partial\dot q_k\).
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t, q(:), v(:)
        real(dp) :: r
        type(hyperdual_t), dimension(size(q)) :: along, acting

        along%re = v
        along%d1 = v
        call system%generalised_forces(hyperdual(t), hyperdual(q), along, acting)
        r = -0.5_dp*dot_product(acting%d1, v)
    end function dissipation

    pure function kinetic_energy(system, d, state) result(energy)
        !! \(\sum m\dot x^2/2\) of the points and rotors.
        class(system_t), intent(in) :: system
        type(description_t), intent(in) :: d
        type(motion_state_t), intent(in) :: state
        real(dp) :: energy
        type(hyperdual_t), allocatable :: x(:)
        real(dp), allocatable :: mass(:)

        allocate (mass, source=masses_of(d))
        allocate (x(size(mass)))
        call place_points(system, d, hyperdual_t(state%t, 1.0_dp, 1.0_dp, 0.0_dp), path(state), x)
        energy = 0.5_dp*sum(mass*x%d1**2)
    end function kinetic_energy

    pure subroutine displace(system, state)
        !! Off the constraints: points away from their places, velocities that slip.
        class(system_t), intent(in) :: system
        type(motion_state_t), intent(inout) :: state
        type(description_t) :: d
        integer :: i

        call system%describe(d)
        allocate (state%shift(3*size(d%points)))
        state%shift = [(0.3_dp + 0.1_dp*sin(2.7_dp*i), i=1, size(state%shift))]
        do i = d%dimensions + 1, 3
            state%shift(i::3) = 0.0_dp  ! a plane system stays in its plane
        end do
        state%v = state%v*[(1.0_dp + 0.2_dp*i, i=1, size(state%v))]
    end subroutine displace

    pure subroutine residuals(system, d, state, residual)
        !! What `newton` says of the constraints there.
        class(system_t), intent(in) :: system
        type(description_t), intent(in) :: d
        type(motion_state_t), intent(in) :: state
        real(dp), intent(out) :: residual(:)  !! (reactions)
        type(hyperdual_t), allocatable :: x(:)
        type(hyperdual_t) :: from_newton(size(residual))
        real(dp), allocatable :: force(:)
        integer :: n

        n = size(masses_of(d))
        allocate (x(n), force(n))
        call place_points(system, d, hyperdual_t(state%t, 1.0_dp, 1.0_dp, 0.0_dp), path(state), x)
        x(:size(state%shift))%re = x(:size(state%shift))%re + state%shift
        call system%newton(hyperdual(state%t), hyperdual(x%re), hyperdual(x%d1), force, from_newton)
        residual = from_newton%re
    end subroutine residuals

    subroutine change_with_accelerations(nearby, statements, entries, difference, change)
        !! How the difference of the sides changes with each acceleration, from one so much larger
        !! that it counts beside all other terms.
        type(nearby_t), intent(in) :: nearby
        type(statements_t), intent(in) :: statements
        type(entry_t), intent(in) :: entries(:)
        real(dp), intent(in) :: difference(:)
        real(dp), intent(out) :: change(:, :)  !! (entries, ndof)
        type(description_t) :: d
        type(motion_state_t) :: state
        real(dp) :: left(size(entries)), right(size(entries)), kept
        integer :: j

        call nearby%systems(0)%item%describe(d)
        call state_of(nearby, 0, state)
        do j = 1, size(state%a)
            kept = state%a(j)
            state%a(j) = kept + much*(1.0_dp + abs(kept))
            call both_sides(nearby%systems(0)%item, d, statements, entries, state, left, right)
            change(:, j) = (left - right - difference)/(state%a(j) - kept)
            state%a(j) = kept
        end do
    end subroutine change_with_accelerations

    subroutine judge(audit, entry, left, right, size_of)
        !! One formula in its row; the first that does not hold is quoted.
        type(ledger_t), intent(inout) :: audit
        type(entry_t), intent(in) :: entry
        real(dp), intent(in) :: left, right, size_of
        integer :: row

        if (min(abs(left), abs(right)) > huge(left)) return  ! of infinity nothing can be said
        call compare(audit, trim(entry%claim), [left], [right], [size_of])
        row = audit%row_of(trim(entry%claim))
        if (audit%rows(row)%holds) return
        if (is_two_sided(entry)) then
            call audit%say(trim(entry%claim), trim(entry%text)//": "//to_text(left)// &
                           " on the left, "//to_text(right)//" on the right")
        else
            call audit%say(trim(entry%claim), trim(entry%text)//" is "//to_text(left)//", the "// &
                           trim(merge("masses and what turns (rotors) have", &
                                      "code has                           ", &
                                      entry%kind == is_kinetic))//" "//to_text(right))
        end if
    end subroutine judge

    pure function is_two_sided(entry) result(yes)
        !! An equation.
        type(entry_t), intent(in) :: entry
        logical :: yes

        yes = any(entry%kind == [is_equation, is_acceleration, is_constraint, is_inequality, &
                                 is_force])
    end function is_two_sided

    subroutine audit_choice(audit, entries, change, sizes)
        !! Each equation depends on an acceleration, and each acceleration occurs.
        type(ledger_t), intent(inout) :: audit
        type(entry_t), intent(in) :: entries(:)
        real(dp), intent(in) :: change(:, :), sizes(:)
        character(*), parameter :: claim = "equations hold for no other motion"
        logical :: seen(size(change, 1), size(change, 2))
        logical :: fine
        integer :: i

        if (all(entries%kind /= is_equation)) return
        do i = 1, size(entries)
            seen(i, :) = abs(change(i, :))*much > epsilon(sizes)*sizes(i) &
                         .and. entries(i)%kind == is_equation
        end do
        fine = all(any(seen, dim=2) .or. entries%kind /= is_equation) .and. all(any(seen, dim=1))
        call audit%try(claim, merge(0.0_dp, 1.0_dp, fine), epsilon(1.0_dp), 1.0_dp)
        if (.not. fine) call audit%say(claim, "an equation has no acceleration, or one of the "// &
                                       "accelerations is in none")
    end subroutine audit_choice
end module lagrangia_audit_formulas
