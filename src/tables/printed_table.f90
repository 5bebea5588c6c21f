module lagrangia_printed_table
    !! Tables of results: lines for people, objects for programs (JSON), from the same cells.
    !!
    !! Columns are as wide as they must be. Lines that are printed before the rows below them are
    !! known have columns of fixed widths: they are put together from `left` and `right`.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use lagrangia_json, only: json_item, json_number, json_object, json_string
    use lagrangia_kinds, only: dp, i8
    use lagrangia_number_class, only: is_nonzero, is_zero
    use lagrangia_number_text, only: scientific
    use lagrangia_text, only: to_text, word_t
    implicit none (type, external)
    private
    public :: printed_table_t, cell_t
    public :: count_cell, number_cell, word_cell
    public :: left, right, short, two_digits

    integer, parameter :: width_of_cell = 72

    type :: cell_t
        character(width_of_cell) :: shown = ""   !! to people
        character(width_of_cell) :: json = ""    !! to programs
        logical :: word = .false.        !! stands to the left
    end type cell_t

    type :: printed_table_t
        !! One table.
        character(width_of_cell) :: name = ""                  !! key of its rows in JSON
        character(200) :: title = ""
        integer :: columns = 0, rows = 0
        type(word_t), allocatable :: names(:)
        type(cell_t), allocatable :: cells(:, :)       !! a column each row, and room for more
        logical :: silent = .false.                    !! in JSON only: too long to be read
    contains
        procedure :: begin
        procedure :: add
        procedure :: lines
        procedure :: object
    end type printed_table_t

