module lagrangia_namelist
    !! Strict reading of namelist files: the one module others use.
    !!
    !! `parse_namelist` (and `apply_override`), then `get_...` for every key there may be, then
    !! `refuse_unknown_keys` and `refuse_unknown_groups`. Each value comes whole, as what it was
    !! written, or is refused with its place, group, key and value. Names of groups and keys are in
    !! lower case; `key` is given to these procedures without its group.
    use lagrangia_comma_remedy, only: comma_remedy
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_namelist_lexer, only: stray, truth_of
    use lagrangia_namelist_parser, only: apply_override, parse_namelist
    use lagrangia_namelist_tree, only: drop_key, fail_at, find_entry, find_group, in_override, &
                                       is_overridden, kind_number, kind_string, kind_word, &
                                       label, namelist_t, raw_text, &
                                       refuse_missing, refuse_picked, refuse_unknown_groups, &
                                       refuse_unknown_keys, spelling, text_of, value_t
    use lagrangia_number_reader, only: misread, read_number, to_integer
    use lagrangia_text, only: escaped, lower, quoted, to_text
    use lagrangia_torn_numbers, only: mended
    implicit none (type, external)
    private
    public :: apply_override, drop_key, get_integer, get_logical, get_real, get_reals, &
              get_string, get_strings, has_group, has_key, is_overridden, namelist_t, &
              parse_namelist, point_advice, &
              refuse_unknown_groups, refuse_unknown_keys, refuse_value

