module lagrangia_audit_equations
    !! Hand-written formulae against what the Lagrangian says, at one state, and how fast conserved
    !! quantities change there along the motion.
    !!
    !! Each component by itself. Its residual is relative to the size of the terms behind it
    !! (`lagrangia_term_sizes`), of which rounding makes an epsilon.
    use lagrangia_description, only: description_t
    use lagrangia_errors, only: error_t
    use lagrangia_flow, only: flow_derivative, quantity_of
    use lagrangia_hyperdual, only: hyperdual_t
    use lagrangia_kinds, only: dp
    use lagrangia_ledger, only: ledger_t
    use lagrangia_number_class, only: all_finite
    use lagrangia_system, only: lanes, system_t
    use lagrangia_term_sizes, only: motion_t, nearby_t, neighbours, size_of_solution, term_size
    implicit none (type, external)
    private
    public :: audit_accelerations, audit_constraints, audit_energy, audit_momenta, audit_lanes, &
              audit_rates
    public :: claim_accelerations, claim_energy, compare, rounding

    character(*), parameter :: claim_accelerations = "accelerations as from L"
    character(*), parameter :: claim_energy = "energy is v dL/dv - L"
    real(dp), parameter :: rounding = 100.0_dp
    !! what some ten operations on each side may make of an epsilon of their terms
    real(dp), parameter :: last_digit = epsilon(1.0_dp)
    real(dp), parameter :: differencing = 100.0_dp
    !! what the sum of eight values, each of some ten operations, may make of the noise

