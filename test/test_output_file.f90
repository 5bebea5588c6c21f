module test_output_file
    !! A file is complete or absent, and an existing one survives.
    use, intrinsic :: iso_c_binding, only: c_int, c_null_char
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertTrue
    use lagrangia_c_library, only: c_chmod
    use lagrangia_data_files, only: data_path, new_table, script_path
    use lagrangia_errors, only: error_t
    use lagrangia_files, only: facts_t, look_at, plain_path, same_file
    use lagrangia_kinds, only: dp, i8
    use lagrangia_output_file, only: output_file_t
    use lagrangia_places, only: places_t
    use lagrangia_scene_claims, only: claim_table
    use lagrangia_table, only: table_t
    use test_scratch, only: c_link, c_symlink, contents, new_folder, remove_file, write_file
    implicit none (type, external)
    private
    public :: output_file_suite

    character(*), parameter :: odd_name = " a 'b' ""c"" $(d);*\ "  !! ends with a blank

contains

    function output_file_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("output_file")
        call suite%addTest(TestMethod("commit_gives_the_file_its_name", &
                                      commit_gives_the_file_its_name))
        call suite%addTest(TestMethod("missing_folders_are_made", missing_folders_are_made))
        call suite%addTest(TestMethod("abandon_leaves_no_trace", abandon_leaves_no_trace))
        call suite%addTest(TestMethod("rewrite_replaces_in_place", rewrite_replaces_in_place))
        call suite%addTest(TestMethod("reals_are_written_as_in_memory", &
                                      reals_are_written_as_in_memory))
        call suite%addTest(TestMethod("links_and_permissions_stay", links_and_permissions_stay))
        call suite%addTest(TestMethod("two_writers_do_not_mix", two_writers_do_not_mix))
        call suite%addTest(TestMethod("same_file_sees_through_names", &
                                      same_file_sees_through_names))
        call suite%addTest(TestMethod("a_row_reaches_the_disk", a_row_reaches_the_disk))
        call suite%addTest(TestMethod("a_name_means_nothing_to_others", &
                                      a_name_means_nothing_to_others))
        call suite%addTest(TestMethod("paths_are_put_together", paths_are_put_together))
        call suite%addTest(TestMethod("a_scene_of_somebody_is_kept", a_scene_of_somebody_is_kept))
    end function output_file_suite

    subroutine commit_gives_the_file_its_name()
        !! Until then the old file stays as it was; afterwards only the new one is there.
        type(output_file_t) :: file
        type(error_t), allocatable :: error
        character(:), allocatable :: folder

        folder = new_folder("commit")
        call write_file(folder//"/a.dat", "old")
        call file%open(folder//"/a.dat", error)
        call assertFalse(allocated(error), "no error: commit gives the file its name")
        call file%write("new")
        call file%write(new_line("a")//"text")
        call assertEqual(8, int(file%position()))
        call assertEqual("old", contents(folder//"/a.dat"))
        call file%commit(error)
        call assertFalse(allocated(error), "no error: commit gives the file its name")
        call assertEqual("new"//new_line("a")//"text", contents(folder//"/a.dat"))
        call assertTrue(remove_file(folder//"/a.dat"), "it was there: "//folder//"/a.dat")
        call assertTrue(remove_file(folder), "something else was left in the folder")
    end subroutine commit_gives_the_file_its_name

    subroutine a_row_reaches_the_disk()
        !! The first at once, in every format: no second has passed since the last that was sent.
        character(4), parameter :: formats(3) = ["text", "csv ", "npy "]
        class(table_t), allocatable :: table
        type(error_t), allocatable :: error
        type(facts_t) :: facts
        character(:), allocatable :: folder
        integer(i8) :: before
        integer :: i

        folder = new_folder("rows")
        do i = 1, size(formats)
            call new_table(trim(formats(i)), table)
            call table%file%open(folder//"/a", error)
            call table%begin(["title"], ["t", "x"], ["s", "m"], error)
            call table%send_header(error)
            call assertFalse(allocated(error), formats(i))
            before = len(contents(table%file%temporary_name()))
            call table%add_row([1.5_dp, -2.5_dp], error)
            call assertFalse(allocated(error), formats(i))
            facts = look_at(table%file%temporary_name())
            call assertTrue(facts%found, "it is being written")
            call assertTrue(len(contents(table%file%temporary_name())) > before, formats(i))
            call table%file%abandon()
        end do
        call assertTrue(remove_file(folder), "a temporary was left")
    end subroutine a_row_reaches_the_disk

    subroutine a_name_means_nothing_to_others()
        !! What gnuplot would run, or a program take for an option, stands behind `./`.
        call assertEqual("./<touch x", plain_path("<touch x"))
        call assertEqual("./|touch x", plain_path("|touch x"))
        call assertEqual("./-x", plain_path("-x"))
        call assertEqual("./a/b", plain_path("a/b"))
        call assertEqual("/a/b ", plain_path("/a/b "), "a whole path, and its blank")
        call assertEqual("./", plain_path(""))
    end subroutine a_name_means_nothing_to_others

    subroutine missing_folders_are_made()
        !! As `mkdir -p` does; no character of a name means anything but itself. Who may read
        !! the file is decided as for any other new file.
        type(output_file_t) :: file
        type(error_t), allocatable :: error
        type(facts_t) :: facts
        character(:), allocatable :: folder
        integer :: permissions

        folder = new_folder("folders")
        call file%open(folder//"/x//"//odd_name//"/"//odd_name, error)
        call assertFalse(allocated(error), "no error: missing folders are made")
        call file%commit(error)
        call assertFalse(allocated(error), "no error: missing folders are made")
        call write_file(folder//"/plain", "")
        facts = look_at(folder//"/plain")
        permissions = facts%permissions
        facts = look_at(folder//"/x/"//odd_name//"/"//odd_name)
        call assertEqual(permissions, facts%permissions)
        call assertTrue(remove_file(folder//"/plain"), "it was there: "//folder//"/plain")
        call assertTrue(remove_file(folder//"/x/"//odd_name//"/"//odd_name), &
                        "it was there: "//folder//"/x/"//odd_name//"/"//odd_name)
        call assertTrue(remove_file(folder//"/x/"//odd_name), &
                        "it was there: "//folder//"/x/"//odd_name)
        call assertTrue(remove_file(folder//"/x"), "it was there: "//folder//"/x")
        call assertTrue(remove_file(folder), "it was there: "//folder)
    end subroutine missing_folders_are_made

    subroutine abandon_leaves_no_trace()
        !! Neither a new file nor a temporary; also when `open` is called again instead.
        type(output_file_t) :: file
        type(error_t), allocatable :: error
        character(:), allocatable :: folder

        folder = new_folder("abandon")
        call file%open(folder//"/a.dat", error)
        call file%write("text")
        call assertFalse(remove_file(folder), "no temporary while a file is written")
        call file%open(folder//"/b.dat", error)
        call file%abandon()
        call file%abandon()
        call assertTrue(remove_file(folder), "something was left in the folder")
    end subroutine abandon_leaves_no_trace

    subroutine rewrite_replaces_in_place()
        !! And what is written next goes to the end.
        type(output_file_t) :: file
        type(error_t), allocatable :: error
        character(:), allocatable :: path

        path = new_folder("rewrite")//"/a.dat"
        call file%open(path, error)
        call file%write("rows: ?? end")
        call file%rewrite(6_i8, "42")
        call file%write(".")
        call file%rewrite(0_i8, "R")
        call file%rewrite(12_i8, "!")
        call file%commit(error)
        call assertFalse(allocated(error), "no error: rewrite replaces in place")
        call assertEqual("Rows: 42 end!", contents(path))
        call assertTrue(remove_file(path), "it was there: "//path)
    end subroutine rewrite_replaces_in_place

    subroutine reals_are_written_as_in_memory()
        !! Eight bytes each.
        type(output_file_t) :: file
        type(error_t), allocatable :: error
        character(:), allocatable :: path
        character(24) :: bytes
        real(dp), parameter :: values(3) = [1.0_dp/3.0_dp, -0.0_dp, 1e-310_dp]

        path = new_folder("reals")//"/a.bin"
        call file%open(path, error)
        call file%write_reals(values)
        call assertEqual(24, int(file%position()))
        call file%commit(error)
        bytes = transfer(values, bytes)
        call assertTrue(contents(path) == bytes, "contents(path) == bytes")
        call assertTrue(remove_file(path), "it was there: "//path)
    end subroutine reals_are_written_as_in_memory

    subroutine links_and_permissions_stay()
        !! Writing to a symbolic link replaces the file it leads to, which keeps its permissions.
        type(output_file_t) :: file
        type(error_t), allocatable :: error
        type(facts_t) :: facts
        character(:), allocatable :: folder

        folder = new_folder("links")
        call write_file(folder//"/file", "old")
        call assertTrue(c_chmod(folder//"/file"//c_null_char, int(o"640", c_int)) == 0, &
                        "c_chmod(folder//'/file', int(o'640', c_int)) == 0")
        call assertTrue(c_symlink("file"//c_null_char, folder//"/link"//c_null_char) == 0, &
                        "c_symlink('file', folder//'/link') == 0")
        call file%open(folder//"/link", error)
        call file%write("new")
        call file%commit(error)
        call assertFalse(allocated(error), "no error: links and permissions stay")
        facts = look_at(folder//"/link", follow=.false.)
        call assertTrue(facts%link, "facts%link")
        call assertEqual("new", contents(folder//"/file"))
        facts = look_at(folder//"/file")
        call assertEqual(int(o"640"), facts%permissions)
        call assertTrue(remove_file(folder//"/link"), "it was there: "//folder//"/link")
        call assertTrue(remove_file(folder//"/file"), "it was there: "//folder//"/file")
        call assertTrue(remove_file(folder), "it was there: "//folder)
    end subroutine links_and_permissions_stay

    subroutine two_writers_do_not_mix()
        !! Of one name: the last to commit wins, and its file is its own.
        type(output_file_t) :: one, two
        type(error_t), allocatable :: error
        character(:), allocatable :: folder

        folder = new_folder("two")
        call one%open(folder//"/a.dat", error)
        call two%open(folder//"/a.dat", error)
        call assertFalse(allocated(error), "no error: two writers do not mix")
        call one%write("one")
        call two%write("two two")
        call one%write(" one")
        call two%commit(error)
        call assertEqual("two two", contents(folder//"/a.dat"))
        call one%commit(error)
        call assertEqual("one one", contents(folder//"/a.dat"))
        call assertTrue(remove_file(folder//"/a.dat"), "it was there: "//folder//"/a.dat")
        call assertTrue(remove_file(folder), "it was there: "//folder)
    end subroutine two_writers_do_not_mix

    subroutine same_file_sees_through_names()
        !! Hard links, symbolic links, another spelling; not what does not exist.
        character(:), allocatable :: folder

        folder = new_folder("same")
        call write_file(folder//"/a", "text")
        call write_file(folder//"/b", "text")
        call assertTrue(c_link(folder//"/a"//c_null_char, folder//"/hard"//c_null_char) == 0, &
                        "c_link(folder//'/a', folder//'/hard') == 0")
        call assertTrue(c_symlink("a"//c_null_char, folder//"/soft"//c_null_char) == 0, &
                        "c_symlink('a', folder//'/soft') == 0")
        call assertTrue(same_file(folder//"/a", folder//"/hard"), &
                        "same_file(folder//'/a', folder//'/hard')")
        call assertTrue(same_file(folder//"/a", folder//"/soft"), &
                        "same_file(folder//'/a', folder//'/soft')")
        call assertTrue(same_file(folder//"/a", folder//"/../same/./a"), &
                        "same_file(folder//'/a', folder//'/../same/./a')")
        call assertFalse(same_file(folder//"/a", folder//"/b"), &
                         "not same_file(folder//'/a', folder//'/b')")
        call assertFalse(same_file(folder//"/a", folder//"/none"), &
                         "not same_file(folder//'/a', folder//'/none')")
        call assertFalse(same_file(folder//"/none", folder//"/none"), &
                         "not same_file(folder//'/none', folder//'/none')")
        call assertTrue(remove_file(folder//"/a"), "it was there: "//folder//"/a")
        call assertTrue(remove_file(folder//"/b"), "it was there: "//folder//"/b")
        call assertTrue(remove_file(folder//"/hard"), "it was there: "//folder//"/hard")
        call assertTrue(remove_file(folder//"/soft"), "it was there: "//folder//"/soft")
        call assertTrue(remove_file(folder), "it was there: "//folder)
    end subroutine same_file_sees_through_names

    subroutine paths_are_put_together()
        !! No slash twice; the dot of a folder is no ending of the file in it.
        call assertEqual("a/b.dat", data_path("a/", "b", "text"))
        call assertEqual("a/b.dat", data_path("a", "b", "text"))
        call assertEqual("a/b.txt", data_path("a/", "b.txt", "csv"))
        call assertEqual("a.b/c.gp", script_path("a.b/c"))
        call assertEqual("a.dat/c.gp", script_path("a.dat/c"))
        call assertEqual("c.gp", script_path("c"))
        call assertEqual("a.b/c.gp", script_path("a.b/c.dat"))
    end subroutine paths_are_put_together

    subroutine a_scene_of_somebody_is_kept()
        !! The scene is written beside a csv file; what lies there is replaced only if it is ours.
        character(:), allocatable :: path

        path = new_folder("kept")//"/kept.csv"
        call claim("! lagrangia 1.0: a scene", .false.)
        call claim("&scene system = 'pendulum' /", .true.)
    contains
        subroutine claim(first, refused)
            character(*), intent(in) :: first  !! line of the file that is there
            logical, intent(in) :: refused
            type(places_t) :: places
            type(error_t), allocatable :: error

            call write_file(path//".nml", first//new_line("a"))
            call claim_table(path, "data", "pendulum", places, error)
            call assertTrue(allocated(error) .eqv. refused, first)
            call assertTrue(remove_file(path//".nml"), "it was there: "//path//".nml")
        end subroutine claim
    end subroutine a_scene_of_somebody_is_kept
end module test_output_file
