module lagrangia_dalembert
    !! D'Alembert's sum and the generalized forces of one state, from masses, forces and
    !! positions of points.
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp
    use lagrangia_lagrange, only: euler_lagrange_t, expand_lagrangian
    use lagrangia_point_motion, only: expand_points, point_motion_t
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: dalembert, conservative_forces

contains

    pure function dalembert(system, t, q, v) result(worst)
        !! \(\sum(m\ddot x - F)\cdot\delta x\), the largest of the allowed \(\delta q\), relative
        !! to the sum of its terms' magnitudes.
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t, q(system%ndof), v(system%ndof)
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
        !! \(Q_j - \partial(L - T)/\partial q_j\), relative to the largest term;
        !! \(\partial T/\partial q_j = \sum m\dot x\,\partial\dot x/\partial q_j\).
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t, q(system%ndof), v(system%ndof)
        real(dp) :: worst, right, size_of
        type(point_motion_t) :: motion
        type(euler_lagrange_t) :: terms
        integer :: j

        call expand_points(system, t, q, v, v, motion)
        call expand_lagrangian(system, t, q, v, terms)
        worst = 0.0_dp
        do j = 1, system%ndof
            right = sum(motion%mass*motion%velocity*motion%slope(:, j))
            size_of = abs(right) + abs(terms%dl_dq(j)) &
                      + sum(abs(motion%force*motion%jacobian(:, j)))
            right = terms%dl_dq(j) - right
            worst = max(worst, abs(sum(motion%force*motion%jacobian(:, j)) - right) &
                        /max(size_of, tiny(size_of)))
        end do
    end function conservative_forces
end module lagrangia_dalembert
