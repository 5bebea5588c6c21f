module lagrangia_derivation_modes
    !! The equations of motion linearised about the equilibrium, and the frequencies that follow,
    !! beside LAPACK's numbers.
    use lagrangia_damped_rates, only: damped_rates
    use lagrangia_derivation, only: derivation_t, line_characteristic, line_equilibrium, &
                                    line_gyroscopic, line_omega2, line_rest_mass, line_stiffness
    use lagrangia_derivation_drag, only: add_polynomial, add_rates, collect_powers
    use lagrangia_derivation_linear, only: add_linear
    use lagrangia_derivation_motion, only: determinant, lay_out_quotient
    use lagrangia_derivation_place, only: linearise, read_equilibrium
    use lagrangia_equilibrium, only: missed_text
    use lagrangia_errors, only: error_t
    use lagrangia_exact_number, only: number_t, operator(-), ratio
    use lagrangia_expression, only: apply, expression_t, f_sqrt, function_names, &
                                    operator(+), operator(-), operator(*), operator(**)
    use lagrangia_formula_latex, only: latex_name
    use lagrangia_formula_parser, only: parse_equation, parse_formula
    use lagrangia_kinds, only: dp, i8
    use lagrangia_number_class, only: is_nonzero
    use lagrangia_page_layout, only: lay_out, lay_out_factors, lay_out_fraction
    use lagrangia_polynomial, only: atom_power, most_atoms, operator(+), operator(-), &
                                    operator(*), polynomial_t, whole_polynomial
    use lagrangia_small_oscillations, only: find_modes, likely_equilibrium, modes_t
    use lagrangia_solved_place, only: solve_place
    use lagrangia_system, only: system_t
    use lagrangia_text, only: to_text
    use lagrangia_trigonometry, only: shorten
    implicit none (type, external)
    private
    public :: add_modes

    integer, parameter :: most_expanded = 4  !! coordinates whose characteristic polynomial is shown

