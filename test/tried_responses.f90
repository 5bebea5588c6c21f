module tried_responses
    !! Statements that are graded, of which we know what is to come out: written by hand, the slips
    !! of the notes, and drawn from what the systems print, in other words or with slips.
    use funit, only: assertEqual
    use lagrangia_catalogue, only: built_in, nth_system
    use lagrangia_description, only: description_t
    use lagrangia_errata_ledger, only: slip_t, slips_of_the_notes
    use lagrangia_errors, only: error_t
    use lagrangia_expression, only: expression_t, operator(-)
    use lagrangia_formula_parser, only: parse_equation
    use lagrangia_formula_text, only: formula_text
    use lagrangia_grading, only: grade, grade_t
    use lagrangia_homework, only: homework_t, parse_homework
    use lagrangia_judgement, only: is_consequence, is_right, is_unreadable, is_wrong
    use lagrangia_kinds, only: dp
    use lagrangia_motion_samples, only: new_samples
    use lagrangia_random_draws, only: random_t
    use lagrangia_sample_names, only: samples_t
    use lagrangia_sampled_formula, only: evaluate_nodes
    use lagrangia_scene_reader, only: read_named_system
    use lagrangia_system, only: system_t
    use lagrangia_text, only: to_text, word_t
    use rewritings, only: draw_rewriting, draw_slip
    implicit none (type, external)
    private
    public :: group_t, response_t
    public :: draw_derivations, draw_responses, graded, judged, printed_statements, &
              responses_by_hand, responses_of_the_notes

    type :: response_t
        !! A statement, and what the program says about it.
        character(:), allocatable :: system     !! its name
        character(:), allocatable :: statement  !! as typed
        integer :: expected = 0                 !! the verdict that it deserves
        integer :: verdict = 0                  !! the verdict that it gets
        character(:), allocatable :: remark     !! and why
    end type response_t

    type :: group_t
        !! Responses of one kind.
        type(response_t), allocatable :: of(:)
    contains
        procedure :: add
    end type group_t

    character, parameter :: line_feed = new_line("a")

