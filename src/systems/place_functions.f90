module lagrangia_place_functions
    !! Functions of the coordinates, in the formulas of a system, that act in one place only: a thin
    !! wall, a narrow well. A long step goes over it without a sign, since none of its stages may
    !! lie there; what they are functions of is smooth, and tells that a place was passed.
    use lagrangia_derivative, only: derivative
    use lagrangia_expression, only: expression_t, operator(*), operator(+), symbol
    use lagrangia_formula_program, only: formula_program_t, new_formula_program
    use lagrangia_hermite, only: cubic
    use lagrangia_kinds, only: dp
    use lagrangia_time_functions, only: falls_slowly, kink, look_at, peak, switch
    implicit none (type, external)
    private
    public :: new_place_functions, place_functions_t

    real(dp), parameter :: deep = 3.0_dp   !! exp(-deep) beside a peak's 1 is nearly nothing
    real(dp), parameter :: faint = -45.0_dp  !! exp(faint) beside 1 is nothing
    real(dp), parameter :: changes = 2.0_dp  !! of an argument over a step, so that it is looked at
    integer, parameter :: looks = 8          !! parts of a step
    integer, parameter :: rates = 1  !! program of the rates of change of all arguments by motion
    integer, parameter :: both = 2   !! program of the arguments and these rates
    real(dp), parameter :: bent = 1.0_dp/32.0_dp  !! a quarter of what bends a path in its middle

    type :: path_t
        !! From one state to another: a cubic.
        real(dp) :: t_old = 0.0_dp, t = 0.0_dp       !! s
        real(dp), allocatable :: q_old(:), v_old(:)  !! state at its start
        real(dp), allocatable :: q(:), v(:)          !! and at its end
    contains
        procedure :: divide
    end type path_t

    type :: place_functions_t
        !! None until `new_place_functions` has been called.
        integer :: count = 0
        logical, allocatable, private :: switches(:)  !! about a zero of the argument, not a maximum
        real(dp), allocatable, private :: least(:)  !! argument at which a function may be seen
        type(formula_program_t), allocatable, private :: programs(:)  !! of `rates`, and of `both`
        real(dp), private :: t_known = huge(1.0_dp)           !! end of the latest step, s
        real(dp), allocatable, private :: rates_known(:)      !! at that end
    contains
        procedure :: try_step
        procedure, private :: steps_over
        procedure, private :: climb
        procedure, private :: look
        procedure, private :: look_along
    end type place_functions_t

