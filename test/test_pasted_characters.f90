module test_pasted_characters
    !! What is pasted from PDFs, word processors and equation editors: every character is read with
    !! its plain meaning, or refused with its column and a remedy.
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertTrue
    use lagrangia_errors, only: error_t
    use lagrangia_expression, only: expression_t
    use lagrangia_formula_characters, only: plain_letters
    use lagrangia_formula_parser, only: parse_formula
    use lagrangia_formula_text, only: formula_text
    use lagrangia_homework, only: homework_t, parse_homework
    use lagrangia_judgement, only: is_right, is_unreadable
    use lagrangia_letter_shapes, only: is_letter_shape
    use lagrangia_symbols, only: symbols_t
    use lagrangia_text, only: to_text
    use tried_responses, only: graded
    implicit none (type, external)
    private
    public :: pasted_characters_suite

    character, parameter :: line_feed = new_line("a"), return = char(13)

contains

    function pasted_characters_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("pasted_characters")
        call suite%addTest(TestMethod("every_character_has_a_meaning_or_a_remedy", &
                                      every_character_has_a_meaning_or_a_remedy))
        call suite%addTest(TestMethod("signs_mean_what_they_look_like", &
                                      signs_mean_what_they_look_like))
        call suite%addTest(TestMethod("letters_in_other_shapes", letters_in_other_shapes))
        call suite%addTest(TestMethod("where_alphabets_begin_and_end", &
                                      where_alphabets_begin_and_end))
        call suite%addTest(TestMethod("where_alphabets_begin_and_end", &
                                      where_alphabets_begin_and_end))
        call suite%addTest(TestMethod("remedies_of_their_own", remedies_of_their_own))
        call suite%addTest(TestMethod("lines_of_a_sheet", lines_of_a_sheet))
        call suite%addTest(TestMethod("columns_count_characters", columns_count_characters))
    end function pasted_characters_suite

    subroutine every_character_has_a_meaning_or_a_remedy()
        !! All of Unicode up to U+2FFFF and single bytes, between two factors and in a sheet's line.
        type(symbols_t) :: symbols
        type(expression_t) :: expression
        type(error_t), allocatable :: error
        character(:), allocatable :: text
        integer :: code, column, last, read

        call symbols%add("m")
        call symbols%add("x")
        read = 0
        do code = 1, int(z"2FFFF") + 128
            if (code == 10 .or. (code >= int(z"D800") .and. code <= int(z"DFFF"))) cycle
            if (code <= int(z"2FFFF")) text = utf8(code)
            if (code > int(z"2FFFF")) text = char(code - int(z"2FFFF") + 127)  ! no character
            call parse_formula("m "//text//" x", symbols, expression, error)
            if (.not. allocated(error)) then
                read = read + 1
                cycle
            end if
            last = index(error%message, ":")
            if (index(error%message, "column ") /= 1) then
                call assertEqual("column", error%message, to_text(code))
                cycle
            end if
            read (error%message(8:last - 1), *) column
            if (column < 3 .or. column > 6) call assertEqual("column 3", error%message)
            if (index(error%message, ";") > 0) cycle
            if (index(error%message, "did you mean") == 0) call assertEqual("a remedy", &
                                                                            error%message)
        end do
        call assertTrue(read > 100, "many are read: "//to_text(read))
    end subroutine every_character_has_a_meaning_or_a_remedy

    subroutine signs_mean_what_they_look_like()
        integer, parameter :: blanks(*) = [9, 160, 5760, 8192, 8193, 8194, 8195, 8196, 8197, 8198, &
                                           8199, 8200, 8201, 8202, 8239, 8287, 12288]
        integer, parameter :: nothing(*) = [8203, 8204, 8205, 8288, 8289, 65024, 65039, 65279]
        integer, parameter :: times(*) = [183, 215, 8226, 8290, 8727, 8729, 8901, 8902, 10005, &
                                          65290]
        integer, parameter :: minus(*) = [8208, 8209, 8210, 8211, 8212, 8213, 8722, 65123, 65293]
        integer, parameter :: over(*) = [247, 8260, 8725, 65295]
        integer :: i

        do i = 1, size(blanks)
            call means("m"//utf8(blanks(i))//"x", "m x")
        end do
        do i = 1, size(nothing)
            call means("m/"//utf8(nothing(i))//"x", "m/x")
        end do
        do i = 1, size(times)
            call means("m"//utf8(times(i))//"x", "m x")
        end do
        do i = 1, size(minus)
            call means("m"//utf8(minus(i))//"x", "m - x")
        end do
        do i = 1, size(over)
            call means("m"//utf8(over(i))//"x", "m/x")
        end do
        call means("m"//utf8(65291)//"x", "m + x")
        call means(utf8(8739)//"x"//utf8(8739), "abs(x)")
        call means(utf8(65288)//"m"//utf8(65289)//utf8(65342)//"3", "m^3")
        call means(utf8(8730)//"(x)", "sqrt(x)")
        ! exponents, with more than one digit and a sign, at the end and before a name
        call means("x"//utf8(178)//"m"//utf8(179)//"/"//"x"//utf8(185)//utf8(8304), "x^2 m^3/x^10")
        call means("x"//utf8(8315)//utf8(178)//utf8(8309), "x^(-25)")
        call means("x"//utf8(8315)//utf8(185)//"m", "x^(-1) m")
        call means("x"//utf8(8314)//utf8(178), "x^(2)")
        call means(utf8(189)//"m x"//utf8(178), "(1/2) m x^2")
        call means("m"//utf8(188)//"x"//utf8(8532), "m (1/4) x (2/3)")
        call means(utf8(190)//utf8(8531)//utf8(8539), "(3/4) (1/3) (1/8)")
    end subroutine signs_mean_what_they_look_like

    subroutine letters_in_other_shapes()
        !! Italic, bold, Greek, full width; with dots as one character; as an index.
        call means(utf8(int(z"1D465"))//" "//utf8(int(z"1D426")), "x m")         ! italic, bold
        call means(utf8(int(z"1D4E7"))//"^"//utf8(int(z"1D7D0")), "X^2")         ! script, bold
        call means(utf8(int(z"FF12"))//" "//utf8(int(z"FF58")), "2 x")           ! wide
        call means(utf8(int(z"1D703"))//utf8(775), "theta_dot")                  ! italic theta
        call means(utf8(int(z"1D6E9")), "Theta")
        call means(utf8(int(z"2112"))//" "//utf8(int(z"210E"))//" "//utf8(int(z"2113")), "L h l")
        call means(utf8(7819)//" "//utf8(7821)//" "//utf8(7769), "x_dot x_ddot r_dot")
        call means("p"//utf8(8339), "p_x")
        call means("m"//utf8(8322)//" "//utf8(969)//utf8(8320), "m2 omega_0")
        call means("m_2 omega0", "m2 omega_0")                                   ! as in LaTeX
        call means("2"//utf8(960)//"m", "2 pi m")
        call means("2"//utf8(int(z"1D465"))//utf8(int(z"1D45A")), "2 x m")
        call means("m"//utf8(920)//"x", "m Theta x")
        call means("x"//utf8(775)//"m"//utf8(7819)//"m", "x_dot m x_dot m")
        call assertEqual("x_1_dot + y_1_ddot m_2 - z2_dot x_a", plain_letters("x"//utf8(775)// &
            "_1 + y"//utf8(776)//"_1 m_2 - z"//utf8(775)//utf8(8322)//" x_a"), "behind the index")
        call means(utf8(int(z"FF4D"))//utf8(int(z"FF12")), "m2")
    end subroutine letters_in_other_shapes

    subroutine where_alphabets_begin_and_end()
        !! The mathematical ones have gaps: no letter may be made of these.
        integer, parameter :: gaps(*) = [int(z"1D3FF"), int(z"1D6A4"), int(z"1D6A7"), &
            int(z"1D6C1"), int(z"1D7CA"), int(z"1D7CD"), int(z"1D800")]
        integer :: i

        do i = 1, size(gaps)
            call assertFalse(is_letter_shape(gaps(i)), to_text(gaps(i)))
        end do
        call assertEqual("z", plain_letters(utf8(int(z"1D6A3"))))
        call assertEqual("A", plain_letters(utf8(int(z"1D6A8"))))
        call assertEqual("pi", plain_letters(utf8(int(z"1D7C9"))))
        call assertEqual("0", plain_letters(utf8(int(z"1D7CE"))))
        call assertEqual("9", plain_letters(utf8(int(z"1D7FF"))))
    end subroutine where_alphabets_begin_and_end

    subroutine remedies_of_their_own()
        call refused("2"//utf8(189)//" m", "column 2: U+00BD is a fraction; write it with '/'")
        call refused("m "//utf8(8776)//" x", "column 3: U+2248 is no equality; write '='")
        call refused("m "//utf8(177)//" x", "column 3: U+00B1 has two meanings; write a "// &
                     "statement with + and one with -")
        call refused("m "//utf8(8658)//" x", "column 3: U+21D2 is an arrow; write each")
        call refused("m"//utf8(8242)//" x", "column 2: a prime is no derivative; write m_dot")
        call refused("m"//utf8(8243)//" x", "column 2: a prime is no derivative; write m_ddot")
        call refused(utf8(8220)//"m"//utf8(8221), "column 1: U+201C is a quotation mark; delete")
        call refused("m"//utf8(173)//"x", "column 2: U+00AD is a hyphen that does not show")
        call refused("m"//utf8(176), "column 2: U+00B0 is a degree")
        call refused("m"//utf8(8230), "column 2: U+2026 leaves terms out")
        call refused("m"//achar(1), "column 2: U+0001 is a control character; delete it")
        call refused("m < x", "column 3: '<' is no equality; write one with '='")
        call refused("$m$", "column 1: '$' has no meaning in a formula; delete it")
        call refused("m"//utf8(8315), "column 2: ")
    contains
        subroutine refused(text, expected)
            character(*), intent(in) :: text, expected
            type(expression_t) :: expression
            type(error_t), allocatable :: error

            call parse_formula(text, names(), expression, error)
            call assertTrue(allocated(error), text)
            if (allocated(error)) call assertEqual(1, index(error%message, expected), error%message)
        end subroutine refused
    end subroutine remedies_of_their_own

    subroutine lines_of_a_sheet()
        !! Its mark of the byte order, its ends of lines, blanks around names, other equal signs.
        character(*), parameter :: right = "l theta_ddot = -g sin(theta)"
        integer, parameter :: equal(*) = [8788, 8796, 8797, 8801, 65309]
        integer :: i

        call read_as(utf8(65279)//"system: pendulum"//line_feed//right, 2)
        call read_as("system: pendulum"//return//line_feed//right//return//line_feed, 2)
        call read_as("system: pendulum"//return//return//right//return, 3)
        call read_as(utf8(160)//"system"//utf8(160)//":"//utf8(160)//"pendulum"//utf8(160)// &
                     line_feed//utf8(160)//right//utf8(160), 2)
        call read_as("system"//utf8(65306)//" pendulum"//line_feed//achar(9)//right, 2)
        call read_as("system: pendulum"//line_feed//"set: g"//utf8(160)//"="//utf8(160)//"9.81"// &
                     line_feed//"l theta_ddot + 9.81 sin(theta) = 0", 3)
        call read_as("system: pendulum"//line_feed//"l theta_ddot := -g sin(theta)", 2)
        do i = 1, size(equal)
            call read_as("system: pendulum"//line_feed//"l theta_ddot "//utf8(equal(i))// &
                         " -g sin(theta)", 2)
        end do
    contains
        subroutine read_as(text, line)
            !! One statement, which is right, at that line.
            character(*), intent(in) :: text
            integer, intent(in) :: line
            type(homework_t) :: homework
            type(error_t), allocatable :: error
            character(:), allocatable :: remark, set
            integer :: verdict

            call parse_homework(text, "sheet", homework, error)
            call assertFalse(allocated(error), text)
            if (allocated(error)) return
            call assertEqual("pendulum", homework%system, text)
            call assertEqual(1, size(homework%statements), text)
            call assertEqual(line, homework%statements(1)%line, text)
            set = ""
            if (size(homework%settings) > 0) set = "set: "//homework%settings(1)%text//line_feed
            call graded("pendulum", set//homework%statements(1)%text, verdict, remark)
            call assertEqual(is_right, verdict, text//": "//remark)
        end subroutine read_as
    end subroutine lines_of_a_sheet

    subroutine columns_count_characters()
        !! Behind Greek letters on the left side as well; a line without '='.
        call unreadable("theta = -g/l sin theta l", "column 18: 'sin' needs")
        call unreadable(utf8(952)//utf8(776)//" = -g/l sin theta l", "column 15: 'sin' needs")
        call unreadable(utf8(952)//" =", "column 4: one side of '=' is empty")
        call unreadable(utf8(952)//utf8(776)//" + g/l sin("//utf8(952)//")", "column 16: no '='; ")
        call unreadable("sin(theta) "//utf8(8800)//" theta", "column 12: U+2260 is no equality")
        call unreadable("l theta_ddot + g sin(theta) : 0 = 0", "column 29: ':' has no meaning")
        call unreadable(utf8(958)//" = q", "column 5: unknown name 'q'")
        call unreadable("ab = 1"//line_feed//"(a b) = 2", "column 2: unknown name 'a'")
    contains
        subroutine unreadable(statement, expected)
            character(*), intent(in) :: statement, expected
            character(:), allocatable :: remark
            integer :: verdict

            call graded("pendulum", statement, verdict, remark)
            call assertEqual(is_unreadable, verdict, statement)
            call assertEqual(1, index(remark, expected), statement//": "//remark)
        end subroutine unreadable
    end subroutine columns_count_characters

    subroutine means(text, plain)
        !! The same formula, as it is written again.
        character(*), intent(in) :: text, plain
        type(expression_t) :: one, other
        type(error_t), allocatable :: error

        call parse_formula(text, names(), one, error)
        if (allocated(error)) call assertEqual("", error%message, text)
        if (allocated(error)) return
        call parse_formula(plain, names(), other, error)
        call assertFalse(allocated(error), plain)
        if (allocated(error)) return
        call assertEqual(formula_text(other, names()), formula_text(one, names()), text)
    end subroutine means

    function names() result(symbols)
        type(symbols_t) :: symbols
        character(9), parameter :: all(*) = [character(9) :: "m", "x", "X", "L", "h", "l", "m2", &
                                             "omega_0", "theta_dot", "Theta", "x_dot", "x_ddot", &
                                             "r_dot", "p_x"]
        integer :: i

        do i = 1, size(all)
            call symbols%add(trim(all(i)))
        end do
    end function names

    pure function utf8(code) result(bytes)
        !! A character by Unicode's number. Source: RFC 3629.
        integer, intent(in) :: code
        character(:), allocatable :: bytes

        select case (code)
        case (:127)
            bytes = char(code)
        case (128:2047)
            bytes = char(192 + code/64)//char(128 + modulo(code, 64))
        case (2048:65535)
            bytes = char(224 + code/4096)//char(128 + modulo(code/64, 64))// &
                    char(128 + modulo(code, 64))
        case default
            bytes = char(240 + code/262144)//char(128 + modulo(code/4096, 64))// &
                    char(128 + modulo(code/64, 64))//char(128 + modulo(code, 64))
        end select
    end function utf8
end module test_pasted_characters
