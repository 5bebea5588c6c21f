module lagrangia_number_text
    !! Numbers as text: rows of a data file, cells of a table.
    use, intrinsic :: iso_fortran_env, only: real64
    use lagrangia_decimal, only: decimal_width, write_decimal
    use lagrangia_kinds, only: dp
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: field_width, fixed, rounded, scientific, write_csv_row, write_row

    integer, parameter :: field_width = decimal_width  !! a double survives the trip

contains

    pure function scientific(value, digits) result(text)
        !! `1.2E-09`: so many significant digits, and as many of the exponent as it has, but two at
        !! least; never asterisks, and no sign of a zero.
        real(dp), intent(in) :: value  !! any double
        integer, intent(in) :: digits  !! 1 to 17
        character(:), allocatable :: text
        character(32) :: buffer, layout

        write (layout, "(ss, a, i0, a)") "(ss, es32.", digits - 1, "e2)"
        write (buffer, layout) value + 0.0_dp     ! -0.0 + 0.0 = 0.0
        if (index(buffer, "*") > 0) then          ! three digits of exponent
            write (layout, "(ss, a, i0, a)") "(ss, es32.", digits - 1, "e3)"
            write (buffer, layout) value
        end if
        text = trim(adjustl(buffer))
    end function scientific

    pure function fixed(value, decimals) result(text)
        !! `-0.0120`: so many digits behind the point, as many before it as there are; never
        !! asterisks, and no sign where all digits are 0.
        real(dp), intent(in) :: value    !! any double
        integer, intent(in) :: decimals  !! 0 to 17
        character(:), allocatable :: text
        character(330) :: buffer                  ! huge(value) has 309 digits before its point
        character(16) :: layout

        write (layout, "(ss, a, i0, a)") "(ss, f330.", decimals, ")"
        write (buffer, layout) value
        text = trim(adjustl(buffer))
        if (verify(text, "-0.") == 0) text = text(verify(text, "-"):)
    end function fixed

    pure function rounded(value, digits) result(text)
        !! `0.0125`: as `to_text` has it, after rounding to so many significant digits.
        real(dp), intent(in) :: value  !! a finite one
        integer, intent(in) :: digits  !! 1 to 17
        character(:), allocatable :: text
        character(32) :: buffer
        real(dp) :: near

        buffer = scientific(value, digits)
        read (buffer, *) near
        text = to_text(near)
    end function rounded

    pure subroutine write_row(values, row, length)
        !! A line of a text table: every value as `es24.16e3`, a blank between two, a newline.
        real(dp), intent(in) :: values(:)                              !! one for each column
        character((field_width + 1)*size(values)), intent(out) :: row  !! room for the longest line
        integer, intent(out) :: length                                 !! `row(:length)` is the line
        integer :: column, first

        do column = 1, size(values)
            first = (field_width + 1)*(column - 1)
            call write_decimal(real(values(column), real64), row(first + 1:first + field_width))
            row(first + field_width + 1:first + field_width + 1) = " "
        end do
        length = len(row)
        row(length:) = new_line("a")
    end subroutine write_row

    pure subroutine write_csv_row(values, row, length)
        !! A line of a comma-separated table: the same digits without padding.
        real(dp), intent(in) :: values(:)                              !! one for each column
        character((field_width + 1)*size(values)), intent(out) :: row  !! room for the longest line
        integer, intent(out) :: length                                 !! `row(:length)` is the line
        character(field_width) :: field
        integer :: column, first

        length = 0
        do column = 1, size(values)
            call write_decimal(real(values(column), real64), field)
            first = verify(field, " ")
            row(length + 1:length + field_width + 1 - first) = field(first:)
            length = length + field_width + 2 - first
            row(length:length) = ","
        end do
        row(length:length) = new_line("a")
    end subroutine write_csv_row
end module lagrangia_number_text
