module lagrangia_number_list
    !! Numbers between commas on the command line: read as strictly as those of a scene.
    use lagrangia_errors, only: error_t, fail
    use lagrangia_kinds, only: dp
    use lagrangia_number_reader, only: misread, read_number
    use lagrangia_text, only: quoted
    implicit none (type, external)
    private
    public :: read_numbers

contains

    pure subroutine read_numbers(option, text, values, error)
        !! The numbers in `text`, the value of `option`. Fails where one is no number, and says what
        !! to write.
        character(*), intent(in) :: option                !! with its hyphens, for the message
        character(*), intent(in) :: text                  !! `0.1,2e-3`, blanks around a number
        real(dp), allocatable, intent(out) :: values(:)  !! in their order
        type(error_t), allocatable, intent(out) :: error  !! allocated where it fails
        character(:), allocatable :: phrase, problem, word
        real(dp) :: value
        integer :: first, last

        allocate (values(0))
        first = 1
        do while (first <= len(text) + 1)
            last = index(text(first:)//",", ",") + first - 2
            word = trim(adjustl(text(first:last)))
            call misread(word, phrase, problem)
            if (problem == "") then
                call read_number(word, value, problem)
                phrase = word
                if (index(problem, "is not a number") == 1) problem = &
                    "a number is needed; several have commas between them, as in 0.1,-2e-3"
            end if
            if (problem /= "") then
                call fail(error, option//" "//quoted(text)//": "//quoted(phrase)//": "//problem)
                return
            end if
            values = [values, value]
            first = last + 2
        end do
    end subroutine read_numbers
end module lagrangia_number_list
