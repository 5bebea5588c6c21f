module lagrangia_stress_measures
    !! From the name of a row to those who measure it.
    use lagrangia_bounces, only: judge_elastic, judge_zeno
    use lagrangia_catalogue, only: new_system
    use lagrangia_chaos, only: judge_chaos
    use lagrangia_edges_of_numbers, only: judge_edges
    use lagrangia_energy_growth, only: judge_energy_growth
    use lagrangia_errors, only: error_t
    use lagrangia_extreme_masses, only: judge_mass_ratios, judge_massless
    use lagrangia_integrator, only: dense_integrator_t, integrator_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_limits_of_systems, only: judge_slow_disk, judge_slow_wire, judge_wedge, &
                                           judge_weak_field
    use lagrangia_method_promises, only: judge_bytes, judge_reversal, judge_scaling, &
                                         judge_symplectic, judge_text
    use lagrangia_methods, only: new_adaptive, new_integrator, nth_integrator
    use lagrangia_observer, only: observer_t
    use lagrangia_pendulum_extremes, only: judge_large_angles, judge_separatrix
    use lagrangia_rounding, only: judge_rounding
    use lagrangia_step_limits, only: judge_step_limit
    use lagrangia_system, only: system_t
    use lagrangia_verdicts, only: verdicts_t
    use lagrangia_work_precision, only: look_around
    implicit none (type, external)
    private
    public :: measure_row

contains

    subroutine measure_row(name, long, watcher, verdicts, error)
        !! All lines of the row `name`. Fails where it is interrupted.
        character(*), intent(in) :: name
        logical, intent(in) :: long  !! up to an hour
        class(observer_t), pointer, intent(in) :: watcher
        type(verdicts_t), intent(inout) :: verdicts
        type(error_t), allocatable, intent(out) :: error
        class(system_t), allocatable :: system
        class(integrator_t), allocatable :: method
        class(dense_integrator_t), allocatable :: dense, other

        call verdicts%begin(name)
        call new_adaptive("gauss16", dense)
        dense%tolerance = 1e-13_dp
        select case (name)
        case ("rounding")
            call measure_sums("verlet")
        case ("near_separatrix", "large_angles")
            call new_system("pendulum", system, error)
            if (name == "near_separatrix") call judge_separatrix(system, dense, verdicts)
            if (name == "large_angles") call judge_large_angles(system, dense, verdicts)
        case ("mass_ratios", "massless", "chaos")
            call new_system("double_pendulum", system, error)
            if (name == "mass_ratios") call judge_mass_ratios(system, dense, 0.01_dp, verdicts)
            if (name == "massless") call judge_massless(system, verdicts)
            if (name /= "chaos") return
            call new_adaptive("dop853", other)
            call judge_chaos(system, dense, other, 100.0_dp, verdicts)
        case ("wedge_angles")
            call new_system("wedge", system, error)
            call judge_wedge(system, verdicts)
        case ("slow_rotation")
            call new_system("rotating_wire", system, error)
            call judge_slow_wire(system, verdicts)
            call new_system("rolling_disk", system, error)
            call judge_slow_disk(system, verdicts)
            call new_system("charged_particle", system, error)
            call judge_weak_field(system, verdicts)
        case ("elastic", "zeno")
            call new_system("bouncing_ball", system, error)
            if (name == "elastic") call judge_elastic(system, dense, verdicts)
            if (name == "zeno") call judge_zeno(system, dense, verdicts)
        case ("edges_of_numbers")
            call new_integrator("rk4", method, error)
            call judge_edges(method, verdicts)
        case default
            call measure_methods()
            if (name == "same_bytes" .and. .not. allocated(error)) call judge_text(verdicts)
        end select
    contains
        subroutine measure_methods()
            !! A row of all methods of fixed step.
            integer :: i

            i = 0
            do
                i = i + 1
                call nth_integrator(i, method)
                if (.not. allocated(method)) return
                call look_around(watcher, min(i, 20), 20, error)
                if (allocated(error)) return
                select case (name)
                case ("step_limits"); call judge_step_limit(method, 100000_i8, verdicts)
                case ("reversal"); call judge_reversal(method, verdicts)
                case ("symplectic"); call judge_symplectic(method, verdicts)
                case ("same_bytes"); call judge_bytes(method, verdicts)
                case ("scaling"); call judge_scaling(method, verdicts)
                case default
                    call judge_energy_growth(method, merge(4000000000_i8, 50000000_i8, long), &
                                             verdicts)
                end select
            end do
        end subroutine measure_methods

        subroutine measure_sums(name)
            !! With plain sums and compensated ones; ten times as far the error is only told.
            character(*), intent(in) :: name
            integer(i8), parameter :: steps(2) = [10000000_i8, 100000000_i8]
            class(integrator_t), allocatable :: variant
            integer :: i

            do i = 1, merge(2, 1, long)
                call look_around(watcher, i, 2, error)
                if (allocated(error)) return
                call new_integrator(name, variant, error)
                call judge_rounding(variant, "plain", steps(i), verdicts)
                call new_integrator(name, variant, error, compensated=.true.)
                call judge_rounding(variant, "compensated", steps(i), verdicts)
            end do
        end subroutine measure_sums
    end subroutine measure_row
end module lagrangia_stress_measures
