module lagrangia_namelist_values
    !! Reading what stands behind the `=` of an entry.
    use lagrangia_errors, only: error_t
    use lagrangia_namelist_scanner, only: begins_key, begins_name, carriage_return, line_feed, &
                                          next_byte, refuse, refuse_byte, scanner_t, skip_space, &
                                          tab, token_end
    use lagrangia_namelist_tree, only: add_value, kind_number, kind_string, kind_word, &
                                       max_values, namelist_t, value_t
    use lagrangia_namelist_words, only: misread, stray, truth_of
    use lagrangia_number_reader, only: read_number, starts_number
    use lagrangia_text, only: escaped, quoted, to_text
    implicit none (type, external)
    private
    public :: read_values

    character(*), parameter :: digits = "0123456789"

contains

    pure subroutine read_values(text, scanner, tree, error)
        !! Read what stands behind `=` up to the next key or the end of the group.
        character(*), intent(in) :: text
        type(scanner_t), intent(inout) :: scanner
        type(namelist_t), intent(inout) :: tree
        type(error_t), allocatable, intent(out) :: error
        type(scanner_t) :: before
        character(1) :: byte
        logical :: after_comma

        before = scanner
        after_comma = .true.
        do
            call skip_space(text, scanner, error)
            if (allocated(error)) return
            byte = next_byte(text, scanner%at)
            if (scanner%at > len(text)) exit
            if (.not. scanner%overrides .and. (byte == "/" .or. byte == "&")) exit
            if (byte == ",") then
                if (after_comma) exit
                scanner%at = scanner%at + 1
                after_comma = .true.
                cycle
            end if
            if (.not. scanner%overrides) then
                if (begins_key(text, scanner)) exit
            end if
            if (byte == "'" .or. byte == """") then
                call read_string(text, scanner, 1, tree, error)
            else
                if (.not. after_comma) call refuse_stray(text, scanner, tree, error)
                if (allocated(error)) return
                call read_bare(text, scanner, tree, error)
            end if
            if (allocated(error)) return
            after_comma = .false.
        end do
        if (tree%entries(tree%entry_count)%count == 0) then
            call refuse(before, before%at, "no value after '='; write one (expressions are "// &
                        "not computed), or leave the key out", error)
        else if (byte == "," .and. after_comma) then
            call refuse(scanner, scanner%at, "an empty value between commas; write every value", &
                        error)
        end if
    end subroutine read_values

    pure subroutine refuse_stray(text, scanner, tree, error)
        !! Refuse a word that follows a value without a comma, unless it is `true` or the like: a
        !! unit, a key without `=`, a comment without `!`.
        character(*), intent(in) :: text
        type(scanner_t), intent(in) :: scanner
        type(namelist_t), intent(in) :: tree
        type(error_t), allocatable, intent(out) :: error

        if (scanner%overrides .or. starts_number(text(scanner%at:))) return
        associate (word => text(scanner%at:token_end(text, scanner%at)), &
                   value => tree%values(tree%value_count))
            if (word == "" .or. truth_of(word) >= 0) return
            if (value%kind == kind_number .and. value%line == scanner%line .and. &
                scan(word(1:1), "#%:<>*\") == 0) then
                call refuse(scanner, scanner%at, "unexpected "//quoted(word)//" behind a "// &
                            "number; units are not written: all are SI, angles in radians", error)
            else
                call refuse(scanner, scanner%at, "unexpected "//quoted(word)//"; "//stray, error)
            end if
        end associate
    end subroutine refuse_stray

    pure subroutine read_string(text, scanner, repeats, tree, error)
        !! Read a text between quotes, which ends on its line.
        character(*), intent(in) :: text
        type(scanner_t), intent(inout) :: scanner
        integer, intent(in) :: repeats
        type(namelist_t), intent(inout) :: tree
        type(error_t), allocatable, intent(out) :: error
        character(1) :: mark
        integer :: last

        mark = text(scanner%at:scanner%at)
        last = scanner%at
        do
            last = last + 1
            if (next_byte(text, last) == mark) then
                if (next_byte(text, last + 1) /= mark) exit
                last = last + 1
            else if (last > len(text) .or. &
                     scan(next_byte(text, last), line_feed//carriage_return) == 1) then
                call refuse(scanner, scanner%at, "the text that begins with "// &
                            escaped(text(scanner%at:last - 1), 20)// &
                            " is not closed with "//mark//" on its line", error)
                return
            else if (iachar(text(last:last)) < 32 .or. iachar(text(last:last)) == 127) then
                call refuse_byte(text, scanner, last, error)
                return
            end if
        end do
        call append(text, scanner, kind_string, scanner%at, last, repeats, tree, error)
    end subroutine read_string

    pure subroutine read_bare(text, scanner, tree, error)
        !! Read a number, a word, or `3*` either of them or a quoted text.
        character(*), intent(in) :: text
        type(scanner_t), intent(inout) :: scanner
        type(namelist_t), intent(inout) :: tree
        type(error_t), allocatable, intent(out) :: error
        integer :: last, repeats, star

        if (starts_number(text(scanner%at:)) .or. .not. scanner%overrides) then
            call refuse_misread(text, scanner, error)
            if (allocated(error)) return
        end if
        last = token_end(text, scanner%at)
        if (scanner%overrides .and. .not. starts_number(text(scanner%at:))) then
            last = override_end(text, scanner%at)
        end if
        if (last < scanner%at) then
            call refuse_byte(text, scanner, scanner%at, error)
            return
        end if
        repeats = 1
        star = 0
        if (starts_number(text(scanner%at:last))) star = index(text(scanner%at:last), "*")
        if (star > 0) then
            call read_repeats(text, scanner, scanner%at + star - 2, repeats, error)
            if (allocated(error)) return
            scanner%at = scanner%at + star
            if (scan(next_byte(text, scanner%at), "'""") == 1) then
                call read_string(text, scanner, repeats, tree, error)
                return
            else if (scan(next_byte(text, scanner%at), "(=") == 1) then
                call refuse_byte(text, scanner, scanner%at, error)
                return
            else if (scanner%at > last) then
                call refuse(scanner, scanner%at - 1, "'"//to_text(repeats)//"*' repeats no "// &
                            "value; write "//to_text(repeats)//"*0.0", error)
                return
            end if
        end if
        if (starts_number(text(scanner%at:last))) then
            call append(text, scanner, kind_number, scanner%at, last, repeats, tree, error)
        else
            call append(text, scanner, kind_word, scanner%at, last, repeats, tree, error)
        end if
    end subroutine read_bare

    pure subroutine refuse_misread(text, scanner, error)
        !! Refuse what is no number, but means one.
        character(*), intent(in) :: text
        type(scanner_t), intent(in) :: scanner
        type(error_t), allocatable, intent(out) :: error
        character(:), allocatable :: phrase, problem
        integer, parameter :: most = 80
        integer :: length

        associate (rest => text(scanner%at:min(len(text), scanner%at + most)))
            length = scan(rest//line_feed, ","//line_feed//carriage_return) - 1
            call misread(rest(:length), phrase, problem)
        end associate
        if (problem == "") return
        if (next_byte(text, scanner%at - 1) == "," .and. &
            scan(text(max(1, scanner%at - 2):max(1, scanner%at - 2)), digits) == 1) then
            problem = "a decimal point, no comma, is needed before it; or a blank behind the comma"
        end if
        call refuse(scanner, scanner%at, quoted(phrase)//": "//problem, error)
    end subroutine refuse_misread

    pure subroutine read_repeats(text, scanner, last, repeats, error)
        !! The repeat count from here to `last`.
        character(*), intent(in) :: text
        type(scanner_t), intent(in) :: scanner
        integer, intent(in) :: last
        integer, intent(out) :: repeats
        type(error_t), allocatable, intent(out) :: error
        integer :: i

        repeats = 0
        if (verify(text(scanner%at:last), digits) > 0) then
            call refuse(scanner, scanner%at, quoted(text(scanner%at:last)//"*")//": a repeat "// &
                        "count is a whole number; products are not computed", error)
            return
        end if
        do i = scanner%at, last
            repeats = min(max_values + 1, 10*repeats + index(digits, text(i:i)) - 1)
        end do
        if (repeats < 1 .or. repeats > max_values) then
            call refuse(scanner, scanner%at, "the repeat count "// &
                        quoted(text(scanner%at:last), 20)//" must be from 1 to "// &
                        to_text(max_values), error)
        end if
    end subroutine read_repeats

    pure function override_end(text, first) result(last)
        !! The last byte of a text without quotes in an override: it runs to the next comma.
        character(*), intent(in) :: text
        integer, intent(in) :: first
        integer :: last

        last = first - 1
        if (scan(text(first:first), "(),;=") == 1) return
        do while (last < len(text))
            associate (byte => text(last + 1:last + 1))
                if (byte == "," .or. iachar(byte) < 32 .or. iachar(byte) == 127) exit
            end associate
            last = last + 1
        end do
        last = first - 1 + len_trim(text(first:last))
    end function override_end

    pure subroutine append(text, scanner, kind, first, last, repeats, tree, error)
        !! Add the value from `first` to `last` and step behind it, where a separator must be.
        character(*), intent(in) :: text
        type(scanner_t), intent(inout) :: scanner
        integer, intent(in) :: kind, first, last, repeats
        type(namelist_t), intent(inout) :: tree
        type(error_t), allocatable, intent(out) :: error
        character(:), allocatable :: problem
        type(value_t) :: value

        value%kind = kind
        value%first = scanner%offset + first + merge(1, 0, kind == kind_string)
        value%last = scanner%offset + last - merge(1, 0, kind == kind_string)
        value%repeats = repeats
        value%line = merge(0, scanner%line, scanner%overrides)
        value%column = first - scanner%line_start + 1
        if (kind == kind_number) then
            call read_number(text(first:last), value%number, problem)
            if (len(problem) > 0) then
                call refuse(scanner, first, quoted(text(first:last))//" "//problem, error)
                return
            end if
        end if
        call add_value(tree, value, error)
        if (allocated(error)) return
        scanner%at = last + 1
        if (index(" ,/!"//tab//line_feed//carriage_return, next_byte(text, last + 1)) > 0) return
        if (kind == kind_string .and. begins_name(text, last + 1)) then
            call refuse(scanner, last + 1, "unexpected "//quoted(text(last + 1:last + 1))// &
                        " behind a text; a quote within it is doubled", error)
        else
            call refuse_byte(text, scanner, last + 1, error)
        end if
    end subroutine append
end module lagrangia_namelist_values
