module lagrangia_compare
    !! `lagrangia compare SCENE`: one scene by several methods, or from several starts, in one table
    !! and one picture.
    use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
    use lagrangia_animation, only: animate_both
    use lagrangia_changed_scene, only: make_own_scene
    use lagrangia_command_line, only: command_line_t, word_t
    use lagrangia_console, only: line_width, note, put_line
    use lagrangia_data_files, only: check_format, film_path, script_path
    use lagrangia_degrees, only: degrees_warning
    use lagrangia_description, only: description_t
    use lagrangia_errors, only: error_t, fail, is_signal
    use lagrangia_gnuplot, only: panel_t, series_t
    use lagrangia_json, only: json_line
    use lagrangia_kinds, only: dp
    use lagrangia_observer, only: observer_t
    use lagrangia_outcome, only: outcome_json, outcome_t
    use lagrangia_output_file, only: refuse_unwritable
    use lagrangia_output_options, only: is_told, show_picture, take_folder, take_picture
    use lagrangia_overlay, only: add_to_overlay, common_panels, compare_methods, compare_starts, &
                                 most_coordinates, overlay_path, overrides_for, run_name, &
                                 write_overlay
    use lagrangia_places, only: places_t
    use lagrangia_printed_table, only: cell_t, count_cell, number_cell, printed_table_t, &
                                       word_cell
    use lagrangia_progress, only: progress_t
    use lagrangia_run_files, only: method_text
    use lagrangia_run_plan, only: new_run_plan, run_plan_t
    use lagrangia_scene, only: heading, scene_t
    use lagrangia_scene_claims, only: claim_files, claim_picture, claim_scene, size_warning
    use lagrangia_scene_reader, only: read_scene
    use lagrangia_scene_run, only: run_scene
    use lagrangia_shipped, only: find_scene
    use lagrangia_system, only: system_t
    use lagrangia_text, only: quoted, to_text
    implicit none (type, external)
    private
    public :: compare_command

    integer, parameter :: most_runs = 64

    type :: compared_t
        !! One run of the comparison.
        type(run_plan_t) :: plan
        type(word_t) :: name  !! in the legend
    end type compared_t

