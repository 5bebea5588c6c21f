module lagrangia_namelist_unknown
    !! Which keys and groups a namelist has; refusing those that are missing or unknown.
    use lagrangia_errors, only: error_t
    use lagrangia_namelist_tree, only: fail_at, find_group, name_length, namelist_t, place_t
    use lagrangia_names, only: abbreviation, nearest_name
    use lagrangia_text, only: escaped, join, quoted
    implicit none (type, external)
    private
    public :: has_group, has_key, label, refuse_missing, refuse_unknown_groups, &
              refuse_unknown_keys

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

    pure function label(group, key) result(text)
        !! `&group: key`
        character(*), intent(in) :: group, key
        character(:), allocatable :: text

        text = "&"//escaped(trim(group), 30)//": "//escaped(trim(key), 30)
    end function label

    pure subroutine refuse_missing(tree, owner, group, key, error)
        !! Demand `key`, or its whole group, if nothing there seems to be a slip for it.
        type(namelist_t), intent(in) :: tree
        integer, intent(in) :: owner
        character(*), intent(in) :: group, key
        type(error_t), allocatable, intent(out) :: error

        character(name_length), allocatable :: keys(:)
        character(:), allocatable :: near
        integer :: i

        if (owner == 0) then
            allocate (keys, source=[(tree%groups(i)%name, i=1, tree%group_count)])
            near = nearest_name(group, keys)
            i = find_group(tree, near)
            if (i > 0) then
                call fail_at(error, tree%groups(i)%place, advice("group ", near, [group]))
                return
            end if
            call fail_at(error, place_t(tree%source), "group &"//escaped(group, 30)// &
                         " is missing; it must give "//escaped(key, 30))
        else
            associate (items => tree%entries(:tree%entry_count))
                allocate (keys, source=pack( &
                    [(items(i)%key, i=1, size(items))], &
                    [(items(i)%group == owner .and. .not. items(i)%used, i=1, size(items))]))
            end associate
            near = nearest_name(key, keys)
            if (near /= "") then
                i = last_entry(tree, group, near)
                call fail_at(error, tree%entries(i)%place, "&"//escaped(group, 30)//": "// &
                             advice("key ", near, [key]))
                return
            end if
            call fail_at(error, tree%groups(owner)%place, label(group, key)// &
                         " is missing; write "//escaped(key, 30)//" = value")
        end if
    end subroutine refuse_missing

    pure subroutine refuse_unknown_keys(tree, group, allowed, error, early)
        !! Refuse the first key of `group` that nobody has asked for, naming the nearest of the
        !! `allowed` ones, or those that are not given. `early`: somebody may still ask for those.
        type(namelist_t), intent(in) :: tree
        character(*), intent(in) :: group, allowed(:)
        type(error_t), allocatable, intent(out) :: error
        logical, intent(in), optional :: early
        character(len(allowed)), allocatable :: absent(:)
        logical :: spared
        integer :: i, k, owner

        spared = .false.
        if (present(early)) spared = early
        owner = find_group(tree, group)
        do i = 1, tree%entry_count
            associate (item => tree%entries(i))
                if (item%group /= owner .or. item%used .or. item%replaced) cycle
                if (spared .and. any(allowed == item%key)) cycle
                allocate (absent, source=pack(allowed, &
                    [(item%overrides .or. item%key == allowed(k) .or. &
                      .not. has_key(tree, group, allowed(k)), k=1, size(allowed))]))
                call fail_at(error, item%place, "&"//escaped(trim(group), 30)//": "// &
                             advice("key ", trim(item%key), absent))
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
        character(:), allocatable :: text
        integer :: i

        do i = 1, tree%group_count
            if (tree%groups(i)%used) cycle
            text = advice("group ", trim(tree%groups(i)%name), allowed)
            if (tree%groups(i)%place%line == 0) text = text//" (in "//trim(tree%source)//")"
            call fail_at(error, tree%groups(i)%place, text)
            return
        end do
    end subroutine refuse_unknown_groups

    pure function advice(what, name, allowed) result(text)
        !! What to do about a `name` that is of no use.
        character(*), intent(in) :: what, name, allowed(:)
        character(:), allocatable :: text
        character(:), allocatable :: near

        near = nearest_name(name, allowed)
        if (near == "") near = abbreviation(name, allowed)
        if (any(allowed == name)) then
            text = what//quoted(name)//" has no meaning here"
        else if (near /= "") then
            text = "unknown "//what//quoted(name)//"; did you mean "//quoted(near)//"?"
        else if (size(allowed) == 0) then
            text = "unknown "//what//quoted(name)//"; none is allowed here"
        else
            text = "unknown "//what//quoted(name)//"; allowed: "// &
                   escaped(join(allowed, ", "), 160)
        end if
    end function advice
end module lagrangia_namelist_unknown
