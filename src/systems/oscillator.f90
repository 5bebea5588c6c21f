module lagrangia_oscillator
    !! A mass on a spring: the example of the lecture notes on Hamilton's principle ("HSM").
    !!
    !! The notes write \(\partial L/\partial\dot x = m\,d\dot x/dt\), one derivative too many:
    !! the momentum is \(m\dot x\), and only its time derivative is \(m\ddot x\).
    !!
    !! Damping and a drive are generalised forces beside L: \(Q = -b\dot x + F_0\cos Wt\), the
    !! first from Rayleigh's function \(R = \tfrac b2\dot x^2\), \(Q = -\partial R/\partial\dot x\).
    use lagrangia_description, only: add_zeros, conserved, coordinate, description_t, &
                                     figure_length, formula_length, frequency_t, letter_t, &
                                     mass_point, nonnegative, positive, quantity, quantity_t, &
                                     real_number
    use lagrangia_errors, only: error_t
    use lagrangia_hyperdual, only: cos, hyperdual_t, operator(*), operator(**), operator(-)
    use lagrangia_kinds, only: dp
    use lagrangia_linearised, only: linearised_t
    use lagrangia_reference, only: reference_t
    use lagrangia_sine_cosine, only: sine_cosine
    use lagrangia_system, only: check_parameters, lanes, system_t
    implicit none (type, external)
    private
    public :: oscillator_t

    type, extends(system_t) :: oscillator_t
        !! The coordinate is \(x\), m, from where the spring is relaxed.
        real(dp) :: m = 1.0_dp  !! kg
        real(dp) :: k = 1.0_dp  !! N/m
        real(dp) :: b = 0.0_dp  !! N s/m
        real(dp) :: drive_force = 0.0_dp  !! \(F_0\), N
        real(dp) :: drive_frequency = 0.0_dp  !! \(W\), rad/s
    contains
        procedure :: describe
        procedure :: configure
        procedure :: accelerations
        procedure :: accelerations_lanes
        procedure :: lagrangian
        procedure :: generalised_forces
        procedure :: energy
        procedure :: linearise
        procedure :: quantity => force_or_momentum
        procedure :: positions
        procedure :: newton
        procedure :: closed_form
    end type oscillator_t

    interface
        module subroutine closed_form(self, t0, q0, v0, reference)
            !! See `system_t`; in `oscillator_reference`.
            implicit none (type, external)
            class(oscillator_t), intent(in) :: self
            real(dp), intent(in) :: t0, q0(:), v0(:)
            class(reference_t), allocatable, intent(out) :: reference
        end subroutine closed_form
    end interface

