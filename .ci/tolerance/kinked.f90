module kinked
    !! Oscillators whose force has a kink or a jump, and their motion in quadruple precision.
    use, intrinsic :: iso_fortran_env, only: real128
    use lagrangia_description, only: description_t
    use lagrangia_errors, only: error_t
    use lagrangia_hyperdual, only: hyperdual_t
    use lagrangia_kinds, only: dp
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: kinked_t, kinds, kind_names, exact_end

    integer, parameter :: qp = real128
    integer, parameter :: kinds = 4
    character(20), parameter :: kind_names(kinds) = [character(20) :: "spring sets in", &
        "friction sign(v)", "push sets in", "push jumps"]

    type, extends(system_t) :: kinked_t
        !! \(\ddot x = -x\), and from \(x > p\) on \(-J(x - p)\); or \(-J\,\mathrm{sign}\,\dot x\);
        !! or from \(t > p\) on \(J(t - p)\); or \(J\).
        integer :: which = 1
        real(dp) :: strength = 0.0_dp, place = 0.0_dp
    contains
        procedure :: configure
        procedure :: describe
        procedure :: accelerations
        procedure :: lagrangian
        procedure :: energy
    end type kinked_t

contains

    pure subroutine configure(self, values, error)
        !! Which kind, how strong, and where.
        class(kinked_t), intent(inout) :: self
        real(dp), intent(in) :: values(:)
        type(error_t), allocatable, intent(out) :: error

        self%ndof = 1
        self%velocity_forces = nint(values(1)) == 2
        self%time_dependent = nint(values(1)) > 2
        self%which = nint(values(1))
        self%strength = values(2)
        self%place = values(3)
    end subroutine configure

    pure subroutine describe(self, d)
        !! A name is enough.
        class(kinked_t), intent(in) :: self
        type(description_t), intent(out) :: d

        d%name = "kinked"
    end subroutine describe

    pure subroutine accelerations(self, t, q, v, a)
        !! See `kinked_t`.
        class(kinked_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp), intent(out) :: a(self%ndof)

        a = -q
        select case (self%which)
        case (1); a = a - self%strength*max(0.0_dp, q - self%place)
        case (2); a = a - sign(self%strength, v)
        case (3); a = a + self%strength*max(0.0_dp, t - self%place)
        case default; if (t > self%place) a = a + self%strength
        end select
    end subroutine accelerations

    pure function lagrangian(self, t, q, v) result(l)
        !! Not wanted.
        class(kinked_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof), v(self%ndof)
        type(hyperdual_t) :: l

        l = hyperdual_t()
    end function lagrangian

    pure function energy(self, t, q, v) result(e)
        !! Not wanted.
        class(kinked_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp) :: e

        e = 0.0_dp
    end function energy

    pure subroutine exact_end(system, q, v, t_end, q_end, v_end)
        !! From `t = 0`: pieces of \(\ddot x = -kx + b + ct\) in closed form; where one ends is
        !! bisected.
        class(kinked_t), intent(in) :: system
        real(dp), intent(in) :: q, v, t_end
        real(dp), intent(out) :: q_end, v_end
        real(qp) :: x, u, t, h, y, w, low, high, mid
        logical :: beyond
        integer :: i

        x = q
        u = v
        t = 0.0_qp
        do while (t < t_end)
            h = min(0.01_qp, t_end - t)
            beyond = side(system, t + 1e-28_qp, x + u*1e-28_qp, u - x*1e-28_qp)
            call piece(system, beyond, t, x, u, h, y, w)
            if (side(system, t + h, y, w) .neqv. beyond) then
                low = 0.0_qp
                high = h
                do i = 1, 110
                    mid = 0.5_qp*(low + high)
                    call piece(system, beyond, t, x, u, mid, y, w)
                    if (side(system, t + mid, y, w) .eqv. beyond) then
                        low = mid
                    else
                        high = mid
                    end if
                end do
                h = high
                call piece(system, beyond, t, x, u, h, y, w)
            end if
            t = t + h
            x = y
            u = w
        end do
        q_end = real(x, dp)
        v_end = real(u, dp)
    end subroutine exact_end

    pure function side(system, t, x, u) result(beyond)
        !! On which side of the kink.
        class(kinked_t), intent(in) :: system
        real(qp), intent(in) :: t, x, u
        logical :: beyond

        select case (system%which)
        case (1); beyond = x > system%place
        case (2); beyond = u > 0.0_qp
        case default; beyond = t > system%place
        end select
    end function side

    pure subroutine piece(system, beyond, t, x, u, h, y, w)
        !! The motion on one side of the kink.
        class(kinked_t), intent(in) :: system
        logical, intent(in) :: beyond
        real(qp), intent(in) :: t, x, u, h
        real(qp), intent(out) :: y, w
        real(qp) :: k, b, c, j, middle, r

        k = 1.0_qp
        b = 0.0_qp
        c = 0.0_qp
        j = system%strength
        select case (system%which)
        case (1)
            if (beyond) k = 1.0_qp + j
            if (beyond) b = j*system%place
        case (2)
            b = merge(-j, j, beyond)
        case (3)
            if (beyond) c = j
            if (beyond) b = -j*system%place
        case default
            if (beyond) b = j
        end select
        r = sqrt(k)
        middle = (b + c*t)/k
        y = middle + c*h/k + (x - middle)*cos(r*h) + (u - c/k)*sin(r*h)/r
        w = c/k - r*(x - middle)*sin(r*h) + (u - c/k)*cos(r*h)
    end subroutine piece
end module kinked
