module lagrangia_record
    !! The observers that evaluate columns, write them down and remember their range: one row a
    !! sample, or one row an event with its number at the end.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_quiet_nan, ieee_value
    use lagrangia_columns, only: columns_t, is_error, is_quantity
    use lagrangia_errors, only: error_t, fail, status_numbers
    use lagrangia_integrator, only: dense_integrator_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_observer, only: observer_t
    use lagrangia_reference, only: reference_t
    use lagrangia_second_run, only: distance, second_run_t
    use lagrangia_system, only: system_t
    use lagrangia_table, only: table_t
    use lagrangia_text, only: to_text
    use lagrangia_value_range, only: value_range_t
    use lagrangia_work, only: work_t
    implicit none (type, external)
    private
    public :: event_record_t, record_t, sample_record_t

    type, abstract, extends(observer_t) :: record_t
        type(columns_t) :: columns
        class(table_t), allocatable :: table              !! absent: nothing is written
        type(value_range_t), allocatable :: ranges(:)     !! of each column so far
        integer(i8) :: rows = 0
    contains
        procedure, private :: keep
        procedure :: abandon
        procedure :: worst
    end type record_t

    type, extends(record_t) :: sample_record_t
        integer :: shown = 0                              !! so many columns go into the table
        class(reference_t), allocatable :: reference      !! a closed form,
        type(second_run_t), allocatable :: second_run     !! or the run at half the step
        type(work_t), private :: work                     !! if a column needs it
        real(dp), allocatable, private :: row(:)          !! the latest sample
    contains
        procedure :: observe
        procedure :: follows
        procedure :: follows_samples => follows
        procedure :: meet => go_on
        procedure :: follow
        procedure :: follow_inside
    end type sample_record_t

    type, extends(record_t) :: event_record_t
    contains
        procedure :: observe => no_sample
        procedure :: meet
    end type event_record_t

