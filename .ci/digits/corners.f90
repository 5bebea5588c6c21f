module digits_corners
    !! Scenes at random, and in the corners where estimates of errors go wrong.
    use lagrangia_catalogue, only: built_in, nth_system
    use lagrangia_description, only: description_t, name_length
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp
    use lagrangia_methods, only: adaptive_names, method_names
    use lagrangia_random_draws, only: random_t
    use lagrangia_system, only: system_t
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: corner_names, draw_scene

    character(9), parameter :: corner_names(*) = [character(9) :: &
        "ordinary", "wide", "far", "late", "saddle", "event", "bounces", "slow", "light", "small", &
        "ordinary", "long"]
    character(16), parameter :: with_saddle(*) = [character(16) :: "pendulum", "cart_pendulum", &
        "double_pendulum", "rotating_hoop", "driven_pendulum"]
    real(dp), parameter :: pi = acos(-1.0_dp)

contains

    subroutine draw_scene(random, corner, text)
        !! One of `corner_names`; `""` where nothing could be drawn.
        type(random_t), intent(inout) :: random
        integer, intent(in) :: corner
        character(:), allocatable, intent(out) :: text
        class(system_t), allocatable :: system
        type(description_t) :: d
        type(error_t), allocatable :: error
        real(dp), allocatable :: p(:), q(:), v(:)
        real(dp) :: t0, duration

        text = ""
        call draw_system(random, corner, system, d)
        call random%parameters(system, .false., p, error)
        if (allocated(error)) return
        call random%state(system, t0, q, v, error)
        if (allocated(error)) return
        call system%describe(d)  ! of the parameters drawn: a chain has as many coordinates as bobs
        duration = between(random, 0.5_dp, 3.0_dp)
        select case (corner_names(corner))
        case ("wide"); call widen(random, d, p, 3.0_dp, 1)
        case ("far"); call go_far(random, system, q)
        case ("late"); t0 = power(random, 2.0_dp, 9.0_dp)
        case ("saddle")
            call climb(random, d, p, q, v)
            duration = between(random, 1.0_dp, 12.0_dp)
        case ("bounces")
            p(3) = 1.0_dp
            if (chance(random) < 0.5_dp) p(3) = 1.0_dp - power(random, -3.0_dp, 0.0_dp)
            duration = power(random, 0.0_dp, 3.0_dp)
        case ("slow"); call slow_down(random, system, q, v)
        case ("light"); call widen(random, d, p, 16.0_dp, 3)
        case ("small")
            if (system%constraints == 0) then
                q = q*power(random, -12.0_dp, 0.0_dp)
                v = v*power(random, -12.0_dp, 0.0_dp)
            end if
        case ("long"); duration = power(random, 0.5_dp, 1.7_dp)
        case default  ! as drawn
        end select
        if (d%name == "bouncing_ball") q = abs(q)
        call write_scene()
    contains
        subroutine write_scene()
            !! As text: the scene can be tried by hand.
            integer :: i, j, k
            logical :: fixed, stops

            stops = corner_names(corner) == "event"
            if (corner_names(corner) == "bounces") stops = chance(random) < 0.5_dp
            fixed = fast(system, p, t0, q, v)*duration > 1e4_dp
            text = "&scene system = '"//trim(d%name)//"', columns = 't', "// &
                   "error_estimate = .true., t0 = "//to_text(t0)// &
                   ", duration = "//to_text(duration)// &
                   method_of(random, duration, fixed)// &
                   ", q = "//list(q)//", v = "//list(v)
            if (stops) text = text//", event = '"//level(random, d, q, v)//" stop'"
            text = text//" / &"//trim(d%name)
            k = 0
            do i = 1, size(d%parameters)
                j = k + 1
                k = k + d%parameters(i)%count
                if (d%parameters(i)%whole) then
                    text = text//" "//trim(d%parameters(i)%name)//" = "//to_text(nint(p(j)))
                else if (all(p(j:k) >= -huge(t0))) then  ! not NaN
                    text = text//" "//trim(d%parameters(i)%name)//" = "//list(p(j:k))
                end if
            end do
            text = text//" /"
        end subroutine write_scene
    end subroutine draw_scene

    subroutine draw_system(random, corner, system, d)
        !! Any, or one that has what the corner wants.
        type(random_t), intent(inout) :: random
        integer, intent(in) :: corner
        class(system_t), allocatable, intent(out) :: system
        type(description_t), intent(out) :: d
        character(name_length) :: wanted

        wanted = ""
        if (corner_names(corner) == "bounces") wanted = "bouncing_ball"
        if (corner_names(corner) == "saddle") wanted = &
            with_saddle(1 + int(size(with_saddle)*chance(random)))
        do
            call nth_system(min(built_in, 1 + int(built_in*chance(random))), system)
            call system%describe(d)
            if (wanted == "" .or. d%name == wanted) return
        end do
    end subroutine draw_system

    subroutine widen(random, d, p, decades, one_in)
        !! One in so many of the positive parameters by a power of ten.
        type(random_t), intent(inout) :: random
        type(description_t), intent(in) :: d
        real(dp), intent(inout) :: p(:)
        real(dp), intent(in) :: decades
        integer, intent(in) :: one_in
        integer :: i, k

        k = 0
        do i = 1, size(d%parameters)
            k = k + d%parameters(i)%count
            if (d%parameters(i)%whole .or. .not. d%parameters(i)%open_lower) cycle
            if (d%parameters(i)%upper < huge(decades)) cycle
            if (one_in*chance(random) > 1.0_dp) cycle
            p(k) = p(k)*power(random, -decades, merge(decades, 0.0_dp, one_in == 1))
        end do
    end subroutine widen

    subroutine go_far(random, system, q)
        !! A coordinate, or all, by many turns or metres.
        type(random_t), intent(inout) :: random
        class(system_t), intent(in) :: system
        real(dp), intent(inout) :: q(:)
        integer :: i

        if (system%constraints > 0) return
        do i = 1, size(q)
            if (chance(random) < 0.6_dp) q(i) = sign(power(random, 2.0_dp, 10.0_dp), q(i))
        end do
    end subroutine go_far

    subroutine slow_down(random, system, q, v)
        !! Creeping, perhaps far from the origin.
        type(random_t), intent(inout) :: random
        class(system_t), intent(in) :: system
        real(dp), intent(inout) :: q(:), v(:)

        if (system%constraints > 0) return
        v = v*power(random, -14.0_dp, 0.0_dp)
        q = q*power(random, -3.0_dp, 4.0_dp)
    end subroutine slow_down

    subroutine climb(random, d, p, q, v)
        !! To the top, or close to it, or with the speed that leads there.
        type(random_t), intent(inout) :: random
        type(description_t), intent(in) :: d
        real(dp), intent(in) :: p(:)
        real(dp), intent(inout) :: q(:), v(:)
        integer :: angle

        angle = size(q)
        if (d%name == "double_pendulum" .and. chance(random) < 0.5_dp) angle = 1
        if (chance(random) < 0.5_dp) then
            q = 0.0_dp
            v = 0.0_dp
        end if
        if (chance(random) < 0.6_dp) then
            q(angle) = pi
            if (chance(random) < 0.7_dp) q(angle) = pi - power(random, -16.0_dp, -1.0_dp)
            v = v*power(random, -16.0_dp, 0.0_dp)*nint(chance(random))
        else if (d%name == "pendulum") then
            call speed_to_top()
        end if
    contains
        subroutine speed_to_top()
            !! (l v)^2 = 4 g l cos(q/2)^2, but for a little.
            integer :: g, l

            l = findloc(d%parameters%name, "l", 1)
            g = findloc(d%parameters%name, "g", 1)
            v(1) = 2.0_dp*sqrt(p(g)/p(l))*cos(0.5_dp*q(1))
            if (chance(random) < 0.6_dp) v(1) = v(1)*(1.0_dp - power(random, -16.0_dp, -2.0_dp))
        end subroutine speed_to_top
    end subroutine climb

    function fast(system, p, t, q, v) result(rate)
        !! How fast the motion may change, 1/s: a method that chooses its steps would take for ever.
        class(system_t), intent(inout) :: system
        real(dp), intent(in) :: p(:), t, q(:), v(:)
        real(dp) :: rate
        real(dp), dimension(size(q)) :: a, b, q_near, v_near
        type(error_t), allocatable :: error
        integer :: i

        rate = 0.0_dp
        call system%configure(p, error)
        if (allocated(error)) return
        call system%accelerations(t, q, v, a)
        rate = sqrt(maxval(abs(a)))
        do i = 1, size(q)
            q_near = q
            v_near = v
            q_near(i) = q(i) + 1e-3_dp
            v_near(i) = v(i) + 1e-3_dp
            call system%accelerations(t, q_near, v, b)
            rate = max(rate, sqrt(maxval(abs(b - a))*1e3_dp))
            call system%accelerations(t, q, v_near, b)
            rate = max(rate, maxval(abs(b - a))*1e3_dp)
        end do
    end function fast

    function method_of(random, duration, fixed) result(text)
        !! `, method = 'rk4', dt = 0.01` or with a tolerance.
        type(random_t), intent(inout) :: random
        real(dp), intent(in) :: duration
        logical, intent(in) :: fixed
        character(:), allocatable :: text
        character(name_length), allocatable :: names(:)

        if (chance(random) < 0.35_dp .and. .not. fixed) then
            allocate (names, source=adaptive_names())
            text = pick(names)//", samples = "//to_text(1 + int(20*chance(random)))// &
                   ", tolerance = "//to_text(max(1.001e-15_dp, power(random, -15.0_dp, -2.0_dp)))
        else
            allocate (names, source=method_names())
            text = pick(names)//", dt = "//to_text(duration*power(random, -3.5_dp, -0.4_dp))// &
                   ", every = "//to_text(1 + int(20*chance(random)))
        end if
    contains
        function pick(names) result(choice)
            character(*), intent(in) :: names(:)
            character(:), allocatable :: choice

            choice = ", method = '"//trim(names(1 + int(size(names)*chance(random))))//"'"
        end function pick
    end function method_of

    function level(random, d, q, v) result(text)
        !! `theta = 0.5`: where a coordinate may soon be, or a velocity.
        type(random_t), intent(inout) :: random
        type(description_t), intent(in) :: d
        real(dp), intent(in) :: q(:), v(:)
        character(:), allocatable :: text
        integer :: i

        i = 1 + int(size(q)*chance(random))
        if (chance(random) < 0.7_dp) then
            text = trim(d%coordinates(i)%name)//" = "// &
                   to_text(merge(0.0_dp, q(i) + v(i)*chance(random), chance(random) < 0.3_dp))
        else
            text = trim(d%coordinates(i)%name)//"_dot = "// &
                   to_text(v(i)*(chance(random) - 0.2_dp))
        end if
    end function level

    function list(x) result(text)
        !! `1.0, 2.0`
        real(dp), intent(in) :: x(:)
        character(:), allocatable :: text
        integer :: i

        text = to_text(x(1))
        do i = 2, size(x)
            text = text//", "//to_text(x(i))
        end do
    end function list

    function chance(random) result(x)
        !! From 0 to 1, less than 1.
        type(random_t), intent(inout) :: random
        real(dp) :: x

        call random%uniform(0.0_dp, 1.0_dp, x)
    end function chance

    function between(random, low, high) result(x)
        !! Evenly.
        type(random_t), intent(inout) :: random
        real(dp), intent(in) :: low, high
        real(dp) :: x

        call random%uniform(low, high, x)
    end function between

    function power(random, low, high) result(x)
        !! Of ten, evenly in its exponent.
        type(random_t), intent(inout) :: random
        real(dp), intent(in) :: low, high
        real(dp) :: x

        call random%uniform(low, high, x)
        x = 10.0_dp**x
    end function power
end module digits_corners
