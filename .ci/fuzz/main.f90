module fuzzing
    !! `fuzz [COUNT [SEED]]`: mutated scenes, overrides and command lines. What is accepted must be
    !! whole and come back from its own echo; what is refused must be refused in one short line.
    use lagrangia_blas_threads, only: use_one_blas_thread
    use lagrangia_catalogue, only: new_system
    use lagrangia_characters, only: printable
    use lagrangia_command_line, only: command_line_t, parse_words, word_t
    use lagrangia_data_files, only: check_format
    use lagrangia_description, only: description_t
    use lagrangia_errors, only: error_t
    use lagrangia_files, only: read_whole_file
    use lagrangia_kinds, only: dp
    use lagrangia_registry, only: check_line, options
    use lagrangia_run_plan, only: parse_run_plan, run_plan_t
    use lagrangia_scene, only: scene_line_length, scene_lines, scene_t
    use lagrangia_scene_reader, only: read_named_system
    use lagrangia_shipped, only: find_scene, shipped_scenes
    use lagrangia_system, only: system_t
    use mutations, only: mutate, pick, seed_with, spoil
    implicit none (type, external)
    private
    public :: fuzz

    type(word_t), allocatable :: corpus(:)
    integer :: seed = 1, i = 0, accepted = 0, refused = 0

