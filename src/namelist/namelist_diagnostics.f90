module lagrangia_namelist_diagnostics
    !! What to say of a value, a key or a group of a namelist that cannot be taken, and of those
    !! that are missing: where it is, what is wrong, and what was probably meant.
    use lagrangia_errors, only: error_t
    use lagrangia_namelist_tree, only: fail_at, find_entry, find_group, in_override, kind_number, &
                                       label, name_length, namelist_t, raw_text
    use lagrangia_names, only: abbreviation, nearest_name
    use lagrangia_text, only: escaped, join, quoted
    implicit none (type, external)
    private
    public :: decimal_points, refuse_missing, refuse_picked, refuse_unknown_groups, &
              refuse_unknown_keys

contains

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
            call fail_at(tree, value%first, label(tree%groups(item%group)%name, item%key)// &
                         " = "//escaped(raw_text(tree, value))//": "//problem, error)
        end associate
    end subroutine refuse_picked

    pure function decimal_points(tree, picked, low, high) result(remedy)
        !! What to write if the values at the positions `picked` came apart at decimal commas, and
        !! together would be from `low` to `high`; otherwise nothing.
        type(namelist_t), intent(in) :: tree
        integer, intent(in) :: picked(:), low, high
        character(:), allocatable :: remedy
        character(:), allocatable :: behind, number
        integer :: i, n

        remedy = ""
        behind = ""
        if (any(picked == 0)) return
        if (any(tree%values(picked)%kind /= kind_number)) return
        n = 0
        i = 1
        do while (i <= size(picked))
            number = raw_text(tree, tree%values(picked(i)))
            i = i + 1
            if (i <= size(picked)) then
                associate (left => tree%values(picked(i - 1)), right => tree%values(picked(i)))
                    behind = tree%text(left%last + 1:right%first - 1)
                    if (behind//"|" == ",|" .and. verify(number, "+-0123456789") == 0) then
                        behind = raw_text(tree, right)
                        if (verify(behind, "0123456789") == 0 .and. len(behind) == 3 .and. &
                            scan(number, "123456789") > 0) behind = behind//" (or "// &
                            number//behind//")"
                        number = number//"."//behind
                        i = i + 1
                    end if
                end associate
            end if
            n = n + 1
            remedy = remedy//", "//number
        end do
        if (n == size(picked) .or. n < low .or. n > high) then
            remedy = ""
        else
            remedy = "; a decimal point, no comma: "//escaped(remedy(3:))
        end if
    end function decimal_points

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
                call fail_at(tree, tree%groups(i)%at, advice("group ", near, [group]), error)
                return
            end if
            call fail_at(tree, 0, "group &"//escaped(group, 30)// &
                         " is missing; it must give "//escaped(key, 30), error)
        else
            associate (items => tree%entries(:tree%entry_count))
                allocate (keys, source=pack( &
                    [(items(i)%key, i=1, size(items))], &
                    [(items(i)%group == owner .and. .not. items(i)%used, i=1, size(items))]))
            end associate
            near = nearest_name(key, keys)
            if (near /= "") then
                i = find_entry(tree, group, near)
                call fail_at(tree, tree%entries(i)%at, "&"//escaped(group, 30)//": "// &
                             advice("key ", near, [key]), error)
                return
            end if
            call fail_at(tree, tree%groups(owner)%at, label(group, key)// &
                         " is missing; write "//escaped(key, 30)//" = value", error)
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
                    [(in_override(tree, item%at) .or. item%key == allowed(k) .or. &
                      find_entry(tree, group, allowed(k)) == 0, k=1, size(allowed))]))
                call fail_at(tree, item%at, "&"//escaped(trim(group), 30)//": "// &
                             advice("key ", trim(item%key), absent), error)
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
            if (in_override(tree, tree%groups(i)%at)) text = text//" (in "//trim(tree%source)//")"
            call fail_at(tree, tree%groups(i)%at, text, error)
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
end module lagrangia_namelist_diagnostics
