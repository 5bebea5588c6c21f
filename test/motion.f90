module motion
    !! What moves with a system: rates of its quantities, accelerations of its points.
    use lagrangia_description, only: description_t
    use lagrangia_hyperdual, only: hyperdual_t
    use lagrangia_kinds, only: dp
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: flow_derivative, point_accelerations, newton_lagrangian

contains

    subroutine flow_derivative(system, i, t, q, v, rate, scale)
        !! Time derivative of quantity `i` (0: the energy) along the equations of motion, by
        !! central differences of order 8 along \((1, \dot q, \ddot q)\), and the size of what
        !! adds up to it: the changes with time, coordinates and velocities taken one by one.
        class(system_t), intent(in) :: system
        integer, intent(in) :: i
        real(dp), intent(in) :: t, q(:), v(:)
        real(dp), intent(out) :: rate, scale
        real(dp) :: a(size(q)), zero(size(q)), one(size(q)), h
        integer :: k

        call system%accelerations(t, q, v, a)
        zero = 0.0_dp
        h = 0.02_dp/(1.0_dp + maxval(abs(v)) + maxval(abs(a)))
        rate = slope(system, i, t, q, v, 1.0_dp, v, a, h)
        scale = abs(slope(system, i, t, q, v, 1.0_dp, zero, zero, h))
        do k = 1, size(q)
            one = zero
            one(k) = v(k)
            scale = scale + abs(slope(system, i, t, q, v, 0.0_dp, one, zero, h))
            one(k) = a(k)
            scale = scale + abs(slope(system, i, t, q, v, 0.0_dp, zero, one, h))
        end do
        scale = scale + abs(value_of(system, i, t, q, v)) + tiny(1.0_dp)
    end subroutine flow_derivative

    function slope(system, i, t, q, v, dt, dq, dv, h) result(rate)
        !! Derivative of quantity `i` in the direction `(dt, dq, dv)`, order 8 in the step `h`.
        class(system_t), intent(in) :: system
        integer, intent(in) :: i
        real(dp), intent(in) :: t, q(:), v(:), dt, dq(:), dv(:), h
        real(dp) :: rate
        real(dp), parameter :: weight(4) = [4.0_dp/5.0_dp, -1.0_dp/5.0_dp, 4.0_dp/105.0_dp, &
                                            -1.0_dp/280.0_dp]
        integer :: k

        rate = 0.0_dp
        do k = 1, 4
            rate = rate + weight(k)/h &
                   *(value_of(system, i, t + k*h*dt, q + k*h*dq, v + k*h*dv) &
                     - value_of(system, i, t - k*h*dt, q - k*h*dq, v - k*h*dv))
        end do
    end function slope

    function value_of(system, i, t, q, v) result(value)
        !! Quantity `i`, or the energy if `i` is 0.
        class(system_t), intent(in) :: system
        integer, intent(in) :: i
        real(dp), intent(in) :: t, q(:), v(:)
        real(dp) :: value

        if (i == 0) then
            value = system%energy(t, q, v)
        else
            value = system%quantity(i, t, q, v)
        end if
    end function value_of

    subroutine point_accelerations(system, t, q, v, r, acceleration)
        !! Positions and exact accelerations of the points, `(3, points)`: their positions along
        !! \(t + s, q + vs + \tfrac12 as^2\), differentiated twice with respect to \(s\).
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t, q(:), v(:)
        real(dp), allocatable, intent(out) :: r(:, :), acceleration(:, :)
        type(description_t) :: d
        type(hyperdual_t) :: path(size(q))
        type(hyperdual_t), allocatable :: points(:, :)
        real(dp) :: a(size(q))

        call system%describe(d)
        call system%accelerations(t, q, v, a)
        allocate (points(3, size(d%points)))
        path%re = q
        path%d1 = v
        path%d2 = v
        path%d12 = a
        call system%positions(hyperdual_t(t, 1.0_dp, 1.0_dp, 0.0_dp), path, points)
        r = points%re
        acceleration = points%d12
    end subroutine point_accelerations

    function newton_lagrangian(system, t, q, v, g) result(l)
        !! Kinetic energy of the points less their \(m g y\).
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t, q(:), v(:), g
        real(dp) :: l
        type(description_t) :: d
        type(hyperdual_t) :: path(size(q))
        type(hyperdual_t), allocatable :: r(:, :)
        integer :: k

        call system%describe(d)
        allocate (r(3, size(d%points)))
        path%re = q
        path%d1 = v
        call system%positions(hyperdual_t(re=t, d1=1.0_dp), path, r)
        l = 0.0_dp
        do k = 1, size(d%points)
            l = l + d%points(k)%mass*(0.5_dp*sum(r(:, k)%d1**2) - g*r(2, k)%re)
        end do
    end function newton_lagrangian
end module motion
