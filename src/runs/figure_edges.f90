module lagrangia_figure_edges
    !! The edges of a figure's rods, springs, ropes, carts and bodies as straight pieces, for a
    !! picture that knows only those.
    use lagrangia_kinds, only: dp
    use lagrangia_scene_figure, only: figure_t, part_t
    implicit none (type, external)
    private
    public :: find_edges, has_edges

    real(dp), parameter :: pi = acos(-1.0_dp)
    integer, parameter :: sides = 72          !! of what is round
    integer, parameter :: turns = 8           !! of a spring
    real(dp), parameter :: straight = 0.1_dp  !! of a spring, at each end, of its length

    character(*), parameter :: edged(*) = [character(8) :: "rod", "rope", "spring", "polygon", &
                                           "box", "cart", "round", "circle", "wheel"]

contains

    pure function has_edges(figure) result(yes)
        !! Is any of its parts drawn?
        type(figure_t), intent(in) :: figure  !! of a system or a scene
        logical :: yes
        integer :: i

        yes = .false.
        do i = 1, size(figure%parts)
            yes = yes .or. any(edged == figure%parts(i)%kind)
        end do
    end function has_edges

    subroutine find_edges(figure, r, size_of_all, edges)
        !! All pieces of the parts that move; none of what only stands by.
        type(figure_t), intent(in) :: figure    !! parts and places
        real(dp), intent(in) :: r(:, :)         !! `(3, places)`, m, of `figure%place`
        real(dp), intent(in) :: size_of_all     !! m; a spring is as wide as 0.08 of it
        real(dp), allocatable, intent(out) :: edges(:, :, :)  !! `(3, 2, n)`: from, to
        integer :: i

        allocate (edges(3, 2, 0))
        do i = 1, size(figure%parts)
            call add_part(figure%parts(i), r(:, figure%parts(i)%at(:figure%parts(i)%count)), &
                          0.04_dp*size_of_all, edges)
        end do
    end subroutine find_edges

    pure subroutine add_part(part, at, half, edges)
        !! The pieces of one part.
        type(part_t), intent(in) :: part
        real(dp), intent(in) :: at(:, :)  !! its places
        real(dp), intent(in) :: half      !! the width of a spring, halved
        real(dp), allocatable, intent(inout) :: edges(:, :, :)
        real(dp) :: corners(3, 4), first(3), second(3), tilt
        integer :: i

        select case (part%kind)
        case ("rod", "rope")
            call add_way(at, edges)
        case ("spring")
            call add_way(coil(at(:, 1), at(:, 2), half), edges)
        case ("polygon")
            call add_way(reshape([at, at(:, 1)], [3, size(at, 2) + 1]), edges)
        case ("box", "cart")
            tilt = merge(at(3, 2), 0.0_dp, part%kind == "box")
            first = 0.5_dp*at(1, 2)*[cos(tilt), sin(tilt), 0.0_dp]
            second = 0.5_dp*at(2, 2)*[-sin(tilt), cos(tilt), 0.0_dp]
            corners(:, 1) = at(:, 1) - first - second
            corners(:, 2) = at(:, 1) + first - second
            corners(:, 3) = at(:, 1) + first + second
            corners(:, 4) = at(:, 1) - first + second
            call add_way(reshape([corners, corners(:, 1)], [3, 5]), edges)
            if (part%kind == "box") return
            do i = -1, 1, 2  ! the wheels
                associate (radius => 0.1875_dp*at(2, 2))
                    first = at(:, 1) + [0.32_dp*i*at(1, 2), -0.5_dp*at(2, 2) - radius, 0.0_dp]
                    call add_way(ring(first, [radius, 0.0_dp, 0.0_dp], &
                                      [0.0_dp, radius, 0.0_dp]), edges)
                end associate
            end do
        case ("round")
            first = [norm2(at(:, 2) - at(:, 1)), 0.0_dp, 0.0_dp]
            call add_way(ring(at(:, 1), first, first([2, 1, 3])), edges)
        case ("circle", "wheel")
            call add_way(ring(at(:, 1), at(:, 2) - at(:, 1), at(:, 3) - at(:, 1)), edges)
        case default
            return  ! it has no edge, or only stands by
        end select
    end subroutine add_part

    pure subroutine add_way(points, edges)
        !! From each point to the next.
        real(dp), intent(in) :: points(:, :)
        real(dp), allocatable, intent(inout) :: edges(:, :, :)
        real(dp), allocatable :: more(:, :, :)
        integer :: i, n

        n = size(edges, 3)
        allocate (more(3, 2, n + size(points, 2) - 1))
        more(:, :, :n) = edges
        do i = 1, size(points, 2) - 1
            more(:, 1, n + i) = points(:, i)
            more(:, 2, n + i) = points(:, i + 1)
        end do
        call move_alloc(more, edges)
    end subroutine add_way

    pure function coil(from, to, half) result(points)
        !! A spring, seen from its side, in the plane of x and y.
        real(dp), intent(in) :: from(3), to(3), half
        real(dp) :: points(3, 2*turns + 3)
        real(dp) :: along(3), across(3)
        integer :: i

        along = to - from
        across = [-along(2), along(1), 0.0_dp]
        across = half*across/max(norm2(across), tiny(1.0_dp))
        points(:, 1) = from
        do i = 0, 2*turns
            points(:, i + 2) = from + (straight + (1.0_dp - 2.0_dp*straight)*i/(2*turns))*along
            if (i > 0 .and. i < 2*turns) points(:, i + 2) = points(:, i + 2) + &
                merge(across, -across, mod(i, 2) == 1)
        end do
        points(:, size(points, 2)) = to
    end function coil

    pure function ring(centre, first, second) result(points)
        !! An ellipse by two half axes, closed.
        real(dp), intent(in) :: centre(3), first(3), second(3)
        real(dp) :: points(3, sides + 1)
        integer :: i

        do i = 0, sides
            points(:, i + 1) = centre + cos(2.0_dp*pi*i/sides)*first + sin(2.0_dp*pi*i/sides)*second
        end do
    end function ring
end module lagrangia_figure_edges
