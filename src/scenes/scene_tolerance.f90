module lagrangia_scene_tolerance
    !! The keys that say whether a scene's method takes steps of `dt` or chooses them.
    use lagrangia_description, only: name_length
    use lagrangia_errors, only: error_t
    use lagrangia_integrator, only: dense_integrator_t, integrator_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_methods, only: adaptive_names, auto, exact, method_names, method_titles, &
                                 new_adaptive, new_integrator, prepare_integrator, workhorse
    use lagrangia_namelist, only: get_integer, get_real, has_key, is_overridden, namelist_t, &
                                  refuse_value
    use lagrangia_names, only: refuse_name
    use lagrangia_scene, only: scene_t
    use lagrangia_system, only: system_t
    use lagrangia_text, only: join, to_text
    implicit none (type, external)
    private
    public :: read_tolerance
    public :: most_samples, too_many

    real(dp), parameter :: most_tolerance = 0.1_dp
    integer(i8), parameter :: most_samples = 1000000000_i8  !! their file has 50 GB and more
    character(*), parameter :: too_many = " samples are too many; make the run shorter"

contains

    subroutine read_tolerance(tree, system, scene, error)
        !! `tolerance` and `samples` of a scene whose method is to choose its steps; `tolerance`
        !! stays 0 where it is not.
        type(namelist_t), intent(inout) :: tree  !! keys that are read are marked as used
        class(system_t), intent(in) :: system    !! with its parameters, for remedies
        type(scene_t), intent(inout) :: scene  !! has its method; gets the two values
        type(error_t), allocatable, intent(out) :: error  !! a value that is not allowed
        class(dense_integrator_t), allocatable :: method
        character(name_length), allocatable :: names(:)

        if (scene%method == auto) then
            call new_adaptive(workhorse, method)
        else
            call new_adaptive(trim(scene%method), method)
        end if
        allocate (names, source=[character(name_length) :: method_names(), auto])
        if (.not. allocated(method)) then
            call refuse_fixed(tree, trim(scene%method), names, system, error)
            return
        end if
        if (scene%method == auto .and. scene%compensated) then
            call refuse_value(tree, "scene", "compensated", "name the method that is to have "// &
                              "such sums: '"//auto//"' chooses among all", error)
            return
        end if
        if (has_key(tree, "scene", "dt")) then
            if (has_key(tree, "scene", "tolerance")) then
                call refuse_value(tree, "scene", "tolerance", "give either dt, for steps of "// &
                                  "that length, or tolerance, for steps that keep to it", error)
            else if (.not. any(names == scene%method)) then
                call refuse_value(tree, "scene", "dt", "method '"//trim(scene%method)// &
                                  "' chooses its steps: give tolerance and samples instead", error)
            end if
            return
        end if
        if (has_key(tree, "scene", "every")) then
            call refuse_value(tree, "scene", "every", "counts steps of dt; with a tolerance "// &
                              "give samples", error)
            return
        end if
        if (scene%compensated) then
            call refuse_value(tree, "scene", "compensated", "is for steps of dt; a tolerance "// &
                              "leaves more than rounding", error)
            return
        end if
        scene%tolerance = 1e-10_dp
        call get_real(tree, "scene", "tolerance", scene%tolerance, error)
        if (allocated(error)) return
        if (scene%tolerance < method%least_tolerance) then
            call refuse_value(tree, "scene", "tolerance", "is below the precision of "// &
                              "numbers; the smallest sensible one is "// &
                              to_text(method%least_tolerance), error)
            return
        end if
        if (scene%tolerance > most_tolerance) then
            call refuse_value(tree, "scene", "tolerance", "at most "//to_text(most_tolerance)// &
                              " is sensible", error)
            return
        end if
        scene%samples = 1000
        call get_integer(tree, "scene", "samples", scene%samples, error)
        if (allocated(error)) return
        if (scene%samples < 1_i8) then
            call refuse_value(tree, "scene", "samples", "at least 1 is needed", error)
        else if (scene%samples > most_samples) then
            call refuse_value(tree, "scene", "samples", to_text(scene%samples)//too_many//" or"// &
                              " give fewer", error)
        end if
    end subroutine read_tolerance

    subroutine refuse_fixed(tree, name, fixed, system, error)
        !! A tolerance for a method that has none, or a method that is not there at all. No step is
        !! advised for a method that the system's forces do not let step.
        type(namelist_t), intent(inout) :: tree
        character(*), intent(in) :: name, fixed(:)
        class(system_t), intent(in) :: system
        type(error_t), allocatable, intent(out) :: error
        class(integrator_t), allocatable :: method
        type(error_t), allocatable :: found
        character(name_length), allocatable :: adaptive(:)
        character(:), allocatable :: remedy

        allocate (adaptive, source=adaptive_names())
        if (name == exact) then
            call refuse_value(tree, "scene", "method", "is what '"//auto//"' takes where there "// &
                              "is a closed form; write '"//auto//"'", error)
        else if (.not. any(fixed == name)) then
            adaptive = [character(name_length) :: fixed, &
                        pack(adaptive, .not. listed(adaptive, fixed))]
            call refuse_name("method", name, adaptive, found, method_titles(adaptive))
            call refuse_value(tree, "scene", "method", found%message, error)
        else if (has_key(tree, "scene", "tolerance")) then
            call new_integrator(name, method, found)
            if (.not. allocated(found)) call prepare_integrator(method, system, found)
            if (allocated(found)) then
                call refuse_value(tree, "scene", "method", found%message, error)
                return
            end if
            remedy = ""
            if (is_overridden(tree, "scene", "method") .and. &
                .not. is_overridden(tree, "scene", "tolerance")) then
                remedy = " (add --set scene%dt=1e-3 or the like)"
            end if
            call refuse_value(tree, "scene", "tolerance", "method '"//name//"' takes steps of "// &
                              "dt"//remedy//"; methods that keep a tolerance: "// &
                              join(adaptive, ", "), error)
        end if
    end subroutine refuse_fixed

    pure function listed(names, list) result(there)
        !! Which of `names` are in `list`.
        character(*), intent(in) :: names(:), list(:)
        logical :: there(size(names))
        integer :: i

        there = [(any(list == names(i)), i=1, size(names))]
    end function listed
end module lagrangia_scene_tolerance
