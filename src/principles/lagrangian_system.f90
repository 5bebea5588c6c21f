module lagrangia_lagrangian_system
    !! A system of which only the Lagrangian is known: bring your own.
    !!
    !! Extend `lagrangian_system_t` by `outline` (its name, coordinates and parameters) and by
    !! `lagrangian`. Accelerations and energy then come from exact derivatives of L, slower than
    !! formulae written by hand: see `docs/your_own_system.md`. What integrators must know of its
    !! structure is found by trying. Formulae by hand may be added later, one by one, as the
    !! bindings of `system_t`: the audit checks them against L.
    use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
    use lagrangia_description, only: description_t
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp
    use lagrangia_lagrange, only: accelerations_from_lagrangian, energy_from_lagrangian, &
                                  euler_lagrange_t, expand_lagrangian
    use lagrangia_system, only: check_parameters, system_t
    implicit none (type, external)
    private
    public :: lagrangian_system_t

    type, abstract, extends(system_t) :: lagrangian_system_t
        real(dp), allocatable :: p(:)  !! the parameters, in the order of `describe`
    contains
        procedure(outline_i), deferred :: outline
        procedure :: value
        procedure :: describe
        procedure :: configure
        procedure :: accelerations
        procedure :: energy
        procedure :: find_structure
    end type lagrangian_system_t

    abstract interface
        pure subroutine outline_i(self, d)
            !! What `describe` must say: at least name, title, coordinates and parameters.
            import :: lagrangian_system_t, description_t
            implicit none (type, external)
            class(lagrangian_system_t), intent(in) :: self
            type(description_t), intent(out) :: d
        end subroutine outline_i
    end interface

contains

    pure function value(self, i, default)
        !! Parameter `i`, for `outline`: its default as long as none was given.
        class(lagrangian_system_t), intent(in) :: self
        integer, intent(in) :: i
        real(dp), intent(in) :: default
        real(dp) :: value

        value = default
        if (allocated(self%p)) value = self%p(i)
    end function value

    pure subroutine describe(self, d)
        !! The outline, and something for all that it leaves out.
        class(lagrangian_system_t), intent(in) :: self
        type(description_t), intent(out) :: d

        call self%outline(d)
        if (.not. allocated(d%parameters)) allocate (d%parameters(0))
        if (.not. allocated(d%quantities)) allocate (d%quantities(0))
        if (.not. allocated(d%points)) allocate (d%points(0))
        if (.not. allocated(d%notes)) allocate (d%notes(0))
        if (.not. allocated(d%lagrangian)) then
            allocate (d%lagrangian(1))
            d%lagrangian(1) = "as the program has it"
        end if
        if (.not. allocated(d%equations)) then
            allocate (d%equations(1))
            d%equations(1) = "d/dt dL/dq_dot - dL/dq = 0, by exact derivatives of L"
        end if
        if (d%energy == "") d%energy = "q_dot dL/dq_dot - L, by exact derivatives of L"
        if (d%constraint == "") d%constraint = "in the choice of coordinates"
        if (d%source == "") d%source = "your own"
    end subroutine describe

    pure subroutine configure(self, values, error)
        !! Keep the parameters, if the description allows them, and find out about the structure.
        class(lagrangian_system_t), intent(inout) :: self
        real(dp), intent(in) :: values(:)
        type(error_t), allocatable, intent(out) :: error
        type(description_t) :: d

        call check_parameters(self, values, error)
        if (allocated(error)) return
        self%p = values
        call self%describe(d)
        self%ndof = size(d%coordinates)
        call self%find_structure()
    end subroutine configure

    pure subroutine find_structure(self)
        !! Whether accelerations depend on the velocities, whether L depends on the time, and the
        !! first cyclic coordinate: as some states of no particular kind have it.
        class(lagrangian_system_t), intent(inout) :: self
        integer, parameter :: tries = 3
        type(euler_lagrange_t) :: terms
        real(dp), dimension(self%ndof) :: q, v, a, b
        logical :: cyclic(self%ndof)
        integer :: i, k

        self%velocity_forces = .false.
        self%time_dependent = .false.
        cyclic = .true.
        do k = 1, tries
            q = [(sin(1.3_dp*i + 2.1_dp*k), i=1, self%ndof)]
            v = [(cos(0.7_dp*i + 1.7_dp*k), i=1, self%ndof)]
            call expand_lagrangian(self, 0.4_dp*k, q, v, terms)
            cyclic = cyclic .and. abs(terms%dl_dq) <= 0.0_dp
            self%time_dependent = self%time_dependent .or. abs(terms%dl_dt) > 0.0_dp
            call self%accelerations(0.4_dp*k, q, v, a)
            v = 2.0_dp*v
            call self%accelerations(0.4_dp*k, q, v, b)
            self%velocity_forces = self%velocity_forces .or. maxval(abs(a - b)) > 0.0_dp
        end do
        self%cyclic = findloc(cyclic, .true., 1)
    end subroutine find_structure

    pure subroutine accelerations(self, t, q, v, a)
        !! From the Lagrangian; NaN where its mass matrix is singular.
        class(lagrangian_system_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp), intent(out) :: a(self%ndof)
        type(euler_lagrange_t) :: terms
        type(error_t), allocatable :: error
        real(dp) :: multipliers(self%constraints), share
        integer :: i, j

        if (self%constraints > 0) then
            call accelerations_from_lagrangian(self, t, q, v, a, multipliers, error)
            if (allocated(error)) a = ieee_value(a, ieee_quiet_nan)
            return
        end if
        call expand_lagrangian(self, t, q, v, terms)
        a = terms%force
        do i = 1, self%ndof  ! elimination: the mass matrix is positive definite
            if (.not. terms%mass(i, i) > 0.0_dp) then
                a = ieee_value(a, ieee_quiet_nan)
                return
            end if
            do j = i + 1, self%ndof
                share = terms%mass(j, i)/terms%mass(i, i)
                a(j) = a(j) - share*a(i)
                terms%mass(j, i:) = terms%mass(j, i:) - share*terms%mass(i, i:)
            end do
        end do
        do i = self%ndof, 1, -1
            a(i) = (a(i) - dot_product(terms%mass(i, i + 1:), a(i + 1:)))/terms%mass(i, i)
        end do
    end subroutine accelerations

    pure function energy(self, t, q, v) result(e)
        !! \(\dot q\,\partial L/\partial\dot q - L\).
        class(lagrangian_system_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp) :: e

        e = energy_from_lagrangian(self, t, q, v)
    end function energy
end module lagrangia_lagrangian_system
