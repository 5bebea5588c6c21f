module lagrangia_atwood_reference
    !! Atwood's machine in closed form.
    use lagrangia_atwood, only: atwood_t
    use lagrangia_kinds, only: dp
    use lagrangia_uniform_acceleration, only: start_uniform_acceleration, uniform_acceleration_t
    implicit none (type, external)
    private
    public :: atwood_reference_t, new_atwood_reference

    type, extends(uniform_acceleration_t) :: atwood_reference_t
    end type atwood_reference_t

contains

    pure subroutine new_atwood_reference(self, system, t0, q0, v0, found)
        !! Covers every initial state.
        !! $$ \ddot x = (g + a_s)\,\frac{m_1 - m_2}{m_1 + m_2 + I/R^2} $$
        type(atwood_reference_t), intent(out) :: self
        type(atwood_t), intent(in) :: system
        real(dp), intent(in) :: t0, q0(:), v0(:)
        logical, intent(out) :: found
        real(dp) :: gravity, weight, inertia

        found = .true.
        gravity = system%g + system%support_acceleration
        weight = system%m1 - system%m2
        inertia = system%m1 + system%m2 + system%pulley_inertia/system%radius**2
        call start_uniform_acceleration(self, "x0 + v0 t + a t^2/2, a = (m1 - m2)(g + a_s)/"// &
                                        "(m1 + m2 + I/R^2)", t0, q0, v0, [gravity*weight/inertia])
    end subroutine new_atwood_reference
end module lagrangia_atwood_reference
