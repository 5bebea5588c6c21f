module test_scorecard
    !! What a run says to people: rows of 80 columns, and lines below them.
    use funit, only: TestMethod, TestSuite, assertEqual, assertTrue
    use lagrangia_kinds, only: dp, i8
    use lagrangia_ledger, only: claim_t
    use lagrangia_outcome, only: from_closed_form, from_half_step, from_steps, outcome_t
    use lagrangia_scorecard, only: scorecard_head, scorecard_legend, scorecard_lines, &
                                   scorecard_row, scorecard_width
    use lagrangia_text, only: word_t
    use lagrangia_wrapping, only: wrapped
    implicit none (type, external)
    private
    public :: scorecard_suite

    character(*), parameter :: lf = new_line("a")

contains

    function scorecard_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("scorecard")
        call suite%addTest(TestMethod("rows_stand_under_their_titles", &
                                      rows_stand_under_their_titles))
        call suite%addTest(TestMethod("rows_say_where_an_error_is_from", &
                                      rows_say_where_an_error_is_from))
        call suite%addTest(TestMethod("rows_have_no_asterisks", rows_have_no_asterisks))
        call suite%addTest(TestMethod("a_start_has_no_drift", a_start_has_no_drift))
        call suite%addTest(TestMethod("a_row_is_one_line", a_row_is_one_line))
        call suite%addTest(TestMethod("lines_say_what_was_measured", lines_say_what_was_measured))
        call suite%addTest(TestMethod("what_is_not_there_is_not_said", &
                                      what_is_not_there_is_not_said))
        call suite%addTest(TestMethod("a_swallowed_energy_is_explained", &
                                      a_swallowed_energy_is_explained))
        call suite%addTest(TestMethod("not_is_explained", not_is_explained))
        call suite%addTest(TestMethod("the_legend_fits", the_legend_fits))
        call suite%addTest(TestMethod("words_are_wrapped", words_are_wrapped))
    end function scorecard_suite

    subroutine set_up(outcome)
        !! An outcome without measures.
        type(outcome_t), intent(out) :: outcome

        outcome%scene = "swing"
        outcome%system = "pendulum"
        outcome%method = "rk4"
        outcome%file = "out/swing_l_2.dat"
        outcome%steps = 10_i8
        outcome%evaluations = 40_i8
        outcome%seconds = 0.25_dp
        allocate (outcome%drifts(0), outcome%others(0))
    end subroutine set_up

    function measure(name, value, most) result(m)
        !! One that is judged if there is a limit.
        character(*), intent(in) :: name
        real(dp), intent(in) :: value
        real(dp), intent(in), optional :: most
        type(claim_t) :: m

        m%name = name
        m%value = value
        m%judged = present(most)
        if (present(most)) m%most = most
    end function measure

    subroutine a_swallowed_energy_is_explained()
        !! Where the rounding of its terms is the drift; not where the steps are too long.
        type(outcome_t) :: outcome
        type(word_t), allocatable :: lines(:)

        call set_up(outcome)
        outcome%drifts = [measure("p_x_drift", 3.0_dp), measure("energy_drift", 2e13_dp)]
        outcome%energy_terms = 1e29_dp
        call scorecard_lines(outcome, .true., lines)
        call assertEqual("    the terms of the energy have grown to 1.0E+29 times what its "// &
                         "drift is", lines(2)%text)
        call assertEqual(4, size(lines), "of three lines")
        outcome%energy_terms = 1e28_dp
        call scorecard_lines(outcome, .true., lines)
        call assertEqual(4, size(lines), "a hundredth of it: rounding adds up")
        outcome%energy_terms = 1e26_dp
        call scorecard_lines(outcome, .true., lines)
        call assertEqual(1, size(lines), "the steps are to blame")
        outcome%energy_terms = 1e29_dp
        outcome%drifts(2)%value = 0.5_dp
        call scorecard_lines(outcome, .true., lines)
        call assertEqual(1, size(lines), "a small drift")
    end subroutine a_swallowed_energy_is_explained

    subroutine rows_stand_under_their_titles()
        !! Words begin where their titles do.
        type(outcome_t) :: outcome
        character(:), allocatable :: head, row

        call set_up(outcome)
        outcome%drifts = [measure("energy_drift", 2e-9_dp), measure("p_x_drift", 3e-9_dp), &
                          measure("L_drift", 1e-9_dp)]
        outcome%others = [measure("error", 0.5_dp, 1.0_dp)]
        outcome%error_from = from_half_step
        outcome%method = "gauss16"
        head = scorecard_head()
        row = scorecard_row(outcome)
        call assertEqual(1, index(row, "swing "), "scene")
        call assertEqual(index(head, "method"), index(row, "gauss16 "), "method")
        call assertEqual(index(head, "drift"), index(row, "3.0E-09 p_x "), "the worst drift")
        call assertEqual(index(head, "error"), index(row, "5.0E-01 estimate "), "error")
        call assertEqual(index(head, "verdict"), index(row, "holds"), "verdict")
        call assertTrue(len(row) <= scorecard_width .and. len(head) <= scorecard_width, row)
        outcome%drifts = [measure("energy_support_drift", 2e-9_dp)]
        outcome%others(1)%judged = .false.
        row = scorecard_row(outcome)
        call assertEqual(index(head, "error") + 1, index(row, "5.0E-01 estimate "), "a long name")
        call assertEqual("-", row(index(head, "verdict"):), row)
        outcome%scene = repeat("a", 24)
        row = scorecard_row(outcome)
        call assertEqual(outcome%scene//" gauss16", row(:32))
        outcome%scene = repeat("a", 25)
        row = scorecard_row(outcome)
        call assertEqual(outcome%scene//lf//repeat(" ", 25)//"gauss16", row(:58))
    end subroutine rows_stand_under_their_titles

    subroutine rows_say_where_an_error_is_from()
        !! `exact`, `estimate` and `steps`; a hyphen where there is none: none was asked for, or the
        !! run ended before its first row.
        type(outcome_t) :: outcome
        character(:), allocatable :: row
        integer :: column

        call set_up(outcome)
        column = index(scorecard_head(), " error ") + 1
        row = scorecard_row(outcome)
        call assertEqual("- ", row(column:column + 1))
        outcome%others = [measure("error", 3e-9_dp)]
        outcome%error_from = from_closed_form
        row = scorecard_row(outcome)
        call assertEqual("3.0E-09 exact  ", row(column:column + 14))
        outcome%error_from = from_half_step
        row = scorecard_row(outcome)
        call assertEqual("3.0E-09 estimate", row(column:column + 15))
        outcome%error_from = from_steps
        row = scorecard_row(outcome)
        call assertEqual("3.0E-09 steps  ", row(column:column + 14))
        outcome%others = [measure("period", 0.375_dp)]
        row = scorecard_row(outcome)
        call assertEqual("-  ", row(column:column + 2))
    end subroutine rows_say_where_an_error_is_from

    subroutine rows_have_no_asterisks()
        !! However large or small the numbers of a run that failed are.
        type(outcome_t) :: outcome
        character(:), allocatable :: text

        call set_up(outcome)
        outcome%drifts = [measure("energy_drift", 2e300_dp)]
        outcome%others = [measure("error", 2.5e-300_dp), measure("period", 5e150_dp, 1e-100_dp)]
        outcome%error_from = from_closed_form
        outcome%omega = 1.25e157_dp
        outcome%omega_error = 1e-200_dp
        outcome%seconds = 1e9_dp
        text = scorecard_row(outcome)//lf//below(outcome)
        call assertEqual(0, index(text, "*"), text)
        call contains_once(text, " 2.0E+300 energy ")
        call contains_once(text, " 2.5E-300 exact ")
        call contains_once(text, "    NOT as expected: period is 5.0E+150, expect_period = 1e-100")
        call contains_once(text, " 1.2500000000E+157 rad/s")
        call contains_once(text, "1000000000.0000 s")
        outcome%omega = 1.25e-7_dp
        call contains_once(below(outcome), " 1.2500000000E-07 rad/s")
    end subroutine rows_have_no_asterisks

    subroutine a_start_has_no_drift()
        !! A run that failed behind its first row has no drift and no error; behind a second it has.
        type(outcome_t) :: outcome
        integer(i8) :: rows

        call set_up(outcome)
        outcome%drifts = [measure("energy_drift", 0.0_dp)]
        outcome%others = [measure("error", 0.0_dp)]
        outcome%error_from = from_half_step
        outcome%failure = "the state is not finite"
        do rows = 1, 2
            outcome%rows = rows
            call assertTrue(index(scorecard_row(outcome), "0 energy") > 0 .eqv. rows > 1, "drift")
            call assertTrue(index(scorecard_row(outcome), "0 estimate") > 0 .eqv. rows > 1, "error")
        end do
    end subroutine a_start_has_no_drift

    subroutine a_row_is_one_line()
        !! Whatever the scene is called.
        type(outcome_t) :: outcome
        character(:), allocatable :: row

        call set_up(outcome)
        outcome%scene = "a"//achar(27)//"[31m"//lf//char(255)//char(195)//char(164)
        row = scorecard_row(outcome)
        call assertEqual("a\x1B[31m\x0A\xFF"//char(195)//char(164)//" ", row(:20))
    end subroutine a_row_is_one_line

    subroutine lines_say_what_was_measured()
        !! Letter for letter.
        type(outcome_t) :: outcome

        call set_up(outcome)
        outcome%title = "Pendulum (l=2)"
        outcome%changes = "l=2"
        outcome%others = [measure("period", 2e-13_dp), measure("small_period", 0.25_dp)]
        outcome%period = 2.5_dp
        outcome%exact_period = 2.5_dp
        outcome%small_period = 2.0_dp
        outcome%omega = 3.125_dp
        outcome%omega_formula = "omega^2 = g/l"
        outcome%omega_error = 0.0_dp
        call assertEqual( &
            "    Pendulum (l=2)"//lf// &
            "    changed by --set: what the file expects is of the unchanged scene and"//lf// &
            "        does not judge this one; data file: out/swing_l_2.dat"//lf// &
            "    10 steps, 40 evaluations of the accelerations, 0.2500 s"//lf// &
            "    period  2.5000000000 s      measured"//lf// &
            "            2.5000000000 s      exact; they differ by 2.0e-13 of it"//lf// &
            "            2.0000000000 s      2 pi/omega of small swings; off by 0.25 of it"//lf// &
            "    omega   3.1250000000 rad/s  the slowest small oscillation, by LAPACK"//lf// &
            "            omega^2 = g/l"//lf// &
            "            all frequencies: LAPACK and closed forms differ by at most 0.0"//lf, &
            below(outcome))
        outcome%steps = 0
        call contains_once(below(outcome), "no steps: the motion by its closed form, 0.2500 s")
    end subroutine lines_say_what_was_measured

    subroutine what_is_not_there_is_not_said()
        !! And the main job has rows only, but for what did not hold.
        type(outcome_t) :: outcome
        type(word_t), allocatable :: lines(:)

        call set_up(outcome)
        call assertEqual("    10 steps, 40 evaluations of the accelerations, 0.2500 s"//lf, &
                         below(outcome))
        call scorecard_lines(outcome, .false., lines)
        call assertEqual(0, size(lines))
    end subroutine what_is_not_there_is_not_said

    subroutine not_is_explained()
        !! Each measure that did not hold, in the main job too, and no other.
        type(outcome_t) :: outcome
        type(word_t), allocatable :: lines(:)
        character(:), allocatable :: row

        call set_up(outcome)
        outcome%drifts = [measure("energy_drift", 3e-9_dp, 1.5e-9_dp), measure("L_drift", 1.0_dp)]
        outcome%others = [measure("error", 1e-9_dp, 1e-8_dp)]
        row = scorecard_row(outcome)
        call assertEqual("NOT", row(index(scorecard_head(), "verdict"):))
        call scorecard_lines(outcome, .false., lines)
        call assertEqual(1, size(lines))
        if (size(lines) == 1) call assertEqual("    NOT as expected: energy_drift is 3.0E-09, "// &
                                               "expect_energy_drift = 1.5e-9", lines(1)%text)
        outcome%failure = "not finite"
        call scorecard_lines(outcome, .false., lines)
        call assertEqual(0, size(lines), "a run that failed is not judged")
    end subroutine not_is_explained

    subroutine the_legend_fits()
        !! In 80 columns, with a word on each column.
        character(7), parameter :: columns(4) = ["method ", "drift  ", "error  ", "verdict"]
        character(:), allocatable :: rest
        integer :: i

        rest = scorecard_legend
        do while (rest /= "")
            call assertTrue(index(rest, lf) - 1 <= scorecard_width, rest(:index(rest, lf)))
            rest = rest(index(rest, lf) + 1:)
        end do
        do i = 1, size(columns)
            call contains_once(lf//scorecard_legend, lf//columns(i)//"  ")
            call contains_once(scorecard_head(), trim(columns(i)))
        end do
    end subroutine the_legend_fits

    subroutine words_are_wrapped()
        !! Lines as long as they may be; a long word alone; blanks do not count.
        type(word_t), allocatable :: lines(:)

        call wrapped("  ab cd  ef abcdefgh i ", 5, lines)
        call assertEqual(4, size(lines))
        if (size(lines) /= 4) return
        call assertEqual(5, len(lines(1)%text))
        call assertEqual("ab cd", lines(1)%text)
        call assertEqual("ef", lines(2)%text)
        call assertEqual("abcdefgh", lines(3)%text)
        call assertEqual("i", lines(4)%text)
        call wrapped(" ", 5, lines)
        call assertEqual(0, size(lines))
    end subroutine words_are_wrapped

    function below(outcome) result(text)
        !! All lines below the row.
        type(outcome_t), intent(in) :: outcome
        character(:), allocatable :: text
        type(word_t), allocatable :: lines(:)
        integer :: i

        call scorecard_lines(outcome, .true., lines)
        text = ""
        do i = 1, size(lines)
            text = text//lines(i)%text//lf
        end do
    end function below

    subroutine contains_once(text, part)
        !! Assert that `part` occurs in `text`, once.
        character(*), intent(in) :: text, part

        call assertTrue(index(text, part) > 0, "missing: "//part//lf//text)
        call assertEqual(index(text, part), index(text, part, back=.true.), "twice: "//part)
    end subroutine contains_once
end module test_scorecard
