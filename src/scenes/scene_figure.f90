module lagrangia_scene_figure
    !! How a system is drawn: the parts that its description names, and where their places are at a
    !! state. Each part is a word and its places, with blanks between them:
    !!
    !! * `rod A B`, `rope A B ...`, `spring A B`: between places; `ball A`: a point mass;
    !! * `pivot A`: where something hangs; `trail A`: the path of A; `axis A B`: a dashed line;
    !! * `box A (width, height, tilt)`, `cart A (width, height)`: about A; `round A B`: a disk about
    !!   A with B on its rim; `polygon A B C ...`: filled, `frame A B C ...`: its edges only;
    !! * `circle A B C`, `wheel A B C`: the one about A with B and C on it, a quarter apart, and a
    !!   wheel has spokes to these; `line A B`: goes on beyond both; `ground A B`: the same, hatched
    !!   on its right; `plane A`: level through A; `field NAME (x, y, z)`: a uniform field;
    !! * `let NAME = FORMULA`: a letter for the parts behind it.
    !!
    !! A place is `origin`, a point of the description, or `(x, y)` or `(x, y, z)`, formulas in the
    !! letters of the description. Besides there are `size`, how far the motion spreads, and the
    !! bounds of each coordinate, `theta_min` and `theta_max`. Without a figure each point is a ball
    !! with its trail. A scene may have a figure of its own, in the same words.
    use lagrangia_description, only: description_t, figure_length, letter_t, value_names
    use lagrangia_errors, only: error_t, fail
    use lagrangia_hyperdual, only: hyperdual_t
    use lagrangia_kinds, only: dp
    use lagrangia_named_values, only: motion_state_t
    use lagrangia_statements, only: statements_t
    use lagrangia_system, only: system_t
    use lagrangia_text, only: join, quoted, to_text
    implicit none (type, external)
    private
    public :: figure_t, part_t
    public :: new_figure

    integer, parameter :: most_places = 8  !! of a part

    type :: part_t
        !! One part and its places, by their numbers.
        character(8) :: kind = ""
        character(16) :: label = ""  !! of a field
        integer :: count = 0
        integer :: at(most_places) = 0
    end type part_t

    type :: kind_t
        !! What a part needs.
        character(8) :: name = ""
        integer :: least = 0, most = 0  !! places
    end type kind_t

    type(kind_t), parameter :: kinds(*) = [ &
        kind_t("rod", 2, 2), kind_t("rope", 2, most_places), kind_t("spring", 2, 2), &
        kind_t("ball", 1, 1), kind_t("pivot", 1, 1), kind_t("trail", 1, 1), kind_t("axis", 2, 2), &
        kind_t("box", 2, 2), kind_t("cart", 2, 2), kind_t("round", 2, 2), &
        kind_t("polygon", 3, most_places), kind_t("frame", 3, most_places), &
        kind_t("circle", 3, 3), kind_t("wheel", 3, 3), kind_t("line", 2, 2), &
        kind_t("ground", 2, 2), kind_t("plane", 1, 1), kind_t("field", 1, 1)]

    type :: figure_t
        !! Parts, and places that they share.
        type(part_t), allocatable :: parts(:)
        integer :: places = 0
        integer, allocatable :: point(:)    !! of each place: of the description; 0: not one
        integer, allocatable :: formula(:)  !! of each place: its first of three; 0: it has none
        type(description_t), private :: d   !! with the letters of the figure
        type(statements_t), private :: statements
    contains
        procedure :: place
    end type figure_t