contains

    subroutine fuzz()
        !! The loop.
        integer :: count

        count = argument(1, 200000)
        seed = argument(2, 1)
        call use_one_blas_thread()
        call read_corpus()
        call seed_with(seed)
        print "(a, i0, a, i0)", "fuzz: ", count, " inputs, seed ", seed
        do i = 1, count
            if (mod(i, 10) == 0) then
                call try_words()
            else if (mod(i, 10) == 5) then
                call try_nonsense()
            else
                call try_scene()
            end if
        end do
        print "(i0, a, i0, a)", accepted, " accepted, ", refused, &
            " refused, none crashed or misled"
    end subroutine fuzz

    function argument(position, default) result(value)
        !! A whole number of the command line.
        integer, intent(in) :: position, default
        integer :: value, status
        character(20) :: text

        value = default
        call get_command_argument(position, text)
        if (text == "") return
        read (text, *, iostat=status) value
        if (status /= 0) error stop "fuzz: a whole number is needed"
    end function argument

    subroutine read_corpus()
        !! The shipped scenes.
        type(word_t), allocatable :: paths(:)
        type(error_t), allocatable :: error
        integer :: k

        call shipped_scenes(paths)
        allocate (corpus(size(paths)))
        do k = 1, size(paths)
            call read_whole_file(paths(k)%text, corpus(k)%text, error)
            if (allocated(error)) error stop "fuzz: start in the project's folder"
        end do
    end subroutine read_corpus

    subroutine try_scene()
        !! One mutated scene, every fourth with formulas, half of them with a mutated override.
        character(*), parameter :: sets(*) = [character(36) :: "scene%dt=1e-3", "scene%q=0,1", &
            "scene%columns=t,energy", "wedge%alpha=0.5", "scene%method=rk4", "scene%q(2)=1", &
            "lagrangian%V=k/2 (r - l0)^2", "lagrangian%Q_r=-r_dot", &
            "lagrangian%T=(r_dot^2 + theta_dot^2)", "two_rods%m1=3", &
            "lagrangian%constraint=r^2 = l0^2"]
        character(:), allocatable :: text, set
        integer :: number
        type(word_t), allocatable :: overrides(:)

        number = pick(size(corpus))
        do while (mod(i, 4) == 0 .and. index(corpus(number)%text, "&lagrangian") == 0)
            number = pick(size(corpus))
        end do
        text = corpus(number)%text
        number = pick(size(corpus))
        call mutate(text, pick(4) - 1, corpus(number)%text)
        number = pick(2) - 1
        allocate (overrides(number))
        if (number == 1) then
            number = pick(size(sets))
            set = trim(sets(number))
            call mutate(set, pick(3) - 1, "")
            overrides(1)%text = set
        end if
        call judge(text, overrides)
    end subroutine try_scene

    subroutine try_nonsense()
        !! One scene that is right but for one number, which must be what it is refused for.
        type(run_plan_t) :: plan
        type(error_t), allocatable :: error
        character(:), allocatable :: text, written
        integer :: number

        number = pick(size(corpus))
        text = corpus(number)%text
        call spoil(text, written)
        if (written == "") return
        call parse_run_plan(plan, text, "fuzz.nml", [word_t ::], error)
        if (.not. allocated(error)) call give_up(written//" was taken for a number", text)
        call check_message(error, text)
        if (index(error%message, "fuzz.nml:") /= 1) call give_up(error%message, text)
        refused = refused + 1
    end subroutine try_nonsense

    subroutine judge(text, overrides)
        !! Read it; read the echo of what was accepted.
        character(*), intent(in) :: text
        type(word_t), intent(in) :: overrides(:)
        type(run_plan_t) :: plan, again
        type(description_t) :: d
        type(error_t), allocatable :: error
        character(scene_line_length), allocatable :: lines(:)
        character(:), allocatable :: echo
        logical :: whole
        character(:), allocatable :: source
        integer :: k

        source = "fuzz.nml"
        if (mod(i, 7) == 0) source = repeat("long path/", 30)//source
        call parse_run_plan(plan, text, source, overrides, error)
        if (allocated(error)) then
            call check_message(error, text)
            refused = refused + 1
            return
        end if
        accepted = accepted + 1
        associate (scene => plan%scene)
            whole = scene%every >= 1 .and. scene%duration > 0.0_dp .and. &
                    (scene%tolerance > 0.0_dp .or. &
                     (scene%dt > 0.0_dp .and. scene%dt <= scene%duration)) .and. &
                    size(scene%q) == plan%system%ndof .and. &
                    all(abs(scene%q) <= huge(1.0_dp)) .and. &
                    all(abs(scene%v) <= huge(1.0_dp)) .and. size(scene%columns) > 0
        end associate
        if (.not. whole) call give_up("nonsense was accepted", text)
        call plan%system%describe(d)
        lines = scene_lines(plan%scene, d)
        echo = ""
        do k = 1, size(lines)
            echo = echo//trim(lines(k))//new_line("a")
        end do
        call parse_run_plan(again, echo, "fuzz.nml", [word_t ::], error)
        if (allocated(error)) call give_up("its echo is refused: "//error%message, text//echo)
        whole = all(transfer(numbers(plan%scene), [0]) == transfer(numbers(again%scene), [0]))
        if (.not. whole) call give_up("its echo differs", text)
    end subroutine judge

    pure function numbers(scene) result(list)
        !! All numbers of a scene.
        type(scene_t), intent(in) :: scene
        real(dp), allocatable :: list(:)

        list = [scene%dt, scene%tolerance, scene%duration, scene%t0, scene%q, scene%v, &
                scene%parameters]
    end function numbers

    subroutine try_words()
        !! A command line of one to six words, mutated.
        character(*), parameter :: words(*) = [character(24) :: &
            "run", "list", "describe", "modes", "cart_pendulum", "systems", "-", "", "--", &
            "--set", "scene%dt=1e-3", "--set=scene%dt=1", "--json", "--output", "--format=csv", &
            "--help", "-h", "--plot=svg", "--quiet", "--no"]
        type(word_t), allocatable :: line(:)
        type(command_line_t) :: parsed
        type(error_t), allocatable :: error
        character(:), allocatable :: text, all
        integer :: k, which

        k = pick(6)
        allocate (line(k))
        all = ""
        do k = 1, size(line)
            which = pick(size(words))
            text = trim(words(which))
            if (pick(3) == 1) call mutate(text, 1, "")
            if (pick(20) == 1) text = text//repeat("x", 2000)
            line(k)%text = text
            all = all//text//" "
        end do
        call parse_words(line, options, parsed, error)
        if (.not. allocated(error)) call check_line(parsed, which, error)
        if (allocated(error)) then
            call check_message(error, all)
            refused = refused + 1
        else
            accepted = accepted + 1
            if (mod(i, 50) == 0) call try_names(text)
        end if
    end subroutine try_words

    subroutine try_names(name)
        !! A name where commands look for systems, scenes, formats.
        character(*), intent(in) :: name
        class(system_t), allocatable :: system
        character(:), allocatable :: path
        type(error_t), allocatable :: error
        integer :: k

        do k = 1, 4
            select case (k)
            case (1); call new_system(name, system, error)
            case (2); call find_scene(name, path, error)
            case (3); call check_format(name, error)
            case default; call read_named_system("wedge", [word_t(name)], system, error)
            end select
            if (allocated(error)) call check_message(error, name)
        end do
    end subroutine try_names

    subroutine check_message(error, text)
        !! One line of printable characters, 300 at most with the program's name.
        type(error_t), intent(in) :: error
        character(*), intent(in) :: text

        if (len(error%message) == 0) call give_up("refused without a word", text)
        if (len("lagrangia: "//error%message) > 300) call give_up("a long message: "// &
                                                                  error%message, text)
        if (printable(error%message) /= error%message) call give_up( &
            "an unprintable message: "//error%message, text)
    end subroutine check_message

    subroutine give_up(what, text)
        !! Show the input that did it.
        character(*), intent(in) :: what, text

        print "(a, i0, a, i0, 2a)", "fuzz: input ", i, " of seed ", seed, ": ", what
        print "(a)", text
        stop 1, quiet=.true.
    end subroutine give_up
end module fuzzing

program main
    !! See `fuzzing`.
    use fuzzing, only: fuzz
    implicit none (type, external)

    call fuzz()
end program main
