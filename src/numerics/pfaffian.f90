module lagrangia_pfaffian
    !! Constraints on velocities, \(\sum_i a_i\,\dot q_i + b = 0\), and what they leave free.
    !!
    !! As one-forms \(\sum_i a_i\,dq_i + b\,dt\), with the time as the last coordinate. Derivatives
    !! are exact, by hyper-dual numbers.
    !!
    !! Source: Bullo & Lewis, *Geometric Control of Mechanical Systems*, secs. 3.8, 4.5; Frobenius'
    !! theorem in the form of brackets and of \(da\) on the kernel.
    use lagrangia_errors, only: error_t
    use lagrangia_hyperdual, only: hyperdual, hyperdual_t, operator(*), operator(+), operator(-), &
                                   operator(/)
    use lagrangia_kinds, only: dp
    use lagrangia_lapack, only: matrix_rank
    use lagrangia_number_class, only: is_nonzero
    implicit none (type, external)
    private
    public :: pfaffian_t

    real(dp), parameter :: noise = 1e-12_dp  !! of elimination, relative

    type, abstract :: pfaffian_t
        integer :: coordinates = 0   !! without the time
        integer :: rows = 0
        logical :: timed = .true.    !! look at the time as a coordinate too
    contains
        procedure(forms_i), deferred :: forms
        procedure :: dimension => dimension_of
        procedure :: curl
        procedure :: frobenius
        procedure :: integrable
        procedure :: motion
        procedure :: moves
        procedure :: turns
        procedure :: growth
    end type pfaffian_t

    abstract interface
        pure subroutine forms_i(self, x, a)
            !! The coefficients, a row a constraint, a column a coordinate; the last one is `b`.
            import :: pfaffian_t, hyperdual_t
            implicit none (type, external)
            class(pfaffian_t), intent(in) :: self
            type(hyperdual_t), intent(in) :: x(self%coordinates + 1)
            !! a point: the coordinates, then the time
            type(hyperdual_t), intent(out) :: a(self%rows, self%coordinates + 1)
            !! a row a constraint
        end subroutine forms_i
    end interface

