module lagrangia_sweep_bench
    !! Many double pendulums: a sweep beside a loop over GSL's driver that OpenMP shares out, one
    !! driver a thread, with C's right-hand side. Lyapunov exponents by GSL are those of a second
    !! motion that begins beside the first.
    use, intrinsic :: iso_c_binding, only: c_loc, c_null_funptr
    use lagrangia_description, only: default_values, description_t, name_length
    use lagrangia_direct_rates, only: direct_context_t, direct_rates
    use lagrangia_errors, only: error_t
    use lagrangia_gsl_odeiv, only: gsl_driver_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_observer, only: observer_t
    use lagrangia_precision_curve, only: median
    use lagrangia_printed_table, only: count_cell, number_cell, printed_table_t, word_cell
    use lagrangia_scene, only: scene_t
    use lagrangia_scene_reader, only: parse_scene
    use lagrangia_stopwatch, only: effort_t, seconds_since, ticks_now
    use lagrangia_sweep, only: new_sweep, sweep_t
    use lagrangia_sweep_grid, only: compute_grid, sweep_result_t, thread_count
    use lagrangia_system, only: system_t
    use lagrangia_text, only: to_text, word_t
    use lagrangia_vectors, only: farthest
    use lagrangia_work_precision, only: look_around
    implicit none (type, external)
    private
    public :: measure_sweeps

    real(dp), parameter :: duration = 10.0_dp                 !! s
    integer(i8), parameter :: steps = 1000                    !! of rk4
    real(dp), parameter :: start(4) = [0.5_dp, 0.8_dp, 0.0_dp, 0.0_dp]  !! q, v
    real(dp), parameter :: from = 0.45_dp, to = 0.55_dp       !! rad: the first angle
    real(dp), parameter :: displacement(4) = 1e-6_dp* &
        [1/2.0_dp, 1/3.0_dp, -1/3.0_dp, 1/4.0_dp]             !! as in `lagrangia_lyapunov`
    real(dp), parameter :: microseconds = 1e6_dp

    type :: row_t
        !! How they are computed.
        character(name_length) :: name = ""
        logical :: gsl = .false.
        character(8) :: method = ""
        real(dp) :: tolerance = 0.0_dp        !! 0: steps of fixed length
        character(8) :: keep = "theta1"       !! the angle at the end, or the exponent
        integer :: beside = 0                 !! number of the row by GSL
    end type row_t

    type(row_t), parameter :: rows(*) = [ &  ! by tolerances that give 1e-9
        row_t("rk4", .false., "rk4", beside=2), &
        row_t("gsl_rk4", .true., "rk4", beside=2), &
        row_t("gauss16", .false., "gauss16", 1e-9_dp, beside=5), &
        row_t("dop853", .false., "dop853", 6e-10_dp, beside=5), &
        row_t("gsl_rk8pd", .true., "rk8pd", 2e-9_dp, beside=5), &
        row_t("lyapunov", .false., "gauss16", 1e-8_dp, "lyapunov", 7), &
        row_t("gsl_lyapunov", .true., "rk8pd", 1e-12_dp, "lyapunov", 7)]

