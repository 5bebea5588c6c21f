module lagrangia_kept_motions
    !! The constants of a motion that a line writes out, as names for the lines behind: what they
    !! are at each state follows from \(q=f\), \(\dot q=\dot f\), \(\ddot q=\ddot f\) there.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use lagrangia_constant_values, only: draw_constants, solve_constants
    use lagrangia_declared_constants, only: has_place, keep_constant, place_of_constant
    use lagrangia_expression, only: expression_t, operator(-), symbol
    use lagrangia_kinds, only: dp
    use lagrangia_motion_values, only: is_frequency_name, put_frequencies, rate_of
    use lagrangia_sample_names, only: samples_t
    use lagrangia_slip_search, only: holds
    use lagrangia_substitution, only: substituted
    implicit none (type, external)
    private
    public :: is_same_motion, keep_motion

    real(dp), parameter :: pi = acos(-1.0_dp)
    integer, parameter :: enough = 4  !! states at which they have values

contains

    pure function is_same_motion(f, motion, samples) result(yes)
        !! Does a line speak of the motion of a line before? It has one of its constants, or none.
        type(expression_t), intent(in) :: f, motion   !! of the time; `motion` may be empty
        type(samples_t), intent(in) :: samples        !! know the constants
        logical :: yes
        logical :: any_of_its_own
        integer :: k

        yes = motion%count > 0
        if (.not. yes) return
        any_of_its_own = .false.
        do k = size(samples%role) + 1, size(samples%role) + size(samples%constants)
            if (.not. f%depends_on(k)) cycle
            if (motion%depends_on(k)) return
            any_of_its_own = .true.
        end do
        yes = .not. any_of_its_own
    end function is_same_motion

    subroutine keep_motion(coordinate, order, f, samples)
        !! Give the constants of `f` their values where it is the general motion. Amplitudes are
        !! positive.
        integer, intent(in) :: coordinate           !! whose motion it is
        integer, intent(in) :: order                !! of the derivative that `f` is, 0 or 1
        type(expression_t), intent(inout) :: f      !! of the time; gets the names
        type(samples_t), intent(inout) :: samples   !! know the constants
        type(expression_t) :: equations(0:2 - order), rate, names(size(samples%constants))
        real(dp), allocatable :: values(:, :)
        integer, allocatable :: found(:), places(:)
        integer :: i, k, kept, n
        logical :: judged, regular, yes

        n = size(samples%role)
        found = pack([(i, i=1, size(samples%constants))], &
                     [(f%depends_on(n + i), i=1, size(samples%constants))])
        ! as many as initial values, or else the states are not on this motion
        kept = count([(f%depends_on(samples%kept_constants(i)), &
                       i=1, size(samples%kept_constants))])
        if (size(found) == 0 .or. size(found) + kept /= 2 - order) return
        do k = 1, size(found)
            if (.not. has_place(samples, samples%constants(found(k)))) return
            if (is_frequency_name(samples%constants(found(k)), samples)) return
        end do
        do k = 0, size(equations) - 1
            rate = rate_of(f, k)
            equations(k) = symbol(1 + coordinate + (order + k)*samples%ndof) - rate
        end do
        call draw_constants(samples, size(samples%constants), values)
        call put_frequencies(samples, 1, values)
        places = n + found
        call solve_constants(equations(:size(found) - 1), places, values, regular)
        if (count(ieee_is_finite(values(:, places(1)))) < enough) return
        do k = 0, size(equations) - 1
            call holds(equations(k), values, yes, judged)
            if (.not. yes) return
        end do
        if (size(found) == 2) then
            call make_positive(equations, places(1), places(2), values)
            call make_positive(equations, places(2), places(1), values)
        end if
        do i = 1, size(samples%constants)
            names(i) = symbol(n + i)
        end do
        do k = 1, size(found)
            names(found(k)) = symbol(place_of_constant(samples, samples%constants(found(k))))
        end do
        f = substituted(f, [(n + i, i=1, size(names))], names)
        do k = 1, size(found)
            call keep_constant(trim(samples%constants(found(k))), values(:, places(k)), .false., &
                               samples)
        end do
    end subroutine keep_motion

    subroutine make_positive(equations, amplitude, phase, values)
        !! Another amplitude of A cos(omega t + phi) with another phase, one between -pi and pi,
        !! where that is the same.
        type(expression_t), intent(in) :: equations(0:)  !! left less right sides
        integer, intent(in) :: amplitude, phase          !! places
        real(dp), intent(inout) :: values(:, :)          !! (states, symbols)
        real(dp) :: other(size(values, 1), size(values, 2))
        logical :: judged, yes
        integer :: k

        other = values
        where (values(:, amplitude) < 0.0_dp)
            other(:, amplitude) = -values(:, amplitude)
            other(:, phase) = values(:, phase) + pi
        end where
        other(:, phase) = modulo(other(:, phase) + pi, 2.0_dp*pi) - pi
        do k = 0, 1
            call holds(equations(k), other, yes, judged)
            if (.not. yes) return
        end do
        values = other
    end subroutine make_positive
end module lagrangia_kept_motions
