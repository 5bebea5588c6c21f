module lagrangia_vakonomic
    !! Why a nonholonomic constraint is not put into L: a disk that rolls on an incline, by
    !! D'Alembert's principle and with the constraint inside Hamilton's.
    use lagrangia_computed_path, only: compute_path
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp
    use lagrangia_number_text, only: rounded
    use lagrangia_report, only: report_t
    use lagrangia_rolling_disk, only: rolling_disk_t
    use lagrangia_text, only: to_text
    use lagrangia_vakonomic_disk, only: new_vakonomic_disk, vakonomic_disk_t
    implicit none (type, external)
    private
    public :: vakonomic_principle

    real(dp), parameter :: pi = acos(-1.0_dp)
    real(dp), parameter :: m = 1.3_dp, r = 0.3_dp, g = 9.81_dp, tilt = 0.1_dp
    real(dp), parameter :: i_roll = 0.5_dp*m*r**2, i_yaw = 0.25_dp*m*r**2
    real(dp), parameter :: roll = 4.0_dp, steer = 1.1_dp       !! rad/s, at the start
    real(dp), parameter :: kappa = 2.0_dp*g*sin(tilt)/(3.0_dp*r)  !! rad/s^2, of a disk that falls
    integer, parameter :: turns = 3
    real(dp), parameter :: locked = 0.7_dp                     !! rad, where nothing steers
    integer, parameter :: steps = 2000                         !! in these turns
    real(dp), parameter :: step = turns*2.0_dp*pi/steer/steps  !! s
    real(dp), parameter :: drift = 1e-11_dp                    !! rounding of 2000 steps, m

