module lagrangia_plot_panel
    !! What a picture shows: columns of data files, in panels.
    use lagrangia_kinds, only: dp
    use lagrangia_value_range, only: value_range_t
    implicit none (type, external)
    private
    public :: panel_t, series_t, trace_t
    public :: alike, aspect, find_traces, has_envelope, has_legend, is_dense, is_space, ranges_of
    public :: shape_legend
    public :: most_curves, told_apart

    integer, parameter :: most_curves = 8
    real(dp), parameter :: apart = 2.1_dp    !! pixels from turn to turn; nearer is a solid block
    real(dp), parameter :: told_apart = 1e-5_dp    !! by the six digits of a tick, relative
    real(dp), parameter :: most_unequal = 12.0_dp  !! width by height, or back, drawn to scale

    type :: series_t
        !! A data file of a picture.
        character(:), allocatable :: file     !! beside the script, or below
        character(:), allocatable :: reading  !! how gnuplot reads it: words behind the file's name
        character(:), allocatable :: name     !! of its curves, where there are several files
        character(64), allocatable :: names(:), units(:)  !! of its columns
        type(value_range_t), allocatable :: ranges(:)     !! of its columns
    end type series_t

    type :: panel_t
        !! Columns `y` over column `x`, as the first data file has them.
        integer :: x = 1
        integer :: curves = 0
        integer :: y(most_curves) = 0
        integer :: colour(most_curves) = 0  !! of each curve, from 1, where there is one data file
        logical :: nested = .false.  !! curves lie on each other, the first is widest
    end type panel_t

    type :: trace_t
        !! One curve: columns of a data file.
        integer :: series = 0, x = 0, y = 0
    end type trace_t

