module lagrangia_show
    !! `lagrangia show [FILE...]`: the scenes, sweeps and sheets that come with the program, as
    !! they are.
    use lagrangia_command_line, only: command_line_t
    use lagrangia_console, only: put, put_line
    use lagrangia_errors, only: error_t, fail
    use lagrangia_names, only: name_length, nearest_name
    use lagrangia_shipped, only: scene_name
    use lagrangia_shipped_files, only: shipped_files, shipped_text
    use lagrangia_text, only: quoted, word_t
    implicit none (type, external)
    private
    public :: show_command

contains

    subroutine show_command(line, error)
        !! Print the files that are named; without a name, list them.
        type(command_line_t), intent(in) :: line          !! what was typed
        type(error_t), allocatable, intent(out) :: error  !! a name is unknown: nothing is printed
        character(name_length), allocatable :: names(:)
        type(word_t), allocatable :: paths(:), chosen(:)
        character(:), allocatable :: near, text
        integer :: i, k

        call shipped_files("data/", paths)
        allocate (names(2*size(paths)), chosen(size(line%arguments)))
        do i = 1, size(paths)
            names(i) = scene_name(paths(i)%text)
            names(size(paths) + i) = paths(i)%text(index(paths(i)%text, "/", back=.true.) + 1:)
        end do
        if (size(line%arguments) == 0) then
            do i = 1, size(paths)
                call put_line(paths(i)%text(len("data/") + 1:))
            end do
            return
        end if
        do i = 1, size(chosen)
            associate (word => line%arguments(i)%text)
                do k = 1, size(paths)
                    if (.not. is_meant(word, paths(k)%text)) cycle
                    chosen(i)%text = paths(k)%text
                    exit
                end do
                if (.not. allocated(chosen(i)%text)) call take_stem(word, chosen(i))
                if (allocated(chosen(i)%text)) cycle
                near = nearest_name(word, names)
                if (any(names == word)) then
                    near = "there are several of that name; 'lagrangia show' lists them"
                else if (near /= "") then
                    near = "did you mean '"//near//"'?"
                else
                    near = "'lagrangia show' lists them"
                end if
                call fail(error, "no file "//quoted(word)//" comes with the program; "//near)
                return
            end associate
        end do
        do i = 1, size(chosen)
            call shipped_text(chosen(i)%text, text)
            call put(text)
        end do
    contains
        subroutine take_stem(word, choice)
            !! The only file that is called so but for its ending.
            character(*), intent(in) :: word
            type(word_t), intent(inout) :: choice
            integer :: which

            if (count(names(:size(paths)) == word) /= 1) return
            which = findloc(names(:size(paths)), word, 1)
            choice%text = paths(which)%text
        end subroutine take_stem
    end subroutine show_command

    pure function is_meant(word, path) result(yes)
        !! Is `word` the path from `data` on, the file's name, or a scene's name?
        character(*), intent(in) :: word, path
        logical :: yes

        yes = ends(path, "/"//word) .or. ends(path, "/scenes/"//word//".nml") .or. &
              ends(path, "/sweeps/"//word//".nml")
    end function is_meant

    pure function ends(text, ending) result(yes)
        !! Does the text end so?
        character(*), intent(in) :: text, ending
        logical :: yes

        yes = len(text) >= len(ending)
        if (yes) yes = text(len(text) - len(ending) + 1:) == ending
    end function ends
end module lagrangia_show
