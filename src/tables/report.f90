module lagrangia_report
    !! What a principle says, in numbers: a ledger of statements with a title, notes and a picture.
    !! Plain data; commands print it.
    use lagrangia_kinds, only: dp
    use lagrangia_ledger, only: group_length, ledger_t
    implicit none (type, external)
    private
    public :: picture_t, report_t

    integer, parameter :: column_length = 32

    type :: picture_t
        !! A table worth a picture: one row a sample, one column a curve.
        character(column_length) :: file = ""        !! name without ending; "" if there is none
        character(group_length) :: title = ""
        character(column_length), allocatable :: names(:)
        character(16), allocatable :: units(:)
        character(group_length), allocatable :: panels(:)  !! `x:y1+y2`, as in a scene's `plot`
        real(dp), allocatable :: values(:, :)        !! (columns, rows)
    end type picture_t

    type, extends(ledger_t) :: report_t
        character(group_length) :: title = ""
        character(group_length), allocatable :: notes(:)
        type(picture_t) :: picture
    contains
        procedure :: begin
        procedure :: note
    end type report_t

contains

    pure subroutine begin(self, title)
        !! An empty report.
        class(report_t), intent(inout) :: self
        character(*), intent(in) :: title  !! "" if there is none

        self%title = title
        self%picture = picture_t()
        if (allocated(self%rows)) deallocate (self%rows)
        if (allocated(self%notes)) deallocate (self%notes)
        allocate (self%notes(0))
        call self%section("")
    end subroutine begin

    pure subroutine note(self, text)
        !! One more line at the end.
        class(report_t), intent(inout) :: self
        character(*), intent(in) :: text  !! at most `group_length` characters
        character(group_length), allocatable :: longer(:)

        allocate (longer(size(self%notes) + 1))
        longer(:size(self%notes)) = self%notes
        longer(size(longer)) = text
        call move_alloc(longer, self%notes)
    end subroutine note
end module lagrangia_report
