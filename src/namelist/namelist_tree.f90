module lagrangia_namelist_tree
    !! What a namelist file and its overrides say, as plain data: groups, entries and values, where
    !! each was written; and the refusal of what is unknown or missing, with what was meant.
    use lagrangia_errors, only: error_t, fail, status_usage
    use lagrangia_kinds, only: dp
    use lagrangia_names, only: abbreviation, nearest_name
    use lagrangia_text, only: escaped, listed, quoted, short_source, source_length, to_text
    implicit none (type, external)
    private
    public :: entry_t, group_t, namelist_t, value_t
    public :: add_entry, add_group, add_value, drop_key, fail_at, find_entry, find_group, &
              in_override, is_overridden, label, line_of, new_namelist, raw_text, refuse_missing, &
              refuse_picked, refuse_unknown_groups, refuse_unknown_keys, settle_twins, spelling, &
              text_of, kind_number, kind_string, kind_word, max_values, name_length, no_text, &
              one_text, some_texts

    integer, parameter :: name_length = 63    !! of a group or key, as in Fortran
    integer, parameter :: max_groups = 100, max_entries = 1000, max_values = 10000
    !! in one file with its overrides, values with their repeats
    integer, parameter :: few = 64  !! entries and values: there is room at once
    integer, parameter :: no_text = 0, one_text = 1, some_texts = 2  !! of a key, as far as known
    character(*), parameter :: whole = "lagrangia describe scene"  !! shows all keys

    integer, parameter :: kind_number = 1  !! a finite number
    integer, parameter :: kind_string = 2  !! text between quotes
    integer, parameter :: kind_word = 3    !! bare text: a logical, or a string of an override

    type :: value_t
        !! One value, or several equal ones (`3*0.0`).
        integer :: kind = kind_word
        integer :: first = 1, last = 0    !! its bytes in the tree's text, with the quotes
        integer :: repeats = 1
        real(dp) :: number = 0.0_dp       !! for `kind_number`
    end type value_t

    type :: entry_t
        !! `key = values` or `key(index) = values`.
        character(name_length) :: key = ""
        integer :: at = 0                           !! where the tree's text has the key
        integer :: group = 0                        !! position among the groups
        integer :: index = 0                        !! 0 where none was written
        integer :: first_value = 1, last_value = 0  !! positions among the values
        integer :: count = 0                        !! of values, repeats counted
        logical :: replaced = .false.               !! by a later override
        logical :: used = .false.                   !! somebody asked for it
    end type entry_t

    type :: group_t
        !! `&name ... /`
        character(name_length) :: name = ""
        integer :: at = 0          !! where the tree's text has it
        logical :: used = .false.  !! somebody asked for a key of it
    end type group_t

    type :: namelist_t
        !! A whole file and the overrides applied to it.
        character(:), allocatable :: text         !! of the file, then of each override
        integer, allocatable :: starts(:)         !! where these texts begin
        character(source_length) :: source = ""   !! the name of the file, fit for a message
        type(group_t), allocatable :: groups(:)   !! the first `group_count` are in use
        type(entry_t), allocatable :: entries(:)  !! the first `entry_count` are in use
        type(value_t), allocatable :: values(:)   !! the first `value_count` are in use
        integer :: group_count = 0, entry_count = 0, value_count = 0
        integer :: repeats_count = 0    !! values with their repeats
        integer :: at = 1               !! the byte of the text to be parsed next
        integer :: typed = no_text      !! what the override's key takes: numbers, or texts
        character(100) :: context = ""  !! what the parser is in: `&scene: dt:`
    end type namelist_t

