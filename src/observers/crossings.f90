module lagrangia_crossings
    !! Where, within the steps of a dense method, events happen.
    use lagrangia_errors, only: error_t
    use lagrangia_events, only: event_box_t, event_t
    use lagrangia_integrator, only: dense_integrator_t
    use lagrangia_kinds, only: dp
    use lagrangia_roots, only: find_root, scalar_function_t
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: watch_t

    integer, parameter :: places = 8  !! in a step where signs are looked at

    type :: watch_t
        !! Walks along the steps and stops at each event.
        integer :: which = 0                       !! the event that was met; 0: none in this step
        real(dp) :: t = 0.0_dp                     !! where, s
        real(dp), allocatable :: q(:), v(:)        !! and in which state
        integer, allocatable, private :: side(:)   !! sign of each function, 0: not known yet
        real(dp), allocatable, private :: seen(:)  !! latest time with that sign, s
        integer, private :: place = 0              !! of the step, up to which all is done
        real(dp), allocatable, private :: found(:) !! crossings up to the next place, s; or later
    contains
        procedure :: start
        procedure :: next
        procedure, private :: look
    end type watch_t

    type, extends(scalar_function_t) :: along_step_t
        !! An event's function along the dense output.
        class(event_t), pointer :: event => null()
        class(dense_integrator_t), pointer :: method => null()
        class(system_t), pointer :: system => null()
        real(dp), allocatable :: q(:), v(:)
    contains
        procedure :: value
    end type along_step_t

contains

    function value(self, x) result(y)
        !! The event's function at time `x`.
        class(along_step_t), intent(inout) :: self
        real(dp), intent(in) :: x
        real(dp) :: y

        call self%method%state_at(x, self%q, self%v)
        y = self%event%value(self%system, x, self%q, self%v)
    end function value

    subroutine start(self, events, system, t, q, v)
        !! Begin at a state: at the start of a run, and after an impact.
        class(watch_t), intent(inout) :: self
        type(event_box_t), intent(inout) :: events(:)  !! their functions are evaluated
        class(system_t), intent(in) :: system  !! whose motion it is
        real(dp), intent(in) :: t, q(system%ndof), v(system%ndof)  !! s; coordinates, velocities
        integer :: i

        self%side = [(sign_of(events(i)%item%value(system, t, q, v)), i=1, size(events))]
        self%seen = spread(t, 1, size(events))
        self%found = spread(huge(t), 1, size(events))
        self%q = q
        self%v = v
        self%which = 0
        self%place = 0
    end subroutine start

    pure function sign_of(x) result(s)
        !! -1, 0 or 1; NaN has none.
        real(dp), intent(in) :: x
        integer :: s

        s = merge(1, 0, x > 0.0_dp) - merge(1, 0, x < 0.0_dp)
    end function sign_of

    subroutine next(self, events, system, method, error)
        !! Go on to the next event in the latest step of `method`, or to its end (`which = 0`).
        class(watch_t), intent(inout) :: self
        type(event_box_t), target, intent(inout) :: events(:)  !! those of `start`
        class(system_t), target, intent(in) :: system  !! that of `start`
        class(dense_integrator_t), target, intent(in) :: method  !! its latest step is searched
        type(error_t), allocatable, intent(out) :: error  !! no root was found where a sign changes
        real(dp) :: t

        self%which = 0
        do
            if (any(self%found < huge(t))) then
                self%which = minloc(self%found, 1)
                self%t = self%found(self%which)
                self%found(self%which) = huge(t)
                call method%state_at(self%t, self%q, self%v)
                return
            end if
            if (self%place == places) exit
            self%place = self%place + 1
            t = method%t_old + self%place*(method%t_new - method%t_old)/places
            if (self%place == places) t = method%t_new
            call self%look(events, system, method, t, error)
            if (allocated(error)) return
        end do
        self%place = 0
    end subroutine next

    subroutine look(self, events, system, method, t, error)
        !! Find what happens up to `t`.
        class(watch_t), intent(inout) :: self
        type(event_box_t), target, intent(inout) :: events(:)
        class(system_t), target, intent(in) :: system
        class(dense_integrator_t), target, intent(in) :: method
        real(dp), intent(in) :: t
        type(error_t), allocatable, intent(out) :: error
        type(along_step_t) :: f
        real(dp) :: from, root
        integer :: i, now

        f%method => method
        f%system => system
        f%q = self%q
        f%v = self%v
        do i = 1, size(events)
            f%event => events(i)%item
            now = sign_of(f%value(t))
            if (now == 0) cycle
            from = max(self%seen(i), method%t_old)
            if (self%side(i) == 0 .and. now < 0 .and. events(i)%item%one_sided) then
                call leave_zero(f, method%t_old, t, from)
                self%side(i) = 1
            end if
            if (now*self%side(i) < 0 .and. now*events(i)%item%direction >= 0) then
                call find_root(f, from, t, root, error)
                if (allocated(error)) return
                self%found(i) = root
            end if
            self%side(i) = now
            self%seen(i) = t
        end do
    end subroutine look

    subroutine leave_zero(f, start, t, from)
        !! Of a function that is zero at `start` and negative at `t`: a time `from` between them
        !! where it is positive, or `start` if it is nowhere.
        class(along_step_t), intent(inout) :: f
        real(dp), intent(in) :: start, t
        real(dp), intent(out) :: from

        from = t
        do
            from = start + 0.5_dp*(from - start)
            if (from <= start) exit
            if (f%value(from) > 0.0_dp) return
            if (from - start <= spacing(start)) exit
        end do
        from = start
    end subroutine leave_zero
end module lagrangia_crossings
