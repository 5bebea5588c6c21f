module lagrangia_written_out
    !! A statement's formula with what its names stand for: letters, momenta, derivatives of L, and
    !! L and the energies themselves. What is left are coordinates, their rates and constants.
    use lagrangia_derivative, only: derivative, time_derivative
    use lagrangia_expression, only: expression_t, operator(*), operator(+), operator(-), symbol
    use lagrangia_sample_names, only: role_known, samples_t
    use lagrangia_substitution, only: substituted
    implicit none (type, external)
    private
    public :: energy_formulas, energy_places, equation_of_motion, in_coordinates, written_out

contains

    function written_out(expression, samples) result(e)
        !! With letters, momenta and derivatives of L written out; L, T, V and E stay.
        type(expression_t), intent(in) :: expression  !! of the samples' symbols, not empty
        type(samples_t), intent(in) :: samples        !! know the formulas
        type(expression_t) :: e
        type(expression_t) :: lagrangian, meaning(1)
        character(:), allocatable :: name
        integer :: i, n

        e = expression
        n = samples%ndof
        if (samples%lagrangian%count > 0 .and. needs_lagrangian()) then
            lagrangian = with_letters(samples%lagrangian, samples, .true.)
            do i = 1, n
                name = trim(samples%symbols%names(1 + i))
                meaning(1) = derivative(lagrangian, 1 + n + i)
                e = substituted(e, [place("p_"//name)], meaning)
                e = substituted(e, [place("dL_d"//name//"_dot")], meaning)
                meaning(1) = time_derivative(meaning(1), samples%rate, 1)
                e = substituted(e, [place("d_dt_dL_d"//name//"_dot")], meaning)
                meaning(1) = derivative(lagrangian, 1 + i)
                e = substituted(e, [place("dL_d"//name)], meaning)
            end do
        end if
        e = with_letters(e, samples, .false.)
    contains
        integer function place(called)
            character(*), intent(in) :: called

            place = samples%symbols%find(called)
        end function place

        logical function needs_lagrangian()
            integer :: k

            needs_lagrangian = .false.
            do k = 1, size(samples%role)
                if (samples%role(k) /= role_known .or. any(energy_places(samples) == k)) cycle
                if (expression%depends_on(k)) needs_lagrangian = .true.
            end do
        end function needs_lagrangian
    end function written_out

    function in_coordinates(expression, samples) result(e)
        !! With the energies and the quantities written out as well.
        type(expression_t), intent(in) :: expression  !! of the samples' symbols, not empty
        type(samples_t), intent(in) :: samples        !! know the formulas
        type(expression_t) :: e
        type(expression_t), allocatable :: formulas(:)
        integer :: i
        integer :: places(4)

        e = written_out(expression, samples)
        places = energy_places(samples)
        call energy_formulas(samples, formulas)
        do i = 1, size(places)
            if (places(i) == 0) cycle
            if (e%depends_on(places(i))) e = substituted(e, places(i:i), formulas(i:i))
        end do
        e = with_letters(e, samples, .true.)
    end function in_coordinates

    pure function energy_places(samples) result(places)
        !! Of L, E, T and V; 0 where the system has none.
        type(samples_t), intent(in) :: samples  !! know the names
        integer :: places(4)

        places(1) = samples%symbols%find("L")
        places(2) = samples%symbols%find("E")
        places(3) = samples%symbols%find("T")
        places(4) = samples%symbols%find("V")
        if (samples%lagrangian%count == 0) places(:2) = 0
    end function energy_places

    subroutine energy_formulas(samples, formulas)
        !! L, E, T and V in coordinates, velocities and constants; 0 where the system has none.
        type(samples_t), intent(in) :: samples                      !! know the formulas
        type(expression_t), allocatable, intent(out) :: formulas(:)  !! (4)
        integer :: i, n

        allocate (formulas(4))
        do i = 1, 4
            call formulas(i)%append(formulas(i), n)
        end do
        if (samples%lagrangian%count > 0) then
            formulas(1) = with_letters(samples%lagrangian, samples, .true.)
            formulas(2) = symbol(2 + samples%ndof)*derivative(formulas(1), 2 + samples%ndof)
            do i = 2, samples%ndof
                n = 1 + samples%ndof + i
                formulas(2) = formulas(2) + symbol(n)*derivative(formulas(1), n)
            end do
            formulas(2) = formulas(2) - formulas(1)
        end if
        do i = 3, 4
            associate (places => energy_places(samples))
                if (places(i) > 0) formulas(i) = with_letters(symbol(places(i)), samples, .true.)
            end associate
        end do
    end subroutine energy_formulas

    function equation_of_motion(coordinate, samples) result(equation)
        !! \(d/dt\,\partial L/\partial\dot q_i - \partial L/\partial q_i - Q_i\), which is 0.
        integer, intent(in) :: coordinate         !! i
        type(samples_t), intent(in) :: samples    !! know L, which is there, and the forces
        type(expression_t) :: equation
        type(expression_t), allocatable :: formulas(:)
        integer :: force

        call energy_formulas(samples, formulas)
        equation = time_derivative(derivative(formulas(1), 1 + samples%ndof + coordinate), &
                                   samples%rate, 1) - derivative(formulas(1), 1 + coordinate)
        force = samples%symbols%find_definition("Q_"//trim(samples%symbols%names(1 + coordinate)))
        if (force > 0) equation = equation - in_coordinates( &
                                  samples%symbols%definitions(force)%meaning, samples)
    end function equation_of_motion

    function with_letters(expression, samples, energies) result(e)
        !! The letters that move and their rates written out, from the last one on; and T and V.
        type(expression_t), intent(in) :: expression
        type(samples_t), intent(in) :: samples
        logical, intent(in) :: energies
        type(expression_t) :: e, meaning(1)
        integer :: k, order, which

        e = expression
        do k = size(samples%compiled), 1, -1
            which = samples%compiled(k)%symbol
            if (samples%role(which) == role_known .and. .not. energies) cycle
            meaning(1) = samples%compiled(k)%formula
            do order = 0, 2
                if (e%depends_on(which)) e = substituted(e, [which], meaning)
                which = samples%rate(which)
                if (which == 0) exit
                meaning(1) = time_derivative(meaning(1), samples%rate, 1)
            end do
        end do
    end function with_letters
end module lagrangia_written_out
