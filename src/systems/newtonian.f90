module lagrangia_newtonian
    !! The contract of a system as Newton has it: masses, forces and what holds them together.
    !! No Lagrangian, no generalised coordinates; an independent witness of both.
    !!
    !! The Cartesian coordinates `x` are three of each point of the description, then one angle
    !! of each rotor, whose "mass" is its moment of inertia.
    use lagrangia_hyperdual, only: hyperdual_t
    use lagrangia_kinds, only: dp
    implicit none (type, external)
    private
    public :: newtonian_t

    type, abstract :: newtonian_t
    contains
        procedure :: angles => no_angles
        procedure :: newton => no_newton
    end type newtonian_t

contains

    pure subroutine no_angles(self, t, q, phi)
        !! The angles, rad, of the rotors in the description: here none.
        class(newtonian_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(:)
        type(hyperdual_t), intent(out) :: phi(:)

        phi = hyperdual_t()
    end subroutine no_angles

    pure subroutine no_newton(self, t, x, u, force, held)
        !! What acts on the Cartesian coordinates `x` with the velocities `u`: here nothing.
        !!
        !! `force` is applied (N; N m on an angle). Each of `held` stays zero by itself: first
        !! functions of t and x alone, at the end, as many as `constraints`, non-holonomic ones,
        !! linear in `u`. What keeps it at zero is the reaction of that name times its slope:
        !! write it as a length that grows along the reaction, and the reaction is a force in N.
        class(newtonian_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, x(:), u(:)
        real(dp), intent(out) :: force(:)
        type(hyperdual_t), intent(out) :: held(:)

        force = 0.0_dp
        held = hyperdual_t()
    end subroutine no_newton
end module lagrangia_newtonian
