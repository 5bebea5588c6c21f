module lagrangia_composition
    !! Symmetric compositions of position Verlet steps: symplectic, time-reversible.
    !!
    !! One step of length \(h\) is drift \(h/2\), kick \(h\), drift \(h/2\); a method is a row of
    !! fractions \(\gamma_s\), \(\sum\gamma_s = 1\). Source: Verlet (1967); Hairer, Lubich &
    !! Wanner, *Geometric Numerical Integration*, 2nd ed., secs. I.1.4 and V.3.
    use lagrangia_errors, only: error_t, fail
    use lagrangia_integrator, only: integrator_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: composition_t, new_verlet

    type, extends(integrator_t) :: composition_t
        private
        real(dp), allocatable :: gamma(:)  !! fractions of the step
        real(dp), allocatable :: a(:)
    contains
        procedure :: prepare
        procedure :: advance
    end type composition_t

contains

    pure subroutine new_verlet(self)
        !! Position Verlet (drift, kick, drift). On the oscillator it is stable for
        !! \(\omega h < 2\) and conserves \((1-\omega^2h^2/4)\,v^2 + \omega^2x^2\).
        type(composition_t), intent(out) :: self

        self%name = "verlet"
        self%title = "position Verlet, order 2, symplectic, forces of positions only (Verlet 1967)"
        self%order = 2
        self%gamma = [1.0_dp]
    end subroutine new_verlet

    pure subroutine prepare(self, system, error)
        !! Refuses forces that depend on the velocities: there the order would drop to one.
        class(composition_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        type(error_t), allocatable, intent(out) :: error
        real(dp) :: state(system%ndof)

        if (system%velocity_forces) then
            call fail(error, trim(self%name)//" is for forces that depend on positions only, "// &
                      "and here they depend on velocities; method = 'rk4' works", key="method")
            return
        end if
        state = 0.0_dp
        self%evaluations = 0
        self%a = state
    end subroutine prepare

    pure subroutine advance(self, system, t0, dt, first, steps, q, v)
        !! See `integrator_t`. One evaluation a stage, and nothing carried between calls.
        class(composition_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t0, dt
        integer(i8), intent(in) :: first, steps
        real(dp), intent(inout) :: q(system%ndof), v(system%ndof)
        real(dp) :: h, now
        integer(i8) :: k
        integer :: s

        do k = first, first + steps - 1
            now = t0 + k*dt
            do s = 1, size(self%gamma)
                h = self%gamma(s)*dt
                q = q + 0.5_dp*h*v
                call system%accelerations(now + 0.5_dp*h, q, v, self%a)
                v = v + h*self%a
                q = q + 0.5_dp*h*v
                now = now + h
            end do
        end do
        self%evaluations = self%evaluations + steps*size(self%gamma)
    end subroutine advance
end module lagrangia_composition
