program cart
    use lagrangia, only: dp, error_t, new_system, solve, system_t
    implicit none (type, external)
    class(system_t), allocatable :: system
    type(error_t), allocatable :: error
    real(dp), allocatable :: q(:, :), v(:, :)
    real(dp) :: t(0:10)
    integer :: i

    call new_system("cart_pendulum", system, error)
    if (allocated(error)) error stop error%message
    call system%configure([2.0_dp, 1.0_dp, 1.0_dp, 9.81_dp], error)  ! m1, m2, l, g
    if (allocated(error)) error stop error%message
    t = [(0.1_dp*i, i=0, 10)]
    call solve(system, "gauss16", t, [0.0_dp, 1.0_dp], [0.0_dp, 0.0_dp], q, v, error)
    if (allocated(error)) error stop error%message
    do i = 0, 10
        print "(f4.1, 2f12.8)", t(i), q(:, i + 1)
    end do
end program cart
