module lagrangia_written_points
    !! The masses of a system in formulas: where they are, and how bodies are turned.
    use lagrangia_description, only: name_length
    use lagrangia_errors, only: error_t, fail
    use lagrangia_expression, only: expression_t, whole
    use lagrangia_formula_parser, only: parse_formula
    use lagrangia_symbols, only: check_name, symbols_t
    use lagrangia_text, only: quoted
    implicit none (type, external)
    private
    public :: read_points, read_rotors

contains

    subroutine read_points(texts, n, symbols, names, masses, places, dimensions, error)
        !! `bob, m: x, y` each.
        character(*), intent(in) :: texts(:)                            !! as typed
        integer, intent(in) :: n                                        !! coordinates
        type(symbols_t), intent(in) :: symbols                          !! t, q, q_dot, parameters
        character(name_length), allocatable, intent(out) :: names(:)    !! of the points
        type(expression_t), allocatable, intent(out) :: masses(:)       !! kg
        type(expression_t), allocatable, intent(out) :: places(:)       !! x, y, z of each, m
        integer, intent(inout) :: dimensions                            !! 3 where one has z
        type(error_t), allocatable, intent(out) :: error                !! key and element to blame
        integer :: i

        allocate (places(3*size(texts)), masses(size(texts)), names(size(texts)))
        do i = 1, size(texts)
            call read_point(trim(texts(i)), n, symbols, names(i), masses(i), &
                            places(3*i - 2:3*i), dimensions, error)
            if (.not. allocated(error)) cycle
            error%key = "positions"
            error%element = i
            return
        end do
    end subroutine read_points

    subroutine read_rotors(texts, n, symbols, names, inertias, angles, error)
        !! `pulley, I: x/R` each: a body that turns, its moment of inertia, its angle.
        character(*), intent(in) :: texts(:)                            !! as typed
        integer, intent(in) :: n                                        !! coordinates
        type(symbols_t), intent(in) :: symbols                          !! t, q, q_dot, parameters
        character(name_length), allocatable, intent(out) :: names(:)    !! of the bodies
        type(expression_t), allocatable, intent(out) :: inertias(:)     !! kg m^2
        type(expression_t), allocatable, intent(out) :: angles(:)       !! rad
        type(error_t), allocatable, intent(out) :: error                !! key and element to blame
        integer :: i, k

        allocate (angles(size(texts)), inertias(size(texts)), names(size(texts)))
        do i = 1, size(texts)
            call read_rotor(trim(texts(i)), n, symbols, names(i), inertias(i), angles(i), error)
            do k = 1, i - 1
                if (.not. allocated(error) .and. names(k) == names(i)) call fail( &
                    error, "the name "//quoted(trim(names(i)))//" is given twice; take another one")
            end do
            if (.not. allocated(error)) cycle
            error%key = "rotors"
            error%element = i
            return
        end do
    end subroutine read_rotors

    subroutine read_rotor(text, n, symbols, name, inertia, angle, error)
        !! `pulley, I: x/R`.
        character(*), intent(in) :: text
        integer, intent(in) :: n
        type(symbols_t), intent(in) :: symbols
        character(name_length), intent(out) :: name
        type(expression_t), intent(out) :: inertia, angle
        type(error_t), allocatable, intent(out) :: error
        character(*), parameter :: syntax = "a body that turns is written with its moment of "// &
                                            "inertia and its angle: 'pulley, I: x/R'"
        integer :: colon, comma

        colon = index(text, ":")
        comma = index(text(:max(colon, 1)), ",")
        if (comma == 0 .or. colon == len(text)) then
            call fail(error, syntax)
            return
        end if
        call read_name(text(:comma - 1), "phi_", name, error)
        if (allocated(error)) then
            call fail(error, syntax)
            return
        end if
        if (symbols%find("phi_"//trim(name)) > 0) then
            call fail(error, "its angle would be called phi_"//trim(name)// &
                      ", which is another name here; take another one")
            return
        end if
        call parse_without(repeat(" ", comma)//text(comma + 1:colon - 1), 1 + 2*n, &
                           "the moment of inertia depends on", symbols, inertia, error)
        if (.not. allocated(error)) call parse_without( &
            repeat(" ", colon)//text(colon + 1:), -n, "an angle depends on", symbols, angle, error)
    end subroutine read_rotor

    subroutine read_point(text, n, symbols, name, mass, places, dimensions, error)
        !! `bob, m: x, y` or `bob, m: x, y, z`; without a mass it is a place only.
        character(*), intent(in) :: text
        integer, intent(in) :: n  !! coordinates
        type(symbols_t), intent(in) :: symbols
        character(name_length), intent(out) :: name
        type(expression_t), intent(inout) :: mass, places(3)
        integer, intent(inout) :: dimensions
        type(error_t), allocatable, intent(out) :: error
        character(*), parameter :: syntax = "a place is written 'bob: x, y' or 'bob: x, y, z', "// &
                                            "with its mass 'bob, m: x, y'"
        integer :: colon, comma, first, k, last

        colon = index(text, ":")
        comma = index(text(:max(colon, 1)), ",")
        last = colon
        if (comma > 0) last = comma
        call read_name(text(:max(last, 1) - 1), "x_", name, error)
        if (allocated(error) .or. colon == 0 .or. text(len(text):) == ",") call fail(error, syntax)
        if (allocated(error)) return
        mass = whole(0)
        if (comma > 0) call parse_without(repeat(" ", comma)//text(comma + 1:colon - 1), 1 + 2*n, &
                                          "the mass depends on", symbols, mass, error)
        first = colon + 1
        do k = 1, 3
            if (allocated(error)) return
            last = first + outer_comma(text(first:)//",") - 2
            call parse_without(repeat(" ", first - 1)//text(first:last), -n, &
                               "a place depends on", symbols, places(k), error)
            first = last + 2
            if (first > len(text)) exit
        end do
        if (allocated(error)) return
        if (first <= len(text) .or. k == 1) then
            call fail(error, syntax)
            return
        end if
        dimensions = max(dimensions, k)
        if (k == 2) places(3) = whole(0)
    end subroutine read_point

    pure function outer_comma(text) result(at)
        !! The first comma that is in no bracket; the last character where there is none.
        character(*), intent(in) :: text
        integer :: at
        integer :: depth

        depth = 0
        do at = 1, len(text) - 1
            if (text(at:at) == "(") depth = depth + 1
            if (text(at:at) == ")") depth = depth - 1
            if (text(at:at) == "," .and. depth <= 0) return
        end do
        at = len(text)
    end function outer_comma

    pure subroutine read_name(text, before, name, error)
        !! The name of a point: one that columns can have, `x_bob`.
        character(*), intent(in) :: text
        character(*), intent(in) :: before  !! the beginning of these
        character(name_length), intent(out) :: name
        type(error_t), allocatable, intent(out) :: error

        name = adjustl(text)
        call check_name(before//trim(adjustl(text)), error)
        if (name == "") call fail(error, "there is none")
    end subroutine read_name

    subroutine parse_without(text, n, problem, symbols, expression, error)
        !! A formula that contains none of the first `n` symbols; with `-n` coordinates, none of
        !! their velocities.
        character(*), intent(in) :: text
        integer, intent(in) :: n
        character(*), intent(in) :: problem  !! said before the symbol
        type(symbols_t), intent(in) :: symbols
        type(expression_t), intent(inout) :: expression
        type(error_t), allocatable, intent(out) :: error
        integer :: i

        call parse_formula(text, symbols, expression, error)
        if (allocated(error)) return
        do i = merge(1, 2 - n, n > 0), merge(n, 1 - 2*n, n > 0)
            if (.not. expression%depends_on(i)) cycle
            call fail(error, problem//" "//trim(symbols%names(i))//", which is not allowed: "// &
                      trim(merge("parameters and numbers only         ", &
                                 "the time, coordinates and parameters", n > 0)))
            return
        end do
    end subroutine parse_without
end module lagrangia_written_points
