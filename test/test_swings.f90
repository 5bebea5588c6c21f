module test_swings
    !! Double pendulums, chaotic ones too, against ends computed in quadruple precision:
    !! `data/reference/double_pendulum.nml`, which `.ci/quad/check.sh` makes.
    use funit, only: TestMethod, TestSuite, anyExceptions, assertFalse, assertGreaterThan, &
                     assertLessThan, assertLessThanOrEqual, assertTrue
    use lagrangia_double_pendulum, only: double_pendulum_t
    use lagrangia_errors, only: error_t
    use lagrangia_files, only: read_whole_file
    use lagrangia_kinds, only: dp
    use lagrangia_namelist, only: get_real, get_reals, has_key, namelist_t, parse_namelist
    use lagrangia_outcome, only: outcome_t
    use lagrangia_scene, only: scene_t
    use lagrangia_text, only: to_text
    use scene_runs, only: plan_and_run
    implicit none (type, external)
    private
    public :: swings_suite

    integer, parameter :: swings = 12

contains

    function swings_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("swings")
        call suite%addTest(TestMethod("rk4_ends_where_it_says", rk4_ends_where_it_says))
        call suite%addTest(TestMethod("midpoint_ends_where_it_says", midpoint_ends_where_it_says))
        call suite%addTest(TestMethod("gauss16_ends_where_it_says", gauss16_ends_where_it_says))
        call suite%addTest(TestMethod("dop853_ends_where_it_says", dop853_ends_where_it_says))
    end function swings_suite

    subroutine rk4_ends_where_it_says()
        !! By steps that are short beside the period.
        call check_ends("rk4", 5e-3_dp, 0.0_dp)
    end subroutine rk4_ends_where_it_says

    subroutine midpoint_ends_where_it_says()
        !! A few digits, and where there is chaos none.
        call check_ends("midpoint", 5e-3_dp, 0.0_dp)
    end subroutine midpoint_ends_where_it_says

    subroutine gauss16_ends_where_it_says()
        !! Nothing but rounding, as the motion has made it grow.
        call check_ends("gauss16", 2e-2_dp, 0.0_dp)
    end subroutine gauss16_ends_where_it_says

    subroutine dop853_ends_where_it_says()
        !! By a tolerance.
        call check_ends("dop853", 0.0_dp, 1e-9_dp)
    end subroutine dop853_ends_where_it_says

    subroutine check_ends(method, dt, tolerance)
        !! Every end is as far from the truth as is said, or nearer; where the error is more than
        !! rounding and less than the motion, not by much.
        character(*), intent(in) :: method
        real(dp), intent(in) :: dt, tolerance
        type(namelist_t) :: tree
        type(error_t), allocatable :: error
        type(outcome_t) :: outcome
        character(:), allocatable :: text
        real(dp) :: truth(4), actual, claimed
        integer :: i, k, counted

        call read_whole_file("data/reference/double_pendulum.nml", text, error)
        call assertFalse(allocated(error), "the file is read")
        if (anyExceptions()) return
        call parse_namelist(text, "double_pendulum.nml", tree, error)
        call assertFalse(allocated(error), "the file is understood")
        if (anyExceptions()) return
        counted = 0
        do i = 1, swings
            call perform(tree, "swing"//to_text(i), method, dt, tolerance, outcome, truth)
            if (anyExceptions()) return
            actual = 0.0_dp
            claimed = 0.0_dp
            do k = 1, 4
                associate (s => outcome%state(k))
                    actual = max(actual, abs(s%value - truth(k))/s%most)
                    claimed = max(claimed, s%error/s%most)
                    if (s%resolved()) call assertLessThanOrEqual(abs(s%value - truth(k)), s%error, &
                        message=method//", swing"//to_text(i)//": "//trim(s%name))
                end associate
            end do
            if (claimed < 0.01_dp) counted = counted + 1
            if (method == "gauss16" .or. actual < 1e-10_dp .or. actual > 1e-3_dp) cycle
            call assertLessThan(claimed, 6.0_dp*actual, message=method//", swing"//to_text(i))
        end do
        call assertGreaterThan(counted, swings/3, message="swings with digits left")
    end subroutine check_ends

    subroutine perform(tree, group, method, dt, tolerance, outcome, truth)
        !! The run of one group of the file, and its true end.
        type(namelist_t), intent(inout) :: tree
        character(*), intent(in) :: group, method
        real(dp), intent(in) :: dt, tolerance
        type(outcome_t), intent(out) :: outcome
        real(dp), intent(out) :: truth(4)
        type(double_pendulum_t) :: system
        type(error_t), allocatable :: error
        type(scene_t) :: scene
        real(dp), allocatable :: q(:), v(:)

        call assertTrue(has_key(tree, group, "q_end"), group//" is there")
        if (anyExceptions()) return
        call get_reals(tree, group, "parameters", 5, 5, scene%parameters, error)
        call get_reals(tree, group, "q", 2, 2, scene%q, error)
        call get_reals(tree, group, "v", 2, 2, scene%v, error)
        call get_real(tree, group, "duration", scene%duration, error)
        call get_reals(tree, group, "q_end", 2, 2, q, error)
        call get_reals(tree, group, "v_end", 2, 2, v, error)
        truth = [q, v]
        call system%configure(scene%parameters, error)
        scene%source = group
        scene%system = "double_pendulum"
        scene%method = method
        scene%dt = dt
        scene%tolerance = tolerance
        scene%samples = 10
        scene%every = 20
        scene%error_estimate = .true.
        allocate (scene%columns(0), scene%plots(0), scene%expectations(0))
        call plan_and_run(scene, system, outcome, error)
        call assertFalse(allocated(error), group//" runs")
    end subroutine perform
end module test_swings
