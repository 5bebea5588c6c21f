module lagrangia_all_paths
    !! All paths of a pendulum between two events, 0 at first, 1 rad a time T later, that do not go
    !! over the top. Each makes S stationary; how many directions lower it, Morse's index, is the
    !! number of conjugate points on the way. Descent finds the least only, and where there is none
    !! it runs away.
    use lagrangia_action_paths, only: extrapolated_action, oscillator_action, straight
    use lagrangia_discrete_action, only: action_of, expand_action, find_path, lowest_variation, &
                                         negative_curvatures
    use lagrangia_elliptic, only: jacobi
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp
    use lagrangia_lapack, only: solve_band
    use lagrangia_oscillator, only: oscillator_t
    use lagrangia_pendulum, only: pendulum_t
    use lagrangia_report, only: report_t
    use lagrangia_richardson, only: extrapolated
    use lagrangia_roots, only: find_root, scalar_function_t
    use lagrangia_system, only: system_t
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: all_paths_principle

    real(dp), parameter :: m = 0.5_dp, l = 0.8_dp, g = 9.81_dp, goal = 1.0_dp  !! kg, m, m/s^2, rad
    real(dp), parameter :: w0 = sqrt(g/l), time = 9.0_dp/w0                    !! 1/s, s
    integer, parameter :: n = 240            !! pieces of a discrete path
    integer, parameter :: most = 7           !! paths
    real(dp), parameter :: same = 1e-9_dp    !! J s, of what descent reaches; its steps end there

    type, extends(scalar_function_t) :: miss_t
        !! By how much a start at this rate misses the goal.
    contains
        procedure :: value => missed
    end type miss_t

