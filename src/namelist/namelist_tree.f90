module lagrangia_namelist_tree
    !! What a namelist file says, as plain data: groups, their entries, the entries' values.
    use lagrangia_errors, only: error_t, fail, status_usage
    use lagrangia_kinds, only: dp
    use lagrangia_text, only: escaped, to_text
    implicit none (type, external)
    private
    public :: entry_t, group_t, namelist_t, place_t, value_t
    public :: add_entry, add_group, add_value, decimal_points, fail_at, find_group, &
              new_namelist, raw_text, settle_twins, short_source, text_of
    public :: kind_number, kind_string, kind_word, max_values, name_length

    integer, parameter :: name_length = 63    !! of a group or key, as in Fortran
    integer, parameter :: max_groups = 100    !! in one file with its overrides
    integer, parameter :: max_entries = 1000  !! in one file with its overrides
    integer, parameter :: max_values = 10000  !! repeats counted, in one file with its overrides
    integer, parameter :: few = 64            !! entries and values: there is room at once
    integer, parameter :: source_length = 100

    integer, parameter :: kind_number = 1  !! a finite number
    integer, parameter :: kind_string = 2  !! text between quotes
    integer, parameter :: kind_word = 3    !! bare text: a logical, or a string of an override

    type :: place_t
        !! Where something was written.
        character(source_length) :: source = ""  !! file name or `--set ...`, fit for a message
        integer :: line = 0    !! from 1; 0 in an override
        integer :: column = 0  !! in bytes, from 1
    end type place_t

    type :: value_t
        !! One value, or several equal ones (`3*0.0`).
        integer :: kind = kind_word
        integer :: first = 1, last = 0    !! its bytes in the tree's text, without the quotes
        integer :: repeats = 1
        integer :: line = 0, column = 0
        real(dp) :: number = 0.0_dp       !! for `kind_number`
    end type value_t

    type :: entry_t
        !! `key = values` or `key(index) = values`.
        character(name_length) :: key = ""
        integer :: group = 0                          !! position among the groups
        integer :: index = 0                          !! 0 where none was written
        integer :: first_value = 1, last_value = 0    !! positions among the values
        integer :: count = 0                          !! of values, repeats counted
        type(place_t) :: place
        logical :: overrides = .false.                !! from the command line
        logical :: replaced = .false.                 !! by a later override
        logical :: used = .false.
    end type entry_t

    type :: group_t
        !! `&name ... /`
        character(name_length) :: name = ""
        type(place_t) :: place
        logical :: used = .false.
    end type group_t

    type :: namelist_t
        !! A whole file and the overrides applied to it.
        character(:), allocatable :: text         !! what the values point into
        character(source_length) :: source = ""
        type(group_t), allocatable :: groups(:)   !! the first `group_count` are in use
        type(entry_t), allocatable :: entries(:)  !! the first `entry_count` are in use
        type(value_t), allocatable :: values(:)   !! the first `value_count` are in use
        integer :: group_count = 0, entry_count = 0, value_count = 0
        integer :: repeats_count = 0              !! values with their repeats
    end type namelist_t

