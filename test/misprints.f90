module misprints
    !! Systems of which one printed formula has a slip: a sign, a factor or an exchanged letter.
    use lagrangia_description, only: description_t, value_names
    use lagrangia_hyperdual, only: hyperdual_t
    use lagrangia_kinds, only: dp
    use lagrangia_linearised, only: linearised_t
    use lagrangia_system, only: system_t
    use lagrangia_wrapped_system, only: wrapped_system_t
    implicit none (type, external)
    private
    public :: misprint_t, new_misprint
    public :: change_formula, formula_at, kinds_of_slips, last_place

    integer, parameter :: kinds_of_slips = 4
    integer, parameter :: most = 100  !! formulas of one kind

    type, extends(wrapped_system_t) :: misprint_t
        !! Another system, with a slip in its description.
        integer :: place = 0                !! of the formula
        integer :: slip = 0                 !! which kind; 0: none
        character(120) :: instead = ""      !! what stands there instead
    contains
        procedure :: describe
        procedure :: quantity
        procedure :: positions
        procedure :: angles
        procedure :: newton
        procedure :: linearise
        procedure :: gap
    end type misprint_t

contains

    subroutine new_misprint(system, place, slip, misprint)
        !! `system` with that slip at that place.
        class(system_t), intent(in) :: system
        integer, intent(in) :: place, slip
        type(misprint_t), intent(out) :: misprint

        call misprint%wrap(system)
        misprint%place = place
        misprint%slip = slip
    end subroutine new_misprint

    pure integer function last_place()
        !! The number of places where a formula may stand.
        last_place = 4 + 9*most + 1
    end function last_place

    pure function formula_at(d, place) result(text)
        !! The formula there; "" if there is none.
        type(description_t), intent(in) :: d
        integer, intent(in) :: place
        character(:), allocatable :: text
        type(description_t) :: copy

        copy = d
        call exchange(copy, place, text, "")
    end function formula_at

    pure subroutine exchange(d, place, before, after)
        !! Read the formula at a place, and put another one there if that is not "".
        type(description_t), intent(inout) :: d
        integer, intent(in) :: place
        character(:), allocatable, intent(out) :: before
        character(*), intent(in) :: after
        integer :: i

        before = ""
        i = mod(place - 5, most) + 1
        select case (place)
        case (1)
            if (allocated(d%kinetic_energy)) before = d%kinetic_energy
            if (after /= "") d%kinetic_energy = after
        case (2)
            if (allocated(d%potential_energy)) before = d%potential_energy
            if (after /= "") d%potential_energy = after
        case (3)
            if (allocated(d%lagrangian)) before = d%lagrangian
            if (after /= "") d%lagrangian = after
        case (4)
            if (allocated(d%energy)) before = d%energy
            if (after /= "") d%energy = after
        case (5:4 + most)
            if (.not. allocated(d%equations)) return
            if (i > size(d%equations)) return
            before = trim(d%equations(i))
            if (after /= "") d%equations(i) = after
        case (5 + most:4 + 2*most)
            if (.not. allocated(d%accelerations)) return
            if (i > size(d%accelerations)) return
            before = trim(d%accelerations(i))
            if (after /= "") d%accelerations(i) = after
        case (5 + 2*most:4 + 3*most)
            if (.not. allocated(d%constraint_equations)) return
            if (i > size(d%constraint_equations)) return
            before = trim(d%constraint_equations(i))
            if (after /= "") d%constraint_equations(i) = after
        case (5 + 3*most:4 + 4*most)
            if (.not. allocated(d%quantities)) return
            if (i > size(d%quantities)) return
            before = trim(d%quantities(i)%formula)
            if (after /= "") d%quantities(i)%formula = after
        case (5 + 4*most:4 + 5*most)
            if (.not. allocated(d%reactions)) return
            if (i > size(d%reactions)) return
            before = trim(d%reactions(i)%formula)
            if (after /= "") d%reactions(i)%formula = after
        case (5 + 5*most:4 + 6*most)
            if (.not. allocated(d%letters)) return
            if (i > size(d%letters)) return
            before = trim(d%letters(i)%formula)
            if (after /= "") d%letters(i)%formula = after
        case (5 + 6*most:4 + 7*most)
            if (.not. allocated(d%frequencies)) return
            if (i > size(d%frequencies)) return
            before = trim(d%frequencies(i)%equation)
            if (after /= "") d%frequencies(i)%equation = after
        case (5 + 8*most:4 + 9*most)
            if (.not. allocated(d%generalised_forces)) return
            if (i > size(d%generalised_forces)) return
            before = trim(d%generalised_forces(i))
            if (after /= "") d%generalised_forces(i) = after
        case (5 + 9*most)
            if (allocated(d%dissipation)) before = d%dissipation
            if (after /= "") d%dissipation = after
        case default
            if (.not. allocated(d%motion)) return
            if (i > size(d%motion)) return
            before = trim(d%motion(i))
            if (after /= "") d%motion(i) = after
        end select
    end subroutine exchange

    pure function change_formula(d, text, slip) result(changed)
        !! With the slip, or as it is where there is no room for it.
        type(description_t), intent(in) :: d
        character(*), intent(in) :: text
        integer, intent(in) :: slip
        character(:), allocatable :: changed
        integer :: at

        changed = text
        at = index(text, " = ") + 1
        if (at > 1) at = at + 2
        if (at == 0) at = 1
        select case (slip)
        case (1)  ! the last sign
            at = max(index(text, " + ", back=.true.), index(text, " - ", back=.true.)) + 1
            if (at > 1) changed(at:at) = merge("-", "+", text(at:at) == "+")
        case (2)  ! the first sign of the right side
            if (text(at:at) == "-") then
                changed = text(:at - 1)//text(at + 1:)
            else if (text(at:) /= "0") then
                changed = text(:at - 1)//"- "//text(at:)
            end if
        case (3)  ! a factor
            if (text(at:) == "0") at = 1
            if (text(at:at) == "-") at = at + 1
            if (index(text, "^2 = ") > 0 .or. index(text, ">=") == 0) then
                changed = text(:at - 1)//" 2 "//text(at:)
            end if
        case (4)
            changed = other_letter(d, text)
        case default
            continue
        end select
    end function change_formula

    pure function other_letter(d, text) result(changed)
        !! The last parameter or coordinate by another one, cos by sin.
        type(description_t), intent(in) :: d
        character(*), intent(in) :: text
        character(:), allocatable :: changed
        character(*), parameter :: inside = "abcdefghijklmnopqrstuvwxyz_0123456789"// &
                                            "ABCDEFGHIJKLMNOPQRSTUVWXYZ"
        character(32) :: names(size(d%coordinates) + sum(d%parameters%count))
        integer :: first, last, k

        changed = text
        names = [character(32) :: d%coordinates%name, value_names(d)]
        last = len(text)
        do while (last > 0)
            last = scan(text(:last), inside, back=.true.)
            if (last == 0) return
            first = verify(text(:last), inside, back=.true.) + 1
            k = findloc(names == text(first:last), .true., 1)
            if (text(first:last) == "cos" .or. text(first:last) == "sin") then
                changed = text(:first - 1)//merge("sin", "cos", text(first:last) == "cos")// &
                          text(last + 1:)
                return
            else if (k > 0) then
                k = mod(k, size(names)) + 1
                if (size(names) == 1) return
                changed = text(:first - 1)//trim(names(k))//text(last + 1:)
                return
            end if
            last = first - 1
        end do
    end function other_letter

    pure subroutine describe(self, d)
        !! With the slip.
        class(misprint_t), intent(in) :: self
        type(description_t), intent(out) :: d
        character(:), allocatable :: text, unused

        call self%inside%describe(d)
        if (self%slip == 0 .and. self%instead == "") return
        text = formula_at(d, self%place)
        if (text == "") return
        text = change_formula(d, text, self%slip)
        if (self%instead /= "") text = trim(self%instead)
        call exchange(d, self%place, unused, text)
    end subroutine describe

    pure function quantity(self, i, t, q, v) result(value)
        !! Of the system inside.
        class(misprint_t), intent(in) :: self
        integer, intent(in) :: i
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp) :: value

        value = self%inside%quantity(i, t, q, v)
    end function quantity

    pure subroutine positions(self, t, q, r)
        !! Of the system inside.
        class(misprint_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof)
        type(hyperdual_t), intent(out) :: r(:, :)

        call self%inside%positions(t, q, r)
    end subroutine positions

    pure subroutine angles(self, t, q, phi)
        !! Of the system inside.
        class(misprint_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(:)
        type(hyperdual_t), intent(out) :: phi(:)

        call self%inside%angles(t, q, phi)
    end subroutine angles

    pure subroutine newton(self, t, x, u, force, constraint_residual)
        !! Of the system inside.
        class(misprint_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, x(:), u(:)
        real(dp), intent(out) :: force(:)
        type(hyperdual_t), intent(out) :: constraint_residual(:)

        call self%inside%newton(t, x, u, force, constraint_residual)
    end subroutine newton

    pure subroutine linearise(self, q, analytic)
        !! Of the system inside.
        class(misprint_t), intent(in) :: self
        real(dp), intent(in) :: q(self%ndof)
        type(linearised_t), intent(out) :: analytic

        call self%inside%linearise(q, analytic)
    end subroutine linearise

    pure function gap(self, i, t, q, v) result(value)
        !! Of the system inside.
        class(misprint_t), intent(in) :: self
        integer, intent(in) :: i
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp) :: value

        value = self%inside%gap(i, t, q, v)
    end function gap
end module misprints
