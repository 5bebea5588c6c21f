module lagrangia_small_oscillations
    !! From a system and an equilibrium to labelled modes.
    !!
    !! Linearised about an equilibrium, Lagrange's equations are
    !! \(M\ddot\delta + G\dot\delta + K\delta = 0\) with \(M = L_{vv}\), \(G = L_{vq} - L_{qv}\) and
    !! \(K = -L_{qq}\): once as derived by hand, once from the exact second derivatives of L.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use lagrangia_counted, only: counted
    use lagrangia_description, only: description_t
    use lagrangia_eigen, only: modes_from_factors, out_of_range, residual_ratio
    use lagrangia_equilibrium, only: expand_at_rest, expansion_moves, force_at_rest, settle
    use lagrangia_errors, only: error_t, fail
    use lagrangia_gyroscopic, only: gyroscopic_modes, gyroscopic_ratio, is_steady
    use lagrangia_hyperdual, only: hyperdual_t
    use lagrangia_jacobi, only: zero_modes
    use lagrangia_kinds, only: dp
    use lagrangia_linearised, only: linearised_t
    use lagrangia_mass_matrix, only: check_mass_matrix, list_of
    use lagrangia_normal_modes, only: is_oscillation, is_unstable, is_zero_mode, normal_modes, &
                                      normal_modes_t, put_labels
    use lagrangia_number_class, only: all_finite, is_nonzero, is_zero
    use lagrangia_resources, only: check_memory
    use lagrangia_system, only: system_t
    use lagrangia_tangent_space, only: check_integrable, find_tangent, tangent_t, within
    use lagrangia_text, only: to_text
    use lagrangia_time_in_motion, only: motion_contains_time
    use lagrangia_vectors, only: farthest
    implicit none (type, external)
    private
    public :: modes_t, find_modes, largest_expansion, likely_equilibrium, stays, twin_of
    public :: is_oscillation, is_zero_mode, is_unstable

    integer, parameter :: largest_expansion = 60  !! coordinates; beyond, L is not differentiated
    integer, parameter :: matrices = 20           !! n by n, that are needed at one time

    type, extends(normal_modes_t) :: modes_t
        real(dp), allocatable :: at(:)             !! the equilibrium
        type(linearised_t) :: analytic             !! as derived by hand, where it was
        real(dp), allocatable :: mass(:, :), stiffness(:, :), gyroscopic(:, :)  !! what was solved
        real(dp) :: difference = -1.0_dp           !! of `analytic` from L, relative; < 0: unknown
        real(dp), allocatable :: basis(:, :)       !! directions that constraints leave, (n, modes)
        real(dp), allocatable :: multipliers(:)    !! of the constraints at the equilibrium
        real(dp), allocatable :: quadrature(:, :)  !! with \(G\): shape cos - quadrature sin
        real(dp), allocatable :: turning(:)
        !! rad/s of an unstable mode that turns while it grows, as \(G\) may let it, \(\omega^2\)
        !! being complex and `omega2` less the square of the growth rate; 0 of all others
        real(dp) :: ratio = -1.0_dp                !! LAPACK's residual ratio
        character(40) :: method = ""
    contains
        procedure :: allowed
    end type modes_t

