module lagrangia_contestants
    !! Everybody who takes part: all methods of the catalogue, GSL's, and the closed forms. What is
    !! listed in the catalogue tomorrow is measured tomorrow.
    !!
    !! Our own methods take part by a fixed step, by a tolerance, and by a closed form.
    use lagrangia_bench_problems, only: bench_problem_t
    use lagrangia_contestant, only: contestant_box_t, contestant_t, set_by_nothing, set_by_step, &
                                    set_by_tolerance, source_closed_form
    use lagrangia_description, only: name_length
    use lagrangia_errors, only: error_t, fail, status_numbers
    use lagrangia_gsl_contestants, only: gsl_contestant_t, new_gsl_contestant
    use lagrangia_gsl_odeiv, only: gsl_methods
    use lagrangia_integrator, only: dense_integrator_t, integrator_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_methods, only: nth_adaptive, nth_integrator
    use lagrangia_number_class, only: all_finite
    use lagrangia_reduced_motion, only: leave_cyclic, reduced_motion_t
    implicit none (type, external)
    private
    public :: contestant_names, new_contestants

    type, extends(contestant_t) :: fixed_contestant_t
        !! Equal steps, all in one block: `advance` and nothing else.
        class(integrator_t), allocatable :: plain   !! the method
        class(integrator_t), allocatable :: method  !! and what a scene would make of it
        integer(i8) :: steps = 0
    contains
        procedure :: prepare => prepare_fixed
        procedure :: solve => solve_fixed
    end type fixed_contestant_t

    type, extends(contestant_t) :: adaptive_contestant_t
        !! Steps of the method's own choice; samples between them by its dense output.
        class(dense_integrator_t), allocatable :: plain  !! the method
        class(integrator_t), allocatable :: method       !! and what a scene would make of it
    contains
        procedure :: prepare => prepare_adaptive
        procedure :: solve => solve_adaptive
    end type adaptive_contestant_t

    type, extends(contestant_t) :: formula_contestant_t
        !! No steps: the problem's closed form, which is ready before the time is taken.
    contains
        procedure :: prepare => prepare_formula
        procedure :: solve => solve_formula
    end type formula_contestant_t

