module lagrangia_ledger
    !! What was claimed and what came out: a row for every claim, with the value that was measured,
    !! the bounds of what is allowed, and the verdict. `check`, `principle`, `errata` and `stress`
    !! fill one, and `lagrangia_ledger_text` makes lines and JSON objects of it; what a scene
    !! expects are claims too.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_is_nan
    use lagrangia_kinds, only: dp
    implicit none (type, external)
    private
    public :: claim_t, ledger_t
    public :: claim_length, group_length

    integer, parameter :: group_length = 98
    integer, parameter :: claim_length = 46
    integer, parameter :: remark_length = 200
    integer, parameter :: slip_length = 3

    type :: claim_t
        !! One claim. It holds where `value` is finite and `least <= value <= most`; huge: no bound
        !! on that side.
        character(group_length) :: group = ""    !! the section of the ledger it belongs to
        character(claim_length) :: name = ""     !! what is claimed, or of which case
        character(claim_length) :: measured = "" !! what the value is, where `name` is a case
        real(dp) :: value = -1.0_dp              !! a residual, a difference or a measured number
        real(dp) :: least = -huge(1.0_dp)
        real(dp) :: most = huge(1.0_dp)
        logical :: judged = .false.              !! a bound was given
        logical :: holds = .true.
        real(dp) :: left = 0.0_dp                !! of a statement: its two sides
        real(dp) :: right = 0.0_dp
        logical :: control = .false.             !! a negative control: false on purpose
        real(dp) :: noise = 0.0_dp               !! what rounding does to the value of `try`
        integer :: states = 0                    !! how many were tried
        character(remark_length) :: remark = ""
        character(slip_length) :: slip = ""       !! of the lecture notes that it shows, as `E9`
    contains
        procedure :: as_it_must
    end type claim_t

    type :: ledger_t
        !! The rows of one section or of many.
        type(claim_t), allocatable :: rows(:)
        character(group_length), private :: group = ""
        character(slip_length), private :: slip = ""
    contains
        procedure :: section
        procedure :: try
        procedure :: say
        procedure :: judge
        procedure :: equal
        procedure :: show
        procedure :: at_least
        procedure :: row_of
        procedure :: broken
        procedure, private :: add
    end type ledger_t

