module lagrangia_certain_digits
    !! Numbers of modes for the eye: twelve digits, or as many as rounding has left.
    use lagrangia_kinds, only: dp
    use lagrangia_number_class, only: is_zero
    use lagrangia_number_text, only: scientific
    use lagrangia_small_oscillations, only: modes_t
    implicit none (type, external)
    private
    public :: certain, number, rounding_of

contains

    pure function certain(value, share) result(text)
        !! As many of its digits as there are.
        real(dp), intent(in) :: value  !! any finite one
        real(dp), intent(in) :: share  !! of it that rounding may have changed
        character(:), allocatable :: text

        text = trim(number(value))
        if (share <= 5e-12_dp .or. is_zero(value)) return
        text = "rounding"  ! and nothing else
        if (share < 0.5_dp) text = scientific(value, max(1, floor(-log10(share))))
    end function certain

    pure function rounding_of(modes, j) result(delta)
        !! How far the rounding of K and M may have moved \(\omega_j^2\): \(4\epsilon\) of
        !! \(|u|^\top|K||u| + \omega_j^2|u|^\top|M||u|\), with \(u^\top Mu = 1\). With
        !! velocity-dependent forces, whose modes are refused where no digit is left, 0.
        type(modes_t), intent(in) :: modes  !! solved
        integer, intent(in) :: j            !! a mode
        real(dp) :: delta                   !! s^-2

        delta = 0.0_dp
        if (allocated(modes%quadrature)) return
        associate (u => abs(modes%shapes(:, j)))
            delta = 4*epsilon(delta)*dot_product(u, matmul(abs(modes%stiffness) + &
                                                 abs(modes%omega2(j))*abs(modes%mass), u))
        end associate
    end function rounding_of

    pure function number(value) result(text)
        !! Twelve digits, left-justified in 18.
        real(dp), intent(in) :: value  !! any finite one
        character(18) :: text

        text = "0"
        if (is_zero(value)) return
        if (abs(value) >= 1e-3_dp .and. abs(value) < 1e5_dp) then
            write (text, "(ss, f18.11)") value
        else
            write (text, "(ss, es18.10e3)") value  ! as wide as the longest
        end if
        text = adjustl(text)
    end function number
end module lagrangia_certain_digits
