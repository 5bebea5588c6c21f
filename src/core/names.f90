module lagrangia_names
    !! What somebody may have meant who typed a name that does not exist.
    use lagrangia_errors, only: error_t, fail
    use lagrangia_text, only: join, listed, lower, quoted
    implicit none (type, external)
    private
    public :: abbreviation, advice, nearest_name, refuse_name, name_length

    integer, parameter :: name_length = 32  !! of a name that a user may type

contains

    pure function nearest_name(name, candidates) result(best)
        !! The candidate most like `name`, whatever the case; empty when none is near.
        !!
        !! Near means: at most one slip for names up to three letters (and their first is there),
        !! two up to six, else three, and something of the name must be left; or two thirds of
        !! one name begin a word of the other (`cart`, `pendel`, `simple_pendulum`).
        character(*), intent(in) :: name, candidates(:)  !! what was typed, and what there is
        character(:), allocatable :: best
        integer, parameter :: longest = 63, short = 3
        integer :: distance, i, length, least, shared

        best = ""
        length = len_trim(name)
        if (length == 0 .or. length > longest) return
        least = min(3, 1 + (length - 1)/3) + 1
        do i = 1, size(candidates)
            if (abs(len_trim(candidates(i)) - length) >= least) cycle
            distance = edits(lower(trim(name)), lower(trim(candidates(i))))
            if (length <= short .and. index(lower(candidates(i)), lower(name(1:1))) == 0) cycle
            if (distance < least .and. distance < max(length, len_trim(candidates(i)))) then
                least = distance
                best = trim(candidates(i))
            end if
        end do
        if (best /= "") return
        least = longest
        do i = 1, size(candidates)
            shared = common(lower(trim(name)), lower(trim(candidates(i))))
            if (3*shared < 2*min(length, len_trim(candidates(i))) .or. shared < short) cycle
            if (len_trim(candidates(i)) - 2*shared >= least) cycle
            least = len_trim(candidates(i)) - 2*shared
            best = trim(candidates(i))
        end do
    end function nearest_name

    pure function abbreviation(name, candidates) result(best)
        !! The candidate that abbreviates `name`, as `g` for `gravity`, `m1` for `mass1`: its first
        !! letter, alone or with one of the others; empty when there is none.
        character(*), intent(in) :: name, candidates(:)  !! what was typed, and what there is
        character(:), allocatable :: best
        integer :: i

        best = ""
        do i = 1, size(candidates)
            if (.not. abbreviates(lower(trim(candidates(i))), lower(trim(name)))) cycle
            if (len_trim(candidates(i)) > len(best)) best = trim(candidates(i))
        end do
    end function abbreviation

    pure function advice(name, candidates, shown_by) result(text)
        !! What to write instead of `name`: the nearest of the candidates, or which there are.
        character(*), intent(in) :: name, candidates(:)  !! what was typed, and what there is
        character(*), intent(in), optional :: shown_by   !! a command that shows all, if many
        character(:), allocatable :: text

        text = nearest_name(name, candidates)
        if (text /= "") then
            text = "did you mean '"//text//"'?"
        else
            text = join(candidates, ", ")
            if (present(shown_by)) text = listed(candidates, 130, shown_by)
            text = "there are "//text
        end if
    end function advice

    pure function common(a, b) result(longest)
        !! The length of the longest text with which a word of each of them begins.
        character(*), intent(in) :: a, b
        integer :: longest
        character(*), parameter :: between = " _-./%"
        integer :: i, k

        longest = 0
        do i = 1, len(a)
            if (scan(a(max(1, i - 1):max(1, i - 1)), between) == 0 .and. i > 1) cycle
            do while (i + longest <= len(a))
                k = index(between(1:1)//b, a(i:i + longest))
                if (k == 0) exit
                if (scan(b(max(1, k - 2):max(1, k - 2)), between) == 0 .and. k > 2) exit
                longest = longest + 1
            end do
        end do
    end function common

    pure function abbreviates(short, name) result(yes)
        !! Is `short` the first letter of `name`, alone or with one of the others?
        character(*), intent(in) :: short, name
        logical :: yes

        yes = .false.
        if (len(short) < 1 .or. len(short) > 2 .or. name == "") return
        yes = short(1:1) == name(1:1)
        if (yes .and. len(short) == 2) yes = index(name(2:), short(2:)) > 0
    end function abbreviates

    pure function edits(a, b) result(distance)
        !! Insertions, deletions, substitutions and swaps of neighbours between `a` and `b`:
        !! the Damerau-Levenshtein distance without edits inside a swapped pair.
        character(*), intent(in) :: a, b
        integer :: distance
        integer :: d(0:len(a), 0:len(b)), i, j

        d(:, 0) = [(i, i=0, len(a))]
        d(0, :) = [(j, j=0, len(b))]
        do j = 1, len(b)
            do i = 1, len(a)
                d(i, j) = min(d(i - 1, j) + 1, d(i, j - 1) + 1, &
                              d(i - 1, j - 1) + merge(0, 1, a(i:i) == b(j:j)))
                if (min(i, j) < 2) cycle
                if (a(i:i) == b(j - 1:j - 1) .and. a(i - 1:i - 1) == b(j:j)) then
                    d(i, j) = min(d(i, j), d(max(i - 2, 0), max(j - 2, 0)) + 1)
                end if
            end do
        end do
        distance = d(len(a), len(b))
    end function edits

    pure subroutine refuse_name(kind, name, names, error, meanings)
        !! There is no such name: say which one is near, whose meaning has that word, or which ones
        !! there are.
        character(*), intent(in) :: kind                  !! what is named: `system`, `method`
        character(*), intent(in) :: name                  !! what was typed
        character(*), intent(in) :: names(:)              !! those that there are
        type(error_t), allocatable, intent(out) :: error  !! allocated, with advice
        character(*), intent(in), optional :: meanings(:) !! of each of them
        integer :: i

        i = 0
        if (present(meanings)) i = meant(name, names, meanings)
        if (i > 0) then
            call fail(error, "unknown "//kind//" "//quoted(name)//"; did you mean '"// &
                      trim(names(i))//"' ("//trim(meanings(i))//")?")
        else
            call fail(error, "unknown "//kind//" "//quoted(name)//"; "//advice(name, names))
        end if
    end subroutine refuse_name

    pure function meant(name, names, meanings) result(which)
        !! The first of the names whose meaning has `name` as a word, in letters alone: `action` for
        !! `hamilton`, `rk4` for `runge-kutta`; 0 where none has, or a name has these letters.
        character(*), intent(in) :: name, names(:), meanings(:)
        integer :: which
        integer, parameter :: shortest = 4
        character(:), allocatable :: word
        integer :: i

        which = 0
        word = letters(name, "")
        if (len(word) < shortest) return
        do i = 1, size(names)
            if (letters(names(i), "") == word) return
        end do
        do which = 1, size(names)
            if (index(" "//letters(meanings(which), " ")//" ", " "//word//" ") > 0) return
        end do
        which = 0
    end function meant

    pure function letters(text, others) result(only)
        !! Those of a text alone, small, and what is in `others`: `dalembert` of `d'Alembert`.
        character(*), intent(in) :: text, others
        character(:), allocatable :: only
        integer :: i

        only = ""
        do i = 1, len_trim(text)
            if (index("abcdefghijklmnopqrstuvwxyz"//others, lower(text(i:i))) > 0) then
                only = only//lower(text(i:i))
            end if
        end do
    end function letters
end module lagrangia_names
