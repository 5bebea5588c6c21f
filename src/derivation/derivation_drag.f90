module lagrangia_derivation_drag
    !! What drag makes of small oscillations: decay rate and frequency of one coordinate, the
    !! polynomial whose roots are the rates of several.
    use lagrangia_common_factor, only: divide_by_common
    use lagrangia_derivation, only: derivation_t, line_damped_omega2, line_decay, line_rates
    use lagrangia_derivation_motion, only: determinant, lay_out_quotient
    use lagrangia_exact_number, only: ratio
    use lagrangia_expression, only: apply, expression_t, f_sqrt, operator(**), operator(+), &
                                    operator(-), operator(/)
    use lagrangia_formula_latex, only: latex_name
    use lagrangia_kinds, only: dp, i8
    use lagrangia_polynomial, only: atom_power, most_atoms, operator(+), operator(-), &
                                    operator(*), polynomial_t, whole_polynomial
    use lagrangia_text, only: to_text
    use lagrangia_trigonometry, only: shorten
    implicit none (type, external)
    private
    public :: add_polynomial, add_rates, collect_powers

    integer, parameter :: most_expanded = 3  !! coordinates whose polynomial is shown

contains

    subroutine add_rates(self, letter, mass, drag, stiffness, lambda)
        !! Of \(M\ddot q + C\dot q + Kq = 0\): with one coordinate \(\gamma = C/(2M)\) and
        !! \(\omega^2 = K/M - \gamma^2\), whose sign decides what q is; with more
        !! \(\det(\lambda^2M + \lambda C + K) = 0\).
        type(derivation_t), intent(inout) :: self                      !! gets the lines
        character, intent(in) :: letter  !! `C`, or `B` with gyroscopic forces in it
        type(polynomial_t), intent(in) :: mass(:, :), drag(:, :), stiffness(:, :)  !! (n, n)
        complex(dp), intent(in) :: lambda(:)  !! 1/s, as `damped_rates` has them; (0): unknown
        type(polynomial_t), allocatable :: matrix(:, :), c(:)
        type(polynomial_t) :: p
        character(:), allocatable :: rest
        integer :: i, k

        if (self%n == 1) then
            call add_one(self, mass(1, 1), drag(1, 1), stiffness(1, 1), lambda)
            return
        end if
        if (self%n > most_expanded) then
            rest = " is not written out for more than "//to_text(most_expanded)//" coordinates"
            call self%add_words("det("//name()//"^2 M + "//name()//" "//letter//" + K)"//rest, &
                                "$\det("//tex()//"^2 M + "//tex()//" "//letter//" + K)$"//rest)
            return
        end if
        allocate (matrix(self%n, self%n))
        do i = 1, self%n
            do k = 1, self%n
                matrix(i, k) = stiffness(i, k) + drag(i, k)*atom_power(self%rate(), 1) &
                               + mass(i, k)*atom_power(self%rate(), 2)
            end do
        end do
        call determinant(matrix, p)
        allocate (c(2*self%n + 1))
        call collect_powers(self, p, self%rate(), 1, c)
        call self%add_words("q goes as exp("//name()//" t): det("//name()//"^2 M + "//name()// &
                            " "//letter//" + K) = 0", "$q$ goes as $e^{"//tex()//" t}$: $\det("// &
                            tex()//"^2 M + "//tex()//" "//letter//" + K) = 0$")
        call add_polynomial(self, line_rates, self%rate(), 1, c)
    contains
        function name() result(text)
            character(:), allocatable :: text

            text = trim(self%symbols%names(self%rate()))
        end function name

        function tex() result(text)
            character(:), allocatable :: text

            text = latex_name(name())
        end function tex
    end subroutine add_rates

    subroutine add_one(self, mass, drag, stiffness, lambda)
        !! \(\gamma\), \(\omega^2\), and what q is at the given parameters: \(e^{-\gamma t}
        !! \cos\omega t\) where \(\omega^2 > 0\), \((A + Bt)e^{-\gamma t}\) where it is zero,
        !! else the sum of two exponentials of the rates
        !! \(\gamma_{1,2} = \gamma\mp\sqrt{\gamma^2 - K/M}\), that which cancels as
        !! \(\gamma_1 = (K/M)/\gamma_2\).
        type(derivation_t), intent(inout) :: self
        type(polynomial_t), intent(in) :: mass, drag, stiffness
        complex(dp), intent(in) :: lambda(:)
        type(expression_t) :: free, rate, root
        character(:), allocatable :: case_of, name, letter, tex
        logical :: decays, two_rates

        name = trim(self%symbols%names(self%omega()))
        letter = "gamma"
        if (any([self%symbols%find(letter), self%symbols%find(letter//"_1"), &
                 self%symbols%find(letter//"_2")] > 0)) letter = "Gamma"
        tex = latex_name(letter)
        call lay_out_quotient(self%algebra, self%roles, drag, whole_polynomial(2)*mass, rate)
        call lay_out_quotient(self%algebra, self%roles, stiffness, mass, free)
        decays = .false.
        if (drag%terms > 0 .and. size(lambda) > 0) decays = all(real(lambda) < 0.0_dp)
        two_rates = .false.
        if (size(lambda) == 2) two_rates = abs(lambda(1) - lambda(2)) > 0.0_dp
        if (two_rates) then
            case_of = "^2 < 0 at these parameters"// &
                      trim(merge(", overdamped", "            ", decays))
            call self%add_words("q goes as A exp(-"//letter//"_1 t) + B exp(-"//letter// &
                                "_2 t): "//name//case_of, "$q$ goes as $A e^{-"//tex//"_1 t} "// &
                                "+ B e^{-"//tex//"_2 t}$: $"//latex_name(name)//"^2 < 0$"// &
                                case_of(7:))
        else if (size(lambda) == 2) then
            case_of = "^2 = 0 at these parameters"// &
                      trim(merge(", critically damped", "                   ", decays))
            call self%add_words("q goes as (A + B t) exp(-"//letter//" t): "//name//case_of, &
                                "$q$ goes as $(A + B t) e^{-"//tex//" t}$: $"// &
                                latex_name(name)//"^2 = 0$"//case_of(7:))
        else
            case_of = "^2 > 0 at these parameters"// &
                      trim(merge(", underdamped", "             ", decays))
            if (size(lambda) == 0) case_of = "^2 > 0"
            call self%add_words("q goes as exp(-"//letter//" t) cos("//name//" t): "//name// &
                                case_of, "$q$ goes as $e^{-"//tex//" t} \cos("// &
                                latex_name(name)//" t)$: $"//latex_name(name)//"^2 > 0$"// &
                                case_of(7:))
        end if
        call self%add(line_decay, letter, tex, drag, e=rate)
        if (drag%terms > 0) free = free - rate**2
        call self%add(line_damped_omega2, name//"^2", "\"//name//"^2", stiffness, e=free)
        if (.not. two_rates) return
        if (stiffness%terms == 0) then
            call self%add(line_decay, letter//"_1", tex//"_1", stiffness, 1)
            call lay_out_quotient(self%algebra, self%roles, drag, mass, rate)
            call self%add(line_decay, letter//"_2", tex//"_2", drag, 2, e=rate)
            return
        end if
        call lay_out_quotient(self%algebra, self%roles, -stiffness, mass, root)
        if (drag%terms > 0 .and. stiffness%coefficient(1)%value < 0.0_dp) then
            root = rate**2 + root
        else if (drag%terms > 0) then
            call lay_out_quotient(self%algebra, self%roles, stiffness, mass, free)
            root = rate**2 - free
        end if
        root = apply(f_sqrt, root)
        if (drag%terms == 0) then
            call self%add(line_decay, letter//"_1", tex//"_1", drag, 1, e=-root)
            call self%add(line_decay, letter//"_2", tex//"_2", drag, 2, e=root)
            return
        end if
        ! the rate that would be the difference is (K/M) over the other one
        call lay_out_quotient(self%algebra, self%roles, stiffness, mass, free)
        if (sum(real(lambda)) < 0.0_dp) then
            call self%add(line_decay, letter//"_1", tex//"_1", drag, 1, e=free/(rate + root))
            call self%add(line_decay, letter//"_2", tex//"_2", drag, 2, e=rate + root)
        else
            call self%add(line_decay, letter//"_1", tex//"_1", drag, 1, e=rate - root)
            call self%add(line_decay, letter//"_2", tex//"_2", drag, 2, e=free/(rate - root))
        end if
    end subroutine add_one

    subroutine collect_powers(self, p, name, step, c)
        !! The coefficients of \(1, x^\mathrm{step}, x^{2\,\mathrm{step}}, \ldots\)
        type(derivation_t), intent(inout) :: self      !! its identities shorten them
        type(polynomial_t), intent(in) :: p            !! of these powers
        integer, intent(in) :: name, step              !! the symbol x; from one power to the next
        type(polynomial_t), intent(inout) :: c(:)      !! zero before
        integer :: at, i, powers(most_atoms)

        do i = 1, p%terms
            powers = p%power(:, i)
            at = 1 + powers(name)/step
            powers(name) = 0
            call c(at)%add_term(p%coefficient(i), powers)
        end do
        do i = 1, size(c)
            call shorten(self%algebra, c(i))
        end do
    end subroutine collect_powers

    subroutine add_polynomial(self, kind, name, step, c)
        !! \(\sum_k c_k x^{k\,\mathrm{step}} = 0\), without common factors and denominators.
        type(derivation_t), intent(inout) :: self  !! gets the line
        integer, intent(in) :: kind                !! of the line
        integer, intent(in) :: name, step          !! the symbol x; from one power to the next
        type(polynomial_t), intent(in) :: c(:)     !! the coefficients
        type(polynomial_t) :: divided, factor, p
        logical :: stays(most_atoms)
        integer :: k, powers(most_atoms)

        do k = 1, size(c)
            p = p + c(k)*atom_power(name, step*(k - 1))
        end do
        stays = .false.
        stays(name) = .true.
        call divide_by_common(p, stays, divided, factor)
        powers = 0  ! of denominators, by which all is multiplied
        do k = 1, self%algebra%count
            if (k /= name) powers(k) = min(0, minval(divided%power(k, :divided%terms)))
        end do
        divided = divided%shifted(ratio(1_i8, 1_i8), -powers)
        associate (highest => c(size(c)))
            if (highest%terms > 0) then
                if (highest%coefficient(1)%value < 0.0_dp) divided = -divided
            end if
        end associate
        call self%add(kind, "", "", divided)
    end subroutine add_polynomial
end module lagrangia_derivation_drag
