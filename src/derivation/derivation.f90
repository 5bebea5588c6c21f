module lagrangia_derivation
    !! The steps from the positions of the masses to small oscillations, as data: one line each.
    use lagrangia_algebra, only: algebra_t
    use lagrangia_description, only: description_t, value_names
    use lagrangia_errors, only: error_t, fail
    use lagrangia_expression, only: expression_t
    use lagrangia_formula_parser, only: parse_formula
    use lagrangia_formula_text, only: formula_text
    use lagrangia_names, only: name_length
    use lagrangia_page_layout, only: lay_out, role_acceleration, role_coordinate, role_frequency, &
                                role_gravity, role_mass, role_multiplier, role_parameter, &
                                role_time, role_velocity
    use lagrangia_polynomial, only: atom_power, operator(+), operator(*), polynomial_t
    use lagrangia_symbols, only: symbols_t
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: derivation_t, line_t
    public :: line_acceleration, line_characteristic, line_constraint, line_divided, &
              line_equation, line_force, line_gyroscopic, line_kinetic, line_lagrangian, &
              line_mass, line_momentum, line_multiplier, line_omega2, line_position, &
              line_potential, line_rate, line_right_side, line_rotor, line_rotor_rate, &
              line_stiffness, line_stated, line_velocity, line_beside, line_words, line_rest_mass, &
              line_damped_omega2, line_decay, line_equilibrium, line_linear, line_rates

    integer, parameter :: line_words = 0        !! no equality: words
    integer, parameter :: line_position = 1     !! axis k of point i
    integer, parameter :: line_rotor = 2        !! angle of rotor i
    integer, parameter :: line_velocity = 3     !! axis k of point i
    integer, parameter :: line_rotor_rate = 4   !! of rotor i
    integer, parameter :: line_kinetic = 5      !! T
    integer, parameter :: line_stated = 6       !! T as the description has it
    integer, parameter :: line_potential = 7    !! V, or U with velocities
    integer, parameter :: line_lagrangian = 8   !! L
    integer, parameter :: line_momentum = 9     !! dL/dq_dot of coordinate i
    integer, parameter :: line_rate = 10        !! its time derivative
    integer, parameter :: line_force = 11       !! dL/dq
    integer, parameter :: line_beside = 12      !! Q
    integer, parameter :: line_equation = 13    !! of coordinate i, equal to zero
    integer, parameter :: line_divided = 14     !! the same over `factor`
    integer, parameter :: line_constraint = 15  !! of the velocities, i, equal to zero
    integer, parameter :: line_mass = 16        !! element i, k of the mass matrix
    integer, parameter :: line_right_side = 17  !! f in M q_ddot = f, of coordinate i
    integer, parameter :: line_multiplier = 18  !! lambda of constraint i
    integer, parameter :: line_acceleration = 19   !! of coordinate i
    integer, parameter :: line_rest_mass = 20      !! element i, k of M at rest
    integer, parameter :: line_stiffness = 21      !! of K
    integer, parameter :: line_gyroscopic = 22     !! of G, and of C where there is drag
    integer, parameter :: line_omega2 = 23         !! root i of the characteristic polynomial
    integer, parameter :: line_characteristic = 24 !! the polynomial, equal to zero
    integer, parameter :: line_equilibrium = 25    !! where coordinate i rests
    integer, parameter :: line_decay = 26          !! decay rate, of one coordinate
    integer, parameter :: line_damped_omega2 = 27  !! the frequency with drag, of one coordinate
    integer, parameter :: line_rates = 28          !! the polynomial of the rates, equal to zero
    integer, parameter :: line_linear = 29         !! linearised equation i, without q_k_ddot

    type :: line_t
        !! `left = right`, or `right = 0`, or words.
        integer :: kind = line_words
        integer :: i = 0, k = 0                   !! which coordinate, point, element
        logical :: elsewhere = .false.            !! about the other equilibrium
        character(:), allocatable :: left         !! as text; the words of a line without equality
        character(:), allocatable :: left_latex
        character(:), allocatable :: heading      !! not empty: a new step begins here
        type(expression_t) :: right               !! of the derivation's symbols
        type(expression_t) :: factor              !! of a divided equation: what it was divided by
        logical :: is_zero = .false.              !! `right = 0`
        logical :: hidden = .false.               !! it repeats the line before
        logical :: slipped = .false.              !! the slip is put in here
    end type line_t

    type :: derivation_t
        !! The lines, and the names in their formulas: t, coordinates, velocities, accelerations,
        !! parameters, multipliers, lambda, omega.
        type(symbols_t) :: symbols
        type(algebra_t) :: algebra
        type(description_t) :: d
        integer, allocatable :: roles(:)      !! of the names
        integer :: n = 0                      !! coordinates
        integer :: constraints = 0            !! non-holonomic ones
        integer :: parameters = 0, count = 0  !! values; lines
        type(line_t), allocatable :: lines(:) !! the first `count` count
        type(polynomial_t), allocatable :: equations(:)    !! zero, (n)
        type(polynomial_t), allocatable :: constrained(:)  !! zero, (constraints), of velocities
        character(:), allocatable :: next_heading
        logical :: elsewhere = .false.                     !! lines to come are
    contains
        procedure :: begin
        procedure :: acceleration
        procedure :: add
        procedure :: add_words
        procedure :: coordinate
        procedure :: multiplier
        procedure :: line_text
        procedure :: omega
        procedure :: power_of_i
        procedure :: rate
        procedure :: read
        procedure :: total_derivative
        procedure :: velocity
    end type derivation_t

