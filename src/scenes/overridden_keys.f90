module lagrangia_overridden_keys
    !! What `--set` makes meaningless among the other keys of a scene: a step where a tolerance is
    !! set, the drift of an energy that is no longer conserved, the columns of a bob that is gone.
    !! Keys that are set themselves are never touched, nor what the unchanged scene has not either.
    use lagrangia_columns, only: column_names, why_energy_changes
    use lagrangia_description, only: description_t, name_length
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_methods, only: adaptive_names, method_names
    use lagrangia_namelist, only: apply_override, drop_key, get_integer, get_real, get_string, &
                                  get_strings, has_key, is_overridden, namelist_t
    use lagrangia_system, only: system_t
    use lagrangia_text, only: lower, to_text
    implicit none (type, external)
    private
    public :: fit_columns, fit_times

    character(*), parameter :: group = "scene"
    integer, parameter :: most = 10000       !! values of one key
    integer, parameter :: panel_length = 200  !! of a text of `plot`

    type :: fit_t
        !! Columns of a scene before and after what is set.
        character(name_length), allocatable :: before(:)  !! of the system of the file alone
        character(name_length), allocatable :: now(:)     !! of the changed system
        character(:), allocatable :: gone                 !! what was left out
    contains
        procedure :: heir
        procedure :: leave_out
        procedure :: fit_expectations
        procedure :: fit_lists
        procedure :: fit_panel
        procedure :: fit_period
    end type fit_t

