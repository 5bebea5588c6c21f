module lagrangia_phase_space
    !! Phase space in numbers: H from L, the area that a cloud of starts keeps, the period as the
    !! slope of an area, and how fast neighbours part.
    use lagrangia_cart_pendulum, only: cart_pendulum_t
    use lagrangia_computed_path, only: compute_path
    use lagrangia_double_pendulum, only: double_pendulum_t
    use lagrangia_elliptic, only: elliptic_k
    use lagrangia_errors, only: error_t
    use lagrangia_hyperdual, only: hyperdual, hyperdual_t
    use lagrangia_integrator, only: dense_integrator_t
    use lagrangia_kinds, only: dp
    use lagrangia_lyapunov, only: lyapunov_exponent
    use lagrangia_methods, only: new_adaptive
    use lagrangia_number_text, only: rounded
    use lagrangia_pendulum, only: pendulum_t
    use lagrangia_report, only: report_t
    use lagrangia_richardson, only: extrapolated
    use lagrangia_system, only: system_t
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: phase_space_principle

    real(dp), parameter :: pi = acos(-1.0_dp)
    real(dp), parameter :: m = 0.5_dp, l = 0.8_dp, g = 9.81_dp, w0 = sqrt(g/l)
    real(dp), parameter :: inertia = m*l**2, damping = 0.1_dp   !! kg m^2; kg m^2/s
    integer, parameter :: finest = 800                          !! points of a cloud's rim
    integer, parameter :: steps = 100
    real(dp), parameter :: late = 2.0_dp                        !! s
    real(dp), parameter :: from = 100.0_dp, till = 400.0_dp     !! s, of an exponent
    real(dp), parameter :: left_over = log(till/from)/(till - from)
    !! 1/s, of neighbours that part as t
    real(dp), parameter :: regular = 5.0_dp*left_over           !! 1/s; above: chaos

