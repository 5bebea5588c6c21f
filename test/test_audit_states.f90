module test_audit_states
    !! The states of the audit: where masses are positive, and what acts only somewhere else.
    use dragged_systems, only: slipped_cart_t
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertTrue
    use lagrangia_audit, only: audit_system
    use lagrangia_catalogue, only: new_system, system_names
    use lagrangia_description, only: description_t
    use lagrangia_errors, only: error_t
    use lagrangia_flow, only: flow_derivative
    use lagrangia_kinds, only: dp
    use lagrangia_ledger, only: ledger_t
    use lagrangia_oscillator, only: oscillator_t
    use lagrangia_pendulum, only: pendulum_t
    use lagrangia_scene, only: scene_t
    use lagrangia_scene_reader, only: parse_scene
    use lagrangia_system, only: default_values, system_t
    use lagrangia_text, only: word_t
    implicit none (type, external)
    private
    public :: audit_states_suite

contains

    function audit_states_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("audit_states")
        call suite%addTest(TestMethod("masses_that_are_negative_elsewhere", &
                                      masses_that_are_negative_elsewhere))
        call suite%addTest(TestMethod("forces_that_are_narrow", forces_that_are_narrow))
        call suite%addTest(TestMethod("a_force_on_one_coordinate_is_seen", &
                                      a_force_on_one_coordinate_is_seen))
        call suite%addTest(TestMethod("sizes_of_rates", sizes_of_rates))
        call suite%addTest(TestMethod("rates_of_a_fast_motion", rates_of_a_fast_motion))
        call suite%addTest(TestMethod("one_value_of_1e_20", one_value_of_1e_20))
        call suite%addTest(TestMethod("frequencies_too_far_apart_to_judge", &
                                      frequencies_too_far_apart_to_judge))
    end function audit_states_suite

    subroutine sizes_of_rates()
        !! Of the energy of m = 2 kg on k = 3 N/m at 0.4 m and 0.7 m/s, with terms of 1 J: the
        !! spring takes k x x_dot = 0.84 W, and the mass gives as much.
        type(oscillator_t) :: system
        type(error_t), allocatable :: error
        real(dp) :: rate, scale, noise

        call system%configure([2.0_dp, 3.0_dp, 0.0_dp, 0.0_dp, 0.0_dp], error)
        call assertFalse(allocated(error), "parameters")
        call flow_derivative(system, 0, 0.0_dp, [0.4_dp], [0.7_dp], rate, scale, noise, &
                             size_of_terms=1.0_dp)
        call assertEqual(0.0_dp, rate, 1e-12_dp, "it is conserved")
        call assertEqual(1.0_dp + 2*0.84_dp, scale, 1e-10_dp, "what adds up to that")
        call assertTrue(1e-16_dp < noise .and. noise < 1e-11_dp, "noise")
    end subroutine sizes_of_rates

    subroutine rates_of_a_fast_motion()
        !! At \(10^8\) rad/s the steps are so short that the angle does not go round: drag takes
        !! \(b\dot\theta^2\), of what gravity and the mass have beside that.
        type(pendulum_t) :: system
        type(error_t), allocatable :: error
        real(dp) :: rate, scale

        call system%configure([1.0_dp, 1.0_dp, 1e16_dp, 1e8_dp], error)
        call assertFalse(allocated(error), "parameters")
        call flow_derivative(system, 0, 0.0_dp, [0.7_dp], [1e8_dp], rate, scale)
        call assertEqual(-1e24_dp, rate, 1e-9_dp*1e24_dp, "the energy's")
    end subroutine rates_of_a_fast_motion

    subroutine audited(formulas, audit)
        !! The audit of a system in formulas, as `check` does it with a scene.
        character(*), intent(in) :: formulas
        type(ledger_t), intent(out) :: audit
        class(system_t), allocatable :: system
        type(scene_t) :: scene
        type(error_t), allocatable :: error
        type(description_t) :: d
        type(word_t) :: none(0)
        logical, allocatable :: fixed(:)
        integer :: i

        call parse_scene("&scene system = 'own', dt = 0.1, duration = 1.0, q = 0.3, v = 0.2 /"// &
                         new_line("a")//"&lagrangian coordinates = 'x', parameters = 'k', "// &
                         formulas//" /"//new_line("a")//"&own k = 1.5 /", "scene", none, scene, &
                         system, error)
        call assertFalse(allocated(error), formulas)
        if (allocated(error)) return
        call system%describe(d)
        allocate (fixed(size(default_values(d))), source=.true.)
        call audit_system(system, audit, fixed, default_values(d))
        do i = 1, size(audit%rows)
            call assertTrue(audit%rows(i)%holds, formulas//": "//trim(audit%rows(i)%name)//": "// &
                            audit%rows(i)%remark)
        end do
    end subroutine audited

    subroutine masses_that_are_negative_elsewhere()
        !! Such states are drawn again, and the audit says how many there were; where no state has
        !! a positive mass the claim does not hold.
        type(ledger_t) :: audit
        character(*), parameter :: claim = "mass matrix is positive definite"

        call audited("T = '(1 - x) x_dot^2/2', V = 'k/2 x^2'", audit)
        call assertTrue(index(audit%rows(audit%row_of(claim))%remark, &
                              "of the states drawn ") == 1, "how many")
        call audited("T = '(1/4 - x^2) x_dot^2/2', V = 'k/2 x^2'", audit)
        call audited("T = '(1 + x^2) x_dot^2/2', V = 'k/2 x^2'", audit)
        call assertEqual("", trim(audit%rows(audit%row_of(claim))%remark), "none")
    end subroutine masses_that_are_negative_elsewhere

    subroutine forces_that_are_narrow()
        !! Zero at the states that are drawn, or the same for all velocities there.
        type(ledger_t) :: audit

        call audited("T = 'x_dot^2/2', V = 'k/2 x^2', Q_x = '-0.2 tanh(100 x_dot)'", audit)
        call audited("T = 'x_dot^2/2', V = 'k/2 x^2', Q_x = '-0.2 tanh(1e6 x_dot)'", audit)
        call audited("T = 'x_dot^2/2', V = 'k/2 x^2', Q_x = '-0.2 exp(-1000 x_dot^2)'", audit)
        call audited("T = 'x_dot^2/2', V = 'k/2 x^2', Q_x = 'exp(-(9 (t - 42))^4)'", audit)
    end subroutine forces_that_are_narrow

    subroutine a_force_on_one_coordinate_is_seen()
        !! Drag on a cart, whose pendulum has no motor, and a system that denies it.
        character(*), parameter :: claim = "nonconservative says what is true"
        type(slipped_cart_t) :: system
        type(error_t), allocatable :: error
        type(ledger_t) :: audit

        system%slip = 1
        call system%configure([1.0_dp, 0.7_dp, 0.0_dp], error)
        call assertFalse(allocated(error), "parameters")
        call audit_system(system, audit, [.false., .false., .true.], [1.0_dp, 0.7_dp, 0.0_dp])
        associate (row => audit%rows(audit%row_of(claim)))
            call assertFalse(row%holds, "denied")
            call assertEqual("nonconservative is false, yet there are generalised forces", &
                             trim(row%remark))
        end associate
    end subroutine a_force_on_one_coordinate_is_seen

    subroutine one_value_of_1e_20()
        !! Masses of particles, in kg, beside lengths of the size of 1, and the like: no alarm, and
        !! the claims that need both are judged, or said not to be.
        character(32), allocatable :: names(:)
        class(system_t), allocatable :: system
        type(description_t) :: d
        type(error_t), allocatable :: error
        type(ledger_t) :: audit
        real(dp), allocatable :: values(:)
        integer :: first, i, k, row

        allocate (names, source=system_names())
        do i = 1, size(names)
            call new_system(trim(names(i)), system, error)
            call system%describe(d)
            first = 1
            do k = 1, size(d%parameters)
                associate (p => d%parameters(k))
                    if (p%count == 1 .and. .not. p%whole .and. p%upper > 1.0_dp) then
                        values = default_values(d)
                        values(first) = 1e-20_dp
                        audit = ledger_t()
                        call new_system(trim(names(i)), system, error)
                        call audit_system(system, audit, [(first == row, row=1, size(values))], &
                                          values)
                        call assertEqual(0, audit%broken(), trim(names(i))//", "//trim(p%name))
                        row = audit%row_of("Gauss's least constraint")
                        if (p%name == "m") call assertEqual(40, audit%rows(row)%states, &
                                                            trim(names(i))//", m: all states")
                        if (row == 0) row = audit%row_of("accelerations as from L")
                        if (audit%rows(row)%states < 40) then
                            row = audit%row_of("accelerations as from L")
                            call assertTrue(index(audit%rows(row)%remark, "not judged") > 0, &
                                            trim(names(i))//", "//trim(p%name)//": said")
                        end if
                    end if
                    first = first + p%count
                end associate
            end do
        end do
    end subroutine one_value_of_1e_20

    subroutine frequencies_too_far_apart_to_judge()
        !! Of a charge of 1e30 in a trap: no alarm, but a word.
        class(system_t), allocatable :: system
        type(description_t) :: d
        type(error_t), allocatable :: error
        type(ledger_t) :: audit
        real(dp), allocatable :: values(:)
        integer :: charge, row

        call new_system("charged_particle", system, error)
        call system%describe(d)
        values = default_values(d)
        do charge = 1, size(d%parameters)
            if (d%parameters(charge)%name == "charge") exit
        end do
        charge = sum(d%parameters(:charge - 1)%count) + 1
        values(charge) = 1e30_dp
        call audit_system(system, audit, [(row == charge, row=1, size(values))], values)
        call assertEqual(0, audit%broken(), message="claims that do not hold")
        row = audit%row_of("accelerations as from L")
        call assertTrue(index(audit%rows(row)%remark, "not judged") > 0, "said")
    end subroutine frequencies_too_far_apart_to_judge
end module test_audit_states
