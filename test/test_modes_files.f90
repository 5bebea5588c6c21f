module test_modes_files
    !! One period of each kind of mode as a file: the numbers, the header, the script, and what is
    !! left where it cannot be written.
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertFalse, assertTrue
    use lagrangia_catalogue, only: new_system
    use lagrangia_command_line, only: command_line_t, parse_words
    use lagrangia_console, only: flush_console
    use lagrangia_description, only: description_t
    use lagrangia_errors, only: error_t, status_file
    use lagrangia_interrupt, only: catch_interrupts
    use lagrangia_kinds, only: dp
    use lagrangia_modes_command, only: modes_command
    use lagrangia_modes_files, only: prepare_modes, size_of_modes, write_mode
    use lagrangia_registry, only: options
    use lagrangia_small_oscillations, only: find_modes, is_oscillation, is_unstable, is_zero_mode, &
                                            modes_t
    use lagrangia_system, only: system_t
    use lagrangia_text, only: to_text, word_t
    use test_scratch, only: contents, exit_status, limit_file_size, new_folder, remove_file, &
                            send_stdout_to, write_file
    implicit none (type, external)
    private
    public :: modes_files_suite

    character(1), parameter :: newline = new_line("a")
    real(dp), parameter :: pi = acos(-1.0_dp)

