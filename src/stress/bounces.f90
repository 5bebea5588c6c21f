module lagrangia_bounces
    !! The bouncing ball: hardly any loss, and infinitely many bounces in a finite time.
    use lagrangia_dense_run, only: run_dense
    use lagrangia_errors, only: error_t
    use lagrangia_events, only: contact_event_t, event_box_t, new_contact_event
    use lagrangia_integrator, only: dense_integrator_t
    use lagrangia_kinds, only: dp, i8, qp
    use lagrangia_ledger, only: ledger_t
    use lagrangia_observer, only: observer_box_t, observer_t
    use lagrangia_printed_table, only: short
    use lagrangia_system, only: system_t
    use lagrangia_text, only: to_text
    use lagrangia_time_grid, only: new_sample_times, time_grid_t
    implicit none (type, external)
    private
    public :: stress_elastic, stress_zeno

    real(dp), parameter :: g = 9.81_dp, v0 = 3.0_dp

    type, extends(observer_t) :: counter_t
        !! Times of the first impacts, and how many there were.
        integer :: count = 0
        real(dp) :: times(100) = 0.0_dp
        real(dp) :: last = 0.0_dp
    contains
        procedure :: observe
        procedure :: meet
    end type counter_t

contains

    subroutine stress_elastic(system, method, verdicts)
        !! \(e \to 1\): the times of 20 bounces after a throw from the floor against
        !! \(\frac{2v_0}{g}\frac{1-e^n}{1-e}\) in quadruple precision.
        class(system_t), intent(inout) :: system  !! its parameters are set as needed
        class(dense_integrator_t), intent(inout) :: method  !! with its tolerance; prepared here
        type(ledger_t), intent(inout) :: verdicts  !! gets the lines
        integer, parameter :: powers(*) = [1, 4, 8, 12, 15, 0]
        character(:), allocatable :: of
        type(counter_t), target :: counter
        real(qp) :: exact, flight
        real(dp) :: e, worst
        integer :: i, n

        do i = 1, size(powers)
            e = 1.0_dp
            if (powers(i) > 0) e = 1.0_dp - 10.0_dp**(-powers(i))
            call bounce(system, method, e, 20.5_dp*2.0_dp*v0/g, counter)
            worst = 0.0_dp
            exact = 0.0_qp
            flight = 2.0_qp*v0/g
            do n = 1, min(20, counter%count)
                exact = exact + flight
                flight = e*flight
                worst = max(worst, real(abs(counter%times(n)/exact - 1.0_qp), dp))
            end do
            if (counter%count < 20) worst = huge(worst)
            of = "e = 1"
            if (powers(i) > 0) of = "e = 1 - 1e-"//to_text(powers(i))
            call verdicts%judge(of, "times of 20 bounces: error", worst, most=1e-13_dp)
        end do
    end subroutine stress_elastic

    subroutine stress_zeno(system, method, verdicts)
        !! The bounces end at \(2v_0/[g(1-e)]\); from there on the ball lies on the floor, exactly.
        class(system_t), intent(inout) :: system  !! its parameters are set as needed
        class(dense_integrator_t), intent(inout) :: method  !! with its tolerance; prepared here
        type(ledger_t), intent(inout) :: verdicts  !! gets the lines
        real(dp), parameter :: restitutions(*) = [0.1_dp, 0.5_dp, 0.8_dp, 0.95_dp]
        type(counter_t), target :: counter
        real(dp) :: e, zeno, q(1), v(1)
        integer :: i

        do i = 1, size(restitutions)
            e = restitutions(i)
            zeno = 2.0_dp*v0/(g*(1.0_dp - e))
            call bounce(system, method, e, 2.0_dp*zeno, counter, q, v)
            call verdicts%judge("e = "//to_text(e), "time of the last: relative error", &
                                abs(counter%last/zeno - 1.0_dp), most=1e-12_dp, &
                                remark=to_text(counter%count)//" bounces, rest at t = "// &
                                short(counter%last, 6)//" s")
            call verdicts%judge("e = "//to_text(e), "height and speed after that", &
                                max(abs(q(1)), abs(v(1))), 0.0_dp, 0.0_dp)
        end do
    end subroutine stress_zeno

    subroutine bounce(system, method, e, duration, counter, q_end, v_end)
        !! Thrown up from the floor. A run that fails leaves no impact.
        class(system_t), intent(inout) :: system
        class(dense_integrator_t), intent(inout) :: method
        real(dp), intent(in) :: e, duration
        type(counter_t), target, intent(inout) :: counter
        real(dp), intent(out), optional :: q_end(1), v_end(1)
        type(observer_box_t) :: observers(1)
        type(event_box_t) :: events(1)
        type(contact_event_t) :: contact
        type(error_t), allocatable :: error
        type(time_grid_t) :: plan
        real(dp) :: q(1), v(1), ended

        counter%count = 0
        counter%last = 0.0_dp
        observers(1)%item => counter
        call new_contact_event(contact, 1)
        allocate (events(1)%item, source=contact)
        call system%configure([1.0_dp, g, e], error)
        call new_sample_times(plan, 0.0_dp, duration, 10_i8, error)
        q = 0.0_dp
        v = v0
        call run_dense(system, method, plan, events, observers, q, v, ended, error)
        if (allocated(error)) counter%count = 0
        if (allocated(error)) q = huge(q)
        if (present(q_end)) q_end = q
        if (present(v_end)) v_end = v
    end subroutine bounce

    subroutine observe(self, system, t, q, v, error)
        !! Samples don't matter.
        class(counter_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t, q(system%ndof), v(system%ndof)
        type(error_t), allocatable, intent(out) :: error
    end subroutine observe

    subroutine meet(self, system, event, t, q, v, error)
        !! One more.
        class(counter_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        integer, intent(in) :: event
        real(dp), intent(in) :: t, q(system%ndof), v(system%ndof)
        type(error_t), allocatable, intent(out) :: error

        self%count = self%count + 1
        self%last = t
        if (self%count <= size(self%times)) self%times(self%count) = t
    end subroutine meet
end module lagrangia_bounces
