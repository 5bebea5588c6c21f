module funit_suites
    !! Tests, and suites of them.
    implicit none (type, external)
    private
    public :: TestMethod, TestSuite, test_i

    abstract interface
        subroutine test_i()
            !! A test: it asserts, and returns.
            implicit none (type, external)
        end subroutine test_i
    end interface

    type :: TestMethod
        !! A test and its name.
        character(:), allocatable :: name
        procedure(test_i), pointer, nopass :: method => null()
    end type TestMethod

    interface TestMethod
        module procedure new_test_method
    end interface TestMethod

    type :: TestSuite
        !! Tests in the order they were added; suites added are taken apart.
        character(:), allocatable :: name
        type(TestMethod), allocatable :: tests(:)
    contains
        procedure, private :: add_method, add_suite
        generic :: addTest => add_method, add_suite
    end type TestSuite

    interface TestSuite
        module procedure new_test_suite
    end interface TestSuite

contains

    function new_test_method(name, method) result(self)
        !! The test `method`, called `name`.
        character(*), intent(in) :: name
        procedure(test_i) :: method
        type(TestMethod) :: self

        self%name = trim(name)
        self%method => method
    end function new_test_method

    function new_test_suite(name) result(self)
        !! An empty suite.
        character(*), intent(in) :: name
        type(TestSuite) :: self

        self%name = trim(name)
        allocate (self%tests(0))
    end function new_test_suite

    subroutine add_method(self, aTest)
        !! Add a test, under the suite's name.
        class(TestSuite), intent(inout) :: self
        type(TestMethod), intent(in) :: aTest

        call extend(self%tests, 1)
        associate (last => self%tests(size(self%tests)))
            last%name = self%name//"."//aTest%name
            last%method => aTest%method
        end associate
    end subroutine add_method

    subroutine add_suite(self, aTest)
        !! Add the tests of a suite, under their own names.
        class(TestSuite), intent(inout) :: self
        type(TestSuite), intent(in) :: aTest
        integer :: before, i

        before = size(self%tests)
        call extend(self%tests, size(aTest%tests))
        do i = 1, size(aTest%tests)
            self%tests(before + i)%name = aTest%tests(i)%name
            self%tests(before + i)%method => aTest%tests(i)%method
        end do
    end subroutine add_suite

    subroutine extend(tests, by)
        !! Make room for `by` more tests.
        type(TestMethod), allocatable, intent(inout) :: tests(:)
        integer, intent(in) :: by
        type(TestMethod), allocatable :: longer(:)
        integer :: i

        allocate (longer(size(tests) + by))
        do i = 1, size(tests)
            call move_alloc(tests(i)%name, longer(i)%name)
            longer(i)%method => tests(i)%method
        end do
        call move_alloc(longer, tests)
    end subroutine extend
end module funit_suites