contains

    subroutine find_modes(system, start, wanted, modes, error)
        !! The modes about the equilibrium `start`; where that is only a guess (not `wanted`), about
        !! the nearest equilibrium. Fails (status 2) where there is none.
        class(system_t), intent(in) :: system  !! configured
        real(dp), intent(in) :: start(:)       !! (ndof)
        logical, intent(in) :: wanted          !! a start that is no equilibrium is refused
        type(modes_t), intent(out) :: modes    !! incomplete after an error
        type(error_t), allocatable, intent(out) :: error
        !! status 2: no equilibrium; 4: memory, mass matrix, LAPACK
        integer :: n

        n = system%ndof
        call check_system(system, start, wanted, error)
        if (.not. allocated(error)) call check_memory(8.0_dp*matrices*n**2, "the eigenproblem "// &
            "of "//to_text(n)//" coordinates", error)
        if (allocated(error)) return
        modes%at = start
        call settle(system, wanted, modes%at, error)
        if (allocated(error)) return
        if (expansion_moves(system, modes%at)) then
            call fail(error, "M and K, the second derivatives of L, contain the time, which "// &
                      "drops out of the equation of motion; an L of the same motion without "// &
                      "it is needed")
            return
        end if
        call system%linearise(modes%at, modes%analytic)
        allocate (modes%mass(n, n), modes%stiffness(n, n), modes%gyroscopic(n, n))
        if (n <= largest_expansion .or. .not. allocated(modes%analytic%mass)) then
            call expand_at_rest(system, modes%at, modes%mass, modes%stiffness, modes%gyroscopic)
            if (allocated(modes%analytic%mass)) call compare(modes)
        end if
        if (allocated(modes%analytic%mass)) then
            modes%mass = modes%analytic%mass
            modes%stiffness = modes%analytic%stiffness
            modes%gyroscopic = 0.0_dp
            if (allocated(modes%analytic%gyroscopic)) modes%gyroscopic = modes%analytic%gyroscopic
        else
            call check_mass_matrix(modes%mass, error)
        end if
        if (allocated(error)) then
            call error%add_context("at q = "//list_of(modes%at)//", v = 0")
            return
        end if
        if (system%constraints > 0) then
            call solve_constrained(system, modes, error)
        else
            call solve(modes, error)
        end if
    end subroutine find_modes

    subroutine solve_constrained(system, modes, error)
        !! In the directions that the constraints leave, with the stiffness of the multipliers.
        class(system_t), intent(in) :: system
        type(modes_t), intent(inout) :: modes
        type(error_t), allocatable, intent(out) :: error
        type(tangent_t) :: tangent
        type(modes_t) :: free

        call find_tangent(system, modes%at, tangent, error)
        if (allocated(error)) return
        allocate (modes%multipliers(system%constraints))
        call tangent%find_multipliers(force_at_rest(system, modes%at), modes%multipliers, error)
        if (allocated(error)) return
        modes%stiffness = modes%stiffness + tangent%stiffness(modes%multipliers)
        free%mass = within(tangent%basis, modes%mass)
        free%stiffness = within(tangent%basis, modes%stiffness)
        free%gyroscopic = within(tangent%basis, modes%gyroscopic)
        call solve(free, error)
        if (allocated(error)) return
        modes%omega2 = free%omega2
        modes%omega = free%omega
        modes%label = free%label
        modes%method = free%method
        modes%ratio = free%ratio
        modes%shapes = matmul(tangent%basis, free%shapes)
        modes%turning = free%turning
        if (allocated(free%quadrature)) modes%quadrature = matmul(tangent%basis, free%quadrature)
        call move_alloc(tangent%basis, modes%basis)
    end subroutine solve_constrained

    pure function allowed(self, matrix) result(inner)
        !! A matrix of the coordinates within the directions that the constraints leave; without
        !! constraints as it is.
        class(modes_t), intent(in) :: self       !! solved
        real(dp), intent(in) :: matrix(:, :)     !! (n, n)
        real(dp) :: inner(size(self%omega2), size(self%omega2))

        if (allocated(self%basis)) then
            inner = within(self%basis, matrix)
        else
            inner = matrix
        end if
    end function allowed

    subroutine solve(modes, error)
        !! The eigenproblem of M, G and K.
        type(modes_t), intent(inout) :: modes
        type(error_t), allocatable, intent(out) :: error
        integer :: i

        if (any(is_nonzero(modes%gyroscopic))) then
            call solve_gyroscopic(modes, error)
        else if (allocated(modes%analytic%root)) then
            modes%method = "dgejsv on the factors of K and M"
            if (any([(modes%mass(i, i) < tiny(1.0_dp), i=1, size(modes%mass, 1))])) then
                call out_of_range(error)  ! m l^2 is none, though the factors of M are numbers
                return
            end if
            call modes_from_factors(modes%analytic%root, modes%analytic%inverse, modes%omega2, &
                                    modes%shapes, error)
        else
            modes%method = merge("dsygv ", "dsygvd", size(modes%mass, 1) <= 32)
            call normal_modes(modes%stiffness, modes%mass, modes%omega2, modes%shapes, error)
        end if
        if (allocated(error)) return
        if (.not. allocated(modes%quadrature)) then
            modes%turning = 0.0_dp*modes%omega2
            modes%ratio = residual_ratio(modes%stiffness, modes%mass, modes%omega2, modes%shapes)
        end if
        call label_modes(modes)
    end subroutine solve

    pure function likely_equilibrium(system) result(q)
        !! Where an equilibrium is looked for first: where the description says, or at zero.
        class(system_t), intent(in) :: system  !! configured
        real(dp) :: q(system%ndof)
        type(description_t) :: d

        q = 0.0_dp
        call system%describe(d)
        if (.not. allocated(d%equilibrium)) return
        if (size(d%equilibrium) == system%ndof) q = d%equilibrium
    end function likely_equilibrium

    subroutine check_system(system, start, wanted, error)
        !! Refuse a system without a constant \(M\), \(G\) and \(K\): not configured, with
        !! nonholonomic constraints, or with the time in its equation of motion.
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: start(:)
        logical, intent(in) :: wanted   !! somebody has given it
        type(error_t), allocatable, intent(out) :: error
        type(description_t) :: d
        type(hyperdual_t) :: qq(size(start)), vv(size(start)), l

        if (system%ndof < 1) then
            call fail(error, "the system has no coordinates: configure it first")
            return
        end if
        call system%describe(d)
        if (size(start) /= system%ndof) then
            call fail(error, "an equilibrium of "//trim(d%name)//" has "// &
                      counted(system%ndof, "value")//", not "//to_text(size(start))//trim(merge( &
                      "; a decimal point, no comma, is needed in a number", repeat(" ", 50), &
                      size(start) == 2*system%ndof)))
        else if (system%constraints > 0) then
            call check_integrable(system, start, error)
            if (allocated(error)) call error%add_context(trim(d%name))
        end if
        if (allocated(error)) return
        if (motion_contains_time(system)) call fail(error, "the equation of motion of this "// &
            trim(d%name)//" contains the time: there are no normal modes about a place at rest")
        if (allocated(error)) return
        if (any(.not. ieee_is_finite(start)) .and. wanted) then
            call fail(error, "a place for the modes of "//trim(d%name)//" is no finite number: "// &
                      list_of(start), key="at")
            return
        else if (any(.not. ieee_is_finite(start))) then
            call fail(error, "with these parameters the equilibrium of "//trim(d%name)// &
                      " is no number: a root of a negative number, a sine or cosine beyond 1, "// &
                      "or a division by zero")
            return
        end if
        qq%re = start
        l = system%lagrangian(hyperdual_t(), qq, vv)
        if (.not. ieee_is_finite(l%re)) then
            call refuse_start(system, d, "L", start, wanted, error)
        else if (.not. all_finite(force_at_rest(system, start))) then
            call refuse_start(system, d, "a force", start, wanted, error)
        end if
    end subroutine check_system

    subroutine refuse_start(system, d, what, start, wanted, error)
        !! Something is no number there: say whether there is an equilibrium elsewhere.
        class(system_t), intent(in) :: system
        type(description_t), intent(in) :: d
        character(*), intent(in) :: what  !! is no number
        real(dp), intent(in) :: start(:)
        logical, intent(in) :: wanted
        type(error_t), allocatable, intent(out) :: error
        real(dp), parameter :: beside = 1e-12_dp
        type(error_t), allocatable :: none
        real(dp) :: q(size(start)), f(size(start))
        character(:), allocatable :: names
        integer :: i, worst

        names = trim(d%coordinates(1)%name)
        do i = 2, size(d%coordinates)
            names = names//","//trim(d%coordinates(i)%name)
        end do
        q = 1.0_dp
        f = force_at_rest(system, q)
        worst = maxloc(abs(f), 1)
        call settle(system, .false., q, none)
        if (.not. allocated(none) .and. all(abs(q - start) <= beside*(1.0_dp + abs(start)))) then
            call fail(error, what//" of "//trim(d%name)//" is no finite number at "//names// &
                      " = "//list_of(start)//", and the equilibrium is there; another form "// &
                      "of L is needed, without a division by zero")
        else if (.not. allocated(none)) then
            call fail(error, what//" of "//trim(d%name)//" is no finite number at "//names// &
                      " = "//list_of(start)//"; there is an equilibrium at "// &
                      list_of(q), key="at")
        else if (wanted) then
            call fail(error, what//" of "//trim(d%name)//" is no finite number at "//names// &
                      " = "//list_of(start)//"; other values are needed")
        else
            call fail(error, trim(d%name)//" has no equilibrium that is found: at "// &
                      names//" = "//list_of(start)//" "//what//" is no finite number, and at "// &
                      "rest elsewhere a force on "//trim(d%coordinates(worst)%name)// &
                      " remains; if you know one, give its "//names, key="at")
        end if
    end subroutine refuse_start

    pure subroutine compare(modes)
        !! The derivation by hand against the Lagrangian.
        type(modes_t), intent(inout) :: modes

        associate (g => modes%gyroscopic)
            modes%difference = max(relative(modes%analytic%mass, modes%mass), &
                                   relative(modes%analytic%stiffness, modes%stiffness))
            if (allocated(modes%analytic%gyroscopic)) then
                modes%difference = max(modes%difference, relative(modes%analytic%gyroscopic, g))
            else
                modes%difference = max(modes%difference, relative(0.0_dp*g, g))
            end if
        end associate
    end subroutine compare

    pure function relative(a, b) result(difference)
        !! The largest difference of elements over the largest element.
        real(dp), intent(in) :: a(:, :), b(:, :)
        real(dp) :: difference

        difference = farthest([a], [b])
        if (maxval(abs(b)) > 0.0_dp) difference = difference/maxval(abs(b))
    end function relative

    pure subroutine solve_gyroscopic(modes, error)
        !! \(\lambda = i\omega\) where the motion is an oscillation.
        type(modes_t), intent(inout) :: modes
        type(error_t), allocatable, intent(out) :: error
        complex(dp), allocatable :: lambda(:), shapes(:, :)

        modes%method = "dgeev in first-order form"
        call gyroscopic_modes(modes%stiffness, modes%gyroscopic, modes%mass, lambda, shapes, error)
        if (allocated(error)) return
        modes%ratio = gyroscopic_ratio(modes%stiffness, modes%gyroscopic, modes%mass, lambda, &
                                       shapes)
        modes%omega2 = merge(aimag(lambda)**2, -real(lambda)**2, is_steady(lambda))
        modes%shapes = real(shapes, dp)
        modes%quadrature = aimag(shapes)
        modes%turning = merge(0.0_dp, abs(aimag(lambda)), is_steady(lambda))
        where (modes%turning <= sqrt(epsilon(1.0_dp))*abs(lambda)) modes%turning = 0.0_dp
    end subroutine solve_gyroscopic

    pure function twin_of(modes, j) result(k)
        !! The mode before `j` that has its \(\omega\) and its shape; 0: there is none. With
        !! gyroscopic forces a double \(\omega\) may have one shape only; the other motion is then
        !! \(t\,e^{i\omega t}\), as of a free particle in a rotating frame. Rounding splits such a
        !! pair by some \(\sqrt\epsilon\).
        type(modes_t), intent(in) :: modes  !! solved
        integer, intent(in) :: j            !! which
        integer :: k
        real(dp), parameter :: near = 1e-6_dp
        complex(dp) :: u(size(modes%shapes, 1)), w(size(modes%shapes, 1))

        if (allocated(modes%quadrature)) then
            w = cmplx(modes%shapes(:, j), modes%quadrature(:, j), dp)
            do k = 1, j - 1
                if (.not. modes%omega(j) - modes%omega(k) <= near*modes%omega(j) .or. &
                    modes%label(j) /= is_oscillation .or. modes%label(k) /= is_oscillation) cycle
                u = cmplx(modes%shapes(:, k), modes%quadrature(:, k), dp)
                if (abs(dot_product(u, w)) >= (1.0_dp - near)*norm2(abs(u))*norm2(abs(w))) return
            end do
        end if
        k = 0
    end function twin_of

    pure function stays(modes, j) result(yes)
        !! Is a zero mode at rest wherever it is, as a charge in a magnetic field? \(u\,t\) obeys
        !! \(M\ddot u + G\dot u + Ku = 0\) only where \(Gu = 0\); \(u\) itself always does.
        type(modes_t), intent(in) :: modes  !! solved
        integer, intent(in) :: j            !! a zero mode
        logical :: yes

        yes = .false.
        if (.not. allocated(modes%gyroscopic)) return
        associate (g => modes%gyroscopic, u => modes%shapes(:, j))
            yes = maxval(abs(matmul(g, u))) > 1e-9_dp*maxval(abs(g))*maxval(abs(u))
        end associate
    end function stays

    pure subroutine label_modes(modes)
        !! A zero mode has \(u^\top Ku = 0\) to rounding (see `zero_modes`), and \(\omega = 0\)
        !! exactly where \(K = S^\top S\) is known. With gyroscopic forces its
        !! \(|\omega^2| \le 16n\epsilon\,\max\omega^2\) and \(|u^\dagger Ku| \le
        !! 16n\epsilon\,\max|K|\,|u|^2\): a mode that is slow only beside a fast one fails the
        !! second test. At most as many modes are zero modes as \(K\) has without \(G\).
        type(modes_t), intent(inout) :: modes
        logical :: vanishes(size(modes%omega2))
        real(dp), allocatable :: omega2(:), shapes(:, :)
        type(error_t), allocatable :: error
        real(dp) :: rounding, spring
        integer :: j, free

        vanishes = .false.
        if (allocated(modes%quadrature)) then
            call normal_modes(modes%stiffness, modes%mass, omega2, shapes, error)
            free = 0
            if (.not. allocated(error)) free = count(zero_modes(modes%stiffness, shapes))
            rounding = 16*size(modes%omega2)*epsilon(rounding)
            do while (free > 0)
                j = minloc(abs(modes%omega2), 1, .not. vanishes)
                associate (u => modes%shapes(:, j), w => modes%quadrature(:, j))
                    spring = abs(dot_product(u, matmul(modes%stiffness, u)) + &
                                 dot_product(w, matmul(modes%stiffness, w)))
                    if (abs(modes%omega2(j)) > rounding*maxval(abs(modes%omega2)) .or. &
                        spring > rounding*maxval(abs(modes%stiffness))*(sum(u**2) + sum(w**2))) exit
                end associate
                vanishes(j) = .true.
                free = free - 1
            end do
        else if (allocated(modes%analytic%root)) then
            vanishes = is_zero(modes%omega2)
        else
            vanishes = zero_modes(modes%stiffness, modes%shapes)
        end if
        call put_labels(vanishes, modes%omega2, modes%omega, modes%label)
    end subroutine label_modes
end module lagrangia_small_oscillations
