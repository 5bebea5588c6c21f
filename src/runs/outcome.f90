module lagrangia_outcome
    !! What came out of one scene, the verdict on it, and both as JSON.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
    use lagrangia_final_values, only: final_value_t, final_values_json
    use lagrangia_json, only: json_item, json_list, json_number, json_object, json_pair, &
                              json_string
    use lagrangia_kinds, only: dp, i8
    use lagrangia_ledger, only: claim_t
    use lagrangia_number_text, only: scientific
    implicit none (type, external)
    private
    public :: outcome_t
    public :: outcome_json, within
    public :: from_closed_form, from_half_step, from_steps

    integer, parameter :: from_closed_form = 1, from_half_step = 2
    integer, parameter :: from_steps = 3  !! of a method, where the run is the closed form
    character(8), parameter :: sources(3) = ["exact   ", "estimate", "steps   "]

    type :: outcome_t
        character(:), allocatable :: scene, system, method, file
        character(:), allocatable :: events         !! their data file; "" where none is looked for
        logical :: draws_events = .false.           !! there is a script beside that
        real(dp) :: t = 0.0_dp
        real(dp), allocatable :: q(:), v(:)
        integer(i8) :: steps = 0, evaluations = 0, energy_evaluations = 0, rows = 0
        integer(i8) :: rejected = 0                 !! steps that were tried and taken back
        type(claim_t), allocatable :: drifts(:)   !! of the invariants
        type(claim_t), allocatable :: others(:)   !! `error`, `period`, ...
        real(dp) :: energy_terms = 0.0_dp           !! at the end, relative to the energy's drift
        type(final_value_t), allocatable :: state(:)     !! final, with errors, if that was asked
        integer :: error_from = 0                   !! 0: no error known
        real(dp) :: period = 0.0_dp                 !! measured, s; 0 if not
        real(dp) :: intervals(2) = 0.0_dp           !! the shortest and longest of its mean, s
        integer :: turns = 0                        !! lower turning points that are their ends
        real(dp) :: exact_period = 0.0_dp           !! by the closed form, s; 0 if there is none
        real(dp) :: small_period = 0.0_dp           !! \(2\pi/\omega\) of small swings, s; or 0
        real(dp) :: omega = 0.0_dp                  !! of the slowest small oscillation; or 0
        real(dp) :: omega_share = 0.0_dp            !! of it that rounding may have changed
        character(:), allocatable :: no_omega       !! why there is none, though it was asked for
        logical :: undamped = .false.               !! omega is without the generalised forces
        real(dp) :: omega_error = -1.0_dp           !! of all frequencies from the closed form
        character(:), allocatable :: omega_formula  !! `omega^2 = g/l`, which gives that; or absent
        real(dp) :: seconds = 0.0_dp
        character(:), allocatable :: title          !! of the scene
        character(:), allocatable :: changes        !! of the scene, by `--set`; absent: none
        character(:), allocatable :: choice         !! `auto took ...`; "" if a method was named
        character(:), allocatable :: warning        !! of a step that is too long, or ""
        character(:), allocatable :: remark         !! about the steps; "" if there is none
        character(:), allocatable :: failure        !! the run itself failed
    contains
        procedure :: verdict
        procedure :: holds
        procedure :: error
        procedure :: error_source
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
        type(claim_t), intent(in) :: measure  !! a drift, an error, ...
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
        if (ieee_is_nan(value)) value = -1.0_dp
    end function error

    pure function error_source(self) result(word)
        !! `exact`, `estimate` or `steps`, what the error is against; empty where none is known.
        class(outcome_t), intent(in) :: self
        character(:), allocatable :: word

        word = ""
        if (.not. self%error() < 0.0_dp) word = trim(sources(self%error_from))
    end function error_source

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
        error_from = self%error_source()
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
        json = json//json_item("title", json_text(self%title))// &
               json_item("changes", json_text(self%changes))// &
               json_item("exact_period", known(self%exact_period, self%exact_period > 0.0_dp))// &
               json_item("small_period", known(self%small_period, self%small_period > 0.0_dp))// &
               json_item("omega_formula", json_text(self%omega_formula))
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
end module lagrangia_outcome
