module lagrangia_lane_systems
    !! Systems of one kind with different parameters, one a lane: their accelerations by formulas in
    !! which the parameters are symbols.
    use lagrangia_kinds, only: dp, lanes
    use lagrangia_system, only: system_t
    use lagrangia_variational, only: variational_t
    use lagrangia_wrapped_system, only: wrapped_system_t
    implicit none (type, external)
    private
    public :: lane_systems_t, new_lane_systems

    type, extends(wrapped_system_t) :: lane_systems_t
        !! Only `accelerations_lanes` knows of the lanes; all else is that of one of the systems.
        private
        type(variational_t) :: formulas
        real(dp), allocatable :: parameters(:, :)  !! of each lane
    contains
        procedure :: take
        procedure :: accelerations_lanes
    end type lane_systems_t

contains

    subroutine new_lane_systems(self, system, formulas)
        !! All lanes begin with the same system.
        type(lane_systems_t), intent(out) :: self    !! ready to `take` others
        class(system_t), intent(in) :: system        !! one of the family
        type(variational_t), intent(in) :: formulas  !! its motion, `known`

        call self%wrap(system)
        self%formulas = formulas
        self%parameters = spread(formulas%parameters, 1, lanes)
    end subroutine new_lane_systems

    subroutine take(self, lane, system, yes)
        !! From now on a lane has this system, if the formulas are its motion.
        class(lane_systems_t), intent(inout) :: self
        integer, intent(in) :: lane            !! which
        class(system_t), intent(in) :: system  !! with its parameters
        logical, intent(out) :: yes            !! they are

        call self%formulas%fits(system, yes)
        if (yes) self%parameters(lane, :) = self%formulas%parameters
    end subroutine take

    pure subroutine accelerations_lanes(self, t, q, v, a)
        !! Each lane's own.
        class(lane_systems_t), intent(in) :: self
        real(dp), intent(in) :: t(lanes), q(lanes, self%ndof), v(lanes, self%ndof)
        real(dp), intent(out) :: a(lanes, self%ndof)

        call self%formulas%accelerations_lanes(t, q, v, self%parameters, a)
    end subroutine accelerations_lanes
end module lagrangia_lane_systems
