module test_columns
    !! Every kind of column, what it is compared with, and what is not a column.
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertTrue
    use lagrangia_cart_pendulum, only: cart_pendulum_t
    use lagrangia_columns, only: column_names, columns_t, new_columns
    use lagrangia_description, only: name_length
    use lagrangia_driven_pendulum, only: driven_pendulum_t
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_oscillator, only: oscillator_t
    use lagrangia_pendulum, only: pendulum_t
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: columns_suite

contains

    function columns_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("columns")
        call suite%addTest(TestMethod("every_kind_has_its_value", every_kind_has_its_value))
        call suite%addTest(TestMethod("columns_have_units", columns_have_units))
        call suite%addTest(TestMethod("energy_is_evaluated_once_a_row", &
                                      energy_is_evaluated_once_a_row))
        call suite%addTest(TestMethod("drift_is_relative_to_the_start", &
                                      drift_is_relative_to_the_start))
        call suite%addTest(TestMethod("drift_is_relative_to_the_natural_size", &
                                      drift_is_relative_to_the_natural_size))
        call suite%addTest(TestMethod("drift_without_any_size_is_absolute", &
                                      drift_without_any_size_is_absolute))
        call suite%addTest(TestMethod("only_what_is_conserved_drifts", &
                                      only_what_is_conserved_drifts))
        call suite%addTest(TestMethod("wrong_columns_are_refused", wrong_columns_are_refused))
    end function columns_suite

    subroutine every_kind_has_its_value()
        !! In the order asked for; a cart-pendulum at a state where the formulae are short.
        character(name_length), parameter :: wanted(*) = [character(name_length) :: &
            "y_bob", "theta_ddot", "x", "error", "theta_dot", "t", "energy", "p_x", "x_bob", &
            "theta", "x_dot", "x_ddot", "p_x_drift", "x_cart"]
        real(dp), parameter :: m1 = 2.0_dp, m2 = 3.0_dp, l = 1.25_dp, g = 9.81_dp
        real(dp) :: row(size(wanted)), q(2), v(2)
        type(cart_pendulum_t) :: system
        type(columns_t) :: columns
        type(error_t), allocatable :: error
        real(dp), parameter :: rounding = 20*epsilon(1.0_dp)*g*m2

        call system%configure([m1, m2, l, g], error)
        call new_columns(columns, wanted, system, .true., error)
        call assertFalse(allocated(error), "columns")
        if (allocated(error)) return
        q = [0.5_dp, 0.5_dp*acos(-1.0_dp)]  ! the rod is level: sin = 1, cos = 0
        v = [0.75_dp, -2.0_dp]
        call columns%evaluate(system, 7.0_dp, q, v, 0.125_dp, row)
        call assertEqual(0.0_dp, row(1), rounding, "y_bob = -l cos")
        call assertEqual(-g/l, row(2), rounding, "theta_ddot: (m1 + m2) g/(l (m1 + m2))")
        call assertEqual([0.5_dp, 0.125_dp, -2.0_dp, 7.0_dp], row(3:6))
        call assertEqual(0.5_dp*(m1 + m2)*0.75_dp**2 + 0.5_dp*m2*l**2*4.0_dp, row(7), rounding, &
                         "energy")
        call assertEqual((m1 + m2)*0.75_dp, row(8), rounding, "p_x")
        call assertEqual(0.5_dp + l, row(9), rounding, "x_bob = x + l sin")
        call assertEqual([q(2), 0.75_dp], row(10:11))
        call assertEqual(m2*l*4.0_dp/(m1 + m2), row(12), rounding, "x_ddot")
        call assertEqual(0.0_dp, row(13), message="no drift at the start")
        call assertEqual(0.5_dp, row(14), message="x_cart")
    end subroutine every_kind_has_its_value

    subroutine columns_have_units()
        !! Those of the coordinate, per second, per second squared; a drift has none.
        character(name_length), parameter :: wanted(*) = [character(name_length) :: &
            "t", "x", "x_dot", "x_ddot", "theta", "theta_dot", "theta_ddot", "energy", &
            "energy_drift", "p_x", "p_x_drift", "x_bob", "error"]
        character(8), parameter :: units(*) = [character(8) :: &
            "s", "m", "m/s", "m/s^2", "rad", "rad/s", "rad/s^2", "J", "1", "kg m/s", "1", "m", "1"]
        type(cart_pendulum_t) :: system
        type(columns_t) :: columns
        type(error_t), allocatable :: error

        call system%configure([2.0_dp, 3.0_dp, 1.25_dp, 9.81_dp], error)
        call new_columns(columns, wanted, system, .true., error)
        call assertEqual(wanted, columns%names(size(wanted)))
        call assertEqual(units, columns%units(size(wanted)))
        call assertEqual(["t", "x"], columns%names(2))
    end subroutine columns_have_units

    subroutine energy_is_evaluated_once_a_row()
        !! However many columns need it, and never when none does.
        type(pendulum_t) :: system
        type(columns_t) :: both, none
        type(error_t), allocatable :: error
        real(dp) :: row(3)
        integer :: i

        call system%configure([0.5_dp, 1.25_dp, 9.81_dp], error)
        call new_columns(both, [character(name_length) :: "energy_drift", "t", "energy"], system, &
                         .false., error)
        call new_columns(none, [character(name_length) :: "theta", "tension", "x_bob"], system, &
                         .false., error)
        do i = 1, 4
            call both%evaluate(system, 0.0_dp, [1.0_dp], [0.0_dp], 0.0_dp, row)
            call none%evaluate(system, 0.0_dp, [1.0_dp], [0.0_dp], 0.0_dp, row)
        end do
        call assertEqual(4_i8, both%energy_evaluations)
        call assertEqual(0_i8, none%energy_evaluations)
    end subroutine energy_is_evaluated_once_a_row

    subroutine check_drift(system, name, q, v, expected)
        !! The drift of `name` from the first of two states `q(:, i)` to the second.
        class(system_t), intent(in) :: system
        character(*), intent(in) :: name
        real(dp), intent(in) :: q(2), v(2), expected
        type(columns_t) :: columns
        type(error_t), allocatable :: error
        character(name_length) :: names(1)
        real(dp) :: row(1)

        names(1) = name
        call new_columns(columns, names, system, .false., error)
        call assertFalse(allocated(error), name)
        if (allocated(error)) return
        call columns%evaluate(system, 0.0_dp, q(1:1), v(1:1), 0.0_dp, row)
        call assertEqual(0.0_dp, row(1), message="at the start")
        call columns%evaluate(system, 1.0_dp, q(2:2), v(2:2), 0.0_dp, row)
        call assertEqual(expected, row(1), 4*epsilon(1.0_dp)*abs(expected), name)
    end subroutine check_drift

    subroutine drift_is_relative_to_the_start()
        !! Where that is larger than the natural size: here m l^2 v^2/2 = 16 beside m g l = 2.
        type(pendulum_t) :: system
        type(error_t), allocatable :: error
        real(dp), parameter :: level = 0.5_dp*acos(-1.0_dp)

        call system%configure([0.5_dp, 2.0_dp, 2.0_dp], error)
        call check_drift(system, "energy_drift", [level, level], [-4.0_dp, 2.0_dp], -0.75_dp)
    end subroutine drift_is_relative_to_the_start

    subroutine drift_is_relative_to_the_natural_size()
        !! m g l = 2, where the start is 0 or smaller; the sign is that of the change.
        type(pendulum_t) :: system
        type(error_t), allocatable :: error
        real(dp), parameter :: level = 0.5_dp*acos(-1.0_dp)

        call system%configure([0.5_dp, 2.0_dp, 2.0_dp], error)
        call check_drift(system, "energy_drift", [level, level], [0.0_dp, 1.0_dp], 0.5_dp)
        call check_drift(system, "energy_drift", [level, level], [0.5_dp, 1.0_dp], 0.375_dp)
        call check_drift(system, "energy_drift", [level, level], [0.5_dp, 0.0_dp], -0.125_dp)
    end subroutine drift_is_relative_to_the_natural_size

    subroutine drift_without_any_size_is_absolute()
        !! The momentum of a free mass at rest has no size to compare with.
        type(oscillator_t) :: system
        type(error_t), allocatable :: error

        call system%configure([2.0_dp, 0.0_dp], error)
        call check_drift(system, "p_x_drift", [0.0_dp, 0.0_dp], [0.0_dp, 0.25_dp], 0.5_dp)
        call check_drift(system, "p_x_drift", [0.0_dp, 0.0_dp], [-8.0_dp, -4.0_dp], 0.5_dp)
    end subroutine drift_without_any_size_is_absolute

    subroutine only_what_is_conserved_drifts()
        !! With these parameters: a spring ends the momentum's, a drive the energy's.
        type(oscillator_t) :: oscillator
        type(driven_pendulum_t) :: driven
        type(error_t), allocatable :: error

        call oscillator%configure([2.0_dp, 3.0_dp], error)
        call assertFalse(any(column_names(oscillator, .true.) == "p_x_drift"), "with a spring")
        call oscillator%configure([2.0_dp, 0.0_dp], error)
        call assertTrue(any(column_names(oscillator, .true.) == "p_x_drift"), "without")
        call assertTrue(any(column_names(oscillator, .true.) == "energy_drift"), "energy")
        call driven%configure([1.0_dp, 2.0_dp, 9.81_dp, 0.1_dp, 30.0_dp], error)
        call assertFalse(any(column_names(driven, .true.) == "energy_drift"), "driven")
        call assertTrue(any(column_names(driven, .true.) == "energy"), "its energy function")
        call driven%configure([1.0_dp, 2.0_dp, 9.81_dp, 0.0_dp, 30.0_dp], error)
        call assertTrue(any(column_names(driven, .true.) == "energy_drift"), "not driven")
        call assertFalse(any(column_names(driven, .false.) == "error"), "no truth")
    end subroutine only_what_is_conserved_drifts

    subroutine wrong_columns_are_refused()
        !! With the nearest name, or all of them; the place in the list is told.
        type(oscillator_t) :: system
        type(driven_pendulum_t) :: driven
        type(error_t), allocatable :: error

        call system%configure([2.0_dp, 3.0_dp], error)
        call refused(system, [character(8) :: "t", "x", "x_dt"], 3, &
                     "unknown column 'x_dt'; did you mean 'x_dot'?")
        call refused(system, [character(8) :: "velocity"], 1, &
                     "unknown column 'velocity'; did you mean 'x_dot'?")
        call refused(system, [character(8) :: "speed"], 1, &
                     "unknown column 'speed'; did you mean 'x_dot'?")
        call refused(system, [character(8) :: "alpha"], 1, &
                     "unknown column 'alpha'; did you mean 'x_ddot'?")
        call refused(system, [character(8) :: "position"], 1, &
                     "unknown column 'position'; did you mean 'x'?")
        call refused(system, [character(8) :: "time"], 1, &
                     "unknown column 'time'; did you mean 't'?")
        call refused(system, [character(8) :: "pressure"], 1, &
                     "unknown column 'pressure'; oscillator has t, x, x_dot, x_ddot, energy, "// &
                     "energy_drift, force, p_x, x_mass")
        call refused(system, [character(8) :: "x", "t", "x"], 3, "the column is there already")
        call refused(system, [character(8) :: "t", "error"], 2, &
                     "column 'error': oscillator has no closed form from this start; with "// &
                     "expect_error it is estimated")
        call driven%configure([1.0_dp, 2.0_dp, 9.81_dp, 0.1_dp, 30.0_dp], error)
        call refused(driven, [character(16) :: "energy_drift"], 1, "column 'energy_drift': the "// &
                     "energy of this driven_pendulum is not conserved, for L contains the "// &
                     "time; there is 'energy_balance_drift'")
    end subroutine wrong_columns_are_refused

    subroutine refused(system, names, element, message)
        !! Assert that `names` are refused in these words, because of one element.
        class(system_t), intent(in) :: system
        character(*), intent(in) :: names(:), message
        integer, intent(in) :: element
        type(columns_t) :: columns
        type(error_t), allocatable :: error

        call new_columns(columns, names, system, .false., error)
        call assertTrue(allocated(error), "refused: "//message)
        if (.not. allocated(error)) return
        call assertEqual(message, error%message)
        call assertEqual("columns", error%key)
        call assertEqual(element, error%element)
    end subroutine refused
end module test_columns
