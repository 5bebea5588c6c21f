module lagrangia_sweep_files
    !! The data file of a sweep, a row a trajectory, and the gnuplot script beside it: curves over
    !! one axis, a map over two.
    use lagrangia_data_files, only: new_table, script_path
    use lagrangia_description, only: description_t, name_length
    use lagrangia_errors, only: error_t
    use lagrangia_gnuplot_script, only: begin_script, gnuplot_string, lines_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_output_file, only: commit_both, output_file_t
    use lagrangia_plot_label, only: label, plain_label
    use lagrangia_scene, only: scene_line_length, scene_lines
    use lagrangia_sweep, only: sweep_t
    use lagrangia_sweep_grid, only: sweep_result_t
    use lagrangia_table, only: table_t
    use lagrangia_text, only: to_text
    use lagrangia_version, only: build_text, version
    implicit none (type, external)
    private
    public :: write_sweep

    integer, parameter :: few = 60  !! points of a curve that are marked

contains

    subroutine write_sweep(sweep, result, path, format, header, error)
        !! Write the file at `path` and its script; both are there, or neither.
        type(sweep_t), intent(in) :: sweep                !! that has been computed
        type(sweep_result_t), intent(in) :: result        !! what came out
        character(*), intent(in) :: path, format          !! of the data file: text, csv or npy
        character(*), intent(in) :: header(:)             !! lines of the sweep as it was asked for
        type(error_t), allocatable, intent(out) :: error  !! of a file
        class(table_t), allocatable :: table
        type(output_file_t) :: script

        call new_table(format, table)
        call table%file%open(path, error)
        if (allocated(error)) return
        call write_rows(sweep, result, format, header, table, error)
        if (.not. allocated(error)) call script%open(script_path(path), error)
        if (.not. allocated(error)) then
            call script%write(sweep_script(sweep, result, bare_name(path), table%reading()))
            call script%complete(error)
        end if
        if (allocated(error)) then
            call table%file%abandon()
            call script%abandon()
        else
            call commit_both(table%file, script, error)
        end if
    end subroutine write_sweep

    pure function bare_name(path) result(name)
        !! The file's name, without its folder.
        character(*), intent(in) :: path
        character(:), allocatable :: name

        name = path(index(path, "/", back=.true.) + 1:)
    end function bare_name

    subroutine write_rows(sweep, result, format, header, table, error)
        !! The header and every trajectory, in the order of its number. In a text file an empty line
        !! stands before each new value of the first of two axes, as gnuplot has it.
        type(sweep_t), intent(in) :: sweep
        type(sweep_result_t), intent(in) :: result
        character(*), intent(in) :: format, header(:)
        class(table_t), intent(inout) :: table
        type(error_t), allocatable, intent(out) :: error
        character(scene_line_length), allocatable :: lines(:)
        character(name_length) :: names(size(sweep%axes) + size(sweep%kept))
        character(16) :: units(size(names))
        real(dp) :: row(size(names))
        type(description_t) :: d
        integer(i8) :: i
        integer :: n

        n = size(sweep%axes)
        names(:n) = sweep%axes%name
        units(:n) = sweep%axes%unit
        names(n + 1:) = sweep%kept%label
        units(n + 1:) = sweep%kept%unit
        call sweep%system%describe(d)
        lines = [character(scene_line_length) :: "lagrangia "//version//": "// &
                 sweep%scene%title, scene_lines(sweep%scene, d), header, "build: "//build_text()]
        call table%begin(lines, names, units, error)
        call table%send_header(error)
        do i = 1, sweep%trajectories()
            if (allocated(error)) return
            if (format == "text" .and. n == 2 .and. i > 1) then
                if (mod(i - 1, int(size(sweep%axes(n)%values), i8)) == 0) then
                    call table%file%write(new_line("a"))
                end if
            end if
            row(:n) = sweep%coordinates_of(i)
            row(n + 1:) = result%values(:, i)
            call table%add_row(row, error)
        end do
        if (.not. allocated(error)) call table%finish("trajectories: "// &
            to_text(sweep%trajectories())//", failed: "//to_text(result%failures), error)
    end subroutine write_rows

    function sweep_script(sweep, found, file, reading) result(text)
        !! What draws `file`, a bare name beside the script: a panel for each number that is kept.
        type(sweep_t), intent(in) :: sweep
        type(sweep_result_t), intent(in) :: found
        character(*), intent(in) :: file, reading  !! its words for gnuplot, behind the name
        character(:), allocatable :: text
        type(lines_t) :: script
        integer :: groups(size(sweep%kept)), i, k, n

        groups = panels(sweep)
        n = maxval(groups)
        if (size(sweep%axes) == 2) then
            call begin_script(script, file, 900, 60 + 760*n, 40*n)
        else
            call begin_script(script, file, 1000, 60 + merge(560, 340, n == 1)*n, 30*n)
        end if
        call script%add("data = folder."//gnuplot_string(file))
        if (index(reading, "skip") == 1) call script%add("set datafile separator comma")
        call script%add("set multiplot layout "//to_text(n)//",1 title "// &
                        gnuplot_string(trim(sweep%scene%title))//" noenhanced")
        call script%add("set tics out nomirror; unset key")
        do i = 1, n
            if (size(sweep%axes) == 2) then
                call add_map(sweep, found, i, reading, script)
            else
                call add_curves(sweep, pack([(k, k=1, size(groups))], groups == i), reading, script)
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

    subroutine add_curves(sweep, which, reading, script)
        !! Numbers of one unit over the only axis.
        type(sweep_t), intent(in) :: sweep
        integer, intent(in) :: which(:)
        character(*), intent(in) :: reading
        type(lines_t), intent(inout) :: script
        character(:), allocatable :: line, style
        integer :: i

        associate (axis => sweep%axes(1))
            style = "lines lw 2"
            if (size(axis%values) <= few) style = "linespoints lw 2 pt 7 ps 0.7"
            if (axis%random) style = "points pt 7 ps 0.5"
            call script%add("set grid lc rgb '#cccccc' lw 0.8 lt 1")
            call script%add(trim(merge("set logscale x  ", "unset logscale x", axis%logarithmic)))
            call script%add("set xlabel "//label(axis%name, axis%unit))
            if (size(which) == 1) then
                call script%add("unset key; set ylabel "//label(sweep%kept(which(1))%text, &
                                                                sweep%kept(which(1))%unit))
            else
                call script%add("set key top left reverse Left; set ylabel "// &
                                plain_label("("//trim(sweep%kept(which(1))%unit)//")"))
            end if
            line = "plot"
            do i = 1, size(which)
                if (i > 1) style = "lines dt 2 lw 2"
                line = line//" data "//reading//"using 1:"//to_text(which(i) + 1)//" with "// &
                       style//" title "//label(trim(sweep%kept(which(i))%text), "1")//","
            end do
            call script%add(line(:len(line) - 1))
        end associate
    end subroutine add_curves

    subroutine add_map(sweep, found, which, reading, script)
        !! One number over both axes, as colour; by its logarithm, if all of them are above 0 and
        !! the largest is over 30 times the least. What is NaN stays grey.
        type(sweep_t), intent(in) :: sweep
        type(sweep_result_t), intent(in) :: found
        integer, intent(in) :: which
        character(*), intent(in) :: reading
        type(lines_t), intent(inout) :: script
        character(*), parameter :: colours = "set palette defined (0 '#440154', "// &
            "0.25 '#3b528b', 0.5 '#21908c', 0.75 '#5dc863', 1 '#fde725')"
        character(:), allocatable :: range
        real(dp) :: largest, least
        integer :: i, n

        call found%range_of(which, n, least, largest)
        associate (x => sweep%axes(1), y => sweep%axes(2), kept => sweep%kept(which))
            call script%add(colours)
            call script%add("set object 1 rectangle from graph 0,0 to graph 1,1 behind "// &
                            "fc rgb '#c8c8c8' fs solid noborder")
            range = ""
            do i = 1, 2
                associate (axis => sweep%axes(i))
                    range = range//" ["//to_text(minval(axis%values))//":"// &
                            to_text(maxval(axis%values))//"]"
                    if (size(axis%values) == 1) range = range(:index(range, "[", back=.true.))//"]"
                end associate
            end do
            call script%add("unset logscale; unset grid; unset key")
            if (n > 0 .and. least > 0.0_dp .and. largest > 30.0_dp*least) then
                call script%add("set logscale cb")
            end if
            if (x%logarithmic) call script%add("set logscale x")
            if (y%logarithmic) call script%add("set logscale y")
            call script%add("set xlabel "//label(x%name, x%unit))
            call script%add("set ylabel "//label(y%name, y%unit))
            call script%add("set cblabel "//label(kept%text, kept%unit))
            if (x%random .or. y%random) then
                call script%add("plot"//range//" data "//reading//"using 1:2:"// &
                                to_text(which + 2)//" with points pt 7 ps 0.5 palette")
            else if (x%logarithmic .or. y%logarithmic) then
                call script%add("set pm3d map corners2color mean; splot"//range//" data "// &
                                reading//"using 1:2:"//to_text(which + 2)//" with pm3d")
            else
                call script%add("plot"//range//" data "//reading//"using 1:2:"// &
                                to_text(which + 2)//" with image")
            end if
        end associate
    end subroutine add_map
end module lagrangia_sweep_files
