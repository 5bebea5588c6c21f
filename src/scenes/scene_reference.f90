module lagrangia_scene_reference
    !! Every key of a scene file: what it means, what it takes, its default, an example.
    use lagrangia_description, only: name_length
    use lagrangia_text, only: append_word, word_t
    use lagrangia_wrapping, only: wrapped
    implicit none (type, external)
    private
    public :: entry_t, entries, reference_lines

    type :: entry_t
        !! One key. Texts are as people read them; the example is read back by a test.
        character(12) :: group = ""
        !! `scene`, `lagrangian`, `sweep`, or `NAME`, that of the system
        character(name_length) :: key = ""
        character(8) :: unit = ""
        character(110) :: default = ""         !! "": the key must be there
        character(240) :: meaning = ""         !! and what is allowed
        character(110) :: example = ""         !! `key = value`
    end type entry_t

    character(*), parameter :: absent = "none"

    type(entry_t), parameter :: entries(*) = [ &
        entry_t("scene", "title", "", "empty", "a line for the head of the picture and of the "// &
                "scorecard", "title = 'A pendulum let go at 60 degrees'"), &
        entry_t("scene", "system", "", "", &
                "a name that 'lagrangia list systems' shows, or a name "// &
                "of your own if the file has a group &lagrangian", "system = 'pendulum'"), &
        entry_t("scene", "method", "", "'rk4'", "a name that 'lagrangia list methods' shows; "// &
                "'auto': the closed form where there is one, otherwise what suits", &
                "method = 'auto'"), &
        entry_t("scene", "t0", "s", "0.0", "time at the start", "t0 = -1.0"), &
        entry_t("scene", "duration", "s", "", "from the start to the end, greater than 0", &
                "duration = 10.0"), &
        entry_t("scene", "dt", "s", "", &
                "length of a step, greater than 0; a method that keeps a "// &
                "tolerance needs none", "dt = 0.01"), &
        entry_t("scene", "every", "", "so that there are about 1000 rows", "steps of dt from "// &
                "one row to the next, a whole number", "every = 10"), &
        entry_t("scene", "tolerance", "", "1e-10", &
                "of gauss16, dop853 and auto in place of dt: "// &
                "error of a step, relative for what is larger than 1; at most 0.1", &
                "tolerance = 1e-9"), &
        entry_t("scene", "samples", "", "1000 with a tolerance", &
                "rows at equal times behind the "// &
                "first one, a whole number; with dt it must divide the steps", "samples = 500"), &
        entry_t("scene", "compensated", "", ".false.", &
                "sums that keep what rounding drops, with "// &
                "steps of dt", "compensated = .true."), &
        entry_t("scene", "q", "as is", "", "coordinates at the start, in the order of "// &
                "'lagrangia describe SYSTEM'; angles in rad", "q = 1.0471975511965976"), &
        entry_t("scene", "v", "per s", "zeros", "velocities at the start, in the same order", &
                "v = 0.5"), &
        entry_t("scene", "columns", "", "t, the coordinates, energy_drift or "// &
                "energy_balance_drift", &
                "of the data file: t, each coordinate q with q_dot and q_ddot, energy, "// &
                "quantities, places x_bob, momenta; with _drift what is conserved; work and "// &
                "energy_balance if energy is not; error", &
                "columns = 't', 'theta', 'theta_dot', 'energy_drift'"), &
        entry_t("scene", "plot", "", "one panel for all columns", &
                "panels of the picture, up to "// &
                "8: 'y' or 'y1+y2' against the time, 'x:y' one column against another", &
                "plot = 'theta', 'theta:theta_dot'"), &
        entry_t("scene", "figure", "", "the system's own", "how --animate draws it, part by "// &
                "part: docs/animation.md", "figure = 'spring origin bob', 'ball bob'"), &
        entry_t("scene", "event", "", absent, "up to 8: 'COLUMN = LEVEL', with 'rising', "// &
                "'falling' or 'stop' behind it; a level may be a formula of numbers", &
                "event = 'theta = pi/2 rising'"), &
        entry_t("scene", "event_columns", "", "columns, without errors and drifts", &
                "of the file "// &
                "of events", "event_columns = 't', 'theta_dot'"), &
        entry_t("scene", "event_plot", "", absent, "as plot, of the events", &
                "event_plot = 't:theta_dot'"), &
        entry_t("scene", "period_of", "", absent, "a coordinate whose period is measured", &
                "period_of = 'theta'"), &
        entry_t("scene", "modes", "", ".false.", "omega of the small oscillations beside its "// &
                "closed form in the scorecard", "modes = .true."), &
        entry_t("scene", "error_estimate", "", ".false.", "state the final state to the digits "// &
                "that hold; a force shorter than a thousandth of the time may hide between "// &
                "steps", "error_estimate = .true."), &
        entry_t("scene", "output", "", "the file's name", "of the data files, below the output "// &
                "folder; letters, digits, . _ - / and blanks", "output = 'first/try'"), &
        entry_t("scene", "expect_NAME", "", absent, "a bound that is judged: of error, of "// &
                "NAME_drift for what is conserved, of period (relative), small_period", &
                "expect_energy_drift = 1e-6"), &
        entry_t("lagrangian", "coordinates", "", "", &
                "of a system in formulas: names, each with "// &
                "a unit and a few words if you like; 'x_1 .. x_4 [m]' is four", &
                "coordinates = 'r [m] length of the spring', 'theta [rad] its angle'"), &
        entry_t("lagrangian", "parameters", "", absent, "names, as coordinates; their values "// &
                "stand in the group that has the system's name", &
                "parameters = 'm [kg] mass', 'k [N/m]', 'l0 [m]', 'g [m/s^2]'"), &
        entry_t("lagrangian", "T", "", "", "kinetic energy, a formula of t, coordinates q, "// &
                "velocities q_dot, parameters and definitions; or L, or masses in positions", &
                "T = 'm/2 (r_dot^2 + r^2 theta_dot^2)'"), &
        entry_t("lagrangian", "V", "", "0", "potential energy, which may depend on velocities", &
                "V = 'k/2 (r - l0)^2 - m g r cos(theta)'"), &
        entry_t("lagrangian", "L", "", "T - V", "the Lagrangian, in place of T and V", &
                "L = 'm/2 (r_dot^2 + r^2 theta_dot^2) - k/2 (r - l0)^2 + m g r cos(theta)'"), &
        entry_t("lagrangian", "Q_NAME", "", "0", "generalised force on a coordinate beside L", &
                "Q_theta = '-theta_dot'"), &
        entry_t("lagrangian", "definitions", "", absent, &
                "letters that stand for a formula, each "// &
                "of those before it", "definitions = 's = r - l0'"), &
        entry_t("lagrangian", "positions", "", absent, "places of points: name, mass: x, y and "// &
                "perhaps z; they become columns x_bob, y_bob", &
                "positions = 'bob, m: r sin(theta), -r cos(theta)'"), &
        entry_t("lagrangian", "rotors", "", absent, "bodies that turn: name, moment of "// &
                "inertia: angle; with the masses they are T, as check and derive have it", &
                "rotors = 'wheel, m l0^2: r/l0'"), &
        entry_t("lagrangian", "equilibrium", "", "near zeros", "where small oscillations are "// &
                "looked at, for each coordinate a formula, or its cosine: 'cos(theta) = g/l0'", &
                "equilibrium = 'l0 + m g/k', '0'"), &
        entry_t("lagrangian", "constraint", "", absent, "up to one less than coordinates: of "// &
                "t and coordinates, or linear in velocities; each has a multiplier, column "// &
                "lambda1, and each step ends on it", "constraint = 'r = l0 + t/20'"), &
        entry_t("lagrangian", "quantities", "", absent, "functions of t, q, q_dot as columns, "// &
                "each may use those before it; one that the motion conserves has a drift", &
                "quantities = 'L_z [kg m^2/s] angular momentum = m r^2 theta_dot'"), &
        entry_t("lagrangian", "domain", "", "any finite number", &
                "what is allowed of parameters, with >, >=, < or <=", &
                "domain = 'm > 0', 'l0 >= 0'"), &
        entry_t("NAME", "PARAMETER", "as is", "as 'lagrangia describe SYSTEM' says", &
                "the group of "// &
                "the system's name has its parameters", "l = 2.0"), &
        entry_t("sweep", "over", "", absent, "one or two axes, each 'NAME = FROM:TO:COUNT', "// &
                "perhaps with ':log' or ':random'; NAME is a coordinate, its _dot, or a "// &
                "parameter", "over = 'theta = -pi:pi:100', 'm = 0.1:10:50:log'"), &
        entry_t("sweep", "keep", "", absent, "of each trajectory: a column at the end, 'max "// &
                "COLUMN', 'min COLUMN', 'wrapped ANGLE', 'period', 'exact period', "// &
                "'exact max COORDINATE', 'exact min COORDINATE', 'first EVENT', 'flip "// &
                "ANGLE', 'lyapunov', 'lyapunov error', 'attractor'", &
                "keep = 'period', 'max theta_dot'"), &
        entry_t("sweep", "after", "s", "t0", "samples before this time don't count for max, "// &
                "min and lyapunov", "after = 0.5"), &
        entry_t("sweep", "strobe", "s", absent, "period of a stroboscope, a formula in the "// &
                "parameters: what is kept is kept of each of its points, and a row is a "// &
                "point; for 'attractor', the points that tell it", &
                "strobe = '2 pi/drive_frequency'"), &
        entry_t("sweep", "section", "", absent, "an event: the same for each point where it "// &
                "happens", "section = 'theta1 = 0 rising'"), &
        entry_t("sweep", "points", "", "100", "points of a trajectory at most, from 'after' "// &
                "on", "points = 500"), &
        entry_t("sweep", "energy_by", "", absent, "a velocity, chosen so that every start has "// &
                "the energy of the scene's own", "energy_by = 'theta1_dot'"), &
        entry_t("sweep", "most_steps", "", absent, "steps of a trajectory at most, where the "// &
                "method chooses them: after more it fails and is NaN", "most_steps = 1000000"), &
        entry_t("sweep", "seed", "", "1", "of values drawn at random", "seed = 7"), &
        entry_t("sweep", "threads", "", "one a processor", "processes that compute at a "// &
                "time, a number up to 10000", "threads = 2")]

