module test_written_rotors
    !! Bodies that turn in a system in formulas: T with their moments of inertia, what is refused,
    !! their module in Fortran.
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertTrue
    use lagrangia_audit, only: audit_system
    use lagrangia_description, only: description_t
    use lagrangia_errors, only: error_t, status_usage
    use lagrangia_fortran_module, only: write_fortran_module
    use lagrangia_fortran_statements, only: fortran_lines_t
    use lagrangia_hyperdual, only: hyperdual_t
    use lagrangia_kinds, only: dp
    use lagrangia_ledger, only: ledger_t
    use lagrangia_scene, only: scene_t
    use lagrangia_scene_reader, only: parse_scene
    use lagrangia_system, only: system_t
    use lagrangia_text, only: word_t
    use lagrangia_written_system, only: written_system_t
    use stated_text, only: is_said
    implicit none (type, external)
    private
    public :: written_rotors_suite

    character(*), parameter :: rolling = "T = 'm/2 x_dot^2 + I/2 (x_dot/R)^2' "

contains

    function written_rotors_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("written_rotors")
        call suite%addTest(TestMethod("they_are_part_of_t", they_are_part_of_t))
        call suite%addTest(TestMethod("t_without_them_is_another", t_without_them_is_another))
        call suite%addTest(TestMethod("t_is_made_of_them", t_is_made_of_them))
        call suite%addTest(TestMethod("what_is_refused", what_is_refused))
        call suite%addTest(TestMethod("their_module", their_module))
        call suite%addTest(TestMethod("places_that_are_long", places_that_are_long))
    end function written_rotors_suite

    subroutine read_disk(group, system, error)
        !! A disk that rolls on a spring.
        character(*), intent(in) :: group
        class(system_t), allocatable, intent(out) :: system
        type(error_t), allocatable, intent(out) :: error
        type(scene_t) :: scene
        type(word_t) :: none(0)

        call parse_scene("&scene system = 'disk', dt = 0.1, duration = 1, q = 0.3 / "// &
                         "&lagrangian "// &
                         "coordinates = 'x [m]' parameters = 'm', 'I', 'R', 'k' V = 'k/2 x^2' "// &
                         "positions = 'disk, m: x, R' "//group//" / &disk m = 1, I = 0.2, "// &
                         "R = 0.5, k = 3 /", "disk.nml", none, scene, system, error)
    end subroutine read_disk

    subroutine they_are_part_of_t()
        class(system_t), allocatable :: system
        type(error_t), allocatable :: error
        type(hyperdual_t) :: phi(1)
        type(description_t) :: d

        call read_disk(rolling//"rotors = 'wheel, I: x/R'", system, error)
        call assertFalse(allocated(error), "read")
        call system%angles(hyperdual_t(), [hyperdual_t(0.3_dp)], phi)
        call assertEqual(0.6_dp, phi(1)%re, 1e-15_dp)
        call system%describe(d)
        call assertEqual(0.2_dp, d%rotors(1)%mass)
        call assertEqual("I", trim(d%rotors(1)%mass_formula))
        call assertEqual("x/R", trim(d%rotors(1)%position(1)))
        call assertTrue(holds(system, "T as printed"), "T is that of mass and rotor")
    end subroutine they_are_part_of_t

    subroutine t_without_them_is_another()
        !! No rotor, and one with another angle: the audit says so.
        class(system_t), allocatable :: system
        type(error_t), allocatable :: error

        call read_disk(rolling, system, error)
        call assertFalse(holds(system, "T as printed"), "without the rotor")
        call read_disk(rolling//"rotors = 'wheel, I: 2 x/R'", system, error)
        call assertFalse(holds(system, "T as printed"), "twice the angle")
    end subroutine t_without_them_is_another

    subroutine t_is_made_of_them()
        class(system_t), allocatable :: system
        type(error_t), allocatable :: error
        type(description_t) :: d
        real(dp) :: a(1)

        call read_disk("rotors = 'wheel, I: x/R'", system, error)
        call system%describe(d)
        call assertEqual("(m + I/R^2)/2 x_dot^2", d%kinetic_energy)
        call system%accelerations(0.0_dp, [0.3_dp], [0.0_dp], a)
        call assertEqual(-0.9_dp/1.8_dp, a(1), 1e-15_dp)
    end subroutine t_is_made_of_them

    function holds(system, claim) result(yes)
        !! Is this row of the audit there, and does it hold?
        class(system_t), intent(inout) :: system
        character(*), intent(in) :: claim
        logical :: yes
        type(ledger_t) :: audit
        integer :: row

        call audit_system(system, audit)
        row = audit%row_of(claim)
        call assertTrue(row > 0, claim)
        yes = .false.
        if (row > 0) yes = audit%rows(row)%holds
    end function holds

    subroutine what_is_refused()
        character(*), parameter :: syntax = "a body that turns is written with its moment of "// &
                                            "inertia and its angle: 'pulley, I: x/R'"

        call refused("'wheel'", syntax)
        call refused("'wheel: x/R'", syntax)
        call refused("'wheel, I:'", syntax)
        call refused("', I: x/R'", syntax)
        call refused("'wheel, x: x/R'", "the moment of inertia depends on x, which is not "// &
                                        "allowed: parameters and numbers only")
        call refused("'wheel, I: x_dot/R'", "an angle depends on x_dot, which is not "// &
                                            "allowed: the time, coordinates and parameters")
        call refused("'wheel, J: x/R'", "column 8: unknown name 'J'; there are t, x, x_dot, "// &
                                        "m, I, R, k, pi")
        call refused("'wheel, I: y/R'", "column 11: unknown name 'y'; there are t, x, x_dot, "// &
                                        "m, I, R, k, pi")
        call refused("'a, I: x/R', 'a, I: x'", "the name 'a' is given twice; take another one")
    contains
        subroutine refused(texts, message)
            character(*), intent(in) :: texts, message
            class(system_t), allocatable :: system
            type(error_t), allocatable :: error

            call read_disk(rolling//"rotors = "//texts, system, error)
            call assertTrue(allocated(error), texts)
            if (.not. allocated(error)) return
            call assertEqual(status_usage, error%status)
            call assertTrue(index(error%message, "rotors") > 0 .and. &
                            is_said(error%message, message), texts//": "//error%message)
        end subroutine refused
    end subroutine what_is_refused

    subroutine their_module()
        class(system_t), allocatable :: system
        type(error_t), allocatable :: error
        type(fortran_lines_t) :: lines

        call read_disk(rolling//"rotors = 'wheel, I: x/R'", system, error)
        select type (system)
        class is (written_system_t)
            call write_fortran_module(system, "disk.nml", lines, error)
        class default
            call assertTrue(.false., "a system in formulas")
        end select
        call has("procedure :: angles")
        call has("d%rotors = [ &")
        call has('mass_point("wheel", I, "I", "x/R")]')
        call has("phi(1) = x/R")
    contains
        subroutine has(line)
            character(*), intent(in) :: line
            integer :: k

            do k = 1, size(lines%list)
                if (adjustl(lines%list(k)%text) == line) return
            end do
            call assertTrue(.false., "a line: "//line)
        end subroutine has
    end subroutine their_module

    subroutine places_that_are_long()
        !! A place that is cut off is no place: of one too long in any coordinate none is told, with
        !! the masses' formulas.
        character(:), allocatable :: long
        integer :: i

        long = "sin(1 x)"
        do i = 2, 9
            long = long//" + sin("//achar(iachar("0") + i)//" x)/"//achar(iachar("0") + i)
        end do
        call check(long//", 0", "m", "short enough")
        long = long//" + "//long//" cos(x) + "//long
        call check(long//", 0", "", "y is too long")
        call check("0, "//long, "", "z is too long")
    contains
        subroutine check(place, mass, about)
            character(*), intent(in) :: place, mass, about
            class(system_t), allocatable :: system
            type(error_t), allocatable :: error
            type(description_t) :: d
            type(scene_t) :: scene

            call parse_scene("&scene system = 'way', dt = 0.1, duration = 1, q = 0.3 / "// &
                             "&lagrangian coordinates = 'x [m]' parameters = 'm' V = '0' "// &
                             "positions = 'bob, m: x, "//place//"' / &way m = 2 /", "way.nml", &
                             [word_t ::], scene, system, error)
            call assertFalse(allocated(error), about)
            if (allocated(error)) return
            call system%describe(d)
            call assertEqual(mass, trim(d%points(1)%mass_formula), about)
        end subroutine check
    end subroutine places_that_are_long
end module test_written_rotors
