module lagrangia_gnuplot_axes
    !! Scales, ranges and labels of a panel's axes, as lines of a gnuplot script.
    use lagrangia_gnuplot_script, only: lines_t
    use lagrangia_kinds, only: dp
    use lagrangia_number_class, only: is_nonzero, is_zero
    use lagrangia_number_text, only: rounded
    use lagrangia_plot_label, only: label, labels
    use lagrangia_plot_panel, only: panel_t, series_t, told_apart
    use lagrangia_text, only: to_text
    use lagrangia_value_range, only: value_range_t
    implicit none (type, external)
    private
    public :: frame_t
    public :: add_across, add_decades, add_equal_scale, add_labels, add_margins, add_range, &
              add_spread, add_ticks, number_width, tick_step

    integer, parameter :: lowest = -18       !! decade; nothing below it is told from zero
    character(3), parameter :: nearly = char(226)//char(137)//char(136)  !! "almost equal to"
    integer, parameter :: most_decades = 6   !! with a tick each
    real(dp), parameter :: margin = 0.06_dp  !! around what is drawn to scale
    real(dp), parameter :: letter = 10.0_dp  !! pixels of a digit of 14 pt
    integer, parameter :: usual = 6          !! digits of a number beside an axis
    integer, parameter :: most_digits = 15   !! that a double has
    real(dp), parameter :: roomy = 240.0_dp  !! pixels that ten numbers above each other need

    type :: frame_t
        !! Where a panel's axes are, in pixels from the lower left corner.
        real(dp) :: left = 0.0_dp, right = 0.0_dp, bottom = 0.0_dp, top = 0.0_dp
        logical :: below = .true.  !! the label and the numbers of the x axis are shown
    end type frame_t

