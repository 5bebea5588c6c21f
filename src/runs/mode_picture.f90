module lagrangia_mode_picture
    !! The modes of a system drawn as the mechanism that swings: the masses where the equilibrium
    !! has them, displaced to either side, and the way between; the rods, springs, carts and bodies
    !! of its figure, or where that has none, rods where two points, or a point and the origin, keep
    !! their distance whatever the coordinates are.
    use lagrangia_data_files, only: script_path
    use lagrangia_description, only: description_t
    use lagrangia_errors, only: error_t
    use lagrangia_figure_edges, only: find_edges, has_edges
    use lagrangia_hyperdual, only: hyperdual_t
    use lagrangia_kinds, only: dp
    use lagrangia_mode_script, only: is_mass, is_rod, is_way, mode_script, most_panels, &
                                     part_of_modes
    use lagrangia_output_file, only: commit_both, output_file_t
    use lagrangia_scene_figure, only: figure_t, new_figure
    use lagrangia_small_oscillations, only: modes_t
    use lagrangia_system, only: system_t
    use lagrangia_text, only: to_text
    use lagrangia_text_table, only: text_table_t
    implicit none (type, external)
    private
    public :: has_positions, mode_picture_path, widest_angle, write_mode_picture

    integer, parameter :: pieces = 24          !! of the way that a mass takes
    integer, parameter :: columns = 9          !! of the data file
    real(dp), parameter :: reach = 0.25_dp     !! of a mass, of the size of the mechanism
    real(dp), parameter :: widest_angle = 0.7_dp  !! rad
    real(dp), parameter :: still = 1e-9_dp     !! of the size of the mechanism: does not move
    real(dp), parameter :: pi = acos(-1.0_dp)

    type :: picture_t
        !! What is drawn, a row each: mode, side, kind, x, y, z, dx, dy, dz.
        real(dp), allocatable :: rows(:, :)
        integer :: count = 0
    end type picture_t

