program tolerance
    !! By how many tolerances the end of an adaptive run is off.
    !!
    !!     tolerance smooth          240 smooth runs of each method
    !!     tolerance large           pendulums at a million radians
    !!     tolerance kinks [ends]    forces with kinks and jumps; `ends`: without dense output
    use, intrinsic :: iso_fortran_env, only: real128
    use kinked, only: exact_end, kind_names, kinds, kinked_t
    use lagrangia_catalogue, only: new_system
    use lagrangia_errors, only: error_t
    use lagrangia_gauss, only: gauss_t, new_gauss16
    use lagrangia_integrator, only: dense_integrator_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_methods, only: new_adaptive
    use lagrangia_system, only: system_t
    implicit none (type, external)

    integer, parameter :: motions = 50
    real(dp), parameter :: duration = 10.0_dp
    character(8), parameter :: methods(2) = [character(8) :: "gauss16", "dop853"]
    character(8) :: word(2) = ""
    integer :: i

    do i = 1, min(2, command_argument_count())
        call get_command_argument(i, word(i))
    end do
    select case (word(1))
    case ("smooth"); call smooth()
    case ("large"); call large()
    case ("kinks"); call kinks(word(2) /= "ends")
    case default
        error stop "tolerance smooth|large|kinks [ends]"
    end select
