module lagrangia_declared_constants
    !! Names behind `constant:`. What a statement calls so is a constant of integration, whatever
    !! the motion makes of it, and the same one in all lines; in a definition, `y = l - x`, it is a
    !! number.
    use lagrangia_expression, only: expression_t
    use lagrangia_kinds, only: dp
    use lagrangia_sample_names, only: draws, role_parameter, samples_t, states
    use lagrangia_symbols, only: symbols_t
    implicit none (type, external)
    private
    public :: add_constant, keep_constant, settle_constants, show_constants, with_constants

    character, parameter :: hidden = "!"  !! behind a name, so that no formula has it

contains

    subroutine add_constant(name, samples)
        !! One more, with a value for each draw of parameters.
        character(*), intent(in) :: name           !! that nobody has
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
        samples%declared = [character(len(samples%declared)) :: samples%declared, name]
    end subroutine add_constant

    pure subroutine keep_constant(name, values, two_signs, samples)
        !! What a line has made of it: a name as any other for the lines behind.
        character(*), intent(in) :: name           !! behind `constant:`
        real(dp), intent(in) :: values(:)          !! at each state; NaN where it has none
        logical, intent(in) :: two_signs           !! the opposite would do as well
        type(samples_t), intent(inout) :: samples  !! of a sheet
        integer :: place

        place = samples%symbols%find(name//hidden)
        if (place == 0) return
        samples%symbols%names(place) = name
        samples%values(:, place) = values
        if (two_signs) samples%values(:, place) = abs(values)
        samples%kept_constants = [samples%kept_constants, place]
        samples%two_signs = [samples%two_signs, two_signs]
    end subroutine keep_constant

    pure subroutine settle_constants(meaning, samples)
        !! What a definition has is a number from there on.
        type(expression_t), intent(in) :: meaning  !! of a name
        type(samples_t), intent(inout) :: samples  !! of a sheet
        integer :: i, place

        do i = 1, size(samples%declared)
            place = samples%symbols%find(trim(samples%declared(i))//hidden)
            if (place == 0) cycle
            if (meaning%depends_on(place)) samples%symbols%names(place) = samples%declared(i)
        end do
    end subroutine settle_constants

    pure function with_constants(samples) result(symbols)
        !! All symbols, with the names behind `constant:`.
        type(samples_t), intent(in) :: samples  !! of a sheet
        type(symbols_t) :: symbols
        integer :: i, k

        symbols = samples%symbols
        do i = 1, size(samples%declared)
            k = symbols%find(trim(samples%declared(i))//hidden)
            if (k > 0) symbols%names(k) = samples%declared(i)
        end do
    end function with_constants

    pure subroutine show_constants(samples, text)
        !! Take the marks off the names behind `constant:`: what a student reads has the name.
        type(samples_t), intent(in) :: samples             !! of a sheet
        character(:), allocatable, intent(inout) :: text   !! a remark, or a state
        integer :: at, i, n

        if (.not. allocated(text)) return
        do i = 1, size(samples%declared)
            n = len_trim(samples%declared(i))
            do
                at = index(text, trim(samples%declared(i))//hidden)
                if (at == 0) exit
                text = text(:at + n - 1)//text(at + n + 1:)
            end do
        end do
    end subroutine show_constants
end module lagrangia_declared_constants
