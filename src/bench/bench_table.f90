module lagrangia_bench_table
    !! Tables of results: lines for people, objects for programs (JSON), from the same cells.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use lagrangia_json, only: json_number, json_string
    use lagrangia_kinds, only: dp, i8
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: bench_table_t, cell_t
    public :: count_cell, new_bench_table, number_cell, short, word_cell

    integer, parameter :: most_columns = 24, width = 72

    type :: cell_t
        character(width) :: shown = ""   !! to people
        character(width) :: json = ""    !! to programs
        logical :: word = .false.        !! stands to the left
    end type cell_t

    type :: row_t
        type(cell_t) :: cells(most_columns)
    end type row_t

    type :: bench_table_t
        !! One table.
        character(width) :: name = ""                  !! key of its rows in JSON
        character(200) :: title = ""
        integer :: columns = 0, rows = 0
        character(width) :: names(most_columns) = ""
        type(row_t), allocatable :: row(:)
        logical :: silent = .false.                    !! in JSON only: too long to be read
    contains
        procedure :: add
        procedure :: head
        procedure :: line
        procedure :: object
    end type bench_table_t

contains

    pure subroutine new_bench_table(self, name, title, names)
        !! A table without rows.
        type(bench_table_t), intent(out) :: self
        character(*), intent(in) :: name, title, names(:)

        self%name = name
        self%title = title
        self%columns = size(names)
        self%names(:size(names)) = names
        allocate (self%row(16))
    end subroutine new_bench_table

    pure subroutine add(self, cells)
        !! One more row.
        class(bench_table_t), intent(inout) :: self
        type(cell_t), intent(in) :: cells(:)
        type(row_t), allocatable :: longer(:)

        if (self%rows == size(self%row)) then
            allocate (longer(2*self%rows))
            longer(:self%rows) = self%row
            call move_alloc(longer, self%row)
        end if
        self%rows = self%rows + 1
        self%row(self%rows)%cells(:self%columns) = cells
    end subroutine add

    pure function column_width(self, k) result(most)
        !! What column `k` needs.
        class(bench_table_t), intent(in) :: self
        integer, intent(in) :: k
        integer :: most, i

        most = len_trim(self%names(k))
        do i = 1, self%rows
            most = max(most, len_trim(self%row(i)%cells(k)%shown))
        end do
    end function column_width

    pure function head(self) result(text)
        !! The titles over the columns.
        class(bench_table_t), intent(in) :: self
        character(:), allocatable :: text
        integer :: k

        text = ""
        do k = 1, self%columns
            text = text//padded(self%names(k), column_width(self, k), is_word(self, k))
        end do
        text = trim(text)
    end function head

    pure function line(self, i) result(text)
        !! Row `i`.
        class(bench_table_t), intent(in) :: self
        integer, intent(in) :: i
        character(:), allocatable :: text
        integer :: k

        text = ""
        do k = 1, self%columns
            text = text//padded(self%row(i)%cells(k)%shown, column_width(self, k), &
                                is_word(self, k))
        end do
        text = trim(text)
    end function line

    pure function is_word(self, k) result(word)
        !! Column `k` holds words.
        class(bench_table_t), intent(in) :: self
        integer, intent(in) :: k
        logical :: word

        word = .true.
        if (self%rows > 0) word = self%row(1)%cells(k)%word
    end function is_word

    pure function padded(text, room, left) result(cell)
        !! Two blanks behind each column.
        character(*), intent(in) :: text
        integer, intent(in) :: room
        logical, intent(in) :: left
        character(:), allocatable :: cell

        if (left) then
            cell = trim(text)//repeat(" ", room - len_trim(text) + 2)
        else
            cell = repeat(" ", room - len_trim(text))//trim(text)//"  "
        end if
    end function padded

    pure function object(self, i) result(json)
        !! Row `i` as a JSON object; its first key tells the table.
        class(bench_table_t), intent(in) :: self
        integer, intent(in) :: i
        character(:), allocatable :: json
        integer :: k

        json = '{"table": '//json_string(trim(self%name))
        do k = 1, self%columns
            json = json//", "//json_string(trim(self%names(k)))//": "// &
                   trim(self%row(i)%cells(k)%json)
        end do
        json = json//"}"
    end function object

    elemental function word_cell(text) result(cell)
        !! A name.
        character(*), intent(in) :: text
        type(cell_t) :: cell

        cell%shown = text
        cell%json = json_string(trim(text))
        cell%word = .true.
    end function word_cell

    elemental function count_cell(number) result(cell)
        !! A whole number.
        integer(i8), intent(in) :: number
        type(cell_t) :: cell

        write (cell%shown, "(ss, i0)") number
        cell%json = cell%shown
    end function count_cell

    elemental function number_cell(number, digits) result(cell)
        !! A number, shown with so many significant digits, and `-` where it is not known.
        real(dp), intent(in) :: number
        integer, intent(in) :: digits
        type(cell_t) :: cell

        cell%shown = short(number, digits)
        cell%json = json_number(number)
    end function number_cell

    pure function short(number, digits) result(text)
        !! `123.4`, `0.0312` or `1.2e-13`.
        real(dp), intent(in) :: number
        integer, intent(in) :: digits
        character(:), allocatable :: text
        character(width) :: buffer
        character(16) :: layout
        integer :: behind, exponent

        text = "-"
        if (.not. ieee_is_finite(number)) return
        exponent = 0
        if (abs(number) > 0.0_dp) exponent = floor(log10(abs(number)*(1.0_dp + epsilon(number))))
        if (exponent < -3 .or. exponent > 8) then
            write (layout, "(ss, a, i0, a)") "(ss, es20.", digits - 1, "e3)"
        else
            behind = max(0, digits - 1 - exponent)
            write (layout, "(ss, a, i0, a)") "(ss, f30.", behind, ")"
        end if
        write (buffer, layout) number
        text = trim(adjustl(buffer))
        if (text(len(text):) == ".") text = text(:len(text) - 1)
        if (index(text, ".E") > 0) text = text(:index(text, ".E") - 1)//text(index(text, ".E") + 1:)
        if (index(text, "E") > 0) text = power(text, index(text, "E"))
        if (text(1:1) == ".") text = "0"//text
    end function short

    pure function power(text, e) result(plain)
        !! `1.2E-06` as `1.2e-6`; the `E` stands at `e`.
        character(*), intent(in) :: text
        integer, intent(in) :: e
        character(:), allocatable :: plain
        integer :: exponent

        read (text(e + 1:), *) exponent
        plain = text(:e - 1)//"e"//to_text(exponent)
    end function power
end module lagrangia_bench_table
