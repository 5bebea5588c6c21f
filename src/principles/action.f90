module lagrangia_action
    !! Hamilton's principle in numbers: which paths make \(S = \int L\,dt\) stationary, and whether
    !! it is least there.
    !!
    !! The notes say that the actual path *minimizes* the action. It makes it stationary: beyond
    !! the first conjugate point, \(T > \pi/\omega\) for the oscillator, neighbours have less.
    use lagrangia_action_paths, only: extrapolated_action, extrapolated_change, oscillator_action, &
                                      oscillator_path, straight, pendulum_path, pendulum_period
    use lagrangia_computed_path, only: compute_path
    use lagrangia_discrete_action, only: action_gradient, action_of, find_path, &
                                         lowest_variation, negative_curvatures
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp
    use lagrangia_oscillator, only: oscillator_t
    use lagrangia_pendulum, only: pendulum_t
    use lagrangia_report, only: report_t
    use lagrangia_richardson, only: extrapolated
    use lagrangia_system, only: system_t
    use lagrangia_text, only: to_text
    use lagrangia_vectors, only: farthest
    implicit none (type, external)
    private
    public :: action_principle

    real(dp), parameter :: pi = acos(-1.0_dp)
    real(dp), parameter :: eps = epsilon(1.0_dp)
    real(dp), parameter :: m = 0.5_dp, k = 2.0_dp              !! oscillator, \(\omega = 2\)/s
    real(dp), parameter :: omega = 2.0_dp
    real(dp), parameter :: xa = 1.0_dp, xb = 0.5_dp            !! its two ends, m
    real(dp), parameter :: bob = 0.5_dp, l = 0.8_dp, g = 9.81_dp  !! pendulum
    real(dp), parameter :: widest = 2.0_dp                     !! its amplitude, rad
    integer, parameter :: levels = 6, coarsest = 16               !! of Richardson's extrapolation

