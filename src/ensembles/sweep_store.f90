module lagrangia_sweep_store
    !! The numbers of a sweep while it is computed, block by block in the order in which they come:
    !! in memory, or in a file from which an interrupted sweep can go on.
    !!
    !! The file begins with a text that tells the sweep. Every block is one record of 8-byte words:
    !! its number, how many of its trajectories failed, the first of these, its numbers, a check
    !! sum. Each goes to the system at once, so a killed program loses what is not yet a whole
    !! block. Every image has a file of its own: `PATH.part`, `PATH.part2` and so on.
    use, intrinsic :: iso_c_binding, only: c_associated, c_int, c_long, c_null_char, c_null_ptr, &
        c_ptr, c_size_t
    use lagrangia_c_library, only: c_fclose, c_fflush, c_fileno, c_flock, c_fopen, c_fread, &
        c_fseek, c_fwrite, c_remove
    use lagrangia_errors, only: error_t, fail, status_file, status_library
    use lagrangia_files, only: e_exists, facts_t, folder_of, last_error, look_at, make_folders, &
                               reason
    use lagrangia_kinds, only: dp, i8
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: mark, part_name, sweep_store_t, would_block

    integer, parameter :: word = 8   !! bytes
    integer, parameter :: would_block = 11  !! EWOULDBLOCK of Linux
    integer, parameter :: before = 3 !! words of a record before its numbers
    character(*), parameter :: mark = "lagrangia sweep, blocks of trajectories, format 1"

    type :: part_t
        !! A file of records.
        character(:), allocatable :: name
        type(c_ptr) :: stream = c_null_ptr
        integer(i8) :: length = -1           !! bytes up to the end of its last whole record
    end type part_t

    type :: sweep_store_t
        !! `prepare`, for files `take_parts` and `own_part`, then `put` in any order, and `get`.
        integer(i8) :: blocks = 0                 !! in all
        integer(i8) :: there = 0                  !! blocks that are there
        integer(i8) :: failures = 0               !! of their trajectories
        integer(i8) :: first_failed = huge(1_i8)  !! number of the first of these
        character(:), allocatable :: damage       !! what is damaged, and where; absent: nothing is
        integer(i8), private :: block_size = 0, total = 0  !! trajectories
        integer, private :: width = 0             !! numbers of a trajectory
        character(:), allocatable, private :: path, header
        type(part_t), allocatable, private :: parts(:)
        integer, private :: own = 0               !! the one of `parts` that is written; 0: memory
        integer(i8), allocatable, private :: places(:)   !! of each block in its file; -1: not there
        integer, allocatable, private :: part_of(:)      !! which file that is
        real(dp), allocatable, private :: values(:, :)   !! (width, total) in memory
    contains
        procedure :: prepare
        procedure :: take_parts
        procedure :: own_part
        procedure :: has
        procedure :: first_of
        procedure :: last_of
        procedure :: trajectories_there
        procedure :: put
        procedure :: get
        procedure :: release
        procedure :: remove
    end type sweep_store_t

