module lagrangia_chebyshev_tables
    !! What the accelerations at sixteen Chebyshev points of a step make of its motion, as matrices.
    !! On \([0, 1]\) the points are \(x_j = (1 + \cos\vartheta_j)/2\),
    !! \(\vartheta_j = (2j - 1)\pi/32\), two times eight lanes; the polynomial through the \(f_j\)
    !! has the series \(\sum_k a_k T_k(2x - 1)\), and its integrals from 0 are \(v\) and \(q\).
    !!
    !! Source: Mason & Handscomb, *Chebyshev Polynomials*, 2003, secs. 2.4 and 6.3.
    use lagrangia_gauss_tables, only: legendre
    use lagrangia_kinds, only: dp
    use lagrangia_system, only: lanes
    implicit none (type, external)
    private
    public :: chebyshev_tables_t, points

    integer, parameter :: points = 2*lanes
    integer, parameter :: top = points + 1  !! degree of \(q\)

    type :: chebyshev_tables_t
        !! Rows are in two groups of lanes; columns are those of `f` or of its Legendre
        !! coefficients.
        real(dp) :: x(lanes, 2) = 0.0_dp                   !! the points
        real(dp) :: v(lanes, points, 2) = 0.0_dp           !! \(v\) at the points from `f`
        real(dp) :: q(lanes, points, 2) = 0.0_dp           !! \(q\) likewise
        real(dp) :: series(lanes, points, 2) = 0.0_dp      !! \(a_0, \dots, a_{15}\) from `f`
        real(dp) :: v_end(lanes, 2) = 0.0_dp               !! \(v(1)\) from `f`: a row
        real(dp) :: q_end(lanes, 2) = 0.0_dp               !! \(q(1)\) from `f`: a row
        real(dp) :: legendre_f(lanes, lanes, 2) = 0.0_dp   !! `f` from Legendre's coefficients
        real(dp) :: legendre_v(lanes, lanes, 2) = 0.0_dp   !! \(v\) at the points from them
        real(dp) :: legendre_q(lanes, lanes, 2) = 0.0_dp   !! \(q\) likewise
    contains
        procedure :: fill
    end type chebyshev_tables_t

contains

    pure subroutine fill(self)
        !! Compute the tables.
        class(chebyshev_tables_t), intent(inout) :: self
        real(dp), parameter :: pi = acos(-1.0_dp)
        real(dp) :: cosine(0:4*points - 1), t_at(points, 0:top), a(0:top), v(0:top), q(0:top)
        real(dp) :: all_v(points, points), all_q(points, points), p(lanes, lanes)
        real(dp) :: at_end(points, 2)
        integer :: g, j, k, rows(lanes)

        !GCC$ novector
        do k = 0, 4*points - 1
            cosine(k) = cos(k*pi/(2*points))
        end do
        do k = 0, top
            do j = 1, points
                t_at(j, k) = cosine(mod((2*j - 1)*k, 4*points))
            end do
        end do
        do j = 1, points
            a = 0.0_dp
            a(:points - 1) = 2.0_dp/points*t_at(j, :points - 1)
            a(0) = 0.5_dp*a(0)
            call integrate(a, v)
            call integrate(v, q)
            all_v(:, j) = matmul(t_at, v)
            all_q(:, j) = matmul(t_at, q)
            at_end(j, :) = [sum(v), sum(q)]
            self%series(:, j, 1) = a(:lanes - 1)
            self%series(:, j, 2) = a(lanes:points - 1)
        end do
        do g = 1, 2
            rows = [(j, j=(g - 1)*lanes + 1, g*lanes)]
            self%v_end(:, g) = at_end(rows, 1)
            self%q_end(:, g) = at_end(rows, 2)
            self%x(:, g) = 0.5_dp + 0.5_dp*t_at(rows, 1)
            self%v(:, :, g) = all_v(rows, :)
            self%q(:, :, g) = all_q(rows, :)
            call legendre(self%x(:, g), p)
            self%legendre_f(:, :, g) = p
        end do
        do g = 1, 2
            self%legendre_v(:, :, g) = matmul(self%v(:, :lanes, g), self%legendre_f(:, :, 1)) &
                                       + matmul(self%v(:, lanes + 1:, g), self%legendre_f(:, :, 2))
            self%legendre_q(:, :, g) = matmul(self%q(:, :lanes, g), self%legendre_f(:, :, 1)) &
                                       + matmul(self%q(:, lanes + 1:, g), self%legendre_f(:, :, 2))
        end do
    end subroutine fill

    pure subroutine integrate(c, b)
        !! The series of \(\int_0 c\,dx\), with \(2\int T_k\,dx = T_{k+1}/(2(k+1)) -
        !! T_{k-1}/(2(k-1))\).
        real(dp), intent(in) :: c(0:top)
        real(dp), intent(out) :: b(0:top)
        integer :: k

        b(1) = 0.5_dp*(c(0) - 0.5_dp*c(2))
        do k = 2, top - 1
            b(k) = (c(k - 1) - c(k + 1))/(4*k)
        end do
        b(top) = c(top - 1)/(4*top)
        b(0) = sum(b(1::2)) - sum(b(2::2))
    end subroutine integrate
end module lagrangia_chebyshev_tables
