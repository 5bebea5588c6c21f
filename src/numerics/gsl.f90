module lagrangia_gsl
    !! The GNU Scientific Library, touched here and in `lagrangia_gsl_odeiv` only.
    !!
    !! GSL's error handler would abort the program: it is switched off before the first call, and
    !! every status is checked.
    use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_f_pointer, c_funloc, &
        c_funptr, c_int, c_loc, c_ptr
    use lagrangia_errors, only: error_t, fail, status_library, status_numbers
    use lagrangia_files, only: fortran_text
    use lagrangia_kinds, only: dp, this_part_needs_real64
    use lagrangia_number_class, only: all_finite, is_zero
    use lagrangia_roots, only: scalar_function_t
    implicit none (type, external)
    private
    public :: brent_root, gsl_reason, silence_gsl

    type, bind(c) :: gsl_function_t
        !! GSL's own notion of a function: an address, and what to hand it beside `x`.
        type(c_funptr) :: function
        type(c_ptr) :: params
    end type gsl_function_t

    type :: box_t
        !! C knows no polymorphic pointers; it hands on the address of this.
        class(scalar_function_t), pointer :: item => null()
    end type box_t

    interface
        subroutine brent() bind(c, name="gsl_root_fsolver_brent")
            !! Not to be called: GSL's variable that names the method. A Fortran variable of this
            !! name would be a second one, and empty; a procedure's address is the library's.
            implicit none (type, external)
        end subroutine brent

        function gsl_root_fsolver_alloc(method) bind(c) result(solver)
            import :: c_ptr
            implicit none (type, external)
            type(c_ptr), value :: method
            type(c_ptr) :: solver
        end function gsl_root_fsolver_alloc

        subroutine gsl_root_fsolver_free(solver) bind(c)
            import :: c_ptr
            implicit none (type, external)
            type(c_ptr), value :: solver
        end subroutine gsl_root_fsolver_free

        function gsl_root_fsolver_set(solver, f, lower, upper) bind(c) result(status)
            import :: c_double, c_int, c_ptr, gsl_function_t
            implicit none (type, external)
            type(c_ptr), value :: solver
            type(gsl_function_t), intent(in), target :: f
            real(c_double), value :: lower, upper
            integer(c_int) :: status
        end function gsl_root_fsolver_set

        function gsl_root_fsolver_iterate(solver) bind(c) result(status)
            import :: c_int, c_ptr
            implicit none (type, external)
            type(c_ptr), value :: solver
            integer(c_int) :: status
        end function gsl_root_fsolver_iterate

        function gsl_root_fsolver_root(solver) bind(c) result(x)
            import :: c_double, c_ptr
            implicit none (type, external)
            type(c_ptr), value :: solver
            real(c_double) :: x
        end function gsl_root_fsolver_root

        function gsl_root_fsolver_x_lower(solver) bind(c) result(x)
            import :: c_double, c_ptr
            implicit none (type, external)
            type(c_ptr), value :: solver
            real(c_double) :: x
        end function gsl_root_fsolver_x_lower

        function gsl_root_fsolver_x_upper(solver) bind(c) result(x)
            import :: c_double, c_ptr
            implicit none (type, external)
            type(c_ptr), value :: solver
            real(c_double) :: x
        end function gsl_root_fsolver_x_upper

        function gsl_set_error_handler_off() bind(c) result(old_handler)
            import :: c_ptr
            implicit none (type, external)
            type(c_ptr) :: old_handler
        end function gsl_set_error_handler_off

        function gsl_strerror(status) bind(c) result(message)
            import :: c_int, c_ptr
            implicit none (type, external)
            integer(c_int), value :: status
            type(c_ptr) :: message
        end function gsl_strerror
    end interface

    logical :: handler_is_off = .false.
    integer, parameter :: most_iterations = 200

contains

    subroutine brent_root(f, lower, upper, root, error)
        !! Where `f` vanishes between `lower` and `upper`, by Brent's method, as far as the rounding
        !! of `f` allows; fails unless its signs at the two ends differ.
        class(scalar_function_t), target, intent(inout) :: f  !! its `value` is called
        real(dp), intent(in) :: lower, upper                  !! the bracket, lower < upper
        real(dp), intent(out) :: root                         !! zero without a bracket
        type(error_t), allocatable, intent(out) :: error
        !! status 3: no bracket, no convergence; 4: GSL refuses
        type(box_t), target :: box
        type(gsl_function_t), target :: function  ! GSL keeps its address until it is freed
        type(c_ptr) :: solver
        type(c_ptr), pointer :: method
        integer(c_int) :: status
        integer :: i
        real(dp) :: from, to, f_lower, f_upper

        root = 0.0_dp
        f_lower = f%value(lower)
        f_upper = f%value(upper)
        if (.not. (all_finite([lower, upper, f_lower, f_upper]) .and. lower < upper)) then
            call fail(error, "root: two ends, in order, and finite values there are needed", &
                      status_numbers)
            return
        end if
        if (min(f_lower, f_upper) > 0.0_dp .or. max(f_lower, f_upper) < 0.0_dp) then
            call fail(error, "root: the function has one sign at both ends", status_numbers)
            return
        end if
        call silence_gsl()
        call c_f_pointer(transfer(c_funloc(brent), solver), method)
        solver = gsl_root_fsolver_alloc(method)
        if (.not. c_associated(solver)) then
            call fail(error, "root: GSL has no memory", status_library)
            return
        end if
        box%item => f
        function = gsl_function_t(c_funloc(value_for_gsl), c_loc(box))
        status = gsl_root_fsolver_set(solver, function, lower, upper)
        do i = 1, most_iterations
            if (status /= 0) exit
            status = gsl_root_fsolver_iterate(solver)
            root = gsl_root_fsolver_root(solver)
            from = gsl_root_fsolver_x_lower(solver)
            to = gsl_root_fsolver_x_upper(solver)
            if (to - from <= 2.0_dp*epsilon(root)*max(abs(from), abs(to))) exit
            if (is_zero(f%value(root))) exit
        end do
        call gsl_root_fsolver_free(solver)
        if (status /= 0) then
            call fail(error, "root: GSL says: "//gsl_reason(status), status_library)
        else if (i > most_iterations) then
            call fail(error, "root: Brent's method does not converge", status_numbers)
        end if
    end subroutine brent_root

    function value_for_gsl(x, params) bind(c) result(y)
        !! What GSL calls.
        real(c_double), value :: x
        type(c_ptr), value :: params
        real(c_double) :: y
        type(box_t), pointer :: box

        call c_f_pointer(params, box)
        y = box%item%value(x)
    end function value_for_gsl

    subroutine silence_gsl()
        type(c_ptr) :: old_handler

        if (handler_is_off) return
        old_handler = gsl_set_error_handler_off()
        handler_is_off = .true.
    end subroutine silence_gsl

    function gsl_reason(status) result(message)
        !! GSL's own words for a status.
        integer(c_int), intent(in) :: status  !! what a GSL function returned
        character(:), allocatable :: message

        message = fortran_text(gsl_strerror(status))
    end function gsl_reason
end module lagrangia_gsl
