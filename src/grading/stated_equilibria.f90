module lagrangia_stated_equilibria
    !! `theta_eq = pi`, and `theta = pi + u`: an equilibrium beside those that `modes` shows.
    use lagrangia_derivative, only: derivative
    use lagrangia_description, only: description_t, name_length, sizes_of_places, &
                                     value_names
    use lagrangia_eigen, only: normal_modes
    use lagrangia_equilibrium, only: settle
    use lagrangia_errors, only: error_t
    use lagrangia_expression, only: expression_t, kind_symbol, operator(+), whole
    use lagrangia_gyroscopic, only: gyroscopic_modes
    use lagrangia_kinds, only: dp
    use lagrangia_lapack, only: solve_linear
    use lagrangia_mode_samples, only: put_other_modes
    use lagrangia_motion_values, only: values_of
    use lagrangia_number_class, only: all_finite, is_nonzero, is_zero
    use lagrangia_sample_names, only: draws, samples_t, states
    use lagrangia_slip_search, only: holds
    use lagrangia_small_oscillations, only: find_modes, modes_t
    use lagrangia_substitution, only: substituted
    use lagrangia_system, only: system_t
    use lagrangia_written_out, only: energy_formulas, in_coordinates
    implicit none (type, external)
    private
    public :: another_equilibrium, is_equilibrium, keep_equilibrium, keep_origin
    public :: put_inverted, put_root, put_stated

    real(dp), parameter :: pi = acos(-1.0_dp)
    character(*), parameter :: another_equilibrium = "another equilibrium than that at or near zero"
    !! what is said of one

