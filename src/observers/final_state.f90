module lagrangia_final_state
    !! The observer that keeps the latest sample, which is the final state when the run has ended,
    !! and how large each number of the state has been.
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_observer, only: observer_t
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: final_state_t

    type, extends(observer_t) :: final_state_t
        integer(i8) :: samples = 0                 !! seen so far
        integer(i8) :: events = 0                  !! met so far
        real(dp) :: t = 0.0_dp                     !! of the latest sample, s
        real(dp), allocatable :: q(:), v(:)        !! that sample; absent: there was none
        real(dp), allocatable :: q_most(:), v_most(:)  !! the largest magnitudes so far
        real(dp), allocatable :: t_slow(:)
        !! of each speed the last sample before it first came to half of its largest, s
        real(dp), allocatable, private :: half(:)  !! speeds that did so, or more
    contains
        procedure :: observe
        procedure :: meet
    end type final_state_t

contains

    subroutine observe(self, system, t, q, v, error)
        !! See `observer_t`. Never fails.
        class(final_state_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t, q(system%ndof), v(system%ndof)
        type(error_t), allocatable, intent(out) :: error

        if (.not. allocated(self%q)) then
            self%t = t
            allocate (self%q_most, source=abs(q))
            allocate (self%v_most, source=abs(v))
            allocate (self%half, source=abs(v))
            allocate (self%t_slow(system%ndof), source=t)
        end if
        where (abs(v) > 2.0_dp*self%half)
            self%half = abs(v)
            self%t_slow = self%t
        end where
        self%samples = self%samples + 1
        self%t = t
        self%q = q
        self%v = v
        self%q_most = max(self%q_most, abs(q))
        self%v_most = max(self%v_most, abs(v))
    end subroutine observe

    subroutine meet(self, system, event, t, q, v, error)
        !! See `observer_t`. Never fails.
        class(final_state_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        integer, intent(in) :: event
        real(dp), intent(in) :: t, q(system%ndof), v(system%ndof)
        type(error_t), allocatable, intent(out) :: error

        self%events = self%events + 1
    end subroutine meet
end module lagrangia_final_state
