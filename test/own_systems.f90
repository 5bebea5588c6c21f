module own_systems
    !! Systems as a student brings them: an outline and a Lagrangian, no more.
    use lagrangia, only: coordinate, cos, description_t, dp, hyperdual_t, lagrangian_system_t, &
                         log, mass_point, nonnegative, operator(*), operator(**), operator(+), &
                         operator(-), operator(/), positive, quantity_t, real_number, sin, sqrt, sum
    implicit none (type, external)
    private
    public :: own_pendulum_t, own_double_t, own_pivot_t, own_slope_t, own_skin_t, own_named_t

    type, extends(lagrangian_system_t) :: own_pendulum_t
        !! Parameters in the order of the lecture's: m, l, g.
    contains
        procedure :: outline => pendulum_outline
        procedure :: lagrangian => pendulum_lagrangian
    end type own_pendulum_t

    type, extends(lagrangian_system_t) :: own_double_t
        !! The double pendulum from its two points: m1, m2, l1, l2, g.
    contains
        procedure :: outline => double_outline
        procedure :: lagrangian => double_lagrangian
    end type own_double_t

    type, extends(lagrangian_system_t) :: own_pivot_t
        !! A pendulum whose pivot moves up and down: L contains the time, unless `a` is 0.
    contains
        procedure :: outline => pivot_outline
        procedure :: lagrangian => pivot_lagrangian
    end type own_pivot_t

    type, extends(lagrangian_system_t) :: own_slope_t
        !! A mass that \(y = c\,x\) keeps on a slope.
    contains
        procedure :: outline => slope_outline
        procedure :: lagrangian => slope_lagrangian
        procedure :: constraint_rows => slope_rows
        procedure :: constraint_values => slope_values
        procedure :: prepare => prepare_slope
    end type own_slope_t

    type, extends(lagrangian_system_t) :: own_skin_t
        !! L is a number for r > 0 only, for |r| < 1e-3 only, nowhere, or where eight coordinates
        !! are positive; else `s` is cyclic.
        integer :: kind = 1
    contains
        procedure :: outline => skin_outline
        procedure :: lagrangian => skin_lagrangian
    end type own_skin_t

    type, extends(own_pendulum_t) :: own_named_t
        !! With any names.
        character(32) :: name = "own", coordinate = "theta", parameter = "m"
        type(quantity_t), allocatable :: more(:)
        real(dp) :: mass = 1.0_dp
        logical :: empty = .false.
    contains
        procedure :: outline => named_outline
    end type own_named_t