contains

    subroutine action_principle(report, error)
        !! All statements, and the picture.
        type(report_t), intent(out) :: report  !! the result
        type(error_t), allocatable, intent(out) :: error  !! allocated where it fails
        type(oscillator_t) :: oscillator
        type(pendulum_t) :: pendulum

        call report%begin("action: the actual path makes S = int L dt stationary, not always least")
        call report%cite("II", 3, "Hamilton's Principle")
        call report%cite("II", 18, &
                         "the actual path followed is that which minimizes the time integral")
        call oscillator%configure([m, k], error)
        if (allocated(error)) return
        call pendulum%configure([bob, l, g], error)
        if (allocated(error)) return
        call computed_paths(oscillator, pendulum, report, error)
        if (allocated(error)) return
        call found_paths(oscillator, pendulum, report, error)
        if (allocated(error)) return
        call least_or_not(oscillator, pendulum, report, error)
        if (allocated(error)) return
        call draw_variations(oscillator, pendulum, report, error)
        call report%note("Discrete action: points a step h apart, S_d = sum of h (L_k + L_k+1)/2.")
        call report%note("Oscillator: m = "//to_text(m)//" kg, k = "//to_text(k)// &
                         " N/m, w = omega = "//to_text(omega)//"/s.")
        call report%note("Pendulum: m = "//to_text(bob)//" kg, l = "//to_text(l)//" m, g = "// &
                         to_text(g)//" m/s^2.")
        call report%note("x_max: the largest |x|, of the motion from 0.8 m with -0.6 m/s; "// &
                         "the pendulum's from 0")
        call report%note("with 4 rad/s. The paths found: from 1 m to 0.5 m; the pendulum's "// &
                         "as it swings from rest")
        call report%note("at 2 rad. P: period. Neighbouring paths from the start meet at "// &
                         "conjugate points.")
    end subroutine action_principle

    subroutine computed_paths(oscillator, pendulum, report, error)
        !! Verlet's method *is* \(\delta S_d = 0\); another method's path obeys it only to \(h^2\).
        class(system_t), intent(in) :: oscillator, pendulum
        type(report_t), intent(inout) :: report
        type(error_t), allocatable, intent(out) :: error
        real(dp), parameter :: h = 0.05_dp
        real(dp) :: found, coarse, fine, size_of, bound

        call report%section("computed paths: largest |dS_d/dq|/h, which is zero where delta S = 0")
        ! the force is a difference of m q/h**2, each rounded, and so are the points: 16 roundings
        call gradient_of("velocity_verlet", oscillator, 0.8_dp, -0.6_dp, h, found, size_of)
        if (allocated(error)) return
        bound = 16.0_dp*eps*m*size_of/h**2
        call report%equal("oscillator, Stoermer-Verlet, h = 0.05 s  [N]", found, 0.0_dp, bound)
        call gradient_of("rk4", oscillator, 0.8_dp, -0.6_dp, h, coarse, size_of)
        if (allocated(error)) return
        call report%equal("oscillator, RK4's path: is it zero?", coarse, 0.0_dp, bound, &
                          control=.true.)
        call report%equal("oscillator, RK4: m omega^4 h^2 x_max/12  [N]", coarse, &
                          m*omega**4*h**2*size_of/12.0_dp, 0.02_dp*coarse)
        call gradient_of("rk4", oscillator, 0.8_dp, -0.6_dp, 0.5_dp*h, fine, size_of)
        if (allocated(error)) return
        call report%equal("oscillator, RK4: power of h", log(coarse/fine)/log(2.0_dp), 2.0_dp, &
                          0.05_dp)
        call gradient_of("velocity_verlet", pendulum, 0.0_dp, 4.0_dp, 0.5_dp*h, found, size_of)
        if (allocated(error)) return
        call report%equal("pendulum, Stoermer-Verlet, h = 0.025 s  [N m]", found, 0.0_dp, &
                          16.0_dp*eps*bob*l**2*size_of/(0.5_dp*h)**2)
        call gradient_of("rk4", pendulum, 0.0_dp, 4.0_dp, 0.5_dp*h, coarse, size_of)
        if (allocated(error)) return
        call gradient_of("rk4", pendulum, 0.0_dp, 4.0_dp, 0.25_dp*h, fine, size_of)
        if (allocated(error)) return
        call report%equal("pendulum, RK4: power of h", log(coarse/fine)/log(2.0_dp), 2.0_dp, &
                          0.05_dp)
    contains
        subroutine gradient_of(method, system, q0, v0, step, largest, reach)
            character(*), intent(in) :: method
            class(system_t), intent(in) :: system
            real(dp), intent(in) :: q0, v0, step
            real(dp), intent(out) :: largest, reach
            real(dp), allocatable :: q(:, :), v(:, :)
            real(dp) :: start(1), speed(1)

            largest = 0.0_dp
            reach = 0.0_dp
            allocate (q(1, nint(5.0_dp/step)), v(1, nint(5.0_dp/step)))
            start = q0
            speed = v0
            call compute_path(method, system, 0.0_dp, step, start, speed, q, v, error)
            if (allocated(error)) return
            largest = action_gradient(system, 0.0_dp, step, q)
            reach = maxval(abs(q))
        end subroutine gradient_of
    end subroutine computed_paths

    subroutine found_paths(oscillator, pendulum, report, error)
        !! From a straight line to the true path; then the action along it.
        class(system_t), intent(in) :: oscillator, pendulum
        type(report_t), intent(inout) :: report
        type(error_t), allocatable, intent(out) :: error
        real(dp), parameter :: time = 1.0_dp, part = 0.4_dp  !! s, periods
        real(dp) :: period, away(levels), middle(levels), action
        integer :: i

        call report%section("paths found: Newton's method on delta S_d = 0 from a straight line")
        call find("oscillator", time)
        if (allocated(error)) return
        call report%equal("oscillator, x(T/2), T = 1 s, h -> 0  [m]", extrapolated(middle), &
                          oscillator_path(0.5_dp*time, time, omega, xa, xb), 1e-13_dp)
        call report%equal("oscillator, error of x: power of h", &
                          log(away(2)/away(3))/log(2.0_dp), 2.0_dp, 0.05_dp)
        period = pendulum_period(widest, g/l)
        call find("pendulum", part*period)
        if (allocated(error)) return
        call report%equal("pendulum, theta(T/2), T = 0.4 periods  [rad]", extrapolated(middle), &
                          pendulum_path(0.5_dp*part*period, widest, g/l), 1e-12_dp)
        call report%equal("pendulum, error of theta: power of h", &
                          log(away(2)/away(3))/log(2.0_dp), 2.0_dp, 0.05_dp)
        call report%section("the oscillator's action, m w ((xa^2 + xb^2) cos wT - 2 xa xb)"// &
                            "/(2 sin wT)")
        call extrapolated_action(oscillator, time, xa, xb, action, error)
        if (allocated(error)) return
        call report%equal("from 1 m to 0.5 m in 1 s, omega T = 2  [J s]", action, &
                          oscillator_action(m, k, time, xa, xb), 1e-14_dp)
    contains
        subroutine find(which, duration)
            character(*), intent(in) :: which
            real(dp), intent(in) :: duration
            real(dp), allocatable :: path(:, :), truth(:)
            real(dp) :: h
            integer :: j, n

            do i = 1, levels
                n = coarsest*2**(i - 1)
                h = duration/n
                if (which == "pendulum") then
                    allocate (truth, source=[(pendulum_path(j*h, widest, g/l), j=0, n)])
                    allocate (path, source=straight(truth(1), truth(n + 1), n))
                    call find_path(pendulum, 0.0_dp, h, path, error)
                else
                    allocate (truth, source=[(oscillator_path(j*h, duration, omega, xa, xb), &
                                              j=0, n)])
                    allocate (path, source=straight(xa, xb, n))
                    call find_path(oscillator, 0.0_dp, h, path, error)
                end if
                if (allocated(error)) return
                away(i) = farthest(path(1, :), truth)
                middle(i) = path(1, n/2 + 1)
                deallocate (path, truth)
            end do
        end subroutine find
    end subroutine found_paths

    subroutine least_or_not(oscillator, pendulum, report, error)
        !! The second variation: positive up to the first conjugate point only.
        class(system_t), intent(in) :: oscillator, pendulum
        type(report_t), intent(inout) :: report
        type(error_t), allocatable, intent(out) :: error
        real(dp), parameter :: times(4) = [1.0_dp, 2.0_dp, 3.5_dp, 5.0_dp]       !! s
        real(dp), parameter :: parts(4) = [0.45_dp, 0.55_dp, 0.95_dp, 1.05_dp]   !! periods
        real(dp), parameter :: a = 0.3_dp                                        !! m
        integer, parameter :: n = 400
        real(dp) :: change, time
        integer :: i, negative

        call report%section("S[x + a sin(pi t/T)] - S[x] = (m T a^2/4)"// &
                            "((pi/T)^2 - w^2), a = 0.3 m", slip="E15")
        do i = 1, 2
            call extrapolated_change(oscillator, times(i), xa, xb, a, change, error)
            if (allocated(error)) return
            call report%equal("oscillator, omega T = "// &
                              to_text(nint(omega*times(i)))//"  [J s]", change, &
                              0.25_dp*m*times(i)*a**2*((pi/times(i))**2 - omega**2), 1e-14_dp)
            call report%at_least("is S least?  then not negative", change, 0.0_dp, &
                                  1e-14_dp, control=i > 1)
        end do
        call report%section("variations that lower S: negative eigenvalues of its Hessian")
        do i = 1, size(times)
            call count_on(oscillator, times(i), negative)
            if (allocated(error)) return
            call report%equal("oscillator, omega T = "//to_text(nint(omega*times(i)))// &
                              ": floor(omega T/pi)", real(negative, dp), &
                              real(floor(omega*times(i)/pi), dp), 0.0_dp)
            if (i == 2) call report%show("E15")
        end do
        do i = 1, size(parts)
            time = parts(i)*pendulum_period(widest, g/l)
            call count_on(pendulum, time, negative)
            if (allocated(error)) return
            call report%equal("pendulum from 2 rad, "//to_text(parts(i))// &
                              " P: floor(2T/P)", real(negative, dp), &
                              real(floor(2.0_dp*parts(i)), dp), 0.0_dp)
            if (i == 1) call report%equal("the same as if small: floor(omega T/pi)", &
                real(negative, dp), real(floor(sqrt(g/l)*time/pi), dp), 0.0_dp, control=.true.)
        end do
    contains
        subroutine count_on(system, duration, found)
            class(system_t), intent(in) :: system
            real(dp), intent(in) :: duration
            integer, intent(out) :: found
            real(dp), allocatable :: path(:, :)

            found = -1
            call true_path(system, duration, n, path, error)
            if (.not. allocated(error)) call negative_curvatures(system, 0.0_dp, duration/n, path, &
                                                                 found, error)
        end subroutine count_on
    end subroutine least_or_not

    subroutine draw_variations(oscillator, pendulum, report, error)
        !! The picture: \(S[q+a\eta] - S[q]\), before and beyond the conjugate point. \(\eta\) is
        !! the variation that lowers the action most (or raises it least): the oscillator's half
        !! sine, and another for the pendulum, along which its cubic terms stay small.
        class(system_t), intent(in) :: oscillator, pendulum
        type(report_t), intent(inout) :: report
        type(error_t), allocatable, intent(out) :: error
        integer, parameter :: n = 200, samples = 121
        real(dp), parameter :: reach(2) = [1.0_dp, 0.4_dp]  !! m, rad
        real(dp) :: times(4)
        integer :: i

        report%picture%file = "principle_action"
        report%picture%title = "Action of q + a eta, less that of the actual path q; "// &
                               "eta: what lowers it most"
        report%picture%names = [character(32) :: "a", "oscillator(omega T=2)", &
                                "oscillator(omega T=4)", "a_theta", &
                                "pendulum_0.45_periods", "pendulum_0.70_periods"]
        report%picture%units = [character(16) :: "m", "J s", "J s", "rad", "J s", "J s"]
        report%picture%panels = [character(98) :: &
                                 "a:oscillator(omega T=2)+oscillator(omega T=4)", &
                                 "a_theta:pendulum_0.45_periods+pendulum_0.70_periods"]
        allocate (report%picture%values(6, samples))
        times(:2) = [1.0_dp, 2.0_dp]
        times(3:) = [0.45_dp, 0.7_dp]*pendulum_period(widest, g/l)
        do i = 1, 2
            call draw(oscillator, times(i), 1, 1 + i)
            if (.not. allocated(error)) call draw(pendulum, times(2 + i), 4, 4 + i)
            if (allocated(error)) return
        end do
    contains
        subroutine draw(system, time, across, up)
            class(system_t), intent(in) :: system
            real(dp), intent(in) :: time        !! s
            integer, intent(in) :: across, up   !! columns
            real(dp), allocatable :: path(:, :), varied(:, :)
            real(dp) :: eta(n + 1), actual, a
            integer :: j

            call true_path(system, time, n, path, error)
            if (allocated(error)) return
            call lowest_variation(system, 0.0_dp, time/n, path, eta, error)
            if (allocated(error)) return
            actual = action_of(system, 0.0_dp, time/n, path)
            allocate (varied, source=path)
            do j = 1, samples
                a = reach(merge(1, 2, across == 1))*(2.0_dp*(j - 1)/(samples - 1) - 1.0_dp)
                varied(1, :) = path(1, :) + a*eta
                report%picture%values(across, j) = a
                report%picture%values(up, j) = action_of(system, 0.0_dp, time/n, varied) - actual
            end do
        end subroutine draw
    end subroutine draw_variations

    subroutine true_path(system, time, n, path, error)
        !! The stationary path of \(S_d\) beside the closed form: oscillator or pendulum.
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: time
        integer, intent(in) :: n
        real(dp), allocatable, intent(out) :: path(:, :)
        type(error_t), allocatable, intent(out) :: error
        integer :: j

        allocate (path(1, n + 1))
        select type (system)
        type is (pendulum_t)
            path(1, :) = [(pendulum_path(j*time/n, widest, g/l), j=0, n)]
        class default
            path(1, :) = [(oscillator_path(j*time/n, time, omega, xa, xb), j=0, n)]
        end select
        call find_path(system, 0.0_dp, time/n, path, error)
    end subroutine true_path
end module lagrangia_action
