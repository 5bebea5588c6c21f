module lagrangia_unknown_names
    !! Names of a statement that nobody has given a meaning.
    use lagrangia_errors, only: error_t
    use lagrangia_expression, only: is_function_name
    use lagrangia_formula_tokens, only: cut, is_name, tokens_t
    use lagrangia_names, only: name_length
    use lagrangia_symbols, only: symbols_t
    implicit none (type, external)
    private
    public :: add_unknown, unknown_names
    public :: hidden

    character, parameter :: hidden = "!"
    !! behind the name of a constant that no line has given a value, so that no formula has it

contains

    pure subroutine unknown_names(text, symbols, names)
        !! Each once, in the order of the text; none if it cannot be cut.
        character(*), intent(in) :: text                              !! one side or more
        type(symbols_t), intent(in) :: symbols                        !! what is known
        character(name_length), allocatable, intent(out) :: names(:)  !! what is not
        character(:), allocatable :: plain, word
        type(tokens_t) :: tokens
        type(error_t), allocatable :: error
        integer :: i

        allocate (names(0))
        plain = text
        do i = 1, len(plain)
            if (plain(i:i) == "=") plain(i:i) = "+"
        end do
        call cut(plain, tokens, error)
        if (allocated(error)) return
        do i = 1, size(tokens%token)
            if (tokens%token(i)%kind /= is_name) cycle
            word = symbols%spelling(tokens%word(i))
            if (symbols%find(word) > 0 .or. symbols%find_definition(word) > 0) cycle
            if (is_function_name(word) .or. word == "pi") cycle
            if (word == "e" .and. tokens%word(min(i + 1, size(tokens%token))) == "^" .and. &
                symbols%find("e"//hidden) == 0) cycle  ! no eccentricity behind `constant:`
            if (len(word) > name_length .or. any(names == word)) cycle
            names = [character(name_length) :: names, word]
        end do
    end subroutine unknown_names

    pure subroutine add_unknown(names, symbols)
        !! Constants behind all other symbols; a definition of such a name hides it.
        character(*), intent(in) :: names(:)              !! of `unknown_names`
        type(symbols_t), intent(inout) :: symbols         !! get them
        integer :: i

        do i = 1, size(names)
            call symbols%add(trim(names(i)))
        end do
    end subroutine add_unknown
end module lagrangia_unknown_names
