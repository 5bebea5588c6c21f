module lagrangia_gauss_kinks
    !! Whether a step of Gauss-Legendre collocation went over a kink or a jump of the force.
    !!
    !! The estimate of `lagrangia_gauss_control` takes the accelerations for smooth. The dense
    !! output has them at sixteen points of its own, and a second estimate of the end of the step.
    use lagrangia_gauss_dense, only: gauss_dense_t, points
    use lagrangia_kinds, only: dp, i8
    use lagrangia_system, only: lanes, system_t
    implicit none (type, external)
    private
    public :: see_kinks

    real(dp), parameter :: ulps = 4.0_dp*epsilon(1.0_dp)
    real(dp), parameter :: edge = 0.5_dp*(1.0_dp - cos(acos(-1.0_dp)/(2*points)))
    !! of a step, before its first point and behind its last

contains

    pure subroutine see_kinks(self, system, tolerance, first, last, evaluations, none)
        !! Look into a step whose dense output is known. Only where the quadratures disagree the
        !! noise of the accelerations is measured, if it is not known to be enough.
        type(gauss_dense_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: tolerance              !! of the step
        real(dp), intent(in) :: first(:), last(:)      !! accelerations at its ends
        integer(i8), intent(inout) :: evaluations      !! counts on
        logical, intent(out) :: none                   !! the step is right

        none = agrees(self, tolerance, first, last)
        if (none) return
        call measure_noise(self, system)
        evaluations = evaluations + 2*points
        none = agrees(self, tolerance, first, last)
    end subroutine see_kinks

    pure function agrees(self, tolerance, first, last) result(yes)
        !! The step has the error that it should have, whatever lies between the nodes: what two
        !! quadratures make of it, eight nodes and sixteen points, is within ten tolerances at its
        !! end, absolute below 1, relative above, or within what is noise. Behind a kink they differ
        !! by chance only as little: so does what the last two terms of the series, a fourth of
        !! it, and what `first` and `last`, the accelerations at the ends of the step, have beyond
        !! the series, between the ends and the points next to them.
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
            call self%place(group, times)
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
end module lagrangia_gauss_kinks
