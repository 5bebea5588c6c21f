module lagrangia_kinds
    !! The number kinds of the toolkit.
    use, intrinsic :: iso_fortran_env, only: int64, real128, real64
    implicit none (type, external)
    private
    public :: dp, i8, qp

    integer, parameter :: dp = real64   !! working precision
    integer, parameter :: qp = real128  !! coefficients before they are rounded, and references
    integer, parameter :: i8 = int64    !! step and evaluation counters
end module lagrangia_kinds
