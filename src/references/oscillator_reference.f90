module lagrangia_oscillator_reference
    !! The oscillator's motion in closed form.
    use lagrangia_kinds, only: dp
    use lagrangia_oscillator, only: oscillator_t
    use lagrangia_reference, only: reference_t
    implicit none (type, external)
    private
    public :: oscillator_reference_t, new_oscillator_reference

    real(dp), parameter :: pi = acos(-1.0_dp)

    type, extends(reference_t) :: oscillator_reference_t
        private
        real(dp) :: omega = 0.0_dp  !! rad/s; 0 without a spring
        real(dp) :: t0 = 0.0_dp, x0 = 0.0_dp, v0 = 0.0_dp
    contains
        procedure :: state_at
    end type oscillator_reference_t

contains

    pure subroutine new_oscillator_reference(self, system, t0, q0, v0, found)
        !! Covers every initial state; without a spring the motion is uniform.
        type(oscillator_reference_t), intent(out) :: self
        type(oscillator_t), intent(in) :: system
        real(dp), intent(in) :: t0, q0(:), v0(:)
        logical, intent(out) :: found

        found = .true.
        self%title = "x0 cos(omega t) + v0/omega sin(omega t), omega^2 = k/m"
        self%ndof = 1
        self%omega = sqrt(system%k/system%m)
        if (self%omega > 0.0_dp) self%period = 2.0_dp*pi/self%omega
        self%small_period = self%period
        self%t0 = t0
        self%x0 = q0(1)
        self%v0 = v0(1)
    end subroutine new_oscillator_reference

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
end module lagrangia_oscillator_reference
