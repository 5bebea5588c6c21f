module extremes
    !! Audits at parameters drawn over twelve decades: of the systems of the catalogue, where no
    !! claim may fail, and of mutants and liars, where the one that is wrong must.
    use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
    use lagrangia_audit, only: audit_system
    use lagrangia_catalogue, only: new_system
    use lagrangia_description, only: description_t, parameter_t
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp
    use lagrangia_ledger, only: ledger_t
    use lagrangia_random_draws, only: random_t
    use lagrangia_system, only: system_t
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: audit_at_random, coordinate_of, differs, show_parameters

    real(dp), parameter :: decades = 6.0_dp  !! to either side of 1

contains

    subroutine audit_at_random(system, random, audit, values)
        !! One set of parameters, at many states.
        class(system_t), intent(inout) :: system
        type(random_t), intent(inout) :: random
        type(ledger_t), intent(inout) :: audit
        real(dp), allocatable, intent(out) :: values(:)  !! what was drawn
        type(description_t) :: d
        integer :: i, j, k

        call system%describe(d)
        allocate (values(sum(d%parameters%count)))
        k = 0
        do i = 1, size(d%parameters)
            do j = 1, d%parameters(i)%count
                k = k + 1
                call draw(random, d%parameters(i), values(k))
            end do
        end do
        call audit_system(system, audit, spread(.true., 1, k), values)
    end subroutine audit_at_random

    subroutine draw(random, p, value)
        !! Each decade as likely as the other; now and then zero, or left to its formula.
        type(random_t), intent(inout) :: random
        type(parameter_t), intent(in) :: p
        real(dp), intent(out) :: value
        real(dp) :: exponent, chance, sign_of_it

        call random%uniform(-decades, decades, exponent)
        call random%uniform(0.0_dp, 1.0_dp, chance)
        call random%uniform(-1.0_dp, 1.0_dp, sign_of_it)
        value = 10.0_dp**exponent
        if (p%lower < 0.0_dp) value = sign(value, sign_of_it)
        if (p%upper < huge(p%upper)) then
            if (chance < 0.5_dp) then  ! near zero, or anywhere
                value = sign(min(1.0_dp, 10.0_dp**(-abs(exponent))), value)*p%upper
            else
                call random%uniform(p%lower, p%upper, value)
            end if
            if (p%whole) value = anint(min(p%upper, 6.0_dp)**chance)
        end if
        if (chance < 0.1_dp .and. .not. p%open_lower .and. .not. p%whole) value = 0.0_dp
        if (chance > 0.7_dp .and. p%computed /= "") value = ieee_value(value, ieee_quiet_nan)
    end subroutine draw

    function show_parameters(system, values) result(text)
        !! As options of `lagrangia check`.
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: values(:)
        character(:), allocatable :: text
        type(description_t) :: d
        integer :: i, j, k

        call system%describe(d)
        text = trim(d%name)
        k = 0
        do i = 1, size(d%parameters)
            do j = 1, d%parameters(i)%count
                k = k + 1
                if (j > 1) then
                    text = text//","//to_text(values(k))
                else if (values(k) <= huge(1.0_dp)) then
                    text = text//" --set "//trim(d%name)//"%"//trim(d%parameters(i)%name)//"="// &
                           to_text(values(k))
                end if
            end do
        end do
    end function show_parameters

    subroutine differs(mutant, values, difference)
        !! By how much the accelerations of a mutant are off, relative to the true ones and to
        !! the squares of the velocities: the largest at some states. A slip may do nothing at
        !! some parameters.
        class(system_t), intent(inout) :: mutant
        real(dp), intent(in) :: values(:)
        real(dp), intent(out) :: difference
        class(system_t), allocatable :: system
        type(description_t) :: d
        type(random_t) :: random
        type(error_t), allocatable :: error
        real(dp), allocatable :: q(:), v(:), a(:), b(:)
        real(dp) :: t
        integer :: i, k

        difference = 0.0_dp
        call mutant%describe(d)
        call new_system(trim(d%name), system, error)
        if (.not. allocated(error)) call system%configure(values, error)
        if (.not. allocated(error)) call mutant%configure(values, error)
        if (allocated(error)) return
        allocate (a(system%ndof), b(system%ndof))
        do k = 1, 10
            call random%state(system, t, q, v, error)
            if (allocated(error)) return
            call system%accelerations(t, q, v, a)
            call mutant%accelerations(t, q, v, b)
            do i = 1, size(a)
                if (abs(a(i) - b(i)) > 0.0_dp) then
                    difference = max(difference, &
                                     abs(a(i) - b(i))/(abs(a(i)) + abs(b(i)) + v(i)**2))
                end if
            end do
        end do
    end subroutine differs
    function coordinate_of(remark) result(name)
        !! The one that is named; of weak coupling whether an equation is wrong or the
        !! acceleration that was solved from it cannot be told.
        character(*), intent(in) :: remark
        character(:), allocatable :: name
        integer :: last

        name = remark(:max(0, index(remark, " is not that of L") - 1))
        last = index(name, "_ddot")
        if (last > 0) name = name(:last - 1)
        if (index(name, "the equation of ") == 1) name = name(17:)
    end function coordinate_of
end module extremes
