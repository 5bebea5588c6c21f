module lagrangia_events
    !! An event is where a function of \((t, q, v)\) goes through zero; and what follows.
    !!
    !! An event is seen as a change of sign between two of eight places in a step, or as a dip
    !! beyond zero between two of them (a graze), and located on the dense output to round-off.
    !! A function that touches zero without crossing is no event, nor are two crossings between
    !! which it goes beyond zero by less than 1e-8 of its largest value, which may be the error of
    !! the motion.
    !! A zero at the very start counts by how the function leaves it: not, for where it came from
    !! is not known. Only a gap that closes at once is an impact at once.
    use lagrangia_columns, only: columns_t, new_columns, refuse_work
    use lagrangia_constant_formula, only: read_constant
    use lagrangia_description, only: description_t, line_length, name_length
    use lagrangia_errors, only: error_t, fail
    use lagrangia_kinds, only: dp
    use lagrangia_number_reader, only: letters
    use lagrangia_system, only: system_t
    use lagrangia_text, only: quoted, to_text
    implicit none (type, external)
    private
    public :: event_t, event_box_t, column_event_t, contact_event_t
    public :: new_column_event, new_contact_event

    integer, parameter :: word_length = line_length  !! no word of an event is cut

    type, abstract :: event_t
        character(line_length) :: label = ""
        character(2*line_length) :: place = ""  !! for a picture: `where theta = 0.5, rising`
        integer :: direction = 0        !! 1: rising, -1: falling, 0: any
        logical :: terminal = .false.   !! the run ends here
        logical :: one_sided = .false.  !! an impact: the function cannot become negative
    contains
        procedure(value_i), deferred :: value
        procedure :: impact => no_impact
    end type event_t

    type :: event_box_t
        !! A place for one event of any kind.
        class(event_t), allocatable :: item
    end type event_box_t

    abstract interface
        function value_i(self, system, t, q, v) result(value)
            !! The function whose zeros are looked for.
            import :: event_t, system_t, dp
            implicit none (type, external)
            class(event_t), intent(inout) :: self
            class(system_t), intent(in) :: system  !! whose motion it is
            real(dp), intent(in) :: t, q(system%ndof), v(system%ndof)
            !! s; coordinates, velocities
            real(dp) :: value
        end function value_i
    end interface

    type, extends(event_t) :: column_event_t
        !! A column reaches a level.
        type(columns_t), private :: column
        real(dp), private :: level = 0.0_dp
    contains
        procedure :: value => column_above_level
    end type column_event_t

    type, extends(event_t) :: contact_event_t
        !! A gap of the system closes.
        integer, private :: contact = 1
    contains
        procedure :: value => gap
        procedure :: impact => contact_impact
    end type contact_event_t

