module lagrangia_generators
    !! Noether's theorem as a search: which of many small changes of coordinates and time leave L
    !! as it is, but for a \(dF/dt\)?
    !!
    !! With \(\delta q = \xi(q, t)\), \(\delta t = \tau\), constant, the condition is
    !! $$ \frac{\partial L}{\partial q}\xi + \frac{\partial L}{\partial\dot q}\dot\xi
    !!    + \frac{\partial L}{\partial t}\tau - \frac{dF}{dt} = 0 $$
    !! at all states, linear in the coefficients of \(\xi\), \(\tau\) and \(F\): a null space. Each
    !! of its vectors gives a conserved
    !! $$ I = \frac{\partial L}{\partial\dot q}\xi - h\tau - F,\qquad
    !!    h = \dot q\frac{\partial L}{\partial\dot q} - L $$
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp
    use lagrangia_lagrange, only: euler_lagrange_t, expand_lagrangian
    use lagrangia_null_space, only: null_space
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: count_generators, find_symmetries, outside, conserved_values
    public :: boost, linear, of_time, shift
    public :: of_coordinate, of_product, of_sine

    integer, parameter :: states = 200  !! at which the condition must hold

contains

    pure function count_generators(n) result(number)
        !! For n coordinates: \(\xi\) is a constant, t or a coordinate in one of n directions;
        !! \(\tau\) is a constant; F is t, or q, sin q, cos q of one, or a product of two.
        integer, intent(in) :: n  !! coordinates
        integer :: number

        number = 2*n + n*n + 1 + 1 + 3*n + n*(n + 1)/2
    end function count_generators

    pure function shift(i) result(at)
        !! \(\xi_i = 1\).
        integer, intent(in) :: i  !! coordinate
        integer :: at

        at = i
    end function shift

    pure function boost(n, i) result(at)
        !! \(\xi_i = t\).
        integer, intent(in) :: n, i  !! coordinates; one of them
        integer :: at

        at = n + i
    end function boost

    pure function linear(n, i, j) result(at)
        !! \(\xi_i = q_j\).
        integer, intent(in) :: n, i, j  !! coordinates; two of them
        integer :: at

        at = 2*n + (i - 1)*n + j
    end function linear

    pure function of_time(n) result(at)
        !! \(\tau = 1\).
        integer, intent(in) :: n  !! coordinates
        integer :: at

        at = 2*n + n*n + 1
    end function of_time

    pure function of_coordinate(n, i) result(at)
        !! \(F = q_i\).
        integer, intent(in) :: n, i  !! coordinates; one of them
        integer :: at

        at = of_time(n) + 1 + i
    end function of_coordinate

    pure function of_sine(n, i) result(at)
        !! \(F = \sin q_i\); the cosine is n further on.
        integer, intent(in) :: n, i  !! coordinates; one of them
        integer :: at

        at = of_time(n) + 1 + n + i
    end function of_sine

    pure function of_product(n, i, j) result(at)
        !! \(F = q_i q_j\), \(i \le j\).
        integer, intent(in) :: n, i, j  !! coordinates; two of them
        integer :: at

        at = of_time(n) + 1 + 3*n + (i - 1)*n - (i - 1)*i/2 + j
    end function of_product

    pure subroutine find_symmetries(system, symmetries, error)
        !! An orthonormal basis of all that leave the motion as it is.
        class(system_t), intent(in) :: system  !! with its parameters
        real(dp), allocatable, intent(out) :: symmetries(:, :)  !! (generators, found)
        type(error_t), allocatable, intent(out) :: error  !! LAPACK's
        real(dp) :: matrix(states, count_generators(system%ndof))
        real(dp) :: t, q(system%ndof), v(system%ndof)
        type(euler_lagrange_t) :: terms
        integer :: i, j, k, n

        n = system%ndof
        do k = 1, states
            t = 0.02_dp*k
            ! a frequency each: with one for all, three coordinates would lie in a plane
            q = [(1.4_dp*sin((1.7_dp + 0.31_dp*j)*k), j=1, n)]
            v = [(1.4_dp*cos((2.3_dp + 0.47_dp*j)*k), j=1, n)]
            call expand_lagrangian(system, t, q, v, terms)
            do i = 1, n
                matrix(k, shift(i)) = terms%dl_dq(i)
                matrix(k, boost(n, i)) = t*terms%dl_dq(i) + terms%dl_dv(i)
                do j = 1, n
                    matrix(k, linear(n, i, j)) = q(j)*terms%dl_dq(i) + v(j)*terms%dl_dv(i)
                end do
            end do
            matrix(k, of_time(n)) = terms%dl_dt
            matrix(k, of_time(n) + 1:) = -rate_of_f(q, v)
        end do
        call null_space(matrix, symmetries, error)
    end subroutine find_symmetries

    pure function rate_of_f(q, v) result(rate)
        !! \(dF/dt\) of t, q, sin q, cos q, and the products.
        real(dp), intent(in) :: q(:), v(:)
        real(dp) :: rate(1 + 3*size(q) + size(q)*(size(q) + 1)/2)
        integer :: i, j, n

        n = size(q)
        rate(1) = 1.0_dp
        rate(2:n + 1) = v
        rate(n + 2:2*n + 1) = cos(q)*v
        rate(2*n + 2:3*n + 1) = -sin(q)*v
        rate(3*n + 2:) = [((v(i)*q(j) + q(i)*v(j), j=i, n), i=1, n)]
    end function rate_of_f

    pure function value_of_f(t, q) result(f)
        !! The same without the rate.
        real(dp), intent(in) :: t, q(:)
        real(dp) :: f(1 + 3*size(q) + size(q)*(size(q) + 1)/2)
        integer :: i, j

        f = [t, q, sin(q), cos(q), ((q(i)*q(j), j=i, size(q)), i=1, size(q))]
    end function value_of_f

    pure function outside(symmetries, generator) result(distance)
        !! How much of a generator, made one long, is not in what was found: 0 if it is a symmetry.
        real(dp), intent(in) :: symmetries(:, :)  !! (generators, found), orthonormal
        real(dp), intent(in) :: generator(:)      !! coefficients
        real(dp) :: distance
        real(dp) :: unit(size(generator))

        unit = generator/norm2(generator)
        distance = norm2(unit - matmul(symmetries, matmul(unit, symmetries)))
    end function outside

    pure function conserved_values(system, generators, t, q, v) result(values)
        !! \(I\) of each of the generators.
        class(system_t), intent(in) :: system  !! with its parameters
        real(dp), intent(in) :: generators(:, :)  !! (generators, k), coefficients
        real(dp), intent(in) :: t, q(system%ndof), v(system%ndof)  !! s; coordinates and velocities
        real(dp) :: values(size(generators, 2))
        real(dp) :: each(size(generators, 1))
        type(euler_lagrange_t) :: terms
        integer :: i, j, n

        n = system%ndof
        call expand_lagrangian(system, t, q, v, terms)
        do i = 1, n
            each(shift(i)) = terms%dl_dv(i)
            each(boost(n, i)) = t*terms%dl_dv(i)
            do j = 1, n
                each(linear(n, i, j)) = q(j)*terms%dl_dv(i)
            end do
        end do
        each(of_time(n)) = terms%l - dot_product(v, terms%dl_dv)
        each(of_time(n) + 1:) = -value_of_f(t, q)
        values = matmul(each, generators)
    end function conserved_values
end module lagrangia_generators