contains

    pure function has_positions(system) result(yes)
        !! Whether there is a mechanism to draw.
        class(system_t), intent(in) :: system  !! with its parameters
        logical :: yes
        type(description_t) :: d

        call system%describe(d)
        yes = .false.
        if (allocated(d%points)) yes = size(d%points) > 0
    end function has_positions

    pure function mode_picture_path(stem) result(path)
        !! `STEM_modes.dat`.
        character(*), intent(in) :: stem  !! folder, and how the names of all files begin
        character(:), allocatable :: path

        path = stem//"_modes.dat"
    end function mode_picture_path

    subroutine write_mode_picture(system, own, modes, stem, title, error)
        !! `STEM_modes.dat` and its script, of a system that has positions.
        class(system_t), intent(in) :: system  !! with its parameters
        character(*), intent(in) :: own(:)     !! parts of a scene's figure; none: the system's
        type(modes_t), intent(in) :: modes     !! of this system
        character(*), intent(in) :: stem       !! folder, and how the names of all files begin
        character(*), intent(in) :: title      !! whose modes, in words, and what is changed
        type(error_t), allocatable, intent(out) :: error  !! of a file; then there is none
        type(description_t) :: d
        type(text_table_t) :: table
        type(output_file_t) :: script
        type(picture_t) :: picture
        character(200) :: header(4)
        integer :: i

        call system%describe(d)
        call fill(system, own, modes, size(d%points), picture)
        header(1) = title//": small oscillations as the mechanism, the shapes enlarged"
        header(2) = "side: 0 at rest, 1 and -1 displaced; kind: 0 a mass, 1 a rod or "// &
                    "an edge, 2 the way of a mass"
        header(3) = "from (x, y, z) to (x + dx, y + dy, z + dz)"
        header(4) = part_of_modes(modes)
        call table%file%open(mode_picture_path(stem), error)
        if (allocated(error)) return
        call table%begin(header(:merge(3, 4, header(4) == "")), &
                         ["mode", "side", "kind", "x   ", "y   ", "z   ", "dx  ", "dy  ", "dz  "], &
                         ["1", "1", "1", "m", "m", "m", "m", "m", "m"], error)
        if (allocated(error)) return
        do i = 1, picture%count
            call table%row(picture%rows(:, i))
        end do
        call table%finish("rows: "//to_text(picture%count), error)
        if (allocated(error)) return
        call script%open(script_path(table%file%name()), error)
        if (allocated(error)) call table%file%abandon()
        if (allocated(error)) return
        call script%write(mode_script(modes, picture%rows(:, :picture%count), &
                                      mode_picture_path(stem), title))
        call commit_both(table%file, script, error)
    end subroutine write_mode_picture

    subroutine fill(system, own, modes, points, picture)
        !! All rows. What a mode does not move is drawn once, at rest.
        class(system_t), intent(in) :: system
        character(*), intent(in) :: own(:)
        type(modes_t), intent(in) :: modes
        integer, intent(in) :: points
        type(picture_t), intent(out) :: picture
        logical, allocatable :: rods(:, :)  ! too many for the stack
        type(figure_t) :: figure
        type(error_t), allocatable :: error
        real(dp), allocatable :: at_rest(:, :, :)
        real(dp) :: at(3, 0:points), first(3, 0:points), last(3, 0:points), q(system%ndof)
        real(dp) :: high(system%ndof), low(system%ndof), size_of_all
        integer :: i, j, k, shown
        logical :: drawn

        allocate (rods(0:points, points))
        call find_rods(system, modes%at, points, rods)
        call place(system, modes%at, points, at)
        size_of_all = extent(at, rods)
        shown = min(size(modes%omega2), most_panels)
        low = modes%at
        high = modes%at
        do j = 1, shown
            do i = 1, 2
                q = displaced(system, modes, j, points, size_of_all, (i - 1)*pi)
                low = min(low, q)
                high = max(high, q)
            end do
        end do
        call new_figure(system, own, size_of_all, low, high, figure, error)
        drawn = .not. allocated(error)  ! else points and rods are drawn all the same
        if (drawn) drawn = has_edges(figure)
        if (drawn) rods = .false.
        allocate (picture%rows(columns, 0))
        do j = 1, shown
            call add_state(picture, j, 0, at, rods, at, -1.0_dp)
            call add_edges(j, 0, modes%at)
            do i = 1, 2
                q = displaced(system, modes, j, points, size_of_all, (i - 1)*pi)
                call place(system, q, points, last)
                call add_state(picture, j, 3 - 2*i, last, rods, at, still*size_of_all)
                call add_edges(j, 3 - 2*i, q)
            end do
            do i = 0, pieces
                q = displaced(system, modes, j, points, size_of_all, 2.0_dp*pi*i/pieces)
                call place(system, q, points, last)
                do k = 1, points
                    if (i > 0) call add(picture, j, 0, is_way, first(:, k), last(:, k))
                end do
                first = last
            end do
        end do
    contains
        subroutine add_edges(mode, side, state)
            integer, intent(in) :: mode, side
            real(dp), intent(in) :: state(:)
            real(dp), allocatable :: edges(:, :, :), r(:, :)
            integer :: n

            if (.not. drawn) return
            allocate (r(3, figure%places))
            call figure%place(system, 0.0_dp, state, 0.0_dp*state, r)
            call find_edges(figure, r, size_of_all, edges)
            if (side == 0) at_rest = edges
            do n = 1, size(edges, 3)
                if (side /= 0 .and. &
                    maxval(abs(edges(:, :, n) - at_rest(:, :, n))) <= still*size_of_all) cycle
                call add(picture, mode, side, is_rod, edges(:, 1, n), edges(:, 2, n))
            end do
        end subroutine add_edges
    end subroutine fill

    pure subroutine add_state(picture, mode, side, at, rods, at_rest, least)
        !! The mechanism in one position.
        type(picture_t), intent(inout) :: picture
        integer, intent(in) :: mode, side
        real(dp), intent(in) :: at(:, 0:)
        logical, intent(in) :: rods(0:, :)
        real(dp), intent(in) :: at_rest(:, 0:)
        real(dp), intent(in) :: least  !! m; only what is further from its place at rest is drawn
        logical :: moves(0:size(rods, 2))
        integer :: i, k

        moves = norm2(at - at_rest, 1) > least
        do k = 1, size(rods, 2)
            do i = 0, size(rods, 2)
                if (.not. (moves(i) .or. moves(k))) cycle
                if (rods(i, k)) call add(picture, mode, side, is_rod, at(:, i), at(:, k))
            end do
        end do
        do k = 1, size(rods, 2)
            if (moves(k)) call add(picture, mode, side, is_mass, at(:, k), at(:, k))
        end do
    end subroutine add_state

    pure subroutine add(picture, mode, side, kind, from, to)
        !! One more row.
        type(picture_t), intent(inout) :: picture
        integer, intent(in) :: mode, side, kind
        real(dp), intent(in) :: from(3), to(3)
        real(dp), allocatable :: more(:, :)

        if (picture%count == size(picture%rows, 2)) then
            allocate (more(columns, 2*picture%count + 64))
            more(:, :picture%count) = picture%rows
            call move_alloc(more, picture%rows)
        end if
        picture%count = picture%count + 1
        picture%rows(:, picture%count) = [real(mode, dp), real(side, dp), real(kind, dp), from, &
                                          to - from]
    end subroutine add

    pure subroutine place(system, q, points, at)
        !! Every point, and the origin in front of them.
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: q(:)
        integer, intent(in) :: points
        real(dp), intent(out) :: at(3, 0:points)
        type(hyperdual_t) :: r(3, points), qs(size(q)), t

        qs%re = q
        call system%positions(t, qs, r)
        at(:, 0) = 0.0_dp
        at(:, 1:) = r%re
    end subroutine place

    pure subroutine find_rods(system, at, points, rods)
        !! Whether two points, of which number 0 is the origin, keep their distance, to rounding,
        !! wherever the coordinates are; where they are in one place, there is no rod.
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: at(:)
        integer, intent(in) :: points
        logical, intent(out) :: rods(0:points, points)
        integer, parameter :: tries = 5
        real(dp), parameter :: rounding = 1e3_dp*epsilon(1.0_dp)
        real(dp) :: here(3, 0:points), length, now(3, 0:points), q(size(at))
        integer :: i, j, k, try

        call place(system, at, points, here)
        rods = .false.
        do k = 1, points
            rods(:k - 1, k) = .true.
        end do
        do try = 1, tries
            ! Any coordinates will do that are not those of the equilibrium.
            q = at + [(0.3_dp*sin(1.7_dp*try + 2.3_dp*j), j=1, size(at))]
            call place(system, q, points, now)
            do k = 1, points
                do i = 0, k - 1
                    length = norm2(here(:, k) - here(:, i))
                    rods(i, k) = rods(i, k) .and. length > 0.0_dp .and. &
                                 abs(norm2(now(:, k) - now(:, i)) - length) <= rounding*length
                end do
            end do
        end do
    end subroutine find_rods

    pure function extent(at, rods) result(length)
        !! Of the mechanism at rest, with the origin where a rod begins there; 1 m if it is a point.
        real(dp), intent(in) :: at(:, 0:)
        logical, intent(in) :: rods(0:, :)
        real(dp) :: length
        integer :: first

        first = merge(0, 1, any(rods(0, :)))
        length = maxval(maxval(at(:, first:), 2) - minval(at(:, first:), 2))
        if (length <= 0.0_dp) length = 1.0_dp
    end function extent

    pure function displaced(system, modes, j, points, size_of_all, phase) result(q)
        !! Mode `j` at a phase, so large that the mass that moves most moves a quarter of the size
        !! of all, but no angle more than `widest_angle`.
        class(system_t), intent(in) :: system
        type(modes_t), intent(in) :: modes
        integer, intent(in) :: j, points
        real(dp), intent(in) :: size_of_all, phase
        real(dp) :: q(size(modes%at))
        real(dp), parameter :: little = 1e-4_dp
        type(description_t) :: d
        real(dp) :: amplitude, moved, rest(3, 0:points), shape(size(q)), there(3, 0:points)
        real(dp) :: turned
        integer :: i

        call place(system, modes%at, points, rest)
        turned = 0.0_dp
        moved = 0.0_dp
        call system%describe(d)
        do i = 1, 2
            shape = modes%shapes(:, j)
            if (i == 2 .and. .not. allocated(modes%quadrature)) exit
            if (i == 2) shape = modes%quadrature(:, j)
            turned = max(turned, maxval(abs(shape), d%coordinates%unit == "rad"))
            call place(system, modes%at + little/max(tiny(1.0_dp), maxval(abs(shape)))*shape, &
                       points, there)
            moved = max(moved, maxval(norm2(there - rest, 1))*maxval(abs(shape))/little)
        end do
        amplitude = reach*size_of_all/max(moved, tiny(1.0_dp))
        if (turned > 0.0_dp) amplitude = min(amplitude, widest_angle/turned)
        q = modes%at + amplitude*cos(phase)*modes%shapes(:, j)
        if (allocated(modes%quadrature)) q = q - amplitude*sin(phase)*modes%quadrature(:, j)
    end function displaced
end module lagrangia_mode_picture
