module funit_suites
    !! Tests, and suites of them.
    use funit_messages, only: keyword_only
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
        procedure(test_i), pointer, nopass :: set_up => null()     !! runs before it
        procedure(test_i), pointer, nopass :: tear_down => null()  !! runs after it
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

    function new_test_method(name, method, unused, setUp, tearDown) result(self)
        !! The test `method`, called `name`. `setUp` runs before it; the test and `tearDown` only
        !! if that did not fail.
        character(*), intent(in) :: name
        procedure(test_i) :: method
        class(keyword_only), intent(in), optional :: unused
        procedure(test_i), optional :: setUp, tearDown
        type(TestMethod) :: self

        self%name = trim(name)
        self%method => method
        if (present(setUp)) self%set_up => setUp
        if (present(tearDown)) self%tear_down => tearDown
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
            last%set_up => aTest%set_up
            last%tear_down => aTest%tear_down
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
            self%tests(before + i) = aTest%tests(i)
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
            longer(i)%set_up => tests(i)%set_up
            longer(i)%tear_down => tests(i)%tear_down
        end do
        call move_alloc(longer, tests)
    end subroutine extend
end module funit_suites
