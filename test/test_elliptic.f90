module test_elliptic
    !! Elliptic functions from the complementary modulus, up to the separatrix.
    !!
    !! The expected numbers are mpmath's, at 60 to 700 digits, from the doubles given here.
    !! Tolerances: one multiplication rounds the argument, so no result can be better than
    !! `epsilon*(|f| + |u f'(u)|)`; 8 times that is allowed for the dozen roundings on the way.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_is_nan, ieee_positive_inf, &
                                             ieee_quiet_nan, ieee_value
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertLessThan, &
                     assertRelativelyEqual, assertTrue
    use lagrangia_elliptic, only: agm, amplitude, elliptic_k, jacobi
    use lagrangia_kinds, only: dp
    implicit none (type, external)
    private
    public :: elliptic_suite

    real(dp), parameter :: eps = epsilon(1.0_dp)
    real(dp), parameter :: pi = acos(-1.0_dp)

contains

    function elliptic_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("elliptic")
        call suite%addTest(TestMethod("means_of_gauss", means_of_gauss))
        call suite%addTest(TestMethod("complete_integral", complete_integral))
        call suite%addTest(TestMethod("jacobi_up_to_the_separatrix", jacobi_up_to_the_separatrix))
        call suite%addTest(TestMethod("jacobi_on_the_separatrix", jacobi_on_the_separatrix))
        call suite%addTest(TestMethod("jacobi_of_tiny_arguments", jacobi_of_tiny_arguments))
        call suite%addTest(TestMethod("amplitude_never_falls", amplitude_never_falls))
        call suite%addTest(TestMethod("swinging_pendulum", swinging_pendulum))
        call suite%addTest(TestMethod("rotating_pendulum", rotating_pendulum))
        call suite%addTest(TestMethod("arguments_out_of_range_give_nan", &
                                      arguments_out_of_range_give_nan))
    end function elliptic_suite

    subroutine means_of_gauss()
        !! Gauss's own agm(24, 6); either order; any scale; a mean with 0 is 0.
        call assertRelativelyEqual(13.458171481725615_dp, agm(24.0_dp, 6.0_dp), 4.0_dp*eps)
        call assertRelativelyEqual(13.458171481725615_dp, agm(6.0_dp, 24.0_dp), 4.0_dp*eps)
        call assertRelativelyEqual(0.25969285309336492_dp, agm(1.3_dp, 0.002_dp), 4.0_dp*eps)
        call assertRelativelyEqual(1.702907311399468e197_dp, agm(1e-200_dp, 1e200_dp), 4.0_dp*eps)
        call assertEqual(0.7_dp, agm(0.7_dp, 0.7_dp))
        call assertEqual(0.0_dp, agm(0.0_dp, 0.7_dp))
        call assertEqual(0.0_dp, agm(0.7_dp, 0.0_dp))
    end subroutine means_of_gauss

    subroutine complete_integral()
        !! From the circle to a hair from the separatrix, where it is infinite.
        call assertEqual(0.5_dp*pi, elliptic_k(1.0_dp), tolerance=4.0_dp*eps)
        call assertRelativelyEqual(1.6820314010509288_dp, elliptic_k(0.87_dp), 4.0_dp*eps)
        call assertRelativelyEqual(3.6956373629898746_dp, elliptic_k(0.1_dp), 4.0_dp*eps)
        call assertRelativelyEqual(8.29405146361544_dp, elliptic_k(1e-3_dp), 4.0_dp*eps)
        call assertRelativelyEqual(692.1618222593336_dp, elliptic_k(1e-300_dp), 4.0_dp*eps)
        call assertFalse(ieee_is_finite(elliptic_k(0.0_dp)), "not ieee_is_finite(elliptic_k(0.0))")
        call assertFalse(ieee_is_nan(elliptic_k(0.0_dp)), "not ieee_is_nan(elliptic_k(0.0))")
    end subroutine complete_integral

    subroutine jacobi_up_to_the_separatrix()
        !! Every quadrant, both signs, ten periods on: sn, cn, dn and am.
        call check(1.0_dp, 0.581195_dp, [0.54902311812472513_dp, 0.83580716422187009_dp, &
                                         1.0_dp, 0.58119500000000002_dp])
        call check(1.0_dp, -1.27235_dp, [-0.95579447772419379_dp, 0.29403556987537344_dp, &
                                         1.0_dp, -1.2723500000000001_dp])
        call check(1.0_dp, 4.28827_dp, [-0.9114016420314677_dp, -0.41151797883244956_dp, &
                                        1.0_dp, 4.2882699999999998_dp])
        call check(1.0_dp, 65.3451_dp, [0.58780725302344554_dp, -0.80900100945118176_dp, &
                                        1.0_dp, 65.345100000000002_dp])
        call check(0.96_dp, 0.593118_dp, [0.55684257379780613_dp, 0.83061805181818366_dp, &
                                          0.98777033043298521_dp, 0.59057963749650136_dp])
        call check(0.96_dp, -1.29845_dp, [-0.95745791705614691_dp, 0.28857293197128607_dp, &
                                          0.96339436786085369_dp, -1.2780603005075413_dp])
        call check(0.96_dp, 4.37625_dp, [-0.91451793275390362_dp, -0.4045453629341543_dp, &
                                         0.96665955999651068_dp, 4.2959073374845749_dp])
        call check(0.96_dp, 66.6856_dp, [0.59565769957402392_dp, -0.80323838612094596_dp, &
                                         0.98599343068154031_dp, 65.335361515096835_dp])
        call check(0.7_dp, 0.689177_dp, [0.6163289962631153_dp, 0.78748877348524836_dp, &
                                         0.89792575966295977_dp, 0.66407249258790558_dp])
        call check(0.7_dp, -1.50874_dp, [-0.96882735859642738_dp, 0.24773685481790857_dp, &
                                         0.72201143350357367_dp, -1.3204527351903955_dp])
        call check(0.7_dp, 5.08501_dp, [-0.93608541367828348_dp, -0.35177279357385909_dp, &
                                        0.7437133117891369_dp, 4.3529247116317405_dp])
        call check(0.7_dp, 77.4859_dp, [0.65472668936924286_dp, -0.75586570383077374_dp, &
                                        0.88395690547450975_dp, 65.259624747790783_dp])
        call check(0.3_dp, 0.972276_dp, [0.75695830114084419_dp, 0.65346318207988355_dp, &
                                         0.69179683332891168_dp, 0.85864574442301973_dp])
        call check(0.3_dp, -2.1285_dp, [-0.98793694060841393_dp, 0.15485671241921419_dp, &
                                        0.33439848572768889_dp, -1.4153139122727264_dp])
        call check(0.3_dp, 7.17382_dp, [-0.9738230669081969_dp, -0.22730735658467692_dp, &
                                        0.37016004277249759_dp, 4.4830772171501919_dp])
        call check(0.3_dp, 109.315_dp, [0.79075155446957077_dp, -0.61213722244604392_dp, &
                                        0.65649668771792084_dp, 65.061409944846677_dp])
        call check(0.0207948_dp, 1.94613_dp, [0.96010448068526518_dp, 0.27964153155080035_dp, &
                                              0.28035333885413638_dp, 1.2873756018983506_dp])
        call check(0.0207948_dp, -4.26044_dp, [-0.99970195070569375_dp, 0.024413311025558839_dp, &
                                               0.032065179455647583_dp, -1.546380590023431_dp])
        call check(0.0207948_dp, 14.3593_dp, [-0.9991800075435988_dp, -0.04048842458251308_dp, &
                                              0.045508541556665125_dp, 4.6718894854368022_dp])
        call check(0.0207948_dp, 218.808_dp, [0.97077013677743453_dp, -0.24001112795268691_dp, &
                                              0.24085857952920534_dp, 64.64502671262853_dp])
        call check(1e-4_dp, 3.92075_dp, [0.9992141534238793_dp, 0.039636796003211364_dp, &
                                         0.039636921950240238_dp, 1.5311491447133905_dp])
        call check(1e-4_dp, -8.58327_dp, [-0.99999993238119784_dp, 3.6774665156973735e-4_dp, &
                                          3.8110050956194982e-4_dp, -1.570428580135038_dp])
        call check(1e-4_dp, 28.9288_dp, [-0.99999962052215672_dp, -8.7118054532901409e-4_dp, &
                                         8.7690109759892703e-4_dp, 4.7115177997291629_dp])
        call check(1e-4_dp, 440.82_dp, [0.9995838174252003_dp, -0.028847737201795131_dp, &
                                        0.028847910380856278_dp, 64.431501138434078_dp])
        call check(1e-8_dp, 7.32858_dp, [0.99999913800231376_dp, 0.0013130097598383598_dp, &
                                         0.0013130097598764402_dp, 1.5694833166577877_dp])
        call check(1e-8_dp, -16.0436_dp, [-0.99999999999997681_dp, 2.153521051836653e-7_dp, &
                                          2.1558415806138548e-7_dp, -1.5707961114427914_dp])
        call check(1e-8_dp, 54.073_dp, [-0.99999999999944787_dp, -1.0508352348640258e-6_dp, &
                                        1.0508828149854446e-6_dp, 4.712387929549455_dp])
        call check(1e-8_dp, 823.97_dp, [0.99999973743358487_dp, -7.2466044553555146e-4_dp, &
                                        7.2466044560454926e-4_dp, 64.403374059099721_dp])
        call check(1e-30_dp, 26.0716_dp, [1.0_dp, 9.512134473045848e-12_dp, &
                                          9.512134473045848e-12_dp, 1.5707963267853845_dp])
        call check(1e-30_dp, -57.0757_dp, [-1.0_dp, 3.2611324273385035e-25_dp, &
                                           3.2611324273538356e-25_dp, -1.5707963267948966_dp])
        call check(1e-30_dp, 192.366_dp, [-1.0_dp, -9.1549857473151161e-23_dp, &
                                          9.1549857473151167e-23_dp, 4.7123889803846899_dp])
        call check(1e-30_dp, 2931.3_dp, [1.0_dp, -1.153254513252612e-12_dp, &
                                         1.153254513252612e-12_dp, 64.402649398591915_dp])
        call check(1e-300_dp, 256.1_dp, [1.0_dp, 1.1973281143209488e-111_dp, &
                                         1.1973281143209488e-111_dp, 1.5707963267948966_dp])
        call check(1e-300_dp, -560.651_dp, [-1.0_dp, 6.5072040015148229e-244_dp, &
                                            6.5072040015148229e-244_dp, -1.5707963267948966_dp])
        call check(1e-300_dp, 1889.6_dp, [-1.0_dp, -7.282776362033045e-220_dp, &
                                          7.282776362033045e-220_dp, 4.7123889803846899_dp])
        call check(1e-300_dp, 28793.9_dp, [1.0_dp, -1.1127377808725812e-120_dp, &
                                           1.1127377808725812e-120_dp, 64.402649398590761_dp])
    end subroutine jacobi_up_to_the_separatrix

    subroutine jacobi_on_the_separatrix()
        !! \(k' = 0\): hyperbolic functions and the Gudermannian, also far out.
        real(dp), parameter :: u = -1.7_dp
        real(dp) :: sn, cn, dn

        call jacobi(u, 0.0_dp, sn, cn, dn)
        call assertEqual([tanh(u), 1.0_dp/cosh(u), 1.0_dp/cosh(u)], [sn, cn, dn], tolerance=eps)
        call assertEqual(2.0_dp*atan(tanh(0.5_dp*u)), amplitude(u, 0.0_dp), tolerance=4.0_dp*eps)
        call jacobi(1e4_dp, 0.0_dp, sn, cn, dn)
        call assertEqual([1.0_dp, 0.0_dp, 0.0_dp], [sn, cn, dn])
        call assertEqual(0.5_dp*pi, amplitude(1e4_dp, 0.0_dp), tolerance=eps)
    end subroutine jacobi_on_the_separatrix

    subroutine jacobi_of_tiny_arguments()
        !! sn u = u: the squares on the way underflow, the result does not.
        real(dp) :: sn, cn, dn
        real(dp), parameter :: u = -3e-200_dp

        call jacobi(u, 0.3_dp, sn, cn, dn)
        call assertRelativelyEqual(u, sn, 16.0_dp*eps)
        call assertEqual([1.0_dp, 1.0_dp], [cn, dn], tolerance=2.0_dp*eps)
        call assertRelativelyEqual(u, amplitude(u, 0.3_dp), 16.0_dp*eps)
        call jacobi(0.0_dp, 0.3_dp, sn, cn, dn)
        call assertEqual([0.0_dp, 1.0_dp, 1.0_dp], [sn, cn, dn], tolerance=2.0_dp*eps)
        call assertEqual(0.0_dp, amplitude(0.0_dp, 0.3_dp))
    end subroutine jacobi_of_tiny_arguments

    subroutine amplitude_never_falls()
        !! Over twelve turns either way, and by \(\pi\) every \(2K\): the roundings of 38 at most.
        real(dp), parameter :: kc(4) = [1.0_dp, 0.4_dp, 1e-3_dp, 1e-12_dp]
        integer, parameter :: steps = 4801
        real(dp) :: u(steps), am(steps), k
        integer :: i, j

        do i = 1, size(kc)
            k = elliptic_k(kc(i))
            u = [(k*(j - 2401)/100.0_dp, j=1, steps)]
            am = amplitude(u, kc(i))
            call assertLessThan(maxval(am(:steps - 1) - am(2:)), 64.0_dp*eps)
            call assertLessThan(maxval(abs(am(201:) - am(:steps - 200) - pi)), &
                                2.0_dp*38.0_dp*8.0_dp*eps*k)
        end do
    end subroutine amplitude_never_falls

    subroutine swinging_pendulum()
        !! Released at \(\theta_0\): \(\tan\theta/2 = (k/k')\,\mathrm{cn}\), \(k = \sin\theta_0/2\).
        call check_swing(0.5_dp, 1.0_dp, 0.27769877482366943_dp)
        call check_swing(0.5_dp, 5.0_dp, 0.1045547652739888_dp)
        call check_swing(0.5_dp, 10.0_dp, -0.45711151893797652_dp)
        call check_swing(0.5_dp, 100.0_dp, -0.24972704303580636_dp)
        call check_swing(2.0_dp, 1.0_dp, 1.5327275060382534_dp)
        call check_swing(2.0_dp, 5.0_dp, -1.6841244365668094_dp)
        call check_swing(2.0_dp, 10.0_dp, 0.71314818060137937_dp)
        call check_swing(2.0_dp, 100.0_dp, 1.9823256531570305_dp)
        call check_swing(3.1_dp, 1.0_dp, 3.0774203131996621_dp)
        call check_swing(3.1_dp, 5.0_dp, 0.51375187750330943_dp)
        call check_swing(3.1_dp, 10.0_dp, -3.0942593615241148_dp)
        call check_swing(3.1_dp, 100.0_dp, 0.12726160926867886_dp)
        call check_swing(3.14_dp, 1.0_dp, 3.139135061153505_dp)
        call check_swing(3.14_dp, 5.0_dp, 3.0234363781205373_dp)
        call check_swing(3.14_dp, 10.0_dp, -2.2447408186744981_dp)
        call check_swing(3.14_dp, 100.0_dp, 3.1338665220238597_dp)
    end subroutine swinging_pendulum

    subroutine rotating_pendulum()
        !! Thrown from the bottom at \(v > 2\): \(\theta = 2\,\mathrm{am}(vt/2)\) with \(k = 2/v\).
        call check_turn(2.0000001_dp, 1.0_dp, 1.7315390576420908_dp)
        call check_turn(2.0000001_dp, 10.0_dp, 3.1419617156829638_dp)
        call check_turn(2.0000001_dp, 100.0_dp, 34.541922584897446_dp)
        call check_turn(2.5_dp, 1.0_dp, 2.1955614642499091_dp)
        call check_turn(2.5_dp, 10.0_dp, 19.876400947015662_dp)
        call check_turn(2.5_dp, 100.0_dp, 197.03175638111942_dp)
        call check_turn(7.0_dp, 1.0_dp, 6.8648673553770761_dp)
        call check_turn(7.0_dp, 10.0_dp, 68.521504191905633_dp)
        call check_turn(7.0_dp, 100.0_dp, 685.34214340305864_dp)
    end subroutine rotating_pendulum

    subroutine arguments_out_of_range_give_nan()
        !! A modulus outside 0 to 1, and what is not a finite number.
        real(dp) :: bad, sn, cn, dn

        bad = ieee_value(1.0_dp, ieee_quiet_nan)
        call jacobi(0.4_dp, -0.1_dp, sn, cn, dn)
        call assertTrue(all(ieee_is_nan([sn, cn, dn])), message="k' < 0")
        call jacobi(0.4_dp, 1.1_dp, sn, cn, dn)
        call assertTrue(all(ieee_is_nan([sn, cn, dn])), message="k' > 1")
        call jacobi(bad, 0.5_dp, sn, cn, dn)
        call assertTrue(all(ieee_is_nan([sn, cn, dn])), message="u")
        call assertTrue(all(ieee_is_nan(amplitude([0.4_dp, bad], [bad, 0.5_dp]))), &
                        "all(ieee_is_nan(amplitude([0.4, bad], [bad, 0.5])))")
        call assertTrue(all(ieee_is_nan(elliptic_k([-0.1_dp, 1.1_dp, bad]))), &
                        "all(ieee_is_nan(elliptic_k([-0.1, 1.1, bad])))")
        call assertTrue(all(ieee_is_nan(agm([-1.0_dp, 1.0_dp, bad, 1.0_dp], &
                                            [1.0_dp, -1.0_dp, 1.0_dp, bad]))), &
                        "agm of what has none")
        bad = ieee_value(1.0_dp, ieee_positive_inf)
        call assertTrue(all(ieee_is_nan(agm([bad, 1.0_dp], [1.0_dp, bad]))), &
                        "all(ieee_is_nan(agm([bad, 1.0], [1.0, bad])))")
        call assertTrue(ieee_is_nan(amplitude(bad, 0.5_dp)), "ieee_is_nan(amplitude(bad, 0.5))")
    end subroutine arguments_out_of_range_give_nan

    subroutine check(kc, u, expected)
        !! sn, cn, dn and am within 8 times what the rounding of `u` alone costs.
        real(dp), intent(in) :: kc, u, expected(4)
        real(dp) :: actual(4), slope(4)
        integer :: i

        call jacobi(u, kc, actual(1), actual(2), actual(3))
        actual(4) = amplitude(u, kc)
        associate (sn => expected(1), cn => expected(2), dn => expected(3))
            slope = [cn*dn, sn*dn, (1.0_dp - kc**2)*sn*cn, dn]
        end associate
        do i = 1, 4
            call assertEqual(expected(i), actual(i), &
                             tolerance=8.0_dp*eps*(abs(expected(i)) + abs(u*slope(i))))
        end do
    end subroutine check

    subroutine check_swing(start, t, expected)
        !! Frequency 1. To 1e-13 of the amplitude for ten units of time up to 3.1 rad. Beyond that,
        !! rounding \(\theta_0/2\) moves \(k'\) by \(\epsilon/k'\), hence the phase at `t`.
        real(dp), intent(in) :: start, t, expected
        real(dp) :: kc, sn, cn, dn, tolerance

        kc = cos(0.5_dp*start)
        call jacobi(t, kc, sn, cn, dn)
        tolerance = 1e-13_dp*start
        if (start > 3.1_dp .or. t > 10.0_dp) tolerance = 8.0_dp*eps*(start + 2.0_dp*t/kc)
        call assertEqual(expected, 2.0_dp*atan2(sin(0.5_dp*start)*cn, kc), tolerance=tolerance)
    end subroutine check_swing

    subroutine check_turn(speed, t, expected)
        !! Frequency 1. \(k'\) comes from \(v - 2\), which is exact: \(1 - k^2\) would lose digits.
        !! What is left is the rounding of \(\theta\) and of \(vt/2\).
        real(dp), intent(in) :: speed, t, expected
        real(dp) :: kc

        kc = sqrt((speed - 2.0_dp)*(speed + 2.0_dp))/speed
        call assertEqual(expected, 2.0_dp*amplitude(0.5_dp*speed*t, kc), &
                         tolerance=8.0_dp*eps*(expected + speed*t))
    end subroutine check_turn
end module test_elliptic
