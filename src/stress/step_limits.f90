module lagrangia_step_limits
    !! The longest step, in units of \(1/\omega\), with which a method does not blow up.
    !!
    !! One step on the oscillator is a linear map of \((x, v)\). A longer and longer step is looked
    !! at until an eigenvalue leaves the unit circle, and the place is bisected; then runs on both
    !! sides of it say the same. Where a method iterates, its iteration may fail before that.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use lagrangia_charged_particle, only: charged_particle_t
    use lagrangia_errors, only: error_t
    use lagrangia_integrator, only: integrator_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_ledger, only: ledger_t
    use lagrangia_oscillator, only: oscillator_t
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: stress_step_limit, step_limit

    real(dp), parameter :: stride = 1e-3_dp, farthest = 8.0_dp  !! of the search
    real(dp), parameter :: resolution = 1e-3_dp                 !! to which a limit is known
    real(dp), parameter :: rounding = 1e-5_dp  !! of an eigenvalue: the root of epsilon and more

contains

    subroutine stress_step_limit(method, runs, verdicts)
        !! The limit beside the one that the method declares, and runs just below and above.
        class(integrator_t), intent(inout) :: method  !! that is measured; prepared here
        integer(i8), intent(in) :: runs  !! steps of a run
        type(ledger_t), intent(inout) :: verdicts  !! gets the lines
        class(system_t), allocatable :: system
        logical :: refused
        real(dp) :: limit

        call new_oscillation(method, system, refused)
        if (refused) return
        limit = step_limit(method, system)
        if (limit >= farthest) then
            call verdicts%judge(method%name, "longest stable omega dt", limit, &
                                remark="stable as far as was looked")
        else if (method%step_limit > 0.0_dp) then
            call verdicts%judge(method%name, "longest stable omega dt", limit, &
                                method%step_limit - resolution, method%step_limit + resolution)
            call verdicts%judge(method%name, "runs that agree, of 2", &
                                merge(1.0_dp, 0.0_dp, .not. grows(method, system, limit - &
                                                                  resolution, runs)) + &
                                merge(1.0_dp, 0.0_dp, grows(method, system, limit + &
                                                            resolution, runs)), 2.0_dp, 2.0_dp)
        else
            call verdicts%judge(method%name, "longest solvable omega dt", limit, &
                                remark="beyond, its iteration does not converge")
        end if
    end subroutine stress_step_limit

    subroutine new_oscillation(method, system, refused)
        !! \(\omega = 1\) in one coordinate, or a trap in three for methods made for charges.
        class(integrator_t), intent(inout) :: method
        class(system_t), allocatable, intent(out) :: system
        logical, intent(out) :: refused
        type(error_t), allocatable :: error

        allocate (oscillator_t :: system)
        call system%configure([1.0_dp, 1.0_dp], error)
        call method%prepare(system, error)
        refused = allocated(error)
        if (.not. refused) return
        deallocate (system)
        allocate (charged_particle_t :: system)
        call system%configure([1.0_dp, 1.0_dp, 0.0_dp, 0.0_dp, 0.0_dp, 0.0_dp, 0.0_dp, 0.0_dp, &
                               1.0_dp], error)
        call method%prepare(system, error)
        refused = allocated(error)
    end subroutine new_oscillation

    function step_limit(method, system) result(limit)
        !! Where the first eigenvalue leaves the circle, or the step cannot be taken.
        class(integrator_t), intent(inout) :: method  !! that is measured; prepared here
        class(system_t), intent(in) :: system  !! with its parameters
        real(dp) :: limit
        real(dp) :: beyond, middle

        limit = 0.0_dp
        do
            beyond = limit + stride
            if (amplifies(method, system, beyond)) exit
            limit = beyond
            if (limit >= farthest) return
        end do
        do while (beyond - limit > 1e-9_dp)
            middle = 0.5_dp*(limit + beyond)
            if (amplifies(method, system, middle)) then
                beyond = middle
            else
                limit = middle
            end if
        end do
    end function step_limit

    function amplifies(method, system, dt) result(yes)
        !! An eigenvalue of the step is larger than 1.
        class(integrator_t), intent(inout) :: method
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: dt
        logical :: yes
        real(dp), dimension(system%ndof) :: q, v
        real(dp) :: map(2, 2), half_trace, determinant, radius
        integer :: i

        do i = 1, 2
            q = 0.0_dp
            v = 0.0_dp
            if (i == 1) q(1) = 1.0_dp
            if (i == 2) v(1) = 1.0_dp
            call method%start(system, 0.0_dp, q, v)
            call method%advance(system, 0.0_dp, dt, 0_i8, 1_i8, q, v)
            map(:, i) = [q(1), v(1)]
        end do
        yes = .not. all(ieee_is_finite(map))
        if (yes) return
        half_trace = 0.5_dp*(map(1, 1) + map(2, 2))
        determinant = map(1, 1)*map(2, 2) - map(1, 2)*map(2, 1)
        radius = sqrt(max(0.0_dp, determinant))
        if (half_trace**2 > determinant) radius = abs(half_trace) + sqrt(half_trace**2 &
                                                                         - determinant)
        yes = radius > 1.0_dp + rounding
    end function amplifies

    function grows(method, system, dt, steps) result(yes)
        !! A run of so many steps multiplies the energy by more than \(10^{12}\).
        class(integrator_t), intent(inout) :: method
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: dt
        integer(i8), intent(in) :: steps
        logical :: yes
        real(dp), dimension(system%ndof) :: q, v
        real(dp) :: start
        integer(i8), parameter :: every = 100
        integer(i8) :: k

        q = 0.0_dp
        v = 0.0_dp
        q(1) = 1.0_dp
        v(1) = 0.3_dp
        call method%start(system, 0.0_dp, q, v)
        start = system%energy(0.0_dp, q, v)
        yes = .false.
        do k = 0, steps - 1, every
            call method%advance(system, 0.0_dp, dt, k, every, q, v)
            yes = .not. system%energy(0.0_dp, q, v) <= 1e12_dp*start
            if (yes) return
        end do
    end function grows
end module lagrangia_step_limits
