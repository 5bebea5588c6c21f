module motion
    !! What moves with a system: rates of its quantities, accelerations of its points.
    use lagrangia_description, only: description_t
    use lagrangia_flow, only: flow_derivative
    use lagrangia_hyperdual, only: hyperdual_t
    use lagrangia_kinds, only: dp
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: flow_derivative, point_accelerations, newton_lagrangian

contains

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
