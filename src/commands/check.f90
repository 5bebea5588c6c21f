module lagrangia_check
    !! `lagrangia check [SYSTEM...]`: the audit of systems, also those of scenes, and of methods, a
    !! table each.
    use lagrangia_audit, only: audit_system
    use lagrangia_catalogue, only: new_system, system_names
    use lagrangia_command_line, only: command_line_t, word_t
    use lagrangia_console, only: console_failed, flush_console, note, put_line, put_row, &
        rewrites_lines
    use lagrangia_counted, only: counted
    use lagrangia_description, only: described_by, description_t, name_length, value_names
    use lagrangia_errors, only: error_t, fail, status_not_held
    use lagrangia_hyperdual, only: hyperdual_t
    use lagrangia_json, only: json_line
    use lagrangia_kinds, only: dp, i8
    use lagrangia_ledger, only: group_length, ledger_t
    use lagrangia_ledger_text, only: residual_columns, residual_head, residual_json, &
        residual_line, residual_name
    use lagrangia_method_orders, only: audit_methods
    use lagrangia_namelist, only: apply_override, get_reals, has_key, namelist_t, &
                                  parse_namelist, refuse_unknown_groups, refuse_unknown_keys, &
                                  refuse_value
    use lagrangia_names, only: refuse_name
    use lagrangia_part, only: part_t
    use lagrangia_progress, only: about, part_label, progress_t
    use lagrangia_scene_reader, only: names_scene, read_named_system
    use lagrangia_system, only: check_parameter, default_values, system_t
    use lagrangia_text, only: lower, quoted, short_source, shortened, source_length, to_text
    implicit none (type, external)
    private
    public :: check_command

    type :: audited_t
        !! A system, and which of its parameters were given.
        class(system_t), allocatable :: system
        character(name_length) :: name = ""      !! the system's
        character(source_length) :: scene = ""   !! that has the system; empty without one
        character(group_length) :: label = ""    !! the name, with the scene where names recur
        logical, allocatable :: fixed(:)
        real(dp), allocatable :: given(:)  !! all values, defaults where none was given
    end type audited_t

