module lagrangia_method_orders
    !! The order of each method, measured on nonlinear motions that are known in closed form.
    use lagrangia_cart_pendulum, only: cart_pendulum_t
    use lagrangia_charged_particle, only: charged_particle_t
    use lagrangia_errors, only: error_t
    use lagrangia_integrator, only: integrator_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_ledger, only: ledger_t
    use lagrangia_methods, only: nth_integrator
    use lagrangia_number_text, only: fixed
    use lagrangia_pendulum, only: pendulum_t
    use lagrangia_reference, only: reference_t
    use lagrangia_system, only: system_t
    use lagrangia_text, only: to_text
    use lagrangia_vectors, only: farthest
    implicit none (type, external)
    private
    public :: audit_methods, method_run
    public :: new_problem, problems, refuses

    integer, parameter :: problems = 3  !! the last has a magnetic field
    character(*), parameter :: problem_names(problems) = [character(16) :: &
        "pendulum", "cart_pendulum", "charged_particle"]

    type :: measured_t
        !! From one number of steps and twice as many.
        real(dp) :: order = 0.0_dp
        real(dp) :: energy_order = 0.0_dp
        real(dp) :: error(2) = 0.0_dp       !! against the closed form
        real(dp) :: change(2) = 0.0_dp       !! largest relative change of the energy
        integer(i8) :: steps = 0
    end type measured_t

