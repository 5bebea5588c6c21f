module lagrangia_audit_equations
    !! Hand-written formulae against what the Lagrangian says, at one state.
    !!
    !! Residuals are relative to the terms that add up. The noise is an epsilon of these terms,
    !! and what the last digits of the state change in the difference of both sides: measured at
    !! a neighbouring state, it is what rounding makes of equal expressions.
    use lagrangia_errors, only: error_t
    use lagrangia_findings, only: audit_t
    use lagrangia_hyperdual, only: hyperdual_t
    use lagrangia_kinds, only: dp
    use lagrangia_lagrange, only: accelerations_from_lagrangian, euler_lagrange_t, &
                                  expand_lagrangian
    use lagrangia_least_squares, only: smallest_pivot
    use lagrangia_system, only: lanes, system_t
    implicit none (type, external)
    private
    public :: audit_accelerations, audit_constraints, audit_energy, audit_momenta, audit_lanes
    public :: claim_accelerations, claim_energy, neighbour, rounding

    character(*), parameter :: claim_accelerations = "accelerations as from L"
    character(*), parameter :: claim_energy = "energy is v dL/dv - L"
    real(dp), parameter :: rounding = 100.0_dp
    !! what some ten operations on each side, behind a mass matrix of condition ten, may make of
    !! the noise
    real(dp), parameter :: last_digit = 4.0_dp*epsilon(1.0_dp)

