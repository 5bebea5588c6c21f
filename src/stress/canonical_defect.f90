module lagrangia_canonical_defect
    !! How far one step of a method is from a canonical map.
    use lagrangia_integrator, only: integrator_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: canonical_defect, differentiate_step

    real(dp), parameter :: usual_step = 0.05_dp  !! s

contains

    function canonical_defect(method, system, t, q, v, dt) result(defect)
        !! The largest element of \(J^\top\Omega J - \Omega\), relative to the terms it consists of.
        class(integrator_t), intent(inout) :: method
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t, q(:), v(:)
        real(dp), intent(in), optional :: dt  !! the step, if not the usual one
        real(dp) :: defect
        real(dp), dimension(2*size(q), 2*size(q)) :: jacobian, omega
        integer :: i, n

        n = size(q)
        omega = 0.0_dp
        do i = 1, n
            omega(i, n + i) = 1.0_dp
            omega(n + i, i) = -1.0_dp
        end do
        call differentiate_step(method, system, t, q, v, jacobian, dt)
        defect = maxval(abs(matmul(transpose(jacobian), matmul(omega, jacobian)) - omega) &
                        /(1.0_dp + matmul(transpose(abs(jacobian)), &
                                          matmul(abs(omega), abs(jacobian)))))
    end function canonical_defect

    subroutine differentiate_step(method, system, t, q, v, jacobian, dt)
        !! The derivative of a step in coordinates and momenta, by differences of order 8.
        class(integrator_t), intent(inout) :: method
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t, q(:), v(:)
        real(dp), intent(out) :: jacobian(2*size(q), 2*size(q))
        real(dp), intent(in), optional :: dt
        real(dp), parameter :: weight(4) = [4.0_dp/5.0_dp, -1.0_dp/5.0_dp, 4.0_dp/105.0_dp, &
                                            -1.0_dp/280.0_dp]
        real(dp) :: x(2*size(q)), ahead(2*size(q)), behind(2*size(q))
        real(dp) :: h, length
        integer :: i, k, n

        length = usual_step
        if (present(dt)) length = dt
        n = size(q)
        x(:n) = q
        call system%momenta(t, q, v, x(n + 1:))
        jacobian = 0.0_dp
        do i = 1, 2*n
            h = 0.005_dp
            if (i > n) h = h*(1.0_dp + maxval(abs(x(n + 1:))))
            do k = 1, 4
                ahead = x
                ahead(i) = x(i) + k*h
                behind = x
                behind(i) = x(i) - k*h
                call step(ahead)
                call step(behind)
                jacobian(:, i) = jacobian(:, i) + weight(k)/h*(ahead - behind)
            end do
        end do
    contains
        subroutine step(y)
            real(dp), intent(inout) :: y(:)
            real(dp), dimension(size(q)) :: p, qq, vv

            qq = y(:n)
            p = y(n + 1:)
            call system%velocities(t, qq, p, vv)
            call method%start(system, t, qq, vv)
            call method%advance(system, t, length, 0_i8, 1_i8, qq, vv)
            call system%momenta(t + length, qq, vv, p)
            y = [qq, p]
        end subroutine step
    end subroutine differentiate_step
end module lagrangia_canonical_defect
