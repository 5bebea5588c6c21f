module lagrangia_gauss_stages
    !! One step of Gauss-Legendre collocation with eight stages, evaluated as eight lanes.
    !!
    !! Unknown are the accelerations \(F_j\) at the nodes. With \(L_j = h b_j F_j\) and
    !! \(K_j = h b_j V_j\) the stages are \(V_i = v + \sum_j\mu_{ij}L_j\) and
    !! \(Q_i = q + \sum_j\mu_{ij}K_j\), the step ends at \(v + \sum_j L_j\), \(q + \sum_j K_j\),
    !! and one sweep of the iteration is \(F \leftarrow a(t + c h, Q, V)\).
    !!
    !! Here a loop over the lanes says what an array statement would say better: the directive
    !! keeps gfortran 12 from unrolling it before it vectorises, which costs a factor of 3.
    use lagrangia_gauss_tables, only: legendre, mu, nodes, stages, weights
    use lagrangia_kinds, only: dp
    use lagrangia_system, only: lanes, system_t
    implicit none (type, external)
    private
    public :: gauss_stages_t

    type :: gauss_stages_t
        integer :: n = 0                               !! degrees of freedom
        real(dp), allocatable :: q(:), q_low(:)        !! state, each the sum of two numbers
        real(dp), allocatable :: v(:), v_low(:)
        real(dp) :: t = 0.0_dp                         !! start of the step at hand, s
        real(dp) :: h = 0.0_dp                         !! its length, s
        real(dp) :: times(stages) = 0.0_dp             !! its nodes, s
        real(dp) :: hb(stages) = 0.0_dp                !! its weights, s
        real(dp), allocatable :: f(:, :)               !! accelerations of the stages
        real(dp), allocatable :: f_new(:, :)
        real(dp), allocatable :: q_stage(:, :), v_stage(:, :)
        real(dp), allocatable :: change(:)             !! of `f` in a sweep: sum of squares
        real(dp), allocatable :: size_of(:)            !! of `f`: sum of squares
        real(dp) :: to_modes(stages, stages) = 0.0_dp
        real(dp), allocatable :: modes(:, :)           !! Legendre coefficients 0 to 7 of `f`
        real(dp), allocatable :: known(:, :)           !! those of a step known from before:
        real(dp) :: h_known = 1.0_dp                   !! its length, s
        real(dp) :: from = 1.0_dp                      !! where in it the step at hand begins
    contains
        procedure :: prepare
        procedure :: place
        procedure :: guess
        procedure :: sweep
        procedure :: expand
        procedure :: shorten
        procedure :: finish
    end type gauss_stages_t

