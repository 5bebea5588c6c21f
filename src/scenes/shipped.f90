module lagrangia_shipped
    !! The scenes that have names: the files of `data/scenes` in the working folder, and those that
    !! the program carries with it.
    use, intrinsic :: iso_c_binding, only: c_char, c_f_pointer, c_funptr, c_int, c_null_char, &
                                           c_null_funptr, c_ptr, c_size_t
    use lagrangia_command_line, only: has_outer_blanks, is_same, word_t
    use lagrangia_errors, only: error_t, fail, status_file, status_usage
    use lagrangia_files, only: facts_t, fortran_text, look_at
    use lagrangia_names, only: nearest_name
    use lagrangia_shipped_files, only: shipped_files
    use lagrangia_text, only: quoted, short_source
    implicit none (type, external)
    private
    public :: shipped_scenes, named_scenes, named_sweeps, find_scene, find_sweep
    public :: file_advice, looks_like_path, names_file, scene_name

    character(*), parameter :: folder = "data/scenes/", sweeps = "data/sweeps/"
    character(*), parameter :: ending = ".nml"

    type, bind(c) :: glob_t
        !! glibc's `glob_t`; the rest of it (flags, function pointers) is only room.
        integer(c_size_t) :: count = 0
        type(c_ptr) :: paths
        integer(c_size_t) :: rest(16) = 0
    end type glob_t

    interface
        function c_glob(pattern, flags, on_error, found) bind(c, name="glob") result(status)
            import :: c_char, c_int, c_funptr, glob_t
            implicit none (type, external)
            character(kind=c_char), intent(in) :: pattern(*)  !! ends in NUL
            integer(c_int), value :: flags
            type(c_funptr), value :: on_error
            type(glob_t), intent(inout) :: found
            integer(c_int) :: status
        end function c_glob

        subroutine c_globfree(found) bind(c, name="globfree")
            import :: glob_t
            implicit none (type, external)
            type(glob_t), intent(inout) :: found
        end subroutine c_globfree
    end interface

