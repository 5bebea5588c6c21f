module lagrangia_registry
    !! The commands and options that there are, as data: help, dispatch and refusals read it.
    use lagrangia_command_line, only: command_line_t, has_outer_blanks, is_same, &
                                      may_have_value, needs_value, no_value, option_t, &
                                      without_hyphens
    use lagrangia_data_files, only: film_kinds, formats, pictures
    use lagrangia_errors, only: error_t, fail
    use lagrangia_names, only: nearest_name
    use lagrangia_scene_keys, only: keys
    use lagrangia_text, only: join, lower, quoted
    use lagrangia_usual_keys, only: usual_key
    implicit none (type, external)
    private
    public :: command_t, commands, options
    public :: accepts, check_line, told, usage

    type :: command_t
        character(12) :: name = ""
        character(32) :: arguments = ""
        character(80) :: meaning = ""
        integer :: most = 0              !! arguments at most; -1: any number
        character(80) :: accepts = ""    !! options, beside --help and --version
        character(40) :: takes = ""      !! what its arguments may be: see `lagrangia_vocabulary`
    end type command_t

    type(option_t), parameter :: options(*) = [ &
        option_t("set", needs_value, "GROUP%KEY=VALUE", "override a scene's value; repeatable", &
                 repeatable=.true., any_text=.true.), &
        option_t("at", needs_value, "Q1,Q2,...", "the equilibrium (default: at or near zero)"), &
        option_t("output", needs_value, "DIR", "where data files go (default data/output)", &
                 any_text=.true.), &
        option_t("format", needs_value, "text|csv|npy", "of the data files"), &
        option_t("plot", may_have_value, "png|svg|pdf", "draw the data files by gnuplot"), &
        option_t("animate", no_value, "", "a film of each scene, two methods, or the modes"), &
        option_t("error-estimate", no_value, "", "state the final state to the digits that hold"), &
        option_t("quick", no_value, "", "measure less, in half a minute or so"), &
        option_t("long", no_value, "", "up to 10^8 steps of every method"), &
        option_t("problems", needs_value, "P1,P3,...", "of the benchmark's work-precision part"), &
        option_t("methods", needs_value, "rk4,gauss16,...", "that are measured or compared"), &
        option_t("starts", needs_value, """Q1,Q2:V1,V2 ...""", "coordinates, perhaps velocities"), &
        option_t("overlay", no_value, "", "draw all runs in one picture as well"), &
        option_t("systems", needs_value, "pendulum,...", "or scenes, whose steps are measured"), &
        option_t("tolerances", needs_value, "1e-6,1e-9,...", "of the methods that take one"), &
        option_t("over", needs_value, "NAME=FROM:TO:COUNT", "an axis of a sweep; repeatable", &
                 repeatable=.true., any_text=.true.), &
        option_t("keep", needs_value, "COLUMN|period|...", "what is kept of each trajectory", &
                 repeatable=.true., any_text=.true.), &
        option_t("seed", needs_value, "N", "of a sweep's random values (default 1)"), &
        option_t("threads", needs_value, "N", "processes of a sweep (default: one a processor)"), &
        option_t("resume", no_value, "", "go on with a sweep that was interrupted"), &
        option_t("any-size", no_value, "", "a sweep that the disk may not hold"), &
        option_t("numbers", no_value, "", "each line of a derivation at a random state, twice"), &
        option_t("slip", needs_value, "ID", "derive with this slip of the notes"), &
        option_t("latex", no_value, "", "print LaTeX for slides"), &
        option_t("fortran", no_value, "", "print a system in formulas as a module"), &
        option_t("json", no_value, "", "print the results as JSON"), &
        option_t("quiet", no_value, "", "print nothing but errors"), &
        option_t("help", no_value, "", "this text, or a command's"), &
        option_t("version", no_value, "", "version, compiler, its flags")]

    type(command_t), parameter :: commands(*) = [ &
        command_t("", "", "run every scene in data/scenes and print the scorecard", 0, &
                  "set output format plot animate error-estimate json quiet"), &
        command_t("run", "SCENE...", "the same for .nml files, or shipped scenes by name", -1, &
                  "set output format plot overlay animate error-estimate json quiet", &
                  takes="scenes scene_files"), &
        command_t("compare", "SCENE", "by --methods, or from many --starts: one table, one "// &
                  "picture", 1, "set methods starts output format plot animate json quiet", &
                  takes="scenes scene_files"), &
        command_t("report", "[SCENE...]", "one HTML page: scorecard, pictures, films, "// &
                  "derivations, errata", -1, "set output quiet", takes="scenes scene_files"), &
        command_t("modes", "SYSTEM", "or a scene's: small oscillations, frequencies, shapes", 1, &
                  "set at output plot animate json quiet", takes="systems scenes scene_files"), &
        command_t("check", "[SYSTEM...]", "the audit: equations, invariants, structure, Gauss, "// &
                  "orders", -1, "set json quiet", takes="systems scenes methods scene_files"), &
        command_t("errata", "[ID]", "the slips in the lecture notes, and what each would do", 1, &
                  "json", takes="slips"), &
        command_t("principle", "[NAME]", "both sides of Hamilton's, d'Alembert's, Fermat's", 1, &
                  "output plot json", takes="principles"), &
        command_t("course", "[I|II]", &
                  "the lecture's notes line by line, and what shows each line", 1, &
                  "json", takes="lectures"), &
        command_t("bench", "[PART...]", "run time against error, cost of a step, growth, "// &
                  "output; parts by name", -1, &
                  "quick problems methods systems tolerances output plot json quiet", &
                  takes="parts"), &
        command_t("stress", "[ROW...]", "numerical stability: limits, long runs, hard numbers; "// &
                  "rows by name", -1, "long json quiet", takes="rows"), &
        command_t("grade", "FILE...", "a student's equations: right, or which term is wrong", -1, &
                  "json quiet", takes="sheets files"), &
        command_t("sweep", "SCENE", "many trajectories over an axis or two, numbers of each", 1, &
                  "set over keep seed threads resume any-size output format plot json quiet", &
                  takes="sweeps scenes scene_files"), &
        command_t("list", "[systems|methods|scenes|sweeps]", "what there is, one a line", 1, "", &
                  takes="lists"), &
        command_t("show", "[FILE...]", "a scene or sheet that comes with the program, as it is", &
                  -1, "", takes="scenes sweeps carried"), &
        command_t("describe", "SYSTEM|SCENE|scene", "L, equations, ...; of the word scene: "// &
                  "every key of a scene", 1, "set", takes="systems scenes scene scene_files"), &
        command_t("derive", "SYSTEM|SCENE", "from x(q) to the equations of motion, line by line", &
                  1, "set numbers slip latex fortran json", takes="systems scenes scene_files"), &
        command_t("help", "[COMMAND]", "what a command is for, with examples", 1, "", &
                  takes="commands"), &
        command_t("completion", "bash|zsh", "a script by which the shell completes our words", 1, &
                  "", takes="shells"), &
        command_t("manual", "", "this help as a page for man", 0, "")]

