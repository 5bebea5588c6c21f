module lagrangia_equality_signs
    !! The signs between the sides of a statement: `=`, and those that say "nearly", as in
    !! `sin(theta) ~ theta`.
    use lagrangia_characters, only: decode
    implicit none (type, external)
    private
    public :: read_signs

contains

    pure subroutine read_signs(text, plain, nearly)
        !! `=` for all of them, each character in its place.
        character(*), intent(in) :: text                        !! as typed, UTF-8
        character(:), allocatable, intent(out) :: plain         !! with `=` only
        logical, allocatable, intent(out) :: nearly(:)          !! at the places of those that do
        integer :: code, i, length

        plain = ""
        allocate (nearly(len(text)), source=.false.)
        i = 1
        do while (i <= len(text))
            call decode(text, i, code, length)
            select case (code)
            case (iachar("~"), int(z"223C"), int(z"2243"), int(z"2245"), int(z"2248"), &
                  int(z"224A"), int(z"224B"), int(z"2250"))
                nearly(len(plain) + 1) = .true.
                plain = plain//"="
                if (text(i + length:min(i + length, len(text))) == "=") then
                    plain = plain//" "  ! `~=` is one sign
                    length = length + 1
                end if
            case default
                plain = plain//text(i:i + length - 1)
            end select
            i = i + length
        end do
        nearly = nearly(:len(plain))
    end subroutine read_signs
end module lagrangia_equality_signs
