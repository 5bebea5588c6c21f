module lagrangia_option_words
    !! Words that belong to an option but stand alone: `gif` behind `--plot`, `csv`, `keep=period`,
    !! `help plot`.
    use lagrangia_command_line, only: may_have_value, no_value
    use lagrangia_data_files, only: formats, picture_advice, pictures
    use lagrangia_number_reader, only: starts_number
    use lagrangia_registry, only: accepts, command_t, options, told, usage
    use lagrangia_scene_keys, only: keys
    use lagrangia_text, only: lower
    use lagrangia_typed_option, only: typed_option
    implicit none (type, external)
    private
    public :: option_advice

contains

    pure function option_advice(command, word) result(text)
        !! What the word is, and where it belongs; empty where it has to do with no option of the
        !! command. Of `help` every option is told.
        type(command_t), intent(in) :: command  !! of `commands`
        character(*), intent(in) :: word        !! an argument of it that it does not take
        character(:), allocatable :: text
        character(len(word)) :: small
        integer :: i

        text = ""
        small = lower(word)
        if (command%name == "help") then
            do i = 1, size(options)
                if (small == options(i)%name) text = "an option, "//told(options(i)%name)
            end do
        else if (index(word, "=") > 1) then
            text = value_advice(command, small(:index(word, "=") - 1), word(index(word, "=") + 1:))
        else if (accepts(command, "plot") .and. any(pictures == small)) then
            text = "a format of pictures; write '--plot="//small//"'"
        else if (accepts(command, "plot") .and. picture_advice(small) /= "") then
            text = "no format that '--plot' draws; there are "//picture_advice(small)
        else if (accepts(command, "format") .and. any(formats == small)) then
            text = "a format; write '--format "//small//"'"
        else if (starts_number(word) .and. accepts(command, "at")) then
            text = "a number; the place of an equilibrium is '--at Q1,Q2,...', with commas "// &
                   "and no blanks"
        else if (starts_number(word) .and. accepts(command, "starts")) then
            text = "a number; starts are ""--starts 'Q1,Q2 Q1,Q2'"", with blanks between them"
        else
            do i = 1, size(options)
                if (small == options(i)%name .and. accepts(command, small)) text = &
                    "an option, which two hyphens go before: "//usage(options(i))
            end do
        end if
    end function option_advice

    pure function value_advice(command, name, value) result(text)
        !! Of `name=value`, where that is an option of the command, and no key of a scene or a value
        !! that only the option has: `plot=png`.
        type(command_t), intent(in) :: command
        character(*), intent(in) :: name, value  !! in lower case; any word
        character(:), allocatable :: text
        integer :: i

        text = ""
        if (.not. accepts(command, name)) return
        i = findloc(options%name == name, .true., 1)
        if (any(keys == name) .and. accepts(command, "set") .and. &
            index("|"//trim(options(i)%value)//"|", "|"//lower(value)//"|") == 0) return
        select case (options(i)%takes)
        case (no_value)
            text = "an option, which takes no value: --"//name
        case (may_have_value)
            text = "an option; write "//typed_option(name//"=", value)
        case default
            text = "an option; write "//typed_option(name, value)
        end select
    end function value_advice
end module lagrangia_option_words
