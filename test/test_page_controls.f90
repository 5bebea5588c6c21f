module test_page_controls
    !! What is false on purpose on the pages of the principles is false for the reason that the page
    !! gives: both numbers, computed here by the formula that a student would write.
    use formula, only: formula_value, names_t
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertFalse, assertTrue
    use lagrangia_errors, only: error_t
    use lagrangia_hyperdual, only: hyperdual, hyperdual_t
    use lagrangia_kinds, only: dp
    use lagrangia_principles, only: principle_names
    use lagrangia_report, only: report_t
    use lagrangia_test_potentials, only: test_charge_t
    use lagrangia_text, only: to_text
    use page_rows, only: page_once
    implicit none (type, external)
    private
    public :: page_controls_suite

    real(dp), parameter :: rounding = 1e-13_dp, pi = acos(-1.0_dp)

contains

    function page_controls_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("page_controls")
        call suite%addTest(TestMethod("action_and_constraints", action_and_constraints))
        call suite%addTest(TestMethod("another_lagrangian", another_lagrangian))
        call suite%addTest(TestMethod("light", light))
        call suite%addTest(TestMethod("virtual_and_actual", virtual_and_actual))
        call suite%addTest(TestMethod("made_up_fields", made_up_fields))
        call suite%addTest(TestMethod("headings_have_their_signs", headings_have_their_signs))
        call suite%addTest(TestMethod("every_control_is_known", every_control_is_known))
    end function page_controls_suite

    subroutine control(page, section, name, left, right, within)
        !! The two numbers of the control `name` in the section that begins so.
        character(*), intent(in) :: page, section, name
        real(dp), intent(in) :: left, right
        real(dp), intent(in), optional :: within
        type(report_t) :: report
        type(error_t), allocatable :: error
        real(dp) :: bound
        integer :: found, i

        bound = rounding
        if (present(within)) bound = within
        call page_once(page, report, error)
        call assertFalse(allocated(error), page)
        if (anyExceptions()) return
        found = 0
        do i = 1, size(report%rows)
            associate (row => report%rows(i))
                if (row%name /= name .or. index(row%group, section) /= 1) cycle
                if (.not. row%control) cycle
                found = found + 1
                call assertEqual(left, row%left, bound, page//": "//name//", left")
                call assertEqual(right, row%right, bound, page//": "//name//", right")
            end associate
        end do
        call assertEqual(1, found, page//": "//name)
    end subroutine control

    subroutine action_and_constraints()
        !! The oscillator's action beyond the conjugate point, \(\omega T = 4\); a pendulum that
        !! swings wide has its own; a disk that rolls by 5 rad, steers and rolls back.
        real(dp), parameter :: m = 0.5_dp, omega = 2.0_dp, t = 2.0_dp, a = 0.3_dp

        call control("action", "S[x + a sin(pi t/T)]", "is S least?  then not negative", &
                     0.25_dp*m*t*a**2*((pi/t)**2 - omega**2), 0.0_dp)
        call control("action", "variations that lower S", &
                     "the same as if small: floor(omega T/pi)", 0.0_dp, 1.0_dp)
        call control("constraints", "Frobenius", "dx - t dy = 0, the time forgotten", 0.0_dp, &
                     1.0_dp)
        call control("constraints", "disk, R = 0.3 m", "is x as before?  [m]", &
                     0.3_dp*5.0_dp*(sin(0.4_dp) - sin(1.5_dp)), 0.0_dp)
    end subroutine action_and_constraints

    subroutine another_lagrangian()
        !! \(L' = L + m\ell^2(\dot\theta^2 - \theta(g/\ell)\sin\theta)\) has \(3\ddot\theta =
        !! -(g/\ell)(2\sin\theta + \theta\cos\theta)\); \(L + \theta\) pushes by \(1/(m\ell^2)\).
        real(dp), parameter :: m = 0.5_dp, l = 0.8_dp, g = 9.81_dp, theta = 0.9_dp
        real(dp), parameter :: page = -g/l*sin(theta)
        real(dp), parameter :: m2 = 0.7_dp, x = 0.4_dp, s = x + 0.5_dp*theta
        real(dp), parameter :: p_x = (2.0_dp + m2)*0.6_dp + m2*0.8_dp*(-1.3_dp)*cos(theta)
        real(dp), parameter :: action = 0.5_dp*0.5_dp*2.0_dp &
                                        *(1.25_dp*cos(2.0_dp) - 1.0_dp)/sin(2.0_dp)

        call control("gauge", "pendulum", "F = m l^2 theta theta_dot: see below", &
                     -g/(3.0_dp*l)*(2.0_dp*sin(theta) + theta*cos(theta)), page)
        call control("gauge", "pendulum", "L + theta: not a dF/dt", page + 1.0_dp/(m*l**2), page)
        call control("gauge", "cart-pendulum", "is p_x' = p_x?", &
                     p_x + 3.0_dp*s**2*exp(-0.35_dp), p_x)
        call control("gauge", "oscillator", "is S' = S?", &
                     action + 0.125_dp*exp(-0.5_dp) - 1.0_dp, action, within=1e-10_dp)
        call control("gauge", "charge in B", "x_ddot with A = (0, 2 B x, 0): another B", &
                     -2.0_dp*1.33_dp, -1.33_dp)
    end subroutine another_lagrangian

    subroutine light()
        !! Where the eye stands; \(\cos\psi = 1\) at the turning point, found by RK4.
        call control("least-time", "concave mirror", "is P shortest?  0.1 rad beside  [m]", &
                     sqrt(6.25_dp + 6.0_dp*sin(0.1_dp)) + sqrt(6.25_dp - 6.0_dp*sin(0.1_dp)), &
                     5.0_dp)
        call control("least-time", "Fermat", "does the straight line obey Snell's law?", &
                     sqrt(0.5_dp), 1.5_dp*sqrt(0.5_dp))
        call control("least-time", "n^2 = n0^2 + 2 kappa y", "is cos(psi) alone constant?", &
                     cos(0.35_dp), 1.0_dp, within=1e-6_dp)
        call control("least-time", "n^2 = n0^2 (1 - alpha^2", "is cos(psi) alone constant?", &
                     cos(0.3_dp), 1.0_dp, within=1e-6_dp)
    end subroutine light

    subroutine virtual_and_actual()
        !! The pivot moves by \(-aW\sin Wt\,dt\); the wire does work on the bead.
        real(dp), parameter :: virtual = 0.8_dp*sin(0.9_dp)*(-1.3_dp)

        call control("virtual-work", "virtual displacements", "is dy = delta y?  its pivot moves", &
                     virtual - 0.1_dp*5.0_dp*sin(3.5_dp), virtual)
        call control("virtual-work", "bead on a rotating wire", "is there no power either?  [W]", &
                     2.0_dp*0.6_dp*1.5_dp**2*0.5_dp*0.8_dp, 0.0_dp)
    end subroutine virtual_and_actual

    subroutine made_up_fields()
        !! Slopes of the potentials by small differences of fourth order, 1e-3 apart: each is off
        !! by less than 1e-11. The texts of the page name the signs; here they are those of
        !! \(Q = -e\nabla\varphi - e\,\partial A/\partial t\).
        real(dp), parameter :: t = 0.7_dp, e = -0.8_dp, q(3) = [0.4_dp, 0.9_dp, -0.6_dp]
        real(dp) :: phi_x, a_t

        phi_x = slope_of_phi()
        a_t = rate_of_a()
        call statement("at rest: Q_x = -e dphi/dx - e dA_x/dt", -e*phi_x - e*a_t)
        call control("virtual-work", "U = e phi - e A.v", "at rest, without dA/dt: -e dphi/dx", &
                     -e*phi_x - e*a_t, -e*phi_x, within=1e-10_dp)
        ! chi = x^2 y cos t + y z t, whose rate joins phi
        call statement("B = 0: Q_x = -e dPhi/dx, Phi = phi + dchi/dt", &
                       -e*(phi_x - 2.0_dp*q(1)*q(2)*sin(t)))
        call control("virtual-work", "B = 0", "B = 0: as in the notes, -dPhi/dx", &
                     -e*(phi_x - 2.0_dp*q(1)*q(2)*sin(t)), &
                     -(phi_x - 2.0_dp*q(1)*q(2)*sin(t)), within=1e-10_dp)
    contains
        subroutine statement(name, value)
            !! A row that holds, both sides.
            character(*), intent(in) :: name
            real(dp), intent(in) :: value
            type(report_t) :: report
            type(error_t), allocatable :: error
            integer :: at

            call page_once("virtual-work", report, error)
            call assertFalse(allocated(error), "virtual-work")
            if (anyExceptions()) return
            at = findloc(report%rows%name == name, .true., 1)
            call assertTrue(at > 0, name)
            if (at == 0) return
            call assertEqual([value, value], [report%rows(at)%left, report%rows(at)%right], &
                             1e-10_dp, name)
        end subroutine statement

        function slope_of_phi() result(slope)
            real(dp) :: slope

            slope = (8.0_dp*(phi_at(1e-3_dp) - phi_at(-1e-3_dp)) &
                     - (phi_at(2e-3_dp) - phi_at(-2e-3_dp)))/12e-3_dp
        end function slope_of_phi

        function phi_at(step) result(value)
            real(dp), intent(in) :: step
            real(dp) :: value
            type(test_charge_t) :: charge
            type(hyperdual_t) :: phi, a(3)

            call charge%potentials(hyperdual(t), hyperdual(q + [step, 0.0_dp, 0.0_dp]), phi, a)
            value = phi%re
        end function phi_at

        function rate_of_a() result(rate)
            real(dp) :: rate

            rate = (8.0_dp*(a_at(1e-3_dp) - a_at(-1e-3_dp)) - (a_at(2e-3_dp) - a_at(-2e-3_dp))) &
                   /12e-3_dp
        end function rate_of_a

        function a_at(step) result(value)
            real(dp), intent(in) :: step
            real(dp) :: value
            type(test_charge_t) :: charge
            type(hyperdual_t) :: phi, a(3)

            call charge%potentials(hyperdual(t + step), hyperdual(q), phi, a)
            value = a(1)%re
        end function a_at
    end subroutine made_up_fields

    subroutine headings_have_their_signs()
        !! The formulae over the made-up fields: \(Q\) of the charge at rest, from the slopes of
        !! \(U\); and \(Q_y\) where \(A = \nabla\chi\), from \(\chi\) as it is printed.
        type(report_t) :: report
        type(error_t), allocatable :: error
        type(test_charge_t) :: charge
        type(names_t) :: letters
        character(:), allocatable :: text
        real(dp), parameter :: t = 0.7_dp, e = -0.8_dp, q(3) = [0.4_dp, 0.9_dp, -0.6_dp]
        real(dp), parameter :: h = 1e-3_dp
        real(dp) :: slope(3), induced(3), b(3), value, size_of, mixed
        integer :: at, i, k
        logical :: ok

        call page_once("virtual-work", report, error)
        call assertFalse(allocated(error), "virtual-work")
        if (anyExceptions()) return
        call charge%fields(t, q, slope, induced, b)
        at = findloc(index(report%rows%name, "at rest: Q_x = ") == 1, .true., 1)
        text = trim(report%rows(at)%group)
        text = text(index(text, "Q = ") + 4:index(text, "  [N]") - 1)
        call letters%set("dU/dq", -e*slope(1))
        call letters%set("d/dt dU/dq_dot", e*induced(1))
        call formula_value(text, letters, value, size_of, ok)
        call assertTrue(ok, text)
        call assertEqual(report%rows(at)%left, value, rounding, text)
        at = findloc(index(report%rows%name, "B = 0: Q_y = ") == 1, .true., 1)
        text = trim(report%rows(at)%group)
        text = text(index(text, "chi = ") + 6:index(text, ";") - 1)
        mixed = 0.0_dp
        do i = -1, 1, 2
            do k = -1, 1, 2
                call letters%set("x", q(1))
                call letters%set("y", q(2) + i*h)
                call letters%set("z", q(3))
                call letters%set("t", t + k*h)
                call letters%set("cos t", cos(t + k*h))
                call formula_value(text, letters, value, size_of, ok)
                call assertTrue(ok, text)
                mixed = mixed + i*k*value/(4.0_dp*h**2)
            end do
        end do
        call assertEqual(report%rows(at)%left, e*slope(2) - e*mixed, 1e-6_dp, text)
    end subroutine headings_have_their_signs

    subroutine every_control_is_known()
        !! So many on each page: a new one is to be computed here.
        type(report_t) :: report
        type(error_t), allocatable :: error
        character(:), allocatable :: counts
        character(16), allocatable :: names(:)
        integer :: i

        allocate (names, source=principle_names())
        counts = ""
        do i = 1, size(names)
            call page_once(trim(names(i)), report, error)
            counts = counts//trim(names(i))//" "//to_text(count(report%rows%control))//" "
        end do
        call assertEqual("constraints 5 virtual-work 5 reactions 4 vakonomic 3 dalembert 2 "// &
                         "same-motion 7 gauge 5 noether 7 geometric-phase 3 small-angle 3 "// &
                         "action 3 least-time 4 maupertuis 3 gauss-hertz 3 all-paths 5 "// &
                         "phase-space 4 helmholtz 4 measure-g 3 ", counts, "controls")
    end subroutine every_control_is_known
end module test_page_controls
