module lagrangia_overlay
    !! Several runs in one picture: a script that draws their data files together, and what the
    !! runs of a comparison are.
    use lagrangia_changed_scene, only: ending_start
    use lagrangia_columns, only: column_names
    use lagrangia_command_line, only: word_t
    use lagrangia_data_files, only: data_path, script_path
    use lagrangia_description, only: description_t, name_length
    use lagrangia_errors, only: error_t, fail
    use lagrangia_gnuplot, only: gnuplot_script, new_panels, new_series, panel_t, series_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_methods, only: adaptive_names, method_names, method_titles
    use lagrangia_names, only: refuse_name
    use lagrangia_output_file, only: output_file_t
    use lagrangia_plot_label, only: is_small
    use lagrangia_record, only: sample_record_t
    use lagrangia_reference, only: reference_t
    use lagrangia_scene, only: expectation_t, scene_t
    use lagrangia_system, only: system_t
    use lagrangia_text, only: lower
    implicit none (type, external)
    private
    public :: add_to_overlay, common_panels, compare_methods, compare_starts, most_coordinates, &
              overlay_path, overrides_for, run_name, write_overlay

    integer, parameter :: most_coordinates = 3  !! with a panel each
    integer, parameter :: most_panels = 6
    real(dp), parameter :: usual_tolerance = 1e-10_dp
    real(dp), parameter :: longest_step = 0.01_dp     !! s, that is taken where none is given
    integer(i8), parameter :: most_steps = 1000000_i8  !! that are taken for it

