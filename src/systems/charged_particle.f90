module lagrangia_charged_particle
    !! A charge in uniform electric and magnetic fields of any direction, free or in a trap.
    !!
    !! Source: the lecture of 1 September 2011, velocity-dependent potentials:
    !! \(L = \tfrac12 mv^2 - e\varphi + e\,A\cdot v\). The notes say that \(B = 0\) gives
    !! \(F = -\nabla\varphi\): the charge is missing, \(F = -e\nabla\varphi\), and also
    !! \(\partial A/\partial t\) must vanish, as it does here.
    use lagrangia_description, only: conserved, coordinate, description_t, figure_length, &
                                     formula_length, frequency_t, letter_t, mass_point, &
                                     nonnegative, positive, quantity, quantity_t, real_number, &
                                     real_vector
    use lagrangia_errors, only: error_t
    use lagrangia_gyrating_system, only: gyrating_system_t
    use lagrangia_hyperdual, only: dot_product, hyperdual_t, operator(*), operator(+), operator(-)
    use lagrangia_kinds, only: dp
    use lagrangia_linearised, only: linearised_t
    use lagrangia_reference, only: reference_t
    use lagrangia_system, only: check_parameters, lanes
    use lagrangia_vectors, only: cross, length
    implicit none (type, external)
    private
    public :: charged_particle_t

    type, extends(gyrating_system_t) :: charged_particle_t
        !! The coordinates are \(x\), \(y\), \(z\), m, from the centre of the trap.
        real(dp) :: m = 1.0_dp                              !! kg
        real(dp) :: charge = 1.0_dp                         !! e, C
        real(dp) :: electric(3) = [0.2_dp, 0.1_dp, 0.0_dp]  !! E, V/m
        real(dp) :: magnetic(3) = [0.0_dp, 0.0_dp, 1.0_dp]  !! B, T
        real(dp) :: trap = 0.0_dp                           !! isotropic, N/m
    contains
        procedure :: describe
        procedure :: configure
        procedure :: accelerations
        procedure :: split_accelerations
        procedure :: accelerations_lanes
        procedure :: lagrangian
        procedure :: energy
        procedure :: momenta
        procedure :: velocities
        procedure :: forces
        procedure :: linearise
        procedure :: quantity => momentum_or_speed
        procedure :: positions
        procedure :: newton
        procedure :: axis
        procedure :: centre
        procedure :: is_cyclic
        procedure :: parallel
        procedure :: closed_form
    end type charged_particle_t

    interface
        module subroutine closed_form(self, t0, q0, v0, reference)
            !! See `system_t`; in `charged_particle_reference`.
            implicit none (type, external)
            class(charged_particle_t), intent(in) :: self
            real(dp), intent(in) :: t0, q0(:), v0(:)
            class(reference_t), allocatable, intent(out) :: reference
        end subroutine closed_form
    end interface

