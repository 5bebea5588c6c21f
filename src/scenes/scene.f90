module lagrangia_scene
    !! A scene as plain, validated data, and as the text that would make it again.
    use lagrangia_description, only: description_t, figure_length, name_length
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_namelist, only: namelist_t, refuse_value
    use lagrangia_text, only: in_words, to_text
    implicit none (type, external)
    private
    public :: scene_t, expectation_t, sweep_group_t
    public :: add_texts, heading, most_axes, sweep_text_length, scene_lines, scene_line_length

    integer, parameter :: scene_line_length = 600  !! what a single value may need
    integer, parameter :: sweep_text_length = 120  !! of a text of `&sweep`
    integer, parameter :: most_axes = 2            !! of a sweep
    integer, parameter :: short_line = 100         !! a list goes on in the next line
    real(dp), parameter :: no_limit = 1e300_dp     !! of what is estimated and not judged

    type :: expectation_t
        !! The scene's own tolerance: the column `name` stays within `limit`.
        character(name_length) :: name = ""
        real(dp) :: limit = 0.0_dp
        logical :: judged = .true.  !! false: measured only, in a scene that `--set` has changed
    end type expectation_t

    type :: sweep_group_t
        !! The group `&sweep`.
        character(sweep_text_length), allocatable :: over(:)     !! the axes: `'theta = 0.1:3:50'`
        character(sweep_text_length), allocatable :: keep(:)     !! of each trajectory: `'period'`
        real(dp) :: after = -huge(1.0_dp)          !! samples before don't count, s
        character(sweep_text_length) :: strobe = ""  !! period of a stroboscope, s: a formula
        character(sweep_text_length) :: section = "" !! or an event: points are kept there
        integer :: points = 100                    !! of a trajectory at most
        character(sweep_text_length) :: energy_by = ""  !! velocity that keeps all at one energy
        integer(i8) :: most_steps = huge(1_i8)     !! of a trajectory, where the method chooses them
        integer :: seed = 1                        !! of values drawn at random
        integer :: threads = 0                     !! processes; 0: as many as processors
    end type sweep_group_t

    type :: scene_t
        character(:), allocatable :: source        !! the file it was read from
        character(255) :: name = ""                !! file name without folder and ending
        character(200) :: title = ""
        character(name_length) :: system = ""
        character(name_length) :: method = "rk4"
        logical :: compensated = .false.           !! sums that keep what rounding drops
        character(255) :: output = ""              !! below the output folder
        real(dp) :: t0 = 0.0_dp, dt = 0.0_dp, duration = 0.0_dp  !! s
        integer(i8) :: every = 1
        real(dp) :: tolerance = 0.0_dp             !! above 0: the method chooses its steps,
        integer(i8) :: samples = 0                 !! and there are so many samples
        real(dp), allocatable :: q(:), v(:)        !! at `t0`
        logical, allocatable :: given(:)           !! velocities that are; absent: all of them
        real(dp), allocatable :: parameters(:)     !! in the order of the system's description
        logical, allocatable :: computed(:)        !! from others, by default; absent: none
        character(name_length), allocatable :: columns(:)
        character(200), allocatable :: plots(:)    !! panels: `'y'`, `'x:y'`, `'t:y1+y2'`
        character(120), allocatable :: events(:)   !! `'theta = 0.5 rising'`
        character(name_length), allocatable :: event_columns(:)
        character(200), allocatable :: event_plots(:)
        character(figure_length), allocatable :: figure(:)  !! parts of its own; empty: the system's
        logical :: error_estimate = .false.        !! state the error of the final state
        logical :: modes = .false.                 !! show omega of the small oscillations
        character(name_length) :: period_of = ""   !! a coordinate whose period is measured
        type(expectation_t), allocatable :: expectations(:)
        character(scene_line_length), allocatable :: formulas(:)
        !! the group `&lagrangian` of a system in formulas, line by line; else absent
        character(:), allocatable :: changes       !! by `--set`: `m1=5`; absent: none
        type(sweep_group_t) :: sweep               !! for `lagrangia sweep`
        character(:), allocatable :: warning       !! about what is there for nothing; else absent
        type(namelist_t), allocatable :: file      !! where each key stands; absent: nowhere
    contains
        procedure :: locate
    end type scene_t

