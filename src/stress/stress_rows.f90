module lagrangia_stress_rows
    !! The rows of `lagrangia stress`: their names, what they mean, and who measures them.
    use lagrangia_description, only: name_length
    use lagrangia_energy_growth, only: judge_energy_growth
    use lagrangia_errors, only: error_t
    use lagrangia_integrator, only: integrator_t
    use lagrangia_kinds, only: i8
    use lagrangia_methods, only: nth_integrator
    use lagrangia_observer, only: observer_t
    use lagrangia_step_limits, only: judge_step_limit
    use lagrangia_verdicts, only: verdicts_t
    use lagrangia_work_precision, only: look_around
    implicit none (type, external)
    private
    public :: row_t, measure_row, rows

    type :: row_t
        character(name_length) :: name = ""
        character(100) :: title = ""
        character(100) :: meaning(2) = ""  !! for a student
    end type row_t

    type(row_t), parameter :: rows(*) = [ &
        row_t("step_limits", "the longest step, in units of 1/omega, that does not blow up", &
              [character(100) :: "A longer step multiplies the fastest oscillation at every step, "// &
               "however slow the motion that", "you look at: the fastest mode decides "// &
               "(2/omega for Verlet, 2.83/omega for RK4)."]), &
        row_t("energy_growth", "energy error of a long run: its law, fitted", &
              [character(100) :: "Symplectic methods keep the energy near its value for ever, "// &
               "others lose a little at every step.", "Where the method is nearly exact, "// &
               "rounding remains: a random walk, the root of the steps."])]

contains

    subroutine measure_row(name, long, watcher, verdicts, error)
        !! All lines of the row `name`. Fails where it is interrupted.
        character(*), intent(in) :: name
        logical, intent(in) :: long  !! up to an hour
        class(observer_t), pointer, intent(in) :: watcher
        type(verdicts_t), intent(inout) :: verdicts
        type(error_t), allocatable, intent(out) :: error
        class(integrator_t), allocatable :: method
        integer :: i

        call verdicts%begin(name)
        i = 0
        do
            i = i + 1
            call nth_integrator(i, method)
            if (.not. allocated(method)) exit
            call look_around(watcher, min(i, 20), 20, error)
            if (allocated(error)) return
            select case (name)
            case ("step_limits")
                call judge_step_limit(method, 100000_i8, verdicts)
            case ("energy_growth")
                call judge_energy_growth(method, merge(4000000000_i8, 50000000_i8, &
                                                       long), verdicts)
            end select
        end do
    end subroutine measure_row
end module lagrangia_stress_rows
