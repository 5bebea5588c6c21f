module test_namelist_refusals
    !! What a scene file must not say, and the line that tells the user so.
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertTrue
    use lagrangia_errors, only: error_t, status_usage
    use lagrangia_namelist, only: apply_override, namelist_t, parse_namelist
    implicit none (type, external)
    private
    public :: namelist_refusals_suite

    character(1), parameter :: lf = achar(10), cr = achar(13), nul = achar(0)
    character(*), parameter :: no_value = &
        "no value after '='; write one (expressions are not computed), or leave the key out"
    character(*), parameter :: no_number = &
        "is not a number; write it like 0.01, -2 or 1e-3, without a unit (a text needs quotes)"
    character(*), parameter :: computed = ": a number is needed, nothing is computed"

contains

    function namelist_refusals_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("namelist refusals")
        call suite%addTest(TestMethod("slashes", slashes))
        call suite%addTest(TestMethod("text_outside_groups", text_outside_groups))
        call suite%addTest(TestMethod("ends_that_are_missing", ends_that_are_missing))
        call suite%addTest(TestMethod("values_that_are_missing", values_that_are_missing))
        call suite%addTest(TestMethod("twins", twins))
        call suite%addTest(TestMethod("names_and_indices", names_and_indices))
        call suite%addTest(TestMethod("stray_bytes", stray_bytes))
        call suite%addTest(TestMethod("numbers", numbers))
        call suite%addTest(TestMethod("overrides", overrides))
        call suite%addTest(TestMethod("overrides_of_one_value", overrides_of_one_value))
    end function namelist_refusals_suite

    subroutine refused(text, expected)
        !! Parsing `text` fails with just this message.
        character(*), intent(in) :: text, expected
        type(namelist_t) :: tree
        type(error_t), allocatable :: error

        call parse_namelist(text, "a.nml", tree, error)
        call failed(error, "a.nml:"//expected)
    end subroutine refused

    subroutine failed(error, expected)
        !! There is an error with just this message.
        type(error_t), allocatable, intent(in) :: error
        character(*), intent(in) :: expected

        call assertTrue(allocated(error), message="not refused: "//expected)
        if (.not. allocated(error)) return
        call assertEqual(expected, error%message)
        call assertEqual(status_usage, error%status)
    end subroutine failed

    subroutine override(text, expected)
        !! The override `text` fails with just this message behind its name.
        character(*), intent(in) :: text, expected
        type(namelist_t) :: tree
        type(error_t), allocatable :: error

        call parse_namelist("&scene dt=1 /", "a.nml", tree, error)
        call apply_override(tree, text, error)
        call failed(error, trim("--set "//text)//": "//expected)
    end subroutine override

    subroutine slashes()
        !! A `/` ends a group, silently elsewhere; here not where it looks like something else.
        character(*), parameter :: comment = &
            "'//' begins no comment, and '/' ends the group; a comment begins with '!'"

        call refused("&scene"//lf//" dt=1/100"//lf//"/", &
                     "2:5: &scene: dt: '1/100'"//computed//"; write 0.01")
        call refused("&a q = 0.5, 1.0 / 3 /", &
                     "1:13: &a: q: '1.0 / 3'"//computed//"; write 0.3333333333333333")
        call refused("&a dt=1/0 /", "1:7: &a: dt: '1/0'"//computed)
        call refused("&a dt=1e-3 // step"//lf//"q=1 /", "1:12: &a: "//comment)
        call refused("&a dt=1e-3, // step"//lf//"q=1 /", "1:13: &a: "//comment)
        call refused("&a x=1 s='b' / 2", "1:16: text '2' after the end of &a; '/' ends a "// &
                     "group, a comment begins with '!'")
        call refused("&a f = data/x /", "1:12: &a: '/' ends the group, yet text follows; a "// &
                     "text with '/' in it needs quotes")
    end subroutine slashes

    subroutine text_outside_groups()
        !! Prose with an `&` in it is no group; nor is a comment in another language's manner.
        character(*), parameter :: outside = &
            " outside a group; a group is written: &name key = value, ... /"
        character(*), parameter :: comment = " outside a group; a comment begins with '!'"

        call refused("this & that"//lf//"&run x=1 /", "1:1: text 'this'"//outside)
        call refused("&a x=1 /"//lf//" prose &run y=1 /", "2:2: text 'prose' outside a group; "// &
                     "&a ended on line 1, at its '/'")
        call refused("dt = 1", "1:1: text 'dt'"//outside)
        call refused("# c"//lf//"&a x=1 /", "1:1: unexpected '#'"//comment)
        call refused("// c"//lf//"&a x=1 /", "1:1: unexpected '/'"//comment)
        call refused("&a x=1 / done", "1:10: text 'done' after the end of &a; '/' ends a "// &
                     "group, a comment begins with '!'")
        call refused("$a x=1 $end", "1:1: a group begins with '&', not '$'")
        call refused("&a x=1 /"//lf//"&end", "2:1: &end without a group to end")
        call refused("", " holds no group; a group is written: &name key = value, ... /")
        call refused("! only"//lf, " holds no group; a group is written: &name key = value, ... /")
    end subroutine text_outside_groups

    subroutine ends_that_are_missing()
        !! Each its own message, and where the thing began.
        call refused(lf//" &scene dt=1"//lf//" q = 2"//lf, "2:2: group &scene begins here and "// &
                     "has no end: its '/' is missing")
        call refused("&scene"//lf//"dt=1"//lf//"&hoop m=1 /", "3:1: &scene: '&hoop' begins "// &
                     "inside the group, whose '/' is missing (it began on line 1)")
        call refused("&a s='abc"//lf//"' /", "1:6: &a: s: the text that begins with 'abc is "// &
                     "not closed with ' on its line")
        call refused("&a s=""abc", "1:6: &a: s: the text that begins with ""abc is not closed "// &
                     "with "" on its line")
    end subroutine ends_that_are_missing

    subroutine values_that_are_missing()
        !! None at all, or one in a row.
        call refused("&a dt = , q=1 /", "1:8: &a: dt: "//no_value)
        call refused("&a dt ="//lf//" q=1 /", "1:8: &a: dt: "//no_value)
        call refused("&a dt = /", "1:8: &a: dt: "//no_value)
        call refused("&a x = sin(1) /", "1:7: &a: x: "//no_value)
        call refused("&a q=1,,2 /", "1:8: &a: q: an empty value between commas; write every value")
        call refused("&a q=1, , /", "1:9: &a: q: an empty value between commas; write every value")
        call refused("&a q=3* /", "1:7: &a: q: '3*' repeats no value; write 3*0.0")
        call refused("&a q=3*,1 /", "1:7: &a: q: '3*' repeats no value; write 3*0.0")
        call refused("&a x /", "1:6: &a: x: expected '=' after the key")
        call refused("&a x: 1 /", "1:5: &a: x: expected '=' after the key")
    end subroutine values_that_are_missing

    subroutine twins()
        !! Keys, groups, elements.
        call refused("&a dt=1,"//lf//" DT=2 /", "2:2: &a: DT is given twice (first on line 1 "// &
                     "as dt, for capital letters do not count)")
        call refused("&a x=1 /"//lf//"&A x=2 /", "2:1: group &a is given twice (first on line 1)")
        call refused("&a q(1)=1 q(2)=2 q(1)=3 /", "1:18: &a: q is given twice (first on line 1)")
        call refused("&a q=1,2 q(2)=3 /", "1:10: &a: q is given twice (first on line 1)")
        call refused("&a q(2)=3 q=2*1 /", "1:11: &a: q is given twice (first on line 1)")
    end subroutine twins

    subroutine names_and_indices()
        !! What crashes libgfortran, what is too long, what is not read here.
        character(*), parameter :: one_index = "expected one index and ')', as in q(2) = 1.0"
        character(*), parameter :: bracket = &
            "; values stand in a row, as in q = 0.1, 0.2, and nothing is computed"

        call refused("&scene q("//lf, "2:1: &scene: q: "//one_index)
        call refused("&scene q(", "1:10: &scene: q: "//one_index)
        call refused("&scene q(-1) = 1 /", "1:10: &scene: q: "//one_index)
        call refused("&scene q() = 1 /", "1:10: &scene: q: the index is missing, as in q(2) = 1.0")
        call refused("&scene q(0) = 1 /", "1:10: &scene: q: the index must be from 1 to 10000")
        call refused("&scene q(99999999999) = 1 /", &
                     "1:10: &scene: q: the index must be from 1 to 10000")
        call refused("&scene q(1:2) = 1 /", "1:11: &scene: q: array sections (1:2) are not "// &
                     "read here; write all values after the key, or one index")
        call refused("&scene q(1,1) = 1 /", &
                     "1:11: &scene: q: only one index is read here, as in q(2) = 1.0")
        call refused("&a b%c = 1 /", "1:5: &a: b: components (a%b) are not read here; "// &
                     "write key = value inside &group")
        call refused("&"//repeat("n", 64)//" x=1 /", "1:2: the name '"//repeat("n", 40)// &
                     "...' is longer than 63 characters")
        call refused("&a "//repeat("k", 64)//"=1 /", "1:4: &a: the name '"//repeat("k", 40)// &
                     "...' is longer than 63 characters")
        call refused("& a x=1 /", "1:2: expected the name of a group, which begins with a letter")
        call refused("&a 1=2 /", "1:4: &a: expected the name of a key, which begins with a letter")
        call refused("&a(x) = 1 /", "1:3: unexpected '('"//bracket)
    end subroutine names_and_indices

    subroutine stray_bytes()
        !! NUL and its kin, typographic quotes, UTF-16, separators of other languages.
        character(*), parameter :: plain = "; write a blank in its place"
        character(*), parameter :: not_ascii = " is not ASCII; other letters stand in comments "// &
                                               "and between plain quotes ' or """

        call refused("&a x=1"//nul//" /", "1:7: &a: x: control character \x00"//plain)
        call refused("&a s='a"//nul//"' /", "1:8: &a: s: control character \x00"//plain)
        call refused("&a s='a"//achar(9)//"' /", "1:8: &a: s: control character \x09"//plain)
        call refused("&a "//achar(27)//"x=1 /", "1:4: &a: control character \x1B"//plain)
        call refused("&a s="//char(226)//char(128)//char(152)//"x' /", &
                     "1:6: &a: s: U+2018 is no plain quote; write ' or """)
        call refused("&a"//char(226)//char(128)//char(139)//"x=1 /", &
                     "1:3: U+200B does not show; delete it")
        call refused("&a x="//char(206)//char(184)//" /", "1:6: &a: x: U+03B8"//not_ascii)
        call refused("&a x="//char(240)//char(144)//char(141)//char(136)//" /", &
                     "1:6: &a: x: U+010348"//not_ascii)
        call refused("&a x=1"//char(226)//char(136)//" /", "1:7: &a: x: byte \xE2"//not_ascii)
        call refused(char(255)//char(254)//"&a", "1:1: byte \xFF"//not_ascii)
        call refused(char(255)//char(254)//"&"//nul, " is no plain text (UTF-16, perhaps, or "// &
                     "binary); save it as UTF-8")
        call refused("&a x=1"//cr//"y=2 /"//lf, "1:7: &a: x: a carriage return without a line "// &
                     "feed; end lines with a line feed")
        call refused("! c"//cr//"&a x=1 /"//cr, " its lines end in carriage returns alone; "// &
                     "save it with line feeds")
        call refused("&a x=1; y=2 /", "1:7: &a: x: unexpected ';'; values and keys are "// &
                     "separated by ',' or blanks")
        call refused("&a x=(1,2) /", "1:6: &a: x: unexpected '('; values stand in a row, as in "// &
                     "q = 0.1, 0.2, and nothing is computed")
        call refused("&a x=[1,2] /", "1:6: &a: x: unexpected '['; values stand in a row, as in "// &
                     "q = 0.1, 0.2, and nothing is computed")
        call refused("&a s='don't' /", &
                     "1:11: &a: s: unexpected 't' behind a text; a quote within it is doubled")
        call refused("&a s=1'b' /", "1:7: &a: s: unexpected quote; a text is written 'text', a "// &
                     "quote in it is doubled")
        call refused("&a x==1 /", "1:6: &a: x: '==' compares; one '=' gives a value")
        call refused("&a x=1 'y'=2 /", &
                     "1:11: &a: x: unexpected '='; a key is a plain name before one '='")
    end subroutine stray_bytes

    subroutine numbers()
        !! Read by libgfortran without a word, most of them.
        call refused("&a x=1.5-3 /", "1:6: &a: x: '1.5-3' lacks the letter of its exponent "// &
                     "(1.5e-3, not 1.5-3); sums are not computed")
        call refused("&a x=1e400 /", &
                     "1:6: &a: x: '1e400' is too large for a double (at most 1.79769e308)")
        call refused("&a x=-1e400 /", &
                     "1:6: &a: x: '-1e400' is too large for a double (at most 1.79769e308)")
        call refused("&a x=1e-400 /", &
                     "1:6: &a: x: '1e-400' is too small for a double (at least 4.94066e-324, or 0)")
        call refused("&a x=-2.4e-324 /", &
                     "1:6: &a: x: '-2.4e-324' is too small for a double "// &
                     "(at least 4.94066e-324, "// &
                     "or 0)")
        call refused("&a x=-inf /", "1:6: &a: x: '-inf' is not finite; a finite number is needed")
        call refused("&a x=0x1F /", &
                     "1:6: &a: x: '0x1F' is not a decimal number; hexadecimal is not read here")
        call refused("&a x=-0X1F /", &
                     "1:6: &a: x: '-0X1F' is not a decimal number; hexadecimal is not read here")
        call refused("&a x=5x /", "1:6: &a: x: '5x' "//no_number)
        call refused("&a x=0.0x /", "1:6: &a: x: '0.0x' "//no_number)
        call refused("&a x=1.0_dp /", &
                     "1:6: &a: x: '1.0_dp' has a kind suffix; write the number alone")
        call refused("&a x=1e /", &
                     "1:6: &a: x: '1e' has an exponent without digits; write it like 1e-3")
        call refused("&a x=1e+ /", &
                     "1:6: &a: x: '1e+' has an exponent without digits; write it like 1e-3")
        call refused("&a x=1.2.3 /", "1:6: &a: x: '1.2.3' has two points; write one, and "// &
                     "nothing between thousands")
        call refused("&a x=1e5.3 /", "1:6: &a: x: '1e5.3' "//no_number)
        call refused("&a x=5kg /", "1:6: &a: x: '5kg' "//no_number)
        call refused(char(239)//char(187)//char(191)//"&a x=-/", "1:6: &a: x: '-' "//no_number)
        call refused("&a x=- /", "1:6: &a: x: '-' "//no_number)
        call refused("&a x=1_000 /", "1:6: &a: x: '1_000' holds '_'; write the digits alone")
        call refused("&a x=1e5x /", "1:6: &a: x: '1e5x' "//no_number)
        call refused("&a x=1ex /", "1:6: &a: x: '1ex' "//no_number)
        call refused("&a x=1.5*y /", "1:6: &a: x: '1.5*': a repeat count is a whole number; "// &
                     "products are not computed")
    end subroutine numbers

    subroutine overrides()
        !! Refused as a file's entries are, under the name of the option.
        character(*), parameter :: pattern = "expected GROUP%KEY=VALUE, as in scene%dt=1e-3"

        call override("scene%dt", "&scene: dt: expected '=' after the key")
        call override("scene%dt=", "&scene: dt: "//no_value)
        call override("dt=1", pattern//"; write scene%dt=1")
        call override(" q = 1", pattern//"; the groups are scene")
        call override("scene.dt=2", pattern//"; write scene%dt=2")
        call override("scene:dt=2", pattern//"; write scene%dt=2")
        call override("sene.dt=2", pattern)
        call override("scene%"//char(206)//char(184)//"=1", "U+03B8 is not ASCII; the name of "// &
                      "a key has plain letters, a to z")
        call override("scene", pattern)
        call override("%dt=1", pattern)
        call override(" %dt=1", pattern)
        call override("", pattern)
        call override("scene%=1", "expected the name of a key, which begins with a letter")
        call override("scene%dt=1/100", "&scene: dt: '1/100'"//computed//"; write 0.01")
        call override("scene%dt=1e400", &
                      "&scene: dt: '1e400' is too large for a double (at most 1.79769e308)")
        call override("scene%dt=1,,2", &
                      "&scene: dt: an empty value between commas; write every value")
        call override("scene%q(1:2)=1", "&scene: q: array sections (1:2) are not read here; "// &
                      "write all values after the key, or one index")
        call override("scene%a%b=1", "&scene: a: components (a%b) are not read here; "// &
                      "write key = value inside &group")
    end subroutine overrides

    subroutine overrides_of_one_value()
        !! Two that give one element, also by other words; but not the same once more.
        character(*), parameter :: pairs(4) = [character(24) :: "scene%dt=2", "SCENE%dt=3", &
                                               "scene%q=1,2", "scene%q(2)=2"]
        type(namelist_t) :: tree
        type(error_t), allocatable :: error
        integer :: i

        do i = 1, size(pairs), 2
            call parse_namelist("&scene dt=1, q=5,6 /", "a.nml", tree, error)
            call apply_override(tree, trim(pairs(i)), error)
            call apply_override(tree, trim(pairs(i)), error)
            call assertFalse(allocated(error), message="the same once more: "//pairs(i))
            call apply_override(tree, trim(pairs(i + 1)), error)
            call failed(error, "--set "//trim(pairs(i + 1))//": &scene: "// &
                        trim(merge("dt", "q ", i == 1))//" is given twice (first by another --set)")
        end do
    end subroutine overrides_of_one_value
end module test_namelist_refusals
