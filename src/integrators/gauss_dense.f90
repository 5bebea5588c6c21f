module lagrangia_gauss_dense
    !! The solution inside a step of Gauss-Legendre collocation, to the accuracy of its ends.
    !!
    !! The collocation polynomial does not have it: with eight stages it is of order 9 inside the
    !! step, where the ends are of order 16. So it is only the start here: the accelerations are
    !! evaluated along it at 16 Chebyshev points (two times eight lanes), integrated twice, and
    !! that is repeated until it changes less than the tolerance, two or three times. The sixteen
    !! accelerations that are left then give the state anywhere, without evaluations.
    use lagrangia_chebyshev_tables, only: chebyshev_tables_t, points
    use lagrangia_gauss_kernels, only: apply, apply_both, distance, fly, fly_by_modes, &
                                       integrals
    use lagrangia_gauss_stages, only: line_start
    use lagrangia_gauss_tables, only: nodes
    use lagrangia_kinds, only: dp, i8
    use lagrangia_system, only: lanes, system_t
    implicit none (type, external)
    private
    public :: gauss_dense_t

    integer, parameter :: most_sweeps = 10
    real(dp), parameter :: ulps = 4.0_dp*epsilon(1.0_dp)
    real(dp), parameter :: edge = 0.5_dp*(1.0_dp - cos(acos(-1.0_dp)/(2*points)))
    !! of a step, before its first point and behind its last
    real(dp), parameter :: top = 2.0_dp**29*40320.0_dp**4/(17.0_dp*20922789888000.0_dp**2)
    !! what the nodes miss of \(\int s\,T_{15}(2s)\): \(2^{29}\,8!^4/(17\cdot16!^2)\)

    integer, parameter :: f(2) = [1, 2]      !! accelerations at the points, two groups of lanes
    integer, parameter :: f_old(2) = [3, 4]  !! those before the last sweep
    integer, parameter :: q = 5, v = 6       !! states at eight of the points

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
        if (allocated(self%room)) deallocate (self%room, self%a)
        allocate (self%a(points, n), self%room(lanes*(n + 1), v), source=0.0_dp)
        self%first = line_start(self%room(:, 1))
        call self%table%fill()
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

    pure subroutine fit(self, system, t_new, q_new, v_new, modes, weight, good)
        !! Make the series of a step. Sweep \(k\) changes the accelerations by \(\delta_k\), root
        !! mean square in units of the tolerance; the last has
        !! \(\delta_k^2/\delta_{k-1} \le 1\), which is what the next one would change.
        class(gauss_dense_t), intent(inout) :: self
        class(system_t), intent(in) :: system                  !! the one of the step
        real(dp), intent(in) :: t_new                          !! its end, s
        real(dp), intent(in) :: q_new(system%ndof)             !! coordinates there
        real(dp), intent(in) :: v_new(system%ndof)             !! velocities there
        real(dp), intent(in) :: modes(lanes, system%ndof)      !! Legendre, of the accelerations
        real(dp), intent(in) :: weight(system%ndof)            !! 1/(wanted error of them), squared
        logical, intent(out) :: good                           !! finite all along the step
        real(dp) :: change, last, rate
        integer :: sweep, group

        self%t_new = t_new
        self%h = t_new - self%t
        self%q_new(:) = q_new
        self%v_new(:) = v_new
        last = 0.0_dp
        rate = 0.05_dp
        do sweep = 1, most_sweeps
            change = 0.0_dp
            do group = 1, 2
                if (sweep == 1) then
                    call apply(system%ndof, self%table%legendre_f(:, :, group), modes, &
                               self%room(self%first, f_old(group)))
                    call fly_by_modes(system%ndof, self%h, self%table%x(:, group), self%q_old, &
                                      self%v_old, self%table%legendre_q(:, :, group), &
                                      self%table%legendre_v(:, :, group), modes, &
                                      self%room(self%first, q), self%room(self%first, v))
                else
                    call fly_by_points(self, system%ndof, group)
                end if
                call evaluate(self, system, self%t + self%h*self%table%x(:, group), f(group))
                change = change + distance(system%ndof, weight, self%room(self%first, f(group)), &
                                           self%room(self%first, f_old(group)))
            end do
            self%room(:, f_old(1)) = self%room(:, f(1))
            self%room(:, f_old(2)) = self%room(:, f(2))
            self%sweeps = sweep
            change = sqrt(0.5_dp*change)
            good = change < huge(change)
            if (.not. good) return
            if (sweep > 1) rate = min(0.5_dp, change/last)
            if (change*rate <= 1.0_dp) exit
            last = change
        end do
        call expand(self, system%ndof)
    end subroutine fit

    pure subroutine fly_by_points(self, n, group)
        !! Where the motion with the accelerations `f_old` is at eight of the points.
        type(gauss_dense_t), intent(inout) :: self
        integer, intent(in) :: n, group

        call fly(n, self%h, self%table%x(:, group), self%q_old, self%v_old, &
                 self%table%q(:, :, group), self%table%v(:, :, group), &
                 self%room(self%first, f_old(1)), self%room(self%first, f_old(2)), &
                 self%room(self%first, q), self%room(self%first, v))
    end subroutine fly_by_points

    pure subroutine evaluate(self, system, times, column)
        !! The accelerations there, into a column of the room.
        type(gauss_dense_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: times(lanes)
        integer, intent(in) :: column

        call system%accelerations_lanes(times, self%room(self%first, q), &
                                        self%room(self%first, v), self%room(self%first, column))
    end subroutine evaluate

    pure subroutine expand(self, n)
        !! The series of the accelerations, with a straight line added so that it leads to the end
        !! of the step.
        type(gauss_dense_t), intent(inout) :: self
        integer, intent(in) :: n
        real(dp) :: difference(2), even, odd
        integer :: d, group, i

        do group = 1, 2
            call apply_both(n, self%table%series(:, :, group), self%room(self%first, f(1)), &
                            self%room(self%first, f(2)), self%room(self%first, q))
            do d = 1, n
                i = self%first + (d - 1)*lanes
                self%a((group - 1)*lanes + 1:group*lanes, d) = self%room(i:i + lanes - 1, q)
            end do
        end do
        do d = 1, n
            i = self%first + (d - 1)*lanes
            difference(1) = (self%v_new(d) - self%v_old(d))/self%h &
                            - sum(self%table%v_end*self%room(i:i + lanes - 1, f(1):f(2)))
            difference(2) = ((self%q_new(d) - self%q_old(d))/self%h - self%v_old(d))/self%h &
                            - sum(self%table%q_end*self%room(i:i + lanes - 1, f(1):f(2)))
            even = sum(self%a(1::2, d))
            odd = sum(self%a(2::2, d))
            self%ends(:, d) = [even - odd, even + odd]
            self%apart(:, d) = abs(difference)
            self%a(1, d) = self%a(1, d) + difference(1)
            self%a(2, d) = self%a(2, d) + 3.0_dp*difference(1) - 6.0_dp*difference(2)
        end do
    end subroutine expand

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
        !! kink the \(\Delta\) may be small by chance: \(o\) is a fourth of the last two terms of
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
                  + 0.25_dp*norm2(self%a(points - 1:, d)) - self%noise(d)
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
            call fly_by_points(self, system%ndof, group)
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
        real(dp) :: tau, missed, x(lanes), once, twice
        integer :: d
        logical :: early

        early = t - self%t < 0.5_dp*self%h
        if (early) then
            tau = t - self%t
            q = self%q_old
            v = self%v_old
        else
            tau = t - self%t_new
            q = self%q_new
            v = self%v_new
        end if
        if (t <= self%t .or. t >= self%t_new) return
        x = 2.0_dp*tau/self%h*nodes + merge(-1.0_dp, 1.0_dp, early)
        missed = top*(tau/self%h)**(points - 1)
        do d = 1, size(q)
            call integrals(self%a(:, d), x, once, twice)
            q(d) = q(d) + tau*(v(d) + tau*(twice - missed*self%a(points, d)))
            v(d) = v(d) + tau*once
        end do
    end subroutine at
end module lagrangia_gauss_dense
