module lagrangia_lane_systems
    !! Systems of one kind with different parameters, one a lane: their accelerations by formulas in
    !! which the parameters are symbols.
    use lagrangia_description, only: description_t
    use lagrangia_errors, only: error_t
    use lagrangia_hyperdual, only: hyperdual_t
    use lagrangia_kinds, only: dp, lanes
    use lagrangia_system, only: system_t
    use lagrangia_variational, only: variational_t
    implicit none (type, external)
    private
    public :: lane_systems_t, new_lane_systems

    type, extends(system_t) :: lane_systems_t
        !! Only `accelerations_lanes` knows of the lanes; all else is that of one of the systems.
        private
        class(system_t), allocatable :: of
        type(variational_t) :: formulas
        real(dp), allocatable :: parameters(:, :)  !! of each lane
    contains
        procedure :: take
        procedure :: describe
        procedure :: configure
        procedure :: accelerations
        procedure :: accelerations_lanes
        procedure :: lagrangian
        procedure :: energy
    end type lane_systems_t

contains

    subroutine new_lane_systems(self, system, formulas)
        !! All lanes begin with the same system.
        type(lane_systems_t), intent(out) :: self    !! ready to `take` others
        class(system_t), intent(in) :: system        !! one of the family
        type(variational_t), intent(in) :: formulas  !! its motion, `known`

        allocate (self%of, source=system)
        self%ndof = system%ndof
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

    pure subroutine describe(self, d)
        !! See `system_t`.
        class(lane_systems_t), intent(in) :: self
        type(description_t), intent(out) :: d

        call self%of%describe(d)
    end subroutine describe

    pure subroutine configure(self, values, error)
        !! See `system_t`.
        class(lane_systems_t), intent(inout) :: self
        real(dp), intent(in) :: values(:)
        type(error_t), allocatable, intent(out) :: error

        call self%of%configure(values, error)
    end subroutine configure

    pure subroutine accelerations(self, t, q, v, a)
        !! See `system_t`.
        class(lane_systems_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp), intent(out) :: a(self%ndof)

        call self%of%accelerations(t, q, v, a)
    end subroutine accelerations

    pure subroutine accelerations_lanes(self, t, q, v, a)
        !! Each lane's own.
        class(lane_systems_t), intent(in) :: self
        real(dp), intent(in) :: t(lanes), q(lanes, self%ndof), v(lanes, self%ndof)
        real(dp), intent(out) :: a(lanes, self%ndof)

        call self%formulas%accelerations_lanes(t, q, v, self%parameters, a)
    end subroutine accelerations_lanes

    pure function lagrangian(self, t, q, v) result(l)
        !! See `system_t`.
        class(lane_systems_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof), v(self%ndof)
        type(hyperdual_t) :: l

        l = self%of%lagrangian(t, q, v)
    end function lagrangian

    pure function energy(self, t, q, v) result(e)
        !! See `system_t`.
        class(lane_systems_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp) :: e

        e = self%of%energy(t, q, v)
    end function energy
end module lagrangia_lane_systems