contains

    pure subroutine prepare(self, n)
        !! Allocate for `n` degrees of freedom.
        class(gauss_stages_t), intent(inout) :: self
        integer, intent(in) :: n
        real(dp) :: state(n), block(lanes, n), p(stages, stages)
        integer :: k

        state = 0.0_dp
        block = 0.0_dp
        self%n = n
        self%q = state
        self%q_low = state
        self%v = state
        self%v_low = state
        self%change = state
        self%size_of = state
        self%f = block
        self%f_new = block
        self%q_stage = block
        self%v_stage = block
        self%modes = block
        self%known = block
        p = legendre(nodes)
        do k = 1, stages
            self%to_modes(k, :) = (2*k - 1)*weights*p(:, k)
        end do
    end subroutine prepare

    pure subroutine place(self, system, t, q, v)
        !! Stand at `(q, v)`, with nothing known of the accelerations but the one there.
        class(gauss_stages_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t, q(self%n), v(self%n)

        self%q(:) = q
        self%v(:) = v
        self%q_low(:) = 0.0_dp
        self%v_low(:) = 0.0_dp
        call system%accelerations(t, q, v, self%change)
        self%known(:, :) = 0.0_dp
        self%known(1, :) = self%change
        self%h_known = 1.0_dp
        self%from = 1.0_dp
    end subroutine place

    pure subroutine guess(self, t, h)
        !! Begin a step: carry the polynomial on that is known.
        class(gauss_stages_t), intent(inout) :: self
        real(dp), intent(in) :: t, h

        self%t = t
        self%h = h
        self%times = t + h*nodes
        self%hb = h*weights
        self%hb(1) = 0.5_dp*h - (self%hb(2) + self%hb(3) + self%hb(4))
        self%hb(8) = self%hb(1)
        call apply(self%n, legendre(self%from + h/self%h_known*nodes), self%known, &
                   self%f)
    end subroutine guess

    pure subroutine sweep(self, system)
        !! The accelerations that the present ones imply.
        class(gauss_stages_t), intent(inout) :: self
        class(system_t), intent(in) :: system

        call stage_states(self%n, self%hb, self%q, self%q_low, self%v, self%v_low, self%f, &
                          self%q_stage, self%v_stage)
        call system%accelerations_lanes(self%times, self%q_stage, self%v_stage, self%f_new)
        call take_over(self%n, self%f_new, self%f, self%change, self%size_of)
    end subroutine sweep

    pure subroutine expand(self)
        !! The Legendre coefficients of the accelerations.
        class(gauss_stages_t), intent(inout) :: self

        call apply(self%n, self%to_modes, self%f, self%modes)
    end subroutine expand

    pure subroutine shorten(self)
        !! The step at hand is too long, but its polynomial is known now; `expand` came before.
        class(gauss_stages_t), intent(inout) :: self

        self%known(:, :) = self%modes
        self%h_known = self%h
        self%from = 0.0_dp
    end subroutine shorten

    pure subroutine finish(self)
        !! Go to the end of the step; `expand` came before.
        class(gauss_stages_t), intent(inout) :: self

        call end_state(self%n, self%hb, self%f, self%q, self%q_low, self%v, self%v_low)
        self%known(:, :) = self%modes
        self%h_known = self%h
        self%from = 1.0_dp
    end subroutine finish

    pure subroutine stage_states(n, hb, q, q_low, v, v_low, f, q_stage, v_stage)
        !! Coordinates and velocities of the stages.
        integer, intent(in) :: n
        real(dp), intent(in) :: hb(lanes), q(n), q_low(n), v(n), v_low(n), f(lanes, n)
        real(dp), intent(out) :: q_stage(lanes, n), v_stage(lanes, n)
        integer :: d

        do d = 1, n
            call integrate(v(d), v_low(d), hb, f(:, d), v_stage(:, d))
            call integrate(q(d), q_low(d), hb, v_stage(:, d), q_stage(:, d))
        end do
    end subroutine stage_states

    pure subroutine integrate(start, low, hb, slope, y)
        !! \(y_i = y_0 + \sum_j\mu_{ij}\,h b_j\,y'_j\), where \(y_0\) is a sum of two numbers.
        real(dp), intent(in) :: start, low, hb(lanes), slope(lanes)
        real(dp), intent(out) :: y(lanes)
        real(dp) :: x(lanes)
        integer :: i

        !GCC$ vector
        do i = 1, lanes
            x(i) = hb(i)*slope(i)
        end do
        !GCC$ vector
        do i = 1, lanes
            y(i) = start + (low + (((mu(i, 1)*x(1) + mu(i, 2)*x(2)) &
                                    + (mu(i, 3)*x(3) + mu(i, 4)*x(4))) &
                                   + ((mu(i, 5)*x(5) + mu(i, 6)*x(6)) &
                                      + (mu(i, 7)*x(7) + mu(i, 8)*x(8)))))
        end do
    end subroutine integrate

    pure subroutine take_over(n, f_new, f, change, size_of)
        !! The new accelerations, and by how much they differ from the old ones.
        integer, intent(in) :: n
        real(dp), intent(in) :: f_new(lanes, n)
        real(dp), intent(inout) :: f(lanes, n)
        real(dp), intent(out) :: change(n), size_of(n)
        real(dp) :: x(lanes), y(lanes)
        integer :: d, i

        do d = 1, n
            !GCC$ vector
            do i = 1, lanes
                x(i) = (f_new(i, d) - f(i, d))**2
                y(i) = f_new(i, d)**2
                f(i, d) = f_new(i, d)
            end do
            change(d) = total(x)
            size_of(d) = total(y)
        end do
    end subroutine take_over

    pure subroutine end_state(n, hb, f, q, q_low, v, v_low)
        !! The state at the end of the step; what rounding takes from it goes into the low parts.
        integer, intent(in) :: n
        real(dp), intent(in) :: hb(lanes), f(lanes, n)
        real(dp), intent(inout) :: q(n), q_low(n), v(n), v_low(n)
        real(dp) :: v_stage(lanes)
        integer :: d

        do d = 1, n
            call integrate(v(d), v_low(d), hb, f(:, d), v_stage)
            call add(v(d), v_low(d), total(hb*f(:, d)))
            call add(q(d), q_low(d), total(hb*v_stage))
        end do
    end subroutine end_state

    pure subroutine apply(n, m, x, y)
        !! Multiply the matrix `m` by every column of `x`.
        integer, intent(in) :: n
        real(dp), intent(in) :: m(lanes, lanes), x(lanes, n)
        real(dp), intent(out) :: y(lanes, n)
        integer :: d, i

        do d = 1, n
            !GCC$ vector
            do i = 1, lanes
                y(i, d) = ((m(i, 1)*x(1, d) + m(i, 2)*x(2, d)) &
                           + (m(i, 3)*x(3, d) + m(i, 4)*x(4, d))) &
                          + ((m(i, 5)*x(5, d) + m(i, 6)*x(6, d)) &
                             + (m(i, 7)*x(7, d) + m(i, 8)*x(8, d)))
            end do
        end do
    end subroutine apply

    pure function total(x) result(s)
        !! Sum over the lanes.
        real(dp), intent(in) :: x(lanes)
        real(dp) :: s, half(4)

        half = x(1:4) + x(5:8)
        s = (half(1) + half(3)) + (half(2) + half(4))
    end function total

    pure subroutine add(s, low, x)
        !! Add `x` to the sum `s + low` (Knuth's two-sum).
        real(dp), intent(inout) :: s, low
        real(dp), intent(in) :: x
        real(dp) :: y, new, part

        y = low + x
        new = s + y
        part = new - s
        low = (s - (new - part)) + (y - part)
        s = new
    end subroutine add
end module lagrangia_gauss_stages
