module lagrangia_precision_tables
    !! Curves of run time against error as tables: every point, and the time that an error takes.
    use lagrangia_bench_table, only: bench_table_t, cell_t, count_cell, new_bench_table, &
                                     number_cell, word_cell
    use lagrangia_contestant, only: set_by_names, source_gsl
    use lagrangia_description, only: name_length
    use lagrangia_kinds, only: dp
    use lagrangia_precision_curve, only: best, not_known, ratio
    use lagrangia_work_precision, only: curve_t
    implicit none (type, external)
    private
    public :: best_time, points_table, times_table

    real(dp), parameter :: microseconds = 1e6_dp
    real(dp), parameter :: wanted(4) = [1e-3_dp, 1e-6_dp, 1e-9_dp, 1e-12_dp]

contains

    pure subroutine points_table(curves, table)
        !! All that was measured: for programs.
        type(curve_t), intent(in) :: curves(:)
        type(bench_table_t), intent(out) :: table
        integer :: i, k

        call new_bench_table(table, "work_precision", "run time against error", &
                             [character(name_length) :: "problem", "method", "set_by", "setting", &
                              "error", "us", "evaluations"])
        table%silent = .true.
        do i = 1, size(curves)
            do k = 1, curves(i)%count
                associate (c => curves(i), p => curves(i)%points(k))
                    call table%add([word_cell(c%problem), word_cell(c%method), &
                                    word_cell(set_by_names(c%set_by)), number_cell(p%setting, 3), &
                                    number_cell(p%error, 3), &
                                    number_cell(microseconds*p%seconds, 4), &
                                    count_cell(p%evaluations)])
                end associate
            end do
        end do
    end subroutine points_table

    pure subroutine times_table(curves, table)
        !! Microseconds to an error, and how many times the best of GSL's methods takes of them.
        type(curve_t), intent(in) :: curves(:)
        type(bench_table_t), intent(out) :: table
        type(cell_t) :: times(size(wanted)), ratios(size(wanted))
        real(dp) :: time
        integer :: i, k

        call new_bench_table(table, "time_to_error", "time to an error, us; over_gsl: divided "// &
                             "by the best of GSL's methods there", [character(name_length) :: &
                             "problem", "method", "set_by", "us_to_1e-3", "us_to_1e-6", &
                             "us_to_1e-9", "us_to_1e-12", "over_gsl_1e-3", "over_gsl_1e-6", &
                             "over_gsl_1e-9", "over_gsl_1e-12", "least_error"])
        do i = 1, size(curves)
            do k = 1, size(wanted)
                time = curves(i)%time_to(wanted(k))
                times(k) = number_cell(microseconds*time, 3)
                ratios(k) = number_cell(ratio(time, best_time(curves, curves(i)%problem, &
                                                              source_gsl, wanted(k))), 2)
            end do
            call table%add([word_cell(curves(i)%problem), word_cell(curves(i)%method), &
                            word_cell(set_by_names(curves(i)%set_by)), times, ratios, &
                            number_cell(curves(i)%least_error(), 2)])
        end do
    end subroutine times_table

    pure function best_time(curves, problem, source, error) result(seconds)
        !! The least time that one of `source` takes to `error` on `problem`.
        type(curve_t), intent(in) :: curves(:)
        character(*), intent(in) :: problem
        integer, intent(in) :: source
        real(dp), intent(in) :: error
        real(dp) :: seconds
        integer :: i

        seconds = not_known()
        do i = 1, size(curves)
            if (curves(i)%problem /= problem .or. curves(i)%source /= source) cycle
            seconds = best([seconds, curves(i)%time_to(error)])
        end do
    end function best_time
end module lagrangia_precision_tables