contains

    subroutine fit_times(tree, original, remark)
        !! A scene has steps of `dt` or a `tolerance`: where one is set, or a method that takes only
        !! a tolerance, the file's other one goes, and so do `every` and `samples`.
        type(namelist_t), intent(inout) :: tree      !! of the file, with what is set
        type(namelist_t), intent(inout) :: original  !! of the file alone
        character(:), allocatable, intent(inout) :: remark  !! grows by what was left out
        character(name_length) :: method
        character(:), allocatable :: gone
        type(error_t), allocatable :: error
        logical :: adaptive  !! a method that takes only a tolerance
        logical :: steps     !! in the file: of dt

        gone = ""
        steps = has_key(tree, group, "dt") .and. .not. is_overridden(tree, group, "dt")
        if (is_overridden(tree, group, "dt")) then
            if (has_key(tree, group, "tolerance")) then
                call drop("samples")
                call drop("tolerance")
            end if
        else if (is_overridden(tree, group, "tolerance")) then
            if (steps) call drop("every")
            call drop("dt")
        else if (steps .and. is_overridden(tree, group, "method")) then
            call get_string(tree, group, "method", method, error)
            if (.not. allocated(error)) then
                adaptive = any(adaptive_names() == method)
                if (any(method_names() == method)) adaptive = .false.
                if (adaptive) then
                    call drop("every")
                    call drop("dt")
                end if
            end if
        end if
        if (is_overridden(tree, group, "samples")) call drop("every")
        if (is_overridden(tree, group, "dt")) call fit_rows(tree, original, remark)
        if (is_overridden(tree, group, "every")) call drop("samples")
        call add_remark(remark, gone)
    contains
        subroutine drop(key)
            character(*), intent(in) :: key

            if (is_overridden(tree, group, key) .or. .not. has_key(tree, group, key)) return
            call drop_key(tree, group, key)
            if (gone /= "") gone = gone//", "
            gone = gone//key
        end subroutine drop
    end subroutine fit_times

    subroutine fit_rows(tree, original, remark)
        !! With another step the rows stay as far apart as those of the file, or nearly.
        type(namelist_t), intent(inout) :: tree, original
        character(:), allocatable, intent(inout) :: remark
        type(error_t), allocatable :: error
        real(dp) :: before, now
        integer(i8) :: every, steps

        if (is_overridden(tree, group, "every") .or. .not. has_key(tree, group, "every")) return
        now = 0.0_dp
        every = 0
        call get_real(tree, group, "dt", now, error)
        if (.not. allocated(error)) call get_integer(tree, group, "every", every, error)
        before = 0.0_dp
        if (.not. allocated(error)) call get_real(original, group, "dt", before, error)
        if (allocated(error)) return  ! it is refused when it is read
        if (.not. (now > 0.0_dp .and. before > 0.0_dp .and. every > 0)) return
        steps = nint(max(1.0_dp, min(1e15_dp, every*before/now)), i8)
        if (steps == every) return
        call apply_override(tree, group//"%every="//to_text(steps), error)
        if (steps*now > 1.5_dp*every*before) then
            remark = remark//"every = "//to_text(steps)//": a row each "//to_text(now)// &
                     " s, where the file has one each "//to_text(every*before)//" s"
        else
            remark = remark//"every = "//to_text(steps)//" leaves the rows as far apart as the "// &
                     "file's"
        end if
    end subroutine fit_rows

    subroutine fit_columns(tree, system, original, unchanged, remark, error)
        !! Columns, panels and expectations of the file that the changed system does not have: of
        !! the energy those of its balance, or back; the rest is left out.
        type(namelist_t), intent(inout) :: tree      !! of the file, with what is set
        class(system_t), intent(in) :: system        !! with its parameters
        type(namelist_t), intent(inout) :: original  !! of the file alone
        class(system_t), intent(in) :: unchanged     !! as the file alone gives it
        character(:), allocatable, intent(inout) :: remark  !! grows by what was done
        type(error_t), allocatable, intent(out) :: error    !! a list that cannot be read
        type(fit_t) :: fit

        allocate (fit%before, source=column_names(unchanged, .true.))
        allocate (fit%now, source=column_names(system, .true.))
        fit%gone = ""
        call fit%fit_lists(tree, original, "columns", "plot", error)
        if (.not. allocated(error)) call fit%fit_lists(tree, original, "event_columns", &
                                                       "event_plot", error)
        if (.not. allocated(error)) call fit%fit_expectations(tree, error)
        if (.not. allocated(error)) call fit%fit_period(tree, system, unchanged, error)
        if (allocated(error)) return
        if (unchanged%conserves_energy() .neqv. system%conserves_energy()) then
            if (remark /= "") remark = remark//"; "
            if (system%conserves_energy()) then
                remark = remark//"its energy is conserved now"
            else
                remark = remark//"its energy is no longer conserved, for "// &
                         why_energy_changes(system)
            end if
        end if
        call add_remark(remark, fit%gone)
    end subroutine fit_columns

    pure function heir(self, name) result(other)
        !! What is asked for now in the place of a column; "" if nothing is.
        class(fit_t), intent(in) :: self
        character(*), intent(in) :: name
        character(name_length) :: other

        other = name
        if (any(self%now == name) .or. .not. any(self%before == name)) return
        select case (name)
        case ("energy_drift")
            other = "energy_balance_drift"
        case ("energy_balance_drift")
            other = "energy_drift"
        case ("energy_balance")
            other = "energy"
        case default
            other = ""
        end select
        if (.not. any(self%now == other)) other = ""
    end function heir

    pure subroutine leave_out(self, name)
        !! Write down, once, that `name` is left out.
        class(fit_t), intent(inout) :: self
        character(*), intent(in) :: name

        if (index(" "//self%gone//",", " "//name//",") > 0) return
        if (self%gone /= "") self%gone = self%gone//", "
        self%gone = self%gone//name
    end subroutine leave_out

    subroutine fit_lists(self, tree, original, list, panels, error)
        !! The columns of the key `list`, and the panels of the key `panels` that show them.
        class(fit_t), intent(inout) :: self
        type(namelist_t), intent(inout) :: tree, original
        character(*), intent(in) :: list, panels
        type(error_t), allocatable, intent(out) :: error
        character(name_length), allocatable :: kept(:), names(:), shown(:), stated(:)
        character(panel_length), allocatable :: drawn(:), specs(:)
        character(panel_length) :: spec
        character(name_length) :: other
        integer :: i

        allocate (names(0), specs(0), kept(0), drawn(0))
        allocate (stated, source=self%before)
        call get_strings(original, group, list, 1, most, stated, error)
        if (.not. allocated(error)) call get_strings(tree, group, list, 1, most, names, error)
        if (allocated(error)) return
        if (is_overridden(tree, group, list)) then
            kept = names
        else
            do i = 1, size(names)
                other = self%heir(trim(names(i)))
                if (other == "") call self%leave_out(trim(names(i)))
                if (other == "" .or. (other /= names(i) .and. any(names == other))) cycle
                kept = [character(name_length) :: kept, other]
            end do
            call restate(tree, list, names, kept, error)
            if (allocated(error)) return
        end if
        if (.not. has_key(tree, group, panels) .or. is_overridden(tree, group, panels)) return
        allocate (shown, source=self%now)
        if (has_key(tree, group, list)) shown = kept
        call get_strings(tree, group, panels, 1, most, specs, error)
        if (allocated(error)) return
        do i = 1, size(specs)
            call self%fit_panel(trim(specs(i)), stated, shown, spec)
            if (spec /= "") drawn = [character(panel_length) :: drawn, spec]
        end do
        call restate(tree, panels, specs, drawn, error)
    end subroutine fit_lists

    subroutine restate(tree, key, old, new, error)
        !! Give `key` the values `new`, or none where nothing but the time is left.
        type(namelist_t), intent(inout) :: tree
        character(*), intent(in) :: key, old(:), new(:)
        type(error_t), allocatable, intent(out) :: error
        character(:), allocatable :: texts
        integer :: i

        if (size(old) == size(new)) then
            if (all(old == new)) return
        end if
        if (all(new == "t")) then
            call drop_key(tree, group, key)
            return
        end if
        texts = ""
        do i = 1, size(new)
            if (index(new(i), "'") > 0) return  ! no name of a column: it will be refused
            if (i > 1) texts = texts//", "
            texts = texts//"'"//trim(new(i))//"'"
        end do
        call apply_override(tree, group//"%"//key//"="//texts, error)
    end subroutine restate

    subroutine fit_panel(self, spec, stated, shown, fitted)
        !! `[X:]Y1[+Y2...]` with what is left of its columns; "" where nothing is.
        class(fit_t), intent(inout) :: self
        character(*), intent(in) :: spec, stated(:), shown(:)  !! columns of the file, and now
        character(panel_length), intent(out) :: fitted
        character(name_length) :: name
        integer :: colon, first, last

        fitted = ""
        colon = index(spec, ":")
        first = colon + 1
        do while (first <= len(spec))
            last = index(spec(first:)//"+", "+") + first - 2
            name = left(spec(first:last))
            if (name /= "" .and. index("+"//trim(fitted)//"+", "+"//trim(name)//"+") == 0) then
                if (fitted /= "") fitted = trim(fitted)//"+"
                fitted = trim(fitted)//name
            end if
            first = last + 2
        end do
        if (colon == 0 .or. fitted == "") return
        name = left(spec(:colon - 1))
        if (name == "") fitted = ""
        if (name /= "") fitted = trim(name)//":"//fitted
    contains
        function left(name) result(other)
            character(*), intent(in) :: name
            character(name_length) :: other

            other = self%heir(name)
            if (any(stated == name) .and. .not. any(shown == other)) other = ""
            if (other == "") call self%leave_out(name)
        end function left
    end subroutine fit_panel

    subroutine fit_expectations(self, tree, error)
        !! What is expected of columns that are no more.
        class(fit_t), intent(inout) :: self
        type(namelist_t), intent(inout) :: tree
        type(error_t), allocatable, intent(out) :: error
        character(:), allocatable :: key
        real(dp) :: limit
        integer :: i

        do i = 1, size(self%before)
            key = "expect_"//lower(trim(self%before(i)))
            if (any(self%now == self%before(i)) .or. .not. has_key(tree, group, key) .or. &
                is_overridden(tree, group, key)) cycle
            limit = 0.0_dp
            call get_real(tree, group, key, limit, error)
            if (allocated(error)) return
            call drop_key(tree, group, key)
            call self%leave_out(key)
            if (self%heir(trim(self%before(i))) == "") cycle
            key = "expect_"//lower(trim(self%heir(trim(self%before(i)))))
            if (has_key(tree, group, key)) cycle
            call apply_override(tree, group//"%"//key//"="//to_text(limit), error)
            if (allocated(error)) return
        end do
    end subroutine fit_expectations

    subroutine fit_period(self, tree, system, unchanged, error)
        !! The period of a coordinate that is no more.
        class(fit_t), intent(inout) :: self
        type(namelist_t), intent(inout) :: tree
        class(system_t), intent(in) :: system, unchanged
        type(error_t), allocatable, intent(out) :: error
        character(name_length) :: coordinate
        type(description_t) :: before, now

        if (is_overridden(tree, group, "period_of")) return
        coordinate = ""
        call get_string(tree, group, "period_of", coordinate, error)
        if (allocated(error)) return
        call unchanged%describe(before)
        call system%describe(now)
        if (.not. any(before%coordinates%name == coordinate)) return
        if (any(now%coordinates%name == coordinate)) return
        call drop_key(tree, group, "period_of")
        call self%leave_out("period_of")
    end subroutine fit_period

    pure subroutine add_remark(remark, gone)
        !! Behind what is said already: what is left out of the file's scene.
        character(:), allocatable, intent(inout) :: remark
        character(*), intent(in) :: gone

        if (gone == "") return
        if (remark /= "") remark = remark//"; "
        remark = remark//"left out of the file's scene: "//gone
    end subroutine add_remark
end module lagrangia_overridden_keys
