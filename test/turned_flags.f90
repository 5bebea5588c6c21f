module turned_flags
    !! Systems that say of one flag what is not so.
    use lagrangia_cart_pendulum, only: cart_pendulum_t
    use lagrangia_driven_pendulum, only: driven_pendulum_t
    use lagrangia_errors, only: error_t
    use lagrangia_hyperdual, only: hyperdual_t, operator(+)
    use lagrangia_kinds, only: dp
    use lagrangia_pendulum, only: pendulum_t
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: new_turned

    type, extends(pendulum_t) :: turned_pendulum_t
        character(16) :: flag = ""
    contains
        procedure :: configure => configure_pendulum
        procedure :: lagrangian => lagrangian_pendulum
    end type turned_pendulum_t

    type, extends(cart_pendulum_t) :: turned_cart_t
    contains
        procedure :: configure => configure_cart
    end type turned_cart_t

    type, extends(driven_pendulum_t) :: turned_drive_t
    contains
        procedure :: configure => configure_drive
    end type turned_drive_t

contains

    subroutine new_turned(name, flag, system)
        !! A pendulum says yes to what is not so and has a wrong cyclic coordinate; the others say
        !! no to what is so.
        character(*), intent(in) :: name, flag
        class(system_t), allocatable, intent(out) :: system

        select case (name)
        case ("pendulum"); allocate (system, source=turned_pendulum_t(flag=flag))
        case ("cart_pendulum"); allocate (turned_cart_t :: system)
        case default; allocate (turned_drive_t :: system)
        end select
    end subroutine new_turned

    pure subroutine configure_pendulum(self, values, error)
        class(turned_pendulum_t), intent(inout) :: self
        real(dp), intent(in) :: values(:)
        type(error_t), allocatable, intent(out) :: error

        call self%pendulum_t%configure(values(:3), error)  ! without friction
        select case (self%flag)
        case ("velocity_forces"); self%velocity_forces = .true.
        case ("time_dependent"); self%time_dependent = .true.
        case ("cyclic"); self%cyclic = 1
        case ("cyclic 2"); self%cyclic = 2
        case ("cyclic -1"); self%cyclic = -1
        case default  ! "time in L"
        end select
    end subroutine configure_pendulum

    pure function lagrangian_pendulum(self, t, q, v) result(l)
        class(turned_pendulum_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof), v(self%ndof)
        type(hyperdual_t) :: l

        l = self%pendulum_t%lagrangian(t, q, v)
        if (self%flag == "time in L") l = l + t
    end function lagrangian_pendulum

    pure subroutine configure_cart(self, values, error)
        class(turned_cart_t), intent(inout) :: self
        real(dp), intent(in) :: values(:)
        type(error_t), allocatable, intent(out) :: error

        call self%cart_pendulum_t%configure(values, error)
        self%velocity_forces = .false.
    end subroutine configure_cart

    pure subroutine configure_drive(self, values, error)
        class(turned_drive_t), intent(inout) :: self
        real(dp), intent(in) :: values(:)
        type(error_t), allocatable, intent(out) :: error

        call self%driven_pendulum_t%configure(values, error)
        self%time_dependent = .false.
    end subroutine configure_drive
end module turned_flags
