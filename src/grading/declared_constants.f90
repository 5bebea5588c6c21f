module lagrangia_declared_constants
    !! Names behind `constant:`. What a statement calls so is a constant of integration, whatever
    !! the motion makes of it; in a definition, `y = l - x`, it is a number.
    use lagrangia_kinds, only: dp
    use lagrangia_sample_names, only: draws, role_parameter, samples_t, states
    use lagrangia_symbols, only: symbols_t
    implicit none (type, external)
    private
    public :: add_constant, show_constants, with_constants

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
