module lagrangia_gauss
    !! Gauss-Legendre collocation with a fixed step: order 16, symplectic, symmetric.
    !!
    !! The equations of a step are solved until sweeps change nothing but the last digits. See
    !! `lagrangia_gauss_tables` and `lagrangia_gauss_stages`. Source: Hairer, Lubich & Wanner,
    !! *Geometric Numerical Integration*, 2nd ed., secs. II.1.3, VIII.5 and VIII.6.
    use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
    use lagrangia_errors, only: error_t
    use lagrangia_gauss_stages, only: f, f_old, gauss_stages_t
    use lagrangia_gauss_tables, only: stages
    use lagrangia_integrator, only: integrator_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_step_ends, only: end_step
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: gauss_t, new_gauss16

    integer, parameter :: most_sweeps = 200
    real(dp), parameter :: noise = 4.0_dp*epsilon(1.0_dp)          !! of accelerations, relative
    real(dp), parameter :: may_stay = epsilon(1.0_dp)*2.0_dp**(-10)  !! of their error, relative

    type, extends(integrator_t) :: gauss_t
        private
        type(gauss_stages_t) :: s
        real(dp), allocatable :: q_old(:), v_old(:)  !! state before a step with constraints
        real(dp), allocatable :: weight(:)  !! 1/(accelerations that matter), squared
        integer :: unmeasured = 0          !! first sweeps of the next step, whose changes are large
    contains
        procedure :: prepare
        procedure :: start
        procedure :: advance
    end type gauss_t

