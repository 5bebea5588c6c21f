module lagrangia_growth_bench
    !! How time and memory grow: with the steps, with the rows written, with the coordinates.
    !!
    !! And what a row of a data file costs, in each format.
    use lagrangia_catalogue, only: new_system, system_names
    use lagrangia_columns, only: new_columns
    use lagrangia_csv_table, only: csv_table_t
    use lagrangia_description, only: description_t, name_length
    use lagrangia_errors, only: error_t
    use lagrangia_integrator, only: integrator_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_machine, only: forget_peak_memory, peak_memory
    use lagrangia_methods, only: new_integrator
    use lagrangia_npy, only: npy_table_t
    use lagrangia_observer, only: observer_box_t, observer_t
    use lagrangia_precision_curve, only: median
    use lagrangia_printed_table, only: count_cell, number_cell, printed_table_t, word_cell
    use lagrangia_record, only: sample_record_t
    use lagrangia_run, only: run
    use lagrangia_stopwatch, only: effort_t, seconds_since, ticks_now
    use lagrangia_system, only: default_values, system_t
    use lagrangia_table, only: table_t
    use lagrangia_text_table, only: text_table_t
    use lagrangia_time_grid, only: new_time_grid, time_grid_t
    use lagrangia_work_precision, only: look_around
    implicit none (type, external)
    private
    public :: measure_growth, measure_output

    real(dp), parameter :: dt = 1e-3_dp                           !! s
    character(*), parameter :: many_bodied = "hanging_chain"      !! grows by its first parameter
    integer, parameter :: bodies(4) = [1, 4, 16, 64]
    integer, parameter :: columns = 4
    character(4), parameter :: formats(3) = ["text", "csv ", "npy "]

