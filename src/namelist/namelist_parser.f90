module lagrangia_namelist_parser
    !! From the text of a namelist file, or of an override, to its groups and entries.
    use lagrangia_errors, only: error_t
    use lagrangia_namelist_entries, only: read_entry
    use lagrangia_namelist_scanner, only: begins_name, carriage_return, line_feed, next_byte, &
                                          place_at, read_name, refuse, refuse_byte, scanner_t, &
                                          skip_space, tab, token_end
    use lagrangia_namelist_tree, only: add_group, fail_at, find_group, name_length, namelist_t, &
                                       new_namelist, place_t, short_source
    use lagrangia_text, only: escaped, lower, quoted, to_text
    implicit none (type, external)
    private
    public :: apply_override, parse_namelist

contains

    pure subroutine parse_namelist(text, source, tree, error)
        !! Read the whole `text` of the file called `source`; nothing doubtful is passed over.
        character(*), intent(in) :: text, source
        type(namelist_t), intent(out) :: tree
        type(error_t), allocatable, intent(out) :: error
        character(3), parameter :: byte_order_mark = char(239)//char(187)//char(191)
        type(scanner_t) :: scanner
        integer :: ended_on

        call new_namelist(tree, source)
        tree%text = text
        scanner%source = tree%source
        if (index(text(:min(3, len(text))), byte_order_mark) == 1) then
            scanner%at = 4
            scanner%line_start = 4
        end if
        if (index(text, carriage_return) > 0 .and. index(text, line_feed) == 0) then
            call fail_at(error, place_t(tree%source), "its lines end in carriage returns "// &
                         "alone; save it with line feeds")
            return
        else if (index(text(:min(4, len(text))), achar(0)) > 0 .and. index(text, "!") /= 1) then
            call fail_at(error, place_t(tree%source), "is no plain text (UTF-16, perhaps, or "// &
                         "binary); save it as UTF-8")
            return
        end if
        ended_on = 0
        do
            call skip_space(text, scanner, error)
            if (allocated(error)) return
            if (scanner%at > len(text)) exit
            if (text(scanner%at:scanner%at) /= "&") then
                call refuse_outside(text, scanner, tree, ended_on, error)
                return
            end if
            call read_group(text, scanner, tree, error)
            if (allocated(error)) return
            ended_on = scanner%line
        end do
        if (tree%group_count == 0) call fail_at(error, place_t(tree%source), &
            "holds no group; a group is written: &name key = value, ... /")
    end subroutine parse_namelist

    pure subroutine apply_override(tree, text, error)
        !! Let `GROUP%KEY=VALUE` replace or add an entry, and add the group if need be.
        !!
        !! `GROUP%KEY(2)=VALUE` replaces one element. Texts need no quotes here: one runs to the
        !! next comma. After a failure the tree is good for nothing but the message.
        type(namelist_t), intent(inout) :: tree
        character(*), intent(in) :: text
        type(error_t), allocatable, intent(out) :: error
        character(name_length) :: name
        type(scanner_t) :: scanner
        integer :: group

        scanner%overrides = .true.
        scanner%source = short_source(trim("--set "//escaped(text, 90)))
        scanner%offset = len(tree%text)
        tree%text = tree%text//text
        call skip_space(text, scanner, error)
        if (allocated(error)) return
        if (begins_name(text, scanner%at)) then
            call read_name(text, scanner, "group", name, error)
            if (allocated(error)) return
            call skip_space(text, scanner, error)
            if (allocated(error)) return
        end if
        if (next_byte(text, scanner%at) /= "%" .or. scanner%at == 1) then
            call refuse(scanner, 1, "expected GROUP%KEY=VALUE, as in scene%dt=1e-3", error)
            return
        end if
        scanner%at = scanner%at + 1
        group = find_group(tree, name)
        if (group == 0) then
            call add_group(tree, name, place_at(scanner, 1), error)
            if (allocated(error)) return
            group = tree%group_count
        end if
        call skip_space(text, scanner, error)
        if (allocated(error)) return
        call read_entry(text, scanner, tree, group, error)
    end subroutine apply_override

    pure subroutine refuse_outside(text, scanner, tree, ended_on, error)
        !! Refuse text between groups.
        character(*), intent(in) :: text
        type(scanner_t), intent(in) :: scanner
        type(namelist_t), intent(in) :: tree
        integer, intent(in) :: ended_on  !! the line where the last group ended
        type(error_t), allocatable, intent(out) :: error
        integer :: last

        last = max(scanner%at, token_end(text, scanner%at))
        associate (word => text(scanner%at:last))
            if (iachar(word(1:1)) > 126) then
                call refuse_byte(text, scanner, scanner%at, error)
            else if (index("#/;", word(1:1)) > 0) then
                call refuse(scanner, scanner%at, "unexpected "//quoted(word, 20)// &
                            " outside a group; a comment begins with '!'", error)
            else if (word(1:1) == "$") then
                call refuse(scanner, scanner%at, "a group begins with '&', not '$'", error)
            else if (ended_on == scanner%line) then
                call refuse(scanner, scanner%at, "text "//quoted(word, 20)// &
                            " after the end of &"// &
                            escaped(trim(tree%groups(tree%group_count)%name), 30)// &
                            "; '/' ends a group, a comment begins with '!'", error)
            else if (ended_on > 0) then
                call refuse(scanner, scanner%at, "text "//quoted(word, 20)//" outside a group; "// &
                            "&"//escaped(trim(tree%groups(tree%group_count)%name), 30)// &
                            " ended on line "//to_text(ended_on)//", at its '/'", error)
            else
                call refuse(scanner, scanner%at, "text "//quoted(word, 20)//" outside a group; "// &
                            "a group is written: &name key = value, ... /", error)
            end if
        end associate
    end subroutine refuse_outside

    pure subroutine read_group(text, scanner, tree, error)
        !! Read from `&` to the `/` or `&end` of the group.
        character(*), intent(in) :: text
        type(scanner_t), intent(inout) :: scanner
        type(namelist_t), intent(inout) :: tree
        type(error_t), allocatable, intent(out) :: error
        character(name_length) :: name
        type(place_t) :: place
        integer :: twin
        logical :: done

        place = place_at(scanner, scanner%at)
        scanner%at = scanner%at + 1
        call read_name(text, scanner, "group", name, error)
        if (allocated(error)) return
        twin = find_group(tree, name)
        if (twin > 0) then
            call fail_at(error, place, "group &"//escaped(trim(name))//" is given twice (first "// &
                         "on line "//to_text(tree%groups(twin)%place%line)//")")
        else if (name == "end") then
            call fail_at(error, place, "&end without a group to end")
        else if (index(" /!&"//tab//line_feed//carriage_return, &
                       next_byte(text, scanner%at)) == 0) then
            call refuse_byte(text, scanner, scanner%at, error)
        else
            call add_group(tree, name, place, error)
        end if
        if (allocated(error)) return
        done = .false.
        do while (.not. done)
            scanner%context = "&"//escaped(trim(name), 30)//":"
            call skip_space(text, scanner, error)
            if (allocated(error)) return
            select case (next_byte(text, scanner%at))
            case ("/")
                call end_group(text, scanner, error)
                done = .true.
            case ("&")
                call end_or_refuse(text, scanner, place, error)
                done = .true.
            case (" ")
                call fail_at(error, place, "group &"//escaped(trim(name), 30)//" begins here "// &
                             "and has no end: its '/' is missing")
            case default
                call read_entry(text, scanner, tree, tree%group_count, error)
            end select
            if (allocated(error)) return
        end do
        scanner%context = ""
    end subroutine read_group

    pure subroutine end_group(text, scanner, error)
        !! Step over a `/` that is followed by nothing that makes it look like something else.
        character(*), intent(in) :: text
        type(scanner_t), intent(inout) :: scanner
        type(error_t), allocatable, intent(out) :: error

        if (next_byte(text, scanner%at + 1) == "/") then
            call refuse(scanner, scanner%at, "'//' begins no comment, and '/' ends the group; "// &
                        "a comment begins with '!'", error)
        else if (index(" !&"//tab//line_feed//carriage_return, &
                       next_byte(text, scanner%at + 1)) == 0) then
            call refuse(scanner, scanner%at, "'/' ends the group, yet text follows; "// &
                        "a text with '/' in it needs quotes", error)
        else
            scanner%at = scanner%at + 1
        end if
    end subroutine end_group

    pure subroutine end_or_refuse(text, scanner, place, error)
        !! Step over `&end`; any other `&name` means that the group begun at `place` has no `/`.
        character(*), intent(in) :: text
        type(scanner_t), intent(inout) :: scanner
        type(place_t), intent(in) :: place
        type(error_t), allocatable, intent(out) :: error
        integer :: last

        last = token_end(text, scanner%at + 1)
        if (lower(text(scanner%at + 1:last)) == "end") then
            scanner%at = last + 1
        else if (last == scanner%at) then
            call refuse(scanner, scanner%at, "a lone '&'; a list goes on in the next line "// &
                        "without it, and '/' ends a group", error)
        else
            call refuse(scanner, scanner%at, quoted(text(scanner%at:last))//" begins inside "// &
                        "the group, whose '/' is missing (it began on line "// &
                        to_text(place%line)//")", error)
        end if
    end subroutine end_or_refuse
end module lagrangia_namelist_parser
