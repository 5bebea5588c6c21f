module lagrangia_bench_problems
    !! The problems that every method is given, with their solutions: `data/reference/bench.nml`.
    use lagrangia_catalogue, only: new_system
    use lagrangia_description, only: name_length
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp
    use lagrangia_namelist, only: get_real, get_reals, get_string, namelist_t, parse_namelist, &
                                  refuse_unknown_keys
    use lagrangia_reference, only: reference_t
    use lagrangia_shipped_files, only: read_file_or_shipped
    use lagrangia_system, only: system_t
    use lagrangia_text, only: lower
    use lagrangia_vectors, only: farthest
    implicit none (type, external)
    private
    public :: bench_problem_t, problem_names, read_problem, read_problems

    character(*), parameter :: path = "data/reference/bench.nml"
    character(name_length), parameter :: problem_names(*) = [character(name_length) :: &
        "oscillator", "P1", "P1a", "P2", "P3", "P4"]
    character(10), parameter :: keys(*) = [character(10) :: "title", "system", "parameters", &
        "q", "v", "duration", "q_end", "v_end"]
    integer, parameter :: most = 100  !! values of one key

    type :: bench_problem_t
        !! A motion from `t = 0` over `duration`, and where it ends, to 32 digits in the file.
        character(name_length) :: name = ""
        character(80) :: title = ""
        class(system_t), allocatable :: system
        class(reference_t), allocatable :: closed_form  !! absent: none is known
        real(dp) :: duration = 0.0_dp                   !! s
        real(dp), allocatable :: q(:), v(:)
        real(dp), allocatable :: q_end(:), v_end(:)
    contains
        procedure :: error_of
    end type bench_problem_t

contains

    subroutine read_problems(names, problems, error)
        !! The problems called `names`.
        character(*), intent(in) :: names(:)  !! of `problem_names`
        type(bench_problem_t), allocatable, intent(out) :: problems(:)  !! in the order of the names
        type(error_t), allocatable, intent(out) :: error  !! allocated where it fails
        integer :: i

        allocate (problems(size(names)))
        do i = 1, size(names)
            call read_problem(trim(names(i)), problems(i), error)
            if (allocated(error)) return
        end do
    end subroutine read_problems

    subroutine read_problem(name, problem, error)
        !! One problem from the file.
        character(*), intent(in) :: name  !! of `problem_names`
        type(bench_problem_t), intent(out) :: problem  !! with its system
        type(error_t), allocatable, intent(out) :: error  !! allocated where it fails
        type(namelist_t) :: tree
        character(:), allocatable :: text, group
        character(name_length) :: system
        real(dp), allocatable :: parameters(:)

        group = lower(name)
        read_group: block
            call read_file_or_shipped(path, text, error)
            if (allocated(error)) exit read_group
            call parse_namelist(text, path, tree, error)
            if (allocated(error)) exit read_group
            call get_string(tree, group, "system", system, error, required=.true.)
            if (allocated(error)) exit read_group
            call new_system(trim(system), problem%system, error)
            if (allocated(error)) exit read_group
            call get_string(tree, group, "title", problem%title, error, required=.true.)
            if (allocated(error)) exit read_group
            call get_reals(tree, group, "parameters", 1, most, parameters, error, required=.true.)
            if (allocated(error)) exit read_group
            call problem%system%configure(parameters, error)
            if (allocated(error)) exit read_group
            call get_state("q", problem%q)
            if (allocated(error)) exit read_group
            call get_state("v", problem%v)
            if (allocated(error)) exit read_group
            call get_state("q_end", problem%q_end)
            if (allocated(error)) exit read_group
            call get_state("v_end", problem%v_end)
            if (allocated(error)) exit read_group
            call get_real(tree, group, "duration", problem%duration, error, required=.true.)
            if (allocated(error)) exit read_group
            call refuse_unknown_keys(tree, group, keys, error)
        end block read_group
        if (allocated(error)) return
        problem%name = name
        call problem%system%closed_form(0.0_dp, problem%q, problem%v, problem%closed_form)
        if (allocated(problem%closed_form)) then
            if (.not. problem%closed_form%has_state) deallocate (problem%closed_form)
        end if
    contains
        subroutine get_state(key, values)
            character(*), intent(in) :: key
            real(dp), allocatable, intent(inout) :: values(:)

            associate (n => problem%system%ndof)
                call get_reals(tree, group, key, n, n, values, error, required=.true.)
            end associate
        end subroutine get_state
    end subroutine read_problem

    pure function error_of(self, q, v) result(error)
        !! The largest distance of any coordinate or velocity from the truth at the end.
        class(bench_problem_t), intent(in) :: self
        real(dp), intent(in) :: q(:), v(:)  !! the state at the end
        real(dp) :: error

        error = max(farthest(q, self%q_end), farthest(v, self%v_end))
        if (any(.not. (abs([q, v]) <= huge(error)))) error = huge(error)
    end function error_of
end module lagrangia_bench_problems
