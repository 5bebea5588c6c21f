program main
    !! The command `lagrangia` with three systems more.
    use lagrangia, only: error_t, lagrangia_main, register_system
    use spherical_by_hand, only: spherical_by_hand_t
    use spherical_pendulum, only: spherical_pendulum_t
    use spherical_xy, only: spherical_xy_t
    implicit none (type, external)
    type(spherical_pendulum_t) :: from_lagrangian
    type(spherical_by_hand_t) :: by_hand
    type(spherical_xy_t) :: below_the_pivot
    type(error_t), allocatable :: error

    call register_system(from_lagrangian, error)
    if (.not. allocated(error)) call register_system(by_hand, error)
    if (.not. allocated(error)) call register_system(below_the_pivot, error)
    call lagrangia_main(error)
end program main
