module lagrangia_gauss_tables
    !! Gauss-Legendre collocation with eight stages on \([0, 1]\): order 16.
    !!
    !! The method is written with \(\mu_{ij} = a_{ij}/b_j\). It is symplectic if and only if
    !! \(\mu_{ij} + \mu_{ji} = 1\), and symmetric if besides \(\mu_{9-i,9-j} = \mu_{ji}\) and
    !! \(b_{9-i} = b_i\). Here all of this holds to the last bit, so that the rounding of the
    !! coefficients changes frequencies by 1e-17 but makes no energy drift. From a table of
    !! \(a_{ij}\) it would.
    !!
    !! Source: 40 digits by \(\mu_{ij} = \frac12 + \sum_{k=1}^{7}
    !! (P_k(c_i)P_{k-1}(c_j) - P_{k-1}(c_i)P_k(c_j))/(2\sqrt{4k^2-1})\), \(P_k\) orthonormal
    !! (Hairer & Wanner, *Solving Ordinary Differential Equations II*, 2nd ed., sec. IV.5).
    !! \(\mu\) as the coefficients: Antoñana, Makazaga & Murua, Numer. Algorithms 74 (2017) 861.
    use lagrangia_kinds, only: dp
    implicit none (type, external)
    private
    public :: stages, nodes, weights, mu, butcher, nystrom
    public :: legendre

    integer, parameter :: stages = 8

    real(dp), parameter :: first_nodes(4) = [ &
        0.01985507175123188415821956571526350_dp, 0.10166676129318663020422303176208478_dp, &
        0.23723379504183550709113047540537682_dp, 0.40828267875217509753026192881990800_dp]
    real(dp), parameter :: nodes(stages) = [first_nodes, 1.0_dp - first_nodes(4:1:-1)]

    real(dp), parameter :: first_weights(4) = [ &
        0.05061426814518812957626567715498109_dp, 0.11119051722668723527217799721312044_dp, &
        0.15685332293894364366898110099330065_dp, 0.18134189168918099148257522463859780_dp]
    real(dp), parameter :: weights(stages) = [first_weights, first_weights(4:1:-1)]

    real(dp), parameter :: later(16) = [ &
        1.08189496310558149713650816473593098_dp, 0.95995729622205494766003095439844680_dp, &
        1.02472134580320037486804458164508282_dp, 0.98302382676362890697311829123888391_dp, &
        1.01222591411329820605394253172194348_dp, 0.99125143323080263118822334698608779_dp, &
        1.00548280825321588267934093532149515_dp, 1.08695892430083272332907096461624797_dp, &
        0.95505887369737431186016905653386872_dp, 1.02875977547474931097823055704106862_dp, &
        0.97998287236359129082628958290257333_dp, 1.01407435588916692914597351665259947_dp, &
        1.08809383873230831344221387139132040_dp, 0.95383453518519996588326911440754302_dp, &
        1.02960387306497793746301259821212231_dp, 1.08834716110982778425070738060080440_dp]
    !! the different \(\mu_{ij}\) of a stage \(i\) and an earlier one \(j\); of a later one,
    !! \(1 - \mu_{ji}\), which is exact
    integer, parameter :: place(stages*stages) = [ &
        0, 1, 2, 3, 4, 5, 6, 7, &
        -1, 0, 8, 9, 10, 11, 12, 6, &
        -2, -8, 0, 13, 14, 15, 11, 5, &
        -3, -9, -13, 0, 16, 14, 10, 4, &
        -4, -10, -14, -16, 0, 13, 9, 3, &
        -5, -11, -15, -14, -13, 0, 8, 2, &
        -6, -12, -11, -10, -9, -8, 0, 1, &
        -7, -6, -5, -4, -3, -2, -1, 0]
    !! where in `later` the columns of \(\mu\) are; negative for \(1 - \mu_{ji}\), 0 for 1/2
    real(dp), parameter :: halved(0:16) = [0.5_dp, later]
    real(dp), parameter :: mu(stages, stages) = reshape( &
        merge(halved(abs(place)), 1.0_dp - halved(abs(place)), place > 0), [stages, stages])
    real(dp), parameter :: butcher(stages, stages) = mu*spread(weights, 1, stages)
    !! \(a_{ij}\), rounded
    real(dp), parameter :: nystrom(stages, stages) = matmul(butcher, butcher)
    !! \((a^2)_{ij}\), rounded

    real(dp), parameter :: up(6) = [1.5_dp, 5.0_dp/3.0_dp, 1.75_dp, 1.8_dp, 11.0_dp/6.0_dp, &
                                    13.0_dp/7.0_dp]
    real(dp), parameter :: down(6) = up - 1.0_dp

contains

    pure subroutine legendre(x, p)
        !! \(P_0, \dots, P_7\), normalised to \(P_k(1) = 1\), at `x` in \([0, 1]\) and beyond:
        !! \((k+1)P_{k+1} = (2k+1)(2x-1)P_k - kP_{k-1}\).
        real(dp), intent(in) :: x(stages)                    !! 0 to 1 in the step
        real(dp), intent(out) :: p(stages, 0:stages - 1)  !! \(P_k\) at `x(i)` in `p(i, k)`
        real(dp) :: y, p2, p3, p4, p5, p6
        integer :: i

        !GCC$ vector
        do i = 1, stages
            y = 2.0_dp*x(i) - 1.0_dp
            p2 = up(1)*y*y - down(1)
            p3 = up(2)*y*p2 - down(2)*y
            p4 = up(3)*y*p3 - down(3)*p2
            p5 = up(4)*y*p4 - down(4)*p3
            p6 = up(5)*y*p5 - down(5)*p4
            p(i, 0) = 1.0_dp
            p(i, 1) = y
            p(i, 2) = p2
            p(i, 3) = p3
            p(i, 4) = p4
            p(i, 5) = p5
            p(i, 6) = p6
            p(i, 7) = up(6)*y*p6 - down(6)*p5
        end do
    end subroutine legendre
end module lagrangia_gauss_tables
