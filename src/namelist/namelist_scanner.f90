module lagrangia_namelist_scanner
    !! Where the reader of a namelist stands in its text, and the steps it can take there.
    use lagrangia_characters, only: described, unlike
    use lagrangia_errors, only: error_t
    use lagrangia_namelist_tree, only: fail_at, name_length, place_t
    use lagrangia_text, only: escaped, lower, quoted, to_text
    implicit none (type, external)
    private
    public :: begins_key, begins_name, next_byte, place_at, read_name, refuse, refuse_byte, &
              scanner_t, skip_space, token_end
    public :: carriage_return, line_feed, tab

    character(1), parameter :: tab = achar(9)
    character(1), parameter :: line_feed = achar(10)
    character(1), parameter :: carriage_return = achar(13)
    character(*), parameter :: small_letters = "abcdefghijklmnopqrstuvwxyz"
    character(*), parameter :: token_ends = " ,/!'""=()[]{};&%$"

    type :: scanner_t
        !! A position in a text, with what a message about it needs.
        integer :: at = 1              !! the byte to be read next
        integer :: line = 1
        integer :: line_start = 1      !! where that line begins
        integer :: offset = 0          !! of this text in the tree's text
        logical :: overrides = .false. !! the text is `GROUP%KEY=VALUE`, not a file
        character(100) :: source = ""
        character(100) :: context = "" !! `&scene dt: `
    end type scanner_t

