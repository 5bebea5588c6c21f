module lagrangia_gsl_contestants
    !! GSL's methods in the benchmark, as its manual drives them.
    !!
    !! GSL wants a mechanical system as \(y = (q, v)\), \(\dot y = (v, a)\), in C functions: those
    !! of `direct_rates` where there is one, without damping; else, and for `bsimp`, the system
    !! itself behind one.
    use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_f_pointer, c_funloc, &
                                           c_funptr, c_int, c_loc, c_ptr
    use lagrangia_bench_problems, only: bench_problem_t
    use lagrangia_contestant, only: contestant_t, set_by_step, set_by_tolerance, source_gsl
    use lagrangia_description, only: default_values, description_t
    use lagrangia_direct_rates, only: direct_context_t, direct_rates
    use lagrangia_errors, only: error_t
    use lagrangia_gsl_odeiv, only: gsl_driver_t, gsl_success
    use lagrangia_kinds, only: dp, i8
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: gsl_contestant_t, new_gsl_contestant
    public :: gsl_context_t, gsl_jacobian, gsl_rates

    real(dp), parameter :: first_step = 1e-3_dp  !! s; GSL makes it longer as it likes

    type, extends(contestant_t) :: gsl_contestant_t
        private
        character(8) :: method = ""
        type(gsl_driver_t) :: driver
        type(gsl_context_t), pointer :: context => null()   !! GSL keeps its address,
        type(direct_context_t), pointer :: direct => null() !! or that of this one
        integer(i8) :: steps = 0
        real(dp), allocatable :: y(:)
    contains
        procedure :: prepare
        procedure :: solve
        final :: release
    end type gsl_contestant_t

    type :: gsl_context_t
        !! What GSL hands back to the functions below.
        class(system_t), pointer :: system => null()
        integer(i8) :: evaluations = 0  !! of accelerations
        real(dp), allocatable :: work(:, :)  !! (2*ndof, 4), of the Jacobian
    end type gsl_context_t

    ! allow(assumed-size): C gives the address of the first element

