module lagrangia_output_file
    !! Files that are complete or absent: written beside their place, then renamed into it.
    !!
    !! All goes through C's `fwrite`: libgfortran reports no full disk and no broken pipe.
    use, intrinsic :: iso_c_binding, only: c_associated, c_int, c_long, c_null_char, c_null_ptr, &
        c_ptr, c_size_t
    use lagrangia_c_library, only: c_access, c_chmod, c_close, c_dup, c_fclose, c_fflush, &
        c_fileno, c_fseek, c_fwrite, c_fwrite_reals, c_remove, c_rename
    use lagrangia_errors, only: error_t, fail, status_file
    use lagrangia_files, only: e_bad_unit, e_exists, e_invalid, e_missing, facts_t, folder_of, &
        hold_standard_units, last_error, look_at, make_folders, plain_path, reason, resolved
    use lagrangia_kinds, only: dp, i8
    use lagrangia_text, only: to_text
    use lagrangia_unfinished, only: create, forget, remove_abandoned
    implicit none (type, external)
    private
    public :: commit_both, output_file_t, partial_ending, refuse_unwritable, remove_partial

    character(*), parameter :: partial_ending = ".partial"  !! of what a run wrote that failed

    type :: output_file_t
        !! `open`, any number of `write`, then `commit` or `abandon`. Writing never fails aloud:
        !! the first failure is remembered, and `commit` reports it.
        private
        character(:), allocatable :: path       !! as the user wrote it
        character(:), allocatable :: place      !! the same after symbolic links
        character(:), allocatable :: temporary  !! where the bytes go until `commit`
        type(c_ptr) :: stream = c_null_ptr      !! C's `FILE *`; null when not open
        integer(i8) :: bytes = 0                !! written so far
        integer :: failure = 0                  !! the system's number of the first failure
        integer :: permissions = -1             !! of the file to be replaced, or of a new one
        logical, public :: partial = .false.    !! `commit` is to call it `NAME.partial`
    contains
        procedure :: open => open_file
        procedure :: write => write_text
        procedure :: write_reals
        procedure :: rewrite
        procedure :: flush => flush_file
        procedure :: failed
        procedure :: report
        procedure :: position
        procedure :: name => final_name
        procedure :: temporary_name
        procedure :: complete
        procedure :: is_open
        procedure :: commit
        procedure :: abandon
    end type output_file_t

