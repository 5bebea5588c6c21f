module lagrangia_modes_bench
    !! What an eigenproblem costs, beside LAPACK's bare driver in the same rounds.
    use lagrangia_description, only: name_length
    use lagrangia_eigen, only: normal_modes
    use lagrangia_errors, only: error_t
    use lagrangia_hanging_chain, only: hanging_chain_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_lapack_eigen, only: dsygv, dsygvd
    use lagrangia_linearised, only: linearised_t
    use lagrangia_observer, only: observer_t
    use lagrangia_precision_curve, only: median
    use lagrangia_printed_table, only: printed_table_t, count_cell, number_cell, word_cell
    use lagrangia_stopwatch, only: effort_t, repetitions, seconds_since, ticks_now
    use lagrangia_work_precision, only: look_around
    implicit none (type, external)
    private
    public :: measure_modes

    integer, parameter :: sizes(5) = [2, 10, 100, 300, 1000]
    integer, parameter :: small = 32  !! up to here the driver is dsygv

contains

    subroutine measure_modes(plan, watcher, table, error)
        !! Hanging chains of n bobs, \(K u = \omega^2 M u\) with full matrices.
        type(effort_t), intent(in) :: plan  !! how much is measured
        class(observer_t), pointer, intent(in) :: watcher  !! told how far it is; may be null
        type(printed_table_t), intent(out) :: table  !! the result
        type(error_t), allocatable, intent(out) :: error  !! allocated where it fails
        type(hanging_chain_t) :: chain
        type(linearised_t) :: analytic
        real(dp), allocatable :: q(:)
        real(dp) :: ours(plan%rounds), bare(plan%rounds)
        integer :: cost(size(sizes)), i, last, round, n

        call table%begin("modes", "n bobs of a hanging chain, K u = omega^2 M u", &
                         [character(name_length) :: "n", "driver", "us", "driver_us", "ratio"])
        last = size(sizes) - merge(1, 0, plan%quick)
        ! of a round: little ones take the shortest time that counts
        cost = 1 + int(real(sizes, dp)**3/2e7_dp)
        do i = 1, last
            n = sizes(i)
            call chain%configure([real(n, dp), 1.0_dp, 1.0_dp, 9.81_dp], error)
            if (allocated(error)) return
            allocate (q(n), source=0.0_dp)
            call chain%linearise(q, analytic)
            deallocate (q)
            do round = 1, plan%rounds
                call look_around(watcher, plan%rounds*sum(cost(:i - 1)) + (round - 1)*cost(i), &
                                 plan%rounds*sum(cost(:last)), error)
                if (allocated(error)) return
                call time_ours(analytic%stiffness, analytic%mass, plan%shortest, ours(round), error)
                if (allocated(error)) return
                call time_driver(analytic%stiffness, analytic%mass, plan%shortest, bare(round))
            end do
            call table%add([count_cell(int(n, i8)), &
                            word_cell(merge("dsygv ", "dsygvd", n <= small)), &
                            number_cell(1e6_dp*median(ours), 3), &
                            number_cell(1e6_dp*median(bare), 3), &
                            number_cell(median(ours/bare), 3)])
        end do
    end subroutine measure_modes

    subroutine time_ours(stiffness, mass, shortest, seconds, error)
        !! With all checks, allocations and signs.
        real(dp), intent(in) :: stiffness(:, :), mass(:, :), shortest
        real(dp), intent(out) :: seconds
        type(error_t), allocatable, intent(out) :: error
        real(dp), allocatable :: omega2(:), modes(:, :)
        integer(i8) :: start
        integer :: times, k

        times = 1
        do
            start = ticks_now()
            do k = 1, times
                call normal_modes(stiffness, mass, omega2, modes, error)
                if (allocated(error)) return
            end do
            seconds = seconds_since(start)
            if (seconds >= shortest) exit
            times = max(2*times, repetitions(seconds/times, shortest))
        end do
        seconds = seconds/times
    end subroutine time_ours

    subroutine time_driver(stiffness, mass, shortest, seconds)
        !! The driver alone: its workspace is there, and the copies that it overwrites are made
        !! before the clock starts.
        real(dp), intent(in) :: stiffness(:, :), mass(:, :), shortest
        real(dp), intent(out) :: seconds
        real(dp), allocatable :: a(:, :), b(:, :), w(:), work(:)
        integer, allocatable :: iwork(:)
        integer(i8) :: start
        real(dp) :: total
        integer :: n, times, info

        n = size(mass, 1)
        allocate (a(n, n), b(n, n), w(n), work(max(34*n, 1 + 6*n + 2*n*n)), iwork(3 + 5*n))
        total = 0.0_dp
        times = 0
        do while (total < shortest)
            a = stiffness
            b = mass
            start = ticks_now()
            if (n <= small) then
                call dsygv(1, "V", "L", n, a, n, b, n, w, work, size(work), info)
            else
                call dsygvd(1, "V", "L", n, a, n, b, n, w, work, size(work), iwork, size(iwork), &
                            info)
            end if
            total = total + seconds_since(start)
            times = times + 1
        end do
        seconds = total/times
    end subroutine time_driver
end module lagrangia_modes_bench
