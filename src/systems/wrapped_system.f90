module lagrangia_wrapped_system
    !! A system around another of the same coordinates: what an extension does not bind itself is
    !! that of the system inside, as far as equations of motion and energy go.
    use lagrangia_description, only: description_t
    use lagrangia_errors, only: error_t
    use lagrangia_hyperdual, only: hyperdual_t
    use lagrangia_kinds, only: dp, lanes
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: wrapped_system_t

    type, extends(system_t) :: wrapped_system_t
        class(system_t), allocatable :: inside
    contains
        procedure :: wrap
        procedure :: adopt
        procedure :: describe
        procedure :: configure
        procedure :: accelerations
        procedure :: accelerations_lanes
        procedure :: lagrangian
        procedure :: generalised_forces
        procedure :: energy
        procedure :: constraint_rows
    end type wrapped_system_t

contains

    subroutine wrap(self, system)
        !! Take a system in.
        class(wrapped_system_t), intent(inout) :: self
        class(system_t), intent(in) :: system  !! with its parameters

        if (allocated(self%inside)) deallocate (self%inside)
        allocate (self%inside, source=system)
        call self%adopt()
    end subroutine wrap

    pure subroutine adopt(self)
        !! What the system inside says of its coordinates, forces and constraints holds here too.
        !! It may change with the parameters.
        class(wrapped_system_t), intent(inout) :: self

        self%ndof = self%inside%ndof
        self%velocity_forces = self%inside%velocity_forces
        self%time_dependent = self%inside%time_dependent
        self%timeless_lagrangian = self%inside%timeless_lagrangian
        self%nonconservative = self%inside%nonconservative
        self%workless = self%inside%workless
        self%constraints = self%inside%constraints
        self%constraints_work = self%inside%constraints_work
        self%cyclic = self%inside%cyclic
        self%contacts = self%inside%contacts
    end subroutine adopt

    pure subroutine describe(self, d)
        !! See `system_t`.
        class(wrapped_system_t), intent(in) :: self
        type(description_t), intent(out) :: d

        call self%inside%describe(d)
    end subroutine describe

    pure subroutine configure(self, values, error)
        !! See `system_t`.
        class(wrapped_system_t), intent(inout) :: self
        real(dp), intent(in) :: values(:)
        type(error_t), allocatable, intent(out) :: error

        call self%inside%configure(values, error)
        call self%adopt()
    end subroutine configure

    pure subroutine accelerations(self, t, q, v, a)
        !! See `system_t`.
        class(wrapped_system_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp), intent(out) :: a(self%ndof)

        call self%inside%accelerations(t, q, v, a)
    end subroutine accelerations

    pure subroutine accelerations_lanes(self, t, q, v, a)
        !! See `system_t`.
        class(wrapped_system_t), intent(in) :: self
        real(dp), intent(in) :: t(lanes), q(lanes, self%ndof), v(lanes, self%ndof)
        real(dp), intent(out) :: a(lanes, self%ndof)

        call self%inside%accelerations_lanes(t, q, v, a)
    end subroutine accelerations_lanes

    pure function lagrangian(self, t, q, v) result(l)
        !! See `system_t`.
        class(wrapped_system_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof), v(self%ndof)
        type(hyperdual_t) :: l

        l = self%inside%lagrangian(t, q, v)
    end function lagrangian

    pure subroutine generalised_forces(self, t, q, v, f)
        !! See `system_t`.
        class(wrapped_system_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof), v(self%ndof)
        type(hyperdual_t), intent(out) :: f(self%ndof)

        call self%inside%generalised_forces(t, q, v, f)
    end subroutine generalised_forces

    pure function energy(self, t, q, v) result(e)
        !! See `system_t`.
        class(wrapped_system_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp) :: e

        e = self%inside%energy(t, q, v)
    end function energy

    pure subroutine constraint_rows(self, t, q, rows, drift)
        !! See `system_t`.
        class(wrapped_system_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof)
        type(hyperdual_t), intent(out) :: rows(:, :), drift(:)

        call self%inside%constraint_rows(t, q, rows, drift)
    end subroutine constraint_rows
end module lagrangia_wrapped_system
