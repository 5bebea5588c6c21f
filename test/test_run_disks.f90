module test_run_disks
    !! A run that cannot write stops, at the start if that can be known; one that would write over a
    !! file that it reads does not start.
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertFalse, assertTrue
    use lagrangia_command_line, only: word_t
    use lagrangia_errors, only: error_t, status_file, status_ok, status_usage
    use lagrangia_interrupt, only: catch_interrupts
    use lagrangia_outcome, only: outcome_t
    use lagrangia_output_file, only: output_file_t, refuse_unwritable
    use lagrangia_scene, only: scene_t
    use lagrangia_system, only: system_t
    use scene_runs, only: perform, read_and_plan
    use test_scratch, only: contents, exit_status, limit_file_size, new_folder, remove_file, &
        write_file
    implicit none (type, external)
    private
    public :: run_disks_suite

contains

    function run_disks_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("run_disks")
        call suite%addTest(TestMethod("a_full_disk_ends_the_run", a_full_disk_ends_the_run))
        call suite%addTest(TestMethod("a_full_disk_is_known_before", a_full_disk_is_known_before))
        call suite%addTest(TestMethod("a_folder_that_went_is_missed", &
                                      a_folder_that_went_is_missed))
        call suite%addTest(TestMethod("the_scene_is_not_written_over", &
                                      the_scene_is_not_written_over))
        call suite%addTest(TestMethod("no_name_is_cut", no_name_is_cut))
    end function run_disks_suite

    subroutine a_full_disk_ends_the_run()
        !! Soon after the first row that is lost, and not at the end of a million steps.
        call assertEqual(status_ok, exit_status(run_on_a_small_disk))
    end subroutine a_full_disk_ends_the_run

    function run_on_a_small_disk() result(status)
        !! 0 if the run ends as it should where 20,000 bytes can be written.
        integer :: status
        type(outcome_t) :: outcome
        type(error_t), allocatable :: error

        call catch_interrupts()
        call limit_file_size(20000)
        call perform("&scene system='pendulum' dt=1e-4 duration=100 every=1 q=1 output='s' /", &
                     new_folder("small"), "text", outcome, error)
        status = 1
        if (.not. allocated(error)) return
        status = 2
        if (index(error%message, "File too large") == 0) return
        status = 3
        if (outcome%steps > 1000 .or. outcome%steps < 1) return
        status = 4
        if (error%status /= status_file .or. outcome%file /= "") return
        if (remove_file(new_folder("small"))) status = status_ok
    end function run_on_a_small_disk

    subroutine a_full_disk_is_known_before()
        !! Before the first step, since the header goes to the disk; and before a benchmark.
        call assertEqual(status_ok, exit_status(run_on_a_full_disk))
        call assertEqual(status_ok, exit_status(ask_a_full_disk))
    end subroutine a_full_disk_is_known_before

    function run_on_a_full_disk() result(status)
        !! 0 if the run is refused where 20 bytes can be written.
        integer :: status
        type(outcome_t) :: outcome
        type(error_t), allocatable :: error

        call catch_interrupts()
        call limit_file_size(20)
        call perform("&scene system='pendulum' dt=0.1 duration=1 q=1 output='s' /", &
                     new_folder("none left"), "csv", outcome, error)
        status = 1
        if (allocated(error) .neqv. .true.) return
        status = 2
        if (error%status /= status_file .or. outcome%evaluations /= 0) return
        if (remove_file(new_folder("none left"))) status = status_ok
    end function run_on_a_full_disk

    function ask_a_full_disk() result(status)
        !! 0 if `refuse_unwritable` refuses where 20 bytes can be written, and leaves nothing.
        integer :: status
        type(error_t), allocatable :: error
        character(:), allocatable :: folder

        folder = new_folder("asked")
        call refuse_unwritable(folder//"/a.dat", error)
        status = 1
        if (allocated(error)) return
        call catch_interrupts()
        call limit_file_size(20)
        call refuse_unwritable(folder//"/a.dat", error)
        status = 2
        if (.not. allocated(error)) return
        status = 3
        if (error%message /= "cannot write '"//folder//"/a.dat': File too large") return
        if (remove_file(folder)) status = status_ok
    end function ask_a_full_disk

    subroutine a_folder_that_went_is_missed()
        !! As soon as the file is sent to the disk, and not when it is to get its name.
        type(output_file_t) :: file
        type(error_t), allocatable :: error
        character(:), allocatable :: folder, temporary

        folder = new_folder("went")
        call file%open(folder//"/a.dat", error)
        call file%write("text")
        call file%flush()
        call assertFalse(file%failed(), "it is there")
        temporary = file%temporary_name()
        call assertTrue(remove_file(temporary), "removed: "//temporary)
        call assertTrue(remove_file(folder), "removed: "//folder)
        call file%write("text")
        call file%flush()
        call file%report(error)
        call assertTrue(allocated(error), "it went")
        call file%abandon()
        if (anyExceptions()) return
        call assertEqual("cannot write '"//folder//"/a.dat': No such file or directory", &
                         error%message)
    end subroutine a_folder_that_went_is_missed

    subroutine the_scene_is_not_written_over()
        !! Neither by the data, nor by the events, scripts or pictures, nor by what remains of a
        !! run that fails.
        character(*), parameter :: scene = "&scene system='bouncing_ball' q=1 v=0 duration=1 "// &
            "dt=0.1 output='s.dat' /"
        character(16), parameter :: names(*) = [character(16) :: "s.dat", "s.gp", "s.png", &
            "s.svg", "s.pdf", "s.dat.partial", "s_events.dat", "s_events.gp", "s_events.png", &
            "s_events.svg", "s_events.pdf"]
        type(outcome_t) :: outcome
        type(error_t), allocatable :: error
        character(:), allocatable :: folder, path
        integer :: i

        folder = new_folder("itself")
        do i = 1, size(names)
            path = folder//"/"//trim(names(i))
            call write_file(path, scene)
            call perform(scene, folder, "text", outcome, error, source=path)
            call assertTrue(allocated(error), path)
            if (anyExceptions()) return
            call assertEqual(status_usage, error%status)
            call assertTrue(index(error%message, "the scene '"//path//"' are one file") > 0, &
                            error%message)
            call assertEqual(scene, contents(path))
            call assertTrue(remove_file(path), "removed: "//path)
        end do
        call assertTrue(remove_file(folder), "something was written")
    end subroutine the_scene_is_not_written_over

    subroutine no_name_is_cut()
        !! Of a scene that says no other output, however long the name of its file.
        class(system_t), allocatable :: system
        type(error_t), allocatable :: error
        type(scene_t) :: scene
        character(:), allocatable :: name

        name = repeat("n", 251)  ! 255 with `.nml`, the longest there is
        call read_and_plan("&scene system='pendulum' dt=0.1 duration=1 q=1 /", "a/"//name//".nml", &
                         [word_t ::], scene, system, error)
        call assertFalse(allocated(error), "a long name")
        call assertEqual(name, trim(scene%output))
        call assertEqual(name, trim(scene%name))
    end subroutine no_name_is_cut
end module test_run_disks