contains

    pure subroutine new_namelist(tree, text, source)
        !! A tree of nothing yet.
        type(namelist_t), intent(out) :: tree  !! empty, but for the text
        character(*), intent(in) :: text       !! of the file
        character(*), intent(in) :: source     !! its name

        tree%text = text
        tree%starts = [1]
        tree%source = short_source(source)
        allocate (tree%groups(max_groups), tree%entries(few), tree%values(few))
    end subroutine new_namelist

    pure subroutine fail_at(tree, position, message, error)
        !! Fail with `source:line:column: message`, `source: message`, or `--set ...: message`.
        type(namelist_t), intent(in) :: tree  !! of a file
        integer, intent(in) :: position           !! in the tree's text; 0: the file as a whole
        character(*), intent(in) :: message       !! one line
        type(error_t), allocatable, intent(out) :: error  !! status 2
        character(:), allocatable :: place
        integer :: last, part

        place = trim(tree%source)
        if (in_override(tree, position)) then
            part = count(tree%starts <= position)
            last = len(tree%text)
            if (part < size(tree%starts)) last = tree%starts(part + 1) - 1
            place = trim("--set "//escaped(tree%text(tree%starts(part):last), 90))
            place = trim(short_source(place))
        else if (position > 0) then
            place = place//":"//to_text(line_of(tree, position))//":"// &
                    to_text(position - index(tree%text(:position - 1), achar(10), back=.true.))
        end if
        call fail(error, place//": "//message, status_usage)
    end subroutine fail_at

    pure function in_override(tree, position) result(yes)
        !! Does what stands there come from the command line?
        type(namelist_t), intent(in) :: tree  !! of a file
        integer, intent(in) :: position       !! in the tree's text; 0: the file as a whole
        logical :: yes

        yes = count(tree%starts <= position) > 1
    end function in_override

    pure function is_overridden(tree, group, key) result(yes)
        !! Does the command line give `key`, or an element of it?
        type(namelist_t), intent(in) :: tree    !! of a file
        character(*), intent(in) :: group, key  !! in lower case
        logical :: yes
        integer :: i, owner

        yes = .false.
        owner = find_group(tree, group)
        do i = 1, tree%entry_count
            associate (item => tree%entries(i))
                if (item%group == owner .and. item%key == key) yes = &
                    yes .or. in_override(tree, item%at)
            end associate
        end do
    end function is_overridden

    pure subroutine drop_key(tree, group, key)
        !! As if `key` were not there.
        type(namelist_t), intent(inout) :: tree  !! of a file
        character(*), intent(in) :: group, key   !! in lower case
        integer :: i, owner

        owner = find_group(tree, group)
        do i = 1, tree%entry_count
            associate (item => tree%entries(i))
                if (item%group /= owner .or. item%key /= key) cycle
                item%key = ""
                item%replaced = .true.
            end associate
        end do
    end subroutine drop_key

    pure function line_of(tree, position) result(line)
        !! The line of the file that holds this byte, from 1.
        type(namelist_t), intent(in) :: tree  !! of a file
        integer, intent(in) :: position       !! in the tree's text
        integer :: i, line

        line = 1
        do i = 1, position - 1
            if (tree%text(i:i) == achar(10)) line = line + 1
        end do
    end function line_of

    pure function label(group, key) result(text)
        !! `&group: key`
        character(*), intent(in) :: group, key    !! their names, with any bytes
        character(:), allocatable :: text

        text = "&"//escaped(trim(group), 30)//": "//escaped(trim(key), 30)
    end function label

    pure function find_group(tree, name) result(position)
        !! The position of group `name`, 0 when there is none.
        type(namelist_t), intent(in) :: tree  !! of a file
        character(*), intent(in) :: name      !! in lower case
        integer :: position

        do position = tree%group_count, 1, -1
            if (tree%groups(position)%name == name) exit
        end do
    end function find_group

    pure function find_entry(tree, group, key) result(position)
        !! The position of the last entry that gives `key`, 0 when there is none.
        type(namelist_t), intent(in) :: tree    !! of a file
        character(*), intent(in) :: group, key  !! in lower case
        integer :: position
        integer :: owner

        owner = find_group(tree, group)
        do position = merge(tree%entry_count, 0, owner > 0), 1, -1
            if (tree%entries(position)%group == owner .and. tree%entries(position)%key == key) exit
        end do
    end function find_entry

    pure subroutine add_group(tree, name, first, error)
        !! Begin a group.
        type(namelist_t), intent(inout) :: tree           !! grows
        character(*), intent(in) :: name                  !! in lower case
        integer, intent(in) :: first                      !! where it begins in the tree's text
        type(error_t), allocatable, intent(out) :: error  !! status 2: too many

        if (tree%group_count == max_groups) then
            call fail_at(tree, first, "more than "//to_text(max_groups)//" groups", error)
            return
        end if
        tree%group_count = tree%group_count + 1
        tree%groups(tree%group_count) = group_t(name=name, at=first)
    end subroutine add_group

    pure subroutine add_entry(tree, item, error)
        !! Append an entry, whose values are still to come.
        type(namelist_t), intent(inout) :: tree           !! grows
        type(entry_t), intent(in) :: item                 !! without values
        type(error_t), allocatable, intent(out) :: error  !! status 2: too many
        type(entry_t), allocatable :: more(:)

        if (tree%entry_count == max_entries) then
            call fail_at(tree, item%at, "more than "//to_text(max_entries)//" keys", error)
            return
        else if (tree%entry_count == size(tree%entries)) then
            allocate (more(2*tree%entry_count))
            more(:tree%entry_count) = tree%entries
            call move_alloc(more, tree%entries)
        end if
        tree%entry_count = tree%entry_count + 1
        tree%entries(tree%entry_count) = item
        tree%entries(tree%entry_count)%first_value = tree%value_count + 1
        tree%entries(tree%entry_count)%last_value = tree%value_count
    end subroutine add_entry

    pure subroutine add_value(tree, value, error)
        !! Append a value to the last entry.
        type(namelist_t), intent(inout) :: tree           !! grows
        type(value_t), intent(in) :: value                !! to be copied
        type(error_t), allocatable, intent(out) :: error  !! status 2: too many
        type(value_t), allocatable :: more(:)

        if (value%repeats > max_values - tree%repeats_count) then
            call fail_at(tree, value%first, "more than "//to_text(max_values)// &
                         " values (repeats counted)", error)
            return
        else if (tree%value_count == size(tree%values)) then
            allocate (more(2*tree%value_count))
            more(:tree%value_count) = tree%values
            call move_alloc(more, tree%values)
        end if
        tree%value_count = tree%value_count + 1
        tree%repeats_count = tree%repeats_count + value%repeats
        tree%values(tree%value_count) = value
        associate (owner => tree%entries(tree%entry_count))
            owner%last_value = tree%value_count
            owner%count = owner%count + value%repeats
        end associate
    end subroutine add_value

    pure subroutine settle_twins(tree, error)
        !! See that the last entry gives no element that an earlier one gives. An override may what
        !! the file gives: without an index it replaces the whole of those entries.
        type(namelist_t), intent(inout) :: tree           !! its last entry is complete
        type(error_t), allocatable, intent(out) :: error  !! status 2: given twice
        character(:), allocatable :: first
        integer :: i

        associate (new => tree%entries(tree%entry_count))
            do i = 1, tree%entry_count - 1
                associate (old => tree%entries(i))
                    if (old%group /= new%group .or. old%key /= new%key) cycle
                    if (in_override(tree, new%at) .and. .not. in_override(tree, old%at)) then
                        if (new%index == 0) old%replaced = .true.
                    else if (max(1, old%index) < max(1, new%index) + new%count .and. &
                             max(1, new%index) < max(1, old%index) + old%count) then
                        first = "on line "//to_text(line_of(tree, old%at))
                        if (in_override(tree, old%at)) first = "by another --set"
                        if (spelling(tree, old) /= spelling(tree, new)) first = first//" as "// &
                            escaped(spelling(tree, old), 30)//", for capital letters do not count"
                        call fail_at(tree, new%at, label(tree%groups(new%group)%name, &
                            spelling(tree, new))//" is given twice (first "//first//")", error)
                        return
                    end if
                end associate
            end do
        end associate
    end subroutine settle_twins

    pure function raw_text(tree, value) result(text)
        !! The value as it was written, with its quotes.
        type(namelist_t), intent(in) :: tree  !! of a file
        type(value_t), intent(in) :: value    !! of this tree
        character(:), allocatable :: text

        text = tree%text(value%first:value%last)
    end function raw_text

    pure function text_of(tree, value) result(text)
        !! The text a value stands for: doubled quotes of a string are one quote.
        type(namelist_t), intent(in) :: tree  !! of a file
        type(value_t), intent(in) :: value    !! of this tree
        character(:), allocatable :: text
        integer :: i, length

        text = raw_text(tree, value)
        if (value%kind /= kind_string) return
        length = 0
        i = 2
        do while (i < len(text))
            length = length + 1
            text(length:length) = text(i:i)
            if (text(i:i) == tree%text(value%last:value%last)) i = i + 1
            i = i + 1
        end do
        text = text(:length)
    end function text_of

    pure subroutine refuse_picked(tree, position, problem, error)
        !! Fail with the place, group, key and text of the value at `position`, and `problem`.
        type(namelist_t), intent(in) :: tree              !! of a file
        integer, intent(in) :: position                   !! among its values
        character(*), intent(in) :: problem               !! what is wrong with it
        type(error_t), allocatable, intent(out) :: error  !! status 2
        integer :: i

        do i = 1, tree%entry_count - 1
            if (tree%entries(i)%last_value >= position) exit
        end do
        associate (item => tree%entries(i), value => tree%values(position))
            call fail_at(tree, value%first, label(tree%groups(item%group)%name, &
                                                  spelling(tree, item))//" = "// &
                         escaped(raw_text(tree, value))//": "//problem, error)
        end associate
    end subroutine refuse_picked

    pure function spelling(tree, item) result(key)
        !! The key of an entry as it was written.
        type(namelist_t), intent(in) :: tree  !! of a file
        type(entry_t), intent(in) :: item     !! of this tree
        character(:), allocatable :: key

        key = tree%text(item%at:item%at + len_trim(item%key) - 1)
    end function spelling

    pure subroutine refuse_missing(tree, owner, group, key, error)
        !! Demand `key`, or its whole group, if nothing there seems to be a slip for it.
        type(namelist_t), intent(in) :: tree              !! of a file
        integer, intent(in) :: owner                      !! position of the group, 0: it is missing
        character(*), intent(in) :: group, key            !! in lower case
        type(error_t), allocatable, intent(out) :: error  !! status 2
        character(name_length), allocatable :: keys(:)
        character(:), allocatable :: near
        integer :: i

        if (owner == 0) then
            allocate (keys, source=[(tree%groups(i)%name, i=1, tree%group_count)])
            near = nearest_name(group, keys)
            i = find_group(tree, near)
            if (i > 0) then
                call fail_at(tree, tree%groups(i)%at, advice("group ", near, [group], whole), error)
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
                             advice("key ", near, [key], whole), error)
                return
            end if
            call fail_at(tree, tree%groups(owner)%at, label(group, key)// &
                         " is missing; write "//escaped(key, 30)//" = value", error)
        end if
    end subroutine refuse_missing

    pure subroutine refuse_unknown_keys(tree, group, allowed, error, early, shown_by)
        !! Refuse the first key of `group` that nobody has asked for, naming the nearest of the
        !! `allowed` ones, or those that are not given. `early`: somebody may still ask for those.
        type(namelist_t), intent(in) :: tree              !! of a file
        character(*), intent(in) :: group, allowed(:)     !! in lower case
        type(error_t), allocatable, intent(out) :: error  !! status 2
        logical, intent(in), optional :: early            !! false unless given
        character(*), intent(in), optional :: shown_by    !! what shows all; else `describe scene`
        character(len(allowed)), allocatable :: absent(:)
        character(:), allocatable :: command, text
        logical :: spared
        integer :: i, k, owner

        spared = .false.
        if (present(early)) spared = early
        command = whole
        if (present(shown_by)) command = shown_by
        owner = find_group(tree, group)
        do i = 1, tree%entry_count
            associate (item => tree%entries(i))
                if (item%group /= owner .or. item%used .or. item%replaced) cycle
                if (spared .and. any(allowed == item%key)) cycle
                allocate (absent, source=pack(allowed, &
                    [(in_override(tree, item%at) .or. item%key == allowed(k) .or. &
                      find_entry(tree, group, allowed(k)) == 0, k=1, size(allowed))]))
                text = advice("key ", trim(item%key), absent, command)
                if (size(absent) == 0 .and. size(allowed) > 0 .and. &
                    .not. any(allowed == item%key)) text = "unknown key "// &
                    quoted(trim(item%key))//"; there are "// &
                    escaped(listed(allowed, 130, command), 190)
                call fail_at(tree, item%at, "&"//escaped(trim(group), 30)//": "//text, error)
                return
            end associate
        end do
    end subroutine refuse_unknown_keys

    pure subroutine refuse_unknown_groups(tree, allowed, error)
        !! Refuse the first group from which nobody has asked for a key, naming the nearest of the
        !! `allowed` ones; of these one may be empty, as `&o /` of a system without parameters.
        type(namelist_t), intent(in) :: tree              !! of a file
        character(*), intent(in) :: allowed(:)            !! in lower case
        type(error_t), allocatable, intent(out) :: error  !! status 2
        character(:), allocatable :: text
        integer :: i

        do i = 1, tree%group_count
            if (tree%groups(i)%used .or. (any(allowed == tree%groups(i)%name) .and. &
                                          all(tree%entries(:tree%entry_count)%group /= i))) cycle
            text = advice("group ", trim(tree%groups(i)%name), allowed, whole)
            if (in_override(tree, tree%groups(i)%at)) text = text//" (in "//trim(tree%source)//")"
            call fail_at(tree, tree%groups(i)%at, text, error)
            return
        end do
    end subroutine refuse_unknown_groups

    pure function advice(what, name, allowed, command) result(text)
        !! What to do about a `name` that is of no use; the command shows all that are allowed.
        character(*), intent(in) :: what, name, allowed(:), command
        character(:), allocatable :: text, near

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
                   escaped(listed(allowed, 130, command), 190)
        end if
    end function advice
end module lagrangia_namelist_tree
