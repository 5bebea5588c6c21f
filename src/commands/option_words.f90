module lagrangia_option_words
    !! Words that belong to an option but stand alone: `gif` behind `--plot`, `csv`, `help plot`.
    use lagrangia_data_files, only: formats, picture_advice, pictures
    use lagrangia_number_reader, only: starts_number
    use lagrangia_registry, only: accepts, command_t, options, told, usage
    use lagrangia_text, only: lower
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
end module lagrangia_option_words
