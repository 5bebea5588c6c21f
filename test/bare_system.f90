module bare_system
    !! What the systems of tests have in common: all but their accelerations is not wanted.
    use lagrangia_description, only: description_t
    use lagrangia_hyperdual, only: hyperdual_t
    use lagrangia_kinds, only: dp
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: bare_system_t

    type, abstract, extends(system_t) :: bare_system_t
    contains
        procedure :: describe
        procedure :: lagrangian
        procedure :: energy
    end type bare_system_t

contains

    pure subroutine describe(self, d)
        !! A name is enough.
        class(bare_system_t), intent(in) :: self
        type(description_t), intent(out) :: d

        d%name = "bare"
    end subroutine describe

    pure function lagrangian(self, t, q, v) result(l)
        !! Not wanted.
        class(bare_system_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof), v(self%ndof)
        type(hyperdual_t) :: l

        l = hyperdual_t()
    end function lagrangian

    pure function energy(self, t, q, v) result(e)
        !! Not wanted, where a system does not say otherwise.
        class(bare_system_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp) :: e

        e = 0.0_dp
    end function energy
end module bare_system
