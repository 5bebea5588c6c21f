module lagrangia_scorecard
    !! The scorecard: a row a scene in 80 columns and, for those who name the scene, lines below it
    !! that say in words what was measured.
    use lagrangia_certain_digits, only: certain_scientific, share_of_last
    use lagrangia_characters, only: printable
    use lagrangia_counted, only: counted
    use lagrangia_kinds, only: dp
    use lagrangia_ledger, only: claim_t
    use lagrangia_number_text, only: fixed, scientific
    use lagrangia_outcome, only: from_steps, outcome_t, within
    use lagrangia_printed_table, only: left, short, two_digits
    use lagrangia_text, only: append_word, to_text, word_t
    use lagrangia_wrapping, only: wrapped
    implicit none (type, external)
    private
    public :: missed_text, scorecard_head, scorecard_legend, scorecard_lines, scorecard_row
    public :: scorecard_width

    integer, parameter :: scorecard_width = 80  !! columns of a terminal
    integer, parameter :: method_column = 25    !! behind a scene's name
    character(*), parameter :: lf = new_line("a")
    character(*), parameter :: scorecard_legend = &
        "method   of the steps; exact: none, but the closed form of the motion"//lf// &
        "drift    of the invariant that changed most: its largest change in the rows,"//lf// &
        "         relative to its start or natural size; a hyphen: none is asked for"//lf// &
        "error    the largest of a coordinate in the rows, not of a velocity, absolute"//lf// &
        "         below 1 and relative above; exact: against the closed form; estimate:"//lf// &
        "         against the same run at half the step or a hundredth of the tolerance,"//lf// &
        "         and against another method; steps: the closed form against gauss16's"//lf// &
        "verdict  holds: within what the scene expects, expect_energy_drift and the like;"//lf// &
        "         a hyphen: nothing is expected of it"//lf

