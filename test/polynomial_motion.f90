module polynomial_motion
    !! A motion that is a power of the time: what interpolates must follow it to rounding.
    use lagrangia_description, only: description_t
    use lagrangia_errors, only: error_t
    use lagrangia_hyperdual, only: hyperdual_t
    use lagrangia_kinds, only: dp
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: polynomial_motion_t, new_polynomial_motion

    type, extends(system_t) :: polynomial_motion_t
        integer :: degree = 2
    contains
        procedure :: describe
        procedure :: configure
        procedure :: accelerations
        procedure :: lagrangian
        procedure :: energy
        procedure :: state
    end type polynomial_motion_t

contains

    subroutine new_polynomial_motion(self, degree)
        !! \(x = t^n\).
        type(polynomial_motion_t), intent(out) :: self
        integer, intent(in) :: degree
        type(error_t), allocatable :: error

        call self%configure([real(dp) ::], error)
        self%degree = degree
    end subroutine new_polynomial_motion

    pure subroutine describe(self, d)
        !! A name is enough.
        class(polynomial_motion_t), intent(in) :: self
        type(description_t), intent(out) :: d

        d%name = "polynomial_motion"
    end subroutine describe

    pure subroutine configure(self, values, error)
        !! No parameters.
        class(polynomial_motion_t), intent(inout) :: self
        real(dp), intent(in) :: values(:)
        type(error_t), allocatable, intent(out) :: error

        self%ndof = 1
        self%velocity_forces = .false.
        self%time_dependent = .true.
    end subroutine configure

    pure subroutine accelerations(self, t, q, v, a)
        !! $$ \ddot x = n(n-1)t^{n-2} $$
        class(polynomial_motion_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp), intent(out) :: a(self%ndof)

        associate (n => self%degree)
            a(1) = n*(n - 1)*t**(n - 2)
        end associate
    end subroutine accelerations

    pure function lagrangian(self, t, q, v) result(l)
        !! Not wanted here.
        class(polynomial_motion_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof), v(self%ndof)
        type(hyperdual_t) :: l

        l = hyperdual_t()
    end function lagrangian

    pure function energy(self, t, q, v) result(e)
        !! Not wanted either.
        class(polynomial_motion_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp) :: e

        e = 0.0_dp
    end function energy

    pure function state(self, t) result(y)
        !! Coordinate and velocity.
        class(polynomial_motion_t), intent(in) :: self
        real(dp), intent(in) :: t
        real(dp) :: y(2)

        y = [t**self%degree, self%degree*t**(self%degree - 1)]
    end function state
end module polynomial_motion
