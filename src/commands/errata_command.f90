module lagrangia_errata_command
    !! `lagrangia errata [ID]`: the slips in the lecture notes, and what each would do, in numbers.
    use lagrangia_command_line, only: command_line_t
    use lagrangia_console, only: put_line
    use lagrangia_errata, only: slip_numbers
    use lagrangia_errata_formulas, only: add_both_sides
    use lagrangia_errata_ledger, only: kind_lecture, kind_none, kind_scan, kind_terminology, &
                                       quote_t, slip_t, slips_of_the_notes
    use lagrangia_errors, only: error_t, fail, status_not_held
    use lagrangia_json, only: json_array, json_element, json_item, json_line, json_object, &
                              json_pair
    use lagrangia_principle, only: put_json, put_report
    use lagrangia_principles, only: principle_report
    use lagrangia_report, only: report_t
    use lagrangia_text, only: quoted, to_text
    implicit none (type, external)
    private
    public :: errata_command, slip_report

    type :: part_t
        character(11) :: kind = ""
        character(90) :: heading = ""
    end type part_t

    type(part_t), parameter :: parts(*) = [ &
        part_t(kind_lecture, "slips of the lecture"), &
        part_t(kind_scan, "errors of the scan: letters, dots and factors that the scanner lost"), &
        part_t(kind_terminology, "terminology: right, and called otherwise elsewhere"), &
        part_t(kind_none, "no slip, although it was taken for one")]

