module test_register
    !! Systems from outside join the catalogue, or are refused and leave it as it was.
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertFalse, assertTrue
    use lagrangia_audit, only: audit_system
    use lagrangia_catalogue, only: new_system, nth_system, register_system, system_names
    use lagrangia_command_line, only: word_t
    use lagrangia_description, only: conserved, coordinate, description_t, name_length, quantity
    use lagrangia_errors, only: error_t, status_usage
    use lagrangia_kinds, only: dp
    use lagrangia_ledger, only: ledger_t
    use lagrangia_scene, only: scene_t
    use lagrangia_system, only: system_t
    use own_systems, only: own_named_t, own_pendulum_t
    use plain_system, only: plain_system_t
    use scene_runs, only: read_and_plan
    implicit none (type, external)
    private
    public :: register_suite

    type, extends(plain_system_t) :: gappy_t
        !! Its description leaves a list out.
        character(10) :: missing = ""
        integer :: named = 2  !! of its coordinates
    contains
        procedure :: describe => describe_gappy
    end type gappy_t

contains

    function register_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("register")
        call suite%addTest(TestMethod("it_joins_the_others", it_joins_the_others))
        call suite%addTest(TestMethod("taken_names_are_refused", taken_names_are_refused))
        call suite%addTest(TestMethod("malformed_names_are_refused", malformed_names_are_refused))
        call suite%addTest(TestMethod("gaps_are_refused", gaps_are_refused))
        call suite%addTest(TestMethod("lists_left_out_are_refused", lists_left_out_are_refused))
    end function register_suite

    subroutine it_joins_the_others()
        !! At the end of the list, found by its name with its defaults, in scenes with others; and
        !! audited as they are.
        type(own_pendulum_t) :: own
        character(name_length), allocatable :: before(:), after(:)
        class(system_t), allocatable :: system
        type(scene_t) :: scene
        type(ledger_t) :: audit
        type(description_t) :: d
        type(error_t), allocatable :: error
        real(dp) :: a(1), values(3)

        allocate (before, source=system_names())
        call register_system(own, error)
        call assertFalse(allocated(error), "it may join")
        allocate (after, source=system_names())
        call assertTrue(size(after) == size(before) + 1, "one more")
        if (anyExceptions()) return
        call assertTrue(all(before == after(:size(before))), "the others stay")
        call assertEqual("own_pendulum", after(size(after)))
        call new_system("own_pendulum", system, error)
        call assertFalse(allocated(error), "by its name")
        if (anyExceptions()) return
        call system%describe(d)
        values = d%parameters%value(1)
        call assertEqual([0.5_dp, 1.2_dp, 9.81_dp], values)
        call system%accelerations(0.0_dp, [0.3_dp], [0.0_dp], a)
        call assertEqual(-9.81_dp/1.2_dp*sin(0.3_dp), a(1), 1e-14_dp)
        call assertFalse(allocated(own%p), "what was handed over is as it was")
        call read_and_plan("&scene system='own_pendulum' method='verlet' dt=1e-2 "// &
                           "duration=1 q=1 columns='t','x_bob' / &own_pendulum l=2 /", "s.nml", &
                           [word_t ::], scene, system, error)
        call assertFalse(allocated(error), "in a scene")
        if (anyExceptions()) return
        call assertEqual([0.5_dp, 2.0_dp, 9.81_dp], scene%parameters)
        call nth_system(size(after), system)
        call audit_system(system, audit)
        call assertEqual(12, size(audit%rows), message="claims")
        call assertEqual(0, audit%broken(), "claims that do not hold")
        call nth_system(0, system)
        call assertFalse(allocated(system), "none before the first")
        call nth_system(size(after) + 1, system)
        call assertFalse(allocated(system), "none behind the last")
        call refused(own, "system 'own_pendulum': there is a system of that name: give yours "// &
                     "another one")
    end subroutine it_joins_the_others

    subroutine refused(system, message)
        !! Assert that it may not join for this reason, and that nothing changed.
        class(system_t), intent(in) :: system
        character(*), intent(in) :: message
        character(name_length), allocatable :: before(:), after(:)
        type(error_t), allocatable :: error

        allocate (before, source=system_names())
        call register_system(system, error)
        call assertTrue(allocated(error), "refused: "//message)
        if (.not. allocated(error)) return
        call assertEqual(message, error%message)
        call assertEqual(status_usage, error%status)
        allocate (after, source=system_names())
        call assertEqual(size(before), size(after), "nobody joined")
    end subroutine refused

    subroutine taken_names_are_refused()
        !! By the lectures' systems, by the scene itself, by the table of methods.
        call refused(own_named_t(name="double_pendulum"), "system 'double_pendulum': there is "// &
                     "a system of that name: give yours another one")
        call refused(own_named_t(name="scene"), "system 'scene': the name is reserved: give "// &
                     "yours another one")
        call refused(own_named_t(name="methods"), "system 'methods': the name is reserved: "// &
                     "give yours another one")
    end subroutine taken_names_are_refused

    subroutine malformed_names_are_refused()
        !! What a scene could not say: of the system, its parameters, its columns.
        character(*), parameter :: small = "small letters, digits and _ make one, a letter first"
        character(*), parameter :: long = "a_pendulum_whose_name_has_no_end"
        type(own_named_t) :: own

        call refused(own_named_t(name=""), "system '': '' is no name: "//small)
        call refused(own_named_t(name="Mine"), "system 'Mine': 'Mine' is no name: "//small)
        call refused(own_named_t(name="2nd"), "system '2nd': '2nd' is no name: "//small)
        call refused(own_named_t(name="a b"), "system 'a b': 'a b' is no name: "//small)
        call refused(own_named_t(name="my/own"), "system 'my/own': 'my/own' is no name: "//small)
        call refused(own_named_t(name=" own"), "system ' own': ' own' is no name: "//small)
        call refused(own_named_t(name=long), "system '"//long//"': the name is too long, or "// &
                     "was cut off: at most 31 characters")
        call refused(own_named_t(parameter="_m"), "system 'own': '_m' is no name: letters, "// &
                     "digits and _ make one, a letter first")
        call refused(own_named_t(parameter="l"), "system 'own': two parameters are called 'l'")
        call refused(own_named_t(parameter="L"), "system 'own': two parameters are called 'l'")
        call refused(own_named_t(coordinate="my angle"), "system 'own': 'my angle' is no "// &
                     "name: letters, digits and _ make one, a letter first")
        call refused(own_named_t(coordinate="t"), "system 'own': two columns are called 't'")
        own%more = [conserved("theta_dot", "1/s", "clashes", 1.0_dp)]
        call refused(own, "system 'own': two columns are called 'theta_dot'")
        own%more = [quantity("energy_drift", "1", "clashes")]
        call refused(own, "system 'own': two columns are called 'energy_drift'")
    end subroutine malformed_names_are_refused

    subroutine gaps_are_refused()
        !! No coordinates, lists left out, defaults that are not allowed.
        type(own_named_t) :: own
        type(plain_system_t) :: plain

        own%empty = .true.
        call refused(own, "system 'own': its description has no coordinates")
        call refused(plain, "system 'plain': its description has no coordinates")
        call refused(own_named_t(mass=-1.0_dp), "system 'own': own: m = -1.0 is not allowed: "// &
                     "greater than 0.0")
    end subroutine gaps_are_refused

    subroutine lists_left_out_are_refused()
        !! Each of five, and a coordinate.
        character(10), parameter :: lists(5) = [character(10) :: "notes", "equations", "points", &
                                               "quantities", "parameters"]
        integer :: i

        do i = 1, size(lists)
            call refused(gappy_t(missing=lists(i)), "system 'gappy': its description leaves "// &
                         "out '"//trim(lists(i))//"': allocate it, empty if there are none")
        end do
        call refused(gappy_t(named=0), "system 'gappy': its description has no coordinates")
        call refused(gappy_t(named=1), "system 'gappy': ndof = 2, but it describes 1 coordinate")
    end subroutine lists_left_out_are_refused

    pure subroutine describe_gappy(self, d)
        !! All lists are empty, but `missing`.
        class(gappy_t), intent(in) :: self
        type(description_t), intent(out) :: d

        d%name = "gappy"
        d%coordinates = [coordinate("x", "m", "one"), coordinate("y", "m", "the other")]
        d%coordinates = d%coordinates(:self%named)
        if (self%missing /= "notes") allocate (d%notes(0))
        if (self%missing /= "equations") allocate (d%equations(0))
        if (self%missing /= "points") allocate (d%points(0))
        if (self%missing /= "quantities") allocate (d%quantities(0))
        if (self%missing /= "parameters") allocate (d%parameters(0))
    end subroutine describe_gappy
end module test_register
