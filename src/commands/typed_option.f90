module lagrangia_typed_option
    !! An option and its value, as remedies tell the user to type them in a shell.
    use lagrangia_number_reader, only: misread, starts_number
    implicit none (type, external)
    private
    public :: as_read, typed_option

    character(*), parameter :: plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"// &
                                       "0123456789_-+.,:=/%@^"  !! to every shell

contains

    pure function typed_option(name, value) result(text)
        !! `'--set scene%q=1'`; with quotes where a shell would read more than letters:
        !! `--set 'scene%q(1)=1'`.
        character(*), intent(in) :: name   !! without hyphens, perhaps with the `=` before a value
        character(*), intent(in) :: value  !! any bytes
        character(:), allocatable :: text
        character(1) :: mark
        integer :: i

        text = "--"//name
        if (index(name, "=") == 0) text = text//" "
        if (value /= "" .and. verify(value, plain) == 0) then
            text = "'"//text//value//"'"
            return
        end if
        mark = "'"
        if (index(value, "'") > 0) mark = """"
        text = text//mark
        do i = 1, len(value)
            if (mark == """" .and. scan(value(i:i), """$`\") == 1) text = text//"\"
            text = text//value(i:i)
        end do
        text = text//mark
    end function typed_option

    pure function as_read(values) result(text)
        !! Numbers with commas between them, those computed that no option reads: `pi/2`, `45 deg`.
        character(*), intent(in) :: values  !! as typed, any words
        character(:), allocatable :: text
        character(:), allocatable :: number, phrase, problem, rest, word
        integer :: comma

        text = ""
        rest = values//","
        do while (rest /= "")
            comma = index(rest, ",")
            word = rest(:comma - 1)
            rest = rest(comma + 1:)
            call misread(word, phrase, problem)
            number = problem(index(problem, " ", back=.true.) + 1:)  ! ends what is said of it
            if (len(phrase) == len(word) .and. starts_number(number)) word = number
            text = text//word
            if (rest /= "") text = text//","
        end do
    end function as_read
end module lagrangia_typed_option
