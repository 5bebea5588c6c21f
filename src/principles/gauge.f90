module lagrangia_gauge
    !! Uniqueness of the Lagrangian in numbers: \(L\) and \(L + dF/dt\), \(F = F(q, t)\), tell the
    !! same motion.
    use lagrangia_action_paths, only: oscillator_action, oscillator_path
    use lagrangia_cart_pendulum, only: cart_pendulum_t
    use lagrangia_charged_particle, only: charged_particle_t
    use lagrangia_description, only: description_t, name_length
    use lagrangia_errors, only: error_t
    use lagrangia_gauged_system, only: chi_t, family_t, gauged_system_t, landau_charge_t, &
                                       member_names, pendulum_with_q, pendulum_with_q_q_dot
    use lagrangia_hyperdual, only: hyperdual, hyperdual_t
    use lagrangia_kinds, only: dp
    use lagrangia_lagrange, only: accelerations_from_lagrangian, energy_from_lagrangian, &
                                  euler_lagrange_t, expand_lagrangian
    use lagrangia_oscillator, only: oscillator_t
    use lagrangia_pendulum, only: pendulum_t
    use lagrangia_report, only: report_t
    use lagrangia_richardson, only: extrapolated
    use lagrangia_system, only: system_box_t, system_t
    use lagrangia_text, only: to_text
    use lagrangia_vectors, only: farthest
    implicit none (type, external)
    private
    public :: gauge_principle

    real(dp), parameter :: rounding = 1e-13_dp  !! of a few dozen operations on numbers up to 20
    integer, parameter :: states = 20           !! of each system

