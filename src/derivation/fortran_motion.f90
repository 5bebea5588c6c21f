module lagrangia_fortran_motion
    !! Lagrange's equations as statements of Fortran: the mass matrix, the right side, and Gauss's
    !! elimination, which skips what is zero by its form.
    use lagrangia_canonical_form, only: simplified
    use lagrangia_expression, only: expression_t
    use lagrangia_formula_fortran, only: fortran_text
    use lagrangia_symbols, only: symbols_t
    use lagrangia_text, only: append_word, to_text, word_t
    use lagrangia_written_motion, only: written_motion_t
    implicit none (type, external)
    private
    public :: motion_statements_t
    public :: find_motion

    type :: motion_statements_t
        !! `sineI` and `cosineI` of each angle come first, then these statements; they give `a1`,
        !! `a2`, ...
        type(word_t), allocatable :: angles(:)
        type(word_t), allocatable :: list(:)
        logical, allocatable :: mass(:, :)       !! is there this element of M, \(i \le j\)?
    contains
        procedure :: locals
        procedure :: mentions
        procedure, private :: add
    end type motion_statements_t

contains

    subroutine find_motion(motion, symbols, names, body)
        !! \(M\ddot q = f\) for M symmetric, its upper half `mass1_2`, f `force1`.
        type(written_motion_t), intent(in) :: motion      !! derived from L
        type(symbols_t), intent(in) :: symbols            !! t, q, q_dot, parameters
        type(word_t), intent(in) :: names(:)              !! of these in Fortran
        type(motion_statements_t), intent(out) :: body    !! of n coordinates
        character(:), allocatable :: text
        integer :: i, j, k, n

        n = size(motion%right)
        allocate (body%angles(0), body%list(0), body%mass(n, n))
        do i = 1, n
            do j = i, n
                body%mass(i, j) = .not. motion%mass(i, j)%is_zero()
                if (body%mass(i, j)) call state(motion%mass(i, j), mass(i, j))
            end do
            call state(motion%right(i), "force"//to_text(i))
        end do
        do i = 1, n
            do j = i + 1, n
                if (.not. body%mass(i, j)) cycle
                call body%add("factor = "//mass(i, j)//"/"//mass(i, i))
                call body%add(less_product("force"//to_text(j), "force"//to_text(i), .true.))
                do k = j, n
                    if (.not. body%mass(i, k)) cycle
                    call body%add(less_product(mass(j, k), mass(i, k), body%mass(j, k)))
                    body%mass(j, k) = .true.
                end do
            end do
        end do
        do i = n, 1, -1
            text = "force"//to_text(i)
            do j = i + 1, n
                if (body%mass(i, j)) text = text//" - "//mass(i, j)//"*a"//to_text(j)
            end do
            if (index(text, " ") > 0) text = "("//text//")"
            call body%add("a"//to_text(i)//" = "//text//"/"//mass(i, i))
        end do
    contains
        subroutine state(expression, name)
            !! A formula, in its canonical form where that is shorter.
            type(expression_t), intent(in) :: expression
            character(*), intent(in) :: name
            type(expression_t) :: short
            character(:), allocatable :: formula

            short = simplified(expression, symbols)
            if (short%count <= expression%count) then
                call fortran_text(short, names, formula, body%angles)
            else
                call fortran_text(expression, names, formula, body%angles)
            end if
            call body%add(name//" = "//formula)
        end subroutine state
    end subroutine find_motion

    pure function mass(i, j) result(name)
        !! Of an element of M.
        integer, intent(in) :: i, j
        character(:), allocatable :: name

        name = "mass"//to_text(i)//"_"//to_text(j)
    end function mass

    pure function less_product(name, other, is_there) result(statement)
        !! `name` less `factor` times another, from zero if it is not there yet.
        character(*), intent(in) :: name, other
        logical, intent(in) :: is_there
        character(:), allocatable :: statement

        statement = name//" = -factor*"//other
        if (is_there) statement = name//" = "//name//" - factor*"//other
    end function less_product

    pure subroutine add(self, statement)
        !! A statement at the end.
        class(motion_statements_t), intent(inout) :: self
        character(*), intent(in) :: statement

        call append_word(self%list, statement)
    end subroutine add

    pure function mentions(self, name) result(yes)
        !! Is a sine or cosine in one of the statements, or in another angle?
        class(motion_statements_t), intent(in) :: self
        character(*), intent(in) :: name  !! such as `sine1`, which is not in `cosine1` or `sine12`
        logical :: yes
        integer :: i

        yes = .false.
        do i = 1, size(self%list)
            yes = yes .or. has_name(self%list(i)%text, name)
        end do
        do i = 1, size(self%angles)
            yes = yes .or. has_name(self%angles(i)%text, name)
        end do
    end function mentions

    pure function has_name(text, name) result(yes)
        !! With neither letter nor digit beside it.
        character(*), intent(in) :: text, name
        logical :: yes
        character(*), parameter :: inside = "abcdefghijklmnopqrstuvwxyz_0123456789"
        character(:), allocatable :: padded
        integer :: at, first

        padded = " "//text//" "
        yes = .false.
        first = 2
        do
            at = index(padded(first:), name)
            if (at == 0) return
            first = first + at - 1
            yes = scan(padded(first - 1:first - 1), inside) == 0 .and. &
                  scan(padded(first + len(name):first + len(name)), inside) == 0
            if (yes) return
            first = first + len(name)
        end do
    end function has_name

    pure function locals(self, lanes) result(text)
        !! The names that the statements need, `a1, force1, mass1_1, sine1`.
        class(motion_statements_t), intent(in) :: self
        logical, intent(in) :: lanes  !! with those of the angles
        character(:), allocatable :: text
        integer :: i, j, n

        n = size(self%mass, 1)
        text = ""
        do i = 1, n
            text = text//", a"//to_text(i)//", force"//to_text(i)
            do j = i, n
                if (self%mass(i, j)) text = text//", "//mass(i, j)
            end do
        end do
        do i = 1, size(self%angles)
            if (lanes) text = text//", angle"//to_text(i)
            if (lanes .or. self%mentions("sine"//to_text(i))) text = text//", sine"//to_text(i)
            if (lanes .or. self%mentions("cosine"//to_text(i))) text = text//", cosine"//to_text(i)
        end do
        if (size(self%list) > 3*n) text = text//", factor"  ! something was eliminated
        text = text(3:)
    end function locals
end module lagrangia_fortran_motion
