module lagrangia_written_system
    !! A system in formulas, as a scene's group `&lagrangian` has them: T and V, or L, and Q.
    !!
    !! The formulas are read once; where the parameters are set, they are compiled with these
    !! numbers in them, to programs of t, the coordinates and the velocities, in this order.
    use lagrangia_description, only: description_t, formula_length, quantity
    use lagrangia_errors, only: error_t
    use lagrangia_expression, only: expression_t
    use lagrangia_formula_program, only: formula_program_t, new_formula_program
    use lagrangia_formula_text, only: formula_text
    use lagrangia_hyperdual, only: hyperdual_t
    use lagrangia_kinds, only: dp
    use lagrangia_lagrangian_system, only: lagrangian_system_t
    use lagrangia_written_expressions, only: written_expressions_t
    use lagrangia_written_formulas, only: written_formulas_t
    implicit none (type, external)
    private
    public :: written_system_t, new_written_system

    type, extends(lagrangian_system_t) :: written_system_t
        !! Made by `new_written_system`, with the parameters of the formulas.
        type(description_t) :: stated                !! all but what follows from the parameters
        type(written_expressions_t) :: expressions
        type(formula_program_t) :: l_program         !! L
        type(formula_program_t) :: force_program     !! Q of each coordinate
        type(formula_program_t) :: place_program     !! x, y, z of each point, m
        type(formula_program_t) :: constant_program  !! masses of the points, then the equilibrium
    contains
        procedure :: outline
        procedure :: prepare
        procedure :: lagrangian
        procedure :: generalised_forces
        procedure :: quantity => momentum
        procedure :: positions
    end type written_system_t

