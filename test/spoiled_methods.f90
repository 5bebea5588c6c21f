module spoiled_methods
    !! Methods that something is wrong with: the stress tests must see it.
    use lagrangia_errors, only: error_t
    use lagrangia_integrator, only: integrator_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_methods, only: new_integrator
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: spoiled_t, new_spoiled

    type, extends(integrator_t) :: spoiled_t
        !! Another method, and after each step (or call) a little too much of something.
        class(integrator_t), allocatable :: method
        real(dp) :: damping = 0.0_dp  !! of the velocities, a step
        real(dp) :: push = 0.0_dp     !! added to the velocities at every call
        real(dp) :: share = 0.0_dp    !! and that share of them
    contains
        procedure :: prepare
        procedure :: start
        procedure :: advance
    end type spoiled_t

contains

    subroutine new_spoiled(self, name, damping, push, share)
        !! It declares what the method declares.
        type(spoiled_t), intent(out) :: self
        character(*), intent(in) :: name
        real(dp), intent(in), optional :: damping, push, share
        type(error_t), allocatable :: error

        call new_integrator(name, self%method, error)
        self%name = name
        self%order = self%method%order
        self%energy_order = self%method%energy_order
        self%symplectic = self%method%symplectic
        self%reversible = self%method%reversible
        self%step_limit = self%method%step_limit
        if (present(damping)) self%damping = damping
        if (present(push)) self%push = push
        if (present(share)) self%share = share
    end subroutine new_spoiled

    pure subroutine prepare(self, system, error)
        !! Refuses what the method refuses.
        class(spoiled_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        type(error_t), allocatable, intent(out) :: error

        call self%method%prepare(system, error)
        self%evaluations = 0
    end subroutine prepare

    pure subroutine start(self, system, t0, q, v, t_end)
        !! See `integrator_t`.
        class(spoiled_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t0
        real(dp), intent(in) :: q(system%ndof), v(system%ndof)
        real(dp), intent(in), optional :: t_end

        call self%method%start(system, t0, q, v, t_end)
    end subroutine start

    pure subroutine advance(self, system, t0, dt, first, steps, q, v)
        !! See the type.
        class(spoiled_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t0, dt
        integer(i8), intent(in) :: first, steps
        real(dp), intent(inout) :: q(system%ndof), v(system%ndof)
        integer(i8) :: k

        if (abs(self%damping) > 0.0_dp) then
            do k = first, first + steps - 1
                call self%method%advance(system, t0, dt, k, 1_i8, q, v)
                v = v*(1.0_dp - self%damping)
                call self%method%start(system, t0 + (k + 1)*dt, q, v)
            end do
        else
            call self%method%advance(system, t0, dt, first, steps, q, v)
        end if
        v = v*(1.0_dp + self%share) + self%push
        call self%method%start(system, t0 + (first + steps)*dt, q, v)
        self%evaluations = self%method%evaluations
    end subroutine advance
end module spoiled_methods
