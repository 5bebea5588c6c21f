module lagrangia_giving_up
    !! The end of a program that was told to end, and whose loops did not look.
    use, intrinsic :: iso_c_binding, only: c_int
    use lagrangia_c_library, only: c_alarm, c_exit
    use lagrangia_console, only: say_at_once
    use lagrangia_interrupt, only: interrupt_status
    use lagrangia_unfinished, only: is_creating, remove_unfinished
    implicit none (type, external)
    private
    public :: give_up

contains

    subroutine give_up(number) bind(c)
        !! Answers SIGALRM, for `catch_interrupts`. Runs at any moment: allocates nothing.
        integer(c_int), value :: number

        if (is_creating()) then
            number = c_alarm(1_c_int)
            return
        end if
        call remove_unfinished()
        call say_at_once("lagrangia: interrupted"//new_line("a"))
        number = int(interrupt_status(), c_int)
        call c_exit(number)
    end subroutine give_up
end module lagrangia_giving_up
