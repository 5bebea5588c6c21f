module run_doubles
    !! Stand-ins for tests of runs: an observer that remembers, a system that explodes.
    use lagrangia_description, only: description_t
    use lagrangia_errors, only: error_t, fail
    use lagrangia_hyperdual, only: hyperdual_t
    use lagrangia_integrator, only: dense_integrator_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_observer, only: observer_t
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: exploding_t, watcher_t

    type, extends(observer_t) :: watcher_t
        !! Remembers every sample and event, and when each step ended if it is to; fails at sample
        !! number `patience`.
        integer :: patience = huge(1)
        logical :: every_step = .false.
        integer :: samples = 0
        integer(i8) :: done = 0                     !! steps, from the latest tick
        real(dp), allocatable :: times(:)
        real(dp), allocatable :: q(:, :), v(:, :)   !! `(ndof, samples)`
        real(dp), allocatable :: followed(:)        !! times of steps, s
        real(dp), allocatable :: met(:)             !! times of events, s
        integer, allocatable :: events(:)           !! their numbers
    contains
        procedure :: observe
        procedure :: follows
        procedure :: follow
        procedure :: follow_inside
        procedure :: meet
        procedure :: tick
    end type watcher_t

    type, extends(system_t) :: exploding_t
        !! \(\ddot x = \dot x^2\), which from \(\dot x = 1\) is infinite at \(t = 1\).
    contains
        procedure :: describe
        procedure :: configure
        procedure :: accelerations
        procedure :: lagrangian
        procedure :: energy
    end type exploding_t

contains

    subroutine observe(self, system, t, q, v, error)
        !! See `observer_t`.
        class(watcher_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t, q(system%ndof), v(system%ndof)
        type(error_t), allocatable, intent(out) :: error
        integer :: n

        n = system%ndof
        if (self%samples == 0) allocate (self%times(0), self%q(n, 0), self%v(n, 0))
        self%samples = self%samples + 1
        self%times = [self%times, t]
        self%q = reshape([self%q, q], [n, self%samples])
        self%v = reshape([self%v, v], [n, self%samples])
        if (self%samples >= self%patience) call fail(error, "seen enough")
    end subroutine observe

    pure function follows(self)
        !! See `observer_t`.
        class(watcher_t), intent(in) :: self
        logical :: follows

        follows = self%every_step
    end function follows

    subroutine follow(self, system, t, q, v)
        !! See `observer_t`.
        class(watcher_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t, q(system%ndof), v(system%ndof)

        if (.not. allocated(self%followed)) allocate (self%followed(0))
        self%followed = [self%followed, t]
    end subroutine follow

    subroutine follow_inside(self, method, t)
        !! See `observer_t`.
        class(watcher_t), intent(inout) :: self
        class(dense_integrator_t), intent(in) :: method
        real(dp), intent(in) :: t

        if (.not. allocated(self%followed)) allocate (self%followed(0))
        self%followed = [self%followed, t]
    end subroutine follow_inside

    subroutine meet(self, system, event, t, q, v, error)
        !! See `observer_t`.
        class(watcher_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        integer, intent(in) :: event
        real(dp), intent(in) :: t, q(system%ndof), v(system%ndof)
        type(error_t), allocatable, intent(out) :: error

        if (.not. allocated(self%met)) allocate (self%met(0), self%events(0))
        self%met = [self%met, t]
        self%events = [self%events, event]
    end subroutine meet

    subroutine tick(self, done, steps)
        !! See `observer_t`.
        class(watcher_t), intent(inout) :: self
        integer(i8), intent(in) :: done, steps

        self%done = done
    end subroutine tick

    pure subroutine describe(self, d)
        !! Enough for a message.
        class(exploding_t), intent(in) :: self
        type(description_t), intent(out) :: d

        d%name = "exploding"
    end subroutine describe

    pure subroutine configure(self, values, error)
        !! There is nothing to configure.
        class(exploding_t), intent(inout) :: self
        real(dp), intent(in) :: values(:)
        type(error_t), allocatable, intent(out) :: error
    end subroutine configure

    pure subroutine accelerations(self, t, q, v, a)
        !! See the type.
        class(exploding_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp), intent(out) :: a(self%ndof)

        a = v**2
    end subroutine accelerations

    pure function lagrangian(self, t, q, v) result(l)
        !! Nobody asks.
        class(exploding_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof), v(self%ndof)
        type(hyperdual_t) :: l

        l = hyperdual_t()
    end function lagrangian

    pure function energy(self, t, q, v) result(e)
        !! Nobody asks.
        class(exploding_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp) :: e

        e = 0.0_dp
    end function energy
end module run_doubles
