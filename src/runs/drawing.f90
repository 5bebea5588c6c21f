module lagrangia_drawing
    !! The pictures that gnuplot makes of data files, by the scripts beside them.
    use, intrinsic :: iso_c_binding, only: c_int, c_null_char
    use lagrangia_c_library, only: c_setenv
    use lagrangia_data_files, only: picture_path, pictures, script_path
    use lagrangia_errors, only: error_t, fail, status_file
    use lagrangia_files, only: facts_t, look_at, plain_path, read_whole_file
    use lagrangia_interrupt, only: interrupt_status
    use lagrangia_kinds, only: i8
    use lagrangia_observer, only: observer_t
    use lagrangia_output_file, only: output_file_t
    use lagrangia_processes, only: await_program, bytes_read_by, start_program
    use lagrangia_text, only: to_text, word_t
    implicit none (type, external)
    private
    public :: bytes_to_read, draw, ends_well

    integer, parameter :: interval = 100  !! ms between two looks at gnuplot

contains

    subroutine draw(path, kind, error, watcher)
        !! Let gnuplot draw the data file at `path`, as one of `pictures`; no shell is involved.
        !! It says nothing of a full disk, so its picture gets its name only if its end is there.
        character(*), intent(in) :: path, kind  !! its script lies beside it; of `pictures`
        type(error_t), allocatable, intent(out) :: error  !! gnuplot is missing or failed
        class(observer_t), intent(inout), optional :: watcher  !! told how many bytes are read
        type(output_file_t) :: picture
        character(:), allocatable :: script
        type(word_t) :: words(6)
        integer(i8) :: bytes
        integer :: pid, status
        logical :: ended

        script = script_path(path)
        call picture%open(picture_path(path, kind), error)
        if (allocated(error)) return
        words(1)%text = "gnuplot"
        words(2)%text = "-d"  ! not the user's start-up file
        words(3)%text = "-c"
        words(4)%text = plain_path(script)  ! a shell runs what stands behind a first < or |
        words(5)%text = kind
        words(6)%text = picture%temporary_name()
        bytes = bytes_to_read(script)
        ! In the locale C gnuplot warns, at each `set encoding`, that it has no degree sign.
        status = int(c_setenv("LC_ALL"//c_null_char, "C.UTF-8"//c_null_char, 1_c_int))
        ! It fails on a terminal there that it does not know, and the script chooses its own.
        status = int(c_setenv("GNUTERM"//c_null_char, "unknown"//c_null_char, 1_c_int))
        status = 0
        call start_program(words, pid, error)
        do while (.not. allocated(error))
            call await_program(words(1)%text, pid, interval, ended, status, error)
            if (ended) exit
            if (present(watcher)) call watcher%tick(bytes_read_by(pid), bytes)
        end do
        if (interrupt_status() /= 0) call fail(error, "interrupted", interrupt_status())
        if (.not. allocated(error) .and. status /= 0) call fail(error, "gnuplot ended with "// &
            "status "//to_text(status)//" on '"//script//"'", status_file)
        if (.not. allocated(error)) then
            if (.not. ends_well(picture%temporary_name(), kind)) call fail(error, "gnuplot did "// &
                "not finish '"//picture_path(path, kind)//"': no space left, or it knows "// &
                "no "//kind, status_file)
        end if
        if (allocated(error)) then
            call picture%abandon()
        else
            call picture%commit(error)
        end if
    end subroutine draw

    function bytes_to_read(script) result(bytes)
        !! How much gnuplot reads for a script: the file of `data2 = folder."name"` as often as
        !! `data2` is used. 0 where there is no such file.
        character(*), intent(in) :: script  !! its path
        integer(i8) :: bytes
        character(*), parameter :: given = ' = folder."'
        character(:), allocatable :: text, name, file
        type(error_t), allocatable :: error
        type(facts_t) :: facts
        integer :: from, at, first, length, times

        bytes = 0
        call read_whole_file(script, text, error)
        if (allocated(error)) return
        from = 1
        do
            at = index(text(from:), given)
            if (at == 0) return
            at = from + at - 1
            first = index(text(:at), new_line("a"), back=.true.) + 1
            name = text(first:at - 1)
            from = at + len(given)
            length = index(text(from:), '"'//new_line("a")) - 1
            if (length < 1 .or. name(:min(4, len(name))) /= "data") cycle
            file = script(:index(script, "/", back=.true.))//text(from:from + length - 1)
            facts = look_at(file)
            call count_word(text(from:), " "//name//" ", times)
            bytes = bytes + facts%size*times
        end do
    end function bytes_to_read

    pure subroutine count_word(text, word, times)
        !! How often a word is in a text; two that overlap count once.
        character(*), intent(in) :: text, word
        integer, intent(out) :: times
        integer :: at, from

        times = 0
        from = 1
        do
            at = index(text(from:), word)
            if (at == 0) return
            times = times + 1
            from = from + at - 1 + len(word)
        end do
    end subroutine count_word

    function ends_well(path, kind)
        !! Whether a picture is there to its last byte, as far as its last bytes tell.
        character(*), intent(in) :: path  !! of the picture
        character(*), intent(in) :: kind  !! of `pictures`
        logical :: ends_well
        character(6), parameter :: ends(3) = ["IEND  ", "</svg>", "%%EOF "]
        character(20) :: last
        integer :: unit, length, status

        ends_well = .false.
        open (newunit=unit, file=path, access="stream", form="unformatted", status="old", &
              action="read", iostat=status)
        if (status /= 0) return
        inquire (unit=unit, size=length)
        last = ""
        if (length > 0) read (unit, pos=max(1, length - len(last) + 1), iostat=status) &
            last(:min(len(last), length))
        close (unit)
        if (status /= 0) return
        ends_well = index(last, trim(ends(findloc(pictures == kind, .true., 1)))) > 0
    end function ends_well
end module lagrangia_drawing
