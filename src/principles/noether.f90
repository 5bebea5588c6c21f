module lagrangia_noether
    !! Noether's theorem found, not told: which changes of coordinates and time leave L as it is,
    !! and what is conserved for it.
    use lagrangia_cart_pendulum, only: cart_pendulum_t
    use lagrangia_charged_particle, only: charged_particle_t
    use lagrangia_computed_path, only: compute_path
    use lagrangia_double_pendulum, only: double_pendulum_t
    use lagrangia_errors, only: error_t
    use lagrangia_generators, only: boost, conserved_values, count_generators, find_symmetries, &
                                    linear, of_coordinate, of_sine, of_time, outside, shift
    use lagrangia_kinds, only: dp
    use lagrangia_report, only: report_t
    use lagrangia_rotating_hoop, only: rotating_hoop_t
    use lagrangia_system, only: system_t
    use lagrangia_text, only: to_text
    use lagrangia_vectors, only: farthest
    implicit none (type, external)
    private
    public :: noether_principle

    integer, parameter :: samples = 301
    real(dp), parameter :: step = 0.01_dp       !! s
    real(dp), parameter :: found = 1e-11_dp     !! a null vector's rounding: 200 rows of 25 terms
    real(dp), parameter :: kept = 1e-12_dp      !! rounding of 300 steps, beside numbers up to 20
    real(dp), parameter :: m1 = 1.3_dp, m2 = 0.7_dp, l = 0.9_dp, g = 9.81_dp

