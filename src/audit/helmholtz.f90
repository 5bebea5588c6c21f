module lagrangia_helmholtz
    !! Do generalised forces beside L come from a potential of the kind \(U(q, \dot q, t)\),
    !! \(Q_i = \frac{d}{dt}\frac{\partial U}{\partial\dot q_i} - \frac{\partial U}{\partial q_i}\),
    !! which could as well be in L? Helmholtz' conditions for forces without accelerations:
    !!
    !! $$ \frac{\partial Q_i}{\partial\dot q_j} + \frac{\partial Q_j}{\partial\dot q_i} = 0,\quad
    !!    \frac{\partial Q_i}{\partial q_j} - \frac{\partial Q_j}{\partial q_i} =
    !!    \Bigl(\frac{\partial}{\partial t} + \dot q\cdot\frac{\partial}{\partial q}\Bigr)
    !!    \frac{\partial Q_i}{\partial\dot q_j} $$
    !!
    !! by exact derivatives, at states at random where a force acts: what fails there fails, what
    !! holds at all of them holds but for chance. The first one makes Q linear in the velocities:
    !! second derivatives would be symmetric in two of three indices and antisymmetric in two. A
    !! force that is steep somewhere else, as dry friction is, shows by what it becomes as its
    !! velocity turns round.
    !!
    !! Source: Santilli, *Foundations of Theoretical Mechanics I* (1978), sec. 2.2; H. v. Helmholtz,
    !! J. reine angew. Math. 100 (1887) 137.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use lagrangia_description, only: description_t
    use lagrangia_errors, only: error_t
    use lagrangia_hyperdual, only: hyperdual_t
    use lagrangia_kinds, only: dp
    use lagrangia_number_class, only: is_nonzero
    use lagrangia_random_draws, only: random_t
    use lagrangia_system, only: system_t
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: potential_text, test_potential

    integer, parameter :: states = 20
    integer, parameter :: most = 30              !! coordinates; beyond it is not tried
    real(dp), parameter :: rounding = 1e-11_dp   !! of the derivatives at a state

    type :: slopes_t
        !! Of the forces at one state, by (force, variable).
        real(dp), allocatable :: q(:, :), v(:, :)    !! by coordinates and velocities
        real(dp), allocatable :: rate(:, :)          !! of `v`, at constant velocities
        real(dp) :: scale = 0.0_dp                   !! the largest first one
        logical :: act = .false.                     !! a force is not 0 there
    end type slopes_t

