module lagrangia_cross_check
    !! The end of a run by other means: a closed form, or another method at its least tolerance.
    !!
    !! Finer runs of one method share what is wrong with all of them: steps too small to move a
    !! coordinate, a sum that always rounds the same way, a clock that has lost the last digits of
    !! the steps. Here none of that is shared: the steps are few and long, and the clock starts at
    !! 0 where the equations do not look at it.
    use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
    use lagrangia_errors, only: error_t
    use lagrangia_events, only: event_box_t
    use lagrangia_final_state, only: final_state_t
    use lagrangia_integrator, only: dense_integrator_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_methods, only: new_adaptive
    use lagrangia_number_class, only: is_nonzero, is_zero
    use lagrangia_reference, only: reference_t
    use lagrangia_rounding_trial, only: lost_by_rounding, new_rounding_trial
    use lagrangia_scene, only: scene_t
    use lagrangia_system, only: system_t
    use lagrangia_tolerance_floor, only: sensible_tolerance
    implicit none (type, external)
    private
    public :: by_closed_form, by_other_method, lost_by_clock, new_other_method

    real(dp), parameter :: looks = 512.0_dp  !! steps of the other method at least
    real(dp), parameter :: looser(2) = [1e-12_dp, 1e-10_dp]
    !! tolerances, where the least one takes too long
    real(dp), parameter :: cancelled = 1e-10_dp  !! six digits of an acceleration's sixteen

