module lagrangia_namelist_entries
    !! Reading `key = values`: one entry of a namelist group.
    use lagrangia_errors, only: error_t
    use lagrangia_namelist_scanner, only: next_byte, place_at, read_name, refuse, scanner_t, &
                                          skip_space
    use lagrangia_namelist_tree, only: add_entry, entry_t, max_values, namelist_t, settle_twins
    use lagrangia_namelist_values, only: read_values
    use lagrangia_text, only: escaped, to_text
    implicit none (type, external)
    private
    public :: read_entry

    character(*), parameter :: digits = "0123456789"

contains

    pure subroutine read_entry(text, scanner, tree, group, error)
        !! Read one entry of the group at position `group`.
        character(*), intent(in) :: text
        type(scanner_t), intent(inout) :: scanner
        type(namelist_t), intent(inout) :: tree
        integer, intent(in) :: group
        type(error_t), allocatable, intent(out) :: error
        type(entry_t) :: item

        item%group = group
        item%overrides = scanner%overrides
        item%place = place_at(scanner, scanner%at)
        call read_name(text, scanner, "key", item%key, error)
        if (allocated(error)) return
        scanner%context = "&"//escaped(trim(tree%groups(group)%name), 30)//": "// &
                          escaped(trim(item%key), 30)//":"
        call skip_space(text, scanner, error)
        if (allocated(error)) return
        if (next_byte(text, scanner%at) == "(") then
            call read_index(text, scanner, item%index, error)
            if (allocated(error)) return
            call skip_space(text, scanner, error)
            if (allocated(error)) return
        end if
        if (next_byte(text, scanner%at) == "%") then
            call refuse(scanner, scanner%at, "components (a%b) are not read here; "// &
                        "write key = value inside &group", error)
        else if (next_byte(text, scanner%at) /= "=") then
            call refuse(scanner, scanner%at, "expected '=' after the key", error)
        else
            call add_entry(tree, item, error)
        end if
        if (allocated(error)) return
        scanner%at = scanner%at + 1
        if (next_byte(text, scanner%at) == "=") then
            call refuse(scanner, scanner%at, "'==' compares; one '=' gives a value", error)
            return
        end if
        call read_values(text, scanner, tree, error)
        if (allocated(error)) return
        call settle_twins(tree, error)
    end subroutine read_entry

    pure subroutine read_index(text, scanner, index_read, error)
        !! Read `(2)`.
        character(*), intent(in) :: text
        type(scanner_t), intent(inout) :: scanner
        integer, intent(out) :: index_read
        type(error_t), allocatable, intent(out) :: error
        integer :: first

        index_read = 0
        scanner%at = scanner%at + 1
        call skip_space(text, scanner, error)
        if (allocated(error)) return
        first = scanner%at
        do while (scan(next_byte(text, scanner%at), digits) == 1)
            index_read = min(max_values + 1, &
                             10*index_read + index(digits, text(scanner%at:scanner%at)) - 1)
            scanner%at = scanner%at + 1
        end do
        if (scanner%at > first .and. (index_read < 1 .or. index_read > max_values)) then
            call refuse(scanner, first, "the index must be from 1 to "//to_text(max_values), error)
            return
        end if
        call skip_space(text, scanner, error)
        if (allocated(error)) return
        select case (next_byte(text, scanner%at))
        case (":")
            call refuse(scanner, scanner%at, "array sections (1:2) are not read here; "// &
                        "write all values after the key, or one index", error)
        case (",")
            call refuse(scanner, scanner%at, "only one index is read here, as in q(2) = 1.0", &
                        error)
        case (")")
            if (index_read == 0) then
                call refuse(scanner, scanner%at, "the index is missing, as in q(2) = 1.0", error)
            end if
            scanner%at = scanner%at + 1
        case default
            call refuse(scanner, scanner%at, "expected one index and ')', as in q(2) = 1.0", error)
        end select
    end subroutine read_index
end module lagrangia_namelist_entries
