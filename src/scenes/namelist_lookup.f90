module lagrangia_namelist_lookup
    !! Finding keys in a namelist, and refusing those nobody asked for.
    use lagrangia_errors, only: error_t
    use lagrangia_namelist_tree, only: fail_at, find_group, namelist_t, place_t, raw_text
    use lagrangia_text, only: escaped, join, nearest_name, quoted, to_text
    implicit none (type, external)
    private
    public :: count_of, has_group, has_key, pick, refuse_picked, refuse_unknown_groups, &
              refuse_unknown_keys, refuse_value

contains

    pure function has_group(tree, group) result(yes)
        !! Is there such a group? Names are in lower case.
        type(namelist_t), intent(in) :: tree
        character(*), intent(in) :: group
        logical :: yes

        yes = find_group(tree, group) > 0
    end function has_group

    pure function has_key(tree, group, key) result(yes)
        !! Is there such a key in such a group? Names are in lower case.
        type(namelist_t), intent(in) :: tree
        character(*), intent(in) :: group, key
        logical :: yes

        yes = last_entry(tree, group, key) > 0
    end function has_key

    pure function last_entry(tree, group, key) result(position)
        !! The position of the last entry that gives `key`, 0 when there is none.
        type(namelist_t), intent(in) :: tree
        character(*), intent(in) :: group, key
        integer :: position
        integer :: owner

        owner = find_group(tree, group)
        do position = merge(tree%entry_count, 0, owner > 0), 1, -1
            if (tree%entries(position)%group == owner .and. tree%entries(position)%key == key) exit
        end do
    end function last_entry

    pure function count_of(picked) result(number)
        !! How many values were picked.
        integer, allocatable, intent(in) :: picked(:)
        integer :: number

        number = 0
        if (allocated(picked)) number = size(picked)
    end function count_of

    pure subroutine pick(tree, group, key, picked, error, least, most, required)
        !! Find the values of `key`, element by element, and mark it as used.
        type(namelist_t), intent(inout) :: tree
        character(*), intent(in) :: group, key
        integer, allocatable, intent(out) :: picked(:)       !! positions among the values
        type(error_t), allocatable, intent(out) :: error
        integer, intent(in), optional :: least, most         !! absent: one value, no array
        logical, intent(in), optional :: required
        integer :: i, length, owner, place

        owner = find_group(tree, group)
        if (owner > 0) tree%groups(owner)%used = .true.
        length = 0
        place = 0
        do i = 1, tree%entry_count
            associate (item => tree%entries(i))
                if (owner == 0 .or. item%group /= owner .or. item%key /= key) cycle
                item%used = .true.
                if (item%replaced) cycle
                place = i
                length = max(length, max(1, item%index) + item%count - 1)
                if (item%index == 0 .or. present(least)) cycle
                call fail_at(error, item%place, label(group, key)//" is a single value; write "// &
                             escaped(key, 30)//" = value, without an index")
                return
            end associate
        end do
        allocate (picked(length), source=0)
        if (place == 0) then
            if (present(required)) then
                if (required) call refuse_missing(tree, owner, group, key, error)
            end if
            return
        end if
        call fill(tree, owner, key, picked)
        do i = 1, length
            if (picked(i) == 0) then
                call fail_at(error, tree%entries(place)%place, label(group, key)// &
                             ": element "//to_text(i)//" has no value")
                return
            end if
        end do
        call check_count(length, tree%entries(place)%place, label(group, key), error, least, most)
    end subroutine pick

    pure subroutine fill(tree, owner, key, picked)
        !! Put the position of each element's value into `picked`; later entries prevail.
        type(namelist_t), intent(in) :: tree
        integer, intent(in) :: owner
        character(*), intent(in) :: key
        integer, intent(inout) :: picked(:)
        integer :: element, i, k

        do i = 1, tree%entry_count
            associate (item => tree%entries(i))
                if (item%group /= owner .or. item%key /= key .or. item%replaced) cycle
                element = max(1, item%index)
                do k = item%first_value, item%last_value
                    picked(element:element + tree%values(k)%repeats - 1) = k
                    element = element + tree%values(k)%repeats
                end do
            end associate
        end do
    end subroutine fill

    pure subroutine check_count(length, place, name, error, least, most)
        !! Refuse a number of values outside `least` to `most`.
        integer, intent(in) :: length
        type(place_t), intent(in) :: place
        character(*), intent(in) :: name
        type(error_t), allocatable, intent(out) :: error
        integer, intent(in), optional :: least, most
        character(:), allocatable :: allowed
        integer :: high, low

        low = 1
        high = 1
        if (present(least)) low = least
        if (present(most)) high = most
        if (length >= low .and. length <= high) return
        allowed = to_text(low)
        if (low == high .and. high == 1) allowed = "one"
        if (high > low) allowed = "from "//to_text(low)//" to "//to_text(high)
        call fail_at(error, place, name//" has "//to_text(length)//" value"// &
                     trim(merge("s", " ", length /= 1))//"; "//allowed// &
                     trim(merge(" is ", " are", high == 1))//" needed")
    end subroutine check_count

    pure function label(group, key) result(text)
        !! `&group: key`
        character(*), intent(in) :: group, key
        character(:), allocatable :: text

        text = "&"//escaped(trim(group), 30)//": "//escaped(trim(key), 30)
    end function label

    pure subroutine refuse_missing(tree, owner, group, key, error)
        !! Demand `key`, or its whole group.
        type(namelist_t), intent(in) :: tree
        integer, intent(in) :: owner
        character(*), intent(in) :: group, key
        type(error_t), allocatable, intent(out) :: error

        if (owner == 0) then
            call fail_at(error, place_t(tree%source), "group &"//escaped(group, 30)// &
                         " is missing; it must give "//escaped(key, 30))
        else
            call fail_at(error, tree%groups(owner)%place, label(group, key)// &
                         " is missing; write "//escaped(key, 30)//" = value")
        end if
    end subroutine refuse_missing

    pure subroutine refuse_picked(tree, position, problem, error)
        !! Fail with the place, group, key and text of the value at `position`, and `problem`.
        type(namelist_t), intent(in) :: tree
        integer, intent(in) :: position
        character(*), intent(in) :: problem
        type(error_t), allocatable, intent(out) :: error
        integer :: i

        do i = 1, tree%entry_count - 1
            if (tree%entries(i)%last_value >= position) exit
        end do
        associate (item => tree%entries(i), value => tree%values(position))
            call fail_at(error, place_t(item%place%source, value%line, value%column), &
                         label(tree%groups(item%group)%name, item%key)//" = "// &
                         escaped(raw_text(tree, value))//": "//problem)
        end associate
    end subroutine refuse_picked

    pure subroutine refuse_value(tree, group, key, problem, error, element)
        !! For checks that only the caller can make: refuse the value of `key` (or of one
        !! `element`) with its place, as in `a.nml:3:8: &scene: dt = -1: must be positive`.
        type(namelist_t), intent(inout) :: tree
        character(*), intent(in) :: group, key, problem
        type(error_t), allocatable, intent(out) :: error
        integer, intent(in), optional :: element
        integer, allocatable :: picked(:)
        type(error_t), allocatable :: ignored
        integer :: i, position

        call pick(tree, group, key, picked, ignored, 1, huge(1))
        i = 1
        if (present(element)) i = max(1, element)
        position = 0
        if (i <= count_of(picked)) position = picked(i)
        if (position > 0) then
            call refuse_picked(tree, position, problem, error)
        else
            call fail_at(error, place_t(tree%source), label(group, key)//": "//problem)
        end if
    end subroutine refuse_value

    pure subroutine refuse_unknown_keys(tree, group, allowed, error)
        !! Refuse the first key of `group` that nobody has asked for, naming the nearest of the
        !! `allowed` ones.
        type(namelist_t), intent(in) :: tree
        character(*), intent(in) :: group, allowed(:)
        type(error_t), allocatable, intent(out) :: error
        integer :: i, owner

        owner = find_group(tree, group)
        do i = 1, tree%entry_count
            associate (item => tree%entries(i))
                if (item%group /= owner .or. item%used .or. item%replaced) cycle
                call fail_at(error, item%place, "&"//escaped(trim(group), 30)//": "// &
                             advice("key ", trim(item%key), allowed))
                return
            end associate
        end do
    end subroutine refuse_unknown_keys

    pure subroutine refuse_unknown_groups(tree, allowed, error)
        !! Refuse the first group from which nobody has asked for a key, naming the nearest of the
        !! `allowed` ones.
        type(namelist_t), intent(in) :: tree
        character(*), intent(in) :: allowed(:)
        type(error_t), allocatable, intent(out) :: error
        integer :: i

        do i = 1, tree%group_count
            if (tree%groups(i)%used) cycle
            call fail_at(error, tree%groups(i)%place, &
                         advice("group ", trim(tree%groups(i)%name), allowed))
            return
        end do
    end subroutine refuse_unknown_groups

    pure function advice(what, name, allowed) result(text)
        !! What to do about a `name` that is of no use.
        character(*), intent(in) :: what, name, allowed(:)
        character(:), allocatable :: text

        if (any(allowed == name)) then
            text = what//quoted(name)//" has no meaning here"
        else if (nearest_name(name, allowed) /= "") then
            text = "unknown "//what//quoted(name)//"; did you mean "// &
                   quoted(nearest_name(name, allowed))//"?"
        else if (size(allowed) == 0) then
            text = "unknown "//what//quoted(name)//"; none is allowed here"
        else
            text = "unknown "//what//quoted(name)//"; allowed: "// &
                   escaped(join(allowed, ", "), 120)
        end if
    end function advice
end module lagrangia_namelist_lookup
