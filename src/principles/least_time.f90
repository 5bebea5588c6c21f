module lagrangia_least_time
    !! Hero's and Fermat's principles in numbers: light takes a path of stationary time.
    !!
    !! The notes say that it takes the shortest path, the least time. A concave mirror shows the
    !! longest one, an elliptic mirror makes all equal.
    use lagrangia_computed_path, only: compute_path
    use lagrangia_errors, only: error_t
    use lagrangia_gsl, only: brent_root
    use lagrangia_kinds, only: dp
    use lagrangia_optical_paths, only: concave_mirror_t, elliptic_mirror_t, flat_mirror_t, &
                                       graded_medium_t, quartic_t, second_derivative, &
                                       stationary_point, surface_t
    use lagrangia_report, only: report_t
    implicit none (type, external)
    private
    public :: least_time_principle

    real(dp), parameter :: rounding = 1e-14_dp  !! lengths of a few metres, a few operations
    type(flat_mirror_t), parameter :: flat = flat_mirror_t(a=1.2_dp, b=2.5_dp, d=3.0_dp)
    type(concave_mirror_t), parameter :: concave = concave_mirror_t(r=2.0_dp, s=1.5_dp)
    type(elliptic_mirror_t), parameter :: elliptic = elliptic_mirror_t(a=2.5_dp, b=2.0_dp)
    type(surface_t), parameter :: glass = surface_t(a=1.2_dp, b=0.8_dp, d=2.0_dp, n1=1.0_dp, &
                                                    n2=1.5_dp)

