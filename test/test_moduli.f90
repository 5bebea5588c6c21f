module test_moduli
    !! Potentials with \(|x|\) in them: from \(x = 0\) a motion goes on where V is smooth there.
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertTrue
    use lagrangia_errors, only: error_t, status_numbers
    use lagrangia_kinds, only: dp
    use lagrangia_observer, only: observer_t
    use lagrangia_outcome, only: outcome_t
    use lagrangia_run_plan, only: parse_run_plan, run_plan_t
    use lagrangia_scene_run, only: run_scene
    use lagrangia_text, only: word_t
    implicit none (type, external)
    private
    public :: moduli_suite

contains

    function moduli_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("moduli")
        call suite%addTest(TestMethod("smooth_ones_begin_at_zero", smooth_ones_begin_at_zero))
        call suite%addTest(TestMethod("a_kink_is_refused", a_kink_is_refused))
    end function moduli_suite

    subroutine run(v, method, energy, status, message)
        !! From \(x = 0\), \(\dot x = -1\) for 2 s; the energy at the end.
        character(*), intent(in) :: v, method
        real(dp), intent(out) :: energy
        integer, intent(out) :: status
        character(:), allocatable, intent(out) :: message
        type(run_plan_t), allocatable :: plan
        type(outcome_t) :: outcome
        type(error_t), allocatable :: error
        class(observer_t), pointer :: nobody
        type(word_t) :: none(0)

        nobody => null()
        allocate (plan)
        call parse_run_plan(plan, "&scene system = 'wall', q = 0.0, v = -1.0, duration = 2.0, "// &
                            method//" /"//new_line("a")//"&lagrangian coordinates = 'x', "// &
                            "parameters = 'k', T = 'x_dot^2/2', V = '"//v//"' /"// &
                            new_line("a")//"&wall k = 3.0 /"//new_line("a"), "scene", none, error)
        call assertFalse(allocated(error), "read: "//v)
        status = 0
        message = ""
        energy = 0.0_dp
        if (.not. allocated(error)) call run_scene(plan, "", "text", nobody, outcome, error)
        if (allocated(error)) then
            status = error%status
            message = error%message
        else
            energy = plan%system%energy(outcome%t, outcome%q, outcome%v)
        end if
    end subroutine run

    subroutine smooth_ones_begin_at_zero()
        !! Powers, walls whose force begins there, and functions of zeros.
        character(*), parameter :: smooth(*) = [character(26) :: "k/2 |x|^3", &
            "k/2 (|x| - x)^2/4", "k |x|^(7/2)", "k |sin(x)|^3", "k x |x|", "k |x|^2", &
            "k |x^3|", "k exp(-|x|^3)"]
        character(:), allocatable :: message
        real(dp) :: energy, at_start
        integer :: i, status

        do i = 1, size(smooth)
            at_start = 0.5_dp
            if (index(smooth(i), "exp") > 0) at_start = 3.5_dp
            call run(trim(smooth(i)), "method = 'rk4', dt = 1e-3", energy, status, message)
            call assertEqual(0, status, trim(smooth(i))//message)
            call assertEqual(at_start, energy, 1e-7_dp, trim(smooth(i)))
            call run(trim(smooth(i)), "method = 'dop853', tolerance = 1e-9, samples = 3", energy, &
                     status, message)
            call assertEqual(at_start, energy, 1e-7_dp, trim(smooth(i))//" by dop853"//message)
        end do
    end subroutine smooth_ones_begin_at_zero

    subroutine a_kink_is_refused()
        !! Where the force jumps nothing says which one holds.
        character(*), parameter :: kinked(*) = [character(12) :: "k |x|", "k |x| + x^2", &
                                                "k |sin(x)|", "-k x + k |x|"]
        character(:), allocatable :: message
        real(dp) :: energy
        integer :: i, status

        do i = 1, size(kinked)
            call run(trim(kinked(i)), "method = 'rk4', dt = 1e-3", energy, status, message)
            call assertEqual(status_numbers, status, trim(kinked(i)))
            call assertTrue(index(message, "has a kink there: its derivative by x jumps") > 0, &
                            message)
        end do
    end subroutine a_kink_is_refused
end module test_moduli