contains

    pure subroutine pendulum_outline(self, d)
        class(own_pendulum_t), intent(in) :: self
        type(description_t), intent(out) :: d

        d%name = "own_pendulum"
        d%title = "a pendulum that a student brought"
        d%coordinates = [coordinate("theta", "rad", "from the downward vertical")]
        d%parameters = [positive("m", "kg", "mass", 0.5_dp), positive("l", "m", "length", 1.2_dp), &
                        nonnegative("g", "m/s^2", "gravity", 9.81_dp)]
        d%points = [mass_point("bob", self%value(1, 0.5_dp))]
    end subroutine pendulum_outline

    pure function pendulum_lagrangian(self, t, q, v) result(l)
        class(own_pendulum_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof), v(self%ndof)
        type(hyperdual_t) :: l

        associate (m => self%p(1), r => self%p(2), g => self%p(3))
            l = 0.5_dp*m*(r*v(1))**2 + m*g*r*cos(q(1))
        end associate
    end function pendulum_lagrangian

    pure subroutine double_outline(self, d)
        class(own_double_t), intent(in) :: self
        type(description_t), intent(out) :: d

        d%name = "own_double"
        d%title = "a double pendulum that a student brought"
        d%coordinates = [coordinate("a", "rad", "of the upper rod"), &
                         coordinate("b", "rad", "of the lower rod")]
        d%parameters = [positive("m1", "kg", "upper mass", 1.0_dp), &
                        positive("m2", "kg", "lower mass", 1.0_dp), &
                        positive("l1", "m", "upper rod", 1.0_dp), &
                        positive("l2", "m", "lower rod", 1.0_dp), &
                        nonnegative("g", "m/s^2", "gravity", 9.81_dp)]
    end subroutine double_outline

    pure function double_lagrangian(self, t, q, v) result(l)
        !! Velocities of the points squared, their heights.
        class(own_double_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof), v(self%ndof)
        type(hyperdual_t) :: l, x1, y1, x2, y2

        associate (m1 => self%p(1), m2 => self%p(2), l1 => self%p(3), l2 => self%p(4), &
                   g => self%p(5))
            x1 = l1*cos(q(1))*v(1)
            y1 = l1*sin(q(1))*v(1)
            x2 = x1 + l2*cos(q(2))*v(2)
            y2 = y1 + l2*sin(q(2))*v(2)
            l = 0.5_dp*m1*(x1**2 + y1**2) + 0.5_dp*m2*(x2**2 + y2**2) &
                + m1*g*l1*cos(q(1)) + m2*g*(l1*cos(q(1)) + l2*cos(q(2)))
        end associate
    end function double_lagrangian

    pure subroutine pivot_outline(self, d)
        class(own_pivot_t), intent(in) :: self
        type(description_t), intent(out) :: d

        d%name = "own_pivot"
        d%title = "a pendulum on a pivot that moves"
        d%coordinates = [coordinate("theta", "rad", "from the downward vertical")]
        d%parameters = [real_number("a", "m", "amplitude", 0.3_dp)]
    end subroutine pivot_outline

    pure function pivot_lagrangian(self, t, q, v) result(l)
        class(own_pivot_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof), v(self%ndof)
        type(hyperdual_t) :: l

        l = 0.5_dp*v(1)**2 + (9.81_dp - self%p(1)*cos(t))*cos(q(1))
    end function pivot_lagrangian

    pure subroutine slope_outline(self, d)
        class(own_slope_t), intent(in) :: self
        type(description_t), intent(out) :: d

        d%name = "own_slope"
        d%title = "a mass kept on a slope by a condition on its velocity"
        d%coordinates = [coordinate("x", "m", "across"), coordinate("y", "m", "up")]
        d%parameters = [real_number("c", "1", "slope", 0.75_dp)]
    end subroutine slope_outline

    pure function slope_lagrangian(self, t, q, v) result(l)
        class(own_slope_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof), v(self%ndof)
        type(hyperdual_t) :: l

        l = sum(v**2) - 2.0_dp*10.0_dp*q(2)
    end function slope_lagrangian

    pure subroutine slope_rows(self, t, q, rows, drift)
        class(own_slope_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof)
        type(hyperdual_t), intent(out) :: rows(:, :), drift(:)

        rows(1, 1) = hyperdual_t(-self%p(1))
        rows(1, 2) = hyperdual_t(1.0_dp)
        drift(1) = hyperdual_t()
    end subroutine slope_rows

    pure subroutine slope_values(self, t, q, values)
        class(own_slope_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof)
        real(dp), intent(out) :: values(:)

        values(1) = q(2) - self%p(1)*q(1)
    end subroutine slope_values

    pure subroutine prepare_slope(self)
        class(own_slope_t), intent(inout) :: self

        self%constraints = 1
        self%is_projected = .true.
        self%holonomic = [.true.]
    end subroutine prepare_slope

    pure subroutine skin_outline(self, d)
        class(own_skin_t), intent(in) :: self
        type(description_t), intent(out) :: d
        integer :: i

        d%name = "own_skin"
        d%title = "a system that is not everywhere"
        d%coordinates = [coordinate("r", "m", "restricted"), coordinate("s", "m", "cyclic")]
        if (self%kind == 4) d%coordinates = [(coordinate("r"//achar(48 + i), "m", "positive"), &
                                              i=1, 8)]
    end subroutine skin_outline

    pure function skin_lagrangian(self, t, q, v) result(l)
        class(own_skin_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof), v(self%ndof)
        type(hyperdual_t) :: l

        l = 0.5_dp*sum(v**2)
        select case (self%kind)
        case (1); l = l + log(q(1))
        case (2); l = l + sqrt(1e-6_dp - q(1)**2)
        case (4); l = l + sum(log(q))
        case default; l = l + sqrt(-1.0_dp - q(1)**2)
        end select
    end function skin_lagrangian

    pure subroutine named_outline(self, d)
        class(own_named_t), intent(in) :: self
        type(description_t), intent(out) :: d

        call self%own_pendulum_t%outline(d)
        d%name = self%name
        d%coordinates%name = self%coordinate
        d%parameters(1)%name = self%parameter
        d%parameters(1)%value = self%mass
        if (allocated(self%more)) d%quantities = self%more
        if (self%empty) deallocate (d%coordinates)
    end subroutine named_outline
end module own_systems