contains

    subroutine test_potential(system, has_one, remark)
        !! Whether a system's forces beside L have a potential; if not, which condition fails, with
        !! numbers of one state. Without such forces, and where it is not known, the remark is "".
        class(system_t), intent(in) :: system                !! with its parameters
        logical, intent(out) :: has_one                      !! it does
        character(:), allocatable, intent(out) :: remark     !! `dQ_x/dx_dot = -0.4, not 0`
        type(random_t) :: random
        type(slopes_t) :: slopes
        type(error_t), allocatable :: error
        real(dp), allocatable :: q(:), v(:)
        real(dp) :: t
        integer :: k

        remark = ""
        has_one = .false.
        if (.not. system%nonconservative .or. system%ndof > most) return
        do k = 1, states
            call random%state(system, t, q, v, error)
            if (allocated(error)) return
            call differentiate(system, t, q, v, slopes)
            if (.not. (slopes%act .and. ieee_is_finite(slopes%scale))) cycle
            has_one = .true.
            call compare(system, slopes, remark)
            has_one = remark == ""
            if (.not. has_one) exit
        end do
        if (ieee_is_finite(slopes%scale)) call turn_round(system, t, q, v, slopes, remark)
        has_one = has_one .and. remark == ""
    end subroutine test_potential

    function potential_text(system) result(text)
        !! In words; "" where nothing is to be said.
        class(system_t), intent(in) :: system    !! with its parameters
        character(:), allocatable :: text
        logical :: has_one

        call test_potential(system, has_one, text)
        if (has_one) then
            text = "Q has a potential: Q = d/dt dU/dq_dot - dU/dq with some U(q, q_dot, t)"
        else if (text /= "") then
            text = "Q has no potential U(q, q_dot, t): "//text
        end if
    end function potential_text

    subroutine differentiate(system, t, q, v, slopes)
        !! All that the conditions need.
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t, q(:), v(:)
        type(slopes_t), intent(out) :: slopes
        type(hyperdual_t) :: tt, qq(size(q)), vv(size(q)), f(size(q))
        integer :: j, n

        n = size(q)
        allocate (slopes%q(n, n), slopes%v(n, n), slopes%rate(n, n))
        do j = 1, n
            call at_state()
            qq(j)%d1 = 1.0_dp
            call system%generalised_forces(tt, qq, vv, f)
            slopes%q(:, j) = f%d1
            slopes%act = slopes%act .or. any(is_nonzero(f%re))
            call at_state()
            tt%d2 = 1.0_dp
            qq%d2 = v
            vv(j)%d1 = 1.0_dp
            call system%generalised_forces(tt, qq, vv, f)
            slopes%v(:, j) = f%d1
            slopes%rate(:, j) = f%d12
        end do
        slopes%scale = max(maxval(abs(slopes%q)), maxval(abs(slopes%v)), maxval(abs(slopes%rate)))
    contains
        subroutine at_state()
            tt = hyperdual_t(re=t)
            qq = hyperdual_t()
            vv = hyperdual_t()
            qq%re = q
            vv%re = v
        end subroutine at_state
    end subroutine differentiate

    subroutine turn_round(system, t, q, v, slopes, remark)
        !! \(\partial Q_i/\partial\dot q_i = 0\), by the difference between \(\dot q_i\) and
        !! \(-\dot q_i\), where it is far more than the slope of the state makes of it.
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t, q(:), v(:)
        type(slopes_t), intent(in) :: slopes
        character(:), allocatable, intent(inout) :: remark
        real(dp), parameter :: far = 1e6_dp, noise = 1e-9_dp
        type(hyperdual_t), dimension(size(q)) :: qq, vv, here, there
        type(description_t) :: d
        integer :: i

        qq%re = q
        vv%re = v
        call system%generalised_forces(hyperdual_t(re=t), qq, vv, here)
        do i = 1, size(q)
            vv(i)%re = -v(i)
            call system%generalised_forces(hyperdual_t(re=t), qq, vv, there)
            vv(i)%re = v(i)
            if (.not. abs(there(i)%re - here(i)%re) > max(noise*abs(here(i)%re), &
                                                         far*abs(slopes%v(i, i)*v(i)))) cycle
            call system%describe(d)
            remark = "Q_"//trim(d%coordinates(i)%name)//" = "//to_text(here(i)%re)// &
                     " becomes "//to_text(there(i)%re)//" as "// &
                     trim(d%coordinates(i)%name)//"_dot turns round"
            return
        end do
    end subroutine turn_round

    subroutine compare(system, slopes, remark)
        !! The first condition that fails.
        class(system_t), intent(in) :: system
        type(slopes_t), intent(in) :: slopes
        character(:), allocatable, intent(out) :: remark
        type(description_t) :: d
        real(dp) :: curl
        integer :: i, j

        call system%describe(d)
        remark = ""
        do i = 1, system%ndof
            if (differ(slopes%v(i, i), 0.0_dp)) then
                remark = slope(i, i, "_dot")//" = "//to_text(slopes%v(i, i))//", not 0"
                return
            end if
        end do
        do i = 1, system%ndof
            do j = 1, i - 1
                if (differ(slopes%v(i, j), -slopes%v(j, i))) then
                    remark = slope(i, j, "_dot")//" = "//to_text(slopes%v(i, j))//" is not -"// &
                             slope(j, i, "_dot")//" = "//to_text(0.0_dp - slopes%v(j, i))
                    return
                end if
            end do
        end do
        do i = 1, system%ndof
            do j = 1, i - 1
                curl = slopes%q(j, i) - slopes%q(i, j)
                if (.not. differ(curl, slopes%rate(j, i))) cycle
                remark = slope(j, i, "")//" - "//slope(i, j, "")//" = "//to_text(0.0_dp + curl)// &
                         ", not "
                if (maxval(abs(slopes%v)) > 0.0_dp) remark = remark//"(d/dt) "// &
                    slope(j, i, "_dot")//" = "
                remark = remark//to_text(0.0_dp + slopes%rate(j, i))
                return
            end do
        end do
    contains
        logical function differ(left, right)
            real(dp), intent(in) :: left, right

            differ = abs(left - right) > rounding*slopes%scale
        end function differ

        function name(which) result(text)
            integer, intent(in) :: which
            character(:), allocatable :: text

            text = trim(d%coordinates(which)%name)
        end function name

        function slope(force, variable, after) result(text)
            integer, intent(in) :: force, variable
            character(*), intent(in) :: after
            character(:), allocatable :: text

            text = "dQ_"//name(force)//"/d"//name(variable)//after
        end function slope
    end subroutine compare
end module lagrangia_helmholtz
