module lagrangia_step_warning
    !! A step with which a scene would blow up, known before it runs.
    use lagrangia_errors, only: error_t
    use lagrangia_integrator, only: integrator_t
    use lagrangia_kinds, only: dp
    use lagrangia_methods, only: new_integrator
    use lagrangia_scene, only: scene_t
    use lagrangia_small_oscillations, only: find_modes, is_oscillation, likely_equilibrium, modes_t
    use lagrangia_system, only: system_t
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: step_warning

contains

    function step_warning(scene, system) result(text)
        !! A line for the user where the method has a known limit, the system an equilibrium, and
        !! the fastest oscillation about it is too fast for `dt`; else nothing, and no modes are
        !! looked for where the method has no limit. Of splitting methods the limit is known only
        !! without gyroscopic forces.
        type(scene_t), intent(in) :: scene  !! its step is looked at
        class(system_t), intent(in) :: system  !! with the scene's parameters
        character(:), allocatable :: text
        class(integrator_t), allocatable :: method
        type(error_t), allocatable :: error
        type(modes_t) :: modes
        real(dp) :: omega

        text = ""
        if (scene%tolerance > 0.0_dp) return
        call new_integrator(trim(scene%method), method, error)
        if (allocated(error)) return
        if (method%step_limit <= 0.0_dp) return
        call find_modes(system, likely_equilibrium(system), .false., modes, error)
        if (allocated(error)) return
        if (method%reversible .and. any(abs(modes%gyroscopic) > 0.0_dp)) return
        omega = sqrt(maxval([0.0_dp, pack(modes%omega2, modes%label == is_oscillation)]))
        if (.not. scene%dt*omega > method%step_limit) return
        text = "dt = "//to_text(scene%dt)//" s exceeds the step limit "// &
               rounded(method%step_limit/omega)//" s of "//trim(method%name)//" ("// &
               rounded(method%step_limit)//"/omega_max, omega_max = "//rounded(omega)// &
               " rad/s): small oscillations would grow at every step"
    end function step_warning

    pure function rounded(number) result(text)
        !! With four digits.
        real(dp), intent(in) :: number
        character(:), allocatable :: text
        character(12) :: buffer
        real(dp) :: near

        write (buffer, "(ss, es12.3e3)") number
        read (buffer, *) near
        text = to_text(near)
    end function rounded
end module lagrangia_step_warning
