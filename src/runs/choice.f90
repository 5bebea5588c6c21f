module lagrangia_choice
    !! `method = 'auto'`: a closed form, or the fastest of ours for most systems; and why.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use lagrangia_description, only: name_length
    use lagrangia_kinds, only: dp
    use lagrangia_methods, only: auto, exact, workhorse
    use lagrangia_reference, only: reference_t
    use lagrangia_scene, only: scene_t
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: settle_method

contains

    subroutine settle_method(scene, system, reference, settled, choice)
        !! The scene with a method in the place of `auto`, and a line that says so.
        type(scene_t), intent(in) :: scene
        class(system_t), intent(in) :: system
        class(reference_t), allocatable, intent(in) :: reference  !! of the scene's start
        type(scene_t), intent(out) :: settled
        character(:), allocatable, intent(out) :: choice          !! "" if the method was named
        character(:), allocatable :: why

        settled = scene
        choice = ""
        if (scene%method /= auto) return
        call choose_method(scene, system, reference, settled%method, why)
        choice = auto//" took "//trim(settled%method)//": "//why
    end subroutine settle_method

    subroutine choose_method(scene, system, reference, method, why)
        !! What takes the place of `auto` in a scene: `exact` where `reference` gives the states,
        !! or the name of a method.
        type(scene_t), intent(in) :: scene
        class(system_t), intent(in) :: system
        class(reference_t), allocatable, intent(in) :: reference
        character(name_length), intent(out) :: method
        character(:), allocatable, intent(out) :: why

        if (system%contacts > 0) then
            why = "impacts are looked for between steps"
        else if (allocated(scene%events)) then
            why = "events are looked for between steps"
        else if (scene%error_estimate) then
            why = "an error is estimated by finer steps"
        else if (.not. allocated(reference)) then
            why = "no closed form is known from this start"
        else if (.not. gives_states()) then
            why = "the closed form does not give every state"
        else
            method = exact
            why = "closed form: "//trim(reference%title)
            return
        end if
        method = workhorse
        why = why//"; of the methods this one is mostly the fastest to a given error"
    contains
        function gives_states() result(yes)
            logical :: yes
            real(dp) :: q(system%ndof), v(system%ndof)

            yes = reference%has_state
            if (.not. yes) return
            call reference%state_at(scene%t0 + scene%duration, q, v)
            yes = all(ieee_is_finite(q)) .and. all(ieee_is_finite(v))
        end function gives_states
    end subroutine choose_method
end module lagrangia_choice
