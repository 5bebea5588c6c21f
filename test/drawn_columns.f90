module drawn_columns
    !! Scripts of gnuplot for columns that tests know.
    use lagrangia_errors, only: error_t
    use lagrangia_gnuplot, only: gnuplot_script, new_panels, new_series, panel_t, series_t
    use lagrangia_kinds, only: dp
    use lagrangia_value_range, only: range_of
    implicit none (type, external)
    private
    public :: names, occurrences, one_curve, script, units

    character(*), parameter :: names(*) = [character(12) :: "t", "x", "theta", "x_dot", "y", &
                                           "error", "energy_drift"]
    character(*), parameter :: units(*) = [character(4) :: "s", "m", "rad", "m/s", "m", "1", "1"]
    real(dp), parameter :: low(*) = [0.0_dp, -2.0_dp, -1.0_dp, -3.0_dp, -1.0_dp, 1e-13_dp, 0.0_dp]
    real(dp), parameter :: high(*) = [9.0_dp, 2.0_dp, 1.0_dp, 3.0_dp, 1.0_dp, 1e-9_dp, 4e-10_dp]

contains

    function script(title, specs) result(text)
        !! The script of the columns above.
        character(*), intent(in) :: title, specs(:)
        character(:), allocatable :: text
        type(panel_t), allocatable :: panels(:)
        type(series_t), allocatable :: series(:)
        type(error_t), allocatable :: error
        integer :: i

        call new_panels(specs, names, units, panels, error)
        allocate (series(1))
        call new_series(series(1), "it.dat", "", names, units, &
                        [(range_of([low(i), high(i)]), i=1, size(low))])
        text = gnuplot_script("it.dat", series, title, "", panels)
    end function script

    function one_curve(file, title, names, units, values) result(text)
        !! The script of one panel: a column over the first.
        character(*), intent(in) :: file, title, names(2), units(2)
        real(dp), intent(in) :: values(:)  !! of the second column, over 0, 1, ...
        character(:), allocatable :: text
        type(panel_t), allocatable :: panels(:)
        type(series_t), allocatable :: series(:)
        type(error_t), allocatable :: error
        integer :: i

        call new_panels([character(1) ::], names, units, panels, error)
        allocate (series(1))
        call new_series(series(1), file, "", names, units, &
                        [range_of([(real(i, dp), i=0, size(values) - 1)]), range_of(values)])
        text = gnuplot_script(file, series, title, "", panels)
    end function one_curve

    pure function occurrences(text, part) result(number)
        !! How often `part` is in `text`.
        character(*), intent(in) :: text, part
        integer :: number, i

        number = 0
        do i = 1, len(text) - len(part) + 1
            if (text(i:i + len(part) - 1) == part) number = number + 1
        end do
    end function occurrences
end module drawn_columns
