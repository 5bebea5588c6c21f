program quad
    !! References in quadruple precision, by the library's own systems and `gauss16`.
    !!
    !!     quad bench FILE     integrate the problems of the bench; compare with the ends in FILE
    !!     quad swings         print double pendulums, with their ends, as a namelist file
    !!     quad judge FILE     what .ci/digits has drawn: is a stated digit wrong?
    !!
    !! Each motion is integrated twice, with steps of one length and of half that: what is left of
    !! the error is 2**-16 of the change. Parameters and starts are doubles.
    use, intrinsic :: iso_fortran_env, only: error_unit, output_unit, real64
    use digits_judge, only: judge
    use lagrangia_cart_pendulum, only: cart_pendulum_t
    use lagrangia_charged_particle, only: charged_particle_t
    use lagrangia_description, only: description_t
    use lagrangia_double_pendulum, only: double_pendulum_t
    use lagrangia_errors, only: error_t
    use lagrangia_gauss, only: gauss_t, new_gauss16
    use lagrangia_kinds, only: dp, i8, qp
    use lagrangia_oscillator, only: oscillator_t
    use lagrangia_pendulum, only: pendulum_t
    use lagrangia_system, only: default_values, system_t
    implicit none (type, external)

    integer, parameter :: most = 9
    real(dp), parameter :: agreement = 1e-28_dp

    type :: problem_t
        !! A motion from `t = 0` over `duration`, and where it ends.
        character(80) :: title = ""
        character(32) :: system = ""
        real(real64) :: parameters(most) = 0.0_real64, duration = 0.0_real64
        real(real64) :: q(most) = 0.0_real64, v(most) = 0.0_real64
        real(qp) :: q_end(most) = 0.0_qp, v_end(most) = 0.0_qp
    end type problem_t

    character(1024) :: mode, path
    logical :: good

    call get_command_argument(1, mode)
    call get_command_argument(2, path)
    if (dp /= qp) call give_up("build this with --flag -DREAL128")
    select case (mode)
    case ("bench"); call check_bench(trim(path))
    case ("swings"); call print_swings()
    case ("judge")
        call judge(trim(path), good)
        if (.not. good) call give_up("a digit is wrong, or none was stated")
    case default; call give_up("usage: quad bench FILE | quad swings | quad judge FILE")
    end select

