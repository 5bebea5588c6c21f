module lagrangia_crossings
    !! Where, within the steps of a dense method, events happen.
    !!
    !! A change of sign between two of nine places of a step is one; and where the function comes
    !! near to zero between two places and goes beyond it, there are two.
    use lagrangia_dips, only: find_dip, may_dip
    use lagrangia_errors, only: error_t
    use lagrangia_events, only: event_box_t, event_t
    use lagrangia_integrator, only: dense_integrator_t
    use lagrangia_kinds, only: dp
    use lagrangia_roots, only: find_root, scalar_function_t
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: watch_t

    integer, parameter :: places = 8  !! in a step where signs are looked at, and its beginning
    real(dp), parameter :: shallow = 1e-8_dp
    !! how far beyond zero is the error of the motion: of the largest value

    type :: watch_t
        !! Walks along the steps and stops at each event.
        integer :: which = 0                       !! the event that was met; 0: none in this step
        real(dp) :: t = 0.0_dp                     !! where, s
        real(dp), allocatable :: q(:), v(:)        !! and in which state
        integer, allocatable, private :: side(:)   !! sign of each function, 0: not known yet
        real(dp), allocatable, private :: seen(:)  !! latest time with that sign, s
        integer, private :: place = 0              !! of the step, up to which all is done
        real(dp), allocatable, private :: found(:) !! crossings up to the next place, s; or later
        real(dp), allocatable, private :: back(:)  !! and those behind them
        real(dp), allocatable, private :: values(:, :)  !! at the places of the step, each event's
        real(dp), allocatable, private :: largest(:)    !! of each, so far
    contains
        procedure :: start
        procedure :: next
        procedure, private :: look_ahead
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
        self%back = self%found
        self%largest = spread(0.0_dp, 1, size(events))
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

        self%which = 0
        do
            if (any(self%found < huge(self%t))) then
                self%which = minloc(self%found, 1)
                self%t = self%found(self%which)
                self%found(self%which) = self%back(self%which)
                self%back(self%which) = huge(self%t)
                call method%state_at(self%t, self%q, self%v)
                return
            end if
            if (self%place == places) exit
            if (self%place == 0) call self%look_ahead(events, system, method)
            self%place = self%place + 1
            call self%look(events, system, method, error)
            if (allocated(error)) return
        end do
        self%place = 0
    end subroutine next

    pure function time_of(method, place) result(t)
        !! Of a place in the latest step, s.
        class(dense_integrator_t), intent(in) :: method
        integer, intent(in) :: place
        real(dp) :: t

        t = method%t_old + place*(method%t_new - method%t_old)/places
        if (place == places) t = method%t_new
    end function time_of

    subroutine look_ahead(self, events, system, method)
        !! The functions at all places of the step.
        class(watch_t), intent(inout) :: self
        type(event_box_t), target, intent(inout) :: events(:)
        class(system_t), target, intent(in) :: system
        class(dense_integrator_t), target, intent(in) :: method
        real(dp) :: q(system%ndof), t, v(system%ndof)
        integer :: i, k

        if (.not. allocated(self%values)) allocate (self%values(0:places, size(events)))
        do k = 0, places
            t = time_of(method, k)
            call method%state_at(t, q, v)
            do i = 1, size(events)
                self%values(k, i) = events(i)%item%value(system, t, q, v)
            end do
        end do
        self%largest = max(self%largest, maxval(abs(self%values), 1))
    end subroutine look_ahead

    subroutine look(self, events, system, method, error)
        !! Find what happens up to the place.
        class(watch_t), intent(inout) :: self
        type(event_box_t), target, intent(inout) :: events(:)
        class(system_t), target, intent(in) :: system
        class(dense_integrator_t), target, intent(in) :: method
        type(error_t), allocatable, intent(out) :: error
        type(along_step_t) :: f
        real(dp) :: from, root, t
        integer :: i, now

        f%method => method
        f%system => system
        f%q = self%q
        f%v = self%v
        t = time_of(method, self%place)
        do i = 1, size(events)
            f%event => events(i)%item
            now = sign_of(self%values(self%place, i))
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
            else if (now == self%side(i) .and. may_dip(now*self%values(:, i), self%place)) then
                call graze(i)
                if (allocated(error)) return
            end if
            self%side(i) = now
            self%seen(i) = t
        end do
    contains
        subroutine graze(i)
            !! Both crossings, where the function goes beyond zero and comes back.
            integer, intent(in) :: i
            logical :: beyond
            real(dp) :: deepest

            call find_dip(f, from, t, now, shallow*self%largest(i), deepest, beyond)
            if (.not. beyond) return
            if (now*events(i)%item%direction <= 0) call find_root(f, from, deepest, self%found(i), &
                                                                  error)
            if (allocated(error) .or. now*events(i)%item%direction < 0) return
            call find_root(f, deepest, t, root, error)
            if (self%found(i) < huge(root)) then
                self%back(i) = root
            else
                self%found(i) = root
            end if
        end subroutine graze
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
            if (f%value(from) > 0.0_dp) return
            if (from - start <= spacing(start)) exit
        end do
        from = start
    end subroutine leave_zero
end module lagrangia_crossings
