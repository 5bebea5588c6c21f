module lagrangia_saddle
    !! An end near an unstable equilibrium, where any motion waits, and runs that have nothing else
    !! in common agree.
    !!
    !! Of \(\dot y = f(y)\), \(y = (q, \dot q)\), with the Jacobian J and its left vector \(l\) of a
    !! growing \(\lambda\), \(l\,f/\lambda\) is how far y is along the direction that leaves the
    !! equilibrium, \(l\,J^{-1} = l/\lambda\). Where that is not more than what parts the ends of
    !! several runs, the moment of leaving is not known, nor where the motion is by now.
    !! Source: Hirsch, Smale & Devaney, *Differential Equations, Dynamical Systems, and an
    !! Introduction to Chaos*, 3rd ed., sec. 8.3.
    use lagrangia_eigen, only: eigenpairs
    use lagrangia_errors, only: error_t
    use lagrangia_final_state, only: final_state_t
    use lagrangia_kinds, only: dp
    use lagrangia_number_class, only: all_finite
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: lingers, unresolved_growth

    integer, parameter :: most_coordinates = 60
    real(dp), parameter :: resolved = 0.1_dp   !! distance of the ends, along what leaves
    real(dp), parameter :: grows = 1e-3_dp     !! of the largest rate

contains

    pure function lingers(system, seen, hardly) result(yes)
        !! Does it hardly move at the end, nor begin to?
        class(system_t), intent(in) :: system     !! with its parameters
        type(final_state_t), intent(in) :: seen   !! of a run
        real(dp), intent(in) :: hardly            !! a share of the largest speed
        logical :: yes
        real(dp) :: a(system%ndof)

        call system%accelerations(seen%t, seen%q, seen%v, a)
        yes = all(abs(seen%v) <= hardly*seen%v_most) .and. &
              all(abs(a)*seen%q_most <= hardly*seen%v_most**2)
    end function lingers

    pure function unresolved_growth(system, seen, ends) result(rate)
        !! The largest growth rate of a direction along which the ends are not resolved; 0: of none.
        class(system_t), intent(in) :: system     !! with its parameters
        type(final_state_t), intent(in) :: seen   !! of a run
        real(dp), intent(in) :: ends(:, :)
        !! coordinates and velocities at the ends of runs, (2 ndof, runs), the first of `seen`
        real(dp) :: rate
        real(dp) :: jacobian(2*system%ndof, 2*system%ndof), slope(2*system%ndof), apart
        complex(dp) :: lambda(2*system%ndof), left(2*system%ndof, 2*system%ndof)
        type(error_t), allocatable :: error
        integer :: j, k

        rate = 0.0_dp
        if (system%ndof > most_coordinates) return
        call differentiate(system, seen, slope, jacobian)
        if (.not. all_finite(jacobian)) return
        call eigenpairs(transpose(jacobian), "growth rates", lambda, left, error)
        if (allocated(error)) return
        do j = 1, size(lambda)
            if (.not. real(lambda(j)) > max(rate, grows*maxval(abs(lambda)))) cycle
            apart = 0.0_dp
            do k = 2, size(ends, 2)
                apart = max(apart, abs(sum(left(:, j)*(ends(:, k) - ends(:, 1)))))
            end do
            if (apart > resolved*abs(sum(left(:, j)*slope)/lambda(j))) rate = real(lambda(j))
        end do
    end function unresolved_growth

    pure subroutine differentiate(system, seen, slope, jacobian)
        !! \(f\) and J at the end, by central differences.
        class(system_t), intent(in) :: system
        type(final_state_t), intent(in) :: seen
        real(dp), intent(out) :: slope(:), jacobian(:, :)
        real(dp), dimension(system%ndof) :: a, q, v
        real(dp) :: h, step(2*system%ndof)
        integer :: i, n, side

        n = system%ndof
        h = epsilon(h)**(1.0_dp/3.0_dp)
        call system%accelerations(seen%t, seen%q, seen%v, a)
        slope = [seen%v, a]
        step = h*[seen%q_most, seen%v_most]
        where (step <= 0.0_dp) step = h
        jacobian = 0.0_dp
        do i = 1, 2*n
            do side = -1, 1, 2
                q = seen%q
                v = seen%v
                if (i <= n) q(i) = q(i) + side*step(i)
                if (i > n) v(i - n) = v(i - n) + side*step(i)
                call system%accelerations(seen%t, q, v, a)
                jacobian(n + 1:, i) = jacobian(n + 1:, i) + side*a/(2.0_dp*step(i))
            end do
            if (i > n) jacobian(i - n, i) = 1.0_dp
        end do
    end subroutine differentiate
end module lagrangia_saddle