contains

    function modes_files_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("modes_files")
        call suite%addTest(TestMethod("a_swing_is_drawn_over_its_period", swings))
        call suite%addTest(TestMethod("modes_that_do_not_swing", others))
        call suite%addTest(TestMethod("a_shape_that_turns", a_shape_that_turns))
        call suite%addTest(TestMethod("what_cannot_be_written_leaves_nothing", &
                                      what_cannot_be_written_leaves_nothing))
        call suite%addTest(TestMethod("differences_have_no_sign", differences_have_no_sign))
        call suite%addTest(TestMethod("a_shape_is_as_large_as_its_mass_makes_it", &
                                      a_shape_is_as_large_as_its_mass_makes_it))
    end function modes_files_suite

    subroutine differences_have_no_sign()
        !! Of twenty double pendulums, whose modes differ from the closed form by rounding.
        character(*), parameter :: mode = "oscillation"//newline
        character(:), allocatable :: folder, text
        real(dp) :: difference
        integer :: last, modes, status

        folder = new_folder("modes")
        call assertEqual(0, exit_status(print_modes), message="printed")
        text = contents(folder//"/out")
        modes = 0
        do
            last = index(text, mode)
            if (last == 0) exit
            read (text(last - 9:last - 1), *, iostat=status) difference
            call assertEqual(0, status, "a number: "//text(last - 9:last - 1))
            call assertTrue(difference >= 0.0_dp .and. difference < 1e-14_dp, text(:last))
            text = text(last + len(mode):)
            modes = modes + 1
        end do
        call assertEqual(40, modes, "modes")
        call assertTrue(remove_file(folder//"/out"), "what was printed")
    end subroutine differences_have_no_sign

    subroutine a_shape_is_as_large_as_its_mass_makes_it()
        !! \(u = m^{-1/2}\), 1e-10 of 1e20 kg: no rounding, for beside it there is nothing.
        character(:), allocatable :: folder

        folder = new_folder("modes")
        call assertEqual(0, exit_status(print_heavy), message="printed")
        call assertTrue(index(contents(folder//"/out"), newline//"  1.0000000000E-010"//newline) > &
                        0, contents(folder//"/out"))
        call assertTrue(remove_file(folder//"/out"), "what was printed")
    end subroutine a_shape_is_as_large_as_its_mass_makes_it

    function print_heavy() result(status)
        !! To a file; 1 if it fails.
        integer :: status
        type(error_t), allocatable :: error

        status = 1
        call send_stdout_to(new_folder("modes")//"/out")
        call modes_of("oscillator", [character(17) :: "oscillator%m=1e20", "oscillator%k=1e20"], &
                      error)
        if (allocated(error)) return
        call flush_console()
        status = 0
    end function print_heavy

    function print_modes() result(status)
        !! To a file; 1 if it fails.
        integer :: status
        type(error_t), allocatable :: error
        integer :: i

        status = 1
        call send_stdout_to(new_folder("modes")//"/out")
        do i = 1, 20
            call modes_of("double_pendulum", ["double_pendulum%l1=0."//to_text(20 + i)], error)
            if (allocated(error)) return
        end do
        call flush_console()
        status = 0
    end function print_modes

    subroutine modes_of(name, settings, error)
        !! `lagrangia modes NAME --set SETTING ...`.
        character(*), intent(in) :: name, settings(:)
        type(error_t), allocatable, intent(out) :: error
        type(command_line_t) :: line
        type(word_t) :: words(2 + 2*size(settings))
        integer :: i

        words(1)%text = "modes"
        words(2)%text = name
        do i = 1, size(settings)
            words(1 + 2*i)%text = "--set"
            words(2 + 2*i)%text = trim(settings(i))
        end do
        call parse_words(words, options, line, error)
        if (.not. allocated(error)) call modes_command(line, error)
    end subroutine modes_of

    subroutine swings()
        !! \(\omega^2 = g/\ell\), a tenth of the shape; in the two modes of the double pendulum with
        !! equal rods and bobs \(\theta_2/\theta_1 = \pm\sqrt 2\).
        real(dp), parameter :: root = sqrt(2.0_dp)
        real(dp), allocatable :: rows(:, :)
        real(dp) :: w
        integer :: j, k

        call read_mode("pendulum", [0.0_dp], 1, is_oscillation, rows)
        if (anyExceptions()) return
        w = sqrt(9.81_dp)
        do k = 0, 200
            call assertEqual([2.0_dp*pi/w*k/200, 0.1_dp*cos(2.0_dp*pi*k/200)], abs_first(rows, k), &
                             1e-14_dp, "pendulum")
        end do
        do j = 1, 2
            call read_mode("double_pendulum", [0.0_dp, 0.0_dp], j, is_oscillation, rows)
            if (anyExceptions()) return
            w = sqrt(9.81_dp*(2.0_dp + merge(-root, root, j == 1)))
            do k = 0, 200
                call assertEqual([2.0_dp*pi/w*k/200, 0.1_dp/root*cos(2.0_dp*pi*k/200), &
                                  merge(0.1_dp, -0.1_dp, j == 1)*cos(2.0_dp*pi*k/200)], &
                                 abs_first(rows, k), 1e-14_dp, "double pendulum")
            end do
        end do
    end subroutine swings

    subroutine others()
        !! The pendulum upside down over two growth times; the cart over one second.
        real(dp), allocatable :: rows(:, :)
        real(dp) :: s
        integer :: k

        call read_mode("pendulum", [pi], 1, is_unstable, rows)
        if (anyExceptions()) return
        do k = 0, 200
            s = 2.0_dp*k/200
            call assertEqual([s/sqrt(9.81_dp), pi + 0.1_dp*cosh(s)], rows(:, k + 1), 1e-13_dp, &
                             "upside down")
        end do
        call read_mode("cart_pendulum", [0.0_dp, 0.0_dp], 1, is_zero_mode, rows)
        if (anyExceptions()) return
        do k = 0, 200
            call assertEqual([k/200.0_dp, 0.1_dp*k/200.0_dp, 0.0_dp], rows(:, k + 1), 1e-14_dp, &
                             "the cart")
        end do
    end subroutine others

    subroutine a_shape_that_turns()
        !! A charge in a trap and a field along z: circles in the plane, of 0.1 m, either way.
        real(dp), allocatable :: rows(:, :)
        real(dp) :: s
        integer :: j, k

        do j = 1, 3, 2
            call read_mode("charged_particle", [0.0_dp, 0.0_dp, 0.0_dp], j, is_oscillation, rows, &
                           [1.0_dp, 1.0_dp, 0.0_dp, 0.0_dp, 0.0_dp, 0.0_dp, 0.0_dp, 1.0_dp, 2.0_dp])
            if (anyExceptions()) return
            s = rows(3, 51)  ! a quarter of a turn from (0.1, 0)
            call assertEqual(0.1_dp, abs(s), 1e-13_dp, "a circle")
            do k = 0, 200
                call assertEqual([0.1_dp*cos(2.0_dp*pi*k/200), s*sin(2.0_dp*pi*k/200), 0.0_dp], &
                                 rows(2:, k + 1), 1e-13_dp, "it turns")
            end do
            call assertEqual(merge(1.0_dp, -1.0_dp, j == 1), sign(1.0_dp, s), 0.0_dp, &
                             "slow with, fast against the field: "//to_text(j))
        end do
    end subroutine a_shape_that_turns

    pure function abs_first(rows, k) result(row)
        !! Row `k`, of the sign that the first coordinate begins with.
        real(dp), intent(in) :: rows(:, :)
        integer, intent(in) :: k
        real(dp) :: row(size(rows, 1))

        row = rows(:, k + 1)
        if (rows(2, 1) < 0.0_dp) row(2:) = -row(2:)
    end function abs_first

    subroutine read_mode(name, start, j, label, rows, parameters)
        !! Write mode `j` and read it back; header, number of rows and script are judged here.
        character(*), intent(in) :: name
        real(dp), intent(in) :: start(:)
        integer, intent(in) :: j, label
        real(dp), allocatable, intent(out) :: rows(:, :)
        real(dp), intent(in), optional :: parameters(:)
        class(system_t), allocatable :: system
        type(description_t) :: d
        type(modes_t) :: modes
        type(error_t), allocatable :: error
        character(:), allocatable :: folder, stem, text, warning
        integer :: i, n, status

        call new_system(name, system, error)
        if (present(parameters)) call system%configure(parameters, error)
        call find_modes(system, start, .true., modes, error)
        call assertFalse(allocated(error), "modes of "//name)
        if (anyExceptions()) return
        call assertEqual(label, modes%label(j), "label")
        folder = new_folder("modes_files")
        call prepare_modes(system, folder//"/"//name, warning, error)
        call write_mode(system, modes, j, folder//"/"//name, name, error)
        call assertFalse(allocated(error), "written")
        stem = name//"_mode_"//to_text(j)
        text = contents(folder//"/"//stem//".gp")
        call assertTrue(index(text, "data = folder."""//stem//".dat""") > 0, "data of the script")
        text = contents(folder//"/"//stem//".dat")
        call assertTrue(remove_file(folder//"/"//stem//".dat"), "data")
        call assertTrue(remove_file(folder//"/"//stem//".gp"), "script")
        call assertTrue(remove_file(folder), "nothing else")
        call system%describe(d)
        call assertEqual("# "//name//", mode "//to_text(j)//": omega^2 = "// &
                         to_text(modes%omega2(j) + 0.0_dp)//" s^-2", &
                         text(:index(text, newline) - 1))
        call assertTrue(index(text, newline//"# rows: 201") > 0, "rows are counted")
        n = index(text, newline//"# t[s] "//trim(d%coordinates(1)%name)//"["// &
                  trim(d%coordinates(1)%unit)//"]")
        call assertTrue(n > 0, "columns")
        if (anyExceptions()) return
        text = text(n + 1:)
        text = text(index(text, newline) + 1:)
        call assertEqual(real(system%ndof*len(text), dp), size_of_modes(system), 0.0_dp, "bytes")
        allocate (rows(1 + system%ndof, 201))
        do i = 1, 201
            read (text(:index(text, newline)), *, iostat=status) rows(:, i)
            call assertEqual(0, status, "row "//to_text(i))
            text = text(index(text, newline) + 1:)
        end do
        call assertEqual("", text, "behind the last row")
    end subroutine read_mode

    subroutine what_cannot_be_written_leaves_nothing()
        !! No room for the data, or a folder where the script is to be.
        character(:), allocatable :: folder

        folder = new_folder("modes_full")
        call assertEqual(status_file, exit_status(in_no_room), "no room")
        call assertEqual(status_file, exit_status(in_little_room), "room for half of it")
        call assertTrue(remove_file(folder), "nothing is left")
        folder = new_folder("modes_full/pendulum_mode_1.gp")
        call assertEqual(status_file, exit_status(in_much_room), "a folder")
        call assertTrue(remove_file(folder), "as it was")
        call write_file(new_folder("modes_full")//"/pendulum_mode_1.gp", "old")
        call assertEqual(0, exit_status(in_much_room), "room enough")
        folder = new_folder("modes_full")
        call assertTrue(remove_file(folder//"/pendulum_mode_1.dat"), "data")
        call assertTrue(remove_file(folder//"/pendulum_mode_1.gp"), "script")
        call assertTrue(remove_file(folder), "nothing else")
    end subroutine what_cannot_be_written_leaves_nothing

    function in_no_room() result(status)
        !! See `write_in`.
        integer :: status

        status = write_in(10)
    end function in_no_room

    function in_little_room() result(status)
        !! See `write_in`.
        integer :: status

        status = write_in(5000)
    end function in_little_room

    function in_much_room() result(status)
        !! See `write_in`.
        integer :: status

        status = write_in(1000000)
    end function in_much_room

    function write_in(room) result(status)
        !! The status of the error of a mode where a file has so many bytes; 0 if there is none.
        integer, intent(in) :: room
        integer :: status
        class(system_t), allocatable :: system
        type(modes_t) :: modes
        type(error_t), allocatable :: error

        call catch_interrupts()
        call new_system("pendulum", system, error)
        call find_modes(system, [0.0_dp], .true., modes, error)
        call limit_file_size(room)
        call write_mode(system, modes, 1, new_folder("modes_full")//"/pendulum", "pendulum", &
                        error)
        status = 0
        if (allocated(error)) status = error%status
    end function write_in
end module test_modes_files
