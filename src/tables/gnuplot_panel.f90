module lagrangia_gnuplot_panel
    !! One panel of a picture, and the envelopes of its curves, as lines of a gnuplot script.
    use lagrangia_gnuplot_axes, only: add_across, add_decades, add_equal_scale, add_labels, &
                                      add_margins, add_range, frame_t
    use lagrangia_gnuplot_script, only: lines_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_plot_colour, only: colours
    use lagrangia_plot_label, only: is_small, label
    use lagrangia_plot_panel, only: alike, find_traces, has_envelope, has_legend, is_dense, &
                                    is_space, panel_t, ranges_of, series_t, shape_legend, &
                                    told_apart, trace_t
    use lagrangia_plot_words, only: text_label
    use lagrangia_text, only: to_text
    use lagrangia_value_range, only: value_range_t
    implicit none (type, external)
    private
    public :: add_envelopes, draw_panel, variable
    public :: curves, dots

    character(*), parameter :: curves = "lines"
    character(*), parameter :: dots = "points pt 7 ps 1"

    integer, parameter :: most_bins = 200    !! of an envelope
    integer, parameter :: most_widths = 5    !! of curves that may lie on each other
    character(3), parameter :: minus = char(226)//char(136)//char(146)

contains

    subroutine draw_panel(script, series, panel, number, frame, width, height, style)
        !! All lines of one panel.
        type(lines_t), intent(inout) :: script  !! gets the lines
        type(series_t), intent(in) :: series(:)  !! data files; the first has all columns
        type(panel_t), intent(in) :: panel  !! of columns of the first data file
        integer, intent(in) :: number  !! of the panel
        type(frame_t), intent(in) :: frame  !! the panel's place
        integer, intent(in) :: width, height  !! of the picture, pixels
        character(*), intent(in) :: style  !! `curves` or `dots`
        type(trace_t), allocatable :: traces(:)
        type(value_range_t), allocatable :: x(:), y(:)
        integer :: columns, edge, first, rows
        logical :: logarithmic, turned

        call find_traces(series, panel, traces)
        call ranges_of(series, traces, x, y)
        call add_margins(script, frame, width, height)
        call script%add("unset logscale; set autoscale xy; set size noratio; "// &
                        "set xtics autofreq; set ytics autofreq; set format y '%g'")
        turned = turns_over(series(1), panel, x)
        if (style == curves .and. .not. turned .and. .not. is_space(series, panel)) then
            call add_across(script, x, frame)
        end if
        if (style /= curves) call script%add("set offsets graph 0.03, 0.03, 0.05, 0.05")
        logarithmic = all(is_small(series(1)%names(panel%y(:panel%curves))))
        first = 0
        edge = 0
        if (logarithmic) then
            call add_decades(script, y, first, edge)
        else if (is_space(series, panel)) then
            call add_equal_scale(script, x, y, frame)
        else
            call add_range(script, y, frame)
        end if
        if (turned) call add_turn(script)
        call add_labels(script, series(1), panel, x, frame, logarithmic)
        call shape_legend(series, panel, number, frame%right - frame%left, columns, rows)
        call add_legend(script, columns, frame)
        call add_curves(script, series, panel, traces, number, style, logarithmic, first, edge, &
                        turned, frame%right - frame%left)
    end subroutine draw_panel

    pure subroutine add_legend(script, columns, frame)
        !! Above the panel, clear of its curves and of the title.
        type(lines_t), intent(inout) :: script  !! gets the lines
        integer, intent(in) :: columns          !! of the legend; 0 if there is none
        type(frame_t), intent(in) :: frame      !! the panel's place
        real(dp), parameter :: above = 7.0_dp   !! pixels, for what is below a letter
        character(8) :: place

        if (columns > 0) then
            write (place, "(ss, f6.4)") 1.0_dp + above/(frame%top - frame%bottom)
            call script%add("set key at graph 1, graph "//trim(place)// &
                            " right bottom horizontal Left reverse samplen 2 "// &
                            "font ',14' maxcols "//to_text(columns))
        else
            call script%add("unset key")
        end if
    end subroutine add_legend

    subroutine add_curves(script, series, panel, traces, number, style, logarithmic, first, &
                          edge, turned, pixels)
        !! The command that draws. An envelope is a band with its edges, of magnitudes the upper
        !! one. Where curves of several files lie on each other all are seen: the first is widest.
        !! Thin lines are wide in the legend; what stands still is a point.
        type(lines_t), intent(inout) :: script  !! gets the lines
        type(series_t), intent(in) :: series(:)  !! data files
        type(panel_t), intent(in) :: panel  !! of columns of the first data file
        type(trace_t), intent(in) :: traces(:)  !! its curves
        integer, intent(in) :: number
        character(*), intent(in) :: style
        logical, intent(in) :: logarithmic  !! is the y axis
        integer, intent(in) :: first, edge
        logical, intent(in) :: turned  !! an angle is shown within one turn
        real(dp), intent(in) :: pixels  !! of the panel's width
        type(value_range_t), allocatable :: x(:), y(:)
        logical :: dense, nested
        character(:), allocatable :: across, band, colour, line, line_of, title, using, &
                                     width
        integer :: i, k

        call ranges_of(series, traces, x, y)
        nested = panel%nested
        if (size(series) > 1 .and. panel%x == 1 .and. .not. logarithmic) nested = alike(x, y)
        line = ""
        do i = 1, size(traces)
            associate (trace => traces(i), from => series(traces(i)%series))
                k = i
                if (size(series) == 1) k = panel%colour(i)
                if (size(series) > 1 .and. panel%curves == 1) k = trace%series
                colour = " lc rgb '"//colours(modulo(k - 1, size(colours)) + 1)//"'"
                width = " lw 2"
                if (nested) then
                    width = " lw "//to_text(2 + 3*max(0, min(size(traces), most_widths) - i))
                end if
                dense = is_dense(from, trace, pixels)
                if (dense) width = " lw 0.4"
                title = curve_title(series, panel, trace, number, logarithmic)
                if (has_envelope(from, trace, pixels) .and. style == curves) then
                    band = id(number, i)
                    using = " using (middle"//band//"($1)):(low"//band//"[int($1)])"
                    call add("low"//band//using//":(high"//band//"[int($1)]) with filledcurves"// &
                             colour//" fs transparent solid 0.25 noborder notitle")
                    if (.not. logarithmic) call add("low"//band//using//" with lines lw 1.5"// &
                                                    colour//" notitle")
                    using = " using (middle"//band//"($1)):(high"//band//"[int($1)])"
                    call add("high"//band//using//" with lines lw 1.5"//colour//title)
                    cycle
                end if
                using = to_text(trace%y)
                if (logarithmic) using = magnitude("$"//using, first, edge)
                if (style == dots) width = ""
                across = to_text(trace%x)
                if (turned) across = "(angle = within($"//across//"), jump = abs(angle - last) "// &
                    "> pi, last = angle, jump ? NaN : angle)"
                line_of = variable(trace%series)//" "//from%reading//"using "//across//":"//using
                if (style == curves .and. .not. x(i)%high > x(i)%low) then
                    call add(line_of//" with "//dots//colour//title)
                else if (dense .and. style == curves .and. index(title, " notitle") /= 1) then
                    call add(line_of//" with "//style//width//colour//" notitle")
                    call add("NaN with "//style//" lw 2"//colour//title)
                else
                    call add(line_of//" with "//style//width//colour//title)
                end if
            end associate
        end do
        call script%add("plot "//line)
    contains
        subroutine add(curve)
            character(*), intent(in) :: curve

            if (line /= "") line = line//", \"//new_line("a")//"     "
            line = line//curve
        end subroutine add
    end subroutine add_curves

    pure function curve_title(series, panel, trace, number, logarithmic) result(text)
        !! What the legend calls a curve: its column, or its file, or both.
        type(series_t), intent(in) :: series(:)  !! data files
        type(panel_t), intent(in) :: panel  !! of columns of the first data file
        type(trace_t), intent(in) :: trace  !! one of its curves
        integer, intent(in) :: number
        logical, intent(in) :: logarithmic  !! is the y axis
        character(:), allocatable :: text
        character(:), allocatable :: name, unit
        integer :: last

        associate (from => series(trace%series))
            name = trim(from%names(trace%y))
            unit = trim(from%units(trace%y))
            if (all(from%units(trace%y) == series(1)%units(panel%y(:panel%curves)))) unit = "1"
            last = len(name) - len("_drift")
            if (logarithmic .and. last > 0) then
                if (name(last + 1:) == "_drift") name = name(:last)
            end if
            if (.not. has_legend(series, panel, number)) then
                text = " notitle"
            else if (size(series) == 1) then
                text = " title "//label(name, unit)
            else if (panel%curves == 1) then
                text = " title "//text_label(from%name)
            else
                text = " title "//text_label(from%name//": "//name)
            end if
        end associate
    end function curve_title

    pure function magnitude(value, first, edge) result(expression)
        !! Of a value, on a logarithmic axis.
        character(*), intent(in) :: value
        integer, intent(in) :: first, edge
        character(:), allocatable :: expression

        expression = "(abs("//value//"))"
        if (edge < first) expression = "(abs("//value//") < 1e"//to_text(first)//" ? 1e"// &
            to_text(edge)//" : abs("//value//"))"
    end function magnitude

    pure function turns_over(series, panel, x) result(yes)
        !! Something over an angle that goes further than once round.
        type(series_t), intent(in) :: series
        type(panel_t), intent(in) :: panel
        type(value_range_t), intent(in) :: x(:)
        logical :: yes

        yes = panel%x > 1 .and. series%units(panel%x) == "rad" .and. &
              maxval(x%high) - minval(x%low) > 2.0_dp*acos(-1.0_dp)*(1.0_dp + told_apart)
    end function turns_over

    pure subroutine add_turn(script)
        !! Angles between -pi and pi; a curve is cut where it leaves at one side.
        type(lines_t), intent(inout) :: script
        character(2), parameter :: letter = char(207)//char(128)

        call script%add("within(x) = x - 2*pi*floor((x + pi)/(2*pi)); last = 0")
        call script%add("set xrange [-pi:pi]; set xtics ("""//minus//letter//""" -pi, """// &
                        minus//letter//"/2"" -pi/2, ""0"" 0, """//letter//"/2"" pi/2, """// &
                        letter//""" pi)")
    end subroutine add_turn

    subroutine add_envelopes(script, series, panel, number, pixels)
        !! For each curve of a panel that needs it, before anything is drawn: the least and the
        !! largest value in each of many equal parts of the time, as arrays of gnuplot.
        type(lines_t), intent(inout) :: script  !! gets the lines
        type(series_t), intent(in) :: series(:)  !! data files; the first has all columns
        type(panel_t), intent(in) :: panel  !! of columns of the first data file
        integer, intent(in) :: number  !! of the panel
        real(dp), intent(in) :: pixels  !! of its width
        type(trace_t), allocatable :: traces(:)
        type(value_range_t), allocatable :: x(:), y(:)
        character(:), allocatable :: band, count, value
        type(lines_t) :: ignored
        integer :: edge, first, i

        call find_traces(series, panel, traces)
        call ranges_of(series, traces, x, y)
        ignored%text = ""
        call add_decades(ignored, y, first, edge)
        do i = 1, size(traces)
            associate (trace => traces(i), from => series(traces(i)%series))
                if (.not. has_envelope(from, trace, pixels)) cycle
                band = id(number, i)
                count = to_text(int(min(int(most_bins, i8), y(i)%count/10_i8)))
                value = "$"//to_text(trace%y)
                if (all(is_small(series(1)%names(panel%y(:panel%curves))))) then
                    value = magnitude(value, first, edge)
                end if
                call script%add("# Column "//to_text(trace%y)//" turns round "// &
                                to_text(y(i)%turns)//" times: "// &
                                "its envelope, in "//count//" parts.")
                call script%add("array low"//band//"["//count//"]; array high"//band//"["// &
                                count//"]")
                call script%add("do for [i=1:"//count//"] { low"//band//"[i] = NaN; high"// &
                                band//"[i] = NaN }")
                call script%add("start"//band//" = "//to_text(x(i)%low)//"; part"//band//" = ("// &
                                to_text(x(i)%high)//" - start"//band//")/"//count)
                call script%add("middle"//band//"(i) = start"//band//" + (i - 0.5)*part"//band)
                call script%add("stats "//variable(trace%series)//" "//from%reading// &
                                "using (v = "//value//", i = int(($"//to_text(trace%x)// &
                                " - start"//band//")/part"//band//") + 1, i = i > "//count// &
                                " ? "//count//" : i, low"//band//"[i] = v >= low"//band// &
                                "[i] ? low"//band//"[i] : v, high"//band//"[i] = v <= high"// &
                                band//"[i] ? high"//band//"[i] : v, 0) nooutput")
            end associate
        end do
    end subroutine add_envelopes

    pure function id(number, i) result(text)
        !! Behind the names of what belongs to one curve of one panel.
        integer, intent(in) :: number, i
        character(:), allocatable :: text

        text = to_text(number)//"_"//to_text(i)
    end function id

    pure function variable(number) result(name)
        !! The path of a data file in the script: `data`, `data2`, ...
        integer, intent(in) :: number  !! of the file, from 1
        character(:), allocatable :: name

        name = "data"
        if (number > 1) name = name//to_text(number)
    end function variable
end module lagrangia_gnuplot_panel
