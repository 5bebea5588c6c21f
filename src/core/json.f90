module lagrangia_json
    !! Pieces of JSON text (RFC 8259): strings, numbers, lists.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use, intrinsic :: iso_fortran_env, only: real64
    use lagrangia_characters, only: decode, is_control, printable
    use lagrangia_decimal, only: decimal_width, write_decimal
    use lagrangia_kinds, only: dp, i8
    use lagrangia_text, only: lower
    implicit none (type, external)
    private
    public :: json_string, json_number, json_list

    interface json_number
        module procedure json_real
        module procedure json_integer
    end interface json_number

contains

    pure function json_string(text) result(json)
        !! `text` between double quotes; control characters escaped. JSON is UTF-8: a byte that is
        !! none becomes the four characters `\xNN`, as on the screen.
        character(*), intent(in) :: text  !! trailing blanks do not count
        character(:), allocatable :: json
        character(6) :: escape
        integer :: i, code, length

        json = '"'
        i = 1
        do while (i <= len_trim(text))
            call decode(text, i, code, length)
            if (code < 0) then
                json = json//"\"//printable(text(i:i))
            else if (is_control(code)) then
                write (escape, "('\u', z4.4)") code
                json = json//lower(escape)
            else
                if (text(i:i) == '"' .or. text(i:i) == "\") json = json//"\"
                json = json//text(i:i + length - 1)
            end if
            i = i + length
        end do
        json = json//'"'
    end function json_string

    pure function json_real(value) result(json)
        !! A number with 17 digits; JSON has no NaN or Infinity, so they are `null`.
        real(dp), intent(in) :: value  !! any double
        character(:), allocatable :: json
        character(decimal_width) :: text

        json = "null"
        if (.not. ieee_is_finite(value)) return
        call write_decimal(real(value, real64), text)
        json = trim(adjustl(text))
    end function json_real

    pure function json_integer(value) result(json)
        !! A whole number.
        integer(i8), intent(in) :: value  !! any whole number
        character(:), allocatable :: json
        character(20) :: text

        write (text, "(ss, i0)") value
        json = trim(text)
    end function json_integer

    pure function json_list(values) result(json)
        !! A list of numbers.
        real(dp), intent(in) :: values(:)  !! any length
        character(:), allocatable :: json
        integer :: i

        json = "["
        do i = 1, size(values)
            if (i > 1) json = json//", "
            json = json//json_real(values(i))
        end do
        json = json//"]"
    end function json_list
end module lagrangia_json
