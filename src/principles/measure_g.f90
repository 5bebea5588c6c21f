module lagrangia_measure_g
    !! Atwood's machine as a measurement of g: with \(m_1 - m_2 = \varepsilon M\),
    !! \(M = m_1 + m_2\), over a height h,
    !! $$ g = \frac{2h}{\varepsilon t^2},\qquad \frac{\sigma_g^2}{g^2} =
    !!    \frac{4\sigma_t^2}{t^2} + \frac{\sigma_h^2}{h^2}
    !!    + \frac{4(m_1^2 + m_2^2)\sigma_m^2}{M^2(\varepsilon M)^2}. $$
    !! A small difference makes it slow and the stop watch good, but the masses bad: the best is at
    !! \(\varepsilon^3 = 2h\sigma_m^2/(M^2g\sigma_t^2)\).
    use lagrangia_atwood, only: atwood_t
    use lagrangia_computed_path, only: compute_path
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp
    use lagrangia_number_text, only: rounded
    use lagrangia_random_draws, only: random_t
    use lagrangia_report, only: report_t
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: measure_g_principle

    real(dp), parameter :: g = 9.81_dp, h = 1.5_dp, m = 2.0_dp           !! m/s^2, m, kg
    real(dp), parameter :: watch = 0.1_dp, ruler = 1e-3_dp, scales = 1e-3_dp  !! s, m, kg
    integer, parameter :: trials = 20000
    real(dp), parameter :: simulated = 1e-12_dp  !! s, the rounding of some 200 steps

