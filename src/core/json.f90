module lagrangia_json
    !! Pieces of JSON text (RFC 8259): strings, numbers, lists, objects.
    !!
    !! An object is `json_object(json_pair(key, value)//json_pair(key, value)//...)`, a list
    !! `json_array(json_element(value)//json_element(value)//...)`.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use, intrinsic :: iso_fortran_env, only: real64
    use lagrangia_characters, only: decode, is_control, printable
    use lagrangia_decimal, only: decimal_width, write_decimal
    use lagrangia_kinds, only: dp, i8
    use lagrangia_text, only: lower
    implicit none (type, external)
    private
    public :: json_string, json_number, json_list
    public :: json_array, json_element, json_item, json_line, json_object, json_pair

    interface json_number
        module procedure json_real
        module procedure json_integer
    end interface json_number

    interface json_pair
        !! A member of an object, with a comma before it; the value a text, a number or a logical.
        module procedure pair_string
        module procedure pair_real
        module procedure pair_integer
        module procedure pair_default_integer
        module procedure pair_logical
    end interface json_pair

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
        real(dp), intent(in) :: value  !! a number, or NaN or infinite
        character(:), allocatable :: json
        character(decimal_width) :: text

        json = "null"
        if (.not. ieee_is_finite(value)) return
        call write_decimal(real(value, real64), text)
        json = trim(adjustl(text))
    end function json_real

    pure function json_integer(value) result(json)
        !! A whole number.
        integer(i8), intent(in) :: value  !! a whole number
        character(:), allocatable :: json
        character(20) :: text

        write (text, "(ss, i0)") value
        json = trim(text)
    end function json_integer

    pure function json_list(values) result(json)
        !! A list of numbers.
        real(dp), intent(in) :: values(:)  !! NaN and infinities become `null`
        character(:), allocatable :: json
        integer :: i

        json = ""
        do i = 1, size(values)
            json = json//json_element(json_real(values(i)))
        end do
        json = json_array(json)
    end function json_list

    pure function json_array(elements) result(json)
        !! A list of what `json_element` made.
        character(*), intent(in) :: elements  !! one behind the other
        character(:), allocatable :: json

        json = "["//elements(3:)//"]"
    end function json_array

    pure function json_element(value) result(json)
        !! An element of a list, with a comma before it.
        character(*), intent(in) :: value  !! JSON itself
        character(:), allocatable :: json

        json = ", "//value
    end function json_element

    pure function json_line(value, more) result(json)
        !! An element of a list that stands on a line of its own.
        character(*), intent(in) :: value  !! JSON itself
        logical, intent(in) :: more  !! another element follows
        character(:), allocatable :: json

        json = value
        if (more) json = value//","
    end function json_line

    pure function json_object(members) result(json)
        !! An object of what `json_pair` and `json_item` made.
        character(*), intent(in) :: members  !! one behind the other
        character(:), allocatable :: json

        json = "{"//members(3:)//"}"
    end function json_object

    pure function json_item(key, value) result(json)
        !! A member of an object, with a comma before it.
        character(*), intent(in) :: key    !! without quotes
        character(*), intent(in) :: value  !! JSON itself: a list, an object, `null`
        character(:), allocatable :: json

        json = ", "//json_string(key)//": "//value
    end function json_item

    pure function pair_string(key, value) result(json)
        !! A text.
        character(*), intent(in) :: key  !! without quotes
        character(*), intent(in) :: value  !! trailing blanks do not count
        character(:), allocatable :: json

        json = json_item(key, json_string(value))
    end function pair_string

    pure function pair_real(key, value) result(json)
        !! A number, or `null`.
        character(*), intent(in) :: key  !! without quotes
        real(dp), intent(in) :: value  !! NaN and infinities become `null`
        character(:), allocatable :: json

        json = json_item(key, json_real(value))
    end function pair_real

    pure function pair_integer(key, value) result(json)
        !! A whole number.
        character(*), intent(in) :: key  !! without quotes
        integer(i8), intent(in) :: value  !! a whole number
        character(:), allocatable :: json

        json = json_item(key, json_integer(value))
    end function pair_integer

    pure function pair_default_integer(key, value) result(json)
        !! A whole number.
        character(*), intent(in) :: key  !! without quotes
        integer, intent(in) :: value  !! a whole number
        character(:), allocatable :: json

        json = json_item(key, json_integer(int(value, i8)))
    end function pair_default_integer

    pure function pair_logical(key, value) result(json)
        !! `true` or `false`.
        character(*), intent(in) :: key  !! without quotes
        logical, intent(in) :: value  !! a truth
        character(:), allocatable :: json

        json = json_item(key, trim(merge("true ", "false", value)))
    end function pair_logical
end module lagrangia_json
