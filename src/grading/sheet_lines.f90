module lagrangia_sheet_lines
    !! Lines as students write them: words between the formulas, several statements in a line, the
    !! columns of LaTeX's `align`, lines that go on with `= ...`.
    use lagrangia_text, only: word_t
    implicit none (type, external)
    private
    public :: is_remark, read_statements

    character(*), parameter :: letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
    character(*), parameter :: arrows(*) = [character(16) :: "\Longrightarrow", "\Rightarrow", &
        "\implies", "\Leftrightarrow", "\iff", "\rightarrow", "\leadsto", "\to", "\therefore", &
        "<=>", "=>", "->", char(226)//char(135)//char(146), char(226)//char(134)//char(146), &
        char(226)//char(159)//char(185), char(226)//char(135)//char(148), &
        char(226)//char(136)//char(180)]
    character(*), parameter :: lead_words(*) = [character(10) :: "also", "and", "aus", "da", &
        "daher", "damit", "dann", "daraus", "es", "folgt", "gilt", "hence", "ist", "mit", "so", &
        "somit", "then", "thus", "therefore", "und", "where", "with", "wobei", "we", "have", &
        "ergibt"]
    integer, parameter :: most_parts = 20  !! statements of one line

contains

    pure function is_remark(text) result(yes)
        !! Words without a formula: no sign between two sides, no operator, and a line that ends in
        !! a colon, or two words of four letters and more.
        character(*), intent(in) :: text  !! a line without outer blanks
        logical :: yes
        integer :: first, last, long_words

        yes = .false.
        if (text == "" .or. scan(text, "=~+*/^<>_\|{}'") > 0) return
        if (index(text, char(226)//char(137)) > 0) return  ! a sign such as "nearly"
        yes = text(len(text):) == ":" .and. scan(text(1:1), letters) == 1
        long_words = 0
        first = 1
        do while (.not. yes)
            last = scan(text(first:), letters)
            if (last == 0) return
            first = first + last - 1
            last = first + verify(text(first:)//" ", letters) - 2
            long_words = long_words + merge(1, 0, last - first >= 3 .and. &
                                            .not. is_of_formulas(text(first:last)))
            first = last + 1
            yes = long_words >= 2
        end do
    end function is_remark

    pure function is_of_formulas(word) result(yes)
        !! The name of a Greek letter, or of a function.
        character(*), intent(in) :: word
        logical :: yes
        character(*), parameter :: known(*) = [character(7) :: "alpha", "beta", "gamma", "delta", &
            "epsilon", "zeta", "theta", "kappa", "lambda", "sigma", "omega", "Gamma", "Delta", &
            "Theta", "Lambda", "Sigma", "Omega", "sqrt", "sinh", "cosh", "tanh", "atan"]

        yes = any(known == word)
    end function is_of_formulas

    pure subroutine read_statements(line, before, statements)
        !! What a line says, each statement for itself; one that begins with `=` gets the left side
        !! of the one before.
        character(*), intent(in) :: line                            !! without `system:` and so on
        character(*), intent(in) :: before                          !! the statement before, or ""
        type(word_t), allocatable, intent(out) :: statements(:)     !! at least one
        character(:), allocatable :: part, said
        integer :: cuts(most_parts + 1), widths(most_parts + 1), k, n

        call find_cuts(line, cuts, widths, n)
        allocate (statements(n))
        said = before
        do k = 1, n
            part = line(cuts(k):cuts(k + 1) - 1 - widths(k + 1))
            call put_blanks(part)
            call drop_lead(part)
            if (len(part) > 1 .and. index(said, "=") > 1) then
                if (part(1:1) == "=" .and. part(2:2) /= "=") part = trim(said(:index(said, "=") - &
                                                                             1))//" "//part
            end if
            statements(k)%text = part
            if (index(part, "=") > 1) said = part
        end do
    end subroutine read_statements

    pure subroutine find_cuts(line, cuts, widths, n)
        !! The places at which statements begin, and of what separates them the widths; the last one
        !! is behind the line. A line is cut where each part has two sides.
        character(*), intent(in) :: line
        integer, intent(out) :: cuts(:), widths(:), n
        integer :: at, columns, depth, width

        cuts = 1
        widths = 0
        n = 1
        depth = 0
        columns = 0
        at = 1
        do while (at <= len(line))
            width = 0
            select case (line(at:at))
            case ("(", "{", "["); depth = depth + 1
            case (")", "}", "]"); depth = depth - 1
            case (",", ";")
                if (line(max(1, at - 1):at - 1) /= "\") width = 1  ! else a small blank of LaTeX
            case ("&")
                columns = columns + 1
                if (mod(columns, 2) == 0) width = 1
            case ("\")
                if (index(line(at:), "\qquad") == 1) width = 6
                if (index(line(at:), "\quad") == 1) width = 5
            case (" ")
                if (index(line(at:), " und ") == 1 .or. index(line(at:), " and ") == 1) width = 4
            case default
                width = 0
            end select
            if (width > 0 .and. depth == 0 .and. n < most_parts) then
                if (has_sides(line(cuts(n):at - 1)) .and. has_sides(line(at + width:))) then
                    n = n + 1
                    cuts(n) = at + width
                    widths(n) = width
                    columns = 0
                end if
            end if
            at = at + max(1, width)
        end do
        cuts(n + 1) = len(line) + 1
        widths(n + 1) = 0
    end subroutine find_cuts

    pure function has_sides(part) result(yes)
        !! Does something stand on both sides of a sign of equality, or behind one?
        character(*), intent(in) :: part
        logical :: yes
        integer :: at

        at = index(part, "=")
        yes = at > 0
        if (yes) yes = scan(part(at:), letters//"0123456789") > 0
    end function has_sides

    pure subroutine put_blanks(part)
        !! For the signs that end columns of a table.
        character(:), allocatable, intent(inout) :: part
        integer :: i

        i = index(part, "&=") + index(part, "& =") + index(part, "=&") + index(part, "\")
        if (i == 0) return
        do i = 1, len(part)
            if (part(i:i) /= "&") cycle
            if (i > 1) then
                if (part(i - 1:i - 1) == "\") cycle
            end if
            part(i:i) = " "
        end do
    end subroutine put_blanks

    pure subroutine drop_lead(part)
        !! Arrows and words such as `with` in front of a formula, and blanks on both sides.
        character(:), allocatable, intent(inout) :: part
        character(:), allocatable :: word
        integer :: i
        logical :: again

        again = .true.
        do while (again)
            again = .false.
            part = trim(adjustl(part))
            do i = 1, size(arrows)
                if (index(part, trim(arrows(i))) /= 1) cycle
                if (scan(part(len_trim(arrows(i)) + 1:)//" ", letters) == 1) then
                    if (arrows(i) (1:1) == "\") cycle  ! another command
                end if
                part = part(len_trim(arrows(i)) + 1:)
                again = .true.
                exit
            end do
            i = verify(part//" ", letters) - 1
            if (i < 2) cycle
            if (scan(part(i + 1:)//"x", " ,:") /= 1) cycle
            if (index(part, "=") == 0) cycle
            word = part(:i)
            if (scan(word(1:1), "ABCDEFGHIJKLMNOPQRSTUVWXYZ") == 1) word(1:1) = achar(iachar( &
                                                                               word(1:1)) + 32)
            if (.not. any(lead_words == word)) cycle
            if (verify(part(i + 1:index(part, "=") - 1), " ,:") == 0) cycle  ! it is the left side
            part = part(i + 1:)
            if (scan(part//"x", ",:") == 1) part = part(2:)
            again = .true.
        end do
    end subroutine drop_lead
end module lagrangia_sheet_lines
