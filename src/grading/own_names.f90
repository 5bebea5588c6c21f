module lagrangia_own_names
    !! Names that a student gives: what they stand for, and whether that is what everybody means by
    !! them.
    use lagrangia_canonical_form, only: simplified
    use lagrangia_declared_constants, only: with_constants
    use lagrangia_errors, only: error_t
    use lagrangia_expression, only: apply, expression_t, f_sqrt
    use lagrangia_formula_parser, only: parse_formula
    use lagrangia_judged_equality, only: judge_forms, put_unreadable
    use lagrangia_rounded_numbers, only: put_exact_number
    use lagrangia_sample_names, only: role_coordinate, role_parameter, role_velocity, &
                                      samples_t
    use lagrangia_slope_at_momentum, only: most_cyclic, slope_at_momentum
    use lagrangia_statement_forms, only: define_by_period, define_rates, find_frequency, &
                                         has_velocities, means_frequency
    use lagrangia_term_search, only: library_t
    use lagrangia_usual_meanings, only: energy_name
    use lagrangia_usual_names, only: find_usual
    use lagrangia_verdict, only: as_new_name, is_definition, is_right, is_wrong, judgement_t
    use lagrangia_written_out, only: energy_formulas
    implicit none (type, external)
    private
    public :: define

contains

    subroutine define(name, squared, formula, text, used, samples, library, judgement)
        !! A name of the student's own, or the square of one; right if it is what is mostly called
        !! that. A name that must be a frequency, is none and abbreviates nothing is wrong.
        character(*), intent(in) :: name     !! new
        logical, intent(in) :: squared       !! `v^2 = ...`
        character(*), intent(in) :: formula  !! what it stands for, in its column
        character(*), intent(in) :: text     !! both sides, as typed
        logical, intent(in) :: used          !! another statement has the name
        type(samples_t), intent(inout) :: samples          !! get the name
        type(library_t), intent(in) :: library(:)          !! right terms
        type(judgement_t), intent(inout) :: judgement      !! of the statement
        type(expression_t) :: meaning, truth
        type(judgement_t) :: attempt
        type(error_t), allocatable :: error

        judgement%verdict = is_definition
        judgement%defines = name
        call parse_formula(formula, with_constants(samples), meaning, error)
        if (.not. allocated(error)) then
            call define_by_period(meaning, samples)
            if (squared) meaning = apply(f_sqrt, meaning)
            call find_frequency(name, meaning, samples, truth)
            if (truth%count == 0) call find_energy(name, meaning, samples, truth)
            if (truth%count > 0) then
                attempt%remark = ""
                attempt%example = ""
                call judge_forms(truth, meaning, text, .true., .false., samples, library, .true., &
                                 attempt)
                ! of a rounded number the name goes on with all digits
                if (attempt%verdict == is_right) call put_exact_number(truth, text, samples, &
                                                                       meaning)
            end if
            call samples%symbols%define(name, meaning, error)
        end if
        if (allocated(error)) then
            call put_unreadable(error, samples, judgement)
            return
        end if
        call define_rates(name, meaning, samples)
        if (name == "V_eff" .or. name == "U_eff") call define_slopes(name, meaning, samples)
        call compare_usual(name, meaning, text, samples, judgement)
        if (name == "T" .or. name == "V") judgement%remark = as_new_name// &
            "of this system only L is known"
        if (judgement%verdict == is_right .or. truth%count == 0) return
        attempt%defines = name
        attempt%contradicts = judgement%contradicts
        if (attempt%verdict == is_right) then
            judgement = attempt
            judgement%contradicts = .false.
            judgement%of_oscillation = .true.
        end if
        if (attempt%verdict /= is_wrong) return
        if (name == energy_name) then
            judgement = attempt
        else if (name == "period" .or. means_frequency(name, samples) .and. &
                 (.not. used .or. meaning%count == 1)) then
            judgement = attempt
            if (attempt%is_unexplained) judgement%remark = "no small oscillation has this "// &
                trim(merge("period   ", "frequency", name == "period"))//"; see 'lagrangia modes'"
        else if (samples%decay == 0 .and. scan(name, "0") == 0 .and. scan(name, "wt") /= 1) then
            judgement%of_none = .true.
            judgement%remark = as_new_name//"no small oscillation has this "// &
                trim(merge("period   ", "frequency", name(1:1) == "T"))
        end if
    end subroutine define

    pure subroutine find_energy(name, meaning, samples, truth)
        !! h, where it is the energy function, and moves: a height may have that name, too.
        character(*), intent(in) :: name              !! a new one
        type(expression_t), intent(in) :: meaning     !! of it
        type(samples_t), intent(in) :: samples        !! know the usual names
        type(expression_t), intent(out) :: truth      !! empty: it may be anything
        integer :: i

        if (name /= energy_name .or. .not. has_velocities(meaning, samples)) return
        do i = 1, size(samples%usual)
            if (samples%usual(i)%name == energy_name) truth = samples%usual(i)%meaning
        end do
    end subroutine find_energy

    subroutine define_slopes(name, meaning, samples)
        !! `dV_eff/dr`, in which the momenta are constants.
        character(*), intent(in) :: name
        type(expression_t), intent(in) :: meaning
        type(samples_t), intent(inout) :: samples
        type(error_t), allocatable :: error
        type(expression_t), allocatable :: formulas(:)
        type(expression_t) :: slope
        integer :: k

        do k = 1, size(samples%role)
            if (.not. meaning%depends_on(k)) cycle
            if (samples%role(k) == role_velocity .and. samples%ndof <= most_cyclic + 1) then
                cycle
            end if
            if (any(samples%symbols%names(k)(:2) == ["p_", "L_"])) cycle
            if (samples%role(k) == role_parameter .and. samples%rate(k) == 0) cycle
            if (samples%role(k) /= role_coordinate) return
        end do
        call energy_formulas(samples, formulas)
        do k = 2, 1 + samples%ndof
            associate (by => "_d"//trim(samples%symbols%names(k)))
                slope = simplified(slope_at_momentum(meaning, k, formulas(1), samples), &
                                   samples%symbols)
                call samples%symbols%define("d"//name//by, slope, error)
                slope = simplified(slope_at_momentum(slope, k, formulas(1), samples), &
                                   samples%symbols)
                call samples%symbols%define("dd"//name//by//by, slope, error)
            end associate
        end do
    end subroutine define_slopes

    subroutine compare_usual(name, meaning, text, samples, judgement)
        !! A definition of H, v or S is right if it is what is mostly called that.
        character(*), intent(in) :: name
        type(expression_t), intent(in) :: meaning
        character(*), intent(in) :: text
        type(samples_t), intent(in) :: samples
        type(judgement_t), intent(inout) :: judgement
        character(:), allocatable :: label
        logical :: agrees, known

        call find_usual(name, meaning, text, samples, known, agrees, label)
        if (.not. known) return
        if (agrees) judgement%verdict = is_right
        judgement%contradicts = .not. agrees
        judgement%remark = as_new_name//"not "//label
        if (agrees) judgement%remark = "as "//label
    end subroutine compare_usual

end module lagrangia_own_names
