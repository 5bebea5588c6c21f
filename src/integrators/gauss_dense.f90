module lagrangia_gauss_dense
    !! The solution inside a step of Gauss-Legendre collocation, to the accuracy of its ends.
    !!
    !! The collocation polynomial does not have it: with eight stages it is of order 9 inside the
    !! step, where the ends are of order 16. So it is only the start here: the accelerations are
    !! evaluated along it at 16 Chebyshev points (two times eight lanes), integrated twice, and
    !! that is repeated until it changes less than the tolerance, two or three times. The sixteen
    !! coefficients that are left then give the state anywhere, without evaluations.
    !!
    !! Chebyshev series: Mason & Handscomb, *Chebyshev Polynomials*, 2003, secs. 2.4 and 6.3.
    use lagrangia_gauss_tables, only: legendre, nodes, weights
    use lagrangia_kinds, only: dp, i8
    use lagrangia_system, only: lanes, system_t
    implicit none (type, external)
    private
    public :: gauss_dense_t

    integer, parameter :: points = 2*lanes
    integer, parameter :: most_sweeps = 10
    real(dp), parameter :: ulps = 4.0_dp*epsilon(1.0_dp)
    real(dp), parameter :: edge = 0.5_dp*(1.0_dp - cos(acos(-1.0_dp)/(2*points)))
    !! of a step, before its first point and behind its last
    real(dp), parameter :: top = 2.0_dp**29*40320.0_dp**4/(17.0_dp*20922789888000.0_dp**2)
    !! what the nodes miss of \(\int s\,T_{15}(2s)\): \(2^{29}\,8!^4/(17\cdot16!^2)\)

    type :: gauss_dense_t
        real(dp) :: t = 0.0_dp, t_new = 0.0_dp        !! start and end of the step, s
        real(dp) :: h = 1.0_dp                        !! its length, s
        real(dp), allocatable :: q_old(:), v_old(:)   !! state at its start
        real(dp), allocatable :: q_new(:), v_new(:)   !! and at its end
        integer :: sweeps = 0                         !! of the last `fit`, 16 evaluations each
        real(dp) :: t_at(points, 0:points + 1) = 0.0_dp    !! \(T_k\) at the points
        real(dp) :: t_of(0:points - 1, points) = 0.0_dp    !! the same, point by point
        real(dp) :: p_at(points, lanes) = 0.0_dp      !! Legendre's polynomials at the points
        real(dp), allocatable :: f(:, :)              !! accelerations at the points
        real(dp), allocatable :: a(:, :)              !! their Chebyshev coefficients
        real(dp), allocatable :: v(:, :), q(:, :)     !! those of velocities and coordinates
        real(dp), allocatable :: q_lane(:, :), v_lane(:, :), f_lane(:, :)
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
        real(dp), parameter :: pi = acos(-1.0_dp)
        real(dp) :: state(n), block(lanes, n), cosine(0:4*points - 1)
        integer :: j, k

        state = 0.0_dp
        block = 0.0_dp
        self%q_old = state
        self%v_old = state
        self%q_new = state
        self%v_new = state
        self%apart = block(:2, :)
        self%ends = block(:2, :)
        self%noise = state
        self%q_lane = block
        self%v_lane = block
        self%f_lane = block
        if (allocated(self%f)) deallocate (self%f, self%a, self%v, self%q)
        allocate (self%f(points, n), source=0.0_dp)
        allocate (self%a(0:points + 1, n), self%v(0:points + 1, n), self%q(0:points + 1, n), &
                  source=0.0_dp)
        do k = 0, 4*points - 1
            cosine(k) = cos(k*pi/(2*points))
        end do
        do k = 0, points + 1
            do j = 1, points
                self%t_at(j, k) = cosine(mod((2*j - 1)*k, 4*points))
            end do
        end do
        self%t_of = transpose(self%t_at(:, :points - 1))
        do k = 0, lanes, lanes
            self%p_at(k + 1:k + lanes, :) = legendre(0.5_dp + 0.5_dp*self%t_at(k + 1:k + lanes, 1))
        end do
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
        real(dp) :: change, last, rate, difference(2)
        integer :: d, sweep

        self%t_new = t_new
        self%h = t_new - self%t
        self%q_new(:) = q_new
        self%v_new(:) = v_new
        call from_modes(self, system%ndof, modes)
        last = 0.0_dp
        rate = 0.05_dp
        do sweep = 1, most_sweeps
            do d = 1, system%ndof
                call integrate(self, d)
            end do
            call evaluate(self, system, weight, change)
            good = change < huge(1.0_dp)
            if (.not. good) return
            if (sweep > 1) rate = min(0.5_dp, change/last)
            if (change*rate <= 1.0_dp) exit
            last = change
        end do
        do d = 1, system%ndof
            call integrate(self, d)
        end do
        do d = 1, system%ndof
            difference(1) = (v_new(d) - sum(self%v(:, d)))/self%h
            difference(2) = (q_new(d) - sum(self%q(:, d)))/self%h**2
            self%apart(:, d) = abs(difference)
            self%ends(1, d) = sum(self%a(0::2, d)) - sum(self%a(1::2, d))
            self%ends(2, d) = sum(self%a(:, d))
            self%a(0, d) = self%a(0, d) + difference(1)
            self%a(1, d) = self%a(1, d) + 3.0_dp*difference(1) - 6.0_dp*difference(2)
            call integrate_series(self, d)
        end do
    end subroutine fit

    pure subroutine from_modes(self, n, modes)
        !! Accelerations of the collocation polynomial at the points.
        type(gauss_dense_t), intent(inout) :: self
        integer, intent(in) :: n
        real(dp), intent(in) :: modes(lanes, n)
        integer :: d, k

        self%sweeps = 0
        do d = 1, n
            self%f(:, d) = self%p_at(:, 1)*modes(1, d)
            do k = 2, lanes
                self%f(:, d) = self%f(:, d) + self%p_at(:, k)*modes(k, d)
            end do
        end do
    end subroutine from_modes

    pure subroutine integrate(self, d)
        !! Series of accelerations, velocities and coordinates from the accelerations.
        type(gauss_dense_t), intent(inout) :: self
        integer, intent(in) :: d
        real(dp) :: c(0:points - 1)
        integer :: j

        c = 0.0_dp
        do j = 1, points
            c = c + self%t_of(:, j)*self%f(j, d)
        end do
        self%a(:points - 1, d) = 2.0_dp/points*c
        self%a(0, d) = 0.5_dp*self%a(0, d)
        call integrate_series(self, d)
    end subroutine integrate

    pure subroutine integrate_series(self, d)
        !! Series of velocities and coordinates from that of the accelerations.
        type(gauss_dense_t), intent(inout) :: self
        integer, intent(in) :: d

        call antiderivative(0.5_dp*self%h, self%a(:, d), self%v_old(d), self%v(:, d))
        call antiderivative(0.5_dp*self%h, self%v(:, d), self%q_old(d), self%q(:, d))
    end subroutine integrate_series

    pure subroutine antiderivative(scale, c, start, b)
        !! \(b = \mathrm{start} + \mathrm{scale}\int_{-1} c\).
        real(dp), intent(in) :: scale, c(0:points + 1), start
        real(dp), intent(out) :: b(0:points + 1)
        integer :: k

        b(1) = scale*(c(0) - 0.5_dp*c(2))
        do k = 2, points
            b(k) = scale*(c(k - 1) - c(k + 1))/(2*k)
        end do
        b(points + 1) = scale*c(points)/(2*(points + 1))
        b(0) = start + sum(b(1::2)) - sum(b(2::2))
    end subroutine antiderivative

    pure subroutine evaluate(self, system, weight, change)
        !! The accelerations at the points along the present motion, and by how much, root mean
        !! square, in units of the tolerance, they differ from what they were.
        type(gauss_dense_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: weight(system%ndof)
        real(dp), intent(out) :: change
        real(dp) :: times(lanes)
        integer :: d, group

        change = 0.0_dp
        do group = 0, lanes, lanes
            call place(self, group, times)
            call system%accelerations_lanes(times, self%q_lane, self%v_lane, self%f_lane)
            do d = 1, system%ndof
                change = change + weight(d)*sum((self%f_lane(:, d) &
                                                 - self%f(group + 1:group + lanes, d))**2)
                self%f(group + 1:group + lanes, d) = self%f_lane(:, d)
            end do
        end do
        change = sqrt(change/points)
        self%sweeps = self%sweeps + 1
    end subroutine evaluate

    pure subroutine place(self, group, times)
        !! Where the present motion is at eight of the points.
        type(gauss_dense_t), intent(inout) :: self
        integer, intent(in) :: group
        real(dp), intent(out) :: times(lanes)
        integer :: d, k

        times = self%t + 0.5_dp*self%h*(1.0_dp + self%t_at(group + 1:group + lanes, 1))
        self%q_lane(:, :) = 0.0_dp
        self%v_lane(:, :) = 0.0_dp
        do d = 1, size(self%q_lane, 2)
            do k = points + 1, 0, -1
                self%q_lane(:, d) = self%q_lane(:, d) &
                                    + self%q(k, d)*self%t_at(group + 1:group + lanes, k)
                self%v_lane(:, d) = self%v_lane(:, d) &
                                    + self%v(k, d)*self%t_at(group + 1:group + lanes, k)
            end do
        end do
    end subroutine place

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
                  + 0.25_dp*norm2(self%a(points - 2:points - 1, d)) - self%noise(d)
            apart = self%h*(self%apart(:, d) + off)
            yes = yes .and. apart(1) <= max(allowed, (allowed + ulps)*abs(self%v_new(d))) &
                  .and. self%h*apart(2) <= max(allowed, (allowed + ulps)*abs(self%q_new(d)))
        end do
    end function agrees

    pure subroutine measure_noise(self, system)
        !! Of accelerations: what four ulp of the time and the state at the points, up and down in
        !! turn, make of them, root mean square.
        type(gauss_dense_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        real(dp), parameter :: turn(lanes) = 1.0_dp + ulps*[1, -1, 1, -1, 1, -1, 1, -1]
        real(dp) :: times(lanes)
        integer :: d, group

        self%noise(:) = 0.0_dp
        do group = 0, lanes, lanes
            call place(self, group, times)
            call system%accelerations_lanes(times, self%q_lane, self%v_lane, self%f_lane)
            self%f(group + 1:group + lanes, :) = self%f_lane
            do d = 1, system%ndof
                self%q_lane(:, d) = turn*self%q_lane(:, d)
                self%v_lane(:, d) = turn*self%v_lane(:, d)
            end do
            times = turn*times
            call system%accelerations_lanes(times, self%q_lane, self%v_lane, self%f_lane)
            do d = 1, system%ndof
                self%noise(d) = self%noise(d) &
                                + sum((self%f_lane(:, d) - self%f(group + 1:group + lanes, d))**2)
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
        real(dp) :: tau, missed, a(lanes)
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
        do d = 1, size(q)
            a = series(self%a(:, d), 2.0_dp*tau/self%h*nodes + merge(-1.0_dp, 1.0_dp, early))
            missed = top*self%a(points - 1, d)*(tau/self%h)**(points - 1)
            q(d) = q(d) + tau*(v(d) + tau*(sum(weights*(1.0_dp - nodes)*a) - missed))
            v(d) = v(d) + tau*sum(weights*a)
        end do
    end subroutine at

    pure function series(c, x) result(y)
        !! Clenshaw's sum of \(c_k T_k(x)\), in all lanes.
        real(dp), intent(in) :: c(0:points + 1), x(lanes)
        real(dp) :: y(lanes), b1(lanes), b2(lanes), b(lanes)
        integer :: k

        b1 = 0.0_dp
        b2 = 0.0_dp
        do k = points - 1, 1, -1
            b = 2.0_dp*x*b1 - b2 + c(k)
            b2 = b1
            b1 = b
        end do
        y = x*b1 - b2 + c(0)
    end function series
end module lagrangia_gauss_dense
