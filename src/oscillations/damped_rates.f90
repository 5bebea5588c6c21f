module lagrangia_damped_rates
    !! Small oscillations with damping: \(M\ddot\delta + (C + G)\dot\delta + K\delta = 0\), where
    !! \(C = -\partial Q/\partial\dot q\), and \(-\partial Q/\partial q\) in K, are from the
    !! generalised forces beside L.
    use lagrangia_equilibrium, only: stiffness_beside
    use lagrangia_errors, only: error_t
    use lagrangia_hyperdual, only: hyperdual, hyperdual_t
    use lagrangia_kinds, only: dp
    use lagrangia_number_class, only: is_zero
    use lagrangia_quadratic_eigen, only: quadratic_eigenvalues
    use lagrangia_small_oscillations, only: modes_t
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: damped_rates, damping_matrix

contains

    pure subroutine damping_matrix(system, q, damping)
        !! \(C = -\partial Q/\partial\dot q\) at rest.
        class(system_t), intent(in) :: system       !! with its parameters
        real(dp), intent(in) :: q(:)                !! (n), the equilibrium
        real(dp), intent(out) :: damping(:, :)      !! (n, n), kg/s, or kg m^2/s of angles
        type(hyperdual_t) :: v(size(q)), f(size(q))
        integer :: j

        do j = 1, size(q)
            v = hyperdual_t()
            v(j)%d1 = 1.0_dp
            call system%generalised_forces(hyperdual_t(), hyperdual(q), v, f)
            damping(:, j) = -f%d1
        end do
    end subroutine damping_matrix

    subroutine damped_rates(system, modes, lambda, error, rounding, distance, unsure)
        !! The exponents of \(e^{\lambda t}\), those with \(\mathrm{Im}\,\lambda\ge0\), the fastest
        !! oscillation last, of two alike but for rounding the one that grows first:
        !! \(-\mathrm{Re}\,\lambda\) is the decay rate, \(\mathrm{Im}\,\lambda\) the frequency.
        !! Slow ones are as right as fast ones. At critical damping two meet, and rounding splits
        !! them by its root: where that may be all that parts those of one coordinate, both are
        !! \(-C/(2M)\); of several coordinates they are right to that root.
        class(system_t), intent(in) :: system                 !! with its parameters
        type(modes_t), intent(in) :: modes                    !! without damping, solved
        complex(dp), allocatable, intent(out) :: lambda(:)    !! 1/s
        type(error_t), allocatable, intent(out) :: error      !! status 4: LAPACK
        real(dp), allocatable, intent(out), optional :: rounding(:)
        !! how far it may have moved the decay rates of oscillations, 1/s
        real(dp), allocatable, intent(out), optional :: distance(:)
        !! how far it may have moved frequencies, and decay rates without oscillation, 1/s
        real(dp), intent(in), optional :: unsure(:, :)
        !! by how much more than its rounding K may be off, (n, n); else nothing
        real(dp), dimension(size(modes%at), size(modes%at)) :: springs
        real(dp), allocatable, dimension(:, :) :: mass, stiffness, turning  !! that are allowed
        complex(dp), allocatable :: all_lambda(:)
        real(dp), allocatable :: all_rounding(:), rank(:)
        logical, allocatable :: left(:)
        real(dp), parameter :: alike = 1e-9_dp, split = 8.0_dp*sqrt(epsilon(1.0_dp))
        integer, allocatable :: order(:)
        integer :: j

        allocate (turning(size(modes%at), size(modes%at)))
        call damping_matrix(system, modes%at, turning)
        call stiffness_beside(system, modes%at, springs)
        mass = modes%allowed(modes%mass)
        stiffness = modes%allowed(springs + modes%stiffness)
        turning = modes%allowed(turning + modes%gyroscopic)
        springs = 0.0_dp
        if (present(unsure)) springs = unsure
        call quadratic_eigenvalues(mass, turning, stiffness, all_lambda, error, all_rounding, &
                                   distance, modes%allowed(springs))
        if (allocated(error)) return
        if (size(all_lambda) == 2) then
            if (abs(all_lambda(2) - all_lambda(1)) <= split*abs(all_lambda(1))) then
                all_lambda = -turning(1, 1)/(2.0_dp*mass(1, 1))
                if (present(distance)) distance = parting(mass(1, 1), turning(1, 1), &
                                                              stiffness(1, 1))
            end if
        end if
        allocate (left, source=aimag(all_lambda) >= 0.0_dp)
        allocate (order(0))
        do while (any(left))
            rank = aimag(all_lambda) + 1e-3_dp*abs(real(all_lambda))
            j = maxloc(real(all_lambda), 1, left .and. &
                       rank <= (1.0_dp + alike)*minval(rank, left))
            if (j == 0) exit  ! what is left is no number
            order = [order, j]
            left(j) = .false.
        end do
        lambda = all_lambda(order)
        if (present(rounding)) rounding = all_rounding(order)
        if (present(distance)) distance = distance(order)
    contains
        pure function parting(m, c, k) result(distance)
            ! How far two roots that are taken for one may be from their mean.
            real(dp), intent(in) :: m, c, k
            real(dp) :: distance, discriminant

            discriminant = c**2 - 4.0_dp*m*k
            distance = 0.0_dp
            if (is_zero(discriminant)) return
            distance = sqrt(abs(discriminant) + 4.0_dp*epsilon(m)*c**2)/(2.0_dp*m)
        end function parting
    end subroutine damped_rates
end module lagrangia_damped_rates
