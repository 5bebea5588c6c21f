module test_stress_systems
    !! The verdicts of `lagrangia stress` on systems: each is seen to hold, and to fail.
    use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
    use careless_systems, only: careless_ball_t, careless_double_t, careless_pendulum_t, &
                                careless_wedge_t
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertTrue
    use lagrangia_bounces, only: stress_elastic, stress_zeno
    use lagrangia_bouncing_ball, only: bouncing_ball_t
    use lagrangia_catalogue, only: new_system
    use lagrangia_chaos, only: stress_chaos
    use lagrangia_double_pendulum, only: double_pendulum_t
    use lagrangia_errors, only: error_t
    use lagrangia_integrator, only: dense_integrator_t
    use lagrangia_kinds, only: dp
    use lagrangia_ledger, only: ledger_t
    use lagrangia_limits_of_systems, only: stress_slow_disk, stress_slow_wire, stress_wedge, &
                                           stress_weak_field
    use lagrangia_methods, only: new_adaptive
    use lagrangia_pendulum, only: pendulum_t
    use lagrangia_pendulum_extremes, only: exact_omega2, exact_period, stress_large_angles, &
                                           stress_mass_ratios, stress_massless, stress_separatrix
    use lagrangia_system, only: system_t
    use lagrangia_wedge, only: wedge_t
    use plain_system, only: plain_system_t
    implicit none (type, external)
    private
    public :: stress_systems_suite

    type, extends(plain_system_t) :: saddle_t
        !! Two coordinates pushed away from (2, 1), where the runs of `stress_chaos` begin.
    contains
        procedure :: accelerations => pushed
    end type saddle_t

    type, extends(plain_system_t) :: chasm_t
        !! Springs, which end where the first coordinate is less than 0.3.
    contains
        procedure :: accelerations => pulled
    end type chasm_t

