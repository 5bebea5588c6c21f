module lagrangia_audit_structure
    !! What a system says of its structure: integrators and small oscillations rely on it.
    use lagrangia_description, only: description_t
    use lagrangia_errors, only: error_t, fail
    use lagrangia_helmholtz, only: potential_text
    use lagrangia_hyperdual, only: hyperdual_t
    use lagrangia_kinds, only: dp
    use lagrangia_lagrange, only: euler_lagrange_t, expand_lagrangian
    use lagrangia_lagrangian_system, only: lagrangian_system_t
    use lagrangia_lapack, only: smallest_pivot
    use lagrangia_ledger, only: ledger_t
    use lagrangia_mass_matrix, only: check_mass_matrix, list_of
    use lagrangia_number_class, only: is_nonzero, is_zero
    use lagrangia_system, only: system_t
    use lagrangia_vectors, only: farthest
    implicit none (type, external)
    private
    public :: audit_flags, audit_cyclic, audit_mass, claim_mass, least_pivot, say_potential

    real(dp), parameter :: least_pivot = 100*epsilon(1.0_dp)
    !! of a scaled mass matrix: of a smaller one only rounding knows the sign
    character(*), parameter :: claim_mass = "mass matrix is positive definite"

    real(dp), parameter :: yes = 0.0_dp, no = 1.0_dp
    integer, parameter :: scales = 24          !! halvings of a velocity or a coordinate
    real(dp), parameter :: later = 14.0_dp     !! s, from one time to the next

