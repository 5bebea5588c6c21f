module own_reductions
    !! An own system with a cyclic coordinate that it knows how to leave out, well or badly.
    use lagrangia_description, only: coordinate, description_t, point_t, positive, quantity_t
    use lagrangia_errors, only: error_t
    use lagrangia_hyperdual, only: hyperdual_t, operator(*), operator(**), operator(+), operator(-)
    use lagrangia_kinds, only: dp
    use lagrangia_lagrangian_system, only: lagrangian_system_t
    use lagrangia_system, only: check_parameters, reduced_t
    implicit none (type, external)
    private
    public :: own_trough_t

    type, extends(lagrangian_system_t) :: own_trough_t
        !! A mass in a trough: \(x\) is free, a spring is across it, and
        !! \(L = \tfrac m2[(\dot x + \dot y)^2 + \dot y^2] - \tfrac k2y^2\).
        real(dp) :: slip = 0.0_dp  !! of the velocity that comes back
    contains
        procedure :: outline
        procedure :: lagrangian => trough_lagrangian
        procedure :: reduce
    end type own_trough_t

    type, extends(reduced_t) :: own_across_t
        !! \(y\) alone: \(\ddot y = -ky/m\), as \(\dot x + \dot y\) is conserved.
        real(dp) :: m = 1.0_dp, k = 1.0_dp, sum_q = 0.0_dp, sum_v = 0.0_dp, slip = 0.0_dp
    contains
        procedure :: describe
        procedure :: configure
        procedure :: accelerations
        procedure :: lagrangian
        procedure :: energy
        procedure :: leave
        procedure :: complete
    end type own_across_t

contains

    pure subroutine outline(self, d)
        class(own_trough_t), intent(in) :: self
        type(description_t), intent(out) :: d

        d%name = "own_trough"
        d%title = "a trough that a student brought"
        d%coordinates = [coordinate("x", "m", "along"), coordinate("y", "m", "across")]
        d%parameters = [positive("m", "kg", "mass", 2.0_dp), positive("k", "N/m", "spring", 5.0_dp)]
    end subroutine outline

    pure function trough_lagrangian(self, t, q, v) result(l)
        class(own_trough_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof), v(self%ndof)
        type(hyperdual_t) :: l

        l = 0.5_dp*self%p(1)*((v(1) + v(2))**2 + v(2)**2) - 0.5_dp*self%p(2)*q(2)**2
    end function trough_lagrangian

    subroutine reduce(self, reduced)
        class(own_trough_t), intent(in) :: self
        class(reduced_t), allocatable, intent(out) :: reduced
        type(own_across_t) :: across
        type(error_t), allocatable :: error

        call across%configure(self%p, error)
        across%slip = self%slip
        allocate (reduced, source=across)
    end subroutine reduce

    pure subroutine describe(self, d)
        class(own_across_t), intent(in) :: self
        type(description_t), intent(out) :: d

        d%name = "own_across"
        d%coordinates = [coordinate("y", "m", "across")]
        d%parameters = [positive("m", "kg", "mass", self%m), positive("k", "N/m", "spring", self%k)]
        d%quantities = [quantity_t ::]
        d%points = [point_t ::]
    end subroutine describe

    pure subroutine configure(self, values, error)
        class(own_across_t), intent(inout) :: self
        real(dp), intent(in) :: values(:)
        type(error_t), allocatable, intent(out) :: error

        call check_parameters(self, values, error)
        if (allocated(error)) return
        self%ndof = 1
        self%velocity_forces = .false.
        self%m = values(1)
        self%k = values(2)
    end subroutine configure

    pure subroutine accelerations(self, t, q, v, a)
        class(own_across_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp), intent(out) :: a(self%ndof)

        a(1) = -self%k/self%m*q(1)
    end subroutine accelerations

    pure function lagrangian(self, t, q, v) result(l)
        class(own_across_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof), v(self%ndof)
        type(hyperdual_t) :: l

        l = 0.5_dp*self%m*v(1)**2 - 0.5_dp*self%k*q(1)**2
    end function lagrangian

    pure function energy(self, t, q, v) result(e)
        class(own_across_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp) :: e

        e = 0.5_dp*self%m*v(1)**2 + 0.5_dp*self%k*q(1)**2
    end function energy

    pure subroutine leave(self, q, v, q_left, v_left)
        class(own_across_t), intent(inout) :: self
        real(dp), intent(in) :: q(:), v(:)
        real(dp), intent(out) :: q_left(self%ndof), v_left(self%ndof)

        self%sum_q = q(1) + q(2)
        self%sum_v = v(1) + v(2)
        q_left(1) = q(2)
        v_left(1) = v(2)
    end subroutine leave

    pure subroutine complete(self, elapsed, q_left, v_left, q, v)
        class(own_across_t), intent(in) :: self
        real(dp), intent(in) :: elapsed, q_left(self%ndof), v_left(self%ndof)
        real(dp), intent(out) :: q(:), v(:)

        q(1) = self%sum_q + (self%sum_v + self%slip)*elapsed - q_left(1)
        v(1) = self%sum_v - v_left(1)
        q(2) = q_left(1)
        v(2) = v_left(1)
    end subroutine complete
end module own_reductions
