module test_parameter_domains
    !! What a scene allows of its parameters: kept, said in words, refused in one line.
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertTrue
    use lagrangia_command_line, only: word_t
    use lagrangia_description, only: check_parameter, parameter_t, real_number
    use lagrangia_errors, only: error_t, status_usage
    use lagrangia_kinds, only: dp
    use lagrangia_parameter_domains, only: set_domain
    use lagrangia_scene, only: scene_t
    use lagrangia_scene_reader, only: parse_scene
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: parameter_domains_suite

    real(dp), parameter :: half_pi = acos(0.0_dp)

contains

    function parameter_domains_suite() result(suite)
        type(TestSuite) :: suite

        suite = TestSuite("parameter_domains")
        call suite%addTest(TestMethod("bounds, open and closed", bounds))
        call suite%addTest(TestMethod("texts that are none", no_domains))
        call suite%addTest(TestMethod("a scene's values keep to them", scene_values))
    end function parameter_domains_suite

    subroutine bounds()
        !! Each value beside what is allowed, the bounds themselves too; the narrower of two counts.
        call judge("e > 0", "greater than 0.0", [1e-300_dp, 5.0_dp], [0.0_dp, -1.0_dp])
        call judge("e>=0", "at least 0.0", [0.0_dp, 5.0_dp], [-1e-300_dp, -1.0_dp])
        call judge("e < 1", "less than 1.0", [-9.0_dp, 0.999_dp], [1.0_dp, 1.5_dp])
        call judge("e <= pi/2", "at most pi/2", [-9.0_dp, half_pi], [1.6_dp, 2.0_dp])
        call judge("e >= 0;e < 1", "from 0.0 to 1.0, below 1.0", [0.0_dp, 0.5_dp], [1.0_dp, &
            -0.1_dp])
        call judge("e > 0;e >= 0;e >= -2", "greater than 0.0", [0.1_dp, 0.2_dp], [0.0_dp, -1.0_dp])
        call judge("e < 1;e <= 1;e < 7", "less than 1.0", [0.1_dp, 0.2_dp], [1.0_dp, 2.0_dp])
        call judge("e <= 1;e < 1", "less than 1.0", [0.1_dp, 0.2_dp], [1.0_dp, 2.0_dp])
        call judge("e >= 1;e > 1", "greater than 1.0", [1.1_dp, 2.0_dp], [1.0_dp, 0.0_dp])
        ! a narrower bound is open or closed by itself
        call judge("e > 0;e >= 1", "at least 1.0", [1.0_dp, 2.0_dp], [0.999_dp, 0.5_dp])
        call judge("e < 1;e <= 0", "at most 0.0", [0.0_dp, -1.0_dp], [0.001_dp, 0.5_dp])
        call judge("e >= 0;e >= 0", "at least 0.0", [0.0_dp, 1.0_dp], [-0.1_dp, -1.0_dp])
        call judge("e <= 1;e <= 1", "at most 1.0", [1.0_dp, 0.0_dp], [1.1_dp, 2.0_dp])
    end subroutine bounds

    subroutine judge(texts, words, good, bad)
        !! Of one parameter `e`, with these domains, a semicolon between them.
        character(*), intent(in) :: texts, words
        real(dp), intent(in) :: good(2), bad(2)
        type(parameter_t) :: p(1)
        type(error_t), allocatable :: error
        integer :: first, i, last

        p(1) = real_number("e", "1", "a number", 0.0_dp)
        first = 1
        do while (first <= len(texts))
            last = first + index(texts(first:)//";", ";") - 2
            call set_domain(texts(first:last), p, error)
            call assertFalse(allocated(error), texts)
            first = last + 2
        end do
        call assertEqual(words, p(1)%domain(), texts)
        do i = 1, 2
            p(1)%value(1) = good(i)
            call check_parameter(p(1), error)
            call assertFalse(allocated(error), texts//": allowed")
            p(1)%value(1) = bad(i)
            call check_parameter(p(1), error)
            call assertTrue(allocated(error), texts//": not allowed")
        end do
    end subroutine judge

    subroutine no_domains()
        call refuse("e", "a domain is written 'm > 0', with >, >=, < or <=")
        call refuse("> 0", "a domain is written 'm > 0', with >, >=, < or <=")
        call refuse("e = 1", "a domain is written 'm > 0', with >, >=, < or <=")
        call refuse("epsilom > 1", "there is no parameter 'epsilom'; did you mean 'epsilon'?")
        call refuse("z > 1", "there is no parameter 'z'")
        call refuse("e > x", "column 5: unknown name 'x'; there is only pi")
        call refuse("e > 1/0", "the bound is no finite number")
        call refuse("e > -1/0", "the bound is no finite number")
        call refuse("e > 0/0", "the bound is no finite number")
        call refuse("e < 0", "leaves no value for e")
        call refuse("e <= 0.5", "leaves no value for e")
    end subroutine no_domains

    subroutine refuse(text, message)
        !! Of `e`, which is greater than 0.5 already, and `epsilon`.
        character(*), intent(in) :: text, message
        type(parameter_t) :: p(2)
        type(error_t), allocatable :: error

        p(1) = real_number("e", "1", "a number", 0.0_dp)
        p(2) = real_number("epsilon", "1", "another", 0.0_dp)
        call set_domain("e > 0.5", p, error)
        call set_domain(text, p, error)
        call assertTrue(allocated(error), text)
        if (allocated(error)) call assertEqual(message, error%message, text)
    end subroutine refuse

    subroutine scene_values()
        !! The value is refused where it stands, or the domain; `configure` keeps to it as well.
        character(*), parameter :: nl = new_line("a")
        character(*), parameter :: head = "&scene system = 'own' dt = 1e-2 duration = 1 q = 1 /"// &
            nl// &
            "&lagrangian coordinates = 'x' parameters = 'm', 'K' T = 'm/2 x_dot^2' "// &
            "V = 'K/2 x^2' "// &
            "domain = "
        class(system_t), allocatable :: system
        type(scene_t) :: scene
        type(error_t), allocatable :: error

        call read_text(head//"'m > 0', 'K >= 0' /"//nl//"&own m = 2, K = 0 /")
        call assertFalse(allocated(error), "allowed")
        if (allocated(error)) return
        call assertTrue(any(index(scene%formulas, "domain = 'm > 0', 'K >= 0'") > 0), "the echo")
        call system%configure([2.0_dp, -1.0_dp], error)
        call assertTrue(allocated(error), "configured")
        if (allocated(error)) call assertEqual("own: K = -1.0 is not allowed: at least 0.0", &
                                               error%message)
        call read_text(head//"'m > 0', 'K >= 0' /"//nl//"&own m = 0, K = 0 /")
        call assertTrue(allocated(error), "a mass of zero")
        if (allocated(error)) call assertEqual("a.nml:3:10: &own: m = 0: "// &
                                               "greater than 0.0 is needed", &
                                               error%message)
        call read_text(head//"'m > 0', 'k >= 0' /"//nl//"&own m = 1, K = 0 /")
        call assertTrue(allocated(error), "a parameter that is none")
        if (.not. allocated(error)) return
        call assertEqual("&lagrangian: domain = 'k >= 0': there is no parameter "// &
                         "'k'; did you mean 'K'?", &
                         error%message(index(error%message, "&"):))
        call assertEqual(status_usage, error%status)
    contains
        subroutine read_text(text)
            character(*), intent(in) :: text

            call parse_scene(text, "a.nml", [word_t ::], scene, system, error)
        end subroutine read_text
    end subroutine scene_values
end module test_parameter_domains
