module lagrangia_npy
    !! NumPy's own file format, version 1.0: `data = numpy.load("x.npy")`, then `data["theta"]`.
    !!
    !! Source: NumPy documentation, `numpy.lib.format`.
    use lagrangia_errors, only: error_t, fail
    use lagrangia_kinds, only: dp, i8
    use lagrangia_output_file, only: output_file_t
    implicit none (type, external)
    private
    public :: npy_file_t

    integer, parameter :: alignment = 64    !! the data start at a multiple of this
    integer, parameter :: longest = 10000   !! `numpy.load` mistrusts longer headers
    integer, parameter :: preamble = 10     !! bytes before the header: format, version, length

    type :: npy_file_t
        !! A one-dimensional array of records, one a row, each a double for every column: the
        !! names of the columns are in the file, which a plain two-dimensional array has no
        !! place for (`numpy.lib.recfunctions.structured_to_unstructured` makes one).
        private
        type(output_file_t) :: file
        integer :: columns = 0
        integer(i8) :: rows = 0
        character(:), allocatable :: kinds  !! the header's list of names and kinds of number
    contains
        procedure :: open => open_npy
        procedure :: write_row
        procedure :: failed
        procedure :: commit
        procedure :: abandon
    end type npy_file_t

contains

    subroutine open_npy(self, path, names, error)
        !! Begin the file; fails if numpy could not read such names, or as `output_file_t` does.
        class(npy_file_t), intent(inout) :: self
        character(*), intent(in) :: path
        character(*), intent(in) :: names(:)  !! of the columns, all different; trimmed
        type(error_t), allocatable, intent(out) :: error
        character(:), allocatable :: header
        integer :: i

        self%columns = size(names)
        self%rows = 0
        self%kinds = ""
        do i = 1, size(names)
            call check_name(names, i, error)
            if (allocated(error)) return
            self%kinds = self%kinds//"('"//trim(names(i))//"', '"//byte_order()//"f8'), "
        end do
        header = header_text(self%kinds, 0_i8)
        if (len(header) > longest) then
            call fail(error, "too many columns for numpy: '"//path//"'")
            return
        end if
        call self%file%open(path, error)
        if (allocated(error)) return
        call self%file%write(char(147)//"NUMPY"//char(1)//char(0) &
                             //char(modulo(len(header), 256))//char(len(header)/256)//header)
    end subroutine open_npy

    pure function header_text(kinds, rows) result(header)
        !! The header; its length does not depend on the number of rows.
        character(*), intent(in) :: kinds
        integer(i8), intent(in) :: rows
        character(:), allocatable :: header
        character(range(rows) + 1) :: count
        integer :: length

        write (count, "(i0)") rows
        header = "{'descr': ["//kinds//"], 'fortran_order': False, 'shape': ("
        length = preamble + len(header) + len(count) + len(",), }") + len(new_line("a"))
        length = length + modulo(-length, alignment) - preamble
        header = header//trim(count)//",), }"
        header = header//repeat(" ", length - 1 - len(header))//new_line("a")
    end function header_text

    pure subroutine check_name(names, i, error)
        !! Refuse `names(i)` if it is empty, has an odd character, or occurred before.
        character(*), intent(in) :: names(:)
        integer, intent(in) :: i
        type(error_t), allocatable, intent(inout) :: error
        character(*), parameter :: letters = "abcdefghijklmnopqrstuvwxyz" &
                                             //"ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_"

        if (verify(trim(names(i)), letters) > 0 .or. names(i) == "") then
            call fail(error, "column '"//trim(names(i))//"' cannot be named so in a .npy file")
        else if (any(names(:i - 1) == names(i))) then
            call fail(error, "column '"//trim(names(i))//"' occurs twice")
        end if
    end subroutine check_name

    pure function byte_order()
        !! `<` if the low byte of a number comes first on this machine, else `>`.
        character(1) :: byte_order
        integer, parameter :: one = iachar("<") + 256*iachar(">")

        byte_order = transfer(one, byte_order)
    end function byte_order

    subroutine write_row(self, values)
        !! Append a row: as many values as there are columns.
        class(npy_file_t), intent(inout) :: self
        real(dp), intent(in) :: values(self%columns)

        call self%file%write_reals(values)
        self%rows = self%rows + 1
    end subroutine write_row

    pure function failed(self)
        !! Whether something could not be written.
        class(npy_file_t), intent(in) :: self
        logical :: failed

        failed = self%file%failed()
    end function failed

    subroutine commit(self, error)
        !! Write the number of rows into the header, and complete the file.
        class(npy_file_t), intent(inout) :: self
        type(error_t), allocatable, intent(out) :: error

        if (allocated(self%kinds)) then
            call self%file%rewrite(int(preamble, i8), header_text(self%kinds, self%rows))
        end if
        call self%file%commit(error)
    end subroutine commit

    subroutine abandon(self)
        !! Leave no file.
        class(npy_file_t), intent(inout) :: self

        call self%file%abandon()
    end subroutine abandon
end module lagrangia_npy
