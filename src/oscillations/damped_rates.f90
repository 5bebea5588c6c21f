module lagrangia_damped_rates
    !! Small oscillations with damping: \(M\ddot\delta + (C + G)\dot\delta + K\delta = 0\), where
    !! \(C = -\partial Q/\partial\dot q\), and \(-\partial Q/\partial q\) in K, are from the
    !! generalised forces beside L.
    use lagrangia_equilibrium, only: stiffness_beside
    use lagrangia_errors, only: error_t, fail, status_library
    use lagrangia_hyperdual, only: hyperdual, hyperdual_t
    use lagrangia_kinds, only: dp
    use lagrangia_lapack, only: solve_linear
    use lagrangia_lapack_eigen, only: dgeev
    use lagrangia_small_oscillations, only: modes_t
    use lagrangia_system, only: system_t
    use lagrangia_text, only: to_text
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

    pure subroutine damped_rates(system, modes, lambda, error)
        !! The exponents of \(e^{\lambda t}\), those with \(\mathrm{Im}\,\lambda\ge0\), the fastest
        !! oscillation last: \(-\mathrm{Re}\,\lambda\) is the decay rate, \(\mathrm{Im}\,\lambda\)
        !! the frequency. By LAPACK's `dgeev` in first-order form; two that nearly meet, at
        !! critical damping, are right to the root of epsilon.
        class(system_t), intent(in) :: system                 !! with its parameters
        type(modes_t), intent(in) :: modes                    !! without damping, solved
        complex(dp), allocatable, intent(out) :: lambda(:)    !! 1/s
        type(error_t), allocatable, intent(out) :: error      !! status 4: LAPACK
        real(dp), dimension(2*size(modes%omega2), 2*size(modes%omega2)) :: a
        real(dp), dimension(2*size(modes%omega2)) :: re, im
        real(dp), dimension(size(modes%at), size(modes%at)) :: turning, springs
        real(dp), dimension(size(modes%omega2), size(modes%omega2)) :: mass, damping, stiffness
        real(dp), dimension(size(modes%omega2)) :: column
        real(dp) :: none(1, 1), nothing(1, 1), work(40*size(modes%omega2) + 100)
        logical :: left(2*size(modes%omega2))
        real(dp) :: noise
        integer :: j, n, info

        n = size(modes%omega2)
        call damping_matrix(system, modes%at, turning)
        call stiffness_beside(system, modes%at, springs)
        mass = modes%allowed(modes%mass)
        damping = modes%allowed(turning + modes%gyroscopic)
        stiffness = modes%allowed(springs + modes%stiffness)
        a = 0.0_dp
        do j = 1, n
            a(j, n + j) = 1.0_dp
            call solve_linear(mass, -stiffness(:, j), column, error)
            if (allocated(error)) return
            a(n + 1:, j) = column
            call solve_linear(mass, -damping(:, j), column, error)
            if (allocated(error)) return
            a(n + 1:, n + j) = column
        end do
        call dgeev("N", "N", 2*n, a, 2*n, re, im, none, 1, nothing, 1, work, size(work), &
                   info)
        if (info /= 0) then
            call fail(error, "LAPACK found no damped modes (info = "//to_text(info)//")", &
                      status_library)
            return
        end if
        noise = 16*n*epsilon(noise)*maxval(hypot(re, im))
        where (abs(re) <= noise) re = 0.0_dp
        where (abs(im) <= noise) im = 0.0_dp
        left = im >= 0.0_dp
        allocate (lambda(0))
        do while (any(left))
            j = minloc(im + 1e-3_dp*abs(re), 1, left)
            lambda = [lambda, cmplx(re(j), im(j), dp)]
            left(j) = .false.
        end do
    end subroutine damped_rates
end module lagrangia_damped_rates
