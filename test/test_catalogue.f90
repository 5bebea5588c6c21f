module test_catalogue
    !! Walks over the catalogue: names that find what they name, columns that give numbers.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertFalse, &
                     assertGreaterThan, assertTrue
    use lagrangia_catalogue, only: built_in, new_system, nth_system, system_names
    use lagrangia_columns, only: column_names, columns_t, new_columns
    use lagrangia_description, only: description_t, name_length
    use lagrangia_errors, only: error_t
    use lagrangia_integrator, only: integrator_t
    use lagrangia_kinds, only: dp
    use lagrangia_methods, only: method_names, new_integrator, nth_integrator
    use lagrangia_system, only: system_t
    use random_states, only: draw_parameters, draw_state, restart_random
    implicit none (type, external)
    private
    public :: catalogue_suite

contains

    function catalogue_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("catalogue")
        call suite%addTest(TestMethod("every_system_is_found_by_its_name", &
                                      every_system_is_found_by_its_name))
        call suite%addTest(TestMethod("every_column_is_a_number", every_column_is_a_number, &
                                      setUp=restart_random))
        call suite%addTest(TestMethod("every_description_names_columns", &
                                      every_description_names_columns))
        call suite%addTest(TestMethod("every_method_is_found_by_its_name", &
                                      every_method_is_found_by_its_name))
        call suite%addTest(TestMethod("other_names_are_refused", other_names_are_refused))
    end function catalogue_suite

    subroutine every_system_is_found_by_its_name()
        !! And by no other's: names are unique.
        character(name_length), allocatable :: names(:)
        class(system_t), allocatable :: system
        type(description_t) :: d
        type(error_t), allocatable :: error
        integer :: i

        allocate (names, source=system_names())
        call assertEqual(built_in, size(names), "systems")
        call assertEqual(13, built_in, "twelve of the lectures, and a ball")
        do i = 1, size(names)
            call assertEqual(1, count(names == names(i)), trim(names(i))//" is unique")
            call new_system(trim(names(i)), system, error)
            call assertFalse(allocated(error), names(i))
            if (allocated(error)) return
            call system%describe(d)
            call assertEqual(names(i), d%name)
        end do
        call nth_system(size(names) + 1, system)
        call assertFalse(allocated(system), "nothing beyond the end")
    end subroutine every_system_is_found_by_its_name

    subroutine every_column_is_a_number()
        !! At random states, with random parameters and on the edges of their domains: finite,
        !! and a drift that starts at 0.
        character(name_length), allocatable :: names(:)
        class(system_t), allocatable :: system
        type(columns_t) :: columns
        type(description_t) :: d
        type(error_t), allocatable :: error
        real(dp), allocatable :: q(:), v(:), row(:)
        real(dp) :: t
        integer :: i, k, draw

        i = 0
        do
            i = i + 1
            call nth_system(i, system)
            if (.not. allocated(system)) exit
            call system%describe(d)
            do draw = 1, 10
                call draw_parameters(system, edges=mod(draw, 2) == 0)
                call draw_state(system, t, q, v)
                allocate (names, source=column_names(system, .true.))
                call new_columns(columns, names, system, .true., error)
                call assertFalse(allocated(error), trim(d%name)//": its own columns")
                if (allocated(error)) return
                allocate (row(size(names)))
                call columns%evaluate(system, t, q, v, 0.25_dp, row)
                do k = 1, size(names)
                    call assertEqual(1, count(names == names(k)), trim(names(k))//" is unique")
                    call assertTrue(ieee_is_finite(row(k)), trim(d%name)//": "//names(k))
                    if (columns%items(k)%drift) call assertEqual(0.0_dp, row(k), message=names(k))
                end do
                deallocate (names, row)
                if (anyExceptions()) return
            end do
        end do
    end subroutine every_column_is_a_number

    subroutine every_description_names_columns()
        !! What `describe` lists can be written into a scene: coordinates, their rates,
        !! quantities, drifts of what is conserved, positions.
        class(system_t), allocatable :: system
        type(description_t) :: d
        integer :: i, k

        i = 0
        do
            i = i + 1
            call nth_system(i, system)
            if (.not. allocated(system)) exit
            call system%describe(d)
            do k = 1, size(d%coordinates)
                call has(d%coordinates(k)%name, "")
                call has(d%coordinates(k)%name, "_dot")
                call has(d%coordinates(k)%name, "_ddot")
            end do
            do k = 1, size(d%quantities)
                call has(d%quantities(k)%name, "")
                if (d%quantities(k)%conserved) call has(d%quantities(k)%name, "_drift")
            end do
            do k = 1, size(d%points)
                call has("x_"//d%points(k)%name, "")
            end do
            call assertTrue(any(column_names(system, .false.) == "energy_drift") .neqv. &
                            system%time_dependent, trim(d%name)//": energy_drift")
        end do
    contains
        subroutine has(name, ending)
            character(*), intent(in) :: name, ending

            call assertTrue(any(column_names(system, .false.) == trim(name)//ending), &
                            trim(d%name)//": "//trim(name)//ending)
        end subroutine has
    end subroutine every_description_names_columns

    subroutine every_method_is_found_by_its_name()
        !! Unique, with a title and an order.
        character(name_length), allocatable :: names(:)
        class(integrator_t), allocatable :: method
        type(error_t), allocatable :: error
        integer :: i

        allocate (names, source=method_names())
        call assertEqual(14, size(names), "methods")
        do i = 1, size(names)
            call assertEqual(1, count(names == names(i)), trim(names(i))//" is unique")
            call new_integrator(trim(names(i)), method, error)
            call assertFalse(allocated(error), names(i))
            if (allocated(error)) return
            call assertEqual(names(i), method%name)
            call assertGreaterThan(len_trim(method%title), 0, message="its title")
            call assertGreaterThan(method%order, 0, message="its order")
        end do
        call nth_integrator(size(names) + 1, method)
        call assertFalse(allocated(method), "nothing beyond the end")
    end subroutine every_method_is_found_by_its_name

    subroutine other_names_are_refused()
        !! With the nearest, whatever the case; or with all.
        class(system_t), allocatable :: system
        type(error_t), allocatable :: error

        call new_system("Pendulun", system, error)
        call assertTrue(allocated(error), "refused")
        call assertFalse(allocated(system), "no system")
        if (.not. allocated(error)) return
        call assertEqual("unknown system 'Pendulun'; did you mean 'pendulum'?", error%message)
        call new_system("", system, error)
        call assertTrue(allocated(error), "refused")
        if (.not. allocated(error)) return
        call assertEqual(1, index(error%message, "unknown system ''; there are oscillator, "), &
                         error%message)
    end subroutine other_names_are_refused
end module test_catalogue
