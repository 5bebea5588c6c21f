program main
    !! The command `lagrangia` with two systems more.
    use lagrangia, only: lagrangia_main, register_system
    use spherical_pendulum, only: spherical_pendulum_t
    use spherical_pendulum_by_hand, only: spherical_by_hand_t
    implicit none (type, external)
    type(spherical_pendulum_t) :: from_lagrangian
    type(spherical_by_hand_t) :: by_hand

    call register_system(from_lagrangian)
    call register_system(by_hand)
    call lagrangia_main()
end program main
