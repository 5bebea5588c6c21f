module lagrangia_lyapunov
    !! The largest Lyapunov exponent of a motion: the rate at which a small displacement grows,
    !! \(\lambda = \langle\ln|\delta(t)|\rangle/t\), with its uncertainty.
    !!
    !! The displacement obeys the linear equations along the motion,
    !! \(\ddot{\delta q} = \partial a/\partial q\,\delta q + \partial a/\partial v\,\delta v\), and
    !! has length 1 again after each interval. Source: Benettin, Galgani, Giorgilli & Strelcyn,
    !! Meccanica 15, 9 (1980).
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use lagrangia_description, only: description_t
    use lagrangia_errors, only: error_t, fail, status_numbers
    use lagrangia_hyperdual, only: hyperdual_t
    use lagrangia_integrator, only: dense_integrator_t
    use lagrangia_interrupt, only: interrupt_status
    use lagrangia_kinds, only: dp, i8, lanes
    use lagrangia_observer, only: observer_t
    use lagrangia_system, only: check_state, system_t
    use lagrangia_variational, only: new_variational, variational_t
    implicit none (type, external)
    private
    public :: displace, displaced_t, lyapunov_exponent, mean_rate, new_displaced
    public :: longest, shortest, windows

    integer, parameter :: windows = 16  !! whose scatter gives the uncertainty
    integer, parameter :: intervals = 8 !! in each window
    real(dp), parameter :: shortest = 0.1_dp, longest = 1e6_dp
    !! of a displacement before it is scaled to 1: errors are absolute below 1, and one that only
    !! grows would overflow

    type, extends(system_t) :: displaced_t
        !! A motion and a displacement of it, as one system of twice as many coordinates: first
        !! those of the motion, then their displacements.
        class(system_t), allocatable :: of
        type(variational_t) :: exact  !! how the accelerations change, where that is known
        real(dp) :: size = 1.0_dp     !! of the coordinates: how far is far
    contains
        procedure :: describe
        procedure :: configure
        procedure :: accelerations
        procedure :: accelerations_lanes
        procedure :: lagrangian
        procedure :: energy
    end type displaced_t