contains

    subroutine no_impact(self, system, t, q, v)
        !! What the event does to the state: most do nothing.
        class(event_t), intent(in) :: self
        class(system_t), intent(in) :: system  !! whose motion it is
        real(dp), intent(in) :: t  !! s
        real(dp), intent(inout) :: q(system%ndof), v(system%ndof)
        !! before the event; after it on return
    end subroutine no_impact

    subroutine new_column_event(self, text, system, error)
        !! An event as a scene has it: `NAME [= LEVEL] [rising|falling] [stop]`, where `NAME` is a
        !! column and `LEVEL` a formula of numbers: `'theta = pi/2 rising'`, `'tension stop'`.
        type(column_event_t), intent(out) :: self  !! looks for the column's level
        character(*), intent(in) :: text  !! as above, words between blanks
        class(system_t), intent(in) :: system  !! has the column
        type(error_t), allocatable, intent(out) :: error  !! not understood, or no such column
        character(word_length), allocatable :: words(:)
        character(name_length) :: name(1)
        character(:), allocatable :: level
        type(description_t) :: d
        integer :: i, count

        allocate (words(len(text) + 1))  ! as many at most, and an empty one
        call split(text, words, count)
        if (count < 1) then
            call fail(error, "an event needs a column, as in "//example(system))
            return
        end if
        self%label = text
        if (words(1) == "error" .or. index(words(1), "_drift") > 0) then
            call fail(error, "'"//trim(words(1))//"' is no function of the state alone")
            return
        end if
        name(1) = words(1)(:name_length)
        call new_columns(self%column, name, system, .false., error)
        call refuse_work(self%column, error)
        if (allocated(error)) return
        i = 2
        self%place = "where "//trim(words(1))//" = 0"
        if (words(i) == "=") then
            level = ""
            do i = 3, count
                if (any(words(i) == ["rising ", "falling", "stop   "])) exit
                if (i > 3 .and. is_word(words(i)) .and. index(words(i), "deg") /= 1) exit
                level = level//" "//trim(words(i))
            end do
            if (level == "") then
                call fail(error, "a number is needed behind '=', as in "//example(system))
                return
            end if
            call read_constant(level(2:), self%level, error)
            if (allocated(error)) then
                error%message = "behind '=' a number is needed, or a formula of numbers: "// &
                                error%message
                return
            end if
            self%place = "where "//trim(words(1))//" ="//level
        end if
        do i = i, count
            if (self%direction /= 0 .and. any(words(i) == ["rising ", "falling"])) then
                call fail(error, "rising or falling, not both: without these words an event is "// &
                          "found both ways")
                return
            end if
            select case (words(i))
            case ("rising"); self%direction = 1
            case ("falling"); self%direction = -1
            case ("stop"); self%terminal = .true.
            case default
                call fail(error, quoted(trim(words(i)))//" is none of rising, falling, stop; "// &
                          "an event looks like "//example(system))
                return
            end select
        end do
        if (self%direction > 0) self%place = trim(self%place)//", rising"
        if (self%direction < 0) self%place = trim(self%place)//", falling"
        call system%describe(d)
        i = findloc(d%quantities%name == name(1), .true., 1)
        if (i == 0) return
        if (d%quantities(i)%meaning /= "") self%place = trim(self%place)//"; "//trim(name(1))// &
            ": "//d%quantities(i)%meaning
    end subroutine new_column_event

    pure function is_word(text) result(yes)
        !! Letters that a formula of numbers cannot have: no `pi`, no function.
        character(*), intent(in) :: text
        logical :: yes

        yes = verify(text(:1), letters) == 0 .and. index(text, "pi") /= 1 .and. &
              index(text, "(") == 0
    end function is_word

    pure function example(system) result(text)
        !! What an event looks like, of its first coordinate.
        class(system_t), intent(in) :: system
        character(:), allocatable :: text
        type(description_t) :: d

        call system%describe(d)
        text = trim(d%coordinates(1)%name)
        text = "event = '"//text//" = 0.5 rising' or event = '"//text//"_dot falling stop'"
    end function example

    pure subroutine split(text, words, count)
        !! Words between blanks, and every `=` is one.
        character(*), intent(in) :: text
        character(word_length), intent(out) :: words(:)  !! as many as the text has characters
        integer, intent(out) :: count
        character(1) :: letter
        integer :: i
        logical :: within

        words = ""
        count = 0
        within = .false.
        do i = 1, len_trim(text)
            letter = text(i:i)
            if (letter == " ") then
                within = .false.
                cycle
            end if
            if (.not. within .or. letter == "=") count = count + 1
            words(count) = trim(words(count))//letter
            within = letter /= "="
        end do
    end subroutine split

    function column_above_level(self, system, t, q, v) result(value)
        !! The column less the level.
        class(column_event_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t, q(system%ndof), v(system%ndof)
        real(dp) :: value, row(1)

        call self%column%evaluate(system, t, q, v, 0.0_dp, row)
        value = row(1) - self%level
    end function column_above_level

    pure subroutine new_contact_event(self, contact)
        !! Contact number `contact` of a system.
        type(contact_event_t), intent(out) :: self  !! looks for the gap's zero
        integer, intent(in) :: contact  !! from 1 to `system%contacts`

        self%label = "impact"
        if (contact > 1) self%label = "impact "//to_text(contact)
        self%place = "at each "//self%label
        self%contact = contact
        self%direction = -1
        self%one_sided = .true.
    end subroutine new_contact_event

    function gap(self, system, t, q, v) result(value)
        !! See `system_t`.
        class(contact_event_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t, q(system%ndof), v(system%ndof)
        real(dp) :: value

        value = system%gap(self%contact, t, q, v)
    end function gap

    subroutine contact_impact(self, system, t, q, v)
        !! See `system_t`.
        class(contact_event_t), intent(in) :: self
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t
        real(dp), intent(inout) :: q(system%ndof), v(system%ndof)

        call system%impact(self%contact, t, q, v)
    end subroutine contact_impact
end module lagrangia_events
