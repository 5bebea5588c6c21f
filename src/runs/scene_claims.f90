module lagrangia_scene_claims
    !! All files of a scene, so that those of a run can be compared before any of them is written.
    use lagrangia_data_files, only: data_path, event_path, pictures, scene_path, script_path
    use lagrangia_disk_space, only: space_warning
    use lagrangia_errors, only: error_t, fail
    use lagrangia_files, only: facts_t, look_at, read_whole_file
    use lagrangia_kinds, only: dp
    use lagrangia_number_text, only: field_width
    use lagrangia_output_file, only: partial_ending
    use lagrangia_places, only: places_t
    use lagrangia_scene, only: scene_t
    use lagrangia_scene_keys, only: refuse_output
    use lagrangia_system, only: system_t
    use lagrangia_text, only: quoted
    implicit none (type, external)
    private
    public :: claim_alone, claim_files, claim_picture, claim_scene, claim_table, size_warning

    character(*), parameter :: written_by = "! lagrangia "  !! a scene of ours begins with it

contains

    subroutine claim_alone(scene, system, folder, format, error)
        !! Of a run of this scene only: see `claim_files`.
        type(scene_t), intent(in) :: scene  !! to be run
        class(system_t), intent(in) :: system  !! with the scene's parameters
        character(*), intent(in) :: folder, format  !! of the data files
        type(error_t), allocatable, intent(out) :: error  !! two files are one
        type(places_t) :: places

        call claim_scene(scene, places, error)
        if (.not. allocated(error)) call claim_files(scene, system, folder, format, places, error)
    end subroutine claim_alone

    subroutine claim_scene(scene, places, error)
        !! The file that the scene was read from; fails where it was claimed before.
        type(scene_t), intent(in) :: scene  !! was read from a file, or not
        type(places_t), intent(inout) :: places  !! claimed so far; gets this one
        type(error_t), allocatable, intent(out) :: error  !! it was claimed before

        if (allocated(scene%source)) call places%add(scene%source, "scene", "", error)
    end subroutine claim_scene

    subroutine claim_files(scene, system, folder, format, places, error)
        !! What a run of the scene may write, or its scripts draw; fails (status 2) where a file of
        !! it is one that was claimed before. Claim all scenes of a run first.
        type(scene_t), intent(in) :: scene  !! to be run
        class(system_t), intent(in) :: system  !! with the scene's parameters
        character(*), intent(in) :: folder, format  !! of the data files
        type(places_t), intent(inout) :: places  !! claimed so far; gets these
        type(error_t), allocatable, intent(out) :: error  !! names both owners
        character(:), allocatable :: owner, path

        call refuse_output(scene%output, error)
        if (allocated(error)) return
        owner = trim(scene%name)
        path = data_path(folder, trim(scene%output), format)
        call claim_table(path, "data", owner, places, error)
        if (allocated(error)) return
        if (.not. (allocated(scene%events) .or. system%contacts > 0)) return
        call claim_table(event_path(path), "event", owner, places, error)
    end subroutine claim_files

    subroutine claim_table(path, kind, owner, places, error)
        !! The table at `path`, what remains of it where its run fails, its script and pictures.
        character(*), intent(in) :: path, kind, owner
        !! of the table; `data` or `event`; a scene's name
        type(places_t), intent(inout) :: places  !! claimed so far; gets these
        type(error_t), allocatable, intent(out) :: error  !! names both owners
        character(:), allocatable :: stem

        stem = script_path(path)
        stem = stem(:len(stem) - 2)
        call places%add(path, kind//" file", owner, error)
        if (.not. allocated(error)) call claim_picture(path, kind, owner, places, error)
        if (.not. allocated(error)) call places%add(stem//"html", kind//" animation", owner, error)
        if (.not. allocated(error)) call places%add(scene_path(path), "scene of the "//kind// &
                                                    " file", owner, error)
        if (.not. allocated(error)) call places%add(path//partial_ending, "partial "//kind// &
                                                    " file", owner, error)
        if (.not. allocated(error) .and. path /= stem//"dat") call keep_scene(scene_path(path), &
                                                                              error)
    end subroutine claim_table

    subroutine claim_picture(path, kind, owner, places, error)
        !! The script and the pictures beside a table, or of several tables together.
        character(*), intent(in) :: path, kind, owner
        !! of the table, if there is one; `data`, `overlay`; a scene's name
        type(places_t), intent(inout) :: places  !! claimed so far; gets these
        type(error_t), allocatable, intent(out) :: error  !! names both owners
        character(:), allocatable :: script
        integer :: i

        script = script_path(path)
        call places%add(script, kind//" script", owner, error)
        do i = 1, size(pictures)
            if (.not. allocated(error)) call places%add(script(:len(script) - 2)//pictures(i), &
                                                        kind//" picture", owner, error)
        end do
    end subroutine claim_picture

    subroutine keep_scene(path, error)
        !! The scene beside a csv or npy file takes the place of an earlier one that was written
        !! like it, never of a scene that somebody else has written.
        character(*), intent(in) :: path
        type(error_t), allocatable, intent(out) :: error
        character(:), allocatable :: text
        type(error_t), allocatable :: none
        type(facts_t) :: facts

        facts = look_at(path)
        if (.not. facts%found) return
        call read_whole_file(path, text, none)
        if (allocated(none)) return  ! what is there will be refused for itself
        if (index(text, written_by) /= 1) call fail(error, quoted(path)//" is a file that "// &
            "lagrangia has not written, and it would write its scene there; another "// &
            "'--output' or output keeps it")
    end subroutine keep_scene

    function size_warning(scene, folder, format) result(text)
        !! A line for the user where a run of the scene would write very much, or more than there is
        !! room for; else nothing.
        type(scene_t), intent(in) :: scene  !! to be run
        character(*), intent(in) :: folder, format  !! of the data files
        character(:), allocatable :: text
        real(dp) :: rows
        integer :: width

        rows = real(scene%samples, dp)
        if (scene%tolerance <= 0.0_dp) rows = scene%duration/scene%dt/scene%every
        width = merge(8, field_width + 1, format == "npy")
        text = space_warning((rows + 1.0_dp)*width*size(scene%columns), folder)
    end function size_warning
end module lagrangia_scene_claims