contains

    subroutine measure_g_principle(report, error)
        !! All statements, and the picture.
        type(report_t), intent(out) :: report  !! the result
        type(error_t), allocatable, intent(out) :: error  !! allocated where it fails

        call report%begin("measure-g: a slow fall measures g; which masses for a given stop watch?")
        call report%cite("II", 87, "\text{ elastically measure for } g")
        call one_fall(report, error)
        if (allocated(error)) return
        call errors_of_measurement(report)
        call best_masses(report)
        call draw_errors(report)
        call report%note("M = "//to_text(m)//" kg, h = "//to_text(h)//" m; standard errors: "// &
                         "watch "//to_text(watch)//" s, ruler "//thousandths(ruler)// &
                         " mm, each mass "//thousandths(scales)//" g.")
        call report%note("(sigma_g/g)^2 = 4 s_t^2/t^2 + s_h^2/h^2 + 4 (m1^2 + m2^2) "// &
                         "s_m^2/(m1^2 - m2^2)^2,")
        call report%note("M = m1 + m2; s_t, s_h, s_m: those of watch, ruler and mass. It is of "// &
                         "first order in them,")
        call report%note("and leaves out about (sigma_g/g)^2 of itself. "//to_text(trials)// &
                         " simulated measurements; those of")
        call report%note("each difference of masses have the same random numbers.")
    end subroutine measure_g_principle

    pure function thousandths(value) result(text)
        !! A mass in kg as one in g, a length in m as one in mm.
        real(dp), intent(in) :: value
        character(:), allocatable :: text

        text = to_text(nint(1000.0_dp*value))
    end function thousandths

    pure function best_share() result(share)
        !! \(\varepsilon = (2h\sigma_m^2/(M^2g\sigma_t^2))^{1/3}\).
        real(dp) :: share

        share = (2.0_dp*h*scales**2/(m**2*g*watch**2))**(1.0_dp/3.0_dp)
    end function best_share

    pure function relative_error(share) result(sigma)
        !! \(\sigma_g/g\).
        real(dp), intent(in) :: share
        real(dp) :: sigma

        sigma = sqrt(4.0_dp*watch**2*share*g/(2.0_dp*h) + (ruler/h)**2 &
                     + 2.0_dp*(1.0_dp + share**2)*scales**2/(m*share)**2)
    end function relative_error

    subroutine one_fall(report, error)
        !! The machine runs, and a watch is stopped when it has passed h; g from that time; with a
        !! pulley that turns it would be wrong.
        type(report_t), intent(inout) :: report
        type(error_t), allocatable, intent(out) :: error
        real(dp), parameter :: share = 0.1_dp, pulley = 2e-3_dp, radius = 0.1_dp
        real(dp) :: t, slow

        call time_of_fall(share, 0.0_dp, radius, t, error)
        if (.not. allocated(error)) call time_of_fall(share, pulley, radius, slow, error)
        if (allocated(error)) return
        call report%section("m1 = "//rounded(0.5_dp*m*(1.0_dp + share), 3)//" kg, m2 = "// &
                            rounded(0.5_dp*m*(1.0_dp - share), 3)//" kg: a fall, simulated, "// &
                            "and its time to h; I, R: of a pulley")
        call report%equal("t = sqrt(2 h M/((m1 - m2) g))  [s]", t, sqrt(2.0_dp*h/(share*g)), &
                          simulated)
        call report%equal("g = 2 h M/((m1 - m2) t^2)  [m/s^2]", 2.0_dp*h/(share*t**2), g, &
                          20.0_dp*simulated)
        call report%equal("I/R^2 = "//rounded(pulley/radius**2, 3)// &
                          " kg: g M/(M + I/R^2)  [m/s^2]", &
                          2.0_dp*h/(share*slow**2), g*m/(m + pulley/radius**2), 20.0_dp*simulated)
        call report%equal("with that pulley: is it g?  [m/s^2]", 2.0_dp*h/(share*slow**2), g, &
                          20.0_dp*simulated, control=.true.)
    end subroutine one_fall

    subroutine time_of_fall(share, pulley, radius, t, error)
        !! From rest until x = h, where a parabola through three samples of the motion meets it.
        real(dp), intent(in) :: share            !! \(\varepsilon\)
        real(dp), intent(in) :: pulley, radius   !! kg m^2, m
        real(dp), intent(out) :: t               !! s
        type(error_t), allocatable, intent(out) :: error
        integer, parameter :: steps = 400
        real(dp), parameter :: step = 0.01_dp    !! s
        type(atwood_t) :: machine
        real(dp) :: q(1, steps + 1), v(1, steps + 1), a, b, c
        integer :: k

        t = 0.0_dp
        call machine%configure([0.5_dp*m*(1.0_dp + share), 0.5_dp*m*(1.0_dp - share), g, pulley, &
                                radius, 0.0_dp], error)
        if (.not. allocated(error)) call compute_path("rk4", machine, 0.0_dp, step, [0.0_dp], &
                                                      [0.0_dp], q, v, error)
        if (allocated(error)) return
        k = findloc(q(1, :) >= h, .true., 1)
        if (k < 3) return
        a = 0.5_dp*(q(1, k) - 2.0_dp*q(1, k - 1) + q(1, k - 2))
        b = 0.5_dp*(q(1, k) - q(1, k - 2))
        c = q(1, k - 1) - h
        t = step*(k - 2 - 2.0_dp*c/(b + sqrt(b**2 - 4.0_dp*a*c)))
    end subroutine time_of_fall

    function scatter(share) result(sigma)
        !! Of g over many measurements with errors, over g. Errors are sums of twelve equal ones.
        real(dp), intent(in) :: share
        real(dp) :: sigma
        type(random_t) :: random
        real(dp), allocatable :: values(:)
        real(dp) :: m1, m2, t, height, mean
        integer :: i

        allocate (values(trials))
        call random%start(1)
        t = sqrt(2.0_dp*h/(share*g))
        do i = 1, trials
            height = h + ruler*normal()
            m1 = 0.5_dp*m*(1.0_dp + share) + scales*normal()
            m2 = 0.5_dp*m*(1.0_dp - share) + scales*normal()
            values(i) = 2.0_dp*height*(m1 + m2)/((m1 - m2)*(t + watch*normal())**2)
        end do
        mean = sum(values)/trials
        sigma = sqrt(sum((values - mean)**2)/(trials - 1))/g
    contains
        function normal() result(x)
            !! Mean 0, variance 1.
            real(dp) :: x, draw
            integer :: n

            x = -6.0_dp
            do n = 1, 12
                call random%uniform(0.0_dp, 1.0_dp, draw)
                x = x + draw
            end do
        end function normal
    end function scatter

    pure function most_scattered(sigma) result(most)
        !! How far a simulated \(\sigma_g/g\) may be from the formula: the scatter of a scatter is
        !! \(\sigma/\sqrt{2N}\) = 0.5 %; the formula leaves out the square of what it adds up.
        real(dp), intent(in) :: sigma
        real(dp) :: most

        most = sigma*(4.0_dp/sqrt(2.0_dp*trials) + 4.0_dp*sigma**2)
    end function most_scattered

    subroutine errors_of_measurement(report)
        !! The formula beside simulated measurements.
        type(report_t), intent(inout) :: report
        real(dp), parameter :: shares(3) = [0.01_dp, 0.02_dp, 0.05_dp]
        real(dp), parameter :: much = 0.5_dp
        integer :: i

        call report%section("sigma_g/g: simulated measurements, and from the three errors")
        do i = 1, size(shares)
            associate (sigma => relative_error(shares(i)))
                call report%equal("m1 - m2 = "//thousandths(shares(i)*m)//" g", &
                                  scatter(shares(i)), sigma, most_scattered(sigma))
            end associate
        end do
        call report%equal("is a difference of "//to_text(nint(much*m))//" kg as good as "// &
                          thousandths(shares(2)*m)//" g?", scatter(much), scatter(shares(2)), &
                          1e-5_dp, control=.true.)
    end subroutine errors_of_measurement

    subroutine best_masses(report)
        !! The lowest of many, the formula for it, and simulated measurements there and beside it.
        type(report_t), intent(inout) :: report
        integer, parameter :: tried = 20000
        real(dp), allocatable :: errors(:)
        real(dp) :: share
        integer :: i

        allocate (errors(tried))
        do i = 1, tried
            errors(i) = relative_error(0.2_dp*i/tried)
        end do
        share = 0.2_dp*minloc(errors, 1)/tried
        call report%section("the best difference of the masses")
        call report%equal("(m1 - m2)/M = (2 h s_m^2/(M^2 g s_t^2))^(1/3)", share, best_share(), &
                          1e-5_dp)
        associate (sigma => minval(errors))
            call report%equal("lowest sigma_g/g: simulated, from errors", &
                              scatter(share), sigma, most_scattered(sigma))
        end associate
        call report%at_least("simulated: twice that is not better", &
                             scatter(2.0_dp*share), scatter(share), 0.0_dp)
        call report%at_least("simulated: is half of it better?", scatter(share), &
                             scatter(0.5_dp*share), 0.0_dp, control=.true.)
    end subroutine best_masses

    subroutine draw_errors(report)
        !! The picture: each part of the error, and all of it.
        type(report_t), intent(inout) :: report
        integer, parameter :: samples = 200
        integer :: i

        report%picture%file = "principle_measure_g"
        report%picture%title = "Atwood's g: the watch wants a small difference, the scales a "// &
                               "large "// &
                               "one"
        report%picture%names = [character(32) :: "(m1 - m2)/M", "sigma_g/g", "of the watch", &
                                "of the scales"]
        report%picture%units = [character(16) :: "1", "%", "%", "%"]
        report%picture%panels = [character(98) :: "(m1 - m2)/M:sigma_g/g+of the watch+of the "// &
                                                  "scales"]
        allocate (report%picture%values(4, samples))
        do i = 1, samples
            associate (share => 0.004_dp + 0.096_dp*(i - 1)/(samples - 1))
                report%picture%values(:, i) = [share, 100.0_dp*[relative_error(share), &
                    2.0_dp*watch*sqrt(share*g/(2.0_dp*h)), &
                    sqrt(2.0_dp*(1.0_dp + share**2))*scales/(m*share)]]
            end associate
        end do
    end subroutine draw_errors
end module lagrangia_measure_g
