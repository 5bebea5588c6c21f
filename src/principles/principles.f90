module lagrangia_principles
    !! The pages of `lagrangia principle` in the order of the lecture, and the report of each.
    use lagrangia_action, only: action_principle
    use lagrangia_all_paths, only: all_paths_principle
    use lagrangia_catalogue, only: built_in, nth_system
    use lagrangia_constraints, only: constraints_principle
    use lagrangia_course_table, only: course_of_the_notes, statement_t
    use lagrangia_dalembert, only: dalembert_principle
    use lagrangia_errors, only: error_t
    use lagrangia_gauge, only: gauge_principle
    use lagrangia_gauss_hertz, only: gauss_hertz_principle
    use lagrangia_geometric_phase, only: geometric_phase_principle
    use lagrangia_least_time, only: least_time_principle
    use lagrangia_maupertuis, only: maupertuis_principle
    use lagrangia_measure_g, only: measure_g_principle
    use lagrangia_names, only: refuse_name
    use lagrangia_noether, only: noether_principle
    use lagrangia_phase_space, only: phase_space_principle
    use lagrangia_reactions, only: reactions_principle
    use lagrangia_report, only: report_t
    use lagrangia_same_motion_page, only: same_motion_principle
    use lagrangia_small_angle, only: small_angle_principle
    use lagrangia_system, only: system_box_t
    use lagrangia_vakonomic, only: vakonomic_principle
    use lagrangia_virtual_work, only: virtual_work_principle
    use lagrangia_which_forces, only: which_forces_principle
    implicit none (type, external)
    private
    public :: principle_t, principles
    public :: find_first_line, principle_names, principle_report

    type :: principle_t
        character(16) :: name = ""
        character(76) :: meaning = ""
    end type principle_t

    type(principle_t), parameter :: principles(*) = [ &
        principle_t("constraints", "holonomic or not, fixed or moving; degrees of freedom"), &
        principle_t("virtual-work", "d'Alembert: constraint forces do no virtual work; Q_j"), &
        principle_t("reactions", "the forces of constraint along a motion, by 3n equations"), &
        principle_t("vakonomic", "why a nonholonomic constraint is not put into L"), &
        principle_t("dalembert", "from d'Alembert to Lagrange, term by term; why dT/dq is there"), &
        principle_t("same-motion", "L's that differ by more than a dF/dt, and the same motion"), &
        principle_t("gauge", "uniqueness: L and L + dF/dt tell the same motion"), &
        principle_t("noether", "conserved quantities found: what changes L by a dF/dt only"), &
        principle_t("geometric-phase", &
                    "around a loop and back, and not where it was: disk, Foucault"), &
        principle_t("small-angle", "why theta_dot^2 theta is dropped, and what that costs"), &
        principle_t("action", "Hamilton: the actual path makes the action stationary"), &
        principle_t("least-time", "Hero, Fermat: light takes a path of stationary time"), &
        principle_t("maupertuis", "Maupertuis: with one energy int p dq is stationary"), &
        principle_t("gauss-hertz", "Gauss: least constraint; Hertz: the straightest path"), &
        principle_t("all-paths", "the paths between two events, S and index of each"), &
        principle_t("phase-space", &
                    "H from L, areas that stay (Liouville), periods, neighbours that part"), &
        principle_t("helmholtz", "which forces have an L: Helmholtz' conditions"), &
        principle_t("measure-g", "g from a slow fall: which masses for a given stop watch")]

contains

    subroutine principle_report(name, report, error)
        !! The report of one principle.
        character(*), intent(in) :: name  !! as on the command line
        type(report_t), intent(out) :: report  !! the result
        type(error_t), allocatable, intent(out) :: error  !! allocated where it fails
        type(system_box_t), allocatable :: systems(:)

        select case (name)
        case ("constraints")
            call constraints_principle(report, error)
        case ("virtual-work")
            call every_system(systems)
            call virtual_work_principle(systems, report, error)
        case ("reactions")
            call reactions_principle(report, error)
        case ("vakonomic")
            call vakonomic_principle(report, error)
        case ("dalembert")
            call dalembert_principle(report, error)
        case ("same-motion")
            call same_motion_principle(report, error)
        case ("gauge")
            call every_system(systems)
            call gauge_principle(systems, report, error)
        case ("noether")
            call noether_principle(report, error)
        case ("geometric-phase")
            call geometric_phase_principle(report, error)
        case ("small-angle")
            call small_angle_principle(report, error)
        case ("action")
            call action_principle(report, error)
        case ("least-time")
            call least_time_principle(report, error)
        case ("maupertuis")
            call maupertuis_principle(report, error)
        case ("gauss-hertz")
            call gauss_hertz_principle(report, error)
        case ("all-paths")
            call all_paths_principle(report, error)
        case ("phase-space")
            call phase_space_principle(report, error)
        case ("helmholtz")
            call which_forces_principle(report, error)
        case ("measure-g")
            call measure_g_principle(report, error)
        case default
            call refuse_name("principle", name, principle_names(), error, (principles%meaning))
        end select
    end subroutine principle_report

    subroutine every_system(systems)
        !! Those of the lectures, with default parameters.
        type(system_box_t), allocatable, intent(out) :: systems(:)
        integer :: i

        allocate (systems(built_in))
        do i = 1, size(systems)
            call nth_system(i, systems(i)%item)
        end do
    end subroutine every_system

    pure subroutine find_first_line(name, scan, line)
        !! The first statement of `lagrangia course` that names this page.
        character(*), intent(in) :: name  !! of the page
        character(2), intent(out) :: scan  !! I or II; blank if no statement names it
        integer, intent(out) :: line       !! of the scan's text; 0 if no statement names it
        type(statement_t), allocatable :: course(:)
        integer :: i

        scan = ""
        line = 0
        allocate (course, source=course_of_the_notes())
        do i = 1, size(course)
            if (index("; "//trim(course(i)%shows)//";", "; principle "//trim(name)//";") == 0) cycle
            scan = course(i)%scan
            line = course(i)%line
            return
        end do
    end subroutine find_first_line

    pure function principle_names() result(names)
        !! All of them.
        character(16) :: names(size(principles))

        names = principles%name
    end function principle_names
end module lagrangia_principles
