module lagrangia_gsl_contestants
    !! GSL's methods in the benchmark, as its manual drives them.
    use, intrinsic :: iso_c_binding, only: c_funloc, c_loc
    use lagrangia_bench_problems, only: bench_problem_t
    use lagrangia_contestant, only: contestant_t, set_by_step, set_by_tolerance, source_gsl
    use lagrangia_errors, only: error_t
    use lagrangia_gsl_mechanics, only: gsl_context_t, gsl_jacobian, gsl_rates
    use lagrangia_gsl_odeiv, only: gsl_driver_t
    use lagrangia_kinds, only: dp, i8
    implicit none (type, external)
    private
    public :: gsl_contestant_t, new_gsl_contestant

    real(dp), parameter :: first_step = 1e-3_dp  !! s; GSL makes it longer as it likes
    real(dp), parameter :: any_error = 1e300_dp  !! at fixed steps GSL's estimate must not object

    type, extends(contestant_t) :: gsl_contestant_t
        private
        character(8) :: method = ""
        type(gsl_driver_t) :: driver
        type(gsl_context_t), pointer :: context => null()  !! GSL keeps its address
        integer(i8) :: steps = 0
        real(dp), allocatable :: y(:)
    contains
        procedure :: prepare
        procedure :: solve
        final :: release
    end type gsl_contestant_t

contains

    subroutine new_gsl_contestant(self, method)
        !! `rk4` at a fixed step; `rkck`, `rk8pd`, `bsimp` by their tolerance.
        type(gsl_contestant_t), intent(out) :: self
        character(*), intent(in) :: method

        self%name = "gsl_"//method
        self%method = method
        self%source = source_gsl
        self%set_by = merge(set_by_step, set_by_tolerance, method == "rk4")
        self%order = 4
    end subroutine new_gsl_contestant

    subroutine prepare(self, problem, setting, error)
        !! See `contestant_t`.
        class(gsl_contestant_t), intent(inout) :: self
        type(bench_problem_t), target, intent(in) :: problem
        real(dp), intent(in) :: setting
        type(error_t), allocatable, intent(out) :: error
        real(dp) :: tolerance

        tolerance = setting
        if (self%set_by == set_by_step) then
            tolerance = any_error
            self%steps = ceiling(problem%duration/setting*(1.0_dp - epsilon(setting)), i8)
        end if
        if (.not. associated(self%context)) allocate (self%context)
        self%context%system => problem%system
        self%context%evaluations = 0
        if (allocated(self%context%work)) deallocate (self%context%work)
        if (allocated(self%y)) deallocate (self%y)
        allocate (self%y(2*problem%system%ndof))
        call self%driver%start(trim(self%method), size(self%y), c_funloc(gsl_rates), &
                               c_funloc(gsl_jacobian), c_loc(self%context), first_step, &
                               tolerance, error)
    end subroutine prepare

    subroutine solve(self, problem, q, v, error)
        !! See `contestant_t`.
        class(gsl_contestant_t), intent(inout) :: self
        type(bench_problem_t), intent(in) :: problem
        real(dp), intent(out) :: q(:), v(:)
        type(error_t), allocatable, intent(out) :: error
        real(dp) :: t
        integer :: n

        n = size(q)
        self%y(:n) = problem%q
        self%y(n + 1:) = problem%v
        t = 0.0_dp
        call self%driver%restart(first_step, error)
        if (allocated(error)) return
        if (self%set_by == set_by_step) then
            call self%driver%fixed_steps(t, problem%duration/self%steps, self%steps, self%y, error)
        else
            call self%driver%integrate(t, problem%duration, self%y, error)
        end if
        self%evaluations = self%context%evaluations
        q = self%y(:n)
        v = self%y(n + 1:)
    end subroutine solve

    impure elemental subroutine release(self)
        !! What GSL and the context hold.
        type(gsl_contestant_t), intent(inout) :: self

        call self%driver%free()
        if (associated(self%context)) deallocate (self%context)
    end subroutine release
end module lagrangia_gsl_contestants
