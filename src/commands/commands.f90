module lagrangia_commands
    !! From the program's words to one command.
    use, intrinsic :: iso_c_binding, only: c_funloc
    use lagrangia_bench, only: bench_command
    use lagrangia_check, only: check_command
    use lagrangia_command_line, only: command_line_t, command_words, parse_words, word_t
    use lagrangia_console, only: finish_console, put, put_line
    use lagrangia_describe, only: describe_command
    use lagrangia_errata_command, only: errata_command
    use lagrangia_errors, only: error_t, fail
    use lagrangia_giving_up, only: give_up
    use lagrangia_interrupt, only: catch_interrupts, interrupt_status
    use lagrangia_list, only: list_command
    use lagrangia_modes_command, only: modes_command
    use lagrangia_principle, only: principle_command
    use lagrangia_registry, only: check_line, commands, help_text, options
    use lagrangia_run_command, only: run_command
    use lagrangia_stress, only: stress_command
    use lagrangia_unfinished, only: remove_unfinished
    use lagrangia_version, only: build_text, version
    implicit none (type, external)
    private
    public :: dispatch

contains

    subroutine dispatch(error)
        !! Run what was typed; `error` carries the message and the exit status.
        type(error_t), allocatable, intent(out) :: error
        type(error_t), allocatable :: output_error
        type(word_t), allocatable :: words(:)
        type(command_line_t) :: line
        integer :: which

        call command_words(words, error)
        if (allocated(error)) return
        call parse_words(words, options, line, error)
        if (allocated(error)) return
        call check_line(line, which, error)
        if (allocated(error)) return
        call catch_interrupts(c_funloc(give_up))
        if (line%has("version")) then
            call put_line("lagrangia "//version)
            call put_line(build_text())
        else if (line%has("help")) then
            call put(help_text(which))
        else
            select case (commands(which)%name)
            case ("check"); call check_command(line, error)
            case ("errata"); call errata_command(line, error)
            case ("list"); call list_command(line, error)
            case ("describe"); call describe_command(line, error)
            case ("bench"); call bench_command(line, error)
            case ("stress"); call stress_command(line, error)
            case ("modes"); call modes_command(line, error)
            case ("principle"); call principle_command(line, error)
            case default; call run_command(line, error)
            end select
        end if
        if (interrupt_status() /= 0) call fail(error, "interrupted", interrupt_status())
        call remove_unfinished()
        call finish_console(output_error)
        if (allocated(error)) return
        if (allocated(output_error)) call move_alloc(output_error, error)
    end subroutine dispatch
end module lagrangia_commands
