module lagrangia_integrator
    !! The contract of an integrator: `prepare` refuses or allocates, `start` begins a motion,
    !! `advance` goes on from where the last one ended, and cannot fail.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_quiet_nan, ieee_value
    use lagrangia_brief_forces, only: brief_forces_t
    use lagrangia_description, only: line_length, name_length, title_length
    use lagrangia_errors, only: error_t, fail, status_numbers
    use lagrangia_kinds, only: dp, i8
    use lagrangia_number_text, only: scientific
    use lagrangia_place_functions, only: place_functions_t
    use lagrangia_system, only: system_t
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: integrator_t, integrator_box_t, dense_integrator_t, dense_integrator_box_t
    public :: not_prepared, not_started

    character(*), parameter :: not_prepared = "`prepare` has not been called for this system"
    character(*), parameter :: not_started = "`start` has not been called"

    type, abstract :: integrator_t
        character(name_length) :: name = ""
        character(title_length) :: title = ""  !! a few words and the source
        integer :: order = 0
        integer :: energy_order = 0           !! of its error, which stays bounded; 0: it may drift
        logical :: symplectic = .false.       !! a step is a canonical map of (q, p)
        logical :: reversible = .false.       !! a step back undoes a step, but for rounding
        real(dp) :: step_limit = 0.0_dp       !! omega dt of a stable oscillation; 0: none known
        logical :: leaves_cyclic = .false.    !! a coordinate less pays, where a system knows how
        logical :: keeps_speed = .false.      !! |v| where a uniform magnetic field acts alone
        integer :: coordinates = 0            !! of the system of `prepare`; 0: there was none
        integer(i8) :: evaluations = 0        !! of accelerations or forces, since `prepare`
        character(line_length) :: failure_reason = ""  !! why `advance` gave NaN, where known
    contains
        procedure(prepare_i), deferred :: prepare
        procedure :: start
        procedure(advance_i), deferred :: advance
        procedure :: compensated => no_compensated
        procedure :: properties
        procedure, non_overridable :: refuse_state
        procedure, non_overridable :: refuse_system
        procedure, non_overridable :: try_advance
    end type integrator_t

    type :: integrator_box_t
        !! A place for one integrator of any kind.
        class(integrator_t), allocatable :: item
    end type integrator_box_t

    type, abstract, extends(integrator_t) :: dense_integrator_t
        !! An integrator that walks step by step and knows the solution between the ends of its
        !! latest step, `t_old` to `t_new`. Adaptive ones choose their steps by `tolerance`.
        real(dp) :: tolerance = 1e-10_dp  !! of the local error, absolute below 1, relative above
        real(dp) :: least_tolerance = 1e-15_dp  !! below, all is rounding
        real(dp) :: noise_margin = 16.0_dp  !! the least tolerance of use is rounding over this
        real(dp) :: longest = huge(1.0_dp)  !! no step is longer, but for 1 % at the end, s
        type(brief_forces_t) :: brief     !! nor goes over what acts for a moment: `start` says
        type(place_functions_t) :: places !! nor over what acts in one place only
        integer(i8) :: most_steps = huge(1_i8)  !! after so many a run fails
        real(dp) :: t_old = 0.0_dp        !! s
        real(dp) :: t_new = 0.0_dp        !! s
        real(dp) :: t_end = 0.0_dp        !! no step goes beyond, s; set by `start`
        real(dp), private :: t_seen = 0.0_dp    !! where `refuse_more` last looked back, s
        real(dp), private :: farthest = 0.0_dp  !! that it saw between two looks, s
        integer, private :: slow = 0            !! looks since it came so far
        integer :: points_a_step = 8      !! between two of them the motion hardly turns
        logical :: dense = .true.         !! if false only the ends of steps are asked for: cheaper,
        !! but gauss16 looks for no kinks of the force
        logical :: whole = .false.        !! knows all of the motion at all times, and no steps
        integer(i8) :: accepted = 0
        integer(i8) :: rejected = 0
    contains
        procedure, non_overridable :: stand
        procedure, non_overridable :: refuse_more
        procedure(step_i), deferred :: step
        procedure(state_at_i), deferred :: state_at
    end type dense_integrator_t

    type :: dense_integrator_box_t
        !! A place for one of any kind. gfortran 12 also needs it here: modules that make the
        !! dispatch table of `dense_integrator_t` for themselves disagree about its order.
        class(dense_integrator_t), allocatable :: item
    end type dense_integrator_box_t

    abstract interface
        pure subroutine prepare_i(self, system, error)
            !! Refuse a system that the method is not made for, or get ready to step it.
            import :: integrator_t, system_t, error_t
            implicit none (type, external)
            class(integrator_t), intent(inout) :: self
            class(system_t), intent(in) :: system             !! that it shall step
            type(error_t), allocatable, intent(out) :: error  !! why it refuses
        end subroutine prepare_i

        pure subroutine advance_i(self, system, t0, dt, first, steps, q, v)
            !! Take the steps `first`, ..., `first + steps - 1` of a run: step `k` starts at
            !! `t0 + k*dt`, so that a run gives the same bytes however it is cut into blocks.
            !! The state and its time are those of `start`, or where the last call ended; `dt` may
            !! be another one than there. A step that cannot be taken leaves a state of NaN, and
            !! the reason in `failure_reason`; after that only `start` helps.
            import :: integrator_t, system_t, dp, i8
            implicit none (type, external)
            class(integrator_t), intent(inout) :: self
            class(system_t), intent(in) :: system     !! the one of `prepare`
            real(dp), intent(in) :: t0                !! time of step 0, s
            real(dp), intent(in) :: dt                !! step, s; negative: backwards
            integer(i8), intent(in) :: first          !! number of the first step
            integer(i8), intent(in) :: steps          !! how many
            real(dp), intent(inout) :: q(system%ndof) !! coordinates, before and after
            real(dp), intent(inout) :: v(system%ndof) !! velocities, before and after
        end subroutine advance_i

        pure subroutine step_i(self, system, error)
            !! One accepted step from `t_new` on, never beyond `t_end`; fails (status 3) where no
            !! step is small enough, and then stands where it stood.
            import :: dense_integrator_t, system_t, error_t
            implicit none (type, external)
            class(dense_integrator_t), intent(inout) :: self
            class(system_t), intent(in) :: system             !! the one of `prepare`
            type(error_t), allocatable, intent(out) :: error  !! why there is no step
        end subroutine step_i

        pure subroutine state_at_i(self, t, q, v)
            !! Dense output: the state at `t` between `t_old` and `t_new`; at the ends exactly the
            !! states of the steps. No evaluations of accelerations. At `t_new` if not `dense`.
            import :: dense_integrator_t, dp
            implicit none (type, external)
            class(dense_integrator_t), intent(in) :: self
            real(dp), intent(in) :: t      !! s
            real(dp), intent(out) :: q(:)  !! coordinates, `(ndof)`
            real(dp), intent(out) :: v(:)  !! velocities, `(ndof)`
        end subroutine state_at_i
    end interface