contains

    pure function dimension_of(self) result(n)
        !! Of the space that is looked at: with or without the time.
        class(pfaffian_t), intent(in) :: self
        integer :: n

        n = self%coordinates + merge(1, 0, self%timed)
    end function dimension_of

    pure function curl(self, x) result(largest)
        !! \(\max|\partial_ia_j - \partial_ja_i|\): zero where the forms are exact.
        class(pfaffian_t), intent(in) :: self
        real(dp), intent(in) :: x(:)  !! a point: the coordinates, then the time
        real(dp) :: largest, slopes(self%rows, self%dimension(), self%dimension())
        type(hyperdual_t) :: a(self%rows, self%coordinates + 1), xx(self%coordinates + 1)
        integer :: i, j, n

        n = self%dimension()
        do i = 1, n
            xx = hyperdual(x)
            xx(i)%d1 = 1.0_dp
            call self%forms(xx, a)
            slopes(:, :, i) = a(:, :n)%d1
        end do
        largest = 0.0_dp
        do i = 1, n
            do j = 1, i - 1
                largest = max(largest, maxval(abs(slopes(:, j, i) - slopes(:, i, j))))
            end do
        end do
    end function curl

    pure function motion(self, x) result(largest)
        !! \(\max(|b|, |\partial_ta|)\): zero where the constraints do not move.
        class(pfaffian_t), intent(in) :: self
        real(dp), intent(in) :: x(:)  !! a point: the coordinates, then the time
        real(dp) :: largest
        type(hyperdual_t) :: a(self%rows, self%coordinates + 1), xx(self%coordinates + 1)

        xx = hyperdual(x)
        xx(size(xx))%d1 = 1.0_dp
        call self%forms(xx, a)
        largest = max(maxval(abs(a(:, size(xx))%re)), maxval(abs(a%d1)))
    end function motion

    pure function frobenius(self, x) result(largest)
        !! The largest \(da(X, Y)\) on the directions \(X, Y\) that all constraints allow: zero
        !! where they can be integrated, with an integrating factor or without.
        class(pfaffian_t), intent(in) :: self
        real(dp), intent(in) :: x(:)  !! a point: the coordinates, then the time
        real(dp) :: largest
        real(dp), dimension(self%rows, self%dimension() - self%rows, &
                            self%dimension() - self%rows) :: da, terms

        call on_the_free(self, x, da, terms)
        largest = max(0.0_dp, maxval(abs(da)))
        if (any(.not. abs(da) <= huge(largest))) largest = sum(abs(da))  ! NaN, too
    end function frobenius

    pure function integrable(self, x) result(yes)
        !! Is each \(da(X, Y)\) of `frobenius` rounding beside the terms that add up to it?
        !! NaN is none.
        class(pfaffian_t), intent(in) :: self
        real(dp), intent(in) :: x(:)  !! a point: the coordinates, then the time
        logical :: yes
        real(dp), dimension(self%rows, self%dimension() - self%rows, &
                            self%dimension() - self%rows) :: da, terms

        call on_the_free(self, x, da, terms)
        yes = all(abs(da) <= noise*terms)
    end function integrable

    pure function moves(self, x) result(yes)
        !! Do holonomic constraints contain the time: a \(b\), or directions that they allow and
        !! that turn?
        class(pfaffian_t), intent(in) :: self
        real(dp), intent(in) :: x(:)  !! a point: the coordinates, then the time
        logical :: yes
        type(hyperdual_t) :: a(self%rows, self%coordinates + 1)

        call self%forms(hyperdual(x), a)
        yes = any(is_nonzero(a(:, size(x))%re)) .or. self%turns(x)
    end function moves

    pure function turns(self, x) result(yes)
        !! Do the motions that the constraints allow change with the time? A factor before a whole
        !! constraint is none. Nonholonomic ones may have a \(b\) without it: \(\dot x = y\).
        class(pfaffian_t), intent(in) :: self
        real(dp), intent(in) :: x(:)  !! a point: the coordinates, then the time
        logical :: yes
        type(hyperdual_t) :: free(self%dimension(), self%dimension() - self%rows)
        type(hyperdual_t) :: xx(self%coordinates + 1)

        xx = hyperdual(x)
        xx(size(xx))%d1 = 1.0_dp
        call kernel(self, xx, free)
        yes = any(abs(free%d1) > noise)
    end function turns

    pure subroutine on_the_free(self, x, da, terms)
        !! \(da(X, Y)\) of each constraint on the directions that all allow, and the sum of the
        !! sizes of its terms.
        class(pfaffian_t), intent(in) :: self
        real(dp), intent(in) :: x(:)
        real(dp), intent(out) :: da(:, :, :), terms(:, :, :)
        real(dp) :: slopes(self%rows, self%dimension(), self%dimension())
        type(hyperdual_t) :: free(self%dimension(), self%dimension() - self%rows)
        type(hyperdual_t) :: a(self%rows, self%coordinates + 1), xx(self%coordinates + 1)
        real(dp) :: z(size(free, 1), size(free, 2)), product(size(free, 2), size(free, 2))
        integer :: i, n

        n = self%dimension()
        call kernel(self, hyperdual(x), free)
        z = free%re
        do i = 1, n
            xx = hyperdual(x)
            xx(i)%d1 = 1.0_dp
            call self%forms(xx, a)
            slopes(:, i, :) = a(:, :n)%d1
        end do
        do i = 1, self%rows
            product = matmul(transpose(z), matmul(slopes(i, :, :), z))
            da(i, :, :) = product - transpose(product)
            product = matmul(transpose(abs(z)), matmul(abs(slopes(i, :, :)), abs(z)))
            terms(i, :, :) = product + transpose(product)
        end do
    end subroutine on_the_free

    pure subroutine kernel(self, x, free)
        !! Vector fields that span what the constraints allow, a column each: Gauss-Jordan
        !! elimination with complete pivoting, on hyper-dual numbers.
        class(pfaffian_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: x(:)
        type(hyperdual_t), intent(out) :: free(:, :)
        type(hyperdual_t) :: a(self%rows, self%coordinates + 1), row(self%coordinates + 1)
        integer :: pivots(self%rows), place(2), s, r, j, c
        logical :: taken(self%dimension())

        call self%forms(x, a)
        taken = .false.
        do s = 1, self%rows
            place = maxloc(abs(a(s:, :size(taken))%re), &
                           spread(.not. taken, 1, self%rows - s + 1))
            row = a(s + place(1) - 1, :)
            a(s + place(1) - 1, :) = a(s, :)
            do j = 1, size(row)
                a(s, j) = row(j)/row(place(2))
            end do
            pivots(s) = place(2)
            taken(place(2)) = .true.
            do r = 1, self%rows
                if (r == s) cycle
                row = a(r, :)
                do j = 1, size(row)
                    a(r, j) = row(j) - row(place(2))*a(s, j)
                end do
            end do
        end do
        free = hyperdual_t()
        j = 0
        do c = 1, size(taken)
            if (taken(c)) cycle
            j = j + 1
            free(c, j) = hyperdual(1.0_dp)
            do s = 1, self%rows
                free(pivots(s), j) = hyperdual_t() - a(s, c)
            end do
        end do
    end subroutine kernel

    pure subroutine growth(self, x, dimensions, error)
        !! Of the directions that are allowed; with their brackets; with the brackets of those.
        class(pfaffian_t), intent(in) :: self
        real(dp), intent(in) :: x(:)  !! a point: the coordinates, then the time
        integer, intent(out) :: dimensions(3)  !! \(d_1, d_2, d_3\)
        type(error_t), allocatable, intent(out) :: error  !! allocated where it fails
        real(dp), allocatable :: spanned(:, :)
        type(hyperdual_t) :: w(self%dimension(), self%dimension() - self%rows)
        real(dp) :: w0(size(w, 1), size(w, 2)), bracket(size(w, 1)), third(size(w, 1))
        real(dp) :: d(size(w, 1), size(w, 2), size(w, 2))  !! derivative of field j along field i
        integer :: i, j, l, m

        m = size(w, 2)
        call kernel(self, hyperdual(x), w)
        w0 = w%re
        do i = 1, m
            d(:, :, i) = along(w0(:, i))
        end do
        allocate (spanned, source=w0)
        call matrix_rank(spanned, dimensions(1), error)
        if (allocated(error)) return
        do i = 1, m
            do j = i + 1, m
                call append(d(:, j, i) - d(:, i, j))
            end do
        end do
        call matrix_rank(spanned, dimensions(2), error)
        if (allocated(error)) return
        do i = 1, m
            do j = i + 1, m
                bracket = d(:, j, i) - d(:, i, j)
                do l = 1, m
                    third = second(i, l, j) - second(j, l, i) + column(along(d(:, i, l)), j) &
                            - column(along(d(:, j, l)), i) - column(along(bracket), l)
                    call append(third)
                end do
            end do
        end do
        call matrix_rank(spanned, dimensions(3), error)
    contains
        pure function along(direction) result(slope)
            real(dp), intent(in) :: direction(:)
            real(dp) :: slope(size(w, 1), size(w, 2))
            type(hyperdual_t) :: xx(size(x)), field(size(w, 1), size(w, 2))

            xx = hyperdual(x)
            xx(:size(direction))%d1 = direction
            call kernel(self, xx, field)
            slope = field%d1
        end function along

        pure function second(first, next, which) result(slope)
            integer, intent(in) :: first, next, which
            real(dp) :: slope(size(w, 1))
            type(hyperdual_t) :: xx(size(x)), field(size(w, 1), size(w, 2))

            xx = hyperdual(x)
            xx(:size(w, 1))%d1 = w0(:, first)
            xx(:size(w, 1))%d2 = w0(:, next)
            call kernel(self, xx, field)
            slope = field(:, which)%d12
        end function second

        pure function column(matrix, which) result(one)
            real(dp), intent(in) :: matrix(:, :)
            integer, intent(in) :: which
            real(dp) :: one(size(matrix, 1))

            one = matrix(:, which)
        end function column

        pure subroutine append(vector)
            real(dp), intent(in) :: vector(:)
            real(dp), allocatable :: wider(:, :)

            allocate (wider(size(w, 1), size(spanned, 2) + 1))
            wider(:, :size(spanned, 2)) = spanned
            wider(:, size(wider, 2)) = vector
            call move_alloc(wider, spanned)
        end subroutine append
    end subroutine growth
end module lagrangia_pfaffian
