module lagrangia_rounding_trial
    !! A system whose equations are formulas, with other rounding in each of their operations: where
    !! both differ by more than rounding, terms cancel, and finer runs agree upon what is wrong.
    use lagrangia_constrained_system, only: constrained_system_t
    use lagrangia_formula_program, only: formula_program_t
    use lagrangia_kinds, only: dp
    use lagrangia_system, only: system_t
    use lagrangia_written_system, only: written_system_t
    implicit none (type, external)
    private
    public :: new_rounding_trial, lost_by_rounding

contains

    subroutine new_rounding_trial(system, trial)
        !! A copy with other rounding.
        class(system_t), intent(in) :: system  !! with its parameters
        class(system_t), allocatable, intent(out) :: trial
        !! not allocated where the equations are no formulas

        select type (system)
        class is (written_system_t)
            allocate (trial, source=system)
        end select
        if (.not. allocated(trial)) return
        select type (trial)
        class is (written_system_t)
            call round_all(trial%programs)
        end select
        select type (trial)
        class is (constrained_system_t)
            call round_all(trial%links)
        end select
    end subroutine new_rounding_trial

    subroutine round_all(programs)
        !! From now on otherwise.
        type(formula_program_t), intent(inout) :: programs(:)
        integer :: i

        do i = 1, size(programs)
            call programs(i)%round_otherwise()
        end do
    end subroutine round_all

    pure function lost_by_rounding(system, trial, t, q, v, known) result(lost)
        !! By how much accelerations of both differ, beside the largest at any of these states, or
        !! elsewhere: a few epsilon where no terms cancel, 1 where nothing else is left of them.
        class(system_t), intent(in) :: system  !! with its parameters
        class(system_t), intent(in) :: trial   !! `system` with other rounding
        real(dp), intent(in) :: t(:)           !! times of the states, s
        real(dp), intent(in) :: q(:, :), v(:, :)  !! states, (ndof, size(t))
        real(dp), intent(in) :: known(system%ndof)  !! accelerations that there were, positive
        real(dp) :: lost
        real(dp), dimension(system%ndof) :: a, other, most, off
        integer :: k

        most = known
        off = 0.0_dp
        do k = 1, size(t)
            call system%accelerations(t(k), q(:, k), v(:, k), a)
            call trial%accelerations(t(k), q(:, k), v(:, k), other)
            most = max(most, abs(a), abs(other))
            off = max(off, abs(a - other))
        end do
        lost = maxval(off/max(most, tiny(most)))
    end function lost_by_rounding
end module lagrangia_rounding_trial
