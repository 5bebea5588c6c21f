module lagrangia_written_motion
    !! The equations of motion of a Lagrangian in symbols, to be compiled: momenta, mass matrix,
    !! right-hand sides, and the accelerations by elimination.
    use lagrangia_canonical_form, only: simplified
    use lagrangia_derivative, only: derivative, time_derivative
    use lagrangia_expression, only: expression_t, kind_difference, kind_product, &
                                    kind_quotient, operator(*), operator(+), operator(-), symbol, &
                                    whole
    use lagrangia_symbols, only: symbols_t
    implicit none (type, external)
    private
    public :: written_motion_t, derive_motion, invert_momenta, leave_out_what_cancels, solve_motion

    type :: written_motion_t
        !! Of n coordinates; the symbols are t, q, q_dot, and what stays as it is.
        type(expression_t), allocatable :: momenta(:)     !! \(p_i = \partial L/\partial\dot q_i\)
        type(expression_t), allocatable :: mass(:, :)     !! \(\partial p_i/\partial\dot q_j\)
        type(expression_t), allocatable :: slopes(:)      !! \(\partial L/\partial q_i\)
        type(expression_t), allocatable :: right(:)       !! of \(M\ddot q\)
        type(expression_t) :: energy                      !! \(\dot q\cdot p - L\)
    end type written_motion_t