contains

    function stress_systems_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("stress_systems")
        call suite%addTest(TestMethod("the_pendulum_at_its_extremes", the_pendulum_at_its_extremes))
        call suite%addTest(TestMethod("masses_of_all_sizes", masses_of_all_sizes))
        call suite%addTest(TestMethod("steep_and_flat_wedges", steep_and_flat_wedges))
        call suite%addTest(TestMethod("slow_turns", slow_turns))
        call suite%addTest(TestMethod("bounces", bounces))
        call suite%addTest(TestMethod("chaos_takes_digits", chaos_takes_digits))
        call suite%addTest(TestMethod("the_time_of_no_digit_is_predicted", &
                                      the_time_of_no_digit_is_predicted))
        call suite%addTest(TestMethod("who_gives_up_has_no_digit", who_gives_up_has_no_digit))
    end function stress_systems_suite

    subroutine check_all(verdicts, hold, what, cases)
        !! All lines hold, or none of those of `what` does; then start anew.
        type(ledger_t), intent(inout) :: verdicts
        logical, intent(in) :: hold
        character(*), intent(in) :: what
        character(*), intent(in), optional :: cases  !! what the lines are of, in this order
        character(:), allocatable :: found
        integer :: i

        if (present(cases)) then
            found = trim(verdicts%rows(1)%name)
            do i = 2, size(verdicts%rows)
                if (verdicts%rows(i)%name == verdicts%rows(i - 1)%name) cycle
                found = found//"; "//trim(verdicts%rows(i)%name)
            end do
            call assertEqual(cases, found, "cases")
        end if

        do i = 1, size(verdicts%rows)
            associate (line => verdicts%rows(i))
                if (hold) call assertTrue(line%holds, trim(line%name)//" "//line%measured)
                if (.not. hold .and. index(line%measured, what) > 0) call assertFalse(line%holds, &
                    "careless: "//trim(line%name)//" "//line%measured)
            end associate
        end do
        call assertTrue(any(index(verdicts%rows%measured, what) > 0), what)
        deallocate (verdicts%rows)
        call verdicts%section("next")
    end subroutine check_all

    subroutine new_method(name, tolerance, method)
        character(*), intent(in) :: name
        real(dp), intent(in) :: tolerance
        class(dense_integrator_t), allocatable, intent(out) :: method

        call new_adaptive(name, method)
        method%tolerance = tolerance
    end subroutine new_method

    subroutine the_pendulum_at_its_extremes()
        !! The period beside numbers from a table; then near the top, and wound up.
        class(dense_integrator_t), allocatable :: method
        type(pendulum_t) :: system
        type(careless_pendulum_t) :: careless
        type(error_t), allocatable :: error
        type(ledger_t) :: verdicts

        call system%configure([1.0_dp, 1.0_dp, 1.0_dp], error)
        call assertEqual(8.3497529269184947344_dp, exact_period(system, 2.0_dp), 2e-15_dp, "2 rad")
        call assertEqual(16.155539372393374764_dp, exact_period(system, 3.0_dp), 4e-15_dp, "3 rad")
        call careless%configure([1.0_dp, 1.0_dp, 9.81_dp], error)
        call new_method("gauss16", 1e-13_dp, method)
        call verdicts%section("near_separatrix")
        call stress_separatrix(system, method, verdicts)
        call assertEqual(5, count(index(verdicts%rows%measured, "run") > 0), "runs, to 1e-12")
        call check_all(verdicts, .true., "run", "pi - 1e-1; pi - 1e-3; pi - 1e-6; pi - 1e-9; "// &
                       "pi - 1e-12; pi - 1e-15")
        call stress_large_angles(system, method, verdicts)
        call check_all(verdicts, .true., "last digits", &
                       "theta = 1000.0; theta = 1000000.0; theta = 1000000000.0")
        call stress_separatrix(careless, method, verdicts)
        call assertFalse(verdicts%rows(2)%holds .or. verdicts%rows(4)%holds, "a careless run")
        call check_all(verdicts, .false., "closed form")
        call stress_large_angles(careless, method, verdicts)
        call check_all(verdicts, .false., "last digits")
    end subroutine the_pendulum_at_its_extremes

    subroutine masses_of_all_sizes()
        !! The formula in quadruple precision solves the characteristic equation; a rod that is off
        !! by 1e-12 is seen, a mass of zero too.
        class(dense_integrator_t), allocatable :: method
        type(double_pendulum_t) :: system
        type(careless_double_t) :: careless
        type(ledger_t) :: verdicts
        real(dp) :: omega2(2)

        omega2 = exact_omega2(3.0_dp, 2.0_dp)
        call assertEqual(9.81_dp**2*5.0_dp/(3.0_dp*0.7_dp), product(omega2), 1e-12_dp, "product")
        call assertEqual(9.81_dp*5.0_dp*1.7_dp/(3.0_dp*0.7_dp), sum(omega2), 1e-13_dp, "sum")
        call new_method("gauss16", 1e-11_dp, method)
        call verdicts%section("mass_ratios")
        call stress_massless(system, verdicts)
        call check_all(verdicts, .true., "refused", "m1 = 1e-3; m1 = 1e-6; m1 = 1e-12; "// &
                       "m1 = 1e-100; m1 = 1e-300; m1 = 0")
        call stress_massless(careless, verdicts)
        call assertFalse(verdicts%rows(7)%holds, "slow mode, 1e-100")
        call check_all(verdicts, .false., "refused")
        call stress_mass_ratios(careless, method, 0.0_dp, verdicts)
        call check_all(verdicts, .false., "frequencies")
        call stress_mass_ratios(system, method, 1e-5_dp, verdicts)
        call check_all(verdicts, .true., "from one", "m1/m2 = 1e-12; m1/m2 = 1e-8; "// &
                       "m1/m2 = 1e-4; m1/m2 = 1e0; m1/m2 = 1e4; m1/m2 = 1e8; m1/m2 = 1e12; "// &
                       "m1/m2 = 1e-12")
    end subroutine masses_of_all_sizes

    subroutine steep_and_flat_wedges()
        !! Both ends; a constant that is far below the last digit elsewhere is not there.
        type(wedge_t) :: system
        type(careless_wedge_t) :: careless
        type(ledger_t) :: verdicts

        call verdicts%section("wedge")
        call stress_wedge(system, verdicts)
        call check_all(verdicts, .true., "accelerations", "alpha = 0.6; alpha = 0.0001; "// &
                       "alpha = 1e-8; alpha = 1e-300; alpha = 0.0; alpha = pi/2 - 1e-4; "// &
                       "alpha = pi/2 - 1e-12; alpha = pi/2 - 0")
        call stress_wedge(careless, verdicts)
        call check_all(verdicts, .false., "accelerations")
    end subroutine steep_and_flat_wedges

    subroutine slow_turns()
        !! Closed forms hold; a system that has none, or takes other parameters, does not.
        class(system_t), allocatable :: system
        type(error_t), allocatable :: error
        type(ledger_t) :: verdicts
        integer :: i
        character(13), parameter :: turns(4) = [character(13) :: "wire, omega", "disk, omega", &
                                                "charge, B", ""]
        character(16), parameter :: names(4) = [character(16) :: "rotating_wire", "rolling_disk", &
                                                "charged_particle", "oscillator"]

        call verdicts%section("slow_rotation")
        do i = 1, 4
            call new_system(trim(names(i)), system, error)
            select case (i)
            case (1); call stress_slow_wire(system, verdicts)
            case (2); call stress_slow_disk(system, verdicts)
            case (3); call stress_weak_field(system, verdicts)
            case default; call stress_slow_wire(system, verdicts)
            end select
            if (i < 4) call check_all(verdicts, .true., "after 2 s", cases_of(trim(turns(i))))
            if (i == 4) call assertFalse(any(verdicts%rows(:2)%holds), "another system")
        end do
    contains
        pure function cases_of(turn) result(text)
            !! From 1 down to 0.
            character(*), intent(in) :: turn
            character(:), allocatable :: text

            text = turn//" = 1.0; "//turn//" = 0.001; "//turn//" = 1e-6; "//turn//" = 1e-9; "// &
                   turn//" = 1e-300; "//turn//" = 0.0"
        end function cases_of
    end subroutine slow_turns

    subroutine bounces()
        !! A restitution off by 1e-10 is seen; a ball that never rests, too.
        class(dense_integrator_t), allocatable :: method
        type(bouncing_ball_t) :: system
        type(careless_ball_t) :: careless
        type(ledger_t) :: verdicts

        call new_method("dop853", 1e-12_dp, method)
        call verdicts%section("bounces")
        call stress_elastic(system, method, verdicts)
        call check_all(verdicts, .true., "20 bounces", "e = 1 - 1e-1; e = 1 - 1e-4; "// &
                       "e = 1 - 1e-8; e = 1 - 1e-12; e = 1 - 1e-15; e = 1")
        call stress_zeno(system, method, verdicts)
        call check_all(verdicts, .true., "height", "e = 0.1; e = 0.5; e = 0.8; e = 0.95")
        call stress_elastic(careless, method, verdicts)
        call check_all(verdicts, .false., "20 bounces")
        call stress_zeno(careless, method, verdicts)
        call check_all(verdicts, .false., "time of the last")
    end subroutine bounces

    subroutine chaos_takes_digits()
        !! Without gravity the motion is integrable: then the exponent is none.
        class(dense_integrator_t), allocatable :: method, other
        type(double_pendulum_t) :: system
        type(error_t), allocatable :: error
        type(ledger_t) :: verdicts

        call new_method("gauss16", 1e-13_dp, method)
        call new_method("dop853", 1e-13_dp, other)
        call system%configure([1.0_dp, 1.0_dp, 1.0_dp, 1.0_dp, 9.81_dp], error)
        call verdicts%section("chaos")
        call stress_chaos(system, method, other, 40.0_dp, verdicts)
        call check_all(verdicts, .true., "part")
        call assertEqual(1e-14_dp, method%tolerance, 0.0_dp, "as the row says")
        call assertEqual(1e-10_dp, other%tolerance, 0.0_dp, "as the last row says")
        call system%configure([1.0_dp, 1.0_dp, 1.0_dp, 1.0_dp, 0.0_dp], error)
        call stress_chaos(system, method, other, 40.0_dp, verdicts)
        call check_all(verdicts, .false., "ln(growth)")
    end subroutine chaos_takes_digits

    subroutine the_time_of_no_digit_is_predicted()
        !! At rest on a saddle, \(\ddot q = q - q_0\): a difference of \((1, -1)/2\) rad and
        !! \((1, 1)/2\) rad/s grows by \(\sqrt{\cosh 2t}\), which is \(1/\epsilon\) at 36.39 s and
        !! seen at 36.5 s. The bounds are half and twice of that.
        class(dense_integrator_t), allocatable :: method, other
        type(saddle_t) :: system
        type(ledger_t) :: verdicts
        type(error_t), allocatable :: error

        call system%configure([real(dp) ::], error)
        call new_method("gauss16", 1e-13_dp, method)
        call new_method("dop853", 1e-13_dp, other)
        call verdicts%section("saddle")
        call stress_chaos(system, method, other, 40.0_dp, verdicts)
        call assertEqual(18.25_dp, verdicts%rows(2)%least, 0.0_dp, "half of it")
        call assertEqual(73.0_dp, verdicts%rows(2)%most, 0.0_dp, "twice of it")
    end subroutine the_time_of_no_digit_is_predicted

    subroutine who_gives_up_has_no_digit()
        !! \(2\cos t\) is 0.3 at 1.42 s: seen at 1.5 s, where the sample before was within 0.7 of
        !! zero.
        class(dense_integrator_t), allocatable :: method, other
        type(chasm_t) :: system
        type(ledger_t) :: verdicts
        type(error_t), allocatable :: error

        call system%configure([real(dp) ::], error)
        call new_method("gauss16", 1e-13_dp, method)
        call new_method("dop853", 1e-13_dp, other)
        call verdicts%section("chasm")
        call stress_chaos(system, method, other, 10.0_dp, verdicts)
        call assertEqual(1.5_dp, verdicts%rows(2)%value, 0.0_dp, "the first sample without")
        call assertEqual("up to t = 1.25 s", verdicts%rows(3)%remark)
    end subroutine who_gives_up_has_no_digit

    pure subroutine pulled(self, t, q, v, a)
        !! See `chasm_t`.
        class(chasm_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp), intent(out) :: a(self%ndof)

        a = -q
        if (q(1) < 0.3_dp) a = ieee_value(t, ieee_quiet_nan)
    end subroutine pulled

    pure subroutine pushed(self, t, q, v, a)
        !! See `saddle_t`.
        class(saddle_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp), intent(out) :: a(self%ndof)

        a = q - [2.0_dp, 1.0_dp]
    end subroutine pushed
end module test_stress_systems
