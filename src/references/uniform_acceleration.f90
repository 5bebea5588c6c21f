module lagrangia_uniform_acceleration
    !! Motion in closed form where every acceleration is constant: parabolas in time.
    use lagrangia_kinds, only: dp
    use lagrangia_reference, only: reference_t
    implicit none (type, external)
    private
    public :: uniform_acceleration_t, start_uniform_acceleration

    type, extends(reference_t) :: uniform_acceleration_t
        private
        real(dp) :: t0 = 0.0_dp
        real(dp), allocatable :: q0(:), v0(:), a(:)
    contains
        procedure :: state_at
    end type uniform_acceleration_t

contains

    pure subroutine start_uniform_acceleration(self, title, t0, q0, v0, a)
        !! Through `(q0, v0)` at `t0` with the accelerations `a`.
        type(uniform_acceleration_t), intent(out) :: self  !! the motion
        character(*), intent(in) :: title  !! of the closed form
        real(dp), intent(in) :: t0, q0(:), v0(:), a(:)  !! s; state and accelerations, (ndof) each

        self%title = title
        self%ndof = size(q0)
        self%t0 = t0
        self%q0 = q0
        self%v0 = v0
        self%a = a
    end subroutine start_uniform_acceleration

    pure subroutine state_at(self, t, q, v)
        !! $$ q = q_0 + v_0 t + \tfrac12 a t^2,\quad \dot q = v_0 + a t $$
        class(uniform_acceleration_t), intent(in) :: self
        real(dp), intent(in) :: t
        real(dp), intent(out) :: q(self%ndof), v(self%ndof)
        real(dp) :: s

        s = t - self%t0
        q = self%q0 + s*(self%v0 + 0.5_dp*s*self%a)
        v = self%v0 + s*self%a
    end subroutine state_at
end module lagrangia_uniform_acceleration
