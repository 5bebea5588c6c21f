module test_random_draws
    !! Numbers at random: those of one seed, and of many.
    use funit, only: TestMethod, TestSuite, assertEqual
    use lagrangia_catalogue, only: new_system
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp
    use lagrangia_random_draws, only: random_t
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: random_draws_suite

contains

    function random_draws_suite() result(suite)
        !! All tests of this file.
        type(TestSuite) :: suite

        suite = TestSuite("random_draws")
        call suite%addTest(TestMethod("numbers_of_a_seed", numbers_of_a_seed))
        call suite%addTest(TestMethod("seeds_are_independent", seeds_are_independent))
        call suite%addTest(TestMethod("fixed_values_need_both", fixed_values_need_both))
    end function random_draws_suite

    subroutine check_numbers(x)
        !! Of uniform numbers from -sqrt 3 to sqrt 3: mean 0, variance 1, no correlation of
        !! neighbours, and differences of variance 2, each within four standard errors.
        real(dp), intent(in) :: x(:)
        real(dp) :: d(size(x) - 1)

        d = x(2:) - x(:size(x) - 1)
        associate (n => real(size(x), dp))
            call assertEqual(0.0_dp, sum(x)/n, 4.0_dp/sqrt(n), "mean")
            call assertEqual(1.0_dp, sum(x**2)/n, 4.0_dp*sqrt(0.8_dp/n), "variance")
            call assertEqual(0.0_dp, sum(x(2:)*x(:size(x) - 1))/n, 4.0_dp/sqrt(n), "neighbours")
            call assertEqual(2.0_dp, sum(d**2)/n, 4.0_dp*sqrt(7.2_dp/n), "differences")
        end associate
    end subroutine check_numbers

    subroutine numbers_of_a_seed()
        !! 10,000 of them.
        type(random_t) :: random
        real(dp) :: x(10000)
        integer :: i

        call random%start(3)
        do i = 1, size(x)
            call random%uniform(-sqrt(3.0_dp), sqrt(3.0_dp), x(i))
        end do
        call check_numbers(x)
    end subroutine numbers_of_a_seed

    subroutine seeds_are_independent()
        !! The first number of each of the seeds -5000 to 4999.
        type(random_t) :: random
        real(dp) :: x(-5000:4999)
        integer :: seed

        do seed = lbound(x, 1), ubound(x, 1)
            call random%start(seed)
            call random%uniform(-sqrt(3.0_dp), sqrt(3.0_dp), x(seed))
        end do
        call check_numbers(x)
    end subroutine seeds_are_independent

    subroutine fixed_values_need_both()
        !! Which are fixed, and at what; one of these alone changes nothing.
        class(system_t), allocatable :: system
        type(error_t), allocatable :: error
        type(random_t) :: random
        real(dp), allocatable :: drawn(:), values(:)
        logical, allocatable :: all_of_them(:)

        call new_system("pendulum", system, error)
        call random%start(1)
        call random%parameters(system, .false., drawn, error)
        allocate (all_of_them(size(drawn)), source=.true.)
        call random%start(1)
        call random%parameters(system, .false., values, error, fixed=all_of_them)
        call assertEqual(drawn, values, tolerance=0.0_dp, message="which, but not at what")
        call random%start(1)
        call random%parameters(system, .false., values, error, given=0.0_dp*drawn)
        call assertEqual(drawn, values, tolerance=0.0_dp, message="at what, but not which")
    end subroutine fixed_values_need_both
end module test_random_draws