contains

    subroutine prepare(self, path, told, width, total, block_size, error)
        !! Nothing is there yet.
        class(sweep_store_t), intent(inout) :: self
        character(*), intent(in) :: path           !! of the data file; "": all stays in memory
        character(*), intent(in) :: told           !! what makes one sweep another
        integer, intent(in) :: width               !! numbers of a trajectory
        integer(i8), intent(in) :: total           !! trajectories
        integer(i8), intent(in) :: block_size      !! of them in each block but the last
        type(error_t), allocatable, intent(out) :: error  !! no memory
        integer :: status

        self%path = path
        self%header = mark//new_line("a")//to_text(len(told))//new_line("a")//told
        self%width = width
        self%total = total
        self%block_size = block_size
        self%blocks = (total + block_size - 1)/block_size
        allocate (self%parts(0))
        allocate (self%places(self%blocks), stat=status)
        if (status == 0) allocate (self%part_of(self%blocks), stat=status)
        if (status == 0 .and. path == "") allocate (self%values(width, total), stat=status)
        if (status /= 0) then
            call fail(error, "not enough memory for "//to_text(total)//" trajectories", &
                      status_library)
            return
        end if
        self%places = -1
        self%part_of = 0
    end subroutine prepare

    pure function part_name(path, image) result(name)
        !! Of an image's file.
        character(*), intent(in) :: path  !! of the data file
        integer, intent(in) :: image      !! from 1
        character(:), allocatable :: name

        name = path//".part"
        if (image > 1) name = name//to_text(image)
    end function part_name

    subroutine take_parts(self, error)
        !! Find the blocks in all files that there are.
        class(sweep_store_t), intent(inout) :: self
        type(error_t), allocatable, intent(out) :: error  !! another sweep's, or no file
        type(facts_t) :: facts
        integer :: i

        call self%release()
        if (allocated(self%damage)) deallocate (self%damage)
        self%places = -1
        self%there = 0
        self%failures = 0
        self%first_failed = huge(self%first_failed)
        i = 1
        do
            facts = look_at(part_name(self%path, i))
            if (.not. facts%found) exit
            if (.not. facts%regular) call fail(error, "'"//part_name(self%path, i)// &
                "' is not a file that a sweep has written", status_file)
            if (.not. allocated(error)) call add_part(self, i, "r", error)
            if (.not. allocated(error)) call scan_part(self, i, error)
            if (allocated(error)) exit
            i = i + 1
        end do
    end subroutine take_parts

    subroutine own_part(self, image, error)
        !! From now on blocks are added to the file of this image.
        class(sweep_store_t), intent(inout) :: self
        integer, intent(in) :: image                      !! from 1
        type(error_t), allocatable, intent(out) :: error  !! it cannot be written, or another does
        type(facts_t) :: facts
        character(:), allocatable :: culprit
        integer :: i, number, status

        call make_folders(folder_of(self%path), number, culprit)
        if (number /= 0) then
            call fail(error, "cannot write '"//part_name(self%path, image)//"': cannot make '"// &
                      culprit//"': "//reason(number), status_file)
            if (number == e_exists) error%message = "cannot write '"// &
                part_name(self%path, image)//"': '"//culprit//"' is not a folder"
            return
        end if
        facts = look_at(part_name(self%path, image))
        if (image <= size(self%parts)) then
            if (c_associated(self%parts(image)%stream)) then
                status = int(c_fclose(self%parts(image)%stream))
                self%parts(image)%stream = c_null_ptr
            end if
        end if
        do i = size(self%parts) + 1, image - 1
            call add_part(self, i, "", error)
        end do
        call add_part(self, image, merge("r+", "w+", facts%found), error)
        if (allocated(error)) return
        associate (part => self%parts(image))
            status = int(c_flock(c_fileno(part%stream), 6_c_int))
            if (status /= 0) status = last_error()
            if (status == would_block) then  ! all else: the file system has no locks
                call fail(error, "another sweep is writing '"//part%name//"' at this moment", &
                          status_file)
            else if (facts%found .and. part%length < 0) then
                call fail(error, "'"//part%name//"' is there already", status_file)
            end if
            if (allocated(error)) return
            self%own = image  ! from now on it may be removed
            if (part%length > 0) return
            part%length = 0
            call append(part, self%header, error)
        end associate
    end subroutine own_part

    subroutine add_part(self, image, mode, error)
        !! Open a file; without `mode` it only has its place.
        class(sweep_store_t), intent(inout) :: self
        integer, intent(in) :: image
        character(*), intent(in) :: mode  !! C's
        type(error_t), allocatable, intent(out) :: error
        type(part_t), allocatable :: more(:)
        integer :: i

        if (image > size(self%parts)) then
            allocate (more(image))
            do i = 1, size(self%parts)
                more(i) = self%parts(i)
            end do
            call move_alloc(more, self%parts)
        end if
        associate (part => self%parts(image))
            part%name = part_name(self%path, image)
            if (mode == "") return
            part%stream = c_fopen(part%name//c_null_char, trim(mode)//c_null_char)
            if (.not. c_associated(part%stream)) call fail(error, "cannot open '"//part%name// &
                "': "//reason(last_error()), status_file)
        end associate
    end subroutine add_part

    subroutine scan_part(self, which, error)
        !! Is this file of this sweep, and which blocks are in it?
        class(sweep_store_t), intent(inout) :: self
        integer, intent(in) :: which
        type(error_t), allocatable, intent(out) :: error
        character(len(self%header)) :: header
        integer :: got

        associate (part => self%parts(which))
            got = int(c_fread(header, 1_c_size_t, len(header, c_size_t), part%stream))
            if (header(:got) /= self%header(:got)) then
                call fail(error, "'"//part%name//"' is of another sweep, or another build of "// &
                          "lagrangia: remove it, or give this sweep another --output", status_file)
                return
            end if
            part%length = merge(len(header), 0, got == len(header))  ! 0: that was being written
            if (part%length > 0) call find_records(self, which)
        end associate
    end subroutine scan_part

    subroutine find_records(self, which)
        !! Note all records that are sound. Where one is not, the next may begin at any word.
        class(sweep_store_t), intent(inout) :: self
        integer, intent(in) :: which
        integer(i8), allocatable :: record(:)
        integer(i8) :: bad, first_bad, place
        logical :: ends, whole

        associate (part => self%parts(which))
            bad = -1
            first_bad = -1
            place = part%length
            do
                call read_record(self, part, place, record, whole, ends)
                if (ends) exit
                if (is_sound(record, whole)) then
                    if (first_bad < 0) first_bad = bad
                    bad = -1
                    if (.not. self%has(record(1))) call note_block(self, record(1), which, place, &
                                                                   record(2), record(3))
                    place = place + word*size(record)
                    part%length = place
                else
                    if (bad < 0) bad = place
                    place = place + word
                end if
            end do
            call read_record(self, part, part%length, record, whole, ends)
            if (first_bad < 0 .and. whole) first_bad = bad  ! else it was being written
            if (first_bad < 0 .or. allocated(self%damage)) return
            self%damage = "'"//part%name//"' is damaged at byte "//to_text(first_bad)
        end associate
    end subroutine find_records

    pure function is_sound(record, whole) result(yes)
        !! A block of this sweep, with the check sum of its words.
        integer(i8), intent(in) :: record(:)
        logical, intent(in) :: whole
        logical :: yes

        yes = whole
        if (yes) yes = check_sum(record(:size(record) - 1)) == record(size(record))
    end function is_sound

    subroutine read_record(self, part, place, record, whole, ends)
        !! The record at byte `place`; `whole` is false where the file ends before it does, `ends`
        !! where it ends before its first word. A block number that cannot be is a record of its
        !! first word and a check sum that does not hold.
        class(sweep_store_t), intent(in) :: self
        type(part_t), intent(in) :: part
        integer(i8), intent(in) :: place
        integer(i8), allocatable, intent(out) :: record(:)
        logical, intent(out) :: whole, ends
        character(word) :: start
        character(:), allocatable :: bytes
        integer(i8) :: block
        integer(c_size_t) :: got
        integer :: n

        allocate (record(0))
        whole = c_fseek(part%stream, int(place, c_long), 0_c_int) == 0
        ends = .not. whole
        if (ends) return
        got = c_fread(start, 1_c_size_t, int(word, c_size_t), part%stream)
        whole = got == word
        ends = .not. whole
        if (ends) return
        block = transfer(start, block)
        if (block < 1 .or. block > self%blocks) then
            record = [block, not(block)]
            return
        end if
        n = before + self%width*int(self%last_of(block) - self%first_of(block) + 1)
        allocate (character(word*n) :: bytes)
        got = c_fread(bytes, 1_c_size_t, len(bytes, c_size_t), part%stream)
        whole = got == len(bytes)
        if (whole) record = [block, transfer(bytes, [block])]
    end subroutine read_record

    subroutine note_block(self, block, which, place, failures, first_failed)
        !! A block is there.
        class(sweep_store_t), intent(inout) :: self
        integer(i8), intent(in) :: block, place, failures, first_failed
        integer, intent(in) :: which

        self%places(block) = place
        self%part_of(block) = which
        self%there = self%there + 1
        self%failures = self%failures + failures
        self%first_failed = min(self%first_failed, first_failed)
    end subroutine note_block

    pure function check_sum(words) result(sum_of_all)
        !! Changes with every bit and with the order of the words.
        integer(i8), intent(in) :: words(:)
        integer(i8) :: sum_of_all
        integer :: i

        sum_of_all = size(words)
        do i = 1, size(words)
            sum_of_all = ieor(ishftc(sum_of_all, 7), words(i))
        end do
    end function check_sum

    pure function has(self, block) result(yes)
        !! Is it there?
        class(sweep_store_t), intent(in) :: self
        integer(i8), intent(in) :: block  !! its number, from 1
        logical :: yes

        yes = self%places(block) >= 0
    end function has

    pure function first_of(self, block) result(index)
        !! The first trajectory of a block.
        class(sweep_store_t), intent(in) :: self
        integer(i8), intent(in) :: block  !! its number, from 1
        integer(i8) :: index

        index = (block - 1)*self%block_size + 1
    end function first_of

    pure function last_of(self, block) result(index)
        !! The last trajectory of a block.
        class(sweep_store_t), intent(in) :: self
        integer(i8), intent(in) :: block  !! its number, from 1
        integer(i8) :: index

        index = min(self%total, block*self%block_size)
    end function last_of

    pure function trajectories_there(self) result(count)
        !! Of all blocks that are there.
        class(sweep_store_t), intent(in) :: self
        integer(i8) :: count

        count = self%there*self%block_size
        if (self%has(self%blocks)) count = count + self%last_of(self%blocks) - &
                                           self%blocks*self%block_size
    end function trajectories_there

    subroutine put(self, block, values, failures, first_failed, error)
        !! A block is finished.
        class(sweep_store_t), intent(inout) :: self
        integer(i8), intent(in) :: block         !! its number, from 1
        real(dp), intent(in) :: values(:, :)     !! (width, trajectories of the block)
        integer(i8), intent(in) :: failures      !! of its trajectories
        integer(i8), intent(in) :: first_failed  !! number of the first of these, or huge
        type(error_t), allocatable, intent(inout) :: error  !! it cannot be written
        integer(i8), allocatable :: record(:)
        integer(i8) :: place

        if (self%own == 0) then
            self%values(:, self%first_of(block):self%last_of(block)) = values
            call note_block(self, block, 0, 0_i8, failures, first_failed)
            return
        end if
        record = [block, failures, first_failed, transfer(values, [block])]
        record = [record, check_sum(record)]
        place = self%parts(self%own)%length
        call append(self%parts(self%own), transfer(record, repeat(" ", word*size(record))), error)
        if (.not. allocated(error)) call note_block(self, block, self%own, place, failures, &
                                                    first_failed)
    end subroutine put

    subroutine append(part, bytes, error)
        !! Behind the last whole record, and to the system.
        type(part_t), intent(inout) :: part
        character(*), intent(in) :: bytes
        type(error_t), allocatable, intent(inout) :: error
        logical :: good

        good = c_fseek(part%stream, int(part%length, c_long), 0_c_int) == 0
        if (good) good = len(bytes) == c_fwrite(bytes, 1_c_size_t, len(bytes, c_size_t), &
                                                part%stream)
        if (good) good = c_fflush(part%stream) == 0
        if (good) then
            part%length = part%length + len(bytes)
        else if (.not. allocated(error)) then
            call fail(error, "cannot write '"//part%name//"': "//reason(last_error()), status_file)
        end if
    end subroutine append

    subroutine get(self, block, values, error)
        !! The numbers of a block that is there.
        class(sweep_store_t), intent(in) :: self
        integer(i8), intent(in) :: block          !! its number, from 1
        real(dp), intent(out) :: values(:, :)     !! (width, trajectories of the block)
        type(error_t), allocatable, intent(out) :: error  !! it cannot be read
        integer(i8), allocatable :: record(:)
        logical :: ends, whole

        if (self%own == 0) then
            values = self%values(:, self%first_of(block):self%last_of(block))
            return
        end if
        associate (part => self%parts(self%part_of(block)))
            call read_record(self, part, self%places(block), record, whole, ends)
            if (.not. is_sound(record, whole)) call fail(error, "cannot read '"//part%name// &
                                                         "' again", status_file)
        end associate
        if (allocated(error)) return
        values = reshape(transfer(record(before + 1:size(record) - 1), values), shape(values))
    end subroutine get

    subroutine release(self)
        !! Close all files; they stay.
        class(sweep_store_t), intent(inout) :: self
        integer :: i, status

        if (.not. allocated(self%parts)) return
        do i = 1, size(self%parts)
            if (c_associated(self%parts(i)%stream)) status = int(c_fclose(self%parts(i)%stream))
            self%parts(i)%stream = c_null_ptr
        end do
    end subroutine release

    subroutine remove(self)
        !! Close all files and remove them.
        class(sweep_store_t), intent(inout) :: self
        integer :: i, status

        call self%release()
        if (self%own == 0) return
        do i = 1, size(self%parts)
            status = int(c_remove(self%parts(i)%name//c_null_char))
        end do
    end subroutine remove
end module lagrangia_sweep_store
