module lagrangia_namelist_parser
    !! From the text of a namelist file, or of an override, to its groups, entries and values.
    use lagrangia_errors, only: error_t
    use lagrangia_namelist_lexer, only: check_separation, look_for_key, next_byte, read_name, &
                                        read_value, refuse, refuse_byte, separators, skip_space, &
                                        small_number, stray, token_end, truth_of
    use lagrangia_namelist_tree, only: add_entry, add_group, add_value, entry_t, fail_at, &
                                       find_entry, find_group, in_override, kind_number, label, &
                                       line_of, max_values, name_length, namelist_t, new_namelist, &
                                       no_text, settle_twins, value_t
    use lagrangia_number_reader, only: after, character_at, digits, letters, starts_number
    use lagrangia_text, only: escaped, lower, quoted, to_text
    implicit none (type, external)
    private
    public :: apply_override, parse_namelist

contains

    pure subroutine parse_namelist(text, source, tree, error)
        !! Read the whole text of a file; nothing doubtful is passed over.
        character(*), intent(in) :: text                  !! all bytes of the file
        character(*), intent(in) :: source                !! its name, for messages
        type(namelist_t), intent(out) :: tree             !! what it says
        type(error_t), allocatable, intent(out) :: error  !! status 2: the first doubtful thing
        character(3), parameter :: byte_order_mark = char(239)//char(187)//char(191)
        integer :: behind

        behind = 1
        if (index(text(:min(3, len(text))), byte_order_mark) == 1) behind = 4
        call new_namelist(tree, text(behind:), source)
        if (index(text, achar(13)) > 0 .and. index(text, achar(10)) == 0) then
            call fail_at(tree, 0, "its lines end in carriage returns alone; save it with line "// &
                         "feeds", error)
            return
        else if (index(text(:min(4, len(text))), achar(0)) > 0 .and. index(text, "!") /= 1) then
            call fail_at(tree, 0, "is no plain text (UTF-16, perhaps, or binary); save it as "// &
                         "UTF-8", error)
            return
        end if
        behind = 0
        do
            call skip_space(tree, error)
            if (allocated(error)) return
            if (tree%at > len(tree%text)) exit
            if (next_byte(tree) /= "&") then
                call refuse_outside(tree, behind, error)
            else
                call read_group(tree, error)
            end if
            if (allocated(error)) return
            behind = tree%at
        end do
        if (tree%group_count == 0) call fail_at(tree, 0, "holds no group; a group is written: "// &
                                                "&name key = value, ... /", error)
    end subroutine parse_namelist

    pure subroutine apply_override(tree, text, error, typed)
        !! Let `GROUP%KEY=VALUE` replace or add an entry, and add the group if need be.
        !!
        !! `GROUP%KEY(2)=VALUE` replaces one element. Texts need no quotes here: one runs to the
        !! next comma. The same override once more changes nothing. After a failure the tree is good
        !! for nothing but the message.
        type(namelist_t), intent(inout) :: tree  !! of a file, perhaps with earlier overrides
        character(*), intent(in) :: text         !! the override, in any case
        type(error_t), allocatable, intent(out) :: error  !! status 2: what it is not
        integer, intent(in), optional :: typed   !! `one_text`, which has commas, or `some_texts`
        character(name_length) :: name
        integer :: first, group, i, last

        tree%typed = no_text
        if (present(typed)) tree%typed = typed
        last = len(tree%text)
        do i = size(tree%starts), 2, -1
            if (tree%text(tree%starts(i):last) == text) return
            last = tree%starts(i) - 1
        end do
        first = len(tree%text) + 1
        tree%starts = [tree%starts, first]
        tree%text = tree%text//text
        tree%at = first
        tree%context = ""
        name = ""
        call skip_space(tree, error)
        if (.not. allocated(error) .and. scan(next_byte(tree), letters) == 1) then
            call read_name(tree, "group", name, error)
            if (.not. allocated(error)) call skip_space(tree, error)
        end if
        if (allocated(error)) return
        if (next_byte(tree) /= "%" .or. name == "") then
            call fail_at(tree, first, "expected GROUP%KEY=VALUE, as in scene%dt=1e-3"// &
                         with_group(tree, text, name), error)
            return
        end if
        tree%at = tree%at + 1
        group = find_group(tree, name)
        if (group == 0) then
            call add_group(tree, name, first, error)
            group = tree%group_count
        end if
        if (.not. allocated(error)) call skip_space(tree, error)
        if (.not. allocated(error)) call read_entry(tree, group, error)
    end subroutine apply_override

    pure function with_group(tree, text, name) result(remedy)
        !! How the setting would be written: `pendulum.l=2` with `%`, `dt=0.1` in a group of the
        !! file, that which has the key or each of them; empty where `text` is something else.
        type(namelist_t), intent(in) :: tree
        character(*), intent(in) :: text, name  !! what was typed, and the name that it begins with
        character(:), allocatable :: remedy
        integer :: behind, i

        remedy = ""
        behind = verify(text, " "//char(9)) + len_trim(name)
        if (name == "" .or. behind > len(text) .or. len(text) > 40) return
        if (scan(text(behind:behind), ".:") == 1) then
            if (find_group(tree, name) > 0 .and. index(text, "=") > behind) remedy = &
                "; write "//trim(name)//"%"//escaped(trim(text(behind + 1:)), 40)
            return
        end if
        if (index(adjustl(text(behind:)), "=") /= 1) return
        do i = 1, tree%group_count
            if (find_entry(tree, trim(tree%groups(i)%name), trim(name)) > 0) exit
        end do
        if (i <= tree%group_count) then
            remedy = "; write "//trim(tree%groups(i)%name)//"%"//escaped(trim(adjustl(text)), 40)
            return
        end if
        remedy = "; the groups are"
        do i = 1, min(3, tree%group_count)
            remedy = remedy//trim(merge(",", " ", i > 1))//" "//trim(tree%groups(i)%name)
        end do
    end function with_group

    pure subroutine refuse_outside(tree, behind, error)
        !! Refuse text between groups, of which the last ended before the byte `behind`.
        type(namelist_t), intent(in) :: tree
        integer, intent(in) :: behind
        type(error_t), allocatable, intent(out) :: error
        character(:), allocatable :: group, word

        word = tree%text(tree%at:max(tree%at, token_end(tree%text, tree%at)))
        group = ""
        if (behind > 0) group = "&"//escaped(trim(tree%groups(tree%group_count)%name), 30)
        if (iachar(word(1:1)) > 126) then
            call refuse_byte(tree, tree%at, error)
        else if (index("#/;", word(1:1)) > 0) then
            call refuse(tree, tree%at, "unexpected "//quoted(word, 20)// &
                        " outside a group; a comment begins with '!'", error)
        else if (word(1:1) == "$") then
            call refuse(tree, tree%at, "a group begins with '&', not '$'", error)
        else if (behind == 0) then
            call refuse(tree, tree%at, "text "//quoted(word, 20)//" outside a group; "// &
                        "a group is written: &name key = value, ... /", error)
        else if (line_of(tree, behind) == line_of(tree, tree%at)) then
            call refuse(tree, tree%at, "text "//quoted(word, 20)//" after the end of "//group// &
                        "; '/' ends a group, a comment begins with '!'", error)
        else
            call refuse(tree, tree%at, "text "//quoted(word, 20)//" outside a group; "//group// &
                        " ended on line "//to_text(line_of(tree, behind))//", at its '/'", error)
        end if
    end subroutine refuse_outside

    pure subroutine read_group(tree, error)
        !! Read from `&` to the `/` or `&end` of the group.
        type(namelist_t), intent(inout) :: tree
        type(error_t), allocatable, intent(out) :: error
        character(name_length) :: name
        integer :: first, twin

        first = tree%at
        tree%at = tree%at + 1
        call read_name(tree, "group", name, error)
        if (allocated(error)) return
        twin = find_group(tree, name)
        if (twin > 0) then
            call fail_at(tree, first, "group &"//escaped(trim(name))//" is given twice (first "// &
                         "on line "//to_text(line_of(tree, tree%groups(twin)%at))//")", error)
        else if (name == "end") then
            call fail_at(tree, first, "&end without a group to end", error)
        else if (index(separators//"/&", next_byte(tree)) == 0) then
            call refuse_byte(tree, tree%at, error)
        else
            call add_group(tree, name, first, error)
        end if
        do while (.not. allocated(error))
            tree%context = "&"//escaped(trim(name), 30)//":"
            call skip_space(tree, error)
            if (allocated(error)) return
            select case (next_byte(tree))
            case ("/")
                call end_group(tree, error)
                exit
            case ("&")
                call end_or_refuse(tree, first, error)
                exit
            case (" ")
                call fail_at(tree, first, "group &"//escaped(trim(name), 30)//" begins here "// &
                             "and has no end: its '/' is missing", error)
            case default
                call read_entry(tree, tree%group_count, error)
            end select
        end do
        tree%context = ""
    end subroutine read_group

    pure subroutine end_group(tree, error)
        !! Step over a `/` that is followed by nothing that makes it look like something else.
        type(namelist_t), intent(inout) :: tree
        type(error_t), allocatable, intent(out) :: error
        character(1) :: behind

        behind = character_at(tree%text, tree%at + 1)
        if (behind == "/") then
            call refuse(tree, tree%at, "'//' begins no comment, and '/' ends the group; "// &
                        "a comment begins with '!'", error)
        else if (index(separators//"&", behind) == 0) then
            call refuse(tree, tree%at, "'/' ends the group, yet text follows; "// &
                        "a text with '/' in it needs quotes", error)
        else
            tree%at = tree%at + 1
        end if
    end subroutine end_group

    pure subroutine end_or_refuse(tree, first, error)
        !! Step over `&end`; any other `&name` means that the group begun at `first` has no `/`.
        type(namelist_t), intent(inout) :: tree
        integer, intent(in) :: first
        type(error_t), allocatable, intent(out) :: error
        integer :: last

        last = token_end(tree%text, tree%at + 1)
        if (lower(tree%text(tree%at:last)) == "&end") then
            tree%at = last + 1
        else if (last == tree%at) then
            call refuse(tree, tree%at, "a lone '&'; a list goes on in the next line "// &
                        "without it, and '/' ends a group", error)
        else
            call refuse(tree, tree%at, quoted(tree%text(tree%at:last))//" begins inside "// &
                        "the group, whose '/' is missing (it began on line "// &
                        to_text(line_of(tree, first))//")", error)
        end if
    end subroutine end_or_refuse

    pure subroutine read_entry(tree, group, error)
        !! Read `key = values` or `key(index) = values` of the group at position `group`.
        type(namelist_t), intent(inout) :: tree
        integer, intent(in) :: group
        type(error_t), allocatable, intent(out) :: error
        type(entry_t) :: item

        item%group = group
        item%at = tree%at
        call read_name(tree, "key", item%key, error)
        if (allocated(error)) return
        tree%context = label(tree%groups(group)%name, item%key)//":"
        call skip_space(tree, error)
        if (.not. allocated(error) .and. next_byte(tree) == "(") then
            call read_index(tree, item%index, error)
            if (.not. allocated(error)) call skip_space(tree, error)
        end if
        if (allocated(error)) return
        if (next_byte(tree) == "%") then
            call refuse(tree, tree%at, "components (a%b) are not read here; "// &
                        "write key = value inside &group", error)
        else if (next_byte(tree) /= "=") then
            call refuse(tree, tree%at, "expected '=' after the key", error)
        else
            call add_entry(tree, item, error)
        end if
        if (allocated(error)) return
        tree%at = tree%at + 1
        if (next_byte(tree) == "=") then
            call refuse(tree, tree%at, "'==' compares; one '=' gives a value", error)
        else
            call read_values(tree, error)
        end if
        if (.not. allocated(error)) call settle_twins(tree, error)
    end subroutine read_entry

    pure subroutine read_index(tree, number, error)
        !! Read `(2)`.
        type(namelist_t), intent(inout) :: tree
        integer, intent(out) :: number
        type(error_t), allocatable, intent(out) :: error
        integer :: first

        tree%at = tree%at + 1
        number = 0
        call skip_space(tree, error)
        if (allocated(error)) return
        first = tree%at
        tree%at = after(tree%text, first, digits)
        number = small_number(tree%text(first:tree%at - 1))
        if (tree%at > first .and. (number < 1 .or. number > max_values)) then
            call refuse(tree, first, "the index must be from 1 to "//to_text(max_values), error)
            return
        end if
        call skip_space(tree, error)
        if (allocated(error)) return
        select case (next_byte(tree))
        case (":")
            call refuse(tree, tree%at, "array sections (1:2) are not read here; write all "// &
                        "values after the key, or one index", error)
        case (",")
            call refuse(tree, tree%at, "only one index is read here, as in q(2) = 1.0", error)
        case (")")
            if (number == 0) then
                call refuse(tree, tree%at, "the index is missing, as in q(2) = 1.0", error)
            end if
            tree%at = tree%at + 1
        case default
            call refuse(tree, tree%at, "expected one index and ')', as in q(2) = 1.0", error)
        end select
    end subroutine read_index

    pure subroutine read_values(tree, error)
        !! Read what stands behind `=` up to the next key or the end of the group.
        type(namelist_t), intent(inout) :: tree
        type(error_t), allocatable, intent(out) :: error
        character(1) :: byte
        integer :: start
        logical :: after_comma, key_follows
        type(value_t) :: value

        start = tree%at
        after_comma = .true.
        do
            call skip_space(tree, error)
            if (allocated(error)) return
            byte = next_byte(tree)
            if (tree%at > len(tree%text)) exit
            if (.not. in_override(tree, tree%at) .and. scan(byte, "/&") == 1) exit
            if (byte == ",") then
                if (after_comma) exit
                tree%at = tree%at + 1
                after_comma = .true.
                cycle
            end if
            if (.not. in_override(tree, tree%at)) then
                call look_for_key(tree, key_follows)
                if (key_follows) exit
            end if
            if (tree%entries(tree%entry_count)%count > 0) call refuse_colon(tree, error)
            if (.not. (after_comma .or. allocated(error))) call refuse_stray(tree, error)
            if (.not. allocated(error)) call read_value(tree, value, error)
            if (.not. allocated(error)) call add_value(tree, value, error)
            if (.not. allocated(error)) call check_separation(tree, value%kind, error)
            if (allocated(error)) return
            after_comma = .false.
        end do
        if (tree%entries(tree%entry_count)%count == 0) then
            call refuse(tree, start, "no value after '='; write one (expressions are "// &
                        "not computed), or leave the key out", error)
        else if (byte == "," .and. after_comma) then
            call refuse(tree, tree%at, "an empty value between commas; write every value", error)
        end if
    end subroutine read_values

    pure subroutine refuse_colon(tree, error)
        !! Refuse a key with a colon behind it, `every: 5`, as it stands behind the values of
        !! another key, which has nothing to do with it.
        type(namelist_t), intent(in) :: tree
        type(error_t), allocatable, intent(out) :: error
        integer :: colon

        if (in_override(tree, tree%at) .or. scan(next_byte(tree), letters) == 0) return
        colon = after(tree%text, tree%at, letters//digits//"_")
        if (character_at(tree%text, after(tree%text, colon, " ")) /= ":") return
        call fail_at(tree, tree%at, group_name(tree)//"'=' stands behind a key, not ':'; write "// &
                     escaped(tree%text(tree%at:colon - 1), 30)//" = ...", error)
    end subroutine refuse_colon

    pure function group_name(tree) result(name)
        !! Of the group that is being read, as a message begins: `&scene: `.
        type(namelist_t), intent(in) :: tree
        character(:), allocatable :: name

        name = "&"//escaped(trim(tree%groups(tree%group_count)%name), 30)//": "
    end function group_name

    pure subroutine refuse_stray(tree, error)
        !! Refuse a word that follows a value without a comma, unless it is `true` or the like: a
        !! unit, a key without `=`, a comment without `!`. Numbers and quoted texts may follow. On
        !! a line of its own it is not what the key before it says.
        type(namelist_t), intent(in) :: tree
        type(error_t), allocatable, intent(out) :: error
        character(:), allocatable :: word

        if (in_override(tree, tree%at) .or. starts_number(tree%text(tree%at:))) return
        word = tree%text(tree%at:token_end(tree%text, tree%at))
        if (word == "" .or. truth_of(word) >= 0) return
        associate (value => tree%values(tree%value_count))
            if (index(tree%text(value%last:tree%at), achar(10)) > 0) then
                call fail_at(tree, tree%at, group_name(tree)//"unexpected "//quoted(word)//"; "// &
                             stray, error)
            else if (value%kind == kind_number .and. scan(word(1:1), "#%:<>*\") == 0) then
                call refuse(tree, tree%at, "unexpected "//quoted(word)//" behind a number; "// &
                            "units are not written: all are SI, angles in radians", error)
            else
                call refuse(tree, tree%at, "unexpected "//quoted(word)//"; "//stray, error)
            end if
        end associate
    end subroutine refuse_stray

end module lagrangia_namelist_parser
