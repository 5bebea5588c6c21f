module test_systems
    !! Walks over the catalogue: a new system is tested the day it is listed.
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertFalse
    use lagrangia_catalogue, only: nth_system, system_names
    use lagrangia_description, only: between, description_t, name_length, nonnegative, &
                                     parameter_t, positive, real_number, real_vector, &
                                     whole_number
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp
    use lagrangia_reference, only: reference_t
    use lagrangia_system, only: default_values, reduced_t, system_t
    use random_states, only: draw_parameters, draw_state, restart_random
    use reference_checks, only: check_reference
    use system_checks, only: check_system
    implicit none (type, external)
    private
    public :: systems_suite

contains

    function systems_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("systems")
        call suite%addTest(TestMethod("every_system_keeps_its_claims", &
                                      every_system_keeps_its_claims, setUp=restart_random))
        call suite%addTest(TestMethod("every_closed_form_solves_its_equations", &
                                      every_closed_form_solves_its_equations, setUp=restart_random))
        call suite%addTest(TestMethod("domains_in_words", domains_in_words))
        call suite%addTest(TestMethod("scales_have_their_units", scales_have_their_units, &
                                      setUp=restart_random))
    end function systems_suite

    subroutine every_system_keeps_its_claims()
        !! See `system_checks`: exactly so many claims of each.
        integer, parameter :: expected(*) = [28, 32, 30, 32, 35, 34, 46, 40, 32, 31, 37, 22, 30]
        class(system_t), allocatable :: system
        character(name_length), allocatable :: names(:)
        integer :: i, claims

        allocate (names, source=system_names())
        call assertEqual(size(expected), size(names), "systems")
        do i = 1, min(size(expected), size(names))
            call nth_system(i, system)
            call check_system(system, claims)
            call assertEqual(expected(i), claims, "claims of "//names(i))
        end do
    end subroutine every_system_keeps_its_claims

    subroutine domains_in_words()
        !! Every form; a right angle has a name on both sides of zero, half of one and two have not.
        type(parameter_t) :: p
        real(dp), parameter :: right = acos(0.0_dp)

        p = real_number("a", "1", "", 1.0_dp)
        call assertEqual("any finite number", p%domain())
        p = real_vector("a", "1", "", [1.0_dp, 2.0_dp, 3.0_dp])
        call assertEqual("any finite number", p%domain())
        p = positive("a", "1", "", 1.0_dp)
        call assertEqual("greater than 0.0", p%domain())
        p = nonnegative("a", "1", "", 1.0_dp)
        call assertEqual("at least 0.0", p%domain())
        p = between("a", "1", "", 0.5_dp, -0.25_dp, 1.5_dp)
        call assertEqual("from -0.25 to 1.5", p%domain())
        p%open_lower = .true.
        call assertEqual("from -0.25 to 1.5, above -0.25", p%domain())
        p = between("a", "rad", "", 0.5_dp, -right, right)
        call assertEqual("from -pi/2 to pi/2", p%domain())
        p = between("a", "rad", "", 0.5_dp, -2.0_dp, 2.0_dp)
        call assertEqual("from -2.0 to 2.0", p%domain())
        p = whole_number("a", "", 2, 7)
        call assertEqual("a whole number from 1 to 7", p%domain())
    end subroutine domains_in_words

    subroutine scales_have_their_units()
        !! In grams, or with another metre, second or coulomb, every parameter is another number,
        !! and so is every scale, by the power that its unit says. Powers of two change no digit.
        !! Three are left out that have no length of their own, and take 1 m or 1 m/s.
        class(system_t), allocatable :: system
        class(reduced_t), allocatable :: reduced
        integer :: i, judged

        judged = 0
        i = 0
        do
            i = i + 1
            call nth_system(i, system)
            if (.not. allocated(system)) exit
            call draw_parameters(system, edges=.false.)
            call judge(system, judged)
            call system%reduce(reduced)
            if (allocated(reduced)) call judge(reduced, judged)
        end do
        call assertEqual(19, judged, "scales judged")
    end subroutine scales_have_their_units

    subroutine judge(system, judged)
        !! The scales of one system.
        class(system_t), intent(inout) :: system
        integer, intent(inout) :: judged
        type(description_t) :: d, other
        type(error_t), allocatable :: error
        real(dp), allocatable :: values(:)
        integer :: first, k

        call system%describe(d)
        if (any(d%name == [character(name_length) :: "charged_particle", "rotating_wire", &
                           "bouncing_ball"])) return
        allocate (values, source=default_values(d))
        first = 1
        do k = 1, size(d%parameters)
            associate (p => d%parameters(k))
                values(first:first + p%count - 1) = values(first:first + p%count - 1)* &
                                                    in_other_units(trim(p%unit))
                first = first + p%count
            end associate
        end do
        call system%configure(values, error)
        call assertFalse(allocated(error), trim(d%name))
        call system%describe(other)
        call assertEqual(d%energy_scale*in_other_units("J"), other%energy_scale, 0.0_dp, &
                         trim(d%name)//": energy")
        judged = judged + 1
        do k = 1, size(d%quantities)
            associate (here => d%quantities(k), there => other%quantities(k))
                if (.not. here%scale > 0.0_dp) cycle
                call assertEqual(here%scale*in_other_units(trim(here%unit)), there%scale, 0.0_dp, &
                                 trim(d%name)//": "//trim(here%name))
                judged = judged + 1
            end associate
        end do
    end subroutine judge

    recursive function in_other_units(unit) result(factor)
        !! Of `kg m^2/s`: what is over the first slash, over what is under it.
        character(*), intent(in) :: unit
        real(dp) :: factor
        integer :: at

        at = index(unit, "/")
        if (at > 0) then
            factor = in_other_units(unit(:at - 1))/in_other_units(unit(at + 1:))
            return
        end if
        at = index(trim(unit), " ")
        if (at > 0) then
            factor = in_other_units(unit(:at - 1))*in_other_units(unit(at + 1:))
            return
        end if
        at = index(unit, "^")
        if (at > 0) then
            factor = in_other_units(unit(:at - 1))**(iachar(unit(at + 1:at + 1)) - iachar("0"))
            return
        end if
        select case (unit)
        case ("kg"); factor = 2.0_dp
        case ("m"); factor = 8.0_dp
        case ("s"); factor = 0.25_dp
        case ("N"); factor = in_other_units("kg m/s^2")
        case ("J"); factor = in_other_units("kg m^2/s^2")
        case default; factor = 1.0_dp  ! 1, rad, a number of bobs
        end select
    end function in_other_units

    subroutine every_closed_form_solves_its_equations()
        !! From random states, where the closed form covers them.
        class(system_t), allocatable :: system
        class(reference_t), allocatable :: reference
        type(description_t) :: d
        real(dp), allocatable :: q(:), v(:)
        real(dp) :: t
        integer :: i, k, found

        found = 0
        i = 0
        do
            i = i + 1
            call nth_system(i, system)
            if (.not. allocated(system)) exit
            call system%describe(d)
            do k = 1, 5
                call draw_parameters(system, edges=.false.)
                call draw_state(system, t, q, v)
                call system%closed_form(t, q, v, reference)
                if (.not. allocated(reference)) cycle
                if (.not. reference%has_state) cycle
                found = found + 1
                call check_reference(reference, system, t, q, v, trim(d%name))
            end do
            if (anyExceptions()) return
        end do
        call assertEqual(38, found, "closed forms checked")
    end subroutine every_closed_form_solves_its_equations
end module test_systems
