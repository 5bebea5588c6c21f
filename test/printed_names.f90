module printed_names
    !! What the letters of a printed description stand for, in a state of a system: coordinates,
    !! parameters, quantities and points by their names, and the short letters that `describe` uses.
    use formula, only: names_t
    use lagrangia_description, only: description_t
    use lagrangia_hyperdual, only: hyperdual, hyperdual_t
    use lagrangia_kinds, only: dp
    use lagrangia_point_motion, only: expand_points, point_motion_t
    use lagrangia_system, only: system_t
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: name_component, name_link, name_state

contains

    subroutine name_state(system, t, q, v, names)
        !! Everything that has one value in this state.
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t, q(:), v(:)
        type(names_t), intent(out) :: names
        type(description_t) :: d
        type(point_motion_t) :: motion
        type(hyperdual_t) :: l
        type(hyperdual_t), allocatable :: r(:, :)
        character(:), allocatable :: name
        real(dp), allocatable :: values(:)
        real(dp) :: a(size(q)), p(size(q)), x(3)
        integer :: i

        call system%describe(d)
        allocate (r(3, size(d%points)))
        call system%accelerations(t, q, v, a)
        call system%momenta(t, q, v, p)
        call names%set("t", t)
        do i = 1, size(q)
            name = trim(d%coordinates(i)%name)
            call names%set(name, q(i))
            call names%set(name//"_dot", v(i))
            call names%set(name//"_ddot", a(i))
            call names%set("p_"//name, p(i))
        end do
        do i = 1, size(d%parameters)
            call names%set(trim(d%parameters(i)%name), d%parameters(i)%value(1))
        end do
        do i = 1, size(d%quantities)
            call names%set(trim(d%quantities(i)%name), system%quantity(i, t, q, v))
        end do
        call expand_points(system, t, q, v, a, motion)
        call system%positions(hyperdual(t), hyperdual(q), r)
        do i = 1, size(d%points)
            name = trim(d%points(i)%name)
            x = r(:, i)%re
            call names%set("x_"//name, x(1))
            call names%set("y_"//name, x(2))
            call names%set("x"//to_text(i), x(1))
            call names%set("y"//to_text(i), x(2))
            if (i > 1) cycle
            if (all(d%coordinates%name /= "x")) call names%set("x", x(1))
            if (all(d%coordinates%name /= "y")) call names%set("y", x(2))
            if (all(d%coordinates%name /= "z")) call names%set("z", x(3))
        end do
        l = system%lagrangian(hyperdual(t), hyperdual(q), hyperdual(v))
        call names%set("V", 0.5_dp*sum(motion%mass*motion%velocity**2) - l%re)
        allocate (values(size(d%parameters)))
        values = d%parameters%value(1)
        call name_letters(trim(d%name), values, q, v, names)
    end subroutine name_state

    subroutine name_letters(system, p, q, v, names)
        !! The short letters, each explained in the description of its parameter or in a note.
        character(*), intent(in) :: system
        real(dp), intent(in) :: p(:), q(:), v(:)
        type(names_t), intent(inout) :: names

        select case (system)
        case ("atwood")
            call names%set("I", p(4))
            call names%set("phi", q(1)/p(5))
            call names%set("R", p(5))
            call names%set("a_s", p(6))
        case ("wedge")
            call names%set("m", p(1))
            call names%set("M", p(2))
        case ("double_pendulum")
            call names%set("D", q(1) - q(2))
        case ("rolling_disk")
            call names%set("kappa", p(1)*p(5)*p(2)*sin(p(6))/(p(3) + p(1)*p(2)**2))
            call names%set("lambda_x", names%value_of("friction_x"))
            call names%set("lambda_y", names%value_of("friction_y"))
        case ("rotating_wire")
            call names%set("|omega|", abs(p(2)))
        case ("driven_pendulum")
            call names%set("a", p(4))
            call names%set("W", p(5))
            call names%set("y_p", p(4)*cos(p(5)*names%value_of("t")))
            call names%set("y_p_dot", -p(4)*p(5)*sin(p(5)*names%value_of("t")))
            call names%set("y_p_ddot", -p(4)*p(5)**2*cos(p(5)*names%value_of("t")))
        case ("bouncing_ball")
            call names%set("lambda", names%value_of("contact_force"))
        case ("charged_particle")
            call names%set("e", p(2))
            call names%set("|v|", norm2(v))
            call names%set("v.v", dot_product(v, v))
            call names%set("r.r", dot_product(q, q))
            call names%set("(symmetric gauge)", 1.0_dp)
        case default
            continue
        end select
    end subroutine name_letters

    subroutine name_component(system, t, q, v, i, names)
        !! Of the charge's vectors component `i`, and along B.
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t, q(3), v(3)
        integer, intent(in) :: i
        type(names_t), intent(inout) :: names
        type(description_t) :: d
        real(dp) :: p(3), a(3), n(3), potential(3), turned(3), force(3)

        call system%describe(d)
        call system%momenta(t, q, v, p)
        call system%accelerations(t, q, v, a)
        associate (m => d%parameters(1)%value(1), e => d%parameters(2)%value(1), &
                   electric => d%parameters(3)%value, b => d%parameters(4)%value)
            potential = (p - m*v)/e
            turned = cross(b, q)
            force = cross(v, b)
            n = b/norm2(b)
            call names%set("E.r", dot_product(electric, q))
            call names%set("A.v", dot_product(potential, v))
            call names%set("v_n", dot_product(v, n))
            call names%set("E_n", dot_product(electric, n))
            call names%set("r_n", dot_product(q, n))
            call names%set("E", electric(i))
        end associate
        call names%set("A", potential(i))
        call names%set("v", v(i))
        call names%set("r", q(i))
        call names%set("v_dot", a(i))
        call names%set("B x r", turned(i))
        call names%set("v x B", force(i))
    contains
        pure function cross(x, y) result(z)
            real(dp), intent(in) :: x(3), y(3)
            real(dp) :: z(3)

            z = [x(2)*y(3) - x(3)*y(2), x(3)*y(1) - x(1)*y(3), x(1)*y(2) - x(2)*y(1)]
        end function cross
    end subroutine name_component

    subroutine name_link(system, t, q, v, k, names)
        !! Of the hanging chain rod and bob `k` and their neighbours. The tension of a rod carries
        !! all bobs below it: their masses times what they accelerate more than they fall.
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t, q(:), v(:)
        integer, intent(in) :: k
        type(names_t), intent(inout) :: names
        type(description_t) :: d
        type(point_motion_t) :: motion
        real(dp) :: a(size(q)), tension(size(q) + 1), load(2), x(0:size(q)), y(0:size(q))
        integer :: i, n

        n = size(q)
        call system%describe(d)
        call system%accelerations(t, q, v, a)
        call expand_points(system, t, q, v, a, motion)
        tension = 0.0_dp
        load = 0.0_dp
        do i = n, 1, -1
            load = load + motion%mass(3*i)*motion%acceleration(3*i - 2:3*i - 1)
            load(2) = load(2) + motion%mass(3*i)*d%parameters(4)%value(1)
            tension(i) = dot_product(load, [-sin(q(i)), cos(q(i))])
        end do
        x = 0.0_dp
        y = 0.0_dp
        do i = 1, n
            x(i) = names%value_of("x_bob"//to_text(i))
            y(i) = names%value_of("y_bob"//to_text(i))
            call names%set("theta_"//to_text(i), q(i))
            call names%set("theta_"//to_text(i)//"_dot", v(i))
            call names%set("theta_"//to_text(i)//"_ddot", a(i))
            call names%set("T_"//to_text(i), tension(i))
        end do
        call names%set("T_(n+1)", tension(n + 1))
        call names%set("theta_k", q(k))
        call names%set("theta_k_dot", v(k))
        call names%set("theta_k_ddot", a(k))
        call names%set("theta_(k-1)", q(max(1, k - 1)))
        call names%set("theta_(k+1)", q(min(n, k + 1)))
        call names%set("T_k", tension(k))
        call names%set("T_(k-1)", tension(max(1, k - 1)))
        call names%set("T_(k+1)", tension(k + 1))
        call names%set("x_k", x(k))
        call names%set("y_k", y(k))
        call names%set("x_(k-1)", x(k - 1))
        call names%set("y_(k-1)", y(k - 1))
        call names%set("x_k_dot", motion%velocity(3*k - 2))
        call names%set("y_k_dot", motion%velocity(3*k - 1))
        call names%set("sum over i <= k of sin(theta_i)", sum(sin(q(:k))))
        call names%set("sum of cos(theta_i)", sum(cos(q(:k))))
    end subroutine name_link
end module printed_names
