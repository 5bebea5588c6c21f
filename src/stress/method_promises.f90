module lagrangia_method_promises
    !! What methods promise, held against runs: canonical maps, reversal, the same bytes however a
    !! run is cut, and exact scaling by powers of two.
    use lagrangia_description, only: default_values, description_t
    use lagrangia_errors, only: error_t
    use lagrangia_flow, only: order8
    use lagrangia_integrator, only: integrator_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_ledger, only: ledger_t
    use lagrangia_method_orders, only: new_problem, problems, refuses
    use lagrangia_number_text, only: field_width, write_row
    use lagrangia_observer, only: observer_box_t
    use lagrangia_run, only: run
    use lagrangia_system, only: system_t
    use lagrangia_time_grid, only: new_time_grid, time_grid_t
    use lagrangia_vectors, only: farthest
    implicit none (type, external)
    private
    public :: stress_bytes, stress_reversal, stress_scaling, stress_symplectic, stress_text
    public :: canonical_defect, differentiate_step

    real(dp), parameter :: dt = 0.02_dp        !! s
    integer(i8), parameter :: steps = 1000_i8
    integer, parameter :: most = 6             !! numbers in a state of the problems
    real(dp), parameter :: usual_step = 0.05_dp  !! s, of a map that is differentiated

contains

    subroutine stress_symplectic(method, verdicts)
        !! The defect of a step over the problems; of a method that declares nothing it is stated.
        class(integrator_t), intent(inout) :: method  !! that is measured; prepared here
        type(ledger_t), intent(inout) :: verdicts  !! gets the lines
        real(dp), parameter :: rounding = 1e-10_dp  !! epsilon over the differences' step, 300 times
        character(*), parameter :: measured = "largest of J'WJ - W"
        class(system_t), allocatable :: system
        real(dp), allocatable :: q(:), v(:)
        real(dp) :: worst
        integer :: k

        worst = 0.0_dp
        do k = 1, problems
            call new_problem(k, system, q, v)
            if (refuses(method, system)) cycle
            worst = max(worst, canonical_defect(method, system, 0.0_dp, q, v))
        end do
        if (method%symplectic) then
            call verdicts%judge(method%name, measured, worst, most=rounding)
        else
            call verdicts%judge(method%name, measured, worst, remark="does not declare it")
        end if
    end subroutine stress_symplectic

    subroutine stress_reversal(method, verdicts)
        !! A thousand steps forth and back, over the problems.
        class(integrator_t), intent(inout) :: method  !! that is measured; prepared here
        type(ledger_t), intent(inout) :: verdicts  !! gets the lines
        real(dp), parameter :: rounding = 1e-11_dp  !! 2000 steps of 10 epsilon, carried on
        character(*), parameter :: measured = "distance after 1000 steps and back"
        class(system_t), allocatable :: system
        real(dp), allocatable :: q(:), v(:), q0(:), v0(:)
        real(dp) :: worst
        integer :: k

        worst = 0.0_dp
        do k = 1, problems
            call new_problem(k, system, q0, v0)
            if (refuses(method, system)) cycle
            q = q0
            v = v0
            call method%start(system, 0.0_dp, q, v)
            call method%advance(system, 0.0_dp, dt, 0_i8, steps, q, v)
            call method%start(system, steps*dt, q, v)
            call method%advance(system, steps*dt, -dt, 0_i8, steps, q, v)
            worst = max(worst, farthest(q, q0), farthest(v, v0))
        end do
        if (method%reversible) then
            call verdicts%judge(method%name, measured, worst, most=rounding)
        else
            call verdicts%judge(method%name, measured, worst, remark="does not declare it")
        end if
    end subroutine stress_reversal

    subroutine stress_bytes(method, verdicts)
        !! Runs that are looked at every 1, 7, 64, 1000 steps end in the same bits.
        class(integrator_t), intent(inout) :: method  !! that is measured; prepared here
        type(ledger_t), intent(inout) :: verdicts  !! gets the lines
        integer(i8), parameter :: strides(4) = [1000_i8, 1_i8, 7_i8, 64_i8]
        class(system_t), allocatable :: system
        type(observer_box_t) :: nobody(0)
        type(time_grid_t) :: plan
        type(error_t), allocatable :: error
        real(dp), allocatable :: q(:), v(:)
        real(dp) :: whole(most)
        integer :: different, i, k

        different = 0
        whole = 0.0_dp
        do k = 1, problems
            do i = 1, size(strides)
                call new_problem(k, system, q, v)
                if (refuses(method, system)) cycle
                call new_time_grid(plan, 0.0_dp, dt, steps*dt, strides(i), error)
                call run(system, method, plan, nobody, q, v, error)
                if (i == 1) whole(:2*system%ndof) = [q, v]
                different = different + differing([q, v], whole(:2*system%ndof))
            end do
        end do
        call verdicts%judge(method%name, "numbers that differ with the stride", &
                            real(different, dp), 0.0_dp, 0.0_dp)
    end subroutine stress_bytes

    subroutine stress_text(verdicts)
        !! Numbers of all sizes, written as the data files have them and read again.
        type(ledger_t), intent(inout) :: verdicts  !! gets the lines
        character(field_width + 1) :: text
        real(dp) :: x(1), y(1)
        integer :: different, k, length

        different = 0
        do k = -1060, 1020
            x = 2.0_dp**k*(1.0_dp + abs(sin(real(k, dp))))
            call write_row(x, text, length)
            read (text(:length - 1), *) y
            different = different + differing(x, y)
        end do
        call verdicts%judge("text files", "numbers that do not come back", real(different, dp), &
                            0.0_dp, 0.0_dp)
    end subroutine stress_text

    pure function differing(x, y) result(number)
        !! How many numbers differ in a bit; those that are not finite do.
        real(dp), intent(in) :: x(:), y(:)
        integer :: number

        number = count(.not. (transfer(x, [0_i8]) == transfer(y, [0_i8]) .and. &
                              abs(x) <= huge(x)))
    end function differing

    subroutine stress_scaling(method, verdicts)
        !! Other units of mass, length and time, each smaller by a power of two, change no digit.
        class(integrator_t), intent(inout) :: method  !! that is measured; prepared here
        type(ledger_t), intent(inout) :: verdicts  !! gets the lines
        integer, parameter :: smaller(3, 4) = reshape([0, 0, 0, 3, 0, 0, 0, 5, 0, 0, 0, 4], [3, 4])
        class(system_t), allocatable :: system
        type(error_t), allocatable :: error
        type(description_t) :: d
        real(dp), allocatable :: q(:), v(:), parameters(:), length(:), speed(:)
        real(dp) :: second, whole(most)
        integer :: different, i, k, first

        different = 0
        whole = 0.0_dp
        do k = 1, problems
            do i = 1, size(smaller, 2)
                call new_problem(k, system, q, v)
                call system%describe(d)
                parameters = default_values(d)
                first = 1
                call scale_parameters()
                call system%configure(parameters, error)
                if (refuses(method, system)) cycle
                length = factor_of(d%coordinates%unit, smaller(1, i), smaller(2, i), smaller(3, i))
                second = 2.0_dp**smaller(3, i)
                speed = length/second
                q = length*q
                v = speed*v
                call method%start(system, 0.0_dp, q, v)
                call method%advance(system, 0.0_dp, second*dt, 0_i8, steps, q, v)
                if (i == 1) whole(:2*system%ndof) = [q, v]
                different = different + differing([q/length, v/speed], whole(:2*system%ndof))
            end do
        end do
        call verdicts%judge(method%name, "numbers that differ with the units", &
                            real(different, dp), 0.0_dp, 0.0_dp)
    contains
        subroutine scale_parameters()
            integer :: j

            do j = 1, size(d%parameters)
                associate (last => first + d%parameters(j)%count - 1)
                    parameters(first:last) = factor_of(d%parameters(j)%unit, smaller(1, i), &
                                                       smaller(2, i), smaller(3, i)) &
                                             *parameters(first:last)
                    first = last + 1
                end associate
            end do
        end subroutine scale_parameters
    end subroutine stress_scaling

    elemental function factor_of(unit, kilogram, metre, second) result(factor)
        !! By which numbers in this unit grow where the three are smaller by so many powers of two.
        character(*), intent(in) :: unit
        integer, intent(in) :: kilogram, metre, second
        real(dp) :: factor
        integer :: power

        select case (unit)
        case ("kg"); power = kilogram
        case ("m"); power = metre
        case ("m/s^2"); power = metre - 2*second
        case ("N/m"); power = kilogram - 2*second
        case ("V/m"); power = kilogram + metre - 2*second
        case ("T"); power = kilogram - second
        case default; power = 0
        end select
        factor = 2.0_dp**power
    end function factor_of

    function canonical_defect(method, system, t, q, v, dt) result(defect)
        !! The largest element of \(J^\top\Omega J - \Omega\), relative to the terms it consists of.
        class(integrator_t), intent(inout) :: method  !! that is measured; prepared here
        class(system_t), intent(in) :: system  !! with its parameters
        real(dp), intent(in) :: t, q(:), v(:)  !! s; coordinates and velocities, (ndof)
        real(dp), intent(in), optional :: dt  !! the step, if not the usual one
        real(dp) :: defect
        real(dp), dimension(2*size(q), 2*size(q)) :: jacobian, omega
        integer :: i, n

        n = size(q)
        omega = 0.0_dp
        do i = 1, n
            omega(i, n + i) = 1.0_dp
            omega(n + i, i) = -1.0_dp
        end do
        call differentiate_step(method, system, t, q, v, jacobian, dt)
        defect = maxval(abs(matmul(transpose(jacobian), matmul(omega, jacobian)) - omega) &
                        /(1.0_dp + matmul(transpose(abs(jacobian)), &
                                          matmul(abs(omega), abs(jacobian)))))
    end function canonical_defect

    subroutine differentiate_step(method, system, t, q, v, jacobian, dt)
        !! The derivative of a step in coordinates and momenta, by differences of order 8.
        class(integrator_t), intent(inout) :: method  !! that is measured; prepared here
        class(system_t), intent(in) :: system  !! with its parameters
        real(dp), intent(in) :: t, q(:), v(:)  !! s; coordinates and velocities, (ndof)
        real(dp), intent(out) :: jacobian(2*size(q), 2*size(q))  !! in coordinates, then momenta
        real(dp), intent(in), optional :: dt  !! the step, s, if not the usual one
        real(dp) :: x(2*size(q)), ahead(2*size(q)), behind(2*size(q))
        real(dp) :: h, length
        integer :: i, k, n

        length = usual_step
        if (present(dt)) length = dt
        n = size(q)
        x(:n) = q
        call system%momenta(t, q, v, x(n + 1:))
        jacobian = 0.0_dp
        do i = 1, 2*n
            h = 0.005_dp
            if (i > n) h = h*(1.0_dp + maxval(abs(x(n + 1:))))
            do k = 1, 4
                ahead = x
                ahead(i) = x(i) + k*h
                behind = x
                behind(i) = x(i) - k*h
                call step(ahead)
                call step(behind)
                jacobian(:, i) = jacobian(:, i) + order8(k)/h*(ahead - behind)
            end do
        end do
    contains
        subroutine step(y)
            real(dp), intent(inout) :: y(:)
            real(dp), dimension(size(q)) :: p, qq, vv

            qq = y(:n)
            p = y(n + 1:)
            call system%velocities(t, qq, p, vv)
            call method%start(system, t, qq, vv)
            call method%advance(system, t, length, 0_i8, 1_i8, qq, vv)
            call system%momenta(t + length, qq, vv, p)
            y = [qq, p]
        end subroutine step
    end subroutine differentiate_step
end module lagrangia_method_promises
