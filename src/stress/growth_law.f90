module lagrangia_growth_law
    !! How an error grows with the number of steps: measured at powers of ten, fitted and named.
    use lagrangia_bench_table, only: short
    use lagrangia_kinds, only: dp, i8
    implicit none (type, external)
    private
    public :: growth_t

    type :: growth_t
        !! The largest error so far, at \(10^3, 10^{3.5}, 10^4, \dots\) steps.
        real(dp) :: worst = 0.0_dp
        real(dp), allocatable :: steps(:), errors(:)
    contains
        procedure :: see
        procedure :: exponent_of
        procedure :: law
        procedure :: remark
    end type growth_t

contains

    pure subroutine see(self, steps, error)
        !! The error after so many steps; what is not a number counts as huge.
        class(growth_t), intent(inout) :: self
        integer(i8), intent(in) :: steps
        real(dp), intent(in) :: error
        real(dp), allocatable :: longer(:)
        integer :: n

        self%worst = max(self%worst, error)
        if (.not. error <= huge(error)) self%worst = huge(error)
        if (.not. allocated(self%steps)) allocate (self%steps(0), self%errors(0))
        n = size(self%steps)
        if (real(steps, dp) < 10.0_dp**(3.0_dp + 0.5_dp*n)) return
        allocate (longer(n + 1))
        longer = [self%steps, real(steps, dp)]
        call move_alloc(longer, self%steps)
        allocate (longer(n + 1))
        longer = [self%errors, self%worst]
        call move_alloc(longer, self%errors)
    end subroutine see

    pure function exponent_of(self) result(p)
        !! \(p\) of the law \(N^p\): the slope of the logarithms over the last two decades, by
        !! least squares.
        class(growth_t), intent(in) :: self
        real(dp) :: p
        real(dp), allocatable :: x(:), y(:)
        integer :: n

        n = size(self%steps)
        allocate (x, source=log(self%steps(max(1, n - 4):)))
        allocate (y, source=log(self%errors(max(1, n - 4):) + tiny(p)))
        x = x - sum(x)/size(x)
        p = sum(x*y)/sum(x**2)
    end function exponent_of

    pure function law(self) result(name)
        !! The nearest of the laws.
        class(growth_t), intent(in) :: self
        character(:), allocatable :: name

        associate (p => self%exponent_of())
            if (p <= 0.2_dp) then
                name = "bounded"
            else if (p <= 0.8_dp) then
                name = "sqrt N"
            else if (p <= 1.25_dp) then
                name = "linear"
            else
                name = "faster than linear"
            end if
        end associate
    end function law

    pure function remark(self) result(text)
        !! `linear: 1.5e-3 after 1e6 steps`.
        class(growth_t), intent(in) :: self
        character(:), allocatable :: text

        text = self%law()//": "//short(self%worst, 2)//" after "// &
               short(self%steps(size(self%steps)), 1)//" steps"
    end function remark
end module lagrangia_growth_law
