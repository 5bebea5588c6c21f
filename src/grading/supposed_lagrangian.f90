module lagrangia_supposed_lagrangian
    !! What the motion would be if L were a student's formula, right or wrong: the same states, and
    !! the accelerations, momenta, energies and frequencies that follow from it.
    use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
    use lagrangia_errors, only: error_t
    use lagrangia_expression, only: expression_t
    use lagrangia_followed_letters, only: follow_letters
    use lagrangia_formula_program, only: formula_program_t, new_formula_program
    use lagrangia_hyperdual, only: hyperdual_t
    use lagrangia_kinds, only: dp
    use lagrangia_lapack, only: solve_linear
    use lagrangia_lapack_eigen, only: dgeev
    use lagrangia_number_class, only: all_finite
    use lagrangia_same_motion, only: lagrange_terms
    use lagrangia_sample_names, only: draws, role_known, samples_t, states
    implicit none (type, external)
    private
    public :: damped_rates, forget_quantities, place_letters, squared_frequencies, &
              suppose_lagrangian

    real(dp), parameter :: equal = 1e-9_dp  !! relative, of what Lagrange's equations give

contains

    subroutine suppose_lagrangian(samples, lagrangian, possible)
        !! Change the values so that they belong to this L; generalised forces beside it stay.
        type(samples_t), intent(inout) :: samples       !! of the true motion before
        type(expression_t), intent(in) :: lagrangian    !! of coordinates, velocities, time, letters
        logical, intent(out) :: possible                !! it determines the accelerations
        type(formula_program_t) :: program
        real(dp), dimension(samples%ndof) :: slope, momentum, rate, at_rest, forces, a
        real(dp) :: mass(samples%ndof, samples%ndof), value
        type(error_t), allocatable :: error
        integer :: j, n, row

        n = samples%ndof
        possible = allocated(samples%mass)
        if (.not. possible) return
        call new_formula_program(program, [lagrangian], size(samples%role))
        do row = 1, size(samples%values, 1)
            do j = 1, n
                forces(j) = samples%values(row, place("d_dt_dL_d", j, "_dot")) - &
                            samples%values(row, place("dL_d", j, ""))
            end do
            associate (values => samples%values(row, :), first => samples%first_acceleration)
                a = 0.0_dp
                call lagrange_terms(samples, program, values, a, value, momentum, at_rest, slope)
                do j = 1, n
                    a = 0.0_dp
                    a(j) = 1.0_dp
                    call lagrange_terms(samples, program, values, a, value, momentum, rate, slope)
                    mass(:, j) = rate - at_rest
                end do
                call solve_linear(mass, slope + forces - at_rest, a, error)
                possible = .not. allocated(error) .and. all_finite(a)
                if (.not. possible) return
                samples%mass(:, :, row) = mass
                rate = at_rest + matmul(mass, a)
                samples%values(row, first:first + n - 1) = a
            end associate
            do j = 1, n
                samples%values(row, place("p_", j, "")) = momentum(j)
                samples%values(row, place("dL_d", j, "_dot")) = momentum(j)
                samples%values(row, place("d_dt_dL_d", j, "_dot")) = rate(j)
                samples%values(row, place("dL_d", j, "")) = slope(j)
            end do
            samples%values(row, samples%symbols%find("L")) = value
            samples%values(row, samples%symbols%find("E")) = &
                dot_product(momentum, samples%values(row, 2 + n:1 + 2*n)) - value
            call follow_letters(samples, row)
        end do
        samples%lagrangian = lagrangian
        call forget_quantities(samples)
        call suppose_modes(samples, program)
    contains
        integer function place(before, i, after)
            character(*), intent(in) :: before, after
            integer, intent(in) :: i

            place = samples%symbols%find(before//trim(samples%symbols%names(1 + i))//after)
        end function place
    end subroutine suppose_lagrangian

    subroutine forget_quantities(samples)
        !! What the system has beside, and second rates of places, belongs to the true motion: NaN.
        type(samples_t), intent(inout) :: samples  !! of another motion
        integer :: k

        do k = 1, samples%last_point
            if (samples%role(k) /= role_known) cycle
            if (samples%symbols%names(k) (:2) == "p_") cycle  ! a momentum
            if (k >= samples%first_point .and. modulo(k - samples%first_point, 3) < 2) cycle
            samples%values(:, k) = ieee_value(1.0_dp, ieee_quiet_nan)
        end do
        do k = 1, size(samples%role)
            if (all(samples%symbols%names(k) /= ["L_dot", "dL_dt"]) .and. &
                index(samples%symbols%names(k), "dE_d") /= 1) cycle
            samples%values(:, k) = ieee_value(1.0_dp, ieee_quiet_nan)
        end do
    end subroutine forget_quantities

    subroutine suppose_modes(samples, program)
        !! \(\omega^2\) of this L about the true equilibrium, if that is one of it as well; 0
        !! otherwise.
        type(samples_t), intent(inout) :: samples
        type(formula_program_t), intent(in) :: program
        type(hyperdual_t) :: inputs(size(samples%role)), l(1)
        real(dp), dimension(samples%ndof, samples%ndof) :: mass, stiffness
        real(dp) :: slope(samples%ndof)
        integer :: draw, i, j, n

        n = samples%ndof
        do draw = 1, draws
            if (.not. all_finite(samples%equilibrium(:, draw))) cycle
            do i = 1, n
                do j = 1, n
                    call at_equilibrium(inputs)
                    inputs(1 + i)%d1 = 1.0_dp
                    inputs(1 + j)%d2 = 1.0_dp
                    call place_letters(samples, inputs)
                    call program%evaluate(inputs, l)
                    slope(i) = l(1)%d1
                    stiffness(i, j) = -l(1)%d12
                    call at_equilibrium(inputs)
                    inputs(1 + n + i)%d1 = 1.0_dp
                    inputs(1 + n + j)%d2 = 1.0_dp
                    call place_letters(samples, inputs)
                    call program%evaluate(inputs, l)
                    mass(i, j) = l(1)%d12
                end do
            end do
            if (samples%decay > 0) then
                call damped_rates(samples, draw, mass(1, 1), samples%turning(1, 1, draw), &
                                  stiffness(1, 1), slope(1))
            else
                call squared_frequencies(samples, draw, mass, stiffness, slope)
            end if
        end do
    contains
        subroutine at_equilibrium(x)
            type(hyperdual_t), intent(out) :: x(:)

            x%re = samples%values((draw - 1)*states + 1, :)
            x(2:1 + n)%re = samples%equilibrium(:, draw)
            x(2 + n:1 + 2*n)%re = 0.0_dp
            call place_letters(samples, x)
        end subroutine at_equilibrium
    end subroutine suppose_modes

    subroutine place_letters(samples, inputs)
        !! The letters at another place, from what they stand for; their rates are zero there.
        type(samples_t), intent(in) :: samples              !! know them
        type(hyperdual_t), intent(inout) :: inputs(:)       !! of all symbols
        type(hyperdual_t) :: result(1)
        integer :: i, rate

        do i = 1, size(samples%compiled)
            call samples%compiled(i)%program%evaluate(inputs, result)
            inputs(samples%compiled(i)%symbol) = result(1)
            rate = samples%rate(samples%compiled(i)%symbol)
            if (rate > 0) inputs(rate) = hyperdual_t()
        end do
    end subroutine place_letters

    subroutine damped_rates(samples, draw, mass, drag, stiffness, slope)
        !! gamma, omega_0 and \(\omega^2 = K/M - (C/2M)^2\) of one coordinate with drag; no number
        !! if it is no equilibrium.
        type(samples_t), intent(inout) :: samples                !! get them for this draw
        integer, intent(in) :: draw                              !! of parameters
        real(dp), intent(in) :: mass, drag, stiffness, slope     !! slope: what is zero there
        real(dp) :: gamma, squared

        gamma = 0.5_dp*drag/mass
        squared = stiffness/mass
        samples%omega2(draw, :) = 0.0_dp
        if (abs(slope) > equal*abs(stiffness)) then
            gamma = ieee_value(1.0_dp, ieee_quiet_nan)
            squared = gamma
        else
            samples%omega2(draw, 1) = squared - gamma**2
            samples%inertia(1, 1, draw) = mass
            samples%turning(1, 1, draw) = drag
            samples%stiffness(1, 1, draw) = stiffness
        end if
        associate (rows => samples%values((draw - 1)*states + 1:draw*states, :))
            rows(:, samples%decay) = gamma
            rows(:, samples%decay + 1) = sqrt(squared)
        end associate
    end subroutine damped_rates

    subroutine squared_frequencies(samples, draw, mass, stiffness, slope)
        !! Of \(M\ddot\delta + K\delta = 0\), which need not be symmetric, by LAPACK's `dgeev`; 0 if
        !! it is no equilibrium, has a complex one, or the true ones are not those of M and K.
        type(samples_t), intent(inout) :: samples      !! gets `omega2` of this draw, M and K
        integer, intent(in) :: draw                    !! of parameters
        real(dp), intent(in) :: mass(:, :)             !! M, (ndof, ndof)
        real(dp), intent(in) :: stiffness(:, :)        !! K, as many
        real(dp), intent(in) :: slope(:)               !! what is zero at an equilibrium, (ndof)
        real(dp) :: found(samples%ndof)
        logical :: known
        integer :: n

        n = samples%ndof
        call solve(samples%inertia(:, :, draw), samples%stiffness(:, :, draw), found, known)
        if (known) known = maxval(abs(found - samples%omega2(draw, :n))) <= &
                           1e-6_dp*maxval(abs(found))
        if (known) known = maxval(abs(slope)) <= equal*maxval(abs(stiffness))
        if (known) call solve(mass, stiffness, found, known)
        samples%omega2(draw, :) = 0.0_dp
        if (known) then
            samples%omega2(draw, :n) = found
            samples%inertia(:, :, draw) = mass
            samples%stiffness(:, :, draw) = stiffness
        else
            samples%turning(:, :, draw) = ieee_value(1.0_dp, ieee_quiet_nan)
        end if
    contains
        subroutine solve(m, k, omega2, ok)
            real(dp), intent(in) :: m(n, n), k(n, n)
            real(dp), intent(out) :: omega2(n)
            logical, intent(out) :: ok
            real(dp) :: a(n, n), im(n), none(1, 1), nothing(1, 1), work(20*n + 100), smallest
            type(error_t), allocatable :: error
            integer :: i, j, info

            ok = .false.
            omega2 = 0.0_dp
            do j = 1, n
                call solve_linear(m, k(:, j), a(:, j), error)
                if (allocated(error)) return
            end do
            call dgeev("N", "N", n, a, n, omega2, im, none, 1, nothing, 1, work, size(work), info)
            ok = info == 0 .and. maxval(abs(im)) <= equal*maxval(abs(omega2))
            do i = 1, n - 1  ! in their order
                j = i - 1 + minloc(omega2(i:), 1)
                smallest = omega2(j)
                omega2(j) = omega2(i)
                omega2(i) = smallest
            end do
        end subroutine solve
    end subroutine squared_frequencies
end module lagrangia_supposed_lagrangian
