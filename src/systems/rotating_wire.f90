module lagrangia_rotating_wire
    !! A bead on a straight wire that is turned about a vertical axis at a constant rate.
    !!
    !! Source: Hamilton's Principle, where the notes define the concept only: a constraint that
    !! contains the time is rheonomic. This is its simplest case: what is conserved is the energy
    !! function \(h = \dot r\,\partial L/\partial\dot r - L\), which is not the energy.
    use lagrangia_description, only: conserved, coordinate, description_t, figure_length, &
                                     formula_length, frequency_t, mass_point, positive, quantity, &
                                     real_number
    use lagrangia_errors, only: error_t
    use lagrangia_hyperdual, only: cos, hyperdual_t, operator(*), operator(**), operator(+), &
                                   operator(-), sin
    use lagrangia_kinds, only: dp
    use lagrangia_linearised, only: linearised_t
    use lagrangia_reference, only: reference_t
    use lagrangia_system, only: check_parameters, lanes, system_t
    implicit none (type, external)
    private
    public :: rotating_wire_t

    type, extends(system_t) :: rotating_wire_t
        !! The coordinate is \(r\), m, along the wire from the axis; negative beyond it.
        real(dp) :: m = 1.0_dp      !! kg
        real(dp) :: omega = 1.5_dp  !! rad s^-1
    contains
        procedure :: describe
        procedure :: configure
        procedure :: accelerations
        procedure :: accelerations_lanes
        procedure :: lagrangian
        procedure :: energy
        procedure :: linearise
        procedure :: quantity => energy_or_force
        procedure :: positions
        procedure :: newton
        procedure :: closed_form
    end type rotating_wire_t

    interface
        module subroutine closed_form(self, t0, q0, v0, reference)
            !! See `system_t`; in `rotating_wire_reference`.
            implicit none (type, external)
            class(rotating_wire_t), intent(in) :: self
            real(dp), intent(in) :: t0, q0(:), v0(:)
            class(reference_t), allocatable, intent(out) :: reference
        end subroutine closed_form
    end interface

