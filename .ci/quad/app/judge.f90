module digits_judge
    !! Judges what `.ci/digits` has drawn: each stated number beside its value in quadruple
    !! precision. Nothing of the run is used but the system's equations and its stated end.
    use, intrinsic :: iso_fortran_env, only: error_unit, output_unit, real64
    use lagrangia_atwood, only: atwood_t
    use lagrangia_bouncing_ball, only: bouncing_ball_t
    use lagrangia_cart_pendulum, only: cart_pendulum_t
    use lagrangia_charged_particle, only: charged_particle_t
    use lagrangia_double_pendulum, only: double_pendulum_t
    use lagrangia_driven_pendulum, only: driven_pendulum_t
    use lagrangia_errors, only: error_t
    use lagrangia_gauss, only: gauss_t, new_gauss16
    use lagrangia_hanging_chain, only: hanging_chain_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_oscillator, only: oscillator_t
    use lagrangia_pendulum, only: pendulum_t
    use lagrangia_rolling_disk, only: rolling_disk_t
    use lagrangia_rotating_hoop, only: rotating_hoop_t
    use lagrangia_rotating_wire, only: rotating_wire_t
    use lagrangia_system, only: system_t
    use lagrangia_wedge, only: wedge_t
    implicit none (type, external)
    private
    public :: judge

    integer, parameter :: most_corners = 20

    type :: number_t
        !! One stated number.
        real(dp) :: value = 0.0_dp, error = 0.0_dp, most = 0.0_dp
        real(dp) :: centre = 0.0_dp, bracket = 0.0_dp
        logical :: stated = .false.
        character(64) :: text = ""
    end type number_t

    type :: case_t
        !! One run.
        character(:), allocatable :: scene
        character(32) :: system = "", corner = "", method = ""
        integer :: n = 0, level_of = 0
        real(dp) :: t0 = 0.0_dp, duration = 0.0_dp, t = 0.0_dp, level = 0.0_dp
        real(dp), allocatable :: parameters(:), q(:), v(:)
        type(number_t), allocatable :: numbers(:)
    end type case_t

    type :: tally_t
        !! Of one corner.
        character(32) :: corner = ""
        integer :: cases = 0, unjudged = 0, stated = 0, withheld = 0, wrong = 0, sure = 0
        real(dp) :: digits = 0.0_dp
    end type tally_t

