module polynomial_motion
    !! A motion that is a power of the time: what interpolates must follow it to rounding.
    use bare_system, only: bare_system_t
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp
    implicit none (type, external)
    private
    public :: polynomial_motion_t, new_polynomial_motion

    type, extends(bare_system_t) :: polynomial_motion_t
        integer :: degree = 2
    contains
        procedure :: configure
        procedure :: accelerations
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

    pure function state(self, t) result(y)
        !! Coordinate and velocity.
        class(polynomial_motion_t), intent(in) :: self
        real(dp), intent(in) :: t
        real(dp) :: y(2)

        y = [t**self%degree, self%degree*t**(self%degree - 1)]
    end function state
end module polynomial_motion
