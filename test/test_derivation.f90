module test_derivation
    !! No line of a derivation is wrong, and what is wrong on purpose is found.
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertGreaterThan, assertTrue
    use lagrangia_cart_pendulum, only: cart_pendulum_t
    use lagrangia_catalogue, only: built_in, new_system, nth_system
    use lagrangia_derivation, only: derivation_t, line_equation, line_kinetic, line_position, &
                                    line_potential, line_stated, line_words
    use lagrangia_derivation_numbers, only: comparison_t, compare_lines
    use lagrangia_derivation_slips, only: find_slip
    use lagrangia_derivation_steps, only: derive, slip_in_formula_t
    use lagrangia_description, only: default_values, description_t
    use lagrangia_errors, only: error_t
    use lagrangia_expression, only: expression_t
    use lagrangia_formula_parser, only: parse_formula
    use lagrangia_formula_program, only: formula_program_t, new_formula_program
    use lagrangia_formula_text, only: formula_text
    use lagrangia_kinds, only: dp
    use lagrangia_random_draws, only: random_t
    use lagrangia_scene_reader, only: read_named_system
    use lagrangia_system, only: system_t
    use lagrangia_text, only: to_text, word_t
    implicit none (type, external)
    private
    public :: derivation_suite

    type, extends(cart_pendulum_t) :: liar_t
        !! A cart-pendulum whose description has a slip.
        integer :: lie = 0  !! 1: T, 2: V, 3: a place, 4: a mass
    contains
        procedure :: describe => describe_falsely
    end type liar_t

