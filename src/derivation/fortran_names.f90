module lagrangia_fortran_names
    !! Names for the symbols of a system in formulas where they become variables of Fortran.
    use lagrangia_expression, only: is_function_name
    use lagrangia_text, only: lower, word_t
    implicit none (type, external)
    private
    public :: find_names

    character(*), parameter :: always(*) = [character(17) :: "constraint_length", &
        "coordinate", "dp", "factor", "lanes", "letter_t", "mass_point", "nonnegative", &
        "positive", "q", "quantity", "real_number", "self", "sine_cosine", "v"]
    character(*), parameter :: numbered(*) = [character(6) :: "a", "angle", "cosine", "force", &
                                              "mass", "sine"]
    !! of the statements for the accelerations, with numbers behind

contains

    pure subroutine find_names(symbols, reserved, names)
        !! Names as they are, with an underscore behind where they are taken. To Fortran large and
        !! small letters are the same.
        character(*), intent(in) :: symbols(:)                  !! t, coordinates, ...
        character(*), intent(in) :: reserved(:)                 !! that the procedure has besides
        type(word_t), allocatable, intent(out) :: names(:)      !! of the symbols
        character(:), allocatable :: name
        integer :: i

        allocate (names(size(symbols)))
        do i = 1, size(symbols)
            name = trim(symbols(i))
            do while (is_taken(name, names(:i - 1)) .or. any(lower(name) == reserved))
                name = name//"_"
            end do
            names(i)%text = name
        end do
    end subroutine find_names

    pure function is_taken(name, names) result(yes)
        !! By the module, by a function, or by one of the names before?
        character(*), intent(in) :: name
        type(word_t), intent(in) :: names(:)
        logical :: yes
        integer :: i, last

        yes = any(always == lower(name)) .or. is_function_name(lower(name))
        if (verify(name, "0123456789", back=.true.) < len(name)) then  ! `mass1_2`, not `mass1_`
            last = verify(name, "0123456789_", back=.true.)
            yes = yes .or. any(numbered == lower(name(:last)))
        end if
        do i = 1, size(names)
            yes = yes .or. lower(names(i)%text) == lower(name)
        end do
    end function is_taken
end module lagrangia_fortran_names
