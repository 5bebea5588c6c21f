module lagrangia_lane_queue
    !! The trajectories of a block, which the lanes take one after the other.
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_sweep, only: sweep_t
    use lagrangia_sweep_trajectory, only: compute_one
    use lagrangia_workers, only: report_part
    implicit none (type, external)
    private
    public :: lane_queue_t, seldom

    integer, parameter :: seldom = 256  !! steps of the lanes, of which one is reported

    type :: lane_queue_t
        integer(i8) :: first = 1                    !! number of the first trajectory
        integer(i8) :: next = 1                     !! of the one that is taken next
        integer(i8) :: last = 0                     !! of the last
        integer(i8) :: failures = 0                 !! trajectories that failed
        integer(i8) :: first_failed = huge(1_i8)    !! number of the first of these, or huge
    contains
        procedure :: take
        procedure :: compute_alone
        procedure :: count_failure
        procedure :: report
    end type lane_queue_t

contains

    pure subroutine take(self, index, there)
        !! The next trajectory.
        class(lane_queue_t), intent(inout) :: self
        integer(i8), intent(inout) :: index  !! its number; as it was where there is none
        logical, intent(out) :: there        !! there is one

        there = self%next <= self%last
        if (.not. there) return
        index = self%next
        self%next = self%next + 1
    end subroutine take

    subroutine compute_alone(self, sweep, index, values, error)
        !! A trajectory that does not fit into a lane, or cannot be begun.
        class(lane_queue_t), intent(inout) :: self
        type(sweep_t), intent(in) :: sweep                  !! that it is one of
        integer(i8), intent(in) :: index                    !! its number
        real(dp), intent(inout) :: values(:, :)             !! of the block; its own change
        type(error_t), allocatable, intent(inout) :: error  !! why it fails

        if (.not. allocated(error)) call compute_one(sweep, index, &
                                                     values(:, index - self%first + 1), error)
        if (allocated(error)) call self%count_failure(index)
    end subroutine compute_alone

    pure subroutine count_failure(self, index)
        !! Of a trajectory whose numbers are NaN.
        class(lane_queue_t), intent(inout) :: self
        integer(i8), intent(in) :: index  !! its number

        self%failures = self%failures + 1
        self%first_failed = min(self%first_failed, index)
    end subroutine count_failure

    subroutine report(self, parts)
        !! How far the block is.
        class(lane_queue_t), intent(in) :: self
        real(dp), intent(in) :: parts(:)  !! of the trajectories that are in lanes: what is done
        real(dp) :: done

        done = real(self%next - self%first - size(parts), dp) + sum(parts)
        call report_part(done/real(self%last - self%first + 1, dp))
    end subroutine report
end module lagrangia_lane_queue
