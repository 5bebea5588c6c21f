module lagrangia_csv_table
    !! The data file as comma-separated values (RFC 4180): one header row, then numbers.
    use lagrangia_characters, only: printable
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp
    use lagrangia_number_text, only: field_width, write_csv_row
    use lagrangia_table, only: table_t
    implicit none (type, external)
    private
    public :: csv_table_t

    type, extends(table_t) :: csv_table_t
    contains
        procedure :: begin
        procedure :: row
        procedure :: finish
        procedure :: reading
    end type csv_table_t

contains

    subroutine begin(self, header, names, units, error)
        !! The names of the columns; the rest of the header has no place in this format.
        class(csv_table_t), intent(inout) :: self
        character(*), intent(in) :: header(:), names(:), units(:)
        type(error_t), allocatable, intent(out) :: error
        character(:), allocatable :: text
        integer :: i

        text = cell(trim(names(1)))
        do i = 2, size(names)
            text = text//","//cell(trim(names(i)))
        end do
        call self%file%write(text//new_line("a"))
    end subroutine begin

    pure function cell(text) result(safe)
        !! One field of the header: between double quotes, those within doubled, where it must be.
        character(*), intent(in) :: text
        character(:), allocatable :: safe
        character(:), allocatable :: plain
        integer :: i

        plain = printable(text)
        safe = plain
        if (scan(plain, ",""") == 0) return
        safe = """"
        do i = 1, len(plain)
            if (plain(i:i) == """") safe = safe//""""
            safe = safe//plain(i:i)
        end do
        safe = safe//""""
    end function cell

    subroutine row(self, values)
        !! One sample.
        class(csv_table_t), intent(inout) :: self
        real(dp), intent(in), contiguous :: values(:)
        character((field_width + 1)*size(values)) :: line
        integer :: length

        call write_csv_row(values, line, length)
        call self%file%write(line(:length))
    end subroutine row

    subroutine finish(self, counts, error)
        !! There is nothing to fill in.
        class(csv_table_t), intent(inout) :: self
        character(*), intent(in) :: counts
        type(error_t), allocatable, intent(out) :: error

        call self%file%complete(error)
    end subroutine finish

    pure function reading(self) result(words)
        !! What gnuplot needs behind the file's name.
        class(csv_table_t), intent(in) :: self
        character(:), allocatable :: words

        words = "skip 1 "
    end function reading
end module lagrangia_csv_table
