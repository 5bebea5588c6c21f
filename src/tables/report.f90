module lagrangia_report
    !! What a principle says, in numbers: both sides of each statement, how far they differ and
    !! how far they may. Plain data; commands print it.
    use lagrangia_kinds, only: dp
    implicit none (type, external)
    private
    public :: picture_t, report_t, statement_t
    public :: heading_length, statement_length

    integer, parameter :: statement_length = 46
    integer, parameter :: heading_length = 98
    integer, parameter :: column_length = 32

    type :: statement_t
        !! Left side, right side, and the verdict.
        character(heading_length) :: heading = ""  !! of the group it belongs to
        character(statement_length) :: name = ""
        real(dp) :: left = 0.0_dp
        real(dp) :: right = 0.0_dp
        real(dp) :: difference = 0.0_dp  !! how far from true: 0 for an inequality that holds
        real(dp) :: bound = 0.0_dp       !! the largest difference that rounding or theory allow
        logical :: control = .false.     !! a negative control: false on purpose, it must fail
    contains
        procedure :: holds
        procedure :: as_it_must
    end type statement_t

    type :: picture_t
        !! A table worth a picture: one row a sample, one column a curve.
        character(column_length) :: file = ""        !! name without ending; "" if there is none
        character(heading_length) :: title = ""
        character(column_length), allocatable :: names(:)
        character(16), allocatable :: units(:)
        character(heading_length), allocatable :: panels(:)  !! `x:y1+y2`, as in a scene's `plot`
        real(dp), allocatable :: values(:, :)        !! (columns, rows)
    end type picture_t

    type :: report_t
        character(heading_length) :: title = ""
        character(heading_length), allocatable :: notes(:)
        type(statement_t), allocatable :: rows(:)
        type(picture_t) :: picture
        character(heading_length), private :: heading = ""
    contains
        procedure :: begin
        procedure :: section
        procedure :: equal
        procedure :: at_least
        procedure :: note
        procedure :: misses
    end type report_t

contains

    elemental function holds(self) result(yes)
        !! Both sides agree as far as they should; NaN does not.
        class(statement_t), intent(in) :: self
        logical :: yes

        yes = self%difference <= self%bound
    end function holds

    elemental function as_it_must(self) result(yes)
        !! A statement holds, a negative control fails.
        class(statement_t), intent(in) :: self
        logical :: yes

        yes = merge(self%difference > self%bound, self%holds(), self%control)
    end function as_it_must

    pure subroutine begin(self, title)
        !! An empty report.
        class(report_t), intent(inout) :: self
        character(*), intent(in) :: title

        self%title = title
        self%heading = ""
        self%picture = picture_t()
        if (allocated(self%rows)) deallocate (self%rows)
        if (allocated(self%notes)) deallocate (self%notes)
        allocate (self%rows(0), self%notes(0))
    end subroutine begin

    pure subroutine section(self, heading)
        !! What follows belongs under `heading`.
        class(report_t), intent(inout) :: self
        character(*), intent(in) :: heading

        self%heading = heading
    end subroutine section

    pure subroutine equal(self, name, left, right, bound, control)
        !! State that `left` is `right`, to `bound`.
        class(report_t), intent(inout) :: self
        character(*), intent(in) :: name
        real(dp), intent(in) :: left, right, bound
        logical, intent(in), optional :: control  !! it must not be so

        call append(self, name, left, right, abs(left - right), bound, control)
    end subroutine equal

    pure subroutine at_least(self, name, left, right, bound, control)
        !! State that `left` is not less than `right`, but for `bound`.
        class(report_t), intent(inout) :: self
        character(*), intent(in) :: name
        real(dp), intent(in) :: left, right, bound
        logical, intent(in), optional :: control  !! it must not be so

        call append(self, name, left, right, (abs(right - left) + (right - left))/2.0_dp, bound, &
                    control)
    end subroutine at_least

    pure subroutine append(self, name, left, right, difference, bound, control)
        !! One more row.
        class(report_t), intent(inout) :: self
        character(*), intent(in) :: name
        real(dp), intent(in) :: left, right, difference, bound
        logical, intent(in), optional :: control
        type(statement_t) :: row

        row%heading = self%heading
        row%name = name
        row%left = left
        row%right = right
        row%difference = difference
        row%bound = bound
        if (present(control)) row%control = control
        self%rows = [self%rows, row]
    end subroutine append

    pure subroutine note(self, text)
        !! One more line at the end.
        class(report_t), intent(inout) :: self
        character(*), intent(in) :: text
        character(heading_length), allocatable :: longer(:)

        allocate (longer(size(self%notes) + 1))
        longer(:size(self%notes)) = self%notes
        longer(size(longer)) = text
        call move_alloc(longer, self%notes)
    end subroutine note

    pure function misses(self) result(count_of)
        !! How many rows are not as they must be.
        class(report_t), intent(in) :: self
        integer :: count_of

        count_of = count(.not. self%rows%as_it_must())
    end function misses
end module lagrangia_report