contains

    subroutine add(self, system, statement, expected)
        !! One more, graded; a sheet of several lines for its last statement.
        class(group_t), intent(inout) :: self
        character(*), intent(in) :: system, statement
        integer, intent(in) :: expected
        type(response_t), allocatable :: longer(:)
        integer :: i, n

        if (.not. allocated(self%of)) allocate (self%of(0))
        n = size(self%of)
        allocate (longer(n + 1))
        do i = 1, n
            call move_alloc(self%of(i)%system, longer(i)%system)
            call move_alloc(self%of(i)%statement, longer(i)%statement)
            call move_alloc(self%of(i)%remark, longer(i)%remark)
            longer(i)%expected = self%of(i)%expected
            longer(i)%verdict = self%of(i)%verdict
        end do
        longer(n + 1)%system = system
        longer(n + 1)%statement = statement
        longer(n + 1)%expected = expected
        call graded(system, statement, longer(n + 1)%verdict, longer(n + 1)%remark)
        call move_alloc(longer, self%of)
    end subroutine add

    subroutine graded(system, statement, verdict, remark)
        !! Of the last statement of several lines.
        character(*), intent(in) :: system, statement
        integer, intent(out) :: verdict
        character(:), allocatable, intent(out) :: remark
        class(system_t), allocatable :: about
        type(homework_t) :: homework
        type(grade_t) :: result
        type(error_t), allocatable :: error
        type(word_t), allocatable :: settings(:)
        integer :: i

        verdict = 0
        call parse_homework("system: "//system//line_feed//statement, "sheet", homework, error)
        if (.not. allocated(error)) then
            allocate (settings(size(homework%settings)))
            do i = 1, size(settings)
                settings(i)%text = system//"%"//homework%settings(i)%text
            end do
            call read_named_system(system, settings, about, error)
        end if
        if (.not. allocated(error)) call grade(homework, about, result, error)
        if (allocated(error)) then
            remark = error%message
            return
        end if
        verdict = result%of(size(result%of))%verdict
        remark = result%of(size(result%of))%remark
    end subroutine graded

    subroutine judged(system, statement, expected, remark)
        !! Assert the verdict on the last statement of several lines, and its remark.
        character(*), intent(in) :: system, statement
        integer, intent(in) :: expected
        character(*), intent(in), optional :: remark
        character(:), allocatable :: said
        integer :: verdict

        call graded(system, statement, verdict, said)
        call assertEqual(expected, verdict, statement//": verdict "//to_text(verdict)//", "//said)
        if (present(remark)) call assertEqual(remark, said, statement)
    end subroutine judged

    subroutine responses_by_hand(group)
        !! Chosen so that each kind of change and of equivalence is there.
        type(group_t), intent(out) :: group

        call right("pendulum", "theta_ddot = -g/l sin(theta)")
        call right("pendulum", "sin(theta)/theta_ddot = -l/g")
        call right("pendulum", "dL/dtheta = -m g l sin(theta)")
        call right("pendulum", "d/dt dL/dtheta_dot = m l^2 theta_ddot")
        call right("pendulum", "d/dt dL/dtheta_dot - dL/dtheta = 0")
        call right("pendulum", "I = m l^2"//line_feed//"E = I/2 theta_dot^2 - m g l cos(theta)")
        call right("pendulum", "m l^2 theta_ddot = dL/dtheta = -m g l sin(theta)")
        call right("pendulum", "V = m g l (1 - cos(theta))")
        call right("pendulum", "omega = sqrt(g/l)")
        call right("pendulum", "L = m l^2 theta_dot^2 + 2 m g l cos(theta) + "// &
                   "theta theta_dot cos(t) - theta^2/2 sin(t)")
        call right("double_pendulum", "L = (m1 + m2)/2 l1^2 theta1_dot^2 + m2/2 l2^2 "// &
                   "theta2_dot^2 + m2 l1 l2 theta1_dot theta2_dot cos(D) - V + 7 theta1_dot")
        call right("driven_pendulum", "L = m/2 (l^2 theta_dot^2 + 2 l theta_dot y_p_dot "// &
                   "sin(theta)) - m g (y_p - l cos(theta))")
        call right("atwood", "(m1 + m2) x_ddot = (m1 - m2) g")
        call right("rotating_hoop", "Omega^2 = g/r - omega^2")
        call right("rotating_hoop", "Omega^2 = omega^2 - g^2/(omega r)^2")
        call right("double_pendulum", "m1 l1 l2 omega^4 - (m1 + m2) (l1 + l2) g omega^2 + "// &
                   "(m1 + m2) g^2 = 0")
        call right("pendulum", "set: g = 9.81"//line_feed//"l theta_ddot + 9.81 sin(theta) = 0")
        call right("wedge", "q1_ddot = g sin(alpha)/(1 - m_block cos(alpha)^2/(m_wedge + m_block))")
        call wrong("cart_pendulum", "l theta_ddot + x_ddot cos(theta) - g sin(theta) = 0")
        call wrong("cart_pendulum", "l theta_ddot + x_ddot sin(theta) + g sin(theta) = 0")
        call wrong("cart_pendulum", "l^2 theta_ddot + x_ddot cos(theta) + g sin(theta) = 0")
        call wrong("cart_pendulum", "omega^2 = (m1 + m2) g/(m2 l)")
        call wrong("cart_pendulum", "(m1 + m2) x_ddot + m2 l theta_ddot cos(theta) = 0")
        call wrong("pendulum", "theta_ddot + g sin(theta) = 0")
        call wrong("pendulum", "2 l theta_ddot + g sin(theta) = 0")
        call wrong("pendulum", "L_z = m l theta_dot")
        call wrong("pendulum", "l theta_ddot + g theta = 0")
        call wrong("pendulum", "p_theta = m l^2 theta_dot = m l^2 theta")
        call wrong("pendulum", "L = m/2 l^2 theta_dot^2 - m g l cos(theta)")
        call wrong("pendulum", "E = m/2 l^2 theta_dot^2")
        call wrong("oscillator", "m x_ddot + k sin(x) = 0")
        call wrong("oscillator", "m x_dot + k x = 0")
        call wrong("oscillator", "m x_ddot + k x + m x = 0")
        call wrong("oscillator", "omega = k/m")
        call wrong("wedge", "M (q1_ddot + q2_ddot cos(alpha)) = m g sin(alpha)")
        call wrong("atwood", "tension2 = m2 (g + x_ddot)/2")
        call wrong("rotating_hoop", "theta_ddot = omega^2 sin(theta) - g/r sin(theta)")
        ! more than one slip: no single change mends these
        call wrong("pendulum", "theta_ddot = g/l cos(theta)")
        call wrong("pendulum", "m theta_ddot - m g cos(theta) = 0")
        call wrong("cart_pendulum", "l theta_ddot + x_ddot sin(theta) - g sin(theta) = 0")
        call wrong("double_pendulum", "l2 theta2_ddot + l1 theta1_ddot sin(theta1 - theta2) "// &
                   "+ l1 theta1_dot^2 sin(theta1 - theta2) + g sin(theta2) = 0")
        call wrong("oscillator", "x = cos(t)")
        call unreadable("pendulum", "m g sin theta l = 1")
        call unreadable("pendulum", "theta_ddot == 3")
        call unreadable("pendulum", "theta_ddot =")
        call unreadable("pendulum", "g = 9.81")
        call unreadable("pendulum", "theta_dt = 1")
        call unreadable("pendulum", "p_x = 1")
        call unreadable("pendulum", "theta_ddot = log(-1)")
        call unreadable("pendulum", "theta_ddot = (1")
        call unreadable("pendulum", "2theta_ddot = -2 g/l sin(theta)")
    contains
        subroutine right(system, statement)
            character(*), intent(in) :: system, statement

            call group%add(system, statement, is_right)
        end subroutine right

        subroutine wrong(system, statement)
            character(*), intent(in) :: system, statement

            call group%add(system, statement, is_wrong)
        end subroutine wrong

        subroutine unreadable(system, statement)
            character(*), intent(in) :: system, statement

            call group%add(system, statement, is_unreadable)
        end subroutine unreadable
    end subroutine responses_by_hand

    subroutine responses_of_the_notes(group)
        !! What the notes have, and what is derived from their own L.
        type(group_t), intent(out) :: group
        type(slip_t), allocatable :: slips(:)
        character(:), allocatable :: settings
        integer :: i

        allocate (slips, source=slips_of_the_notes())
        do i = 1, size(slips)
            if (slips(i)%system == "") cycle
            settings = ""
            if (slips(i)%without /= "") settings = "set: magnetic = 0, 0, 0"//line_feed// &
                                                   "set: trap = 0"//line_feed
            call group%add(trim(slips(i)%system), settings//trim(slips(i)%wrong), is_wrong)
            call group%add(trim(slips(i)%system), settings//trim(slips(i)%right), is_right)
        end do
    end subroutine responses_of_the_notes

    subroutine printed_statements(system, statements)
        !! Equations of motion, energy and quantities as `describe` has them.
        class(system_t), intent(in) :: system
        character(:), allocatable, intent(out) :: statements
        type(description_t) :: d
        integer :: i

        call system%describe(d)
        statements = ""
        if (d%name == "hanging_chain") return
        do i = 1, size(d%equations)
            statements = statements//trim(d%equations(i))//line_feed
        end do
        statements = statements//"E = "//trim(d%energy)//line_feed//"L = "//trim(d%lagrangian)// &
            line_feed
        do i = 1, size(d%quantities)
            if (d%quantities(i)%formula == "") cycle
            ! conserved, and printed, on a level plane, or along the field, only
            if (any([character(8) :: "p_phi", "L_axis"] == d%quantities(i)%name)) cycle
            statements = statements//trim(d%quantities(i)%name)//" = "// &
                trim(d%quantities(i)%formula)//line_feed
        end do
    end subroutine printed_statements

    subroutine draw_responses(with_slip, number, group)
        !! So many, of the systems in turn: both sides in other words, exchanged, times a factor;
        !! or with one slip.
        logical, intent(in) :: with_slip
        integer, intent(in) :: number
        type(group_t), intent(out) :: group
        type(random_t) :: random
        class(system_t), allocatable, target :: system
        type(samples_t) :: samples, printed(built_in)
        type(error_t), allocatable :: error
        type(description_t) :: d
        character(:), allocatable :: statements, statement
        type(word_t) :: none(0)
        integer :: i

        allocate (group%of(0))
        do while (size(group%of) < number)
            do i = 1, built_in
                call nth_system(i, system)
                call system%describe(d)
                call printed_statements(system, statements)
                if (statements == "") cycle
                if (.not. allocated(printed(i)%values)) call new_samples( &
                    system, statements, none, printed(i), error)
                call change_one(statements, printed(i), random, with_slip, statement)
                if (statement == "") cycle
                if (with_slip) then
                    call new_samples(system, statement, none, samples, error)
                    if (.not. is_false(statement, samples)) cycle  ! with what it does not name zero
                end if
                call group%add(trim(d%name), statement, merge(is_wrong, is_right, with_slip))
                if (size(group%of) == number) return
            end do
        end do
    end subroutine draw_responses

    subroutine draw_derivations(follows, number, group)
        !! Sheets of two lines: one slip, and then the same in other words, or another slip.
        logical, intent(in) :: follows
        integer, intent(in) :: number
        type(group_t), intent(out) :: group
        type(random_t) :: random
        class(system_t), allocatable, target :: system
        type(samples_t) :: samples, printed(built_in)
        type(error_t), allocatable :: error
        type(description_t) :: d
        character(:), allocatable :: statements, first, second
        type(word_t) :: none(0)
        logical :: the_same
        integer :: i

        allocate (group%of(0))
        do while (size(group%of) < number)
            do i = 1, built_in
                call nth_system(i, system)
                call system%describe(d)
                if (system%constraints > 0) cycle
                call printed_statements(system, statements)
                if (statements == "") cycle
                if (.not. allocated(printed(i)%values)) call new_samples( &
                    system, statements, none, printed(i), error)
                call change_one(statements, printed(i), random, .true., first)
                if (first == "") cycle
                if (follows) then
                    call change_one(first//line_feed, printed(i), random, .false., second)
                else
                    call change_one(statements, printed(i), random, .true., second)
                end if
                if (second == "" .or. second == first) cycle
                the_same = index(second, trim(first(index(first, "= ") + 2:))) > 0
                if (the_same .and. .not. follows) cycle
                call new_samples(system, first//second, none, samples, error)
                if (.not. is_false(first, samples)) cycle
                if (.not. is_false(second, samples)) cycle
                call group%add(trim(d%name), first//line_feed//second, &
                               merge(is_consequence, is_wrong, follows))
                if (size(group%of) == number) return
            end do
        end do
    end subroutine draw_derivations

    subroutine change_one(statements, samples, random, with_slip, statement)
        !! One of the lines, rewritten, perhaps with a slip that matters; "" if none came out.
        character(*), intent(in) :: statements
        type(samples_t), intent(in) :: samples
        type(random_t), intent(inout) :: random
        logical, intent(in) :: with_slip
        character(:), allocatable, intent(out) :: statement
        type(expression_t) :: left, right
        type(error_t), allocatable :: error
        character(:), allocatable :: line, kind
        real(dp) :: x
        integer :: first, last

        statement = ""
        call random%uniform(0.0_dp, 1.0_dp, x)
        first = 1 + int(x*(len(statements) - 2))
        first = index(statements(:first), line_feed, back=.true.) + 1
        last = first + index(statements(first:), line_feed) - 2
        line = statements(first:last)
        call parse_equation(line, samples%symbols, left, right, error)
        if (allocated(error)) return
        if (with_slip) then
            call random%uniform(0.0_dp, 1.0_dp, x)
            if (x < 0.3_dp .and. left%count > 1) then
                call draw_slip(left, samples, random, kind)
            else
                call draw_slip(right, samples, random, kind)
            end if
            if (kind == "") return
            if (index(line, "L =") == 1) return  ! another L may give the same motion
        else
            call draw_rewriting(left, random)
            call draw_rewriting(right, random)
        end if
        call random%uniform(0.0_dp, 1.0_dp, x)
        if (x < 0.4_dp .and. index(line, "E =") /= 1) then
            statement = "7 ("//formula_text(right, samples%symbols)//") = ("// &
                        formula_text(left, samples%symbols)//")*7"
        else
            statement = formula_text(left, samples%symbols)//" = "//formula_text(right, &
                samples%symbols)
        end if
    end subroutine change_one

    logical function is_false(statement, samples)
        !! Whether its sides differ at every sample.
        character(*), intent(in) :: statement
        type(samples_t), intent(in) :: samples
        type(expression_t) :: left, right
        type(error_t), allocatable :: error
        real(dp), allocatable :: results(:, :)

        call parse_equation(statement, samples%symbols, left, right, error)
        left = left - right
        allocate (results(size(samples%values, 1), left%count))
        call evaluate_nodes(left, samples%values, results)
        is_false = all(abs(results(:, left%count)) > 1e-6_dp)
    end function is_false
end module tried_responses