contains

    subroutine noether_principle(report, error)
        !! All statements, and the picture.
        type(report_t), intent(out) :: report  !! the result
        type(error_t), allocatable, intent(out) :: error  !! allocated where it fails

        call report%begin("noether: what leaves L as it is, but for a dF/dt, is searched for; "// &
                          "what each conserves")
        call report%cite("I", 99, "+ \frac{dF}{dt}$ with $F(\{q_j\},t)$")
        call report%cite("I", 107, "=> F does not show up in the equations of motion")
        call on_the_cart(report, error)
        if (.not. allocated(error)) call two_rods(report, error)
        if (.not. allocated(error)) call in_a_field(report, error)
        if (.not. allocated(error)) call on_the_hoop(report, error)
        if (allocated(error)) return
        call report%note("Cart-pendulum: m1 = "//to_text(m1)//" kg, m2 = "//to_text(m2)// &
                         " kg, l = "//to_text(l)//" m, g = "//to_text(g)//" m/s^2.")
        call report%note("M = m1 + m2, x_com = x + m2 l sin(theta)/M; from x = 0.3 m, theta "// &
                         "= 1.1 rad, x_dot = 0.8")
        call report%note("m/s, theta_dot = -1.3 rad/s. Double pendulum: the same m1, m2, l1 "// &
                         "= 0.9 m, l2 = 1.7 m;")
        call report%note("from 0.4 and -1.1 rad with 0.7 and 1.9 rad/s. Charge: m = 1.3 kg, "// &
                         "e = -0.8 C, B = 1.5 T;")
        call report%note("from (0.4, 0.9, -0.6) m with (0.6, -1.3, 0.5) m/s. Hoop: m = 0.6 "// &
                         "kg, R = 0.9 m; from 0.8")
        call report%note("rad with 1.4 rad/s. Tried: delta q = 1, t or a q in each "// &
                         "direction, delta t = 1; F: t,")
        call report%note("q, sin q, cos q, q q'. Part not found: 0 if a change of length 1 "// &
                         "is among those found, 1")
        call report%note("if nothing of it is.")
    end subroutine noether_principle

    subroutine on_the_cart(report, error)
        !! \(p_x\), the boost, the energy; and the picture.
        type(report_t), intent(inout) :: report
        type(error_t), allocatable, intent(out) :: error
        integer, parameter :: n = 2
        real(dp), parameter :: q0(2) = [0.3_dp, 1.1_dp], v0(2) = [0.8_dp, -1.3_dp]
        type(cart_pendulum_t) :: cart
        real(dp), allocatable :: symmetries(:, :)
        real(dp) :: known(count_generators(n), 4), values(4, samples)

        call cart%configure([m1, m2, l, g], error)
        if (.not. allocated(error)) call find_symmetries(cart, symmetries, error)
        if (allocated(error)) return
        known = 0.0_dp
        known(shift(1), 1) = 1.0_dp
        known(boost(n, 1), 2) = 1.0_dp
        known(of_coordinate(n, 1), 2) = m1 + m2
        known(of_sine(n, 2), 2) = m2*l
        known(of_time(n), 3) = -1.0_dp
        known(shift(2), 4) = 1.0_dp
        call report%section("cart-pendulum: of 9 changes, those that leave L as it is but "// &
                            "for dF/dt")
        call report%equal("how many are found", real(size(symmetries, 2), dp), 3.0_dp, 0.0_dp)
        call report%equal("delta x = 1, for p_x: part not found", outside(symmetries, known(:, &
                                                                                            1)), &
                          0.0_dp, found)
        call report%equal("delta x = t, F = M x_com: part not found", &
                          outside(symmetries, known(:, 2)), 0.0_dp, found)
        call report%equal("delta t = 1, for h: part not found", &
                          outside(symmetries, known(:, 3)), 0.0_dp, found)
        call report%equal("delta theta = 1?  part not found", outside(symmetries, known(:, 4)), &
                          0.0_dp, &
                          found, control=.true.)
        call follow(cart, known, q0, v0, values, error)
        if (allocated(error)) return
        call report%section("cart-pendulum: largest change of each along a motion of 3 s")
        call report%equal("p_x  [kg m/s]", change(values(1, :)), 0.0_dp, kept)
        call report%equal("p_x t - M x_com  [kg m]", change(values(2, :)), 0.0_dp, kept)
        call report%equal("h  [J]", change(values(3, :)), 0.0_dp, 10.0_dp*kept)
        call report%equal("p_theta?  [kg m^2/s]", change(values(4, :)), 0.0_dp, kept, &
                          control=.true.)
        call draw(values, report)
    end subroutine on_the_cart

    subroutine two_rods(report, error)
        !! The double pendulum: \(L_z\) only where nothing pulls down.
        type(report_t), intent(inout) :: report
        type(error_t), allocatable, intent(out) :: error
        real(dp), parameter :: pull(2) = [0.0_dp, g], q0(2) = [0.4_dp, -1.1_dp], &
                               v0(2) = [0.7_dp, 1.9_dp]
        type(double_pendulum_t) :: two
        real(dp), allocatable :: symmetries(:, :)
        real(dp) :: turn(count_generators(2), 1), values(1, samples)
        integer :: i

        turn = 0.0_dp
        turn(shift(1), 1) = 1.0_dp
        turn(shift(2), 1) = 1.0_dp
        do i = 1, size(pull)
            call two%configure([m1, m2, l, 1.7_dp, pull(i)], error)
            if (.not. allocated(error)) call find_symmetries(two, symmetries, error)
            if (.not. allocated(error)) call follow(two, turn, q0, v0, values, error)
            if (allocated(error)) return
            if (i == 1) then
                call report%section("double pendulum without g: turning both rods; 3 s")
            else
                call report%section("double pendulum with g: is it still so?")
            end if
            call report%equal("how many are found", real(size(symmetries, 2), dp), real(3 - i, &
                                                                                        dp), 0.0_dp)
            call report%equal("delta th1 = delta th2 = 1: part not found", &
                              outside(symmetries, turn(:, 1)), 0.0_dp, found, control=i == 2)
            call report%equal("L_z = p1 + p2, change  [kg m^2/s]", change(values(1, :)), 0.0_dp, &
                              10.0_dp*kept, control=i == 2)
        end do
    end subroutine two_rods

    subroutine in_a_field(report, error)
        !! A charge in a uniform B: shifts need an F, and give \(m v_x - eBy\).
        type(report_t), intent(inout) :: report
        type(error_t), allocatable, intent(out) :: error
        real(dp), parameter :: m = 1.3_dp, e = -0.8_dp, b = 1.5_dp
        real(dp), parameter :: q0(3) = [0.4_dp, 0.9_dp, -0.6_dp], v0(3) = [0.6_dp, -1.3_dp, 0.5_dp]
        integer, parameter :: n = 3
        type(charged_particle_t) :: charge
        real(dp), allocatable :: symmetries(:, :)
        real(dp) :: known(count_generators(n), 3), values(3, samples)

        call charge%configure([m, e, 0.0_dp, 0.0_dp, 0.0_dp, 0.0_dp, 0.0_dp, b, 0.0_dp], error)
        if (.not. allocated(error)) call find_symmetries(charge, symmetries, error)
        if (allocated(error)) return
        known = 0.0_dp
        known(shift(1), 1) = 1.0_dp
        known(of_coordinate(n, 2), 1) = 0.5_dp*e*b
        known(linear(n, 2, 1), 2) = 1.0_dp
        known(linear(n, 1, 2), 2) = -1.0_dp
        known(shift(1), 3) = 1.0_dp
        call follow(charge, known, q0, v0, values, error)
        if (allocated(error)) return
        call report%section("charge in B along z, A = B x r/2: L changes when all is shifted "// &
                            "along x; 3 s")
        call report%equal("found: x, y, z, turn, boost along z, time", &
                          real(size(symmetries, 2), dp), 6.0_dp, 0.0_dp)
        call report%equal("delta x = 1, F = e B y/2: part not found", outside(symmetries, &
                                                                              known(:, 1)), &
                          0.0_dp, found)
        call report%equal("that is m v_x - e B y  [kg m/s]", values(1, samples), &
                          m*v0(1) - e*b*q0(2), 10.0_dp*kept)
        call report%equal("delta (x, y) = (-y, x): part not found", &
                          outside(symmetries, known(:, 2)), 0.0_dp, found)
        call report%equal("x m v_y - y m v_x + e B r^2/2  [kg m^2/s]", values(2, samples), &
                          m*(q0(1)*v0(2) - q0(2)*v0(1)) + 0.5_dp*e*b*(q0(1)**2 + q0(2)**2), &
                          10.0_dp*kept)
        call report%equal("delta x = 1 without F?  part not found", outside(symmetries, known(:, &
                                                                                              3)), &
                          0.0_dp, found, control=.true.)
        call report%equal("p_x, change?  [kg m/s]", change(values(3, :)), 0.0_dp, kept, &
                          control=.true.)
    end subroutine in_a_field

    subroutine on_the_hoop(report, error)
        !! A constraint that moves: h is conserved, \(T + V\) is not.
        type(report_t), intent(inout) :: report
        type(error_t), allocatable, intent(out) :: error
        real(dp), parameter :: m = 0.6_dp, r = 0.9_dp, w = 4.0_dp, q0(1) = 0.8_dp, v0(1) = 1.4_dp
        type(rotating_hoop_t) :: hoop
        real(dp), allocatable :: symmetries(:, :)
        real(dp) :: time(count_generators(1), 1), values(1, samples), energy(samples)
        real(dp) :: q(1, samples), v(1, samples)

        call hoop%configure([m, r, w, g], error)
        if (.not. allocated(error)) call find_symmetries(hoop, symmetries, error)
        time = 0.0_dp
        time(of_time(1), 1) = -1.0_dp
        if (.not. allocated(error)) call follow(hoop, time, q0, v0, values, error)
        if (.not. allocated(error)) call compute_path("gauss16", hoop, 0.0_dp, step, q0, v0, q, &
                                                      v, error)
        if (allocated(error)) return
        energy = 0.5_dp*m*r**2*(v(1, :)**2 + (w*sin(q(1, :)))**2) - m*g*r*cos(q(1, :))
        call report%section("bead on a hoop that is turned at 4 rad/s: the motor works; 3 s")
        call report%equal("how many are found", real(size(symmetries, 2), dp), 1.0_dp, 0.0_dp)
        call report%equal("delta t = 1, for h: part not found", outside(symmetries, time(:, 1)), &
                          0.0_dp, &
                          found)
        call report%equal("h = theta_dot dL/dtheta_dot - L, change  [J]", change(values(1, :)), &
                          0.0_dp, 10.0_dp*kept)
        call report%equal("T + V, change?  [J]", change(energy), 0.0_dp, 10.0_dp*kept, &
                          control=.true.)
    end subroutine on_the_hoop

    subroutine follow(system, generators, q0, v0, values, error)
        !! What each change would conserve, along a motion.
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: generators(:, :), q0(:), v0(:)
        real(dp), intent(out) :: values(:, :)
        type(error_t), allocatable, intent(out) :: error
        real(dp) :: q(system%ndof, samples), v(system%ndof, samples)
        integer :: k

        values = 0.0_dp
        call compute_path("gauss16", system, 0.0_dp, step, q0, v0, q, v, error)
        if (allocated(error)) return
        do k = 1, samples
            values(:, k) = conserved_values(system, generators, (k - 1)*step, q(:, k), v(:, k))
        end do
    end subroutine follow

    pure function change(values) result(largest)
        !! From the first one.
        real(dp), intent(in) :: values(:)
        real(dp) :: largest

        largest = farthest(values, spread(values(1), 1, size(values)))
    end function change

    subroutine draw(values, report)
        !! The picture: three that stay, one that does not.
        real(dp), intent(in) :: values(4, samples)
        type(report_t), intent(inout) :: report
        integer :: k

        report%picture%file = "principle_noether"
        report%picture%title = "Cart-pendulum: what Noether's search finds stays; p_theta swings"
        report%picture%names = [character(32) :: "t", "p_x", "p_x t - M x_com", "h", "p_theta"]
        report%picture%units = [character(16) :: "s", "kg m/s", "kg m", "J", "kg m^2/s"]
        report%picture%panels = [character(98) :: "t:p_x", "t:p_x t - M x_com", "t:h", "t:p_theta"]
        allocate (report%picture%values(5, samples))
        do k = 1, samples
            report%picture%values(:, k) = [(k - 1)*step, values(:, k)]
        end do
    end subroutine draw
end module lagrangia_noether
