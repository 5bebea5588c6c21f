module lagrangia_derivation_rest
    !! The lines of a derivation about the equilibrium as two numbers: what the program computes,
    !! by automatic derivatives and LAPACK, and what the formula gives.
    use lagrangia_damped_rates, only: damped_rates, damping_matrix
    use lagrangia_derivation, only: derivation_t, line_damped_omega2, line_decay, &
                                    line_equilibrium, line_gyroscopic, line_linear, line_omega2, &
                                    line_rates, line_rest_mass, line_stiffness, line_t
    use lagrangia_description, only: description_t, sizes_of_places
    use lagrangia_equilibrium, only: stiffness_beside
    use lagrangia_errors, only: error_t
    use lagrangia_expression, only: expression_t, function_value, kind_negation, kind_power, &
                                    kind_symbol
    use lagrangia_formula_size, only: evaluate
    use lagrangia_kinds, only: dp
    use lagrangia_number_class, only: is_zero
    use lagrangia_small_oscillations, only: modes_t
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: comparison_t
    public :: compare_modes

    type :: comparison_t
        !! Of one line.
        logical :: known = .false.       !! the program has this number, too
        real(dp) :: program = 0.0_dp     !! what it computes
        real(dp) :: formula = 0.0_dp     !! what the line says
        real(dp) :: noise = 0.0_dp       !! that rounding may make of the difference
    contains
        procedure :: agrees
    end type comparison_t