contains

    subroutine new_figure(system, own, size, low, high, figure, error)
        !! Read the figure of a system for a motion.
        class(system_t), intent(in) :: system  !! with its parameters
        character(*), intent(in) :: own(:)     !! a scene's parts; none: the system's
        real(dp), intent(in) :: size               !! how far the motion spreads, m
        real(dp), intent(in) :: low(:), high(:)    !! bounds of the coordinates, (ndof)
        type(figure_t), intent(out) :: figure  !! parts and places
        type(error_t), allocatable, intent(out) :: error  !! status 2: a part that cannot be read
        character(figure_length), allocatable :: lines(:), keys(:)
        integer :: i

        call system%describe(figure%d)
        if (ubound(own, 1) > 0) then
            lines = own
        else
            call choose_lines(figure%d, lines)
        end if
        call add_letters(figure%d, lines, size, low, high, error)
        if (allocated(error)) return
        allocate (keys(0))
        allocate (figure%parts(0), figure%point(0), figure%formula(0))
        call figure%statements%begin(system, figure%d, any_state(system), error)
        if (allocated(error)) error%element = 1
        do i = 1, ubound(lines, 1)
            if (allocated(error)) exit
            if (lines(i)(:4) == "let ") cycle
            call read_part(figure, trim(lines(i)), keys, error)
            if (.not. allocated(error)) cycle
            if (ubound(own, 1) == 0) call error%add_context(quoted(trim(lines(i))))
            error%element = i
        end do
        if (.not. allocated(error)) call figure%statements%finish()
    end subroutine new_figure

    pure subroutine choose_lines(d, lines)
        !! The description's; where it has none, its points.
        type(description_t), intent(in) :: d
        character(figure_length), allocatable, intent(out) :: lines(:)
        integer :: i

        if (allocated(d%figure)) then
            lines = d%figure
            return
        end if
        allocate (lines(0))
        if (.not. allocated(d%points)) return
        do i = 1, size(d%points)
            lines = [character(figure_length) :: lines, "trail "//d%points(i)%name, &
                     "ball "//d%points(i)%name]
        end do
    end subroutine choose_lines

    subroutine add_letters(d, lines, extent, low, high, error)
        !! Those that a figure may use besides, and its own. T and V are not needed.
        type(description_t), intent(inout) :: d
        character(*), intent(in) :: lines(:)
        real(dp), intent(in) :: extent, low(:), high(:)
        type(error_t), allocatable, intent(out) :: error
        integer :: i, equals

        if (allocated(d%kinetic_energy)) deallocate (d%kinetic_energy)
        if (allocated(d%potential_energy)) deallocate (d%potential_energy)
        if (.not. allocated(d%letters)) allocate (d%letters(0))
        call add("size", to_text(extent))
        do i = 1, size(low)
            call add(trim(d%coordinates(i)%name)//"_min", to_text(low(i)))
            call add(trim(d%coordinates(i)%name)//"_max", to_text(high(i)))
        end do
        do i = 1, size(lines)
            if (lines(i)(:4) /= "let ") cycle
            equals = index(lines(i), "=")
            if (equals == 0) then
                call fail(error, quoted(trim(lines(i)))//": a letter is written 'let D = R + 1'")
                error%element = i
                return
            end if
            d%letters = [d%letters, letter_t(adjustl(lines(i)(5:equals - 1)), &
                                             adjustl(lines(i)(equals + 1:)))]
        end do
    contains
        subroutine add(name, formula)
            !! Only where a part has it, and no other has the name.
            character(*), intent(in) :: name, formula
            integer :: k

            if (any(d%coordinates%name == name) .or. any(value_names(d) == name) .or. &
                any(d%letters%name == name)) return
            do k = 1, size(lines)
                if (index(lines(k), name) > 0) then
                    d%letters = [d%letters, letter_t(name, formula)]
                    return
                end if
            end do
        end subroutine add
    end subroutine add_letters

    function any_state(system) result(state)
        !! From which names are learnt.
        class(system_t), intent(in) :: system
        type(motion_state_t) :: state

        allocate (state%q(system%ndof), state%v(system%ndof), state%a(system%ndof), &
                  state%q0(system%ndof), state%v0(system%ndof), source=0.0_dp)
    end function any_state

    subroutine read_part(figure, line, keys, error)
        !! One part.
        type(figure_t), intent(inout) :: figure
        character(*), intent(in) :: line
        character(figure_length), allocatable, intent(inout) :: keys(:)  !! of the places so far
        type(error_t), allocatable, intent(out) :: error
        type(part_t) :: part
        character(:), allocatable :: rest, word
        integer :: which

        rest = line
        call take_word(rest, word)
        part%kind = word
        which = findloc(kinds%name == word, .true., 1)
        if (which == 0) then
            call fail(error, "unknown part "//quoted(word)//"; there are "// &
                      join(kinds%name, ", ")//" and let")
            return
        end if
        if (word == "field") then
            call take_word(rest, word)
            part%label = word
        end if
        do while (rest /= "" .and. part%count < most_places)
            call take_word(rest, word)
            part%count = part%count + 1
            call find_place(figure, word, keys, part%at(part%count), error)
            if (allocated(error)) return
        end do
        if (part%count < kinds(which)%least .or. part%count > kinds(which)%most .or. &
            rest /= "") then
            word = to_text(kinds(which)%least)
            if (kinds(which)%most > kinds(which)%least) word = word//" to "// &
                to_text(kinds(which)%most)
            call fail(error, trim(part%kind)//" takes "//word//" place"// &
                      trim(merge(" ", "s", word == "1")))
            return
        end if
        figure%parts = [figure%parts, part]
    end subroutine read_part

    pure subroutine take_word(rest, word)
        !! The first word, which ends at a blank outside of brackets; `rest` keeps the others.
        character(:), allocatable, intent(inout) :: rest
        character(:), allocatable, intent(out) :: word
        integer :: i, depth

        depth = 0
        do i = 1, len(rest)
            if (rest(i:i) == "(") depth = depth + 1
            if (rest(i:i) == ")") depth = depth - 1
            if (rest(i:i) == " " .and. depth <= 0) exit
        end do
        word = rest(:i - 1)
        rest = trim(adjustl(rest(min(i, len(rest) + 1):)))
    end subroutine take_word

    subroutine find_place(figure, word, keys, which, error)
        !! The number of a place, which is added if it is new.
        type(figure_t), intent(inout) :: figure
        character(*), intent(in) :: word
        character(figure_length), allocatable, intent(inout) :: keys(:)
        integer, intent(out) :: which
        type(error_t), allocatable, intent(out) :: error
        integer :: point, formula

        which = findloc(keys == word, .true., 1)
        if (which > 0) return
        point = 0
        formula = 0
        if (word(:1) == "(") then
            if (word(len(word):) /= ")") then
                call fail(error, "a bracket is not closed in "//quoted(word))
                return
            end if
            formula = figure%statements%count + 1
            call add_formulas(figure%statements, word(2:len(word) - 1), error)
            if (allocated(error)) return
        else if (word /= "origin") then
            if (allocated(figure%d%points)) point = findloc(figure%d%points%name == word, .true., 1)
            if (point == 0) then
                call fail(error, "there is no point "//quoted(word)//"; a place is origin, a "// &
                          "point's name, or (x, y)")
                return
            end if
        end if
        keys = [character(figure_length) :: keys, word]
        figure%point = [figure%point, point]
        figure%formula = [figure%formula, formula]
        figure%places = figure%places + 1
        which = figure%places
    end subroutine find_place

    subroutine add_formulas(statements, text, error)
        !! Three, with 0 for those that are left out.
        type(statements_t), intent(inout) :: statements
        character(*), intent(in) :: text  !! `x, y` or `x, y, z`
        type(error_t), allocatable, intent(out) :: error
        integer :: i, depth, first, added

        depth = 0
        first = 1
        added = 0
        do i = 1, len(text) + 1
            if (i <= len(text)) then
                if (text(i:i) == "(") depth = depth + 1
                if (text(i:i) == ")") depth = depth - 1
                if (text(i:i) /= "," .or. depth > 0) cycle
            end if
            if (added < 3) call statements%add_formula(text(first:i - 1), error)
            if (allocated(error)) return
            added = added + 1
            first = i + 1
        end do
        if (added > 3) call fail(error, "a place has two or three numbers")
        do i = added + 1, 3
            if (.not. allocated(error)) call statements%add_formula("0", error)
        end do
    end subroutine add_formulas

    subroutine place(self, system, t, q, v, r)
        !! Where all places are.
        class(figure_t), intent(in) :: self
        class(system_t), intent(in) :: system  !! the one of `new_figure`
        real(dp), intent(in) :: t, q(:), v(:)  !! time, s; state
        real(dp), intent(out) :: r(:, :)       !! (3, places), m
        type(motion_state_t) :: state
        type(hyperdual_t), allocatable :: points(:, :)
        real(dp) :: left(self%statements%count), right(self%statements%count)
        integer :: i

        r = 0.0_dp
        if (any(self%point > 0)) then
            allocate (points(3, size(self%d%points)))
            call system%positions(hyperdual_t(re=t), [(hyperdual_t(re=q(i)), i=1, size(q))], points)
        end if
        if (self%statements%count > 0) then
            state%t = t
            state%q = q
            state%v = v
            state%q0 = q
            state%v0 = v
            allocate (state%a(size(q)))
            call system%accelerations(t, q, v, state%a)
            call self%statements%evaluate(system, self%d, state, left, right)
        end if
        do i = 1, self%places
            if (self%point(i) > 0) then
                r(:, i) = points(:, self%point(i))%re
            else if (self%formula(i) > 0) then
                r(:, i) = left(self%formula(i):self%formula(i) + 2)
            end if
        end do
    end subroutine place
end module lagrangia_scene_figure
