module test_written_mass
    !! Systems in formulas whose mass matrix is positive definite at some places only.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertTrue
    use lagrangia_command_line, only: word_t
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp, lanes
    use lagrangia_scene, only: scene_t
    use lagrangia_scene_reader, only: parse_scene
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: written_mass_suite

    integer, parameter :: last = 3
    character(1), parameter :: names(last) = ["u", "y", "z"]

contains

    function written_mass_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("written_mass")
        call suite%addTest(TestMethod("nan_where_it_is_not_positive", &
                                      nan_where_it_is_not_positive))
    end function written_mass_suite

    subroutine nan_where_it_is_not_positive()
        !! With cos(u) for the inertia of each of one, two and three coordinates.
        class(system_t), allocatable :: system
        type(scene_t) :: scene
        type(error_t), allocatable :: error
        type(word_t) :: none(0)
        character(:), allocatable :: coordinates, kinetic, start
        integer :: i, k, n

        do n = 1, last
            do k = 1, n
                coordinates = ""
                start = ""
                kinetic = "0"
                do i = 1, n
                    coordinates = coordinates//" '"//names(i)//"'"
                    start = start//" 0.3"
                    if (i == k) kinetic = kinetic//" + cos(u)/2 "//names(i)//"_dot^2"
                    if (i /= k) kinetic = kinetic//" + "//names(i)//"_dot^2"
                end do
                call parse_scene("&scene system = 'own' dt = 1e-3 duration = 1.0 q ="//start// &
                                 " / &lagrangian coordinates ="//coordinates//", T = '"//kinetic// &
                                 "', V = 'u' /", "own.nml", none, scene, system, error)
                if (allocated(error)) call assertEqual("", error%message)
                if (allocated(error)) return
                call look_at(system, n, kinetic)
            end do
        end do
    end subroutine nan_where_it_is_not_positive

    subroutine look_at(system, n, kinetic)
        !! Accelerations are NaN at u = 2, and numbers at u = 1, alone and in lanes.
        class(system_t), intent(in) :: system
        integer, intent(in) :: n
        character(*), intent(in) :: kinetic  !! T
        real(dp), dimension(n) :: q, v, a
        real(dp), dimension(lanes, n) :: all_q, all_v, all_a
        real(dp) :: times(lanes)

        v = 0.0_dp
        q = 2.0_dp
        call system%accelerations(0.0_dp, q, v, a)
        call assertTrue(all(ieee_is_nan(a)), "not positive: "//kinetic)
        q(1) = 1.0_dp
        call system%accelerations(0.0_dp, q, v, a)
        call assertFalse(any(ieee_is_nan(a)), "positive: "//kinetic)
        times = 0.0_dp
        all_v = 0.0_dp
        all_q = 2.0_dp
        all_q(3, 1) = 1.0_dp
        call system%accelerations_lanes(times, all_q, all_v, all_a)
        call assertTrue(all(count(ieee_is_nan(all_a), 1) == lanes - 1), "seven lanes: "//kinetic)
        call assertFalse(any(ieee_is_nan(all_a(3, :))), "the third lane: "//kinetic)
    end subroutine look_at
end module test_written_mass