contains

    pure subroutine start(self, system, t0, q, v, t_end)
        !! Begin a motion at a state: at the start of a run, and wherever the state is not the one
        !! where the last step ended. `prepare` came before. A method that keeps something from
        !! step to step overrides this; here only `failure_reason` is forgotten.
        class(integrator_t), intent(inout) :: self
        class(system_t), intent(in) :: system      !! the one of `prepare`
        real(dp), intent(in) :: t0                 !! time of the state, s
        real(dp), intent(in) :: q(system%ndof)     !! coordinates
        real(dp), intent(in) :: v(system%ndof)     !! velocities
        real(dp), intent(in), optional :: t_end    !! where `step` must end, s; absent: nowhere

        self%failure_reason = ""
    end subroutine start

    pure subroutine refuse_system(self, system, refused, q, v, error)
        !! For methods that keep arrays: whether `prepare` was for a system of another size, or
        !! never called. Then the state is NaN, and `failure_reason` says why.
        class(integrator_t), intent(inout) :: self
        class(system_t), intent(in) :: system            !! of this call
        logical, intent(out) :: refused                  !! nothing else can be done
        real(dp), intent(inout), optional :: q(:), v(:)  !! become NaN if refused
        type(error_t), allocatable, intent(out), optional :: error  !! says the same

        refused = self%coordinates /= system%ndof .or. system%ndof < 1
        if (.not. refused) return
        self%failure_reason = not_prepared
        if (present(q)) q = ieee_value(1.0_dp, ieee_quiet_nan)
        if (present(v)) v = ieee_value(1.0_dp, ieee_quiet_nan)
        if (present(error)) call fail(error, not_prepared)
    end subroutine refuse_system

    pure subroutine stand(self, t0, t_end)
        !! What every dense method notes where it starts.
        class(dense_integrator_t), intent(inout) :: self
        real(dp), intent(in) :: t0               !! s
        real(dp), intent(in), optional :: t_end  !! s; absent: no end

        self%failure_reason = ""
        self%t_old = t0
        self%t_new = t0
        self%t_end = huge(t0)
        if (present(t_end)) self%t_end = t_end
    end subroutine stand

    pure subroutine refuse_more(self, steps, t0, t_end, error)
        !! Fail (status 3) where there were more than `most_steps`, or where the first show that no
        !! computer will come to the end: `few` steps that went less than few/endless of the way.
        !! Or where steps that were long have become so short that minutes are left: a friction
        !! sgn(v) stops a body, and then changes its sign with every step.
        class(dense_integrator_t), intent(inout) :: self
        integer(i8), intent(in) :: steps                    !! so far
        real(dp), intent(in) :: t0, t_end                   !! of the whole run, s
        type(error_t), allocatable, intent(inout) :: error  !! as it was, or status 3
        integer(i8), parameter :: few = 10000
        real(dp), parameter :: endless = 1e15_dp            ! steps: three years at 100 ns each
        integer(i8), parameter :: many = 100000
        real(dp), parameter :: minutes = 1e8_dp             ! steps
        real(dp), parameter :: shorter = 1e-3_dp            ! than the longest
        integer, parameter :: lasting = 8                   ! looks at as many steps
        real(dp) :: gone

        if (allocated(error)) return
        if (steps > self%most_steps) then
            call fail(error, "more than "//to_text(self%most_steps)//" steps, at t = "// &
                      to_text(self%t_new)//" s", status_numbers)
        else if (steps == few .and. (self%t_new - t0)*(endless/few) < t_end - t0) then
            call fail(error, to_text(few)//" steps went from t = "//to_text(t0)//" s to "// &
                      scientific(self%t_new, 2)//" s, more than 10^15 are needed to "// &
                      to_text(t_end)//" s: shorten the duration; very large forces need very "// &
                      "short steps", status_numbers)
        else if (mod(steps, many) == 0_i8) then
            gone = self%t_new - self%t_seen
            if (steps == many) gone = self%t_new - t0
            if (steps == many) self%farthest = gone
            self%slow = merge(self%slow + 1, 0, gone < shorter*self%farthest .and. &
                              gone*(minutes/many) < t_end - self%t_new)
            if (self%slow == lasting) then
                call fail(error, "steps have become "//scientific(self%farthest/gone, 2)// &
                    " times shorter at t = "//to_text(self%t_new)//" s: for a force that is so "// &
                    "steep there the tolerance is too small; one that jumps there and back, as "// &
                    "friction sgn(v) where it stops a body, needs a smooth form, tanh(v/v0)", &
                    status_numbers)
            end if
            self%farthest = max(self%farthest, gone)
            self%t_seen = self%t_new
        end if
    end subroutine refuse_more

    subroutine no_compensated(self, variant)
        !! The same method with compensated sums; not allocated where there is none.
        class(integrator_t), intent(in) :: self
        class(integrator_t), allocatable, intent(out) :: variant  !! not yet prepared
    end subroutine no_compensated

    pure subroutine try_advance(self, system, t0, dt, first, steps, q, v, error)
        !! `advance`, for a caller who wants to know: where that ends in a state that is not finite
        !! `q` and `v` stay as they were, the error says why, and the method starts there again.
        class(integrator_t), intent(inout) :: self
        class(system_t), intent(in) :: system             !! the one of `prepare`
        real(dp), intent(in) :: t0                        !! time of step 0, s
        real(dp), intent(in) :: dt                        !! step, s
        integer(i8), intent(in) :: first                  !! number of the first step
        integer(i8), intent(in) :: steps                  !! how many
        real(dp), intent(inout) :: q(system%ndof)         !! coordinates
        real(dp), intent(inout) :: v(system%ndof)         !! velocities
        type(error_t), allocatable, intent(out) :: error  !! status 3
        real(dp) :: q_new(system%ndof), v_new(system%ndof)

        q_new = q
        v_new = v
        call self%advance(system, t0, dt, first, steps, q_new, v_new)
        call self%refuse_state(t0 + (first + steps)*dt, dt, q_new, v_new, error)
        if (allocated(error)) then
            call self%start(system, t0 + first*dt, q, v)
            return
        end if
        q = q_new
        v = v_new
    end subroutine try_advance

    pure subroutine refuse_state(self, t, dt, q, v, error)
        !! Fail (status 3) if a state that the method made by steps of `dt` is not finite.
        class(integrator_t), intent(in) :: self
        real(dp), intent(in) :: t                         !! time of the state, s
        real(dp), intent(in) :: dt                        !! s
        real(dp), intent(in) :: q(:), v(:)                !! coordinates, velocities
        type(error_t), allocatable, intent(out) :: error  !! with `failure_reason`, if known
        character(:), allocatable :: why

        if (all(ieee_is_finite(q)) .and. all(ieee_is_finite(v))) return
        why = trim(self%failure_reason)
        if (why == "") why = "the step dt = "//to_text(dt)//" s is too long, or the motion diverges"
        call fail(error, "the state is not finite at t = "//to_text(t)//" s: "//why, status_numbers)
    end subroutine refuse_state

    pure function properties(self) result(text)
        !! What the method preserves, in words.
        class(integrator_t), intent(in) :: self
        character(:), allocatable :: text

        text = "order "//to_text(self%order)
        if (self%energy_order > 0) text = text//", energy "//to_text(self%energy_order)
        if (self%symplectic) text = text//", symplectic"
        if (self%reversible) text = text//", reversible"
        if (self%keeps_speed) text = text//", keeps |v| in a magnetic field"
    end function properties
end module lagrangia_integrator
