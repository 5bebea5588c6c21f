module lagrangia_latex_source
    !! Formulas that are pasted from LaTeX, in plain letters: `theta_ddot + ((g)/(l)) sin(theta)`
    !! for `\ddot\theta + \frac{g}{l}\sin\theta`.
    !!
    !! Letters side by side are a product there, `mgl`, and an index is one letter or a group.
    use lagrangia_errors, only: error_t, fail
    use lagrangia_text, only: quoted, to_text
    implicit none (type, external)
    private
    public :: plain_latex
    ! gfortran 12 hides others from submodules:
    public :: find_group, functions, greek, inside, put, put_name, source_t, take_argument, &
              take_exponent, take_index

    character(*), parameter :: digits = "0123456789"
    character(*), parameter :: letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
    character(*), parameter :: inside = letters//"_"//digits
    character(*), parameter :: greek(*) = [character(7) :: "alpha", "beta", "gamma", "delta", &
        "epsilon", "zeta", "eta", "theta", "iota", "kappa", "lambda", "mu", "nu", "xi", "pi", &
        "rho", "sigma", "tau", "upsilon", "phi", "chi", "psi", "omega", "Gamma", "Delta", &
        "Theta", "Lambda", "Xi", "Pi", "Sigma", "Upsilon", "Phi", "Psi", "Omega"]
    character(*), parameter :: functions(*) = [character(6) :: "sin", "cos", "tan", "sinh", &
        "cosh", "tanh", "exp", "ln", "log", "arctan", "arccos", "arcsin"]
    character(*), parameter :: upright(*) = [character(12) :: "text", "mathrm", "textrm", &
                                             "mathit", "operatorname", "mbox", "mathsf", &
                                             "mathcal", "mathscr", "textit"]
    character(*), parameter :: nothing(*) = [character(12) :: ",", ";", ":", "!", " ", "\", &
        "(", ")", "[", "]", &
        "quad", "qquad", "left", "right", "big", "Big", "bigg", "Bigg", "bigl", "bigr", &
        "Bigl", "Bigr", &
        "displaystyle", "textstyle", "limits", "nonumber", "notag", "rm", "thinspace"]
    integer, parameter :: deepest = 100  !! groups within each other
    integer, parameter :: longest_product = 3  !! letters side by side that are factors

    type :: source_t
        !! What is read, and what has been written.
        character(:), allocatable :: text
        integer, allocatable :: columns(:)
        character(:), allocatable :: plain
        integer, allocatable :: plain_columns(:)
        integer :: depth = 0
    end type source_t

    interface
        pure recursive module subroutine take_dots(source, name, at, last, behind, error)
            !! `\dot{\theta}_1` is theta_1_dot.
            implicit none (type, external)
            type(source_t), intent(inout) :: source
            character(*), intent(in) :: name
            integer, intent(in) :: at, last
            integer, intent(inout) :: behind
            type(error_t), allocatable, intent(out) :: error
        end subroutine take_dots

        pure recursive module subroutine take_group(source, at, last, behind, error)
            !! Braces that stand alone: brackets where they hold more than a name.
            implicit none (type, external)
            type(source_t), intent(inout) :: source
            integer, intent(in) :: at, last
            integer, intent(out) :: behind
            type(error_t), allocatable, intent(out) :: error
        end subroutine take_group

        pure recursive module subroutine take_fraction(source, at, last, behind, error)
            !! `\frac{a}{b}`, and `\frac{\partial L}{\partial x}`, which is a derivative.
            implicit none (type, external)
            type(source_t), intent(inout) :: source
            integer, intent(in) :: at, last
            integer, intent(inout) :: behind
            type(error_t), allocatable, intent(out) :: error
        end subroutine take_fraction

        pure recursive module subroutine take_function(source, name, at, last, behind, error)
            !! `\sin\theta`, `\cos 2\theta`, `\sin^2\theta_1`, `\cos\omega t`.
            implicit none (type, external)
            type(source_t), intent(inout) :: source
            character(*), intent(in) :: name
            integer, intent(in) :: at, last
            integer, intent(inout) :: behind
            type(error_t), allocatable, intent(out) :: error
        end subroutine take_function
    end interface