contains

    subroutine errata_command(line, error)
        !! One slip and its numbers; without an identifier a list of all, each computed.
        type(command_line_t), intent(in) :: line  !! what was typed
        type(error_t), allocatable, intent(out) :: error  !! allocated where it fails
        type(slip_t), allocatable :: slips(:)
        type(report_t) :: report
        character(:), allocatable :: id
        integer :: k

        allocate (slips, source=slips_of_the_notes())
        if (size(line%arguments) == 0) then
            call put_all(slips, line%has("json"), error)
            return
        end if
        id = line%arguments(1)%text
        if (scan(id(:min(1, len(id))), "0123456789") == 1) id = "E"//id
        if (index(id, "e") == 1) id(1:1) = "E"
        do k = 1, size(slips)
            if (slips(k)%id == id) exit
        end do
        if (k > size(slips)) then
            call fail(error, "unknown slip "//quoted(line%arguments(1)%text)//"; there are "// &
                      trim(slips(1)%id)//" to "//trim(slips(size(slips))%id))
            return
        end if
        call slip_report(slips(k), report, error)
        if (allocated(error)) return
        if (line%has("json")) then
            call put_json(report)
        else
            call put_slip(slips(k), report)
        end if
        if (report%broken() > 0) call fail(error, to_text(report%broken())//" of "// &
            to_text(size(report%rows))//" numbers do not come out", status_not_held)
    end subroutine errata_command

    subroutine slip_report(slip, report, error)
        !! The numbers of a slip; of a slip of principle, those rows of the principle's report.
        type(slip_t), intent(in) :: slip  !! of the ledger
        type(report_t), intent(out) :: report  !! the result
        type(error_t), allocatable, intent(out) :: error  !! allocated where it fails
        type(report_t) :: whole

        call report%begin("")
        if (slip%principle == "") then
            call slip_numbers(slip%id, report, error)
        else
            call principle_report(trim(slip%principle), whole, error)
            if (.not. allocated(error)) then
                report%rows = pack(whole%rows, whole%rows%slip == slip%id)
            end if
        end if
        if (.not. allocated(error)) call add_both_sides(slip, report, error)
    end subroutine slip_report

    subroutine put_slip(slip, report)
        !! The whole story.
        type(slip_t), intent(in) :: slip
        type(report_t), intent(in) :: report

        integer :: k

        call put_line(trim(slip%id)//": "//trim(slip%subject))
        call put_line("kind        "//trim(heading_of(slip%kind)))
        call put_line("place       "//place_text(slip))
        do k = 1, count(slip%quotes%scan /= "")
            call put_line("as it is    "//in_full(slip%quotes(k)))
        end do
        call put_line("reads       "//trim(slip%reads))
        call put_line("as derived  "//trim(slip%derived))
        if (slip%elsewhere%scan /= "") call put_line("right at    "//in_full(slip%elsewhere))
        if (slip%effect /= "") call put_line("effect      "//trim(slip%effect))
        if (size(report%rows) == 0) then
            call put_line("numbers     none: it is a matter of letters or of history")
            return
        end if
        call put_line("")
        call put_report(report, "")
        if (slip%principle /= "") call put_line("more: lagrangia principle "//trim(slip%principle))
    end subroutine put_slip

    pure function heading_of(kind) result(heading)
        !! What a kind of slip is.
        character(*), intent(in) :: kind
        character(len(parts%heading)) :: heading

        heading = parts(findloc(parts%kind == kind, .true., 1))%heading
    end function heading_of

    pure function in_full(quote) result(text)
        !! `I, 142: m_2 l ...`.
        type(quote_t), intent(in) :: quote
        character(:), allocatable :: text

        text = trim(quote%scan)//", "//to_text(quote%line)//": "//trim(quote%text)
    end function in_full

    pure function place_text(slip) result(text)
        !! Where in the notes.
        type(slip_t), intent(in) :: slip
        character(:), allocatable :: text

        text = slip%place()
        text = text(index(text, ","):)//" of the scan's text"
        if (slip%quotes(1)%scan == "II") then
            text = "Hamilton's Principle"//text
        else
            text = "Phys 601, 1 September 2011"//text
        end if
    end function place_text

    subroutine put_all(slips, json, error)
        !! Part by part, three lines a slip; the numbers of each are computed, and must come out.
        type(slip_t), intent(in) :: slips(:)
        logical, intent(in) :: json
        type(error_t), allocatable, intent(out) :: error
        type(report_t) :: report
        integer :: k, part, misses, left

        misses = 0
        left = size(slips)
        if (json) call put_line("[")
        do part = 1, size(parts)
            if (.not. json) call put_line(trim(parts(part)%heading)//": "// &
                                          to_text(count(slips%kind == parts(part)%kind)))
            do k = 1, size(slips)
                if (slips(k)%kind /= parts(part)%kind) cycle
                call slip_report(slips(k), report, error)
                if (allocated(error)) return
                misses = misses + report%broken()
                left = left - 1
                if (json) then
                    call put_line(json_line(object(slips(k), verdict_on(report)), left > 0))
                else
                    call put_line("  "//slips(k)%id//"  "//trim(slips(k)%subject)//" ("// &
                                  slips(k)%place()//"): "//verdict_on(report))
                    call put_line("       as it is  "//trim(slips(k)%quotes(1)%text))
                    call put_line("       reads     "//trim(slips(k)%reads))
                    call put_line("       derived   "//trim(slips(k)%derived))
                end if
            end do
        end do
        if (json) then
            call put_line("]")
        else
            call put_line("Places: I is 1 September 2011, II is Hamilton's Principle, lines of "// &
                          "the scan's text, quoted as it is.")
            call put_line("'lagrangia errata E1' shows one in numbers.")
        end if
        if (misses > 0) call fail(error, to_text(misses)//" numbers do not come out", &
                                  status_not_held)
    end subroutine put_all

    pure function verdict_on(report) result(verdict)
        !! Whether there are numbers, and whether they come out.
        type(report_t), intent(in) :: report
        character(:), allocatable :: verdict

        verdict = "shown"
        if (size(report%rows) == 0) verdict = "listed"
        if (report%broken() > 0) verdict = "NOT SO!"
    end function verdict_on

    pure function object(slip, verdict) result(json)
        !! One slip.
        type(slip_t), intent(in) :: slip
        character(*), intent(in) :: verdict
        character(:), allocatable :: json, quotes, elsewhere
        integer :: k

        quotes = ""
        do k = 1, count(slip%quotes%scan /= "")
            quotes = quotes//json_element(quote(slip%quotes(k)))
        end do
        elsewhere = "null"
        if (slip%elsewhere%scan /= "") elsewhere = quote(slip%elsewhere)
        json = json_object(json_pair("id", slip%id)//json_pair("kind", slip%kind)// &
                           json_pair("subject", slip%subject)// &
                           json_pair("place", place_text(slip))// &
                           json_item("quotes", json_array(quotes))// &
                           json_pair("reads", slip%reads)//json_pair("derived", slip%derived)// &
                           json_item("elsewhere", elsewhere)//json_pair("effect", slip%effect)// &
                           json_pair("numbers", verdict))
    contains
        pure function quote(item) result(part)
            type(quote_t), intent(in) :: item
            character(:), allocatable :: part

            part = json_object(json_pair("scan", item%scan)//json_pair("line", item%line)// &
                               json_pair("text", item%text))
        end function quote
    end function object
end module lagrangia_errata_command
