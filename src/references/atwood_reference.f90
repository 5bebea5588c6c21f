submodule (lagrangia_atwood) lagrangia_atwood_reference
    !! Atwood's machine in closed form.
    use lagrangia_kinds, only: dp
    use lagrangia_uniform_acceleration, only: start_uniform_acceleration, uniform_acceleration_t
    implicit none (type, external)

contains

    module subroutine closed_form(self, t0, q0, v0, reference)
        !! Covers every initial state.
        !! $$ \ddot x = (g + a_s)\,\frac{m_1 - m_2}{m_1 + m_2 + I/R^2} $$
        class(atwood_t), intent(in) :: self
        real(dp), intent(in) :: t0, q0(:), v0(:)
        class(reference_t), allocatable, intent(out) :: reference
        type(uniform_acceleration_t) :: motion
        real(dp) :: gravity, weight, inertia

        gravity = self%g + self%support_acceleration
        weight = self%m1 - self%m2
        inertia = self%m1 + self%m2 + self%pulley_inertia/self%radius**2
        call start_uniform_acceleration(motion, "x0 + v0 t + a t^2/2, a = (m1 - m2)(g + a_s)/"// &
                                        "(m1 + m2 + I/R^2)", t0, q0, v0, [gravity*weight/inertia])
        allocate (reference, source=motion)
    end subroutine closed_form
end submodule lagrangia_atwood_reference
