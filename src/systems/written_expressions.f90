module lagrangia_written_expressions
    !! From what a scene's group `&lagrangian` says to expressions: its names become symbols, its
    !! formulas are parsed, and refused where they make no system.
    use lagrangia_canonical_form, only: simplified
    use lagrangia_derivative, only: time_derivative
    use lagrangia_description, only: name_length
    use lagrangia_errors, only: error_t, fail
    use lagrangia_expression, only: expression_t, operator(*), operator(**), operator(+), &
                                    operator(-), operator(/), whole
    use lagrangia_formula_parser, only: parse_formula
    use lagrangia_symbols, only: symbols_t
    use lagrangia_text, only: lower, quoted, to_text
    use lagrangia_written_constraints, only: read_constraints
    use lagrangia_written_equilibrium, only: read_equilibrium
    use lagrangia_written_formulas, only: written_formulas_t
    use lagrangia_written_points, only: read_points, read_rotors
    use lagrangia_written_quantities, only: read_quantities
    implicit none (type, external)
    private
    public :: written_expressions_t, read_expressions, unused_parameters

    type :: written_expressions_t
        !! A system as expressions of the symbols: t, coordinates, velocities, parameters.
        type(symbols_t) :: symbols                          !! and the definitions
        ! gfortran 12 never frees the last two of these where they are not allocatable
        type(expression_t), allocatable :: kinetic, potential  !! T and V; zero where L was given
        type(expression_t), allocatable :: lagrangian       !! L, J
        type(expression_t), allocatable :: forces(:)        !! Q of each coordinate
        type(expression_t), allocatable :: places(:)        !! x, y, z of each point, m
        type(expression_t), allocatable :: masses(:)        !! of the points, kg
        type(expression_t), allocatable :: angles(:)        !! of each rotor, rad
        type(expression_t), allocatable :: inertias(:)      !! of the rotors, kg m^2
        character(name_length), allocatable :: rotors(:)    !! their names
        logical :: of_points = .false.                      !! T is that of points and rotors
        type(expression_t), allocatable :: equilibrium(:)   !! of each coordinate; or none
        integer, allocatable :: resting(:)                  !! 0, or the function that is given
        type(expression_t), allocatable :: rests(:)         !! what was given
        character(name_length), allocatable :: points(:)    !! their names
        integer :: dimensions = 2                           !! of the points' space
        type(expression_t), allocatable :: constraints(:)   !! zero along the motion
        type(expression_t), allocatable :: quantities(:)    !! of the scene's own
    end type written_expressions_t

