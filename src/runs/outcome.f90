module lagrangia_outcome
    !! What came out of one scene: a row of the scorecard.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
    use lagrangia_characters, only: printable
    use lagrangia_final_values, only: final_value_t, final_values_json
    use lagrangia_json, only: json_item, json_list, json_number, json_object, json_pair, &
                              json_string
    use lagrangia_kinds, only: dp, i8
    use lagrangia_ledger, only: claim_t
    use lagrangia_number_text, only: fixed, scientific
    use lagrangia_printed_table, only: left, right
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: outcome_t
    public :: outcome_json, scorecard_head, scorecard_legend, scorecard_row
    public :: from_closed_form, from_half_step, from_steps

    character(*), parameter :: scorecard_legend = &
        "drift: the largest change of an invariant in the rows, relative to its start or "// &
        "natural size"//new_line("a")//"error: the largest of a coordinate in the rows, not "// &
        "of a velocity, absolute below 1 and"//new_line("a")//"relative above; exact: "// &
        "against a closed form, estimate: against the same run at half the"// &
        new_line("a")//"step or a hundredth of the tolerance, and against another method; "// &
        "steps: a closed form"//new_line("a")//"against steps of gauss16"

    integer, parameter :: from_closed_form = 1, from_half_step = 2
    integer, parameter :: from_steps = 3  !! of a method, where the run is the closed form
    character(8), parameter :: sources(3) = ["exact   ", "estimate", "steps   "]

    type :: outcome_t
        character(:), allocatable :: scene, system, method, file
        character(:), allocatable :: events         !! their data file, if there is one to draw
        real(dp) :: t = 0.0_dp
        real(dp), allocatable :: q(:), v(:)
        integer(i8) :: steps = 0, evaluations = 0, energy_evaluations = 0, rows = 0
        integer(i8) :: rejected = 0                 !! steps that were tried and taken back
        type(claim_t), allocatable :: drifts(:)   !! of the invariants
        type(claim_t), allocatable :: others(:)   !! `error`, `period`, ...
        type(final_value_t), allocatable :: state(:)     !! final, with errors, if that was asked
        integer :: error_from = 0                   !! 0: no error known
        real(dp) :: period = 0.0_dp                 !! measured, s; 0 if not
        real(dp) :: omega = 0.0_dp                  !! of the slowest small oscillation; or 0
        real(dp) :: omega_error = -1.0_dp           !! of all frequencies from the closed form
        real(dp) :: seconds = 0.0_dp
        character(:), allocatable :: choice         !! `auto took ...`; "" if a method was named
        character(:), allocatable :: warning        !! of a step that is too long, or ""
        character(:), allocatable :: remark         !! about the steps; "" if there is none
        character(:), allocatable :: failure        !! the run itself failed
    contains
        procedure :: verdict
        procedure :: holds
        procedure :: error
        procedure :: period_is_small
        procedure, private :: shown_period
    end type outcome_t