contains

    pure subroutine new_gauss16(self)
        !! Any system will do.
        type(gauss_t), intent(out) :: self  !! not yet prepared

        self%name = "gauss16"
        self%title = "Gauss-Legendre collocation, 8 stages in vector lanes (Butcher 1964)"
        self%order = 16
        self%energy_order = 16
        self%reversible = .true.
        self%leaves_cyclic = .true.
    end subroutine new_gauss16

    pure subroutine prepare(self, system, error)
        !! Never fails.
        class(gauss_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        type(error_t), allocatable, intent(out) :: error

        call self%s%prepare(system%ndof)
        self%weight = self%s%v
        self%q_old = self%s%v
        self%v_old = self%s%v
        self%unmeasured = 0
        self%coordinates = system%ndof
        self%evaluations = 0
    end subroutine prepare

    pure subroutine start(self, system, t0, q, v, t_end)
        !! See `integrator_t`. One evaluation, from which the first step guesses its stages.
        class(gauss_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t0
        real(dp), intent(in) :: q(system%ndof), v(system%ndof)
        real(dp), intent(in), optional :: t_end
        logical :: refused

        call self%refuse_system(system, refused)
        if (refused) return
        self%failure_reason = ""
        call self%s%place(system, t0, q, v)
        self%unmeasured = 0
        self%evaluations = self%evaluations + 1
    end subroutine start

    pure subroutine advance(self, system, t0, dt, first, steps, q, v)
        !! See `integrator_t`. Kept from step to step: what rounding took from the state, and the
        !! polynomial of the last step. Where the iteration fails the state is NaN.
        class(gauss_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t0, dt
        integer(i8), intent(in) :: first, steps
        real(dp), intent(inout) :: q(system%ndof), v(system%ndof)
        integer(i8) :: k
        integer :: sweeps
        logical :: good
        logical :: refused

        call self%refuse_system(system, refused, q, v)
        if (refused) return
        self%s%q(:) = q
        self%s%v(:) = v
        do k = first, first + steps - 1
            if (system%is_projected) then
                self%q_old(:) = self%s%q
                self%v_old(:) = self%s%v
            end if
            call self%s%guess(t0 + k*dt, dt)
            call solve(self%s, system, self%unmeasured, self%weight, sweeps, good)
            self%evaluations = self%evaluations + stages*min(sweeps, most_sweeps)
            self%unmeasured = max(0, min(sweeps - 5, sweeps/2))
            if (.not. good) self%s%room(:, f) = ieee_value(1.0_dp, ieee_quiet_nan)
            call self%s%expand()
            call self%s%reach(fully=.true.)
            call self%s%finish()
            if (.not. good) exit
            if (system%is_projected) call end_step(system, t0 + k*dt, self%q_old, self%v_old, &
                                                   t0 + (k + 1)*dt, self%s%q, self%s%v, &
                                                   self%failure_reason)
        end do
        q = self%s%q
        v = self%s%v
    end subroutine advance

    pure subroutine solve(s, system, unmeasured, weight, sweeps, good)
        !! Sweep until the next sweep, which is exact and the last, leaves a relative error
        !! \(e \le 2^{-10}\epsilon\): in \(N = 2^{20}\) steps such errors, of random signs, add up
        !! to \(\sqrt N e \le \epsilon\). With \(\delta_k\) the change by sweep \(k\) and
        !! \(\rho_k = \delta_k/\delta_{k-1}\), sweep \(k\) leaves about
        !! \(e_k = \delta_k\max(\rho_k, \rho_{k-1})\), and the next one that maximum of it. Changes
        !! below the noise of the accelerations tell no ratio: there the last one holds on.
        !!
        !! Where noise hides the convergence, sweep until in a tenth of all sweeps no change was
        !! smaller than the least before: slow convergence pauses longer.
        type(gauss_stages_t), intent(inout) :: s
        class(system_t), intent(in) :: system
        integer, intent(in) :: unmeasured       !! sweeps before changes are worth measuring
        real(dp), intent(inout) :: weight(s%n)
        integer, intent(out) :: sweeps
        logical, intent(out) :: good
        real(dp) :: change, all, before, least, rate, worst, left
        integer :: idle

        call s%fly_free()
        do sweeps = 1, unmeasured
            call s%sweep(system, exact=.false.)
        end do
        call s%sweep(system, exact=.true.)
        call weigh(s%n, s%h, s%v, s%room(s%first, f), weight)
        all = s%all_of(weight)
        change = s%change(weight)
        least = change
        rate = 0.0_dp
        worst = 1.0_dp
        left = 1.0_dp
        idle = 0
        do sweeps = unmeasured + 2, most_sweeps
            before = max(change, tiny(change))
            call s%sweep(system, exact=.false.)
            change = s%change(weight)
            good = change < huge(change)
            if (.not. good) return
            if (change > noise**2*all .or. sweeps == unmeasured + 2) then
                worst = max(rate, change/before)
                rate = change/before
                left = change*worst
            else
                left = left*worst
            end if
            idle = idle + 1
            if (change < least) idle = 0
            least = min(change, least)
            good = left*worst <= may_stay**2
            if (idle > sweeps/10 .and. .not. good) good = settled(s)
            if (good) exit
        end do
        if (sweeps > most_sweeps) good = settled(s)
        if (.not. good) return
        sweeps = sweeps + 1
        call s%sweep(system, exact=.true.)
    end subroutine solve

    pure subroutine weigh(n, h, v, f, weight)
        !! Accelerations are measured by the larger of \(|v|/h\) and their root mean square; but of
        !! a coordinate that hardly moves by \(2^{-20}\) of the largest of these measures.
        integer, intent(in) :: n
        real(dp), intent(in) :: h, v(n), f(stages, n)
        real(dp), intent(out) :: weight(n)
        real(dp) :: floor
        integer :: d

        do d = 1, n
            weight(d) = max((v(d)/h)**2, sum(f(:, d)**2)/stages)
        end do
        floor = max(2.0_dp**12*epsilon(floor)*maxval(weight), tiny(floor))
        do d = 1, n
            weight(d) = 1.0_dp/max(weight(d), floor)
        end do
    end subroutine weigh

    pure function settled(s)
        !! The last sweep changed \(v\) by less than \(2^{-36}\) of it, or of its change over the
        !! step, or \(q\) by less than that part of it.
        type(gauss_stages_t), intent(in) :: s
        logical :: settled
        real(dp), parameter :: small = 2.0_dp**16*epsilon(1.0_dp)
        real(dp) :: change, all
        integer :: d, i

        settled = .true.
        do d = 1, s%n
            i = s%first + (d - 1)*stages
            change = s%h**2*sum((s%room(i:i + stages - 1, f) - s%room(i:i + stages - 1, f_old))**2)
            all = s%h**2*sum(s%room(i:i + stages - 1, f)**2)
            settled = settled .and. (change <= small**2*max(s%v(d)**2, all) &
                                     .or. s%h**2*change <= small**2*s%q(d)**2)
        end do
    end function settled
end module lagrangia_gauss
