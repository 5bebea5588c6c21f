module lagrangia_vocabulary
    !! What may stand in the place of an argument or of an option's value: for help, for the shells
    !! that complete words, for the manual.
    use lagrangia_bench_options, only: parts
    use lagrangia_bench_problems, only: problem_names
    use lagrangia_catalogue, only: new_system, system_names
    use lagrangia_command_line, only: option_t
    use lagrangia_contestants, only: contestant_names
    use lagrangia_derivation_slips, only: derivable_slips
    use lagrangia_description, only: description_t
    use lagrangia_errata_ledger, only: slip_t, slips_of_the_notes
    use lagrangia_errors, only: error_t
    use lagrangia_methods, only: adaptive_names, method_names
    use lagrangia_names, only: name_length
    use lagrangia_principles, only: principle_names
    use lagrangia_registry, only: commands
    use lagrangia_scene_keys, only: keys
    use lagrangia_shipped, only: scene_name
    use lagrangia_shipped_files, only: shipped_files
    use lagrangia_stress_rows, only: rows
    use lagrangia_system, only: system_t
    use lagrangia_text, only: word_t
    implicit none (type, external)
    private
    public :: kind_of_value, words_of

contains

    subroutine words_of(kind, words)
        !! All words of one kind, in the order of their lists.
        character(*), intent(in) :: kind                    !! `systems`, one of a command's `takes`
        type(word_t), allocatable, intent(out) :: words(:)  !! none: files, or free text
        character(name_length), allocatable :: names(:)
        integer :: i

        select case (kind)
        case ("scenes"); call of_files("data/scenes/", .true.)
        case ("sweeps"); call of_files("data/sweeps/", .true.)
        case ("sheets"); call of_files("data/homework/", .true.)
        case ("carried"); call of_files("data/", .false.)
        case ("settings"); call settings(words)
        case ("commands")
            names = [character(name_length) :: (commands(i)%name, i=2, size(commands))]
        case ("systems"); call take(system_names())
        case ("principles"); call take(principle_names())
        case ("parts"); call take(parts)
        case ("problems"); call take(problem_names)
        case ("contestants"); call take(contestant_names())
        case ("rows"); names = [character(name_length) :: (rows(i)%name, i=1, size(rows))]
        case ("compared"); call take_methods()
        case ("slips"); call slip_ids(names)
        case ("derivable"); call take(derivable_slips)
        case ("lists"); call split("systems|methods|scenes|sweeps", names)
        case ("shells"); call split("bash|zsh", names)
        case ("lectures"); call split("I|II", names)
        case ("scene", "methods"); call split(kind, names)
        case default
            if (index(kind, "|") > 0) call split(kind, names)
        end select
        if (allocated(words)) return
        if (.not. allocated(names)) allocate (names(0))
        allocate (words(size(names)))
        do i = 1, size(names)
            words(i)%text = trim(names(i))
        end do
    contains
        subroutine take(list)
            character(*), intent(in) :: list(:)

            allocate (names(size(list)))
            names(:) = list
        end subroutine take

        subroutine take_methods()
            !! Those of fixed steps and those of a tolerance, each once.
            character(name_length), allocatable :: others(:)

            call take(method_names())
            allocate (others, source=adaptive_names())
            do i = 1, size(others)
                if (all(names /= others(i))) names = [character(name_length) :: names, others(i)]
            end do
        end subroutine take_methods

        subroutine of_files(folder, stems)
            character(*), intent(in) :: folder
            logical, intent(in) :: stems
            type(word_t), allocatable :: paths(:)
            integer :: k

            call shipped_files(folder, paths)
            allocate (words(size(paths)))
            do k = 1, size(paths)
                words(k)%text = paths(k)%text(len(folder) + 1:)
                if (stems) words(k)%text = scene_name(paths(k)%text)
            end do
        end subroutine of_files
    end subroutine words_of

    subroutine split(text, names)
        !! The words between the strokes of `a|b`.
        character(*), intent(in) :: text
        character(name_length), allocatable, intent(out) :: names(:)
        character(:), allocatable :: rest
        integer :: i

        allocate (names(count([(text(i:i) == "|", i=1, len(text))]) + 1))
        rest = text//"|"
        do i = 1, size(names)
            names(i) = rest(:index(rest, "|") - 1)
            rest = rest(index(rest, "|") + 1:)
        end do
    end subroutine split

    subroutine slip_ids(names)
        !! `E1`, ...
        character(name_length), allocatable, intent(out) :: names(:)
        type(slip_t), allocatable :: slips(:)
        integer :: i

        allocate (slips, source=slips_of_the_notes())
        allocate (names(size(slips)))
        do i = 1, size(names)
            names(i) = slips(i)%id
        end do
    end subroutine slip_ids

    subroutine settings(words)
        !! What `--set` may begin with: `scene%dt=`, `pendulum%l=`.
        type(word_t), allocatable, intent(out) :: words(:)
        class(system_t), allocatable :: system
        character(name_length), allocatable :: names(:)
        type(error_t), allocatable :: error
        type(description_t) :: d
        type(word_t) :: found(1000)
        integer :: i, k, n

        n = size(keys)
        do i = 1, n
            found(i)%text = "scene%"//trim(keys(i))//"="
        end do
        allocate (names, source=system_names())
        do i = 1, size(names)
            call new_system(trim(names(i)), system, error)
            if (allocated(error)) cycle
            call system%describe(d)
            do k = 1, min(size(d%parameters), size(found) - n)
                found(n + k)%text = trim(names(i))//"%"//trim(d%parameters(k)%name)//"="
            end do
            n = n + k - 1
        end do
        allocate (words(n))
        do i = 1, n
            words(i)%text = found(i)%text
        end do
    end subroutine settings

    pure function kind_of_value(option, command) result(kind)
        !! What the value of an option is, for `words_of`: `folder` and what is free text besides.
        type(option_t), intent(in) :: option  !! that takes one
        character(*), intent(in) :: command   !! of which it is one: `compare`
        character(:), allocatable :: kind

        select case (option%name)
        case ("set"); kind = "settings"
        case ("output"); kind = "folder"
        case ("slip"); kind = "derivable"
        case ("keep"); kind = ""  ! columns, of whatever scene it is
        case ("methods")
            kind = "contestants"
            if (command == "compare") kind = "compared"
        case ("problems", "systems"); kind = trim(option%name)
        case default
            kind = ""
            if (index(option%value, "|") > 0) kind = trim(option%value)
        end select
    end function kind_of_value
end module lagrangia_vocabulary
