module lagrangia_goals
    !! What the toolkit set out to reach on single trajectories, beside what was measured.
    use lagrangia_bench_table, only: bench_table_t, new_bench_table, number_cell, short, &
                                     word_cell
    use lagrangia_contestant, only: party_closed_form, party_gsl, party_ours
    use lagrangia_description, only: name_length
    use lagrangia_energy_bench, only: long_run_steps
    use lagrangia_kinds, only: dp
    use lagrangia_precision_curve, only: best, not_known, ratio
    use lagrangia_precision_tables, only: best_time, least_error
    use lagrangia_work_precision, only: curve_t
    implicit none (type, external)
    private
    public :: goals_of_dispatch, goals_of_energy, goals_of_growth, goals_of_modes, &
              goals_of_output, goals_of_precision, new_goals

    character(*), parameter :: rival = "gsl_rk8pd"

    type :: race_t
        !! Best of ours over GSL's rk8pd, to an error.
        character(4) :: problem
        real(dp) :: error, goal
    end type race_t

    type(race_t), parameter :: races(*) = [ &
        race_t("P1", 1e-6_dp, 0.5_dp), race_t("P1", 1e-9_dp, 0.25_dp), &
        race_t("P1", 1e-12_dp, 0.15_dp), race_t("P1a", 1e-9_dp, 0.25_dp), &
        race_t("P2", 1e-9_dp, 0.25_dp), race_t("P3", 1e-9_dp, 0.12_dp)]

contains

    pure subroutine new_goals(table)
        !! No goals yet.
        type(bench_table_t), intent(out) :: table

        call new_bench_table(table, "goals", "what to reach", [character(name_length) :: "work", &
                             "measured", "goal", "verdict"])
    end subroutine new_goals

    pure subroutine judge(table, work, measured, goal)
        !! One row; the goal is not to be above.
        type(bench_table_t), intent(inout) :: table
        character(*), intent(in) :: work
        real(dp), intent(in) :: measured, goal
        character(12) :: verdict

        verdict = "not measured"
        if (measured > goal) verdict = "NOT reached"
        if (measured <= goal) verdict = "reached"
        call table%add([word_cell(work), number_cell(measured, 3), number_cell(goal, 3), &
                        word_cell(verdict)])
    end subroutine judge

    pure subroutine goals_of_precision(curves, table)
        !! Races by stepping, and closed forms.
        type(curve_t), intent(in) :: curves(:)
        type(bench_table_t), intent(inout) :: table
        type(race_t) :: r
        integer :: i

        do i = 1, size(races)
            r = races(i)
            if (.not. any(curves%problem == r%problem)) cycle
            call judge(table, trim(r%problem)//" to "//short(r%error, 1)//", best of ours / "// &
                       rival, ratio(best_time(curves, r%problem, party_ours, r%error), &
                                    best_time(curves, r%problem, party_gsl, r%error, rival)), &
                       r%goal)
        end do
        if (any(curves%problem == "P3")) then
            call judge(table, "P3, lowest error by stepping", &
                       least_error(curves, "P3", party_ours), 1e-12_dp)
            call judge_formula(curves, "P3", 1e-13_dp, table)
        end if
        if (any(curves%problem == "P4")) call judge_formula(curves, "P4", 1e-14_dp, table)
    end subroutine goals_of_precision

    pure subroutine judge_formula(curves, problem, goal, table)
        !! Error and time of a closed form.
        type(curve_t), intent(in) :: curves(:)
        character(*), intent(in) :: problem
        real(dp), intent(in) :: goal
        type(bench_table_t), intent(inout) :: table

        call judge(table, problem//" by closed form, error", &
                   least_error(curves, problem, party_closed_form), goal)
        call judge(table, problem//" by closed form, us", &
                   1e6_dp*best_time(curves, problem, party_closed_form, 1.0_dp), 1.0_dp)
    end subroutine judge_formula

    pure subroutine goals_of_dispatch(dispatch, table)
        !! What the contracts cost.
        type(bench_table_t), intent(in) :: dispatch
        type(bench_table_t), intent(inout) :: table
        character(16), parameter :: systems(2) = ["double_pendulum ", "pendulum        "]
        integer :: i

        do i = 1, size(systems)
            call judge(table, "RK4 step, "//trim(systems(i))//", contracts / concrete", &
                       dispatch%value(systems(i), "contracts/concrete"), 1.15_dp)
            call judge(table, "RK4 step, "//trim(systems(i))//", contracts / gsl_rk4", &
                       dispatch%value(systems(i), "contracts/gsl"), 0.35_dp)
        end do
    end subroutine goals_of_dispatch

    pure subroutine goals_of_energy(energy, table)
        !! The best of ours in the long run.
        type(bench_table_t), intent(in) :: energy
        type(bench_table_t), intent(inout) :: table
        real(dp) :: least
        integer :: i

        least = not_known()
        do i = 1, energy%rows
            if (energy%row(i)%cells(3)%value < real(long_run_steps, dp)) cycle
            least = best([least, energy%row(i)%cells(4)%value])
        end do
        call judge(table, "energy error over 10^6 steps, best of ours", least, 2e-13_dp)
    end subroutine goals_of_energy

    pure subroutine goals_of_growth(growth, table)
        !! Linear time and flat memory.
        type(bench_table_t), intent(in) :: growth
        type(bench_table_t), intent(inout) :: table
        integer :: first, last

        last = findloc(growth%row(:growth%rows)%cells(1)%shown == "steps", .true., 1, back=.true.)
        first = findloc(growth%row(:growth%rows)%cells(1)%shown == "steps", .true., 1) + 1
        associate (few => growth%row(first)%cells, many => growth%row(last)%cells)
            call judge(table, "time per step, most steps / fewest", &
                       ratio(many(4)%value, few(4)%value), 1.1_dp)
            call judge(table, "peak memory, most steps / fewest", &
                       ratio(many(5)%value, few(5)%value), 1.01_dp)
        end associate
    end subroutine goals_of_growth

    pure subroutine goals_of_modes(modes, table)
        !! The smallest eigenproblem, and the largest.
        type(bench_table_t), intent(in) :: modes
        type(bench_table_t), intent(inout) :: table

        call judge(table, "modes of 2 by 2 matrices, us", modes%value("2", "us"), 3.0_dp)
        call judge(table, "modes, n = "//trim(modes%row(modes%rows)%cells(1)%shown)// &
                   ", with checks / LAPACK alone", modes%row(modes%rows)%cells(5)%value, 1.1_dp)
    end subroutine goals_of_modes

    pure subroutine goals_of_output(output, table)
        !! Rows of four columns.
        type(bench_table_t), intent(in) :: output
        type(bench_table_t), intent(inout) :: table

        call judge(table, "text row of 4 columns, us", output%value("text", "us_a_row"), 3.0_dp)
        call judge(table, "npy row of 4 columns, us", output%value("npy", "us_a_row"), 0.1_dp)
    end subroutine goals_of_output
end module lagrangia_goals
