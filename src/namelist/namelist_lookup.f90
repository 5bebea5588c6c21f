module lagrangia_namelist_lookup
    !! Finding the values of a key in a namelist, and refusing them.
    use lagrangia_errors, only: error_t
    use lagrangia_namelist_tree, only: decimal_points, fail_at, find_group, kind_word, &
                                       namelist_t, place_t, raw_text
    use lagrangia_namelist_unknown, only: label, refuse_missing
    use lagrangia_namelist_words, only: stray, truth_of
    use lagrangia_text, only: escaped, to_text
    implicit none (type, external)
    private
    public :: count_of, pick, point_advice, refuse_picked, refuse_value

contains

    pure function count_of(picked) result(number)
        !! How many values were picked.
        integer, allocatable, intent(in) :: picked(:)
        integer :: number

        number = 0
        if (allocated(picked)) number = size(picked)
    end function count_of

    pure subroutine pick(tree, group, key, picked, error, least, most, required)
        !! Find the values of `key`, element by element, and mark it as used.
        type(namelist_t), intent(inout) :: tree
        character(*), intent(in) :: group, key
        integer, allocatable, intent(out) :: picked(:)       !! positions among the values
        type(error_t), allocatable, intent(out) :: error
        integer, intent(in), optional :: least, most         !! absent: one value, no array
        logical, intent(in), optional :: required
        integer :: i, length, owner, place

        owner = find_group(tree, group)
        if (owner > 0) tree%groups(owner)%used = .true.
        length = 0
        place = 0
        do i = 1, tree%entry_count
            associate (item => tree%entries(i))
                if (owner == 0 .or. item%group /= owner .or. item%key /= key) cycle
                item%used = .true.
                if (item%replaced) cycle
                place = i
                length = max(length, max(1, item%index) + item%count - 1)
                if (item%index == 0 .or. present(least)) cycle
                call fail_at(error, item%place, label(group, key)//" is a single value; write "// &
                             escaped(key, 30)//" = value, without an index")
                return
            end associate
        end do
        allocate (picked(length), source=0)
        if (place == 0) then
            if (present(required)) then
                if (required) call refuse_missing(tree, owner, group, key, error)
            end if
            return
        end if
        call fill(tree, owner, key, picked)
        do i = 1, length
            if (picked(i) == 0) then
                call fail_at(error, tree%entries(place)%place, label(group, key)// &
                             ": element "//to_text(i)//" has no value")
                return
            end if
        end do
        call check_count(tree, picked, tree%entries(place)%place, label(group, key), error, least, &
                         most)
    end subroutine pick

    pure subroutine fill(tree, owner, key, picked)
        !! Put the position of each element's value into `picked`; later entries prevail.
        type(namelist_t), intent(in) :: tree
        integer, intent(in) :: owner
        character(*), intent(in) :: key
        integer, intent(inout) :: picked(:)
        integer :: element, i, k

        do i = 1, tree%entry_count
            associate (item => tree%entries(i))
                if (item%group /= owner .or. item%key /= key .or. item%replaced) cycle
                element = max(1, item%index)
                do k = item%first_value, item%last_value
                    picked(element:element + tree%values(k)%repeats - 1) = k
                    element = element + tree%values(k)%repeats
                end do
            end associate
        end do
    end subroutine fill

    pure function point_advice(tree, group, key, count) result(remedy)
        !! `decimal_points` for a caller who needs `count` values of `key`.
        type(namelist_t), intent(in) :: tree
        character(*), intent(in) :: group, key
        integer, intent(in) :: count
        character(:), allocatable :: remedy
        type(namelist_t) :: copy
        integer, allocatable :: picked(:)
        type(error_t), allocatable :: ignored

        copy = tree
        remedy = ""
        call pick(copy, group, key, picked, ignored, 1, huge(1))
        if (count_of(picked) > 0) remedy = decimal_points(tree, picked, count, count)
    end function point_advice

    pure subroutine check_count(tree, picked, place, name, error, least, most)
        !! Refuse a number of values outside `least` to `most`, or a word among them that is none.
        type(namelist_t), intent(in) :: tree
        integer, intent(in) :: picked(:)
        type(place_t), intent(in) :: place
        character(*), intent(in) :: name
        type(error_t), allocatable, intent(out) :: error
        integer, intent(in), optional :: least, most
        character(:), allocatable :: allowed
        integer :: high, i, length, low

        length = size(picked)
        low = 1
        high = 1
        if (present(least)) low = least
        if (present(most)) high = most
        if (length >= low .and. length <= high) return
        do i = 1, length
            associate (value => tree%values(picked(i)))
                if (value%kind /= kind_word .or. value%line == 0) cycle
                if (truth_of(raw_text(tree, value)) >= 0) cycle
                call refuse_picked(tree, picked(i), stray, error)
                return
            end associate
        end do
        allowed = to_text(low)
        if (low == high .and. high == 1) allowed = "one"
        if (high > low) allowed = "from "//to_text(low)//" to "//to_text(high)
        call fail_at(error, place, name//" has "//to_text(length)//" value"// &
                     trim(merge("s", " ", length /= 1))//"; "//allowed// &
                     trim(merge(" is ", " are", high == 1))//" needed"// &
                     decimal_points(tree, picked, low, high)// &
                     trim(merge("; 3*x means x, x, x", "                   ", &
                                any(tree%values(picked)%repeats > 1))))
    end subroutine check_count

    pure subroutine refuse_picked(tree, position, problem, error)
        !! Fail with the place, group, key and text of the value at `position`, and `problem`.
        type(namelist_t), intent(in) :: tree
        integer, intent(in) :: position
        character(*), intent(in) :: problem
        type(error_t), allocatable, intent(out) :: error
        integer :: i

        do i = 1, tree%entry_count - 1
            if (tree%entries(i)%last_value >= position) exit
        end do
        associate (item => tree%entries(i), value => tree%values(position))
            call fail_at(error, place_t(item%place%source, value%line, value%column), &
                         label(tree%groups(item%group)%name, item%key)//" = "// &
                         escaped(raw_text(tree, value))//": "//problem)
        end associate
    end subroutine refuse_picked

    pure subroutine refuse_value(tree, group, key, problem, error, element)
        !! For checks that only the caller can make: refuse the value of `key` (or of one
        !! `element`) with its place, as in `a.nml:3:8: &scene: dt = -1: must be positive`.
        type(namelist_t), intent(inout) :: tree
        character(*), intent(in) :: group, key, problem
        type(error_t), allocatable, intent(out) :: error
        integer, intent(in), optional :: element
        integer, allocatable :: picked(:)
        type(error_t), allocatable :: ignored
        integer :: i, position

        call pick(tree, group, key, picked, ignored, 1, huge(1))
        i = 1
        if (present(element)) i = max(1, element)
        position = 0
        if (i <= count_of(picked)) position = picked(i)
        if (position > 0) then
            call refuse_picked(tree, position, problem, error)
        else
            call fail_at(error, place_t(tree%source), label(group, key)//": "//problem)
        end if
    end subroutine refuse_value

end module lagrangia_namelist_lookup