contains
    subroutine restart_random()
        !! The same numbers whatever was drawn before.
        integer :: n, k

        call random_seed(size=n)
        call random_seed(put=[(k, k=1, n)])
    end subroutine restart_random

    subroutine go(name, tol, dense, system, y, done, cost)
        !! Run `y` over the duration; `cost` has evaluations, accepted and rejected steps.
        character(*), intent(in) :: name
        real(dp), intent(in) :: tol
        logical, intent(in) :: dense
        class(system_t), intent(in) :: system
        real(dp), intent(inout) :: y(:)
        logical, intent(out) :: done
        integer(i8), intent(inout) :: cost(3)
        class(dense_integrator_t), allocatable :: method
        type(error_t), allocatable :: error
        integer :: n

        n = system%ndof
        call new_adaptive(trim(name), method)
        method%tolerance = tol
        method%dense = dense
        call method%prepare(system, error)
        call method%start(system, 0.0_dp, y(:n), y(n + 1:), duration)
        do while (method%t_new < duration .and. .not. allocated(error))
            call method%step(system, error)
        end do
        done = .not. allocated(error)
        call method%state_at(duration, y(:n), y(n + 1:))
        cost = cost + [method%evaluations, method%accepted, method%rejected]
    end subroutine go

    subroutine fine(system, y)
        !! `gauss16` with 4000 fixed steps: right to some 1e-14.
        class(system_t), intent(in) :: system
        real(dp), intent(inout) :: y(:)
        type(gauss_t) :: method
        type(error_t), allocatable :: error

        call new_gauss16(method)
        call method%prepare(system, error)
        call method%advance(system, 0.0_dp, duration/4000, 0_i8, 4000_i8, y(:system%ndof), &
                            y(system%ndof + 1:))
    end subroutine fine

    subroutine smooth()
        !! Four systems, twelve starts, five tolerances.
        character(20), parameter :: names(4) = [character(20) :: "oscillator", "pendulum", &
            "cart_pendulum", "double_pendulum"]
        class(system_t), allocatable :: system
        type(error_t), allocatable :: error
        real(dp), allocatable :: y(:), y_true(:), y_start(:)
        integer(i8) :: cost(3, 2)
        real(dp) :: off, worst(2)
        integer :: s, k, m, j, within(2), runs
        logical :: done

        within = 0
        worst = 0.0_dp
        cost = 0
        runs = 0
        call restart_random()
        do s = 1, size(names)
            call new_system(trim(names(s)), system, error)
            do j = 1, 12
                if (allocated(y_start)) deallocate (y_start)
                allocate (y_start(2*system%ndof))
                call random_number(y_start)
                y_start = 2.0_dp*y_start - 1.0_dp
                y_true = y_start
                call fine(system, y_true)
                do k = 4, 12, 2
                    runs = runs + 1
                    do m = 1, 2
                        y = y_start
                        call go(methods(m), 10.0_dp**(-k), .true., system, y, done, cost(:, m))
                        off = maxval(abs(y - y_true)/max(1.0_dp, abs(y_true)))*10.0_dp**k
                        if (.not. done) off = huge(off)
                        if (off <= 10.0_dp) within(m) = within(m) + 1
                        worst(m) = max(worst(m), off)
                    end do
                end do
            end do
        end do
        print "(a)", "method    runs  within ten tolerances   worst  evaluations   steps  rejected"
        do m = 1, 2
            print "(a8, i6, i23, es8.1, i13, i8, i10)", methods(m), runs, within(m), worst(m), &
                cost(:, m)
        end do
    end subroutine smooth

    subroutine large()
        !! From angles about 1e6 rad, against the same motion about 0.
        class(system_t), allocatable :: system
        type(error_t), allocatable :: error
        real(dp) :: y(2), y_true(2), x(2), off(2), worst(2)
        real(real128) :: turns
        integer(i8) :: cost(3)
        integer :: m, k, j
        logical :: done

        call new_system("pendulum", system, error)
        print "(a)", "method    tolerance  angle   rate (tolerances)  evaluations   steps  rejected"
        do m = 1, 2
            do k = 4, 12, 2
                call restart_random()
                worst = 0.0_dp
                cost = 0
                do j = 1, motions
                    call random_number(x)
                    y = [1e6_dp*(1.0_dp + x(1)), 8.0_dp*x(2)]
                    turns = 2.0_real128*acos(-1.0_real128)
                    turns = turns*anint(real(y(1), real128)/turns)
                    y_true = [real(y(1) - turns, dp), y(2)]
                    call fine(system, y_true)
                    call go(methods(m), 10.0_dp**(-k), .true., system, y, done, cost)
                    off = abs([real(y(1) - turns, dp), y(2)] - y_true)/[1e6_dp, 1.0_dp]*10.0_dp**k
                    worst = max(worst, off)
                    if (.not. done) worst = huge(off)
                end do
                print "(a8, es12.0, 2es10.1, i20, i8, i10)", methods(m), 10.0_dp**(-k), worst, cost
            end do
        end do
    end subroutine large

    subroutine kinks(dense)
        !! Random strengths, places and starts.
        logical, intent(in) :: dense
        type(kinked_t) :: system
        type(error_t), allocatable :: error
        real(dp) :: x(4), y(2), y_true(2), off, worst, typical
        integer(i8) :: cost(3)
        integer :: which, m, k, j, failures
        logical :: done

        print "(a)", "force                method    tolerance   worst   typical (tolerances)"// &
            "  evaluations   steps  rejected  refused"
        do which = 1, kinds
            do m = 1, 2
                do k = 4, 12, 2
                    call restart_random()
                    worst = 0.0_dp
                    typical = 0.0_dp
                    cost = 0
                    failures = 0
                    do j = 1, motions
                        call random_number(x)
                        call system%configure([real(which, dp), 10.0_dp**(6.5_dp*x(1) - 6.0_dp), &
                                               1.6_dp*x(2) - 0.8_dp], error)
                        if (which == 2) system%strength = 1e-2_dp*system%strength
                        if (which > 2) system%place = duration*x(2)
                        y = [1.0_dp + 2.0_dp*x(3), 2.0_dp*x(4) - 1.0_dp]
                        call exact_end(system, y(1), y(2), duration, y_true(1), y_true(2))
                        call go(methods(m), 10.0_dp**(-k), dense, system, y, done, cost)
                        if (.not. done) failures = failures + 1
                        if (.not. done) cycle
                        off = maxval(abs(y - y_true))*10.0_dp**k
                        worst = max(worst, off)
                        typical = typical + log10(max(off, 1e-3_dp))/motions
                    end do
                    print "(a20, 1x, a8, es11.0, 2es9.1, i25, i8, i10, i9)", kind_names(which), &
                        methods(m), 10.0_dp**(-k), worst, 10.0_dp**typical, cost, failures
                end do
            end do
        end do
    end subroutine kinks
end program tolerance
