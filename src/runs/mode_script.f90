module lagrangia_mode_script
    !! The gnuplot script that draws modes as the mechanism that swings.
    use lagrangia_gnuplot_script, only: begin_script, gnuplot_string, lines_t
    use lagrangia_kinds, only: dp
    use lagrangia_number_class, only: is_nonzero
    use lagrangia_number_text, only: fixed, scientific
    use lagrangia_plot_symbol, only: symbol
    use lagrangia_plot_words, only: text_label
    use lagrangia_small_oscillations, only: is_oscillation, is_unstable, modes_t
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: mode_script, part_of_modes
    public :: is_mass, is_rod, is_way, most_panels

    integer, parameter :: is_mass = 0, is_rod = 1, is_way = 2  !! kinds of rows
    integer, parameter :: most_panels = 12
    integer, parameter :: across = 4        !! panels beside each other
    real(dp), parameter :: side = 330.0_dp  !! pixels of a panel, at most
    real(dp), parameter :: most_wide = 1000.0_dp  !! pixels of the whole: letters of 14 are read
    real(dp), parameter :: flat = 0.15_dp   !! height by length, or back, of what covers itself

contains

    function mode_script(modes, rows, path, title) result(text)
        !! A panel a mode, all to one scale.
        type(modes_t), intent(in) :: modes  !! of the system
        real(dp), intent(in) :: rows(:, :)  !! of the data file: mode, side, kind, x, y, z, dx, ...
        character(*), intent(in) :: path    !! of the data file
        character(*), intent(in) :: title   !! whose modes, in words, and what is changed
        character(:), allocatable :: file, text
        type(lines_t) :: script
        real(dp) :: apart(2, most_panels), centre(2), drawn(2), half(2, most_panels)
        real(dp) :: shown(2), wide
        real(dp), parameter :: gap = 46.0_dp, top = 84.0_dp, label = 40.0_dp
        integer :: axes(2, most_panels), beside, down, height, i, n, width
        character(200) :: line
        character(3) :: dot

        n = min(size(modes%omega2), most_panels)
        do i = 1, n
            call choose_axes(rows, i, axes(:, i), centre, half(:, i))
            call part_sides(rows, i, axes(:, i), half(:, i), apart(:, i))
        end do
        ! Half the range of both axes: that of the largest panel, a little more, not too slender.
        shown = maxval(half(:, :n), 2)
        shown = 1.15_dp*max(shown, 0.6_dp*maxval(shown))
        beside = min(n, merge(across, across + 1, n <= 2*across))
        down = (n + beside - 1)/beside
        dot = merge("1.8", "1.0", n <= across)
        wide = min(side, ((most_wide - gap)/beside - gap)*maxval(shown)/shown(1))
        if (n == 1) wide = 1.5_dp*side
        width = nint(beside*(wide*shown(1)/maxval(shown) + gap) + gap)
        width = max(width, 800)
        height = nint(top + down*(wide*shown(2)/maxval(shown) + label + gap))
        file = path(index(path, "/", back=.true.) + 1:)
        call begin_script(script, file, width, height, 30*down)
        call script%add("data = folder."//gnuplot_string(file))
        call script%add("set multiplot")
        call script%add("set label 1 "//text_label(title//": "//shown_modes())// &
                        " at screen 0.5, screen "//fixed(1.0_dp - 24.0_dp/height, 4)// &
                        " center font ',16'")
        call script%add("set label 2 ""grey: at rest, and the way of each mass; blue, orange: "// &
                        "to either side, enlarged"" at screen 0.5, screen "// &
                        fixed(1.0_dp - 52.0_dp/height, 4)//" center font ',14'")
        call script%add("unset key; unset tics; set size ratio -1; set border lw 0.8 lc rgb "// &
                        "'#bbbbbb'")
        call script%add("set style line 1 lc rgb '#999999' lw 2 pt 7 ps "//dot)
        call script%add("set style line 2 lc rgb '#0072b2' lw 3 pt 7 ps "//dot)
        call script%add("set style line 3 lc rgb '#d55e00' lw 3 pt 7 ps "//dot)
        do i = 1, n
            call choose_axes(rows, i, axes(:, i), centre, drawn)
            call put_panel(i)
            if (i == 1) call script%add("unset label")
        end do
        call script%add("unset multiplot")
        text = script%text
    contains
        function shown_modes() result(words)
            character(:), allocatable :: words

            words = part_of_modes(modes)
            if (words == "") words = "small oscillations"
        end function shown_modes

        subroutine put_panel(which)
            integer, intent(in) :: which
            real(dp) :: body(2), left, upper
            integer :: part, row

            body = wide*shown/maxval(shown)
            row = (which - 1)/beside
            left = 0.5_dp*(width - beside*(body(1) + gap) + gap) + &
                   modulo(which - 1, beside)*(body(1) + gap)
            upper = height - top - label - row*(body(2) + label + gap)
            write (line, "(ss, 4(a, f6.4))") "set lmargin at screen ", left/width, &
                "; set rmargin at screen ", (left + body(1))/width, "; set bmargin at screen ", &
                (upper - body(2))/height, "; set tmargin at screen ", upper/height
            call script%add(trim(line))
            call script%add("set title "//gnuplot_string(mode_title(modes, which))// &
                            " offset 0,-0.4")
            call script%add("set xrange ["//to_text(centre(1) - shown(1))//":"// &
                            to_text(centre(1) + shown(1))//"]; set yrange ["// &
                            to_text(centre(2) - shown(2))//":"//to_text(centre(2) + shown(2))//"]")
            call script%add("set xlabel '"//axis_name(axes(1, which))//" (m)'; set ylabel '"// &
                            axis_name(axes(2, which))//" (m)'")
            call script%add("plot "//segments(which, 0, is_way, 1)//" lw 1 dt 3, \")
            do part = 1, 3
                call script%add("     "//segments(which, side_of(part), is_rod, part)//", \")
                call script%add("     "//masses(which, side_of(part), part)// &
                                trim(merge(", \", "   ", part < 3)))
            end do
        end subroutine put_panel

        function segments(mode, which, kind, style) result(words)
            integer, intent(in) :: mode, which, kind, style
            character(:), allocatable :: words
            character(1) :: a, b

            a = to_text(3 + axes(1, mode))
            b = to_text(3 + axes(2, mode))
            words = "data using "//chosen(mode, which, kind, a, apart(1, mode))//":"// &
                    shifted(which, b, apart(2, mode))//":"// &
                    to_text(6 + axes(1, mode))//":"//to_text(6 + axes(2, mode))// &
                    " with vectors nohead ls "//to_text(style)
        end function segments

        function masses(mode, which, style) result(words)
            integer, intent(in) :: mode, which, style
            character(:), allocatable :: words

            words = "data using "//chosen(mode, which, is_mass, to_text(3 + axes(1, mode)), &
                                          apart(1, mode))//":"// &
                    shifted(which, to_text(3 + axes(2, mode)), apart(2, mode))// &
                    " with points ls "//to_text(style)
        end function masses
    end function mode_script

    pure function chosen(mode, which, kind, column, apart) result(words)
        !! The column of the rows of one mode, side and kind, a side shifted by `apart`.
        integer, intent(in) :: mode, which, kind
        character(*), intent(in) :: column
        real(dp), intent(in) :: apart  !! m
        character(:), allocatable :: words

        words = "($1 == "//to_text(mode)//" && $2 == "//to_text(which)//" && $3 == "// &
                to_text(kind)//" ? $"//column//moved(which, apart)//" : NaN)"
    end function chosen

    pure function shifted(which, column, apart) result(words)
        !! A column, that of a side shifted by `apart`.
        integer, intent(in) :: which
        character(*), intent(in) :: column
        real(dp), intent(in) :: apart  !! m
        character(:), allocatable :: words

        words = column
        if (moved(which, apart) /= "") words = "($"//column//moved(which, apart)//")"
    end function shifted

    pure function moved(which, apart) result(words)
        !! ` + 0.3`, or nothing.
        integer, intent(in) :: which
        real(dp), intent(in) :: apart  !! m
        character(:), allocatable :: words

        words = ""
        if (which /= 0 .and. is_nonzero(apart)) words = " + "//to_text(which*apart)
    end function moved

    pure subroutine part_sides(rows, mode, axes, half, apart)
        !! Rods and springs that move along themselves would cover each other: the sides of such a
        !! mode are drawn to either side of the way, and its range grows by that.
        real(dp), intent(in) :: rows(:, :)
        integer, intent(in) :: mode, axes(2)
        real(dp), intent(inout) :: half(2)
        real(dp), intent(out) :: apart(2)
        real(dp) :: extent(2)
        integer :: across, i

        apart = 0.0_dp
        if (.not. any(nint(rows(1, :)) == mode .and. nint(rows(3, :)) == is_rod)) return
        across = minloc(half, 1)
        if (half(across) > flat*maxval(half)) return
        do i = 1, 2
            extent(i) = sum(abs(rows(6 + axes(i), :)), nint(rows(1, :)) == mode .and. &
                         nint(rows(3, :)) == is_way)
        end do
        if (extent(across) > flat*maxval(extent)) return
        apart(across) = 2.5_dp*max(half(across), 0.05_dp*maxval(half))
        half(across) = half(across) + apart(across)
    end subroutine part_sides

    pure function side_of(part) result(which)
        !! At rest, and the two sides.
        integer, intent(in) :: part
        integer :: which

        which = merge(-1, part - 1, part == 3)
    end function side_of

    pure function axis_name(axis) result(name)
        !! Of a direction in space.
        integer, intent(in) :: axis
        character(1) :: name

        name = "xyz"(axis:axis)
    end function axis_name

    pure subroutine choose_axes(rows, mode, axes, centre, half)
        !! The two directions in which a mode and its mechanism extend most, in the order x, y, z,
        !! and the middle and half of their range.
        real(dp), intent(in) :: rows(:, :)
        integer, intent(in) :: mode
        integer, intent(out) :: axes(2)
        real(dp), intent(out) :: centre(2), half(2)
        real(dp) :: high(3), low(3)
        integer :: i, least

        high = -huge(high)
        low = huge(low)
        do i = 1, size(rows, 2)
            if (nint(rows(1, i)) /= mode) cycle
            high = max(high, rows(4:6, i), rows(4:6, i) + rows(7:9, i))
            low = min(low, rows(4:6, i), rows(4:6, i) + rows(7:9, i))
        end do
        least = minloc(high - low, 1, back=.true.)
        axes = pack([1, 2, 3], [1, 2, 3] /= least)
        centre = 0.5_dp*(high(axes) + low(axes))
        half = 0.5_dp*(high(axes) - low(axes))
    end subroutine choose_axes

    pure function part_of_modes(modes) result(text)
        !! `the first 12 of 13 modes`, where a picture has no room for all; else nothing.
        type(modes_t), intent(in) :: modes  !! of a system
        character(:), allocatable :: text

        text = ""
        if (size(modes%omega2) > most_panels) text = "the first "//to_text(most_panels)//" of "// &
            to_text(size(modes%omega2))//" modes"
    end function part_of_modes

    pure function mode_title(modes, j) result(text)
        !! Its omega with four digits, or what it does instead.
        type(modes_t), intent(in) :: modes
        integer, intent(in) :: j
        character(:), allocatable :: text

        text = symbol("omega")
        if (size(modes%omega2) > 1) text = symbol("omega"//to_text(j))
        if (modes%label(j) == is_oscillation) then
            text = text//" = "//four_digits(modes%omega(j))//" rad/s"
        else if (modes%label(j) == is_unstable) then
            text = "grows by e in "//four_digits(1.0_dp/sqrt(-modes%omega2(j)))//" s"
        else
            text = text//" = 0"
        end if
    end function mode_title

    pure function four_digits(value) result(text)
        !! Of a positive number.
        real(dp), intent(in) :: value
        character(:), allocatable :: text
        integer :: decimals

        decimals = 3 - floor(log10(value))
        if (decimals < 0 .or. decimals > 7) then
            text = scientific(value, 4)
        else
            text = fixed(value, decimals)
        end if
    end function four_digits
end module lagrangia_mode_script
