module lagrangia_npy
    !! NumPy's own file format, version 1.0: `data = numpy.load("x.npy")`, then `data["theta"]`.
    !!
    !! Source: NumPy documentation, `numpy.lib.format`.
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_table, only: table_t
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: npy_table_t

    integer, parameter :: alignment = 64       !! the data start at a multiple of this
    character(20), parameter :: no_count = ""  !! room for the number of rows, not yet known

    type, extends(table_t) :: npy_table_t
        !! A one-dimensional array of records, one a row, each a double for every column: the
        !! names of the columns are in the file, which a plain two-dimensional array has no
        !! place for (`numpy.lib.recfunctions.structured_to_unstructured` makes one).
        private
        integer :: columns = 0
        integer(i8) :: rows = 0
        integer(i8) :: count_offset = 0  !! where the number of rows stands
        integer(i8) :: data_offset = 0   !! where the first row begins
    contains
        procedure :: begin
        procedure :: row
        procedure :: finish
        procedure :: reading
    end type npy_table_t

contains

    subroutine begin(self, header, names, units)
        !! The names of the columns; the rest of the header has no place in this format.
        class(npy_table_t), intent(inout) :: self
        character(*), intent(in) :: header(:), names(:), units(:)
        character(:), allocatable :: before, text
        integer :: i

        self%columns = size(names)
        before = "{'descr': ["
        do i = 1, size(names)
            before = before//"('"//trim(names(i))//"', '"//byte_order()//"f8'), "
        end do
        before = before//"], 'fortran_order': False, 'shape': ("
        text = before//no_count//",), }"
        text = text//repeat(" ", modulo(-(10 + len(text) + 1), alignment))//new_line("a")
        self%count_offset = 10 + len(before)
        self%data_offset = 10 + len(text)
        call self%file%write(char(147)//"NUMPY"//char(1)//char(0)// &
                             char(modulo(len(text), 256))//char(len(text)/256)//text)
    end subroutine begin

    pure function byte_order()
        !! `<` if the low byte of a number comes first on this machine, else `>`.
        character(1) :: byte_order
        integer, parameter :: one = iachar("<") + 256*iachar(">")

        byte_order = transfer(one, byte_order)
    end function byte_order

    subroutine row(self, values)
        !! One sample.
        class(npy_table_t), intent(inout) :: self
        real(dp), intent(in) :: values(:)

        call self%file%write_reals(values)
        self%rows = self%rows + 1
    end subroutine row

    subroutine finish(self, counts, error)
        !! Write the number of rows into the header, and give the file its name.
        class(npy_table_t), intent(inout) :: self
        character(*), intent(in) :: counts
        type(error_t), allocatable, intent(out) :: error
        character(len(no_count)) :: count

        count = to_text(self%rows)
        call self%file%rewrite(self%count_offset, count)
        call self%file%commit(error)
    end subroutine finish

    pure function reading(self) result(words)
        !! What gnuplot needs behind the file's name.
        class(npy_table_t), intent(in) :: self
        character(:), allocatable :: words

        words = "binary skip="//to_text(self%data_offset)//" format='%"//to_text(self%columns)// &
                "double' "
    end function reading
end module lagrangia_npy
