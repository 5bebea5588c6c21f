module lagrangia_symbols
    !! The names that a formula may use, in an order, and names that stand for a formula.
    !!
    !! The values of the symbols travel as one array in this order: by convention the time first,
    !! then coordinates, velocities, accelerations where there are any, and parameters.
    use lagrangia_errors, only: error_t, fail
    use lagrangia_expression, only: expression_t, is_function_name
    use lagrangia_names, only: name_length
    use lagrangia_text, only: quoted, to_text
    implicit none (type, external)
    private
    public :: symbols_t, definition_t
    public :: check_name

    character(*), parameter :: letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
    character(*), parameter :: inside = letters//"_0123456789"

    type :: definition_t
        !! A name that stands for a formula, `D = theta1 - theta2`.
        character(name_length) :: name = ""
        type(expression_t) :: meaning
    end type definition_t

    type :: symbols_t
        !! Names of symbols and definitions; none at first.
        character(name_length), allocatable :: names(:)     !! of the symbols, in order
        type(definition_t), allocatable :: definitions(:)   !! may use symbols, and earlier ones
        integer, allocatable :: rates(:)
        !! place of each symbol's time derivative, 0: it is constant, or the time; -1: not known.
        !! Without these a formula has no d/dt
        logical :: primes = .false.  !! `x'` is `x_dot` where these have rates
        logical :: along_motion = .false.
        !! `d(x_dot)/dx` is \(\ddot x/\dot x\), and no partial derivative
    contains
        procedure :: add
        procedure :: define
        procedure :: forget
        procedure :: find
        procedure :: find_definition
        procedure :: spelling
        procedure :: all_names
    end type symbols_t

