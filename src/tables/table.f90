module lagrangia_table
    !! The contract of a data file's format: a header, rows of numbers, an end.
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_output_file, only: output_file_t
    implicit none (type, external)
    private
    public :: table_t

    type, abstract :: table_t
        type(output_file_t) :: file
        integer(i8), private :: sent = 0       !! reading of the clock when rows last went to disk
    contains
        procedure :: add_row
        procedure :: send_header
        procedure(begin_i), deferred :: begin  !! the header; `names` and `units` a column
        procedure(row_i), deferred :: row      !! one sample; failures are seen by `finish`
        procedure(finish_i), deferred :: finish
        procedure(reading_i), deferred :: reading
    end type table_t

    abstract interface
        subroutine begin_i(self, header, names, units, error)
            import :: table_t, error_t
            implicit none (type, external)
            class(table_t), intent(inout) :: self
            character(*), intent(in) :: header(:)        !! lines about the run
            character(*), intent(in) :: names(:), units(:)  !! of the columns
            type(error_t), allocatable, intent(out) :: error  !! allocated where it fails
        end subroutine begin_i

        subroutine row_i(self, values)
            import :: table_t, dp
            implicit none (type, external)
            class(table_t), intent(inout) :: self
            real(dp), intent(in), contiguous :: values(:)  !! one a column
        end subroutine row_i

        subroutine finish_i(self, counts, error)
            !! All is there and on the disk; `file%commit` gives it its name.
            import :: table_t, error_t
            implicit none (type, external)
            class(table_t), intent(inout) :: self
            character(*), intent(in) :: counts           !! the line that is known only now
            type(error_t), allocatable, intent(out) :: error  !! allocated where it fails
        end subroutine finish_i

        pure function reading_i(self) result(words)
            !! What gnuplot needs behind the file's name to read it, with a blank at the end.
            import :: table_t
            implicit none (type, external)
            class(table_t), intent(in) :: self
            character(:), allocatable :: words
        end function reading_i
    end interface

contains

    subroutine send_header(self, error)
        !! After `begin`: to the disk, before anything is computed, for it may be full.
        class(table_t), intent(inout) :: self
        type(error_t), allocatable, intent(inout) :: error
        !! that of `begin`, or one of the disk; then the file is abandoned

        if (.not. allocated(error)) then
            call self%file%flush()
            call self%file%report(error)
        end if
        if (allocated(error)) call self%file%abandon()
    end subroutine send_header

    subroutine add_row(self, values, error)
        !! One sample of a long run, which must not compute for hours what cannot be written: fails
        !! where a row could not be. After a second without, a row is sent to the disk at once.
        class(table_t), intent(inout) :: self
        real(dp), intent(in), contiguous :: values(:)  !! one a column
        type(error_t), allocatable, intent(out) :: error  !! allocated where it fails
        integer(i8) :: now, rate

        call self%row(values)
        call system_clock(now, rate)
        if (abs(now - self%sent) > rate) then
            call self%file%flush()
            self%sent = now
        end if
        call self%file%report(error)
    end subroutine add_row
end module lagrangia_table
