submodule (lagrangia_oscillator) lagrangia_oscillator_reference
    !! The oscillator's motion in closed form.
    use lagrangia_forced_oscillation, only: forced_oscillation_t, start_forced
    use lagrangia_kinds, only: dp
    use lagrangia_reference, only: reference_t
    implicit none (type, external)

    real(dp), parameter :: pi = acos(-1.0_dp)

    type, extends(reference_t) :: oscillator_reference_t
        real(dp) :: omega = 0.0_dp  !! rad/s; 0 without a spring
        real(dp) :: t0 = 0.0_dp, x0 = 0.0_dp, v0 = 0.0_dp
    contains
        procedure :: state_at
    end type oscillator_reference_t

contains

    module subroutine closed_form(self, t0, q0, v0, reference)
        !! Covers every initial state; without a spring the motion is uniform.
        class(oscillator_t), intent(in) :: self
        real(dp), intent(in) :: t0, q0(:), v0(:)
        class(reference_t), allocatable, intent(out) :: reference
        type(oscillator_reference_t) :: motion
        type(forced_oscillation_t) :: forced

        if (self%nonconservative) then
            call start_forced(forced, self%m, self%k, self%b, self%drive_force, &
                              self%drive_frequency, t0, q0(1), v0(1))
            allocate (reference, source=forced)
            return
        end if
        motion%title = "x0 cos(omega t) + v0/omega sin(omega t), omega^2 = k/m"
        motion%ndof = 1
        motion%omega = sqrt(self%k/self%m)
        if (motion%omega > 0.0_dp) motion%period = 2.0_dp*pi/motion%omega
        motion%small_period = motion%period
        motion%t0 = t0
        motion%x0 = q0(1)
        motion%v0 = v0(1)
        allocate (reference, source=motion)
    end subroutine closed_form

    pure subroutine state_at(self, t, q, v)
        !! $$ x = x_0\cos\omega t + \frac{v_0}{\omega}\sin\omega t,\quad
        !!    \dot x = v_0\cos\omega t - \omega x_0\sin\omega t $$
        class(oscillator_reference_t), intent(in) :: self
        real(dp), intent(in) :: t
        real(dp), intent(out) :: q(self%ndof), v(self%ndof)
        real(dp) :: s, c

        associate (omega => self%omega, x0 => self%x0, v0 => self%v0)
            s = sin(omega*(t - self%t0))
            c = cos(omega*(t - self%t0))
            if (omega > 0.0_dp) then
                q(1) = x0*c + v0*(s/omega)
            else
                q(1) = x0 + v0*(t - self%t0)
            end if
            v(1) = v0*c - omega*x0*s
        end associate
    end subroutine state_at
end submodule lagrangia_oscillator_reference