contains

    subroutine audit_methods(audit)
        !! A row for each method of fixed step, over the problems that it takes, and one for its
        !! energy error.
        type(ledger_t), intent(inout) :: audit  !! gets the rows
        class(integrator_t), allocatable :: method
        integer :: i

        call audit%section("methods")
        i = 0
        do
            i = i + 1
            call nth_integrator(i, method)
            if (.not. allocated(method)) exit
            call audit_method(method, audit)
        end do
    end subroutine audit_methods

    subroutine audit_method(method, audit)
        !! One method. Beyond order 8 rounding hides the order on a single motion: there ten small
        !! swings of a pendulum are taken together, and the next term of the error is felt more.
        class(integrator_t), intent(inout) :: method
        type(ledger_t), intent(inout) :: audit
        type(measured_t) :: m
        class(system_t), allocatable :: system
        real(dp), allocatable :: q(:), v(:)
        real(dp), parameter :: rounding = 1e-13_dp  !! of the energy
        character(:), allocatable :: claim
        integer :: k

        if (method%order > 8) then
            call high_order(method, m)
            claim = trim(method%name)//": order "//to_text(method%order)
            call audit%try(claim, abs(m%order - method%order), 0.05_dp, 20.0_dp)
            call audit%say(claim, "measured "//fixed(m%order, 3)//" on pendulum")
            return
        end if
        do k = 1, problems
            call new_problem(k, system, q, v)
            if (refuses(method, system)) cycle
            call measure_order(method, system, q, v, m)
            claim = trim(method%name)//": order "//to_text(method%order)
            call audit%try(claim, abs(m%order - method%order), 0.02_dp, 5.0_dp)
            call append(claim, m%order)
            if (method%energy_order == 0 .or. m%change(1) < rounding) cycle
            claim = trim(method%name)//": energy "//to_text(method%energy_order)
            ! near rounding the order is seen from one side only
            if (m%change(2) <= 10.0_dp*rounding) m%energy_order = &
                min(m%energy_order, real(method%energy_order, dp))
            call audit%try(claim, abs(m%energy_order - method%energy_order), 0.02_dp, 5.0_dp)
            call append(claim, m%energy_order)
        end do
    contains
        subroutine append(claim, order)
            character(*), intent(in) :: claim
            real(dp), intent(in) :: order

            associate (row => audit%rows(audit%row_of(claim)))
                row%remark = trim(row%remark)//merge("measured ", ",        ", row%remark == "")
                row%remark = trim(row%remark)//" "//fixed(order, 3)//" on "//trim(problem_names(k))
            end associate
        end subroutine append
    end subroutine audit_method

    subroutine measure_order(method, system, q, v, m)
        !! From the smallest power of two, from 32 steps on, whose error is small enough for the
        !! leading term to rule.
        class(integrator_t), intent(inout) :: method  !! that is measured; prepared here
        class(system_t), intent(in) :: system  !! with its parameters
        real(dp), intent(in) :: q(:), v(:)  !! the start
        type(measured_t), intent(out) :: m  !! the order, and what it is from
        real(dp) :: small

        small = merge(10.0_dp**(-4 - method%order), 1e-6_dp, method%order < 6)
        m%steps = 16
        do
            m%steps = 2*m%steps
            call method_run(method, system, q, v, m%steps, m%error(1), m%change(1))
            if (m%error(1) < small .or. m%steps > 100000) exit
        end do
        call method_run(method, system, q, v, 2*m%steps, m%error(2), m%change(2))
        m%order = log(m%error(1)/m%error(2))/log(2.0_dp)
        m%energy_order = log((m%change(1) + tiny(small))/(m%change(2) + tiny(small)))/log(2.0_dp)
    end subroutine measure_order

    subroutine method_run(method, system, q0, v0, steps, error, change, time)
        !! From `t = 0` in `steps` steps to `time`, 3 s: distance from the closed form at the
        !! end, and largest relative change of the energy on the way.
        class(integrator_t), intent(inout) :: method  !! that is measured; prepared here
        class(system_t), intent(in) :: system  !! with its parameters
        real(dp), intent(in) :: q0(:), v0(:)  !! the start
        integer(i8), intent(in) :: steps  !! how many
        real(dp), intent(out) :: error, change  !! of the state at the end; of the energy
        real(dp), intent(in), optional :: time  !! s, 3 if it is not given
        class(reference_t), allocatable :: reference
        type(error_t), allocatable :: refusal
        real(dp), dimension(size(q0)) :: q, v, q_true, v_true
        real(dp) :: duration, e0
        integer(i8) :: k

        duration = 3.0_dp
        if (present(time)) duration = time
        call method%prepare(system, refusal)
        q = q0
        v = v0
        call method%start(system, 0.0_dp, q, v)
        e0 = system%energy(0.0_dp, q, v)
        change = 0.0_dp
        do k = 0, steps - 1
            call method%advance(system, 0.0_dp, duration/steps, k, 1_i8, q, v)
            change = max(change, abs(system%energy(0.0_dp, q, v)/e0 - 1.0_dp))
        end do
        call system%closed_form(0.0_dp, q0, v0, reference)
        call reference%state_at(duration, q_true, v_true)
        error = max(farthest(q, q_true), farthest(v, v_true))
    end subroutine method_run

    subroutine high_order(method, m)
        !! Amplitudes stay below 0.6 rad and steps below a quarter of a period, so that the error
        !! is its leading term; it stands above rounding by a factor of ten at the shorter step.
        class(integrator_t), intent(inout) :: method
        type(measured_t), intent(out) :: m
        type(pendulum_t) :: system
        type(error_t), allocatable :: failure
        real(dp) :: q(1), v(1), error, change
        integer :: i, k

        call system%configure([1.3_dp, 0.7_dp, 9.81_dp], failure)
        m%steps = 14
        do k = 1, 10
            q = 0.2_dp + 0.04_dp*k
            v = 0.3_dp
            do i = 1, 2
                call method_run(method, system, q, v, i*m%steps, error, change, 8.0_dp)
                m%error(i) = m%error(i) + error
            end do
        end do
        m%order = log(m%error(1)/m%error(2))/log(2.0_dp)
    end subroutine high_order

    subroutine new_problem(k, system, q, v)
        !! A pendulum with a large swing; a cart-pendulum, whose mass matrix changes; a charge
        !! in electric and magnetic fields and a trap. Rates are about 3 rad/s at most.
        integer, intent(in) :: k  !! 1 to `problems`
        class(system_t), allocatable, intent(out) :: system  !! with its parameters
        real(dp), allocatable, intent(out) :: q(:), v(:)  !! the start
        type(error_t), allocatable :: error

        select case (k)
        case (1)
            allocate (pendulum_t :: system)
            call system%configure([1.3_dp, 1.7_dp, 9.81_dp], error)
            allocate (q, source=[2.0_dp])
            allocate (v, source=[0.3_dp])
        case (2)
            allocate (cart_pendulum_t :: system)
            call system%configure([1.3_dp, 0.7_dp, 1.9_dp, 9.81_dp], error)
            allocate (q, source=[0.1_dp, 1.2_dp])
            allocate (v, source=[0.2_dp, -0.5_dp])
        case default
            allocate (charged_particle_t :: system)
            call system%configure([1.3_dp, 0.7_dp, 0.2_dp, 0.1_dp, -0.3_dp, 0.6_dp, -0.7_dp, &
                                   1.4_dp, 2.1_dp], error)
            allocate (q, source=[0.5_dp, -0.2_dp, 0.3_dp])
            allocate (v, source=[1.0_dp, 0.3_dp, -0.4_dp])
        end select
    end subroutine new_problem

    function refuses(method, system)
        !! Whether `method` is not for `system`; otherwise it is ready.
        class(integrator_t), intent(inout) :: method  !! prepared where it does not refuse
        class(system_t), intent(in) :: system  !! with its parameters
        logical :: refuses
        type(error_t), allocatable :: error

        call method%prepare(system, error)
        refuses = allocated(error)
    end function refuses
end module lagrangia_method_orders
