module test_audit_formulas
    !! The audit reads every printed formula, and sees a slip in each: a sign, a factor, a letter.
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertGreaterThan, assertTrue
    use lagrangia_audit_closed_forms, only: audit_closed_forms
    use lagrangia_audit_formulas, only: audit_formulas
    use lagrangia_catalogue, only: new_system, system_names
    use lagrangia_description, only: default_values, description_t
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp
    use lagrangia_ledger, only: ledger_t
    use lagrangia_random_draws, only: random_t
    use lagrangia_system, only: system_t
    use lagrangia_term_sizes, only: motion_t, nearby_t, new_nearby, solve_motion
    use misprints, only: change_formula, formula_at, kinds_of_slips, last_place, misprint_t, &
                         new_misprint
    implicit none (type, external)
    private
    public :: audit_formulas_suite

    integer, parameter :: draws = 3

    type :: draw_t
        !! Parameters and a state.
        real(dp), allocatable :: values(:), q(:), v(:)
        real(dp) :: t = 0.0_dp
    end type draw_t

contains

    function audit_formulas_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("audit_formulas")
        call suite%addTest(TestMethod("a_slip_in_any_formula_is_seen", &
                                      a_slip_in_any_formula_is_seen))
        call suite%addTest(TestMethod("what_cannot_be_read_fails", what_cannot_be_read_fails))
        call suite%addTest(TestMethod("a_start_is_as_exact_as_its_place", &
                                      a_start_is_as_exact_as_its_place))
        call suite%addTest(TestMethod("every_formula_is_tried", every_formula_is_tried))
    end function audit_formulas_suite

    subroutine a_slip_in_any_formula_is_seen()
        !! In every formula of every system; those that are listed change nothing: zero has no sign,
        !! and a root no side.
        character(32), allocatable :: names(:)
        class(system_t), allocatable :: system
        type(error_t), allocatable :: error
        type(draw_t) :: drawn(draws)
        character(:), allocatable :: text, changed, unseen
        character, parameter :: next = new_line("a")
        character(*), parameter :: harmless = &
            next//"oscillator: drive_frequency | - drive_frequency"// &
            next//"oscillator: sqrt(k/m) | - sqrt(k/m)"// &
            next//"cart_pendulum: y_cart = 0 |  2 y_cart = 0"// &
            next//"wedge: y_wedge = 0 |  2 y_wedge = 0"// &
            next//"rolling_disk: i_yaw theta_ddot = 0 |  2 i_yaw theta_ddot = 0"// &
            next//"rolling_disk: i_yaw theta_ddot = 0 | g theta_ddot = 0"// &
            next//"driven_pendulum: drive_frequency | - drive_frequency"// &
            next//"driven_pendulum: drive_frequency | - drive_frequency"// &
            next//"bouncing_ball: y >= 0 | m >= 0"// &
            next//"bouncing_ball: lambda y = 0 |  2 lambda y = 0"
        integer :: i, place, slip, planted, way

        unseen = ""
        planted = 0
        allocate (names, source=system_names())
        do i = 1, size(names)
            call new_system(trim(names(i)), system, error)
            do way = 1, merge(2, 1, has_damping())
                call draw(system, drawn, undamped=way == 2)
                call assertFalse(sees(system, drawn, 1, 0), trim(names(i))//" as it is")
                do place = 1, last_place()
                    text = text_at(place)
                    if (text == "") cycle
                    do slip = 1, kinds_of_slips
                        changed = changed_at(text, slip)
                        if (changed == text) cycle
                        planted = planted + 1
                        if (.not. sees(system, drawn, place, slip)) unseen = unseen// &
                            new_line("a")//trim(names(i))//": "//text//" | "//changed
                    end do
                end do
            end do
        end do
        call assertEqual(989, planted, message="slips are planted")
        call assertEqual(harmless, unseen)
    contains
        logical function has_damping()
            type(description_t) :: d

            call system%describe(d)
            has_damping = any(d%parameters%name == "b")
        end function has_damping

        function text_at(which) result(formula)
            integer, intent(in) :: which
            character(:), allocatable :: formula
            type(description_t) :: d

            call system%describe(d)
            formula = formula_at(d, which)
        end function text_at

        function changed_at(formula, kind) result(other)
            character(*), intent(in) :: formula
            integer, intent(in) :: kind
            character(:), allocatable :: other
            type(description_t) :: d

            call system%describe(d)
            other = change_formula(d, formula, kind)
        end function changed_at
    end subroutine a_slip_in_any_formula_is_seen

    subroutine draw(system, drawn, undamped)
        !! Off the edges of all domains, three bobs in a chain; or without forces beside L.
        class(system_t), intent(inout) :: system
        type(draw_t), intent(out) :: drawn(:)
        logical, intent(in), optional :: undamped
        logical, allocatable :: zero(:)
        type(description_t) :: d
        type(error_t), allocatable :: error
        type(random_t) :: random
        integer :: i, k

        call system%describe(d)
        do k = 1, size(drawn)
            if (d%name == "hanging_chain") then
                call random%parameters(system, .false., drawn(k)%values, error, &
                                       [.true., .false., .false., .false.], &
                                       [3.0_dp, 1.0_dp, 1.0_dp, 1.0_dp])
            else
                zero = [(.false., i=1, size(default_values(d)))]
                if (present(undamped)) then
                    if (undamped) zero = d%parameters%name == "b" .or. &
                                         d%parameters%name == "drive_force"
                end if
                call random%parameters(system, .false., drawn(k)%values, error, zero, &
                                       [(0.0_dp, i=1, size(zero))])
            end if
            call random%state(system, drawn(k)%t, drawn(k)%q, drawn(k)%v, error)
            if (d%name == "bouncing_ball") drawn(k)%q = abs(drawn(k)%q)
        end do
    end subroutine draw

    logical function sees(system, drawn, place, slip)
        !! Whether a row fails in one of the draws.
        class(system_t), intent(in) :: system
        type(draw_t), intent(in) :: drawn(:)
        integer, intent(in) :: place, slip
        type(misprint_t) :: misprint
        type(ledger_t) :: audit
        integer :: k

        call new_misprint(system, place, slip, misprint)
        call audit%section("misprint")
        do k = 1, size(drawn)
            call audit_draw(misprint, drawn(k), audit)
            sees = audit%broken() > 0
            if (sees) return
        end do
    end function sees

    subroutine audit_draw(system, drawn, audit)
        !! The rows of one state.
        class(system_t), intent(inout) :: system
        type(draw_t), intent(in) :: drawn
        type(ledger_t), intent(inout) :: audit
        type(nearby_t) :: nearby
        type(motion_t) :: motion
        type(error_t), allocatable :: error
        logical :: resolved

        resolved = .true.
        call system%configure(drawn%values, error)
        call assertFalse(allocated(error), "configured")
        call new_nearby(nearby, system, drawn%values, drawn%t, drawn%q, drawn%v)
        call solve_motion(nearby, motion, error)
        call assertFalse(allocated(error), "solved")
        call audit_formulas(audit, nearby, motion, .true.)
        call audit_closed_forms(audit, nearby, .false., resolved)
        call assertTrue(resolved, "resolved")
    end subroutine audit_draw

    subroutine what_cannot_be_read_fails()
        !! And says why. An equation that says nothing of the motion fails, too.
        call fails("pendulum", 3, "m/2 l^2 theta dot^2", "L as printed", "column")
        call fails("pendulum", 5, "l theta_ddot + g sin(theta)", "equations as printed", "'='")
        call fails("pendulum", 5, "m l = l m", "equations hold for no other motion", &
                   "an equation has no acceleration")
        call fails("double_pendulum", 5, "l2 theta2_ddot + l1 theta1_ddot cos(D) "// &
                   "- l1 theta1_dot^2 sin(D) + g sin(theta2) = 0", "", "")
        call fails("cart_pendulum", 5, "l theta_ddot = l theta_ddot", &
                   "equations hold for no other motion", "an equation has no acceleration")
        call fails("double_pendulum", 505, "theta1 - theta3", "letters as printed", "theta3")
        call fails("pendulum", 605, "omega^2 = g/l about", "frequencies as printed", "about")
        call fails("oscillator", 705, "x = x_0 + v_0 t", "closed form as printed", "v_0")
    contains
        subroutine fails(name, place, text, claim, why)
            character(*), intent(in) :: name, text, claim, why
            integer, intent(in) :: place
            class(system_t), allocatable :: system
            type(error_t), allocatable :: error
            type(misprint_t) :: misprint
            type(draw_t) :: drawn(1)
            type(ledger_t) :: audit
            integer :: row

            call new_system(name, system, error)
            call draw(system, drawn, undamped=.true.)
            call new_misprint(system, place, 0, misprint)
            misprint%instead = text
            call audit%section("misprint")
            call audit_draw(misprint, drawn(1), audit)
            if (claim == "") then
                call assertEqual(0, audit%broken(), text)
                return
            end if
            row = audit%row_of(claim)
            call assertGreaterThan(row, 0, message=claim//": "//text)
            if (row == 0) return
            call assertFalse(audit%rows(row)%holds, text)
            call assertTrue(index(audit%rows(row)%remark, why) > 0, audit%rows(row)%remark)
        end subroutine fails
    end subroutine what_cannot_be_read_fails

    subroutine a_start_is_as_exact_as_its_place()
        !! However fast the motion is that begins there: omega = 10^6/s.
        call assertTrue(holds("x_0"), "as it is")
        call assertFalse(holds("(1 + 1e-9) x_0"), "off by 10^-9")
    contains
        logical function holds(start)
            character(*), intent(in) :: start  !! that the motion has
            type(misprint_t) :: misprint
            class(system_t), allocatable :: system
            type(error_t), allocatable :: error
            type(draw_t) :: drawn
            type(ledger_t) :: audit

            call new_system("oscillator", system, error)
            drawn%values = [2.0_dp, 2e12_dp, 0.0_dp, 0.0_dp, 0.0_dp]
            drawn%t = 1e-6_dp
            drawn%q = [0.7_dp]
            drawn%v = [0.3_dp]
            call new_misprint(system, 705, 0, misprint)
            misprint%instead = "x = "//start//" cos(omega t) + x_dot_0/omega sin(omega t)"
            call audit%section("misprint")
            call audit_draw(misprint, drawn, audit)
            holds = audit%rows(audit%row_of("closed form as printed"))%holds
        end function holds
    end subroutine a_start_is_as_exact_as_its_place

    subroutine every_formula_is_tried()
        !! The rows of each system's audit that say what is printed, and no others.
        call rows("oscillator", "T V L energy equations force p_x closed_form frequencies", .true.)
        call rows("oscillator", "T V L energy generalised forces R equations force p_x")
        call rows("cart_pendulum", "T V L energy equations accelerations constraints p_x x_com "// &
                  "tension track_force, tension, frequencies")
        call rows("rolling_disk", "T V L energy equations accelerations constraints p_theta "// &
                  "p_phi roll_yaw orbit_x orbit_y slip_x slip_y friction_x friction_y p_x p_y "// &
                  "plane_force, friction_x, friction_y,")
        call rows("bouncing_ball", "T V L energy equations constraints contact_force")
    contains
        subroutine rows(name, expected, undamped)
            character(*), intent(in) :: name, expected
            logical, intent(in), optional :: undamped
            class(system_t), allocatable :: system
            type(error_t), allocatable :: error
            type(draw_t) :: drawn(1)
            type(ledger_t) :: audit
            character(:), allocatable :: found, claim
            integer :: i

            call new_system(name, system, error)
            call draw(system, drawn, undamped)
            call audit%section(name)
            call audit_draw(system, drawn(1), audit)
            found = ""
            do i = 1, size(audit%rows)
                claim = trim(audit%rows(i)%name)
                if (index(claim, " as printed") == 0) cycle
                claim = claim(:index(claim, " as printed") - 1)
                if (index(claim, "what holds ") == 1) claim = claim(12:)
                if (claim == "closed form") claim = "closed_form"
                found = found//" "//claim
            end do
            call assertEqual(expected, found(2:), name)
        end subroutine rows
    end subroutine every_formula_is_tried
end module test_audit_formulas