contains

    subroutine shipped_scenes(paths)
        !! The paths of the scenes that `lagrangia` alone runs, in alphabetical order: those of the
        !! working folder; where it has none, those that the program carries.
        type(word_t), allocatable, intent(out) :: paths(:)  !! from the working folder

        call scenes_here(folder, paths)
        if (size(paths) == 0) call shipped_files(folder, paths)
    end subroutine shipped_scenes

    subroutine named_scenes(paths)
        !! The paths of all scenes that a name alone finds: those of the working folder, and then
        !! those that the program carries and the folder does not have.
        type(word_t), allocatable, intent(out) :: paths(:)  !! from the working folder

        call named_in(folder, paths)
    end subroutine named_scenes

    subroutine named_sweeps(paths)
        !! The same of the scenes with a group `&sweep`.
        type(word_t), allocatable, intent(out) :: paths(:)  !! from the working folder

        call named_in(sweeps, paths)
    end subroutine named_sweeps

    subroutine find_sweep(name, path, error)
        !! `find_scene`, but first among the scenes with a group `&sweep`.
        character(*), intent(in) :: name  !! of a scene, or a path
        character(:), allocatable, intent(out) :: path  !! for `read_scene`
        type(error_t), allocatable, intent(out) :: error  !! names the nearest scene
        type(word_t), allocatable :: paths(:)
        integer :: i

        if (.not. looks_like_path(name)) then
            call named_sweeps(paths)
            do i = 1, size(paths)
                path = paths(i)%text
                if (is_same(scene_name(path), name)) return
            end do
        end if
        call find_scene(name, path, error)
    end subroutine find_sweep

    subroutine named_in(folder, paths)
        !! The scenes of a folder of the working folder, and then those that the program carries
        !! and the folder does not have.
        character(*), intent(in) :: folder
        type(word_t), allocatable, intent(out) :: paths(:)
        type(word_t), allocatable :: here(:), carried(:)
        logical, allocatable :: other(:)
        integer :: i, k, n

        call scenes_here(folder, here)
        call shipped_files(folder, carried)
        allocate (other(size(carried)), source=.true.)
        do i = 1, size(carried)
            do k = 1, size(here)
                if (is_same(carried(i)%text, here(k)%text)) other(i) = .false.
            end do
        end do
        allocate (paths(size(here) + count(other)))
        n = size(here)
        do i = 1, n
            paths(i)%text = here(i)%text
        end do
        do i = 1, size(carried)
            if (.not. other(i)) cycle
            n = n + 1
            paths(n)%text = carried(i)%text
        end do
    end subroutine named_in

    subroutine scenes_here(folder, paths)
        !! Those of the working folder, in alphabetical order.
        character(*), intent(in) :: folder
        type(word_t), allocatable, intent(out) :: paths(:)
        type(glob_t) :: found
        type(c_ptr), pointer :: list(:)
        integer :: i

        if (c_glob(folder//"*"//ending//c_null_char, 0_c_int, c_null_funptr, found) /= 0) then
            allocate (paths(0))
            return
        end if
        call c_f_pointer(found%paths, list, [found%count])
        allocate (paths(size(list)))
        do i = 1, size(list)
            paths(i)%text = fortran_text(list(i))
        end do
        call c_globfree(found)
    end subroutine scenes_here

    subroutine find_scene(name, path, error)
        !! The path of a scene: `name` itself if it looks like a path, or a named scene's. Fails
        !! where neither is there.
        character(*), intent(in) :: name  !! of a scene, or a path
        character(:), allocatable, intent(out) :: path  !! for `read_scene`
        type(error_t), allocatable, intent(out) :: error  !! names the nearest scene
        type(word_t), allocatable :: paths(:)
        character(255), allocatable :: names(:)  !! no file's name is longer
        character(:), allocatable :: near
        type(facts_t) :: facts
        logical :: is_path
        integer :: i

        path = name
        is_path = looks_like_path(name)
        if (is_path) then
            facts = look_at(name)
            if (facts%found .or. facts%barred) return  ! the reader says what bars it
        end if
        call named_scenes(paths)
        allocate (names(size(paths)))
        do i = 1, size(paths)
            names(i) = scene_name(paths(i)%text)
            if (is_same(trim(names(i)), name) .and. .not. is_path) then
                path = paths(i)%text
                return
            end if
        end do
        near = remedy(name, names)
        facts = look_at(trim(adjustl(name)))
        if (has_outer_blanks(name) .and. facts%found) near = "; there is one without "// &
            "that blank"
        if (names_file(name)) near = file_advice(name)
        if (is_path) then
            call fail(error, trim(short_source(name))//": no such file"//near, status_file)
        else
            call fail(error, "unknown scene "//quoted(name)//near, status_usage)
        end if
    end subroutine find_scene

    function names_file(name) result(yes)
        !! Is it a scene's file but for its ending?
        character(*), intent(in) :: name  !! what was typed
        logical :: yes
        type(facts_t) :: facts

        yes = .false.
        if (name == "" .or. has_outer_blanks(name)) return
        facts = look_at(name//ending)
        yes = facts%found
    end function names_file

    pure function file_advice(name) result(text)
        !! `; did you mean 'mine.nml'?`
        character(*), intent(in) :: name  !! without its ending
        character(:), allocatable :: text

        text = "; did you mean '"//trim(short_source(name//ending))//"'?"
    end function file_advice

    pure function looks_like_path(name) result(yes)
        !! Is it a file's rather than a shipped scene's name?
        character(*), intent(in) :: name  !! what was typed
        logical :: yes

        yes = index(name, "/") > 0 .or. index(name, ending) > 0
    end function looks_like_path

    pure function remedy(name, names) result(text)
        !! What to type in the place of `name`, where there are the scenes `names`.
        character(*), intent(in) :: name, names(:)
        character(:), allocatable :: text

        text = nearest_name(scene_name(name), names)
        if (text /= "") then
            text = "; did you mean '"//text//"'?"
        else if (index(name, "=") > 0) then
            text = "; a value is set by --set GROUP%KEY=VALUE"
        else
            text = "; 'lagrangia list scenes' shows the names, a path ends in .nml"
        end if
    end function remedy

    pure function scene_name(path) result(name)
        !! The file's name without its folder and its ending.
        character(*), intent(in) :: path  !! of a scene's file
        character(:), allocatable :: name
        integer :: dot

        name = path(index(path, "/", back=.true.) + 1:)
        dot = index(name, ".", back=.true.)
        if (dot > 1) name = name(:dot - 1)
    end function scene_name
end module lagrangia_shipped
