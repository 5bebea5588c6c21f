module test_namelist_values
    !! Values: each comes whole and as what it was written, or is refused with its place.
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertFalse, assertTrue
    use lagrangia_errors, only: error_t, status_usage
    use lagrangia_kinds, only: dp, i8
    use lagrangia_namelist, only: apply_override, get_integer, get_logical, get_real, get_reals, &
                                  get_string, get_strings, namelist_t, parse_namelist, &
                                  refuse_unknown_groups, refuse_unknown_keys, refuse_value
    implicit none (type, external)
    private
    public :: namelist_values_suite

    character(1), parameter :: lf = achar(10)

contains

    function namelist_values_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("namelist values")
        call suite%addTest(TestMethod("numbers_are_rounded_correctly", &
                                      numbers_are_rounded_correctly))
        call suite%addTest(TestMethod("integers_are_exact", integers_are_exact))
        call suite%addTest(TestMethod("logicals_have_few_forms", logicals_have_few_forms))
        call suite%addTest(TestMethod("indices_and_repeats_fill_arrays", &
                                      indices_and_repeats_fill_arrays))
        call suite%addTest(TestMethod("types", types))
        call suite%addTest(TestMethod("counts", counts))
        call suite%addTest(TestMethod("integers", integers))
        call suite%addTest(TestMethod("unknown_names", unknown_names))
        call suite%addTest(TestMethod("values_the_caller_refuses", values_the_caller_refuses))
    end function namelist_values_suite

    subroutine read_text(text, tree)
        !! Parse; a refusal is a failure of the test.
        character(*), intent(in) :: text
        type(namelist_t), intent(out) :: tree
        type(error_t), allocatable :: error

        call parse_namelist(text, "a.nml", tree, error)
        call check(error)
    end subroutine read_text

    subroutine check(error)
        !! Nothing was refused.
        type(error_t), allocatable, intent(in) :: error

        if (allocated(error)) call assertEqual("no error", error%message)
    end subroutine check

    subroutine failed(error, expected)
        !! There is an error with just this message.
        type(error_t), allocatable, intent(in) :: error
        character(*), intent(in) :: expected

        call assertTrue(allocated(error), message="not refused: "//expected)
        if (.not. allocated(error)) return
        call assertEqual(expected, error%message)
        call assertEqual(status_usage, error%status)
    end subroutine failed

    subroutine numbers_are_rounded_correctly()
        !! Every form of a number, halfway cases, the ends of the range, subnormal numbers.
        real(dp), parameter :: least = tiny(1.0_dp)*epsilon(1.0_dp)
        type(namelist_t) :: tree
        type(error_t), allocatable :: error
        real(dp), allocatable :: x(:)

        call read_text("&a x = 1 +2 -3. .5 -.5e0 1d3 1E-3 0.1 9007199254740993 0e999 "// &
                       "1.7976931348623157e308 2.2250738585072014e-308 1e+22 -0.0"// &
                       " 1.00000000000000011102230246251565404236316680908203126"// &
                       " 4.9406564584124654E-324 -2.5e-324 2.2250738585072009e-308 /", tree)
        if (anyExceptions()) return
        call get_reals(tree, "a", "x", 18, 18, x, error)
        call check(error)
        if (anyExceptions()) return
        call assertEqual([1.0_dp, 2.0_dp, -3.0_dp, 0.5_dp, -0.5_dp, 1000.0_dp, 0.001_dp, &
                          0.1_dp, 9007199254740992.0_dp, 0.0_dp, huge(1.0_dp), tiny(1.0_dp), &
                          1e22_dp, 0.0_dp, 1.0_dp + epsilon(1.0_dp), least, -least, &
                          tiny(1.0_dp) - least], x)
        call assertTrue(x(16) > 0.0_dp .and. x(17) < 0.0_dp, message="subnormal, not zero")
        call assertEqual(-1.0_dp, sign(1.0_dp, x(14)), message="the sign of -0.0")
    end subroutine numbers_are_rounded_correctly

    subroutine integers_are_exact()
        !! A real form is welcome when it is whole; no double in between loses a digit.
        character(32), parameter :: texts(11) = &
            [character(32) :: "7", "-7", "1e6", "12.50e1", "9007199254740993", "500e-2", "0.0e99", &
             "9223372036854775807", "-9223372036854775808", "9007199254740993.0", "+1.0d18"]
        integer(i8), parameter :: expected(11) = &
            [7_i8, -7_i8, 1000000_i8, 125_i8, 9007199254740993_i8, 5_i8, 0_i8, huge(1_i8), &
             -huge(1_i8) - 1_i8, 9007199254740993_i8, 1000000000000000000_i8]
        type(namelist_t) :: tree
        type(error_t), allocatable :: error
        integer(i8) :: n
        integer :: i

        do i = 1, size(texts)
            call read_text("&a n = "//trim(texts(i))//" /", tree)
            n = 42_i8
            call get_integer(tree, "a", "n", n, error)
            call check(error)
            call assertEqual(expected(i), n, message=texts(i))
        end do
    end subroutine integers_are_exact

    subroutine logicals_have_few_forms()
        !! Eight of them, in any case.
        character(7), parameter :: texts(8) = &
            [character(7) :: ".true.", ".T.", "t", "TRUE", ".false.", ".f.", "F", "False"]
        type(namelist_t) :: tree
        type(error_t), allocatable :: error
        logical :: flag
        integer :: i

        do i = 1, size(texts)
            call read_text("&a flag = "//trim(texts(i))//"/", tree)
            flag = i > 4
            call get_logical(tree, "a", "flag", flag, error)
            call check(error)
            call assertTrue(flag .eqv. i <= 4, message=texts(i))
        end do
    end subroutine logicals_have_few_forms

    subroutine indices_and_repeats_fill_arrays()
        !! In any order, as long as no element is given twice or left out.
        type(namelist_t) :: tree
        type(error_t), allocatable :: error
        real(dp), allocatable :: q(:)

        call read_text("&a q(4) = 4.0, q(2) = 2*2.5, q = 1.0, q( 5 ) = 5 6 /", tree)
        if (anyExceptions()) return
        call get_reals(tree, "a", "q", 6, 6, q, error)
        call check(error)
        call assertEqual([1.0_dp, 2.5_dp, 2.5_dp, 4.0_dp, 5.0_dp, 6.0_dp], q)
    end subroutine indices_and_repeats_fill_arrays

    subroutine types()
        !! A number where a text belongs, and the other way round.
        type(namelist_t) :: tree
        type(error_t), allocatable :: error
        real(dp) :: x
        real(dp), allocatable :: q(:)
        integer(i8) :: n
        logical :: flag
        character(4) :: s
        character(4), allocatable :: names(:)

        call parse_namelist("&a dt = 'abc', n = nan, w = rk4,"//lf//" q = 1, x, s = 'verlet'"// &
                            " k = 3 l = tomato names = 'x', 'theta' /", "a.nml", tree, error)
        call get_real(tree, "a", "dt", x, error)
        call failed(error, "a.nml:1:9: &a: dt = 'abc': a number is needed, such as 0.01")
        call get_real(tree, "a", "n", x, error)
        call failed(error, "a.nml:1:20: &a: n = nan: a finite number is needed")
        call get_reals(tree, "a", "q", 2, 2, q, error)
        call failed(error, "a.nml:2:9: &a: q = x: a number is needed, such as 0.01")
        call get_integer(tree, "a", "w", n, error)
        call failed(error, "a.nml:1:29: &a: w = rk4: a whole number is needed")
        call get_string(tree, "a", "w", s, error)
        call failed(error, "a.nml:1:29: &a: w = rk4: a text is needed, in quotes: 'rk4'")
        call get_string(tree, "a", "k", s, error)
        call failed(error, "a.nml:2:29: &a: k = 3: a text is needed, in quotes: '3'")
        call get_string(tree, "a", "s", s, error)
        call failed(error, "a.nml:2:16: &a: s = 'verlet': a text of at most 4 characters is needed")
        call get_strings(tree, "a", "names", 1, 3, names, error)
        call failed(error, &
                    "a.nml:2:55: &a: names = 'theta': a text of at most 4 characters is needed")
        call assertFalse(allocated(names), message="a refused value changes nothing")
        call get_logical(tree, "a", "l", flag, error)
        call failed(error, "a.nml:2:35: &a: l = tomato: .true. or .false. is needed")
        call get_logical(tree, "a", "k", flag, error)
        call failed(error, "a.nml:2:29: &a: k = 3: .true. or .false. is needed")
        call apply_override(tree, "a%s=42", error)
        call get_string(tree, "a", "s", s, error)
        call failed(error, "--set a%s=42: &a: s = 42: a text is needed, in quotes: '42'")
        call apply_override(tree, "a%names=f(i, 1)", error)
        call get_strings(tree, "a", "names", 1, 3, names, error)
        call failed(error, "--set a%names=f(i, 1): &a: names = 1: a text is needed, in quotes: "// &
            "'1'; a text with commas has quotes around all of it: --set ""a%names='f(i, 1)'""")
    end subroutine types

    subroutine counts()
        !! Too few, too many, holes, an index where there is no array, nothing where it is needed.
        type(namelist_t) :: tree
        type(error_t), allocatable :: error
        real(dp), allocatable :: q(:)
        real(dp) :: x

        call parse_namelist("&a q = 1, 2, 3"//lf//"h(1)=1 h(3)=3 dt(1) = 1 /", "a.nml", tree, error)
        call get_reals(tree, "a", "q", 2, 2, q, error)
        call failed(error, "a.nml:1:4: &a: q has 3 values; 2 are needed")
        call get_reals(tree, "a", "q", 4, 6, q, error)
        call failed(error, "a.nml:1:4: &a: q has 3 values; from 4 to 6 are needed")
        call get_reals(tree, "a", "q", 1, 1, q, error)
        call failed(error, "a.nml:1:4: &a: q has 3 values; one is needed")
        call get_real(tree, "a", "q", x, error)
        call failed(error, "a.nml:1:4: &a: q has 3 values; one is needed")
        call get_reals(tree, "a", "dt", 2, 2, q, error)
        call failed(error, "a.nml:2:15: &a: dt has 1 value; 2 are needed")
        call get_reals(tree, "a", "h", 3, 3, q, error)
        call failed(error, "a.nml:2:8: &a: h: element 2 has no value")
        call get_reals(tree, "a", "h", 4, 6, q, error)
        call failed(error, "a.nml:2:8: &a: h: element 2 has no value")
        call get_real(tree, "a", "dt", x, error)
        call failed(error, &
                    "a.nml:2:15: &a: dt is a single value; write dt = value, without an index")
        call get_real(tree, "a", "m", x, error, required=.true.)
        call failed(error, "a.nml:1:1: &a: m is missing; write m = value")
        call get_reals(tree, "b", "m", 1, 2, q, error, required=.true.)
        call failed(error, "a.nml: group &b is missing; it must give m")
        call assertFalse(allocated(q), "not allocated(q)")
    end subroutine counts

    subroutine integers()
        !! Not whole, or beyond 64 bits.
        character(24), parameter :: texts(8) = [character(24) :: "1.5", "1e-3", &
                                                "1.00000000000000000001", "9223372036854775808", &
                                                "-9223372036854775809", "1e19", "1e300", &
                                                "92233720368547758070"]
        type(namelist_t) :: tree
        type(error_t), allocatable :: error
        integer(i8) :: n
        integer :: i

        do i = 1, size(texts)
            call parse_namelist("&a n="//trim(texts(i))//" /", "a.nml", tree, error)
            call get_integer(tree, "a", "n", n, error)
            if (i <= 3) then
                call failed(error, "a.nml:1:6: &a: n = "//trim(texts(i))//": is not a whole number")
            else
                call failed(error, "a.nml:1:6: &a: n = "//trim(texts(i))// &
                            ": is too large for a 64-bit integer")
            end if
        end do
    end subroutine integers

    subroutine unknown_names()
        !! The nearest name is offered, or all of them.
        character(9), parameter :: allowed(3) = [character(9) :: "length", "mass", "tolerance"]
        type(namelist_t) :: tree
        type(error_t), allocatable :: error
        real(dp) :: x

        call parse_namelist("&a"//lf//" mass = 1 lenght = 2 zzz = 3 /"//lf//"&b /"//lf// &
                            "&pendlum tolerance=1 /", "a.nml", tree, error)
        call get_real(tree, "a", "mass", x, error)
        call refuse_unknown_keys(tree, "a", allowed, error)
        call failed(error, "a.nml:2:11: &a: unknown key 'lenght'; did you mean 'length'?")
        call get_real(tree, "a", "lenght", x, error)
        call refuse_unknown_keys(tree, "a", allowed, error)
        call failed(error, "a.nml:2:22: &a: unknown key 'zzz'; allowed: length, tolerance")
        call refuse_unknown_keys(tree, "a", [character(1) ::], error)
        call failed(error, "a.nml:2:22: &a: unknown key 'zzz'; none is allowed here")
        call refuse_unknown_keys(tree, "pendlum", allowed, error)
        call failed(error, "a.nml:4:10: &pendlum: key 'tolerance' has no meaning here")
        call apply_override(tree, "a%zzz=4", error)
        call refuse_unknown_keys(tree, "a", allowed, error)
        call failed(error, "--set a%zzz=4: &a: unknown key 'zzz'; allowed: length, mass, tolerance")
        call get_real(tree, "a", "zzz", x, error)
        call refuse_unknown_keys(tree, "a", allowed, error)
        call assertFalse(allocated(error), "no error: unknown names")
        call get_real(tree, "b", "mass", x, error)
        call refuse_unknown_groups(tree, [character(8) :: "a", "b", "pendulum"], error)
        call failed(error, "a.nml:4:1: unknown group 'pendlum'; did you mean 'pendulum'?")
        call get_real(tree, "pendlum", "mass", x, error)
        call refuse_unknown_groups(tree, ["a"], error)
        call assertFalse(allocated(error), "no error: unknown names")
    end subroutine unknown_names

    subroutine values_the_caller_refuses()
        !! With the place of the value, or of one element; without, where it is a default.
        type(namelist_t) :: tree
        type(error_t), allocatable :: error

        call parse_namelist("&a dt = -1"//lf//"q = 2*0, 5 /", "a.nml", tree, error)
        call apply_override(tree, "a%m=0", error)
        call refuse_value(tree, "a", "dt", "must be positive", error)
        call failed(error, "a.nml:1:9: &a: dt = -1: must be positive")
        call refuse_value(tree, "a", "q", "must be below 4", error, element=3)
        call failed(error, "a.nml:2:10: &a: q = 5: must be below 4")
        call refuse_value(tree, "a", "m", "must be positive", error)
        call failed(error, "--set a%m=0: &a: m = 0: must be positive")
        call refuse_value(tree, "a", "g", "must be positive", error)
        call failed(error, "a.nml:1:1: &a: g: must be positive")
        call refuse_value(tree, "a", "g", "is no word", error, column=2)
        call failed(error, "a.nml:1:1: &a: g: is no word")
    end subroutine values_the_caller_refuses
end module test_namelist_values