contains

    pure subroutine new_namelist(tree, source)
        !! An empty tree for the file called `source`.
        type(namelist_t), intent(out) :: tree
        character(*), intent(in) :: source

        tree%text = ""
        tree%source = short_source(source)
        allocate (tree%groups(max_groups), tree%entries(few), tree%values(few))
    end subroutine new_namelist

    pure function short_source(source) result(shown)
        !! `source` fit for a message, a blank at either end as `\x20`; of a long one the end is
        !! kept.
        character(*), intent(in) :: source
        character(source_length) :: shown
        character(:), allocatable :: full
        integer :: length

        full = escaped(source, 4*len(source))
        if (len_trim(full) < len(full)) full = full(:len(full) - 1)//"\x20"
        if (index(full, " ") == 1) full = "\x20"//full(2:)
        length = len(full)
        if (length > source_length) full = "..."//full(length - source_length + 4:)
        shown = full
    end function short_source

    pure subroutine fail_at(error, place, message)
        !! Fail with `source:line:column: message`.
        type(error_t), allocatable, intent(out) :: error
        type(place_t), intent(in) :: place
        character(*), intent(in) :: message
        character(:), allocatable :: full

        full = trim(place%source)
        if (place%line > 0) full = full//":"//to_text(place%line)//":"//to_text(place%column)
        full = full//": "//message
        call fail(error, full, status_usage)
    end subroutine fail_at

    pure function find_group(tree, name) result(position)
        !! The position of group `name`, 0 when there is none.
        type(namelist_t), intent(in) :: tree
        character(*), intent(in) :: name
        integer :: position

        do position = tree%group_count, 1, -1
            if (tree%groups(position)%name == name) exit
        end do
    end function find_group

    pure subroutine add_group(tree, name, place, error)
        !! Begin group `name`.
        type(namelist_t), intent(inout) :: tree
        character(*), intent(in) :: name
        type(place_t), intent(in) :: place
        type(error_t), allocatable, intent(out) :: error

        if (tree%group_count == max_groups) then
            call fail_at(error, place, "more than "//to_text(max_groups)//" groups")
            return
        end if
        tree%group_count = tree%group_count + 1
        tree%groups(tree%group_count) = group_t(name=name, place=place)
    end subroutine add_group

    pure subroutine add_entry(tree, item, error)
        !! Append an entry, whose values are still to come.
        type(namelist_t), intent(inout) :: tree
        type(entry_t), intent(in) :: item
        type(error_t), allocatable, intent(out) :: error
        type(entry_t), allocatable :: more(:)

        if (tree%entry_count == max_entries) then
            call fail_at(error, item%place, "more than "//to_text(max_entries)//" keys")
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
        type(namelist_t), intent(inout) :: tree
        type(value_t), intent(in) :: value
        type(error_t), allocatable, intent(out) :: error
        type(value_t), allocatable :: more(:)

        if (tree%value_count == size(tree%values)) then
            allocate (more(2*tree%value_count))
            more(:tree%value_count) = tree%values
            call move_alloc(more, tree%values)
        end if
        associate (owner => tree%entries(tree%entry_count))
            if (value%repeats > max_values - tree%repeats_count) then
                call fail_at(error, place_t(owner%place%source, value%line, value%column), &
                             "more than "//to_text(max_values)//" values (repeats counted)")
                return
            end if
            tree%repeats_count = tree%repeats_count + value%repeats
            tree%value_count = tree%value_count + 1
            tree%values(tree%value_count) = value
            owner%last_value = tree%value_count
            owner%count = owner%count + value%repeats
        end associate
    end subroutine add_value

    pure subroutine settle_twins(tree, error)
        !! See that the last entry gives no element that an earlier one gives. An override may:
        !! its values come last, and without an index it replaces the whole of earlier entries.
        type(namelist_t), intent(inout) :: tree
        type(error_t), allocatable, intent(out) :: error
        integer :: i

        associate (new => tree%entries(tree%entry_count))
            do i = 1, tree%entry_count - 1
                associate (old => tree%entries(i))
                    if (old%group /= new%group .or. old%key /= new%key) cycle
                    if (new%overrides) then
                        if (new%index == 0) old%replaced = .true.
                    else if (max(1, old%index) < max(1, new%index) + new%count .and. &
                             max(1, new%index) < max(1, old%index) + old%count) then
                        call fail_at(error, new%place, "&"// &
                                     escaped(trim(tree%groups(new%group)%name), 30)//": "// &
                                     escaped(trim(new%key))//" is given twice (first on line "// &
                                     to_text(old%place%line)//")")
                        return
                    end if
                end associate
            end do
        end associate
    end subroutine settle_twins

    pure function raw_text(tree, value) result(text)
        !! The value as it was written, with its quotes.
        type(namelist_t), intent(in) :: tree
        type(value_t), intent(in) :: value
        character(:), allocatable :: text

        if (value%kind == kind_string) then
            text = tree%text(value%first - 1:value%last + 1)
        else
            text = tree%text(value%first:value%last)
        end if
    end function raw_text

    pure function decimal_points(tree, picked, low, high) result(remedy)
        !! What to write if the values at the positions `picked` came apart at decimal commas, and
        !! together would be from `low` to `high`: `; a decimal point, no comma: 0.01`, or nothing.
        type(namelist_t), intent(in) :: tree
        integer, intent(in) :: picked(:), low, high
        character(:), allocatable :: remedy
        character(:), allocatable :: behind, number
        integer :: i, n

        remedy = ""
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

    pure function text_of(tree, value) result(text)
        !! The text a value stands for: doubled quotes of a string are one quote.
        type(namelist_t), intent(in) :: tree
        type(value_t), intent(in) :: value
        character(:), allocatable :: text
        character(:), allocatable :: buffer
        character(1) :: mark
        integer :: i, length

        buffer = tree%text(value%first:value%last)
        length = 0
        if (value%kind == kind_string) then
            mark = tree%text(value%first - 1:value%first - 1)
            i = value%first
            do while (i <= value%last)
                length = length + 1
                buffer(length:length) = tree%text(i:i)
                if (tree%text(i:i) == mark) i = i + 1
                i = i + 1
            end do
        else
            length = len(buffer)
        end if
        text = buffer(:length)
    end function text_of
end module lagrangia_namelist_tree
