module henon_heiles
    !! Two coordinates whose forces depend on nothing but both of them, and are not linear: what
    !! the catalogue does not have. Hénon & Heiles, Astron. J. 69 (1964) 73, with two masses.
    use lagrangia_description, only: description_t
    use lagrangia_errors, only: error_t
    use lagrangia_hyperdual, only: hyperdual_t, operator(*), operator(**), operator(+), operator(-)
    use lagrangia_kinds, only: dp
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: henon_heiles_t, new_henon_heiles

    type, extends(system_t) :: henon_heiles_t
        real(dp) :: m1 = 1.3_dp, m2 = 0.7_dp  !! kg
    contains
        procedure :: describe
        procedure :: configure
        procedure :: accelerations
        procedure :: lagrangian
        procedure :: energy
    end type henon_heiles_t

contains

    subroutine new_henon_heiles(self)
        !! Ready for use.
        type(henon_heiles_t), intent(out) :: self
        type(error_t), allocatable :: error

        call self%configure([real(dp) ::], error)
    end subroutine new_henon_heiles

    pure subroutine describe(self, d)
        !! A name is enough.
        class(henon_heiles_t), intent(in) :: self
        type(description_t), intent(out) :: d

        d%name = "henon_heiles"
    end subroutine describe

    pure subroutine configure(self, values, error)
        !! No parameters.
        class(henon_heiles_t), intent(inout) :: self
        real(dp), intent(in) :: values(:)
        type(error_t), allocatable, intent(out) :: error

        self%ndof = 2
        self%velocity_forces = .false.
    end subroutine configure

    pure subroutine accelerations(self, t, q, v, a)
        !! $$ m_1\ddot x = -2x - 2xy,\qquad m_2\ddot y = -3y - x^2 + y^2 $$
        class(henon_heiles_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp), intent(out) :: a(self%ndof)

        a(1) = -2.0_dp*q(1)*(1.0_dp + q(2))/self%m1
        a(2) = (-3.0_dp*q(2) - q(1)**2 + q(2)**2)/self%m2
    end subroutine accelerations

    pure function lagrangian(self, t, q, v) result(l)
        !! $$ L = \tfrac12(m_1\dot x^2 + m_2\dot y^2) - x^2 - \tfrac32y^2 - x^2y + \tfrac13y^3 $$
        class(henon_heiles_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof), v(self%ndof)
        type(hyperdual_t) :: l

        l = 0.5_dp*(self%m1*v(1)**2 + self%m2*v(2)**2) - q(1)**2 - 1.5_dp*q(2)**2 &
            - q(1)**2*q(2) + (1.0_dp/3.0_dp)*q(2)**3
    end function lagrangian

    pure function energy(self, t, q, v) result(e)
        !! Kinetic and potential.
        class(henon_heiles_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp) :: e

        e = 0.5_dp*(self%m1*v(1)**2 + self%m2*v(2)**2) + q(1)**2 + 1.5_dp*q(2)**2 &
            + q(1)**2*q(2) - q(2)**3/3.0_dp
    end function energy
end module henon_heiles
