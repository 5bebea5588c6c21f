module lagrangia_diagnosis
    !! Which coordinate's equation is wrong, and which of its terms.
    !!
    !! A slip in a formula for \(\ddot q_i\) shows in that acceleration alone; a slip in an equation
    !! of motion, solved afterwards, shows in all accelerations, but as a residual of that equation
    !! alone. Whichever is the fewer is named. Then one term of the Lagrangian's equations is
    !! sought that, counted another number of times, explains it at every state.
    use lagrangia_description, only: default_values, description_t
    use lagrangia_equation_terms, only: acceleration_terms, equation_terms, term_count, &
                                        term_length, term_names
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp
    use lagrangia_number_class, only: is_nonzero
    use lagrangia_random_draws, only: random_t
    use lagrangia_system, only: system_t
    use lagrangia_term_fit, only: best_term
    use lagrangia_term_sizes, only: motion_t, nearby_t, new_nearby, solve_motion
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: diagnose, factor_text

    integer, parameter :: states = 40
    real(dp), parameter :: rounding = 100.0_dp*epsilon(1.0_dp)
    !! of the terms of an equation, as in `lagrangia_audit_equations`
    real(dp), parameter :: aside = 1e-6_dp
    !! of the worst: what is so much better suffers from how the wrong equations were solved
    real(dp), parameter :: explained = 1e-9_dp  !! misfit of a term that explains a difference

