module lagrangia_resources
    !! Memory, asked for before it is needed: neither the stack nor a library's own arrays say a
    !! word where there is none (`ulimit -s`, `ulimit -v`).
    use, intrinsic :: iso_c_binding, only: c_associated, c_int, c_long, c_ptr, c_size_t
    use lagrangia_c_library, only: c_free, c_getrlimit, c_malloc
    use lagrangia_errors, only: error_t, fail, status_library
    use lagrangia_kinds, only: dp, i8
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: check_memory, check_stack

    integer(c_int), parameter :: stack = 3_c_int  !! RLIMIT_STACK

contains

    subroutine check_stack(needed, error)
        !! Fails (status 4) where the stack may not grow to so much.
        integer, intent(in) :: needed                     !! kB
        type(error_t), allocatable, intent(out) :: error  !! status 4: it may not
        integer(c_long) :: limits(2)

        if (c_getrlimit(stack, limits) /= 0) return
        if (limits(1) < 0 .or. limits(1)/1024 >= needed) return
        call fail(error, "the stack may hold "//to_text(int(limits(1)/1024))//" kB only, and "// &
                  to_text(needed)//" are needed: 'ulimit -s 8192' gives more", status_library)
    end subroutine check_stack

    subroutine check_memory(bytes, purpose, error)
        !! Fails (status 4) where so much memory cannot be had at this moment. None is taken.
        real(dp), intent(in) :: bytes                     !! how much; rounded up
        character(*), intent(in) :: purpose               !! what needs it, for the message
        type(error_t), allocatable, intent(out) :: error  !! status 4: it cannot be had
        type(c_ptr) :: memory

        if (bytes < real(huge(1_i8), dp)) then
            memory = c_malloc(ceiling(bytes, c_size_t))
            if (c_associated(memory)) then
                call c_free(memory)
                return
            end if
        end if
        call fail(error, "not enough memory: "//purpose//" needs "// &
                  to_text(ceiling(min(bytes/1e6_dp, 1e15_dp), i8))//" MB more", status_library)
    end subroutine check_memory
end module lagrangia_resources