contains

    pure subroutine begin(self, name, title, names)
        !! A table without rows.
        class(printed_table_t), intent(inout) :: self
        character(*), intent(in) :: name      !! key of its rows in JSON
        character(*), intent(in) :: title     !! above it
        character(*), intent(in) :: names(:)  !! of its columns
        integer :: i

        self%name = name
        self%title = title
        self%columns = size(names)
        if (allocated(self%names)) deallocate (self%names)
        allocate (self%names(size(names)))
        do i = 1, size(names)
            self%names(i)%text = trim(names(i))
        end do
        self%rows = 0
        if (allocated(self%cells)) deallocate (self%cells)
        allocate (self%cells(size(names), 16))
    end subroutine begin

    pure subroutine add(self, cells)
        !! One more row.
        class(printed_table_t), intent(inout) :: self
        type(cell_t), intent(in) :: cells(:)  !! one a column
        type(cell_t), allocatable :: longer(:, :)

        if (self%rows == size(self%cells, 2)) then
            allocate (longer(self%columns, 2*self%rows))
            longer(:, :self%rows) = self%cells
            call move_alloc(longer, self%cells)
        end if
        self%rows = self%rows + 1
        self%cells(:, self%rows) = cells
    end subroutine add

    pure subroutine lines(self, width, text)
        !! The titles over the columns, and the rows. A table that is wider is cut into parts, one
        !! below the other, each with the names of the rows: the words that its columns begin with.
        class(printed_table_t), intent(in) :: self
        integer, intent(in) :: width                       !! columns of a line
        type(word_t), allocatable, intent(out) :: text(:)  !! an empty line between two parts
        integer :: first(self%columns), last(self%columns), wide(self%columns)
        integer :: i, k, names, parts, n

        do k = 1, self%columns
            wide(k) = len(self%names(k)%text) + 2
            wide(k) = max(wide(k), 2 + maxval(len_trim(self%cells(k, :self%rows)%shown)))
        end do
        names = 1
        do k = 2, self%columns
            if (.not. is_word(self, k) .or. sum(wide(:k)) > width/2) exit
            names = k
        end do
        parts = 1
        first(1) = names + 1
        do k = names + 1, self%columns
            n = sum(wide(:names)) + sum(wide(first(parts):k)) - 2  ! no blanks at the end
            if (n > width .and. k > first(parts)) then
                parts = parts + 1
                first(parts) = k
            end if
            last(parts) = k
        end do
        if (self%columns == names) last(1) = names
        allocate (text(parts*(self%rows + 2) - 1))
        n = 0
        do i = 1, parts
            n = n + 1
            if (i > 1) text(n)%text = ""
            if (i > 1) n = n + 1
            do k = 0, self%rows
                if (k > 0) n = n + 1
                text(n)%text = aligned(k)
            end do
        end do
    contains
        pure function aligned(row) result(line)
            !! One word a column, two blanks behind each; numbers to the right.
            integer, intent(in) :: row  !! 0: the titles
            character(:), allocatable :: line, word
            integer :: j

            line = ""
            do j = 1, last(i)
                if (j > names .and. j < first(i)) cycle
                if (row == 0) then
                    word = self%names(j)%text
                else
                    word = trim(self%cells(j, row)%shown)
                end if
                if (is_word(self, j)) then
                    line = line//left(word, wide(j))
                else
                    line = line//repeat(" ", wide(j) - 2 - len(word))//word//"  "
                end if
            end do
            line = trim(line)
        end function aligned
    end subroutine lines

    pure function is_word(self, k) result(yes)
        !! Whether a column holds words, which stand to the left; one without rows does.
        class(printed_table_t), intent(in) :: self
        integer, intent(in) :: k
        logical :: yes

        yes = .true.
        if (self%rows > 0) yes = self%cells(k, 1)%word
    end function is_word

    pure function left(text, width) result(cell)
        !! `text` without trailing blanks in `width` columns, and at least one blank behind it.
        character(*), intent(in) :: text  !! trailing blanks do not count
        integer, intent(in) :: width  !! columns, with the blank
        character(:), allocatable :: cell

        cell = trim(text)//repeat(" ", max(1, width - len_trim(text)))
    end function left

    pure function right(text, width) result(cell)
        !! `text` at the end of `width` columns, and at least one blank before it.
        character(*), intent(in) :: text  !! all of it counts
        integer, intent(in) :: width  !! columns, with the blank
        character(:), allocatable :: cell

        cell = repeat(" ", max(1, width - len(text)))//text
    end function right

    pure function object(self, i) result(json)
        !! Row `i` as a JSON object; its first key tells the table.
        class(printed_table_t), intent(in) :: self
        integer, intent(in) :: i  !! from 1 to `rows`
        character(:), allocatable :: json
        integer :: k

        json = json_item("table", json_string(self%name))
        do k = 1, self%columns
            json = json//json_item(self%names(k)%text, trim(self%cells(k, i)%json))
        end do
        json = json_object(json)
    end function object

    elemental function word_cell(text) result(cell)
        !! A name.
        character(*), intent(in) :: text  !! the word
        type(cell_t) :: cell

        cell%shown = text
        cell%json = json_string(trim(text))
        cell%word = .true.
    end function word_cell

    elemental function count_cell(number) result(cell)
        !! A whole number.
        integer(i8), intent(in) :: number  !! shown in full
        type(cell_t) :: cell

        write (cell%shown, "(ss, i0)") number
        cell%json = cell%shown
    end function count_cell

    elemental function number_cell(number, digits) result(cell)
        !! A number, shown with so many significant digits, and `-` where it is not known.
        real(dp), intent(in) :: number  !! NaN: not known
        integer, intent(in) :: digits  !! significant ones
        type(cell_t) :: cell

        cell%shown = short(number, digits)
        cell%json = json_number(number)
    end function number_cell

    pure function two_digits(value) result(text)
        !! `1.2E-13`, enough for an error; `0` exactly.
        real(dp), intent(in) :: value  !! zero or more
        character(:), allocatable :: text

        text = "0"
        if (is_nonzero(value) .or. .not. is_zero(value)) text = scientific(value, 2)
    end function two_digits

    pure function short(number, digits) result(text)
        !! `123.4`, `0.0312` or `1.2e-13`.
        real(dp), intent(in) :: number  !! `-` where it is not finite
        integer, intent(in) :: digits  !! significant ones
        character(:), allocatable :: text
        character(width_of_cell) :: buffer
        character(16) :: layout
        integer :: behind, exponent

        text = "-"
        if (.not. ieee_is_finite(number)) return
        exponent = 0
        if (is_nonzero(number)) exponent = floor(log10(abs(number)*(1.0_dp + epsilon(number))))
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
end module lagrangia_printed_table
