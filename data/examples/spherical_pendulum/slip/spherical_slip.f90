module spherical_slip
    !! A slip as hands make it: the 2 of \(2\sin\theta\cos\theta\,\dot\theta\dot\varphi\) is lost.
    use lagrangia, only: description_t, dp
    use spherical_by_hand, only: spherical_by_hand_t
    implicit none (type, external)
    private
    public :: spherical_slip_t

    type, extends(spherical_by_hand_t) :: spherical_slip_t
    contains
        procedure :: outline
        procedure :: accelerations
    end type spherical_slip_t

contains

    pure subroutine outline(self, d)
        !! Under another name.
        class(spherical_slip_t), intent(in) :: self
        type(description_t), intent(out) :: d

        call self%spherical_by_hand_t%outline(d)
        d%name = "spherical_slip"
    end subroutine outline

    pure subroutine accelerations(self, t, q, v, a)
        !! Wrong: \(\ddot\varphi = -\dot\theta\dot\varphi\cot\theta\).
        class(spherical_slip_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp), intent(out) :: a(self%ndof)

        associate (l => self%p(2), g => self%p(3))
            a(1) = sin(q(1))*(cos(q(1))*v(2)**2 - g/l)
            a(2) = -v(1)*v(2)*cos(q(1))/sin(q(1))
        end associate
    end subroutine accelerations
end module spherical_slip
