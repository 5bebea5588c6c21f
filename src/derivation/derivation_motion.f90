module lagrangia_derivation_motion
    !! The equations of motion solved for the accelerations: one by one where they are not coupled,
    !! by Cramer's rule for two or three coordinates.
    use lagrangia_algebra, only: algebra_t
    use lagrangia_derivation, only: derivation_t, line_acceleration, line_mass, line_multiplier, &
                                    line_right_side
    use lagrangia_exact_number, only: operator(/), ratio
    use lagrangia_expression, only: expression_t
    use lagrangia_formula_latex, only: latex_name
    use lagrangia_formula_text, only: formula_text
    use lagrangia_kinds, only: i8
    use lagrangia_page_layout, only: lay_out, lay_out_fraction
    use lagrangia_polynomial, only: atom_power, most_atoms, operator(+), operator(-), &
                                    operator(*), polynomial_t
    use lagrangia_square_roots, only: square_roots
    use lagrangia_text, only: to_text
    use lagrangia_trigonometry, only: shorten
    implicit none (type, external)
    private
    public :: add_motion, determinant, lay_out_quotient

    integer, parameter :: most_solved = 3      !! coupled coordinates that are eliminated
    integer, parameter :: longest = 400        !! characters of a solved equation

contains

    subroutine add_motion(self)
        !! \(M\ddot q = f\), and \(\ddot q\).
        type(derivation_t), intent(inout) :: self  !! with its equations
        type(polynomial_t), allocatable :: mass(:, :), f(:)
        logical :: coupled, linear
        integer :: i, k

        self%next_heading = "solved for the accelerations"//trim(merge( &
            ", in flight", "           ", self%d%constraint == "unilateral"))
        allocate (mass(self%n, self%n), f(self%n))
        linear = .true.
        coupled = .false.
        do i = 1, self%n
            f(i) = -self%equations(i)
            do k = 1, self%n
                call self%algebra%derivative(self%equations(i), self%acceleration(k), mass(i, k))
                f(i) = f(i) + mass(i, k)*atom_power(self%acceleration(k), 1)
                coupled = coupled .or. (i /= k .and. mass(i, k)%terms > 0)
            end do
        end do
        do i = 1, self%n
            do k = 1, self%n
                if (f(i)%has(self%acceleration(k))) linear = .false.
            end do
        end do
        if (.not. linear) then
            call self%add_words("not linear in the accelerations")
        else if (any([(mass(i, i)%terms == 0, i=1, self%n)]) .and. .not. coupled) then
            call self%add_words("an acceleration is not determined")
        else if (self%constraints > 0) then
            call solve_constrained(self, mass, f, coupled)
        else if (.not. coupled) then
            do i = 1, self%n
                call add_quotient(self, line_acceleration, i, f(i), mass(i, i))
            end do
        else
            call add_matrix(self, mass, f)
            if (self%n <= most_solved) call solve_coupled(self, mass, f)
        end if
    end subroutine add_motion

    subroutine add_matrix(self, mass, f)
        !! The elements of M and f.
        type(derivation_t), intent(inout) :: self
        type(polynomial_t), intent(in) :: mass(:, :), f(:)
        integer :: i, k

        call self%add_words("M q_ddot = f with", "$M \ddot{q} = f$ with")
        do i = 1, self%n
            do k = 1, self%n
                if (k < i .and. is_symmetric(mass)) cycle
                call self%add(line_mass, "M"//to_text(i)//to_text(k), &
                              "M_{"//to_text(i)//to_text(k)//"}", mass(i, k), i, k)
            end do
        end do
        do i = 1, self%n
            call self%add(line_right_side, "f"//to_text(i), "f_{"//to_text(i)//"}", f(i), i)
        end do
    end subroutine add_matrix

    pure function is_symmetric(mass) result(yes)
        !! As it is without a slip.
        type(polynomial_t), intent(in) :: mass(:, :)
        logical :: yes
        type(polynomial_t) :: difference
        integer :: i, k

        yes = .true.
        do i = 1, size(mass, 1)
            do k = 1, i - 1
                difference = mass(i, k) - mass(k, i)
                yes = yes .and. difference%terms == 0
            end do
        end do
    end function is_symmetric

    subroutine solve_coupled(self, mass, f)
        !! Cramer's rule.
        type(derivation_t), intent(inout) :: self
        type(polynomial_t), intent(in) :: mass(:, :), f(:)
        type(polynomial_t), allocatable :: columns(:, :)
        type(polynomial_t) :: above, below
        integer :: i, k

        allocate (columns(self%n, self%n))
        call determinant(mass, below)
        if (below%terms == 0) then
            call self%add_words("det M = 0: the accelerations are not determined", &
                                "$\det M = 0$: the accelerations are not determined")
            return
        end if
        do k = 1, self%n
            do i = 1, self%n
                columns(i, :) = mass(i, :)
                columns(i, k) = f(i)
            end do
            call determinant(columns, above)
            call add_quotient(self, line_acceleration, k, above, below)
        end do
    end subroutine solve_coupled

    subroutine solve_constrained(self, mass, f, coupled)
        !! With multipliers: \(\ddot q_i = f_i/M_{ii}\), which contains them, in the time
        !! derivatives of the constraints.
        type(derivation_t), intent(inout) :: self
        type(polynomial_t), intent(in) :: mass(:, :), f(:)
        logical, intent(in) :: coupled
        type(polynomial_t), allocatable :: columns(:, :), rows(:, :), known(:), forces(:)
        type(polynomial_t) :: above, below, inverse, one(1), rate
        integer :: i, k, m, l

        m = self%constraints
        if (coupled .or. m > most_solved .or. any([(mass(i, i)%terms /= 1, i=1, self%n)])) then
            call add_matrix(self, mass, f)
            return
        end if
        allocate (rows(m, m), known(m), columns(m, m), forces(self%n))
        do k = 1, m
            call self%total_derivative(self%constrained(k), rate)
            do i = 1, self%n
                call self%algebra%inverse(mass(i, i), inverse)
                one(1) = f(i)*inverse
                call self%algebra%substitute(rate, [self%acceleration(i)], one, above)
                rate = above
            end do
            do l = 1, m
                call self%algebra%derivative(rate, self%multiplier(l), rows(k, l))
                rate = rate - rows(k, l)*atom_power(self%multiplier(l), 1)
            end do
            known(k) = -rate
        end do
        call self%add_words("M q_ddot = f, put into the time derivatives of the constraints, "// &
                            "gives the multipliers", "$M \ddot{q} = f$, put into the time "// &
                            "derivatives of the constraints, gives the multipliers")
        call determinant(rows, below)
        call shorten(self%algebra, below)
        forces = f
        do l = 1, m
            columns = rows
            columns(:, l) = known
            call determinant(columns, above)
            call shorten(self%algebra, above)
            call add_quotient(self, line_multiplier, l, above, below)
            do i = 1, self%n
                call self%algebra%derivative(f(i), self%multiplier(l), one(1))
                forces(i) = forces(i) - one(1)*atom_power(self%multiplier(l), 1)
            end do
        end do
        do i = 1, self%n
            one(1) = forces(i)*below
            do l = 1, m
                columns = rows
                columns(:, l) = known
                call determinant(columns, above)
                call self%algebra%derivative(f(i), self%multiplier(l), rate)
                one(1) = one(1) + rate*above
            end do
            call add_quotient(self, line_acceleration, i, one(1), mass(i, i)*below)
        end do
    end subroutine solve_constrained

    subroutine add_quotient(self, kind, i, above, below)
        !! An acceleration or a multiplier.
        type(derivation_t), intent(inout) :: self
        integer, intent(in) :: kind, i
        type(polynomial_t), intent(in) :: above, below
        type(expression_t) :: e
        character(:), allocatable :: left, tex

        call lay_out_quotient(self%algebra, self%roles, above, below, e)
        if (kind == line_acceleration) then
            left = trim(self%d%coordinates(i)%name)//"_ddot"
            tex = latex_name(left)
        else
            left = trim(self%symbols%names(self%multiplier(i)))
            tex = latex_name(left)
        end if
        if (len(formula_text(e, self%symbols)) > longest) then
            call self%add_words(left//" takes more than "//to_text(longest)//" characters", &
                                "$"//tex//"$ takes more than "//to_text(longest)//" characters")
        else
            call self%add(kind, left, tex, above, i, e=e)
        end if
    end subroutine add_quotient

    subroutine lay_out_quotient(algebra, roles, above, below, e)
        !! Both parts shortened, without fractions in fractions; term by term where one of them
        !! has no denominator then, `g/r - omega^2`.
        type(algebra_t), intent(inout) :: algebra      !! of the atoms
        integer, intent(in) :: roles(:)                !! of the names
        type(polynomial_t), intent(in) :: above, below  !! the latter not zero
        type(expression_t), intent(out) :: e           !! their quotient
        type(polynomial_t) :: numerator, denominator, quotient
        integer :: k, powers(most_atoms)

        numerator = above
        denominator = below
        call shorten(algebra, numerator)
        call shorten(algebra, denominator)
        powers = 0
        if (numerator%terms > 0) then
            do k = 1, algebra%count
                associate (over => minval(numerator%power(k, :numerator%terms)), &
                           under => minval(denominator%power(k, :denominator%terms)))
                    if (over < 0 .and. under < 0) powers(k) = -min(over, under)
                end associate
            end do
        end if
        numerator = numerator%shifted(ratio(1_i8, 1_i8), powers)
        denominator = denominator%shifted(ratio(1_i8, 1_i8), powers)
        call square_roots(algebra, numerator)
        call square_roots(algebra, denominator)
        if (denominator%terms == 1 .and. numerator%terms > 0) then
            quotient = numerator%shifted(ratio(1_i8, 1_i8)/denominator%coefficient(1), &
                                         -denominator%power(:, 1))
            if (any(minval(quotient%power(:, :quotient%terms), 1) >= 0)) then
                call lay_out(algebra, roles, quotient, e)
                return
            end if
        end if
        call lay_out_fraction(algebra, roles, numerator, denominator, e)
    end subroutine lay_out_quotient

    recursive subroutine determinant(matrix, p)
        !! By expansion along the first row.
        type(polynomial_t), intent(in) :: matrix(:, :)  !! (n, n), n small
        type(polynomial_t), intent(out) :: p            !! multiplied out
        type(polynomial_t), allocatable :: minor(:, :)
        type(polynomial_t) :: one
        integer :: i, k, n

        n = size(matrix, 1)
        if (n == 1) then
            p = matrix(1, 1)
            return
        end if
        allocate (minor(n - 1, n - 1))
        do k = 1, n
            if (matrix(1, k)%terms == 0) cycle
            do i = 1, k - 1
                minor(:, i) = matrix(2:, i)
            end do
            do i = k + 1, n
                minor(:, i - 1) = matrix(2:, i)
            end do
            call determinant(minor, one)
            one = matrix(1, k)*one
            if (mod(k, 2) == 0) one = -one
            p = p + one
        end do
    end subroutine determinant
end module lagrangia_derivation_motion
