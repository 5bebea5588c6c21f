module test_mirror
    !! The mirror image of a motion is a motion, where the accelerations are odd: every method must
    !! take it in the very same steps. Signs round alike, so that there is no tolerance; a norm, a
    !! size or a criterion that has forgotten a modulus does not pass.
    use funit, only: anyExceptions, assertEqual, assertFalse, assertTrue, TestMethod, TestSuite
    use lagrangia_catalogue, only: new_system
    use lagrangia_description, only: name_length
    use lagrangia_errors, only: error_t
    use lagrangia_integrator, only: dense_integrator_t, integrator_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_methods, only: nth_adaptive, nth_integrator
    use lagrangia_system, only: system_t
    use lagrangia_text, only: to_text
    use steep_wall, only: steep_wall_t
    implicit none (type, external)
    private
    public :: mirror_suite

    type, extends(steep_wall_t) :: two_walls_t
        real(dp) :: place = 0.5_dp  !! of the wall, m
    contains
        procedure :: accelerations => between_walls
    end type two_walls_t

    character(name_length), parameter :: odd(*) = [character(name_length) :: "oscillator", &
        "pendulum", "double_pendulum", "cart_pendulum", "rotating_wire", "rotating_hoop"]
    real(dp), parameter :: q0(2) = [2.5_dp, -1.7_dp], v0(2) = [-3.1_dp, 2.2_dp]

contains

    function mirror_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("mirror")
        call suite%addTest(TestMethod("accelerations_are_odd", accelerations_are_odd))
        call suite%addTest(TestMethod("steps_by_tolerance", steps_by_tolerance))
        call suite%addTest(TestMethod("steps_over_a_kink", steps_over_a_kink))
        call suite%addTest(TestMethod("steps_of_one_length", steps_of_one_length))
    end function mirror_suite

    subroutine accelerations_are_odd()
        !! Of the systems that the other tests use, to the last bit.
        class(system_t), allocatable :: system
        type(error_t), allocatable :: error
        real(dp) :: a(2), image(2)
        integer :: i, n

        do i = 1, size(odd)
            call new_system(trim(odd(i)), system, error)
            n = system%ndof
            call system%accelerations(0.0_dp, q0(:n), v0(:n), a(:n))
            call system%accelerations(0.0_dp, -q0(:n), -v0(:n), image(:n))
            call assertTrue(all(abs(a(:n) + image(:n)) <= 0.0_dp), odd(i))
        end do
    end subroutine accelerations_are_odd

    subroutine steps_by_tolerance()
        !! States of both signs, larger than 1 and smaller: every size is relative to one of these.
        class(system_t), allocatable :: system
        class(dense_integrator_t), allocatable :: method, other
        type(error_t), allocatable :: error
        integer :: i, k, methods

        do i = 1, size(odd)
            call new_system(trim(odd(i)), system, error)
            methods = 0
            do k = 1, 100
                call nth_adaptive(k, method)
                call nth_adaptive(k, other)
                if (.not. allocated(method)) exit
                methods = k
                method%tolerance = 1e-7_dp
                other%tolerance = 1e-7_dp
                call step_both(system, method, other, trim(odd(i))//" by "//trim(method%name))
            end do
            call assertEqual(2, methods, "methods that choose their steps")
        end do
    end subroutine steps_by_tolerance

    subroutine steps_over_a_kink()
        !! Walls on both sides, where the force has a kink that the methods must notice, in all
        !! places of a step: also behind the last point at which the force is looked at.
        type(two_walls_t) :: system
        class(dense_integrator_t), allocatable :: method, other
        type(error_t), allocatable :: error
        integer :: i, k

        call system%configure([1.0_dp], error)
        do i = 1, 60
            system%place = 0.5_dp + 0.01_dp*i
            do k = 1, 2
                call nth_adaptive(k, method)
                call nth_adaptive(k, other)
                method%tolerance = 1e-9_dp
                other%tolerance = 1e-9_dp
                call step_both(system, method, other, "two walls by "//trim(method%name))
            end do
        end do
    end subroutine steps_over_a_kink

    pure subroutine between_walls(self, t, q, v, a)
        !! $$ \ddot x = -x - 3\,\mathrm{sgn}(x)\max(0, |x| - p) $$
        class(two_walls_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp), intent(out) :: a(self%ndof)

        a(1) = -q(1) - sign(3.0_dp*max(0.0_dp, abs(q(1)) - self%place), q(1))
    end subroutine between_walls

    subroutine step_both(system, method, other, what)
        !! Each step ends at the same time, in the image of the same state.
        class(system_t), intent(in) :: system
        class(dense_integrator_t), intent(inout) :: method, other
        character(*), intent(in) :: what
        type(error_t), allocatable :: error
        real(dp), dimension(system%ndof) :: q, v, q_image, v_image
        integer :: n, step

        n = system%ndof
        call method%prepare(system, error)
        call other%prepare(system, error)
        call method%start(system, 0.0_dp, q0(:n), v0(:n), 3.0_dp)
        call other%start(system, 0.0_dp, -q0(:n), -v0(:n), 3.0_dp)
        do step = 1, 1000
            if (method%t_new >= 3.0_dp) exit
            call method%step(system, error)
            call assertFalse(allocated(error), what)
            call other%step(system, error)
            call assertFalse(allocated(error), what)
            if (anyExceptions()) return
            call assertEqual(method%t_new, other%t_new, message=what//": end of a step")
            call method%state_at(method%t_new, q, v)
            call other%state_at(other%t_new, q_image, v_image)
            call assertTrue(all(abs(q + q_image) <= 0.0_dp .and. abs(v + v_image) <= 0.0_dp), &
                            what//": step "//to_text(step))
            if (anyExceptions()) return
        end do
        call assertTrue(step > 3 .and. step < 1000, what//": steps")
    end subroutine step_both

    subroutine steps_of_one_length()
        !! Iterations inside a step end at the same sweep.
        class(system_t), allocatable :: system
        class(integrator_t), allocatable :: method
        type(error_t), allocatable :: error
        real(dp), dimension(2) :: q, v, q_image, v_image
        character(:), allocatable :: what
        integer :: i, k, n, tried

        tried = 0
        do i = 1, size(odd)
            call new_system(trim(odd(i)), system, error)
            n = system%ndof
            do k = 1, 100
                call nth_integrator(k, method)
                if (.not. allocated(method)) exit
                call method%prepare(system, error)
                if (allocated(error)) cycle
                what = trim(odd(i))//" by "//trim(method%name)
                tried = tried + 1
                q = q0
                v = v0
                call method%start(system, 0.0_dp, q(:n), v(:n))
                call method%advance(system, 0.0_dp, 0.03_dp, 0_i8, 40_i8, q(:n), v(:n))
                q_image = -q0
                v_image = -v0
                call method%start(system, 0.0_dp, q_image(:n), v_image(:n))
                call method%advance(system, 0.0_dp, 0.03_dp, 0_i8, 40_i8, q_image(:n), v_image(:n))
                call assertTrue(all(abs(q + q_image) <= 0.0_dp .and. abs(v + v_image) <= 0.0_dp), &
                                what)
            end do
        end do
        call assertEqual(60, tried, "systems and methods")
    end subroutine steps_of_one_length
end module test_mirror
