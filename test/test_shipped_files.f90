module test_shipped_files
    !! What the program carries with it is what `data/` holds.
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertTrue
    use lagrangia_errors, only: error_t, status_file, status_usage
    use lagrangia_files, only: read_whole_file
    use lagrangia_shipped, only: find_scene, named_scenes, scene_name, shipped_scenes
    use lagrangia_shipped_files, only: read_file_or_shipped, shipped_files, shipped_text
    use lagrangia_text, only: word_t
    implicit none (type, external)
    private
    public :: shipped_files_suite

contains

    function shipped_files_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("shipped_files")
        call suite%addTest(TestMethod("each_is_the_file_of_data", each_is_the_file_of_data))
        call suite%addTest(TestMethod("what_is_not_carried", what_is_not_carried))
        call suite%addTest(TestMethod("scenes_by_name", scenes_by_name))
        call suite%addTest(TestMethod("names_with_dots", names_with_dots))
    end function shipped_files_suite

    subroutine each_is_the_file_of_data()
        !! Byte for byte; and every scene of the folder is among them.
        type(word_t), allocatable :: paths(:), scenes(:)
        character(:), allocatable :: text, file
        type(error_t), allocatable :: error
        integer :: i

        call shipped_files("data/", paths)
        do i = 1, size(paths)
            call shipped_text(paths(i)%text, text)
            call assertTrue(allocated(text), paths(i)%text)
            call read_whole_file(paths(i)%text, file, error)
            call assertFalse(allocated(error), paths(i)%text)
            if (allocated(error)) return
            call assertEqual(len(file), len(text), "bash .ci/embed.sh: length of "//paths(i)%text)
            call assertTrue(text == file, "bash .ci/embed.sh: "//paths(i)%text)
        end do
        call shipped_files("data/scenes/", paths)
        call shipped_scenes(scenes)
        call assertEqual(size(scenes), size(paths), "bash .ci/embed.sh: number of scenes")
        call named_scenes(scenes)
        call assertEqual(size(scenes), size(paths), "no scene has two places")
    end subroutine each_is_the_file_of_data

    subroutine names_with_dots()
        !! Only the last ending goes; a name that is but an ending stays.
        call assertEqual("l_1.5", scene_name("a.b/l_1.5.nml"), "a number in the name")
        call assertEqual("swing", scene_name("../swing.nml"), "a folder above")
        call assertEqual(".nml", scene_name("a/.nml"), "an ending alone")
    end subroutine names_with_dots

    subroutine what_is_not_carried()
        !! A beginning of a path, blanks behind it or another folder are no file.
        type(word_t), allocatable :: paths(:)
        character(:), allocatable :: text
        type(error_t), allocatable :: error

        call shipped_text("data/scenes/pendulum.nm", text)
        call assertFalse(allocated(text), "a letter less")
        call shipped_text("data/scenes/pendulum.nml ", text)
        call assertFalse(allocated(text), "a blank more")
        call shipped_files("scenes/", paths)
        call assertEqual(0, size(paths), "a folder is a beginning of the path")
        call read_file_or_shipped("data/scenes/none.nml", text, error)
        call assertTrue(allocated(error), "no such file")
        if (allocated(error)) call assertEqual("data/scenes/none.nml: no such file", error%message)
    end subroutine what_is_not_carried

    subroutine scenes_by_name()
        !! A name finds a scene, a path a file only.
        character(:), allocatable :: path
        type(error_t), allocatable :: error

        call find_scene("pendulum", path, error)
        call assertFalse(allocated(error), "pendulum is a scene")
        if (.not. allocated(error)) call assertEqual("data/scenes/pendulum.nml", path)
        call find_scene("pendlum", path, error)
        call assertTrue(allocated(error), "pendlum is none")
        if (allocated(error)) call assertEqual(status_usage, error%status, error%message)
        call find_scene("elsewhere/pendulum.nml", path, error)
        call assertTrue(allocated(error), "a path is not a name")
        if (allocated(error)) call assertEqual(status_file, error%status, error%message)
    end subroutine scenes_by_name
end module test_shipped_files
