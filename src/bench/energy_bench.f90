module lagrangia_energy_bench
    !! A long run of every method: does its energy error stay, and how large is it?
    use lagrangia_catalogue, only: new_system
    use lagrangia_description, only: name_length
    use lagrangia_errors, only: error_t
    use lagrangia_integrator, only: integrator_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_methods, only: method_names, nth_integrator
    use lagrangia_observer, only: observer_t
    use lagrangia_printed_table, only: printed_table_t, count_cell, number_cell, word_cell
    use lagrangia_stopwatch, only: effort_t, seconds_since, ticks_now
    use lagrangia_system, only: system_t
    use lagrangia_work_precision, only: look_around
    implicit none (type, external)
    private
    public :: measure_energy

    integer(i8), parameter :: long_run_steps = 1000000_i8, short_run_steps = 20000_i8
    integer(i8), parameter :: every = 7                 !! odd: it meets all phases of a swing
    real(dp), parameter :: theta0 = 2.0_dp, dt = 0.05_dp  !! rad, s

contains

    subroutine measure_energy(chosen, plan, watcher, table, error)
        !! The pendulum from 2 rad, dt = 0.05 s: the largest relative error of the energy.
        character(*), intent(in) :: chosen(:)  !! names of methods; empty: all
        type(effort_t), intent(in) :: plan  !! how much is measured
        class(observer_t), pointer, intent(in) :: watcher  !! told how far it is; may be null
        type(printed_table_t), intent(out) :: table  !! the result
        type(error_t), allocatable, intent(out) :: error  !! allocated where it fails
        class(integrator_t), allocatable :: method, variant
        integer :: i

        call table%begin("energy", "pendulum from 2 rad, dt = 0.05 s: largest "// &
                         "relative energy error", [character(name_length) :: "method", &
                         "sums", "steps", "energy_error", "seconds"])
        i = 0
        do
            i = i + 1
            call nth_integrator(i, method)
            if (.not. allocated(method)) exit
            if (size(chosen) > 0 .and. .not. any(chosen == method%name)) cycle
            call look_around(watcher, i, size(method_names()), error)
            if (allocated(error)) return
            call long_run(method, "plain", merge(short_run_steps, long_run_steps, plan%quick), &
                          table, error)
            if (allocated(error)) return
            call method%compensated(variant)
            if (allocated(variant)) call long_run(variant, "compensated", &
                merge(short_run_steps, long_run_steps, plan%quick), table, error)
            if (allocated(error)) return
        end do
    end subroutine measure_energy

    subroutine long_run(method, sums, steps, table, error)
        !! One row; none where the method refuses the pendulum.
        class(integrator_t), intent(inout) :: method
        character(*), intent(in) :: sums
        integer(i8), intent(in) :: steps
        type(printed_table_t), intent(inout) :: table
        type(error_t), allocatable, intent(out) :: error
        class(system_t), allocatable :: system
        type(error_t), allocatable :: refusal
        real(dp) :: q(1), v(1), energy, start_energy, worst
        integer(i8) :: k, start

        call new_system("pendulum", system, error)
        if (allocated(error)) return
        call method%prepare(system, refusal)
        if (allocated(refusal)) return
        q = theta0
        v = 0.0_dp
        call method%start(system, 0.0_dp, q, v)
        start_energy = system%energy(0.0_dp, q, v)
        worst = 0.0_dp
        start = ticks_now()
        do k = 0, steps - 1, every
            call method%advance(system, 0.0_dp, dt, k, min(every, steps - k), q, v)
            energy = system%energy(0.0_dp, q, v)
            worst = max(worst, abs(energy - start_energy))
            if (.not. (abs(energy) <= huge(energy))) worst = huge(worst)
        end do
        call table%add([word_cell(method%name), word_cell(sums), count_cell(steps), &
                        number_cell(worst/abs(start_energy), 2), &
                        number_cell(seconds_since(start), 3)])
    end subroutine long_run
end module lagrangia_energy_bench
