module lagrangia_plot_colour
    !! The colours of the curves of a picture: a quantity has the same one in all panels, and the
    !! curves of a panel have different ones.
    use lagrangia_plot_panel, only: most_curves, panel_t
    implicit none (type, external)
    private
    public :: colour_panels, colours

    !! Okabe and Ito's colours, which the colour-blind tell apart, too.
    character(7), parameter :: colours(*) = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", &
                                             "#e69f00", "#56b4e9", "#000000", "#8c6d31"]

contains

    pure subroutine colour_panels(panels, names)
        !! Each quantity, in the order of the panels, gets the first colour that no other one has in
        !! any panel that it stands in; a drift has the colour of what drifts. What is drawn over
        !! another column is a path, not that quantity over the time.
        type(panel_t), intent(inout) :: panels(:)  !! get `colour`, which is 0 before
        character(*), intent(in) :: names(:)       !! of the columns
        logical :: taken(size(colours))
        integer :: i, k, n, other, chosen

        do i = 1, size(panels)
            do k = 1, panels(i)%curves
                if (panels(i)%colour(k) > 0) cycle
                taken = .false.
                do n = 1, size(panels)
                    if (.not. any(shown(n, panels(i)%x, panels(i)%y(k)))) cycle
                    do other = 1, panels(n)%curves
                        if (panels(n)%colour(other) > 0) taken(panels(n)%colour(other)) = .true.
                    end do
                end do
                chosen = findloc(taken, .false., 1)
                if (chosen == 0) chosen = modulo(k - 1, size(colours)) + 1
                do n = 1, size(panels)
                    where (shown(n, panels(i)%x, panels(i)%y(k))) panels(n)%colour = chosen
                end do
            end do
        end do
    contains
        pure function shown(n, x, y) result(same)
            !! Which curves of panel `n` show the quantity of column `y` over column `x`.
            integer, intent(in) :: n, x, y
            logical :: same(most_curves)
            integer :: j

            same = .false.
            if (panels(n)%x /= x) return
            do j = 1, panels(n)%curves
                same(j) = quantity(names(panels(n)%y(j))) == quantity(names(y))
            end do
        end function shown
    end subroutine colour_panels

    pure function quantity(name) result(base)
        !! The name without "_drift".
        character(*), intent(in) :: name
        character(len(name)) :: base
        integer :: last

        base = name
        last = len_trim(name) - len("_drift")
        if (last > 0) then
            if (name(last + 1:) == "_drift") base = name(:last)
        end if
    end function quantity
end module lagrangia_plot_colour
