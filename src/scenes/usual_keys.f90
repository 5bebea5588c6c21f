module lagrangia_usual_keys
    !! Names that other programs have for what keys of `&scene` say: `tmax`, `h`, `solver`.
    use lagrangia_errors, only: error_t
    use lagrangia_namelist, only: namelist_t
    use lagrangia_namelist_tree, only: fail_at, find_entry
    implicit none (type, external)
    private
    public :: refuse_usual_names, usual_key, usual_names

    integer, parameter :: length = 12

    type :: pair_t
        character(length) :: name = "", key = ""
    end type pair_t

    type(pair_t), parameter :: pairs(*) = [ &
        pair_t("time", "duration"), pair_t("tmax", "duration"), pair_t("t_max", "duration"), &
        pair_t("tend", "duration"), pair_t("t_end", "duration"), pair_t("tf", "duration"), &
        pair_t("t1", "duration"), pair_t("end", "duration"), pair_t("stop", "duration"), &
        pair_t("h", "dt"), pair_t("step", "dt"), pair_t("stepsize", "dt"), &
        pair_t("step_size", "dt"), pair_t("timestep", "dt"), pair_t("time_step", "dt"), &
        pair_t("delta_t", "dt"), pair_t("integrator", "method"), pair_t("solver", "method"), &
        pair_t("scheme", "method"), pair_t("algorithm", "method"), pair_t("tol", "tolerance"), &
        pair_t("rtol", "tolerance"), pair_t("atol", "tolerance"), pair_t("steps", "samples"), &
        pair_t("nsteps", "samples"), pair_t("n_steps", "samples"), pair_t("rows", "samples"), &
        pair_t("x0", "q"), pair_t("q0", "q"), pair_t("y0", "q"), pair_t("start", "q"), &
        pair_t("initial", "q"), pair_t("position", "q"), pair_t("angle", "q"), &
        pair_t("v0", "v"), pair_t("velocity", "v"), pair_t("speed", "v"), pair_t("qdot", "v"), &
        pair_t("q_dot", "v"), pair_t("omega", "v"), pair_t("omega0", "v"), &
        pair_t("name", "title"), pair_t("file", "output"), pair_t("filename", "output"), &
        pair_t("model", "system"), pair_t("variables", "columns")]
    character(length), parameter :: usual_names(*) = pairs%name

contains

    pure function usual_key(name) result(key)
        !! The key that is meant; empty where the name is none of these.
        character(*), intent(in) :: name  !! in small letters
        character(:), allocatable :: key
        integer :: i

        key = ""
        i = findloc(pairs%name == name, .true., 1)
        if (i > 0) key = trim(pairs(i)%key)
    end function usual_key

    pure subroutine refuse_usual_names(tree, error)
        !! Say which key is meant, where one of these names stands in its place.
        type(namelist_t), intent(in) :: tree              !! of a scene
        type(error_t), allocatable, intent(out) :: error  !! status 2
        integer :: at, i

        do i = 1, size(pairs)
            at = find_entry(tree, "scene", trim(pairs(i)%name))
            if (at == 0) cycle
            call fail_at(tree, tree%entries(at)%at, "&scene: unknown key '"//trim(pairs(i)%name)// &
                         "'; did you mean '"//trim(pairs(i)%key)//"'?", error)
            return
        end do
    end subroutine refuse_usual_names
end module lagrangia_usual_keys
