module test_systems
    !! Every system by what all systems claim. New systems take two lines here.
    use funit, only: TestMethod, TestSuite
    use lagrangia_atwood, only: atwood_t
    use lagrangia_cart_pendulum, only: cart_pendulum_t
    use lagrangia_charged_particle, only: charged_particle_t
    use lagrangia_double_pendulum, only: double_pendulum_t
    use lagrangia_driven_pendulum, only: driven_pendulum_t
    use lagrangia_oscillator, only: oscillator_t
    use lagrangia_pendulum, only: pendulum_t
    use lagrangia_rolling_disk, only: rolling_disk_t
    use lagrangia_rotating_hoop, only: rotating_hoop_t
    use lagrangia_rotating_wire, only: rotating_wire_t
    use lagrangia_wedge, only: wedge_t
    use system_checks, only: check_points, check_system
    implicit none (type, external)
    private
    public :: systems_suite

contains

    function systems_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("systems")
        call suite%addTest(TestMethod("oscillator_claims_hold", oscillator_claims_hold))
        call suite%addTest(TestMethod("pendulum_claims_hold", pendulum_claims_hold))
        call suite%addTest(TestMethod("double_pendulum_claims_hold", double_pendulum_claims_hold))
        call suite%addTest(TestMethod("cart_pendulum_claims_hold", cart_pendulum_claims_hold))
        call suite%addTest(TestMethod("atwood_claims_hold", atwood_claims_hold))
        call suite%addTest(TestMethod("wedge_claims_hold", wedge_claims_hold))
        call suite%addTest(TestMethod("rolling_disk_claims_hold", rolling_disk_claims_hold))
        call suite%addTest(TestMethod("charged_particle_claims_hold", charged_particle_claims_hold))
        call suite%addTest(TestMethod("rotating_wire_claims_hold", rotating_wire_claims_hold))
        call suite%addTest(TestMethod("rotating_hoop_claims_hold", rotating_hoop_claims_hold))
        call suite%addTest(TestMethod("driven_pendulum_claims_hold", driven_pendulum_claims_hold))
    end function systems_suite

    subroutine oscillator_claims_hold()
        type(oscillator_t) :: system

        call check_system(system)
        call check_points(system)
    end subroutine oscillator_claims_hold

    subroutine pendulum_claims_hold()
        type(pendulum_t) :: system

        call check_system(system)
        call check_points(system)
    end subroutine pendulum_claims_hold

    subroutine double_pendulum_claims_hold()
        type(double_pendulum_t) :: system

        call check_system(system)
        call check_points(system)
    end subroutine double_pendulum_claims_hold

    subroutine cart_pendulum_claims_hold()
        type(cart_pendulum_t) :: system

        call check_system(system)
        call check_points(system)
    end subroutine cart_pendulum_claims_hold

    subroutine atwood_claims_hold()
        !! Not the points: the pulley's inertia is not in them.
        type(atwood_t) :: system

        call check_system(system)
    end subroutine atwood_claims_hold

    subroutine wedge_claims_hold()
        type(wedge_t) :: system

        call check_system(system)
        call check_points(system)
    end subroutine wedge_claims_hold

    subroutine rolling_disk_claims_hold()
        !! Not the points: the disk's moments of inertia are not in them.
        type(rolling_disk_t) :: system

        call check_system(system)
    end subroutine rolling_disk_claims_hold

    subroutine charged_particle_claims_hold()
        type(charged_particle_t) :: system

        call check_system(system)
        call check_points(system)
    end subroutine charged_particle_claims_hold

    subroutine rotating_wire_claims_hold()
        type(rotating_wire_t) :: system

        call check_system(system)
        call check_points(system)
    end subroutine rotating_wire_claims_hold

    subroutine rotating_hoop_claims_hold()
        type(rotating_hoop_t) :: system

        call check_system(system)
        call check_points(system)
    end subroutine rotating_hoop_claims_hold

    subroutine driven_pendulum_claims_hold()
        type(driven_pendulum_t) :: system

        call check_system(system)
        call check_points(system)
    end subroutine driven_pendulum_claims_hold
end module test_systems
