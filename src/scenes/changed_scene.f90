module lagrangia_changed_scene
    !! A scene that the command line changes is another one: it has a title and files of its own,
    !! and what the file expects of the unchanged motion does not judge it.
    use lagrangia_kinds, only: i8
    use lagrangia_scene, only: scene_t
    use lagrangia_text, only: join, lower, word_t
    implicit none (type, external)
    private
    public :: ending_start, make_own_scene, retitle_sweep

    character(*), parameter :: same_motion(*) = [character(14) :: "title", "output", "columns", &
        "plot", "event_columns", "event_plot", "error_estimate", "modes", "every", "samples", &
        "period_of", "figure"]
    !! keys of `&scene` that leave the motion as it is, and so does `expect_...`
    integer, parameter :: longest = 120  !! bytes of what a file's name gets

contains

    pure subroutine make_own_scene(scene, overrides, names)
        !! Give a scene that was read with these overrides a title and an output of its own; of its
        !! expectations only those that were set with them judge it. It says so in `changes`.
        type(scene_t), intent(inout) :: scene     !! as `read_scene` gives it
        type(word_t), intent(in) :: overrides(:)  !! `GROUP%KEY=VALUE`, as typed
        character(*), intent(in) :: names(:)      !! of the system's parameters
        character(:), allocatable :: changes, group, key, value
        logical, allocatable :: kept(:)
        logical :: titled, placed
        integer :: dot, i

        changes = ""
        titled = .false.
        placed = .false.
        allocate (kept(size(scene%expectations)), source=.false.)
        do i = 1, size(overrides)
            call split(overrides(i)%text, group, key, value)
            if (group == "scene") then
                titled = titled .or. key == "title"
                placed = placed .or. key == "output"
                if (index(key, "expect_") == 1) where ( &
                    lower_names(scene) == key(len("expect_") + 1:)) kept = .true.
                if (any(same_motion == key) .or. index(key, "expect_") == 1) cycle
            end if
            if (changes /= "") changes = changes//", "
            if (group /= "scene") key = as_described(key, names)
            changes = changes//key//"="//value
        end do
        if (changes == "") return
        scene%changes = changes
        scene%expectations%judged = kept
        if (.not. titled) then
            scene%title = trim(scene%title)//" ("//changes//")"
        end if
        if (placed) return
        dot = ending_start(trim(scene%output))
        scene%output = scene%output(:dot - 1)//"_"//name_of(changes)//scene%output(dot:)
    end subroutine make_own_scene

    pure subroutine retitle_sweep(scene, before, overrides, names)
        !! Give a sweep that the command line changes a title that is true of it: other axes or
        !! numbers than those of the file are named, other values are added. A title that is given
        !! stays.
        type(scene_t), intent(inout) :: scene     !! with the axes and what is kept
        type(scene_t), intent(in) :: before       !! as `read_scene` gave it
        type(word_t), intent(in) :: overrides(:)  !! `GROUP%KEY=VALUE`, as typed
        character(*), intent(in) :: names(:)      !! of the system's parameters
        character(:), allocatable :: changes, group, key, value
        integer :: i

        changes = ""
        do i = 1, size(overrides)
            call split(overrides(i)%text, group, key, value)
            if (group == "sweep") cycle
            if (group == "scene" .and. key == "title") return
            if (group == "scene" .and. (any(same_motion == key) .or. &
                                        index(key, "expect_") == 1)) cycle
            if (group /= "scene") key = as_described(key, names)
            changes = changes//", "//key//"="//value
        end do
        if (numbers_over_axes(scene) /= numbers_over_axes(before)) then
            scene%title = trim(scene%name)//": "//numbers_over_axes(scene)
        end if
        if (changes /= "") scene%title = trim(scene%title)//" ("//changes(3:)//")"
    end subroutine retitle_sweep

    pure function numbers_over_axes(scene) result(text)
        !! What a sweep keeps over which axes: `period over theta and l`.
        type(scene_t), intent(in) :: scene
        character(:), allocatable :: text
        character(:), allocatable :: axis
        integer :: i

        text = join(scene%sweep%keep, ", ")
        do i = 1, size(scene%sweep%over)
            axis = trim(adjustl(scene%sweep%over(i)))
            axis = trim(axis(:index(axis//"=", "=") - 1))
            if (i == 1) text = text//" over "//axis
            if (i > 1) text = text//" and "//axis
        end do
    end function numbers_over_axes

    pure function as_described(key, names) result(name)
        !! A parameter's key in the letters of the description, `M(2)` for `m(2)`: case does not
        !! matter where it is typed, but a title shows the symbol.
        character(*), intent(in) :: key, names(:)
        character(:), allocatable :: name
        integer :: i, last

        name = key
        last = index(key//"(", "(") - 1
        do i = 1, size(names)
            if (lower(trim(names(i))) /= key(:last)) cycle
            name = trim(names(i))//key(last + 1:)
            return
        end do
    end function as_described

    pure function ending_start(name) result(dot)
        !! Where the ending of a file's name begins: a dot and a letter make one, `l_2.5` has none,
        !! and then it is behind the name.
        character(*), intent(in) :: name  !! of a file, perhaps below a folder
        integer :: dot

        dot = index(name, ".", back=.true.)
        if (dot > index(name, "/", back=.true.) .and. dot < len(name)) then
            if (scan(lower(name(dot + 1:dot + 1)), "abcdefghijklmnopqrstuvwxyz") == 1) return
        end if
        dot = len(name) + 1
    end function ending_start

    pure function lower_names(scene) result(names)
        !! What the scene expects something of, in small letters, as keys are.
        type(scene_t), intent(in) :: scene
        character(len(scene%expectations%name)) :: names(size(scene%expectations))
        integer :: i

        do i = 1, size(names)
            names(i) = lower(scene%expectations(i)%name)
        end do
    end function lower_names

    pure subroutine split(text, group, key, value)
        !! `Scene%q(2) = 0.5` into `scene`, `q` and, with the index, what follows; no blanks.
        character(*), intent(in) :: text
        character(:), allocatable, intent(out) :: group, key, value
        character(:), allocatable :: plain
        integer :: equals, i, percent

        plain = ""
        do i = 1, len(text)
            if (text(i:i) > " ") plain = plain//text(i:i)
        end do
        percent = index(plain, "%")
        equals = index(plain, "=")
        group = lower(plain(:percent - 1))
        key = lower(plain(percent + 1:equals - 1))
        value = plain(equals + 1:)
        if (index(key, "(") > 0 .and. group == "scene") key = key(:index(key, "(") - 1)//"_"// &
            key(index(key, "(") + 1:index(key//")", ")") - 1)
    end subroutine split

    pure function name_of(changes) result(name)
        !! The same in letters that `output` takes: `m1_5_dt_1e-3`.
        character(*), intent(in) :: changes
        character(:), allocatable :: name
        character(*), parameter :: plain = "abcdefghijklmnopqrstuvwxyz"// &
            "ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_.-"
        integer :: i

        name = ""
        do i = 1, len(changes)
            if (changes(i:i) == " " .or. changes(i:i) == "+") cycle
            if (index(plain, changes(i:i)) > 0) then
                name = name//changes(i:i)
            else
                name = name//"_"
            end if
        end do
        if (len(name) > longest) name = "changed_"//checksum(name)
    end function name_of

    pure function checksum(text) result(digits)
        !! The remainder of the bytes as digits of a number to the base 256, divided by the prime
        !! 2^31 - 1, in hexadecimal digits: other changes go to other files.
        character(*), intent(in) :: text
        character(8) :: digits
        integer(i8), parameter :: prime = 2147483647_i8
        integer(i8) :: left
        integer :: i

        left = 0
        do i = 1, len(text)
            left = mod(256*left + ichar(text(i:i)), prime)
        end do
        write (digits, "(ss, z8.8)") left
    end function checksum
end module lagrangia_changed_scene
