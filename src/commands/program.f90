module lagrangia_program
    !! The whole program: words in, one command, exit status out.
    use, intrinsic :: iso_c_binding, only: c_funloc, c_int
    use lagrangia_bench, only: bench_command
    use lagrangia_blas_threads, only: take_blas_memory, use_one_blas_thread
    use lagrangia_c_library, only: c_alarm, c_exit, c_first_of_all
    use lagrangia_check, only: check_command
    use lagrangia_command_line, only: command_line_t, command_words, parse_words, word_t
    use lagrangia_compare, only: compare_command
    use lagrangia_completion, only: completion_command
    use lagrangia_console, only: finish_console, fold_lines, line_width, note, put, put_line, &
        say_at_once
    use lagrangia_course_command, only: course_command
    use lagrangia_derive, only: derive_command
    use lagrangia_describe, only: describe_command
    use lagrangia_errata_command, only: errata_command
    use lagrangia_errors, only: error_t, fail, message_length, status_file, status_not_held, &
                                status_ok
    use lagrangia_files, only: hold_standard_units
    use lagrangia_grade, only: grade_command
    use lagrangia_help, only: help_command, help_text
    use lagrangia_images, only: image_count, wait_for_all
    use lagrangia_interrupt, only: catch_interrupts, end_by_signals, interrupt_status
    use lagrangia_kinds, only: dp
    use lagrangia_list, only: list_command
    use lagrangia_manual, only: manual_text
    use lagrangia_modes_command, only: modes_command
    use lagrangia_principle, only: principle_command
    use lagrangia_registry, only: check_line, commands, options
    use lagrangia_report_command, only: report_command
    use lagrangia_resources, only: check_memory, check_stack
    use lagrangia_run_command, only: run_command
    use lagrangia_show, only: show_command
    use lagrangia_stress, only: stress_command
    use lagrangia_sweep_command, only: sweep_command
    use lagrangia_text, only: shortened
    use lagrangia_unfinished, only: is_creating, remove_unfinished
    use lagrangia_version, only: build_text, version
    use lagrangia_wrong_words, only: check_arguments
    implicit none (type, external)
    private
    public :: lagrangia_main
    public :: give_up

    integer, parameter :: least_stack = 2048         !! kB; 200 nested brackets take 700
    real(dp), parameter :: least_memory = 150e6_dp   !! bytes, most of them for OpenBLAS

contains

    subroutine lagrangia_main(failed)
        !! Run the command that was typed, with all systems that were registered, and stop. Where
        !! something `failed` before, say so and stop with the status of that: what
        !! `register_system` returned may be handed on, allocated or not.
        !!
        !! Of several images each waits for the others, for a STOP of OpenCoarrays ends them all,
        !! whatever they are at; where nothing failed the caller is to come to its end.
        type(error_t), intent(in), optional :: failed  !! what went wrong before
        type(error_t), allocatable :: error
        integer :: status

        call c_first_of_all()
        call hold_standard_units()
        call use_one_blas_thread()
        if (present(failed)) then
            allocate (error, source=failed)
        else
            call check_stack(least_stack, error)
            if (.not. allocated(error)) call check_memory(least_memory, "lagrangia", error)
            if (.not. allocated(error)) then
                call take_blas_memory()
                call dispatch(error)
            end if
        end if
        status = status_ok
        if (allocated(error)) then
            status = error%status
            if (len(error%message) > 0) call note(error%message)
        end if
        if (image_count() > 1) then
            call end_by_signals()  ! all is said: those of MPI, which ends the others, mean nothing
            call wait_for_all()
            if (status == status_ok) return
        end if
        stop status, quiet=.true.
    end subroutine lagrangia_main

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
        if (.not. (line%has("help") .or. line%has("version"))) call check_arguments( &
            commands(which), line%arguments, line%values_of("set"), error)
        if (allocated(error)) return
        call catch_interrupts(c_funloc(give_up))
        if (.not. (line%has("json") .or. line%has("latex"))) call fold_lines()
        if (line%has("version")) then
            call put_line("lagrangia "//version)
            call put_line(build_text())
        else if (line%has("help")) then
            call put(help_text(which, line_width()))
        else
            select case (commands(which)%name)
            case ("check"); call check_command(line, error)
            case ("course"); call course_command(line, error)
            case ("errata"); call errata_command(line, error)
            case ("completion"); call completion_command(line, error)
            case ("help"); call help_command(line, error)
            case ("manual"); call put(manual_text())
            case ("grade"); call grade_command(line, error)
            case ("list"); call list_command(line, error)
            case ("compare"); call compare_command(line, error)
            case ("derive"); call derive_command(line, error)
            case ("describe"); call describe_command(line, error)
            case ("bench"); call bench_command(line, error)
            case ("sweep"); call sweep_command(line, error)
            case ("stress"); call stress_command(line, error)
            case ("show"); call show_command(line, error)
            case ("modes"); call modes_command(line, error)
            case ("principle"); call principle_command(line, error)
            case ("report"); call report_command(line, error)
            case default; call run_command(line, error)
            end select
        end if
        if (interrupt_status() /= 0) call note_interruption(error)
        call remove_unfinished()
        call finish_console(output_error)
        if (allocated(output_error)) call note_lost_output(output_error, error)
    end subroutine dispatch

    subroutine note_lost_output(lost, error)
        !! It goes behind what else failed. A verdict that nobody could read is none: status 1,
        !! "does not hold", gives way. A reader who has seen enough loses nothing.
        type(error_t), allocatable, intent(inout) :: lost   !! of `finish_console`
        type(error_t), allocatable, intent(inout) :: error  !! of the command; may be absent

        if (.not. allocated(error)) then
            call move_alloc(lost, error)
        else if (lost%status == status_file) then
            if (error%status == status_not_held) error%status = status_file
            error%message = shortened(error%message//"; "//lost%message, message_length)
        end if
    end subroutine note_lost_output

    subroutine note_interruption(error)
        !! It goes before whatever else failed, unless that says it already.
        type(error_t), allocatable, intent(inout) :: error

        if (allocated(error)) then
            if (error%status == interrupt_status()) return
        end if
        call fail(error, "interrupted", interrupt_status())
    end subroutine note_interruption

    subroutine give_up(number) bind(c)
        !! Answers SIGALRM, for `catch_interrupts`. Runs at any moment: allocates nothing.
        integer(c_int), value :: number  !! of the signal

        if (is_creating()) then
            number = c_alarm(1_c_int)
            return
        end if
        call remove_unfinished()
        call say_at_once("lagrangia: interrupted"//new_line("a"))
        number = int(interrupt_status(), c_int)
        call c_exit(number)
    end subroutine give_up
end module lagrangia_program
