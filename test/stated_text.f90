module stated_text
    !! Reads back what `lagrangia_concise` writes.
    use lagrangia_kinds, only: dp
    implicit none (type, external)
    private
    public :: read_concise

contains

    subroutine read_concise(text, centre, bracket)
        !! `1.23(4)e5` is 1.23e5 and 0.04e5; without a bracket nothing is uncertain.
        character(*), intent(in) :: text
        real(dp), intent(out) :: centre, bracket
        character(:), allocatable :: plain
        integer :: opened, point, power

        bracket = 0.0_dp
        opened = index(text, "(")
        if (opened == 0) then
            read (text, *) centre
            return
        end if
        plain = text(:opened - 1)//text(opened + 3:)
        read (plain, *) centre
        read (text(opened + 1:opened + 1), *) bracket
        power = 0
        if (text(opened + 3:) /= "") read (text(opened + 4:), *) power
        point = index(text, ".")
        if (point > 0) power = power - (opened - 1 - point)
        bracket = bracket*10.0_dp**power
    end subroutine read_concise
end module stated_text
