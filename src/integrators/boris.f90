module lagrangia_boris
    !! Boris's method for charges: drift, half a push, a turn about B, half a push, drift.
    !!
    !! The turn is the Cayley map \(v^+ = v^- + (v^- + v^-\times\tau)\times 2\tau/(1+\tau^2)\),
    !! \(\tau = \omega h/2\), by the angle \(2\arctan(\omega h/2)\): it keeps \(|v|\) exactly and
    !! lags by \((\omega h)^3/12\) a step. The method keeps phase-space volume, but is not
    !! symplectic.
    !!
    !! Source: Boris (1970); Birdsall & Langdon, *Plasma Physics via Computer Simulation*, sec.
    !! 4-4; Qin et al., Phys. Plasmas 20, 084503 (2013).
    use lagrangia_errors, only: error_t, fail
    use lagrangia_gyrating_system, only: gyrating_system_t
    use lagrangia_integrator, only: integrator_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_system, only: system_t
    use lagrangia_vectors, only: cross
    implicit none (type, external)
    private
    public :: boris_t, new_boris

    type, extends(integrator_t) :: boris_t
    contains
        procedure :: prepare
        procedure :: advance
    end type boris_t

contains

    pure subroutine new_boris(self)
        !! For systems that say how their velocities turn.
        type(boris_t), intent(out) :: self  !! not yet prepared

        self%name = "boris"
        self%title = "drift, push, turn, push, drift (Boris 1970)"
        self%order = 2
        self%energy_order = 2
        self%step_limit = 2.0_dp
        self%reversible = .true.
        self%keeps_speed = .true.
    end subroutine new_boris

    pure subroutine prepare(self, system, error)
        !! Refuses systems that do not say how their velocities turn.
        class(boris_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        type(error_t), allocatable, intent(out) :: error

        select type (system)
        class is (gyrating_system_t)
            self%coordinates = system%ndof
            self%evaluations = 0
            return
        end select
        call fail(error, "boris is for charges in magnetic fields", key="method")
    end subroutine prepare

    pure subroutine advance(self, system, t0, dt, first, steps, q, v)
        !! See `integrator_t`. Nothing is carried between calls.
        class(boris_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t0, dt
        integer(i8), intent(in) :: first, steps
        real(dp), intent(inout) :: q(system%ndof), v(system%ndof)
        real(dp) :: x(3), u(3), a(3), omega(3), tau(3)
        real(dp) :: half
        integer(i8) :: k
        logical :: refused

        call self%refuse_system(system, refused, q, v)
        if (refused) return
        half = 0.5_dp*dt
        x = q
        u = v
        select type (system)
        class is (gyrating_system_t)
            do k = first, first + steps - 1
                x = x + half*u
                call system%split_accelerations(t0 + k*dt + half, x, a, omega)
                u = u + half*a
                tau = half*omega
                u = u + cross(u + cross(u, tau), 2.0_dp/(1.0_dp + sum(tau**2))*tau)
                u = u + half*a
                x = x + half*u
            end do
        end select
        q = x
        v = u
        self%evaluations = self%evaluations + steps
    end subroutine advance
end module lagrangia_boris
