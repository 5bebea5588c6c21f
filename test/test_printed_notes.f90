module test_printed_notes
    !! Equations in the notes of a description: what can be read as one in the system's letters is
    !! true at random states, or stands in a list of those that hold only sometimes.
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertGreaterThan, assertTrue
    use lagrangia_catalogue, only: new_system, system_names
    use lagrangia_description, only: description_t
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp
    use lagrangia_named_values, only: motion_state_t
    use lagrangia_random_draws, only: random_t
    use lagrangia_statements, only: statements_t
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: printed_notes_suite

    real(dp), parameter :: rounding = 1e-11_dp  !! of some ten operations on numbers of some ten

contains

    function printed_notes_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("printed_notes")
        call suite%addTest(TestMethod("equations_in_notes_hold", equations_in_notes_hold))
        call suite%addTest(TestMethod("vectors_are_their_components", &
                                      vectors_are_their_components))
    end function printed_notes_suite

    subroutine equations_in_notes_hold()
        !! What does not is a special case, which the note names.
        character, parameter :: next = new_line("a")
        character(*), parameter :: special = next//"atwood: a_s = 0"//next//"atwood: I = 0"// &
                                             next//"wedge: alpha = pi/2"
        character(32), allocatable :: names(:)
        character(:), allocatable :: untrue
        integer :: i

        untrue = ""
        allocate (names, source=system_names())
        do i = 1, size(names)
            call read_notes(trim(names(i)), untrue)
        end do
        call assertEqual(special, untrue)
    end subroutine equations_in_notes_hold

    subroutine read_notes(name, untrue)
        !! Of one system, clause by clause.
        character(*), intent(in) :: name
        character(:), allocatable, intent(inout) :: untrue
        class(system_t), allocatable :: system
        type(description_t) :: d
        type(error_t), allocatable :: error
        character(:), allocatable :: rest, clause
        integer :: i, at
        logical :: ok, holds

        call new_system(name, system, error)
        call system%describe(d)
        do i = 1, size(d%notes)
            rest = trim(d%notes(i))
            do while (rest /= "")
                at = scan(rest//";", ",;:")
                if (index(rest//". ", ". ") < at) at = index(rest//". ", ". ")
                clause = trim(adjustl(rest(:at - 1)))
                rest = rest(min(len(rest) + 1, at + 1):)
                if (index(clause, " = ") == 0) cycle
                call judge(name, clause, ok, holds)
                if (ok .and. .not. holds) untrue = untrue//new_line("a")//name//": "//clause
            end do
        end do
    end subroutine read_notes

    subroutine judge(name, text, ok, holds)
        !! Whether a text is an equation, and whether it holds in three states.
        character(*), intent(in) :: name, text
        logical, intent(out) :: ok, holds
        class(system_t), allocatable :: system
        type(description_t) :: d
        type(error_t), allocatable :: error
        type(motion_state_t) :: state
        type(statements_t) :: statements
        type(random_t) :: random
        real(dp), allocatable :: values(:)
        real(dp) :: left(1), right(1)
        integer :: k

        call new_system(name, system, error)
        ok = .true.
        holds = .true.
        do k = 1, 3
            call random%parameters(system, .false., values, error)
            call system%describe(d)
            call random%state(system, state%t, state%q, state%v, error)
            state%a = state%v
            call system%accelerations(state%t, state%q, state%v, state%a)
            state%q0 = state%q
            state%v0 = state%v
            call statements%begin(system, d, state, error)
            call statements%add_equation(text, error)
            ok = .not. allocated(error)
            if (.not. ok) return
            call statements%finish()
            call statements%evaluate(system, d, state, left, right)
            holds = holds .and. abs(left(1) - right(1)) <= rounding*(1.0_dp + abs(left(1)))
        end do
    end subroutine judge

    subroutine vectors_are_their_components()
        !! L and the equation of motion of the charge, written with vectors.
        class(system_t), allocatable :: system
        type(description_t) :: d
        type(error_t), allocatable :: error
        character(:), allocatable :: text
        integer :: at

        call new_system("charged_particle", system, error)
        call system%describe(d)
        text = trim(d%notes(1))
        at = index(text, " with A = B x r/2, the symmetric gauge.")
        call assertGreaterThan(at, 0, message=text)
        if (at == 0) return
        text = text(index(text, "L = ") + 4:at - 1)
        call exchange(text, "v.v", "(x_dot^2 + y_dot^2 + z_dot^2)")
        call exchange(text, "E.r", "(E_x x + E_y y + E_z z)")
        call exchange(text, "A.v", "((B_y z - B_z y)/2 x_dot + (B_z x - B_x z)/2 y_dot "// &
                      "+ (B_x y - B_y x)/2 z_dot)")
        call exchange(text, "r.r", "(x^2 + y^2 + z^2)")
        call is_so(text//" = T - V", .true.)
        call exchange(text, "- trap", "+ trap")
        call is_so(text//" = T - V", .false.)
        text = trim(d%notes(2))
        text = text(:index(text, ". ") - 1)
        call exchange(text, "v_dot", "z_ddot")
        call exchange(text, "v x B", "(x_dot B_y - y_dot B_x)")
        call exchange(text, "(E ", "(E_z ")
        call exchange(text, "trap r", "trap z")
        call is_so(text, .true.)
        call exchange(text, "- trap", "+ trap")
        call is_so(text, .false.)
    contains
        subroutine exchange(line, old, new)
            character(:), allocatable, intent(inout) :: line
            character(*), intent(in) :: old, new
            integer :: place

            place = index(line, old)
            call assertGreaterThan(place, 0, message=old//" in "//line)
            if (place > 0) line = line(:place - 1)//new//line(place + len(old):)
        end subroutine exchange

        subroutine is_so(equation, expected)
            character(*), intent(in) :: equation
            logical, intent(in) :: expected
            logical :: ok, holds

            call judge("charged_particle", equation, ok, holds)
            call assertTrue(ok, equation)
            if (expected) then
                call assertTrue(holds, equation)
            else
                call assertFalse(holds, equation)
            end if
        end subroutine is_so
    end subroutine vectors_are_their_components
end module test_printed_notes
