module lagrangia_modes_film
    !! Small oscillations as films: each mode drawn as the mechanism, on one page.
    use lagrangia_animation, only: page_of_films, write_page
    use lagrangia_channels, only: bytes_beside, bytes_of_number
    use lagrangia_errors, only: error_t, fail
    use lagrangia_film, only: count_channels, film_json, furthest
    use lagrangia_frames, only: film_speed, frames_t
    use lagrangia_json, only: json_element, json_object, json_pair
    use lagrangia_kinds, only: dp
    use lagrangia_small_oscillations, only: is_oscillation, is_unstable, is_zero_mode, &
                                            modes_t, stays
    use lagrangia_system, only: system_t
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: animate_modes

    integer, parameter :: frames_of_mode = 72
    integer, parameter :: most_bytes = 215000  !! of the series of a page, of 300 kB
    real(dp), parameter :: share = 0.15_dp     !! of the figure's size, that a point moves at most
    real(dp), parameter :: pi = acos(-1.0_dp)

contains

    subroutine animate_modes(system, own, modes, path, subject, error)
        !! Write the page of all modes, or of the first that fit into it. The amplitude is such
        !! that it can be seen; the motion is that of the linear equations, a period of it, or two
        !! growth times of \(\cosh\), or a second of a zero mode.
        class(system_t), intent(in) :: system   !! with its parameters
        character(*), intent(in) :: own(:)      !! parts of a scene's figure; none: the system's
        type(modes_t), intent(in) :: modes      !! of this system
        character(*), intent(in) :: path        !! of the page
        character(*), intent(in) :: subject     !! the scene's or system's name, what was set
        type(error_t), allocatable, intent(out) :: error  !! 2: too many parts; 5: of the file
        type(frames_t) :: frames, nothing
        real(dp), allocatable :: kinetic(:), potential(:)
        character(:), allocatable :: films, members, name, title
        real(dp) :: rate
        integer :: channels, j, shown

        films = ""
        name = ""
        shown = size(modes%omega2)
        do j = 1, size(modes%omega2)
            if (j > shown) exit
            call move_in_mode(system, own, modes, j, frames, kinetic, potential)
            if (j == 1) then
                call count_channels(system, own, frames, channels, error)
                if (allocated(error)) return
                shown = min(shown, most_bytes/(channels*(bytes_beside + bytes_of_number* &
                                                         frames%count)))
            end if
            if (shown == 0) then
                call fail(error, "no film of so many moving parts fits into a page of 300 kB")
                return
            end if
            call film_json(system, own, frames, nothing, members, error, kinetic, potential)
            if (allocated(error)) return
            rate = sqrt(abs(modes%omega2(j)))
            name = "mode "//to_text(j)
            if (shown < size(modes%omega2)) name = name//" of "//to_text(size(modes%omega2))
            if (modes%label(j) == is_zero_mode) then
                if (stays(modes, j)) then
                    name = name//": at rest beside the equilibrium"
                else
                    name = name//": uniform motion"
                end if
            end if
            members = json_pair("factor", speed(frames, rate))// &
                      json_pair("loop", modes%label(j) == is_oscillation)//members
            if (modes%label(j) == is_oscillation) members = json_pair("omega", rate)//members
            if (modes%label(j) == is_unstable) members = json_pair("growth", rate)//members
            films = films//json_element(json_object(json_pair("name", name)//members))
        end do
        title = subject//": small oscillations"
        if (lge(title(:1), "a") .and. lle(title(:1), "z")) title(:1) = achar(iachar(title(:1)) - 32)
        call write_page(path, title, page_of_films(system, title, "linear equations of motion", &
                                                   films), error)
    end subroutine animate_modes

    pure function speed(frames, rate) result(factor)
        !! Of the film: real time for all modes that can be followed in it.
        type(frames_t), intent(in) :: frames
        real(dp), intent(in) :: rate  !! rad/s
        real(dp) :: factor

        factor = film_speed(max(frames%t(frames%count), 4.0_dp), rate)
    end function speed

    subroutine move_in_mode(system, own, modes, j, frames, kinetic, potential)
        !! States of a mode, and its energies: \(\tfrac12\,\dot u\cdot M\dot u\) and
        !! \(\tfrac12\,u\cdot Ku\), \(u\) the distance from the equilibrium.
        class(system_t), intent(in) :: system
        character(*), intent(in) :: own(:)
        type(modes_t), intent(in) :: modes
        integer, intent(in) :: j
        type(frames_t), intent(out) :: frames
        real(dp), allocatable, intent(out) :: kinetic(:), potential(:)  !! J
        real(dp), dimension(size(modes%at)) :: even, odd, u, v
        real(dp) :: duration, rate, amplitude, t
        integer :: i, n

        n = frames_of_mode + 1
        frames%count = n
        allocate (frames%t(n), frames%q(size(u), n), frames%v(size(u), n), kinetic(n), potential(n))
        even = without_rounding(modes%shapes(:, j))
        odd = 0.0_dp
        if (allocated(modes%quadrature)) odd = without_rounding(modes%quadrature(:, j))
        rate = sqrt(abs(modes%omega2(j)))
        duration = 1.0_dp
        if (modes%label(j) == is_oscillation) duration = 2.0_dp*pi/rate
        if (modes%label(j) == is_unstable) duration = 2.0_dp/rate
        frames%interval = duration/frames_of_mode
        amplitude = furthest(system, own, modes%at, even, share)
        do i = 1, n
            t = frames%interval*(i - 1)
            if (modes%label(j) == is_oscillation) then
                u = even*cos(rate*t) - odd*sin(rate*t)
                v = -rate*(even*sin(rate*t) + odd*cos(rate*t))
            else if (modes%label(j) == is_unstable) then
                u = even*cosh(rate*t)/cosh(2.0_dp)
                v = rate*even*sinh(rate*t)/cosh(2.0_dp)
            else if (stays(modes, j)) then
                u = even
                v = 0.0_dp
            else
                u = even*t
                v = even
            end if
            u = amplitude*u
            v = amplitude*v
            frames%t(i) = t
            frames%q(:, i) = modes%at + u
            frames%v(:, i) = v
            kinetic(i) = 0.5_dp*dot_product(v, matmul(modes%mass, v))
            potential(i) = 0.5_dp*dot_product(u, matmul(modes%stiffness, u))
        end do
    contains
        pure function without_rounding(shape) result(kept)
            !! A coordinate that the mode leaves alone is exactly 0: \(u\cdot Mu = 1\).
            real(dp), intent(in) :: shape(:)
            real(dp) :: kept(size(shape))
            integer :: k

            kept = shape
            do k = 1, size(shape)
                if (sqrt(modes%mass(k, k))*abs(shape(k)) < 16.0_dp*epsilon(1.0_dp)) kept(k) = 0.0_dp
            end do
        end function without_rounding
    end subroutine move_in_mode
end module lagrangia_modes_film