contains

    pure subroutine derive_motion(lagrangian, forces, symbols, motion)
        !! \(M\ddot q = \partial L/\partial q - (\partial p/\partial q)\,\dot q
        !! - \partial p/\partial t + Q\).
        type(expression_t), intent(in) :: lagrangian  !! of the symbols t, q, q_dot, parameters
        type(expression_t), intent(in) :: forces(:)   !! Q of each coordinate, (n)
        type(symbols_t), intent(in) :: symbols        !! their names
        type(written_motion_t), intent(out) :: motion !! of n coordinates
        integer :: rates(size(symbols%names)), i, j, n

        n = size(forces)
        rates = 0
        rates(2:1 + n) = [(1 + n + i, i=1, n)]
        allocate (motion%momenta(n), motion%mass(n, n), motion%slopes(n), motion%right(n))
        motion%energy = whole(0) - lagrangian
        do i = 1, n
            motion%momenta(i) = derivative(lagrangian, 1 + n + i)
            motion%slopes(i) = derivative(lagrangian, 1 + i)
            motion%right(i) = motion%slopes(i) - time_derivative(motion%momenta(i), rates, 1)
            call leave_out_what_cancels(motion%right(i), 1 + 2*n, symbols)
            if (.not. forces(i)%is_zero()) motion%right(i) = motion%right(i) + forces(i)
            motion%energy = motion%energy + symbol(1 + n + i)*motion%momenta(i)
            do j = 1, i
                motion%mass(i, j) = derivative(motion%momenta(i), 1 + n + j)
                motion%mass(j, i) = motion%mass(i, j)
            end do
        end do
    end subroutine derive_motion

    pure subroutine invert_momenta(motion, symbols, results, known)
        !! \(\dot q = M^{-1}(p - b)\) where L is of degree two in the velocities: n velocities, then
        !! pivots and diagonal as `solve_motion` gives them, with the momenta in the places of the
        !! velocities.
        type(written_motion_t), intent(in) :: motion  !! with momenta and mass matrix
        type(symbols_t), intent(in) :: symbols        !! t, q, q_dot, parameters
        type(expression_t), allocatable, intent(out) :: results(:)  !! (3n)
        logical, intent(out) :: known                 !! L is of degree two by its form
        type(written_motion_t) :: inverse
        integer :: i, j, k, n

        n = size(motion%momenta)
        known = .true.
        inverse%mass = motion%mass
        allocate (inverse%right(n))
        do i = 1, n
            inverse%right(i) = motion%momenta(i)
            do j = 1, n
                inverse%right(i) = inverse%right(i) - motion%mass(i, j)*symbol(1 + n + j)
                do k = 2 + n, 1 + 2*n
                    known = known .and. .not. motion%mass(i, j)%depends_on(k)
                end do
            end do
            inverse%right(i) = simplified(inverse%right(i), symbols)  ! b
            do k = 2 + n, 1 + 2*n
                known = known .and. .not. inverse%right(i)%depends_on(k)
            end do
            inverse%right(i) = symbol(1 + n + i) - inverse%right(i)
        end do
        call solve_motion(inverse, results)
    end subroutine invert_momenta

    pure subroutine leave_out_what_cancels(expression, n, symbols)
        !! Where one of the first `n` symbols cancels, as in \(\sin^2 + \cos^2\), take the
        !! canonical form, so that rounding does not bring it back. Elsewhere the form stays as it
        !! was typed, which may lose fewer digits.
        type(expression_t), intent(inout) :: expression  !! of the symbols
        integer, intent(in) :: n                !! t, coordinates, velocities
        type(symbols_t), intent(in) :: symbols  !! of the expression
        type(expression_t) :: short
        integer :: i

        short = simplified(expression, symbols)
        do i = 1, n
            if (.not. expression%depends_on(i) .or. short%depends_on(i)) cycle
            expression = short
            return
        end do
    end subroutine leave_out_what_cancels

    pure subroutine solve_motion(motion, results)
        !! Gauss's elimination without pivoting, in symbols: n accelerations, then the n pivots,
        !! then the diagonal of the mass matrix that they are to be compared with.
        type(written_motion_t), intent(in) :: motion             !! with its mass matrix
        type(expression_t), allocatable, intent(out) :: results(:)  !! (3n)
        type(expression_t) :: all
        integer, dimension(size(motion%right)) :: x, diagonal
        integer :: m(size(x), size(x))  ! nodes; 0 stands for zero
        integer :: factor, i, j, k, n, quotient

        n = size(x)
        do i = 1, n
            call append(all, motion%right(i), x(i))
            do j = 1, n
                call append(all, motion%mass(i, j), m(i, j))
            end do
            diagonal(i) = m(i, i)
        end do
        do i = 1, n
            do j = i + 1, n
                if (m(j, i) == 0) cycle
                call divide(all, m(j, i), m(i, i), factor)
                call subtract_product(all, factor, x(i), x(j))
                do k = i + 1, n
                    call subtract_product(all, factor, m(i, k), m(j, k))
                end do
            end do
        end do
        do i = n, 1, -1
            do k = i + 1, n
                call subtract_product(all, m(i, k), x(k), x(i))
            end do
            call divide(all, x(i), m(i, i), quotient)
            x(i) = quotient
        end do
        allocate (results(3*n))
        do i = 1, n
            results(i) = at_node(all, x(i))
            results(n + i) = at_node(all, m(i, i))
            results(2*n + i) = at_node(all, diagonal(i))
        end do
    end subroutine solve_motion

    pure subroutine append(all, expression, node)
        !! An expression behind the others; node 0 where it is zero.
        type(expression_t), intent(inout) :: all
        type(expression_t), intent(in) :: expression
        integer, intent(out) :: node

        node = 0
        if (.not. expression%is_zero()) call all%append(expression, node)
    end subroutine append

    pure subroutine divide(all, a, b, node)
        !! A quotient of nodes; where the second is zero by its form, the pivot says so.
        type(expression_t), intent(inout) :: all
        integer, intent(in) :: a, b
        integer, intent(out) :: node

        node = 0
        if (a > 0 .and. b > 0) call all%add_operation(kind_quotient, a, b, node)
    end subroutine divide

    pure subroutine subtract_product(all, a, b, node)
        !! Make `node` that of itself minus `a` times `b`.
        type(expression_t), intent(inout) :: all
        integer, intent(in) :: a, b
        integer, intent(inout) :: node
        integer :: before, product

        if (a == 0 .or. b == 0) return
        before = node
        if (before == 0) call all%append(whole(0), before)
        call all%add_operation(kind_product, a, b, product)
        call all%add_operation(kind_difference, before, product, node)
    end subroutine subtract_product

    pure function at_node(all, node) result(expression)
        !! What a node stands for.
        type(expression_t), intent(in) :: all
        integer, intent(in) :: node
        type(expression_t) :: expression

        if (node == 0) then
            expression = whole(0)
        else
            expression = all%pruned(node)
        end if
    end function at_node
end module lagrangia_written_motion
