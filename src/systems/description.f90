module lagrangia_description
    !! What a system says of itself: plain data, read by `describe`, scenes, columns and tests.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_is_nan
    use lagrangia_errors, only: error_t, fail
    use lagrangia_kinds, only: dp
    use lagrangia_names, only: name_length
    use lagrangia_number_class, only: is_zero
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: description_t, quantity_t, parameter_t, point_t, letter_t, frequency_t
    public :: coordinate, conserved, quantity, positive, nonnegative, between, real_number, &
              whole_number, real_vector, mass_point
    public :: add_zeros, check_parameter, constraint_text, default_values, described_by, &
              sizes_of_places, unit_over, value_names, velocity_names
    public :: constraint_length, figure_length, formula_length, line_length, name_length, &
              title_length

    integer, parameter :: line_length = 120     !! of a line of text
    integer, parameter :: title_length = 200    !! of a method or a closed form, with its source
    integer, parameter :: formula_length = 200  !! of a formula
    integer, parameter :: figure_length = 300   !! of one part of a figure
    integer, parameter :: constraint_length = 1000  !! of a constraint in rates, or of a note

    type :: quantity_t
        !! A coordinate, or a function of the state.
        character(name_length) :: name = ""
        character(16) :: unit = "1"
        character(line_length) :: meaning = ""
        character(formula_length) :: formula = ""  !! "": none is printed
        logical :: conserved = .false.
        real(dp) :: scale = 0.0_dp  !! what a drift is compared with where the start value is small
    end type quantity_t

    type :: parameter_t
        !! One parameter: a number, or a vector of up to three, and what is allowed.
        character(name_length) :: name = ""
        character(16) :: unit = "1"
        character(line_length) :: meaning = ""
        integer :: count = 1
        real(dp) :: value(3) = 0.0_dp
        real(dp) :: lower = -huge(1.0_dp)
        real(dp) :: upper = huge(1.0_dp)
        logical :: open_lower = .false.          !! `lower` itself is not allowed
        logical :: open_upper = .false.          !! `upper` itself is not allowed
        logical :: whole = .false.               !! a whole number
        character(name_length) :: computed = ""  !! the formula of a default that others determine
    contains
        procedure :: domain
    end type parameter_t

    type :: point_t
        !! A mass point (or a body's centre) whose Cartesian position is known.
        character(name_length) :: name = ""
        real(dp) :: mass = 0.0_dp  !! kg
        character(formula_length) :: mass_formula = ""  !! `m1`; "": this and the next are unknown
        character(formula_length) :: position(3) = ""   !! of x, y, z; "": 0; a rotor's angle first
    end type point_t

    type :: letter_t
        !! A letter of the formulas, and what it stands for: `I = pulley_inertia`. The letter with
        !! `_dot` is its time derivative.
        character(name_length) :: name = ""
        character(formula_length) :: formula = ""
    end type letter_t

    type :: frequency_t
        !! Of a small oscillation about an equilibrium.
        character(formula_length) :: equation = ""  !! `omega^2 = g/l`, whatever is on the left
        character(line_length) :: equilibrium = ""  !! what holds there: `theta = 0`
    end type frequency_t

    type :: description_t
        !! All that a system says of itself, in SI units.
        !!
        !! Formulas are for people and for the program, whose audit compares them with the code.
        !! They are of t, the coordinates and their derivatives (`x_dot`, `x_ddot`), the parameters
        !! (of a vector `electric_x`, ...), the `letters`, momenta `p_x`, T and V, quantities by
        !! their names, and the places of points (`x_bob`). What is left out is not checked.
        character(name_length) :: name = ""
        logical :: named_in_scene = .false.           !! by a scene's `&lagrangian`, nowhere else
        character(line_length) :: title = ""          !! a few words for a list
        type(quantity_t), allocatable :: coordinates(:)
        type(parameter_t), allocatable :: parameters(:)
        type(quantity_t), allocatable :: quantities(:)   !! beside the energy
        type(point_t), allocatable :: points(:)
        type(point_t), allocatable :: rotors(:)          !! bodies that turn; "mass" in kg m^2
        type(quantity_t), allocatable :: reactions(:)    !! of `newton`; empty: none is given
        integer :: dimensions = 2                        !! of the space that the points move in
        real(dp) :: energy_scale = 0.0_dp                !! J
        type(letter_t), allocatable :: letters(:)  !! of those before it, too
        character(:), allocatable :: kinetic_energy        !! T
        character(:), allocatable :: potential_energy      !! V, perhaps with velocities: L = T - V
        character(:), allocatable :: lagrangian            !! L
        character(:), allocatable :: energy  !! \(\dot q\,\partial L/\partial\dot q - L\)
        character(formula_length), allocatable :: generalised_forces(:)  !! `Q_x = ...`, beside L
        character(:), allocatable :: dissipation  !! Rayleigh's R of the drag in them, if it has one
        character(formula_length), allocatable :: equations(:)      !! of motion, `left = right`
        character(formula_length), allocatable :: accelerations(:)  !! solved: `x_ddot = ...`
        character(line_length) :: constraint = ""        !! class of its constraints, in words
        character(constraint_length), allocatable :: constraint_equations(:)  !! with `=` or `>=`
        type(frequency_t), allocatable :: frequencies(:)
        character(formula_length), allocatable :: motion(:)  !! `x = x_0 + x_dot_0 t`, from t = 0
        real(dp), allocatable :: equilibrium(:)          !! at or near one; absent: try zero
        character(formula_length), allocatable :: equilibrium_formulas(:)  !! of each coordinate
        real(dp), allocatable :: typical_places(:)       !! sizes of the coordinates; absent: 1
        real(dp) :: typical_time = 1.0_dp                !! of a motion, s
        character(figure_length), allocatable :: figure(:)
        !! how it is drawn: `rod origin bob`; see `lagrangia_scene_figure`; absent: as its points
        character(constraint_length), allocatable :: notes(:)  !! slips corrected, limits, remarks
        character(line_length) :: source = ""            !! where in the lecture notes
    end type description_t

contains

    pure function sizes_of_places(d) result(sizes)
        !! How large coordinates typically are: 1 where the description does not say.
        type(description_t), intent(in) :: d          !! of a system
        real(dp) :: sizes(size(d%coordinates))        !! in their units

        sizes = 1.0_dp
        if (allocated(d%typical_places)) sizes = d%typical_places
    end function sizes_of_places

    pure function coordinate(name, unit, meaning) result(item)
        !! A generalised coordinate.
        character(*), intent(in) :: name, unit, meaning
        !! as scenes and files have it; SI unit; a few words
        type(quantity_t) :: item

        item = quantity(name, unit, meaning)
    end function coordinate

    pure function quantity(name, unit, meaning, formula) result(item)
        !! A function of the state that may change.
        character(*), intent(in) :: name, unit, meaning
        !! as scenes and files have it; SI unit; a few words
        character(*), intent(in), optional :: formula  !! of it, as on paper
        type(quantity_t) :: item

        item%name = name
        item%unit = unit
        item%meaning = meaning
        if (present(formula)) item%formula = formula
    end function quantity

    pure function conserved(name, unit, meaning, scale, formula) result(item)
        !! A function of the state that the motion conserves.
        character(*), intent(in) :: name, unit, meaning
        !! as scenes and files have it; SI unit; a few words
        real(dp), intent(in) :: scale                  !! a natural size, from the parameters
        character(*), intent(in), optional :: formula  !! of it, as on paper
        type(quantity_t) :: item

        item = quantity(name, unit, meaning, formula)
        item%conserved = .true.
        item%scale = scale
    end function conserved

    pure function real_number(name, unit, meaning, value) result(item)
        !! A parameter that may be any finite number.
        character(*), intent(in) :: name, unit, meaning
        !! as scenes and files have it; SI unit; a few words
        real(dp), intent(in) :: value  !! the default, in `unit`
        type(parameter_t) :: item

        item%name = name
        item%unit = unit
        item%meaning = meaning
        item%value(1) = value
    end function real_number

    pure function positive(name, unit, meaning, value, computed) result(item)
        !! A parameter that must be greater than zero.
        character(*), intent(in) :: name, unit, meaning
        !! as scenes and files have it; SI unit; a few words
        real(dp), intent(in) :: value  !! the default, in `unit`
        character(*), intent(in), optional :: computed
        !! formula of the default, where others determine it
        type(parameter_t) :: item

        item = nonnegative(name, unit, meaning, value, computed)
        item%open_lower = .true.
    end function positive

    pure function nonnegative(name, unit, meaning, value, computed) result(item)
        !! A parameter that must not be negative.
        character(*), intent(in) :: name, unit, meaning
        !! as scenes and files have it; SI unit; a few words
        real(dp), intent(in) :: value  !! the default, in `unit`
        character(*), intent(in), optional :: computed
        !! formula of the default, where others determine it
        type(parameter_t) :: item

        item = real_number(name, unit, meaning, value)
        item%lower = 0.0_dp
        if (present(computed)) item%computed = computed
    end function nonnegative

    pure function between(name, unit, meaning, value, lower, upper) result(item)
        !! A parameter from `lower` to `upper`, both allowed.
        character(*), intent(in) :: name, unit, meaning
        !! as scenes and files have it; SI unit; a few words
        real(dp), intent(in) :: value, lower, upper  !! the default, and its bounds, in `unit`
        type(parameter_t) :: item

        item = real_number(name, unit, meaning, value)
        item%lower = lower
        item%upper = upper
    end function between

    pure function whole_number(name, meaning, value, most) result(item)
        !! A parameter that must be a whole number from 1 to `most`.
        character(*), intent(in) :: name, meaning  !! as scenes have it; a few words
        integer, intent(in) :: value, most         !! the default, and the largest allowed
        type(parameter_t) :: item

        item = between(name, "1", meaning, real(value, dp), 1.0_dp, real(most, dp))
        item%whole = .true.
    end function whole_number

    pure function real_vector(name, unit, meaning, value) result(item)
        !! A parameter of three components.
        character(*), intent(in) :: name, unit, meaning
        !! as scenes and files have it; SI unit; a few words
        real(dp), intent(in) :: value(3)  !! the default, in `unit`
        type(parameter_t) :: item

        item = real_number(name, unit, meaning, 0.0_dp)
        item%count = 3
        item%value = value
    end function real_vector

    pure function mass_point(name, mass, mass_formula, x, y, z) result(item)
        !! A point of mass `mass`, kg, and where it is, as formulas.
        character(*), intent(in) :: name  !! as in `x_bob`
        real(dp), intent(in) :: mass      !! kg, or kg m^2 of a rotor
        character(*), intent(in), optional :: mass_formula  !! `m1`
        character(*), intent(in), optional :: x, y, z       !! absent: 0; of a rotor x is its angle
        type(point_t) :: item

        item%name = name
        item%mass = mass
        if (present(mass_formula)) item%mass_formula = mass_formula
        if (present(x)) item%position(1) = x
        if (present(y)) item%position(2) = y
        if (present(z)) item%position(3) = z
    end function mass_point

    pure function domain(self) result(text)
        !! What is allowed, in words.
        class(parameter_t), intent(in) :: self
        character(:), allocatable :: text

        text = "any finite number"
        if (self%lower > -huge(1.0_dp) .and. self%upper < huge(1.0_dp)) then
            text = "from "//bound(self%lower)//" to "//bound(self%upper)
            if (self%whole) text = "a whole number from "//to_text(nint(self%lower))//" to "// &
                                   to_text(nint(self%upper))
            if (self%open_lower) text = text//", above "//to_text(self%lower)
            if (self%open_upper) text = text//", below "//bound(self%upper)
        else if (self%lower > -huge(1.0_dp)) then
            text = merge("greater than ", "at least     ", self%open_lower)
            text = trim(text)//" "//to_text(self%lower)
        else if (self%upper < huge(1.0_dp)) then
            text = trim(merge("less than", "at most  ", self%open_upper))//" "//bound(self%upper)
        end if
    end function domain

    pure function bound(value) result(text)
        !! A right angle by its name, other numbers as they are.
        real(dp), intent(in) :: value
        character(:), allocatable :: text

        text = to_text(value)
        if (abs(value) >= acos(0.0_dp) .and. abs(value) <= acos(0.0_dp)) then
            text = "pi/2"
            if (value < 0.0_dp) text = "-pi/2"
        end if
    end function bound

    pure subroutine check_parameter(p, error)
        !! Refuse a parameter whose value is outside its domain or not finite.
        type(parameter_t), intent(in) :: p  !! with its value and what is allowed
        type(error_t), allocatable, intent(out) :: error
        !! status 2: names it, its value and its domain
        logical :: good
        integer :: i

        do i = 1, p%count
            if (len_trim(p%computed) > 0 .and. ieee_is_nan(p%value(i))) cycle
            good = ieee_is_finite(p%value(i)) .and. p%value(i) <= p%upper
            if (p%open_upper) good = good .and. p%value(i) < p%upper
            if (p%open_lower) then
                good = good .and. p%value(i) > p%lower
            else
                good = good .and. p%value(i) >= p%lower
            end if
            if (p%whole) good = good .and. is_zero(p%value(i) - anint(p%value(i)))
            if (.not. good) then
                call fail(error, trim(p%name)//" = "//to_text(p%value(i))// &
                          " is not allowed: "//p%domain())
                return
            end if
        end do
    end subroutine check_parameter

    pure function default_values(d) result(values)
        !! The parameters of a description as the flat list that `configure` takes.
        type(description_t), intent(in) :: d  !! of a fresh system
        real(dp), allocatable :: values(:)
        integer :: i

        allocate (values(0))
        if (.not. allocated(d%parameters)) return
        do i = 1, size(d%parameters)
            values = [values, d%parameters(i)%value(:d%parameters(i)%count)]
        end do
    end function default_values

    pure function velocity_names(d) result(names)
        !! `theta_dot`, in the order of the coordinates.
        type(description_t), intent(in) :: d  !! of any system
        character(name_length), allocatable :: names(:)
        integer :: i

        allocate (names(size(d%coordinates)))
        do i = 1, size(names)
            names(i) = trim(d%coordinates(i)%name)//"_dot"
        end do
    end function velocity_names

    pure function value_names(d) result(names)
        !! What formulas call the entries of `default_values`: `m`, or of a vector `electric_x`, ...
        type(description_t), intent(in) :: d  !! of any system
        character(name_length), allocatable :: names(:)
        character, parameter :: axes(3) = ["x", "y", "z"]
        integer :: i, k

        allocate (names(0))
        if (.not. allocated(d%parameters)) return
        do i = 1, size(d%parameters)
            do k = 1, d%parameters(i)%count
                names = [character(name_length) :: names, d%parameters(i)%name]
                if (d%parameters(i)%count == 1) cycle
                names(size(names)) = trim(names(size(names)))//"_"//axes(k)
            end do
        end do
    end function value_names

    pure function described_by(d) result(command)
        !! The command that shows all that a system has. A number of bobs decides how much that is.
        type(description_t), intent(in) :: d  !! of any system
        character(:), allocatable :: command
        integer :: i

        command = "lagrangia describe "//trim(d%name)
        if (d%named_in_scene) command = "lagrangia describe SCENE"
        if (d%named_in_scene .or. .not. allocated(d%parameters)) return
        do i = 1, size(d%parameters)
            if (.not. d%parameters(i)%whole) cycle
            command = command//" --set "//trim(d%name)//"%"//trim(d%parameters(i)%name)//"="// &
                      to_text(nint(d%parameters(i)%value(1)))
        end do
    end function described_by

    pure function constraint_text(d) result(text)
        !! Class and equations of the constraints: `holonomic, scleronomic: y_cart = 0`.
        type(description_t), intent(in) :: d  !! of any system
        character(:), allocatable :: text
        integer :: i

        text = trim(d%constraint)
        if (.not. allocated(d%constraint_equations)) return
        do i = 1, size(d%constraint_equations)
            text = text//merge(": ", ", ", i == 1)//trim(d%constraint_equations(i))
        end do
    end function constraint_text

    pure subroutine add_zeros(values, n, needed, all)
        !! `values`, with zeros for the last of `n` parameters where no more than the first
        !! `needed` must be given; as they are where there are too few or too many.
        real(dp), intent(in) :: values(:)              !! in the order of `describe`
        integer, intent(in) :: n, needed
        !! all parameter values; those without a default of 0
        real(dp), allocatable, intent(out) :: all(:)   !! (n)
        integer :: given

        given = size(values)
        if (given < needed .or. given >= n) then
            allocate (all(given))
        else
            allocate (all(n))
        end if
        all = 0.0_dp
        all(:given) = values
    end subroutine add_zeros

    pure function unit_over(unit, energy, of_length, of_angle) result(text)
        !! Of what belongs to a coordinate: that of an energy, or of an action, over the
        !! coordinate's; of a length and an angle as it is called then.
        character(*), intent(in) :: unit                 !! the coordinate's
        character(*), intent(in) :: energy               !! over a coordinate that is a number
        character(*), intent(in) :: of_length, of_angle  !! over m and rad
        character(16) :: text

        select case (unit)
        case ("m"); text = of_length
        case ("rad"); text = of_angle
        case ("1"); text = energy
        case default; text = energy//"/"//unit
        end select
    end function unit_over
end module lagrangia_description