contains

    subroutine new_gsl_contestant(self, method)
        !! `rk4` at a fixed step; `rkck`, `rk8pd`, `bsimp` by their tolerance.
        type(gsl_contestant_t), intent(out) :: self  !! not prepared yet
        character(*), intent(in) :: method  !! GSL's name of it

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
        type(description_t) :: d
        real(dp), allocatable :: parameters(:)
        type(c_funptr) :: rates
        type(c_ptr) :: context
        real(dp) :: tolerance

        tolerance = setting
        if (self%set_by == set_by_step) then
            tolerance = 1.0_dp
            self%steps = ceiling(problem%duration/setting*(1.0_dp - epsilon(setting)), i8)
        end if
        call release(self)
        allocate (self%context, self%direct)
        self%context%system => problem%system
        call problem%system%describe(d)
        rates = direct_rates(trim(d%name))
        context = c_loc(self%direct)
        parameters = default_values(d)
        if (self%method == "bsimp" .or. .not. c_associated(rates) .or. &
            problem%system%nonconservative) then
            rates = c_funloc(gsl_rates)
            context = c_loc(self%context)
        else
            self%direct%parameters(:size(parameters)) = parameters
        end if
        if (allocated(self%y)) deallocate (self%y)
        allocate (self%y(2*problem%system%ndof))
        self%coordinates = problem%system%ndof
        call self%driver%start(trim(self%method), size(self%y), rates, c_funloc(gsl_jacobian), &
                               context, first_step, tolerance, error)
    end subroutine prepare

    subroutine solve(self, problem, q, v, error)
        !! See `contestant_t`.
        class(gsl_contestant_t), intent(inout) :: self
        type(bench_problem_t), intent(in) :: problem
        real(dp), intent(out) :: q(:), v(:)
        type(error_t), allocatable, intent(out) :: error
        real(dp) :: t
        integer :: k, n

        n = size(q)
        self%y(:n) = problem%q
        self%y(n + 1:) = problem%v
        t = 0.0_dp
        call self%driver%restart(first_step, error)
        if (allocated(error)) return
        if (self%set_by == set_by_step) then
            call self%driver%fixed_steps(t, problem%duration/self%steps, self%steps, self%y, error)
        else
            do k = 1, self%samples + 1
                call self%driver%integrate(t, problem%duration*k/(self%samples + 1), self%y, error)
                if (allocated(error)) exit
            end do
        end if
        self%evaluations = self%context%evaluations + self%direct%evaluations
        q = self%y(:n)
        v = self%y(n + 1:)
    end subroutine solve

    impure elemental subroutine release(self)
        !! What GSL and the context hold.
        type(gsl_contestant_t), intent(inout) :: self

        call self%driver%free()
        if (associated(self%context)) deallocate (self%context)
        if (associated(self%direct)) deallocate (self%direct)
    end subroutine release

    function gsl_rates(t, y, rates, context) bind(c) result(status)
        !! The right-hand side.
        real(c_double), value :: t  !! s
        real(c_double), intent(in) :: y(*)  !! \(y = (q, v)\), (2*ndof)
        real(c_double), intent(inout) :: rates(*)  !! \(\dot y\), (2*ndof)
        type(c_ptr), value :: context  !! a `gsl_context_t`
        integer(c_int) :: status
        type(gsl_context_t), pointer :: self
        integer :: n

        call c_f_pointer(context, self)
        n = self%system%ndof
        rates(1:n) = y(n + 1:2*n)
        call self%system%accelerations(t, y(1), y(n + 1), rates(n + 1))
        self%evaluations = self%evaluations + 1
        status = gsl_success
    end function gsl_rates

    function gsl_jacobian(t, y, jacobian, time_rates, context) bind(c) result(status)
        !! The matrix of the right-hand side by rows, and its derivative by the time, by central
        !! differences: two evaluations for every unknown that the accelerations depend on. Their
        !! error, some \(10^{-10}\), slows `bsimp` but spoils no result. Derivatives by hand, as
        !! few users would write them, would be cheaper: so `bsimp` is measured as it would be used.
        real(c_double), value :: t  !! s
        real(c_double), intent(in) :: y(*)  !! \(y = (q, v)\), (2*ndof)
        real(c_double), intent(inout) :: jacobian(*), time_rates(*)
        !! by rows, (2*ndof, 2*ndof); (2*ndof)
        type(c_ptr), value :: context  !! a `gsl_context_t`
        integer(c_int) :: status
        type(gsl_context_t), pointer :: self
        integer :: i, k, n

        call c_f_pointer(context, self)
        n = self%system%ndof
        if (.not. allocated(self%work)) allocate (self%work(2*n, 4))
        jacobian(1:4*n**2) = 0.0_dp
        time_rates(1:2*n) = 0.0_dp
        do i = 1, n
            jacobian(2*n*(i - 1) + n + i) = 1.0_dp
        end do
        do k = 1, merge(2*n, n, self%system%velocity_forces)
            call add_column(self, n, k, t, y, self%work, jacobian)
        end do
        if (self%system%time_dependent) call add_time(self, n, t, y, self%work, time_rates)
        status = gsl_success
    end function gsl_jacobian

    subroutine add_column(self, n, k, t, y, work, jacobian)
        !! How the accelerations change with unknown `k`.
        type(gsl_context_t), intent(inout) :: self
        integer, intent(in) :: n, k
        real(dp), intent(in) :: t, y(2*n)
        real(dp), intent(inout) :: work(2*n, 4)
        real(dp), intent(inout) :: jacobian(2*n, 2*n)  !! the transpose, since C has it by rows

        work(:, 1) = y
        work(:, 2) = y
        work(k, 1) = y(k) - width(y(k))
        work(k, 2) = y(k) + width(y(k))
        call self%system%accelerations(t, work(:n, 1), work(n + 1:, 1), work(:n, 3))
        call self%system%accelerations(t, work(:n, 2), work(n + 1:, 2), work(:n, 4))
        jacobian(k, n + 1:) = (work(:n, 4) - work(:n, 3))/(work(k, 2) - work(k, 1))
        self%evaluations = self%evaluations + 2
    end subroutine add_column

    subroutine add_time(self, n, t, y, work, time_rates)
        !! How the accelerations change with the time.
        type(gsl_context_t), intent(inout) :: self
        integer, intent(in) :: n
        real(dp), intent(in) :: t, y(2*n)
        real(dp), intent(inout) :: work(2*n, 4), time_rates(2*n)
        real(dp) :: below, above

        below = t - width(t)
        above = t + width(t)
        call self%system%accelerations(below, y(:n), y(n + 1:), work(:n, 3))
        call self%system%accelerations(above, y(:n), y(n + 1:), work(:n, 4))
        time_rates(n + 1:) = (work(:n, 4) - work(:n, 3))/(above - below)
        self%evaluations = self%evaluations + 2
    end subroutine add_time

    pure function width(x) result(h)
        !! Of a central difference: its error of order \(h^2\) balances rounding.
        real(dp), intent(in) :: x
        real(dp) :: h

        h = epsilon(x)**(1.0_dp/3.0_dp)*max(1.0_dp, abs(x))
    end function width
end module lagrangia_gsl_contestants
