module lagrangia_state_check
    !! What a run needs before its first step: a system with its parameters, a state of its size,
    !! equations of motion there.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use lagrangia_derivative, only: derivative
    use lagrangia_description, only: line_length
    use lagrangia_errors, only: error_t, fail, status_numbers
    use lagrangia_expression, only: expression_t, f_abs, kind_function
    use lagrangia_formula_program, only: formula_program_t, new_formula_program
    use lagrangia_kinds, only: dp
    use lagrangia_lagrange, only: euler_lagrange_t, expand_lagrangian
    use lagrangia_lagrangian_system, only: lagrangian_system_t
    use lagrangia_magnitude, only: magnitude
    use lagrangia_mass_matrix, only: check_mass_matrix, list_of
    use lagrangia_number_class, only: all_finite
    use lagrangia_step_ends, only: end_step
    use lagrangia_system, only: check_state, system_t
    use lagrangia_text, only: to_text
    use lagrangia_written_system, only: written_system_t
    implicit none (type, external)
    private
    public :: blame_mass_matrix, check_start

contains

    pure subroutine check_start(system, t, q, v, error)
        !! Fails (status 2) for a system that was never configured and arrays of another size; and,
        !! where a system has its Lagrangian only, for an L that is no number (status 3) or a mass
        !! matrix that leaves accelerations open (status 4).
        class(system_t), intent(in) :: system  !! whose motion it is
        real(dp), intent(in) :: t, q(:), v(:)  !! s, coordinates, velocities
        type(error_t), allocatable, intent(out) :: error  !! says what is missing, and where

        call check_state(system, q, v, error)
        if (allocated(error)) return
        if (.not. all_finite([t, q, v])) return  ! the run says so
        select type (system)
        class is (lagrangian_system_t)
            call check_lagrangian(system, t, q, v, error)
        end select
        if (allocated(error)) call error%add_context("at t = "//to_text(t)//", q = "// &
            list_of(q)//", v = "//list_of(v))
    end subroutine check_start

    pure subroutine blame_mass_matrix(system, t, h, q, v, error)
        !! Name, in the message of a run that failed in a step from this state on, the mass matrix
        !! of a Lagrangian where it is not positive definite in that step or soon after it, or the
        !! constraints where a free flight from there shows that they end. With accelerations by
        !! hand, or another reason, the message stays.
        class(system_t), intent(in) :: system  !! whose motion it is
        real(dp), intent(in) :: t         !! of the last state that is finite, s
        real(dp), intent(in) :: h         !! length of the step, s
        real(dp), intent(in) :: q(:), v(:)  !! that state
        type(error_t), intent(inout) :: error  !! gets the cause behind its message
        integer, parameter :: places = 16, ahead = 4  !! places a step; steps
        type(error_t), allocatable :: cause
        type(euler_lagrange_t) :: terms
        real(dp) :: s, there(size(q)), v_there(size(q))
        character(line_length) :: reason
        integer :: k

        select type (system)
        class is (lagrangian_system_t)
            if (.not. all_finite([t, h, q, v])) return
            do k = 0, ahead*places
                s = k*h/places
                call expand_lagrangian(system, t + s, q + s*v, v, terms)
                if (.not. all_finite(terms%mass)) cycle
                call check_mass_matrix(terms%mass, cause)
                if (.not. allocated(cause)) cycle
                error%message = error%message//"; at t = "//to_text(t + s)//", q = "// &
                                list_of(q + s*v)//", v = "//list_of(v)//": "//cause%message
                return
            end do
            if (.not. system%is_projected .or. index(error%message, "constraints") > 0) return
            reason = ""
            do k = 1, ahead
                there = q + k*h*v
                v_there = v
                call end_step(system, t, q, v, t + k*h, there, v_there, reason)
                if (reason == "") cycle
                error%message = error%message//"; a flight from t = "//to_text(t)//" to "// &
                                to_text(t + k*h)//" s: "//trim(reason)
                return
            end do
        end select
    end subroutine blame_mass_matrix

    pure subroutine check_lagrangian(system, t, q, v, error)
        !! See `check_start`. Accelerations by hand may be finite where the mass matrix is singular.
        class(lagrangian_system_t), intent(in) :: system
        real(dp), intent(in) :: t, q(:), v(:)
        type(error_t), allocatable, intent(out) :: error
        type(euler_lagrange_t) :: terms
        real(dp) :: a(system%ndof)

        call expand_lagrangian(system, t, q, v, terms)
        if (.not. ieee_is_finite(terms%l)) then
            call fail(error, "the Lagrangian is not a finite number", status_numbers)
        else if (.not. all_finite([terms%dl_dq, terms%dl_dv, terms%force])) then
            call fail(error, "a derivative of the Lagrangian is not finite", status_numbers)
        end if
        if (allocated(error)) return
        call system%accelerations(t, q, v, a)
        if (.not. all_finite(a)) call check_mass_matrix(terms%mass, error)
        if (allocated(error)) return
        select type (system)
        class is (written_system_t)
            call check_kink(system, t, q, v, terms, error)
        end select
    end subroutine check_lagrangian

    pure subroutine check_kink(system, t, q, v, terms, error)
        !! Fails (status 3) where L has a kink: of \(|u|\) the formulas' derivative at \(u = 0\) is
        !! 0, that of hyper-dual numbers is that of one side. Where L is smooth they agree.
        class(written_system_t), intent(in) :: system
        real(dp), intent(in) :: t, q(:), v(:)
        type(euler_lagrange_t), intent(in) :: terms
        type(error_t), allocatable, intent(out) :: error
        real(dp), parameter :: rounding = 1e-6_dp
        type(formula_program_t) :: program
        type(expression_t) :: slopes(4*system%ndof)
        real(dp) :: slope(4*system%ndof), exact(2*system%ndof)
        integer :: i, n

        associate (e => system%expressions)
            if (.not. any(e%lagrangian%nodes(:e%lagrangian%count)%kind == kind_function .and. &
                          e%lagrangian%nodes(:e%lagrangian%count)%which == f_abs)) return
            n = 2*system%ndof
            do i = 1, n
                slopes(i) = derivative(e%lagrangian, 1 + i)
                slopes(n + i) = magnitude(slopes(i))
            end do
            call new_formula_program(program, slopes, size(e%symbols%names))
            call program%evaluate([t, q, v, system%p], slope)
        end associate
        exact = [terms%dl_dq, terms%dl_dv]
        do i = 1, n
            if (abs(slope(i) - exact(i)) <= rounding*max(slope(n + i), tiny(t))) cycle
            call fail(error, "the Lagrangian has a kink there: its derivative by "// &
                      trim(system%expressions%symbols%names(1 + i))//" jumps; start elsewhere", &
                      status_numbers)
            return
        end do
    end subroutine check_kink
end module lagrangia_state_check
