module lobatto_3b
    !! Lobatto IIIB of three stages: reversible, of order 4, and not symplectic.
    !!
    !! Source: Hairer, Lubich & Wanner, *Geometric Numerical Integration*, 2nd ed., table II.1.3.
    use lagrangia_kinds, only: dp
    implicit none (type, external)
    private
    public :: energy_of, walk

contains

    pure function energy_of(y, tilt) result(h)
        !! \(H = p^2/2 - \cos q + \tau\sin 2q\) of \(y = (q, p)\).
        real(dp), intent(in) :: y(2), tilt
        real(dp) :: h

        h = 0.5_dp*y(2)**2 - cos(y(1)) + tilt*sin(2.0_dp*y(1))
    end function energy_of

    pure subroutine walk(y, tilt, dt, steps)
        !! `steps` steps, each solved by iteration to the last digits.
        real(dp), intent(inout) :: y(2)   !! (q, p)
        real(dp), intent(in) :: tilt, dt
        integer, intent(in) :: steps
        real(dp), parameter :: a(3, 3) = reshape([1.0_dp, 1.0_dp, 1.0_dp, -1.0_dp, 2.0_dp, 5.0_dp, &
                                                  0.0_dp, 0.0_dp, 0.0_dp], [3, 3])/6.0_dp
        real(dp), parameter :: b(3) = [1.0_dp, 4.0_dp, 1.0_dp]/6.0_dp
        real(dp) :: slopes(3, 2), stages(3, 2), before(3, 2)
        integer :: k, i

        do k = 1, steps
            slopes = spread([y(2), force(y(1))], 1, 3)
            do i = 1, 60
                before = slopes
                stages = spread(y, 1, 3) + dt*matmul(a, slopes)
                slopes(:, 1) = stages(:, 2)
                slopes(:, 2) = force(stages(:, 1))
                if (maxval(abs(slopes - before)) <= epsilon(dt)) exit
            end do
            y = y + dt*matmul(b, slopes)
        end do
    contains
        elemental function force(q)
            real(dp), intent(in) :: q
            real(dp) :: force

            force = -sin(q) - 2.0_dp*tilt*cos(2.0_dp*q)
        end function force
    end subroutine walk
end module lobatto_3b
