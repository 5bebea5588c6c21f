module lagrangia_report
    !! What a principle says, in numbers: a ledger of statements with a title, notes and a picture.
    !! Plain data; commands print it.
    use lagrangia_kinds, only: dp
    use lagrangia_ledger, only: group_length, ledger_t
    implicit none (type, external)
    private
    public :: citation_t, picture_t, report_t

    integer, parameter :: column_length = 32

    type :: picture_t
        !! A table worth a picture: one row a sample, one column a curve.
        character(column_length) :: file = ""        !! name without ending; "" if there is none
        character(group_length) :: title = ""
        character(column_length), allocatable :: names(:)
        character(16), allocatable :: units(:)
        character(group_length), allocatable :: panels(:)  !! `x:y1+y2`, as in a scene's `plot`
        real(dp), allocatable :: values(:, :)        !! (columns, rows)
        logical :: nested = .false.  !! curves lie on each other, the first is widest
    end type picture_t

    type :: citation_t
        !! A part of a line of the lecture notes, word for word.
        character(2) :: scan = ""  !! I or II
        integer :: line = 0
        character(group_length + 20) :: text = ""
    end type citation_t

    type, extends(ledger_t) :: report_t
        character(group_length) :: title = ""
        type(citation_t), allocatable :: citations(:)  !! the lines that the page serves
        character(group_length), allocatable :: notes(:)
        type(picture_t) :: picture
    contains
        procedure :: begin
        procedure :: note
        procedure :: cite
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
        if (allocated(self%citations)) deallocate (self%citations)
        allocate (self%notes(0), self%citations(0))
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

    pure subroutine cite(self, scan, line, text)
        !! One more line of the notes that the page serves.
        class(report_t), intent(inout) :: self
        character(*), intent(in) :: scan  !! I or II
        integer, intent(in) :: line       !! of the scan's text
        character(*), intent(in) :: text  !! a part of it, at most `group_length` characters
        type(citation_t), allocatable :: longer(:)

        allocate (longer(size(self%citations) + 1))
        longer(:size(self%citations)) = self%citations
        longer(size(longer)) = citation_t(scan, line, text)
        call move_alloc(longer, self%citations)
    end subroutine cite
end module lagrangia_report
