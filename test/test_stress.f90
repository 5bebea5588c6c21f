module test_stress
    !! The verdicts of `lagrangia stress` on methods: each is seen to hold, and to fail.
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertTrue
    use lagrangia_edges_of_numbers, only: stress_edges
    use lagrangia_energy_growth, only: growth_t, stress_energy_growth, stress_rounding, &
                                       observe_energy
    use lagrangia_errors, only: error_t
    use lagrangia_integrator, only: integrator_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_ledger, only: ledger_t
    use lagrangia_ledger_text, only: allowed, measured_json, verdict
    use lagrangia_method_orders, only: new_problem
    use lagrangia_method_promises, only: stress_bytes, stress_reversal, stress_scaling, &
                                         stress_symplectic, stress_text
    use lagrangia_methods, only: method_names, new_integrator, nth_integrator
    use lagrangia_step_limits, only: stress_step_limit
    use lagrangia_system, only: system_t
    use spoiled_methods, only: new_spoiled, spoiled_t
    implicit none (type, external)
    private
    public :: stress_suite

contains

    function stress_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("stress")
        call suite%addTest(TestMethod("verdicts_hold_within_bounds", verdicts_hold_within_bounds))
        call suite%addTest(TestMethod("laws_are_named", laws_are_named))
        call suite%addTest(TestMethod("step_limits_are_measured", step_limits_are_measured))
        call suite%addTest(TestMethod("declared_step_limits_are_right", &
                                      declared_step_limits_are_right))
        call suite%addTest(TestMethod("energy_growth_is_named", energy_growth_is_named))
        call suite%addTest(TestMethod("every_step_is_taken", every_step_is_taken))
        call suite%addTest(TestMethod("promises_are_held", promises_are_held))
        call suite%addTest(TestMethod("rounding_is_told_apart", rounding_is_told_apart))
        call suite%addTest(TestMethod("edges_of_numbers_are_seen", edges_of_numbers_are_seen))
    end function stress_suite

    subroutine promises_are_held()
        !! Friction is no canonical map and not reversible; what is added at every call depends on
        !! the blocks, and, being no number of the system's units, on these.
        type(spoiled_t) :: spoiled
        class(integrator_t), allocatable :: method
        type(error_t), allocatable :: error
        type(ledger_t) :: verdicts
        integer :: i

        call verdicts%section("promises")
        call new_integrator("verlet", method, error)
        call stress_reversal(method, verdicts)
        call stress_symplectic(method, verdicts)
        call stress_bytes(method, verdicts)
        call stress_scaling(method, verdicts)
        call stress_text(verdicts)
        call assertEqual(0, verdicts%broken())
        call new_spoiled(spoiled, "verlet", damping=1e-8_dp)
        call stress_reversal(spoiled, verdicts)
        call stress_symplectic(spoiled, verdicts)
        call new_spoiled(spoiled, "verlet", share=epsilon(1.0_dp))
        call stress_bytes(spoiled, verdicts)
        call new_spoiled(spoiled, "verlet", push=1e-12_dp)
        call stress_scaling(spoiled, verdicts)
        do i = 6, 9
            call assertFalse(verdicts%rows(i)%holds, verdicts%rows(i)%measured)
        end do
        call new_integrator("rk4", method, error)
        call stress_reversal(method, verdicts)
        call assertEqual("stated", verdict(verdicts%rows(10)))
    end subroutine promises_are_held

    subroutine rounding_is_told_apart()
        !! Plain sums, taken for compensated ones, lose too much; a method that is not Verlet has
        !! another energy.
        class(integrator_t), allocatable :: method
        type(error_t), allocatable :: error
        type(ledger_t) :: verdicts

        call verdicts%section("rounding")
        call new_integrator("verlet", method, error)
        call stress_rounding(method, "plain", 1000000_i8, verdicts)
        call stress_rounding(method, "compensated", 1000000_i8, verdicts)
        call new_integrator("verlet", method, error, compensated=.true.)
        call stress_rounding(method, "compensated", 100000_i8, verdicts)
        call new_integrator("velocity_verlet", method, error)
        call stress_rounding(method, "plain", 10000_i8, verdicts)
        call assertTrue(all(verdicts%rows%holds .eqv. [.true., .false., .true., .false.]), &
                        "plain, compensated")
    end subroutine rounding_is_told_apart

    subroutine edges_of_numbers_are_seen()
        !! RK4 passes; what adds a constant is not linear, and what damps never overflows.
        class(integrator_t), allocatable :: method
        type(spoiled_t) :: spoiled
        type(error_t), allocatable :: error
        type(ledger_t) :: verdicts

        call verdicts%section("edges")
        call new_integrator("rk4", method, error)
        call stress_edges(method, verdicts)
        call assertEqual(0, verdicts%broken())
        call new_spoiled(spoiled, "rk4", push=1e-3_dp)
        call stress_edges(spoiled, verdicts)
        call assertFalse(verdicts%rows(6)%holds .or. verdicts%rows(7)%holds, "amplitudes")
        call new_spoiled(spoiled, "rk4", damping=0.5_dp)
        call stress_edges(spoiled, verdicts)
        call assertFalse(verdicts%rows(13)%holds .or. verdicts%rows(14)%holds, "overflow")
        ! 2^29 last digits, to either side
        call new_spoiled(spoiled, "rk4", push=2.0_dp**(-1045))
        call stress_edges(spoiled, verdicts)
        call new_spoiled(spoiled, "rk4", push=-2.0_dp**(-1045))
        call stress_edges(spoiled, verdicts)
        call assertTrue(verdicts%rows(16)%holds .and. verdicts%rows(21)%holds, "no share of 1")
        call assertFalse(verdicts%rows(17)%holds .or. verdicts%rows(22)%holds, "of a denormal")
    end subroutine edges_of_numbers_are_seen

    subroutine verdicts_hold_within_bounds()
        !! From both sides; NaN never; a statement has no bounds.
        type(ledger_t) :: verdicts
        real(dp) :: nan

        nan = 0.0_dp
        nan = nan/nan
        call verdicts%section("a_row")
        call verdicts%judge("small", "x", 1.0_dp, most=1.0_dp)
        call verdicts%judge("large", "x", 1.5_dp, most=1.0_dp)
        call verdicts%judge("low", "x", 0.5_dp, 1.0_dp, 2.0_dp)
        call verdicts%judge("inside", "x", 1.5_dp, 1.0_dp, 2.0_dp)
        call verdicts%judge("nothing", "x", nan, most=1.0_dp)
        call verdicts%judge("no bounds", "x", 3.0_dp)
        call verdicts%judge("no number", "x", nan)
        call assertTrue(all(verdicts%rows%holds .eqv. [.true., .false., .false., .true., .false., &
                                                       .true., .false.]), "verdicts")
        call assertEqual(4, verdicts%broken())
        call assertEqual("<= 1.0", allowed(verdicts%rows(1)))
        call assertEqual("1.000 .. 2.000", allowed(verdicts%rows(4)))
        call assertEqual("-", allowed(verdicts%rows(6)))
        call assertEqual("FAILS", verdict(verdicts%rows(2)))
        call assertEqual("stated", verdict(verdicts%rows(6)))
        call assertEqual('{"row": "a_row", "case": "nothing", "measured": "x", "value": null, '// &
                         '"least": null, "most": 1.0000000000000000E+000, "holds": false, '// &
                         '"remark": ""}', measured_json(verdicts%rows(5)))
    end subroutine verdicts_hold_within_bounds

    subroutine laws_are_named()
        !! Powers with a little noise, and what overflows.
        type(growth_t) :: growth(5)
        real(dp) :: n
        integer(i8) :: k

        do k = 100, 1000000, 100
            n = real(k, dp)
            call growth(1)%see(k, 1e-3_dp*abs(cos(n)))
            call growth(2)%see(k, 1e-15_dp*sqrt(n)*(1.0_dp + 0.1_dp*sin(n)))
            call growth(3)%see(k, 1e-9_dp*n*(1.0_dp + 0.1_dp*sin(n)))
            call growth(4)%see(k, 1e-15_dp*n**2)
            call growth(5)%see(k, exp(n))
        end do
        call assertEqual("bounded", growth(1)%law())
        call assertEqual("sqrt N", growth(2)%law())
        call assertEqual("linear", growth(3)%law())
        call assertEqual("faster than linear", growth(4)%law())
        call assertTrue(growth(5)%worst >= huge(n), "overflow is seen")
        call assertEqual("linear: 0.0011 after 1000000 steps", growth(3)%remark())
    end subroutine laws_are_named

    subroutine step_limits_are_measured()
        !! What Verlet and RK4 declare is so; another claim fails, and so does a method whose map
        !! of one step says other than its runs.
        class(integrator_t), allocatable :: method
        type(spoiled_t) :: spoiled
        type(error_t), allocatable :: error
        type(ledger_t) :: verdicts

        call verdicts%section("step_limits")
        call new_integrator("verlet", method, error)
        call stress_step_limit(method, 2000_i8, verdicts)
        call assertEqual(2.0_dp, verdicts%rows(1)%value, 1e-3_dp, "verlet")
        call new_integrator("rk4", method, error)
        call stress_step_limit(method, 20000_i8, verdicts)
        call assertEqual(2.0_dp*sqrt(2.0_dp), verdicts%rows(3)%value, 1e-3_dp, "rk4")
        call assertEqual(0, verdicts%broken())
        method%step_limit = 2.9_dp
        call stress_step_limit(method, 1000_i8, verdicts)
        call assertFalse(verdicts%rows(5)%holds, "another claim")
        call new_spoiled(spoiled, "verlet", damping=-1e-2_dp)
        call stress_step_limit(spoiled, 1000_i8, verdicts)
        call assertFalse(verdicts%rows(7)%holds, "energy is fed in at every step")
    end subroutine step_limits_are_measured

    subroutine declared_step_limits_are_right()
        !! To all six digits of every table: there two eigenvalues meet, and part with the root
        !! of what the step is longer. That of `rk4` leaves the circle more slowly.
        class(integrator_t), allocatable :: method
        type(ledger_t) :: verdicts
        integer :: i, declared

        call verdicts%section("step_limits")
        declared = 0
        do i = 1, size(method_names())
            call nth_integrator(i, method)
            if (.not. method%step_limit > 0.0_dp) cycle
            declared = declared + 1
            call stress_step_limit(method, 1_i8, verdicts)
            call assertEqual(verdicts%rows(2*declared - 1)%value, method%step_limit, &
                             merge(1e-5_dp, 7e-7_dp, method%name == "rk4"), trim(method%name))
        end do
        call assertEqual(12, declared, message="methods with a limit")
    end subroutine declared_step_limits_are_right

    subroutine energy_growth_is_named()
        !! Verlet's stays, RK4's grows with the steps, and that of a symplectic method with a
        !! little friction, too, though it declares otherwise.
        class(integrator_t), allocatable :: method
        type(spoiled_t) :: spoiled
        type(error_t), allocatable :: error
        type(ledger_t) :: verdicts

        call verdicts%section("energy_growth")
        call new_integrator("verlet", method, error)
        call stress_energy_growth(method, 100000_i8, verdicts)
        call assertTrue(verdicts%rows(1)%holds, "verlet")
        call assertEqual("bounded", verdicts%rows(1)%remark(:7))
        call new_integrator("rk4", method, error)
        call stress_energy_growth(method, 400000_i8, verdicts)
        call assertTrue(verdicts%rows(2)%holds, "rk4")
        call assertEqual("linear", verdicts%rows(2)%remark(:6))
        call new_spoiled(spoiled, "suzuki4", damping=1e-7_dp)
        call stress_energy_growth(spoiled, 500000_i8, verdicts)
        call assertFalse(verdicts%rows(3)%holds, "friction")
        call assertEqual("linear", verdicts%rows(3)%remark(:6))
    end subroutine energy_growth_is_named

    subroutine every_step_is_taken()
        !! Whether or not sevens go into them: the end is that of one call, to the last bit, and as
        !! many evaluations; the error is that of the worst step seen.
        class(integrator_t), allocatable :: method
        class(system_t), allocatable :: system
        type(error_t), allocatable :: error
        type(growth_t) :: growth
        real(dp), allocatable :: q(:), v(:), q_end(:), v_end(:)
        integer(i8) :: steps
        integer :: i

        call new_integrator("verlet", method, error)
        do i = 0, 8
            steps = 1400 + i
            call new_problem(1, system, q, v)
            q_end = q
            v_end = v
            call method%prepare(system, error)
            call method%start(system, 0.0_dp, q_end, v_end)
            call method%advance(system, 0.0_dp, 0.02_dp, 0_i8, steps, q_end, v_end)
            call observe_energy(method, system, 0.02_dp, steps, q, v, growth)
            call assertEqual([q_end, v_end], [q, v], message="the end")
            call assertEqual(steps, method%evaluations, "evaluations")
            call assertEqual(1001.0_dp, growth%steps(1), 0.0_dp, "first seen")
        end do
    end subroutine every_step_is_taken
end module test_stress