contains

    subroutine phase_space_principle(report, error)
        !! All statements, and the picture.
        type(report_t), intent(out) :: report  !! the result
        type(error_t), allocatable, intent(out) :: error  !! allocated where it fails

        call report%begin("phase-space: H from L; a cloud of starts keeps its area; "// &
                          "neighbours part")
        call report%cite("II", 58, "\frac{\partial \mathcal{L}}{\partial q_j} - "// &
                         "\frac{d}{dt} \frac{\partial \mathcal{L}}{\partial "// &
                         "\dot{q}_j} = 0")
        call legendre(report, error)
        if (.not. allocated(error)) call clouds(report, error)
        if (allocated(error)) return
        call areas_and_periods(report)
        call exponents(report, error)
        if (.not. allocated(error)) call draw_clouds(report, error)
        call report%note("Cloud: the starts within 0.3 of theta = 1 rad, theta_dot/w0 = 0. "// &
                         "Area in J s.")
        call report%note("Exponents from "//to_text(nint(from))//" s to "//to_text(nint(till))// &
                         " s; the chaotic one from 90 degrees, at rest. Without "// &
                         "chaos neighbours")
        call report%note("part as t, not as exp(t): what is left is of size ln("// &
                         to_text(nint(till/from))//")/("//to_text(nint(till - from))//" s) = "// &
                         rounded(left_over, 3)//"/s; the bound is")
        call report%note(to_text(nint(regular/left_over))//" times that. Pendulum: m = "// &
                         to_text(m)//" kg, l = "//to_text(l)//" m, g = "//to_text(g)// &
                         " m/s^2, b = "//to_text(damping)//" kg m^2/s,")
        call report%note("w0^2 = g/l, gamma = b/(m l^2); K: the complete elliptic integral "// &
                         "of k = sin(theta0/2).")
        call report%note("Cart-pendulum: m1 = 1.3 kg, m2 = 0.7 kg, l = 0.9 m; H at theta = "// &
                         "1.1 rad, x_dot = 0.8")
        call report%note("m/s, theta_dot = -1.3 rad/s; its exponent from rest at 2 rad. "// &
                         "Double pendulum: 1 kg, 1 m")
        call report%note("each; without g from 0.4 and -1.1 rad with 0.7 and 1.9 rad/s. "// &
                         "sigma: the exponent's")
        call report%note("standard error.")
    end subroutine phase_space_principle

    subroutine legendre(report, error)
        !! \(H = p\dot q - L\), \(\dot q = \partial H/\partial p\),
        !! \(\dot p = -\partial H/\partial q = \partial L/\partial q\).
        type(report_t), intent(inout) :: report
        type(error_t), allocatable, intent(out) :: error
        real(dp), parameter :: q(2) = [0.4_dp, 1.1_dp], v(2) = [0.8_dp, -1.3_dp]
        type(cart_pendulum_t) :: cart
        real(dp) :: p(2), force(2)

        call cart%configure([1.3_dp, 0.7_dp, 0.9_dp, g], error)
        if (allocated(error)) return
        call cart%momenta(0.0_dp, q, v, p)
        call cart%forces(0.0_dp, q, v, force)
        call report%section("cart-pendulum: H(q, p) = sum of p q_dot - L, differentiated")
        call report%equal("H = T + V  [J]", hamiltonian(cart, q, p), &
                          0.5_dp*2.0_dp*v(1)**2 + 0.5_dp*0.7_dp*0.81_dp*v(2)**2 &
                          + 0.7_dp*0.9_dp*v(1)*v(2)*cos(q(2)) - 0.7_dp*0.9_dp*g*cos(q(2)), 1e-13_dp)
        call report%equal("dH/dp_x = x_dot  [m/s]", slope([0.0_dp, 0.0_dp], [1.0_dp, 0.0_dp]), &
                          v(1), 1e-10_dp)
        call report%equal("dH/dp_theta = theta_dot  [rad/s]", &
                          slope([0.0_dp, 0.0_dp], [0.0_dp, 1.0_dp]), v(2), 1e-10_dp)
        call report%equal("-dH/dtheta at fixed p = dL/dtheta  [N m]", &
                          -slope([0.0_dp, 1.0_dp], [0.0_dp, 0.0_dp]), force(2), 1e-10_dp)
        call report%equal("is -dH/dtheta = -dV/dtheta?", &
                          -slope([0.0_dp, 1.0_dp], [0.0_dp, 0.0_dp]), &
                          -0.7_dp*0.9_dp*g*sin(q(2)), 1e-10_dp, control=.true.)
    contains
        pure function slope(along_q, along_p) result(d)
            !! Of H, by differences over ever smaller steps.
            real(dp), intent(in) :: along_q(2), along_p(2)
            real(dp) :: d
            real(dp) :: values(5), h
            integer :: i

            do i = 1, size(values)
                h = 0.1_dp/2.0_dp**(i - 1)
                values(i) = (hamiltonian(cart, q + h*along_q, p + h*along_p) &
                             - hamiltonian(cart, q - h*along_q, p - h*along_p))/(2.0_dp*h)
            end do
            d = extrapolated(values)
        end function slope
    end subroutine legendre

    pure function hamiltonian(system, q, p) result(h)
        !! \(p\dot q - L\) at the velocities that belong to p.
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: q(system%ndof), p(system%ndof)
        real(dp) :: h
        real(dp) :: v(system%ndof)
        type(hyperdual_t) :: l

        call system%velocities(0.0_dp, q, p, v)
        l = system%lagrangian(hyperdual(0.0_dp), hyperdual(q), hyperdual(v))
        h = dot_product(p, v) - l%re
    end function hamiltonian

    subroutine follow_rim(pendulum, number, time, rim, error)
        !! Where the rim of the cloud is after some time, (theta, p).
        class(system_t), intent(in) :: pendulum
        integer, intent(in) :: number      !! of points
        real(dp), intent(in) :: time       !! s
        real(dp), intent(out) :: rim(2, number)
        type(error_t), allocatable, intent(out) :: error
        real(dp) :: q(1, steps + 1), v(1, steps + 1), angle
        integer :: i

        rim = 0.0_dp
        do i = 1, number
            angle = 2.0_dp*pi*i/number
            call compute_path("gauss16", pendulum, 0.0_dp, time/steps, &
                              [1.0_dp + 0.3_dp*cos(angle)], [0.3_dp*w0*sin(angle)], q, v, error)
            if (allocated(error)) return
            rim(:, i) = [q(1, steps + 1), inertia*v(1, steps + 1)]
        end do
    end subroutine follow_rim

    pure function area_of(rim) result(area)
        !! Of the curve through the points, the limit of ever finer polygons.
        real(dp), intent(in) :: rim(:, :)
        real(dp) :: area
        real(dp) :: areas(5)
        integer :: i, k, n, by

        do i = 1, size(areas)
            by = 2**(size(areas) - i)
            n = size(rim, 2)/by
            areas(i) = 0.0_dp
            do k = 1, n
                associate (a => rim(:, k*by), b => rim(:, modulo(k, n)*by + by))
                    areas(i) = areas(i) + 0.5_dp*(a(1)*b(2) - a(2)*b(1))
                end associate
            end do
        end do
        area = abs(extrapolated(areas))
    end function area_of

    subroutine clouds(report, error)
        !! Liouville; with friction the area shrinks as \(e^{-\gamma t}\), \(\gamma = b/ml^2\).
        type(report_t), intent(inout) :: report
        type(error_t), allocatable, intent(out) :: error
        type(pendulum_t) :: free, damped
        real(dp) :: rim(2, finest), start, later

        call free%configure([m, l, g], error)
        if (.not. allocated(error)) call damped%configure([m, l, g, damping], error)
        if (.not. allocated(error)) call follow_rim(free, finest, late, rim, error)
        if (allocated(error)) return
        start = pi*0.3_dp**2*inertia*w0
        later = area_of(rim)
        call report%section("pendulum: the area of a cloud of starts in phase space  [J s]")
        call report%equal("after 2 s = at the start, pi 0.3^2 m l^2 w0", later, start, 1e-8_dp)
        call follow_rim(damped, finest, late, rim, error)
        if (allocated(error)) return
        call report%equal("with friction = that times exp(-gamma t)", area_of(rim), &
                          start*exp(-damping/inertia*late), 1e-8_dp)
        call report%equal("with friction: is it kept?", area_of(rim), start, 1e-8_dp, &
                          control=.true.)
    end subroutine clouds

    pure function inside(amplitude) result(area)
        !! \(J = \oint p\,d\theta = \int ml^2\dot\theta^2\,dt\) of a swing, by its energy; with
        !! \(\sin(\theta/2) = \sin(\theta_0/2)\sin\varphi\) it is a smooth periodic function's.
        real(dp), intent(in) :: amplitude
        real(dp) :: area
        integer, parameter :: n = 400
        real(dp) :: k, phi
        integer :: i

        k = sin(0.5_dp*amplitude)
        area = 0.0_dp
        do i = 1, n
            phi = 2.0_dp*pi*i/n
            area = area + 4.0_dp*inertia*w0*k**2*cos(phi)**2/sqrt(1.0_dp - (k*sin(phi))**2)*2.0_dp &
                   *pi/n
        end do
    end function inside

    subroutine areas_and_periods(report)
        !! \(T = dJ/dE\).
        type(report_t), intent(inout) :: report
        real(dp), parameter :: amplitudes(3) = [0.5_dp, 1.5_dp, 2.5_dp]
        real(dp) :: values(4), e, h
        integer :: i, k

        call report%section("pendulum: the area J = int p dtheta within a swing, and T = "// &
                            "dJ/dE  [s]")
        do i = 1, size(amplitudes)
            associate (a => amplitudes(i))
                e = energy_of(a)
                do k = 1, size(values)
                    h = 0.02_dp*(energy_of(3.0_dp) - e)/2.0_dp**(k - 1)
                    values(k) = (inside(at_energy(e + h)) - inside(at_energy(e - h)))/(2.0_dp*h)
                end do
                call report%equal("from "//to_text(a)//" rad: dJ/dE = 4 K/w0", &
                                  extrapolated(values), 4.0_dp*elliptic_k(cos(0.5_dp*a))/w0, &
                                  1e-9_dp)
            end associate
        end do
        call report%equal("is it 2 pi/w0 from 2.5 rad, too?", extrapolated(values), 2.0_dp*pi/w0, &
                          1e-9_dp, control=.true.)
    contains
        pure function energy_of(amplitude) result(energy)
            real(dp), intent(in) :: amplitude
            real(dp) :: energy

            energy = 2.0_dp*m*g*l*sin(0.5_dp*amplitude)**2
        end function energy_of

        pure function at_energy(energy) result(amplitude)
            real(dp), intent(in) :: energy
            real(dp) :: amplitude

            amplitude = 2.0_dp*asin(sqrt(energy/(2.0_dp*m*g*l)))
        end function at_energy
    end subroutine areas_and_periods

    subroutine exponents(report, error)
        !! Chaos is an exponent above zero; three motions without any.
        type(report_t), intent(inout) :: report
        type(error_t), allocatable, intent(out) :: error
        type(cart_pendulum_t) :: cart
        type(double_pendulum_t) :: two
        real(dp) :: exponent, sigma

        call report%section("how fast neighbours part: Lyapunov's exponent  [1/s]")
        call two%configure([1.0_dp, 1.0_dp, 1.0_dp, 1.0_dp, g], error)
        if (.not. allocated(error)) call measure(two, [0.5_dp*pi, 0.5_dp*pi], [0.0_dp, 0.0_dp])
        if (allocated(error)) return
        call report%at_least("double pendulum: above 10 sigma, and "// &
                             rounded(regular, 2), exponent, max(10.0_dp*sigma, regular), 0.0_dp)
        call report%equal("is it 0, as without chaos?", exponent, 0.0_dp, regular, &
                          control=.true.)
        call two%configure([1.0_dp, 1.0_dp, 1.0_dp, 1.0_dp, 0.0_dp], error)
        if (.not. allocated(error)) call measure(two, [0.4_dp, -1.1_dp], [0.7_dp, 1.9_dp])
        if (allocated(error)) return
        call report%equal("double pendulum without g: 0, it has L_z", exponent, 0.0_dp, regular)
        call cart%configure([1.3_dp, 0.7_dp, 0.9_dp, g], error)
        if (.not. allocated(error)) call measure(cart, [0.0_dp, 2.0_dp], [0.0_dp, 0.0_dp])
        if (allocated(error)) return
        call report%equal("cart-pendulum: 0, it has p_x", exponent, 0.0_dp, regular)
    contains
        subroutine measure(system, q0, v0)
            class(system_t), intent(in) :: system
            real(dp), intent(in) :: q0(:), v0(:)
            class(dense_integrator_t), allocatable :: method

            call new_adaptive("dop853", method)
            method%tolerance = 1e-8_dp
            call lyapunov_exponent(system, method, 0.0_dp, from, till, q0, v0, exponent, &
                                   sigma, error)
        end subroutine measure
    end subroutine exponents

    subroutine draw_clouds(report, error)
        !! The picture: the cloud's rim now and then, in one line with the way of one of its points.
        type(report_t), intent(inout) :: report
        type(error_t), allocatable, intent(out) :: error
        integer, parameter :: points = 120, times = 4
        real(dp), parameter :: interval = 0.35_dp  !! s, from one to the next
        type(pendulum_t) :: free
        real(dp) :: rim(2, points), q(1, steps + 1), v(1, steps + 1)
        integer :: i, k, row

        call free%configure([m, l, g], error)
        if (allocated(error)) return
        report%picture%file = "principle_phase_space"
        report%picture%title = "A cloud of starts goes round, is drawn out, and keeps its area"
        report%picture%names = [character(32) :: "theta", "theta_dot/omega0"]
        report%picture%units = [character(16) :: "rad", "rad"]
        report%picture%panels = [character(98) :: "theta:theta_dot/omega0"]
        allocate (report%picture%values(2, times*(points + 1) + (times - 1)*steps))
        row = 0
        do i = 1, times
            call follow_rim(free, points, max((i - 1)*interval, 1e-9_dp), rim, error)
            if (allocated(error)) return
            do k = 0, points
                row = row + 1
                report%picture%values(:, row) = rim(:, modulo(k - 1, points) + 1) &
                                                /[1.0_dp, inertia*w0]
            end do
            if (i == times) exit
            ! the point at angle 0 goes on to the next moment
            call compute_path("gauss16", free, 0.0_dp, interval/steps, &
                              rim(1:1, points), rim(2:2, points)/inertia, q, v, error)
            if (allocated(error)) return
            do k = 2, steps + 1
                row = row + 1
                report%picture%values(:, row) = [q(1, k), v(1, k)/w0]
            end do
        end do
    end subroutine draw_clouds
end module lagrangia_phase_space
