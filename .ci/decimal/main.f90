program decimal
    !! Our digits against libgfortran's, on as many doubles at random as the argument says: a third
    !! of them any bits, a third of ordinary size, a third with few decimals.
    use, intrinsic :: iso_fortran_env, only: int64, real64
    use lagrangia_decimal, only: decimal_width, write_decimal
    implicit none (type, external)
    character(decimal_width) :: ours, theirs
    character(32) :: argument
    integer(int64) :: count, i, state, wrong
    real(real64) :: x

    call get_command_argument(1, argument)
    read (argument, *) count
    state = 88172645463325252_int64
    wrong = 0
    do i = 1, count
        state = ieor(state, shiftl(state, 13))
        state = ieor(state, shiftr(state, 7))
        state = ieor(state, shiftl(state, 17))
        select case (mod(i, 3_int64))
        case (0)
            x = transfer(state, x)
        case (1)
            x = scale(real(state, real64), -60)*10.0_real64**(mod(i, 31_int64) - 15)
        case default
            x = real(ibits(state, 0, 20), real64)/10.0_real64**mod(i, 7_int64)
        end select
        call write_decimal(x, ours)
        write (theirs, "(ss, es24.16e3)") x
        if (ours == theirs) cycle
        wrong = wrong + 1
        if (wrong < 10) print "(a)", "'"//ours//"' should be '"//theirs//"'"
    end do
    print "(i0, a, i0, a)", count, " doubles, ", wrong, " of them not as libgfortran writes them"
    if (wrong > 0) stop 1
end program decimal
