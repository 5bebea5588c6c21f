module lagrangia_lagrange
    !! Equations of motion from a Lagrangian and the generalised forces beside it: the oracle of
    !! every hand-derived equation.
    !!
    !! Lagrange's equations written out are
    !! $$ M\,\ddot q = \frac{\partial L}{\partial q}
    !!    - \frac{\partial^2 L}{\partial\dot q\,\partial q}\,\dot q
    !!    - \frac{\partial^2 L}{\partial\dot q\,\partial t} + Q + A^\top\lambda,\qquad
    !!    M = \frac{\partial^2 L}{\partial\dot q\,\partial\dot q}, $$
    !! with \(A\ddot q = -\dot A\dot q - \dot b\) where there are constraints \(A\dot q + b = 0\)
    !! (Lagrange-d'Alembert: the constraint is *not* put into \(L\)). All derivatives are exact:
    !! `L` is evaluated on hyper-dual numbers.
    use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
    use lagrangia_errors, only: error_t, fail
    use lagrangia_generalised_forces, only: add_generalised_forces
    use lagrangia_hyperdual, only: hyperdual_t
    use lagrangia_kinds, only: dp
    use lagrangia_saddle_point, only: solve_saddle_point
    use lagrangia_system, only: check_state, system_t
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: euler_lagrange_t, expand_lagrangian, accelerations_from_lagrangian
    public :: equations_of_motion, energy_from_lagrangian, energy_rate, energy_slopes

    type :: euler_lagrange_t
        !! The Lagrangian's derivatives at one state, and the generalised forces.
        real(dp) :: l = 0.0_dp
        real(dp) :: dl_dt = 0.0_dp
        real(dp), allocatable :: dl_dq(:), dl_dv(:)  !! force and momentum
        real(dp), allocatable :: beside(:)           !! \(Q\), generalised forces that L lacks
        real(dp), allocatable :: mass(:, :)          !! \(\partial^2L/\partial v\partial v\)
        real(dp), allocatable :: force(:)            !! right-hand side of \(M\ddot q\)
    end type euler_lagrange_t

contains

    pure subroutine expand_lagrangian(system, t, q, v, terms)
        !! All first derivatives of `L` and the second ones that the equations of motion need; NaN
        !! where `check_state` refuses the state.
        class(system_t), intent(in) :: system            !! gives L
        real(dp), intent(in) :: t            !! s
        real(dp), intent(in) :: q(:), v(:)   !! coordinates, velocities, (n), n = `system%ndof`
        type(euler_lagrange_t), intent(out) :: terms     !! the derivatives, allocated
        type(hyperdual_t) :: tt, qq(system%ndof), vv(system%ndof), l
        type(error_t), allocatable :: error
        integer :: i, j, n

        n = system%ndof
        allocate (terms%dl_dq(n), terms%dl_dv(n), terms%beside(n), terms%mass(n, n), &
                  terms%force(n))
        terms%beside = 0.0_dp
        call check_state(system, q, v, error)
        if (allocated(error)) then
            terms%l = ieee_value(t, ieee_quiet_nan)
            terms%dl_dt = terms%l
            terms%dl_dq = terms%l
            terms%dl_dv = terms%l
            terms%beside = terms%l
            terms%mass = terms%l
            terms%force = terms%l
            return
        end if
        tt%re = t
        qq%re = q
        vv%re = v
        do i = 1, n
            vv(i)%d1 = 1.0_dp
            do j = i, n
                vv(j)%d2 = 1.0_dp
                l = system%lagrangian(tt, qq, vv)
                terms%mass(i, j) = l%d12
                terms%mass(j, i) = l%d12
                vv(j)%d2 = 0.0_dp
            end do
            terms%dl_dv(i) = l%d1
            ! along the motion (q_dot = v, t_dot = 1): d/dt of dL/dv at constant v
            qq%d2 = v
            tt%d2 = 1.0_dp
            l = system%lagrangian(tt, qq, vv)
            terms%force(i) = -l%d12
            qq%d2 = 0.0_dp
            tt%d2 = 0.0_dp
            vv(i)%d1 = 0.0_dp
            qq(i)%d1 = 1.0_dp
            l = system%lagrangian(tt, qq, vv)
            terms%dl_dq(i) = l%d1
            qq(i)%d1 = 0.0_dp
        end do
        tt%d1 = 1.0_dp
        l = system%lagrangian(tt, qq, vv)
        terms%l = l%re
        terms%dl_dt = l%d1
        terms%force = terms%force + terms%dl_dq
        if (.not. system%nonconservative) return
        call add_generalised_forces(system, t, q, v, terms%beside)
        terms%force = terms%force + terms%beside
    end subroutine expand_lagrangian

    pure subroutine equations_of_motion(system, t, q, v, terms, matrix, right)
        !! Lagrange's equations and the rates of the non-holonomic constraints as one linear
        !! system for \((\ddot q, \lambda)\), `n` coordinates and `k` constraints.
        class(system_t), intent(in) :: system                      !! gives L
        real(dp), intent(in) :: t, q(system%ndof), v(system%ndof)  !! time, s; state
        type(euler_lagrange_t), intent(in) :: terms                !! of L at this state
        real(dp), intent(out) :: matrix(:, :)                      !! (n + k, n + k)
        real(dp), intent(out) :: right(:)                          !! (n + k)
        type(hyperdual_t) :: tt, qq(system%ndof)
        type(hyperdual_t) :: rows(system%constraints, system%ndof), drift(system%constraints)
        real(dp) :: rate(system%constraints, system%ndof)
        integer :: n

        n = system%ndof
        matrix = 0.0_dp
        matrix(:n, :n) = terms%mass
        right(:n) = terms%force
        if (system%constraints == 0) return
        tt%re = t
        tt%d1 = 1.0_dp
        qq%re = q
        qq%d1 = v
        call system%constraint_rows(tt, qq, rows, drift)
        matrix(n + 1:, :n) = rows%re
        matrix(:n, n + 1:) = -transpose(rows%re)
        rate = rows%d1
        right(n + 1:) = -matmul(rate, v) - drift%d1
    end subroutine equations_of_motion

    pure subroutine accelerations_from_lagrangian(system, t, q, v, a, multipliers, error)
        !! Accelerations, and the multipliers \(\lambda\) of the non-holonomic constraints.
        class(system_t), intent(in) :: system            !! gives L
        real(dp), intent(in) :: t                         !! s
        real(dp), intent(in) :: q(:), v(:)                !! coordinates, velocities, (n)
        real(dp), intent(out) :: a(:)                     !! accelerations, (n); 0 after an error
        real(dp), intent(out) :: multipliers(:)           !! (`system%constraints`)
        type(error_t), allocatable, intent(out) :: error  !! arrays of another size, a singular M
        type(euler_lagrange_t) :: terms
        real(dp), dimension(system%ndof + system%constraints, &
                            system%ndof + system%constraints) :: matrix
        real(dp), dimension(system%ndof + system%constraints) :: right, solution

        a = 0.0_dp
        multipliers = 0.0_dp
        call check_state(system, q, v, error)
        if (allocated(error)) return
        if (size(a) /= system%ndof .or. size(multipliers) /= system%constraints) then
            call fail(error, "there are "//to_text(system%ndof)//" accelerations and "// &
                      to_text(system%constraints)//" multipliers, not "//to_text(size(a))// &
                      " and "//to_text(size(multipliers)))
            return
        end if
        call expand_lagrangian(system, t, q, v, terms)
        call equations_of_motion(system, t, q, v, terms, matrix, right)
        call solve_saddle_point(matrix, right, solution, error)
        if (allocated(error)) return
        a = solution(:system%ndof)
        multipliers = solution(system%ndof + 1:)
    end subroutine accelerations_from_lagrangian

    pure function energy_from_lagrangian(system, t, q, v) result(energy)
        !! \(\dot q\,\partial L/\partial\dot q - L\); NaN where `check_state` refuses the state.
        class(system_t), intent(in) :: system            !! gives L
        real(dp), intent(in) :: t            !! s
        real(dp), intent(in) :: q(:), v(:)   !! coordinates, velocities, (`system%ndof`)
        real(dp) :: energy
        type(euler_lagrange_t) :: terms

        call expand_lagrangian(system, t, q, v, terms)
        energy = -terms%l
        if (size(v) == system%ndof) energy = dot_product(v, terms%dl_dv) - terms%l
    end function energy_from_lagrangian

    pure subroutine energy_slopes(system, t, q, v, by_q, by_v)
        !! \(\partial E/\partial q\) and \(\partial E/\partial\dot q\) of
        !! \(E = \dot q\,\partial L/\partial\dot q - L\).
        class(system_t), intent(in) :: system  !! gives L
        real(dp), intent(in) :: t              !! s
        real(dp), intent(in) :: q(:), v(:)     !! coordinates, velocities, (n)
        real(dp), intent(out) :: by_q(:), by_v(:)  !! (n)
        type(hyperdual_t) :: qq(size(q)), vv(size(q)), l
        integer :: j

        qq%re = q
        vv%re = v
        vv%d2 = v
        do j = 1, size(q)
            vv(j)%d1 = 1.0_dp
            l = system%lagrangian(hyperdual_t(t), qq, vv)
            vv(j)%d1 = 0.0_dp
            by_v(j) = l%d12
            qq(j)%d1 = 1.0_dp
            l = system%lagrangian(hyperdual_t(t), qq, vv)
            qq(j)%d1 = 0.0_dp
            by_q(j) = l%d12 - l%d1
        end do
    end subroutine energy_slopes

    pure function energy_rate(system, t, q, v) result(rate)
        !! \(\dot E = \sum_j Q_j\dot q_j - \partial L/\partial t - \sum_k\lambda_k b_k\) of the
        !! energy function: of constraints \(A\dot q + b = 0\) those with \(b = 0\) do no work.
        class(system_t), intent(in) :: system                      !! with its parameters
        real(dp), intent(in) :: t, q(system%ndof), v(system%ndof)  !! time, s; state
        real(dp) :: rate                                           !! W
        type(hyperdual_t) :: l, qq(system%ndof), vv(system%ndof)
        type(hyperdual_t) :: rows(system%constraints, system%ndof), b(system%constraints)
        type(error_t), allocatable :: error
        real(dp) :: beside(system%ndof), multipliers(system%constraints)

        beside = 0.0_dp
        call add_generalised_forces(system, t, q, v, beside)
        rate = dot_product(beside, v)
        if (.not. (system%time_dependent .or. system%constraints_work)) return
        qq%re = q
        vv%re = v
        l = system%lagrangian(hyperdual_t(re=t, d1=1.0_dp), qq, vv)
        rate = rate - l%d1
        if (.not. system%constraints_work) return
        call system%constraint_rows(hyperdual_t(re=t), qq, rows, b)
        call accelerations_from_lagrangian(system, t, q, v, beside, multipliers, error)
        rate = rate - dot_product(multipliers, b%re)
    end function energy_rate
end module lagrangia_lagrange