contains

    pure function missed_text(missed, scenes) result(text)
        !! `1 of 51 scenes did not hold its tolerances`.
        integer, intent(in) :: missed, scenes  !! how many, at least 1; of how many
        character(:), allocatable :: text

        text = to_text(missed)//" of "//counted(scenes, "scene")//" did not hold "
        if (missed == 1) then
            text = text//"its tolerances"
        else
            text = text//"their tolerances"
        end if
    end function missed_text

    function scorecard_head() result(line)
        !! The titles over the rows.
        character(:), allocatable :: line

        line = cells("scene", "method", "drift", "error", "verdict")
    end function scorecard_head

    function scorecard_row(self) result(line)
        !! One line a scene; what a verdict `NOT` means stands below it.
        type(outcome_t), intent(in) :: self  !! of a run that has ended
        character(:), allocatable :: line
        character(:), allocatable :: drift, error, verdict
        logical :: moved  ! beyond the start, where nothing has changed yet
        integer :: k

        moved = self%rows > 1 .or. .not. allocated(self%failure)
        drift = "-"
        if (size(self%drifts) > 0 .and. moved) then
            k = maxloc(self%drifts%value, 1)
            drift = two_digits(self%drifts(k)%value)//" "//quantity_of(self%drifts(k))
        end if
        error = "-"
        if (moved .and. .not. self%error() < 0.0_dp) then
            error = two_digits(self%error())//" "//self%error_source()
        end if
        verdict = self%verdict()
        if (index(verdict, "NOT ") == 1) verdict = "NOT"
        if (verdict == "not judged") verdict = "-"
        line = cells(printable(self%scene), self%method, drift, error, verdict)
    end function scorecard_row

    subroutine scorecard_lines(self, all, lines)
        !! What stands below a row: what did not hold, and with `all` what was measured besides.
        type(outcome_t), intent(in) :: self             !! of a run that has ended
        logical, intent(in) :: all                      !! steps, period and frequency too
        type(word_t), allocatable, intent(out) :: lines(:)  !! indented, in 80 columns
        integer :: i

        allocate (lines(0))
        if (index(self%verdict(), "NOT ") == 1) then
            do i = 1, size(self%drifts)
                call judge(self%drifts(i))
            end do
            do i = 1, size(self%others)
                call judge(self%others(i))
            end do
        end if
        if (.not. all) return
        if (allocated(self%title)) call add(printable(self%title))
        if (allocated(self%changes)) then
            call add("changed by --set: what the file expects is of the unchanged scene and "// &
                     "does not judge this one; data file: "//printable(self%file))
        end if
        if (self%steps > 0) then
            call add(counted(self%steps, "step")//", "//counted(self%evaluations, &
                     "evaluation")//" of the accelerations, "//fixed(self%seconds, 4)//" s")
        else if (.not. allocated(self%failure)) then
            call add("no steps: the motion by its closed form, "//fixed(self%seconds, 4)//" s")
            if (self%error_from == from_steps .and. self%error() < 0.0_dp) call add("the error "// &
                "is not known: gauss16 would take more than 10^7 steps")
        end if
        call add_rounding()
        if (self%period <= 0.0_dp .and. self%intervals(2) > 0.0_dp) call add("no period: from "// &
            "one lower turning point to the next it is "//short(self%intervals(1), 4)//" to "// &
            short(self%intervals(2), 4)//" s")
        if (self%period > 0.0_dp) then
            call add_number("period", self%period, "s", "measured"//agreement())
            if (self%exact_period > 0.0_dp) call add_number("", self%exact_period, "s", &
                "exact; they differ by "//difference("period"))
            if (self%small_period > 0.0_dp) call add_number("", self%small_period, "s", &
                "2 pi/omega of small swings; off by "//difference("small_period"))
        end if
        if (self%omega > 0.0_dp) then
            call add_number("omega", self%omega, "rad/s", "the slowest small oscillation"// &
                            trim(merge(" without forces beside L", repeat(" ", 24), &
                                       self%undamped))//", by LAPACK", self%omega_share)
            if (allocated(self%omega_formula)) call add(self%omega_formula, 12)
            if (self%omega_error >= 0.0_dp) call add("all frequencies: LAPACK and closed forms "// &
                "differ by at most "//short(self%omega_error, 2), 12)
        else if (allocated(self%no_omega)) then
            call add("no frequencies: "//self%no_omega)
        end if
    contains
        subroutine judge(measure)
            type(claim_t), intent(in) :: measure

            if (within(measure)) return
            call add("NOT as expected: "//trim(measure%name)//" is "// &
                     two_digits(measure%value)//", expect_"//trim(measure%name)//" = "// &
                     to_text(measure%most))
        end subroutine judge

        subroutine add_rounding()
            ! An energy that changed by more than itself, where its terms have swallowed it.
            integer :: k

            do k = 1, size(self%drifts)
                if (self%drifts(k)%name == "energy_drift") exit
            end do
            if (k > size(self%drifts)) return
            if (self%drifts(k)%value < 1.0_dp .or. &
                epsilon(1.0_dp)*self%energy_terms < 0.01_dp*self%drifts(k)%value) return
            if (.not. self%energy_terms <= huge(1.0_dp)) then  ! NaN, too
                call add("the terms of the energy have grown beyond what a double holds: their "// &
                         "drift says nothing about the motion")
                return
            end if
            call add("the terms of the energy have grown to "//two_digits(self%energy_terms)// &
                     " times what its drift is relative to, and a double keeps 16 digits of "// &
                     "them: that drift is their rounding and says nothing about the motion")
        end subroutine add_rounding

        subroutine add_number(name, value, unit, meaning, share)
            character(*), intent(in) :: name, unit, meaning
            real(dp), intent(in) :: value
            real(dp), intent(in), optional :: share  ! of it that rounding may have changed
            character(:), allocatable :: text

            text = number(value)
            if (present(share)) then
                if (share > share_of_last) text = certain_scientific(value, share, 11)
            end if
            call append_word(lines, left("    "//name, 12)//left(text//" "//unit, 20)//meaning)
        end subroutine add_number

        function agreement() result(text)
            ! Of the intervals that the period is the mean of, where it is worth a word.
            character(:), allocatable :: text
            real(dp) :: spread

            text = ""
            if (self%intervals(2) <= 0.0_dp) return
            spread = 1.0_dp - self%intervals(1)/self%intervals(2)
            if (self%turns == 2) text = ", of one interval"
            if (spread > 1e-6_dp) text = "; its intervals differ by "//short(spread, 2)//" of it"
        end function agreement

        function difference(name) result(text)
            character(*), intent(in) :: name
            character(:), allocatable :: text
            integer :: k

            text = "?"
            do k = 1, size(self%others)
                if (self%others(k)%name == name) text = short(self%others(k)%value, 2)//" of it"
            end do
        end function difference

        subroutine add(text, indentation)
            character(*), intent(in) :: text
            integer, intent(in), optional :: indentation
            type(word_t), allocatable :: more(:)
            integer :: blanks, k

            blanks = 4
            if (present(indentation)) blanks = indentation
            call wrapped(text, scorecard_width - blanks - 4, more)
            do k = 1, size(more)
                call append_word(lines, repeat(" ", merge(blanks, blanks + 4, k == 1))// &
                                 more(k)%text)
            end do
        end subroutine add
    end subroutine scorecard_lines

    pure function quantity_of(measure) result(name)
        !! `energy` of `energy_drift`.
        type(claim_t), intent(in) :: measure
        character(:), allocatable :: name

        name = measure%name(:index(measure%name, "_drift") - 1)
    end function quantity_of

    pure function number(value) result(text)
        !! Ten digits behind the point, where the number is of a handy size.
        real(dp), intent(in) :: value
        character(:), allocatable :: text

        if (value >= 0.01_dp .and. value < 1e6_dp) then
            text = fixed(value, 10)
        else
            text = scientific(value, 11)
        end if
    end function number

    function cells(scene, method, drift, error, verdict) result(line)
        !! The row's columns; a long word takes of the room behind it, and a long name of a scene
        !! has a line of its own.
        character(*), intent(in) :: scene, method, drift, error, verdict
        character(:), allocatable :: line

        line = ""
        if (len(scene) < method_column) call put(scene, 0)
        call put(method, method_column)
        call put(drift, 34)
        call put(error, 56)
        call put(verdict, 73)
        if (len(scene) >= method_column) line = scene//lf//line
    contains
        subroutine put(word, column)
            character(*), intent(in) :: word
            integer, intent(in) :: column

            if (column > 0) line = line//" "
            line = line//repeat(" ", max(0, column - len(line)))//word
        end subroutine put
    end function cells
end module lagrangia_scorecard
