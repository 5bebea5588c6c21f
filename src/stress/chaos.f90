module lagrangia_chaos
    !! A chaotic double pendulum: how fast errors grow, and after which time no digit is left.
    use lagrangia_errors, only: error_t
    use lagrangia_integrator, only: dense_integrator_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_ledger, only: ledger_t
    use lagrangia_printed_table, only: short
    use lagrangia_system, only: system_t
    use lagrangia_text, only: to_text
    use lagrangia_vectors, only: farthest
    implicit none (type, external)
    private
    public :: stress_chaos

    real(dp), parameter :: interval = 0.25_dp, no_digit = 1.0_dp  !! s; rad
    real(dp), parameter :: start(2) = [2.0_dp, 1.0_dp]            !! rad, at rest

contains

    subroutine stress_chaos(system, method, other, duration, verdicts)
        !! The growth of a small difference, followed along the motion and rescaled on the way,
        !! gives Lyapunov's exponent and a bound: an error made at \(s\) grows by
        !! \(G(t)/G(s)\). The exponent is the mean over windows of `duration`, and its error is
        !! that of their scatter: another build draws other windows. Two methods at their tightest
        !! tolerances must part where the bound says that a rounding error has become as large as
        !! the motion.
        class(system_t), intent(in) :: system  !! with its parameters
        class(dense_integrator_t), intent(inout) :: method, other
        !! two; their tolerances are set here
        real(dp), intent(in) :: duration  !! s
        type(ledger_t), intent(inout) :: verdicts  !! gets the lines
        real(dp), parameter :: loose = 1e-10_dp, tight = 1e-14_dp
        integer, parameter :: windows = 16
        real(dp), allocatable :: growth(:), distance(:)
        real(dp) :: excess, predicted, measured, exponent, rates(windows), uncertain
        integer :: k, n

        n = nint(duration/interval)
        method%tolerance = tight
        other%tolerance = tight
        call follow_growth(system, method, windows*n, growth)
        rates = [(growth(k*n) - growth((k - 1)*n), k=1, windows)]/duration
        exponent = sum(rates)/windows
        uncertain = sqrt(sum((rates - exponent)**2)/(windows*(windows - 1.0_dp)))
        call verdicts%judge("Lyapunov's exponent", "ln(growth)/time, 1/s", exponent, &
                            least=0.1_dp, remark="+- "//short(uncertain, 2)//" (1 sigma), from "// &
                            to_text(windows)//" windows of "//short(duration, 3)//" s, "// &
                            short(minval(rates), 3)//" to "//short(maxval(rates), 3)// &
                            "; every "//short(log(10.0_dp)/exponent, 2)//" s cost a digit")
        predicted = interval*findloc(growth(1:) > -log(epsilon(loose)), .true., 1)
        call follow_distance(system, method, other, n, distance)
        measured = interval*findloc(.not. distance < no_digit, .true., 1)
        call verdicts%judge("two methods, tol. 1e-14", "time when they part, s", measured, &
                            0.5_dp*predicted, 2.0_dp*predicted, "after t = "// &
                            short(measured, 3)//" s no digit is left")
        other%tolerance = loose
        call follow_distance(system, method, other, n, distance)
        excess = 0.0_dp
        do k = 1, n
            if (.not. distance(k) < 0.1_dp*no_digit) exit
            excess = max(excess, distance(k)/(loose*(1.0_dp + k*interval)*exp(growth(k) - &
                                              minval([0.0_dp, growth(:k)]))))
        end do
        call verdicts%judge("tolerance 1e-10", "error / (tolerance growth)", excess, &
                            most=10.0_dp, remark="up to t = "//short((k - 1)*interval, 3)//" s")
    end subroutine stress_chaos

    subroutine follow_growth(system, method, n, growth)
        !! `growth(k)`: the logarithm of what a small difference is multiplied by in `k` intervals.
        class(system_t), intent(in) :: system
        class(dense_integrator_t), intent(in) :: method
        integer, intent(in) :: n
        real(dp), allocatable, intent(out) :: growth(:)
        real(dp), parameter :: small = 1e-7_dp
        class(dense_integrator_t), allocatable :: one, two
        type(error_t), allocatable :: error
        real(dp), dimension(2) :: q, v, q_two, v_two
        real(dp) :: ratio
        integer :: k

        allocate (growth(0:n), source=0.0_dp)
        allocate (one, source=method)
        allocate (two, source=method)
        call one%prepare(system, error)
        call two%prepare(system, error)
        q = start
        v = 0.0_dp
        q_two = q + small*[0.5_dp, -0.5_dp]
        v_two = v + small*[0.5_dp, 0.5_dp]
        call one%start(system, 0.0_dp, q, v, interval)
        do k = 1, n
            call one%advance(system, 0.0_dp, interval, k - 1_i8, 1_i8, q, v)
            call two%start(system, (k - 1)*interval, q_two, v_two, k*interval)
            call two%advance(system, 0.0_dp, interval, k - 1_i8, 1_i8, q_two, v_two)
            ratio = norm2([q_two - q, v_two - v])/small
            growth(k) = growth(k - 1) + log(ratio)
            q_two = q + (q_two - q)/ratio
            v_two = v + (v_two - v)/ratio
        end do
    end subroutine follow_growth

    subroutine follow_distance(system, method, other, n, distance)
        !! `distance(k)`: between the coordinates by two methods after `k` intervals; huge from
        !! where one of them gives up.
        class(system_t), intent(in) :: system
        class(dense_integrator_t), intent(inout) :: method, other
        integer, intent(in) :: n
        real(dp), allocatable, intent(out) :: distance(:)
        type(error_t), allocatable :: error
        real(dp), dimension(2) :: q, v, q_other
        integer :: k

        allocate (distance(n), source=huge(interval))
        q = start
        v = 0.0_dp
        call method%prepare(system, error)
        if (.not. allocated(error)) call other%prepare(system, error)
        if (allocated(error)) return
        call method%start(system, 0.0_dp, q, v, n*interval)
        call other%start(system, 0.0_dp, q, v, n*interval)
        do k = 1, n
            call walk(method, q)
            if (.not. allocated(error)) call walk(other, q_other)
            if (allocated(error)) return
            distance(k) = farthest(q, q_other)
        end do
    contains
        subroutine walk(walker, q)
            class(dense_integrator_t), intent(inout) :: walker
            real(dp), intent(out) :: q(2)

            q = 0.0_dp
            do while (walker%t_new < k*interval)
                call walker%step(system, error)
                if (allocated(error)) return
            end do
            call walker%state_at(k*interval, q, v)
        end subroutine walk
    end subroutine follow_distance
end module lagrangia_chaos