contains

    pure function run_name(output, word) result(name)
        !! The data file of one run of a comparison: `pendulum_rk4`, whatever ending the scene's
        !! has.
        character(*), intent(in) :: output  !! of the scene
        character(*), intent(in) :: word    !! of the run
        character(:), allocatable :: name

        name = output(:ending_start(output) - 1)//"_"//word
    end function run_name

    pure function overlay_path(folder, name) result(path)
        !! Where the data file of the picture would be, if it had one of its own.
        character(*), intent(in) :: folder  !! of all files
        character(*), intent(in) :: name    !! of the picture, without ending
        character(:), allocatable :: path

        path = data_path(folder, name, "text")
    end function overlay_path

    subroutine compare_methods(scene, system, method, error)
        !! Make `scene` one of a comparison: by that method, with columns for its motion, a drift
        !! and the error, unjudged. A method that needs a tolerance where the scene has a step gets
        !! one, and a step where it has a tolerance: that between two samples, or a part of it.
        type(scene_t), intent(inout) :: scene   !! as it was read
        class(system_t), intent(in) :: system   !! with the scene's parameters
        character(*), intent(in) :: method      !! any word
        type(error_t), allocatable, intent(out) :: error  !! there is no such method
        class(reference_t), allocatable :: closed_form
        type(expectation_t), allocatable :: kept(:)
        character(name_length), allocatable :: adaptive(:), names(:)
        type(description_t) :: d
        integer :: i
        logical :: adapts, steps  ! it takes a tolerance, a step
        logical :: known          ! the closed form of the states

        steps = any(method_names() == method)
        adapts = any(adaptive_names() == method)
        if (.not. (steps .or. adapts)) then
            names = method_names()
            adaptive = adaptive_names()
            do i = 1, size(adaptive)
                if (.not. any(names == adaptive(i))) names = [character(name_length) :: names, &
                                                              adaptive(i)]
            end do
            call refuse_name("method", method, names, error, method_titles(names))
            return
        end if
        scene%method = method
        scene%output = run_name(trim(scene%output), method)
        if (scene%tolerance <= 0.0_dp .and. .not. steps) then
            scene%tolerance = usual_tolerance
            scene%samples = max(1_i8, nint(scene%duration/(scene%dt*scene%every), i8))
        else if (scene%tolerance > 0.0_dp .and. .not. adapts) then
            scene%tolerance = 0.0_dp
            scene%every = max(1_i8, min(most_steps/scene%samples, &
                              ceiling(min(scene%duration/scene%samples/longest_step, &
                                          real(most_steps, dp)), i8)))
            scene%dt = scene%duration/scene%samples/scene%every
        end if
        call system%closed_form(scene%t0, scene%q, scene%v, closed_form)
        call system%describe(d)
        names = [character(name_length) :: "t", &
                 d%coordinates(:min(size(d%coordinates), most_coordinates))%name]
        ! An impact takes energy, which is no error of a method.
        if (system%contacts == 0) call add_drift(column_names(system, .false.), names)
        ! Where no closed form is known the error is that beside a finer run, if the scene has it.
        kept = pack(scene%expectations, scene%expectations%name == "error" .and. &
                    system%contacts == 0)
        kept%judged = .false.
        known = .false.
        if (allocated(closed_form)) known = closed_form%has_state
        if (known) kept = kept(:0)
        if (known .or. size(kept) > 0) names = [character(name_length) :: names, "error"]
        call unjudged(scene, names)
        call move_alloc(kept, scene%expectations)
    end subroutine compare_methods

    subroutine overrides_for(given, methods, method, overrides)
        !! What is set for one method of a comparison: a step is for those that take steps, and a
        !! tolerance for those that keep one. A method that can do both keeps the tolerance if both
        !! are set. What no method of them takes stays, to be refused.
        type(word_t), intent(in) :: given(:)    !! the words behind `--set`
        type(word_t), intent(in) :: methods(:)  !! of the comparison, any words
        character(*), intent(in) :: method      !! one of them
        type(word_t), allocatable, intent(out) :: overrides(:)  !! the method is among them if it
        !! has something of its own
        character(name_length), allocatable :: adaptive(:), fixed(:)
        logical :: dropped(size(given)), is_method(size(given)), is_step(size(given)), &
                   is_tolerance(size(given))
        logical :: adapts, own, steps
        integer :: i

        allocate (adaptive, source=adaptive_names())
        allocate (fixed, source=method_names())
        steps = any(fixed == method)
        adapts = any(adaptive == method)
        do i = 1, size(given)
            is_method(i) = key(given(i)%text) == "scene%method"
            is_step(i) = key(given(i)%text) == "scene%dt" .or. key(given(i)%text) == "scene%every"
            is_tolerance(i) = key(given(i)%text) == "scene%tolerance"
        end do
        dropped = .false.
        if (adapts .and. any(is_tolerance)) then
            dropped = is_step
        else if (steps .and. any(is_step)) then
            dropped = is_tolerance
        else
            if (any([(any(fixed == methods(i)%text), i=1, size(methods))])) dropped = is_step
            if (any([(any(adaptive == methods(i)%text), i=1, size(methods))])) then
                dropped = dropped .or. is_tolerance
            end if
        end if
        own = (steps .and. any(is_step .and. .not. dropped)) .or. &
              (adapts .and. any(is_tolerance .and. .not. dropped))
        if (own) dropped = dropped .or. is_method
        allocate (overrides(count(.not. dropped) + merge(1, 0, own)))
        if (own) overrides(size(overrides))%text = "scene%method="//method
        overrides(:count(.not. dropped)) = pack(given, .not. dropped)
    contains
        pure function key(text) result(name)
            !! In front of `=`, in lower case and without blanks.
            character(*), intent(in) :: text
            character(:), allocatable :: name
            integer :: k

            name = ""
            do k = 1, index(text//"=", "=") - 1
                if (text(k:k) /= " ") name = name//lower(text(k:k))
            end do
        end function key
    end subroutine overrides_for

    pure subroutine add_drift(all, names)
        !! That of the energy, or the first one that there is.
        character(*), intent(in) :: all(:)
        character(name_length), allocatable, intent(inout) :: names(:)
        integer :: i

        i = findloc(all == "energy_drift", .true., 1)
        if (i == 0) i = findloc(index(all, "_drift") > 0, .true., 1)
        if (i > 0) names = [character(name_length) :: names, all(i)]
    end subroutine add_drift

    subroutine compare_starts(scene, system, start, word)
        !! Make `scene`, which has another start, one of a comparison: with columns for its
        !! coordinates and their velocities, unjudged; its title says the start.
        type(scene_t), intent(inout) :: scene  !! with its start
        class(system_t), intent(in) :: system  !! with the scene's parameters
        character(*), intent(in) :: start      !! `Q1,Q2` or `Q1,Q2:V1,V2`
        character(*), intent(in) :: word       !! in the name of its file
        character(name_length), allocatable :: names(:)
        type(description_t) :: d
        integer :: i

        call system%describe(d)
        allocate (names(1))
        names(1) = "t"
        do i = 1, min(size(d%coordinates), most_coordinates)
            names = [character(name_length) :: names, d%coordinates(i)%name, &
                     trim(d%coordinates(i)%name)//"_dot"]
        end do
        scene%output = run_name(trim(scene%output), word)
        scene%title = trim(scene%system)//" from q = "//start
        i = index(start, ":")
        if (i > 0) scene%title = trim(scene%system)//" from q = "//start(:i - 1)//", v = "// &
                                 start(i + 1:)
        if (allocated(scene%changes)) scene%title = trim(scene%title)//" ("//scene%changes//")"
        call unjudged(scene, names)
        deallocate (scene%expectations)
        allocate (scene%expectations(0))
    end subroutine compare_starts

    subroutine unjudged(scene, names)
        !! With these columns, and nothing that belongs to others.
        type(scene_t), intent(inout) :: scene
        character(name_length), intent(in) :: names(:)

        scene%columns = names
        deallocate (scene%plots)
        allocate (scene%plots(0))
        scene%period_of = ""
        scene%modes = .false.
        scene%error_estimate = .false.
        if (allocated(scene%file)) deallocate (scene%file)
    end subroutine unjudged

    subroutine add_to_overlay(series, path, picture, record, name)
        !! One more data file.
        type(series_t), intent(inout) :: series       !! becomes that of the file
        character(*), intent(in) :: path              !! of the data file, in the picture's folder
        character(*), intent(in) :: picture           !! as `overlay_path` has it
        type(sample_record_t), intent(in) :: record   !! of the run, when it has ended
        character(*), intent(in) :: name              !! in the legend

        call new_series(series, path(index(picture, "/", back=.true.) + 1:), &
                        record%table%reading(), record%columns%names(record%shown), &
                        record%columns%units(record%shown), record%ranges, name)
    end subroutine add_to_overlay

    subroutine common_panels(series, panels, over, left_out, error)
        !! One panel a column of the first file that another one has, too, drifts and errors last;
        !! `over` `starts`, each velocity over its coordinate.
        type(series_t), intent(in) :: series(:)  !! data files
        type(panel_t), allocatable, intent(out) :: panels(:)  !! of the first file
        character(*), intent(in) :: over         !! `time` or `starts`
        character(:), allocatable, intent(out) :: left_out
        !! names of common columns that the picture has no room for, commas between them
        type(error_t), allocatable, intent(out) :: error  !! the files have only the time in common
        character(140), allocatable :: specs(:)
        logical :: small
        integer :: i, k, turn

        left_out = ""
        allocate (specs(0))
        associate (names => series(1)%names)
            do turn = 1, 2
                do i = 2, size(names)
                    small = is_small(names(i))
                    if (small .neqv. turn == 2) cycle
                    if (over /= "time") then
                        if (any(names == trim(names(i))//"_dot")) specs = &
                            [character(140) :: specs, trim(names(i))//":"//trim(names(i))//"_dot"]
                        cycle
                    end if
                    do k = 2, size(series)
                        if (any(series(k)%names == names(i) .and. &
                                series(k)%units == series(1)%units(i))) exit
                    end do
                    if (k > size(series)) cycle
                    if (size(specs) < most_panels) then
                        specs = [character(140) :: specs, names(i)]
                    else
                        if (left_out /= "") left_out = left_out//", "
                        left_out = left_out//trim(names(i))
                    end if
                end do
            end do
            if (size(specs) == 0) then
                call fail(error, "these runs have no column in common but the time")
                return
            end if
            call new_panels(specs, names, series(1)%units, panels, error)
        end associate
    end subroutine common_panels

    subroutine write_overlay(folder, name, series, panels, title, remark, error)
        !! The script `folder/NAME.gp`.
        character(*), intent(in) :: folder, name  !! of all files; of the picture, without ending
        type(series_t), intent(in) :: series(:)   !! data files in the folder
        type(panel_t), intent(in) :: panels(:)    !! of the first one's columns
        character(*), intent(in) :: title, remark  !! of the picture; below it
        type(error_t), allocatable, intent(out) :: error  !! of the file
        type(output_file_t) :: script
        character(:), allocatable :: path

        path = overlay_path(folder, name)
        call script%open(script_path(path), error)
        if (allocated(error)) return
        call script%write(gnuplot_script(path(index(path, "/", back=.true.) + 1:), series, title, &
                                         remark, panels))
        call script%complete(error)
        if (.not. allocated(error)) call script%commit(error)
    end subroutine write_overlay
end module lagrangia_overlay
