module lagrangia_velocity_of_energy
    !! The velocity that gives a state an energy: of starts that are all to have the same one.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use lagrangia_kinds, only: dp
    use lagrangia_lagrange, only: euler_lagrange_t, expand_lagrangian
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: find_velocity, is_lost

    integer, parameter :: most = 100                              !! steps, and halvings of one
    real(dp), parameter :: rounding = 16.0_dp*epsilon(1.0_dp)     !! of the terms of an energy

contains

    subroutine find_velocity(system, t, q, v, which, energy, found)
        !! The larger root of \(E(q, \dot q) = E_0\) in one velocity. By
        !! \(\partial E/\partial\dot q_i = \sum_j M_{ij}\dot q_j\) it is that of a parabola where
        !! \(M\) does not depend on the velocities; elsewhere Newton's method begins there. What
        !! \(E_0\) lacks of the least energy by rounding of its terms, which may be large beside
        !! the kinetic energy, is no reason to find none.
        class(system_t), intent(in) :: system    !! with its parameters
        real(dp), intent(in) :: t, q(:)          !! time, s; coordinates
        real(dp), intent(inout) :: v(:)          !! velocities, of which one is found
        integer, intent(in) :: which             !! number of that velocity
        real(dp), intent(in) :: energy           !! \(E_0\), J
        logical, intent(out) :: found            !! there is such a velocity
        type(euler_lagrange_t) :: terms
        real(dp) :: a, b, c, discriminant, least, noise, step
        integer :: i

        v(which) = 0.0_dp
        call look_at()
        a = 0.5_dp*terms%mass(which, which)
        b = dot_product(terms%mass(which, :), v)
        discriminant = b**2 - 4.0_dp*a*c
        found = a > 0.0_dp .and. discriminant >= -4.0_dp*a*noise
        if (.not. found) return
        least = -b/(2.0_dp*a)
        step = sqrt(max(0.0_dp, discriminant))/(2.0_dp*a)
        v(which) = least
        do i = 1, most
            call go(step)
            found = abs(c) <= noise
            if (found) return
            b = dot_product(terms%mass(which, :), v)
            step = -c/b
            found = abs(step) <= epsilon(step)*abs(v(which))
            if (found .or. .not. ieee_is_finite(step)) return
        end do
    contains
        subroutine look_at()
            !! What the energy lacks, and what rounding may do to that: of
            !! \(E = T + V\) and \(L = T - V\) one is as large as the larger term.
            real(dp) :: here

            call expand_lagrangian(system, t, q, v, terms)
            here = system%energy(t, q, v)
            c = here - energy
            noise = rounding*max(abs(here), abs(energy), abs(terms%l), &
                                 system%natural_size(0, t, q, v))
        end subroutine look_at

        subroutine go(step)
            !! By a step, or by a part of it, as far as L is finite.
            real(dp), intent(in) :: step
            real(dp) :: from, part
            integer :: k

            from = v(which)
            part = step
            do k = 1, most
                v(which) = from + part
                call look_at()
                if (ieee_is_finite(c)) return
                part = 0.5_dp*part
            end do
        end subroutine go
    end subroutine find_velocity

    function is_lost(system, t, q, v, which) result(yes)
        !! Is a velocity as large as those of this state lost in the rounding of its energy, so that
        !! the energy does not tell it to a thousandth? Beside a rest energy it may be.
        class(system_t), intent(in) :: system    !! with its parameters
        real(dp), intent(in) :: t, q(:), v(:)    !! time, s; coordinates, velocities
        integer, intent(in) :: which             !! number of that velocity
        logical :: yes
        real(dp), parameter :: least = 1e3_dp    !! roundings
        real(dp) :: changed(size(v)), changes(2), energy
        integer :: i

        energy = system%energy(t, q, v)
        do i = 1, 2  ! of two velocities one has another energy
            changed = v
            changed(which) = v(which) + i*maxval(abs(v))
            changes(i) = system%energy(t, q, changed) - energy
        end do
        yes = maxval(abs(v)) > 0.0_dp .and. all(abs(changes) <= least*epsilon(energy)* &
                                        max(abs(energy), system%natural_size(0, t, q, v)))
    end function is_lost
end module lagrangia_velocity_of_energy
