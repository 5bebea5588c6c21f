module test_progress
    !! How long something takes, in words.
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertTrue
    use lagrangia_accuracy, only: share_of_run
    use lagrangia_command_line, only: word_t
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_observer, only: observer_t
    use lagrangia_outcome, only: outcome_t
    use lagrangia_part, only: part_t
    use lagrangia_progress, only: about, pace, part_label, progress_line, progress_t
    use lagrangia_run_plan, only: parse_run_plan, run_plan_t
    use lagrangia_scene_run, only: run_scene
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: progress_suite

    type, extends(observer_t) :: listener_t
        !! Keeps the last share that it was told, and each.
        real(dp) :: share = -1.0_dp
        real(dp), allocatable :: shares(:)
    contains
        procedure :: observe
        procedure :: tick
    end type listener_t

    class(observer_t), pointer :: whoever => null()
    !! Of a pointer of a procedure's own gfortran 12 believes that, passed as intent(in), it changes
    !! nothing of its target.

contains

    function progress_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("progress")
        call suite%addTest(TestMethod("durations_have_their_unit", durations_have_their_unit))
        call suite%addTest(TestMethod("lines_say_how_far_it_is", lines_say_how_far_it_is))
        call suite%addTest(TestMethod("a_new_run_has_its_name", a_new_run_has_its_name))
        call suite%addTest(TestMethod("parts_have_numbers", parts_have_numbers))
        call suite%addTest(TestMethod("a_part_counts_as_its_share", a_part_counts_as_its_share))
        call suite%addTest(TestMethod("an_estimate_is_of_the_whole", an_estimate_is_of_the_whole))
    end function progress_suite

    subroutine durations_have_their_unit()
        !! From two of a unit on it is used; nothing overflows.
        call assertEqual("0 s", about(0.0_dp))
        call assertEqual("119 s", about(119.0_dp))
        call assertEqual("2 min", about(120.0_dp))
        call assertEqual("119 min", about(7140.0_dp))
        call assertEqual("2 h", about(7200.0_dp))
        call assertEqual("3 days", about(2.6e5_dp))
        call assertEqual("32 years", about(1e9_dp))
        call assertEqual("1000000000 years", about(huge(1.0_dp)))
    end subroutine durations_have_their_unit

    subroutine lines_say_how_far_it_is()
        !! Of a run, and of a sweep, whose trajectories are counted; at either end no rest is left.
        call assertEqual("pendulum: 33 %, 4 s, 8 s left", &
                         progress_line("pendulum", "", 4.2_dp, 1_i8, 3_i8))
        call assertEqual("basins: 25 %, 10 s, 5.00E+02 trajectories/s, 30 s left", &
                         progress_line("basins", "trajectories", 10.0_dp, 5000_i8, 20000_i8))
        call assertEqual("basins: 99 %, 400 s, 2.50E+01 trajectories/s, 0 s left", &
                         progress_line("basins", "trajectories", 400.0_dp, 9999_i8, 10000_i8))
        call assertEqual("basins: 25 %, 10 s, 5.00E-01 trajectories/s, 30 s left", &
                         progress_line("basins", "trajectories", 10.0_dp, 5000_i8, 20000_i8, 1000))
        call assertEqual("p: 0 %, 3 s", progress_line("p", "x", 3.9_dp, 0_i8, 7_i8))
        call assertEqual("p: 100 %, 3 s", progress_line("p", "x", 3.0_dp, 7_i8, 7_i8))
        call assertEqual("p: 3 s", progress_line("p", "x", 3.0_dp, 7_i8, 0_i8))
        call assertEqual("p: 100 %, 3 s", progress_line("p", "", 3.0_dp, 8_i8, 7_i8))
        call assertEqual(", 2 h left", pace("", 7200.0_dp, 1_i8, 2_i8))
    end subroutine lines_say_how_far_it_is

    subroutine a_new_run_has_its_name()
        !! And nothing of it is shown yet, quiet or not.
        type(progress_t) :: progress

        call progress%restart("first")
        call assertEqual("first", progress%label)
        progress%shown = .true.
        call progress%restart("second", .true.)
        call assertEqual("second", progress%label)
        call assertFalse(progress%shown, "a new run")
    end subroutine a_new_run_has_its_name

    subroutine parts_have_numbers()
        !! Which part of how many; one alone has none.
        call assertEqual("check pendulum, 2 of 14", part_label("check", "pendulum  ", 2, 14))
        call assertEqual("stress zeno", part_label("stress", "zeno", 1, 1))
    end subroutine parts_have_numbers

    subroutine a_part_counts_as_its_share()
        !! The second of four parts, half done, is three eighths of the whole; a part of a part as
        !! well. Nobody needs to listen.
        type(listener_t), target :: listener
        type(part_t), target :: part
        type(part_t) :: alone, inner

        part%whole => listener
        call part%tick(1_i8, 2_i8)
        call assertEqual(0.5_dp, listener%share, 1e-5_dp, "all of it")
        part%from = 0.25_dp
        part%to = 0.5_dp
        call part%tick(1_i8, 2_i8)
        call assertEqual(0.375_dp, listener%share, 1e-5_dp, "half of the second of four")
        call part%tick(0_i8, 0_i8)
        call assertEqual(0.25_dp, listener%share, 1e-5_dp, "begun")
        inner%whole => part
        inner%from = 0.5_dp
        call inner%tick(7000000000_i8, 7000000000_i8)
        call assertEqual(0.5_dp, listener%share, 1e-5_dp, "the end of the part in the part")
        listener%share = -1.0_dp
        call alone%tick(1_i8, 2_i8)
        call assertTrue(listener%share < 0.0_dp, "told to nobody")
    end subroutine a_part_counts_as_its_share

    subroutine an_estimate_is_of_the_whole()
        !! A run whose error is estimated is an eighth of the work, which goes on to seven eighths
        !! by the finer runs and never back; any other run is all of it.
        call check(".false.", 1.0_dp, 1.0_dp)
        call check(".true.", share_of_run, 0.875_dp)
    contains
        subroutine check(estimated, run, last)
            character(*), intent(in) :: estimated
            real(dp), intent(in) :: run, last  !! shares when the run itself, and all, has ended
            type(listener_t), target :: listener
            type(run_plan_t) :: plan
            type(outcome_t) :: outcome
            type(error_t), allocatable :: error

            call parse_run_plan(plan, "&scene system='pendulum' q=1 duration=1 dt=0.01 "// &
                                "every=1 error_estimate="//estimated//" /", "s.nml", &
                                [word_t ::], error)
            call assertFalse(allocated(error), "a scene")
            if (allocated(error)) return
            whoever => listener
            call run_scene(plan, "", "text", whoever, outcome, error)
            call assertFalse(allocated(error), "it runs")
            if (allocated(error)) return
            associate (told => listener%shares)
                call assertTrue(all(told(2:) >= told(:size(told) - 1)), estimated//": never back")
                call assertEqual(0.5_dp*run, told(51), 1e-12_dp, estimated//": half of the run")
                if (run < 1.0_dp) call assertTrue(any(abs(told - 0.375_dp) < 1e-12_dp), &
                                                  "the end of the first finer run")
                call assertEqual(last, told(size(told)), 1e-12_dp, estimated//": the end")
            end associate
        end subroutine check
    end subroutine an_estimate_is_of_the_whole

    subroutine observe(self, system, t, q, v, error)
        !! The states don't matter.
        class(listener_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t, q(system%ndof), v(system%ndof)
        type(error_t), allocatable, intent(out) :: error
    end subroutine observe

    subroutine tick(self, done, steps)
        !! What share that is.
        class(listener_t), intent(inout) :: self
        integer(i8), intent(in) :: done, steps

        self%share = real(done, dp)/real(steps, dp)
        if (.not. allocated(self%shares)) allocate (self%shares(0))
        self%shares = [self%shares, self%share]
    end subroutine tick
end module test_progress
