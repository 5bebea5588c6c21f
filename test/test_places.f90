module test_places
    !! Names of one file are known as such, whatever they look like; others are not mixed up.
    use, intrinsic :: iso_c_binding, only: c_null_char
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertFalse, assertTrue
    use lagrangia_disk_space, only: free_space, space_warning
    use lagrangia_errors, only: error_t, status_usage
    use lagrangia_files, only: facts_t, look_at
    use lagrangia_kinds, only: dp
    use lagrangia_places, only: places_t
    use lagrangia_text, only: to_text
    use test_scratch, only: c_link, c_symlink, new_folder, remove_file, write_file
    implicit none (type, external)
    private
    public :: places_suite

contains

    function places_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("places")
        call suite%addTest(TestMethod("names_of_one_file_collide", names_of_one_file_collide))
        call suite%addTest(TestMethod("names_of_two_files_do_not", names_of_two_files_do_not))
        call suite%addTest(TestMethod("a_collision_names_both", a_collision_names_both))
        call suite%addTest(TestMethod("no_place_of_many_is_forgotten", &
                                      no_place_of_many_is_forgotten))
        call suite%addTest(TestMethod("much_is_announced", much_is_announced))
    end function places_suite

    subroutine names_of_one_file_collide()
        !! Of a file that exists, and of one that is to be made, perhaps with its folders.
        character(:), allocatable :: folder, inner

        folder = new_folder("one")
        inner = new_folder("one/inner")
        call write_file(folder//"/old", "old")
        call assertTrue(c_link(folder//"/old"//c_null_char, folder//"/hard"//c_null_char) == 0, &
                        "linked")
        call assertTrue(c_symlink("old"//c_null_char, folder//"/soft"//c_null_char) == 0, "linked")
        call assertTrue(c_symlink("inner"//c_null_char, folder//"/way"//c_null_char) == 0, "linked")
        call assertTrue(collide(folder//"/old", folder//"/old"), "the same")
        call assertTrue(collide(folder//"/old", folder//"/hard"), "a hard link")
        call assertTrue(collide(folder//"/soft", folder//"/old"), "a symbolic link")
        call assertTrue(collide(folder//"/new", folder//"/new"), "the same, new")
        call assertTrue(collide(folder//"/new", folder//"/.//./new"), "dots and slashes")
        call assertTrue(collide(folder//"/new", folder//"/inner/../new"), "up, from a folder")
        call assertTrue(collide(folder//"/new", folder//"/none/../new"), "up, from a new folder")
        call assertTrue(collide(folder//"/new", folder//"/a/b/../../new"), "up, twice")
        call assertTrue(collide(folder//"/a/b/new", folder//"/a/./c/../b//new"), "new folders")
        call assertTrue(collide(inner//"/new", folder//"/way/new"), "a link to the folder")
        call assertTrue(collide(inner//"/a/new", folder//"/way/a/new"), "a folder below it")
        call assertTrue(collide("new", "./new"), "here")
        call assertTrue(collide("/new", "//new"), "the root")
        call assertTrue(remove_file(folder//"/old"), "removed: "//folder//"/old")
        call assertTrue(remove_file(folder//"/hard"), "removed: "//folder//"/hard")
        call assertTrue(remove_file(folder//"/soft"), "removed: "//folder//"/soft")
        call assertTrue(remove_file(folder//"/way"), "removed: "//folder//"/way")
        call assertTrue(remove_file(inner), "removed: "//inner)
        call assertTrue(remove_file(folder), "asking makes nothing")
    end subroutine names_of_one_file_collide

    subroutine names_of_two_files_do_not()
        !! Nothing is cut, no blank is lost, and capitals count.
        character(:), allocatable :: folder, long

        folder = new_folder("two")
        long = folder//"/"//repeat("n", 200)
        call write_file(folder//"/old", "old")
        call write_file(folder//"/other", "old")
        call assertFalse(collide(folder//"/old", folder//"/other"), "two files")
        call assertFalse(collide(folder//"/old", folder//"/new"), "one of them new")
        call assertFalse(collide(folder//"/new", folder//"/NEW"), "capitals")
        call assertFalse(collide(folder//"/new", folder//"/new "), "a blank at the end")
        call assertFalse(collide(folder//"/new", folder//"/a/new"), "another folder")
        call assertFalse(collide(folder//"/a/new", folder//"/b/new"), "two new folders")
        call assertFalse(collide(folder//"/a/new", folder//"/a/../new"), "up")
        call assertFalse(collide(long//"1", long//"2"), "long names")
        ! the first folder of each of two file systems often has the same inode
        call assertFalse(collide("/proc/new", "/sys/new"), "two file systems")
        call assertTrue(remove_file(folder//"/old"), "removed: "//folder//"/old")
        call assertTrue(remove_file(folder//"/other"), "removed: "//folder//"/other")
        call assertTrue(remove_file(folder), "removed: "//folder)
    end subroutine names_of_two_files_do_not

    function collide(first, second)
        !! Whether the second is refused after the first.
        character(*), intent(in) :: first, second
        logical :: collide
        type(error_t), allocatable :: error
        type(places_t) :: places

        call places%add(first, "first", "", error)
        call assertFalse(allocated(error), first)
        call places%add(second, "second", "", error)
        collide = allocated(error)
    end function collide

    subroutine a_collision_names_both()
        !! What they are, and whose.
        type(error_t), allocatable :: error
        type(places_t) :: places

        call places%add("x.nml", "scene", "", error)
        call places%add("./x.nml", "data file", "y", error)
        call assertTrue(allocated(error), "it is refused")
        if (anyExceptions()) return
        call assertEqual(status_usage, error%status)
        call assertEqual("the data file './x.nml' of y and the scene 'x.nml' are one file: one "// &
                         "would be lost; another '--output' or output keeps them apart", &
                         error%message)
    end subroutine a_collision_names_both

    subroutine no_place_of_many_is_forgotten()
        !! Each of a hundred is refused when it comes again, and the list is not spoiled by it.
        type(error_t), allocatable :: error
        type(places_t) :: places
        integer :: i

        do i = 1, 100
            call places%add("x/"//to_text(i), "file", "", error)
            call assertFalse(allocated(error), to_text(i))
        end do
        do i = 1, 100
            call places%add("x/"//to_text(i), "file", "", error)
            call assertTrue(allocated(error), to_text(i))
        end do
    end subroutine no_place_of_many_is_forgotten

    subroutine much_is_announced()
        !! A gigabyte and more, and what there is no room for; other things are not. On Linux the
        !! free space is known, also of a folder that is not there yet.
        type(facts_t) :: linux
        real(dp) :: free

        call assertEqual("", space_warning(1e3_dp, "."), "a kilobyte")
        call assertEqual(1, index(space_warning(1e30_dp, "."), "up to 1"), "very much")
        linux = look_at("/proc/self/exe")
        if (.not. linux%found) return
        free = free_space(".")
        call assertTrue(free > 0.0_dp, "the disk of the tests is full")
        call assertEqual(free, free_space("./none/of/these"), 0.5_dp*free, "a folder to come")
        call assertTrue(free_space("/proc") <= 0.0_dp, "no room for anything in /proc")
        call assertEqual("", space_warning(1e3_dp, "/proc/none"), "no room at all is an error")
        call assertEqual(1, index(space_warning(999.95e9_dp, "/proc"), "up to 1.0 TB "), &
                         "1000.0 GB")
        call assertEqual(1, index(space_warning(999.94e9_dp, "/proc"), "up to 999.9 GB "), "less")
        call assertTrue(index(space_warning(2.0_dp*free, "."), " are to be written, but only ") &
                        > 0, "twice as much as there is room for")
        if (free > 2e9_dp) call assertEqual(1, index(space_warning(1.25e9_dp, "."), &
            "up to 1.2 GB are to be written in '.', where "), space_warning(1.25e9_dp, "."))
    end subroutine much_is_announced
end module test_places
