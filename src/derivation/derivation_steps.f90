module lagrangia_derivation_steps
    !! The lecture's recipe: positions, velocities, T and V, L, and Lagrange's equations.
    use lagrangia_common_factor, only: divide_by_parameters
    use lagrangia_derivation, only: derivation_t, line_beside, line_constraint, line_divided, &
                                    line_equation, line_force, line_kinetic, line_lagrangian, &
                                    line_momentum, line_position, line_potential, line_rate, &
                                    line_rotor, line_rotor_rate, line_stated, line_velocity
    use lagrangia_derivation_modes, only: add_modes
    use lagrangia_derivation_motion, only: add_motion
    use lagrangia_description, only: description_t
    use lagrangia_errors, only: error_t, fail
    use lagrangia_exact_number, only: ratio
    use lagrangia_expression, only: expression_t, operator(*), operator(**), operator(+), &
                                    operator(/), whole
    use lagrangia_formula_latex, only: latex_name
    use lagrangia_formula_parser, only: parse_equation, parse_formula
    use lagrangia_formula_text, only: formula_text
    use lagrangia_kinds, only: dp, i8
    use lagrangia_page_layout, only: lay_out
    use lagrangia_polynomial, only: atom_power, number_polynomial, operator(+), &
                                    operator(-), operator(*), polynomial_t
    use lagrangia_system, only: system_t
    use lagrangia_trigonometry, only: shorten, tidy
    implicit none (type, external)
    private
    public :: derive, slip_in_formula_t

    type :: slip_in_formula_t
        !! A formula that takes the place of the right one, and what follows from it.
        integer :: kind = 0                       !! `line_kinetic` or `line_equation`; 0: no slip
        integer :: i = 0                          !! of an equation: which coordinate
        character(:), allocatable :: formula      !! T, or an equation `left = right`
    end type slip_in_formula_t

    character, parameter :: axes(3) = ["x", "y", "z"]

