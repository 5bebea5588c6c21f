module lagrangia_small_angle
    !! Why \(\dot\theta^2\theta\) may be dropped: with \(\theta = A\sin\omega t\) it is of order
    !! \(A^3\), two orders below what is kept. The price is a period too short by
    !! \((m_1 + 4m_2)A^2/(16m_1)\).
    use lagrangia_cart_pendulum, only: cart_pendulum_t
    use lagrangia_computed_path, only: compute_path
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp
    use lagrangia_number_text, only: rounded
    use lagrangia_reference, only: reference_t
    use lagrangia_report, only: report_t
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: small_angle_principle

    real(dp), parameter :: m1 = 1.0_dp, m2 = 0.5_dp, l = 0.8_dp, g = 9.81_dp
    real(dp), parameter :: pi = acos(-1.0_dp)
    integer, parameter :: steps = 2000   !! of a quarter of a period
    real(dp), parameter :: top = 2.0_dp/(3.0_dp*sqrt(3.0_dp))  !! the largest of cos^2 sin

    type :: swing_t
        !! One swing from rest at the amplitude, by a computed motion.
        real(dp) :: amplitude = 0.0_dp     !! rad
        real(dp) :: largest(3) = 0.0_dp    !! of theta_ddot, theta_dot^2, theta_dot^2 theta
        real(dp) :: period = 0.0_dp        !! s, from the motion itself
        real(dp) :: closed = 0.0_dp        !! s, from the closed form
        real(dp) :: away = 0.0_dp          !! rad, from A cos(omega t) after three quarters
    end type swing_t

