module lagrangia_constraints
    !! Holonomic or not, moving or not, and how many degrees of freedom: by computation.
    !!
    !! The notes call the disk nonholonomic because mixed partials differ. That shows only that the
    !! form is not exact: \(y\,dx - x\,dy = 0\) fails the same test and is holonomic. What decides
    !! is Frobenius' theorem: no integrating factor.
    use lagrangia_atwood, only: atwood_t
    use lagrangia_bouncing_ball, only: bouncing_ball_t
    use lagrangia_computed_path, only: compute_path
    use lagrangia_description, only: description_t
    use lagrangia_double_pendulum, only: double_pendulum_t
    use lagrangia_errors, only: error_t
    use lagrangia_hyperdual, only: hyperdual, hyperdual_t, operator(**), operator(*), &
                                   operator(+), operator(-)
    use lagrangia_kinds, only: dp
    use lagrangia_lapack, only: matrix_rank
    use lagrangia_lecture_constraints, only: classify, example_point, examples, &
                                             lecture_constraint_t, new_constraint, radius, turning
    use lagrangia_report, only: report_t
    use lagrangia_rolling_disk, only: rolling_disk_t
    use lagrangia_rotating_wire, only: rotating_wire_t
    use lagrangia_system, only: system_t
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: constraints_principle
    public :: loop_of_disk

    real(dp), parameter :: rounding = 1e-13_dp  !! of a few operations on numbers of order 1