contains

    function is_equilibrium(left, right, samples) result(yes)
        !! A place alone on the left side, and on the right one where no force acts at rest: all
        !! \(\partial L/\partial q_j+Q_j=0\), with places for the other coordinates.
        type(expression_t), intent(in) :: left, right  !! both sides
        type(samples_t), intent(in) :: samples         !! know L and the forces
        logical :: yes
        real(dp), allocatable :: values(:, :)
        integer :: coordinate, j

        yes = left%count == 1 .and. left%nodes(1)%kind == kind_symbol
        if (.not. yes) return
        coordinate = findloc(samples%place, left%nodes(1)%which, 1)
        yes = coordinate > 0 .and. .not. any([(right%depends_on(j), j=1, 1 + 3*samples%ndof)])
        if (yes) call find_rest(coordinate, values_of(right, samples%values), samples, values, yes)
    end function is_equilibrium

    subroutine keep_equilibrium(residual, samples)
        !! The oscillations about an equilibrium that a line has stated: as the other one where none
        !! is known beside the first, else for `put_stated`.
        type(expression_t), intent(in) :: residual  !! the place less its value
        type(samples_t), intent(inout) :: samples   !! get it as the other one
        real(dp), allocatable :: values(:, :)
        integer :: coordinate
        logical :: found

        do coordinate = 1, samples%ndof
            if (.not. residual%depends_on(samples%place(coordinate))) cycle
            values = samples%values
            values(:, samples%place(coordinate)) = 0.0_dp
            call find_rest(coordinate, -values_of(residual, values), samples, values, found)
            if (found .and. other_is_known(samples)) samples%stated_rest = values
            if (found) call keep(values, .false., samples)
            return
        end do
    end subroutine keep_equilibrium

    subroutine put_stated(samples, found)
        !! The equilibrium that a line has stated beside the two that are known.
        type(samples_t), intent(inout) :: samples   !! get it as the other one
        logical, intent(out) :: found               !! there is one

        found = allocated(samples%stated_rest)
        if (found) call keep(samples%stated_rest, .true., samples)
    end subroutine put_stated

    pure function other_is_known(samples) result(yes)
        !! Beside the first.
        type(samples_t), intent(in) :: samples
        logical :: yes

        yes = any(is_nonzero(samples%other_equilibrium - samples%equilibrium))
    end function other_is_known

    subroutine put_root(residual, samples, found)
        !! The equilibrium of one coordinate at which a statement about small oscillations is one
        !! of rest: \(\ddot\theta=(g/l)(\theta-\pi)\) is about \(\pi\).
        type(expression_t), intent(in) :: residual  !! left less right side
        type(samples_t), intent(inout) :: samples   !! get it as the other one
        logical, intent(out) :: found               !! there is one
        type(expression_t) :: still(2)

        found = .false.
        if (samples%ndof /= 1) return
        still(1) = whole(0)
        still(2) = whole(0)
        call keep_origin(substituted(residual, [3, 4], still), .true., samples, found)
    end subroutine put_root

    subroutine put_inverted(samples, found)
        !! The equilibrium of one angle at \(\pi\).
        type(samples_t), intent(inout) :: samples   !! get it as the other one
        logical, intent(out) :: found               !! there is one
        real(dp), allocatable :: values(:, :)
        integer :: row

        found = samples%ndof == 1
        if (.not. found) return
        call find_rest(1, [(pi, row=1, size(samples%values, 1))], samples, values, found)
        if (found) call keep(values, .true., samples)
    end subroutine put_inverted

    subroutine keep_origin(meaning, instead, samples, found)
        !! The same where a name counts a coordinate from there: \(u = c\,(q - q_0)\).
        type(expression_t), intent(in) :: meaning  !! u, in coordinates
        logical, intent(in) :: instead             !! of another one that is known
        type(samples_t), intent(inout) :: samples  !! get the equilibrium as the other one
        logical, intent(out) :: found              !! it is one
        type(expression_t) :: slope
        real(dp), allocatable :: values(:, :), there(:), slopes(:)
        integer :: coordinate, j, n

        found = .false.
        n = samples%ndof
        if (count([(meaning%depends_on(j), j=1, 1 + 3*n)]) /= 1) return
        do coordinate = 1, n
            if (.not. meaning%depends_on(1 + coordinate)) cycle
            slope = derivative(meaning, 1 + coordinate)
            if (any([(slope%depends_on(j), j=1, 1 + 3*n)])) return
            values = samples%values
            values(:, 1 + coordinate) = 0.0_dp
            slopes = values_of(slope, values)
            if (any(is_zero(slopes))) return
            there = -values_of(meaning, values)/slopes
            if (all(is_zero(there))) return
            call find_rest(coordinate, there, samples, values, found)
            if (found) call keep(values, instead, samples)
            return
        end do
    end subroutine keep_origin

    subroutine find_rest(coordinate, there, samples, values, found)
        !! States at rest with one coordinate given; the others go from their known equilibrium to
        !! where no force acts on them, by Newton's method. Is there none on the given one then?
        integer, intent(in) :: coordinate                    !! which is given
        real(dp), intent(in) :: there(:)                     !! where, (draws*states)
        type(samples_t), intent(in) :: samples               !! know L and the forces
        real(dp), allocatable, intent(out) :: values(:, :)   !! (draws*states, symbols)
        logical, intent(out) :: found                        !! there is an equilibrium
        integer, parameter :: most = 30
        type(expression_t) :: force(samples%ndof), slope(samples%ndof, samples%ndof)
        real(dp), dimension(size(there), samples%ndof) :: forces, changes
        real(dp) :: slopes(size(there), samples%ndof, samples%ndof)
        real(dp) :: sizes(size(there)), change(samples%ndof - 1)
        type(error_t), allocatable :: error
        integer, allocatable :: others(:)
        integer :: i, j, n, pass, row
        logical :: judged

        n = samples%ndof
        values = samples%values
        values(:, 2:n + 1) = values(:, samples%place)
        values(:, coordinate + 1) = there
        values(:, n + 2:3*n + 1) = 0.0_dp
        if (samples%lagrangian%count == 0) then
            call settle_without_formula(coordinate, samples, values, found)
            return
        end if
        call forces_at_rest(samples, force)
        others = pack([(j, j=1, n)], [(j, j=1, n)] /= coordinate)
        do j = 1, n
            do i = 1, n
                slope(j, i) = derivative(force(j), 1 + i)
            end do
        end do
        do pass = 1, most
            if (n == 1) exit
            do j = 1, n
                forces(:, j) = values_of(force(j), values)
                do i = 1, n
                    slopes(:, j, i) = values_of(slope(j, i), values)
                end do
            end do
            changes = 0.0_dp
            do row = 1, size(there)
                call solve_linear(slopes(row, others, others), -forces(row, others), change, error)
                found = .not. allocated(error)
                if (.not. found) return
                changes(row, others) = change
            end do
            values(:, 2:n + 1) = values(:, 2:n + 1) + changes
            sizes = maxval(abs(values(:, 2:n + 1)), 2)
            if (all(maxval(abs(changes), 2) <= 4*epsilon(1.0_dp)*sizes)) exit
        end do
        found = all_finite(values(:, 2:n + 1))
        do j = 1, n
            if (.not. found) return
            call holds(force(j), values, found, judged)
            found = found .and. judged
        end do
    end subroutine find_rest

    subroutine settle_without_formula(coordinate, samples, values, found)
        !! The same of a system of which the page has no formula of L: by the derivatives of L that
        !! it computes. A place from which Newton's method leads away is none.
        integer, intent(in) :: coordinate          !! which is given
        type(samples_t), intent(in) :: samples     !! know the system
        real(dp), intent(inout) :: values(:, :)    !! at rest at the given place
        logical, intent(out) :: found              !! there is an equilibrium
        class(system_t), allocatable :: drawn
        type(description_t) :: d
        type(error_t), allocatable :: error
        real(dp) :: q(samples%ndof), given
        integer :: draw, j, row

        call samples%system%describe(d)
        associate (size_of => sizes_of_places(d))
            do draw = 1, draws
                row = draw*states
                q = values(row, 2:samples%ndof + 1)
                given = q(coordinate)
                found = all_finite(q)
                if (.not. found) return
                call configure_draw(samples, draw, drawn, error)
                if (.not. allocated(error)) call settle(drawn, .false., q, error)
                found = .not. allocated(error)
                if (.not. found) return
                found = abs(q(coordinate) - given) <= &
                    max(1e-12_dp*size_of(coordinate), 4.0_dp*spacing(given))
                if (.not. found) return
                q(coordinate) = given
                do j = 1, samples%ndof
                    values(row - states + 1:row, 1 + j) = q(j)
                end do
            end do
        end associate
    end subroutine settle_without_formula

    subroutine configure_draw(samples, draw, drawn, error)
        !! The system with the parameters of one draw.
        type(samples_t), intent(in) :: samples             !! know the system
        integer, intent(in) :: draw                        !! its number
        class(system_t), allocatable, intent(out) :: drawn
        type(error_t), allocatable, intent(out) :: error
        character(name_length), allocatable :: names(:)
        type(description_t) :: d
        integer :: i

        call samples%system%describe(d)
        allocate (names, source=value_names(d))
        allocate (drawn, source=samples%system)
        call drawn%configure([(samples%values(draw*states, samples%symbols%find(trim(names(i)))), &
                               i=1, size(names))], error)
    end subroutine configure_draw

    subroutine forces_at_rest(samples, force)
        !! \(\partial L/\partial q_j+Q_j\).
        type(samples_t), intent(in) :: samples    !! know L and the forces
        type(expression_t), intent(out) :: force(:)
        type(expression_t), allocatable :: formulas(:)
        integer :: j, which

        call energy_formulas(samples, formulas)
        do j = 1, samples%ndof
            force(j) = derivative(formulas(1), 1 + j)
            which = samples%symbols%find_definition("Q_"//trim(samples%symbols%names(1 + j)))
            if (which == 0) cycle
            associate (beside => samples%symbols%definitions(which)%meaning)
                force(j) = force(j) + in_coordinates(beside, samples)
            end associate
        end do
    end subroutine forces_at_rest

    subroutine keep(values, instead, samples)
        !! The linearised equations there, \(M=\partial^2L/\partial\dot q^2\),
        !! \(K_{ij}=-\partial F_i/\partial q_j\), \(B_{ij}=\partial^2L/\partial\dot q_i\partial q_j-
        !! \partial^2L/\partial q_i\partial\dot q_j-\partial Q_i/\partial\dot q_j\), F and Q the
        !! forces; and \(\omega^2\), of several coordinates where B is 0 or
        !! antisymmetric, and K symmetric.
        real(dp), intent(in) :: values(:, :)        !! states at rest there
        logical, intent(in) :: instead              !! of another one that is known
        type(samples_t), intent(inout) :: samples   !! get it as the other equilibrium
        type(expression_t), allocatable :: formulas(:)
        type(expression_t) :: force(samples%ndof), momentum
        real(dp), dimension(draws, samples%ndof, samples%ndof) :: m, b, k
        real(dp), allocatable :: omega2(:), modes(:, :)
        complex(dp), allocatable :: lambda(:), turned(:, :)
        real(dp) :: at(draws, size(values, 2))
        type(error_t), allocatable :: error
        integer :: draw, i, j, n

        n = samples%ndof
        if (other_is_known(samples) .and. .not. instead) return
        at = values(::states, :)
        if (all(abs(at(:, 2:n + 1) - transpose(samples%equilibrium)) <= &
                1e-12_dp*(1.0_dp + abs(at(:, 2:n + 1))))) return
        if (samples%lagrangian%count == 0) then
            call keep_without_formula(at(:, 2:n + 1), samples)
            return
        end if
        call energy_formulas(samples, formulas)
        call forces_at_rest(samples, force)
        do i = 1, n
            momentum = derivative(formulas(1), 1 + n + i)
            do j = 1, n
                m(:, i, j) = slope_of(momentum, 1 + n + j)
                k(:, i, j) = -slope_of(force(i), 1 + j)
                b(:, i, j) = slope_of(momentum, 1 + j) - slope_of(force(i), 1 + n + j)
            end do
        end do
        do draw = 1, draws
            samples%other_equilibrium(:, draw) = at(draw, 2:n + 1)
            samples%other_inertia(:, :, draw) = m(draw, :, :)
            samples%other_stiffness(:, :, draw) = k(draw, :, :)
            samples%other_turning(:, :, draw) = b(draw, :, :)
            samples%omega2(draw, n + 1:) = 0.0_dp
            if (n == 1) then
                samples%omega2(draw, 2) = k(draw, 1, 1)/m(draw, 1, 1)
                if (samples%decay > 0) samples%omega2(draw, 2) = samples%omega2(draw, 2) - &
                    (b(draw, 1, 1)/(2.0_dp*m(draw, 1, 1)))**2
            else if (all(is_zero(b(draw, :, :)))) then
                call normal_modes(k(draw, :, :), m(draw, :, :), omega2, modes, error)
                if (.not. allocated(error)) samples%omega2(draw, n + 1:) = omega2
            else
                call gyroscopic_modes(k(draw, :, :), b(draw, :, :), m(draw, :, :), lambda, turned, &
                                      error)
                if (allocated(error)) cycle  ! with drag
                if (all(is_zero(aimag(lambda**2)))) samples%omega2(draw, n + 1:) = -real(lambda**2)
            end if
        end do
    contains
        function slope_of(formula, symbol) result(slopes)
            !! Its derivative there.
            type(expression_t), intent(in) :: formula
            integer, intent(in) :: symbol
            real(dp) :: slopes(draws)

            slopes = values_of(derivative(formula, symbol), at)
        end function slope_of
    end subroutine keep

    subroutine keep_without_formula(places, samples)
        !! The same by the derivatives of L that the system computes.
        real(dp), intent(in) :: places(:, :)        !! equilibria, (draws, ndof)
        type(samples_t), intent(inout) :: samples   !! get it as the other equilibrium
        class(system_t), allocatable :: drawn
        type(error_t), allocatable :: error
        type(modes_t) :: modes
        integer :: draw

        do draw = 1, draws
            call configure_draw(samples, draw, drawn, error)
            if (allocated(error)) cycle
            call find_modes(drawn, (places(draw, :)), .true., modes, error)
            if (.not. allocated(error)) call put_other_modes(samples, drawn, draw, modes)
        end do
    end subroutine keep_without_formula
end module lagrangia_stated_equilibria
