module lagrangia_step_warning
    !! A step with which a scene would blow up, known before it runs.
    use lagrangia_errors, only: error_t
    use lagrangia_integrator, only: integrator_t
    use lagrangia_kinds, only: dp
    use lagrangia_methods, only: new_integrator
    use lagrangia_number_class, only: is_nonzero
    use lagrangia_number_text, only: rounded
    use lagrangia_scene, only: scene_t
    use lagrangia_small_oscillations, only: find_modes, is_oscillation, likely_equilibrium, modes_t
    use lagrangia_system, only: system_t
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: step_warning

    integer, parameter :: many = 32  !! coordinates, whose modes take longer than many a run

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
        if (system%ndof > many) then
            if (all_slower(system, method%step_limit/scene%dt)) return
        end if
        call find_modes(system, likely_equilibrium(system), .false., modes, error)
        if (allocated(error)) return
        if (method%reversible .and. any(is_nonzero(modes%gyroscopic))) return
        omega = sqrt(maxval([0.0_dp, pack(modes%omega2, modes%label == is_oscillation)]))
        if (.not. scene%dt*omega > method%step_limit) return
        text = "dt = "//to_text(scene%dt)//" s exceeds the step limit "// &
               rounded(method%step_limit/omega, 4)//" s of "//trim(method%name)//" ("// &
               rounded(method%step_limit, 4)//"/omega_max, omega_max = "//rounded(omega, 4)// &
               " rad/s): small oscillations would grow at every step"
    end function step_warning

    function all_slower(system, fastest) result(yes)
        !! Whether all oscillations are slower than `fastest`, rad/s, by a bound that needs no
        !! modes: where the likely equilibrium is one and no force there depends on velocities, the
        !! \(-\omega^2\) are eigenvalues of \(\partial a/\partial q\), none of which is larger than
        !! the largest sum of absolute values in a row. Central differences give that to 1e-9, if
        !! the accelerations are smooth within `width`; 1 % is taken for it.
        class(system_t), intent(in) :: system  !! with the scene's parameters
        real(dp), intent(in) :: fastest
        logical :: yes
        real(dp), parameter :: width = 1e-5_dp, margin = 1.01_dp
        real(dp), dimension(system%ndof) :: q, v, above, below, at_rest, row
        real(dp) :: here
        integer :: k

        yes = .false.
        q = likely_equilibrium(system)
        v = 0.0_dp
        row = 0.0_dp
        call system%accelerations(0.0_dp, q, v, at_rest)
        if (system%time_dependent .or. any(is_nonzero(at_rest))) return
        do k = 1, system%ndof
            here = q(k)
            q(k) = here + width
            call system%accelerations(0.0_dp, q, v, above)
            q(k) = here - width
            call system%accelerations(0.0_dp, q, v, below)
            q(k) = here
            row = row + abs(above - below)/(2.0_dp*width)
            v(k) = width
            call system%accelerations(0.0_dp, q, v, above)
            v(k) = 0.0_dp
            if (any(is_nonzero(above))) return
        end do
        yes = margin*sqrt(maxval(row)) < fastest
    end function all_slower
end module lagrangia_step_warning
