module lagrangia_kinds
    !! The number kinds of the toolkit.
    !!
    !! Built with `-DREAL128`, systems and methods work in quadruple precision: `.ci/quad` makes
    !! references with it. What speaks to LAPACK, GSL or C in doubles says so by using
    !! `this_part_needs_real64`, which that build does not have, and so does not compile in it.
    use, intrinsic :: iso_fortran_env, only: int64, real128, real64
    implicit none (type, external)
    private
    public :: dp, i8, lanes, qp

    integer, parameter :: qp = real128  !! coefficients before they are rounded, and references
    integer, parameter :: i8 = int64    !! step and evaluation counters
    integer, parameter :: lanes = 8     !! states that one call takes, for vector registers
#ifdef REAL128
    integer, parameter :: dp = qp       !! working precision
#else
    integer, parameter :: dp = real64   !! working precision
    logical, parameter, public :: this_part_needs_real64 = .true.
#endif
end module lagrangia_kinds
