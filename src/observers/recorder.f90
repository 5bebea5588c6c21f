module lagrangia_recorder
    !! The observer that keeps every sample and every event of a run, in arrays that grow.
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp
    use lagrangia_observer, only: observer_t
    use lagrangia_resources, only: check_memory
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: recorder_t

    integer, parameter :: first_room = 64  !! columns of the arrays at first; doubled as needed

    type, extends(observer_t) :: recorder_t
        !! The arrays may be longer than what was recorded: only their first `samples` or `events`
        !! columns count. Setting these to zero forgets what was recorded.
        integer :: samples = 0                                   !! recorded so far
        real(dp), allocatable :: t(:)                            !! s, (samples)
        real(dp), allocatable :: q(:, :), v(:, :)                !! (ndof, samples)
        integer :: events = 0                                    !! recorded so far
        integer, allocatable :: event(:)                         !! which of the run's events it was
        real(dp), allocatable :: event_t(:)                      !! s, (events)
        real(dp), allocatable :: event_q(:, :), event_v(:, :)    !! (ndof, events)
    contains
        procedure :: observe
        procedure :: meet
    end type recorder_t

contains

    subroutine observe(self, system, t, q, v, error)
        !! See `observer_t`. Fails (status 4) where the memory does not hold another sample.
        class(recorder_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t, q(system%ndof), v(system%ndof)
        type(error_t), allocatable, intent(out) :: error

        call make_room(self%samples, system%ndof, self%t, self%q, self%v, error)
        if (allocated(error)) return
        self%samples = self%samples + 1
        self%t(self%samples) = t
        self%q(:, self%samples) = q
        self%v(:, self%samples) = v
    end subroutine observe

    subroutine meet(self, system, event, t, q, v, error)
        !! See `observer_t`. Fails (status 4) where the memory does not hold another event.
        class(recorder_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        integer, intent(in) :: event
        real(dp), intent(in) :: t, q(system%ndof), v(system%ndof)
        type(error_t), allocatable, intent(out) :: error
        integer, allocatable :: numbers(:)

        call make_room(self%events, system%ndof, self%event_t, self%event_q, self%event_v, error)
        if (allocated(error)) return
        if (.not. allocated(self%event)) allocate (self%event(0))
        if (size(self%event) < size(self%event_t)) then
            allocate (numbers(size(self%event_t)))
            numbers(:self%events) = self%event(:self%events)
            call move_alloc(numbers, self%event)
        end if
        self%events = self%events + 1
        self%event(self%events) = event
        self%event_t(self%events) = t
        self%event_q(:, self%events) = q
        self%event_v(:, self%events) = v
    end subroutine meet

    subroutine make_room(count, ndof, t, q, v, error)
        !! Arrays with room for one state more than `count`, twice as long where they must grow.
        integer, intent(in) :: count, ndof
        real(dp), allocatable, intent(inout) :: t(:), q(:, :), v(:, :)
        type(error_t), allocatable, intent(out) :: error
        real(dp), allocatable :: longer(:), wider(:, :)
        integer :: room

        room = 0
        if (allocated(t)) room = size(t)
        if (count < room) return
        room = max(first_room, 2*room)
        call check_memory(8.0_dp*room*(2*ndof + 1), "a record of so many states", error)
        if (allocated(error)) return
        allocate (longer(room))
        if (count > 0) longer(:count) = t(:count)
        call move_alloc(longer, t)
        call widen(q)
        call widen(v)
    contains
        subroutine widen(states)
            real(dp), allocatable, intent(inout) :: states(:, :)

            allocate (wider(ndof, room))
            if (count > 0) wider(:, :count) = states(:, :count)
            call move_alloc(wider, states)
        end subroutine widen
    end subroutine make_room
end module lagrangia_recorder