contains

    subroutine all_paths_principle(report, error)
        !! All statements, and the picture.
        type(report_t), intent(out) :: report  !! the result
        type(error_t), allocatable, intent(out) :: error  !! allocated where it fails
        type(pendulum_t) :: pendulum
        real(dp) :: rates(most), path(1, n + 1), paths(n + 1, most), actions(most), halved(most)
        integer :: i, found, indices(most), least

        call report%begin("all-paths: between two events a pendulum has several paths, all "// &
                          "with "// &
                          "delta S = 0")
        call report%cite("II", 18, &
                         "the actual path followed is that which minimizes the time integral")
        call report%cite("II", 20, "\delta \int_{t_1}^{t_2} (T - U) dt = 0")
        call pendulum%configure([m, l, g], error)
        if (.not. allocated(error)) call find_rates(rates, found, error)
        if (allocated(error)) return
        paths = 0.0_dp
        call report%section("pendulum, 0 to 1 rad in T = 9/w0: all paths not over the "// &
                            "top; S  [J s]")
        do i = 1, found
            path(1, :) = closed_path(rates(i))
            call find_path(pendulum, 0.0_dp, time/n, path, error)
            if (.not. allocated(error)) call negative_curvatures(pendulum, 0.0_dp, time/n, path, &
                                                                 indices(i), error)
            if (allocated(error)) return
            paths(:, i) = path(1, :)
            actions(i) = action_of(pendulum, 0.0_dp, time/n, path)
            call report%equal("path "//to_text(i)//": S of the points, of the closed form", &
                              richardson_action(pendulum, rates(i), halved(i), error), &
                              closed_action(rates(i)), 1e-9_dp)
            if (allocated(error)) return
            call report%equal("path "//to_text(i)//": Morse's index, conjugate points", &
                              real(indices(i), dp), real(conjugate_points(rates(i)), dp), 0.0_dp)
        end do
        least = minloc(actions(:found), 1)
        call report%equal("path "//to_text(least)//": error of S, "//to_text(n/2)// &
                          " pieces over "//to_text(n), halved(least), 4.0_dp, &
                          (w0*time/(n/2))**2*4.0_dp)
        call report%equal("paths of even index less those of odd", &
                          real(sum((-1)**indices(:found)), dp), 1.0_dp, 0.0_dp)
        call report%equal("is there one path only?", real(found, dp), 1.0_dp, 0.0_dp, &
                          control=.true.)
        call descents(pendulum, paths(:, :found), actions(:found), indices(:found), report, error)
        if (.not. allocated(error)) call oscillators(report, error)
        if (allocated(error)) return
        call draw_paths(pendulum, paths(:, :found), indices(:found), report, error)
        if (allocated(error)) return
        call report%note("S of the points: the limit of ever more pieces. Descent is among "// &
                         "paths of "//to_text(n)//" pieces;")
        call report%note("their S_d less S falls with the square of a piece's duration; it is "// &
                         "compared with S_d of "//to_text(n)//".")
        call report%note("Over: the ratio of S_d less S, of 120 pieces to that of 240.")
        call report%note("Pendulum: m = "//to_text(m)//" kg, l = "//to_text(l)//" m, g = "// &
                         to_text(g)//" m/s^2, w0^2 = g/l; oscillator: the same m.")
        call report%note("Conjugate points: where neighbours of the path from the start meet "// &
                         "it again.")
        call report%note("Descent: step by step against the slope of S, the ends held. It "// &
                         "begins 0.05 rad")
        call report%note("below (down) or above (up) the path, along eta, the eigenvector of "// &
                         "the lowest eigenvalue")
        call report%note("of the second variation, along which S falls most; eta's largest "// &
                         "value is 1.")
    end subroutine all_paths_principle

    pure subroutine swing(rate, t, theta, theta_dot)
        !! From the bottom: \(\theta = 2\arcsin(k\,\mathrm{sn}\,\omega_0t)\), \(k =
        !! \dot\theta_0/2\omega_0\), \(|k| < 1\).
        real(dp), intent(in) :: rate, t
        real(dp), intent(out) :: theta, theta_dot
        real(dp) :: k, sn, cn, dn

        k = 0.5_dp*rate/w0
        call jacobi(w0*t, sqrt((1.0_dp - k)*(1.0_dp + k)), sn, cn, dn)
        theta = 2.0_dp*asin(k*sn)
        theta_dot = rate*cn
    end subroutine swing

    function missed(self, x) result(y)
        !! See `miss_t`.
        class(miss_t), intent(inout) :: self
        real(dp), intent(in) :: x
        real(dp) :: y, speed

        if (same_type_as(self, self)) call swing(x, time, y, speed)
        y = y - goal
    end function missed

    subroutine find_rates(rates, found, error)
        !! All starts that do not go over the top: one that does is past pi when T is over.
        real(dp), intent(out) :: rates(most)
        integer, intent(out) :: found
        type(error_t), allocatable, intent(out) :: error
        integer, parameter :: tried = 4000
        type(miss_t) :: miss
        real(dp) :: here, there
        integer :: i

        rates = 0.0_dp
        found = 0
        do i = 1, tried - 1
            here = 2.0_dp*w0*(2.0_dp*i/tried - 1.0_dp)*(1.0_dp - 1e-9_dp)
            there = 2.0_dp*w0*(2.0_dp*(i + 1)/tried - 1.0_dp)*(1.0_dp - 1e-9_dp)
            if (miss%value(here)*miss%value(there) > 0.0_dp .or. found == most) cycle
            found = found + 1
            call find_root(miss, here, there, rates(found), error)
            if (allocated(error)) return
        end do
    end subroutine find_rates

    pure function closed_path(rate) result(theta)
        !! At all points.
        real(dp), intent(in) :: rate
        real(dp) :: theta(n + 1), speed
        integer :: j

        do j = 0, n
            call swing(rate, j*time/n, theta(j + 1), speed)
        end do
        theta(n + 1) = goal
    end function closed_path

    pure function closed_action(rate) result(s)
        !! \(\int L\,dt\) of the closed form, the limit of ever finer trapezoids.
        real(dp), intent(in) :: rate
        real(dp) :: s, theta, speed, sums(6)
        integer :: i, j, pieces

        do i = 1, size(sums)
            pieces = 60*2**(i - 1)
            sums(i) = 0.0_dp
            do j = 0, pieces
                call swing(rate, j*time/pieces, theta, speed)
                sums(i) = sums(i) + merge(0.5_dp, 1.0_dp, j == 0 .or. j == pieces)*time/pieces &
                          *(0.5_dp*m*l**2*speed**2 + m*g*l*cos(theta))
            end do
        end do
        s = extrapolated(sums)
    end function closed_action

    function richardson_action(pendulum, rate, halved, error) result(s)
        !! Of the points that make \(S_d\) stationary, the limit of ever finer ones.
        class(system_t), intent(in) :: pendulum
        real(dp), intent(in) :: rate
        real(dp), intent(out) :: halved  !! error of S of n/2 pieces over that of n
        type(error_t), allocatable, intent(out) :: error
        real(dp) :: s, actions(5), speed
        real(dp), allocatable :: path(:, :)
        integer :: i, j, pieces

        s = 0.0_dp
        halved = 0.0_dp
        do i = 1, size(actions)
            pieces = n/4*2**(i - 1)
            allocate (path(1, pieces + 1))
            do j = 0, pieces
                call swing(rate, j*time/pieces, path(1, j + 1), speed)
            end do
            path(1, pieces + 1) = goal
            call find_path(pendulum, 0.0_dp, time/pieces, path, error)
            if (allocated(error)) return
            actions(i) = action_of(pendulum, 0.0_dp, time/pieces, path)
            deallocate (path)
        end do
        s = extrapolated(actions)
        halved = (actions(2) - s)/(actions(3) - s)
    end function richardson_action

    pure function conjugate_points(rate) result(number)
        !! Zeros of \(\partial\theta/\partial\dot\theta_0\) on the way.
        real(dp), intent(in) :: rate
        integer :: number, j
        integer, parameter :: samples = 2000
        real(dp) :: up, down, speed, before, now, d

        number = 0
        before = 1.0_dp
        d = 1e-6_dp*(2.0_dp*w0 - abs(rate))
        do j = 1, samples
            call swing(rate + d, j*time/samples, up, speed)
            call swing(rate - d, j*time/samples, down, speed)
            now = up - down
            if (now*before < 0.0_dp) number = number + 1
            before = now
        end do
    end function conjugate_points

    subroutine descend(system, mass, duration, path, error)
        !! Against the slope of S, measured by the kinetic part of S itself: \(q \to q - \tau
        !! K^{-1}\nabla S\), with \(q\,K q\) the sum of \(m(\Delta q)^2/h\). S falls.
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: mass, duration
        real(dp), intent(inout) :: path(:, :)
        type(error_t), allocatable, intent(out) :: error
        integer, parameter :: steps = 1500
        real(dp), parameter :: tau = 0.2_dp
        real(dp), allocatable :: gradient(:), band(:, :)
        real(dp) :: kinetic(3, size(path, 2) - 2), change(size(path, 2) - 2), h
        integer :: i

        h = duration/(size(path, 2) - 1)
        kinetic(1, :) = -mass/h
        kinetic(2, :) = 2.0_dp*mass/h
        kinetic(3, :) = -mass/h
        do i = 1, steps
            call expand_action(system, 0.0_dp, h, path, gradient, band)
            call solve_band(kinetic, gradient, change, error)
            if (allocated(error)) return
            path(1, 2:size(path, 2) - 1) = path(1, 2:size(path, 2) - 1) - tau*change
            if (maxval(abs(path)) > 1e6_dp .or. maxval(abs(change)) < 1e-12_dp) return
        end do
    end subroutine descend

    subroutine descents(pendulum, paths, actions, indices, report, error)
        !! From each path that is not least, pushed along the variation that lowers S most.
        class(system_t), intent(in) :: pendulum
        real(dp), intent(in) :: paths(:, :), actions(:)
        integer, intent(in) :: indices(:)
        type(report_t), intent(inout) :: report
        type(error_t), allocatable, intent(out) :: error
        real(dp) :: path(1, n + 1), eta(n + 1), reached, least
        integer :: i, side

        least = minval(actions)
        call report%section("descent, "//to_text(n)//" pieces: from a straight line, and from "// &
                            "paths that are not least  [J s]")
        path = straight(0.0_dp, goal, n)
        call descend(pendulum, m*l**2, time, path, error)
        if (allocated(error)) return
        reached = action_of(pendulum, 0.0_dp, time/n, path)
        call report%equal("from a straight line: S of a path of index 0", reached, &
                          least_near(reached), same)
        do i = 1, size(indices)
            if (indices(i) == 0) cycle
            path(1, :) = paths(:, i)
            call lowest_variation(pendulum, 0.0_dp, time/n, path, eta, error)
            do side = -1, 1, 2
                path(1, :) = paths(:, i) + 0.05_dp*side*eta
                if (.not. allocated(error)) call descend(pendulum, m*l**2, time, path, error)
                if (allocated(error)) return
                reached = action_of(pendulum, 0.0_dp, time/n, path)
                call report%equal("from path "//to_text(i)//trim(merge(", up:  ", ", down:", &
                                  side == 1))//" S of a path of index 0", reached, &
                                  least_near(reached), same)
            end do
            call report%equal("is path "//to_text(i)//" least?  S, the least S", actions(i), &
                              least, &
                              same, control=.true.)
        end do
    contains
        pure function least_near(s) result(action)
            !! Of the paths of index 0.
            real(dp), intent(in) :: s
            real(dp) :: action
            real(dp) :: of(size(actions))

            of = merge(actions, huge(1.0_dp), indices == 0)
            action = of(minloc(abs(of - s), 1))
        end function least_near
    end subroutine descents

    subroutine oscillators(report, error)
        !! Descent before and beyond the conjugate point, \(\omega T = \pi\).
        type(report_t), intent(inout) :: report
        type(error_t), allocatable, intent(out) :: error
        real(dp), parameter :: k = 2.0_dp, times(2) = [1.0_dp, 2.0_dp], ends(2) = [1.0_dp, 0.5_dp]
        type(oscillator_t) :: oscillator
        real(dp) :: path(1, n + 1), exact, found, reached
        integer :: i

        call oscillator%configure([m, k], error)
        if (allocated(error)) return
        call report%section("oscillator, 1 m to 0.5 m, omega = 2/s: S exact, and where descent "// &
                            "of "//to_text(n)//" pieces ends")
        do i = 1, 2
            exact = oscillator_action(m, k, times(i), ends(1), ends(2))
            call extrapolated_action(oscillator, times(i), ends(1), ends(2), found, error)
            if (allocated(error)) return
            call report%equal("omega T = "//to_text(nint(2*times(i)))//": S of the one path", &
                              found, exact, 1e-13_dp)
            path = straight(ends(1), ends(2), n)
            call descend(oscillator, m, times(i), path, error)
            if (allocated(error)) return
            reached = action_of(oscillator, 0.0_dp, times(i)/n, path)
            ! the points' own S differs from the exact one by about S (omega h)^2/24
            call report%equal("omega T = "//to_text(nint(2*times(i)))// &
                              trim(merge(": descent finds it", ": does descent?   ", i == 1)), &
                              reached, exact, abs(exact)*(2.0_dp*times(i)/n)**2, control=i == 2)
        end do
    end subroutine oscillators

    subroutine draw_paths(pendulum, paths, indices, report, error)
        !! The picture: each path with its index, and the variation that bends S least.
        class(system_t), intent(in) :: pendulum
        real(dp), intent(in) :: paths(:, :)
        integer, intent(in) :: indices(:)
        type(report_t), intent(inout) :: report
        type(error_t), allocatable, intent(out) :: error
        real(dp) :: eta(n + 1), path(1, n + 1)
        integer :: i, j, k

        report%picture%file = "principle_all_paths"
        report%picture%title = "Paths of a pendulum from 0 to 1 rad in one time; eta lowers S most"
        k = size(indices)
        allocate (report%picture%names(2*k + 1), report%picture%units(2*k + 1), &
                  report%picture%panels(2), report%picture%values(2*k + 1, n + 1))
        report%picture%names(1) = "t"
        report%picture%units(1) = "s"
        report%picture%units(2:) = "rad"
        report%picture%panels = "t:"
        do i = 1, k
            report%picture%names(i + 1) = to_text(i)//", index "//to_text(indices(i))
            report%picture%names(i + k + 1) = "eta of "//to_text(i)
            do j = 1, 2
                report%picture%panels(j) = trim(report%picture%panels(j))// &
                                           trim(report%picture%names(i + 1 + (j - 1)*k))
                if (i < k) report%picture%panels(j) = trim(report%picture%panels(j))//"+"
            end do
            path(1, :) = paths(:, i)
            call lowest_variation(pendulum, 0.0_dp, time/n, path, eta, error)
            if (allocated(error)) return
            report%picture%values(i + 1, :) = paths(:, i)
            report%picture%values(i + k + 1, :) = eta
        end do
        report%picture%values(1, :) = [(j*time/n, j=0, n)]
    end subroutine draw_paths
end module lagrangia_all_paths
