module test_principles
    !! Every principle of the command: all statements hold, every negative control fails.
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertFalse, &
                     assertGreaterThan, assertLessThanOrEqual, assertTrue
    use lagrangia_errors, only: error_t
    use lagrangia_files, only: read_whole_file
    use lagrangia_kinds, only: dp
    use lagrangia_ledger_text, only: statement_line
    use lagrangia_principles, only: principle_names, principle_report, principles
    use lagrangia_report, only: report_t
    use lagrangia_text, only: join, to_text
    use page_rows, only: page_once
    use test_page_numbers, only: page_numbers_suite
    implicit none (type, external)
    private
    public :: principles_suite

    type :: section_t
        !! What stands on a page, and no less.
        character(16) :: page
        character(48) :: heading  !! its first words
        integer :: statements, controls
    end type section_t

    type(section_t), parameter :: sections(*) = [ &
        section_t("constraints", "mixed partials, largest |dA_i/", 7, 1), &
        section_t("constraints", "Frobenius, largest da on allow", 6, 2), &
        section_t("constraints", "scleronomic or rheonomic", 3, 0), &
        section_t("constraints", "classes as computed", 11, 0), &
        section_t("constraints", "double pendulum", 2, 1), &
        section_t("constraints", "degrees of freedom", 5, 0), &
        section_t("constraints", "disk, R = 0.3 m: roll by 5 rad", 4, 1), &
        section_t("virtual-work", "virtual displacements", 5, 1), &
        section_t("virtual-work", "bead on a rotating wire", 2, 1), &
        section_t("virtual-work", "sum of (m x_ddot - F).dx/dq on motions by RK4", 13, 1), &
        section_t("virtual-work", "double pendulum", 2, 0), &
        section_t("virtual-work", "Q_j = -dV/dq_j with V = T - L", 12, 0), &
        section_t("virtual-work", "U = e phi - e A.v", 4, 1), &
        section_t("virtual-work", "B = 0, made up: A = grad(chi),", 3, 1), &
        section_t("reactions", "pendulum from rest at th0 = 2", 4, 1), &
        section_t("reactions", "cart-pendulum from rest at 2 r", 3, 1), &
        section_t("reactions", "block on a wedge: the incline'", 2, 1), &
        section_t("reactions", "rolling disk on a circle", 2, 0), &
        section_t("reactions", "the rod's constraint stated tw", 4, 1), &
        section_t("vakonomic", "D'Alembert, as disks roll", 3, 0), &
        section_t("vakonomic", "the constraint inside L, the sa", 2, 3), &
        section_t("vakonomic", "steering locked at 0.7 rad", 3, 0), &
        section_t("dalembert", "cart-pendulum: the two steps", 3, 0), &
        section_t("dalembert", "cart-pendulum, theta: each sum", 5, 1), &
        section_t("dalembert", "cart-pendulum, x: T has no x", 2, 0), &
        section_t("dalembert", "bead on a wire that turns, W = ", 2, 1), &
        section_t("same-motion", "oscillator in the plane", 6, 3), &
        section_t("same-motion", "damped oscillator", 4, 3), &
        section_t("same-motion", "L and 2 L", 2, 1), &
        section_t("gauge", "pendulum: theta_ddot from L' b", 3, 2), &
        section_t("gauge", "every system, all three F, 20", 1, 0), &
        section_t("gauge", "cart-pendulum, F = exp(-t/2) s", 4, 1), &
        section_t("gauge", "oscillator from 1 m to 0.5 m in 1 s", 2, 1), &
        section_t("gauge", "charge in B along z", 4, 1), &
        section_t("noether", "cart-pendulum: of 9 changes", 4, 1), &
        section_t("noether", "cart-pendulum: largest change", 3, 1), &
        section_t("noether", "double pendulum without g", 3, 0), &
        section_t("noether", "double pendulum with g", 1, 2), &
        section_t("noether", "charge in B along z, A = B x r", 5, 2), &
        section_t("noether", "bead on a hoop that is turned", 3, 1), &
        section_t("geometric-phase", "disk: roll by d, steer by d", 5, 1), &
        section_t("geometric-phase", "disk: theta and phi go around", 4, 1), &
        section_t("geometric-phase", "Foucault: how far the plane", 5, 1), &
        section_t("small-angle", "cart-pendulum from rest at A", 6, 1), &
        section_t("small-angle", "what is lost: T0 = 2 pi/w", 4, 1), &
        section_t("small-angle", "the notes' sign, - g sin(theta)", 2, 1), &
        section_t("action", "computed paths: largest |dS_d/", 5, 1), &
        section_t("action", "paths found: Newton's method o", 4, 0), &
        section_t("action", "the oscillator's action", 1, 0), &
        section_t("action", "S[x + a sin(pi t/T)] - S[x] =", 3, 1), &
        section_t("action", "variations that lower S", 8, 1), &
        section_t("least-time", "Hero, flat mirror: points 1.2", 5, 0), &
        section_t("least-time", "concave mirror, radius 2 m, po", 3, 1), &
        section_t("least-time", "elliptic mirror", 2, 0), &
        section_t("least-time", "Fermat, air to glass (n 1 to 1", 4, 1), &
        section_t("least-time", "n^2 = n0^2 + 2 kappa y (a mirage)", 4, 1), &
        section_t("least-time", "n^2 = n0^2 (1 - alpha^2 y^2) (a fibre)", 3, 1), &
        section_t("maupertuis", "two throws of one energy", 6, 0), &
        section_t("maupertuis", "is A least, too?", 1, 1), &
        section_t("maupertuis", "paths of one time in the place", 2, 1), &
        section_t("maupertuis", "the envelope of all throws", 2, 1), &
        section_t("gauss-hertz", "Gauss, cart-pendulum", 3, 1), &
        section_t("gauss-hertz", "Hertz: a mass of no weight on a", 3, 0), &
        section_t("gauss-hertz", "with weight: Hertz has no force", 1, 2), &
        section_t("all-paths", "pendulum, 0 to 1 rad in T = 9/", 12, 1), &
        section_t("all-paths", "descent, 240 pieces: from a straight line,", 7, 3), &
        section_t("all-paths", "oscillator, 1 m to 0.5 m", 3, 1), &
        section_t("phase-space", "cart-pendulum: H(q, p) = sum", 4, 1), &
        section_t("phase-space", "pendulum: the area of a cloud", 2, 1), &
        section_t("phase-space", "pendulum: the area J = int p", 3, 1), &
        section_t("phase-space", "how fast neighbours part", 3, 1), &
        section_t("helmholtz", "is there a U with Q = d/dt", 3, 2), &
        section_t("helmholtz", "work around a circle of 1 m", 4, 1), &
        section_t("helmholtz", "damped oscillator, E = f(t)", 1, 1), &
        section_t("measure-g", "m1 = 1.1 kg, m2 = 0.9 kg", 3, 1), &
        section_t("measure-g", "sigma_g/g: simulated measureme", 3, 1), &
        section_t("measure-g", "the best difference of the mas", 3, 1)]

