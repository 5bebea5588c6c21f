module test_other_rounding
    !! Formulas with other rounding: as good as before where no terms cancel, another number where
    !! they do; and what is stated of motions by forces of either kind.
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertGreaterThan, &
                     assertLessThan, assertLessThanOrEqual
    use lagrangia_command_line, only: word_t
    use lagrangia_errors, only: error_t
    use lagrangia_expression, only: expression_t
    use lagrangia_final_values, only: final_value_t, final_values_line
    use lagrangia_formula_parser, only: parse_formula
    use lagrangia_formula_program, only: formula_program_t, new_formula_program
    use lagrangia_hyperdual, only: assignment(=), hyperdual_t
    use lagrangia_kinds, only: dp, lanes
    use lagrangia_outcome, only: outcome_t
    use lagrangia_scene, only: scene_t
    use lagrangia_symbols, only: symbols_t
    use lagrangia_system, only: system_t
    use lagrangia_text, only: to_text
    use scene_runs, only: plan_and_run, read_and_plan
    use stated_text, only: read_concise
    implicit none (type, external)
    private
    public :: other_rounding_suite

    character(1), parameter :: names(*) = ["a", "b", "x", "y"]
    real(dp), parameter :: values(*) = [1.3_dp, 0.7_dp, 2.9_dp, 1.1_dp]
    character(24), parameter :: formulas(*) = [character(24) :: &
        "a + b", "a - b", "a*b", "a/b", "a*b + x", "a*b - x", "x - a*b", "(a*b)*x", "a^y", "a^70", &
        "sin(a) + cos(a)", "sin(a)", "cos(x)", "exp(a)", "log(x)", "sqrt(b)", "-(a*b)", "atan(a)", &
        "tanh(b) sinh(a) cosh(b)", "tan(b)", "(a + b)^3/(x - y)", "exp(a*b - x) sin(y)^2", &
        "abs(a - x) sgn(b)"]