contains

    subroutine read_expressions(formulas, expressions, error)
        !! Parse all formulas.
        type(written_formulas_t), intent(in) :: formulas        !! texts
        type(written_expressions_t), intent(out) :: expressions !! of these symbols
        type(error_t), allocatable, intent(out) :: error
        !! status 2, `key` and `element` of `&lagrangian` to blame; `column N: ` before a message
        !! about one place of a formula

        allocate (expressions%kinetic, expressions%potential, expressions%lagrangian)
        call add_symbols(formulas, expressions%symbols, error)
        if (.not. allocated(error)) call add_definitions(formulas, expressions%symbols, error)
        associate (e => expressions, n => size(formulas%coordinates))
            if (.not. allocated(error)) call read_points( &
                formulas%positions, n, e%symbols, e%points, e%masses, e%places, e%dimensions, error)
            if (.not. allocated(error)) call read_rotors( &
                formulas%rotors, n, e%symbols, e%rotors, e%inertias, e%angles, error)
        end associate
        if (.not. allocated(error)) call read_lagrangian(formulas, expressions, error)
        if (.not. allocated(error)) call read_forces(formulas, expressions, error)
        if (.not. allocated(error)) call read_equilibrium( &
            formulas%equilibrium, size(formulas%coordinates), expressions%symbols, &
            expressions%equilibrium, expressions%resting, expressions%rests, error)
        if (.not. allocated(error)) call read_constraints( &
            formulas%constraints, size(formulas%coordinates), expressions%symbols, &
            expressions%constraints, error)
        if (.not. allocated(error)) call read_quantities( &
            formulas%quantities, formulas%quantity_formulas, expressions%symbols, &
            expressions%quantities, error)
    end subroutine read_expressions

    function unused_parameters(expressions, formulas) result(text)
        !! The parameters that are in no formula, `b, c`; nothing where there is none.
        type(written_expressions_t), intent(in) :: expressions  !! of the formulas
        type(written_formulas_t), intent(in) :: formulas        !! say which parameters there are
        character(:), allocatable :: text
        integer :: first, i

        text = ""
        first = 1 + 2*size(formulas%coordinates)
        do i = 1, size(formulas%parameters)
            if (expressions%lagrangian%depends_on(first + i)) cycle
            if (any_depends_on(expressions%forces, first + i)) cycle
            if (any_depends_on(expressions%places, first + i)) cycle
            if (any_depends_on(expressions%masses, first + i)) cycle
            if (any_depends_on(expressions%angles, first + i)) cycle
            if (any_depends_on(expressions%inertias, first + i)) cycle
            if (any_depends_on(expressions%equilibrium, first + i)) cycle
            if (any_depends_on(expressions%constraints, first + i)) cycle
            if (any_depends_on(expressions%quantities, first + i)) cycle
            if (text /= "") text = text//", "
            text = text//trim(formulas%parameters(i)%name)
        end do
    end function unused_parameters

    pure function any_depends_on(expressions, which) result(yes)
        !! Does the symbol occur in one of them?
        type(expression_t), intent(in) :: expressions(:)
        integer, intent(in) :: which
        logical :: yes
        integer :: i

        yes = .false.
        do i = 1, size(expressions)
            yes = yes .or. expressions(i)%depends_on(which)
        end do
    end function any_depends_on

    subroutine add_symbols(formulas, symbols, error)
        !! t, coordinates, velocities, parameters.
        type(written_formulas_t), intent(in) :: formulas
        type(symbols_t), intent(out) :: symbols
        type(error_t), allocatable, intent(out) :: error
        integer, parameter :: longest = name_length - len("p__drift")
        character(:), allocatable :: name
        integer :: i, k

        call symbols%add("t")
        do k = 1, 2
            do i = 1, size(formulas%coordinates)
                name = trim(formulas%coordinates(i)%name)
                if (len(name) > longest) then
                    call fail(error, "the name "//quoted(name)//" is longer than "// &
                              to_text(longest)//" characters; shorten it")
                else if (k == 1) then
                    call refuse_ending(name, error)
                    if (.not. allocated(error)) call symbols%add(name, error)
                else
                    call symbols%add(name//"_dot", error)
                end if
                if (allocated(error)) exit
            end do
            if (allocated(error)) exit
        end do
        if (allocated(error)) then
            error%key = "coordinates"
            error%element = i
            return
        end if
        do i = 1, size(formulas%parameters)
            name = trim(formulas%parameters(i)%name)
            call refuse_ending(name, error)
            if (.not. allocated(error)) call symbols%add(name, error)
            if (.not. allocated(error)) cycle
            error%key = "parameters"
            error%element = i
            return
        end do
    end subroutine add_symbols

    pure subroutine refuse_ending(name, error)
        !! `x_dot` is the velocity of `x`, and no name of its own.
        character(*), intent(in) :: name
        type(error_t), allocatable, intent(out) :: error
        integer :: last

        last = index(name, "_", back=.true.)
        if (last == 0) return
        if (name(last:) /= "_dot" .and. name(last:) /= "_ddot") return
        call fail(error, quoted(name)//" is "//trim(merge("the velocity    ", &
                  "the acceleration", name(last:) == "_dot"))//" of "//quoted(name(:last - 1))// &
                  "; take a name that does not end in "//name(last:))
    end subroutine refuse_ending

    subroutine add_definitions(formulas, symbols, error)
        !! `D = theta1 - theta2`, one after the other.
        type(written_formulas_t), intent(in) :: formulas
        type(symbols_t), intent(inout) :: symbols
        type(error_t), allocatable, intent(out) :: error
        type(expression_t) :: meaning
        integer :: i, equals

        do i = 1, size(formulas%definitions)
            associate (text => formulas%definitions(i))
                equals = index(text, "=")
                if (equals == 0) then
                    call fail(error, "a definition is written 'D = theta1 - theta2'")
                else
                    call refuse_ending(trim(adjustl(text(:equals - 1))), error)
                    if (.not. allocated(error)) call parse_formula( &
                        repeat(" ", equals)//trim(text(equals + 1:)), symbols, meaning, error)
                    if (.not. allocated(error)) call symbols%define( &
                        trim(adjustl(text(:equals - 1))), meaning, error)
                end if
            end associate
            if (.not. allocated(error)) cycle
            error%key = "definitions"
            error%element = i
            return
        end do
    end subroutine add_definitions

    subroutine read_lagrangian(formulas, expressions, error)
        !! L, or T and V; T of the points with their masses, if it is not given.
        type(written_formulas_t), intent(in) :: formulas
        type(written_expressions_t), intent(inout) :: expressions
        type(error_t), allocatable, intent(out) :: error
        type(expression_t) :: difference, of_points
        character(:), allocatable :: name
        integer :: i

        associate (t => formulas%kinetic, v => formulas%potential, l => formulas%lagrangian)
            if (l /= "" .and. t//v /= "") then
                call fail(error, "give either L, or T and V: L is T - V", key="l")
            else if (l == "" .and. t == "" .and. .not. (any_mass(expressions%masses) .or. &
                                                        any_mass(expressions%inertias))) then
                call fail(error, "is missing; write T = 'm/2 x_dot^2', or L, which is T - V, "// &
                          "or positions with their masses", key="t")
            end if
            if (allocated(error)) return
            expressions%kinetic = whole(0)
            expressions%potential = whole(0)
            if (l /= "") then
                call parse("l", l, expressions%lagrangian)
            else
                of_points = kinetic_of_points(size(formulas%coordinates), expressions)
                expressions%kinetic = of_points
                if (t /= "") call parse("t", t, expressions%kinetic)
                if (allocated(error)) return
                difference = simplified(expressions%kinetic - of_points, expressions%symbols)
                expressions%of_points = difference%is_zero()
                if (v /= "") call parse("v", v, expressions%potential)
                if (allocated(error)) return
                expressions%lagrangian = expressions%kinetic - expressions%potential
            end if
            if (allocated(error)) return
        end associate
        do i = 1, size(formulas%coordinates)
            if (expressions%lagrangian%depends_on(1 + size(formulas%coordinates) + i)) cycle
            name = trim(formulas%coordinates(i)%name)
            call fail(error, "L has no "//name//"_dot in it, so that the mass matrix is "// &
                      "singular and nothing says how "//name//" moves; give T a term with "// &
                      name//"_dot^2, or leave "//name//" out", key="coordinates", element=i)
            return
        end do
    contains
        subroutine parse(key, text, expression)
            character(*), intent(in) :: key, text
            type(expression_t), intent(inout) :: expression

            call parse_formula(text, expressions%symbols, expression, error)
            if (allocated(error)) error%key = key
        end subroutine parse
    end subroutine read_lagrangian

    pure function any_mass(masses) result(yes)
        !! Has one of the points a mass?
        type(expression_t), intent(in) :: masses(:)
        logical :: yes
        integer :: i

        yes = .false.
        do i = 1, size(masses)
            yes = yes .or. .not. masses(i)%is_zero()
        end do
    end function any_mass

    function kinetic_of_points(n, expressions) result(kinetic)
        !! \(T = \sum\frac m2(\dot x^2 + \dot y^2 + \dot z^2) + \sum\frac I2\dot\varphi^2\) of all
        !! points and rotors.
        integer, intent(in) :: n  !! coordinates
        type(written_expressions_t), intent(in) :: expressions
        type(expression_t) :: kinetic
        type(expression_t) :: square
        integer :: i, k, rates(size(expressions%symbols%names))

        rates = 0
        rates(2:1 + n) = [(1 + n + i, i=1, n)]
        kinetic = whole(0)
        do i = 1, size(expressions%masses)
            if (expressions%masses(i)%is_zero()) cycle
            square = whole(0)
            do k = 3*i - 2, 3*i
                square = square + time_derivative(expressions%places(k), rates, 1)**2
            end do
            kinetic = kinetic + expressions%masses(i)/whole(2)*square
        end do
        do i = 1, size(expressions%inertias)
            square = time_derivative(expressions%angles(i), rates, 1)**2
            kinetic = kinetic + expressions%inertias(i)/whole(2)*square
        end do
        kinetic = simplified(kinetic, expressions%symbols)
    end function kinetic_of_points

    subroutine read_forces(formulas, expressions, error)
        !! Generalised forces; 0 where none was given.
        type(written_formulas_t), intent(in) :: formulas
        type(written_expressions_t), intent(inout) :: expressions
        type(error_t), allocatable, intent(out) :: error
        integer :: i

        allocate (expressions%forces(size(formulas%forces)))
        do i = 1, size(formulas%forces)
            expressions%forces(i) = whole(0)
            if (formulas%forces(i) == "") cycle
            call parse_formula(trim(formulas%forces(i)), expressions%symbols, &
                               expressions%forces(i), error)
            if (.not. allocated(error)) cycle
            error%key = "q_"//lower(trim(formulas%coordinates(i)%name))
            return
        end do
    end subroutine read_forces
end module lagrangia_written_expressions
