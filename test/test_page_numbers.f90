module test_page_numbers
    !! The numbers that the notes and the headings of a page state: its rows follow from them, by
    !! formulas that are written here once more.
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertTrue
    use lagrangia_kinds, only: dp
    use lagrangia_report, only: report_t
    use page_rows, only: check_row, new_page
    implicit none (type, external)
    private
    public :: page_numbers_suite

    real(dp), parameter :: pi = acos(-1.0_dp)
    real(dp), parameter :: rounding = 1e-12_dp

contains

    function page_numbers_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("page_numbers")
        call suite%addTest(TestMethod("action", action))
        call suite%addTest(TestMethod("dalembert", dalembert))
        call suite%addTest(TestMethod("gauge", gauge))
        call suite%addTest(TestMethod("gauss_hertz", gauss_hertz))
        call suite%addTest(TestMethod("geometric_phase", geometric_phase))
        call suite%addTest(TestMethod("least_time", least_time))
        call suite%addTest(TestMethod("maupertuis", maupertuis))
        call suite%addTest(TestMethod("measure_g", measure_g))
        call suite%addTest(TestMethod("noether", noether))
        call suite%addTest(TestMethod("phase_space", phase_space))
        call suite%addTest(TestMethod("reactions", reactions))
        call suite%addTest(TestMethod("same_motion", same_motion))
        call suite%addTest(TestMethod("small_angle", small_angle))
        call suite%addTest(TestMethod("vakonomic", vakonomic))
        call suite%addTest(TestMethod("virtual_work", virtual_work))
        call suite%addTest(TestMethod("numbers_are_read", numbers_are_read))
    end function page_numbers_suite

    function behind(page, words) result(x)
        !! The number that follows these words in the headings and the notes.
        type(report_t), intent(in) :: page
        character(*), intent(in) :: words
        real(dp) :: x
        character(:), allocatable :: text
        integer :: i

        text = ""
        do i = 1, size(page%rows)
            text = text//" "//trim(page%rows(i)%group)//" "//trim(page%rows(i)%name)
        end do
        do i = 1, size(page%notes)
            text = text//" "//trim(page%notes(i))
        end do
        x = number_in(text, words)
    end function behind

    function number_in(text, words) result(x)
        !! The first number behind these words; a full stop is none of it.
        character(*), intent(in) :: text, words
        real(dp) :: x
        integer :: at, last, status

        x = 0.0_dp
        at = index(text, words)
        call assertTrue(at > 0, "there is no "//words)
        if (at == 0) return
        at = at + len(words)
        last = at - 2 + verify(text(at:)//" ", "0123456789.-")
        if (text(last:last) == ".") last = last - 1
        read (text(at:last), *, iostat=status) x
        call assertEqual(0, status, "no number behind "//words)
    end function number_in

    subroutine numbers_are_read()
        !! With signs, at the end of a sentence, in front of a comma.
        call assertEqual(-1.3_dp, number_in("m = 2.0 kg, v = -1.3 m/s", "v = "), 0.0_dp)
        call assertEqual(0.025_dp, number_in("h = 0.025.", "h = "), 0.0_dp)
        call assertEqual(4.0_dp, number_in("at (4, 5)", "at ("), 0.0_dp)
    end subroutine numbers_are_read

    subroutine action()
        !! The largest place of a free oscillation, the action between two places, a period.
        type(report_t) :: page
        real(dp) :: m, k, w, x, h, one, two, t, top

        call new_page("action", page)
        m = behind(page, "Oscillator: m = ")
        k = behind(page, "kg, k = ")
        w = sqrt(k/m)
        call assertEqual(w, behind(page, "w = omega = "), rounding, "omega")
        h = behind(page, "oscillator, Stoermer-Verlet, h = ")
        x = hypot(behind(page, "of the motion from "), behind(page, "m with ")/w)
        top = m*w**4*h**2*x/12.0_dp
        call check_row(page, "computed paths", "oscillator, RK4: m omega^4", 1.0020_dp*top, top, &
                       3e-3_dp*top)
        one = behind(page, "The paths found: from ")
        two = behind(page, "The paths found: from 1 m to ")
        t = behind(page, "from 1 m to 0.5 m in ")
        top = m*w*((one**2 + two**2)*cos(w*t) - 2.0_dp*one*two)/(2.0_dp*sin(w*t))
        call check_row(page, "the oscillator's action", "from 1 m to", top, top, rounding)
        x = behind(page, "((pi/T)^2 - w^2), a = ")
        top = 0.25_dp*m*t*x**2*((pi/t)**2 - w**2)
        call assertEqual(behind(page, "in 1 s, omega T = "), w*t, rounding, "omega T")
        call check_row(page, "S[x + a sin", "oscillator, omega T = 2", top, top, rounding)
    end subroutine action

    subroutine dalembert()
        !! Slopes of the bob, of the bead's energy.
        type(report_t) :: page
        real(dp) :: m2, l, th, x_dot, th_dot, x_ddot, th_ddot, m, w, r, r_ddot, one

        call new_page("dalembert", page)
        m2 = behind(page, "m2 = ")
        l = behind(page, "kg, l = ")
        th = behind(page, "At theta = ")
        x_dot = behind(page, "rad, x_dot = ")
        th_dot = behind(page, "m/s, theta_dot = ")
        x_ddot = behind(page, "rad/s, x_ddot = ")
        th_ddot = behind(page, "theta_ddot = ")
        call check_row(page, "cart-pendulum: the two", "dx2/dth = l cos", l*cos(th), l*cos(th), &
                       rounding)
        one = -m2*l*x_dot*th_dot*sin(th)
        call check_row(page, "cart-pendulum, theta", "dT/dth = -m2 l", one, one, rounding)
        one = (behind(page, "m1 = ") + m2)*x_ddot + m2*l*(cos(th)*th_ddot - sin(th)*th_dot**2)
        call check_row(page, "cart-pendulum, x", "m x_ddot dx/dx", one, one, rounding)
        m = behind(page, "Bead: m = ")
        w = behind(page, "bead on a wire that turns, W = ")
        r = behind(page, "kg, r = ")
        r_ddot = behind(page, "m/s, r_ddot = ")
        call check_row(page, "bead", "m x_ddot dx/dr", m*(r_ddot - w**2*r), m*(r_ddot - w**2*r), &
                       rounding)
        call check_row(page, "bead", "dT/dr = m W^2 r", m*w**2*r, m*w**2*r, rounding)
    end subroutine dalembert

    subroutine gauge()
        !! Accelerations, a mass matrix, an action.
        type(report_t) :: page
        real(dp) :: l, th, one, m, e, b, y_dot

        call new_page("gauge", page)
        l = behind(page, "Pendulum: m = 0.5 kg, l = ")
        th = behind(page, "m/s^2, theta = ")
        one = -behind(page, "m, g = ")/l*sin(th)
        call check_row(page, "pendulum", "F = t sin(s)", one, one, rounding)
        one = behind(page, "Cart-pendulum: m1 = 2 kg, m2 = ")* &
              behind(page, "m2 = 0.7 kg, l = ")*cos(behind(page, "x = 0.4 m, theta = "))
        call check_row(page, "cart-pendulum", "mass matrix", one, one, rounding)
        m = behind(page, "Charge: m = ")
        e = behind(page, "e = ")
        b = behind(page, "C, B = ")
        y_dot = behind(page, "m with (0.6, ")
        call check_row(page, "charge", "symmetric: x_ddot", e*b*y_dot/m, e*b*y_dot/m, rounding)
        one = e*(behind(page, "E = (0, ") - b*behind(page, "m with ("))/m
        call check_row(page, "charge", "Landau: y_ddot", one, one, rounding)
    end subroutine gauge

    subroutine gauss_hertz()
        !! delta M delta, and the curvature of a great circle.
        type(report_t) :: page
        real(dp) :: m1, m2, l, th, one

        call new_page("gauss-hertz", page)
        m1 = behind(page, "m1 = ")
        m2 = behind(page, "m2 = ")
        l = behind(page, "kg, l = ")
        th = behind(page, "m, theta = ")
        one = m1 + m2 - 4.0_dp*m2*l*cos(th) + 4.0_dp*m2*l**2
        call check_row(page, "Gauss, cart-pendulum", "delta = (1, -2)", one, one, 1e-10_dp)
        one = 1.0_dp/behind(page, "on a sphere, R = ")
        call check_row(page, "Hertz", "curvature = 1/R", one, one, 1e-10_dp)
    end subroutine gauss_hertz

    subroutine geometric_phase()
        !! A circle of the coordinates.
        type(report_t) :: page
        real(dp) :: r, rho, th, one

        call new_page("geometric-phase", page)
        r = behind(page, "The disk: R = ")
        rho = behind(page, "go around a circle of ")
        call assertEqual(rho, behind(page, "rho = "), 0.0_dp, "rho")
        th = behind(page, "theta = ")
        call assertEqual(th, behind(page, "The circle: theta = "), 0.0_dp, "theta")
        one = r*cos(th)*2.0_dp*pi*rho*bessel_j1(rho)
        call check_row(page, "disk: theta and phi", "delta x = R cos", one, one, rounding)
        one = r*sin(th)*2.0_dp*pi*rho*bessel_j1(rho)
        call check_row(page, "disk: theta and phi", "delta y = R sin", one, one, rounding)
        one = behind(page, "latitude 90.0: -2 pi sin(latitude) Foucault: how far the plane of "// &
                     "swing has turned after a day  [rad] latitude ")*pi/180.0_dp
        one = -2.0_dp*pi*sin(one)
        call check_row(page, "Foucault", "latitude 48.85", one, one, 1e-10_dp)
    end subroutine geometric_phase

    subroutine least_time()
        !! Mirrors and rays.
        type(report_t) :: page
        real(dp) :: a, b, d, one, n0, kappa, alpha, psi, sigma, x

        call new_page("least-time", page)
        a = behind(page, "Hero: a = ")
        b = behind(page, "b = ")
        d = behind(page, "m, d = ")
        call assertEqual([a, b], [behind(page, "flat mirror: points "), &
                                  behind(page, "points 1.2 m and ")], 0.0_dp, "Hero")
        call check_row(page, "Hero", "x = a d/(a + b)", a*d/(a + b), a*d/(a + b), rounding)
        one = 2.0_dp*hypot(behind(page, "Concave: R = "), behind(page, "R = 2 m, s = "))
        call check_row(page, "concave", "P = 2 sqrt", one, one, rounding)
        one = 2.0_dp*behind(page, "semi-axes ")
        call check_row(page, "elliptic", "longest of 72", one, one, rounding)
        n0 = behind(page, "Mirage: n0 = ")
        kappa = behind(page, "kappa = ")
        psi = behind(page, "(a mirage), launched at ")
        x = n0*cos(psi)*behind(page, "0.2/m, to sigma = ")
        one = x*tan(psi) + kappa*x**2/(2.0_dp*n0**2*cos(psi)**2)
        call check_row(page, "n^2 = n0^2 + 2", "y = x tan psi", one, one, rounding)
        n0 = behind(page, "Fibre: n0 = ")
        alpha = behind(page, "alpha = ")
        psi = behind(page, "(a fibre), launched at ")
        sigma = behind(page, "0.8/m, to sigma = ")
        one = sin(psi)/alpha*sin(n0*alpha*sigma)
        call check_row(page, "n^2 = n0^2 (1", "y = (sin(psi)", one, one, 2e-9_dp)
    end subroutine least_time

    subroutine maupertuis()
        !! The envelope of the throws, and the flat throw's time.
        type(report_t) :: page
        real(dp) :: g, v, x, y, one, slope

        call new_page("maupertuis", page)
        g = behind(page, "kg, g = ")
        v = behind(page, "Throws of ")
        x = behind(page, "m/s to a point ")
        y = behind(page, "4 m away, ")
        one = v**2/(2.0_dp*g) - g*x**2/(2.0_dp*v**2)
        call check_row(page, "the envelope", "y of the slope", one, one, rounding)
        slope = (v**2 - sqrt(v**4 - g*(g*x**2 + 2.0_dp*y*v**2)))/(g*x)
        one = 4.0_dp*behind(page, "m = ")*g*x*sqrt(1.0_dp + slope**2)/v/pi
        call check_row(page, "paths of one time", "d/da int p dq = 4", one, one, 1e-10_dp)
    end subroutine maupertuis

    subroutine measure_g()
        !! The time of the fall, the pulley that is not thought of, and the best masses.
        type(report_t) :: page
        real(dp) :: g, h, m, m1, m2, one, scales, watch

        call new_page("measure-g", page)
        g = page%rows(2)%right  ! no note has it
        h = behind(page, "kg, h = ")
        m = behind(page, "is half of it better? M = ")
        m1 = behind(page, "m1 = ")
        m2 = behind(page, "m2 = ")
        call assertEqual(m, m1 + m2, rounding, "M")
        one = sqrt(2.0_dp*h*m/((m1 - m2)*g))
        call check_row(page, "m1 = ", "t = sqrt", one, one, 1e-11_dp)
        one = g*m/(m + behind(page, "I/R^2 = "))
        call check_row(page, "m1 = ", "I/R^2 = ", one, one, 1e-10_dp)
        watch = behind(page, "watch ")
        scales = 1e-3_dp*behind(page, "each mass ")
        one = (2.0_dp*h*scales**2/(m**2*g*watch**2))**(1.0_dp/3.0_dp)
        call check_row(page, "the best difference", "(m1 - m2)/M", one, one, 1e-5_dp)
        one = 1e-3_dp*behind(page, "m1 - m2 = ")/m
        one = sqrt(4.0_dp*watch**2*one*g/(2.0_dp*h) + (1e-3_dp*behind(page, "ruler ")/h)**2 &
                   + 2.0_dp*(1.0_dp + one**2)*scales**2/(m*one)**2)
        call check_row(page, "sigma_g/g", "m1 - m2 = 20 g", one, one, 0.05_dp*one)
    end subroutine measure_g

    subroutine noether()
        !! What a charge keeps in a magnetic field.
        type(report_t) :: page
        real(dp) :: m, eb, x(3), v(3), one

        call new_page("noether", page)
        m = behind(page, "Charge: m = ")
        eb = behind(page, "kg, e = ")*behind(page, "C, B = ")
        x(1:2) = [behind(page, "from ("), behind(page, "from (0.4, ")]
        v(1:2) = [behind(page, "m with ("), behind(page, "m with (0.6, ")]
        one = m*v(1) - eb*x(2)
        call check_row(page, "charge in B", "that is m v_x", one, one, 1e-11_dp)
        one = m*(x(1)*v(2) - x(2)*v(1)) + 0.5_dp*eb*(x(1)**2 + x(2)**2)
        call check_row(page, "charge in B", "x m v_y", one, one, 1e-11_dp)
    end subroutine noether

    subroutine phase_space()
        !! The cloud, what is left of an exponent, the energy of the cart-pendulum.
        type(report_t) :: page
        real(dp) :: m, l, g, b, start, m1, m2, th, x_dot, th_dot, one

        call new_page("phase-space", page)
        m = behind(page, "Pendulum: m = ")
        l = behind(page, "kg, l = ")
        g = behind(page, "m, g = ")
        b = behind(page, "m/s^2, b = ")
        start = pi*behind(page, "the starts within ")**2*m*l**2*sqrt(g/l)
        call check_row(page, "pendulum: the area of", "after 2 s", start, start, 1e-7_dp)
        one = start*exp(-b/(m*l**2)*behind(page, "after "))
        call check_row(page, "pendulum: the area of", "with friction = that", one, one, 1e-7_dp)
        one = log(behind(page, "ln("))/behind(page, ")/(")
        call assertEqual(one, behind(page, " s) = "), 5e-3_dp*one, "what is left")
        call assertEqual(behind(page, "the bound is ")*one, behind(page, "10 sigma, and "), &
                         0.03_dp*one*5.0_dp, "the bound")
        m1 = behind(page, "Cart-pendulum: m1 = ")
        m2 = behind(page, "m2 = ")
        l = behind(page, "0.7 kg, l = ")
        th = behind(page, "H at theta = ")
        x_dot = behind(page, "rad, x_dot = ")
        th_dot = behind(page, "m/s, theta_dot = ")
        one = 0.5_dp*(m1 + m2)*x_dot**2 + m2*l*cos(th)*x_dot*th_dot + 0.5_dp*m2*(l*th_dot)**2 &
              - m2*g*l*cos(th)
        call check_row(page, "cart-pendulum: H", "H = T + V", one, one, rounding)
    end subroutine phase_space

    subroutine reactions()
        !! Forces by hand.
        type(report_t) :: page
        real(dp) :: m, g, big, alpha, one, th0

        call new_page("reactions", page)
        g = behind(page, "m, g = ")
        th0 = behind(page, "th0 = ")
        one = behind(page, "m = m2 = ")*g*cos(th0)
        call check_row(page, "pendulum from rest", "T at the start", one, one, rounding)
        m = behind(page, "block m = ")
        big = behind(page, "wedge M = ")
        alpha = behind(page, "alpha = ")
        one = m*big*g*cos(alpha)/(big + m*sin(alpha)**2)
        call check_row(page, "block on a wedge", "N = m M g", one, one, rounding)
        one = behind(page, "Disk: m = ")*behind(page, "1.3 kg, R = ")*behind(page, "phi_dot = ")* &
              behind(page, "4 rad/s, theta_dot = ")
        call check_row(page, "rolling disk", "along the plane", one, one, 1e-11_dp)
    end subroutine reactions

    subroutine same_motion()
        !! The plane's numbers, and those of the damped oscillator.
        type(report_t) :: page
        real(dp) :: w, x, v, one, m, gamma

        call new_page("same-motion", page)
        w = behind(page, "kg, w = ")
        x = behind(page, "/s, x = ")
        call check_row(page, "oscillator in the plane", "x_ddot", -w**2*x, -w**2*x, rounding)
        one = behind(page, "m/s, y_dot = ")
        call check_row(page, "oscillator in the plane", "p_x' = y_dot", one, one, rounding)
        m = behind(page, "k x^2/2: m = ")
        gamma = behind(page, "N/m, gamma = ")
        v = behind(page, "x_dot = v = ")
        one = -gamma*v - behind(page, "kg, k = ")*x/m
        call check_row(page, "damped oscillator", "x_ddot", one, one, rounding)
        one = exp(gamma*behind(page, "m/s, t = "))*m*v
        call check_row(page, "damped oscillator", "p' = exp", one, one, rounding)
    end subroutine same_motion

    subroutine small_angle()
        !! \(\cos^2\sin\) is largest where \(\tan^2 = 1/2\); the second swing is the one that is
        !! shown, half as wide as the first, and its time the pendulum's.
        type(report_t) :: page
        real(dp) :: m1, m2, first, second, place

        call new_page("small-angle", page)
        place = atan(sqrt(0.5_dp))
        call assertEqual(cos(place)**2*sin(place), behind(page, "2/(3 sqrt(3)) = "), 5e-5_dp, "top")
        first = 1.0_dp/behind(page, "two swings, A = 1/")
        second = 1.0_dp/behind(page, "1/80 and 1/")
        call assertEqual(2.0_dp*second, first, rounding, "half as wide")
        m1 = behind(page, "Cart-pendulum: m1 = ")
        m2 = behind(page, "m2 = ")
        call check_row(page, "what is lost", "(T/T0 - 1)/A^2", (m1 + 4.0_dp*m2)/(16.0_dp*m1), &
                       (m1 + 4.0_dp*m2)/(16.0_dp*m1), 0.1_dp*second**2)
        call check_row(page, "cart-pendulum from rest", "largest theta_ddot/(A", &
                       sin(second)*(m1 + m2)/(m1 + m2*sin(second)**2)*m1/((m1 + m2)*second), &
                       1.0_dp, 1e-11_dp)
    end subroutine small_angle

    subroutine vakonomic()
        !! The time of the turns, and the disk's way along the incline.
        type(report_t) :: page
        real(dp) :: r, kappa, steer, t, one, th

        call new_page("vakonomic", page)
        r = behind(page, "kg, R = ")
        steer = behind(page, "rad/s and theta_dot = ")
        t = behind(page, "as disks roll: ")*2.0_dp*pi/steer
        call assertEqual(t, behind(page, "turns of the heading, "), 0.05_dp, "three digits")
        call assertEqual(t, behind(page, "is theta_ddot = 0?  after "), 0.05_dp, "and here")
        kappa = 2.0_dp*behind(page, "down; g = ")*sin(behind(page, "the incline of "))/(3.0_dp*r)
        call assertEqual(behind(page, "the incline of "), behind(page, "2 g sin("), 0.0_dp, &
                         "the incline")
        one = r*kappa/(2.0_dp*steer)*t
        call check_row(page, "D'Alembert", "y = R kappa", one, one, 1e-10_dp)
        th = behind(page, "steering locked: theta = ")
        call assertEqual(th, behind(page, "steering locked at "), 0.0_dp, "heading")
        t = behind(page, "holonomic constraint; after ")
        one = behind(page, "phi_dot = ")*t + 0.5_dp*kappa*sin(th)*t**2
        call check_row(page, "steering locked", "phi = ", one, one, 1e-10_dp)
    end subroutine vakonomic

    subroutine virtual_work()
        !! Displacements of two pendulums, the power of a wire.
        type(report_t) :: page
        real(dp) :: l1, l2, th(2), d(2), one, two, l, a, w, t

        call new_page("virtual-work", page)
        l1 = behind(page, "l1 = ")
        l2 = behind(page, "l2 = ")
        th = [behind(page, "th1 = "), behind(page, "th2 = ")]
        d = [behind(page, ", dth1 = "), behind(page, ", dth2 = ")]
        one = l1*cos(th(1))*d(1) + l2*cos(th(2))*d(2)
        call check_row(page, "virtual displacements", "delta x2 = l1", one, one, rounding)
        l = behind(page, "Driven pendulum: l = ")
        a = behind(page, "cos(W t), a = ")
        w = behind(page, "m, W = ")
        t = behind(page, "5 rad/s, t = ")
        two = l*sin(behind(page, "s, th = "))*behind(page, "rad, dth = ")
        call check_row(page, "virtual displacements", "driven pendulum", two, two, rounding)
        one = two - a*w*sin(w*t)*behind(page, "dt = ")
        call check_row(page, "virtual displacements", "dy = l sin(th)", one, one, rounding)
        one = 2.0_dp*behind(page, "Bead: m = ")*behind(page, "kg, W = ")**2* &
              behind(page, "1.5 rad/s, r = ")*behind(page, "m, r_dot = ")
        call check_row(page, "bead", "power", one, one, rounding)
        one = -behind(page, "m2 = ")*behind(page, "m, g = ")*l2*sin(th(2))
        call check_row(page, "double pendulum", "Q_2 = ", one, one, 1e-11_dp)
    end subroutine virtual_work
end module test_page_numbers