contains

    subroutine add_modes(self, system, slipped)
        !! M, G, K, and omega^2. With a slip the equilibrium is taken as that of the true equations.
        type(derivation_t), intent(inout) :: self  !! with its equations
        class(system_t), intent(in) :: system      !! configured
        logical, intent(in) :: slipped             !! a formula is wrong on purpose
        type(modes_t) :: modes, others
        type(error_t), allocatable :: error
        character(:), allocatable :: missed

        self%next_heading = "small oscillations"
        call find_modes(system, likely_equilibrium(system), .false., modes, error)
        if (system%constraints > 0 .and. .not. allocated(error)) then
            call self%add_words("'lagrangia modes' has them, in the directions that the "// &
                                "constraints leave")
            return
        end if
        if (allocated(error)) then
            call self%add_words("none: "//error%message)
            return
        end if
        if (allocated(self%d%equilibrium_formulas)) then
            missed = missed_text(self%d, likely_equilibrium(system), modes%at)
            if (missed /= "") then
                call self%add_words(missed)
                return
            end if
        end if
        call add_place(self, system, modes)
        if (.not. allocated(modes%analytic%elsewhere)) return
        call find_modes(system, modes%analytic%elsewhere, .true., others, error)
        if (allocated(error)) return
        call read_other_place(self)
        if (.not. self%elsewhere) return
        self%next_heading = "small oscillations about the other equilibrium"
        call add_place(self, system, others)
        self%elsewhere = .false.
        deallocate (self%d%equilibrium_formulas)
    end subroutine add_modes

    subroutine read_other_place(self)
        !! The description's frequencies name places: one coordinate's cosine or sine is taken.
        type(derivation_t), intent(inout) :: self  !! the lines to come are about that place
        type(expression_t) :: left, right, place
        type(error_t), allocatable :: error
        integer :: k, which, function

        if (self%n /= 1 .or. allocated(self%d%equilibrium_formulas)) return
        if (.not. allocated(self%d%frequencies)) return
        do k = 1, size(self%d%frequencies)
            associate (text => self%d%frequencies(k)%equilibrium)
                if (index(text, "=") == 0) cycle
                call parse_equation(trim(text), self%symbols, left, right, error)
                if (allocated(error)) cycle
                call solve_place(left, right, which, function, place)
                if (function == 0) cycle
                allocate (self%d%equilibrium_formulas(1))
                self%d%equilibrium_formulas(1) = text
                self%elsewhere = .true.
                return
            end associate
        end do
    end subroutine read_other_place

    subroutine add_place(self, system, modes)
        !! About the place of the description's `equilibrium_formulas`, or zero.
        type(derivation_t), intent(inout) :: self  !! with its equations
        class(system_t), intent(in) :: system      !! configured
        type(modes_t), intent(in) :: modes         !! about that place
        type(error_t), allocatable :: error
        type(polynomial_t), allocatable :: at(:), mass(:, :), gyroscopic(:, :), stiffness(:, :)
        character(:), allocatable :: tex, turning, where_at
        character :: letter
        complex(dp), allocatable :: lambda(:)
        logical :: of_position, away, drag
        integer, allocatable :: resting(:)
        integer :: i

        call read_equilibrium(self, at, resting, error)
        if (allocated(error)) then
            call self%add_words("none: "//error%message)
            return
        end if
        call linearise(self, at, resting, mass, gyroscopic, stiffness, of_position)
        if (self%algebra%full) then
            call self%add_words("not linearised: a derivative jumps or divides by zero at "// &
                                "rest, or has too many terms")
            return
        end if
        away = any(is_nonzero(modes%at)) .and. .not. any_place(at)
        if (away .and. of_position) then
            call self%add_words("the equilibrium is not at zero: 'lagrangia modes' has the numbers")
            return
        end if
        drag = system%nonconservative .or. .not. is_antisymmetric(gyroscopic)
        letter = merge("C", "G", drag)
        if (drag .and. any(is_nonzero(modes%gyroscopic))) letter = "B"
        turning = "M q_ddot + K q"
        if (any_terms(gyroscopic)) turning = "M q_ddot + "//letter//" q_dot + K q"
        if (any_place(at)) then
            call add_equilibrium(self, at, resting)
            where_at = "about this place, from which q is counted: "
        else if (away) then
            where_at = "about the equilibrium: "
        else
            where_at = ""
            do i = 1, self%n
                where_at = where_at//", "//trim(self%d%coordinates(i)%name)//" = 0"
            end do
            where_at = "about"//where_at(2:)//": "
            tex = ""
            do i = 1, self%n
                tex = tex//", $"//latex_name(trim(self%d%coordinates(i)%name))//" = 0$"
            end do
            tex = "about"//tex(2:)//": "
        end if
        if (.not. allocated(tex)) tex = where_at
        tex = tex//"$M \ddot{q}"
        if (any_terms(gyroscopic)) tex = tex//" + "//letter//" \dot{q}"
        call self%add_words(where_at//turning//" = 0 with", tex//" + K q = 0$ with")
        call add_elements(self, line_rest_mass, "M", mass)
        call add_elements(self, line_gyroscopic, letter, gyroscopic)
        call add_elements(self, line_stiffness, "K", stiffness)
        call add_linear(self, mass, gyroscopic, stiffness)
        if (drag) then
            call damped_rates(system, modes, lambda, error)
            if (allocated(error)) lambda = [complex(dp) ::]
            call add_rates(self, letter, mass, gyroscopic, stiffness, lambda)
        else
            call add_roots(self, mass, gyroscopic, stiffness)
        end if
    end subroutine add_place

    pure function any_place(at) result(yes)
        !! Is a coordinate's place not zero?
        type(polynomial_t), intent(in) :: at(:)
        logical :: yes

        yes = any(at%terms > 0)
    end function any_place

    subroutine add_equilibrium(self, at, resting)
        !! A line for each coordinate.
        type(derivation_t), intent(inout) :: self
        type(polynomial_t), intent(in) :: at(:)
        integer, intent(in) :: resting(:)
        type(expression_t) :: as_typed
        type(error_t), allocatable :: error
        character(:), allocatable :: name, tex, text
        integer :: i

        do i = 1, self%n
            name = trim(self%d%coordinates(i)%name)
            tex = latex_name(name)
            if (resting(i) > 0) then
                tex = "\"//trim(function_names(resting(i)))//" "//tex
                name = trim(function_names(resting(i)))//"("//name//")"
            end if
            text = trim(self%d%equilibrium_formulas(i))
            call parse_formula(text(index(text, "=") + 1:), self%symbols, as_typed, error)
            call self%add(line_equilibrium, name, tex, at(i), i, resting(i), e=as_typed)
        end do
    end subroutine add_equilibrium

    pure function is_antisymmetric(matrix) result(yes)
        !! As it is without drag.
        type(polynomial_t), intent(in) :: matrix(:, :)
        logical :: yes
        type(polynomial_t) :: both
        integer :: i, k

        yes = .true.
        do i = 1, size(matrix, 1)
            do k = 1, i
                both = matrix(i, k) + matrix(k, i)
                yes = yes .and. both%terms == 0
            end do
        end do
    end function is_antisymmetric

    pure function any_terms(matrix) result(yes)
        !! Is an element not zero?
        type(polynomial_t), intent(in) :: matrix(:, :)
        logical :: yes
        integer :: i, k

        yes = .false.
        do i = 1, size(matrix, 1)
            do k = 1, size(matrix, 2)
                yes = yes .or. matrix(i, k)%terms > 0
            end do
        end do
    end function any_terms

    subroutine add_elements(self, kind, letter, matrix)
        !! Those that are not zero; of a symmetric matrix above the diagonal.
        type(derivation_t), intent(inout) :: self
        integer, intent(in) :: kind
        character, intent(in) :: letter
        type(polynomial_t), intent(in) :: matrix(:, :)
        type(polynomial_t) :: difference
        integer :: i, k
        logical :: symmetric

        symmetric = .true.
        do i = 1, self%n
            do k = 1, i - 1
                difference = matrix(i, k) - matrix(k, i)
                symmetric = symmetric .and. difference%terms == 0
            end do
        end do
        do i = 1, self%n
            do k = 1, self%n
                if (k < i .and. symmetric) cycle
                if (matrix(i, k)%terms == 0 .and. (i /= k .or. kind == line_gyroscopic)) cycle
                if (self%n == 1) then
                    call self%add(kind, letter, letter, matrix(i, k), i, k)
                else
                    call self%add(kind, letter//to_text(i)//to_text(k), &
                                  letter//"_{"//to_text(i)//to_text(k)//"}", matrix(i, k), i, k)
                end if
            end do
        end do
    end subroutine add_elements

    subroutine add_roots(self, mass, gyroscopic, stiffness)
        !! \(\det(K - \omega^2 M + i\omega G) = 0\).
        type(derivation_t), intent(inout) :: self
        type(polynomial_t), intent(in) :: mass(:, :), gyroscopic(:, :), stiffness(:, :)
        type(polynomial_t), allocatable :: matrix(:, :), c(:)
        type(polynomial_t) :: p, zero
        character(:), allocatable :: rest
        logical :: one_root
        integer :: i, k

        if (all_diagonal()) then
            do i = 1, self%n
                call add_root(stiffness(i, i), mass(i, i), i)
            end do
            return
        end if
        if (self%n > most_expanded) then
            rest = " is not written out for more than "//to_text(most_expanded)//" coordinates"
            call self%add_words("det(K - "//name()//"^2 M)"//rest, &
                                "$\det(K - "//latex_name(name())//"^2 M)$"//rest)
            return
        end if
        allocate (matrix(self%n, self%n))
        do i = 1, self%n
            do k = 1, self%n
                matrix(i, k) = stiffness(i, k) - mass(i, k)*atom_power(self%omega(), 2) &
                               + gyroscopic(i, k)*atom_power(self%power_of_i(), 1)
            end do
        end do
        call determinant(matrix, p)
        call split_powers(self, p, c)
        one_root = .false.
        if (self%n == 2) one_root = is_square(c)
        if (self%n == 2 .and. c(1)%terms == 0 .and. c(3)%terms > 0) then
            call add_root(zero, c(3), 1)
            call add_root(-c(2), c(3), 2)
        else if (one_root) then
            call add_root(-c(2), whole_polynomial(2)*c(3), 1)
            call add_root(-c(2), whole_polynomial(2)*c(3), 2)
        else if (self%n == 2 .and. c(3)%terms > 0) then
            call add_pair(self, c)
        else
            call add_polynomial(self, line_characteristic, self%omega(), 2, c)
        end if
    contains
        logical function is_square(c)
            !! The two roots are one.
            type(polynomial_t), intent(in) :: c(:)
            type(polynomial_t) :: discriminant

            discriminant = c(2)*c(2) - whole_polynomial(4)*c(1)*c(3)
            call shorten(self%algebra, discriminant)
            is_square = discriminant%terms == 0 .and. c(3)%terms > 0
        end function is_square

        logical function all_diagonal()
            integer :: i, k

            all_diagonal = .true.
            do i = 1, self%n
                all_diagonal = all_diagonal .and. mass(i, i)%terms > 0
                do k = 1, self%n
                    if (gyroscopic(i, k)%terms > 0) all_diagonal = .false.
                    if (i == k) cycle
                    if (mass(i, k)%terms > 0 .or. stiffness(i, k)%terms > 0) all_diagonal = .false.
                end do
            end do
        end function all_diagonal

        function name() result(text)
            character(:), allocatable :: text

            text = trim(self%symbols%names(self%omega()))
        end function name

        subroutine add_root(above, below, i)
            type(polynomial_t), intent(in) :: above, below
            integer, intent(in) :: i
            type(expression_t) :: e

            call lay_out_quotient(self%algebra, self%roles, above, below, e)
            call self%add(line_omega2, name()//"^2", "\"//name()//"^2", above, i, e=e)
        end subroutine add_root
    end subroutine add_roots

    subroutine split_powers(self, p, c)
        !! The coefficients of \(1, \omega^2, \omega^4, ...\), with \((i\omega)^2 = -\omega^2\).
        type(derivation_t), intent(inout) :: self
        type(polynomial_t), intent(in) :: p
        type(polynomial_t), allocatable, intent(out) :: c(:)
        type(polynomial_t) :: real_one
        type(number_t) :: coefficient
        integer :: i, powers(most_atoms), turns

        do i = 1, p%terms
            powers = p%power(:, i)
            turns = powers(self%power_of_i())
            if (mod(turns, 2) /= 0) cycle  ! these cancel, as G is antisymmetric
            powers(self%omega()) = powers(self%omega()) + turns
            powers(self%power_of_i()) = 0
            coefficient = p%coefficient(i)
            if (mod(turns/2, 2) /= 0) coefficient = -coefficient
            call real_one%add_term(coefficient, powers)
        end do
        allocate (c(self%n + 1))
        call collect_powers(self, real_one, self%omega(), 2, c)
    end subroutine split_powers

    subroutine add_pair(self, c)
        !! \(\omega^2 = (-c_1 \pm\sqrt{c_1^2 - 4 c_0 c_2})/(2 c_2)\), without common factors.
        type(derivation_t), intent(inout) :: self
        type(polynomial_t), intent(in) :: c(:)
        type(polynomial_t) :: common, discriminant, product, sum_of
        type(expression_t) :: front, half, root, short
        character(:), allocatable :: name, tex
        integer :: powers(most_atoms)

        name = trim(self%symbols%names(self%omega()))//"^2"
        tex = "\"//name
        sum_of = -c(2)
        product = whole_polynomial(4)*c(1)*c(3)
        call square_of_common(sum_of, product, powers)
        sum_of = sum_of%shifted(unit(), -powers)
        product = product%shifted(unit(), -2*powers)
        discriminant = sum_of*sum_of - product
        call shorten(self%algebra, discriminant)
        call common%add_term(unit(), powers)
        call lay_out_fraction(self%algebra, self%roles, common, whole_polynomial(2)*c(3), front)
        call lay_out_factors(self%algebra, self%roles, sum_of, half)
        call lay_out_factors(self%algebra, self%roles, product, short)
        short = half**2 - short
        call lay_out(self%algebra, self%roles, discriminant, root)
        if (short%count < root%count) root = short
        root = apply(f_sqrt, root)
        call self%add(line_omega2, name, tex, sum_of, 1, e=front*(half - root))
        call self%add(line_omega2, name, tex, sum_of, 2, e=front*(half + root))
    contains
        pure function unit() result(number)
            type(number_t) :: number

            number = ratio(1_i8, 1_i8)
        end function unit

        pure subroutine square_of_common(first, second, powers)
            !! Powers that all terms of `first` have, and twice those all of `second`.
            type(polynomial_t), intent(in) :: first, second
            integer, intent(out) :: powers(:)
            integer :: other(size(powers))
            type(number_t) :: number

            call first%common(number, powers)
            call second%common(number, other)
            where (powers > 0)
                powers = min(powers, max(0, other/2))
            else where
                powers = max(powers, min(0, other/2))
            end where
        end subroutine square_of_common
    end subroutine add_pair
end module lagrangia_derivation_modes
