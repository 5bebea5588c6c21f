module lagrangia_statements
    !! Formulas in the letters of a system, read from text and evaluated at states. Where they are
    !! described, T and V are letters too.
    !!
    !! Call `begin`, then `add_formula` or `add_equation` for each, then `finish`; then `evaluate`.
    use lagrangia_description, only: description_t
    use lagrangia_errors, only: error_t
    use lagrangia_expression, only: expression_t, whole
    use lagrangia_formula_parser, only: parse_equation, parse_formula
    use lagrangia_formula_program, only: formula_program_t, new_formula_program
    use lagrangia_hyperdual, only: hyperdual_t
    use lagrangia_kinds, only: dp
    use lagrangia_named_values, only: motion_state_t, name_values, named_values_t
    use lagrangia_random_draws, only: random_t
    use lagrangia_symbols, only: check_name, symbols_t
    use lagrangia_system, only: system_t
    use lagrangia_term_sizes, only: make_smaller
    implicit none (type, external)
    private
    public :: statements_t

    type :: letter_program_t
        !! A letter of the description, and where it and its rates stand among the symbols.
        type(formula_program_t) :: program
        integer :: symbol = 0, dot = 0, ddot = 0  !! 0: the name is another's
    end type letter_program_t

    type :: statements_t
        !! Two sides a statement; a formula alone is its left side, the right one is zero.
        private
        type(symbols_t) :: symbols
        integer, allocatable :: symbol_of(:)              !! of each entry of the table; 0: taken
        type(letter_program_t), allocatable :: letters(:)
        type(expression_t), allocatable :: sides(:)       !! (2 count), and room
        integer, public :: count = 0
        type(formula_program_t) :: program                !! of all sides
    contains
        procedure :: begin
        procedure :: add_formula
        procedure :: add_equation
        procedure :: finish
        procedure :: evaluate
        procedure :: evaluate_rates
        procedure, private :: symbol_values
        procedure, private :: more_room
    end type statements_t

