module lagrangia_bouncing_ball
    !! A ball over a floor: the unilateral constraint \(y \ge 0\) of the notes.
    !!
    !! In flight the floor exerts no force. It is met where \(y\) falls through zero, and gives
    !! back the fraction \(e\) of the speed. Bounces come closer and closer: the \(n\)th, after
    !! a throw from the floor, at \(\frac{2v_0}{g}\frac{1-e^n}{1-e}\), and after infinitely many
    !! of them in a finite time the ball rests, held by \(\lambda = mg\):
    !! $$ y \ge 0,\quad \lambda \ge 0,\quad \lambda y = 0 $$
    use lagrangia_description, only: between, coordinate, description_t, figure_length, &
                                     formula_length, letter_t, mass_point, nonnegative, positive, &
                                     quantity, quantity_t
    use lagrangia_errors, only: error_t
    use lagrangia_hyperdual, only: hyperdual_t, operator(*), operator(**), operator(-)
    use lagrangia_kinds, only: dp
    use lagrangia_reference, only: reference_t
    use lagrangia_system, only: check_parameters, lanes, system_t
    implicit none (type, external)
    private
    public :: bouncing_ball_t

    type, extends(system_t) :: bouncing_ball_t
        !! The coordinate is \(y\), m, height of the ball's lowest point above the floor.
        real(dp) :: m = 1.0_dp            !! kg
        real(dp) :: g = 9.81_dp           !! m s^-2
        real(dp) :: restitution = 0.8_dp  !! speed after an impact over that before
    contains
        procedure :: describe
        procedure :: configure
        procedure :: accelerations
        procedure :: accelerations_lanes
        procedure :: forces
        procedure :: lagrangian
        procedure :: energy
        procedure :: quantity => contact_force
        procedure :: positions
        procedure :: newton
        procedure :: gap
        procedure :: impact
        procedure :: closed_form
    end type bouncing_ball_t

    interface
        module subroutine closed_form(self, t0, q0, v0, reference)
            !! See `system_t`; in `bouncing_ball_reference`.
            implicit none (type, external)
            class(bouncing_ball_t), intent(in) :: self
            real(dp), intent(in) :: t0, q0(:), v0(:)
            class(reference_t), allocatable, intent(out) :: reference
        end subroutine closed_form
    end interface

