module coupled_problems
    !! Motions in which two coordinates drive each other, for tests of methods: the double
    !! pendulum and the cart-pendulum, whose accelerations depend on the velocities and whose
    !! masses on the coordinates, and Hénon & Heiles's system, where neither is so.
    use henon_heiles, only: henon_heiles_t, new_henon_heiles
    use lagrangia_cart_pendulum, only: cart_pendulum_t
    use lagrangia_double_pendulum, only: double_pendulum_t
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: new_problem, problems, start

    integer, parameter :: problems = 3

contains

    subroutine new_problem(k, system)
        !! Its rates are some 3 rad/s.
        integer, intent(in) :: k
        class(system_t), allocatable, intent(out) :: system
        type(henon_heiles_t) :: coupled
        type(error_t), allocatable :: error

        select case (k)
        case (1)
            allocate (double_pendulum_t :: system)
            call system%configure([1.3_dp, 0.7_dp, 1.9_dp, 1.4_dp, 9.81_dp], error)
        case (2)
            allocate (cart_pendulum_t :: system)
            call system%configure([1.3_dp, 0.7_dp, 1.9_dp, 9.81_dp], error)
        case default
            call new_henon_heiles(coupled)
            allocate (system, source=coupled)
        end select
    end subroutine new_problem

    pure function start(i, large) result(y)
        !! Motion `i`: coordinates and velocities in one phase or another.
        integer, intent(in) :: i
        real(dp), intent(in) :: large
        real(dp) :: y(4)

        y = large*[cos(0.8_dp*i), sin(1.1_dp*i), 3.0_dp*sin(0.8_dp*i), 3.0_dp*cos(1.1_dp*i)]
    end function start
end module coupled_problems
