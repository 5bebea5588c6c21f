module lagrangia_hanging_chain
    !! A chain of equal bobs on equal massless rods that hangs from a pivot, in a plane.
    !!
    !! One bob is the pendulum, two are the double pendulum. The equations are solved for the
    !! tensions of the rods first: their matrix is tridiagonal, so accelerations cost O(n).
    use lagrangia_description, only: conserved, coordinate, description_t, figure_length, &
                                     formula_length, letter_t, mass_point, nonnegative, positive, &
                                     quantity, whole_number
    use lagrangia_errors, only: error_t
    use lagrangia_hyperdual, only: assignment(=), cos, dot_product, hyperdual_t, operator(*), &
                                   operator(**), operator(+), operator(-), sin
    use lagrangia_kinds, only: dp
    use lagrangia_laguerre, only: laguerre_zeros
    use lagrangia_linearised, only: linearised_t
    use lagrangia_sine_cosine, only: sine_cosine, sines_cosines
    use lagrangia_system, only: check_parameters, lanes, system_t
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: hanging_chain_t

    integer, parameter :: most = 1000  !! bobs
    integer, parameter :: spelled = 5  !! bobs, each with its term in the formulas

    type, extends(system_t) :: hanging_chain_t
        !! The coordinates are \(\theta_k\), rad, of rod k from the downward vertical.
        integer :: n = 3         !! bobs
        real(dp) :: m = 1.0_dp   !! each bob, kg
        real(dp) :: l = 1.0_dp   !! the whole chain, m
        real(dp) :: g = 9.81_dp  !! m s^-2
    contains
        procedure :: describe
        procedure :: configure
        procedure :: accelerations
        procedure :: accelerations_lanes
        procedure :: lagrangian
        procedure :: energy
        procedure :: momenta
        procedure :: velocities
        procedure :: forces
        procedure :: linearise
        procedure :: quantity => momentum_or_tension
        procedure :: positions
        procedure :: newton
    end type hanging_chain_t

    interface
        pure module subroutine momenta(self, t, q, v, p)
            !! See `system_t`; this and all below in `hanging_chain_momenta`.
            implicit none (type, external)
            class(hanging_chain_t), intent(in) :: self
            real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
            real(dp), intent(out) :: p(self%ndof)
        end subroutine momenta

        pure module subroutine velocities(self, t, q, p, v)
            !! See `system_t`.
            implicit none (type, external)
            class(hanging_chain_t), intent(in) :: self
            real(dp), intent(in) :: t, q(self%ndof), p(self%ndof)
            real(dp), intent(out) :: v(self%ndof)
        end subroutine velocities

        pure module subroutine forces(self, t, q, v, f)
            !! See `system_t`.
            implicit none (type, external)
            class(hanging_chain_t), intent(in) :: self
            real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
            real(dp), intent(out) :: f(self%ndof)
        end subroutine forces

        pure module subroutine eliminate(n, c, x)
            !! Solve \(2x_k - c_kx_{k+1} - c_{k-1}x_{k-1} = b_k\), where for \(k = 1\) one
            !! \(x_1\) and \(x_0\) are missing.
            implicit none (type, external)
            integer, intent(in) :: n             !! unknowns
            real(dp), intent(in) :: c(most)      !! \(\cos(\theta_{k+1} - \theta_k)\)
            real(dp), intent(inout) :: x(n)      !! \(b\); becomes \(x\)
        end subroutine eliminate
    end interface

