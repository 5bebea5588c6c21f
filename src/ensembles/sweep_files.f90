module lagrangia_sweep_files
    !! The data file of a sweep, a row a trajectory or a point of one, and beside it the gnuplot
    !! script that draws it, and the scene where the format has no place for it.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
    use lagrangia_characters, only: printable
    use lagrangia_column_names, only: told_apart
    use lagrangia_data_files, only: new_table, scene_path, script_path
    use lagrangia_description, only: description_t
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_output_file, only: output_file_t
    use lagrangia_scene, only: scene_line_length, scene_lines, scene_t, sweep_text_length
    use lagrangia_sweep, only: sweep_t
    use lagrangia_sweep_grid, only: sweep_result_t
    use lagrangia_sweep_picture, only: sweep_script
    use lagrangia_table, only: table_t
    use lagrangia_text, only: to_text
    use lagrangia_version, only: build_text, version
    implicit none (type, external)
    private
    public :: sweep_header, write_sweep

contains

    subroutine write_sweep(sweep, result, path, format, header, error, scene)
        !! Write the file at `path`, its script and its scene; all are there, or none.
        type(sweep_t), intent(in) :: sweep                !! that has been computed
        type(sweep_result_t), intent(inout) :: result     !! what came out; its blocks are read
        character(*), intent(in) :: path, format          !! of the data file: text, csv or npy
        character(*), intent(in) :: header(:)             !! lines of the sweep as it was asked for
        type(error_t), allocatable, intent(out) :: error  !! of a file
        type(scene_t), intent(in), optional :: scene      !! as it was asked for, to be run again
        class(table_t), allocatable :: table
        type(output_file_t) :: beside, script

        call new_table(format, table)
        call table%file%open(path, error)
        if (allocated(error)) return
        call write_rows(sweep, result, format, header, table, error)
        if (.not. allocated(error)) call script%open(script_path(path), error)
        if (.not. allocated(error)) then
            call script%write(sweep_script(sweep, result, bare_name(path), table%reading()))
            call script%complete(error)
        end if
        if (.not. allocated(error)) call table%file%complete(error)
        if (.not. allocated(error) .and. present(scene) .and. format /= "text") then
            call write_scene(sweep, scene, header, scene_path(path), beside, error)
        end if
        if (.not. allocated(error)) call table%file%commit(error)
        if (.not. allocated(error)) call script%commit(error)
        if (.not. allocated(error) .and. beside%is_open()) call beside%commit(error)
        call table%file%abandon()
        call script%abandon()
        call beside%abandon()
    end subroutine write_sweep

    subroutine write_scene(sweep, scene, header, path, file, error)
        !! The scene and its sweep at `path`, what built it, and the columns with their units.
        type(sweep_t), intent(in) :: sweep
        type(scene_t), intent(in) :: scene
        character(*), intent(in) :: header(:), path
        type(output_file_t), intent(inout) :: file  !! complete but for its name
        type(error_t), allocatable, intent(out) :: error
        character(scene_line_length), allocatable :: lines(:)
        character(16), allocatable :: units(:)
        character(sweep_text_length + 10), allocatable :: names(:)
        type(description_t) :: d
        integer :: i

        call file%open(path, error)
        if (allocated(error)) return
        call file%write("! lagrangia "//version//": "//printable(trim(scene%title))// &
                        new_line("a")//"! build: "//build_text()//new_line("a")//"! columns:")
        names = column_names(sweep)
        units = column_units(sweep)
        do i = 1, size(names)
            call file%write(" "//trim(names(i))//"["//trim(units(i))//"]")
        end do
        call file%write(new_line("a"))
        call sweep%system%describe(d)
        lines = [character(scene_line_length) :: scene_lines(scene, d), header]
        do i = 1, size(lines)
            call file%write(trim(lines(i))//new_line("a"))
        end do
        call file%complete(error)
    end subroutine write_scene

    pure function column_names(sweep) result(names)
        !! Those of the axes and of what is kept. An axis is where a motion begins: `theta_0`, where
        !! `theta` is kept.
        type(sweep_t), intent(in) :: sweep
        character(sweep_text_length + 10) :: names(size(sweep%axes) + size(sweep%kept))
        integer :: i

        names = [character(len(names)) :: sweep%axes%name, sweep%kept%label]
        do i = 1, size(sweep%axes)
            if (any(sweep%kept%label == sweep%axes(i)%name)) names(i) = trim(names(i))//"_0"
        end do
        names = told_apart(names)
    end function column_names

    pure function column_units(sweep) result(units)
        !! Of the same.
        type(sweep_t), intent(in) :: sweep
        character(16) :: units(size(sweep%axes) + size(sweep%kept))

        units = [character(16) :: sweep%axes%unit, sweep%kept%unit]
    end function column_units

    function sweep_header(sweep, lines) result(header)
        !! What tells the sweep, in the data file and where it is interrupted.
        type(sweep_t), intent(in) :: sweep    !! as `new_sweep` made it
        character(*), intent(in) :: lines(:)  !! of the sweep as it was asked for
        character(scene_line_length), allocatable :: header(:)
        type(description_t) :: d

        call sweep%system%describe(d)
        header = [character(scene_line_length) :: "lagrangia "//version//": "// &
                  sweep%scene%title, scene_lines(sweep%scene, d), lines, "build: "//build_text()]
    end function sweep_header

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
        type(sweep_result_t), intent(inout) :: result
        character(*), intent(in) :: format, header(:)
        class(table_t), intent(inout) :: table
        type(error_t), allocatable, intent(out) :: error
        real(dp), allocatable :: values(:, :)
        real(dp) :: row(size(sweep%axes) + size(sweep%kept))
        character(:), allocatable :: counts
        integer(i8) :: block, i, rows
        integer :: k, kept, last, n

        rows = 0
        n = size(sweep%axes)
        kept = size(sweep%kept)
        call table%begin(sweep_header(sweep, header), column_names(sweep), column_units(sweep), &
                         error)
        call table%send_header(error)
        do block = 1, result%store%blocks
            if (allocated(error)) return
            call result%read_block(sweep, block, values, error)
            if (allocated(error)) return
            do i = result%store%first_of(block), result%store%last_of(block)
                if (format == "text" .and. n == 2 .and. i > 1) then
                    if (mod(i - 1, sweep%axes(n)%count) == 0) then
                        call table%file%write(new_line("a"))
                    end if
                end if
                row(:n) = sweep%coordinates_of(i)
                last = sweep%points
                if (sweep%keeps_points) last = findloc([(any(.not. ieee_is_nan( &
                    values((k - 1)*kept + 1:k*kept, i - result%store%first_of(block) + 1))), &
                    k=1, sweep%points)], .true., 1, back=.true.)
                do k = 1, last
                    row(n + 1:) = values((k - 1)*kept + 1:k*kept, &
                                         i - result%store%first_of(block) + 1)
                    call table%add_row(row, error)
                    if (allocated(error)) return
                    rows = rows + 1
                end do
            end do
        end do
        counts = "trajectories: "//to_text(sweep%trajectories())//", failed: "// &
                 to_text(result%failures)
        if (sweep%keeps_points) counts = counts//", points: "//to_text(rows)
        if (sweep%attractors) counts = counts//attractor_text(sweep, result)
        if (.not. allocated(error)) call table%finish(counts, error)
    end subroutine write_rows

    function attractor_text(sweep, result) result(text)
        !! Where the attractors are, `; attractor 1 at x = 1.0, x_dot = 0.0; 3 more`, as many as a
        !! line holds.
        type(sweep_t), intent(in) :: sweep
        type(sweep_result_t), intent(in) :: result
        character(:), allocatable :: text
        character(:), allocatable :: next
        type(description_t) :: d
        integer, parameter :: room = 170  !! of the line's 240 bytes, which has counts before it
        integer :: i

        call sweep%system%describe(d)
        text = ""
        do i = 1, result%attractors%count
            next = "; attractor "//to_text(i)//" "//result%attractors%place_of(i, d)
            if (len(text) + len(next) > room) then
                text = text//"; "//to_text(result%attractors%count - i + 1)//" more"
                exit
            end if
            text = text//next
        end do
    end function attractor_text
end module lagrangia_sweep_files
