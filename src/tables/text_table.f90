module lagrangia_text_table
    !! The data file as text: a `#` header, then one row a sample; for gnuplot and numpy.loadtxt.
    use lagrangia_characters, only: printable
    use lagrangia_column_words, only: column_word, unit_word
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_number_text, only: field_width, write_row
    use lagrangia_table, only: table_t
    use lagrangia_text, only: shortened
    implicit none (type, external)
    private
    public :: text_table_t

    integer, parameter :: counts_width = 240  !! room for the line that is known at the end

    type, extends(table_t) :: text_table_t
        integer(i8), private :: counts_at = 0     !! offset of that line, bytes
    contains
        procedure :: begin
        procedure :: row
        procedure :: finish
        procedure :: reading
    end type text_table_t

contains

    subroutine begin(self, header, names, units, error)
        !! Header lines behind `# `; the last one names the columns with their units, a word each:
        !! `p_x[kg*m/s]`, `flat_throw[m]`.
        class(text_table_t), intent(inout) :: self
        character(*), intent(in) :: header(:), names(:), units(:)
        type(error_t), allocatable, intent(out) :: error
        character(:), allocatable :: text
        integer :: i

        text = ""
        do i = 1, size(header)
            text = text//"# "//trim(printable(header(i)))//new_line("a")
        end do
        self%counts_at = len(text)
        text = text//"# "//repeat(" ", counts_width)//new_line("a")//"#"
        do i = 1, size(names)
            text = text//" "//column_word(names(i))//"["//unit_word(units(i))//"]"
        end do
        call self%file%write(text//new_line("a"))
    end subroutine begin

    subroutine row(self, values)
        !! One sample.
        class(text_table_t), intent(inout) :: self
        real(dp), intent(in), contiguous :: values(:)
        character((field_width + 1)*size(values)) :: line
        integer :: length

        call write_row(values, line, length)
        call self%file%write(line(:length))
    end subroutine row

    subroutine finish(self, counts, error)
        !! Fill in the counts.
        class(text_table_t), intent(inout) :: self
        character(*), intent(in) :: counts
        type(error_t), allocatable, intent(out) :: error

        call self%file%rewrite(self%counts_at, "# "//shortened(printable(counts), counts_width))
        call self%file%complete(error)
    end subroutine finish

    pure function reading(self) result(words)
        !! gnuplot needs nothing to read it.
        class(text_table_t), intent(in) :: self
        character(:), allocatable :: words

        words = ""
    end function reading
end module lagrangia_text_table
