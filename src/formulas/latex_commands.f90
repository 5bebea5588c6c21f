submodule (lagrangia_latex_source) lagrangia_latex_commands
    !! Dots, fractions and functions.
    implicit none (type, external)

contains

    pure recursive module subroutine take_dots(source, name, at, last, behind, error)
        !! `\dot{\theta}_1` is theta_1_dot.
        type(source_t), intent(inout) :: source
        character(*), intent(in) :: name      !! `dot` or `ddot`
        integer, intent(in) :: at, last
        integer, intent(inout) :: behind
        type(error_t), allocatable, intent(out) :: error
        integer :: begun

        call put_name(source, "", at)
        begun = len(source%plain)
        call take_argument(source, last, behind, .false., error)
        if (allocated(error)) return
        if (verify(trim(adjustl(source%plain(begun + 1:))), inside) == 0) then
            source%plain = trim(source%plain)
            source%plain_columns = source%plain_columns(:len(source%plain))
            call take_index(source, last, behind)
            call put(source, "_"//name, at)
        else
            call fail(error, "column "//to_text(source%columns(at))//": dots stand on one "// &
                      "letter; write d/dt(...) for what is in braces")
        end if
    end subroutine take_dots

    pure recursive module subroutine take_group(source, at, last, behind, error)
        !! Braces that stand alone: brackets where they hold more than a name. `{\dot\theta}_1` is
        !! theta_1_dot.
        type(source_t), intent(inout) :: source
        integer, intent(in) :: at, last
        integer, intent(out) :: behind
        type(error_t), allocatable, intent(out) :: error
        integer :: begun

        behind = at
        call put(source, "(", at)
        begun = len(source%plain)
        call take_argument(source, last, behind, .false., error)
        if (allocated(error)) return
        if (verify(trim(adjustl(source%plain(begun + 1:))), inside) > 0) then
            call put(source, ")", at)
            return
        end if
        source%plain(begun:begun) = " "
        call take_index_of_group(source, begun, last, behind)
    end subroutine take_group

    pure subroutine take_index_of_group(source, begun, last, behind)
        !! The `_1` of `{\theta}_1` and `{\dot\theta}_1`, before the dots; nothing where there is
        !! none, or no name.
        type(source_t), intent(inout) :: source
        integer, intent(in) :: begun       !! before the name
        integer, intent(in) :: last
        integer, intent(inout) :: behind
        character(:), allocatable :: name
        integer :: dots

        if (source%text(behind:min(behind, last)) /= "_") return
        name = trim(source%plain(begun + 1:))
        if (verify(adjustl(name), inside) > 0) return
        dots = max(index(name, "_dot"), index(name, "_ddot"))
        if (dots == 0) dots = len(name) + 1
        source%plain = source%plain(:begun + dots - 1)
        source%plain_columns = source%plain_columns(:begun + dots - 1)
        call take_index(source, last, behind)
        call put(source, name(dots:), behind - 1)
    end subroutine take_index_of_group

    pure recursive module subroutine take_fraction(source, at, last, behind, error)
        !! `\frac{a}{b}`, and `\frac{\partial L}{\partial x}`, which is a derivative.
        type(source_t), intent(inout) :: source
        integer, intent(in) :: at, last
        integer, intent(inout) :: behind
        type(error_t), allocatable, intent(out) :: error
        character(:), allocatable :: below
        integer :: middle, begun
        logical :: differential

        call find_group(source, behind, last, middle)
        differential = begins_with_d(source%text(behind:middle - 1)) .and. &
                       begins_with_d(source%text(middle:last))
        call put_name(source, "", at)
        if (.not. differential) call put(source, "((", at)
        begun = len(source%plain)
        call take_argument(source, last, behind, differential, error)
        if (allocated(error)) return
        if (differential) call put_brackets(source, begun)
        if (.not. differential) call put(source, ")", at)
        call put(source, "/(", at)
        begun = len(source%plain)
        call take_argument(source, last, behind, differential, error)
        if (allocated(error)) return
        below = trim(adjustl(source%plain(begun + 1:)))
        if (.not. differential) then
            call put(source, "))", at)
        else if (below == "") then
            return
        else
            call put(source, ") ", at)
        end if
    end subroutine take_fraction

    pure subroutine put_brackets(source, begun)
        !! `d cos(theta)` and `d m l^2 theta_dot` as d(cos(theta)); a name stays alone.
        type(source_t), intent(inout) :: source
        integer, intent(in) :: begun   !! before the differential
        character(:), allocatable :: what
        integer :: first, n

        first = begun + scan(source%plain(begun + 1:), "d") + 1
        if (first > len(source%plain)) return
        if (source%plain(first:first) == "^") first = first + 2
        what = trim(adjustl(source%plain(first:)))
        n = verify(what//" ", inside) - 1
        if (n == len(what) .or. index(what, "(") == 1) return
        if (what(n + 1:n + 1) == "(" .and. .not. any(functions == what(:n))) return  ! L(x, t)
        n = len(source%plain)
        source%plain = source%plain(:first - 1)//"("//source%plain(first:)//")"
        source%plain_columns = [source%plain_columns(:first - 1), source%plain_columns(first), &
                                source%plain_columns(first:), source%plain_columns(n)]
    end subroutine put_brackets

    pure function begins_with_d(text) result(yes)
        !! A differential: `{d}`, `{dx}`, `{\partial x}`, `{\mathrm{d} x}`, `{d^2 x}`.
        character(*), intent(in) :: text
        logical :: yes
        character(:), allocatable :: rest
        integer :: behind

        rest = text(verify(text//"x", " {"):)
        behind = verify(rest//" ", letters)
        yes = index(rest, "\partial") == 1 .or. index(rest, "\mathrm{d}") == 1 .or. &
              index(rest, "\text{d}") == 1 .or. index(rest, "\rm d") == 1 .or. &
              index(rest, "\mathrm d") == 1
        if (index(rest, "d") /= 1) return
        ! d alone, dx, dtheta, and not d l of a distance
        yes = .true.
    end function begins_with_d

    pure recursive module subroutine take_function(source, name, at, last, behind, error)
        !! `\sin\theta`, `\cos 2\theta`, `\sin^2\theta_1`, `\cos\omega t`.
        type(source_t), intent(inout) :: source
        character(*), intent(in) :: name
        integer, intent(in) :: at, last
        integer, intent(inout) :: behind
        type(error_t), allocatable, intent(out) :: error
        character(:), allocatable :: called, rest
        integer :: begun, next

        called = name
        if (name == "ln") called = "log"
        if (name == "arctan") called = "atan"
        call put_name(source, called, at)
        call skip_blanks(source%text(:last), behind)
        if (source%text(behind:min(behind, last)) == "^") then
            next = behind
            call take_exponent(source, next, last, behind, error)
            if (allocated(error)) return
            call skip_blanks(source%text(:last), behind)
        end if
        rest = source%text(behind:last)
        if (rest == "") return
        if (scan(rest, "([|") == 1 .or. index(rest, "\left") == 1 .or. index(rest, "\big") == 1 &
            .or. index(rest, "\Big") == 1 .or. index(rest, "\lvert") == 1 &
            .or. index(rest, "\vert") == 1) return
        call put(source, "(", at)
        next = verify(rest//" ", digits//".") - 1
        if (next > 0) call put(source, rest(:next), behind)
        behind = behind + next
        call skip_blanks(source%text(:last), behind)
        begun = len(source%plain)
        if (scan(source%text(behind:min(behind, last)), letters) == 1) then
            next = behind
            if (any(greek == word_at(behind))) next = behind + len(word_at(behind)) - 1
            call put_name(source, source%text(behind:next), behind)
            behind = next + 1
            call take_index(source, last, behind)
        else if (behind <= last .and. scan(source%text(behind:min(behind, last)), "\{") == 1) then
            call take_argument(source, last, behind, .false., error)
            if (allocated(error)) return
            call take_index_of_group(source, begun, last, behind)
        end if
        rest = adjustl(source%plain(begun + 1:))
        call skip_blanks(source%text(:last), behind)
        if (any(rest(:min(5, len(rest))) == ["omega", "Omega"]) .and. word_at(behind) == "t") then
            call put(source, " t", behind)
            behind = behind + 1
        end if
        call put(source, ")", at)
    contains
        pure function word_at(place) result(word)
            integer, intent(in) :: place
            character(:), allocatable :: word

            word = ""
            if (place > last) return
            word = source%text(place:place + verify(source%text(place:last)//" ", letters) - 2)
        end function word_at
    end subroutine take_function

    pure subroutine skip_blanks(text, at)
        !! Also `\,` and `\!`.
        character(*), intent(in) :: text
        integer, intent(inout) :: at

        do while (at <= len(text))
            if (text(at:at) == " ") then
                at = at + 1
            else if (any(text(at:min(at + 1, len(text))) == ["\,", "\!", "\;"])) then
                at = at + 2
            else
                return
            end if
        end do
    end subroutine skip_blanks
end submodule lagrangia_latex_commands
