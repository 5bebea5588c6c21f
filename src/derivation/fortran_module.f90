module lagrangia_fortran_module
    !! A system in formulas as a module in Fortran: a type that extends `lagrangian_system_t`, with
    !! what a student would write by hand: L, the equations of motion alone and in lanes, energy,
    !! momenta, and where the points are. The library's audit compares all of it with L.
    use lagrangia_canonical_form, only: simplified
    use lagrangia_description, only: description_t, name_length
    use lagrangia_errors, only: error_t, fail
    use lagrangia_expression, only: expression_t
    use lagrangia_formula_fortran, only: fortran_text
    use lagrangia_fortran_constraints, only: add_constraints
    use lagrangia_fortran_motion, only: find_motion, motion_statements_t
    use lagrangia_fortran_names, only: find_names
    use lagrangia_fortran_outline, only: add_outline
    use lagrangia_fortran_procedures, only: element, open_names, open_procedure
    use lagrangia_fortran_statements, only: fortran_lines_t
    use lagrangia_text, only: lower, quoted, to_text, word_t
    use lagrangia_written_constraints, only: with_multipliers
    use lagrangia_written_motion, only: written_motion_t
    use lagrangia_written_system, only: written_system_t
    implicit none (type, external)
    private
    public :: write_fortran_module

    integer, parameter :: most_lines = 255  !! of one statement

