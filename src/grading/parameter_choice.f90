module lagrangia_parameter_choice
    !! With which parameters a sheet is graded.
    use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
    use lagrangia_description, only: default_values, description_t
    use lagrangia_kinds, only: dp
    use lagrangia_number_class, only: is_nonzero, is_zero
    use lagrangia_random_draws, only: random_t
    use lagrangia_text, only: word_t
    implicit none (type, external)
    private
    public :: find_parameter, keep, leave_out, occurs, spread_values

contains

    subroutine keep(d, said, settings, fixed, given, kept)
        !! The parameters that keep their values, and these; NaN: the system's formula. In words
        !! those that are zero.
        type(description_t), intent(in) :: d              !! of the system
        character(*), intent(in) :: said                  !! all statements
        type(word_t), intent(in) :: settings(:)           !! `name=value`: these keep their values
        logical, allocatable, intent(out) :: fixed(:)     !! of each value: it is kept
        real(dp), allocatable, intent(out) :: given(:)    !! the values; NaN: the system's formula
        character(:), allocatable, intent(out) :: kept    !! `a_s = 0, ...`
        character(:), allocatable :: whole
        integer :: is_set(size(settings))
        integer :: element, first, from, i, k, last
        logical :: named

        whole = said
        if (allocated(d%letters)) then
            do i = size(d%letters), 1, -1  ! each uses only those before it
                if (.not. occurs(whole, trim(d%letters(i)%name))) cycle
                whole = whole//" "//trim(d%letters(i)%formula)
            end do
        end if
        kept = ""
        allocate (given, source=default_values(d))
        allocate (fixed(size(given)), source=.false.)
        first = 0
        if (size(d%coordinates) == 1 .and. speaks_of_decay(whole)) then
            ! where they have no meaning of their own, the sheet speaks of drag
            if (.not. any([(any(["gamma", "beta "] == d%parameters(i)%name), &
                            i=1, size(d%parameters))]) .and. index(whole, "gamma =") == 0 .and. &
                index(whole, "beta =") == 0) whole = whole//" b"
        end if
        do i = 1, size(d%parameters)
            associate (p => d%parameters(i))
                named = is_named(p%name)
                if (p%count > 1) named = any([(is_named(trim(p%name)//"_"//"xyz"(k:k)), k=1, 3)])
                do k = 1, p%count
                    if (named) cycle
                    fixed(first + k) = is_zero(p%value(k)) .or. p%computed /= "" .or. p%whole
                    if (p%computed /= "") given(first + k) = ieee_value(given(1), ieee_quiet_nan)
                end do
                if (p%whole) fixed(first + 1) = .true.
                do k = 1, size(settings)
                    call find_parameter(d, settings(k)%text(:index(settings(k)%text, "=") - 1), &
                                        is_set(k), element)
                    if (is_set(k) /= i .or. element > p%count) cycle
                    from = max(1, element)
                    last = merge(element, p%count, element > 0)
                    fixed(first + from:first + last) = .true.
                    given(first + from:first + last) = p%value(from:last)
                end do
                if (.not. (named .or. any(is_set == i)) .and. p%computed == "" .and. &
                    p%count == 1 .and. is_zero(p%value(1))) then
                    if (kept /= "") kept = kept//", "
                    kept = kept//trim(p%name)//" = 0"
                end if
                first = first + p%count
            end associate
        end do
    contains
        logical function is_named(name)
            character(*), intent(in) :: name

            is_named = occurs(whole, trim(name))
        end function is_named
    end subroutine keep

    pure subroutine find_parameter(d, name, parameter, element)
        !! Which one a line `set:` is about: `m`, `magnetic`, and of the latter one element,
        !! `magnetic(2)` or `magnetic_y`.
        type(description_t), intent(in) :: d       !! of the system
        character(*), intent(in) :: name           !! as typed
        integer, intent(out) :: parameter          !! its place; 0: there is none
        integer, intent(out) :: element            !! 0: all
        character(:), allocatable :: stem
        integer :: opened, status

        element = 0
        stem = trim(name)
        opened = index(stem, "(")
        if (opened > 1) then
            if (verify(stem(opened + 1:), " 0123456789)") > 0) opened = 0
        end if
        if (opened > 1) then
            read (stem(opened + 1:len(stem) - 1), *, iostat=status) element
            if (status /= 0) element = 0
            stem = trim(stem(:opened - 1))
        end if
        do parameter = 1, size(d%parameters)
            associate (p => d%parameters(parameter))
                if (p%name == stem) return
                if (p%count == 1 .or. opened > 0) cycle
                if (stem(:len(stem) - 1) /= trim(p%name)//"_") cycle
                element = index("xyz", stem(len(stem):))
                if (element > 0 .and. element <= p%count) return
                element = 0
            end associate
        end do
        parameter = 0
    end subroutine find_parameter

    pure function speaks_of_decay(text) result(yes)
        !! Has it gamma or beta, and not as a phase, cos(omega t + beta)?
        character(*), intent(in) :: text  !! formulas
        logical :: yes
        character(:), allocatable :: rest
        integer :: at, opened

        rest = text
        do
            at = max(index(rest, "+ beta)"), index(rest, "- beta)"), index(rest, "+beta)"), &
                     index(rest, "-beta)"), index(rest, "+ gamma)"), index(rest, "- gamma)"), &
                     index(rest, "+gamma)"), index(rest, "-gamma)"))
            if (at == 0) exit
            opened = index(rest(:at), "(", back=.true.)
            if (opened == 0) exit
            if (.not. occurs(rest(opened:at - 1), "t")) exit
            rest = rest(:at - 1)//rest(at + index(rest(at:), ")") - 1:)
        end do
        yes = occurs(rest, "gamma") .or. occurs(rest, "beta")
    end function speaks_of_decay

    subroutine spread_values(d, drawn_value, fixed, given, random, shrink)
        !! A parameter without bounds that is not zero keeps its sign: from a half to twice its
        !! value.
        type(description_t), intent(in) :: d                 !! of the system
        logical, allocatable, intent(out) :: drawn_value(:)  !! it is drawn here
        logical, intent(in) :: fixed(:)                      !! it keeps its value
        real(dp), intent(inout) :: given(:)                  !! gets what is drawn
        type(random_t), intent(inout) :: random              !! moves on
        real(dp), intent(in), optional :: shrink             !! by which they are multiplied as well
        real(dp) :: factor
        integer :: first, i, k

        allocate (drawn_value(size(given)), source=.false.)
        first = 0
        do i = 1, size(d%parameters)
            associate (p => d%parameters(i))
                do k = first + 1, first + p%count
                    if (fixed(k) .or. p%lower > -huge(p%lower)) cycle
                    drawn_value(k) = is_nonzero(p%value(k - first))
                    call random%uniform(0.5_dp, 2.0_dp, factor)
                    if (present(shrink)) factor = shrink*factor
                    if (drawn_value(k)) given(k) = factor*p%value(k - first)
                end do
                first = first + p%count
            end associate
        end do
    end subroutine spread_values

    pure function occurs(text, name) result(yes)
        !! `name` as a word of its own.
        character(*), intent(in) :: text  !! formulas
        character(*), intent(in) :: name  !! as it stands there
        character(*), &
            parameter :: inside = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"// &
                                            "_0123456789"
        logical :: yes
        character(len(text) + 2) :: framed
        integer :: at, i

        framed = " "//text
        i = 1
        yes = .false.
        do
            at = index(framed(i:), name)
            if (at == 0) return
            at = at + i - 1
            yes = scan(framed(at - 1:at - 1), inside) == 0 .and. &
                  scan(framed(at + len(name):at + len(name)), inside) == 0
            if (yes) return
            i = at + 1
        end do
    end function occurs

    pure subroutine leave_out(name, text)
        !! Blanks for a name in formulas.
        character(*), intent(in) :: name                   !! a word of its own
        character(:), allocatable, intent(inout) :: text   !! loses it
        integer :: at, first

        if (.not. occurs(text, name)) return
        first = 1
        do
            at = index(text(first:), name)
            if (at == 0) return
            at = first + at - 1
            first = at + len(name)
            if (.not. occurs(text(max(1, at - 1):min(len(text), first)), name)) cycle
            text(at:first - 1) = ""
        end do
    end subroutine leave_out
end module lagrangia_parameter_choice
