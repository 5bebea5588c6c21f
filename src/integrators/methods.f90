module lagrangia_methods
    !! The table of methods, fixed and adaptive: the only module that knows every integrator. Of a
    !! name that is in both, `dt` or `tolerance` in a scene says which is meant.
    use lagrangia_boris, only: boris_t, new_boris
    use lagrangia_canonical, only: midpoint_t, new_midpoint, new_stormer_verlet, stormer_verlet_t
    use lagrangia_composition, only: nth_composition
    use lagrangia_description, only: name_length, title_length
    use lagrangia_dop853, only: dop853_t, new_dop853
    use lagrangia_errors, only: error_t, fail
    use lagrangia_gauss, only: gauss_t, new_gauss16
    use lagrangia_gauss_adaptive, only: gauss_adaptive_t, new_gauss16_adaptive
    use lagrangia_integrator, only: dense_integrator_t, integrator_t
    use lagrangia_names, only: refuse_name
    use lagrangia_rk4, only: new_rk4, rk4_t
    use lagrangia_system, only: system_t
    use lagrangia_text, only: join
    implicit none (type, external)
    private
    public :: new_integrator, nth_integrator, method_names, prepare_integrator
    public :: new_adaptive, nth_adaptive, adaptive_names, method_titles
    public :: auto, exact, workhorse

    character(*), parameter :: auto = "auto", exact = "exact"
    character(*), parameter :: workhorse = "gauss16"
    !! With `dt` and with `tolerance`, whatever the structure: `lagrangia bench` has it before
    !! the others on the double pendulum, cart-pendulum and pendulum at every error, on the
    !! oscillator from 1e-6 on; and a step costs no more than one of `blanes_moan6`.

contains

    subroutine nth_integrator(i, integrator)
        !! The methods of fixed step.
        integer, intent(in) :: i  !! from 1
        class(integrator_t), allocatable, intent(out) :: integrator  !! not allocated past the end
        integer, parameter :: others = 5
        type(rk4_t) :: rk4
        type(stormer_verlet_t) :: stormer_verlet
        type(midpoint_t) :: midpoint
        type(boris_t) :: boris
        type(gauss_t) :: gauss

        select case (i)
        case (1)
            call new_rk4(rk4)
            allocate (integrator, source=rk4)
        case (2)
            call new_stormer_verlet(stormer_verlet)
            allocate (integrator, source=stormer_verlet)
        case (3)
            call new_midpoint(midpoint)
            allocate (integrator, source=midpoint)
        case (4)
            call new_boris(boris)
            allocate (integrator, source=boris)
        case (5)
            call new_gauss16(gauss)
            allocate (integrator, source=gauss)
        case default
            call nth_composition(i - others, integrator)
        end select
    end subroutine nth_integrator

    subroutine nth_adaptive(i, integrator)
        !! The methods that choose their steps by a tolerance.
        integer, intent(in) :: i  !! from 1
        class(dense_integrator_t), allocatable, intent(out) :: integrator
        !! not allocated past the end
        type(gauss_adaptive_t) :: gauss
        type(dop853_t) :: dop853

        select case (i)
        case (1)
            call new_gauss16_adaptive(gauss)
            allocate (integrator, source=gauss)
        case (2)
            call new_dop853(dop853)
            allocate (integrator, source=dop853)
        case default
            return
        end select
    end subroutine nth_adaptive

    subroutine new_integrator(name, integrator, error, compensated)
        !! The method of fixed step that is called `name`.
        character(*), intent(in) :: name  !! as in a scene
        class(integrator_t), allocatable, intent(out) :: integrator  !! not yet prepared
        type(error_t), allocatable, intent(out) :: error  !! an unknown name, or no such sums
        logical, intent(in), optional :: compensated  !! with compensated sums; absent: without
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
            call refuse_name("method", name, method_names(), error, method_titles(method_names()))
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

    subroutine new_adaptive(name, integrator)
        !! The method by tolerance that is called `name`.
        character(*), intent(in) :: name  !! as in a scene
        class(dense_integrator_t), allocatable, intent(out) :: integrator  !! or not allocated
        integer :: i

        i = 0
        do
            i = i + 1
            call nth_adaptive(i, integrator)
            if (.not. allocated(integrator)) return
            if (integrator%name == name) return
        end do
    end subroutine new_adaptive

    subroutine prepare_integrator(integrator, system, error)
        !! `prepare`; a refusal also names the methods that work.
        class(integrator_t), intent(inout) :: integrator  !! gets ready
        class(system_t), intent(in) :: system             !! that it shall step
        type(error_t), allocatable, intent(out) :: error  !! its refusal
        class(dense_integrator_t), allocatable :: adaptive
        class(integrator_t), allocatable :: other
        type(error_t), allocatable :: refusal
        character(name_length), allocatable :: by_tolerance(:), names(:)
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
        allocate (by_tolerance(0))
        i = 0
        do
            i = i + 1
            call nth_adaptive(i, adaptive)
            if (.not. allocated(adaptive)) exit
            call adaptive%prepare(system, refusal)
            if (.not. allocated(refusal)) by_tolerance = [character(name_length) :: &
                by_tolerance, adaptive%name]
        end do
        error%message = error%message//"; these methods work: "//join(names, ", ")
        if (size(by_tolerance) > 0) error%message = error%message//", and with a tolerance "// &
            join(by_tolerance, ", ")
    end subroutine prepare_integrator

    function method_names() result(names)
        !! The names of the methods of fixed step.
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

    function method_titles(names) result(titles)
        !! What each of these methods is, in a few words; empty where it is none.
        character(*), intent(in) :: names(:)  !! of methods, fixed or adaptive
        character(title_length) :: titles(size(names))
        class(dense_integrator_t), allocatable :: adaptive
        class(integrator_t), allocatable :: integrator
        integer :: i, k

        titles = ""
        do i = 1, size(names)
            call new_adaptive(trim(names(i)), adaptive)
            if (allocated(adaptive)) titles(i) = adaptive%title
            k = 0
            do
                k = k + 1
                call nth_integrator(k, integrator)
                if (.not. allocated(integrator)) exit
                if (integrator%name == names(i)) titles(i) = integrator%title
            end do
        end do
    end function method_titles

    function adaptive_names() result(names)
        !! The names of the methods that choose their steps by a tolerance.
        character(name_length), allocatable :: names(:)
        class(dense_integrator_t), allocatable :: integrator
        integer :: i

        allocate (names(0))
        i = 0
        do
            i = i + 1
            call nth_adaptive(i, integrator)
            if (.not. allocated(integrator)) exit
            names = [character(name_length) :: names, integrator%name]
        end do
    end function adaptive_names

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