contains

    subroutine measure_sweeps(plan, watcher, table, error)
        !! Microseconds a trajectory of 10 s; with 1000 steps of rk4, nanoseconds a step. The error
        !! is the largest of the first angle at the end, or of the Lyapunov exponent of these 10 s,
        !! against gauss16 at 1e-13.
        type(effort_t), intent(in) :: plan                !! how much is measured
        class(observer_t), pointer, intent(in) :: watcher  !! told how far it is; may be null
        type(printed_table_t), intent(out) :: table       !! the result
        type(error_t), allocatable, intent(out) :: error  !! allocated where it fails
        real(dp), allocatable :: numbers(:), reference(:, :)
        real(dp) :: seconds(plan%rounds, size(rows)), gsl, worst(size(rows))
        integer :: count, i, pass, passes, round, same, threads

        count = merge(256, 1024, plan%quick)
        allocate (numbers(count), reference(count, size(rows)))
        call table%begin("sweep", to_text(count)//" double pendulums over 10 s, to 1e-9; rk4 "// &
                         "by 1000 steps, so us_each is ns a step; over_gsl: GSL's time by ours", &
                         [character(name_length) :: "method", "threads", "error", "us_each", &
                          "over_gsl"])
        do i = 1, size(rows)
            do same = 1, i - 1
                if (rows(same)%keep == rows(i)%keep) exit
            end do
            if (same < i) then
                reference(:, i) = reference(:, same)
                cycle
            end if
            call take(row_t("", .false., "gauss16", 1e-13_dp, rows(i)%keep), thread_count(0), &
                      numbers, gsl, error)
            if (allocated(error)) return
            reference(:, i) = numbers
        end do
        passes = merge(1, 2, thread_count(0) == 1)
        do pass = 1, passes
            threads = merge(1, thread_count(0), pass == 1)
            do round = 1, plan%rounds
                do i = 1, size(rows)
                    if (.not. allocated(error)) call look_around(watcher, ((pass - 1)* &
                        plan%rounds + round - 1)*size(rows) + i - 1, &
                        passes*plan%rounds*size(rows), error)
                    if (allocated(error)) return
                    call take(rows(i), threads, numbers, seconds(round, i), error)
                    worst(i) = farthest(numbers, reference(:, i))
                end do
            end do
            if (allocated(error)) return
            do i = 1, size(rows)
                gsl = median(seconds(:, rows(i)%beside))
                call table%add([word_cell(rows(i)%name), count_cell(int(threads, i8)), &
                                number_cell(worst(i), 2), &
                                number_cell(median(seconds(:, i))/count*microseconds, 3), &
                                number_cell(gsl/median(seconds(:, i)), 2)])
            end do
        end do
    end subroutine measure_sweeps

    subroutine take(row, threads, numbers, seconds, error)
        !! All of them, one row.
        type(row_t), intent(in) :: row
        integer, intent(in) :: threads
        real(dp), intent(out) :: numbers(:), seconds
        type(error_t), allocatable, intent(out) :: error

        if (row%gsl) then
            call take_gsl(row, threads, numbers, seconds, error)
        else
            call take_sweep(row, threads, numbers, seconds, error)
        end if
    end subroutine take

    subroutine take_sweep(row, threads, numbers, seconds, error)
        !! As the command does it, in memory.
        type(row_t), intent(in) :: row
        integer, intent(in) :: threads
        real(dp), intent(out) :: numbers(:), seconds
        type(error_t), allocatable, intent(out) :: error
        class(system_t), allocatable :: system
        type(scene_t) :: scene
        type(sweep_t) :: sweep
        type(sweep_result_t) :: result
        class(observer_t), pointer :: nobody
        type(word_t) :: none(0)
        real(dp), allocatable :: values(:, :)
        character(:), allocatable :: steps_of
        integer(i8) :: block

        nullify (nobody)
        steps_of = "tolerance = "//to_text(row%tolerance)//", samples = 1"
        if (row%tolerance <= 0.0_dp) steps_of = "dt = "//to_text(duration/steps)
        call parse_scene("&scene system = 'double_pendulum', method = '"//trim(row%method)// &
                         "', "//steps_of//", duration = "//to_text(duration)//", q = "// &
                         to_text(start(1))//", "//to_text(start(2))//" /", "bench", none, scene, &
                         system, error)
        if (.not. allocated(error)) call new_sweep(sweep, scene, system, &
            ["theta1 = "//to_text(from)//":"//to_text(to)//":"//to_text(size(numbers))], &
            [row%keep], 1, 0.0_dp, error)
        if (.not. allocated(error)) call compute_grid(sweep, threads, nobody, result, error)
        if (allocated(error)) return
        seconds = result%seconds
        do block = 1, result%store%blocks
            call result%read_block(sweep, block, values, error)
            if (allocated(error)) return
            numbers(result%store%first_of(block):result%store%last_of(block)) = values(1, :)
        end do
    end subroutine take_sweep

    subroutine take_gsl(row, threads, numbers, seconds, error)
        !! One driver a thread.
        type(row_t), intent(in) :: row
        integer, intent(in) :: threads
        real(dp), intent(out) :: numbers(:), seconds
        type(error_t), allocatable, intent(out) :: error
        real(dp), allocatable :: parameters(:)
        integer(i8) :: begun

        call default_parameters(parameters, error)
        if (allocated(error)) return
        begun = ticks_now()
        !$omp parallel num_threads(threads) default(none) shared(row, numbers, parameters, error)
        call take_share(row, parameters, numbers, error)
        !$omp end parallel
        seconds = seconds_since(begun)
    end subroutine take_gsl

    subroutine take_share(row, parameters, numbers, error)
        !! What falls to one thread, by a driver of its own.
        type(row_t), intent(in) :: row
        real(dp), intent(in) :: parameters(:)
        real(dp), intent(inout) :: numbers(:)
        type(error_t), allocatable, intent(inout) :: error
        type(gsl_driver_t) :: driver
        type(direct_context_t), target :: context
        type(error_t), allocatable :: failure
        real(dp) :: beside(4), y(4)
        integer :: i

        context%parameters(:size(parameters)) = parameters
        call driver%start(trim(row%method), 4, direct_rates("double_pendulum"), c_null_funptr, &
                          c_loc(context), duration/steps, max(row%tolerance, 1e-12_dp), failure)
        !$omp do schedule(dynamic, 8)
        do i = 1, size(numbers)
            if (allocated(failure)) cycle
            y = start
            y(1) = from + (to - from)*(i - 1)/(size(numbers) - 1)
            beside = y + displacement
            call go(driver, row, y, failure)
            numbers(i) = y(1)
            if (row%keep /= "lyapunov") cycle
            call go(driver, row, beside, failure)
            numbers(i) = log(norm2(beside - y)/norm2(displacement))/duration
        end do
        !$omp end do
        call driver%free()
        !$omp critical (lagrangia_sweep_bench)
        if (allocated(failure)) error = failure
        !$omp end critical (lagrangia_sweep_bench)
    end subroutine take_share

    subroutine go(driver, row, y, error)
        !! From a start to its end, by GSL.
        type(gsl_driver_t), intent(inout) :: driver
        type(row_t), intent(in) :: row
        real(dp), intent(inout) :: y(4)
        type(error_t), allocatable, intent(inout) :: error
        real(dp) :: t

        t = 0.0_dp
        if (.not. allocated(error)) call driver%restart(duration/steps, error)
        if (allocated(error)) return
        if (row%tolerance > 0.0_dp) then
            call driver%integrate(t, duration, y, error)
        else
            call driver%fixed_steps(t, duration/steps, steps, y, error)
        end if
    end subroutine go

    subroutine default_parameters(values, error)
        !! Of the double pendulum.
        real(dp), allocatable, intent(out) :: values(:)
        type(error_t), allocatable, intent(out) :: error
        class(system_t), allocatable :: system
        type(scene_t) :: scene
        type(description_t) :: d
        type(word_t) :: none(0)

        call parse_scene("&scene system = 'double_pendulum', dt = 1, duration = 1, q = 0, 0 /", &
                         "bench", none, scene, system, error)
        if (allocated(error)) return
        call system%describe(d)
        values = default_values(d)
    end subroutine default_parameters
end module lagrangia_sweep_bench