contains

    pure subroutine plain_latex(text, columns, error)
        !! Write what `text` means, if there is a `\` in it.
        character(:), allocatable, intent(inout) :: text     !! ASCII
        integer, allocatable, intent(inout) :: columns(:)    !! of what was typed, (len(text))
        type(error_t), allocatable, intent(out) :: error     !! a command that is not known
        type(source_t) :: source

        if (scan(text, "\") == 0) return
        source%text = text
        source%columns = columns
        source%plain = ""
        allocate (source%plain_columns(0))
        call translate(source, 1, len(text), .false., error)
        if (allocated(error)) return
        text = source%plain
        columns = source%plain_columns
    end subroutine plain_latex

    pure recursive subroutine translate(source, first, last, differential, error)
        !! The letters from `first` to `last`.
        type(source_t), intent(inout) :: source
        integer, intent(in) :: first, last
        logical, intent(in) :: differential   !! one side of `\frac{dx}{dt}`
        type(error_t), allocatable, intent(out) :: error
        integer :: at, behind

        source%depth = source%depth + 1
        if (source%depth > deepest) then
            call fail(error, "column "//to_text(source%columns(first))//": more than "// &
                      to_text(deepest)//" groups within each other; give parts of it names")
            return
        end if
        at = first
        do while (at <= last)
            select case (source%text(at:at))
            case ("\")
                call take_command(source, at, last, behind, error)
            case ("{")
                call take_group(source, at, last, behind, error)
            case ("}")
                call fail(error, "column "//to_text(source%columns(at))// &
                          ": '}' closes no group; delete it")
            case ("^")
                call take_exponent(source, at, last, behind, error)
            case ("a":"z", "A":"Z")
                call take_letters(source, at, last, differential, behind)
            case ("[")
                call put(source, "(", at)
                behind = at + 1
            case ("]")
                call put(source, ")", at)
                behind = at + 1
            case ("&", "$", "~")
                call put(source, " ", at)
                behind = at + 1
            case default
                call put(source, source%text(at:at), at)
                behind = at + 1
            end select
            if (allocated(error)) return
            at = behind
        end do
        source%depth = source%depth - 1
    end subroutine translate

    pure subroutine put(source, plain, at)
        !! Letters that stand for those at `at`.
        type(source_t), intent(inout) :: source  !! what is read and written
        character(*), intent(in) :: plain     !! ASCII
        integer, intent(in) :: at             !! their first place

        source%plain = source%plain//plain
        source%plain_columns = [source%plain_columns, spread(source%columns(at), 1, len(plain))]
    end subroutine put

    pure subroutine put_name(source, name, at)
        !! A name, which begins where another one or a number does not end.
        type(source_t), intent(inout) :: source  !! what is read and written
        character(*), intent(in) :: name      !! without its index
        integer, intent(in) :: at             !! their first place

        if (len(source%plain) > 0) then
            if (scan(source%plain(len(source%plain):), inside//")") == 1) call put(source, " ", at)
        end if
        call put(source, name, at)
    end subroutine put_name

    pure recursive subroutine take_command(source, at, last, behind, error)
        !! What begins with `\`.
        type(source_t), intent(inout) :: source
        integer, intent(in) :: at, last
        integer, intent(out) :: behind
        type(error_t), allocatable, intent(out) :: error
        character(:), allocatable :: name
        integer :: group

        behind = at + verify(source%text(at + 1:last)//" ", letters)
        if (behind == at + 1) behind = min(at + 2, last + 1)
        name = source%text(at + 1:behind - 1)
        if (index(name, "var") == 1) then  ! varphi
            if (any(greek == name(4:))) name = name(4:)
        end if
        if (name == "ell") name = "l"
        if (any(greek == name) .or. name == "l") then
            call put_name(source, name, at)
            call take_index(source, last, behind)
        else if (any(functions == name)) then
            call take_function(source, name, at, last, behind, error)
        else if (any(upright == name)) then
            call take_upright(source, at, last, behind, error)
        else if (any(nothing == name)) then
            if (any(name == ["left ", "right"]) .and. &
                source%text(behind:min(behind, last)) == ".") behind = behind + 1
            call put(source, " ", at)
        else
            select case (name)
            case ("frac", "dfrac", "tfrac")
                call take_fraction(source, at, last, behind, error)
            case ("dot", "ddot")
                call take_dots(source, name, at, last, behind, error)
            case ("sqrt")
                if (source%text(behind:min(behind, last)) == "[") then
                    call fail(error, "column "//to_text(source%columns(at))// &
                              ": '\sqrt[n]' is not read; write (x)^(1/3)")
                    return
                end if
                call put_name(source, "sqrt(", at)
                call take_argument(source, last, behind, .false., error)
                call put(source, ")", at)
            case ("partial")
                call put_name(source, "d", at)
            case ("cdot", "times", "ast")
                call put(source, "*", at)
            case ("{"); call put(source, "(", at)
            case ("}"); call put(source, ")", at)
            case ("vert", "lvert", "rvert", "mid"); call put(source, "|", at)
            case ("prime"); call put(source, "'", at)
            case ("label", "tag")
                group = behind
                call find_group(source, group, last, behind)
            case ("vec", "hat", "mathbf", "boldsymbol", "bm")
                call refuse(source, at, name, "is a vector; write its components, "// &
                            "x_dot and y_dot", error)
            case ("pm", "mp")
                call refuse(source, at, name, "has two meanings; write a statement "// &
                            "with + and one with -", error)
            case ("implies", "Rightarrow", "rightarrow", "to", "Leftrightarrow", "iff")
                call refuse(source, at, name, "is an arrow; write each equality "// &
                            "on a line of its own", error)
            case default
                call refuse(source, at, name, "is not read; write it in plain "// &
                            "letters, as theta_ddot or sqrt(g/l)", error)
            end select
        end if
    end subroutine take_command

    pure subroutine refuse(source, at, name, what, error)
        !! A command that has no meaning here.
        type(source_t), intent(in) :: source
        integer, intent(in) :: at
        character(*), intent(in) :: name, what
        type(error_t), allocatable, intent(out) :: error

        call fail(error, "column "//to_text(source%columns(at))//": "//quoted("\"//name)//" "// &
                  what)
    end subroutine refuse

    pure subroutine find_group(source, at, last, behind)
        !! The place behind `{...}`, of one letter, or of a command.
        type(source_t), intent(in) :: source  !! what is read
        integer, intent(in) :: at, last       !! first and last place
        integer, intent(out) :: behind        !! the next place
        integer :: depth

        behind = at
        do while (behind <= last)
            if (source%text(behind:behind) /= " ") exit
            behind = behind + 1
        end do
        if (behind > last) return
        if (source%text(behind:behind) == "\") then
            behind = behind + max(2, verify(source%text(behind + 1:last)//" ", letters))
        else if (source%text(behind:behind) /= "{") then
            behind = behind + 1
        else
            depth = 0
            do while (behind <= last)
                if (source%text(behind:behind) == "{") depth = depth + 1
                if (source%text(behind:behind) == "}") depth = depth - 1
                behind = behind + 1
                if (depth == 0) exit
            end do
        end if
        behind = min(behind, last + 1)
    end subroutine find_group

    pure recursive subroutine take_argument(source, last, behind, differential, error)
        !! What stands in the next group, without its braces.
        type(source_t), intent(inout) :: source  !! what is read and written
        integer, intent(in) :: last           !! place that may be read
        integer, intent(inout) :: behind      !! where it begins; then behind it
        logical, intent(in) :: differential   !! of a derivative
        type(error_t), allocatable, intent(out) :: error  !! column and remedy
        integer :: first, next

        first = behind
        call find_group(source, first, last, next)
        first = first + verify(source%text(first:last)//"x", " ") - 1
        if (first > last) then
            call fail(error, "column "//to_text(source%columns(last))//": what the command is "// &
                      "about is missing; write it in braces")
        else if (source%text(first:first) == "\") then
            call take_command(source, first, last, next, error)
        else if (source%text(first:first) /= "{") then
            call translate(source, first, next - 1, differential, error)
        else if (source%text(next - 1:next - 1) /= "}" .or. next - 1 == first) then
            call fail(error, "column "//to_text(source%columns(first))// &
                      ": the group is not closed; write '}'")
        else
            call translate(source, first + 1, next - 2, differential, error)
        end if
        behind = next
    end subroutine take_argument

    pure recursive subroutine take_exponent(source, at, last, behind, error)
        !! `^2` is one digit or a group.
        type(source_t), intent(inout) :: source  !! what is read and written
        integer, intent(in) :: at, last       !! first and last place
        integer, intent(out) :: behind        !! the next place
        type(error_t), allocatable, intent(out) :: error  !! column and remedy
        character(:), allocatable :: raised
        integer :: begun

        behind = at + 1
        if (scan(source%text(behind:min(behind, last)), "(-") == 1) then
            call put(source, "^", at)
            return
        end if
        call put(source, "^(", at)
        begun = len(source%plain)
        call take_argument(source, last, behind, .false., error)
        if (allocated(error)) return
        raised = trim(adjustl(source%plain(begun + 1:)))
        if (raised == "'" .or. raised == "''") then
            source%plain(begun - 1:begun) = "  "
            source%plain = trim(source%plain(:begun - 2))//raised
            source%plain_columns = [source%plain_columns(:len(source%plain) - len(raised)), &
                                    spread(source%columns(at), 1, len(raised))]
        else if (verify(raised, digits) == 0) then
            source%plain = source%plain(:begun - 1)//raised//" "
            source%plain_columns = [source%plain_columns(:begun - 1), &
                                    spread(source%columns(at), 1, len(raised) + 1)]
        else
            call put(source, ")", at)
        end if
    end subroutine take_exponent

    pure subroutine take_index(source, last, behind)
        !! `_1`, `_{12}` or `_\theta` behind a name; nothing where there is none.
        type(source_t), intent(inout) :: source  !! what is read and written
        integer, intent(in) :: last           !! place that may be read
        integer, intent(inout) :: behind      !! the next place
        character(:), allocatable :: text, shown
        integer :: first, i

        if (behind > last) return
        if (source%text(behind:behind) /= "_") return
        first = behind + 1
        if (scan(source%text(first:min(first, last)), letters//digits) == 1) then
            i = verify(source%text(first:last)//" ", digits)
            if (i == 1) i = verify(source%text(first:last)//" ", inside)
            text = source%text(first:first + i - 2)
            behind = first + i - 1
            if (verify(text, digits) == 0) then
                i = verify(source%text(behind:last)//" ", inside)
                if (any(source%text(behind:behind + i - 2) == [character(5) :: "_dot", "_ddot"])) &
                    then
                    text = text//source%text(behind:behind + i - 2)
                    behind = behind + i - 1
                end if
            end if
        else
            call find_group(source, first, last, behind)
            text = source%text(first:behind - 1)
        end if
        shown = ""
        i = 1
        do while (i <= len(text))
            if (text(i:i) == "\") then  ! of \mathrm{eff} the group, of \theta the name
                first = i + verify(text(i + 1:)//" ", letters)
                if (.not. any(upright == text(i + 1:first - 1))) shown = shown// &
                                                                          text(i + 1:first - 1)
                i = first
                cycle
            end if
            if (scan(text(i:i), inside) == 1) shown = shown//text(i:i)
            i = i + 1
        end do
        if (shown /= "") call put(source, "_"//shown, behind - 1)
    end subroutine take_index

    pure subroutine take_letters(source, at, last, differential, behind)
        !! `mgl` is m g l; `theta`, `sin` and `dx` of a derivative are what they are.
        type(source_t), intent(inout) :: source
        integer, intent(in) :: at, last
        logical, intent(in) :: differential
        integer, intent(out) :: behind
        character(:), allocatable :: word
        integer :: i

        behind = at + verify(source%text(at:last)//" ", letters) - 1
        word = source%text(at:behind - 1)
        if (any(greek == word) .or. any(functions == word) .or. &
            len(word) > longest_product .or. (word(1:1) == "d" .and. (differential .or. &
            source%text(behind:min(behind, last)) == "/"))) then
            call put_name(source, word, at)
        else
            do i = 1, len(word)
                call put_name(source, word(i:i), at + i - 1)
            end do
        end if
        i = verify(source%text(behind:last)//" ", digits) - 1
        if (i > 0) call put(source, source%text(behind:behind + i - 1), behind)
        behind = behind + i
        call take_index(source, last, behind)
    end subroutine take_letters

    pure recursive subroutine take_upright(source, at, last, behind, error)
        !! `\text{const}`, `\mathrm{d}`: one word; `\operatorname{ln}` is a function.
        type(source_t), intent(inout) :: source
        integer, intent(in) :: at, last
        integer, intent(inout) :: behind
        type(error_t), allocatable, intent(out) :: error
        integer :: first, i

        first = behind
        call find_group(source, first, last, behind)
        do i = 1, size(functions)
            if (adjustl(source%text(first:behind - 1)) /= "{"//trim(functions(i))//"}") cycle
            call take_function(source, trim(functions(i)), at, last, behind, error)
            return
        end do
        call put_name(source, "", at)
        do i = first, behind - 1
            if (scan(source%text(i:i), inside//". ") == 1) call put(source, source%text(i:i), i)
        end do
        call take_index(source, last, behind)
    end subroutine take_upright
end module lagrangia_latex_source
