module lagrangia_gyrating_system
    !! A system whose velocities turn about an axis, as a charge does in a magnetic field:
    !! $$ \dot v = a(t, q) + v\times\omega(t, q) $$ in three Cartesian coordinates.
    !!
    !! A capability by extension: methods that turn the velocity exactly ask for this type.
    use lagrangia_kinds, only: dp
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: gyrating_system_t

    type, abstract, extends(system_t) :: gyrating_system_t
    contains
        procedure(split_accelerations_i), deferred :: split_accelerations
    end type gyrating_system_t

    abstract interface
        pure subroutine split_accelerations_i(self, t, q, a, omega)
            !! What does not depend on the velocity, \(a\), and the rate of turning, \(\omega\).
            import :: gyrating_system_t, dp
            implicit none (type, external)
            class(gyrating_system_t), intent(in) :: self
            real(dp), intent(in) :: t, q(3)    !! time, s; position, m
            real(dp), intent(out) :: a(3)      !! m s^-2
            real(dp), intent(out) :: omega(3)  !! rad s^-1
        end subroutine split_accelerations_i
    end interface
end module lagrangia_gyrating_system
