module test_exact_maps
    !! Three steps of a method on polynomial equations, against rational arithmetic: the numbers
    !! below are fractions of whole numbers, rounded to 34 digits, from a program that knows the
    !! formulae of the books and nothing else.
    use funit, only: TestMethod, TestSuite, assertEqual, assertTrue
    use lagrangia_catalogue, only: new_system
    use lagrangia_description, only: description_t
    use lagrangia_errors, only: error_t
    use lagrangia_exact_motion, only: exact_motion_t, new_exact_motion
    use lagrangia_gyrating_system, only: gyrating_system_t
    use lagrangia_hyperdual, only: hyperdual_t
    use lagrangia_integrator, only: integrator_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_methods, only: new_integrator
    use lagrangia_oscillator, only: oscillator_t
    use lagrangia_reference, only: reference_t
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: exact_maps_suite

    real(dp), parameter :: h = 0.25_dp, t0 = 0.5_dp
    real(dp), parameter :: rounding = 8.0_dp*epsilon(1.0_dp)  !! some ten roundings of numbers < 1

    type, extends(gyrating_system_t) :: polynomial_t
        !! \(\ddot q_1 = \tfrac12 - q_1^2 + \tfrac c4q_1\dot q_2 + \tfrac t8 - \tfrac14q_2\),
        !! \(\ddot q_2 = \tfrac12q_1q_2 - \tfrac c8\dot q_1 + \tfrac1{16}\): no mechanical system.
        real(dp) :: c = 0.0_dp
    contains
        procedure :: describe
        procedure :: configure
        procedure :: accelerations
        procedure :: split_accelerations
        procedure :: lagrangian
        procedure :: energy
    end type polynomial_t

