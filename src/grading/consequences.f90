module lagrangia_consequences
    !! A false statement that follows from lines before it that are wrong: a student makes a mistake
    !! once, and goes on from it as one should.
    use lagrangia_derivative, only: time_derivative
    use lagrangia_expression, only: expression_t, kind_symbol, operator(-), symbol
    use lagrangia_formula_program, only: new_formula_program
    use lagrangia_homework, only: statement_t
    use lagrangia_judgement, only: is_right, judge, judgement_t
    use lagrangia_kinds, only: dp
    use lagrangia_number_class, only: all_finite, is_zero
    use lagrangia_sample_names, only: draws, role_acceleration, role_frequency, role_known, &
                                      samples_t, states
    use lagrangia_sampled_formula, only: evaluate_nodes
    use lagrangia_supposed_lagrangian, only: suppose_lagrangian
    use lagrangia_supposed_statement, only: no_equation, no_momentum, no_rate, no_value, &
                                            suppose, suppose_frequency, supposition_t
    use lagrangia_symbols, only: symbols_t
    use lagrangia_term_search, only: library_t
    implicit none (type, external)
    private
    public :: consequences_t

    integer, parameter :: most_worlds = 200    !! of one sheet
    integer, parameter :: most_mistakes = 2    !! that one line may follow from
    real(dp), parameter :: equal = 1e-9_dp     !! relative difference of factors that are one

    type :: world_t
        !! The values, as they would be if wrong statements were true.
        integer, allocatable :: because(:)                      !! these statements
        type(samples_t) :: base                                 !! with another L, if it has one
        type(supposition_t), allocatable :: suppositions(:)     !! and these
        type(samples_t) :: samples                              !! with all of them
    end type world_t

    type :: consequences_t
        !! Of all wrong statements so far.
        integer :: count = 0
        type(world_t), allocatable :: worlds(:)            !! the first `count` are there
        integer :: mistakes = 0
        type(supposition_t), allocatable :: mistake(:)     !! as many; `which` is the statement
    contains
        procedure :: add_consequence
        procedure :: add_mistake
        procedure :: add_names
        procedure :: find
        procedure, private :: suppose_everywhere
        procedure, private :: try_world
    end type consequences_t

