module recorder
    !! An observer that keeps all that it sees.
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp
    use lagrangia_observer, only: observer_t
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: recorder_t

    integer, parameter :: room = 20000

    type, extends(observer_t) :: recorder_t
        integer :: samples = 0, events = 0
        real(dp), allocatable :: t(:), q(:), v(:)  !! of the first coordinate
        integer, allocatable :: event(:)
        real(dp), allocatable :: event_t(:), event_q(:), event_v(:)
    contains
        procedure :: observe
        procedure :: meet
    end type recorder_t

contains

    subroutine observe(self, system, t, q, v, error)
        class(recorder_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t, q(system%ndof), v(system%ndof)
        type(error_t), allocatable, intent(out) :: error

        if (.not. allocated(self%t)) then  ! the first sample comes before any event
            allocate (self%t(room), source=0.0_dp)
            allocate (self%event(room), source=0)
            self%q = self%t
            self%v = self%t
            self%event_t = self%t
            self%event_q = self%t
            self%event_v = self%t
        end if
        self%samples = self%samples + 1
        self%t(self%samples) = t
        self%q(self%samples) = q(1)
        self%v(self%samples) = v(1)
    end subroutine observe

    subroutine meet(self, system, event, t, q, v, error)
        class(recorder_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        integer, intent(in) :: event
        real(dp), intent(in) :: t, q(system%ndof), v(system%ndof)
        type(error_t), allocatable, intent(out) :: error

        self%events = self%events + 1
        self%event(self%events) = event
        self%event_t(self%events) = t
        self%event_q(self%events) = q(1)
        self%event_v(self%events) = v(1)
    end subroutine meet
end module recorder
