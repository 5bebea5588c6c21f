module lagrangia_which_forces
    !! Which forces have an L? Helmholtz' conditions on given forces, and what they mean: a force
    !! without a potential does work around a loop, or takes energy away.
    use lagrangia_errors, only: error_t
    use lagrangia_helmholtz, only: test_potential
    use lagrangia_hyperdual, only: cos, exp, hyperdual, hyperdual_t, operator(*), operator(**), &
        operator(+), operator(-), sin
    use lagrangia_kinds, only: dp
    use lagrangia_other_lagrangians, only: bare_lagrangian_t
    use lagrangia_report, only: report_t
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: forced_t, which_forces_principle

    real(dp), parameter :: pi = acos(-1.0_dp)
    real(dp), parameter :: m = 0.5_dp, k = 2.0_dp, gamma = 0.6_dp   !! kg, N/m, 1/s
    real(dp), parameter :: field = 1.5_dp, curl = 0.8_dp            !! e B, N s/m; N/m
    integer, parameter :: samples = 201                             !! around a circle
    real(dp), parameter :: rounding = 1e-13_dp  !! of sums of 200 terms below 0.1

    type, extends(bare_lagrangian_t) :: forced_t
        !! A mass in the plane with L = T and a force beside it.
        integer :: force = 1  !! of `forces`
    contains
        procedure :: lagrangian
        procedure :: generalised_forces
    end type forced_t

    character(30), parameter :: forces(5) = [character(30) :: "-grad(x^2 y + cos y)", &
        "e v x B, B along z", "-m gamma v, friction", "(-c y, c x): it has a curl", &
        "c x^2 cos t, along x"]
    logical, parameter :: has_one(5) = [.true., .true., .false., .false., .true.]

