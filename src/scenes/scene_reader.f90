module lagrangia_scene_reader
    !! From a scene file to a scene and its system. What the text alone shows to be wrong is refused
    !! here; what only a method or a column shows, where the run is planned (`lagrangia_run_plan`).
    use, intrinsic :: ieee_arithmetic, only: ieee_is_nan, ieee_quiet_nan, ieee_value
    use lagrangia_catalogue, only: new_system, system_names
    use lagrangia_command_line, only: word_t
    use lagrangia_constrained_system, only: constrained_system_t, new_constrained_system
    use lagrangia_description, only: described_by, description_t, figure_length, name_length
    use lagrangia_errors, only: error_t, fail
    use lagrangia_formula_start, only: check_formulas_at_start
    use lagrangia_kinds, only: dp
    use lagrangia_lagrangian_group, only: formula_group => group, formula_lines, read_formulas, &
                                          read_values, refuse_formula
    use lagrangia_namelist, only: apply_override, get_reals, get_string, has_group, has_key, &
                                  namelist_t, parse_namelist, refuse_unknown_groups, &
                                  refuse_unknown_keys, refuse_value
    use lagrangia_names, only: nearest_name
    use lagrangia_overridden_keys, only: fit_columns, fit_times
    use lagrangia_parameter_keys, only: refuse_parameter, refuse_unknown_parameters
    use lagrangia_scene, only: scene_t
    use lagrangia_scene_keys, only: coordinates, drift_keys, expectation_keys, key_length, keys, &
                                    read_columns, read_state, read_times
    use lagrangia_shipped, only: file_advice, find_scene, looks_like_path, names_file, scene_name
    use lagrangia_shipped_files, only: read_file_or_shipped
    use lagrangia_sweep_group, only: read_sweep_group, sweep_group => group
    use lagrangia_system, only: check_parameter, default_values, system_t
    use lagrangia_text, only: lower, quoted
    use lagrangia_unquoted_text, only: ask_for_quotes, refuse_unquoted, texts_of
    use lagrangia_usual_keys, only: refuse_usual_names
    use lagrangia_written_expressions, only: read_expressions, unused_parameters, &
                                             written_expressions_t
    use lagrangia_written_formulas, only: written_formulas_t
    use lagrangia_written_system, only: new_written_system, written_system_t
    implicit none (type, external)
    private
    public :: read_scene, read_named_system, read_unchanged, names_scene, parse_scene

