module lagrangia_gauss_stages
    !! One step of Gauss-Legendre collocation with eight stages, evaluated as eight lanes.
    !!
    !! Unknown are the accelerations \(F_j\) at the nodes. With \(L_j = h b_j F_j\) and
    !! \(K_j = h b_j V_j\) the stages are \(V_i = v + \sum_j\mu_{ij}L_j\) and
    !! \(Q_i = q + \sum_j\mu_{ij}K_j\), the step ends at \(v + \sum_j L_j\), \(q + \sum_j K_j\),
    !! and one sweep of the iteration is \(F \leftarrow a(t + c h, Q, V)\).
    !!
    !! An exact sweep does just this. The others add to the stages what a change of \(F\) makes,
    !! to \(Q\) by the matrix \(a^2\) at once: one product waits for the other no more, and the
    !! velocities are left out where no force depends on them. What the method preserves needs
    !! the last sweep of a step to be exact, and one before, when little is left to change: else
    !! the rounding of these matrices makes the energy drift.
    use, intrinsic :: iso_c_binding, only: c_intptr_t, c_loc
    use lagrangia_gauss_kernels, only: apply, distance, end_state, exact_states, free_states, &
                                       full_end_state, magnitude, quick_states
    use lagrangia_gauss_tables, only: legendre, nodes, stages, weights
    use lagrangia_kinds, only: dp
    use lagrangia_system, only: lanes, system_t
    implicit none (type, external)
    private
    public :: gauss_stages_t
    public :: f, f_old, known, modes  ! columns of the stages' room
    public :: line_start

    integer, parameter :: f = 1        !! accelerations of the stages
    integer, parameter :: f_old = 2    !! those before the last sweep
    integer, parameter :: q_stage = 3, v_stage = 4
    integer, parameter :: modes = 5    !! Legendre coefficients 0 to 7 of `f`
    integer, parameter :: known = 6    !! those of a step known from before

    type :: gauss_stages_t
        integer :: n = 0                               !! degrees of freedom
        real(dp), allocatable :: q(:), q_low(:)        !! state, each the sum of two numbers
        real(dp), allocatable :: v(:), v_low(:)
        real(dp) :: t = 0.0_dp                         !! start of the step at hand, s
        real(dp) :: h = 0.0_dp                         !! its length, s
        real(dp) :: times(stages) = 0.0_dp             !! its nodes, s
        real(dp) :: hb(stages) = 0.0_dp                !! its weights, s
        real(dp), allocatable :: room(:, :)            !! of the stages: one column for each of
        !! the numbers below, `(lanes, n)` from its element `first` on
        integer :: first = 1                           !! where 64 bytes begin that are one line
        !! of the processor's memory: lanes across two are passed on late
        real(dp) :: to_modes(stages, stages) = 0.0_dp
        real(dp), allocatable :: start(:), end(:)      !! accelerations at the ends of the step
        real(dp), allocatable :: q_end(:), q_end_low(:)  !! the state there, like `q` and `q_low`
        real(dp), allocatable :: v_end(:), v_end_low(:)
        real(dp) :: h_known = 1.0_dp                   !! length of the step known from before, s
        real(dp) :: from = 1.0_dp                      !! where in it the step at hand begins
        real(dp) :: ahead(stages) = -1.0_dp            !! where in it the nodes are
        real(dp) :: carry(stages, stages) = 0.0_dp     !! Legendre polynomials there
    contains
        procedure :: prepare
        procedure :: place
        procedure :: forget
        procedure :: guess
        procedure :: fly_free
        procedure :: sweep
        procedure :: change
        procedure :: all_of
        procedure :: expand
        procedure :: shorten
        procedure :: reach
        procedure :: look_ahead
        procedure :: finish
    end type gauss_stages_t

