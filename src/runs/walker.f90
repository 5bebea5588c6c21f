module lagrangia_walker
    !! Paths for the principles, by the methods of the catalogue.
    use lagrangia_errors, only: error_t
    use lagrangia_integrator, only: integrator_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_methods, only: new_integrator
    use lagrangia_path_maker, only: path_maker_t
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: walker_t

    type, extends(path_maker_t) :: walker_t
    contains
        procedure :: make
    end type walker_t

contains

    subroutine make(self, method, system, t0, dt, q0, v0, q, v, error)
        !! See `path_maker_t`.
        class(walker_t), intent(in) :: self
        character(*), intent(in) :: method
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t0, dt
        real(dp), intent(in) :: q0(system%ndof), v0(system%ndof)
        real(dp), intent(out) :: q(:, :), v(:, :)
        type(error_t), allocatable, intent(out) :: error
        class(integrator_t), allocatable :: integrator
        real(dp) :: x(system%ndof), x_dot(system%ndof)
        integer :: k

        q = 0.0_dp
        v = 0.0_dp
        call new_integrator(method, integrator, error)
        if (allocated(error)) return
        call integrator%prepare(system, error)
        if (allocated(error)) return
        x = q0
        x_dot = v0
        call integrator%start(system, t0, x, x_dot)
        do k = 1, size(q, 2)
            q(:, k) = x
            v(:, k) = x_dot
            call integrator%advance(system, t0, dt, int(k - 1, i8), 1_i8, x, x_dot)
        end do
    end subroutine make
end module lagrangia_walker
