module lagrangia_stress_rows
    !! The rows of `lagrangia stress`: their names, what they mean for a student, and who measures
    !! them.
    use lagrangia_bounces, only: stress_elastic, stress_zeno
    use lagrangia_catalogue, only: new_system
    use lagrangia_chaos, only: stress_chaos
    use lagrangia_description, only: name_length
    use lagrangia_edges_of_numbers, only: stress_edges
    use lagrangia_energy_growth, only: stress_energy_growth, stress_rounding
    use lagrangia_errors, only: error_t
    use lagrangia_integrator, only: dense_integrator_t, integrator_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_ledger, only: ledger_t
    use lagrangia_limits_of_systems, only: stress_slow_disk, stress_slow_wire, stress_wedge, &
                                           stress_weak_field
    use lagrangia_method_promises, only: stress_bytes, stress_reversal, stress_scaling, &
                                         stress_symplectic, stress_text
    use lagrangia_methods, only: method_names, new_adaptive, new_integrator, &
                                  nth_integrator
    use lagrangia_observer, only: observer_t
    use lagrangia_part, only: part_t
    use lagrangia_pendulum_extremes, only: stress_large_angles, stress_mass_ratios, &
                                           stress_massless, stress_separatrix
    use lagrangia_step_limits, only: stress_step_limit
    use lagrangia_system, only: system_t
    use lagrangia_work_precision, only: look_around
    implicit none (type, external)
    private
    public :: row_t, measure_row, rows

    integer, parameter :: wide = 96

    type :: row_t
        character(name_length) :: name = ""
        character(wide) :: title = ""
        character(2*wide) :: meaning = ""
    end type row_t

    type(row_t), parameter :: rows(*) = [ &
        row_t("step_limits", "the longest step, in units of 1/omega, that does not blow up", &
              "A longer step multiplies the fastest oscillation every time, however slow the "// &
              "motion that you look at: 2/omega for Verlet, 2.83/omega for RK4."), &
        row_t("energy_growth", "energy error of a long run: its law, fitted", &
              "A symplectic method keeps the energy near its value for exponentially long, if "// &
              "steps are small; RK4 loses some at each. Of a nearly exact one rounding is "// &
              "left: a random walk, sqrt(N)."), &
        row_t("rounding", "Verlet on the oscillator: what rounding alone does in 10^7 steps", &
              "Every sum is rounded, by half a unit in the last place at most; compensated "// &
              "sums (compensated = .true.) carry that along."), &
        row_t("reversal", "time reversal: as many steps back as forth", &
              "Newton's equations run backwards as well. A method that does, too, loses no "// &
              "energy steadily on an orbit that is its own mirror image in time; on others "// &
              "it may."), &
        row_t("symplectic", "the Jacobian J of a step, W the symplectic matrix", &
              "J'WJ = W is Liouville's theorem and more: a step is a canonical transformation."), &
        row_t("same_bytes", "the same bits, however often a run is looked at", &
              "Results do not depend on output: you can change every, columns and formats."), &
        row_t("scaling", "other units of mass, length and time, by powers of two", &
              "Mechanics does not know units; in binary, powers of two are exact, so that not "// &
              "one digit may change."), &
        row_t("near_separatrix", "a pendulum released 10^-k below the top", &
              "It waits at the top ever longer, and each power of ten costs a run a digit; the "// &
              "closed form, by the arithmetic-geometric mean, keeps them all."), &
        row_t("large_angles", "a pendulum after many turns", &
              "An angle of 1e6 rad has ten digits behind the point: no method gives back the "// &
              "rest."), &
        row_t("mass_ratios", "double pendulums whose bobs differ by up to 10^12", &
              "An ordinary eigenvalue solver loses the slow mode beside a fast one; from the "// &
              "factors of M and K both have all digits. The motion becomes a simple pendulum's."), &
        row_t("massless", "m1 -> 0 in the double pendulum", &
              "A bob without mass oscillates infinitely fast: its limit is a stiff problem, "// &
              "and not the problem without the bob."), &
        row_t("wedge_angles", "a block on a wedge: alpha -> 0 and pi/2", &
              "Flat: nothing slides; upright: free fall. The formula holds at both ends."), &
        row_t("slow_rotation", "omega -> 0 and B -> 0 in closed forms that divide by them", &
              "0/0 in the textbook; rewritten with sin(x)/x it loses no digit on the way to a "// &
              "straight line."), &
        row_t("elastic", "a ball that hardly loses speed: e -> 1", &
              "(1 - e^n)/(1 - e) becomes n; events are found to the last digits every time."), &
        row_t("zeno", "infinitely many bounces in a finite time", &
              "The sum of the flights is finite; a run must pass it, and rest, not hang."), &
        row_t("chaos", "the double pendulum from (2, 1) rad: errors grow exponentially", &
              "No step size helps: digits are lost, on average at a steady rate, and the time "// &
              "after which none is left is part of the result."), &
        row_t("edges_of_numbers", "denormals, overflow, NaN (RK4)", &
              "A run that leaves the numbers says so, with the last good state, and status 3.")]

