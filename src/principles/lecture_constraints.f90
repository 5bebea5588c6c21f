module lagrangia_lecture_constraints
    !! The constraints of the lecture, and those it needs for contrast, as one-forms.
    !!
    !! Source: Phys 601, 1 September 2011 (double pendulum, disk, y > 0); Hamilton's Principle
    !! (Atwood's machine, rheonomic constraints).
    use lagrangia_errors, only: error_t
    use lagrangia_hyperdual, only: cos, hyperdual, hyperdual_t, operator(*), operator(**), &
                                   operator(+), operator(-), sin
    use lagrangia_kinds, only: dp
    use lagrangia_pfaffian, only: pfaffian_t
    implicit none (type, external)
    private
    public :: example_t, lecture_constraint_t
    public :: classify, examples, example_point, new_constraint
    public :: radius, turning

    real(dp), parameter :: radius = 0.3_dp    !! R of the disk, m
    real(dp), parameter :: turning = 1.5_dp   !! of the wire, rad/s
    real(dp), parameter :: noise = 1e-12_dp   !! coefficients are of order 1

    type :: example_t
        character(24) :: name = ""
        integer :: coordinates = 0, rows = 0
        logical :: inequality = .false.
        character(26) :: class = ""   !! what it should turn out to be
        integer :: growth(3) = 0      !! dimensions: allowed, and with those that mixing adds
    end type example_t

    type(example_t), parameter :: examples(*) = [ &
        example_t("double pendulum f1", 4, 1, .false., "holonomic, scleronomic", [3, 3, 3]), &
        example_t("double pendulum f2", 4, 1, .false., "holonomic, scleronomic", [3, 3, 3]), &
        example_t("notes' f2", 4, 1, .false., "holonomic, scleronomic", [3, 3, 3]), &
        example_t("Atwood's rope", 2, 1, .false., "holonomic, scleronomic", [1, 1, 1]), &
        example_t("y dx - x dy = 0", 2, 1, .false., "holonomic, scleronomic", [1, 1, 1]), &
        example_t("disk, notes' dx", 4, 1, .false., "nonholonomic, scleronomic", [3, 4, 4]), &
        example_t("disk", 4, 2, .false., "nonholonomic, scleronomic", [2, 3, 4]), &
        example_t("disk, steering locked", 4, 3, .false., "holonomic, scleronomic", [1, 1, 1]), &
        example_t("rotating wire", 2, 1, .false., "holonomic, rheonomic", [2, 2, 2]), &
        example_t("dx - t dy = 0", 2, 1, .false., "nonholonomic, rheonomic", [2, 3, 3]), &
        example_t("y > 0", 2, 1, .true., "unilateral, scleronomic", [1, 1, 1])]

    type, extends(pfaffian_t) :: lecture_constraint_t
        !! One of `examples`.
        character(24) :: name = ""
        logical :: inequality = .false.
        integer :: factor = 0  !! `y dx - x dy` is multiplied by \(y^{-factor}\)
    contains
        procedure :: forms
    end type lecture_constraint_t

contains

    pure subroutine new_constraint(self, example)
        !! The constraint behind an example; the time is a coordinate where it matters.
        type(lecture_constraint_t), intent(out) :: self  !! the constraint
        type(example_t), intent(in) :: example  !! of `examples`

        self%name = example%name
        self%coordinates = example%coordinates
        self%rows = example%rows
        self%inequality = example%inequality
        self%timed = self%motion(example_point(example%coordinates, 1)) > noise
    end subroutine new_constraint

    pure function example_point(coordinates, k) result(x)
        !! Point `k` to look at, the time behind the coordinates: nowhere special.
        integer, intent(in) :: coordinates, k  !! how many; which point
        real(dp) :: x(coordinates + 1)
        integer :: i

        x = [(1.3_dp*sin(1.7_dp*k + 2.1_dp*i), i=1, coordinates + 1)]
    end function example_point

    pure subroutine forms(self, x, a)
        !! See `pfaffian_t`.
        class(lecture_constraint_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: x(self%coordinates + 1)
        type(hyperdual_t), intent(out) :: a(self%rows, self%coordinates + 1)
        type(hyperdual_t) :: one, angle

        a = hyperdual_t()
        one = hyperdual(1.0_dp)
        select case (self%name)
        case ("double pendulum f1")  ! x1, y1, x2, y2: x1^2 + y1^2 = l1^2
            a(1, 1) = 2.0_dp*x(1)
            a(1, 2) = 2.0_dp*x(2)
        case ("double pendulum f2")  ! (x2 - x1)^2 + (y2 - y1)^2 = l2^2
            a(1, 3) = 2.0_dp*(x(3) - x(1))
            a(1, 4) = 2.0_dp*(x(4) - x(2))
            a(1, 1) = hyperdual_t() - a(1, 3)
            a(1, 2) = hyperdual_t() - a(1, 4)
        case ("notes' f2")           ! x2^2 + y2^2 = l2^2
            a(1, 3) = 2.0_dp*x(3)
            a(1, 4) = 2.0_dp*x(4)
        case ("Atwood's rope")       ! x + y + pi R = l
            a(1, 1) = one
            a(1, 2) = one
        case ("y dx - x dy = 0")
            a(1, 1) = x(2)**(1 - self%factor)
            a(1, 2) = (-1.0_dp)*x(1)*x(2)**(-self%factor)
        case ("disk, notes' dx", "disk", "disk, steering locked")  ! x, y, phi, theta
            a(1, 1) = one
            a(1, 3) = (-radius)*sin(x(4))
            if (self%rows >= 2) then
                a(2, 2) = one
                a(2, 3) = radius*cos(x(4))
            end if
            if (self%rows >= 3) a(3, 4) = one
        case ("rotating wire")       ! x, y, t: y cos(W t) - x sin(W t) = 0
            angle = turning*x(3)
            a(1, 1) = (-1.0_dp)*sin(angle)
            a(1, 2) = cos(angle)
            a(1, 3) = (-turning)*(x(2)*sin(angle) + x(1)*cos(angle))
        case ("dx - t dy = 0")
            a(1, 1) = one
            a(1, 2) = hyperdual_t() - x(3)
        case default                 ! y > 0, where it touches: dy = 0
            a(1, 2) = one
        end select
    end subroutine forms

    pure subroutine classify(self, verdict, growth, error)
        !! What the numbers say at five points, and the growth vector.
        type(lecture_constraint_t), intent(in) :: self  !! the constraint
        character(26), intent(out) :: verdict  !! as `holonomic, scleronomic`
        integer, intent(out) :: growth(3)  !! \(d_1, d_2, d_3\)
        type(error_t), allocatable, intent(out) :: error  !! allocated where it fails
        real(dp) :: x(self%coordinates + 1)
        integer :: k, dimensions(3)
        logical :: integrable, moves

        verdict = ""
        growth = 0
        integrable = .true.
        moves = .false.
        do k = 1, 5
            x = example_point(self%coordinates, k)
            call self%growth(x, dimensions, error)
            if (allocated(error)) return
            growth = max(growth, dimensions)
            integrable = integrable .and. self%frobenius(x) <= noise &
                         .and. dimensions(3) == dimensions(1)
            moves = moves .or. self%motion(x) > noise
        end do
        verdict = merge("holonomic   ", "nonholonomic", integrable)
        if (self%inequality) verdict = "unilateral"
        verdict = trim(verdict)//", "//merge("rheonomic  ", "scleronomic", moves)
    end subroutine classify
end module lagrangia_lecture_constraints
