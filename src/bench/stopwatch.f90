module lagrangia_stopwatch
    !! Wall time. A run that is shorter than the clock can tell is repeated until it is long
    !! enough, and the time of one is the mean.
    use lagrangia_kinds, only: dp, i8
    implicit none (type, external)
    private
    public :: effort_t, effort, repetitions, seconds_since, ticks_now

    type :: effort_t
        !! How much is measured.
        logical :: quick = .false.
        integer :: rounds = 5             !! interleaved; medians are taken
        real(dp) :: shortest = 5e-3_dp    !! s, of one measurement
        real(dp) :: longest = 0.3_dp      !! s, of one run; what takes longer is left out
        real(dp) :: decades = 1.0_dp      !! of error between two settings of a method
    end type effort_t

contains

    pure function effort(quick) result(plan)
        !! The careful plan, or the one that ends soon.
        logical, intent(in) :: quick  !! the plan that ends soon
        type(effort_t) :: plan

        if (quick) plan = effort_t(quick=.true., rounds=3, shortest=1e-3_dp, longest=0.02_dp, &
                                   decades=2.0_dp)
    end function effort

    function ticks_now() result(ticks)
        !! The clock, in its own units.
        integer(i8) :: ticks

        call system_clock(ticks)
    end function ticks_now

    function seconds_since(start) result(seconds)
        !! Wall time since `ticks_now` was `start`.
        integer(i8), intent(in) :: start  !! from `ticks_now`
        real(dp) :: seconds
        integer(i8) :: ticks, rate

        call system_clock(ticks, rate)
        seconds = real(ticks - start, dp)/real(rate, dp)
    end function seconds_since

    pure function repetitions(seconds, shortest) result(count)
        !! How often a run of about `seconds` must be repeated to take `shortest`.
        real(dp), intent(in) :: seconds, shortest  !! s
        integer :: count

        count = 1 + int(min(1e7_dp, shortest/max(seconds, 1e-9_dp)))
    end function repetitions
end module lagrangia_stopwatch
