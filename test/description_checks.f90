module description_checks
    !! What every system says of itself is complete, and what it forbids is refused.
    use, intrinsic :: ieee_arithmetic, only: ieee_positive_inf, ieee_quiet_nan, ieee_value
    use funit, only: anyExceptions, assertEqual, assertFalse, assertGreaterThan, assertLessThan, &
                     assertTrue
    use lagrangia_description, only: description_t, formula_length, line_length, name_length, &
                                     parameter_t, quantity_t
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp
    use lagrangia_system, only: default_values, system_t
    implicit none (type, external)
    private
    public :: check_description, check_refusals

contains

    subroutine check_description(system)
        !! Complete, no line cut off, no name used twice, `ndof` as many as coordinates.
        class(system_t), intent(inout) :: system
        type(description_t) :: d
        character(:), allocatable :: name
        character(name_length), allocatable :: names(:)
        type(error_t), allocatable :: error
        integer :: i

        call system%describe(d)
        name = trim(d%name)
        call assertGreaterThan(len(name), 0, message="a system without a name")
        call assertTrue(allocated(d%coordinates), name//": coordinates")
        call assertTrue(allocated(d%parameters), name//": parameters")
        call assertTrue(allocated(d%equations), name//": equations")
        if (anyExceptions()) return
        call system%configure(default_values(d), error)
        call assertFalse(allocated(error), name//": the defaults are allowed")
        if (anyExceptions()) return
        call assertEqual(system%ndof, size(d%coordinates), name//": ndof")
        call check_line(d%title, name//": title")
        call check_line(d%constraint, name//": constraint")
        call check_line(d%source, name//": source")
        do i = 1, size(d%equations)
            call assertLessThan(len_trim(d%equations(i)), formula_length, message=name//": cut off")
        end do
        if (allocated(d%notes)) then
            do i = 1, size(d%notes)
                call check_line(d%notes(i), name//": notes")
            end do
        end if
        do i = 1, size(d%parameters)
            call check_line(d%parameters(i)%meaning, name//": "//trim(d%parameters(i)%name))
        end do
        call check_quantities(d%coordinates, name)
        names = [character(name_length) :: "t", "energy", d%coordinates%name, d%parameters%name]
        if (allocated(d%quantities)) then
            call check_quantities(d%quantities, name)
            names = [names, d%quantities%name]
        end if
        do i = 1, size(names)
            call assertEqual(1, count(names == names(i)), name//": "//trim(names(i))//" is unique")
        end do
    end subroutine check_description

    subroutine check_quantities(items, name)
        !! Each has a name, a unit and a meaning.
        type(quantity_t), intent(in) :: items(:)
        character(*), intent(in) :: name
        integer :: i

        do i = 1, size(items)
            associate (length => len_trim(items(i)%name), unit => len_trim(items(i)%unit))
                call assertGreaterThan(length, 0, message=name//": quantity without name")
                call assertLessThan(length, name_length, message=name//": name cut off")
                call assertGreaterThan(unit, 0, message=name//": quantity without unit")
            end associate
            call check_line(items(i)%meaning, name//": "//trim(items(i)%name))
            call assertLessThan(len_trim(items(i)%formula), formula_length, &
                                message=name//": cut off")
        end do
    end subroutine check_quantities

    subroutine check_line(text, message)
        !! Neither empty nor as long as its variable: then it was probably cut off.
        character(*), intent(in) :: text, message

        call assertGreaterThan(len_trim(text), 0, message=message//": empty")
        call assertLessThan(len_trim(text), line_length, message=message//": cut off")
    end subroutine check_line

    subroutine check_refusals(system)
        !! What is outside its domain is refused, by name, and leaves the system as it was.
        class(system_t), intent(inout) :: system
        type(description_t) :: d, after
        type(error_t), allocatable :: error
        real(dp), allocatable :: values(:), wrong(:), fewer(:)
        real(dp) :: infinity
        integer :: i, k

        call system%describe(d)
        values = default_values(d)
        k = 0
        do i = 1, size(d%parameters)
            associate (p => d%parameters(i))
                infinity = ieee_value(1.0_dp, ieee_positive_inf)
                wrong = [infinity, -infinity]
                if (len_trim(p%computed) == 0) wrong = [wrong, ieee_value(1.0_dp, ieee_quiet_nan)]
                if (p%lower > -huge(1.0_dp)) wrong = [wrong, p%lower - 0.1_dp]
                if (p%upper < huge(1.0_dp)) wrong = [wrong, p%upper + 0.1_dp]
                if (p%open_lower) wrong = [wrong, p%lower]
                if (p%whole) wrong = [wrong, p%lower + 0.5_dp]
                call check_refused(system, values, k + p%count, wrong, p)
                k = k + p%count
            end associate
        end do
        call check_count(system, [values, 1.0_dp], trim(d%name))
        call system%configure(values(:size(values) - 1), error)
        if (allocated(error)) then
            call check_count(system, values(:size(values) - 1), trim(d%name))
        else  ! the last may be left out: it is zero then, and not all may be
            call system%describe(after)
            fewer = default_values(after)
            call assertEqual([values(:size(values) - 1), 0.0_dp], fewer, &
                             message=trim(d%name)//": the last")
            call check_count(system, values(:1), trim(d%name))
            call system%configure(values, error)
        end if
        call system%describe(after)
        call assertEqual(values, default_values(after), message=trim(d%name)//": unchanged")
    end subroutine check_refusals

    subroutine check_refused(system, values, k, wrong, p)
        !! Each of `wrong` in place `k` is refused by the name of `p`.
        class(system_t), intent(inout) :: system
        real(dp), intent(in) :: values(:), wrong(:)
        integer, intent(in) :: k
        type(parameter_t), intent(in) :: p
        type(error_t), allocatable :: error
        real(dp) :: changed(size(values))
        integer :: i

        do i = 1, size(wrong)
            changed = values
            changed(k) = wrong(i)
            call system%configure(changed, error)
            call assertTrue(allocated(error), trim(p%name)//" outside its domain is refused")
            if (.not. allocated(error)) return
            call assertGreaterThan(index(error%message, trim(p%name)//" = "), 0, &
                                   message="a refusal names "//trim(p%name)//": "//error%message)
        end do
    end subroutine check_refused

    subroutine check_count(system, values, name)
        !! A wrong number of values is refused.
        class(system_t), intent(inout) :: system
        real(dp), intent(in) :: values(:)
        character(*), intent(in) :: name
        type(error_t), allocatable :: error

        call system%configure(values, error)
        call assertTrue(allocated(error), name//": wrong count of parameters is refused")
        if (.not. allocated(error)) return
        call assertGreaterThan(index(error%message, "parameter values, not"), 0, &
                               message=error%message)
    end subroutine check_count
end module description_checks
