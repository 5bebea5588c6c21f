module lagrangia_step_ends
    !! How a step of a method ends on the constraints beside L, and where it cannot.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_quiet_nan, ieee_value
    use lagrangia_description, only: line_length
    use lagrangia_hyperdual, only: hyperdual_t
    use lagrangia_kinds, only: dp
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: end_step, is_turned

contains

    pure subroutine end_step(self, t_old, q_old, v_old, t, q, v, reason)
        !! `keep_constraints` of a state that a step has made: methods do it after each step and
        !! keep their order (Hairer, Lubich & Wanner, sec. IV.4). The state becomes NaN where the
        !! step went through a place at which the constraints do not say how the motion goes on.
        !!
        !! Where their derivatives \(A\) vanish, or depend on each other, \(\det(A M^{-1} A'^\top)\)
        !! of a place before and one behind is negative: so it is then within a small part of the
        !! step, whose path is a cubic here. Near a cusp nothing small enough is left of the path;
        !! there the step ends far from the constraints.
        class(system_t), intent(in) :: self                        !! with `is_projected`
        real(dp), intent(in) :: t_old                              !! where the step began, s
        real(dp), intent(in) :: q_old(self%ndof), v_old(self%ndof) !! the state there
        real(dp), intent(in) :: t                                  !! where it ended, s
        real(dp), intent(inout) :: q(self%ndof), v(self%ndof)      !! the state there
        character(line_length), intent(inout) :: reason            !! why the state is NaN
        integer, parameter :: halvings = 3
        real(dp), parameter :: far = 0.25_dp, slight = 1e-6_dp
        real(dp), dimension(self%ndof) :: q_new, v_new, q_middle, weights
        real(dp), dimension(self%constraints, self%ndof) :: left, middle, right
        real(dp) :: h, s, part
        integer :: k

        q_new = q
        v_new = v
        call self%keep_constraints(t, q, v)
        if (.not. (all(ieee_is_finite(q)) .and. all(ieee_is_finite(v)))) return
        h = t - t_old
        call inertias_at(self, t, q, v, weights)
        if (length(q - q_new) + abs(h)*length(v - v_new) > slight*length(q) + &
            far*(length(q - q_old) + abs(h)*max(length(v_old), length(v)))) then
            reason = "its end is far from the constraints: the step is too long, or they end there"
            q = ieee_value(q, ieee_quiet_nan)
            return
        end if
        where (weights > 0.0_dp)
            weights = 1.0_dp/weights
        else where
            weights = 1.0_dp
        end where
        call rows_at(self, t_old, q_old, left)
        call rows_at(self, t, q, right)
        if (.not. is_turned(left, right, weights)) return
        s = 0.0_dp
        part = 1.0_dp
        do k = 1, halvings
            part = 0.5_dp*part
            call cubic(s + part, q_middle)
            call rows_at(self, t_old + (s + part)*h, q_middle, middle)
            if (is_turned(left, middle, weights)) then
                right = middle
            else if (is_turned(middle, right, weights)) then
                left = middle
                s = s + part
            else
                return
            end if
        end do
        reason = "there the constraints' derivatives vanish or depend on each other, and do "// &
                 "not say how it goes on; end before it"
        q = ieee_value(q, ieee_quiet_nan)

    contains

        pure function length(x)
            !! In a metric like that of T.
            real(dp), intent(in) :: x(:)
            real(dp) :: length

            length = sqrt(sum(weights*x**2))
        end function length

        pure subroutine cubic(s, q_there)
            !! The coordinates at a part of the step, from its ends.
            real(dp), intent(in) :: s
            real(dp), intent(out) :: q_there(:)

            q_there = q_old + s**2*(3.0_dp - 2.0_dp*s)*(q - q_old) &
                      + s*(1.0_dp - s)*h*((1.0_dp - s)*v_old - s*v)
        end subroutine cubic
    end subroutine end_step

    pure subroutine inertias_at(self, t, q, v, inertias)
        !! \(|\partial^2 L/\partial\dot q_i^2|\), of which lengths are made.
        class(system_t), intent(in) :: self
        real(dp), intent(in) :: t, q(:), v(:)
        real(dp), intent(out) :: inertias(:)
        type(hyperdual_t) :: qq(self%ndof), vv(self%ndof), l
        integer :: i

        qq%re = q
        vv%re = v
        do i = 1, self%ndof
            vv(i) = hyperdual_t(v(i), d1=1.0_dp, d2=1.0_dp)
            l = self%lagrangian(hyperdual_t(re=t), qq, vv)
            inertias(i) = abs(l%d12)
            vv(i) = hyperdual_t(v(i))
        end do
    end subroutine inertias_at

    pure subroutine rows_at(self, t, q, rows)
        !! \(A\) alone.
        class(system_t), intent(in) :: self
        real(dp), intent(in) :: t, q(:)
        real(dp), intent(out) :: rows(:, :)
        type(hyperdual_t) :: a(self%constraints, self%ndof), b(self%constraints), qq(self%ndof)

        qq%re = q
        call self%constraint_rows(hyperdual_t(re=t), qq, a, b)
        rows = a%re
    end subroutine rows_at

    pure function is_turned(a, b, weights) result(yes)
        !! \(\det(A W B^\top) \le 0\), or a number on that matrix's diagonal is: along the way from
        !! one to the other there is a place where they are at right angles, or where one of them
        !! has lost its rank.
        real(dp), intent(in) :: a(:, :), b(:, :)  !! constraints by their rows, (m, n)
        real(dp), intent(in) :: weights(:)        !! \(W\), diagonal, positive, (n)
        logical :: yes
        real(dp) :: c(size(a, 1), size(a, 1)), row(size(a, 1))
        integer :: i, k, m
        logical :: positive

        m = size(a, 1)
        do i = 1, m
            do k = 1, m
                c(i, k) = sum(weights*a(i, :)*b(k, :))
            end do
            yes = .not. c(i, i) > 0.0_dp
            if (yes) return
            c(i, :) = c(i, :)/maxval(abs(c(i, :)))
        end do
        positive = .true.
        do i = 1, m
            k = i - 1 + maxloc(abs(c(i:, i)), 1)
            if (k /= i) then
                row = c(i, :)
                c(i, :) = c(k, :)
                c(k, :) = row
                positive = .not. positive
            end if
            yes = .not. abs(c(i, i)) > 0.0_dp
            if (yes) return
            positive = positive .eqv. c(i, i) > 0.0_dp
            do k = i + 1, m
                c(k, i:) = c(k, i:) - c(k, i)/c(i, i)*c(i, i:)
            end do
        end do
        yes = .not. positive
    end function is_turned
end module lagrangia_step_ends
