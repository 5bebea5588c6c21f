module lagrangia_disk_space
    !! How much can still be written, and what to say before very much is.
    use, intrinsic :: iso_c_binding, only: c_long, c_null_char
    use lagrangia_c_library, only: c_statvfs
    use lagrangia_files, only: facts_t, folder_of, look_at
    use lagrangia_kinds, only: dp
    use lagrangia_number_text, only: fixed
    implicit none (type, external)
    private
    public :: free_space, short, space_warning

    real(dp), parameter :: much = 1e9_dp  !! bytes that nobody should be surprised by

contains

    function free_space(folder) result(bytes)
        !! Bytes that may still be written in `folder`, or in the nearest above it that exists;
        !! negative where the system does not say, or not in a way that we know.
        character(*), intent(in) :: folder  !! need not exist
        real(dp) :: bytes
        integer(c_long) :: values(32)  !! C's `struct statvfs`, which is shorter
        character(:), allocatable :: above
        type(facts_t) :: facts

        bytes = -1.0_dp
        facts = look_at("/proc/self/exe")
        if (.not. facts%found .or. storage_size(values) < 64) return  ! not Linux with long names
        above = folder
        do
            facts = look_at(above)
            if (facts%found .or. above == folder_of(above)) exit
            above = folder_of(above)
        end do
        if (c_statvfs(above//c_null_char, values) /= 0) return
        bytes = real(values(2), dp)*real(values(5), dp)  ! f_frsize, f_bavail
    end function free_space

    function space_warning(bytes, folder) result(text)
        !! A line for the user where more is to be written than there is room for, or a gigabyte
        !! and more; else nothing.
        real(dp), intent(in) :: bytes       !! that will be written at the most
        character(*), intent(in) :: folder  !! need not exist
        character(:), allocatable :: text
        real(dp) :: free

        text = ""
        free = free_space(folder)
        if (free > 0.0_dp .and. bytes > free) then  ! of no room at all the files speak themselves
            text = "up to "//short(bytes)//" are to be written, but only "//short(free)// &
                   " are free in '"//folder//"'"
        else if (bytes >= much) then
            text = "up to "//short(bytes)//" are to be written in '"//folder//"'"
            if (free >= 0.0_dp) text = text//", where "//short(free)//" are free"
        end if
    end function space_warning

    pure function short(bytes) result(text)
        !! `5.0 GB`, with one place behind the point; below a megabyte in kB.
        real(dp), intent(in) :: bytes  !! not negative
        character(:), allocatable :: text
        character(2), parameter :: units(*) = ["kB", "MB", "GB", "TB", "PB"]
        integer :: k

        k = 1
        do while (k < size(units) .and. bytes >= 999.95_dp*1e3_dp**k)
            k = k + 1
        end do
        text = fixed(bytes/1e3_dp**k, 1)//" "//units(k)
    end function short
end module lagrangia_disk_space
