program digits
    !! `digits COUNT SEED`: scenes at random with `error_estimate`, and what they state. For each
    !! the lines that `.ci/quad`'s `judge` reads: the scene, as text, and its numbers.
    use digits_corners, only: corner_names, draw_scene
    use lagrangia_blas_threads, only: use_one_blas_thread
    use lagrangia_command_line, only: word_t
    use lagrangia_description, only: name_length
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_observer, only: observer_t
    use lagrangia_outcome, only: outcome_t
    use lagrangia_random_draws, only: random_t
    use lagrangia_run_plan, only: parse_run_plan, run_plan_t
    use lagrangia_scene, only: scene_t
    use lagrangia_scene_run, only: run_scene
    use lagrangia_system, only: system_t
    implicit none (type, external)

    type(random_t) :: random
    character(:), allocatable :: text
    character(20) :: argument
    integer :: count, seed, status, k, corner
    real(dp) :: x

    call get_command_argument(1, argument)
    read (argument, *, iostat=status) count
    call get_command_argument(2, argument)
    if (status == 0) read (argument, *, iostat=status) seed
    if (status /= 0) error stop "usage: digits COUNT SEED"
    call use_one_blas_thread()
    do k = 1, 1000 + 7*seed  ! another seed, another part of the sequence
        call random%uniform(0.0_dp, 1.0_dp, x)
    end do
    do k = 1, count
        corner = 1 + mod(k - 1, size(corner_names))
        call draw_scene(random, corner, text)
        if (text /= "") call run_drawn(text, trim(corner_names(corner)))
    end do

contains

    subroutine run_drawn(text, corner)
        !! Run it, and print what it states. A scene that is refused says nothing.
        character(*), intent(in) :: text, corner
        class(observer_t), pointer :: nobody
        type(run_plan_t) :: plan
        type(outcome_t) :: outcome
        type(error_t), allocatable :: error

        nobody => null()
        call parse_run_plan(plan, text, "drawn.nml", [word_t ::], error)
        if (allocated(error)) then
            print "(4a)", "# refused: ", error%message, " | ", text
            return
        end if
        print "(2a)", "# next: ", text
        call run_scene(plan, "", "text", nobody, outcome, error)
        if (allocated(error)) then
            print "(4a)", "# failed: ", error%message, " | ", text
            return
        end if
        call print_case(text, corner, plan%scene, plan%system, outcome)
    end subroutine run_drawn

    subroutine print_case(text, corner, scene, system, outcome)
        !! What the judge needs: the motion, where it ended, and each number with its statement.
        character(*), intent(in) :: text, corner
        type(scene_t), intent(in) :: scene
        class(system_t), intent(in) :: system
        type(outcome_t), intent(in) :: outcome
        integer :: i, level_of
        real(dp) :: level
        character(name_length) :: name, sign

        level_of = 0
        level = 0.0_dp
        if (allocated(scene%events) .and. size(outcome%state) > 2*system%ndof) then
            read (scene%events(1), *) name, sign, level
            do i = 2, size(outcome%state)
                if (outcome%state(i)%name == name) level_of = i - 1
            end do
        end if
        print "(a)", text
        print "(a, 1x, a, 1x, a, *(1x, i0))", trim(scene%system), corner, trim(scene%method), &
            size(scene%parameters), system%ndof, size(outcome%state), level_of
        print "(*(es25.16e3))", scene%parameters
        print "(*(es25.16e3))", scene%t0, scene%duration, outcome%t, level
        print "(*(es25.16e3))", scene%q, scene%v
        do i = 1, size(outcome%state)
            associate (s => outcome%state(i))
                print "(3es25.16e3, 1x, 2a)", s%value, s%error, s%most, '"', s%text()//'"'
            end associate
        end do
    end subroutine print_case
end program digits
