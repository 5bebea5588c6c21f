module lagrangia_kept
    !! What a sweep keeps of a trajectory, a number each:
    !!
    !! | text | number |
    !! |---|---|
    !! | `theta` | a column at the end |
    !! | `wrapped theta` | an angle at the end, from -pi to pi |
    !! | `max theta`, `min theta` | its largest, its smallest value among the samples |
    !! | `period`, `period x` | of the first coordinate, or that one, from its turning points |
    !! | `exact period` | by the closed form of the start |
    !! | `exact max x`, `exact min x` | of the closed form's coordinate, at the same samples |
    !! | `first theta = 0.5 rising` | the time of the first event |
    !! | `flip theta2` | the time at which the angle first goes over the top: plus or minus pi |
    !! | `lyapunov` | the largest Lyapunov exponent, from the time `after` to the end |
    !! | `lyapunov error` | its standard error |
    !! | `attractor` | the number of the attractor, by stroboscopic points; 0: none, or chaos |
    !!
    !! What does not happen, or is not known, is NaN.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_nan, ieee_quiet_nan, ieee_value
    use lagrangia_attractor, only: strobed_t
    use lagrangia_columns, only: column_names, columns_t, new_columns, refuse_work
    use lagrangia_description, only: description_t, name_length
    use lagrangia_errors, only: error_t, fail
    use lagrangia_events, only: column_event_t, new_column_event
    use lagrangia_kinds, only: dp
    use lagrangia_names, only: advice, nearest_name
    use lagrangia_observer, only: observer_t
    use lagrangia_scene, only: sweep_text_length
    use lagrangia_system, only: system_t
    use lagrangia_text, only: quoted, to_text
    implicit none (type, external)
    private
    public :: is_exact_extreme, is_lyapunov, keeper_t, kept_t, read_kept, wrapped
    public :: keeps_attractor, keeps_wrapped
    public :: keeps_end, keeps_event, keeps_flip, keeps_largest
    public :: keeps_exact_largest, keeps_exact_period
    public :: keeps_lyapunov, keeps_lyapunov_error, keeps_period, keeps_smallest

    integer, parameter :: keeps_end = 1, keeps_largest = 2, keeps_smallest = 3, keeps_period = 4
    integer, parameter :: keeps_exact_period = 5, keeps_event = 6, keeps_flip = 7
    integer, parameter :: keeps_lyapunov = 8, keeps_lyapunov_error = 9
    integer, parameter :: keeps_wrapped = 10, keeps_attractor = 11
    integer, parameter :: keeps_exact_largest = 12, keeps_exact_smallest = 13

    type :: kept_t
        !! One number of a trajectory.
        character(sweep_text_length) :: text = ""  !! as above
        character(sweep_text_length) :: label = ""  !! one word: its column in the data file
        character(16) :: unit = "1"
        integer :: kind = 0
        integer :: column = 0      !! of the columns that are evaluated
        integer :: coordinate = 0  !! whose period, flip or exact extreme it is
        integer :: events(2) = 0   !! the first of these is the time; 0: no event
    end type kept_t

    type, extends(observer_t) :: keeper_t
        !! Sees one trajectory.
        type(columns_t) :: columns
        real(dp) :: after = 0.0_dp                  !! samples before this time don't count, s
        real(dp), allocatable :: row(:)             !! the last sample
        real(dp), allocatable :: low(:), high(:)    !! of each column
        real(dp), allocatable :: met(:)             !! first time of each event, s; else NaN
        logical :: points_kept = .false.            !! of a stroboscope, or else of a section
        logical :: strobed = .false.                !! samples are points of a stroboscope
        logical :: looks_for_attractor = .false.
        real(dp), allocatable :: points(:, :)       !! (columns, most)
        integer :: found = 0                        !! points that are there
        logical :: full = .false.                   !! all that there is room for: the run has ended
        type(strobed_t) :: strobed_points           !! where an attractor is looked for
    contains
        procedure :: make_room
        procedure :: begin
        procedure :: observe
        procedure :: meet
    end type keeper_t

