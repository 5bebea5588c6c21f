module lagrangia_period
    !! The period of one coordinate, read off its turning points in the steps of a run: the rows
    !! that are written have no part in it.
    !!
    !! A method with dense output has the turning point inside its step. Between two steps of
    !! another the coordinate is the quintic that has both ends' coordinate, velocity and
    !! acceleration, right to \(O(\Delta t^6)\): its turning point's time is right to
    !! \(O(\Delta t^5)\).
    use lagrangia_errors, only: error_t
    use lagrangia_hermite, only: quintic
    use lagrangia_integrator, only: dense_integrator_t
    use lagrangia_kinds, only: dp
    use lagrangia_observer, only: observer_t
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: period_t

    type, extends(observer_t) :: period_t
        !! It follows every step.
        integer :: coordinate = 1
        integer :: turns = 0          !! lower turning points met
        real(dp) :: first = 0.0_dp    !! time of the first, s
        real(dp) :: last = 0.0_dp     !! time of the latest, s
        real(dp) :: shortest = 0.0_dp, longest = 0.0_dp  !! from one to the next, s
        logical :: resolved = .true.  !! the steps are short enough to follow the motion
        real(dp), private :: t = 0.0_dp
        real(dp), allocatable, private :: q(:), v(:)
    contains
        procedure :: observe
        procedure :: follows
        procedure :: meet
        procedure :: follow
        procedure :: follow_inside
        procedure :: period
        procedure :: mean
    end type period_t

contains

    subroutine observe(self, system, t, q, v, error)
        !! See `observer_t`: of the samples only the first counts, where the run starts.
        class(period_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t, q(system%ndof), v(system%ndof)
        type(error_t), allocatable, intent(out) :: error

        if (.not. allocated(self%q)) call stand(self, t, q, v)
    end subroutine observe

    pure function follows(self)
        !! See `observer_t`: whatever its owner does.
        class(period_t), intent(in) :: self
        logical :: follows

        follows = .true.
    end function follows

    subroutine stand(self, t, q, v)
        !! All up to this state has been seen.
        class(period_t), intent(inout) :: self
        real(dp), intent(in) :: t, q(:), v(:)

        self%t = t
        self%q = q
        self%v = v
    end subroutine stand

    subroutine turn(self, t)
        !! A lower turning point: the velocity turns from negative to positive.
        class(period_t), intent(inout) :: self
        real(dp), intent(in) :: t

        select case (self%turns)
        case (0)
            self%first = t
        case (1)
            self%shortest = t - self%last
            self%longest = self%shortest
        case default
            self%shortest = min(self%shortest, t - self%last)
            self%longest = max(self%longest, t - self%last)
        end select
        self%last = t
        self%turns = self%turns + 1
    end subroutine turn

    subroutine meet(self, system, event, t, q, v, error)
        !! See `observer_t`: an impact turns the velocity at once.
        class(period_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        integer, intent(in) :: event
        real(dp), intent(in) :: t, q(system%ndof), v(system%ndof)
        type(error_t), allocatable, intent(out) :: error

        if (self%v(self%coordinate) < 0.0_dp .and. v(self%coordinate) >= 0.0_dp) call turn(self, t)
        call stand(self, t, q, v)
    end subroutine meet

    subroutine follow(self, system, t, q, v)
        !! See `observer_t`.
        class(period_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t, q(system%ndof), v(system%ndof)
        real(dp) :: a_old(system%ndof), a(system%ndof)

        if (.not. allocated(self%q)) call stand(self, t, q, v)
        associate (i => self%coordinate)
            if ((self%v(i) < 0.0_dp) .neqv. (v(i) < 0.0_dp)) then
                call system%accelerations(self%t, self%q, self%v, a_old)
                call system%accelerations(t, q, v, a)
                self%resolved = self%resolved &
                                .and. accounts(t - self%t, self%v(i), a_old(i), v(i), a(i))
                if (self%v(i) < 0.0_dp) call turn(self, turning_time( &
                    self%t, self%q(i), self%v(i), a_old(i), t, q(i), v(i), a(i)))
            end if
        end associate
        call stand(self, t, q, v)
    end subroutine follow

    subroutine follow_inside(self, method, t)
        !! See `observer_t`. Bisection, down to neighbouring times.
        class(period_t), intent(inout) :: self
        class(dense_integrator_t), intent(in) :: method
        real(dp), intent(in) :: t
        real(dp) :: q(size(self%q)), v(size(self%q)), start, low, high, middle
        integer :: k, count

        start = self%t
        count = method%points_a_step
        do k = 1, count
            high = merge(t, start + k*(t - start)/count, k == count)
            call method%state_at(high, q, v)
            if (self%v(self%coordinate) < 0.0_dp .and. v(self%coordinate) >= 0.0_dp) then
                low = self%t
                middle = high
                do
                    middle = low + 0.5_dp*(high - low)
                    if (middle <= low .or. middle >= high) exit
                    call method%state_at(middle, q, v)
                    if (v(self%coordinate) < 0.0_dp) then
                        low = middle
                    else
                        high = middle
                    end if
                end do
                call turn(self, high)
                high = merge(t, start + k*(t - start)/count, k == count)
                call method%state_at(high, q, v)
            end if
            call stand(self, high, q, v)
        end do
    end subroutine follow_inside

    pure function period(self) result(value)
        !! The `mean`, s, where it is a period, that is, where all intervals between lower turning
        !! points are as long to 1/100: not of a motion that beats, dies or never repeats. Else 0.
        class(period_t), intent(in) :: self
        real(dp) :: value
        real(dp), parameter :: same = 1e-2_dp

        value = 0.0_dp
        if (self%longest - self%shortest <= same*self%longest) value = self%mean()
    end function period

    pure function mean(self) result(value)
        !! The mean time between lower turning points, s; 0 where fewer than two were met, or where
        !! the steps are too long to tell (a time from too few of them would be a fiction).
        class(period_t), intent(in) :: self
        real(dp) :: value

        value = 0.0_dp
        if (self%turns > 1 .and. self%resolved) value = (self%last - self%first)/(self%turns - 1)
    end function mean

    pure function accounts(h, v0, a0, v1, a1) result(yes)
        !! Whether the accelerations at both ends account for the change of the velocity.
        real(dp), intent(in) :: h, v0, a0, v1, a1
        logical :: yes

        yes = abs(v1 - v0 - 0.5_dp*h*(a0 + a1)) <= &
              0.1_dp*(abs(v0) + abs(v1) + h*(abs(a0) + abs(a1)))
    end function accounts

    pure function turning_time(t0, q0, v0, a0, t1, q1, v1, a1) result(t)
        !! Where the derivative of the quintic Hermite interpolant vanishes, by bisection.
        real(dp), intent(in) :: t0, q0, v0, a0, t1, q1, v1, a1
        real(dp) :: t, h, c(0:5), low, high, s
        integer :: i

        h = t1 - t0
        c = quintic(h, [q0, v0, a0], [q1, v1, a1])
        low = 0.0_dp
        high = 1.0_dp
        do i = 1, 60
            s = 0.5_dp*(low + high)
            if (c(1) + s*(2.0_dp*c(2) + s*(3.0_dp*c(3) + s*(4.0_dp*c(4) + s*5.0_dp*c(5)))) &
                < 0.0_dp) then
                low = s
            else
                high = s
            end if
        end do
        t = t0 + s*h
    end function turning_time
end module lagrangia_period