contains

    pure subroutine neighbour(t, q, v, tt, qq, vv)
        !! A state some last digits away.
        real(dp), intent(in) :: t, q(:), v(:)
        real(dp), intent(out) :: tt, qq(:), vv(:)

        tt = t*(1.0_dp + last_digit)
        qq = q*(1.0_dp - last_digit)
        vv = v*(1.0_dp + last_digit)
    end subroutine neighbour

    subroutine audit_accelerations(audit, system, t, q, v)
        !! \(\ddot q\), all of them together: the scale is that of the largest.
        type(audit_t), intent(inout) :: audit
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t, q(:), v(:)
        type(euler_lagrange_t) :: terms
        type(error_t), allocatable :: error
        real(dp), dimension(size(q)) :: difference, other, oracle, unused, qq, vv
        real(dp) :: tt, scale

        call expand_lagrangian(system, t, q, v, terms)
        call compare(system, t, q, v, difference, oracle, error)
        if (.not. allocated(error)) then
            call neighbour(t, q, v, tt, qq, vv)
            call compare(system, tt, qq, vv, other, unused, error)
        end if
        if (allocated(error)) then
            call audit%judge(claim_accelerations, 1.0_dp, 0.0_dp, rounding)
            call audit%say(claim_accelerations, error%message)
            return
        end if
        scale = maxval(abs(oracle)) + maxval(abs(v))**2 &
                + maxval(abs(terms%dl_dq))/maxval(abs(terms%mass)) + tiny(1.0_dp)
        call audit%judge(claim_accelerations, maxval(abs(difference))/scale, &
                         epsilon(scale) + maxval(abs(difference - other))/scale, rounding)
    end subroutine audit_accelerations

    subroutine compare(system, t, q, v, difference, oracle, error)
        !! The system's accelerations less those from the Lagrangian.
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t, q(:), v(:)
        real(dp), intent(out) :: difference(:), oracle(:)
        type(error_t), allocatable, intent(out) :: error
        real(dp) :: multipliers(system%constraints)

        call system%accelerations(t, q, v, difference)
        call accelerations_from_lagrangian(system, t, q, v, oracle, multipliers, error)
        difference = difference - oracle
    end subroutine compare

    subroutine audit_constraints(audit, system, t, q, v)
        !! The velocities and the accelerations keep the non-holonomic constraints.
        type(audit_t), intent(inout) :: audit
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t, q(:), v(:)
        type(hyperdual_t) :: rows(system%constraints, size(q)), drift(system%constraints)
        type(hyperdual_t) :: path(size(q))
        real(dp) :: a(size(q))
        integer :: i

        if (system%constraints == 0) return
        call system%accelerations(t, q, v, a)
        path%re = q
        path%d1 = v
        call system%constraint_rows(hyperdual_t(re=t, d1=1.0_dp), path, rows, drift)
        do i = 1, system%constraints
            associate (row => rows(i, :)%re, row_dot => rows(i, :)%d1)
                call audit%judge("velocities keep the constraints", &
                                 abs(dot_product(row, v) + drift(i)%re) &
                                 /(sum(abs(row*v)) + abs(drift(i)%re) + tiny(1.0_dp)), &
                                 epsilon(1.0_dp), rounding)
                call audit%judge("accelerations keep the constraints", &
                                 abs(dot_product(row, a) + dot_product(row_dot, v) + drift(i)%d1) &
                                 /(sum(abs(row*a)) + sum(abs(row_dot*v)) + abs(drift(i)%d1) &
                                   + tiny(1.0_dp)), epsilon(1.0_dp), rounding)
            end associate
        end do
    end subroutine audit_constraints

    subroutine audit_energy(audit, system, t, q, v)
        !! \(h = \dot q\,\partial L/\partial\dot q - L\).
        type(audit_t), intent(inout) :: audit
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t, q(:), v(:)
        type(euler_lagrange_t) :: terms
        real(dp) :: scale

        call expand_lagrangian(system, t, q, v, terms)
        scale = sum(abs(v*terms%dl_dv)) + abs(terms%l) + tiny(1.0_dp)
        call audit%judge(claim_energy, &
                         abs(system%energy(t, q, v) - (dot_product(v, terms%dl_dv) - terms%l)) &
                         /scale, epsilon(scale), rounding)
    end subroutine audit_energy

    subroutine audit_momenta(audit, system, t, q, v)
        !! \(p = \partial L/\partial\dot q\), the way back from p to \(\dot q\), and
        !! \(\partial L/\partial q\).
        type(audit_t), intent(inout) :: audit
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t, q(:), v(:)
        type(euler_lagrange_t) :: terms
        real(dp), dimension(size(q)) :: p, f, v_back, scale
        real(dp) :: widest
        integer :: i

        call expand_lagrangian(system, t, q, v, terms)
        call system%momenta(t, q, v, p)
        do i = 1, size(q)
            scale(i) = sum(abs(terms%mass(:, i)*v)) + abs(terms%dl_dv(i)) + tiny(1.0_dp)
        end do
        call audit%judge("momenta are dL/dv", maxval(abs(p - terms%dl_dv)/scale), &
                         epsilon(widest), rounding)
        call system%forces(t, q, v, f)
        widest = maxval(abs(terms%dl_dq)) + maxval(abs(terms%mass))*maxval(abs(v))**2 &
                 + tiny(1.0_dp)
        call audit%judge("forces are dL/dq", maxval(abs(f - terms%dl_dq))/widest, &
                         epsilon(widest), rounding)
        if (smallest_pivot(terms%mass) < 1e-6_dp) return  ! a disk of all but no inertia
        call system%velocities(t, q, terms%dl_dv, v_back)
        call audit%judge("velocities from momenta", &
                         maxval(abs(matmul(terms%mass, v_back - v))/scale), &
                         epsilon(widest), rounding)
    end subroutine audit_momenta

    subroutine audit_lanes(audit, system, t, q, v)
        !! The vector form of the accelerations says the same; sin and cos there are good to four
        !! last digits.
        type(audit_t), intent(inout) :: audit
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t, q(:), v(:)
        real(dp), dimension(lanes, size(q)) :: q_lanes, v_lanes, a_lanes
        real(dp) :: t_lanes(lanes), a(size(q)), other(size(q)), tt, qq(size(q)), vv(size(q)), scale
        integer :: i

        t_lanes = t
        do i = 1, lanes
            q_lanes(i, :) = q
            v_lanes(i, :) = v
        end do
        call system%accelerations_lanes(t_lanes, q_lanes, v_lanes, a_lanes)
        call system%accelerations(t, q, v, a)
        call neighbour(t, q, v, tt, qq, vv)
        call system%accelerations(tt, qq, vv, other)
        scale = maxval(abs(a)) + maxval(abs(v))**2 + tiny(1.0_dp)
        do i = 1, lanes
            call audit%judge("accelerations in lanes", maxval(abs(a_lanes(i, :) - a))/scale, &
                             epsilon(scale) + maxval(abs(other - a))/scale, rounding)
        end do
    end subroutine audit_lanes
end module lagrangia_audit_equations