contains

    function derivation_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("derivation")
        call suite%addTest(TestMethod("every_line_of_every_system_holds", every_line_holds))
        call suite%addTest(TestMethod("lines_of_scenes_hold", lines_of_scenes_hold))
        call suite%addTest(TestMethod("every_line_is_read_back", every_line_is_read_back))
        call suite%addTest(TestMethod("a_wrong_description_is_found", wrong_description_is_found))
        call suite%addTest(TestMethod("a_slip_is_wrong_where_it_is_put_in", slips_are_found))
        call suite%addTest(TestMethod("derivations_read_like_the_page", reads_like_the_page))
        call suite%addTest(TestMethod("a_remark_is_escaped_for_latex", remark_is_escaped))
    end function derivation_suite

    subroutine check_system(system, random, lines)
        !! All lines at three states; `lines` grows by those that the program knows.
        class(system_t), intent(in) :: system
        type(random_t), intent(inout) :: random
        integer, intent(inout) :: lines
        type(derivation_t) :: derivation
        type(slip_in_formula_t) :: none
        type(comparison_t), allocatable :: comparisons(:)
        type(error_t), allocatable :: error
        integer :: i, k

        call derive(system, none, derivation, error)
        call assertFalse(allocated(error), message="derived")
        if (allocated(error)) return
        do k = 1, 3
            call compare_lines(derivation, system, random, comparisons, error)
            call assertFalse(allocated(error), message="compared")
            if (allocated(error)) return
            do i = 1, derivation%count
                if (comparisons(i)%known) lines = lines + 1
                call assertTrue(comparisons(i)%agrees(), &
                                message=trim(derivation%d%name)//": "//derivation%line_text(i))
            end do
        end do
    end subroutine check_system

    subroutine every_line_holds()
        class(system_t), allocatable :: system
        type(random_t) :: random
        type(error_t), allocatable :: error
        type(description_t) :: d
        real(dp), allocatable :: values(:)
        logical, allocatable :: fixed(:)
        integer, parameter :: of_three_states(3, built_in) = reshape([ &
            45, 36, 36, 57, 69, 63, 117, 117, 117, 111, 111, 111, 48, 54, 54, 81, 81, 81, &
            117, 117, 117, 78, 126, 126, 57, 57, 57, 78, 78, 78, 45, 45, 45, 36, 36, 36, &
            162, 162, 162], [3, built_in])  !! lines of each draw: zeros have fewer terms
        integer :: before, draw, i, lines

        lines = 0
        do i = 1, built_in
            call nth_system(i, system)
            call system%describe(d)
            do draw = 1, 3
                before = lines
                allocate (fixed, source=spread(draw == 1, 1, size(default_values(d))))
                if (d%name == "hanging_chain") fixed(1) = .true.
                call random%parameters(system, .false., values, error, fixed, default_values(d))
                deallocate (fixed)
                call assertFalse(allocated(error), message=trim(d%name)//": parameters")
                if (allocated(error)) cycle
                call check_system(system, random, lines)
                call assertEqual(of_three_states(draw, i), lines - before, &
                                 message=trim(d%name)//": lines compared")
            end do
        end do
    end subroutine every_line_holds

    subroutine lines_of_scenes_hold()
        !! Those with formulas of their own, or with parameters that change the formulas.
        class(system_t), allocatable :: system
        type(random_t) :: random
        type(word_t), allocatable :: overrides(:)
        type(error_t), allocatable :: error
        character(24), parameter :: names(*) = [character(24) :: &
            "spring_pendulum", "double_pendulum_formulas", "atwood_lift", "beads_on_a_cycloid", &
            "coupled_oscillators", "damped_oscillator", "dry_friction", "duffing", "foucault", &
            "kepler", "pendulum_in_x_and_y", "rotating_frame", "skate", "spherical_pendulum", &
            "symmetric_top", "turning_wire", "two_bodies"]
        integer, parameter :: of_three_states(*) = [90, 81, 54, 141, 81, 54, 45, 36, 69, 60, 63, &
            69, 57, 108, 78, 87, 123]
        integer :: i, lines

        allocate (overrides(0))
        do i = 1, size(names)
            lines = 0
            call read_named_system(trim(names(i)), overrides, system, error)
            call assertFalse(allocated(error), message=trim(names(i)))
            if (allocated(error)) cycle
            call check_system(system, random, lines)
            call assertEqual(of_three_states(i), lines, &
                             message=trim(names(i))//": lines compared")
        end do
        deallocate (overrides)
        allocate (overrides(2))
        overrides(1)%text = "charged_particle%trap=2"
        overrides(2)%text = "charged_particle%electric=0.3,-0.4,0.2"
        lines = 0
        call read_named_system("charged_particle", overrides, system, error)
        if (.not. allocated(error)) call check_system(system, random, lines)
        call assertEqual(126, lines, message="a charge in a trap: lines compared")
        overrides(1)%text = "driven_pendulum%b=0.3"
        overrides(2)%text = "driven_pendulum%l=1.3"
        lines = 0
        call read_named_system("driven_pendulum", overrides, system, error)
        if (.not. allocated(error)) call check_system(system, random, lines)
        call assertEqual(45, lines, message="friction in a pivot: lines compared")
        overrides(1)%text = "hanging_chain%n=5"
        overrides(2)%text = "hanging_chain%l=1.3"
        lines = 0
        call read_named_system("hanging_chain", overrides, system, error)
        if (.not. allocated(error)) call check_system(system, random, lines)
        call assertEqual(285, lines, message="five bobs: lines compared")
    end subroutine lines_of_scenes_hold

    subroutine every_line_is_read_back()
        !! The text of a formula means the formula.
        class(system_t), allocatable :: system
        type(derivation_t) :: derivation
        type(slip_in_formula_t) :: none
        type(expression_t) :: pair(2)
        type(formula_program_t) :: program
        type(error_t), allocatable :: error
        type(random_t) :: random
        real(dp), allocatable :: values(:)
        real(dp) :: results(2)
        integer :: i, k, s

        do s = 1, built_in
            call nth_system(s, system)
            call derive(system, none, derivation, error)
            if (allocated(error)) cycle
            allocate (values(size(derivation%symbols%names)))
            do i = 1, size(values)
                call random%uniform(0.5_dp, 2.0_dp, values(i))
            end do
            do k = 1, derivation%count
                if (derivation%lines(k)%kind == line_words) cycle
                pair(1) = derivation%lines(k)%right
                call parse_formula(formula_text(pair(1), derivation%symbols), derivation%symbols, &
                                   pair(2), error)
                call assertFalse(allocated(error), message=derivation%line_text(k))
                if (allocated(error)) cycle
                call new_formula_program(program, pair, size(values))
                call program%evaluate(values, results)
                call assertEqual(results(1), results(2), tolerance=1e-12_dp*abs(results(1)), &
                                 message=derivation%line_text(k))
            end do
            deallocate (values)
        end do
    end subroutine every_line_is_read_back

    pure subroutine describe_falsely(self, d)
        class(liar_t), intent(in) :: self
        type(description_t), intent(out) :: d

        call self%cart_pendulum_t%describe(d)
        select case (self%lie)
        case (1); d%kinetic_energy = "(m1 + m2)/2 x_dot^2 + m2/2 l^2 theta_dot^2"
        case (2); d%potential_energy = "m2 g l cos(theta)"
        case (3); d%points(2)%position(2) = "l cos(theta)"
        case (4); d%points(1)%mass_formula = "m2"
        case default; return
        end select
    end subroutine describe_falsely

    subroutine wrong_description_is_found()
        type(liar_t) :: liar
        type(slip_in_formula_t) :: none
        type(derivation_t) :: derivation
        type(comparison_t), allocatable :: comparisons(:)
        type(random_t) :: random
        type(error_t), allocatable :: error
        integer, parameter :: found_at(0:4) = [0, line_stated, line_potential, line_position, &
                                               line_kinetic]
        integer :: first, k

        call liar%configure([1.3_dp, 0.7_dp, 0.9_dp, 9.81_dp], error)
        do k = 0, 4
            liar%lie = k
            call derive(liar, none, derivation, error)
            if (.not. allocated(error)) then
                call compare_lines(derivation, liar, random, comparisons, error)
            end if
            call assertFalse(allocated(error), message="derived and compared")
            if (allocated(error)) cycle
            first = findloc(comparisons%agrees(), .false., 1)
            if (k == 0) then
                call assertEqual(0, first, message="no lie, nothing found")
            else
                call assertGreaterThan(first, 0, message="lie "//to_text(k)//" is found")
                if (first > 0) call assertEqual(found_at(k), derivation%lines(first)%kind, &
                                                message="the first wrong line of lie "//to_text(k))
            end if
        end do
    end subroutine wrong_description_is_found

    subroutine slips_are_found()
        !! The first line that is wrong is that of the notes.
        character(3), parameter :: ids(5) = ["E1 ", "E2 ", "E3 ", "E21", "E25"]
        integer, parameter :: kinds(5) = [line_equation, line_kinetic, line_equation, &
                                          line_equation, line_equation]
        character(*), parameter :: formulas(5) = [character(100) :: &
            "m2 l (l theta_ddot + x_ddot cos(theta) - g sin(theta)) = 0", &
            "m1/2 x_dot^2 + m2/2 (x_dot^2 + l^2 theta_dot^2 cos^2(theta) "// &
                "+ l^2 theta_dot^2 sin^2(theta))", &
            "m2 l theta_ddot + m2 l x_ddot cos(theta) - m2 g l sin(theta) = 0", &
            "m g sin(alpha) = M (q1_ddot + q2_ddot cos(alpha))", &
            "(m1 + m2) x_ddot + m2 l theta_ddot cos(theta) = m2 l theta_ddot^2 sin(theta)"]
        class(system_t), allocatable :: system
        type(description_t) :: d
        type(derivation_t) :: derivation
        type(comparison_t), allocatable :: comparisons(:)
        type(slip_in_formula_t) :: slip
        type(random_t) :: random
        type(error_t), allocatable :: error
        real(dp), allocatable :: values(:)
        integer :: first, k

        do k = 1, 5
            call new_system(trim(merge("wedge        ", "cart_pendulum", ids(k) == "E21")), &
                            system, error)
            call random%parameters(system, .false., values, error)
            call system%describe(d)
            call find_slip(trim(ids(k)), trim(d%name), slip, error)
            call assertFalse(allocated(error), message=ids(k))
            if (allocated(error)) cycle
            call assertEqual(formulas(k), slip%formula, message=ids(k)//": what is put in")
            call derive(system, slip, derivation, error)
            if (.not. allocated(error)) then
                call compare_lines(derivation, system, random, comparisons, error)
            end if
            call assertFalse(allocated(error), message=ids(k)//" derived")
            if (allocated(error)) cycle
            first = findloc(comparisons%agrees(), .false., 1)
            call assertGreaterThan(first, 0, message=ids(k)//" is found")
            if (first == 0) cycle
            call assertTrue(derivation%lines(first)%slipped, message=ids(k)//" is the first")
            call assertEqual(kinds(k), derivation%lines(first)%kind, message=ids(k)//": which line")
        end do
        call find_slip("E7", "double_pendulum", slip, error)
        call assertTrue(allocated(error), message="E7 is no formula")
        call find_slip("E1", "wedge", slip, error)
        call assertTrue(allocated(error), message="E1 is of the cart-pendulum")
    end subroutine slips_are_found

    subroutine reads_like_the_page()
        call reads("cart_pendulum", [character(100) :: &
            "x_bob = x + l sin(theta)", &
            "= (m1 + m2)/2 x_dot^2 + m2/2 l^2 theta_dot^2 + m2 l x_dot theta_dot cos(theta)", &
            "(m1 + m2) x_ddot + m2 l theta_ddot cos(theta) - m2 l theta_dot^2 sin(theta) = 0", &
            "dL/dtheta = -m2 l x_dot theta_dot sin(theta) - m2 g l sin(theta)", &
            "m2 l^2 theta_ddot + m2 l x_ddot cos(theta) + m2 g l sin(theta) = 0", &
            "l theta_ddot + x_ddot cos(theta) + g sin(theta) = 0", &
            "x_ddot = m2 sin(theta) (l theta_dot^2 + g cos(theta))/(m1 + m2 sin(theta)^2)", &
            "(m1 + m2) x_ddot + m2 l theta_ddot = 0", &
            "x_ddot + l theta_ddot + g theta = 0", &
            "m1 l theta_ddot + (m1 + m2) g theta = 0", &
            "omega^2 = (m1 + m2) g/(m1 l)"])
        call reads("double_pendulum", [character(100) :: &
            "(m1 + m2) l1 theta1_ddot + m2 l2 theta2_ddot + (m1 + m2) g theta1 = 0", &
            "l1 theta1_ddot + l2 theta2_ddot + g theta2 = 0"])
        call reads("rotating_hoop", [character(100) :: &
            "theta_ddot = omega^2 sin(theta) cos(theta) - g/r sin(theta)", &
            "Omega^2 = g/r - omega^2", "cos(theta) = g/(omega^2 r)", &
            "Omega^2 = -g^2/(r^2 omega^2) + omega^2"])
        call reads("driven_pendulum", [character(100) :: &
            "theta_ddot = -sin(theta) (g - a W^2 cos(W t))/l"])
    end subroutine reads_like_the_page

    subroutine remark_is_escaped()
        !! What is no formula is typed as it is; what comes with its LaTeX is not touched.
        type(derivation_t) :: derivation

        allocate (derivation%lines(2))
        call derivation%add_words("not x_1 = a^2 & 50 %")
        call derivation%add_words("x^2", "$x^2$")
        call assertEqual("not x_1 = a^2 & 50 %", derivation%lines(1)%left, message="as typed")
        call assertEqual("not x\_1 = a\^{}2 \& 50 \%", derivation%lines(1)%left_latex, &
                         message="no power is opened by what is no formula")
        call assertEqual("$x^2$", derivation%lines(2)%left_latex, message="as given")
    end subroutine remark_is_escaped

    subroutine reads(name, page)
        !! The derivation of a system has these lines in this order.
        character(*), intent(in) :: name, page(:)
        class(system_t), allocatable :: system
        type(slip_in_formula_t) :: none
        type(derivation_t) :: derivation
        type(error_t), allocatable :: error
        integer :: at, i, k

        call new_system(name, system, error)
        call derive(system, none, derivation, error)
        at = 0
        do k = 1, size(page)
            do i = at + 1, derivation%count
                if (derivation%line_text(i) == page(k)) exit
            end do
            call assertTrue(i <= derivation%count, message="in this order: "//trim(page(k)))
            if (i <= derivation%count) at = i
        end do
    end subroutine reads
end module test_derivation