contains

    subroutine new_contestants(chosen, boxes)
        !! Those whose names are in `chosen`; all if that is empty. A method that can do both comes
        !! twice, at a fixed step and by its tolerance.
        character(*), intent(in) :: chosen(:)  !! names of methods
        type(contestant_box_t), allocatable, intent(out) :: boxes(:)  !! not prepared yet
        class(integrator_t), allocatable :: method
        class(dense_integrator_t), allocatable :: adaptive
        type(contestant_box_t), allocatable :: room(:)
        integer :: i, n

        allocate (room(100))
        n = 0
        i = 0
        do
            i = i + 1
            call nth_integrator(i, method)
            if (.not. allocated(method)) exit
            if (wanted(method%name)) call add_fixed()
        end do
        i = 0
        do
            i = i + 1
            call nth_adaptive(i, adaptive)
            if (.not. allocated(adaptive)) exit
            if (wanted(adaptive%name)) call add_adaptive()
        end do
        do i = 1, size(gsl_methods)
            call add_gsl(trim(gsl_methods(i)))
        end do
        call add_formula()
        allocate (boxes(n))
        do i = 1, n
            call move_alloc(room(i)%item, boxes(i)%item)
        end do
    contains
        function wanted(name)
            character(*), intent(in) :: name
            logical :: wanted

            wanted = size(chosen) == 0 .or. any(chosen == name)
        end function wanted

        subroutine add_fixed()
            type(fixed_contestant_t) :: contestant

            call new_fixed_contestant(contestant, method)
            n = n + 1
            allocate (room(n)%item, source=contestant)
        end subroutine add_fixed

        subroutine add_adaptive()
            type(adaptive_contestant_t) :: contestant

            call new_adaptive_contestant(contestant, adaptive)
            n = n + 1
            allocate (room(n)%item, source=contestant)
        end subroutine add_adaptive

        subroutine add_gsl(name)
            character(*), intent(in) :: name
            type(gsl_contestant_t) :: contestant

            if (.not. wanted("gsl_"//name)) return
            call new_gsl_contestant(contestant, name)
            n = n + 1
            allocate (room(n)%item, source=contestant)
        end subroutine add_gsl

        subroutine add_formula()
            type(formula_contestant_t) :: contestant

            if (.not. wanted("closed_form")) return
            call new_formula_contestant(contestant)
            n = n + 1
            allocate (room(n)%item, source=contestant)
        end subroutine add_formula
    end subroutine new_contestants

    function contestant_names() result(names)
        !! All names that may be chosen, each once.
        character(name_length), allocatable :: names(:)
        type(contestant_box_t), allocatable :: boxes(:)
        character(name_length) :: found(100)
        integer :: i, n

        call new_contestants([character(name_length) ::], boxes)
        n = 0
        do i = 1, size(boxes)
            if (any(found(:n) == boxes(i)%item%name)) cycle
            n = n + 1
            found(n) = boxes(i)%item%name
        end do
        allocate (names, source=found(:n))
    end function contestant_names

    subroutine new_fixed_contestant(self, method)
        !! `method` at a fixed step.
        type(fixed_contestant_t), intent(out) :: self
        class(integrator_t), intent(in) :: method

        allocate (self%plain, source=method)
        self%name = method%name
        self%set_by = set_by_step
        self%order = method%order
    end subroutine new_fixed_contestant

    subroutine prepare_fixed(self, problem, setting, error)
        !! The step is shortened so that whole steps end at the end.
        class(fixed_contestant_t), intent(inout) :: self
        type(bench_problem_t), target, intent(in) :: problem
        real(dp), intent(in) :: setting
        type(error_t), allocatable, intent(out) :: error

        self%steps = ceiling(problem%duration/setting*(1.0_dp - epsilon(setting)), i8)
        call prepare_method(self%plain, problem, self%method, self%coordinates, error)
    end subroutine prepare_fixed

    subroutine solve_fixed(self, problem, q, v, error)
        !! See `contestant_t`.
        class(fixed_contestant_t), intent(inout) :: self
        type(bench_problem_t), intent(in) :: problem
        real(dp), intent(out) :: q(:), v(:)
        type(error_t), allocatable, intent(out) :: error

        q = problem%q
        v = problem%v
        call self%method%start(problem%system, 0.0_dp, q, v)
        call self%method%advance(problem%system, 0.0_dp, problem%duration/self%steps, 0_i8, &
                                 self%steps, q, v)
        self%evaluations = self%method%evaluations
        if (.not. all_finite(q)) call fail(error, "the state is not finite", &
                                                    status_numbers)
    end subroutine solve_fixed

    subroutine new_adaptive_contestant(self, method)
        !! `method` by its tolerance.
        type(adaptive_contestant_t), intent(out) :: self
        class(dense_integrator_t), intent(in) :: method

        allocate (self%plain, source=method)
        self%name = method%name
        self%set_by = set_by_tolerance
        self%order = method%order
    end subroutine new_adaptive_contestant

    subroutine prepare_adaptive(self, problem, setting, error)
        !! See `contestant_t`.
        class(adaptive_contestant_t), intent(inout) :: self
        type(bench_problem_t), target, intent(in) :: problem
        real(dp), intent(in) :: setting
        type(error_t), allocatable, intent(out) :: error

        self%plain%tolerance = setting
        self%plain%dense = self%samples > 0
        call prepare_method(self%plain, problem, self%method, self%coordinates, error)
    end subroutine prepare_adaptive

    subroutine solve_adaptive(self, problem, q, v, error)
        !! The choice of the first step is part of it.
        class(adaptive_contestant_t), intent(inout) :: self
        type(bench_problem_t), intent(in) :: problem
        real(dp), intent(out) :: q(:), v(:)
        type(error_t), allocatable, intent(out) :: error
        real(dp) :: t
        integer :: k

        q = problem%q
        v = problem%v
        k = 1
        select type (method => self%method)
        class is (dense_integrator_t)
            call method%start(problem%system, 0.0_dp, q, v, problem%duration)
            do while (method%t_new < problem%duration)
                call method%step(problem%system, error)
                if (allocated(error)) return
                do while (k <= self%samples)
                    t = problem%duration*k/(self%samples + 1)
                    if (t > method%t_new) exit
                    call method%state_at(t, q, v)
                    k = k + 1
                end do
            end do
            call method%state_at(method%t_new, q, v)
        end select
        self%evaluations = self%method%evaluations
    end subroutine solve_adaptive

    subroutine prepare_method(plain, problem, method, coordinates, error)
        !! What a scene would make of a method, ready for the problem.
        class(integrator_t), intent(in) :: plain
        type(bench_problem_t), intent(in) :: problem
        class(integrator_t), allocatable, intent(out) :: method
        integer, intent(out) :: coordinates  !! that it integrates
        type(error_t), allocatable, intent(out) :: error

        allocate (method, source=plain)
        call leave_cyclic(method, problem%system)
        coordinates = problem%system%ndof
        select type (method)
        class is (reduced_motion_t)
            coordinates = coordinates - 1
        end select
        call method%prepare(problem%system, error)
    end subroutine prepare_method

    subroutine new_formula_contestant(self)
        !! The closed form of whatever problem has one.
        type(formula_contestant_t), intent(out) :: self

        self%name = "closed_form"
        self%source = source_closed_form
        self%set_by = set_by_nothing
    end subroutine new_formula_contestant

    subroutine prepare_formula(self, problem, setting, error)
        !! Refuses problems without one.
        class(formula_contestant_t), intent(inout) :: self
        type(bench_problem_t), target, intent(in) :: problem
        real(dp), intent(in) :: setting
        type(error_t), allocatable, intent(out) :: error

        if (.not. allocated(problem%closed_form)) call fail(error, "no closed form is known")
    end subroutine prepare_formula

    subroutine solve_formula(self, problem, q, v, error)
        !! See `contestant_t`.
        class(formula_contestant_t), intent(inout) :: self
        type(bench_problem_t), intent(in) :: problem
        real(dp), intent(out) :: q(:), v(:)
        type(error_t), allocatable, intent(out) :: error

        call problem%closed_form%state_at(problem%duration, q, v)
    end subroutine solve_formula
end module lagrangia_contestants