contains

    subroutine write_fortran_module(system, source, lines, error)
        !! The whole module, to be compiled against the library.
        class(written_system_t), intent(in) :: system       !! with its parameters
        character(*), intent(in) :: source                  !! where its formulas are
        type(fortran_lines_t), intent(out) :: lines         !! of the module
        type(error_t), allocatable, intent(out) :: error    !! a formula is too long
        type(description_t) :: d
        type(written_motion_t) :: motion

        call system%describe(d)
        d%name = lower(d%name)
        motion = system%motion
        if (system%constraints > 0) call with_multipliers(system%motion, &
            system%expressions%constraints, system%expressions%symbols, motion)
        call add_head(system, d, source, lines)
        call add_outline(system, d, lines)
        call add_lagrangian(system, d, lines)
        if (system%nonconservative) call add_forces(system, d, lines)
        call add_motion(system, d, motion, .false., lines)
        call add_motion(system, d, motion, .true., lines)
        if (system%constraints > 0) call add_constraints(system, d, lines)
        call add_energy(system, d, lines)
        call add_momenta(system, d, lines)
        call add_quantities(system, d, lines)
        if (size(d%points) > 0) call add_positions(system, d, lines)
        if (size(d%rotors) > 0) call add_angles(system, d, lines)
        call lines%add(0, "end module "//trim(d%name))
        if (lines%longest > most_lines) call fail(error, trim(d%name)//": a formula takes more "// &
            "than "//to_text(most_lines)//" lines, which Fortran does not allow")
    end subroutine write_fortran_module

    subroutine add_head(system, d, source, lines)
        !! To `contains`.
        class(written_system_t), intent(in) :: system
        type(description_t), intent(in) :: d
        character(*), intent(in) :: source
        type(fortran_lines_t), intent(inout) :: lines
        character(:), allocatable :: name

        name = trim(d%name)
        call lines%add(0, "module "//name)
        if (d%title /= "") call lines%add(4, "!! "//trim(d%title))
        if (d%title /= "") call lines%add(4, "!!")
        call lines%add(4, "!! Written by 'lagrangia derive --fortran' from "//quoted(source)// &
                       ". A program with this system:")
        call lines%add(4, "!!")
        call lines%add(4, "!!     call register_system("//name//"_t(), error)")
        call lines%add(4, "!!     call lagrangia_main(error)")
        call lines%add(4, "!!")
        call lines%add(4, "!! Its scenes say system = '"//name//"' and have no group &lagrangian.")
        call lines%add(4, "use lagrangia, only: abs, assignment(=), atan, "// &
                       "constraint_length, coordinate, cos, cosh, description_t, dp, exp, "// &
                       "formula_length, hyperdual_t, lagrangian_system_t, lanes, letter_t, "// &
                       "log, mass_point, nonnegative, operator(*), operator(**), operator(+), "// &
                       "operator(-), operator(/), positive, quantity, real_number, sgn, "// &
                       "sin, sine_cosine, sinh, sqrt, tan, tanh")
        call lines%add(4, "implicit none (type, external)")
        call lines%add(4, "private")
        call lines%add(4, "public :: "//name//"_t")
        call lines%add(0, "")
        call lines%add(4, "type, extends(lagrangian_system_t) :: "//name//"_t")
        call lines%add(4, "contains")
        call lines%add(8, "procedure :: outline")
        call lines%add(8, "procedure :: lagrangian")
        if (system%nonconservative) call lines%add(8, "procedure :: generalised_forces")
        call lines%add(8, "procedure :: accelerations")
        call lines%add(8, "procedure :: accelerations_lanes")
        if (system%constraints > 0) then
            call lines%add(8, "procedure :: prepare")
            call lines%add(8, "procedure :: constraint_rows")
            if (any(system%holonomic)) call lines%add(8, "procedure :: constraint_values")
        end if
        call lines%add(8, "procedure :: energy")
        call lines%add(8, "procedure :: momenta")
        call lines%add(8, "procedure :: quantity => momentum_or_own")
        if (size(d%points) > 0) call lines%add(8, "procedure :: positions")
        if (size(d%rotors) > 0) call lines%add(8, "procedure :: angles")
        call lines%add(4, "end type "//name//"_t")
        call lines%add(0, "")
        call lines%add(0, "contains")
    end subroutine add_head

    subroutine add_lagrangian(system, d, lines)
        !! L, as it was typed.
        class(written_system_t), intent(in) :: system
        type(description_t), intent(in) :: d
        type(fortran_lines_t), intent(inout) :: lines
        type(word_t), allocatable :: names(:)
        character(:), allocatable :: text

        call find_names(system%expressions%symbols%names, &
                        [character(name_length) :: d%name, "value"], names)
        call open_procedure(d, "pure function lagrangian(self, t, q, v) result(value)", "L, J.", &
                            [character(70) :: &
                             "type(hyperdual_t), intent(in) :: t, q(self%ndof), v(self%ndof)", &
                             "type(hyperdual_t) :: value"], lines)
        call open_names(d, names, .true., .false., lines)
        call fortran_text(system%expressions%lagrangian, names, text)
        call lines%assign(12, "value", text)
        call lines%add(8, "end associate")
        call lines%add(4, "end function lagrangian")
    end subroutine add_lagrangian

    subroutine add_forces(system, d, lines)
        !! Q of each coordinate.
        class(written_system_t), intent(in) :: system
        type(description_t), intent(in) :: d
        type(fortran_lines_t), intent(inout) :: lines
        type(word_t), allocatable :: names(:)
        character(:), allocatable :: text
        integer :: i

        call find_names(system%expressions%symbols%names, &
                        [character(name_length) :: d%name, "f"], names)
        call open_procedure(d, "pure subroutine generalised_forces(self, t, q, v, f)", &
                            "Q of each coordinate: the forces that L lacks.", [character(70) :: &
                             "type(hyperdual_t), intent(in) :: t, q(self%ndof), v(self%ndof)", &
                             "type(hyperdual_t), intent(out) :: f(self%ndof)"], lines)
        call open_names(d, names, .true., .false., lines)
        do i = 1, size(d%coordinates)
            call fortran_text(system%expressions%forces(i), names, text)
            call lines%assign(12, "f("//to_text(i)//")", text)
        end do
        call lines%add(8, "end associate")
        call lines%add(4, "end subroutine generalised_forces")
    end subroutine add_forces

    subroutine add_motion(system, d, motion, lanes, lines)
        !! M and the right side, then the accelerations by elimination, and the multipliers.
        class(written_system_t), intent(in) :: system
        type(description_t), intent(in) :: d
        type(written_motion_t), intent(in) :: motion  !! with a row for each constraint
        logical, intent(in) :: lanes  !! of eight states at once
        type(fortran_lines_t), intent(inout) :: lines
        type(word_t), allocatable :: names(:)
        type(motion_statements_t) :: body
        character(:), allocatable :: kind, name, name_of, of, number, purpose, time
        character(80) :: arguments(2)
        integer :: i

        call find_names(system%expressions%symbols%names, &
                        [character(name_length) :: d%name, "a"], names)
        call find_motion(motion, system%expressions%symbols, names, body)
        name = "accelerations"
        purpose = "Lagrange's equations, solved for the second derivatives of the coordinates."
        if (system%constraints > 0) purpose = purpose//" Behind them, from a"// &
            to_text(system%ndof + 1)//", come the multipliers of the constraints."
        kind = "real(dp) :: "
        of = "self%ndof"
        time = "t"
        if (lanes) then
            name = "accelerations_lanes"
            purpose = "`accelerations`, in all lanes at once."
            kind = "real(dp), dimension(lanes) :: "
            of = "lanes, self%ndof"
            time = "t(lanes)"
        end if
        arguments(1) = "real(dp), intent(in) :: "//time//", q("//of//"), v("//of//")"
        arguments(2) = "real(dp), intent(out) :: a("//of//")"
        call open_procedure(d, "pure subroutine "//name//"(self, t, q, v, a)", purpose, arguments, &
                            lines)
        call lines%add(8, kind//body%locals(lanes))
        call open_names(d, names, .true., lanes, lines)
        do i = 1, size(body%angles)
            number = to_text(i)
            if (lanes) then
                call lines%add(12, "angle"//number//" = "//body%angles(i)%text)
                call lines%add(12, "call sine_cosine(angle"//number//", sine"//number// &
                               ", cosine"//number//")")
            else
                name_of = "sine"//number
                if (body%mentions(name_of)) call lines%add(12, name_of//" = sin("// &
                                                           body%angles(i)%text//")")
                name_of = "cosine"//number
                if (body%mentions(name_of)) call lines%add(12, name_of//" = cos("// &
                                                           body%angles(i)%text//")")
            end if
        end do
        do i = 1, size(body%list)
            call lines%add(12, body%list(i)%text)
        end do
        do i = 1, size(d%coordinates)
            call lines%add(12, element("a", i, lanes)//" = a"//to_text(i))
        end do
        call lines%add(8, "end associate")
        call lines%add(4, "end subroutine "//name)
    end subroutine add_motion

    subroutine add_energy(system, d, lines)
        !! The energy function.
        class(written_system_t), intent(in) :: system
        type(description_t), intent(in) :: d
        type(fortran_lines_t), intent(inout) :: lines
        type(word_t), allocatable :: names(:)
        type(expression_t) :: energy
        character(:), allocatable :: text

        call find_names(system%expressions%symbols%names, &
                        [character(name_length) :: d%name, "value"], names)
        energy = simplified(system%motion%energy, system%expressions%symbols)
        call fortran_text(energy, names, text)
        call open_procedure(d, "pure function energy(self, t, q, v) result(value)", &
                            "The sum of q_dot dL/dq_dot, less L, J.", [character(70) :: &
                             "real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)", &
                             "real(dp) :: value"], lines)
        call open_names(d, names, .true., .false., lines)
        call lines%assign(12, "value", text)
        call lines%add(8, "end associate")
        call lines%add(4, "end function energy")
    end subroutine add_energy

    subroutine add_momenta(system, d, lines)
        !! The momenta.
        class(written_system_t), intent(in) :: system
        type(description_t), intent(in) :: d
        type(fortran_lines_t), intent(inout) :: lines
        type(word_t), allocatable :: names(:)
        type(expression_t) :: momentum
        character(:), allocatable :: text
        integer :: i

        call find_names(system%expressions%symbols%names, &
                        [character(name_length) :: d%name, "p"], names)
        call open_procedure(d, "pure subroutine momenta(self, t, q, v, p)", &
                            "dL/dq_dot of each coordinate.", [character(70) :: &
                             "real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)", &
                             "real(dp), intent(out) :: p(self%ndof)"], lines)
        call open_names(d, names, .true., .false., lines)
        do i = 1, size(d%coordinates)
            momentum = simplified(system%motion%momenta(i), system%expressions%symbols)
            call fortran_text(momentum, names, text)
            call lines%assign(12, "p("//to_text(i)//")", text)
        end do
        call lines%add(8, "end associate")
        call lines%add(4, "end subroutine momenta")
    end subroutine add_momenta

    subroutine add_quantities(system, d, lines)
        !! The momenta, then the scene's own quantities, by their number.
        class(written_system_t), intent(in) :: system
        type(description_t), intent(in) :: d
        type(fortran_lines_t), intent(inout) :: lines
        type(word_t), allocatable :: names(:)
        character(:), allocatable :: text
        integer :: i, m, n, own

        n = size(d%coordinates)
        m = system%constraints
        own = size(system%expressions%quantities)
        call find_names(system%expressions%symbols%names, &
                        [character(name_length) :: d%name, "i", "lambda", "p", "value"], names)
        call open_procedure(d, "pure function momentum_or_own(self, i, t, q, v) result(value)", &
                            "The momenta, then the quantities of `outline`.", [character(70) :: &
                             "integer, intent(in) :: i", &
                             "real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)", &
                             "real(dp) :: value, p(self%ndof)"], lines)
        if (m > 0) call lines%add(8, "real(dp) :: lambda("//to_text(m)//")")
        call open_names(d, names, .true., .false., lines)
        call lines%add(12, "select case (i)")
        do i = 1, own
            call add_value(n + i, system%expressions%quantities(i))
        end do
        do i = 1, m
            call add_value(n + own + m + i, system%expressions%constraints(i))
        end do
        if (m > 0) then
            text = to_text(n + own + 1)
            if (m > 1) text = text//":"//to_text(n + own + m)
            call lines%add(12, "case ("//text//")")
            call lines%add(16, "call self%multipliers(t, q, v, lambda)")
            call lines%add(16, "value = lambda(i - "//to_text(n + own)//")")
        end if
        call lines%add(12, "case default")
        call lines%add(16, "call self%momenta(t, q, v, p)")
        call lines%add(16, "value = p(i)")
        call lines%add(12, "end select")
        call lines%add(8, "end associate")
        call lines%add(4, "end function momentum_or_own")
    contains
        subroutine add_value(number, formula)
            !! A case.
            integer, intent(in) :: number
            type(expression_t), intent(in) :: formula

            call fortran_text(formula, names, text)
            call lines%add(12, "case ("//to_text(number)//")")
            call lines%assign(16, "value", text)
        end subroutine add_value
    end subroutine add_quantities

    subroutine add_positions(system, d, lines)
        !! x, y, z of each point.
        class(written_system_t), intent(in) :: system
        type(description_t), intent(in) :: d
        type(fortran_lines_t), intent(inout) :: lines
        type(word_t), allocatable :: names(:)
        character(:), allocatable :: text
        integer :: i, k

        call find_names(system%expressions%symbols%names, &
                        [character(name_length) :: d%name, "r"], names)
        call open_procedure(d, "pure subroutine positions(self, t, q, r)", &
                            "x, y, z of each point, m.", [character(70) :: &
                             "type(hyperdual_t), intent(in) :: t, q(self%ndof)", &
                             "type(hyperdual_t), intent(out) :: r(:, :)"], lines)
        call open_names(d, names, .false., .false., lines)
        do i = 1, size(d%points)
            do k = 1, 3
                call fortran_text(system%expressions%places(3*i - 3 + k), names, text)
                call lines%assign(12, "r("//to_text(k)//", "//to_text(i)//")", text)
            end do
        end do
        call lines%add(8, "end associate")
        call lines%add(4, "end subroutine positions")
    end subroutine add_positions

    subroutine add_angles(system, d, lines)
        !! How each rotor is turned.
        class(written_system_t), intent(in) :: system
        type(description_t), intent(in) :: d
        type(fortran_lines_t), intent(inout) :: lines
        type(word_t), allocatable :: names(:)
        character(:), allocatable :: text
        integer :: i

        call find_names(system%expressions%symbols%names, &
                        [character(name_length) :: d%name, "phi"], names)
        call open_procedure(d, "pure subroutine angles(self, t, q, phi)", &
                            "The angle of each rotor, rad.", [character(70) :: &
                             "type(hyperdual_t), intent(in) :: t, q(:)", &
                             "type(hyperdual_t), intent(out) :: phi(:)"], lines)
        call open_names(d, names, .false., .false., lines)
        do i = 1, size(d%rotors)
            call fortran_text(system%expressions%angles(i), names, text)
            call lines%assign(12, "phi("//to_text(i)//")", text)
        end do
        call lines%add(8, "end associate")
        call lines%add(4, "end subroutine angles")
    end subroutine add_angles
end module lagrangia_fortran_module
