module lagrangia_adaptive_methods
    !! Names and types of the methods that choose their steps by a tolerance. A name may also be
    !! one of the fixed methods: then `dt` or `tolerance` in a scene says which is meant.
    use lagrangia_description, only: name_length
    use lagrangia_dop853, only: dop853_t, new_dop853
    use lagrangia_gauss_adaptive, only: gauss_adaptive_t, new_gauss16_adaptive
    use lagrangia_integrator, only: dense_integrator_t
    implicit none (type, external)
    private
    public :: nth_adaptive, new_adaptive, adaptive_names

contains

    subroutine nth_adaptive(i, integrator)
        !! Entry `i`; not allocated beyond the end.
        integer, intent(in) :: i
        class(dense_integrator_t), allocatable, intent(out) :: integrator

        select case (i)
        case (1); call place_gauss16()
        case (2); call place_dop853()
        case default; return
        end select
    contains
        subroutine place_gauss16()
            type(gauss_adaptive_t) :: method

            call new_gauss16_adaptive(method)
            allocate (integrator, source=method)
        end subroutine place_gauss16

        subroutine place_dop853()
            type(dop853_t) :: method

            call new_dop853(method)
            allocate (integrator, source=method)
        end subroutine place_dop853
    end subroutine nth_adaptive

    subroutine new_adaptive(name, integrator)
        !! The method called `name`; not allocated if there is none.
        character(*), intent(in) :: name
        class(dense_integrator_t), allocatable, intent(out) :: integrator
        integer :: i

        i = 0
        do
            i = i + 1
            call nth_adaptive(i, integrator)
            if (.not. allocated(integrator)) return
            if (integrator%name == name) return
        end do
    end subroutine new_adaptive

    function adaptive_names() result(names)
        !! The names of all of them.
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
end module lagrangia_adaptive_methods