contains

    subroutine audit_flags(audit, system, t, q, v, other_t, other_v, generic)
        !! `velocity_forces`, `time_dependent` and `nonconservative` say what is true: one that is
        !! false always, one that is true for parameters off the edges of their domains, unless
        !! formulas have told it. Equal means equal bits.
        type(ledger_t), intent(inout) :: audit  !! gets the rows
        class(system_t), intent(in) :: system  !! with its parameters
        real(dp), intent(in) :: t, q(:), v(:), other_t, other_v(:)
        !! a state, and another time and velocities
        logical, intent(in) :: generic  !! no parameter is on the edge of its domain or given
        type(euler_lagrange_t) :: terms, later
        type(hyperdual_t), dimension(system%ndof) :: qq, vv, now, then
        type(hyperdual_t) :: rows(system%constraints, system%ndof), b(system%constraints)
        type(hyperdual_t) :: new_rows(system%constraints, system%ndof), new_b(system%constraints)
        real(dp) :: by_velocity, by_time
        logical :: bound, moving, told

        told = .false.
        select type (system)
        class is (lagrangian_system_t)
            told = system%told_by_formulas
        end select
        by_velocity = change(system, t, q, v, t, other_v)
        by_time = change(system, t, q, v, other_t, v)
        ! on rolling systems other velocities would also have to roll
        bound = system%constraints > 0
        if (.not. system%velocity_forces) then
            call verdict(by_velocity <= 0.0_dp, "velocity_forces", &
                         "velocity_forces is false, yet the accelerations depend on velocities")
        else if (generic .and. .not. bound) then
            call verdict(by_velocity > 0.0_dp .or. counts_when_slow(system, t, q, v) .or. &
                         told, &
                         "velocity_forces", &
                         "velocity_forces is true, yet no acceleration depends on a velocity")
        end if
        call expand_lagrangian(system, t, q, v, terms)
        call expand_lagrangian(system, other_t, q, v, later)
        qq%re = q
        vv%re = v
        call system%generalised_forces(hyperdual_t(re=t), qq, vv, now)
        call system%generalised_forces(hyperdual_t(re=other_t), qq, vv, then)
        call system%constraint_rows(hyperdual_t(re=t), qq, rows, b)
        call system%constraint_rows(hyperdual_t(re=other_t), qq, new_rows, new_b)
        moving = any(is_nonzero(new_rows%re - rows%re)) .or. any(is_nonzero(new_b%re))
        if (.not. system%nonconservative) then
            if (any(is_nonzero(now%re))) call verdict(.false., "nonconservative", &
                "nonconservative is false, yet there are generalised forces")
        else
            call verdict(told .or. acts_somewhere(system, t, q, v), "nonconservative", &
                         "nonconservative is true, yet no generalised force acts")
        end if
        if (.not. system%time_dependent) then
            call verdict(by_time <= 0.0_dp, "time_dependent", &
                         "time_dependent is false, yet the accelerations depend on the time")
            call verdict(is_zero(later%l - terms%l), "time_dependent", &
                         "time_dependent is false, yet L depends on the time")
        else if (generic) then
            call verdict(is_nonzero(later%l - terms%l) .or. any(is_nonzero(then%re - now%re)) &
                         .or. by_time > 0.0_dp .or. moving .or. told, &
                         "time_dependent", "time_dependent is true, yet L has no time in it")
        end if
        if (.not. system%constraints_work .and. any(is_nonzero(b%re))) call verdict(.false., &
            "constraints_work", "constraints_work is false, yet a constraint A v + b = 0 has a b")
    contains
        subroutine verdict(good, flag, remark)
            logical, intent(in) :: good
            character(*), intent(in) :: flag, remark

            call audit%try(flag//" says what is true", merge(yes, no, good), epsilon(yes), 1.0_dp)
            if (.not. good) call audit%say(flag//" says what is true", remark)
        end subroutine verdict
    end subroutine audit_flags

    subroutine say_potential(audit, system)
        !! Whether the generalised forces could as well be in L.
        type(ledger_t), intent(inout) :: audit    !! gets the remark
        class(system_t), intent(in) :: system     !! with its parameters

        if (.not. system%nonconservative) return
        call audit%say("nonconservative says what is true", potential_text(system))
    end subroutine say_potential

    function acts_somewhere(system, t, q, v) result(yes)
        !! Is there a generalised force at this state, or nearer to the origin and slower, or later?
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t, q(:), v(:)
        logical :: yes
        type(hyperdual_t), dimension(size(q)) :: qq, vv, force
        integer :: k

        do k = 0, scales
            qq%re = q
            vv%re = v*0.5_dp**k
            call system%generalised_forces(hyperdual_t(re=t), qq, vv, force)
            yes = any(is_nonzero(force%re))
            if (yes) return
            qq%re = q*0.5_dp**k
            call system%generalised_forces(hyperdual_t(re=t), qq, vv, force)
            yes = any(is_nonzero(force%re))
            if (yes) return
            qq%re = q
            call system%generalised_forces(hyperdual_t(re=later*k), qq, vv, force)
            yes = any(is_nonzero(force%re))
            if (yes) return
        end do
    end function acts_somewhere

    function counts_when_slow(system, t, q, v) result(yes)
        !! Do the accelerations depend on velocities that are smaller, before they saturate?
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t, q(:), v(:)
        logical :: yes
        integer :: k

        do k = 1, scales
            yes = change(system, t, q, v*0.5_dp**k, t, -v*0.5_dp**k) > 0.0_dp .or. &
                  change(system, t, q, v*0.5_dp**k, t, v*0.25_dp**k) > 0.0_dp
            if (yes) return
        end do
    end function counts_when_slow

    function change(system, t, q, v, other_t, other_v) result(difference)
        !! Of the accelerations between two times and velocities.
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t, q(:), v(:), other_t, other_v(:)
        real(dp) :: difference
        real(dp) :: a(size(q)), b(size(q))

        call system%accelerations(t, q, v, a)
        call system%accelerations(other_t, q, other_v, b)
        difference = farthest(a, b)
    end function change

    subroutine audit_cyclic(audit, system, t, q, v)
        !! The slope of L along the cyclic coordinate is zero, as is the generalised force on it,
        !! and there is such a coordinate.
        type(ledger_t), intent(inout) :: audit  !! gets the rows
        class(system_t), intent(in) :: system  !! with its parameters
        real(dp), intent(in) :: t, q(:), v(:)  !! s; coordinates and velocities, (ndof)
        character(*), parameter :: claim = "the cyclic coordinate is cyclic"
        type(euler_lagrange_t) :: terms
        type(description_t) :: d

        if (system%cyclic == 0) return
        if (system%cyclic < 0 .or. system%cyclic > system%ndof) then
            call audit%try(claim, no, epsilon(no), 1.0_dp)
            call audit%say(claim, "there is no coordinate of that number")
            return
        end if
        call expand_lagrangian(system, t, q, v, terms)
        call audit%try(claim, abs(terms%dl_dq(system%cyclic)) &
                       /(maxval(abs(terms%dl_dq)) + tiny(no)), epsilon(no), 1.0_dp)
        call system%describe(d)
        if (is_nonzero(terms%dl_dq(system%cyclic))) then
            call audit%say(claim, "L depends on "//d%coordinates(system%cyclic)%name)
        else if (is_nonzero(terms%beside(system%cyclic))) then
            call audit%try(claim, no, epsilon(no), 1.0_dp)
            call audit%say(claim, "a generalised force acts on "// &
                           d%coordinates(system%cyclic)%name)
        end if
    end subroutine audit_cyclic

    subroutine audit_mass(audit, system, t, q, v)
        !! \(\partial^2 L/\partial v\,\partial v\) is positive definite, for the velocities that
        !! the constraints \(A\dot q + b = 0\) leave: with a multiple of \(A^\top A\) added. By
        !! Cholesky, of the matrix scaled to a diagonal of ones. The number shown is what the
        !! smallest pivot lacks of 1.
        type(ledger_t), intent(inout) :: audit  !! gets the rows
        class(system_t), intent(in) :: system  !! with its parameters
        real(dp), intent(in) :: t, q(:), v(:)  !! s; coordinates and velocities, (ndof)
        type(euler_lagrange_t) :: terms
        type(hyperdual_t) :: place(size(q)), rows(system%constraints, size(q))
        type(hyperdual_t) :: b(system%constraints)
        type(error_t), allocatable :: error
        real(dp) :: lack, weight, matrix(size(q), size(q))
        integer :: i, k

        call expand_lagrangian(system, t, q, v, terms)
        place%re = q
        call system%constraint_rows(hyperdual_t(re=t), place, rows, b)
        matrix = terms%mass
        do k = 1, system%constraints
            weight = 0.0_dp
            do i = 1, size(q)
                if (is_nonzero(rows(k, i)%re)) then
                    weight = max(weight, abs(terms%mass(i, i))/rows(k, i)%re**2)
                end if
            end do
            do i = 1, size(q)
                matrix(:, i) = matrix(:, i) + weight*rows(k, :)%re*rows(k, i)%re
            end do
        end do
        lack = 1.0_dp - smallest_pivot(matrix)
        call audit%try(claim_mass, lack, 1.0_dp - least_pivot, 1.0_dp)
        if (lack < 1.0_dp) return
        call check_mass_matrix(matrix, error)
        if (.not. allocated(error)) call fail(error, "a pivot is zero or negative")
        call audit%say(claim_mass, "at q = "//list_of(q)//", v = "//list_of(v)//": "//error%message)
    end subroutine audit_mass
end module lagrangia_audit_structure
