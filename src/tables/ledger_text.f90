module lagrangia_ledger_text
    !! The rows of a ledger as lines of text and as JSON objects, in three forms: residuals of an
    !! audit, statements with two sides, and measured numbers between bounds.
    use lagrangia_json, only: json_item, json_number, json_object, json_pair
    use lagrangia_kinds, only: dp
    use lagrangia_ledger, only: claim_length, claim_t
    use lagrangia_number_class, only: is_zero
    use lagrangia_number_text, only: scientific
    use lagrangia_printed_table, only: left, right, short, two_digits
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: residual_head, residual_json, residual_line
    public :: statement_head, statement_json, statement_line
    public :: allowed, measured_json, measured_line, verdict
    public :: residual_columns, residual_name, statement_columns, statement_name

    integer, parameter :: residual_width = 40
    integer, parameter :: residual_name = residual_width + 2        !! columns of the name
    integer, parameter :: residual_columns = residual_name + 38     !! of a whole line
    integer, parameter :: statement_name = claim_length             !! columns of the name
    integer, parameter :: statement_columns = statement_name + 54   !! of a whole line

contains

    pure function residual_head(system) result(line)
        !! Above the residuals of a system.
        character(*), intent(in) :: system  !! its name
        character(:), allocatable :: line

        line = left(system, residual_name)//"   worst   noise   bound states"
    end function residual_head

    pure function residual_line(row) result(line)
        !! The residual that is largest beside its noise, and how many states were tried.
        type(claim_t), intent(in) :: row  !! of the ledger
        character(:), allocatable :: line

        line = "  "//left(row%name, residual_width)//right(two_digits(row%value), 8)// &
               right(two_digits(row%noise), 8)//right(two_digits(row%most), 8)// &
               right(to_text(row%states), 7)//"  "//verdict(row)
    end function residual_line

    pure function residual_json(row) result(json)
        !! The same as an object.
        type(claim_t), intent(in) :: row  !! of the ledger
        character(:), allocatable :: json

        json = json_object(json_pair("system", row%group)//json_pair("claim", row%name)// &
                           json_pair("worst", row%value)//json_pair("noise", row%noise)// &
                           json_pair("bound", row%most)//json_pair("states", row%states)// &
                           json_pair("holds", row%holds)//json_pair("remark", row%remark))
    end function residual_json

    pure function statement_head() result(line)
        !! Above the statements of a section.
        character(:), allocatable :: line

        line = repeat(" ", claim_length + 6)//"left          right  differ   bound"
    end function statement_head

    pure function statement_line(row) result(line)
        !! Both sides, how far it is from true, and how far it may be: at most 100 columns.
        type(claim_t), intent(in) :: row  !! of the ledger
        character(:), allocatable :: line
        character(7) :: word

        if (row%as_it_must()) then
            word = merge("differs", "holds  ", row%control)
        else
            word = merge("HOLDS !", "FAILS !", row%control)
        end if
        line = row%name//nine_digits(row%left)//nine_digits(row%right)// &
               right(two_digits(row%value), 8)//right(two_digits(row%most), 8)//" "//trim(word)
    end function statement_line

    pure function nine_digits(value) result(text)
        !! A number in 15 columns: whole ones as such, others with nine digits.
        real(dp), intent(in) :: value
        character(15) :: text

        if (abs(value) < 1e6_dp .and. is_zero(value - anint(value))) then
            write (text, "(ss, i15)") nint(value)
        else if (abs(value) >= 1e-2_dp .and. abs(value) < 1e4_dp) then
            write (text, "(ss, f15.9)") value
        else
            text = scientific(value, 8)
            text = adjustr(text)
        end if
    end function nine_digits

    pure function statement_json(row) result(json)
        !! The same as an object.
        type(claim_t), intent(in) :: row  !! of the ledger
        character(:), allocatable :: json

        json = json_object(json_pair("group", row%group)//json_pair("statement", row%name)// &
                           json_pair("left", row%left)//json_pair("right", row%right)// &
                           json_pair("difference", row%value)//json_pair("bound", row%most)// &
                           json_pair("control", row%control)//json_pair("holds", row%holds))
    end function statement_json

    pure function measured_line(row, widths) result(line)
        !! What was measured of a case, the value, what is allowed, and the verdict.
        type(claim_t), intent(in) :: row  !! of the ledger
        integer, intent(in) :: widths(2)  !! of the longest case and of what is measured
        character(:), allocatable :: line

        line = trim("  "//left(row%name, widths(1) + 2)//left(row%measured, widths(2) + 2)// &
                    right(short(row%value, 4), 10)//"  "//left(allowed(row), 16)// &
                    left(verdict(row), 8)//row%remark)
    end function measured_line

    pure function measured_json(row) result(json)
        !! The same as an object; a side without a bound is null.
        type(claim_t), intent(in) :: row  !! of the ledger
        character(:), allocatable :: json

        json = json_object(json_pair("row", row%group)//json_pair("case", row%name)// &
                           json_pair("measured", row%measured)//json_pair("value", row%value)// &
                           json_item("least", bound(row%least))// &
                           json_item("most", bound(row%most))//json_pair("holds", row%holds)// &
                           json_pair("remark", row%remark))
    end function measured_json

    pure function bound(value) result(json)
        !! A number, or null.
        real(dp), intent(in) :: value
        character(:), allocatable :: json

        json = "null"
        if (abs(value) < huge(value)) json = json_number(value)
    end function bound

    pure function allowed(row) result(text)
        !! `<= 1e-13`, `>= 2`, `1.999 .. 2.001`; `-` where there is no bound.
        type(claim_t), intent(in) :: row  !! of the ledger
        character(:), allocatable :: text
        logical :: below, above

        below = row%least > -huge(1.0_dp)
        above = row%most < huge(1.0_dp)
        text = "-"
        if (below .and. above) then
            text = short(row%least, 4)//" .. "//short(row%most, 4)
            if (.not. row%least < row%most) text = "= "//short(row%least, 4)
        else if (below) then
            text = ">= "//short(row%least, 2)
        else if (above) then
            text = "<= "//short(row%most, 2)
        end if
    end function allowed

    pure function verdict(row) result(text)
        !! `holds`, `FAILS`, or `stated` where there is no bound.
        type(claim_t), intent(in) :: row  !! of the ledger
        character(:), allocatable :: text

        text = "holds"
        if (row%holds .and. .not. row%judged) text = "stated"
        if (.not. row%holds) text = "FAILS"
    end function verdict
end module lagrangia_ledger_text
