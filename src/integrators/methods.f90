module lagrangia_methods
    !! Names and types of the methods: the only module that knows every integrator.
    use lagrangia_boris, only: boris_t, new_boris
    use lagrangia_canonical, only: midpoint_t, new_midpoint, new_stormer_verlet, stormer_verlet_t
    use lagrangia_composition, only: nth_composition
    use lagrangia_description, only: name_length
    use lagrangia_errors, only: error_t, fail
    use lagrangia_gauss, only: gauss_t, new_gauss16
    use lagrangia_integrator, only: integrator_t
    use lagrangia_names, only: refuse_name
    use lagrangia_rk4, only: new_rk4, rk4_t
    use lagrangia_system, only: system_t
    use lagrangia_text, only: join
    implicit none (type, external)
    private
    public :: new_integrator, nth_integrator, method_names
    public :: prepare_integrator
    public :: auto, exact, workhorse

    character(*), parameter :: auto = "auto", exact = "exact"
    character(*), parameter :: workhorse = "gauss16"
    !! With `dt` and with `tolerance`, whatever the structure: `lagrangia bench` has it before
    !! the others on the double pendulum, cart-pendulum and pendulum at every error, on the
    !! oscillator from 1e-6 on; and a step costs no more than one of `blanes_moan6`.

contains

    subroutine nth_integrator(i, integrator)
        !! Entry `i` of the methods of fixed step; not allocated beyond the end.
        integer, intent(in) :: i
        class(integrator_t), allocatable, intent(out) :: integrator
        integer, parameter :: others = 5

        select case (i)
        case (1); call place_rk4()
        case (2); call place_stormer_verlet()
        case (3); call place_midpoint()
        case (4); call place_boris()
        case (5); call place_gauss16()
        case default; call nth_composition(i - others, integrator)
        end select
    contains
        subroutine place_stormer_verlet()
            type(stormer_verlet_t) :: method

            call new_stormer_verlet(method)
            allocate (integrator, source=method)
        end subroutine place_stormer_verlet

        subroutine place_midpoint()
            type(midpoint_t) :: method

            call new_midpoint(method)
            allocate (integrator, source=method)
        end subroutine place_midpoint

        subroutine place_boris()
            type(boris_t) :: method

            call new_boris(method)
            allocate (integrator, source=method)
        end subroutine place_boris

        subroutine place_gauss16()
            type(gauss_t) :: method

            call new_gauss16(method)
            allocate (integrator, source=method)
        end subroutine place_gauss16

        subroutine place_rk4()
            type(rk4_t) :: method

            call new_rk4(method)
            allocate (integrator, source=method)
        end subroutine place_rk4
    end subroutine nth_integrator

    subroutine new_integrator(name, integrator, error, compensated)
        !! The method called `name`, with compensated sums if that is asked for.
        character(*), intent(in) :: name
        class(integrator_t), allocatable, intent(out) :: integrator
        type(error_t), allocatable, intent(out) :: error
        logical, intent(in), optional :: compensated
        class(integrator_t), allocatable :: plain
        integer :: i

        i = 0
        do
            i = i + 1
            call nth_integrator(i, integrator)
            if (.not. allocated(integrator)) exit
            if (integrator%name == name) exit
        end do
        if (.not. allocated(integrator)) then
            call refuse_name("method", name, method_names(), error)
            error%key = "method"
            return
        end if
        if (.not. present(compensated)) return
        if (.not. compensated) return
        call move_alloc(integrator, plain)
        call plain%compensated(integrator)
        if (allocated(integrator)) return
        call fail(error, name//" has no compensated sums; these have: "// &
                  join(compensated_names(), ", "), key="compensated")
    end subroutine new_integrator

    subroutine prepare_integrator(integrator, system, error)
        !! `prepare`; a refusal also names the methods that work.
        class(integrator_t), intent(inout) :: integrator
        class(system_t), intent(in) :: system
        type(error_t), allocatable, intent(out) :: error
        class(integrator_t), allocatable :: other
        type(error_t), allocatable :: refusal
        character(name_length), allocatable :: names(:)
        integer :: i

        call integrator%prepare(system, error)
        if (.not. allocated(error)) return
        allocate (names(0))
        i = 0
        do
            i = i + 1
            call nth_integrator(i, other)
            if (.not. allocated(other)) exit
            call other%prepare(system, refusal)
            if (.not. allocated(refusal)) names = [character(name_length) :: names, other%name]
        end do
        error%message = error%message//"; these methods work: "//join(names, ", ")
    end subroutine prepare_integrator

    function method_names() result(names)
        !! The names of all methods.
        character(name_length), allocatable :: names(:)
        class(integrator_t), allocatable :: integrator
        integer :: i

        allocate (names(0))
        i = 0
        do
            i = i + 1
            call nth_integrator(i, integrator)
            if (.not. allocated(integrator)) exit
            names = [character(name_length) :: names, integrator%name]
        end do
    end function method_names

    function compensated_names() result(names)
        !! The names of the methods that have compensated sums.
        character(name_length), allocatable :: names(:)
        class(integrator_t), allocatable :: integrator, variant
        integer :: i

        allocate (names(0))
        i = 0
        do
            i = i + 1
            call nth_integrator(i, integrator)
            if (.not. allocated(integrator)) exit
            call integrator%compensated(variant)
            if (allocated(variant)) names = [character(name_length) :: names, variant%name]
        end do
    end function compensated_names
end module lagrangia_methods
