module lagrangia_zero_constants
    !! `p_x = 0`, `E = 0`: what is conserved is zero on the motions that begin so.
    use lagrangia_derivative, only: derivative, time_derivative
    use lagrangia_expression, only: expression_t
    use lagrangia_kinds, only: dp
    use lagrangia_motion_values, only: values_of
    use lagrangia_sample_names, only: role_acceleration, role_known, role_velocity, samples_t
    use lagrangia_slip_search, only: holds
    use lagrangia_written_out, only: in_coordinates
    implicit none (type, external)
    private
    public :: begin_with_zeros, find_zero_constant

    integer, parameter :: most_steps = 1000     !! of Newton
    real(dp), parameter :: rounding = 1e-13_dp  !! of a constant, relative to its terms before
    real(dp), parameter :: rest = 1e-10_dp      !! of a velocity, relative to the first one

contains

    subroutine find_zero_constant(text, residual, samples, constant)
        !! The left side of a statement `... = 0`, if it is conserved and has velocities.
        character(*), intent(in) :: text               !! the statement, as typed
        type(expression_t), intent(in) :: residual     !! left less right side, not always zero
        type(samples_t), intent(in) :: samples         !! know the formulas
        type(expression_t), intent(out) :: constant    !! in coordinates; empty: it is none
        type(expression_t) :: e
        logical :: judged, moves, yes
        integer :: k

        if (residual%count == 0) return
        if (adjustl(text(index(text, "=", back=.true.) + 1:)) /= "0") return
        e = in_coordinates(residual, samples)
        moves = .false.
        do k = 1, size(samples%role)
            if (.not. e%depends_on(k)) cycle
            if (any(samples%role(k) == [role_acceleration, role_known])) return
            moves = moves .or. samples%role(k) == role_velocity
        end do
        if (.not. moves) return
        call holds(time_derivative(e, samples%rate, 1), samples%values, yes, judged)
        if (yes) constant = e
    end subroutine find_zero_constant

    subroutine begin_with_zeros(constants, free, values, found)
        !! Velocities at which all these constants are zero, by Newton's steps of least length for
        !! one after another; what is left of a velocity by rounding is zero.
        type(expression_t), intent(in) :: constants(:)  !! in coordinates and velocities
        integer, intent(in) :: free(:)                  !! places of the velocities that may change
        real(dp), intent(inout) :: values(:, :)         !! of the symbols at one state, (1, symbols)
        logical, intent(out) :: found                   !! there are such velocities
        type(expression_t) :: slopes(size(free), size(constants))
        real(dp) :: begun(size(free)), scales(size(constants)), slope(size(free)), value(1)
        logical :: judged, zero(size(constants))
        integer :: i, k, step

        found = size(constants) == 0
        if (found) return
        begun = values(1, free)
        do i = 1, size(constants)
            do k = 1, size(free)
                slopes(k, i) = derivative(constants(i), free(k))
            end do
            scales(i) = sum(abs(slope_of(i)*begun))
        end do
        zero = .false.
        do step = 1, most_steps
            found = all(zero)  ! and one step more
            do i = 1, size(constants)
                value = values_of(constants(i), values)
                slope = slope_of(i)
                if (sum(slope**2) > 0.0_dp) values(1, free) = values(1, free) - &
                    value(1)*slope/sum(slope**2)
            end do
            if (found) exit
            do i = 1, size(constants)
                value = values_of(constants(i), values)
                call holds(constants(i), values, zero(i), judged)
                zero(i) = zero(i) .or. abs(value(1)) <= rounding*scales(i)
            end do
        end do
        where (abs(values(1, free)) <= rest*abs(begun)) values(1, free) = 0.0_dp
    contains
        function slope_of(i) result(slope)
            integer, intent(in) :: i
            real(dp) :: slope(size(free)), one(1)
            integer :: c

            do c = 1, size(free)
                one = values_of(slopes(c, i), values)
                slope(c) = one(1)
            end do
        end function slope_of
    end subroutine begin_with_zeros
end module lagrangia_zero_constants
