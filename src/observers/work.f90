module lagrangia_work
    !! The work along a run that changes the energy function,
    !! \(W = \int(\sum_j Q_j\dot q_j - \partial L/\partial t - \sum_k\lambda_k b_k)\,dt\), of
    !! constraints \(A\dot q + b = 0\): \(E - W\) is conserved.
    !!
    !! A method with dense output is asked inside its step, at eight Gauss-Legendre nodes of each
    !! part of it; a closed form in ever shorter parts, while the rate turns within one, as where a
    !! decay is faster than all times that are asked for. Between two steps of another method a
    !! coordinate is the quintic that has both ends' coordinate, velocity and acceleration, so that
    !! W is right to \(O(\Delta t^6)\). Where the cubic of coordinates and velocities alone has
    !! another W, the step is too long for that: `dop853` then goes through it. W is no number where
    !! that would take too long.
    use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
    use lagrangia_dop853, only: dop853_t, new_dop853
    use lagrangia_errors, only: error_t
    use lagrangia_gauss_tables, only: legendre, nodes, stages, weights
    use lagrangia_hermite, only: quintic
    use lagrangia_integrator, only: dense_integrator_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_lagrange, only: energy_rate
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: work_t

    type :: work_t
        !! The sum so far, of parts that nearly cancel: with what rounding took from it.
        class(system_t), allocatable :: system
        real(dp), private :: sum = 0.0_dp, rest = 0.0_dp   !! J
        real(dp), private :: sizes = 0.0_dp                !! of the parts of a closed form, J
        real(dp), private :: t = 0.0_dp
        integer(i8), private :: steps_left = 1000000  !! of dop853; each step of the run adds some
        real(dp), allocatable, private :: q(:), v(:)
    contains
        procedure :: begin
        procedure :: done
        procedure :: follow
        procedure :: follow_inside
        procedure :: stand
        procedure, private :: add
        procedure, private :: add_part
        procedure, private :: go_through
    end type work_t

