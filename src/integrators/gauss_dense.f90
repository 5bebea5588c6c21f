module lagrangia_gauss_dense
    !! The solution inside a step of Gauss-Legendre collocation, to the accuracy of its ends.
    !!
    !! The collocation polynomial does not have it: with eight stages it is of order 9 inside the
    !! step, where the ends are of order 16. So it is only the start here: it is bent, by
    !! \(P_8(c_8 + c_9 y)\), into the accelerations at the ends, and the accelerations are evaluated
    !! along it at 16 Chebyshev points (two times eight lanes), integrated twice, and evaluated
    !! again until that would change less than the tolerance: once or twice. The series of the
    !! sixteen accelerations then gives the state anywhere, without evaluations.
    use lagrangia_chebyshev_tables, only: chebyshev_tables_t, points, terms
    use lagrangia_gauss_kernels, only: expand_both, fly, fly_by_guess, integrals, weighted_sum
    use lagrangia_gauss_stages, only: line_start
    use lagrangia_gauss_tables, only: nodes
    use lagrangia_kinds, only: dp, i8
    use lagrangia_system, only: lanes, system_t
    implicit none (type, external)
    private
    public :: gauss_dense_t

    integer, parameter :: most_sweeps = 10
    real(dp), parameter :: first_rate = 1.0_dp/80.0_dp  !! of the first sweep, to expect
    real(dp), parameter :: left = 2.0_dp     !! what a next sweep may still change, tolerances
    real(dp), parameter :: ulps = 4.0_dp*epsilon(1.0_dp)
    real(dp), parameter :: edge = 0.5_dp*(1.0_dp - cos(acos(-1.0_dp)/(2*points)))
    !! of a step, before its first point and behind its last
    real(dp), parameter :: top = 2.0_dp**29*40320.0_dp**4/(17.0_dp*20922789888000.0_dp**2)
    !! what the nodes miss of \(\int s\,T_{15}(2s)\): \(2^{29}\,8!^4/(17\cdot16!^2)\)

    integer, parameter :: f(2) = [1, 2]      !! accelerations at the points, two groups of lanes
    integer, parameter :: q = 3, v = 4       !! states at eight of the points

    type :: gauss_dense_t
        real(dp) :: t = 0.0_dp, t_new = 0.0_dp        !! start and end of the step, s
        real(dp) :: h = 1.0_dp                        !! its length, s
        real(dp), allocatable :: q_old(:), v_old(:)   !! state at its start
        real(dp), allocatable :: q_new(:), v_new(:)   !! and at its end
        integer :: sweeps = 0                         !! of the last `fit`, 16 evaluations each
        type(chebyshev_tables_t) :: table
        real(dp), allocatable :: room(:, :)           !! of the points: columns as below
        integer :: first = 1                          !! where they begin, as in `gauss_stages_t`
        real(dp), allocatable :: a(:, :)              !! Chebyshev coefficients of accelerations
        real(dp), allocatable :: a_old(:, :)          !! those before the last sweep
        real(dp), allocatable :: guess(:, :)          !! coefficients of the first guess
        real(dp), allocatable :: apart(:, :)  !! of both quadratures: velocity/h, coordinate/h**2
        real(dp), allocatable :: ends(:, :)   !! the series of the accelerations there
        real(dp), allocatable :: noise(:)     !! of accelerations, where it was looked for
    contains
        procedure :: prepare
        procedure :: keep
        procedure :: fit
        procedure :: check_smooth
        procedure :: at
    end type gauss_dense_t

