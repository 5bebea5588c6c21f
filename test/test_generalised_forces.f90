module test_generalised_forces
    !! Forces beside L are in the equations of motion, the energy balance and the structure.
    use dragged_systems, only: dragged_cart_t, slipped_cart_t
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertTrue
    use lagrangia_audit, only: audit_system
    use lagrangia_errors, only: error_t
    use lagrangia_generalised_forces, only: momentum_rates
    use lagrangia_kinds, only: dp
    use lagrangia_lagrange, only: energy_rate
    use lagrangia_ledger, only: ledger_t
    implicit none (type, external)
    private
    public :: generalised_forces_suite

contains

    function generalised_forces_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("generalised_forces")
        call suite%addTest(TestMethod("they_accelerate", they_accelerate))
        call suite%addTest(TestMethod("structure_knows_of_them", structure_knows_of_them))
        call suite%addTest(TestMethod("they_change_the_energy", they_change_the_energy))
        call suite%addTest(TestMethod("slips_are_named", slips_are_named))
    end function generalised_forces_suite

    subroutine they_accelerate()
        !! With \(M = m(2, c; c, 1)\), \(c = \cos\theta\), solved by hand.
        type(dragged_cart_t) :: cart
        type(error_t), allocatable :: error
        real(dp), parameter :: m = 1.3_dp, b = 0.7_dp, k = 0.4_dp, t = 0.9_dp
        real(dp), parameter :: q(2) = [0.2_dp, 0.6_dp], v(2) = [0.5_dp, -1.1_dp]
        real(dp) :: a(2), right(2), c, s

        call cart%configure([m, b, k], error)
        call cart%accelerations(t, q, v, a)
        c = cos(q(2))
        s = sin(q(2))
        right = [m*v(2)**2*s - b*v(1), -m*9.81_dp*s + k*cos(t)]
        call assertEqual((right(1) - c*right(2))/(m*(2.0_dp - c**2)), a(1), 1e-14_dp, "x_ddot")
        call assertEqual((2.0_dp*right(2) - c*right(1))/(m*(2.0_dp - c**2)), a(2), 1e-13_dp, &
                         "theta_ddot")
    end subroutine they_accelerate

    subroutine structure_knows_of_them()
        !! The cart alone is cyclic in L; with drag its momentum is not conserved.
        type(dragged_cart_t) :: cart
        type(error_t), allocatable :: error

        call cart%configure([1.3_dp, 0.0_dp, 0.0_dp], error)
        call assertFalse(cart%nonconservative, "no force")
        call assertFalse(cart%time_dependent, "no motor")
        call assertTrue(cart%conserves_energy(), "energy without forces")
        call assertEqual(1, cart%cyclic, "x without drag")
        call cart%configure([1.3_dp, 0.7_dp, 0.0_dp], error)
        call assertTrue(cart%nonconservative, "drag")
        call assertFalse(cart%time_dependent, "drag without motor")
        call assertFalse(cart%conserves_energy(), "energy with drag")
        call assertEqual(0, cart%cyclic, "x with drag")
        call cart%configure([1.3_dp, 0.0_dp, 0.4_dp], error)
        call assertTrue(cart%time_dependent, "motor")
        call assertFalse(cart%conserves_energy(), "energy with a motor")
        call assertEqual(1, cart%cyclic, "x without drag, with a motor")
    end subroutine structure_knows_of_them

    subroutine they_change_the_energy()
        !! \(\dot E = \sum_j Q_j\dot q_j\).
        type(dragged_cart_t) :: cart
        type(error_t), allocatable :: error
        real(dp), parameter :: b = 0.7_dp, k = 0.4_dp, t = 0.9_dp
        real(dp), parameter :: q(2) = [0.2_dp, 0.6_dp], v(2) = [0.5_dp, -1.1_dp]
        real(dp) :: p_dot(2), f(2)

        call cart%configure([1.3_dp, b, k], error)
        call assertEqual(-b*v(1)**2 + k*cos(t)*v(2), energy_rate(cart, t, q, v), 1e-15_dp, "power")
        call cart%forces(t, q, v, f)
        call momentum_rates(cart, t, q, v, p_dot)
        call assertEqual([-b*v(1), k*cos(t)], p_dot - f, 1e-14_dp, "Q")
    end subroutine they_change_the_energy

    subroutine slips_are_named()
        !! What is right passes, each slip fails the claim that it is about.
        character(*), parameter :: accelerations = "accelerations as from L"
        type(ledger_t) :: audit
        type(slipped_cart_t) :: cart

        call audit_system(cart, audit)
        call assertEqual(0, audit%broken(), "no slip")
        call assertTrue(audit%row_of("energy changes by Q v - dL/dt") > 0, "energy is judged")
        call expect(1, "nonconservative says what is true", "nonconservative is false, yet there")
        call expect(2, "velocity_forces says what is true", "velocity_forces is false, yet the")
        call expect(3, "time_dependent says what is true", "time_dependent is false, yet the acc")
        call expect(4, "the cyclic coordinate is cyclic", "a generalised force acts on x")
        call expect(5, accelerations, &
                    "the equation of x is not that of L: its generalised force counts 2 times")
    contains
        subroutine expect(slip, claim, remark)
            integer, intent(in) :: slip
            character(*), intent(in) :: claim, remark
            integer :: row

            cart%slip = slip
            audit = ledger_t()
            call audit_system(cart, audit)
            row = audit%row_of(claim)
            call assertTrue(row > 0, claim//" is judged")
            if (row == 0) return
            call assertFalse(audit%rows(row)%holds, claim)
            call assertEqual(remark, audit%rows(row)%remark(:min(len(remark), &
                             len(audit%rows(row)%remark))), claim)
        end subroutine expect
    end subroutine slips_are_named
end module test_generalised_forces
