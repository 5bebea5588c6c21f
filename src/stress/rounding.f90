module lagrangia_rounding
    !! What rounding does to a method that is exact: Verlet on the oscillator, with compensated
    !! sums and without.
    use lagrangia_errors, only: error_t
    use lagrangia_growth_law, only: growth_t
    use lagrangia_integrator, only: integrator_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_oscillator, only: oscillator_t
    use lagrangia_verdicts, only: verdicts_t
    implicit none (type, external)
    private
    public :: judge_rounding

contains

    subroutine judge_rounding(method, sums, steps, verdicts)
        !! The energy that its steps conserve exactly but for rounding,
        !! \((1-\omega^2h^2/4)v^2 + \omega^2x^2\) for drift, kick, drift. Plain sums lose it as a
        !! random walk, \(\varepsilon\sqrt N\); compensated ones keep it but for the last digits.
        !! In still longer runs roundings repeat themselves, and their bias adds up: that is told.
        class(integrator_t), intent(inout) :: method
        character(*), intent(in) :: sums     !! "plain" or "compensated"
        integer(i8), intent(in) :: steps
        type(verdicts_t), intent(inout) :: verdicts
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
    end subroutine judge_rounding
end module lagrangia_rounding