contains

    pure subroutine describe(self, d)
        !! See `system_t`.
        class(hanging_chain_t), intent(in) :: self
        type(description_t), intent(out) :: d
        integer :: k

        d%name = "hanging_chain"
        d%title = "equal bobs on equal rods, a chain that hangs; n = 1, 2: the pendulums"
        d%coordinates = [(coordinate("theta"//to_text(k), "rad", "angle of rod "//to_text(k)// &
                                     " from the downward vertical"), k=1, self%n)]
        d%parameters = [whole_number("n", "number of bobs", self%n, most), &
                        positive("m", "kg", "mass of each bob", self%m), &
                        positive("l", "m", "length of the whole chain, each rod l/n", self%l), &
                        nonnegative("g", "m/s^2", "gravity", self%g)]
        d%energy_scale = 0.5_dp*(self%n + 1)*self%m*self%g*self%l
        d%quantities = [ &
            quantity("L_z", "kg m^2/s", "angular momentum about the pivot"), &
            quantity("tension1", "N", "of the uppermost rod")]
        if (self%g <= 0.0_dp) d%quantities(1) = &
            conserved("L_z", "kg m^2/s", "angular momentum about the pivot, conserved without "// &
                      "gravity", 0.0_dp)
        d%points = [(mass_point("bob"//to_text(k), self%m), k=1, self%n)]
        d%reactions = [(quantity("tension"//to_text(k), "N", "of rod "//to_text(k)), k=1, self%n)]
        d%constraint = "holonomic, scleronomic"
        d%equations = [character(formula_length) ::]
        d%notes = [character(len(d%title)) :: &
            "omega^2 = n g/l times the zeros of Laguerre's polynomial L_n.", &
            "As n grows omega goes to j0,k/2 sqrt(g/l), j0,k the zeros of Bessel's J_0."]
        if (self%n <= spelled) then
            call spell(self, d)
        else
            d%notes = [character(len(d%title)) :: &
                "The formulas are printed for at most "//to_text(spelled)//" bobs.", d%notes]
        end if
        d%figure = [character(figure_length) :: "pivot origin", "rod origin bob1", &
                    ("rod bob"//to_text(k)//" bob"//to_text(k + 1), k=1, self%n - 1), &
                    ("ball bob"//to_text(k), k=1, self%n)]
        d%source = "Phys 601, 1 September 2011: double planar pendulum, continued"
    end subroutine describe

    pure subroutine spell(self, d)
        !! The formulas, with a term for each bob. The equation of rod k is Newton's for the bobs
        !! that hang from it, across the rod.
        class(hanging_chain_t), intent(in) :: self
        type(description_t), intent(inout) :: d
        character(:), allocatable :: k, x, y, squares, heights, moments, up, across
        integer :: i

        allocate (d%letters(0))
        deallocate (d%equations)
        allocate (d%equations(self%n), d%constraint_equations(self%n))
        squares = ""
        heights = ""
        moments = ""
        do i = 1, self%n
            k = to_text(i)
            x = "l/n sin(theta"//k//")"
            y = "- l/n cos(theta"//k//")"
            if (i > 1) x = "x"//to_text(i - 1)//" + "//x
            if (i > 1) y = "y"//to_text(i - 1)//" "//y
            d%letters = [d%letters, letter_t("x"//k, x), letter_t("y"//k, y)]
            d%points(i) = mass_point("bob"//k, self%m, "m", "x"//k, "y"//k)
            squares = squares//" + x"//k//"_dot^2 + y"//k//"_dot^2"
            heights = heights//" + y"//k
            moments = moments//" + x"//k//" y"//k//"_dot - y"//k//" x"//k//"_dot"
            x = "x_bob"//k
            y = "y_bob"//k
            if (i > 1) x = "("//x//" - x_bob"//to_text(i - 1)//")"
            if (i > 1) y = "("//y//" - y_bob"//to_text(i - 1)//")"
            d%constraint_equations(i) = x//"^2 + "//y//"^2 = (l/n)^2"
            d%reactions(i)%formula = "((l/n)^2 - "//x//"^2 - "//y//"^2)/(2 l/n)"
        end do
        up = ""
        across = ""
        x = ""
        y = ""
        do i = self%n, 1, -1
            k = to_text(i)
            across = " + x"//k//"_ddot"//across
            up = " + y"//k//"_ddot"//up
            x = "("//across(4:)//")"
            if (i == self%n) x = across(4:)
            y = "("//up(4:)//" + "//to_text(self%n + 1 - i)//" g)"
            if (i == self%n) y = "("//up(4:)//" + g)"
            d%equations(i) = x//" cos(theta"//k//") + "//y//" sin(theta"//k//") = 0"
        end do
        d%quantities(1)%formula = "m ("//moments(4:)//")"
        d%quantities(2)%formula = "m "//y//" cos(theta1) - m "//x//" sin(theta1)"
        d%kinetic_energy = "m/2 ("//squares(4:)//")"
        d%potential_energy = "m g ("//heights(4:)//")"
        d%lagrangian = d%kinetic_energy//" - "//d%potential_energy
        d%energy = d%kinetic_energy//" + "//d%potential_energy
    end subroutine spell

    pure subroutine configure(self, values, error)
        !! In this order: n, m, l, g.
        class(hanging_chain_t), intent(inout) :: self
        real(dp), intent(in) :: values(:)
        type(error_t), allocatable, intent(out) :: error

        call check_parameters(self, values, error)
        if (allocated(error)) return
        self%n = nint(values(1))
        self%ndof = self%n
        self%velocity_forces = self%n > 1
        self%m = values(2)
        self%l = values(3)
        self%g = values(4)
    end subroutine configure

    pure subroutine accelerations(self, t, q, v, a)
        !! Newton's law for bobs k and k - 1, subtracted, along rod k (the tensions) and across
        !! it: with \(\ell = l/n\), \(\tau_k = T_k/m\), \(T_0 = T_{n+1} = 0\),
        !! $$ \ell\ddot\theta_k = \tau_{k+1}\sin(\theta_{k+1}-\theta_k)
        !!    - \tau_{k-1}\sin(\theta_k-\theta_{k-1}) - \delta_{k1}\,g\sin\theta_1. $$
        class(hanging_chain_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp), intent(out) :: a(self%ndof)
        real(dp) :: tau(most), s(most), c(most), l  ! of fixed size: not on the heap
        integer :: k

        associate (n => self%n, g => self%g)
            l = self%l/n
            call turns(self, q, s, c)
            call tensions(self, v, c, tau(:n))
            a(1) = -g*s(n)
            do k = 1, n - 1
                a(k) = (a(k) + tau(k + 1)*s(k))/l
                a(k + 1) = -tau(k)*s(k)
            end do
            a(n) = a(n)/l
        end associate
    end subroutine accelerations

    pure subroutine turns(self, q, s, c)
        !! Sine and cosine of \(\theta_{k+1} - \theta_k\) and, as the last, of \(\theta_1\).
        class(hanging_chain_t), intent(in) :: self
        real(dp), intent(in) :: q(self%ndof)
        real(dp), intent(out) :: s(most), c(most)
        real(dp) :: x(most)

        associate (n => self%n)
            x(:n - 1) = q(2:) - q(:n - 1)
            x(n) = q(1)
            call sines_cosines(n, x, s, c)
        end associate
    end subroutine turns

    pure subroutine tensions(self, v, c, tau)
        !! The tensions over m; `c` as in `turns`.
        class(hanging_chain_t), intent(in) :: self
        real(dp), intent(in) :: v(self%ndof), c(most)
        real(dp), intent(out) :: tau(self%ndof)

        tau = self%l/self%n*v**2
        tau(1) = tau(1) + self%g*c(self%n)
        call eliminate(self%n, c, tau)
    end subroutine tensions

    pure subroutine accelerations_lanes(self, t, q, v, a)
        !! `accelerations`, in all lanes at once.
        class(hanging_chain_t), intent(in) :: self
        real(dp), intent(in) :: t(lanes), q(lanes, self%ndof), v(lanes, self%ndof)
        real(dp), intent(out) :: a(lanes, self%ndof)
        integer, parameter :: few = 32  !! bobs, whose work arrays the stack may have: 32 kB
        real(dp) :: work(lanes, few, 4)
        real(dp), allocatable :: more(:, :, :)

        if (self%n <= few) then
            call along_and_across(self, q, v, a, work(:, :self%n, 1), work(:, :self%n, 2), &
                                  work(:, :self%n, 3), work(:, :self%n, 4))
        else
            allocate (more(lanes, self%n, 4))
            call along_and_across(self, q, v, a, more(:, :, 1), more(:, :, 2), more(:, :, 3), &
                                  more(:, :, 4))
        end if
    end subroutine accelerations_lanes

    pure subroutine along_and_across(self, q, v, a, tau, s, c, pivot)
        !! See `accelerations_lanes`; the last four are work arrays.
        class(hanging_chain_t), intent(in) :: self
        real(dp), intent(in) :: q(lanes, self%ndof), v(lanes, self%ndof)
        real(dp), intent(out) :: a(lanes, self%ndof)
        real(dp), dimension(lanes, self%n), intent(out) :: tau, s, c, pivot
        real(dp) :: s1(lanes), c1(lanes)
        integer :: k

        associate (n => self%n, g => self%g, l => self%l/self%n)
            call sine_cosine(q(:, 1), s1, c1)
            tau(:, 1) = l*v(:, 1)**2 + g*c1
            pivot(:, 1) = 1.0_dp
            do k = 1, n - 1
                call sine_cosine(q(:, k + 1) - q(:, k), s(:, k), c(:, k))
                pivot(:, k + 1) = 2.0_dp - c(:, k)**2/pivot(:, k)
                tau(:, k + 1) = l*v(:, k + 1)**2 + c(:, k)/pivot(:, k)*tau(:, k)
            end do
            tau(:, n) = tau(:, n)/pivot(:, n)
            do k = n - 1, 1, -1
                tau(:, k) = (tau(:, k) + c(:, k)*tau(:, k + 1))/pivot(:, k)
            end do
            a(:, 1) = -g*s1
            do k = 1, n - 1
                a(:, k) = (a(:, k) + tau(:, k + 1)*s(:, k))/l
                a(:, k + 1) = -tau(:, k)*s(:, k)
            end do
            a(:, n) = a(:, n)/l
        end associate
    end subroutine along_and_across

    pure function lagrangian(self, t, q, v) result(l)
        !! $$ L = \sum_k \tfrac12 m(\dot x_k^2 + \dot y_k^2) - mgy_k,\quad
        !!    x_k = \ell\sum_{i\le k}\sin\theta_i,\ y_k = -\ell\sum_{i\le k}\cos\theta_i $$
        class(hanging_chain_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof), v(self%ndof)
        type(hyperdual_t) :: l, s, c, x_dot, y_dot, y
        integer :: k

        associate (m => self%m, g => self%g, rod => self%l/self%n)
            do k = 1, self%n
                s = sin(q(k))
                c = cos(q(k))
                x_dot = x_dot + rod*v(k)*c
                y_dot = y_dot + rod*v(k)*s
                y = y - rod*c
                l = l + 0.5_dp*m*(x_dot**2 + y_dot**2) - m*g*y
            end do
        end associate
    end function lagrangian

    pure function energy(self, t, q, v) result(e)
        !! $$ E = \sum_k \tfrac12 m(\dot x_k^2 + \dot y_k^2) + mgy_k $$
        class(hanging_chain_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp) :: e, x_dot, y_dot, y
        integer :: k

        e = 0.0_dp
        x_dot = 0.0_dp
        y_dot = 0.0_dp
        y = 0.0_dp
        associate (m => self%m, g => self%g, rod => self%l/self%n)
            do k = 1, self%n
                x_dot = x_dot + rod*v(k)*cos(q(k))
                y_dot = y_dot + rod*v(k)*sin(q(k))
                y = y - rod*cos(q(k))
                e = e + 0.5_dp*m*(x_dot**2 + y_dot**2) + m*g*y
            end do
        end associate
    end function energy

    pure function momentum_or_tension(self, i, t, q, v) result(value)
        !! (1) angular momentum about the pivot. (2) tension of the uppermost rod.
        class(hanging_chain_t), intent(in) :: self
        integer, intent(in) :: i
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp) :: value, tau(self%ndof), s(most), c(most), r(2), r_dot(2)
        integer :: k

        if (i == 2) then
            call turns(self, q, s, c)
            call tensions(self, v, c, tau)
            value = self%m*tau(1)
            return
        end if
        value = 0.0_dp
        r = 0.0_dp
        r_dot = 0.0_dp
        associate (m => self%m, rod => self%l/self%n)
            do k = 1, self%n
                r = r + rod*[sin(q(k)), -cos(q(k))]
                r_dot = r_dot + rod*v(k)*[cos(q(k)), sin(q(k))]
                value = value + m*(r(1)*r_dot(2) - r(2)*r_dot(1))
            end do
        end associate
    end function momentum_or_tension

    pure subroutine positions(self, t, q, r)
        !! Each bob hangs from the one before.
        class(hanging_chain_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof)
        type(hyperdual_t), intent(out) :: r(:, :)
        integer :: k

        r = hyperdual_t()
        associate (rod => self%l/self%n)
            do k = 1, self%n
                if (k > 1) r(:, k) = r(:, k - 1)
                r(1, k) = r(1, k) + rod*sin(q(k))
                r(2, k) = r(2, k) - rod*cos(q(k))
            end do
        end associate
    end subroutine positions

    pure subroutine newton(self, t, x, u, force, constraint_residual)
        !! Gravity; each rod, \((\ell^2 - (\mathbf r_k - \mathbf r_{k-1})^2)/2\ell = 0\).
        class(hanging_chain_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, x(:), u(:)
        real(dp), intent(out) :: force(:)
        type(hyperdual_t), intent(out) :: constraint_residual(:)
        type(hyperdual_t) :: rod(3)
        integer :: k

        force = 0.0_dp
        force(2::3) = -self%m*self%g
        associate (l => self%l/self%n)
            do k = 1, self%n
                rod = x(3*k - 2:3*k)
                if (k > 1) rod = rod - x(3*k - 5:3*k - 3)
                constraint_residual(k) = 0.5_dp/l*(l**2 - dot_product(rod, rod))
            end do
        end associate
    end subroutine newton

    pure subroutine linearise(self, q, analytic)
        !! \(M_{ij} = m\ell^2\,(n + 1 - \max(i, j))\), \(K_{ii} = mg\ell\,(n + 1 - i)\), with signs
        !! where a rod stands on its head. Hanging, \(W\) takes differences of neighbours, and
        !! \(SW(SW)^\top\) is \(g/\ell\) times the Jacobi matrix of Laguerre's polynomials.
        class(hanging_chain_t), intent(in) :: self
        real(dp), intent(in) :: q(self%ndof)
        type(linearised_t), intent(out) :: analytic
        real(dp) :: orientation(self%ndof)
        integer :: i, j

        associate (n => self%n, m => self%m, g => self%g, l => self%l/self%n)
            orientation = sign(1.0_dp, cos(q))
            allocate (analytic%mass(n, n), analytic%stiffness(n, n))
            analytic%stiffness = 0.0_dp
            do j = 1, n
                do i = 1, n
                    analytic%mass(i, j) = m*l**2*(n + 1 - max(i, j))*orientation(i)*orientation(j)
                end do
                analytic%stiffness(j, j) = m*g*l*(n + 1 - j)*orientation(j)
            end do
            if (any(orientation < 0.0_dp)) return
            allocate (analytic%root(n, n), analytic%inverse(n, n))
            analytic%root = 0.0_dp
            analytic%inverse = 0.0_dp
            do j = 1, n
                analytic%root(j, j) = sqrt(m*g*l)*sqrt(real(n + 1 - j, dp))
                analytic%inverse(j, j) = 1.0_dp/(sqrt(m)*l)
                if (j < n) analytic%inverse(j + 1, j) = -analytic%inverse(j, j)
            end do
            analytic%omega2 = g/l*laguerre_zeros(n)
        end associate
    end subroutine linearise
end module lagrangia_hanging_chain
