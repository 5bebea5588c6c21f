module lagrangia_observer
    !! The contract of whoever wants to see the states of a run.
    use lagrangia_errors, only: error_t, fail
    use lagrangia_integrator, only: dense_integrator_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_system, only: system_t
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: observer_t, observer_box_t, check_observers

    type, abstract :: observer_t
    contains
        procedure(observe_i), deferred :: observe
        procedure :: tick => no_tick
        procedure, non_overridable :: tick_share
        procedure :: follows => no
        procedure :: follows_samples => no
        procedure :: meet => no_meet
        procedure :: follow => no_follow
        procedure :: follow_inside => no_follow_inside
    end type observer_t

    type :: observer_box_t
        !! One observer of any kind; its owner is who made it.
        class(observer_t), pointer :: item => null()
    end type observer_box_t

    abstract interface
        subroutine observe_i(self, system, t, q, v, error)
            !! See one sample: the first call is the start of the run.
            import :: observer_t, system_t, dp, error_t
            implicit none (type, external)
            class(observer_t), intent(inout) :: self
            class(system_t), intent(in) :: system  !! whose motion it is
            real(dp), intent(in) :: t, q(system%ndof), v(system%ndof)
            !! s; coordinates, velocities
            type(error_t), allocatable, intent(out) :: error  !! ends the run
        end subroutine observe_i
    end interface

contains

    pure subroutine check_observers(observers, error)
        !! Fails for a box that nobody is in.
        type(observer_box_t), intent(in) :: observers(:)        !! of a run
        type(error_t), allocatable, intent(out) :: error  !! status 2
        integer :: i

        do i = 1, size(observers)
            if (associated(observers(i)%item)) cycle
            call fail(error, "observer "//to_text(i)//" is an empty box: let its item point to one")
            return
        end do
    end subroutine check_observers

    subroutine no_tick(self, done, steps)
        !! Hear, between samples too, that the run goes on: most don't care.
        class(observer_t), intent(inout) :: self
        integer(i8), intent(in) :: done, steps  !! steps or samples so far, and in all
    end subroutine no_tick

    subroutine tick_share(self, share)
        !! `tick` with a share of the whole, in parts so fine that none of what ends is 0 of them.
        class(observer_t), intent(inout) :: self
        real(dp), intent(in) :: share  !! from 0; above 1 it counts as 1
        integer(i8), parameter :: all = 10_i8**15

        call self%tick(int(all*min(1.0_dp, share), i8), all)
    end subroutine tick_share

    pure function no(self)
        !! Whether it wants to see every step, not only the samples, and inside a step the motion
        !! up to a sample before that sample: most don't.
        class(observer_t), intent(in) :: self
        logical :: no

        no = .false.
    end function no

    subroutine no_meet(self, system, event, t, q, v, error)
        !! Event number `event` of the run has happened; after an impact, with the state after it.
        class(observer_t), intent(inout) :: self
        class(system_t), intent(in) :: system  !! whose motion it is
        integer, intent(in) :: event  !! number, from 1
        real(dp), intent(in) :: t, q(system%ndof), v(system%ndof)  !! s; coordinates, velocities
        type(error_t), allocatable, intent(out) :: error  !! ends the run
    end subroutine no_meet

    subroutine no_follow(self, system, t, q, v)
        !! See the state after each step of a method of fixed step; only who `follows`.
        class(observer_t), intent(inout) :: self
        class(system_t), intent(in) :: system  !! whose motion it is
        real(dp), intent(in) :: t              !! s
        real(dp), intent(in) :: q(system%ndof) !! coordinates
        real(dp), intent(in) :: v(system%ndof) !! velocities
    end subroutine no_follow

    subroutine no_follow_inside(self, method, t)
        !! See the motion up to `t` inside the latest step of `method`; only who `follows`.
        class(observer_t), intent(inout) :: self
        class(dense_integrator_t), intent(in) :: method  !! has dense output of its latest step
        real(dp), intent(in) :: t              !! s
    end subroutine no_follow_inside
end module lagrangia_observer
