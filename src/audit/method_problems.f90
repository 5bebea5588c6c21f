module lagrangia_method_problems
    !! Motions known in closed form, on which methods are measured. The last has a magnetic field.
    use lagrangia_cart_pendulum, only: cart_pendulum_t
    use lagrangia_charged_particle, only: charged_particle_t
    use lagrangia_errors, only: error_t
    use lagrangia_integrator, only: integrator_t
    use lagrangia_kinds, only: dp
    use lagrangia_pendulum, only: pendulum_t
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: new_problem, problems, refuses

    integer, parameter :: problems = 3

contains

    subroutine new_problem(k, system, q, v)
        !! A pendulum with a large swing; a cart-pendulum, whose mass matrix changes; a charge
        !! in electric and magnetic fields and a trap. Rates are about 3 rad/s at most.
        integer, intent(in) :: k
        class(system_t), allocatable, intent(out) :: system
        real(dp), allocatable, intent(out) :: q(:), v(:)
        type(error_t), allocatable :: error

        select case (k)
        case (1)
            allocate (pendulum_t :: system)
            call system%configure([1.3_dp, 1.7_dp, 9.81_dp], error)
            allocate (q, source=[2.0_dp])
            allocate (v, source=[0.3_dp])
        case (2)
            allocate (cart_pendulum_t :: system)
            call system%configure([1.3_dp, 0.7_dp, 1.9_dp, 9.81_dp], error)
            allocate (q, source=[0.1_dp, 1.2_dp])
            allocate (v, source=[0.2_dp, -0.5_dp])
        case default
            allocate (charged_particle_t :: system)
            call system%configure([1.3_dp, 0.7_dp, 0.2_dp, 0.1_dp, -0.3_dp, 0.6_dp, -0.7_dp, &
                                   1.4_dp, 2.1_dp], error)
            allocate (q, source=[0.5_dp, -0.2_dp, 0.3_dp])
            allocate (v, source=[1.0_dp, 0.3_dp, -0.4_dp])
        end select
    end subroutine new_problem

    function refuses(method, system)
        !! Whether `method` is not for `system`; otherwise it is ready.
        class(integrator_t), intent(inout) :: method
        class(system_t), intent(in) :: system
        logical :: refuses
        type(error_t), allocatable :: error

        call method%prepare(system, error)
        refuses = allocated(error)
    end function refuses
end module lagrangia_method_problems
