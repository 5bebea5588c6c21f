module lagrangia_sweep_group
    !! The group `&sweep` of a scene: over what many trajectories of it differ, and what is kept of
    !! each. `lagrangia run` runs the scene alone.
    use lagrangia_description, only: name_length
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_namelist, only: get_integer, get_real, get_string, get_strings, &
                                  has_group, namelist_t, refuse_unknown_keys, refuse_value
    use lagrangia_scene, only: add_texts, most_axes, scene_line_length, sweep_group_t
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: group, keys, read_sweep_group, sweep_lines

    character(*), parameter :: group = "sweep"
    character(name_length), parameter :: keys(*) = [character(name_length) :: &
        "over", "keep", "after", "strobe", "section", "points", "energy_by", "most_steps", &
        "seed", "threads"]
    integer, parameter :: most_kept = 20, most_points = 1000000

contains

    subroutine read_sweep_group(tree, sweep, error)
        !! What the group says, if it is there.
        type(namelist_t), intent(inout) :: tree           !! keys that are read are marked as used
        type(sweep_group_t), intent(out) :: sweep         !! else as by default
        type(error_t), allocatable, intent(out) :: error  !! a value that is not allowed
        integer(i8), parameter :: not_given = -huge(1_i8)
        integer(i8) :: points, seed, threads

        allocate (sweep%over(0), sweep%keep(0))
        if (.not. has_group(tree, group)) return
        call get_strings(tree, group, "over", 1, most_axes, sweep%over, error)
        if (allocated(error)) return
        call get_strings(tree, group, "keep", 1, most_kept, sweep%keep, error)
        if (allocated(error)) return
        call get_real(tree, group, "after", sweep%after, error)
        if (allocated(error)) return
        call get_string(tree, group, "strobe", sweep%strobe, error)
        if (allocated(error)) return
        call get_string(tree, group, "section", sweep%section, error)
        if (allocated(error)) return
        call get_string(tree, group, "energy_by", sweep%energy_by, error)
        if (allocated(error)) return
        points = sweep%points
        call get_integer(tree, group, "points", points, error)
        if (allocated(error)) return
        if (points < 1 .or. points > most_points) then
            call refuse_value(tree, group, "points", "a number from 1 to "// &
                              to_text(most_points)//" is needed", error)
            return
        end if
        sweep%points = int(points)
        call get_integer(tree, group, "most_steps", sweep%most_steps, error)
        if (allocated(error)) return
        if (sweep%most_steps < 1) then
            call refuse_value(tree, group, "most_steps", "a whole number from 1 on is needed", &
                              error)
            return
        end if
        seed = sweep%seed
        call get_integer(tree, group, "seed", seed, error)
        if (allocated(error)) return
        if (abs(seed) > huge(0)) then
            call refuse_value(tree, group, "seed", "a whole number from -2147483647 to "// &
                              "2147483647 is needed", error)
            return
        end if
        threads = not_given
        call get_integer(tree, group, "threads", threads, error)
        if (allocated(error)) return
        if (threads == not_given) then
            threads = sweep%threads
        else if (threads < 1 .or. threads > 10000) then
            call refuse_value(tree, group, "threads", "a number from 1 to 10000 is needed", error)
            return
        end if
        sweep%seed = int(seed)
        sweep%threads = int(threads)
        call refuse_unknown_keys(tree, group, keys, error)
    end subroutine read_sweep_group

    function sweep_lines(sweep) result(lines)
        !! The group `&sweep` as it was computed, for the file's header.
        type(sweep_group_t), intent(in) :: sweep  !! all that it says
        character(scene_line_length), allocatable :: lines(:)

        lines = [character(scene_line_length) :: "&sweep"]
        call add_texts(lines, "over", sweep%over)
        call add_texts(lines, "keep", sweep%keep)
        if (sweep%after > -huge(1.0_dp)) call add("after = "//to_text(sweep%after))
        if (sweep%strobe /= "") call add_texts(lines, "strobe", [sweep%strobe])
        if (sweep%section /= "") call add_texts(lines, "section", [sweep%section])
        if (sweep%strobe /= "" .or. sweep%section /= "") call add("points = "// &
            to_text(sweep%points))
        if (sweep%energy_by /= "") call add_texts(lines, "energy_by", [sweep%energy_by])
        if (sweep%most_steps < huge(1_i8)) call add("most_steps = "//to_text(sweep%most_steps))
        call add("seed = "//to_text(sweep%seed))
        lines = [character(scene_line_length) :: lines, "/"]
    contains
        subroutine add(text)
            character(*), intent(in) :: text

            lines = [character(scene_line_length) :: lines, "  "//text]
        end subroutine add
    end function sweep_lines
end module lagrangia_sweep_group
