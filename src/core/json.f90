module lagrangia_json
    !! Pieces of JSON text (RFC 8259): strings, numbers, lists.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use lagrangia_kinds, only: dp, i8
    implicit none (type, external)
    private
    public :: json_string, json_number, json_list

    interface json_number
        module procedure json_real
        module procedure json_integer
    end interface json_number

contains

    pure function json_string(text) result(json)
        !! `text` between double quotes; control characters escaped.
        character(*), intent(in) :: text
        character(:), allocatable :: json
        character(16), parameter :: hex = "0123456789abcdef"
        integer :: i, code

        json = '"'
        do i = 1, len_trim(text)
            code = iachar(text(i:i))
            if (code < 32 .or. code == 127) then
                json = json//"\u00"//hex(code/16 + 1:code/16 + 1)// &
                       hex(mod(code, 16) + 1:mod(code, 16) + 1)
            else
                if (text(i:i) == '"' .or. text(i:i) == "\") json = json//"\"
                json = json//text(i:i)
            end if
        end do
        json = json//'"'
    end function json_string

    pure function json_real(value) result(json)
        !! A number with 17 digits; JSON has no NaN or Infinity, so they are `null`.
        real(dp), intent(in) :: value
        character(:), allocatable :: json
        character(24) :: text

        json = "null"
        if (.not. ieee_is_finite(value)) return
        write (text, "(es24.16e3)") value
        json = trim(adjustl(text))
    end function json_real

    pure function json_integer(value) result(json)
        !! A whole number.
        integer(i8), intent(in) :: value
        character(:), allocatable :: json
        character(20) :: text

        write (text, "(i0)") value
        json = trim(text)
    end function json_integer

    pure function json_list(values) result(json)
        !! A list of numbers.
        real(dp), intent(in) :: values(:)
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
