module test_film
    !! Films and reports: what a page holds is the motion, its energies, and what stands beside it.
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertFalse, assertTrue
    use lagrangia_animation, only: animate_both, scene_film
    use lagrangia_changed_scene, only: make_own_scene
    use lagrangia_channels, only: channels_t, unpacked
    use lagrangia_errors, only: error_t
    use lagrangia_film, only: film_json
    use lagrangia_frames, only: frames_t, record_frames
    use lagrangia_kinds, only: dp
    use lagrangia_observer, only: observer_t
    use lagrangia_outcome, only: outcome_t
    use lagrangia_report_page, only: report_page_t
    use lagrangia_run_plan, only: new_run_plan, run_plan_t
    use lagrangia_scene, only: scene_t
    use lagrangia_scene_reader, only: read_scene
    use lagrangia_scene_run, only: run_scene
    use lagrangia_system, only: system_t
    use lagrangia_text, only: to_text, word_t
    use test_scratch, only: contents, new_folder, remove_file, write_file
    implicit none (type, external)
    private
    public :: film_suite

contains

    function film_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("film")
        call suite%addTest(TestMethod("a_film_is_the_motion", a_film_is_the_motion))
        call suite%addTest(TestMethod("two_methods_in_one_film", two_methods_in_one_film))
        call suite%addTest(TestMethod("a_report_has_all_of_it", a_report_has_all_of_it))
        call suite%addTest(TestMethod("a_distance_without_places", a_distance_without_places))
        call suite%addTest(TestMethod("a_constant_series", a_constant_series))
    end function film_suite

    subroutine plan_scene(name, overrides, plan)
        !! A shipped scene, with up to three settings.
        character(*), intent(in) :: name, overrides(:)
        type(run_plan_t), intent(out) :: plan
        type(error_t), allocatable :: error
        type(word_t) :: words(size(overrides))
        class(system_t), allocatable :: system
        type(scene_t) :: scene
        integer :: i

        do i = 1, size(words)
            words(i)%text = trim(overrides(i))
        end do
        call read_scene("data/scenes/"//name//".nml", words, scene, system, error)
        if (.not. allocated(error)) call make_own_scene(scene, words, [character(0) ::])
        if (.not. allocated(error)) call new_run_plan(plan, scene, system, error)
        call assertFalse(allocated(error), name)
    end subroutine plan_scene

    function value(film, key) result(text)
        !! What stands behind a key, up to the next comma, bracket or line.
        character(*), intent(in) :: film, key
        character(:), allocatable :: text
        integer :: at

        text = ""
        at = index(film, '"'//key//'": ')
        call assertTrue(at > 0, key)
        if (at == 0) return
        text = film(at + len(key) + 4:)
        text = text(:scan(text, ",}]"//new_line("a")) - 1)
    end function value

    function whole(film, key) result(number)
        !! A whole number behind a key.
        character(*), intent(in) :: film, key
        integer :: number
        character(:), allocatable :: text

        text = value(film, key)
        read (text, *) number
    end function whole

    function series(film, which) result(values)
        !! A channel of a film, from 0.
        character(*), intent(in) :: film
        integer, intent(in) :: which
        real(dp), allocatable :: values(:)
        character(:), allocatable :: rest, text
        real(dp) :: high, low
        integer :: i

        rest = film(index(film, '"channels": '):)
        do i = 0, which
            rest = rest(index(rest, '{"lo": ') + 7:)
        end do
        read (rest(:index(rest, ",") - 1), *) low
        rest = rest(index(rest, '"hi": ') + 6:)
        read (rest(:index(rest, ",") - 1), *) high
        rest = rest(index(rest, '"d": "') + 6:)
        text = rest(:index(rest, '"') - 1)
        values = unpacked(text, low, high)
    end function series

    function channel_of(film, key) result(values)
        !! Of `"energy": {"c": 3}`.
        character(*), intent(in) :: film, key
        real(dp), allocatable :: values(:)

        values = series(film, number_behind(film, '"'//key//'": {"c": '))
    end function channel_of

    function number_behind(film, text) result(number)
        !! `text` is before it, a curly bracket behind it.
        character(*), intent(in) :: film, text
        integer :: number
        character(:), allocatable :: rest

        number = 0
        call assertTrue(index(film, text) > 0, text)
        if (index(film, text) == 0) return
        rest = film(index(film, text) + len(text):)
        read (rest(:index(rest, "}") - 1), *) number
    end function number_behind

    subroutine a_film_is_the_motion()
        !! A damped pendulum's angles and kinetic energies are those of its frames, to the half step
        !! of the numbers; the window is the scene's time, which its 24 frames a period can show.
        type(run_plan_t) :: plan
        type(frames_t) :: frames
        type(error_t), allocatable :: error
        character(:), allocatable :: film, text
        real(dp), allocatable :: angle(:), energy(:), kinetic(:)
        real(dp) :: last
        integer :: n

        call plan_scene("pendulum", ["pendulum%b=0.1"], plan)
        if (anyExceptions()) return
        call scene_film(plan, film, error)
        call assertFalse(allocated(error), "the film")
        if (anyExceptions()) return
        n = whole(film, "count")
        text = value(film, "end")
        read (text, *) last
        call assertEqual(20.0_dp, last, 0.0_dp, "the scene's duration")
        call assertEqual("false", value(film, "conserved"))
        call record_frames(plan%settled, plan%system, plan%closed_form, 20.0_dp, n - 1, frames, &
                           error)
        call assertFalse(allocated(error), "the frames")
        angle = series(film, number_behind(film, '"states": [[{"c": '))
        call assertEqual(n, size(angle))
        if (anyExceptions()) return
        call assertEqual(frames%q(1, :n), angle, 0.51_dp*(maxval(angle) - minval(angle))/ &
                         262143.0_dp, "the angle")
        kinetic = channel_of(film, "kinetic")
        energy = channel_of(film, "energy")
        ! m = 0.5 kg, l = 1.2 m.
        call assertEqual(0.36_dp*frames%v(1, :n)**2, kinetic, 0.51_dp*(maxval(kinetic) - &
            minval(kinetic))/262143.0_dp, "m l^2/2 theta_dot^2")
        call assertEqual(0.36_dp*frames%v(1, :n)**2 - 0.5_dp*9.81_dp*1.2_dp*cos(frames%q(1, :n)), &
                         energy, 0.51_dp*(maxval(energy) - minval(energy))/262143.0_dp, "T + V")
    end subroutine a_film_is_the_motion

    subroutine two_methods_in_one_film()
        !! The second is drawn where its own frames are, and the distance is that of the bobs; the
        !! page says which they are.
        type(run_plan_t) :: one, other
        type(frames_t) :: frames(2)
        type(error_t), allocatable :: error
        character(:), allocatable :: film, folder, page
        real(dp), allocatable :: ghost(:), distance(:), expected(:)
        integer :: n

        call plan_scene("pendulum", [character(20) :: "scene%dt=0.2", "scene%method=rk4"], one)
        call plan_scene("pendulum", [character(20) :: "scene%dt=0.1", "scene%method=verlet"], other)
        if (anyExceptions()) return
        call scene_film(one, film, error, other)
        call assertFalse(allocated(error), "the film")
        if (anyExceptions()) return
        call assertEqual('"verlet"', value(film, "reference"))
        n = whole(film, "count")
        call record_frames(one%settled, one%system, one%closed_form, 20.0_dp, n - 1, frames(1), &
                           error)
        call record_frames(other%settled, other%system, other%closed_form, 20.0_dp, n - 1, &
                           frames(2), error)
        ghost = series(film, number_behind(film, '"ghost_states": [[{"c": '))
        call assertEqual(n, size(ghost))
        if (anyExceptions()) return
        call assertEqual(frames(2)%q(1, :n), ghost, 0.51_dp*(maxval(ghost) - minval(ghost))/ &
                         262143.0_dp, "the second's angle")
        distance = series(film, whole(film, "distance"))
        expected = 2.4_dp*abs(sin(0.5_dp*(frames(1)%q(1, :n) - frames(2)%q(1, :n))))
        call assertEqual(log10(max(expected, 1e-18_dp)), distance, 1e-4_dp, "2 l |sin| of half")
        folder = new_folder("film")
        call animate_both(one, other, folder//"/a.html", error)
        call assertFalse(allocated(error), "the page")
        page = contents(folder//"/a.html")
        call assertTrue(index(page, '"rk4, dt = 0.2 s; beside it: verlet, dt = 0.1 s"') > 0, &
                        "both are named")
        call assertTrue(index(page, film) > 0, "and shown")
        call assertTrue(remove_file(folder//"/a.html"), "one file")
        call assertTrue(remove_file(folder), "nothing else is left")
    end subroutine two_methods_in_one_film

    subroutine a_distance_without_places()
        !! Where nothing has a place, the distance is that of the coordinate that differs most,
        !! whichever way.
        type(run_plan_t) :: one, other
        type(frames_t) :: frames(2)
        type(error_t), allocatable :: error
        character(:), allocatable :: film
        character(1) :: no_figure(0)
        real(dp), allocatable :: distance(:)
        real(dp) :: expected(101)

        call plan_scene("double_pendulum_formulas", ["scene%dt=0.05 "], one)
        call plan_scene("double_pendulum_formulas", ["scene%dt=0.025"], other)
        if (anyExceptions()) return
        call record_frames(one%settled, one%system, one%closed_form, 4.0_dp, 100, frames(1), error)
        call record_frames(other%settled, other%system, other%closed_form, 4.0_dp, 100, frames(2), &
                           error)
        call film_json(one%system, no_figure, frames(1), frames(2), film, error)
        call assertFalse(allocated(error), "the film")
        distance = series(film, whole(film, "distance"))
        call assertTrue(any(frames(1)%q < frames(2)%q), "below it somewhere")
        expected = maxval(abs(frames(1)%q - frames(2)%q), 1)
        call assertEqual(log10(max(expected, 1e-18_dp)), distance, tolerance=1e-4_dp, &
                         message="the largest difference of an angle")
    end subroutine a_distance_without_places

    subroutine a_constant_series()
        !! Each of its numbers is the lower bound, whichever way the page rounds.
        type(channels_t) :: channels
        integer :: which

        call channels%add([2.5_dp, 2.5_dp], which)
        call assertEqual(0, which)
        call assertTrue(index(channels%json, '"lo": 2.5') > 0, channels%json)
        call assertTrue(index(channels%json, '"d": "AAAAAA"') > 0, channels%json)
    end subroutine a_constant_series

    subroutine a_report_has_all_of_it()
        !! Titles as they read, a row and a section a scene, the film's data, a picture whose names
        !! are made different from those of others; what the lecture has of a system stands once.
        type(run_plan_t) :: plan
        type(report_page_t) :: report
        type(outcome_t) :: outcome
        type(error_t), allocatable :: error
        class(observer_t), pointer :: nobody
        character(:), allocatable :: film, folder, page, picture
        character(40) :: settings(3)
        integer :: i

        nobody => null()
        folder = new_folder("report")
        do i = 1, 2
            settings(1) = "scene%title='a < "//to_text(i)//" & b'"
            settings(2) = "scene%output='s"//to_text(i)//"'"
            settings(3) = "scene%duration=1"
            call plan_scene("pendulum", settings, plan)
            if (anyExceptions()) return
            call run_scene(plan, folder, "text", nobody, outcome, error)
            call assertFalse(allocated(error), "it runs")
            call scene_film(plan, film, error)
            call report%begin_scene(trim(plan%scene%title), outcome)
            call report%add_film(plan, film)
            picture = folder//"/p.svg"
            call write_file(picture, "<?xml?><svg width='1'><title>Gnuplot</title>"// &
                            "<g id='a'/><use xlink:href='#a'/></svg>")
            call report%add_picture(picture, "its theta", error)
            call assertFalse(allocated(error), "a picture")
            call report%add_lecture(plan)
        end do
        call report%add_picture(folder//"/none.svg", "nothing", error)
        call assertTrue(allocated(error), "no such picture")
        call report%write(folder//"/report.html", error)
        call assertFalse(allocated(error), "the page")
        page = contents(folder//"/report.html")
        call assertEqual(1, times("<h2>a &lt; 1 &amp; b</h2>"), message="its title")
        call assertEqual(1, times('<li><a href="#scene-2">a &lt; 2 &amp; b</a></li>'), &
                         message="its link")
        call assertEqual(2, times("<section id="), message="sections")
        call assertEqual(2, times("</section>"), message="which end")
        call assertEqual(2, times('<script type="application/json" class="film-data">'), &
                         message="films")
        call assertEqual(1, times("id='p1-a'/><use xlink:href='#p1-a'"), message="its names")
        call assertEqual(1, times("id='p2-a'/><use xlink:href='#p2-a'"), message="the second's")
        call assertEqual(2, times('<svg role="img" width='), message="pictures")
        call assertEqual(2, times("<title>its "//char(206)//char(184)//"</title>"), &
                         message="which say what they are")
        call assertEqual(1, times('as of <a href="#scene-1">the first scene of this system'), &
                         message="the lecture, once")
        call assertEqual(2, times(new_line("a")//"pendulum                 rk4 "), message="rows")
        call assertEqual(0, times("@BODY@"), message="gaps")
        do i = 1, 2
            call assertTrue(remove_file(folder//"/s"//to_text(i)//".dat"), "data")
            call assertTrue(remove_file(folder//"/s"//to_text(i)//".gp"), "script")
        end do
        call assertTrue(remove_file(picture), "picture")
        call assertTrue(remove_file(folder//"/report.html"), "page")
        call assertTrue(remove_file(folder), "nothing else is left")
    contains
        function times(text) result(n)
            character(*), intent(in) :: text
            integer :: n
            integer :: at, from

            n = 0
            from = 1
            do
                at = index(page(from:), text)
                if (at == 0) return
                n = n + 1
                from = from + at
            end do
        end function times
    end subroutine a_report_has_all_of_it
end module test_film
