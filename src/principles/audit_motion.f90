module lagrangia_audit_motion
    !! What must hold along the motion, and what Newton and Gauss say of it, at one state.
    use lagrangia_audit_equations, only: neighbour, rounding
    use lagrangia_description, only: description_t, point_t
    use lagrangia_errors, only: error_t
    use lagrangia_findings, only: audit_t
    use lagrangia_flow, only: flow_derivative
    use lagrangia_gauss_principle, only: cartesian_t, least_constraint
    use lagrangia_hyperdual, only: hyperdual_t
    use lagrangia_kinds, only: dp
    use lagrangia_lagrange, only: accelerations_from_lagrangian, euler_lagrange_t, &
                                  expand_lagrangian
    use lagrangia_number_text, only: fixed, scientific
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: audit_rates, audit_gauss, audit_inertia, say_reactions
    public :: claim_gauss

    character(*), parameter :: claim_gauss = "Gauss's least constraint"
    character(3), parameter :: axes = "xyz"
    real(dp), parameter :: differencing = 100.0_dp
    !! what the sum of eight values, each of some ten operations, may make of the noise

contains

    subroutine audit_rates(audit, system, t, q, v)
        !! \(\dot h = -\partial L/\partial t - b\cdot\lambda\), and declared invariants stay.
        type(audit_t), intent(inout) :: audit
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t, q(:), v(:)
        type(description_t) :: d
        type(euler_lagrange_t) :: terms
        type(error_t), allocatable :: error
        type(hyperdual_t) :: rows(system%constraints, size(q)), drift(system%constraints)
        type(hyperdual_t) :: place(size(q))
        real(dp) :: oracle(size(q)), multipliers(system%constraints), rate, scale, noise, expected
        integer :: k

        call accelerations_from_lagrangian(system, t, q, v, oracle, multipliers, error)
        place%re = q
        call system%constraint_rows(hyperdual_t(re=t), place, rows, drift)
        call expand_lagrangian(system, t, q, v, terms)
        expected = -terms%dl_dt - dot_product(drift%re, multipliers)
        call flow_derivative(system, 0, t, q, v, rate, scale, noise)
        scale = scale + abs(expected)
        call audit%judge("energy changes by -dL/dt", abs(rate - expected)/scale, noise/scale, &
                         differencing)
        call system%describe(d)
        if (.not. allocated(d%quantities)) return
        do k = 1, size(d%quantities)
            if (.not. d%quantities(k)%conserved) cycle
            call flow_derivative(system, k, t, q, v, rate, scale, noise)
            call audit%judge(trim(d%quantities(k)%name)//" is conserved", abs(rate)/scale, &
                             noise/scale, differencing)
        end do
    end subroutine audit_rates

    subroutine audit_gauss(audit, system, t, q, v)
        !! Accelerations of the points from masses, forces and constraints alone, and each
        !! reaction against the formula of the same name.
        type(audit_t), intent(inout) :: audit
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t, q(:), v(:)
        type(description_t) :: d
        type(cartesian_t) :: here, near
        type(error_t), allocatable :: error
        real(dp) :: tt, qq(size(q)), vv(size(q)), scale, force, length, noise
        integer :: i, k

        call system%describe(d)
        if (.not. has_masses(d)) return
        call least_constraint(system, t, q, v, here, error)
        if (.not. allocated(error)) then
            call neighbour(t, q, v, tt, qq, vv)
            call least_constraint(system, tt, qq, vv, near, error)
        end if
        if (allocated(error)) then
            call audit%judge(claim_gauss, 1.0_dp, 0.0_dp, rounding)
            call audit%say(claim_gauss, error%message)
            return
        end if
        length = maxval(abs(here%x)) + tiny(1.0_dp)
        do i = 1, size(here%held)
            call audit%judge("positions keep the constraints", abs(here%held(i))/length, &
                             epsilon(length), rounding)
        end do
        scale = maxval(abs(here%x_ddot)) + maxval(abs(here%acceleration)) + maxval(abs(v))**2
        force = maxval(abs(here%force)) + maxval(here%mass)*scale
        noise = epsilon(scale) + maxval(abs(here%acceleration - near%acceleration))/scale
        call audit%judge(claim_gauss, maxval(abs(here%acceleration - here%x_ddot))/scale, noise, &
                         rounding)
        if (maxval(abs(here%acceleration - here%x_ddot)) > rounding*noise*scale) then
            i = maxloc(abs(here%acceleration - here%x_ddot), 1)
            call audit%say(claim_gauss, "the accelerations of "//name_of(d, i)// &
                           " are not those of least constraint")
        end if
        do i = 1, size(d%reactions)
            if (.not. allocated(d%quantities)) exit
            do k = 1, size(d%quantities)
                if (d%quantities(k)%name /= d%reactions(i)%name) cycle
                noise = epsilon(scale) + abs(here%reaction(i) - near%reaction(i))/force
                call audit%judge("Gauss's "//trim(d%reactions(i)%name), &
                                 abs(here%reaction(i) - system%quantity(k, t, q, v))/force, noise, &
                                 rounding)
            end do
        end do
    end subroutine audit_gauss

    subroutine say_reactions(audit, system, t, q, v)
        !! What the reactions are at one state.
        type(audit_t), intent(inout) :: audit
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t, q(:), v(:)
        type(description_t) :: d
        type(cartesian_t) :: here
        type(error_t), allocatable :: error
        character(:), allocatable :: number, text
        integer :: i

        call system%describe(d)
        if (.not. has_masses(d)) return
        call least_constraint(system, t, q, v, here, error)
        if (allocated(error) .or. size(d%reactions) == 0) return
        text = "at q = 0.5, v = 1:"
        do i = 1, size(d%reactions)
            if (i > 1) text = text//","
            number = fixed(anint(1e6_dp*here%reaction(i))*1e-6_dp + 0.0_dp, 6)
            if (abs(here%reaction(i)) >= 1e5_dp) number = scientific(here%reaction(i), 11)
            text = text//" "//trim(d%reactions(i)%name)//" "//number//" N"
        end do
        call audit%say(claim_gauss, text)
    end subroutine say_reactions

    pure function has_masses(d)
        !! It is told what moves, and what holds it.
        type(description_t), intent(in) :: d
        logical :: has_masses

        has_masses = .false.
        if (.not. allocated(d%reactions)) return
        if (allocated(d%points)) has_masses = size(d%points) > 0
        if (allocated(d%rotors)) has_masses = has_masses .or. size(d%rotors) > 0
    end function has_masses

    pure function name_of(d, i) result(name)
        !! Of Cartesian coordinate `i`.
        type(description_t), intent(in) :: d
        integer, intent(in) :: i
        character(:), allocatable :: name
        integer :: point

        point = (i + 2)/3
        if (point <= size(d%points)) then
            name = trim(d%points(point)%name)//" along "//axes(i - 3*point + 3:i - 3*point + 3)
        else
            name = trim(d%rotors(i - 3*size(d%points))%name)
        end if
    end function name_of

    subroutine audit_inertia(audit, system, t, q, v)
        !! \(\sum_k m_k\,\partial x_k/\partial q_i\,\partial x_k/\partial q_j\) over all Cartesian
        !! coordinates is the mass matrix of the Lagrangian.
        type(audit_t), intent(inout) :: audit
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t, q(:), v(:)
        type(description_t) :: d
        type(euler_lagrange_t) :: terms
        type(point_t), allocatable :: rotors(:)
        type(hyperdual_t) :: place(size(q))
        type(hyperdual_t), allocatable :: r(:, :), angles(:)
        real(dp) :: mass(size(q), size(q))
        integer :: i, j, k

        call system%describe(d)
        if (.not. has_masses(d)) return
        call expand_lagrangian(system, t, q, v, terms)
        allocate (rotors(0))
        if (allocated(d%rotors)) rotors = d%rotors
        allocate (r(3, size(d%points)), angles(size(rotors)))
        mass = 0.0_dp
        do i = 1, size(q)
            do j = 1, size(q)
                place = hyperdual_t()
                place%re = q
                place(i)%d1 = 1.0_dp
                place(j)%d2 = 1.0_dp
                call system%positions(hyperdual_t(re=t), place, r)
                call system%angles(hyperdual_t(re=t), place, angles)
                do k = 1, size(d%points)
                    mass(i, j) = mass(i, j) + d%points(k)%mass*sum(r(:, k)%d1*r(:, k)%d2)
                end do
                mass(i, j) = mass(i, j) + sum(rotors%mass*angles%d1*angles%d2)
            end do
        end do
        call audit%judge("points carry the inertia", &
                         maxval(abs(terms%mass - mass))/maxval(abs(terms%mass)), &
                         epsilon(1.0_dp), rounding)
    end subroutine audit_inertia
end module lagrangia_audit_motion