contains

    subroutine give_up(message)
        !! Say why, and end.
        character(*), intent(in) :: message

        write (error_unit, "(2a)") "quad: ", message
        stop 1, quiet=.true.
    end subroutine give_up

    subroutine check_bench(path)
        !! Every problem of the file; ends with status 1 if one does not agree.
        character(*), intent(in) :: path
        character(10), parameter :: names(*) = [character(10) :: "oscillator", "p1", "p1a", "p2", &
                                                "p3", "p4"]
        integer, parameter :: steps(*) = [1000, 5000, 2500, 5000, 10000, 5000]
        type(problem_t) :: problem
        real(dp) :: q(most), v(most), change, distance
        logical :: good
        integer :: i, n

        good = .true.
        write (output_unit, "(a)") "problem      steps  h/2 changes  off the file"
        do i = 1, size(names)
            call read_problem(path, trim(names(i)), problem)
            call integrate(problem, int(steps(i), i8), n, q, v, change)
            distance = max(maxval(abs(q(:n) - problem%q_end(:n))), &
                           maxval(abs(v(:n) - problem%v_end(:n))))
            write (output_unit, "(a, i8, 2es13.1e3)") names(i), 2*steps(i), change, distance
            good = good .and. distance < agreement
        end do
        if (.not. good) call give_up("an end is farther from the file's than 1e-28")
    end subroutine check_bench

    subroutine read_problem(path, name, problem)
        !! The group called `name`.
        character(*), intent(in) :: path, name
        type(problem_t), intent(out) :: problem
        character(80) :: title
        character(32) :: system
        real(real64) :: parameters(most), q(most), v(most), duration
        real(qp) :: q_end(most), v_end(most)
        namelist /oscillator/ title, system, parameters, q, v, duration, q_end, v_end
        namelist /p1/ title, system, parameters, q, v, duration, q_end, v_end
        namelist /p1a/ title, system, parameters, q, v, duration, q_end, v_end
        namelist /p2/ title, system, parameters, q, v, duration, q_end, v_end
        namelist /p3/ title, system, parameters, q, v, duration, q_end, v_end
        namelist /p4/ title, system, parameters, q, v, duration, q_end, v_end
        integer :: unit, status

        parameters = 0.0_real64
        q = 0.0_real64
        v = 0.0_real64
        q_end = 0.0_qp
        v_end = 0.0_qp
        open (newunit=unit, file=path, action="read", status="old", iostat=status)
        if (status /= 0) call give_up("cannot read "//path)
        select case (name)
        case ("oscillator"); read (unit, nml=oscillator, iostat=status)
        case ("p1"); read (unit, nml=p1, iostat=status)
        case ("p1a"); read (unit, nml=p1a, iostat=status)
        case ("p2"); read (unit, nml=p2, iostat=status)
        case ("p3"); read (unit, nml=p3, iostat=status)
        case ("p4"); read (unit, nml=p4, iostat=status)
        case default; call give_up("no problem is called "//name)
        end select
        if (status /= 0) call give_up("cannot read &"//name//" in "//path)
        close (unit)
        problem = problem_t(title, system, parameters, duration, q, v, q_end, v_end)
    end subroutine read_problem

    subroutine new_system(problem, system)
        !! The catalogue is not here: it knows closed forms, and they GSL.
        type(problem_t), intent(in) :: problem
        class(system_t), allocatable, intent(out) :: system
        type(description_t) :: d
        type(error_t), allocatable :: error

        select case (problem%system)
        case ("oscillator"); allocate (oscillator_t :: system)
        case ("pendulum"); allocate (pendulum_t :: system)
        case ("double_pendulum"); allocate (double_pendulum_t :: system)
        case ("cart_pendulum"); allocate (cart_pendulum_t :: system)
        case ("charged_particle"); allocate (charged_particle_t :: system)
        case default; call give_up("unknown system "//problem%system)
        end select
        call system%describe(d)
        call system%configure(real(problem%parameters(:size(default_values(d))), dp), error)
        if (allocated(error)) call give_up(error%message)
    end subroutine new_system

    subroutine integrate(problem, steps, n, q, v, change)
        !! The end of the motion by twice as many steps, and how much doubling them changed it.
        type(problem_t), intent(in) :: problem
        integer(i8), intent(in) :: steps
        integer, intent(out) :: n              !! degrees of freedom
        real(dp), intent(out) :: q(:), v(:)    !! the first `n` of each
        real(dp), intent(out) :: change
        class(system_t), allocatable :: system
        type(gauss_t) :: method
        type(error_t), allocatable :: error
        real(dp) :: q_coarse(size(q)), v_coarse(size(v))
        integer :: k

        call new_system(problem, system)
        n = system%ndof
        call new_gauss16(method)
        do k = 1, 2
            q_coarse = q
            v_coarse = v
            q = real(problem%q, dp)
            v = real(problem%v, dp)
            call method%prepare(system, error)
            call method%try_advance(system, 0.0_dp, real(problem%duration, dp)/(k*steps), 0_i8, &
                                    k*steps, q(:n), v(:n), error)
            if (allocated(error)) call give_up(error%message)
        end do
        change = max(maxval(abs(q(:n) - q_coarse(:n))), maxval(abs(v(:n) - v_coarse(:n))))
    end subroutine integrate

    subroutine print_swings()
        !! Large swings of double pendulums, regular and chaotic, of unlike masses and lengths.
        integer, parameter :: starts(4, 6) = reshape([ &  ! in sixteenths
            8, 12, 0, 0, 24, -11, 5, 18, 32, 16, 0, 0, &
            -40, 4, 28, -48, 48, 48, 0, 0, 2, -4, 96, 32], [4, 6])
        integer, parameter :: parameters(5, 3) = reshape([ &
            16, 16, 16, 16, 157, 40, 12, 10, 22, 157, 8, 48, 20, 14, 26], [5, 3])
        real(real64), parameter :: durations(2) = [2.0_real64, 10.0_real64]
        character(*), parameter :: starts_as = "(2x, a, ' = ', *(f7.4, :, ', '))"
        character(*), parameter :: ends_as = "(2x, a, ' = ', *(es34.27e2, :, ', '))"
        type(problem_t) :: problem
        real(dp) :: q(most), v(most), change
        integer :: i, k, n

        problem%system = "double_pendulum"
        write (output_unit, "(a)") "! Double pendulums from (q, v), and their ends to 28 digits.", &
            "! Made by: .ci/quad/check.sh (gauss16 in quadruple precision, two steps)."
        do i = 1, size(starts, 2)
            do k = 1, size(durations)
                problem%parameters(:5) = parameters(:, 1 + mod(i - 1, 3))/16.0_real64
                problem%q(:2) = starts(:2, i)/16.0_real64
                problem%v(:2) = starts(3:, i)/16.0_real64
                problem%duration = durations(k)
                call integrate(problem, nint(800*durations(k), i8), n, q, v, change)
                if (change > 1e-24_dp) call give_up("a swing is not good to 28 digits")
                write (output_unit, "(/, a, i0)") "&swing", 2*i + k - 2
                write (output_unit, starts_as) "parameters", problem%parameters(:5)
                write (output_unit, starts_as) "q", problem%q(:2)
                write (output_unit, starts_as) "v", problem%v(:2)
                write (output_unit, starts_as) "duration", problem%duration
                write (output_unit, ends_as) "q_end", q(:2)
                write (output_unit, ends_as) "v_end", v(:2)
                write (output_unit, "(a)") "/"
            end do
        end do
    end subroutine print_swings
end program quad
