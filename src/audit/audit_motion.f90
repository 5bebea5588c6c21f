module lagrangia_audit_motion
    !! What must hold along the motion, at one state.
    use lagrangia_description, only: description_t
    use lagrangia_findings, only: audit_t
    use lagrangia_flow, only: flow_derivative, quantity_of
    use lagrangia_hyperdual, only: hyperdual_t
    use lagrangia_kinds, only: dp
    use lagrangia_system, only: system_t
    use lagrangia_term_sizes, only: motion_t, nearby_t, neighbours, term_size
    implicit none (type, external)
    private
    public :: audit_rates

    real(dp), parameter :: differencing = 100.0_dp
    !! what the sum of eight values, each of some ten operations, may make of the noise

contains

    subroutine audit_rates(audit, system, nearby, motion)
        !! \(\dot h = -\partial L/\partial t - b\cdot\lambda\), and declared invariants stay.
        type(audit_t), intent(inout) :: audit
        class(system_t), intent(in) :: system
        type(nearby_t), intent(in) :: nearby
        type(motion_t), intent(in) :: motion
        type(description_t) :: d
        type(hyperdual_t) :: rows(system%constraints, system%ndof), drift(system%constraints)
        type(hyperdual_t) :: place(system%ndof)
        real(dp) :: expected, rounded, with_time(0:neighbours)
        integer :: k

        place%re = nearby%q(:, 0)
        call system%constraint_rows(hyperdual_t(re=nearby%t(0)), place, rows, drift)
        with_time = nearby%terms%dl_dt
        expected = -with_time(0) - dot_product(drift%re, motion%multipliers)
        rounded = epsilon(1.0_dp)*(term_size(with_time) &
                                   + dot_product(abs(drift%re), motion%multiplier_size))
        call judge_rate("energy changes by -dL/dt", 0)
        call system%describe(d)
        if (.not. allocated(d%quantities)) return
        expected = 0.0_dp
        rounded = 0.0_dp
        do k = 1, size(d%quantities)
            if (.not. d%quantities(k)%conserved) cycle
            call judge_rate(trim(d%quantities(k)%name)//" is conserved", k)
        end do
    contains
        subroutine judge_rate(claim, quantity)
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
            call audit%judge(claim, abs(rate - expected)/scale, (noise + rounded)/scale, &
                             differencing)
        end subroutine judge_rate
    end subroutine audit_rates
end module lagrangia_audit_motion
