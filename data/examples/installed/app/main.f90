program periods
    !! The small oscillations of the cart-pendulum, for carts of 1 to 4 kg.
    use lagrangia, only: dp, error_t, find_modes, modes_t, new_system, system_t
    implicit none (type, external)
    class(system_t), allocatable :: system
    type(error_t), allocatable :: error
    type(modes_t) :: modes
    integer :: m1

    call new_system("cart_pendulum", system, error)
    if (allocated(error)) error stop error%message
    do m1 = 1, 4
        call system%configure([real(m1, dp), 1.0_dp, 1.0_dp, 9.81_dp], error)  ! m1, m2, l, g
        if (allocated(error)) error stop error%message
        call find_modes(system, [0.0_dp, 0.0_dp], .true., modes, error)
        if (allocated(error)) error stop error%message
        print "(i2, a, f12.9, a)", m1, " kg:  omega^2 =", modes%omega2(2), " s^-2"
    end do
end program periods
