module surroundings
    !! What every test takes for granted.
    use, intrinsic :: iso_c_binding, only: c_char, c_int, c_null_char
    use lagrangia_blas_threads, only: use_one_blas_thread
    implicit none (type, external)
    private
    public :: prepare

    ! allow(assumed-size): C takes the address of the first element
    interface
        function c_chdir(folder) bind(c, name="chdir") result(status)
            import :: c_char, c_int
            implicit none (type, external)
            character(kind=c_char), intent(in) :: folder(*)
            integer(c_int) :: status
        end function c_chdir
    end interface

contains

    subroutine prepare()
        !! One thread of BLAS, and the project's root as working directory, where
        !! `fpm test -C test/pfunit` starts two folders below it.
        logical :: there

        call use_one_blas_thread()
        inquire (file="data/scenes/pendulum.nml", exist=there)
        if (there) return
        if (c_chdir("../.."//c_null_char) /= 0) return
    end subroutine prepare
end module surroundings
