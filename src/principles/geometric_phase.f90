module lagrangia_geometric_phase
    !! Geometric phase: what comes back to where it was, and is not where it was. A disk whose roll
    !! and heading go around a loop is displaced by an area,
    !! $$ \Delta x = R\oint\sin\theta\,d\varphi = R\iint\cos\theta\,d\theta\,d\varphi, $$
    !! however fast it goes; Foucault's pendulum turns by \(2\pi\sin\lambda\) in a day.
    use lagrangia_charged_particle, only: charged_particle_t
    use lagrangia_computed_path, only: compute_path
    use lagrangia_constraints, only: loop_of_disk
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp
    use lagrangia_report, only: report_t
    use lagrangia_rolling_disk, only: rolling_disk_t
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: geometric_phase_principle

    real(dp), parameter :: pi = acos(-1.0_dp)
    real(dp), parameter :: rounding = 1e-13_dp  !! of sums of 4000 terms below 0.01
    real(dp), parameter :: r = 0.3_dp, heading = 0.4_dp       !! m, rad
    real(dp), parameter :: day = 60.0_dp, m = 1.0_dp, k = 4.0_dp  !! s, of a small planet; kg; N/m
    integer, parameter :: samples = 6001                      !! of a day

contains

    subroutine geometric_phase_principle(report, error)
        !! All statements, and the picture.
        type(report_t), intent(out) :: report  !! the result
        type(error_t), allocatable, intent(out) :: error  !! allocated where it fails
        type(rolling_disk_t) :: disk

        call report%begin("geometric-phase: around a loop and back, and yet displaced or turned")
        call report%cite("I", 126, "\Rightarrow \sum_{i} A_{i} \dot{q}_{i} + B = 0$$")
        call report%cite("I", 132, "\frac{\partial A_{\varphi}}{\partial \theta} = -R\cos\theta")
        call disk%configure([m, r, 0.5_dp*m*r**2, 0.25_dp*m*r**2, 9.81_dp, 0.0_dp], error)
        if (allocated(error)) return
        call four_legs(disk, report, error)
        if (allocated(error)) return
        call round_loop(disk, report)
        call foucault(report, error)
        if (allocated(error)) return
        call draw_displacement(report)
        call report%note("The disk: R = "//to_text(r)//" m.")
        call report%note("Foucault: a trap with k/m = 4/s^2 on a planet whose day has 60 s, "// &
                         "W = 2 pi/day;")
        call report%note("e B/m = 2 W sin(latitude).")
        call report%note("The disk's constraints are dx = R sin(theta) dphi, dy = -R "// &
                         "cos(theta) dphi; theta = 0.4")
        call report%note("where the legs begin. The circle: theta = 0.4 + rho cos(s), phi = "// &
                         "rho sin(s), rho = 0.8,")
        call report%note("s from 0 to 2 pi; J1: Bessel's function of order 1.")
    end subroutine geometric_phase_principle

    pure function rolled(disk, theta, d_phi) result(shift)
        !! As far as the rolling condition takes it, at the heading theta.
        type(rolling_disk_t), intent(in) :: disk
        real(dp), intent(in) :: theta, d_phi
        real(dp) :: shift(2), v(4)
        type(error_t), allocatable :: error

        call disk%complete_velocities(0.0_dp, [0.0_dp, 0.0_dp, 0.0_dp, theta], [d_phi, 0.0_dp], v, &
                                      error)
        shift = v(:2)
    end function rolled

    pure function after_legs(disk, d_theta, d_phi) result(shift)
        !! Roll by d_phi, steer by d_theta, roll back, steer back.
        type(rolling_disk_t), intent(in) :: disk
        real(dp), intent(in) :: d_theta, d_phi
        real(dp) :: shift(2)

        shift = rolled(disk, heading, d_phi) + rolled(disk, heading + d_theta, -d_phi)
    end function after_legs

    subroutine four_legs(disk, report, error)
        !! Over \(-R(\cos\theta, \sin\theta)\,d\theta\,d\varphi\) the ratio goes to one.
        type(rolling_disk_t), intent(in) :: disk
        type(report_t), intent(inout) :: report
        type(error_t), allocatable, intent(out) :: error
        real(dp), parameter :: small(3) = [0.1_dp, 0.01_dp, 0.001_dp]
        real(dp), allocatable :: path(:, :)
        real(dp) :: shift(2), along(3)
        integer :: i

        do i = 1, size(small)
            shift = after_legs(disk, small(i), small(i))
            along(i) = shift(1)/(-r*cos(heading)*small(i)**2)
        end do
        call report%section("disk: roll by d, steer by d, roll back, steer back: "// &
                            "delta x/(-R cos(theta) d^2)")
        do i = 1, size(small)
            ! (sin(theta + d) - sin(theta))/(d cos(theta)) = 1 - tan(theta) d/2 - d^2/6 + ...
            call report%equal("d = "//to_text(small(i))//": 1 - d tan(theta)/2 - d^2/6", &
                              along(i), &
                                  1.0_dp - 0.5_dp*small(i)*tan(heading) - small(i)**2/6.0_dp, &
                              small(i)**3 + 1e-12_dp)
        end do
        shift = after_legs(disk, small(1), small(1))
        call report%equal("delta y = R d (cos(theta + d) - cos(theta))", shift(2), &
                          r*small(1)*(cos(heading + small(1)) - cos(heading)), rounding)
        call loop_of_disk([heading, heading], small(1), path, error)
        if (allocated(error)) return
        call report%equal("steering locked, simulated: delta x = 0  [m]", &
                          path(2, size(path, 2)) - path(2, 1), 0.0_dp, rounding)
        shift = after_legs(disk, small(1), small(1))
        call report%equal("is it back, delta x = 0?  d = 0.1  [m]", shift(1), 0.0_dp, 1e-6_dp, &
                          control=.true.)
    end subroutine four_legs

    pure function around(disk, radius, turns) result(shift)
        !! \(\theta\) and \(\varphi\) on a circle; the sum over a whole period converges as fast as
        !! a series of Fourier's does.
        type(rolling_disk_t), intent(in) :: disk
        real(dp), intent(in) :: radius, turns
        real(dp) :: shift(2)
        integer, parameter :: n = 4000
        real(dp) :: s
        integer :: i

        shift = 0.0_dp
        do i = 1, n
            s = 2.0_dp*pi*turns*i/n
            associate (theta => heading + radius*cos(s), d_phi => radius*cos(s)*2.0_dp*pi*turns/n)
                shift = shift + rolled(disk, theta, d_phi)
            end associate
        end do
    end function around

    subroutine round_loop(disk, report)
        !! The area's integral over a circle of radius \(\rho\): \(2\pi\rho J_1(\rho)\cos\theta_0\).
        type(rolling_disk_t), intent(in) :: disk
        type(report_t), intent(inout) :: report
        real(dp), parameter :: radius = 0.8_dp
        real(dp) :: there(2), back(2), twice(2)

        there = around(disk, radius, 1.0_dp)
        back = around(disk, radius, -1.0_dp)
        twice = around(disk, radius, 2.0_dp)
        call report%section("disk: theta and phi go around a circle of 0.8 rad")
        call report%equal("delta x = R cos(theta) 2 pi rho J1(rho)  [m]", there(1), &
                          2.0_dp*pi*r*radius*bessel_j1(radius)*cos(heading), rounding)
        call report%equal("delta y = R sin(theta) 2 pi rho J1(rho)  [m]", there(2), &
                          2.0_dp*pi*r*radius*bessel_j1(radius)*sin(heading), rounding)
        call report%equal("the other way round: minus that", back(1), &
                          -2.0_dp*pi*r*radius*bessel_j1(radius)*cos(heading), rounding)
        call report%equal("twice around: twice that", twice(1), &
                          4.0_dp*pi*r*radius*bessel_j1(radius)*cos(heading), rounding)
        call report%equal("is it R cos(theta) times the area, pi rho^2?", there(1), &
                          pi*r*radius**2*cos(heading), rounding, control=.true.)
    end subroutine round_loop

    subroutine foucault(report, error)
        !! The Coriolis force is that of a field; an oscillator in it turns evenly (Larmor).
        type(report_t), intent(inout) :: report
        type(error_t), allocatable, intent(out) :: error
        real(dp), parameter :: latitudes(4) = [90.0_dp, 48.85_dp, 30.0_dp, 0.0_dp]
        real(dp) :: turned, other
        integer :: i

        call report%section("Foucault: how far the plane of swing has turned after a day  [rad]")
        do i = 1, size(latitudes)
            call plane_after_a_day(latitudes(i), k, turned, error)
            if (allocated(error)) return
            call report%equal("latitude "//to_text(latitudes(i))//": -2 pi sin(latitude)", turned, &
                              -2.0_dp*pi*sin(latitudes(i)*pi/180.0_dp), 1e-11_dp)
        end do
        call plane_after_a_day(30.0_dp, k, turned, error)
        if (.not. allocated(error)) call plane_after_a_day(30.0_dp, 2.0_dp*k, other, error)
        if (allocated(error)) return
        call report%equal("30, a stiffer trap: the same", other, turned, 1e-11_dp)
        call report%equal("30: is it a whole turn, as at the pole?", turned, -2.0_dp*pi, 1e-11_dp, &
                          control=.true.)
    end subroutine foucault

    subroutine plane_after_a_day(latitude, stiffness, turned, error)
        !! The direction of the displacement, followed from sample to sample; the swing begins along
        !! x, with the velocity that makes it a straight one in axes that turn along.
        real(dp), intent(in) :: latitude, stiffness
        real(dp), intent(out) :: turned
        type(error_t), allocatable, intent(out) :: error
        type(charged_particle_t) :: bob
        real(dp), allocatable :: q(:, :), v(:, :)
        real(dp) :: rate, step, change
        integer :: i

        turned = 0.0_dp
        allocate (q(3, samples), v(3, samples))
        rate = -2.0_dp*pi/day*sin(latitude*pi/180.0_dp)  ! of the plane, Larmor's -e B/2m
        call bob%configure([m, 1.0_dp, 0.0_dp, 0.0_dp, 0.0_dp, 0.0_dp, 0.0_dp, -2.0_dp*m*rate, &
                            stiffness], error)
        if (allocated(error)) return
        call compute_path("gauss16", bob, 0.0_dp, day/(samples - 1), [1.0_dp, 0.0_dp, 0.0_dp], &
                          [0.0_dp, rate, 0.0_dp], q, v, error)
        if (allocated(error)) return
        do i = 2, samples
            ! a line has no ends: what counts is the angle between them, modulo pi
            step = q(1, i - 1)*q(2, i) - q(2, i - 1)*q(1, i)
            change = q(1, i - 1)*q(1, i) + q(2, i - 1)*q(2, i)
            turned = turned + atan(step/change)
        end do
    end subroutine plane_after_a_day

    subroutine draw_displacement(report)
        !! The picture: the disk's path while theta and phi go around three times.
        type(report_t), intent(inout) :: report
        integer, parameter :: points = 601
        real(dp) :: s, theta, place(2)
        integer :: i

        report%picture%file = "principle_geometric_phase"
        report%picture%title = "Roll and heading go around a loop; the disk does not come back"
        report%picture%names = [character(32) :: "t", "x", "y", "theta", "phi"]
        report%picture%units = [character(16) :: "turns", "m", "m", "rad", "rad"]
        report%picture%panels = [character(98) :: "x:y", "t:theta+phi"]
        allocate (report%picture%values(5, points))
        place = 0.0_dp
        do i = 1, points
            s = 6.0_dp*pi*(i - 1)/(points - 1)
            theta = heading + 0.8_dp*cos(s)
            report%picture%values(:, i) = [s/(2.0_dp*pi), place, theta, 0.8_dp*sin(s)]
            ! the next place, by the value in the middle of the interval
            s = 6.0_dp*pi*(i - 0.5_dp)/(points - 1)
            theta = heading + 0.8_dp*cos(s)
            place = place + r*0.8_dp*cos(s)*6.0_dp*pi/(points - 1)*[sin(theta), -cos(theta)]
        end do
    end subroutine draw_displacement
end module lagrangia_geometric_phase
