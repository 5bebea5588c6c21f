module lagrangia_point_motion
    !! How the masses of a system move in space: from \(x(q, t)\) and the motion of \(q\).
    !!
    !! $$ \dot x = \sum_j\frac{\partial x}{\partial q_j}\dot q_j + \frac{\partial x}{\partial t},
    !!    \qquad \delta x = \sum_j\frac{\partial x}{\partial q_j}\delta q_j $$
    !! A virtual displacement has no \(dt\) term: the constraints stand still meanwhile. The `x` are
    !! those of `newton` of `system_t`: three of each point, then one angle of each rotor.
    !!
    !! From these: D'Alembert's sum and the generalized forces of one state.
    use lagrangia_description, only: description_t
    use lagrangia_errors, only: error_t
    use lagrangia_gauss_principle, only: masses_of, place_points
    use lagrangia_hyperdual, only: hyperdual, hyperdual_t
    use lagrangia_kinds, only: dp
    use lagrangia_lagrange, only: euler_lagrange_t, expand_lagrangian
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: point_motion_t, expand_points
    public :: dalembert, conservative_forces

    type :: point_motion_t
        !! One state of all of them.
        real(dp), allocatable :: mass(:)         !! kg; kg m^2 of a rotor
        real(dp), allocatable :: velocity(:), acceleration(:)
        real(dp), allocatable :: x_t(:)          !! \(\partial x/\partial t\)
        real(dp), allocatable :: jacobian(:, :)  !! \(\partial x/\partial q_j\)
        real(dp), allocatable :: slope(:, :)     !! \(\partial\dot x/\partial q_j\)
        real(dp), allocatable :: force(:)        !! applied, N
    end type point_motion_t

contains

    pure subroutine expand_points(system, t, q, v, a, motion)
        !! Exact, by hyper-dual numbers.
        class(system_t), intent(in) :: system  !! with its parameters
        real(dp), intent(in) :: t, q(system%ndof), v(system%ndof), a(system%ndof)
        !! s; coordinates, velocities, accelerations
        type(point_motion_t), intent(out) :: motion  !! of all points and rotors
        type(description_t) :: d
        type(hyperdual_t), allocatable :: x(:), residual(:), u(:)
        type(hyperdual_t) :: tt, qq(system%ndof)
        integer :: j, n

        call system%describe(d)
        allocate (motion%mass, source=masses_of(d))
        n = size(motion%mass)
        allocate (motion%velocity(n), motion%acceleration(n), motion%x_t(n), &
                  motion%jacobian(n, system%ndof), motion%slope(n, system%ndof), &
                  motion%force(n), x(n))
        ! the second derivative along the motion, but for the bend of the motion itself
        tt = hyperdual_t(t, 1.0_dp, 1.0_dp, 0.0_dp)
        qq = hyperdual(q)
        qq%d1 = v
        qq%d2 = v
        call place_points(system, d, tt, qq, x)
        motion%velocity = x%d1
        motion%acceleration = x%d12
        do j = 1, system%ndof
            tt = hyperdual_t(t, 0.0_dp, 1.0_dp, 0.0_dp)
            qq = hyperdual(q)
            qq%d2 = v
            qq(j)%d1 = 1.0_dp
            call place_points(system, d, tt, qq, x)
            motion%jacobian(:, j) = x%d1
            motion%slope(:, j) = x%d12
            motion%acceleration = motion%acceleration + x%d1*a(j)
        end do
        tt = hyperdual_t(t, 1.0_dp, 0.0_dp, 0.0_dp)
        qq = hyperdual(q)
        call place_points(system, d, tt, qq, x)
        motion%x_t = x%d1
        tt = hyperdual(t)
        x = hyperdual(x%re)
        allocate (u, source=hyperdual(motion%velocity))
        j = 0
        if (allocated(d%reactions)) j = size(d%reactions)
        allocate (residual(j))
        call system%newton(tt, x, u, motion%force, residual)
    end subroutine expand_points

    pure function dalembert(system, t, q, v) result(worst)
        !! \(\sum(m\ddot x - F)\cdot\delta x\), the largest of the allowed \(\delta q\), relative
        !! to the sum of its terms' magnitudes.
        class(system_t), intent(in) :: system  !! with its parameters
        real(dp), intent(in) :: t, q(system%ndof), v(system%ndof)  !! s; coordinates and velocities
        real(dp) :: worst
        type(point_motion_t) :: motion
        type(error_t), allocatable :: error
        real(dp) :: a(system%ndof), free(system%ndof - system%constraints), dq(system%ndof)
        real(dp), allocatable :: dx(:)
        real(dp) :: total, size_of
        integer :: j

        call system%accelerations(t, q, v, a)
        call expand_points(system, t, q, v, a, motion)
        allocate (dx(size(motion%mass)))
        worst = 0.0_dp
        do j = 1, size(free)
            free = 0.0_dp
            free(j) = 1.0_dp
            call system%complete_velocities(t, q, free, dq, error)
            dx = matmul(motion%jacobian, dq)
            total = sum((motion%mass*motion%acceleration - motion%force)*dx)
            size_of = sum(abs(motion%mass*motion%acceleration*dx) + abs(motion%force*dx))
            worst = max(worst, abs(total)/max(size_of, tiny(size_of)))
        end do
    end function dalembert

    pure function conservative_forces(system, t, q, v) result(worst)
        !! \(\sum F\,\partial x/\partial q_j - \partial(L - T)/\partial q_j - Q_j\), relative to the
        !! largest term, with the generalised forces beside L;
        !! \(\partial T/\partial q_j = \sum m\dot x\,\partial\dot x/\partial q_j\).
        class(system_t), intent(in) :: system  !! with its parameters
        real(dp), intent(in) :: t, q(system%ndof), v(system%ndof)  !! s; coordinates and velocities
        real(dp) :: worst, right, size_of
        type(point_motion_t) :: motion
        type(euler_lagrange_t) :: terms
        integer :: j

        call expand_points(system, t, q, v, v, motion)
        call expand_lagrangian(system, t, q, v, terms)
        worst = 0.0_dp
        do j = 1, system%ndof
            right = sum(motion%mass*motion%velocity*motion%slope(:, j))
            size_of = abs(right) + abs(terms%dl_dq(j)) + abs(terms%beside(j)) &
                      + sum(abs(motion%force*motion%jacobian(:, j)))
            right = terms%dl_dq(j) + terms%beside(j) - right
            worst = max(worst, abs(sum(motion%force*motion%jacobian(:, j)) - right) &
                        /max(size_of, tiny(size_of)))
        end do
    end function conservative_forces
end module lagrangia_point_motion
