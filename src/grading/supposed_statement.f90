module lagrangia_supposed_statement
    !! What the values would be if a student's statement were true in the place of something that
    !! is: of an equation of motion, of a derivative of L, or of a known value. All other truths
    !! stay. Who goes on from a wrong line keeps all but one of them.
    use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
    use lagrangia_errors, only: error_t
    use lagrangia_expression, only: expression_t
    use lagrangia_followed_letters, only: follow_letters
    use lagrangia_formula_program, only: formula_program_t, new_formula_program
    use lagrangia_hyperdual, only: hyperdual_t
    use lagrangia_kinds, only: dp
    use lagrangia_lapack, only: solve_linear
    use lagrangia_number_class, only: all_finite, is_zero
    use lagrangia_sample_names, only: draws, role_known, samples_t, states
    use lagrangia_sampled_formula, only: evaluate_nodes
    use lagrangia_supposed_lagrangian, only: damped_rates, forget_quantities, place_letters, &
                                             squared_frequencies
    implicit none (type, external)
    private
    public :: supposition_t
    public :: suppose, suppose_frequency
    public :: no_equation, no_rate, no_force, no_momentum, no_value

    integer, parameter :: no_equation = 1  !! \(d/dt\,\partial L/\partial\dot q_j - \ldots = Q_j\)
    integer, parameter :: no_rate = 2      !! \(d/dt\,\partial L/\partial\dot q_j\) in accelerations
    integer, parameter :: no_force = 3     !! \(\partial L/\partial q_j\)
    integer, parameter :: no_momentum = 4  !! \(p_j\)
    integer, parameter :: no_value = 5     !! of a name

    integer, parameter :: steps = 12            !! of Newton, one for what is linear
    real(dp), parameter :: equal = 1e-11_dp     !! of the sizes of what a residual adds up
    real(dp), parameter :: rounding = 1e-13_dp  !! of these sizes

    type :: supposition_t
        !! One statement, and what it takes the place of.
        type(expression_t) :: residual  !! left less right side
        integer :: kind = 0             !! `no_equation`, ...
        integer :: which = 0            !! coordinate, or place of the name
    end type supposition_t

