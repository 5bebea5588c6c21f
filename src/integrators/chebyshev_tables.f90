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
    public :: chebyshev_tables_t, points, terms

    integer, parameter :: points = 2*lanes
    integer, parameter :: top = points + 1  !! degree of \(q\)
    integer, parameter :: terms = lanes + 2 !! of a first guess: \(P_0, \dots, P_7, P_8, yP_8\)

    type :: chebyshev_tables_t
        !! Rows are in two groups of lanes; columns are those of `f`, of the \(a_k\), or of the
        !! terms of a guess.
        real(dp) :: x(lanes, 2) = 0.0_dp                 !! the points
        real(dp) :: series(lanes, points, 2) = 0.0_dp    !! \(a_0, \dots, a_{15}\) from `f`
        real(dp) :: v(lanes, points, 2) = 0.0_dp         !! \(v\) at the points from \(a_k\)
        real(dp) :: q(lanes, points, 2) = 0.0_dp         !! \(q\) likewise
        real(dp) :: guess_v(lanes, terms, 2) = 0.0_dp    !! \(v\) at the points from a guess
        real(dp) :: guess_q(lanes, terms, 2) = 0.0_dp    !! \(q\) likewise
        real(dp) :: v_end(points) = 0.0_dp               !! \(v(1)\) from \(a_k\)
        real(dp) :: q_end(points) = 0.0_dp               !! \(q(1)\) from \(a_k\)
    contains
        procedure :: fill
    end type chebyshev_tables_t

contains

    pure subroutine fill(self)
        !! Compute the tables.
        class(chebyshev_tables_t), intent(inout) :: self
        real(dp), parameter :: pi = acos(-1.0_dp)
        real(dp) :: cosine(0:4*points - 1), t_at(points, 0:top), a(0:top), v(0:top), q(0:top)
        real(dp) :: all_v(points, points), all_q(points, points), series(points, points)
        real(dp) :: guess(points, terms), y(lanes), p(lanes, lanes)
        integer :: g, i, j, k

        !GCC$ novector
        do k = 0, 4*points - 1
            cosine(k) = cos(k*pi/(2*points))
        end do
        do k = 0, top
            do j = 1, points
                t_at(j, k) = cosine(mod((2*j - 1)*k, 4*points))
            end do
        end do
        do k = 0, points - 1
            series(k + 1, :) = 2.0_dp/points*t_at(:, k)
            a = 0.0_dp
            a(k) = 1.0_dp
            call integrate(a, v)
            call integrate(v, q)
            all_v(:, k + 1) = matmul(t_at, v)
            all_q(:, k + 1) = matmul(t_at, q)
            self%v_end(k + 1) = sum(v)
            self%q_end(k + 1) = sum(q)
        end do
        series(1, :) = 0.5_dp*series(1, :)
        do g = 1, 2
            i = (g - 1)*lanes + 1
            j = g*lanes
            self%x(:, g) = 0.5_dp + 0.5_dp*t_at(i:j, 1)
            self%series(:, :, g) = series(i:j, :)
            self%v(:, :, g) = all_v(i:j, :)
            self%q(:, :, g) = all_q(i:j, :)
            call legendre(self%x(:, g), p)
            guess(i:j, :lanes) = p
            y = 2.0_dp*self%x(:, g) - 1.0_dp
            guess(i:j, lanes + 1) = (15.0_dp*y*p(:, lanes) - 7.0_dp*p(:, lanes - 1))/8.0_dp
            guess(i:j, lanes + 2) = y*guess(i:j, lanes + 1)
        end do
        do g = 1, 2
            self%guess_v(:, :, g) = matmul(self%v(:, :, g), matmul(series, guess))
            self%guess_q(:, :, g) = matmul(self%q(:, :, g), matmul(series, guess))
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
