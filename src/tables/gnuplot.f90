module lagrangia_gnuplot
    !! A gnuplot script that draws data files: panels below each other, one time axis below all of
    !! them; what is drawn to scale has a place beside, or as much height as it needs.
    !!
    !! No text of the user is ever more than a string.
    use lagrangia_errors, only: error_t, fail
    use lagrangia_gnuplot_axes, only: frame_t, number_width, tick_step
    use lagrangia_gnuplot_panel, only: add_envelopes, curves, dots, draw_panel, variable
    use lagrangia_gnuplot_script, only: begin_script, gnuplot_string, lines_t
    use lagrangia_kinds, only: dp
    use lagrangia_names, only: advice, name_length, nearest_name
    use lagrangia_plot_colour, only: colour_panels
    use lagrangia_plot_label, only: is_small
    use lagrangia_plot_panel, only: aspect, find_traces, is_space, most_curves, panel_t, &
                                    ranges_of, series_t, shape_legend, trace_t
    use lagrangia_plot_words, only: text_label
    use lagrangia_text, only: join, quoted, to_text
    use lagrangia_value_range, only: value_range_t
    implicit none (type, external)
    private
    public :: panel_t, series_t, gnuplot_script, new_panels, new_series, other_columns_t
    public :: curves, dots

    integer, parameter :: text_width = 86        !! characters of a title in its largest type
    real(dp), parameter :: usual_left = 135.0_dp !! pixels beside the axes, for labels
    real(dp), parameter :: beside_numbers = 55.0_dp  !! of the y axis, with the label
    real(dp), parameter :: letter = 12.0_dp      !! of a number
    real(dp), parameter :: right = 40.0_dp
    real(dp), parameter :: below = 76.0_dp       !! below an axis with a label
    real(dp), parameter :: gap = 22.0_dp         !! between panels on one time axis
    real(dp), parameter :: legend = 31.0_dp      !! above a panel
    real(dp), parameter :: legend_row = 22.0_dp  !! each further row of a legend
    real(dp), parameter :: column = 1000.0_dp    !! width of panels below each other
    real(dp), parameter :: narrow = 500.0_dp     !! of those that have others beside them
    real(dp), parameter :: side = 500.0_dp       !! width of those drawn to scale, beside them
    real(dp), parameter :: wide = 0.45_dp        !! aspect of what is drawn across the picture
    real(dp), parameter :: tallest = 760.0_dp    !! pixels of one panel

    type :: other_columns_t
        !! Columns that a scene does not have, but may have.
        character(name_length), allocatable :: names(:)  !! with those that it has, or without them
        character(:), allocatable :: key                 !! of the scene, which adds them
        character(:), allocatable :: shown_by            !! a command that shows all
    end type other_columns_t