contains

    subroutine suppose(samples, suppositions, possible)
        !! Change the values so that all these statements hold.
        type(samples_t), intent(inout) :: samples                !! without them
        type(supposition_t), intent(in) :: suppositions(:)       !! one truth less for each
        logical, intent(out) :: possible                         !! at enough states
        integer :: k, row, solved
        logical :: moving, ok

        solved = 0
        possible = allocated(samples%mass)
        if (.not. possible) return
        do row = 1, size(samples%values, 1)
            call solve_row(samples, suppositions, row, ok)
            if (ok) solved = solved + 1
            if (row == 3 .and. solved == 0) exit
        end do
        possible = solved >= size(samples%values, 1)/2
        if (possible .and. samples%decay > 0) call follow_rates(samples, suppositions)
        moving = .false.
        do k = 1, size(suppositions)
            moving = moving .or. suppositions(k)%kind <= no_force
        end do
        if (.not. possible .or. .not. moving) return
        call forget_quantities(samples)
        do k = 1, draws
            call suppose_modes(samples, suppositions, k)
        end do
    end subroutine suppose

    subroutine follow_rates(samples, suppositions)
        !! \(\omega^2 = \omega_0^2 - \gamma^2\) where gamma or omega_0 is another one.
        type(samples_t), intent(inout) :: samples
        type(supposition_t), intent(in) :: suppositions(:)
        integer :: draw, k, row

        do k = 1, size(suppositions)
            if (suppositions(k)%kind /= no_value) cycle
            if (all(suppositions(k)%which /= [samples%decay, samples%decay + 1])) cycle
            do draw = 1, draws
                row = (draw - 1)*states + 1
                samples%omega2(draw, :) = 0.0_dp
                samples%omega2(draw, 1) = samples%values(row, samples%decay + 1)**2 - &
                                          samples%values(row, samples%decay)**2
            end do
        end do
    end subroutine follow_rates

    subroutine suppose_frequency(samples, residual, possible)
        !! Change \(\omega^2\) so that a statement about it holds, for each draw of parameters.
        type(samples_t), intent(inout) :: samples       !! without it
        type(expression_t), intent(in) :: residual      !! left less right side, with omega
        logical, intent(out) :: possible                !! there is such a number
        real(dp) :: values(1, size(samples%role)), nodes(1, residual%count), x(2), f(2), next
        integer :: draw, i

        possible = all(maxval(samples%omega2, 2) > 0.0_dp)
        do draw = 1, draws
            if (.not. possible) return
            values = samples%values((draw - 1)*states + 1:(draw - 1)*states + 1, :)
            x = maxval(samples%omega2(draw, :))*[1.0_dp, 1.1_dp]
            call evaluate(x(1), f(1))
            do i = 1, 50  ! a secant each
                call evaluate(x(2), f(2))
                possible = is_zero(f(2))
                if (possible) exit
                next = x(2) - f(2)*(x(2) - x(1))/(f(2) - f(1))
                possible = abs(next - x(2)) <= equal*abs(next)
                x = [x(2), next]
                f(1) = f(2)
                if (possible .or. .not. next > 0.0_dp) exit
            end do
            samples%omega2(draw, :) = 0.0_dp
            samples%omega2(draw, 1) = x(2)
        end do
    contains
        subroutine evaluate(omega2, result)
            real(dp), intent(in) :: omega2
            real(dp), intent(out) :: result

            values(1, samples%frequency) = sqrt(omega2)
            values(1, samples%frequency + 1) = omega2
            call evaluate_nodes(residual, values, nodes)
            result = nodes(1, residual%count)
        end subroutine evaluate
    end subroutine suppose_frequency

    subroutine solve_row(samples, suppositions, row, ok)
        !! Newton along the directions in which one truth each is given up.
        type(samples_t), intent(inout) :: samples
        type(supposition_t), intent(in) :: suppositions(:)
        integer, intent(in) :: row
        logical, intent(out) :: ok
        real(dp) :: base(size(samples%role)), along(size(samples%role), size(suppositions))
        real(dp), dimension(size(suppositions)) :: f, moved, s, step, scale, scale_there
        real(dp) :: slopes(size(suppositions), size(suppositions))
        type(error_t), allocatable :: error
        integer :: i, k, m

        m = size(suppositions)
        base = samples%values(row, :)
        do k = 1, m
            call direction(samples, row, suppositions(k), along(:, k), ok)
            if (.not. ok) return
        end do
        s = 0.0_dp
        call residuals(s, f, scale)
        ok = .false.
        do i = 1, steps
            if (.not. all_finite(f)) exit
            ok = i > 1 .and. all(abs(f) <= equal*scale)
            if (ok) exit
            do k = 1, m
                step = s
                step(k) = step(k) + 1.0_dp
                call residuals(step, moved, scale_there)
                slopes(:, k) = moved - f
                where (abs(slopes(:, k)) <= rounding*scale_there) slopes(:, k) = 0.0_dp
            end do
            if (.not. all_finite(slopes)) exit
            call solve_linear(slopes, -f, step, error)
            if (allocated(error)) exit
            s = s + step
            call residuals(s, f, scale)
        end do
        if (.not. ok) samples%values(row, :) = ieee_value(1.0_dp, ieee_quiet_nan)
    contains
        subroutine residuals(x, result, sizes)
            real(dp), intent(in) :: x(:)
            real(dp), intent(out) :: result(:), sizes(:)
            real(dp), allocatable, dimension(:, :) :: nodes, sizes_of_nodes
            integer :: n

            samples%values(row, :) = base + matmul(along, x)
            call follow_letters(samples, row)
            do n = 1, m
                if (allocated(nodes)) deallocate (nodes, sizes_of_nodes)
                allocate (nodes(1, suppositions(n)%residual%count))
                allocate (sizes_of_nodes, mold=nodes)
                call evaluate_nodes(suppositions(n)%residual, samples%values(row:row, :), nodes, &
                                    sizes=sizes_of_nodes)
                result(n) = nodes(1, size(nodes, 2))
                sizes(n) = sizes_of_nodes(1, size(nodes, 2))
            end do
        end subroutine residuals
    end subroutine solve_row

    subroutine direction(samples, row, supposition, along, ok)
        !! How all values change with one truth given up.
        type(samples_t), intent(in) :: samples
        integer, intent(in) :: row
        type(supposition_t), intent(in) :: supposition
        real(dp), intent(out) :: along(:)
        logical, intent(out) :: ok
        real(dp) :: unit(samples%ndof), a(samples%ndof)
        type(error_t), allocatable :: error

        along = 0.0_dp
        ok = .true.
        associate (j => supposition%which, first => samples%first_acceleration)
            select case (supposition%kind)
            case (no_value)
                along(j) = 1.0_dp
            case (no_momentum)
                along(place("p_", "")) = 1.0_dp
                along(place("dL_d", "_dot")) = 1.0_dp
            case default
                unit = 0.0_dp
                unit(j) = 1.0_dp
                call solve_linear(samples%mass(:, :, row), unit, a, error)
                ok = .not. allocated(error)
                along(first:first + samples%ndof - 1) = a
                if (supposition%kind /= no_rate) along(place("d_dt_dL_d", "_dot")) = 1.0_dp
                if (supposition%kind == no_force) along(place("dL_d", "")) = 1.0_dp
            end select
        end associate
    contains
        integer function place(before, after)
            character(*), intent(in) :: before, after

            place = samples%symbols%find(before// &
                                         trim(samples%symbols%names(1 + supposition%which))//after)
        end function place
    end subroutine direction

    subroutine suppose_modes(samples, suppositions, draw)
        !! \(\omega^2\) where equations of motion in coordinates and accelerations are supposed.
        type(samples_t), intent(inout) :: samples
        type(supposition_t), intent(in) :: suppositions(:)
        integer, intent(in) :: draw
        real(dp), dimension(samples%ndof, samples%ndof) :: mass, stiffness
        real(dp) :: slope(samples%ndof)
        type(formula_program_t) :: program
        type(hyperdual_t) :: inputs(size(samples%role)), r(1)
        logical :: known
        integer :: i, j, k, n

        n = samples%ndof
        mass = samples%inertia(:, :, draw)
        stiffness = samples%stiffness(:, :, draw)
        slope = 0.0_dp
        known = all_finite(samples%equilibrium(:, draw))
        do k = 1, size(suppositions)
            j = suppositions(k)%which
            known = known .and. suppositions(k)%kind == no_equation
            do i = 1, size(samples%role)
                if (samples%role(i) < role_known) cycle
                if (suppositions(k)%residual%depends_on(i)) known = .false.
            end do
            if (.not. known) exit
            call new_formula_program(program, [suppositions(k)%residual], size(samples%role))
            do i = 1, n
                call at_equilibrium(1 + i)
                slope(j) = r(1)%re
                stiffness(j, i) = r(1)%d1
                call at_equilibrium(samples%first_acceleration - 1 + i)
                mass(j, i) = r(1)%d1
            end do
        end do
        if (known .and. samples%decay > 0) then
            call at_equilibrium(2 + n)
            call damped_rates(samples, draw, mass(1, 1), r(1)%d1, stiffness(1, 1), slope(1))
        else if (known) then
            call squared_frequencies(samples, draw, mass, stiffness, slope)
        else
            samples%omega2(draw, :) = 0.0_dp
        end if
    contains
        subroutine at_equilibrium(varied)
            integer, intent(in) :: varied
            integer :: first

            first = samples%first_acceleration
            inputs = hyperdual_t()
            inputs%re = samples%values((draw - 1)*states + 1, :)
            inputs(2:1 + n)%re = samples%equilibrium(:, draw)
            inputs(2 + n:1 + 2*n)%re = 0.0_dp
            inputs(first:first + n - 1)%re = 0.0_dp
            inputs(varied)%d1 = 1.0_dp
            call place_letters(samples, inputs)
            call program%evaluate(inputs, r)
        end subroutine at_equilibrium
    end subroutine suppose_modes
end module lagrangia_supposed_statement
