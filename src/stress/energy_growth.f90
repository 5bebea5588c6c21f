module lagrangia_energy_growth
    !! How the energy error of a long run grows with the number of steps: measured at powers of
    !! ten, fitted and named; whether that is what the method declares; and what rounding alone does
    !! to a method that is exact, Verlet on the oscillator, with compensated sums and without.
    use lagrangia_errors, only: error_t
    use lagrangia_integrator, only: integrator_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_ledger, only: ledger_t
    use lagrangia_method_orders, only: new_problem, problems, refuses
    use lagrangia_observer, only: observer_t
    use lagrangia_oscillator, only: oscillator_t
    use lagrangia_printed_table, only: short
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: growth_t, stress_energy_growth, stress_rounding, observe_energy

    integer(i8), parameter :: most_steps = 100000000_i8
    integer(i8), parameter :: every = 7            !! odd: it meets all phases of a swing
    integer(i8), parameter :: tick_every = 4096    !! energies between two words to the watcher
    real(dp), parameter :: short_step = 0.02_dp, long_step = 0.05_dp  !! s

    type :: growth_t
        !! The largest error so far, at \(10^3, 10^{3.5}, 10^4, \dots\) steps.
        real(dp) :: worst = 0.0_dp
        real(dp), allocatable :: steps(:), errors(:)
    contains
        procedure :: see
        procedure :: exponent_of
        procedure :: law
        procedure :: remark
    end type growth_t

