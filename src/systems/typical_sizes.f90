module lagrangia_typical_sizes
    !! How large the coordinates and times of a motion are: electrons and planets in SI units have
    !! others than a pendulum, and random states of another size would show nothing but the largest
    !! term.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use lagrangia_kinds, only: dp
    use lagrangia_lagrange, only: euler_lagrange_t, expand_lagrangian
    use lagrangia_number_class, only: is_zero
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: find_typical_sizes

    real(dp), parameter :: usual = 1e3_dp  !! from 1/usual to usual, 1 is a typical size

contains

    pure subroutine find_typical_sizes(system, t, q, v, places, time)
        !! Powers of two, of the motion that starts in a state: \(\tau^{-1}\) is the largest of
        !! \(|\dot q_i/q_i|\) and \(\sqrt{|\ddot q_i/q_i|}\), the latter at rest. A coordinate that
        !! starts at zero has \(M_{ii} s_i^2\) as the others have it.
        class(system_t), intent(in) :: system        !! configured
        real(dp), intent(in) :: t, q(:), v(:)        !! time, s; state
        real(dp), allocatable, intent(out) :: places(:)
        !! \(s_i\), (ndof); not allocated where all sizes, and the time, are usual
        real(dp), intent(out) :: time                !! \(\tau\), s
        type(euler_lagrange_t) :: terms
        real(dp), dimension(size(q)) :: a, mass, size_of
        real(dp) :: action, rate
        integer :: i

        time = 1.0_dp
        call expand_lagrangian(system, t, q, 0.0_dp*v, terms)
        mass = [(terms%mass(i, i), i=1, size(q))]
        if (.not. all(ieee_is_finite(mass) .and. mass > 0.0_dp)) return
        call system%accelerations(t, q, 0.0_dp*v, a)
        size_of = abs(q)
        if (all(size_of <= 0.0_dp)) then  ! a way that is gone in the time in which v changes
            if (all(is_zero(v))) return  ! nothing tells a size
            call system%accelerations(t, q, v, a)
            rate = norm2(sqrt(mass)*a)/norm2(sqrt(mass)*v)
            if (.not. (ieee_is_finite(rate) .and. rate > 0.0_dp)) rate = 1.0_dp
            size_of = abs(v)/rate
        else
            rate = 0.0_dp
            do i = 1, size(q)
                if (size_of(i) > 0.0_dp) rate = max(rate, abs(v(i))/size_of(i), &
                                                    sqrt(abs(a(i))/size_of(i)))
            end do
            if (.not. (ieee_is_finite(rate) .and. rate > 0.0_dp)) rate = 1.0_dp
        end if
        action = maxval(sqrt(mass)*size_of)
        where (size_of <= 0.0_dp) size_of = action/sqrt(mass)
        time = power_of_two(1.0_dp/rate)
        allocate (places, source=power_of_two(size_of))
        if (all(is_zero([places, time] - 1.0_dp))) deallocate (places)
    end subroutine find_typical_sizes

    elemental function power_of_two(x) result(near)
        !! 1 for what is usual, or not known.
        real(dp), intent(in) :: x
        real(dp) :: near

        near = 1.0_dp
        if (.not. ieee_is_finite(x)) return
        if (x <= 0.0_dp .or. (x >= 1.0_dp/usual .and. x <= usual)) return
        near = 2.0_dp**nint(log(x)/log(2.0_dp))
    end function power_of_two
end module lagrangia_typical_sizes
