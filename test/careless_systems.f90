module careless_systems
    !! Systems that lose a few digits, which no other test would miss: the stress tests must.
    use lagrangia_bouncing_ball, only: bouncing_ball_t
    use lagrangia_double_pendulum, only: double_pendulum_t
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp
    use lagrangia_pendulum, only: pendulum_t
    use lagrangia_reference, only: reference_t
    use lagrangia_system, only: lanes
    use lagrangia_wedge, only: wedge_t
    implicit none (type, external)
    private
    public :: careless_ball_t, careless_double_t, careless_pendulum_t, careless_wedge_t

    type, extends(pendulum_t) :: careless_pendulum_t
        !! Its period is off by 1e-9, and it knows how often it has turned.
    contains
        procedure :: accelerations => careless_pendulum
        procedure :: accelerations_lanes => careless_pendulum_lanes
        procedure :: closed_form => no_closed_form
    end type careless_pendulum_t

    type, extends(double_pendulum_t) :: careless_double_t
        !! Its lower rod is off by 1e-12, and it takes any mass.
    contains
        procedure :: configure => careless_configure
    end type careless_double_t

    type, extends(wedge_t) :: careless_wedge_t
        !! With a cosine of single precision.
    contains
        procedure :: accelerations => careless_wedge
    end type careless_wedge_t

    type, extends(bouncing_ball_t) :: careless_ball_t
        !! Bounces off by 1e-10, and without an end.
    contains
        procedure :: impact => careless_impact
    end type careless_ball_t

contains

    subroutine no_closed_form(self, t0, q0, v0, reference)
        !! The pendulum's is not that of this one.
        class(careless_pendulum_t), intent(in) :: self
        real(dp), intent(in) :: t0, q0(:), v0(:)
        class(reference_t), allocatable, intent(out) :: reference
    end subroutine no_closed_form

    pure subroutine careless_pendulum(self, t, q, v, a)
        !! See the type.
        class(careless_pendulum_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp), intent(out) :: a(self%ndof)

        call self%pendulum_t%accelerations(t, q, v, a)
        a = (1.0_dp + 1e-9_dp + 1e-10_dp*q)*a
    end subroutine careless_pendulum

    pure subroutine careless_pendulum_lanes(self, t, q, v, a)
        !! See the type.
        class(careless_pendulum_t), intent(in) :: self
        real(dp), intent(in) :: t(lanes), q(lanes, self%ndof), v(lanes, self%ndof)
        real(dp), intent(out) :: a(lanes, self%ndof)

        call self%pendulum_t%accelerations_lanes(t, q, v, a)
        a = (1.0_dp + 1e-9_dp + 1e-10_dp*q)*a
    end subroutine careless_pendulum_lanes

    pure subroutine careless_configure(self, values, error)
        !! See the type.
        class(careless_double_t), intent(inout) :: self
        real(dp), intent(in) :: values(:)
        type(error_t), allocatable, intent(out) :: error
        real(dp) :: changed(5)

        changed = values
        changed(1) = max(changed(1), tiny(1.0_dp))
        changed(4) = changed(4)*(1.0_dp + 1e-12_dp)
        call self%double_pendulum_t%configure(changed, error)
    end subroutine careless_configure

    pure subroutine careless_wedge(self, t, q, v, a)
        !! See the type.
        class(careless_wedge_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp), intent(out) :: a(self%ndof)

        call self%wedge_t%accelerations(t, q, v, a)
        a(2) = a(2)*real(real(cos(self%alpha)), dp)/cos(self%alpha) + 1e-17_dp
    end subroutine careless_wedge

    pure subroutine careless_impact(self, i, t, q, v)
        !! See the type.
        class(careless_ball_t), intent(in) :: self
        integer, intent(in) :: i
        real(dp), intent(in) :: t
        real(dp), intent(inout) :: q(self%ndof), v(self%ndof)

        v = -self%restitution*(1.0_dp - 1e-10_dp)*v
        q = 0.0_dp
    end subroutine careless_impact
end module careless_systems
