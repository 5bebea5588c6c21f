module lagrangia_npy
    !! NumPy's own file format, version 1.0: `data = numpy.load("x.npy")`, then `data["theta"]`.
    !!
    !! Source: NumPy documentation, `numpy.lib.format`.
    use lagrangia_characters, only: decode
    use lagrangia_errors, only: error_t, fail
    use lagrangia_kinds, only: dp, i8
    use lagrangia_table, only: table_t
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: npy_table_t

    integer, parameter :: alignment = 64    !! the data start at a multiple of this
    integer, parameter :: longest = 10000   !! `numpy.load` mistrusts longer headers
    integer, parameter :: preamble = 10     !! bytes before the header: format, version, length

    type, extends(table_t) :: npy_table_t
        !! A one-dimensional array of records, one a row, each a double for every column: the
        !! names of the columns are in the file, which a plain two-dimensional array has no
        !! place for (`numpy.lib.recfunctions.structured_to_unstructured` makes one).
        private
        integer :: columns = 0
        integer :: data_offset = 0          !! where the first row begins
        integer(i8) :: rows = 0
        character(:), allocatable :: kinds  !! the header's list of names and kinds of number
    contains
        procedure :: begin
        procedure :: row
        procedure :: finish
        procedure :: reading
    end type npy_table_t

contains

    subroutine begin(self, header, names, units, error)
        !! The names of the columns; the rest of the header has no place in this format.
        class(npy_table_t), intent(inout) :: self
        character(*), intent(in) :: header(:), names(:), units(:)
        type(error_t), allocatable, intent(out) :: error
        character(:), allocatable :: text
        integer :: i

        self%columns = size(names)
        self%kinds = ""
        do i = 1, size(names)
            self%kinds = self%kinds//"("//python_string(trim(names(i)))//", '"//byte_order()// &
                         "f8'), "
        end do
        text = header_text(self%kinds, 0_i8)
        if (len(text) > longest) then
            call fail(error, to_text(self%columns)//" columns are too many for numpy; "// &
                      "--format text has no limit", key="columns")
            return
        end if
        self%data_offset = preamble + len(text)
        call self%file%write(char(147)//"NUMPY"//char(1)//char(0)// &
                             char(modulo(len(text), 256))//char(len(text)/256)//text)
    end subroutine begin

    pure function header_text(kinds, rows) result(header)
        !! The header; its length does not depend on the number of rows.
        character(*), intent(in) :: kinds
        integer(i8), intent(in) :: rows
        character(:), allocatable :: header
        integer :: length

        header = "{'descr': ["//kinds//"], 'fortran_order': False, 'shape': ("
        length = preamble + len(header) + range(rows) + 1 + len(",), }") + len(new_line("a"))
        length = length + modulo(-length, alignment) - preamble
        header = header//to_text(rows)//",), }"
        header = header//repeat(" ", length - 1 - len(header))//new_line("a")
    end function header_text

    pure function python_string(text) result(string)
        !! `text` as a string of Python, in ASCII as the header must be.
        character(*), intent(in) :: text
        character(:), allocatable :: string
        character(10) :: escape
        integer :: code, i, length

        string = "'"
        i = 1
        do while (i <= len(text))
            call decode(text, i, code, length)
            if (code < 0) code = ichar(text(i:i))
            if (code == iachar("'") .or. code == iachar("\")) then
                string = string//"\"//text(i:i)
            else if (code >= 32 .and. code < 127) then
                string = string//text(i:i)
            else
                write (escape, "('\U', z8.8)") code
                string = string//escape
            end if
            i = i + length
        end do
        string = string//"'"
    end function python_string

    pure function byte_order()
        !! `<` if the low byte of a number comes first on this machine, else `>`.
        character(1) :: byte_order
        integer, parameter :: one = iachar("<") + 256*iachar(">")

        byte_order = transfer(one, byte_order)
    end function byte_order

    subroutine row(self, values)
        !! One sample.
        class(npy_table_t), intent(inout) :: self
        real(dp), intent(in), contiguous :: values(:)

        call self%file%write_reals(values)
        self%rows = self%rows + 1
    end subroutine row

    subroutine finish(self, counts, error)
        !! Write the number of rows into the header.
        class(npy_table_t), intent(inout) :: self
        character(*), intent(in) :: counts
        type(error_t), allocatable, intent(out) :: error

        call self%file%rewrite(int(preamble, i8), header_text(self%kinds, self%rows))
        call self%file%complete(error)
    end subroutine finish

    pure function reading(self) result(words)
        !! What gnuplot needs behind the file's name.
        class(npy_table_t), intent(in) :: self
        character(:), allocatable :: words

        words = "binary skip="//to_text(self%data_offset)//" format='%"//to_text(self%columns)// &
                "double' "
    end function reading
end module lagrangia_npy
