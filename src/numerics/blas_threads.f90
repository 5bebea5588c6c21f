module lagrangia_blas_threads
    !! OpenBLAS starts a thread for every core, before any program begins. At our sizes they only
    !! cost, their number changes last digits, and where memory is limited (`ulimit -v`) they keep
    !! the program from ending. It does not count cores where these two numbers of its own are set:
    !! an executable's variables take the place of a shared library's of the same name. A version
    !! that has no such variables is told at the start of the program. Other BLAS libraries have no
    !! threads, or none that start so early.
    use, intrinsic :: iso_c_binding, only: c_associated, c_f_procpointer, c_funptr, c_int, &
                                           c_null_char, c_null_ptr
    use lagrangia_c_library, only: c_dlsym
    use lagrangia_kinds, only: dp
    implicit none (type, external)
    private
    public :: blas_threads, take_blas_memory, use_one_blas_thread
    public :: cores, threads  ! private, the library would not see them

    integer(c_int), bind(c, name="blas_cpu_number") :: cores = 1_c_int     !! that it may use
    integer(c_int), bind(c, name="blas_num_threads") :: threads = 1_c_int  !! that it starts

    abstract interface
        subroutine set_number(n) bind(c)
            import :: c_int
            implicit none (type, external)
            integer(c_int), value :: n
        end subroutine set_number

        function get_number() bind(c) result(n)
            import :: c_int
            implicit none (type, external)
            integer(c_int) :: n
        end function get_number
    end interface

    interface
        subroutine dsyrk(uplo, trans, n, k, alpha, a, lda, beta, c, ldc)
            !! \(C \gets \alpha AA^\top + \beta C\).
            import :: dp
            implicit none (type, external)
            character, intent(in) :: uplo, trans
            integer, intent(in) :: n, k, lda, ldc
            real(dp), intent(in) :: alpha, a(lda, *), beta
            real(dp), intent(inout) :: c(ldc, *)
        end subroutine dsyrk
    end interface

contains

    subroutine use_one_blas_thread()
        !! For a program to call once, at its start; nothing happens where it is not OpenBLAS.
        procedure(set_number), pointer :: set
        type(c_funptr) :: address

        address = c_dlsym(c_null_ptr, "openblas_set_num_threads"//c_null_char)
        if (.not. c_associated(address)) return
        call c_f_procpointer(address, set)
        call set(1_c_int)
    end subroutine use_one_blas_thread

    subroutine take_blas_memory()
        !! For a program to call once, while there is memory: OpenBLAS takes 128 MB at the first
        !! call that does work, keeps them, and where they cannot be had it tries for ever.
        real(dp) :: one(1, 1), square(1, 1)

        one = 1.0_dp
        square = 0.0_dp
        call dsyrk("L", "N", 1, 1, 1.0_dp, one, 1, 0.0_dp, square, 1)
    end subroutine take_blas_memory

    function blas_threads() result(n)
        !! How many OpenBLAS would use; 1 where it is another BLAS.
        integer :: n
        procedure(get_number), pointer :: get
        type(c_funptr) :: address

        n = 1
        address = c_dlsym(c_null_ptr, "openblas_get_num_threads"//c_null_char)
        if (.not. c_associated(address)) return
        call c_f_procpointer(address, get)
        n = int(get())
    end function blas_threads
end module lagrangia_blas_threads
