program main
    !! The command with a system that is wrong: `check` must find it.
    use lagrangia, only: error_t, lagrangia_main, register_system
    use spherical_slip, only: spherical_slip_t
    implicit none (type, external)
    type(spherical_slip_t) :: wrong
    type(error_t), allocatable :: error

    call register_system(wrong, error)
    call lagrangia_main(error)
end program main
