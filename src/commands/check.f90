module lagrangia_check
    !! `lagrangia check [SYSTEM...]`: the audit of systems and methods, a table each.
    use lagrangia_audit, only: audit_system
    use lagrangia_audited, only: audited_t, read_audited
    use lagrangia_catalogue, only: system_names
    use lagrangia_command_line, only: command_line_t
    use lagrangia_console, only: console_failed, flush_console, note, put_line
    use lagrangia_description, only: description_t, name_length
    use lagrangia_errors, only: error_t, fail, status_not_held
    use lagrangia_findings, only: audit_t, claim_length, finding_t
    use lagrangia_hyperdual, only: hyperdual_t
    use lagrangia_json, only: json_number, json_string
    use lagrangia_kinds, only: dp, i8
    use lagrangia_method_orders, only: audit_methods
    use lagrangia_names, only: refuse_name
    use lagrangia_number_text, only: scientific
    use lagrangia_progress, only: about
    use lagrangia_system, only: system_t
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: check_command

contains

    subroutine check_command(line, error)
        !! Audit the systems named, or all of them and the methods; fails if a claim does not hold.
        type(command_line_t), intent(in) :: line
        type(error_t), allocatable, intent(out) :: error
        type(audited_t), allocatable :: audited(:)
        type(audit_t) :: audit
        type(description_t) :: d
        logical :: json, methods
        integer :: i, shown

        call choose(line, audited, methods, error)
        if (allocated(error)) return
        json = line%has("json")
        shown = 0
        if (json) call put_line("[")
        call audit%begin("")
        do i = 1, size(audited)
            call audited(i)%system%describe(d)
            call put_head(trim(d%name))
            if (console_failed()) return
            call announce(audited(i)%system, audited(i)%given)
            call audit_system(audited(i)%system, audit, audited(i)%fixed, audited(i)%given)
            call put_rows()
        end do
        if (methods) then
            call put_head("methods")
            if (console_failed()) return
            call audit_methods(audit)
            call put_rows()
        end if
        if (json) then
            call put_json(audit)
        else
            call put_summary(audit)
        end if
        if (audit%broken() > 0) call fail(error, to_text(audit%broken())//" of "// &
            to_text(size(audit%findings))//" claims do not hold", status_not_held)
    contains
        subroutine put_head(name)
            !! Above the columns of a table, before it is computed: a stdout that takes nothing is
            !! noticed here.
            character(*), intent(in) :: name
            character(claim_length + 2) :: wide

            wide = name
            if (.not. json .and. shown > 0) call put_line("")
            if (.not. json) call put_line(wide//"   worst   noise   bound states")
            call flush_console()
        end subroutine put_head

        subroutine put_rows()
            !! The rows that are new.
            integer :: k

            do k = shown + 1, merge(shown, size(audit%findings), json)
                call put_row(audit%findings(k))
            end do
            shown = size(audit%findings)
        end subroutine put_rows
    end subroutine check_command

    subroutine announce(default, given)
        !! Say how long the audit of a system of many coordinates takes: as long as some 1500
        !! expansions of L, each of which evaluates it \(n(n + 1)/2 + 2n + 1\) times.
        class(system_t), intent(in) :: default
        real(dp), intent(in) :: given(:)  !! parameters
        integer, parameter :: expansions = 1500, tries = 20
        real(dp), parameter :: long = 20.0_dp  !! s; what is sooner there needs no announcement
        type(description_t) :: d
        class(system_t), allocatable :: system
        type(error_t), allocatable :: error
        type(hyperdual_t), allocatable :: q(:), v(:)
        type(hyperdual_t) :: t, l
        integer(i8) :: start, finish, rate
        real(dp) :: n, seconds
        integer :: i

        allocate (system, source=default)
        call system%configure(given, error)
        if (allocated(error)) return  ! the audit says so
        allocate (q(system%ndof), v(system%ndof))
        q%re = 0.1_dp
        v%re = 1.0_dp
        call system_clock(start, rate)
        do i = 1, tries
            l = system%lagrangian(t, q, v)
            v(1)%re = v(1)%re + 0.01_dp*sign(1.0_dp, l%re)  ! so that none can be left out
        end do
        call system_clock(finish)
        n = real(system%ndof, dp)
        seconds = expansions*(n*(n + 1)/2 + 2*n + 1)*real(finish - start, dp)/(rate*real(tries, dp))
        if (seconds < long) return
        call system%describe(d)
        call note("the audit of "//trim(d%name)//" with "//to_text(system%ndof)// &
                  " coordinates takes about "//about(seconds))
    end subroutine announce

    subroutine choose(line, audited, methods, error)
        !! The systems named, where `methods` is a name too; or everything.
        type(command_line_t), intent(in) :: line
        type(audited_t), allocatable, intent(out) :: audited(:)
        logical, intent(out) :: methods
        type(error_t), allocatable, intent(out) :: error
        character(name_length), allocatable :: names(:)
        integer :: i

        methods = size(line%arguments) == 0
        if (methods) then
            allocate (names, source=system_names())
        else
            allocate (names(size(line%arguments)))
            do i = 1, size(names)
                names(i) = line%arguments(i)%text
                if (len(line%arguments(i)%text) <= name_length) cycle
                call refuse_name("system", line%arguments(i)%text, system_names(), error)
                return
            end do
            methods = any(names == "methods")
            names = pack(names, names /= "methods")
        end if
        call read_audited(names, line%values_of("set"), audited, error)
    end subroutine choose

    subroutine put_row(row)
        !! One claim, and what there is to say about it.
        type(finding_t), intent(in) :: row

        call put_line("  "//row%claim//short(row%worst)//short(row%noise)//short(row%bound)// &
                      to_wide(row%states)//"  "//merge("holds", "FAILS", row%holds))
        if (row%remark /= "") call put_line("      "//trim(row%remark))
    end subroutine put_row

    subroutine put_summary(audit)
        !! Below all tables.
        type(audit_t), intent(in) :: audit

        call put_line("")
        call put_line(to_text(size(audit%findings))//" claims, "//to_text(audit%broken())// &
                      " do not hold")
        call put_line("worst: the residual that is largest beside its noise, relative to the "// &
                      "terms that add up; noise: what")
        call put_line("rounding or the difference formula does to it; bound: what is allowed; "// &
                      "states: random, as are parameters")
    end subroutine put_summary

    pure function short(value) result(text)
        !! Two digits, in eight columns at least.
        real(dp), intent(in) :: value
        character(:), allocatable :: text

        text = "0"
        if (abs(value) > 0.0_dp .or. .not. abs(value) <= 0.0_dp) text = scientific(value, 2)
        text = repeat(" ", max(1, 8 - len(text)))//text
    end function short

    pure function to_wide(number) result(text)
        !! In seven columns at least.
        integer, intent(in) :: number
        character(:), allocatable :: text

        text = to_text(number)
        text = repeat(" ", max(1, 7 - len(text)))//text
    end function to_wide

    subroutine put_json(audit)
        !! The rows as objects of the array that was begun, and its end.
        type(audit_t), intent(in) :: audit
        integer :: i

        do i = 1, size(audit%findings)
            call put_line(json_row(audit%findings(i))// &
                          trim(merge(",", " ", i < size(audit%findings))))
        end do
        call put_line("]")
    end subroutine put_json

    pure function json_row(row) result(json)
        !! One claim.
        type(finding_t), intent(in) :: row
        character(:), allocatable :: json

        json = '{"system": '//json_string(row%system)//', "claim": '//json_string(row%claim)// &
               ', "worst": '//json_number(row%worst)//', "noise": '//json_number(row%noise)// &
               ', "bound": '//json_number(row%bound)//', "states": '// &
               json_number(int(row%states, i8))//', "holds": '// &
               trim(merge("true ", "false", row%holds))//', "remark": '// &
               json_string(row%remark)//"}"
    end function json_row
end module lagrangia_check