contains

    function other_rounding_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("other_rounding")
        call suite%addTest(TestMethod("a_few_last_digits_change", a_few_last_digits_change))
        call suite%addTest(TestMethod("what_cancels_is_another", what_cancels_is_another))
        call suite%addTest(TestMethod("nothing_compiled_stays_nothing", &
                                      nothing_compiled_stays_nothing))
        call suite%addTest(TestMethod("forces_whose_terms_cancel", forces_whose_terms_cancel))
        call suite%addTest(TestMethod("digits_that_are_right_stay", digits_that_are_right_stay))
    end function other_rounding_suite

    subroutine compile(texts, program)
        !! All at once.
        character(*), intent(in) :: texts(:)
        type(formula_program_t), intent(out) :: program
        type(expression_t) :: expressions(size(texts))
        type(symbols_t) :: symbols
        type(error_t), allocatable :: error
        integer :: i

        do i = 1, size(names)
            call symbols%add(names(i))
        end do
        do i = 1, size(texts)
            call parse_formula(trim(texts(i)), symbols, expressions(i), error)
            call assertFalse(allocated(error), trim(texts(i)))
        end do
        call new_formula_program(program, expressions, size(names))
    end subroutine compile

    subroutine a_few_last_digits_change()
        !! Of each result, alone and among all: in doubles, lanes and hyper-dual numbers alike.
        real(dp), parameter :: few = 2000*epsilon(1.0_dp)
        integer :: i

        do i = 1, size(formulas)
            call compare(formulas(i:i))
        end do
        call compare(formulas)
    contains
        subroutine compare(chosen)
            character(*), intent(in) :: chosen(:)
            type(formula_program_t) :: program
            real(dp), dimension(size(chosen)) :: before, behind
            real(dp) :: many(lanes, size(chosen))
            type(hyperdual_t) :: dual(size(chosen)), inputs(size(names))

            call compile(chosen, program)
            call program%evaluate(values, before)
            call program%round_otherwise()
            call program%evaluate(values, behind)
            call assertEqual(size(chosen), count(abs(behind - before) > 0.0_dp), &
                             "each differs: "//trim(chosen(1)))
            call assertLessThan(maxval(abs(behind/before - 1.0_dp)), few, &
                                message="by little: "//trim(chosen(1)))
            call program%evaluate(spread(values, 1, lanes), many)
            call assertLessThan(maxval(abs(many(lanes, :)/behind - 1.0_dp)), &
                                8*epsilon(1.0_dp), message="in lanes: "//trim(chosen(1)))
            inputs = values
            call program%evaluate(inputs, dual)
            call assertLessThan(maxval(abs(dual%re/behind - 1.0_dp)), &
                                8*epsilon(1.0_dp), message="hyper-dual: "//trim(chosen(1)))
        end subroutine compare
    end subroutine a_few_last_digits_change

    subroutine what_cancels_is_another()
        !! Each of these is 0 in exact arithmetic, for terms of about 1.
        character(*), parameter :: zeros(*) = [character(32) :: &
            "(a + b) - a - b", "a*b - b*a*(x/x)", "x - (a*b)*(x/(a*b))", &
            "sin(a)^2 + cos(a)^2 - 1", "a*b + x - (x + a*b)*(y/y)", "(a*b)*x - a*(b*x)"]
        type(formula_program_t) :: program
        real(dp) :: results(size(zeros))
        integer :: i

        call compile(zeros, program)
        call program%round_otherwise()
        call program%evaluate(values, results)
        do i = 1, size(zeros)
            call assertGreaterThan(abs(results(i)), 0.4_dp*epsilon(1.0_dp), message=zeros(i))
        end do
        call assertLessThan(maxval(abs(results)), 200*epsilon(1.0_dp), message="nearly 0")
    end subroutine what_cancels_is_another

    subroutine nothing_compiled_stays_nothing()
        !! A program that no formula has been given.
        type(formula_program_t) :: program

        call program%round_otherwise()
        call assertEqual(0, program%registers)
    end subroutine nothing_compiled_stays_nothing

    subroutine perform(force, start, method, state)
        !! From rest, by a force of x.
        character(*), intent(in) :: force, start, method
        type(final_value_t), allocatable, intent(out) :: state(:)
        class(system_t), allocatable :: system
        type(outcome_t) :: outcome
        type(scene_t) :: scene
        type(error_t), allocatable :: error
        character(:), allocatable :: text

        allocate (outcome%state(0))
        text = "&scene system = 'own', error_estimate = .true., columns = 't', "// &
               "duration = 1.25, v = 0, q = "//start//", "//method//" / &lagrangian "// &
               "coordinates = 'x', T = 'x_dot^2/2', V = '0', Q_x = '"//force//"' /"
        call read_and_plan(text, "a.nml", [word_t ::], scene, system, error)
        call assertFalse(allocated(error), "it is read: "//force)
        if (.not. allocated(error)) call plan_and_run(scene, system, outcome, error)
        call assertFalse(allocated(error), "it runs: "//force)
        state = outcome%state
    end subroutine perform

    subroutine write_forces(kind, w, cancelling, plain)
        !! One force that is nearly -x in two ways.
        integer, intent(in) :: kind
        real(dp), intent(in) :: w  !! of the less of it terms cancel the more
        character(:), allocatable, intent(out) :: cancelling, plain
        character(:), allocatable :: c, k

        c = to_text(w)
        select case (kind)
        case (1)
            k = to_text(2.0_dp/w**2)
            cancelling = "-(1 - cos("//c//"*x))*"//k//"/x"
            plain = "-2*sin("//to_text(0.5_dp*w)//"*x)^2*"//k//"/x"
        case (2)
            k = to_text(1.0_dp/w)
            cancelling = "-(exp("//c//"*x) - 1)*"//k
            plain = "-2*sinh("//to_text(0.5_dp*w)//"*x)*exp("//to_text(0.5_dp*w)//"*x)*"//k
        case default
            k = to_text(2.0_dp/w)
            cancelling = "-(sqrt(1 + "//c//"*x) - 1)*"//k
            plain = "-"//c//"*x/(sqrt(1 + "//c//"*x) + 1)*"//k
        end select
    end subroutine write_forces

    subroutine forces_whose_terms_cancel()
        !! What is stated has the truth in it, which the same force without that says.
        character(*), parameter :: methods(*) = [character(40) :: "method = 'rk4', dt = 2e-3", &
            "method = 'gauss16', dt = 2e-3", "method = 'dop853', tolerance = 1e-11"]
        character(:), allocatable :: cancelling, plain, start
        type(final_value_t), allocatable :: state(:), truth(:)
        real(dp) :: centre, bracket
        integer :: decade, i, j, k, stated

        stated = 0
        do k = 1, 3
            do decade = 8, 36, 2
                call write_forces(k, 10.0_dp**(-0.25_dp*decade), cancelling, plain)
                start = to_text(0.5_dp + 0.0625_dp*mod(7*decade, 16))
                call perform(plain, start, methods(2), truth)
                do i = 1, merge(3, 2, decade <= 12)  ! dop853 is slow below the noise
                    call perform(cancelling, start, trim(methods(i)), state)
                    do j = 1, 2
                        if (.not. state(j)%resolved()) cycle
                        stated = stated + 1
                        call read_concise(state(j)%text(), centre, bracket)
                        call assertLessThanOrEqual( &
                            abs(centre - truth(j)%value), bracket + 1e-14_dp, &
                            message=trim(methods(i))//": "//cancelling//": "//state(j)%text())
                    end do
                end do
            end do
        end do
        call assertGreaterThan(stated, 2*80, message="digits are left mostly")
    end subroutine forces_whose_terms_cancel

    subroutine digits_that_are_right_stay()
        !! Where the terms cancel by less: an eighth digit of w = 1e-3, a fifth of 1e-5.
        character(:), allocatable :: cancelling, plain
        type(final_value_t), allocatable :: state(:)

        call write_forces(1, 1e-3_dp, cancelling, plain)
        call perform(cancelling, "1", "method = 'gauss16', dt = 2e-3", state)
        call assertLessThan(maxval(state%error), 1e-7_dp, &
                            message=final_values_line(state))
        call write_forces(1, 1e-5_dp, cancelling, plain)
        call perform(cancelling, "1", "method = 'gauss16', dt = 2e-3", state)
        call assertLessThan(maxval(state%error), 1e-3_dp, &
                            message=final_values_line(state))
        call perform(plain, "1", "method = 'gauss16', dt = 2e-3", state)
        call assertLessThan(maxval(state%error), 1e-13_dp, &
                            message=final_values_line(state))
    end subroutine digits_that_are_right_stay
end module test_other_rounding