contains

    subroutine check_command(line, error)
        !! Audit the systems named, or all of them and the methods; fails if a claim does not hold.
        type(command_line_t), intent(in) :: line  !! what was typed
        type(error_t), allocatable, intent(out) :: error  !! allocated where it fails
        type(audited_t), allocatable :: audited(:)
        type(ledger_t) :: audit
        type(progress_t), target :: progress
        type(part_t) :: part
        logical :: json, methods, quiet
        integer :: i, shown

        call choose(line, audited, methods, error)
        if (allocated(error) .or. .not. allocated(audited)) return
        json = line%has("json")
        quiet = line%has("quiet")
        shown = 0
        if (json) call put_line("[")
        call audit%section("")
        if (rewrites_lines()) part%whole => progress  ! else `announce` has said it
        do i = 1, size(audited)
            associate (one => audited(i))
                call put_head(shortened(trim(one%label), residual_name - 1))
                if (console_failed()) return
                if (.not. quiet) call announce(one%system, one%given)
                call begin_part(trim(one%label), i)
                call audit_system(one%system, audit, one%fixed, one%given, part, trim(one%label))
            end associate
            call put_rows()
        end do
        if (methods) then
            call put_head("methods")
            if (console_failed()) return
            call begin_part("methods", size(audited) + 1)
            call audit_methods(audit)
            call put_rows()
        end if
        if (json) then
            do i = 1, size(audit%rows)
                call put_line(json_line(residual_json(audit%rows(i)), i < size(audit%rows)))
            end do
            call put_line("]")
        else if (.not. quiet) then
            call put_summary(audit)
        end if
        if (audit%broken() > 0) call fail(error, to_text(audit%broken())//" of "// &
            counted(size(audit%rows), "claim")//not_holding(audit%broken()), &
            status_not_held)
    contains
        subroutine put_head(name)
            !! Above the columns of a table, before it is computed: a stdout that takes nothing is
            !! noticed here.
            character(*), intent(in) :: name

            if (.not. (json .or. quiet)) then
                if (shown > 0) call put_line("")
                call put_row(residual_head(name), residual_name, residual_columns)
            end if
            call flush_console()
        end subroutine put_head

        subroutine begin_part(name, number)
            !! Say on a terminal what is audited now.
            character(*), intent(in) :: name
            integer, intent(in) :: number
            character(:), allocatable :: now

            now = part_label("check", name, number, size(audited) + merge(1, 0, methods))
            call progress%restart(now, quiet)
            if (.not. quiet) call progress%say(now)
        end subroutine begin_part

        subroutine put_rows()
            !! The rows that are new.
            integer :: k

            call progress%clear()
            do k = shown + 1, merge(shown, size(audit%rows), json .or. quiet)
                call put_row(residual_line(audit%rows(k)), residual_name, residual_columns)
                if (audit%rows(k)%remark /= "") call put_line("      "//trim(audit%rows(k)%remark))
            end do
            shown = size(audit%rows)
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
        !! The systems named, where `methods` is a name too, then those of scenes; or everything.
        type(command_line_t), intent(in) :: line
        type(audited_t), allocatable, intent(out) :: audited(:)
        logical, intent(out) :: methods
        type(error_t), allocatable, intent(out) :: error
        character(name_length), allocatable :: names(:)
        type(audited_t), allocatable :: named(:)
        logical, allocatable :: is_scene(:)
        integer :: i, k

        allocate (is_scene(size(line%arguments)))
        do i = 1, size(is_scene)
            do k = 1, i - 1
                if (line%arguments(k)%text /= line%arguments(i)%text) cycle
                call fail(error, quoted(line%arguments(i)%text)//" is given twice")
                return
            end do
            is_scene(i) = names_scene(line%arguments(i)%text) &
                          .and. line%arguments(i)%text /= "methods"
        end do
        methods = size(line%arguments) == 0
        if (methods) then
            allocate (names, source=system_names())
        else
            allocate (names(size(line%arguments)))
            do i = 1, size(names)
                names(i) = line%arguments(i)%text
                if (len(line%arguments(i)%text) <= name_length .or. is_scene(i)) cycle
                call refuse_name("system", line%arguments(i)%text, system_names(), error)
                return
            end do
            methods = any(names == "methods")
            names = pack(names, names /= "methods" .and. .not. is_scene)
        end if
        if (line%has("set") .and. merge(size(is_scene) > 1, size(names) == 0, any(is_scene))) then
            call fail(error, "--set goes with one scene, or with systems by their names")
            return
        end if
        call read_audited(names, line%values_of("set"), named, error)
        if (allocated(error)) return
        allocate (audited(size(named) + count(is_scene)))
        do i = 1, size(named)
            audited(i) = named(i)
        end do
        k = size(named)
        do i = 1, size(is_scene)
            if (.not. is_scene(i)) cycle
            k = k + 1
            call read_scene_system(line%arguments(i)%text, line%values_of("set"), audited(k), error)
            if (allocated(error)) return
        end do
        call set_labels(audited)
        do i = 1, size(audited)
            call check_sizes(audited(i), error)
            if (allocated(error)) return
        end do
    end subroutine choose

    subroutine check_sizes(audited, error)
        !! Fourth powers of parameters are to be finite, and not zero: the claims are judged by the
        !! sizes of terms and of their changes.
        type(audited_t), intent(in) :: audited
        type(error_t), allocatable, intent(out) :: error
        real(dp), parameter :: largest = 1e75_dp
        type(description_t) :: d
        character(name_length), allocatable :: names(:)
        integer :: i

        call audited%system%describe(d)
        allocate (names, source=value_names(d))
        do i = 1, size(names)
            associate (x => abs(audited%given(i)))
                if (.not. (x > largest .or. (x > 0.0_dp .and. x < 1.0_dp/largest))) cycle
            end associate
            call fail(error, trim(audited%label)//": "//trim(names(i))//" = "// &
                      to_text(audited%given(i))//": 'check' takes 0 and sizes from 1e-75 to "// &
                      "1e75, of which fourth powers are still doubles; choose other units")
            return
        end do
    end subroutine check_sizes

    subroutine set_labels(audited)
        !! The names of the systems; of those whose name another one has, too, with the scene.
        type(audited_t), intent(inout) :: audited(:)
        integer :: i

        do i = 1, size(audited)
            associate (one => audited(i))
                one%label = one%name
                if (one%scene == "" .or. count(audited%name == one%name) == 1) cycle
                one%label = shortened(trim(one%name)//" ("//trim(one%scene)//")", group_length)
            end associate
        end do
    end subroutine set_labels

    subroutine read_scene_system(name, words, audited, error)
        !! The system of a scene, with all its parameters as the scene has them.
        character(*), intent(in) :: name
        type(word_t), intent(in) :: words(:)  !! `GROUP%KEY=VALUE`
        type(audited_t), intent(inout) :: audited
        type(error_t), allocatable, intent(out) :: error
        type(description_t) :: d

        call read_named_system(name, words, audited%system, error)
        if (allocated(error)) return
        call audited%system%describe(d)
        audited%name = d%name
        audited%scene = short_source(name)
        allocate (audited%given, source=default_values(d))
        allocate (audited%fixed(size(audited%given)))
        audited%fixed = .true.
    end subroutine read_scene_system

    pure function not_holding(number) result(text)
        !! The verb.
        integer, intent(in) :: number  !! of claims
        character(:), allocatable :: text

        text = " do not hold"
        if (number == 1) text = " does not hold"
    end function not_holding

    subroutine put_summary(audit)
        !! Below all tables.
        type(ledger_t), intent(in) :: audit

        call put_line("")
        call put_line(counted(size(audit%rows), "claim")//", "// &
                      to_text(audit%broken())//not_holding(audit%broken()))
        call put_line("worst: the residual that is largest beside its noise, relative to the "// &
                      "terms that add up; noise: what")
        call put_line("rounding or the difference formula does to it; bound: what is allowed; "// &
                      "states: random, as are parameters")
    end subroutine put_summary

    subroutine read_audited(names, words, audited, error)
        !! Fails on unknown systems, on groups and keys that are not theirs, and on values that
        !! are not allowed.
        character(*), intent(in) :: names(:)
        type(word_t), intent(in) :: words(:)  !! `GROUP%KEY=VALUE`
        type(audited_t), allocatable, intent(out) :: audited(:)
        type(error_t), allocatable, intent(out) :: error
        type(namelist_t) :: tree
        type(description_t) :: d
        integer :: first  ! that has parameters, so that its group will be asked for
        integer :: i

        first = size(names) + 1
        allocate (audited(size(names)))
        do i = 1, size(names)
            call new_system(trim(names(i)), audited(i)%system, error)
            if (allocated(error)) return
            call audited(i)%system%describe(d)
            if (size(d%parameters) > 0) first = min(first, i)
        end do
        if (size(names) == 0) return
        if (first <= size(names) .or. size(words) > 0) then
            call parse_namelist("&"//trim(names(min(first, size(names))))//" /", "check", tree, &
                                error)
        end if
        if (allocated(error)) return
        do i = 1, size(words)
            call apply_override(tree, words(i)%text, error)
            if (allocated(error)) return
        end do
        do i = 1, size(names)
            call read_parameters(tree, audited(i), error)
            if (allocated(error)) return
        end do
        call refuse_unknown_groups(tree, names, error)
    end subroutine read_audited

    subroutine read_parameters(tree, audited, error)
        !! Those of one system.
        type(namelist_t), intent(inout) :: tree
        type(audited_t), intent(inout) :: audited
        type(error_t), allocatable, intent(out) :: error
        type(description_t) :: d
        type(error_t), allocatable :: refusal
        character(name_length), allocatable :: keys(:)
        real(dp), allocatable :: values(:)
        logical :: found
        integer :: i, first

        call audited%system%describe(d)
        audited%name = d%name
        allocate (audited%given, source=default_values(d))
        allocate (audited%fixed(size(audited%given)))
        audited%fixed = .false.
        allocate (keys(size(d%parameters)))
        first = 1
        do i = 1, size(d%parameters)
            associate (p => d%parameters(i), last => first + d%parameters(i)%count - 1)
                allocate (values, source=p%value(:p%count))
                keys(i) = lower(p%name)
                call get_reals(tree, trim(d%name), trim(keys(i)), p%count, p%count, values, error)
                found = has_key(tree, trim(d%name), trim(keys(i)))
                if (allocated(error)) return
                audited%given(first:last) = values
                audited%fixed(first:last) = found
                p%value(:p%count) = values
                call check_parameter(p, refusal)
                if (found .and. allocated(refusal)) then
                    call refuse_value(tree, trim(d%name), trim(keys(i)), &
                                      p%domain()//" is needed", error)
                    return
                end if
            end associate
            deallocate (values)
            first = first + d%parameters(i)%count
        end do
        call refuse_unknown_keys(tree, trim(d%name), keys, error, &
                                 shown_by=described_by(d))
    end subroutine read_parameters
end module lagrangia_check