contains

    subroutine diagnose(system, remark)
        !! One line: the culprit, and the term if it is one. `system` has its parameters.
        class(system_t), intent(in) :: system  !! with its parameters
        character(:), allocatable, intent(out) :: remark  !! what is wrong, in words
        type(description_t) :: d
        type(random_t) :: random
        type(error_t), allocatable :: error
        real(dp), dimension(states, system%ndof) :: wrong, residual
        real(dp), dimension(system%ndof) :: of_acceleration, of_equation
        real(dp), allocatable :: in_accelerations(:, :, :, :), in_equations(:, :, :)
        logical, dimension(system%ndof) :: bad, unfulfilled
        integer :: i, n

        n = system%ndof
        allocate (in_equations(states, n, term_count(n) + n))
        allocate (in_accelerations(states, n, term_count(n), n + 1))
        call system%describe(d)
        call collect(system, random, wrong, residual, of_acceleration, of_equation, &
                     in_accelerations, in_equations, error)
        remark = "the accelerations cannot be compared"
        if (allocated(error)) return
        bad = of_acceleration > max(rounding, aside*maxval(of_acceleration))
        unfulfilled = of_equation > max(rounding, aside*maxval(of_equation))
        if (count(unfulfilled) == 1 .and. count(bad) /= 1) then
            i = findloc(unfulfilled, .true., 1)
            remark = "the equation of "//trim(d%coordinates(i)%name)//" is not that of L"// &
                     equation_term(d, i, residual(:, i), in_equations)
        else
            i = maxloc(of_acceleration, 1)
            remark = trim(d%coordinates(i)%name)//"_ddot is not that of L"// &
                     acceleration_term(d, i, wrong(:, i), in_accelerations)
            if (count(bad) > 1) remark = remark//"; others are wrong too"
        end if
    end subroutine diagnose

    subroutine collect(system, random, wrong, residual, of_acceleration, of_equation, &
                       in_accelerations, in_equations, error)
        !! Differences and terms at many states: `wrong(s, i)` of \(\ddot q_i\), `residual(s, i)`
        !! of equation `i` with the system's accelerations in it; and the largest of each,
        !! relative to the size of its terms.
        class(system_t), intent(in) :: system
        type(random_t), intent(inout) :: random
        real(dp), intent(out) :: wrong(:, :), residual(:, :), of_acceleration(:), of_equation(:)
        real(dp), intent(out) :: in_accelerations(:, :, :, :), in_equations(:, :, :)
        type(error_t), allocatable, intent(out) :: error
        type(description_t) :: d
        type(nearby_t) :: nearby
        type(motion_t) :: motion
        real(dp), allocatable :: q(:), v(:), by_equation(:, :), by_acceleration(:, :, :)
        real(dp), dimension(system%ndof) :: a, size_of_row
        real(dp) :: t
        integer :: s, j, n

        n = system%ndof
        call system%describe(d)
        of_acceleration = 0.0_dp
        of_equation = 0.0_dp
        do s = 1, states
            call random%state(system, t, q, v, error)
            if (allocated(error)) return
            call system%accelerations(t, q, v, a)
            call new_nearby(nearby, system, default_values(d), t, q, v)
            call solve_motion(nearby, motion, error)
            if (allocated(error)) return
            call acceleration_terms(system, t, q, v, by_acceleration, error)
            if (allocated(error)) return
            call equation_terms(system, t, q, v, by_equation)
            wrong(s, :) = a - motion%accelerations
            associate (mass => nearby%terms(0)%mass)
                residual(s, :) = matmul(mass, wrong(s, :))
                size_of_row = motion%equation_size + matmul(abs(mass), abs(a))
                in_accelerations(s, :, :, :) = by_acceleration
                in_equations(s, :, :size(by_equation, 2)) = by_equation
                do j = 1, n  ! an inertia term counted more often is one on the right less often
                    in_equations(s, :, size(by_equation, 2) + j) = -mass(:, j)*a(j)
                end do
            end associate
            where (is_nonzero(wrong(s, :)))
                of_acceleration = max(of_acceleration, abs(wrong(s, :)) &
                                      /(motion%size + abs(wrong(s, :))))
            end where
            where (is_nonzero(residual(s, :)))
                of_equation = max(of_equation, abs(residual(s, :))/size_of_row)
            end where
        end do
    end subroutine collect

    function equation_term(d, i, residual, terms) result(text)
        !! Which term of equation `i` explains its residual; nothing if none does.
        type(description_t), intent(in) :: d
        integer, intent(in) :: i
        real(dp), intent(in) :: residual(:), terms(:, :, :)
        character(:), allocatable :: text
        character(term_length), allocatable :: names(:)
        real(dp) :: factor, misfit
        integer :: which

        text = ""
        allocate (names, source=term_names(d))
        call best_term(residual, terms(:, i, :), which, factor, misfit)
        if (.not. misfit < explained) return
        if (which > size(names)) then
            text = ": its term in "//trim(d%coordinates(which - size(names))%name)//"_ddot"
        else
            text = ": its "//trim(names(which))
        end if
        text = text//" counts "//factor_text(1.0_dp + factor, d)//" times"
    end function equation_term

    function acceleration_term(d, i, wrong, terms) result(text)
        !! Which term of which equation explains what is wrong with \(\ddot q_i\).
        type(description_t), intent(in) :: d
        integer, intent(in) :: i
        real(dp), intent(in) :: wrong(:), terms(:, :, :, :)
        character(:), allocatable :: text
        character(term_length), allocatable :: names(:)
        real(dp) :: factor, misfit
        integer :: which, equation, term

        text = ""
        allocate (names, source=term_names(d))
        call best_term(wrong, reshape(terms(:, i, :, :), [size(wrong), size(terms(1, 1, :, :))]), &
                       which, factor, misfit)
        if (.not. misfit < explained) return
        equation = (which - 1)/size(names) + 1
        term = which - (equation - 1)*size(names)
        if (equation > size(d%coordinates)) then
            text = ": the velocity term of its constraints"
        else if (size(d%coordinates) == 1) then
            text = ": its "//trim(names(term))
        else
            text = ": the "//trim(names(term))//" of the equation of "// &
                   trim(d%coordinates(equation)%name)
        end if
        text = text//" counts "//factor_text(1.0_dp + factor, d)//" times in it"
    end function acceleration_term

    function factor_text(factor, d) result(text)
        !! A whole number or a half, a parameter or its reciprocal or square, a ratio of two; else
        !! the number.
        real(dp), intent(in) :: factor  !! of a term
        type(description_t), intent(in) :: d  !! the system's
        character(:), allocatable :: text
        real(dp), parameter :: zero = 1e-11_dp  !! what rounding leaves of 1 - 1
        real(dp), allocatable :: values(:)
        real(dp) :: rounded
        character(13) :: number
        integer :: i, j

        allocate (values, source=default_values(d))
        if (abs(2.0_dp*factor - anint(2.0_dp*factor)) <= 1e-8_dp*abs(factor) .or. &
            abs(factor) < zero) then
            text = to_text(0.5_dp*anint(2.0_dp*factor) + 0.0_dp)
            if (text(max(1, len(text) - 1):) == ".0") text = text(:len(text) - 2)
            return
        end if
        write (number, "(ss, es13.6)") factor
        read (number, *) rounded
        text = to_text(rounded)
        if (any(d%parameters%count > 1)) return
        do i = 1, size(values)
            if (same(values(i))) text = name(i)
            if (same(1.0_dp/values(i))) text = "1/"//name(i)
            if (same(values(i)**2)) text = name(i)//"^2"
            if (same(1.0_dp/values(i)**2)) text = "1/"//name(i)//"^2"
            do j = 1, size(values)
                if (i /= j .and. same(values(i)/values(j))) text = name(i)//"/"//name(j)
            end do
        end do
    contains
        function same(value)
            real(dp), intent(in) :: value
            logical :: same

            same = abs(value - factor) < 1e-8_dp*abs(factor) + zero
        end function same

        function name(k)
            integer, intent(in) :: k
            character(:), allocatable :: name

            name = trim(d%parameters(k)%name)
        end function name
    end function factor_text
end module lagrangia_diagnosis
