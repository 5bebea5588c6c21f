module lagrangia_scene_keys
    !! The keys of the group `&scene`, each checked as far as it can be by itself.
    use lagrangia_columns, only: column_names, why_energy_changes
    use lagrangia_counted, only: counted
    use lagrangia_description, only: description_t, name_length
    use lagrangia_errors, only: error_t, fail
    use lagrangia_kinds, only: dp, i8
    use lagrangia_namelist, only: get_integer, get_logical, get_real, get_reals, get_string, &
                                  get_strings, has_key, is_overridden, namelist_t, point_advice, &
                                  refuse_value
    use lagrangia_number_class, only: is_zero
    use lagrangia_scene, only: expectation_t, scene_t
    use lagrangia_scene_figure, only: figure_t, new_figure
    use lagrangia_scene_tolerance, only: most_samples, read_tolerance, too_many
    use lagrangia_system, only: system_t
    use lagrangia_text, only: join, lower, quoted, to_text
    implicit none (type, external)
    private
    public :: keys, key_length, coordinates, drift_keys, expectation_keys, read_columns, &
              read_state, read_times, refuse_output

    character(name_length), parameter :: keys(*) = [character(name_length) :: &
        "title", "system", "method", "compensated", "t0", "dt", "tolerance", "duration", "every", &
        "samples", "q", "v", "columns", "plot", "event", "event_columns", "event_plot", &
        "figure", "period_of", "modes", "error_estimate", "output"]
    character(*), parameter :: good_names = "letters, digits, . _ - / and blanks, not "// &
        "absolute, without '..', not ending in .gp, .html, .nml, .pdf, .png, .svg or .partial"
    integer, parameter :: key_length = name_length + len("expect_")
    integer, parameter :: most = 10000  !! values of one key

