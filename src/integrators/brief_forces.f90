module lagrangia_brief_forces
    !! Moments of a motion at which a force acts or turns at once, which long steps would go over
    !! without a sign: an error estimate sees only what a stage has met.
    use lagrangia_kinds, only: dp
    implicit none (type, external)
    private
    public :: brief_forces_t

    integer, parameter :: most = 200        !! moments that are told apart
    real(dp), parameter :: reach = 16.0_dp  !! widths to both sides: \(1/\cosh 16 = 2\cdot 10^{-7}\)
    real(dp), parameter :: step = 2.0_dp    !! widths that a step may be long

    type :: brief_forces_t
        !! None at first.
        private
        integer :: moments = 0             !! of more than `most` only the shortest width counts
        real(dp), dimension(most) :: from = 0.0_dp, to = 0.0_dp, width = 0.0_dp  !! s
        real(dp) :: least = huge(1.0_dp)   !! width but of kinks, s
    contains
        procedure :: add
        procedure :: longest_step
    end type brief_forces_t

contains

    pure subroutine add(self, t, width, kink)
        !! One more moment. A kink is gone over by one step, which is too short to count, so that
        !! the others begin and end beside it.
        class(brief_forces_t), intent(inout) :: self
        real(dp), intent(in) :: t      !! the middle, s
        real(dp), intent(in) :: width  !! s; at a kink the rounding of times
        logical, intent(in) :: kink    !! it lasts no time

        if (.not. kink) self%least = min(self%least, width)
        self%moments = self%moments + 1
        if (self%moments > most) return
        self%from(self%moments) = t - reach*width
        self%to(self%moments) = t + reach*width
        self%width(self%moments) = merge(reach*width, width, kink)
    end subroutine add

    pure function longest_step(self, t) result(h)
        !! How long a step from `t` on may be: to the next moment, and within it not longer than
        !! lets all stages see it.
        class(brief_forces_t), intent(in) :: self
        real(dp), intent(in) :: t  !! s
        real(dp) :: h
        integer :: i

        h = huge(h)
        if (self%moments > most .and. self%least < huge(h)) h = step*self%least
        if (self%moments > most) return
        do i = 1, self%moments
            if (t < self%from(i) - 4*spacing(t)) then
                h = min(h, self%from(i) - t)
            else if (t < self%to(i)) then
                h = min(h, step*self%width(i))
            end if
        end do
    end function longest_step
end module lagrangia_brief_forces