contains

    subroutine reference_lines(lines)
        !! All of it as text, a few lines a key.
        type(word_t), allocatable, intent(out) :: lines(:)  !! without line feeds
        type(entry_t) :: item
        character(:), allocatable :: head
        character(12) :: before
        integer :: i

        allocate (lines(0))
        before = ""
        call add("A scene is a text of groups '&group key = value, ... /'. Texts stand between "// &
                 "apostrophes, numbers have a")
        call add("point, ! begins a comment; case matters in texts only. '--set "// &
                 "GROUP%KEY=VALUE' goes before what the file says.")
        do i = 1, size(entries)
            item = entries(i)
            if (i == 1) then
                call add("")
                call add("&scene: what to run")
            else if (item%group /= before) then
                call add("")
                if (item%group == "lagrangian") call add("&lagrangian: a system in formulas")
                if (item%group == "sweep") call add("&sweep: many trajectories, for "// &
                                                    "'lagrangia sweep'")
                if (item%group == "NAME") call add("&NAME: the parameters of the system NAME")
            end if
            head = "  "//trim(item%key)
            if (item%unit /= "") head = head//" ["//trim(item%unit)//"]"
            if (item%default == "") head = head//", needed"
            if (item%default /= "") head = head//", default: "//trim(item%default)
            call add(head)
            call add_wrapped(trim(item%meaning))
            call add("      "//trim(item%example))
            before = item%group
        end do
    contains
        subroutine add_wrapped(text)
            !! At most 99 columns.
            character(*), intent(in) :: text
            type(word_t), allocatable :: more(:)
            integer :: k

            call wrapped(text, 95, more)
            do k = 1, size(more)
                call add("    "//more(k)%text)
            end do
        end subroutine add_wrapped

        subroutine add(text)
            character(*), intent(in) :: text

            call append_word(lines, text)
        end subroutine add
    end subroutine reference_lines
end module lagrangia_scene_reference