contains

    function principles_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("principles")
        call suite%addTest(TestMethod("all_is_as_it_must_be", all_is_as_it_must_be))
        call suite%addTest(TestMethod("the_picture_of_the_action", the_picture_of_the_action))
        call suite%addTest(TestMethod("pictures_say_what_they_show", pictures_say_what_they_show))
        call suite%addTest(TestMethod("the_picture_of_the_rays", the_picture_of_the_rays))
        call suite%addTest(TestMethod("the_picture_of_the_disk", the_picture_of_the_disk))
        call suite%addTest(TestMethod("what_is_replaced_is_said", what_is_replaced_is_said))
        call suite%addTest(TestMethod("pages_are_whole", pages_are_whole))
        call suite%addTest(TestMethod("lines_are_quoted", lines_are_quoted))
        call suite%addTest(TestMethod("rows_are_judged", rows_are_judged))
        call suite%addTest(TestMethod("refuses_unknown_names", refuses_unknown_names))
        call suite%addTest(page_numbers_suite())
    end function principles_suite

    subroutine all_is_as_it_must_be()
        !! Statements hold; controls fail by far more than rounding, or by ten times what else
        !! bounds them; each line fits the screen.
        character(16), allocatable :: names(:)
        type(report_t) :: report
        type(error_t), allocatable :: error
        integer :: i, k

        allocate (names, source=principle_names())
        do i = 1, size(names)
            call page_once(trim(names(i)), report, error)
            call assertFalse(allocated(error), trim(names(i)))
            if (anyExceptions()) return
            do k = 1, size(report%rows)
                associate (row => report%rows(k))
                    call assertTrue(row%as_it_must(), trim(names(i))//": "//row%name)
                    ! a bound beyond 0.01 is no rounding
                    if (row%control) call assertGreaterThan(row%value, &
                        max(merge(10.0_dp, 1e3_dp, row%most > 0.01_dp)*row%most, 1e-6_dp), &
                        message="control: "//row%name)
                    call assertLessThanOrEqual(len(statement_line(row)), 100, message=row%name)
                    call assertLessThanOrEqual(len_trim(row%name), len(row%name) - 1, &
                                               message=row%name)
                    call assertLessThanOrEqual(len_trim(row%group), len(row%group) - 1, &
                                               message=row%group)
                end associate
            end do
            do k = 1, size(report%notes)
                call assertLessThanOrEqual(len_trim(report%notes(k)), len(report%notes) - 1, &
                                           message=report%notes(k))
            end do
            if (report%picture%file == "") cycle
            call assertEqual(size(report%picture%names), size(report%picture%values, 1), &
                             trim(names(i))//": columns")
            call assertTrue(all(abs(report%picture%values) < huge(1.0_dp)), trim(names(i)))
        end do
    end subroutine all_is_as_it_must_be

    subroutine the_picture_of_the_action()
        !! Before the conjugate point the action rises on both sides, beyond it it falls on both;
        !! the oscillator's is \((mTa^2/4)((\pi/T)^2 - \omega^2)\), m = 0.5 kg, omega = 2/s, but for
        !! the square of the step over 12, 2e-5 of the first term, which is 1.9 times the sum.
        type(report_t) :: report
        type(error_t), allocatable :: error
        real(dp), parameter :: pi = acos(-1.0_dp), times(2) = [1.0_dp, 2.0_dp]
        integer :: i, k

        call page_once("action", report, error)
        call assertFalse(allocated(error), "action")
        if (anyExceptions()) return
        associate (values => report%picture%values)
            call assertEqual(121, size(values, 2), "samples")
            do k = 1, size(values, 2)
                if (k == 61) cycle  ! the actual path
                call assertTrue(all(values([2, 5], k) > 0.0_dp), "before: a rise on both sides")
                call assertTrue(all(values([3, 6], k) < 0.0_dp), "beyond: a fall on both sides")
                do i = 1, 2
                    associate (exact => 0.125_dp*times(i)*values(1, k)**2* &
                               ((pi/times(i))**2 - 4.0_dp))
                        call assertEqual(exact, values(1 + i, k), 1e-4_dp*abs(exact), "parabola")
                    end associate
                end do
            end do
            call assertEqual(0.0_dp, maxval(abs(values(:, 61))), 1e-15_dp, "nothing at 0")
        end associate
    end subroutine the_picture_of_the_action

    subroutine pictures_say_what_they_show()
        !! Title, columns with their units, panels: all of them, as they are printed.
        character(*), parameter :: names(5) = [character(16) :: "action", "constraints", &
            "gauge", "least-time", "virtual-work"]
        character(*), parameter :: expected(5) = [character(340) :: &
            "Action of q + a eta, less that of the actual path q; eta: what lowers it most | "// &
            "a [m], oscillator(omega T=2) [J s], oscillator(omega T=4) [J s], a_theta [rad], "// &
            "pendulum_0.45_periods [J s], pendulum_0.70_periods [J s] | "// &
            "a:oscillator(omega T=2)+oscillator(omega T=4), "// &
            "a_theta:pendulum_0.45_periods+pendulum_0.70_periods", &
            "A disk rolls, steers, rolls back, steers back, and is elsewhere | t [s], x [m], "// &
            "y [m], phi [rad], theta [rad] | x:y, t:phi+theta", &
            "With dF/dt in L the action is shifted, and least on the same path | "// &
            "bulge of the path [m], S' [J s], S shifted [J s], S [J s] | "// &
            "bulge of the path:S'+S shifted+S", &
            "Optical path of rays that touch elsewhere, less the actual one | offset [m], "// &
            "flat_mirror [m], concave_mirror [m], elliptic_mirror [m], into_glass [m] | "// &
            "offset:flat_mirror+concave_mirror+elliptic_mirror+into_glass", &
            "A wire that turns does work on its bead, but no virtual work | t [s], "// &
            "N.dx/dt [W], 2 m omega^2 r r_dot [W], N.(dx/dr) r_dot [W] | "// &
            "t:N.dx/dt+2 m omega^2 r r_dot+N.(dx/dr) r_dot"]
        character(:), allocatable :: text
        type(report_t) :: report
        type(error_t), allocatable :: error
        integer :: i, k

        do i = 1, size(expected)
            call page_once(trim(names(i)), report, error)
            text = ""
            associate (picture => report%picture)
                if (allocated(picture%names)) then
                    do k = 1, size(picture%names)
                        text = text//", "//trim(picture%names(k))//" ["// &
                               trim(picture%units(k))//"]"
                    end do
                    text = trim(picture%title)//" | "//text(3:)//" | "// &
                           join(picture%panels, ", ")
                end if
            end associate
            call assertEqual(trim(expected(i)), text, "picture of "//names(i))
        end do
    end subroutine pictures_say_what_they_show

    subroutine the_picture_of_the_rays()
        !! From 1 m before to 1 m behind where the light goes, with the lengths by Pythagoras of
        !! numbers typed in: Hero's point 3.6/3.7 m, Snell's from 22-digit arithmetic.
        type(report_t) :: report
        type(error_t), allocatable :: error
        real(dp), parameter :: hero = 3.6_dp/3.7_dp, snell = 1.5104253741581037756_dp
        real(dp) :: u
        integer :: k

        call page_once("least-time", report, error)
        call assertFalse(allocated(error), "least-time")
        if (anyExceptions()) return
        call assertEqual(101, size(report%picture%values, 2), "samples")
        do k = 1, size(report%picture%values, 2)
            u = 0.02_dp*(k - 51)
            associate (touched => 2.0_dp*[sin(u/2.0_dp), cos(u/2.0_dp)])
                call assertEqual([u, hypot(1.2_dp, hero + u) + hypot(2.5_dp, 3.0_dp - hero - u) &
                                  - hypot(3.0_dp, 3.7_dp), hypot(touched(1) + 1.5_dp, touched(2)) &
                                  + hypot(touched(1) - 1.5_dp, touched(2)) - 5.0_dp, 0.0_dp, &
                                  hypot(1.2_dp, snell + u) + 1.5_dp*hypot(0.8_dp, 2.0_dp - snell &
                                  - u) - 3.3359606283680579881_dp], &
                                 report%picture%values(:, k), 1e-14_dp, "optical paths")
            end associate
        end do
    end subroutine the_picture_of_the_rays

    subroutine the_picture_of_the_disk()
        !! Four legs of a second, 50 steps each: x and y on the circle's tangents, R = 0.3 m, from
        !! heading 0.4 to 1.5 and back, 5 rad rolled; angles go evenly.
        type(report_t) :: report
        type(error_t), allocatable :: error
        real(dp), parameter :: way = 1.5_dp, one = 0.4_dp, two = 1.5_dp
        real(dp) :: s(4), x, y
        integer :: k

        call page_once("constraints", report, error)
        call assertFalse(allocated(error), "constraints")
        if (anyExceptions()) return
        associate (values => report%picture%values)
            call assertEqual(201, size(values, 2), "samples")
            do k = 1, size(values, 2)
                associate (t => 0.02_dp*(k - 1))
                    s = min(1.0_dp, max(0.0_dp, t - [0, 1, 2, 3]))  ! parts of the legs
                    x = way*(s(1)*sin(one) - s(3)*sin(two))
                    y = -way*(s(1)*cos(one) - s(3)*cos(two))
                    call assertEqual([t, x, y, 5.0_dp*(s(1) - s(3)), one + 1.1_dp*(s(2) - s(4))], &
                                     values(:, k), 1e-12_dp, "the disk")
                end associate
            end do
        end associate
    end subroutine the_picture_of_the_disk

    subroutine what_is_replaced_is_said()
        !! F = m l^2 theta theta_dot, with theta_ddot in dF/dt replaced: `gauge` has the numbers.
        type(report_t) :: report
        type(error_t), allocatable :: error

        call page_once("gauge", report, error)
        call assertFalse(allocated(error), "gauge")
        if (anyExceptions()) return
        call assertEqual(1, count(report%rows%name == "F = m l^2 theta theta_dot: see below"))
        call assertTrue(index(report%notes(2), "dF/dt then has q_ddot, which no L has.") > 0, &
                        "index(report%notes(2), 'dF/dt then has q_ddot, which no L has.') > 0")
        call assertTrue(index(report%notes(3), "is replaced by -(g/l) sin(theta)") > 0, &
                        "index(report%notes(3), 'is replaced by -(g/l) sin(theta)') > 0")
    end subroutine what_is_replaced_is_said

    subroutine pages_are_whole()
        !! Every section, in order, with all of its statements and controls.
        character(16), allocatable :: names(:)
        type(report_t) :: report
        type(error_t), allocatable :: error
        type(section_t) :: section
        integer :: i, k, first, next

        allocate (names, source=principle_names())
        call assertEqual(names_of_pages(), join(names, " "), "principles")
        next = 1
        do i = 1, size(names)
            call page_once(trim(names(i)), report, error)
            first = 1
            do k = 2, size(report%rows) + 1
                if (k <= size(report%rows)) then
                    if (report%rows(k)%group == report%rows(first)%group) cycle
                end if
                call assertTrue(next <= size(sections), trim(names(i))//": a section more: "// &
                                report%rows(first)%group)
                if (next > size(sections)) return
                section = sections(next)
                call assertEqual(section%page, names(i), "page of "//section%heading)
                call assertEqual(trim(section%heading), report%rows(first)%group( &
                                 :len_trim(section%heading)), trim(names(i))//": section")
                call assertEqual(section%statements, &
                                 count(.not. report%rows(first:k - 1)%control), &
                                 trim(section%heading)//": statements")
                call assertEqual(section%controls, count(report%rows(first:k - 1)%control), &
                                 trim(section%heading)//": negative controls")
                next = next + 1
                first = k
            end do
            call assertTrue(report%picture%file /= "", names(i)//": has a picture")
        end do
        call assertEqual(size(sections) + 1, next, "sections in all")
    contains
        pure function names_of_pages() result(text)
            !! Those of the table above, each once.
            character(:), allocatable :: text
            integer :: s

            text = trim(sections(1)%page)
            do s = 2, size(sections)
                if (sections(s)%page /= sections(s - 1)%page) text = text//" "// &
                    trim(sections(s)%page)
            end do
        end function names_of_pages
    end subroutine pages_are_whole

    subroutine lines_are_quoted()
        !! Every page quotes what it serves, word for word.
        character(*), parameter :: notes = "data/reference/lecture_notes.txt"
        character(16), allocatable :: names(:)
        type(report_t) :: report
        type(error_t), allocatable :: error
        character(:), allocatable :: text, head
        integer :: at, i, k

        call read_whole_file(notes, text, error)
        call assertFalse(allocated(error), notes)
        if (anyExceptions()) return
        allocate (names, source=principle_names())
        do i = 1, size(names)
            call page_once(trim(names(i)), report, error)
            call assertTrue(size(report%citations) > 0, trim(names(i))//": a line of the notes")
            do k = 1, size(report%citations)
                associate (cited => report%citations(k))
                    call assertTrue(len_trim(cited%text) < len(cited%text), "cut: "//cited%text)
                    head = new_line("a")//trim(cited%scan)//" "//to_text(cited%line)//" "
                    at = index(text, head)
                    do while (at > 0)
                        at = at + len(head)
                        if (index(text(at:at + index(text(at:), new_line("a")) - 2), &
                                  trim(cited%text)) > 0) exit
                        if (index(text(at - 1:), head) == 0) at = 0
                        if (at > 0) at = at - 2 + index(text(at - 1:), head)
                    end do
                    call assertTrue(at > 0, trim(names(i))//" quotes "//head(2:)//cited%text)
                end associate
            end do
        end do
    end subroutine lines_are_quoted

    subroutine rows_are_judged()
        !! NaN holds nothing, and is not what a control must give; a claim holds at its bound.
        type(report_t) :: report
        real(dp) :: nan, differences(3)

        nan = 0.0_dp
        nan = nan/nan
        call report%begin("")
        call report%equal("close", 1.0_dp, 1.5_dp, 0.5_dp)
        call report%equal("far", 1.0_dp, 1.6_dp, 0.5_dp)
        call report%equal("nothing", nan, 1.0_dp, 0.5_dp)
        call report%equal("nothing", nan, 1.0_dp, 0.5_dp, control=.true.)
        call report%equal("control that holds", 1.0_dp, 1.0_dp, 0.5_dp, control=.true.)
        call report%equal("control that fails", 1.0_dp, 2.0_dp, 0.5_dp, control=.true.)
        call report%at_least("more", 3.0_dp, 2.0_dp, 0.5_dp)
        call report%at_least("a little less", 1.75_dp, 2.0_dp, 0.5_dp)
        call report%at_least("less", 1.0_dp, 2.0_dp, 0.5_dp)
        call assertTrue(all(report%rows%as_it_must() .eqv. [.true., .false., .false., .false., &
                                                             .false., .true., .true., .true., &
                                                             .false.]), "verdicts")
        call assertEqual(5, report%broken())
        differences = report%rows(7:)%value
        call assertEqual([0.0_dp, 0.25_dp, 1.0_dp], differences, 1e-15_dp)
        call report%equal("control at its bound", 1.0_dp, 1.5_dp, 0.5_dp, control=.true.)
        call assertFalse(report%rows(10)%as_it_must(), "it holds just")
        call assertTrue(index(statement_line(report%rows(1)), " holds") > 0, &
                        "index(statement_line(report%rows(1)), ' holds') > 0")
        call assertTrue(index(statement_line(report%rows(6)), " differs") > 0, &
                        "index(statement_line(report%rows(6)), ' differs') > 0")
        call assertTrue(index(statement_line(report%rows(2)), "FAILS !") > 0, &
                        "index(statement_line(report%rows(2)), 'FAILS !') > 0")
        call assertTrue(index(statement_line(report%rows(5)), "HOLDS !") > 0, &
                        "index(statement_line(report%rows(5)), 'HOLDS !') > 0")
    end subroutine rows_are_judged

    subroutine refuses_unknown_names()
        !! With the nearest one there is.
        type(report_t) :: report
        type(error_t), allocatable :: error

        call principle_report("acton", report, error)
        call assertTrue(allocated(error), "an error: refuses unknown names")
        if (anyExceptions()) return
        call assertEqual("unknown principle 'acton'; did you mean 'action'?", error%message)
        call principle_report("Hamilton", report, error)
        call assertTrue(index(error%message, "did you mean 'action' (Hamilton: ") > 0, &
                        error%message)
        call points("fermat", "least-time")
        call points("hero", "least-time")
        call points("Gauss", "gauss-hertz")
        call points("liouville", "phase-space")
        call points("d'Alembert", "dalembert")
    contains
        subroutine points(name, page)
            character(*), intent(in) :: name, page

            call principle_report(name, report, error)
            call assertTrue(index(error%message, "did you mean '"//page//"'") > 0, error%message)
        end subroutine points
    end subroutine refuses_unknown_names
end module test_principles
