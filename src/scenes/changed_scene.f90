module lagrangia_changed_scene
    !! A scene that the command line changes is another one: it has a title and files of its own,
    !! and what the file expects of the unchanged motion does not judge it.
    use lagrangia_kinds, only: i8
    use lagrangia_number_class, only: is_nonzero
    use lagrangia_scene, only: heading, scene_t, sweep_group_t
    use lagrangia_text, only: in_words, join, lower, to_text, word_t
    implicit none (type, external)
    private
    public :: ending_start, make_own_name, make_own_scene, make_own_sweep

    character(*), parameter :: same_sweep(*) = [character(14) :: "title", "output", "columns", &
        "plot", "event_columns", "event_plot", "error_estimate", "modes", "figure"]
    !! keys of `&scene` that leave all numbers of a sweep as they are, and so does `expect_...`
    character(*), parameter :: same_motion(*) = [character(14) :: same_sweep, "every", "samples", &
        "period_of"]
    !! those that leave the motion as it is
    character(*), parameter :: shown_only(*) = [character(11) :: "quantities", "equilibrium"]
    !! keys of `&lagrangian` that do: columns, and where small oscillations are looked for
    integer, parameter :: longest = 120  !! bytes of what a file's name gets
    character(*), parameter :: plain_letters = "abcdefghijklmnopqrstuvwxyz"// &
        "ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_.-"

