module test_npy
    !! NumPy's format, byte by byte.
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertFalse, assertTrue
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp
    use lagrangia_npy, only: npy_file_t
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
        call suite%addTest(TestMethod("impossible_names_are_refused", &
                                      impossible_names_are_refused))
        call suite%addTest(TestMethod("too_many_columns_are_refused", &
                                      too_many_columns_are_refused))
    end function npy_suite

    subroutine the_header_is_numpys()
        !! Format 1.0 of `numpy.lib.format`; the length is that of the header, and it is aligned.
        type(npy_file_t) :: file
        type(error_t), allocatable :: error
        character(:), allocatable :: path, bytes, text
        character(1) :: low
        integer :: length, row

        low = transfer(1, low)  ! not portable, but then neither are the bytes below
        if (iachar(low) /= 1) return
        path = new_folder("npy")//"/a.npy"
        call file%open(path, [character(9) :: "t", "theta_dot"], error)
        call assertFalse(allocated(error))
        do row = 1, 12
            call file%write_row([1.0_dp, 2.0_dp])
        end do
        call file%commit(error)
        call assertFalse(allocated(error))
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
        call assertTrue(remove_file(path))
    end subroutine the_header_is_numpys

    subroutine the_rows_follow()
        !! One after the other, bit for bit; none is an empty array.
        real(dp), parameter :: rows(3, 2) = reshape([0.1_dp, -0.0_dp, 1e300_dp, &
                                                     0.2_dp, 3e-320_dp, -7.0_dp], [3, 2])
        type(npy_file_t) :: file
        type(error_t), allocatable :: error
        character(:), allocatable :: path, bytes
        real(dp) :: back(6)
        integer :: count, row

        path = new_folder("npy")//"/b.npy"
        do count = 2, 0, -2
            call file%open(path, ["x", "y", "z"], error)
            do row = 1, count
                call file%write_row(rows(:, row))
            end do
            call assertFalse(file%failed())
            call file%commit(error)
            bytes = contents(path)
            call assertEqual(0, modulo(len(bytes) - 24*count, 64))
            if (count > 0) then
                back = transfer(bytes(len(bytes) - 47:), back)
                call assertTrue(all(transfer(back, [1]) == transfer(rows, [1])))
            else
                call assertTrue(index(bytes, "'shape': (0,)") > 0)
            end if
        end do
        call assertTrue(remove_file(path))
    end subroutine the_rows_follow

    subroutine impossible_names_are_refused()
        !! Before the file is touched: numpy could not read it.
        call refused([character(4) :: "t", "x", "t"], "column 't' occurs twice")
        call refused([character(4) :: "t", "a'b"], "column 'a'b' cannot be named so in a .npy file")
        call refused([character(4) :: ""], "column '' cannot be named so in a .npy file")
        call refused([character(4) :: "a b"], "column 'a b' cannot be named so in a .npy file")
    end subroutine impossible_names_are_refused

    subroutine too_many_columns_are_refused()
        !! `numpy.load` takes headers of up to 10000 characters.
        character(20) :: names(600)
        integer :: i

        do i = 1, size(names)
            write (names(i), "(a, i0)") "column_", i
        end do
        call refused(names, "too many columns for numpy: 'build/no.npy'")
    end subroutine too_many_columns_are_refused

    subroutine refused(names, message)
        !! Assert that `open` refuses these columns in these words.
        character(*), intent(in) :: names(:), message
        type(npy_file_t) :: file
        type(error_t), allocatable :: error

        call file%open("build/no.npy", names, error)
        call assertTrue(allocated(error), message)
        if (allocated(error)) call assertEqual(message, error%message)
        call assertEqual("(no file)", contents("build/no.npy"))
        call file%abandon()
    end subroutine refused
end module test_npy
