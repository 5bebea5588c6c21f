module lagrangia_generalised_forces
    !! What the generalised forces \(Q\) beside L do to momenta and energy.
    use lagrangia_hyperdual, only: hyperdual_t
    use lagrangia_kinds, only: dp
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: add_generalised_forces, energy_rate, momentum_rates

contains

    pure subroutine add_generalised_forces(system, t, q, v, f)
        !! Add \(Q\) to `f`.
        class(system_t), intent(in) :: system                      !! with its parameters
        real(dp), intent(in) :: t, q(system%ndof), v(system%ndof)  !! time, s; state
        real(dp), intent(inout) :: f(system%ndof)                  !! N, or N m on an angle
        type(hyperdual_t) :: tt, qq(system%ndof), vv(system%ndof), beside(system%ndof)

        if (.not. system%nonconservative) return
        tt%re = t
        qq%re = q
        vv%re = v
        call system%generalised_forces(tt, qq, vv, beside)
        f = f + beside%re
    end subroutine add_generalised_forces

    pure subroutine momentum_rates(system, t, q, v, f)
        !! \(\dot p = \partial L/\partial q + Q\).
        class(system_t), intent(in) :: system                      !! with its parameters
        real(dp), intent(in) :: t, q(system%ndof), v(system%ndof)  !! time, s; state
        real(dp), intent(out) :: f(system%ndof)                    !! N, or N m on an angle

        call system%forces(t, q, v, f)
        ! arrays of the size of the state are allocated there
        if (system%nonconservative) call add_generalised_forces(system, t, q, v, f)
    end subroutine momentum_rates

    pure function energy_rate(system, t, q, v) result(rate)
        !! \(\dot E = \sum_j Q_j\dot q_j - \partial L/\partial t\) of the energy function; of
        !! non-holonomic constraints \(A\dot q + b = 0\) those with \(b = 0\) add nothing.
        class(system_t), intent(in) :: system                      !! with its parameters
        real(dp), intent(in) :: t, q(system%ndof), v(system%ndof)  !! time, s; state
        real(dp) :: rate                                           !! W
        type(hyperdual_t) :: l, qq(system%ndof), vv(system%ndof)
        real(dp) :: beside(system%ndof)

        beside = 0.0_dp
        call add_generalised_forces(system, t, q, v, beside)
        rate = dot_product(beside, v)
        if (.not. system%time_dependent) return
        qq%re = q
        vv%re = v
        l = system%lagrangian(hyperdual_t(re=t, d1=1.0_dp), qq, vv)
        rate = rate - l%d1
    end function energy_rate
end module lagrangia_generalised_forces
