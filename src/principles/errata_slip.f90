module lagrangia_errata_slip
    !! What is said of one slip in the lecture notes: where it stands, word for word, how that
    !! reads, and what it should be.
    !!
    !! Lines are those of the scans' text: I of "Classical Mechanics (Phys 601), 1 September 2011",
    !! II of "Hamilton's Principle".
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: quote_t, slip_t
    public :: kind_lecture, kind_none, kind_scan, kind_terminology
    public :: line_length

    integer, parameter :: line_length = 120
    integer, parameter :: most_quotes = 5

    character(11), parameter :: kind_lecture = "lecture"  !! the mathematics or a claim is wrong
    character(11), parameter :: kind_scan = "scan"        !! letters, dots: the scanner's
    character(11), parameter :: kind_terminology = "terminology"  !! right, by another name
    character(11), parameter :: kind_none = "no slip"     !! it was taken for one

    type :: quote_t
        !! A part of a line of the scans' text, word for word.
        character(2) :: scan = ""               !! I or II; "" if there is no quote
        integer :: line = 0
        character(line_length) :: text = ""
    end type quote_t

    type :: slip_t
        character(3) :: id = ""
        character(11) :: kind = ""
        character(40) :: subject = ""
        type(quote_t) :: quotes(most_quotes)        !! the most telling one first
        type(quote_t) :: elsewhere                  !! where the notes have it right
        character(line_length) :: reads = ""        !! the first quote, or all, in our letters
        character(line_length) :: derived = ""
        character(line_length) :: effect = ""       !! what it would do; "" if nothing
        character(16) :: principle = ""             !! whose report has the numbers; "" if none
    contains
        procedure :: place
    end type slip_t

contains

    pure function place(self) result(text)
        !! The scan and the lines of the quotes, ascending.
        class(slip_t), intent(in) :: self
        character(:), allocatable :: text
        logical :: used(most_quotes)
        integer :: lines, next

        used = self%quotes%scan /= ""
        text = ""
        lines = 0
        do while (any(used))
            next = minval(self%quotes%line, used)
            text = text//", "//to_text(next)
            lines = lines + 1
            used = used .and. self%quotes%line /= next
        end do
        text = trim(self%quotes(1)%scan)//", "//trim(merge("lines", "line ", lines > 1))//text(2:)
    end function place
end module lagrangia_errata_slip
