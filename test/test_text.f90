module test_text
    !! Text helpers: names that are near, bytes that are safe to show, numbers that read back.
    use, intrinsic :: ieee_arithmetic, only: ieee_negative_inf, ieee_positive_inf, &
                                             ieee_quiet_nan, ieee_value
    use funit, only: TestMethod, TestSuite, assertEqual, assertTrue
    use lagrangia_kinds, only: dp, i8
    use lagrangia_names, only: abbreviation, advice, nearest_name
    use lagrangia_text, only: escaped, in_words, join, listed, lower, quoted, replaced, &
                              short_source, shortened, to_text
    use random_states, only: restart_random, uniform
    implicit none (type, external)
    private
    public :: text_suite

contains

    function text_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("text")
        call suite%addTest(TestMethod("lower_leaves_other_bytes", lower_leaves_other_bytes))
        call suite%addTest(TestMethod("long_lists_say_where_all_stand", &
                                      long_lists_say_where_all_stand))
        call suite%addTest(TestMethod("join_trims_and_separates", join_trims_and_separates))
        call suite%addTest(TestMethod("shown_text_is_plain_and_bounded", &
                                      shown_text_is_plain_and_bounded))
        call suite%addTest(TestMethod("long_words_lose_their_middle", long_words_lose_their_middle))
        call suite%addTest(TestMethod("nearest_name_mends_slips", nearest_name_mends_slips))
        call suite%addTest(TestMethod("nearest_name_gives_up", nearest_name_gives_up))
        call suite%addTest(TestMethod("long_names_of_files", long_names_of_files))
        call suite%addTest(TestMethod("reals_look_short", reals_look_short))
        call suite%addTest(TestMethod("reals_read_back", reals_read_back, setUp=restart_random))
        call suite%addTest(TestMethod("integers_in_decimal", integers_in_decimal))
        call suite%addTest(TestMethod("the_longer_abbreviation_is_taken", &
                                      the_longer_abbreviation_is_taken))
        call suite%addTest(TestMethod("characters_are_not_split", characters_are_not_split))
    end function text_suite

    subroutine lower_leaves_other_bytes()
        !! Only A to Z change.
        call assertEqual("az09_@[`{"//char(195)//char(132), &
                         lower("AZ09_@[`{"//char(195)//char(132)))
    end subroutine lower_leaves_other_bytes

    subroutine long_lists_say_where_all_stand()
        !! No name is cut; and names become words.
        character(5), parameter :: names(3) = ["alpha", "b    ", "gamma"]

        call assertEqual("alpha, b, gamma", listed(names, 15, "show"))
        call assertEqual("alpha, b, ...; 'show' has all", listed(names, 14, "show"))
        call assertEqual("alpha, ...; 'show' has all", listed(names, 8, "show"))
        call assertEqual("...; 'show' has all", listed(names, 4, "show"))
        call assertEqual("double pendulum", in_words("double_pendulum   "))
        call assertEqual("*m*s**", replaced(" m s  ", " ", "*"))
        call assertEqual("_", listed(["_"], 1, "show"))
    end subroutine long_lists_say_where_all_stand

    subroutine join_trims_and_separates()
        !! No separator at the ends.
        call assertEqual("a, bcd, e", join([character(5) :: "a", "bcd", "e"], ", "))
        call assertEqual("a", join(["a"], ", "))
        call assertEqual(0, len(join([character(5) ::], ", ")))
    end subroutine join_trims_and_separates

    subroutine shown_text_is_plain_and_bounded()
        !! Control characters and bytes that are no UTF-8 in hexadecimal, length bounded, no
        !! character split.
        character(*), parameter :: theta = char(206)//char(184)

        call assertEqual("a\x00\x1B[31m\x7F\xC3b", &
                         escaped("a"//achar(0)//achar(27)//"[31m"//achar(127)//char(195)//"b"))
        call assertEqual("'abc'", quoted("abc"))
        call assertEqual("'"//repeat("x", 40)//"'", quoted(repeat("x", 40)))
        call assertEqual("'"//repeat("x", 40)//"...'", quoted(repeat("x", 41)))
        call assertEqual("abc...", escaped("abcd", 3))
        call assertEqual("ab...", escaped("ab"//achar(1), 3))
        call assertEqual("'"//theta//" = 1'", quoted(theta//" = 1"), "Greek")
        call assertEqual("a"//theta//"...", escaped("a"//theta//theta, 4))
        call assertEqual("\xCE", escaped(theta(:1)))
        call assertEqual("\xC2\x9B", escaped(char(194)//char(155)), "C1")
        call assertEqual("''", quoted(""))
    end subroutine shown_text_is_plain_and_bounded

    subroutine long_words_lose_their_middle()
        !! Only as much as must be, the longest first; then the text as a whole. No UTF-8 is split.
        character(*), parameter :: path = "/"//repeat("p", 60)//"/a.nml:1:2:"
        character(*), parameter :: umlaut = char(195)//char(164)
        character(:), allocatable :: short
        integer :: most

        call assertEqual("a b c", shortened("a b c", 5))
        call assertEqual("to "//path//" x", shortened("to "//path//" x", len(path) + 5))
        short = shortened("to "//path//" x", 60)
        call assertEqual(60, len(short))
        call assertEqual("to /p", short(:5))
        call assertTrue(index(short, "p...p") > 0 .and. index(short, "p/a.nml:1:2: x") > 0, short)
        short = shortened(repeat("p", 200)//"/a.nml:1:2: "//repeat("word ", 20)//"remedy", 150)
        call assertEqual("/a.nml:1:2: "//repeat("word ", 20)//"remedy", short(33:), &
                         message="a path")
        short = shortened(repeat("w", 90)//" "//repeat("v", 50)//" remedy", 110)
        call assertEqual(repeat("v", 50)//" remedy", short(len(short) - 56:), message="the longest")
        short = shortened(repeat("word ", 40)//"remedy", 60)
        call assertEqual(60, len(short))
        call assertTrue(index(short, "word") == 1 .and. index(short, "remedy") == 55, short)
        do most = 50, 53
            short = shortened(repeat(umlaut, 60), most)
            call assertTrue(len(short) <= most .and. mod(index(short, ".") - 1, 2) == 0 .and. &
                            mod(len(short) - 3, 2) == 0, short)
        end do
    end subroutine long_words_lose_their_middle

    subroutine nearest_name_mends_slips()
        !! A letter lost, added, changed or swapped; the best of several; whatever the case.
        character(13), parameter :: names(5) = &
            [character(13) :: "pendulum", "cart_pendulum", "atwood", "m1", "length"]

        call assertEqual("cart_pendulum", nearest_name("cart_pendlum", names))
        call assertEqual("pendulum", nearest_name("penduulum", names))
        call assertEqual("pendulum", nearest_name("pendulun", names))
        call assertEqual("length", nearest_name("lenght", names))
        call assertEqual("atwood", nearest_name("ATWODO", names))
        call assertEqual("m1", nearest_name("m2", names))
        call assertEqual("pendulum", nearest_name("pendel", names))
        call assertEqual("pendulum", nearest_name("simple_pendulum", names))
        call assertEqual("cart_pendulum", nearest_name("Cart", names))
        call assertEqual("event_columns", nearest_name("event_column_list", &
                                                       ["event        ", "event_columns"]))
        call assertEqual("m1", abbreviation("mass1", names))
        call assertEqual("g", abbreviation("gravity", ["m", "g"]))
        call assertEqual("did you mean 'm1'?", advice("M1", names))
        call assertEqual("there are a, b", advice("c", ["a", "b"]))
    end subroutine nearest_name_mends_slips

    subroutine nearest_name_gives_up()
        !! Nothing near: no advice rather than a wild one. A swap counts as one slip.
        call assertEqual(0, len(nearest_name("rk4", ["verlet", "boris "])))
        call assertEqual(0, len(nearest_name("k", ["m"])))
        call assertEqual(0, len(nearest_name("", ["m"])))
        call assertEqual(0, len(nearest_name("m", [character(1) ::])))
        call assertEqual(0, len(nearest_name(repeat("m", 64), [repeat("m", 63)])))
        call assertEqual("dt", nearest_name("td", ["dt"]), message="one swap")
        call assertEqual(0, len(nearest_name("dt", ["at"])), message="a first letter")
        call assertEqual(0, len(nearest_name("all", ["bouncing_ball"])), message="within a word")
        call assertEqual(0, len(abbreviation("alpha", ["m", "l"])))
        call assertEqual(0, len(abbreviation("mass2", ["m1"])))
        call assertEqual(0, len(nearest_name("abc", ["acd"])), message="two slips in three letters")
        call assertEqual("acde", nearest_name("abce", ["acde"]), &
                         message="two slips in four letters")
    end subroutine nearest_name_gives_up

    subroutine long_names_of_files()
        !! The end is kept, of characters of two bytes only whole ones.
        character(2), parameter :: theta = char(206)//char(184)

        call assertEqual("..."//repeat(theta, 46)//".nml", trim(short_source(repeat(theta, 80)// &
                                                                             ".nml")))
        call assertEqual("..."//repeat(theta, 46)//"a.nml", trim(short_source(repeat(theta, 80)// &
                                                                              "a.nml")))
    end subroutine long_names_of_files

    subroutine reals_look_short()
        !! What a person would have typed.
        call assertEqual("0.01", to_text(0.01_dp))
        call assertEqual("0.001", to_text(1e-3_dp))
        call assertEqual("9.81", to_text(9.81_dp))
        call assertEqual("20.0", to_text(20.0_dp))
        call assertEqual("-2.5", to_text(-2.5_dp))
        call assertEqual("0.0", to_text(0.0_dp))
        call assertEqual("1234.5", to_text(1234.5_dp))
        call assertEqual("1e-5", to_text(1e-5_dp))
        call assertEqual("1.5e-7", to_text(1.5e-7_dp))
        call assertEqual("1e22", to_text(1e22_dp))
        call assertEqual("-1.5e300", to_text(-1.5e300_dp))
        call assertEqual("0.30000000000000004", to_text(0.1_dp + 0.2_dp))
    end subroutine reals_look_short

    subroutine reals_read_back()
        !! Bit by bit, over all exponents.
        real(dp) :: back, number
        character(32) :: text
        integer :: i, wrong

        wrong = 0
        do i = 1, 20000
            number = uniform(-0.5_dp, 0.5_dp)
            number = number*10.0_dp**uniform(-300.0_dp, 300.0_dp)
            text = to_text(number)
            read (text, *) back
            if (transfer(back, 1_i8) /= transfer(number, 1_i8)) wrong = wrong + 1
        end do
        call assertEqual(0, wrong)
        text = to_text(-0.0_dp)
        call assertEqual("-0.0", text)
        call assertEqual("inf", to_text(ieee_value(1.0_dp, ieee_positive_inf)))
        call assertEqual("-inf", to_text(ieee_value(1.0_dp, ieee_negative_inf)))
        call assertEqual("nan", to_text(ieee_value(1.0_dp, ieee_quiet_nan)))
    end subroutine reals_read_back

    subroutine integers_in_decimal()
        !! Both kinds, the ends included.
        call assertEqual("-7", to_text(-7))
        call assertEqual("9223372036854775807", to_text(huge(1_i8)))
        call assertEqual("-9223372036854775808", to_text(-huge(1_i8) - 1_i8))
    end subroutine integers_in_decimal

    subroutine the_longer_abbreviation_is_taken()
        !! In any order.
        call assertEqual("m1", abbreviation("mass1", [character(2) :: "m1", "m"]))
        call assertEqual("m1", abbreviation("mass1", [character(2) :: "m", "m1"]))
        call assertEqual("m", abbreviation("mass", [character(2) :: "", "m"]))
    end subroutine the_longer_abbreviation_is_taken

    subroutine characters_are_not_split()
        !! Of two and of three bytes, wherever the cut falls; and bytes that continue nothing have
        !! no end.
        call assertEqual(repeat("é", 7)//"..."//repeat("é", 16), shortened(repeat("é", 60), 50))
        call assertEqual("x"//repeat("é", 7)//"..."//repeat("é", 16), &
                         shortened("x"//repeat("é", 60), 50))
        call assertEqual(repeat("€", 5)//"..."//repeat("€", 10), &
                         shortened(repeat("€", 60), 49))
        call assertEqual(repeat("€", 5)//"..."//repeat("€", 10), &
                         shortened(repeat("€", 60), 51))
        call assertEqual("..."//char(130), shortened(repeat(char(130), 60), 50))
    end subroutine characters_are_not_split
end module test_text
