module lagrangia_gsl_odeiv
    !! GSL's integrators of ordinary differential equations, to compare ours with.
    !!
    !! The caller supplies the right-hand side as GSL wants it, a C function; here it is driven.
    !! The error handler is off and every status is checked.
    !! Source: GSL reference manual 2.7, ordinary differential equations.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_f_pointer, c_funloc, &
        c_funptr, c_int, c_loc, c_null_funptr, c_null_ptr, c_ptr, c_size_t
    use lagrangia_errors, only: error_t, fail, status_library, status_numbers
    use lagrangia_gsl, only: gsl_reason, silence_gsl
    use lagrangia_kinds, only: dp, i8, this_part_needs_real64
    implicit none (type, external)
    private
    public :: gsl_driver_t, gsl_methods, gsl_success

    integer(c_int), parameter :: gsl_success = 0  !! what a right-hand side returns

    character(5), parameter :: gsl_methods(4) = ["rk4  ", "rkck ", "rk8pd", "bsimp"]

    type, bind(c) :: gsl_system_t
        !! `gsl_odeiv2_system`.
        type(c_funptr) :: rates = c_null_funptr
        type(c_funptr) :: jacobian = c_null_funptr
        integer(c_size_t) :: dimension = 0
        type(c_ptr) :: context = c_null_ptr
    end type gsl_system_t

    type :: gsl_driver_t
        !! One method ready to integrate one system. GSL keeps the address of `system`: it is
        !! allocated, so that it stays when this object is moved.
        private
        type(c_ptr) :: driver = c_null_ptr
        type(c_ptr) :: step = c_null_ptr  !! the same method without the driver
        type(gsl_system_t), pointer :: system => null()
    contains
        procedure :: start
        procedure :: restart
        procedure :: fixed_steps
        procedure :: integrate
        procedure :: free
    end type gsl_driver_t

    ! allow(assumed-size): C takes the address of the first element
    interface
        subroutine step_rk4() bind(c, name="gsl_odeiv2_step_rk4")
            !! Not to be called, nor are the next three: GSL's variable that names the method, as
            !! `brent` in `lagrangia_gsl`.
            implicit none (type, external)
        end subroutine step_rk4

        subroutine step_rkck() bind(c, name="gsl_odeiv2_step_rkck")
            implicit none (type, external)
        end subroutine step_rkck

        subroutine step_rk8pd() bind(c, name="gsl_odeiv2_step_rk8pd")
            implicit none (type, external)
        end subroutine step_rk8pd

        subroutine step_bsimp() bind(c, name="gsl_odeiv2_step_bsimp")
            implicit none (type, external)
        end subroutine step_bsimp

        function gsl_odeiv2_driver_alloc_y_new(system, method, first_step, absolute, relative) &
            bind(c) result(driver)
            import :: c_double, c_ptr
            implicit none (type, external)
            type(c_ptr), value :: system, method
            real(c_double), value :: first_step, absolute, relative
            type(c_ptr) :: driver
        end function gsl_odeiv2_driver_alloc_y_new

        function gsl_odeiv2_driver_apply(driver, t, t_end, y) bind(c) result(status)
            import :: c_double, c_int, c_ptr
            implicit none (type, external)
            type(c_ptr), value :: driver
            real(c_double), intent(inout) :: t
            real(c_double), value :: t_end
            real(c_double), intent(inout) :: y(*)
            integer(c_int) :: status
        end function gsl_odeiv2_driver_apply

        function gsl_odeiv2_step_alloc(method, dimension) bind(c) result(step)
            import :: c_ptr, c_size_t
            implicit none (type, external)
            type(c_ptr), value :: method
            integer(c_size_t), value :: dimension
            type(c_ptr) :: step
        end function gsl_odeiv2_step_alloc

        function gsl_odeiv2_step_apply(step, t, h, y, y_error, rates_before, rates_after, system) &
            bind(c) result(status)
            import :: c_double, c_int, c_ptr
            implicit none (type, external)
            type(c_ptr), value :: step
            real(c_double), value :: t, h
            real(c_double), intent(inout) :: y(*), y_error(*)
            type(c_ptr), value :: rates_before, rates_after  !! null: not known, not wanted
            type(c_ptr), value :: system
            integer(c_int) :: status
        end function gsl_odeiv2_step_apply

        subroutine gsl_odeiv2_step_free(step) bind(c)
            import :: c_ptr
            implicit none (type, external)
            type(c_ptr), value :: step
        end subroutine gsl_odeiv2_step_free

        function gsl_odeiv2_driver_reset_hstart(driver, first_step) bind(c) result(status)
            import :: c_double, c_int, c_ptr
            implicit none (type, external)
            type(c_ptr), value :: driver
            real(c_double), value :: first_step
            integer(c_int) :: status
        end function gsl_odeiv2_driver_reset_hstart

        subroutine gsl_odeiv2_driver_free(driver) bind(c)
            import :: c_ptr
            implicit none (type, external)
            type(c_ptr), value :: driver
        end subroutine gsl_odeiv2_driver_free
    end interface

