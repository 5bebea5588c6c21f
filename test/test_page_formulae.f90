module test_page_formulae
    !! What the pages of the principles and of the errata print as a formula is the number beside
    !! it: read as text and computed with the page's numbers.
    use formula, only: formula_value, names_t
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertFalse, assertTrue
    use lagrangia_errata_command, only: slip_report
    use lagrangia_errata_ledger, only: slip_t, slips_of_the_notes
    use lagrangia_errors, only: error_t
    use lagrangia_gauged_system, only: family_t, member_names
    use lagrangia_hyperdual, only: hyperdual, hyperdual_t
    use lagrangia_kinds, only: dp
    use lagrangia_ledger, only: claim_t
    use lagrangia_report, only: report_t
    use lagrangia_text, only: to_text
    use page_rows, only: page_once
    implicit none (type, external)
    private
    public :: page_formulae_suite

    real(dp), parameter :: rounding = 1e-13_dp  !! of a few dozen operations, of the terms' sizes

contains

    function page_formulae_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("page_formulae")
        call suite%addTest(TestMethod("virtual_work_page", virtual_work_page))
        call suite%addTest(TestMethod("constraints_page", constraints_page))
        call suite%addTest(TestMethod("least_time_page", least_time_page))
        call suite%addTest(TestMethod("gauge_page", gauge_page))
        call suite%addTest(TestMethod("gauge_functions_are_as_printed", &
                                      gauge_functions_are_as_printed))
        call suite%addTest(TestMethod("action_page", action_page))
        call suite%addTest(TestMethod("same_motion_page", same_motion_page))
        call suite%addTest(TestMethod("measure_g_page", measure_g_page))
        call suite%addTest(TestMethod("errata_pages", errata_pages))
    end function page_formulae_suite

    subroutine virtual_work_page()
        !! Each section has its own numbers.
        type(names_t) :: letters
        integer :: read_of

        read_of = 0
        call angles(letters, [0.4_dp, -1.1_dp], [0.03_dp, 0.02_dp])
        call put(letters, "l1 l2 l a W t dt dth", [0.9_dp, 1.7_dp, 0.8_dp, 0.1_dp, 5.0_dp, 0.7_dp, &
                                                   1.0_dp, -1.3_dp])
        call letters%set("th", 0.9_dp)
        call try("virtual-work", "virtual displacements", letters, read_of)
        call assertEqual(4, read_of, "virtual displacements")
        call put(letters, "m W r r_dot", [0.6_dp, 1.5_dp, 0.5_dp, 0.8_dp])
        call try("virtual-work", "bead on a rotating wire", letters, read_of)
        call assertEqual(5, read_of, "the bead")
        call put(letters, "m1 m2 g", [1.3_dp, 0.7_dp, 9.81_dp])
        call try("virtual-work", "double pendulum, generalized forces", letters, read_of)
        call assertEqual(7, read_of, "generalized forces")
    end subroutine virtual_work_page

    subroutine constraints_page()
        !! The bobs at a place that the constraints allow.
        type(names_t) :: letters
        integer :: read_of

        read_of = 0
        call put(letters, "W r", [1.5_dp, 2.0_dp])
        call try("constraints", "scleronomic or rheonomic", letters, read_of)
        call assertEqual(2, read_of, "the wire's B")
        call put(letters, "l1 l2", [0.9_dp, 1.7_dp])
        call put(letters, "x1 y1", 0.9_dp*[sin(0.4_dp), -cos(0.4_dp)])
        call put(letters, "x2 y2", 0.9_dp*[sin(0.4_dp), -cos(0.4_dp)] &
                 + 1.7_dp*[sin(-1.1_dp), -cos(-1.1_dp)])
        call try("constraints", "double pendulum", letters, read_of)
        call assertEqual(7, read_of, "two bobs, and the notes' slip")
        call angles(letters, [0.4_dp, 1.5_dp], [0.0_dp, 0.0_dp])
        call put(letters, "R ph1 ph2", [0.3_dp, 1.0_dp, 6.0_dp])
        call try("constraints", "disk, R = 0.3 m", letters, read_of)
        call assertEqual(9, read_of, "the disk")
        call try("constraints", "degrees of freedom", letters, read_of)
        call assertEqual(14, read_of, "3n - k")
    end subroutine constraints_page

    subroutine least_time_page()
        !! Mirrors and graded media.
        type(names_t) :: letters
        real(dp), parameter :: psi = -0.35_dp
        integer :: read_of

        read_of = 0
        call put(letters, "a b d", [1.2_dp, 2.5_dp, 3.0_dp])
        call try("least-time", "Hero, flat mirror", letters, read_of)
        call assertEqual(2, read_of, "flat")
        call put(letters, "R s", [2.0_dp, 1.5_dp])
        call letters%set("(R^2 + s^2)^(3/2)", 15.625_dp)
        call try("least-time", "concave mirror", letters, read_of)
        call assertEqual(4, read_of, "concave")
        call put(letters, "n0 kappa x", [1.3_dp, 0.2_dp, 1.3_dp*cos(psi)*4.0_dp])
        call letters%set("tan psi", tan(psi))
        call letters%set("cos^2 psi", cos(psi)**2)
        call try("least-time", "n^2 = n0^2 + 2 kappa y", letters, read_of, within=1e-7_dp)
        call assertEqual(5, read_of, "a mirage")
        call put(letters, "n0 alpha psi sigma", [1.5_dp, 0.8_dp, 0.3_dp, 10.0_dp])
        call try("least-time", "n^2 = n0^2 (1 - alpha^2 y^2)", letters, read_of)
        call assertEqual(7, read_of, "a fibre")
    end subroutine least_time_page

    subroutine gauge_page()
        !! \(F = e^{-t/2}s^3\) and its derivatives by hand, \(s = x + \theta/2\); the momenta and
        !! the energy of the cart and of the charge.
        type(names_t) :: letters
        real(dp), parameter :: t = 0.7_dp, x = 0.4_dp, theta = 0.9_dp, v = 0.6_dp, w = -1.3_dp
        real(dp), parameter :: m1 = 2.0_dp, m2 = 0.7_dp, l = 0.8_dp, g = 9.81_dp
        real(dp), parameter :: s = x + 0.5_dp*theta
        real(dp), parameter :: omega = 2.0_dp, m = 0.5_dp
        integer :: read_of

        read_of = 0
        call put(letters, "p_x p_theta h", &
                 [(m1 + m2)*v + m2*l*w*cos(theta), m2*l**2*w + m2*l*v*cos(theta), &
                  0.5_dp*(m1 + m2)*v**2 + 0.5_dp*m2*l**2*w**2 + m2*l*v*w*cos(theta) &
                  - m2*g*l*cos(theta)])
        call put(letters, "dF/dx dF/dtheta", exp(-0.5_dp*t)*3.0_dp*s**2*[1.0_dp, 0.5_dp])
        call letters%set("dF/dt at fixed q", -0.5_dp*exp(-0.5_dp*t)*s**3)
        call try("gauge", "cart-pendulum, F = ", letters, read_of)
        call assertEqual(3, read_of, "momenta and energy")
        call put(letters, "S F(1) F(2)", [0.5_dp*m*omega*(1.25_dp*cos(omega) - 1.0_dp)/sin(omega), &
                                          1.0_dp, exp(-0.5_dp)*0.125_dp])
        call try("gauge", "oscillator from 1 m to 0.5 m", letters, read_of, within=1e-10_dp)
        call assertEqual(4, read_of, "the action, extrapolated")
        call put(letters, "p_y e", [1.3_dp*w + 0.7_dp*1.9_dp*0.4_dp/2.0_dp, 0.7_dp])
        call letters%set("d(B x y/2)/dy", 1.9_dp*0.4_dp/2.0_dp)
        call letters%set("(v x B)_x/m", -1.3_dp*1.9_dp/1.3_dp)
        call try("gauge", "charge in B along z", letters, read_of)
        call assertEqual(6, read_of, "the charge")
    end subroutine gauge_page

    subroutine gauge_functions_are_as_printed()
        !! Three coordinates: s of the page's note, then F by its name.
        type(report_t) :: report
        type(error_t), allocatable :: error
        type(names_t) :: letters
        type(family_t) :: family
        type(hyperdual_t) :: f
        real(dp), parameter :: t = 0.7_dp, q(3) = [0.4_dp, -0.9_dp, 1.7_dp]
        real(dp) :: s, size_of, value
        integer :: i, at
        logical :: ok

        call page_once("gauge", report, error)
        call assertFalse(allocated(error), "gauge")
        if (anyExceptions()) return
        call put(letters, "q1 q2 q3 t", [q, t])
        at = index(report%notes(1), " + ...;")
        call assertEqual(1, index(report%notes(1), "s = "))
        call formula_value(report%notes(1) (5:at), letters, s, size_of, ok)
        call assertTrue(ok, report%notes(1))
        call letters%set("s", s)
        do i = 1, size(member_names)
            family%member = i
            f = family%value(hyperdual(t), hyperdual(q))
            call formula_value(member_names(i), letters, value, size_of, ok)
            call assertTrue(ok, member_names(i))
            call assertEqual(f%re, value, rounding*size_of, member_names(i))
        end do
    end subroutine gauge_functions_are_as_printed

    subroutine action_page()
        !! The formulae are in the headings; the numbers of a row follow them.
        type(report_t) :: report
        type(error_t), allocatable :: error
        type(names_t) :: letters
        real(dp), parameter :: pi = acos(-1.0_dp), omega = 2.0_dp
        real(dp) :: time
        integer :: i, read_of

        call page_once("action", report, error)
        call assertFalse(allocated(error), "action")
        if (anyExceptions()) return
        call put(letters, "m w xa xb a pi", [0.5_dp, omega, 1.0_dp, 0.5_dp, 0.3_dp, pi])
        read_of = 0
        do i = 1, size(report%rows)
            associate (row => report%rows(i))
                if (index(row%name, "omega T = ")*index(row%name, "[J s]") == 0) cycle
                read (row%name(index(row%name, "omega T = ") + 10:), *) time
                time = time/omega
                call letters%set("T", time)
                call letters%set("cos wT", cos(omega*time))
                call letters%set("sin wT", sin(omega*time))
                if (index(row%group, "the oscillator's action, ") == 1) then
                    call judge(row, row%group(26:), letters, read_of, rounding)
                else if (index(row%group, "S[x + a sin(pi t/T)] - S[x] = ") == 1) then
                    call judge(row, row%group(31:index(row%group, ", a = ") - 1), letters, &
                               read_of, rounding)
                end if
            end associate
        end do
        call assertEqual(3, read_of, "the action, and two differences")
    end subroutine action_page

    subroutine same_motion_page()
        !! In the plane and with friction; off the motion y_ddot = 1.1.
        type(names_t) :: letters
        integer :: read_of

        read_of = 0
        call put(letters, "w x y x_dot y_dot", [2.0_dp, 0.7_dp, -0.4_dp, -0.9_dp, 1.6_dp])
        call letters%set("y_ddot", 1.1_dp)
        call try("same-motion", "oscillator in the plane", letters, read_of)
        call assertEqual(5, read_of, "accelerations, p_x', h', off the motion")
        call put(letters, "m k gamma p", [0.5_dp, 2.0_dp, 0.6_dp, -0.45_dp])
        call letters%set("exp(gamma t)", exp(0.78_dp))
        call try("same-motion", "damped oscillator", letters, read_of)
        call assertEqual(7, read_of, "with friction")
        call try("same-motion", "L and 2 L", letters, read_of)
        call assertEqual(8, read_of, "twice L")
    end subroutine same_motion_page

    subroutine measure_g_page()
        !! The formula of the note, with the masses of each row: M = 2 kg, h = 1.5 m.
        real(dp), parameter :: differences(3) = [0.02_dp, 0.04_dp, 0.1_dp]
        character(*), parameter :: left = "(sigma_g/g)^2 = "
        type(report_t) :: report
        type(error_t), allocatable :: error
        type(names_t) :: letters
        real(dp) :: value, size_of
        integer :: at, i, row
        logical :: ok

        call page_once("measure-g", report, error)
        call assertFalse(allocated(error), "measure-g")
        if (anyExceptions()) return
        at = findloc(index(report%notes, left) == 1, .true., 1)
        call assertTrue(at > 0, "the formula is there")
        row = findloc(index(report%rows%name, "m1 - m2 = 20 g") == 1, .true., 1)
        call assertTrue(row > 0, "the rows are there")
        if (anyExceptions()) return
        do i = 1, size(differences)
            associate (d => differences(i), text => report%notes(at))
                call put(letters, "s_t s_h s_m h m1 m2 t", [0.1_dp, 1e-3_dp, 1e-3_dp, 1.5_dp, &
                         1.0_dp + 0.5_dp*d, 1.0_dp - 0.5_dp*d, sqrt(6.0_dp/(d*9.81_dp))])
                call letters%set("(m1^2 - m2^2)^2", (2.0_dp*d)**2)
                call formula_value(text(len(left) + 1:len_trim(text) - 1), letters, value, &
                                   size_of, ok)
                call assertTrue(ok, trim(text))
                call assertEqual(sqrt(value), report%rows(row + i - 1)%right, rounding, trim(text))
            end associate
        end do
    end subroutine measure_g_page

    subroutine errata_pages()
        !! Frequencies and equations of the cart-pendulum, the wedge and the driven pendulum.
        type(slip_t), allocatable :: slips(:)
        type(report_t) :: report
        type(error_t), allocatable :: error
        type(names_t) :: letters
        integer :: k, read_of

        allocate (slips, source=slips_of_the_notes())
        call put(letters, "m1 m2 l g m y_p_dot y_p_ddot theta a M", &
                 [1.3_dp, 0.7_dp, 0.9_dp, 9.81_dp, 0.7_dp, -0.5_dp*sin(3.5_dp), &
                  -2.5_dp*cos(3.5_dp), 0.9_dp, 0.5_dp, 1.3_dp])
        call letters%set("sin a", sin(0.5_dp))
        read_of = 0
        do k = 1, size(slips)
            if (all(slips(k)%id /= ["E1 ", "E2 ", "E3 ", "E6 ", "E11", "E21"])) cycle
            call slip_report(slips(k), report, error)
            call assertFalse(allocated(error), slips(k)%id)
            call letters%set("m", merge(1.3_dp, 0.7_dp, slips(k)%id == "E11"))
            call judge_rows(report, "", letters, read_of, 1e-12_dp)
        end do
        call assertEqual(10, read_of, "equations of the errata")
    end subroutine errata_pages

    subroutine try(page, heading, letters, read_of, within)
        !! The statements of one section whose last right-hand sides can be read.
        character(*), intent(in) :: page, heading
        type(names_t), intent(in) :: letters
        integer, intent(inout) :: read_of
        real(dp), intent(in), optional :: within
        type(report_t) :: report
        type(error_t), allocatable :: error

        call page_once(page, report, error)
        call assertFalse(allocated(error), page)
        if (anyExceptions()) return
        if (present(within)) then
            call judge_rows(report, heading, letters, read_of, within)
        else
            call judge_rows(report, heading, letters, read_of, rounding)
        end if
    end subroutine try

    subroutine judge_rows(report, heading, letters, read_of, within)
        !! `left = right  [unit]`, `what: right`, `left = middle = right`: each part that can be
        !! read.
        type(report_t), intent(in) :: report
        character(*), intent(in) :: heading
        type(names_t), intent(in) :: letters
        integer, intent(inout) :: read_of
        real(dp), intent(in) :: within
        character(:), allocatable :: text
        integer :: i, cut

        do i = 1, size(report%rows)
            if (index(report%rows(i)%group, heading) /= 1) cycle
            text = trim(report%rows(i)%name)
            text = text(:index(text//"  [", "  [") - 1)
            if (index(text, "is that ") == 1) text = " = "//text(9:index(text, "?") - 1)
            if (text(len(text):) == "?") cycle
            text = text(:index(text//": after", ": after") - 1)
            do
                cut = index(text, " = ")
                if (cut == 0) cut = index(text, ": ") - 1
                if (cut <= 0) exit
                text = text(cut + 3 - merge(1, 0, text(cut + 1:cut + 1) == ":"):)
                call judge(report%rows(i), text(:index(text//" = ", " = ") - 1), letters, read_of, &
                           within)
            end do
        end do
    end subroutine judge_rows

    subroutine judge(row, text, letters, read_of, within)
        !! If the text can be read it is the row's right side; the left one of a control that is
        !! written as the notes have it is not.
        type(claim_t), intent(in) :: row
        character(*), intent(in) :: text
        type(names_t), intent(in) :: letters
        integer, intent(inout) :: read_of
        real(dp), intent(in) :: within
        real(dp) :: value, size_of
        logical :: ok

        call formula_value(text, letters, value, size_of, ok)
        if (.not. ok) return
        if (row%control .and. abs(value - row%right) > 0.1_dp*size_of) return
        read_of = read_of + 1
        call assertEqual(row%right, value, within*size_of, trim(row%name)//": "//text)
    end subroutine judge

    subroutine put(letters, names, values)
        !! Names between blanks, and their values.
        type(names_t), intent(inout) :: letters
        character(*), intent(in) :: names
        real(dp), intent(in) :: values(:)
        character(len(names) + 1) :: rest
        integer :: i

        rest = names
        do i = 1, size(values)
            call letters%set(rest(:index(rest, " ") - 1), values(i))
            rest = rest(index(rest, " ") + 1:)
        end do
    end subroutine put

    subroutine angles(letters, theta, steps)
        !! `cos th1`, `sin th2`, `dth1`.
        type(names_t), intent(inout) :: letters
        real(dp), intent(in) :: theta(2), steps(2)
        integer :: i

        do i = 1, 2
            call letters%set("th"//to_text(i), theta(i))
            call letters%set("cos th"//to_text(i), cos(theta(i)))
            call letters%set("sin th"//to_text(i), sin(theta(i)))
            call letters%set("dth"//to_text(i), steps(i))
        end do
    end subroutine angles
end module test_page_formulae