contains

    pure function holds(self) result(good)
        !! Whether the run ended and every tolerance of the scene held.
        class(outcome_t), intent(in) :: self
        logical :: good

        good = .not. allocated(self%failure)
        if (allocated(self%drifts)) good = good .and. all(within(self%drifts))
        if (allocated(self%others)) good = good .and. all(within(self%others))
    end function holds

    elemental function within(measure) result(good)
        !! Not judged, or within its limit; NaN is not.
        type(claim_t), intent(in) :: measure
        logical :: good

        good = .not. measure%judged .or. measure%value <= measure%most
    end function within

    pure function error(self) result(value)
        !! The error; negative where none is known.
        class(outcome_t), intent(in) :: self
        real(dp) :: value
        integer :: i

        value = -1.0_dp
        if (self%error_from == 0) return
        do i = 1, size(self%others)
            if (self%others(i)%name == "error") value = self%others(i)%value
        end do
    end function error

    pure function shown_period(self) result(which)
        !! Which of `others` is the period error of the scorecard: one that is judged, or the
        !! first; 0 if there is none.
        class(outcome_t), intent(in) :: self
        integer :: which, i

        which = 0
        do i = 1, size(self%others)
            if (index(self%others(i)%name, "period") == 0) cycle
            if (self%others(i)%judged .or. which == 0) which = i
        end do
    end function shown_period

    pure function period_is_small(self) result(yes)
        !! Whether that is the error beside \(2\pi/\omega\) and not beside the exact period.
        class(outcome_t), intent(in) :: self
        logical :: yes
        integer :: i

        i = self%shown_period()
        yes = .false.
        if (i > 0) yes = self%others(i)%name == "small_period"
    end function period_is_small

    function verdict(self) result(text)
        !! `holds`, `not judged`, or what did not hold.
        class(outcome_t), intent(in) :: self
        character(:), allocatable :: text
        logical :: judged
        integer :: i

        if (allocated(self%failure)) then
            text = "failed"
            return
        end if
        text = ""
        judged = .false.
        do i = 1, size(self%drifts)
            call judge(self%drifts(i))
        end do
        do i = 1, size(self%others)
            call judge(self%others(i))
        end do
        if (text == "") text = merge("holds     ", "not judged", judged)
        text = trim(text)
    contains
        subroutine judge(measure)
            type(claim_t), intent(in) :: measure

            judged = judged .or. measure%judged
            if (within(measure)) return
            if (text /= "") text = text//", "
            text = text//"NOT "//trim(measure%name)//" "//short(measure%value)//" > "// &
                   short(measure%most)
        end subroutine judge
    end function verdict

    pure function short(value) result(text)
        !! Two digits are enough for an error.
        real(dp), intent(in) :: value
        character(:), allocatable :: text

        text = scientific(value, 2)
    end function short

    function outcome_json(self) result(json)
        !! One object, as `--json` prints it.
        type(outcome_t), intent(in) :: self  !! of a run that has ended
        character(:), allocatable :: json, drifts, error_from, remark, state
        integer :: i

        remark = ""
        if (allocated(self%remark)) remark = adjustl(self%remark)
        drifts = ""
        do i = 1, size(self%drifts)
            drifts = drifts//json_pair(self%drifts(i)%name, self%drifts(i)%value)
        end do
        state = "null"
        if (allocated(self%state)) state = final_values_json(self%state)
        error_from = ""
        if (.not. self%error() < 0.0_dp) error_from = trim(sources(self%error_from))
        json = json_pair("scene", self%scene)//json_pair("system", self%system)// &
               json_pair("method", self%method)//json_pair("t", self%t)// &
               json_item("q", json_list(self%q))//json_item("v", json_list(self%v))// &
               json_pair("steps", self%steps)//json_pair("evaluations", self%evaluations)// &
               json_item("energy_drift", find(self%drifts, "energy_drift"))// &
               json_item("drifts", json_object(drifts))// &
               json_item("error", find(self%others, "error"))// &
               json_item("error_from", json_text(error_from))
        json = json//json_item("period", known(self%period, self%period > 0.0_dp))// &
               json_item("period_error", find(self%others, "period"))// &
               json_item("small_period_error", find(self%others, "small_period"))// &
               json_item("omega", known(self%omega, self%omega > 0.0_dp))// &
               json_item("omega_error", known(self%omega_error, self%omega_error >= 0.0_dp))// &
               json_item("state", state)//json_pair("seconds", self%seconds)
        json = json//json_item("choice", json_text(self%choice))// &
               json_item("warning", json_text(self%warning))// &
               json_item("remark", json_text(remark))// &
               json_item("failure", json_text(self%failure))// &
               json_pair("verdict", self%verdict())//json_item("file", json_text(self%file))// &
               json_item("events", json_text(self%events))
        json = json_object(json)
    end function outcome_json

    pure function known(value, is_known) result(json)
        !! The number, or `null`.
        real(dp), intent(in) :: value
        logical, intent(in) :: is_known
        character(:), allocatable :: json

        json = "null"
        if (is_known) json = json_number(value)
    end function known

    pure function json_text(text) result(json)
        !! The text, or `null` where it is empty or not there.
        character(*), intent(in), optional :: text
        character(:), allocatable :: json

        json = "null"
        if (.not. present(text)) return
        if (text /= "") json = json_string(text)
    end function json_text

    pure function find(measures, name) result(json)
        !! The worst of `name`, or `null`.
        type(claim_t), intent(in) :: measures(:)
        character(*), intent(in) :: name
        character(:), allocatable :: json
        integer :: i

        json = "null"
        do i = 1, size(measures)
            if (measures(i)%name == name) json = json_number(measures(i)%value)
        end do
    end function find

    function scorecard_head() result(line)
        !! The titles over the rows.
        character(:), allocatable :: line

        line = cells("scene", "system", "method", "steps", "evaluations", "worst drift", "error", &
                     "period error", "omega", "seconds", "verdict")
    end function scorecard_head

    function scorecard_row(self) result(line)
        !! One line a scene.
        type(outcome_t), intent(in) :: self  !! of a run that has ended
        character(:), allocatable :: line
        character(:), allocatable :: drift, error_text, period_text
        character(:), allocatable :: omega_text
        integer :: i, k

        drift = "-"
        if (size(self%drifts) > 0) then
            k = maxloc(self%drifts%value, 1)
            associate (name => self%drifts(k)%name)
                drift = short(self%drifts(k)%value)//" "//name(:index(name, "_drift") - 1)
            end associate
        end if
        error_text = "-"
        if (.not. self%error() < 0.0_dp) error_text = short(self%error())//" "// &
                                                      trim(sources(self%error_from))
        period_text = "-"
        i = self%shown_period()
        if (i > 0) then
            if (.not. ieee_is_nan(self%others(i)%value)) period_text = short(self%others(i)%value)
            if (self%period_is_small()) period_text = period_text//" small"
        end if
        omega_text = "-"
        if (self%omega > 0.0_dp) then
            omega_text = fixed(self%omega, 5)
            if (self%omega < 0.01_dp .or. self%omega >= 1e6_dp) then
                omega_text = scientific(self%omega, 6)
            end if
            if (self%omega_error >= 0.0_dp) omega_text = omega_text//" "//short(self%omega_error)
        end if
        line = cells(printable(self%scene), self%system, self%method, to_text(self%steps), &
                     to_text(self%evaluations), drift, error_text, period_text, omega_text, &
                     fixed(self%seconds, 4), self%verdict())
    end function scorecard_row

    pure function cells(scene, system, method, steps, evaluations, drift, error, period, omega, &
                        seconds, verdict) result(line)
        !! The row's columns: words to the left, counts to the right.
        character(*), intent(in) :: scene, system, method, steps, evaluations, drift, error, &
                                    period, omega, seconds, verdict
        character(:), allocatable :: line

        line = left(scene, 26)//left(system, 17)//left(method, 8)//right(steps, 8)// &
               right(evaluations, 12)//"  "//left(drift, 23)//left(error, 18)//left(period, 14)// &
               left(omega, 17)// &
               right(seconds, 8)//"  "//verdict
    end function cells
end module lagrangia_outcome