contains

    subroutine gauge_principle(systems, report, error)
        !! All statements; `systems` are those whose equations are tried.
        type(system_box_t), intent(in) :: systems(:)  !! those that are tried
        type(report_t), intent(out) :: report  !! the result
        type(error_t), allocatable, intent(out) :: error  !! allocated where it fails

        call report%begin("gauge: L and L + dF/dt, F = F(q, t), have the same equations of motion")
        call report%cite("I", 95, "multiple Lagrangians can lead to the same equations of motion")
        call report%cite("I", 107, "=> F does not show up in the equations of motion")
        call same_equations(systems, report, error)
        if (allocated(error)) return
        call shifted(report, error)
        if (allocated(error)) return
        call shifted_action(report, error)
        if (allocated(error)) return
        call two_potentials(report, error)
        if (allocated(error)) return
        call report%note("s = q1 + q2/2 + q3/3 + ...; q_ddot comes from L by Lagrange's equations.")
        call report%note("F must not contain q_dot: dF/dt then has q_ddot, which no L has. "// &
                         "Above, theta_ddot")
        call report%note("in dF/dt is replaced by -(g/l) sin(theta): another L, another motion.")
        call report%note("Pendulum: m = 0.5 kg, l = 0.8 m, g = 9.81 m/s^2, theta = 0.9 rad, "// &
                         "t = 0.7 s.")
        call report%note("Cart-pendulum: m1 = 2 kg, m2 = 0.7 kg, l = 0.8 m; x = 0.4 m, "// &
                         "theta = 0.9 rad,")
        call report%note("x_dot = 0.6 m/s, theta_dot = -1.3 rad/s, t = 0.7 s; h = sum of p "// &
                         "q_dot - L.")
        call report%note("Oscillator: m = 0.5 kg, k = 2 N/m; F(1) at its start, F(2) at its "// &
                         "end. Charge: m = 1.3 kg,")
        call report%note("e = 0.7 C, B = 1.9 T, E = (0, 0.4, 0) V/m, at (0.4, 0.9) m with "// &
                         "(0.6, -1.3) m/s.")
    end subroutine gauge_principle

    subroutine same_equations(systems, report, error)
        !! \(\ddot q\) from \(L'\) beside the page's, and what must not work.
        type(system_box_t), intent(in) :: systems(:)
        type(report_t), intent(inout) :: report
        type(error_t), allocatable, intent(out) :: error
        real(dp), parameter :: t = 0.7_dp, q(1) = 0.9_dp, v(1) = -1.3_dp
        real(dp), parameter :: values(3) = [0.5_dp, 0.8_dp, 9.81_dp]
        type(pendulum_t) :: pendulum
        type(pendulum_with_q) :: with_q
        type(pendulum_with_q_q_dot) :: with_q_q_dot
        type(gauged_system_t) :: gauged
        real(dp) :: analytic(1), a(1), none(0), worst
        character(name_length) :: where_worst
        integer :: i

        call report%section("pendulum: theta_ddot from L' beside -(g/l) sin(theta)  [rad/s^2]")
        call pendulum%configure(values, error)
        if (.not. allocated(error)) call with_q%configure(values, error)
        if (.not. allocated(error)) call with_q_q_dot%configure(values, error)
        if (allocated(error)) return
        call pendulum%accelerations(t, q, v, analytic)
        do i = 1, size(member_names)
            call gauged%set(pendulum, family_t(i))
            call accelerations_from_lagrangian(gauged, t, q, v, a, none, error)
            if (allocated(error)) return
            call report%equal("F = "//member_names(i), a(1), analytic(1), rounding)
        end do
        call accelerations_from_lagrangian(with_q_q_dot, t, q, v, a, none, error)
        if (allocated(error)) return
        call report%equal("F = m l^2 theta theta_dot: see below", a(1), analytic(1), rounding, &
                          control=.true.)
        call accelerations_from_lagrangian(with_q, t, q, v, a, none, error)
        if (allocated(error)) return
        call report%equal("L + theta: not a dF/dt", a(1), analytic(1), rounding, control=.true.)
        call report%section("every system, all three F, "//to_text(states)//" states: "// &
                            "q_ddot from L' less the page's, relative")
        worst = -1.0_dp
        where_worst = ""
        do i = 1, size(systems)
            call try_system(systems(i)%item, worst, where_worst, error)
            if (allocated(error)) return
        end do
        call report%equal("worst of "//to_text(size(systems))//": "//where_worst, worst, 0.0_dp, &
                          1e-12_dp)
    end subroutine same_equations

    subroutine try_system(system, worst, where_worst, error)
        !! One system of the catalogue. Cancelled terms of \(L'\) are as large as \(F\)'s second
        !! derivatives times the squared velocities over the smallest mass; the difference is
        !! relative to the largest acceleration, at least 1.
        class(system_t), intent(in) :: system
        real(dp), intent(inout) :: worst
        character(name_length), intent(inout) :: where_worst
        type(error_t), allocatable, intent(out) :: error
        type(gauged_system_t) :: gauged
        type(description_t) :: d
        real(dp) :: t, q(system%ndof), v(system%ndof), a(system%ndof), analytic(system%ndof)
        real(dp) :: given(system%ndof - system%constraints), lambda(system%constraints), off
        integer :: i, k, j

        call system%describe(d)
        do i = 1, size(member_names)
            call gauged%set(system, family_t(i))
            do k = 1, states
                t = 0.1_dp*k
                q = [(1.4_dp*sin(1.7_dp*k + 0.9_dp*j), j=1, size(q))]
                given = [(1.4_dp*cos(2.3_dp*k + 1.1_dp*j), j=1, size(given))]
                call system%complete_velocities(t, q, given, v, error)
                if (allocated(error)) return
                call system%accelerations(t, q, v, analytic)
                call accelerations_from_lagrangian(gauged, t, q, v, a, lambda, error)
                if (allocated(error)) return
                off = farthest(a, analytic)/max(1.0_dp, maxval(abs(analytic)))
                if (off <= worst) cycle
                worst = off
                where_worst = d%name
            end do
        end do
    end subroutine try_system

    subroutine shifted(report, error)
        !! Momenta and energy function move; masses do not.
        type(report_t), intent(inout) :: report
        type(error_t), allocatable, intent(out) :: error
        real(dp), parameter :: t = 0.7_dp
        real(dp), parameter :: q(2) = [0.4_dp, 0.9_dp], v(2) = [0.6_dp, -1.3_dp]
        type(cart_pendulum_t) :: cart
        type(gauged_system_t) :: gauged
        type(euler_lagrange_t) :: plain, other
        type(hyperdual_t) :: f, qq(2), tt
        real(dp) :: slope(2)
        integer :: i

        call cart%configure([2.0_dp, 0.7_dp, 0.8_dp, 9.81_dp], error)
        if (allocated(error)) return
        call gauged%set(cart, family_t(3))
        call expand_lagrangian(cart, t, q, v, plain)
        call expand_lagrangian(gauged, t, q, v, other)
        tt = hyperdual(t)
        do i = 1, 2
            qq = hyperdual(q)
            qq(i)%d1 = 1.0_dp
            f = gauged%gauge%value(tt, qq)
            slope(i) = f%d1
        end do
        call report%section("cart-pendulum, F = exp(-t/2) s^3: what is shifted, and what is not")
        call report%equal("p_x' = p_x + dF/dx  [kg m/s]", other%dl_dv(1), &
                          plain%dl_dv(1) + slope(1), rounding)
        call report%equal("p_theta' = p_theta + dF/dtheta  [kg m^2/s]", other%dl_dv(2), &
                          plain%dl_dv(2) + slope(2), rounding)
        call report%equal("h' = h - dF/dt at fixed q  [J]", &
                          energy_from_lagrangian(gauged, t, q, v), gauged%energy(t, q, v), &
                          rounding)
        call report%equal("mass matrix, m2 l cos(theta)  [kg m]", other%mass(1, 2), &
                          plain%mass(1, 2), rounding)
        call report%equal("is p_x' = p_x?", other%dl_dv(1), plain%dl_dv(1), rounding, &
                          control=.true.)
    end subroutine shifted

    subroutine shifted_action(report, error)
        !! \(S' = S + F(2) - F(1)\), on the actual path and on any other.
        type(report_t), intent(inout) :: report
        type(error_t), allocatable, intent(out) :: error
        real(dp), parameter :: m = 0.5_dp, k = 2.0_dp, time = 1.0_dp, start = 1.0_dp, end = 0.5_dp
        type(oscillator_t) :: oscillator
        type(gauged_system_t) :: gauged
        type(hyperdual_t) :: first, last
        real(dp) :: plain, other

        call oscillator%configure([m, k], error)
        if (allocated(error)) return
        call gauged%set(oscillator, family_t(3))
        first = gauged%gauge%value(hyperdual(0.0_dp), [hyperdual(start)])
        last = gauged%gauge%value(hyperdual(time), [hyperdual(end)])
        call report%section("oscillator from 1 m to 0.5 m in 1 s, F = exp(-t/2) x^3: action  [J s]")
        plain = oscillator_action(m, k, time, start, end)
        other = along_path(gauged, 0.0_dp)
        call report%equal("S' = S + F(2) - F(1)", other, plain + last%re - first%re, rounding)
        call report%equal("is S' = S?", other, plain, rounding, control=.true.)
        plain = along_path(oscillator, 0.3_dp)
        other = along_path(gauged, 0.3_dp)
        call report%equal("the same on a path that is not actual", other, &
                          plain + last%re - first%re, rounding)
        call draw_actions(last%re - first%re)
    contains
        subroutine draw_actions(shift)
            !! The picture: both actions on neighbours of the actual path, and S + F(2) - F(1).
            real(dp), intent(in) :: shift  !! J s
            integer, parameter :: samples = 81
            real(dp) :: bulge
            integer :: k

            report%picture%file = "principle_gauge"
            report%picture%title = "With dF/dt in L the action is shifted, and least on the "// &
                                   "same path"
            report%picture%nested = .true.
            report%picture%names = [character(32) :: "bulge of the path", "S'", &
                                    "S shifted", "S"]
            report%picture%units = [character(16) :: "m", "J s", "J s", "J s"]
            report%picture%panels = [character(98) :: "bulge of the path:S'+S shifted+S"]
            allocate (report%picture%values(4, samples))
            do k = 1, samples
                bulge = 0.0125_dp*(k - (samples + 1)/2)
                plain = along_path(oscillator, bulge)
                report%picture%values(:, k) = &
                    [bulge, along_path(gauged, bulge), plain + shift, plain]
            end do
        end subroutine draw_actions

        pure function along_path(system, bulge) result(s)
            class(system_t), intent(in) :: system
            real(dp), intent(in) :: bulge  !! m, of a half sine on top of the actual path
            real(dp) :: s, sums(9), t, x, x_dot
            real(dp), parameter :: w = 2.0_dp, pi = acos(-1.0_dp)
            type(hyperdual_t) :: l
            integer :: level, i, n

            do level = 1, size(sums)
                n = 2**(level + 1)
                sums(level) = 0.0_dp
                do i = 0, n
                    t = i*time/n
                    x = oscillator_path(t, time, w, start, end) + bulge*sin(pi*t/time)
                    x_dot = w*(end*cos(w*t) - start*cos(w*(time - t)))/sin(w*time) &
                            + bulge*pi/time*cos(pi*t/time)
                    l = system%lagrangian(hyperdual(t), [hyperdual(x)], [hyperdual(x_dot)])
                    sums(level) = sums(level) + merge(0.5_dp, 1.0_dp, i == 0 .or. i == n)*l%re
                end do
                sums(level) = sums(level)*time/n
            end do
            s = extrapolated(sums)
        end function along_path
    end subroutine shifted_action

    subroutine two_potentials(report, error)
        !! One B, two A.
        type(report_t), intent(inout) :: report
        type(error_t), allocatable, intent(out) :: error
        real(dp), parameter :: values(9) = [1.3_dp, 0.7_dp, 0.0_dp, 0.4_dp, 0.0_dp, 0.0_dp, &
                                            0.0_dp, 1.9_dp, 0.0_dp]
        real(dp), parameter :: t = 0.7_dp
        real(dp), parameter :: q(3) = [0.4_dp, 0.9_dp, -0.2_dp], v(3) = [0.6_dp, -1.3_dp, 0.5_dp]
        type(charged_particle_t) :: symmetric
        type(landau_charge_t) :: landau
        type(euler_lagrange_t) :: one, other
        type(hyperdual_t) :: chi, qq(3)
        real(dp) :: analytic(3), a(3), none(0)

        call symmetric%configure(values, error)
        if (.not. allocated(error)) call landau%configure(values, error)
        if (allocated(error)) return
        call report%section("charge in B along z: A = B x r/2 or A = (0, B x, 0), Landau")
        call symmetric%accelerations(t, q, v, analytic)
        call accelerations_from_lagrangian(symmetric, t, q, v, a, none, error)
        if (allocated(error)) return
        call report%equal("symmetric: x_ddot = e (v x B)_x/m  [m/s^2]", a(1), analytic(1), rounding)
        call accelerations_from_lagrangian(landau, t, q, v, a, none, error)
        if (allocated(error)) return
        call report%equal("Landau: x_ddot  [m/s^2]", a(1), analytic(1), rounding)
        call report%equal("Landau: y_ddot  [m/s^2]", a(2), analytic(2), rounding)
        qq = hyperdual(q)
        qq(2)%d1 = 1.0_dp
        associate (gauge => chi_t(values(2)*values(8)))
            chi = gauge%value(hyperdual(t), qq)
        end associate
        call expand_lagrangian(symmetric, t, q, v, one)
        call expand_lagrangian(landau, t, q, v, other)
        call report%equal("p_y(Landau) = p_y + e d(B x y/2)/dy", other%dl_dv(2), &
                          one%dl_dv(2) + chi%d1, rounding)
        landau%factor = 2.0_dp
        call accelerations_from_lagrangian(landau, t, q, v, a, none, error)
        if (allocated(error)) return
        call report%equal("x_ddot with A = (0, 2 B x, 0): another B", a(1), analytic(1), rounding, &
                          control=.true.)
    end subroutine two_potentials
end module lagrangia_gauge
