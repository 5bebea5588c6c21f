module lagrangia_gauss
    !! Gauss-Legendre collocation with a fixed step: order 16, symplectic, symmetric.
    !!
    !! The equations of a step are solved until sweeps change nothing but the last digits. See
    !! `lagrangia_gauss_tables` and `lagrangia_gauss_stages`. Source: Hairer, Lubich & Wanner,
    !! *Geometric Numerical Integration*, 2nd ed., secs. II.1.3, VIII.5 and VIII.6.
    use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
    use lagrangia_errors, only: error_t
    use lagrangia_gauss_stages, only: gauss_stages_t
    use lagrangia_gauss_tables, only: stages
    use lagrangia_integrator, only: integrator_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: gauss_t, new_gauss16

    integer, parameter :: most_sweeps = 200

    type, extends(integrator_t) :: gauss_t
        private
        type(gauss_stages_t) :: s
        real(dp), allocatable :: least(:)  !! change of `f` in the sweeps so far
        real(dp) :: t0 = 0.0_dp, dt = 0.0_dp
        integer(i8) :: next = -1           !! step that would go on from where `s` stands
    contains
        procedure :: prepare
        procedure :: advance
    end type gauss_t

contains

    pure subroutine new_gauss16(self)
        !! Any system will do.
        type(gauss_t), intent(out) :: self

        self%name = "gauss16"
        self%title = "Gauss-Legendre collocation, 8 stages in vector lanes (Butcher 1964)"
        self%order = 16
        self%energy_order = 16
        self%reversible = .true.
    end subroutine new_gauss16

    pure subroutine prepare(self, system, error)
        !! Never fails.
        class(gauss_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        type(error_t), allocatable, intent(out) :: error

        call self%s%prepare(system%ndof)
        self%least = self%s%change
        self%next = -1
        self%evaluations = 0
    end subroutine prepare

    pure subroutine advance(self, system, t0, dt, first, steps, q, v)
        !! See `integrator_t`. What rounding took from the state, and the polynomial of the last
        !! step, are kept from one call to the next, and used if that one goes on from there: so
        !! the bytes are the same however a run is cut. Where the iteration fails the state is NaN.
        class(gauss_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t0, dt
        integer(i8), intent(in) :: first, steps
        real(dp), intent(inout) :: q(system%ndof), v(system%ndof)
        integer(i8) :: k
        integer :: sweeps
        logical :: good

        if (.not. goes_on(self, t0, dt, first, q, v)) then
            call self%s%place(system, t0 + first*dt, q, v)
            self%evaluations = self%evaluations + 1
        end if
        do k = first, first + steps - 1
            call self%s%guess(t0 + k*dt, dt)
            call solve(self%s, system, self%least, sweeps, good)
            self%evaluations = self%evaluations + stages*min(sweeps, most_sweeps)
            if (.not. good) self%s%f = ieee_value(1.0_dp, ieee_quiet_nan)
            call self%s%expand()
            call self%s%finish()
            if (.not. good) exit
        end do
        q = self%s%q
        v = self%s%v
        self%t0 = t0
        self%dt = dt
        self%next = first + steps
    end subroutine advance

    pure function goes_on(self, t0, dt, first, q, v)
        !! The call goes on from where the last one ended.
        class(gauss_t), intent(in) :: self
        real(dp), intent(in) :: t0, dt, q(:), v(:)
        integer(i8), intent(in) :: first
        logical :: goes_on

        goes_on = first == self%next .and. same(t0, self%t0) .and. same(dt, self%dt) &
                  .and. all(same(q, self%s%q)) .and. all(same(v, self%s%v))
    end function goes_on

    pure elemental function same(x, y)
        !! Equal to the last bit, for numbers.
        real(dp), intent(in) :: x, y
        logical :: same

        same = x <= y .and. x >= y
    end function same

    pure subroutine solve(s, system, least, sweeps, good)
        !! Sweep until no degree of freedom changes less than it did before: what is left then is
        !! noise. Changes that matter to the state may still shrink after some idle sweeps, the more
        !! the slower they do, or diverge.
        type(gauss_stages_t), intent(inout) :: s
        class(system_t), intent(in) :: system
        real(dp), intent(inout) :: least(s%n)
        integer, intent(out) :: sweeps
        logical, intent(out) :: good
        integer :: idle

        least = huge(least)
        idle = 0
        do sweeps = 1, most_sweeps
            call s%sweep(system)
            good = all(s%change < huge(1.0_dp))
            if (.not. good) return
            idle = idle + 1
            if (any(s%change < least .and. s%change > 0.0_dp)) idle = 0
            least = min(least, s%change)
            if (idle > sweeps/10 .and. settled(s)) return
        end do
        good = settled(s)
    end subroutine solve

    pure function settled(s)
        !! The last sweep changed the state by less than a small part of itself.
        type(gauss_stages_t), intent(in) :: s
        logical :: settled
        real(dp), parameter :: small = 2.0_dp**16*epsilon(1.0_dp)

        settled = all(s%h**2*s%change <= small**2*max(s%v**2, s%h**2*s%size_of) &
                      .or. s%h**4*s%change <= small**2*s%q**2)
    end function settled
end module lagrangia_gauss
