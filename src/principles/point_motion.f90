module lagrangia_point_motion
    !! How the masses of a system move in space: from \(x(q, t)\) and the motion of \(q\).
    !!
    !! $$ \dot x = \sum_j\frac{\partial x}{\partial q_j}\dot q_j + \frac{\partial x}{\partial t},
    !!    \qquad \delta x = \sum_j\frac{\partial x}{\partial q_j}\delta q_j $$
    !! A virtual displacement has no \(dt\) term: the constraints stand still meanwhile. The `x` are
    !! those of `newton` of `system_t`: three of each point, then one angle of each rotor.
    use lagrangia_description, only: description_t
    use lagrangia_hyperdual, only: hyperdual, hyperdual_t
    use lagrangia_kinds, only: dp
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: point_motion_t, expand_points

    type :: point_motion_t
        !! One state of all of them.
        real(dp), allocatable :: mass(:)         !! kg; kg m^2 of a rotor
        real(dp), allocatable :: velocity(:), acceleration(:)
        real(dp), allocatable :: drift(:)        !! \(\partial x/\partial t\)
        real(dp), allocatable :: jacobian(:, :)  !! \(\partial x/\partial q_j\)
        real(dp), allocatable :: slope(:, :)     !! \(\partial\dot x/\partial q_j\)
        real(dp), allocatable :: force(:)        !! applied, N
    end type point_motion_t

contains

    pure subroutine expand_points(system, t, q, v, a, motion)
        !! Exact, by hyper-dual numbers.
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t, q(system%ndof), v(system%ndof), a(system%ndof)
        type(point_motion_t), intent(out) :: motion
        type(description_t) :: d
        type(hyperdual_t), allocatable :: x(:), constraint_residual(:), u(:)
        type(hyperdual_t) :: tt, qq(system%ndof)
        integer :: j, n, points, rotors

        call system%describe(d)
        points = 0
        rotors = 0
        if (allocated(d%points)) points = size(d%points)
        if (allocated(d%rotors)) rotors = size(d%rotors)
        n = 3*points + rotors
        allocate (motion%mass(n), motion%velocity(n), motion%acceleration(n), motion%drift(n), &
                  motion%jacobian(n, system%ndof), motion%slope(n, system%ndof), &
                  motion%force(n), x(n))
        do j = 1, points
            motion%mass(3*j - 2:3*j) = d%points(j)%mass
        end do
        do j = 1, rotors
            motion%mass(3*points + j) = d%rotors(j)%mass
        end do
        ! the second derivative along the motion, but for the bend of the motion itself
        tt = hyperdual_t(t, 1.0_dp, 1.0_dp, 0.0_dp)
        qq = hyperdual(q)
        qq%d1 = v
        qq%d2 = v
        call place(system, tt, qq, points, x)
        motion%velocity = x%d1
        motion%acceleration = x%d12
        do j = 1, system%ndof
            tt = hyperdual_t(t, 0.0_dp, 1.0_dp, 0.0_dp)
            qq = hyperdual(q)
            qq%d2 = v
            qq(j)%d1 = 1.0_dp
            call place(system, tt, qq, points, x)
            motion%jacobian(:, j) = x%d1
            motion%slope(:, j) = x%d12
            motion%acceleration = motion%acceleration + x%d1*a(j)
        end do
        tt = hyperdual_t(t, 1.0_dp, 0.0_dp, 0.0_dp)
        qq = hyperdual(q)
        call place(system, tt, qq, points, x)
        motion%drift = x%d1
        tt = hyperdual(t)
        x = hyperdual(x%re)
        allocate (u, source=hyperdual(motion%velocity))
        j = 0
        if (allocated(d%reactions)) j = size(d%reactions)
        allocate (constraint_residual(j))
        call system%newton(tt, x, u, motion%force, constraint_residual)
    end subroutine expand_points

    pure subroutine place(system, t, q, points, x)
        !! Where everything is.
        class(system_t), intent(in) :: system
        type(hyperdual_t), intent(in) :: t, q(:)
        integer, intent(in) :: points
        type(hyperdual_t), intent(out) :: x(:)
        type(hyperdual_t) :: r(3, points), angles(size(x) - 3*points)
        integer :: j

        call system%positions(t, q, r)
        call system%angles(t, q, angles)
        do j = 1, points
            x(3*j - 2:3*j) = r(:, j)
        end do
        x(3*points + 1:) = angles
    end subroutine place
end module lagrangia_point_motion