contains

    subroutine derive(system, slip, derivation, error)
        !! All lines for a system.
        class(system_t), intent(in) :: system             !! configured
        type(slip_in_formula_t), intent(in) :: slip       !! or none
        type(derivation_t), intent(out) :: derivation     !! complete
        type(error_t), allocatable, intent(out) :: error  !! no formulas to begin with, or too many
        type(description_t) :: d
        type(polynomial_t) :: l
        type(polynomial_t), allocatable :: forces(:)

        call system%describe(d)
        call derivation%begin(d, system%constraints, error)
        if (allocated(error)) return
        call find_lagrangian(derivation, slip, l, error)
        if (.not. allocated(error)) call read_forces(derivation, system, forces, error)
        if (.not. allocated(error)) call read_constraints(derivation, system, error)
        if (allocated(error)) return
        call add_equations(derivation, slip, l, forces, error)
        if (.not. allocated(error) .and. derivation%algebra%full) then
            call fail(error, trim(d%name)//" has too many terms for a derivation on paper; "// &
                      "take fewer coordinates")
        end if
        if (allocated(error)) return
        call add_motion(derivation)
        call add_modes(derivation, system, slip%kind > 0)
    end subroutine derive

    subroutine find_lagrangian(self, slip, l, error)
        !! From T and V, as far as they are known.
        type(derivation_t), intent(inout) :: self
        type(slip_in_formula_t), intent(in) :: slip
        type(polynomial_t), intent(out) :: l
        type(error_t), allocatable, intent(out) :: error
        type(polynomial_t) :: t, v
        type(expression_t) :: as_stated
        character(:), allocatable :: letter
        logical :: placed, moving
        integer :: i

        placed = .false.
        if (allocated(self%d%points)) then
            if (size(self%d%points) > 0) placed = all(self%d%points%mass_formula /= "")
        end if
        if (placed) call add_points(self, t, error)
        if (allocated(error)) return
        if (.not. placed) then
            if (.not. allocated(self%d%kinetic_energy)) then
                self%next_heading = "the Lagrangian"
                if (.not. allocated(self%d%lagrangian)) then
                    call fail(error, trim(self%d%name)//" has no formula for L to derive from"// &
                              chain_hint(self%d))
                    return
                end if
                call self%read(self%d%lagrangian, l, error)
                if (.not. allocated(error)) call self%add(line_lagrangian, "L", "L", l)
                return
            end if
            self%next_heading = "kinetic energy"
            call self%read(self%d%kinetic_energy, t, error)
            if (allocated(error)) return
            call self%add(line_kinetic, "T", "T", t)
        end if
        if (slip%kind == line_kinetic) then
            call self%read(slip%formula, t, error)
            if (allocated(error)) return
            call tidy(self%algebra, t)
            call self%add(line_kinetic, "T", "T", t)
            self%lines(self%count)%slipped = .true.
        end if
        self%next_heading = "potential energy and L"
        as_stated = whole(0)
        if (allocated(self%d%potential_energy)) then
            call parse_formula(self%d%potential_energy, self%symbols, as_stated, error)
            if (allocated(error)) then
                call error%add_context(self%d%potential_energy)
                return
            end if
            call self%algebra%from_expression(as_stated, v)
        end if
        moving = .false.
        do i = 1, self%n
            moving = moving .or. v%has(self%velocity(i))
        end do
        letter = merge("U", "V", moving)
        call self%add(line_potential, letter, letter, v, e=as_stated)
        l = t - v
        call tidy(self%algebra, l)
        call self%add(line_lagrangian, "L = T - "//letter, "L = T - "//letter, l)
    end subroutine find_lagrangian

    pure function chain_hint(d) result(text)
        !! Where a whole number of bodies can be chosen.
        type(description_t), intent(in) :: d
        character(:), allocatable :: text

        text = ""
        if (any(d%parameters%whole)) text = "; take fewer bodies"
    end function chain_hint

    subroutine add_points(self, t, error)
        !! Positions, velocities, T.
        type(derivation_t), intent(inout) :: self
        type(polynomial_t), intent(out) :: t
        type(error_t), allocatable, intent(out) :: error
        type(polynomial_t), allocatable :: x(:, :), u(:, :)
        type(expression_t) :: sum_of_squares, all_of_t
        integer :: i, k, points, rotors

        points = size(self%d%points)
        rotors = 0
        if (allocated(self%d%rotors)) rotors = size(self%d%rotors)
        allocate (x(3, points + rotors), u(3, points + rotors))
        self%next_heading = "positions"
        do i = 1, points + rotors
            do k = 1, merge(3, 1, i <= points)
                call read_place(i, k, x(k, i))
                if (allocated(error)) return
            end do
        end do
        self%next_heading = "velocities"
        do i = 1, points + rotors
            do k = 1, 3
                call self%total_derivative(x(k, i), u(k, i))
                if (u(k, i)%terms == 0) cycle
                if (i <= points) then
                    call self%add(line_velocity, place_name(i, k)//"_dot", &
                                  "\dot{"//axis_latex(i, k)//"}"//index_latex(i), u(k, i), i, k)
                else
                    call self%add(line_rotor_rate, place_name(i, k)//"_dot", &
                                  "\dot{"//axis_latex(i, k)//"}"//index_latex(i), u(k, i), &
                                  i - points)
                end if
            end do
        end do
        self%next_heading = "kinetic energy"
        call add_energy()
    contains
        subroutine read_place(i, k, p)
            integer, intent(in) :: i, k
            type(polynomial_t), intent(out) :: p

            if (i <= points) then
                if (self%d%points(i)%position(k) == "") return
                call self%read(trim(self%d%points(i)%position(k)), p, error)
                if (allocated(error)) return
                call self%add(line_position, place_name(i, k), axis_latex(i, k)//index_latex(i), &
                              p, i, k)
            else
                if (self%d%rotors(i - points)%mass_formula == "0") return
                call self%read(trim(self%d%rotors(i - points)%position(1)), p, error)
                if (allocated(error)) return
                call self%add(line_rotor, place_name(i, k), axis_latex(i, k)//index_latex(i), &
                              p, i - points)
            end if
        end subroutine read_place

        function place_name(i, k) result(name)
            integer, intent(in) :: i, k
            character(:), allocatable :: name

            if (i <= points) then
                name = axes(k)//"_"//trim(self%d%points(i)%name)
            else
                name = "phi_"//trim(self%d%rotors(i - points)%name)
            end if
        end function place_name

        function axis_latex(i, k) result(name)
            integer, intent(in) :: i, k
            character(:), allocatable :: name

            name = axes(k)
            if (i > points) name = "\varphi"
        end function axis_latex

        function index_latex(i) result(name)
            integer, intent(in) :: i
            character(:), allocatable :: name

            if (i <= points) then
                name = "_{\mathrm{"//trim(self%d%points(i)%name)//"}}"
            else
                name = "_{\mathrm{"//trim(self%d%rotors(i - points)%name)//"}}"
            end if
        end function index_latex

        subroutine add_energy()
            type(expression_t) :: half_mass, rate
            type(polynomial_t) :: mass, square
            character(:), allocatable :: stated
            integer :: i, k
            logical :: has_motion

            do i = 1, points + rotors
                has_motion = .false.
                sum_of_squares = expression_t()
                square = polynomial_t()
                do k = 1, 3
                    if (u(k, i)%terms == 0) cycle
                    square = square + u(k, i)*u(k, i)
                    call lay_out(self%algebra, self%roles, u(k, i), rate)
                    if (u(k, i)%terms == 1 .and. u(k, i)%coefficient(1)%value < 0.0_dp) then
                        call lay_out(self%algebra, self%roles, -u(k, i), rate)
                    end if
                    if (has_motion) then
                        sum_of_squares = sum_of_squares + rate**2
                    else
                        sum_of_squares = rate**2
                    end if
                    has_motion = .true.
                end do
                if (.not. has_motion) cycle
                if (i <= points) then
                    if (self%d%points(i)%mass_formula == "0") cycle
                    call self%read(trim(self%d%points(i)%mass_formula), mass, error)
                else
                    call self%read(trim(self%d%rotors(i - points)%mass_formula), mass, error)
                end if
                if (allocated(error)) return
                call lay_out(self%algebra, self%roles, mass, half_mass)
                half_mass = half_mass/whole(2)
                t = t + mass*square*number_polynomial(ratio(1_i8, 2_i8))
                if (all_of_t%count == 0) then
                    all_of_t = half_mass*sum_of_squares
                else
                    all_of_t = all_of_t + half_mass*sum_of_squares
                end if
            end do
            call shorten(self%algebra, t)
            call self%add(line_kinetic, "T", "T", t, e=all_of_t)
            call lay_out(self%algebra, self%roles, t, rate)
            if (formula_text(rate, self%symbols) /= formula_text(all_of_t, self%symbols)) then
                call self%add(line_kinetic, "", "", t)
            end if
            self%lines(self%count)%is_zero = .false.
            if (.not. allocated(self%d%kinetic_energy)) return
            call parse_formula(self%d%kinetic_energy, self%symbols, rate, error)
            if (allocated(error)) then
                call error%add_context(self%d%kinetic_energy)
                return
            end if
            call self%add(line_stated, "", "", t, e=rate)
            self%lines(self%count)%is_zero = .false.
            stated = formula_text(rate, self%symbols)
            self%lines(self%count)%hidden = stated == formula_text(all_of_t, self%symbols) .or. &
                stated == formula_text(self%lines(self%count - 1)%right, self%symbols)
        end subroutine add_energy
    end subroutine add_points

    subroutine read_forces(self, system, forces, error)
        !! Q of each coordinate.
        type(derivation_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        type(polynomial_t), allocatable, intent(out) :: forces(:)
        type(error_t), allocatable, intent(out) :: error
        character(:), allocatable :: name, text
        integer :: i, k

        allocate (forces(self%n))
        if (.not. system%nonconservative) return
        if (.not. allocated(self%d%generalised_forces)) then
            call fail(error, trim(self%d%name)//" has generalised forces without a formula")
            return
        end if
        do i = 1, self%n
            name = "Q_"//trim(self%d%coordinates(i)%name)//" ="
            do k = 1, size(self%d%generalised_forces)
                text = trim(self%d%generalised_forces(k))
                if (index(text, name) /= 1) cycle
                call self%read(text(len(name) + 1:), forces(i), error)
                if (allocated(error)) return
            end do
        end do
    end subroutine read_forces

    subroutine read_constraints(self, system, error)
        !! Those of the velocities, \(A\dot q + b = 0\).
        type(derivation_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        type(error_t), allocatable, intent(out) :: error
        type(expression_t) :: left, right
        type(polynomial_t) :: p, q
        integer :: i

        if (system%constraints > 0 .and. .not. allocated(self%d%constraint_equations)) then
            call fail(error, trim(self%d%name)//" has a constraint that is too long to be printed")
            return
        end if
        allocate (self%constrained(system%constraints))
        do i = 1, system%constraints
            call parse_equation(trim(self%d%constraint_equations(i)), self%symbols, left, right, &
                                error)
            if (allocated(error)) then
                call error%add_context(trim(self%d%constraint_equations(i)))
                return
            end if
            call self%algebra%from_expression(left, p)
            call self%algebra%from_expression(right, q)
            self%constrained(i) = p - q
        end do
    end subroutine read_constraints

    subroutine add_equations(self, slip, l, forces, error)
        !! Of each coordinate: its momentum, what changes it, and the equation of motion.
        type(derivation_t), intent(inout) :: self
        type(slip_in_formula_t), intent(in) :: slip
        type(polynomial_t), intent(in) :: l, forces(:)
        type(error_t), allocatable, intent(out) :: error
        type(expression_t) :: left, right
        type(polynomial_t) :: p, rate, force, equation, one, row
        character(:), allocatable :: q, tex
        integer :: i, k

        if (self%constraints > 0) then
            self%next_heading = "constraints, each with a multiplier"
            do i = 1, self%constraints
                call self%add(line_constraint, "", "", self%constrained(i), i)
            end do
        end if
        allocate (self%equations(self%n))
        do i = 1, self%n
            q = trim(self%d%coordinates(i)%name)
            tex = latex_name(q)
            self%next_heading = "Lagrange's equation of "//q//trim(merge( &
                ", in flight", "           ", self%d%constraint == "unilateral"))
            call self%algebra%derivative(l, self%velocity(i), p)
            call tidy(self%algebra, p)
            call self%total_derivative(p, rate)
            call tidy(self%algebra, rate)
            call self%algebra%derivative(l, self%coordinate(i), force)
            call tidy(self%algebra, force)
            call self%add(line_momentum, "dL/d"//q//"_dot", &
                          "\frac{\partial L}{\partial "//latex_name(q//"_dot")//"}", p, i)
            call self%add(line_rate, "d/dt dL/d"//q//"_dot", &
                          "\frac{d}{dt} \frac{\partial L}{\partial "//latex_name(q//"_dot")//"}", &
                          rate, i)
            call self%add(line_force, "dL/d"//q, "\frac{\partial L}{\partial "//tex//"}", force, i)
            if (forces(i)%terms > 0) call self%add(line_beside, "Q_"//q, "Q_{"//tex//"}", &
                                                   forces(i), i)
            equation = rate - force - forces(i)
            do k = 1, self%constraints
                call self%algebra%derivative(self%constrained(k), self%velocity(i), row)
                equation = equation - row*atom_power(self%multiplier(k), 1)
            end do
            call tidy(self%algebra, equation)
            call add_equation(self, equation, i, .false.)
            if (slip%kind == line_equation .and. slip%i == i) then
                call parse_equation(slip%formula, self%symbols, left, right, error)
                if (allocated(error)) return
                call self%algebra%from_expression(left, equation)
                call self%algebra%from_expression(right, one)
                equation = equation - one
                call add_equation(self, equation, i, .true.)
            end if
            self%equations(i) = equation
            if (force%terms == 0 .and. forces(i)%terms == 0 .and. self%constraints == 0) then
                call self%add_words(q//" is cyclic: dL/d"//q//"_dot is conserved", &
                                    "$"//latex_name(q)//"$ is cyclic: $\partial L/\partial"// &
                                    latex_name(q//"_dot")//"$ is conserved")
            end if
        end do
    end subroutine add_equations

    subroutine add_equation(self, equation, i, slipped)
        !! As it follows, and without a common factor of parameters.
        type(derivation_t), intent(inout) :: self
        type(polynomial_t), intent(in) :: equation
        integer, intent(in) :: i
        logical, intent(in) :: slipped
        type(polynomial_t) :: divided, factor

        call self%add(line_equation, "", "", equation, i)
        self%lines(self%count)%slipped = slipped
        if (equation%terms == 0) return
        call divide_by_parameters(self, equation, divided, factor)
        if (factor%terms == 0) return
        call self%add(line_divided, "", "", divided, i)
        call lay_out(self%algebra, self%roles, factor, self%lines(self%count)%factor)
        self%lines(self%count)%slipped = slipped
    end subroutine add_equation
end module lagrangia_derivation_steps
