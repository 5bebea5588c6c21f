module test_machine
    !! What Linux tells of the machine and of this process; nothing is asserted elsewhere.
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertTrue
    use lagrangia_kinds, only: dp
    use lagrangia_machine, only: forget_peak_memory, peak_memory, processor
    implicit none (type, external)
    private
    public :: machine_suite

contains

    function machine_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("machine")
        call suite%addTest(TestMethod("the_processor_has_a_name", the_processor_has_a_name))
        call suite%addTest(TestMethod("peak_memory_follows_what_is_held", &
                                      peak_memory_follows_what_is_held))
    end function machine_suite

    subroutine the_processor_has_a_name()
        !! Without what stands before it, and without tabs.
        character(:), allocatable :: name

        name = processor()
        call assertTrue(len(name) > 0 .and. name == trim(adjustl(name)), name)
        call assertEqual(0, scan(name, ":"//char(9)), name)
    end subroutine the_processor_has_a_name

    subroutine peak_memory_follows_what_is_held()
        !! 64e6 bytes more, each touched: to 2e6 bytes, since Linux counts pages by the dozen and
        !! late. The unit is a million bytes, not 2**20.
        real(dp), allocatable :: held(:)
        real(dp) :: before, with, after
        logical :: done

        call forget_peak_memory(done)
        if (.not. done) return
        before = peak_memory()
        allocate (held(8000000), source=1.0_dp)
        with = peak_memory()
        call assertTrue(sum(held) > 0.0_dp, "held until here")
        deallocate (held)
        call assertTrue(peak_memory() > with - 2.0_dp, "a peak stays")
        call forget_peak_memory(done)
        after = peak_memory()
        call assertEqual(64.0_dp, with - before, 2.0_dp, "64 MB more")
        call assertTrue(with - after > 10.0_dp, "it is forgotten")
        call assertFalse(before < 1.0_dp, "a process is larger than a megabyte")
    end subroutine peak_memory_follows_what_is_held
end module test_machine