contains

    subroutine new_written_system(formulas, expressions, system, error)
        !! A system from its formulas.
        type(written_formulas_t), intent(in) :: formulas        !! with values of the parameters
        type(written_expressions_t), intent(in) :: expressions  !! what the formulas mean
        type(written_system_t), intent(out) :: system           !! configured with these values
        type(error_t), allocatable, intent(out) :: error        !! a value that is not allowed
        type(expression_t), allocatable :: constants(:)
        integer :: i

        system%expressions = expressions
        associate (e => system%expressions, d => system%stated)
            d%name = formulas%name
            d%title = formulas%title
            d%coordinates = formulas%coordinates
            d%parameters = formulas%parameters
            d%dimensions = e%dimensions
            allocate (d%points(size(e%points)))
            d%points%name = e%points
            call state_formulas(formulas, e, d)
            allocate (constants(size(e%masses) + size(e%equilibrium)))
            do i = 1, size(e%masses)
                constants(i) = e%masses(i)
            end do
            do i = 1, size(e%equilibrium)
                constants(size(e%masses) + i) = e%equilibrium(i)
            end do
            call new_formula_program(system%constant_program, constants, size(e%symbols%names))
        end associate
        call system%configure([(formulas%parameters(i)%value(1), i=1, &
                                size(formulas%parameters))], error)
    end subroutine new_written_system

    subroutine state_formulas(formulas, expressions, d)
        !! T, V, L and the definitions as they were typed; definitions that are too long for a
        !! letter are written out.
        type(written_formulas_t), intent(in) :: formulas
        type(written_expressions_t), intent(in) :: expressions
        type(description_t), intent(inout) :: d
        logical :: as_typed
        integer :: equals, i

        as_typed = all(len_trim(formulas%definitions) <= formula_length)
        if (as_typed) then
            allocate (d%letters(size(formulas%definitions)))
            do i = 1, size(d%letters)
                equals = index(formulas%definitions(i), "=")
                d%letters(i)%name = adjustl(formulas%definitions(i)(:equals - 1))
                d%letters(i)%formula = adjustl(formulas%definitions(i)(equals + 1:))
            end do
        end if
        if (formulas%lagrangian /= "") then
            d%lagrangian = stated(formulas%lagrangian, expressions%lagrangian)
        else
            d%lagrangian = "T - V"
            d%kinetic_energy = stated(formulas%kinetic, expressions%kinetic)
            d%potential_energy = stated(formulas%potential, expressions%potential)
            if (formulas%potential == "") d%potential_energy = "0"
        end if
    contains
        function stated(typed, expression) result(text)
            character(*), intent(in) :: typed
            type(expression_t), intent(in) :: expression
            character(:), allocatable :: text

            if (as_typed) then
                text = trim(adjustl(typed))
            else
                text = formula_text(expression, expressions%symbols)
            end if
        end function stated
    end subroutine state_formulas

    pure subroutine outline(self, d)
        !! What was stated, and what follows from the parameters: masses, an equilibrium, and which
        !! momenta are conserved.
        class(written_system_t), intent(in) :: self
        type(description_t), intent(out) :: d
        real(dp) :: values(size(self%expressions%symbols%names))
        real(dp) :: constants(size(self%expressions%masses) + size(self%expressions%equilibrium))
        integer :: i, k, n

        d = self%stated
        n = size(d%coordinates)
        allocate (d%quantities(n))
        do i = 1, n
            associate (q => d%coordinates(i))
                d%quantities(i) = quantity("p_"//trim(q%name), momentum_unit(q%unit), &
                                           "momentum dL/d"//trim(q%name)//"_dot")
                if (.not. allocated(self%cyclic_coordinates)) cycle
                if (.not. self%cyclic_coordinates(i)) cycle
                d%quantities(i)%conserved = .true.
                d%quantities(i)%meaning = trim(d%quantities(i)%meaning)//": "//trim(q%name)// &
                                          " is cyclic"
            end associate
        end do
        values = 0.0_dp
        k = 1 + 2*n
        do i = 1, size(d%parameters)
            values(k + i) = self%value(i, d%parameters(i)%value(1))
        end do
        call self%constant_program%evaluate(values, constants)
        k = size(d%points)
        d%points%mass = constants(:k)
        if (size(constants) > k) d%equilibrium = constants(k + 1:)
    end subroutine outline

    pure subroutine prepare(self)
        !! Compile L, the forces beside it and the places, with numbers for the parameters.
        class(written_system_t), intent(inout) :: self
        type(expression_t) :: lagrangian(1)
        logical :: fixed(size(self%expressions%symbols%names))
        real(dp) :: values(size(fixed))
        integer :: n

        n = 1 + 2*self%ndof
        fixed = .true.
        fixed(:n) = .false.
        values(:n) = 0.0_dp
        values(n + 1:) = self%p
        lagrangian(1) = self%expressions%lagrangian
        call new_formula_program(self%l_program, lagrangian, n, fixed, values)
        call new_formula_program(self%force_program, self%expressions%forces, n, fixed, values)
        call new_formula_program(self%place_program, self%expressions%places, n, fixed, values)
    end subroutine prepare

    pure function momentum_unit(unit) result(text)
        !! Of the momentum that belongs to a coordinate in this unit: J s over it.
        character(*), intent(in) :: unit
        character(16) :: text

        select case (unit)
        case ("m")
            text = "kg m/s"
        case ("rad")
            text = "kg m^2/s"
        case ("1")
            text = "J s"
        case default
            text = "J s/"//unit
        end select
    end function momentum_unit

    pure function lagrangian(self, t, q, v) result(l)
        !! See `system_t`.
        class(written_system_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof), v(self%ndof)
        type(hyperdual_t) :: l
        type(hyperdual_t) :: values(1 + 2*self%ndof), results(1)

        values(1) = t
        values(2:1 + self%ndof) = q
        values(2 + self%ndof:) = v
        call self%l_program%evaluate(values, results)
        l = results(1)
    end function lagrangian

    pure subroutine generalised_forces(self, t, q, v, f)
        !! See `system_t`.
        class(written_system_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof), v(self%ndof)
        type(hyperdual_t), intent(out) :: f(self%ndof)
        type(hyperdual_t) :: values(1 + 2*self%ndof)

        values(1) = t
        values(2:1 + self%ndof) = q
        values(2 + self%ndof:) = v
        call self%force_program%evaluate(values, f)
    end subroutine generalised_forces

    pure function momentum(self, i, t, q, v) result(value)
        !! \(p_i = \partial L/\partial\dot q_i\).
        class(written_system_t), intent(in) :: self
        integer, intent(in) :: i
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp) :: value
        real(dp) :: p(self%ndof)

        call self%momenta(t, q, v, p)
        value = p(i)
    end function momentum

    pure subroutine positions(self, t, q, r)
        !! See `system_t`.
        class(written_system_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof)
        type(hyperdual_t), intent(out) :: r(:, :)
        type(hyperdual_t) :: values(1 + 2*self%ndof), results(3*size(r, 2))

        values(1) = t
        values(2:1 + self%ndof) = q
        call self%place_program%evaluate(values, results)
        r = reshape(results, [3, size(r, 2)])
    end subroutine positions
end module lagrangia_written_system
