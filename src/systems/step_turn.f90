module lagrangia_step_turn
    !! Whether the constraints bind other directions at the end of a step than at its start.
    use lagrangia_kinds, only: dp
    implicit none (type, external)
    private
    public :: is_turned

contains

    pure function is_turned(a, b, weights) result(yes)
        !! \(\det(A W B^\top) \le 0\), or a number on that matrix's diagonal is: along the way from
        !! one to the other there is a place where they are at right angles, or where one of them
        !! has lost its rank.
        real(dp), intent(in) :: a(:, :), b(:, :)  !! constraints by their rows, (m, n)
        real(dp), intent(in) :: weights(:)        !! \(W\), diagonal, positive, (n)
        logical :: yes
        real(dp) :: c(size(a, 1), size(a, 1)), row(size(a, 1)), scale
        integer :: i, k, m
        logical :: positive

        m = size(a, 1)
        do i = 1, m
            do k = 1, m
                c(i, k) = sum(weights*a(i, :)*b(k, :))
            end do
            yes = .not. c(i, i) > 0.0_dp
            if (yes) return
            scale = maxval(abs(c(i, :)))
            if (scale > 0.0_dp) c(i, :) = c(i, :)/scale
        end do
        positive = .true.
        do i = 1, m
            k = i - 1 + maxloc(abs(c(i:, i)), 1)
            if (k /= i) then
                row = c(i, :)
                c(i, :) = c(k, :)
                c(k, :) = row
                positive = .not. positive
            end if
            yes = .not. abs(c(i, i)) > 0.0_dp
            if (yes) return
            positive = positive .eqv. c(i, i) > 0.0_dp
            do k = i + 1, m
                c(k, i:) = c(k, i:) - c(k, i)/c(i, i)*c(i, i:)
            end do
        end do
        yes = .not. positive
    end function is_turned
end module lagrangia_step_turn
