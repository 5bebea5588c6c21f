module course_runs
    !! For tests of the shipped scenes of the course: read one, and follow its system from any
    !! state.
    use funit, only: assertEqual
    use lagrangia_command_line, only: word_t
    use lagrangia_description, only: description_t
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp
    use lagrangia_recorder, only: recorder_t
    use lagrangia_scene, only: scene_t
    use lagrangia_scene_reader, only: parse_scene
    use lagrangia_shipped_files, only: read_file_or_shipped
    use lagrangia_small_oscillations, only: find_modes, likely_equilibrium, modes_t
    use lagrangia_solve, only: solve
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: follow, is_conserved, modes_of, open_scene, value_of

    real(dp), parameter :: least = 1e-13_dp  !! tolerance of a step

contains

    subroutine open_scene(name, overrides, scene, system)
        !! A shipped scene by its name, without what it expects, with words as behind `--set`, a
        !! semicolon behind each.
        character(*), intent(in) :: name, overrides
        type(scene_t), intent(out) :: scene
        class(system_t), allocatable, intent(out) :: system
        type(error_t), allocatable :: error
        type(word_t), allocatable :: words(:)
        character(:), allocatable :: path, text
        integer :: first, i, last

        allocate (words(count([(overrides(i:i) == ";", i=1, len(overrides))])))
        first = 1
        do i = 1, size(words)
            last = first + index(overrides(first:), ";") - 2
            words(i)%text = overrides(first:last)
            first = last + 2
        end do
        path = "data/scenes/"//name//".nml"
        call read_file_or_shipped(path, text, error)
        if (.not. allocated(error)) call leave_out_expectations(text)
        if (.not. allocated(error)) call parse_scene(text, path, words, scene, system, error)
        if (allocated(error)) call assertEqual("", error%message, name)
    end subroutine open_scene

    pure subroutine leave_out_expectations(text)
        !! The lines that begin with `expect_`, so that a changed system may be what it is.
        character(:), allocatable, intent(inout) :: text
        integer :: at, behind

        do
            at = index(text, new_line("a")//"  expect_")
            if (at == 0) return
            behind = at + index(text(at + 1:), new_line("a"))
            text = text(:at - 1)//text(behind:)
        end do
    end subroutine leave_out_expectations

    subroutine follow(system, times, q0, v0, q, v, events, found)
        !! The states at these times, each step of `gauss16` right to some \(10^{-13}\); events too.
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: times(:), q0(:), v0(:)
        real(dp), allocatable, intent(out) :: q(:, :), v(:, :)
        character(*), intent(in), optional :: events(:)
        type(recorder_t), intent(out), optional :: found
        type(error_t), allocatable :: error

        if (present(found)) then
            call solve(system, "gauss16", times, q0, v0, q, v, error, tolerance=least, &
                       events=events, found=found)
        else
            call solve(system, "gauss16", times, q0, v0, q, v, error, tolerance=least)
        end if
        if (allocated(error)) call assertEqual("", error%message, "it runs")
    end subroutine follow

    pure function value_of(system, name, t, q, v) result(value)
        !! A quantity by its name.
        class(system_t), intent(in) :: system
        character(*), intent(in) :: name
        real(dp), intent(in) :: t, q(:), v(:)
        real(dp) :: value
        type(description_t) :: d
        integer :: i

        call system%describe(d)
        i = findloc(d%quantities%name == name, .true., 1)
        value = system%quantity(i, t, q, v)
    end function value_of

    pure function is_conserved(system, name) result(yes)
        !! Does the program know that this quantity, which there must be, does not change?
        class(system_t), intent(in) :: system
        character(*), intent(in) :: name
        logical :: yes
        type(description_t) :: d
        integer :: i

        call system%describe(d)
        i = findloc(d%quantities%name == name, .true., 1)
        if (i == 0) error stop "no such quantity"
        yes = d%quantities(i)%conserved
    end function is_conserved

    subroutine modes_of(system, modes)
        !! The small oscillations about the equilibrium that the scene names, or zero.
        class(system_t), intent(in) :: system
        type(modes_t), intent(out) :: modes
        type(error_t), allocatable :: error

        call find_modes(system, likely_equilibrium(system), .false., modes, error)
        if (allocated(error)) call assertEqual("", error%message, "it has modes")
    end subroutine modes_of
end module course_runs
