module lagrangia_virtual_work
    !! D'Alembert's principle in numbers: \(\sum(m\ddot x - F)\cdot\delta x = 0\), and the
    !! generalized forces \(Q_j = \sum F\cdot\partial x/\partial q_j\).
    use lagrangia_computed_path, only: compute_path
    use lagrangia_description, only: description_t
    use lagrangia_double_pendulum, only: double_pendulum_t
    use lagrangia_driven_pendulum, only: driven_pendulum_t
    use lagrangia_errors, only: error_t
    use lagrangia_hyperdual, only: hyperdual, hyperdual_t
    use lagrangia_kinds, only: dp
    use lagrangia_point_motion, only: conservative_forces, dalembert, expand_points, &
                                      point_motion_t
    use lagrangia_report, only: report_t
    use lagrangia_rolling_disk, only: rolling_disk_t
    use lagrangia_rotating_wire, only: rotating_wire_t
    use lagrangia_system, only: system_box_t, system_t
    use lagrangia_test_potentials, only: test_charge_t
    implicit none (type, external)
    private
    public :: virtual_work_principle

    real(dp), parameter :: rounding = 1e-13_dp  !! of a few dozen operations on numbers up to 20
    real(dp), parameter :: relative = 1e-12_dp  !! the same, relative to the largest term
    real(dp), parameter :: wire_mass = 0.6_dp   !! of the bead, kg
    real(dp), parameter :: wire_rate = 1.5_dp   !! W, rad/s

