module test_printed_formulae
    !! Formulas outside of a description's formulas: defaults, titles of closed forms, a note.
    !! `audit_formulas` has the rest.
    use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
    use formula, only: formula_value, names_t
    use funit, only: TestMethod, TestSuite, assertEqual, assertTrue
    use lagrangia_catalogue, only: new_system, nth_system, system_names
    use lagrangia_description, only: description_t
    use lagrangia_errors, only: error_t
    use lagrangia_hyperdual, only: hyperdual, hyperdual_t
    use lagrangia_kinds, only: dp
    use lagrangia_reference, only: reference_t
    use lagrangia_system, only: system_t
    use lagrangia_text, only: to_text
    use printed_names, only: name_state
    use random_states, only: draw_parameters, draw_state, restart_random
    implicit none (type, external)
    private
    public :: printed_formulae_suite

    integer, parameter :: draws = 20

contains

    function printed_formulae_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("printed_formulae")
        call suite%addTest(TestMethod("formulae_are_read", formulae_are_read))
        call suite%addTest(TestMethod("defaults_are_their_formulae", defaults_are_their_formulae, &
                                      setUp=restart_random))
        call suite%addTest(TestMethod("the_ball_does_what_it_says", the_ball_does_what_it_says))
        call suite%addTest(TestMethod("closed_forms_are_what_they_say", &
                                      closed_forms_are_what_they_say, setUp=restart_random))
    end function printed_formulae_suite

    subroutine formulae_are_read()
        !! Products side by side, division, powers, brackets, names that begin alike.
        type(names_t) :: names

        call names%set("m", 2.0_dp)
        call names%set("m1", 3.0_dp)
        call names%set("theta", 0.5_dp)
        call names%set("theta_dot", 7.0_dp)
        call names%set("T_(k+1)", 5.0_dp)
        call is("m/2 theta_dot^2", 49.0_dp)
        call is("m/(2 m1) - 1/2*4", 1.0_dp/3.0_dp - 2.0_dp)
        call is("- m1 sin(theta)^2 + m cos(theta)", -3.0_dp*sin(0.5_dp)**2 + 2.0_dp*cos(0.5_dp))
        call is("(m1 - m)(m1 + m) T_(k+1)", 25.0_dp)
        call is("exp(-theta m) sqrt(4)", 2.0_dp*exp(-1.0_dp))
        call is("2(m^2 - 1)^2", 18.0_dp)
        call is_not("m2")
        call is_not("theta_ddot")
        call is_not("m (")
        call is_not("m + of the plane")
        call is_not("")
    contains
        subroutine is(text, expected)
            character(*), intent(in) :: text
            real(dp), intent(in) :: expected
            real(dp) :: value, size_of
            logical :: ok

            call formula_value(text, names, value, size_of, ok)
            call assertTrue(ok, text)
            call assertEqual(expected, value, 1e-14_dp*abs(expected), text)
        end subroutine is

        subroutine is_not(text)
            character(*), intent(in) :: text
            real(dp) :: value, size_of
            logical :: ok

            call formula_value(text, names, value, size_of, ok)
            call assertTrue(.not. ok, "'"//text//"' is no formula")
        end subroutine is_not
    end subroutine formulae_are_read

    subroutine defaults_are_their_formulae()
        !! A parameter that is left to others, as `m r^2/2`: the same L as with the value of what
        !! is printed.
        character(*), parameter :: expected = "rolling_disk%i_roll rolling_disk%i_yaw "
        class(system_t), allocatable :: system
        type(description_t) :: d
        type(error_t), allocatable :: error
        type(hyperdual_t) :: left_out, given
        type(names_t) :: names
        character(:), allocatable :: found
        real(dp), allocatable :: values(:), q(:), v(:)
        real(dp) :: t, size_of
        logical :: ok
        integer :: i, k, n

        found = ""
        do i = 1, size(system_names())
            call nth_system(i, system)
            call system%describe(d)
            do k = 1, size(d%parameters)
                if (d%parameters(k)%computed == "") cycle
                call draw_parameters(system, .false.)
                call draw_state(system, t, q, v)
                call system%describe(d)
                found = found//trim(d%name)//"%"//trim(d%parameters(k)%name)//" "
                allocate (values(size(d%parameters)))
                values = d%parameters%value(1)
                do n = 1, size(d%parameters)
                    call names%set(trim(d%parameters(n)%name), values(n))
                end do
                values(k) = ieee_value(t, ieee_quiet_nan)
                call system%configure(values, error)
                left_out = system%lagrangian(hyperdual(t), hyperdual(q), hyperdual(v))
                call formula_value(trim(d%parameters(k)%computed), names, values(k), size_of, ok)
                call assertTrue(ok, "read: "//d%parameters(k)%computed)
                call system%configure(values, error)
                given = system%lagrangian(hyperdual(t), hyperdual(q), hyperdual(v))
                call assertEqual(given%re, left_out%re, 1e-13_dp*abs(given%re), &
                                 trim(d%name)//": "//d%parameters(k)%computed)
                deallocate (values)
            end do
        end do
        call assertEqual(expected, found)
    end subroutine defaults_are_their_formulae

    subroutine the_ball_does_what_it_says()
        !! Its note of the floor: an impact, and rest.
        class(system_t), allocatable :: system
        type(description_t) :: d
        type(error_t), allocatable :: error
        real(dp), parameter :: m = 0.7_dp, g = 9.81_dp, restitution = 0.6_dp
        real(dp) :: q(1), v(1), a(1)

        call new_system("bouncing_ball", system, error)
        call assertTrue(.not. allocated(error), "bouncing_ball")
        if (allocated(error)) return
        call system%configure([m, g, restitution], error)
        call system%describe(d)
        call assertTrue(index(d%notes(1), "In flight lambda = 0, at rest on the floor lambda = "// &
                              "m g; where it meets the floor with y_dot < 0,") == 1, d%notes(1))
        call assertEqual("y_dot becomes - restitution y_dot.", trim(d%notes(2)))
        q = 0.0_dp
        v = -1.5_dp
        call system%impact(1, 0.0_dp, q, v)
        call assertEqual(restitution*1.5_dp, v(1), 1e-15_dp)
        v = 0.0_dp
        call system%accelerations(0.0_dp, q, v, a)
        call assertEqual(0.0_dp, a(1), 0.0_dp)
        call assertEqual(m*g, system%quantity(1, 0.0_dp, q, v), 1e-15_dp)
    end subroutine the_ball_does_what_it_says

    subroutine closed_forms_are_what_they_say()
        !! The titles that are formulae: the motion of the first, what the others define.
        character(13), parameter :: names(4) = [character(13) :: "atwood", "oscillator", &
                                                "rotating_wire", "wedge"]
        integer :: i, k

        do i = 1, size(names)
            do k = 1, draws
                call try_closed_form(trim(names(i)), k)
            end do
        end do
    end subroutine closed_forms_are_what_they_say

    subroutine try_closed_form(name, k)
        !! One draw of parameters, a state and a later time. Each coordinate has a few dozen
        !! operations; angles and exponents of some ten multiply their rounding.
        character(*), intent(in) :: name
        integer, intent(in) :: k
        real(dp), parameter :: rounding = 1e-11_dp
        class(system_t), allocatable :: system
        class(reference_t), allocatable :: reference
        type(error_t), allocatable :: error
        type(names_t) :: letters
        real(dp), allocatable :: q(:), v(:)
        real(dp) :: t, value, size_of, later(2), rates(2)
        integer :: i
        logical :: ok

        call new_system(name, system, error)
        call assertTrue(.not. allocated(error), name)
        if (allocated(error)) return
        call draw_parameters(system, .false.)
        if (name == "oscillator") call draw_damping(system, k)
        call draw_state(system, t, q, v)
        call system%closed_form(0.0_dp, q, v, reference)
        call assertTrue(allocated(reference), name//": a closed form")
        if (.not. allocated(reference)) return
        t = 0.7_dp
        call reference%state_at(t, later(:size(q)), rates(:size(q)))
        call name_state(system, t, q, v, letters)
        call define(trim(reference%title), letters)
        do i = 1, size(q)
            call letters%set("x0", q(i))
            call letters%set("r0", q(i))
            call letters%set("q0", q(i))
            call letters%set("v0", v(i))
            if (name == "wedge") call letters%set("a", letters%value_of("a"//to_text(i)))
            call formula_value(reference%title(:index(reference%title//", ", ", ") - 1), letters, &
                               value, size_of, ok)
            call assertTrue(ok, name//": "//trim(reference%title))
            call assertEqual(later(i), value, rounding*size_of, name//": "//trim(reference%title))
        end do
    end subroutine try_closed_form

    subroutine draw_damping(system, k)
        !! In turn without damping, below the critical one, above, and equal to it.
        class(system_t), intent(inout) :: system
        integer, intent(in) :: k
        real(dp), parameter :: share(0:3) = [0.0_dp, 0.6_dp, 1.7_dp, 1.0_dp]
        type(description_t) :: d
        type(error_t), allocatable :: error
        real(dp) :: critical

        call system%describe(d)
        critical = 0.25_dp*anint(1.0_dp + 8.0_dp*d%parameters(1)%value(1))
        call system%configure([critical, critical, 2.0_dp*share(mod(k, 4))*critical], error)
    end subroutine draw_damping

    recursive subroutine define(text, letters)
        !! `..., letter = formula, omega^2 = formula`, and what a formula calls by a whole name.
        character(*), intent(in) :: text
        type(names_t), intent(inout) :: letters
        real(dp) :: value, size_of
        integer :: comma, equals
        logical :: ok

        equals = index(text, " = ")
        comma = index(text, ", ")
        if (equals > 0 .and. (comma == 0 .or. equals < comma)) then
            if (comma == 0) comma = len(text) + 1
            call formula_value(text(equals + 3:comma - 1), letters, value, size_of, ok)
            call assertTrue(ok, text)
            if (text(:equals - 1) == "omega^2") then
                call letters%set("omega", sqrt(value))
            else
                call letters%set(text(:equals - 1), value)
            end if
        end if
        value = letters%value_of("omega")*letters%value_of("t")
        call letters%set("cosh(omega t)", cosh(value))
        call letters%set("sinh(omega t)", sinh(value))
        if (comma > 0 .and. comma < len(text)) call define(text(comma + 2:), letters)
    end subroutine define
end module test_printed_formulae
