module test_stress_texts
    !! What the rows of `lagrangia stress` say in words, shown in numbers.
    use formula, only: formula_value, names_t
    use funit, only: TestMethod, TestSuite, assertEqual, assertGreaterThan, assertLessThan, &
                     assertTrue
    use lagrangia_chaos, only: stress_chaos
    use lagrangia_double_pendulum, only: double_pendulum_t
    use lagrangia_errors, only: error_t
    use lagrangia_integrator, only: dense_integrator_t, integrator_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_ledger, only: ledger_t
    use lagrangia_methods, only: new_adaptive, new_integrator
    use lagrangia_pendulum, only: pendulum_t
    use lagrangia_stress_rows, only: rows
    use lobatto_3b, only: energy_of, walk
    implicit none (type, external)
    private
    public :: stress_texts_suite

contains

    function stress_texts_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("stress_texts")
        call suite%addTest(TestMethod("reversal_alone_keeps_no_energy", &
                                      reversal_alone_keeps_no_energy))
        call suite%addTest(TestMethod("symplectic_steps_must_be_small", &
                                      symplectic_steps_must_be_small))
        call suite%addTest(TestMethod("a_sum_drops_half_a_unit_at_most", &
                                      a_sum_drops_half_a_unit_at_most))
        call suite%addTest(TestMethod("the_exponent_has_an_error", the_exponent_has_an_error))
        call suite%addTest(TestMethod("a_sum_of_powers_becomes_their_number", &
                                      a_sum_of_powers_becomes_their_number))
    end function stress_texts_suite

    subroutine a_sum_of_powers_becomes_their_number()
        !! \(1 + e + \dots + e^{n-1}\) as the text has it, \(1 - e = \delta = 10^{-6}\): five of
        !! them are \(5 - 10\delta\), but for \(10\delta^2\) and the rounding over \(\delta\).
        type(names_t) :: letters
        character(:), allocatable :: text
        real(dp), parameter :: e = 1.0_dp - 1e-6_dp
        real(dp) :: value, size_of
        logical :: ok

        text = trim(rows(findloc(rows%name == "elastic", .true., 1))%meaning)
        text = text(:index(text, " becomes n;") - 1)
        call letters%set("e", e)
        call letters%set("e^n", e**5)
        call formula_value(text, letters, value, size_of, ok)
        call assertTrue(ok, text)
        call assertEqual(5.0_dp - 1e-5_dp, value, 2e-9_dp, text)
    end subroutine a_sum_of_powers_becomes_their_number

    subroutine says(row, text)
        !! The row's meaning contains this.
        character(*), intent(in) :: row, text
        integer :: i

        i = findloc(rows%name == row, .true., 1)
        call assertGreaterThan(i, 0, message=row)
        if (i == 0) return
        call assertTrue(index(rows(i)%meaning, text) > 0, row//": "//text)
        call assertLessThan(len_trim(rows(i)%meaning), len(rows(i)%meaning), message=row)
    end subroutine says

    subroutine reversal_alone_keeps_no_energy()
        !! 40,000 steps of Lobatto IIIB over the top of a pendulum with an uneven potential come
        !! back to their start, and have lost 0.0247 of the energy meanwhile; with an even one the
        !! orbit is its own mirror image, and so is one that swings: what they lose is the energy's
        !! oscillation, of order dt^4. (0.0247: the same in another language; Faou, Hairer & Pham,
        !! BIT 44, 699 (2004), have this example.)
        real(dp), parameter :: dt = 0.2_dp
        real(dp), parameter :: over(2) = [0.0_dp, 2.5_dp], swinging(2) = [0.0_dp, 1.0_dp]
        integer, parameter :: steps = 40000
        real(dp) :: y(2), way

        call says("reversal", "on an orbit that is its own mirror image in time; on others it may")
        y = over
        call walk(y, 0.2_dp, dt, steps)
        call assertEqual(-0.0247_dp, energy_of(y, 0.2_dp) - energy_of(over, 0.2_dp), 5e-4_dp, &
                         "lost")
        way = abs(y(1))
        call walk(y, 0.2_dp, -dt, steps)
        ! The last digit of the way changes the force, and so each step the velocity by up to
        ! eps/2 |q| dt, which runs on for the time that is left; by chance, as the root of the
        ! steps. Forty starts beside this one, by four sets of flags, need up to 0.3 of this.
        call assertLessThan(maxval(abs(y - over)), &
                            sqrt(2.0_dp*steps)*(epsilon(dt)*way*dt)*(2*steps*dt), &
                            message="reversed")
        y = over
        call walk(y, 0.0_dp, dt, steps)
        call assertLessThan(abs(energy_of(y, 0.0_dp) - energy_of(over, 0.0_dp)), dt**4, &
                            message="even")
        y = swinging
        call walk(y, 0.2_dp, dt, steps)
        call assertLessThan(abs(energy_of(y, 0.2_dp) - energy_of(swinging, 0.2_dp)), 0.1_dp*dt**4, &
                            message="swinging")
    end subroutine reversal_alone_keeps_no_energy

    subroutine symplectic_steps_must_be_small()
        !! Verlet on a pendulum released from 2 rad, 10^5 steps: at omega dt = 0.1 the energy stays
        !! within its oscillation; at 1.8, still below the limit of small oscillations, it wanders.
        class(integrator_t), allocatable :: method
        type(pendulum_t) :: system
        type(error_t), allocatable :: error

        call says("energy_growth", "for exponentially long, if steps are small")
        call system%configure([1.0_dp, 1.0_dp, 1.0_dp], error)
        call new_integrator("verlet", method, error)
        call method%prepare(system, error)
        call assertTrue(.not. allocated(error), "verlet")
        call assertLessThan(worst(0.1_dp), 0.01_dp, message="small steps")
        call assertGreaterThan(worst(1.8_dp), 1.0_dp, message="long steps")
    contains
        function worst(dt)
            real(dp), intent(in) :: dt
            real(dp) :: worst, q(1), v(1), start
            integer(i8) :: k

            q = 2.0_dp
            v = 0.0_dp
            call method%start(system, 0.0_dp, q, v)
            start = system%energy(0.0_dp, q, v)
            worst = 0.0_dp
            do k = 0, 99999
                call method%advance(system, 0.0_dp, dt, k, 1_i8, q, v)
                worst = max(worst, abs(system%energy(0.0_dp, q, v) - start))
            end do
        end function worst
    end subroutine symplectic_steps_must_be_small

    subroutine a_sum_drops_half_a_unit_at_most()
        !! What is lost is found exactly (Knuth's two-sum). The terms are numbers in memory: with
        !! FMA the product in `b` would go into the sum unrounded, which is then no sum of a and b.
        real(dp), volatile :: a, b
        real(dp) :: s, lost, worst
        integer :: k

        call says("rounding", "by half a unit in the last place at most")
        worst = 0.0_dp
        do k = 1, 10000
            a = sin(real(k, dp))
            b = 0.1_dp*cos(1.7_dp*k)
            s = a + b
            lost = (a - (s - (s - a))) + (b - (s - a))
            worst = max(worst, abs(lost)/spacing(s))
        end do
        call assertTrue(worst <= 0.5_dp, "half a unit")
        call assertGreaterThan(worst, 0.49_dp, message="and so much it may be")
    end subroutine a_sum_drops_half_a_unit_at_most

    subroutine the_exponent_has_an_error()
        !! 1.087 per second came out over 3,000 s of another build; what is stated from windows of
        !! 40 s agrees within four of its errors, and the error is no larger than a tenth.
        class(dense_integrator_t), allocatable :: method, other
        type(double_pendulum_t) :: system
        type(error_t), allocatable :: error
        type(ledger_t) :: verdicts
        real(dp) :: uncertain

        call new_adaptive("gauss16", method)
        call new_adaptive("dop853", other)
        call system%configure([1.0_dp, 1.0_dp, 1.0_dp, 1.0_dp, 9.81_dp], error)
        call verdicts%section("chaos")
        call stress_chaos(system, method, other, 40.0_dp, verdicts)
        associate (remark => verdicts%rows(1)%remark)
            call assertEqual("+- ", remark(:3))
            call assertGreaterThan(index(remark, "from 16 windows of 40.0 s"), 0, message=remark)
            read (remark(4:), *) uncertain
            call assertLessThan(len_trim(remark), len(remark), message=remark)
        end associate
        call assertLessThan(uncertain, 0.1_dp)
        call assertEqual(1.087_dp, verdicts%rows(1)%value, 4.0_dp*uncertain, "exponent")
    end subroutine the_exponent_has_an_error
end module test_stress_texts