contains

    subroutine open_file(self, path, error)
        !! Begin a file that will be called `path`; makes the folders that are missing.
        !!
        !! Fails if `path` is a folder, a device or a pipe, or may not be written.
        class(output_file_t), intent(inout) :: self
        character(*), intent(in) :: path                  !! of the file; every blank counts
        type(error_t), allocatable, intent(out) :: error  !! status 5: why it cannot be written
        type(facts_t) :: facts
        character(:), allocatable :: culprit
        integer :: number

        call self%abandon()
        call hold_standard_units()
        self%path = path
        self%place = path
        self%bytes = 0
        self%failure = 0
        self%permissions = -1
        self%partial = .false.
        if (path == "" .or. index(path, c_null_char) > 0) then
            call refuse(error, path, "not a file name")
            return
        end if
        facts = look_at(path)
        if (facts%folder .or. path(len(path):) == "/") then
            call refuse(error, path, "it is a folder")
        else if (facts%found .and. .not. facts%regular) then
            call refuse(error, path, "it is not a regular file")
        else if (facts%found) then
            if (c_access(path//c_null_char, 2_c_int) /= 0) then
                call refuse(error, path, reason(last_error()))
            end if
            self%permissions = facts%permissions
            facts = look_at(path, follow=.false.)
            if (facts%link) self%place = resolved(path)
        else
            facts = look_at(path, follow=.false.)
            if (facts%link) call refuse(error, path, "it is a link that leads nowhere")
        end if
        if (allocated(error)) return
        call make_folders(folder_of(self%place), number, culprit)
        if (number == e_exists) then
            call refuse(error, path, "'"//culprit//"' is not a folder")
            return
        else if (number /= 0) then
            call refuse(error, path, "cannot make '"//culprit//"': "//reason(number))
            return
        end if
        facts = look_at(self%place)  ! a name that is too long must not be found out at the end
        number = merge(0, facts%status, facts%found .or. facts%status == e_missing)
        if (number == 0) call open_temporary(self, number)
        if (number /= 0) call refuse(error, path, reason(number))
    end subroutine open_file

    subroutine open_temporary(self, number)
        !! Create a file of our own in the folder of `self%place`, after removing those that runs
        !! which were killed have left there for the same place.
        class(output_file_t), intent(inout) :: self
        integer, intent(out) :: number         !! 0, or why not
        integer, parameter :: attempts = 1000  !! so many can write to one place at a time
        integer, parameter :: likely = 8       !! and few do
        integer, parameter :: longest = 100    !! of its name, shown in that of the temporary
        character(:), allocatable :: start
        type(facts_t) :: facts
        integer :: i, first, last

        first = index(self%place, "/", back=.true.) + 1
        last = min(len(self%place), first + longest - 1)
        start = folder_of(self%place)//"/.lagrangia-"//self%place(first:last)//"-"
        do i = 1, likely
            call remove_abandoned(start//to_text(i)//".tmp")
        end do
        do i = 1, attempts
            self%temporary = start//to_text(i)//".tmp"
            call create(self%temporary, self%stream, facts, number)
            if (number /= e_exists) exit
        end do
        if (self%permissions < 0 .and. number == 0) self%permissions = facts%permissions
    end subroutine open_temporary

    subroutine write_text(self, text)
        !! Append `text` as it is; lines end with `new_line("a")`.
        class(output_file_t), intent(inout) :: self
        character(*), intent(in) :: text  !! any bytes
        integer(c_size_t) :: length

        if (.not. writable(self)) return
        length = len(text, c_size_t)
        if (c_fwrite(text, 1_c_size_t, length, self%stream) /= length) self%failure = last_error()
        self%bytes = self%bytes + length
    end subroutine write_text

    subroutine write_reals(self, values)
        !! Append the bytes of `values` as they are in memory.
        class(output_file_t), intent(inout) :: self
        real(dp), intent(in), contiguous :: values(:)  !! any number of them
        integer(c_size_t) :: length

        if (.not. writable(self)) return
        length = size(values, kind=c_size_t)
        if (c_fwrite_reals(values, 8_c_size_t, length, self%stream) /= length) then
            self%failure = last_error()
        end if
        self%bytes = self%bytes + 8*length
    end subroutine write_reals

    subroutine rewrite(self, offset, text)
        !! Replace the bytes from `offset` (0 is the first) by `text`: all of them must have been
        !! written before. For headers with counts known only at the end.
        class(output_file_t), intent(inout) :: self
        integer(i8), intent(in) :: offset  !! in bytes
        character(*), intent(in) :: text   !! any bytes
        integer(c_size_t) :: length

        if (.not. writable(self)) return
        length = len(text, c_size_t)
        if (offset < 0 .or. offset + length > self%bytes) then
            self%failure = e_invalid
            return
        end if
        if (c_fseek(self%stream, int(offset, c_long), 0_c_int) /= 0) then
            self%failure = last_error()
        else if (c_fwrite(text, 1_c_size_t, length, self%stream) /= length) then
            self%failure = last_error()
        else if (c_fseek(self%stream, 0_c_long, 2_c_int) /= 0) then
            self%failure = last_error()
        end if
    end subroutine rewrite

    subroutine flush_file(self)
        !! Send what is held back to the disk, and look whether the file still has a name: a folder
        !! may be removed during a long run.
        class(output_file_t), intent(inout) :: self
        type(facts_t) :: facts

        if (.not. writable(self)) return
        if (c_fflush(self%stream) /= 0) self%failure = last_error()
        facts = look_at(self%temporary)
        if (self%failure == 0 .and. .not. facts%found) self%failure = facts%status
    end subroutine flush_file

    pure function failed(self)
        !! Whether something could not be written: a long run may stop early.
        class(output_file_t), intent(in) :: self
        logical :: failed

        failed = self%failure /= 0
    end function failed

    subroutine report(self, error)
        !! Fails with the reason if something could not be written.
        class(output_file_t), intent(in) :: self
        type(error_t), allocatable, intent(out) :: error  !! status 5: the first failure

        if (.not. self%failed()) return
        call refuse(error, self%path, reason(self%failure))
    end subroutine report

    pure function position(self)
        !! How many bytes have been written: the offset of what comes next.
        class(output_file_t), intent(in) :: self
        integer(i8) :: position

        position = self%bytes
    end function position

    pure function final_name(self) result(name)
        !! What the file is called once it is committed.
        class(output_file_t), intent(in) :: self
        character(:), allocatable :: name

        name = self%path
    end function final_name

    function temporary_name(self) result(name)
        !! The absolute name, or one that begins with `./`, under which another program may fill
        !! the file that is open.
        class(output_file_t), intent(in) :: self
        character(:), allocatable :: name

        name = plain_path(self%temporary)
    end function temporary_name

    subroutine complete(self, error)
        !! Send all that was written to the disk, under the temporary name: what can fail of a
        !! `commit` fails here. On failure nothing is left behind.
        class(output_file_t), intent(inout) :: self
        type(error_t), allocatable, intent(out) :: error  !! status 5: the first failure
        integer :: status

        if (.not. self%is_open()) then
            if (.not. allocated(self%path)) self%path = ""
            call refuse(error, self%path, "it is not open")
            return
        end if
        if (self%partial) self%place = self%place//partial_ending
        if (self%partial) self%path = self%place
        self%partial = .false.
        call self%flush()
        ! what only a close reports (NFS, quotas); a copy's, as our own would end the lock
        status = int(c_dup(c_fileno(self%stream)))
        if (status >= 0) status = int(c_close(int(status, c_int)))
        if (status /= 0 .and. self%failure == 0) self%failure = last_error()
        call self%report(error)
        if (allocated(error)) call self%abandon()
    end subroutine complete

    function is_open(self)
        !! Whether it was opened, and neither committed nor abandoned.
        class(output_file_t), intent(in) :: self
        logical :: is_open

        is_open = c_associated(self%stream)
    end function is_open

    subroutine commit(self, error)
        !! Complete the file, close it and give it its name. On failure nothing is left behind, and
        !! a file that had this name before is as it was.
        class(output_file_t), intent(inout) :: self
        type(error_t), allocatable, intent(out) :: error  !! status 5: the first failure
        integer :: status

        call self%complete(error)
        if (allocated(error)) return
        if (self%permissions >= 0) then
            status = int(c_chmod(self%temporary//c_null_char, int(self%permissions, c_int)))
        end if
        status = int(c_rename(self%temporary//c_null_char, self%place//c_null_char))
        if (status /= 0) self%failure = last_error()
        call self%report(error)
        call close_temporary(self, remove=status /= 0)
    end subroutine commit

    subroutine commit_both(first, second, error)
        !! Two files that belong together: neither gets its name before both are on the disk.
        class(output_file_t), intent(inout) :: first, second  !! both open; closed in any case
        type(error_t), allocatable, intent(out) :: error      !! status 5: the first failure

        call first%complete(error)
        if (.not. allocated(error)) call second%complete(error)
        if (.not. allocated(error)) call first%commit(error)
        if (.not. allocated(error)) call second%commit(error)
        call first%abandon()
        call second%abandon()
    end subroutine commit_both

    subroutine refuse_unwritable(path, error)
        !! Fails where a small file called `path` could not be written now: to be asked before a
        !! long computation whose result goes there. Makes the folders that are missing.
        character(*), intent(in) :: path                  !! of the file; every blank counts
        type(error_t), allocatable, intent(out) :: error  !! status 5: why not
        integer, parameter :: small = 16384               !! bytes
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
        character(*), intent(in) :: path  !! without `.partial`
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

    subroutine abandon(self)
        !! Close and remove what has been written; does nothing if no file is open.
        class(output_file_t), intent(inout) :: self

        if (c_associated(self%stream)) call close_temporary(self, remove=.true.)
    end subroutine abandon

    subroutine close_temporary(self, remove)
        !! Let go of the temporary, and of its lock last: its name may be another's from then on.
        class(output_file_t), intent(inout) :: self
        logical, intent(in) :: remove
        integer :: status

        if (remove) status = int(c_remove(self%temporary//c_null_char))
        call forget(self%temporary)
        status = int(c_fclose(self%stream))
        self%stream = c_null_ptr
    end subroutine close_temporary

    function writable(self)
        !! Whether the file is open and nothing has failed yet.
        class(output_file_t), intent(inout) :: self
        logical :: writable

        if (.not. c_associated(self%stream) .and. self%failure == 0) self%failure = e_bad_unit
        if (.not. allocated(self%path)) self%path = ""
        writable = self%failure == 0
    end function writable

    pure subroutine refuse(error, path, why)
        !! The one form of this module's errors.
        type(error_t), allocatable, intent(inout) :: error
        character(*), intent(in) :: path, why

        call fail(error, "cannot write '"//path//"': "//why, status_file)
    end subroutine refuse
end module lagrangia_output_file
