module lagrangia_attractor
    !! Which attractor a motion has come to, told by its stroboscopic points: after the transient
    !! they repeat after p periods of the stroboscope, and two motions are on the same attractor
    !! where p and the means over these p points agree. An angle counts by its cosine and sine, so
    !! that turns make no difference.
    !!
    !! A fixed point has p = 1 whatever the period of the stroboscope is. A motion that has not
    !! settled, or is chaotic, has p = 0.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_nan, ieee_quiet_nan, ieee_value
    use lagrangia_description, only: description_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_system, only: system_t
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: attractors_t, strobed_t
    public :: signature_size

    integer, parameter :: most_period = 12            !! points after which a motion repeats
    real(dp), parameter :: unit = 1e-3_dp              !! of a place that is told
    real(dp), parameter :: half_turn = acos(-1.0_dp)   !! rad
    real(dp), parameter :: repeats_within = 1e-4_dp   !! of the size of the numbers, at least 1
    real(dp), parameter :: same_within = 1e-2_dp

    type :: strobed_t
        !! The latest points of one motion.
        private
        logical, allocatable :: angle(:)              !! (ndof)
        real(dp), allocatable :: points(:, :)         !! (3 ndof, 2 most_period), in a ring
        integer :: seen = 0
    contains
        procedure :: fresh
        procedure :: begin
        procedure :: see
        procedure :: signature
    end type strobed_t

    type :: attractors_t
        !! Those that were met, in the order in which they were.
        integer :: count = 0
        integer(i8), allocatable :: met(:)  !! motions on each; element 0: on none
        real(dp), allocatable, private :: signatures(:, :)
    contains
        procedure :: number_of
        procedure :: place_of
    end type attractors_t

contains

    pure function signature_size(ndof) result(n)
        !! Numbers that tell an attractor: p, and the means.
        integer, intent(in) :: ndof  !! of the system
        integer :: n

        n = 1 + 3*ndof
    end function signature_size

    pure function fresh(self) result(yes)
        !! No point has been seen yet.
        class(strobed_t), intent(in) :: self
        logical :: yes

        yes = self%seen == 0
    end function fresh

    subroutine begin(self, system)
        !! Before a motion.
        class(strobed_t), intent(inout) :: self
        class(system_t), intent(in) :: system  !! whose motion it is
        type(description_t) :: d

        self%seen = 0
        if (allocated(self%points)) return
        call system%describe(d)
        self%angle = d%coordinates%unit == "rad"
        allocate (self%points(3*system%ndof, 2*most_period))
    end subroutine begin

    pure subroutine see(self, q, v)
        !! The next point.
        class(strobed_t), intent(inout) :: self
        real(dp), intent(in) :: q(:), v(:)  !! the state, (ndof)
        integer :: n

        n = size(q)
        associate (point => self%points(:, modulo(self%seen, 2*most_period) + 1))
            point(:n) = merge(cos(q), q, self%angle)
            point(n + 1:2*n) = merge(sin(q), 0.0_dp, self%angle)
            point(2*n + 1:) = v
        end associate
        self%seen = self%seen + 1
    end subroutine see

    pure function signature(self) result(numbers)
        !! p, and the means over the last p points; 0 where they do not repeat.
        class(strobed_t), intent(in) :: self
        real(dp), allocatable :: numbers(:)
        integer :: i, p

        allocate (numbers(1 + size(self%points, 1)))
        numbers = 0.0_dp
        do p = 1, min(most_period, self%seen/2)
            if (.not. all([(alike(point(self, i), point(self, i + p), repeats_within), &
                            i=1, p)])) cycle
            numbers(1) = p
            do i = 1, p
                numbers(2:) = numbers(2:) + point(self, i)/p
            end do
            return
        end do
    end function signature

    pure function point(self, back) result(numbers)
        !! The latest point, 1, or one before it.
        type(strobed_t), intent(in) :: self
        integer, intent(in) :: back
        real(dp) :: numbers(size(self%points, 1))

        numbers = self%points(:, modulo(self%seen - back, 2*most_period) + 1)
    end function point

    pure function alike(a, b, within) result(yes)
        !! Do all numbers agree, relative to their size and 1?
        real(dp), intent(in) :: a(:), b(:), within
        logical :: yes

        yes = all(abs(a - b) <= within*max(1.0_dp, abs(a), abs(b)))
    end function alike

    function number_of(self, signature) result(number)
        !! Of the attractor with this signature, from 1 in the order in which they are asked for; 0
        !! where there is none, NaN of a motion that failed.
        class(attractors_t), intent(inout) :: self
        real(dp), intent(in) :: signature(:)  !! of a motion
        real(dp) :: number
        integer(i8), allocatable :: more_met(:)
        real(dp), allocatable :: more(:, :)
        integer :: i

        number = ieee_value(number, ieee_quiet_nan)
        if (ieee_is_nan(signature(1))) return
        number = 0.0_dp
        if (.not. allocated(self%signatures)) then
            allocate (self%signatures(size(signature), 8), self%met(0:8))
            self%met = 0
        end if
        if (signature(1) < 0.5_dp) self%met(0) = self%met(0) + 1
        if (signature(1) < 0.5_dp) return
        do i = 1, self%count
            if (nint(signature(1)) /= nint(self%signatures(1, i))) cycle
            if (alike(signature(2:), self%signatures(2:, i), same_within)) exit
        end do
        number = i
        if (i <= self%count) self%met(i) = self%met(i) + 1
        if (i <= self%count) return
        if (self%count == size(self%signatures, 2)) then
            allocate (more(size(signature), 2*self%count), more_met(0:2*self%count))
            more(:, :self%count) = self%signatures
            more_met = 0
            more_met(:self%count) = self%met
            call move_alloc(more, self%signatures)
            call move_alloc(more_met, self%met)
        end if
        self%met(i) = 1
        self%count = i
        self%signatures(:, i) = signature
    end function number_of

    pure function place_of(self, number, d) result(text)
        !! Where an attractor is, to three decimals, `at theta = 3.142, theta_dot = 0.0`, an angle
        !! from -pi to pi; of one that repeats after several points how many, and their means.
        class(attractors_t), intent(in) :: self
        integer, intent(in) :: number         !! from 1 to `count`
        type(description_t), intent(in) :: d  !! of the system
        character(:), allocatable :: text
        real(dp) :: value
        integer :: i, n

        n = size(d%coordinates)
        text = ""
        associate (s => self%signatures(2:, number))
            do i = 1, n
                value = s(i)
                if (d%coordinates(i)%unit == "rad") then
                    value = atan2(s(n + i), s(i))
                    if (value + half_turn < 0.5_dp*unit) value = half_turn  ! -pi is pi
                end if
                text = text//", "//trim(d%coordinates(i)%name)//" = "//rounded(value)
            end do
            do i = 1, n
                text = text//", "//trim(d%coordinates(i)%name)//"_dot = "//rounded(s(2*n + i))
            end do
        end associate
        i = nint(self%signatures(1, number))
        if (i == 1) text = "at"//text(2:)
        if (i > 1) text = "of "//to_text(i)//" points, on average at"//text(2:)
    end function place_of

    pure function rounded(value) result(text)
        !! To three decimals; there is no -0.
        real(dp), intent(in) :: value
        character(:), allocatable :: text
        real(dp) :: near

        near = anint(value/unit)
        if (abs(near) < 0.5_dp) near = 0.0_dp
        text = to_text(near/1000.0_dp)
    end function rounded
end module lagrangia_attractor
