module lagrangia_computed_path
    !! Paths for the principles, by the methods of the catalogue.
    use lagrangia_errors, only: error_t
    use lagrangia_integrator, only: integrator_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_methods, only: new_integrator
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: compute_path

contains

    subroutine compute_path(method, system, t0, dt, q0, v0, q, v, error)
        !! The states at `t0`, `t0 + dt`, ... that `method` computes; the first one is `q0`, `v0`.
        !! Fails where the method is not known or refuses the system.
        character(*), intent(in) :: method           !! its name
        class(system_t), intent(in) :: system  !! with its parameters
        real(dp), intent(in) :: t0                   !! s
        real(dp), intent(in) :: dt                   !! the step, s
        real(dp), intent(in) :: q0(system%ndof)      !! coordinates at `t0`
        real(dp), intent(in) :: v0(system%ndof)      !! and their velocities
        real(dp), intent(out) :: q(:, :)             !! (ndof, samples)
        real(dp), intent(out) :: v(:, :)             !! (ndof, samples)
        type(error_t), allocatable, intent(out) :: error  !! allocated where it fails
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
    end subroutine compute_path
end module lagrangia_computed_path
