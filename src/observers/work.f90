module lagrangia_work
    !! The work along a run that changes the energy function,
    !! \(W = \int(\sum_j Q_j\dot q_j - \partial L/\partial t - \sum_k\lambda_k b_k)\,dt\), of
    !! constraints \(A\dot q + b = 0\): \(E - W\) is conserved.
    !!
    !! A method with dense output is asked inside its step, at eight Gauss-Legendre nodes of each
    !! part of it. Between two steps of another a coordinate is the quintic that has both ends'
    !! coordinate, velocity and acceleration, so that W is right to \(O(\Delta t^6)\). Where the
    !! cubic of coordinates and velocities alone has another W, the step is too long for that, as
    !! where a decay is faster than the steps: `dop853` then goes through it. W is no number where
    !! that would take too long.
    use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
    use lagrangia_dop853, only: dop853_t, new_dop853
    use lagrangia_errors, only: error_t
    use lagrangia_gauss_tables, only: nodes, stages, weights
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
        real(dp) :: q(size(self%q)), v(size(self%q)), start, h, now, part
        integer :: i, k, parts

        if (t <= self%t) return
        start = self%t
        parts = max(1, ceiling(method%points_a_step*(t - start)/(method%t_new - method%t_old)))
        h = (t - start)/parts
        do i = 1, parts
            part = 0.0_dp
            do k = 1, stages
                now = start + (i - 1 + nodes(k))*h
                call method%state_at(now, q, v)
                part = part + weights(k)*energy_rate(self%system, now, q, v)
            end do
            call self%add(h*part)
        end do
        call method%state_at(t, q, v)
        call self%stand(t, q, v)
    end subroutine follow_inside
end module lagrangia_work