contains

    subroutine keep(self, row, shown, error)
        !! Remember, write.
        class(record_t), intent(inout) :: self
        real(dp), intent(in), contiguous :: row(:)
        integer, intent(in) :: shown                      !! numbers that are written
        type(error_t), allocatable, intent(out) :: error  !! the row could not be written

        if (.not. allocated(self%ranges)) allocate (self%ranges(size(row)))
        call self%ranges%see(row)
        if (allocated(self%table)) call self%table%add_row(row(:shown), error)
        if (.not. allocated(error)) self%rows = self%rows + 1
    end subroutine keep

    subroutine abandon(self)
        !! Leave no file behind.
        class(record_t), intent(inout) :: self

        if (allocated(self%table)) call self%table%file%abandon()
    end subroutine abandon

    pure function worst(self, i) result(value)
        !! The largest magnitude of a column so far; NaN where it has a gap, of which nothing can
        !! be said.
        class(record_t), intent(in) :: self
        integer, intent(in) :: i  !! number of the column
        real(dp) :: value

        value = self%ranges(i)%largest()
        if (self%ranges(i)%gaps > 0) value = ieee_value(value, ieee_quiet_nan)
    end function worst

    subroutine observe(self, system, t, q, v, error)
        !! See `observer_t`. A number that is none ends the run, for the motion is none any more;
        !! but not one of a quantity, or an error that is not known, which the motion does without:
        !! these are NaN.
        class(sample_record_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t, q(system%ndof), v(system%ndof)
        type(error_t), allocatable, intent(out) :: error
        logical :: may_be_none(size(self%columns%items))
        real(dp) :: deviation
        integer :: odd

        deviation = 0.0_dp
        if (allocated(self%reference)) then
            deviation = distance_to(self%reference, t, q)
        else if (allocated(self%second_run)) then
            call self%second_run%estimate(system, t, q, deviation, error)
            if (allocated(error)) return
        end if
        if (.not. allocated(self%row)) allocate (self%row(size(self%columns%items)))
        if (self%columns%needs_work .and. .not. allocated(self%work%system)) then
            call self%work%begin(system, t, q, v)
        end if
        call self%columns%evaluate(system, t, q, v, deviation, self%row, self%work%done())
        may_be_none = self%columns%items%kind == is_quantity
        if (allocated(self%second_run)) then
            may_be_none = may_be_none .or. (self%second_run%too_many .and. &
                                            self%columns%items%kind == is_error)
        end if
        where (may_be_none .and. .not. ieee_is_finite(self%row))
            self%row = ieee_value(self%row, ieee_quiet_nan)
        end where
        odd = findloc(ieee_is_finite(self%row) .or. may_be_none, .false., 1)
        if (odd > 0) then
            call fail(error, "column '"//trim(self%columns%items(odd)%name)//"' is not finite "// &
                      "at t = "//to_text(t)//" s", status_numbers)
            if (.not. ieee_is_finite(self%work%done())) error%message = error%message// &
                ": the work is not resolved between the steps: "//remedy(self%reference)
            return
        end if
        call self%keep(self%row, self%shown, error)
    end subroutine observe

    pure function remedy(reference) result(text)
        !! Of steps over which a friction ends. Where it does so far faster than they can become, a
        !! closed form is all that helps.
        class(reference_t), allocatable, intent(in) :: reference
        character(:), allocatable :: text
        logical :: known

        text = "shorten them, or give a tolerance"
        known = allocated(reference)
        if (known) known = reference%has_state
        if (known) text = text//"; method 'auto' takes the closed form, which needs no steps"
    end function remedy

    pure function follows(self)
        !! See `observer_t`: for the work along the motion.
        class(sample_record_t), intent(in) :: self
        logical :: follows

        follows = self%columns%needs_work
    end function follows

    subroutine go_on(self, system, event, t, q, v, error)
        !! See `observer_t`: from the state after an impact.
        class(sample_record_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        integer, intent(in) :: event
        real(dp), intent(in) :: t, q(system%ndof), v(system%ndof)
        type(error_t), allocatable, intent(out) :: error

        if (self%columns%needs_work) call self%work%stand(t, q, v)
    end subroutine go_on

    subroutine follow(self, system, t, q, v)
        !! See `observer_t`.
        class(sample_record_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t, q(system%ndof), v(system%ndof)

        if (self%columns%needs_work) call self%work%follow(t, q, v)
    end subroutine follow

    subroutine follow_inside(self, method, t)
        !! See `observer_t`.
        class(sample_record_t), intent(inout) :: self
        class(dense_integrator_t), intent(in) :: method
        real(dp), intent(in) :: t

        if (self%columns%needs_work) call self%work%follow_inside(method, t)
    end subroutine follow_inside

    pure function distance_to(reference, t, q) result(deviation)
        !! Of the coordinates `q` at `t` to those of a closed form.
        class(reference_t), intent(in) :: reference
        real(dp), intent(in) :: t, q(:)
        real(dp) :: deviation, truth(size(q)), ignored(size(q))

        call reference%state_at(t, truth, ignored)
        deviation = distance(q, truth)
    end function distance_to

    subroutine no_sample(self, system, t, q, v, error)
        !! Samples don't matter.
        class(event_record_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t, q(system%ndof), v(system%ndof)
        type(error_t), allocatable, intent(out) :: error
    end subroutine no_sample

    subroutine meet(self, system, event, t, q, v, error)
        !! See `observer_t`.
        class(event_record_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        integer, intent(in) :: event
        real(dp), intent(in) :: t, q(system%ndof), v(system%ndof)
        type(error_t), allocatable, intent(out) :: error
        real(dp) :: row(size(self%columns%items) + 1)

        call self%columns%evaluate(system, t, q, v, 0.0_dp, row(:size(row) - 1))
        row(size(row)) = event
        call self%keep(row, size(row), error)
    end subroutine meet
end module lagrangia_record
