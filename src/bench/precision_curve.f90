module lagrangia_precision_curve
    !! The arithmetic of a benchmark: medians, and the time that an error costs.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_quiet_nan, ieee_value
    use lagrangia_kinds, only: dp
    use lagrangia_number_class, only: is_nonzero
    implicit none (type, external)
    private
    public :: best, confirmed, median, not_known, ratio, time_to_error

contains

    pure function not_known() result(nan)
        !! NaN: what was not reached or not measured; `null` in JSON.
        real(dp) :: nan

        nan = ieee_value(1.0_dp, ieee_quiet_nan)
    end function not_known

    pure function median(values) result(middle)
        !! The middle one, or the mean of the two in the middle; NaN of nothing.
        real(dp), intent(in) :: values(:)  !! in any order
        real(dp) :: middle
        real(dp) :: sorted(size(values)), x
        integer :: i, k, n

        n = size(values)
        middle = not_known()
        if (n == 0) return
        do i = 1, n
            x = values(i)
            do k = i - 1, 1, -1
                if (sorted(k) <= x) exit
                sorted(k + 1) = sorted(k)
            end do
            sorted(k + 1) = x
        end do
        middle = 0.5_dp*(sorted((n + 1)/2) + sorted(n/2 + 1))
    end function median

    pure function best(values) result(least)
        !! The smallest that is a number; NaN if none is.
        real(dp), intent(in) :: values(:)  !! NaN: not measured
        real(dp) :: least

        least = not_known()
        if (any(ieee_is_finite(values))) least = minval(values, mask=ieee_is_finite(values))
    end function best

    elemental function ratio(x, y) result(quotient)
        !! `x/y`; NaN where one of them is not known or `y` is 0.
        real(dp), intent(in) :: x, y  !! NaN: not known
        real(dp) :: quotient

        quotient = not_known()
        if (is_nonzero(y)) quotient = x/y
    end function ratio

    pure function confirmed(errors) result(sound)
        !! The errors of a method, coarsest setting first, without lucky hits: the error at one
        !! instant passes through zero now and then, and a dip that the next finer setting does
        !! not confirm counts as that one's error.
        real(dp), intent(in) :: errors(:)  !! coarsest setting first
        real(dp) :: sound(size(errors))
        integer :: n

        n = size(errors)
        sound = errors
        if (n > 1) sound(:n - 1) = max(errors(:n - 1), errors(2:))
    end function confirmed

    pure function time_to_error(errors, seconds, wanted) result(time)
        !! The least time in which a method gets to the error `wanted`, on the straight lines that
        !! join its measured points, coarsest setting first, in a plot of both logarithms. NaN if
        !! it never gets there; the first point's time if that is good enough already.
        real(dp), intent(in) :: errors(:), seconds(:)  !! > 0, except that an error may be 0
        real(dp), intent(in) :: wanted  !! error
        real(dp) :: time
        real(dp) :: sound(size(errors)), share
        integer :: k

        sound = max(confirmed(errors), tiny(1.0_dp))
        time = not_known()
        if (size(errors) == 0) return
        if (sound(1) <= wanted) time = seconds(1)
        do k = 2, size(errors)
            if (.not. (sound(k) <= wanted)) cycle
            share = 1.0_dp
            if (sound(k - 1) > wanted) share = log(sound(k - 1)/wanted)/log(sound(k - 1)/sound(k))
            time = best([time, seconds(k - 1)*(seconds(k)/seconds(k - 1))**share])
        end do
    end function time_to_error
end module lagrangia_precision_curve