contains

    pure subroutine prepare(self, n)
        !! Allocate.
        class(gauss_stages_t), intent(inout) :: self
        integer, intent(in) :: n  !! degrees of freedom
        real(dp) :: state(n), p(stages, stages)
        integer :: k

        state = 0.0_dp
        self%n = n
        self%q = state
        self%q_low = state
        self%v = state
        self%v_low = state
        self%start = state
        self%end = state
        self%q_end = state
        self%q_end_low = state
        self%v_end = state
        self%v_end_low = state
        if (allocated(self%room)) deallocate (self%room)
        allocate (self%room(lanes*(n + 1), known), source=0.0_dp)
        self%first = line_start(self%room(:, 1))
        call legendre(nodes, p)
        do k = 1, stages
            self%to_modes(k, :) = (2*k - 1)*weights*p(:, k)
        end do
    end subroutine prepare

    pure function line_start(x) result(first)
        !! The first element whose address 64 divides.
        real(dp), intent(in), target :: x(:)  !! eight elements at least
        integer :: first

        first = 1 + int(modulo(-transfer(c_loc(x), 0_c_intptr_t), 64_c_intptr_t)/8)
    end function line_start

    pure subroutine place(self, system, t, q, v)
        !! Stand at `(q, v)`, with nothing known of the accelerations but the one there.
        class(gauss_stages_t), intent(inout) :: self
        class(system_t), intent(in) :: system         !! gives the accelerations
        real(dp), intent(in) :: t                     !! s
        real(dp), intent(in) :: q(self%n), v(self%n)  !! coordinates, velocities

        self%q(:) = q
        self%v(:) = v
        self%q_low(:) = 0.0_dp
        self%v_low(:) = 0.0_dp
        call self%forget(system, t)
    end subroutine place

    pure subroutine forget(self, system, t)
        !! Know no polynomial, only the acceleration at the state at hand.
        class(gauss_stages_t), intent(inout) :: self
        class(system_t), intent(in) :: system  !! gives the acceleration
        real(dp), intent(in) :: t              !! s

        call system%accelerations(t, self%q, self%v, self%start)
        self%room(:, known) = 0.0_dp
        self%room(self%first:self%first + lanes*(self%n - 1):lanes, known) = self%start
        self%h_known = 1.0_dp
        self%from = 1.0_dp
    end subroutine forget

    pure subroutine guess(self, t, h)
        !! Begin a step: carry the polynomial on that is known.
        class(gauss_stages_t), intent(inout) :: self
        real(dp), intent(in) :: t  !! its start, s
        real(dp), intent(in) :: h  !! its length, s
        real(dp) :: ahead(stages)

        self%t = t
        self%h = h
        self%times = t + h*nodes
        self%hb = h*weights
        self%hb(1) = 0.5_dp*h - (self%hb(2) + self%hb(3) + self%hb(4))
        self%hb(8) = self%hb(1)
        ahead = self%from + h/self%h_known*nodes
        if (any(abs(ahead - self%ahead) > 0.0_dp)) then
            self%ahead = ahead
            call legendre(ahead, self%carry)
        end if
        call apply(self%n, self%carry, self%room(self%first, known), self%room(self%first, f))
    end subroutine guess

    pure subroutine fly_free(self)
        !! Stages without accelerations: what inexact sweeps may begin with.
        class(gauss_stages_t), intent(inout) :: self

        call free_states(self%n, self%h, self%q, self%v, self%room(self%first, f_old), &
                         self%room(self%first, q_stage), self%room(self%first, v_stage))
    end subroutine fly_free

    pure subroutine sweep(self, system, exact)
        !! The accelerations that the present ones imply.
        class(gauss_stages_t), intent(inout) :: self
        class(system_t), intent(in) :: system  !! gives them
        logical, intent(in) :: exact           !! to the last bit

        if (exact) then
            call exact_states(self%n, self%hb, self%q, self%q_low, self%v, self%v_low, &
                              self%room(self%first, f), self%room(self%first, f_old), &
                              self%room(self%first, q_stage), self%room(self%first, v_stage))
        else
            call quick_states(self%n, self%h, system%velocity_forces, self%room(self%first, f), &
                              self%room(self%first, f_old), self%room(self%first, q_stage), &
                              self%room(self%first, v_stage))
        end if
        call system%accelerations_lanes(self%times, self%room(self%first, q_stage), &
                                        self%room(self%first, v_stage), self%room(self%first, f))
    end subroutine sweep

    pure function change(self, weight)
        !! Weighted mean square of what the last sweep changed.
        class(gauss_stages_t), intent(in) :: self
        real(dp), intent(in) :: weight(self%n)  !! of the squares
        real(dp) :: change

        change = distance(self%n, weight, self%room(self%first, f), self%room(self%first, f_old))
    end function change

    pure function all_of(self, weight)
        !! Weighted mean square of the accelerations.
        class(gauss_stages_t), intent(in) :: self
        real(dp), intent(in) :: weight(self%n)  !! of the squares
        real(dp) :: all_of

        all_of = magnitude(self%n, weight, self%room(self%first, f))
    end function all_of

    pure subroutine expand(self)
        !! The Legendre coefficients of the accelerations.
        class(gauss_stages_t), intent(inout) :: self

        call apply(self%n, self%to_modes, self%room(self%first, f), self%room(self%first, modes))
    end subroutine expand

    pure subroutine shorten(self)
        !! The step at hand is too long, but its polynomial is known now; `expand` came before.
        class(gauss_stages_t), intent(inout) :: self

        self%room(:, known) = self%room(:, modes)
        self%h_known = self%h
        self%from = 0.0_dp
    end subroutine shorten

    pure subroutine reach(self, fully)
        !! The state at the end of the step.
        class(gauss_stages_t), intent(inout) :: self
        logical, intent(in) :: fully  !! to twice the digits, but for those of the accelerations
        integer :: d

        do d = 1, self%n
            self%q_end(d) = self%q(d)
            self%q_end_low(d) = self%q_low(d)
            self%v_end(d) = self%v(d)
            self%v_end_low(d) = self%v_low(d)
        end do
        if (fully) then
            call full_end_state(self%n, self%hb, self%room(self%first, f), self%q_end, &
                                self%q_end_low, self%v_end, self%v_end_low)
        else
            call end_state(self%n, self%hb, self%room(self%first, f), self%q_end, &
                           self%q_end_low, self%v_end, self%v_end_low)
        end if
    end subroutine reach

    pure subroutine look_ahead(self, system)
        !! The accelerations at the end of the step; `reach` came before.
        class(gauss_stages_t), intent(inout) :: self
        class(system_t), intent(in) :: system  !! gives them

        call system%accelerations(self%t + self%h, self%q_end, self%v_end, self%end)
    end subroutine look_ahead

    pure subroutine finish(self)
        !! Go to the end of the step; `expand` and `reach` came before.
        class(gauss_stages_t), intent(inout) :: self
        integer :: d

        do d = 1, self%n
            self%q(d) = self%q_end(d)
            self%q_low(d) = self%q_end_low(d)
            self%v(d) = self%v_end(d)
            self%v_low(d) = self%v_end_low(d)
        end do
        self%room(:, known) = self%room(:, modes)
        self%h_known = self%h
        self%from = 1.0_dp
    end subroutine finish
end module lagrangia_gauss_stages