contains

    subroutine stress_energy_growth(method, evaluations, verdicts, watcher)
        !! On a pendulum from 2 rad, or on a charge in a trap where the method is for charges only.
        !! What declares its energy error bounded must keep it so; the rounding of so many
        !! evaluations may grow as a random walk. What declares nothing is expected to drift.
        class(integrator_t), intent(inout) :: method  !! that is measured; prepared here
        integer(i8), intent(in) :: evaluations  !! at most, in a power of ten of steps
        type(ledger_t), intent(inout) :: verdicts  !! gets the lines
        class(observer_t), intent(inout), optional :: watcher  !! told how far it is
        class(system_t), allocatable :: system
        real(dp), allocatable :: q(:), v(:)
        type(growth_t) :: growth
        real(dp) :: rounding
        integer(i8) :: steps
        integer :: k

        do k = 1, problems
            call new_problem(k, system, q, v)
            if (.not. refuses(method, system)) exit
        end do
        if (k > problems) return
        call observe_energy(method, system, long_step, 1000_i8, q, v, growth)
        steps = min(most_steps, 10_i8**int(log10(1000.0_dp*evaluations/method%evaluations)))
        call new_problem(k, system, q, v)
        call observe_energy(method, system, merge(long_step, short_step, &
                                                  method%energy_order > 0), steps, q, v, growth, &
                            watcher)
        ! a unit in the last place a time, as a random walk; the terms are larger than their sum
        rounding = 4.0_dp*epsilon(rounding)*sqrt(real(method%evaluations, dp))
        associate (p => growth%exponent_of())
            if (method%energy_order == 0) then
                call verdicts%judge(method%name, "p of energy error ~ N^p", p, 0.75_dp, 1.25_dp, &
                                    growth%remark())
            else if (growth%worst <= rounding) then
                call verdicts%judge(method%name, "p of energy error ~ N^p", p, most=0.9_dp, &
                                    remark=growth%remark()//": rounding")
            else
                call verdicts%judge(method%name, "p of energy error ~ N^p", p, most=0.2_dp, &
                                    remark=growth%remark())
            end if
        end associate
    end subroutine stress_energy_growth

    subroutine observe_energy(method, system, dt, steps, q, v, growth, watcher)
        !! Take the steps and see the relative error of the energy.
        class(integrator_t), intent(inout) :: method  !! that is measured; prepared here
        class(system_t), intent(in) :: system  !! with its parameters
        real(dp), intent(in) :: dt  !! s
        integer(i8), intent(in) :: steps  !! how many
        real(dp), intent(inout) :: q(system%ndof), v(system%ndof)  !! the start; on return the end
        type(growth_t), intent(out) :: growth  !! of the relative error
        class(observer_t), intent(inout), optional :: watcher  !! told how far it is
        type(error_t), allocatable :: refusal
        real(dp) :: start
        integer(i8) :: k, count

        call method%prepare(system, refusal)
        call method%start(system, 0.0_dp, q, v)
        start = system%energy(0.0_dp, q, v)
        do k = 0, steps - 1, every
            count = min(every, steps - k)
            call method%advance(system, 0.0_dp, dt, k, count, q, v)
            call growth%see(k + count, abs(system%energy(0.0_dp, q, v)/start - 1.0_dp))
            if (.not. present(watcher) .or. mod(k, every*tick_every) > 0) cycle
            call watcher%tick(k, steps)
        end do
    end subroutine observe_energy

    pure subroutine see(self, steps, error)
        !! The error after so many steps; what is not a number counts as huge.
        class(growth_t), intent(inout) :: self
        integer(i8), intent(in) :: steps  !! so far
        real(dp), intent(in) :: error  !! its magnitude
        real(dp), allocatable :: longer(:)
        integer :: n

        self%worst = max(self%worst, error)
        if (.not. error <= huge(error)) self%worst = huge(error)
        if (.not. allocated(self%steps)) allocate (self%steps(0), self%errors(0))
        n = size(self%steps)
        if (real(steps, dp) < 10.0_dp**(3.0_dp + 0.5_dp*n)) return
        allocate (longer(n + 1))
        longer = [self%steps, real(steps, dp)]
        call move_alloc(longer, self%steps)
        allocate (longer(n + 1))
        longer = [self%errors, self%worst]
        call move_alloc(longer, self%errors)
    end subroutine see

    pure function exponent_of(self) result(p)
        !! \(p\) of the law \(N^p\): the slope of the logarithms over the last two decades, by
        !! least squares.
        class(growth_t), intent(in) :: self
        real(dp) :: p
        real(dp), allocatable :: x(:), y(:)
        integer :: n

        n = size(self%steps)
        allocate (x, source=log(self%steps(max(1, n - 4):)))
        allocate (y, source=log(self%errors(max(1, n - 4):) + tiny(p)))
        x = x - sum(x)/size(x)
        p = sum(x*y)/sum(x**2)
    end function exponent_of

    pure function law(self) result(name)
        !! The nearest of the laws.
        class(growth_t), intent(in) :: self
        character(:), allocatable :: name

        associate (p => self%exponent_of())
            if (p <= 0.2_dp) then
                name = "bounded"
            else if (p <= 0.8_dp) then
                name = "sqrt N"
            else if (p <= 1.25_dp) then
                name = "linear"
            else
                name = "faster than linear"
            end if
        end associate
    end function law

    pure function remark(self) result(text)
        !! `linear: 1.5e-3 after 1e6 steps`.
        class(growth_t), intent(in) :: self
        character(:), allocatable :: text

        text = self%law()//": "//short(self%worst, 2)//" after "// &
               short(self%steps(size(self%steps)), 1)//" steps"
    end function remark

    subroutine stress_rounding(method, sums, steps, verdicts, watcher)
        !! The energy that its steps conserve exactly but for rounding,
        !! \((1-\omega^2h^2/4)v^2 + \omega^2x^2\) for drift, kick, drift. Plain sums lose it as a
        !! random walk, \(\varepsilon\sqrt N\); compensated ones keep it but for the last digits.
        !! In still longer runs roundings repeat themselves, and their bias adds up: that is told.
        class(integrator_t), intent(inout) :: method  !! that is measured; prepared here
        character(*), intent(in) :: sums     !! "plain" or "compensated"
        integer(i8), intent(in) :: steps  !! how many
        type(ledger_t), intent(inout) :: verdicts  !! gets the lines
        class(observer_t), intent(inout), optional :: watcher  !! told how far it is
        real(dp), parameter :: h = 0.1_dp
        integer(i8), parameter :: every = 100, farthest = 10000000_i8  !! that is judged
        type(oscillator_t) :: system
        type(growth_t) :: growth
        type(error_t), allocatable :: error
        real(dp) :: q(1), v(1), start, scale
        integer(i8) :: k

        call system%configure([1.0_dp, 1.0_dp], error)
        call method%prepare(system, error)
        q = 1.0_dp
        v = 0.3_dp
        call method%start(system, 0.0_dp, q, v)
        start = energy()
        do k = 0, steps - 1, every
            call method%advance(system, 0.0_dp, h, k, every, q, v)
            call growth%see(k + every, abs(energy()/start - 1.0_dp))
            if (.not. present(watcher) .or. mod(k, every*tick_every) > 0) cycle
            call watcher%tick(k, steps)
        end do
        scale = epsilon(h)*sqrt(real(steps, dp))
        if (steps > farthest) then
            call verdicts%judge(trim(method%name)//", "//sums, "own energy, error/(eps sqrt N)", &
                                growth%worst/scale, remark=growth%remark())
        else if (sums == "plain") then
            call verdicts%judge(trim(method%name)//", plain", "own energy, error/(eps sqrt N)", &
                                growth%worst/scale, most=4.0_dp, remark=growth%remark())
        else
            call verdicts%judge(trim(method%name)//", compensated", "own energy, error", &
                                growth%worst, most=3e-14_dp, remark=growth%remark())
        end if
    contains
        function energy()
            real(dp) :: energy

            energy = (1.0_dp - 0.25_dp*h**2)*v(1)**2 + q(1)**2
        end function energy
    end subroutine stress_rounding
end module lagrangia_energy_growth