contains

    subroutine lyapunov_exponent(system, method, t0, after, t_end, q0, v0, exponent, uncertainty, &
                                 error, variational, watcher)
        !! The exponent of the motion through a state, measured from `after` to `t_end`. Its
        !! uncertainty is the standard error of the mean over 16 windows: what the window would
        !! change, not what is left of a motion that has not settled.
        class(system_t), intent(in) :: system                !! of any kind, without contacts
        class(dense_integrator_t), intent(inout) :: method   !! an adaptive one, with its tolerance
        real(dp), intent(in) :: t0, after, t_end             !! s, in this order
        real(dp), intent(in) :: q0(:), v0(:)                 !! the state at `t0`, (ndof)
        real(dp), intent(out) :: exponent, uncertainty       !! 1/s
        type(error_t), allocatable, intent(out) :: error
        !! the state has another size, the method refuses, or the motion diverges
        type(variational_t), intent(in), optional :: variational
        !! of a system like this one, perhaps with other parameters: it need not be derived again
        class(observer_t), intent(inout), optional :: watcher  !! hears how far it is
        type(displaced_t) :: displaced
        real(dp) :: q(2*size(q0)), v(2*size(v0)), finish, growth, start
        real(dp) :: rates(0:windows)  ! of each window; number 0 is before `after`
        integer(i8) :: steps
        integer :: i, k
        logical :: fits

        exponent = 0.0_dp
        uncertainty = 0.0_dp
        call check_state(system, q0, v0, error)
        if (system%contacts > 0) call fail(error, "no Lyapunov exponent is measured across impacts")
        if (allocated(error)) return
        call new_displaced(displaced, system, q0)
        if (present(variational)) displaced%exact = variational
        call displaced%exact%fits(system, fits)
        if (.not. fits) call new_variational(displaced%exact, system)
        call displace(q0, v0, after > t0, q, v)
        call method%prepare(displaced, error)
        if (allocated(error)) return
        start = t0
        steps = 0
        do k = 0, windows
            growth = 0.0_dp
            do i = 1, intervals
                if (k == 0) then
                    finish = t0 + i*(after - t0)/intervals
                else
                    finish = after + (t_end - after)*((k - 1)*intervals + i)/(windows*intervals)
                end if
                if (.not. finish > start) cycle
                call go_on()
                if (allocated(error)) return
                start = finish
            end do
            rates(k) = growth*windows/(t_end - after)
        end do
        call mean_rate(rates(1:), exponent, uncertainty)
    contains
        subroutine go_on()
            !! From `start` to `finish`, in steps of the method's own. The displacement has length 1
            !! again at the end, and on the way wherever it is not between `shortest` and `longest`.
            real(dp) :: length
            integer :: n

            n = system%ndof
            call method%start(displaced, start, q, v, finish)
            do
                call method%step(displaced, error)
                if (allocated(error)) return
                call method%state_at(method%t_new, q, v)
                length = norm2([q(n + 1:), v(n + 1:)])
                if (.not. (ieee_is_finite(length) .and. length > 0.0_dp)) then
                    call fail(error, "the displacement is lost: the motion diverges", &
                              status_numbers)
                    return
                end if
                steps = steps + 1
                call method%refuse_more(steps, t0, t_end, error)
                if (interrupt_status() /= 0) call fail(error, "interrupted", interrupt_status())
                if (allocated(error)) return
                if (present(watcher)) call watcher%tick_share((method%t_new - t0)/(t_end - t0))
                if (method%t_new < finish .and. length > shortest .and. length < longest) cycle
                growth = growth + log(length)
                q(n + 1:) = q(n + 1:)/length
                v(n + 1:) = v(n + 1:)/length
                if (method%t_new >= finish) return
                call method%start(displaced, method%t_new, q, v, finish)
            end do
        end subroutine go_on
    end subroutine lyapunov_exponent

    pure subroutine displace(q0, v0, settles, q, v)
        !! A state, and a displacement of it that lies in no plane of symmetry.
        real(dp), intent(in) :: q0(:), v0(:)    !! the state, (ndof)
        logical, intent(in) :: settles
        !! it has length 1 when the measuring begins; otherwise now
        real(dp), intent(out) :: q(:), v(:)     !! of a `displaced_t`, (2 ndof)
        real(dp) :: length
        integer :: i, n

        n = size(q0)
        q = [q0, [(1.0_dp/(i + 1), i=1, n)]]
        v = [v0, [((-1.0_dp)**i/(i + 2), i=1, n)]]
        if (settles) return
        length = norm2([q(n + 1:), v(n + 1:)])
        q(n + 1:) = q(n + 1:)/length
        v(n + 1:) = v(n + 1:)/length
    end subroutine displace

    pure subroutine mean_rate(rates, exponent, uncertainty)
        !! The exponent, from the rates of growth of all windows.
        real(dp), intent(in) :: rates(windows)      !! 1/s
        real(dp), intent(out) :: exponent           !! their mean, 1/s
        real(dp), intent(out) :: uncertainty        !! its standard error, 1/s

        exponent = sum(rates)/windows
        uncertainty = sqrt(sum((rates - exponent)**2)/(windows*(windows - 1.0_dp)))
    end subroutine mean_rate

    subroutine new_displaced(self, system, q0)
        !! The motion of `system` and a displacement. How far is far is told by the coordinates of
        !! the start; from 0, and for angles, it is 1.
        class(displaced_t), intent(out) :: self  !! by differences, until it has `exact`
        class(system_t), intent(in) :: system  !! with its parameters
        real(dp), intent(in) :: q0(:)          !! where the motion starts
        type(description_t) :: d

        allocate (self%of, source=system)
        self%ndof = 2*system%ndof
        self%velocity_forces = .true.
        self%time_dependent = system%time_dependent
        self%nonconservative = .true.
        call system%describe(d)
        if (any(d%coordinates%unit == "rad") .or. maxval(abs(q0)) <= 0.0_dp) return
        self%size = min(1.0_dp, maxval(abs(q0)))
    end subroutine new_displaced

    pure subroutine describe(self, d)
        !! See `system_t`.
        class(displaced_t), intent(in) :: self
        type(description_t), intent(out) :: d
        type(description_t) :: of

        call self%of%describe(of)
        d%name = of%name
        d%title = of%title
        d%coordinates = [of%coordinates, of%coordinates]
    end subroutine describe

    pure subroutine configure(self, values, error)
        !! See `system_t`.
        class(displaced_t), intent(inout) :: self
        real(dp), intent(in) :: values(:)
        type(error_t), allocatable, intent(out) :: error

        call self%of%configure(values, error)
    end subroutine configure

    pure subroutine accelerations(self, t, q, v, a)
        !! Those of the motion, and their derivative along the displacement \(\delta\): exact, or,
        !! where the Lagrangian is not known as a formula, by central differences at
        !! \(\pm h\delta\), \(h|\delta| = \epsilon^{1/3}\) of the coordinates' size: right to
        !! about \(\epsilon^{2/3}\), 4e-11.
        class(displaced_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp), intent(out) :: a(self%ndof)
        real(dp), dimension(self%ndof/2) :: q0, v0, dq, dv, forward, backward
        real(dp) :: h
        integer :: n

        n = self%ndof/2
        q0 = q(:n)
        v0 = v(:n)
        dq = q(n + 1:)
        dv = v(n + 1:)
        call self%of%accelerations(t, q0, v0, forward)
        a(:n) = forward
        if (self%exact%known) then
            call self%exact%change(t, q0, v0, dq, dv, forward)
            a(n + 1:) = forward
            return
        end if
        h = self%size*epsilon(h)**(1.0_dp/3.0_dp)/max(norm2([dq, dv]), tiny(h))
        call self%of%accelerations(t, q0 + h*dq, v0 + h*dv, forward)
        call self%of%accelerations(t, q0 - h*dq, v0 - h*dv, backward)
        a(n + 1:) = (forward - backward)/(2.0_dp*h)
    end subroutine accelerations

    pure subroutine accelerations_lanes(self, t, q, v, a)
        !! `accelerations`, in all lanes at once.
        class(displaced_t), intent(in) :: self
        real(dp), intent(in) :: t(lanes), q(lanes, self%ndof), v(lanes, self%ndof)
        real(dp), intent(out) :: a(lanes, self%ndof)
        integer :: n

        n = self%ndof/2
        call self%of%accelerations_lanes(t, q(:, :n), v(:, :n), a(:, :n))
        if (self%exact%known) then
            call self%exact%change_lanes(t, q(:, :n), v(:, :n), q(:, n + 1:), v(:, n + 1:), &
                                         a(:, n + 1:))
        else
            call differences(self, n, t, q, v, a(:, n + 1:))
        end if
    end subroutine accelerations_lanes

    pure subroutine differences(self, n, t, q, v, change)
        !! The derivative by central differences, in lanes. Its arrays take memory, which costs as
        !! much as an evaluation where it is not needed.
        class(displaced_t), intent(in) :: self
        integer, intent(in) :: n
        real(dp), intent(in) :: t(lanes), q(lanes, 2*n), v(lanes, 2*n)
        real(dp), intent(out) :: change(lanes, n)
        real(dp), dimension(lanes, n) :: backward, forward, step_q, step_v
        real(dp) :: h(lanes)
        integer :: i

        do i = 1, lanes
            h(i) = self%size*epsilon(h)**(1.0_dp/3.0_dp) &
                   /max(norm2([q(i, n + 1:), v(i, n + 1:)]), tiny(h))
            step_q(i, :) = h(i)*q(i, n + 1:)
            step_v(i, :) = h(i)*v(i, n + 1:)
        end do
        call self%of%accelerations_lanes(t, q(:, :n) + step_q, v(:, :n) + step_v, forward)
        call self%of%accelerations_lanes(t, q(:, :n) - step_q, v(:, :n) - step_v, backward)
        do i = 1, n
            change(:, i) = (forward(:, i) - backward(:, i))/(2.0_dp*h)
        end do
    end subroutine differences

    pure function lagrangian(self, t, q, v) result(l)
        !! See `system_t`: the displacement has none that is needed.
        class(displaced_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof), v(self%ndof)
        type(hyperdual_t) :: l

        l = self%of%lagrangian(t, q(:self%of%ndof), v(:self%of%ndof))
    end function lagrangian

    pure function energy(self, t, q, v) result(e)
        !! See `system_t`: of the motion.
        class(displaced_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp) :: e

        e = self%of%energy(t, q(:self%of%ndof), v(:self%of%ndof))
    end function energy
end module lagrangia_lyapunov
