module lagrangia_action_paths
    !! Paths between two points and their actions: closed forms, and limits of ever finer chains.
    use lagrangia_discrete_action, only: action_of, find_path
    use lagrangia_elliptic, only: elliptic_k, jacobi
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp
    use lagrangia_richardson, only: extrapolated
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: extrapolated_action, extrapolated_change
    public :: oscillator_action, oscillator_path, straight, pendulum_path, pendulum_period

    real(dp), parameter :: pi = acos(-1.0_dp)
    integer, parameter :: levels = 6, coarsest = 16  !! of Richardson's extrapolation

contains

    subroutine extrapolated_action(system, time, start, finish, action, error)
        !! \(S\) of the path from `start` to `finish`, the limit of ever finer chains of points.
        class(system_t), intent(in) :: system  !! with its parameters
        real(dp), intent(in) :: time, start, finish  !! s; the two ends, m
        real(dp), intent(out) :: action  !! J s
        type(error_t), allocatable, intent(out) :: error  !! allocated where it fails
        real(dp), allocatable :: path(:, :)
        real(dp) :: actions(levels)
        integer :: i, n

        action = 0.0_dp
        do i = 1, levels
            n = coarsest*2**(i - 1)
            path = straight(start, finish, n)
            call find_path(system, 0.0_dp, time/n, path, error)
            if (allocated(error)) return
            actions(i) = action_of(system, 0.0_dp, time/n, path)
        end do
        action = extrapolated(actions)
    end subroutine extrapolated_action

    subroutine extrapolated_change(system, time, start, finish, a, change, error)
        !! \(S[x + a\sin(\pi t/T)] - S[x]\).
        class(system_t), intent(in) :: system  !! with its parameters
        real(dp), intent(in) :: time, start, finish, a  !! s; the two ends, m; the amplitude, m
        real(dp), intent(out) :: change  !! J s
        type(error_t), allocatable, intent(out) :: error  !! allocated where it fails
        real(dp), allocatable :: path(:, :), varied(:, :)
        real(dp) :: changes(levels)
        integer :: i, j, n

        change = 0.0_dp
        do i = 1, levels
            n = coarsest*2**(i - 1)
            path = straight(start, finish, n)
            call find_path(system, 0.0_dp, time/n, path, error)
            if (allocated(error)) return
            varied = path
            varied(1, :) = varied(1, :) + [(a*sin(pi*j/n), j=0, n)]
            changes(i) = action_of(system, 0.0_dp, time/n, varied) &
                         - action_of(system, 0.0_dp, time/n, path)
        end do
        change = extrapolated(changes)
    end subroutine extrapolated_change

    pure function straight(start, finish, n) result(path)
        !! `n` equal pieces, (1, n + 1).
        real(dp), intent(in) :: start, finish  !! the two ends
        integer, intent(in) :: n  !! steps between them
        real(dp) :: path(1, n + 1)
        integer :: j

        path(1, :) = [(start + (finish - start)*j/n, j=0, n)]
        path(1, n + 1) = finish
    end function straight

    pure function oscillator_path(t, time, w, start, finish) result(x)
        !! \((x_a\sin\omega(T-t) + x_b\sin\omega t)/\sin\omega T\): from `start` to `finish`.
        real(dp), intent(in) :: t, time, w, start, finish
        !! s; s, of the whole path; rad/s; the two ends, m
        real(dp) :: x

        x = (start*sin(w*(time - t)) + finish*sin(w*t))/sin(w*time)
    end function oscillator_path

    pure function oscillator_action(mass, stiffness, time, start, finish) result(s)
        !! $$ S = \frac{m\omega}{2\sin\omega T}\left[(x_a^2+x_b^2)\cos\omega T - 2x_ax_b\right] $$
        real(dp), intent(in) :: mass, stiffness, time, start, finish  !! kg; N/m; s; the two ends, m
        real(dp) :: s, w

        w = sqrt(stiffness/mass)
        s = 0.5_dp*mass*w/sin(w*time)*((start**2 + finish**2)*cos(w*time) - 2.0_dp*start*finish)
    end function oscillator_action

    pure function pendulum_path(t, amplitude, g_over_l) result(theta)
        !! A pendulum released at `amplitude`: \(2\arcsin(k\,\mathrm{cd}\,\omega_0t)\).
        real(dp), intent(in) :: t, amplitude, g_over_l  !! s; rad; 1/s^2
        real(dp) :: theta, sn, cn, dn

        call jacobi(sqrt(g_over_l)*t, cos(0.5_dp*amplitude), sn, cn, dn)
        theta = 2.0_dp*asin(sin(0.5_dp*amplitude)*cn/dn)
    end function pendulum_path

    pure function pendulum_period(amplitude, g_over_l) result(period)
        !! \(4K/\omega_0\).
        real(dp), intent(in) :: amplitude, g_over_l  !! rad; 1/s^2
        real(dp) :: period

        period = 4.0_dp*elliptic_k(cos(0.5_dp*amplitude))/sqrt(g_over_l)
    end function pendulum_period
end module lagrangia_action_paths