contains

    subroutine begin(self, system, d, state, error)
        !! Learn the names.
        class(statements_t), intent(inout) :: self        !! without statements on return
        class(system_t), intent(in) :: system             !! with its parameters
        type(description_t), intent(in) :: d              !! whose letters count
        type(motion_state_t), intent(in) :: state         !! any state of the system
        type(error_t), allocatable, intent(out) :: error  !! a letter that cannot be read
        type(named_values_t) :: table
        integer :: i, n

        call name_values(system, d, state, table)
        self%count = 0
        self%symbols = symbols_t()
        if (allocated(self%symbol_of)) deallocate (self%symbol_of)
        if (allocated(self%letters)) deallocate (self%letters)
        allocate (self%symbol_of(table%count))
        do i = 1, table%count
            self%symbol_of(i) = new_symbol(trim(table%names(i)))
        end do
        n = 0
        if (allocated(d%letters)) n = size(d%letters)
        allocate (self%letters(n + count([allocated(d%kinetic_energy), &
                                          allocated(d%potential_energy)])))
        do i = 1, n
            call read_letter(self%letters(i), trim(d%letters(i)%name), trim(d%letters(i)%formula))
            if (allocated(error)) return
        end do
        n = n + 1
        if (allocated(d%kinetic_energy)) call read_letter(self%letters(n), "T", d%kinetic_energy)
        if (allocated(error)) return
        n = size(self%letters)
        if (allocated(d%potential_energy)) call read_letter(self%letters(n), "V", &
                                                            d%potential_energy)
    contains
        subroutine read_letter(letter, name, formula)
            !! A name for a formula of those before it.
            type(letter_program_t), intent(inout) :: letter
            character(*), intent(in) :: name, formula
            type(expression_t) :: one(1)

            call check_name(name, error)
            if (allocated(error)) return
            call parse_formula(formula, self%symbols, one(1), error)
            if (.not. allocated(error)) then
                call new_formula_program(letter%program, one, size(self%symbols%names))
                call self%symbols%add(name, error)
                letter%symbol = self%symbols%find(name)
            end if
            if (allocated(error)) then
                call error%add_context(name)
                return
            end if
            letter%dot = new_symbol(name//"_dot")
            letter%ddot = new_symbol(name//"_ddot")
        end subroutine read_letter

        integer function new_symbol(name)
            !! Its place among the symbols; 0 if there is one of this name.
            character(*), intent(in) :: name
            type(error_t), allocatable :: taken

            call self%symbols%add(name, taken)
            new_symbol = 0
            if (.not. allocated(taken)) new_symbol = size(self%symbols%names)
        end function new_symbol
    end subroutine begin

    subroutine add_formula(self, text, error)
        !! One more statement, of one side.
        class(statements_t), intent(inout) :: self
        character(*), intent(in) :: text                  !! a formula
        type(error_t), allocatable, intent(out) :: error  !! it cannot be read: why, and where

        call self%more_room()
        call parse_formula(text, self%symbols, self%sides(2*self%count + 1), error)
        if (allocated(error)) return
        self%sides(2*self%count + 2) = whole(0)
        self%count = self%count + 1
    end subroutine add_formula

    subroutine add_equation(self, text, error)
        !! One more statement; `>=` makes an inequality, whose sides count alike.
        class(statements_t), intent(inout) :: self
        character(*), intent(in) :: text                  !! `left = right`
        type(error_t), allocatable, intent(out) :: error  !! it cannot be read: why, and where
        character(:), allocatable :: equation
        integer :: at

        call self%more_room()
        equation = text
        at = index(text, ">=")
        if (at > 0) equation(at:at) = " "
        call parse_equation(equation, self%symbols, self%sides(2*self%count + 1), &
                            self%sides(2*self%count + 2), error)
        if (.not. allocated(error)) self%count = self%count + 1
    end subroutine add_equation

    pure subroutine more_room(self)
        !! For one statement more.
        class(statements_t), intent(inout) :: self
        type(expression_t), allocatable :: sides(:)
        integer :: i

        if (.not. allocated(self%sides)) allocate (self%sides(32))
        if (2*self%count + 2 <= size(self%sides)) return
        allocate (sides(2*size(self%sides)))
        do i = 1, 2*self%count
            sides(i) = self%sides(i)
        end do
        call move_alloc(sides, self%sides)
    end subroutine more_room

    pure subroutine finish(self)
        !! No more statements come.
        class(statements_t), intent(inout) :: self

        call self%more_room()
        call new_formula_program(self%program, self%sides(:2*self%count), size(self%symbols%names))
    end subroutine finish

    subroutine evaluate(self, system, d, state, left, right, random)
        !! Both sides of all statements.
        class(statements_t), intent(in) :: self         !! finished
        class(system_t), intent(in) :: system           !! with its parameters, perhaps others
        type(description_t), intent(in) :: d            !! the system's own
        type(motion_state_t), intent(in) :: state       !! where
        real(dp), intent(out) :: left(:), right(:)      !! (count)
        type(random_t), intent(inout), optional :: random
        !! makes every value that has a name smaller by some last digits: they are rounded too
        type(hyperdual_t) :: values(size(self%symbols%names))
        real(dp) :: numbers(size(self%symbols%names)), sides(2*self%count)

        call self%symbol_values(system, d, state, values)
        numbers = values%re
        if (present(random)) call make_smaller(random, numbers)
        call self%program%evaluate(numbers, sides)
        left = sides(1::2)
        right = sides(2::2)
    end subroutine evaluate

    pure subroutine evaluate_rates(self, system, d, state, left, right)
        !! Both sides of all statements with their time derivatives along the motion.
        class(statements_t), intent(in) :: self                !! finished
        class(system_t), intent(in) :: system                  !! with its parameters
        type(description_t), intent(in) :: d                   !! the system's own
        type(motion_state_t), intent(in) :: state              !! where
        type(hyperdual_t), intent(out) :: left(:), right(:)    !! (count)
        type(hyperdual_t) :: values(size(self%symbols%names)), sides(2*self%count)

        call self%symbol_values(system, d, state, values)
        call self%program%evaluate(values, sides)
        left = sides(1::2)
        right = sides(2::2)
    end subroutine evaluate_rates

    pure subroutine symbol_values(self, system, d, state, values)
        !! The table's, then letter by letter.
        class(statements_t), intent(in) :: self
        class(system_t), intent(in) :: system
        type(description_t), intent(in) :: d
        type(motion_state_t), intent(in) :: state
        type(hyperdual_t), intent(out) :: values(:)
        type(named_values_t) :: table
        type(hyperdual_t) :: letter(1)
        integer :: i

        call name_values(system, d, state, table)
        do i = 1, size(self%symbol_of)
            if (self%symbol_of(i) > 0) values(self%symbol_of(i)) = table%values(i)
        end do
        do i = 1, size(self%letters)
            associate (it => self%letters(i))
                call it%program%evaluate(values(:it%program%inputs), letter)
                values(it%symbol) = letter(1)
                associate (x => letter(1))
                    if (it%dot > 0) values(it%dot) = hyperdual_t(x%d1, x%d12, x%d12, 0.0_dp)
                    if (it%ddot > 0) values(it%ddot) = hyperdual_t(re=x%d12)
                end associate
            end associate
        end do
    end subroutine symbol_values
end module lagrangia_statements