contains

    subroutine read_scene(path, overrides, scene, system, error)
        !! Read the file at `path`; `overrides` are the words behind `--set`.
        character(*), intent(in) :: path  !! of a readable file, or of one that the program carries
        type(word_t), intent(in) :: overrides(:)  !! they come after the file's values
        type(scene_t), intent(out) :: scene  !! remembers the place of each key
        class(system_t), allocatable, intent(out) :: system  !! with the scene's parameters
        type(error_t), allocatable, intent(out) :: error  !! names file, line and key
        character(:), allocatable :: text

        call read_file_or_shipped(path, text, error)
        if (allocated(error)) return
        call parse_scene(text, path, overrides, scene, system, error)
    end subroutine read_scene

    subroutine read_named_system(name, overrides, system, error, figure, label, source)
        !! The system called `name`, its parameters set by the words behind `--set`; or that of the
        !! scene `name`, with the scene's parameters.
        character(*), intent(in) :: name  !! as 'list' shows it, or a path
        type(word_t), intent(in) :: overrides(:)  !! of a system its parameters only
        class(system_t), allocatable, intent(out) :: system  !! with these parameters
        type(error_t), allocatable, intent(out) :: error  !! unknown, or a parameter is not allowed
        character(figure_length), allocatable, intent(out), optional :: figure(:)
        !! parts that the scene draws it by; none: the system's own
        character(:), allocatable, intent(out), optional :: label  !! the scene's name, or `name`
        character(:), allocatable, intent(out), optional :: source  !! the scene's file, or ""
        character(:), allocatable :: path, text
        type(namelist_t) :: tree
        type(scene_t) :: scene
        integer :: i

        if (present(figure)) allocate (figure(0))
        if (present(label)) label = name
        if (present(source)) source = ""
        if (names_scene(name)) then
            call find_scene(name, path, error)
            if (present(source)) source = path
            if (.not. allocated(error)) call read_scene(path, overrides, scene, system, error)
            if (allocated(error)) return
            if (present(figure)) figure = scene%figure
            if (present(label)) label = trim(scene%name)
            return
        end if
        call new_system(name, system, error)
        if (allocated(error)) then
            if (names_file(name)) error%message = "unknown system "//quoted(name)// &
                                                  file_advice(name)
            return
        end if
        text = "&scene system = '"//name//"' / &"//name//" /"  ! a group for remedies that name it
        call parse_namelist(text, name, tree, error)
        if (allocated(error)) return
        do i = 1, size(overrides)
            call apply_override(tree, overrides(i)%text, error)
            if (allocated(error)) return
        end do
        call read_system(tree, scene, system, error)
        if (allocated(error)) return
        if (scene%system /= name) call refuse_value(tree, "scene", "system", "is not the "// &
            quoted(name)//" that was named", error)
        if (allocated(error)) return
        call refuse_unknown_keys(tree, "scene", [character(name_length) ::], error)
        if (allocated(error)) return
        call refuse_unknown_groups(tree, [scene%system], error)
    end subroutine read_named_system

    function names_scene(name) result(yes)
        !! Is `name` a path, or that of a shipped scene and of no system?
        character(*), intent(in) :: name  !! what was typed
        logical :: yes
        character(:), allocatable :: path
        type(error_t), allocatable :: error

        yes = looks_like_path(name)
        if (yes) return
        if (any(system_names() == name)) return
        call find_scene(name, path, error)
        yes = .not. allocated(error)
    end function names_scene

    subroutine parse_scene(text, source, overrides, scene, system, error)
        !! The scene in `text`, which came from the file `source`.
        character(*), intent(in) :: text  !! a namelist, lines between line feeds
        character(*), intent(in) :: source  !! its name, for messages
        type(word_t), intent(in) :: overrides(:)  !! they come after the text's values
        type(scene_t), intent(out) :: scene  !! remembers the place of each key
        class(system_t), allocatable, intent(out) :: system  !! with the scene's parameters
        type(error_t), allocatable, intent(out) :: error  !! names file, line and key
        type(namelist_t), allocatable :: tree
        character(key_length), allocatable :: allowed(:)
        integer :: i

        allocate (tree)
        call parse_namelist(text, source, tree, error)
        if (allocated(error)) then
            call ask_for_quotes(tree, error)
        else
            call refuse_unquoted(tree, error)
        end if
        if (allocated(error)) return
        do i = 1, size(overrides)
            call apply_override(tree, overrides(i)%text, error, texts_of(overrides(i)%text))
            if (allocated(error)) exit
        end do
        if (allocated(error)) call ask_for_quotes(tree, error)
        if (allocated(error)) return
        scene%source = source
        scene%name = scene_name(source)
        read_groups: block
            call read_system(tree, scene, system, error)
            if (allocated(error)) exit read_groups
            if (size(overrides) > 0) call fit_to_overrides(tree, text, source, system, scene, error)
            if (allocated(error)) exit read_groups
            allowed = [character(key_length) :: keys, expectation_keys(system)]
            call refuse_coordinates(tree, system, error)
            if (allocated(error)) exit read_groups
            call refuse_unknown_keys(tree, "scene", [character(key_length) :: allowed, &
                                     drift_keys(system)], error, early=.true.)
            if (allocated(error)) exit read_groups
            call read_times(tree, system, scene, error)
            if (allocated(error)) exit read_groups
            call read_state(tree, system, scene, error)
            if (.not. allocated(error)) call check_formulas_at_start(tree, system, scene, error)
            if (allocated(error)) exit read_groups
            call read_columns(tree, system, scene, error)
            if (allocated(error)) exit read_groups
            call refuse_unknown_keys(tree, "scene", allowed, error)
            if (allocated(error)) exit read_groups
            call read_sweep_group(tree, scene%sweep, error)
            if (allocated(error)) exit read_groups
            call refuse_unknown_groups(tree, [character(name_length) :: "scene", scene%system, &
                                              formula_group, sweep_group], error)
        end block read_groups
        call move_alloc(tree, scene%file)
    end subroutine parse_scene

    subroutine read_unchanged(scene, file)
        !! What the scene's file says without the command line; a file that is complete only with
        !! what was set has no sweep.
        type(scene_t), intent(in) :: scene  !! as `read_scene` gives it
        type(scene_t), intent(out) :: file  !! without what was set
        class(system_t), allocatable :: system
        type(error_t), allocatable :: error
        type(word_t) :: none(0)
        integer :: last

        associate (tree => scene%file)
            last = len(tree%text)
            if (size(tree%starts) > 1) last = tree%starts(2) - 1
            call parse_scene(tree%text(:last), scene%source, none, file, system, error)
        end associate
        if (.not. allocated(file%sweep%over)) allocate (file%sweep%over(0))
        if (.not. allocated(file%sweep%keep)) allocate (file%sweep%keep(0))
    end subroutine read_unchanged

    subroutine fit_to_overrides(tree, text, source, system, scene, error)
        !! Leave out what the command line has made meaningless; the scene's warning says what.
        type(namelist_t), intent(inout) :: tree
        character(*), intent(in) :: text, source
        class(system_t), intent(in) :: system
        type(scene_t), intent(inout) :: scene
        type(error_t), allocatable, intent(out) :: error
        class(system_t), allocatable :: unchanged
        type(error_t), allocatable :: found
        type(namelist_t), allocatable :: original
        type(scene_t) :: file
        character(:), allocatable :: remark

        remark = ""
        allocate (original)
        call parse_namelist(text, source, original, found)
        if (.not. allocated(found)) call fit_times(tree, original, remark)
        if (.not. allocated(found)) call read_system(original, file, unchanged, found)
        ! A file that is complete only with what is set has nothing that was changed.
        if (.not. allocated(found)) then
            if (file%system == scene%system) call fit_columns(tree, system, original, unchanged, &
                                                              remark, error)
        end if
        if (allocated(scene%warning) .and. remark /= "") remark = "; "//remark
        if (allocated(scene%warning)) remark = scene%warning//remark
        if (remark /= "") scene%warning = remark
    end subroutine fit_to_overrides

    subroutine refuse_coordinates(tree, system, error)
        !! Refuse `theta = 0.5` and the like where a key is expected, and what other programs call
        !! a key.
        type(namelist_t), intent(inout) :: tree
        class(system_t), intent(in) :: system
        type(error_t), allocatable, intent(out) :: error
        character(4), parameter :: behind(3) = [character(4) :: "", "0", "_dot"]
        character(:), allocatable :: key
        type(description_t) :: d
        integer :: i, k

        call system%describe(d)
        do i = 1, size(d%coordinates)
            do k = 1, size(behind)
                key = lower(trim(d%coordinates(i)%name)//trim(behind(k)))
                if (.not. has_key(tree, "scene", key) .or. any(keys == key)) cycle
                call refuse_value(tree, "scene", key, "the start is given by q = "// &
                                  coordinates(d)//" and by v, the velocities", error)
                return
            end do
        end do
        call refuse_usual_names(tree, error)
    end subroutine refuse_coordinates

    subroutine read_system(tree, scene, system, error)
        !! The system by its name, with its parameters.
        type(namelist_t), intent(inout) :: tree
        type(scene_t), intent(inout) :: scene
        class(system_t), allocatable, intent(out) :: system
        type(error_t), allocatable, intent(out) :: error
        type(description_t) :: d
        type(error_t), allocatable :: found
        character(name_length), allocatable :: names(:)
        real(dp), allocatable :: values(:)
        integer :: i

        call get_string(tree, "scene", "system", scene%system, error, required=.true.)
        if (allocated(error)) return
        if (has_group(tree, formula_group)) then
            call read_formula_system(tree, scene, system, error)
            return
        end if
        call new_system(trim(scene%system), system, found)
        if (allocated(found)) then
            allocate (names(tree%group_count))
            do i = 1, size(names)
                names(i) = trim(tree%groups(i)%name)
            end do
            if (nearest_name(formula_group, names) /= "") then
                call refuse_unknown_groups(tree, [formula_group], error)
            else
                call refuse_value(tree, "scene", "system", found%message, error)
            end if
            return
        end if
        call system%describe(d)
        allocate (scene%parameters(0))
        allocate (names(size(d%parameters)))
        do i = 1, size(d%parameters)
            associate (p => d%parameters(i))
                if (allocated(values)) deallocate (values)
                allocate (values(p%count), source=p%value(:p%count))
                if (p%computed /= "") values = ieee_value(values, ieee_quiet_nan)
                names(i) = lower(p%name)
                call get_reals(tree, scene%system, trim(names(i)), p%count, p%count, values, error)
                if (allocated(error)) return
                p%value(:p%count) = values
                call check_parameter(p, found)
                if (allocated(found)) then
                    call refuse_parameter(tree, scene%system, trim(names(i)), p, error)
                    return
                end if
                scene%parameters = [scene%parameters, values]
            end associate
        end do
        call refuse_unknown_parameters(tree, scene%system, names, d%coordinates, &
                                       described_by(d), "", error)
        if (allocated(error)) return
        call system%configure(scene%parameters, error)
        if (allocated(error)) return
        call system%describe(d)
        if (any(ieee_is_nan(scene%parameters))) scene%computed = ieee_is_nan(scene%parameters)
        scene%parameters = default_values(d)
    end subroutine read_system

    subroutine read_formula_system(tree, scene, system, error)
        !! The system that the scene itself gives in formulas.
        type(namelist_t), intent(inout) :: tree
        type(scene_t), intent(inout) :: scene  !! has the system's name
        class(system_t), allocatable, intent(out) :: system
        type(error_t), allocatable, intent(out) :: error
        type(written_formulas_t) :: formulas
        type(written_expressions_t) :: expressions
        type(written_system_t), allocatable :: written
        type(constrained_system_t), allocatable :: bound
        type(error_t), allocatable :: found
        character(:), allocatable :: unused
        integer :: i

        if (any(system_names() == scene%system)) then
            call refuse_value(tree, "scene", "system", "is a system that the program has; "// &
                              "leave &lagrangian out, or give its system another name", error)
        else if (any(["scene     ", "methods   ", "lagrangian", "sweep     "] == scene%system)) then
            call refuse_value(tree, "scene", "system", "is the name of something else; give "// &
                              "the system of &lagrangian another one", error)
        else if (.not. is_group_name(trim(scene%system))) then
            call refuse_value(tree, "scene", "system", "names the group with the parameters: "// &
                              "small letters, digits and _ make a name, a letter first", error)
        end if
        if (allocated(error)) return
        formulas%name = scene%system
        call get_string(tree, "scene", "title", scene%title, error)
        if (.not. allocated(error)) call read_formulas(tree, formulas, error)
        if (allocated(error)) return
        formulas%title = trim(scene%title)
        call read_expressions(formulas, expressions, found)
        if (.not. allocated(found)) then
            call read_values(tree, formulas, error)
            if (allocated(error)) return
            if (size(formulas%constraints) > 0) then
                allocate (bound)
                call new_constrained_system(formulas, expressions, bound, found)
                call move_alloc(bound, system)
            else
                allocate (written)
                call new_written_system(formulas, expressions, written, found)
                call move_alloc(written, system)
            end if
        end if
        if (.not. allocated(found)) call refuse_columns(system, formulas, found)
        if (allocated(found)) then
            call refuse_formula(tree, found, error)
            return
        end if
        unused = unused_parameters(expressions, formulas)
        if (unused /= "") scene%warning = "no formula contains "//unused
        call formula_lines(tree, formulas, scene%formulas)
        scene%parameters = [(formulas%parameters(i)%value(1), i=1, size(formulas%parameters))]
    end subroutine read_formula_system

    pure function is_group_name(name) result(yes)
        !! Can a namelist have a group of this name?
        character(*), intent(in) :: name
        logical :: yes
        character(*), parameter :: letters = "abcdefghijklmnopqrstuvwxyz"

        yes = verify(name, letters//"0123456789_") == 0 .and. scan(name//" ", letters) == 1
    end function is_group_name

    subroutine refuse_columns(system, formulas, error)
        !! Refuse names that would make two columns, or two keys `expect_`, one.
        class(system_t), intent(in) :: system
        type(written_formulas_t), intent(in) :: formulas  !! of the scene
        type(error_t), allocatable, intent(out) :: error
        character(key_length), allocatable :: names(:)
        character(:), allocatable :: key
        character(name_length) :: own
        integer :: element, i, k

        element = 1
        allocate (names, source=expectation_keys(system))
        do i = 1, size(names)
            if (all(names(:i - 1) /= names(i))) cycle
            associate (name => names(i)(len("expect_") + 1:))
                key = "coordinates"
                if (size(formulas%positions) > 0 .and. &
                    any(["x_", "y_", "z_"] == name(:2))) key = "positions"
                do k = 1, size(formulas%coordinates)
                    own = lower(formulas%coordinates(k)%name)
                    if (key == "coordinates" .and. index(name, trim(own)) == 1) element = k
                end do
                do k = 1, size(formulas%quantities)
                    own = lower(formulas%quantities(k)%name)
                    if (all(name /= [character(key_length) :: own, trim(own)//"_drift"])) cycle
                    key = "quantities"
                    element = k
                end do
                call fail(error, "two columns would be called "//quoted(trim(name))// &
                          ", capital letters aside; take other names", key=key, &
                          element=element)
            end associate
            return
        end do
    end subroutine refuse_columns
end module lagrangia_scene_reader
