module lagrangia_dop853
    !! The explicit Runge-Kutta method of order 8(5,3) of Dormand and Prince: adaptive, with dense
    !! output of order 7, for any system.
    !!
    !! Source: Hairer, Nørsett & Wanner, *Solving Ordinary Differential Equations I*, 2nd ed.:
    !! secs. II.4 (starting step, PI step control), II.6 (dense output), II.10 (error estimate).
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_quiet_nan, ieee_value
    use lagrangia_brief_force_search, only: find_brief_forces, find_place_functions
    use lagrangia_dop853_control, only: first_step, least_error, next_step, twice_too_long
    use lagrangia_dop853_stages, only: extra_stages, inside_step, scaled_error, slope, stages
    use lagrangia_errors, only: error_t, fail, status_numbers
    use lagrangia_integrator, only: dense_integrator_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_step_ends, only: end_step
    use lagrangia_system, only: system_t
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: dop853_t, new_dop853

    type, extends(dense_integrator_t) :: dop853_t
        private
        real(dp) :: h = 0.0_dp                 !! step to try next, s
        real(dp) :: last_error = least_error   !! of the latest accepted step, see `next_steps`
        real(dp), allocatable :: y(:), y0(:)   !! states (q, v) at the ends of the step
        real(dp), allocatable :: work(:)
        real(dp), allocatable :: k(:, :)       !! its slopes at the stages
        real(dp), allocatable :: inside(:, :)  !! coefficients of the dense output
    contains
        procedure :: prepare
        procedure :: start
        procedure :: advance
        procedure :: step
        procedure :: state_at
    end type dop853_t

