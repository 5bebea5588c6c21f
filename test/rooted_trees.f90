module rooted_trees
    !! All rooted trees up to an order, with what the order conditions of Runge-Kutta methods need.
    !!
    !! A tree is a root with a multiset of smaller trees \(u\) on it. Its density is
    !! \(\gamma = n\prod\gamma(u)\), its elementary weight at stage \(i\) is
    !! \(\phi_i = \prod_u \sum_j a_{ij}\phi_j(u)\); a method has order \(p\) if
    !! \(\sum_i b_i\phi_i = 1/\gamma\) for all trees of up to \(p\) vertices (Butcher 1963;
    !! Hairer, Nørsett & Wanner I, sec. II.2).
    use lagrangia_kinds, only: qp
    implicit none (type, external)
    private
    public :: trees_t, grow_trees

    integer, parameter :: most_trees = 200  !! up to order 8

    type :: trees_t
        integer :: count = 0
        integer :: order(most_trees) = 0
        real(qp) :: density(most_trees) = 1.0_qp
        real(qp), allocatable :: phi(:, :)                !! (stage, tree)
        real(qp), allocatable, private :: on_top(:, :)    !! \(\sum_j a_{ij}\phi_j\)
    end type trees_t

contains

    subroutine grow_trees(trees, a, order)
        !! The trees of up to `order` vertices for the matrix whose column `i` makes stage `i`.
        type(trees_t), intent(out) :: trees
        real(qp), intent(in) :: a(:, :)
        integer, intent(in) :: order
        integer :: n, smaller

        allocate (trees%phi(size(a, 1), most_trees), source=1.0_qp)
        allocate (trees%on_top(size(a, 1), most_trees), source=0.0_qp)
        do n = 1, order
            smaller = trees%count
            call add_branches(trees, a, n, n - 1, 1, smaller, real(n, qp), trees%phi(:, most_trees))
        end do
    end subroutine grow_trees

    recursive subroutine add_branches(trees, a, n, free, first, last, density, phi)
        !! Fill a root's `free` vertices with the trees `first` to `last`, never going back.
        type(trees_t), intent(inout) :: trees
        real(qp), intent(in) :: a(:, :), density, phi(:)
        integer, intent(in) :: n, free, first, last
        real(qp) :: product(size(phi))
        integer :: i

        if (free == 0) then
            trees%count = trees%count + 1
            trees%order(trees%count) = n
            trees%density(trees%count) = density
            product = phi
            trees%phi(:, trees%count) = product
            trees%on_top(:, trees%count) = matmul(product, a)
            return
        end if
        do i = first, last
            if (trees%order(i) > free) exit
            product = phi*trees%on_top(:, i)
            call add_branches(trees, a, n, free - trees%order(i), i, last, &
                              density*trees%density(i), product)
        end do
    end subroutine add_branches
end module rooted_trees
