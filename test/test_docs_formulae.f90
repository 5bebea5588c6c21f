module test_docs_formulae
    !! Formulas in the texts: in the README and docs, and in words of a description.
    use formula, only: formula_value, names_t
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertTrue
    use lagrangia_catalogue, only: new_system
    use lagrangia_description, only: description_t
    use lagrangia_errors, only: error_t
    use lagrangia_files, only: read_whole_file
    use lagrangia_grading, only: grade, grade_t
    use lagrangia_homework, only: homework_t, parse_homework
    use lagrangia_judgement, only: is_right
    use lagrangia_kinds, only: dp
    use lagrangia_reference, only: reference_t
    use lagrangia_scene, only: scene_t
    use lagrangia_scene_reader, only: parse_scene
    use lagrangia_small_oscillations, only: find_modes, modes_t
    use lagrangia_system, only: system_t
    use lagrangia_text, only: word_t
    implicit none (type, external)
    private
    public :: docs_formulae_suite

    character, parameter :: line_feed = new_line("a")
    character(*), parameter :: about(*) = [character(24) :: "README.md", "docs/animation.md", &
        "docs/derive.md", "docs/grading.md", "docs/reliability.md", "docs/scenes.md", &
        "docs/stress.md", "docs/your_own_system.md"]

    character(*), parameter :: syntax(*) = [character(52) :: &
        "lagrangia = { path = ""..."" }", "let NAME = FORMULA", "set: g = 9.81", "a = b", &
        "a = b = c", "D = theta1 - theta2", "v^2 = l^2 theta_dot^2", "'D = theta1 - theta2'", &
        "T = 'm/2 r_dot^2', '+ m/2 r^2 theta_dot^2'", "columns = 't', 'theta', ...", &
        "method = 'auto'", "'x^2 + y^2 = l^2'", "'x_dot = r sin(theta) phi_dot'", &
        "'y cos(w t) = x sin(w t)'", "'cos(theta) = g/(w^2 r)'", "'cos(theta) = g/l0'", &
        "'L_z [kg m^2/s] angular momentum = m r^2 theta_dot'", &
        "constraint = 'd_1 .. d_3 = l^2'", "definitions = 'd_1 .. d_3 = (x_(i + 1) - x_i)^2'", &
        "p_x = const", "T = 2 pi sqrt(l/g)", "=> x_ddot = g", "with D = ...", "Energy: E = T + V", &
        "x = l sin(theta), y = -l cos(theta)", "x' = x + s", "omega = theta_dot", &
        "theta_dot^2/2 = g/l cos(theta) + h", &
        "g = 4 pi^2 l/T^2", "set: magnetic_z = 2", "set: m1 = 1, m2 = 2", &
        "set: B_z = 2", "set: alpha = pi/4", "set: l = 0.5 m", "E_x = 0", &
        "dT/dx = -k x", "E = k A^2/2", &
        "x = x_0 + v_0 t + a t^2/2", "theta_eq = pi", "V_eff = p_phi^2/(2 m r^2) + V", &
        "v^2 = v_0^2 - 2 g y", "i_roll = m r^2/2", "l1 = l2", "m1 = m2 = m", "I = M R^2/2", &
        "omega_1 = ...", "tension = m g", "theta = pi + u", "p_x = 0", &
        "x x_dot + y y_dot = 0"]
    !! spans with '=' that state nothing about a system

    character(*), parameter :: spherical = "&scene system = 'spherical', dt = 0.1, "// &
        "duration = 1.0, q = 1.0, 1.0 /"//line_feed// &
        "&lagrangian coordinates = 'theta', 'phi', parameters = 'm', 'l', 'g', "// &
        "T = 'm/2 l^2 (theta_dot^2 + sin(theta)^2 phi_dot^2)', V = '-m g l cos(theta)' /"// &
        line_feed//"&spherical m = 1.0, l = 1.0, g = 9.81 /"
    !! of docs/your_own_system.md

