module lagrangia_final_values
    !! The final state of a run, each number only to the digits that its error leaves.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use lagrangia_concise, only: concise
    use lagrangia_description, only: name_length
    use lagrangia_json, only: json_item, json_object, json_pair, json_string
    use lagrangia_kinds, only: dp
    implicit none (type, external)
    private
    public :: final_value_t
    public :: final_values_json, final_values_legend, final_values_line

    character(*), parameter :: final_values_legend = &
        "0.48312(2): 0.48312 give or take 0.00002, by the same run at a half and a quarter of "// &
        "the"//new_line("a")//"step, or at 1e-2 and 1e-4 of the tolerance and shorter steps, "// &
        "from starts a last digit away;"//new_line("a")//"by another method at its least "// &
        "tolerance; and by the closed form where there is one"

    type :: final_value_t
        !! One number of the final state.
        character(name_length) :: name = ""
        character(16) :: unit = ""
        real(dp) :: value = 0.0_dp
        real(dp) :: error = 0.0_dp  !! vouched for
        real(dp) :: most = 0.0_dp   !! the largest magnitude in the run
    contains
        procedure :: resolved
        procedure :: text
    end type final_value_t

contains

    elemental function resolved(self)
        !! Whether any digit is left: the error is less than a tenth of the amplitude.
        class(final_value_t), intent(in) :: self
        logical :: resolved

        resolved = ieee_is_finite(self%error) .and. &
                   (self%error <= 0.0_dp .or. self%error < 0.1_dp*self%most)
    end function resolved

    pure function text(self)
        !! `0.48312(2)`, or `no digit left`.
        class(final_value_t), intent(in) :: self
        character(:), allocatable :: text

        text = "no digit left"
        if (self%resolved()) text = concise(self%value, self%error)
    end function text

    pure function final_values_line(state) result(line)
        !! `theta = 0.48312(2) rad, theta_dot = no digit left`.
        type(final_value_t), intent(in) :: state(:)  !! in the order of the line
        character(:), allocatable :: line
        integer :: i

        line = ""
        do i = 1, size(state)
            if (i > 1) line = line//", "
            line = line//trim(state(i)%name)//" = "//state(i)%text()
            if (state(i)%resolved()) line = trim(line//" "//unit_of(state(i)))
        end do
    end function final_values_line

    pure function unit_of(stated) result(unit)
        !! Its unit, if it has one.
        type(final_value_t), intent(in) :: stated
        character(:), allocatable :: unit

        unit = trim(stated%unit)
        if (unit == "1") unit = ""
    end function unit_of

    pure function final_values_json(state) result(json)
        !! `{"theta": {"value": , "error": , "text": "0.48312(2)"}}`; the text is `null` where no
        !! digit is left.
        type(final_value_t), intent(in) :: state(:)  !! in the order of the object
        character(:), allocatable :: json
        character(:), allocatable :: members, text
        integer :: i

        members = ""
        do i = 1, size(state)
            text = "null"
            if (state(i)%resolved()) text = json_string(state(i)%text())
            members = members//json_item(trim(state(i)%name), json_object( &
                json_pair("value", state(i)%value)//json_pair("error", state(i)%error)// &
                json_item("text", text)))
        end do
        json = json_object(members)
    end function final_values_json
end module lagrangia_final_values