contains

    subroutine by_closed_form(scene, system, seen, closed_form, state, known)
        !! Time, coordinates and velocities at the end of a run that no event ended.
        type(scene_t), intent(in) :: scene  !! what was run
        class(system_t), intent(in) :: system  !! with the scene's parameters
        type(final_state_t), intent(in) :: seen                          !! of the run
        class(reference_t), allocatable, intent(in) :: closed_form   !! of its start
        real(dp), intent(out) :: state(1 + 2*system%ndof)  !! s, coordinates, velocities
        logical, intent(out) :: known  !! else `state` is zero
        real(dp) :: q(system%ndof), v(system%ndof)

        state = 0.0_dp
        known = allocated(closed_form) .and. seen%t >= scene%t0 + scene%duration
        if (known) known = closed_form%has_state
        if (.not. known) return
        call closed_form%state_at(seen%t, q, v)
        call go_on(system, seen%t, lost_by_clock(scene%t0, scene%duration), q, v)
        state = [seen%t, q, v]
    end subroutine by_closed_form

    subroutine by_other_method(scene, system, seen, events, allowed, state, known)
        !! Time, coordinates and velocities where the run ended, or where in truth the event is that
        !! ended it. Not known across impacts, or where that would take too long. Where terms of the
        !! equations cancel, these are rounded otherwise as well; what then cannot be known is NaN,
        !! and so is an end without the energy that the motion conserves: a step of the potential
        !! has been gone over. Where the least tolerance takes too long, as at a thin wall, larger
        !! ones may still show that the end is elsewhere.
        type(scene_t), intent(in) :: scene  !! what was run
        class(system_t), intent(in) :: system  !! with the scene's parameters
        type(final_state_t), intent(in) :: seen              !! of the run
        type(event_box_t), intent(inout) :: events(:)    !! of the run
        integer(i8), intent(in) :: allowed               !! evaluations
        real(dp), intent(out) :: state(1 + 2*system%ndof)  !! s, coordinates, velocities
        logical, intent(out) :: known  !! else `state` has no meaning
        class(system_t), allocatable :: trial
        real(dp) :: lost
        integer :: i

        state = 0.0_dp
        known = system%contacts == 0
        if (.not. known) return
        call new_rounding_trial(system, trial)
        lost = 0.0_dp
        if (allocated(trial)) lost = lost_by_rounding( &
            system, trial, [scene%t0, seen%t, scene%t0, seen%t], reshape( &
            [scene%q, seen%q, 0.5_dp*(scene%q + seen%q), seen%q_most], [system%ndof, 4]), reshape( &
            [scene%v, seen%v, seen%v_most, 0.5_dp*(scene%v + seen%v)], [system%ndof, 4]), &
            seen%v_most/max(seen%t - scene%t0, tiny(seen%t)))
        if (lost > cancelled) then
            call go_other_way(scene, trial, seen, events, allowed, lost, state, known)
            if (.not. known) state = ieee_value(state, ieee_quiet_nan)
            known = .true.
        else
            call go_other_way(scene, system, seen, events, allowed, 0.0_dp, state, known)
        end if
        if (.not. known) then
            do i = 1, size(looser)
                call go_other_way(scene, system, seen, events, allowed, looser(i), state, known)
                if (known) exit
            end do
            known = known .and. is_elsewhere(seen, state)
            return
        end if
        if (has_other_energy(scene, system, state)) then
            state = ieee_value(state, ieee_quiet_nan)
        end if
    end subroutine by_other_method

    pure function is_elsewhere(seen, state) result(yes)
        !! Than where the run ended, by more than these tolerances explain.
        type(final_state_t), intent(in) :: seen
        real(dp), intent(in) :: state(:)
        logical :: yes
        real(dp), parameter :: far = 1e-7_dp  ! of the largest values on the way

        associate (n => size(seen%q))
            yes = any(abs(state(2:1 + n) - seen%q) > far*seen%q_most) .or. &
                  any(abs(state(2 + n:) - seen%v) > far*seen%v_most)
        end associate
    end function is_elsewhere

    pure function has_other_energy(scene, system, state) result(yes)
        !! Of a system whose energy is conserved and whose terms are known: than at the start.
        type(scene_t), intent(in) :: scene
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: state(:)
        logical :: yes
        real(dp), parameter :: bound = 1e-5_dp  !! far above the errors of the least tolerance
        real(dp) :: change, of_terms

        yes = .false.
        if (.not. system%conserves_energy()) return
        associate (n => system%ndof, t => state(1))
            of_terms = max(system%natural_size(0, scene%t0, scene%q, scene%v), &
                           system%natural_size(0, t, state(2:1 + n), state(2 + n:)))
            change = system%energy(t, state(2:1 + n), state(2 + n:)) - &
                     system%energy(scene%t0, scene%q, scene%v)
        end associate
        yes = of_terms > 0.0_dp .and. abs(change) > bound*of_terms
    end function has_other_energy

    subroutine go_other_way(scene, system, seen, events, allowed, tolerance, state, known)
        !! From the start to that end. However smooth the motion, the steps are so short that a
        !! force which lasts a thousandth of the time cannot hide between the stages of `looks`
        !! steps.
        type(scene_t), intent(in) :: scene
        class(system_t), intent(in) :: system
        type(final_state_t), intent(in) :: seen
        type(event_box_t), intent(inout) :: events(:)
        integer(i8), intent(in) :: allowed
        real(dp), intent(in) :: tolerance  ! at least
        real(dp), intent(out) :: state(1 + 2*system%ndof)
        logical, intent(out) :: known
        class(dense_integrator_t), allocatable :: method
        type(error_t), allocatable :: error
        real(dp) :: q(system%ndof), v(system%ndof), start, elapsed, late, slope, value
        logical :: stopped

        state = 0.0_dp
        stopped = seen%t < scene%t0 + scene%duration
        elapsed = merge(seen%t - scene%t0, scene%duration, stopped)
        start = merge(scene%t0, 0.0_dp, system%time_dependent)
        call new_other_method(scene, system, method)
        method%dense = .false.
        method%tolerance = max(method%tolerance, tolerance)
        method%longest = elapsed/looks
        call method%prepare(system, error)
        if (.not. allocated(error)) call method%start(system, start, scene%q, scene%v, &
                                                      start + elapsed)
        do while (method%t_new < method%t_end .and. .not. allocated(error))
            call method%step(system, error)
            if (method%evaluations > allowed) exit
        end do
        known = method%t_new >= method%t_end .and. .not. allocated(error)
        if (.not. known) return
        call method%state_at(method%t_end, q, v)
        call go_on(system, method%t_end, lost_by_clock(start, elapsed), q, v)
        late = 0.0_dp
        if (stopped) then
            call event_slope(system, seen%t, 1e-4_dp*elapsed, q, v, events, value, slope)
            late = value/slope
            call go_on(system, seen%t, -late, q, v)
        end if
        state = [seen%t - late, q, v]
    end subroutine go_other_way

    subroutine new_other_method(scene, system, method)
        !! Not the scene's, at the least tolerance that makes sense from its start.
        type(scene_t), intent(in) :: scene  !! what is run
        class(system_t), intent(in) :: system  !! with the scene's parameters
        class(dense_integrator_t), allocatable, intent(out) :: method
        !! neither prepared nor started
        real(dp) :: start

        call new_adaptive(merge("gauss16", "dop853 ", scene%method == "dop853"), method)
        start = merge(scene%t0, 0.0_dp, system%time_dependent)
        method%tolerance = sensible_tolerance(method, system, start, scene%duration, &
                                              scene%q, scene%v)
    end subroutine new_other_method

    pure function lost_by_clock(start, elapsed) result(lost)
        !! What the end on the clock, `start + elapsed` rounded, leaves of `elapsed`, s.
        real(dp), intent(in) :: start, elapsed  !! s
        real(dp) :: lost

        lost = elapsed - ((start + elapsed) - start)
    end function lost_by_clock

    pure subroutine go_on(system, t, dt, q, v)
        !! For so short a time that a straight line will do.
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t, dt
        real(dp), intent(inout) :: q(system%ndof), v(system%ndof)
        real(dp) :: a(system%ndof)

        if (is_zero(dt)) return
        call system%accelerations(t, q, v, a)
        q = q + dt*v
        v = v + dt*a
    end subroutine go_on

    subroutine event_slope(system, t, h, q, v, events, value, slope)
        !! Of the final event that is nearest to a state: its function and how fast that changes.
        class(system_t), intent(in) :: system  !! whose motion it is
        real(dp), intent(in) :: t, q(system%ndof), v(system%ndof)  !! s; coordinates, velocities
        real(dp), intent(in) :: h            !! over which the change is taken, s
        type(event_box_t), intent(inout) :: events(:)  !! at least one is final
        real(dp), intent(out) :: value, slope  !! in the unit of the event's column; that per s
        real(dp) :: this, rate, later, q_later(system%ndof), v_later(system%ndof)
        integer :: i

        value = huge(value)
        slope = 1.0_dp
        q_later = q
        v_later = v
        call go_on(system, t, h, q_later, v_later)
        do i = 1, size(events)
            if (.not. events(i)%item%terminal) cycle
            this = events(i)%item%value(system, t, q, v)
            later = events(i)%item%value(system, t + h, q_later, v_later)
            rate = (later - this)/h
            if (.not. is_nonzero(rate)) rate = tiny(rate)
            if (abs(this*slope) > abs(value*rate)) cycle
            value = this
            slope = rate
        end do
    end subroutine event_slope
end module lagrangia_cross_check
