module lagrangia_maupertuis
    !! Maupertuis' principle in numbers: of all paths between two points that are run through with
    !! one energy, the actual ones make \(\int p\,dq\) stationary. A throw shows it: with one speed
    !! two parabolas lead to a point within reach.
    !!
    !! $$ A = \int m\sqrt{v^2 - 2gy}\,\sqrt{1 + y'^2}\,dx $$
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp
    use lagrangia_report, only: report_t
    use lagrangia_richardson, only: extrapolated
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: maupertuis_principle

    real(dp), parameter :: pi = acos(-1.0_dp)
    real(dp), parameter :: m = 0.5_dp, g = 9.81_dp, v = 8.0_dp   !! kg, m/s^2, m/s
    real(dp), parameter :: x1 = 4.0_dp, y1 = 1.0_dp              !! the point that is hit, m
    integer, parameter :: levels = 8, coarsest = 32              !! of Richardson's extrapolation

contains

    subroutine maupertuis_principle(report, error)
        !! All statements, and the picture.
        type(report_t), intent(out) :: report  !! the result
        type(error_t), allocatable, intent(out) :: error  !! allocated where it fails
        real(dp) :: slopes(2)

        if (allocated(error)) return
        call report%begin("maupertuis: with one energy int p dq is stationary, with one time "// &
                          "int "// &
                          "L dt is")
        call report%cite("II", 8, &
                         "1747 Maupertuis dynamical motion takes place with minimum motion")
        slopes = (v**2 + [-1.0_dp, 1.0_dp]*sqrt(v**4 - g*(g*x1**2 + 2.0_dp*y1*v**2)))/(g*x1)
        call both_throws(slopes, report)
        call second_order(slopes, report)
        call with_fixed_time(slopes, report)
        call at_the_envelope(report)
        call draw_throws(slopes, report)
        call report%note("m = "//to_text(m)//" kg, g = "//to_text(g)//" m/s^2.")
        call report%note("T: the flat throw's time to the point. a: a length, the bend.")
        call report%note("A = int p dq = int m v ds. A path y beside a throw is run through "// &
                         "with "// &
                         "the same energy:")
        call report%note("y + a sin(pi x/x1), v from (v^2 - 2 g y). Throws of 8 m/s to a point "// &
                         "4 m away, 1 m up.")
    end subroutine maupertuis_principle

    pure function action(slope, a) result(total)
        !! \(A\) of the throw with \(y'(0)\) = `slope`, bent by \(a\sin(\pi x/x_1)\); the limit of
        !! ever finer trapezoids.
        real(dp), intent(in) :: slope, a
        real(dp) :: total
        real(dp) :: sums(levels)
        integer :: i, k, n

        do i = 1, levels
            n = coarsest*2**(i - 1)
            sums(i) = 0.5_dp*(integrand(0.0_dp) + integrand(x1))
            do k = 1, n - 1
                sums(i) = sums(i) + integrand(k*x1/n)
            end do
            sums(i) = sums(i)*x1/n
        end do
        total = extrapolated(sums)
    contains
        pure function integrand(x) result(f)
            real(dp), intent(in) :: x
            real(dp) :: f, y, y_slope

            y = throw(slope, x) + a*sin(pi*x/x1)
            y_slope = slope - g*x*(1.0_dp + slope**2)/v**2 + a*pi/x1*cos(pi*x/x1)
            f = m*sqrt(v**2 - 2.0_dp*g*y)*sqrt(1.0_dp + y_slope**2)
        end function integrand
    end function action

    pure function throw(slope, x) result(y)
        !! \(x\tan\alpha - gx^2/(2v^2\cos^2\alpha)\).
        real(dp), intent(in) :: slope, x
        real(dp) :: y

        y = slope*x - 0.5_dp*g*x**2*(1.0_dp + slope**2)/v**2
    end function throw

    pure function flight(slope) result(time)
        !! To the point, s.
        real(dp), intent(in) :: slope
        real(dp) :: time

        time = x1*sqrt(1.0_dp + slope**2)/v
    end function flight

    pure function first_derivative(slope) result(d)
        !! \(dA/da\) at a = 0, from differences over ever smaller a.
        real(dp), intent(in) :: slope
        real(dp) :: d
        real(dp) :: values(3), a
        integer :: i

        do i = 1, size(values)
            a = 0.04_dp/2.0_dp**(i - 1)
            values(i) = 0.5_dp*(action(slope, a) - action(slope, -a))/a
        end do
        d = extrapolated(values)
    end function first_derivative

    pure function second_derivative(slope) result(d)
        !! \(d^2A/da^2\) at a = 0.
        real(dp), intent(in) :: slope
        real(dp) :: d
        real(dp) :: values(3), a
        integer :: i

        do i = 1, size(values)
            a = 0.08_dp/2.0_dp**(i - 1)
            values(i) = (action(slope, a) - 2.0_dp*action(slope, 0.0_dp) + action(slope, -a))/a**2
        end do
        d = extrapolated(values)
    end function second_derivative

    subroutine both_throws(slopes, report)
        !! They hit; A in closed form; stationary.
        real(dp), intent(in) :: slopes(2)
        type(report_t), intent(inout) :: report
        character(5), parameter :: which(2) = ["flat ", "steep"]
        character(:), allocatable :: name
        real(dp) :: t, up
        integer :: i

        call report%section("two throws of one energy to one point")
        do i = 1, 2
            name = trim(which(i))
            associate (slope => slopes(i))
                t = flight(slope)
                up = v*slope/sqrt(1.0_dp + slope**2)
                call report%equal(name//" throw: it hits, y(4 m)  [m]", throw(slope, x1), y1, &
                                  1e-14_dp)
                ! v**2 along the throw is v**2 - 2 g (up t - g t**2/2)
                call report%equal(name//": A, of the path = int m v^2 dt  [J s]", &
                                  action(slope, 0.0_dp), &
                                  m*(v**2*t - g*up*t**2 + g**2*t**3/3.0_dp), 1e-12_dp)
                ! roundings of A, 1e-14, over 0.01 m
                call report%equal(name//": dA/da = 0, paths of one energy", &
                                  first_derivative(slope), 0.0_dp, 1e-9_dp)
            end associate
        end do
    end subroutine both_throws

    subroutine second_order(slopes, report)
        !! Least on the flat throw; on the steep one, which has touched the envelope, not.
        real(dp), intent(in) :: slopes(2)
        type(report_t), intent(inout) :: report

        call report%section("is A least, too?  bent by a sin(pi x/x1): d2A/da2  [J s/m^2]", &
                            slip="E17")
        call report%at_least("flat throw: d2A/da2 > 0", second_derivative(slopes(1)), 0.0_dp, &
                             0.0_dp)
        call report%at_least("steep throw: is d2A/da2 > 0?", second_derivative(slopes(2)), 0.0_dp, &
                             0.0_dp, control=.true.)
    end subroutine second_order

    subroutine with_fixed_time(slopes, report)
        !! Neighbours that take the same time, \(y(t) + a\sin(\pi t/T)\), have another energy:
        !! \(d/da\int m v^2dt = 4mgT/\pi\), while \(\int L\,dt\) is stationary.
        real(dp), intent(in) :: slopes(2)
        type(report_t), intent(inout) :: report
        real(dp) :: t, up

        t = flight(slopes(1))
        up = v*slopes(1)/sqrt(1.0_dp + slopes(1)**2)
        call report%section("paths of one time in the place of one energy: y(t) + a sin(pi "// &
                            "t/T), "// &
                            "flat throw")
        call report%equal("d/da int L dt = 0", change(1.0_dp, -1.0_dp), 0.0_dp, 1e-12_dp)
        call report%equal("d/da int p dq = 0?  [N s]", change(2.0_dp, 0.0_dp), 0.0_dp, &
                          1e-12_dp, control=.true.)
        call report%equal("d/da int p dq = 4 m g T/pi  [N s]", change(2.0_dp, 0.0_dp), &
                          4.0_dp*m*g*t/pi, 1e-12_dp)
    contains
        pure function change(of_t, of_v) result(d)
            !! \(d/da\) of \(\int(c_TT + c_VV)\,dt\), by trapezoids.
            real(dp), intent(in) :: of_t, of_v
            real(dp) :: d
            real(dp) :: sums(levels), tau
            integer :: i, k, n

            do i = 1, levels
                n = coarsest*2**(i - 1)
                sums(i) = 0.0_dp
                do k = 0, n
                    tau = k*t/n
                    sums(i) = sums(i) + merge(0.5_dp, 1.0_dp, k == 0 .or. k == n)*t/n &
                              *(of_t*m*(up - g*tau)*pi/t*cos(pi*tau/t) + of_v*m*g*sin(pi*tau/t))
                end do
            end do
            d = extrapolated(sums)
        end function change
    end subroutine with_fixed_time

    subroutine at_the_envelope(report)
        !! \(y = v^2/2g - gx^2/2v^2\): both throws become one, and none goes beyond.
        type(report_t), intent(inout) :: report
        integer, parameter :: directions = 20001
        real(dp) :: best, rim
        integer :: k

        rim = 0.5_dp*(v**2/g - g*x1**2/v**2)
        best = maxval([(throw(tan(0.5_dp*pi*k/(directions + 1)), x1), k=1, directions)])
        call report%section("the envelope of all throws of one speed, y = v^2/2g - g x^2/2v^2")
        call report%equal("y of the slope v^2/(g x), at x = 4 m  [m]", throw(v**2/(g*x1), x1), &
                          rim, &
                          1e-14_dp)
        ! half a step of direction beside the best: d2y/dalpha2 is below 100 m
        call report%equal("highest of 20001 directions  [m]", best, rim, &
                          50.0_dp*(0.25_dp*pi/directions)**2)
        call report%equal("is it v^2/2g, straight up?  [m]", best, 0.5_dp*v**2/g, 1e-6_dp, &
                          control=.true.)
    end subroutine at_the_envelope

    subroutine draw_throws(slopes, report)
        !! The picture: both throws and the envelope.
        real(dp), intent(in) :: slopes(2)
        type(report_t), intent(inout) :: report
        integer, parameter :: samples = 101
        integer :: k

        report%picture%file = "principle_maupertuis"
        report%picture%title = "Two throws of 8 m/s meet 4 m away; the steep one has touched "// &
                               "the "// &
                               "envelope"
        report%picture%names = [character(32) :: "x", "flat throw", "steep throw", "envelope"]
        report%picture%units = [character(16) :: "m", "m", "m", "m"]
        report%picture%panels = [character(98) :: "x:flat throw+steep throw+envelope"]
        allocate (report%picture%values(4, samples))
        do k = 1, samples
            associate (x => x1*(k - 1)/(samples - 1))
                report%picture%values(:, k) = [x, throw(slopes(1), x), throw(slopes(2), x), &
                                               0.5_dp*(v**2/g - g*x**2/v**2)]
            end associate
        end do
    end subroutine draw_throws
end module lagrangia_maupertuis
