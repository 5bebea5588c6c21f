module lagrangia_audit_newton
    !! What Newton and Gauss say of a system at one state, from masses, forces and constraints.
    use lagrangia_audit_equations, only: compare
    use lagrangia_description, only: description_t
    use lagrangia_errors, only: error_t, fail
    use lagrangia_gauss_principle, only: cartesian_t, gauss_equations, least_constraint, &
                                         linearise, masses_of, new_cartesian, place_points
    use lagrangia_hyperdual, only: hyperdual_t
    use lagrangia_kinds, only: dp
    use lagrangia_ledger, only: ledger_t
    use lagrangia_number_text, only: fixed, scientific
    use lagrangia_random_draws, only: random_t
    use lagrangia_system, only: system_t
    use lagrangia_term_sizes, only: make_smaller, motion_t, nearby_t, neighbours, &
                                    size_of_solution, term_size
    implicit none (type, external)
    private
    public :: audit_gauss, audit_inertia, say_reactions
    public :: claim_gauss

    character(*), parameter :: claim_gauss = "Gauss's least constraint"
    character(3), parameter :: axes = "xyz"
    real(dp), parameter :: blurred = 1e-6_dp  !! of slopes: what rounding does is linear no more

contains

    subroutine audit_gauss(audit, system, nearby, motion, may_fail, resolved)
        !! Accelerations of the points from masses, forces and constraints alone, and each
        !! reaction against the formula of the same name.
        type(ledger_t), intent(inout) :: audit  !! gets the rows
        class(system_t), intent(in) :: system  !! with its parameters
        type(nearby_t), intent(in) :: nearby  !! the state and its neighbours
        type(motion_t), intent(in) :: motion  !! what the Lagrangian says there
        logical, intent(in) :: may_fail      !! given parameters may leave no digit to judge
        logical, intent(out) :: resolved     !! there are some
        type(description_t) :: d
        type(cartesian_t) :: here
        type(error_t), allocatable :: error
        real(dp), allocatable :: acceleration_size(:), reaction_size(:), residual_size(:)
        integer :: i, k

        resolved = .true.
        call system%describe(d)
        if (.not. has_masses(d)) return
        call least_constraint(system, nearby%t(0), nearby%q(:, 0), nearby%v(:, 0), here, error)
        if (.not. allocated(error)) then
            call size_cartesian(nearby, motion, here, acceleration_size, reaction_size, &
                                residual_size, error)
        end if
        if (allocated(error) .and. may_fail) then
            resolved = .false.
            return
        else if (allocated(error)) then
            call audit%try(claim_gauss, 1.0_dp, 0.0_dp, 1.0_dp)
            call audit%say(claim_gauss, error%message)
            return
        end if
        call compare(audit, "positions keep the constraints", here%constraint_residual, &
                     0.0_dp*here%constraint_residual, residual_size)
        call compare(audit, claim_gauss, here%x_ddot, here%acceleration, acceleration_size)
        if (.not. audit%rows(audit%row_of(claim_gauss))%holds) then
            i = maxloc(abs(here%acceleration - here%x_ddot)/(acceleration_size + tiny(1.0_dp)), 1)
            call audit%say(claim_gauss, "the accelerations of "//name_of(d, i)// &
                           " are not those of least constraint")
        end if
        do i = 1, size(d%reactions)
            if (.not. allocated(d%quantities)) exit
            do k = 1, size(d%quantities)
                if (d%quantities(k)%name /= d%reactions(i)%name) cycle
                call compare(audit, "Gauss's "//trim(d%reactions(i)%name), here%reaction(i:i), &
                             [system%quantity(k, nearby%t(0), nearby%q(:, 0), nearby%v(:, 0))], &
                             reaction_size(i:i))
            end do
        end do
    end subroutine audit_gauss

    subroutine size_cartesian(nearby, motion, here, acceleration_size, reaction_size, &
                              residual_size, error)
        !! Sizes of the terms behind accelerations, both Gauss's and the system's own, behind
        !! reactions and behind the constraints.
        type(nearby_t), intent(in) :: nearby
        type(motion_t), intent(in) :: motion
        type(cartesian_t), intent(in) :: here
        real(dp), allocatable, intent(out) :: acceleration_size(:), reaction_size(:)
        real(dp), allocatable, intent(out) :: residual_size(:)
        type(error_t), allocatable, intent(out) :: error
        type(cartesian_t) :: near
        type(description_t) :: d
        type(random_t) :: random
        real(dp), allocatable :: slope(:, :)
        real(dp), dimension(size(here%x) + size(here%right), &
                            size(here%x) + size(here%right)) :: matrix, matrix_near
        real(dp), dimension(size(here%x) + size(here%right)) :: x, right, row_size, unknowns
        real(dp), dimension(size(here%x), 0:neighbours) :: place, speed, carried
        real(dp) :: rows(size(x), 0:neighbours), size_of(size(here%x))
        integer :: i, k, n, holonomic

        n = size(here%x)
        x = [here%acceleration, here%reaction]
        do k = 0, neighbours
            call new_cartesian(nearby%systems(k)%item, nearby%t(k), nearby%q(:, k), &
                               nearby%v(:, k), motion%accelerations, near, error)
            if (allocated(error)) return
            place(:, k) = near%x
            speed(:, k) = near%x_dot
            carried(:, k) = near%x_ddot
            if (k > 0) then  ! these are inputs too, and rounded themselves
                call make_smaller(random, near%x)
                call make_smaller(random, near%x_dot)
                call linearise(nearby%systems(k)%item, nearby%t(k), near)
                if (any(maxval(abs(near%slope - here%slope), 2) > &
                        blurred*maxval(abs(here%slope), 2))) then
                    call fail(error, "rounding of the positions turns the constraints")
                    return
                end if
            end if
            call gauss_equations(near, matrix_near, right)
            if (k == 0) then
                matrix = matrix_near
                row_size = matmul(abs(matrix), abs(x)) + abs(right)
            end if
            rows(:, k) = matmul(matrix_near, x) - right
        end do
        do i = 1, size(x)
            row_size(i) = row_size(i) + term_size(rows(i, :))
        end do
        call size_of_solution(matrix, row_size, unknowns, error)
        if (allocated(error)) return
        allocate (acceleration_size(n), reaction_size(size(x) - n), residual_size(size(x) - n))
        reaction_size = unknowns(n + 1:)
        call nearby%systems(0)%item%describe(d)
        allocate (slope, source=slopes_of_positions(nearby%systems(0)%item, d, nearby%t(0), &
                                                    nearby%q(:, 0)))
        acceleration_size = unknowns(:n) + matmul(abs(slope), motion%size)
        holonomic = size(residual_size) - nearby%systems(0)%item%constraints
        do i = 1, n
            acceleration_size(i) = acceleration_size(i) + term_size(carried(i, :))
            size_of(i) = term_size(place(i, :))
        end do
        residual_size = matmul(abs(here%slope), size_of)
        do i = 1, n
            size_of(i) = term_size(speed(i, :))
        end do
        residual_size(holonomic + 1:) = matmul(abs(here%slope(holonomic + 1:, :)), size_of)
    end subroutine size_cartesian

    subroutine say_reactions(audit, system, t, q, v)
        !! What the reactions are at one state.
        type(ledger_t), intent(inout) :: audit  !! gets the rows
        class(system_t), intent(in) :: system  !! with its parameters
        real(dp), intent(in) :: t, q(:), v(:)  !! s; coordinates and velocities, (ndof)
        type(description_t) :: d
        type(cartesian_t) :: here
        type(error_t), allocatable :: error
        character(:), allocatable :: number, text
        integer :: i

        call system%describe(d)
        if (.not. has_masses(d)) return
        call least_constraint(system, t, q, v, here, error)
        if (allocated(error) .or. size(d%reactions) == 0) return
        text = "at q = 0.5, v = 1:"
        do i = 1, size(d%reactions)
            if (i > 1) text = text//","
            number = fixed(anint(1e6_dp*here%reaction(i))*1e-6_dp + 0.0_dp, 6)
            if (abs(here%reaction(i)) >= 1e5_dp) number = scientific(here%reaction(i), 11)
            text = text//" "//trim(d%reactions(i)%name)//" "//number//" N"
        end do
        call audit%say(claim_gauss, text)
    end subroutine say_reactions

    pure function has_masses(d)
        !! It is told what moves, and what holds it.
        type(description_t), intent(in) :: d
        logical :: has_masses

        has_masses = .false.
        if (.not. allocated(d%reactions)) return
        if (allocated(d%points)) has_masses = size(d%points) > 0
        if (allocated(d%rotors)) has_masses = has_masses .or. size(d%rotors) > 0
    end function has_masses

    pure function name_of(d, i) result(name)
        !! Of Cartesian coordinate `i`.
        type(description_t), intent(in) :: d
        integer, intent(in) :: i
        character(:), allocatable :: name
        integer :: point

        point = (i + 2)/3
        if (point <= size(d%points)) then
            name = trim(d%points(point)%name)//" along "//axes(i - 3*point + 3:i - 3*point + 3)
        else
            name = trim(d%rotors(i - 3*size(d%points))%name)
        end if
    end function name_of

    subroutine audit_inertia(audit, system, nearby)
        !! \(\sum_k m_k\,\partial x_k/\partial q_i\,\partial x_k/\partial q_j\) over all Cartesian
        !! coordinates is the mass matrix of the Lagrangian; no entry is larger than the root of
        !! the product of the two on the diagonal.
        type(ledger_t), intent(inout) :: audit  !! gets the rows
        class(system_t), intent(in) :: system  !! with its parameters
        type(nearby_t), intent(in) :: nearby  !! the state and its neighbours
        type(description_t) :: d
        real(dp), allocatable :: slope(:, :), weighed(:, :)
        real(dp) :: mass(system%ndof, system%ndof), largest(system%ndof, system%ndof)
        integer :: i, j, n

        call system%describe(d)
        if (.not. has_masses(d)) return
        n = system%ndof
        allocate (slope, source=slopes_of_positions(system, d, nearby%t(0), nearby%q(:, 0)))
        allocate (weighed, source=slope*spread(masses_of(d), 2, n))
        mass = matmul(transpose(slope), weighed)
        do j = 1, n
            do i = 1, n
                largest(i, j) = sqrt(mass(i, i))*sqrt(mass(j, j))
            end do
        end do
        call compare(audit, "points carry the inertia", reshape(nearby%terms(0)%mass, [n*n]), &
                     reshape(mass, [n*n]), reshape(largest, [n*n]))
    end subroutine audit_inertia

    function slopes_of_positions(system, d, t, q) result(slope)
        !! Of all Cartesian coordinates and rotors, along each coordinate.
        class(system_t), intent(in) :: system
        type(description_t), intent(in) :: d
        real(dp), intent(in) :: t, q(:)
        real(dp), allocatable :: slope(:, :)
        type(hyperdual_t) :: place(size(q))
        type(hyperdual_t), allocatable :: x(:)
        real(dp), allocatable :: mass(:)
        integer :: i

        allocate (mass, source=masses_of(d))
        allocate (x(size(mass)), slope(size(mass), size(q)))
        do i = 1, size(q)
            place = hyperdual_t()
            place%re = q
            place(i)%d1 = 1.0_dp
            call place_points(system, d, hyperdual_t(re=t), place, x)
            slope(:, i) = x%d1
        end do
    end function slopes_of_positions
end module lagrangia_audit_newton
