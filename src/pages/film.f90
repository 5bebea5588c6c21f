module lagrangia_film
    !! What a page draws of one motion, as JSON: the parts of the mechanism and their places, the
    !! coordinates, velocities and energies in time, and a second motion beside the first.
    use lagrangia_channels, only: channels_t
    use lagrangia_description, only: description_t
    use lagrangia_errors, only: error_t
    use lagrangia_frames, only: frames_t
    use lagrangia_hyperdual, only: hyperdual_t
    use lagrangia_json, only: json_array, json_element, json_item, json_object, json_pair
    use lagrangia_kinds, only: dp
    use lagrangia_mode_picture, only: widest_angle
    use lagrangia_scene_figure, only: figure_t, new_figure
    use lagrangia_system, only: system_t
    use lagrangia_text, only: to_text
    use lagrangia_vectors, only: farthest
    implicit none (type, external)
    private
    public :: count_channels, film_json, furthest

    integer, parameter :: most_coordinates = 6  !! whose values and phase portrait are shown

contains

    subroutine film_json(system, own, frames, reference, film, error, kinetic, potential)
        !! Members of a JSON object: `count`, `interval`, `t`, `parts`, `places`, ...
        class(system_t), intent(in) :: system       !! whose motion it is
        character(*), intent(in) :: own(:)          !! parts of its figure; none: the system's
        type(frames_t), intent(in) :: frames        !! the motion, one state at least
        type(frames_t), intent(in) :: reference     !! of the same times; `count` 0: none
        character(:), allocatable, intent(out) :: film    !! for `json_object`
        type(error_t), allocatable, intent(out) :: error  !! a figure that cannot be read
        real(dp), intent(in), optional :: kinetic(:), potential(:)
        !! energies, J, `(count)`, where they are not those of the states
        type(channels_t) :: channels
        type(figure_t) :: figure
        real(dp), allocatable :: r(:, :, :), other(:, :, :), distance(:), moving(:), rest(:)
        real(dp) :: extent
        integer :: i, n, which

        n = frames%count
        extent = extent_of(system, frames)
        call new_figure(system, own, extent, minval(frames%q(:, :n), 2), &
                        maxval(frames%q(:, :n), 2), figure, error)
        if (allocated(error)) return
        call place_all(figure, system, frames, n, r)
        film = json_pair("count", n)//json_pair("interval", frames%interval)// &
               json_pair("start", frames%t(1))//json_pair("end", frames%t(n))// &
               json_item("parts", parts_json(figure))// &
               json_item("places", places_json(r, channels))
        call add_states(system, frames, n, film, channels)
        if (present(kinetic)) then
            call add_energies(kinetic, potential, .true., film, channels)
        else
            allocate (moving(n), rest(n))
            do i = 1, n
                moving(i) = kinetic_energy(system, frames%t(i), frames%q(:, i), frames%v(:, i))
                rest(i) = system%energy(frames%t(i), frames%q(:, i), frames%v(:, i)) - moving(i)
            end do
            ! An impact may take energy away.
            call add_energies(moving, rest, system%conserves_energy() .and. system%contacts == 0, &
                              film, channels)
        end if
        if (reference%count == n) then
            call place_all(figure, system, reference, n, other)
            allocate (distance(n))
            do i = 1, n
                if (figure%places > 0) then
                    distance(i) = sqrt(maxval(sum((r(:, :, i) - other(:, :, i))**2, 1)))
                else
                    distance(i) = farthest(frames%q(:, i), reference%q(:, i))
                end if
            end do
            call channels%add(log10(max(distance, 1e-18_dp)), which)
            film = film//json_pair("distance", which)
            if (maxval(distance) > extent/500.0_dp) film = film// &
                json_item("ghost", places_json(other, channels))// &
                json_item("ghost_states", states_json(system, reference, n, channels))
        end if
        film = film//json_item("channels", "["//channels%json//"]")
    end subroutine film_json

    subroutine count_channels(system, own, frames, count, error)
        !! How many series a film of this motion has at most.
        class(system_t), intent(in) :: system    !! whose motion it is
        character(*), intent(in) :: own(:)       !! parts of its figure; none: the system's
        type(frames_t), intent(in) :: frames     !! some of it
        integer, intent(out) :: count            !! of `channels`
        type(error_t), allocatable, intent(out) :: error  !! a figure that cannot be read
        type(channels_t) :: channels
        type(figure_t) :: figure
        real(dp), allocatable :: r(:, :, :)
        character(:), allocatable :: places

        count = 0
        call new_figure(system, own, extent_of(system, frames), minval(frames%q, 2), &
                        maxval(frames%q, 2), figure, error)
        if (allocated(error)) return
        call place_all(figure, system, frames, frames%count, r)
        places = places_json(r, channels)
        count = 2*channels%count + 4*min(system%ndof, most_coordinates) + 3
    end subroutine count_channels

    function extent_of(system, frames) result(extent)
        !! The diagonal of the box around the origin and all points at all times, m; 1 if that is 0.
        class(system_t), intent(in) :: system
        type(frames_t), intent(in) :: frames
        real(dp) :: extent
        type(description_t) :: d
        type(hyperdual_t), allocatable :: r(:, :)
        type(hyperdual_t) :: q(system%ndof)
        real(dp) :: low(3), high(3)
        integer :: i, k

        low = 0.0_dp
        high = 0.0_dp
        call system%describe(d)
        if (allocated(d%points)) then
            allocate (r(3, size(d%points)))
            do i = 1, frames%count
                q%re = frames%q(:, i)
                call system%positions(hyperdual_t(re=frames%t(i)), q, r)
                do k = 1, size(r, 2)
                    low = min(low, r(:, k)%re)
                    high = max(high, r(:, k)%re)
                end do
            end do
        end if
        extent = norm2(high - low)
        if (.not. (extent > 0.0_dp .and. extent <= huge(extent))) extent = 1.0_dp
    end function extent_of

    subroutine place_all(figure, system, frames, n, r)
        !! All places at all times, `r(3, places, n)`.
        type(figure_t), intent(in) :: figure
        class(system_t), intent(in) :: system
        type(frames_t), intent(in) :: frames
        integer, intent(in) :: n
        real(dp), allocatable, intent(out) :: r(:, :, :)
        integer :: i

        allocate (r(3, figure%places, n))
        do i = 1, n
            call figure%place(system, frames%t(i), frames%q(:, i), frames%v(:, i), r(:, :, i))
        end do
    end subroutine place_all

    function parts_json(figure) result(json)
        !! `[{"kind": "rod", "at": [0, 1]}, ...]`.
        type(figure_t), intent(in) :: figure
        character(:), allocatable :: at, json, members
        integer :: i, k

        json = ""
        do i = 1, size(figure%parts)
            associate (part => figure%parts(i))
                members = json_pair("kind", part%kind)
                if (part%label /= "") members = members//json_pair("label", part%label)
                at = ""
                do k = 1, part%count
                    at = at//json_element(to_text(part%at(k) - 1))
                end do
                json = json//json_element(json_object(members//json_item("at", json_array(at))))
            end associate
        end do
        json = json_array(json)
    end function parts_json

    function places_json(r, channels) result(json)
        !! Three numbers or series a place.
        real(dp), intent(in) :: r(:, :, :)
        type(channels_t), intent(inout) :: channels
        character(:), allocatable :: json, item, place
        integer :: i, k

        json = ""
        do i = 1, size(r, 2)
            place = ""
            do k = 1, 3
                call channels%number(r(k, i, :), item)
                place = place//json_element(item)
            end do
            json = json//json_element(json_array(place))
        end do
        json = json_array(json)
    end function places_json

    subroutine add_states(system, frames, n, film, channels)
        !! Coordinates and their velocities.
        class(system_t), intent(in) :: system
        type(frames_t), intent(in) :: frames
        integer, intent(in) :: n
        character(:), allocatable, intent(inout) :: film
        type(channels_t), intent(inout) :: channels
        type(description_t) :: d
        character(:), allocatable :: json
        integer :: i

        call system%describe(d)
        json = ""
        do i = 1, min(system%ndof, most_coordinates)
            json = json//json_element(json_object( &
                json_pair("name", d%coordinates(i)%name)// &
                json_pair("unit", d%coordinates(i)%unit)// &
                json_pair("meaning", d%coordinates(i)%meaning)))
        end do
        film = film//json_item("coordinates", json_array(json))// &
               json_item("states", states_json(system, frames, n, channels))
    end subroutine add_states

    subroutine add_energies(kinetic, rest, conserved, film, channels)
        !! The part that is quadratic in the velocities, and with the rest the energy function.
        real(dp), intent(in) :: kinetic(:), rest(:)
        logical, intent(in) :: conserved
        character(:), allocatable, intent(inout) :: film
        type(channels_t), intent(inout) :: channels
        character(:), allocatable :: json

        call channels%number(kinetic + rest, json)
        film = film//json_item("energy", json)
        call channels%number(kinetic, json)
        film = film//json_item("kinetic", json)//json_pair("conserved", conserved)
    end subroutine add_energies

    function furthest(system, own, at, shape, share) result(amplitude)
        !! How many `shape`s away from `at` a place of the figure has moved by `share` of the
        !! figure's size, to first order, but no angle further than `widest_angle`; without a
        !! figure, a coordinate by `share`.
        class(system_t), intent(in) :: system       !! with its parameters
        character(*), intent(in) :: own(:)          !! parts of its figure; none: the system's
        real(dp), intent(in) :: at(:), shape(:)     !! coordinates; a direction, (ndof)
        real(dp), intent(in) :: share               !! of the size
        real(dp) :: amplitude
        real(dp), parameter :: step = 1e-6_dp
        type(figure_t) :: figure
        type(error_t), allocatable :: error
        real(dp), allocatable :: here(:, :), there(:, :)
        type(description_t) :: d
        real(dp) :: moved, still(size(at)), turned

        amplitude = share/maxval(abs(shape))
        call new_figure(system, own, 1.0_dp, at, at, figure, error)
        if (allocated(error)) return
        allocate (here(3, figure%places), there(3, figure%places))
        still = 0.0_dp
        call figure%place(system, 0.0_dp, at, still, here)
        call figure%place(system, 0.0_dp, at + step*amplitude*shape, still, there)
        if (figure%places == 0) return
        moved = sqrt(maxval(sum((there - here)**2, 1)))/step
        if (moved > 0.0_dp) amplitude = amplitude*share/moved* &
            max(norm2(maxval(here, 2) - minval(here, 2)), epsilon(moved))
        call system%describe(d)
        turned = maxval(abs(shape), d%coordinates%unit == "rad")
        if (turned > 0.0_dp) amplitude = min(amplitude, widest_angle/turned)
    end function furthest

    function states_json(system, frames, n, channels) result(json)
        !! `[[q, v], ...]`, a pair a coordinate.
        class(system_t), intent(in) :: system
        type(frames_t), intent(in) :: frames
        integer, intent(in) :: n
        type(channels_t), intent(inout) :: channels
        character(:), allocatable :: json, position, velocity
        integer :: i

        json = ""
        do i = 1, min(system%ndof, most_coordinates)
            call channels%number(frames%q(i, :n), position)
            call channels%number(frames%v(i, :n), velocity)
            json = json//json_element(json_array(json_element(position)//json_element(velocity)))
        end do
        json = json_array(json)
    end function states_json

    function kinetic_energy(system, t, q, v) result(kinetic)
        !! \(\tfrac12\,\dot q\cdot M\dot q\), \(M = \partial^2 L/\partial\dot q^2\).
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t, q(:), v(:)
        real(dp) :: kinetic
        type(hyperdual_t) :: l, x(size(q)), u(size(v))

        x%re = q
        u%re = v
        u%d1 = v
        u%d2 = v
        l = system%lagrangian(hyperdual_t(re=t), x, u)
        kinetic = 0.5_dp*l%d12
    end function kinetic_energy
end module lagrangia_film
