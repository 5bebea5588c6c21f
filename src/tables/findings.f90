module lagrangia_findings
    !! What an audit found: a row for every claim, with the worst of all states tried.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
    use lagrangia_description, only: name_length
    use lagrangia_kinds, only: dp
    implicit none (type, external)
    private
    public :: audit_t, audit_box_t, finding_t, claim_length, remark_length

    integer, parameter :: claim_length = 40
    integer, parameter :: remark_length = 200

    type :: finding_t
        character(name_length) :: system = ""
        character(claim_length) :: claim = ""
        real(dp) :: worst = -1.0_dp  !! the relative residual that is the largest beside its noise
        real(dp) :: noise = 0.0_dp   !! what rounding, or the difference formula, does to it
        real(dp) :: bound = 0.0_dp   !! the largest that is allowed, a few times the noise
        logical :: holds = .true.
        integer :: states = 0        !! tried
        character(remark_length) :: remark = ""  !! what is wrong
    end type finding_t

    type :: audit_t
        !! The rows of one system or of many.
        type(finding_t), allocatable :: findings(:)
        character(name_length), private :: system = ""
    contains
        procedure :: begin
        procedure :: judge
        procedure :: say
        procedure :: row_of
        procedure :: broken
    end type audit_t

    type :: audit_box_t
        !! gfortran 12 needs it: modules that make the dispatch table of `audit_t` for themselves
        !! disagree about its order.
        class(audit_t), allocatable :: item
    end type audit_box_t

contains

    pure subroutine begin(self, system)
        !! What follows is about `system`.
        class(audit_t), intent(inout) :: self
        character(*), intent(in) :: system

        if (.not. allocated(self%findings)) allocate (self%findings(0))
        self%system = system
    end subroutine begin

    pure subroutine judge(self, claim, residual, noise, allowance)
        !! One more state: the claim holds there if `residual` is at most `allowance` times `noise`,
        !! and not NaN.
        class(audit_t), intent(inout) :: self
        character(*), intent(in) :: claim
        real(dp), intent(in) :: residual, noise, allowance
        type(finding_t), allocatable :: longer(:)
        integer :: i

        i = self%row_of(claim)
        if (i == 0) then
            i = size(self%findings) + 1
            allocate (longer(i))
            longer(:i - 1) = self%findings
            longer(i)%system = self%system
            longer(i)%claim = claim
            call move_alloc(longer, self%findings)
        end if
        associate (row => self%findings(i))
            row%states = row%states + 1
            if (.not. residual <= allowance*noise) row%holds = .false.
            ! the first, and then what is worse beside its noise; what is not a number is worst
            if (ieee_is_nan(row%worst)) return
            if (row%worst < 0.0_dp .or. .not. residual*row%noise <= row%worst*noise) then
                row%worst = residual
                row%noise = noise
                row%bound = allowance*noise
            end if
        end associate
    end subroutine judge

    pure subroutine say(self, claim, remark)
        !! Say more of a claim; the first remark stays.
        class(audit_t), intent(inout) :: self
        character(*), intent(in) :: claim, remark
        integer :: i

        i = self%row_of(claim)
        if (i == 0) return
        if (self%findings(i)%remark == "") self%findings(i)%remark = remark
    end subroutine say

    pure function row_of(self, claim) result(row)
        !! Where the claim is, of the latest system; 0 if it is nowhere.
        class(audit_t), intent(in) :: self
        character(*), intent(in) :: claim
        integer :: row

        do row = size(self%findings), 1, -1
            if (self%findings(row)%claim == claim .and. &
                self%findings(row)%system == self%system) return
        end do
        row = 0
    end function row_of

    pure function broken(self) result(number)
        !! How many claims do not hold.
        class(audit_t), intent(in) :: self
        integer :: number

        number = count(.not. self%findings%holds)
    end function broken
end module lagrangia_findings