contains

    subroutine constraints_principle(report, error)
        !! All statements, and the picture.
        type(report_t), intent(out) :: report  !! the result
        type(error_t), allocatable, intent(out) :: error  !! allocated where it fails

        call report%begin("constraints: which can be integrated to f(q, t) = c, and which move")
        call report%cite("I", 3, "3 n contesion coordinates for n particles {x;} 3 n-k "// &
                         "generalized coordinates (q; }")
        call report%cite("I", 13, "one variable becomes irrelevant for each holonomic constraint")
        call report%cite("II", 66, "moving constraints are rheonomic")
        call exactness(report)
        call integrability(report)
        call moving(report)
        call classes(report, error)
        if (allocated(error)) return
        call double_pendulum_configurations(report, error)
        if (allocated(error)) return
        call degrees_of_freedom(report, error)
        if (allocated(error)) return
        call disk_loop(report, error)
        if (allocated(error)) return
        call report%note("A constraint: sum of A_i dq_i + B dt = 0. da: the mixed partials of "// &
                         "all A_i and B.")
        call report%note("Coordinate i stands at 1.3 sin(3.4 + 2.1 i); the disk's are x, y, "// &
                         "phi, theta, and R = "//to_text(radius)//" m.")
        call report%note("The wire turns at W = "//to_text(turning)//" rad/s. Double pendulum: "// &
                         "th1 = 1.1 k, th2 = 2.3 k, k = 1 to 20.")
        call report%note("3n - k, on the right: the independent motions by the coordinates q "// &
                         "that break no constraint.")
        call report%note("y > 0 is no equation and takes no coordinate away; the notes call it "// &
                         "nonholonomic,")
        call report%note("here it is unilateral: lagrangia errata E14.")
        call report%note("Mixing: along one direction, another, back and back (Lie brackets). "// &
                         "The disk is")
        call report%note("led off its 2 directions to all 4. Where a constraint moves, time is "// &
                         "one more.")
    end subroutine constraints_principle

    subroutine exactness(report)
        !! The notes' test, mixed partials; and why it does not decide.
        type(report_t), intent(inout) :: report
        real(dp) :: x(5)

        x = example_point(4, 2)
        call report%section("mixed partials, largest |dA_i/dq_j - dA_j/dq_i|: zero where exact")
        call report%equal("double pendulum, f1", curl_of("double pendulum f1", 0), 0.0_dp, rounding)
        call report%equal("double pendulum, f2", curl_of("double pendulum f2", 0), 0.0_dp, rounding)
        call report%equal("Atwood's rope", curl_of("Atwood's rope", 0), 0.0_dp, rounding)
        call report%equal("rotating wire, the time included", curl_of("rotating wire", 0), 0.0_dp, &
                          rounding)
        call report%equal("disk, dx - R sin(theta) dphi: R cos(theta)", &
                          curl_of("disk, notes' dx", 0), radius*abs(cos(x(4))), rounding)
        call report%equal("y dx - x dy = 0: 2", curl_of("y dx - x dy = 0", 0), 2.0_dp, rounding)
        call report%show("E9")
        call report%equal("times 1/y^2: it is d(x/y), holonomic", &
                          curl_of("y dx - x dy = 0", 2), 0.0_dp, rounding)
        call report%show("E9")
        call report%equal("times 1/y: no integrating factor", curl_of("y dx - x dy = 0", 1), &
                          0.0_dp, rounding, control=.true.)
        call report%show("E9")
    contains
        pure function curl_of(name, factor) result(largest)
            character(*), intent(in) :: name
            integer, intent(in) :: factor
            real(dp) :: largest
            type(lecture_constraint_t) :: constraint

            call named(name, constraint)
            constraint%factor = factor
            largest = constraint%curl(example_point(constraint%coordinates, 2))
        end function curl_of
    end subroutine exactness

    pure subroutine named(name, constraint)
        !! The example of this name.
        character(*), intent(in) :: name
        type(lecture_constraint_t), intent(out) :: constraint

        call new_constraint(constraint, examples(findloc(examples%name == name, .true., 1)))
    end subroutine named

    subroutine integrability(report)
        !! Frobenius: da on what the constraints leave free, which no integrating factor changes.
        type(report_t), intent(inout) :: report
        type(lecture_constraint_t) :: forgetful
        real(dp) :: x(5)

        x = example_point(4, 2)
        call report%section("Frobenius, largest da on allowed directions: zero where integrable")
        call report%equal("y dx - x dy = 0", freedom_of("y dx - x dy = 0"), 0.0_dp, rounding)
        call report%show("E9")
        call report%equal("rotating wire, the time included", freedom_of("rotating wire"), 0.0_dp, &
                          rounding)
        call report%equal("disk, steering locked", freedom_of("disk, steering locked"), 0.0_dp, &
                          rounding)
        call report%equal("disk, notes' dx: R cos(theta)", freedom_of("disk, notes' dx"), &
                          radius*abs(cos(x(4))), rounding)
        call report%equal("disk, dx and dy: larger of R |cos|, R |sin|", freedom_of("disk"), &
                          radius*max(abs(cos(x(4))), abs(sin(x(4)))), rounding)
        call report%equal("is the disk integrable?", freedom_of("disk"), 0.0_dp, &
                          rounding, control=.true.)
        call report%show("E9")
        call report%equal("dx - t dy = 0: 1", freedom_of("dx - t dy = 0"), 1.0_dp, rounding)
        call named("dx - t dy = 0", forgetful)
        forgetful%timed = .false.
        call report%equal("dx - t dy = 0, the time forgotten", &
                          forgetful%frobenius(example_point(2, 2)), 1.0_dp, rounding, &
                          control=.true.)
    contains
        pure function freedom_of(name) result(largest)
            character(*), intent(in) :: name
            real(dp) :: largest
            type(lecture_constraint_t) :: constraint

            call named(name, constraint)
            largest = constraint%frobenius(example_point(constraint%coordinates, 2))
        end function freedom_of
    end subroutine integrability

    subroutine classes(report, error)
        !! The verdicts, and the dimensions behind them.
        type(report_t), intent(inout) :: report
        type(error_t), allocatable, intent(out) :: error
        type(lecture_constraint_t) :: constraint
        character(26) :: verdict
        integer :: growth(3), i

        call report%section("classes as computed; directions that mixing adds, none where "// &
                            "holonomic")
        do i = 1, size(examples)
            call new_constraint(constraint, examples(i))
            call classify(constraint, verdict, growth, error)
            if (allocated(error)) return
            call report%equal(trim(examples(i)%name)//": "//verdict, &
                              real(growth(3) - growth(1), dp), &
                              real(examples(i)%growth(3) - examples(i)%growth(1), dp), 0.0_dp)
            if (examples(i)%name == "y dx - x dy = 0") call report%show("E9")
            if (examples(i)%name == "y > 0") call report%show("E14")
        end do
    end subroutine classes

    subroutine moving(report)
        !! Rheonomic: the coefficients or the surface move.
        type(report_t), intent(inout) :: report
        type(lecture_constraint_t) :: wire, rope
        real(dp), parameter :: r = 2.0_dp, t = 0.4_dp
        real(dp), parameter :: place(3) = [r*cos(turning*t), r*sin(turning*t), t]
        type(hyperdual_t) :: a(1, 3)

        call report%section("scleronomic or rheonomic, largest |B|, |dA/dt|: zero where fixed")
        call named("Atwood's rope", rope)
        call report%equal("Atwood's rope", rope%motion(example_point(2, 2)), 0.0_dp, rounding)
        call named("rotating wire", wire)
        call report%equal("rotating wire at r = 2 m: |B| = W r  [m/s]", wire%motion(place), &
                          turning*r, rounding)
        call wire%forms(hyperdual(place), a)
        call report%equal("the same, with its sign: B = -W r  [m/s]", a(1, 3)%re, -turning*r, &
                          rounding)
    end subroutine moving

    subroutine double_pendulum_configurations(report, error)
        !! f1 and f2 wherever the pendulum is; the notes' f2 is no constraint of it.
        type(report_t), intent(inout) :: report
        type(error_t), allocatable, intent(out) :: error
        real(dp), parameter :: l1 = 0.9_dp, l2 = 1.7_dp
        type(double_pendulum_t) :: pendulum
        type(hyperdual_t) :: place(3, 2)
        real(dp) :: f1, f2, wrong, r(3, 2)
        integer :: k

        call report%section("double pendulum, l1 = 0.9 m, l2 = 1.7 m: the worst of 20 places", &
                            slip="E7")
        call pendulum%configure([1.3_dp, 0.7_dp, l1, l2, 9.81_dp], error)
        if (allocated(error)) return
        f1 = l1**2
        f2 = l2**2
        wrong = l2**2
        do k = 1, 20
            call pendulum%positions(hyperdual(0.0_dp), hyperdual([1.1_dp*k, 2.3_dp*k]), place)
            r = place%re
            call keep(f1, sum(r(:, 1)**2), l1**2)
            call keep(f2, sum((r(:, 2) - r(:, 1))**2), l2**2)
            call keep(wrong, sum(r(:, 2)**2), l2**2)
        end do
        call report%equal("f1 = x1^2 + y1^2 = l1^2  [m^2]", f1, l1**2, rounding)
        call report%equal("f2 = (x2 - x1)^2 + (y2 - y1)^2 = l2^2  [m^2]", f2, l2**2, rounding)
        call report%equal("the notes' f2 = x2^2 + y2^2 = l2^2  [m^2]", wrong, l2**2, rounding, &
                          control=.true.)
    end subroutine double_pendulum_configurations

    pure subroutine keep(farthest, value, from)
        !! The one of two that is farther from `from`.
        real(dp), intent(inout) :: farthest
        real(dp), intent(in) :: value, from

        if (abs(value - from) > abs(farthest - from)) farthest = value
    end subroutine keep

    subroutine degrees_of_freedom(report, error)
        !! 3n - k, k the number of independent constraints in Cartesian coordinates, beside the
        !! number of ways in which the coordinates of the system move its points as they allow.
        type(report_t), intent(inout) :: report
        type(error_t), allocatable, intent(out) :: error
        type(double_pendulum_t) :: two
        type(atwood_t) :: rope
        type(rotating_wire_t) :: bead
        type(bouncing_ball_t) :: ball

        call report%section("degrees of freedom, 3n - k, k: rank of all constraints of n "// &
                            "particles; motions by q")
        call two%configure([1.3_dp, 0.7_dp, 0.9_dp, 1.7_dp, 9.81_dp], error)
        if (.not. allocated(error)) call count_ways("double pendulum", two, [1.1_dp, 2.3_dp])
        if (.not. allocated(error)) call rope%configure([1.3_dp, 0.7_dp, 9.81_dp, 0.0_dp, &
                                                            0.1_dp, 0.0_dp], error)
        if (.not. allocated(error)) call count_ways("Atwood", rope, [0.4_dp])
        if (.not. allocated(error)) call bead%configure([0.3_dp, turning], error)
        if (.not. allocated(error)) call count_ways("bead on the rotating wire", bead, [0.9_dp])
        if (.not. allocated(error)) call ball%configure([0.5_dp, 9.81_dp, 0.8_dp], error)
        if (.not. allocated(error)) call count_ways("ball over a floor, y > 0", ball, [0.0_dp])
        if (.not. allocated(error)) call report%show("E14")
        if (.not. allocated(error)) call count_ways("ball held on it, y = 0", ball, [0.0_dp])
    contains
        subroutine count_ways(name, system, q)
            !! Of one system at the time 0.4 s.
            character(*), intent(in) :: name
            class(system_t), intent(in) :: system
            real(dp), intent(in) :: q(:)
            type(hyperdual_t), allocatable :: r(:, :), x(:), f(:)
            type(hyperdual_t) :: moved(size(q))
            type(description_t) :: d
            real(dp), allocatable :: places(:), slopes(:, :), ways(:, :)
            logical :: allowed(size(q))
            integer, allocatable :: columns(:)  ! of the ways that are possible
            integer :: i, k, n, possible

            call system%describe(d)
            n = 3*size(d%points)
            allocate (r(3, n/3), x(n), f(number_of(name)), slopes(number_of(name), n), &
                      ways(n, size(q)))
            do i = 1, size(q)
                moved = hyperdual(q)
                moved(i)%d1 = 1.0_dp
                call system%positions(hyperdual(0.4_dp), moved, r)
                ways(:, i) = [(r(:, k)%d1, k=1, n/3)]
            end do
            places = [(r(:, k)%re, k=1, n/3)]
            do i = 1, n
                x = hyperdual(places)
                x(i)%d1 = 1.0_dp
                call stated(name, x, f)
                slopes(:, i) = f%d1
            end do
            allowed = maxval(abs(matmul(slopes, ways)), 1) <= rounding
            call matrix_rank(slopes, k, error)
            columns = pack([(i, i=1, size(q))], allowed)
            ways = ways(:, columns)
            if (.not. allocated(error)) call matrix_rank(ways, possible, error)
            if (allocated(error)) return
            call report%equal(name//": "//to_text(n)//" - "//to_text(k), real(n - k, dp), &
                              real(possible, dp), 0.0_dp)
        end subroutine count_ways
    end subroutine degrees_of_freedom

    pure integer function number_of(name)
        !! How many constraints `stated` has.
        character(*), intent(in) :: name

        number_of = 2
        if (name == "double pendulum") number_of = 4
        if (name == "Atwood") number_of = 5
        if (name == "ball held on it, y = 0") number_of = 3
    end function number_of

    pure subroutine stated(name, x, f)
        !! All constraints of a system at 0.4 s, zero but for a constant: x, y, z of each particle.
        character(*), intent(in) :: name
        type(hyperdual_t), intent(in) :: x(:)
        type(hyperdual_t), intent(out) :: f(:)

        select case (name)
        case ("double pendulum")  ! in a plane, two rods
            f = [x(3), x(6), x(1)**2 + x(2)**2, (x(4) - x(1))**2 + (x(5) - x(2))**2]
        case ("Atwood")           ! both hang straight down, and share a rope
            f = [x(1), x(3), x(4), x(6), x(2) + x(5)]
        case ("ball over a floor, y > 0")
            f = [x(1), x(3)]
        case ("ball held on it, y = 0")
            f = [x(1), x(3), x(2)]
        case default              ! bead: in a plane, on the wire
            f = [x(3), cos(0.4_dp*turning)*x(2) - sin(0.4_dp*turning)*x(1)]
        end select
    end subroutine stated

    subroutine disk_loop(report, error)
        !! Roll, steer, roll back, steer back: the angles are as before, the place is not.
        type(report_t), intent(inout) :: report
        type(error_t), allocatable, intent(out) :: error
        real(dp), parameter :: heading(2) = [0.4_dp, 1.5_dp], rolled = 5.0_dp  !! rad
        real(dp), allocatable :: path(:, :)

        call loop_of_disk(heading, rolled, path, error)
        if (allocated(error)) return
        call report%section("disk, R = 0.3 m: roll by 5 rad = ph2 - ph1, steer from th1 = 0.4 "// &
                            "to th2 = 1.5, and back")
        associate (last => path(:, size(path, 2)))
            call report%equal("phi is as before  [rad]", last(4), 0.0_dp, rounding)
            call report%equal("theta is as before  [rad]", last(5), heading(1), rounding)
            call report%equal("x = -R (sin th2 - sin th1)(ph2 - ph1)  [m]", last(2), &
                              -radius*(sin(heading(2)) - sin(heading(1)))*rolled, rounding)
            call report%equal("y = R (cos th2 - cos th1)(ph2 - ph1)  [m]", last(3), &
                              radius*(cos(heading(2)) - cos(heading(1)))*rolled, rounding)
            call report%equal("is x as before?  [m]", last(2), 0.0_dp, &
                              rounding, control=.true.)
        end associate
        report%picture%file = "principle_constraints"
        report%picture%title = "A disk rolls, steers, rolls back, steers back, and is elsewhere"
        report%picture%names = [character(32) :: "t", "x", "y", "phi", "theta"]
        report%picture%units = [character(16) :: "s", "m", "m", "rad", "rad"]
        report%picture%panels = [character(98) :: "x:y", "t:phi+theta"]
        call move_alloc(path, report%picture%values)
    end subroutine disk_loop

    subroutine loop_of_disk(heading, rolled, path, error)
        !! Time, x, y, phi, theta along the loop, by RK4 on the rolling disk's equations.
        real(dp), intent(in) :: heading(2)  !! rad
        real(dp), intent(in) :: rolled      !! rad
        real(dp), allocatable, intent(out) :: path(:, :)  !! (5, samples)
        type(error_t), allocatable, intent(out) :: error  !! allocated where it fails
        integer, parameter :: n = 50  !! steps of one second together
        type(rolling_disk_t) :: disk
        real(dp) :: q(4, n + 1), v(4, n + 1), start(4), speed(4), given(2, 4)
        integer :: leg, k

        call disk%configure([1.3_dp, radius, 0.06_dp, 0.03_dp, 9.81_dp, 0.0_dp], error)
        if (allocated(error)) return
        given = reshape([rolled, 0.0_dp, 0.0_dp, heading(2) - heading(1), -rolled, 0.0_dp, 0.0_dp, &
                         heading(1) - heading(2)], [2, 4])
        allocate (path(5, 4*n + 1))
        start = [0.0_dp, 0.0_dp, 0.0_dp, heading(1)]
        do leg = 1, 4
            call disk%complete_velocities(0.0_dp, start, given(:, leg), speed, error)
            if (allocated(error)) return
            call compute_path("rk4", disk, 0.0_dp, 1.0_dp/n, start, speed, q, v, error)
            if (allocated(error)) return
            do k = 1, n + 1
                path(1, (leg - 1)*n + k) = leg - 1 + (k - 1)/real(n, dp)
                path(2:, (leg - 1)*n + k) = q(:, k)
            end do
            start = q(:, n + 1)
        end do
    end subroutine loop_of_disk
end module lagrangia_constraints
