program main
    !! Run every suite. A new suite takes two lines here: one `use`, one `addTest`.
    use funit, only: TestSuite, finalize, initialize, run, stub
    use test_console, only: console_suite
    use test_errors, only: errors_suite
    use test_npy, only: npy_suite
    use test_number_text, only: number_text_suite
    use test_output_failures, only: output_failures_suite
    use test_output_file, only: output_file_suite
    use test_processes, only: processes_suite
    implicit none (type, external)
    logical :: ok

    call initialize(stub)
    ok = run(load_tests)
    call finalize(stub, ok)

contains

    function load_tests() result(suite)
        !! All suites, in the order they run.
        type(TestSuite) :: suite

        suite = TestSuite("lagrangia")
        call suite%addTest(errors_suite())
        call suite%addTest(number_text_suite())
        call suite%addTest(output_file_suite())
        call suite%addTest(output_failures_suite())
        call suite%addTest(npy_suite())
        call suite%addTest(console_suite())
        call suite%addTest(processes_suite())
    end function load_tests
end program main
