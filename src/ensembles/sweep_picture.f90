module lagrangia_sweep_picture
    !! The gnuplot script of a sweep: curves over one axis, a map over two, points of a stroboscope
    !! or a section as a diagram.
    use lagrangia_description, only: description_t
    use lagrangia_gnuplot_axes, only: add_spread, add_ticks
    use lagrangia_gnuplot_script, only: begin_script, gnuplot_string, lines_t
    use lagrangia_kept, only: keeps_attractor, keeps_wrapped, kept_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_plot_colour, only: line_colours => colours
    use lagrangia_plot_label, only: label, width_of
    use lagrangia_plot_words, only: plain_label, text_label, with_symbols
    use lagrangia_sweep, only: sweep_t
    use lagrangia_sweep_axis, only: sweep_axis_t
    use lagrangia_sweep_grid, only: sweep_result_t
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: sweep_script

    integer, parameter :: few = 60        !! points of a curve that are marked
    integer, parameter :: sparse = 20000  !! points of a diagram that may be larger
    character(*), parameter :: colours = "set palette defined (0 '#440154', "// &
        "0.25 '#3b528b', 0.5 '#21908c', 0.75 '#5dc863', 1 '#fde725')"
    !! None of these is too light for a point on white.
    character(*), parameter :: dark_colours = "set palette defined (0 '#0d0887', "// &
        "0.33 '#7e03a8', 0.67 '#cc4778', 1 '#f89540')"
    character(7), parameter :: distinct(*) = ["#fde725", "#3b528b", "#5dc863", "#d8576b", &
        "#21908c", "#f89540", "#7e03a8", "#a5dbf2", "#b4de2c", "#8c564b", "#e377c2", "#7f7f7f"]