contains

    elemental function is_lyapunov(kind) result(yes)
        !! It is measured by a run of its own.
        integer, intent(in) :: kind  !! of a `kept_t`
        logical :: yes

        yes = kind == keeps_lyapunov .or. kind == keeps_lyapunov_error
    end function is_lyapunov

    elemental function is_exact_extreme(kind) result(yes)
        !! It is that of the closed form at the samples.
        integer, intent(in) :: kind  !! of a `kept_t`
        logical :: yes

        yes = kind == keeps_exact_largest .or. kind == keeps_exact_smallest
    end function is_exact_extreme

    subroutine read_kept(texts, system, kept, columns, events, error)
        !! What is to be kept; the columns and the events, as a scene has them, that it takes.
        character(*), intent(in) :: texts(:)               !! as above
        class(system_t), intent(in) :: system              !! with its parameters
        type(kept_t), allocatable, intent(out) :: kept(:)  !! one for each text
        type(columns_t), intent(out) :: columns            !! of the system
        character(sweep_text_length), allocatable, intent(out) :: events(:)  !! in a scene's words
        type(error_t), allocatable, intent(out) :: error   !! status 2: what cannot be read
        character(name_length), allocatable :: all_columns(:), coordinates(:), names(:)
        type(description_t) :: d
        integer :: i

        call system%describe(d)
        coordinates = d%coordinates%name
        allocate (all_columns, source=column_names(system, .false.))
        allocate (kept(size(texts)), names(0), events(0))
        do i = 1, size(texts)
            call read_one(trim(adjustl(texts(i))), kept(i))
            kept(i)%label = one_word(kept(i)%text)
            if (.not. allocated(error) .and. any(kept(:i - 1)%label == kept(i)%label)) then
                call fail(error, quoted(trim(kept(i)%text))//" is kept already")
            end if
            if (.not. allocated(error)) cycle
            error%element = i
            return
        end do
        call new_columns(columns, names, system, .false., error)
        if (allocated(error)) return
        do i = 1, size(kept)
            if (kept(i)%column > 0) kept(i)%unit = columns%items(kept(i)%column)%unit
        end do
    contains
        subroutine read_one(text, this)
            character(*), intent(in) :: text
            type(kept_t), intent(inout) :: this
            character(:), allocatable :: first, rest
            integer :: blank

            this%text = text
            blank = index(text//" ", " ")
            first = text(:blank - 1)
            rest = trim(adjustl(text(blank:)))
            if (len(text) > sweep_text_length) then
                call fail(error, "a text of at most "//to_text(sweep_text_length)// &
                          " characters is needed")
            else if (text == "") then
                call fail(error, "what is to be kept? a column, 'max COLUMN', 'min COLUMN', "// &
                          "'wrapped ANGLE', 'period', 'exact period', 'exact max "// &
                          "COORDINATE', 'first EVENT', 'flip ANGLE', 'lyapunov', 'attractor'")
            else if (text == "error" .or. &
                     rest == "error" .and. any(first == ["max", "min"])) then
                call fail(error, "a sweep measures no error; 'lagrangia run SCENE' tells that "// &
                          "of one trajectory")
            else if (any(text == ["first", "max  ", "min  "])) then
                call fail(error, "what is wanted of what? 'first "//trim(coordinates(1))// &
                          " = 0.5 rising', 'max COLUMN'")
            else if (text == "exact period") then
                this%kind = keeps_exact_period
                this%unit = "s"
            else if (index(text, "exact max ") == 1 .or. index(text, "exact min ") == 1) then
                this%kind = merge(keeps_exact_largest, keeps_exact_smallest, &
                                  index(text, "exact max ") == 1)
                call take_coordinate(trim(adjustl(rest(4:))), this%coordinate)
                if (.not. allocated(error)) this%unit = d%coordinates(this%coordinate)%unit
            else if (text == "lyapunov" .or. text == "lyapunov error") then
                this%kind = merge(keeps_lyapunov, keeps_lyapunov_error, text == "lyapunov")
                this%unit = "1/s"
            else if (text == "attractor") then
                this%kind = keeps_attractor
            else if (first == "wrapped") then
                this%kind = keeps_wrapped
                call take_angle(rest, "be wrapped", this%coordinate)
                if (.not. allocated(error)) call take_column(trim(coordinates(this%coordinate)), &
                                                             this%column)
            else if (first == "period") then
                this%kind = keeps_period
                this%unit = "s"
                call take_coordinate(rest, this%coordinate)
            else if (first == "flip") then
                this%kind = keeps_flip
                this%unit = "s"
                call take_angle(rest, "go over the top", this%coordinate)
                if (allocated(error)) return
                this%events = size(events) + [1, 2]
                rest = trim(coordinates(this%coordinate))
                call add_event(rest//" = "//to_text(acos(-1.0_dp))//" rising")
                call add_event(rest//" = -"//to_text(acos(-1.0_dp))//" falling")
            else if (first == "first") then
                this%kind = keeps_event
                this%unit = "s"
                this%events(1) = size(events) + 1
                call add_event(rest)
            else if (first == "max" .or. first == "min") then
                this%kind = merge(keeps_largest, keeps_smallest, first == "max")
                call take_column(rest, this%column)
            else
                this%kind = keeps_end
                call take_column(text, this%column)
                if (all(all_columns /= text)) call refuse_word(text)
            end if
        end subroutine read_one

        subroutine refuse_word(text)
            !! A word that is no column, but nearly one of those above, or means one of them.
            character(*), intent(in) :: text
            character(:), allocatable :: near

            near = ""
            if (nearest_name(text, all_columns) == "") near = nearest_name(text, [character(12) :: &
                "period", "exact period", "lyapunov", "attractor"])
            select case (text)
            case ("T"); near = "period"
            case ("maximum", "largest", "amplitude"); near = "max "//trim(coordinates(1))
            case ("minimum", "smallest"); near = "min "//trim(coordinates(1))
            case default
            end select
            if (any(text(:min(4, len(text))) == ["max(", "min("])) near = text(:3)//" "// &
                text(5:index(text//")", ")") - 1)
            if (near /= "") call fail(error, "what is kept is a column, or one of a few words, "// &
                                      "not "//quoted(text)//"; did you mean '"//near//"'?")
        end subroutine refuse_word

        subroutine take_column(name, which)
            !! Its place among the columns. What is none is refused, and the work, which needs more
            !! than one state.
            character(*), intent(in) :: name
            integer, intent(out) :: which
            type(columns_t) :: one
            character(name_length) :: only(1)

            only = name
            call new_columns(one, only, system, .false., error)
            call refuse_work(one, error)
            if (all(names /= name)) names = [character(name_length) :: names, name]
            which = findloc(names == name, .true., 1)
        end subroutine take_column

        subroutine take_coordinate(name, which)
            !! Number of the coordinate; the first where none is named.
            character(*), intent(in) :: name
            integer, intent(out) :: which

            which = 1
            if (name /= "") which = findloc(coordinates == name, .true., 1)
            if (which == 0) call fail(error, "a coordinate is needed, not "//quoted(name)//"; "// &
                                      advice(name, coordinates))
        end subroutine take_coordinate

        subroutine take_angle(name, what, which)
            !! A coordinate that can do `what`.
            character(*), intent(in) :: name, what
            integer, intent(out) :: which

            call take_coordinate(name, which)
            if (allocated(error)) return
            if (d%coordinates(which)%unit /= "rad") call fail(error, "only an angle can "//what// &
                ", and "//trim(coordinates(which))//" is none")
        end subroutine take_angle

        subroutine add_event(text)
            !! An event as a scene has it; what cannot be one is refused.
            character(*), intent(in) :: text
            type(column_event_t) :: event

            call new_column_event(event, text, system, error)
            events = [character(sweep_text_length) :: events, text]
        end subroutine add_event
    end subroutine read_kept

    pure function one_word(text) result(word)
        !! `max_theta` for `max theta`, `first_theta=0.5_rising`.
        character(*), intent(in) :: text
        character(sweep_text_length) :: word
        integer :: i, n

        word = ""
        n = 0
        do i = 1, len_trim(text)
            if (n == len(word)) exit
            if (text(i:i) == " ") then
                if (scan(text(i + 1:i + 1), " =") == 1 .or. text(i - 1:i - 1) == "=") cycle
            end if
            n = n + 1
            word(n:n) = text(i:i)
            if (text(i:i) == " ") word(n:n) = "_"
        end do
    end function one_word

    subroutine begin(self, columns, events, after)
        !! Before a trajectory.
        class(keeper_t), intent(inout) :: self
        type(columns_t), intent(in) :: columns  !! that are evaluated
        integer, intent(in) :: events           !! number of events that are looked for
        real(dp), intent(in) :: after           !! samples before don't count, s
        integer :: n

        n = size(columns%items)
        self%columns = columns
        self%after = after
        if (.not. allocated(self%row)) allocate (self%row(n), self%low(n), self%high(n), &
                                                 self%met(events))
        self%row = ieee_value(1.0_dp, ieee_quiet_nan)
        self%low = huge(1.0_dp)
        self%high = -huge(1.0_dp)
        self%met = ieee_value(1.0_dp, ieee_quiet_nan)
    end subroutine begin

    subroutine observe(self, system, t, q, v, error)
        !! See `observer_t`.
        class(keeper_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t, q(system%ndof), v(system%ndof)
        type(error_t), allocatable, intent(out) :: error

        if (size(self%row) > 0) call self%columns%evaluate(system, t, q, v, 0.0_dp, self%row)
        if (t < self%after) return
        self%low = min(self%low, self%row)
        self%high = max(self%high, self%row)
        if (self%points_kept .and. self%strobed) call keep_point(self, error)
        if (.not. self%looks_for_attractor) return
        if (self%strobed_points%fresh()) call self%strobed_points%begin(system)
        call self%strobed_points%see(q, v)
    end subroutine observe

    subroutine make_room(self, most)
        !! For so many points.
        class(keeper_t), intent(inout) :: self
        integer, intent(in) :: most  !! points at most

        allocate (self%points(size(self%row), most))
    end subroutine make_room

    subroutine keep_point(self, error)
        !! The latest row is one; the error ends the run when there is room for no more.
        class(keeper_t), intent(inout) :: self
        type(error_t), allocatable, intent(inout) :: error

        self%found = self%found + 1
        self%points(:, self%found) = self%row
        self%full = self%found == size(self%points, 2)
        if (self%full) call fail(error, "all points that are wanted are there")
    end subroutine keep_point

    elemental function wrapped(angle) result(angle_in_turn)
        !! The same angle from \(-\pi\) to \(\pi\).
        real(dp), intent(in) :: angle  !! rad
        real(dp) :: angle_in_turn
        real(dp), parameter :: turn = 2.0_dp*acos(-1.0_dp)

        angle_in_turn = angle - turn*anint(angle/turn)
    end function wrapped

    subroutine meet(self, system, event, t, q, v, error)
        !! See `observer_t`.
        class(keeper_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        integer, intent(in) :: event
        real(dp), intent(in) :: t, q(system%ndof), v(system%ndof)
        type(error_t), allocatable, intent(out) :: error

        if (event > size(self%met)) return
        if (ieee_is_nan(self%met(event))) self%met(event) = t
        if (.not. self%points_kept .or. self%strobed .or. t < self%after) return
        call self%columns%evaluate(system, t, q, v, 0.0_dp, self%row)
        call keep_point(self, error)
    end subroutine meet
end module lagrangia_kept
