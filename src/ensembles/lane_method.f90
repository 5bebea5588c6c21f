module lagrangia_lane_method
    !! The contract of a method that steps eight trajectories at once, one a lane, each from its own
    !! time and to its own end. What a lane computes depends on no other lane.
    use lagrangia_kinds, only: dp, lanes
    use lagrangia_scene, only: scene_t
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: lane_method_t

    type, abstract :: lane_method_t
        real(dp), dimension(lanes) :: t_old = 0.0_dp, t = 0.0_dp  !! ends of the latest steps, s
        real(dp), allocatable :: y_old(:, :), y(:, :)  !! states `(q, v)` there, (lanes, 2 ndof)
        logical :: stuck(lanes) = .false.              !! no step is small enough
    contains
        procedure(prepare_i), deferred :: prepare
        procedure(begin_i), deferred :: begin
        procedure(step_i), deferred :: step
        procedure(state_at_i), deferred :: state_at
        procedure(may_flip_i), deferred :: may_flip
        procedure(flip_time_i), deferred :: flip_time
    end type lane_method_t

    abstract interface
        pure subroutine prepare_i(self, system)
            !! Before the first trajectory: all lanes are empty.
            import :: lane_method_t, system_t
            implicit none (type, external)
            class(lane_method_t), intent(inout) :: self
            class(system_t), intent(in) :: system  !! how many coordinates there are
        end subroutine prepare_i

        pure subroutine begin_i(self, system, lane, scene)
            !! A trajectory begins in a lane.
            import :: lane_method_t, scene_t, system_t
            implicit none (type, external)
            class(lane_method_t), intent(inout) :: self
            class(system_t), intent(in) :: system  !! whose motion it is
            integer, intent(in) :: lane            !! which
            type(scene_t), intent(in) :: scene     !! its start, times, and tolerance or step
        end subroutine begin_i

        pure subroutine step_i(self, system)
            !! One step of every lane, or an attempt: then the lane stands where it stood. A lane
            !! that has come to its end is not asked any more, until another trajectory begins.
            import :: lane_method_t, system_t
            implicit none (type, external)
            class(lane_method_t), intent(inout) :: self
            class(system_t), intent(in) :: system  !! of all lanes
        end subroutine step_i

        pure subroutine state_at_i(self, system, lane, t, q, v)
            !! The state at a time of the lane's latest step, both its ends included. A method of
            !! fixed steps is only asked at the end.
            import :: dp, lane_method_t, system_t
            implicit none (type, external)
            class(lane_method_t), intent(inout) :: self
            class(system_t), intent(in) :: system                   !! that of the lane
            integer, intent(in) :: lane                             !! which
            real(dp), intent(in) :: t                               !! s
            real(dp), intent(out) :: q(system%ndof), v(system%ndof) !! coordinates, velocities
        end subroutine state_at_i

        pure function may_flip_i(self, coordinate) result(yes)
            !! In which lanes the angle may come beyond plus or minus pi in the latest step.
            import :: lane_method_t, lanes
            implicit none (type, external)
            class(lane_method_t), intent(in) :: self
            integer, intent(in) :: coordinate  !! the angle's number
            logical :: yes(lanes)
        end function may_flip_i

        subroutine flip_time_i(self, system, lane, coordinate, time)
            !! When the angle first comes beyond plus or minus pi in the lane's latest step.
            import :: dp, lane_method_t, system_t
            implicit none (type, external)
            class(lane_method_t), intent(inout) :: self
            class(system_t), intent(in) :: system  !! that of the lane
            integer, intent(in) :: lane            !! one that `may_flip`
            integer, intent(in) :: coordinate      !! the angle's number
            real(dp), intent(out) :: time          !! s; NaN: it does not
        end subroutine flip_time_i
    end interface
end module lagrangia_lane_method