contains

    pure subroutine find_traces(series, panel, traces)
        !! Of each data file the columns that have the names of the panel's.
        type(series_t), intent(in) :: series(:)  !! data files
        type(panel_t), intent(in) :: panel  !! of columns of the first data file
        type(trace_t), allocatable, intent(out) :: traces(:)  !! its curves
        type(trace_t) :: found(size(series)*most_curves)
        integer :: i, k, n, x, y

        n = 0
        do i = 1, size(series)
            x = findloc(series(i)%names, series(1)%names(panel%x), 1)
            do k = 1, panel%curves
                y = findloc(series(i)%names, series(1)%names(panel%y(k)), 1)
                if (x == 0 .or. y == 0) cycle
                n = n + 1
                found(n) = trace_t(i, x, y)
            end do
        end do
        allocate (traces(n))
        traces(:) = found(:n)
    end subroutine find_traces

    pure subroutine ranges_of(series, traces, x, y)
        !! Of each curve.
        type(series_t), intent(in) :: series(:)  !! data files
        type(trace_t), intent(in) :: traces(:)  !! its curves
        type(value_range_t), allocatable, intent(out) :: x(:), y(:)  !! of each curve
        integer :: i

        allocate (x(size(traces)), y(size(traces)))
        do i = 1, size(traces)
            x(i) = series(traces(i)%series)%ranges(traces(i)%x)
            y(i) = series(traces(i)%series)%ranges(traces(i)%y)
        end do
    end subroutine ranges_of

    pure function is_space(series, panel) result(yes)
        !! Lengths over a length, neither much longer than the other: to be drawn to scale.
        type(series_t), intent(in) :: series(:)  !! data files
        type(panel_t), intent(in) :: panel  !! of columns of the first data file
        logical :: yes
        real(dp) :: ratio

        yes = .false.
        if (panel%x == 1) return
        associate (units => series(1)%units)
            if (units(panel%x) /= "m") return
            if (any(units(panel%y(:panel%curves)) /= "m")) return
        end associate
        ratio = aspect(series, panel)
        yes = ratio <= most_unequal .and. ratio >= 1.0_dp/most_unequal
    end function is_space

    pure function aspect(series, panel) result(ratio)
        !! Height of what a panel shows, by its width; huge where it has no width.
        type(series_t), intent(in) :: series(:)  !! data files
        type(panel_t), intent(in) :: panel  !! of columns of the first data file
        real(dp) :: ratio
        type(trace_t), allocatable :: traces(:)
        type(value_range_t), allocatable :: x(:), y(:)
        real(dp) :: rise, width

        call find_traces(series, panel, traces)
        call ranges_of(series, traces, x, y)
        width = maxval(x%high) - minval(x%low)
        rise = maxval(y%high) - minval(y%low)
        ratio = huge(ratio)
        if (width > rise/huge(ratio)) ratio = rise/width
    end function aspect

    pure function has_envelope(series, trace, pixels) result(yes)
        !! More periods than can be told apart, over what only grows or only falls.
        type(series_t), intent(in) :: series  !! data files
        type(trace_t), intent(in) :: trace  !! one of its curves
        real(dp), intent(in) :: pixels  !! of the panel's width
        logical :: yes

        yes = trace%x == 1 .and. apart*series%ranges(trace%y)%turns > pixels .and. &
              series%ranges(1)%high > series%ranges(1)%low .and. &
              series%ranges(1)%turns == 0 .and. &
              series%ranges(trace%y)%high - series%ranges(trace%y)%low > &
              told_apart*series%ranges(trace%y)%largest()
    end function has_envelope

    pure function is_dense(series, trace, pixels) result(yes)
        !! A path so often to and fro that only thin lines show which places it visits more often.
        type(series_t), intent(in) :: series  !! data files
        type(trace_t), intent(in) :: trace  !! one of its curves
        real(dp), intent(in) :: pixels  !! of the panel's width
        logical :: yes

        yes = (trace%x /= 1 .or. series%ranges(1)%turns > 0) .and. &
              apart*series%ranges(trace%y)%turns > pixels
    end function is_dense

    pure function alike(x, y) result(yes)
        !! Whether curves may lie on each other: they begin, end and reach where the first does.
        type(value_range_t), intent(in) :: x(:), y(:)  !! of each curve
        logical :: yes
        real(dp), parameter :: near = 0.05_dp  !! of what the first spreads

        yes = all(abs(x%low - x(1)%low) <= near*(x(1)%high - x(1)%low)) .and. &
              all(abs(x%high - x(1)%high) <= near*(x(1)%high - x(1)%low)) .and. &
              all(abs(y%low - y(1)%low) <= near*(y(1)%high - y(1)%low)) .and. &
              all(abs(y%high - y(1)%high) <= near*(y(1)%high - y(1)%low))
    end function alike

    pure function has_legend(series, panel, number) result(yes)
        !! Of several data files only the first panel, where no column is beside another one.
        type(series_t), intent(in) :: series(:)  !! data files
        type(panel_t), intent(in) :: panel  !! of columns of the first data file
        integer, intent(in) :: number  !! of the panel
        logical :: yes

        yes = panel%curves > 1 .and. size(series) == 1
        if (size(series) > 1) yes = number == 1 .and. size(series) <= most_curves
    end function has_legend

    pure subroutine shape_legend(series, panel, number, pixels, columns, rows)
        !! Its entries side by side, as many as there is room for; gnuplot makes all as wide as the
        !! widest.
        type(series_t), intent(in) :: series(:)  !! data files
        type(panel_t), intent(in) :: panel  !! of columns of the first data file
        integer, intent(in) :: number  !! of the panel
        real(dp), intent(in) :: pixels  !! of the panel's width
        integer, intent(out) :: columns, rows  !! 0: there is no legend
        real(dp), parameter :: letter = 12.0_dp  !! pixels, as gnuplot takes one of 14 pt
        integer, parameter :: sample = 6         !! letters that the line in front takes, and gaps
        integer :: entries, i, length, longest
        logical :: units

        columns = 0
        rows = 0
        if (.not. has_legend(series, panel, number)) return
        entries = merge(size(series), panel%curves, size(series) > 1)
        units = any(series(1)%units(panel%y(:panel%curves)) /= series(1)%units(panel%y(1)))
        longest = 1
        do i = 1, entries
            if (size(series) > 1) then
                length = len(series(i)%name)
            else
                length = index(trim(series(1)%names(panel%y(i)))//"_drift", "_drift") - 1
                if (units) length = length + len_trim(series(1)%units(panel%y(i))) + 3
            end if
            longest = max(longest, length)
        end do
        columns = max(1, min(entries, int(pixels/(letter*(longest + sample)))))
        rows = (entries + columns - 1)/columns
    end subroutine shape_legend
end module lagrangia_plot_panel
