module lagrangia_declared_constants
    !! Names behind `constant:`. What a statement calls so is a constant of integration, whatever
    !! the motion makes of it, and the same one in all lines; in a definition, `y = l - x`, it is a
    !! number.
    use lagrangia_kinds, only: dp
    use lagrangia_parameter_choice, only: occurs
    use lagrangia_sample_names, only: draws, role_parameter, samples_t, states
    use lagrangia_symbols, only: symbols_t
    use lagrangia_unknown_names, only: hidden
    implicit none (type, external)
    private
    public :: add_constant, declare_speed, has_place, keep_constant, place_of_constant, &
              show_constants, with_constants

contains

    subroutine add_constant(name, declared, samples)
        !! One more, with a value for each draw of parameters.
        character(*), intent(in) :: name           !! that nobody has
        logical, intent(in) :: declared            !! behind `constant:`, not of a motion
        type(samples_t), intent(inout) :: samples  !! with their states
        real(dp), allocatable :: values(:, :)
        real(dp) :: x
        integer :: i, n

        n = size(samples%role)
        call samples%symbols%add(trim(name)//hidden)
        samples%role = [samples%role, role_parameter]
        samples%rate = [samples%rate, 0]
        allocate (values(draws*states, n + 1))
        values(:, :n) = samples%values
        do i = 1, draws
            call samples%random%uniform(0.3_dp, 3.0_dp, x)
            values((i - 1)*states + 1:i*states, n + 1) = x
        end do
        call move_alloc(values, samples%values)
        allocate (values(draws*states, n + 1))
        values(:, :n) = samples%elsewhere
        values(:, n + 1) = 1.3_dp*samples%values(:, n + 1)
        call move_alloc(values, samples%elsewhere)
        if (declared) samples%declared = [character(len(samples%declared)) :: samples%declared, &
                                          name]
    end subroutine add_constant

    subroutine declare_speed(said, samples)
        !! `v^2 = v_0^2 - 2 g y`: v_0 is a constant where one coordinate is a length.
        character(*), intent(in) :: said             !! all statements
        type(samples_t), intent(inout) :: samples    !! get the name
        character(3), parameter :: names(*) = ["v_0", "v0 "]
        integer :: i

        if (samples%ndof /= 1) return
        if (.not. any(samples%symbols%names(2) == ["x", "y", "z", "s", "r", "q"])) return
        do i = 1, size(names)
            if (.not. occurs(said, trim(names(i)))) cycle
            if (samples%symbols%find(samples%symbols%spelling(trim(names(i)))) > 0) cycle
            if (has_place(samples, names(i))) cycle
            call add_constant(trim(names(i)), .true., samples)
            return
        end do
    end subroutine declare_speed

    pure function has_place(samples, name) result(yes)
        !! Is it a constant that no line has given a value?
        type(samples_t), intent(in) :: samples  !! of a sheet
        character(*), intent(in) :: name        !! as typed
        logical :: yes

        yes = place_of_constant(samples, name) > 0
    end function has_place

    pure function place_of_constant(samples, name) result(place)
        !! Of a constant that no line has given a value; 0: there is none.
        type(samples_t), intent(in) :: samples  !! of a sheet
        character(*), intent(in) :: name        !! as typed
        integer :: place

        place = samples%symbols%find(trim(name)//hidden)
    end function place_of_constant

    pure subroutine keep_constant(name, values, two_signs, samples)
        !! What a line has made of it: a name as any other for the lines behind.
        character(*), intent(in) :: name           !! behind `constant:`
        real(dp), intent(in) :: values(:)          !! at each state; NaN where it has none
        logical, intent(in) :: two_signs           !! the opposite would do as well
        type(samples_t), intent(inout) :: samples  !! of a sheet
        integer :: place

        place = samples%symbols%find(name//hidden)
        samples%symbols%names(place) = name
        samples%values(:, place) = values
        if (two_signs) samples%values(:, place) = abs(values)
        samples%kept_constants = [samples%kept_constants, place]
        samples%two_signs = [samples%two_signs, two_signs]
    end subroutine keep_constant

    pure function with_constants(samples) result(symbols)
        !! All symbols, with the names of constants that no line has given a value.
        type(samples_t), intent(in) :: samples  !! of a sheet
        type(symbols_t) :: symbols
        integer :: i, n

        symbols = samples%symbols
        do i = 1, size(symbols%names)
            n = index(symbols%names(i), hidden)
            if (n == 0) cycle
            if (samples%symbols%find_definition(symbols%names(i) (:n - 1)) > 0) cycle
            symbols%names(i) = symbols%names(i) (:n - 1)
        end do
    end function with_constants

    pure subroutine show_constants(text)
        !! Take the marks off the names of constants: what a student reads has the name.
        character(:), allocatable, intent(inout) :: text   !! a remark, or a state
        integer :: at

        if (.not. allocated(text)) return
        do at = len(text), 2, -1
            if (text(at:at) /= hidden .or. text(at - 1:at - 1) == "'") cycle  ! typed: '!'
            text = text(:at - 1)//text(at + 1:)
        end do
    end subroutine show_constants
end module lagrangia_declared_constants