contains

    function exact_maps_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("exact_maps")
        call suite%addTest(TestMethod("rk4_is_its_exact_map", rk4_is_its_exact_map))
        call suite%addTest(TestMethod("verlet_is_its_exact_map", verlet_is_its_exact_map))
        call suite%addTest(TestMethod("implicit_methods_are_their_exact_maps", &
                                      implicit_methods_are_their_exact_maps))
        call suite%addTest(TestMethod("boris_is_its_exact_map", boris_is_its_exact_map))
        call suite%addTest(TestMethod("a_closed_form_refuses_impacts", &
                                      a_closed_form_refuses_impacts))
    end function exact_maps_suite

    subroutine check_map(name, compensated, system, q_start, v_start, expected)
        !! Three steps of `name` lead to `expected`.
        character(*), intent(in) :: name
        logical, intent(in) :: compensated
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: q_start(:), v_start(:), expected(:)
        class(integrator_t), allocatable :: method
        type(error_t), allocatable :: error
        real(dp) :: q(system%ndof), v(system%ndof)

        call new_integrator(name, method, error, compensated)
        call method%prepare(system, error)
        q = q_start
        v = v_start
        call method%start(system, t0, q, v)
        call method%advance(system, t0, h, 0_i8, 3_i8, q, v)
        call assertEqual(expected, [q, v], rounding, name)
    end subroutine check_map

    subroutine rk4_is_its_exact_map()
        !! With forces of everything: time, coordinates, velocities.
        real(dp), parameter :: expected(4) = [ &
            0.9730318660437900621830692158439521_dp, -0.06347496732744858891930681644904706_dp, &
            0.2965108965650855252815720150834511_dp, 0.5577513402772974944060746138156855_dp]
        type(polynomial_t) :: system

        system = polynomial_t(ndof=2, c=1.0_dp)
        call check_map("rk4", .false., system, [0.75_dp, -0.5_dp], [0.25_dp, 0.625_dp], expected)
        call check_map("rk4", .true., system, [0.75_dp, -0.5_dp], [0.25_dp, 0.625_dp], expected)
    end subroutine rk4_is_its_exact_map

    subroutine verlet_is_its_exact_map()
        !! In both forms, with forces of time and coordinates.
        real(dp), parameter :: drift_first(4) = [ &
            0.9399445714201531426465274039402931_dp, -0.05202739039159449830949324982852164_dp, &
            0.2174544693944864403055200127723445_dp, 0.5875159872637633168458923802780769_dp]
        real(dp), parameter :: kick_first(4) = [ &
            0.9443711978855731103976722806692123_dp, -0.05452001850049725817370926961302757_dp, &
            0.2149539478307195701112718411925045_dp, 0.587618071968202642107716180895325_dp]
        type(polynomial_t) :: system
        logical :: compensated
        integer :: i

        system = polynomial_t(ndof=2, velocity_forces=.false.)
        do i = 0, 1
            compensated = i == 1
            call check_map("verlet", compensated, system, [0.75_dp, -0.5_dp], &
                           [0.25_dp, 0.625_dp], drift_first)
            call check_map("velocity_verlet", compensated, system, [0.75_dp, -0.5_dp], &
                           [0.25_dp, 0.625_dp], kick_first)
        end do
    end subroutine verlet_is_its_exact_map

    subroutine implicit_methods_are_their_exact_maps()
        !! On the oscillator, where their equations are linear.
        real(dp), parameter :: by_midpoint(2) = [ &
            0.6207736919902263742882294355522085_dp, -0.5728961816937125765816419353131168_dp]
        real(dp), parameter :: by_stormer_verlet(2) = [ &
            0.617671966552734375_dp, -0.5723717212677001953125_dp]
        type(oscillator_t) :: system
        type(error_t), allocatable :: error

        call system%configure([2.0_dp, 3.0_dp], error)
        call check_map("midpoint", .false., system, [0.75_dp], [0.25_dp], by_midpoint)
        call check_map("stormer_verlet", .false., system, [0.75_dp], [0.25_dp], by_stormer_verlet)
    end subroutine implicit_methods_are_their_exact_maps

    subroutine boris_is_its_exact_map()
        !! With pushes and axes of time and place.
        real(dp), parameter :: expected(6) = [ &
            0.6313131593959352864530730239364192_dp, 0.2849747868965634880845884616870247_dp, &
            0.3891312348140769569824990357935332_dp, 0.07502920034506912092297199752538521_dp, &
            0.7870369037537162157215324750978398_dp, -0.4811814512427257352841906900032299_dp]
        type(polynomial_t) :: system

        system = polynomial_t(ndof=3)
        call check_map("boris", .false., system, [0.5_dp, -0.25_dp, 0.75_dp], &
                       [0.25_dp, 0.625_dp, -0.5_dp], expected)
    end subroutine boris_is_its_exact_map

    subroutine a_closed_form_refuses_impacts()
        !! The ball's closed form has them in itself; a run would look for them once more.
        class(system_t), allocatable :: system
        class(reference_t), allocatable :: closed_form
        type(exact_motion_t) :: motion
        type(error_t), allocatable :: error

        call new_system("bouncing_ball", system, error)
        call system%closed_form(0.0_dp, [1.0_dp], [0.0_dp], closed_form)
        call assertTrue(allocated(closed_form), "it has one")
        call new_exact_motion(motion, closed_form)
        call motion%prepare(system, error)
        call assertTrue(allocated(error), "refused")
        if (allocated(error)) call assertEqual("method", error%key)
    end subroutine a_closed_form_refuses_impacts

    pure subroutine describe(self, d)
        !! Nobody asks.
        class(polynomial_t), intent(in) :: self
        type(description_t), intent(out) :: d
    end subroutine describe

    pure subroutine configure(self, values, error)
        !! Nobody asks.
        class(polynomial_t), intent(inout) :: self
        real(dp), intent(in) :: values(:)
        type(error_t), allocatable, intent(out) :: error
    end subroutine configure

    pure subroutine accelerations(self, t, q, v, a)
        !! See the type.
        class(polynomial_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp), intent(out) :: a(self%ndof)

        a(1) = 0.5_dp - q(1)**2 + 0.25_dp*self%c*q(1)*v(2) + 0.125_dp*t - 0.25_dp*q(2)
        a(2) = 0.5_dp*q(1)*q(2) - 0.125_dp*self%c*v(1) + 0.0625_dp
    end subroutine accelerations

    pure subroutine split_accelerations(self, t, q, a, omega)
        !! As above with \(c = 0\), and \(\tfrac t4q_3 - \tfrac18\); an axis that turns.
        class(polynomial_t), intent(in) :: self
        real(dp), intent(in) :: t, q(3)
        real(dp), intent(out) :: a(3), omega(3)

        a(1) = 0.5_dp - q(1)**2 + 0.125_dp*t - 0.25_dp*q(2)
        a(2) = 0.5_dp*q(1)*q(2) + 0.0625_dp
        a(3) = 0.25_dp*t*q(3) - 0.125_dp
        omega = [0.5_dp*q(2), 0.25_dp*t, 0.25_dp*q(1) - 1.0_dp]
    end subroutine split_accelerations

    pure function lagrangian(self, t, q, v) result(l)
        !! Nobody asks.
        class(polynomial_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof), v(self%ndof)
        type(hyperdual_t) :: l

        l = hyperdual_t()
    end function lagrangian

    pure function energy(self, t, q, v) result(e)
        !! Nobody asks.
        class(polynomial_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp) :: e

        e = 0.0_dp
    end function energy
end module test_exact_maps
