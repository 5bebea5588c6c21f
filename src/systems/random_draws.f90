module lagrangia_random_draws
    !! Parameters and states at random, the same ones in every run.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_quiet_nan, ieee_value
    use lagrangia_description, only: description_t
    use lagrangia_errors, only: error_t, fail
    use lagrangia_hyperdual, only: hyperdual_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_lagrange, only: euler_lagrange_t, expand_lagrangian
    use lagrangia_lapack, only: smallest_pivot
    use lagrangia_mass_matrix, only: list_of
    use lagrangia_system, only: default_values, system_t
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: random_t, random_box_t

    integer(i8), parameter :: first_seed = 20110901_i8
    integer(i8), parameter :: modulus = 2147483647_i8  !! 2^31 - 1, a prime

    type :: random_t
        !! A sequence of numbers.
        integer(i8), private :: seed = first_seed
        integer :: left_out = 0  !! states at which a mass matrix was not positive definite
    contains
        procedure :: start
        procedure :: uniform
        procedure :: parameters
        procedure :: state
    end type random_t

    type :: random_box_t
        !! gfortran 12 needs it: modules that make the dispatch table of `random_t` for themselves
        !! disagree about its order.
        class(random_t), allocatable :: item
    end type random_box_t

contains

    pure subroutine start(self, seed)
        !! Another sequence, the same one for the same `seed`.
        class(random_t), intent(inout) :: self
        integer, intent(in) :: seed  !! any number
        integer(i8), parameter :: low = 4294967295_i8, factor = 73244475_i8
        integer(i8) :: x
        integer :: i

        ! The sequence is linear in where it begins: seeds 1, 2, 3 would give numbers at equal
        ! distances. These 32 bits are mixed by products and shifts, which are not linear.
        x = iand(int(seed, i8), low)
        do i = 1, 2
            x = iand(factor*ieor(x, ishft(x, -16)), low)
        end do
        self%seed = 1 + modulo(ieor(x, ishft(x, -16)), modulus - 1)
    end subroutine start

    subroutine uniform(self, lower, upper, x)
        !! The next number between `lower` and `upper`.
        !!
        !! Source: Park & Miller, Comm. ACM 31, 1192 (1988), with the multiplier of 1993.
        class(random_t), intent(inout) :: self
        real(dp), intent(in) :: lower, upper  !! the ends, in the unit of `x`
        real(dp), intent(out) :: x            !! between them

        self%seed = mod(48271_i8*self%seed, modulus)
        x = lower + (upper - lower)*real(self%seed, dp)/modulus
    end subroutine uniform

    subroutine parameters(self, system, edges, values, error, fixed, given)
        !! Parameters drawn uniformly, 4 wide, from their lower bound (-2 if that is lower) on.
        !! With `edges` two in five lie on the edge of their domain, or are zero, or, where they
        !! have a formula, are left to it. The `fixed` ones are as `given`.
        class(random_t), intent(inout) :: self
        class(system_t), intent(inout) :: system          !! is configured with them
        logical, intent(in) :: edges                      !! also those on the edge of their domain
        real(dp), allocatable, intent(out) :: values(:)   !! what `system` was given
        type(error_t), allocatable, intent(out) :: error  !! it refused them
        logical, intent(in), optional :: fixed(:)         !! one for each value
        real(dp), intent(in), optional :: given(:)        !! as many, in their units
        type(description_t) :: d
        real(dp) :: lowest, chance
        integer :: i, j, k

        call system%describe(d)
        allocate (values, source=default_values(d))
        k = 0
        do i = 1, size(d%parameters)
            associate (p => d%parameters(i))
                lowest = max(p%lower, -2.0_dp)
                if (p%open_lower) lowest = p%lower + 0.2_dp
                do j = 1, p%count
                    k = k + 1
                    call self%uniform(lowest, min(p%upper, lowest + 4.0_dp), values(k))
                    if (p%whole) values(k) = anint(values(k))
                    call self%uniform(0.0_dp, 1.0_dp, chance)
                    if (.not. edges .or. chance > 0.4_dp) cycle
                    if (len_trim(p%computed) > 0) then
                        values(k) = ieee_value(1.0_dp, ieee_quiet_nan)
                    else if (.not. p%open_lower) then
                        values(k) = merge(p%lower, 0.0_dp, p%lower > -huge(1.0_dp))
                    end if
                end do
            end associate
        end do
        if (present(fixed) .and. present(given)) then
            where (fixed) values = given
        end if
        call system%configure(values, error)
    end subroutine parameters

    subroutine state(self, system, t, q, v, error)
        !! A time, coordinates and velocities that the constraints beside L allow, in the typical
        !! sizes of the system. Where L is not finite at \(q\) and at \(1.2q\), another state is
        !! drawn, from a range 0.8 times as wide: of the velocities if L is finite at rest, as below
        !! the speed of light, else of the coordinates. Where the mass matrix is not positive
        !! definite, it is from the same range, and if that is so everywhere such a state is what
        !! it is.
        class(random_t), intent(inout) :: self
        class(system_t), intent(in) :: system             !! configured
        real(dp), intent(out) :: t                        !! -2 to 3 typical times, s
        real(dp), allocatable, intent(out) :: q(:), v(:)  !! (ndof)
        type(error_t), allocatable, intent(out) :: error  !! there are none
        integer, parameter :: tries = 100
        type(description_t) :: d
        type(error_t), allocatable :: outside
        real(dp) :: given(system%ndof - system%constraints), widest, fastest
        integer :: i, k

        allocate (q(system%ndof), v(system%ndof))
        call system%describe(d)
        call self%uniform(-2.0_dp, 3.0_dp, t)
        t = d%typical_time*t
        widest = 3.0_dp
        fastest = 3.0_dp
        do k = 1, tries
            do i = 1, system%ndof
                call self%uniform(-widest, widest, q(i))
            end do
            if (allocated(d%typical_places)) q = d%typical_places*q
            do i = 1, size(given)
                call self%uniform(-fastest, fastest, given(i))
            end do
            call system%complete_velocities(t, q, given, v, error)
            if (allocated(error)) return
            if (allocated(d%typical_places)) then
                do i = 1, system%ndof
                    call self%uniform(-fastest, fastest, v(i))
                end do
                v = d%typical_places/d%typical_time*v
            end if
            call system%keep_constraints(t, q, v)
            call system%check_places(t, q, outside)
            if (is_inside(system, t, q, v) .and. .not. allocated(outside)) then
                if (k > tries/2 .or. has_inertia(system, t, q, v)) return
                self%left_out = self%left_out + 1
                cycle
            end if
            if (.not. allocated(outside) .and. is_inside(system, t, q, 0.0_dp*v)) then
                fastest = 0.8_dp*fastest
            else
                widest = 0.8_dp*widest
            end if
        end do
        if (allocated(outside)) then
            call fail(error, "no place was found that keeps the constraints")
        else
            call fail(error, "L is no number at any state tried, such as t = "//to_text(t)// &
                      ", q = "//list_of(q)//", v = "//list_of(v))
        end if
    end subroutine state

    pure function is_inside(system, t, q, v) result(yes)
        !! L is finite at \(q\) and at \(1.2q\): the state is not on the edge of its domain.
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t, q(:), v(:)
        logical :: yes
        type(hyperdual_t) :: tt, qq(size(q)), vv(size(v)), here, outside

        tt%re = t
        qq%re = q
        vv%re = v
        here = system%lagrangian(tt, qq, vv)
        qq%re = 1.2_dp*q
        outside = system%lagrangian(tt, qq, vv)
        yes = ieee_is_finite(here%re) .and. ieee_is_finite(outside%re)
    end function is_inside

    pure function has_inertia(system, t, q, v) result(yes)
        !! Is the mass matrix positive definite? With constraints it need not be.
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t, q(:), v(:)
        logical :: yes
        type(euler_lagrange_t) :: terms

        yes = .true.
        if (system%constraints > 0) return
        call expand_lagrangian(system, t, q, v, terms)
        yes = smallest_pivot(terms%mass) > 0.0_dp
    end function has_inertia
end module lagrangia_random_draws
