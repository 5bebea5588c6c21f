module lagrangia_list
    !! `lagrangia list [systems|methods|scenes|sweeps]`: what there is, one a line.
    use lagrangia_catalogue, only: nth_system
    use lagrangia_command_line, only: command_line_t, word_t
    use lagrangia_console, only: put_line
    use lagrangia_description, only: description_t
    use lagrangia_errors, only: error_t, fail
    use lagrangia_integrator, only: dense_integrator_t, integrator_t
    use lagrangia_methods, only: auto, nth_adaptive, nth_integrator
    use lagrangia_names, only: advice
    use lagrangia_scene, only: scene_t
    use lagrangia_scene_reader, only: read_scene
    use lagrangia_shipped, only: named_scenes, named_sweeps
    use lagrangia_system, only: system_t
    use lagrangia_text, only: quoted, to_text
    implicit none (type, external)
    private
    public :: list_command

contains

    subroutine list_command(line, error)
        !! Print one list, or all under their titles.
        type(command_line_t), intent(in) :: line  !! what was typed
        type(error_t), allocatable, intent(out) :: error  !! allocated where it fails
        character(8), parameter :: kinds(4) = ["systems ", "methods ", "scenes  ", "sweeps  "]
        character(:), allocatable :: what
        integer :: i

        what = ""
        if (size(line%arguments) > 0) what = line%arguments(1)%text
        if (size(line%arguments) > 0 .and. .not. any(kinds == what)) then
            call fail(error, "cannot list "//quoted(what)//"; "//advice(what, kinds))
            return
        end if
        do i = 1, size(kinds)
            if (what /= "" .and. kinds(i) /= what) cycle
            if (what == "") call put_line(trim(kinds(i)))
            select case (i)
            case (1); call list_systems()
            case (2); call list_methods()
            case (3); call list_scenes(named_scenes, error)
            case default; call list_scenes(named_sweeps, error)
            end select
            if (allocated(error)) return
        end do
    contains
        subroutine put(name, meaning)
            character(*), intent(in) :: name, meaning

            call put_line(repeat("  ", merge(1, 0, what == ""))//trim(name)// &
                          repeat(" ", max(2, 28 - len_trim(name)))//trim(meaning))
        end subroutine put

        subroutine list_systems()
            class(system_t), allocatable :: system
            type(description_t) :: d
            integer :: k

            k = 0
            do
                k = k + 1
                call nth_system(k, system)
                if (.not. allocated(system)) exit
                call system%describe(d)
                call put(d%name, d%title)
            end do
        end subroutine list_systems

        subroutine list_methods()
            class(integrator_t), allocatable :: integrator
            class(dense_integrator_t), allocatable :: adaptive
            integer :: k

            k = 0
            do
                k = k + 1
                call nth_integrator(k, integrator)
                if (.not. allocated(integrator)) exit
                call put(integrator%name, integrator%properties()//": "//integrator%title)
            end do
            k = 0
            do
                k = k + 1
                call nth_adaptive(k, adaptive)
                if (.not. allocated(adaptive)) exit
                call put(adaptive%name, "order "//to_text(adaptive%order)//", steps by "// &
                         "tolerance: "//adaptive%title)
            end do
            call put(auto, "a closed form where one is known; otherwise gauss16, mostly the "// &
                     "fastest")
        end subroutine list_methods

        subroutine list_scenes(named, error)
            interface
                subroutine named(paths)
                    import :: word_t
                    implicit none (type, external)
                    type(word_t), allocatable, intent(out) :: paths(:)
                end subroutine named
            end interface
            type(error_t), allocatable, intent(out) :: error
            type(word_t), allocatable :: paths(:)
            class(system_t), allocatable :: system
            type(scene_t) :: scene
            integer :: k

            call named(paths)
            do k = 1, size(paths)
                call read_scene(paths(k)%text, [word_t ::], scene, system, error)
                if (allocated(error)) return
                call put(scene%name, scene%title)
            end do
        end subroutine list_scenes
    end subroutine list_command
end module lagrangia_list
