module lagrangia_machine
    !! What Linux tells of the machine and of this process; elsewhere less is known.
    use lagrangia_kinds, only: dp
    use lagrangia_precision_curve, only: not_known
    implicit none (type, external)
    private
    public :: forget_peak_memory, peak_memory, processor

contains

    function processor() result(name)
        !! The model of the processor.
        character(:), allocatable :: name

        name = value_of("/proc/cpuinfo", "model name")
        if (name == "") name = "unknown processor"
    end function processor

    function peak_memory() result(megabytes)
        !! The most that this process has held in memory, MB of 10^6 bytes; NaN if not known.
        real(dp) :: megabytes
        character(:), allocatable :: text
        integer :: ios

        text = value_of("/proc/self/status", "VmHWM")
        read (text, *, iostat=ios) megabytes
        if (ios == 0) megabytes = megabytes*1024.0_dp/1e6_dp
        if (ios /= 0) megabytes = not_known()
    end function peak_memory

    subroutine forget_peak_memory(done)
        !! Let `peak_memory` start again from what is held now, unless Linux refuses.
        logical, intent(out) :: done  !! Linux did not refuse
        integer :: unit, ios

        open (newunit=unit, file="/proc/self/clear_refs", action="write", status="old", iostat=ios)
        done = ios == 0
        if (.not. done) return
        write (unit, "(a)", iostat=ios) "5"
        done = ios == 0
        close (unit, iostat=ios)
        done = done .and. ios == 0
    end subroutine forget_peak_memory

    function value_of(path, key) result(value)
        !! What stands behind `key` and a colon; "" if nothing does.
        character(*), intent(in) :: path, key
        character(:), allocatable :: value
        character(256) :: line
        integer :: unit, ios, colon

        value = ""
        open (newunit=unit, file=path, action="read", status="old", iostat=ios)
        if (ios /= 0) return
        do
            read (unit, "(a)", iostat=ios) line
            if (ios /= 0) exit
            colon = index(line, ":")
            if (index(line, key) /= 1 .or. colon == 0) cycle
            value = trim(adjustl(clean(line(colon + 1:))))
            exit
        end do
        close (unit)
    end function value_of

    pure function clean(text) result(plain)
        !! Tabs are blanks.
        character(*), intent(in) :: text
        character(len(text)) :: plain
        integer :: i

        plain = text
        do i = 1, len(text)
            if (iachar(text(i:i)) < 32) plain(i:i) = " "
        end do
    end function clean
end module lagrangia_machine
