module lagrangia_limits_of_systems
    !! Where formulas of the lectures become 0/0: angles of a wedge, slow rotation, weak fields.
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp, qp
    use lagrangia_ledger, only: ledger_t
    use lagrangia_printed_table, only: short
    use lagrangia_reference, only: reference_t
    use lagrangia_system, only: system_t
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: stress_slow_disk, stress_slow_wire, stress_wedge, stress_weak_field

    real(dp), parameter :: few = 8.0_dp*epsilon(1.0_dp)  !! of roundings
    real(dp), parameter :: rates(*) = [1.0_dp, 1e-3_dp, 1e-6_dp, 1e-9_dp, 1e-300_dp, 0.0_dp]

contains

    subroutine stress_wedge(system, verdicts)
        !! Both accelerations for a steep and a flat incline, against the formula in quadruple
        !! precision; relative, for each.
        class(system_t), intent(inout) :: system  !! its parameters are set as needed
        type(ledger_t), intent(inout) :: verdicts  !! gets the lines
        real(dp), parameter :: block = 0.7_dp, wedge = 2.0_dp, g = 9.81_dp
        real(dp), parameter :: right_angle = 0.5_dp*acos(-1.0_dp)
        real(dp), parameter :: angles(*) = [0.6_dp, 1e-4_dp, 1e-8_dp, 1e-300_dp, 0.0_dp, &
                                            right_angle - 1e-4_dp, right_angle - 1e-12_dp, &
                                            right_angle]
        character(:), allocatable :: of
        type(error_t), allocatable :: error
        real(dp) :: a(2), worst
        real(qp) :: s, c, exact(2)
        integer :: i

        do i = 1, size(angles)
            call system%configure([block, wedge, angles(i), g], error)
            call system%accelerations(0.0_dp, [0.0_dp, 0.0_dp], [0.0_dp, 0.0_dp], a)
            s = sin(real(angles(i), qp))
            c = cos(real(angles(i), qp))
            exact = [real(wedge, qp) + block, -block*c]*g*s/(wedge + block*s**2)
            worst = real(maxval(abs(a - exact)/max(abs(exact), real(tiny(worst), qp))), dp)
            if (allocated(error)) worst = huge(worst)
            of = "alpha = "//to_text(angles(i))
            if (angles(i) > 1.0_dp) of = "alpha = pi/2 - "//short(right_angle - angles(i), 1)
            call verdicts%judge(of, "accelerations: relative error", worst, most=few)
        end do
    end subroutine stress_wedge

    subroutine stress_slow_wire(system, verdicts)
        !! A bead on a wire that hardly rotates: the closed form against
        !! \(r_0\cosh\omega t + v_0\sinh(\omega t)/\omega\) in quadruple precision, at 2 s.
        class(system_t), intent(inout) :: system  !! its parameters are set as needed
        type(ledger_t), intent(inout) :: verdicts  !! gets the lines
        real(dp), parameter :: t = 2.0_dp, r0 = 0.5_dp, v0 = 0.3_dp
        real(dp) :: q(1), v(1)
        real(qp) :: z, exact
        integer :: i

        do i = 1, size(rates)
            call state_of(system, [1.3_dp, rates(i)], [r0], [v0], t, q, v)
            z = real(rates(i), qp)*t
            exact = r0*cosh(z) + v0*t
            if (z > 0.0_qp) exact = r0*cosh(z) + v0*t*sinhc(z)
            call verdicts%judge("wire, omega = "//to_text(rates(i)), &
                                "r after 2 s: relative error", real(abs(q(1)/exact - 1.0_qp), &
                                                                    dp), most=few)
        end do
    end subroutine stress_slow_wire

    subroutine stress_slow_disk(system, verdicts)
        !! A disk whose heading hardly turns rolls on a circle of huge radius: the closed form
        !! against the chord in quadruple precision, at 2 s.
        class(system_t), intent(inout) :: system  !! its parameters are set as needed
        type(ledger_t), intent(inout) :: verdicts  !! gets the lines
        real(dp), parameter :: t = 2.0_dp, r = 0.3_dp, roll = 4.0_dp, heading = 0.7_dp
        real(dp) :: q(4), v(4)
        real(qp) :: chord, exact(2), middle
        integer :: i

        do i = 1, size(rates)
            call state_of(system, [1.0_dp, r, 0.045_dp, 0.0225_dp, 9.81_dp, 0.0_dp], &
                          [0.0_dp, 0.0_dp, 0.0_dp, heading], [r*roll*sin(heading), &
                          -r*roll*cos(heading), roll, rates(i)], t, q, v)
            middle = 0.5_qp*rates(i)*t
            chord = real(r, qp)*roll*t*sinc(middle)
            exact = chord*[sin(heading + middle), -cos(heading + middle)]
            call verdicts%judge("disk, omega = "//to_text(rates(i)), "x, y after 2 s: error", &
                                real(maxval(abs(q(:2) - exact)), dp), most=few)
        end do
    end subroutine stress_slow_disk

    subroutine stress_weak_field(system, verdicts)
        !! A charge across a field that hardly bends its way, likewise.
        class(system_t), intent(inout) :: system  !! its parameters are set as needed
        type(ledger_t), intent(inout) :: verdicts  !! gets the lines
        real(dp), parameter :: t = 2.0_dp, speed = 1.0_dp, none(3) = 0.0_dp
        real(dp) :: q(3), v(3)
        real(qp) :: exact(2), middle
        integer :: i

        do i = 1, size(rates)
            call state_of(system, [1.0_dp, 1.0_dp, none, 0.0_dp, 0.0_dp, rates(i), 0.0_dp], none, &
                          [speed, 0.0_dp, 0.0_dp], t, q, v)
            middle = 0.5_qp*rates(i)*t
            exact = real(speed, qp)*t*sinc(middle)*[cos(middle), -sin(middle)]
            call verdicts%judge("charge, B = "//to_text(rates(i)), "x, y after 2 s: error", &
                                real(maxval(abs(q(:2) - exact)), dp), most=few)
        end do
    end subroutine stress_weak_field

    subroutine state_of(system, parameters, q0, v0, t, q, v)
        !! The closed form at `t`; huge where the parameters are refused or none is known.
        class(system_t), intent(inout) :: system
        real(dp), intent(in) :: parameters(:), q0(:), v0(:), t
        real(dp), intent(out) :: q(:), v(:)
        class(reference_t), allocatable :: reference
        type(error_t), allocatable :: error

        q = huge(q)
        v = q
        call system%configure(parameters, error)
        if (allocated(error)) return
        call system%closed_form(0.0_dp, q0, v0, reference)
        if (allocated(reference)) call reference%state_at(t, q, v)
    end subroutine state_of

    pure function sinc(x) result(y)
        !! \(\sin x/x\).
        real(qp), intent(in) :: x
        real(qp) :: y

        y = 1.0_qp - x**2/6.0_qp
        if (abs(x) > 1e-8_qp) y = sin(x)/x
    end function sinc

    pure function sinhc(x) result(y)
        !! \(\sinh x/x\).
        real(qp), intent(in) :: x
        real(qp) :: y

        y = 1.0_qp + x**2/6.0_qp
        if (abs(x) > 1e-8_qp) y = sinh(x)/x
    end function sinhc
end module lagrangia_limits_of_systems
