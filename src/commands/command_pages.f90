module lagrangia_command_pages
    !! What each command is for, and examples of it, for its help and the manual.
    implicit none (type, external)
    private
    public :: page_t, pages

    type :: page_t
        character(12) :: name = ""
        character(500) :: purpose = ""       !! one paragraph
        character(76) :: examples(4) = ""    !! as one types them
    end type page_t

    type(page_t), parameter :: pages(*) = [ &
        page_t("run", "Runs scenes: integrates the motion, writes a data file and a gnuplot "// &
               "script for each, and says how far energy, period and positions are from what "// &
               "is known exactly. A scene whose motion --set changes is not judged by what the "// &
               "file expects, and its files have names of their own; what leaves the motion as "// &
               "it is (columns, plot, title, every) replaces the scene's own files.", &
               [character(76) :: "lagrangia run cart_pendulum --plot", &
                "lagrangia run pendulum --set pendulum%l=2 --set scene%dt=1e-3", &
                "lagrangia run mine.nml --format csv --output results", &
                "lagrangia run double_pendulum --error-estimate"]), &
        page_t("compare", "Runs one scene by several methods, or from several starts, and sets "// &
               "the results side by side: one table, one picture of the motion, the drift and "// &
               "the error; of two methods also a film with one beside the other.", &
               [character(76) :: "lagrangia compare pendulum --methods rk4,verlet --plot", &
                "lagrangia compare pendulum --methods rk4,verlet --animate "// &
                "--set scene%dt=0.2", &
                "lagrangia compare pendulum --starts '1 2 3 0:7' --plot", ""]), &
        page_t("report", "Makes one HTML page of scenes, without a name of all: scorecard, "// &
               "pictures, films, derivations and the slips in the notes. It needs no network "// &
               "and prints well.", &
               [character(76) :: "lagrangia report pendulum cart_pendulum", "lagrangia report", &
                "", ""]), &
        page_t("modes", "Linearises a system about an equilibrium: M, K, omega^2, frequencies "// &
               "and mode shapes by LAPACK, beside the formulas of the lecture. --at names "// &
               "another equilibrium; a scene gives its own parameters.", &
               [character(76) :: "lagrangia modes double_pendulum", &
                "lagrangia modes pendulum --at 3.141592653589793", &
                "lagrangia modes cart_pendulum --set cart_pendulum%m1=5 --json", ""]), &
        page_t("check", "Audits equations at random states: the accelerations against the "// &
               "Lagrangian and against Gauss' principle, momenta, energy, constraints, printed "// &
               "formulas, the orders of the methods. Status 1 if anything does not hold. "// &
               "'check methods' measures the methods alone.", &
               [character(76) :: "lagrangia check", "lagrangia check pendulum wedge", &
                "lagrangia check mine.nml", "lagrangia check methods"]), &
        page_t("errata", "Shows the slips in the lecture notes: the line word for word, the "// &
               "line as derived, and in numbers what each slip would do.", &
               [character(76) :: "lagrangia errata", "lagrangia errata E1", "", ""]), &
        page_t("principle", "Puts both sides of a principle of the lecture into numbers, with "// &
               "controls that must differ. Without a name it lists them in the order of the "// &
               "notes, each with the lecture and line where course comes to it. Each takes "// &
               "less than a second.", &
               [character(76) :: "lagrangia principle", "lagrangia principle least-time --plot", &
                "", ""]), &
        page_t("course", "Walks through both lectures line by line: what stands there, what it "// &
               "says in plain words, and the commands that show it; or why nothing does.", &
               [character(76) :: "lagrangia course", "lagrangia course II", "", ""]), &
        page_t("bench", "Measures speed: run time against error of every method and of GSL's, "// &
               "the cost of a step and of a sample, energy in long runs. Takes minutes; "// &
               "--quick measures less.", &
               [character(76) :: "lagrangia bench --quick", &
                "lagrangia bench precision --problems P1 --methods gauss16,dop853 --plot", &
                "lagrangia bench steps --systems pendulum,hanging_chain", ""]), &
        page_t("stress", "Measures numerical stability, with verdicts: step limits, long runs, "// &
               "extreme ratios, motion near a separatrix, impacts without end. docs/stress.md "// &
               "says how to read it.", &
               [character(76) :: "lagrangia stress", "lagrangia stress chaos zeno", "", ""]), &
        page_t("grade", "Grades a sheet of statements, one a line below 'system: NAME': each "// &
               "is right in whatever form, or the term that is wrong is named. 'small: ...' is "// &
               "judged to first order. Status 1 if one is wrong, 2 if one cannot be read.", &
               [character(76) :: "lagrangia grade homework.txt", "lagrangia grade atwood", &
                "lagrangia show atwood.txt", ""]), &
        page_t("sweep", "Runs many trajectories of one scene over one or two axes, initial "// &
               "values or parameters, on all processors, and keeps of each what --keep says: "// &
               "its period, a column's last or largest value. docs/sweeps.md tells more.", &
               [character(76) :: "lagrangia sweep flip_map --plot", &
                "lagrangia sweep pendulum --over q=0.1:3.1:50 --keep period", "", ""]), &
        page_t("list", "Lists what there is, one a line with a word on each: systems, methods "// &
               "and scenes, or one of these.", &
               [character(76) :: "lagrangia list", "lagrangia list methods", "", ""]), &
        page_t("show", "Prints a scene or a homework sheet that comes with the program, to be "// &
               "copied and changed. Without a name it lists them.", &
               [character(76) :: "lagrangia show pendulum >mine.nml", "lagrangia show", "", ""]), &
        page_t("describe", "Prints what a system is: coordinates, parameters with units and "// &
               "defaults, T, V, L, equations of motion, invariants, constraints, where it "// &
               "stands in the lecture. Of the word scene: every key of a scene file.", &
               [character(76) :: "lagrangia describe wedge", "lagrangia describe scene", &
                "lagrangia describe atwood --set atwood%pulley_inertia=0.1", ""]), &
        page_t("derive", "Derives the equations of motion as on the blackboard, from the "// &
               "positions of the masses to omega^2, each line compared with the program's own "// &
               "numbers. --slip shows what a slip of the notes leads to; --fortran prints "// &
               "a system in formulas as a module to be compiled.", &
               [character(76) :: "lagrangia derive cart_pendulum", &
                "lagrangia derive cart_pendulum --slip E1", &
                "lagrangia derive double_pendulum --latex", &
                "lagrangia derive spring_pendulum --fortran >spring_pendulum.f90"]), &
        page_t("help", "Prints the help of a command, or all commands.", &
               [character(76) :: "lagrangia help run", "lagrangia run --help", "", ""]), &
        page_t("completion", "Prints a script for the shell, made from the table that --help "// &
               "prints. Source it from .bashrc, or put it where the shell looks.", &
               [character(76) :: "source <(lagrangia completion bash)", &
                "lagrangia completion zsh >~/.zfunc/_lagrangia", "", ""]), &
        page_t("manual", "Prints the manual page, made from the table that --help prints.", &
               [character(76) :: "lagrangia manual >lagrangia.1 && man -l lagrangia.1", "", "", &
                ""])]
end module lagrangia_command_pages
