module test_pages
    !! What pages are made of: figures, frames, packed numbers, texts between tags.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertTrue
    use lagrangia_catalogue, only: new_system, system_names
    use lagrangia_channels, only: channels_t, unpacked
    use lagrangia_description, only: name_length
    use lagrangia_errors, only: error_t
    use lagrangia_frames, only: add_reference, film_speed, find_pace, frames_t, record_frames, &
                                window_of
    use lagrangia_html, only: fill_template, html_text, script_json
    use lagrangia_kinds, only: dp
    use lagrangia_run_plan, only: read_run_plan, run_plan_t
    use lagrangia_scene_figure, only: figure_t, new_figure
    use lagrangia_system, only: system_t
    use lagrangia_text, only: word_t
    use random_states, only: draw_parameters, draw_state, restart_random
    implicit none (type, external)
    private
    public :: pages_suite

contains

    function pages_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("pages")
        call suite%addTest(TestMethod("rigid_parts_are_rigid", rigid_parts_are_rigid, &
                                      setUp=restart_random))
        call suite%addTest(TestMethod("packed_numbers", packed_numbers))
        call suite%addTest(TestMethod("texts_between_tags", texts_between_tags))
        call suite%addTest(TestMethod("gaps_of_a_template", gaps_of_a_template))
        call suite%addTest(TestMethod("pace_of_an_oscillator", pace_of_an_oscillator))
        call suite%addTest(TestMethod("speed_of_a_film", speed_of_a_film))
        call suite%addTest(TestMethod("frames_are_the_motion", frames_are_the_motion))
    end function pages_suite

    subroutine rigid_parts_are_rigid()
        !! Of every system's figure: rods keep their lengths, wheels and circles are round and keep
        !! their radii, the ropes together keep their length; and every place is somewhere.
        character(name_length), allocatable :: names(:)
        class(system_t), allocatable :: system
        type(figure_t) :: figure
        type(error_t), allocatable :: error
        real(dp), allocatable :: q(:), v(:), r(:, :), first(:)
        real(dp) :: t
        integer :: i, k, turn

        allocate (names, source=system_names())
        do i = 1, size(names)
            call new_system(trim(names(i)), system, error)
            call draw_parameters(system, .false.)
            allocate (q(system%ndof), v(system%ndof))
            call new_figure(system, [character(1) ::], 1.5_dp, spread(-1.0_dp, 1, size(q)), &
                            spread(2.0_dp, 1, size(q)), figure, error)
            call assertFalse(allocated(error), trim(names(i))//": its figure can be read")
            if (allocated(error)) return
            call assertTrue(size(figure%parts) > 0, trim(names(i))//" has parts")
            allocate (r(3, figure%places), first(size(figure%parts) + 1))
            do turn = 1, 5
                call draw_state(system, t, q, v)
                call figure%place(system, t, q, v, r)
                call assertTrue(all(ieee_is_finite(r)), trim(names(i))//": places are numbers")
                do k = 1, size(first)
                    if (turn == 1) first(k) = rigid(figure, r, k)
                    call assertTrue(abs(rigid(figure, r, k) - first(k)) <= &
                                    1e-12_dp*(maxval(abs(r)) + 1.0_dp), &
                                    trim(names(i))//": a rigid part changes its size")
                end do
            end do
            deallocate (q, v, r, first)
        end do
    end subroutine rigid_parts_are_rigid

    function rigid(figure, r, k) result(length)
        !! Of part k, what may not change, m; behind the last part, all ropes together.
        type(figure_t), intent(in) :: figure
        real(dp), intent(in) :: r(:, :)
        integer, intent(in) :: k
        real(dp) :: length
        real(dp) :: a(3), b(3)
        integer :: i

        length = 0.0_dp
        if (k > size(figure%parts)) then
            do i = 1, size(figure%parts)
                associate (part => figure%parts(i))
                    if (part%kind == "rope") length = length + &
                        norm2(r(:, part%at(2)) - r(:, part%at(1)))
                end associate
            end do
            return
        end if
        associate (part => figure%parts(k))
            a = r(:, part%at(1))
            select case (part%kind)
            case ("rod", "round")
                length = norm2(r(:, part%at(2)) - a)
            case ("wheel", "circle")
                b = r(:, part%at(2)) - a
                a = r(:, part%at(3)) - a
                length = norm2(a)
                call assertEqual(length, norm2(b), 1e-12_dp*(1.0_dp + maxval(abs(r))), &
                                 "round: its radii")
                call assertEqual(0.0_dp, dot_product(a, b), 1e-12_dp*(length + maxval(abs(r))) &
                                 *(1.0_dp + length), "round: a quarter apart")
            case default  ! may change
            end select
        end associate
    end function rigid

    subroutine packed_numbers()
        !! A number comes back to half a step of 2^-18 of the bounds, the bounds as they are, and a
        !! series that does not change is one number.
        type(channels_t) :: channels
        character(:), allocatable :: json
        real(dp) :: x(1000), y(1000), low, high
        integer :: i, at

        x = [(sin(0.1_dp*i) - 5.0_dp, i=1, size(x))]
        call channels%number(x, json)
        call assertEqual('{"c": 0}', json, "the first series")
        at = index(channels%json, '"d": "')
        low = minval(x)
        high = maxval(x)
        y = unpacked(channels%json(at + 6:at + 5 + 3*size(x)), low, high)
        call assertEqual(0.0_dp, maxval(abs(x - y)), 0.5000001_dp*(high - low)/262143.0_dp, &
                         "rounded to the nearest step")
        call assertEqual(low, y(minloc(x, 1)), 0.0_dp, "the lower bound")
        call assertEqual(high, y(maxloc(x, 1)), 4*spacing(high), "the upper bound")
        x = 0.25_dp
        call channels%number(x, json)
        call assertTrue(index(json, "c") == 0, "one number: "//json)
        call assertEqual(1, channels%count, "no series of equal numbers")
        x(1) = -huge(low)
        x(2) = huge(low)
        call channels%add(x, at)
        call assertEqual(1, at, "the second series, of numbers too far apart")
    end subroutine packed_numbers

    subroutine texts_between_tags()
        !! Nothing in a text begins or ends a tag, an attribute or a script.
        character(*), parameter :: nasty = "</script><!-- ""x"" & 'y'"//achar(7)//char(255)

        call assertEqual("&lt;/script&gt;&lt;!-- &quot;x&quot; &amp; &#39;y&#39;\x07\xFF", &
                         html_text(nasty), "as HTML")
        call assertEqual("\u003c/script>\u003c!-- x", script_json("</script><!-- x"), "in a script")
        call assertEqual("", script_json(""), "nothing")
    end subroutine texts_between_tags

    subroutine gaps_of_a_template()
        !! What is filled in is not looked at for other gaps.
        character(:), allocatable :: page
        type(word_t) :: texts(2)

        texts(1)%text = "@B@"
        texts(2)%text = "two"
        call fill_template("<@A@|@B@|@C@|@A@>", ["A", "B"], texts, page)
        call assertEqual("<@B@|two|@C@|@B@>", page, "each gap once")
    end subroutine gaps_of_a_template

    subroutine pace_of_an_oscillator()
        !! omega = sqrt(k/m) = 2: the means of sin^2 and cos^2 over T are 1/2 to 1/(4 omega T).
        type(run_plan_t) :: plan
        type(frames_t) :: probe
        type(error_t), allocatable :: error
        real(dp) :: omega

        call read_run_plan(plan, "data/scenes/oscillator.nml", [word_t ::], error)
        call assertFalse(allocated(error), "the scene")
        if (allocated(error)) return
        call find_pace(plan%settled, plan%system, plan%closed_form, probe, omega, error)
        call assertFalse(allocated(error), "the probe")
        call assertEqual(2.0_dp, omega, 2.0_dp/(2.0_dp*20.0_dp), "rad/s")
    end subroutine pace_of_an_oscillator

    subroutine speed_of_a_film()
        !! Real time where that can be followed; else slower, faster, or less of it.
        call assertEqual(1.0_dp, film_speed(20.0_dp, 3.0_dp), 0.0_dp, "a pendulum")
        call assertEqual(1e-8_dp, film_speed(3e-7_dp, 6e8_dp), 1e-22_dp, "a charge, slow motion")
        call assertEqual(1e6_dp, film_speed(5e7_dp, 5e-7_dp), 1e-8_dp, "a planet, time lapse")
        call assertEqual(0.2_dp, film_speed(1.0_dp, 2.0_dp), 1e-15_dp, "over in a second")
        call assertEqual(5.0_dp, film_speed(300.0_dp, 0.0_dp), 1e-13_dp, "nothing moves")
        ! where 1, 2 or 5 takes over: at sqrt(2), sqrt(10), sqrt(50) and their tenths
        call assertEqual(1.0_dp, film_speed(84.8_dp, 0.0_dp), 1e-14_dp, "of 60 s: 1.413")
        call assertEqual(2.0_dp, film_speed(84.9_dp, 0.0_dp), 1e-14_dp, "of 60 s: 1.415")
        call assertEqual(0.5_dp, film_speed(3.53_dp, 3.0_dp), 1e-14_dp, "less than 4 s: 0.706")
        call assertEqual(1.0_dp, film_speed(3.54_dp, 3.0_dp), 1e-14_dp, "less than 4 s: 0.708")
        call assertEqual(1.0_dp, film_speed(4.01_dp, 3.0_dp), 0.0_dp, "more than 4 s")
        call assertEqual(1.0_dp, film_speed(10.0_dp, 11.9_dp), 0.0_dp, "fast, but to be followed")
        call assertEqual(0.5_dp, film_speed(10.0_dp, 12.1_dp), 1e-14_dp, "of 5 rad/s: 0.413")
        call assertEqual(0.5_dp, film_speed(10.0_dp, 15.8_dp), 1e-14_dp, "of 5 rad/s: 0.3165")
        call assertEqual(0.2_dp, film_speed(10.0_dp, 15.83_dp), 1e-14_dp, "of 5 rad/s: 0.3159")
        call assertEqual(50.0_dp, film_speed(6000.0_dp, 0.758_dp), 1e-12_dp, "24 rad/s: 31.66")
        call assertEqual(20.0_dp, film_speed(6000.0_dp, 0.76_dp), 1e-12_dp, "24 rad/s: 31.58")
        call assertEqual(20.0_dp, window_of(20.0_dp, 3.0_dp, 4000), 0.0_dp, "all of it")
        call assertEqual(200.0_dp, window_of(2000.0_dp, 5.0_dp, 4000), 1e-10_dp, "its beginning")
        call assertEqual(1047.0_dp, window_of(1047.0_dp, 1.0_dp, 4000), 0.0_dp, "of 1047.2 s")
        call assertEqual(1000.0_dp, window_of(1048.0_dp, 1.0_dp, 4000), 1e-10_dp, "of 1047.2 s")
        call assertEqual(500.0_dp, window_of(2000.0_dp, 1.309_dp, 4000), 1e-10_dp, "not 1000 s")
    end subroutine speed_of_a_film

    subroutine frames_are_the_motion()
        !! Of the scene's own method, at equal times, with the closed form beside it.
        type(run_plan_t) :: plan
        type(frames_t) :: frames, reference
        type(error_t), allocatable :: error
        character(:), allocatable :: title

        call read_run_plan(plan, "data/scenes/pendulum.nml", [word_t ::], error)
        call assertFalse(allocated(error), "the scene")
        if (allocated(error)) return
        call record_frames(plan%settled, plan%system, plan%closed_form, 20.0_dp, 777, frames, error)
        call assertFalse(allocated(error), "the run")
        call assertEqual(778, frames%count, "both ends")
        call assertEqual(20.0_dp, frames%t(778), 0.0_dp, "the end")
        call add_reference(plan%settled, plan%system, plan%closed_form, frames, reference, title)
        call assertEqual("closed form", title, "what stands beside")
        call assertEqual(778, reference%count, "the same times")
        call assertEqual(0.0_dp, maxval(abs(frames%q - reference%q)), 1e-9_dp, &
                         "the scene's own tolerance")
        call assertTrue(maxval(abs(frames%q - reference%q)) > 0.0_dp, "two motions, not one")
    end subroutine frames_are_the_motion
end module test_pages
