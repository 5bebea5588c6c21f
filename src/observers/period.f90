module lagrangia_period
    !! The period of one coordinate, read off its turning points.
    !!
    !! Between two samples the coordinate is the quintic that has the samples' coordinate,
    !! velocity and acceleration, right to \(O(\Delta t^6)\): its turning point's time is right to
    !! \(O(\Delta t^5)\).
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp
    use lagrangia_observer, only: observer_t
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: period_t

    type, extends(observer_t) :: period_t
        integer :: coordinate = 1
        integer :: turns = 0          !! lower turning points met
        real(dp) :: first = 0.0_dp    !! time of the first, s
        real(dp) :: last = 0.0_dp     !! time of the latest, s
        logical :: resolved = .true.  !! the samples are close enough to follow the motion
        logical, private :: started = .false.
        real(dp), private :: t = 0.0_dp, q = 0.0_dp, v = 0.0_dp, a = 0.0_dp
    contains
        procedure :: observe
        procedure :: period
    end type period_t

contains

    subroutine observe(self, system, t, q, v, error)
        !! A lower turning point is where the velocity turns from negative to positive.
        class(period_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t, q(system%ndof), v(system%ndof)
        type(error_t), allocatable, intent(out) :: error
        real(dp) :: a(system%ndof)
        integer :: i

        i = self%coordinate
        call system%accelerations(t, q, v, a)
        if (self%started) self%resolved = self%resolved .and. follows(t - self%t, self%v, self%a, &
                                                                      v(i), a(i))
        if (self%started .and. self%v < 0.0_dp .and. v(i) >= 0.0_dp) then
            self%last = turning_time(self%t, self%q, self%v, self%a, t, q(i), v(i), a(i))
            if (self%turns == 0) self%first = self%last
            self%turns = self%turns + 1
        end if
        self%started = .true.
        self%t = t
        self%q = q(i)
        self%v = v(i)
        self%a = a(i)
    end subroutine observe

    pure function period(self) result(value)
        !! The mean period, s; 0 where fewer than two turning points were met, or where the
        !! samples are too far apart to tell (a period from too few samples would be a fiction).
        class(period_t), intent(in) :: self
        real(dp) :: value

        value = 0.0_dp
        if (self%turns > 1 .and. self%resolved) value = (self%last - self%first)/(self%turns - 1)
    end function period

    pure function follows(h, v0, a0, v1, a1) result(yes)
        !! Whether the accelerations at both ends account for the change of the velocity.
        real(dp), intent(in) :: h, v0, a0, v1, a1
        logical :: yes

        yes = abs(v1 - v0 - 0.5_dp*h*(a0 + a1)) <= &
              0.1_dp*(abs(v0) + abs(v1) + h*(abs(a0) + abs(a1)))
    end function follows

    pure function turning_time(t0, q0, v0, a0, t1, q1, v1, a1) result(t)
        !! Where the derivative of the quintic Hermite interpolant vanishes, by bisection.
        real(dp), intent(in) :: t0, q0, v0, a0, t1, q1, v1, a1
        real(dp) :: t, h, d, c3, c4, c5, low, high, s
        integer :: i

        h = t1 - t0
        d = q1 - q0 - h*v0 - 0.5_dp*h**2*a0
        c3 = 10.0_dp*d - 4.0_dp*h*(v1 - v0 - h*a0) + 0.5_dp*h**2*(a1 - a0)
        c4 = -15.0_dp*d + 7.0_dp*h*(v1 - v0 - h*a0) - h**2*(a1 - a0)
        c5 = 6.0_dp*d - 3.0_dp*h*(v1 - v0 - h*a0) + 0.5_dp*h**2*(a1 - a0)
        low = 0.0_dp
        high = 1.0_dp
        do i = 1, 60
            s = 0.5_dp*(low + high)
            if (h*v0 + s*(h**2*a0 + s*(3.0_dp*c3 + s*(4.0_dp*c4 + s*5.0_dp*c5))) < 0.0_dp) then
                low = s
            else
                high = s
            end if
        end do
        t = t0 + s*h
    end function turning_time
end module lagrangia_period
