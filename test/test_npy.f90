module test_npy
    !! NumPy's format, byte by byte.
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertFalse, assertTrue
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp
    use lagrangia_npy, only: npy_table_t
    use test_scratch, only: contents, new_folder, remove_file
    implicit none (type, external)
    private
    public :: npy_suite

contains

    function npy_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("npy")
        call suite%addTest(TestMethod("the_header_is_numpys", the_header_is_numpys))
        call suite%addTest(TestMethod("the_rows_follow", the_rows_follow))
        call suite%addTest(TestMethod("too_many_columns_are_refused", &
                                      too_many_columns_are_refused))
        call suite%addTest(TestMethod("bytes_that_are_no_letters", bytes_that_are_no_letters))
    end function npy_suite

    subroutine the_header_is_numpys()
        !! Format 1.0 of `numpy.lib.format`; the length is that of the header, and it is aligned.
        type(npy_table_t) :: file
        type(error_t), allocatable :: error
        character(:), allocatable :: path, bytes, text
        character(1) :: low
        integer :: length, row

        low = transfer(1, low)  ! not portable, but then neither are the bytes below
        if (iachar(low) /= 1) return
        path = new_folder("npy")//"/a.npy"
        call begin(file, path, [character(9) :: "t", "theta_dot"], error)
        call assertFalse(allocated(error), "no error: the header is numpys")
        do row = 1, 12
            call file%row([1.0_dp, 2.0_dp])
        end do
        call file%finish("", error)
        if (.not. allocated(error)) call file%file%commit(error)
        call assertFalse(allocated(error), "no error: the header is numpys")
        bytes = contents(path)
        call assertEqual(147, ichar(bytes(1:1)))
        call assertEqual("NUMPY", bytes(2:6))
        call assertEqual(1, ichar(bytes(7:7)))
        call assertEqual(0, ichar(bytes(8:8)))
        length = ichar(bytes(9:9)) + 256*ichar(bytes(10:10))
        call assertEqual(0, modulo(10 + length, 64))
        call assertEqual(10 + length + 12*16, len(bytes))
        text = "{'descr': [('t', '<f8'), ('theta_dot', '<f8'), ], 'fortran_order': False, " &
               //"'shape': (12,), }"
        if (anyExceptions()) return
        call assertEqual(text, trim(bytes(11:9 + length)))
        call assertEqual(new_line("a"), bytes(10 + length:10 + length))
        call assertTrue(remove_file(path), "it was there: "//path)
    end subroutine the_header_is_numpys

    subroutine the_rows_follow()
        !! One after the other, bit for bit; none is an empty array.
        real(dp), parameter :: rows(3, 2) = reshape([0.1_dp, -0.0_dp, 1e300_dp, &
                                                     0.2_dp, 3e-320_dp, -7.0_dp], [3, 2])
        type(npy_table_t) :: file
        type(error_t), allocatable :: error
        character(:), allocatable :: path, bytes
        real(dp) :: back(6)
        integer :: count, row

        path = new_folder("npy")//"/b.npy"
        do count = 2, 0, -2
            call begin(file, path, ["x", "y", "z"], error)
            do row = 1, count
                call file%row(rows(:, row))
            end do
            call assertFalse(file%file%failed(), "not file%file%failed()")
            call file%finish("", error)
            if (.not. allocated(error)) call file%file%commit(error)
            bytes = contents(path)
            call assertEqual(0, modulo(len(bytes) - 24*count, 64))
            if (count > 0) then
                back = transfer(bytes(len(bytes) - 47:), back)
                call assertTrue(all(transfer(back, [1]) == transfer(rows, [1])), &
                                "all(transfer(back, [1]) == transfer(rows, [1]))")
            else
                call assertTrue(index(bytes, "'shape': (0,)") > 0, &
                                "index(bytes, ''shape': (0,)') > 0")
            end if
        end do
        call assertTrue(remove_file(path), "it was there: "//path)
    end subroutine the_rows_follow

    subroutine begin(file, path, names, error)
        !! Open the file and write its header.
        type(npy_table_t), intent(out) :: file
        character(*), intent(in) :: path, names(:)
        type(error_t), allocatable, intent(out) :: error

        call file%file%open(path, error)
        if (allocated(error)) return
        call file%begin([character(1) ::], names, names, error)
    end subroutine begin

    subroutine too_many_columns_are_refused()
        !! `numpy.load` takes headers of up to 10000 characters.
        type(npy_table_t) :: file
        type(error_t), allocatable :: error
        character(20) :: names(600)
        integer :: i

        do i = 1, size(names)
            write (names(i), "(a, i0)") "column_", i
        end do
        call begin(file, new_folder("npy")//"/no.npy", names, error)
        call assertTrue(allocated(error), "an error: too many columns are refused")
        if (anyExceptions()) return
        call assertEqual("600 columns are too many for numpy; --format text has no limit", &
                         error%message)
        call file%file%abandon()
    end subroutine too_many_columns_are_refused

    subroutine bytes_that_are_no_letters()
        !! A byte that begins no letter of UTF-8 stands for itself, as in Latin-1.
        type(npy_table_t) :: file
        type(error_t), allocatable :: error
        character(:), allocatable :: path, bytes

        path = new_folder("npy")//"/a.npy"
        call begin(file, path, [character(3) :: "t", "x"//char(255)], error)
        call assertFalse(allocated(error), "no error: bytes that are no letters")
        call file%row([1.0_dp, 2.0_dp])
        call file%finish("", error)
        if (.not. allocated(error)) call file%file%commit(error)
        call assertFalse(allocated(error), "no error: bytes that are no letters")
        if (anyExceptions()) return
        bytes = contents(path)
        call assertTrue(index(bytes, "('x\U000000FF', '<f8')") > 0, bytes)
        call assertTrue(remove_file(path), "it was there: "//path)
    end subroutine bytes_that_are_no_letters
end module test_npy
