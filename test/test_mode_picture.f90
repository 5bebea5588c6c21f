module test_mode_picture
    !! Modes drawn as the mechanism: rods are found, keep their lengths, and move as far as they
    !! may; each panel says its omega.
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertFalse, assertTrue
    use lagrangia_catalogue, only: new_system
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp
    use lagrangia_mode_picture, only: has_positions, mode_picture_path, write_mode_picture
    use lagrangia_mode_script, only: is_mass, is_rod, is_way
    use lagrangia_scene, only: scene_t
    use lagrangia_scene_reader, only: parse_scene
    use lagrangia_small_oscillations, only: find_modes, modes_t
    use lagrangia_system, only: system_t
    use lagrangia_text, only: word_t
    use test_scratch, only: contents, new_folder, remove_file
    implicit none (type, external)
    private
    public :: mode_picture_suite

contains

    function mode_picture_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("mode_picture")
        call suite%addTest(TestMethod("rods_stay_rods", rods_stay_rods))
        call suite%addTest(TestMethod("what_has_no_rods", what_has_no_rods))
        call suite%addTest(TestMethod("masses_at_one_place_have_no_rod", &
                                      masses_at_one_place_have_no_rod))
        call suite%addTest(TestMethod("a_panel_a_mode", a_panel_a_mode))
        call suite%addTest(TestMethod("five_panels_in_two_lines", five_panels_in_two_lines))
        call suite%addTest(TestMethod("what_stands_is_drawn_once", what_stands_is_drawn_once))
        call suite%addTest(TestMethod("carts_and_springs_are_drawn", carts_and_springs_are_drawn))
    end function mode_picture_suite

    subroutine draw(name, at, rows, script, scene_text)
        !! The rows of the picture of a system's modes, and its script.
        character(*), intent(in) :: name
        real(dp), intent(in) :: at(:)
        real(dp), allocatable, intent(out) :: rows(:, :)
        character(:), allocatable, intent(out) :: script
        character(*), intent(in), optional :: scene_text  !! of a system of its own
        class(system_t), allocatable :: system
        type(scene_t) :: scene
        type(modes_t) :: modes
        type(error_t), allocatable :: error
        character(:), allocatable :: folder, path, text
        real(dp) :: row(9)
        integer :: last, status

        allocate (rows(9, 0))
        script = ""
        if (present(scene_text)) then
            call parse_scene(scene_text, "text", [word_t ::], scene, system, error)
        else
            call new_system(name, system, error)
        end if
        call assertFalse(allocated(error), name)
        if (anyExceptions()) return
        call assertTrue(has_positions(system), name)
        call find_modes(system, at, .true., modes, error)
        call assertFalse(allocated(error), name)
        if (anyExceptions()) return
        folder = new_folder("mode_picture")
        path = mode_picture_path(folder//"/"//name)
        call assertEqual(folder//"/"//name//"_modes.dat", path)
        call write_mode_picture(system, [character(1) ::], modes, folder//"/"//name, &
                                "As it is called", error)
        call assertFalse(allocated(error), "written: "//name)
        if (anyExceptions()) return
        text = contents(path)
        script = contents(folder//"/"//name//"_modes.gp")
        call assertTrue(index(text, "# As it is called: small oscillations as the mech") > 0, text)
        call assertTrue(index(script, 'set label 1 "As it is called: ') > 0, script)
        do while (len(text) > 0)
            last = index(text, new_line("a"))
            read (text(:last), *, iostat=status) row
            if (status == 0) rows = reshape([rows, row], [9, size(rows, 2) + 1])
            text = text(last + 1:)
        end do
        call assertTrue(remove_file(path), "the data")
        call assertTrue(remove_file(folder//"/"//name//"_modes.gp"), "the script")
        call assertTrue(remove_file(folder), "nothing else is left")
    end subroutine draw

    pure function chosen(rows, mode, side, kind) result(which)
        !! The rows of that mode, side and kind.
        real(dp), intent(in) :: rows(:, :)
        integer, intent(in) :: mode, side, kind
        real(dp), allocatable :: which(:, :)
        integer :: i

        which = rows(:, pack([(i, i=1, size(rows, 2))], nint(rows(1, :)) == mode .and. &
                             nint(rows(2, :)) == side .and. nint(rows(3, :)) == kind))
    end function chosen

    subroutine rods_stay_rods()
        !! Of a double pendulum with equal rods of 1 m: from the origin to the first bob and on to
        !! the second, in every position; the bob that moves most moves by a quarter of 2 m, or an
        !! angle is 0.7 rad.
        real(dp), allocatable :: masses(:, :), rods(:, :), rows(:, :), rest(:, :)
        character(:), allocatable :: script
        real(dp) :: angles(2), moved
        integer :: mode, side

        call draw("double_pendulum", [0.0_dp, 0.0_dp], rows, script)
        if (anyExceptions()) return
        do mode = 1, 2
            rest = chosen(rows, mode, 0, is_mass)
            do side = -1, 1
                rods = chosen(rows, mode, side, is_rod)
                call assertEqual(2, size(rods, 2), message="rods")
                call assertEqual([1.0_dp, 1.0_dp], norm2(rods(7:9, :), 1), 1e-14_dp, "lengths")
                call assertEqual([0.0_dp, 0.0_dp, 0.0_dp], rods(4:6, 1), 1e-14_dp, "the pivot")
                call assertEqual(rods(4:6, 2), rods(4:6, 1) + rods(7:9, 1), 1e-14_dp, "joined")
                masses = chosen(rows, mode, side, is_mass)
                call assertEqual(masses(4:6, 2), rods(4:6, 2) + rods(7:9, 2), 1e-14_dp, "its bob")
                if (side == 0) cycle
                angles = asin(rods(7, :))
                moved = maxval(norm2(masses(4:6, :) - rest(4:6, :), 1))
                ! Linear in the amplitude: the way of a bob is an arc, an eighth of its square less.
                call assertTrue(abs(moved - 0.5_dp) < 0.5_dp**3 .or. &
                                abs(maxval(abs(angles)) - 0.7_dp) < 1e-12_dp, "far enough")
            end do
        end do
    end subroutine rods_stay_rods

    subroutine masses_at_one_place_have_no_rod()
        !! Two on a spring, and one at the end of a rod of 0.5 m that slides with them.
        real(dp), allocatable :: rods(:, :), rows(:, :)
        character(:), allocatable :: script
        integer :: side

        call draw("twins", [0.0_dp], rows, script, "&scene system = 'twins', dt = 0.1, "// &
                  "duration = 1, q = 0.1 / &lagrangian coordinates = 'x', "// &
                  "parameters = 'm', 'k', V = 'k x^2/2', "// &
                  "positions = 'a, m: x, 0', 'b, m: x, 0', 'c, m: x, 0.5' / "// &
                  "&twins m = 1, k = 2 /")
        if (anyExceptions()) return
        do side = -1, 1
            rods = chosen(rows, 1, side, is_rod)
            call assertEqual(2, size(rods, 2), message="from either twin")
            call assertEqual([0.5_dp, 0.5_dp], norm2(rods(7:9, :), 1), 1e-14_dp, "of 0.5 m")
        end do
    end subroutine masses_at_one_place_have_no_rod

    subroutine what_stands_is_drawn_once()
        !! A hoop does not swing: it is drawn at rest, and only its bead to either side.
        real(dp), allocatable :: rows(:, :)
        character(:), allocatable :: script
        integer :: side

        call draw("rotating_hoop", [0.0_dp], rows, script)
        if (anyExceptions()) return
        call assertEqual(72, size(chosen(rows, 1, 0, is_rod), 2), message="the hoop")
        do side = -1, 1
            if (side /= 0) call assertEqual(0, size(chosen(rows, 1, side, is_rod), 2), &
                                            message="no hoop at a side")
            call assertEqual(1, size(chosen(rows, 1, side, is_mass), 2), message="the bead")
        end do
    end subroutine what_stands_is_drawn_once

    subroutine carts_and_springs_are_drawn()
        !! A cart of 0.4 m by 0.16 m about its mass, with two wheels; a spring that ends at its mass
        !! and begins where it is fixed, wherever the mass is.
        real(dp), allocatable :: edges(:, :), masses(:, :), rows(:, :)
        real(dp) :: wall(-1:1)
        character(:), allocatable :: script
        integer :: k, side

        call draw("cart_pendulum", [0.0_dp, 0.0_dp], rows, script)
        if (anyExceptions()) return
        do side = -1, 1
            edges = chosen(rows, 2, side, is_rod)
            masses = chosen(rows, 2, side, is_mass)
            call assertEqual(4 + 2*72 + 1, size(edges, 2), message="four edges, wheels, a rod")
            if (size(edges, 2) < 5) return
            call assertEqual(masses(4, 1) - 0.2_dp, minval(edges(4, :4)), 1e-14_dp, "its left")
            call assertEqual(masses(4, 1) + 0.2_dp, maxval(edges(4, :4)), 1e-14_dp, "its right")
            call assertEqual(masses(5, 1) + 0.08_dp, maxval(edges(5, :4)), 1e-14_dp, "its top")
        end do
        call assertTrue(index(script, """As it is called: small oscillations""") > 0, "its title")
        call assertEqual(0, index(script, "? $4 + ") + index(script, "($5 + "), "none is shifted")
        call draw("oscillator", [0.0_dp], rows, script)
        ! The spring would cover itself: one side is drawn as far above as the other is below.
        call assertTrue(index(script, "($5 + 0.") > 0, "above: "//script)
        call assertTrue(index(script, "($5 + -0.") > 0, "below: "//script)
        call assertEqual(0, index(script, "? $4 + "), "not along the spring")
        if (anyExceptions()) return
        do side = -1, 1
            edges = chosen(rows, 1, side, is_rod)
            masses = chosen(rows, 1, side, is_mass)
            call assertEqual(2*8 + 2 + 4, size(edges, 2), message="a spring and a box")
            if (size(edges, 2) < 18) return
            wall(side) = edges(4, 1)
            call assertEqual(masses(4:6, 1), edges(4:6, 18) + edges(7:9, 18), 1e-14_dp, "its end")
            associate (length => masses(4, 1) - wall(side), half => edges(8, 2))
                call assertEqual(length*[0.1_dp, spread(0.05_dp, 1, 16), 0.1_dp], edges(7, :18), &
                                 1e-14_dp, "eight turns between straight ends")
                call assertEqual(half*[0, 1, (2*(-1)**k, k=1, 14), -1, 0], edges(8, :18), &
                                 1e-14_dp, "each as wide")
            end associate
        end do
        call assertEqual(wall(0), maxval(wall), 0.0_dp, "the wall stands")
        call assertEqual(wall(0), minval(wall), 0.0_dp, "and stands")
    end subroutine carts_and_springs_are_drawn

    subroutine what_has_no_rods()
        !! A mass on a spring; a cart that is nowhere tied to the origin, and a bead on a hoop.
        real(dp), allocatable :: masses(:, :), rods(:, :), rows(:, :)
        character(:), allocatable :: script

        call draw("oscillator", [0.0_dp], rows, script)
        if (anyExceptions()) return
        masses = chosen(rows, 1, 1, is_mass)
        call assertEqual(1, size(masses, 2))
        call assertEqual([0.25_dp, 0.0_dp, 0.0_dp], masses(4:6, 1), 1e-12_dp, "of 1 m")
        call draw("cart_pendulum", [0.0_dp, 0.0_dp], rows, script)
        if (anyExceptions()) return
        rods = chosen(rows, 2, 1, is_rod)
        call assertTrue(size(rods, 2) > 0, "from the cart to the bob")
        if (size(rods, 2) == 0) return
        rods = rods(:, [size(rods, 2)])
        call assertEqual(1.0_dp, norm2(rods(7:9, 1)), 1e-14_dp, "its length")
        call assertTrue(abs(rods(4, 1)) > 0.01_dp, "the cart moves")
        call draw("rotating_hoop", [0.0_dp], rows, script)
        if (anyExceptions()) return
        rods = chosen(rows, 1, 1, is_rod)
        call assertTrue(all(abs(norm2(rods(4:6, :), 1) - 1.0_dp) < 1e-14_dp), "only the hoop")
    end subroutine what_has_no_rods

    subroutine a_panel_a_mode()
        !! omega with four digits; what does not swing says so; the way of each mass is there.
        real(dp), allocatable :: rows(:, :)
        character(:), allocatable :: script
        character(2), parameter :: omega = char(207)//char(137)

        call draw("cart_pendulum", [0.0_dp, 0.0_dp], rows, script)
        if (anyExceptions()) return
        call assertTrue(index(script, "set title """//omega//"_{1} = 0""") > 0, script)
        call assertTrue(index(script, "set title """//omega//"_{2} = 4.429 rad/s""") > 0, script)
        call assertTrue(index(script, "set xlabel 'x (m)'; set ylabel 'y (m)'") > 0, script)
        call assertTrue(index(script, "set size ratio -1") > 0, "to scale")
        call assertEqual(48, count(nint(rows(1, :)) == 2 .and. nint(rows(3, :)) == is_way), &
                         message="24 pieces of two ways")
        call draw("pendulum", [acos(-1.0_dp)], rows, script)
        if (anyExceptions()) return
        call assertTrue(index(script, "set title ""grows by e in 0.3193 s""") > 0, script)
        call draw("pendulum", [0.0_dp], rows, script)
        call assertTrue(index(script, "set title """//omega//" = 3.132 rad/s""") > 0, script)
    end subroutine a_panel_a_mode

    subroutine five_panels_in_two_lines()
        !! The fifth stands below the first, above the lower edge.
        real(dp), allocatable :: rows(:, :)
        character(:), allocatable :: script
        real(dp) :: left(5), bottom(5), top(5)
        integer :: i

        call draw("own", [(0.0_dp, i=1, 5)], rows, script, "&scene system = 'own' dt = 0.1 "// &
                  "duration = 1 q = 5*0 / &lagrangian coordinates = 'a', 'b', 'c', 'd', 'e' "// &
                  "T = '(a_dot^2 + b_dot^2 + c_dot^2 + d_dot^2 + e_dot^2)/2' "// &
                  "V = '(a^2 + 2 b^2 + 3 c^2 + 4 d^2 + 5 e^2)/2' positions = 'A, 1: "// &
                  "a, 0', 'B, 1: 1 + b, 0', 'C, 1: 2 + c, 0', 'D, 1: 3 + d, 0', 'E, 1: 4 + e, 0' /")
        if (anyExceptions()) return
        do i = 1, 5
            left(i) = margin("set lmargin at screen ", i)
            bottom(i) = margin("set bmargin at screen ", i)
            top(i) = margin("set tmargin at screen ", i)
        end do
        call assertEqual(spread(top(1), 1, 3), top(2:4), 0.0_dp, "beside each other")
        call assertTrue(all(left(2:4) > left(1:3)), "from left to right")
        call assertEqual(left(1), left(5), 0.0_dp, "below the first")
        call assertTrue(top(5) < bottom(1), "and not over it")
        call assertTrue(top(1) < 1.0_dp .and. bottom(5) > 0.0_dp, "in the picture")
        call assertEqual(top(1) - bottom(1), top(5) - bottom(5), 2e-4_dp, "as high")
    contains
        function margin(words, which) result(value)
            !! Behind the words, at their appearance of that number.
            character(*), intent(in) :: words
            integer, intent(in) :: which
            real(dp) :: value
            integer :: at, k

            value = -1.0_dp
            at = 1
            do k = 1, which
                if (index(script(at:), words) == 0) return
                at = at + index(script(at:), words) + len(words) - 1
            end do
            read (script(at:at + 5), *) value
        end function margin
    end subroutine five_panels_in_two_lines
end module test_mode_picture
