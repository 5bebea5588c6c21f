module lagrangia_derivation_modes
    !! The equations of motion linearised about the equilibrium at zero, and the frequencies that
    !! follow, beside LAPACK's numbers.
    use lagrangia_derivation, only: derivation_t, line_characteristic, line_gyroscopic, &
                                    line_omega2, line_rest_mass, line_stiffness
    use lagrangia_derivation_motion, only: determinant, lay_out_quotient
    use lagrangia_errors, only: error_t
    use lagrangia_exact_number, only: number_t, operator(-), operator(/), ratio
    use lagrangia_expression, only: apply, expression_t, f_sqrt, operator(+), operator(-), &
                                    operator(*), operator(**)
    use lagrangia_kinds, only: dp, i8
    use lagrangia_page_layout, only: lay_out, lay_out_factors, lay_out_fraction
    use lagrangia_polynomial, only: atom_power, most_atoms, operator(+), operator(-), &
                                    operator(*), polynomial_t, whole_polynomial
    use lagrangia_small_oscillations, only: find_modes, modes_t
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
        type(modes_t) :: modes
        type(error_t), allocatable :: error
        type(polynomial_t), allocatable :: mass(:, :), gyroscopic(:, :), stiffness(:, :)
        character(:), allocatable :: turning, where_at
        logical :: of_position, away
        integer :: i

        self%next_heading = "small oscillations"
        if (system%nonconservative) then
            call self%add_words("not linearised: there are forces beside L")
            return
        end if
        call find_modes(system, [real(dp) :: spread(0.0_dp, 1, self%n)], .false., modes, error)
        if (allocated(error)) then
            call self%add_words("none: "//error%message)
            return
        end if
        call linearise(self, mass, gyroscopic, stiffness, of_position)
        away = any(abs(modes%at) > 0.0_dp)
        if (away .and. of_position) then
            call self%add_words("the equilibrium is not at zero: 'lagrangia modes' has the numbers")
            return
        end if
        turning = "M q_ddot + K q"
        if (any_terms(gyroscopic)) turning = "M q_ddot + G q_dot + K q"
        if (.not. away) then
            where_at = ""
            do i = 1, self%n
                where_at = where_at//", "//trim(self%d%coordinates(i)%name)//" = 0"
            end do
            where_at = "about"//where_at(2:)//": "
            call self%add_words(where_at//turning//" = 0 with")
        end if
        if (away) call self%add_words("about the equilibrium: "//turning//" = 0 with")
        call add_elements(self, line_rest_mass, "M", mass)
        call add_elements(self, line_gyroscopic, "G", gyroscopic)
        call add_elements(self, line_stiffness, "K", stiffness)
        call add_roots(self, mass, gyroscopic, stiffness)
    end subroutine add_modes

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

    subroutine linearise(self, mass, gyroscopic, stiffness, of_position)
        !! First derivatives of the equations at rest, at zero.
        type(derivation_t), intent(inout) :: self
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

            allocate (zero(3*self%n))
            call self%algebra%derivative(self%equations(i), name, all)
            call self%algebra%substitute(all, moving(self%n + 1:), zero(self%n + 1:), still)
            call self%algebra%substitute(still, moving(:self%n), zero(:self%n), p)
            do m = 1, self%algebra%count
                if (still%has(m)) of_position = of_position .or. &
                    self%algebra%uses(m, moving(:self%n))
            end do
            call shorten(self%algebra, p)
        end subroutine at_rest
    end subroutine linearise

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
        integer :: i, k

        if (all_diagonal()) then
            do i = 1, self%n
                call add_root(stiffness(i, i), mass(i, i), i)
            end do
            return
        end if
        if (self%n > most_expanded) then
            call self%add_words("det(K - "//name()//"^2 M) is not written out for more than "// &
                                to_text(most_expanded)//" coordinates")
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
        if (self%n == 2 .and. c(1)%terms == 0 .and. c(3)%terms > 0) then
            call add_root(zero, c(3), 1)
            call add_root(-c(2), c(3), 2)
        else if (self%n == 2 .and. c(3)%terms > 0) then
            call add_pair(self, c)
        else
            call add_polynomial(self, c)
        end if
    contains
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
        integer :: at, i, powers(most_atoms), turns

        allocate (c(self%n + 1))
        do i = 1, p%terms
            powers = p%power(:, i)
            turns = powers(self%power_of_i())
            if (mod(turns, 2) /= 0) cycle  ! these cancel, as G is antisymmetric
            at = 1 + powers(self%omega())/2 + turns/2
            powers([self%omega(), self%power_of_i()]) = 0
            if (mod(turns/2, 2) == 0) then
                call c(at)%add_term(p%coefficient(i), powers)
            else
                call c(at)%add_term(-p%coefficient(i), powers)
            end if
        end do
        do i = 1, self%n + 1
            call shorten(self%algebra, c(i))
        end do
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

    subroutine add_polynomial(self, c)
        !! \(\sum_k c_k\,\omega^{2k} = 0\).
        type(derivation_t), intent(inout) :: self
        type(polynomial_t), intent(in) :: c(:)
        type(polynomial_t) :: p
        type(number_t) :: coefficient
        integer :: k, powers(most_atoms)

        do k = 1, size(c)
            p = p + c(k)*atom_power(self%omega(), 2*k - 2)
        end do
        call p%common(coefficient, powers)
        if (c(size(c))%terms > 0) then
            if (c(size(c))%coefficient(1)%value*coefficient%value < 0.0_dp) then
                coefficient = -coefficient
            end if
        end if
        powers(self%omega()) = 0
        do k = 1, self%algebra%count
            powers(k) = min(powers(k), minval(p%power(k, :p%terms)))
        end do
        p = p%shifted(ratio(1_i8, 1_i8)/coefficient, -powers)
        call self%add(line_characteristic, "", "", p)
    end subroutine add_polynomial
end module lagrangia_derivation_modes
