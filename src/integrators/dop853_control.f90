module lagrangia_dop853_control
    !! How long the steps of `dop853` are.
    !!
    !! Source: Hairer, Nørsett & Wanner, *Solving Ordinary Differential Equations I*, 2nd ed.,
    !! sec. II.4: starting step, and PI control of the others.
    use lagrangia_dop853_stages, only: slope
    use lagrangia_kinds, only: dp
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: first_step, least_error, next_step, shorter_step

    real(dp), parameter :: least_error = 1e-4_dp             !! in tolerances: less counts as much
    real(dp), parameter :: safety = 0.9_dp
    real(dp), parameter :: shrink = 0.333_dp, grow = 6.0_dp  !! limits of one change of step
    real(dp), parameter :: beta = 0.04_dp                    !! share of the previous error
    real(dp), parameter :: alpha = 1.0_dp/8.0_dp - 0.2_dp*beta

contains

    pure subroutine first_step(system, n, tolerance, t0, t_end, y, slope_y, h)
        !! As long as a step of Euler's that would err little, and as the change of the slope over
        !! it allows. One evaluation.
        class(system_t), intent(in) :: system   !! gives the accelerations
        integer, intent(in) :: n                !! degrees of freedom
        real(dp), intent(in) :: tolerance       !! absolute below 1, relative above
        real(dp), intent(in) :: t0, t_end       !! start and end of the motion, s
        real(dp), intent(in) :: y(2*n)          !! state at the start
        real(dp), intent(in) :: slope_y(2*n)    !! its slope
        real(dp), intent(out) :: h              !! s
        real(dp) :: ahead(2*n), change, size_slope, size_y

        size_y = norm(tolerance, y, y)
        size_slope = norm(tolerance, slope_y, y)
        h = 1e-6_dp
        if (min(size_y, size_slope) > 1e-5_dp) h = 0.01_dp*size_y/size_slope
        h = min(h, t_end - t0)
        call slope(system, n, t0 + h, y + h*slope_y, ahead)
        change = max(norm(tolerance, ahead - slope_y, y)/h, size_slope)
        if (change > 1e-15_dp) then
            h = min(100.0_dp*h, (0.01_dp/change)**(1.0_dp/8.0_dp))
        else
            h = max(1e-6_dp, 1e-3_dp*h)
        end if
        h = max(h, 1024.0_dp*spacing(t0))  ! a step that is too long will be rejected
    end subroutine first_step

    pure function next_step(h, scaled, last_error) result(longer)
        !! After an accepted step.
        real(dp), intent(in) :: h           !! its length, s
        real(dp), intent(in) :: scaled      !! its error, in tolerances
        real(dp), intent(in) :: last_error  !! that of the accepted step before, or `least_error`
        real(dp) :: longer

        longer = h/max(1.0_dp/grow, min(1.0_dp/shrink, &
                                        scaled**alpha/(safety*last_error**beta)))
    end function next_step

    pure function shorter_step(h, scaled) result(shorter)
        !! After a rejected step.
        real(dp), intent(in) :: h       !! its length, s
        real(dp), intent(in) :: scaled  !! its error, in tolerances; huge: no number came out
        real(dp) :: shorter

        shorter = 0.1_dp*h
        if (scaled < huge(scaled)) shorter = h/min(1.0_dp/shrink, scaled**alpha/safety)
    end function shorter_step

    pure function norm(tolerance, x, y) result(size_x)
        !! Root mean square of `x`, in units of the tolerance at the state `y`.
        real(dp), intent(in) :: tolerance, x(:), y(:)
        real(dp) :: size_x
        integer :: i

        size_x = 0.0_dp
        do i = 1, size(x)
            size_x = size_x + (x(i)/max(1.0_dp, abs(y(i))))**2
        end do
        size_x = sqrt(size_x/size(x))/tolerance
    end function norm
end module lagrangia_dop853_control
