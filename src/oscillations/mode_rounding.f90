module lagrangia_mode_rounding
    !! How far rounding may have moved the squares of frequencies and the shapes of modes: that of
    !! the sums in K, G and M, and that of the parameters, which a double holds to
    !! \(\epsilon/2\). Where terms of K nearly cancel, as of a bead on a hoop at its critical
    !! \(\Omega\), the second is nearly all.
    use lagrangia_description, only: default_values, description_t
    use lagrangia_equilibrium, only: expand_at_rest
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp
    use lagrangia_number_class, only: all_finite, is_nonzero
    use lagrangia_small_oscillations, only: is_zero_mode, largest_expansion, modes_t, twin_of
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: find_rounding, mode_rounding_t

    type mode_rounding_t
        !! How far numbers of n coordinates' modes may be off.
        real(dp), allocatable :: squares(:)       !! of \(\omega^2\), (modes), s^-2
        real(dp), allocatable :: shapes(:, :)     !! of the components, (n, modes)
        real(dp), allocatable :: springs(:, :)    !! of K by the parameters alone, (n, n)
        integer, allocatable :: alike(:)
        !! of (modes), the last mode before that has the same frequency to rounding; 0: none
    end type mode_rounding_t

contains

    subroutine find_rounding(system, modes, rounding)
        !! First order in the changes of the matrices: with \(\lambda_j = i\omega_j\) and
        !! \(D_{kj} = u_k^\dagger(\delta K + \lambda_j\,\delta G + \lambda_j^2\,\delta M)u_j\) a
        !! square moves by \(D_{jj}\,c_j\), \(c_j = 2\omega_j^2/(\omega_j^2 + u_j^\dagger Ku_j)\),
        !! which is 1 without G; the shape \(u_j\) gets
        !! \(u_k D_{kj}c_k/(\omega_j^2 - \omega_k^2)\). Modes that are nearer to each other than
        !! rounding moves them have no shapes of their own: any that they span will do, and they
        !! don't count as moved by each other. Those of a mode that grows are estimates of size.
        class(system_t), intent(in) :: system           !! with its parameters
        type(modes_t), intent(in) :: modes              !! of this system, solved
        type(mode_rounding_t), intent(out) :: rounding  !! of these modes
        complex(dp), allocatable :: rest(:), u(:, :)
        real(dp), allocatable :: moved(:, :), lean(:)
        real(dp) :: gap, tilt
        integer :: j, k, n

        n = size(modes%omega2)
        allocate (u(size(modes%at), n), moved(n, n))
        allocate (rounding%springs, source=0.0_dp*modes%stiffness)
        u = modes%shapes
        if (allocated(modes%quadrature)) u = cmplx(modes%shapes, modes%quadrature, dp)
        call add_sums(modes, moved)
        if (size(modes%at) <= largest_expansion .and. system%constraints == 0) then
            call add_parameters(system, modes, u, moved, rounding%springs)
        end if
        lean = leans(modes, u)
        rounding%squares = lean*[(moved(j, j), j=1, n)]
        where (modes%label == is_zero_mode) rounding%squares = zero_bound(modes, rounding%squares)
        allocate (rounding%shapes(size(modes%at), n), source=0.0_dp)
        allocate (rounding%alike(n), source=0)
        if (size(modes%at) > largest_expansion) return
        do j = 1, n
            associate (lambda => lambda_of(modes, j))
                rest = matmul(modes%stiffness, u(:, j)) + lambda**2*matmul(modes%mass, u(:, j))
                if (allocated(modes%quadrature)) then
                    rest = rest + lambda*matmul(modes%gyroscopic, u(:, j))
                end if
            end associate
            do k = 1, n
                if (k == j) cycle
                gap = abs(modes%omega2(j) - modes%omega2(k))
                tilt = lean(k)*(moved(k, j) + abs(dot_product(u(:, k), rest)))
                if (gap <= tilt) then
                    if (k < j .and. modes%turning(j) <= 0.0_dp) rounding%alike(j) = k
                    cycle
                end if
                rounding%shapes(:, j) = rounding%shapes(:, j) + tilt/gap*abs(u(:, k))
            end do
        end do
    end subroutine find_rounding

    pure function zero_bound(modes, squares) result(bounds)
        !! A zero mode is one whose \(\omega^2\) is not seen beside these.
        type(modes_t), intent(in) :: modes
        real(dp), intent(in) :: squares(:)  !! by rounding of sums and parameters
        real(dp) :: bounds(size(squares))

        bounds = size(modes%at)*squares
        if (allocated(modes%quadrature)) bounds = max(bounds, 16*size(squares)*epsilon(1.0_dp)* &
            min(maxval(abs(modes%omega2)), maxval(abs(modes%stiffness))* &
                sum(modes%shapes**2 + modes%quadrature**2, 1)))
    end function zero_bound

    pure function lambda_of(modes, j) result(lambda)
        !! \(i\omega\), or the growth rate.
        type(modes_t), intent(in) :: modes
        integer, intent(in) :: j
        complex(dp) :: lambda

        lambda = sqrt(cmplx(-modes%omega2(j), 0.0_dp, dp))
    end function lambda_of

    pure function leans(modes, u) result(lean)
        !! \(c_j\); 1 of two modes with one shape, whose mean is known as well as without G, and of
        !! those that grow.
        type(modes_t), intent(in) :: modes
        complex(dp), intent(in) :: u(:, :)
        real(dp) :: lean(size(u, 2))
        integer :: j, k
        real(dp) :: total

        lean = 1.0_dp
        if (.not. allocated(modes%quadrature)) return
        do j = 1, size(lean)
            if (.not. modes%omega2(j) > 0.0_dp) cycle
            total = modes%omega2(j) + real(dot_product(u(:, j), &
                                                       matmul(modes%stiffness, u(:, j))), dp)
            lean(j) = 2.0_dp*modes%omega2(j)/max(abs(total), epsilon(total)*modes%omega2(j))
        end do
        do j = 2, size(lean)
            k = twin_of(modes, j)
            if (k > 0) lean([j, k]) = 1.0_dp
        end do
    end function leans

    pure subroutine add_sums(modes, moved)
        !! \(4\epsilon\,|u_k|^\top(|K| + |\lambda_j||G| + |\lambda_j|^2|M|)|u_j|\).
        type(modes_t), intent(in) :: modes
        real(dp), intent(out) :: moved(:, :)
        real(dp) :: u(size(modes%shapes, 1), size(modes%shapes, 2)), turned(size(u, 1))
        integer :: j

        u = abs(modes%shapes)
        if (allocated(modes%quadrature)) u = abs(cmplx(modes%shapes, modes%quadrature, dp))
        do j = 1, size(u, 2)
            associate (square => abs(modes%omega2(j)))
                turned = matmul(abs(modes%stiffness) + square*abs(modes%mass), u(:, j))
                if (allocated(modes%quadrature)) then
                    turned = turned + sqrt(square)*matmul(abs(modes%gyroscopic), u(:, j))
                end if
            end associate
            if (size(modes%at) > largest_expansion) then
                moved(j, j) = 4.0_dp*epsilon(1.0_dp)*dot_product(u(:, j), turned)
            else
                moved(:, j) = 4.0_dp*epsilon(1.0_dp)*matmul(turned, u)
            end if
        end do
    end subroutine add_sums

    subroutine add_parameters(system, modes, u, moved, stiffness_moved)
        !! Those of each parameter, from matrices with one that is a little larger.
        class(system_t), intent(in) :: system
        type(modes_t), intent(in) :: modes
        complex(dp), intent(in) :: u(:, :)
        real(dp), intent(inout) :: moved(:, :), stiffness_moved(:, :)
        real(dp), parameter :: step = 2.0_dp**(-20)
        real(dp), dimension(size(u, 1), size(u, 1)) :: mass, stiffness, turning, mass_there, &
                                                       stiffness_there, turning_there
        class(system_t), allocatable :: there
        type(description_t) :: d
        real(dp), allocatable :: values(:), changed(:)
        type(error_t), allocatable :: error
        integer :: i, j

        call system%describe(d)
        allocate (values, source=default_values(d))
        call expand_at_rest(system, modes%at, mass, stiffness, turning)
        do i = 1, size(values)
            if (.not. abs(values(i)) > 0.0_dp) cycle  ! 0, or not given
            changed = values
            changed(i) = (1.0_dp + step)*values(i)
            allocate (there, source=system)
            call there%configure(changed, error)
            if (.not. allocated(error)) then
                call expand_at_rest(there, modes%at, mass_there, stiffness_there, turning_there)
                call add_change(mass_there - mass, stiffness_there - stiffness, &
                                turning_there - turning)
            end if
            deallocate (there)
        end do
    contains
        subroutine add_change(mass_change, stiffness_change, turning_change)
            real(dp), intent(in), dimension(:, :) :: mass_change, stiffness_change, turning_change
            complex(dp) :: lambda, column(size(u, 1))

            if (.not. all_finite(mass_change) .or. .not. all_finite(stiffness_change)) return
            stiffness_moved = stiffness_moved + 0.5_dp*epsilon(1.0_dp)/step*abs(stiffness_change)
            do j = 1, size(moved, 2)
                lambda = lambda_of(modes, j)
                column = matmul(stiffness_change, u(:, j)) + lambda**2*matmul(mass_change, u(:, j))
                if (any(is_nonzero(turning_change))) then
                    column = column + lambda*matmul(turning_change, u(:, j))
                end if
                moved(:, j) = moved(:, j) + 0.5_dp*epsilon(1.0_dp)/step* &
                    abs(matmul(conjg(transpose(u)), column))
            end do
        end subroutine add_change
    end subroutine add_parameters
end module lagrangia_mode_rounding