contains

    subroutine which_forces_principle(report, error)
        !! All statements, and the picture.
        type(report_t), intent(out) :: report  !! the result
        type(error_t), allocatable, intent(out) :: error  !! allocated where it fails

        if (allocated(error)) return
        call report%begin("helmholtz: which forces come from an L, by conditions on the forces "// &
                          "alone")
        call report%cite("II", 60, "the forces acting on the system must be derivable from "// &
                         "potentials")
        call by_conditions(report)
        call around_circles(report)
        call with_a_factor(report)
        call draw_work(report)
        call report%note("Conditions: dQ_i/dq_j_dot antisymmetric, dQ_i/dq_j - dQ_j/dq_i its "// &
                         "rate; "// &
                         "at 20 random states.")
        call report%note("m = "//to_text(m)//" kg, k = "//to_text(k)//" N/m, gamma = "// &
                         to_text(gamma)//"/s, e B = "//to_text(field)//" N s/m, c = "// &
                         to_text(curl)//" N/m; f at 1.3 s.")
        call report%note("Friction has an L with a factor exp(gamma t): see lagrangia "// &
                         "principle "// &
                         "same-motion.")
    end subroutine which_forces_principle

    pure function lagrangian(self, t, q, v) result(l)
        !! \(T\).
        class(forced_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof), v(self%ndof)
        type(hyperdual_t) :: l

        l = 0.5_dp*m*(v(1)**2 + v(2)**2) + 0.0_dp*q(1) + 0.0_dp*t
    end function lagrangian

    pure subroutine generalised_forces(self, t, q, v, f)
        !! See `system_t`.
        class(forced_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof), v(self%ndof)
        type(hyperdual_t), intent(out) :: f(self%ndof)

        select case (self%force)
        case (1)
            f(1) = (-2.0_dp)*q(1)*q(2)
            f(2) = sin(q(2)) - q(1)**2
        case (2)
            f(1) = field*v(2)
            f(2) = (-field)*v(1)
        case (3)
            f(1) = (-m*gamma)*v(1)
            f(2) = (-m*gamma)*v(2)
        case (4)
            f(1) = (-curl)*q(2)
            f(2) = curl*q(1)
        case default
            f(1) = curl*q(1)**2*cos(t)
            f(2) = hyperdual(0.0_dp)
        end select
    end subroutine generalised_forces

    pure function forced_by(force) result(mass)
        !! One of `forces`.
        integer, intent(in) :: force
        type(forced_t) :: mass

        mass%ndof = 2
        mass%nonconservative = .true.
        mass%time_dependent = force == 5
        mass%force = force
    end function forced_by

    subroutine by_conditions(report)
        !! 1 where there is a potential \(U(q, \dot q, t)\).
        type(report_t), intent(inout) :: report
        character(:), allocatable :: remark
        logical :: found
        integer :: i

        call report%section("is there a U with Q = d/dt dU/dq_dot - dU/dq?  1: yes, 0: no")
        do i = 1, size(forces)
            call test_potential(forced_by(i), found, remark)
            call report%equal(trim(forces(i)), merge(1.0_dp, 0.0_dp, found), 1.0_dp, 0.0_dp, &
                              control=.not. has_one(i))
        end do
    end subroutine by_conditions

    pure function work_around(force, part) result(work)
        !! Once around the unit circle about (1, 1), in 2 pi s, or a part of it; by trapezoids,
        !! which are exact for a period of a few waves.
        integer, intent(in) :: force
        real(dp), intent(in) :: part
        real(dp) :: work
        type(forced_t) :: mass
        type(hyperdual_t) :: t, q(2), v(2), f(2)
        real(dp) :: s
        integer :: i

        mass = forced_by(force)
        work = 0.0_dp
        do i = 0, samples - 1
            s = 2.0_dp*pi*part*i/(samples - 1)
            t = hyperdual(0.0_dp)
            q = hyperdual([1.0_dp + cos(s), 1.0_dp + sin(s)])
            v = hyperdual([-sin(s), cos(s)])
            call mass%generalised_forces(t, q, v, f)
            work = work + merge(0.5_dp, 1.0_dp, i == 0 .or. i == samples - 1) &
                   *(f(1)%re*v(1)%re + f(2)%re*v(2)%re)*2.0_dp*pi*part/(samples - 1)
        end do
    end function work_around

    subroutine around_circles(report)
        !! Work around a loop.
        type(report_t), intent(inout) :: report

        call report%section("work around a circle of 1 m in 2 pi s  [J]")
        call report%equal("a gradient: none", work_around(1, 1.0_dp), 0.0_dp, rounding)
        call report%equal("a magnetic force: none, v x B is across v", work_around(2, 1.0_dp), &
                          0.0_dp, rounding)
        call report%equal("a force with a curl: 2 c times the area", work_around(4, 1.0_dp), &
                          2.0_dp*curl*pi, rounding)
        call report%equal("friction: -m gamma v^2 times the time", work_around(3, 1.0_dp), &
                          -m*gamma*2.0_dp*pi, rounding)
        call report%equal("does a force with a curl do no work?", work_around(4, 1.0_dp), 0.0_dp, &
                          rounding, control=.true.)
    end subroutine around_circles

    subroutine with_a_factor(report)
        !! The whole equation, \(E = f(t)(m\ddot x + m\gamma\dot x + kx)\), comes from an L where
        !! \(\partial E/\partial\dot x = d/dt\,\partial E/\partial\ddot x\): with
        !! \(f = e^{\gamma t}\).
        type(report_t), intent(inout) :: report
        real(dp), parameter :: x(3) = [0.7_dp, -0.9_dp, 1.4_dp], time = 1.3_dp
        integer, parameter :: of_speed = 2, of_acceleration = 3

        call report%section("damped oscillator, E = f(t)(m x_ddot + m gamma x_dot + k x): "// &
                            "dE/dx_dot = d/dt dE/dx_ddot?")
        call report%equal("f = exp(gamma t): both sides  [kg/s]", slope(gamma, of_speed), &
                          rate(gamma), rounding)
        call report%equal("f = 1: is it so?", slope(0.0_dp, of_speed), rate(0.0_dp), rounding, &
                          control=.true.)
    contains
        pure function whole(growth, t, y) result(e)
            real(dp), intent(in) :: growth
            type(hyperdual_t), intent(in) :: t, y(3)
            type(hyperdual_t) :: e

            e = exp(growth*t)*(m*y(3) + m*gamma*y(2) + k*y(1))
        end function whole

        pure function slope(growth, by) result(d)
            real(dp), intent(in) :: growth
            integer, intent(in) :: by
            real(dp) :: d
            type(hyperdual_t) :: t, y(3), e

            t = hyperdual(time)
            y = hyperdual(x)
            y(by)%d1 = 1.0_dp
            e = whole(growth, t, y)
            d = e%d1
        end function slope

        pure function rate(growth) result(d)
            real(dp), intent(in) :: growth
            real(dp) :: d
            type(hyperdual_t) :: t, y(3), e

            ! E is linear in x, x_dot and x_ddot: of its slope only the factor changes
            t = hyperdual(time)
            t%d2 = 1.0_dp
            y = hyperdual(x)
            y(of_acceleration)%d1 = 1.0_dp
            e = whole(growth, t, y)
            d = e%d12
        end function rate
    end subroutine with_a_factor

    subroutine draw_work(report)
        !! The picture: work on the way around.
        type(report_t), intent(inout) :: report
        integer :: i

        report%picture%file = "principle_helmholtz"
        report%picture%title = "Work once around a circle: none of a gradient, some of a "// &
                               "curl and "// &
                               "of friction"
        report%picture%names = [character(32) :: "part of the circle", "gradient", "magnetic", &
                                "curl", "friction"]
        report%picture%units = [character(16) :: "1", "J", "J", "J", "J"]
        report%picture%panels = [character(98) :: &
                                 "part of the circle:gradient+magnetic+curl+friction"]
        allocate (report%picture%values(5, 101))
        do i = 1, 101
            associate (part => 0.01_dp*(i - 1))
                report%picture%values(:, i) = [part, work_around(1, part), work_around(2, part), &
                                               work_around(4, part), work_around(3, part)]
            end associate
        end do
    end subroutine draw_work
end module lagrangia_which_forces
