module test_audit
    !! The audit finds every slip that was planted, and says where; and nothing where there is none.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertFalse, assertTrue
    use lagrangia_audit, only: audit_system, draws
    use lagrangia_catalogue, only: new_system
    use lagrangia_description, only: description_t
    use lagrangia_diagnosis, only: factor_text
    use lagrangia_errors, only: error_t
    use lagrangia_findings, only: audit_t
    use lagrangia_kinds, only: dp
    use lagrangia_system, only: system_t
    use liars, only: liars_known, new_liar
    use mutants, only: mutants_known, new_mutant
    implicit none (type, external)
    private
    public :: audit_suite

contains

    function audit_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("audit")
        call suite%addTest(TestMethod("wrong_equations_are_named", wrong_equations_are_named))
        call suite%addTest(TestMethod("factors_of_zero_have_no_sign", factors_of_zero_have_no_sign))
        call suite%addTest(TestMethod("wrong_claims_are_named", wrong_claims_are_named))
        call suite%addTest(TestMethod("given_parameters_stay", given_parameters_stay))
        call suite%addTest(TestMethod("findings_keep_the_worst", findings_keep_the_worst))
    end function audit_suite

    subroutine wrong_equations_are_named()
        !! Each with its coordinate and, where one term explains it, that term; also without energy
        !! being any the worse.
        class(system_t), allocatable :: system
        character(:), allocatable :: expected
        type(audit_t) :: audit
        integer :: k, row

        do k = 1, mutants_known
            audit = audit_t()
            call new_mutant(k, system, expected)
            call audit_system(system, audit)
            row = audit%row_of("accelerations as from L")
            call assertFalse(audit%findings(row)%holds, expected)
            call assertEqual(expected, audit%findings(row)%remark(:len(expected)))
            row = audit%row_of("Gauss's least constraint")
            call assertFalse(audit%findings(row)%holds, "Gauss: "//expected)
            row = audit%row_of("energy is v dL/dv - L")
            call assertTrue(audit%findings(row)%holds, "energy: "//expected)
        end do
    end subroutine wrong_equations_are_named

    subroutine factors_of_zero_have_no_sign()
        !! Whichever way the rounding of 1 - 1 falls; a half and a whole number keep theirs.
        class(system_t), allocatable :: system
        type(description_t) :: d
        type(error_t), allocatable :: error

        call new_system("pendulum", system, error)
        call system%describe(d)
        call assertEqual("0", factor_text(epsilon(1.0_dp), d), "a little above")
        call assertEqual("0", factor_text(-epsilon(1.0_dp), d), "a little below")
        call assertEqual("-1", factor_text(-1.0_dp, d), "a wrong sign")
        call assertEqual("-0.5", factor_text(-0.5_dp, d), "half, with a wrong sign")
    end subroutine factors_of_zero_have_no_sign

    subroutine wrong_claims_are_named()
        !! The very claim fails, and those that have nothing to do with it hold.
        class(system_t), allocatable :: system
        character(:), allocatable :: expected, unharmed
        type(audit_t) :: audit
        integer :: k, row

        do k = 1, liars_known
            audit = audit_t()
            call new_liar(k, system, expected, unharmed)
            call audit_system(system, audit)
            row = audit%row_of(expected)
            call assertTrue(row > 0, expected//": claim")
            if (anyExceptions()) return
            call assertFalse(audit%findings(row)%holds, expected)
            row = audit%row_of(unharmed)
            call assertTrue(row > 0, unharmed//": claim")
            if (anyExceptions()) return
            call assertTrue(audit%findings(row)%holds, unharmed//", although not "//expected)
        end do
    end subroutine wrong_claims_are_named

    subroutine given_parameters_stay()
        !! With g = 0 in all draws the pendulum's angular momentum is conserved in all of them.
        class(system_t), allocatable :: system
        type(error_t), allocatable :: error
        type(audit_t) :: audit
        integer :: row

        call new_system("pendulum", system, error)
        call audit_system(system, audit, [.false., .false., .true.], [1.0_dp, 1.0_dp, 0.0_dp])
        call assertEqual(0, audit%broken())
        row = audit%row_of("L_z is conserved")
        call assertTrue(row > 0)
        if (anyExceptions()) return
        call assertEqual(draws, audit%findings(row)%states)
    end subroutine given_parameters_stay

    subroutine findings_keep_the_worst()
        !! Beside the noise; NaN is the worst of all.
        type(audit_t) :: audit
        real(dp) :: nan

        nan = 0.0_dp
        nan = nan/nan
        call audit%begin("here")
        call audit%judge("claim", 1.0_dp, 1.0_dp, 10.0_dp)
        call audit%judge("claim", 5.0_dp, 10.0_dp, 10.0_dp)
        call audit%judge("claim", 0.3_dp, 0.1_dp, 10.0_dp)
        call audit%judge("claim", 0.1_dp, 0.1_dp, 10.0_dp)
        call assertEqual(0, audit%broken())
        call assertEqual(0.3_dp, audit%findings(1)%worst)
        call assertEqual(1.0_dp, audit%findings(1)%bound)
        call assertEqual(4, audit%findings(1)%states)
        call audit%judge("claim", nan, 1.0_dp, 10.0_dp)
        call assertEqual(1, audit%broken())
        call audit%judge("claim", 0.1_dp, 0.1_dp, 10.0_dp)
        call assertTrue(ieee_is_nan(audit%findings(1)%worst))
        call audit%begin("there")
        call audit%judge("claim", 2.0_dp, 1.0_dp, 1.0_dp)
        call assertEqual(2, size(audit%findings))
        call assertEqual(2, audit%broken())
        call audit%say("claim", "first")
        call audit%say("claim", "second")
        call assertEqual("first", trim(audit%findings(2)%remark))
        call assertEqual("", trim(audit%findings(1)%remark))
    end subroutine findings_keep_the_worst
end module test_audit
