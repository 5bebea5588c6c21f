module lagrangia_contestants
    !! Everybody who takes part: all methods of the catalogue, GSL's, and the closed forms. What is
    !! listed in the catalogue tomorrow is measured tomorrow.
    use lagrangia_contestant, only: contestant_box_t
    use lagrangia_description, only: name_length
    use lagrangia_gsl_contestants, only: gsl_contestant_t, new_gsl_contestant
    use lagrangia_gsl_odeiv, only: gsl_methods
    use lagrangia_integrator, only: dense_integrator_t, integrator_t
    use lagrangia_methods, only: nth_adaptive, nth_integrator
    use lagrangia_our_contestants, only: adaptive_contestant_t, fixed_contestant_t, &
        formula_contestant_t, new_adaptive_contestant, new_fixed_contestant, new_formula_contestant
    implicit none (type, external)
    private
    public :: contestant_names, new_contestants

contains

    subroutine new_contestants(chosen, boxes)
        !! Those whose names are in `chosen`; all if that is empty. A method that can do both comes
        !! twice, at a fixed step and by its tolerance.
        character(*), intent(in) :: chosen(:)
        type(contestant_box_t), allocatable, intent(out) :: boxes(:)
        class(integrator_t), allocatable :: method
        class(dense_integrator_t), allocatable :: adaptive
        type(contestant_box_t), allocatable :: room(:)
        integer :: i, n

        allocate (room(100))
        n = 0
        i = 0
        do
            i = i + 1
            call nth_integrator(i, method)
            if (.not. allocated(method)) exit
            if (wanted(method%name)) call add_fixed()
        end do
        i = 0
        do
            i = i + 1
            call nth_adaptive(i, adaptive)
            if (.not. allocated(adaptive)) exit
            if (wanted(adaptive%name)) call add_adaptive()
        end do
        do i = 1, size(gsl_methods)
            call add_gsl(trim(gsl_methods(i)))
        end do
        call add_formula()
        allocate (boxes(n))
        do i = 1, n
            call move_alloc(room(i)%item, boxes(i)%item)
        end do
    contains
        function wanted(name)
            character(*), intent(in) :: name
            logical :: wanted

            wanted = size(chosen) == 0 .or. any(chosen == name)
        end function wanted

        subroutine add_fixed()
            type(fixed_contestant_t) :: contestant

            call new_fixed_contestant(contestant, method)
            n = n + 1
            allocate (room(n)%item, source=contestant)
        end subroutine add_fixed

        subroutine add_adaptive()
            type(adaptive_contestant_t) :: contestant

            call new_adaptive_contestant(contestant, adaptive)
            n = n + 1
            allocate (room(n)%item, source=contestant)
        end subroutine add_adaptive

        subroutine add_gsl(name)
            character(*), intent(in) :: name
            type(gsl_contestant_t) :: contestant

            if (.not. wanted("gsl_"//name)) return
            call new_gsl_contestant(contestant, name)
            n = n + 1
            allocate (room(n)%item, source=contestant)
        end subroutine add_gsl

        subroutine add_formula()
            type(formula_contestant_t) :: contestant

            if (.not. wanted("closed_form")) return
            call new_formula_contestant(contestant)
            n = n + 1
            allocate (room(n)%item, source=contestant)
        end subroutine add_formula
    end subroutine new_contestants

    function contestant_names() result(names)
        !! All names that may be chosen, each once.
        character(name_length), allocatable :: names(:)
        type(contestant_box_t), allocatable :: boxes(:)
        character(name_length) :: found(100)
        integer :: i, n

        call new_contestants([character(name_length) ::], boxes)
        n = 0
        do i = 1, size(boxes)
            if (any(found(:n) == boxes(i)%item%name)) cycle
            n = n + 1
            found(n) = boxes(i)%item%name
        end do
        allocate (names, source=found(:n))
    end function contestant_names
end module lagrangia_contestants
