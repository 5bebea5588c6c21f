module lagrangia_gsl
    !! The GNU Scientific Library, touched here and in `lagrangia_gsl_odeiv` only.
    !!
    !! GSL's error handler would abort the program: it is switched off before the first call, and
    !! every status is checked.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use, intrinsic :: iso_c_binding, only: c_char, c_double, c_f_pointer, c_int, c_ptr, c_size_t
    use lagrangia_errors, only: error_t, fail, status_library, status_numbers
    use lagrangia_kinds, only: dp
    implicit none (type, external)
    private
    public :: gsl_reason, jacobi_sn_cn_dn, silence_gsl

    interface
        function gsl_set_error_handler_off() bind(c) result(old_handler)
            import :: c_ptr
            implicit none (type, external)
            type(c_ptr) :: old_handler
        end function gsl_set_error_handler_off

        function gsl_sf_elljac_e(u, m, sn, cn, dn) bind(c) result(status)
            import :: c_double, c_int
            implicit none (type, external)
            real(c_double), value :: u, m
            real(c_double), intent(out) :: sn, cn, dn
            integer(c_int) :: status
        end function gsl_sf_elljac_e

        function gsl_strerror(status) bind(c) result(message)
            import :: c_int, c_ptr
            implicit none (type, external)
            integer(c_int), value :: status
            type(c_ptr) :: message
        end function gsl_strerror

        function c_string_length(text) bind(c, name="strlen") result(length)
            import :: c_ptr, c_size_t
            implicit none (type, external)
            type(c_ptr), value :: text
            integer(c_size_t) :: length
        end function c_string_length
    end interface

    logical :: handler_is_off = .false.

contains

    subroutine jacobi_sn_cn_dn(u, k, sn, cn, dn, error)
        !! Jacobi's functions by GSL's `elljac`, of the modulus \(k\), not the parameter \(k^2\).
        !!
        !! \(1 - m\) is all GSL sees of \(k'^2\): errors grow as \(\epsilon/k'^2\), and within
        !! \(2\epsilon\) of \(m = 1\) they reach 2, which is refused. `lagrangia_elliptic` has
        !! neither limit.
        real(dp), intent(in) :: u  !! argument
        real(dp), intent(in) :: k  !! modulus, -1 to 1
        real(dp), intent(out) :: sn, cn, dn
        type(error_t), allocatable, intent(out) :: error
        real(dp) :: m
        integer(c_int) :: status

        sn = 0.0_dp
        cn = 0.0_dp
        dn = 0.0_dp
        m = k**2
        if (.not. (ieee_is_finite(u) .and. ieee_is_finite(m))) then
            call fail(error, "elljac: argument and modulus must be finite", status_numbers)
            return
        end if
        if (abs(m - 1.0_dp) < 2.0_dp*epsilon(m)) then
            call fail(error, "elljac: no digit is right this close to modulus 1", status_library)
            return
        end if
        call silence_gsl()
        status = gsl_sf_elljac_e(u, m, sn, cn, dn)
        if (status /= 0) call fail(error, "elljac: GSL says: "//gsl_reason(status), status_library)
    end subroutine jacobi_sn_cn_dn

    subroutine silence_gsl()
        type(c_ptr) :: old_handler

        if (handler_is_off) return
        old_handler = gsl_set_error_handler_off()
        handler_is_off = .true.
    end subroutine silence_gsl

    function gsl_reason(status) result(message)
        !! GSL's own words for a status.
        integer(c_int), intent(in) :: status
        character(:), allocatable :: message
        character(kind=c_char), pointer :: text(:)
        integer :: i, length

        length = int(c_string_length(gsl_strerror(status)))
        call c_f_pointer(gsl_strerror(status), text, [length])
        allocate (character(length) :: message)
        do i = 1, length
            message(i:i) = text(i)
        end do
    end function gsl_reason
end module lagrangia_gsl
