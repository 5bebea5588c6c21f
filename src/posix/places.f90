module lagrangia_places
    !! Which names lead to one file: no two of a run may, lest what one holds be lost.
    use lagrangia_errors, only: error_t, fail
    use lagrangia_files, only: facts_t, folder_of, look_at
    use lagrangia_kinds, only: i8
    implicit none (type, external)
    private
    public :: places_t

    type :: place_t
        !! What exists is known by its device and inode, through links of either kind; what does
        !! not, by those of the nearest folder above it and the name below that.
        character(:), allocatable :: path   !! as it was written
        character(:), allocatable :: what   !! `data file`
        character(:), allocatable :: owner  !! whose it is; may be empty
        integer(i8) :: device = -1, inode = -1
        character(:), allocatable :: below  !! without `.`, `..` and empty parts
    end type place_t

    type :: places_t
        !! All files that a run reads and writes.
        private
        type(place_t), allocatable :: items(:)  !! a longer list than there are places
        integer :: count = 0
    contains
        procedure :: add
    end type places_t

contains

    subroutine add(self, path, what, owner, error)
        !! One more file, `what` it is and whose. Fails (status 2) where it is one of those that
        !! are there already; the message names both.
        class(places_t), intent(inout) :: self
        character(*), intent(in) :: path                  !! as the user wrote it
        character(*), intent(in) :: what                  !! `data file`, `script`
        character(*), intent(in) :: owner                 !! `a.nml`; `""` where there is but one
        type(error_t), allocatable, intent(out) :: error  !! status 2: it is there already
        type(place_t), allocatable :: longer(:)
        type(place_t) :: place
        integer :: i

        if (.not. allocated(self%items)) allocate (self%items(8))
        call locate(path, place)
        place%what = what
        place%owner = owner
        do i = 1, self%count
            if (.not. same(self%items(i), place)) cycle
            call fail(error, named(place)//" and "//named(self%items(i))// &
                      " are one file: one would be lost; another '--output' or output keeps "// &
                      "them apart")
            return
        end do
        if (self%count == size(self%items)) then
            allocate (longer(2*self%count))
            longer(:self%count) = self%items
            call move_alloc(longer, self%items)
        end if
        self%count = self%count + 1
        self%items(self%count) = place
    end subroutine add

    subroutine locate(path, place)
        !! See `place_t`.
        character(*), intent(in) :: path
        type(place_t), intent(out) :: place
        type(facts_t) :: facts
        character(:), allocatable :: above, part
        integer :: ups  !! parts that a `..` behind them takes back

        place%path = path
        place%below = ""
        above = path
        ups = 0
        do
            facts = look_at(above)
            if (facts%found) exit
            part = above(index(above, "/", back=.true.) + 1:)
            if (part == "..") then
                ups = ups + 1
            else if (part /= "" .and. part /= ".") then
                if (ups == 0) place%below = "/"//part//place%below
                ups = max(0, ups - 1)
            end if
            if (above == "." .or. above == "/" .or. above == "") return
            above = folder_of(above)
        end do
        if (ups > 0) facts = look_at(above//repeat("/..", ups))
        place%device = facts%device
        place%inode = facts%inode
    end subroutine locate

    pure function same(a, b)
        !! Whether both are one file.
        type(place_t), intent(in) :: a, b
        logical :: same

        same = a%device == b%device .and. a%inode == b%inode
        if (same) same = len(a%below) == len(b%below)  ! Fortran would pad the shorter with blanks
        if (same) same = a%below == b%below
    end function same

    pure function named(place) result(text)
        !! `the data file 'out/a.dat' of a.nml`.
        type(place_t), intent(in) :: place
        character(:), allocatable :: text

        text = "the "//place%what//" '"//place%path//"'"
        if (place%owner /= "") text = text//" of "//place%owner
    end function named
end module lagrangia_places
