module lagrangia_reduced
    !! A system without its cyclic coordinate, which its conserved momentum gives back (Routh).
    use lagrangia_kinds, only: dp
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: reduced_t

    type, abstract, extends(system_t) :: reduced_t
    contains
        procedure(leave_i), deferred :: leave
        procedure(complete_i), deferred :: complete
    end type reduced_t

    abstract interface
        pure subroutine leave_i(self, q, v, q_left, v_left)
            !! Note what the state `(q, v)` conserves; the state without the cyclic coordinate.
            import :: reduced_t, dp
            implicit none (type, external)
            class(reduced_t), intent(inout) :: self
            real(dp), intent(in) :: q(:), v(:)
            real(dp), intent(out) :: q_left(self%ndof), v_left(self%ndof)
        end subroutine leave_i

        pure subroutine complete_i(self, elapsed, q_left, v_left, q, v)
            !! The whole state at `elapsed` s after `leave`, by what that has noted. A time so short
            !! is a better number than that on the clock.
            import :: reduced_t, dp
            implicit none (type, external)
            class(reduced_t), intent(in) :: self
            real(dp), intent(in) :: elapsed, q_left(self%ndof), v_left(self%ndof)
            real(dp), intent(out) :: q(:), v(:)
        end subroutine complete_i
    end interface
end module lagrangia_reduced