contains

    pure subroutine prepare(self, n)
        !! Allocate.
        class(gauss_dense_t), intent(inout) :: self
        integer, intent(in) :: n  !! degrees of freedom
        real(dp) :: state(n), block(lanes, n)

        state = 0.0_dp
        block = 0.0_dp
        self%q_old = state
        self%v_old = state
        self%q_new = state
        self%v_new = state
        self%apart = block(:2, :)
        self%ends = block(:2, :)
        self%noise = state
        if (allocated(self%room)) deallocate (self%room, self%a, self%a_old, self%guess)
        allocate (self%a(points, n), self%a_old(points, n), self%guess(terms, n), &
                  self%room(lanes*(n + 1), v), source=0.0_dp)
        self%first = line_start(self%room(:, 1))
        if (.not. any(self%table%x > 0.0_dp)) call self%table%fill()  ! the same for any system
    end subroutine prepare

    pure subroutine keep(self, t, q, v)
        !! Remember the start of a step. Until `fit` nothing more is known.
        class(gauss_dense_t), intent(inout) :: self
        real(dp), intent(in) :: t           !! its time, s
        real(dp), intent(in) :: q(:), v(:)  !! coordinates and velocities there, `(n)`

        self%t = t
        self%t_new = t
        self%h = 0.0_dp
        self%q_old(:) = q
        self%v_old(:) = v
        self%q_new(:) = q
        self%v_new(:) = v
    end subroutine keep

    pure subroutine fit(self, system, t_new, q_new, v_new, modes, first, last, weight, good)
        !! Make the series of a step. Sweep \(k\) changes the accelerations by \(\delta_k\), root
        !! mean square in units of the tolerance; \(\delta_1\) is what they have beyond degree 9,
        !! which the guess has not. Such a change turns round ten times in the step: it moves the
        !! velocities by \(\delta_k/20\) and the coordinates by \(\delta_k/400\) or less, and these
        !! make the next change, for which \(\delta_1/80\) is expected. So the last sweep has
        !! \(\delta_{k+1} \le 2\), with \(\delta_{k+1} = \delta_k^2/\delta_{k-1}\) for \(k > 1\).
        class(gauss_dense_t), intent(inout) :: self
        class(system_t), intent(in) :: system                  !! the one of the step
        real(dp), intent(in) :: t_new                          !! its end, s
        real(dp), intent(in) :: q_new(system%ndof)             !! coordinates there
        real(dp), intent(in) :: v_new(system%ndof)             !! velocities there
        real(dp), intent(in) :: modes(lanes, system%ndof)      !! Legendre, of the accelerations
        real(dp), intent(in) :: first(system%ndof)             !! accelerations at its start
        real(dp), intent(in) :: last(system%ndof)              !! and at its end
        real(dp), intent(in) :: weight(system%ndof)            !! 1/(wanted error of them), squared
        logical, intent(out) :: good                           !! finite all along the step
        real(dp) :: change, before, rate
        integer :: sweep, group

        self%t_new = t_new
        self%h = t_new - self%t
        self%q_new(:) = q_new
        self%v_new(:) = v_new
        call bend(system%ndof, modes, first, last, self%guess)
        before = 0.0_dp
        rate = first_rate
        do sweep = 1, most_sweeps
            do group = 1, 2
                if (sweep == 1) then
                    call fly_by_guess(system%ndof, self%h, self%table%x(:, group), self%q_old, &
                                      self%v_old, self%table%guess_q(:, :, group), &
                                      self%table%guess_v(:, :, group), self%guess, &
                                      self%room(self%first, q), self%room(self%first, v))
                else
                    call fly_by_series(self, system, group)
                end if
                call evaluate(self, system, self%t + self%h*self%table%x(:, group), f(group))
            end do
            if (sweep > 1) self%a_old(:, :) = self%a
            call expand_both(system%ndof, self%table%series, self%room(self%first, f(1)), &
                             self%room(self%first, f(2)), self%a)
            change = changed(system%ndof, sweep, weight, self%a, self%a_old)
            self%sweeps = sweep
            good = change < huge(change)
            if (.not. good) return
            if (sweep > 1) rate = min(0.5_dp, change/before)
            if (change*rate <= left) exit
            before = change
        end do
        call lead_to_end(self, system%ndof)
    end subroutine fit

    pure subroutine bend(n, modes, first, last, guess)
        !! The polynomial through the accelerations at the nodes and at both ends of the step:
        !! \(P_8\) is zero at the nodes and 1 at the ends, where \(y = \pm1\).
        integer, intent(in) :: n
        real(dp), intent(in) :: modes(lanes, n), first(n), last(n)
        real(dp), intent(out) :: guess(terms, n)
        real(dp) :: even, odd, at_first, at_last
        integer :: d

        do d = 1, n
            even = (modes(1, d) + modes(3, d)) + (modes(5, d) + modes(7, d))
            odd = (modes(2, d) + modes(4, d)) + (modes(6, d) + modes(8, d))
            at_first = first(d) - (even - odd)
            at_last = last(d) - (even + odd)
            guess(:lanes, d) = modes(:, d)
            guess(lanes + 1, d) = 0.5_dp*(at_last + at_first)
            guess(lanes + 2, d) = 0.5_dp*(at_last - at_first)
        end do
    end subroutine bend

    pure function changed(n, sweep, weight, a, a_old) result(change)
        !! By the last sweep, root mean square at the points: that of \(T_k\) is \(1/\sqrt2\).
        integer, intent(in) :: n, sweep
        real(dp), intent(in) :: weight(n), a(points, n), a_old(points, n)
        real(dp) :: change
        integer :: d

        change = 0.0_dp
        do d = 1, n
            if (sweep == 1) then
                change = change + weight(d)*sum(a(terms + 1:, d)**2)
            else
                change = change + weight(d)*sum((a(:, d) - a_old(:, d))**2)
            end if
        end do
        change = sqrt(0.5_dp*change)
    end function changed

    pure subroutine fly_by_series(self, system, group)
        !! Where the motion with these accelerations is at eight of the points.
        type(gauss_dense_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        integer, intent(in) :: group

        call fly(system%ndof, self%h, self%table%x(:, group), self%q_old, self%v_old, &
                 self%table%q(:, :, group), self%table%v(:, :, group), self%a, &
                 self%room(self%first, q), self%room(self%first, v))
    end subroutine fly_by_series

    pure subroutine evaluate(self, system, times, column)
        !! The accelerations there, into a column of the room.
        type(gauss_dense_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: times(lanes)
        integer, intent(in) :: column

        call system%accelerations_lanes(times, self%room(self%first, q), &
                                        self%room(self%first, v), self%room(self%first, column))
    end subroutine evaluate

    pure subroutine lead_to_end(self, n)
        !! Add a straight line to the accelerations, so that they lead to the end of the step.
        type(gauss_dense_t), intent(inout) :: self
        integer, intent(in) :: n
        real(dp) :: difference(2), even, odd
        integer :: d

        do d = 1, n
            associate (a => self%a(:, d))
                difference(1) = (self%v_new(d) - self%v_old(d))/self%h &
                                - weighted_sum(self%table%v_end, a)
                difference(2) = ((self%q_new(d) - self%q_old(d))/self%h - self%v_old(d))/self%h &
                                - weighted_sum(self%table%q_end, a)
                even = ((a(1) + a(3)) + (a(5) + a(7))) + ((a(9) + a(11)) + (a(13) + a(15)))
                odd = ((a(2) + a(4)) + (a(6) + a(8))) + ((a(10) + a(12)) + (a(14) + a(16)))
                self%ends(:, d) = [even - odd, even + odd]
                self%apart(:, d) = abs(difference)
                a(1) = a(1) + difference(1)
                a(2) = a(2) + 3.0_dp*difference(1) - 6.0_dp*difference(2)
            end associate
        end do
    end subroutine lead_to_end

    pure subroutine check_smooth(self, system, tolerance, first, last, evaluations, smooth)
        !! Whether the step went over a kink or a jump of the force. The estimate of
        !! `lagrangia_gauss_control` takes the accelerations for smooth; the series, which `fit` has
        !! made, knows them at sixteen points of its own. Where the quadratures disagree, the noise
        !! of the accelerations is measured.
        class(gauss_dense_t), intent(inout) :: self
        class(system_t), intent(in) :: system          !! the one of the step
        real(dp), intent(in) :: tolerance              !! of the step's error
        real(dp), intent(in) :: first(:), last(:)      !! accelerations at its ends
        integer(i8), intent(inout) :: evaluations      !! counts on
        logical, intent(out) :: smooth                 !! the step went over nothing

        smooth = agrees(self, tolerance, first, last)
        if (smooth) return
        call measure_noise(self, system)
        evaluations = evaluations + 2*points
        smooth = agrees(self, tolerance, first, last)
    end subroutine check_smooth

    pure function agrees(self, tolerance, first, last) result(yes)
        !! With \(\Delta_v\) and \(\Delta_q\) the differences of two quadratures, by eight nodes
        !! and by sixteen points, over \(h\) and \(h^2\),
        !! $$ h\,(\Delta_v + o - n) \le 10\,\mathrm{tol}\,\max(1, |v|),\quad
        !!    h^2(\Delta_q + o - n) \le 10\,\mathrm{tol}\,\max(1, |q|), $$
        !! to 4 ulp of \(|v|\) and \(|q|\), where \(n\) is the noise of the accelerations. Behind a
        !! kink the \(\Delta\) may be small by chance: \(o\) is a fifth of the last two terms of
        !! the series, and what the accelerations at the ends, `first` and `last`, have beyond the
        !! series, times the share of the step between an end and the point next to it.
        type(gauss_dense_t), intent(in) :: self
        real(dp), intent(in) :: tolerance
        real(dp), intent(in) :: first(:), last(:)
        logical :: yes
        real(dp) :: apart(2), off, allowed
        integer :: d

        yes = .true.
        allowed = 10.0_dp*tolerance
        do d = 1, size(first)
            off = edge*(abs(first(d) - self%ends(1, d)) + abs(last(d) - self%ends(2, d))) &
                  + 0.2_dp*(abs(self%a(points - 1, d)) + abs(self%a(points, d))) - self%noise(d)
            apart = self%h*(self%apart(:, d) + off)
            yes = yes .and. apart(1) <= max(allowed, (allowed + ulps)*abs(self%v_new(d))) &
                  .and. self%h*apart(2) <= max(allowed, (allowed + ulps)*abs(self%q_new(d)))
        end do
    end function agrees

    pure subroutine measure_noise(self, system)
        !! Of accelerations: what four ulp of the time and the state at the points, up and down in
        !! turn, make of them, root mean square.
        class(gauss_dense_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        real(dp), parameter :: turn(lanes) = 1.0_dp + ulps*[1, -1, 1, -1, 1, -1, 1, -1]
        real(dp) :: times(lanes)
        integer :: d, group, i

        self%noise(:) = 0.0_dp
        do group = 1, 2
            times = self%t + self%h*self%table%x(:, group)
            call fly_by_series(self, system, group)
            call evaluate(self, system, times, f(1))
            do d = 0, system%ndof - 1
                i = self%first + d*lanes
                self%room(i:i + lanes - 1, q) = turn*self%room(i:i + lanes - 1, q)
                self%room(i:i + lanes - 1, v) = turn*self%room(i:i + lanes - 1, v)
            end do
            call evaluate(self, system, turn*times, f(2))
            do d = 1, system%ndof
                i = self%first + (d - 1)*lanes
                self%noise(d) = self%noise(d) + sum((self%room(i:i + lanes - 1, f(2)) &
                                                     - self%room(i:i + lanes - 1, f(1)))**2)
            end do
        end do
        self%noise(:) = sqrt(self%noise/points)
    end subroutine measure_noise

    pure subroutine at(self, t, q, v)
        !! The state at `t`; at the ends of the step, and beyond, the ends themselves. From the
        !! nearer end \(\tau\) away the eight nodes integrate the series of the accelerations:
        !! $$ v = v_e + \tau\sum_j b_j a_j,\quad
        !!    q = q_e + \tau\Big(v_e + \tau\sum_j b_j(1-c_j) a_j\Big) $$
        !! but for what that misses of the last term, which is of one degree too many for `q`. So
        !! a flight much shorter than the step has its digits, too.
        class(gauss_dense_t), intent(in) :: self
        real(dp), intent(in) :: t            !! s
        real(dp), intent(out) :: q(:), v(:)  !! coordinates and velocities, `(n)`
        real(dp) :: tau, part, missed, x(lanes), once, twice
        integer :: d
        logical :: early

        early = t - self%t < 0.5_dp*self%h
        do d = 1, size(q)
            q(d) = merge(self%q_old(d), self%q_new(d), early)
            v(d) = merge(self%v_old(d), self%v_new(d), early)
        end do
        if (t <= self%t .or. t >= self%t_new) return
        tau = t - merge(self%t, self%t_new, early)
        part = tau/self%h
        x = 2.0_dp*part*nodes + merge(-1.0_dp, 1.0_dp, early)
        missed = top*part**(points - 1)
        do d = 1, size(q)
            call integrals(self%a(:, d), x, once, twice)
            q(d) = q(d) + tau*(v(d) + tau*(twice - missed*self%a(points, d)))
            v(d) = v(d) + tau*once
        end do
    end subroutine at
end module lagrangia_gauss_dense