contains

    pure subroutine describe(self, d)
        !! See `system_t`.
        class(charged_particle_t), intent(in) :: self
        type(description_t), intent(out) :: d
        real(dp), parameter :: per_speed = 1.0_dp  !! m/s: free, the particle has no natural speed
        integer :: i

        d%name = "charged_particle"
        d%title = "a charge in uniform electric and magnetic fields, free or in a trap"
        d%coordinates = [coordinate("x", "m", "position, from the centre of the trap"), &
                         coordinate("y", "m", "position, from the centre of the trap"), &
                         coordinate("z", "m", "position, from the centre of the trap")]
        d%parameters = [positive("m", "kg", "mass", self%m), &
                        real_number("charge", "C", "charge, e, of either sign", self%charge), &
                        real_vector("electric", "V/m", "electric field, E", self%electric), &
                        real_vector("magnetic", "T", "magnetic field, B", self%magnetic), &
                        nonnegative("trap", "N/m", "spring constant of an isotropic trap", &
                                    self%trap)]
        d%energy_scale = self%m*per_speed**2
        call name_vectors(self, d%letters)
        d%quantities = [ &
            quantity("pseudo_x", "kg m/s", "conserved without a trap", &
                     "m x_dot + e (B_y z - B_z y) - e E_x t"), &
            quantity("pseudo_y", "kg m/s", "conserved without a trap", &
                     "m y_dot + e (B_z x - B_x z) - e E_y t"), &
            quantity("pseudo_z", "kg m/s", "conserved without a trap", &
                     "m z_dot + e (B_x y - B_y x) - e E_z t"), &
            quantity("L_axis", "kg m^2/s", "angular momentum along n: see the notes", &
                     "m (n_x (s_y z_dot - s_z y_dot) + n_y (s_z x_dot - s_x z_dot) + n_z "// &
                     "(s_x y_dot - s_y x_dot)) + e B/2 (s_x^2 + s_y^2 + s_z^2 - s_n^2)"), &
            conserved("energy_axis", "J", "of the motion along n", d%energy_scale, &
                      "m/2 v_n^2 - e E_n r_n + trap/2 r_n^2"), &
            quantity("speed", "m/s", "conserved without electric field and trap", &
                     "sqrt(x_dot^2 + y_dot^2 + z_dot^2)"), &
            quantity("p_x", "kg m/s", "canonical momentum, depends on the gauge", &
                     "m x_dot + e A_x"), &
            quantity("p_y", "kg m/s", "canonical momentum, depends on the gauge", &
                     "m y_dot + e A_y"), &
            quantity("p_z", "kg m/s", "canonical momentum, depends on the gauge", &
                     "m z_dot + e A_z")]
        if (self%trap <= 0.0_dp) then
            d%quantities(1:3)%conserved = .true.
            d%quantities(6)%conserved = length(self%charge*self%electric) <= 0.0_dp
            do i = 1, 3
                d%quantities(6 + i)%conserved = self%is_cyclic(i)
            end do
        end if
        d%quantities(4)%conserved = self%trap > 0.0_dp .or. self%parallel()
        d%quantities(:3)%scale = self%m*per_speed
        d%quantities(6:)%scale = self%m*per_speed
        d%quantities(6)%scale = per_speed
        d%points = [mass_point("particle", self%m, "m", "x", "y", "z")]
        d%reactions = [quantity_t ::]
        d%dimensions = 3
        d%kinetic_energy = "m/2 (x_dot^2 + y_dot^2 + z_dot^2)"
        d%potential_energy = "trap/2 (x^2 + y^2 + z^2) - e (E_x x + E_y y + E_z z) "// &
                             "- e (A_x x_dot + A_y y_dot + A_z z_dot)"
        d%lagrangian = d%kinetic_energy//" + e (E_x x + E_y y + E_z z) "// &
                       "+ e (A_x x_dot + A_y y_dot + A_z z_dot) - trap/2 (x^2 + y^2 + z^2)"
        d%energy = d%kinetic_energy// &
                   " - e (E_x x + E_y y + E_z z) + trap/2 (x^2 + y^2 + z^2)"
        d%equations = [character(formula_length) :: &
            "m x_ddot = e (E_x + y_dot B_z - z_dot B_y) - trap x", &
            "m y_ddot = e (E_y + z_dot B_x - x_dot B_z) - trap y", &
            "m z_ddot = e (E_z + x_dot B_y - y_dot B_x) - trap z"]
        if (self%trap > 0.0_dp) d%frequencies = [ &
            frequency_t("omega^2 = trap/m", "s_x = 0, s_y = 0, s_z = 0"), &
            frequency_t("omega = sqrt(trap/m + (e B/(2 m))^2) + |e| B/(2 m)", &
                        "s_x = 0, s_y = 0, s_z = 0"), &
            frequency_t("omega = sqrt(trap/m + (e B/(2 m))^2) - |e| B/(2 m)", &
                        "s_x = 0, s_y = 0, s_z = 0")]
        d%constraint = "none"
        d%notes = [character(len(d%title)) :: &
            "L = m/2 v.v + e E.r + e A.v - trap/2 r.r with A = B x r/2, the symmetric gauge.", &
            "m v_dot = e (E + v x B) - trap r. V contains v: U = e phi - e A.v, phi = - E.r.", &
            "The notes have F = - grad(phi) for B = 0: a slip, e is missing: - e grad(phi).", &
            "n: along B, without B along E; r = s + e E/trap, without a trap r = s.", &
            "Any gauge, one motion: m v + e A depends on it, m v + e B x r - e E t does not.", &
            "Free, in B: drift E x B/B^2, turning at omega_c = e B/m, falling freely along B.", &
            "L_axis is conserved in a trap; without one where E is parallel to B or zero.", &
            "In the trap two of the frequencies belong to turning across B."]
        d%figure = [character(figure_length) :: "trail particle", "ball particle"]
        if (any(abs(self%electric) > 0.0_dp)) d%figure = [character(figure_length) :: d%figure, &
            "field E (electric_x, electric_y, electric_z)"]
        if (any(abs(self%magnetic) > 0.0_dp)) d%figure = [character(figure_length) :: d%figure, &
            "field B (magnetic_x, magnetic_y, magnetic_z)"]
        d%source = "Phys 601, 1 September 2011: velocity-dependent generalized potentials"
    end subroutine describe

    pure subroutine name_vectors(self, letters)
        !! The letters of the formulas: components of E, B, A, of n along the axis and of s from the
        !! middle of the motion; what is along n.
        class(charged_particle_t), intent(in) :: self
        type(letter_t), allocatable, intent(out) :: letters(:)
        character, parameter :: axes(3) = ["x", "y", "z"]
        integer :: i

        letters = [letter_t("e", "charge"), &
                       letter_t("E_x", "electric_x"), letter_t("E_y", "electric_y"), &
                       letter_t("E_z", "electric_z"), letter_t("B_x", "magnetic_x"), &
                       letter_t("B_y", "magnetic_y"), letter_t("B_z", "magnetic_z"), &
                       letter_t("B", "sqrt(B_x^2 + B_y^2 + B_z^2)"), &
                       letter_t("A_x", "(B_y z - B_z y)/2"), &
                       letter_t("A_y", "(B_z x - B_x z)/2"), &
                       letter_t("A_z", "(B_x y - B_y x)/2")]
        do i = 1, 3
            associate (w => axes(i))
                if (length(self%magnetic) > 0.0_dp) then
                    letters = [letters, letter_t("n_"//w, "B_"//w//"/B")]
                else if (length(self%electric) > 0.0_dp) then
                    letters = [letters, letter_t( &
                        "n_"//w, "E_"//w//"/sqrt(E_x^2 + E_y^2 + E_z^2)")]
                else
                    letters = [letters, letter_t("n_"//w, merge("1", "0", i == 3))]
                end if
            end associate
        end do
        do i = 1, 3
            associate (w => axes(i))
                if (self%trap > 0.0_dp) then
                    letters = [letters, letter_t("s_"//w, w//" - e E_"//w//"/trap")]
                else
                    letters = [letters, letter_t("s_"//w, w)]
                end if
            end associate
        end do
        letters = [letters, &
                       letter_t("s_n", "n_x s_x + n_y s_y + n_z s_z"), &
                       letter_t("r_n", "n_x x + n_y y + n_z z"), &
                       letter_t("v_n", "n_x x_dot + n_y y_dot + n_z z_dot"), &
                       letter_t("E_n", "n_x E_x + n_y E_y + n_z E_z")]
    end subroutine name_vectors

    pure subroutine configure(self, values, error)
        !! In this order: m, charge, electric(3), magnetic(3), trap.
        class(charged_particle_t), intent(inout) :: self
        real(dp), intent(in) :: values(:)
        type(error_t), allocatable, intent(out) :: error
        integer :: i

        call check_parameters(self, values, error)
        if (allocated(error)) return
        self%ndof = 3
        self%m = values(1)
        self%charge = values(2)
        self%electric = values(3:5)
        self%magnetic = values(6:8)
        self%trap = values(9)
        self%velocity_forces = length(self%charge*self%magnetic) > 0.0_dp
        self%cyclic = 0
        do i = 1, 3
            if (self%is_cyclic(i)) self%cyclic = i
        end do
    end subroutine configure

    pure function is_cyclic(self, i) result(cyclic)
        !! \(L\) does not contain coordinate `i`: no trap, no field along it, B only along it.
        class(charged_particle_t), intent(in) :: self
        integer, intent(in) :: i  !! 1, 2, 3: x, y, z
        logical :: cyclic
        real(dp) :: b(3)

        b = self%charge*self%magnetic
        b(i) = 0.0_dp
        cyclic = max(self%trap, abs(self%charge*self%electric(i)), length(b)) <= 0.0_dp
    end function is_cyclic

    pure function parallel(self)
        !! E and B are parallel, to rounding, or one of them is zero.
        class(charged_particle_t), intent(in) :: self
        logical :: parallel

        parallel = abs(self%charge)*length(cross(self%axis(), self%electric)) &
                   <= 4.0_dp*epsilon(1.0_dp)*abs(self%charge)*length(self%electric)
    end function parallel

    pure function axis(self) result(n)
        !! Unit vector along B; along E where there is no B; along z where there is neither.
        class(charged_particle_t), intent(in) :: self
        real(dp) :: n(3)

        n = [0.0_dp, 0.0_dp, 1.0_dp]
        if (length(self%magnetic) > 0.0_dp) then
            n = self%magnetic/length(self%magnetic)
        else if (length(self%electric) > 0.0_dp) then
            n = self%electric/length(self%electric)
        end if
    end function axis

    pure function centre(self) result(r)
        !! Where the trap balances the electric field, m; the origin where there is no trap.
        class(charged_particle_t), intent(in) :: self
        real(dp) :: r(3)

        r = 0.0_dp
        if (self%trap > 0.0_dp) r = self%charge*self%electric/self%trap
    end function centre

    pure subroutine accelerations(self, t, q, v, a)
        !! $$ m\dot v = e\,(E + v\times B) - k r $$
        class(charged_particle_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp), intent(out) :: a(self%ndof)

        associate (m => self%m, e => self%charge, b => self%magnetic, k => self%trap)
            a(1) = (e*(self%electric(1) + v(2)*b(3) - v(3)*b(2)) - k*q(1))/m
            a(2) = (e*(self%electric(2) + v(3)*b(1) - v(1)*b(3)) - k*q(2))/m
            a(3) = (e*(self%electric(3) + v(1)*b(2) - v(2)*b(1)) - k*q(3))/m
        end associate
    end subroutine accelerations

    pure subroutine split_accelerations(self, t, q, a, omega)
        !! $$ a = (eE - kr)/m,\qquad \omega = eB/m $$
        class(charged_particle_t), intent(in) :: self
        real(dp), intent(in) :: t, q(3)
        real(dp), intent(out) :: a(3), omega(3)

        a = (self%charge*self%electric - self%trap*q)/self%m
        omega = self%charge/self%m*self%magnetic
    end subroutine split_accelerations

    pure function lagrangian(self, t, q, v) result(l)
        !! $$ L = \tfrac12 mv^2 + e\,E\cdot r + e\,A\cdot v - \tfrac12 kr^2,\qquad
        !!    A = \tfrac12 B\times r $$
        class(charged_particle_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof), v(self%ndof)
        type(hyperdual_t) :: l

        l = 0.5_dp*self%m*dot_product(v, v) + self%charge*dot_product(self%electric, q) &
            + 0.5_dp*self%charge*dot_product(cross(self%magnetic, q), v) &
            - 0.5_dp*self%trap*dot_product(q, q)
    end function lagrangian

    pure subroutine momenta(self, t, q, v, p)
        !! $$ p = mv + eA,\qquad A = \tfrac12 B\times r $$
        class(charged_particle_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp), intent(out) :: p(self%ndof)

        p = self%m*v + 0.5_dp*self%charge*cross(self%magnetic, q)
    end subroutine momenta

    pure subroutine velocities(self, t, q, p, v)
        !! $$ v = (p - eA)/m $$
        class(charged_particle_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), p(self%ndof)
        real(dp), intent(out) :: v(self%ndof)

        v = (p - 0.5_dp*self%charge*cross(self%magnetic, q))/self%m
    end subroutine velocities

    pure subroutine forces(self, t, q, v, f)
        !! $$ \frac{\partial L}{\partial r} = e\,(E + \tfrac12 v\times B) - kr $$
        class(charged_particle_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp), intent(out) :: f(self%ndof)

        f = self%charge*(self%electric + 0.5_dp*cross(v, self%magnetic)) - self%trap*q
    end subroutine forces

    pure function energy(self, t, q, v) result(e)
        !! $$ E = \tfrac12 mv^2 - e\,E\cdot r + \tfrac12 kr^2 $$ The magnetic field does no work.
        class(charged_particle_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp) :: e

        e = 0.5_dp*self%m*dot_product(v, v) - self%charge*dot_product(self%electric, q) &
            + 0.5_dp*self%trap*dot_product(q, q)
    end function energy

    pure function momentum_or_speed(self, i, t, q, v) result(value)
        !! 1 to 3: pseudo-momentum. 4, 5: angular momentum about the axis, energy along it.
        !! 6: speed. 7 to 9: canonical momentum.
        class(charged_particle_t), intent(in) :: self
        integer, intent(in) :: i
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp) :: value, p(3), n(3), s(3)

        associate (m => self%m, e => self%charge, b => self%magnetic, k => self%trap)
            n = self%axis()
            select case (i)
            case (1:3)
                p = m*v + e*cross(b, q) - e*self%electric*t
                value = p(i)
            case (4)
                s = q - self%centre()
                value = m*dot_product(n, cross(s, v)) &
                        + 0.5_dp*e*length(b)*sum((s - dot_product(n, s)*n)**2)
            case (5)
                value = 0.5_dp*m*dot_product(n, v)**2 &
                        - e*dot_product(n, self%electric)*dot_product(n, q) &
                        + 0.5_dp*k*dot_product(n, q)**2
            case (6)
                value = length(v)
            case default
                p = m*v + 0.5_dp*e*cross(b, q)
                value = p(i - 6)
            end select
        end associate
    end function momentum_or_speed

    pure subroutine positions(self, t, q, r)
        !! The coordinates are Cartesian.
        class(charged_particle_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof)
        type(hyperdual_t), intent(out) :: r(:, :)

        r(:, 1) = q
    end subroutine positions

    pure subroutine accelerations_lanes(self, t, q, v, a)
        !! `accelerations`, in all lanes at once.
        class(charged_particle_t), intent(in) :: self
        real(dp), intent(in) :: t(lanes), q(lanes, self%ndof), v(lanes, self%ndof)
        real(dp), intent(out) :: a(lanes, self%ndof)

        associate (m => self%m, e => self%charge, b => self%magnetic, k => self%trap)
            a(:, 1) = (e*(self%electric(1) + v(:, 2)*b(3) - v(:, 3)*b(2)) - k*q(:, 1))/m
            a(:, 2) = (e*(self%electric(2) + v(:, 3)*b(1) - v(:, 1)*b(3)) - k*q(:, 2))/m
            a(:, 3) = (e*(self%electric(3) + v(:, 1)*b(2) - v(:, 2)*b(1)) - k*q(:, 3))/m
        end associate
    end subroutine accelerations_lanes

    pure subroutine linearise(self, q, analytic)
        !! In the trap: \(M = m\), \(K\) = trap, \(G\dot r = eB\times\dot r\); with
        !! \(\omega_0^2\) = trap/m and \(\omega_c = e|B|/m\) the frequencies are \(\omega_0\) and
        !! \(\sqrt{\omega_0^2 + \omega_c^2/4} \pm \omega_c/2\).
        class(charged_particle_t), intent(in) :: self
        real(dp), intent(in) :: q(self%ndof)
        type(linearised_t), intent(out) :: analytic
        real(dp), parameter :: unit(3, 3) = reshape([1.0_dp, 0.0_dp, 0.0_dp, 0.0_dp, 1.0_dp, &
                                                     0.0_dp, 0.0_dp, 0.0_dp, 1.0_dp], [3, 3])
        real(dp) :: w2, fast
        integer :: i

        analytic%mass = self%m*unit
        analytic%stiffness = self%trap*unit
        allocate (analytic%gyroscopic(3, 3))
        do i = 1, 3
            analytic%gyroscopic(:, i) = self%charge*cross(self%magnetic, unit(:, i))
        end do
        w2 = self%trap/self%m
        fast = 0.5_dp*abs(self%charge/self%m)*length(self%magnetic)
        fast = fast + hypot(sqrt(w2), fast)
        analytic%omega2 = [0.0_dp, w2, fast**2]
        if (fast > 0.0_dp) analytic%omega2(1) = (w2/fast)**2
    end subroutine linearise

    pure subroutine newton(self, t, x, u, force, constraint_residual)
        !! $$ F = e\,(E + v\times B) - kr $$ Nothing holds the particle.
        class(charged_particle_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, x(:), u(:)
        real(dp), intent(out) :: force(:)
        type(hyperdual_t), intent(out) :: constraint_residual(:)
        real(dp) :: velocity(3)

        constraint_residual = hyperdual_t()
        velocity = u%re
        force = self%charge*(self%electric + cross(velocity, self%magnetic)) - self%trap*x%re
    end subroutine newton
end module lagrangia_charged_particle
