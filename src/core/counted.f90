module lagrangia_counted
    !! How many: `1 step`, `2 steps`, `3 trajectories`.
    use lagrangia_kinds, only: i8
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: counted

    interface counted
        !! A number and its noun.
        module procedure counted_integer
        module procedure counted_int64
    end interface counted

contains

    pure function counted_integer(number, noun) result(text)
        integer, intent(in) :: number      !! how many
        character(*), intent(in) :: noun   !! what, in the singular; y becomes ies
        character(:), allocatable :: text

        text = counted_int64(int(number, i8), noun)
    end function counted_integer

    pure function counted_int64(number, noun) result(text)
        integer(i8), intent(in) :: number  !! how many
        character(*), intent(in) :: noun   !! what, in the singular; y becomes ies
        character(:), allocatable :: text

        text = to_text(number)//" "//noun
        if (number == 1) return
        if (noun(len(noun):) == "y") text = text(:len(text) - 1)//"ie"
        text = text//"s"
    end function counted_int64
end module lagrangia_counted