contains

    subroutine compare(audit, claim, one, other, size_of_terms)
        !! Values that are the same but for rounding, if the claim holds at this state: the worst
        !! of them counts, and what is not a number is worst.
        type(ledger_t), intent(inout) :: audit  !! gets the rows
        character(*), intent(in) :: claim  !! whose row it is
        real(dp), intent(in) :: one(:), other(:)   !! of the same shape
        real(dp), intent(in) :: size_of_terms(:)   !! of the terms behind each
        real(dp) :: residual, worst
        integer :: i

        worst = 0.0_dp
        do i = 1, size(one)
            residual = abs(one(i) - other(i))
            if (.not. residual <= 0.0_dp) residual = residual/(size_of_terms(i) + residual)
            if (.not. residual <= worst) worst = residual
        end do
        call audit%try(claim, worst, last_digit, rounding)
    end subroutine compare

    subroutine audit_accelerations(audit, system, nearby, motion)
        !! \(\ddot q\).
        type(ledger_t), intent(inout) :: audit  !! gets the rows
        class(system_t), intent(in) :: system  !! with its parameters
        type(nearby_t), intent(in) :: nearby  !! the state and its neighbours
        type(motion_t), intent(in) :: motion  !! what the Lagrangian says there
        real(dp) :: a(system%ndof)

        call system%accelerations(nearby%t(0), nearby%q(:, 0), nearby%v(:, 0), a)
        call compare(audit, claim_accelerations, a, motion%accelerations, motion%size)
    end subroutine audit_accelerations

    subroutine audit_constraints(audit, system, nearby, motion)
        !! The velocities and the accelerations keep the non-holonomic constraints.
        type(ledger_t), intent(inout) :: audit  !! gets the rows
        class(system_t), intent(in) :: system  !! with its parameters
        type(nearby_t), intent(in) :: nearby  !! the state and its neighbours
        type(motion_t), intent(in) :: motion  !! what the Lagrangian says there
        type(hyperdual_t) :: rows(system%constraints, system%ndof), b(system%constraints)
        type(hyperdual_t) :: path(system%ndof)
        real(dp), dimension(system%constraints, system%ndof) :: row, row_dot
        real(dp) :: a(system%ndof)

        if (system%constraints == 0) return
        associate (t => nearby%t(0), q => nearby%q(:, 0), v => nearby%v(:, 0))
            call system%accelerations(t, q, v, a)
            path%re = q
            path%d1 = v
            call system%constraint_rows(hyperdual_t(re=t, d1=1.0_dp), path, rows, b)
            row = rows%re
            row_dot = rows%d1
            call compare(audit, "velocities keep the constraints", matmul(row, v), -b%re, &
                         matmul(abs(row), abs(v)) + abs(b%re))
            call compare(audit, "accelerations keep the constraints", matmul(row, a), &
                         -matmul(row_dot, v) - b%d1, matmul(abs(row), motion%size) &
                         + matmul(abs(row_dot), abs(v)) + abs(b%d1))
        end associate
    end subroutine audit_constraints

    subroutine audit_energy(audit, system, nearby)
        !! \(h = \dot q\,\partial L/\partial\dot q - L\).
        type(ledger_t), intent(inout) :: audit  !! gets the rows
        class(system_t), intent(in) :: system  !! with its parameters
        type(nearby_t), intent(in) :: nearby  !! the state and its neighbours
        real(dp) :: from_l(0:neighbours)
        integer :: k

        do k = 0, neighbours
            associate (terms => nearby%terms(k))
                from_l(k) = dot_product(nearby%v(:, k), terms%dl_dv) - terms%l
            end associate
        end do
        associate (terms => nearby%terms(0), v => nearby%v(:, 0))
            call compare(audit, claim_energy, &
                         [system%energy(nearby%t(0), nearby%q(:, 0), v)], from_l(:0), &
                         [term_size(from_l) + sum(abs(v*terms%dl_dv)) + abs(terms%l)])
        end associate
    end subroutine audit_energy

    subroutine audit_momenta(audit, system, nearby)
        !! \(p = \partial L/\partial\dot q\), the way back from p to \(\dot q\), and
        !! \(\partial L/\partial q\).
        type(ledger_t), intent(inout) :: audit  !! gets the rows
        class(system_t), intent(in) :: system  !! with its parameters
        type(nearby_t), intent(in) :: nearby  !! the state and its neighbours
        type(error_t), allocatable :: error
        real(dp), dimension(system%ndof) :: p, f, v_back, momentum_size, force_size, velocity_size
        real(dp), dimension(0:neighbours) :: momentum, force
        integer :: i, k

        associate (t => nearby%t(0), q => nearby%q(:, 0), v => nearby%v(:, 0), &
                   terms => nearby%terms(0))
            call system%momenta(t, q, v, p)
            call system%forces(t, q, v, f)
            do i = 1, size(p)
                do k = 0, neighbours
                    momentum(k) = nearby%terms(k)%dl_dv(i)
                    force(k) = nearby%terms(k)%dl_dq(i)
                end do
                momentum_size(i) = term_size(momentum) + sum(abs(terms%mass(:, i)*v))
                force_size(i) = term_size(force)
            end do
            call compare(audit, "momenta are dL/dv", p, terms%dl_dv, momentum_size)
            call compare(audit, "forces are dL/dq", f, terms%dl_dq, force_size)
            call size_of_solution(terms%mass, momentum_size, velocity_size, error)
            if (allocated(error)) return  ! the mass matrix has a claim of its own
            call system%momenta(t, q, 0.0_dp*v, p)
            if (.not. all_finite(p)) return  ! nothing rests here, where the way back would begin
            call system%velocities(t, q, terms%dl_dv, v_back)
            call compare(audit, "velocities from momenta", v_back, v, velocity_size)
        end associate
    end subroutine audit_momenta

    subroutine audit_lanes(audit, system, nearby, motion)
        !! The vector form of the accelerations says the same; sin and cos there are good to four
        !! last digits.
        type(ledger_t), intent(inout) :: audit  !! gets the rows
        class(system_t), intent(in) :: system  !! with its parameters
        type(nearby_t), intent(in) :: nearby  !! the state and its neighbours
        type(motion_t), intent(in) :: motion  !! what the Lagrangian says there
        real(dp), dimension(lanes, system%ndof) :: q_lanes, v_lanes, a_lanes
        real(dp) :: t_lanes(lanes), a(system%ndof)

        t_lanes = nearby%t(0)
        q_lanes = spread(nearby%q(:, 0), 1, lanes)
        v_lanes = spread(nearby%v(:, 0), 1, lanes)
        call system%accelerations_lanes(t_lanes, q_lanes, v_lanes, a_lanes)
        call system%accelerations(nearby%t(0), nearby%q(:, 0), nearby%v(:, 0), a)
        call compare(audit, "accelerations in lanes", reshape(a_lanes, [size(a_lanes)]), &
                     reshape(spread(a, 1, lanes), [size(a_lanes)]), &
                     reshape(spread(motion%size, 1, lanes), [size(a_lanes)]))
    end subroutine audit_lanes

    subroutine audit_rates(audit, system, nearby, motion)
        !! \(\dot h = Q\cdot\dot q - \partial L/\partial t - b\cdot\lambda\), and declared
        !! invariants stay.
        type(ledger_t), intent(inout) :: audit  !! gets the rows
        class(system_t), intent(in) :: system  !! with its parameters
        type(nearby_t), intent(in) :: nearby  !! the state and its neighbours
        type(motion_t), intent(in) :: motion  !! what the Lagrangian says there
        type(description_t) :: d
        type(hyperdual_t) :: rows(system%constraints, system%ndof), b(system%constraints)
        type(hyperdual_t) :: place(system%ndof)
        real(dp) :: expected, rounded, with_time(0:neighbours), work_rate(0:neighbours)
        integer :: k

        place%re = nearby%q(:, 0)
        call system%constraint_rows(hyperdual_t(re=nearby%t(0)), place, rows, b)
        with_time = nearby%terms%dl_dt
        do k = 0, neighbours
            work_rate(k) = dot_product(nearby%terms(k)%beside, nearby%v(:, k))
        end do
        expected = work_rate(0) - with_time(0) - dot_product(b%re, motion%multipliers)
        rounded = epsilon(1.0_dp)*(term_size(with_time) &
                                   + dot_product(abs(b%re), motion%multiplier_size))
        if (system%nonconservative) then
            rounded = rounded + epsilon(1.0_dp)*(term_size(work_rate) &
                      + dot_product(abs(nearby%terms(0)%beside), abs(nearby%v(:, 0))))
            call try_rate("energy changes by Q v - dL/dt", 0)
        else
            call try_rate("energy changes by -dL/dt", 0)
        end if
        call system%describe(d)
        if (.not. allocated(d%quantities)) return
        expected = 0.0_dp
        rounded = 0.0_dp
        do k = 1, size(d%quantities)
            if (.not. d%quantities(k)%conserved) cycle
            call try_rate(trim(d%quantities(k)%name)//" is conserved", k)
        end do
    contains
        subroutine try_rate(claim, quantity)
            character(*), intent(in) :: claim
            integer, intent(in) :: quantity
            real(dp) :: values(0:neighbours), rate, scale, noise
            integer :: i

            do i = 0, neighbours
                associate (near => nearby%systems(i)%item)
                    values(i) = quantity_of(near, quantity, nearby%t(i), nearby%q(:, i), &
                                            nearby%v(:, i))
                end associate
            end do
            ! beyond, differences and squares overflow: of infinity nothing can be said
            if (abs(values(0)) > sqrt(huge(rate))) return
            call flow_derivative(system, quantity, nearby%t(0), nearby%q(:, 0), nearby%v(:, 0), &
                                 rate, scale, noise, term_size(values), &
                                 epsilon(rate)*motion%size)
            scale = scale + abs(expected)
            call audit%try(claim, abs(rate - expected)/scale, (noise + rounded)/scale, &
                           differencing)
        end subroutine try_rate
    end subroutine audit_rates
end module lagrangia_audit_equations