contains

    elemental function agrees(self) result(yes)
        !! Are both numbers equal, to rounding?
        class(comparison_t), intent(in) :: self
        logical :: yes

        yes = abs(self%program - self%formula) <= self%noise .or. .not. self%known
    end function agrees

    subroutine compare_modes(derivation, system, modes, at_rest, line, c)
        !! A line about the equilibrium.
        type(derivation_t), intent(in) :: derivation     !! of the system
        class(system_t), intent(in) :: system            !! configured
        type(modes_t), intent(in) :: modes               !! about its equilibrium
        real(dp), intent(in) :: at_rest(:)
        !! values of the names there; of a linearised equation those of any displacement
        type(line_t), intent(in) :: line                 !! `line_rest_mass` to `line_linear`
        type(comparison_t), intent(out) :: c             !! both numbers
        type(description_t) :: d
        real(dp), dimension(size(modes%at), size(modes%at)) :: beside
        real(dp), allocatable :: values(:)
        complex(dp), allocatable :: lambda(:)
        real(dp) :: usual(size(modes%at)), noise, value, gamma, omega2
        integer :: k

        allocate (values, source=at_rest)
        call evaluate(line%right, values, c%formula, c%noise)
        c%known = .true.
        select case (line%kind)
        case (line_rest_mass)
            c%program = modes%mass(line%i, line%k)
        case (line_stiffness)
            call stiffness_beside(system, modes%at, beside)
            c%program = modes%stiffness(line%i, line%k) + beside(line%i, line%k)
        case (line_gyroscopic)
            call damping_matrix(system, modes%at, beside)
            c%program = modes%gyroscopic(line%i, line%k) + beside(line%i, line%k)
        case (line_equilibrium)
            call system%describe(d)
            usual = sizes_of_places(d)
            noise = max(usual(line%i), abs(modes%at(line%i)))
            c%program = modes%at(line%i)
            if (line%k > 0) then
                c%program = function_value(line%k, c%program)
                noise = max(1.0_dp, abs(c%program))
            end if
            c%noise = c%noise + 256.0_dp*epsilon(1.0_dp)*noise
        case (line_decay, line_damped_omega2)
            call one_rate(system, modes, gamma, omega2, lambda, c%known)
            if (.not. c%known) return
            if (line%i > 0) then
                call compare_exponential(-real(lambda), line, c)
                return
            end if
            c%program = merge(gamma, omega2, line%kind == line_decay)
            noise = max(maxval(abs(modes%omega2)), abs(omega2)) + gamma**2
            if (line%kind == line_decay) noise = sqrt(noise)
            c%noise = c%noise + 256.0_dp*epsilon(1.0_dp)*noise
        case (line_linear)
            call compare_linear(derivation, system, modes, values, line, c)
        case (line_rates)
            call compare_rates(derivation, system, modes, values, line, c)
            return
        case (line_omega2)
            c%known = .not. any(modes%turning > 0.0_dp)  ! else it is complex
            if (.not. c%known) return
            c%program = paired(derivation, values, modes%omega2, line)
            c%noise = c%noise + root_noise(modes, c%program)
        case default
            c%noise = huge(c%noise)
            c%formula = 0.0_dp
            do k = 1, size(modes%omega2)
                if (modes%turning(k) > 0.0_dp) cycle
                values(derivation%omega()) = sqrt(abs(modes%omega2(k)))
                if (modes%omega2(k) < 0.0_dp) then
                    call evaluate(imaginary(line%right, derivation%omega()), values, value, noise)
                else
                    call evaluate(line%right, values, value, noise)
                end if
                noise = 64.0_dp*noise*max(1.0_dp, terms_of_one(modes, k))
                if (abs(value)*c%noise < abs(c%formula)*noise) cycle
                c%formula = value
                c%noise = noise
            end do
        end select
        c%noise = c%noise + 64.0_dp*epsilon(1.0_dp)*abs(c%program)
    end subroutine compare_modes

    pure subroutine compare_exponential(rates, line, c)
        !! Of two exponentials the slower (1) or the faster (2) rate as LAPACK has it. Rounding of
        !! \(\omega^2\), as of its own line, moves both relative to their size by that over
        !! their distance times the larger.
        real(dp), intent(in) :: rates(:)  !! \(-\lambda\), 1/s
        type(line_t), intent(in) :: line
        type(comparison_t), intent(inout) :: c
        real(dp) :: distance, largest, relative

        c%program = merge(minval(rates), maxval(rates), line%i == 1)
        largest = maxval(abs(rates))
        distance = maxval(rates) - minval(rates)
        relative = 512.0_dp*epsilon(1.0_dp)*largest/max(distance, tiny(distance))
        c%noise = c%noise + min(relative, 1.0_dp)*abs(c%program)
    end subroutine compare_exponential

    pure function imaginary(polynomial, omega) result(turned)
        !! A polynomial of \(\omega^2\) with \(i\omega\) for \(\omega\): \((i\omega)^m =
        !! (-1)^{m/2}\omega^m\).
        type(expression_t), intent(in) :: polynomial
        integer, intent(in) :: omega  !! which symbol
        type(expression_t) :: turned
        integer :: place(0:polynomial%count), i, node

        place(0) = 0
        do i = 1, polynomial%count
            associate (this => polynomial%nodes(i))
                call turned%add_copy(polynomial, i, place)
                if (this%kind /= kind_power) cycle
                associate (base => polynomial%nodes(this%left), m => polynomial%nodes(this%right))
                    if (base%kind /= kind_symbol .or. base%which /= omega) cycle
                    if (mod(nint(m%number%value), 4) /= 2) cycle
                end associate
                call turned%add_operation(kind_negation, place(i), 0, node)
                place(i) = node
            end associate
        end do
    end function imaginary

    subroutine compare_linear(derivation, system, modes, values, line, c)
        !! Row i of \(M\ddot q + (G + C)\dot q + Kq\), less as much of row k as takes
        !! \(\ddot q_k\) away, over the factor that the line does without.
        type(derivation_t), intent(in) :: derivation
        class(system_t), intent(in) :: system
        type(modes_t), intent(in) :: modes
        real(dp), intent(in) :: values(:)
        type(line_t), intent(in) :: line
        type(comparison_t), intent(inout) :: c
        real(dp), dimension(size(modes%at), size(modes%at)) :: drag, springs
        real(dp), dimension(size(modes%at)) :: row, large
        real(dp) :: factor, noise
        integer :: n

        n = size(modes%at)
        call damping_matrix(system, modes%at, drag)
        call stiffness_beside(system, modes%at, springs)
        drag = drag + modes%gyroscopic
        springs = springs + modes%stiffness
        associate (q => values(derivation%coordinate(1):derivation%coordinate(n)), &
                   v => values(derivation%velocity(1):derivation%velocity(n)), &
                   a => values(derivation%acceleration(1):derivation%acceleration(n)))
            row = matmul(modes%mass, a) + matmul(drag, v) + matmul(springs, q)
            large = matmul(abs(modes%mass), abs(a)) + matmul(abs(drag), abs(v)) &
                    + matmul(abs(springs), abs(q))
        end associate
        call evaluate(line%factor, values, factor, noise)
        c%program = row(line%i)
        noise = large(line%i)
        if (line%k > 0) then
            associate (m => modes%mass)
                c%program = m(line%k, line%k)*row(line%i) - m(line%i, line%k)*row(line%k)
                noise = abs(m(line%k, line%k))*large(line%i) + abs(m(line%i, line%k))*large(line%k)
            end associate
        end if
        c%program = c%program/factor
        c%noise = c%noise + 64.0_dp*epsilon(1.0_dp)*noise/abs(factor)
    end subroutine compare_linear

    pure function root_noise(modes, omega2) result(noise)
        !! Of LAPACK's root: some epsilon of the largest; with \(G\), where the matrix is not
        !! symmetric, more by largest over distance where another root is near, and a root of that
        !! where both are one. Where inertias nearly cancel, some epsilon of the terms of
        !! \(\omega^2u^\dagger Mu\).
        type(modes_t), intent(in) :: modes
        real(dp), intent(in) :: omega2  !! which root
        real(dp) :: noise
        real(dp), parameter :: rounding = 256.0_dp*epsilon(1.0_dp)
        real(dp) :: largest, distance
        integer :: i, j

        i = minloc(abs(modes%omega2 - omega2), 1)
        largest = maxval(abs(modes%omega2))
        noise = rounding*max(largest, abs(omega2)*terms_of_one(modes, i))
        if (all(is_zero(modes%gyroscopic)) .or. size(modes%omega2) == 1) return
        distance = minval(abs(modes%omega2 - omega2), [(j /= i, j=1, size(modes%omega2))])
        noise = noise*largest/max(distance, sqrt(rounding)*largest)
    end function root_noise

    pure function terms_of_one(modes, j) result(sizes)
        !! The sum of the sizes of the terms of \(u^\dagger Mu = 1\): some 1 of well-conditioned M.
        type(modes_t), intent(in) :: modes  !! solved
        integer, intent(in) :: j            !! which
        real(dp) :: sizes
        real(dp) :: u(size(modes%at))
        integer :: k

        u = abs(modes%shapes(:, j))
        if (allocated(modes%quadrature)) u = hypot(u, modes%quadrature(:, j))
        sizes = 0.0_dp
        do k = 1, size(u)
            sizes = sizes + u(k)*dot_product(abs(modes%mass(:, k)), u)
        end do
    end function terms_of_one

    pure function cancellation(modes) result(ratio)
        !! The most of these of all modes.
        type(modes_t), intent(in) :: modes  !! solved
        real(dp) :: ratio
        integer :: j

        ratio = maxval([1.0_dp, (terms_of_one(modes, j), j=1, size(modes%omega2))])
    end function cancellation

    function paired(derivation, values, omega2, line) result(value)
        !! That of LAPACK's which belongs to the line: the formulas' and LAPACK's which differ least
        !! are a pair, then of those that are left.
        type(derivation_t), intent(in) :: derivation
        real(dp), intent(in) :: values(:), omega2(:)
        type(line_t), intent(in) :: line
        real(dp) :: value
        real(dp), allocatable :: distances(:, :)  !! of LAPACK's and each line
        real(dp) :: formula, noise
        integer, allocatable :: roots(:)          !! which root a line is
        integer :: k, nearest(2)

        allocate (distances(size(omega2), 0), roots(0))
        do k = 1, derivation%count
            associate (a => derivation%lines(k))
                if (a%kind /= line_omega2 .or. (a%elsewhere .neqv. line%elsewhere)) cycle
                call evaluate(a%right, values, formula, noise)
                distances = reshape([distances, abs(omega2 - formula)], &
                                    [size(omega2), size(roots) + 1])
                roots = [roots, a%i]
            end associate
        end do
        do k = 1, size(roots)
            nearest = minloc(distances)
            value = omega2(nearest(1))
            if (roots(nearest(2)) == line%i) return
            distances(nearest(1), :) = huge(value)
            distances(:, nearest(2)) = huge(value)
        end do
    end function paired

    subroutine one_rate(system, modes, gamma, omega2, lambda, known)
        !! Of one coordinate, from LAPACK's \(\lambda = -\gamma\pm i\omega\).
        class(system_t), intent(in) :: system
        type(modes_t), intent(in) :: modes
        real(dp), intent(out) :: gamma, omega2
        complex(dp), allocatable, intent(out) :: lambda(:)
        logical, intent(out) :: known
        type(error_t), allocatable :: error

        gamma = 0.0_dp
        omega2 = 0.0_dp
        call damped_rates(system, modes, lambda, error)
        known = .not. allocated(error)
        if (.not. known) return
        if (size(lambda) == 1) then
            gamma = -real(lambda(1))
            omega2 = aimag(lambda(1))**2
        else
            gamma = -0.5_dp*real(lambda(1) + lambda(2))
            omega2 = -0.25_dp*real(lambda(1) - lambda(2))**2
        end if
    end subroutine one_rate

    subroutine compare_rates(derivation, system, modes, values, line, c)
        !! The polynomial against \(\prod(x - \lambda_k)\) of LAPACK's rates, each relative to its
        !! value at another x: at 2n places beyond all \(|\lambda|\), where every factor is at
        !! least a fifth of x, and the worst of them is shown. A polynomial that agrees there is
        !! the same, but for a factor.
        type(derivation_t), intent(in) :: derivation
        class(system_t), intent(in) :: system
        type(modes_t), intent(in) :: modes
        real(dp), intent(inout) :: values(:)
        type(line_t), intent(in) :: line
        type(comparison_t), intent(inout) :: c
        complex(dp), allocatable :: lambda(:)
        type(error_t), allocatable :: error
        real(dp) :: x, largest, first, first_noise, value, noise, formula, product_of, one
        integer :: j

        call damped_rates(system, modes, lambda, error)
        c%known = .not. allocated(error)
        if (.not. c%known) return
        largest = max(maxval(abs(lambda)), tiny(x))
        values(derivation%rate()) = 1.25_dp*largest
        call evaluate(line%right, values, first, first_noise)
        one = product_at(1.25_dp*largest)
        c%formula = 0.0_dp
        c%program = 0.0_dp
        c%noise = huge(x)
        do j = 1, 2*size(modes%at)
            x = (1.25_dp + 0.5_dp*j)*largest
            values(derivation%rate()) = x
            call evaluate(line%right, values, value, noise)
            formula = value/first
            product_of = product_at(x)/one
            noise = noise/abs(first) + first_noise/abs(first)*abs(formula) &
                    + 1024.0_dp*epsilon(x)*abs(product_of)*cancellation(modes)
            if (abs(formula - product_of)*c%noise < abs(c%formula - c%program)*noise) cycle
            c%formula = formula
            c%program = product_of
            c%noise = noise
        end do
    contains
        real(dp) function product_at(x)
            real(dp), intent(in) :: x
            integer :: k

            product_at = 1.0_dp
            do k = 1, size(lambda)
                if (aimag(lambda(k)) > 0.0_dp) then
                    product_at = product_at*((x - real(lambda(k)))**2 + aimag(lambda(k))**2)
                else
                    product_at = product_at*(x - real(lambda(k)))
                end if
            end do
        end function product_at
    end subroutine compare_rates
end module lagrangia_derivation_rest
