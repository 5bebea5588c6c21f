module lagrangia_run
    !! The one loop: a system, an integrator, and whoever wants to see the states.
    use lagrangia_errors, only: error_t, fail
    use lagrangia_integrator, only: dense_integrator_t, integrator_t
    use lagrangia_interrupt, only: interrupt_status
    use lagrangia_kinds, only: dp, i8
    use lagrangia_number_class, only: all_finite
    use lagrangia_observer, only: check_observers, observer_box_t
    use lagrangia_state_check, only: blame_mass_matrix, check_start
    use lagrangia_system, only: system_t
    use lagrangia_time_grid, only: time_grid_t
    implicit none (type, external)
    private
    public :: run

    integer(i8), parameter :: longest_block = 1024  !! steps between two looks at signals

contains

    subroutine run(system, integrator, grid, observers, q, v, error)
        !! Integrate from `t0` over `duration`, showing every sample and the end to `observers`.
        !!
        !! A state that is not finite ends the run, as does an observer's error or a signal. A run
        !! that fails has shown what was good, and `q` and `v` are as they were.
        class(system_t), intent(in) :: system  !! whose motion it is
        class(integrator_t), intent(inout) :: integrator  !! is prepared here
        type(time_grid_t), intent(in) :: grid  !! of steps
        type(observer_box_t), intent(in) :: observers(:)  !! are called in this order
        real(dp), intent(inout) :: q(:), v(:)  !! the start; the end on return, (system%ndof)
        type(error_t), allocatable, intent(out) :: error  !! why the run ended early
        real(dp) :: q_start(system%ndof), v_start(system%ndof)
        real(dp) :: q_known(system%ndof), v_known(system%ndof)  ! at step `known`, finite
        integer(i8) :: done, block_end, known
        integer :: i
        logical :: followed

        if (system%contacts > 0) then
            call fail(error, "unilateral constraints need a run that looks for impacts: run_dense")
            return
        end if
        if (grid%every < 1 .or. grid%samples > 0) then
            call fail(error, "the time grid is not one of new_time_grid")
            return
        end if
        call check_start(system, grid%t0, q, v, error)
        if (.not. allocated(error)) call check_observers(observers, error)
        if (allocated(error)) return
        call integrator%prepare(system, error)
        if (allocated(error)) return
        call integrator%start(system, grid%t0, q, v)
        done = 0
        known = 0
        q_start = q
        v_start = v
        q_known = q
        v_known = v
        followed = any([(observers(i)%item%follows(), i=1, size(observers))])
        call show(grid%t0)
        do while (done < grid%steps .and. .not. allocated(error))
            block_end = min(grid%steps, done + merge(1_i8, longest_block, followed), &
                            (done/grid%every + 1)*grid%every)
            call integrator%advance(system, grid%t0, grid%dt, done, block_end - done, q, v)
            done = block_end
            if (followed) call follow(time_of(done))
            if (mod(done, grid%every) == 0 .or. (done == grid%steps .and. grid%rest <= 0.0_dp)) then
                call show(time_of(done))
            else
                call look_around()
            end if
        end do
        if (grid%rest > 0.0_dp .and. .not. allocated(error)) then
            call integrator%advance(system, time_of(done), grid%rest, 0_i8, 1_i8, q, v)
            if (followed) call follow(grid%t0 + grid%duration)
            call show(grid%t0 + grid%duration)
        end if
        if (.not. allocated(error)) return
        q = q_start
        v = v_start
    contains
        pure function time_of(k) result(t)
            integer(i8), intent(in) :: k
            real(dp) :: t

            t = grid%t0 + k*grid%dt
            if (k == grid%steps .and. grid%rest <= 0.0_dp) t = grid%t0 + grid%duration
        end function time_of

        subroutine follow(t)
            ! A closed form knows the motion between the steps, which who sums from sample to sample
            ! may ask; of other methods only their ends are known.
            real(dp), intent(in) :: t
            integer :: j

            do j = 1, size(observers)
                if (.not. observers(j)%item%follows()) cycle
                select type (integrator)
                class is (dense_integrator_t)
                    if (integrator%whole .and. observers(j)%item%follows_samples()) then
                        call observers(j)%item%follow_inside(integrator, t)
                        cycle
                    end if
                end select
                call observers(j)%item%follow(system, t, q, v)
            end do
        end subroutine follow

        subroutine show(t)
            real(dp), intent(in) :: t
            integer :: i

            call integrator%refuse_state(t, grid%dt, q, v, error)
            if (allocated(error)) call find_cause()
            if (allocated(error)) return
            known = done
            q_known = q
            v_known = v
            do i = 1, size(observers)
                call observers(i)%item%observe(system, t, q, v, error)
                if (allocated(error)) return
            end do
            call look_around()
        end subroutine show

        subroutine find_cause()
            !! Once more, step by step, from the last state that is known to be finite.
            type(error_t), allocatable :: refused
            integer(i8) :: evaluations

            evaluations = integrator%evaluations
            call integrator%prepare(system, refused)
            q = q_known
            v = v_known
            call integrator%start(system, grid%t0 + known*grid%dt, q, v)
            do while (known < done)
                call integrator%advance(system, grid%t0, grid%dt, known, 1_i8, q, v)
                if (.not. all_finite([q, v])) exit
                known = known + 1
                q_known = q
                v_known = v
            end do
            integrator%evaluations = evaluations
            call blame_mass_matrix(system, grid%t0 + known*grid%dt, grid%dt, q_known, v_known, &
                                   error)
        end subroutine find_cause

        subroutine look_around()
            integer :: i

            if (interrupt_status() /= 0) then
                call fail(error, "interrupted", interrupt_status())
                return
            end if
            do i = 1, size(observers)
                call observers(i)%item%tick(done, grid%steps)
            end do
        end subroutine look_around
    end subroutine run
end module lagrangia_run