contains

    pure function place_at(scanner, position) result(place)
        !! The place of a byte in the line being read.
        type(scanner_t), intent(in) :: scanner
        integer, intent(in) :: position
        type(place_t) :: place

        place%source = scanner%source
        if (scanner%overrides) return
        place%line = scanner%line
        place%column = position - scanner%line_start + 1
    end function place_at

    pure subroutine refuse(scanner, position, message, error)
        !! Fail with where, the group and key being read, and `message`.
        type(scanner_t), intent(in) :: scanner
        integer, intent(in) :: position
        character(*), intent(in) :: message
        type(error_t), allocatable, intent(out) :: error

        if (scanner%context == "") then
            call fail_at(error, place_at(scanner, position), message)
        else
            call fail_at(error, place_at(scanner, position), trim(scanner%context)//" "//message)
        end if
    end subroutine refuse

    pure subroutine refuse_byte(text, scanner, position, error)
        !! Refuse what stands at `position`, saying what it is.
        character(*), intent(in) :: text
        type(scanner_t), intent(in) :: scanner
        integer, intent(in) :: position
        type(error_t), allocatable, intent(out) :: error
        character(:), allocatable :: odd, what
        character(1) :: byte

        byte = text(position:position)
        if (is_control(byte)) then
            call refuse(scanner, position, "control character "//escaped(byte)// &
                        "; only plain text is read", error)
        else if (iachar(byte) > 126) then
            what = described(text, position)
            odd = unlike(text(position:))
            if (index(odd, what) /= 1) odd = what//" is not ASCII; other letters stand in "// &
                "comments and between plain quotes ' or """
            call refuse(scanner, position, odd, error)
        else if (scan(byte, "([{") == 1) then
            call refuse(scanner, position, "unexpected '"//byte//"'; values stand in a row, as "// &
                        "in q = 0.1, 0.2, and nothing is computed", error)
        else if (byte == "=") then
            call refuse(scanner, position, "unexpected '='; a key is a plain name before one '='", &
                        error)
        else if (byte == ";") then
            call refuse(scanner, position, "unexpected ';'; values and keys are separated "// &
                        "by ',' or blanks", error)
        else if (byte == "'" .or. byte == """") then
            call refuse(scanner, position, "unexpected quote; a text is written 'text', "// &
                        "a quote in it is doubled", error)
        else
            call refuse(scanner, position, "unexpected "//quoted(byte), error)
        end if
    end subroutine refuse_byte

    pure function next_byte(text, position) result(byte)
        !! The byte at `position`, a blank behind the end.
        character(*), intent(in) :: text
        integer, intent(in) :: position
        character(1) :: byte

        byte = " "
        if (position <= len(text)) byte = text(position:position)
    end function next_byte

    pure function is_control(byte) result(yes)
        !! Is it a control character other than those that end or indent lines?
        character(1), intent(in) :: byte
        logical :: yes

        yes = (iachar(byte) < 32 .and. byte /= line_feed) .or. iachar(byte) == 127
    end function is_control

    pure function is_letter(byte) result(yes)
        !! Is it one of A to Z, a to z?
        character(1), intent(in) :: byte
        logical :: yes

        yes = index(small_letters, lower(byte)) > 0
    end function is_letter

    pure subroutine skip_space(text, scanner, error)
        !! Step over blanks, tabs, line ends and comments to the next thing, or behind the end.
        character(*), intent(in) :: text
        type(scanner_t), intent(inout) :: scanner
        type(error_t), allocatable, intent(out) :: error
        integer :: length

        do while (scanner%at <= len(text))
            select case (text(scanner%at:scanner%at))
            case (" ", tab)
                scanner%at = scanner%at + 1
            case (line_feed)
                scanner%at = scanner%at + 1
                scanner%line = scanner%line + 1
                scanner%line_start = scanner%at
            case (carriage_return)
                length = verify(text(scanner%at:), carriage_return) - 1
                if (length < 0) length = len(text) - scanner%at + 1
                if (scanner%at + length <= len(text)) then
                    if (text(scanner%at + length:scanner%at + length) /= line_feed) then
                        call refuse(scanner, scanner%at, "a carriage return without a line "// &
                                    "feed; end lines with a line feed", error)
                        return
                    end if
                end if
                scanner%at = scanner%at + length
            case ("!")
                if (scanner%overrides) return
                length = index(text(scanner%at:), line_feed) - 1
                if (length < 0) length = len(text) - scanner%at + 1
                scanner%at = scanner%at + length
            case default
                if (is_control(text(scanner%at:scanner%at))) then
                    call refuse_byte(text, scanner, scanner%at, error)
                end if
                return
            end select
        end do
    end subroutine skip_space

    pure subroutine read_name(text, scanner, what, name, error)
        !! Read the name of `what` ("group" or "key"), in lower case.
        character(*), intent(in) :: text
        type(scanner_t), intent(inout) :: scanner
        character(*), intent(in) :: what
        character(name_length), intent(out) :: name
        type(error_t), allocatable, intent(out) :: error
        integer :: last

        name = ""
        last = name_end(text, scanner%at)
        if (.not. begins_name(text, scanner%at)) then
            call refuse(scanner, scanner%at, "expected the name of a "//what// &
                        ", which begins with a letter", error)
        else if (last - scanner%at + 1 > name_length) then
            call refuse(scanner, scanner%at, "the name "//quoted(text(scanner%at:last))// &
                        " is longer than "//to_text(name_length)//" characters", error)
        else
            name = lower(text(scanner%at:last))
            scanner%at = last + 1
        end if
    end subroutine read_name

    pure function begins_name(text, position) result(yes)
        !! Does a name begin at `position`?
        character(*), intent(in) :: text
        integer, intent(in) :: position
        logical :: yes

        yes = name_end(text, position) >= position
    end function begins_name

    pure function name_end(text, first) result(last)
        !! The last byte of the name beginning at `first`; before it where none begins.
        character(*), intent(in) :: text
        integer, intent(in) :: first
        integer :: last

        last = first - 1
        if (first > len(text)) return
        if (.not. is_letter(text(first:first))) return
        do while (last < len(text))
            if (index(small_letters//"0123456789_", lower(text(last + 1:last + 1))) == 0) exit
            last = last + 1
        end do
    end function name_end

    pure function token_end(text, first) result(last)
        !! The last byte of the bare token beginning at `first`; before it where none begins.
        character(*), intent(in) :: text
        integer, intent(in) :: first
        integer :: last

        last = first - 1
        do while (last < len(text))
            associate (byte => text(last + 1:last + 1))
                if (iachar(byte) <= 32 .or. iachar(byte) >= 127) exit
                if (index(token_ends, byte) > 0) exit
            end associate
            last = last + 1
        end do
    end function token_end

    pure function begins_key(text, scanner) result(yes)
        !! Does `key =`, `key(` or `key%` begin here, rather than a value?
        character(*), intent(in) :: text
        type(scanner_t), intent(in) :: scanner
        logical :: yes
        type(scanner_t) :: ahead
        type(error_t), allocatable :: error

        yes = .false.
        ahead = scanner
        ahead%at = name_end(text, scanner%at) + 1
        if (ahead%at == scanner%at) return
        call skip_space(text, ahead, error)
        if (allocated(error) .or. ahead%at > len(text)) return
        yes = index("=(%", text(ahead%at:ahead%at)) > 0
    end function begins_key
end module lagrangia_namelist_scanner
