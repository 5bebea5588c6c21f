module lagrangia_verdicts
    !! What a stress test measured: a line for every case, with what is allowed and the verdict.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use lagrangia_bench_table, only: short
    use lagrangia_description, only: name_length
    use lagrangia_json, only: json_number, json_string
    use lagrangia_kinds, only: dp
    implicit none (type, external)
    private
    public :: verdict_t, verdicts_t

    integer, parameter :: case_length = 32, measured_length = 40, remark_length = 120

    type :: verdict_t
        character(name_length) :: row = ""           !! what is stressed
        character(case_length) :: of = ""            !! the case
        character(measured_length) :: measured = ""  !! what the number is
        real(dp) :: value = 0.0_dp
        real(dp) :: least = -huge(1.0_dp)            !! allowed; huge: no bound on that side
        real(dp) :: most = huge(1.0_dp)
        logical :: holds = .false.
        character(remark_length) :: remark = ""
    contains
        procedure :: allowed
        procedure :: word
        procedure :: object
    end type verdict_t

    type :: verdicts_t
        !! The lines of one row or of many.
        type(verdict_t), allocatable :: list(:)
        character(name_length), private :: row = ""
    contains
        procedure :: begin
        procedure :: judge
        procedure :: broken
    end type verdicts_t

contains

    pure subroutine begin(self, row)
        !! What follows is about `row`.
        class(verdicts_t), intent(inout) :: self
        character(*), intent(in) :: row

        if (.not. allocated(self%list)) allocate (self%list(0))
        self%row = row
    end subroutine begin

    pure subroutine judge(self, of, measured, value, least, most, remark)
        !! One line. A value that is not a number holds nowhere; one without bounds is only stated.
        class(verdicts_t), intent(inout) :: self
        character(*), intent(in) :: of, measured
        real(dp), intent(in) :: value
        real(dp), intent(in), optional :: least, most
        character(*), intent(in), optional :: remark
        type(verdict_t), allocatable :: longer(:)
        type(verdict_t) :: line
        integer :: n

        line%row = self%row
        line%of = of
        line%measured = measured
        line%value = value
        if (present(least)) line%least = least
        if (present(most)) line%most = most
        if (present(remark)) line%remark = remark
        line%holds = ieee_is_finite(value) .and. value >= line%least .and. value <= line%most
        n = size(self%list)
        allocate (longer(n + 1))
        longer(:n) = self%list
        longer(n + 1) = line
        call move_alloc(longer, self%list)
    end subroutine judge

    pure function broken(self) result(number)
        !! How many lines do not hold.
        class(verdicts_t), intent(in) :: self
        integer :: number

        number = count(.not. self%list%holds)
    end function broken

    pure function allowed(self) result(text)
        !! `<= 1e-13`, `>= 2`, `1.999 .. 2.001`; `-` where there is no bound.
        class(verdict_t), intent(in) :: self
        character(:), allocatable :: text
        logical :: below, above

        below = self%least > -huge(1.0_dp)
        above = self%most < huge(1.0_dp)
        text = "-"
        if (below .and. above) then
            text = short(self%least, 4)//" .. "//short(self%most, 4)
            if (.not. self%least < self%most) text = "= "//short(self%least, 4)
        else if (below) then
            text = ">= "//short(self%least, 2)
        else if (above) then
            text = "<= "//short(self%most, 2)
        end if
    end function allowed

    pure function word(self) result(text)
        !! The verdict.
        class(verdict_t), intent(in) :: self
        character(:), allocatable :: text

        text = "holds"
        if (self%holds .and. self%allowed() == "-") text = "stated"
        if (.not. self%holds) text = "FAILS"
    end function word

    pure function object(self) result(json)
        !! The line as a JSON object; a side without a bound is null.
        class(verdict_t), intent(in) :: self
        character(:), allocatable :: json

        json = '{"row": '//json_string(self%row)//', "case": '//json_string(self%of)// &
               ', "measured": '//json_string(self%measured)//', "value": '// &
               json_number(self%value)//', "least": '//bound(self%least)//', "most": '// &
               bound(self%most)//', "holds": '//trim(merge("true ", "false", self%holds))// &
               ', "remark": '//json_string(self%remark)//"}"
    end function object

    pure function bound(value) result(json)
        !! A number, or null.
        real(dp), intent(in) :: value
        character(:), allocatable :: json

        json = "null"
        if (abs(value) < huge(value)) json = json_number(value)
    end function bound
end module lagrangia_verdicts
