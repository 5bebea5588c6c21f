module lagrangia_audit
    !! The audit of a system: every claim it makes, at random states and parameters.
    !!
    !! Parameters and states are the same ones in every run. Every second draw puts parameters on
    !! the edge of their domain (no gravity, no spring), where further quantities are conserved.
    !! Velocities of a non-holonomic system are completed from the free ones.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
    use lagrangia_audit_closed_forms, only: audit_closed_forms
    use lagrangia_audit_equations, only: audit_accelerations, audit_constraints, audit_energy, &
                                         audit_lanes, audit_momenta, audit_rates, &
                                         claim_accelerations
    use lagrangia_audit_formulas, only: audit_formulas
    use lagrangia_audit_newton, only: audit_gauss, audit_inertia, say_reactions
    use lagrangia_audit_structure, only: audit_cyclic, audit_flags, audit_mass, claim_mass, &
                                         least_pivot, say_potential
    use lagrangia_description, only: description_t, name_length, value_names
    use lagrangia_diagnosis, only: diagnose
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_lagrange, only: euler_lagrange_t
    use lagrangia_lapack, only: smallest_pivot
    use lagrangia_ledger, only: ledger_t
    use lagrangia_mass_matrix, only: check_mass_matrix, list_of
    use lagrangia_number_class, only: is_zero
    use lagrangia_observer, only: observer_t
    use lagrangia_random_draws, only: random_t
    use lagrangia_system, only: default_values, system_t
    use lagrangia_term_sizes, only: motion_t, nearby_t, new_nearby, solve_motion
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: audit_system, draws

    integer, parameter :: draws = 40  !! of parameters and states

    type :: unresolved_t
        !! Where given parameters are so far apart that a double has no digit of what is between.
        integer :: states = 0
        character(:), allocatable :: why  !! of the first one without accelerations
    end type unresolved_t

