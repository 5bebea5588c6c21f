module lagrangia_gauss_adaptive
    !! Gauss-Legendre collocation, order 16, by tolerance: fast for smooth forces.
    !!
    !! - *Error.* See `lagrangia_gauss_control`. Over a kink or a jump of the force, which the dense
    !!   output sees (`lagrangia_gauss_dense`; not without it), steps are halved many times.
    !! - *Iteration.* Sweeps end where what they would still change is a tenth of the tolerance.
    !! - *Steps* are as long as the error allows, but not so long that sweeps would converge
    !!   slowly: a sweep wins a factor of about \((h/h_0)^2\), and \((1/h)/\log(h_0/h)\) sweeps a
    !!   second are fewest where that factor is \(e^{-2}\). Where sweeps diverge the step is halved.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_quiet_nan, ieee_value
    use lagrangia_brief_force_search, only: find_brief_forces, find_place_functions
    use lagrangia_errors, only: error_t, fail, status_numbers
    use lagrangia_gauss_control, only: longer, seen_whole, weigh
    use lagrangia_gauss_dense, only: gauss_dense_t
    use lagrangia_gauss_stages, only: gauss_stages_t, known, modes
    use lagrangia_gauss_tables, only: stages
    use lagrangia_integrator, only: dense_integrator_t, not_started
    use lagrangia_kinds, only: dp, i8
    use lagrangia_step_ends, only: end_step
    use lagrangia_system, only: system_t
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: gauss_adaptive_t, new_gauss16_adaptive

    integer, parameter :: most_sweeps = 25
    real(dp), parameter :: best_rate = exp(-4.0_dp)  !! of a sweep, squared
    real(dp), parameter :: least_rate = 1e-4_dp      !! to expect of a step's first sweep, squared
    real(dp), parameter :: noise = (64.0_dp*epsilon(1.0_dp))**2  !! of accelerations, squared
    real(dp), parameter :: share = 0.1_dp  !! of the tolerance that the iteration may leave
    real(dp), parameter :: safety = 0.75_dp    !! of a step: rejected ones cost more than short ones
    real(dp), parameter :: try_again = 0.9_dp  !! of a rejected one, whose polynomial is known

    type, extends(dense_integrator_t) :: gauss_adaptive_t
        private
        type(gauss_stages_t) :: s
        type(gauss_dense_t) :: inside            !! the last step
        real(dp) :: h = 0.0_dp                   !! length to try next, s
        real(dp) :: rate = 1.0_dp                !! of the last sweep: change over change, squared
        real(dp) :: all_rates = 1.0_dp           !! change of the last sweep over the first's
        real(dp), allocatable :: weight(:)       !! 1/(wanted error of `f`), squared
        real(dp), allocatable :: first(:)        !! accelerations at the start of the step
    contains
        procedure :: prepare
        procedure :: start
        procedure :: advance
        procedure :: step
        procedure :: state_at
    end type gauss_adaptive_t

