module test_audit
    !! The audit finds every slip that was planted, and says where; and nothing where there is none.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
    use biased_liars, only: biased_claims, new_biased_liar
    use extremes, only: audit_at_random, coordinate_of, differs, show_parameters
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertFalse, assertTrue
    use lagrangia_audit, only: audit_system, draws
    use lagrangia_audit_newton, only: say_reactions
    use lagrangia_audit_structure, only: audit_flags
    use lagrangia_catalogue, only: new_system, system_names
    use lagrangia_description, only: description_t, name_length
    use lagrangia_diagnosis, only: factor_text
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp
    use lagrangia_lagrangian_system, only: lagrangian_system_t
    use lagrangia_ledger, only: ledger_t
    use lagrangia_random_draws, only: random_t
    use lagrangia_scene, only: scene_t
    use lagrangia_scene_reader, only: parse_scene
    use lagrangia_system, only: system_t
    use lagrangia_text, only: word_t
    use liars, only: liars_known, new_liar
    use mutants, only: mutants_known, new_mutant
    use test_audit_states, only: audit_states_suite
    use turned_flags, only: new_turned
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
        call suite%addTest(TestMethod("claims_are_judged_from_both_sides", &
                                      claims_are_judged_from_both_sides))
        call suite%addTest(TestMethod("every_claim_has_its_liars", every_claim_has_its_liars))
        call suite%addTest(TestMethod("flags_are_judged_both_ways", flags_are_judged_both_ways))
        call suite%addTest(TestMethod("no_false_alarm_over_twelve_decades", &
                                      no_false_alarm_over_twelve_decades))
        call suite%addTest(TestMethod("slips_are_named_over_twelve_decades", &
                                      slips_are_named_over_twelve_decades))
        call suite%addTest(TestMethod("given_parameters_stay", given_parameters_stay))
        call suite%addTest(TestMethod("findings_keep_the_worst", findings_keep_the_worst))
        call suite%addTest(TestMethod("reactions_are_said_by_name", reactions_are_said_by_name))
        call suite%addTest(TestMethod("forces_that_are_mostly_zero_act", &
                                      forces_that_are_mostly_zero_act))
        call suite%addTest(audit_states_suite())
    end function audit_suite

    subroutine wrong_equations_are_named()
        !! Each with its coordinate and, where one term explains it, that term; also without energy
        !! being any the worse.
        class(system_t), allocatable :: system
        character(:), allocatable :: expected
        type(ledger_t) :: audit
        integer :: k, row

        do k = 1, mutants_known
            audit = ledger_t()
            call new_mutant(k, system, expected)
            call audit_system(system, audit)
            row = audit%row_of("accelerations as from L")
            call assertFalse(audit%rows(row)%holds, expected)
            call assertEqual(expected, audit%rows(row)%remark(:len(expected)))
            row = audit%row_of("Gauss's least constraint")
            call assertFalse(audit%rows(row)%holds, "Gauss: "//expected)
            call assertTrue(names_what_moves(audit%rows(row)%remark, system), &
                            "Gauss: "//audit%rows(row)%remark)
            row = audit%row_of("energy is v dL/dv - L")
            call assertTrue(audit%rows(row)%holds, "energy: "//expected)
        end do
    end subroutine wrong_equations_are_named

    function names_what_moves(remark, system) result(yes)
        !! Whether it says of a point of the system along an axis, or of something that turns, that
        !! its accelerations are not those of least constraint.
        character(*), intent(in) :: remark
        class(system_t), intent(in) :: system
        logical :: yes
        character(*), parameter :: first = "the accelerations of "
        character(*), parameter :: last = " are not those of least constraint", axes = "xyz"
        type(description_t) :: d
        integer :: i, k

        yes = .false.
        call system%describe(d)
        do i = 1, size(d%points)
            do k = 1, 3
                if (remark /= first//trim(d%points(i)%name)//" along "//axes(k:k)//last) cycle
                yes = .true.
            end do
        end do
        if (.not. allocated(d%rotors)) return
        do i = 1, size(d%rotors)
            if (remark == first//trim(d%rotors(i)%name)//last) yes = .true.
        end do
    end function names_what_moves

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
        call system%configure([7.1_dp, 3.3_dp, 9.81_dp, 0.3_dp], error)
        call system%describe(d)
        call assertEqual("l^2", factor_text(3.3_dp**2, d), "a square")
        call assertEqual("1/l", factor_text(1.0_dp/3.3_dp, d), "a parameter below")
        call assertEqual("1/l^2", factor_text(1.0_dp/3.3_dp**2, d), "its square")
        call assertEqual("m/l", factor_text(7.1_dp/3.3_dp, d), "a quotient")
    end subroutine factors_of_zero_have_no_sign

    subroutine wrong_claims_are_named()
        !! The very claim fails, and those that have nothing to do with it hold.
        class(system_t), allocatable :: system
        character(:), allocatable :: expected, unharmed
        type(ledger_t) :: audit
        integer :: k, row

        do k = 1, liars_known
            audit = ledger_t()
            call new_liar(k, system, expected, unharmed)
            call audit_system(system, audit)
            row = audit%row_of(expected)
            call assertTrue(row > 0, expected//": claim")
            if (anyExceptions()) return
            call assertFalse(audit%rows(row)%holds, expected)
            call assertEqual(remark_of(k), audit%rows(row)%remark(:len(remark_of(k))), expected)
            row = audit%row_of(unharmed)
            call assertTrue(row > 0, unharmed//": claim")
            if (anyExceptions()) return
            call assertTrue(audit%rows(row)%holds, unharmed//", although not "//expected)
        end do
    end subroutine wrong_claims_are_named

    pure function remark_of(k) result(text)
        !! How the remark on liar `k` begins; nothing where none is made.
        integer, intent(in) :: k
        character(:), allocatable :: text

        select case (k)
        case (1); text = "velocity_forces is false, yet the"
        case (2); text = "time_dependent is true, yet L has no"
        case (3); text = "L depends on theta"
        case (9); text = "the accelerations of bob along y are not those of least constraint"
        case (17); text = "linear system: the matrix is singular"
        case default; text = ""
        end select
    end function remark_of

    subroutine claims_are_judged_from_both_sides()
        !! 1e-11 too much, and too little, at every state; 1e-9 where the claim is on a difference.
        class(system_t), allocatable :: system
        character(:), allocatable :: claim
        type(ledger_t) :: audit
        integer :: k, way, row

        do k = 1, biased_claims
            do way = -1, 1, 2
                audit = ledger_t()
                if (allocated(system)) deallocate (system)
                call new_biased_liar(k, way, system, claim)
                call audit_system(system, audit)
                row = audit%row_of(claim)
                call assertTrue(row > 0, claim//": claim")
                if (row == 0) cycle
                call assertFalse(audit%rows(row)%holds, &
                                 claim//trim(merge(": above", ": below", way > 0)))
            end do
        end do
    end subroutine claims_are_judged_from_both_sides

    subroutine every_claim_has_its_liars()
        !! No claim that the audit makes of any system is without one, up to whose it is.
        class(system_t), allocatable :: system
        type(error_t), allocatable :: error
        character(:), allocatable :: claim
        character(32), allocatable :: names(:)
        type(ledger_t) :: audit
        integer :: i, k, row
        logical :: covered

        allocate (names, source=system_names())
        do i = 1, size(names)
            call new_system(trim(names(i)), system, error)
            call audit_system(system, audit)
        end do
        do row = 1, size(audit%rows)
            associate (asked => audit%rows(row)%name)
                covered = index(asked, "says what is true") > 0  ! flags_are_judged_both_ways
                covered = covered .or. index(asked, " as printed") > 0 .or. &
                          asked == "equations hold for no other motion"  ! audit_formulas
                do k = 1, biased_claims
                    call new_biased_liar(k, 1, system, claim)
                    covered = covered .or. asked == claim .or. &
                              (index(asked, " is conserved") > 0 .and. &
                               index(claim, " is conserved") > 0) .or. &
                              (asked(:8) == "Gauss's " .and. claim == "Gauss's tension")
                end do
                call assertTrue(covered, trim(asked)//" has its liars")
            end associate
        end do
    end subroutine every_claim_has_its_liars

    subroutine flags_are_judged_both_ways()
        !! Said though it is not so, and not said though it is.
        character(*), parameter :: velocity = "velocity_forces says what is true"
        character(*), parameter :: time = "time_dependent says what is true"
        character(*), parameter :: cyclic = "the cyclic coordinate is cyclic"

        call expect("pendulum", "velocity_forces", velocity, "velocity_forces is true, yet no")
        call expect("cart_pendulum", "velocity_forces", velocity, &
                    "velocity_forces is false, yet the")
        call expect("pendulum", "time_dependent", time, "time_dependent is true, yet L has no")
        call expect("driven_pendulum", "time_dependent", time, &
                    "time_dependent is false, yet the acc")
        call expect("pendulum", "time in L", time, "time_dependent is false, yet L")
        call expect("pendulum", "cyclic", cyclic, "L depends on theta")
        call expect("pendulum", "cyclic 2", cyclic, "there is no coordinate of that number")
        call expect("pendulum", "cyclic -1", cyclic, "there is no coordinate of that number")
    contains
        subroutine expect(name, flag, claim, remark)
            character(*), intent(in) :: name, flag, claim, remark
            class(system_t), allocatable :: liar
            type(ledger_t) :: audit
            integer :: row

            call new_turned(name, flag, liar)
            call audit_system(liar, audit)
            row = audit%row_of(claim)
            call assertTrue(row > 0, name//": "//flag//" is judged")
            if (row == 0) return
            call assertFalse(audit%rows(row)%holds, name//": "//flag)
            call assertEqual(remark, audit%rows(row)%remark(:len(remark)), name//": "//flag)
        end subroutine expect
    end subroutine flags_are_judged_both_ways

    subroutine no_false_alarm_over_twelve_decades()
        !! `.ci/extremes` draws more of them.
        character(32), allocatable :: names(:)
        class(system_t), allocatable :: system
        type(error_t), allocatable :: error
        type(random_t) :: random
        type(ledger_t) :: audit
        real(dp), allocatable :: values(:)
        integer :: i, k

        allocate (names, source=system_names())
        do i = 1, size(names)
            do k = 1, 2
                call new_system(trim(names(i)), system, error)
                audit = ledger_t()
                call audit_at_random(system, random, audit, values)
                call assertEqual(0, audit%broken(), "check "//show_parameters(system, values))
            end do
        end do
    end subroutine no_false_alarm_over_twelve_decades

    subroutine slips_are_named_over_twelve_decades()
        !! Each mutant at parameters where it does something; `.ci/extremes` draws more of them.
        class(system_t), allocatable :: system
        character(:), allocatable :: expected
        type(random_t) :: random
        type(ledger_t) :: audit
        real(dp), allocatable :: values(:)
        real(dp) :: difference
        integer :: i, k, row, seen

        do i = 1, mutants_known
            seen = 0
            do k = 1, 30
                if (allocated(system)) deallocate (system)
                call new_mutant(i, system, expected)
                audit = ledger_t()
                call audit_at_random(system, random, audit, values)
                call differs(system, values, difference)
                if (.not. difference > 1e-6_dp) cycle
                seen = seen + 1
                row = audit%row_of("accelerations as from L")
                call assertFalse(audit%rows(row)%holds, show_parameters(system, values))
                call assertEqual(coordinate_of(expected), &
                                 coordinate_of(audit%rows(row)%remark), &
                                 show_parameters(system, values))
                if (seen == 1) exit
            end do
            call assertEqual(1, seen, expected//": sets at which it is a slip")
        end do
    end subroutine slips_are_named_over_twelve_decades

    subroutine given_parameters_stay()
        !! Without g and b in all draws the pendulum's angular momentum is conserved in all of them.
        class(system_t), allocatable :: system
        type(error_t), allocatable :: error
        type(ledger_t) :: audit
        integer :: row

        call new_system("pendulum", system, error)
        call audit_system(system, audit, [.false., .false., .true., .true.], &
                          [1.0_dp, 1.0_dp, 0.0_dp, 0.0_dp])
        call assertEqual(0, audit%broken())
        row = audit%row_of("L_z is conserved")
        call assertTrue(row > 0, "row > 0")
        if (anyExceptions()) return
        call assertEqual(draws, audit%rows(row)%states)
    end subroutine given_parameters_stay

    subroutine reactions_are_said_by_name()
        !! Of every system that has some: names, numbers to six decimals, a comma between two; the
        !! numbers are those of the quantities of the same names.
        character(*), parameter :: claim = "Gauss's least constraint"
        character(name_length), allocatable :: names(:)
        class(system_t), allocatable :: system
        type(ledger_t) :: audit
        type(description_t) :: d
        type(error_t), allocatable :: error
        character(:), allocatable :: said, expected
        real(dp), allocatable :: q(:), v(:)
        real(dp) :: number
        integer :: i, k, n, several, status

        allocate (names, source=system_names())
        several = 0
        do k = 1, size(names)
            call new_system(trim(names(k)), system, error)
            call system%describe(d)
            if (.not. allocated(d%reactions)) cycle
            if (size(d%reactions) > 1) several = several + 1
            q = spread(0.5_dp, 1, system%ndof)
            v = spread(1.0_dp, 1, system%ndof)
            call audit%section(names(k))
            call audit%try(claim, 0.0_dp, 1.0_dp, 1.0_dp)
            call say_reactions(audit, system, 0.0_dp, q, v)
            said = trim(audit%rows(audit%row_of(claim))%remark)
            if (size(d%reactions) == 0) then
                call assertEqual("", said, names(k))
                cycle
            end if
            call assertEqual("at q = 0.5, v = 1:", said(:min(18, len(said))), names(k))
            said = said(19:)
            do i = 1, size(d%reactions)
                expected = merge(", ", "  ", i > 1)
                expected = trim(expected)//" "//trim(d%reactions(i)%name)//" "
                call assertEqual(expected, said(:min(len(said), len(expected))), names(k))
                said = said(len(expected) + 1:)
                n = index(said, " N")
                read (said(:n), *, iostat=status) number
                call assertEqual(0, status, names(k)//said)
                said = said(n + 2:)
                do n = 1, size(d%quantities)
                    if (d%quantities(n)%name /= d%reactions(i)%name) cycle
                    call assertEqual(system%quantity(n, 0.0_dp, q, v), number, 0.6e-6_dp, &
                                     trim(names(k))//", "//d%reactions(i)%name)
                end do
            end do
            call assertEqual("", said, "behind the last of "//names(k))
        end do
        call assertEqual(7, several, "systems with several reactions")
    end subroutine reactions_are_said_by_name

    subroutine findings_keep_the_worst()
        !! Beside the noise; NaN is the worst of all.
        type(ledger_t) :: audit
        real(dp) :: nan

        nan = 0.0_dp
        nan = nan/nan
        call audit%section("here")
        call audit%try("claim", 1.0_dp, 1.0_dp, 10.0_dp)
        call audit%try("claim", 5.0_dp, 10.0_dp, 10.0_dp)
        call audit%try("claim", 0.3_dp, 0.1_dp, 10.0_dp)
        call audit%try("claim", 0.1_dp, 0.1_dp, 10.0_dp)
        call assertEqual(0, audit%broken())
        call assertEqual(0.3_dp, audit%rows(1)%value)
        call assertEqual(1.0_dp, audit%rows(1)%most)
        call assertEqual(4, audit%rows(1)%states)
        call audit%try("claim", nan, 1.0_dp, 10.0_dp)
        call assertEqual(1, audit%broken())
        call audit%try("claim", 0.1_dp, 0.1_dp, 10.0_dp)
        call assertTrue(ieee_is_nan(audit%rows(1)%value), &
                        "ieee_is_nan(audit%rows(1)%value)")
        call audit%section("there")
        call audit%try("claim", 2.0_dp, 1.0_dp, 1.0_dp)
        call assertEqual(2, size(audit%rows))
        call assertEqual(2, audit%broken())
        call audit%say("claim", "first")
        call audit%say("claim", "second")
        call assertEqual("first", trim(audit%rows(2)%remark))
        call assertEqual("", trim(audit%rows(1)%remark))
    end subroutine findings_keep_the_worst

    subroutine forces_that_are_mostly_zero_act()
        !! At one time, at one place; or they are the same at all velocities but the smallest. Each
        !! on one of two coordinates, whether formulas have told it or not.
        call judge("exp(-(15 t)^2)")
        call judge("exp(-(14 x)^2)")
        call judge("exp(-(1000 x)^2)")
        call judge("exp(-(1000 x_dot)^2 - (1000 (x - 0.6))^2 - (1000 (t - 5))^2)")
        call judge("-tanh(1000 x_dot)")
    contains
        subroutine judge(force)
            character(*), intent(in) :: force
            class(system_t), allocatable :: system
            type(error_t), allocatable :: error
            type(scene_t) :: scene
            type(word_t) :: none(0)
            type(ledger_t) :: audit

            call parse_scene("&scene system = 'o', dt = 1, duration = 1, q = 0.6, -0.8 / "// &
                             "&lagrangian coordinates = 'x', 'y', parameters = 'm', domain = "// &
                             "'m > 0', L = 'm/2 (x_dot^2 + y_dot^2) - m/2 (x^2 + y^2)', "// &
                             "Q_x = '"//force//"' / &o m = 1 /", "text", none, scene, system, error)
            call assertFalse(allocated(error), "read: "//force)
            if (allocated(error)) return
            call assertTrue(system%nonconservative, "it acts: "//force)
            call audit_system(system, audit)
            call assertEqual(0, audit%broken(), message="claims that do not hold: "//force)
            select type (system)
            class is (lagrangian_system_t)
                system%told_by_formulas = .false.
            end select
            call audit_flags(audit, system, 5.0_dp, [0.6_dp, -0.8_dp], [0.7_dp, 0.4_dp], 6.0_dp, &
                             [-0.3_dp, 0.9_dp], .false.)
            call assertEqual(0, audit%broken(), message="claims that nobody told: "//force)
        end subroutine judge
    end subroutine forces_that_are_mostly_zero_act
end module test_audit
