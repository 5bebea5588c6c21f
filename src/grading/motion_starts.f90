module lagrangia_motion_starts
    !! `theta(0) = theta_0`, `theta_dot(0) = 0`: one motion of many, on which a sheet's statements
    !! may hold although they do not on others: \(E=-mgl\cos\theta_0\).
    use lagrangia_declared_constants, only: with_constants
    use lagrangia_description, only: description_t, value_names
    use lagrangia_errors, only: error_t
    use lagrangia_expression, only: expression_t, symbol
    use lagrangia_formula_characters, only: plain_letters
    use lagrangia_formula_parser, only: parse_formula
    use lagrangia_gauss_adaptive, only: gauss_adaptive_t, new_gauss16_adaptive
    use lagrangia_homework, only: homework_t
    use lagrangia_initial_conditions, only: with_short_starts
    use lagrangia_kinds, only: dp, i8
    use lagrangia_motion_samples, only: put_elsewhere, put_state
    use lagrangia_motion_values, only: values_of
    use lagrangia_names, only: name_length
    use lagrangia_number_class, only: all_finite
    use lagrangia_sample_names, only: role_known, role_parameter, samples_t, states
    use lagrangia_sampled_formula, only: evaluate_nodes
    use lagrangia_system, only: system_t
    use lagrangia_unknown_names, only: hidden
    use lagrangia_written_out, only: in_coordinates
    use lagrangia_zero_constants, only: begin_with_zeros
    implicit none (type, external)
    private
    public :: begin_there

    real(dp), parameter :: tolerance = 1e-13_dp  !! of the motions
    real(dp), parameter :: rounding = 1e-10_dp   !! of what they conserve, relative
    real(dp), parameter :: moved = 1e-3_dp       !! they must, by this, absolute or relative
    integer, parameter :: most_draws = 40        !! of a place where they may begin

