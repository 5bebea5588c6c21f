module lagrangia_modes_files
    !! One period of a mode as a data file with its gnuplot script, ready to animate.
    use lagrangia_data_files, only: script_path
    use lagrangia_description, only: description_t, name_length
    use lagrangia_disk_space, only: space_warning
    use lagrangia_errors, only: error_t
    use lagrangia_files, only: folder_of
    use lagrangia_gnuplot, only: gnuplot_script, new_panels, new_series, panel_t, &
                                 series_t
    use lagrangia_kinds, only: dp
    use lagrangia_mode_picture, only: mode_picture_path
    use lagrangia_number_text, only: field_width, rounded
    use lagrangia_output_file, only: commit_both, output_file_t, refuse_unwritable
    use lagrangia_places, only: places_t
    use lagrangia_scene_claims, only: claim_table
    use lagrangia_small_oscillations, only: is_oscillation, is_unstable, is_zero_mode, &
                                            modes_t, stays
    use lagrangia_system, only: system_t
    use lagrangia_text, only: to_text
    use lagrangia_text_table, only: text_table_t
    use lagrangia_value_range, only: value_range_t
    implicit none (type, external)
    private
    public :: claim_modes, prepare_modes, size_of_modes, write_mode

    integer, parameter :: samples = 200
    integer, parameter :: digits = 6  !! of omega^2 in a title

contains

    subroutine claim_modes(system, stem, source, error)
        !! Fails where two of the files of the modes are one, or one of them is the scene. To be
        !! called before any is written, the film too.
        class(system_t), intent(in) :: system  !! of any size
        character(*), intent(in) :: stem  !! folder, and how all names begin
        character(*), intent(in) :: source  !! the file that the scene was read from, or ""
        type(error_t), allocatable, intent(out) :: error  !! names both
        type(places_t) :: places
        integer :: j

        if (source /= "") call places%add(source, "scene", "", error)
        do j = 1, system%ndof
            if (.not. allocated(error)) call claim_table(mode_path(stem, j), "data", "", places, &
                                                         error)
        end do
        if (.not. allocated(error)) call claim_table(mode_picture_path(stem), "data", "", places, &
                                                     error)
    end subroutine claim_modes

    subroutine prepare_modes(system, stem, warning, error)
        !! Fails where the first of the data files could not be written now; says how much all will
        !! hold, if that is very much. To be called before modes are looked for.
        class(system_t), intent(in) :: system  !! with its parameters
        character(*), intent(in) :: stem  !! folder, made if need be, and how all names begin
        character(:), allocatable, intent(out) :: warning  !! a line for the user, or nothing
        type(error_t), allocatable, intent(out) :: error  !! of a file

        warning = space_warning(size_of_modes(system), folder_of(stem))
        call refuse_unwritable(mode_path(stem, 1), error)
    end subroutine prepare_modes

    pure function size_of_modes(system) result(bytes)
        !! Of all data files together, without their headers.
        class(system_t), intent(in) :: system  !! of any size
        real(dp) :: bytes

        bytes = real(system%ndof, dp)*(samples + 1)*(1 + system%ndof)*(field_width + 1)
    end function size_of_modes

    pure function mode_path(stem, j) result(path)
        !! `STEM_mode_J.dat`.
        character(*), intent(in) :: stem
        integer, intent(in) :: j
        character(:), allocatable :: path

        path = stem//"_mode_"//to_text(j)//".dat"
    end function mode_path

    subroutine write_mode(system, modes, j, stem, title, error)
        !! `STEM_mode_J.dat`: the equilibrium plus a tenth of the shape times \(\cos\omega t\)
        !! over a period (with \(G\), of a shape that turns), \(\cosh\) over two growth times, or
        !! \(t\) over one second of a zero mode.
        class(system_t), intent(in) :: system  !! with its parameters
        type(modes_t), intent(in) :: modes  !! of this system
        integer, intent(in) :: j  !! number of the mode, from 1
        character(*), intent(in) :: stem  !! that of `prepare_modes`
        character(*), intent(in) :: title  !! whose modes, in words, and what is changed
        type(error_t), allocatable, intent(out) :: error
        !! of a file; then none of this mode is left
        type(description_t) :: d
        type(text_table_t) :: table
        type(output_file_t) :: script
        type(panel_t), allocatable :: panels(:)
        character(name_length) :: names(1 + system%ndof)
        character(16) :: units(1 + system%ndof)
        character(240) :: header(1)
        type(value_range_t) :: ranges(1 + system%ndof)
        type(series_t), allocatable :: series(:)
        real(dp) :: row(1 + system%ndof)
        real(dp) :: shape(system%ndof)
        real(dp) :: t, rate, factor, duration
        character(:), allocatable :: heading, path
        logical :: resting
        integer :: k

        call system%describe(d)
        names(1) = "t"
        names(2:) = d%coordinates%name
        units(1) = "s"
        units(2:) = d%coordinates%unit
        path = mode_path(stem, j)
        heading = title//", mode "//to_text(j)//": omega^2 = "
        header(1) = heading//to_text(modes%omega2(j) + 0.0_dp)//" s^-2"  ! no sign of a zero
        call table%file%open(path, error)
        if (allocated(error)) return
        call table%begin(header, names, units, error)
        if (allocated(error)) return
        rate = sqrt(abs(modes%omega2(j)))
        resting = stays(modes, j)
        duration = 1.0_dp
        if (modes%label(j) == is_oscillation) duration = 2.0_dp*acos(-1.0_dp)/rate
        if (modes%label(j) == is_unstable) duration = 2.0_dp/rate
        do k = 0, samples
            t = duration*k/samples
            factor = t
            if (modes%label(j) == is_zero_mode .and. resting) factor = 1.0_dp
            if (modes%label(j) == is_oscillation) factor = cos(rate*t)
            if (modes%label(j) == is_unstable) factor = cosh(rate*t)
            row(1) = t
            shape = factor*modes%shapes(:, j)
            if (allocated(modes%quadrature) .and. modes%label(j) == is_oscillation) then
                shape = shape - sin(rate*t)*modes%quadrature(:, j)
            end if
            row(2:) = modes%at + 0.1_dp/maxval(abs(modes%shapes(:, j)))*shape
            call ranges%see(row)
            call table%row(row)
        end do
        call new_panels([character(1) ::], names, units, panels, error)
        if (.not. allocated(error)) call table%finish("rows: "//to_text(samples + 1), error)
        if (allocated(error)) call table%file%abandon()
        if (allocated(error)) return
        call script%open(script_path(path), error)
        if (allocated(error)) call table%file%abandon()
        if (allocated(error)) return
        allocate (series(1))
        call new_series(series(1), path(index(path, "/", back=.true.) + 1:), "", names, units, &
                        ranges)
        call script%write(gnuplot_script(series(1)%file, series, heading// &
                                         rounded(modes%omega2(j) + 0.0_dp, digits)//" s^-2", "", &
                                         panels))
        call commit_both(table%file, script, error)
    end subroutine write_mode
end module lagrangia_modes_files