contains

    elemental function as_it_must(self) result(yes)
        !! A claim holds, a negative control fails; what is not a number does neither.
        class(claim_t), intent(in) :: self
        logical :: yes

        yes = merge(self%value > self%most, self%holds, self%control)
    end function as_it_must

    pure subroutine section(self, group, slip)
        !! What follows belongs under `group`.
        class(ledger_t), intent(inout) :: self
        character(*), intent(in) :: group           !! a system, a heading or a row of `stress`
        character(*), intent(in), optional :: slip  !! of the notes that all of it shows

        if (.not. allocated(self%rows)) allocate (self%rows(0))
        self%group = group
        self%slip = ""
        if (present(slip)) self%slip = slip
    end subroutine section

    pure subroutine add(self, row)
        !! One more row, of the section that was begun last.
        class(ledger_t), intent(inout) :: self
        type(claim_t), intent(in) :: row  !! its group and slip are not looked at
        type(claim_t), allocatable :: longer(:)
        integer :: n

        if (.not. allocated(self%rows)) allocate (self%rows(0))
        n = size(self%rows) + 1
        allocate (longer(n))
        longer(:n - 1) = self%rows
        longer(n) = row
        longer(n)%group = self%group
        longer(n)%slip = self%slip
        call move_alloc(longer, self%rows)
    end subroutine add

    pure subroutine try(self, claim, residual, noise, allowance)
        !! One more state: the claim holds there if \(r \le a\nu\), and \(r\) is not NaN. The row
        !! keeps the state of the largest \(r/\nu\).
        class(ledger_t), intent(inout) :: self
        character(*), intent(in) :: claim      !! one row a claim and section
        real(dp), intent(in) :: residual       !! \(r\ge0\), relative to the terms that add up
        real(dp), intent(in) :: noise          !! \(\nu\), what rounding may make of it
        real(dp), intent(in) :: allowance      !! \(a\)
        integer :: i

        i = self%row_of(claim)
        if (i == 0) then
            call self%add(claim_t(name=claim))
            i = size(self%rows)
        end if
        associate (row => self%rows(i))
            row%states = row%states + 1
            if (.not. residual <= allowance*noise) row%holds = .false.
            ! the first, and then what is worse beside its noise; what is not a number is worst
            if (ieee_is_nan(row%value)) return
            if (row%value < 0.0_dp .or. .not. residual*row%noise <= row%value*noise) then
                row%value = residual
                row%noise = noise
                row%most = allowance*noise
                row%judged = .true.
            end if
        end associate
    end subroutine try

    pure subroutine say(self, claim, remark)
        !! Say more of a claim; the first remark stays.
        class(ledger_t), intent(inout) :: self
        character(*), intent(in) :: claim   !! of the latest section
        character(*), intent(in) :: remark  !! what is wrong
        integer :: i

        i = self%row_of(claim)
        if (i == 0) return
        if (self%rows(i)%remark == "") self%rows(i)%remark = remark
    end subroutine say

    pure subroutine judge(self, of, measured, value, least, most, remark)
        !! One measured number. Without bounds it is only stated, but must be finite.
        class(ledger_t), intent(inout) :: self
        character(*), intent(in) :: of                !! the case
        character(*), intent(in) :: measured          !! what the number is
        real(dp), intent(in) :: value  !! what was measured
        real(dp), intent(in), optional :: least       !! allowed
        real(dp), intent(in), optional :: most        !! allowed
        character(*), intent(in), optional :: remark  !! behind the verdict
        type(claim_t) :: row

        row%name = of
        row%measured = measured
        row%value = value
        if (present(least)) row%least = least
        if (present(most)) row%most = most
        row%judged = present(least) .or. present(most)
        if (present(remark)) row%remark = remark
        row%holds = ieee_is_finite(value) .and. value >= row%least .and. value <= row%most
        call self%add(row)
    end subroutine judge

    pure subroutine equal(self, name, left, right, bound, control)
        !! State that \(|\mathrm{left}-\mathrm{right}|\le\) `bound`.
        class(ledger_t), intent(inout) :: self
        character(*), intent(in) :: name              !! the statement
        real(dp), intent(in) :: left                  !! side of it
        real(dp), intent(in) :: right                 !! side of it
        real(dp), intent(in) :: bound                 !! what rounding or theory allow
        logical, intent(in), optional :: control      !! it must not be so

        call state(self, name, left, right, abs(left - right), bound, control)
    end subroutine equal

    pure subroutine at_least(self, name, left, right, bound, control)
        !! State that \(\mathrm{right}-\mathrm{left}\le\) `bound`.
        class(ledger_t), intent(inout) :: self
        character(*), intent(in) :: name              !! the statement
        real(dp), intent(in) :: left                  !! side of it
        real(dp), intent(in) :: right                 !! side of it
        real(dp), intent(in) :: bound                 !! what rounding or theory allow
        logical, intent(in), optional :: control      !! it must not be so

        call state(self, name, left, right, (abs(right - left) + (right - left))/2.0_dp, bound, &
                   control)
    end subroutine at_least

    pure subroutine state(self, name, left, right, difference, bound, control)
        !! One more statement; `difference` is how far it is from true.
        class(ledger_t), intent(inout) :: self
        character(*), intent(in) :: name
        real(dp), intent(in) :: left, right, difference, bound
        logical, intent(in), optional :: control
        type(claim_t) :: row

        row%name = name
        row%left = left
        row%right = right
        row%value = difference
        row%most = bound
        row%judged = .true.
        row%holds = difference <= bound
        if (present(control)) row%control = control
        call self%add(row)
    end subroutine state

    pure subroutine show(self, slip)
        !! The latest row shows a slip of the lecture notes.
        class(ledger_t), intent(inout) :: self
        character(*), intent(in) :: slip  !! `E9`

        self%rows(size(self%rows))%slip = slip
    end subroutine show

    pure function row_of(self, claim) result(row)
        !! Where the claim is, of the latest section; 0 if it is nowhere.
        class(ledger_t), intent(in) :: self
        character(*), intent(in) :: claim  !! its name
        integer :: row

        row = 0
        if (.not. allocated(self%rows)) return
        do row = size(self%rows), 1, -1
            if (self%rows(row)%name == claim .and. self%rows(row)%group == self%group) return
        end do
    end function row_of

    pure function broken(self) result(number)
        !! How many rows are not as they must be.
        class(ledger_t), intent(in) :: self
        integer :: number

        number = 0
        if (allocated(self%rows)) number = count(.not. self%rows%as_it_must())
    end function broken
end module lagrangia_ledger
