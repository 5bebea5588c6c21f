module kept_texts
    !! Texts that a test makes anew and compares with the file where they are kept.
    use funit, only: assertTrue
    use lagrangia_errors, only: error_t
    use lagrangia_files, only: read_whole_file
    implicit none (type, external)
    private
    public :: compare_with_kept

contains

    subroutine compare_with_kept(path, text)
        !! They are the same, byte by byte. If not, the new one is left in `build`, under the same
        !! name, for whoever brings the file up to date.
        character(*), intent(in) :: path  !! of the file, from the project's folder
        character(*), intent(in) :: text  !! what it has to be
        type(error_t), allocatable :: error
        character(:), allocatable :: there, written
        integer :: status, unit

        call read_whole_file(path, there, error)
        if (allocated(error)) there = ""
        if (there == text .and. len(there) == len(text)) return
        written = "build/"//path(index(path, "/", back=.true.) + 1:)
        open (newunit=unit, file=written, access="stream", form="unformatted", &
              status="replace", action="write", iostat=status)
        if (status == 0) then
            write (unit) text
            close (unit)
        end if
        call assertTrue(.false., path//" is not what the program says; now 'diff "//path//" "// &
                        written//"', and if that is meant, 'cp "//written//" "//path//"'")
    end subroutine compare_with_kept
end module kept_texts
