module lagrangia_energy_growth
    !! The energy error of a long run: its law, and whether that is what the method declares.
    use lagrangia_errors, only: error_t
    use lagrangia_growth_law, only: growth_t
    use lagrangia_integrator, only: integrator_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_method_problems, only: new_problem, problems, refuses
    use lagrangia_system, only: system_t
    use lagrangia_verdicts, only: verdicts_t
    implicit none (type, external)
    private
    public :: judge_energy_growth, observe_energy

    integer(i8), parameter :: most_steps = 100000000_i8
    integer(i8), parameter :: every = 7            !! odd: it meets all phases of a swing
    real(dp), parameter :: short_step = 0.02_dp, long_step = 0.05_dp  !! s

contains

    subroutine judge_energy_growth(method, evaluations, verdicts)
        !! On a pendulum from 2 rad, or on a charge in a trap where the method is for charges only.
        !! What declares its energy error bounded must keep it so; the rounding of so many
        !! evaluations may grow as a random walk. What declares nothing is expected to drift.
        class(integrator_t), intent(inout) :: method
        integer(i8), intent(in) :: evaluations  !! at most, in a power of ten of steps
        type(verdicts_t), intent(inout) :: verdicts
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
                                                  method%energy_order > 0), steps, q, v, growth)
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
    end subroutine judge_energy_growth

    subroutine observe_energy(method, system, dt, steps, q, v, growth)
        !! Take the steps and see the relative error of the energy.
        class(integrator_t), intent(inout) :: method
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: dt
        integer(i8), intent(in) :: steps
        real(dp), intent(inout) :: q(system%ndof), v(system%ndof)
        type(growth_t), intent(out) :: growth
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
        end do
    end subroutine observe_energy
end module lagrangia_energy_growth
