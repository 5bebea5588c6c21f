module test_sweep_scenes
    !! A trajectory of a sweep is that of the scene with its number changed: what follows from
    !! others by constraints or defaults follows, and events that end a run end it.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertTrue
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp
    use lagrangia_sweep, only: fits_lanes, sweep_t
    use sweep_numbers, only: compute_numbers, make_sweep, sweep_numbers_t
    use test_sweep_command, only: sweep_command_suite
    implicit none (type, external)
    private
    public :: sweep_scenes_suite

contains

    function sweep_scenes_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("sweep_scenes")
        call suite%addTest(TestMethod("constrained_velocities_follow", &
                                      constrained_velocities_follow))
        call suite%addTest(TestMethod("computed_parameters_follow", computed_parameters_follow))
        call suite%addTest(TestMethod("stops_of_the_scene_stop", stops_of_the_scene_stop))
        call suite%addTest(TestMethod("no_exponent_where_it_stops", no_exponent_where_it_stops))
        call suite%addTest(sweep_command_suite())
    end function sweep_scenes_suite

    subroutine compute(text, over, keep, result, error, sweep)
        !! What a sweep gives, by two processes.
        character(*), intent(in) :: text, over(:), keep(:)
        type(sweep_numbers_t), intent(out) :: result
        type(error_t), allocatable, intent(out) :: error
        type(sweep_t), intent(out) :: sweep

        call make_sweep(text, over, keep, sweep, error)
        if (.not. allocated(error)) call compute_numbers(sweep, 2, result, error)
    end subroutine compute

    subroutine constrained_velocities_follow()
        !! A disk that rolls towards \((\sin\theta, -\cos\theta)\), as fast as it turns.
        character(*), parameter :: scene = "&scene system='rolling_disk', method='rk4', "// &
            "dt=1e-3, duration=2, samples=4, q=0, 0, 0, 0.7, v=4, 0 / &rolling_disk m=1, r=0.3 /"
        type(sweep_numbers_t) :: result
        type(sweep_t) :: sweep
        type(error_t), allocatable :: error
        integer :: i

        call compute(scene, ["phi_dot=1:3:3"], ["x", "y"], result, error, sweep)
        call assertFalse(allocated(error), "it can be computed")
        if (allocated(error)) return
        do i = 1, 3
            call assertEqual(0.6_dp*i*[sin(0.7_dp), -cos(0.7_dp)], result%values(:, i), 1e-12_dp, &
                             "after 2 s straight ahead with r phi_dot")
        end do
        call compute(scene, ["x_dot=1:3:3"], ["x", "y"], result, error, sweep)
        call assertTrue(allocated(error), "x_dot is not free")
        if (allocated(error)) call assertEqual("x_dot follows from the other velocities by the "// &
                                               "constraints; take one of phi_dot, theta_dot", &
                                               error%message)
    end subroutine constrained_velocities_follow

    subroutine computed_parameters_follow()
        !! A disk that rolls straight down an incline falls by
        !! \(\frac{g t^2\sin\alpha}{2(1 + I/(m r^2))}\): with \(I = m r^2/2\), where it is not
        !! given, however large and heavy it is.
        character(*), parameter :: scene = "&scene system='rolling_disk', method='rk4', "// &
            "dt=1e-2, duration=2, samples=4, q=0, 0, 0, 1.5707963267948966 / "
        real(dp), parameter :: free = 0.5_dp*9.81_dp*sin(0.2_dp)*4
        type(sweep_numbers_t) :: result
        type(sweep_t) :: sweep
        type(error_t), allocatable :: error

        call compute(scene//"&rolling_disk m=1, r=0.3, incline=0.2 /", ["r=0.1:0.7:4"], ["x"], &
                     result, error, sweep)
        call assertFalse(allocated(error), "r can be an axis")
        if (allocated(error)) return
        call assertEqual(spread(free/1.5_dp, 1, 4), result%values(1, :), 1e-12_dp, "any r")
        call compute(scene//"&rolling_disk m=1, r=0.3, incline=0.2 /", ["m=0.1:7:4"], ["x"], &
                     result, error, sweep)
        call assertEqual(spread(free/1.5_dp, 1, 4), result%values(1, :), 1e-12_dp, "any m")
        call compute(scene//"&rolling_disk m=1, r=0.3, incline=0.2 /", ["i_roll=0.09:0.18:2"], &
                     ["x"], result, error, sweep)
        call assertEqual(free/[2, 3], result%values(1, :), 1e-12_dp, "an axis of its own")
        call compute(scene//"&rolling_disk m=1, r=0.3, i_roll=0.09, incline=0.2 /", &
                     ["m=1:2:2"], ["x"], result, error, sweep)
        call assertEqual(free/[2.0_dp, 1.5_dp], result%values(1, :), 1e-12_dp, "given")
    end subroutine computed_parameters_follow

    subroutine stops_of_the_scene_stop()
        !! A particle leaves a sphere where the cosine of its angle from the top is 2/3 of that at
        !! which it was released, whatever else is kept.
        character(*), parameter :: scene = "&scene system='pendulum', method='dop853', "// &
            "tolerance=1e-12, duration=10, samples=10, q=3, event='tension rising stop' / "
        real(dp), parameter :: pi = acos(-1.0_dp)
        type(sweep_numbers_t) :: result
        type(sweep_t) :: sweep
        type(error_t), allocatable :: error
        real(dp) :: from(3)

        from = [0.2_dp, 0.5_dp, 0.8_dp]
        call compute(scene, ["theta=2.3415926535897931:2.9415926535897932:3"], &
                     [character(24) :: "theta", "t", "max theta_dot", "first theta = 2 falling"], &
                     result, error, sweep)
        call assertFalse(allocated(error), "it can be computed")
        if (allocated(error)) return
        call assertFalse(fits_lanes(sweep), "each ends by itself")
        call assertEqual(pi - acos(2*cos(from(3:1:-1))/3), result%values(1, :), 1e-10_dp, &
                         "where it leaves")
        call assertTrue(all(result%values(2, :) < 3), "not at the end of the scene")
        call assertTrue(all(result%values(3, :) <= 0), "it never comes back")
        call assertTrue(all(ieee_is_nan(result%values(4, :))), "nor is it followed")
        call compute(scene, ["theta=2.3415926535897931:2.9415926535897932:3"], &
                     ["first theta = 2.5 falling"], result, error, sweep)
        call assertTrue(result%values(1, 3) < 3, "an event before is met")
    end subroutine stops_of_the_scene_stop

    subroutine no_exponent_where_it_stops()
        type(sweep_numbers_t) :: result
        type(sweep_t) :: sweep
        type(error_t), allocatable :: error

        call compute("&scene system='pendulum', method='dop853', tolerance=1e-9, duration=10, "// &
                     "samples=10, q=3, event='tension rising stop' / ", ["theta=2:3:3"], &
                     ["lyapunov"], result, error, sweep)
        call assertTrue(allocated(error), "it ends before")
        if (allocated(error)) call assertEqual("a Lyapunov exponent takes the whole duration, "// &
            "but the scene ends at 'tension rising stop'; leave that event out", error%message)
    end subroutine no_exponent_where_it_stops
end module test_sweep_scenes
