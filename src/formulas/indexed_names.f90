module lagrangia_indexed_names
    !! Indices in a formula: `sum(i, 1, 4, k/2 (x_(i + 1) - x_i)^2)`. Within the sum `i` is a
    !! number, and `x_i`, `x_i_dot`, `x_(i + 1)_dot` are the names that it makes.
    use lagrangia_errors, only: error_t
    use lagrangia_expression, only: is_function_name
    use lagrangia_formula_reader, only: go_deeper, most_indices, next_is, reader_t, refuse
    use lagrangia_formula_tokens, only: is_end, is_name, is_number
    use lagrangia_kinds, only: dp
    use lagrangia_names, only: name_length
    use lagrangia_number_class, only: is_zero
    use lagrangia_symbols, only: symbols_t
    use lagrangia_text, only: quoted, to_text
    implicit none (type, external)
    private
    public :: begins_sum, is_of_chain, open_sum, put_indices, refuse_index, skip_body

    integer, parameter :: most_terms = 1000
    character(*), parameter :: example = "write it as sum(i, 1, 4, m/2 x_i_dot^2)"

contains

    pure function begins_sum(reader) result(yes)
        !! Is `sum(` next?
        type(reader_t), intent(in) :: reader  !! within a text
        logical :: yes

        yes = reader%tokens%word(reader%at) == "sum"
        if (yes) yes = reader%tokens%word(reader%at + 1) == "("
    end function begins_sum

    pure subroutine open_sum(reader, symbols, first, last, error)
        !! `sum(i, 1, 4, `: a new index, which has no number yet.
        type(reader_t), intent(inout) :: reader           !! at the word sum; then at the formula
        type(symbols_t), intent(in) :: symbols            !! names that the index cannot have
        integer, intent(out) :: first, last               !! its numbers
        type(error_t), allocatable, intent(out) :: error  !! with column and remedy
        character(:), allocatable :: name

        first = 0
        last = 0
        call go_deeper(reader, error)
        if (allocated(error)) return
        reader%bars = 0
        reader%at = reader%at + 2
        name = reader%tokens%word(reader%at)
        if (reader%tokens%token(reader%at)%kind /= is_name .or. index(name, "_") > 0) then
            call refuse(reader, "a sum begins with the name of its index; "//example, error)
        else if (symbols%find(name) > 0 .or. symbols%find_definition(name) > 0 .or. &
                 name == "pi" .or. is_function_name(name) .or. &
                 any(reader%index_names(:reader%indices) == name)) then
            call refuse(reader, quoted(name)//" has a meaning already; take another index", error)
        else if (reader%indices == most_indices) then
            call refuse(reader, "more than "//to_text(most_indices)//" sums within each other", &
                        error)
        end if
        if (.not. allocated(error)) call pass_comma(reader, error)
        if (.not. allocated(error)) call read_whole(reader, first, error)
        if (.not. allocated(error)) call pass_comma(reader, error, back=.true.)
        if (.not. allocated(error)) call read_whole(reader, last, error)
        if (.not. allocated(error)) call pass_comma(reader, error, back=.true.)
        if (allocated(error)) return
        if (last - first >= most_terms) then
            call refuse(reader, "the sum has more than "//to_text(most_terms)//" terms", error)
            return
        end if
        reader%indices = reader%indices + 1
        reader%index_names(reader%indices) = name
    end subroutine open_sum

    pure subroutine pass_comma(reader, error, back)
        !! Go to what stands behind the next comma, which must follow.
        type(reader_t), intent(inout) :: reader
        type(error_t), allocatable, intent(out) :: error
        logical, intent(in), optional :: back  !! it is at this token, not behind it

        if (.not. present(back)) reader%at = reader%at + 1
        if (.not. next_is(reader, ",")) then
            call refuse(reader, "a sum has an index, where it begins and ends, and a formula, "// &
                        "with commas between them; "//example, error)
            return
        end if
        reader%at = reader%at + 1
    end subroutine pass_comma

    pure subroutine read_whole(reader, value, error)
        !! `4`, `i`, `i + 1`, `n - i` of numbers and indices.
        type(reader_t), intent(inout) :: reader
        integer, intent(out) :: value
        type(error_t), allocatable, intent(out) :: error
        real(dp), parameter :: largest = 1e6_dp
        integer :: sign, which

        value = 0
        do
            sign = 1
            if (next_is(reader, "-")) sign = -1
            if (next_is(reader, "-") .or. next_is(reader, "+")) reader%at = reader%at + 1
            associate (token => reader%tokens%token(reader%at))
                which = findloc(reader%index_names(:reader%indices) == &
                                reader%tokens%word(reader%at), .true., 1)
                if (token%kind == is_number .and. token%value <= largest .and. &
                    is_zero(token%value - anint(token%value))) then
                    value = value + sign*nint(token%value)
                else if (token%kind == is_name .and. which > 0) then
                    value = value + sign*reader%index_values(which)
                else
                    call refuse(reader, "an index is a whole number or the index of a sum, "// &
                                "as in x_(i + 1), sum(i, 1, 4, ...)", error)
                    return
                end if
            end associate
            reader%at = reader%at + 1
            if (abs(value) > largest) then
                call refuse(reader, "the index is too large", error)
                return
            end if
            if (.not. (next_is(reader, "-") .or. next_is(reader, "+"))) return
        end do
    end subroutine read_whole

    pure subroutine put_indices(reader, name, indexed, error)
        !! `x_3_dot` for `x_i_dot` where i is 3; also for `x_(i + 1)_dot` where it is 2, of which
        !! all but the last token is passed.
        type(reader_t), intent(inout) :: reader               !! at the name
        character(*), intent(in) :: name                      !! of which `_i` is a part
        character(:), allocatable, intent(out) :: indexed     !! the same with numbers
        type(error_t), allocatable, intent(out) :: error      !! no whole number in the bracket
        character(:), allocatable :: next
        integer :: first, i, last, value

        indexed = ""
        first = 1
        do while (first <= len(name))
            last = first + index(name(first:)//"_", "_") - 2
            i = findloc(reader%index_names(:reader%indices) == name(first:last), .true., 1)
            if (i > 0 .and. first > 1) then
                indexed = indexed//to_text(reader%index_values(i))
            else
                indexed = indexed//name(first:last)
            end if
            if (last < len(name)) indexed = indexed//"_"
            first = last + 2
        end do
        if (name(len(name):) /= "_") return
        if (reader%tokens%word(min(reader%at + 1, size(reader%tokens%token))) /= "(") return
        if (.not. reader%tokens%token(reader%at + 1)%glued) return
        reader%at = reader%at + 2
        call read_whole(reader, value, error)
        if (allocated(error)) return
        if (.not. next_is(reader, ")")) then
            call refuse(reader, "the bracket of an index is not closed; write x_(i + 1)", error)
            return
        end if
        indexed = indexed//to_text(value)
        next = reader%tokens%word(reader%at + 1)
        if (index(next, "_d") /= 1) return
        indexed = indexed//next
        reader%at = reader%at + 1
    end subroutine put_indices

    pure subroutine refuse_index(reader, symbols, name, indexed, error)
        !! There is no such name: say which there are of its kind.
        type(reader_t), intent(in) :: reader              !! at the name
        type(symbols_t), intent(in) :: symbols            !! the names that there are
        character(*), intent(in) :: name                  !! as typed
        character(*), intent(in) :: indexed               !! that is none of them
        type(error_t), allocatable, intent(out) :: error  !! always
        character(:), allocatable :: there
        character(name_length) :: other
        integer :: at, i

        there = ""
        at = index(name, "_")
        if (name == indexed) at = index(name, "_", back=.true.)
        do i = 1, size(symbols%names)
            other = symbols%names(i)
            if (index(other, name(:at)) /= 1) cycle
            if (verify(trim(other(at + 1:)), "0123456789") > 0) cycle
            if (len(there) > 60) then
                there = there//", ..."
                exit
            end if
            there = there//", "//trim(other)
        end do
        if (name == indexed) then
            call refuse(reader, "there is no "//quoted(name)//"; there are "//there(3:), error)
        else if (there == "") then
            call refuse(reader, quoted(name)//" is "//quoted(indexed)//" here, and there is none", &
                        error)
        else
            call refuse(reader, quoted(name)//" is "//quoted(indexed)//" here, and there is "// &
                        "only "//there(3:), error)
        end if
    end subroutine refuse_index

    pure function is_of_chain(symbols, name) result(yes)
        !! Is it a name with another number than those there are, `x_5` of x_1 to x_4?
        type(symbols_t), intent(in) :: symbols  !! the names that there are
        character(*), intent(in) :: name        !! none of them
        logical :: yes
        integer :: at, i

        yes = .false.
        at = index(name, "_", back=.true.)
        if (at < 2 .or. at == len(name)) return
        if (verify(name(at + 1:), "0123456789") > 0) return
        do i = 1, size(symbols%names)
            if (index(symbols%names(i), name(:at)) /= 1) cycle
            yes = yes .or. verify(trim(symbols%names(i)(at + 1:)), "0123456789") == 0
        end do
    end function is_of_chain

    pure subroutine skip_body(reader, error)
        !! To the bracket that closes a sum of no terms.
        type(reader_t), intent(inout) :: reader           !! at the formula
        type(error_t), allocatable, intent(out) :: error  !! it is not closed
        integer :: depth

        depth = 0
        do while (reader%tokens%token(reader%at)%kind /= is_end)
            if (next_is(reader, ")") .and. depth == 0) return
            if (next_is(reader, "(")) depth = depth + 1
            if (next_is(reader, ")")) depth = depth - 1
            reader%at = reader%at + 1
        end do
        call refuse(reader, "the bracket of a sum is not closed; write sum(i, 1, 4, x_i^2)", error)
    end subroutine skip_body
end module lagrangia_indexed_names
