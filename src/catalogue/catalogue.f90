module lagrangia_catalogue
    !! Names and types: the only module that knows every system of the lectures.
    use lagrangia_atwood, only: atwood_t
    use lagrangia_bouncing_ball, only: bouncing_ball_t
    use lagrangia_cart_pendulum, only: cart_pendulum_t
    use lagrangia_charged_particle, only: charged_particle_t
    use lagrangia_description, only: description_t, name_length
    use lagrangia_double_pendulum, only: double_pendulum_t
    use lagrangia_driven_pendulum, only: driven_pendulum_t
    use lagrangia_errors, only: error_t
    use lagrangia_hanging_chain, only: hanging_chain_t
    use lagrangia_names, only: refuse_name
    use lagrangia_oscillator, only: oscillator_t
    use lagrangia_pendulum, only: pendulum_t
    use lagrangia_rolling_disk, only: rolling_disk_t
    use lagrangia_rotating_hoop, only: rotating_hoop_t
    use lagrangia_rotating_wire, only: rotating_wire_t
    use lagrangia_system, only: default_values, system_box_t, system_t
    use lagrangia_system_validation, only: validate_system
    use lagrangia_wedge, only: wedge_t
    implicit none (type, external)
    private
    public :: new_system, nth_system, register_system, system_names
    public :: built_in

    integer, parameter :: built_in = 13               !! systems: those of the lectures
    type(system_box_t), allocatable :: registered(:)  !! those that other programs brought

contains

    subroutine register_system(system, error)
        !! Add a system of your own, behind the others. Fails, and adds nothing, where its name is
        !! taken or cannot be typed, its description has gaps, or its closed form is of another
        !! motion.
        class(system_t), intent(in) :: system  !! is copied, with its default parameters
        type(error_t), allocatable, intent(out) :: error  !! what is wrong with the system
        type(system_box_t), allocatable :: longer(:)
        class(system_t), allocatable :: added
        integer :: i, n

        allocate (added, source=system)
        call validate_system(added, system_names(), error)
        if (allocated(error)) return
        n = 0
        if (allocated(registered)) n = size(registered)
        allocate (longer(n + 1))
        do i = 1, n
            call move_alloc(registered(i)%item, longer(i)%item)
        end do
        call move_alloc(added, longer(n + 1)%item)
        call move_alloc(longer, registered)
    end subroutine register_system

    subroutine nth_system(i, system)
        !! Entry `i` of the catalogue, with its default parameters; not allocated beyond the end.
        integer, intent(in) :: i  !! from 1
        class(system_t), allocatable, intent(out) :: system  !! not allocated beyond the end
        type(description_t) :: d
        type(error_t), allocatable :: error

        select case (i)
        case (1); allocate (oscillator_t :: system)
        case (2); allocate (pendulum_t :: system)
        case (3); allocate (double_pendulum_t :: system)
        case (4); allocate (cart_pendulum_t :: system)
        case (5); allocate (atwood_t :: system)
        case (6); allocate (wedge_t :: system)
        case (7); allocate (rolling_disk_t :: system)
        case (8); allocate (charged_particle_t :: system)
        case (9); allocate (rotating_wire_t :: system)
        case (10); allocate (rotating_hoop_t :: system)
        case (11); allocate (driven_pendulum_t :: system)
        case (12); allocate (bouncing_ball_t :: system)
        case (13); allocate (hanging_chain_t :: system)
        case default
            if (.not. allocated(registered)) return
            if (i < 1 .or. i > built_in + size(registered)) return
            allocate (system, source=registered(i - built_in)%item)
        end select
        call system%describe(d)
        call system%configure(default_values(d), error)
    end subroutine nth_system

    subroutine new_system(name, system, error)
        !! The system called `name`, with its default parameters.
        character(*), intent(in) :: name  !! as `list systems` shows it
        class(system_t), allocatable, intent(out) :: system  !! with its default parameters
        type(error_t), allocatable, intent(out) :: error  !! no system has this name
        type(description_t) :: d
        integer :: i

        i = 0
        do
            i = i + 1
            call nth_system(i, system)
            if (.not. allocated(system)) exit
            call system%describe(d)
            if (d%name == name) return
        end do
        call refuse_name("system", name, system_names(), error)
    end subroutine new_system

    function system_names() result(names)
        !! The names of all systems.
        character(name_length), allocatable :: names(:)
        class(system_t), allocatable :: system
        type(description_t) :: d
        integer :: i

        allocate (names(0))
        i = 0
        do
            i = i + 1
            call nth_system(i, system)
            if (.not. allocated(system)) exit
            call system%describe(d)
            names = [character(name_length) :: names, d%name]
        end do
    end function system_names
end module lagrangia_catalogue
