module stated_text
    !! Reads back what the program has said.
    use lagrangia_kinds, only: dp
    implicit none (type, external)
    private
    public :: is_said, read_concise

contains

    pure function is_said(message, expected) result(yes)
        !! Does the message end with these words? For `...` in them it may have any.
        character(*), intent(in) :: message   !! as it is printed
        character(*), intent(in) :: expected  !! `force is ... N; none is near`
        logical :: yes
        integer :: at, first, gap

        at = 1
        first = 1
        do
            gap = index(expected(first:), "...")
            if (gap == 0) exit
            yes = index(message(at:), expected(first:first + gap - 2)) > 0
            if (.not. yes) return
            at = at + index(message(at:), expected(first:first + gap - 2)) + gap - 2
            first = first + gap + 2
        end do
        yes = len(message) - at >= len(expected) - first
        if (yes) yes = message(len(message) - len(expected) + first:) == expected(first:)
    end function is_said

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
