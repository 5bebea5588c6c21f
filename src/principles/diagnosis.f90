module lagrangia_diagnosis
    !! Which coordinate's equation is wrong, and which of its terms.
    !!
    !! A slip in a formula for \(\ddot q_i\) shows in that acceleration alone; a slip in an equation
    !! of motion, solved afterwards, shows in all accelerations, but as a residual of that equation
    !! alone. Whichever is the fewer is named. Then one term of the Lagrangian's equations is
    !! sought that, counted another number of times, explains it at every state.
    use lagrangia_description, only: description_t
    use lagrangia_equation_terms, only: acceleration_terms, equation_terms, term_count, &
                                        term_length, term_names
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp
    use lagrangia_lagrange, only: accelerations_from_lagrangian, euler_lagrange_t, &
                                  expand_lagrangian
    use lagrangia_parameters, only: default_values
    use lagrangia_random_draws, only: random_t
    use lagrangia_system, only: system_t
    use lagrangia_term_fit, only: best_term
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: diagnose, factor_text

    integer, parameter :: states = 40
    real(dp), parameter :: rounding = 1e-11_dp  !! relative, of the equations at these states
    real(dp), parameter :: explained = 1e-9_dp  !! misfit of a term that explains a difference

contains

    subroutine diagnose(system, remark)
        !! One line: the culprit, and the term if it is one. `system` has its parameters.
        class(system_t), intent(in) :: system
        character(:), allocatable, intent(out) :: remark
        type(description_t) :: d
        type(random_t) :: random
        type(error_t), allocatable :: error
        real(dp), dimension(states, system%ndof) :: wrong, residual
        real(dp), allocatable :: in_accelerations(:, :, :, :), in_equations(:, :, :)
        logical, dimension(system%ndof) :: bad, unfulfilled
        real(dp) :: sizes(system%ndof)
        integer :: i, n

        n = system%ndof
        allocate (in_equations(states, n, term_count(n) + n))
        allocate (in_accelerations(states, n, term_count(n), n + 1))
        call system%describe(d)
        call collect(system, random, wrong, residual, in_accelerations, in_equations, error)
        remark = "the accelerations cannot be compared"
        if (allocated(error)) return
        sizes = maxval(abs(wrong), 1)
        bad = sizes > rounding*(1.0_dp + maxval(sizes))
        unfulfilled = maxval(abs(residual), 1) > rounding*(1.0_dp + maxval(abs(residual)))
        if (count(unfulfilled) == 1 .and. count(bad) /= 1) then
            i = findloc(unfulfilled, .true., 1)
            remark = "the equation of "//trim(d%coordinates(i)%name)//" is not that of L"// &
                     equation_term(d, i, residual(:, i), in_equations)
        else
            i = maxloc(sizes, 1)
            remark = trim(d%coordinates(i)%name)//"_ddot is not that of L"// &
                     acceleration_term(d, i, wrong(:, i), in_accelerations)
            if (count(bad) > 1) remark = remark//"; others are wrong too"
        end if
    end subroutine diagnose

    subroutine collect(system, random, wrong, residual, in_accelerations, in_equations, error)
        !! Differences and terms at many states: `wrong(s, i)` of \(\ddot q_i\), `residual(s, i)`
        !! of equation `i` with the system's accelerations in it.
        class(system_t), intent(in) :: system
        type(random_t), intent(inout) :: random
        real(dp), intent(out) :: wrong(:, :), residual(:, :)
        real(dp), intent(out) :: in_accelerations(:, :, :, :), in_equations(:, :, :)
        type(error_t), allocatable, intent(out) :: error
        type(euler_lagrange_t) :: terms
        real(dp), allocatable :: q(:), v(:), by_equation(:, :), by_acceleration(:, :, :)
        real(dp) :: t, a(system%ndof), oracle(system%ndof), multipliers(system%constraints)
        integer :: s, j, n

        n = system%ndof
        do s = 1, states
            call random%state(system, t, q, v, error)
            if (allocated(error)) return
            call system%accelerations(t, q, v, a)
            call accelerations_from_lagrangian(system, t, q, v, oracle, multipliers, error)
            if (allocated(error)) return
            call acceleration_terms(system, t, q, v, by_acceleration, error)
            if (allocated(error)) return
            call equation_terms(system, t, q, v, by_equation)
            call expand_lagrangian(system, t, q, v, terms)
            wrong(s, :) = a - oracle
            residual(s, :) = matmul(terms%mass, a - oracle)
            in_accelerations(s, :, :, :) = by_acceleration
            in_equations(s, :, :size(by_equation, 2)) = by_equation
            do j = 1, n  ! an inertia term counted more often is one on the right less often
                in_equations(s, :, size(by_equation, 2) + j) = -terms%mass(:, j)*a(j)
            end do
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
        real(dp), intent(in) :: factor
        type(description_t), intent(in) :: d
        character(:), allocatable :: text
        real(dp), allocatable :: values(:)
        integer :: i, j

        allocate (values, source=default_values(d))
        if (abs(2.0_dp*factor - anint(2.0_dp*factor)) < 1e-8_dp) then
            text = to_text(0.5_dp*anint(2.0_dp*factor) + 0.0_dp)  ! zero has no sign
            if (text(max(1, len(text) - 1):) == ".0") text = text(:len(text) - 2)
            return
        end if
        text = to_text(real(nint(1e6_dp*factor), dp)*1e-6_dp)
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

            same = abs(value - factor) < 1e-8_dp*abs(factor)
        end function same

        function name(k)
            integer, intent(in) :: k
            character(:), allocatable :: name

            name = trim(d%parameters(k)%name)
        end function name
    end function factor_text
end module lagrangia_diagnosis
