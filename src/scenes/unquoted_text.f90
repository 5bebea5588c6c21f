module lagrangia_unquoted_text
    !! A text of a scene that was written without quotes, `T = 1/2 m v^2`: it is no list of values,
    !! and what is wrong with it as one is no help. The remedy is the line with quotes.
    use lagrangia_errors, only: error_t
    use lagrangia_namelist, only: namelist_t
    use lagrangia_namelist_tree, only: entry_t, fail_at, in_override, kind_number, kind_string, &
                                       label, line_of, no_text, one_text, some_texts, spelling
    use lagrangia_scene_reference, only: entries
    use lagrangia_text, only: escaped, lower
    implicit none (type, external)
    private
    public :: ask_for_quotes, refuse_unquoted, texts_of

    character(*), parameter :: single(*) = [character(9) :: "title", "output", "t", "v", "l", &
        "strobe", "section", "energy_by"]  !! of which there is one, commas or not

contains

    pure subroutine ask_for_quotes(tree, error)
        !! Where the parser gave up in a text without quotes, say that instead of its reason.
        type(namelist_t), intent(in) :: tree                !! as the parser left it
        type(error_t), allocatable, intent(inout) :: error  !! the parser's

        if (tree%entry_count == 0) return
        associate (item => tree%entries(tree%entry_count))
            if (line_of(tree, min(tree%at, len(tree%text))) /= line_of(tree, item%at)) return
            call show_quotes(tree, item, error)
        end associate
    end subroutine ask_for_quotes

    pure subroutine refuse_unquoted(tree, error)
        !! Refuse a text of a file whose words can be read as several values: `V = 2*x` is x twice,
        !! `V = 2 k` a number and a word.
        type(namelist_t), intent(in) :: tree              !! as the parser left it
        type(error_t), allocatable, intent(out) :: error  !! status 2: with the line as it is meant
        integer :: i, k

        do i = 1, tree%entry_count
            associate (item => tree%entries(i))
                if (item%count < 2) cycle
                do k = item%first_value, item%last_value
                    if (tree%values(k)%kind == kind_string) cycle
                    if (tree%values(k)%kind == kind_number .or. tree%values(k)%repeats > 1 .or. &
                        is_single(trim(tree%groups(item%group)%name), trim(item%key))) then
                        call show_quotes(tree, item, error)
                    end if
                    if (allocated(error)) return
                end do
            end associate
        end do
    end subroutine refuse_unquoted

    pure subroutine show_quotes(tree, item, error)
        !! Refuse an entry that is a text without quotes, and write it with them; do nothing where
        !! it is none.
        type(namelist_t), intent(in) :: tree
        type(entry_t), intent(in) :: item
        type(error_t), allocatable, intent(inout) :: error
        character(:), allocatable :: example, group, key, text
        character(1) :: mark
        integer :: equals

        group = trim(tree%groups(item%group)%name)
        example = text_example(group, trim(item%key))
        equals = index(tree%text(item%at:), "=")
        if (example == "" .or. equals == 0) return
        text = rest_of_line(tree, item%at + equals)
        if (text == "" .or. scan(text, "'""") == 1) return
        key = spelling(tree, item)
        mark = "'"
        if (index(text, "'") > 0) mark = '"'
        text = mark//escaped(text, 70)//mark
        if (index(text, ",") > 0 .and. .not. is_single(group, trim(item%key)) .or. &
            index(example, "', '") > 0) then
            text = "its texts stand between quotes, as in "//example
        else if (in_override(tree, item%at)) then
            text = 'it is a text, and needs quotes: --set "'//group//"%"//key//"="//text//'"'
        else
            text = "it is a text, and needs quotes: "//key//" = "//text
        end if
        call fail_at(tree, item%at + equals + blanks(tree%text(item%at + equals:)), &
                     label(group, key)//": "//text, error)
    end subroutine show_quotes

    pure function texts_of(override) result(typed)
        !! What the key of an override takes, which then needs no quotes: one text, some, or none.
        character(*), intent(in) :: override  !! `GROUP%KEY=VALUE`, as typed
        integer :: typed                      !! `one_text`, `some_texts` or `no_text`
        character(:), allocatable :: group, key
        integer :: behind, percent

        typed = no_text
        percent = index(override, "%")
        behind = scan(override, "=(")
        if (percent == 0 .or. behind < percent) return
        group = lower(trim(adjustl(override(:percent - 1))))
        key = lower(trim(adjustl(override(percent + 1:behind - 1))))
        if (text_example(group, key) == "") return
        typed = merge(one_text, some_texts, is_single(group, key))
    end function texts_of

    pure function is_single(group, key) result(yes)
        !! Does the key take one text, commas or not?
        character(*), intent(in) :: group, key  !! in lower case
        logical :: yes

        yes = any(single == key) .or. group == "lagrangian" .and. index(key, "q_") == 1
    end function is_single

    pure function text_example(group, key) result(example)
        !! A line with the key, if its values are texts; else empty.
        character(*), intent(in) :: group, key  !! in lower case
        character(:), allocatable :: example
        integer :: i

        example = ""
        do i = 1, size(entries)
            if (entries(i)%group /= group .or. index(entries(i)%example, "= '") == 0) cycle
            if (lower(entries(i)%key) == key .or. (entries(i)%key == "Q_NAME" .and. &
                                                   index(key, "q_") == 1)) example = &
                trim(entries(i)%example)
        end do
    end function text_example

    pure function rest_of_line(tree, first) result(text)
        !! What stands from there on to the end of the line, or to the next key of a scene,
        !! without a comment, a last comma or the end of the group.
        type(namelist_t), intent(in) :: tree
        integer, intent(in) :: first  !! behind `=`
        character(:), allocatable :: text
        integer :: i, last

        last = scan(tree%text(first:), "!"//achar(10)//achar(13)) - 1
        if (last < 0) last = len(tree%text) - first + 1
        text = tree%text(first:first + last - 1)
        do i = 1, size(entries)
            last = key_start(text, lower(trim(entries(i)%key))) - 1
            if (last >= 0) text = text(:last)
        end do
        text = trim(adjustl(text))
        last = len(text)
        if (last > 0) then
            if (scan(text(last:last), "/,;") == 1) text = trim(text(:last - 1))
        end if
    end function rest_of_line

    pure function key_start(text, key) result(first)
        !! Where ` key =` begins, at the blank or comma before it; 0: nowhere.
        character(*), intent(in) :: text, key
        integer :: first
        integer :: behind

        do first = 1, len(text) - len(key)
            if (scan(text(first:first), " ,") == 0) cycle
            behind = first + 1 + len(key)
            if (lower(text(first + 1:behind - 1)) /= key) cycle
            if (index(adjustl(text(behind:)), "=") == 1) return
        end do
        first = 0
    end function key_start

    pure function blanks(text) result(count)
        !! With which the text begins.
        character(*), intent(in) :: text
        integer :: count

        count = max(0, verify(text, " "//achar(9)) - 1)
    end function blanks
end module lagrangia_unquoted_text