contains

    function docs_formulae_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("docs_formulae")
        call suite%addTest(TestMethod("spans_of_the_texts_are_right", spans_of_the_texts_are_right))
        call suite%addTest(TestMethod("slips_in_a_text_are_seen", slips_in_a_text_are_seen))
        call suite%addTest(TestMethod("period_by_the_mean", period_by_the_mean))
        call suite%addTest(TestMethod("zeros_of_laguerre", zeros_of_laguerre))
    end function docs_formulae_suite

    subroutine spans_of_the_texts_are_right()
        !! Each span of code with an equality, outside of blocks, is syntax, or is graded as right.
        type(error_t), allocatable :: error
        character(:), allocatable :: text, wrong
        integer :: i, stated

        stated = 0
        do i = 1, size(about)
            call read_whole_file(trim(about(i)), text, error)
            call assertFalse(allocated(error), trim(about(i))//" is there")
            if (allocated(error)) cycle
            call read_spans(text, wrong, stated)
            call assertTrue(wrong == "", trim(about(i))//": "//wrong)
        end do
        call assertEqual(1, stated, "formulas that state something")
    end subroutine spans_of_the_texts_are_right

    subroutine slips_in_a_text_are_seen()
        !! A wrong factor, and a formula of which nobody knows what it is about.
        character(:), allocatable :: wrong
        integer :: stated

        stated = 0
        call read_spans("lost: `phi_ddot = -theta_dot phi_dot cos(theta)/sin(theta)`,", wrong, &
                        stated)
        call assertTrue(index(wrong, "phi_ddot") > 0, wrong)
        call read_spans("and `x_ddot = 3 y` so", wrong, stated)
        call assertTrue(index(wrong, "x_ddot") > 0, wrong)
        call read_spans("```"//line_feed//"`x = 3`"//line_feed//"```"//line_feed//"`a = b`", &
                        wrong, stated)
        call assertEqual("", wrong, "in blocks, and syntax")
    end subroutine slips_in_a_text_are_seen

    subroutine read_spans(text, wrong, stated)
        !! Those between backquotes on a line; blocks are read back elsewhere.
        character(*), intent(in) :: text
        character(:), allocatable, intent(out) :: wrong  !! the spans that are not right
        integer, intent(inout) :: stated                 !! spans that are
        character(:), allocatable :: line, span
        integer :: first, last, from, to
        logical :: in_block

        wrong = ""
        in_block = .false.
        first = 1
        do while (first <= len(text))
            last = first + index(text(first:)//line_feed, line_feed) - 2
            line = text(first:last)
            first = last + 2
            if (index(adjustl(line), "```") == 1) in_block = .not. in_block
            if (in_block .or. index(line, "    ") == 1 .or. index(line, "```") > 0) cycle
            do
                from = index(line, "`")
                if (from == 0) exit
                to = from + index(line(from + 1:), "`")
                if (to == from) exit
                span = line(from + 1:to - 1)
                line = line(to + 1:)
                if (index(span, " = ") == 0 .or. any(syntax == span)) cycle
                if (is_stated_right(span)) then
                    stated = stated + 1
                else
                    wrong = wrong//span//"; "
                end if
            end do
        end do
    end subroutine read_spans

    logical function is_stated_right(statement)
        !! About the system of the docs.
        character(*), intent(in) :: statement
        class(system_t), allocatable :: system
        type(scene_t) :: scene
        type(homework_t) :: homework
        type(grade_t) :: result
        type(error_t), allocatable :: error
        type(word_t) :: none(0)

        is_stated_right = .false.
        call parse_scene(spherical, "docs", none, scene, system, error)
        if (.not. allocated(error)) call parse_homework("system: x"//line_feed//statement, "docs", &
                                                        homework, error)
        if (.not. allocated(error)) call grade(homework, system, result, error)
        if (allocated(error)) return
        is_stated_right = result%of(1)%verdict == is_right
    end function is_stated_right

    subroutine period_by_the_mean()
        !! The pendulum's note, `Undamped: period 2 pi sqrt(l/g)/agm(1, cos(theta0/2))`, against
        !! the closed form.
        real(dp), parameter :: l = 1.7_dp, g = 9.81_dp, theta0 = 2.2_dp
        class(system_t), allocatable :: system
        class(reference_t), allocatable :: reference
        type(description_t) :: d
        type(error_t), allocatable :: error
        type(names_t) :: names
        character(:), allocatable :: note
        real(dp) :: period, size_of
        integer :: at
        logical :: ok

        call new_system("pendulum", system, error)
        call system%configure([0.8_dp, l, g], error)
        call system%describe(d)
        note = trim(d%notes(2))
        at = index(note, "/agm(1, cos(theta0/2)), agm the arithmetic-geometric mean.")
        call assertTrue(index(note, "Undamped: period ") == 1 .and. at > 0, note)
        if (at == 0) return
        call names%set("pi", acos(-1.0_dp))
        call names%set("l", l)
        call names%set("g", g)
        call formula_value(note(18:at - 1), names, period, size_of, ok)
        call assertTrue(ok, note(18:at - 1))
        call system%closed_form(0.0_dp, [theta0], [0.0_dp], reference)
        call assertEqual(reference%period, period/mean(1.0_dp, cos(0.5_dp*theta0)), &
                         1e-14_dp*period, note)
    contains
        pure function mean(a, b) result(m)
            !! Gauss' arithmetic-geometric mean.
            real(dp), intent(in) :: a, b
            real(dp) :: m, geometric, next
            integer :: i

            m = a
            geometric = b
            do i = 1, 8
                next = 0.5_dp*(m + geometric)
                geometric = sqrt(m*geometric)
                m = next
            end do
        end function mean
    end subroutine period_by_the_mean

    subroutine zeros_of_laguerre()
        !! The chain's note: \(L_n(\omega^2\ell/(n g)) = 0\).
        class(system_t), allocatable :: system
        type(description_t) :: d
        type(error_t), allocatable :: error
        type(modes_t) :: modes
        real(dp), allocatable :: start(:)
        real(dp) :: x, length, g
        integer :: i, n

        call new_system("hanging_chain", system, error)
        call system%describe(d)
        call assertTrue(d%notes(1) == "omega^2 = n g/l times the zeros of Laguerre's "// &
                        "polynomial L_n.", trim(d%notes(1)))
        n = system%ndof
        length = value_of("l")
        g = value_of("g")
        allocate (start(n), source=0.0_dp)
        call find_modes(system, start, .true., modes, error)
        call assertFalse(allocated(error), "modes")
        if (allocated(error)) return
        do i = 1, n
            x = modes%omega2(i)*length/(n*g)
            call assertTrue(abs(laguerre(n, x)) <= 1e-9_dp*laguerre(n, -x), "a zero of L_n")
            call assertTrue(abs(laguerre(n, 1.01_dp*x)) > 1e-9_dp*laguerre(n, -x), "and it alone")
        end do
    contains
        real(dp) function value_of(name)
            character(*), intent(in) :: name
            integer :: k

            k = findloc(d%parameters%name == name, .true., 1)
            value_of = d%parameters(k)%value(1)
        end function value_of

        pure real(dp) function laguerre(degree, at)
            !! By \((k+1)L_{k+1} = (2k + 1 - x)L_k - k L_{k-1}\); at -x it is the sum of sizes.
            integer, intent(in) :: degree
            real(dp), intent(in) :: at
            real(dp) :: before, next
            integer :: k

            before = 0.0_dp
            laguerre = 1.0_dp
            do k = 0, degree - 1
                next = ((2*k + 1 - at)*laguerre - k*before)/(k + 1)
                before = laguerre
                laguerre = next
            end do
        end function laguerre
    end subroutine zeros_of_laguerre
end module test_docs_formulae
