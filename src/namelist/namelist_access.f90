module lagrangia_namelist_access
    !! Taking values out of a namelist, strictly: each comes whole, as what it was written, or is
    !! refused with its place, group, key and value.
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_namelist_lookup, only: count_of, pick, refuse_picked
    use lagrangia_namelist_tree, only: kind_number, kind_string, namelist_t, raw_text, text_of, &
                                       value_t
    use lagrangia_namelist_words, only: misread, truth_of
    use lagrangia_number_reader, only: read_number, to_integer
    use lagrangia_text, only: lower, quoted, to_text
    implicit none (type, external)
    private
    public :: get_integer, get_logical, get_real, get_reals, get_string, get_strings

contains

    pure subroutine get_real(tree, group, key, value, error, required, found)
        !! The number at `key`. An absent key leaves `value` as it was, unless `required`.
        type(namelist_t), intent(inout) :: tree
        character(*), intent(in) :: group, key
        real(dp), intent(inout) :: value
        type(error_t), allocatable, intent(out) :: error
        logical, intent(in), optional :: required  !! fail when the key is absent
        logical, intent(out), optional :: found    !! was the key there?
        integer, allocatable :: picked(:)

        call pick(tree, group, key, picked, error, required=required)
        if (present(found)) found = count_of(picked) > 0
        if (allocated(error) .or. count_of(picked) == 0) return
        call convert_real(tree, picked(1), value, error)
    end subroutine get_real

    pure subroutine get_reals(tree, group, key, least, most, values, error, required, found)
        !! From `least` to `most` numbers at `key`, written in a row, with repeat counts or with
        !! indices. An absent key leaves `values` as they were, unless `required`.
        type(namelist_t), intent(inout) :: tree
        character(*), intent(in) :: group, key
        integer, intent(in) :: least, most
        real(dp), allocatable, intent(inout) :: values(:)
        type(error_t), allocatable, intent(out) :: error
        logical, intent(in), optional :: required  !! fail when the key is absent
        logical, intent(out), optional :: found    !! was the key there?
        integer, allocatable :: picked(:)
        real(dp), allocatable :: numbers(:)
        integer :: i

        call pick(tree, group, key, picked, error, least, most, required)
        if (present(found)) found = count_of(picked) > 0
        if (allocated(error) .or. count_of(picked) == 0) return
        allocate (numbers(size(picked)))
        do i = 1, size(picked)
            call convert_real(tree, picked(i), numbers(i), error)
            if (allocated(error)) return
        end do
        call move_alloc(numbers, values)
    end subroutine get_reals

    pure subroutine get_integer(tree, group, key, value, error, required, found)
        !! The whole number at `key`; `1e6` is one. An absent key leaves `value` as it was, unless
        !! `required`.
        type(namelist_t), intent(inout) :: tree
        character(*), intent(in) :: group, key
        integer(i8), intent(inout) :: value
        type(error_t), allocatable, intent(out) :: error
        logical, intent(in), optional :: required  !! fail when the key is absent
        logical, intent(out), optional :: found    !! was the key there?
        character(:), allocatable :: problem
        integer, allocatable :: picked(:)
        integer(i8) :: number

        call pick(tree, group, key, picked, error, required=required)
        if (present(found)) found = count_of(picked) > 0
        if (allocated(error) .or. count_of(picked) == 0) return
        if (tree%values(picked(1))%kind /= kind_number) then
            call refuse_picked(tree, picked(1), "a whole number is needed", error)
            return
        end if
        call to_integer(raw_text(tree, tree%values(picked(1))), number, problem)
        if (len(problem) > 0) then
            call refuse_picked(tree, picked(1), problem, error)
        else
            value = number
        end if
    end subroutine get_integer

    pure subroutine get_logical(tree, group, key, value, error, required, found)
        !! The truth at `key`: `.true.`, `.t.`, `true` or `t`, or their opposites. An absent key
        !! leaves `value` as it was, unless `required`.
        type(namelist_t), intent(inout) :: tree
        character(*), intent(in) :: group, key
        logical, intent(inout) :: value
        type(error_t), allocatable, intent(out) :: error
        logical, intent(in), optional :: required  !! fail when the key is absent
        logical, intent(out), optional :: found    !! was the key there?
        integer, allocatable :: picked(:)

        call pick(tree, group, key, picked, error, required=required)
        if (present(found)) found = count_of(picked) > 0
        if (allocated(error) .or. count_of(picked) == 0) return
        select case (truth_of(raw_text(tree, tree%values(picked(1)))))
        case (1)
            value = .true.
        case (0)
            value = .false.
        case default
            call refuse_picked(tree, picked(1), ".true. or .false. is needed", error)
        end select
    end subroutine get_logical

    pure subroutine get_string(tree, group, key, value, error, required, found)
        !! The text at `key`, refused when it is longer than `value`. An absent key leaves `value`
        !! as it was, unless `required`.
        type(namelist_t), intent(inout) :: tree
        character(*), intent(in) :: group, key
        ! allow(assumed-size-character-intent): nothing is cut
        character(*), intent(inout) :: value
        type(error_t), allocatable, intent(out) :: error
        logical, intent(in), optional :: required  !! fail when the key is absent
        logical, intent(out), optional :: found    !! was the key there?
        integer, allocatable :: picked(:)

        call pick(tree, group, key, picked, error, required=required)
        if (present(found)) found = count_of(picked) > 0
        if (allocated(error) .or. count_of(picked) == 0) return
        call convert_string(tree, picked(1), value, error)
    end subroutine get_string

    pure subroutine get_strings(tree, group, key, least, most, values, error, required, found)
        !! From `least` to `most` texts at `key`, each refused when it is longer than an element of
        !! `values`. An absent key leaves `values` as they were, unless `required`.
        type(namelist_t), intent(inout) :: tree
        character(*), intent(in) :: group, key
        integer, intent(in) :: least, most
        ! allow(assumed-size-character-intent): nothing is cut
        character(*), allocatable, intent(inout) :: values(:)
        type(error_t), allocatable, intent(out) :: error
        logical, intent(in), optional :: required  !! fail when the key is absent
        logical, intent(out), optional :: found    !! was the key there?
        integer, allocatable :: picked(:)
        character(len(values)) :: text
        integer :: i

        call pick(tree, group, key, picked, error, least, most, required)
        if (present(found)) found = count_of(picked) > 0
        if (allocated(error) .or. count_of(picked) == 0) return
        do i = 1, size(picked)
            call convert_string(tree, picked(i), text, error)
            if (allocated(error)) return
        end do
        if (allocated(values)) deallocate (values)
        allocate (values(size(picked)))
        do i = 1, size(picked)
            call convert_string(tree, picked(i), values(i), error)
        end do
    end subroutine get_strings

    pure subroutine convert_real(tree, position, number, error)
        !! The value at `position` as a number.
        type(namelist_t), intent(in) :: tree
        integer, intent(in) :: position
        real(dp), intent(inout) :: number
        type(error_t), allocatable, intent(out) :: error
        character(:), allocatable :: problem, word
        real(dp) :: meant

        associate (value => tree%values(position))
            if (value%kind == kind_number) then
                number = value%number
                return
            end if
            word = lower(raw_text(tree, value))
        end associate
        select case (word)
        case ("inf", "infinity", "nan")
            call refuse_picked(tree, position, "a finite number is needed", error)
        case default
            call read_number(text_of(tree, tree%values(position)), meant, problem)
            if (len(problem) == 0) then
                problem = "a number is needed, without quotes"
            else
                call misread(text_of(tree, tree%values(position)), word, problem)
                if (problem == "") problem = "a number is needed, such as 0.01"
            end if
            call refuse_picked(tree, position, problem, error)
        end select
    end subroutine convert_real

    pure subroutine convert_string(tree, position, text, error)
        !! The value at `position` as a text that fits into `text`.
        type(namelist_t), intent(in) :: tree
        integer, intent(in) :: position
        ! allow(assumed-size-character-intent): nothing is cut
        character(*), intent(inout) :: text
        type(error_t), allocatable, intent(out) :: error
        character(:), allocatable :: full

        associate (value => tree%values(position))
            full = text_of(tree, value)
            if (value%kind == kind_number .or. &
                (value%kind /= kind_string .and. value%line > 0)) then
                call refuse_picked(tree, position, "a text is needed, in quotes: "// &
                                   quoted(full, 20), error)
            else if (len_trim(full) > len(text)) then
                call refuse_picked(tree, position, "a text of at most "//to_text(len(text))// &
                                   " characters is needed", error)
            else
                text = full
            end if
        end associate
    end subroutine convert_string
end module lagrangia_namelist_access
