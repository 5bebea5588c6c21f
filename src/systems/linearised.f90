module lagrangia_linearised
    !! The small oscillations about an equilibrium as derived by hand: plain data.
    use lagrangia_kinds, only: dp
    implicit none (type, external)
    private
    public :: linearised_t

    type :: linearised_t
        !! \(M\ddot\delta + G\dot\delta + K\delta = 0\). What is not derived is not allocated.
        real(dp), allocatable :: mass(:, :)        !! \(M\)
        real(dp), allocatable :: stiffness(:, :)   !! \(K\)
        real(dp), allocatable :: gyroscopic(:, :)  !! \(G\), antisymmetric; not allocated: none
        real(dp), allocatable :: root(:, :)        !! \(S\), (rank, n), with \(K = S^\top S\)
        real(dp), allocatable :: inverse(:, :)     !! \(W\), with \(W^\top M W = 1\)
        real(dp), allocatable :: omega2(:)         !! closed form, ascending, s^-2
        real(dp), allocatable :: elsewhere(:)      !! another equilibrium
    end type linearised_t
end module lagrangia_linearised
