module lagrangia_generalised_forces
    !! What the generalised forces \(Q\) beside L do to momenta.
    use lagrangia_hyperdual, only: hyperdual_t
    use lagrangia_kinds, only: dp
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: add_generalised_forces, momentum_rates

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
end module lagrangia_generalised_forces