contains

    subroutine measure_growth(folder, plan, watcher, table, error)
        !! RK4: 10^4 to 10^7 steps of a pendulum unseen, then 10^3 to 10^6 rows written.
        character(*), intent(in) :: folder  !! for the rows; nothing stays there
        type(effort_t), intent(in) :: plan  !! how much is measured
        class(observer_t), pointer, intent(in) :: watcher  !! told how far it is; may be null
        type(printed_table_t), intent(out) :: table  !! the result
        type(error_t), allocatable, intent(out) :: error  !! allocated where it fails
        integer :: i, last

        call table%begin("growth", "RK4 on a pendulum; peak memory of the process, MB", &
                         [character(name_length) :: "of", "count", "seconds", "ns_each", &
                          "peak_mb"])
        last = merge(6, 7, plan%quick)
        do i = 4, last
            call take_steps("steps", "pendulum", 10_i8**i, 10_i8**i, table, error)
            if (allocated(error)) return
        end do
        do i = 3, last - 1
            call look_around(watcher, i, last, error)
            if (allocated(error)) return
            call write_rows(folder, 10_i8**i, table, error)
            if (allocated(error)) return
        end do
        if (any(system_names() == many_bodied)) then
            do i = 1, size(bodies)
                call take_steps("bodies", many_bodied, 1000_i8, int(bodies(i), i8), table, error)
                if (allocated(error)) return
            end do
        end if
    end subroutine measure_growth

    subroutine take_steps(what, name, steps, count, table, error)
        !! One row: a run that nobody looks at. `count` is what grows.
        character(*), intent(in) :: what, name
        integer(i8), intent(in) :: steps, count
        type(printed_table_t), intent(inout) :: table
        type(error_t), allocatable, intent(out) :: error
        class(system_t), allocatable :: system
        class(integrator_t), allocatable :: method
        type(observer_box_t) :: nobody(0)
        type(description_t) :: d
        type(time_grid_t) :: plan
        real(dp), allocatable :: p(:), q(:), v(:)
        integer(i8) :: start
        real(dp) :: seconds
        logical :: fresh

        call new_system(name, system, error)
        if (allocated(error)) return
        if (what == "bodies") then
            call system%describe(d)
            allocate (p, source=default_values(d))
            p(1) = real(count, dp)
            call system%configure(p, error)
            if (allocated(error)) return
        end if
        call new_integrator("rk4", method, error)
        if (allocated(error)) return
        call new_time_grid(plan, 0.0_dp, dt, steps*dt, steps, error)
        if (allocated(error)) return
        allocate (q(system%ndof), source=0.1_dp)
        allocate (v(system%ndof), source=0.0_dp)
        call forget_peak_memory(fresh)
        start = ticks_now()
        call run(system, method, plan, nobody, q, v, error)
        seconds = seconds_since(start)
        if (.not. allocated(error)) call add_row(what, count, seconds, table)
    end subroutine take_steps

    subroutine write_rows(folder, rows, table, error)
        !! One row: every step is a row of four columns in a text file.
        character(*), intent(in) :: folder
        integer(i8), intent(in) :: rows
        type(printed_table_t), intent(inout) :: table
        type(error_t), allocatable, intent(out) :: error
        character(name_length), parameter :: names(4) = [character(name_length) :: &
            "t", "theta", "theta_dot", "energy_drift"]
        class(system_t), allocatable :: system
        class(integrator_t), allocatable :: method
        type(observer_box_t) :: observers(1)
        type(sample_record_t), target :: record
        type(time_grid_t) :: plan
        real(dp) :: q(1), v(1), seconds
        integer(i8) :: start
        logical :: fresh

        call new_system("pendulum", system, error)
        if (allocated(error)) return
        call new_integrator("rk4", method, error)
        if (allocated(error)) return
        call new_time_grid(plan, 0.0_dp, dt, rows*dt, 1_i8, error)
        if (allocated(error)) return
        call new_columns(record%columns, names, system, .false., error)
        if (allocated(error)) return
        record%shown = size(names)
        allocate (text_table_t :: record%table)
        observers(1)%item => record
        q = 1.0_dp
        v = 0.0_dp
        call record%table%file%open(folder//"/bench_rows.dat", error)
        if (allocated(error)) return
        call forget_peak_memory(fresh)
        start = ticks_now()
        call record%table%begin(["growth"], record%columns%names(size(names)), &
                                record%columns%units(size(names)), error)
        if (.not. allocated(error)) call run(system, method, plan, observers, q, v, error)
        seconds = seconds_since(start)
        call record%table%file%abandon()
        if (.not. allocated(error)) call add_row("rows", rows, seconds, table)
    end subroutine write_rows

    subroutine add_row(what, count, seconds, table)
        !! What it took.
        character(*), intent(in) :: what
        integer(i8), intent(in) :: count
        real(dp), intent(in) :: seconds
        type(printed_table_t), intent(inout) :: table

        call table%add([word_cell(what), count_cell(count), number_cell(seconds, 3), &
                        number_cell(1e9_dp*seconds/count, 3), number_cell(peak_memory(), 3)])
    end subroutine add_row

    subroutine measure_output(folder, plan, watcher, table, error)
        !! Rows of four columns; nothing stays in `folder`.
        character(*), intent(in) :: folder  !! where the files go
        type(effort_t), intent(in) :: plan  !! how much is measured
        class(observer_t), pointer, intent(in) :: watcher  !! told how far it is; may be null
        type(printed_table_t), intent(out) :: table  !! the result
        type(error_t), allocatable, intent(out) :: error  !! allocated where it fails
        class(table_t), allocatable :: file
        real(dp) :: samples(plan%rounds, size(formats)), each
        integer :: i, round

        call table%begin("output", "rows of 4 columns", [character(name_length) :: &
                         "format", "rows_per_second", "us_a_row"])
        do round = 1, plan%rounds
            do i = 1, size(formats)
                call look_around(watcher, (round - 1)*size(formats) + i - 1, &
                                 plan%rounds*size(formats), error)
                if (allocated(error)) return
                if (allocated(file)) deallocate (file)
                select case (i)
                case (1); allocate (text_table_t :: file)
                case (2); allocate (csv_table_t :: file)
                case default; allocate (npy_table_t :: file)
                end select
                call time_rows(file, folder//"/bench_output.dat", &
                                merge(5000, 50000, plan%quick)*merge(20, 1, i == 3), &
                                samples(round, i), error)
                if (allocated(error)) return
            end do
        end do
        do i = 1, size(formats)
            each = median(samples(:, i))
            call table%add([word_cell(formats(i)), number_cell(1.0_dp/each, 3), &
                            number_cell(1e6_dp*each, 3)])
        end do
    end subroutine measure_output

    subroutine time_rows(file, path, rows, seconds, error)
        !! Seconds a row; the file is then abandoned.
        class(table_t), intent(inout) :: file
        character(*), intent(in) :: path
        integer, intent(in) :: rows
        real(dp), intent(out) :: seconds
        type(error_t), allocatable, intent(out) :: error
        character(1), parameter :: names(columns) = ["t", "x", "y", "z"], unit(columns) = "1"
        real(dp) :: values(columns)
        integer(i8) :: start
        integer :: k

        seconds = 0.0_dp
        call file%file%open(path, error)
        if (allocated(error)) return
        call file%begin(["output"], names, unit, error)
        start = ticks_now()
        do k = 1, rows
            values = [1e-3_dp*k, 0.7_dp/k, -3.1_dp*k, 1e-13_dp/k]
            call file%row(values)
        end do
        seconds = seconds_since(start)/rows
        call file%file%abandon()
    end subroutine time_rows
end module lagrangia_growth_bench
