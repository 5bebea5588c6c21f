module lagrangia_accuracy
    !! The error of a run's final state: the same scene twice more, finer and finer still, and once
    !! by other means.
    !!
    !! With steps of \(h, h/2, h/4\) and a method of order p the changes from one run to the next
    !! shrink by \(2^{-p}\). The error of the first run is its distance to the third, and that one's
    !! own, which is \(1/(2^p - 1)\) of the latest change. Where changes shrink less, by rounding,
    !! chaos or too long a step, no number of the state is trusted more, beside its largest
    !! magnitude, than the worst of all; and none more than its changes, where these do not shrink
    !! at all. The second run starts a last digit away: where the motion lingers at a saddle, three
    !! runs from one state would linger alike; where they do not resolve how it leaves the saddle,
    !! rounding has grown all the time, see `lagrangia_saddle`. Nor is an error less than the closed
    !! form is away, or the end by another method; with a tolerance, which steps follow unevenly,
    !! that distance and the latest change.
    !! Source: Hairer, Nørsett & Wanner, *Solving Ordinary Differential Equations I*, 2nd ed.,
    !! sec. II.4.
    use lagrangia_cross_check, only: by_closed_form, by_other_method, lost_by_clock
    use lagrangia_dense_run, only: drive
    use lagrangia_description, only: description_t
    use lagrangia_errors, only: error_t, status_numbers
    use lagrangia_final_state, only: final_state_t
    use lagrangia_final_values, only: final_value_t
    use lagrangia_integrator, only: dense_integrator_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_methods, only: new_adaptive
    use lagrangia_observer, only: observer_box_t, observer_t
    use lagrangia_part, only: part_t
    use lagrangia_reference, only: reference_t
    use lagrangia_saddle, only: lingers, unresolved_growth
    use lagrangia_scene, only: scene_t
    use lagrangia_system, only: system_t
    use lagrangia_tolerance_floor, only: sensible_tolerance
    use lagrangia_trajectory_plan, only: plan_steps, trajectory_plan_t
    implicit none (type, external)
    private
    public :: agreement, estimate, plan_finer, share_of_run, state_accuracy

    character(*), parameter :: context = "the run that estimates the error"
    real(dp), parameter :: vouched = 2.0_dp       !! stated error over estimate
    real(dp), parameter :: margin = 4.0_dp        !! error of the other end over its distance
    real(dp), parameter :: caution = 5.0_dp       !! where the changes don't shrink as they should
    real(dp), parameter :: linger = 10.0_dp       !! where all runs wait at a saddle,
    real(dp), parameter :: amplified = 1e-10_dp   !! if their distances are that large, relative
    real(dp), parameter :: rests = 1e-2_dp, slows = 0.3_dp  !! of the largest speed
    real(dp), parameter :: share_of_run = 0.125_dp
    !! what the run itself is of all that is computed; then come twice and four times that

