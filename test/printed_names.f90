module printed_names
    !! What the letters of a printed description stand for, in a state of a system: coordinates,
    !! parameters, quantities and points by their names, and the short letters that `describe` uses.
    use formula, only: formula_value, names_t
    use lagrangia_description, only: default_values, description_t, name_length, value_names
    use lagrangia_hyperdual, only: hyperdual, hyperdual_t
    use lagrangia_kinds, only: dp
    use lagrangia_point_motion, only: expand_points, point_motion_t
    use lagrangia_system, only: system_t
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: name_state

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
        character(name_length), allocatable :: names_of_values(:)
        real(dp), allocatable :: values(:)
        real(dp) :: a(size(q)), p(size(q)), x(3), value, size_of
        logical :: ok
        integer :: i

        call system%describe(d)
        allocate (r(3, size(d%points)))
        call system%accelerations(t, q, v, a)
        call system%momenta(t, q, v, p)
        call names%set("t", t)
        call names%set("pi", acos(-1.0_dp))
        do i = 1, size(q)
            name = trim(d%coordinates(i)%name)
            call names%set(name, q(i))
            call names%set(name//"_dot", v(i))
            call names%set(name//"_ddot", a(i))
            call names%set("p_"//name, p(i))
        end do
        allocate (names_of_values, source=value_names(d))
        allocate (values, source=default_values(d))
        do i = 1, size(values)
            call names%set(trim(names_of_values(i)), values(i))
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
            call names%set("z_"//name, x(3))
            if (d%name /= "hanging_chain") cycle
            call names%set("x"//to_text(i), x(1))
            call names%set("y"//to_text(i), x(2))
            call names%set("x"//to_text(i)//"_dot", motion%velocity(3*i - 2))
            call names%set("y"//to_text(i)//"_dot", motion%velocity(3*i - 1))
            call names%set("x"//to_text(i)//"_ddot", motion%acceleration(3*i - 2))
            call names%set("y"//to_text(i)//"_ddot", motion%acceleration(3*i - 1))
        end do
        l = system%lagrangian(hyperdual(t), hyperdual(q), hyperdual(v))
        call names%set("T", 0.5_dp*sum(motion%mass*motion%velocity**2))
        call names%set("V", names%value_of("T") - l%re)
        if (d%name == "atwood") call names%set("phi_pulley", q(1)/d%parameters(5)%value(1))
        if (d%name == "driven_pendulum") then
            associate (a => d%parameters(4)%value(1), w => d%parameters(5)%value(1))
                call names%set("y_p_dot", -a*w*sin(w*t))
                call names%set("y_p_ddot", -a*w**2*cos(w*t))
            end associate
        else if (d%name == "rotating_wire") then
            call names%set("|omega|", abs(d%parameters(2)%value(1)))
        end if
        if (.not. allocated(d%letters)) return
        do i = 1, size(d%letters)
            call formula_value(trim(d%letters(i)%formula), names, value, size_of, ok)
            if (ok) call names%set(trim(d%letters(i)%name), value)
        end do
    end subroutine name_state
end module printed_names
