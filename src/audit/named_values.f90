module lagrangia_named_values
    !! What the names in a system's formulas stand for at a state, before its own letters: the
    !! time, coordinates, velocities and accelerations, parameters, momenta, generalised forces
    !! beside L, quantities, and where the points are.
    !!
    !! Each value is a hyper-dual number along the motion: `d1` is its rate, `d12` the rate of that,
    !! so that formulas of these get their rates too. A rate that is not known is NaN.
    use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
    use lagrangia_description, only: default_values, description_t, name_length, value_names
    use lagrangia_gauss_principle, only: masses_of, place_points
    use lagrangia_generalised_forces, only: add_generalised_forces
    use lagrangia_hyperdual, only: hyperdual_t
    use lagrangia_kinds, only: dp
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: motion_state_t, named_values_t
    public :: name_values, path

    type :: motion_state_t
        !! A state, how it goes on, and where it came from.
        real(dp) :: t = 0.0_dp                 !! s
        real(dp), allocatable :: q(:), v(:)    !! (ndof)
        real(dp), allocatable :: a(:)          !! accelerations, (ndof)
        real(dp), allocatable :: q0(:), v0(:)  !! at t = 0, (ndof)
        real(dp), allocatable :: shift(:)      !! of the points from their places, m
    end type motion_state_t

    type :: named_values_t
        !! A list that grows; a name may come twice, and then the first counts.
        integer :: count = 0
        character(name_length), allocatable :: names(:)  !! the first `count` count
        type(hyperdual_t), allocatable :: values(:)
    contains
        procedure :: put
    end type named_values_t

contains

    pure subroutine put(self, name, value)
        !! One more.
        class(named_values_t), intent(inout) :: self
        character(*), intent(in) :: name          !! as in a formula
        type(hyperdual_t), intent(in) :: value    !! with its rates
        character(name_length), allocatable :: names(:)
        type(hyperdual_t), allocatable :: values(:)

        if (.not. allocated(self%names)) allocate (self%names(64), self%values(64))
        if (self%count == size(self%names)) then
            allocate (names(2*self%count), values(2*self%count))
            names(:self%count) = self%names
            values(:self%count) = self%values
            call move_alloc(names, self%names)
            call move_alloc(values, self%values)
        end if
        self%count = self%count + 1
        self%names(self%count) = name
        self%values(self%count) = value
    end subroutine put

    pure subroutine name_values(system, d, state, table)
        !! Everything that has one value at this state, always in the same order.
        class(system_t), intent(in) :: system          !! with its parameters
        type(description_t), intent(in) :: d           !! the system's own
        type(motion_state_t), intent(in) :: state      !! all of it allocated but `shift`
        type(named_values_t), intent(out) :: table     !! names and values
        character(name_length), allocatable :: names(:)
        real(dp), allocatable :: values(:)
        character(:), allocatable :: name
        real(dp) :: p(size(state%q)), unknown
        integer :: i

        unknown = ieee_value(unknown, ieee_quiet_nan)
        call table%put("t", hyperdual_t(state%t, 1.0_dp, 1.0_dp, 0.0_dp))
        associate (q => state%q, v => state%v, a => state%a)
            do i = 1, size(q)
                name = trim(d%coordinates(i)%name)
                call table%put(name, hyperdual_t(q(i), v(i), v(i), a(i)))
                call table%put(name//"_dot", hyperdual_t(v(i), a(i), a(i), unknown))
                call table%put(name//"_ddot", not_followed(a(i)))
            end do
            allocate (names, source=value_names(d))
            allocate (values, source=default_values(d))
            do i = 1, size(names)
                call table%put(trim(names(i)), hyperdual_t(re=values(i)))
            end do
            call system%momenta(state%t, q, v, p)
            do i = 1, size(q)
                call table%put("p_"//trim(d%coordinates(i)%name), not_followed(p(i)))
            end do
            if (system%nonconservative .or. allocated(d%generalised_forces)) then
                p = 0.0_dp
                call add_generalised_forces(system, state%t, q, v, p)
                do i = 1, size(q)
                    call table%put("Q_"//trim(d%coordinates(i)%name), not_followed(p(i)))
                end do
            end if
            if (allocated(d%quantities)) then
                do i = 1, size(d%quantities)
                    call table%put(trim(d%quantities(i)%name), &
                                   not_followed(system%quantity(i, state%t, q, v)))
                end do
            end if
            call name_places(system, d, state, table)
            do i = 1, size(q)
                name = trim(d%coordinates(i)%name)
                call table%put(name//"_0", hyperdual_t(re=state%q0(i)))
                call table%put(name//"_dot_0", hyperdual_t(re=state%v0(i)))
            end do
        end associate
    contains
        pure function not_followed(value) result(number)
            !! Its rates are not known.
            real(dp), intent(in) :: value
            type(hyperdual_t) :: number

            number = hyperdual_t(value, unknown, unknown, unknown)
        end function not_followed
    end subroutine name_values

    pure subroutine name_places(system, d, state, table)
        !! Points, `x_bob`, and angles of rotors, `phi_pulley`, with their rates.
        class(system_t), intent(in) :: system
        type(description_t), intent(in) :: d
        type(motion_state_t), intent(in) :: state
        type(named_values_t), intent(inout) :: table
        character, parameter :: axes(3) = ["x", "y", "z"]
        type(hyperdual_t), allocatable :: x(:)
        real(dp), allocatable :: mass(:)
        integer :: i, k, points

        allocate (mass, source=masses_of(d))
        if (size(mass) == 0) return
        allocate (x(size(mass)))
        call place_points(system, d, hyperdual_t(state%t, 1.0_dp, 1.0_dp, 0.0_dp), &
                          path(state), x)
        points = 0
        if (allocated(d%points)) points = size(d%points)
        if (allocated(state%shift)) x(:3*points)%re = x(:3*points)%re + state%shift(:3*points)
        do i = 1, points
            do k = 1, 3
                call put_rates(table, axes(k)//"_"//trim(d%points(i)%name), x(3*i - 3 + k))
            end do
        end do
        do i = 1, size(mass) - 3*points
            call put_rates(table, "phi_"//trim(d%rotors(i)%name), x(3*points + i))
        end do
    end subroutine name_places

    pure function path(state) result(q)
        !! The coordinates along the motion, with their rates.
        type(motion_state_t), intent(in) :: state  !! with its accelerations
        type(hyperdual_t) :: q(size(state%q))      !! `d1`: velocities, `d12`: accelerations

        q%re = state%q
        q%d1 = state%v
        q%d2 = state%v
        q%d12 = state%a
    end function path

    pure subroutine put_rates(table, name, value)
        !! A value and its first and second rate.
        type(named_values_t), intent(inout) :: table
        character(*), intent(in) :: name
        type(hyperdual_t), intent(in) :: value

        call table%put(name, value)
        call table%put(name//"_dot", hyperdual_t(value%d1, value%d12, value%d12, 0.0_dp))
        call table%put(name//"_ddot", hyperdual_t(re=value%d12))
    end subroutine put_rates
end module lagrangia_named_values