contains

    subroutine plan_finer(scene, system, finer, error)
        !! The two finer runs: one at half the step or a hundredth of the tolerance, one at the
        !! square of that; each from a state a last digit away from the scene's, to either side.
        type(scene_t), intent(in) :: scene                    !! its method is not `auto`
        class(system_t), intent(in) :: system  !! with the scene's parameters
        type(trajectory_plan_t), intent(out) :: finer(2)      !! still without their events
        type(error_t), allocatable, intent(out) :: error      !! the finest would be refused
        type(scene_t) :: near, fine
        integer :: k

        do k = 2, 1, -1
            call nudge(scene, system, merge(1, -1, k == 1), near)
            call refine(near, system, k, fine)
            call plan_steps(fine, system, finer(k), error)
            if (allocated(error)) call error%add_context(context)
            if (allocated(error)) return
        end do
    end subroutine plan_finer

    subroutine state_accuracy(scene, system, closed_form, finer, seen, steps, progress, state, &
                              error)
        !! Every number of the final state of `scene`, with its error; the time first if an event
        !! ended the run. Fails where a finer run fails.
        type(scene_t), intent(in) :: scene  !! its method is not `auto`
        class(system_t), intent(in) :: system  !! with the scene's parameters
        class(reference_t), allocatable, intent(in) :: closed_form  !! absent: none is known
        type(trajectory_plan_t), intent(inout) :: finer(2)   !! of `plan_finer`; used up
        type(final_state_t), intent(in) :: seen                  !! of the run itself,
        integer(i8), intent(in) :: steps                     !! and how many it took
        class(observer_t), pointer, intent(in) :: progress
        !! hears the runs go on, from `share_of_run`; may be null
        type(final_value_t), allocatable, intent(out) :: state(:)
        !! (time,) coordinates, velocities
        type(error_t), allocatable, intent(out) :: error  !! why a finer run failed
        type(final_state_t) :: half, quarter
        real(dp), allocatable :: first(:), second(:), third(:), most(:), other(:), rounding(:)
        real(dp), allocatable :: by_motion(:), clock(:)
        type(part_t), target :: part
        real(dp) :: shrinking, step
        logical :: known, uneven

        step = (seen%t - scene%t0)/max(steps, 1_i8)
        part%whole => progress
        part%from = share_of_run
        part%to = 3.0_dp*share_of_run
        call run_finer(finer(1), system, 0.5_dp*step, steps, &
                       scene%tolerance, part, half, shrinking, error)
        part%from = part%to
        part%to = 7.0_dp*share_of_run
        if (.not. allocated(error)) call run_finer(finer(2), system, 0.25_dp*step, steps, &
                                                   scene%tolerance, part, quarter, shrinking, &
                                                   error)
        if (allocated(error)) then
            call error%add_context(context)
            return
        end if
        allocate (first, source=[seen%t, seen%q, seen%v])
        allocate (second, source=[half%t, half%q, half%v])
        allocate (third, source=[quarter%t, quarter%q, quarter%v])
        allocate (most, source=[max(abs(scene%t0), abs(seen%t)), max(seen%q_most, half%q_most), &
                                max(seen%v_most, half%v_most)])
        allocate (other, mold=first)
        call name_state(system, state)
        state%value = first
        state%most = most
        rounding = 2.0_dp*epsilon(most)*most
        clock = rounding_of_clock(system, seen, most(1))
        state%error = vouched*max(estimate(first, second, third, most, shrinking), &
                                  rounding + clock)
        call by_other_method(scene, system, seen, finer(2)%events, 100_i8*steps + 100000_i8, &
                             other, known)
        if (known) then
            uneven = scene%tolerance > 0.0_dp
            state%error = agreement(first, second, third, other, most, shrinking, uneven)
            by_motion = agreement(first, second, third, other, size_of_motion(scene, system, &
                                  seen, most), shrinking, uneven)
            state(2:)%error = min(state(2:)%error, by_motion(2:))
            state%error = state%error + rounding
        end if
        if (scene%tolerance > 0.0_dp) state%error = max(state%error, rounding + &
                                                        rounding_of_end(scene, system, seen))
        if (lingers(system, seen, rests) .and. &
            maxval(state%error/max(most, tiny(most))) > amplified) state%error = linger*state%error
        if (lingers(system, seen, slows)) then
            if (.not. known) other = third
            state%error = max(state%error, most*grown_since(scene, system, seen, quarter, reshape( &
                [first(2:), second(2:), third(2:), other(2:)], [size(first) - 1, 4])))
        end if
        call by_closed_form(scene, system, seen, closed_form, other, known)
        if (known) state%error = max(state%error, abs(first - other) + rounding + clock)
        if (seen%t >= scene%t0 + scene%duration) state = state(2:)
    end subroutine state_accuracy

    pure function grown_since(scene, system, seen, finest, ends) result(share)
        !! What an error of the motion, beside its size, has become that grew while the motion was
        !! near a saddle, if at all: from when it was first away from it, if the energy says how
        !! large the error was; that of the start until then, too.
        type(scene_t), intent(in) :: scene
        class(system_t), intent(in) :: system
        type(final_state_t), intent(in) :: seen, finest  !! of the run, of the finest one
        real(dp), intent(in) :: ends(:, :)  !! of `unresolved_growth`
        real(dp) :: share, rate, error, first, of_start, terms

        share = 0.0_dp
        rate = unresolved_growth(system, seen, ends)
        if (rate <= 0.0_dp) return
        error = max(2.0_dp*epsilon(error), scene%tolerance)
        first = scene%t0
        of_start = 0.0_dp
        terms = system%natural_size(0, scene%t0, scene%q, scene%v)
        if (system%conserves_energy() .and. terms > 0.0_dp) then
            error = max(error, abs(system%energy(seen%t, seen%q, seen%v) - &
                                   system%energy(finest%t, finest%q, finest%v))/terms)
            first = minval(seen%t_slow)
            of_start = 2.0_dp*epsilon(error)*exp(min(rate*(first - scene%t0), 300.0_dp))* &
                       maxval((abs(scene%q) + abs(scene%v)/rate)/max(seen%q_most, tiny(error)))
        end if
        share = (error + of_start)*exp(min(rate*(seen%t - first), 300.0_dp))
    end function grown_since

    pure function size_of_motion(scene, system, seen, most) result(motion)
        !! Of each number of the state: what an error of the motion is a share of. Of a coordinate
        !! it is no more than its way, by its largest speed and by the accelerations at both ends:
        !! a pendulum that swings a little about 2 pi is known as well as one about 0.
        type(scene_t), intent(in) :: scene
        class(system_t), intent(in) :: system
        type(final_state_t), intent(in) :: seen
        real(dp), intent(in) :: most(:)  !! largest magnitudes
        real(dp) :: motion(size(most)), a(system%ndof), a_end(system%ndof), way(system%ndof)
        real(dp), parameter :: least = 1e-12_dp  ! of a coordinate, far above its rounding

        motion = most
        call system%accelerations(scene%t0, scene%q, scene%v, a)
        call system%accelerations(seen%t, seen%q, seen%v, a_end)
        associate (n => system%ndof, t => seen%t - scene%t0)
            way = abs(seen%q - scene%q) + t*most(2 + n:) + t**2*(abs(a) + abs(a_end))
            where (way < most(2:1 + n)) motion(2:1 + n) = max(way, least*most(2:1 + n))
        end associate
    end function size_of_motion

    pure function rounding_of_clock(system, seen, t_most) result(lost)
        !! Of the state, by impacts: each is at a time that is rounded, which shifts the motion
        !! after it, to either side.
        class(system_t), intent(in) :: system
        type(final_state_t), intent(in) :: seen
        real(dp), intent(in) :: t_most  !! the latest time, s
        real(dp) :: lost(1 + 2*system%ndof), a(system%ndof)

        lost = 0.0_dp
        if (system%contacts == 0) return
        call system%accelerations(seen%t, seen%q, seen%v, a)
        lost(2:) = sqrt(real(seen%events, dp))*epsilon(lost)*t_most*abs([seen%v_most, a])
    end function rounding_of_clock

    pure function rounding_of_end(scene, system, seen) result(lost)
        !! Of the state, where the last step ends at the start plus the duration on the clock.
        type(scene_t), intent(in) :: scene
        class(system_t), intent(in) :: system
        type(final_state_t), intent(in) :: seen
        real(dp) :: lost(1 + 2*system%ndof), a(system%ndof)

        call system%accelerations(seen%t, seen%q, seen%v, a)
        lost(1) = 0.0_dp
        lost(2:) = abs(lost_by_clock(scene%t0, scene%duration)*[seen%v, a])
    end function rounding_of_end

    pure subroutine name_state(system, state)
        !! Time, coordinates, velocities.
        class(system_t), intent(in) :: system
        type(final_value_t), allocatable, intent(out) :: state(:)
        type(description_t) :: d
        integer :: i, n

        n = system%ndof
        call system%describe(d)
        allocate (state(1 + 2*n))
        state(1)%name = "t"
        state(1)%unit = "s"
        do i = 1, n
            associate (q => d%coordinates(i))
                state(1 + i)%name = q%name
                state(1 + i)%unit = q%unit
                state(1 + n + i)%name = trim(q%name)//"_dot"
                state(1 + n + i)%unit = trim(q%unit)//"/s"
            end associate
        end do
    end subroutine name_state

    pure function estimate(first, second, third, most, shrinking) result(error)
        !! Of the first of three runs, each number by itself.
        real(dp), intent(in) :: first(:), second(:), third(:)  !! ends of the runs, (n)
        real(dp), intent(in) :: most(:)    !! largest magnitudes
        real(dp), intent(in) :: shrinking  !! of the error from one run to the next, expected
        real(dp) :: error(size(first))
        real(dp) :: d1(size(first)), d2(size(first)), unit(size(first)), odd

        d1 = abs(first - second)
        d2 = abs(second - third)
        unit = max(most, tiny(most))
        error = abs(first - third) + d2/(shrinking - 1.0_dp)
        where (2.0_dp*d2 > d1) error = max(error, d1, d2)
        odd = abs(shrinking*maxval(d2/unit) - maxval(d1/unit))/max(maxval(d1/unit), tiny(odd))
        error = max(error, min(caution, odd)*most*maxval(error/unit), 2.0_dp*epsilon(most)*most)
    end function estimate

    pure subroutine nudge(scene, system, sense, near)
        !! The scene from a state, and where that matters a time, a last digit away.
        type(scene_t), intent(in) :: scene
        class(system_t), intent(in) :: system
        integer, intent(in) :: sense  !! 1 or -1
        type(scene_t), intent(out) :: near

        near = scene
        near%q = scene%q*(1.0_dp + sense*epsilon(1.0_dp))
        near%v = scene%v*(1.0_dp - sense*epsilon(1.0_dp))
        if (system%time_dependent) near%t0 = scene%t0*(1.0_dp + sense*epsilon(1.0_dp))
    end subroutine nudge

    pure function agreement(first, second, third, other, most, shrinking, uneven) result(error)
        !! Of the first run, each number by itself: its distance to the other end, and that one's
        !! error, which is taken to be `margin` times its distance to the third run, the worst of
        !! all numbers. Two ends may be near by chance: what the change \(d_2\) from the second run
        !! to the third is more than \(|d_1|/\)`shrinking` is noise, and counts as such a distance.
        !! Of steps that follow a tolerance that error is no less than the number's own \(d_2\).
        real(dp), intent(in) :: first(:), second(:), third(:)  !! ends of the three runs
        real(dp), intent(in) :: other(:)                       !! by the other method
        real(dp), intent(in) :: most(:)                        !! largest magnitudes, or ways
        real(dp), intent(in) :: shrinking  !! of the error from one run to the next, expected
        logical, intent(in) :: uneven      !! steps that follow a tolerance
        real(dp) :: error(size(first))
        real(dp) :: unit(size(first)), d1, d2, apart

        unit = max(most, tiny(most))
        d1 = maxval(abs(first - second)/unit)
        d2 = maxval(abs(second - third)/unit)
        apart = max(maxval(abs(third - other)/unit), d2 - d1/shrinking)
        error = margin*most*apart
        if (uneven) error = max(error, abs(second - third))
        error = abs(first - other) + error
    end function agreement

    subroutine refine(scene, system, k, fine)
        !! The scene at \(2^{-k}\) of its step or \(100^{-k}\) of its tolerance, if that can be had.
        type(scene_t), intent(in) :: scene
        class(system_t), intent(in) :: system
        integer, intent(in) :: k
        type(scene_t), intent(out) :: fine
        class(dense_integrator_t), allocatable :: method

        fine = scene
        if (scene%tolerance > 0.0_dp) then
            call new_adaptive(trim(scene%method), method)
            fine%tolerance = max(scene%tolerance/100.0_dp**k, &
                                 sensible_tolerance(method, system, scene%t0, scene%duration, &
                                                    scene%q, scene%v))
        else
            fine%dt = scene%duration/steps_of(scene, k)
            fine%every = scene%every*2**k
        end if
    end subroutine refine

    pure function steps_of(scene, k) result(steps)
        !! Their number in the finer run: \(2n + 1\) where n, or a part less, are in the one before.
        !! Were they exactly halved, rounding could go the same way in all runs, unseen.
        type(scene_t), intent(in) :: scene
        integer, intent(in) :: k
        real(dp) :: steps

        steps = 2.0_dp**k*(anint(scene%duration/scene%dt) + 1.0_dp) - 1.0_dp
    end function steps_of

    subroutine run_finer(plan, system, longest, steps, tolerance, progress, seen, shrinking, &
                         error)
        !! From the start to the end, or to the event that ends it. A method that chooses its steps
        !! may find no reason in the tolerance to shorten them: hence the bound. Where the tolerance
        !! is less than rounding leaves, as in a wall so thin that its place is rounded, steps
        !! become ever shorter: then more must do.
        type(trajectory_plan_t), intent(inout) :: plan
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: longest    !! step of a method that chooses them, s
        integer(i8), intent(in) :: steps   !! of the run itself
        real(dp), intent(in) :: tolerance  !! of the run itself; 0: it has none
        class(observer_t), target, intent(inout) :: progress  !! hears how far it is
        type(final_state_t), target, intent(out) :: seen
        real(dp), intent(out) :: shrinking  !! of the error at half the step, a tenth of tolerance
        type(error_t), allocatable, intent(out) :: error
        type(observer_box_t) :: observers(2)
        real(dp) :: t

        select type (method => plan%integrator)
        class is (dense_integrator_t)
            method%longest = longest
            method%most_steps = 100*steps + 100000
        end select
        observers(1)%item => seen
        observers(2)%item => progress
        shrinking = 10.0_dp  ! at least, by a hundredth of the tolerance
        if (plan%times%samples == 0) shrinking = 2.0_dp**plan%integrator%order
        do
            call drive(system, plan%integrator, plan%times, plan%events, observers, plan%q, &
                       plan%v, t, error)
            if (.not. allocated(error)) return
            if (error%status /= status_numbers) return
            select type (method => plan%integrator)
            class is (dense_integrator_t)
                if (.not. 20.0_dp*method%tolerance < tolerance) return
                method%tolerance = 10.0_dp*method%tolerance
            class default
                return
            end select
            seen = final_state_t()
            shrinking = 2.0_dp
        end do
    end subroutine run_finer
end module lagrangia_accuracy
