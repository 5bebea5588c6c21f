module funit
    !! The part of pFUnit 4's public API that the tests use, under pFUnit's own module name.
    !!
    !! Where pFUnit is installed the same tests run against it instead; see `test/pfunit`.
    !! Names, arguments, verdicts and messages are pFUnit's; what is missing here does not compile.
    use funit_claims, only: assertExceptionRaised, assertFail, assertFalse, assertIsFinite, &
                            assertIsNaN, assertSameShape, assertTrue
    use funit_equal, only: assertEqual
    use funit_exceptions, only: anyExceptions
    use funit_locations, only: SourceLocation
    use funit_order, only: assertGreaterThan, assertGreaterThanOrEqual, assertLessThan, &
                           assertLessThanOrEqual
    use funit_relative, only: assertRelativelyEqual
    use funit_runner, only: finalize, initialize, run, stub
    use funit_suites, only: TestMethod, TestSuite
    use funit_unequal, only: assertNotEqual
    implicit none (type, external)
    private
    public :: SourceLocation, TestMethod, TestSuite, finalize, initialize, run, stub
    public :: anyExceptions, assertEqual, assertExceptionRaised, assertFail, assertFalse, &
              assertGreaterThan, assertGreaterThanOrEqual, assertIsFinite, assertIsNaN, &
              assertLessThan, assertLessThanOrEqual, assertNotEqual, assertRelativelyEqual, &
              assertSameShape, assertTrue
end module funit
