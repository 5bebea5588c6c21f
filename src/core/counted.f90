module lagrangia_counted
    !! How many: `1 step`, `2 steps`.
    use lagrangia_kinds, only: i8
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: counted

contains

    pure function counted(number, noun) result(text)
        !! The number and its noun.
        integer(i8), intent(in) :: number  !! how many
        character(*), intent(in) :: noun   !! what, in the singular; its plural has an s
        character(:), allocatable :: text

        text = to_text(number)//" "//noun
        if (number /= 1) text = text//"s"
    end function counted
end module lagrangia_counted