contains

    pure subroutine describe(self, d)
        !! See `system_t`.
        class(oscillator_t), intent(in) :: self
        type(description_t), intent(out) :: d

        d%name = "oscillator"
        d%title = "a mass on a spring, the simple harmonic motion"
        d%dimensions = 1
        d%coordinates = [coordinate("x", "m", "displacement from where the spring is relaxed")]
        d%parameters = [positive("m", "kg", "mass", self%m), &
                        nonnegative("k", "N/m", "stiffness of the spring", self%k), &
                        nonnegative("b", "N s/m", "damping", self%b), &
                        real_number("drive_force", "N", "F0: a force F0 cos(W t) drives it", &
                                    self%drive_force), &
                        nonnegative("drive_frequency", "rad/s", "W, angular frequency of the "// &
                                    "drive", self%drive_frequency)]
        d%quantities = [ &
            quantity("force", "N", "force of the spring", "- k x"), &
            quantity("p_x", "kg m/s", "momentum", "m x_dot")]
        if (self%cyclic == 1) d%quantities(2) = &
            conserved("p_x", "kg m/s", "momentum, x is cyclic without a spring", 0.0_dp, "m x_dot")
        d%points = [mass_point("mass", self%m, "m", "x")]
        d%reactions = [quantity_t ::]
        d%kinetic_energy = "m/2 x_dot^2"
        d%potential_energy = "k/2 x^2"
        d%lagrangian = "m/2 x_dot^2 - k/2 x^2"
        d%energy = "m/2 x_dot^2 + k/2 x^2"
        d%equations = [character(formula_length) :: "m x_ddot + k x = 0"]
        d%constraint = "none"
        d%letters = [letter_t("omega", "sqrt(k/m)")]
        if (self%nonconservative) then
            call describe_forces(self, d)
        else
            d%frequencies = [frequency_t("omega^2 = k/m", "x = 0")]
            d%motion = [character(formula_length) :: "x = x_0 + x_dot_0 t"]
            if (self%k > 0.0_dp) d%motion(1) = "x = x_0 cos(omega t) + x_dot_0/omega sin(omega t)"
        end if
        d%notes = [character(len(d%title)) :: &
            "The scan has dL/dx_dot = m d(x_dot)/dt: read dL/dx_dot = m x_dot, the momentum.", &
            "Undriven, its frequency is the same at any amplitude.", &
            "Damping and a drive are forces beside L: describe damped_oscillator shows them.", &
            "Without both the actual path makes the action stationary, a minimum only for t < "// &
            "pi sqrt(m/k)."]
        d%figure = [character(figure_length) :: "ground (x_min - size, 0) (x_min - size, - 1)", &
                    "ground (x_min - size, - size/12) (x_min, - size/12)", &
                    "spring (x_min - size, 0) mass", "box mass (size/6, size/6)"]
        d%source = "Hamilton's Principle: example HSM"
    end subroutine describe

    pure subroutine describe_forces(self, d)
        !! What is otherwise with damping or a drive: Q, the equation, the motion without a drive.
        class(oscillator_t), intent(in) :: self
        type(description_t), intent(inout) :: d
        real(dp), parameter :: rounding = 8.0_dp*epsilon(1.0_dp)
        real(dp) :: excess

        if (self%b > 0.0_dp) d%dissipation = "b/2 x_dot^2"
        if (abs(self%drive_force) > 0.0_dp) then
            d%generalised_forces = [character(formula_length) :: "Q_x = F0 cos(W t) - b x_dot"]
            d%equations(1) = "m x_ddot + b x_dot + k x = F0 cos(W t)"
            d%letters = [letter_t("F0", "drive_force"), letter_t("W", "drive_frequency")]
            return
        end if
        d%generalised_forces = [character(formula_length) :: "Q_x = - b x_dot"]
        d%equations(1) = "m x_ddot + b x_dot + k x = 0"
        d%letters = [letter_t("gamma", "b/(2 m)"), letter_t("omega", "sqrt(k/m - gamma^2)")]
        excess = 4.0_dp*self%m*self%k - self%b**2
        if (abs(excess) <= rounding*self%b**2) excess = 0.0_dp  ! m = 1, k = 0.01, b = 0.2
        if (excess > 0.0_dp) then
            d%motion = [character(formula_length) :: "x = exp(-gamma t) (x_0 cos(omega t) + "// &
                        "(x_dot_0 + gamma x_0)/omega sin(omega t))"]
        else if (excess < 0.0_dp) then
            ! with cosh it would cancel where gamma_1 is small beside gamma
            d%letters(2)%formula = "sqrt(gamma^2 - k/m)"
            d%letters = [d%letters, letter_t("gamma_1", "k/(m (gamma + omega))")]
            d%motion = [character(formula_length) :: "x = x_0 exp(-gamma_1 t) + "// &
                        "(x_dot_0 + gamma_1 x_0)/omega exp(-gamma t) sinh(omega t)"]
        else
            d%letters = d%letters(:1)
            d%motion = [character(formula_length) :: &
                        "x = exp(-gamma t) (x_0 + (x_dot_0 + gamma x_0) t)"]
        end if
    end subroutine describe_forces

    pure subroutine configure(self, values, error)
        !! In this order: m, k, b, drive_force, drive_frequency; the last three may be left out.
        class(oscillator_t), intent(inout) :: self
        real(dp), intent(in) :: values(:)
        type(error_t), allocatable, intent(out) :: error
        real(dp), allocatable :: p(:)

        call add_zeros(values, 5, 2, p)
        call check_parameters(self, p, error)
        if (allocated(error)) return
        self%ndof = 1
        self%m = p(1)
        self%k = p(2)
        self%b = p(3)
        self%drive_force = p(4)
        self%drive_frequency = p(5)
        self%velocity_forces = self%b > 0.0_dp
        self%nonconservative = max(self%b, abs(self%drive_force)) > 0.0_dp
        self%time_dependent = abs(self%drive_force)*self%drive_frequency > 0.0_dp
        self%cyclic = merge(0, 1, self%k > 0.0_dp .or. self%nonconservative)
    end subroutine configure

    pure subroutine accelerations(self, t, q, v, a)
        !! $$ \ddot x = -\frac km x + \frac{F_0\cos Wt - b\dot x}m $$
        class(oscillator_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp), intent(out) :: a(self%ndof)

        a(1) = -self%k/self%m*q(1)
        if (.not. self%nonconservative) return
        a(1) = a(1) + (self%drive_force*cos(self%drive_frequency*t) - self%b*v(1))/self%m
    end subroutine accelerations

    pure function lagrangian(self, t, q, v) result(l)
        !! $$ L = \tfrac12 m\dot x^2 - \tfrac12 k x^2 $$
        class(oscillator_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof), v(self%ndof)
        type(hyperdual_t) :: l

        l = 0.5_dp*self%m*v(1)**2 - 0.5_dp*self%k*q(1)**2
    end function lagrangian

    pure subroutine generalised_forces(self, t, q, v, f)
        !! $$ Q = -b\dot x + F_0\cos Wt $$
        class(oscillator_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof), v(self%ndof)
        type(hyperdual_t), intent(out) :: f(self%ndof)

        f(1) = self%drive_force*cos(self%drive_frequency*t) - self%b*v(1)
    end subroutine generalised_forces

    pure function energy(self, t, q, v) result(e)
        !! $$ E = \tfrac12 m\dot x^2 + \tfrac12 k x^2 $$
        class(oscillator_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp) :: e

        e = 0.5_dp*self%m*v(1)**2 + 0.5_dp*self%k*q(1)**2
    end function energy

    pure function force_or_momentum(self, i, t, q, v) result(value)
        !! (1) force of the spring. (2) momentum.
        class(oscillator_t), intent(in) :: self
        integer, intent(in) :: i
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp) :: value

        select case (i)
        case (1)
            value = -self%k*q(1)
        case default
            value = self%m*v(1)
        end select
    end function force_or_momentum

    pure subroutine positions(self, t, q, r)
        !! The mass at \((x, 0)\).
        class(oscillator_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof)
        type(hyperdual_t), intent(out) :: r(:, :)

        r = hyperdual_t()
        r(1, 1) = q(1)
    end subroutine positions

    pure subroutine accelerations_lanes(self, t, q, v, a)
        !! `accelerations`, in all lanes at once.
        class(oscillator_t), intent(in) :: self
        real(dp), intent(in) :: t(lanes), q(lanes, self%ndof), v(lanes, self%ndof)
        real(dp), intent(out) :: a(lanes, self%ndof)
        real(dp) :: s(lanes), c(lanes)

        a(:, 1) = -self%k/self%m*q(:, 1)
        if (.not. self%nonconservative) return
        call sine_cosine(self%drive_frequency*t, s, c)
        a(:, 1) = a(:, 1) + (self%drive_force*c - self%b*v(:, 1))/self%m
    end subroutine accelerations_lanes

    pure subroutine linearise(self, q, analytic)
        !! \(M = m\), \(K = k\).
        class(oscillator_t), intent(in) :: self
        real(dp), intent(in) :: q(self%ndof)
        type(linearised_t), intent(out) :: analytic

        analytic%mass = reshape([self%m], [1, 1])
        analytic%stiffness = reshape([self%k], [1, 1])
        analytic%root = reshape([sqrt(self%k)], [1, 1])
        analytic%inverse = reshape([1.0_dp/sqrt(self%m)], [1, 1])
        analytic%omega2 = [self%k/self%m]
    end subroutine linearise

    pure subroutine newton(self, t, x, u, force, constraint_residual)
        !! The spring, the drag and the drive along x; nothing holds the mass.
        class(oscillator_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, x(:), u(:)
        real(dp), intent(out) :: force(:)
        type(hyperdual_t), intent(out) :: constraint_residual(:)

        constraint_residual = hyperdual_t()
        force = 0.0_dp
        force(1) = -self%k*x(1)%re - self%b*u(1)%re &
                   + self%drive_force*cos(self%drive_frequency*t%re)
    end subroutine newton
end module lagrangia_oscillator
