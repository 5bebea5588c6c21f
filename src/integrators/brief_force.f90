module lagrangia_brief_force
    !! A force that acts for a moment, which long steps would go over without a sign: an error
    !! estimate sees only what a stage has met.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use lagrangia_kinds, only: dp, i8
    use lagrangia_lagrangian_system, only: lagrangian_system_t
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: find_briefest_force, looks

    integer, parameter :: looks = 20000  !! times at which a force is looked for
    real(dp), parameter :: least = 1e-6_dp  !! part of the largest change that counts
    real(dp), parameter :: probes(3) = [0.618_dp, 0.2367_dp, 0.8541_dp]  !! of the way

contains

    pure subroutine find_briefest_force(system, t0, t_end, q, v, time, evaluations)
        !! Where the accelerations of the state do not change with the time but for a while: how
        !! long the shortest such while lasts, \(\int|a(t)-a(t_0)|\,dt\,/\,\max|a(t)-a(t_0)|\).
        !! Of systems in formulas; where they always change, as under a periodic force, steps follow
        !! them anyway. A force that grows from 0 with a coordinate or a velocity, as that of a
        !! magnetic field, is not there at a start where these are 0: if nothing changes at the
        !! start, it is looked for beside it.
        class(system_t), intent(in) :: system               !! with its parameters
        real(dp), intent(in) :: t0, t_end                   !! start and end of the motion, s
        real(dp), intent(in) :: q(system%ndof)              !! coordinates at the start
        real(dp), intent(in) :: v(system%ndof)              !! velocities at the start
        real(dp), intent(out) :: time                       !! s; huge: there is no such while
        integer(i8), intent(inout) :: evaluations           !! gets one for each time
        real(dp), parameter :: aside = 1e-3_dp              !! of 1, and of what there is
        logical :: changes

        time = huge(time)
        select type (system)
        class is (lagrangian_system_t)
            if (.not. system%told_by_formulas) return
        class default
            return
        end select
        if (.not. system%time_dependent .or. t_end >= huge(t_end)) return
        if (.not. (t_end - t0)/looks > spacing(max(abs(t0), abs(t_end)))) return
        call look_from(system, t0, t_end, q, v, time, changes, evaluations)
        if (.not. changes) call look_from(system, t0, t_end, q + aside*(1.0_dp + abs(q)), &
            v + aside*(1.0_dp + abs(v)), time, changes, evaluations)
    end subroutine find_briefest_force

    pure subroutine look_from(system, t0, t_end, q, v, time, changes, evaluations)
        !! The same from one state, whatever the system.
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t0, t_end
        real(dp), intent(in) :: q(system%ndof), v(system%ndof)
        real(dp), intent(inout) :: time              !! stays where there is no such while
        logical, intent(out) :: changes              !! do the accelerations, ever?
        integer(i8), intent(inout) :: evaluations
        real(dp), allocatable :: change(:)
        real(dp) :: few(size(probes)), first(system%ndof), step, total
        integer :: i, k

        step = (t_end - t0)/looks
        call system%accelerations(t0, q, v, first)
        do i = 1, size(probes)
            few(i) = change_at(t0 + probes(i)*(t_end - t0))
        end do
        evaluations = evaluations + 1 + size(probes)
        changes = minval(few) > least*maxval(few)
        if (changes) return
        allocate (change(looks))
        do i = 1, looks
            change(i) = change_at(t0 + i*step)
        end do
        changes = maxval(change) > 0.0_dp
        evaluations = evaluations + looks
        change = merge(0.0_dp, change, change < least*maxval(change))
        i = 1
        do while (i <= looks)
            k = i
            total = 0.0_dp
            do while (change(k) > 0.0_dp)
                total = total + change(k)
                k = k + 1
                if (k > looks) exit
            end do
            if (k > i) time = min(time, step*(total/maxval(change(i:k - 1))))
            i = k + 1
        end do
    contains
        pure function change_at(t) result(size_of)
            !! 0 where it is no number, too.
            real(dp), intent(in) :: t
            real(dp) :: size_of
            real(dp) :: a(system%ndof)

            call system%accelerations(t, q, v, a)
            size_of = maxval(abs(a - first))
            if (.not. ieee_is_finite(size_of)) size_of = 0.0_dp
        end function change_at
    end subroutine look_from
end module lagrangia_brief_force