contains

    pure subroutine make_own_scene(scene, overrides, names)
        !! Give a scene that was read with these overrides a title and an output of its own; of its
        !! expectations only those that were set with them judge it. It says so in `changes`.
        type(scene_t), intent(inout) :: scene     !! as `read_scene` gives it
        type(word_t), intent(in) :: overrides(:)  !! `GROUP%KEY=VALUE`, as typed
        character(*), intent(in) :: names(:)      !! of the system's parameters
        character(:), allocatable :: changes, given
        integer :: i

        call read_changes(overrides, names, changes, given, same_motion)
        if (changes == "") return
        scene%changes = changes
        do i = 1, size(scene%expectations)
            scene%expectations(i)%judged = index(given, &
                " expect_"//lower(trim(scene%expectations(i)%name))//" ") > 0
        end do
        if (index(given, " title ") == 0) scene%title = heading(scene)//" ("//changes//")"
        if (index(given, " output ") == 0) call rename_output(scene, changes)
    end subroutine make_own_scene

    pure subroutine make_own_name(name, overrides, names, at, title)
        !! What is computed of a system with other parameters, or elsewhere than at its equilibrium,
        !! has a name for its files and a title of its own.
        character(:), allocatable, intent(inout) :: name  !! scene's or system's; gets the changes
        type(word_t), intent(in) :: overrides(:)          !! `GROUP%KEY=VALUE`, as typed
        character(*), intent(in) :: names(:)              !! of the system's parameters
        character(*), intent(in) :: at                    !! where else, or nothing
        character(:), allocatable, intent(out) :: title   !! `double pendulum (l1=2)`
        character(:), allocatable :: changes, given

        call read_changes(overrides, names, changes, given)
        if (at /= "") call add(changes, "at="//at)
        title = in_words(name)
        if (changes == "") return
        title = title//" ("//changes//")"
        name = name//"_"//name_of(changes)
    end subroutine make_own_name

    pure subroutine make_own_sweep(scene, file, overrides, names)
        !! Give a sweep that the command line changes a title that is true of it: other axes or
        !! numbers than those of the file are named, other values are added. A sweep that the file
        !! has keeps its output; one that is another has one of its own. Of a scene that has none
        !! the axes and numbers that are typed are no change.
        type(scene_t), intent(inout) :: scene     !! with the axes and what is kept
        type(scene_t), intent(in) :: file         !! the same without the command line
        type(word_t), intent(in) :: overrides(:)  !! `GROUP%KEY=VALUE`, as typed
        character(*), intent(in) :: names(:)      !! of the system's parameters
        character(:), allocatable :: axes, changes, given

        call read_changes(overrides, names, changes, given, same_sweep)
        axes = ""
        if (size(file%sweep%over) > 0 .and. size(file%sweep%keep) > 0) then
            call add_sweep_changes(scene%sweep, file%sweep, axes, changes)
        end if
        if (index(given, " title ") == 0) then
            if (numbers_over_axes(scene) /= numbers_over_axes(file)) then
                scene%title = trim(scene%name)//": "//numbers_over_axes(scene)
            end if
            if (changes /= "") scene%title = heading(scene)//" ("//changes//")"
        end if
        if (axes /= "" .and. changes /= "") axes = axes//", "
        if (axes//changes == "" .or. index(given, " output ") > 0) return
        call rename_output(scene, axes//changes)
    end subroutine make_own_sweep

    pure subroutine add_sweep_changes(sweep, file, axes, changes)
        !! What another sweep is than that of the file: its axes and what it keeps, which a title
        !! names otherwise, and the rest, which `changes` gets.
        type(sweep_group_t), intent(in) :: sweep, file
        character(:), allocatable, intent(inout) :: axes     !! empty; `theta=0:1:5, keep=period`
        character(:), allocatable, intent(inout) :: changes  !! `l=2`; `, seed=3` is added

        if (listed(sweep%over) /= listed(file%over)) call add(axes, listed(sweep%over))
        if (listed(sweep%keep) /= listed(file%keep)) call add(axes, "keep="//listed(sweep%keep))
        if (is_nonzero(sweep%after - file%after)) call add(changes, "after="//to_text( &
            sweep%after))
        if (sweep%strobe /= file%strobe) call add(changes, "strobe="//trim(sweep%strobe))
        if (sweep%section /= file%section) call add(changes, "section="//trim(sweep%section))
        if (sweep%points /= file%points) call add(changes, "points="//to_text(sweep%points))
        if (sweep%energy_by /= file%energy_by) call add(changes, "energy_by="// &
            trim(sweep%energy_by))
        if (sweep%most_steps /= file%most_steps) call add(changes, "most_steps="// &
            to_text(sweep%most_steps))
        if (sweep%seed /= file%seed) call add(changes, "seed="//to_text(sweep%seed))
    end subroutine add_sweep_changes

    pure function listed(texts) result(text)
        !! One behind the other, without blanks around `=`.
        character(*), intent(in) :: texts(:)
        character(:), allocatable :: text
        integer :: equals, i

        text = ""
        do i = 1, size(texts)
            equals = index(texts(i), "=")
            if (i > 1) text = text//","
            if (equals > 0) text = text//trim(adjustl(texts(i)(:equals - 1)))//"="
            text = text//trim(adjustl(texts(i)(equals + 1:)))
        end do
    end function listed

    pure subroutine add(changes, change)
        !! One more change, behind a comma.
        character(:), allocatable, intent(inout) :: changes
        character(*), intent(in) :: change

        if (changes /= "") changes = changes//", "
        changes = changes//change
    end subroutine add

    pure subroutine read_changes(overrides, names, changes, given, same)
        !! What overrides change, and which keys of `&scene` they give.
        type(word_t), intent(in) :: overrides(:)  !! `GROUP%KEY=VALUE`, as typed
        character(*), intent(in) :: names(:)      !! of the system's parameters
        character(:), allocatable, intent(out) :: changes  !! `l=2, q_1=0.5`
        character(:), allocatable, intent(out) :: given    !! ` title output `, or a blank
        character(*), intent(in), optional :: same(:)  !! keys of `&scene` that change nothing: all
        character(:), allocatable :: group, key, value
        integer :: i

        changes = ""
        given = " "
        do i = 1, size(overrides)
            call split(overrides(i)%text, group, key, value)
            if (group == "sweep" .or. said_before(i)) cycle
            if (group == "scene") then
                given = given//key//" "
                if (.not. present(same)) cycle
                if (any(same == without_index(key)) .or. index(key, "expect_") == 1) cycle
                if (any(names == key)) key = "scene_"//key  ! a parameter has that name as well
            else if (group == "lagrangian" .and. present(same)) then
                if (any(shown_only == key(:index(key//"(", "(") - 1))) cycle
            else
                key = as_described(key, names)
            end if
            call add(changes, key//"="//value)
        end do
    contains
        pure function said_before(k) result(yes)
            !! The same value of the same key twice changes no more than once.
            integer, intent(in) :: k
            logical :: yes
            character(:), allocatable :: group2, key2, value2
            integer :: j

            yes = .false.
            do j = 1, k - 1
                call split(overrides(j)%text, group2, key2, value2)
                yes = yes .or. (group2 == group .and. key2 == key .and. value2 == value)
            end do
        end function said_before
    end subroutine read_changes

    pure function without_index(key) result(name)
        !! `columns` of `columns_2`, as `split` writes an element.
        character(*), intent(in) :: key
        character(:), allocatable :: name
        integer :: last

        last = index(key, "_", back=.true.)
        name = key
        if (last > 1 .and. verify(key(last + 1:), "0123456789:,") == 0) name = key(:last - 1)
    end function without_index

    pure subroutine rename_output(scene, changes)
        !! The changes go before the ending of its file's name.
        type(scene_t), intent(inout) :: scene
        character(*), intent(in) :: changes
        integer :: dot

        dot = ending_start(trim(scene%output))
        scene%output = scene%output(:dot - 1)//"_"//name_of(changes)//scene%output(dot:)
    end subroutine rename_output

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
        !! Where the ending of a file's name begins: a dot and up to four letters make one;
        !! `l_2.5`, `pendulum.v2` and `.hidden` have none, and then it is behind the name.
        character(*), intent(in) :: name  !! of a file, perhaps below a folder
        integer :: dot

        dot = index(name, ".", back=.true.)
        if (dot > index(name, "/", back=.true.) + 1 .and. dot < len(name) .and. &
            dot + 4 >= len(name)) then
            if (verify(lower(name(dot + 1:)), "abcdefghijklmnopqrstuvwxyz") == 0) return
        end if
        dot = len(name) + 1
    end function ending_start

    pure subroutine split(text, group, key, value)
        !! `Scene%q(2) = 0.5` into `scene`, `q` and, with the index, what follows; no blanks but
        !! those within a text.
        character(*), intent(in) :: text
        character(:), allocatable, intent(out) :: group, key, value
        integer :: equals, percent

        percent = index(text, "%")
        equals = index(text, "=")
        group = lower(without_blanks(text(:percent - 1)))
        key = lower(without_blanks(text(percent + 1:equals - 1)))
        value = without_blanks(text(equals + 1:))
        if (index(key, "(") > 0 .and. group == "scene") key = key(:index(key, "(") - 1)//"_"// &
            key(index(key, "(") + 1:index(key//")", ")") - 1)
    end subroutine split

    pure function without_blanks(text) result(plain)
        !! The text without blanks, but those between quotes and between two words: `2 k x`.
        character(*), intent(in) :: text
        character(:), allocatable :: plain
        character(1) :: mark
        integer :: i, next

        plain = ""
        mark = " "
        do i = 1, len(text)
            if (mark /= " ") then
                if (text(i:i) == mark) mark = " "
            else if (text(i:i) == "'" .or. text(i:i) == """") then
                mark = text(i:i)
            else if (text(i:i) <= " ") then
                next = i + verify(text(i:)//"=", " ") - 1
                if (plain == "" .or. next > len(text)) cycle
                if (.not. (in_word(plain(len(plain):)) .and. in_word(text(next:next)))) cycle
            end if
            plain = plain//text(i:i)
        end do
    end function without_blanks

    elemental function in_word(byte) result(yes)
        !! Is it a letter, a digit, a low line or a point?
        character(1), intent(in) :: byte
        logical :: yes

        yes = index("abcdefghijklmnopqrstuvwxyz0123456789_.", lower(byte)) > 0
    end function in_word

    pure function is_ambiguous(changes) result(yes)
        !! Would the file of other changes have the same letters? `k*x` and `k/x` are both `k_x`.
        character(*), intent(in) :: changes
        logical :: yes
        character(1) :: mark
        integer :: i

        yes = .true.
        mark = " "
        do i = 1, len(changes)
            if (mark /= " ") then
                if (changes(i:i) == mark) then
                    mark = " "
                else if (index(plain_letters, changes(i:i)) == 0) then
                    return
                end if
            else if (changes(i:i) == "'" .or. changes(i:i) == """") then
                mark = changes(i:i)
            else if (changes(i:i) == " ") then
                if (i > 1 .and. changes(max(1, i - 1):max(1, i - 1)) /= ",") return
            else if (index(plain_letters//"=,():+", changes(i:i)) == 0) then
                return
            end if
        end do
        yes = .false.
    end function is_ambiguous

    pure function name_of(changes) result(name)
        !! The same in letters that `output` takes, `m1_5_dt_1e-3`, and a sum of its bytes where
        !! these do not tell it from another.
        character(*), intent(in) :: changes
        character(:), allocatable :: name
        integer :: i

        name = ""
        do i = 1, len(changes)
            if (changes(i:i) == " " .or. changes(i:i) == "+") cycle
            if (index(plain_letters, changes(i:i)) > 0) then
                name = name//changes(i:i)
            else
                name = name//"_"
            end if
        end do
        if (is_ambiguous(changes)) name = name//"_"//checksum(changes)
        if (len(name) > longest) name = "changed_"//checksum(changes)
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
