module lagrangia_picture_files
    !! A table worth a picture as files: the data, and the gnuplot script beside it.
    use lagrangia_errors, only: error_t
    use lagrangia_gnuplot, only: gnuplot_script, new_panels, panel_t
    use lagrangia_output_file, only: commit_both, output_file_t, refuse_unwritable
    use lagrangia_places, only: places_t
    use lagrangia_report, only: heading_length, picture_t
    use lagrangia_scene_claims, only: claim_table
    use lagrangia_scene_files, only: data_path, script_path
    use lagrangia_text, only: to_text
    use lagrangia_text_table, only: text_table_t
    use lagrangia_version, only: build_text, version
    implicit none (type, external)
    private
    public :: check_picture, write_picture

contains

    subroutine check_picture(name, folder, error)
        !! Fails where `write_picture` could not write now: to be asked before a long computation.
        character(*), intent(in) :: name  !! of the files, without ending
        character(*), intent(in) :: folder
        type(error_t), allocatable, intent(out) :: error
        type(places_t) :: places
        character(:), allocatable :: path

        path = data_path(folder, name, "text")
        call claim_table(path, "data", "", places, error)
        if (.not. allocated(error)) call refuse_unwritable(path, error)
        if (.not. allocated(error)) call refuse_unwritable(script_path(path), error)
    end subroutine check_picture

    subroutine write_picture(picture, folder, path, error)
        !! Write `folder/NAME.dat` and `folder/NAME.gp`; `path` is the data file, "" without one.
        type(picture_t), intent(in) :: picture
        character(*), intent(in) :: folder
        character(:), allocatable, intent(out) :: path
        type(error_t), allocatable, intent(out) :: error
        type(text_table_t) :: table
        type(output_file_t) :: script
        type(panel_t), allocatable :: panels(:)
        character(2*heading_length) :: header(2)
        integer :: i

        path = ""
        if (picture%file == "") return
        call new_panels(picture%panels, picture%names, picture%units, panels, error)
        if (allocated(error)) return
        path = data_path(folder, trim(picture%file), "text")
        header(1) = "lagrangia "//version//": "//picture%title
        header(2) = "build: "//build_text()
        call table%file%open(path, error)
        if (allocated(error)) return
        call table%begin(header, picture%names, picture%units, error)
        if (allocated(error)) return
        do i = 1, size(picture%values, 2)
            call table%row(picture%values(:, i))
        end do
        call table%finish("rows: "//to_text(size(picture%values, 2)), error)
        if (allocated(error)) return
        call script%open(script_path(path), error)
        if (allocated(error)) call table%file%abandon()
        if (allocated(error)) return
        call script%write(gnuplot_script(trim(picture%file)//".dat", table%reading(), &
                                         trim(picture%title), picture%names, picture%units, &
                                         minval(picture%values, 2), maxval(picture%values, 2), &
                                         panels))
        call commit_both(table%file, script, error)
    end subroutine write_picture
end module lagrangia_picture_files
