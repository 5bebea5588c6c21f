submodule (lagrangia_wedge) lagrangia_wedge_reference
    !! The block on the wedge in closed form.
    use lagrangia_kinds, only: dp
    use lagrangia_uniform_acceleration, only: start_uniform_acceleration, uniform_acceleration_t
    implicit none (type, external)

contains

    module subroutine closed_form(self, t0, q0, v0, reference)
        !! Covers every initial state. As the notes state it,
        !! $$ \ddot q_1 = \frac{g\sin\alpha}{1 - m\cos^2\alpha/(M+m)},\quad
        !!    \ddot q_2 = -\frac{m}{M+m}\,\ddot q_1\cos\alpha. $$
        !! The denominator loses digits where \(M \ll m\) and \(\alpha\) is small; it is written
        !! as \((M + m\sin^2\alpha)/(M+m)\).
        class(wedge_t), intent(in) :: self
        real(dp), intent(in) :: t0, q0(:), v0(:)
        class(reference_t), allocatable, intent(out) :: reference
        type(uniform_acceleration_t) :: motion
        real(dp) :: share, a1, a2

        share = self%m_block/(self%m_wedge + self%m_block)
        associate (s => sin(self%alpha), c => cos(self%alpha))
            a1 = self%g*s/(self%m_wedge/(self%m_wedge + self%m_block) + share*s**2)
            a2 = -share*a1*c
        end associate
        call start_uniform_acceleration(motion, "q0 + v0 t + a t^2/2, a1 = g sin(alpha)/(1 - m "// &
                                        "cos(alpha)^2/(M + m)), a2 = -m/(M + m) a1 cos(alpha)", &
                                        t0, q0, v0, [a1, a2])
        allocate (reference, source=motion)
    end subroutine closed_form
end submodule lagrangia_wedge_reference
