module test_unfinished
    !! What becomes of temporary files: of this run, of others, of those that were killed.
    use, intrinsic :: iso_c_binding, only: c_int, c_null_char
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertTrue
    use lagrangia_c_library, only: c_chmod
    use lagrangia_errors, only: error_t
    use lagrangia_output_file, only: output_file_t
    use lagrangia_text, only: to_text
    use lagrangia_unfinished, only: remove_unfinished
    use test_scratch, only: contents, new_folder, remove_file, write_file
    implicit none (type, external)
    private
    public :: unfinished_suite

contains

    function unfinished_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("unfinished")
        call suite%addTest(TestMethod("unfinished_files_can_be_removed", &
                                      unfinished_files_can_be_removed))
        call suite%addTest(TestMethod("many_writers_do_not_mix", many_writers_do_not_mix))
        call suite%addTest(TestMethod("abandoned_temporaries_are_removed", &
                                      abandoned_temporaries_are_removed))
        call suite%addTest(TestMethod("nobody_elses_file_is_removed", nobody_elses_file_is_removed))
    end function unfinished_suite

    subroutine unfinished_files_can_be_removed()
        !! All of them at once, whoever has them open; committed ones stay.
        type(output_file_t) :: files(5)
        type(error_t), allocatable :: error
        character(:), allocatable :: folder
        integer :: i

        folder = new_folder("unfinished")
        do i = 1, size(files)
            call files(i)%open(folder//"/"//achar(iachar("a") + i), error)
        end do
        call files(2)%commit(error)
        call files(4)%abandon()
        call files(4)%open(folder//"/again", error)
        call remove_unfinished()
        call assertEqual("", contents(folder//"/c"))
        call assertTrue(remove_file(folder//"/c"), "it was there: "//folder//"/c")
        call assertTrue(remove_file(folder), "a temporary was left")
        call files(1)%commit(error)
        call assertTrue(allocated(error), "an error: unfinished files can be removed")
        do i = 1, size(files)
            call files(i)%abandon()
        end do
    end subroutine unfinished_files_can_be_removed

    subroutine many_writers_do_not_mix()
        !! More than anybody looks for among the abandoned; each has a temporary of its own.
        type(output_file_t) :: files(12)
        type(error_t), allocatable :: error
        character(:), allocatable :: folder
        integer :: i

        folder = new_folder("many")
        do i = 1, size(files)
            call files(i)%open(folder//"/a.dat", error)
            call files(i)%write(repeat("x", i))
        end do
        do i = size(files), 1, -1
            call files(i)%commit(error)
            call assertFalse(allocated(error), "no error: many writers do not mix")
            call assertEqual(repeat("x", i), contents(folder//"/a.dat"))
        end do
        call assertTrue(remove_file(folder//"/a.dat"), "it was there: "//folder//"/a.dat")
        call assertTrue(remove_file(folder), "a temporary was left")
    end subroutine many_writers_do_not_mix

    subroutine abandoned_temporaries_are_removed()
        !! Nobody locks them: the run that wrote them was killed. Also when there are gaps between
        !! them, but not those of another name, nor those of a run that goes on.
        type(output_file_t) :: file, running
        type(error_t), allocatable :: error
        character(:), allocatable :: folder, long
        integer :: i

        folder = new_folder("abandoned")
        long = repeat("n", 255)
        call running%open(folder//"/a.dat", error)
        call running%write("running")
        do i = 2, 8, 3
            call plant(folder//"/.lagrangia-a.dat-"//to_text(i)//".tmp")
        end do
        call plant(folder//"/.lagrangia-b.dat-1.tmp")
        call plant(folder//"/.lagrangia-"//long(:100)//"-1.tmp")
        call write_file(folder//"/.lagrangia-a.dat-3.tmp", "a user's")
        call file%open(folder//"/a.dat", error)
        call file%write("new")
        call file%commit(error)
        call assertEqual("new", contents(folder//"/a.dat"))
        call running%commit(error)
        call assertEqual("running", contents(folder//"/a.dat"))
        call file%open(folder//"/"//long, error)
        call file%commit(error)
        call assertTrue(remove_file(folder//"/a.dat"), "it was there: "//folder//"/a.dat")
        call assertTrue(remove_file(folder//"/"//long), "it was there: "//folder//"/"//long)
        call assertTrue(remove_file(folder//"/.lagrangia-b.dat-1.tmp"), "another name's was taken")
        call assertEqual("a user's", contents(folder//"/.lagrangia-a.dat-3.tmp"), "no mark of ours")
        call assertTrue(remove_file(folder//"/.lagrangia-a.dat-3.tmp"), "a user's own")
        call assertTrue(remove_file(folder), "a temporary was left")
    end subroutine abandoned_temporaries_are_removed

    subroutine plant(name)
        !! A file as a run leaves it that is killed, with the mark of a temporary.
        character(*), intent(in) :: name
        integer :: status

        call write_file(name, "old")
        status = int(c_chmod(name//c_null_char, int(o"1644", c_int)))
        call assertEqual(0, status, "chmod "//name)
    end subroutine plant

    subroutine nobody_elses_file_is_removed()
        !! Once ours is committed or abandoned, its temporary name may be another run's.
        type(output_file_t) :: file
        type(error_t), allocatable :: error
        character(:), allocatable :: folder, temporary

        folder = new_folder("another")
        temporary = folder//"/.lagrangia-a.dat-1.tmp"
        call file%open(folder//"/a.dat", error)
        call file%commit(error)
        call assertFalse(allocated(error), "no error: nobody elses file is removed")
        call write_file(temporary, "another's")
        call file%abandon()
        call remove_unfinished()
        call assertEqual("another's", contents(temporary))
        call assertTrue(remove_file(temporary), "it was there: "//temporary)
        call assertTrue(remove_file(folder//"/a.dat"), "it was there: "//folder//"/a.dat")
        call assertTrue(remove_file(folder), "it was there: "//folder)
    end subroutine nobody_elses_file_is_removed
end module test_unfinished
