submodule (lagrangia_hanging_chain) lagrangia_hanging_chain_momenta
    !! Canonical momenta of a chain, their forces, and the way back, each in O(n).
    implicit none (type, external)

contains

    pure module subroutine momenta(self, t, q, v, p)
        !! \(p_j = m\ell\,(X_j\cos\theta_j + Y_j\sin\theta_j)\): the bobs from j down move with
        !! rod j, and their velocities have the sums \(X_j = \sum_{k\ge j}\dot x_k\), \(Y_j\).
        class(hanging_chain_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp), intent(out) :: p(self%ndof)
        real(dp), dimension(most) :: s, c, x, y

        associate (n => self%n)
            call velocity_sums(self, q, v, s, c, x, y)
            p = self%m*(self%l/n)*(x(:n)*c(:n) + y(:n)*s(:n))
        end associate
    end subroutine momenta

    pure module subroutine forces(self, t, q, v, f)
        !! \(f_j = m\ell\,[\dot\theta_j\,(Y_j\cos\theta_j - X_j\sin\theta_j)
        !! - (n + 1 - j)\,g\sin\theta_j]\); the sums as in `momenta`, without the term of rod j,
        !! which is along it.
        class(hanging_chain_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp), intent(out) :: f(self%ndof)
        real(dp), dimension(most) :: s, c, x, y
        real(dp) :: along
        integer :: j

        call velocity_sums(self, q, v, s, c, x, y)
        do j = 1, self%n
            along = (self%n + 1 - j)*(self%l/self%n*v(j))
            f(j) = self%m*(self%l/self%n)*(v(j)*((y(j) - along*s(j))*c(j) &
                                                 - (x(j) - along*c(j))*s(j)) &
                                           - (self%n + 1 - j)*self%g*s(j))
        end do
    end subroutine forces

    pure subroutine velocity_sums(self, q, v, s, c, x, y)
        !! Sines and cosines of the rods, and the sums of `momenta`.
        class(hanging_chain_t), intent(in) :: self
        real(dp), intent(in) :: q(self%ndof), v(self%ndof)
        real(dp), dimension(most), intent(out) :: s, c, x, y
        integer :: k

        associate (n => self%n, rod => self%l/self%n)
            do k = 1, n
                s(k) = sin(q(k))
                c(k) = cos(q(k))
                x(k) = rod*v(k)*c(k)
                y(k) = rod*v(k)*s(k)
            end do
            do k = 2, n
                x(k) = x(k) + x(k - 1)
                y(k) = y(k) + y(k - 1)
            end do
            do k = n - 1, 1, -1
                x(k) = x(k) + x(k + 1)
                y(k) = y(k) + y(k + 1)
            end do
        end associate
    end subroutine velocity_sums

    pure module subroutine velocities(self, t, q, p, v)
        !! What the bobs from j down carry is \(P_j = (p_j/\ell)\,e_j + \lambda_jn_j\), along and
        !! across rod j, with \(e_j = (\cos\theta_j, \sin\theta_j)\), \(n_j = (\sin\theta_j,
        !! -\cos\theta_j)\). Bob j alone carries \(P_j - P_{j+1}\), and no rod is stretched:
        !! \(n_j\cdot(2P_j - P_{j+1} - P_{j-1}) = 0\), where for \(j = 1\) one \(P_1\) and
        !! \(P_0\) are missing. That is the matrix of the tensions; along \(e_j\) stands
        !! \(m\ell\dot\theta_j\).
        class(hanging_chain_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), p(self%ndof)
        real(dp), intent(out) :: v(self%ndof)
        real(dp), dimension(most) :: s, c
        real(dp) :: lambda(self%ndof)
        integer :: k

        associate (n => self%n, rod => self%l/self%n)
            lambda = 0.0_dp
            do k = 1, n - 1
                s(k) = sin(q(k + 1) - q(k))
                c(k) = cos(q(k + 1) - q(k))
                lambda(k) = lambda(k) - p(k + 1)/rod*s(k)
                lambda(k + 1) = p(k)/rod*s(k)
            end do
            call eliminate(n, c, lambda)
            v = 2.0_dp*(p/rod)
            v(1) = p(1)/rod
            do k = 1, n - 1
                v(k) = v(k) - (p(k + 1)/rod*c(k) + lambda(k + 1)*s(k))
                v(k + 1) = v(k + 1) - (p(k)/rod*c(k) - lambda(k)*s(k))
            end do
            v = v/(self%m*rod)
        end associate
    end subroutine velocities

    pure module subroutine eliminate(n, c, x)
        !! From the pivot down: the pivots are 1, then \(2 - c^2/\) the one before: never below 1.
        integer, intent(in) :: n
        real(dp), intent(in) :: c(most)
        real(dp), intent(inout) :: x(n)
        real(dp) :: pivot(most)
        integer :: k

        pivot(1) = 1.0_dp
        do k = 1, n - 1
            pivot(k + 1) = 2.0_dp - c(k)**2/pivot(k)
            x(k + 1) = x(k + 1) + c(k)/pivot(k)*x(k)
        end do
        x(n) = x(n)/pivot(n)
        do k = n - 1, 1, -1
            x(k) = (x(k) + c(k)*x(k + 1))/pivot(k)
        end do
    end subroutine eliminate
end submodule lagrangia_hanging_chain_momenta
