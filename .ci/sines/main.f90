program sines
    !! The sine and cosine of `lagrangia_sine_cosine` beside those of quadruple precision.
    !!
    !!     sines COUNT     as many angles: a quarter each in one turn, up to `largest_angle`, of all
    !!                     sizes, and next to multiples of pi/2
    !!
    !! The largest difference, in units in the last place of the exact value, must be below one.
    use, intrinsic :: iso_fortran_env, only: error_unit, output_unit
    use lagrangia_kinds, only: dp, i8, lanes, qp
    use lagrangia_sine_cosine, only: largest_angle, sine_cosine
    implicit none (type, external)

    real(dp), parameter :: pi = acos(-1.0_dp)
    character(*), parameter :: kinds(0:3) = [character(25) :: "in one turn", &
        "up to the largest angle", "of all sizes", "next to multiples of pi/2"]
    character(20) :: word
    real(dp), dimension(lanes) :: x, sine, cosine
    real(dp) :: worst(0:3), where_worst(0:3)
    integer, allocatable :: seed(:)
    integer(i8) :: block, count
    integer :: i, kind, n

    call get_command_argument(1, word)
    read (word, *) count
    call random_seed(size=n)
    allocate (seed(n), source=1)
    call random_seed(put=seed)
    worst = 0.0_dp
    where_worst = 0.0_dp
    do block = 1, (count + lanes - 1)/lanes
        kind = int(modulo(block, 4_i8))
        call draw(kind, x)
        call sine_cosine(x, sine, cosine)
        do i = 1, lanes
            call judge(x(i), sine(i), sin(real(x(i), qp)))
            call judge(x(i), cosine(i), cos(real(x(i), qp)))
        end do
    end do
    do kind = 0, 3
        write (output_unit, "(ss, a, t30, f7.4, a, es24.16)") kinds(kind), worst(kind), &
            " units in the last place, at", where_worst(kind)
    end do
    if (.not. all(worst < 1.0_dp)) then
        write (error_unit, "(a)") "not below one unit in the last place"
        error stop 1
    end if

contains

    subroutine draw(kind, x)
        !! Eight angles of one of the kinds.
        integer, intent(in) :: kind
        real(dp), intent(out) :: x(lanes)
        real(dp) :: r(lanes), more(lanes)

        call random_number(r)
        call random_number(more)
        select case (kind)
        case (0); x = pi*(2.0_dp*r - 1.0_dp)
        case (1); x = largest_angle*(2.0_dp*r - 1.0_dp)
        case (2); x = sign(largest_angle*10.0_dp**(-20.0_dp*r), more - 0.5_dp)
        case default
            x = anint((2.0_dp*r - 1.0_dp)*largest_angle/(pi/2.0_dp))*(pi/2.0_dp)
            x = x*(1.0_dp + anint(8.0_dp*(more - 0.5_dp))*epsilon(x))
            x = max(-largest_angle, min(largest_angle, x))
        end select
    end subroutine draw

    subroutine judge(x, value, exact)
        !! How far a value is off.
        real(dp), intent(in) :: x, value
        real(qp), intent(in) :: exact
        real(dp) :: off

        off = 0.0_dp
        if (abs(exact) > 0.0_qp) off = real(abs(value - exact)/spacing(real(abs(exact), dp)), dp)
        if (off <= worst(kind)) return
        worst(kind) = off
        where_worst(kind) = x
    end subroutine judge
end program sines