contains

    pure subroutine new_place_functions(self, lagrangian, forces, constraints, values, n)
        !! Those of all formulas of a system whose arguments have coordinates and no velocities.
        type(place_functions_t), intent(out) :: self  !! is made anew
        type(expression_t), intent(in) :: lagrangian  !! of the time, coordinates, velocities
        type(expression_t), intent(in) :: forces(:)   !! beside it
        type(expression_t), intent(in) :: constraints(:)  !! that are 0
        real(dp), intent(in) :: values(:)  !! of all symbols: those of parameters count
        integer, intent(in) :: n           !! coordinates
        type(expression_t), allocatable :: all(:), arguments(:)
        logical, allocatable :: switches(:)
        real(dp), allocatable :: least(:)
        logical :: fixed(size(values))
        integer :: i, k, found

        found = lagrangian%count + sum(forces%count) + sum(constraints%count)  ! no more than these
        allocate (arguments(found), switches(found), least(found))
        found = 0
        call look_through(lagrangian, n, found, arguments, switches, least)
        do i = 1, size(forces)
            call look_through(forces(i), n, found, arguments, switches, least)
        end do
        do i = 1, size(constraints)
            call look_through(constraints(i), n, found, arguments, switches, least)
        end do
        self%count = found
        if (found == 0) return
        self%switches = switches(:found)
        self%least = least(:found)
        allocate (all(2*found))
        do i = 1, found
            all(i) = arguments(i)
            all(found + i) = derivative(arguments(i), 1)
            do k = 1, n
                all(found + i) = all(found + i) + derivative(arguments(i), 1 + k)*symbol(1 + n + k)
            end do
        end do
        fixed = .true.
        fixed(:1 + 2*n) = .false.
        allocate (self%programs(both), self%rates_known(found))
        self%rates_known = 0.0_dp
        call new_formula_program(self%programs(rates), all(found + 1:), 1 + 2*n, fixed, values)
        call new_formula_program(self%programs(both), all, 1 + 2*n, fixed, values)
    end subroutine new_place_functions

    pure subroutine look_through(formula, n, found, arguments, switches, least)
        !! Put those of a formula behind the others. At a kink both sides differ, so that a step
        !! over it is seen.
        type(expression_t), intent(in) :: formula
        integer, intent(in) :: n
        integer, intent(inout) :: found
        type(expression_t), intent(inout) :: arguments(:)
        logical, intent(inout) :: switches(:)
        real(dp), intent(inout) :: least(:)
        type(expression_t) :: argument
        integer :: j, k, kind

        do k = 1, formula%count
            call look_at(formula, k, argument, kind)
            if (kind == 0 .or. kind == kink) cycle
            if (.not. any([(argument%depends_on(1 + j), j=1, n)])) cycle
            if (any([(argument%depends_on(1 + n + j), j=1, n)])) cycle
            found = found + 1
            arguments(found) = argument
            switches(found) = kind == switch
            least(found) = faint
            if (kind == peak .and. falls_slowly(formula, k)) least(found) = -huge(faint)
        end do
    end subroutine look_through

    pure subroutine try_step(self, t_old, q_old, v_old, t, q, v, over)
        !! Has a step gone over a place where a function acts? Arguments that hardly change over it
        !! need no second look. It allocates: to be called where there are functions.
        class(place_functions_t), intent(inout) :: self  !! knows the end of the step before
        real(dp), intent(in) :: t_old, q_old(:), v_old(:)  !! s; the state at the start
        real(dp), intent(in) :: t, q(:), v(:)              !! s; the state at the end
        logical, intent(out) :: over  !! then it is to be a shorter one
        real(dp), dimension(self%count) :: after, before
        real(dp) :: state(1 + 2*size(q))

        over = .false.
        if (abs(t_old - self%t_known) > 0.0_dp) then
            state = [t_old, q_old, v_old]
            call self%programs(rates)%evaluate(state, before)
        else
            before = self%rates_known
        end if
        state = [t, q, v]
        call self%programs(rates)%evaluate(state, after)
        self%t_known = t
        self%rates_known = after
        if (.not. any(max(abs(before), abs(after))*(t - t_old) > changes)) return
        over = self%steps_over(t_old, q_old, v_old, t, q, v)
    end subroutine try_step

    pure function steps_over(self, t_old, q_old, v_old, t, q, v) result(yes)
        !! Has a function, between two ends of a step, a maximum beside which it is nearly nothing
        !! at both? Then the motion between them is no motion of the system. Between the ends it
        !! is taken to be a cubic; where one that is off by as much as it is bent may meet what
        !! acts, that counts, too.
        class(place_functions_t), intent(in) :: self
        real(dp), intent(in) :: t_old, q_old(:), v_old(:), t, q(:), v(:)
        logical :: yes
        type(path_t) :: path
        real(dp), dimension(self%count, 0:looks + 4*size(q)) :: arguments, slopes
        real(dp) :: aside(size(q)), place(size(q)), times(0:looks + 4*size(q)), top
        integer :: i, k, last

        yes = .false.
        last = looks + 4*size(q)
        call self%look(t_old, q_old, v_old, arguments(:, 0), slopes(:, 0))
        call self%look(t, q, v, arguments(:, last), slopes(:, last))
        path = path_t(t_old, t, q_old, v_old, q, v)
        call path%divide(times)
        do i = 1, last - 1
            call self%look_along(path, times(i), place, arguments(:, i), slopes(:, i))
        end do
        do k = 1, self%count
            do i = 1, last
                if (.not. (slopes(k, i - 1) > 0.0_dp .and. slopes(k, i) <= 0.0_dp)) cycle
                call self%climb(path, k, times(i - 1), times(i), top, place)
                if (.not. top > max(arguments(k, 0), arguments(k, last)) + deep) cycle
                yes = top > self%least(k)
                if (.not. yes) then
                    aside = bent*(t - t_old)*(v - v_old)
                    call self%climb(path_t(0.0_dp, 1.0_dp, place - aside, 2.0_dp*aside, &
                                           place + aside, 2.0_dp*aside), k, 0.0_dp, 1.0_dp, top, &
                                    place)
                    yes = top > self%least(k)
                end if
                if (yes) return
            end do
        end do
    end function steps_over

    pure subroutine divide(self, times)
        !! Equal parts, and just before and behind the moments at which a velocity is 0, for a
        !! coordinate that turns may pass the same place twice; in order.
        class(path_t), intent(in) :: self
        real(dp), intent(out) :: times(0:)  !! s; so many parts as there are `looks`, and four more
        !! for each coordinate: where there is no such moment a time comes twice
        real(dp), parameter :: beside = 1e-6_dp  ! of the path
        real(dp) :: bend, mean, root, s(0:size(times) - 1), slope, turns(2)
        integer :: i, k

        s(:looks) = [(real(i, dp)/looks, i=0, looks)]
        do i = 1, size(self%q)
            mean = (self%q(i) - self%q_old(i))/(self%t - self%t_old)
            bend = (self%v_old(i) - mean) + (self%v(i) - mean)
            slope = (self%v_old(i) - mean) + bend
            root = slope + sign(sqrt(max(0.0_dp, slope**2 - 3.0_dp*bend*self%v_old(i))), slope)
            turns = 0.0_dp
            if (abs(root) > abs(self%v_old(i))) turns(1) = self%v_old(i)/root
            if (3.0_dp*abs(bend) > abs(root)) turns(2) = root/(3.0_dp*bend)
            s(looks + 4*i - 3:looks + 4*i) = [turns - beside, turns + beside]
        end do
        s = min(max(s, 0.0_dp), 1.0_dp)
        do i = looks + 1, size(s) - 1
            do k = i, 1, -1
                if (s(k) >= s(k - 1)) exit
                s(k - 1:k) = s(k:k - 1:-1)
            end do
        end do
        times = self%t_old + s*(self%t - self%t_old)
        times(ubound(times, 1)) = self%t
    end subroutine divide

    pure subroutine climb(self, path, k, from, to, top, place)
        !! The maximum of argument `k` along a part of a path, by bisection; or at an end of it.
        !! What is no wider than \(2^{-40}\) of that part is a pole of the formula, as of sin(x)/x,
        !! and no maximum.
        class(place_functions_t), intent(in) :: self
        type(path_t), intent(in) :: path
        integer, intent(in) :: k
        real(dp), intent(in) :: from, to
        real(dp), intent(out) :: top, place(:)
        integer, parameter :: most = 40         ! halvings
        real(dp), parameter :: enough = 0.5_dp  ! by which the argument may still grow
        real(dp), dimension(self%count) :: after, before, here, left, right, slopes
        real(dp) :: a, b
        integer :: i

        a = from
        b = to
        call self%look_along(path, b, place, after, right)
        call self%look_along(path, a, place, before, left)
        do i = 1, most
            top = max(before(k), after(k))
            if (.not. (left(k) > 0.0_dp .and. right(k) < 0.0_dp)) return
            if (.not. (b - a)*min(left(k), -right(k)) > enough) return
            call self%look_along(path, a + 0.5_dp*(b - a), place, here, slopes)
            if (slopes(k) > 0.0_dp) then
                a = a + 0.5_dp*(b - a)
                before = here
                left = slopes
            else
                b = a + 0.5_dp*(b - a)
                after = here
                right = slopes
            end if
        end do
        top = -huge(top)
    end subroutine climb

    pure subroutine look_along(self, path, t, place, arguments, slopes)
        !! At a time between the ends of a path.
        class(place_functions_t), intent(in) :: self
        type(path_t), intent(in) :: path
        real(dp), intent(in) :: t
        real(dp), intent(out) :: place(:), arguments(:), slopes(:)
        real(dp) :: speed(size(place))

        call cubic((t - path%t_old)/(path%t - path%t_old), path%t - path%t_old, path%q_old, &
                   path%v_old, path%q, path%v, place, speed)
        call self%look(t, place, speed, arguments, slopes)
    end subroutine look_along

    pure subroutine look(self, t, q, v, arguments, slopes)
        !! The arguments at a state, and their rates of change. That of a switch counts as far as it
        !! is from 0.
        class(place_functions_t), intent(in) :: self
        real(dp), intent(in) :: t, q(:), v(:)
        real(dp), intent(out) :: arguments(self%count), slopes(self%count)
        real(dp) :: results(2*self%count)

        call self%programs(both)%evaluate([t, q, v], results)
        arguments = results(:self%count)
        slopes = results(self%count + 1:)
        where (self%switches)
            slopes = -sign(slopes, slopes*arguments)
            arguments = -abs(arguments)
        end where
    end subroutine look
end module lagrangia_place_functions
