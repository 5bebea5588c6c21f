module lagrangia_gnuplot
    !! A gnuplot script that draws a data file: one panel below the other.
    !!
    !! No text of the user is ever more than a string.
    use lagrangia_description, only: name_length
    use lagrangia_errors, only: error_t, fail
    use lagrangia_gnuplot_script, only: begin_script, gnuplot_string, lines_t
    use lagrangia_kinds, only: dp
    use lagrangia_names, only: advice
    use lagrangia_text, only: quoted, to_text
    implicit none (type, external)
    private
    public :: panel_t, gnuplot_script, new_panels
    public :: curves, dots

    character(*), parameter :: curves = "lines lw 1.5"
    character(*), parameter :: dots = "points pt 7 ps 0.5"

    integer, parameter :: most_curves = 8
    real(dp), parameter :: told_apart = 1e-5_dp  !! by the six digits of a tick, relative

    type :: panel_t
        !! One picture: columns `y` over column `x`.
        integer :: x = 1
        integer :: curves = 0
        integer :: y(most_curves) = 0
    end type panel_t

contains

    subroutine new_panels(specs, names, units, panels, error)
        !! Panels as a scene's `plot` wants them: `'theta'`, `'x:y'`, `'t:theta1+theta2'`; with no
        !! specs, one panel for each unit over the first column, drifts and errors apart.
        character(*), intent(in) :: specs(:), names(:), units(:)  !! `x:y1+y2`; of the columns
        type(panel_t), allocatable, intent(out) :: panels(:)  !! one a spec
        type(error_t), allocatable, intent(out) :: error  !! allocated where it fails
        integer :: i, k

        allocate (panels(0))
        do i = 1, size(specs)
            panels = [panels, panel_t()]
            call read_panel(trim(specs(i)), names, panels(i), error)
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

    pure function is_small(name) result(small)
        !! A drift or an error: to be drawn on a scale of its own.
        character(*), intent(in) :: name
        logical :: small

        small = index(name, "_drift") > 0 .or. name == "error"
    end function is_small

    subroutine read_panel(spec, names, panel, error)
        !! `[X:]Y1[+Y2...]`, all of them names of columns.
        character(*), intent(in) :: spec, names(:)
        type(panel_t), intent(inout) :: panel
        type(error_t), allocatable, intent(out) :: error
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

            do column = 1, size(names)
                if (names(column) == name) return
            end do
            call fail(error, quoted(name)//" is none of this scene's columns; "// &
                      advice(name, names))
        end subroutine find
    end subroutine read_panel

    function gnuplot_script(file, reading, title, names, units, low, high, panels, style) &
        result(text)
        !! The script for `file`, a bare name beside the script; its pictures are `NAME.png`, ...
        character(*), intent(in) :: file       !! data file
        character(*), intent(in) :: reading    !! how gnuplot reads it: words behind the file name
        character(*), intent(in) :: title, names(:), units(:)  !! of the picture; of the columns
        real(dp), intent(in) :: low(:), high(:)  !! range of each column
        type(panel_t), intent(in) :: panels(:)  !! from `new_panels`
        character(*), intent(in), optional :: style  !! `curves`, which is the default, or `dots`
        character(:), allocatable :: text, how
        type(lines_t) :: script
        integer :: height, i

        how = curves
        if (present(style)) how = style
        height = 60 + 300*size(panels)
        if (size(panels) == 1) height = 560
        call begin_script(script, file, 1000, height, 30*size(panels))
        if (index(reading, "skip") == 1) call script%add("set datafile separator comma")
        call script%add("set grid lc rgb '#bbbbbb' lw 0.8 lt 1")
        call script%add("set key above right")
        call script%add("set format y '%g'")
        call script%add("set lmargin 14; set rmargin 4")
        call script%add("set multiplot layout "//to_text(size(panels))//",1 title "// &
                        gnuplot_string(trim(title))//" noenhanced")
        do i = 1, size(panels)
            call draw(panels(i))
        end do
        call script%add("unset multiplot")
        text = script%text
    contains
        subroutine draw(panel)
            type(panel_t), intent(in) :: panel
            character(:), allocatable :: line
            real(dp) :: width, rise
            integer :: k, y

            y = panel%y(1)
            width = high(panel%x) - low(panel%x)
            rise = high(y) - low(y)
            line = "set size noratio; set xtics autofreq; set ytics autofreq"
            if (units(panel%x) == "m" .and. units(y) == "m" .and. panel%x > 1) then
                if (width < 5.0_dp*rise .and. rise < 5.0_dp*width) line = "set size ratio -1; "// &
                    "set xtics "//tick(max(width, rise))//"; set ytics "//tick(max(width, rise))
            end if
            call script%add(line)
            line = "set autoscale y"
            if (all(high(panel%y(:panel%curves)) - low(panel%y(:panel%curves)) <= &
                    told_apart*abs(low(panel%y(:panel%curves))))) then
                width = max(0.1_dp*abs(low(y)), tiny(width))
                if (abs(low(y)) <= 0.0_dp) width = 1.0_dp
                if (panel%curves == 1) line = "set yrange ["//to_text(low(y) - width)//":"// &
                                              to_text(high(y) + width)//"]"
            end if
            call script%add(line)
            call script%add("set xlabel "//label(names(panel%x), units(panel%x)))
            if (panel%curves == 1) then
                call script%add("set ylabel "//label(names(y), units(y))//"; unset key")
            else
                line = gnuplot_string("["//trim(units(y))//"]")
                if (any(units(panel%y(:panel%curves)) /= units(y))) line = gnuplot_string("")
                call script%add("set ylabel "//line//"; set key above right")
            end if
            line = "plot data "
            do k = 1, panel%curves
                if (k > 1) line = line//", data "
                line = line//reading//"using "//to_text(panel%x)//":"//to_text(panel%y(k))// &
                       " with "//how//" title "//label(names(panel%y(k)), units(panel%y(k)))
            end do
            call script%add(line)
        end subroutine draw
    end function gnuplot_script

    pure function tick(range) result(text)
        !! A step of 1, 2 or 5 times a power of ten that makes three to seven ticks in `range`.
        real(dp), intent(in) :: range
        character(:), allocatable :: text
        real(dp) :: power, step

        power = 10.0_dp**floor(log10(range/3.0_dp))
        step = power
        if (range/3.0_dp >= 2.0_dp*power) step = 2.0_dp*power
        if (range/3.0_dp >= 5.0_dp*power) step = 5.0_dp*power
        text = to_text(step)
    end function tick

    pure function label(name, unit) result(text)
        !! `"theta [rad]"`.
        character(*), intent(in) :: name, unit
        character(:), allocatable :: text

        text = gnuplot_string(trim(name)//" ["//trim(unit)//"]")
    end function label
end module lagrangia_gnuplot