contains

    subroutine measure_row(name, long, watcher, verdicts, error)
        !! All lines of the row `name`. Fails where it is interrupted.
        character(*), intent(in) :: name  !! of `rows`
        logical, intent(in) :: long  !! up to an hour
        class(observer_t), pointer, intent(in) :: watcher  !! told how far it is; may be null
        type(ledger_t), intent(inout) :: verdicts  !! gets the lines
        type(error_t), allocatable, intent(out) :: error  !! allocated where it fails
        class(system_t), allocatable :: system
        class(integrator_t), allocatable :: method
        class(dense_integrator_t), allocatable :: dense, other
        type(part_t) :: part

        call verdicts%section(name)
        part%whole => watcher
        call new_adaptive("gauss16", dense)
        dense%tolerance = 1e-13_dp
        select case (name)
        case ("rounding")
            call measure_sums("verlet")
        case ("near_separatrix", "large_angles")
            call new_system("pendulum", system, error)
            if (name == "near_separatrix") call stress_separatrix(system, dense, verdicts)
            if (name == "large_angles") call stress_large_angles(system, dense, verdicts)
        case ("mass_ratios", "massless", "chaos")
            call new_system("double_pendulum", system, error)
            if (name == "mass_ratios") call stress_mass_ratios(system, dense, 0.01_dp, &
                                                                 verdicts, part)
            if (name == "massless") call stress_massless(system, verdicts)
            if (name /= "chaos") return
            call new_adaptive("dop853", other)
            call stress_chaos(system, dense, other, 100.0_dp, verdicts)
        case ("wedge_angles")
            call new_system("wedge", system, error)
            call stress_wedge(system, verdicts)
        case ("slow_rotation")
            call new_system("rotating_wire", system, error)
            call stress_slow_wire(system, verdicts)
            call new_system("rolling_disk", system, error)
            call stress_slow_disk(system, verdicts)
            call new_system("charged_particle", system, error)
            call stress_weak_field(system, verdicts)
        case ("elastic", "zeno")
            call new_system("bouncing_ball", system, error)
            if (name == "elastic") call stress_elastic(system, dense, verdicts)
            if (name == "zeno") call stress_zeno(system, dense, verdicts)
        case ("edges_of_numbers")
            call new_integrator("rk4", method, error)
            call stress_edges(method, verdicts)
        case default
            call measure_methods()
            if (name == "same_bytes" .and. .not. allocated(error)) call stress_text(verdicts)
        end select
    contains
        subroutine measure_methods()
            !! A row of all methods of fixed step.
            integer :: i, methods

            methods = size(method_names())
            i = 0
            do
                i = i + 1
                call nth_integrator(i, method)
                if (.not. allocated(method)) return
                part%from = min(i - 1.0_dp, methods - 1.0_dp)/methods
                part%to = part%from + 1.0_dp/methods
                call look_around(watcher, min(i, methods) - 1, methods, error)
                if (allocated(error)) return
                select case (name)
                case ("step_limits"); call stress_step_limit(method, 100000_i8, verdicts)
                case ("reversal"); call stress_reversal(method, verdicts)
                case ("symplectic"); call stress_symplectic(method, verdicts)
                case ("same_bytes"); call stress_bytes(method, verdicts)
                case ("scaling"); call stress_scaling(method, verdicts)
                case default
                    call stress_energy_growth(method, merge(4000000000_i8, 50000000_i8, long), &
                                             verdicts, part)
                end select
            end do
        end subroutine measure_methods

        subroutine measure_sums(name)
            !! With plain sums and compensated ones; ten times as far the error is only told.
            character(*), intent(in) :: name
            integer(i8), parameter :: steps(2) = [10000000_i8, 100000000_i8]
            class(integrator_t), allocatable :: variant
            character(11), parameter :: sums(2) = ["plain      ", "compensated"]
            integer :: i, k

            part%to = 0.0_dp
            do i = 1, merge(2, 1, long)
                do k = 1, 2
                    part%from = part%to
                    part%to = part%from + 0.5_dp*steps(i)/sum(steps(:merge(2, 1, long)))
                    call look_around(watcher, nint(100*part%from), 100, error)
                    if (allocated(error)) return
                    call new_integrator(name, variant, error, compensated=k == 2)
                    call stress_rounding(variant, trim(sums(k)), steps(i), verdicts, part)
                end do
            end do
        end subroutine measure_sums
    end subroutine measure_row
end module lagrangia_stress_rows
