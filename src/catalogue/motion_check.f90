module lagrangia_motion_check
    !! Whether what a system brings of its motion, a closed form or itself without a cyclic
    !! coordinate, obeys its equations of motion.
    use lagrangia_errors, only: error_t, fail
    use lagrangia_kinds, only: dp
    use lagrangia_number_class, only: all_finite
    use lagrangia_random_draws, only: random_t
    use lagrangia_reference, only: reference_t
    use lagrangia_system, only: reduced_t, system_t
    use lagrangia_text, only: to_text
    use lagrangia_vectors, only: farthest
    implicit none (type, external)
    private
    public :: check_motions

    integer, parameter :: draws = 40   !! of parameters and states, half of them at rest
    integer, parameter :: halvings = 30
    real(dp), parameter :: bound = 1e-6_dp
    !! of a rate beside those of the motion. With the best step h the central difference has
    !! rounding/h and h**2: together rounding**(2/3), some 4e-11, where times are of order 1

    type, extends(reference_t) :: parabola_t
        !! The motion near a state, as the reduced system has it: a parabola of its coordinates.
        class(reduced_t), allocatable :: reduced
        real(dp) :: t0 = 0.0_dp                     !! s
        real(dp), allocatable :: q(:), v(:), a(:)   !! of the reduced system at `t0`
    contains
        procedure :: state_at
    end type parabola_t

contains

    subroutine check_motions(system, error)
        !! Fails where the closed form of a drawn state, or the state of the reduced system, has
        !! another number of coordinates, does not go through that state, or does not obey the
        !! equations of motion there.
        class(system_t), intent(in) :: system             !! with parameters that are allowed
        type(error_t), allocatable, intent(out) :: error  !! says which motion, and where
        class(system_t), allocatable :: drawn
        class(reference_t), allocatable :: motion
        type(random_t) :: random
        type(error_t), allocatable :: none_drawn
        real(dp), allocatable :: values(:), q(:), v(:)
        real(dp) :: t
        integer :: i

        allocate (drawn, source=system)
        do i = 1, draws
            call random%parameters(drawn, mod(i/2, 2) == 0, values, none_drawn)
            if (.not. allocated(none_drawn)) call random%state(drawn, t, q, v, none_drawn)
            if (allocated(none_drawn)) cycle
            if (mod(i, 2) == 0) v = 0.0_dp
            call drawn%closed_form(t, q, v, motion)
            if (allocated(motion)) call judge(drawn, motion, "closed form", t, q, v, error)
            if (allocated(error)) return
            call new_parabola(drawn, t, q, v, motion)
            if (allocated(motion)) call judge(drawn, motion, "reduced system", t, q, v, error)
            if (allocated(error)) return
        end do
    end subroutine check_motions

    subroutine new_parabola(system, t, q, v, motion)
        !! Not allocated where no reduced system is known.
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t, q(:), v(:)
        class(reference_t), allocatable, intent(out) :: motion
        type(parabola_t) :: near

        call system%reduce(near%reduced)
        if (.not. allocated(near%reduced)) return
        near%ndof = system%ndof
        near%t0 = t
        allocate (near%q(near%reduced%ndof), near%v(near%reduced%ndof), near%a(near%reduced%ndof))
        call near%reduced%leave(q, v, near%q, near%v)
        call near%reduced%accelerations(t, near%q, near%v, near%a)
        allocate (motion, source=near)
    end subroutine new_parabola

    pure subroutine state_at(self, t, q, v)
        !! See `reference_t`: right to second order in `t - t0`.
        class(parabola_t), intent(in) :: self
        real(dp), intent(in) :: t
        real(dp), intent(out) :: q(self%ndof), v(self%ndof)
        real(dp) :: q_left(size(self%q)), v_left(size(self%q)), h

        h = t - self%t0
        q_left = self%q + h*(self%v + 0.5_dp*h*self%a)
        v_left = self%v + h*self%a
        call self%reduced%complete(h, q_left, v_left, q, v)
    end subroutine state_at

    subroutine judge(system, motion, what, t, q, v, error)
        !! One motion, at the state from which it was made.
        class(system_t), intent(in) :: system
        class(reference_t), intent(in) :: motion
        character(*), intent(in) :: what  !! gave it
        real(dp), intent(in) :: t, q(:), v(:)
        type(error_t), allocatable, intent(out) :: error
        real(dp), dimension(size(q)) :: a, here, rate, rate_q, rate_v
        real(dp) :: h, size_q, size_rates, off
        integer :: k

        if (motion%ndof /= system%ndof) then
            call fail(error, "its "//what//" has ndof = "//to_text(motion%ndof)//", and not "// &
                      to_text(system%ndof))
            return
        end if
        if (.not. motion%has_state) return
        call motion%state_at(t, here, rate)
        call system%accelerations(t, q, v, a)
        if (.not. all_finite(a)) return
        size_q = 1.0_dp + maxval(abs(q))
        size_rates = maxval(abs(v)) + maxval(abs(a)) + bound*size_q
        if (.not. (all(abs(here - q) <= bound*size_q) &
                   .and. all(abs(rate - v) <= bound*size_rates))) then
            call fail(error, "its "//what//" has the motion from "//state_text()// &
                      " at q = "//list(here)//", v = "//list(rate)//" then")
            return
        end if
        if (system%contacts > 0) return  ! an impact may be near
        h = 1.0_dp
        do k = 0, halvings
            call differences(h, rate_q, rate_v)
            off = max(farthest(rate_q, v), farthest(rate_v, a))
            if (off <= bound*size_rates) return
            h = 0.5_dp*h
        end do
        call fail(error, "its "//what//" does not obey the equations of motion at "// &
                  state_text()//": accelerations are "//list(a)//"; give the system one "// &
                  "of its own, or none")
    contains
        subroutine differences(step, by_q, by_v)
            !! Central ones.
            real(dp), intent(in) :: step
            real(dp), intent(out) :: by_q(:), by_v(:)
            real(dp), dimension(size(q)) :: q1, v1, q2, v2

            call motion%state_at(t - step, q1, v1)
            call motion%state_at(t + step, q2, v2)
            by_q = (q2 - q1)/(2.0_dp*step)
            by_v = (v2 - v1)/(2.0_dp*step)
        end subroutine differences

        function state_text() result(text)
            character(:), allocatable :: text

            text = "t = "//to_text(t)//", q = "//list(q)//", v = "//list(v)
        end function state_text
    end subroutine judge

    function list(x) result(text)
        !! Numbers and commas.
        real(dp), intent(in) :: x(:)
        character(:), allocatable :: text
        integer :: i

        text = ""
        do i = 1, size(x)
            if (i > 1) text = text//", "
            text = text//to_text(x(i))
        end do
    end function list
end module lagrangia_motion_check