contains

    subroutine least_time_principle(report, error)
        !! All statements, and the picture.
        type(report_t), intent(out) :: report  !! the result
        type(error_t), allocatable, intent(out) :: error  !! allocated where it fails
        real(dp) :: crossing

        call report%begin("least-time: light takes a path of stationary time, not always the least")
        call report%cite("II", 5, "reflection of light always takes the shortest path")
        call report%cite("II", 6, "a path that requires the least time.")
        call by_mirrors(report, error)
        if (allocated(error)) return
        call into_glass(report, crossing, error)
        if (allocated(error)) return
        call over_hot_air(report, error)
        if (allocated(error)) return
        call along_a_fibre(report, error)
        if (allocated(error)) return
        call draw_paths(report, crossing)
        call report%note("P: the optical path, sum of n ds; u: where the ray touches the "// &
                         "mirror. Hero: a = 1.2 m,")
        call report%note("b = 2.5 m, d = 3 m, x from the foot of a. Concave: R = 2 m, s = "// &
                         "1.5 m. Fermat: x from")
        call report%note("the foot of the first point, angles from the perpendicular. "// &
                         "Mirage: n0 = 1.3, kappa =")
        call report%note("0.2/m, to sigma = 4 m. Fibre: n0 = 1.5, alpha = 0.8/m, to sigma = "// &
                         "10 m; both from x = y")
        call report%note("= 0. psi: angle between ray and layers; sigma: along the ray, ds "// &
                         "= n dsigma.")
    end subroutine least_time_principle

    subroutine by_mirrors(report, error)
        !! Shortest, longest, all equal.
        type(report_t), intent(inout) :: report
        type(error_t), allocatable, intent(out) :: error
        real(dp) :: x, u, path(72), c
        integer :: i

        call report%section("Hero, flat mirror: points 1.2 m and 2.5 m before it, 3 m apart")
        call stationary_point(flat, 0.0_dp, flat%d, x, error)
        if (allocated(error)) return
        associate (a => flat%a, b => flat%b, d => flat%d)
            call report%equal("x = a d/(a + b)  [m]", x, a*d/(a + b), rounding)
            call report%equal("P = sqrt(d^2 + (a + b)^2)  [m]", flat%at(x), hypot(d, a + b), &
                              rounding)
            call report%equal("sin(angle in) = sin(angle out)", x/hypot(a, x), &
                              (d - x)/hypot(b, d - x), rounding)
            call report%equal("d2P/dx2 > 0: shortest  [1/m]", second_derivative(flat, x), &
                              a**2/hypot(a, x)**3 + b**2/hypot(b, d - x)**3, rounding)
            call report%at_least("P touching 0.1 m beside is not less  [m]", flat%at(x + 0.1_dp), &
                                 flat%at(x), 0.0_dp)
        end associate
        call report%section("concave mirror, radius 2 m, points on a diameter at -1.5 m "// &
                            "and 1.5 m", slip="E16")
        call stationary_point(concave, -0.5_dp, 0.7_dp, u, error)
        if (allocated(error)) return
        associate (r => concave%r, s => concave%s)
            c = hypot(r, s)
            call report%equal("u = 0, the mirror's middle  [rad]", u, 0.0_dp, rounding)
            call report%equal("P = 2 sqrt(R^2 + s^2)  [m]", concave%at(u), 2.0_dp*c, rounding)
            call report%equal("d2P/du2 = -2 R^2 s^2/(R^2 + s^2)^(3/2)  [m]", &
                              second_derivative(concave, u), -2.0_dp*(r*s)**2/c**3, rounding)
            call report%at_least("is P shortest?  0.1 rad beside  [m]", concave%at(u + 0.1_dp), &
                                 concave%at(u), 0.0_dp, control=.true.)
        end associate
        call report%section("elliptic mirror, semi-axes 2.5 m and 2 m, points in the foci", &
                            slip="E16")
        do i = 1, size(path)
            path(i) = elliptic%at(0.1_dp*i)
        end do
        call report%equal("longest of 72 paths is 2 a  [m]", maxval(path), 2.0_dp*elliptic%a, &
                          rounding)
        call report%equal("shortest of 72 paths is 2 a  [m]", minval(path), 2.0_dp*elliptic%a, &
                          rounding)
    end subroutine by_mirrors

    subroutine into_glass(report, x, error)
        !! Fermat's refraction, and Snell's law.
        type(report_t), intent(inout) :: report
        real(dp), intent(out) :: x
        type(error_t), allocatable, intent(out) :: error
        type(quartic_t) :: snell
        real(dp) :: root, straight

        x = 0.0_dp
        call report%section("Fermat, air to glass (n 1 to 1.5): 1.2 m above to 0.8 m below, "// &
                            "2 m apart")
        call stationary_point(glass, 0.0_dp, glass%d, x, error)
        if (allocated(error)) return
        snell%surface = glass
        call brent_root(snell, 0.0_dp, glass%d, root, error)
        if (allocated(error)) return
        associate (a => glass%a, b => glass%b, d => glass%d, n1 => glass%n1, n2 => glass%n2)
            call report%equal("crossing point, root of Snell's quartic  [m]", x, root, rounding)
            call report%equal("n1 sin(angle 1) = n2 sin(angle 2)", n1*x/hypot(a, x), &
                              n2*(d - x)/hypot(b, d - x), rounding)
            call report%equal("d2P/dx2 > 0: least time  [1/m]", second_derivative(glass, x), &
                              n1*a**2/hypot(a, x)**3 + n2*b**2/hypot(b, d - x)**3, rounding)
            straight = a*d/(a + b)
            call report%at_least("P of the straight line is not less  [m]", glass%at(straight), &
                                 glass%at(x), 0.0_dp)
            call report%equal("does the straight line obey Snell's law?", &
                              n1*straight/hypot(a, straight), &
                              n2*(d - straight)/hypot(b, d - straight), rounding, control=.true.)
        end associate
    end subroutine into_glass

    subroutine over_hot_air(report, error)
        !! \(n^2 = n_0^2 + 2\kappa y\): the ray is a parabola, a stone's path upside down.
        type(report_t), intent(inout) :: report
        type(error_t), allocatable, intent(out) :: error
        real(dp), parameter :: n0 = 1.3_dp, kappa = 0.2_dp, psi = -0.35_dp, step = 0.01_dp
        integer, parameter :: n = 400
        type(graded_medium_t) :: air
        real(dp) :: q(2, n + 1), v(2, n + 1), length(n + 1)
        real(dp) :: simpson, path, end_sigma, chord, first, last

        call report%section("n^2 = n0^2 + 2 kappa y (a mirage), launched at -0.35 rad: by RK4")
        call air%configure([n0, kappa, 0.0_dp], error)
        if (allocated(error)) return
        call compute_path("rk4", air, 0.0_dp, step, [0.0_dp, 0.0_dp], n0*[cos(psi), sin(psi)], &
                          q, v, error)
        if (allocated(error)) return
        associate (x => q(1, n + 1), y => q(2, n + 1))
            call report%equal("y = x tan psi + kappa x^2/(2 n0^2 cos^2 psi)", y, &
                              x*tan(psi) + 0.5_dp*kappa*(x/(n0*cos(psi)))**2, 1e-13_dp)
            call layers(air, q, v, 1e-13_dp, report)
            end_sigma = n*step
            length = sqrt(air%index_squared(q(2, :)))*hypot(v(1, :), v(2, :))  ! n ds/dsigma
            simpson = step/3.0_dp*(sum(length(1:n - 1:2)) + 4.0_dp*sum(length(2:n:2)) &
                                   + sum(length(3:n + 1:2)))
            path = n0**2*end_sigma + kappa*n0*sin(psi)*end_sigma**2 + kappa**2*end_sigma**3/3.0_dp
            call report%equal("P of the ray = integral of n^2 dsigma  [m]", simpson, path, 1e-12_dp)
            chord = hypot(x, y)
            first = sqrt(air%index_squared(0.0_dp))
            last = sqrt(air%index_squared(y))
            call report%at_least("P of the straight line is not less  [m]", &
                                 chord*(last**3 - first**3)/(3.0_dp*kappa*y), simpson, 0.0_dp)
        end associate
    end subroutine over_hot_air

    subroutine along_a_fibre(report, error)
        !! \(n^2 = n_0^2(1-\alpha^2y^2)\): the ray swings about the axis.
        type(report_t), intent(inout) :: report
        type(error_t), allocatable, intent(out) :: error
        real(dp), parameter :: n0 = 1.5_dp, alpha = 0.8_dp, psi = 0.3_dp, step = 0.01_dp
        integer, parameter :: n = 1000
        type(graded_medium_t) :: fibre
        real(dp) :: q(2, n + 1), v(2, n + 1), sigma, bound

        call report%section("n^2 = n0^2 (1 - alpha^2 y^2) (a fibre), launched at 0.3 rad: by RK4")
        call fibre%configure([n0, 0.0_dp, alpha], error)
        if (allocated(error)) return
        call compute_path("rk4", fibre, 0.0_dp, step, [0.0_dp, 0.0_dp], n0*[cos(psi), sin(psi)], &
                          q, v, error)
        if (allocated(error)) return
        sigma = n*step
        ! RK4's phase error is z**5/120 a step, z = n0 alpha h; Y_m times the phase's error
        bound = sin(psi)/alpha*n*(n0*alpha*step)**5/60.0_dp
        call report%equal("y = (sin(psi)/alpha) sin(n0 alpha sigma)  [m]", q(2, n + 1), &
                          sin(psi)/alpha*sin(n0*alpha*sigma), bound)
        call report%equal("x = n0 cos(psi) sigma  [m]", q(1, n + 1), n0*cos(psi)*sigma, 1e-12_dp)
        ! RK4 takes z**6/72 of the swing's energy a step
        call layers(fibre, q, v, n*(n0*alpha*step)**6/72.0_dp + 1e-13_dp, report)
    end subroutine along_a_fibre

    subroutine layers(medium, q, v, bound, report)
        !! Snell's law in layers: \(n\cos\psi\) where it is farthest from its start.
        type(graded_medium_t), intent(in) :: medium
        real(dp), intent(in) :: q(:, :), v(:, :), bound
        type(report_t), intent(inout) :: report
        real(dp) :: slope(size(q, 2)), layer(size(q, 2))

        slope = v(1, :)/hypot(v(1, :), v(2, :))
        layer = sqrt(medium%index_squared(q(2, :)))*slope
        call report%equal("n cos(psi), start and farthest from it", layer(1), &
                          layer(maxloc(abs(layer - layer(1)), 1)), bound)
        call report%equal("is cos(psi) alone constant?", slope(1), &
                          slope(maxloc(abs(slope - slope(1)), 1)), bound, control=.true.)
    end subroutine layers

    subroutine draw_paths(report, crossing)
        !! The picture: optical paths over where the ray touches, less that of the light's ray.
        type(report_t), intent(inout) :: report
        real(dp), intent(in) :: crossing
        integer, parameter :: samples = 101
        real(dp) :: u, x
        integer :: j

        report%picture%file = "principle_least_time"
        report%picture%title = "Optical path of rays that touch elsewhere, less the actual one"
        report%picture%names = [character(32) :: "offset", "flat_mirror", "concave_mirror", &
                                "elliptic_mirror", "into_glass"]
        report%picture%units = [character(16) :: "m", "m", "m", "m", "m"]
        report%picture%panels = [character(98) :: &
                                 "offset:flat_mirror+concave_mirror+elliptic_mirror+into_glass"]
        allocate (report%picture%values(5, samples))
        x = flat%a*flat%d/(flat%a + flat%b)
        do j = 1, samples
            u = (j - 1)*2.0_dp/(samples - 1) - 1.0_dp
            report%picture%values(1, j) = u
            report%picture%values(2, j) = flat%at(x + u) - flat%at(x)
            report%picture%values(3, j) = concave%at(u/concave%r) - concave%at(0.0_dp)
            report%picture%values(4, j) = elliptic%at(u/elliptic%a) - elliptic%at(0.0_dp)
            report%picture%values(5, j) = glass%at(crossing + u) - glass%at(crossing)
        end do
    end subroutine draw_paths
end module lagrangia_least_time
