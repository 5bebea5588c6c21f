module lagrangia_sweep_warning
    !! Steps of fixed length with which trajectories at the edge of a sweep would blow up.
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_scene, only: scene_t
    use lagrangia_step_warning, only: step_warning
    use lagrangia_sweep, only: sweep_t
    use lagrangia_system, only: system_t
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: corner_warning

contains

    function corner_warning(sweep) result(text)
        !! A line for the user, of the first of the grid's corners whose parameters make the step
        !! too long; else nothing.
        type(sweep_t), intent(in) :: sweep  !! as `new_sweep` made it
        character(:), allocatable :: text
        class(system_t), allocatable :: system
        type(error_t), allocatable :: error
        type(scene_t) :: scene
        integer(i8) :: places(size(sweep%axes))
        integer :: corner, i

        text = ""
        if (sweep%scene%tolerance > 0.0_dp) return
        scene = sweep%scene
        if (.not. any(sweep%axes%is_parameter())) then
            text = step_warning(scene, sweep%system)
            return
        end if
        do corner = 0, 2**size(sweep%axes) - 1
            do i = 1, size(sweep%axes)
                places(i) = sweep%axes(i)%lowest()
                if (btest(corner, i - 1)) places(i) = sweep%axes(i)%highest()
                call sweep%axes(i)%set(places(i), scene%q, scene%v, scene%parameters)
            end do
            if (allocated(system)) deallocate (system)
            allocate (system, source=sweep%system)
            call system%configure(scene%parameters, error)
            if (allocated(error)) cycle
            text = step_warning(scene, system)
            if (text == "") cycle
            do i = size(sweep%axes), 1, -1
                if (.not. sweep%axes(i)%is_parameter()) cycle
                text = trim(sweep%axes(i)%name)//" = "// &
                       to_text(sweep%axes(i)%value(places(i)))//": "//text
            end do
            return
        end do
    end function corner_warning
end module lagrangia_sweep_warning
