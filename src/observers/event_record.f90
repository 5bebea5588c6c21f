module lagrangia_event_record
    !! The observer that writes down events: one row each, the columns and then its number.
    use lagrangia_columns, only: columns_t
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_observer, only: observer_t
    use lagrangia_system, only: system_t
    use lagrangia_table, only: table_t
    implicit none (type, external)
    private
    public :: event_record_t

    type, extends(observer_t) :: event_record_t
        type(columns_t) :: columns
        class(table_t), allocatable :: table      !! absent: nothing is written
        real(dp) :: time = 0.0_dp                 !! of the latest event, s
        real(dp), allocatable :: row(:)           !! the latest event
        real(dp), allocatable :: low(:), high(:)  !! range of each column so far
        integer(i8) :: rows = 0
    contains
        procedure :: observe
        procedure :: meet
    end type event_record_t

contains

    subroutine observe(self, system, t, q, v, error)
        !! Samples don't matter.
        class(event_record_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t, q(system%ndof), v(system%ndof)
        type(error_t), allocatable, intent(out) :: error
    end subroutine observe

    subroutine meet(self, system, event, t, q, v, error)
        !! Evaluate, remember, write.
        class(event_record_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        integer, intent(in) :: event
        real(dp), intent(in) :: t, q(system%ndof), v(system%ndof)
        type(error_t), allocatable, intent(out) :: error
        integer :: n

        n = size(self%columns%items)
        if (.not. allocated(self%row)) then
            allocate (self%row(n + 1))
            allocate (self%low(n + 1), source=huge(t))
            allocate (self%high(n + 1), source=-huge(t))
        end if
        call self%columns%evaluate(system, t, q, v, 0.0_dp, self%row(:n))
        self%row(n + 1) = event
        self%low = min(self%low, self%row)
        self%high = max(self%high, self%row)
        if (allocated(self%table)) call self%table%add_row(self%row, error)
        if (allocated(error)) return
        self%time = t
        self%rows = self%rows + 1
    end subroutine meet
end module lagrangia_event_record