contains

    pure subroutine add_margins(script, frame, width, height)
        !! Where the axes are.
        type(lines_t), intent(inout) :: script  !! gets the lines
        type(frame_t), intent(in) :: frame  !! the panel's place
        integer, intent(in) :: width, height  !! of the picture, pixels
        character(200) :: line

        write (line, "(ss, 4(a, f6.4))") "set lmargin at screen ", frame%left/width, &
            "; set rmargin at screen ", frame%right/width, "; set bmargin at screen ", &
            frame%bottom/height, "; set tmargin at screen ", frame%top/height
        call script%add(trim(line))
    end subroutine add_margins

    pure subroutine add_decades(script, y, first, edge)
        !! A logarithmic axis for magnitudes: whole decades, from that of the smallest. A zero has
        !! no place on it, nor has what is below `10^lowest`: they are drawn one decade below all
        !! others, where a tick says 0, or nearly 0.
        type(lines_t), intent(inout) :: script  !! gets the lines
        type(value_range_t), intent(in) :: y(:)  !! of each curve
        integer, intent(out) :: first  !! decade where the axis begins
        integer, intent(out) :: edge   !! decade of the lower edge
        character(:), allocatable :: line
        integer :: decade, last, step

        last = -15
        if (maxval(y%largest()) > 10.0_dp**(lowest + 1)) last = ceiling(log10(maxval(y%largest())))
        first = lowest
        if (minval(y%least) < huge(1.0_dp)) first = max(floor(log10(minval(y%least))), lowest)
        first = min(first, last - 1)
        edge = first
        if (any(y%zeros > 0 .or. y%least < 10.0_dp**first)) edge = first - 1
        ! Ticks go down from the top, and none is nearer to the edge than the others to each other.
        step = (last - first + most_decades - 1)/most_decades
        line = "set logscale y; set yrange [0.6e"//to_text(edge)//":1.01e"// &
               to_text(last)//"]; set ytics ("
        if (edge < first) then
            if (any(y%least < 10.0_dp**first)) then
                line = line//""""//nearly//"0"" 1e"//to_text(edge)//", "
            else
                line = line//"""0"" 1e"//to_text(edge)//", "
            end if
        end if
        do decade = last, edge + step, -step
            line = line//"""10^{"//to_text(decade)//"}"" 1e"//to_text(decade)
            if (decade - step >= edge + step) line = line//", "
        end do
        call script%add(line//")")
    end subroutine add_decades

    pure subroutine add_equal_scale(script, x, y, frame)
        !! A metre is as long on both axes, whatever shape the panel has. The numbers have the same
        !! distance, but where an axis would have less than two, or the x axis no room for them.
        type(lines_t), intent(inout) :: script  !! gets the lines
        type(value_range_t), intent(in) :: x(:), y(:)  !! of each curve
        type(frame_t), intent(in) :: frame  !! the panel's place
        real(dp) :: across, middle(2), scale, step, up

        across = maxval(x%high) - minval(x%low)
        up = maxval(y%high) - minval(y%low)
        middle = [0.5_dp*(maxval(x%high) + minval(x%low)), 0.5_dp*(maxval(y%high) + minval(y%low))]
        scale = (1.0_dp + 2.0_dp*margin)*max(across/(frame%right - frame%left), &
                                             up/(frame%top - frame%bottom))  ! m per pixel
        step = tick_step(max(across, up))
        across = 0.5_dp*scale*(frame%right - frame%left)
        up = 0.5_dp*scale*(frame%top - frame%bottom)
        call script%add("set size ratio -1; set xtics "// &
                        to_text(two_at_least(roomy_step(step, middle(1) - across, &
                                                        middle(1) + across, frame), &
                                             middle(1), across))//"; set ytics "// &
                        to_text(two_at_least(step, middle(2), up)))
        call script%add("set xrange ["//rounded(middle(1) - across, 5)//":"// &
                        rounded(middle(1) + across, 5)//"]; set yrange ["// &
                        rounded(middle(2) - up, 5)//":"//rounded(middle(2) + up, 5)//"]")
    end subroutine add_equal_scale

    pure subroutine add_across(script, x, frame)
        !! The range of the x axis, and its numbers where gnuplot's would touch each other. What
        !! only grows fills the panel; a constant gets a range.
        type(lines_t), intent(inout) :: script  !! gets the lines
        type(value_range_t), intent(in) :: x(:)  !! of each curve
        type(frame_t), intent(in) :: frame  !! the panel's place
        integer, parameter :: most = 11  !! numbers that gnuplot puts below an axis
        real(dp) :: high, low, width

        low = minval(x%low)
        high = maxval(x%high)
        if (.not. high > low) then
            width = max(0.1_dp*abs(low), tiny(width))
            if (is_zero(low)) width = 1.0_dp
            call script%add("set xrange ["//to_text(low - width)//":"//to_text(low + width)//"]")
            return
        end if
        if (all(x%turns == 0)) call script%add("set xrange ["//to_text(low)//":"// &
                                               to_text(high)//"]")
        if (room(low, high, tick_step(high - low), frame) >= most) return
        call script%add("set xtics "//to_text(roomy_step(tick_step(high - low), low, high, frame)))
    end subroutine add_across

    pure function roomy_step(step, low, high, frame) result(wider)
        !! A step of at least `step`, with which the numbers below an axis have room.
        real(dp), intent(in) :: step, low, high  !! ends of the axis
        type(frame_t), intent(in) :: frame
        real(dp) :: wider

        wider = step
        do while (wider < high - low .and. (high - low)/wider > room(low, high, wider, frame))
            wider = tick_step(7.6_dp*wider)
        end do
    end function roomy_step

    pure function room(low, high, step, frame) result(count)
        !! How many numbers stand side by side below an axis, a letter and a half apart.
        real(dp), intent(in) :: low, high, step
        type(frame_t), intent(in) :: frame
        real(dp) :: count

        count = (frame%right - frame%left)/ &
                (letter*(max(number_width(low, step), number_width(high, step)) + 1.5_dp))
    end function room

    pure function number_width(value, step) result(letters)
        !! Of a number as `%g` writes it that is as large as `value` and a multiple of `step`.
        real(dp), intent(in) :: value, step  !! of an axis
        integer :: letters
        integer :: behind, last, power

        letters = 1
        if (.not. (is_nonzero(value) .and. step > 0.0_dp)) return
        power = floor(log10(abs(value)) + 1e-9_dp)
        last = floor(log10(step) + 1e-9_dp)
        if (power < -4 .or. power >= max(usual, power - last + 1)) then
            behind = max(0, min(power - last, usual - 1))
            letters = 5 + merge(behind + 1, 0, behind > 0) + merge(1, 0, abs(power) >= 100)
        else
            letters = max(power, 0) + 1 + merge(1 - last, 0, last < 0)
        end if
        if (value < 0.0_dp) letters = letters + 1
    end function number_width

    pure subroutine add_range(script, y, frame)
        !! gnuplot draws nothing between two equal numbers, and ticks that differ by less than their
        !! digits are no ticks: a constant gets a range. Zero is a line worth seeing. A low panel
        !! has no more ticks than there is room for their numbers.
        type(lines_t), intent(inout) :: script  !! gets the lines
        type(value_range_t), intent(in) :: y(:)  !! of each curve
        type(frame_t), intent(in) :: frame  !! the panel's place
        real(dp) :: high, low, width

        low = minval(y%low)
        high = maxval(y%high)
        if (high - low > told_apart*max(abs(low), abs(high))) then
            if (frame%top - frame%bottom < roomy) then
                call script%add("set ytics "//to_text(tick_step(high - low)))
            end if
            return
        end if
        width = max(0.1_dp*max(abs(low), abs(high)), tiny(width))
        if (max(abs(low), abs(high)) <= 0.0_dp) width = 1.0_dp
        call script%add("set yrange ["//to_text(low - width)//":"//to_text(high + width)//"]")
    end subroutine add_range

    pure subroutine add_ticks(script, axis, low, high, long)
        !! The numbers beside an axis, with as many digits as tell them apart; few, if each takes
        !! much room.
        type(lines_t), intent(inout) :: script  !! gets the lines
        character(*), intent(in) :: axis        !! `x`, `y` or `cb`
        real(dp), intent(in) :: low, high       !! what is drawn; none if high < low
        logical, intent(out) :: long            !! do they take much room?
        real(dp) :: largest, step
        integer :: figures

        figures = figures_of(low, high)
        largest = max(abs(low), abs(high))
        long = high > low .and. (figures > usual .or. largest >= 1e5_dp .or. largest < 1e-3_dp)
        call script%add("set format "//axis//" '%."//to_text(figures)//"g'; set "//axis// &
                        "tics autofreq")
        if (.not. long) return
        step = tick_step(high - low)
        if (figures > usual + 2) step = tick_step(2.0_dp*(high - low))
        call script%add("set "//axis//"tics "//to_text(step))
    end subroutine add_ticks

    pure function figures_of(low, high) result(figures)
        !! Significant digits that tell the numbers beside an axis apart, 6 at least.
        real(dp), intent(in) :: low, high  !! what is drawn; none if high < low
        integer :: figures

        figures = usual
        if (.not. high > low) return
        figures = 2 + ceiling(log10(max(abs(low), abs(high))) - log10(high - low))
        figures = max(min(figures, most_digits), usual)
    end function figures_of

    pure subroutine add_spread(script, axis, low, high)
        !! A range for what is constant but for rounding, of which gnuplot finds none, or ticks that
        !! no digit of a double tells apart; for anything else that which gnuplot finds.
        type(lines_t), intent(inout) :: script  !! gets the lines
        character(*), intent(in) :: axis        !! `x`, `y` or `cb`
        real(dp), intent(in) :: low, high       !! what is drawn; none if high < low
        real(dp), parameter :: rounding = 1e-11_dp
        real(dp) :: largest, width

        largest = max(abs(low), abs(high))
        if (high < low .or. high - low > rounding*largest) then
            call script%add("set "//axis//"range [*:*]")
            return
        end if
        width = max(0.1_dp*largest, tiny(width))
        if (largest <= 0.0_dp) width = 1.0_dp
        call script%add("set "//axis//"range ["//to_text(low - width)//":"// &
                        to_text(high + width)//"]; set format "//axis//" '%g'; set "//axis// &
                        "tics autofreq")
    end subroutine add_spread

    pure subroutine add_labels(script, series, panel, x, frame, logarithmic)
        !! Of both axes.
        type(lines_t), intent(inout) :: script  !! gets the lines
        type(series_t), intent(in) :: series  !! data files
        type(panel_t), intent(in) :: panel  !! of columns of the first data file
        type(value_range_t), intent(in) :: x(:)  !! of each curve
        type(frame_t), intent(in) :: frame  !! the panel's place
        logical, intent(in) :: logarithmic  !! is the y axis
        character(:), allocatable :: text
        logical :: errors(panel%curves)

        associate (names => series%names, units => series%units, y => panel%y(:panel%curves))
            if (frame%below) then
                text = to_text(figures_of(minval(x%low), maxval(x%high)))
                if (text == to_text(usual)) text = ""
                if (text /= "") text = "."//text
                call script%add("set format x '%"//text//"g'; set xlabel "// &
                                label(names(panel%x), units(panel%x)))
            else
                call script%add("set format x ''; unset xlabel")
            end if
            text = labels(names(y), units(y))
            if (logarithmic) then
                errors = names(y) == "error"
                text = """|relative drift|, error"""
                if (.not. any(errors)) text = """|relative drift|"""
                if (all(errors)) text = """error"""
                if (panel%curves == 1 .and. .not. any(errors)) then
                    text = absolute(label(names(y(1)), units(y(1))))
                end if
            end if
            call script%add("set ylabel "//text)
        end associate
    end subroutine add_labels

    pure function absolute(string) result(text)
        !! The string of a label between bars.
        character(*), intent(in) :: string
        character(:), allocatable :: text
        integer :: last

        last = index(string, """", back=.true.)
        text = """|"//string(2:last - 1)//"|"//string(last:)
    end function absolute

    pure function two_at_least(step, middle, reach) result(finer)
        !! The largest step, up to `step`, with which two ticks are within `reach` of the middle.
        real(dp), intent(in) :: step, middle, reach
        real(dp) :: finer

        finer = step
        do while (floor((middle + reach)/finer) <= ceiling((middle - reach)/finer))
            finer = tick_step(2.9_dp*finer)
        end do
    end function two_at_least

    pure function tick_step(range) result(step)
        !! 1, 2 or 5 times a power of ten, so that there are three to seven ticks in `range`.
        real(dp), intent(in) :: range  !! of an axis, above 0
        real(dp) :: power, step

        power = 10.0_dp**floor(log10(range/3.0_dp))
        step = power
        if (range/3.0_dp >= 2.0_dp*power) step = 2.0_dp*power
        if (range/3.0_dp >= 5.0_dp*power) step = 5.0_dp*power
    end function tick_step
end module lagrangia_gnuplot_axes
