module lagrangia_reference
    !! The contract of a closed form: what a trajectory must be.
    use lagrangia_kinds, only: dp
    implicit none (type, external)
    private
    public :: reference_t

    type, abstract :: reference_t
        character(200) :: title = ""  !! which closed form, and its source
        integer :: ndof = 0
        logical :: has_state = .true.      !! `state_at` is known; otherwise only the period
        real(dp) :: period = 0.0_dp        !! s; 0 where none is known
        real(dp) :: small_period = 0.0_dp  !! of small oscillations, s; 0 where none is known
    contains
        procedure(state_at_i), deferred :: state_at
    end type reference_t

    abstract interface
        pure subroutine state_at_i(self, t, q, v)
            !! The state at any time, before or after the start.
            import :: reference_t, dp
            implicit none (type, external)
            class(reference_t), intent(in) :: self
            real(dp), intent(in) :: t              !! s
            real(dp), intent(out) :: q(self%ndof)  !! coordinates then
            real(dp), intent(out) :: v(self%ndof)  !! velocities then
        end subroutine state_at_i
    end interface
end module lagrangia_reference