contains

    pure subroutine describe(self, d)
        !! See `system_t`.
        class(bouncing_ball_t), intent(in) :: self
        type(description_t), intent(out) :: d

        d%name = "bouncing_ball"
        d%title = "a ball that bounces on a floor: impacts, and rest after infinitely many"
        d%coordinates = [coordinate("y", "m", "height above the floor, at least 0")]
        d%parameters = [positive("m", "kg", "mass of the ball", self%m), &
                        nonnegative("g", "m/s^2", "gravity", self%g), &
                        between("restitution", "1", "speed after an impact over that before", &
                                self%restitution, 0.0_dp, 1.0_dp)]
        d%energy_scale = self%m*self%g
        d%quantities = [quantity("contact_force", "N", "of the floor on the ball, without the "// &
                                 "impacts", "m (y_ddot + g)")]
        d%points = [mass_point("ball", self%m, "m", y="y")]
        d%reactions = [quantity_t ::]
        d%letters = [letter_t("lambda", "contact_force")]
        d%kinetic_energy = "m/2 y_dot^2"
        d%potential_energy = "m g y"
        d%lagrangian = "m/2 y_dot^2 - m g y"
        d%energy = "m/2 y_dot^2 + m g y"
        d%equations = [character(formula_length) :: "m y_ddot = - m g + lambda"]
        d%constraint = "unilateral"
        d%constraint_equations = [character(len(d%title)) :: "y >= 0", "lambda >= 0", &
                                  "lambda y = 0"]
        d%notes = [character(len(d%title)) :: &
            "In flight lambda = 0, at rest on the floor lambda = m g; where it meets the floor "// &
            "with y_dot < 0,", &
            "y_dot becomes - restitution y_dot.", &
            "The energy is that of a flight: it is multiplied by restitution^2 at every bounce.", &
            "Thrown from the floor with v0 it rests after 2 v0/(g (1 - restitution)); elastic, "// &
            "never.", &
            "A flight shorter than the time's last digit is none: there the ball comes to rest."]
        d%figure = [character(figure_length) :: "ground (0, 0) (1, 0)", &
                    "round (0, y + size/16) (size/16, y + size/16)"]
        d%source = "Phys 601, 1 September 2011: the constraint y > 0, unilateral"
    end subroutine describe

    pure subroutine configure(self, values, error)
        !! In this order: m, g, restitution.
        class(bouncing_ball_t), intent(inout) :: self
        real(dp), intent(in) :: values(:)
        type(error_t), allocatable, intent(out) :: error

        call check_parameters(self, values, error)
        if (allocated(error)) return
        self%ndof = 1
        self%velocity_forces = .false.
        self%contacts = 1
        self%m = values(1)
        self%g = values(2)
        self%restitution = values(3)
    end subroutine configure

    pure subroutine accelerations(self, t, q, v, a)
        !! $$ \ddot y = -g \quad\text{or, at rest on the floor,}\quad \ddot y = 0 $$
        class(bouncing_ball_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp), intent(out) :: a(self%ndof)

        a = -self%g
        if (q(1) <= 0.0_dp .and. abs(v(1)) <= 0.0_dp) a = 0.0_dp
    end subroutine accelerations

    pure subroutine forces(self, t, q, v, f)
        !! $$ \frac{\partial L}{\partial y} = -m g \quad\text{or, with the floor's, 0} $$
        class(bouncing_ball_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp), intent(out) :: f(self%ndof)

        call self%accelerations(t, q, v, f)
        f = self%m*f
    end subroutine forces

    pure subroutine accelerations_lanes(self, t, q, v, a)
        !! `accelerations`, in all lanes at once.
        class(bouncing_ball_t), intent(in) :: self
        real(dp), intent(in) :: t(lanes), q(lanes, self%ndof), v(lanes, self%ndof)
        real(dp), intent(out) :: a(lanes, self%ndof)

        a = -self%g
        where (q <= 0.0_dp .and. abs(v) <= 0.0_dp) a = 0.0_dp
    end subroutine accelerations_lanes

    pure function lagrangian(self, t, q, v) result(l)
        !! $$ L = \tfrac12 m\dot y^2 - m g y $$
        class(bouncing_ball_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof), v(self%ndof)
        type(hyperdual_t) :: l

        l = 0.5_dp*self%m*v(1)**2 - self%m*self%g*q(1)
    end function lagrangian

    pure function energy(self, t, q, v) result(e)
        !! $$ E = \tfrac12 m\dot y^2 + m g y $$
        class(bouncing_ball_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp) :: e

        e = 0.5_dp*self%m*v(1)**2 + self%m*self%g*q(1)
    end function energy

    pure function contact_force(self, i, t, q, v) result(value)
        !! \(\lambda = m(\ddot y + g)\).
        class(bouncing_ball_t), intent(in) :: self
        integer, intent(in) :: i
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp) :: value, a(1)

        call self%accelerations(t, q, v, a)
        value = self%m*(a(1) + self%g)
    end function contact_force

    pure function gap(self, i, t, q, v) result(value)
        !! The height.
        class(bouncing_ball_t), intent(in) :: self
        integer, intent(in) :: i
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp) :: value

        value = q(1)
    end function gap

    pure subroutine impact(self, i, t, q, v)
        !! \(\dot y \to e\sqrt{\dot y^2 + 2gy}\): \(y\), a rounding error above the floor or below,
        !! adds what the fall to \(y = 0\) gives. The ball rests where the next flight would take
        !! \(2\dot y/g\), not more than the spacing of doubles at \(t\).
        class(bouncing_ball_t), intent(in) :: self
        integer, intent(in) :: i
        real(dp), intent(in) :: t
        real(dp), intent(inout) :: q(self%ndof), v(self%ndof)

        v = self%restitution*sqrt(max(0.0_dp, v**2 + 2.0_dp*self%g*q))
        q = 0.0_dp
        if (2.0_dp*v(1) <= self%g*spacing(t)) v = 0.0_dp
    end subroutine impact

    pure subroutine positions(self, t, q, r)
        !! Ball \((0, y)\).
        class(bouncing_ball_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof)
        type(hyperdual_t), intent(out) :: r(:, :)

        r = hyperdual_t()
        r(2, 1) = q(1)
    end subroutine positions

    pure subroutine newton(self, t, x, u, force, constraint_residual)
        !! Gravity; in flight nothing holds the ball.
        class(bouncing_ball_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, x(:), u(:)
        real(dp), intent(out) :: force(:)
        type(hyperdual_t), intent(out) :: constraint_residual(:)

        constraint_residual = hyperdual_t()
        force = 0.0_dp
        force(2) = -self%m*self%g
    end subroutine newton
end module lagrangia_bouncing_ball