contains

    subroutine small_angle_principle(report, error)
        !! All statements, and the picture.
        type(report_t), intent(out) :: report  !! the result
        type(error_t), allocatable, intent(out) :: error  !! allocated where it fails
        integer, parameter :: rungs = 8
        type(cart_pendulum_t) :: cart
        type(swing_t) :: ladder(rungs)
        integer :: i

        call report%begin("small-angle: half the swing, an eighth of theta_dot^2 theta: "// &
                          "so it is dropped")
        call report%cite("I", 160, "\quad O^2 O \sim A^3 \omega^2")
        call cart%configure([m1, m2, l, g], error)
        if (allocated(error)) return
        do i = 1, rungs
            call swing_from(cart, 0.8_dp/2.0_dp**(i - 1), ladder(i), error)
            if (allocated(error)) return
        end do
        call powers(ladder(rungs - 1:rungs), report)
        call periods(ladder(rungs - 1:rungs), report)
        call wrong_sign(report, error)
        if (allocated(error)) return
        call draw_ladder(ladder, report)
        call report%note("Cart-pendulum: m1 = "//to_text(m1)//" kg, m2 = "//to_text(m2)// &
                         " kg, l = "//to_text(l)//" m, g = "//to_text(g)//" m/s^2.")
        call report%note("w^2 = (m1 + m2) g/(m1 l).")
        call report%note("Powers: log2 of the ratio of two swings, A = "// &
                         one_over(ladder(rungs - 1)%amplitude)//" and "// &
                         one_over(ladder(rungs)%amplitude)//" rad; they are whole but for A^2.")
        call report%note("2/(3 sqrt(3)) = "//rounded(top, 4)//" is the largest value of "// &
                         "cos^2(wt) sin(wt).")
    end subroutine small_angle_principle

    pure function one_over(amplitude) result(text)
        !! `1/80`.
        real(dp), intent(in) :: amplitude  !! one over a whole number, but for rounding
        character(:), allocatable :: text

        text = "1/"//to_text(nint(1.0_dp/amplitude))
    end function one_over

    pure function frequency() result(omega)
        !! \(\omega = \sqrt{(m_1+m_2)g/(m_1l)}\).
        real(dp) :: omega

        omega = sqrt((m1 + m2)*g/(m1*l))
    end function frequency

    subroutine swing_from(cart, amplitude, swing, error)
        !! Three quarters of a period, in which every term has been as large as it gets.
        type(cart_pendulum_t), intent(in) :: cart
        real(dp), intent(in) :: amplitude
        type(swing_t), intent(out) :: swing
        type(error_t), allocatable, intent(out) :: error
        real(dp), allocatable :: q(:, :), v(:, :)
        class(reference_t), allocatable :: reference
        real(dp) :: a(2), start(2), still(2), step
        integer :: k

        start = [0.0_dp, amplitude]
        still = 0.0_dp
        call cart%closed_form(0.0_dp, start, still, reference)
        swing%amplitude = amplitude
        swing%closed = reference%period
        step = 0.25_dp*swing%closed/steps
        allocate (q(2, 3*steps + 1), v(2, 3*steps + 1))
        call compute_path("gauss16", cart, 0.0_dp, step, start, still, q, v, error)
        if (allocated(error)) return
        do k = 1, size(q, 2)
            call cart%accelerations(0.0_dp, q(:, k), v(:, k), a)
            swing%largest = max(swing%largest, abs([a(2), v(2, k)**2, v(2, k)**2*q(2, k)]))
        end do
        ! three quarters of a period after the start it is at the bottom again
        k = size(q, 2)
        swing%period = 4.0_dp/3.0_dp*(3*steps*step - q(2, k)/v(2, k))
        swing%away = q(2, k) - amplitude*cos(frequency()*3*steps*step)
    end subroutine swing_from

    subroutine powers(two, report)
        !! Of the amplitude.
        type(swing_t), intent(in) :: two(2)  !! the second of half the amplitude
        type(report_t), intent(inout) :: report
        real(dp) :: a, w, within, top_of(2, 3)
        integer :: i

        a = two(2)%amplitude
        w = frequency()
        do i = 1, size(two)
            top_of(i, :) = two(i)%largest
        end do
        within = two(1)%amplitude**2
        call report%section("cart-pendulum from rest at A: how each term falls with A")
        call report%equal("theta_ddot: power of A", power(top_of(:, 1)), 1.0_dp, within)
        call report%equal("theta_dot^2: power of A", power(top_of(:, 2)), 2.0_dp, within)
        call report%equal("theta_dot^2 theta: power of A", power(top_of(:, 3)), 3.0_dp, within)
        call report%equal("is theta_dot^2 theta of first order?", &
                          power(top_of(:, 3)), 1.0_dp, within, control=.true.)
        call report%equal("largest theta_ddot/(A w^2)", two(2)%largest(1)/(a*w**2), 1.0_dp, &
                          within)
        call report%equal("largest theta_dot^2/(A w)^2", two(2)%largest(2)/(a*w)**2, 1.0_dp, &
                          within)
        call report%equal("largest theta_dot^2 theta/(A^3 w^2)", &
                          two(2)%largest(3)/(a**3*w**2), top, within)
    end subroutine powers

    subroutine periods(two, report)
        !! What the dropped terms do: the swing takes longer.
        type(swing_t), intent(in) :: two(2)
        type(report_t), intent(inout) :: report
        real(dp) :: longer(2), t0, within

        t0 = 2.0_dp*pi/frequency()
        longer = [two(1)%period, two(2)%period]/t0 - 1.0_dp
        within = two(1)%amplitude**2
        ! the next term of T/T0 is -0.03 A^4
        call report%section("what is lost: T0 = 2 pi/w is too short")
        call report%equal("T from the motion = T in closed form  [s]", two(2)%period, &
                          two(2)%closed, 1e-13_dp)
        call report%equal("T/T0 - 1: power of A", power(longer), 2.0_dp, within)
        call report%equal("(T/T0 - 1)/A^2 = (m1 + 4 m2)/(16 m1)", &
                          longer(2)/two(2)%amplitude**2, (m1 + 4.0_dp*m2)/(16.0_dp*m1), &
                          0.1_dp*two(2)%amplitude**2)
        call report%equal("is it 1/16, as of a pivot that is fixed?", &
                          longer(2)/two(2)%amplitude**2, 1.0_dp/16.0_dp, &
                          0.1_dp*two(2)%amplitude**2, control=.true.)
        call report%equal("theta - A cos(w t) after 3/4 T: power of A", power([two(1)%away, &
                                                                               two(2)%away]), &
                                                                               3.0_dp, &
                          within)
    end subroutine periods

    subroutine wrong_sign(report, error)
        !! The slip of the notes, \(l\ddot\theta + \ddot x\cos\theta - g\sin\theta = 0\), is the
        !! same with gravity upwards: \(\theta = A\cosh\kappa t\), \(\kappa^2 = \omega^2\).
        type(report_t), intent(inout) :: report
        type(error_t), allocatable, intent(out) :: error
        integer, parameter :: samples = 101
        real(dp), parameter :: a = 1e-3_dp, step = 0.01_dp
        type(cart_pendulum_t) :: cart
        real(dp) :: q(2, samples), v(2, samples), start(2), still(2), w

        w = frequency()
        start = [0.0_dp, a]
        still = 0.0_dp
        call report%section("the notes' sign, - g sin(theta), from A = 0.001 rad: after 1 s", &
                            slip="E1")
        call cart%configure([m1, m2, l, g], error)
        if (allocated(error)) return
        call compute_path("gauss16", cart, 0.0_dp, step, start, still, q, v, error)
        if (allocated(error)) return
        call report%at_least("with + g: A is not exceeded  [rad]", a, maxval(abs(q(2, :))), 0.0_dp)
        cart%g = -g
        call compute_path("gauss16", cart, 0.0_dp, step, start, still, q, v, error)
        if (allocated(error)) return
        call report%at_least("with - g: is A not exceeded?  [rad]", a, maxval(abs(q(2, :))), &
                             0.0_dp, control=.true.)
        ! the series of T in A, of theta here, has a first term of theta^2 (m1 + 4 m2)/(16 m1)
        call report%equal("with - g: theta/(A cosh(w t))", q(2, samples)/(a*cosh(w)), 1.0_dp, &
                          w*q(2, samples)**2)
    end subroutine wrong_sign

    pure function power(values) result(p)
        !! Of the amplitude, where the second value belongs to half of it.
        real(dp), intent(in) :: values(2)
        real(dp) :: p

        p = log(abs(values(1)/values(2)))/log(2.0_dp)
    end function power

    subroutine draw_ladder(ladder, report)
        !! The picture: each term as a straight line of its power.
        type(swing_t), intent(in) :: ladder(:)
        type(report_t), intent(inout) :: report
        real(dp) :: w
        integer :: i

        w = frequency()
        report%picture%file = "principle_small_angle"
        report%picture%title = "Cart-pendulum: theta_dot^2 theta falls with the third power "// &
                               "of the swing"
        report%picture%names = [character(32) :: "log10(A/rad)", "theta_ddot/omega^2", &
                                "theta_dot^2/omega^2", "theta_dot^2 theta/omega^2", &
                                "T/T0 - 1", "3/16 A^2"]
        report%picture%units = [character(16) :: "1", "log10", "log10", "log10", "log10", "log10"]
        report%picture%panels = [character(98) :: &
                                 "log10(A/rad):theta_ddot/omega^2+theta_dot^2/omega^2+"// &
                                 "theta_dot^2 theta/omega^2", "log10(A/rad):T/T0 - 1+3/16 A^2"]
        report%picture%nested = .true.
        allocate (report%picture%values(6, size(ladder)))
        do i = 1, size(ladder)
            associate (a => ladder(i)%amplitude)
                report%picture%values(:, i) = log10([a, ladder(i)%largest/w**2, &
                    ladder(i)%period*w/(2.0_dp*pi) - 1.0_dp, (m1 + 4.0_dp*m2)/(16.0_dp*m1)*a**2])
            end associate
        end do
    end subroutine draw_ladder
end module lagrangia_small_angle
