module lagrangia_bench_options
    !! What the options of `lagrangia bench` choose; everything is checked before anything is run.
    use lagrangia_bench_problems, only: problem_names
    use lagrangia_catalogue, only: system_names
    use lagrangia_command_line, only: command_line_t
    use lagrangia_contestants, only: contestant_names
    use lagrangia_description, only: name_length
    use lagrangia_errors, only: error_t, fail
    use lagrangia_kinds, only: dp
    use lagrangia_names, only: refuse_name
    use lagrangia_number_list, only: read_numbers
    use lagrangia_output_options, only: take_folder, take_picture
    use lagrangia_scene_reader, only: names_scene, read_named_system
    use lagrangia_stopwatch, only: effort, effort_t
    use lagrangia_system, only: system_t
    use lagrangia_text, only: quoted, to_text, word_t
    implicit none (type, external)
    private
    public :: bench_options_t, parts, read_options

    character(name_length), parameter :: parts(*) = [character(name_length) :: "precision", &
        "samples", "steps", "energy", "growth", "modes", "output", "sweep"]
    real(dp), parameter :: least_tolerance = 1e-16_dp

    type :: bench_options_t
        character(name_length), allocatable :: parts(:), problems(:)
        type(word_t), allocatable :: systems(:)            !! names, of scenes also paths
        character(name_length), allocatable :: methods(:)  !! empty: all
        real(dp), allocatable :: tolerances(:)             !! empty: a ladder
        character(:), allocatable :: folder, picture
        type(effort_t) :: plan
    end type bench_options_t

contains

    subroutine read_options(line, options, error)
        !! Names must exist, tolerances must make sense.
        type(command_line_t), intent(in) :: line  !! what was typed
        type(bench_options_t), intent(out) :: options  !! checked
        type(error_t), allocatable, intent(out) :: error  !! allocated where it fails
        character(name_length), allocatable :: words(:)
        integer :: i

        options%plan = effort(line%has("quick"))
        call take_picture(line, options%picture, error)
        if (.not. allocated(error)) call take_folder(line, options%folder, error)
        if (allocated(error)) return
        allocate (words(size(line%arguments)))
        do i = 1, size(words)
            words(i) = line%arguments(i)%text
            if (len(line%arguments(i)%text) <= name_length) cycle
            call refuse_name("part", line%arguments(i)%text, parts, error)
            return
        end do
        call choose("part", words, parts, options%parts, error)
        if (allocated(error)) return
        call choose("problem", split(line, "problems"), problem_names, &
                    options%problems, error)
        if (allocated(error)) return
        call choose_systems(split(line, "systems"), options%systems, error)
        if (allocated(error)) return
        call choose("method", split(line, "methods"), contestant_names(), &
                    options%methods, error)
        if (allocated(error)) return
        allocate (options%tolerances(0))
        if (line%has("tolerances")) call read_tolerances(line%value_of("tolerances", ""), &
                                                         options%tolerances, error)
    end subroutine read_options

    subroutine choose_systems(words, chosen, error)
        !! Systems by their names, or those of scenes, which are read now, not at their turn.
        character(*), intent(in) :: words(:)
        type(word_t), allocatable, intent(out) :: chosen(:)
        type(error_t), allocatable, intent(out) :: error
        class(system_t), allocatable :: system
        character(name_length), allocatable :: names(:)
        integer :: i

        allocate (names, source=system_names())
        if (size(words) == 0) then
            allocate (chosen(size(names)))
            do i = 1, size(names)
                chosen(i)%text = trim(names(i))
            end do
            return
        end if
        allocate (chosen(size(words)))
        do i = 1, size(words)
            chosen(i)%text = trim(words(i))
            if (any(words(:i - 1) == words(i))) then
                call fail(error, "--systems: "//quoted(chosen(i)%text)//" is given twice; "// &
                          "names with commas between them: pendulum,wedge")
            else if (names_scene(chosen(i)%text)) then
                call read_named_system(chosen(i)%text, [word_t ::], system, error)
            else if (.not. any(names == words(i))) then
                call refuse_name("system", chosen(i)%text, names, error)
            end if
            if (allocated(error)) return
        end do
    end subroutine choose_systems

    pure subroutine choose(kind, words, names, chosen, error)
        !! The words, each of which must be one of `names`; all names where there are no words.
        character(*), intent(in) :: kind
        character(*), intent(in) :: words(:), names(:)
        character(name_length), allocatable, intent(out) :: chosen(:)
        type(error_t), allocatable, intent(out) :: error
        integer :: i

        if (size(words) == 0) then
            allocate (chosen(size(names)))
            chosen = names
            return
        end if
        do i = 1, size(words)
            if (any(names == words(i))) cycle
            call refuse_name(kind, trim(words(i)), names, error)
            return
        end do
        allocate (chosen(size(words)))
        chosen = words
    end subroutine choose

    pure subroutine read_tolerances(text, tolerances, error)
        !! Numbers between the precision and 1, tightened from one to the next.
        character(*), intent(in) :: text  !! with commas between them
        real(dp), allocatable, intent(out) :: tolerances(:)
        type(error_t), allocatable, intent(out) :: error
        integer :: i

        call read_numbers("--tolerances", text, tolerances, error)
        if (allocated(error)) return
        do i = 1, size(tolerances)
            if (tolerances(i) >= least_tolerance .and. tolerances(i) < 1.0_dp) cycle
            call fail(error, "tolerance "//to_text(tolerances(i))//" is not allowed: a "// &
                      "number from 1e-16 to below 1 is needed"//decimal_comma())
            return
        end do
        do i = 2, size(tolerances)
            if (tolerances(i) < tolerances(i - 1)) cycle
            call fail(error, "tolerances must fall from each to the next: 1e-3,1e-6,1e-9")
            return
        end do
    contains
        pure function decimal_comma() result(remedy)
            !! `0,001` is two numbers, of which the first is 0.
            character(:), allocatable :: remedy

            remedy = ""
            if (index(","//text, ",0,") > 0) remedy = "; a decimal has a point, as in 0.001, "// &
                "and a comma stands between two tolerances"
        end function decimal_comma
    end subroutine read_tolerances

    pure function split(line, option) result(words)
        !! The words between commas in the value of an option; none where it is not given.
        type(command_line_t), intent(in) :: line
        character(*), intent(in) :: option
        character(:), allocatable :: words(:)
        character(:), allocatable :: text
        integer :: first, i, last, n

        text = line%value_of(option, "")
        n = 0
        if (line%has(option)) n = 1
        do i = 1, len(text)
            if (text(i:i) == ",") n = n + 1
        end do
        allocate (character(len(text)) :: words(n))  ! nothing is cut
        first = 1
        do i = 1, n
            last = index(text(first:)//",", ",") + first - 2
            words(i) = adjustl(text(first:last))
            first = last + 2
        end do
    end function split
end module lagrangia_bench_options
