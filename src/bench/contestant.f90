module lagrangia_contestant
    !! The contract of whoever takes part in the benchmark: one motion from its start to its end.
    use lagrangia_bench_problems, only: bench_problem_t
    use lagrangia_description, only: name_length
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp, i8
    implicit none (type, external)
    private
    public :: contestant_t, contestant_box_t, set_by_names
    public :: set_by_nothing, set_by_step, set_by_tolerance
    public :: source_closed_form, source_gsl, source_ours

    integer, parameter :: set_by_nothing = 1, set_by_step = 2, set_by_tolerance = 3
    character(9), parameter :: set_by_names(3) = ["-        ", "dt       ", "tolerance"]
    integer, parameter :: source_ours = 1, source_gsl = 2, source_closed_form = 3

    type, abstract :: contestant_t
        character(name_length) :: name = ""
        integer :: source = source_ours    !! who wrote it
        integer :: set_by = set_by_step    !! what sets its accuracy
        integer :: order = 1             !! of the error in the step
        integer :: samples = 0           !! states between start and end that are asked for, at
        !! equal intervals; only who is set by a tolerance gives them
        integer :: coordinates = 0       !! that are integrated, since `prepare`; fewer than the
        !! problem has where a cyclic one is left out, 0 of a closed form
        integer(i8) :: evaluations = 0   !! of accelerations, since `prepare`
    contains
        procedure(prepare_i), deferred :: prepare
        procedure(solve_i), deferred :: solve
    end type contestant_t

    type :: contestant_box_t
        !! A place for one of any kind.
        class(contestant_t), allocatable :: item
    end type contestant_box_t

    abstract interface
        subroutine prepare_i(self, problem, setting, error)
            !! Refuse the problem, or get ready to solve it any number of times: not timed.
            import :: contestant_t, bench_problem_t, dp, error_t
            implicit none (type, external)
            class(contestant_t), intent(inout) :: self
            type(bench_problem_t), target, intent(in) :: problem  !! stays where it is
            real(dp), intent(in) :: setting                       !! of what it is set by
            type(error_t), allocatable, intent(out) :: error  !! allocated where it fails
        end subroutine prepare_i

        subroutine solve_i(self, problem, q, v, error)
            !! The state at the end: this is timed.
            import :: contestant_t, bench_problem_t, dp, error_t
            implicit none (type, external)
            class(contestant_t), intent(inout) :: self
            type(bench_problem_t), intent(in) :: problem  !! the one that `prepare` had
            real(dp), intent(out) :: q(:), v(:)  !! the state at the end
            type(error_t), allocatable, intent(out) :: error  !! allocated where it fails
        end subroutine solve_i
    end interface
end module lagrangia_contestant