contains

    pure subroutine describe(self, d)
        !! See `system_t`.
        class(rotating_wire_t), intent(in) :: self
        type(description_t), intent(out) :: d
        real(dp), parameter :: per_length = 1.0_dp  !! the wire has no natural length, m

        d%name = "rotating_wire"
        d%title = "a bead on a straight wire that turns at a constant rate, horizontally"
        d%coordinates = [coordinate("r", "m", "position along the wire, 0 on the axis")]
        d%parameters = [positive("m", "kg", "mass of the bead", self%m), &
                        real_number("omega", "rad/s", "rate at which the wire is turned", &
                                    self%omega)]
        d%energy_scale = self%m*(self%omega*per_length)**2
        d%quantities = [ &
            conserved("outward", "m/s", "start of the growing part", &
                      abs(self%omega)*per_length, "(r_dot + |omega| r) exp(- |omega| t)"), &
            quantity("mechanical_energy", "J", "of the bead", "T"), &
            quantity("L_z", "kg m^2/s", "angular momentum, fed by the wire", "m omega r^2"), &
            quantity("wire_force", "N", "push of the wire, across it", "2 m omega r_dot")]
        d%quantities(2)%conserved = abs(self%omega) <= 0.0_dp
        d%points = [mass_point("bead", self%m, "m", "r cos(omega t)", "r sin(omega t)")]
        d%reactions = [quantity("wire_force", "N", "of the wire, across it", &
                                "y_bead cos(omega t) - x_bead sin(omega t)")]
        d%kinetic_energy = "m/2 (r_dot^2 + omega^2 r^2)"
        d%potential_energy = "0"
        d%lagrangian = "m/2 (r_dot^2 + omega^2 r^2)"
        d%energy = "m/2 (r_dot^2 - omega^2 r^2)"
        d%equations = [character(formula_length) :: "r_ddot = omega^2 r"]
        d%frequencies = [frequency_t("Omega^2 = - omega^2", "r = 0")]
        d%motion = [character(formula_length) :: &
            "r = r_0 cosh(omega t) + r_dot_0/omega sinh(omega t)"]
        if (abs(self%omega) <= 0.0_dp) d%motion(1) = "r = r_0 + r_dot_0 t"
        d%constraint = "holonomic, rheonomic"
        if (abs(self%omega) <= 0.0_dp) d%constraint = "holonomic, scleronomic"
        d%constraint_equations = [character(len(d%title)) :: &
            "x_bead sin(omega t) - y_bead cos(omega t) = 0"]
        d%notes = [character(len(d%title)) :: &
            "The notes only define the concept: a constraint containing the time is rheonomic.", &
            "L has no t: h = r_dot dL/dr_dot - L is conserved.", &
            "While it turns: T is not conserved, for the wire does work.", &
            "While it turns: at rest only on the axis; released elsewhere it is thrown out.", &
            "Turning is horizontal: gravity does not enter."]
        d%figure = [character(figure_length) :: "trail bead", &
                    "line origin (cos(omega t), sin(omega t))", "pivot origin", "ball bead"]
        d%source = "Hamilton's Principle: rheonomic constraints (the notes define the concept only)"
    end subroutine describe

    pure subroutine configure(self, values, error)
        !! In this order: m, omega.
        class(rotating_wire_t), intent(inout) :: self
        real(dp), intent(in) :: values(:)
        type(error_t), allocatable, intent(out) :: error

        call check_parameters(self, values, error)
        if (allocated(error)) return
        self%ndof = 1
        self%velocity_forces = .false.
        self%m = values(1)
        self%omega = values(2)
        self%cyclic = merge(0, 1, abs(self%omega) > 0.0_dp)
    end subroutine configure

    pure subroutine accelerations(self, t, q, v, a)
        !! $$ \ddot r = \omega^2 r $$
        class(rotating_wire_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp), intent(out) :: a(self%ndof)

        a(1) = self%omega**2*q(1)
    end subroutine accelerations

    pure function lagrangian(self, t, q, v) result(l)
        !! $$ L = T = \tfrac12 m(\dot r^2 + \omega^2 r^2) $$
        class(rotating_wire_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof), v(self%ndof)
        type(hyperdual_t) :: l

        l = 0.5_dp*self%m*(v(1)**2 + self%omega**2*q(1)**2)
    end function lagrangian

    pure function energy(self, t, q, v) result(e)
        !! $$ h = \tfrac12 m(\dot r^2 - \omega^2 r^2) $$ Not \(T\): the second term is kinetic.
        class(rotating_wire_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp) :: e

        e = 0.5_dp*self%m*(v(1)**2 - self%omega**2*q(1)**2)
    end function energy

    pure function energy_or_force(self, i, t, q, v) result(value)
        !! (1) the growing part. (2) \(T\). (3) angular momentum. (4) force of the wire.
        class(rotating_wire_t), intent(in) :: self
        integer, intent(in) :: i
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp) :: value

        associate (m => self%m, omega => self%omega)
            select case (i)
            case (1)
                value = (v(1) + abs(omega)*q(1))*exp(-abs(omega)*t)
            case (2)
                value = 0.5_dp*m*(v(1)**2 + omega**2*q(1)**2)
            case (3)
                value = m*omega*q(1)**2
            case default
                value = 2.0_dp*m*omega*v(1)
            end select
        end associate
    end function energy_or_force

    pure subroutine positions(self, t, q, r)
        !! The bead, \(r\,(\cos\omega t, \sin\omega t)\), seen from above.
        class(rotating_wire_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof)
        type(hyperdual_t), intent(out) :: r(:, :)

        r = hyperdual_t()
        r(1, 1) = q(1)*cos(self%omega*t)
        r(2, 1) = q(1)*sin(self%omega*t)
    end subroutine positions

    pure subroutine accelerations_lanes(self, t, q, v, a)
        !! `accelerations`, in all lanes at once.
        class(rotating_wire_t), intent(in) :: self
        real(dp), intent(in) :: t(lanes), q(lanes, self%ndof), v(lanes, self%ndof)
        real(dp), intent(out) :: a(lanes, self%ndof)

        a(:, 1) = self%omega**2*q(:, 1)
    end subroutine accelerations_lanes

    pure subroutine linearise(self, q, analytic)
        !! On the axis: \(M = m\), \(K = -m\omega^2\): thrown out.
        class(rotating_wire_t), intent(in) :: self
        real(dp), intent(in) :: q(self%ndof)
        type(linearised_t), intent(out) :: analytic

        analytic%mass = reshape([self%m], [1, 1])
        analytic%stiffness = reshape([-self%m*self%omega**2], [1, 1])
        analytic%omega2 = [-self%omega**2]
    end subroutine linearise

    pure subroutine newton(self, t, x, u, force, constraint_residual)
        !! No force but the wire's, across it: \(y\cos\omega t - x\sin\omega t = 0\).
        class(rotating_wire_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, x(:), u(:)
        real(dp), intent(out) :: force(:)
        type(hyperdual_t), intent(out) :: constraint_residual(:)

        force = 0.0_dp
        constraint_residual(1) = x(2)*cos(self%omega*t) - x(1)*sin(self%omega*t)
    end subroutine newton
end module lagrangia_rotating_wire
