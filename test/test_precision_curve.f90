module test_precision_curve
    !! The bench's arithmetic on made-up measurements.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
    use funit, only: TestMethod, TestSuite, assertEqual, assertTrue
    use lagrangia_command_line, only: word_t
    use lagrangia_contestant, only: set_by_step, set_by_tolerance, source_gsl, source_ours
    use lagrangia_kinds, only: dp, i8
    use lagrangia_precision_curve, only: best, confirmed, median, not_known, ratio, time_to_error
    use lagrangia_printed_table, only: printed_table_t
    use lagrangia_stopwatch, only: repetitions
    use lagrangia_work_precision, only: best_time, curve_t, points_table, times_table
    implicit none (type, external)
    private
    public :: precision_curve_suite

    real(dp), parameter :: eps = epsilon(1.0_dp)

contains

    function precision_curve_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("precision_curve")
        call suite%addTest(TestMethod("medians", medians))
        call suite%addTest(TestMethod("ratios", ratios))
        call suite%addTest(TestMethod("a_power_law_is_interpolated", a_power_law_is_interpolated))
        call suite%addTest(TestMethod("what_is_not_reached", what_is_not_reached))
        call suite%addTest(TestMethod("a_lucky_hit_does_not_count", a_lucky_hit_does_not_count))
        call suite%addTest(TestMethod("the_least_of_several_times", the_least_of_several_times))
        call suite%addTest(TestMethod("curves_are_told_apart", curves_are_told_apart))
        call suite%addTest(TestMethod("tables_are_in_microseconds", tables_are_in_microseconds))
        call suite%addTest(TestMethod("short_runs_are_repeated", short_runs_are_repeated))
    end function precision_curve_suite

    subroutine medians()
        !! Of odd and even counts, in any order, and of nothing.
        call assertEqual(3.0_dp, median([3.0_dp]))
        call assertEqual(3.0_dp, median([9.0_dp, 1.0_dp, 3.0_dp]))
        call assertEqual(2.5_dp, median([4.0_dp, 1.0_dp, 3.0_dp, 2.0_dp]))
        call assertEqual(7.0_dp, median([7.0_dp, 7.0_dp, 1.0_dp, 7.0_dp, 8.0_dp]))
        call assertTrue(ieee_is_nan(median([real(dp) ::])), "ieee_is_nan(median([real(dp) ::]))")
    end subroutine medians

    subroutine ratios()
        !! What is not known stays so.
        call assertEqual(0.25_dp, ratio(2.0_dp, 8.0_dp))
        call assertTrue(ieee_is_nan(ratio(2.0_dp, 0.0_dp)), "ieee_is_nan(ratio(2.0, 0.0))")
        call assertTrue(ieee_is_nan(ratio(not_known(), 2.0_dp)), &
                        "ieee_is_nan(ratio(not_known(), 2.0))")
        call assertTrue(ieee_is_nan(ratio(2.0_dp, not_known())), &
                        "ieee_is_nan(ratio(2.0, not_known()))")
        call assertEqual(2.0_dp, best([not_known(), 5.0_dp, 2.0_dp]))
        call assertTrue(ieee_is_nan(best([not_known()])), "ieee_is_nan(best([not_known()]))")
    end subroutine ratios

    subroutine a_power_law_is_interpolated()
        !! Error = 0.01/time^2: any error's time is known, and lines in logarithms find it to
        !! rounding, on points and between them.
        real(dp), parameter :: seconds(3) = [1.0_dp, 10.0_dp, 100.0_dp]
        real(dp), parameter :: errors(3) = 0.01_dp/seconds**2

        call assertEqual(sqrt(10.0_dp), time_to_error(errors, seconds, 1e-3_dp), &
                         tolerance=100.0_dp*eps)
        call assertEqual(10.0_dp, time_to_error(errors, seconds, 1e-4_dp), tolerance=1000.0_dp*eps)
        call assertEqual(sqrt(1000.0_dp), time_to_error(errors, seconds, 1e-5_dp), &
                         tolerance=1000.0_dp*eps)
        call assertEqual(100.0_dp, time_to_error(errors, seconds, 1.0001e-6_dp), tolerance=0.01_dp)
    end subroutine a_power_law_is_interpolated

    subroutine what_is_not_reached()
        !! Beyond the finest point nothing is known; before the coarsest nothing is less.
        real(dp), parameter :: seconds(2) = [1.0_dp, 2.0_dp], errors(2) = [1e-3_dp, 1e-4_dp]

        call assertTrue(ieee_is_nan(time_to_error(errors, seconds, 1e-5_dp)), &
                        "ieee_is_nan(time_to_error(errors, seconds, 1e-5))")
        call assertTrue(ieee_is_nan(time_to_error([real(dp) ::], [real(dp) ::], 1e-5_dp)), &
                        "ieee_is_nan(time_to_error([real(dp) ::], [real(dp) ::], 1e-5))")
        call assertEqual(1.0_dp, time_to_error(errors, seconds, 1e-2_dp))
        call assertEqual(3.0_dp, time_to_error([0.0_dp], [3.0_dp], 1e-12_dp))
    end subroutine what_is_not_reached

    subroutine a_lucky_hit_does_not_count()
        !! One point of error 1e-9 between 1e-3 and 1e-4 is an accident.
        real(dp), parameter :: seconds(4) = [1.0_dp, 2.0_dp, 4.0_dp, 8.0_dp]
        real(dp), parameter :: errors(4) = [1e-3_dp, 1e-9_dp, 1e-4_dp, 1e-5_dp]

        call assertEqual([1e-3_dp, 1e-4_dp, 1e-4_dp, 1e-5_dp], confirmed(errors))
        call assertTrue(ieee_is_nan(time_to_error(errors, seconds, 1e-6_dp)), &
                        "ieee_is_nan(time_to_error(errors, seconds, 1e-6))")
        call assertEqual(2.0_dp, time_to_error(errors, seconds, 1e-4_dp), tolerance=100.0_dp*eps)
    end subroutine a_lucky_hit_does_not_count

    subroutine the_least_of_several_times()
        !! Where rounding makes the curve go up again, its first way down counts; where a finer
        !! setting takes less time, that counts.
        real(dp), parameter :: seconds(4) = [1.0_dp, 4.0_dp, 2.0_dp, 8.0_dp]
        real(dp), parameter :: errors(4) = [1e-3_dp, 1e-5_dp, 1e-6_dp, 1e-2_dp]

        call assertEqual(2.0_dp, time_to_error([1e-3_dp, 1e-5_dp, 1e-6_dp, 1e-7_dp], seconds, &
                                               1e-6_dp), tolerance=100.0_dp*eps)
        call assertEqual(4.0_dp, time_to_error(errors, seconds, 1e-5_dp), tolerance=100.0_dp*eps)
    end subroutine the_least_of_several_times

    subroutine curves_are_told_apart()
        !! By problem and source: of each the best, and no number where there is none.
        type(curve_t) :: curves(5)
        real(dp), parameter :: error = 1e-6_dp

        curves = [curve("P1", source_ours, "rk4", 8.0_dp, 1e-7_dp), &
                  curve("P1", source_ours, "gauss16", 2.0_dp, 1e-8_dp), &
                  curve("P1", source_gsl, "gsl_rk4", 4.0_dp, 1e-9_dp), &
                  curve("P1", source_gsl, "gsl_rk8pd", 1.0_dp, 1e-10_dp), &
                  curve("P2", source_ours, "rk4", 0.5_dp, 1e-11_dp)]
        call assertEqual(2.0_dp, best_time(curves, "P1", source_ours, error), message="ours")
        call assertEqual(1.0_dp, best_time(curves, "P1", source_gsl, error), message="GSL's")
        call assertEqual(0.5_dp, best_time(curves, "P2", source_ours, error), message="P2")
        call assertTrue(ieee_is_nan(best_time(curves, "P2", source_gsl, error)), "nobody")
        call assertEqual(1e-10_dp, curves(4)%least_error(), message="least error")
    contains
        pure function curve(problem, source, method, seconds, lowest)
            !! The error 1e-6 takes `seconds`, the lowest twice that.
            character(*), intent(in) :: problem, method
            integer, intent(in) :: source
            real(dp), intent(in) :: seconds, lowest
            type(curve_t) :: curve

            curve%problem = problem
            curve%source = source
            curve%method = method
            curve%count = 2
            curve%points(:2)%error = [error, lowest]
            curve%points(:2)%seconds = [seconds, 2.0_dp*seconds]
        end function curve
    end subroutine curves_are_told_apart

    subroutine tables_are_in_microseconds()
        !! Of seconds; an error of 1e-4 per step^4, so that 10 times the time is 1e-4 of the error.
        type(curve_t) :: curves(2)
        type(printed_table_t) :: points, times
        type(word_t), allocatable :: lines(:)
        integer :: k

        curves%problem = "P1"
        curves%source = [source_ours, source_gsl]
        curves%method = ["rk4    ", "gsl_rk4"]
        curves%set_by = [set_by_step, set_by_tolerance]
        curves%coordinates = 3
        curves%count = 3
        do k = 1, 3
            curves%points(k)%setting = 10.0_dp**(-k)
            curves%points(k)%error = 10.0_dp**(-4*k)
            curves%points(k)%seconds = [1e-6_dp, 4e-6_dp]*10.0_dp**k
            curves%points(k)%evaluations = 7_i8*10_i8**k
        end do
        call points_table(curves, points)
        call assertTrue(index(points%object(5), '"method": "gsl_rk4", "set_by": "tolerance", '// &
                              '"setting": 1.0000000000000000E-002') > 0, points%object(5))
        call points%lines(huge(1), lines)
        call assertEqual("P1       gsl_rk4  tolerance   0.0100   1.00e-8  400.0          700", &
                         lines(6)%text)
        call times_table(curves, times)
        call times%lines(huge(1), lines)
        call assertEqual("P1       rk4      dt                   3        10.0        31.6     "// &
                         "    178         1000           0.25           0.25    "// &
                         "       0.25            0.25      1.0e-12", &
                         lines(2)%text)
        call assertEqual("P1       gsl_rk4  tolerance            3        40.0         126     "// &
                         "    711         4000            1.0            1.0    "// &
                         "        1.0             1.0      1.0e-12", &
                         lines(3)%text)
    end subroutine tables_are_in_microseconds

    subroutine short_runs_are_repeated()
        !! Until they take long enough, but not for ever.
        call assertEqual(1, repetitions(1.0_dp, 5e-3_dp))
        call assertEqual(6, repetitions(1e-3_dp, 5e-3_dp))
        call assertTrue(repetitions(0.0_dp, 5e-3_dp) >= 1000000, &
                        "repetitions(0.0, 5e-3) >= 1000000")
    end subroutine short_runs_are_repeated
end module test_precision_curve