contains

    pure subroutine locate(self, error)
        !! Give an error that blames a key of the scene its place: file, line, column and value.
        class(scene_t), intent(in) :: self
        type(error_t), allocatable, intent(inout) :: error  !! not allocated: nothing to do
        type(error_t), allocatable :: located

        if (.not. (allocated(error) .and. allocated(self%file))) return
        if (.not. allocated(error%key)) return
        call refuse_value(self%file, "scene", error%key, error%message, located, error%element)
        located%status = error%status
        call move_alloc(located, error)
    end subroutine locate

    pure function heading(scene) result(text)
        !! The title, or the scene's name in words where it has none.
        type(scene_t), intent(in) :: scene  !! as the reader gives it
        character(:), allocatable :: text

        text = trim(scene%title)
        if (text == "") text = in_words(scene%name)
    end function heading

    function scene_lines(scene, d) result(lines)
        !! The effective scene, all defaults filled in, as namelist text.
        type(scene_t), intent(in) :: scene  !! with its method as the file names it
        type(description_t), intent(in) :: d  !! of the scene's system
        character(scene_line_length), allocatable :: lines(:)
        integer :: i, first

        allocate (lines(0))
        call add("&scene")
        call add("  title = "//text_value(scene%title))
        call add("  system = "//text_value(scene%system))
        call add("  method = "//text_value(scene%method))
        if (scene%compensated) call add("  compensated = .true.")
        call add("  t0 = "//to_text(scene%t0))
        if (scene%tolerance > 0.0_dp) then
            call add("  tolerance = "//to_text(scene%tolerance))
            call add("  duration = "//to_text(scene%duration))
            call add("  samples = "//to_text(scene%samples))
        else
            call add("  dt = "//to_text(scene%dt))
            call add("  duration = "//to_text(scene%duration))
            call add("  every = "//to_text(scene%every))
        end if
        call add("  q = "//numbers(scene%q))
        if (allocated(scene%given)) then
            call add("  v = "//numbers(pack(scene%v, scene%given)))
        else
            call add("  v = "//numbers(scene%v))
        end if
        call add_texts(lines, "columns", scene%columns)
        call add_texts(lines, "plot", scene%plots)
        if (allocated(scene%figure)) call add_texts(lines, "figure", scene%figure)
        if (allocated(scene%events)) then
            call add_texts(lines, "event", scene%events)
            call add_texts(lines, "event_columns", scene%event_columns)
            call add_texts(lines, "event_plot", scene%event_plots)
        end if
        if (scene%error_estimate) call add("  error_estimate = .true.")
        if (scene%modes) call add("  modes = .true.")
        if (scene%period_of /= "") call add("  period_of = "//text_value(scene%period_of))
        do i = 1, size(scene%expectations)
            associate (name => scene%expectations(i)%name)
                if (scene%expectations(i)%judged) then
                    call add("  expect_"//trim(name)//" = "//to_text(scene%expectations(i)%limit))
                else if (name == "error" .and. any(scene%columns == name)) then
                    call add("  expect_error = "//to_text(no_limit))  ! the column asks for it
                end if
            end associate
        end do
        call add("  output = "//text_value(scene%output))
        call add("/")
        if (allocated(scene%formulas)) lines = [character(scene_line_length) :: lines, &
                                                scene%formulas]
        call add("&"//scene%system)
        first = 1
        do i = 1, size(d%parameters)
            associate (p => d%parameters(i))
                call add("  "//trim(p%name)//" = "// &
                         numbers(scene%parameters(first:first + p%count - 1)))
                first = first + p%count
            end associate
        end do
        call add("/")
    contains
        subroutine add(line)
            character(*), intent(in) :: line

            lines = [character(scene_line_length) :: lines, line]
        end subroutine add
    end function scene_lines

    pure subroutine add_texts(lines, key, values)
        !! Add `  columns = 't', 'theta'`, on as many lines as it takes; nothing without values.
        character(scene_line_length), allocatable, intent(inout) :: lines(:)  !! of a group
        character(*), intent(in) :: key, values(:)  !! values of at most a short line each
        character(:), allocatable :: line, item
        integer :: i

        line = "  "//key//" ="
        do i = 1, size(values)
            item = text_value(values(i))
            if (i < size(values)) item = item//","
            if (len(line) + len(item) > short_line .and. i > 1) then
                lines = [character(scene_line_length) :: lines, line]
                line = "   "
            end if
            line = line//" "//item
        end do
        if (size(values) > 0) lines = [character(scene_line_length) :: lines, line]
    end subroutine add_texts

    pure function numbers(values) result(text)
        !! `1, 2.5`.
        real(dp), intent(in) :: values(:)
        character(:), allocatable :: text
        integer :: i

        text = ""
        do i = 1, size(values)
            if (i > 1) text = text//", "
            text = text//to_text(values(i))
        end do
    end function numbers

    pure function text_value(text) result(value)
        !! Between single quotes, those within doubled.
        character(*), intent(in) :: text
        character(:), allocatable :: value
        integer :: i

        value = "'"
        do i = 1, len_trim(text)
            if (text(i:i) == "'") value = value//"'"
            value = value//text(i:i)
        end do
        value = value//"'"
    end function text_value
end module lagrangia_scene