contains

    subroutine start(self, method, n, rates, jacobian, context, first_step, tolerance, error)
        !! Get `method` (of `gsl_methods`) ready for \(\dot y = f(t, y)\) with `n` unknowns. The
        !! local error is held to `tolerance`, absolute and relative.
        class(gsl_driver_t), intent(inout) :: self
        character(*), intent(in) :: method  !! GSL's name of it
        integer, intent(in) :: n  !! number of equations
        type(c_funptr), intent(in) :: rates     !! `int f(double t, double *y, double *f, void *)`
        type(c_funptr), intent(in) :: jacobian  !! of `f`, by rows; `bsimp` alone calls it
        type(c_ptr), intent(in) :: context      !! what both get as their last argument
        real(dp), intent(in) :: first_step, tolerance  !! s, positive; of the local error
        type(error_t), allocatable, intent(out) :: error
        !! status 2: no such method; 3: step; 4: GSL
        type(c_funptr) :: address
        type(c_ptr), pointer :: stepper

        call self%free()
        select case (method)
        case ("rk4"); address = c_funloc(step_rk4)
        case ("rkck"); address = c_funloc(step_rkck)
        case ("rk8pd"); address = c_funloc(step_rk8pd)
        case ("bsimp"); address = c_funloc(step_bsimp)
        case default
            call fail(error, "odeiv2: GSL has no method '"//method//"' that is known here")
            return
        end select
        if (.not. (first_step > 0.0_dp .and. ieee_is_finite(first_step))) then
            call fail(error, "odeiv2: the first step must be positive and finite", status_numbers)
            return
        end if
        call silence_gsl()
        call c_f_pointer(transfer(address, c_null_ptr), stepper)
        allocate (self%system)
        self%system = gsl_system_t(rates, jacobian, int(n, c_size_t), context)
        self%driver = gsl_odeiv2_driver_alloc_y_new(c_loc(self%system), stepper, first_step, &
                                                    tolerance, tolerance)
        self%step = gsl_odeiv2_step_alloc(stepper, int(n, c_size_t))
        if (c_associated(self%driver) .and. c_associated(self%step)) return
        call fail(error, "odeiv2: GSL made no driver for '"//method//"'", status_library)
        call self%free()
    end subroutine start

    subroutine restart(self, first_step, error)
        !! Forget the past: the next call starts anywhere, with a step of this length at first.
        class(gsl_driver_t), intent(inout) :: self
        real(dp), intent(in) :: first_step                !! s
        type(error_t), allocatable, intent(out) :: error  !! status 4: GSL refuses

        call judge(gsl_odeiv2_driver_reset_hstart(self%driver, first_step), error)
    end subroutine restart

    subroutine fixed_steps(self, t, h, steps, y, error)
        !! `steps` steps of length `h` each; `t` and `y` move, unless GSL fails. Without the driver,
        !! which costs as much as the steps; what a step knows of its end the next one gets.
        class(gsl_driver_t), intent(inout) :: self
        real(dp), intent(inout) :: t, y(:)                !! s, becomes the end; state, (n)
        real(dp), intent(in) :: h                         !! s
        integer(i8), intent(in) :: steps                  !! how many
        type(error_t), allocatable, intent(out) :: error  !! status 4: GSL's reason
        real(dp) :: y_new(size(y)), y_error(size(y))
        real(dp), target :: rates(size(y))
        type(c_ptr) :: known
        integer(c_int) :: status
        integer(i8) :: i

        y_new = y
        known = c_null_ptr
        do i = 1, steps
            status = gsl_odeiv2_step_apply(self%step, t + (i - 1)*h, h, y_new, y_error, known, &
                                           c_loc(rates), c_loc(self%system))
            if (status /= gsl_success) exit
            known = c_loc(rates)
        end do
        if (steps > 0) call judge(status, error)
        if (allocated(error)) return
        t = t + steps*h
        y = y_new
    end subroutine fixed_steps

    subroutine integrate(self, t, t_end, y, error)
        !! Go to `t_end` with steps of GSL's choice; where that fails `t` and `y` stay.
        class(gsl_driver_t), intent(inout) :: self
        real(dp), intent(inout) :: t, y(:)                !! s, becomes `t_end`; state, (n)
        real(dp), intent(in) :: t_end                     !! s
        type(error_t), allocatable, intent(out) :: error  !! status 4: GSL's reason
        real(dp) :: t_new, y_new(size(y))

        t_new = t
        y_new = y
        call judge(gsl_odeiv2_driver_apply(self%driver, t_new, t_end, y_new), error)
        if (allocated(error)) return
        t = t_new
        y = y_new
    end subroutine integrate

    subroutine judge(status, error)
        !! GSL's words where it did not succeed.
        integer(c_int), intent(in) :: status
        type(error_t), allocatable, intent(out) :: error

        if (status /= gsl_success) call fail(error, "odeiv2: GSL says: "//gsl_reason(status), &
                                             status_library)
    end subroutine judge

    subroutine free(self)
        !! Give GSL its memory back; does nothing if there is none.
        class(gsl_driver_t), intent(inout) :: self

        if (c_associated(self%driver)) call gsl_odeiv2_driver_free(self%driver)
        if (c_associated(self%step)) call gsl_odeiv2_step_free(self%step)
        self%driver = c_null_ptr
        self%step = c_null_ptr
        if (associated(self%system)) deallocate (self%system)
    end subroutine free
end module lagrangia_gsl_odeiv
