module lagrangia_exact_motion
    !! A closed form in the place of a method: it takes no steps and needs no accelerations.
    use lagrangia_errors, only: error_t, fail
    use lagrangia_integrator, only: dense_integrator_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_reference, only: reference_t
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: exact_motion_t, new_exact_motion

    type, extends(dense_integrator_t) :: exact_motion_t
        !! `q` and `v` of `advance` and `start` must lie on the motion: they are not looked at.
        class(reference_t), allocatable :: closed_form
    contains
        procedure :: prepare
        procedure :: start
        procedure :: advance
        procedure :: step
        procedure :: state_at
    end type exact_motion_t

contains

    subroutine new_exact_motion(self, closed_form)
        !! The motion that `closed_form` knows.
        type(exact_motion_t), intent(out) :: self  !! needs no tolerance
        class(reference_t), intent(in) :: closed_form  !! has the state; is copied

        self%name = "exact"
        self%points_a_step = 32768  ! all of the motion is one step
        self%whole = .true.
        self%title = closed_form%title
        allocate (self%closed_form, source=closed_form)
    end subroutine new_exact_motion

    pure subroutine prepare(self, system, error)
        !! See `integrator_t`. Impacts are not the closed form's.
        class(exact_motion_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        type(error_t), allocatable, intent(out) :: error

        if (system%contacts > 0) call fail(error, "a closed form meets no impacts", key="method")
    end subroutine prepare

    pure subroutine advance(self, system, t0, dt, first, steps, q, v)
        !! The state at the end of the steps.
        class(exact_motion_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t0, dt
        integer(i8), intent(in) :: first, steps
        real(dp), intent(inout) :: q(system%ndof), v(system%ndof)

        call self%closed_form%state_at(t0 + (first + steps)*dt, q, v)
    end subroutine advance

    pure subroutine start(self, system, t0, q, v, t_end)
        !! See `dense_integrator_t`.
        class(exact_motion_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t0
        real(dp), intent(in) :: q(system%ndof), v(system%ndof)
        real(dp), intent(in), optional :: t_end

        call self%stand(t0, t_end)
        self%failure_reason = "the closed form gives none"
    end subroutine start

    pure subroutine step(self, system, error)
        !! To the end at once. Never fails.
        class(exact_motion_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        type(error_t), allocatable, intent(out) :: error

        self%t_old = self%t_new
        self%t_new = self%t_end
    end subroutine step

    pure subroutine state_at(self, t, q, v)
        !! The closed form.
        class(exact_motion_t), intent(in) :: self
        real(dp), intent(in) :: t
        real(dp), intent(out) :: q(:), v(:)

        call self%closed_form%state_at(t, q, v)
    end subroutine state_at
end module lagrangia_exact_motion