contains

    subroutine read_times(tree, system, scene, error)
        !! Method, how it adds, step, duration, samples.
        type(namelist_t), intent(inout) :: tree  !! keys that are read are marked as used
        class(system_t), intent(in) :: system    !! with its parameters, for remedies
        type(scene_t), intent(inout) :: scene  !! gets these values
        type(error_t), allocatable, intent(out) :: error  !! a value that is missing or not allowed
        integer(i8) :: samples, steps

        call get_string(tree, "scene", "title", scene%title, error)
        if (allocated(error)) return
        call get_string(tree, "scene", "method", scene%method, error)
        if (allocated(error)) return
        call get_logical(tree, "scene", "compensated", scene%compensated, error)
        if (allocated(error)) return
        call get_real(tree, "scene", "t0", scene%t0, error)
        if (allocated(error)) return
        call read_tolerance(tree, system, scene, error)
        if (allocated(error)) return
        if (scene%tolerance <= 0.0_dp) call get_positive("dt", scene%dt)
        if (allocated(error)) return
        call get_positive("duration", scene%duration)
        if (allocated(error) .or. scene%tolerance > 0.0_dp) return
        call check_steps(tree, scene, error)
        if (allocated(error)) return
        steps = nint(min(scene%duration/scene%dt, 1e15_dp), i8)
        scene%every = max(1_i8, steps/1000)
        call get_count("every", scene%every)
        if (allocated(error)) return
        if (steps/scene%every > most_samples) then
            call refuse_value(tree, "scene", "every", to_text(steps/scene%every)//too_many// &
                              ", or every longer", error)
            return
        end if
        if ( .not. has_key(tree, "scene", "samples")) return
        if (has_key(tree, "scene", "every")) then
            call refuse_value(tree, "scene", "samples", "give either every or samples", error)
            return
        end if
        call get_count("samples", samples)
        if (allocated(error)) return
        if (mod(steps, samples) /= 0) then
            call refuse_value(tree, "scene", "samples", "does not divide the "//to_text(steps)// &
                              " steps; every = "//to_text(max(1_i8, steps/samples))// &
                              " gives about as many", error)
            return
        end if
        scene%every = steps/samples
    contains
        subroutine get_positive(key, value)
            character(*), intent(in) :: key
            real(dp), intent(inout) :: value

            call get_real(tree, "scene", key, value, error, required=.true.)
            if (allocated(error) .and. key == "dt") then
                if (index(error%message, "dt is missing; write") > 0) error%message = &
                    error%message//", or method = 'auto', which chooses its steps"
            end if
            if (allocated(error)) return
            if (value <= 0.0_dp) call refuse_value(tree, "scene", key, &
                                                   "a number greater than 0 is needed, in s", error)
        end subroutine get_positive

        subroutine get_count(key, value)
            character(*), intent(in) :: key
            integer(i8), intent(inout) :: value

            call get_integer(tree, "scene", key, value, error)
            if (allocated(error)) return
            if (value < 1) call refuse_value(tree, "scene", key, "at least 1 is needed", error)
        end subroutine get_count
    end subroutine read_times

    subroutine read_state(tree, system, scene, error)
        !! Coordinates and velocities at the start; velocities default to 0.
        type(namelist_t), intent(inout) :: tree  !! keys that are read are marked as used
        class(system_t), intent(in) :: system  !! with its parameters
        type(scene_t), intent(inout) :: scene  !! has its times; gets q and v
        type(error_t), allocatable, intent(out) :: error  !! a value that is missing or not allowed
        type(error_t), allocatable :: found
        type(description_t) :: d
        real(dp), allocatable :: given(:)

        call system%describe(d)
        call get_reals(tree, "scene", "q", 1, most, scene%q, error, required=.true.)
        if (allocated(error)) return
        if (size(scene%q) /= system%ndof) then
            call refuse_value(tree, "scene", "q", counted(size(scene%q), "value")//", but "// &
                              to_text(system%ndof)// &
                              trim(merge(" is ", " are", system%ndof == 1))// &
                              " needed: "//coordinates(d)// &
                              point_advice(tree, "scene", "q", system%ndof)// &
                              start_advice(tree, scene%q, system%ndof), error, &
                              min(size(scene%q), system%ndof + 1))
            return
        end if
        call system%check_places(scene%t0, scene%q, found)
        if (allocated(found)) then
            call refuse_value(tree, "scene", "q", found%message, error)
            return
        end if
        allocate (given(system%ndof - system%constraints), source=0.0_dp)
        call get_reals(tree, "scene", "v", 1, most, given, error)
        if (allocated(error)) return
        allocate (scene%v(system%ndof))
        call system%complete_velocities(scene%t0, scene%q, given, scene%v, found)
        if (allocated(found)) call refuse_value(tree, "scene", "v", found%message// &
            point_advice(tree, "scene", "v", system%ndof), error)
        if (size(given) < system%ndof) scene%given = system%free_velocities(scene%t0, scene%q)
    end subroutine read_state

    pure function start_advice(tree, q, ndof) result(remedy)
        !! What to set where another key that is set, `n` of a chain, wants another start.
        type(namelist_t), intent(in) :: tree
        real(dp), intent(in) :: q(:)
        integer, intent(in) :: ndof
        character(:), allocatable :: remedy

        remedy = ""
        if (is_overridden(tree, "scene", "system")) then
            remedy = "; the file is a scene of another system; 'lagrangia list scenes' shows "// &
                     "those of this one"
            return
        end if
        if (size(tree%starts) == 1 .or. is_overridden(tree, "scene", "q")) return
        remedy = "; add --set scene%q="//to_text(ndof)//" values"
        if (all(is_zero(q - q(1)))) remedy = "; add --set scene%q="//to_text(ndof)//"*"// &
                                                  to_text(q(1))
    end function start_advice

    subroutine read_columns(tree, system, scene, error)
        !! What is written, drawn, measured and expected.
        type(namelist_t), intent(inout) :: tree  !! keys that are read are marked as used
        class(system_t), intent(in) :: system  !! with its parameters
        type(scene_t), intent(inout) :: scene  !! gets columns, plots, events, expectations
        type(error_t), allocatable, intent(out) :: error  !! a value that is not allowed
        character(name_length), allocatable :: names(:)
        character(key_length), allocatable :: drifts(:), expected(:)
        type(description_t) :: d
        real(dp) :: limit
        integer :: i

        call system%describe(d)
        scene%columns = [character(name_length) :: "t", d%coordinates%name]
        if (system%conserves_energy()) then
            scene%columns = [character(name_length) :: scene%columns, "energy_drift"]
        else
            scene%columns = [character(name_length) :: scene%columns, "energy_balance_drift"]
        end if
        call get_strings(tree, "scene", "columns", 1, most, scene%columns, error)
        if (allocated(error)) return
        allocate (scene%plots(0))
        call get_strings(tree, "scene", "plot", 1, 8, scene%plots, error)
        if (allocated(error)) return
        call read_figure(tree, system, scene, error)
        if (allocated(error)) return
        call read_events(tree, system, scene, error)
        if (allocated(error)) return
        call get_logical(tree, "scene", "modes", scene%modes, error)
        if (allocated(error)) return
        call get_logical(tree, "scene", "error_estimate", scene%error_estimate, error)
        if (allocated(error)) return
        call get_string(tree, "scene", "period_of", scene%period_of, error)
        if (allocated(error)) return
        if (scene%period_of /= "" .and. .not. any(d%coordinates%name == scene%period_of)) then
            call refuse_value(tree, "scene", "period_of", "a coordinate is needed: "// &
                              coordinates(d), error)
            return
        end if
        if (.not. system%conserves_energy() .and. &
            has_key(tree, "scene", "expect_energy_drift")) then
            call refuse_value(tree, "scene", "expect_energy_drift", "the energy of this "// &
                              trim(d%name)//" is not conserved, for "// &
                              why_energy_changes(system), error)
            return
        end if
        allocate (drifts, source=drift_keys(system))
        do i = 1, size(d%quantities)
            if (d%quantities(i)%conserved .or. .not. has_key(tree, "scene", trim(drifts(i)))) cycle
            call refuse_value(tree, "scene", trim(drifts(i)), trim(d%quantities(i)%name)// &
                              " of this "//trim(d%name)//" is not conserved", error)
            return
        end do
        names = judged(system)
        expected = expectation_keys(system)
        allocate (scene%expectations(0))
        do i = 1, size(names)
            if (.not. has_key(tree, "scene", trim(expected(i)))) cycle
            call get_real(tree, "scene", trim(expected(i)), limit, error)
            if (allocated(error)) return
            if (limit < 0.0_dp) then
                call refuse_value(tree, "scene", trim(expected(i)), "a tolerance is at least 0", &
                                  error)
                return
            end if
            scene%expectations = [scene%expectations, expectation_t(names(i), limit)]
        end do
        scene%output = scene%name
        call get_string(tree, "scene", "output", scene%output, error)
        if (allocated(error) .or. .not. has_key(tree, "scene", "output")) return
        if (bad_output(trim(scene%output))) call refuse_value(tree, "scene", "output", "a file "// &
            "name below the output folder is needed: "//good_names, error)
    end subroutine read_columns

    pure subroutine refuse_output(name, error)
        !! Without an output the data files have the scene's name, which may be none for them. To be
        !! asked before they are written.
        character(*), intent(in) :: name  !! output of a scene, as `read_scene` gives it
        type(error_t), allocatable, intent(out) :: error  !! it is none

        if (bad_output(trim(name))) call fail(error, "the data files of a scene have "// &
            "its name, and "//quoted(trim(name))//" is none for them: "//good_names// &
            ", no - in front; give the scene an output, or its file another name")
    end subroutine refuse_output

    subroutine check_steps(tree, scene, error)
        !! Steps that are at most as long as the run, that can be counted, and that move the time.
        !! To blame is what is set, and of what the file says the number that is out of the way.
        type(namelist_t), intent(in) :: tree
        type(scene_t), intent(in) :: scene
        type(error_t), allocatable, intent(out) :: error
        real(dp), parameter :: most_steps = 1e15_dp
        real(dp), parameter :: far = 1e9_dp     !! s: thirty years
        real(dp) :: count

        count = scene%duration/scene%dt
        if (count < 1.0_dp) then
            if (blamed("duration", scene%duration < 1.0_dp/far)) then
                call refuse_value(tree, "scene", "duration", "is shorter than a step, dt = "// &
                                  to_text(scene%dt), error)
            else
                call refuse_value(tree, "scene", "dt", "is longer than the whole run, "// &
                                  "duration = "//to_text(scene%duration), error)
            end if
        else if (count > most_steps) then
            if (blamed("duration", scene%duration > far)) then
                call refuse_value(tree, "scene", "duration", "in steps of dt = "// &
                                  to_text(scene%dt)//" s takes "//to_text(count)// &
                                  " of them, too many to count", error)
            else
                call refuse_value(tree, "scene", "dt", "duration/dt = "//to_text(count)// &
                                  " steps are too many to count", error)
            end if
        else if (abs(scene%t0) + scene%dt <= abs(scene%t0) .and. blamed("t0", .false.)) then
            call refuse_value(tree, "scene", "t0", "a step of dt = "//to_text(scene%dt)// &
                              " s is too small to move the time there", error)
        end if
    contains
        logical function blamed(other, unusual)
            ! rather than dt
            character(*), intent(in) :: other
            logical, intent(in) :: unusual

            blamed = is_overridden(tree, "scene", other) .or. unusual
            if (is_overridden(tree, "scene", "dt")) blamed = .false.
            blamed = blamed .and. has_key(tree, "scene", other)
        end function blamed
    end subroutine check_steps

    subroutine read_figure(tree, system, scene, error)
        !! How the scene is drawn, if it says so.
        type(namelist_t), intent(inout) :: tree
        class(system_t), intent(in) :: system
        type(scene_t), intent(inout) :: scene
        type(error_t), allocatable, intent(out) :: error
        type(error_t), allocatable :: found
        type(figure_t) :: figure

        allocate (scene%figure(0))
        call get_strings(tree, "scene", "figure", 1, 200, scene%figure, error)
        if (allocated(error) .or. size(scene%figure) == 0) return
        call new_figure(system, scene%figure, 1.0_dp, scene%q, scene%q, figure, found)
        if (allocated(found)) call refuse_value(tree, "scene", "figure", found%message, error, &
                                                found%element)
    end subroutine read_figure

    subroutine read_events(tree, system, scene, error)
        !! What is looked for, and what is written down there; nothing if there is no event.
        type(namelist_t), intent(inout) :: tree
        class(system_t), intent(in) :: system
        type(scene_t), intent(inout) :: scene
        type(error_t), allocatable, intent(out) :: error
        logical :: wanted

        allocate (scene%events(0), scene%event_plots(0))
        call get_strings(tree, "scene", "event", 1, 8, scene%events, error)
        if (allocated(error)) return
        wanted = size(scene%events) > 0 .or. system%contacts > 0
        scene%event_columns = pack(scene%columns, .not. of_the_run(scene%columns))
        call get_event_key("event_columns")
        if (allocated(error)) return
        call get_strings(tree, "scene", "event_columns", 1, most, scene%event_columns, error)
        if (allocated(error)) return
        if (any(of_the_run(scene%event_columns))) then
            call refuse_value(tree, "scene", "event_columns", &
                              "errors and drifts are columns of the run, not of its events", &
                              error, findloc(of_the_run(scene%event_columns), .true., 1))
            return
        end if
        call get_event_key("event_plot")
        if (allocated(error)) return
        call get_strings(tree, "scene", "event_plot", 1, 8, scene%event_plots, error)
        if (.not. wanted) deallocate (scene%events)
    contains
        subroutine get_event_key(key)
            character(*), intent(in) :: key

            if (wanted .or. .not. has_key(tree, "scene", key)) return
            call refuse_value(tree, "scene", key, "there is no event to write down", error)
        end subroutine get_event_key
    end subroutine read_events

    elemental function of_the_run(name) result(yes)
        !! A column that is more than a function of the state.
        character(*), intent(in) :: name
        logical :: yes

        yes = name == "error" .or. index(name, "_drift") > 0
    end function of_the_run

    pure function coordinates(d) result(text)
        !! Their names in order; of many the first two and the last.
        type(description_t), intent(in) :: d  !! of a system
        character(:), allocatable :: text
        character(name_length) :: names(size(d%coordinates))

        names = d%coordinates%name
        text = join(names, ", ")
        if (size(names) > 10) text = join(names(:2), ", ")//", ..., "//trim(names(size(names)))
    end function coordinates

    pure function judged(system) result(names)
        !! What can be judged.
        class(system_t), intent(in) :: system
        character(name_length), allocatable :: names(:)

        names = [character(name_length) :: column_names(system, .true.), "period", "small_period"]
    end function judged

    pure function expectation_keys(system) result(names)
        !! `expect_` and what can be judged, in lower case as all keys are.
        class(system_t), intent(in) :: system  !! whose columns they judge
        character(key_length), allocatable :: names(:)
        integer :: i

        names = "expect_"//judged(system)
        do i = 1, size(names)
            names(i) = lower(names(i))
        end do
    end function expectation_keys

    pure function drift_keys(system) result(names)
        !! `expect_A_drift` of each quantity A, in lower case, and that of the energy: they bound
        !! what is conserved, and are refused with the reason where it is not.
        class(system_t), intent(in) :: system  !! whose quantities they are
        character(key_length), allocatable :: names(:)
        type(description_t) :: d
        integer :: i

        call system%describe(d)
        allocate (names(size(d%quantities) + 1))
        do i = 1, size(d%quantities)
            names(i) = "expect_"//lower(trim(d%quantities(i)%name))//"_drift"
        end do
        names(i) = "expect_energy_drift"
    end function drift_keys

    pure function bad_output(name) result(bad)
        !! Whether `name` could leave the output folder or surprise a program that reads it.
        character(*), intent(in) :: name
        logical :: bad

        character(8), parameter :: others(*) = [character(8) :: ".gp", ".html", ".nml", ".pdf", &
                                                ".png", ".svg", ".partial"]  ! beside data; scenes
        character(*), parameter :: letters = "abcdefghijklmnopqrstuvwxyz"// &
                                             "ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789._-/ "

        bad = len(name) == 0 .or. index("/"//name//"/", "/../") > 0 .or. index(name, "//") > 0
        if (bad) return
        bad = any(name(max(1, index(name, ".", back=.true.)):) == others)
        if (bad) return
        bad = scan(name(1:1), " /-") == 1 .or. scan(name(len(name):), "/") == 1 .or. &
              index("/"//name//"|", "/.|") > 0 .or. verify(name, letters) > 0
    end function bad_output
end module lagrangia_scene_keys