contains

    subroutine compare_command(line, error)
        !! Plan all runs before any of them goes; then run them, print a row each, and write the
        !! script that draws them together. What fails ends the comparison.
        type(command_line_t), intent(in) :: line  !! what was typed
        type(error_t), allocatable, intent(out) :: error  !! allocated where it fails
        type(compared_t), allocatable :: runs(:)
        type(outcome_t), allocatable :: outcomes(:)
        type(series_t), allocatable :: series(:)
        type(panel_t), allocatable :: panels(:)
        character(:), allocatable :: folder, format, kind, left_out, name, remark, title
        integer :: i

        if (size(line%arguments) == 0) then
            call fail(error, "compare what? 'lagrangia compare pendulum --methods rk4,verlet'; "// &
                      "'lagrangia list scenes' shows the names")
        else if (line%has("methods") .eqv. line%has("starts")) then
            call fail(error, "compare by what? --methods rk4,verlet or --starts ""0.5 1 2"""// &
                      trim(merge(", not by both at once", "                     ", &
                                 line%has("methods"))))
        else if (line%has("animate") .and. .not. line%has("methods")) then
            call fail(error, "--animate: a film shows two methods of one motion; --methods "// &
                      "names them")
        end if
        if (allocated(error)) return
        format = line%value_of("format", "text")
        call check_format(format, error)
        if (allocated(error)) return
        call take_folder(line, folder, error)
        if (allocated(error)) return
        call take_picture(line, kind, error)
        if (allocated(error)) return
        call plan_runs(line, folder, format, runs, name, error)
        if (allocated(error)) return
        allocate (outcomes(size(runs)), series(size(runs)))
        if (line%has("starts") .and. .not. line%has("quiet")) call warn_of_degrees(runs)
        call run_all(line, folder, format, runs, outcomes, error)
        if (allocated(error)) return
        do i = 1, size(runs)
            call add_to_overlay(series(i), outcomes(i)%file, overlay_path(folder, name), &
                                runs(i)%plan%record, runs(i)%name%text)
        end do
        call common_panels(series, panels, trim(merge("starts", "time  ", line%has("starts"))), &
                           left_out, error)
        if (allocated(error)) return
        remark = ""
        title = heading(runs(1)%plan%scene)
        if (line%has("starts")) then
            remark = method_text(runs(1)%plan%settled)
            title = trim(runs(1)%plan%scene%system)//" from "//to_text(size(runs))//" starts"
            if (allocated(runs(1)%plan%scene%changes)) title = title//" ("// &
                runs(1)%plan%scene%changes//")"
        end if
        call write_overlay(folder, name, series, panels, title, remark, error)
        if (allocated(error)) return
        call put_results(line, title, runs, outcomes)
        i = runs(1)%plan%system%ndof
        if (is_told(line) .and. i > most_coordinates) call put_line("of "//to_text(i)// &
            " coordinates the files and the picture have the first "//to_text(most_coordinates))
        if (is_told(line)) call put_line("gnuplot script: "// &
                                         script_path(overlay_path(folder, name)))
        if (line%has("plot")) call show_picture(overlay_path(folder, name), kind, line, error)
        if (.not. line%has("animate") .or. allocated(error)) return
        call animate_both(runs(1)%plan, runs(2)%plan, film_path(overlay_path(folder, name)), error)
        if (allocated(error) .or. .not. is_told(line)) return
        call put_line("film: "//film_path(overlay_path(folder, name)))
    end subroutine compare_command

    subroutine warn_of_degrees(runs)
        !! The first start that may be meant as degrees is answered with its radians.
        type(compared_t), intent(in) :: runs(:)
        character(:), allocatable :: warning
        integer :: i

        do i = 1, size(runs)
            warning = degrees_warning(runs(i)%plan%scene, runs(i)%plan%system)
            if (warning == "") cycle
            call note(warning)
            return
        end do
    end subroutine warn_of_degrees

    subroutine plan_runs(line, folder, format, runs, name, error)
        !! Every run and every file; nothing is run if one is wrong or a file would be lost.
        type(command_line_t), intent(in) :: line
        character(*), intent(in) :: folder, format
        type(compared_t), allocatable, intent(out) :: runs(:)
        character(:), allocatable, intent(out) :: name  !! of the picture, without ending
        type(error_t), allocatable, intent(out) :: error
        type(word_t), allocatable :: words(:)
        type(places_t) :: places
        character(:), allocatable :: path
        integer :: i

        if (line%has("methods")) then
            call split(line%value_of("methods", ""), ",", "--methods", "names with commas "// &
                       "between them: rk4,verlet", words, error)
        else
            call split(line%value_of("starts", ""), " ", "--starts", "Q1,Q2,... each, perhaps "// &
                       "with :V1,V2,..., and blanks between them", words, error)
        end if
        if (allocated(error)) return
        if (line%has("animate") .and. size(words) /= 2) call fail(error, "--animate: a film "// &
            "shows two methods, not "//to_text(size(words)))
        if (.not. allocated(error)) call find_scene(line%arguments(1)%text, path, error)
        if (allocated(error)) return
        allocate (runs(size(words)))
        do i = 1, size(words)
            call plan_run(line, path, words, i, runs(i), name, error)
            if (.not. allocated(error) .and. i == 1) call claim_scene(runs(1)%plan%scene, places, &
                                                                      error)
            if (.not. allocated(error)) call claim_files(runs(i)%plan%scene, runs(i)%plan%system, &
                                                         folder, format, places, error)
            if (allocated(error)) return
        end do
        call claim_picture(overlay_path(folder, name), "overlay", "", places, error)
        if (line%has("animate") .and. .not. allocated(error)) call places%add( &
            film_path(overlay_path(folder, name)), "film", "", error)
        if (.not. allocated(error)) call refuse_unwritable( &
            script_path(overlay_path(folder, name)), error)
        if (line%has("animate") .and. .not. allocated(error)) call refuse_unwritable( &
            film_path(overlay_path(folder, name)), error)
    end subroutine plan_runs

    subroutine plan_run(line, path, words, number, run, name, error)
        !! One run: of a method, or from a start.
        type(command_line_t), intent(in) :: line
        character(*), intent(in) :: path
        type(word_t), intent(in) :: words(:)  !! of all runs
        integer, intent(in) :: number
        type(compared_t), intent(out) :: run
        character(:), allocatable, intent(out) :: name
        type(error_t), allocatable, intent(out) :: error
        type(word_t), allocatable :: overrides(:)
        class(system_t), allocatable :: system
        type(description_t) :: d
        type(scene_t) :: scene
        character(:), allocatable :: word

        word = words(number)%text
        if (line%has("methods")) then
            call overrides_for(line%values_of("set"), words, word, overrides)
        else
            call overrides_of(line, word, overrides)
        end if
        call read_scene(path, overrides, scene, system, error)
        if (allocated(error)) then
            if (line%has("starts")) call error%add_context("start "//quoted(word))
            return
        end if
        call system%describe(d)
        call make_own_scene(scene, line%values_of("set"), (d%parameters%name))
        if (line%has("methods")) then
            name = run_name(trim(scene%output), "methods")
            call compare_methods(scene, system, word, error)
        else
            name = run_name(trim(scene%output), "starts")
            call compare_starts(scene, system, word, "start_"//to_text(number))
        end if
        if (allocated(error)) return
        call new_run_plan(run%plan, scene, system, error)
        if (allocated(error)) then
            if (line%has("starts")) word = "start "//quoted(word)
            if (line%has("methods")) word = quoted(word)
            call error%add_context(word)
            return
        end if
        run%name%text = word
        if (line%has("methods")) run%name%text = method_text(run%plan%settled)
    end subroutine plan_run

    pure subroutine overrides_of(line, word, overrides)
        !! Those of `--set`, and those of the start `Q1,Q2[:V1,V2]`.
        type(command_line_t), intent(in) :: line
        character(*), intent(in) :: word
        type(word_t), allocatable, intent(out) :: overrides(:)
        type(word_t), allocatable :: given(:)
        integer :: colon, n

        allocate (given(0))  ! gfortran 12 would warn of its bounds
        given = line%values_of("set")
        n = size(given)
        colon = index(word, ":")
        allocate (overrides(n + merge(2, 1, colon > 0)))
        overrides(:n) = given
        if (colon == 0) colon = len(word) + 1
        overrides(n + 1)%text = "scene%q="//word(:colon - 1)
        if (colon <= len(word)) overrides(n + 2)%text = "scene%v="//word(colon + 1:)
    end subroutine overrides_of

    pure subroutine split(text, separator, option, form, words, error)
        !! Two words at least, each once.
        character(*), intent(in) :: text, separator, option, form
        type(word_t), allocatable, intent(out) :: words(:)
        type(error_t), allocatable, intent(out) :: error
        type(word_t) :: found(most_runs)
        integer :: first, i, last, n

        n = 0
        first = 1
        do while (first <= len(text) + 1)
            last = index(text(first:)//separator, separator) + first - 2
            if (last >= first .or. separator /= " ") then
                if (n == most_runs) then
                    call fail(error, option//": more than "//to_text(most_runs)//" runs")
                    return
                end if
                n = n + 1
                found(n)%text = trim(adjustl(text(first:last)))
                do i = 1, n - 1
                    if (found(i)%text == found(n)%text) then
                        call fail(error, option//": "//quoted(found(n)%text)// &
                                  " is given twice; "//form)
                        return
                    end if
                end do
            end if
            first = last + 2
        end do
        if (n < 2) then
            call fail(error, option//": two at least are needed, to be compared; "//form)
            return
        end if
        allocate (words(n))
        words(:) = found(:n)
    end subroutine split

    subroutine run_all(line, folder, format, runs, outcomes, error)
        !! One after the other.
        type(command_line_t), intent(in) :: line
        character(*), intent(in) :: folder, format
        type(compared_t), intent(inout) :: runs(:)
        type(outcome_t), intent(inout) :: outcomes(:)
        type(error_t), allocatable, intent(out) :: error
        type(progress_t), target :: progress
        class(observer_t), pointer :: observer
        character(:), allocatable :: much
        integer :: i

        observer => progress
        do i = 1, size(runs)
            much = size_warning(runs(i)%plan%scene, folder, format)
            if (much /= "" .and. .not. line%has("quiet")) call note(runs(i)%name%text//": "//much)
            call progress%restart(trim(runs(i)%name%text), line%has("quiet"))
            call run_scene(runs(i)%plan, folder, format, observer, outcomes(i), error)
            call progress%clear()
            if (allocated(error)) then
                if (.not. is_signal(error)) call error%add_context(runs(i)%name%text)
                return
            end if
            outcomes(i)%warning = much
        end do
    end subroutine run_all

    subroutine put_results(line, title, runs, outcomes)
        !! A row each.
        type(command_line_t), intent(in) :: line
        character(*), intent(in) :: title
        type(compared_t), intent(in) :: runs(:)
        type(outcome_t), intent(in) :: outcomes(:)
        type(printed_table_t) :: table
        type(word_t), allocatable :: lines(:)
        character(16) :: names(6)
        type(cell_t) :: cells(6)
        integer, allocatable :: shown(:)
        integer :: i

        if (line%has("json")) then
            call put_line("[")
            do i = 1, size(runs)
                call put_line(json_line(outcome_json(outcomes(i)), i < size(runs)))
            end do
            call put_line("]")
            return
        end if
        if (line%has("quiet")) return
        names = [character(16) :: "method", "steps", "evaluations", "drift", "error", "seconds"]
        shown = [(i, i=1, size(names))]
        if (line%has("starts")) then  ! each is a motion of its own: there is nothing to compare
            names(1) = "start"
            shown = [1, 2, 3, 6]
        end if
        call table%begin("compare", title, names(shown))
        do i = 1, size(runs)
            cells = [word_cell(runs(i)%name%text), count_cell(outcomes(i)%steps), &
                     count_cell(outcomes(i)%evaluations), drift_cell(outcomes(i)), &
                     error_cell(outcomes(i)), number_cell(outcomes(i)%seconds, 2)]
            call table%add(cells(shown))
        end do
        call put_line(trim(table%title))
        call table%lines(line_width() - 2, lines)
        do i = 1, size(lines)
            call put_line(repeat(" ", merge(2, 0, lines(i)%text /= ""))//lines(i)%text)
        end do
    end subroutine put_results

    pure function drift_cell(outcome) result(cell)
        !! Of the one invariant that is looked at.
        type(outcome_t), intent(in) :: outcome
        type(cell_t) :: cell

        cell = number_cell(ieee_value(1.0_dp, ieee_quiet_nan), 2)
        if (size(outcome%drifts) > 0) cell = number_cell(outcome%drifts(1)%value, 2)
    end function drift_cell

    pure function error_cell(outcome) result(cell)
        !! Of the coordinates.
        type(outcome_t), intent(in) :: outcome
        type(cell_t) :: cell

        cell = number_cell(ieee_value(1.0_dp, ieee_quiet_nan), 2)
        if (outcome%error() >= 0.0_dp) cell = number_cell(outcome%error(), 2)
    end function error_cell
end module lagrangia_compare