contains

    pure subroutine new_gauss16_adaptive(self)
        !! Any system will do.
        type(gauss_adaptive_t), intent(out) :: self  !! not yet prepared

        self%name = "gauss16"
        self%least_tolerance = 1e-14_dp
        self%noise_margin = 2.0_dp**16
        self%title = "Gauss-Legendre collocation by tolerance, for smooth forces (Butcher 1964)"
        self%order = 16
        self%leaves_cyclic = .true.
    end subroutine new_gauss16_adaptive

    pure subroutine prepare(self, system, error)
        !! Refuses tolerances that rounding does not let it keep.
        class(gauss_adaptive_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        type(error_t), allocatable, intent(out) :: error

        if (.not. (self%tolerance >= self%least_tolerance .and. self%tolerance < 1.0_dp)) then
            call fail(error, to_text(self%tolerance)//" is not allowed: gauss16 keeps "// &
                      to_text(self%least_tolerance)//" and more, less than 1", key="tolerance")
            return
        end if
        call self%s%prepare(system%ndof)
        call self%inside%prepare(system%ndof)
        self%weight = self%s%v
        self%first = self%s%v
        self%coordinates = system%ndof
        self%evaluations = 0
        self%accepted = 0
        self%rejected = 0
        self%h = 0.0_dp
        self%failure_reason = not_started
    end subroutine prepare

    pure subroutine advance(self, system, t0, dt, first, steps, q, v)
        !! To `t0 + (first + steps)*dt`, in steps of its own: the first is as long as the last one
        !! let it expect. NaN where none is short enough, and backwards.
        class(gauss_adaptive_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t0, dt
        integer(i8), intent(in) :: first, steps
        real(dp), intent(inout) :: q(system%ndof), v(system%ndof)
        logical :: good, refused

        call self%refuse_system(system, refused, q, v)
        if (refused) return
        self%s%q(:) = q
        self%s%v(:) = v
        self%t_end = t0 + (first + steps)*dt
        good = self%t_end >= self%t_new .and. self%h > 0.0_dp
        do while (self%t_new < self%t_end .and. good)
            call take_whole_step(self, system, good)
        end do
        q = self%s%q
        v = self%s%v
        if (.not. good) v = ieee_value(1.0_dp, ieee_quiet_nan)
    end subroutine advance

    pure subroutine start(self, system, t0, q, v, t_end)
        !! See `dense_integrator_t`. The first step moves the state by about a third of 1, or of
        !! itself.
        class(gauss_adaptive_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t0
        real(dp), intent(in) :: q(system%ndof), v(system%ndof)
        real(dp), intent(in), optional :: t_end
        real(dp) :: speed, ahead
        logical :: refused

        call self%refuse_system(system, refused)
        if (refused) return
        call self%s%place(system, t0, q, v)
        call self%inside%keep(t0, q, v)
        self%evaluations = self%evaluations + 1
        call self%stand(t0, t_end)
        call find_brief_forces(system, t0, self%t_end, self%brief)
        call find_place_functions(system, self%places)
        self%rate = best_rate
        speed = maxval(abs(v)/max(1.0_dp, abs(q))) &
                + maxval(abs(self%s%start)/max(1.0_dp, abs(v)))
        ahead = min(self%t_end - t0, sqrt(huge(t0)))  ! its product with a speed is a number
        self%h = ahead/max(1.0_dp, 3.0_dp*speed*ahead)
    end subroutine start

    pure subroutine step(self, system, error)
        !! See `dense_integrator_t`.
        class(gauss_adaptive_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        type(error_t), allocatable, intent(out) :: error
        logical :: good, refused

        call self%refuse_system(system, refused, error=error)
        if (refused) return
        call take_whole_step(self, system, good)
        if (good) return
        if (self%failure_reason /= "") then
            call fail(error, "no step goes on from t = "//to_text(self%t_new)//" s: "// &
                      trim(self%failure_reason), status_numbers)
        else
            call fail(error, "no step is small enough at t = "//to_text(self%t_new)// &
                      " s: the motion diverges or is not smooth there (try dop853)", status_numbers)
        end if
    end subroutine step

    pure subroutine take_whole_step(self, system, good)
        !! One accepted step that went over nothing between its nodes, or none: then `good` is
        !! false. Where only the ends of steps are asked for, any accepted step.
        type(gauss_adaptive_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        logical, intent(out) :: good

        do
            call self%inside%keep(self%t_new, self%s%q, self%s%v)
            self%first(:) = self%s%start
            call take_step(self, system, good)
            if (.not. good) return
            if (.not. self%dense) call self%inside%keep(self%t_new, self%s%q, self%s%v)
            if (.not. self%dense) return
            call self%inside%fit(system, self%t_new, self%s%q, self%s%v, &
                                 self%s%room(self%s%first, known), self%first, self%s%start, &
                                 self%weight, good)
            self%evaluations = self%evaluations + 2*stages*self%inside%sweeps
            if (good) call self%inside%check_smooth(system, self%tolerance, self%first, &
                                                    self%s%start, self%evaluations, good)
            if (good) return
            call take_back(self, system)
        end do
    end subroutine take_whole_step

    pure subroutine take_back(self, system)
        !! Undo a step that went over something between its nodes; the next one is half as long.
        type(gauss_adaptive_t), intent(inout) :: self
        class(system_t), intent(in) :: system

        self%h = 0.5_dp*(self%t_new - self%t_old)
        self%t_new = self%t_old
        self%accepted = self%accepted - 1
        self%rejected = self%rejected + 1
        call self%s%place(system, self%t_old, self%inside%q_old, self%inside%v_old)
        self%evaluations = self%evaluations + 1
        self%rate = best_rate
    end subroutine take_back

    pure subroutine take_step(self, system, good)
        !! One accepted step from the state that `inside` keeps, or none: then `good` is false.
        class(gauss_adaptive_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        logical, intent(out) :: good
        real(dp) :: h, to, ratio, grow
        integer :: sweeps
        logical :: cut, over

        do
            to = next_time(self%t_new, min(self%h, self%longest, &
                           self%brief%longest_step(self%t_new)), self%t_end)
            h = to - self%t_new
            good = self%t_new + 0.25_dp*h > self%t_new
            if (.not. good) return
            call self%s%guess(self%t_new, h)
            call self%s%fly_free()
            call solve(self, system, sweeps, ratio, good)
            self%evaluations = self%evaluations + stages*min(sweeps, most_sweeps)
            if (good) then
                call self%s%expand()
                call self%s%reach(fully=.false.)
                call self%s%look_ahead(system)
                self%evaluations = self%evaluations + 1
                good = seen_whole(self%s%n, self%s%room(self%s%first, modes), self%weight, &
                                  self%s%start, self%s%end)
                if (good .and. self%places%count > 0) then
                    call self%places%try_step(self%t_new, self%s%q, self%s%v, to, &
                                              self%s%q_end, self%s%v_end, over)
                    good = .not. over
                end if
                if (good) exit
                ratio = 0.5_dp
            end if
            self%rejected = self%rejected + 1
            if (ratio < 1.0_dp) then
                ! rounding of times must not give the same step again
                self%h = min(h*max(0.2_dp, try_again*ratio), h - spacing(to))
                call self%s%shorten()
            else
                self%h = 0.5_dp*h
                call self%s%forget(system, self%t_new)
                self%evaluations = self%evaluations + 1
            end if
        end do
        call self%s%finish()
        if (system%is_projected) then
            call end_step(system, self%t_new, self%inside%q_old, self%inside%v_old, to, &
                          self%s%q, self%s%v, self%failure_reason)
            good = all(ieee_is_finite(self%s%q))
            if (.not. good) then
                call self%s%place(system, self%t_new, self%inside%q_old, self%inside%v_old)
                self%evaluations = self%evaluations + 1
                return
            end if
            call system%accelerations(to, self%s%q, self%s%v, self%s%end)
            self%evaluations = self%evaluations + 1
        end if
        self%s%start(:) = self%s%end
        self%accepted = self%accepted + 1
        cut = h < 0.99_dp*self%h
        self%t_old = self%t_new
        self%t_new = to
        grow = min(2.0_dp, safety*ratio)
        if (self%all_rates*(grow**4/best_rate)**(sweeps - 1) > 1.0_dp) then
            grow = (best_rate/self%all_rates**(1.0_dp/(sweeps - 1)))**0.25_dp
        end if
        self%h = merge(max(self%h, grow*h), grow*h, cut)
    end subroutine take_step

    pure function next_time(t, h, t_end) result(to)
        !! `t + h`, or less: the end is reached in two steps of one length rather than by a long
        !! and a short one.
        real(dp), intent(in) :: t, h, t_end
        real(dp) :: to

        if (t_end - t <= 1.01_dp*h) then
            to = t_end
        else if (t_end - t < 2.0_dp*h) then
            to = t + 0.5_dp*(t_end - t)
        else
            to = t + h
        end if
    end function next_time

    pure subroutine solve(self, system, sweeps, ratio, good)
        !! Sweep until what is left changes the end of the step by less than a share of the
        !! tolerance. Half-way there the error of the step can be told; `good` is false if it is
        !! too large, or if the sweeps diverge.
        type(gauss_adaptive_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        integer, intent(out) :: sweeps
        real(dp), intent(out) :: ratio  !! by which the step could be longer; 1 if not known
        logical, intent(out) :: good
        real(dp) :: change, all, first, last
        logical :: told

        call weigh(self%s%n, self%s%h, self%tolerance, self%s%q, self%s%v, self%weight)
        self%rate = min(0.25_dp, max(least_rate, self%rate*(self%s%h/self%s%h_known)**4))
        ratio = 1.0_dp
        told = .false.
        all = 0.0_dp
        first = 1.0_dp
        last = 1.0_dp
        do sweeps = 1, most_sweeps
            call self%s%sweep(system, exact=.false.)
            change = self%s%change(self%weight)
            if (sweeps == 1 .or. change <= noise*all) all = self%s%all_of(self%weight)
            good = .false.
            if (.not. change < huge(1.0_dp)) exit
            if (sweeps == 1) then
                first = change
            else
                self%rate = change/last
            end if
            last = max(change, tiny(1.0_dp))
            good = change*self%rate <= (share*(1.0_dp - self%rate))**2 .or. change <= noise*all
            if (.not. told .and. (good .or. (change**5 < all**3 .and. self%rate < 1.0_dp))) then
                told = .true.
                call self%s%expand()
                ratio = longer(self%s%n, self%s%room(self%s%first, modes), self%weight)
            end if
            good = good .and. ratio >= 1.0_dp
            if (ratio < 1.0_dp) exit
            if (good .or. (sweeps > 4 .and. self%rate > 0.64_dp)) exit
        end do
        self%all_rates = change/max(first, tiny(first))
    end subroutine solve

    pure subroutine state_at(self, t, q, v)
        !! See `dense_integrator_t`; of steps by `step`.
        class(gauss_adaptive_t), intent(in) :: self
        real(dp), intent(in) :: t
        real(dp), intent(out) :: q(:), v(:)

        if (self%coordinates /= size(q)) then
            q = ieee_value(q, ieee_quiet_nan)
            v = q
            return
        end if
        call self%inside%at(t, q, v)
    end subroutine state_at
end module lagrangia_gauss_adaptive
