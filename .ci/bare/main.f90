program main
    !! `bare loop STEPS`: RK4 on the pendulum by `advance` and nothing else. `bare run STEPS`: the
    !! same by `run` with no observers. `bare METHOD STEPS [SYSTEM]`: that method on every system
    !! that it takes, or on one. `bare names`: the methods. valgrind counts instructions and
    !! allocations.
    use lagrangia_catalogue, only: new_system, nth_system, system_names
    use lagrangia_description, only: name_length
    use lagrangia_errors, only: error_t
    use lagrangia_integrator, only: dense_integrator_t, integrator_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_methods, only: adaptive_names, method_names, new_adaptive, new_integrator
    use lagrangia_observer, only: observer_box_t
    use lagrangia_run, only: run
    use lagrangia_system, only: system_t
    use lagrangia_time_grid, only: new_time_grid, time_grid_t
    implicit none (type, external)
    real(dp), parameter :: dt = 1e-3_dp
    character(name_length) :: what, count, only_system
    character(name_length), allocatable :: names(:)
    type(error_t), allocatable :: error
    integer(i8) :: steps

    call get_command_argument(1, what)
    call get_command_argument(2, count)
    call get_command_argument(3, only_system)
    steps = 0
    if (count /= "") read (count, *) steps
    allocate (names, source=system_names())
    select case (what)
    case ("names")
        print "(a)", method_names(), adaptive_names()
    case ("loop", "run")
        call pendulum(what == "run")
    case default
        call every_system()
        call every_system_adaptive()
    end select
    if (allocated(error)) stop 1

contains

    subroutine pendulum(by_run)
        !! RK4, with or without the loop around it.
        logical, intent(in) :: by_run
        class(system_t), allocatable :: system
        class(integrator_t), allocatable :: method
        type(observer_box_t) :: nobody(0)
        type(time_grid_t) :: plan
        real(dp) :: q(1), v(1)

        call new_system("pendulum", system, error)
        if (allocated(error)) return
        call new_integrator("rk4", method, error)
        if (allocated(error)) return
        q = 1.0_dp
        v = 0.0_dp
        call new_time_grid(plan, 0.0_dp, dt, steps*dt, steps, error)
        if (allocated(error)) return
        if (by_run) then
            call run(system, method, plan, nobody, q, v, error)
        else
            call method%prepare(system, error)
            call method%advance(system, 0.0_dp, dt, 0_i8, steps, q, v)
        end if
        print "(2es25.16)", q, v
    end subroutine pendulum

    subroutine every_system()
        !! One block of steps each.
        class(system_t), allocatable :: system
        class(integrator_t), allocatable :: method
        type(error_t), allocatable :: refusal
        real(dp), allocatable :: q(:), v(:)
        integer :: i, k

        call new_integrator(trim(what), method, refusal)
        if (.not. allocated(method)) return
        i = 0
        do
            i = i + 1
            call nth_system(i, system)
            if (.not. allocated(system)) exit
            if (only_system /= "" .and. names(i) /= only_system) cycle
            call method%prepare(system, refusal)
            if (allocated(refusal)) cycle
            allocate (q(system%ndof), v(system%ndof))
            q = [(0.2_dp + 0.1_dp*k, k=1, size(q))]
            v = 0.0_dp
            call method%advance(system, 0.0_dp, dt, 0_i8, steps, q, v)
            deallocate (q, v)
        end do
    end subroutine every_system

    subroutine every_system_adaptive()
        !! By tolerance, over as many seconds as there are thousands of steps.
        class(system_t), allocatable :: system
        class(dense_integrator_t), allocatable :: method
        type(error_t), allocatable :: refusal
        real(dp), allocatable :: q(:), v(:)
        integer :: i, k

        call new_adaptive(trim(what), method)
        if (.not. allocated(method)) return
        i = 0
        do
            i = i + 1
            call nth_system(i, system)
            if (.not. allocated(system)) exit
            if (only_system /= "" .and. names(i) /= only_system) cycle
            call method%prepare(system, refusal)
            if (allocated(refusal)) cycle
            allocate (q(system%ndof), v(system%ndof))
            q = [(0.2_dp + 0.1_dp*k, k=1, size(q))]
            v = 0.0_dp
            call method%start(system, 0.0_dp, q, v, dt*steps)
            do while (method%t_new < dt*steps)
                call method%step(system, refusal)
                if (allocated(refusal)) exit
            end do
            deallocate (q, v)
        end do
    end subroutine every_system_adaptive
end program main
