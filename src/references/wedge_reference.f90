module lagrangia_wedge_reference
    !! The block on the wedge in closed form.
    use lagrangia_kinds, only: dp
    use lagrangia_uniform_acceleration, only: start_uniform_acceleration, uniform_acceleration_t
    use lagrangia_wedge, only: wedge_t
    implicit none (type, external)
    private
    public :: wedge_reference_t, new_wedge_reference

    type, extends(uniform_acceleration_t) :: wedge_reference_t
    end type wedge_reference_t

contains

    pure subroutine new_wedge_reference(self, system, t0, q0, v0, found)
        !! Covers every initial state. As the notes state it,
        !! $$ \ddot q_1 = \frac{g\sin\alpha}{1 - m\cos^2\alpha/(M+m)},\quad
        !!    \ddot q_2 = -\frac{m}{M+m}\,\ddot q_1\cos\alpha. $$
        !! The denominator loses digits where \(M \ll m\) and \(\alpha\) is small; it is written
        !! as \((M + m\sin^2\alpha)/(M+m)\).
        type(wedge_reference_t), intent(out) :: self
        type(wedge_t), intent(in) :: system
        real(dp), intent(in) :: t0, q0(:), v0(:)
        logical, intent(out) :: found
        real(dp) :: share, a1, a2

        found = .true.
        share = system%m_block/(system%m_wedge + system%m_block)
        associate (s => sin(system%alpha), c => cos(system%alpha))
            a1 = system%g*s/(system%m_wedge/(system%m_wedge + system%m_block) + share*s**2)
            a2 = -share*a1*c
        end associate
        call start_uniform_acceleration(self, "q0 + v0 t + a t^2/2, a1 = g sin(alpha)/(1 - m "// &
                                        "cos(alpha)^2/(M + m)), a2 = -m/(M + m) a1 cos(alpha)", &
                                        t0, q0, v0, [a1, a2])
    end subroutine new_wedge_reference
end module lagrangia_wedge_reference