contains

    subroutine add_names(self, symbols)
        !! Names that the student has defined since.
        class(consequences_t), intent(inout) :: self
        type(symbols_t), intent(in) :: symbols        !! all of them
        integer :: i

        do i = 1, self%count
            self%worlds(i)%samples%symbols = symbols
            self%worlds(i)%base%symbols = symbols
        end do
    end subroutine add_names

    subroutine find(self, statement, residual, truth, because)
        !! The wrong statements from which this one follows; the fewest, and the nearest ones.
        class(consequences_t), intent(inout) :: self
        type(statement_t), intent(in) :: statement            !! false
        type(expression_t), intent(in) :: residual            !! its left less right side
        type(samples_t), intent(in) :: truth                  !! the true motion
        integer, allocatable, intent(out) :: because(:)       !! their numbers, or none
        type(judgement_t) :: judgement
        type(library_t) :: none(0)
        integer :: i, mistakes

        do i = self%mistakes, 1, -1
            if (.not. is_multiple(residual, self%mistake(i)%residual, truth)) cycle
            because = [self%mistake(i)%which]
            return
        end do
        do mistakes = 1, most_mistakes
            do i = self%count, 1, -1
                if (size(self%worlds(i)%because) /= mistakes) cycle
                call judge(statement, self%worlds(i)%samples, none, .false., judgement)
                if (judgement%verdict /= is_right) cycle
                allocate (because, source=self%worlds(i)%because)
                return
            end do
        end do
        allocate (because(0))
    end subroutine find

    function is_multiple(one, other, samples) result(yes)
        !! The same residual, but for a constant factor, whatever the motion is.
        type(expression_t), intent(in) :: one, other
        type(samples_t), intent(in) :: samples
        logical :: yes
        real(dp), allocatable :: a(:, :), b(:, :), ratio(:)
        integer :: n

        n = size(samples%values, 1)
        allocate (a(n, one%count), b(n, other%count))
        call evaluate_nodes(one, samples%elsewhere, a)
        call evaluate_nodes(other, samples%elsewhere, b)
        ratio = a(:, one%count)/b(:, other%count)
        yes = all_finite(ratio)
        if (yes) yes = maxval(ratio) - minval(ratio) <= equal*maxval(abs(ratio))
    end function is_multiple

    subroutine add_mistake(self, number, residual, truth)
        !! A wrong statement, which does not follow from others: what would be if it were true.
        class(consequences_t), intent(inout) :: self
        integer, intent(in) :: number                !! of the statement
        type(expression_t), intent(in) :: residual   !! left less right side
        type(samples_t), intent(in) :: truth         !! the true motion
        type(expression_t) :: rate, right
        type(supposition_t) :: one(1), two(2)  ! gfortran 12 does not free what a constructor makes
        logical :: said(truth%ndof)
        integer :: i, k, left, n

        if (.not. allocated(self%worlds)) allocate (self%worlds(most_worlds), &
                                                    self%mistake(most_worlds))
        if (self%mistakes < most_worlds) then
            self%mistakes = self%mistakes + 1
            self%mistake(self%mistakes) = supposition_t(residual, 0, number)
        end if
        if (residual%depends_on(truth%frequency) .or. residual%depends_on(truth%frequency + 1)) then
            call add_frequency(self, number, residual, truth)
            return
        end if
        if (.not. allocated(truth%mass)) return
        left = residual%nodes(residual%count)%left
        right = residual%pruned(residual%nodes(residual%count)%right)
        k = 0
        if (residual%nodes(left)%kind == kind_symbol) k = residual%nodes(left)%which
        if (k > 0) then
            if (any(trim(truth%symbols%names(k)) == ["L", "T", "V"]) .and. &
                without_known(right, truth, .true.)) then
                n = self%count
                do i = 0, n
                    call suppose_another_lagrangian(self, i, number, k, right, truth)
                end do
                return
            end if
            do i = 1, truth%ndof
                if (.not. any(k == [place("p_", ""), place("dL_d", "_dot")])) cycle
                if (.not. without_known(right, truth, .false.)) cycle
                two(1) = supposition_t(residual, no_momentum, i)
                rate = symbol(place("d_dt_dL_d", "_dot")) - time_derivative(right, truth%rate, 1)
                two(2) = supposition_t(rate, no_rate, i)
                call self%suppose_everywhere(number, two, truth)
                return
            end do
        end if
        said = equations_said(residual, truth)
        do i = 1, truth%ndof
            do k = no_equation, no_momentum
                if (k /= no_momentum .and. .not. said(i)) cycle
                one(1) = supposition_t(residual, k, i)
                call self%suppose_everywhere(number, one, truth)
            end do
        end do
        do k = 1, size(truth%role)
            if (truth%role(k) /= role_known .or. .not. residual%depends_on(k)) cycle
            one(1) = supposition_t(residual, no_value, k)
            call self%suppose_everywhere(number, one, truth)
        end do
    contains
        integer function place(before, after)
            character(*), intent(in) :: before, after

            place = truth%symbols%find(before//trim(truth%symbols%names(1 + i))//after)
        end function place
    end subroutine add_mistake

    subroutine add_consequence(self, because, residual, truth)
        !! A statement that follows from wrong ones: as an equation of motion it goes on.
        class(consequences_t), intent(inout) :: self
        integer, intent(in) :: because(:)            !! these statements
        type(expression_t), intent(in) :: residual   !! left less right side
        type(samples_t), intent(in) :: truth         !! the true motion
        type(supposition_t) :: one(1)
        logical :: moves, said(truth%ndof)
        integer :: i

        if (.not. allocated(truth%mass)) return
        moves = any([(residual%depends_on(truth%first_acceleration + i - 1), i=1, truth%ndof)])
        if (.not. moves) return
        said = equations_said(residual, truth)
        do i = 1, truth%ndof
            if (.not. said(i)) cycle
            one(1) = supposition_t(residual, no_equation, i)
            call self%try_world(because, truth, one)
        end do
    end subroutine add_consequence

    function equations_said(residual, truth) result(said)
        !! The equations of motion that a wrong line may say: those of the most accelerations with
        !! the true factor, but for one that no state changes, or even for a number. Beside the true
        !! one of the same coordinate it would be a contradiction, from which anything follows.
        type(expression_t), intent(in) :: residual   !! left less right side
        type(samples_t), intent(in) :: truth         !! with the mass matrix
        logical :: said(truth%ndof)
        real(dp), dimension(size(truth%values, 1), residual%count) :: here, moved
        real(dp) :: values(size(truth%values, 1), size(truth%values, 2))
        real(dp) :: ratio(states, draws)
        integer :: like(truth%ndof), i, j, k, n

        n = residual%count
        like = 0
        call evaluate_nodes(residual, truth%values, here)
        do k = 1, truth%ndof
            values = truth%values
            associate (a => values(:, truth%first_acceleration + k - 1))
                a = a + 1.0_dp
            end associate
            call evaluate_nodes(residual, values, moved)
            do i = 1, truth%ndof
                ratio = reshape((moved(:, n) - here(:, n))/truth%mass(i, k, :), [states, draws])
                if (.not. all_finite(ratio) .or. all(is_zero(ratio))) cycle
                if (.not. all([(is_one(ratio(:, j)), j=1, draws)])) cycle
                like(i) = like(i) + truth%ndof + 1
                if (is_one(reshape(ratio, [states*draws]))) like(i) = like(i) + 1
            end do
        end do
        said = like == maxval(like)
    contains
        pure logical function is_one(numbers)
            real(dp), intent(in) :: numbers(:)

            is_one = maxval(numbers) - minval(numbers) <= equal*maxval(abs(numbers))
        end function is_one
    end function equations_said

    subroutine suppose_everywhere(self, number, suppositions, truth)
        !! Beside the truth, and beside each mistake so far.
        class(consequences_t), intent(inout) :: self
        integer, intent(in) :: number
        type(supposition_t), intent(in) :: suppositions(:)
        type(samples_t), intent(in) :: truth
        integer :: i, n

        n = self%count
        call self%try_world([number], truth, suppositions)
        do i = 1, n
            if (any(self%worlds(i)%because == number)) cycle
            if (size(self%worlds(i)%because) == most_mistakes) cycle
            call self%try_world([self%worlds(i)%because, number], self%worlds(i)%base, &
                                [self%worlds(i)%suppositions, suppositions])
        end do
    end subroutine suppose_everywhere

    subroutine try_world(self, because, base, suppositions)
        !! One more, if these suppositions determine it.
        class(consequences_t), intent(inout) :: self
        integer, intent(in) :: because(:)
        type(samples_t), intent(in) :: base
        type(supposition_t), intent(in) :: suppositions(:)
        type(samples_t) :: samples
        logical :: possible

        if (self%count == most_worlds) return
        samples = base
        call suppose(samples, suppositions, possible)
        if (.not. possible) return
        call add_world(self, because, base, samples)
        self%worlds(self%count)%suppositions = suppositions
    end subroutine try_world

    subroutine add_world(self, because, base, samples)
        !! There is room for one more; it supposes nothing beside its base.
        class(consequences_t), intent(inout) :: self
        integer, intent(in) :: because(:)
        type(samples_t), intent(in) :: base, samples

        self%count = self%count + 1
        associate (world => self%worlds(self%count))
            world%because = because
            world%base = base
            allocate (world%suppositions(0))
            world%samples = samples
        end associate
    end subroutine add_world

    subroutine add_frequency(self, number, residual, truth)
        !! Omega is what a wrong line says.
        type(consequences_t), intent(inout) :: self
        integer, intent(in) :: number
        type(expression_t), intent(in) :: residual
        type(samples_t), intent(in) :: truth
        type(samples_t) :: samples
        logical :: possible

        if (self%count == most_worlds) return
        samples = truth
        call suppose_frequency(samples, residual, possible)
        if (.not. possible) return
        call add_world(self, [number], samples, samples)
    end subroutine add_frequency

    subroutine suppose_another_lagrangian(self, beside, number, name, formula, truth)
        !! L, or T or V of which it consists, is this formula; `beside` 0: of the truth, or another
        !! world in which only L is another one.
        type(consequences_t), intent(inout) :: self
        integer, intent(in) :: beside, number
        integer, intent(in) :: name                  !! place of L, T or V
        type(expression_t), intent(in) :: formula
        type(samples_t), intent(in) :: truth
        type(samples_t) :: samples
        type(expression_t) :: lagrangian
        integer, allocatable :: because(:)
        logical :: possible
        integer :: i, t, v

        if (self%count == most_worlds) return
        if (beside == 0) then
            samples = truth
            because = [number]
        else
            associate (world => self%worlds(beside))
                if (size(world%suppositions) > 0 .or. size(world%because) == most_mistakes) return
                samples = world%base
                because = [world%because, number]
            end associate
        end if
        lagrangian = formula
        if (samples%symbols%names(name) /= "L") then
            t = samples%symbols%find("T")
            v = samples%symbols%find("V")
            do i = 1, size(samples%compiled)
                if (samples%compiled(i)%symbol /= name) cycle
                samples%compiled(i)%formula = formula
                call new_formula_program(samples%compiled(i)%program, [formula], size(samples%role))
            end do
            lagrangian = symbol(t) - symbol(v)
        end if
        call suppose_lagrangian(samples, lagrangian, possible)
        if (.not. possible) return
        call add_world(self, because, samples, samples)
    end subroutine suppose_another_lagrangian

    pure function without_known(expression, samples, but_energies) result(yes)
        !! A formula of time, coordinates, velocities and letters; T and V count as letters if
        !! `but_energies`.
        type(expression_t), intent(in) :: expression
        type(samples_t), intent(in) :: samples
        logical, intent(in) :: but_energies
        logical :: yes
        integer :: k

        yes = .true.
        do k = 1, size(samples%role)
            if (.not. expression%depends_on(k)) cycle
            select case (samples%role(k))
            case (role_acceleration, role_frequency)
                yes = .false.
            case (role_known)
                yes = yes .and. but_energies .and. any(samples%compiled%symbol == k)
            case default
                cycle
            end select
        end do
    end function without_known
end module lagrangia_consequences
