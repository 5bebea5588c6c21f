module own_closed_forms
    !! An own system with the closed form of its motion, and what may be wrong with it.
    use lagrangia_description, only: coordinate, description_t, positive
    use lagrangia_hyperdual, only: hyperdual_t, operator(*), operator(**), operator(+), operator(-)
    use lagrangia_kinds, only: dp
    use lagrangia_lagrangian_system, only: lagrangian_system_t
    use lagrangia_pendulum, only: pendulum_t
    use lagrangia_reference, only: reference_t
    implicit none (type, external)
    private
    public :: own_drag_t, own_plane_t, own_spring_t
    public :: right, wrong_size, wrong_start, wrong_motion, undefined

    enum, bind(c)
        enumerator :: right, wrong_size, wrong_start, wrong_motion, undefined
    end enum

    type, extends(lagrangian_system_t) :: own_spring_t
        !! A mass on a spring.
        integer :: kind = right      !! of the closed form
        real(dp) :: place = 1.0_dp   !! as far as it usually goes, m
    contains
        procedure :: outline
        procedure :: lagrangian
        procedure :: closed_form
    end type own_spring_t

    type, extends(reference_t) :: own_turns_t
        !! Turns by \(\omega(t - t_0)\) in the plane of \(x\) and \(\dot x/\omega\), for each
        !! coordinate.
        real(dp), dimension(2) :: omega = 0.0_dp, x0 = 0.0_dp, v0 = 0.0_dp
        real(dp) :: t0 = 0.0_dp
    contains
        procedure :: state_at
    end type own_turns_t

    type, extends(lagrangian_system_t) :: own_plane_t
        !! A mass on springs in a plane, whose closed form may err in one coordinate alone.
        integer :: wrong = 0     !! coordinate
        integer :: kind = right  !! what is wrong there, `wrong_start` or `wrong_motion`
    contains
        procedure :: outline => outline_plane
        procedure :: lagrangian => lagrangian_plane
        procedure :: closed_form => closed_form_plane
    end type own_plane_t

    type, extends(pendulum_t) :: own_drag_t
        !! Equations that are not the pendulum's any more, whose closed form it has inherited.
    contains
        procedure :: describe
        procedure :: accelerations
    end type own_drag_t

contains

    pure subroutine outline(self, d)
        class(own_spring_t), intent(in) :: self
        type(description_t), intent(out) :: d

        d%name = "own_spring"
        d%title = "a spring that a student brought"
        d%coordinates = [coordinate("x", "m", "from where the spring is relaxed")]
        d%parameters = [positive("m", "kg", "mass", 2.0_dp), positive("k", "N/m", "spring", 5.0_dp)]
        if (self%place < 1) d%typical_places = [self%place]
    end subroutine outline

    pure function lagrangian(self, t, q, v) result(l)
        class(own_spring_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof), v(self%ndof)
        type(hyperdual_t) :: l

        l = 0.5_dp*self%p(1)*v(1)**2 - 0.5_dp*self%p(2)*q(1)**2
    end function lagrangian

    subroutine closed_form(self, t0, q0, v0, reference)
        class(own_spring_t), intent(in) :: self
        real(dp), intent(in) :: t0, q0(:), v0(:)
        class(reference_t), allocatable, intent(out) :: reference
        type(own_turns_t) :: turns

        if (self%kind == undefined) return
        turns%title = "own turns"
        turns%ndof = merge(2, 1, self%kind == wrong_size)
        turns%omega = sqrt(self%p(2)/self%p(1))
        if (self%kind == wrong_motion) turns%omega = 1.0001_dp*turns%omega
        turns%t0 = t0
        turns%x0 = q0(1)
        if (self%kind == wrong_start) turns%x0 = 1.001_dp*q0(1)
        turns%v0 = v0(1)
        turns%period = 2.0_dp*acos(-1.0_dp)/turns%omega(1)
        allocate (reference, source=turns)
    end subroutine closed_form

    pure subroutine state_at(self, t, q, v)
        class(own_turns_t), intent(in) :: self
        real(dp), intent(in) :: t
        real(dp), intent(out) :: q(self%ndof), v(self%ndof)

        associate (omega => self%omega(:self%ndof), x0 => self%x0(:self%ndof), &
                   v0 => self%v0(:self%ndof))
            q = x0*cos(omega*(t - self%t0)) + v0/omega*sin(omega*(t - self%t0))
            v = v0*cos(omega*(t - self%t0)) - x0*omega*sin(omega*(t - self%t0))
        end associate
    end subroutine state_at

    pure subroutine outline_plane(self, d)
        class(own_plane_t), intent(in) :: self
        type(description_t), intent(out) :: d

        d%name = "own_plane"
        d%title = "springs in a plane that a student brought"
        d%coordinates = [coordinate("x", "m", "from rest"), coordinate("y", "m", "from rest")]
        d%parameters = [positive("m", "kg", "mass", 2.0_dp), positive("k", "N/m", "spring", 5.0_dp)]
    end subroutine outline_plane

    pure function lagrangian_plane(self, t, q, v) result(l)
        class(own_plane_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof), v(self%ndof)
        type(hyperdual_t) :: l

        l = 0.5_dp*self%p(1)*(v(1)**2 + v(2)**2) - 0.5_dp*self%p(2)*(q(1)**2 + q(2)**2)
    end function lagrangian_plane

    subroutine closed_form_plane(self, t0, q0, v0, reference)
        class(own_plane_t), intent(in) :: self
        real(dp), intent(in) :: t0, q0(:), v0(:)
        class(reference_t), allocatable, intent(out) :: reference
        type(own_turns_t) :: ellipse

        ellipse%title = "own ellipse"
        ellipse%ndof = 2
        ellipse%omega = sqrt(self%p(2)/self%p(1))
        ellipse%t0 = t0
        ellipse%x0 = q0
        ellipse%v0 = v0
        associate (k => self%wrong)
            if (self%kind == wrong_start) ellipse%v0(k) = v0(k) + 1e-3_dp
            if (self%kind == wrong_motion) ellipse%omega(k) = 1.0001_dp*ellipse%omega(k)
        end associate
        allocate (reference, source=ellipse)
    end subroutine closed_form_plane

    pure subroutine describe(self, d)
        class(own_drag_t), intent(in) :: self
        type(description_t), intent(out) :: d

        call self%pendulum_t%describe(d)
        d%name = "own_drag"
    end subroutine describe

    pure subroutine accelerations(self, t, q, v, a)
        class(own_drag_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp), intent(out) :: a(self%ndof)

        call self%pendulum_t%accelerations(t, q, v, a)
        a = a - 1e-3_dp*v
    end subroutine accelerations
end module own_closed_forms
