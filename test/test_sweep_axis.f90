module test_sweep_axis
    !! Axes of a sweep: their values, their names, and what cannot be one.
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertTrue
    use lagrangia_catalogue, only: built_in, nth_system
    use lagrangia_charged_particle, only: charged_particle_t
    use lagrangia_command_line, only: word_t
    use lagrangia_description, only: description_t
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_random_draws, only: random_t
    use lagrangia_scene, only: scene_t
    use lagrangia_scene_reader, only: parse_scene
    use lagrangia_sweep, only: sweep_t
    use lagrangia_sweep_axis, only: new_sweep_axis, sweep_axis_t
    use lagrangia_system, only: system_t
    use lagrangia_text, only: to_text
    use sweep_numbers, only: make => make_sweep
    implicit none (type, external)
    private
    public :: sweep_axis_suite

    type, extends(charged_particle_t) :: underscored_t
        !! A system whose vector has an underscore in its name.
    contains
        procedure :: describe
    end type underscored_t

    character(*), parameter :: double = "&scene system = 'double_pendulum', method = 'rk4', "// &
        "dt = 0.01, duration = 3.005, q = 0.5, 0.2, v = 0.1, 0 / &double_pendulum m2 = 0.7 /"

contains

    function sweep_axis_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("sweep_axis")
        call suite%addTest(TestMethod("axes_have_their_ends", axes_have_their_ends))
        call suite%addTest(TestMethod("parameters_of_several_numbers", &
                                      parameters_of_several_numbers))
        call suite%addTest(TestMethod("components_of_vectors", components_of_vectors))
        call suite%addTest(TestMethod("an_axis_of_any_length", an_axis_of_any_length))
        call suite%addTest(TestMethod("an_axis_is_drawn_by_its_seed", an_axis_is_drawn_by_its_seed))
        call suite%addTest(TestMethod("bad_axes_are_refused", bad_axes_are_refused))
    end function sweep_axis_suite

    pure subroutine describe(self, d)
        !! `b_field` rather than `magnetic`.
        class(underscored_t), intent(in) :: self
        type(description_t), intent(out) :: d

        call self%charged_particle_t%describe(d)
        where (d%parameters%name == "magnetic") d%parameters%name = "b_field"
    end subroutine describe

    subroutine components_of_vectors()
        !! Who writes `b_field_z` means the third one, and is told how it is written.
        type(underscored_t) :: system
        type(sweep_axis_t) :: axis
        type(random_t) :: random
        type(error_t), allocatable :: error

        call new_sweep_axis(axis, "b_field_z=1:2:3", system, random, error)
        call assertTrue(allocated(error), "it is refused")
        call assertEqual("a sweep cannot change 'b_field_z'; write 'b_field(3)'", &
                         error%message)
    end subroutine components_of_vectors

    subroutine read_axis(text, axis, error, seed)
        !! An axis of the double pendulum.
        character(*), intent(in) :: text
        type(sweep_axis_t), intent(out) :: axis
        type(error_t), allocatable, intent(out) :: error
        integer, intent(in), optional :: seed
        class(system_t), allocatable :: system
        type(scene_t) :: scene
        type(word_t) :: none(0)
        type(random_t) :: random

        call parse_scene(double, "text", none, scene, system, error)
        if (allocated(error)) return
        if (present(seed)) call random%start(seed)
        call new_sweep_axis(axis, text, system, random, error)
    end subroutine read_axis

    pure function all_of(axis) result(values)
        !! The values of an axis.
        type(sweep_axis_t), intent(in) :: axis
        real(dp) :: values(axis%count)
        integer(i8) :: i

        values = [(axis%value(i), i=1, axis%count)]
    end function all_of

    subroutine axes_have_their_ends()
        !! Exactly, and what lies between by the rule; each name finds its number.
        type(sweep_axis_t) :: axis
        type(error_t), allocatable :: error
        real(dp) :: q(2), v(2), p(5)

        call read_axis("theta1 = -pi:pi/2:4", axis, error)
        call assertFalse(allocated(error), "a linear axis")
        call assertEqual(acos(-1.0_dp)*[-1.0_dp, -0.5_dp, 0.0_dp, 0.5_dp], all_of(axis), &
                         9e-16_dp, "linear")
        call assertEqual(-acos(-1.0_dp), axis%value(1_i8), 0.0_dp, "the first end")
        call assertEqual("rad", trim(axis%unit), "its unit")
        call read_axis("m1 = 1e-2 : 1e2 : 5 : log", axis, error)
        call assertFalse(allocated(error), "a logarithmic axis")
        call assertEqual([0.01_dp, 0.1_dp, 1.0_dp, 10.0_dp, 100.0_dp], all_of(axis), 1e-13_dp, &
                         "log")
        call assertEqual(100.0_dp, axis%value(5_i8), 0.0_dp, "the last end")
        call assertTrue(axis%is_parameter(), "m1 is a parameter")
        q = 0.0_dp
        v = 0.0_dp
        p = 0.0_dp
        call axis%set(2_i8, q, v, p)
        call assertEqual([0.1_dp, 0.0_dp, 0.0_dp, 0.0_dp, 0.0_dp], p, 1e-16_dp, "the first one")
        call read_axis("l2=2:2:1", axis, error)
        call axis%set(1_i8, q, v, p)
        call assertEqual(2.0_dp, p(4), 0.0_dp, "the fourth one")
        call read_axis("theta2_dot=1:3:3", axis, error)
        call axis%set(3_i8, q, v, p)
        call assertEqual([0.0_dp, 3.0_dp], v, 0.0_dp, "a velocity")
        call assertEqual("rad/s", trim(axis%unit), "a velocity's unit")
        call assertFalse(axis%is_parameter(), "a velocity is no parameter")
        call read_axis("v(1)=1:5:3", axis, error)
        call axis%set(3_i8, q, v, p)
        call assertEqual([5.0_dp, 3.0_dp], v, 0.0_dp, "a velocity by its number")
        call assertEqual([0.0_dp, 0.0_dp], q, 0.0_dp, "nothing else")
        call assertEqual("rad/s", trim(axis%unit), "its unit")
        call read_axis("q(2)=1:3:3", axis, error)
        call axis%set(2_i8, q, v, p)
        call assertEqual([0.0_dp, 2.0_dp], q, 0.0_dp, "a coordinate by its number")
        call assertFalse(axis%is_parameter(), "a coordinate is no parameter")
        call read_axis("theta1=-1.D-1:pi/2d0+.5d0:2", axis, error)
        call assertFalse(allocated(error), "exponents of doubles")
        call assertEqual([-0.1_dp, acos(0.0_dp) + 0.5_dp], all_of(axis), 1e-15_dp, "doubles")
    end subroutine axes_have_their_ends

    subroutine parameters_of_several_numbers()
        !! Each by its number, and those behind them, in every system of the catalogue: the axis
        !! changes the number of its name alone.
        class(system_t), allocatable :: system
        type(description_t) :: d
        integer :: i, j, k, place

        do i = 1, 99
            call nth_system(i, system)
            if (.not. allocated(system)) exit
            call system%describe(d)
            place = 0
            do j = 1, size(d%parameters)
                do k = 1, d%parameters(j)%count
                    place = place + 1
                    if (d%parameters(j)%count == 1) call set_by(trim(d%parameters(j)%name))
                    if (d%parameters(j)%count > 1) call set_by(trim(d%parameters(j)%name)//"("// &
                                                               to_text(k)//")")
                end do
            end do
        end do
        call assertEqual(built_in + 1, i, message="the catalogue")
    contains
        subroutine set_by(name)
            !! To 2.5, by this name.
            character(*), intent(in) :: name
            type(sweep_axis_t) :: axis
            type(random_t) :: random
            type(error_t), allocatable :: error
            real(dp) :: q(system%ndof), v(system%ndof), p(sum(d%parameters%count))
            real(dp) :: expected(size(p))

            call new_sweep_axis(axis, name//"=2.5:2.5:1", system, random, error)
            call assertFalse(allocated(error), trim(d%name)//": "//name)
            if (allocated(error)) return
            q = 0.0_dp
            v = 0.0_dp
            p = 0.0_dp
            expected = 0.0_dp
            expected(place) = 2.5_dp
            call axis%set(1_i8, q, v, p)
            call assertEqual(expected, p, 0.0_dp, trim(d%name)//": "//name)
            call assertTrue(axis%is_parameter(), trim(d%name)//": "//name)
        end subroutine set_by
    end subroutine parameters_of_several_numbers

    subroutine an_axis_of_any_length()
        !! Its values are computed, not kept: 1e15 of them would take 8 PB.
        integer(i8), parameter :: many = 10_i8**15
        type(sweep_axis_t) :: axis
        type(sweep_t) :: sweep
        type(error_t), allocatable :: error

        call read_axis("theta1=-1:3:1000000000000000", axis, error)
        call assertFalse(allocated(error), "it can be an axis")
        call assertTrue(axis%count == many, "so many values")
        call assertEqual([-1.0_dp, 1.0_dp, 3.0_dp], axis%value([1_i8, many/2, many]), 1e-14_dp, &
                         "the first, one in the middle, the last")
        call assertTrue(axis%lowest() == 1 .and. axis%highest() == many, "upwards")
        call read_axis("theta1=3:-1:7", axis, error)
        call assertTrue(axis%lowest() == 7 .and. axis%highest() == 1, "downwards")
        call make(double, ["theta1=0:1:1000000000", "theta2=0:1:1000000000"], ["theta1"], sweep, &
                  error)
        call assertFalse(allocated(error), "a grid of 1e18")
        call assertTrue(sweep%trajectories() == 10_i8**18, "1e18 trajectories")
        call assertTrue(all(sweep%places(10_i8**18 - 1) == 10_i8**9 - [0, 1]), "the last but one")
        call make(double, ["theta1=0:1:1000000000", "theta2=0:1:1000000001"], ["theta1"], sweep, &
                  error)
        call assertTrue(allocated(error), "more are refused")
        if (allocated(error)) call assertEqual("1000000000 times 1000000001 trajectories are "// &
            "too many: at most 1000000000000000000", error%message)
    end subroutine an_axis_of_any_length

    subroutine an_axis_is_drawn_by_its_seed()
        !! The same numbers by the same seed, others by another, all between the ends.
        type(sweep_axis_t) :: first, again, other
        type(error_t), allocatable :: error
        real(dp) :: drawn(1000)

        call read_axis("theta1=-1:3:1000:random", first, error, 7)
        call read_axis("theta1=-1:3:1000:random", again, error, 7)
        call read_axis("theta1=-1:3:1000:random", other, error, 8)
        call assertEqual(all_of(first), all_of(again), 0.0_dp, "the same seed")
        drawn = all_of(first)
        call assertTrue(all(abs(drawn - all_of(other)) > 0.0_dp), "another seed")
        call assertTrue(all(drawn > -1.0_dp .and. drawn < 3.0_dp), "between the ends")
        call assertEqual([minval(drawn), maxval(drawn)], [first%value(first%lowest()), &
                         first%value(first%highest())], 0.0_dp, "the smallest and the largest")
        call assertEqual(1.0_dp, sum(drawn)/1000, 4.0_dp*4.0_dp/sqrt(12.0e3_dp), &
                         "the mean, within four standard errors")
    end subroutine an_axis_is_drawn_by_its_seed

    subroutine bad_axes_are_refused()
        !! In one line that says what is wrong.
        character(*), parameter :: bad(2, 21) = reshape([character(40) :: &
            "theta1", "has no '='", &
            "theta=0:1:5", "did you mean 'theta1'?", &
            "theta1=0:1", "needs FROM:TO:COUNT", &
            "theta1=0:1:x", "a whole number of values", &
            "theta1=0:1:0", "a whole number of values", &
            "theta1=0:1:2.5", "a whole number of values", &
            "theta1=0:1:5:lin", "neither 'log' nor 'random'", &
            "theta1=0:1:5:log", "both ends must be above 0", &
            "theta1=0:1:1", "one value but two ends", &
            "theta1=1:0:1", "one value but two ends", &
            "theta1=0:1:3:log:x:y", "'log:x:y' is neither 'log' nor 'random'", &
            "theta1=1e-320:1:3:log", "too far apart", &
            "theta1=1e300:1e-10:3:log", "too far apart", &
            "theta1=-1e308:1e308:3:random", "too far apart", &
            "theta1=0: :5", "axis theta1: an end is missing", &
            "theta1=0:y:5", "axis theta1: 'y': column 1: unknown", &
            "theta1=0:1d:5", "a blank is missing", &
            "theta1=0:1d+:5", "a blank is missing", &
            "theta1=0:1/0:5", "axis theta1: '1/0' is no number", &
            "theta1=0:1:1000000000000001", "from 1 to 1000000000000000, not", &
            "theta1=0:1:100000001:random", "from 1 to 100000000, not"], [2, 21])
        type(sweep_axis_t) :: axis
        type(error_t), allocatable :: error
        integer :: i

        do i = 1, size(bad, 2)
            call read_axis(trim(bad(1, i)), axis, error)
            call assertTrue(allocated(error), "refused: "//bad(1, i))
            if (.not. allocated(error)) cycle
            call assertTrue(index(error%message, trim(bad(2, i))) > 0, &
                            trim(bad(1, i))//": "//error%message)
        end do
    end subroutine bad_axes_are_refused
end module test_sweep_axis
