module test_characters
    !! What may reach a terminal, a data file's header and JSON; and the heads of tables, which no
    !! name or unit may break.
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertTrue
    use lagrangia_characters, only: characters, printable
    use lagrangia_column_words, only: column_word, unit_word
    use lagrangia_csv_table, only: csv_table_t
    use lagrangia_errors, only: error_t
    use lagrangia_json, only: json_string
    use lagrangia_npy, only: npy_table_t
    use lagrangia_table, only: table_t
    use lagrangia_text_table, only: text_table_t
    use test_scratch, only: contents, new_folder, remove_file
    implicit none (type, external)
    private
    public :: characters_suite

    character(*), parameter :: umlaut = char(195)//char(164)                  ! U+00E4
    character(*), parameter :: arrow = char(226)//char(134)//char(146)        ! U+2192
    character(*), parameter :: face = char(240)//char(159)//char(152)//char(128)  ! U+1F600

contains

    function characters_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("characters")
        call suite%addTest(TestMethod("text_stays", text_stays))
        call suite%addTest(TestMethod("controls_are_told", controls_are_told))
        call suite%addTest(TestMethod("what_is_no_utf_8_is_told", what_is_no_utf_8_is_told))
        call suite%addTest(TestMethod("json_is_utf_8", json_is_utf_8))
        call suite%addTest(TestMethod("a_text_table_has_a_word_a_column", &
                                      a_text_table_has_a_word_a_column))
        call suite%addTest(TestMethod("a_csv_table_has_a_cell_a_column", &
                                      a_csv_table_has_a_cell_a_column))
        call suite%addTest(TestMethod("an_npy_table_has_a_string_a_column", &
                                      an_npy_table_has_a_string_a_column))
    end function characters_suite

    subroutine text_stays()
        !! Every printable character of ASCII, and of UTF-8 in two, three and four bytes.
        character(95) :: ascii
        integer :: i

        do i = 1, 95
            ascii(i:i) = achar(31 + i)
        end do
        call assertEqual(ascii, printable(ascii))
        call assertEqual(umlaut//"a"//arrow//face, printable(umlaut//"a"//arrow//face))
        call assertEqual(0, len(printable("")))
        call assertEqual(3, len(printable(" a ")), "blanks count")
        call assertEqual(4, characters(umlaut//"a"//arrow//face))
        do i = 128, 191
            call assertEqual(1, characters(char(206)//char(i)), "one of two bytes")
        end do
    end subroutine text_stays

    subroutine controls_are_told()
        !! C0, DEL and C1, the ends of lines of Unicode, and what turns the direction of a text.
        integer :: i

        do i = 0, 31
            call assertEqual(4, len(printable(achar(i))))
        end do
        call assertEqual("a\x1B[31m\x0A\x7F"//umlaut, &
                         printable("a"//achar(27)//"[31m"//achar(10)//achar(127)//umlaut))
        call assertEqual("\xC2\x80\xC2\x9F", printable(char(194)//char(128)//char(194)//char(159)))
        call assertEqual(char(194)//char(160), printable(char(194)//char(160)), "U+00A0")
        call assertEqual("\xE2\x80\xA8", printable(char(226)//char(128)//char(168)), "U+2028")
        call assertEqual("\xE2\x80\xAE", printable(char(226)//char(128)//char(174)), "U+202E")
        call assertEqual("\xE2\x81\xA6", printable(char(226)//char(129)//char(166)), "U+2066")
    end subroutine controls_are_told

    subroutine what_is_no_utf_8_is_told()
        !! Stray bytes, characters cut short, overlong forms, surrogates, what is beyond Unicode:
        !! those of RFC 3629, section 3 and 4.
        call assertEqual("\xFFa\x80", printable(char(255)//"a"//char(128)))
        call assertEqual("\xC3", printable(char(195)))
        call assertEqual("\xE2\x86", printable(char(226)//char(134)))
        call assertEqual("\xC3a", printable(char(195)//"a"))
        call assertEqual("\xC0\xAF", printable(char(192)//char(175)), "an overlong slash")
        call assertEqual("\xE0\x80\xAF", printable(char(224)//char(128)//char(175)), "and another")
        call assertEqual("\xED\xA0\x80", printable(char(237)//char(160)//char(128)), "U+D800")
        call assertEqual("\xF4\x90\x80\x80", &
                         printable(char(244)//char(144)//char(128)//char(128)), "U+110000")
        call assertEqual(char(244)//char(143)//char(191)//char(191), &
                         printable(char(244)//char(143)//char(191)//char(191)), "U+10FFFF")
    end subroutine what_is_no_utf_8_is_told

    subroutine json_is_utf_8()
        !! What is none is told by its bytes; what turns the text around is escaped.
        call assertEqual('"\\xFF\\xC3"', json_string(char(255)//char(195)))
        call assertEqual('"\u0085\u202e"', json_string(char(194)//char(133)//char(226)// &
                                                      char(128)//char(174)))
        call assertEqual('"'//char(195)//char(164)//'"', json_string(char(195)//char(164)))
    end subroutine json_is_utf_8

    function head(table, name, unit) result(text)
        !! The file of a table without rows, whose second column is called `name`.
        class(table_t), intent(inout) :: table
        character(*), intent(in) :: name, unit
        character(:), allocatable :: text, path
        type(error_t), allocatable :: error

        path = new_folder("characters")//"/head"
        call table%file%open(path, error)
        call assertFalse(allocated(error), "no error: json is utf 8")
        call table%begin(["title "//char(10)//"1 2"], [character(20) :: "t", name], &
                         [character(20) :: "s", unit], error)
        call assertFalse(allocated(error), "no error: json is utf 8")
        call table%finish("rows: 0"//char(10)//repeat("x ", 300), error)
        if (.not. allocated(error)) call table%file%commit(error)
        call assertFalse(allocated(error), "no error: json is utf 8")
        text = contents(path)
        call assertTrue(remove_file(path), "it was there: "//path)
    end function head

    subroutine a_text_table_has_a_word_a_column()
        !! A blank in a unit is a product, `*`; a line stays a line, and a comment.
        type(text_table_t) :: table
        character(:), allocatable :: text
        character(1), parameter :: end_line = new_line("a")

        text = head(table, "p_x", "kg m/s")
        call assertEqual("# title \x0A1 2"//end_line, text(:16))
        call assertEqual("# rows: 0\x0A", text(17:29))
        text = text(index(text(:len(text) - 1), end_line, back=.true.) + 1:)
        call assertEqual("# t[s] p_x[kg*m/s]"//end_line, text, "long counts stay in their line")
        text = head(table, "a b", "m"//end_line//"1")
        text = text(index(text(:len(text) - 1), end_line, back=.true.) + 1:)
        call assertEqual("# t[s] a*b[m\x0A1]"//end_line, text)
        call assertEqual("flat_throw", column_word("flat throw"))
        call assertEqual("T_by_hand", column_word("T by hand"))
        call assertEqual("T,3n_equations", column_word("T, 3n equations"))
        call assertEqual("rod_of_a_cart-pendulum", column_word("rod of a cart-pendulum"))
        call assertEqual("without_dT/dtheta", column_word("without dT/dtheta"))
        call assertEqual("m2*l*x_dot*theta_dot*sin(theta)", &
                         column_word("m2 l x_dot theta_dot sin(theta)"))
        call assertEqual("p_x*t-M*x_com", column_word("p_x t - M x_com"))
        call assertEqual("(m1-m2)/M", column_word("(m1 - m2)/M"))
        call assertEqual("m/s^2,rad/s^2", unit_word("m/s^2, rad/s^2"))
    end subroutine a_text_table_has_a_word_a_column

    subroutine a_csv_table_has_a_cell_a_column()
        !! As RFC 4180 quotes what holds commas and quotes.
        type(csv_table_t) :: table

        call assertEqual("t,p_x"//new_line("a"), head(table, "p_x", "m,s"))
        call assertEqual("t,""a,b"""//new_line("a"), head(table, "a,b", ""))
        call assertEqual("t,""a""""b"""//new_line("a"), head(table, "a""b", ""))
        call assertEqual("t,a\x0Ab"//new_line("a"), head(table, "a"//char(10)//"b", ""))
    end subroutine a_csv_table_has_a_cell_a_column

    subroutine an_npy_table_has_a_string_a_column()
        !! As Python reads it, in ASCII.
        type(npy_table_t) :: table
        character(:), allocatable :: text
        integer :: i

        text = head(table, "it's\", "")
        call assertTrue(index(text, "('it\'s\\', ") > 0, text)
        text = head(table, "a"//umlaut//char(10), "")
        call assertTrue(index(text, "('a\U000000E4\U0000000A', ") > 0, text)
        call assertTrue(all([(iachar(text(i:i)) < 128, i=11, len(text))]), "ASCII")
    end subroutine an_npy_table_has_a_string_a_column
end module test_characters
