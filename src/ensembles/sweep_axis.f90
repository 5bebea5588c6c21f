module lagrangia_sweep_axis
    !! An axis of a sweep: which number of a scene it changes, and to which values.
    !!
    !! `theta = -pi:pi:400` is 400 values of the coordinate, both ends among them; `:log` behind it
    !! spaces them by equal factors, `:random` draws them between the ends. A name is that of a
    !! coordinate, a velocity (`theta_dot`), a parameter (`m1`, `B(3)`), or `q`, `v`, `q(2)`.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use lagrangia_constant_formula, only: read_constant
    use lagrangia_description, only: described_by, description_t, name_length
    use lagrangia_errors, only: error_t, fail
    use lagrangia_kinds, only: dp, i8
    use lagrangia_names, only: abbreviation, advice, nearest_name
    use lagrangia_number_class, only: is_nonzero
    use lagrangia_number_reader, only: to_integer
    use lagrangia_random_draws, only: random_t
    use lagrangia_system, only: system_t
    use lagrangia_text, only: quoted, to_text
    implicit none (type, external)
    private
    public :: sweep_axis_t, sweep_axis_box_t, new_sweep_axis

    integer, parameter :: of_coordinate = 1, of_velocity = 2, of_parameter = 3
    integer(i8), parameter :: most_values = 10_i8**15  !! doubles between two ends
    integer(i8), parameter :: most_drawn = 10_i8**8    !! these are kept in memory

    type :: sweep_axis_t
        character(name_length) :: name = ""      !! as it was typed
        character(16) :: unit = "1"
        logical :: logarithmic = .false.         !! spaced by equal factors
        logical :: random = .false.              !! drawn, so in no order
        real(dp) :: ends(2) = 0.0_dp             !! as they were typed, in that unit
        integer(i8) :: count = 0                 !! values
        real(dp), allocatable, private :: drawn(:)  !! all of them, in that unit, if `random`
        integer, private :: kind = 0
        integer, private :: element = 0          !! of q, v, or the parameters
    contains
        procedure :: value
        procedure :: lowest
        procedure :: highest
        procedure :: set
        procedure :: is_parameter
        procedure :: is_velocity
        procedure :: changes_the_same
    end type sweep_axis_t

    type :: sweep_axis_box_t
        !! gfortran 12 needs it: modules that make the dispatch table of `sweep_axis_t` for
        !! themselves disagree about its order.
        class(sweep_axis_t), allocatable :: item
    end type sweep_axis_box_t

    type :: target_t
        !! A number that an axis can change.
        character(name_length) :: name = ""
        character(16) :: unit = "1"
        integer :: kind = 0
        integer :: element = 0
    end type target_t

