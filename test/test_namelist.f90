module test_namelist
    !! Scene files: what is written is what is read.
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertFalse, assertTrue
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_namelist, only: apply_override, get_integer, get_logical, get_real, get_reals, &
                                  get_string, get_strings, has_group, has_key, namelist_t, &
                                  parse_namelist
    implicit none (type, external)
    private
    public :: namelist_suite

    character(1), parameter :: lf = achar(10), cr = achar(13), tab = achar(9)

contains

    function namelist_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("namelist")
        call suite%addTest(TestMethod("a_scene_is_read", a_scene_is_read))
        call suite%addTest(TestMethod("layout_does_not_matter", layout_does_not_matter))
        call suite%addTest(TestMethod("comments_hold_any_bytes", comments_hold_any_bytes))
        call suite%addTest(TestMethod("words_before_equals_are_keys", words_before_equals_are_keys))
        call suite%addTest(TestMethod("strings_come_whole", strings_come_whole))
        call suite%addTest(TestMethod("gfortran_reads_the_same", gfortran_reads_the_same))
        call suite%addTest(TestMethod("absent_keys_leave_defaults", absent_keys_leave_defaults))
        call suite%addTest(TestMethod("overrides_replace_and_add", overrides_replace_and_add))
    end function namelist_suite

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

    subroutine a_scene_is_read()
        !! The example of the documentation.
        type(namelist_t) :: tree
        type(error_t), allocatable :: error
        character(40) :: title, method
        character(12), allocatable :: columns(:)
        real(dp), allocatable :: q(:), v(:)
        real(dp) :: dt, m2
        integer(i8) :: every

        call read_text("&scene"//lf//"  title = 'Cart-pendulum released from 1 rad'"//lf// &
                       "  method = ""rk4"""//lf//"  dt = 1e-3, every = 10   ! or tolerance = 1"// &
                       lf//"  q = 0.0, 1.5"//lf//"  v = 2*0.25"//lf// &
                       "  columns = 't', 'x', 'energy_drift'"//lf//"/"//lf// &
                       "&cart_pendulum m1 = 2.0, m2 = 3.0, l = 1.0 /"//lf, tree)
        if (anyExceptions()) return
        call get_string(tree, "scene", "title", title, error)
        call check(error)
        call assertEqual("Cart-pendulum released from 1 rad", title)
        call get_string(tree, "scene", "method", method, error)
        call assertEqual("rk4", method)
        call get_real(tree, "scene", "dt", dt, error)
        call assertEqual(1e-3_dp, dt)
        call get_integer(tree, "scene", "every", every, error)
        call assertEqual(10_i8, every)
        call get_reals(tree, "scene", "q", 2, 2, q, error)
        call assertEqual([0.0_dp, 1.5_dp], q)
        call get_reals(tree, "scene", "v", 1, 3, v, error)
        call assertEqual([0.25_dp, 0.25_dp], v)
        call get_strings(tree, "scene", "columns", 1, 9, columns, error)
        call check(error)
        call assertEqual(3, size(columns))
        call assertEqual("energy_drift", columns(3))
        call get_real(tree, "cart_pendulum", "m2", m2, error)
        call assertEqual(3.0_dp, m2)
        call assertTrue(has_group(tree, "cart_pendulum"), "has_group(tree, 'cart_pendulum')")
        call assertFalse(has_group(tree, "pendulum"), "not has_group(tree, 'pendulum')")
        call assertTrue(has_key(tree, "cart_pendulum", "l"), "has_key(tree, 'cart_pendulum', 'l')")
        call assertFalse(has_key(tree, "scene", "l"), "not has_key(tree, 'scene', 'l')")
        call assertFalse(has_key(tree, "scene", "tolerance"), message="commented out")
    end subroutine a_scene_is_read

    subroutine layout_does_not_matter()
        !! Case, line ends, byte-order mark, tabs, blanks, final newline, terminator, commas.
        character(80) :: layouts(15)
        type(namelist_t) :: tree
        type(error_t), allocatable :: error
        real(dp) :: y
        integer :: i

        layouts = [character(80) :: "&a x=1 y=7/", "&A X=1, Y=7 /", "&a x=1"//lf//"y=7"//lf//"/", &
                   "&a"//cr//lf//"x=1"//cr//lf//"y=7"//cr//lf//"/"//cr//lf, &
                   char(239)//char(187)//char(191)//"&a x=1 y=7 /", tab//"&a"//tab//"x=1"//tab// &
                   "y"//tab//"="//tab//"7"//tab//"/"//tab, "&a x=1 y=7 &end", "&a x=1, y=7, &END", &
                   "  &a x=1 , y = 7 , / ! done", "&b /"//lf//"&a y=7 /", "&b z=2/&a y=7/", &
                   "&a y"//lf//"="//lf//"7"//lf//"/", "&a x=1 y=7"//cr//cr//lf//"/", &
                   "&a! no blank"//lf//"y=7!"//lf//"/!", "&a x=1 y=7 / &b y=2 /"]
        do i = 1, size(layouts)
            y = 0.0_dp
            call read_text(trim(layouts(i)), tree)
            call get_real(tree, "a", "y", y, error)
            call assertEqual(7.0_dp, y, message=trim(layouts(i)))
        end do
    end subroutine layout_does_not_matter

    subroutine comments_hold_any_bytes()
        !! All but the line feed that ends them, and at any length; not inside texts.
        type(namelist_t) :: tree
        type(error_t), allocatable :: error
        character(256) :: bytes
        character(20) :: s
        integer :: i
        real(dp) :: x

        do i = 0, 255
            bytes(i + 1:i + 1) = char(merge(32, i, i == 10))
        end do
        call read_text("!"//bytes//lf//"&a ! &b x=1 / '"//bytes//repeat("c", 70000)//lf// &
                       "x=5 !"//bytes//lf//"s = 'wow! so' !'"//lf//"/ ! &c", tree)
        if (anyExceptions()) return
        call get_real(tree, "a", "x", x, error)
        call assertEqual(5.0_dp, x)
        call get_string(tree, "a", "s", s, error)
        call assertEqual("wow! so", s)
        call assertFalse(has_group(tree, "b"), "not has_group(tree, 'b')")
        call assertFalse(has_group(tree, "c"), "not has_group(tree, 'c')")
    end subroutine comments_hold_any_bytes

    subroutine words_before_equals_are_keys()
        !! `t` is a logical, or a key if `=` or an index follows, even on a later line.
        type(namelist_t) :: tree
        type(error_t), allocatable :: error
        logical :: x
        real(dp) :: t
        real(dp), allocatable :: f(:)

        call read_text("&a x = t t = 3.0 y = f"//lf//"! f is next"//lf//"f"//lf//"(1) = 4 /", tree)
        if (anyExceptions()) return
        x = .false.
        call get_logical(tree, "a", "x", x, error)
        call assertTrue(x, "x")
        call get_real(tree, "a", "t", t, error)
        call assertEqual(3.0_dp, t)
        call get_reals(tree, "a", "f", 1, 1, f, error)
        call assertEqual([4.0_dp], f)
    end subroutine words_before_equals_are_keys

    subroutine strings_come_whole()
        !! Doubled quotes, the other quote, slashes and ampersands; blanks; never cut.
        type(namelist_t) :: tree
        type(error_t), allocatable :: error
        character(12), allocatable :: s(:)
        character(4) :: short
        integer :: i
        character(12), parameter :: expected(9) = [character(12) :: &
                                                   "it's", 'say "x"', "a/b & c=1", &
                                                   "", "'", "K"//char(195)//char(182)//"ln", &
                                                   "two  blanks", "rep", "rep"]

        call read_text("&a s = 'it''s' ""say """"x"""""", 'a/b & c=1','','''','K"//char(195)// &
                       char(182)//"ln' 'two  blanks' 2*'rep' c='rk4  ' d='abcde' /", tree)
        if (anyExceptions()) return
        call get_strings(tree, "a", "s", 9, 9, s, error)
        call check(error)
        if (anyExceptions()) return
        do i = 1, 9
            call assertEqual(expected(i), s(i))
        end do
        call get_string(tree, "a", "c", short, error)
        call check(error)
        call assertEqual("rk4", short)
        call get_string(tree, "a", "d", short, error)
        call assertTrue(allocated(error), "an error: strings come whole")
        call assertEqual("rk4", short, message="a refused value changes nothing")
    end subroutine strings_come_whole

    subroutine gfortran_reads_the_same()
        !! Where libgfortran reads a namelist rightly, so do we, and the other way round.
        character(60) :: lines(5)
        type(namelist_t) :: tree
        type(error_t), allocatable :: error
        real(dp) :: x(5), y, our_y
        real(dp), allocatable :: our_x(:)
        character(20) :: s, our_s, w(2)
        character(20), allocatable :: our_w(:)
        logical :: flag, our_flag
        integer(i8) :: n, our_n
        integer :: i
        character(305) :: text
        namelist /a/ x, y, s, flag, n, w

        lines = [character(60) :: "&a  ! comment", "x = 3*1.5, 2d-3 y=-.5, s='it''s ! / &' ", &
                 "  FLAG=.true. n = 12, x(5) = 7", "w = 'a', ""b""", "/"]
        text = ""
        do i = 1, size(lines)
            text(61*i - 60:61*i) = lines(i)//lf
        end do
        read (lines, nml=a)
        call read_text(text, tree)
        if (anyExceptions()) return
        call get_reals(tree, "a", "x", 5, 5, our_x, error)
        call check(error)
        call assertEqual(x, our_x)
        call get_real(tree, "a", "y", our_y, error)
        call assertEqual(y, our_y)
        call get_string(tree, "a", "s", our_s, error)
        call assertEqual(s, our_s)
        call get_strings(tree, "a", "w", 2, 2, our_w, error)
        call assertEqual(w(1)//w(2), our_w(1)//our_w(2))
        our_flag = .not. flag
        call get_logical(tree, "a", "flag", our_flag, error)
        call assertTrue(flag .eqv. our_flag, "flag .eqv. our_flag")
        call get_integer(tree, "a", "n", our_n, error)
        call assertEqual(n, our_n)
    end subroutine gfortran_reads_the_same

    subroutine absent_keys_leave_defaults()
        !! And say so, whether the key or its group is absent.
        type(namelist_t) :: tree
        type(error_t), allocatable :: error
        real(dp) :: x
        real(dp), allocatable :: q(:)
        character(4) :: s

        call read_text("&a y = 1 /", tree)
        x = 9.81_dp
        s = "rk4"
        call get_real(tree, "a", "x", x, error)
        call check(error)
        call assertFalse(has_key(tree, "a", "x"), "not found")
        call assertEqual(9.81_dp, x)
        call get_string(tree, "b", "s", s, error)
        call check(error)
        call assertFalse(has_key(tree, "b", "s"), "not found")
        call assertEqual("rk4", s)
        call get_reals(tree, "a", "q", 2, 2, q, error)
        call check(error)
        call assertFalse(allocated(q), "not allocated(q)")
        call get_real(tree, "a", "y", x, error, required=.true.)
        call check(error)
        call assertTrue(has_key(tree, "a", "y"), "found")
        call assertEqual(1.0_dp, x)
    end subroutine absent_keys_leave_defaults

    subroutine overrides_replace_and_add()
        !! Whole entries, single elements, new keys, new groups; texts without quotes; once more
        !! the same.
        character(40), parameter :: overrides(12) = [character(40) :: &
            "Scene % DT = 2e-4", "scene%q(2)=5", "Scene % DT = 2e-4", "scene%title=My own title", &
            "scene%columns=t, x,'y, z'", "hoop%r=3", "scene%v=7,8", "scene%flag=t", &
            "scene%output=../a b/c", "scene%q(1)=4", "hoop%s=!", "scene%q(2)=5"]
        type(namelist_t) :: tree
        type(error_t), allocatable :: error
        real(dp), allocatable :: q(:)
        character(20), allocatable :: columns(:)
        character(20) :: text
        real(dp) :: x
        logical :: flag
        integer :: i

        call read_text("&scene dt = 1, q = 1, 2, 3 v = 1,2,3, title='x' output='y' /", tree)
        do i = 1, size(overrides)
            call apply_override(tree, trim(overrides(i)), error)
            call check(error)
        end do
        if (anyExceptions()) return
        call get_real(tree, "scene", "dt", x, error)
        call check(error)
        call assertEqual(2e-4_dp, x)
        call get_reals(tree, "scene", "q", 3, 3, q, error)
        call check(error)
        call assertEqual([4.0_dp, 5.0_dp, 3.0_dp], q)
        call get_reals(tree, "scene", "v", 2, 2, q, error)
        call check(error)
        call assertEqual([7.0_dp, 8.0_dp], q)
        call get_string(tree, "scene", "title", text, error)
        call assertEqual("My own title", text)
        call get_string(tree, "scene", "output", text, error)
        call assertEqual("../a b/c", text)
        call get_string(tree, "hoop", "s", text, error)
        call assertEqual("!", text, message="no comments in an override")
        allocate (columns(1))
        call get_strings(tree, "scene", "columns", 3, 3, columns, error)
        call check(error)
        call assertEqual("t|x|y, z", trim(columns(1))//"|"//trim(columns(2))//"|"//columns(3))
        call get_real(tree, "hoop", "r", x, error)
        call assertEqual(3.0_dp, x)
        flag = .false.
        call get_logical(tree, "scene", "flag", flag, error)
        call assertTrue(flag, "flag")
    end subroutine overrides_replace_and_add
end module test_namelist
