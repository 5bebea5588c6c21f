program main
    !! Three masses between two walls, four equal springs:
    !! \(\omega^2 = (2 - \sqrt2,\ 2,\ 2 + \sqrt2)\,k/m\).
    use, intrinsic :: iso_fortran_env, only: error_unit, output_unit
    use lagrangia, only: dp, error_t, normal_modes, normal_modes_t
    implicit none (type, external)
    real(dp), parameter :: k(3, 3) = reshape([2.0_dp, -1.0_dp, 0.0_dp, &
                                              -1.0_dp, 2.0_dp, -1.0_dp, &
                                              0.0_dp, -1.0_dp, 2.0_dp], [3, 3])
    real(dp), parameter :: m(3, 3) = reshape([1.0_dp, 0.0_dp, 0.0_dp, &
                                              0.0_dp, 1.0_dp, 0.0_dp, &
                                              0.0_dp, 0.0_dp, 1.0_dp], [3, 3])
    type(normal_modes_t) :: modes
    type(error_t), allocatable :: error
    integer :: j

    call normal_modes(k, m, modes, error)
    if (allocated(error)) then
        write (error_unit, "(a)") error%message
        stop error%status, quiet=.true.
    end if
    do j = 1, 3
        write (output_unit, "(a, f18.15, a, 3f8.4)") "omega^2 =", modes%omega2(j), &
            "  shape", modes%shapes(:, j)
    end do
end program main
