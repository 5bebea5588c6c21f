module lagrangia
    !! The public face of the toolkit, for other people's programs. Defines nothing.
    !!
    !! A program with your own systems beside the lectures' is `call register_system(mine, error)`
    !! and `call lagrangia_main(error)`: see `docs/your_own_system.md`. Small oscillations of your
    !! own matrices are `call normal_modes(k, m, modes, error)`: see `data/examples/normal_modes`;
    !! those of a system `call find_modes(system, q, wanted, modes, error)`.
    !!
    !! The motion of a system at given times, as arrays (`data/examples/solve`; steps of one length
    !! with `dt`, events as in a scene; `found` keeps them):
    !!
    !!     program cart
    !!         use lagrangia, only: dp, error_t, new_system, solve, system_t
    !!         implicit none (type, external)
    !!         class(system_t), allocatable :: system
    !!         type(error_t), allocatable :: error
    !!         real(dp), allocatable :: q(:, :), v(:, :)
    !!         real(dp) :: t(0:10)
    !!         integer :: i
    !!
    !!         call new_system("cart_pendulum", system, error)
    !!         if (allocated(error)) error stop error%message
    !!         call system%configure([2.0_dp, 1.0_dp, 1.0_dp, 9.81_dp], error)  ! m1, m2, l, g
    !!         if (allocated(error)) error stop error%message
    !!         t = [(0.1_dp*i, i=0, 10)]
    !!         call solve(system, "gauss16", t, [0.0_dp, 1.0_dp], [0.0_dp, 0.0_dp], q, v, error)
    !!         if (allocated(error)) error stop error%message
    !!         do i = 0, 10
    !!             print "(f4.1, 2f12.8)", t(i), q(:, i + 1)
    !!         end do
    !!     end program cart
    use lagrangia_catalogue, only: new_system, register_system, system_names
    use lagrangia_description, only: between, conserved, constraint_length, coordinate, &
                                     description_t, formula_length, frequency_t, letter_t, &
                                     line_length, mass_point, nonnegative, parameter_t, &
                                     point_t, positive, quantity, quantity_t, real_number, &
                                     real_vector, whole_number
    use lagrangia_eigen, only: residual_ratio
    use lagrangia_errors, only: error_t, fail
    use lagrangia_generalised_forces, only: momentum_rates
    use lagrangia_hyperdual, only: abs, assignment(=), atan, cos, cosh, dot_product, exp, &
                                   hyperdual, hyperdual_t, log, operator(*), operator(**), &
                                   operator(+), operator(-), operator(/), operator(<), &
                                   operator(>), sgn, sin, sinh, sqrt, sum, tan, tanh
    use lagrangia_integrator, only: dense_integrator_t, integrator_t
    use lagrangia_kinds, only: dp, i8, lanes
    use lagrangia_lagrange, only: accelerations_from_lagrangian, energy_from_lagrangian, &
                                  energy_rate, euler_lagrange_t, expand_lagrangian
    use lagrangia_lagrangian_system, only: lagrangian_system_t
    use lagrangia_methods, only: method_names, new_integrator
    use lagrangia_normal_modes, only: is_oscillation, is_unstable, is_zero_mode, normal_modes, &
                                      normal_modes_t
    use lagrangia_observer, only: observer_box_t, observer_t
    use lagrangia_program, only: lagrangia_main
    use lagrangia_recorder, only: recorder_t
    use lagrangia_reference, only: reference_t
    use lagrangia_sine_cosine, only: sine_cosine
    use lagrangia_small_oscillations, only: find_modes, modes_t
    use lagrangia_solve, only: solve
    use lagrangia_system, only: check_parameters, default_values, reduced_t, system_t
    implicit none (type, external)
    public
end module lagrangia
