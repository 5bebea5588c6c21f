module lagrangia_stress_rows
    !! The rows of `lagrangia stress`: their names and what they mean for a student.
    use lagrangia_description, only: name_length
    implicit none (type, external)
    private
    public :: row_t, rows

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
end module lagrangia_stress_rows
