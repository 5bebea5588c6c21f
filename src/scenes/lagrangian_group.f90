module lagrangia_lagrangian_group
    !! The group `&lagrangian` of a scene: a system in formulas, its parameters' values in the group
    !! of its name.
    use lagrangia_description, only: check_parameter, name_length, quantity_t, real_number
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp
    use lagrangia_name_ranges, only: expand_ranges, family_of, with_number
    use lagrangia_namelist, only: get_real, get_strings, has_key, namelist_t, refuse_unknown_keys, &
                                  refuse_value
    use lagrangia_parameter_domains, only: set_domain
    use lagrangia_parameter_keys, only: refuse_parameter, refuse_unknown_parameters
    use lagrangia_scene, only: add_texts, scene_line_length
    use lagrangia_text, only: lower, quoted, to_text
    use lagrangia_written_formulas, only: longest_formula, written_formulas_t
    implicit none (type, external)
    private
    public :: group, read_formulas, read_values, refuse_formula, formula_lines

    character(*), parameter :: group = "lagrangian"
    integer, parameter :: most = 200   !! texts of one key
    integer, parameter :: piece = 80, longest_piece = 500  !! characters of an echo's line; at most
    character(name_length), parameter :: keys(*) = [character(name_length) :: &
        "coordinates", "parameters", "t", "v", "l", "definitions", "positions", "equilibrium", &
        "constraint", "quantities", "domain", "rotors"]
    character(*), parameter :: syntax = "a name, its unit and a few words are written "// &
                                        "'r [m] length of the spring'"