contains

    subroutine virtual_work_principle(systems, report, error)
        !! All statements; `systems` are those that are tried.
        type(system_box_t), intent(in) :: systems(:)  !! those that are tried
        type(report_t), intent(out) :: report  !! the result
        type(error_t), allocatable, intent(out) :: error  !! allocated where it fails

        call report%begin("virtual-work: sum of (m x_ddot - F).delta x = 0, delta x has no dt")
        call report%cite("I", 3, &
                         "e.g. given dt -> changes in dz; even if dt zero, but constraints "// &
                         "Virtual displacement")
        call report%cite("I", 53, &
                         "$$Q_{i} = \sum_{i} F_{i} \frac{\partial x_{i}}{\partial q_{j}}$$")
        call displacements(report, error)
        if (allocated(error)) return
        call moving_wire(report, error)
        if (allocated(error)) return
        call along_motions(systems, report, error)
        if (allocated(error)) return
        call generalized_forces(systems, report, error)
        if (allocated(error)) return
        call made_up_potentials(report, error)
        call report%note("Double pendulum: m1 = 1.3 kg, m2 = 0.7 kg, l1 = 0.9 m, l2 = 1.7 "// &
                         "m, g = 9.81 m/s^2; th1 =")
        call report%note("0.4, th2 = -1.1, dth1 = 0.03, dth2 = 0.02 rad. Driven pendulum: l "// &
                         "= 0.8 m, pivot at a")
        call report%note("cos(W t), a = 0.1 m, W = 5 rad/s, t = 0.7 s, th = 0.9 rad, dth = "// &
                         "-1.3 rad. Bead: m = 0.6")
        call report%note("kg, W = 1.5 rad/s, r = 0.5 m, r_dot = 0.8 m/s. Charge: e = -0.8 "// &
                         "C, t = 0.7 s, at (0.4,")
        call report%note("0.9, -0.6) m with (0.6, -1.3, 0.5) m/s; made up: phi = x y "// &
                         "exp(-t) + z^2 sin(x), A = (y")
        call report%note("z t, x^2 cos(t) + z, sin(x y) + t z).")
    end subroutine virtual_work_principle

    subroutine displacements(report, error)
        !! The page's \(\delta x_2\); and where \(dx\) and \(\delta x\) differ.
        type(report_t), intent(inout) :: report
        type(error_t), allocatable, intent(out) :: error
        real(dp), parameter :: l1 = 0.9_dp, l2 = 1.7_dp, a = 0.1_dp, w = 5.0_dp, l = 0.8_dp
        real(dp), parameter :: q(2) = [0.4_dp, -1.1_dp], dq(2) = [0.03_dp, 0.02_dp]
        real(dp), parameter :: t = 0.7_dp, theta(1) = 0.9_dp, rate(1) = -1.3_dp
        type(double_pendulum_t) :: two
        type(driven_pendulum_t) :: driven
        type(point_motion_t) :: motion

        call two%configure([1.3_dp, 0.7_dp, l1, l2, 9.81_dp], error)
        if (.not. allocated(error)) call driven%configure([0.5_dp, l, 9.81_dp, a, w], error)
        if (allocated(error)) return
        call report%section("virtual displacements: delta x = sum of dx/dq_j dq_j  [m]; dt = 1 s")
        call expand_points(two, 0.0_dp, q, dq, dq, motion)
        call report%equal("delta x2 = l1 cos th1 dth1 + l2 cos th2 dth2", &
                          dot_product(motion%jacobian(4, :), dq), &
                          l1*cos(q(1))*dq(1) + l2*cos(q(2))*dq(2), rounding)
        call report%equal("delta y2 = l1 sin th1 dth1 + l2 sin th2 dth2", &
                          dot_product(motion%jacobian(5, :), dq), &
                          l1*sin(q(1))*dq(1) + l2*sin(q(2))*dq(2), rounding)
        call report%equal("dx2 = delta x2: nothing moves by itself", motion%velocity(4), &
                          dot_product(motion%jacobian(4, :), dq), rounding)
        call expand_points(driven, t, theta, rate, rate, motion)
        call report%equal("driven pendulum: delta y = l sin(th) dth", &
                          motion%jacobian(2, 1)*rate(1), l*sin(theta(1))*rate(1), rounding)
        call report%equal("dy = l sin(th) dth - a W sin(W t) dt", motion%velocity(2), &
                          l*sin(theta(1))*rate(1) - a*w*sin(w*t), rounding)
        call report%equal("is dy = delta y?  its pivot moves", motion%velocity(2), &
                          motion%jacobian(2, 1)*rate(1), rounding, control=.true.)
    end subroutine displacements

    subroutine moving_wire(report, error)
        !! A moving constraint's force does work, but no virtual work.
        type(report_t), intent(inout) :: report
        type(error_t), allocatable, intent(out) :: error
        real(dp), parameter :: t = 0.7_dp, r(1) = 0.5_dp, v(1) = 0.8_dp
        type(rotating_wire_t) :: wire
        type(point_motion_t) :: motion
        real(dp) :: a(1), n(3)

        call wire%configure([wire_mass, wire_rate], error)
        if (allocated(error)) return
        call report%section("bead on a rotating wire: the wire pushes, N = m x_ddot - F")
        call wire%accelerations(t, r, v, a)
        call expand_points(wire, t, r, v, a, motion)
        n = motion%mass*motion%acceleration - motion%force
        call report%equal("virtual work, N.dx/dr: none  [N]", &
                          dot_product(n, motion%jacobian(:, 1)), 0.0_dp, rounding)
        call report%equal("power, N.dx/dt = 2 m W^2 r r_dot  [W]", &
                          dot_product(n, motion%velocity), &
                          2.0_dp*wire_mass*wire_rate**2*r(1)*v(1), rounding)
        call report%equal("is there no power either?  [W]", dot_product(n, motion%velocity), &
                          0.0_dp, rounding, control=.true.)
        call draw_power(wire, report, error)
    end subroutine moving_wire

    subroutine draw_power(wire, report, error)
        !! The picture: what the wire's force does on the actual path, and along the wire alone.
        type(rotating_wire_t), intent(in) :: wire
        type(report_t), intent(inout) :: report
        type(error_t), allocatable, intent(out) :: error
        integer, parameter :: samples = 151
        real(dp), parameter :: step = 0.01_dp
        real(dp) :: q(1, samples), v(1, samples), a(1), n(3)
        type(point_motion_t) :: motion
        integer :: k

        call compute_path("gauss16", wire, 0.0_dp, step, [0.2_dp], [0.0_dp], q, v, error)
        if (allocated(error)) return
        report%picture%file = "principle_virtual_work"
        report%picture%title = "A wire that turns does work on its bead, but no virtual work"
        report%picture%nested = .true.
        report%picture%names = [character(32) :: "t", "N.dx/dt", "2 m omega^2 r r_dot", &
                                "N.(dx/dr) r_dot"]
        report%picture%units = [character(16) :: "s", "W", "W", "W"]
        report%picture%panels = [character(98) :: "t:N.dx/dt+2 m omega^2 r r_dot+N.(dx/dr) r_dot"]
        allocate (report%picture%values(4, samples))
        do k = 1, samples
            call wire%accelerations((k - 1)*step, q(:, k), v(:, k), a)
            call expand_points(wire, (k - 1)*step, q(:, k), v(:, k), a, motion)
            n = motion%mass*motion%acceleration - motion%force
            report%picture%values(:, k) = &
                [(k - 1)*step, dot_product(n, motion%velocity), &
                 2.0_dp*wire_mass*wire_rate**2*q(1, k)*v(1, k), &
                 dot_product(n, motion%jacobian(:, 1))*v(1, k)]
        end do
    end subroutine draw_power

    subroutine along_motions(systems, report, error)
        !! D'Alembert's sum on computed motions, for each displacement that the constraints allow.
        type(system_box_t), intent(in) :: systems(:)
        type(report_t), intent(inout) :: report
        type(error_t), allocatable, intent(out) :: error
        type(rolling_disk_t) :: disk
        type(description_t) :: d
        type(point_motion_t) :: motion
        real(dp), parameter :: heading(4) = [0.0_dp, 0.0_dp, 0.0_dp, 0.6_dp]
        real(dp) :: worst, v(4), a(4)
        integer :: i

        call report%section("sum of (m x_ddot - F).dx/dq on motions by RK4, relative, worst")
        do i = 1, size(systems)
            call systems(i)%item%describe(d)
            call on_motion(systems(i)%item, worst, error)
            if (allocated(error)) return
            call report%equal(d%name, worst, 0.0_dp, relative)
        end do
        call disk%configure([1.3_dp, 0.3_dp, 0.06_dp, 0.03_dp, 9.81_dp, 0.0_dp], error)
        if (allocated(error)) return
        call disk%complete_velocities(0.0_dp, heading, [4.0_dp, 1.1_dp], v, error)
        if (allocated(error)) return
        call disk%accelerations(0.0_dp, heading, v, a)
        call expand_points(disk, 0.0_dp, heading, v, a, motion)
        call report%equal("disk, a delta x that slips  [N]", &
                          sum((motion%mass*motion%acceleration - motion%force) &
                              *motion%jacobian(:, 1)), 0.0_dp, relative, control=.true.)
    end subroutine along_motions

    subroutine on_motion(system, worst, error)
        !! A hundred states of one motion.
        class(system_t), intent(in) :: system
        real(dp), intent(out) :: worst
        type(error_t), allocatable, intent(out) :: error
        real(dp), parameter :: step = 1e-3_dp
        real(dp) :: start(system%ndof), given(system%ndof - system%constraints), speed(system%ndof)
        real(dp) :: q(system%ndof, 100), v(system%ndof, 100), now(system%ndof), rate(system%ndof)
        integer :: j, k

        worst = 0.0_dp
        start = [(0.8_dp*sin(1.7_dp + 0.9_dp*j) + 1.0_dp, j=1, size(start))]
        given = [(1.1_dp*cos(2.3_dp + 1.1_dp*j), j=1, size(given))]
        call system%complete_velocities(0.0_dp, start, given, speed, error)
        if (allocated(error)) return
        call compute_path("rk4", system, 0.0_dp, step, start, speed, q, v, error)
        if (allocated(error)) return
        do k = 1, size(q, 2)
            now = q(:, k)
            rate = v(:, k)
            worst = max(worst, dalembert(system, (k - 1)*step, now, rate))
        end do
    end subroutine on_motion

    subroutine generalized_forces(systems, report, error)
        !! \(Q_j\) from forces on points beside \(-\partial V/\partial q_j\).
        type(system_box_t), intent(in) :: systems(:)
        type(report_t), intent(inout) :: report
        type(error_t), allocatable, intent(out) :: error
        real(dp), parameter :: m1 = 1.3_dp, m2 = 0.7_dp, l1 = 0.9_dp, l2 = 1.7_dp, g = 9.81_dp
        real(dp), parameter :: angles(2) = [0.4_dp, -1.1_dp], rates(2) = [0.7_dp, 1.9_dp]
        type(double_pendulum_t) :: two
        type(point_motion_t) :: motion
        type(description_t) :: d
        real(dp), allocatable :: q(:), v(:)
        real(dp) :: worst
        integer :: i, j, k

        call two%configure([m1, m2, l1, l2, g], error)
        if (allocated(error)) return
        call report%section("double pendulum, generalized forces: Q_j = sum of F.dx/dq_j")
        call expand_points(two, 0.0_dp, angles, rates, rates, motion)
        call report%equal("Q_1 = -(m1 + m2) g l1 sin(th1)  [N m]", &
                          dot_product(motion%force, motion%jacobian(:, 1)), &
                          -(m1 + m2)*g*l1*sin(angles(1)), rounding)
        call report%equal("Q_2 = -m2 g l2 sin(th2)  [N m]", &
                          dot_product(motion%force, motion%jacobian(:, 2)), &
                          -m2*g*l2*sin(angles(2)), rounding)
        call report%section("Q_j = -dV/dq_j with V = T - L, relative, worst of 20 states")
        do i = 1, size(systems)
            associate (system => systems(i)%item)
                call system%describe(d)
                if (d%name == "charged_particle") cycle
                allocate (q(system%ndof), v(system%ndof))
                worst = 0.0_dp
                do k = 1, 20
                    q = [(1.4_dp*sin(1.7_dp*k + 0.9_dp*j), j=1, size(q))]
                    v = [(1.4_dp*cos(2.3_dp*k + 1.1_dp*j), j=1, size(v))]
                    worst = max(worst, conservative_forces(system, 0.1_dp*k, q, v))
                end do
                deallocate (q, v)
                call report%equal(d%name, worst, 0.0_dp, relative)
            end associate
        end do
    end subroutine generalized_forces

    subroutine made_up_potentials(report, error)
        !! A potential that depends on the velocity: \(Q = -\partial U/\partial q + d/dt\,\partial
        !! U/\partial\dot q\) for arbitrary \(\varphi\), \(A\).
        type(report_t), intent(inout) :: report
        type(error_t), allocatable, intent(out) :: error
        real(dp), parameter :: t = 0.7_dp, e = -0.8_dp
        real(dp), parameter :: q(3) = [0.4_dp, 0.9_dp, -0.6_dp], v(3) = [0.6_dp, -1.3_dp, 0.5_dp]
        character(1), parameter :: axes(3) = ["x", "y", "z"]
        type(test_charge_t) :: charge
        real(dp) :: slope(3), induced(3), b(3), force(3), still(3)
        integer :: j

        call charge%configure([1.3_dp, e], error)
        if (allocated(error)) return
        call charge%fields(t, q, slope, induced, b)
        force = e*(slope + induced + [v(2)*b(3) - v(3)*b(2), v(3)*b(1) - v(1)*b(3), &
                                      v(1)*b(2) - v(2)*b(1)])
        call report%section("U = e phi - e A.v, made up: Q = -dU/dq + d/dt dU/dq_dot  [N]")
        do j = 1, 3
            call report%equal("Q_"//axes(j)//" = e (E + v x B)_"//axes(j), from_potential(j, v), &
                              force(j), rounding)
        end do
        still = 0.0_dp
        call report%equal("at rest: Q_x = -e dphi/dx - e dA_x/dt", from_potential(1, still), &
                          e*slope(1) + e*induced(1), rounding)
        call report%equal("at rest, without dA/dt: -e dphi/dx", from_potential(1, still), &
                          e*slope(1), rounding, control=.true.)
        call report%section("B = 0, made up: A = grad(chi), chi = x^2 y cos t + y z t; "// &
                            "moving [N]", slip="E10")
        charge%curl_free = .true.
        call charge%fields(t, q, slope, induced, b)
        call report%equal("B = 0: largest component of rot A  [T]", maxval(abs(b)), 0.0_dp, &
                          rounding)
        call report%equal("B = 0: Q_x = -e dPhi/dx, Phi = phi + dchi/dt", from_potential(1, v), &
                          e*(slope(1) + 2.0_dp*q(1)*q(2)*sin(t)), rounding)
        call report%equal("B = 0: Q_y = -e dPhi/dy, whatever A", from_potential(2, v), &
                          e*(slope(2) + q(1)**2*sin(t) - q(3)), rounding)
        call report%equal("B = 0: as in the notes, -dPhi/dx", from_potential(1, v), &
                          slope(1) + 2.0_dp*q(1)*q(2)*sin(t), rounding, control=.true.)
    contains
        pure function from_potential(i, rate) result(force_i)
            integer, intent(in) :: i
            real(dp), intent(in) :: rate(3)
            real(dp) :: force_i
            type(hyperdual_t) :: u, qq(3), vv(3)

            qq = hyperdual(q)
            vv = hyperdual(rate)
            qq(i)%d1 = 1.0_dp
            u = charge%potential(hyperdual(t), qq, vv)
            force_i = -u%d1
            ! along the motion; U is linear in the velocities, so accelerations drop out
            qq%d1 = 0.0_dp
            qq%d2 = rate
            vv(i)%d1 = 1.0_dp
            u = charge%potential(hyperdual_t(t, 0.0_dp, 1.0_dp, 0.0_dp), qq, vv)
            force_i = force_i + u%d12
        end function from_potential
    end subroutine made_up_potentials
end module lagrangia_virtual_work