contains

    subroutine new_panels(specs, names, units, panels, error, others)
        !! Panels as a scene's `plot` wants them: `'theta'`, `'x:y'`, `'t:theta1+theta2'`; with no
        !! specs, one panel for each unit over the first column, drifts and errors apart.
        character(*), intent(in) :: specs(:), names(:), units(:)  !! `x:y1+y2`; of the columns
        type(panel_t), allocatable, intent(out) :: panels(:)  !! one a spec
        type(error_t), allocatable, intent(out) :: error  !! allocated where it fails
        type(other_columns_t), intent(in), optional :: others  !! for the message
        integer :: i, k

        allocate (panels(0))
        do i = 1, size(specs)
            panels = [panels, panel_t()]
            call read_panel(trim(specs(i)), names, panels(i), error, others)
            if (allocated(error)) then
                error%key = "plot"
                error%element = i
                return
            end if
        end do
        if (size(specs) > 0) return
        do i = 2, size(names)
            do k = 1, size(panels)
                if (panels(k)%curves == most_curves) cycle
                if (units(panels(k)%y(1)) == units(i) .and. &
                    (is_small(names(panels(k)%y(1))) .eqv. is_small(names(i)))) exit
            end do
            if (k > size(panels)) panels = [panels, panel_t()]
            panels(k)%curves = panels(k)%curves + 1
            panels(k)%y(panels(k)%curves) = i
        end do
    end subroutine new_panels

    subroutine read_panel(spec, names, panel, error, others)
        !! `[X:]Y1[+Y2...]`, all of them names of columns.
        character(*), intent(in) :: spec, names(:)
        type(panel_t), intent(inout) :: panel
        type(error_t), allocatable, intent(out) :: error
        type(other_columns_t), intent(in), optional :: others
        integer :: first, last

        first = index(spec, ":") + 1
        if (first > 1) call find(spec(:first - 2), panel%x)
        do while (.not. allocated(error))
            last = index(spec(first:), "+") + first - 2
            if (last < first - 1) last = len(spec)
            if (panel%curves == most_curves) then
                call fail(error, "more than "//to_text(most_curves)//" curves in one panel")
                return
            end if
            panel%curves = panel%curves + 1
            call find(spec(first:last), panel%y(panel%curves))
            first = last + 2
            if (last >= len(spec)) exit
        end do
    contains
        subroutine find(name, column)
            character(*), intent(in) :: name
            integer, intent(out) :: column
            character(:), allocatable :: near

            do column = 1, size(names)
                if (names(column) == name) return
            end do
            near = advice(name, names)
            if (present(others)) near = advice_with(others, name, names)
            call fail(error, quoted(name)//" is none of this scene's columns; "//near)
        end subroutine find
    end subroutine read_panel

    pure function advice_with(others, name, names) result(text)
        !! The nearest name of a column that there is or may be, or how to see them all.
        type(other_columns_t), intent(in) :: others
        character(*), intent(in) :: name, names(:)
        character(:), allocatable :: text
        character(name_length) :: all(size(names) + size(others%names))
        integer, parameter :: most = 80  !! bytes of names

        all(:size(names)) = names
        all(size(names) + 1:) = others%names
        text = nearest_name(name, all)
        if (any(others%names == name)) then
            text = "'"//others%key//"' adds it"
        else if (any(names == text) .and. text /= "") then
            text = "did you mean '"//text//"'?"
        else if (text /= "") then
            text = "did you mean '"//text//"', which '"//others%key//"' adds?"
        else
            text = join(names, ", ")
            if (len(text) > most) text = text(:index(text(:most), ", ", back=.true.))//" ..."
            text = "there are "//text//"; '"//others%key//"' adds others, '"//others%shown_by// &
                   "' has all"
        end if
    end function advice_with

    pure subroutine new_series(series, file, reading, names, units, ranges, name)
        !! A data file as a picture needs it.
        type(series_t), intent(out) :: series  !! with all that
        character(*), intent(in) :: file     !! beside the script, or below
        character(*), intent(in) :: reading  !! how gnuplot reads it: words behind the file name
        character(*), intent(in) :: names(:), units(:)  !! of its columns
        type(value_range_t), intent(in) :: ranges(:)    !! of at least those columns
        character(*), intent(in), optional :: name      !! in a legend; default: the file's name
        integer :: i

        series%file = file
        series%reading = reading
        series%name = file
        if (present(name)) series%name = name
        allocate (series%names(size(names)), series%units(size(names)))
        series%names(:) = names
        series%units(:) = units
        allocate (series%ranges(size(names)))
        series%ranges(:) = ranges(:size(names))
        do i = 1, size(names)  ! an axis without any number has room about zero
            if (ranges(i)%count == 0 .and. ranges(i)%gaps > 0) call series%ranges(i)%see(0.0_dp)
        end do
    end subroutine new_series

    function gnuplot_script(file, series, title, remark, panels, style) result(text)
        !! The script beside `file`; its pictures are `NAME.png`, ...
        character(*), intent(in) :: file        !! a bare name
        type(series_t), intent(in) :: series(:)  !! data files; the first has all columns
        character(*), intent(in) :: title       !! of the picture
        character(*), intent(in) :: remark      !! a line below it, or ""
        type(panel_t), intent(in) :: panels(:)  !! from `new_panels`, of the first data file
        character(*), intent(in), optional :: style  !! `curves`, which is the default, or `dots`
        character(:), allocatable :: text, how
        type(frame_t) :: frames(size(panels))
        type(lines_t) :: script
        type(panel_t) :: coloured(size(panels))
        integer :: height, i, width

        coloured(:) = panels
        call colour_panels(coloured, series(1)%names)
        how = curves
        if (present(style)) how = style
        call lay_out(series, panels, merge(82.0_dp, 50.0_dp, remark /= ""), frames, width, height)
        text = series(1)%file
        do i = 2, size(series)
            text = text//", "//series(i)%file
        end do
        if (size(series) > 1) then
            call begin_script(script, file, width, height, 30*size(panels), drawn=text)
        else
            call begin_script(script, text, width, height, 30*size(panels))
        end if
        call script%add("data = folder."//gnuplot_string(series(1)%file))
        do i = 2, size(series)
            call script%add(variable(i)//" = folder."//gnuplot_string(series(i)%file))
        end do
        if (index(series(1)%reading, "skip") == 1) call script%add("set datafile separator comma")
        call script%add("set grid lc rgb '#cccccc' lw 0.8 lt 1; set border lw 1.2; "// &
                        "set tics font ',14'")
        do i = 1, size(panels)
            if (how == curves) call add_envelopes(script, series, panels(i), i, &
                                                frames(i)%right - frames(i)%left)
        end do
        call script%add("set multiplot")
        call script%add("set label 1 "//text_label(trim(title))//" at screen 0.5, "// &
                        "screen "//part_of(height - 24, height)//" center font ',"// &
                        to_text(max(7, min(16, 16*text_width*width/1000/ &
                                           max(1, len_trim(title)))))//"'")
        if (remark /= "") call script%add("set label 2 "//text_label(trim(remark))// &
            " at screen 0.5, screen "//part_of(height - 52, height)//" center font ',14'")
        do i = 1, size(panels)
            call draw_panel(script, series, coloured(i), i, frames(i), width, height, how)
            if (i == 1) call script%add("unset label")
        end do
        call script%add("unset multiplot")
        text = script%text
    end function gnuplot_script

    pure function part_of(part, whole) result(text)
        !! Three digits behind the point.
        integer, intent(in) :: part, whole
        character(:), allocatable :: text
        character(8) :: digits

        write (digits, "(ss, f6.4)") real(part, dp)/whole
        text = trim(digits)
    end function part_of

    pure subroutine lay_out(series, panels, top, frames, width, height)
        !! The place of each panel and the size of the whole.
        type(series_t), intent(in) :: series(:)
        type(panel_t), intent(in) :: panels(:)
        real(dp), intent(in) :: top  !! for the title
        type(frame_t), intent(out) :: frames(size(panels))
        integer, intent(out) :: width, height
        logical :: beside(size(panels))
        real(dp) :: bodies(size(panels)), edge, left, more, y(2)
        integer :: i, k, plain

        left = usual_left
        do i = 1, size(panels)
            left = max(left, beside_numbers + letter*widest_number(series, panels(i)))
        end do

        beside = .false.
        do i = 1, size(panels)
            if (is_space(series, panels(i))) beside(i) = aspect(series, panels(i)) > wide
        end do
        if (all(beside)) beside = .false.
        plain = count(.not. beside)
        edge = 0.0_dp
        if (any(beside)) edge = side
        width = nint(merge(edge + narrow, column, any(beside)))
        if (plain == size(panels)) then
            do i = 1, size(panels)
                if (is_space(series, panels(i)) .and. aspect(series, panels(i)) > 1.0_dp) then
                    width = 800
                end if
            end do
        end if
        do i = 1, size(panels)
            bodies(i) = 200.0_dp
            if (plain == 2) bodies(i) = 260.0_dp
            if (plain == 1) bodies(i) = 430.0_dp
            if (any(beside)) bodies(i) = merge(170.0_dp, 200.0_dp, plain > 2)
            more = merge(side, width - edge, beside(i)) - left - right
            if (is_space(series, panels(i))) bodies(i) = min(tallest, max(130.0_dp, 1.12_dp* &
                more*aspect(series, panels(i))))
            frames(i)%below = beside(i) .or. i == size(panels)
            do k = i + 1, size(panels)
                if (beside(k)) cycle
                if (.not. beside(i)) frames(i)%below = panels(k)%x /= panels(i)%x
                exit
            end do
            if (k > size(panels)) frames(i)%below = .true.
        end do
        ! What is beside and what is not end at the same height, as far as there is something to
        ! be seen in it: drawn to scale, a panel three times as tall is mostly empty.
        y = 0.0_dp
        do i = 1, size(panels)
            k = merge(1, 2, beside(i))
            y(k) = y(k) + bodies(i) + around(i)
        end do
        if (any(beside)) then
            more = y(1) - y(2)
            do i = 1, size(panels)
                if (more > 0.0_dp .and. .not. beside(i)) bodies(i) = bodies(i) + more/plain
                if (more < 0.0_dp .and. beside(i)) bodies(i) = min(3.0_dp*bodies(i), bodies(i) - &
                                                                  more/(size(panels) - plain))
            end do
        end if
        height = nint(top + maxval(y))
        y = height - top
        do i = 1, size(panels)
            k = merge(1, 2, beside(i))
            y(k) = y(k) - legend_height(i)
            frames(i)%left = merge(0.0_dp, edge, beside(i)) + left
            frames(i)%right = merge(side, real(width, dp), beside(i)) - right
            frames(i)%top = y(k)
            frames(i)%bottom = y(k) - bodies(i)
            y(k) = frames(i)%bottom - merge(below, gap, frames(i)%below)
        end do
    contains
        pure function around(which) result(pixels)
            !! A legend above, labels below.
            integer, intent(in) :: which
            real(dp) :: pixels

            pixels = merge(below, gap, frames(which)%below) + legend_height(which)
        end function around

        pure function legend_height(which) result(pixels)
            !! Of all its rows; nothing where there is none.
            integer, intent(in) :: which
            real(dp) :: pixels
            integer :: columns, rows

            call shape_legend(series, panels(which), which, &
                              merge(side, width - edge, beside(which)) - left - right, &
                              columns, rows)
            pixels = legend*min(rows, 1) + legend_row*max(rows - 1, 0)
        end function legend_height
    end subroutine lay_out

    pure function widest_number(series, panel) result(letters)
        !! Beside the y axis of a panel; none of a logarithmic one.
        type(series_t), intent(in) :: series(:)
        type(panel_t), intent(in) :: panel
        integer :: letters
        type(trace_t), allocatable :: traces(:)
        type(value_range_t), allocatable :: x(:), y(:)
        real(dp) :: high, low, step

        letters = 0
        if (all(is_small(series(1)%names(panel%y(:panel%curves))))) return
        call find_traces(series, panel, traces)
        call ranges_of(series, traces, x, y)
        low = minval(y%low)
        high = maxval(y%high)
        step = 0.1_dp*max(abs(low), abs(high))
        if (high > low) step = max(tick_step(0.5_dp*(high - low)), 1e-5_dp*step)
        letters = max(number_width(low, step), number_width(high, step))
    end function widest_number
end module lagrangia_gnuplot
