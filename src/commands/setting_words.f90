module lagrangia_setting_words
    !! A setting without `--set` before it, `theta=0.5` or `l=2`: what to write instead.
    use lagrangia_command_line, only: word_t
    use lagrangia_description, only: description_t, name_length
    use lagrangia_errors, only: error_t
    use lagrangia_registry, only: accepts, command_t
    use lagrangia_scene, only: scene_t
    use lagrangia_scene_keys, only: keys
    use lagrangia_scene_reader, only: read_named_system, read_scene
    use lagrangia_shipped, only: find_sweep
    use lagrangia_system, only: system_t
    use lagrangia_text, only: join, lower, to_text
    implicit none (type, external)
    private
    public :: setting_advice

contains

    function setting_advice(command, word, words) result(text)
        !! What the word is, and how a command takes what it says; empty where it is no setting.
        type(command_t), intent(in) :: command  !! of `commands`
        character(*), intent(in) :: word        !! an argument of it with `=`
        type(word_t), intent(in) :: words(:)    !! all arguments: the first is of what they set
        character(:), allocatable :: text
        character(:), allocatable :: key, value
        type(description_t) :: d
        logical :: found

        text = ""
        if (index(word, "=") < 2) return
        if (accepts(command, "over") .and. index(word, ":") > 0) then
            text = "an axis; write '--over "//word//"'"
            return
        end if
        if (.not. accepts(command, "set")) return
        key = lower(trim(word(:index(word, "=") - 1)))
        value = word(index(word, "="):)
        if (index(key, "%") > 0) then
            text = "a setting; write "//option(word)
        else if (any(keys == key) .and. starts_motion(command)) then
            text = "a setting; write "//option("scene%"//word)
        else
            call describe_first(command, words, d, found)
            if (.not. found) then
                text = "a setting; a scene or system goes before it, as in 'lagrangia "// &
                       trim(command%name)//" pendulum --set pendulum%l=2'"
            else
                text = advice_of(command, key, value, d)
            end if
        end if
    end function setting_advice

    pure function starts_motion(command) result(yes)
        !! Does it run scenes, with starts and keys? The others take systems, with parameters only.
        type(command_t), intent(in) :: command
        logical :: yes

        yes = index(command%takes, "scene_files") > 0 .and. index(command%takes, "systems") == 0
    end function starts_motion

    subroutine describe_first(command, words, d, found)
        !! The system that the first word names, or of the scene that it names.
        type(command_t), intent(in) :: command
        type(word_t), intent(in) :: words(:)
        type(description_t), intent(out) :: d
        logical, intent(out) :: found
        class(system_t), allocatable :: system
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
        found = .not. allocated(error)
        if (found) call system%describe(d)
    end subroutine describe_first

    pure function advice_of(command, key, value, d) result(text)
        !! Of a parameter, of the start of a coordinate or its velocity, or of something unknown.
        type(command_t), intent(in) :: command
        character(*), intent(in) :: key, value  !! in lower case; `=2`
        type(description_t), intent(in) :: d
        character(:), allocatable :: text
        character(name_length), allocatable :: coordinates(:), parameters(:)
        integer :: i

        coordinates = d%coordinates%name
        parameters = d%parameters%name
        text = ""
        if (place_of(key(:index(key//"(", "(") - 1), parameters) > 0) then
            text = "a setting; write "//option(trim(d%name)//"%"//key//value)
            return
        end if
        i = place_of(key, coordinates)
        if (i > 0 .and. starts_motion(command)) then
            text = "a start; write "//option("scene%"//start_of("q", i, d)//value)
        else if (i > 0 .and. accepts(command, "at") .and. size(d%coordinates) == 1) then
            text = "a place; write '--at "//value(2:)//"'"
        else if (i > 0 .and. accepts(command, "at")) then
            text = "a place; an equilibrium is '--at Q1,Q2,...', with all coordinates"
        end if
        if (text /= "") return
        i = 0
        if (index(key, "_dot") > 0) i = place_of(key(:index(key, "_dot") - 1), coordinates)
        if (i > 0 .and. starts_motion(command)) then
            text = "a start; write "//option("scene%"//start_of("v", i, d)//value)
        else if (size(d%parameters) == 0) then
            text = "no setting of "//trim(d%name)//", which has no parameters"
        else
            text = "no setting of "//trim(d%name)//", whose parameters are "// &
                   join(parameters, ", ")//"; write '--set "//trim(d%name)//"%"// &
                   trim(d%parameters(1)%name)//"=...'"
        end if
    end function advice_of

    pure function place_of(key, names) result(place)
        !! Of the name that the key is in whatever case; 0: there is none.
        character(*), intent(in) :: key, names(:)
        integer :: place

        do place = size(names), 1, -1
            if (lower(trim(names(place))) == key) return
        end do
    end function place_of

    pure function start_of(letter, i, d) result(key)
        !! `q`, of several coordinates `q(2)`.
        character(*), intent(in) :: letter
        integer, intent(in) :: i
        type(description_t), intent(in) :: d
        character(:), allocatable :: key

        key = letter
        if (size(d%coordinates) > 1) key = letter//"("//to_text(i)//")"
    end function start_of

    pure function option(setting) result(text)
        !! As it is typed; a shell needs quotes around parentheses.
        character(*), intent(in) :: setting
        character(:), allocatable :: text

        text = "'--set "//setting//"'"
        if (scan(setting, "()") > 0) text = "--set '"//setting//"'"
    end function option
end module lagrangia_setting_words