contains

    pure subroutine check_line(line, which, error)
        !! Find the command; fails where it, an option or a blank around an argument does not fit.
        type(command_line_t), intent(in) :: line  !! what was typed
        integer, intent(out) :: which  !! of `commands`
        type(error_t), allocatable, intent(out) :: error  !! allocated where it fails
        character(:), allocatable :: near
        type(command_t) :: command
        integer :: i

        do which = 1, size(commands)
            if (is_same(trim(commands(which)%name), line%command)) exit
        end do
        if (line%unknown_option /= "") call refuse_option(line%unknown_option, which, error)
        if (allocated(error)) return
        if (which > size(commands)) then
            near = nearest_name(line%command, [character(18) :: commands(2:)%name, &
                                               "--"//options%name])
            if (index(near, "--") == 1) then
                near = "; '"//near//"' is an option"//with_command(near(3:))
            else if (near /= "") then
                near = "; did you mean '"//near//"'?"
            else
                near = "; a scene's name stands behind a command, as in 'lagrangia run "// &
                       "pendulum'; there are "//join(commands(2:)%name, ", ")
            end if
            call fail(error, "unknown command "//quoted(line%command)//near)
            return
        end if
        if (line%has("help") .or. line%has("version")) return
        command = commands(which)
        do i = 1, size(line%names)
            if (.not. accepts(command, line%names(i)%text)) then
                call fail(error, "option '--"//line%names(i)%text//"' does not go with '"// &
                          trim("lagrangia "//command%name)//"'; "//taken(command))
                if (command%name == "help") error%message = error%message//"; "// &
                    told(line%names(i)%text)
                return
            end if
        end do
        do i = 1, size(line%arguments)
            associate (word => line%arguments(i)%text)
                if (.not. has_outer_blanks(word) .or. command%name == "run") cycle  ! a file's name
                call fail(error, quoted(word)//" begins or ends with a blank; write "// &
                          quoted(trim(adjustl(word))))
                return
            end associate
        end do
    end subroutine check_line

    pure function with_command(name) result(text)
        !! `, as in 'lagrangia run SCENE... --plot'`: the first command that takes the option; ""
        !! where it stands alone.
        character(*), intent(in) :: name  !! of an option, without hyphens
        character(:), allocatable :: text
        integer :: i

        text = ""
        do i = 2, size(commands)
            if (.not. accepts(commands(i), name)) cycle
            text = ", as in 'lagrangia "//trim(commands(i)%name)//" "// &
                   trim(commands(i)%arguments)//" --"//name//"'"
            return
        end do
    end function with_command

    pure subroutine refuse_option(name, which, error)
        !! There is no such option: say which one of this command's is near, or all of them.
        character(*), intent(in) :: name
        integer, intent(in) :: which  !! beyond the end: no command either
        type(error_t), allocatable, intent(out) :: error
        character(*), parameter :: films(*) = [character(5) :: film_kinds, "film", "movie", &
            "video", "html"]
        character(:), allocatable :: initial, near
        type(command_t) :: command
        logical :: fits(size(options))
        integer :: i

        command = commands(1)
        fits = .true.
        if (which <= size(commands)) then
            command = commands(which)
            fits = [(accepts(command, options(i)%name), i=1, size(options))] .or. &
                   options%name == "help" .or. options%name == "version"
        end if
        near = nearest_name(without_hyphens(name), pack(options%name, fits))
        initial = ""
        do i = 1, size(options)
            if (len(name) /= 2 .or. .not. fits(i)) cycle
            if (index(options(i)%name, lower(name(2:))) == 1) initial = initial//", --"// &
                trim(options(i)%name)
        end do
        if (near /= "") then
            near = "did you mean '--"//near//"'?"
        else if (initial /= "") then
            near = "an option is a whole word behind two hyphens: "//initial(3:)
        else if (accepts(command, "plot") .and. any(pictures == without_hyphens(name))) then
            near = "write --plot="//without_hyphens(name)
        else if (accepts(command, "format") .and. any(formats == without_hyphens(name))) then
            near = "write --format "//without_hyphens(name)
        else if (accepts(command, "animate") .and. any(films == without_hyphens(name))) then
            near = "did you mean '--animate'?"
        else if (without_hyphens(name) == "all" .and. command%name == "run") then
            near = "'lagrangia' alone runs every scene"
        else if (any(commands(2:)%name == without_hyphens(name))) then
            near = "a command has no hyphens: 'lagrangia "//without_hyphens(name)//"'"
        else if (accepts(command, "set") .and. any(keys == without_hyphens(name))) then
            near = "it is a key of the scene: --set scene%"//without_hyphens(name)//"=..."
        else if (accepts(command, "set") .and. usual_key(without_hyphens(name)) /= "") then
            near = "a key of the scene says that: --set scene%"// &
                   usual_key(without_hyphens(name))//"=..."
        else
            near = taken(command)
        end if
        call fail(error, "unknown option "//quoted(name)//"; "//near)
    end subroutine refuse_option

    pure function accepts(command, name) result(yes)
        !! Does the option `name` go with it?
        type(command_t), intent(in) :: command  !! of `commands`
        character(*), intent(in) :: name        !! without hyphens
        logical :: yes

        yes = index(" "//command%accepts, " "//trim(name)//" ") > 0
    end function accepts

    pure function told(name) result(text)
        !! How an option is written, what it does, and a command that takes it.
        character(*), intent(in) :: name  !! of `options`
        character(:), allocatable :: text
        integer :: i

        i = findloc(options%name == name, .true., 1)
        text = usage(options(i))//": "//trim(options(i)%meaning)//with_command(trim(name))
    end function told

    pure function taken(command) result(text)
        !! The options that go with it, beside those that go with all.
        type(command_t), intent(in) :: command
        character(:), allocatable :: text
        integer :: i

        text = ""
        do i = 1, size(options)
            if (accepts(command, options(i)%name)) text = text//", "//usage(options(i))
        end do
        if (text == "") text = ", none but --help"
        text = "it takes"//text(2:)
    end function taken

    pure function usage(option) result(text)
        !! `--name VALUE`.
        type(option_t), intent(in) :: option  !! of `options`
        character(:), allocatable :: text

        text = "--"//trim(option%name)
        if (option%takes == needs_value) text = text//" "//trim(option%value)
        if (option%takes == may_have_value) text = text//"[="//trim(option%value)//"]"
    end function usage
end module lagrangia_registry
