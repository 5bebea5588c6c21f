module sweep_numbers
    !! A sweep from a text, and all its numbers at once, as its data file would have them.
    use funit, only: assertEqual
    use lagrangia_command_line, only: word_t
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_observer, only: observer_t
    use lagrangia_scene, only: scene_t
    use lagrangia_scene_reader, only: parse_scene
    use lagrangia_sweep, only: new_sweep, sweep_t
    use lagrangia_sweep_grid, only: compute_grid, sweep_result_t
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: compute_numbers, make_sweep, sweep_numbers_t

    type :: sweep_numbers_t
        !! What came out.
        type(sweep_result_t) :: of
        real(dp), allocatable :: values(:, :)     !! (`sweep%width()`, trajectories)
        integer :: failures = 0
        character(:), allocatable :: reason
        logical :: in_lanes = .false.
    end type sweep_numbers_t

contains

    subroutine make_sweep(text, over, keep, sweep, error)
        !! The sweep of a scene in `text`. Without `error` there must be none.
        character(*), intent(in) :: text, over(:), keep(:)
        type(sweep_t), intent(out) :: sweep
        type(error_t), allocatable, intent(out), optional :: error
        type(error_t), allocatable :: refusal
        class(system_t), allocatable :: system
        type(scene_t) :: scene
        type(word_t) :: none(0)

        call parse_scene(text, "text", none, scene, system, refusal)
        if (.not. allocated(refusal)) call new_sweep(sweep, scene, system, over, keep, 1, &
                                                     scene%sweep%after, refusal)
        if (present(error)) then
            call move_alloc(refusal, error)
        else if (allocated(refusal)) then
            call assertEqual("", refusal%message, "the sweep")
        end if
    end subroutine make_sweep

    subroutine compute_numbers(sweep, threads, result, error)
        !! Compute and read them, in memory.
        type(sweep_t), intent(in) :: sweep
        integer, intent(in) :: threads
        type(sweep_numbers_t), intent(out) :: result
        type(error_t), allocatable, intent(out) :: error
        class(observer_t), pointer :: nobody
        real(dp), allocatable :: values(:, :)
        integer(i8) :: block

        nullify (nobody)
        call compute_grid(sweep, threads, nobody, result%of, error)
        if (allocated(error)) return
        allocate (result%values(sweep%width(), sweep%trajectories()))
        do block = 1, result%of%store%blocks
            call result%of%read_block(sweep, block, values, error)
            if (allocated(error)) return
            associate (store => result%of%store)
                result%values(:, store%first_of(block):store%last_of(block)) = values
            end associate
        end do
        result%failures = int(result%of%failures)
        if (allocated(result%of%reason)) result%reason = result%of%reason
        result%in_lanes = result%of%in_lanes
    end subroutine compute_numbers
end module sweep_numbers
