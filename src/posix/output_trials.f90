module lagrangia_output_trials
    !! Beside the files themselves: whether one could be written, and what a run that failed left.
    use, intrinsic :: iso_c_binding, only: c_null_char
    use lagrangia_c_library, only: c_remove
    use lagrangia_errors, only: error_t
    use lagrangia_files, only: facts_t, look_at, resolved
    use lagrangia_output_file, only: output_file_t, partial_ending
    implicit none (type, external)
    private
    public :: refuse_unwritable, remove_partial

contains

    subroutine refuse_unwritable(path, error)
        !! Fails where a small file called `path` could not be written now: to be asked before a
        !! long computation whose result goes there. Makes the folders that are missing.
        character(*), intent(in) :: path
        type(error_t), allocatable, intent(out) :: error
        integer, parameter :: small = 16384  !! bytes
        type(output_file_t) :: file

        call file%open(path, error)
        if (allocated(error)) return
        call file%write(repeat(" ", small))
        call file%flush()
        call file%report(error)
        call file%abandon()
    end subroutine refuse_unwritable

    subroutine remove_partial(path)
        !! Remove `path.partial`, if an earlier run that failed has left it.
        character(*), intent(in) :: path
        type(facts_t) :: facts
        character(:), allocatable :: place
        integer :: status

        facts = look_at(path, follow=.false.)
        place = path
        if (facts%link) place = resolved(path)
        place = place//partial_ending
        facts = look_at(place, follow=.false.)
        if (facts%regular) status = int(c_remove(place//c_null_char))
    end subroutine remove_partial
end module lagrangia_output_trials