contains

    subroutine begin_there(homework, system, zeros, samples, there, found, at_rest, &
                           all_velocities)
        !! States of motions that begin as the lines of a sheet say, at random times; names that
        !! these lines give initial values are those of parameters. What they do not give is at
        !! random, but for what is conserved and zero. None is known with constraints beside L; no
        !! impacts.
        type(homework_t), intent(in) :: homework   !! as read
        class(system_t), intent(in) :: system      !! configured
        type(expression_t), intent(in) :: zeros(:) !! conserved, in coordinates and velocities
        type(samples_t), intent(in) :: samples     !! any states, with the sheet's constants
        type(samples_t), intent(out) :: there      !! states of the motions
        logical, intent(out) :: found              !! there are such lines, and motions
        logical, intent(out) :: at_rest            !! on none of them anything moves
        logical, intent(out) :: all_velocities     !! are given
        type(expression_t) :: start(2*system%ndof)
        type(description_t) :: d
        class(system_t), allocatable :: drawn
        type(error_t), allocatable :: error
        character(name_length), allocatable :: names(:)
        real(dp) :: begun(size(samples%values, 1), 2*system%ndof)
        real(dp), allocatable :: row(:)
        integer, allocatable :: free(:), places(:)
        integer :: i, k, moving, n

        n = system%ndof
        found = .false.
        at_rest = .false.
        all_velocities = .false.
        moving = 0
        if (system%constraints > 0) return
        there = samples
        call read_starts(homework, there, start, found)
        all_velocities = all(start(n + 1:)%count > 0)
        if (.not. found .and. (size(zeros) == 0 .or. any(start%count > 0))) return
        call system%describe(d)
        names = value_names(d)
        places = [(samples%symbols%find(trim(names(i))), i=1, size(names))]
        call vary_constants()
        do i = 1, 2*n
            begun(:, i) = there%values(:, 1 + i)
            if (start(i)%count > 0) begun(:, i) = values_of(start(i), there%values)
        end do
        free = pack([(1 + i, i=n + 1, 2*n)], start(n + 1:)%count == 0)
        allocate (drawn, source=system)
        do k = 1, size(begun, 1)
            if (mod(k, states) == 1) call drawn%configure(samples%values(k, places), error)
            found = .not. allocated(error)
            if (.not. found) return
            row = there%values(k, :)
            call begin_at_zeros(k)
            if (.not. found) return
            there%values(k, :) = 0.0_dp
            call follow(k)
            if (.not. found) return
            do i = 1, size(row)
                if (is_kept(i)) there%values(k, i) = row(i)
            end do
        end do
        at_rest = moving == 0
        found = at_rest .or. moving == size(begun, 1)
        call put_zeros(there)
        call put_elsewhere(there, d)
    contains
        subroutine vary_constants()
            !! Each state is on a motion of its own, so that E is not the same for all.
            do i = 1, size(there%role)
                if (.not. any([(start(k)%count > 0 .and. start(k)%depends_on(i), k=1, 2*n)])) cycle
                if (any(places == i)) cycle
                do k = 1, size(begun, 1)
                    call there%random%uniform(0.3_dp, 3.0_dp, there%values(k, i))
                end do
            end do
        end subroutine vary_constants

        subroutine begin_at_zeros(k)
            !! Near the state that was drawn, or from other places: E = 0 is not possible anywhere.
            integer, intent(in) :: k
            integer :: c, draw

            do draw = 1, most_draws
                there%values(k, 2:1 + 2*n) = begun(k, :)
                call begin_with_zeros(zeros, free, there%values(k:k, :), found)
                if (found) exit
                do c = 1, n
                    if (start(c)%count == 0) call there%random%uniform(-3.0_dp, 3.0_dp, begun(k, c))
                end do
            end do
            begun(k, :) = there%values(k, 2:1 + 2*n)
        end subroutine begin_at_zeros

        subroutine follow(k)
            !! One motion, to a time of up to twice the typical one; not where only what is
            !! conserved is known.
            integer, intent(in) :: k
            type(gauss_adaptive_t) :: method
            real(dp), dimension(n) :: q, v
            real(dp) :: t

            call there%random%uniform(0.2_dp, 2.0_dp, t)
            t = t*d%typical_time
            q = begun(k, :n)
            v = begun(k, n + 1:)
            call new_gauss16_adaptive(method)
            method%tolerance = tolerance
            method%dense = .false.
            if (all(start%count == 0)) then
                moving = moving + 1
                call put_state(there, drawn, d, k, t, q, v, error)
                found = .not. allocated(error)
                return
            end if
            call method%prepare(drawn, error)
            if (.not. allocated(error)) then
                call method%start(drawn, 0.0_dp, q, v, t)
                call method%advance(drawn, 0.0_dp, t, 0_i8, 1_i8, q, v)
                found = all_finite([q, v])
                if (any(abs([q, v] - begun(k, :)) > moved*max(1.0_dp, abs(begun(k, :))))) then
                    moving = moving + 1
                end if
                if (found) call put_state(there, drawn, d, k, t, q, v, error)
            end if
            found = found .and. .not. allocated(error)
        end subroutine follow

        logical function is_kept(i)
            !! What is no function of the state: constants of the sheet and of the modes.
            integer, intent(in) :: i

            is_kept = any(samples%place == i) .or. any(samples%frequency + [0, 1] == i)
            if (samples%decay > 0) is_kept = is_kept .or. any(samples%decay + [0, 1] == i)
            is_kept = is_kept .or. (samples%role(i) == role_parameter .and. &
                                    .not. any(places == i) .and. .not. is_letter(i))
        end function is_kept

        logical function is_letter(i)
            !! Of the system's own, or the rate of one: `L_z`, `L_z_dot`.
            integer, intent(in) :: i

            is_letter = any(samples%compiled%symbol == i) .or. any(samples%rate == i)
        end function is_letter
    end subroutine begin_there

    subroutine put_zeros(samples)
        !! What is conserved and begins with 0 is 0, and not the rounding of its terms.
        type(samples_t), intent(inout) :: samples
        type(expression_t) :: formula
        real(dp), allocatable :: results(:, :), sizes(:, :)
        integer :: k, n

        do k = 1, size(samples%role)
            if (samples%role(k) /= role_known) cycle
            formula = in_coordinates(symbol(k), samples)
            n = formula%count
            if (n <= 1) cycle
            allocate (results(size(samples%values, 1), n), sizes(size(samples%values, 1), n))
            call evaluate_nodes(formula, samples%values, results, sizes=sizes)
            where (abs(results(:, n)) <= rounding*sizes(:, n)) samples%values(:, k) = 0.0_dp
            deallocate (results, sizes)
        end do
    end subroutine put_zeros

    subroutine read_starts(homework, samples, start, found)
        !! The right sides of all lines `q(0) = ...`, `q_dot(0) = ...`.
        type(homework_t), intent(in) :: homework      !! as read
        type(samples_t), intent(inout) :: samples     !! constants in them become parameters
        type(expression_t), intent(out) :: start(:)   !! q, q_dot; empty where no line has it
        logical, intent(out) :: found                 !! at least one, no two of the same one
        type(expression_t) :: right
        type(error_t), allocatable :: error
        character(:), allocatable :: side, text
        integer :: at, equals, i, k, place

        found = .false.
        do i = 1, size(homework%statements)
            if (homework%statements(i)%small) cycle
            text = with_short_starts(homework%statements(i)%text)
            equals = index(text, "=")
            if (equals < 2) cycle
            side = trim(adjustl(plain_letters(text(:equals - 1))))
            at = index(side, "(0)")
            if (at < 2 .or. at /= len(side) - 2) cycle
            place = samples%symbols%find(samples%symbols%spelling(side(:at - 1)))
            if (place < 2 .or. place > 1 + 2*samples%ndof) cycle
            call parse_formula(text(equals + 1:), with_constants(samples), right, error)
            if (allocated(error)) cycle
            if (any([(right%depends_on(k), k=1, 1 + 3*samples%ndof)])) cycle
            found = start(place - 1)%count == 0
            if (.not. found) return
            start(place - 1) = right
        end do
        do i = 1, size(samples%role)
            at = index(samples%symbols%names(i), hidden)
            if (at == 0) cycle
            if (.not. any([(start(k)%depends_on(i), k=1, size(start))])) cycle
            samples%symbols%names(i) = samples%symbols%names(i) (:at - 1)
        end do
    end subroutine read_starts
end module lagrangia_motion_starts