contains

    function sweep_script(sweep, found, file, reading) result(text)
        !! What draws `file`, a bare name beside the script: a panel for each number that is kept.
        type(sweep_t), intent(in) :: sweep         !! that has been computed
        type(sweep_result_t), intent(in) :: found  !! what came out
        character(*), intent(in) :: file, reading  !! its words for gnuplot, behind the name
        character(:), allocatable :: text
        type(lines_t) :: script
        integer :: groups(size(sweep%kept)), i, k, n
        logical :: long

        groups = panels(sweep)
        n = maxval(groups)
        if (sweep%keeps_points) n = 1
        if (size(sweep%axes) == 2 .or. sweep%keeps_points) then
            call begin_script(script, file, 900, 60 + 760*n, 40*n)
        else
            call begin_script(script, file, 1000, 60 + merge(560, 340, n == 1)*n, 30*n)
        end if
        call script%add("data = folder."//gnuplot_string(file))
        if (index(reading, "skip") == 1) call script%add("set datafile separator comma")
        call script%add("set multiplot layout "//to_text(n)//",1 title "// &
                        text_label(trim(sweep%scene%title)))
        call script%add("set tics out nomirror; unset key")
        do i = 1, n
            call add_ticks(script, "x", sweep%axes(1)%value(sweep%axes(1)%lowest()), &
                           sweep%axes(1)%value(sweep%axes(1)%highest()), long)
            call script%add("set rmargin "//trim(merge("8 ", "-1", long)))
            if (sweep%keeps_points) then
                call add_points(sweep, found, reading, script)
            else if (size(sweep%axes) == 2) then
                call add_map(sweep, found, i, reading, script)
            else
                call add_curves(sweep, found, pack([(k, k=1, size(groups))], groups == i), &
                                reading, script)
            end if
        end do
        call script%add("unset multiplot")
        text = script%text
    end function sweep_script

    pure function panels(sweep) result(groups)
        !! The panel of each number that is kept: curves of one unit share one, a map has its own.
        type(sweep_t), intent(in) :: sweep
        integer :: groups(size(sweep%kept))
        integer :: i, k

        do i = 1, size(groups)
            do k = 1, i - 1
                if (size(sweep%axes) == 1 .and. sweep%kept(k)%unit == sweep%kept(i)%unit) exit
            end do
            groups(i) = maxval([0, groups(:i - 1)]) + 1
            if (k < i) groups(i) = groups(k)
        end do
    end function panels

    subroutine add_points(sweep, found, reading, script)
        !! Points of a stroboscope or a section: the first two numbers against each other, in the
        !! colour of their trajectory; or the only one over the first axis.
        type(sweep_t), intent(in) :: sweep
        type(sweep_result_t), intent(in) :: found
        character(*), intent(in) :: reading
        type(lines_t), intent(inout) :: script
        character(:), allocatable :: colour, size_of_all, using
        integer(i8) :: count
        integer :: n
        real(dp) :: high, low

        n = size(sweep%axes)
        associate (axis => sweep%axes(1), kept => sweep%kept)
            call script%add(dark_colours)
            call found%range_of(1, count, low, high)
            size_of_all = "0.15"
            if (count <= sparse) size_of_all = "0.3"
            if (count <= few) size_of_all = "1"
            colour = "palette"
            if (axis%count == 1 .or. size(kept) == 1) colour = "lc rgb '#3b528b'"
            if (size(kept) > 1) then
                call script%add("set xlabel "//kept_label(kept(1)))
                call script%add("set ylabel "//kept_label(kept(2)))
                using = to_text(n + 1)//":"//to_text(n + 2)//":1"
                call script%add("set cblabel "//start_label(axis)//" offset 1")
            else
                if (axis%logarithmic) call script%add("set logscale x")
                call script%add("set xlabel "//axis_label(axis, sweep%kept))
                call script%add("set ylabel "//kept_label(kept(1)))
                using = "1:"//to_text(n + 1)
            end if
            call script%add("plot data "//reading//"using "//using// &
                            " with points pt 7 ps "//size_of_all//" "//colour)
        end associate
    end subroutine add_points

    pure function start_label(axis) result(text)
        !! Of the colours of points: where their motions began.
        type(sweep_axis_t), intent(in) :: axis
        character(:), allocatable :: text

        text = label(axis%name, axis%unit)
        text = """start: "//text(2:)
    end function start_label

    pure function axis_label(axis, kept) result(text)
        !! Of an axis: where a number of its name is kept, too, it says that it is the start's.
        type(sweep_axis_t), intent(in) :: axis
        type(kept_t), intent(in) :: kept(:)
        character(:), allocatable :: text
        integer :: i

        text = label(axis%name, axis%unit)
        do i = 1, size(kept)
            if (kept_label(kept(i)) /= label(axis%name, axis%unit)) cycle
            text = start_label(axis)
            return
        end do
    end function axis_label

    pure function kept_label(kept) result(text)
        !! Of an axis: a wrapped angle has the letter of the angle.
        type(kept_t), intent(in) :: kept
        character(:), allocatable :: text

        text = label(kept%text, kept%unit)
        if (kept%kind == keeps_wrapped) text = label(kept%text(index(kept%text, " ") + 1:), &
                                                     kept%unit)
    end function kept_label

    pure function attractor_colours(least, largest) result(line)
        !! A colour for each attractor; black is that of none, 0.
        integer, intent(in) :: least, largest  !! of their numbers, 0 <= least <= largest
        character(:), allocatable :: line
        character(7) :: colour
        integer :: i

        line = "set palette maxcolors "//to_text(max(2, largest - least + 1))//" defined ("
        do i = least, max(least + 1, largest)  ! gnuplot wants two
            colour = "#000000"
            if (min(i, largest) > 0) colour = distinct(min(i, largest))
            if (i > least) line = line//", "
            line = line//to_text(i)//" '"//colour//"'"
        end do
        line = line//"); set cbrange ["//to_text(least - 0.5_dp)//":"// &
               to_text(largest + 0.5_dp)//"]; set cbtics 1"
    end function attractor_colours

    function attractor_places(sweep, found, least, largest) result(line)
        !! Where each attractor is, along its colour, if there is room; else its number alone.
        !! gnuplot does not turn the tics of colours.
        type(sweep_t), intent(in) :: sweep
        type(sweep_result_t), intent(in) :: found
        integer, intent(in) :: least, largest  !! of their numbers, 0 <= least <= largest
        character(:), allocatable :: line
        integer, parameter :: room = 80        !! characters beside the whole column of colours
        character(:), allocatable :: place, text
        type(description_t) :: d
        logical :: plain
        integer :: i

        call sweep%system%describe(d)
        line = ""
        do i = least, largest
            place = "0 not settled"
            if (i > 0) place = to_text(i)//" "//found%attractors%place_of(i, d)
            text = with_symbols(place)
            plain = i == 0 .or. text == ""  ! a word, without any symbol
            if (plain) text = place
            if (width_of(text)*(largest - least + 1) > room) then
                line = ""
                return
            end if
            line = line//"; set label "//gnuplot_string(text)//" at graph 1.13,"//to_text( &
                   (i - least + 0.5_dp)/(largest - least + 1))//" center rotate by 90"// &
                   trim(merge(" noenhanced", "           ", plain .and. i > 0))
        end do
        line = "unset cbtics"//line
    end function attractor_places

    subroutine add_curves(sweep, found, which, reading, script)
        !! Numbers of one unit over the only axis.
        type(sweep_t), intent(in) :: sweep
        type(sweep_result_t), intent(in) :: found
        integer, intent(in) :: which(:)
        character(*), intent(in) :: reading
        type(lines_t), intent(inout) :: script
        character(:), allocatable :: line, style
        real(dp) :: high, largest, least, low
        integer(i8) :: n
        integer :: i
        logical :: long

        associate (axis => sweep%axes(1))
            style = "lines lw 2"
            if (axis%count <= few) style = "linespoints lw 2 pt 7 ps 0.7"
            if (axis%random) style = "points pt 7 ps "// &
                                     trim(merge("1  ", "0.5", axis%count <= few))
            call script%add("set grid lc rgb '#cccccc' lw 0.8 lt 1")
            call script%add(trim(merge("set logscale x  ", "unset logscale x", axis%logarithmic)))
            call script%add("set xlabel "//axis_label(axis, sweep%kept))
            if (size(which) == 1) then
                call script%add("unset key; set tmargin -1")
                call script%add("set ylabel "//label(sweep%kept(which(1))%text, &
                                                                sweep%kept(which(1))%unit))
            else
                call script%add("set key at graph 1, graph 1.01 right bottom horizontal "// &
                                "reverse Left; set tmargin 2.2; set ylabel "// &
                                plain_label("("//trim(sweep%kept(which(1))%unit)//")"))
            end if
            call found%range_of(which(1), n, low, high)
            do i = 2, size(which)
                call found%range_of(which(i), n, least, largest)
                low = min(low, least)
                high = max(high, largest)
            end do
            call add_ticks(script, "y", low, high, long)
            call add_spread(script, "x", axis%value(axis%lowest()), axis%value(axis%highest()))
            call add_spread(script, "y", low, high)
            line = "plot"
            do i = 1, size(which)
                if (i > 1) style = "lines dt 2 lw 2"
                line = line//" data "//reading//"using 1:"//to_text(which(i) + 1)//" with "// &
                       style//" lc rgb '"//line_colours(modulo(i - 1, size(line_colours)) + 1)// &
                       "' title "//label(trim(sweep%kept(which(i))%text), "1")//","
            end do
            call script%add(line(:len(line) - 1))
        end associate
    end subroutine add_curves

    pure function beyond(axis, value, side) result(edge)
        !! Half a step further on an axis: where a cell ends.
        type(sweep_axis_t), intent(in) :: axis  !! with two values or more
        real(dp), intent(in) :: value
        integer, intent(in) :: side             !! -1 or 1
        real(dp) :: edge

        associate (first => axis%ends(1), last => axis%ends(2), steps => axis%count - 1)
            if (axis%logarithmic) then
                edge = value*exp(0.5_dp*side*abs(log(last/first))/steps)
            else
                edge = value + 0.5_dp*side*abs(last - first)/steps
            end if
        end associate
    end function beyond

    pure function edges(axis, column) result(using)
        !! Of a cell about the value in a column, as gnuplot computes them: a pixel wider, so that
        !! no ground is seen between cells.
        type(sweep_axis_t), intent(in) :: axis  !! with two values or more
        integer, intent(in) :: column
        character(:), allocatable :: using
        integer, parameter :: pixels = 600  !! of an axis
        character(:), allocatable :: half, value
        real(dp) :: wider

        wider = 1.0_dp + 2.0_dp*axis%count/pixels
        value = "$"//to_text(column)
        if (axis%logarithmic) then
            half = to_text(beyond(axis, 1.0_dp, 1)**wider)
            using = "("//value//"/"//half//"):("//value//"*"//half//")"
        else
            half = to_text(beyond(axis, 0.0_dp, 1)*wider)
            using = "("//value//"-"//half//"):("//value//"+"//half//")"
        end if
    end function edges

    subroutine add_map(sweep, found, which, reading, script)
        !! One number over both axes, as colour; by its logarithm, if all of them are above 0 and
        !! the largest is over 30 times the least. What is NaN stays grey.
        type(sweep_t), intent(in) :: sweep
        type(sweep_result_t), intent(in) :: found
        integer, intent(in) :: which
        character(*), intent(in) :: reading
        type(lines_t), intent(inout) :: script
        character(:), allocatable :: apart, places, range
        real(dp) :: largest, least
        integer(i8) :: n
        integer :: i
        logical :: long

        call found%range_of(which, n, least, largest)
        apart = ""
        call script%add("unset label")
        associate (x => sweep%axes(1), y => sweep%axes(2), kept => sweep%kept(which))
            if (kept%kind == keeps_attractor .and. &
                largest < size(distinct) + 0.5_dp) then
                call script%add(attractor_colours(nint(least), nint(largest)))
                places = attractor_places(sweep, found, nint(least), nint(largest))
                if (places /= "") apart = " offset 5"
                if (places /= "") call script%add(places)
            else
                call script%add(colours)
                call add_ticks(script, "cb", least, largest, long)
                call add_spread(script, "cb", least, largest)
                if (long) call script%add("set rmargin at screen 0.77")
            end if
            call add_ticks(script, "y", y%value(y%lowest()), y%value(y%highest()), long)
            call script%add("set object 1 rectangle from graph 0,0 to graph 1,1 behind "// &
                            "fc rgb '#c8c8c8' fs solid noborder")
            range = ""
            do i = 1, 2
                associate (axis => sweep%axes(i))
                    range = range//" ["//to_text(axis%value(axis%lowest()))//":"// &
                            to_text(axis%value(axis%highest()))//"]"
                    if ((x%logarithmic .or. y%logarithmic) .and. axis%count > 1) then
                        range = range(:index(range, "[", back=.true.))// &
                                to_text(beyond(axis, axis%value(axis%lowest()), -1))//":"// &
                                to_text(beyond(axis, axis%value(axis%highest()), 1))//"]"
                    end if
                    if (axis%count == 1) range = range(:index(range, "[", back=.true.))//"]"
                end associate
            end do
            call script%add("unset logscale; unset grid; unset key")
            if (least > 0.0_dp .and. largest > 30.0_dp*least) then
                call script%add("set logscale cb")
            end if
            if (x%logarithmic) call script%add("set logscale x")
            if (y%logarithmic) call script%add("set logscale y")
            call script%add("set xlabel "//axis_label(x, sweep%kept))
            call script%add("set ylabel "//axis_label(y, sweep%kept))
            call script%add("set cblabel "//label(kept%text, kept%unit)//apart)
            call add_spread(script, "x", x%value(x%lowest()), x%value(x%highest()))
            call add_spread(script, "y", y%value(y%lowest()), y%value(y%highest()))
            if (x%count == 1 .or. y%count == 1) then
                call script%add("plot"//range//" data "//reading//"using 1:2:"// &
                                to_text(which + 2)//" with points pt 5 ps 2 palette")
            else if (x%random .or. y%random) then
                call script%add("plot"//range//" data "//reading//"using 1:2:"// &
                                to_text(which + 2)//" with points pt 7 ps 0.5 palette")
            else if (x%logarithmic .or. y%logarithmic) then
                call script%add("plot"//range//" data "//reading//"using ($"// &
                                to_text(which + 2)//" == $"//to_text(which + 2)// &
                                " ? $1 : NaN):2:"//edges(x, 1)//":"//edges(y, 2)//":"// &
                                to_text(which + 2)// &
                                " with boxxyerror fs solid noborder fc palette")
            else
                call script%add("plot"//range//" data "//reading//"using 1:2:"// &
                                to_text(which + 2)//" with image")
            end if
        end associate
    end subroutine add_map
end module lagrangia_sweep_picture
