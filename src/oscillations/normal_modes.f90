module lagrangia_normal_modes
    !! Normal modes of any stiffness and mass matrix, labelled.
    use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
    use lagrangia_eigen, only: normal_modes
    use lagrangia_errors, only: error_t
    use lagrangia_jacobi, only: zero_modes
    use lagrangia_kinds, only: dp
    implicit none (type, external)
    private
    public :: normal_modes_t, normal_modes, put_labels
    public :: is_oscillation, is_zero_mode, is_unstable

    integer, parameter :: is_oscillation = 1, is_zero_mode = 2, is_unstable = 3

    type :: normal_modes_t
        !! Mode `j` moves as `shapes(:, j)*cos(omega(j)*t)` if `label(j) == is_oscillation`, at a
        !! constant rate if it `is_zero_mode`, and as \(e^{\gamma t}\),
        !! \(\gamma = \sqrt{-\omega^2}\), if it `is_unstable`.
        real(dp), allocatable :: omega2(:)     !! \(\omega^2\), ascending, s^-2; of a zero mode 0
        real(dp), allocatable :: omega(:)      !! \(\omega\), rad/s; of an unstable mode NaN
        real(dp), allocatable :: shapes(:, :)  !! \(u_j\), a column each; \(u^\top M u = 1\)
        integer, allocatable :: label(:)       !! which of the three
    end type normal_modes_t

    interface normal_modes
        !! Of your own \(K\) and \(M\), labelled; beside the bare arrays of `lagrangia_eigen`.
        module procedure labelled_modes
    end interface normal_modes

contains

    pure subroutine labelled_modes(stiffness, inertia, modes, error)
        !! Solve \(K u = \omega^2 M u\). Fails (status 2) unless both are square, of one size,
        !! finite and symmetric, and (status 4) unless \(M\) is positive definite; then `modes`
        !! is empty.
        real(dp), intent(in) :: stiffness(:, :)           !! \(K\), symmetric, (n, n)
        real(dp), intent(in) :: inertia(:, :)             !! \(M\), positive definite, (n, n)
        type(normal_modes_t), intent(out) :: modes        !! (n), ascending
        type(error_t), allocatable, intent(out) :: error  !! what is wrong with K or M

        call normal_modes(stiffness, inertia, modes%omega2, modes%shapes, error)
        if (allocated(error)) return
        call put_labels(zero_modes(stiffness, modes%shapes), modes%omega2, modes%omega, &
                        modes%label)
    end subroutine labelled_modes

    pure subroutine put_labels(vanishes, omega2, omega, label)
        !! A negative square is a growth rate; what `vanishes` becomes 0.
        logical, intent(in) :: vanishes(:)              !! (n): a zero mode
        real(dp), intent(inout) :: omega2(:)            !! (n), s^-2; 0 of a zero mode
        real(dp), allocatable, intent(out) :: omega(:)  !! (n), rad/s; NaN of an unstable mode
        integer, allocatable, intent(out) :: label(:)   !! (n), which of the three

        label = merge(is_unstable, is_oscillation, omega2 < 0.0_dp)
        where (vanishes) label = is_zero_mode
        where (vanishes) omega2 = 0.0_dp
        allocate (omega(size(omega2)), source=ieee_value(1.0_dp, ieee_quiet_nan))
        where (label /= is_unstable) omega = sqrt(max(0.0_dp, omega2))
    end subroutine put_labels
end module lagrangia_normal_modes