contains

    subroutine judge(path, good)
        !! Every case in the file; `good` unless a stated digit is wrong.
        character(*), intent(in) :: path
        logical, intent(out) :: good
        type(tally_t) :: tallies(most_corners), all
        type(case_t) :: drawn
        integer :: unit, status, k, corners
        logical :: more

        open (newunit=unit, file=path, action="read", status="old", iostat=status)
        good = status == 0
        if (.not. good) then
            write (error_unit, "(2a)") "quad: cannot read ", path
            return
        end if
        corners = 0
        do
            call read_case(unit, drawn, more)
            if (.not. more) exit
            k = findloc(tallies(:corners)%corner, drawn%corner, 1)
            if (k == 0) then
                corners = corners + 1
                k = corners
                tallies(k)%corner = drawn%corner
            end if
            call judge_case(drawn, tallies(k))
        end do
        close (unit)
        write (output_unit, "(a)") &
            "corner      cases  not judged  numbers stated  withheld  wrong  right digits"
        all%corner = "all"
        do k = 1, corners
            call print_tally(tallies(k))
            all%cases = all%cases + tallies(k)%cases
            all%unjudged = all%unjudged + tallies(k)%unjudged
            all%stated = all%stated + tallies(k)%stated
            all%withheld = all%withheld + tallies(k)%withheld
            all%wrong = all%wrong + tallies(k)%wrong
            all%digits = all%digits + tallies(k)%digits
        end do
        call print_tally(all)
        good = all%wrong == 0 .and. all%stated > 0
    end subroutine judge

    subroutine print_tally(tally)
        !! One line.
        type(tally_t), intent(in) :: tally

        write (output_unit, "(a10, i7, i12, i16, i10, i7, f14.1)") tally%corner, tally%cases, &
            tally%unjudged, tally%stated, tally%withheld, tally%wrong, tally%digits
    end subroutine print_tally

    subroutine read_case(unit, drawn, more)
        !! The next one; lines that begin with # are remarks.
        integer, intent(in) :: unit
        type(case_t), intent(out) :: drawn
        logical, intent(out) :: more
        character(4096) :: line
        real(real64), allocatable :: doubles(:)  ! the scene's numbers are these, not their decimals
        integer :: status, parameters, numbers, i

        do
            read (unit, "(a)", iostat=status) line
            more = status == 0
            if (.not. more) return
            if (line(1:1) == "&") exit
        end do
        drawn%scene = trim(line)
        read (unit, *) drawn%system, drawn%corner, drawn%method, parameters, drawn%n, numbers, &
            drawn%level_of
        allocate (drawn%numbers(numbers), doubles(parameters + 4 + 2*drawn%n))
        read (unit, *) doubles
        drawn%parameters = doubles(:parameters)
        drawn%t0 = doubles(parameters + 1)
        drawn%duration = doubles(parameters + 2)
        drawn%t = doubles(parameters + 3)
        drawn%level = doubles(parameters + 4)
        drawn%q = doubles(parameters + 5:parameters + 4 + drawn%n)
        drawn%v = doubles(parameters + 5 + drawn%n:)
        do i = 1, numbers
            associate (s => drawn%numbers(i))
                read (unit, *) s%value, s%error, s%most, s%text
                s%stated = s%text /= "no digit left"
                if (s%stated) call read_concise(trim(s%text), s%centre, s%bracket)
            end associate
        end do
    end subroutine read_case

    subroutine read_concise(text, centre, bracket)
        !! `1.23(4)e5` is 1.23e5 and 0.04e5; without a bracket nothing is uncertain.
        character(*), intent(in) :: text
        real(dp), intent(out) :: centre, bracket
        integer :: opened, point, power
        character(64) :: plain

        bracket = 0.0_dp
        opened = index(text, "(")
        if (opened == 0) then
            read (text, *) centre
            return
        end if
        plain = text(:opened - 1)//text(opened + 3:)
        read (plain, *) centre
        read (text(opened + 1:opened + 1), *) bracket
        power = 0
        if (text(opened + 3:) /= "") read (text(opened + 4:), *) power
        point = index(text, ".")
        if (point > 0) power = power - (opened - 1 - point)
        bracket = bracket*10.0_dp**power
    end subroutine read_concise

    subroutine judge_case(drawn, tally)
        !! Each number that was stated beside the truth.
        type(case_t), intent(in) :: drawn
        type(tally_t), intent(inout) :: tally
        real(dp), allocatable :: truth(:)
        logical :: known
        integer :: i

        tally%cases = tally%cases + 1
        tally%withheld = tally%withheld + count(.not. drawn%numbers%stated)
        if (.not. any(drawn%numbers%stated)) return
        call find_truth(drawn, truth, known)
        if (.not. known) then
            tally%unjudged = tally%unjudged + 1
            write (output_unit, "(3a)") "not judged: ", trim(drawn%corner)//": ", drawn%scene
            return
        end if
        do i = 1, size(drawn%numbers)
            associate (s => drawn%numbers(i), off => abs(drawn%numbers(i)%centre - truth(i)))
                if (.not. s%stated) cycle
                tally%stated = tally%stated + 1
                if (off <= s%bracket) then
                    if (s%bracket > 0.0_dp) tally%digits = tally%digits + &
                        log10(max(1.0_dp, s%most/s%bracket))
                    cycle
                end if
                tally%wrong = tally%wrong + 1
                write (output_unit, "(2a, i0, 3a, es25.17e3, a, es8.1, a, es8.1, a, a, /, 2a)") &
                    "WRONG ", trim(drawn%corner)//" ", i, ": ", trim(s%text), " is ", truth(i), &
                    ", off by brackets ", off/s%bracket, " last digits of the largest ", &
                    off/(s%most*epsilon(1.0_real64)), " ", trim(drawn%method), "    ", drawn%scene
            end associate
        end do
    end subroutine judge_case

    subroutine find_truth(drawn, truth, known)
        !! The numbers of the end, far better than their brackets.
        type(case_t), intent(in) :: drawn
        real(dp), allocatable, intent(out) :: truth(:)
        logical, intent(out) :: known
        integer, parameter :: most_doublings = 12
        class(system_t), allocatable :: system
        real(dp) :: q(drawn%n), v(drawn%n), t
        real(dp), allocatable :: before(:)
        integer :: k, first

        call new_system(drawn, system)
        first = size(drawn%numbers) - 2*drawn%n  ! 1 where there is a time
        if (system%contacts > 0) then
            t = drawn%t0 + drawn%duration
            if (first == 1) t = drawn%t
            if (drawn%level_of == 1 .and. abs(drawn%level) <= 0.0_dp) then  ! ends before the impact
                t = t - 1e-7_dp*(t - drawn%t0)
            end if
            call bounce(drawn, t - drawn%t0, q, v)
            known = .true.
            if (first == 1) call to_level(system, drawn, t, q, v, known)
            truth = [t, q, v]
            truth = truth(2 - first:)
            return
        end if
        known = .false.
        do k = 0, most_doublings
            q = drawn%q
            v = drawn%v
            t = drawn%t0 + drawn%duration
            if (first == 1) t = drawn%t
            call advance(system, drawn%t0, (t - drawn%t0)/(8*2**k), 8*2_i8**k, q, v, known)
            if (.not. known) cycle
            if (first == 1) call to_level(system, drawn, t, q, v, known)
            truth = [t, q, v]
            truth = truth(2 - first:)
            if (known .and. allocated(before)) then
                known = all(abs(truth - before) <= &
                            1e-3_dp*max(drawn%numbers%bracket, 1e-19_dp*drawn%numbers%most) &
                            .or. .not. drawn%numbers%stated)
                if (known) return
            end if
            before = truth
        end do
        known = .false.
    end subroutine find_truth

    subroutine advance(system, t0, dt, steps, q, v, good)
        !! By `gauss16`; `good` is false where a step fails.
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t0, dt
        integer(i8), intent(in) :: steps
        real(dp), intent(inout) :: q(:), v(:)
        logical, intent(out) :: good
        type(gauss_t) :: method
        type(error_t), allocatable :: error

        call new_gauss16(method)
        call method%prepare(system, error)
        call method%try_advance(system, t0, dt, 0_i8, steps, q, v, error)
        good = .not. allocated(error)
    end subroutine advance

    subroutine to_level(system, drawn, t, q, v, good)
        !! Newton's iteration to where the event is in truth.
        class(system_t), intent(in) :: system
        type(case_t), intent(in) :: drawn
        real(dp), intent(inout) :: t, q(:), v(:)
        logical, intent(out) :: good
        real(dp) :: a(size(q)), y(2*size(q)), slope(2*size(q)), dt
        integer :: i

        good = .false.
        do i = 1, 12
            call system%accelerations(t, q, v, a)
            y = [q, v]
            slope = [v, a]
            dt = (drawn%level - y(drawn%level_of))/slope(drawn%level_of)
            if (.not. abs(dt) < 0.1_dp*drawn%duration) return
            call advance(system, t, dt, 1_i8, q, v, good)
            if (.not. good) return
            t = t + dt
        end do
        good = abs(dt) <= 1e-25_dp*max(abs(t), drawn%duration)
    end subroutine to_level

    subroutine bounce(drawn, elapsed, q, v)
        !! From impact to impact, and at rest after the last.
        type(case_t), intent(in) :: drawn
        real(dp), intent(in) :: elapsed  !! since the start, s
        real(dp), intent(out) :: q(:), v(:)
        real(dp) :: left, flight, speed

        left = elapsed
        q = drawn%q
        v = drawn%v
        associate (g => drawn%parameters(2), e => drawn%parameters(3))
            do
                if (v(1) <= 0.0_dp .and. q(1) <= 0.0_dp .and. .not. v(1) < 0.0_dp) then
                    v = 0.0_dp
                    q = 0.0_dp
                    return
                end if
                speed = sqrt(v(1)**2 + 2.0_dp*g*q(1))
                flight = huge(flight)
                if (v(1) + speed > 0.0_dp .and. g > 0.0_dp .and. v(1) > 0.0_dp) then
                    flight = (v(1) + speed)/g
                else if (speed - v(1) > 0.0_dp) then
                    flight = 2.0_dp*q(1)/(speed - v(1))
                end if
                if (flight >= left) exit
                left = left - flight
                q = 0.0_dp
                v = e*speed
                if (2.0_dp*v(1) <= 1e-31_dp*g*drawn%duration) v = 0.0_dp
            end do
            q = q + left*(v - 0.5_dp*g*left)
            v = v - g*left
        end associate
    end subroutine bounce

    subroutine new_system(drawn, system)
        !! The catalogue is not here: it knows closed forms, and they GSL.
        type(case_t), intent(in) :: drawn
        class(system_t), allocatable, intent(out) :: system
        type(error_t), allocatable :: error

        select case (drawn%system)
        case ("oscillator"); allocate (oscillator_t :: system)
        case ("pendulum"); allocate (pendulum_t :: system)
        case ("double_pendulum"); allocate (double_pendulum_t :: system)
        case ("cart_pendulum"); allocate (cart_pendulum_t :: system)
        case ("atwood"); allocate (atwood_t :: system)
        case ("wedge"); allocate (wedge_t :: system)
        case ("rolling_disk"); allocate (rolling_disk_t :: system)
        case ("charged_particle"); allocate (charged_particle_t :: system)
        case ("rotating_wire"); allocate (rotating_wire_t :: system)
        case ("rotating_hoop"); allocate (rotating_hoop_t :: system)
        case ("driven_pendulum"); allocate (driven_pendulum_t :: system)
        case ("bouncing_ball"); allocate (bouncing_ball_t :: system)
        case ("hanging_chain"); allocate (hanging_chain_t :: system)
        case default; error stop "quad: unknown system"
        end select
        call system%configure(drawn%parameters, error)
        if (allocated(error)) error stop "quad: parameters are refused"
    end subroutine new_system
end module digits_judge