contains

    subroutine vakonomic_principle(report, error)
        !! All statements, and the picture.
        type(report_t), intent(out) :: report  !! the result
        type(error_t), allocatable, intent(out) :: error  !! allocated where it fails
        real(dp) :: true(4, steps + 1), inside(4, steps + 1)

        call report%begin("vakonomic: with its rolling constraint put into L a disk would do "// &
                          "another thing")
        call report%cite("I", 14, "nonholonomic constraint -> more difficult case")
        call report%cite("I", 126, "\Rightarrow \sum_{i} A_{i} \dot{q}_{i} + B = 0$$")
        call on_the_incline(true, inside, report, error)
        if (.not. allocated(error)) call steering_locked(report, error)
        if (allocated(error)) return
        call draw_paths(true, inside, report)
        call report%note("Inside L: L + mu1 (x_dot - R phi_dot sin(theta)) + mu2 (y_dot + R "// &
                         "phi_dot cos(theta)),")
        call report%note("'vakonomic'. x points down the incline of "//to_text(tilt)// &
                         " rad. A disk of "//to_text(m)//" kg, R = "//to_text(r)//" m, phi_dot")
        call report%note("= "//to_text(roll)//" rad/s and theta_dot = "//to_text(steer)// &
                         " rad/s at first, theta = 0 (along -y), mu1 = mu2 = 0 there;")
        call report%note("steering locked: theta = "//to_text(locked)//", theta_dot = 0. "// &
                         "Moments of inertia m R^2/2 about the axle,")
        call report%note("m R^2/4 about a diameter; kappa = 2 g sin("//to_text(tilt)// &
                         ")/(3 R): phi_ddot of one that rolls")
        call report%note("straight down; g = "//to_text(g)//" m/s^2.")
    end subroutine vakonomic_principle

    subroutine start_of(heading, steering, disk, inside, q0, v0, error)
        !! The same start for both.
        real(dp), intent(in) :: heading, steering
        type(rolling_disk_t), intent(out) :: disk
        type(vakonomic_disk_t), intent(out) :: inside
        real(dp), intent(out) :: q0(4), v0(4)
        type(error_t), allocatable, intent(out) :: error

        q0 = [0.0_dp, 0.0_dp, 0.0_dp, heading]
        v0 = 0.0_dp
        call disk%configure([m, r, i_roll, i_yaw, g, tilt], error)
        if (.not. allocated(error)) call disk%complete_velocities(0.0_dp, q0, [roll, steering], &
                                                                  v0, error)
        inside = new_vakonomic_disk(m, r, i_roll, i_yaw, g*sin(tilt), v0(1), v0(2))
    end subroutine start_of

    subroutine on_the_incline(true, other, report, error)
        !! Three turns of the true disk.
        real(dp), intent(out) :: true(4, steps + 1), other(4, steps + 1)
        type(report_t), intent(inout) :: report
        type(error_t), allocatable, intent(out) :: error
        type(rolling_disk_t) :: disk
        type(vakonomic_disk_t) :: inside
        real(dp) :: q0(4), v0(4), v(4, steps + 1), a(4)

        true = 0.0_dp
        other = 0.0_dp
        call start_of(0.0_dp, steer, disk, inside, q0, v0, error)
        if (.not. allocated(error)) call compute_path("gauss16", disk, 0.0_dp, step, q0, v0, &
                                                      true, v, error)
        if (allocated(error)) return
        call report%section("D'Alembert, as disks roll: "//to_text(turns)//" turns of the "// &
                            "heading, "//rounded(steps*step, 3)//" s")
        call disk%accelerations(0.0_dp, q0, v0, a)
        call report%equal("theta_ddot = 0: nothing steers  [rad/s^2]", a(4), 0.0_dp, 0.0_dp)
        call report%equal("x: it comes back up the incline  [m]", true(1, steps + 1), 0.0_dp, drift)
        call report%equal("y = R kappa/(2 theta_dot) t: sideways  [m]", true(2, steps + 1), &
                          r*kappa/(2.0_dp*steer)*steps*step, drift)
        call compute_path("gauss16", inside, 0.0_dp, step, q0, v0, other, v, error)
        if (allocated(error)) return
        call report%section("the constraint inside L, the same start: it rolls without "// &
                            "slipping, "// &
                            "but otherwise")
        call inside%accelerations(0.0_dp, q0, v0, a)
        call report%equal("is theta_ddot = 0?  after "//rounded(steps*step, 3)// &
                          " s  [rad/s^2]", &
                          steering_at_end(), 0.0_dp, drift, control=.true.)
        call report%equal("does it come back, x = 0?  [m]", other(1, steps + 1), 0.0_dp, drift, &
                          control=.true.)
        call report%equal("is its y that of the disk?  [m]", other(2, steps + 1), &
                          true(2, steps + 1), drift, control=.true.)
        call report%equal("its energy stays, too  [J]", &
                          energy_of(other(:, steps + 1), v(:, steps + 1)), &
                          0.5_dp*((m*r**2 + i_roll)*roll**2 + i_yaw*steer**2), 100.0_dp*drift)
        call report%equal("it does roll: x_dot = R phi_dot sin(theta)", v(1, steps + 1), &
                          r*v(3, steps + 1)*sin(other(4, steps + 1)), drift)
    contains
        pure function steering_at_end() result(bend)
            real(dp) :: bend
            real(dp) :: rate(4)

            call inside%accelerations(steps*step, other(:, steps + 1), v(:, steps + 1), rate)
            bend = rate(4)
        end function steering_at_end
    end subroutine on_the_incline

    pure function energy_of(q, v) result(energy)
        !! \(T - mg'x\).
        real(dp), intent(in) :: q(4), v(4)
        real(dp) :: energy

        energy = 0.5_dp*m*(v(1)**2 + v(2)**2) + 0.5_dp*i_roll*v(3)**2 + 0.5_dp*i_yaw*v(4)**2 &
                 - m*g*sin(tilt)*q(1)
    end function energy_of

    subroutine steering_locked(report, error)
        !! A heading that is held: the constraint can be integrated, and both ways are right.
        type(report_t), intent(inout) :: report
        type(error_t), allocatable, intent(out) :: error
        real(dp), parameter :: heading = locked, time = 3.0_dp
        integer, parameter :: n = 300
        type(rolling_disk_t) :: disk
        type(vakonomic_disk_t) :: inside
        real(dp) :: q0(4), v0(4), q(4, n + 1), v(4, n + 1), other(4, n + 1)

        call start_of(heading, 0.0_dp, disk, inside, q0, v0, error)
        if (.not. allocated(error)) call compute_path("gauss16", disk, 0.0_dp, time/n, q0, v0, q, &
                                                      v, error)
        inside%i_yaw = huge(1.0_dp)  ! no torque turns it
        if (.not. allocated(error)) call compute_path("gauss16", inside, 0.0_dp, time/n, q0, v0, &
                                                      other, v, error)
        if (allocated(error)) return
        call report%section("steering locked at "//to_text(heading)//" rad: x = x(phi), a "// &
                            "holonomic constraint; after "//to_text(nint(time))//" s")
        call report%equal("x: D'Alembert, inside L  [m]", q(1, n + 1), other(1, n + 1), drift)
        call report%equal("y: D'Alembert, inside L  [m]", q(2, n + 1), other(2, n + 1), drift)
        call report%equal("phi = phi_dot t + kappa sin(theta) t^2/2", other(3, n + 1), &
                          roll*time + 0.5_dp*kappa*sin(heading)*time**2, drift)
    end subroutine steering_locked

    subroutine draw_paths(true, inside, report)
        !! The picture: both paths on the incline, seen from above.
        real(dp), intent(in) :: true(4, steps + 1), inside(4, steps + 1)
        type(report_t), intent(inout) :: report
        integer, parameter :: every = 4
        integer :: k

        report%picture%file = "principle_vakonomic"
        report%picture%title = "A disk on an incline drifts sideways (y); with the constraint "// &
                               "inside L it would run down (x)"
        report%picture%names = [character(32) :: "t", "x as disks roll", "x inside L", &
                                "y as disks roll", "y inside L"]
        report%picture%units = [character(16) :: "s", "m", "m", "m", "m"]
        report%picture%panels = [character(98) :: "t:x as disks roll+x inside L", &
                                 "t:y as disks roll+y inside L"]
        allocate (report%picture%values(5, steps/every + 1))
        do k = 1, size(report%picture%values, 2)
            associate (i => every*(k - 1) + 1)
                report%picture%values(:, k) = [(i - 1)*step, true(1, i), inside(1, i), true(2, i), &
                                               inside(2, i)]
            end associate
        end do
    end subroutine draw_paths
end module lagrangia_vakonomic