contains

    subroutine begin(self, system, t, q, v)
        !! The run starts here.
        class(work_t), intent(inout) :: self
        class(system_t), intent(in) :: system         !! whose motion it is
        real(dp), intent(in) :: t, q(:), v(:)         !! s; coordinates, velocities, (ndof)

        allocate (self%system, source=system)
        call self%stand(t, q, v)
    end subroutine begin

    subroutine stand(self, t, q, v)
        !! All up to this state has been seen; after an impact it goes on from another one.
        class(work_t), intent(inout) :: self
        real(dp), intent(in) :: t, q(:), v(:)         !! s; coordinates, velocities, (ndof)

        self%t = t
        self%q = q
        self%v = v
    end subroutine stand

    pure function done(self) result(work)
        !! So much since the run began.
        class(work_t), intent(in) :: self
        real(dp) :: work                              !! J

        work = self%sum + self%rest
    end function done

    subroutine add(self, part)
        !! Neumaier's sum.
        class(work_t), intent(inout) :: self
        real(dp), intent(in) :: part
        real(dp) :: new

        new = self%sum + part
        if (abs(self%sum) >= abs(part)) then
            self%rest = self%rest + ((self%sum - new) + part)
        else
            self%rest = self%rest + ((part - new) + self%sum)
        end if
        self%sum = new
    end subroutine add

    subroutine follow(self, t, q, v)
        !! The state after a step.
        class(work_t), intent(inout) :: self
        real(dp), intent(in) :: t, q(:), v(:)         !! s; coordinates, velocities, (ndof)
        real(dp), parameter :: alike = 1e-6_dp  ! of the cubic's O(h^4): the quintic's is 1e-9
        real(dp), dimension(size(q)) :: a_old, a
        real(dp) :: fifth(0:5, size(q)), third(0:5, size(q)), h, part, other, sizes
        integer :: i

        h = t - self%t
        call self%system%accelerations(self%t, self%q, self%v, a_old)
        call self%system%accelerations(t, q, v, a)
        do i = 1, size(q)
            fifth(:, i) = quintic(h, [self%q(i), self%v(i), a_old(i)], [q(i), v(i), a(i)])
        end do
        third = fifth
        third(2, :) = 3.0_dp*(q - self%q) - h*(2.0_dp*self%v + v)
        third(3, :) = h*(self%v + v) - 2.0_dp*(q - self%q)
        third(4:, :) = 0.0_dp
        call take(third, other, sizes)
        call take(fifth, part, sizes)
        if (h > 0.0_dp .and. abs(part - other) > alike*sizes) then
            call self%go_through(t, maxval(abs([self%q, self%v, q, v])))
        else
            call self%add(part)
        end if
        call self%stand(t, q, v)
    contains
        subroutine take(c, work, sizes)
            !! The work along polynomials, and the sum of the sizes of its parts.
            real(dp), intent(in) :: c(0:, :)
            real(dp), intent(out) :: work, sizes
            real(dp), dimension(size(q)) :: q_now, v_now
            real(dp) :: s, one
            integer :: k

            work = 0.0_dp
            sizes = 0.0_dp
            do k = 1, stages
                s = nodes(k)
                q_now = c(0, :) + s*(c(1, :) + s*(c(2, :) + s*(c(3, :) + s*(c(4, :) + s*c(5, :)))))
                v_now = (c(1, :) + s*(2.0_dp*c(2, :) + s*(3.0_dp*c(3, :) + &
                                                         s*(4.0_dp*c(4, :) + s*5.0_dp*c(5, :)))))/h
                one = weights(k)*energy_rate(self%system, self%t + s*h, q_now, v_now)
                work = work + one
                sizes = sizes + abs(one)
            end do
            work = h*work
            sizes = abs(h)*sizes
        end subroutine take
    end subroutine follow

    subroutine go_through(self, t, scale)
        !! The motion from the last state, to that time.
        class(work_t), intent(inout) :: self
        real(dp), intent(in) :: t      !! s
        real(dp), intent(in) :: scale  !! of coordinates and velocities
        type(dop853_t) :: method
        type(error_t), allocatable :: error
        integer, parameter :: more = 100

        call new_dop853(method)
        method%tolerance = 1e-13_dp*min(1.0_dp, max(scale, 1e-3_dp))
        method%points_a_step = 2
        call method%prepare(self%system, error)
        call method%start(self%system, self%t, self%q, self%v, t)
        self%steps_left = self%steps_left + more
        do while (method%t_new < t .and. self%steps_left > 0)
            call method%step(self%system, error)
            if (allocated(error)) exit
            self%steps_left = self%steps_left - 1
            call self%follow_inside(method, method%t_new)
        end do
        if (method%t_new < t) call self%add(ieee_value(t, ieee_quiet_nan))
    end subroutine go_through

    subroutine follow_inside(self, method, t)
        !! The motion up to `t` inside the latest step of a method.
        class(work_t), intent(inout) :: self
        class(dense_integrator_t), intent(in) :: method   !! has dense output of its latest step
        real(dp), intent(in) :: t                         !! s
        integer, parameter :: least = 8, most = 64        !! parts; halvings of one
        real(dp) :: q(size(self%q)), v(size(self%q)), start, h
        integer :: i, parts

        if (t <= self%t) return
        start = self%t
        parts = 1
        if (method%t_new > method%t_old) then
            parts = max(1, ceiling(method%points_a_step*(t - start)/(method%t_new - method%t_old)))
        end if
        if (method%whole) parts = max(least, parts)
        h = (t - start)/parts
        do i = 1, parts
            call self%add_part(method, start + (i - 1)*h, h, merge(most, 0, method%whole))
        end do
        call method%state_at(t, q, v)
        call self%stand(t, q, v)
    end subroutine follow_inside

    recursive subroutine add_part(self, method, start, h, halvings)
        !! From `start` over `h`, in halves where the rate turns within that: where the two highest
        !! of the eight Legendre coefficients that the nodes tell are no small part of it, or where
        !! the rate at the start is another one than they say, as where it falls at once. What is
        !! below the rounding of the sum is not looked at so closely.
        class(work_t), intent(inout) :: self
        class(dense_integrator_t), intent(in) :: method
        real(dp), intent(in) :: start, h                  !! s
        integer, intent(in) :: halvings                   !! at most
        real(dp) :: q(size(self%q)), v(size(self%q)), rate(stages), first, now, sizes
        integer :: k

        do k = 1, stages
            now = start + nodes(k)*h
            call method%state_at(now, q, v)
            rate(k) = energy_rate(self%system, now, q, v)
        end do
        sizes = sum(weights*abs(rate))
        if (halvings > 0 .and. self%steps_left > 0) then
            call method%state_at(start, q, v)
            first = energy_rate(self%system, start, q, v)
            if (h*(sizes + abs(first)) > epsilon(h)*self%sizes .and. turns(rate, first)) then
                self%steps_left = self%steps_left - 1
                call self%add_part(method, start, 0.5_dp*h, halvings - 1)
                call self%add_part(method, start + 0.5_dp*h, 0.5_dp*h, halvings - 1)
                return
            end if
        end if
        self%sizes = self%sizes + h*sizes
        call self%add(h*sum(weights*rate))
    end subroutine add_part

    pure function turns(values, first) result(yes)
        !! Whether \(\sum_n c_nP_n(2s - 1)\), which has these values at the nodes, \(c_n =
        !! (2n + 1)\sum_k w_kf_kP_n(2s_k - 1)\), has large \(c_6\) or \(c_7\), or another value at
        !! 0 than that.
        real(dp), intent(in) :: values(:)  !! (stages)
        real(dp), intent(in) :: first
        logical :: yes
        real(dp), parameter :: small = 1e-7_dp  !! of an eighth coefficient; the error is its square
        real(dp), parameter :: near = 1e-5_dp   !! of the value at 0, where all coefficients add up
        real(dp) :: c(0:stages - 1), p(stages, 0:stages - 1), sizes
        integer :: n

        call legendre(nodes, p)
        do n = 0, stages - 1
            c(n) = (2*n + 1)*sum(weights*values*p(:, n))
        end do
        sizes = sum(weights*abs(values))
        yes = abs(c(6)) + abs(c(7)) > small*sizes .or. &
              abs(sum(c(0::2)) - sum(c(1::2)) - first) > near*(sizes + abs(first))
    end function turns
end module lagrangia_work