contains

    pure subroutine add(self, name, error)
        !! A symbol behind those that are there, without a rate. Without `error` the caller vouches
        !! for the name.
        class(symbols_t), intent(inout) :: self
        character(*), intent(in) :: name                            !! as in a formula
        type(error_t), allocatable, intent(out), optional :: error  !! no name, or one that is taken

        if (present(error)) then
            call check_name(name, error)
            if (.not. allocated(error)) call refuse_taken(self, name, error)
            if (allocated(error)) return
        end if
        if (.not. allocated(self%names)) allocate (self%names(0))
        self%names = [character(name_length) :: self%names, name]
        if (allocated(self%rates)) self%rates = [self%rates, 0]
    end subroutine add

    pure subroutine define(self, name, meaning, error)
        !! A name that stands for a formula.
        class(symbols_t), intent(inout) :: self
        character(*), intent(in) :: name                  !! as in a formula
        type(expression_t), intent(in) :: meaning         !! over these symbols
        type(error_t), allocatable, intent(out) :: error  !! no name, or one that is taken
        type(definition_t), allocatable :: more(:)
        integer :: i, n

        call check_name(name, error)
        if (.not. allocated(error)) call refuse_taken(self, name, error)
        if (allocated(error)) return
        n = 0
        if (allocated(self%definitions)) n = size(self%definitions)
        allocate (more(n + 1))
        do i = 1, n
            more(i)%name = self%definitions(i)%name
            more(i)%meaning = self%definitions(i)%meaning
        end do
        more(n + 1)%name = name
        more(n + 1)%meaning = meaning
        call move_alloc(more, self%definitions)
    end subroutine define

    pure subroutine forget(self, name)
        !! A definition with its rates, `D_dot` and `D_ddot`; nothing where there is none.
        class(symbols_t), intent(inout) :: self
        character(*), intent(in) :: name  !! as in a formula
        type(definition_t), allocatable :: kept(:)
        integer :: i, n

        if (.not. allocated(self%definitions)) return
        allocate (kept(size(self%definitions)))
        n = 0
        do i = 1, size(kept)
            if (any(self%definitions(i)%name == [character(name_length) :: name, name//"_dot", &
                                                 name//"_ddot"])) cycle
            n = n + 1
            kept(n)%name = self%definitions(i)%name
            kept(n)%meaning = self%definitions(i)%meaning
        end do
        self%definitions = kept(:n)
    end subroutine forget

    pure function find(self, name) result(which)
        !! The place of a symbol; 0 if there is none of this name.
        class(symbols_t), intent(in) :: self
        character(*), intent(in) :: name  !! as in a formula; the case counts
        integer :: which
        character(name_length) :: whole

        which = 0
        if (.not. allocated(self%names)) return
        if (len_trim(name) > name_length) return
        whole = name  ! texts of one length are compared at once
        do which = size(self%names), 1, -1
            if (self%names(which) == whole) return
        end do
    end function find

    pure function find_definition(self, name) result(which)
        !! The place of a definition; 0 if there is none of this name.
        class(symbols_t), intent(in) :: self
        character(*), intent(in) :: name  !! as in a formula; the case counts
        integer :: which

        which = 0
        if (.not. allocated(self%definitions)) return
        do which = size(self%definitions), 1, -1
            if (self%definitions(which)%name == name) return
        end do
    end function find_definition

    pure function spelling(self, name) result(known)
        !! `m1` for `m_1` and `omega_0` for `omega0`, where only the other one is a name here; else
        !! the name itself.
        class(symbols_t), intent(in) :: self
        character(*), intent(in) :: name  !! as typed
        character(:), allocatable :: known
        integer :: i

        known = name
        if (self%find(name) > 0 .or. self%find_definition(name) > 0) return
        i = scan(name, "0123456789")
        if (i < 2) return
        if (name(i - 1:i - 1) == "_") then
            known = name(:i - 2)//name(i:)
        else
            known = name(:i - 1)//"_"//name(i:)
        end if
        if (self%find(known) == 0 .and. self%find_definition(known) == 0) known = name
    end function spelling

    pure subroutine all_names(self, names)
        !! Symbols, definitions and `pi`, without symbols such as `omega^2` that nobody can type.
        class(symbols_t), intent(in) :: self
        character(name_length), allocatable, intent(out) :: names(:)  !! in this order
        integer :: i, n

        n = 0
        if (allocated(self%names)) n = size(self%names)
        i = 0
        if (allocated(self%definitions)) i = size(self%definitions)
        allocate (names(n + i + 1))
        if (n > 0) names(:n) = self%names
        do i = 1, i
            names(n + i) = self%definitions(i)%name
        end do
        names(size(names)) = "pi"
        names = pack(names, scan(names, "^/") == 0)
    end subroutine all_names

    pure subroutine refuse_taken(self, name, error)
        !! If there is a symbol or a definition of this name.
        class(symbols_t), intent(in) :: self
        character(*), intent(in) :: name
        type(error_t), allocatable, intent(out) :: error

        if (self%find(name) == 1 .and. name == "t") then
            call fail(error, "'t' is the time; take another name")
        else if (self%find(name) > 0 .or. self%find_definition(name) > 0) then
            call fail(error, "the name "//quoted(name)//" is given twice; take another one")
        end if
    end subroutine refuse_taken

    pure subroutine check_name(name, error)
        !! Can a formula use this name? Letters, digits and underscores, a letter first, and neither
        !! `pi` nor a function.
        character(*), intent(in) :: name                  !! any text
        type(error_t), allocatable, intent(out) :: error  !! says why not

        if (name == "") then
            call fail(error, "a name is empty; write one like theta1")
        else if (scan(name(1:1), letters) == 0 .or. verify(trim(name), inside) > 0) then
            call fail(error, quoted(name)//" is no name for a formula; write letters, digits "// &
                      "and underscores, a letter first, as in theta1")
        else if (len_trim(name) > name_length) then
            call fail(error, "the name "//quoted(name)//" is longer than "// &
                      to_text(name_length)//" characters; shorten it")
        else if (name == "pi") then
            call fail(error, "'pi' is the number 3.14159...; take another name")
        else if (is_function_name(name)) then
            call fail(error, quoted(name)//" is a function; take another name")
        end if
    end subroutine check_name
end module lagrangia_symbols