contains

    subroutine begin(self, d, constraints, error)
        !! Learn the names of a description, and its letters.
        class(derivation_t), intent(inout) :: self        !! new
        type(description_t), intent(in) :: d              !! of a configured system
        integer, intent(in) :: constraints                !! non-holonomic ones
        type(error_t), allocatable, intent(out) :: error  !! a name is taken, or too many
        character(name_length), allocatable :: names(:)
        integer :: i, k

        self%d = d
        self%n = size(d%coordinates)
        self%constraints = constraints
        self%next_heading = ""
        allocate (self%lines(32))
        allocate (names, source=value_names(d))
        self%parameters = size(names)
        call self%symbols%add("t")
        do i = 1, self%n
            call self%symbols%add(trim(d%coordinates(i)%name))
        end do
        do i = 1, self%n
            call self%symbols%add(trim(d%coordinates(i)%name)//"_dot")
        end do
        do i = 1, self%n
            call self%symbols%add(trim(d%coordinates(i)%name)//"_ddot")
        end do
        do i = 1, size(names)
            call self%symbols%add(trim(short_name(d, names(i))))
        end do
        do i = 1, constraints
            call self%symbols%add(multiplier_name(d, i, constraints))
        end do
        call self%symbols%add(trim(free_name(self%symbols, d, ["lambda", "Lambda", "s     "])))
        call self%symbols%add(trim(free_name(self%symbols, d, ["omega", "Omega", "nu   "])))
        call self%symbols%add("#")
        associate (m => size(self%symbols%names))
            allocate (self%roles(m), source=role_parameter)
            self%roles(m - 2:) = role_frequency
        end associate
        self%roles(1) = role_time
        self%roles(2:1 + self%n) = role_coordinate
        self%roles(2 + self%n:1 + 2*self%n) = role_velocity
        self%roles(2 + 2*self%n:1 + 3*self%n) = role_acceleration
        k = 1 + 3*self%n
        do i = 1, size(d%parameters)
            if (is_mass(d%parameters(i)%name, d%parameters(i)%unit)) self%roles(k + 1) = role_mass
            if (d%parameters(i)%name == "g") self%roles(k + 1) = role_gravity
            k = k + d%parameters(i)%count
        end do
        self%roles(k + 1:k + constraints) = role_multiplier
        call self%algebra%begin(size(self%symbols%names))
        if (self%algebra%full) then
            call fail(error, "too many names for a derivation on paper; take fewer coordinates")
            return
        end if
        call define_letters(self, names, error)
    end subroutine begin

    pure function is_mass(name, unit) result(yes)
        !! In kg, or without a unit and called `m`, `m2`, `M_w`.
        character(*), intent(in) :: name, unit
        logical :: yes

        yes = unit == "kg"
        if (unit == "1") yes = verify(name(:1), "mM") == 0 .and. &
                               verify(name(2:2), "_0123456789 ") == 0
    end function is_mass

    pure function short_name(d, name) result(short)
        !! The letter that stands for the parameter, or its own name.
        type(description_t), intent(in) :: d
        character(*), intent(in) :: name
        character(name_length) :: short
        integer :: i

        short = name
        if (.not. allocated(d%letters)) return
        do i = 1, size(d%letters)
            if (d%letters(i)%formula == name) short = d%letters(i)%name
        end do
    end function short_name

    pure function multiplier_name(d, i, constraints) result(name)
        !! As the description calls it, `lambda_x`, or `lambda1`.
        type(description_t), intent(in) :: d
        integer, intent(in) :: i, constraints
        character(:), allocatable :: name
        integer :: k, met

        name = "lambda"//to_text(i)
        if (.not. allocated(d%letters)) return
        if (count(index(d%letters%name, "lambda") == 1) /= constraints) return
        met = 0
        do k = 1, size(d%letters)
            if (index(d%letters(k)%name, "lambda") /= 1) cycle
            met = met + 1
            if (met == i) name = trim(d%letters(k)%name)
        end do
    end function multiplier_name

    pure function free_name(symbols, d, names) result(name)
        !! For the frequency, or the rate: the first that is no name, and no letter that is used.
        type(symbols_t), intent(in) :: symbols
        type(description_t), intent(in) :: d
        character(*), intent(in) :: names(:)
        character(len(names)) :: name
        character(:), allocatable :: said
        integer :: i, k

        said = ""
        if (allocated(d%lagrangian)) said = said//d%lagrangian
        if (allocated(d%kinetic_energy)) said = said//d%kinetic_energy
        if (allocated(d%potential_energy)) said = said//d%potential_energy
        if (allocated(d%generalised_forces)) then
            do i = 1, size(d%generalised_forces)
                said = said//d%generalised_forces(i)
            end do
        end if
        if (allocated(d%points)) then
            do i = 1, size(d%points)
                said = said//d%points(i)%mass_formula
                do k = 1, 3
                    said = said//d%points(i)%position(k)
                end do
            end do
        end if
        do i = 1, size(names)
            name = names(i)
            if (symbols%find(trim(name)) > 0) cycle
            if (.not. allocated(d%letters)) return
            if (.not. any(d%letters%name == name)) return
            if (index(said, trim(name)) == 0) return
        end do
    end function free_name

    subroutine define_letters(self, names, error)
        !! What stands for a formula of names, with its rates; other letters are left out.
        class(derivation_t), intent(inout) :: self
        character(*), intent(in) :: names(:)
        type(error_t), allocatable, intent(out) :: error
        type(expression_t) :: meaning
        type(polynomial_t) :: p, rate
        type(error_t), allocatable :: unknown
        integer :: i

        do i = 1, size(names)
            if (self%symbols%find(trim(names(i))) > 0) cycle
            call parse_formula(trim(short_name(self%d, names(i))), self%symbols, meaning, error)
            if (.not. allocated(error)) call self%symbols%define(trim(names(i)), meaning, error)
            if (allocated(error)) return
        end do
        if (.not. allocated(self%d%letters)) return
        do i = 1, size(self%d%letters)
            associate (letter => self%d%letters(i))
                if (any(names == letter%formula)) cycle
                call parse_formula(trim(letter%formula), self%symbols, meaning, unknown)
                if (.not. allocated(unknown)) then
                    call self%symbols%define(trim(letter%name), meaning, unknown)
                end if
                if (allocated(unknown)) cycle
                call self%algebra%from_expression(meaning, p)
                call self%total_derivative(p, rate)
                call lay_out(self%algebra, self%roles, rate, meaning)
                call self%symbols%define(trim(letter%name)//"_dot", meaning, unknown)
            end associate
        end do
    end subroutine define_letters

    pure function coordinate(self, i) result(name)
        !! The symbol of coordinate `i`.
        class(derivation_t), intent(in) :: self
        integer, intent(in) :: i  !! from 1
        integer :: name

        name = 1 + i
    end function coordinate

    pure function velocity(self, i) result(name)
        !! The symbol of velocity `i`.
        class(derivation_t), intent(in) :: self
        integer, intent(in) :: i  !! from 1
        integer :: name

        name = 1 + self%n + i
    end function velocity

    pure function acceleration(self, i) result(name)
        !! The symbol of acceleration `i`.
        class(derivation_t), intent(in) :: self
        integer, intent(in) :: i  !! from 1
        integer :: name

        name = 1 + 2*self%n + i
    end function acceleration

    pure function multiplier(self, i) result(name)
        !! The symbol of multiplier `i`.
        class(derivation_t), intent(in) :: self
        integer, intent(in) :: i  !! from 1
        integer :: name

        name = 1 + 3*self%n + self%parameters + i
    end function multiplier

    pure function omega(self) result(name)
        !! The symbol of the frequency.
        class(derivation_t), intent(in) :: self
        integer :: name

        name = size(self%symbols%names) - 1
    end function omega

    pure function rate(self) result(name)
        !! The symbol of \(\lambda\) in \(e^{\lambda t}\).
        class(derivation_t), intent(in) :: self
        integer :: name

        name = size(self%symbols%names) - 2
    end function rate

    pure function power_of_i(self) result(name)
        !! A symbol for i omega, which no line shows.
        class(derivation_t), intent(in) :: self
        integer :: name

        name = size(self%symbols%names)
    end function power_of_i

    subroutine read(self, text, p, error)
        !! A formula of the description.
        class(derivation_t), intent(inout) :: self
        character(*), intent(in) :: text                  !! in the system's letters
        type(polynomial_t), intent(out) :: p              !! the same multiplied out
        type(error_t), allocatable, intent(out) :: error  !! quotes it
        type(expression_t) :: e

        call parse_formula(text, self%symbols, e, error)
        if (allocated(error)) then
            call error%add_context(text)
            return
        end if
        call self%algebra%from_expression(e, p)
    end subroutine read

    pure subroutine total_derivative(self, p, rate)
        !! \(\partial p/\partial t + \sum_j \dot q_j\,\partial p/\partial q_j
        !! + \ddot q_j\,\partial p/\partial\dot q_j\).
        class(derivation_t), intent(inout) :: self
        type(polynomial_t), intent(in) :: p      !! of t, coordinates and velocities
        type(polynomial_t), intent(out) :: rate  !! its time derivative
        type(polynomial_t) :: one
        integer :: i

        call self%algebra%derivative(p, 1, rate)
        do i = 1, 2*self%n
            call self%algebra%derivative(p, 1 + i, one)
            rate = rate + one*atom_power(1 + self%n + i, 1)
        end do
    end subroutine total_derivative

    pure subroutine add(self, kind, left, left_latex, p, i, k, e)
        !! One line more; its formula is `p`, or `e` as it is.
        class(derivation_t), intent(inout) :: self
        integer, intent(in) :: kind                      !! `line_position` to `line_linear`
        character(*), intent(in) :: left, left_latex     !! "": the right side is zero
        type(polynomial_t), intent(in) :: p              !! the right side
        integer, intent(in), optional :: i, k            !! which one
        type(expression_t), intent(in), optional :: e    !! in place of `p`
        type(line_t) :: line

        line%kind = kind
        line%left = left
        line%left_latex = left_latex
        line%is_zero = left == ""
        if (present(i)) line%i = i
        if (present(k)) line%k = k
        if (present(e)) then
            line%right = e
        else
            call lay_out(self%algebra, self%roles, p, line%right)
        end if
        call append(self, line)
    end subroutine add

    pure subroutine add_words(self, text, latex)
        !! A remark.
        class(derivation_t), intent(inout) :: self
        character(*), intent(in) :: text             !! one line
        character(*), intent(in), optional :: latex  !! the same; absent: names as typed
        type(line_t) :: line
        integer :: i

        line%left = text
        if (present(latex)) then
            line%left_latex = latex
        else
            line%left_latex = ""
            do i = 1, len(text)
                if (scan(text(i:i), "_%#&$^") > 0) line%left_latex = line%left_latex//"\"
                line%left_latex = line%left_latex//text(i:i)
                if (text(i:i) == "^") line%left_latex = line%left_latex//"{}"
            end do
        end if
        call append(self, line)
    end subroutine add_words

    pure function line_text(self, i) result(text)
        !! `left = right`, as it is printed; of a further form of the line before `= right`.
        class(derivation_t), intent(in) :: self
        integer, intent(in) :: i  !! which line
        character(:), allocatable :: text

        associate (line => self%lines(i))
            if (line%kind == line_words) then
                text = line%left
            else if (line%is_zero) then
                text = formula_text(line%right, self%symbols)//" = 0"
            else if (line%left == "") then
                text = "= "//formula_text(line%right, self%symbols)
            else
                text = line%left//" = "//formula_text(line%right, self%symbols)
            end if
        end associate
    end function line_text

    pure subroutine append(self, line)
        !! At the end, with the heading that waits.
        class(derivation_t), intent(inout) :: self
        type(line_t), intent(in) :: line
        type(line_t), allocatable :: longer(:)
        integer :: i

        if (self%count == size(self%lines)) then
            allocate (longer(2*self%count))
            do i = 1, self%count
                longer(i) = self%lines(i)
            end do
            call move_alloc(longer, self%lines)
        end if
        self%count = self%count + 1
        self%lines(self%count) = line
        self%lines(self%count)%heading = self%next_heading
        self%lines(self%count)%elsewhere = self%elsewhere
        self%next_heading = ""
    end subroutine append
end module lagrangia_derivation