contains

    pure subroutine new_dop853(self)
        !! Any system will do.
        type(dop853_t), intent(out) :: self  !! not yet prepared

        self%name = "dop853"
        self%title = "explicit Runge-Kutta, order 8(5,3), any system (Dormand & Prince 1989)"
        self%order = 8
        self%leaves_cyclic = .true.
    end subroutine new_dop853

    pure subroutine prepare(self, system, error)
        !! Never fails.
        class(dop853_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        type(error_t), allocatable, intent(out) :: error
        real(dp) :: slopes(2*system%ndof, 17)

        slopes = 0.0_dp
        self%y = slopes(:, 1)
        self%y0 = slopes(:, 1)
        self%work = slopes(:, 1)
        self%k = slopes
        self%inside = transpose(slopes(:, :7))
        self%coordinates = system%ndof
        self%evaluations = 0
        self%accepted = 0
        self%rejected = 0
    end subroutine prepare

    pure subroutine advance(self, system, t0, dt, first, steps, q, v)
        !! See `integrator_t`: steps of fixed length, with the solution of order 8.
        class(dop853_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t0, dt
        integer(i8), intent(in) :: first, steps
        real(dp), intent(inout) :: q(system%ndof), v(system%ndof)
        integer(i8) :: i
        logical :: refused

        call self%refuse_system(system, refused, q, v)
        if (refused) return
        self%y(:system%ndof) = q
        self%y(system%ndof + 1:) = v
        do i = first, first + steps - 1
            self%y0 = self%y
            call slope(system, system%ndof, t0 + i*dt, self%y0, self%k(:, 1))
            call stages(system, system%ndof, t0 + i*dt, dt, self%y0, self%k, self%y)
            call keep(self, system, t0 + i*dt, t0 + (i + 1)*dt)
        end do
        self%evaluations = self%evaluations + 12*steps
        q = self%y(:system%ndof)
        v = self%y(system%ndof + 1:)
    end subroutine advance

    pure subroutine start(self, system, t0, q, v, t_end)
        !! See `dense_integrator_t`. Two evaluations.
        class(dop853_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t0
        real(dp), intent(in) :: q(system%ndof), v(system%ndof)
        real(dp), intent(in), optional :: t_end
        logical :: refused

        call self%refuse_system(system, refused)
        if (refused) return
        call self%stand(t0, t_end)
        call find_brief_forces(system, t0, self%t_end, self%brief)
        call find_place_functions(system, self%places)
        self%last_error = least_error
        self%y(:system%ndof) = q
        self%y(system%ndof + 1:) = v
        self%y0 = self%y
        self%inside = 0.0_dp
        call slope(system, system%ndof, t0, self%y, self%k(:, 1))
        call first_step(system, system%ndof, self%tolerance, t0, self%t_end, self%y, self%k(:, 1), &
                        self%h)
        self%evaluations = self%evaluations + 2
    end subroutine start

    pure subroutine step(self, system, error)
        !! See `dense_integrator_t`. Eleven evaluations for the step, one for the slope at its end,
        !! which is the next one's first stage, and three for its dense output if that is wanted.
        class(dop853_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        type(error_t), allocatable, intent(out) :: error
        real(dp) :: h, next, scaled
        logical :: cut, last, over, retry, refused

        call self%refuse_system(system, refused, error=error)
        if (refused) return
        self%y0 = self%y
        self%t_old = self%t_new
        retry = .false.
        do
            h = self%brief%longest_step(self%t_old)
            cut = h < min(self%h, self%longest)
            h = min(h, self%h, self%longest)
            last = self%t_old + 1.01_dp*h >= self%t_end
            if (last) h = self%t_end - self%t_old
            h = (self%t_old + h) - self%t_old  ! what the clock will say
            if (.not. self%t_old + 0.1_dp*h > self%t_old) exit
            call stages(system, system%ndof, self%t_old, h, self%y0, self%k, self%y)
            self%evaluations = self%evaluations + 11
            scaled = scaled_error(h, self%tolerance, self%k, self%y0, self%y)
            if (self%places%count > 0 .and. scaled <= 1.0_dp) then
                associate (n => system%ndof)
                    call self%places%try_step(self%t_old, self%y0(:n), self%y0(n + 1:), &
                                              self%t_old + h, self%y(:n), self%y(n + 1:), over)
                end associate
                if (over) scaled = twice_too_long
            end if
            call next_step(h, scaled, self%last_error, next)
            if (retry) next = min(next, self%h)
            if (cut .and. scaled <= 1.0_dp) next = max(next, self%h)
            self%h = next
            if (scaled <= 1.0_dp) then
                call keep(self, system, self%t_old, self%t_old + h)
                if (.not. all(ieee_is_finite(self%y))) exit
                self%accepted = self%accepted + 1
                call finish(self, system, h)
                self%t_new = self%t_old + h
                if (last) self%t_new = self%t_end
                return
            end if
            self%rejected = self%rejected + 1
            retry = .true.
        end do
        self%y = self%y0
        self%t_new = self%t_old
        if (self%failure_reason /= "") then
            call fail(error, "no step goes on from t = "//to_text(self%t_old)//" s: "// &
                      trim(self%failure_reason), status_numbers)
            return
        end if
        call fail(error, "no step is small enough at t = "//to_text(self%t_old)//" s for the "// &
                  "tolerance "//to_text(self%tolerance)//": the motion is singular there or "// &
                  "grows beyond all numbers, or the tolerance is too small", status_numbers)
    end subroutine step

    pure subroutine keep(self, system, t_old, t)
        !! The end of a step back onto the constraints; NaN where they do not say how it goes on.
        class(dop853_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t_old, t

        if (.not. system%is_projected) return
        associate (n => system%ndof)
            call end_step(system, t_old, self%y0(:n), self%y0(n + 1:), t, self%y(:n), &
                          self%y(n + 1:), self%failure_reason)
        end associate
    end subroutine keep

    pure subroutine finish(self, system, h)
        !! The slope at the end of an accepted step, and the coefficients of its dense output, if
        !! wanted.
        class(dop853_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: h

        if (self%dense) then
            call extra_stages(system, system%ndof, self%t_old, h, self%y0, self%y, self%k, &
                              self%inside, self%work)
            self%evaluations = self%evaluations + 4
        else
            call slope(system, system%ndof, self%t_old + h, self%y, self%k(:, 17))
            self%evaluations = self%evaluations + 1
        end if
        self%k(:, 1) = self%k(:, 17)
    end subroutine finish

    pure subroutine state_at(self, t, q, v)
        !! See `dense_integrator_t`.
        class(dop853_t), intent(in) :: self
        real(dp), intent(in) :: t
        real(dp), intent(out) :: q(:), v(:)
        real(dp) :: y(2*size(q))
        integer :: n

        if (self%coordinates /= size(q)) then
            q = ieee_value(q, ieee_quiet_nan)
            v = q
            return
        end if
        n = size(q)
        if (t >= self%t_new) then
            q = self%y(:n)
            v = self%y(n + 1:)
            return
        end if
        call inside_step((t - self%t_old)/(self%t_new - self%t_old), self%y0, self%inside, y)
        q = y(:n)
        v = y(n + 1:)
    end subroutine state_at
end module lagrangia_dop853
