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
    use lagrangia_kinds, only: dp
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: attractors_t, strobed_t
    public :: signature_size

    integer, parameter :: most_period = 12            !! points after which a motion repeats
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
        real(dp), allocatable, private :: signatures(:, :)
    contains
        procedure :: number_of
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
        real(dp), allocatable :: more(:, :)
        integer :: i

        number = ieee_value(number, ieee_quiet_nan)
        if (any(ieee_is_nan(signature))) return
        number = 0.0_dp
        if (signature(1) < 0.5_dp) return
        if (.not. allocated(self%signatures)) allocate (self%signatures(size(signature), 8))
        do i = 1, self%count
            if (nint(signature(1)) /= nint(self%signatures(1, i))) cycle
            if (alike(signature(2:), self%signatures(2:, i), same_within)) exit
        end do
        number = i
        if (i <= self%count) return
        if (self%count == size(self%signatures, 2)) then
            allocate (more(size(signature), 2*self%count))
            more(:, :self%count) = self%signatures
            call move_alloc(more, self%signatures)
        end if
        self%count = i
        self%signatures(:, i) = signature
    end function number_of
end module lagrangia_attractor
