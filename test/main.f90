module suites
    !! Every suite. A new one takes two lines: one `use`, one `addTest`.
    use funit, only: TestSuite
    use test_elliptic, only: elliptic_suite
    use test_errors, only: errors_suite
    use test_gsl, only: gsl_suite
    use test_harness, only: harness_suite
    use test_harness_order, only: harness_order_suite
    use test_hyperdual, only: hyperdual_suite
    use test_lapack, only: lapack_suite
    use test_quadrature, only: quadrature_suite
    implicit none (type, external)
    private
    public :: load_tests

contains

    function load_tests() result(suite)
        !! All suites, in the order they run.
        type(TestSuite) :: suite

        suite = TestSuite("lagrangia")
        call suite%addTest(harness_suite())
        call suite%addTest(harness_order_suite())
        call suite%addTest(errors_suite())
        call suite%addTest(hyperdual_suite())
        call suite%addTest(lapack_suite())
        call suite%addTest(elliptic_suite())
        call suite%addTest(gsl_suite())
        call suite%addTest(quadrature_suite())
    end function load_tests
end module suites

program main
    !! Run every suite; stop with status 2 if a test fails.
    use funit, only: finalize, initialize, run, stub
    use suites, only: load_tests
    implicit none (type, external)
    logical :: ok

    call initialize(stub)
    ok = run(load_tests)
    call finalize(stub, ok)
end program main
