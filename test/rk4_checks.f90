module rk4_checks
    !! A closed form against `rk4`, which knows of no limit that a closed form may have.
    use funit, only: assertLessThanOrEqual
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_reference, only: reference_t
    use lagrangia_rk4, only: new_rk4, rk4_t
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: check_against_rk4

contains

    subroutine check_against_rk4(reference, system, q0, v0, duration, name)
        !! From `t = 0` the state is that of `rk4` in 4000 steps, each of which rounds by an
        !! epsilon; its truncation, (rate*duration/4000)**4, is less for all that is tested here.
        class(reference_t), intent(in) :: reference
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: q0(:), v0(:), duration
        character(*), intent(in) :: name
        type(rk4_t) :: rk4
        type(error_t), allocatable :: error
        real(dp), dimension(size(q0)) :: q, v, q_rk4, v_rk4
        real(dp) :: tolerance

        call new_rk4(rk4)
        call rk4%prepare(system, error)
        q_rk4 = q0
        v_rk4 = v0
        call rk4%start(system, 0.0_dp, q_rk4, v_rk4)
        call rk4%advance(system, 0.0_dp, duration/4000, 0_i8, 4000_i8, q_rk4, v_rk4)
        call reference%state_at(duration, q, v)
        tolerance = 4000*epsilon(1.0_dp)*max(maxval(abs(q)), maxval(abs(v)))
        call assertLessThanOrEqual(maxval(abs(q - q_rk4)), tolerance, message=name//": q as by rk4")
        call assertLessThanOrEqual(maxval(abs(v - v_rk4)), tolerance, message=name//": v as by rk4")
    end subroutine check_against_rk4
end module rk4_checks
