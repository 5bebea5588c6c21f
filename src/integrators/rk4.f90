module lagrangia_rk4
    !! The classical fourth-order Runge-Kutta method.
    !!
    !! Source: Kutta (1901); Hairer, Nørsett & Wanner, *Solving Ordinary Differential
    !! Equations I*, 2nd ed., table II.1.2. On the oscillator it is stable for
    !! \(\omega h \le 2\sqrt2\) and loses energy as \((\omega h)^6/72\) a step.
    use lagrangia_errors, only: error_t
    use lagrangia_integrator, only: integrator_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: rk4_t, new_rk4

    type, extends(integrator_t) :: rk4_t
        private
        real(dp), allocatable :: q(:)                     !! coordinates of a stage
        real(dp), allocatable :: v2(:), v3(:), v4(:)      !! velocities of the stages
        real(dp), allocatable :: a1(:), a2(:), a3(:), a4(:)
    contains
        procedure :: prepare
        procedure :: advance
    end type rk4_t

contains

    pure subroutine new_rk4(self)
        !! Any system will do.
        type(rk4_t), intent(out) :: self

        self%name = "rk4"
        self%title = "classical Runge-Kutta, order 4, any system (Kutta 1901)"
        self%order = 4
    end subroutine new_rk4

    pure subroutine prepare(self, system, error)
        !! Never fails.
        class(rk4_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        type(error_t), allocatable, intent(out) :: error
        real(dp) :: state(system%ndof)

        state = 0.0_dp
        self%evaluations = 0
        self%q = state
        self%v2 = state
        self%v3 = state
        self%v4 = state
        self%a1 = state
        self%a2 = state
        self%a3 = state
        self%a4 = state
    end subroutine prepare

    pure subroutine advance(self, system, t0, dt, first, steps, q, v)
        !! See `integrator_t`.
        class(rk4_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t0, dt
        integer(i8), intent(in) :: first, steps
        real(dp), intent(inout) :: q(system%ndof), v(system%ndof)
        real(dp) :: t, half
        integer(i8) :: k

        half = 0.5_dp*dt
        do k = first, first + steps - 1
            t = t0 + k*dt
            call system%accelerations(t, q, v, self%a1)
            self%q = q + half*v
            self%v2 = v + half*self%a1
            call system%accelerations(t + half, self%q, self%v2, self%a2)
            self%q = q + half*self%v2
            self%v3 = v + half*self%a2
            call system%accelerations(t + half, self%q, self%v3, self%a3)
            self%q = q + dt*self%v3
            self%v4 = v + dt*self%a3
            call system%accelerations(t + dt, self%q, self%v4, self%a4)
            q = q + dt/6.0_dp*(v + 2.0_dp*(self%v2 + self%v3) + self%v4)
            v = v + dt/6.0_dp*(self%a1 + 2.0_dp*(self%a2 + self%a3) + self%a4)
        end do
        self%evaluations = self%evaluations + 4*steps
    end subroutine advance
end module lagrangia_rk4
