module test_errata_ledger
    !! What the ledger of the notes' slips says in plain letters: it reads as the lines that it
    !! quotes do, and what it derives holds on true motions.
    use formula, only: formula_value, names_t
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertTrue
    use lagrangia_atwood, only: atwood_t
    use lagrangia_cart_pendulum, only: cart_pendulum_t
    use lagrangia_errata_command, only: slip_report
    use lagrangia_errata_ledger, only: slip_t, slips_of_the_notes
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp
    use lagrangia_lecture_constraints, only: examples
    use lagrangia_ledger, only: claim_t
    use lagrangia_report, only: report_t
    use lagrangia_wedge, only: wedge_t
    implicit none (type, external)
    private
    public :: errata_ledger_suite

    real(dp), parameter :: m1 = 1.3_dp, m2 = 0.7_dp, l = 0.9_dp, g = 9.81_dp

contains

    function errata_ledger_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("errata_ledger")
        call suite%addTest(TestMethod("signs_are_those_of_the_quotes", &
                                      signs_are_those_of_the_quotes))
        call suite%addTest(TestMethod("derived_equations_hold", derived_equations_hold))
        call suite%addTest(TestMethod("derived_expressions_are_right", &
                                      derived_expressions_are_right))
        call suite%addTest(TestMethod("pages_name_what_they_compute", pages_name_what_they_compute))
    end function errata_ledger_suite

    function slip_of(id) result(slip)
        !! The slip of that name.
        character(*), intent(in) :: id
        type(slip_t) :: slip
        type(slip_t), allocatable :: slips(:)
        integer :: i

        allocate (slips, source=slips_of_the_notes())
        do i = 1, size(slips)
            if (slips(i)%id == id) slip = slips(i)
        end do
        call assertEqual(id, slip%id)
    end function slip_of

    pure function signs_of(text) result(signs)
        !! The signs between two terms, in their order; a difference in words is a minus.
        character(*), intent(in) :: text
        character(:), allocatable :: signs
        integer :: i

        signs = ""
        do i = 2, len(text) - 2
            if (text(i:i + 2) == " + ") signs = signs//"+"
            if (text(i:i + 2) == " - ") signs = signs//"-"
            if (index(text(i:), "difference between") == 1) signs = signs//"-"
        end do
    end function signs_of

    subroutine signs_are_those_of_the_quotes()
        !! Of all quotes of a slip, one behind the other, those that are read come first. Where only
        !! dots were lost, what is derived has them too.
        type(slip_t), allocatable :: slips(:)
        type(slip_t) :: lost
        character(:), allocatable :: quoted, read_signs
        integer :: i, k, total

        allocate (slips, source=slips_of_the_notes())
        total = 0
        read_signs = ""
        do i = 1, size(slips)
            quoted = ""
            do k = 1, size(slips(i)%quotes)
                quoted = quoted//signs_of(trim(slips(i)%quotes(k)%text))
            end do
            read_signs = signs_of(trim(slips(i)%reads))
            total = total + len(read_signs)
            call assertTrue(len(read_signs) <= len(quoted), slips(i)%id//read_signs//quoted)
            if (len(read_signs) > len(quoted)) cycle
            call assertEqual(quoted(:len(read_signs)), read_signs, slips(i)%id)
        end do
        call assertEqual(25, total, "signs")
        lost = slip_of("E27")
        call assertEqual(signs_of(trim(lost%reads)), signs_of(trim(lost%derived)), "only dots")
    end subroutine signs_are_those_of_the_quotes

    subroutine zero(text, letters, within)
        !! Both sides of the equation are the same.
        character(*), intent(in) :: text
        type(names_t), intent(in) :: letters
        real(dp), intent(in) :: within  !! of the size of the terms
        real(dp) :: left, right, size_of_left, size_of_right
        integer :: at
        logical :: ok

        at = index(text, " = ")
        call assertTrue(at > 0, "an equation: "//text)
        if (at == 0) return
        call formula_value(text(:at), letters, left, size_of_left, ok)
        call assertTrue(ok, "read: "//text(:at))
        call formula_value(text(at + 3:), letters, right, size_of_right, ok)
        call assertTrue(ok, "read: "//text(at + 3:))
        call assertEqual(right, left, within*(size_of_left + size_of_right), text)
    end subroutine zero

    subroutine move_cart(theta, theta_dot, letters)
        !! The letters of the cart-pendulum, with its true accelerations.
        real(dp), intent(in) :: theta, theta_dot
        type(names_t), intent(inout) :: letters
        type(cart_pendulum_t) :: cart
        type(error_t), allocatable :: error
        real(dp) :: a(2)

        call cart%configure([m1, m2, l, g], error)
        call cart%accelerations(0.0_dp, [0.3_dp, theta], [0.6_dp, theta_dot], a)
        call letters%set("m1", m1)
        call letters%set("m2", m2)
        call letters%set("l", l)
        call letters%set("g", g)
        call letters%set("theta", theta)
        call letters%set("sin(theta)", sin(theta))
        call letters%set("cos(theta)", cos(theta))
        call letters%set("x_dot", 0.6_dp)
        call letters%set("theta_dot", theta_dot)
        call letters%set("x_ddot", a(1))
        call letters%set("theta_ddot", a(2))
    end subroutine move_cart

    subroutine derived_equations_hold()
        !! On the motions of the cart, of Atwood's machine and of the wedge. Those of small angles,
        !! to their square.
        type(names_t) :: letters
        type(slip_t) :: slip
        type(atwood_t) :: atwood
        type(wedge_t) :: wedge
        type(error_t), allocatable :: error
        character(:), allocatable :: text
        real(dp) :: a(2)
        real(dp), parameter :: rounding = 1e-14_dp, small = 1e-3_dp, alpha = 0.5_dp

        call move_cart(0.9_dp, -1.1_dp, letters)
        slip = slip_of("E1")
        call zero(trim(slip%derived), letters, rounding)
        slip = slip_of("E3")
        call zero(trim(slip%derived), letters, rounding)
        call move_cart(small, 1.0_dp, letters)
        slip = slip_of("E4")
        call zero(trim(slip%derived), letters, small**2)
        call move_cart(small, 0.0_dp, letters)
        slip = slip_of("E29")
        text = trim(slip%derived)
        call zero(text(index(text, ";", back=.true.) + 2:), letters, small**2)
        call atwood%configure([m1, m2, g, 0.0_dp, 0.1_dp, 0.0_dp], error)
        call atwood%accelerations(0.0_dp, [0.2_dp], [0.4_dp], a(:1))
        call letters%set("d^2x/dt^2", a(1))
        slip = slip_of("E19")
        text = trim(slip%derived)
        call zero(text(:index(text, ";") - 1), letters, rounding)
        call wedge%configure([m1, m2, alpha, g], error)
        call wedge%accelerations(0.0_dp, [0.2_dp, 0.1_dp], [0.4_dp, 0.3_dp], a)
        call letters%set("m", m1)
        call letters%set("q1_ddot", a(1))
        call letters%set("q2_ddot", a(2))
        call letters%set("sin(alpha)", sin(alpha))
        call letters%set("cos(alpha)", cos(alpha))
        slip = slip_of("E21")
        call zero(trim(slip%derived), letters, rounding)
    end subroutine derived_equations_hold

    subroutine derived_expressions_are_right()
        !! Frequencies of the linear equations, the length of the second rod, the energy of the bob,
        !! and the number of coordinates.
        type(names_t) :: letters
        type(slip_t) :: slip
        character(:), allocatable :: text
        real(dp), parameter :: theta = 0.9_dp, x_dot = 0.6_dp, theta_dot = -1.1_dp
        real(dp) :: value, size_of
        logical :: ok

        call move_cart(1e-3_dp, 0.0_dp, letters)
        call letters%set("omega^2", -letters%value_of("theta_ddot")/1e-3_dp)
        slip = slip_of("E6")
        text = trim(slip%derived)
        call zero(text(:index(text, ",") - 1), letters, 1e-6_dp)
        ! with g sin(theta) of the other sign, and the cart's equation as it is
        call letters%set("omega^2", letters%value_of("theta_ddot")/1e-3_dp)
        slip = slip_of("E1")
        text = trim(slip%effect)
        call zero(text(:index(text, " < ") - 1), letters, 1e-6_dp)
        call move_cart(theta, theta_dot, letters)
        slip = slip_of("E2")
        text = trim(slip%reads)
        text = text(:len(text) - 1)
        call letters%set("cos^2(theta)", cos(theta)**2)
        call letters%set("sin^2(theta)", sin(theta)**2)
        call formula_value(text//slip%derived(index(slip%derived, "... ") + 3: &
                                              index(slip%derived, ",") - 1), letters, value, &
                           size_of, ok)
        call assertTrue(ok, text)
        call assertEqual(0.5_dp*m2*((x_dot + l*theta_dot*cos(theta))**2 &
                                    + (l*theta_dot*sin(theta))**2), value, 1e-15_dp*size_of, text)
        call letters%set("f_2", 4.0_dp)
        call letters%set("l2", 2.0_dp)
        call letters%set("x1", 0.3_dp)
        call letters%set("y1", -0.4_dp)
        call letters%set("x2", 0.3_dp + 1.6_dp)
        call letters%set("y2", -0.4_dp - 1.2_dp)
        slip = slip_of("E7")
        text = trim(slip%derived)
        text = text(index(text, "f_2 = ") + 6:)
        call zero(text, letters, 1e-15_dp)
        slip = slip_of("E13")
        call assertTrue(index(slip%quotes(2)%text, "3m - k") > 0, "the notes count m particles")
        call assertTrue(index(slip%derived, "i = 1, ..., 3n - k;") > 0, "here they are n")
        text = signs_of(trim(slip%derived))
        call assertEqual(signs_of(trim(slip%elsewhere%text)), text(:1), "the time joins")
    end subroutine derived_expressions_are_right

    function row_of(id, first) result(row)
        !! The row of the slip's page whose name begins so.
        character(*), intent(in) :: id, first
        type(claim_t) :: row
        type(report_t) :: report
        type(error_t), allocatable :: error
        integer :: i

        call slip_report(slip_of(id), report, error)
        call assertFalse(allocated(error), id)
        if (allocated(error)) return
        do i = 1, size(report%rows)
            if (index(report%rows(i)%name, first) == 1) row = report%rows(i)
        end do
        call assertEqual(1, index(row%name, first), id//": "//first)
    end function row_of

    subroutine pages_name_what_they_compute()
        !! The terms that are left of an equation as it is written, the function of the chain rule,
        !! the constraint that would be called nonholonomic.
        type(names_t) :: letters
        type(claim_t) :: row
        type(slip_t) :: slip
        type(wedge_t) :: wedge
        type(error_t), allocatable :: error
        character(*), parameter :: times = "that is, times "
        real(dp), parameter :: alpha = 0.5_dp
        character(:), allocatable :: text
        real(dp) :: a(2), size_of
        integer :: cut
        logical :: ok

        ! E4: with x_ddot = -m2/(m1 + m2) rest, (m1 + m2) x_ddot + rest is as many times x_ddot
        row = row_of("E4", times)
        call assertEqual("x_ddot", trim(row%name(len(times) + 1:)))
        call assertEqual((m1 + m2)*(1.0_dp - 1.0_dp/m2), row%left, 1e-12_dp, row%name)
        row = row_of("E4", "with ")
        slip = slip_of("E4")
        text = row%name(6:index(row%name, ":") - 1)
        call assertEqual(text//" x_ddot", slip%derived(:len(text) + 7), row%name)
        ! E21: what is left is a part of m g sin(alpha), since the equation as derived holds
        call wedge%configure([m2, m1, alpha, g], error)
        call wedge%accelerations(0.0_dp, [0.0_dp, 0.0_dp], [0.0_dp, 0.0_dp], a)
        call letters%set("m", m2)
        call letters%set("g", g)
        call letters%set("q1_ddot", a(1))
        call letters%set("q2_ddot", a(2))
        call letters%set("sin a", sin(alpha))
        call letters%set("cos a", cos(alpha))
        row = row_of("E21", times)
        call zero(trim(row%name(len(times) + 1:))//" = m g sin a", letters, 1e-14_dp)
        row = row_of("E21", "m (")
        call zero(row%name(:index(row%name, "  [") - 1), letters, 1e-14_dp)
        ! E12: F of the heading, along the path that it gives
        row = row_of("E12", "dF/dt = ")
        text = row%group(5:index(row%group, " at q = ") - 1)
        call assertEqual(row%left, (8.0_dp*(f_at(1e-3_dp) - f_at(-1e-3_dp)) - (f_at(2e-3_dp) &
                                                                  - f_at(-2e-3_dp)))/12e-3_dp, &
                         1e-9_dp, text)
        slip = slip_of("E9")
        cut = index(slip%effect, " = 0 would be nonholonomic") + 3
        call assertTrue(any(examples%name == slip%effect(:cut)), slip%effect)
    contains
        function f_at(step) result(f)
            !! At this time after the state of the heading.
            real(dp), intent(in) :: step
            real(dp) :: f
            type(names_t) :: place

            call place%set("q1", 0.4_dp + 0.7_dp*step)
            call place%set("q2", -0.9_dp + 1.9_dp*step)
            call place%set("t", 0.6_dp + step)
            call place%set("exp(q1)", exp(0.4_dp + 0.7_dp*step))
            call formula_value(text, place, f, size_of, ok)
            call assertTrue(ok, text)
        end function f_at
    end subroutine pages_name_what_they_compute
end module test_errata_ledger