contains

    subroutine audit_system(system, audit, fixed, given, watcher, label)
        !! Add a row for each claim. On return `system` has the parameters of the last draw.
        class(system_t), intent(inout) :: system  !! its parameters are set as needed
        type(ledger_t), intent(inout) :: audit  !! gets the rows
        logical, intent(in), optional :: fixed(:)    !! parameters that stay as `given`
        real(dp), intent(in), optional :: given(:)  !! all parameters; needed with `fixed`
        class(observer_t), intent(inout), optional :: watcher  !! told how far it is
        character(*), intent(in), optional :: label  !! of the section; without, the system's name
        type(random_t) :: random
        type(description_t) :: d
        type(unresolved_t) :: unresolved
        type(error_t), allocatable :: error
        character(:), allocatable :: remark
        real(dp), allocatable :: values(:), culprit(:)
        logical :: all_free
        integer :: i, row

        call system%describe(d)
        if (present(label)) then
            call audit%section(label)
        else
            call audit%section(trim(d%name))
        end if
        all_free = .true.
        if (present(fixed)) all_free = .not. any(fixed)
        do i = 1, draws
            if (present(watcher)) call watcher%tick(i - 1_i8, int(draws, i8))
            call random%parameters(system, mod(i, 2) == 0, values, error, fixed, given)
            if (.not. allocated(error)) then
                call audit_state(system, values, random, mod(i, 2) == 1, all_free, audit, &
                                 unresolved, error)
            end if
            if (allocated(error)) then
                call audit%try("parameters and states are taken", 1.0_dp, 0.0_dp, 1.0_dp)
                call audit%say("parameters and states are taken", error%message// &
                               stated_parameters(d, values))
                return
            end if
            call audit_parameters(audit, system, values)
            row = audit%row_of(claim_accelerations)
            if (row == 0 .or. allocated(culprit)) cycle
            if (audit%rows(row)%holds) cycle
            allocate (culprit, source=values)
        end do
        if (allocated(culprit)) then
            call system%configure(culprit, error)
            call diagnose(system, remark)
            call audit%say(claim_accelerations, remark)
        end if
        if (random%left_out > 0) call say_left_out(audit, random%left_out)
        if (unresolved%states > 0) call say_unresolved(audit, unresolved)
        call show_forces(system, values, d, audit, given)
    end subroutine audit_system

    subroutine say_left_out(audit, states)
        !! The audit keeps to where the masses are positive, and says so.
        type(ledger_t), intent(inout) :: audit
        integer, intent(in) :: states
        integer :: row

        row = audit%row_of(claim_mass)
        if (row == 0) return
        if (audit%rows(row)%holds) call audit%say(claim_mass, &
            "of the states drawn "//to_text(states)//" were left out, at which it is not")
    end subroutine say_left_out

    subroutine say_unresolved(audit, unresolved)
        !! The audit says what it could not judge; no state at all is no audit.
        type(ledger_t), intent(inout) :: audit
        type(unresolved_t), intent(inout) :: unresolved

        if (audit%row_of(claim_accelerations) == 0) then
            call audit%try(claim_accelerations, 1.0_dp, 0.0_dp, 1.0_dp)
            if (.not. allocated(unresolved%why)) unresolved%why = "at no state have the "// &
                "accelerations a digit: given values and drawn ones are too many digits apart"
            call audit%say(claim_accelerations, unresolved%why)
        else
            call audit%say(claim_accelerations, "at "//to_text(unresolved%states)//" of "// &
                           to_text(draws)//" states given values and drawn ones differ by more "// &
                           "digits than a double has: what needs both is not judged there")
        end if
    end subroutine say_unresolved

    pure function stated_parameters(d, values) result(text)
        !! `; with l = 0.0, g = 9.81`: perhaps the domain should exclude them.
        type(description_t), intent(in) :: d
        real(dp), intent(in) :: values(:)  !! NaN: others determine it
        character(:), allocatable :: text
        character(name_length), allocatable :: names(:)
        integer :: i

        text = ""
        allocate (names, source=value_names(d))
        do i = 1, size(values)
            if (ieee_is_nan(values(i))) cycle
            text = text//", "//trim(names(i))//" = "//to_text(values(i))
        end do
        if (text /= "") text = "; with"//text(2:)
    end function stated_parameters

    subroutine audit_parameters(audit, system, values)
        !! Each parameter goes where it belongs: the description reads them back.
        type(ledger_t), intent(inout) :: audit
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: values(:)
        type(description_t) :: d
        real(dp), allocatable :: read_back(:)
        logical :: same

        call system%describe(d)
        allocate (read_back, source=default_values(d))
        same = all(is_zero(read_back - values) .or. ieee_is_nan(values))
        call audit%try("parameters are what was given", merge(0.0_dp, 1.0_dp, same), &
                       epsilon(1.0_dp), 1.0_dp)
    end subroutine audit_parameters

    subroutine show_forces(system, values, d, audit, given)
        !! Tensions and normal forces at one state, and whether Q has a potential, with the defaults
        !! or the parameters given.
        class(system_t), intent(inout) :: system
        real(dp), intent(in) :: values(:)           !! what `system` has
        type(description_t), intent(in) :: d        !! with the defaults
        type(ledger_t), intent(inout) :: audit
        real(dp), intent(in), optional :: given(:)
        type(error_t), allocatable :: error
        real(dp), allocatable :: q(:), v(:), free(:)

        if (present(given)) then
            call system%configure(given, error)
        else
            call system%configure(default_values(d), error)
        end if
        allocate (q(system%ndof), source=0.5_dp)
        allocate (v(system%ndof), source=0.0_dp)
        allocate (free(system%ndof - system%constraints), source=1.0_dp)
        call system%complete_velocities(0.0_dp, q, free, v, error)
        if (.not. allocated(error)) call say_reactions(audit, system, 0.0_dp, q, v)
        call say_potential(audit, system)
        call system%configure(values, error)
    end subroutine show_forces

    subroutine audit_state(system, values, random, inside, all_free, audit, unresolved, error)
        !! Every claim, at one state.
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: values(:)  !! its parameters
        type(random_t), intent(inout) :: random
        logical, intent(in) :: inside    !! no parameter was put on the edge of its domain
        logical, intent(in) :: all_free  !! nor was one given
        type(ledger_t), intent(inout) :: audit
        type(unresolved_t), intent(inout) :: unresolved
        type(error_t), allocatable, intent(out) :: error
        type(nearby_t) :: nearby
        type(motion_t) :: motion
        type(error_t), allocatable :: unsolved
        real(dp), allocatable :: q(:), v(:), other_q(:), other_v(:)
        real(dp) :: t, other_t
        logical :: resolved

        call random%state(system, t, q, v, error)
        if (allocated(error)) return
        call random%state(system, other_t, other_q, other_v, error)
        if (allocated(error)) return
        call new_nearby(nearby, system, values, t, q, v)
        if (.not. all_free .and. system%constraints == 0) then
            ! What is given may leave the sign of a pivot to rounding: I3 = 10^14 I1 of a top.
            if (abs(smallest_pivot(nearby%terms(0)%mass)) <= least_pivot) then
                unresolved%states = unresolved%states + 1
                if (.not. allocated(unresolved%why)) call check_mass_matrix( &
                    nearby%terms(0)%mass, unsolved)
                if (allocated(unsolved)) unresolved%why = unsolved%message
                return
            end if
        end if
        call solve_motion(nearby, motion, unsolved)
        if (allocated(unsolved)) then
            call say_why(nearby%terms(0), t, q, v, unsolved)
            resolved = all_free
            if (all_free) then
                call audit%try(claim_accelerations, 1.0_dp, 0.0_dp, 1.0_dp)
                call audit%say(claim_accelerations, unsolved%message)
            else if (.not. allocated(unresolved%why)) then
                unresolved%why = unsolved%message
            end if
        else
            call audit_accelerations(audit, system, nearby, motion)
            call audit_gauss(audit, system, nearby, motion, .not. all_free, resolved)
            call audit_constraints(audit, system, nearby, motion)
        end if
        call audit_energy(audit, system, nearby)
        if (.not. allocated(unsolved)) call audit_rates(audit, system, nearby, motion)
        call audit_momenta(audit, system, nearby)
        if (.not. allocated(unsolved)) call audit_lanes(audit, system, nearby, motion)
        call audit_inertia(audit, system, nearby)
        if (inside) call audit_mass(audit, system, t, q, v)
        call audit_cyclic(audit, system, t, q, v)
        call audit_flags(audit, system, t, q, v, other_t, other_v, inside .and. all_free)
        if (.not. allocated(unsolved)) call audit_formulas(audit, nearby, motion, &
                                                           inside .and. all_free)
        call audit_closed_forms(audit, nearby, .not. all_free, resolved)
        if (.not. resolved) unresolved%states = unresolved%states + 1
    end subroutine audit_state

    pure subroutine say_why(terms, t, q, v, error)
        !! Where, and what of the mass matrix leaves the accelerations open.
        type(euler_lagrange_t), intent(in) :: terms  !! of the Lagrangian at the state
        real(dp), intent(in) :: t, q(:), v(:)
        type(error_t), allocatable, intent(inout) :: error
        type(error_t), allocatable :: cause

        call check_mass_matrix(terms%mass, cause)
        if (allocated(cause)) call move_alloc(cause, error)
        call error%add_context("at t = "//to_text(t)//", q = "//list_of(q)//", v = "//list_of(v))
    end subroutine say_why
end module lagrangia_audit
