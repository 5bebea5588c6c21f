module test_compensated
    !! Compensated sums: what they gain, and how a scene asks for them.
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertGreaterThan, &
                     assertLessThan, assertTrue
    use lagrangia_atwood, only: atwood_t
    use lagrangia_command_line, only: word_t
    use lagrangia_description, only: description_t, name_length
    use lagrangia_errors, only: error_t
    use lagrangia_integrator, only: integrator_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_methods, only: method_names, new_integrator
    use lagrangia_oscillator, only: oscillator_t
    use lagrangia_scene, only: scene_lines, scene_t
    use lagrangia_summation, only: add
    use lagrangia_system, only: system_t
    use scene_runs, only: read_and_plan
    implicit none (type, external)
    private
    public :: compensated_suite

contains

    function compensated_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("compensated")
        call suite%addTest(TestMethod("a_sum_keeps_what_rounding_drops", &
                                      a_sum_keeps_what_rounding_drops))
        call suite%addTest(TestMethod("verlet_keeps_its_own_energy_longer", &
                                      verlet_keeps_its_own_energy_longer))
        call suite%addTest(TestMethod("constant_accelerations_lose_nothing", &
                                      constant_accelerations_lose_nothing))
        call suite%addTest(TestMethod("as_many_evaluations_as_without", &
                                      as_many_evaluations_as_without))
        call suite%addTest(TestMethod("low_parts_belong_to_their_state", &
                                      low_parts_belong_to_their_state))
        call suite%addTest(TestMethod("a_scene_may_ask_for_it", a_scene_may_ask_for_it))
    end function compensated_suite

    subroutine a_sum_keeps_what_rounding_drops()
        !! A million times a tenth, whose own rounding, 5.6e-18, is part of the exact sum; terms
        !! that each would leave 1 as it is; terms larger than the sum.
        real(dp) :: x, low
        integer :: i

        x = 0.0_dp
        low = 0.0_dp
        do i = 1, 1000000
            call add(x, low, 0.1_dp)
        end do
        call assertEqual(100000.0_dp, x, message="the nearest number to the sum")
        call assertEqual(5.55111512312578e-12_dp, low, 1e-16_dp, "and the rest")

        x = 1.0_dp
        low = 0.0_dp
        do i = 1, 1024
            call add(x, low, 2.0_dp**(-60))
        end do
        call assertEqual(1.0_dp + 2.0_dp**(-50), x, message="1 + 1024/2**60")

        x = 2.0_dp**(-60)
        low = 0.0_dp
        call add(x, low, 1.0_dp)
        call assertEqual([1.0_dp, 2.0_dp**(-60)], [x, low], message="a term larger than the sum")
    end subroutine a_sum_keeps_what_rounding_drops

    subroutine verlet_keeps_its_own_energy_longer()
        !! \((1-\omega^2h^2/4)v^2 + \omega^2x^2\), which exact arithmetic conserves, is lost by
        !! rounding as the root of the number of steps: 1e-16 sqrt(1e6) = 1e-13. Compensated
        !! sums leave the rounding of the result, and of the coefficients.
        real(dp) :: plain, compensated

        plain = loss("verlet", .false., 1000_i8)
        compensated = loss("verlet", .true., 10000_i8)
        call assertGreaterThan(plain, 1e-13_dp, message="plain sums lose")
        call assertLessThan(compensated, 3e-14_dp, message="compensated sums do not, in 1e7 steps")
        call assertLessThan(loss("velocity_verlet", .true., 1000_i8), 2e-14_dp, &
                            message="nor do they here")
    end subroutine verlet_keeps_its_own_energy_longer

    function loss(name, compensated, thousands) result(worst)
        !! Largest relative change of the energy that exact steps, so many thousands, conserve.
        character(*), intent(in) :: name
        logical, intent(in) :: compensated
        integer(i8), intent(in) :: thousands
        real(dp) :: worst
        real(dp), parameter :: h = 0.1_dp
        class(integrator_t), allocatable :: method
        type(oscillator_t) :: system
        type(error_t), allocatable :: error
        real(dp) :: q(1), v(1), start
        integer(i8) :: k

        call new_integrator(name, method, error, compensated)
        call system%configure([1.0_dp, 1.0_dp], error)
        call method%prepare(system, error)
        q = 1.0_dp
        v = 0.3_dp
        call method%start(system, 0.0_dp, q, v)
        start = energy()
        worst = 0.0_dp
        do k = 0, thousands - 1
            call method%advance(system, 0.0_dp, h, 1000*k, 1000_i8, q, v)
            worst = max(worst, abs(energy()/start - 1.0_dp))
        end do
    contains
        function energy()
            real(dp) :: energy

            if (name == "verlet") then
                energy = (1.0_dp - 0.25_dp*h**2)*v(1)**2 + q(1)**2
            else
                energy = v(1)**2 + (1.0_dp - 0.25_dp*h**2)*q(1)**2
            end if
        end function energy
    end function loss

    subroutine constant_accelerations_lose_nothing()
        !! Atwood's machine: every method is exact, and what remains is the sum's rounding. A step
        !! that is no binary number is rounded itself: one part in 2**53 of the way.
        character(16), parameter :: names(*) = [character(16) :: &
            "rk4", "verlet", "velocity_verlet", "suzuki4", "kahan_li8"]
        class(integrator_t), allocatable :: method
        type(atwood_t) :: system
        type(error_t), allocatable :: error
        type(description_t) :: d
        real(dp) :: q(1), v(1), way(2)
        integer :: i, k

        call system%configure([3.0_dp, 2.0_dp, 9.81_dp, 0.0_dp, 0.1_dp, 0.0_dp], error)
        call system%describe(d)
        do i = 1, size(names)
            do k = 1, 2
                call new_integrator(trim(names(i)), method, error, compensated=k == 2)
                call method%prepare(system, error)
                q = 0.3_dp
                v = 0.7_dp
                call method%start(system, 0.0_dp, q, v)
                call method%advance(system, 0.0_dp, 1e-4_dp, 0_i8, 100000_i8, q, v)
                way(k) = abs(q(1)/(0.3_dp + 7.0_dp + 0.5_dp*1.962_dp*100.0_dp) - 1.0_dp)
            end do
            call assertLessThan(way(2), 1e-15_dp, message=trim(names(i))//": compensated")
            call assertGreaterThan(way(1), 2.0_dp*way(2), message=trim(names(i))//": plain")
        end do
    end subroutine constant_accelerations_lose_nothing

    subroutine as_many_evaluations_as_without()
        !! Sums that keep more cost additions only, and each is counted: of every method that has
        !! such sums, in one go or in two.
        class(integrator_t), allocatable :: method
        character(name_length), allocatable :: names(:)
        type(oscillator_t) :: system
        type(error_t), allocatable :: error
        real(dp) :: q(1), v(1)
        integer(i8) :: counts(2)
        integer :: i, k, tried

        call system%configure([1.3_dp, 0.7_dp], error)
        allocate (names, source=method_names())
        tried = 0
        do i = 1, size(names)
            counts = 0
            do k = 1, 2
                call new_integrator(trim(names(i)), method, error, compensated=k == 2)
                if (.not. allocated(error)) call method%prepare(system, error)
                if (allocated(error)) exit
                q = 1.0_dp
                v = 0.3_dp
                call method%start(system, 0.0_dp, q, v)
                call method%advance(system, 0.0_dp, 0.1_dp, 0_i8, 3_i8, q, v)
                call method%advance(system, 0.0_dp, 0.1_dp, 3_i8, 7_i8, q, v)
                counts(k) = method%evaluations
            end do
            if (allocated(error)) cycle
            tried = tried + 1
            call assertGreaterThan(counts(1), 9_i8, message=trim(names(i))//": counted")
            call assertEqual(counts(1), counts(2), message=trim(names(i))//": no more")
        end do
        call assertEqual(10, tried, message="methods with such sums")
    end subroutine as_many_evaluations_as_without

    subroutine low_parts_belong_to_their_state()
        !! A state from elsewhere, as after a bounce, is taken as it is.
        character(16), parameter :: names(*) = [character(16) :: "rk4", "verlet", "velocity_verlet"]
        class(integrator_t), allocatable :: method
        type(oscillator_t) :: system
        type(error_t), allocatable :: error
        real(dp), dimension(1) :: q, v, q_new, v_new
        integer :: i

        call system%configure([1.3_dp, 0.7_dp], error)
        do i = 1, size(names)
            call new_integrator(trim(names(i)), method, error, compensated=.true.)
            call method%prepare(system, error)
            q = 1.0_dp
            v = 0.3_dp
            call method%start(system, 0.0_dp, q, v)
            call method%advance(system, 0.0_dp, 0.1_dp, 0_i8, 1000_i8, q, v)
            v = -0.8_dp*v
            q_new = q
            v_new = v
            call method%start(system, 100.0_dp, q, v)
            call method%advance(system, 0.0_dp, 0.1_dp, 1000_i8, 1000_i8, q, v)
            call method%prepare(system, error)
            call method%start(system, 100.0_dp, q_new, v_new)
            call method%advance(system, 0.0_dp, 0.1_dp, 1000_i8, 1000_i8, q_new, v_new)
            call assertEqual(q_new, q, message=trim(names(i))//": q")
            call assertEqual(v_new, v, message=trim(names(i))//": v")
        end do
    end subroutine low_parts_belong_to_their_state

    subroutine a_scene_may_ask_for_it()
        !! The key is read, echoed, and refused where the method has nothing to offer.
        character(*), parameter :: nl = new_line("a")
        type(scene_t) :: scene
        class(system_t), allocatable :: system
        type(description_t) :: d
        type(error_t), allocatable :: error

        call read_and_plan(text("verlet", "compensated = .true."), "a.nml", [word_t ::], scene, &
                         system, error)
        call assertFalse(allocated(error), "a scene with compensated sums")
        call assertTrue(scene%compensated, "compensated")
        call system%describe(d)
        call assertTrue(any(scene_lines(scene, d) == "  compensated = .true."), "echo")
        call read_and_plan(text("verlet", ""), "a.nml", [word_t ::], scene, system, error)
        call assertFalse(allocated(error) .or. scene%compensated, "off unless asked for")
        call read_and_plan(text("midpoint", nl//"compensated = .true."), "a.nml", [word_t ::], &
                         scene, system, error)
        call assertTrue(allocated(error), "midpoint refuses")
        if (.not. allocated(error)) return
        call assertEqual(1, index(error%message, "a.nml:2:15: &scene: compensated = .true.: "// &
                                  "midpoint has no compensated sums; these have: rk4, verlet, "), &
                         error%message)
    contains
        function text(method, line)
            character(*), intent(in) :: method, line
            character(:), allocatable :: text

            text = "&scene system = 'oscillator', method = '"//method//"', "//line// &
                   " dt = 0.1, duration = 1.0, q = 1.0 /"//nl//"&oscillator /"//nl
        end function text
    end subroutine a_scene_may_ask_for_it
end module test_compensated