contains

    pure subroutine get_real(tree, group, key, value, error, required)
        !! The number at `key`.
        type(namelist_t), intent(inout) :: tree           !! its key is marked as used
        character(*), intent(in) :: group, key            !! in lower case
        real(dp), intent(inout) :: value                  !! stays as it was where the key is absent
        type(error_t), allocatable, intent(out) :: error  !! status 2: the place, and what is needed
        logical, intent(in), optional :: required         !! fail when the key is absent
        integer, allocatable :: picked(:)

        call pick(tree, group, key, picked, error, required=required)
        if (size(picked) == 1) call convert_real(tree, picked(1), value, error)
    end subroutine get_real

    pure subroutine get_reals(tree, group, key, least, most, values, error, required)
        !! The numbers at `key`, written in a row, with repeat counts or with indices. Where only
        !! elements are written, as in `v(2) = 0.5`, the others stay as they were.
        type(namelist_t), intent(inout) :: tree    !! its key is marked as used
        character(*), intent(in) :: group, key  !! in lower case
        integer, intent(in) :: least, most         !! how many there may be
        real(dp), allocatable, intent(inout) :: values(:)  !! stay where the key is absent
        type(error_t), allocatable, intent(out) :: error  !! status 2: the place, and what is needed
        logical, intent(in), optional :: required  !! fail when the key is absent
        integer, allocatable :: picked(:)
        real(dp), allocatable :: numbers(:)
        integer :: i, stay

        stay = 0
        if (allocated(values)) stay = size(values)
        call pick(tree, group, key, picked, error, least, most, required, stay)
        if (size(picked) == 0) return
        allocate (numbers(size(picked)))
        do i = 1, size(picked)
            if (picked(i) == 0) then
                numbers(i) = values(i)
                cycle
            end if
            call convert_real(tree, picked(i), numbers(i), error)
            if (allocated(error)) return
        end do
        call move_alloc(numbers, values)
    end subroutine get_reals

    pure subroutine get_integer(tree, group, key, value, error)
        !! The whole number at `key`; `1e6` is one.
        type(namelist_t), intent(inout) :: tree           !! its key is marked as used
        character(*), intent(in) :: group, key            !! in lower case
        integer(i8), intent(inout) :: value               !! stays as it was where the key is absent
        type(error_t), allocatable, intent(out) :: error  !! status 2: the place, and what is needed
        character(:), allocatable :: problem
        integer, allocatable :: picked(:)
        integer(i8) :: number

        call pick(tree, group, key, picked, error)
        if (size(picked) == 0) return
        problem = "a whole number is needed"
        if (tree%values(picked(1))%kind == kind_number) then
            call to_integer(raw_text(tree, tree%values(picked(1))), number, problem)
        end if
        if (problem /= "") then
            call refuse_picked(tree, picked(1), problem, error)
        else
            value = number
        end if
    end subroutine get_integer

    pure subroutine get_logical(tree, group, key, value, error)
        !! The truth at `key`: `.true.`, `.t.`, `true` or `t`, or their opposites.
        type(namelist_t), intent(inout) :: tree           !! its key is marked as used
        character(*), intent(in) :: group, key            !! in lower case
        logical, intent(inout) :: value                   !! stays as it was where the key is absent
        type(error_t), allocatable, intent(out) :: error  !! status 2: the place, and what is needed
        integer, allocatable :: picked(:)
        integer :: truth

        call pick(tree, group, key, picked, error)
        if (size(picked) == 0) return
        truth = truth_of(raw_text(tree, tree%values(picked(1))))
        if (truth < 0) then
            call refuse_picked(tree, picked(1), ".true. or .false. is needed", error)
        else
            value = truth == 1
        end if
    end subroutine get_logical

    pure subroutine get_string(tree, group, key, value, error, required)
        !! The text at `key`.
        type(namelist_t), intent(inout) :: tree  !! its key is marked as used
        character(*), intent(in) :: group, key   !! in lower case
        ! allow(assumed-size-character-intent): nothing is cut
        character(*), intent(inout) :: value       !! stays where the key is absent; must hold it
        type(error_t), allocatable, intent(out) :: error  !! status 2: the place, and what is needed
        logical, intent(in), optional :: required  !! fail when the key is absent
        integer, allocatable :: picked(:)

        call pick(tree, group, key, picked, error, required=required)
        if (size(picked) == 1) call convert_string(tree, picked(1), value, error)
    end subroutine get_string

    pure subroutine get_strings(tree, group, key, least, most, values, error, required)
        !! The texts at `key`.
        type(namelist_t), intent(inout) :: tree  !! its key is marked as used
        character(*), intent(in) :: group, key   !! in lower case
        integer, intent(in) :: least, most       !! how many there may be
        ! allow(assumed-size-character-intent): nothing is cut
        character(*), allocatable, intent(inout) :: values(:)  !! as `value` of `get_string`
        type(error_t), allocatable, intent(out) :: error  !! status 2: the place, and what is needed
        logical, intent(in), optional :: required  !! fail when the key is absent
        integer, allocatable :: picked(:)
        character(len(values)), allocatable :: texts(:)
        integer :: i

        call pick(tree, group, key, picked, error, least, most, required)
        if (size(picked) == 0) return
        allocate (texts(size(picked)))
        do i = 1, size(picked)
            call convert_string(tree, picked(i), texts(i), error)
            if (allocated(error)) return
        end do
        call move_alloc(texts, values)
    end subroutine get_strings

    pure function has_group(tree, group) result(yes)
        !! Is there such a group?
        type(namelist_t), intent(in) :: tree  !! of a file
        character(*), intent(in) :: group     !! in lower case
        logical :: yes

        yes = find_group(tree, group) > 0
    end function has_group

    pure function has_key(tree, group, key) result(yes)
        !! Is there such a key in such a group?
        type(namelist_t), intent(in) :: tree    !! of a file
        character(*), intent(in) :: group, key  !! in lower case
        logical :: yes

        yes = find_entry(tree, group, key) > 0
    end function has_key

    pure subroutine pick(tree, group, key, picked, error, least, most, required, stay)
        !! Find the values of `key`, element by element, and mark it as used; none on failure. Of
        !! the first `stay` elements 0 stands for one that is not written where another is, with its
        !! index.
        type(namelist_t), intent(inout) :: tree
        character(*), intent(in) :: group, key
        integer, allocatable, intent(out) :: picked(:)       !! positions among the values
        type(error_t), allocatable, intent(out) :: error
        integer, intent(in), optional :: least, most         !! absent: one value, no array
        logical, intent(in), optional :: required
        integer, intent(in), optional :: stay                !! absent: 0
        logical :: whole  !! some entry gives all elements
        integer :: i, owner, position

        whole = .false.
        allocate (picked(0))
        owner = find_group(tree, group)
        if (owner > 0) tree%groups(owner)%used = .true.
        position = 0
        do i = 1, tree%entry_count
            associate (item => tree%entries(i))
                if (owner == 0 .or. item%group /= owner .or. item%key /= key) cycle
                item%used = .true.
                if (item%replaced) cycle
                position = item%at
                whole = whole .or. item%index == 0
                if (item%index == 0 .or. present(least)) cycle
                call fail_at(tree, position, label(group, key)//" is a single value; write "// &
                             escaped(key, 30)//" = value, without an index", error)
                return
            end associate
        end do
        if (position > 0) then
            picked = elements(tree, group, key)
            if (present(stay) .and. .not. whole) then
                if (size(picked) <= stay) then
                    picked = [picked, [(0, i=size(picked) + 1, stay)]]
                    return
                end if
            end if
            call check_elements(tree, picked, position, label(group, key), error, least, most)
            if (allocated(error)) picked = [integer ::]
        else if (present(required)) then
            if (required) call refuse_missing(tree, owner, group, key, error)
        end if
    end subroutine pick

    pure function elements(tree, group, key) result(picked)
        !! The position of the value of each element of `key`, 0 where there is none; later entries
        !! prevail.
        type(namelist_t), intent(in) :: tree
        character(*), intent(in) :: group, key
        integer, allocatable :: picked(:)
        integer :: i, k, last, owner

        owner = find_group(tree, group)
        allocate (picked(0))
        do i = 1, merge(tree%entry_count, 0, owner > 0)
            associate (item => tree%entries(i))
                if (item%group /= owner .or. item%key /= key .or. item%replaced) cycle
                last = max(1, item%index) - 1
                if (last + item%count > size(picked)) then
                    picked = [picked, [(0, k=size(picked) + 1, last + item%count)]]
                end if
                do k = item%first_value, item%last_value
                    picked(last + 1:last + tree%values(k)%repeats) = k
                    last = last + tree%values(k)%repeats
                end do
            end associate
        end do
    end function elements

    pure subroutine check_elements(tree, picked, position, name, error, least, most)
        !! Refuse a hole, a number of values outside `least` to `most`, or then a word among them
        !! that is none.
        type(namelist_t), intent(in) :: tree
        integer, intent(in) :: picked(:), position
        character(*), intent(in) :: name
        type(error_t), allocatable, intent(out) :: error
        integer, intent(in), optional :: least, most
        character(:), allocatable :: allowed
        integer :: high, i, length, low

        length = size(picked)
        low = 1
        high = 1
        if (present(least)) low = least
        if (present(most)) high = most
        i = findloc(picked, 0, 1)
        if (i > 0) then
            call fail_at(tree, position, name//": element "//to_text(i)//" has no value", error)
        end if
        if (i > 0 .or. (length >= low .and. length <= high)) return
        do i = 1, length
            associate (value => tree%values(picked(i)))
                if (value%kind /= kind_word) cycle
                if (in_override(tree, value%first)) then
                    if (.not. is_unit(tree, picked, i)) cycle
                    call refuse_picked(tree, picked(i), "units are not written: all are SI, "// &
                                       "angles in radians", error)
                else
                    if (truth_of(raw_text(tree, value)) >= 0) cycle
                    call refuse_picked(tree, picked(i), stray, error)
                end if
                return
            end associate
        end do
        allowed = to_text(low)
        if (low == high .and. high == 1) allowed = "one"
        if (high > low) allowed = "from "//to_text(low)//" to "//to_text(high)
        call fail_at(tree, position, name//" has "//to_text(length)//" value"// &
                     trim(merge("s", " ", length /= 1))//"; "//allowed// &
                     trim(merge(" is ", " are", high == 1))//" needed"// &
                     mended(tree, picked, low, high)// &
                     trim(merge("; 3*x means x, x, x", "                   ", &
                                any(tree%values(picked)%repeats > 1))), error)
    end subroutine check_elements

    pure function is_unit(tree, picked, i) result(yes)
        !! Is value `i` of those at `picked` a word behind a number and a blank, as in `5 s`?
        type(namelist_t), intent(in) :: tree
        integer, intent(in) :: picked(:), i
        logical :: yes

        yes = i > 1
        if (.not. yes) return
        associate (left => tree%values(picked(i - 1)), right => tree%values(picked(i)))
            yes = left%kind == kind_number .and. index(tree%text(left%last:right%first), ",") == 0
        end associate
    end function is_unit

    pure function point_advice(tree, group, key, count) result(remedy)
        !! What a caller who needs `count` values of `key`, and got another number of them, may add
        !! to its message: `; a decimal point, no comma: 0.01`, or nothing.
        type(namelist_t), intent(in) :: tree    !! of a file
        character(*), intent(in) :: group, key  !! in lower case
        integer, intent(in) :: count            !! values that are needed
        character(:), allocatable :: remedy

        remedy = mended(tree, elements(tree, group, key), count, count)
    end function point_advice

    pure subroutine convert_real(tree, position, number, error)
        !! The value at `position` as a number.
        type(namelist_t), intent(in) :: tree
        integer, intent(in) :: position
        real(dp), intent(inout) :: number
        type(error_t), allocatable, intent(out) :: error
        character(:), allocatable :: phrase, problem, text
        real(dp) :: meant

        if (tree%values(position)%kind == kind_number) then
            number = tree%values(position)%number
            return
        end if
        text = text_of(tree, tree%values(position))
        call read_number(text, meant, problem)
        select case (lower(raw_text(tree, tree%values(position))))
        case ("inf", "infinity", "nan")
            problem = "a finite number is needed"
        case default
            if (problem == "") then
                problem = "a number is needed, without quotes"
            else
                call misread(text, phrase, problem)
                if (problem == "") problem = "a number is needed, such as 0.01"
            end if
        end select
        call refuse_picked(tree, position, problem, error)
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
                (value%kind == kind_word .and. .not. in_override(tree, value%first))) then
                call refuse_picked(tree, position, "a text is needed, in quotes: "// &
                                   quoted(full, 20)//comma_remedy(tree, value%first), error)
            else if (len_trim(full) > len(text)) then
                call refuse_picked(tree, position, "a text of at most "//to_text(len(text))// &
                                   " characters is needed", error)
            else
                text = full
            end if
        end associate
    end subroutine convert_string

    pure subroutine refuse_value(tree, group, key, problem, error, element, column)
        !! For checks that only the caller can make: refuse the value of `key` (or of one
        !! `element`) with its place, as in `a.nml:3:8: &scene: dt = -1: must be positive`; with a
        !! `column`, one character of a text, as in `a.nml:3:12: &scene: title: is no word`.
        type(namelist_t), intent(in) :: tree              !! of a file
        character(*), intent(in) :: group, key            !! in lower case
        character(*), intent(in) :: problem               !! what is wrong with it
        type(error_t), allocatable, intent(out) :: error  !! status 2: that message
        integer, intent(in), optional :: element          !! from 1
        integer, intent(in), optional :: column           !! from 1, in what `get_strings` gives
        integer, allocatable :: picked(:)
        integer :: at, i, position

        allocate (picked, source=elements(tree, group, key))
        i = 1
        if (present(element)) i = max(1, element)
        position = 0
        if (i <= size(picked)) position = picked(i)
        at = 0
        if (present(column)) at = column
        if (position > 0 .and. at > 0) then
            i = find_entry(tree, group, key)
            at = byte_of(tree, tree%values(position), at)
            call fail_at(tree, at, label(group, spelling(tree, tree%entries(i)))//": "// &
                         problem, error)
        else if (position > 0) then
            call refuse_picked(tree, position, problem, error)
        else
            i = find_group(tree, group)
            if (i > 0) position = tree%groups(i)%at
            call fail_at(tree, position, label(group, key)//": "//problem, error)
        end if
    end subroutine refuse_value

    pure function byte_of(tree, value, column) result(at)
        !! Where the tree's text has the character `column` of what `text_of` gives, several bytes
        !! of UTF-8 being one; at most the end of the value.
        type(namelist_t), intent(in) :: tree
        type(value_t), intent(in) :: value
        integer, intent(in) :: column
        integer :: at
        integer :: i

        at = value%first
        if (value%kind == kind_string) at = at + 1
        do i = 2, column
            if (at >= value%last) exit
            ! a doubled quote is one character
            if (value%kind == kind_string .and. &
                tree%text(at:at) == tree%text(value%first:value%first)) at = at + 1
            at = at + 1
            do while (at < value%last .and. iand(ichar(tree%text(at:at)), 192) == 128)
                at = at + 1
            end do
        end do
        at = min(at, value%last)
    end function byte_of
end module lagrangia_namelist
