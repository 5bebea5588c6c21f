module lagrangia_derivation_place
    !! The place that equations are linearised about, and M, G and K there.
    use lagrangia_derivation, only: derivation_t
    use lagrangia_errors, only: error_t
    use lagrangia_expression, only: expression_t, f_cos, f_sin
    use lagrangia_formula_parser, only: parse_equation
    use lagrangia_polynomial, only: atom_power, most_atoms, operator(+), operator(-), &
                                    operator(*), polynomial_t, whole_polynomial
    use lagrangia_solved_place, only: solve_place
    use lagrangia_trigonometry, only: shorten
    implicit none (type, external)
    private
    public :: linearise, read_equilibrium

contains

    subroutine read_equilibrium(self, at, resting, error)
        !! Zero, or what the description has; where `resting` is `f_cos` or `f_sin`, that is given.
        type(derivation_t), intent(inout) :: self                   !! knows the letters
        type(polynomial_t), allocatable, intent(out) :: at(:)           !! of each coordinate
        integer, allocatable, intent(out) :: resting(:)                 !! as above
        type(error_t), allocatable, intent(out) :: error              !! quotes the formula
        type(expression_t) :: left, right, place
        character(:), allocatable :: text
        integer :: i, which

        allocate (at(self%n))
        allocate (resting(self%n), source=0)
        if (.not. allocated(self%d%equilibrium_formulas)) return
        do i = 1, self%n
            text = trim(self%d%equilibrium_formulas(i))
            if (index(text, "=") == 0) text = trim(self%d%coordinates(i)%name)//" = "//text
            call parse_equation(text, self%symbols, left, right, error)
            if (allocated(error)) call error%add_context(text)
            if (allocated(error)) return
            call solve_place(left, right, which, resting(i), place)
            call self%algebra%from_expression(right, at(i))
        end do
    end subroutine read_equilibrium

    subroutine linearise(self, at, resting, mass, gyroscopic, stiffness, of_position)
        !! With sums of the place in brackets, or multiplied out, whichever has fewer terms.
        type(derivation_t), intent(inout) :: self        !! with its equations
        type(polynomial_t), intent(in) :: at(:)          !! as `read_equilibrium` gives them
        integer, intent(in) :: resting(:)                 !! as well
        type(polynomial_t), allocatable, intent(out) :: mass(:, :), gyroscopic(:, :), &
                                                        stiffness(:, :)  !! (n, n)
        logical, intent(out) :: of_position              !! one of them depends on the place
        type(polynomial_t), allocatable :: m(:, :), g(:, :), k(:, :)
        type(polynomial_t) :: bracketed(size(at)), inverse
        integer :: i

        call linearise_at(self, at, resting, mass, gyroscopic, stiffness, of_position)
        if (all(at%terms < 2) .or. self%algebra%full) return
        do i = 1, size(at)
            bracketed(i) = at(i)
            if (at(i)%terms < 2) cycle
            call self%algebra%inverse(at(i), inverse)
            call self%algebra%inverse(inverse, bracketed(i))
        end do
        call linearise_at(self, bracketed, resting, m, g, k, of_position)
        if (sum(m%terms) + sum(g%terms) + sum(k%terms) >= &
            sum(mass%terms) + sum(gyroscopic%terms) + sum(stiffness%terms)) return
        call move_alloc(m, mass)
        call move_alloc(g, gyroscopic)
        call move_alloc(k, stiffness)
    end subroutine linearise

    subroutine linearise_at(self, at, resting, mass, gyroscopic, stiffness, of_position)
        !! First derivatives of the equations at rest, at a place.
        type(derivation_t), intent(inout) :: self
        type(polynomial_t), intent(in) :: at(:)
        integer, intent(in) :: resting(:)
        type(polynomial_t), allocatable, intent(out) :: mass(:, :), gyroscopic(:, :), &
                                                        stiffness(:, :)
        logical, intent(out) :: of_position
        integer :: i, k, m
        integer, allocatable :: moving(:)

        allocate (mass(self%n, self%n), gyroscopic(self%n, self%n), stiffness(self%n, self%n))
        allocate (moving, source=[(1 + i, i=1, 3*self%n)])
        of_position = .false.
        do i = 1, self%n
            do k = 1, self%n
                call at_rest(self%acceleration(k), mass(i, k))
                call at_rest(self%velocity(k), gyroscopic(i, k))
                call at_rest(self%coordinate(k), stiffness(i, k))
            end do
        end do
    contains
        subroutine at_rest(name, p)
            integer, intent(in) :: name
            type(polynomial_t), intent(out) :: p
            type(polynomial_t) :: all, still
            type(polynomial_t), allocatable :: zero(:)
            integer :: j

            allocate (zero(3*self%n))
            call self%algebra%derivative(self%equations(i), name, all)
            call self%algebra%substitute(all, moving(self%n + 1:), zero(self%n + 1:), still)
            do j = 1, self%n
                if (resting(j) > 0) call put_angle(self, self%coordinate(j), resting(j), at(j), &
                                                   still)
            end do
            call self%algebra%substitute(still, pack(moving(:self%n), resting == 0), &
                                         pack_plain(at, resting), p)
            do m = 1, self%algebra%count
                if (still%has(m)) of_position = of_position .or. &
                    self%algebra%uses(m, moving(:self%n))
            end do
            call shorten(self%algebra, p)
        end subroutine at_rest
    end subroutine linearise_at

    pure function pack_plain(at, resting) result(plain)
        !! Places that are given by themselves.
        type(polynomial_t), intent(in) :: at(:)
        integer, intent(in) :: resting(:)
        type(polynomial_t) :: plain(count(resting == 0))
        integer :: i, k

        k = 0
        do i = 1, size(at)
            if (resting(i) > 0) cycle
            k = k + 1
            plain(k) = at(i)
        end do
    end function pack_plain

    subroutine put_angle(self, name, function, value, p)
        !! The cosine (or sine) of an angle is `value`; of the other one, squares become
        !! \(1 - \) `value`\(^2\), and a single one stays.
        type(derivation_t), intent(inout) :: self
        integer, intent(in) :: name, function
        type(polynomial_t), intent(in) :: value
        type(polynomial_t), intent(inout) :: p
        type(polynomial_t) :: all, factor, one, other, term
        integer :: given, i, left, powers(most_atoms)

        call self%algebra%function_of(function, atom_power(name, 1), one)
        call self%algebra%function_of(f_cos + f_sin - function, atom_power(name, 1), other)
        given = findloc(one%power(:, 1), 1, 1)
        left = findloc(other%power(:, 1), 1, 1)
        do i = 1, p%terms
            powers = p%power(:, i)
            call self%algebra%raised(value, powers(given), factor)
            term = factor
            call self%algebra%raised(whole_polynomial(1) - value*value, &
                                     (powers(left) - modulo(powers(left), 2))/2, factor)
            term = term*factor
            powers(left) = modulo(powers(left), 2)
            powers(given) = 0
            all = all + term%shifted(p%coefficient(i), powers)
        end do
        p = all
    end subroutine put_angle
end module lagrangia_derivation_place
