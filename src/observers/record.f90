module lagrangia_record
    !! The observer that evaluates the columns, writes them down and remembers the worst.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use lagrangia_columns, only: columns_t
    use lagrangia_errors, only: error_t, fail, status_numbers
    use lagrangia_kinds, only: dp, i8
    use lagrangia_observer, only: observer_t
    use lagrangia_reference, only: reference_t
    use lagrangia_shadow, only: distance, shadow_t
    use lagrangia_system, only: system_t
    use lagrangia_table, only: table_t
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: record_t

    type, extends(observer_t) :: record_t
        type(columns_t) :: columns
        integer :: shown = 0                              !! so many columns go into the table
        class(table_t), allocatable :: table              !! absent: nothing is written
        class(reference_t), allocatable :: reference      !! a closed form,
        type(shadow_t), allocatable :: shadow             !! or the run at half the step
        real(dp), allocatable :: row(:)                   !! the latest sample
        real(dp), allocatable :: low(:), high(:)          !! range of each column so far
        integer(i8) :: rows = 0
    contains
        procedure :: observe
        procedure :: worst
    end type record_t

contains

    subroutine observe(self, system, t, q, v, error)
        !! Evaluate, remember, write. A number that is none ends the run: it would be neither a
        !! good row nor, since `min` and `max` pass over NaN, a bad verdict.
        class(record_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t, q(system%ndof), v(system%ndof)
        type(error_t), allocatable, intent(out) :: error
        real(dp) :: deviation, truth(system%ndof), ignored(system%ndof)
        integer :: odd

        deviation = 0.0_dp
        if (allocated(self%reference)) then
            call self%reference%state_at(t, truth, ignored)
            deviation = distance(q, truth)
        else if (allocated(self%shadow)) then
            call self%shadow%estimate(system, t, q, deviation, error)
            if (allocated(error)) return
        end if
        if (.not. allocated(self%row)) then
            allocate (self%row(size(self%columns%items)))
            allocate (self%low(size(self%row)), source=huge(t))
            allocate (self%high(size(self%row)), source=-huge(t))
        end if
        call self%columns%evaluate(system, t, q, v, deviation, self%row)
        odd = findloc(ieee_is_finite(self%row), .false., 1)
        if (odd > 0) then
            call fail(error, "column '"//trim(self%columns%items(odd)%name)//"' is not finite "// &
                      "at t = "//to_text(t)//" s", status_numbers)
            return
        end if
        self%low = min(self%low, self%row)
        self%high = max(self%high, self%row)
        if (allocated(self%table)) call self%table%add_row(self%row(:self%shown), error)
        if (allocated(error)) return
        self%rows = self%rows + 1
    end subroutine observe

    pure function worst(self, i) result(value)
        !! The largest magnitude of column `i` so far.
        class(record_t), intent(in) :: self
        integer, intent(in) :: i
        real(dp) :: value

        value = max(abs(self%low(i)), abs(self%high(i)))
    end function worst
end module lagrangia_record
