module lagrangia_namelist_lexer
    !! What comes next in the text of a namelist: space, names and values; and the refusal of what
    !! belongs nowhere.
    use lagrangia_characters, only: described, unlike
    use lagrangia_errors, only: error_t
    use lagrangia_namelist_tree, only: fail_at, in_override, kind_number, kind_string, kind_word, &
                                       max_values, name_length, namelist_t, no_text, one_text, &
                                       raw_text, value_t
    use lagrangia_number_reader, only: after, character_at, digits, letters, misread, &
                                       read_number, starts_number
    use lagrangia_text, only: escaped, lower, quoted, to_text
    implicit none (type, external)
    private
    public :: check_separation, look_for_key, next_byte, read_name, read_value, refuse, &
              refuse_byte, skip_space, small_number, token_end, truth_of
    public :: separators, stray

    character(*), parameter :: line_ends = achar(10)//achar(13)
    character(*), parameter :: separators = " !"//achar(9)//line_ends  !! behind a token
    character(*), parameter :: stray = &
        "'=' stands behind a key, quotes around a text, '!' before a comment"
    character(*), parameter :: token_ends = "!,/'""=()[]{};&%$"

contains

    pure subroutine refuse(tree, position, message, error)
        !! Fail with where, the group and key being read, and `message`.
        type(namelist_t), intent(in) :: tree              !! being read
        integer, intent(in) :: position                   !! in the tree's text
        character(*), intent(in) :: message               !! one line
        type(error_t), allocatable, intent(out) :: error  !! status 2

        if (tree%context == "") then
            call fail_at(tree, position, message, error)
        else
            call fail_at(tree, position, trim(tree%context)//" "//message, error)
        end if
    end subroutine refuse

    pure subroutine refuse_byte(tree, position, error)
        !! Refuse what stands at `position`, saying what it is.
        type(namelist_t), intent(in) :: tree              !! being read
        integer, intent(in) :: position                   !! in the tree's text
        type(error_t), allocatable, intent(out) :: error  !! status 2
        character(:), allocatable :: problem, what
        character(1) :: byte

        byte = tree%text(position:position)
        problem = "unexpected '"//byte//"'; "
        select case (byte)
        case ("(", "[", "{")
            problem = problem//"values stand in a row, as in q = 0.1, 0.2, and nothing is computed"
        case ("=")
            problem = problem//"a key is a plain name before one '='"
        case ("%")
            problem = problem//"a percentage is written as a fraction, 0.1 for ten percent"
        case (";")
            problem = problem//"values and keys are separated by ',' or blanks"
        case ("'", """")
            problem = "unexpected quote; a text is written 'text', a quote in it is doubled"
        case default
            problem = "unexpected "//quoted(byte)
            if (is_control(byte)) then
                problem = "control character "//escaped(byte)//"; write a blank in its place"
            else if (iachar(byte) > 126) then
                what = described(tree%text, position)
                problem = unlike(tree%text(position:))
                if (index(problem, what) /= 1) problem = what//" is not ASCII; other letters "// &
                    "stand in comments and between plain quotes ' or """
            end if
        end select
        call refuse(tree, position, problem, error)
    end subroutine refuse_byte

    pure function next_byte(tree) result(byte)
        !! The byte to be parsed next, a blank behind the end.
        type(namelist_t), intent(in) :: tree  !! being read
        character(1) :: byte

        byte = character_at(tree%text, tree%at)
    end function next_byte

    pure function is_control(byte) result(yes)
        !! Is it a control character other than a line feed?
        character(1), intent(in) :: byte
        logical :: yes

        yes = (iachar(byte) < 32 .and. iachar(byte) /= 10) .or. iachar(byte) == 127
    end function is_control

    pure subroutine skip_space(tree, error)
        !! Step over blanks, tabs, line ends and comments to the next thing, or behind the end.
        type(namelist_t), intent(inout) :: tree           !! moves on
        type(error_t), allocatable, intent(out) :: error  !! status 2: a control character
        integer :: next

        do while (tree%at <= len(tree%text))
            next = tree%at + 1
            select case (next_byte(tree))
            case (" ", achar(9), achar(10))
            case (achar(13))
                next = after(tree%text, tree%at, achar(13))
                if (next <= len(tree%text) .and. character_at(tree%text, next) /= achar(10)) then
                    call refuse(tree, tree%at, "a carriage return without a line feed; end "// &
                                "lines with a line feed", error)
                    return
                end if
            case ("!")
                if (in_override(tree, tree%at)) return
                next = tree%at - 1 + index(tree%text(tree%at:), achar(10))
                if (next < tree%at) next = len(tree%text) + 1
            case default
                if (is_control(next_byte(tree))) call refuse_byte(tree, tree%at, error)
                return
            end select
            tree%at = next
        end do
    end subroutine skip_space

    pure subroutine read_name(tree, what, name, error)
        !! Read the name of `what` ("group" or "key").
        type(namelist_t), intent(inout) :: tree           !! moves behind it
        character(*), intent(in) :: what                  !! for the message
        character(name_length), intent(out) :: name       !! in lower case
        type(error_t), allocatable, intent(out) :: error  !! status 2: none, or too long
        integer :: last

        name = ""
        last = name_end(tree)
        if (last < tree%at .and. iachar(next_byte(tree)) > 126) then
            call refuse(tree, tree%at, described(tree%text, tree%at)//" is not ASCII; the name "// &
                        "of a "//what//" has plain letters, a to z", error)
        else if (last < tree%at) then
            call refuse(tree, tree%at, "expected the name of a "//what// &
                        ", which begins with a letter", error)
        else if (last - tree%at + 1 > name_length) then
            call refuse(tree, tree%at, "the name "//quoted(tree%text(tree%at:last))// &
                        " is longer than "//to_text(name_length)//" characters", error)
        else
            name = lower(tree%text(tree%at:last))
            tree%at = last + 1
        end if
    end subroutine read_name

    pure function name_end(tree) result(last)
        !! The last byte of the name that comes next; before it where there is none.
        type(namelist_t), intent(in) :: tree
        integer :: last

        last = tree%at - 1
        if (scan(next_byte(tree), letters) == 0) return
        last = after(tree%text, tree%at, letters//digits//"_") - 1
    end function name_end

    pure function token_end(text, first) result(last)
        !! The last byte of the bare token beginning at `first`; before it where none begins.
        character(*), intent(in) :: text  !! of the tree
        integer, intent(in) :: first      !! position in it
        integer :: last

        do last = first, len(text)
            if (iachar(text(last:last)) <= 32 .or. iachar(text(last:last)) >= 127) exit
            if (index(token_ends, text(last:last)) > 0) exit
        end do
        last = last - 1
    end function token_end

    pure subroutine read_value(tree, value, error)
        !! Read a text between quotes, a number, a word, or `3*` one of them.
        type(namelist_t), intent(inout) :: tree           !! steps behind it
        type(value_t), intent(out) :: value               !! what was read
        type(error_t), allocatable, intent(out) :: error  !! status 2: it is none
        character(:), allocatable :: problem
        integer :: last, star

        value = value_t(first=tree%at)
        if (scan(next_byte(tree), "'""") == 1) then
            call read_string(tree, value, error)
            return
        end if
        if (starts_number(tree%text(tree%at:)) .and. .not. is_typed_text(tree)) then
            value%kind = kind_number
        end if
        last = token_end(tree%text, tree%at)
        if (in_override(tree, tree%at) .and. value%kind /= kind_number) then
            last = override_end(tree%text, tree%at, tree%typed)
        else
            call refuse_misread(tree, error)
            if (allocated(error)) return
        end if
        if (last < tree%at) then
            call refuse_byte(tree, tree%at, error)
            return
        end if
        star = 0
        if (value%kind == kind_number) star = index(tree%text(tree%at:last), "*")
        if (star > 0) then
            call read_repeats(tree, tree%text(tree%at:tree%at + star - 2), value%repeats, error)
            if (allocated(error)) return
            tree%at = tree%at + star
            value%first = tree%at
            if (scan(next_byte(tree), "'""") == 1) then
                call read_string(tree, value, error)
                return
            else if (scan(next_byte(tree), "(=") == 1) then
                call refuse_byte(tree, tree%at, error)
                return
            else if (tree%at > last) then
                call refuse(tree, tree%at - 1, "'"//to_text(value%repeats)//"*' repeats no "// &
                            "value; write "//to_text(value%repeats)//"*0.0", error)
                return
            end if
            if (.not. starts_number(tree%text(tree%at:last))) value%kind = kind_word
        end if
        value%last = last
        if (value%kind == kind_number) then
            call read_number(raw_text(tree, value), value%number, problem)
            if (problem /= "") then
                call refuse(tree, tree%at, quoted(raw_text(tree, value))//" "//problem, error)
            end if
        end if
        tree%at = last + 1
    end subroutine read_value

    pure subroutine read_string(tree, value, error)
        !! Read a text between quotes, which ends on its line.
        type(namelist_t), intent(inout) :: tree
        type(value_t), intent(inout) :: value
        type(error_t), allocatable, intent(out) :: error
        character(1) :: byte, mark
        integer :: last

        mark = next_byte(tree)
        last = tree%at
        do
            last = last + 1
            byte = character_at(tree%text, last)
            if (byte == mark) then
                if (character_at(tree%text, last + 1) /= mark) exit
                last = last + 1
            else if (last > len(tree%text) .or. scan(byte, line_ends) == 1) then
                call refuse(tree, tree%at, "the text that begins with "// &
                            escaped(tree%text(tree%at:last - 1), 20)// &
                            " is not closed with "//mark//" on its line", error)
                return
            else if (is_control(byte)) then
                call refuse_byte(tree, last, error)
                return
            end if
        end do
        value%kind = kind_string
        value%last = last
        tree%at = last + 1
    end subroutine read_string

    pure subroutine check_separation(tree, kind, error)
        !! Refuse what directly follows a value and does not separate it from the next.
        type(namelist_t), intent(in) :: tree              !! behind the value
        integer, intent(in) :: kind                       !! of the value
        type(error_t), allocatable, intent(out) :: error  !! status 2: something follows

        if (index(separators//",/", next_byte(tree)) > 0) return
        if (kind == kind_string .and. scan(next_byte(tree), letters//digits// &
            "^*+-)_.") == 1) then
            call refuse(tree, tree%at, "unexpected "//quoted(next_byte(tree))// &
                        " behind a text; a quote within it is doubled", error)
        else
            call refuse_byte(tree, tree%at, error)
        end if
    end subroutine check_separation

    pure subroutine refuse_misread(tree, error)
        !! Refuse what is no number, but means one.
        type(namelist_t), intent(in) :: tree
        type(error_t), allocatable, intent(out) :: error
        character(:), allocatable :: phrase, problem
        integer, parameter :: most = 80
        integer :: last

        do last = tree%at, min(len(tree%text), tree%at + most)
            if (scan(tree%text(last:last), ","//line_ends) == 1) exit
        end do
        call misread(tree%text(tree%at:last - 1), phrase, problem)
        if (problem == "") return
        if (character_at(tree%text, tree%at - 1) == "," .and. &
            scan(tree%text(max(1, tree%at - 2):max(1, tree%at - 2)), digits) == 1) then
            problem = "a decimal point, no comma, is needed before it; or a blank behind the comma"
        end if
        call refuse(tree, tree%at, quoted(phrase)//": "//problem, error)
    end subroutine refuse_misread

    pure subroutine read_repeats(tree, figures, repeats, error)
        !! The repeat count that comes next, as `figures`.
        type(namelist_t), intent(in) :: tree
        character(*), intent(in) :: figures
        integer, intent(out) :: repeats
        type(error_t), allocatable, intent(out) :: error

        repeats = 0
        if (verify(figures, digits) > 0) then
            call refuse(tree, tree%at, quoted(figures//"*")//": a repeat count is a whole "// &
                        "number; products are not computed", error)
            return
        end if
        repeats = small_number(figures)
        if (repeats >= 1 .and. repeats <= max_values) return
        call refuse(tree, tree%at, "the repeat count "//quoted(figures, 20)// &
                    " must be from 1 to "//to_text(max_values), error)
    end subroutine read_repeats

    pure function small_number(figures) result(number)
        !! The number that these digits say, at most one more than `max_values`.
        character(*), intent(in) :: figures      !! digits alone
        integer :: number
        integer :: i

        number = 0
        do i = 1, len(figures)
            number = min(max_values + 1, 10*number + index(digits, figures(i:i)) - 1)
        end do
    end function small_number

    pure function is_typed_text(tree) result(yes)
        !! Is what comes next a text of an override, though it may begin like a number: `2*x`?
        !! `2*'x'` has quotes.
        type(namelist_t), intent(in) :: tree
        logical :: yes

        yes = tree%typed /= no_text .and. in_override(tree, tree%at)
        if (yes) yes = scan(tree%text(tree%at:), "'""") == 0
    end function is_typed_text

    pure function override_end(text, first, typed) result(last)
        !! The last byte of a text without quotes in an override: it runs to the next comma, and to
        !! the end where the key takes one text.
        character(*), intent(in) :: text
        integer, intent(in) :: first, typed
        integer :: last

        last = first - 1
        if (scan(text(first:first), "),;=") == 1) return
        if (text(first:first) == "(" .and. typed == no_text) return
        do last = first, len(text)
            if (text(last:last) == "," .and. typed /= one_text) exit
            if (iachar(text(last:last)) < 32 .or. iachar(text(last:last)) == 127) exit
        end do
        last = first - 1 + len_trim(text(first:last - 1))
    end function override_end

    pure function truth_of(word) result(truth)
        !! 1 for `.true.`, `.t.`, `true` or `t`, 0 for their opposites, else -1.
        character(*), intent(in) :: word         !! in any case
        integer :: truth

        select case (lower(word))
        case (".true.", ".t.", ".t", "true", "t")
            truth = 1
        case (".false.", ".f.", ".f", "false", "f")
            truth = 0
        case default
            truth = -1
        end select
    end function truth_of

    pure subroutine look_for_key(tree, found)
        !! Does `key =`, `key(` or `key%` come next, rather than a value?
        type(namelist_t), intent(inout) :: tree  !! stays where it is
        logical, intent(out) :: found            !! a key comes next
        type(error_t), allocatable :: error
        integer :: at

        at = tree%at
        tree%at = name_end(tree) + 1
        found = tree%at > at
        if (found) call skip_space(tree, error)
        if (found) found = .not. allocated(error) .and. index("=(%", next_byte(tree)) > 0
        tree%at = at
    end subroutine look_for_key
end module lagrangia_namelist_lexer
