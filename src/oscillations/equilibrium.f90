module lagrangia_equilibrium
    !! Places where a system can rest, and L to second order about them.
    use lagrangia_derivative, only: derivative
    use lagrangia_description, only: description_t, sizes_of_places, unit_over
    use lagrangia_errors, only: error_t, fail
    use lagrangia_expression, only: expression_t, operator(+)
    use lagrangia_formula_program, only: formula_program_t, new_formula_program
    use lagrangia_generalised_forces, only: add_generalised_forces
    use lagrangia_hyperdual, only: hyperdual_t
    use lagrangia_kinds, only: dp
    use lagrangia_lapack, only: solve_linear
    use lagrangia_magnitude, only: magnitude
    use lagrangia_number_class, only: is_zero
    use lagrangia_system, only: system_t
    use lagrangia_tangent_space, only: find_tangent, tangent_t, within
    use lagrangia_text, only: to_text
    use lagrangia_written_system, only: written_system_t
    implicit none (type, external)
    private
    public :: expand_at_rest, expansion_moves, force_at_rest, missed_text, place_text, settle, &
              stiffness_beside

contains

    pure function missed_text(d, stated, at) result(text)
        !! A sentence where a stated equilibrium is none; "" where it is one.
        type(description_t), intent(in) :: d   !! of the system
        real(dp), intent(in) :: stated(:)      !! (n), where the scene says that it is
        real(dp), intent(in) :: at(:)          !! (n), where `settle` came to from there
        character(:), allocatable :: text
        real(dp), parameter :: same = 1e-9_dp  ! far above the rounding of a step of Newton's

        text = ""
        if (any(abs(at - stated) > same*max(sizes_of_places(d), abs(stated)))) text = &
            "the scene's equilibrium, "//place_text(d, stated)//", is none; from there "// &
            "Newton's method leads to "//place_text(d, at)
    end function missed_text

    pure function place_text(d, at) result(text)
        !! `x = 0.0, theta = 0.0`: the first eight coordinates.
        type(description_t), intent(in) :: d  !! of the system
        real(dp), intent(in) :: at(:)         !! (n), where
        character(:), allocatable :: text
        integer, parameter :: most = 8
        integer :: i

        text = trim(d%coordinates(1)%name)//" = "//to_text(at(1) + 0.0_dp)  ! no sign of a zero
        do i = 2, min(size(at), most)
            text = text//", "//trim(d%coordinates(i)%name)//" = "//to_text(at(i) + 0.0_dp)
        end do
        if (size(at) > most) text = text//", ..."
    end function place_text

    subroutine settle(system, wanted, q, error)
        !! Newton's method from `q` to an equilibrium; where it leads to none, down to a minimum of
        !! \(-L(q, 0)\). A `wanted` equilibrium must be there already, to 1e-12 of the typical sizes
        !! \(s_i\) of the system, or to rounding of \(q_i\) where that is more.
        class(system_t), intent(in) :: system             !! configured
        logical, intent(in) :: wanted                     !! `q` must be one
        real(dp), intent(inout) :: q(:)                   !! (n), from where to where
        type(error_t), allocatable, intent(out) :: error  !! none is found; the nearest is another
        type(tangent_t) :: tangent
        type(description_t) :: d
        character(:), allocatable :: near
        real(dp) :: k(size(q), size(q))
        real(dp), dimension(size(q)) :: f, start, onto, rounding, usual
        integer :: i, worst
        logical :: found

        call system%describe(d)
        usual = sizes_of_places(d)
        start = q
        f = force_at_rest(system, q)
        if (all(is_zero(f)) .and. system%constraints == 0) return
        call approach(system, usual, q, found)
        if (.not. (found .or. system%nonconservative .or. system%constraints > 0)) then
            q = start
            call descend(system, usual, q)
            call approach(system, usual, q, found)
            ! so far away the force may well be rounding: it fell without end
            found = found .and. all(abs(q) <= 1e8_dp*max(usual, abs(start)))
        end if
        if (found) found = is_resolved(system, q)
        if (found) call leave_noise_out(system, usual, q)
        if (found .and. .not. wanted) return
        near = "none is near"
        onto = 0.0_dp
        f = force_at_rest(system, start)
        if (system%constraints > 0) call constrain(system, start, f, k, rounding, onto, tangent, &
                                                   error)
        if (allocated(error)) return
        worst = maxloc(abs(f), 1)
        if (found) then
            if (all(abs(q - start) <= max(1e-12_dp*usual, 4.0_dp*spacing(start)))) then
                q = start
                return
            end if
            near = "the nearest is "//to_text(q(1))
            do i = 2, min(size(q), 6)
                near = near//","//to_text(q(i))
            end do
        end if
        if (any(abs(onto) > 1e-12_dp*max(usual, abs(start)))) then
            call fail(error, "not a place that the constraints of "//trim(d%name)//" allow; "//near)
            return
        end if
        call fail(error, "not an equilibrium of "//trim(d%name)// &
                  trim(merge(" in flight", "          ", system%contacts > 0))// &
                  ": the force on "// &
                  trim(d%coordinates(worst)%name)//" is "//to_text(f(worst))//" "// &
                  trim(unit_over(trim(d%coordinates(worst)%unit), "J", "N", "N m"))//"; "//near)
    end subroutine settle

    pure function is_resolved(system, q) result(yes)
        !! Are the numbers near `q` so close that K is the same there? Of an angle of 1e16 rad the
        !! next number is 2 rad away, and where it rests cannot be said.
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: q(:)
        logical :: yes
        real(dp), parameter :: same = 1e-6_dp
        real(dp), dimension(size(q), size(q)) :: m, k, other, g

        call expand_at_rest(system, q, m, k, g)
        call expand_at_rest(system, q + 4.0_dp*spacing(q), m, other, g)
        yes = all(abs(other - k) <= same*maxval(abs(k)) + tiny(k)/epsilon(k))
    end function is_resolved

    pure subroutine leave_noise_out(system, usual, q)
        !! Coordinates that are rounding of their typical sizes are 0 if that leaves no more force.
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: usual(:)
        real(dp), intent(inout) :: q(:)
        real(dp) :: round(size(q))

        round = q
        where (abs(q) <= 16.0_dp*epsilon(q)*usual) round = 0.0_dp
        if (all(abs(force_at_rest(system, round)) <= abs(force_at_rest(system, q)))) q = round
    end subroutine leave_noise_out

    subroutine approach(system, usual, q, found)
        !! Newton's method, until \(|F_i| \le 8\epsilon(\sum_j|K_{ij}|\max(s_j, |q_j|)
        !! + \sum_k|A_{ki}\lambda_k|)\) or the step is rounding. No step is made by a force along
        !! which K has no stiffness, as on an incline: then \(|s_i F_i|\) is more than 1e-10 of the
        !! largest of those sums times \(s_i\), and the place is none. Where K has no stiffness at
        !! all, the sum is that of the sizes of the forces, which may cancel.
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: usual(:)  !! \(s_i\), typical sizes
        real(dp), intent(inout) :: q(:)
        logical, intent(out) :: found  !! an equilibrium: `q`
        type(error_t), allocatable :: singular
        type(tangent_t) :: tangent
        real(dp), dimension(size(q), size(q)) :: m, k, g
        real(dp), dimension(size(q)) :: constant, f, step, onto, rounding
        integer :: i

        constant = terms_at_rest(system, q)
        onto = 0.0_dp
        do i = 1, 50
            call expand_at_rest(system, q, m, k, g)
            call stiffness_beside(system, q, m)
            k = k + m
            f = force_at_rest(system, q)
            rounding = matmul(abs(k), max(usual, abs(q)))
            where (rounding <= 0.0_dp) rounding = constant
            if (system%constraints > 0) then
                call constrain(system, q, f, k, rounding, onto, tangent, singular)
                if (allocated(singular)) exit
            end if
            found = all(abs(f) <= 8.0_dp*epsilon(f)*rounding) .and. &
                    all(abs(onto) <= 4.0_dp*epsilon(q)*max(usual, abs(q)))
            if (found) return
            if (system%constraints > 0) then
                call newton_step(within(tangent%basis, k), &
                                 matmul(transpose(tangent%basis), f - matmul(k, onto)), &
                                 step(:size(tangent%basis, 2)), singular)
                step = onto + matmul(tangent%basis, step(:size(tangent%basis, 2)))
            else
                call newton_step(scaled(k, usual), usual*f, step, singular)
                step = usual*step
            end if
            if (allocated(singular)) exit
            q = q + step
            found = maxval(abs(step)/usual) <= 4.0_dp*epsilon(q)*max(1.0_dp, maxval(abs(q)/usual))
            if (.not. found) cycle
            found = maxval(abs(usual*f)) <= 1e-10_dp*maxval(usual*rounding)
            return
        end do
        found = .false.
    end subroutine approach

    pure subroutine descend(system, usual, q)
        !! Down \(-L(q, 0)\) by Newton's method with a damping \(\mu\), \((K + \mu)\delta = F\), in
        !! typical sizes: a step that leads down is taken, and \(\mu\) is divided by 4; one that
        !! doesn't, multiplies it by 4.
        !!
        !! Source: K. Levenberg, Quart. Appl. Math. 2, 164 (1944).
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: usual(:)
        real(dp), intent(inout) :: q(:)
        integer, parameter :: most = 300
        type(error_t), allocatable :: singular
        real(dp), dimension(size(q), size(q)) :: m, k, g
        real(dp), dimension(size(q)) :: f, step
        real(dp) :: mu
        integer :: i, j

        call expand_at_rest(system, q, m, k, g)
        k = scaled(k, usual)
        f = usual*force_at_rest(system, q)
        mu = 1e-3_dp*maxval(abs(k))
        do i = 1, most
            m = k
            do j = 1, size(q)
                m(j, j) = m(j, j) + mu
            end do
            call solve_linear(m, f, step, singular)
            if (.not. allocated(singular)) then
                if (dot_product(step, f) > 0.0_dp .and. &
                    level(system, q + usual*step) < level(system, q)) then
                    q = q + usual*step
                    call expand_at_rest(system, q, m, k, g)
                    k = scaled(k, usual)
                    f = usual*force_at_rest(system, q)
                    mu = mu/4.0_dp
                    if (maxval(abs(step)) <= 1e-6_dp*max(1.0_dp, maxval(abs(q)/usual))) return
                    cycle
                end if
            end if
            mu = max(4.0_dp*mu, epsilon(mu)*maxval(abs(k)))
        end do
    end subroutine descend

    pure function scaled(k, usual) result(product)
        !! \(s_i K_{ij} s_j\), all in J.
        real(dp), intent(in) :: k(:, :), usual(:)
        real(dp) :: product(size(usual), size(usual))
        integer :: i

        do i = 1, size(usual)
            product(:, i) = usual*k(:, i)*usual(i)
        end do
    end function scaled

    pure function level(system, q) result(value)
        !! \(-L(q, 0)\), of which an equilibrium is stable where it is least.
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: q(:)
        real(dp) :: value                 !! J
        type(hyperdual_t) :: l, tt, qq(size(q)), vv(size(q))

        qq%re = q
        l = system%lagrangian(tt, qq, vv)
        value = -l%re
    end function level

    pure subroutine newton_step(k, f, step, singular)
        !! \(K\delta = F\) by least squares with a damping of 1e-12 max|K^T K|: K may be singular (a
        !! zero mode).
        real(dp), intent(in) :: k(:, :), f(:)
        real(dp), intent(out) :: step(:)
        type(error_t), allocatable, intent(out) :: singular
        real(dp) :: square(size(f), size(f)), damping
        integer :: i

        square = matmul(transpose(k), k)
        damping = 1e-12_dp*maxval(abs(square))
        do i = 1, size(f)
            square(i, i) = square(i, i) + damping
        end do
        call solve_linear(square, matmul(transpose(k), f), step, singular)
    end subroutine newton_step

    pure subroutine constrain(system, q, f, k, rounding, onto, tangent, error)
        !! Add the forces of constraint to those of L, and what goes with them.
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: q(:)
        real(dp), intent(inout) :: f(:), k(:, :), rounding(:)
        real(dp), intent(out) :: onto(:)  !! the way back onto the constraints
        type(tangent_t), intent(out) :: tangent
        type(error_t), allocatable, intent(out) :: error
        real(dp) :: lambda(system%constraints), there(size(q)), at_rest(size(q))

        onto = 0.0_dp
        call find_tangent(system, q, tangent, error)
        if (allocated(error)) return
        call tangent%find_multipliers(f, lambda, error)
        if (allocated(error)) return
        f = f + matmul(lambda, tangent%rows)
        k = k + tangent%stiffness(lambda)
        rounding = rounding + matmul(abs(lambda), abs(tangent%rows))
        there = q
        at_rest = 0.0_dp
        call system%keep_constraints(0.0_dp, there, at_rest)
        onto = there - q
    end subroutine constrain

    pure function terms_at_rest(system, q) result(sizes)
        !! The sizes of the terms that add up to the forces, as far as formulas tell: else zeros.
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: q(:)
        real(dp) :: sizes(size(q))
        type(formula_program_t) :: program
        type(expression_t) :: terms(size(q))
        integer :: i

        sizes = 0.0_dp
        select type (system)
        class is (written_system_t)
            associate (e => system%expressions)
                do i = 1, size(q)
                    terms(i) = magnitude(derivative(e%lagrangian, 1 + i)) &
                               + magnitude(e%forces(i))
                end do
                call new_formula_program(program, terms, size(e%symbols%names))
                call program%evaluate([0.0_dp, q, 0.0_dp*q, system%p], sizes)
            end associate
        end select
    end function terms_at_rest

    pure function force_at_rest(system, q) result(f)
        !! \(\partial L/\partial q - \partial^2L/\partial\dot q\,\partial t + Q\) at rest.
        class(system_t), intent(in) :: system  !! configured
        real(dp), intent(in) :: q(:)           !! (n)
        real(dp) :: f(size(q))                 !! N, or N m on an angle
        type(hyperdual_t) :: tt, qq(size(q)), vv(size(q)), l
        integer :: i

        qq%re = q
        do i = 1, size(q)
            qq(i)%d1 = 1.0_dp
            l = system%lagrangian(tt, qq, vv)
            f(i) = l%d1
            qq(i)%d1 = 0.0_dp
            if (.not. system%time_dependent) cycle
            vv(i)%d1 = 1.0_dp
            tt%d2 = 1.0_dp
            l = system%lagrangian(tt, qq, vv)
            f(i) = f(i) - l%d12
            vv(i)%d1 = 0.0_dp
            tt%d2 = 0.0_dp
        end do
        call add_generalised_forces(system, 0.0_dp, q, 0.0_dp*q, f)
    end function force_at_rest

    pure subroutine expand_at_rest(system, q, m, k, g)
        !! \(M\), \(K\), \(G\) from the Lagrangian's second derivatives at rest.
        class(system_t), intent(in) :: system  !! configured
        real(dp), intent(in) :: q(:)           !! (n)
        real(dp), dimension(size(q), size(q)), intent(out) :: m, k, g
        !! \(L_{vv}\), \(-L_{qq}\), \(L_{vq} - L_{qv}\)
        real(dp) :: mixed(size(q), size(q))
        type(hyperdual_t) :: tt, qq(size(q)), vv(size(q)), l
        integer :: i, j

        qq%re = q
        do i = 1, size(q)
            do j = 1, size(q)
                vv(i)%d1 = 1.0_dp
                vv(j)%d2 = 1.0_dp
                l = system%lagrangian(tt, qq, vv)
                m(i, j) = l%d12
                vv(j)%d2 = 0.0_dp
                qq(j)%d2 = 1.0_dp
                l = system%lagrangian(tt, qq, vv)
                mixed(i, j) = l%d12
                vv(i)%d1 = 0.0_dp
                qq(i)%d1 = 1.0_dp
                l = system%lagrangian(tt, qq, vv)
                k(i, j) = -l%d12
                qq(i)%d1 = 0.0_dp
                qq(j)%d2 = 0.0_dp
            end do
        end do
        g = mixed - transpose(mixed)
    end subroutine expand_at_rest

    pure function expansion_moves(system, q) result(yes)
        !! Do the second derivatives of L at rest contain the time, by more than rounding? Then
        !! \(M\ddot q + G\dot q + Kq = 0\) is not what the motion obeys.
        class(system_t), intent(in) :: system  !! configured
        real(dp), intent(in) :: q(:)           !! (n)
        logical :: yes
        real(dp), parameter :: times(3) = [0.618_dp, 2.367_dp, 17.3_dp], rounding = 1e-11_dp
        real(dp), dimension(2*size(q), 2*size(q)) :: first, now
        integer :: i

        yes = .false.
        if (.not. system%time_dependent) return
        first = second_derivatives(0.0_dp)
        do i = 1, size(times)
            now = second_derivatives(times(i))
            yes = yes .or. any(abs(now - first) > rounding*max(maxval(abs(first)), &
                                                               maxval(abs(now))))
        end do
    contains
        pure function second_derivatives(t) result(h)
            real(dp), intent(in) :: t
            real(dp) :: h(2*size(q), 2*size(q))
            type(hyperdual_t) :: state(2*size(q)), l
            integer :: k, j

            state%re = [q, 0.0_dp*q]
            do k = 1, size(state)
                do j = 1, size(state)
                    state(k)%d1 = 1.0_dp
                    state(j)%d2 = 1.0_dp
                    l = system%lagrangian(hyperdual_t(re=t), state(:size(q)), state(size(q) + 1:))
                    h(k, j) = l%d12
                    state(k)%d1 = 0.0_dp
                    state(j)%d2 = 0.0_dp
                end do
            end do
        end function second_derivatives
    end function expansion_moves

    pure subroutine stiffness_beside(system, q, stiffness)
        !! \(-\partial Q/\partial q\) at rest, of the generalised forces beside L.
        class(system_t), intent(in) :: system      !! with its parameters
        real(dp), intent(in) :: q(:)               !! (n)
        real(dp), intent(out) :: stiffness(:, :)   !! (n, n), N/m, or N m of angles
        type(hyperdual_t) :: qq(size(q)), v(size(q)), f(size(q))
        integer :: j

        stiffness = 0.0_dp
        if (.not. system%nonconservative) return
        qq%re = q
        do j = 1, size(q)
            qq(j)%d1 = 1.0_dp
            call system%generalised_forces(hyperdual_t(), qq, v, f)
            stiffness(:, j) = -f%d1
            qq(j)%d1 = 0.0_dp
        end do
    end subroutine stiffness_beside
end module lagrangia_equilibrium