contains

    subroutine new_sweep_axis(axis, text, system, random, error)
        !! Read `NAME = FROM:TO:COUNT`, perhaps with `:log` or `:random` behind it.
        type(sweep_axis_t), intent(out) :: axis           !! with its values
        character(*), intent(in) :: text                  !! as above
        class(system_t), intent(in) :: system             !! with its parameters
        type(random_t), intent(inout) :: random           !! gives the values that are drawn
        type(error_t), allocatable, intent(out) :: error  !! status 2: what cannot be read
        real(dp) :: ends(2)
        integer(i8) :: count, i, most
        integer :: bounds(4), equals
        character(:), allocatable :: range, spacing, problem
        type(description_t) :: d

        equals = index(text, "=")
        if (equals == 0) then
            call system%describe(d)
            call fail(error, "an axis of a sweep looks like "// &
                      examples(d%coordinates(1)%name)//"; "//quoted(trim(text))// &
                      " has no '='")
            return
        end if
        call find_target(axis, trim(adjustl(text(:equals - 1))), system, error)
        if (allocated(error)) return
        range = trim(text(equals + 1:))
        call cut(range, bounds)
        if (bounds(2) == 0) then
            call fail(error, "the axis "//trim(axis%name)//" needs FROM:TO:COUNT, as in "// &
                      examples(axis%name))
            return
        end if
        call read_end(axis%name, range(:bounds(1) - 1), ends(1), error)
        if (.not. allocated(error)) call read_end(axis%name, range(bounds(1) + 1:bounds(2) - 1), &
                                                  ends(2), error)
        if (allocated(error)) then
            error%message = "the axis "//trim(axis%name)//": "//error%message
            return
        end if
        if (bounds(3) == 0) bounds(3) = len(range) + 1
        call to_integer(trim(adjustl(range(bounds(2) + 1:bounds(3) - 1))), count, problem)
        spacing = ""
        if (bounds(3) <= len(range)) spacing = trim(adjustl(range(bounds(3) + 1:)))
        axis%logarithmic = spacing == "log"
        axis%random = spacing == "random"
        most = merge(most_drawn, most_values, axis%random)
        if (problem /= "" .or. count < 1 .or. count > most) then
            call fail(error, "the axis "//trim(axis%name)//" needs a whole number of values, "// &
                      "from 1 to "//to_text(most)//", not "// &
                      quoted(trim(adjustl(range(bounds(2) + 1:bounds(3) - 1)))))
            return
        end if
        if (bounds(3) <= len(range) .and. .not. (axis%logarithmic .or. axis%random)) then
            call fail(error, "the axis "//trim(axis%name)//": "//quoted(spacing)//" is neither "// &
                      "'log' nor 'random'")
        else if (axis%logarithmic .and. .not. minval(ends) > 0.0_dp) then
            call fail(error, "the axis "//trim(axis%name)//" is spaced by factors, so both "// &
                      "ends must be above 0")
        else if (axis%logarithmic .and. .not. in_range(ends(2)/ends(1)) .or. &
                 .not. ieee_is_finite(ends(2) - ends(1))) then
            call fail(error, "the ends of the axis "//trim(axis%name)//" are too far apart for "// &
                      "doubles")
        else if (count == 1 .and. is_nonzero(ends(2) - ends(1))) then
            call fail(error, "the axis "//trim(axis%name)//" has one value but two ends")
        end if
        if (allocated(error)) return
        axis%ends = ends
        axis%count = count
        if (.not. axis%random) return
        allocate (axis%drawn(count))
        do i = 1, count
            call random%uniform(ends(1), ends(2), axis%drawn(i))
        end do
    end subroutine new_sweep_axis

    elemental function value(self, which) result(x)
        !! Of this number. Only those that are drawn are kept, so that an axis may be of any length.
        class(sweep_axis_t), intent(in) :: self
        integer(i8), intent(in) :: which  !! from 1 to `count`
        real(dp) :: x                     !! in the axis' unit

        if (self%random) then
            x = self%drawn(which)
        else if (which == self%count) then
            x = self%ends(2)
        else
            x = place(self%ends, real(which - 1, dp)/(self%count - 1), self%logarithmic)
        end if
    end function value

    pure function lowest(self) result(which)
        !! The number of the smallest value.
        class(sweep_axis_t), intent(in) :: self
        integer(i8) :: which

        if (self%random) then
            which = minloc(self%drawn, 1, kind=i8)
        else
            which = merge(1_i8, self%count, self%ends(1) <= self%ends(2))
        end if
    end function lowest

    pure function highest(self) result(which)
        !! The number of the largest value.
        class(sweep_axis_t), intent(in) :: self
        integer(i8) :: which

        if (self%random) then
            which = maxloc(self%drawn, 1, kind=i8)
        else
            which = merge(self%count, 1_i8, self%ends(1) <= self%ends(2))
        end if
    end function highest

    pure function place(ends, part, logarithmic) result(value)
        !! A value at a part of the way from the first end to the last.
        real(dp), intent(in) :: ends(2), part
        logical, intent(in) :: logarithmic
        real(dp) :: value

        if (logarithmic) then
            value = ends(1)*(ends(2)/ends(1))**part
        else
            value = (1.0_dp - part)*ends(1) + part*ends(2)
        end if
    end function place

    elemental function in_range(x) result(yes)
        !! Neither infinite nor subnormal.
        real(dp), intent(in) :: x
        logical :: yes

        yes = x >= tiny(x) .and. x <= huge(x)
    end function in_range

    pure subroutine cut(text, places)
        !! Where the first four colons stand; 0 where there are fewer.
        character(*), intent(in) :: text
        integer, intent(out) :: places(4)
        integer :: i, n

        places = 0
        n = 0
        do i = 1, len(text)
            if (text(i:i) /= ":" .or. n == size(places)) cycle
            n = n + 1
            places(n) = i
        end do
    end subroutine cut

    pure function examples(name) result(text)
        !! How an axis is written.
        character(*), intent(in) :: name
        character(:), allocatable :: text

        text = "'"//trim(name)//" = 0.1:3:50', '"//trim(name)//" = 0.1:10:50:log'"
    end function examples

    subroutine read_end(name, text, value, error)
        !! The first or the last value of the axis `name`.
        character(*), intent(in) :: name, text
        real(dp), intent(out) :: value
        type(error_t), allocatable, intent(out) :: error

        value = 0.0_dp
        if (text == "") then
            call fail(error, "an end is missing; write "//examples(name))
        else
            call read_constant(text, value, error)
        end if
    end subroutine read_end

    subroutine find_target(axis, name, system, error)
        !! Which number of the scene `name` is.
        type(sweep_axis_t), intent(inout) :: axis
        character(*), intent(in) :: name
        class(system_t), intent(in) :: system
        type(error_t), allocatable, intent(out) :: error
        type(description_t) :: d
        type(target_t), allocatable :: targets(:)
        character(name_length), allocatable :: names(:)
        character(:), allocatable :: short
        integer :: i

        call all_targets(system, targets)
        names = targets%name
        i = findloc(names == name, .true., 1)
        if (i == 0) then
            call system%describe(d)
            short = abbreviation(name, [character(name_length) :: d%parameters%name])
            if (component(name, names) > 0) then
                call fail(error, "a sweep cannot change "//quoted(name)//"; write '"// &
                          trim(names(component(name, names)))//"'")
                return
            end if
            if (nearest_name(name, names) == "" .and. short /= "") then
                call fail(error, "a sweep cannot change "//quoted(name)//"; did you mean '"// &
                          short//"'?")
                return
            end if
            call fail(error, "a sweep cannot change "//quoted(name)//"; "// &
                      advice(name(index(name, "%") + 1:), &
                             pack(names, index(names, "q(") /= 1 .and. index(names, "v(") /= 1), &
                             described_by(d)))
            return
        end if
        axis%name = targets(i)%name
        axis%unit = targets(i)%unit
        axis%kind = targets(i)%kind
        axis%element = targets(i)%element
    end subroutine find_target

    pure function component(name, names) result(which)
        !! Which of the names is the component that `magnetic_z` means, `magnetic(3)`; 0: none.
        character(*), intent(in) :: name, names(:)
        integer :: which
        integer :: last

        which = 0
        last = index(name, "_", back=.true.)
        if (last < 2 .or. last /= len(name) - 1) return
        which = index("xyz", name(last + 1:))
        which = findloc(names == name(:last - 1)//"("//to_text(which)//")", .true., 1)
    end function component

    subroutine all_targets(system, targets)
        !! Every number of the start and of the parameters, by all its names.
        class(system_t), intent(in) :: system
        type(target_t), allocatable, intent(out) :: targets(:)
        type(description_t) :: d
        integer :: element, i, k

        call system%describe(d)
        allocate (targets(0))
        do i = 1, size(d%coordinates)
            associate (q => d%coordinates(i))
                targets = [targets, target_t(q%name, q%unit, of_coordinate, i), &
                           target_t(trim(q%name)//"_dot", trim(q%unit)//"/s", of_velocity, i), &
                           target_t("q("//to_text(i)//")", q%unit, of_coordinate, i), &
                           target_t("v("//to_text(i)//")", trim(q%unit)//"/s", of_velocity, i)]
            end associate
        end do
        element = 0
        do i = 1, size(d%parameters)
            associate (p => d%parameters(i))
                if (p%count == 1) targets = [targets, target_t(p%name, p%unit, of_parameter, &
                                                               element + 1)]
                do k = 1, merge(p%count, 0, p%count > 1)
                    targets = [targets, target_t(trim(p%name)//"("//to_text(k)//")", p%unit, &
                                                 of_parameter, element + k)]
                end do
                element = element + p%count
            end associate
        end do
        if (size(d%coordinates) == 1) targets = [targets, &
            target_t("q", d%coordinates(1)%unit, of_coordinate, 1), &
            target_t("v", trim(d%coordinates(1)%unit)//"/s", of_velocity, 1)]
    end subroutine all_targets

    pure subroutine set(self, which, q, v, parameters)
        !! Put value number `which` in its place.
        class(sweep_axis_t), intent(in) :: self
        integer(i8), intent(in) :: which                        !! from 1 to `count`
        real(dp), intent(inout) :: q(:), v(:), parameters(:)    !! of a scene

        select case (self%kind)
        case (of_coordinate); q(self%element) = self%value(which)
        case (of_velocity); v(self%element) = self%value(which)
        case default; parameters(self%element) = self%value(which)
        end select
    end subroutine set

    elemental function is_velocity(self, number) result(yes)
        !! It changes this one.
        class(sweep_axis_t), intent(in) :: self
        integer, intent(in) :: number  !! of the velocity
        logical :: yes

        yes = self%kind == of_velocity .and. self%element == number
    end function is_velocity

    pure function changes_the_same(self, other) result(yes)
        !! The same number, perhaps by another name.
        class(sweep_axis_t), intent(in) :: self
        type(sweep_axis_t), intent(in) :: other  !! another axis
        logical :: yes

        yes = self%kind == other%kind .and. self%element == other%element
    end function changes_the_same

    elemental function is_parameter(self) result(yes)
        !! It changes the system, not only its start.
        class(sweep_axis_t), intent(in) :: self
        logical :: yes

        yes = self%kind == of_parameter
    end function is_parameter
end module lagrangia_sweep_axis
