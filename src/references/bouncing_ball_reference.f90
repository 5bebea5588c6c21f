submodule (lagrangia_bouncing_ball) lagrangia_bouncing_ball_reference
    !! The bouncing ball in closed form: flights between impacts at
    !! $$ t_n = t_1 + \frac{2 e v_1}{g}\,\frac{1 - e^{n-1}}{1 - e} $$
    !! where \(v_1\) is the speed of the first impact, at \(t_1\); each flight starts with
    !! \(e^n v_1\). At \(t_\infty\) the ball comes to rest. At an impact the velocity is that after
    !! it.
    use lagrangia_kinds, only: dp
    use lagrangia_reference, only: reference_t
    implicit none (type, external)

    type, extends(reference_t) :: bouncing_ball_reference_t
        real(dp) :: t0 = 0.0_dp, y0 = 0.0_dp, v0 = 0.0_dp
        real(dp) :: g = 0.0_dp
        real(dp) :: e = 0.0_dp             !! restitution
        real(dp) :: t1 = 0.0_dp            !! of the first impact, after the start, s
        real(dp) :: v1 = 0.0_dp            !! its speed, m/s
        logical :: impacts = .false.       !! there is a first impact
    contains
        procedure :: state_at
        procedure :: rest_time
    end type bouncing_ball_reference_t

contains

    module subroutine closed_form(self, t0, q0, v0, reference)
        !! See `system_t` and `set_motion`.
        class(bouncing_ball_t), intent(in) :: self
        real(dp), intent(in) :: t0, q0(:), v0(:)
        class(reference_t), allocatable, intent(out) :: reference
        type(bouncing_ball_reference_t) :: motion
        logical :: found

        call set_motion(motion, self, t0, q0, v0, found)
        if (found) allocate (reference, source=motion)
    end subroutine closed_form

    pure subroutine set_motion(self, system, t0, q0, v0, found)
        !! Covers every initial state at or above the floor.
        type(bouncing_ball_reference_t), intent(out) :: self
        class(bouncing_ball_t), intent(in) :: system
        real(dp), intent(in) :: t0, q0(:), v0(:)
        logical, intent(out) :: found

        found = q0(1) >= 0.0_dp
        if (.not. found) return
        self%title = "flights between impacts: parabolas, a geometric series of times"
        self%ndof = 1
        self%t0 = t0
        self%y0 = q0(1)
        self%v0 = v0(1)
        self%g = system%g
        self%e = system%restitution
        self%v1 = sqrt(self%v0**2 + 2.0_dp*self%g*self%y0)
        self%impacts = self%v1 > 0.0_dp .and. (self%g > 0.0_dp .or. self%v0 < 0.0_dp)
        if (.not. self%impacts) return
        if (self%v0 < 0.0_dp) then
            self%t1 = 2.0_dp*self%y0/(self%v1 - self%v0)
        else
            self%t1 = (self%v0 + self%v1)/self%g
        end if
    end subroutine set_motion

    pure function rest_time(self) result(t)
        !! \(t_\infty\), s; huge where the ball never rests.
        class(bouncing_ball_reference_t), intent(in) :: self
        real(dp) :: t

        t = huge(t)
        if (self%impacts .and. self%e < 1.0_dp .and. self%g > 0.0_dp) t = self%t0 + self%t1 &
            + 2.0_dp*self%e*self%v1/(self%g*(1.0_dp - self%e))
        if (.not. self%impacts .and. self%y0 <= 0.0_dp .and. abs(self%v0) <= 0.0_dp) t = self%t0
    end function rest_time

    pure function series(e, n) result(s)
        !! \((1 - e^n)/(1 - e)\).
        real(dp), intent(in) :: e, n
        real(dp) :: s

        s = n
        if (e < 1.0_dp) s = (1.0_dp - e**n)/(1.0_dp - e)
    end function series

    pure subroutine state_at(self, t, q, v)
        !! Flight \(n\) begins at the impact \(n\).
        class(bouncing_ball_reference_t), intent(in) :: self
        real(dp), intent(in) :: t
        real(dp), intent(out) :: q(self%ndof), v(self%ndof)
        real(dp) :: s, n, first, share

        s = t - self%t0
        q = self%y0
        v = self%v0
        if (.not. self%impacts .or. s < self%t1) then
            if (.not. self%impacts .and. self%y0 <= 0.0_dp .and. self%v0 <= 0.0_dp) return
            q = self%y0 + s*(self%v0 - 0.5_dp*s*self%g)
            v = self%v0 - s*self%g
            return
        end if
        s = s - self%t1
        if (self%g <= 0.0_dp) then
            q = self%e*self%v1*s
            v = self%e*self%v1
            return
        end if
        q = 0.0_dp
        v = 0.0_dp
        if (t >= self%rest_time()) return
        first = 2.0_dp*self%e*self%v1/self%g
        if (self%e < 1.0_dp) then
            share = 1.0_dp - s/first*(1.0_dp - self%e)
            if (share <= 0.0_dp) return
            n = aint(log(share)/log(self%e))
        else
            n = aint(s/first)
        end if
        if (s < first*series(self%e, n)) n = n - 1.0_dp
        if (s >= first*series(self%e, n + 1.0_dp)) n = n + 1.0_dp
        s = s - first*series(self%e, n)
        v = self%e**(n + 1.0_dp)*self%v1
        q = max(0.0_dp, s*(v - 0.5_dp*s*self%g))
        v = v - s*self%g
    end subroutine state_at
end submodule lagrangia_bouncing_ball_reference
