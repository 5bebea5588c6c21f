module lagrangia_scene_tolerance
    !! The keys that say whether a scene's method takes steps of `dt` or chooses them.
    use lagrangia_adaptive_methods, only: adaptive_names, new_adaptive
    use lagrangia_description, only: name_length
    use lagrangia_errors, only: error_t
    use lagrangia_integrator, only: dense_integrator_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_methods, only: method_names
    use lagrangia_namelist, only: get_integer, get_real, has_key, namelist_t, refuse_value
    use lagrangia_scene, only: scene_t
    use lagrangia_shadow, only: least_tolerance
    use lagrangia_text, only: join, to_text
    implicit none (type, external)
    private
    public :: read_tolerance

    real(dp), parameter :: most_tolerance = 0.1_dp

contains

    subroutine read_tolerance(tree, scene, error)
        !! `tolerance` and `samples` of a scene whose method is to choose its steps; `tolerance`
        !! stays 0 where it is not.
        type(namelist_t), intent(inout) :: tree
        type(scene_t), intent(inout) :: scene
        type(error_t), allocatable, intent(out) :: error
        class(dense_integrator_t), allocatable :: method
        character(name_length), allocatable :: names(:)

        call new_adaptive(trim(scene%method), method)
        names = method_names()
        if (.not. allocated(method)) then
            if (has_key(tree, "scene", "tolerance") .and. any(names == scene%method)) then
                names = adaptive_names()
                call refuse_value(tree, "scene", "tolerance", "method '"//trim(scene%method)// &
                                  "' takes steps of dt; methods that keep a tolerance: "// &
                                  join(names, ", "), error)
            end if
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
        scene%tolerance = 1e-10_dp
        call get_real(tree, "scene", "tolerance", scene%tolerance, error)
        if (allocated(error)) return
        if (scene%tolerance < least_tolerance) then
            call refuse_value(tree, "scene", "tolerance", "is below the precision of numbers; "// &
                              "the smallest sensible one is "//to_text(least_tolerance), error)
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
        if (scene%samples < 1_i8) call refuse_value(tree, "scene", "samples", &
                                                    "at least 1 is needed", error)
    end subroutine read_tolerance
end module lagrangia_scene_tolerance
