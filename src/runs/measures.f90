module lagrangia_measures
    !! What a run is judged by: the worst of its columns, its period, its small oscillations.
    use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
    use lagrangia_counted, only: counted
    use lagrangia_errors, only: error_t
    use lagrangia_frequency_formula, only: find_formula
    use lagrangia_hyperdual, only: hyperdual_t
    use lagrangia_kinds, only: dp
    use lagrangia_ledger, only: claim_t
    use lagrangia_mass_matrix, only: list_of
    use lagrangia_mode_rounding, only: find_rounding, mode_rounding_t
    use lagrangia_outcome, only: outcome_t
    use lagrangia_period, only: period_t
    use lagrangia_record, only: sample_record_t
    use lagrangia_reference, only: reference_t
    use lagrangia_scene, only: scene_t
    use lagrangia_small_oscillations, only: find_modes, is_oscillation, likely_equilibrium, modes_t
    use lagrangia_system, only: system_t
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: take_measures, take_modes

contains

    subroutine take_measures(scene, system, record, period, reference, outcome)
        !! The worst of every drift and error, and the period beside what it should be; and which
        !! quantities have gaps.
        type(scene_t), intent(in) :: scene  !! says what is expected
        class(system_t), intent(in) :: system  !! with the scene's parameters
        type(sample_record_t), intent(in) :: record  !! of the samples, when the run has ended
        type(period_t), intent(in) :: period  !! of the coordinate `period_of`
        class(reference_t), allocatable, intent(in) :: reference
        !! absent: no closed form is known
        type(outcome_t), intent(inout) :: outcome  !! gets the measures
        type(claim_t) :: m
        real(dp) :: measured
        integer :: i

        outcome%energy_evaluations = record%columns%energy_evaluations
        outcome%rows = record%rows
        if (record%rows > 0) then
            outcome%remark = outcome%remark//gaps_text(record)
            do i = 1, size(record%columns%items)
                m = measure(record%columns%items(i)%name, record%worst(i))
                if (m%name == "energy_drift") outcome%energy_terms = &
                    energy_terms(system, outcome)/record%columns%items(i)%scale
                if (record%columns%items(i)%drift) then
                    outcome%drifts = [outcome%drifts, m]
                else if (m%name == "error" .or. m%judged) then
                    outcome%others = [outcome%others, m]
                end if
            end do
        end if
        if (scene%period_of == "") return
        outcome%period = period%period()
        outcome%turns = period%turns
        if (period%mean() > 0.0_dp) outcome%intervals = [period%shortest, period%longest]
        if (.not. allocated(reference)) return
        outcome%exact_period = max(0.0_dp, reference%period)
        outcome%small_period = max(0.0_dp, reference%small_period)
        measured = period%mean()
        if (measured <= 0.0_dp) measured = ieee_value(measured, ieee_quiet_nan)
        if (reference%period > 0.0_dp) outcome%others = [outcome%others, &
            measure("period", abs(measured/reference%period - 1.0_dp))]
        if (reference%small_period > 0.0_dp) outcome%others = [outcome%others, &
            measure("small_period", abs(measured/reference%small_period - 1.0_dp))]
    contains
        pure function measure(name, worst) result(m)
            character(*), intent(in) :: name
            real(dp), intent(in) :: worst
            type(claim_t) :: m
            integer :: k

            m%name = name
            m%value = worst
            k = findloc(scene%expectations%name == name, .true., 1)
            if (k == 0) return
            m%judged = scene%expectations(k)%judged
            m%most = scene%expectations(k)%limit
        end function measure
    end subroutine take_measures

    pure function gaps_text(record) result(text)
        !! ` (no finite number, and NaN: E2 in 1, u in 247 of 501 rows)`; empty where every quantity
        !! has its numbers.
        type(sample_record_t), intent(in) :: record  !! with rows
        character(:), allocatable :: text
        integer :: i

        text = ""
        do i = 1, size(record%ranges)
            if (record%ranges(i)%gaps == 0) cycle
            if (text /= "") text = text//", "
            text = text//trim(record%columns%items(i)%name)//" in "//to_text(record%ranges(i)%gaps)
        end do
        if (text /= "") text = " (no finite number, and NaN: "//text//" of "// &
                               counted(record%rows, "row")//")"
    end function gaps_text

    function energy_terms(system, outcome) result(bound)
        !! \(\sum_j|p_j\dot q_j| + |L|\) at the end: the energy is a difference of such terms, and
        !! below an epsilon of them it is rounding.
        class(system_t), intent(in) :: system
        type(outcome_t), intent(in) :: outcome
        real(dp) :: bound
        real(dp) :: p(system%ndof)
        type(hyperdual_t) :: l, qq(system%ndof), tt, vv(system%ndof)

        tt%re = outcome%t
        qq%re = outcome%q
        vv%re = outcome%v
        l = system%lagrangian(tt, qq, vv)
        call system%momenta(outcome%t, outcome%q, outcome%v, p)
        bound = sum(abs(p*outcome%v)) + abs(l%re)
    end function energy_terms

    subroutine take_modes(scene, system, outcome)
        !! The frequencies of the small oscillations, if the scene asks and there are any.
        type(scene_t), intent(in) :: scene  !! says whether modes are asked for
        class(system_t), intent(in) :: system  !! with the scene's parameters
        type(outcome_t), intent(inout) :: outcome  !! gets the frequencies
        type(modes_t) :: modes
        type(mode_rounding_t) :: rounding
        type(error_t), allocatable :: error
        integer :: j

        if (.not. scene%modes) return
        call find_modes(system, likely_equilibrium(system), .false., modes, error)
        if (allocated(error)) then
            outcome%no_omega = error%message
            return
        end if
        do j = 1, size(modes%omega2)
            if (modes%label(j) /= is_oscillation) cycle
            if (outcome%omega <= 0.0_dp) then
                outcome%omega = sqrt(modes%omega2(j))
                call find_rounding(system, modes, rounding)
                outcome%omega_share = 0.5_dp*rounding%squares(j)/modes%omega2(j)
                outcome%undamped = system%nonconservative
                call find_formula(system, modes%at, modes%omega2(j), outcome%omega_formula)
            end if
            if (.not. allocated(modes%analytic%omega2)) cycle
            outcome%omega_error = max(outcome%omega_error, &
                                      abs(sqrt(modes%analytic%omega2(j)/modes%omega2(j)) - 1.0_dp))
        end do
        if (outcome%omega <= 0.0_dp) outcome%no_omega = "nothing "// &
            "oscillates about q = "//list_of(modes%at)
    end subroutine take_modes
end module lagrangia_measures
