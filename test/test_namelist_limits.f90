module test_namelist_limits
    !! However large or strange a file is: little memory, and a short plain message.
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertLessThanOrEqual, &
                     assertTrue
    use lagrangia_errors, only: error_t, status_usage
    use lagrangia_kinds, only: dp
    use lagrangia_namelist, only: apply_override, get_real, get_reals, namelist_t, &
                                  parse_namelist, refuse_unknown_groups, refuse_unknown_keys, &
                                  refuse_value
    implicit none (type, external)
    private
    public :: namelist_limits_suite

    character(1), parameter :: lf = achar(10), tab = achar(9)

contains

    function namelist_limits_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("namelist limits")
        call suite%addTest(TestMethod("a_large_file_is_read", a_large_file_is_read))
        call suite%addTest(TestMethod("too_much", too_much))
        call suite%addTest(TestMethod("messages_are_bounded", messages_are_bounded))
    end function namelist_limits_suite

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

    subroutine plain(error)
        !! The message is one short line of plain text, and not cut in the middle.
        type(error_t), allocatable, intent(in) :: error
        integer :: i

        call assertTrue(allocated(error), "an error: plain")
        if (.not. allocated(error)) return
        call assertLessThanOrEqual(len("lagrangia: "//error%message), 300)
        do i = 1, len(error%message)
            if (iachar(error%message(i:i)) >= 32 .and. iachar(error%message(i:i)) < 127) cycle
            call assertEqual("plain text", error%message)
            return
        end do
    end subroutine plain

    subroutine a_large_file_is_read()
        !! A megabyte of comments and blanks, and as many values as there may be.
        type(namelist_t) :: tree
        type(error_t), allocatable :: error
        real(dp), allocatable :: x(:)

        call read_text(repeat("! "//repeat("c", 97)//lf, 5000)//"&a x ="//repeat(" 1.25,", 9998)// &
                       repeat(" "//tab//lf, 200000)//" 2*2.5 /", tree)
        call get_reals(tree, "a", "x", 10000, 10000, x, error)
        call check(error)
        call assertEqual(9998*1.25_dp + 5.0_dp, sum(x))
    end subroutine a_large_file_is_read

    subroutine too_much()
        !! Nothing a file says makes the program ask for much memory.
        character(*), parameter :: keys = "abcdefghij"
        character(:), allocatable :: text
        integer :: i, j, k, l

        call refused("&a q=999999999*0 /", &
                     "1:6: &a: q: the repeat count '999999999' must be from 1 to 10000")
        call refused("&a q=0*1 /", "1:6: &a: q: the repeat count '0' must be from 1 to 10000")
        call refused("&a q=10000*0 r=1 /", "1:16: more than 10000 values (repeats counted)")
        call refused("&a q=10000*0, 1 /", "1:15: more than 10000 values (repeats counted)")
        text = "&a"
        do l = 1, 2
            do i = 1, 10
                do j = 1, 10
                    do k = 1, 10
                        text = text//lf//keys(l:l)//keys(i:i)//keys(j:j)//keys(k:k)//"=1"
                    end do
                end do
            end do
        end do
        call refused(text//"/", "1002:1: more than 1000 keys")
        text = ""
        do i = 1, 10
            do j = 1, 10
                text = text//"&"//keys(i:i)//keys(j:j)//"/"//lf
            end do
        end do
        call refused(text//"&kk/", "101:1: more than 100 groups")
    end subroutine too_much

    subroutine messages_are_bounded()
        !! At most 300 plain characters, whatever the name of the file and its bytes.
        type(namelist_t) :: tree
        type(error_t), allocatable :: error
        character(60), parameter :: name = repeat("k", 60)
        character(300) :: bytes
        integer :: i
        real(dp) :: x

        do i = 1, 300
            bytes(i:i) = char(merge(64, mod(i, 256), any(mod(i, 256) == [9, 10, 13, 32, 33, 34])))
        end do
        call parse_namelist("&"//name//" "//name//" = '"//bytes(127:255)//"' /", &
                            repeat("/path", 60)//bytes//"/a.nml", tree, error)
        call assertTrue(allocated(error), message="DEL in a text")
        call plain(error)
        call parse_namelist("&"//name//" "//name//" = '"//bytes(128:255)//"' /", &
                            repeat("/path", 60)//lf//"/a.nml", tree, error)
        call assertFalse(allocated(error), "no error: messages are bounded")
        call get_real(tree, name, name, x, error)
        call plain(error)
        call assertEqual("...", error%message(:3), message="the end of a long path is kept")
        call assertTrue(index(error%message, "/a.nml:1:") > 0, &
                        "index(error%message, '/a.nml:1:') > 0")
        call refuse_value(tree, name, name, repeat("too long, ", 40), error)
        call plain(error)
        call assertTrue(index(error%message(4:), "...") > 0, &
                        message="a long message says that it is cut")
        call assertEqual("too long, ", error%message(len(error%message) - 9:), message="its end")
        call refuse_unknown_keys(tree, "x", [repeat("l", 60)], error)
        call assertFalse(allocated(error), message="a group that is not there")
        call refuse_unknown_groups(tree, [(repeat("l", 60), i=1, 50)], error)
        call assertFalse(allocated(error), message="a used group")
        call parse_namelist(bytes, "a.nml", tree, error)
        call plain(error)
        call apply_override(tree, bytes(65:90)//"%"//bytes, error)
        call plain(error)
    end subroutine messages_are_bounded
end module test_namelist_limits