contains

    subroutine read_formulas(tree, formulas, error)
        !! What `&lagrangian` says.
        type(namelist_t), intent(inout) :: tree              !! keys that are read are marked
        type(written_formulas_t), intent(inout) :: formulas  !! has its name; gets the rest
        type(error_t), allocatable, intent(out) :: error     !! a text that is missing or too long
        type(quantity_t), allocatable :: items(:)
        character(longest_formula), allocatable :: domains(:)
        type(error_t), allocatable :: found
        character(name_length), allocatable :: families(:)
        character(:), allocatable :: family, force, number
        integer :: i

        call read_names(tree, "coordinates", .true., formulas%coordinates, error)
        if (allocated(error)) return
        call read_names(tree, "parameters", .false., items, error)
        if (allocated(error)) return
        call read_formula("t", formulas%kinetic)
        if (allocated(error)) return
        call read_formula("v", formulas%potential)
        if (allocated(error)) return
        call read_formula("l", formulas%lagrangian)
        if (allocated(error)) return
        allocate (formulas%forces(size(formulas%coordinates)), families(0))
        do i = 1, size(formulas%forces)
            call family_of(trim(formulas%coordinates(i)%name), family, number)  ! if it has one
            call read_formula(force_key(tree, trim(formulas%coordinates(i)%name)), force)
            if (allocated(error)) return
            if (.not. has_key(tree, group, own_key(trim(formulas%coordinates(i)%name)))) then
                force = with_number(force, number)
            end if
            formulas%forces(i) = force
            if (family == "" .or. any(families == own_key(family))) cycle
            families = [character(len(keys)) :: families, own_key(family)]
        end do
        call read_chain("definitions", formulas%definitions)
        if (.not. allocated(error)) call read_chain("positions", formulas%positions)
        if (.not. allocated(error)) call read_chain("rotors", formulas%rotors)
        if (.not. allocated(error)) call read_chain("equilibrium", formulas%equilibrium)
        if (.not. allocated(error)) call read_chain("constraint", formulas%constraints)
        if (allocated(error)) return
        call read_quantities(formulas%quantities, formulas%quantity_formulas)
        if (allocated(error)) return
        call read_list("domain", domains)
        if (allocated(error)) return
        call refuse_unknown_keys(tree, group, [character(len(keys)) :: keys, &
                                               (own_key(trim(formulas%coordinates(i)%name)), &
                                                i=1, size(formulas%coordinates)), families], error)
        if (allocated(error)) return
        allocate (formulas%parameters(size(items)))
        do i = 1, size(items)
            formulas%parameters(i) = real_number(trim(items(i)%name), trim(items(i)%unit), &
                                                 trim(items(i)%meaning), 0.0_dp)
        end do
        do i = 1, size(domains)
            if (allocated(error)) return
            call set_domain(trim(domains(i)), formulas%parameters, found)
            if (allocated(found)) call refuse_value(tree, group, "domain", found%message, error, i)
        end do
    contains
        subroutine read_formula(key, formula)
            !! One formula, perhaps in several texts.
            character(*), intent(in) :: key
            character(:), allocatable, intent(out) :: formula
            character(longest_formula), allocatable :: texts(:), pieces(:)

            call read_list(key, texts)
            if (.not. allocated(error)) call join_pieces(texts, formula)
            if (allocated(error)) return
            call split(formula, pieces)
            if (len(formula) > longest_formula) then
                call refuse_value(tree, group, key, "a formula has at most "// &
                                  to_text(longest_formula)//" characters", error)
            else if (formula == "" .and. has_key(tree, group, key)) then
                call refuse_value(tree, group, key, "there is no formula in the quotes", error)
            else if (any(len_trim(pieces) > longest_piece)) then
                call refuse_value(tree, group, key, "more than "//to_text(longest_piece)// &
                                  " characters without a sign or a blank; put blanks "// &
                                  "between factors", error)
            end if
        end subroutine read_formula

        subroutine read_quantities(items, texts)
            !! `'L_z [J s] angular momentum = m r^2 phi_dot'`: what stands before the sign = is as
            !! with coordinates; of the formula the column is kept.
            type(quantity_t), allocatable, intent(out) :: items(:)
            character(longest_formula), allocatable, intent(out) :: texts(:)
            character(*), parameter :: example = "a quantity is written "// &
                "'L_z [kg m^2/s] angular momentum = m r^2 phi_dot'"
            character(:), allocatable :: problem
            integer, allocatable :: from(:)
            integer :: equals, i

            call read_chain("quantities", texts, from)
            allocate (items(merge(0, size(texts), allocated(error))))
            do i = 1, size(items)
                equals = index(texts(i), "=")
                if (equals == 0) then
                    problem = example
                else
                    call take_name(texts(i)(:equals - 1), items(i), problem)
                end if
                if (problem /= "") then
                    call refuse_value(tree, group, "quantities", problem, error, from(i))
                    return
                end if
                texts(i)(:equals) = ""
            end do
        end subroutine read_quantities

        subroutine read_chain(key, texts, from)
            !! Texts of which one may be as many: `'d_1 .. d_3 = x_(i + 1) - x_i'`.
            character(*), intent(in) :: key
            character(longest_formula), allocatable, intent(out) :: texts(:)
            integer, allocatable, intent(out), optional :: from(:)  !! of which text each comes
            character(longest_formula), allocatable :: typed(:)
            character(:), allocatable :: problem
            integer, allocatable :: of(:)

            allocate (texts(0))
            call read_list(key, typed)
            if (allocated(error)) return
            deallocate (texts)
            call expand_ranges(typed, texts, of, problem)
            if (problem /= "") call refuse_value(tree, group, key, problem, error, of(size(of)))
            if (present(from)) from = of
        end subroutine read_chain

        subroutine read_list(key, texts)
            character(*), intent(in) :: key
            character(longest_formula), allocatable, intent(out) :: texts(:)
            integer :: i

            allocate (texts(0))
            call get_strings(tree, group, key, 1, most, texts, error)
            if (allocated(error)) return
            do i = 1, size(texts)
                if (len_trim(texts(i)) <= longest_piece .or. is_formula(key)) cycle
                call refuse_value(tree, group, key, "a text of at most "// &
                                  to_text(longest_piece)//" characters is needed", error, i)
                return
            end do
        end subroutine read_list
    end subroutine read_formulas

    subroutine read_values(tree, formulas, error)
        !! The values of the parameters, from the group of the system's name.
        type(namelist_t), intent(inout) :: tree              !! keys that are read are marked
        type(written_formulas_t), intent(inout) :: formulas  !! has its names; gets the values
        type(error_t), allocatable, intent(out) :: error     !! a value that is missing
        character(name_length) :: names(size(formulas%parameters))
        type(error_t), allocatable :: found
        integer :: i, twin

        do i = 1, size(names)
            names(i) = lower(formulas%parameters(i)%name)
            twin = findloc(names(:i - 1) == names(i), .true., 1)
            if (twin == 0) cycle
            call refuse_value(tree, group, "parameters", "as a key it is the same as "// &
                              trim(formulas%parameters(twin)%name)//", for capital letters do "// &
                              "not count; take another name", error, i)
            return
        end do
        do i = 1, size(names)
            call get_real(tree, trim(formulas%name), trim(names(i)), &
                          formulas%parameters(i)%value(1), error, required=.true.)
            if (allocated(error)) return
            call check_parameter(formulas%parameters(i), found)
            if (allocated(found)) call refuse_parameter(tree, trim(formulas%name), &
                trim(names(i)), formulas%parameters(i), error)
            if (allocated(error)) return
        end do
        call refuse_unknown_parameters(tree, trim(formulas%name), names, formulas%coordinates, &
                                       "lagrangia describe SCENE", "; parameters are "// &
                                       "named in &lagrangian: parameters", error)
    end subroutine read_values

    subroutine read_names(tree, key, required, items, error)
        !! `'r [m] length of the spring'`, one text each, or `'x_1 .. x_4 [m]'`.
        type(namelist_t), intent(inout) :: tree
        character(*), intent(in) :: key
        logical, intent(in) :: required
        type(quantity_t), allocatable, intent(out) :: items(:)
        type(error_t), allocatable, intent(out) :: error
        character(200), allocatable :: texts(:)
        character(longest_formula), allocatable :: single(:)
        character(:), allocatable :: problem
        integer, allocatable :: from(:)
        integer :: i

        allocate (texts(0))
        call get_strings(tree, group, key, 1, most, texts, error, required=required)
        if (allocated(error)) return
        call expand_ranges(texts, single, from, problem)
        allocate (items(size(single)))
        if (problem /= "") call refuse_value(tree, group, key, problem, error, from(size(from)))
        do i = 1, size(single)
            if (allocated(error)) return
            call take_name(trim(single(i)), items(i), problem)
            if (problem /= "") call refuse_value(tree, group, key, problem, error, from(i))
        end do
    end subroutine read_names

    pure subroutine take_name(from, item, problem)
        !! `r [m] length of the spring`: a name, perhaps a unit and a few words.
        character(*), intent(in) :: from
        type(quantity_t), intent(out) :: item
        character(:), allocatable, intent(out) :: problem  !! "" if there is none
        character(:), allocatable :: text
        integer :: left, right

        problem = ""
        text = trim(adjustl(from))
        left = scan(text//" ", " [")
        if (left - 1 > name_length .or. left == 1) then
            problem = syntax
            return
        end if
        item%name = text(:left - 1)
        text = trim(adjustl(text(left:)))
        if (index(text, "[") == 1) then
            right = index(text, "]")
            if (right < 3 .or. right > 2 + len(item%unit)) then
                problem = "a unit of up to "//to_text(len(item%unit))//" characters stands "// &
                          "between brackets; "//syntax
                return
            end if
            item%unit = text(2:right - 1)
            text = trim(adjustl(text(right + 1:)))
        end if
        if (len(text) > len(item%meaning)) problem = "more than "//to_text(len(item%meaning))// &
                                                     " characters behind the name"
        item%meaning = text
    end subroutine take_name

    pure function own_key(coordinate) result(key)
        !! Where the generalised force on a coordinate stands: `q_theta`.
        character(*), intent(in) :: coordinate  !! its name
        character(:), allocatable :: key

        key = "q_"//lower(coordinate)
    end function own_key

    pure function force_key(tree, coordinate) result(key)
        !! The same; of `x_3` it is `q_x_i` where there is that, and no `q_x_3`.
        type(namelist_t), intent(in) :: tree
        character(*), intent(in) :: coordinate  !! its name
        character(:), allocatable :: key
        character(:), allocatable :: family, number

        key = own_key(coordinate)
        if (has_key(tree, group, key)) return
        call family_of(coordinate, family, number)
        if (family == "") return
        if (has_key(tree, group, own_key(family))) key = own_key(family)
    end function force_key

    pure function is_formula(key) result(yes)
        !! T, V, L or a force: one formula, perhaps in several texts.
        character(*), intent(in) :: key
        logical :: yes

        yes = len(key) == 1 .or. index(key, "q_") == 1
    end function is_formula

    pure subroutine join_pieces(texts, formula)
        !! A formula in several texts is one.
        character(*), intent(in) :: texts(:)
        character(:), allocatable, intent(out) :: formula
        integer :: i

        formula = ""
        if (size(texts) > 0) formula = trim(texts(1))
        do i = 2, size(texts)
            formula = formula//repeat(" ", gap(texts(i - 1), texts(i)))//trim(texts(i))
        end do
    end subroutine join_pieces

    pure function gap(left, right) result(blanks)
        !! How many blanks are put between two texts of a formula: one, but none before a sign that
        !! no blank follows, so that a formula that was broken there does not grow.
        character(*), intent(in) :: left, right
        integer :: blanks

        blanks = 1
        if (scan(right(:1), "+-*/") == 1 .and. right(2:min(2, len(right))) /= " " .and. &
            index(trim(left)//"|", "*|") == 0) blanks = 0
    end function gap

    pure subroutine split(formula, pieces)
        !! The formula in pieces of at most `piece` characters; where it has no place to break so
        !! near, in longer ones.
        character(*), intent(in) :: formula
        character(longest_formula), allocatable, intent(out) :: pieces(:)
        integer :: first, i, last, length

        allocate (pieces(0))
        length = len_trim(formula)
        first = 1
        do while (first <= length)
            last = length
            if (length - first >= piece) then
                do i = first + 1, length - 1
                    if (.not. may_break(formula, i)) cycle
                    if (i - first >= piece .and. last < length) exit
                    last = i
                    if (i - first >= piece) exit
                end do
            end if
            pieces = [character(longest_formula) :: pieces, formula(first:last)]
            first = last + 1
        end do
    end subroutine split

    pure function may_break(formula, i) result(yes)
        !! Does a blank behind character `i` change nothing?
        character(*), intent(in) :: formula
        integer, intent(in) :: i
        logical :: yes
        character(1) :: here, next

        here = formula(i:i)
        next = formula(i + 1:i + 1)
        yes = here == " " .or. next == " " .or. next == "/"
        if (scan(next, "+-") == 1) yes = scan(here, "eE") == 0  ! 1e-3
        if (next == "*") yes = here /= "*"
    end function may_break

    subroutine refuse_formula(tree, found, error)
        !! Give an error in the formulas its place.
        type(namelist_t), intent(inout) :: tree  !! keys that are read are marked as used
        type(error_t), intent(in) :: found       !! with its key and element
        type(error_t), allocatable, intent(out) :: error  !! with file, line, column
        character(longest_formula), allocatable :: texts(:), single(:)
        character(:), allocatable :: key, message, problem
        integer, allocatable :: from(:)
        integer :: element, at, i

        element = found%element
        key = found%key
        if (index(key, "q_") == 1) key = force_key(tree, key(3:))
        at = column_of(found%message)
        message = found%message
        if (.not. is_formula(key)) then
            allocate (texts(0))
            call get_strings(tree, group, key, 1, most, texts, error)
            call expand_ranges(texts, single, from, problem)
            if (element <= size(from)) then
                i = index(message, ":")
                if (single(element) /= texts(from(element)) .and. at > 0) message = &
                    message(:i - 1)//" of "//quoted(trim(single(element)), 60)//message(i:)
                if (single(element) /= texts(from(element))) at = 0
                element = from(element)
            end if
        else
            allocate (texts(0))
            call get_strings(tree, group, key, 1, most, texts, error)
            do element = 1, size(texts) - 1
                i = len_trim(texts(element)) + gap(texts(element), texts(element + 1))
                if (at <= i) exit
                at = at - i
            end do
        end if
        call refuse_value(tree, group, key, message, error, element, at)
        error%status = found%status
    end subroutine refuse_formula

    pure function column_of(message) result(column)
        !! The number that `column 12: ` at the beginning of a message says; 0 where there is none.
        character(*), intent(in) :: message
        integer :: column, status

        column = 0
        if (index(message, "column ") /= 1) return
        read (message(8:index(message, ":") - 1), *, iostat=status) column
        if (status /= 0) column = 0
    end function column_of

    subroutine formula_lines(tree, formulas, lines)
        !! The group as it was read, for the echo of the scene.
        type(namelist_t), intent(inout) :: tree          !! keys that are read are marked as used
        type(written_formulas_t), intent(in) :: formulas !! of this tree
        character(scene_line_length), allocatable, intent(out) :: lines(:)  !! `&lagrangian` to `/`
        integer :: i

        lines = [character(scene_line_length) :: "&"//group]
        call add_list("coordinates")
        call add_list("parameters")
        call add_list("definitions")
        call add_formula("T", formulas%kinetic)
        call add_formula("V", formulas%potential)
        call add_formula("L", formulas%lagrangian)
        do i = 1, size(formulas%forces)
            call add_formula("Q_"//trim(formulas%coordinates(i)%name), trim(formulas%forces(i)))
        end do
        call add_list("positions")
        call add_list("rotors")
        call add_list("equilibrium")
        call add_list("constraint")
        call add_list("quantities")
        call add_list("domain")
        lines = [character(scene_line_length) :: lines, "/"]
    contains
        subroutine add_list(key)
            character(*), intent(in) :: key
            character(longest_formula), allocatable :: texts(:)
            type(error_t), allocatable :: error

            allocate (texts(0))
            call get_strings(tree, group, key, 1, most, texts, error)
            call add_texts(lines, key, texts)
        end subroutine add_list

        subroutine add_formula(key, formula)
            character(*), intent(in) :: key, formula
            character(longest_formula), allocatable :: pieces(:)

            call split(formula, pieces)
            call add_texts(lines, key, pieces)
        end subroutine add_formula
    end subroutine formula_lines
end module lagrangia_lagrangian_group
