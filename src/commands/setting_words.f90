module lagrangia_setting_words
    !! A setting without `--set` before it or without its group, `theta=0.5` or `l=2`: what to write
    !! instead.
    use lagrangia_command_line, only: word_t
    use lagrangia_description, only: description_t, name_length
    use lagrangia_errors, only: error_t
    use lagrangia_names, only: nearest_name
    use lagrangia_registry, only: accepts, command_t
    use lagrangia_scene, only: scene_t
    use lagrangia_scene_keys, only: expectation_keys, keys
    use lagrangia_scene_reader, only: read_named_system, read_scene
    use lagrangia_shipped, only: find_sweep
    use lagrangia_system, only: system_t
    use lagrangia_text, only: join, lower, to_text
    use lagrangia_typed_option, only: as_read, typed_option
    use lagrangia_usual_keys, only: usual_key
    implicit none (type, external)
    private
    public :: setting_advice

    character(9), parameter :: numbers(*) = [character(9) :: "dt", "duration", "q", "t0", &
                                             "tolerance", "v"]  !! keys of a scene

contains

    function setting_advice(command, word, words) result(text)
        !! What the word is, and how a command takes what it says; empty where it is no setting, and
        !! where the scene or system itself is not there, which the command says.
        type(command_t), intent(in) :: command  !! of `commands`
        character(*), intent(in) :: word        !! an argument of it with `=`
        type(word_t), intent(in) :: words(:)    !! all arguments: the first is of what they set
        character(:), allocatable :: text
        class(system_t), allocatable :: system
        character(:), allocatable :: key, value
        type(description_t) :: d

        text = ""
        if (index(word, "=") < 2) return
        if (accepts(command, "over") .and. index(word, ":") > 0) then
            text = "an axis; write "//typed_option("over", word)
            return
        end if
        if (.not. accepts(command, "set")) return
        key = lower(trim(word(:index(word, "=") - 1)))
        value = word(index(word, "=") + 1:)
        if (index(key, "%") > 0) then
            text = "a setting; write "//typed_option("set", word)
        else if (any(keys == key) .and. starts_motion(command)) then
            if (any(numbers == key)) value = as_read(value)
            text = "a setting; write "//typed_option("set", "scene%"//key//"="//value)
        else if (index(words(1)%text, "=") > 0) then
            text = "a setting; a scene or system goes before it, as in 'lagrangia "// &
                   trim(command%name)//" pendulum --set pendulum%l=2'"
        else
            call take_first(command, words, system)
            if (.not. allocated(system)) return
            call system%describe(d)
            if (index(key, "expect_") == 1 .and. starts_motion(command)) then
                text = expectation_advice(key, value, expectation_keys(system))
            else
                text = advice_of(command, key, as_read(value), d)
            end if
        end if
    end function setting_advice

    pure function starts_motion(command) result(yes)
        !! Does it run scenes, with starts and keys? The others take systems, with parameters only.
        type(command_t), intent(in) :: command
        logical :: yes

        yes = index(command%takes, "scene_files") > 0 .and. index(command%takes, "systems") == 0
    end function starts_motion

    pure function expectation_advice(key, value, names) result(text)
        !! Of a bound for something measured.
        character(*), intent(in) :: key, value, names(:)
        character(:), allocatable :: text
        character(name_length) :: measured(size(names))

        measured = names(:)(len("expect_") + 1:)
        if (any(names == key)) then
            text = "a setting; write "//typed_option("set", "scene%"//key//"="//as_read(value))
        else if (nearest_name(key(len("expect_") + 1:), measured) /= "") then
            text = "no setting; did you mean 'expect_"// &
                   nearest_name(key(len("expect_") + 1:), measured)//"'?"
        else
            text = "no setting; what can be bounded is expect_ and one of "//join(measured, ", ")
        end if
    end function expectation_advice

    subroutine take_first(command, words, system)
        !! The system that the first word names, or of the scene that it names, if there is one.
        type(command_t), intent(in) :: command
        type(word_t), intent(in) :: words(:)
        class(system_t), allocatable, intent(out) :: system
        type(error_t), allocatable :: error
        character(:), allocatable :: path
        type(scene_t) :: scene
        type(word_t) :: none(0)

        if (command%name == "sweep") then
            call find_sweep(words(1)%text, path, error)
            if (.not. allocated(error)) call read_scene(path, none, scene, system, error)
        else
            call read_named_system(words(1)%text, none, system, error)
        end if
        if (allocated(error) .and. allocated(system)) deallocate (system)
    end subroutine take_first

    pure function advice_of(command, key, value, d) result(text)
        !! Of a parameter, of the start of a coordinate or its velocity, or of something unknown.
        type(command_t), intent(in) :: command
        character(*), intent(in) :: key, value  !! in lower case; any word
        type(description_t), intent(in) :: d
        character(:), allocatable :: text
        character(name_length) :: coordinates(size(d%coordinates)), parameters(size(d%parameters))
        integer :: i

        coordinates = d%coordinates%name
        parameters = d%parameters%name
        text = ""
        if (place_of(key(:index(key//"(", "(") - 1), parameters) > 0) then
            text = "a setting; write "//typed_option("set", trim(d%name)//"%"//key//"="//value)
            return
        end if
        i = place_of(key, coordinates)
        if (i > 0 .and. starts_motion(command)) then
            text = "a start; write "//typed_option("set", start_of("q", i, d)//value)
        else if (i > 0 .and. accepts(command, "at") .and. size(d%coordinates) == 1) then
            text = "a place; write "//typed_option("at", value)
        else if (i > 0 .and. accepts(command, "at")) then
            text = "a place; an equilibrium is '--at Q1,Q2,...', with all coordinates"
        end if
        if (text /= "") return
        i = 0
        if (index(key, "_dot") > 0) i = place_of(key(:index(key, "_dot") - 1), coordinates)
        if (i > 0 .and. starts_motion(command)) then
            text = "a start; write "//typed_option("set", start_of("v", i, d)//value)
        else if (starts_motion(command) .and. scene_key(key) /= "") then
            text = "no setting; did you mean "//typed_option("set", "scene%"//scene_key(key)// &
                                                             "="//value)//"?"
        else if (size(d%parameters) == 0) then
            text = "no setting of "//trim(d%name)//", which has no parameters"
        else
            text = "no setting of "//trim(d%name)//", whose parameters are "// &
                   join(parameters, ", ")//"; write '--set "//trim(d%name)//"%"// &
                   trim(d%parameters(1)%name)//"=...'"
        end if
    end function advice_of

    pure function scene_key(word) result(key)
        !! The key of a scene that is meant, by another name or a slip; empty where it is none.
        character(*), intent(in) :: word
        character(:), allocatable :: key

        key = usual_key(word)
        if (key == "") key = nearest_name(word, keys)
    end function scene_key

    pure function place_of(key, names) result(place)
        !! Of the name that the key is in whatever case; 0: there is none.
        character(*), intent(in) :: key, names(:)
        integer :: place

        do place = size(names), 1, -1
            if (lower(trim(names(place))) == key) return
        end do
    end function place_of

    pure function start_of(letter, i, d) result(key)
        !! `scene%q=`, of several coordinates `scene%q(2)=`.
        character(*), intent(in) :: letter
        integer, intent(in) :: i
        type(description_t), intent(in) :: d
        character(:), allocatable :: key

        key = "scene%"//letter
        if (size(d%coordinates) > 1) key = key//"("//to_text(i)//")"
        key = key//"="
    end function start_of
end module lagrangia_setting_words
