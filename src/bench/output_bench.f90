module lagrangia_output_bench
    !! What a row of a data file costs, in each format.
    use lagrangia_bench_table, only: bench_table_t, new_bench_table, number_cell, word_cell
    use lagrangia_csv_table, only: csv_table_t
    use lagrangia_description, only: name_length
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_npy, only: npy_table_t
    use lagrangia_precision_curve, only: median
    use lagrangia_stopwatch, only: effort_t, seconds_since, ticks_now
    use lagrangia_table, only: table_t
    use lagrangia_text_table, only: text_table_t
    implicit none (type, external)
    private
    public :: measure_output

    integer, parameter :: columns = 4
    character(4), parameter :: formats(3) = ["text", "csv ", "npy "]

contains

    subroutine measure_output(folder, plan, table, error)
        !! Rows of four columns; nothing stays in `folder`.
        character(*), intent(in) :: folder
        type(effort_t), intent(in) :: plan
        type(bench_table_t), intent(out) :: table
        type(error_t), allocatable, intent(out) :: error
        class(table_t), allocatable :: file
        real(dp) :: samples(plan%rounds, size(formats)), each
        integer :: i, round

        call new_bench_table(table, "output", "rows of 4 columns", [character(name_length) :: &
                             "format", "rows_per_second", "us_a_row"])
        do round = 1, plan%rounds
            do i = 1, size(formats)
                if (allocated(file)) deallocate (file)
                select case (i)
                case (1); allocate (text_table_t :: file)
                case (2); allocate (csv_table_t :: file)
                case default; allocate (npy_table_t :: file)
                end select
                call write_rows(file, folder//"/bench_output.dat", &
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

    subroutine write_rows(file, path, rows, seconds, error)
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
    end subroutine write_rows
end module lagrangia_output_bench
